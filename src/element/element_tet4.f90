! SPDX-License-Identifier: BSD-3-Clause
!> The tetrahedron of constant strain.
module element_tet4
  use base_kinds, only: wp, zero, one
  use element_base, only: element_t
  implicit none
  private

  type, extends(element_t), public :: tet4_t
  contains
    procedure :: shape => tet4_shape
    procedure :: rule => tet4_rule
    procedure :: mass_rule => tet4_mass_rule
  end type tet4_t

  integer, parameter, public :: tet_face(3, 4) = &
      reshape([1, 3, 2, 1, 2, 4, 2, 3, 4, 1, 4, 3], [3, 4])

  public :: new_tet4, four_points

contains

  !> Its data.
  pure function new_tet4() result(element)
    type(tet4_t) :: element
    element = tet4_t(name='TET4', dim=3, nodes=4, vtk=10, face=tet_face)
  end function new_tet4

  !> Volume coordinates; xi are those of nodes 2 to 4.
  pure subroutine tet4_shape(this, xi, n, dn)
    class(tet4_t), intent(in) :: this
    real(wp), intent(in) :: xi(:)
    real(wp), intent(out) :: n(:), dn(:, :)
    integer :: i
    n = [one - xi(1) - xi(2) - xi(3), xi(1), xi(2), xi(3)]
    dn = zero
    dn(1, :) = -one
    do i = 1, 3
      dn(i + 1, i) = one
    end do
  end subroutine tet4_shape

  pure subroutine tet4_rule(this, points, xi, w)
    class(tet4_t), intent(in) :: this
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    points = 1
    xi(1:3, 1) = 0.25_wp
    w(1) = one/6.0_wp
  end subroutine tet4_rule

  pure subroutine tet4_mass_rule(this, a, points, xi, w)
    class(tet4_t), intent(in) :: this
    real(wp), intent(in) :: a(:)
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    call four_points(points, xi, w)
  end subroutine tet4_mass_rule

  !> Exact to degree 2 (Zienkiewicz & Taylor 2000, vol. 1, table 9.3).
  pure subroutine four_points(points, xi, w)
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    integer :: k
    points = 4
    w(1:4) = one/24.0_wp
    xi(1:3, 1:4) = (5.0_wp - sqrt(5.0_wp))/20.0_wp
    do k = 1, 3
      xi(k, k + 1) = (5.0_wp + 3.0_wp*sqrt(5.0_wp))/20.0_wp
    end do
  end subroutine four_points

end module element_tet4
