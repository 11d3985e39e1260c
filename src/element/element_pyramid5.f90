! SPDX-License-Identifier: BSD-3-Clause
!> The pyramid: a hexahedron whose upper face is one node. Base 1-2-3-4, apex 5.
module element_pyramid5
  use base_kinds, only: wp, zero
  use element_base, only: element_t, gauss
  use element_hex8, only: trilinear, corner_points
  implicit none
  private

  type, extends(element_t), public :: pyramid5_t
  contains
    procedure :: shape => pyramid5_shape
    procedure :: rule => pyramid5_rule
    procedure :: mass_rule => pyramid5_mass_rule
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
    call corner_points([gauss, gauss, gauss], points, xi, w)
  end subroutine pyramid5_rule

  !> Three Gauss points a direction: the Jacobian is quadratic in the third, its product with
  !> two shape functions of degree 4.
  pure subroutine pyramid5_mass_rule(this, a, points, xi, w)
    class(pyramid5_t), intent(in) :: this
    real(wp), intent(in) :: a(:)
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    real(wp), parameter :: at(3) = [-sqrt(0.6_wp), zero, sqrt(0.6_wp)]
    real(wp), parameter :: weight(3) = [5.0_wp, 8.0_wp, 5.0_wp]/9.0_wp
    integer :: i, j, k
    points = 0
    do k = 1, 3
      do j = 1, 3
        do i = 1, 3
          points = points + 1
          xi(1:3, points) = [at(i), at(j), at(k)]
          w(points) = weight(i)*weight(j)*weight(k)
        end do
      end do
    end do
  end subroutine pyramid5_mass_rule

end module element_pyramid5
