! SPDX-License-Identifier: BSD-3-Clause
!> The pyramid: a hexahedron whose upper face is one node. Base 1-2-3-4, apex 5.
module element_pyramid5
  use base_kinds, only: wp
  use element_base, only: element_t, jacobian_at, corner_points, gauss
  use element_hex8, only: corner, trilinear, cube_points
  implicit none
  private

  type, extends(element_t), public :: pyramid5_t
  contains
    procedure :: shape => pyramid5_shape
    procedure :: rule => pyramid5_rule
    procedure :: mass_rule => pyramid5_mass_rule
    procedure :: smallest_jacobian => pyramid5_smallest_jacobian
  end type pyramid5_t

  public :: new_pyramid5

contains

  !> Its data.
  pure function new_pyramid5() result(element)
    type(pyramid5_t) :: element
    element = pyramid5_t(name='PYRAMID5', dim=3, nodes=5, vtk=14, &
        face=reshape([1, 5, 4, 0, 2, 3, 5, 0, 1, 2, 5, 0, 4, 5, 3, 0, 1, 4, 3, 2], [4, 5]))
  end function new_pyramid5

  pure subroutine pyramid5_shape(this, xi, n, dn)
    class(pyramid5_t), intent(in) :: this
    real(wp), intent(in) :: xi(:)
    real(wp), intent(out) :: n(:), dn(:, :)
    real(wp) :: whole(8), slope(8, 3)
    call trilinear(xi, whole, slope)
    n = [whole(1:4), sum(whole(5:8))]
    dn(1:4, :) = slope(1:4, :)
    dn(5, :) = sum(slope(5:8, :), dim=1)
  end subroutine pyramid5_shape

  pure subroutine pyramid5_rule(this, points, xi, w)
    class(pyramid5_t), intent(in) :: this
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    call corner_points(corner, [gauss, gauss, gauss], points, xi, w)
  end subroutine pyramid5_rule

  !> Three Gauss points a direction: the Jacobian is quadratic in the third, its product with
  !> two shape functions of degree 4.
  pure subroutine pyramid5_mass_rule(this, a, points, xi, w)
    class(pyramid5_t), intent(in) :: this
    real(wp), intent(in) :: a(:)
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    call cube_points(points, xi, w)
  end subroutine pyramid5_mass_rule

  !> At the points and the corners of the base; at a repeated corner it is zero in any shape.
  pure function pyramid5_smallest_jacobian(this, x) result(j)
    class(pyramid5_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp) :: j
    j = jacobian_at(this, x, reshape([gauss*corner, corner(:, 1:4)], [3, 12]))
  end function pyramid5_smallest_jacobian

end module element_pyramid5
