! SPDX-License-Identifier: BSD-3-Clause
!> What a stage of a time scheme asks of contact. The unknown x of a stage is a motion [L] and
!> its multipliers are forces [F], also where the law is one of velocities: with x = before V +
!> now V1 the velocity v1 + e v of a row, times `now`, is H x + (now e - before) v, V the
!> velocity at the start of the stage. Contact knows nothing else of the scheme.
module contact_rule
  use base_kinds, only: wp, zero, one
  implicit none
  private

  !> On positions u_n = gap at the end, u_t = slip of the step, and all rows act. On velocities
  !> u = now (v1 + e v): those rows act whose gap + lead v_n is not positive (level_velocity),
  !> or those that were pressed in the stage before (level_pressed).
  integer, parameter, public :: level_position = 1, level_velocity = 2, level_pressed = 3

  type, public :: contact_rule_t
    integer :: level = level_position
    !> Multiplier of H' in A x = b + factor H' r; r is the force that tables and works take.
    real(wp) :: factor = one
    logical :: is_frictionless = .false.
    !> On velocities as above; on positions the time since the state before, to whose gap
    !> restitution looks back [T].
    real(wp) :: lead = zero
    real(wp) :: before = zero, now = one   !< [T]
    !> e is at least this in normal direction where v_n > 0: then the normal work is never
    !> positive.
    real(wp) :: safe_share = zero
  end type contact_rule_t

end module contact_rule
