! SPDX-License-Identifier: BSD-3-Clause
!> The material of rigid parts: a density. Their elements have no stiffness, for they are never
!> strained.
module material_rigid
  use base_kinds, only: wp, zero
  use material_base, only: material_t, strains_in
  implicit none
  private

  type, extends(material_t), public :: rigid_material_t
  contains
    procedure :: moduli => rigid_moduli
    procedure :: wave_speed => rigid_wave_speed
    procedure :: out_of_plane_stress => rigid_stress_across
  end type rigid_material_t

contains

  pure function rigid_moduli(this, plane) result(d)
    class(rigid_material_t), intent(in) :: this
    integer, intent(in) :: plane
    real(wp) :: d(strains_in(plane), strains_in(plane))
    d = zero
  end function rigid_moduli

  pure function rigid_wave_speed(this, plane) result(c)
    class(rigid_material_t), intent(in) :: this
    integer, intent(in) :: plane
    real(wp) :: c
    c = zero
  end function rigid_wave_speed

  pure function rigid_stress_across(this, plane, stress) result(szz)
    class(rigid_material_t), intent(in) :: this
    integer, intent(in) :: plane
    real(wp), intent(in) :: stress(3)
    real(wp) :: szz
    szz = zero
  end function rigid_stress_across

end module material_rigid
