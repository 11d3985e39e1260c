! SPDX-License-Identifier: BSD-3-Clause
!> Which nodes may touch soon. A search lists them and measures the distance of all others;
!> while the bodies have moved less than that distance relative to each other, nobody needs to
!> search.
module contact_search
  use base_kinds, only: wp, zero, one, half
  use base_status, only: status_t, fail, failed, status_numerical, status_deck
  use base_strings, only: to_text
  use contact_surface, only: surface_t, facing, edge_tangent
  use contact_track, only: gap_to_edge, place_on_edge, end_tolerance
  use contact_types, only: contact_t, pair_t, candidate_t
  use contact_wall, only: wall_distance, check_wall
  use model_data, only: model_t
  implicit none
  private
  public :: test_sleep, search_pair

contains

  !> True while no node off the list can touch before the end of the coming step:
  !> |c_A - c_B| + max|u - u_ref - c_A| + max|u - u_ref - c_B|, c = mean displacement of a side
  !> since the search, bounds the relative motion (triangle inequality); it must stay below the
  !> smallest distance found, with twice the motion of the last step kept for the coming one.
  !> largest [L] is the largest motion of a node in the last step: while twice its sum since the
  !> bound was last evaluated leaves room, the bound itself need not be.
  subroutine test_sleep(pair, u, largest, asleep)
    type(pair_t), intent(inout) :: pair
    real(wp), intent(in), contiguous :: u(:, :)
    real(wp), intent(in) :: largest
    logical, intent(out) :: asleep
    real(wp) :: mean_a(2), mean_b(2), spread_a, spread_b, moved
    asleep = pair%safe_distance >= huge(one)
    if (asleep .or. pair%safe_distance < zero) return
    pair%remaining_margin = pair%remaining_margin - 2.0_wp*largest
    asleep = pair%remaining_margin > 4.0_wp*largest
    if (asleep) return
    call side_motion(pair%contactor%node, pair%contactor_reference, u, mean_a, spread_a)
    call side_motion(pair%obstacle%node, pair%obstacle_reference, u, mean_b, spread_b)
    moved = sqrt(sum((mean_a - mean_b)**2)) + spread_a + spread_b
    pair%remaining_margin = pair%safe_distance - moved
    asleep = moved + 2.0_wp*max(zero, moved - pair%moved) < pair%safe_distance
    pair%moved = moved
  end subroutine test_sleep

  !> Mean motion of a side since the search, and the largest departure from it.
  pure subroutine side_motion(node, reference, u, mean, spread)
    integer, intent(in) :: node(:)
    real(wp), intent(in), contiguous :: reference(:, :), u(:, :)
    real(wp), intent(out) :: mean(2), spread
    real(wp) :: d(2)
    integer :: k
    mean = zero
    spread = zero
    if (size(node) == 0) return    ! a wall does not move
    do k = 1, size(node)
      mean = mean + (u(:, node(k)) - reference(:, k))
    end do
    mean = mean/real(size(node), wp)
    do k = 1, size(node)
      d = u(:, node(k)) - reference(:, k) - mean
      spread = max(spread, d(1)**2 + d(2)**2)
    end do
    spread = sqrt(spread)
  end subroutine side_motion

  !> Lists the candidates of pair p at displacement u (after a step of motion du and length h).
  !> Fails at a node that is inside the obstacle, or has crossed one of its edges in the step,
  !> without having been on the list.
  subroutine search_pair(model, contact, p, u, du, v, h, cycle, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: p
    real(wp), intent(in) :: u(:, :), du(:, :), v(:, :), h
    integer, intent(in) :: cycle
    type(status_t), intent(inout) :: status
    real(wp) :: reach, low(2), high(2), place(2)
    logical, allocatable :: near(:)
    type(candidate_t) :: c
    real(wp) :: distance
    integer :: k
    contact%tally%searches = contact%tally%searches + 1
    contact%searched = p
    if (contact%pair(p)%is_wall) then
      call search_wall(model, contact, p, u, du, v, h, cycle, status)
      return
    end if
    associate (pair => contact%pair(p))
      reach = listing_distance(pair, du, v, h)
      call obstacle_box(model, pair, u, low, high)
      call near_edges(model, pair, u, reach, near)
      pair%safe_distance = huge(one)
      pair%moved = zero
      pair%remaining_margin = zero
      do k = 1, size(pair%contactor%node)
        place = model%x(:, pair%contactor%node(k)) + u(:, pair%contactor%node(k))
        distance = sqrt(sum(max(low - place, place - high, zero)**2))
        c%edge = 0
        if (distance <= reach) call nearest_edge(model, contact, pair, k, near, reach, u, du, &
            cycle, c, distance, status)
        if (failed(status)) return
        if (c%edge > 0 .and. distance <= reach) then
          c%pair = p
          c%node = pair%contactor%node(k)
          call keep_candidate(contact, c)
        else
          pair%safe_distance = min(pair%safe_distance, distance)
        end if
      end do
      pair%contactor_reference = u(:, pair%contactor%node)
      pair%obstacle_reference = u(:, pair%obstacle%node)
    end associate
  end subroutine search_pair

  !> The same for a wall: the nodes nearer than half an edge, or four steps of their motion.
  subroutine search_wall(model, contact, p, u, du, v, h, cycle, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: p
    real(wp), intent(in) :: u(:, :), du(:, :), v(:, :), h
    integer, intent(in) :: cycle
    type(status_t), intent(inout) :: status
    type(candidate_t) :: c
    real(wp) :: reach, gap
    integer :: k
    associate (pair => contact%pair(p))
      reach = listing_distance(pair, du, v, h)
      if (.not. reach > pair%contactor%mean_length) reach = half*reach
      pair%safe_distance = huge(one)
      pair%moved = zero
      pair%remaining_margin = zero
      do k = 1, size(pair%contactor%node)
        gap = wall_distance(pair, model%x, u, pair%contactor%node(k))
        if (.not. listed(contact, pair%contactor%node(k))) &
            call check_wall(model, contact, pair, pair%contactor%node(k), gap, cycle, status)
        if (failed(status)) return
        if (gap <= reach) then
          c%pair = p
          c%node = pair%contactor%node(k)
          c%edge = 0
          call keep_candidate(contact, c)
        else
          pair%safe_distance = min(pair%safe_distance, gap)
        end if
      end do
      pair%contactor_reference = u(:, pair%contactor%node)
      pair%obstacle_reference = u(:, pair%obstacle%node)
    end associate
  end subroutine search_wall

  !> Nodes nearer than this go on the list: a mean edge, or four steps of the relative motion.
  pure real(wp) function listing_distance(pair, du, v, h)
    type(pair_t), intent(in) :: pair
    real(wp), intent(in) :: du(:, :), v(:, :), h
    real(wp) :: zero_a(2, size(pair%contactor%node)), zero_b(2, size(pair%obstacle%node))
    real(wp) :: mean_a(2), mean_b(2), spread_a, spread_b, motion
    zero_a = zero
    zero_b = zero
    call side_motion(pair%contactor%node, zero_a, v, mean_a, spread_a)
    call side_motion(pair%obstacle%node, zero_b, v, mean_b, spread_b)
    motion = h*(sqrt(sum((mean_a - mean_b)**2)) + spread_a + spread_b)
    call side_motion(pair%contactor%node, zero_a, du, mean_a, spread_a)
    call side_motion(pair%obstacle%node, zero_b, du, mean_b, spread_b)
    motion = max(motion, sqrt(sum((mean_a - mean_b)**2)) + spread_a + spread_b)
    listing_distance = max(pair%contactor%mean_length, pair%obstacle%mean_length, 4.0_wp*motion)
  end function listing_distance

  pure subroutine obstacle_box(model, pair, u, low, high)
    type(model_t), intent(in) :: model
    type(pair_t), intent(in) :: pair
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: low(2), high(2)
    real(wp) :: place(2)
    integer :: k
    low = huge(one)
    high = -huge(one)
    do k = 1, size(pair%obstacle%node)
      place = model%x(:, pair%obstacle%node(k)) + u(:, pair%obstacle%node(k))
      low = min(low, place)
      high = max(high, place)
    end do
  end subroutine obstacle_box

  !> Edges of the obstacle within reach of the contactor's box.
  pure subroutine near_edges(model, pair, u, reach, near)
    type(model_t), intent(in) :: model
    type(pair_t), intent(in) :: pair
    real(wp), intent(in) :: u(:, :), reach
    logical, allocatable, intent(out) :: near(:)
    real(wp) :: low(2), high(2), a(2), b(2)
    integer :: k
    low = huge(one)
    high = -huge(one)
    do k = 1, size(pair%contactor%node)
      a = model%x(:, pair%contactor%node(k)) + u(:, pair%contactor%node(k))
      low = min(low, a - reach)
      high = max(high, a + reach)
    end do
    allocate (near(size(pair%obstacle%length)))
    do k = 1, size(near)
      a = model%x(:, pair%obstacle%end_node(1, k)) + u(:, pair%obstacle%end_node(1, k))
      b = model%x(:, pair%obstacle%end_node(2, k)) + u(:, pair%obstacle%end_node(2, k))
      near(k) = all(max(a, b) >= low .and. min(a, b) <= high)
    end do
  end subroutine near_edges

  !> The facing edge nearest to contactor node k; distance [L]. An edge whose projection holds
  !> the node wins over one whose end is as near.
  subroutine nearest_edge(model, contact, pair, k, near, reach, u, du, cycle, c, &
      distance, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(in) :: contact
    type(pair_t), intent(in) :: pair
    integer, intent(in) :: k, cycle
    logical, intent(in) :: near(:)
    real(wp), intent(in) :: reach, u(:, :), du(:, :)
    type(candidate_t), intent(inout) :: c
    real(wp), intent(out) :: distance
    type(status_t), intent(inout) :: status
    real(wp) :: gap, xi, beyond, d, depth
    integer :: edge, node
    logical :: on_edge
    node = pair%contactor%node(k)
    distance = huge(one)
    depth = zero
    do edge = 1, size(near)
      if (.not. near(edge)) cycle
      if (.not. facing(pair%contactor, k, pair%obstacle%normal(:, edge))) cycle
      gap = gap_to_edge(pair%obstacle, edge, model%x, u, node)
      xi = place_on_edge(pair%obstacle, edge, model%x, u, node)
      beyond = max(zero, -xi, xi - one)
      on_edge = beyond <= end_tolerance
      associate (length => pair%obstacle%length(edge))
        if (.not. listed(contact, node)) &
            call check_crossing(model, pair, edge, node, u, du, gap, cycle, status)
        if (failed(status)) return
        if (gap < -contact%penetration_tolerance*length) then
          if (.not. on_edge) cycle
          if (.not. inside(model, pair%obstacle, u, node)) cycle
        end if
        d = sqrt(gap**2 + (beyond*length)**2)
        if (on_edge) d = abs(gap)*(one - 1.0e-9_wp)
      end associate
      if (d >= distance) cycle
      distance = d
      depth = -gap
      c%edge = edge
    end do
    if (c%edge > 0 .and. .not. listed(contact, node)) then
      if (depth > contact%penetration_tolerance*pair%obstacle%length(c%edge)) &
          call penetrated(model, node, depth, cycle, status)
    end if
    if (distance > reach .and. .not. all(near)) distance = reach*(one + epsilon(one))
  end subroutine nearest_edge

  pure logical function listed(contact, node)
    type(contact_t), intent(in) :: contact
    integer, intent(in) :: node
    integer :: i
    listed = .false.
    do i = 1, contact%last_candidates
      if (contact%last_list(i)%node == node) listed = .true.
    end do
  end function listed

  subroutine penetrated(model, node, depth, cycle, status)
    type(model_t), intent(in) :: model
    integer, intent(in) :: node, cycle
    real(wp), intent(in) :: depth
    type(status_t), intent(inout) :: status
    if (cycle == 0) then
      call fail(status, status_deck, 'initial penetration: node '// &
          to_text(model%node_id(node))//' is '//to_text(depth)//' deep in the other body', &
          hint='open the gap')
    else
      call fail(status, status_numerical, 'node '//to_text(model%node_id(node))//' is '// &
          to_text(depth)// &
          ' deep in the other body: it crossed its surface unseen within the step', &
          hint='refine the step')
    end if
  end subroutine penetrated

  !> The motion of a node through an edge within the last step; normals are fixed, so the gap is
  !> linear in time and the instant of crossing exact.
  subroutine check_crossing(model, pair, edge, node, u, du, gap, cycle, status)
    type(model_t), intent(in) :: model
    type(pair_t), intent(in) :: pair
    integer, intent(in) :: edge, node, cycle
    real(wp), intent(in) :: u(:, :), du(:, :), gap
    type(status_t), intent(inout) :: status
    real(wp) :: before, instant, xi
    if (gap >= zero .or. cycle == 0) return
    associate (a => pair%obstacle%end_node(1, edge))
      before = gap - dot_product(pair%obstacle%normal(:, edge), du(:, node) - du(:, a))
      if (before < zero) return
      instant = before/(before - gap)
      xi = place_on_edge(pair%obstacle, edge, model%x, u - (one - instant)*du, node)
      if (xi < zero .or. xi > one) return
    end associate
    if (-gap <= 1.0e-9_wp*pair%obstacle%length(edge)) return
    call fail(status, status_numerical, 'node '//to_text(model%node_id(node))// &
        ' crossed the other body''s surface unseen within the step', hint='refine the step')
  end subroutine check_crossing

  !> Point in polygon by the crossing number (Shimrat 1962).
  pure logical function inside(model, surface, u, node)
    type(model_t), intent(in) :: model
    type(surface_t), intent(in) :: surface
    real(wp), intent(in) :: u(:, :)
    integer, intent(in) :: node
    real(wp) :: p(2), a(2), b(2)
    integer :: k
    p = model%x(:, node) + u(:, node)
    inside = .false.
    do k = 1, size(surface%length)
      a = model%x(:, surface%end_node(1, k)) + u(:, surface%end_node(1, k))
      b = model%x(:, surface%end_node(2, k)) + u(:, surface%end_node(2, k))
      if ((a(2) > p(2)) .eqv. (b(2) > p(2))) cycle
      if (p(1) < a(1) + (b(1) - a(1))*((p(2) - a(2))/(b(2) - a(2)))) inside = .not. inside
    end do
  end function inside

  !> Adds a candidate; one that was on the list keeps its edge.
  subroutine keep_candidate(contact, c)
    type(contact_t), intent(inout) :: contact
    type(candidate_t), intent(inout) :: c
    type(candidate_t), allocatable :: longer(:)
    integer :: i
    do i = 1, contact%last_candidates
      if (contact%last_list(i)%node == c%node .and. contact%last_list(i)%pair == c%pair) &
          c%edge = contact%last_list(i)%edge
    end do
    if (contact%candidates == size(contact%candidate)) then
      allocate (longer(2*contact%candidates + 8))
      longer(1:contact%candidates) = contact%candidate
      call move_alloc(longer, contact%candidate)
    end if
    contact%candidates = contact%candidates + 1
    contact%candidate(contact%candidates) = c
  end subroutine keep_candidate

end module contact_search
