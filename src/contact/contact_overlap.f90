! SPDX-License-Identifier: BSD-3-Clause
!> True overlap of bodies, from their boundaries alone: it asks neither rows nor normals nor which
!> nodes are exact.
module contact_overlap
  use base_kinds, only: wp, zero, one, half
  use contact_features, only: difference, frame_t, edge_frame, local_coordinate, &
      gap_to_edge, end_tolerance, cone_of_node_t, cone_of_node, faces, facing_angle
  use contact_near, only: near_t, is_away, is_in_front, is_behind
  use contact_pairing, only: overlap_t, note_overlap
  use contact_places, only: is_excluded
  use contact_surface, only: surface_t
  use contact_tree, only: tree_t, edges_in_box, edges_near, distance_to_edges, winding_number
  implicit none
  private
  public :: true_gap, confirm_inside, update_front, deepest_node, deepest_inner_point, &
      deepest_crossing, open_gap

  !> Before an open obstacle a node this share of an edge deep is no longer behind it.
  real(wp), parameter :: deepest = 0.3_wp

contains

  !> Distance of a node from the nearest listed edge at X + U [L], negative inside the body, and
  !> that edge. Where a vertex is nearest, the node is outside a convex corner, inside a reflex
  !> one.
  pure subroutine true_gap(obstacle, list, x, u, node, gap, edge)
    type(surface_t), intent(in) :: obstacle
    integer, intent(in) :: list(:), node
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(out) :: gap
    integer, intent(out) :: edge
    real(wp) :: d(2), y(2), s, length_2, distance_2, best, cross
    integer :: j, at, place
    best = huge(one)
    edge = 0
    cross = zero
    place = 0
    do j = 1, size(list)
      associate (a => obstacle%end_node(1, list(j)), b => obstacle%end_node(2, list(j)))
        d(1) = (x(1, b) - x(1, a)) + (u(1, b) - u(1, a))
        d(2) = (x(2, b) - x(2, a)) + (u(2, b) - u(2, a))
        y(1) = (x(1, node) - x(1, a)) + (u(1, node) - u(1, a))
        y(2) = (x(2, node) - x(2, a)) + (u(2, node) - u(2, a))
        length_2 = d(1)**2 + d(2)**2
        s = d(1)*y(1) + d(2)*y(2)
        at = 0
        if (s <= zero) then
          at = 1
          distance_2 = y(1)**2 + y(2)**2
        else if (s >= length_2) then
          at = 2
          y = y - d
          distance_2 = y(1)**2 + y(2)**2
        else
          distance_2 = (d(2)*y(1) - d(1)*y(2))**2/length_2
        end if
      end associate
      if (distance_2 >= best) cycle
      best = distance_2
      edge = list(j)
      place = at
      cross = d(2)*y(1) - d(1)*y(2)
    end do
    gap = sqrt(best)
    if (edge == 0) return
    if (place == 0 .and. cross < zero) gap = -gap
    if (place > 0) then
      if (is_behind_vertex(obstacle, edge, place, x, u, node)) gap = -gap
    end if
  end subroutine true_gap

  !> Of a node to which the first (1) or second (2) node of an edge is the nearest point of the
  !> listed boundary: does it stand behind it? In front of a convex vertex it is where one of the
  !> edges has it in front, in front of a reflex one where both have.
  pure logical function is_behind_vertex(obstacle, edge, place, x, u, node)
    type(surface_t), intent(in) :: obstacle
    integer, intent(in) :: edge, place, node
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp) :: a(2), b(2), y(2), turn, g(2)
    integer :: other
    other = obstacle%neighbour(place, edge)
    is_behind_vertex = .false.
    if (other == 0) return
    a = difference(x, u, obstacle%end_node(2, edge), obstacle%end_node(1, edge))
    b = difference(x, u, obstacle%end_node(2, other), obstacle%end_node(1, other))
    a = a/max(sqrt(sum(a**2)), tiny(one))
    b = b/max(sqrt(sum(b**2)), tiny(one))
    y = difference(x, u, node, obstacle%end_node(place, edge))
    g = [a(2)*y(1) - a(1)*y(2), b(2)*y(1) - b(1)*y(2)]
    turn = (a(1)*b(2) - a(2)*b(1))*merge(one, -one, place == 2)
    if (abs(turn) < 1.0e-3_wp) then
      is_behind_vertex = g(1) + g(2) < zero
    else if (turn > zero) then
      is_behind_vertex = max(g(1), g(2)) < zero
    else
      is_behind_vertex = min(g(1), g(2)) < zero
    end if
  end function is_behind_vertex

  !> Is a node, moved by shift [L], inside the closed obstacle, all its edges asked, or those of one
  !> body alone, or those of the others (0: neither)? depth [L] below the edge nearest to it.
  pure subroutine confirm_inside(obstacle, x, u, node, shift, only, without, is_inside, depth, &
      edge)
    type(surface_t), intent(in) :: obstacle
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(in) :: shift(2)
    integer, intent(in) :: node, only, without
    logical, intent(out) :: is_inside
    real(wp), intent(out) :: depth
    integer, intent(out) :: edge
    real(wp) :: d(2), y(2), s, best, distance_2
    integer :: e, winding
    winding = 0
    best = huge(one)
    edge = 0
    do e = 1, size(obstacle%length)
      if (obstacle%body(e) == without .or. (only > 0 .and. obstacle%body(e) /= only)) cycle
      d = difference(x, u, obstacle%end_node(2, e), obstacle%end_node(1, e))
      y = difference(x, u, node, obstacle%end_node(1, e)) + shift
      if ((y(2) < zero) .neqv. (y(2) < d(2))) then
        if (y(1)*abs(d(2)) < sign(one, d(2))*d(1)*y(2)) winding = winding + &
            merge(1, -1, d(2) > zero)
      end if
      s = min(one, max(zero, (d(1)*y(1) + d(2)*y(2))/max(d(1)**2 + d(2)**2, tiny(one))))
      distance_2 = (y(1) - s*d(1))**2 + (y(2) - s*d(2))**2
      if (distance_2 >= best) cycle
      best = distance_2
      edge = e
    end do
    is_inside = winding > 0
    depth = sqrt(best)
  end subroutine confirm_inside

  !> Gap of row k of the nodes of `own` to the nearest facing edge of an open obstacle whose
  !> extent holds it and from which it is not too deep; huge: none.
  pure subroutine open_gap(own, obstacle, k, list, x, u, gap, edge)
    type(surface_t), intent(in) :: own, obstacle
    integer, intent(in) :: k, list(:)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(out) :: gap
    integer, intent(out) :: edge
    type(cone_of_node_t) :: cone
    type(frame_t) :: frame
    real(wp) :: s, g
    integer :: j
    gap = huge(one)
    edge = 0
    call cone_of_node(own, k, x, u, .false., cone)
    do j = 1, size(list)
      call edge_frame(obstacle, list(j), x, u, .false., frame)
      s = local_coordinate(obstacle, list(j), frame, x, u, own%node(k))
      if (s < -end_tolerance .or. s > one + end_tolerance) cycle
      g = gap_to_edge(obstacle, list(j), frame%normal, s, x, u, own%node(k))
      if (g < -deepest*obstacle%length(list(j)) .or. abs(g) >= abs(gap)) cycle
      if (.not. faces(frame%normal, cone, facing_angle)) cycle
      gap = g
      edge = list(j)
    end do
  end subroutine open_gap

  !> Where entry i of a list stands with regard to an open obstacle: a node that comes from behind
  !> is not in front because it has passed the edge.
  pure subroutine update_front(gap, accepted, front)
    real(wp), intent(in) :: gap, accepted
    integer, intent(inout) :: front
    if (gap >= huge(one)) then
      front = is_away
    else if (gap >= -accepted) then
      front = is_in_front
    else if (front == is_away) then
      front = is_behind
    end if
  end subroutine update_front

  !> The deepest node of `own` inside the closed obstacle at X + U; found: some node is inside.
  !> is_self: both are one surface of several bodies; each node asks for the others. Pairs of parts
  !> may be left out.
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
        else if (own%body(own_edge) /= own%body(last) .or. own%part(own_edge) /= own%part(last)) &
            then
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
      call note_overlap(overlap, distance, shorter_edge(own, k, obstacle%length(edge)), &
          own%node(k), obstacle%part_id(edge), .false.)
    end do
  end subroutine deepest_node

  !> Bodies whose sides lie on one line may overlap though no node is inside and no edges cross
  !> properly: points just inside the middle of every edge of `own` are asked too.
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

  !> The shorter of an edge [L] and the edges of row k of the nodes.
  pure real(wp) function shorter_edge(own, k, length)
    type(surface_t), intent(in) :: own
    integer, intent(in) :: k
    real(wp), intent(in) :: length
    shorter_edge = length
    if (all(own%chain(:, k) > 0)) shorter_edge = min(length, minval(own%chain_length(:, k)))
  end function shorter_edge

  !> The deepest proper crossing of an edge of `own` with one of the obstacle: the sine of their
  !> angle times the nearer end.
  subroutine deepest_crossing(own, obstacle, tree, x, u, is_self, leaves_out, overlap)
    type(surface_t), intent(in) :: own, obstacle
    type(tree_t), intent(in) :: tree
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    logical, intent(in) :: is_self, leaves_out(:, :)
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
        if (is_self .and. own%body(e) == obstacle%body(found(i))) cycle
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

end module contact_overlap
