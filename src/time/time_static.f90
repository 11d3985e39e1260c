! SPDX-License-Identifier: BSD-3-Clause
!> Statics by load steps: time is the load parameter, K x = P1 - K U0 + r, U1 = U0 + x,
!> velocities are zero. Over a step loads and reactions do the work of the mean of both ends,
!> which is exact for linear K: d(U.K U/2) = dU.(P0 + P1)/2 + dU.(r0 + r1)/2.
module time_static
  use assembly_system, only: system_t
  use base_kinds, only: wp, zero, one, half
  use base_status, only: status_t
  use model_data, only: model_t, motion_displacement
  use model_state, only: state_t
  use time_base, only: scheme_t, stage_t
  implicit none
  private

  type, extends(scheme_t), public :: static_t
  contains
    procedure :: set_step => static_set_step
    procedure :: start => static_start
    procedure :: right_side => static_right_side
    procedure :: update => static_update
    procedure :: dissipation => static_dissipation
    procedure :: given_motion => static_given_motion
  end type static_t

contains

  pure subroutine static_set_step(this, h)
    class(static_t), intent(inout) :: this
    real(wp), intent(in) :: h
    this%h = h
    this%stage = [stage_t(c_m=zero, c_k=one)]
    this%weight_before = half
    this%weight_now = half
    this%load_work_weight = [half, half]
  end subroutine static_set_step

  !> Statics has no velocities.
  subroutine static_start(this, model, system, state, status)
    class(static_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(inout) :: state
    type(status_t), intent(inout) :: status
    state%v = zero
  end subroutine static_start

  !> There is no inertia.
  subroutine static_right_side(this, stage, system, state, b)
    class(static_t), intent(inout) :: this
    integer, intent(in) :: stage
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(inout) :: b(:, :)
  end subroutine static_right_side

  subroutine static_update(this, stage, x, state)
    class(static_t), intent(inout) :: this
    integer, intent(in) :: stage
    real(wp), intent(inout) :: x(:, :)
    type(state_t), intent(inout) :: state
    state%u = state%u + x
  end subroutine static_update

  real(wp) function static_dissipation(this, system, state)
    class(static_t), intent(inout) :: this
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    static_dissipation = zero
  end function static_dissipation

  !> x = U1 - U0, or h V1 where a motion gives a velocity.
  pure real(wp) function static_given_motion(this, stage, state, direction, node, kind, value)
    class(static_t), intent(in) :: this
    integer, intent(in) :: stage
    type(state_t), intent(in) :: state
    integer, intent(in) :: direction, node, kind
    real(wp), intent(in) :: value
    static_given_motion = this%h*value
    if (kind == motion_displacement) static_given_motion = value - state%u(direction, node)
  end function static_given_motion

end module time_static
