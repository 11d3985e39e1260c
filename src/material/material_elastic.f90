! SPDX-License-Identifier: BSD-3-Clause
!> Linear elastic, isotropic material; at finite strain the law of St Venant and Kirchhoff.
module material_elastic
  use base_kinds, only: wp, one, two, half
  use material_base, only: in_space
  use material_isotropic, only: isotropic_t
  implicit none
  private

  type, extends(isotropic_t), public :: elastic_t
  contains
    procedure :: respond => elastic_response
  end type elastic_t

  public :: new_elastic

contains

  !> The material from density [M/L3], E [F/L2] and nu. Under compression the nominal stress of
  !> a bar of this law has its peak at stretch 1/sqrt(3): beyond, elements collapse.
  pure function new_elastic(id, density, young, nu) result(material)
    integer, intent(in) :: id
    real(wp), intent(in) :: density, young, nu
    type(elastic_t) :: material
    material = elastic_t(id=id, density=density, young=young, poisson=nu, is_finite=.true., &
        is_quadratic=.true., doubtful_stretch=0.75_wp, least_stretch=0.6_wp)
  end function new_elastic

  !> St Venant and Kirchhoff: W = lambda/2 (tr E)^2 + G E:E, S = lambda tr E I + 2 G E.
  pure subroutine elastic_response(this, e, old, with_moduli, s, d, energy, new)
    class(elastic_t), intent(in) :: this
    real(wp), intent(in) :: e(6), old(:)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: s(6), d(6, 6), energy, new(:)
    real(wp) :: shear, pressure
    shear = half*this%young/(one + this%poisson)
    pressure = two*shear*this%poisson/(one - two*this%poisson)*(e(1) + e(2) + e(3))
    s(:3) = two*shear*e(:3) + pressure
    s(4:) = shear*e(4:)
    energy = half*dot_product(s, e)
    new = old
    if (with_moduli) d = this%moduli(in_space)
  end subroutine elastic_response

end module material_elastic
