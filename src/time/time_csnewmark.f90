! SPDX-License-Identifier: BSD-3-Clause
!> CSNEWMARK: the contact-stabilised Newmark method (Deuflhard, Krause & Ertel 2008). Stage 1
!> projects the predictor h V0 onto what may be reached, without friction:
!>   [M/h^2] xp = M V0/h + H' l,  gap at U0 + xp >= 0.
!> Stage 2 is the mid-point rule from there:
!>   [2 M/h^2 + C/h + K/2] x = 2 M xp/h^2 + (P0 + P1)/2 - K U0 - C (V0 - xp/h) + H' r,
!>   U1 = U0 + x, V1 = V0 + 2 (x - xp)/h.
!> Bodies feel r alone; the energy changes by r.H dU - l.H h dV besides the loads.
module time_csnewmark
  use assembly_system, only: system_t, multiply_mass
  use base_kinds, only: wp, zero, half, one
  use base_status, only: status_t
  use contact_rule, only: contact_rule_t
  use model_data, only: model_t, motion_displacement
  use model_state, only: state_t
  use time_base, only: scheme_t, stage_t, make_stage_work
  implicit none
  private

  type, extends(scheme_t), public :: csnewmark_t
    real(wp), allocatable :: xp(:, :)   !< (dim, n) predictor that contact allows [L]
  contains
    procedure :: set_step => csnewmark_set_step
    procedure :: start => csnewmark_start
    procedure :: right_side => csnewmark_right_side
    procedure :: update => csnewmark_update
    procedure :: dissipation => csnewmark_dissipation
    procedure :: given_motion => csnewmark_given_motion
  end type csnewmark_t

contains

  pure subroutine csnewmark_set_step(this, h)
    class(csnewmark_t), intent(inout) :: this
    real(wp), intent(in) :: h
    this%h = h
    this%stage = [ &
        stage_t(c_m=one/h**2, load_weight=[zero, zero], force_weight=zero, moves=.false., &
        rule=contact_rule_t(is_frictionless=.true.)), &
        stage_t(c_m=2.0_wp/h**2, c_k=half, load_weight=[half, half], c_c=one/h, &
        rate_weight=[one, zero])]
    this%load_work_weight = [half, half]
  end subroutine csnewmark_set_step

  subroutine csnewmark_start(this, model, system, state, status)
    class(csnewmark_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(inout) :: state
    type(status_t), intent(inout) :: status
    allocate (this%xp(system%dim, system%n))
    this%xp = zero
    if (allocated(system%damping)) allocate (this%rate(system%dim, system%n), source=zero)
    call make_stage_work(system, this%stage_work)
  end subroutine csnewmark_start

  subroutine csnewmark_right_side(this, stage, system, state, b)
    class(csnewmark_t), intent(inout) :: this
    integer, intent(in) :: stage
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(inout) :: b(:, :)
    if (stage == 1) then
      call multiply_mass(system, one/this%h, state%v, b)
    else
      call multiply_mass(system, 2.0_wp/this%h**2, this%xp, b)
    end if
  end subroutine csnewmark_right_side

  !> Forces l do work on -h dV, forces r on dU.
  subroutine csnewmark_update(this, stage, x, state)
    class(csnewmark_t), intent(inout) :: this
    integer, intent(in) :: stage
    real(wp), intent(inout) :: x(:, :)
    type(state_t), intent(inout) :: state
    if (stage == 1) then
      this%xp = x
      if (allocated(this%rate)) this%rate = -x/this%h
    else
      this%stage_work(1)%x = 2.0_wp*(this%xp - x)
      this%stage_work(2)%x = x
      state%u = state%u + x
      state%v = state%v - this%stage_work(1)%x/this%h
    end if
  end subroutine csnewmark_update

  real(wp) function csnewmark_dissipation(this, system, state)
    class(csnewmark_t), intent(inout) :: this
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    csnewmark_dissipation = zero
  end function csnewmark_dissipation

  !> xp = h V0; x = U1 - U0, or h (V0 + V1)/2.
  pure real(wp) function csnewmark_given_motion(this, stage, state, direction, node, kind, &
      value)
    class(csnewmark_t), intent(in) :: this
    integer, intent(in) :: stage
    type(state_t), intent(in) :: state
    integer, intent(in) :: direction, node, kind
    real(wp), intent(in) :: value
    csnewmark_given_motion = this%h*state%v(direction, node)
    if (stage == 1) return
    if (kind == motion_displacement) then
      csnewmark_given_motion = value - state%u(direction, node)
    else
      csnewmark_given_motion = half*this%h*(state%v(direction, node) + value)
    end if
  end function csnewmark_given_motion

end module time_csnewmark
