! SPDX-License-Identifier: BSD-3-Clause
!> The sparse factor L D L' with blocks of 3 x 3, for three unknowns of each node: what
!> `linalg_ldlt` does inside its loops. Columns of L: blocks first(j)..first(j+1)-1 of l, in the
!> rows `row`; inverse pivots are held as 11, 21, 22, 31, 32, 33.
module linalg_kernels_3
  use base_kinds, only: wp, zero, one
  implicit none
  private
  public :: eliminate_3, invert_3, forward_3, forward_part_3, backward_3

  !> Place of entry (i, j) in an inverse pivot.
  integer, parameter :: place(3, 3) = reshape([1, 2, 4, 2, 3, 5, 4, 5, 6], [3, 3])

contains

  !> Sparse triangular solve for row k of L, whose entries are `reach`: y holds row k of A, and
  !> y(:, :, k) becomes the pivot block. filled: the last block so far of each column.
  pure subroutine eliminate_3(k, n, reach, first, d_inverse, row, l, filled, y)
    integer, intent(in) :: k, n
    integer, intent(in) :: reach(:)
    integer, intent(in) :: first(*)
    real(wp), intent(in) :: d_inverse(6, *)
    integer, intent(inout) :: row(*)
    real(wp), intent(inout) :: l(3, 3, *)
    integer, intent(inout) :: filled(*)
    real(wp), intent(inout) :: y(3, 3, n)
    real(wp) :: a(3, 3), new(3, 3), inverse(3, 3)
    integer :: m, j, p, i, c
    do m = 1, size(reach)
      j = reach(m)
      a = y(:, :, j)
      y(:, :, j) = zero
      do p = first(j), filled(j)
        i = row(p)
        do c = 1, 3
          y(:, c, i) = y(:, c, i) &
              - (a(:, 1)*l(c, 1, p) + a(:, 2)*l(c, 2, p) + a(:, 3)*l(c, 3, p))
        end do
      end do
      inverse = reshape(d_inverse(reshape(place, [9]), j), [3, 3])
      do c = 1, 3
        new(:, c) = a(:, 1)*inverse(1, c) + a(:, 2)*inverse(2, c) + a(:, 3)*inverse(3, c)
      end do
      do c = 1, 3
        y(:, c, k) = y(:, c, k) - (new(:, 1)*a(c, 1) + new(:, 2)*a(c, 2) + new(:, 3)*a(c, 3))
      end do
      filled(j) = filled(j) + 1
      row(filled(j)) = k
      l(:, :, filled(j)) = new
    end do
  end subroutine eliminate_3

  !> Inverse of a pivot block. original: the same block of A; below the share null_pivot of its
  !> diagonal a pivot is null, is counted, and has the inverse 0. ok is false for a lost pivot.
  !> One unknown after the other joins those eliminated: with w = S b of the inverse S so far
  !> and its pivot p = c - b' w, the inverse is [S + w w'/p, -w/p; -w'/p, 1/p].
  pure subroutine invert_3(null_pivot, original, pivot, inverse, null_pivots, ok)
    real(wp), intent(in) :: null_pivot
    real(wp), intent(in) :: original(3, 3), pivot(3, 3)
    real(wp), intent(out) :: inverse(6)
    integer, intent(inout) :: null_pivots
    logical, intent(out) :: ok
    real(wp) :: s(3, 3), w(3), p
    integer :: i, c
    ok = .true.
    s = zero
    do i = 1, 3
      w = s(:, 1)*pivot(i, 1)
      do c = 2, i - 1
        w = w + s(:, c)*pivot(i, c)
      end do
      p = pivot(i, i) - dot_product(w(:i - 1), pivot(i, :i - 1))
      if (null_pivot > zero .and. .not. p > null_pivot*original(i, i)) then
        null_pivots = null_pivots + 1
        cycle
      end if
      ok = ok .and. p > zero .and. p <= huge(p)
      if (.not. ok) exit
      w(i) = -one
      do c = 1, i
        s(:i, c) = s(:i, c) + w(:i)*(w(c)/p)
      end do
    end do
    inverse = [s(1, 1), s(2, 1), s(2, 2), s(3, 1), s(3, 2), s(3, 3)]
  end subroutine invert_3

  !> y = L^-1 y of the columns from..leading, then these are divided by the pivots.
  pure subroutine forward_3(from, leading, n, first, row, l, d_inverse, y)
    integer, intent(in) :: from, leading, n
    integer, intent(in) :: first(leading + 1)
    integer, intent(in) :: row(*)
    real(wp), intent(in) :: l(3, 3, *)
    real(wp), intent(in) :: d_inverse(6, leading)
    real(wp), intent(inout) :: y(3, n)
    real(wp) :: y1, y2, y3
    integer :: j, p, i
    do j = from, leading
      y1 = y(1, j)
      y2 = y(2, j)
      y3 = y(3, j)
      do p = first(j), first(j + 1) - 1
        i = row(p)
        y(:, i) = y(:, i) - (l(:, 1, p)*y1 + l(:, 2, p)*y2 + l(:, 3, p)*y3)
      end do
      y(1, j) = d_inverse(1, j)*y1 + d_inverse(2, j)*y2 + d_inverse(4, j)*y3
      y(2, j) = d_inverse(2, j)*y1 + d_inverse(3, j)*y2 + d_inverse(5, j)*y3
      y(3, j) = d_inverse(4, j)*y1 + d_inverse(5, j)*y2 + d_inverse(6, j)*y3
    end do
  end subroutine forward_3

  !> The same of the columns from..last of a part of the elimination tree: what they change in
  !> the rows after base, which are of no part, is added to `outside`.
  pure subroutine forward_part_3(from, last, n, base, first, row, l, d_inverse, y, outside)
    integer, intent(in) :: from, last, n, base
    integer, intent(in) :: first(last + 1)
    integer, intent(in) :: row(*)
    real(wp), intent(in) :: l(3, 3, *)
    real(wp), intent(in) :: d_inverse(6, last)
    real(wp), intent(inout) :: y(3, n)
    real(wp), intent(inout) :: outside(3, n - base)
    real(wp) :: y1, y2, y3
    integer :: j, p, i, top
    do j = from, last
      y1 = y(1, j)
      y2 = y(2, j)
      y3 = y(3, j)
      do top = first(j), first(j + 1) - 1
        if (row(top) > base) exit
      end do
      do p = first(j), top - 1
        i = row(p)
        y(:, i) = y(:, i) - (l(:, 1, p)*y1 + l(:, 2, p)*y2 + l(:, 3, p)*y3)
      end do
      do p = top, first(j + 1) - 1
        i = row(p) - base
        outside(:, i) = outside(:, i) - (l(:, 1, p)*y1 + l(:, 2, p)*y2 + l(:, 3, p)*y3)
      end do
      y(1, j) = d_inverse(1, j)*y1 + d_inverse(2, j)*y2 + d_inverse(4, j)*y3
      y(2, j) = d_inverse(2, j)*y1 + d_inverse(3, j)*y2 + d_inverse(5, j)*y3
      y(3, j) = d_inverse(4, j)*y1 + d_inverse(5, j)*y2 + d_inverse(6, j)*y3
    end do
  end subroutine forward_part_3

  !> y = L'^-1 y of the columns from..leading, with what comes after them given.
  pure subroutine backward_3(from, leading, n, first, row, l, y)
    integer, intent(in) :: from, leading, n
    integer, intent(in) :: first(leading + 1)
    integer, intent(in) :: row(*)
    real(wp), intent(in) :: l(3, 3, *)
    real(wp), intent(inout) :: y(3, n)
    real(wp) :: x(3)
    integer :: j, p, i
    do j = leading, from, -1
      x = y(:, j)
      do p = first(j), first(j + 1) - 1
        i = row(p)
        x = x - (l(1, :, p)*y(1, i) + l(2, :, p)*y(2, i) + l(3, :, p)*y(3, i))
      end do
      y(:, j) = x
    end do
  end subroutine backward_3

end module linalg_kernels_3
