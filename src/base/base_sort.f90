! SPDX-License-Identifier: BSD-3-Clause
!> Sorting and searching.
module base_sort
  use base_kinds, only: wp
  implicit none
  private
  public :: sort_order, sort_order_real, find_sorted, first_not_below, sort_integers

contains

  !> order such that key(order) does not decrease; stable (merge sort).
  pure subroutine sort_order(key, order)
    integer, intent(in) :: key(:)
    integer, intent(out) :: order(:)
    integer, allocatable :: other(:)
    integer :: n, width, first
    n = size(key)
    order = [(first, first=1, n)]
    if (n < 2) return
    if (all(key(2:) >= key(:n - 1))) return
    allocate (other(n))
    width = 1
    do while (width < n)
      do first = 1, n, 2*width
        call merge_runs(key, order, other, first, min(first + width, n + 1), &
            min(first + 2*width, n + 1))
      end do
      order = other
      width = 2*width
    end do
  end subroutine sort_order

  !> Merges order(first:middle-1) and order(middle:last-1) into other(first:last-1).
  pure subroutine merge_runs(key, order, other, first, middle, last)
    integer, intent(in) :: key(:)
    integer, intent(in) :: order(:)
    integer, intent(inout) :: other(:)
    integer, intent(in) :: first, middle, last
    integer :: i, j, k
    logical :: left
    i = first
    j = middle
    do k = first, last - 1
      left = j >= last
      if (.not. left .and. i < middle) left = key(order(i)) <= key(order(j))
      if (left) then
        other(k) = order(i)
        i = i + 1
      else
        other(k) = order(j)
        j = j + 1
      end if
    end do
  end subroutine merge_runs

  !> order such that key(order) does not decrease; stable (merge sort).
  pure subroutine sort_order_real(key, order)
    real(wp), intent(in) :: key(:)
    integer, intent(out) :: order(:)
    integer :: other(size(key)), width, first, middle, last, i, j, k
    logical :: left
    order = [(k, k=1, size(key))]
    width = 1
    do while (width < size(key))
      do first = 1, size(key), 2*width
        middle = min(first + width, size(key) + 1)
        last = min(first + 2*width, size(key) + 1)
        i = first
        j = middle
        do k = first, last - 1
          left = j >= last
          if (.not. left .and. i < middle) left = key(order(i)) <= key(order(j))
          other(k) = order(merge(i, j, left))
          i = merge(i + 1, i, left)
          j = merge(j, j + 1, left)
        end do
      end do
      order = other
      width = 2*width
    end do
  end subroutine sort_order_real

  !> Sorts a short list in place (insertion sort: the lists are rows of a sparse graph).
  pure subroutine sort_integers(list)
    integer, intent(inout) :: list(:)
    integer :: i, j, item
    do i = 2, size(list)
      item = list(i)
      j = i - 1
      do while (j >= 1)
        if (list(j) <= item) exit
        list(j + 1) = list(j)
        j = j - 1
      end do
      list(j + 1) = item
    end do
  end subroutine sort_integers

  !> Position of item in an increasing list, 0 if it is not there.
  pure integer function find_sorted(list, item)
    integer, intent(in) :: list(:)
    integer, intent(in) :: item
    integer :: low, high, middle
    low = 1
    high = size(list)
    find_sorted = 0
    do while (low <= high)
      middle = low + (high - low)/2
      if (list(middle) == item) then
        find_sorted = middle
        return
      else if (list(middle) < item) then
        low = middle + 1
      else
        high = middle - 1
      end if
    end do
  end function find_sorted

  !> Position of the first number >= item in an increasing list; one more than its size where
  !> all are below.
  pure integer function first_not_below(list, item)
    integer, intent(in) :: list(:)
    integer, intent(in) :: item
    integer :: last, middle
    first_not_below = 1
    last = size(list) + 1
    do while (first_not_below < last)
      middle = first_not_below + (last - first_not_below)/2
      if (list(middle) < item) then
        first_not_below = middle + 1
      else
        last = middle
      end if
    end do
  end function first_not_below

end module base_sort
