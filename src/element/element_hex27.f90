! SPDX-License-Identifier: BSD-3-Clause
!> The triquadratic hexahedron with 3 x 3 x 3 Gauss points. Nodes: 1 to 8 the corners; 9 to 20
!> on the edges 12, 23, 34, 41, 56, 67, 78, 85, 15, 26, 37, 48; 21 to 26 on the faces xi = -1,
!> 1, eta = -1, 1, zeta = -1, 1; 27 the centre. VTK has the same order.
module element_hex27
  use base_kinds, only: wp, zero, one, two, half
  use element_base, only: element_t, jacobian_at
  use element_curved, only: midpoints, quadratic_faces, linear_facets
  use element_hex8, only: corner, hex_face, cube_points
  implicit none
  private

  type, extends(element_t), public :: hex27_t
  contains
    procedure :: shape => hex27_shape
    procedure :: rule => hex27_rule
    procedure :: smallest_jacobian => hex27_smallest_jacobian
  end type hex27_t

  integer, parameter :: edge(2, 12) = reshape([1, 2, 2, 3, 3, 4, 4, 1, 5, 6, 6, 7, 7, 8, 8, 5, &
      1, 5, 2, 6, 3, 7, 4, 8], [2, 12])

  public :: new_hex27, hex27_places

contains

  !> Its data.
  pure function new_hex27() result(element)
    type(hex27_t) :: element
    element = hex27_t(name='HEX27', dim=3, nodes=27, vtk=29)
    element%place = hex27_places()
    element%face = quadratic_faces(element%place, hex_face)
    element%facet = linear_facets(element%face)
  end function new_hex27

  !> Parametric coordinates (3, 27) of the nodes.
  pure function hex27_places() result(place)
    real(wp) :: place(3, 27)
    integer :: k
    place(:, :8) = corner
    place(:, 9:20) = midpoints(corner, edge)
    do k = 1, 6
      place(:, 20 + k) = 0.25_wp*sum(corner(:, hex_face(:, k)), dim=2)
    end do
    place(:, 27) = zero
  end function hex27_places

  !> Products of the quadratics xi (xi - 1)/2, 1 - xi^2, xi (xi + 1)/2.
  pure subroutine hex27_shape(this, xi, n, dn)
    class(hex27_t), intent(in) :: this
    real(wp), intent(in) :: xi(:)
    real(wp), intent(out) :: n(:), dn(:, :)
    real(wp) :: place(3, 27), f(3), slope(3)
    integer :: i
    place = hex27_places()
    do i = 1, 27
      where (abs(place(:, i)) > half)
        f = half*xi*(xi + place(:, i))
        slope = xi + half*place(:, i)
      elsewhere
        f = one - xi**2
        slope = -two*xi
      end where
      n(i) = product(f)
      dn(i, :) = [slope(1)*f(2)*f(3), f(1)*slope(2)*f(3), f(1)*f(2)*slope(3)]
    end do
  end subroutine hex27_shape

  !> Exact to degree 5 in each direction, which the volume of a curved one is.
  pure subroutine hex27_rule(this, points, xi, w)
    class(hex27_t), intent(in) :: this
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    call cube_points(points, xi, w)
  end subroutine hex27_rule

  !> At the points and at the nodes.
  pure function hex27_smallest_jacobian(this, x) result(j)
    class(hex27_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp) :: j, xi(3, 27), w(27)
    integer :: points
    call this%rule(points, xi, w)
    j = min(jacobian_at(this, x, xi), jacobian_at(this, x, hex27_places()))
  end function hex27_smallest_jacobian

end module element_hex27
