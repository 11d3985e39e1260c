! SPDX-License-Identifier: BSD-3-Clause
!> A tree of boxes round items of a surface, edges or facets. Built once, split at the median of
!> the longest axis; refitted when the items have moved.
module contact_boxes
  use base_kinds, only: wp, zero, one, half
  use base_sort, only: sort_order_real
  implicit none
  private

  integer, parameter :: leaf_size = 4
  integer, parameter, public :: deepest_stack = 128   !< boxes that wait, twice the levels

  type, public :: boxes_t
    integer :: n = 0                          !< boxes
    integer, allocatable :: first(:), last(:) !< items of a box, places in item
    integer, allocatable :: child(:)          !< the first of two; 0 = leaf
    integer, allocatable :: item(:)
    real(wp), allocatable :: low(:, :), high(:, :)   !< (dim, boxes) [L]
  end type boxes_t

  public :: build_boxes, refit_boxes, push_children, box_distance_2

contains

  !> Tree over items with boxes low to high (dim, items) [L].
  subroutine build_boxes(low, high, boxes)
    real(wp), intent(in) :: low(:, :), high(:, :)
    class(boxes_t), intent(inout) :: boxes
    real(wp), allocatable :: middle(:, :)
    integer :: n, k
    n = size(low, 2)
    boxes%n = 0
    allocate (middle, source=half*(low + high))
    allocate (boxes%item(n), boxes%first(2*n + 1), boxes%last(2*n + 1), boxes%child(2*n + 1))
    allocate (boxes%low(size(low, 1), 2*n + 1), boxes%high(size(low, 1), 2*n + 1))
    boxes%item = [(k, k=1, n)]
    if (n == 0) return
    boxes%n = 1
    boxes%first(1) = 1
    boxes%last(1) = n
    k = 1
    do while (k <= boxes%n)
      call split(middle, boxes, k)
      k = k + 1
    end do
    call refit_boxes(low, high, boxes)
  end subroutine build_boxes

  !> Makes two boxes of box k at the median of its longest axis; a small box is a leaf.
  subroutine split(middle, boxes, k)
    real(wp), intent(in) :: middle(:, :)
    class(boxes_t), intent(inout) :: boxes
    integer, intent(in) :: k
    integer, allocatable :: order(:)
    real(wp) :: extent(size(middle, 1))
    integer :: axis, n, half_way
    boxes%child(k) = 0
    n = boxes%last(k) - boxes%first(k) + 1
    if (n <= leaf_size) return
    associate (item => boxes%item(boxes%first(k):boxes%last(k)))
      extent = maxval(middle(:, item), dim=2) - minval(middle(:, item), dim=2)
      axis = maxloc(extent, dim=1)
      allocate (order(n))
      call sort_order_real(middle(axis, item), order)
      item = item(order)
    end associate
    half_way = boxes%first(k) + n/2 - 1
    boxes%child(k) = boxes%n + 1
    boxes%first(boxes%n + 1:boxes%n + 2) = [boxes%first(k), half_way + 1]
    boxes%last(boxes%n + 1:boxes%n + 2) = [half_way, boxes%last(k)]
    boxes%n = boxes%n + 2
  end subroutine split

  !> Boxes for items that have moved: children stand behind their parent.
  pure subroutine refit_boxes(low, high, boxes)
    real(wp), intent(in) :: low(:, :), high(:, :)
    class(boxes_t), intent(inout) :: boxes
    integer :: k, i
    do k = boxes%n, 1, -1
      if (boxes%child(k) > 0) then
        associate (c => boxes%child(k))
          boxes%low(:, k) = min(boxes%low(:, c), boxes%low(:, c + 1))
          boxes%high(:, k) = max(boxes%high(:, c), boxes%high(:, c + 1))
        end associate
      else
        boxes%low(:, k) = huge(one)
        boxes%high(:, k) = -huge(one)
        do i = boxes%first(k), boxes%last(k)
          boxes%low(:, k) = min(boxes%low(:, k), low(:, boxes%item(i)))
          boxes%high(:, k) = max(boxes%high(:, k), high(:, boxes%item(i)))
        end do
      end if
    end do
  end subroutine refit_boxes

  !> Both children of box k onto the stack.
  pure subroutine push_children(boxes, k, stack, top)
    class(boxes_t), intent(in) :: boxes
    integer, intent(in) :: k
    integer, intent(inout) :: stack(:), top
    stack(top + 1:top + 2) = [boxes%child(k), boxes%child(k) + 1]
    top = top + 2
  end subroutine push_children

  !> Square of the distance of a point from box k [L2].
  pure real(wp) function box_distance_2(boxes, k, p)
    class(boxes_t), intent(in) :: boxes
    integer, intent(in) :: k
    real(wp), intent(in) :: p(:)
    box_distance_2 = sum(max(boxes%low(:, k) - p, p - boxes%high(:, k), zero)**2)
  end function box_distance_2

end module contact_boxes
