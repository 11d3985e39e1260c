! SPDX-License-Identifier: BSD-3-Clause
!> The wedge: a hexahedron whose upper edges 5-6 and 7-8 are one node each. Base 1-2-3-4, ridge
!> 5-6, triangles 1-2-5 and 4-3-6.
module element_wedge6
  use base_kinds, only: wp
  use element_base, only: element_t, jacobian_at, corner_points, gauss
  use element_hex8, only: corner, trilinear
  implicit none
  private

  type, extends(element_t), public :: wedge6_t
  contains
    procedure :: shape => wedge6_shape
    procedure :: rule => wedge6_rule
    procedure :: smallest_jacobian => wedge6_smallest_jacobian
  end type wedge6_t

  public :: new_wedge6

contains

  !> Its data. Of the two triangles of VTK the first looks toward the second (since VTK
  !> 9.7; before it looked away).
  pure function new_wedge6() result(element)
    type(wedge6_t) :: element
    element = wedge6_t(name='WEDGE6', dim=3, nodes=6, vtk=13, vtk_order=[1, 5, 2, 4, 6, 3], &
        face=reshape([1, 5, 6, 4, 2, 3, 6, 5, 1, 2, 5, 0, 4, 6, 3, 0, 1, 4, 3, 2], [4, 5]))
  end function new_wedge6

  pure subroutine wedge6_shape(this, xi, n, dn)
    class(wedge6_t), intent(in) :: this
    real(wp), intent(in) :: xi(:)
    real(wp), intent(out) :: n(:), dn(:, :)
    real(wp) :: whole(8), slope(8, 3)
    call trilinear(xi, whole, slope)
    n = [whole(1:4), whole(5) + whole(6), whole(7) + whole(8)]
    dn(1:4, :) = slope(1:4, :)
    dn(5, :) = slope(5, :) + slope(6, :)
    dn(6, :) = slope(7, :) + slope(8, :)
  end subroutine wedge6_shape

  pure subroutine wedge6_rule(this, points, xi, w)
    class(wedge6_t), intent(in) :: this
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    call corner_points(corner, [gauss, gauss, gauss], points, xi, w)
  end subroutine wedge6_rule

  !> At the points and the corners of the base; at a repeated corner it is zero in any shape.
  pure function wedge6_smallest_jacobian(this, x) result(j)
    class(wedge6_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp) :: j
    j = jacobian_at(this, x, reshape([gauss*corner, corner(:, 1:4)], [3, 12]))
  end function wedge6_smallest_jacobian

end module element_wedge6
