! SPDX-License-Identifier: BSD-3-Clause
!> Newmark's method (1959):
!>   V1 = V0 + h [(1 - gamma) A0 + gamma A1],  U1 = U0 + h V0 + h^2 [(1/2 - beta) A0 + beta A1],
!> contact force at the end of the step, r1. On impact it gains energy without bound: it is here
!> to be compared with. One stage: [M/(beta h^2) + gamma C/(beta h) + K] x = M D/(beta h^2)
!> - K U0 - C [(1 - gamma/beta) V0 + h (1 - gamma/(2 beta)) A0] + P1 + R1,
!> D = h V0 + h^2 (1/2 - beta) A0.
module time_newmark
  use assembly_forces, only: strain_product
  use assembly_system, only: system_t, multiply_mass
  use base_kinds, only: wp, zero, one, half
  use base_status, only: status_t
  use model_data, only: model_t
  use model_state, only: state_t
  use time_base, only: scheme_t, stage_t, mass_product
  use time_start, only: start_acceleration, newmark_motion
  implicit none
  private

  type, extends(scheme_t), public :: newmark_t
    real(wp) :: gamma = half
    real(wp) :: beta = 0.25_wp
    real(wp), allocatable :: d(:, :)        !< predictor D [L]
    real(wp), allocatable :: a_before(:, :) !< A0, only where the ledger needs it
  contains
    procedure :: set_step => newmark_set_step
    procedure :: start => newmark_start
    procedure :: right_side => newmark_right_side
    procedure :: update => newmark_update
    procedure :: dissipation => newmark_dissipation
    procedure :: given_motion => newmark_given_motion
  end type newmark_t

contains

  pure subroutine newmark_set_step(this, h)
    class(newmark_t), intent(inout) :: this
    real(wp), intent(in) :: h
    this%h = h
    this%stage = [stage_t(c_m=one/(this%beta*h**2), c_k=one, c_c=this%gamma/(this%beta*h), &
        rate_weight=[one - this%gamma/this%beta, h*(one - half*this%gamma/this%beta)])]
    this%weight_before = one - this%gamma
    this%weight_now = this%gamma
    this%load_work_weight = [one - this%gamma, this%gamma]
    this%dissipates = this%gamma > half .or. abs(this%beta - half*this%gamma) > zero
  end subroutine newmark_set_step

  !> A0 from M A0 = P0 - K U0 - C V0.
  subroutine newmark_start(this, model, system, state, status)
    class(newmark_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(inout) :: state
    type(status_t), intent(inout) :: status
    allocate (this%d(system%dim, system%n))
    if (this%dissipates) allocate (this%a_before(system%dim, system%n))
    call start_acceleration('NEWMARK', model, system, this%starts_in_balance, state, status)
  end subroutine newmark_start

  subroutine newmark_right_side(this, stage, system, state, b)
    class(newmark_t), intent(inout) :: this
    integer, intent(in) :: stage
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(inout) :: b(:, :)
    this%d = this%h*state%v + (this%h**2*(half - this%beta))*state%a
    call multiply_mass(system, this%stage(1)%c_m, this%d, b)
  end subroutine newmark_right_side

  !> U1 = U0 + x, A1 = (x - D)/(beta h^2), V1 = V0 + h [(1 - gamma) A0 + gamma A1].
  subroutine newmark_update(this, stage, x, state)
    class(newmark_t), intent(inout) :: this
    integer, intent(in) :: stage
    real(wp), intent(inout) :: x(:, :)
    type(state_t), intent(inout) :: state
    real(wp) :: a1
    integer :: i, k
    if (this%dissipates) this%a_before = state%a
    do i = 1, size(x, 2)
      do k = 1, size(x, 1)
        a1 = (x(k, i) - this%d(k, i))*this%stage(1)%c_m
        state%v(k, i) = state%v(k, i) &
            + this%h*((one - this%gamma)*state%a(k, i) + this%gamma*a1)
        state%a(k, i) = a1
        state%u(k, i) = state%u(k, i) + x(k, i)
      end do
    end do
  end subroutine newmark_update

  !> (gamma - 1/2) [dU K dU + c h^2 dA M dA] + c h^2 d(1/2 A M A), c = beta - gamma/2.
  real(wp) function newmark_dissipation(this, system, state)
    class(newmark_t), intent(inout) :: this
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp) :: c
    c = (this%beta - half*this%gamma)*this%h**2
    newmark_dissipation = half*c*(mass_product(system, state%a, state%a) &
        - mass_product(system, this%a_before, this%a_before))
    this%a_before = state%a - this%a_before
    newmark_dissipation = newmark_dissipation + (this%gamma - half)*(strain_product(system, &
        state%du) + c*mass_product(system, this%a_before, this%a_before))
  end function newmark_dissipation

  !> x = U1 - U0, or D + beta h^2 A1 with A1 given or from V1.
  pure real(wp) function newmark_given_motion(this, stage, state, direction, node, kind, value)
    class(newmark_t), intent(in) :: this
    integer, intent(in) :: stage
    type(state_t), intent(in) :: state
    integer, intent(in) :: direction, node, kind
    real(wp), intent(in) :: value
    newmark_given_motion = newmark_motion(this%h, this%beta, this%gamma, state, direction, &
        node, kind, value)
  end function newmark_given_motion

end module time_newmark
