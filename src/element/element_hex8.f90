! SPDX-License-Identifier: BSD-3-Clause
!> The trilinear hexahedron with 2 x 2 x 2 Gauss points.
module element_hex8
  use base_kinds, only: wp, zero, one
  use element_base, only: element_t, jacobian_at, corner_points, gauss
  implicit none
  private

  type, extends(element_t), public :: hex8_t
  contains
    procedure :: shape => hex8_shape
    procedure :: rule => hex8_rule
    procedure :: mass_rule => hex8_mass_rule
    procedure :: directions => hex8_directions
    procedure :: smallest_jacobian => hex8_smallest_jacobian
  end type hex8_t

  real(wp), parameter, public :: corner(3, 8) = reshape([-one, -one, -one, one, -one, -one, &
      one, one, -one, -one, one, -one, -one, -one, one, one, -one, one, one, one, one, &
      -one, one, one], [3, 8])
  integer, parameter, public :: hex_face(4, 6) = reshape([1, 5, 8, 4, 2, 3, 7, 6, 1, 2, 6, 5, &
      4, 8, 7, 3, 1, 4, 3, 2, 5, 6, 7, 8], [4, 6])

  public :: new_hex8, trilinear, cube_points

contains

  !> Its data.
  pure function new_hex8() result(element)
    type(hex8_t) :: element
    element = hex8_t(name='HEX8', dim=3, nodes=8, vtk=12, takes_dispersion=.true., &
        face=hex_face)
  end function new_hex8

  pure subroutine hex8_shape(this, xi, n, dn)
    class(hex8_t), intent(in) :: this
    real(wp), intent(in) :: xi(:)
    real(wp), intent(out) :: n(:), dn(:, :)
    call trilinear(xi, n, dn)
  end subroutine hex8_shape

  !> N_i = (1 + xi_i xi) (1 + eta_i eta) (1 + zeta_i zeta)/8 and their derivatives.
  pure subroutine trilinear(xi, n, dn)
    real(wp), intent(in) :: xi(:)
    real(wp), intent(out) :: n(:), dn(:, :)
    real(wp) :: f(3)
    integer :: i
    do i = 1, 8
      f = one + corner(:, i)*xi
      n(i) = 0.125_wp*f(1)*f(2)*f(3)
      dn(i, :) = 0.125_wp*corner(:, i)*[f(2)*f(3), f(1)*f(3), f(1)*f(2)]
    end do
  end subroutine trilinear

  pure subroutine hex8_rule(this, points, xi, w)
    class(hex8_t), intent(in) :: this
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    call corner_points(corner, [gauss, gauss, gauss], points, xi, w)
  end subroutine hex8_rule

  !> Eight points (+-a1, +-a2, +-a3).
  pure subroutine hex8_mass_rule(this, a, points, xi, w)
    class(hex8_t), intent(in) :: this
    real(wp), intent(in) :: a(:)
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    call corner_points(corner, a, points, xi, w)
  end subroutine hex8_mass_rule

  !> Three Gauss points in each direction.
  pure subroutine cube_points(points, xi, w)
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
  end subroutine cube_points

  !> Between the centres of opposite faces.
  pure function hex8_directions(this, x) result(across)
    class(hex8_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp) :: across(size(x, 1), size(x, 1))
    integer :: d, i
    across = zero
    do d = 1, 3
      do i = 2, 8
        across(:, d) = across(:, d) + 0.25_wp*corner(d, i)*(x(:, i) - x(:, 1))
      end do
    end do
  end function hex8_directions

  !> At the corners and at the points of the rule: a strongly distorted one may be positive at
  !> all corners and negative at a point.
  pure function hex8_smallest_jacobian(this, x) result(j)
    class(hex8_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp) :: j
    j = jacobian_at(this, x, reshape([gauss*corner, corner], [3, 16]))
  end function hex8_smallest_jacobian

end module element_hex8
