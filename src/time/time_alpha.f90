! SPDX-License-Identifier: BSD-3-Clause
!> HHT (Hilber, Hughes & Taylor 1977) and the generalised alpha-method (Chung & Hulbert 1993).
!>   M [(1 - am) A1 + am A0] + K [(1 - af) U1 + af U0] = (1 - af) P1 + af P0 + R1,
!> U1, V1 by Newmark with gamma = 1/2 - am + af, beta = (gamma + 1/2)^2/4. The contact force
!> R1 is NOT averaged like the loads: it acts with weight 1, else the schemes gain energy on
!> impact.
!> C V is averaged like K U.
!> One stage: [k M + (1 - af) (gamma C/(beta h) + K)] x = M (k D - am A0) - K U0 + (1 - af) P1 +
!> af P0 - C {[1 - (1 - af) gamma/beta] V0 + (1 - af) h [1 - gamma/(2 beta)] A0} + R1 with
!> k = (1 - am)/(beta h^2), D = h V0 + h^2 (1/2 - beta) A0. At am = af = 1/2 (rho = 1) it is the
!> theta-method at theta = xi = 1/2.
module time_alpha
  use assembly_forces, only: strain_product
  use assembly_system, only: system_t, multiply_mass
  use base_kinds, only: wp, zero, one, half
  use base_status, only: status_t
  use model_data, only: model_t, motion_velocity, motion_displacement
  use model_state, only: state_t
  use time_base, only: scheme_t, stage_t, mass_product
  use time_start, only: start_acceleration
  implicit none
  private

  type, extends(scheme_t), public :: alpha_t
    real(wp) :: am = zero
    real(wp) :: af = zero
    real(wp) :: gamma = half
    real(wp) :: beta = 0.25_wp
    real(wp), allocatable :: d(:, :)        !< k D - am A0, then its part D [L]
    real(wp), allocatable :: a_before(:, :) !< A0, then A1 - A0 [L/T2]
  contains
    procedure :: set_step => alpha_set_step
    procedure :: start => alpha_start
    procedure :: right_side => alpha_right_side
    procedure :: update => alpha_update
    procedure :: dissipation => alpha_dissipation
    procedure :: given_motion => alpha_given_motion
  end type alpha_t

  public :: hht, generalised_alpha

contains

  !> HHT for alpha in [-1/3, 0).
  pure type(alpha_t) function hht(alpha)
    real(wp), intent(in) :: alpha
    hht = alpha_t(am=zero, af=-alpha, gamma=half - alpha, beta=(one - alpha)**2/4.0_wp)
  end function hht

  !> The generalised alpha-method for rho in [0, 1], the spectral radius at infinite frequency.
  pure type(alpha_t) function generalised_alpha(rho)
    real(wp), intent(in) :: rho
    real(wp) :: am, af, gamma
    am = (2.0_wp*rho - one)/(rho + one)
    af = rho/(rho + one)
    gamma = half - am + af
    generalised_alpha = alpha_t(am=am, af=af, gamma=gamma, beta=(gamma + half)**2/4.0_wp)
  end function generalised_alpha

  pure subroutine alpha_set_step(this, h)
    class(alpha_t), intent(inout) :: this
    real(wp), intent(in) :: h
    real(wp) :: rate
    this%h = h
    rate = (one - this%af)*this%gamma/this%beta
    this%stage = [stage_t(c_m=(one - this%am)/(this%beta*h**2), c_k=one - this%af, &
        load_weight=[this%af, one - this%af], c_c=rate/h, &
        rate_weight=[one - rate, h*(one - this%af - half*rate)])]
    this%load_work_weight = [this%af, one - this%af]
    this%dissipates = .true.
  end subroutine alpha_set_step

  subroutine alpha_start(this, model, system, state, status)
    class(alpha_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(inout) :: state
    type(status_t), intent(inout) :: status
    allocate (this%d(2, system%n), this%a_before(2, system%n))
    this%a_before = zero
    call start_acceleration(trim(this%name), model, system, this%starts_in_balance, state, &
        status)
  end subroutine alpha_start

  subroutine alpha_right_side(this, stage, system, state, b)
    class(alpha_t), intent(inout) :: this
    integer, intent(in) :: stage
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(inout) :: b(:, :)
    real(wp) :: k
    k = this%stage(stage)%c_m
    this%d = k*(this%h*state%v) + (k*this%h**2*(half - this%beta) - this%am)*state%a
    call multiply_mass(system, one, this%d, b)
  end subroutine alpha_right_side

  !> U1 = U0 + x, A1 = (x - D)/(beta h^2), V1 = V0 + h [(1 - gamma) A0 + gamma A1].
  subroutine alpha_update(this, stage, x, state)
    class(alpha_t), intent(inout) :: this
    integer, intent(in) :: stage
    real(wp), intent(inout) :: x(:, :)
    type(state_t), intent(inout) :: state
    real(wp) :: d, a1
    integer :: i, k
    this%a_before = state%a
    do i = 1, size(x, 2)
      do k = 1, 2
        d = this%h*state%v(k, i) + this%h**2*(half - this%beta)*state%a(k, i)
        a1 = (x(k, i) - d)/(this%beta*this%h**2)
        state%v(k, i) = state%v(k, i) &
            + this%h*((one - this%gamma)*state%a(k, i) + this%gamma*a1)
        state%a(k, i) = a1
        state%u(k, i) = state%u(k, i) + x(k, i)
      end do
    end do
  end subroutine alpha_update

  !> (1/2 - af) dU.K dU - (gamma - 1 + am) dU.M dA + c h^2 d(A.M A/2) + c (gamma - 1/2) h^2
  !> dA.M dA, c = beta - gamma/2. The first two terms nearly cancel where waves are resolved.
  real(wp) function alpha_dissipation(this, system, state)
    class(alpha_t), intent(inout) :: this
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp) :: c
    c = (this%beta - half*this%gamma)*this%h**2
    alpha_dissipation = half*c*(mass_product(system, state%a, state%a) &
        - mass_product(system, this%a_before, this%a_before))
    this%a_before = state%a - this%a_before
    alpha_dissipation = alpha_dissipation + (half - this%af)*strain_product(system, state%du) &
        + c*(this%gamma - half)*mass_product(system, this%a_before, this%a_before) &
        - (this%gamma - one + this%am)*mass_product(system, state%du, this%a_before)
  end function alpha_dissipation

  !> x = U1 - U0, or D + beta h^2 A1 with A1 given or from V1.
  pure real(wp) function alpha_given_motion(this, stage, state, direction, node, kind, value)
    class(alpha_t), intent(in) :: this
    integer, intent(in) :: stage
    type(state_t), intent(in) :: state
    integer, intent(in) :: direction, node, kind
    real(wp), intent(in) :: value
    real(wp) :: a1
    associate (v0 => state%v(direction, node), a0 => state%a(direction, node), h => this%h)
      if (kind == motion_displacement) then
        alpha_given_motion = value - state%u(direction, node)
        return
      end if
      a1 = value
      if (kind == motion_velocity) a1 = ((value - v0)/h - (one - this%gamma)*a0)/this%gamma
      alpha_given_motion = h*v0 + h**2*((half - this%beta)*a0 + this%beta*a1)
    end associate
  end function alpha_given_motion

end module time_alpha
