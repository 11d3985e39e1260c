! SPDX-License-Identifier: BSD-3-Clause
!> A face of an element in space: a triangle, or a bilinear quadrilateral, which may be warped.
module element_face
  use base_kinds, only: wp, zero, one
  use element_base, only: gauss
  implicit none
  private
  public :: face_areas

contains

  !> a (3, nodes) [L2] = int N_i n dA over the face with nodes x (3, 3 or 4) [L], n outward
  !> where they go round counter-clockwise seen from outside. Of a quadrilateral by 2 x 2
  !> points, which is exact: the cross product of its tangents is linear in each parameter.
  pure subroutine face_areas(x, a)
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(out) :: a(:, :)
    real(wp), parameter :: corner(2, 4) = &
        reshape([-one, -one, one, -one, one, one, -one, one], [2, 4])
    real(wp) :: n(4), tangent(3, 2), normal(3)
    integer :: k, i
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

  pure function cross(a, b) result(c)
    real(wp), intent(in) :: a(3), b(3)
    real(wp) :: c(3)
    c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function cross

end module element_face
