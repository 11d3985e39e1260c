! SPDX-License-Identifier: BSD-3-Clause
!> A face of an element: in the plane an edge, in space a triangle, a bilinear quadrilateral,
!> which may be warped, or a piece of a curved face.
module element_face
  use base_kinds, only: wp, zero, one, half
  use element_base, only: element_t, gauss
  use linalg_dense, only: cross
  implicit none
  private
  public :: face_areas, curved_areas

  real(wp), parameter :: corner(2, 4) = &
      reshape([-one, -one, one, -one, one, one, -one, one], [2, 4])

contains

  !> a (3, nodes) [L2] = int N_i n dA over the face with nodes x (3, 3 or 4) [L], n outward
  !> where they go round counter-clockwise seen from outside; of an edge of the plane, x (2, 2),
  !> a (2, 2) [L], with the element on its left. Of a quadrilateral by 2 x 2 points, which is
  !> exact: the cross product of its tangents is linear in each parameter.
  pure subroutine face_areas(x, a)
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(out) :: a(:, :)
    real(wp) :: n(4), tangent(3, 2), normal(3)
    integer :: k, i
    if (size(x, 1) == 2) then
      n(:2) = x(:, 2) - x(:, 1)
      a(:, 1) = half*[n(2), -n(1)]
      a(:, 2) = a(:, 1)
      return
    end if
    if (size(x, 2) == 3) then
      normal = cross(x(:, 2) - x(:, 1), x(:, 3) - x(:, 1))/6.0_wp
      do i = 1, 3
        a(:, i) = normal
      end do
      return
    end if
    a = zero
    do k = 1, 4
      associate (xi => gauss*corner(:, k))
        n = 0.25_wp*(one + corner(1, :)*xi(1))*(one + corner(2, :)*xi(2))
        tangent = zero
        do i = 2, 4
          tangent(:, 1) = tangent(:, 1) &
              + 0.25_wp*corner(1, i)*(one + corner(2, i)*xi(2))*(x(:, i) - x(:, 1))
          tangent(:, 2) = tangent(:, 2) &
              + 0.25_wp*corner(2, i)*(one + corner(1, i)*xi(1))*(x(:, i) - x(:, 1))
        end do
      end associate
      normal = cross(tangent(:, 1), tangent(:, 2))
      do i = 1, 4
        a(:, i) = a(:, i) + n(i)*normal
      end do
    end do
  end subroutine face_areas

  !> a (3, nodes of the element) [L2] = int N_i n dA over facet f of an element whose faces are
  !> curved, n outward, of coordinates x (3, nodes) [L]. The facet is the image of a triangle or
  !> quadrilateral of the parametric face, here with 3 x 3 Gauss points of a quadrilateral, a
  !> triangle as one with two corners in one place: exact, as N_i and the tangents are
  !> quadratics.
  pure subroutine curved_areas(element, x, f, a)
    class(element_t), intent(in) :: element
    real(wp), intent(in) :: x(:, :)
    integer, intent(in) :: f
    real(wp), intent(out) :: a(:, :)
    real(wp), parameter :: point(3) = [-sqrt(0.6_wp), zero, sqrt(0.6_wp)]
    real(wp), parameter :: weight(3) = [5.0_wp, 8.0_wp, 5.0_wp]/9.0_wp
    real(wp) :: place(3, 4), xi(3), along(3, 2), n(size(x, 2)), dn(size(x, 2), 3)
    real(wp) :: tangent(3, 2), normal(3)
    integer :: i, j, k, m
    m = size(element%facet, 1)
    do k = 1, 4
      place(:, k) = element%place(:, element%facet(min(k, m), f))
    end do
    a = zero
    do j = 1, 3
      do i = 1, 3
        call on_quadrilateral(place, point([i, j]), xi, along)
        call element%shape(xi, n, dn)
        tangent = matmul(x, matmul(dn, along))
        normal = weight(i)*weight(j)*cross(tangent(:, 1), tangent(:, 2))
        do k = 1, size(n)
          a(:, k) = a(:, k) + n(k)*normal
        end do
      end do
    end do
  end subroutine curved_areas

  !> The point s in [-1, 1]^2 of a bilinear quadrilateral with corners place (3, 4), and its
  !> derivatives there.
  pure subroutine on_quadrilateral(place, s, point, along)
    real(wp), intent(in) :: place(3, 4), s(2)
    real(wp), intent(out) :: point(3), along(3, 2)
    real(wp) :: n(4)
    n = 0.25_wp*(one + corner(1, :)*s(1))*(one + corner(2, :)*s(2))
    point = matmul(place, n)
    along(:, 1) = matmul(place, 0.25_wp*corner(1, :)*(one + corner(2, :)*s(2)))
    along(:, 2) = matmul(place, 0.25_wp*corner(2, :)*(one + corner(1, :)*s(1)))
  end subroutine on_quadrilateral

end module element_face
