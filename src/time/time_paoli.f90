! SPDX-License-Identifier: BSD-3-Clause
!> PAOLI: the central difference with contact on positions (Paoli & Schatzman 1993), explicit
!> with beta = 0, or with beta = 1/4, implicit (our choice). State: U_n and
!> V- = (U_n - U_{n-1})/h.
!>   [M/h^2 + beta K] x = M V-/h + P_n - K (U_n - beta h V-) + r,  U_{n+1} = U_n + x,  V+ = x/h,
!> the gap at U_{n+1} is not negative. With beta = 1/4, two steps of the theta-method at
!> theta = xi = 1/2 with their mean contact force are one of this: that mean obeys the law of
!> contact, and does not alternate. In the first step V- is V0 and half the forces act. Forces
!> do work on w = h (V- + V+)/2; the energy V+.M V+/2 + Um.K Um/2 + (beta - 1/4) x.K x/2,
!> Um = U_n + x/2, changes by it alone.
module time_paoli
  use assembly_forces, only: subtract_internal_force
  use assembly_system, only: system_t, multiply_mass
  use base_kinds, only: wp, zero, one, half
  use base_status, only: status_t
  use model_data, only: model_t, motion_displacement
  use model_state, only: state_t
  use time_base, only: scheme_t, stage_t
  implicit none
  private

  type, extends(scheme_t), public :: paoli_t
    real(wp) :: beta = 0.25_wp
    logical :: is_first = .true.
    real(wp), allocatable :: ku(:, :), kv(:, :), v_start(:, :)   !< K U0, K V0, V0: first step
  contains
    procedure :: begin_step => paoli_begin_step
    procedure :: set_step => paoli_set_step
    procedure :: start => paoli_start
    procedure :: right_side => paoli_right_side
    procedure :: update => paoli_update
    procedure :: dissipation => paoli_dissipation
    procedure :: given_motion => paoli_given_motion
  end type paoli_t

contains

  subroutine paoli_begin_step(this, cycle)
    class(paoli_t), intent(inout) :: this
    integer, intent(in) :: cycle
    if (this%is_first .neqv. cycle == 0) then
      this%is_first = cycle == 0
      call this%set_step(this%h)
    end if
  end subroutine paoli_begin_step

  !> The matrix is the same in the first step.
  pure subroutine paoli_set_step(this, h)
    class(paoli_t), intent(inout) :: this
    real(wp), intent(in) :: h
    real(wp) :: share
    this%h = h
    share = merge(half, one, this%is_first)
    this%stage = [stage_t(c_m=one/h**2, c_k=this%beta, contact_factor=share, &
        load_weight=[share, zero], force_weight=share, force_lead=-this%beta*h/share)]
    this%weight_now = share
    this%load_work_weight = [share, zero]
    this%staggered%on = .true.
    this%staggered%share = this%beta - 0.25_wp
    this%dissipates = .true.
  end subroutine paoli_set_step

  subroutine paoli_start(this, model, system, state, status)
    class(paoli_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(inout) :: state
    type(status_t), intent(inout) :: status
    allocate (this%conjugate(2, system%n), this%ku(2, system%n), this%kv(2, system%n))
    this%conjugate = zero
    this%ku = zero
    this%kv = zero
    call subtract_internal_force(system, -one, state%u, this%ku)
    call subtract_internal_force(system, -one, state%v, this%kv)
    this%v_start = state%v
  end subroutine paoli_start

  subroutine paoli_right_side(this, stage, system, state, b)
    class(paoli_t), intent(inout) :: this
    integer, intent(in) :: stage
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(inout) :: b(:, :)
    call multiply_mass(system, one/this%h, state%v, b)
  end subroutine paoli_right_side

  !> V+ = x/h, U_{n+1} = U_n + h V+, w = h (V- + V+)/2.
  subroutine paoli_update(this, stage, x, state)
    class(paoli_t), intent(inout) :: this
    integer, intent(in) :: stage
    real(wp), intent(inout) :: x(:, :)
    type(state_t), intent(inout) :: state
    real(wp) :: v
    integer :: i, k
    do i = 1, size(x, 2)
      do k = 1, 2
        v = x(k, i)/this%h
        this%conjugate(k, i) = half*this%h*(state%v(k, i) + v)
        state%u(k, i) = state%u(k, i) + x(k, i)
        state%v(k, i) = v
      end do
    end do
  end subroutine paoli_update

  !> Only in the first step: what the energy at t = 0 has more than that of the scheme before,
  !> h U0.K V0/2 - beta h^2 V0.K V0/2 - w.K U0/2.
  real(wp) function paoli_dissipation(this, system, state)
    class(paoli_t), intent(inout) :: this
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    paoli_dissipation = zero
    if (.not. this%is_first) return
    paoli_dissipation = half*this%h*sum(this%v_start*this%ku) &
        - half*this%beta*this%h**2*sum(this%v_start*this%kv) - half*sum(this%conjugate*this%ku)
  end function paoli_dissipation

  !> x = h V+, V+ given or from U_{n+1}.
  pure real(wp) function paoli_given_motion(this, state, direction, node, kind, value)
    class(paoli_t), intent(in) :: this
    type(state_t), intent(in) :: state
    integer, intent(in) :: direction, node, kind
    real(wp), intent(in) :: value
    paoli_given_motion = this%h*value
    if (kind == motion_displacement) &
        paoli_given_motion = value - state%u(direction, node)
  end function paoli_given_motion

end module time_paoli
