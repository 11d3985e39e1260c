! SPDX-License-Identifier: BSD-3-Clause
!> The sparse factor L D L' with blocks of 2 x 2, for two unknowns of each node: what
!> `linalg_ldlt` does inside its loops. Columns of L: blocks first(j)..first(j+1)-1 of l, in the
!> rows `row`; inverse pivots are held as 11, 21, 22.
module linalg_kernels_2
  use base_kinds, only: wp, zero, one
  implicit none
  private
  public :: eliminate_2, invert_2, forward_2, forward_part_2, backward_2

contains

  !> Sparse triangular solve for row k of L, whose entries are `reach`: y holds row k of A, and
  !> y(:, :, k) becomes the pivot block. filled: the last block so far of each column.
  pure subroutine eliminate_2(k, n, reach, first, d_inverse, row, l, filled, y)
    integer, intent(in) :: k, n
    integer, intent(in) :: reach(:)
    integer, intent(in) :: first(*)
    real(wp), intent(in) :: d_inverse(3, *)
    integer, intent(inout) :: row(*)
    real(wp), intent(inout) :: l(2, 2, *)
    integer, intent(inout) :: filled(*)
    real(wp), intent(inout) :: y(2, 2, n)
    real(wp) :: a11, a21, a12, a22, l11, l21, l12, l22
    integer :: m, j, p, i
    do m = 1, size(reach)
      j = reach(m)
      a11 = y(1, 1, j)
      a21 = y(2, 1, j)
      a12 = y(1, 2, j)
      a22 = y(2, 2, j)
      y(:, :, j) = zero
      do p = first(j), filled(j)
        i = row(p)
        y(1, 1, i) = y(1, 1, i) - (a11*l(1, 1, p) + a12*l(1, 2, p))
        y(2, 1, i) = y(2, 1, i) - (a21*l(1, 1, p) + a22*l(1, 2, p))
        y(1, 2, i) = y(1, 2, i) - (a11*l(2, 1, p) + a12*l(2, 2, p))
        y(2, 2, i) = y(2, 2, i) - (a21*l(2, 1, p) + a22*l(2, 2, p))
      end do
      l11 = a11*d_inverse(1, j) + a12*d_inverse(2, j)
      l21 = a21*d_inverse(1, j) + a22*d_inverse(2, j)
      l12 = a11*d_inverse(2, j) + a12*d_inverse(3, j)
      l22 = a21*d_inverse(2, j) + a22*d_inverse(3, j)
      y(1, 1, k) = y(1, 1, k) - (l11*a11 + l12*a12)
      y(2, 1, k) = y(2, 1, k) - (l21*a11 + l22*a12)
      y(1, 2, k) = y(1, 2, k) - (l11*a21 + l12*a22)
      y(2, 2, k) = y(2, 2, k) - (l21*a21 + l22*a22)
      filled(j) = filled(j) + 1
      row(filled(j)) = k
      l(1, 1, filled(j)) = l11
      l(2, 1, filled(j)) = l21
      l(1, 2, filled(j)) = l12
      l(2, 2, filled(j)) = l22
    end do
  end subroutine eliminate_2

  !> Inverse of a pivot block. original: the same block of A; below the share null_pivot of its
  !> diagonal a pivot is null, is counted, and has the inverse 0. ok is false for a lost pivot.
  pure subroutine invert_2(null_pivot, original, pivot, inverse, null_pivots, ok)
    real(wp), intent(in) :: null_pivot
    real(wp), intent(in) :: original(2, 2), pivot(2, 2)
    real(wp), intent(out) :: inverse(3)
    integer, intent(inout) :: null_pivots
    logical, intent(out) :: ok
    real(wp) :: second, l21, floor_1, floor_2
    ok = .true.
    floor_1 = null_pivot*original(1, 1)
    floor_2 = null_pivot*original(2, 2)
    inverse = zero
    if (null_pivot > zero .and. .not. pivot(1, 1) > floor_1) then
      null_pivots = null_pivots + 1
      if (pivot(2, 2) > floor_2) then
        inverse(3) = one/pivot(2, 2)
      else
        null_pivots = null_pivots + 1
      end if
      return
    end if
    l21 = pivot(2, 1)/pivot(1, 1)
    second = pivot(2, 2) - l21*pivot(2, 1)
    if (null_pivot > zero .and. .not. second > floor_2) then
      null_pivots = null_pivots + 1
      inverse(1) = one/pivot(1, 1)
    else if (pivot(1, 1) > zero .and. second > zero .and. second <= huge(second)) then
      inverse(3) = one/second
      inverse(2) = -l21*inverse(3)
      inverse(1) = one/pivot(1, 1) - l21*inverse(2)
    else
      ok = .false.
    end if
  end subroutine invert_2

  !> y = L^-1 y of the columns from..leading, then these are divided by the pivots.
  pure subroutine forward_2(from, leading, n, first, row, l, d_inverse, y)
    integer, intent(in) :: from, leading, n
    integer, intent(in) :: first(leading + 1)
    integer, intent(in) :: row(*)
    real(wp), intent(in) :: l(2, 2, *)
    real(wp), intent(in) :: d_inverse(3, leading)
    real(wp), intent(inout) :: y(2, n)
    real(wp) :: y1, y2
    integer :: j, p, i
    do j = from, leading
      y1 = y(1, j)
      y2 = y(2, j)
      do p = first(j), first(j + 1) - 1
        i = row(p)
        y(:, i) = y(:, i) - (l(:, 1, p)*y1 + l(:, 2, p)*y2)
      end do
      y(1, j) = d_inverse(1, j)*y1 + d_inverse(2, j)*y2
      y(2, j) = d_inverse(2, j)*y1 + d_inverse(3, j)*y2
    end do
  end subroutine forward_2

  !> The same of the columns from..last of a part of the elimination tree: what they change in
  !> the rows after base, which are of no part, is added to `outside`.
  pure subroutine forward_part_2(from, last, n, base, first, row, l, d_inverse, y, outside)
    integer, intent(in) :: from, last, n, base
    integer, intent(in) :: first(last + 1)
    integer, intent(in) :: row(*)
    real(wp), intent(in) :: l(2, 2, *)
    real(wp), intent(in) :: d_inverse(3, last)
    real(wp), intent(inout) :: y(2, n)
    real(wp), intent(inout) :: outside(2, n - base)
    real(wp) :: y1, y2
    integer :: j, p, i, top
    do j = from, last
      y1 = y(1, j)
      y2 = y(2, j)
      do top = first(j), first(j + 1) - 1
        if (row(top) > base) exit
      end do
      do p = first(j), top - 1
        i = row(p)
        y(:, i) = y(:, i) - (l(:, 1, p)*y1 + l(:, 2, p)*y2)
      end do
      do p = top, first(j + 1) - 1
        i = row(p) - base
        outside(:, i) = outside(:, i) - (l(:, 1, p)*y1 + l(:, 2, p)*y2)
      end do
      y(1, j) = d_inverse(1, j)*y1 + d_inverse(2, j)*y2
      y(2, j) = d_inverse(2, j)*y1 + d_inverse(3, j)*y2
    end do
  end subroutine forward_part_2

  !> y = L'^-1 y of the columns from..leading, with what comes after them given.
  pure subroutine backward_2(from, leading, n, first, row, l, y)
    integer, intent(in) :: from, leading, n
    integer, intent(in) :: first(leading + 1)
    integer, intent(in) :: row(*)
    real(wp), intent(in) :: l(2, 2, *)
    real(wp), intent(inout) :: y(2, n)
    real(wp) :: y1, y2
    integer :: j, p, i
    do j = leading, from, -1
      y1 = y(1, j)
      y2 = y(2, j)
      do p = first(j), first(j + 1) - 1
        i = row(p)
        y1 = y1 - (l(1, 1, p)*y(1, i) + l(2, 1, p)*y(2, i))
        y2 = y2 - (l(1, 2, p)*y(1, i) + l(2, 2, p)*y(2, i))
      end do
      y(1, j) = y1
      y(2, j) = y2
    end do
  end subroutine backward_2

end module linalg_kernels_2
