! SPDX-License-Identifier: BSD-3-Clause
!> Foam rubber of Blatz and Ko, with nu = 0.25.
module material_blatz_foam
  use base_kinds, only: wp, one, two, half
  use material_base, only: leave_undefined
  use material_isotropic, only: isotropic_t
  use material_tensor, only: measures_t, measures_of, outer, circle, circle_sum, square, &
      exp_minus_one, exp_excess, log_excess
  implicit none
  private
  real(wp), parameter :: nu = 0.25_wp

  type, extends(isotropic_t), public :: blatz_foam_t
    real(wp) :: shear = 0.0_wp   !< G [F/L2]
  contains
    procedure :: respond => blatz_foam_response
  end type blatz_foam_t

  public :: new_blatz_foam

contains

  !> The material from density [M/L3] and shear modulus [F/L2].
  pure function new_blatz_foam(id, density, shear) result(material)
    integer, intent(in) :: id
    real(wp), intent(in) :: density, shear
    type(blatz_foam_t) :: material
    material = blatz_foam_t(id=id, density=density, shear=shear, poisson=nu, &
        young=two*shear*(one + nu), is_linear=.false., is_finite=.true.)
  end function new_blatz_foam

  !> W = G/2 (tr C^-1 + 2 J - 5), S = G (J C^-1 - C^-2) (Blatz & Ko 1962; Holzapfel 2000, 6.5,
  !> for f = 0). Terms of first order are taken out: tr C^-1 - 3 = (4 i1 + 4 i2 - 3 j)/(1 + j),
  !> 2 J - 2 = j - (j - ln(1 + j)) + 2 (J - 1 - ln J).
  pure subroutine blatz_foam_response(this, e, old, with_moduli, s, d, energy, new)
    class(blatz_foam_t), intent(in) :: this
    real(wp), intent(in) :: e(6), old(:)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: s(6), d(6, 6), energy, new(:)
    type(measures_t) :: q
    real(wp) :: growth
    new = old
    q = measures_of(e)
    if (.not. q%exists) then
      call leave_undefined(s, d, energy)
      return
    end if
    growth = exp_minus_one(q%log_volume)
    s = this%shear*(growth*q%inverse - q%change - square(q%change))
    energy = half*this%shear*((q%j**2 - 4.0_wp*q%i2 - 16.0_wp*q%i3)/(one + q%j) &
        - log_excess(q%j) + two*exp_excess(q%log_volume))
    if (with_moduli) d = this%shear*((one + growth)*(outer(q%inverse, q%inverse) &
        - two*circle(q%inverse)) + two*circle_sum(q%inverse, square(q%inverse)))
  end subroutine blatz_foam_response

end module material_blatz_foam
