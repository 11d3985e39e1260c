! SPDX-License-Identifier: BSD-3-Clause
!> What isotropic laws share: the moduli of small strains, which E and nu give.
module material_isotropic
  use base_kinds, only: wp, zero, one, two, half
  use material_base, only: material_t, plane_stress, in_space, axisymmetric, strains_in
  implicit none
  private

  !> A law with the moduli of Hooke's where there is no strain.
  type, abstract, extends(material_t), public :: isotropic_t
    real(wp) :: young = 0.0_wp     !< E [F/L2]
    real(wp) :: poisson = 0.0_wp   !< nu
  contains
    procedure :: moduli => isotropic_moduli
    procedure :: wave_speed => isotropic_wave_speed
    procedure :: out_of_plane_stress => isotropic_stress_across
  end type isotropic_t

contains

  !> Hooke's law (Zienkiewicz & Taylor 2000, vol. 1, 4.2).
  pure function isotropic_moduli(this, plane) result(d)
    class(isotropic_t), intent(in) :: this
    integer, intent(in) :: plane
    real(wp) :: d(strains_in(plane), strains_in(plane))
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
    if (plane /= axisymmetric) return
    d(4, 4) = axial
    d(4, :2) = ratio*axial
    d(:2, 4) = ratio*axial
  end function isotropic_moduli

  !> c_p: (lambda + 2G)/rho in space and plane strain, E/(rho(1 - nu^2)) in plane stress.
  pure function isotropic_wave_speed(this, plane) result(c)
    class(isotropic_t), intent(in) :: this
    integer, intent(in) :: plane
    real(wp) :: d(strains_in(plane), strains_in(plane))
    real(wp) :: c
    d = this%moduli(plane)
    c = sqrt(d(1, 1)/this%density)
  end function isotropic_wave_speed

  !> Plane stress: none; plane strain: nu (sxx + syy).
  pure function isotropic_stress_across(this, plane, stress) result(szz)
    class(isotropic_t), intent(in) :: this
    integer, intent(in) :: plane
    real(wp), intent(in) :: stress(3)
    real(wp) :: szz
    szz = zero
    if (plane /= plane_stress) szz = this%poisson*(stress(1) + stress(2))
  end function isotropic_stress_across

end module material_isotropic
