! SPDX-License-Identifier: BSD-3-Clause
!> The tree of boxes over the edges of a surface in the plane: which edges lie near a point or a
!> box, the distance of a point, how often the boundary winds round it.
module contact_tree
  use base_kinds, only: wp, zero, one
  use contact_boxes, only: boxes_t, build_boxes, refit_boxes, push_children, box_distance_2, &
      deepest_stack
  implicit none
  private

  real(wp), parameter :: farthest = 1.0e150_wp    !< its square is a number

  type, extends(boxes_t), public :: tree_t
    real(wp), allocatable :: a(:, :), b(:, :)        !< (2, edges) their ends now [L]
  end type tree_t

  public :: build_tree, refit_tree, edges_near, edges_in_box, distance_to_edges, winding_number

contains

  !> Tree over edges with ends a and b (2, edges) [L].
  subroutine build_tree(a, b, tree)
    real(wp), intent(in) :: a(:, :), b(:, :)
    type(tree_t), intent(out) :: tree
    tree%a = a
    tree%b = b
    call build_boxes(min(a, b), max(a, b), tree)
  end subroutine build_tree

  !> Boxes for edges that have moved to a and b.
  subroutine refit_tree(a, b, tree)
    real(wp), intent(in) :: a(:, :), b(:, :)
    type(tree_t), intent(inout) :: tree
    tree%a = a
    tree%b = b
    call refit_boxes(min(a, b), max(a, b), tree)
  end subroutine refit_tree

  !> Adds to list, after its first n entries, the edges within reach [L] of point p. list must
  !> hold them all.
  pure subroutine edges_near(tree, p, reach, list, n)
    type(tree_t), intent(in) :: tree
    real(wp), intent(in) :: p(2), reach
    integer, intent(inout) :: list(:), n
    integer :: stack(deepest_stack), top, k, i
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
    integer :: stack(deepest_stack), top, k, i
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
    integer :: stack(deepest_stack), top, k, i
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
    integer :: stack(deepest_stack), top, k, i
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
