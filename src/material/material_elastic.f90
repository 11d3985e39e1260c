! SPDX-License-Identifier: BSD-3-Clause
!> Linear elastic, isotropic material.
module material_elastic
  use base_kinds, only: wp, zero, one, two, half
  use material_base, only: material_t, plane_stress, in_space
  implicit none
  private

  type, extends(material_t), public :: elastic_t
    real(wp) :: young = 0.0_wp     !< E [F/L2]
    real(wp) :: poisson = 0.0_wp   !< nu
  contains
    procedure :: moduli => elastic_moduli
    procedure :: wave_speed => elastic_wave_speed
    procedure :: out_of_plane_stress => elastic_stress_across
    procedure :: respond => elastic_response
  end type elastic_t

contains

  !> Hooke's law (Zienkiewicz & Taylor 2000, vol. 1, 4.2).
  pure function elastic_moduli(this, plane) result(d)
    class(elastic_t), intent(in) :: this
    integer, intent(in) :: plane
    real(wp) :: d(merge(6, 3, plane == in_space), merge(6, 3, plane == in_space))
    real(wp) :: axial, ratio
    integer :: k
    if (plane == plane_stress) then
      axial = this%young/(one - this%poisson**2)
      ratio = this%poisson
    else
      axial = this%young*(one - this%poisson)/((one + this%poisson)*(one - two*this%poisson))
      ratio = this%poisson/(one - this%poisson)
    end if
    d = zero
    if (plane == in_space) then
      d(:3, :3) = ratio*axial
      do k = 1, 3
        d(k, k) = axial
        d(3 + k, 3 + k) = half*this%young/(one + this%poisson)
      end do
      return
    end if
    d(1, 1) = axial
    d(2, 2) = axial
    d(1, 2) = ratio*axial
    d(2, 1) = ratio*axial
    d(3, 3) = half*this%young/(one + this%poisson)
  end function elastic_moduli

  !> c_p: (lambda + 2G)/rho in space and plane strain, E/(rho(1 - nu^2)) in plane stress.
  pure function elastic_wave_speed(this, plane) result(c)
    class(elastic_t), intent(in) :: this
    integer, intent(in) :: plane
    real(wp) :: d(merge(6, 3, plane == in_space), merge(6, 3, plane == in_space))
    real(wp) :: c
    d = this%moduli(plane)
    c = sqrt(d(1, 1)/this%density)
  end function elastic_wave_speed

  !> Plane stress: none; plane strain: nu (sxx + syy).
  pure function elastic_stress_across(this, plane, stress) result(szz)
    class(elastic_t), intent(in) :: this
    integer, intent(in) :: plane
    real(wp), intent(in) :: stress(3)
    real(wp) :: szz
    szz = zero
    if (plane /= plane_stress) szz = this%poisson*(stress(1) + stress(2))
  end function elastic_stress_across

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
