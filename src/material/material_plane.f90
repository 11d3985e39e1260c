! SPDX-License-Identifier: BSD-3-Clause
!> Laws at finite strain with the strains that an element has: six in space; E11, E22, 2 E12 in
!> the plane.
module material_plane
  use base_kinds, only: wp, zero
  use material_base, only: material_t, in_space
  implicit none
  private
  public :: respond_as

  !> Places in (E11, E22, E33, 2 E12, 2 E23, 2 E31) of the strains in the plane.
  integer, parameter :: in_plane(3) = [1, 2, 4]

contains

  !> The law of a material (material_base) for the strains e (6 in space, 3 in the plane):
  !> stress s, moduli d where asked for, energy per reference volume [F/L2], history new. Plane
  !> strain has E33 = 0.
  pure subroutine respond_as(material, plane, e, old, with_moduli, s, d, energy, new)
    class(material_t), intent(in) :: material
    integer, intent(in) :: plane
    real(wp), intent(in) :: e(:), old(:)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: s(:), d(:, :), energy, new(:)
    real(wp) :: whole_e(6), whole_s(6), whole_d(6, 6)
    if (plane == in_space) then
      call material%respond(e, old, with_moduli, s, d, energy, new)
      return
    end if
    whole_e = zero
    whole_e(in_plane) = e
    call material%respond(whole_e, old, with_moduli, whole_s, whole_d, energy, new)
    s = whole_s(in_plane)
    if (with_moduli) d = whole_d(in_plane, in_plane)
  end subroutine respond_as

end module material_plane
