! SPDX-License-Identifier: BSD-3-Clause
!> True overlap of bodies, from their boundaries alone: it asks neither rows nor normals nor
!> which nodes are exact.
module contact_overlap
  use base_kinds, only: wp, zero, one
  use contact_features, only: difference, frame_t, edge_frame, local_coordinate, &
      gap_to_edge, end_tolerance, cone_of_node_t, cone_of_node, faces, facing_angle
  use contact_near, only: is_away, is_in_front, is_behind
  use contact_surface, only: surface_t
  implicit none
  private
  public :: true_gap, look_again, passage_through, open_gap, update_front

  !> Edges: shallower nodes are inside where the listed edges say so.
  real(wp), parameter :: sure = 5.0e-3_wp
  !> Edges: how far outside a node its own body is asked for.
  real(wp), parameter :: outward = 1.0e-3_wp
  !> Before an open obstacle a node this share of an edge deep is no longer behind it.
  real(wp), parameter :: deepest = 0.3_wp

contains

  !> Distance of a node from the nearest listed edge at X + U [L], negative inside the body,
  !> and that edge. Where a vertex is nearest, the node is outside a convex corner, inside a
  !> reflex one.
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
      ! In front of the edge at a corner that was sharp and convex: outside.
      if (cross > zero .and. is_sharp_there(obstacle, edge, place)) return
      if (is_behind_vertex(obstacle, edge, place, x, u, node)) gap = -gap
    end if
  end subroutine true_gap

  !> Is the boundary sharp and convex at the first (1) or second (2) node of an edge?
  pure logical function is_sharp_there(obstacle, edge, place)
    type(surface_t), intent(in) :: obstacle
    integer, intent(in) :: edge, place
    is_sharp_there = obstacle%turn(obstacle%index(obstacle%end_node(place, edge))) > one
  end function is_sharp_there

  !> Of a node to which the first (1) or second (2) node of an edge is the nearest point of
  !> the listed boundary: does it stand behind it? In front of a convex vertex it is where one
  !> of the edges has it in front, in front of a reflex one where both have.
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

  !> Is a node, moved by shift [L], inside the closed obstacle, all its edges asked, or those
  !> of one body alone, or those of the others (0: neither)? depth [L] below the edge nearest
  !> to it.
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

  !> A deep node is looked at with all edges of a closed obstacle: those on the list are only
  !> those that may face it, and the far side of a thin body may be among them.
  pure subroutine look_again(own, obstacle, is_self, k, x, u, gap, edge)
    type(surface_t), intent(in) :: own, obstacle
    logical, intent(in) :: is_self
    integer, intent(in) :: k
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(inout) :: gap
    integer, intent(inout) :: edge
    type(cone_of_node_t) :: cone
    real(wp) :: depth
    logical :: is_inside
    integer :: body, other
    if (-gap < sure*obstacle%length(edge) .or. .not. obstacle%is_closed) return
    body = 0
    if (is_self) body = own%body(maxval(own%node_edge(:, k)))
    if (body == obstacle%body(edge)) then
      ! Of its own body: just outside the node is its inside again, where it closes on itself.
      call cone_of_node(own, k, x, u, .false., cone)
      call confirm_inside(obstacle, x, u, own%node(k), outward*own%shortest*cone%middle, &
          body, 0, is_inside, depth, other)
      if (.not. is_inside) gap = -gap
    else
      call confirm_inside(obstacle, x, u, own%node(k), [zero, zero], 0, body, is_inside, &
          depth, edge)
      gap = merge(-depth, depth, is_inside)
    end if
  end subroutine look_again

  !> How deep [L] a node was on its way through a closed obstacle in a step of motion du to
  !> u, and the edge where it came in (0: nowhere): through a listed edge from the front, at
  !> times between then and the end, all motions linear in time.
  pure subroutine passage_through(obstacle, list, x, u, du, node, depth, edge)
    type(surface_t), intent(in) :: obstacle
    integer, intent(in) :: list(:), node
    real(wp), intent(in), contiguous :: x(:, :), u(:, :), du(:, :)
    real(wp), intent(out) :: depth
    integer, intent(out) :: edge
    !> Shares of the rest of the step; the smaller ones where the way is long.
    integer, parameter :: times = 8, even = times - 1, halves = 10
    integer :: i
    real(wp), parameter :: share(even + halves) = [(real(i, wp)/times, i = 1, even), &
        (scale(one/times, -i), i = 1, halves)]
    real(wp) :: start, now, deep, way_2
    integer :: j, k, nearest
    logical :: is_inside
    depth = zero
    edge = 0
    do j = 1, size(list)
      start = instant_of_entry(obstacle, list(j), x, u, du, node)
      if (start > one) cycle
      way_2 = sum((du(:, node) - du(:, obstacle%end_node(1, list(j))))**2)
      do k = 1, merge(size(share), even, way_2 > (times*obstacle%shortest)**2)
        now = start + (one - start)*share(k)
        call confirm_inside(obstacle, x, u - (one - now)*du, node, [zero, zero], 0, 0, &
            is_inside, deep, nearest)
        if (.not. is_inside .or. deep <= depth) cycle
        depth = deep
        edge = list(j)
      end do
    end do
  end subroutine passage_through

  !> When in the step a node passes an edge from its front to its back; 2: it does not.
  pure real(wp) function instant_of_entry(obstacle, edge, x, u, du, node)
    type(surface_t), intent(in) :: obstacle
    integer, intent(in) :: edge, node
    real(wp), intent(in), contiguous :: x(:, :), u(:, :), du(:, :)
    real(wp) :: d(2, 2), y(2, 2), g(2), t, s
    instant_of_entry = 2.0_wp
    associate (a => obstacle%end_node(1, edge), b => obstacle%end_node(2, edge))
      d(:, 2) = difference(x, u, b, a)
      y(:, 2) = difference(x, u, node, a)
      d(:, 1) = d(:, 2) - (du(:, b) - du(:, a))
      y(:, 1) = y(:, 2) - (du(:, node) - du(:, a))
    end associate
    g = d(2, :)*y(1, :) - d(1, :)*y(2, :)
    if (g(1) < zero .or. g(2) >= zero) return
    t = g(1)/(g(1) - g(2))
    d(:, 1) = (one - t)*d(:, 1) + t*d(:, 2)
    y(:, 1) = (one - t)*y(:, 1) + t*y(:, 2)
    s = dot_product(d(:, 1), y(:, 1))
    if (s >= zero .and. s <= dot_product(d(:, 1), d(:, 1))) instant_of_entry = t
  end function instant_of_entry

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

  !> Where entry i of a list stands with regard to an open obstacle: a node that comes from
  !> behind is not in front because it has passed the edge.
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

end module contact_overlap
