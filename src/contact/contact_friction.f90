! SPDX-License-Identifier: BSD-3-Clause
!> The law of friction of a pairing: a coefficient that falls from its static value to the
!> kinetic one with the speed of slip,
!>   mu = mu_k + (mu_s - mu_k) exp(-c |v|)
!> (FS, FD, DC of the contact cards; Oden & Martins 1985).
module contact_friction
  use base_kinds, only: wp, zero
  implicit none
  private

  type, public :: friction_t
    real(wp) :: static = zero       !< mu_s
    real(wp) :: kinetic = zero      !< mu_k <= mu_s
    real(wp) :: decay = zero        !< c [T/L]
  end type friction_t

  public :: friction_varies, friction_at

contains

  !> Does the coefficient depend on the speed?
  elemental logical function friction_varies(law)
    type(friction_t), intent(in) :: law
    friction_varies = law%decay > zero .and. law%kinetic < law%static
  end function friction_varies

  !> The coefficient at a speed of slip [L/T] of either sign.
  elemental real(wp) function friction_at(law, speed)
    type(friction_t), intent(in) :: law
    real(wp), intent(in) :: speed
    friction_at = law%static
    if (friction_varies(law)) friction_at = law%kinetic &
        + (law%static - law%kinetic)*exp(-law%decay*abs(speed))
  end function friction_at

end module contact_friction
