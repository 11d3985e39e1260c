! SPDX-License-Identifier: BSD-3-Clause
!> Rubber of Blatz and Ko: the compressible neo-Hookean law with nu = 0.463.
module material_blatz_rubber
  use base_kinds, only: wp, one, two, half
  use material_base, only: leave_undefined
  use material_isotropic, only: isotropic_t
  use material_tensor, only: measures_t, measures_of, outer, circle, exp_minus_one, &
      exp_excess, log_excess
  implicit none
  private
  real(wp), parameter :: nu = 0.463_wp
  real(wp), parameter :: b = two*nu/(one - two*nu)

  type, extends(isotropic_t), public :: blatz_rubber_t
    real(wp) :: shear = 0.0_wp   !< G [F/L2]
  contains
    procedure :: respond => blatz_rubber_response
  end type blatz_rubber_t

  public :: new_blatz_rubber

contains

  !> The material from density [M/L3] and shear modulus [F/L2].
  pure function new_blatz_rubber(id, density, shear) result(material)
    integer, intent(in) :: id
    real(wp), intent(in) :: density, shear
    type(blatz_rubber_t) :: material
    material = blatz_rubber_t(id=id, density=density, shear=shear, poisson=nu, &
        young=two*shear*(one + nu), is_linear=.false., is_finite=.true., &
        mean_dilatation=.true.)
  end function new_blatz_rubber

  !> W = G/2 (I1 - 3 + 2/b (J^-b - 1)), S = G (I - J^-b C^-1), b = 2 nu/(1 - 2 nu) (Blatz & Ko
  !> 1962; Holzapfel 2000, 6.5, for f = 1). Written so that W and S vanish with E to the last
  !> digits: the terms of first order cancel before they are computed.
  pure subroutine blatz_rubber_response(this, e, old, with_moduli, s, d, energy, new)
    class(blatz_rubber_t), intent(in) :: this
    real(wp), intent(in) :: e(6), old(:)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: s(6), d(6, 6), energy, new(:)
    type(measures_t) :: q
    real(wp) :: power
    new = old
    q = measures_of(e)
    if (.not. q%exists) then
      call leave_undefined(s, d, energy)
      return
    end if
    power = exp_minus_one(-b*q%log_volume)
    s = -this%shear*(q%change + power*q%inverse)
    energy = half*this%shear*(log_excess(q%j) - 4.0_wp*q%i2 - 8.0_wp*q%i3 &
        + two/b*exp_excess(-b*q%log_volume))
    if (with_moduli) d = this%shear*(one + power)*(b*outer(q%inverse, q%inverse) &
        + two*circle(q%inverse))
  end subroutine blatz_rubber_response

end module material_blatz_rubber
