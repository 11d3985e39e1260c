! SPDX-License-Identifier: BSD-3-Clause
!> The bilinear quadrilateral with 2 x 2 Gauss points.
module element_quad4
  use base_kinds, only: wp, one, half
  use element_base, only: element_t, corner_points, gauss
  implicit none
  private

  type, extends(element_t), public :: quad4_t
  contains
    procedure :: shape => quad4_shape
    procedure :: rule => quad4_rule
    procedure :: mass_rule => quad4_mass_rule
    procedure :: directions => quad4_directions
    procedure :: smallest_jacobian => quad4_smallest_jacobian
  end type quad4_t

  real(wp), parameter :: corner(2, 4) = &
      reshape([-one, -one, one, -one, one, one, -one, one], [2, 4])

  public :: new_quad4

contains

  !> Its data.
  pure function new_quad4() result(element)
    type(quad4_t) :: element
    element = quad4_t(name='QUAD4', dim=2, nodes=4, vtk=9, takes_dispersion=.true., &
        face=reshape([1, 2, 2, 3, 3, 4, 4, 1], [2, 4]))
  end function new_quad4

  pure subroutine quad4_shape(this, xi, n, dn)
    class(quad4_t), intent(in) :: this
    real(wp), intent(in) :: xi(:)
    real(wp), intent(out) :: n(:), dn(:, :)
    n = 0.25_wp*(one + corner(1, :)*xi(1))*(one + corner(2, :)*xi(2))
    dn(:, 1) = 0.25_wp*corner(1, :)*(one + corner(2, :)*xi(2))
    dn(:, 2) = 0.25_wp*corner(2, :)*(one + corner(1, :)*xi(1))
  end subroutine quad4_shape

  pure subroutine quad4_rule(this, points, xi, w)
    class(quad4_t), intent(in) :: this
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    call this%mass_rule([gauss, gauss], points, xi, w)
  end subroutine quad4_rule

  !> Four points (+-a1, +-a2).
  pure subroutine quad4_mass_rule(this, a, points, xi, w)
    class(quad4_t), intent(in) :: this
    real(wp), intent(in) :: a(:)
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    call corner_points(corner, a, points, xi, w)
  end subroutine quad4_mass_rule

  !> Between the midpoints of opposite edges.
  pure function quad4_directions(this, x) result(across)
    class(quad4_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp) :: across(size(x, 1), size(x, 1))
    across(:, 1) = half*((x(:, 2) - x(:, 1)) + (x(:, 3) - x(:, 4)))
    across(:, 2) = half*((x(:, 4) - x(:, 1)) + (x(:, 3) - x(:, 2)))
  end function quad4_directions

  !> The determinant is bilinear, so its smallest value is at a corner.
  pure function quad4_smallest_jacobian(this, x) result(j)
    class(quad4_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp) :: j, next(2), previous(2)
    integer :: k
    j = huge(j)
    do k = 1, 4
      next = x(:, 1 + mod(k, 4)) - x(:, k)
      previous = x(:, 1 + mod(k + 2, 4)) - x(:, k)
      j = min(j, 0.25_wp*(next(1)*previous(2) - next(2)*previous(1)))
    end do
  end function quad4_smallest_jacobian

end module element_quad4
