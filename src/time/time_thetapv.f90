! SPDX-License-Identifier: BSD-3-Clause
!> THETAPV: the theta-method at theta = xi = 1/2, then a projection of the velocities: where the
!> step has pressed, V1 becomes the velocity nearest in M that does not approach,
!>   M (V1' - V1) = H' p,  v1'n >= 0 complementary to p.
!> Second stage: x = h (V1' - V1), [M/h^2] x = H' r, r = p/h. It removes the alternation of
!> forces at theta = 1/2 and leaves displacements as they are; the force of the step is the sum
!> of both.
module time_thetapv
  use base_kinds, only: wp, zero, half, one
  use base_status, only: status_t
  use assembly_system, only: system_t
  use contact_rule, only: contact_rule_t, level_pressed
  use model_data, only: model_t
  use model_state, only: state_t
  use time_base, only: stage_t, make_stage_work
  use time_theta, only: theta_t
  implicit none
  private

  type, extends(theta_t), public :: thetapv_t
  contains
    procedure :: set_step => thetapv_set_step
    procedure :: start => thetapv_start
    procedure :: right_side => thetapv_right_side
    procedure :: update => thetapv_update
    procedure :: given_motion => thetapv_given_motion
  end type thetapv_t

contains

  pure subroutine thetapv_set_step(this, h)
    class(thetapv_t), intent(inout) :: this
    real(wp), intent(in) :: h
    call this%theta_t%set_step(h)
    this%stage = [this%stage(1), stage_t(c_m=one/h**2, load_weight=[zero, zero], &
        force_weight=zero, moves=.false., only_in_contact=.true., &
        rule=contact_rule_t(level=level_pressed, before=-h, now=zero))]
    this%adds_reactions = .true.
  end subroutine thetapv_set_step

  subroutine thetapv_start(this, model, system, state, status)
    class(thetapv_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(inout) :: state
    type(status_t), intent(inout) :: status
    call this%theta_t%start(model, system, state, status)
    call make_stage_work(system, this%stage_work)
  end subroutine thetapv_start

  !> The projection starts from V1: nothing is on its right-hand side but impulses.
  subroutine thetapv_right_side(this, stage, system, state, b)
    class(thetapv_t), intent(inout) :: this
    integer, intent(in) :: stage
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(inout) :: b(:, :)
    if (stage == 1) call this%theta_t%right_side(stage, system, state, b)
  end subroutine thetapv_right_side

  !> Forces of the first stage do work on dU, those of the second on h (V1 + V1')/2; of their
  !> sum, which the rows hold, the second motion is taken, so that the first is the rest.
  subroutine thetapv_update(this, stage, x, state)
    class(thetapv_t), intent(inout) :: this
    integer, intent(in) :: stage
    real(wp), intent(inout) :: x(:, :)
    type(state_t), intent(inout) :: state
    if (stage == 1) then
      call this%theta_t%update(stage, x, state)
      this%stage_work(1)%x = zero
      this%stage_work(2)%x = x
    else
      this%stage_work(1)%x = this%stage_work(2)%x
      this%stage_work(2)%x = this%h*state%v + half*x
      this%stage_work(1)%x = this%stage_work(1)%x - this%stage_work(2)%x
      state%v = state%v + x/this%h
    end if
  end subroutine thetapv_update

  !> Given motions are those of the first stage: the second leaves their velocities alone.
  pure real(wp) function thetapv_given_motion(this, stage, state, direction, node, kind, value)
    class(thetapv_t), intent(in) :: this
    integer, intent(in) :: stage
    type(state_t), intent(in) :: state
    integer, intent(in) :: direction, node, kind
    real(wp), intent(in) :: value
    thetapv_given_motion = zero
    if (stage == 1) thetapv_given_motion = this%theta_t%given_motion(stage, state, direction, &
        node, kind, value)
  end function thetapv_given_motion

end module time_thetapv
