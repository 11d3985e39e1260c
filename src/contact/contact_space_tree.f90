! SPDX-License-Identifier: BSD-3-Clause
!> Trees of boxes over the facets of a net and over its sharp edges: what lies near a point or
!> in a box, the nearest facet of a point, how far two nets are apart at least.
module contact_space_tree
  use base_kinds, only: wp, zero, one
  use contact_boxes, only: boxes_t, build_boxes, refit_boxes, push_children, box_distance_2, &
      deepest_stack
  use contact_features, only: degree
  use contact_sight, only: seen_t, see_facet, distance_2, from_node, area_vector
  use contact_skin, only: skin_t, sharp_edge, dihedral
  implicit none
  private

  !> A tree with the boxes of its items as they are now; skin_item: what they are in the net.
  type, public :: space_tree_t
    type(boxes_t) :: boxes
    integer, allocatable :: skin_item(:)
    real(wp), allocatable :: low(:, :), high(:, :)   !< (3, items) [L]
  end type space_tree_t

  !> An edge of a smooth surface that is bent by more than this is one that may touch first.
  real(wp), parameter :: bent_edge = 5.0_wp*degree

  public :: place_facets, place_edges, items_in_box, nearest_facet, least_distance

contains

  !> The listed facets of a net at X + U.
  subroutine place_facets(skin, x, u, tree)
    type(skin_t), intent(in) :: skin
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(space_tree_t), intent(inout) :: tree
    integer :: k
    if (.not. allocated(tree%skin_item)) &
        tree%skin_item = pack([(k, k=1, skin%facets)], skin%is_listed)
    call start_boxes(tree)
    do k = 1, size(tree%skin_item)
      associate (f => tree%skin_item(k))
        call enclose(skin%node(:skin%corners(f), f), x, u, tree%low(:, k), tree%high(:, k))
      end associate
    end do
    call fit(tree)
  end subroutine place_facets

  !> The sharp edges of a net that have a listed facet, at X + U: sharp by the mesh, or as they
  !> are now. They may be others than the last time.
  subroutine place_edges(skin, x, u, tree)
    type(skin_t), intent(in) :: skin
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(space_tree_t), intent(inout) :: tree
    integer, allocatable :: list(:)
    logical :: is_same
    integer :: k
    allocate (list, source=sharp_edges(skin, x, u))
    is_same = allocated(tree%skin_item)
    if (is_same) is_same = size(list) == size(tree%skin_item)
    if (is_same) is_same = all(list == tree%skin_item)
    if (.not. is_same) then
      if (allocated(tree%low)) deallocate (tree%low, tree%high)
      tree%boxes = boxes_t()
      call move_alloc(list, tree%skin_item)
    end if
    call start_boxes(tree)
    do k = 1, size(tree%skin_item)
      call enclose(skin%ends(:, tree%skin_item(k)), x, u, tree%low(:, k), tree%high(:, k))
    end do
    call fit(tree)
  end subroutine place_edges

  function sharp_edges(skin, x, u) result(list)
    type(skin_t), intent(in) :: skin
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, allocatable :: list(:)
    logical :: counts(skin%edges)
    integer :: e, k
    do e = 1, skin%edges
      counts(e) = skin%beside(2, e) > 0
      if (counts(e)) counts(e) = any(skin%is_listed(skin%beside(:, e)))
      if (counts(e) .and. skin%turn(e) <= sharp_edge) &
          counts(e) = turn_now(skin, e, x, u) > bent_edge
    end do
    list = pack([(k, k=1, skin%edges)], counts)
  end function sharp_edges

  !> The angle between the facets of an edge as they are.
  pure real(wp) function turn_now(skin, e, x, u)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: e
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp) :: t(3)
    t = from_node(x, u, skin%ends(1, e), skin%ends(2, e))
    turn_now = dihedral(area_vector(skin, skin%beside(1, e), x, u), &
        area_vector(skin, skin%beside(2, e), x, u), t/max(norm2(t), tiny(one)))
  end function turn_now

  subroutine start_boxes(tree)
    type(space_tree_t), intent(inout) :: tree
    if (allocated(tree%low)) return
    allocate (tree%low(3, size(tree%skin_item)), tree%high(3, size(tree%skin_item)))
  end subroutine start_boxes

  pure subroutine enclose(node, x, u, low, high)
    integer, intent(in) :: node(:)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(out) :: low(3), high(3)
    integer :: k
    low = x(:, node(1)) + u(:, node(1))
    high = low
    do k = 2, size(node)
      low = min(low, x(:, node(k)) + u(:, node(k)))
      high = max(high, x(:, node(k)) + u(:, node(k)))
    end do
  end subroutine enclose

  subroutine fit(tree)
    type(space_tree_t), intent(inout) :: tree
    if (allocated(tree%boxes%item)) then
      call refit_boxes(tree%low, tree%high, tree%boxes)
    else
      call build_boxes(tree%low, tree%high, tree%boxes)
    end if
  end subroutine fit

  !> The items of the net whose boxes meet a box: the first n of list, which must hold them all.
  pure subroutine items_in_box(tree, low, high, list, n)
    type(space_tree_t), intent(in) :: tree
    real(wp), intent(in) :: low(3), high(3)
    integer, intent(inout) :: list(:)
    integer, intent(out) :: n
    integer :: stack(deepest_stack), top, k, i
    n = 0
    top = min(1, tree%boxes%n)
    stack(1) = 1
    do while (top > 0)
      k = stack(top)
      top = top - 1
      if (any(tree%boxes%low(:, k) > high .or. tree%boxes%high(:, k) < low)) cycle
      if (tree%boxes%child(k) > 0) then
        call push_children(tree%boxes, k, stack, top)
        cycle
      end if
      do i = tree%boxes%first(k), tree%boxes%last(k)
        associate (j => tree%boxes%item(i))
          if (any(tree%low(:, j) > high .or. tree%high(:, j) < low)) cycle
          n = n + 1
          list(n) = tree%skin_item(j)
        end associate
      end do
    end do
  end subroutine items_in_box

  !> The facet nearest to a place (3, 2) [L], of those that are not left out; facet 0: none.
  pure subroutine nearest_facet(tree, skin, x, u, from, left_out, nearest)
    type(space_tree_t), intent(in) :: tree
    type(skin_t), intent(in) :: skin
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(in) :: from(3, 2)
    logical, intent(in) :: left_out(:)
    type(seen_t), intent(out) :: nearest
    integer :: stack(deepest_stack), top, k, i
    type(seen_t) :: seen
    real(wp) :: p(3), best
    p = from(:, 1) + from(:, 2)
    best = huge(one)
    top = min(1, tree%boxes%n)
    stack(1) = 1
    do while (top > 0)
      k = stack(top)
      top = top - 1
      if (box_distance_2(tree%boxes, k, p) >= best) cycle
      if (tree%boxes%child(k) > 0) then
        call push_children(tree%boxes, k, stack, top)
        associate (c => tree%boxes%child(k))
          if (box_distance_2(tree%boxes, c, p) < box_distance_2(tree%boxes, c + 1, p)) &
              stack(top - 1:top) = [c + 1, c]
        end associate
        cycle
      end if
      do i = tree%boxes%first(k), tree%boxes%last(k)
        associate (j => tree%boxes%item(i))
          if (left_out(tree%skin_item(j))) cycle
          if (sum(max(tree%low(:, j) - p, p - tree%high(:, j), zero)**2) >= best) cycle
          call see_facet(skin, tree%skin_item(j), x, u, from, .false., seen)
        end associate
        if (distance_2(seen) >= best) cycle
        best = distance_2(seen)
        nearest = seen
      end do
    end do
  end subroutine nearest_facet

  !> No two points of two trees are nearer to each other than this [L], if it is less than
  !> limit: the distance of their boxes.
  real(wp) function least_distance(a, b, limit)
    type(space_tree_t), intent(in) :: a, b
    real(wp), intent(in) :: limit
    integer :: stack(2, 4*deepest_stack), top, i, j
    real(wp) :: best
    best = limit**2
    top = min(1, a%boxes%n, b%boxes%n)
    stack(:, 1) = 1
    do while (top > 0)
      i = stack(1, top)
      j = stack(2, top)
      top = top - 1
      if (boxes_apart(a%boxes%low(:, i), a%boxes%high(:, i), b%boxes%low(:, j), &
          b%boxes%high(:, j)) >= best) cycle
      if (a%boxes%child(i) > 0) then
        stack(:, top + 1) = [a%boxes%child(i), j]
        stack(:, top + 2) = [a%boxes%child(i) + 1, j]
        top = top + 2
      else if (b%boxes%child(j) > 0) then
        stack(:, top + 1) = [i, b%boxes%child(j)]
        stack(:, top + 2) = [i, b%boxes%child(j) + 1]
        top = top + 2
      else
        call compare_leaves(i, j)
      end if
    end do
    least_distance = sqrt(best)
  contains
    subroutine compare_leaves(i, j)
      integer, intent(in) :: i, j
      integer :: k, m
      do k = a%boxes%first(i), a%boxes%last(i)
        do m = b%boxes%first(j), b%boxes%last(j)
          associate (p => a%boxes%item(k), q => b%boxes%item(m))
            best = min(best, boxes_apart(a%low(:, p), a%high(:, p), b%low(:, q), b%high(:, q)))
          end associate
        end do
      end do
    end subroutine compare_leaves
  end function least_distance

  !> Square of the distance of two boxes [L2].
  pure real(wp) function boxes_apart(low_a, high_a, low_b, high_b)
    real(wp), intent(in) :: low_a(3), high_a(3), low_b(3), high_b(3)
    boxes_apart = sum(max(low_a - high_b, low_b - high_a, zero)**2)
  end function boxes_apart

end module contact_space_tree
