! SPDX-License-Identifier: BSD-3-Clause
!> Force of one element of four nodes in the plane. It has a file of its own so that it is
!> compiled alone: inside the loop over the elements compilers unroll it before they look for
!> vector instructions, and find none.
module assembly_four
  use base_kinds, only: wp
  implicit none
  private
  public :: subtract_four

contains

  !> f = f - factor * K u of the element with the nodes node; k: stiffness of the nodes but
  !> the first relative to it [F/L]; u, f (2, n).
  pure subroutine subtract_four(n, node, k, factor, u, f)
    integer, intent(in) :: n
    integer, intent(in) :: node(4)
    real(wp), intent(in) :: k(6, 6), factor, u(2, n)
    real(wp), intent(inout) :: f(2, n)
    real(wp) :: d(6), g(6)
    integer :: i
    associate (i1 => node(1), i2 => node(2), i3 => node(3), i4 => node(4))
      d(1:2) = factor*(u(:, i2) - u(:, i1))
      d(3:4) = factor*(u(:, i3) - u(:, i1))
      d(5:6) = factor*(u(:, i4) - u(:, i1))
      do i = 1, 6
        g(i) = k(i, 1)*d(1) + k(i, 2)*d(2) + k(i, 3)*d(3) + k(i, 4)*d(4) + k(i, 5)*d(5) &
            + k(i, 6)*d(6)
      end do
      f(:, i1) = f(:, i1) + (g(1:2) + g(3:4) + g(5:6))
      f(:, i2) = f(:, i2) - g(1:2)
      f(:, i3) = f(:, i3) - g(3:4)
      f(:, i4) = f(:, i4) - g(5:6)
    end associate
  end subroutine subtract_four

end module assembly_four
