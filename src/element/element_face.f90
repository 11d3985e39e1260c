! SPDX-License-Identifier: BSD-3-Clause
!> A face of an element: in the plane an edge, in space a triangle, or a bilinear quadrilateral,
!> which may be warped.
module element_face
  use base_kinds, only: wp, zero, one, half
  use element_base, only: gauss
  use linalg_dense, only: cross
  implicit none
  private
  public :: face_areas

contains

  !> a (3, nodes) [L2] = int N_i n dA over the face with nodes x (3, 3 or 4) [L], n outward
  !> where they go round counter-clockwise seen from outside; of an edge of the plane, x (2, 2),
  !> a (2, 2) [L], with the element on its left. Of a quadrilateral by 2 x 2 points, which is
  !> exact: the cross product of its tangents is linear in each parameter.
  pure subroutine face_areas(x, a)
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(out) :: a(:, :)
    real(wp), parameter :: corner(2, 4) = &
        reshape([-one, -one, one, -one, one, one, -one, one], [2, 4])
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

end module element_face
