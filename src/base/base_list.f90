! SPDX-License-Identifier: BSD-3-Clause
!> Lists of integers that grow; arrays that change places.
module base_list
  use base_kinds, only: wp
  implicit none
  private
  public :: append, swap

contains

  !> Adds items after list(1:n), which grow to n + size(items). What is not allocated yet is
  !> empty. The list gets twice as long at least, so that appending one by one is linear. By
  !> ALLOCATE, which tells where memory ends; an assignment that makes room does not.
  pure subroutine append(items, list, n)
    integer, intent(in) :: items(:)
    integer, allocatable, intent(inout) :: list(:)
    integer, intent(inout) :: n
    integer, allocatable :: longer(:)
    if (.not. allocated(list)) allocate (list(max(16, size(items))))
    if (n + size(items) > size(list)) then
      allocate (longer(max(2*size(list), n + size(items))))
      longer(:n) = list(:n)
      call move_alloc(longer, list)
    end if
    list(n + 1:n + size(items)) = items
    n = n + size(items)
  end subroutine append

  !> Exchanges two arrays without copying.
  subroutine swap(a, b)
    real(wp), allocatable, intent(inout) :: a(:, :), b(:, :)
    real(wp), allocatable :: c(:, :)
    call move_alloc(a, c)
    call move_alloc(b, a)
    call move_alloc(c, b)
  end subroutine swap

end module base_list
