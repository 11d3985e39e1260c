! SPDX-License-Identifier: BSD-3-Clause
!> When to search. A search lists what is near and measures the distance of all else; while
!> the bodies have moved less than that relative to each other, no search is due.
module contact_search
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use base_checks, only: checks_on, assert, assert_shape
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, failed
  use contact_condense, only: make_interface
  use contact_monitor, only: check_start, check_whole
  use contact_pairing, only: pairing_t
  use contact_facets, only: corners_of
  use contact_ramp, only: set_ramp
  use contact_surface, only: surface_t
  use contact_types, only: contact_t
  use model_data, only: model_t
  implicit none
  private
  public :: update_lists, relist_outrun

contains

  !> Lists for the step that ends at t1, at displacement u after a step of motion du and
  !> length h; largest: of the motions du. A pairing is left alone before its birth and
  !> after its death. new_interface tells that the interface had to grow: the matrix must be
  !> factored again. Fails at bodies that overlap at their start, or have passed through
  !> each other.
  subroutine update_lists(model, contact, u, du, v, largest, h, cycle, t1, new_interface, &
      status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: u(:, :), du(:, :), v(:, :)
    real(wp), intent(in) :: largest, h, t1
    integer, intent(in) :: cycle
    logical, intent(out) :: new_interface
    type(status_t), intent(inout) :: status
    logical :: searched, is_due, acts
    integer :: p
    if (checks_on) call check_motion(model, u, du, v, 'update_lists')
    new_interface = .false.
    searched = .false.
    do p = 1, size(contact%pairing)
      associate (pairing => contact%pairing(p)%item)
        acts = t1 >= pairing%birth .and. t1 <= pairing%death
        if (acts .neqv. contact%acts(p)) searched = .true.
        contact%acts(p) = acts
        if (allocated(pairing%ramp)) call set_ramp(pairing%ramp, t1 - h, t1)
        if (.not. acts) cycle
        call test_list(pairing, u, largest, is_due)
        if (.not. is_due) cycle
        searched = .true.
        call search(model, contact, p, u, listing_distance(pairing, du, v, h), cycle, status)
        if (failed(status)) return
      end associate
    end do
    if (searched) call use_lists(model, contact, new_interface)
  end subroutine update_lists

  !> Assertions on the state that contact starts from: (dim, nodes) each, displacements finite.
  subroutine check_motion(model, u, du, v, place)
    type(model_t), intent(in) :: model
    real(wp), intent(in) :: u(:, :), du(:, :), v(:, :)
    character(*), intent(in) :: place
    call assert_shape(shape(u), [model%dim, model%nodes], place, 'u')
    call assert_shape(shape(du), [model%dim, model%nodes], place, 'du')
    call assert_shape(shape(v), [model%dim, model%nodes], place, 'v')
    call assert(all(ieee_is_finite(u)), place, 'displacements are finite')
  end subroutine check_motion

  !> Lists pairing p anew at displacement u, and checks its bodies as a whole.
  subroutine search(model, contact, p, u, reach, cycle, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: p, cycle
    real(wp), intent(in), contiguous :: u(:, :)
    real(wp), intent(in) :: reach
    type(status_t), intent(inout) :: status
    contact%tally%searches = contact%tally%searches + 1
    contact%searched = p
    associate (pairing => contact%pairing(p)%item)
      call pairing%list(model, u, reach)
      pairing%moved = zero
      pairing%remaining_margin = pairing%safe_distance
      pairing%reference_1 = u(:, pairing%side(1)%node)
      pairing%reference_2 = u(:, pairing%side(2)%node)
      if (pairing%is_born) then
        call check_whole(model, contact, p, u, cycle, status)
      else
        call check_start(model, contact, p, u, cycle, status)
      end if
      pairing%is_born = .true.
    end associate
  end subroutine search

  !> Work space for the lists; the interface where it is too small.
  subroutine use_lists(model, contact, new_interface)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    logical, intent(out) :: new_interface
    logical :: taken(model%nodes)
    integer :: carrier(model%nodes), p, k
    contact%rows_are_plain = .false.
    taken = .false.
    carrier = 0
    contact%listed = 0
    do p = 1, size(contact%pairing)
      if (.not. contact%acts(p)) cycle
      associate (pairing => contact%pairing(p)%item)
        contact%listed = contact%listed + pairing%listed
        if (pairing%listed > 0) call pairing%mark_interface(model, taken, carrier)
      end associate
    end do
    if (allocated(contact%late)) then
      if (size(contact%late) < 2*contact%listed) deallocate (contact%late)
    end if
    if (.not. allocated(contact%late)) allocate (contact%late(4*contact%listed + 8))
    new_interface = any(taken .and. contact%slot == 0)
    if (new_interface) call make_interface(contact, taken)
    where (contact%slot > 0) carrier = 0
    contact%carried = reshape([pack([(k, k=1, model%nodes)], carrier > 0), &
        pack(carrier, carrier > 0)], [2, count(carrier > 0)], order=[2, 1])
  end subroutine use_lists

  !> A search is due when something off the list may touch before the end of the coming
  !> step: |c_A - c_B| + max|u - u_ref - c_A| + max|u - u_ref - c_B|, c = mean displacement
  !> of a side since the search, bounds the relative motion (triangle inequality); it must
  !> stay below the smallest distance found, with twice the motion of the last step kept for
  !> the coming one. Where edges are near that do not face, they must not turn too much
  !> either. largest [L] is the largest motion of a node in the last step: while twice its
  !> sum since the bound was last evaluated leaves a margin, the bound itself need not be.
  subroutine test_list(pairing, u, largest, is_due)
    class(pairing_t), intent(inout) :: pairing
    real(wp), intent(in), contiguous :: u(:, :)
    real(wp), intent(in) :: largest
    logical, intent(out) :: is_due
    real(wp) :: turn
    is_due = pairing%safe_distance < zero
    if (is_due .or. pairing%safe_distance >= huge(one)) return
    pairing%remaining_margin = pairing%remaining_margin - 2.0_wp*largest
    if (pairing%remaining_margin > 4.0_wp*largest) return
    call bound_motion(pairing, u, is_due)
    if (.not. pairing%turn_margin < huge(one)) return
    turn = max(largest_turn(pairing%side(1), pairing%reference_1, u), &
        largest_turn(pairing%side(2), pairing%reference_2, u))
    is_due = is_due .or. turn > pairing%turn_margin
    pairing%remaining_margin = min(pairing%remaining_margin, (pairing%turn_margin - turn) &
        *min(pairing%side(1)%shortest, pairing%side(2)%shortest))
  end subroutine test_list

  !> The bound of the motion since the search against the smallest distance.
  subroutine bound_motion(pairing, u, is_due)
    class(pairing_t), intent(inout) :: pairing
    real(wp), intent(in), contiguous :: u(:, :)
    logical, intent(out) :: is_due
    real(wp) :: mean_a(3), mean_b(3), spread_a, spread_b, moved
    if (allocated(pairing%one_way)) then
      moved = motion_along(pairing, u, pairing%reference_1)
      pairing%remaining_margin = pairing%safe_distance - moved
      is_due = moved + 2.0_wp*max(zero, moved - pairing%moved) >= pairing%safe_distance
      pairing%moved = moved
      return
    end if
    call side_motion(pairing%side(1)%node, pairing%reference_1, u, mean_a, spread_a)
    call side_motion(pairing%side(2)%node, pairing%reference_2, u, mean_b, spread_b)
    if (size(pairing%side(2)%node) == 0 .and. .not. pairing%is_wall) then
      mean_b = mean_a              ! one surface against itself
      spread_b = spread_a
    end if
    moved = sqrt(sum((mean_a - mean_b)**2)) + spread_a + spread_b
    pairing%remaining_margin = pairing%safe_distance - moved
    is_due = moved + 2.0_wp*max(zero, moved - pairing%moved) >= pairing%safe_distance
    pairing%moved = moved
  end subroutine bound_motion

  !> Lists anew, for the motion x of the step (dim, nodes; largest [L] of a node), the pairings
  !> whose lists it has used up before its end: then the step must be solved `again`.
  subroutine relist_outrun(model, contact, u, x, largest, v, h, cycle, again, new_interface, &
      status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: u(:, :), x(:, :), v(:, :)
    real(wp), intent(in) :: largest, h
    integer, intent(in) :: cycle
    logical, intent(out) :: again, new_interface
    type(status_t), intent(inout) :: status
    real(wp) :: moved
    integer :: p
    if (checks_on) call check_motion(model, u, x, v, 'relist_outrun')
    again = .false.
    new_interface = .false.
    do p = 1, size(contact%pairing)
      if (.not. contact%acts(p)) cycle
      associate (pairing => contact%pairing(p)%item)
        if (pairing%safe_distance >= huge(one)) cycle
        if (2.0_wp*largest <= pairing%remaining_margin .or. .not. largest < huge(one)) cycle
        call motion_at_end(pairing, u, x, moved)
        if (moved <= pairing%safe_distance) cycle
        again = .true.
        call search(model, contact, p, u, listing_distance(pairing, x, v, h), cycle, status)
        if (failed(status)) return
      end associate
    end do
    if (.not. again) return
    contact%tally%redone = contact%tally%redone + 1
    call use_lists(model, contact, new_interface)
  end subroutine relist_outrun

  !> The bound of the motion at the end of the step.
  subroutine motion_at_end(pairing, u, x, moved)
    class(pairing_t), intent(in) :: pairing
    real(wp), intent(in), contiguous :: u(:, :), x(:, :)
    real(wp), intent(out) :: moved
    real(wp) :: mean_a(3), mean_b(3), spread_a, spread_b
    if (allocated(pairing%one_way)) then
      moved = motion_along(pairing, u, pairing%reference_1) &
          + motion_along(pairing, x)
      return
    end if
    call side_motion_at_end(pairing%side(1)%node, pairing%reference_1, u, x, mean_a, spread_a)
    call side_motion_at_end(pairing%side(2)%node, pairing%reference_2, u, x, mean_b, spread_b)
    if (size(pairing%side(2)%node) == 0 .and. .not. pairing%is_wall) then
      mean_b = mean_a
      spread_b = spread_a
    end if
    moved = sqrt(sum((mean_a - mean_b)**2)) + spread_a + spread_b
  end subroutine motion_at_end

  !> Largest motion of a node of side 1 along the one direction that counts, of u, or of u -
  !> reference (dim, nodes of the side).
  pure real(wp) function motion_along(pairing, u, reference) result(largest)
    class(pairing_t), intent(in) :: pairing
    real(wp), intent(in), contiguous :: u(:, :)
    real(wp), intent(in), optional :: reference(:, :)
    real(wp) :: d
    integer :: k
    largest = zero
    do k = 1, size(pairing%side(1)%node)
      d = dot_product(pairing%one_way, u(:, pairing%side(1)%node(k)))
      if (present(reference)) d = d - dot_product(pairing%one_way, reference(:, k))
      largest = max(largest, abs(d))
    end do
  end function motion_along

  pure subroutine side_motion_at_end(node, reference, u, x, mean, spread)
    integer, intent(in) :: node(:)
    real(wp), intent(in), contiguous :: reference(:, :), u(:, :), x(:, :)
    real(wp), intent(out) :: mean(3), spread
    real(wp) :: d(3)
    integer :: k, m
    m = size(u, 1)
    mean = zero
    spread = zero
    d = zero
    do k = 1, size(node)
      mean(:m) = mean(:m) + (u(:, node(k)) + x(:, node(k)) - reference(:, k))
    end do
    mean = mean/max(1, size(node))
    do k = 1, size(node)
      d(:m) = u(:, node(k)) + x(:, node(k)) - reference(:, k) - mean(:m)
      spread = max(spread, d(1)**2 + d(2)**2 + d(3)**2)
    end do
    spread = sqrt(spread)
  end subroutine side_motion_at_end

  !> Mean motion of a side since the search, and the largest departure from it.
  pure subroutine side_motion(node, reference, u, mean, spread)
    integer, intent(in) :: node(:)
    real(wp), intent(in), contiguous :: reference(:, :), u(:, :)
    real(wp), intent(out) :: mean(3), spread
    real(wp) :: d(3)
    integer :: k, m
    m = size(u, 1)
    mean = zero
    spread = zero
    d = zero
    if (size(node) == 0) return    ! a wall does not move
    do k = 1, size(node)
      mean(:m) = mean(:m) + (u(:, node(k)) - reference(:, k))
    end do
    mean = mean/real(size(node), wp)
    do k = 1, size(node)
      d(:m) = u(:, node(k)) - reference(:, k) - mean(:m)
      spread = max(spread, d(1)**2 + d(2)**2 + d(3)**2)
    end do
    spread = sqrt(spread)
  end subroutine side_motion

  !> The largest turn of an edge since the search: motion of its ends relative to each other /
  !> length, which bounds it.
  pure real(wp) function largest_turn(surface, reference, u)
    type(surface_t), intent(in) :: surface
    real(wp), intent(in), contiguous :: reference(:, :), u(:, :)
    real(wp) :: d(3), plane(2)
    integer :: e, j, m, a, b
    largest_turn = zero
    do e = 1, surface%facets%n
      if (.not. surface%facets%is_listed(e)) cycle
      m = corners_of(surface%facets, e)
      do j = 1, m
        a = surface%facets%node(j, e)
        b = surface%facets%node(1 + mod(j, m), e)
        d = (u(:, b) - reference(:, surface%index(b))) &
            - (u(:, a) - reference(:, surface%index(a)))
        largest_turn = max(largest_turn, norm2(d)/surface%facets%size(e))
      end do
    end do
    do e = 1, size(surface%length)
      if (.not. surface%is_listed(e)) cycle
      associate (a => surface%end_node(1, e), b => surface%end_node(2, e))
        plane = (u(:, b) - reference(:, surface%index(b))) &
            - (u(:, a) - reference(:, surface%index(a)))
        largest_turn = max(largest_turn, sqrt(plane(1)**2 + plane(2)**2)/surface%length(e))
      end associate
    end do
  end function largest_turn

  !> What is nearer than this goes on the list: a mean edge, or four steps of the relative
  !> motion.
  pure real(wp) function listing_distance(pairing, du, v, h)
    class(pairing_t), intent(in) :: pairing
    real(wp), intent(in), contiguous :: du(:, :), v(:, :)
    real(wp), intent(in) :: h
    real(wp) :: zero_a(size(v, 1), size(pairing%side(1)%node))
    real(wp) :: zero_b(size(v, 1), size(pairing%side(2)%node))
    real(wp) :: mean_a(3), mean_b(3), spread_a, spread_b, motion
    if (allocated(pairing%one_way)) then
      listing_distance = max(pairing%side(1)%mean_length, &
          4.0_wp*h*motion_along(pairing, v), 4.0_wp*motion_along(pairing, du))
      return
    end if
    zero_a = zero
    zero_b = zero
    call side_motion(pairing%side(1)%node, zero_a, v, mean_a, spread_a)
    call side_motion(pairing%side(2)%node, zero_b, v, mean_b, spread_b)
    motion = h*(sqrt(sum((mean_a - mean_b)**2)) + spread_a + spread_b)
    call side_motion(pairing%side(1)%node, zero_a, du, mean_a, spread_a)
    call side_motion(pairing%side(2)%node, zero_b, du, mean_b, spread_b)
    motion = max(motion, sqrt(sum((mean_a - mean_b)**2)) + spread_a + spread_b)
    listing_distance = &
        max(pairing%side(1)%mean_length, pairing%side(2)%mean_length, 4.0_wp*motion)
  end function listing_distance

end module contact_search
