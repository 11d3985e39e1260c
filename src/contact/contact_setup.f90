! SPDX-License-Identifier: BSD-3-Clause
!> Contact at the start of a run, and the decision to search.
module contact_setup
  use base_kinds, only: wp, zero, one, half
  use base_status, only: status_t, failed
  use cone_types, only: cone_options_t, contact_open
  use contact_condense, only: interface_outgrown, make_interface
  use contact_rows, only: start_rows, swap_rows, same_geometry, carry_reactions, find_slots
  use contact_search, only: test_sleep, search_pair
  use contact_surface, only: make_surface, surface_t
  use contact_track, only: update_candidate, add_candidate_row
  use contact_types, only: contact_t, pair_t, no_gap
  use contact_wall, only: make_wall, mark_wall_nodes, add_wall_row
  use model_data, only: model_t, segment_owner, field_names
  implicit none
  private
  public :: make_contact, find_candidates, contact_nodes

contains

  !> Surfaces and sides of every contact card. The contactor is the side with the shorter mean
  !> edge (equal within 1e-6: SURFA), so that the order of the bodies does not matter.
  subroutine make_contact(model, cone, contact)
    type(model_t), intent(in) :: model
    type(cone_options_t), intent(in) :: cone
    type(contact_t), intent(out) :: contact
    type(surface_t) :: side(2)
    integer :: p, s
    contact%cone = cone
    contact%penetration_tolerance = model%controls%penetration_tolerance
    allocate (contact%pair(size(model%contact) + size(model%wall)))
    allocate (contact%candidate(64), contact%last_list(64))
    allocate (contact%rows, contact%next, contact%before)
    call start_rows(contact%rows)
    call start_rows(contact%next)
    allocate (contact%interface_node(0), contact%slot(model%nodes))
    contact%slot = 0
    contact%d = 1
    do p = 1, size(model%contact)
      if (model%contact(p)%mu > zero) contact%d = 2
      do s = 1, 2
        call make_surface(model, model%contact(p)%kind(s), model%contact(p)%side(s), side(s))
      end do
      associate (pair => contact%pair(p))
        pair%id = model%contact(p)%id
        pair%record = model%contact(p)%record
        pair%mu = model%contact(p)%mu
        pair%birth = model%contact(p)%birth
        pair%death = model%contact(p)%death
        s = model%contact(p)%contactor
        if (s == 0) s = merge(2, 1, side(2)%mean_length < side(1)%mean_length*(one - 1.0e-6_wp))
        pair%contactor_side = s
        pair%contactor = side(s)
        pair%obstacle = side(3 - s)
        if (needs_nodal(model)) call make_nodal(model, pair)
      end associate
    end do
    do p = 1, size(model%wall)
      if (model%wall(p)%mu > zero) contact%d = 2
      associate (pair => contact%pair(size(model%contact) + p))
        call make_wall(model, model%wall(p), pair)
        if (model%requests%field%on .and. needs_nodal(model)) call make_nodal(model, pair)
      end associate
    end do
  end subroutine make_contact

  !> Forces on nodes are kept where a table or a field asks for them.
  pure logical function needs_nodal(model)
    type(model_t), intent(in) :: model
    needs_nodal = model%requests%ncforc > zero
    associate (field => model%requests%field)
      if (field%on) needs_nodal = needs_nodal .or. any(field%wanted .and. (field_names == &
          'FORCE' .or. field_names == 'PRESSURE' .or. field_names == 'GAP' .or. &
          field_names == 'STATUS'))
    end associate
  end function needs_nodal

  !> Work space of the forces on nodes.
  subroutine make_nodal(model, pair)
    type(model_t), intent(in) :: model
    type(pair_t), intent(inout) :: pair
    integer :: n, m, k
    n = size(pair%contactor%node)
    m = size(pair%obstacle%node)
    allocate (pair%nodal)
    associate (nodal => pair%nodal)
      nodal%node = [pair%contactor%node, pair%obstacle%node]
      allocate (nodal%side(n + m), nodal%place(model%nodes, 2), nodal%area(n + m))
      allocate (nodal%force(2, n + m), nodal%before(2, n + m), nodal%normal(n + m))
      allocate (nodal%gap(n + m), nodal%slip(n + m), nodal%status(n + m))
      nodal%side(1:n) = pair%contactor_side
      nodal%side(n + 1:) = 3 - pair%contactor_side
      nodal%place = 0
      nodal%place(pair%contactor%node, 1) = [(k, k=1, n)]
      nodal%place(pair%obstacle%node, 2) = [(k, k=n + 1, n + m)]
      nodal%force = zero
      nodal%before = zero
      nodal%normal = zero
      nodal%gap = no_gap
      nodal%slip = zero
      nodal%status = contact_open
      nodal%area = zero
      call add_areas(model, pair%contactor, nodal%place(:, 1), nodal%area)
      call add_areas(model, pair%obstacle, nodal%place(:, 2), nodal%area)
    end associate
  end subroutine make_nodal

  !> Half of each edge's area to both of its nodes.
  pure subroutine add_areas(model, surface, place, area)
    type(model_t), intent(in) :: model
    type(surface_t), intent(in) :: surface
    integer, intent(in) :: place(:)
    real(wp), intent(inout) :: area(:)
    integer :: owner(size(surface%length)), k, s
    owner = segment_owner(model, surface%end_node)
    do k = 1, size(owner)
      do s = 1, 2
        associate (a => area(place(surface%end_node(s, k))))
          a = a + half*surface%length(k)*model%part(model%element_part(abs(owner(k))))%thickness
        end associate
      end do
    end do
  end subroutine add_areas

  !> Candidates for the coming step: searches if any pair has moved enough to wake, then tracks.
  !> largest: of the motions du. A pair is left alone before its birth and after its death.
  !> new_interface tells that the interface had to grow: the matrix must be factored again.
  subroutine find_candidates(model, contact, u, du, v, largest, h, cycle, t1, new_interface, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: u(:, :), du(:, :), v(:, :)
    real(wp), intent(in) :: largest, h, t1
    integer, intent(in) :: cycle
    logical, intent(out) :: new_interface
    type(status_t), intent(inout) :: status
    logical :: awake, asleep
    integer :: p
    new_interface = .false.
    awake = .false.
    do p = 1, size(contact%pair)
      if (.not. acts(contact%pair(p), t1)) cycle
      call test_sleep(contact%pair(p), u, largest, asleep)
      awake = awake .or. .not. asleep
    end do
    if (contact%keeps_before) contact%before = contact%rows
    if (awake) then
      call remember(contact)
      contact%candidates = 0
      do p = 1, size(contact%pair)
        if (.not. acts(contact%pair(p), t1)) cycle
        call search_pair(model, contact, p, u, du, v, h, cycle, status)
        if (failed(status)) return
      end do
      contact%w_is_current = .false.
    end if
    call find_rows(contact, model%x, u, t1)
    if (interface_outgrown(contact)) then
      call make_interface(contact, nodes_near(contact))
      new_interface = .true.
    end if
    call find_slots(contact%slot, contact%rows)
  end subroutine find_candidates

  !> The rows at the start of a step ending at time t1: every candidate at the place that its
  !> node faces now. W stays where their geometry is the same.
  subroutine find_rows(contact, x, u, t1)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in) :: x(:, :), u(:, :), t1
    integer :: i
    call start_rows(contact%next)
    do i = 1, contact%candidates
      associate (c => contact%candidate(i), pair => contact%pair(contact%candidate(i)%pair))
        if (.not. acts(pair, t1)) cycle
        if (pair%is_wall) then
          call add_wall_row(pair, c%pair, x, u, c%node, contact%next)
        else
          call update_candidate(pair, x, u, c)
          if (c%valid) call add_candidate_row(pair, x, u, c, contact%next)
        end if
      end associate
    end do
    call carry_reactions(contact%rows, contact%next)
    if (.not. same_geometry(contact%rows, contact%next)) contact%w_is_current = .false.
    if (contact%w_is_current) contact%next%is_rigid(:contact%next%n) = &
        contact%rows%is_rigid(:contact%rows%n)
    call swap_rows(contact%rows, contact%next)
  end subroutine find_rows

  !> The nodes of the rows, with one more edge on either side of each, so that sliding does not
  !> outgrow the interface at once.
  pure function nodes_near(contact) result(taken)
    type(contact_t), intent(in) :: contact
    logical :: taken(size(contact%slot))
    integer :: i, s, next
    taken = .false.
    do i = 1, contact%candidates
      associate (c => contact%candidate(i), &
          obstacle => contact%pair(contact%candidate(i)%pair)%obstacle)
        taken(c%node) = .true.
        if (c%edge == 0) cycle
        taken(obstacle%end_node(:, c%edge)) = .true.
        do s = 1, 2
          next = obstacle%neighbour(s, c%edge)
          if (next == 0) cycle
          if (dot_product(obstacle%normal(:, next), obstacle%normal(:, c%edge)) < half) cycle
          taken(obstacle%end_node(:, next)) = .true.
        end do
      end associate
    end do
  end function nodes_near

  pure logical function acts(pair, t1)
    type(pair_t), intent(in) :: pair
    real(wp), intent(in) :: t1
    acts = t1 >= pair%birth .and. t1 <= pair%death
  end function acts

  subroutine remember(contact)
    type(contact_t), intent(inout) :: contact
    if (size(contact%last_list) < contact%candidates) then
      deallocate (contact%last_list)
      allocate (contact%last_list(size(contact%candidate)))
    end if
    contact%last_list(1:contact%candidates) = contact%candidate(1:contact%candidates)
    contact%last_candidates = contact%candidates
  end subroutine remember

  !> Nodes that REDIST makes massless: the nodes of surface edges in front of which, along their
  !> normal and within their width, some part of the other surface stands.
  subroutine contact_nodes(model, contact, list)
    type(model_t), intent(in) :: model
    type(contact_t), intent(in) :: contact
    integer, allocatable, intent(out) :: list(:)
    logical :: taken(model%nodes)
    integer :: p, k
    taken = .false.
    do p = 1, size(contact%pair)
      if (contact%pair(p)%is_wall) then
        call mark_wall_nodes(contact%pair(p), taken)
      else
        call mark_facing(model, contact%pair(p)%contactor, contact%pair(p)%obstacle, taken)
        call mark_facing(model, contact%pair(p)%obstacle, contact%pair(p)%contactor, taken)
      end if
    end do
    list = pack([(k, k=1, model%nodes)], taken)
  end subroutine contact_nodes

  pure subroutine mark_facing(model, surface, other, taken)
    type(model_t), intent(in) :: model
    type(surface_t), intent(in) :: surface, other
    logical, intent(inout) :: taken(:)
    real(wp) :: d(2), along(2), height(2)
    integer :: e, f, s
    do e = 1, size(surface%length)
      do f = 1, size(other%length)
        if (dot_product(surface%normal(:, e), other%normal(:, f)) > -0.05_wp) cycle
        do s = 1, 2
          d = model%x(:, other%end_node(s, f)) - model%x(:, surface%end_node(1, e))
          along(s) = surface%normal(1, e)*d(2) - surface%normal(2, e)*d(1)
          height(s) = dot_product(surface%normal(:, e), d)
        end do
        if (maxval(height) < -1.0e-6_wp*surface%length(e)) cycle
        if (maxval(along) <= 1.0e-6_wp*surface%length(e)) cycle
        if (minval(along) >= (1.0_wp - 1.0e-6_wp)*surface%length(e)) cycle
        taken(surface%end_node(:, e)) = .true.
      end do
    end do
  end subroutine mark_facing

end module contact_setup
