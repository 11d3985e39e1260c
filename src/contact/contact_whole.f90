! SPDX-License-Identifier: BSD-3-Clause
!> True overlap of whole bodies: all nodes and edges of two boundaries, listed or not.
module contact_whole
  use base_kinds, only: wp, zero, one, half
  use contact_features, only: difference, end_tolerance
  use contact_near, only: near_t
  use contact_overlap, only: open_gap, passage_through
  use contact_pairing, only: overlap_t, note_overlap
  use contact_surface, only: surface_t, shortest_edge_at
  use contact_tree, only: tree_t, edges_in_box, distance_to_edges, winding_number
  implicit none
  private
  public :: deepest_node, deepest_inner_point, deepest_crossing, deepest_before_open, &
      deepest_passage, accepted_overlap, note_node

contains

  !> The deepest node of `own` inside the closed obstacle at X + U; found: some node is
  !> inside. is_self: both are one surface of several bodies; each node asks for the others.
  !> Pairs of parts may be left out.
  subroutine deepest_node(own, obstacle, tree, x, u, is_self, leaves_out, overlap, found)
    type(surface_t), intent(in) :: own, obstacle
    type(tree_t), intent(in) :: tree
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    logical, intent(in) :: is_self, leaves_out(:, :)
    type(overlap_t), intent(inout) :: overlap
    logical, intent(inout) :: found
    logical :: left_out(size(obstacle%length))
    real(wp) :: p(2), distance
    integer :: k, edge, own_edge, last
    if (tree%n == 0) return
    left_out = .false.
    last = 0
    do k = 1, size(own%node)
      p = x(:, own%node(k)) + u(:, own%node(k))
      if (any(p < tree%low(:, 1) .or. p > tree%high(:, 1))) cycle
      if (is_self) then
        own_edge = own%node_edge(1, k)
        if (own_edge == 0) cycle
        if (last == 0) then
          call leave_out(own, own_edge, leaves_out, left_out)
        else if (own%body(own_edge) /= own%body(last) .or. &
            own%part(own_edge) /= own%part(last)) then
          call leave_out(own, own_edge, leaves_out, left_out)
        end if
        last = own_edge
      else if (obstacle%index(own%node(k)) > 0) then
        cycle
      end if
      if (winding_number(tree, p, left_out) <= 0) cycle
      call distance_to_edges(tree, p, left_out, huge(one), distance, edge)
      if (edge == 0) cycle
      found = found .or. distance > end_tolerance*obstacle%length(edge)
      call note_node(overlap, distance, own, k, obstacle, edge)
    end do
  end subroutine deepest_node

  !> Node k of `own` is depth [L] behind an edge of the obstacle; kept if it is the deepest.
  pure subroutine note_node(overlap, depth, own, k, obstacle, edge)
    type(overlap_t), intent(inout) :: overlap
    real(wp), intent(in) :: depth
    type(surface_t), intent(in) :: own, obstacle
    integer, intent(in) :: k, edge
    call note_overlap(overlap, depth, min(obstacle%length(edge), &
        shortest_edge_at(own, k, obstacle%length(edge))), own%node(k), &
        obstacle%part_id(edge), .false.)
  end subroutine note_node

  !> Bodies whose sides lie on one line may overlap though no node is inside and no edges
  !> cross properly: points just inside the middle of every edge of `own` are asked too.
  subroutine deepest_inner_point(own, obstacle, tree, x, u, is_self, leaves_out, overlap)
    type(surface_t), intent(in) :: own, obstacle
    type(tree_t), intent(in) :: tree
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    logical, intent(in) :: is_self, leaves_out(:, :)
    type(overlap_t), intent(inout) :: overlap
    real(wp), parameter :: inward = 1.0e-3_wp
    logical :: left_out(size(obstacle%length))
    real(wp) :: a(2), d(2), p(2), distance
    integer :: e, edge
    if (tree%n == 0) return
    left_out = .false.
    do e = 1, size(own%length)
      if (.not. own%is_listed(e)) cycle
      a = x(:, own%end_node(1, e)) + u(:, own%end_node(1, e))
      d = difference(x, u, own%end_node(2, e), own%end_node(1, e))
      p = a + half*d + inward*[-d(2), d(1)]
      if (any(p < tree%low(:, 1) .or. p > tree%high(:, 1))) cycle
      if (is_self) call leave_out(own, e, leaves_out, left_out)
      if (winding_number(tree, p, left_out) <= 0) cycle
      call distance_to_edges(tree, p, left_out, huge(one), distance, edge)
      distance = distance + inward*sqrt(sum(d**2))
      if (edge > 0) call note_overlap(overlap, distance, min(own%length(e), &
          obstacle%length(edge)), own%end_node(1, e), obstacle%part_id(edge), .false.)
    end do
  end subroutine deepest_inner_point

  !> Edges of the body of an edge, and of parts that its part does not touch.
  pure subroutine leave_out(surface, own_edge, leaves_out, left_out)
    type(surface_t), intent(in) :: surface
    integer, intent(in) :: own_edge
    logical, intent(in) :: leaves_out(:, :)
    logical, intent(out) :: left_out(:)
    left_out = surface%body == surface%body(own_edge)
    if (size(leaves_out) > 0) left_out = left_out .or. &
        leaves_out(surface%part(own_edge), surface%part)
  end subroutine leave_out

  !> The deepest proper crossing of an edge of `own` with one of the obstacle, also of the same
  !> body that folds: the sine of their angle times the nearer end.
  subroutine deepest_crossing(own, obstacle, tree, x, u, leaves_out, overlap)
    type(surface_t), intent(in) :: own, obstacle
    type(tree_t), intent(in) :: tree
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    logical, intent(in) :: leaves_out(:, :)
    type(overlap_t), intent(inout) :: overlap
    integer, allocatable :: found(:)
    real(wp) :: a(2), b(2), depth
    integer :: e, i, n
    allocate (found(size(obstacle%length)))
    do e = 1, size(own%length)
      a = x(:, own%end_node(1, e)) + u(:, own%end_node(1, e))
      b = x(:, own%end_node(2, e)) + u(:, own%end_node(2, e))
      n = 0
      call edges_in_box(tree, min(a, b), max(a, b), found, n)
      do i = 1, n
        if (size(leaves_out) > 0) then
          if (leaves_out(own%part(e), obstacle%part(found(i)))) cycle
        end if
        if (shares_node(own%end_node(:, e), obstacle%end_node(:, found(i)))) cycle
        depth = depth_of_crossing(a, b, tree%a(:, found(i)), tree%b(:, found(i)))
        if (depth > zero) call note_overlap(overlap, depth, &
            min(own%length(e), obstacle%length(found(i))), own%end_node(1, e), &
            obstacle%part_id(found(i)), .true.)
      end do
    end do
  end subroutine deepest_crossing

  pure logical function shares_node(a, b)
    integer, intent(in) :: a(2), b(2)
    shares_node = any(a(1) == b) .or. any(a(2) == b)
  end function shares_node

  !> Zero where the segments a-b and c-d do not cross.
  pure real(wp) function depth_of_crossing(a, b, c, d)
    real(wp), intent(in) :: a(2), b(2), c(2), d(2)
    real(wp) :: p(2), q(2), r(2), det, s, t, length_p, length_q
    depth_of_crossing = zero
    p = b - a
    q = d - c
    r = c - a
    det = p(1)*q(2) - p(2)*q(1)
    length_p = sqrt(sum(p**2))
    length_q = sqrt(sum(q**2))
    if (.not. abs(det) > epsilon(one)*length_p*length_q) return
    s = (r(1)*q(2) - r(2)*q(1))/det
    t = (r(1)*p(2) - r(2)*p(1))/det
    if (min(s, t, one - s, one - t) <= zero) return
    depth_of_crossing = abs(det)/(length_p*length_q) &
        *min(min(s, one - s)*length_p, min(t, one - t)*length_q)
  end function depth_of_crossing

  !> Near nodes of `own` just behind the edges of an open obstacle.
  pure subroutine deepest_before_open(own, obstacle, near, x, u, overlap)
    type(surface_t), intent(in) :: own, obstacle
    type(near_t), intent(in) :: near
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(overlap_t), intent(inout) :: overlap
    real(wp) :: gap
    integer :: i, edge
    do i = 1, near%n
      call open_gap(own, obstacle, near%node(i), &
          near%edge(near%first(i):near%first(i + 1) - 1), x, u, gap, edge)
      if (gap < zero) call note_overlap(overlap, -gap, obstacle%length(edge), &
          own%node(near%node(i)), obstacle%part_id(edge), .false.)
    end do
  end subroutine deepest_before_open

  !> What may overlap at the start: the digits of a deck do not give a touch better [L].
  !> Fields of ten columns hold seven digits of a coordinate.
  pure real(wp) function accepted_overlap(side, tolerance, x, u)
    type(surface_t), intent(in) :: side(2)
    real(wp), intent(in) :: tolerance      ! / edge length
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp) :: low(2), high(2), p(2), shortest
    integer :: s, k
    low = huge(one)
    high = -huge(one)
    do s = 1, 2
      do k = 1, size(side(s)%node)
        p = x(:, side(s)%node(k)) + u(:, side(s)%node(k))
        low = min(low, p)
        high = max(high, p)
      end do
    end do
    shortest = min(side(1)%shortest, side(2)%shortest)
    accepted_overlap = min(1.0e-3_wp*shortest, max(tolerance*shortest, &
        1.0e-7_wp*half*sqrt(sum((high - low)**2))))
  end function accepted_overlap

  !> Of the near nodes of `own` that stand outside a closed obstacle the one that was
  !> deepest inside within a step of motion du to u.
  pure subroutine deepest_passage(own, obstacle, near, x, u, du, overlap)
    type(surface_t), intent(in) :: own, obstacle
    type(near_t), intent(in) :: near
    real(wp), intent(in), contiguous :: x(:, :), u(:, :), du(:, :)
    type(overlap_t), intent(inout) :: overlap
    real(wp) :: depth
    integer :: i, edge
    do i = 1, near%n
      if (near%distance(i) < zero) cycle
      call passage_through(obstacle, near%edge(near%first(i):near%first(i + 1) - 1), x, u, du, &
          own%node(near%node(i)), depth, edge)
      if (edge == 0) cycle
      call note_node(overlap, depth, own, near%node(i), obstacle, edge)
    end do
  end subroutine deepest_passage

end module contact_whole
