! SPDX-License-Identifier: BSD-3-Clause
!> A tree of boxes over the edges of a surface: which edges lie near a point or a box, the
!> distance of a point, how often the boundary winds round it. Built once, split at the median
!> of the longest axis; refitted when the edges have moved.
module contact_tree
  use base_kinds, only: wp, zero, one, half
  use base_sort, only: sort_order_real
  implicit none
  private

  integer, parameter :: leaf_size = 4
  integer, parameter :: most_levels = 64
  real(wp), parameter :: farthest = 1.0e150_wp    !< its square is a number

  type, public :: tree_t
    integer :: n = 0                          !< boxes
    integer, allocatable :: first(:), last(:) !< items of a box, places in item
    integer, allocatable :: child(:)          !< the first of two; 0 = leaf
    integer, allocatable :: item(:)           !< edges
    real(wp), allocatable :: low(:, :), high(:, :)   !< (2, boxes) [L]
    real(wp), allocatable :: a(:, :), b(:, :)        !< (2, edges) their ends now [L]
  end type tree_t

  public :: build_tree, refit_tree, edges_near, edges_in_box, distance_to_edges, winding_number

contains

  !> Tree over edges with ends a and b (2, edges) [L].
  subroutine build_tree(a, b, tree)
    real(wp), intent(in) :: a(:, :), b(:, :)
    type(tree_t), intent(out) :: tree
    integer :: n, k
    n = size(a, 2)
    allocate (tree%item(n), tree%a(2, n), tree%b(2, n))
    allocate (tree%first(2*n + 1), tree%last(2*n + 1), tree%child(2*n + 1))
    allocate (tree%low(2, 2*n + 1), tree%high(2, 2*n + 1))
    tree%item = [(k, k=1, n)]
    tree%a = a
    tree%b = b
    if (n == 0) return
    tree%n = 1
    tree%first(1) = 1
    tree%last(1) = n
    k = 1
    do while (k <= tree%n)
      call split(tree, k)
      k = k + 1
    end do
    call refit_tree(a, b, tree)
  end subroutine build_tree

  !> Makes two boxes of box k at the median of its longest axis; a small box is a leaf.
  subroutine split(tree, k)
    type(tree_t), intent(inout) :: tree
    integer, intent(in) :: k
    real(wp), allocatable :: middle(:, :)
    integer, allocatable :: order(:)
    integer :: axis, n, half_way
    tree%child(k) = 0
    n = tree%last(k) - tree%first(k) + 1
    if (n <= leaf_size) return
    associate (item => tree%item(tree%first(k):tree%last(k)))
      middle = half*(tree%a(:, item) + tree%b(:, item))
      axis = 1
      if (maxval(middle(2, :)) - minval(middle(2, :)) > &
          maxval(middle(1, :)) - minval(middle(1, :))) axis = 2
      allocate (order(n))
      call sort_order_real(middle(axis, :), order)
      item = item(order)
    end associate
    half_way = tree%first(k) + n/2 - 1
    tree%child(k) = tree%n + 1
    tree%first(tree%n + 1:tree%n + 2) = [tree%first(k), half_way + 1]
    tree%last(tree%n + 1:tree%n + 2) = [half_way, tree%last(k)]
    tree%n = tree%n + 2
  end subroutine split

  !> Boxes for edges that have moved to a and b: children stand behind their parent.
  pure subroutine refit_tree(a, b, tree)
    real(wp), intent(in) :: a(:, :), b(:, :)
    type(tree_t), intent(inout) :: tree
    integer :: k, i
    tree%a = a
    tree%b = b
    do k = tree%n, 1, -1
      if (tree%child(k) > 0) then
        associate (c => tree%child(k))
          tree%low(:, k) = min(tree%low(:, c), tree%low(:, c + 1))
          tree%high(:, k) = max(tree%high(:, c), tree%high(:, c + 1))
        end associate
      else
        tree%low(:, k) = huge(one)
        tree%high(:, k) = -huge(one)
        do i = tree%first(k), tree%last(k)
          tree%low(:, k) = min(tree%low(:, k), a(:, tree%item(i)), b(:, tree%item(i)))
          tree%high(:, k) = max(tree%high(:, k), a(:, tree%item(i)), b(:, tree%item(i)))
        end do
      end if
    end do
  end subroutine refit_tree

  !> Adds to list, after its first n entries, the edges within reach [L] of point p. list must
  !> hold them all.
  pure subroutine edges_near(tree, p, reach, list, n)
    type(tree_t), intent(in) :: tree
    real(wp), intent(in) :: p(2), reach
    integer, intent(inout) :: list(:), n
    integer :: stack(2*most_levels), top, k, i
    if (tree%n == 0) return
    top = 1
    stack(1) = 1
    do while (top > 0)
      k = stack(top)
      top = top - 1
      if (box_distance_2(tree, k, p) > reach**2) cycle
      if (tree%child(k) > 0) then
        call push_children(tree, k, stack, top)
        cycle
      end if
      do i = tree%first(k), tree%last(k)
        if (edge_distance_2(tree, tree%item(i), p) > reach**2) cycle
        n = n + 1
        list(n) = tree%item(i)
      end do
    end do
  end subroutine edges_near

  !> Adds to list, after its first n entries, the edges whose boxes meet a box.
  pure subroutine edges_in_box(tree, low, high, list, n)
    type(tree_t), intent(in) :: tree
    real(wp), intent(in) :: low(2), high(2)
    integer, intent(inout) :: list(:), n
    integer :: stack(2*most_levels), top, k, i
    if (tree%n == 0) return
    top = 1
    stack(1) = 1
    do while (top > 0)
      k = stack(top)
      top = top - 1
      if (any(tree%low(:, k) > high .or. tree%high(:, k) < low)) cycle
      if (tree%child(k) > 0) then
        call push_children(tree, k, stack, top)
        cycle
      end if
      do i = tree%first(k), tree%last(k)
        associate (e => tree%item(i))
          if (any(min(tree%a(:, e), tree%b(:, e)) > high .or. &
              max(tree%a(:, e), tree%b(:, e)) < low)) cycle
          n = n + 1
          list(n) = e
        end associate
      end do
    end do
  end subroutine edges_in_box

  !> Distance [L] of point p from the nearest edge that is not to be left out, if it is less
  !> than limit; limit otherwise. edge: which, 0 = none.
  pure subroutine distance_to_edges(tree, p, left_out, limit, distance, edge)
    type(tree_t), intent(in) :: tree
    logical, intent(in) :: left_out(:)
    real(wp), intent(in) :: p(2), limit
    real(wp), intent(out) :: distance
    integer, intent(out) :: edge
    integer :: stack(2*most_levels), top, k, i
    real(wp) :: best, d
    best = min(limit, farthest)**2
    edge = 0
    top = min(1, tree%n)
    stack(1) = 1
    do while (top > 0)
      k = stack(top)
      top = top - 1
      if (box_distance_2(tree, k, p) >= best) cycle
      if (tree%child(k) > 0) then
        call push_children(tree, k, stack, top)
        if (box_distance_2(tree, tree%child(k), p) < &
            box_distance_2(tree, tree%child(k) + 1, p)) &
            stack(top - 1:top) = [tree%child(k) + 1, tree%child(k)]
        cycle
      end if
      do i = tree%first(k), tree%last(k)
        associate (e => tree%item(i))
          if (left_out(e)) cycle
          d = edge_distance_2(tree, e, p)
          if (d >= best) cycle
          best = d
          edge = e
        end associate
      end do
    end do
    distance = sqrt(best)
    if (edge == 0) distance = limit
  end subroutine distance_to_edges

  !> How often the edges that are not left out wind round point p: by the crossings of the ray
  !> in the direction of x (Shimrat 1962, with signs). 0 outside.
  pure integer function winding_number(tree, p, left_out)
    type(tree_t), intent(in) :: tree
    logical, intent(in) :: left_out(:)
    real(wp), intent(in) :: p(2)
    integer :: stack(2*most_levels), top, k, i
    winding_number = 0
    top = min(1, tree%n)
    stack(1) = 1
    do while (top > 0)
      k = stack(top)
      top = top - 1
      if (tree%high(1, k) < p(1) .or. tree%low(2, k) > p(2) .or. tree%high(2, k) < p(2)) cycle
      if (tree%child(k) > 0) then
        call push_children(tree, k, stack, top)
        cycle
      end if
      do i = tree%first(k), tree%last(k)
        associate (a => tree%a(:, tree%item(i)), b => tree%b(:, tree%item(i)))
          if (left_out(tree%item(i))) cycle
          if ((a(2) > p(2)) .eqv. (b(2) > p(2))) cycle
          if (p(1) < a(1) + (b(1) - a(1))*((p(2) - a(2))/(b(2) - a(2)))) &
              winding_number = winding_number + merge(1, -1, b(2) > a(2))
        end associate
      end do
    end do
  end function winding_number

  pure subroutine push_children(tree, k, stack, top)
    type(tree_t), intent(in) :: tree
    integer, intent(in) :: k
    integer, intent(inout) :: stack(:), top
    stack(top + 1:top + 2) = [tree%child(k), tree%child(k) + 1]
    top = top + 2
  end subroutine push_children

  pure real(wp) function box_distance_2(tree, k, p)
    type(tree_t), intent(in) :: tree
    integer, intent(in) :: k
    real(wp), intent(in) :: p(2)
    box_distance_2 = sum(max(tree%low(:, k) - p, p - tree%high(:, k), zero)**2)
  end function box_distance_2

  pure real(wp) function edge_distance_2(tree, e, p)
    type(tree_t), intent(in) :: tree
    integer, intent(in) :: e
    real(wp), intent(in) :: p(2)
    real(wp) :: d(2), y(2), s
    d = tree%b(:, e) - tree%a(:, e)
    y = p - tree%a(:, e)
    s = min(one, max(zero, dot_product(y, d)/max(dot_product(d, d), tiny(one))))
    edge_distance_2 = sum((y - s*d)**2)
  end function edge_distance_2

end module contact_tree
