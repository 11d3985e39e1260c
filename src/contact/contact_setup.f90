! SPDX-License-Identifier: BSD-3-Clause
!> Contact at the start of a run: a pairing for every card and every wall.
module contact_setup
  use base_kinds, only: wp, zero, half
  use cone_types, only: cone_options_t, contact_open
  use contact_area, only: make_nodal
  use contact_friction, only: friction_t, friction_varies
  use contact_grade, only: finer_none
  use contact_mortar_side, only: contactor_side
  use contact_node, only: pairing_node_t
  use contact_obstacle, only: obstacle_t
  use contact_pairing, only: pairing_t
  use contact_registry, only: make_pairing
  use contact_ramp, only: make_ramp
  use contact_rows, only: start_rows
  use contact_skin, only: make_skin
  use contact_space, only: pairing_space_t
  use contact_surface, only: make_surface
  use contact_types, only: contact_t
  use contact_wall, only: pairing_wall_t
  use deck_names, only: field_names, table_ncforc, overlap_ramp
  use model_data, only: model_t, contact_card_t, wall_t, side_node_set, &
      side_all_nodes
  implicit none
  private
  public :: make_contact, contact_nodes

contains

  !> Surfaces and sides of every contact card, and of every wall.
  subroutine make_contact(model, cone, contact)
    type(model_t), intent(in) :: model
    type(cone_options_t), intent(in) :: cone
    type(contact_t), intent(out) :: contact
    integer :: p, n
    n = size(model%contact) + size(model%wall)
    contact%cone = cone
    contact%penetration_tolerance = model%controls%penetration_tolerance
    allocate (contact%pairing(n), contact%acts(n))
    contact%acts = .false.
    allocate (contact%rows, contact%spare, contact%before)
    allocate (contact%next, contact%left, contact%work_rows)
    contact%dim = size(model%x, 1)
    call start_rows(contact%left, dim=contact%dim)
    call start_rows(contact%work_rows, dim=contact%dim)
    call start_rows(contact%rows, dim=contact%dim)
    call start_rows(contact%next, dim=contact%dim)
    call start_rows(contact%spare, dim=contact%dim)
    call start_rows(contact%before, dim=contact%dim)
    allocate (contact%interface_node(0), contact%slot(model%nodes))
    allocate (contact%free(contact%dim, model%nodes), contact%u_end(contact%dim, model%nodes))
    allocate (contact%carried(2, 0))
    contact%slot = 0
    contact%free = zero
    contact%u_end = zero
    contact%d = 1
    if (any(model%contact%mu > zero) .or. any(model%wall%mu > zero)) contact%d = contact%dim
    do p = 1, size(model%contact)
      if (model%dim == 3) then
        call make_pairing('SPACE', contact%pairing(p)%item)
      else
        call make_pairing(trim(model%contact(p)%pairing), contact%pairing(p)%item)
      end if
      call set_card(model, model%contact(p), contact%pairing(p)%item)
    end do
    do p = 1, size(model%wall)
      associate (slot => contact%pairing(size(model%contact) + p))
        if (model%dim == 3) then
          call make_pairing('WALL', slot%item)
        else
          call make_pairing(trim(model%wall(p)%shape), slot%item)
        end if
      end associate
      call set_wall(model, model%wall(p), contact%pairing(size(model%contact) + p)%item)
    end do
    do p = 1, n
      call set_common(model, p, contact%pairing(p)%item)
      contact%friction_varies = contact%friction_varies .or. &
          friction_varies(contact%pairing(p)%item%friction)
    end do
    call set_rounds(contact)
  end subroutine make_contact

  !> Normals of the middle of the step are found in rounds, each of which gains as many digits
  !> as a node moves less than the radius.
  subroutine set_rounds(contact)
    type(contact_t), intent(inout) :: contact
    integer, parameter :: rounds_of_middle = 15
    integer :: p
    do p = 1, size(contact%pairing)
      select type (pairing => contact%pairing(p)%item)
      class is (obstacle_t)
        if (pairing%is_curved .and. pairing%is_mid) contact%most_late_rounds = rounds_of_middle
      end select
    end do
  end subroutine set_rounds

  !> What every pairing has.
  subroutine set_common(model, p, pairing)
    type(model_t), intent(in) :: model
    integer, intent(in) :: p
    class(pairing_t), intent(inout) :: pairing
    pairing%number = p
    pairing%penetration_tolerance = model%controls%penetration_tolerance
    pairing%is_reference = model%controls%frame == 'REF'
    if (.not. needs_nodal(model)) return
    if (.not. pairing%is_wall .or. model%requests%field%on) call make_nodal(model%dim, pairing)
  end subroutine set_common

  subroutine set_card(model, card, pairing)
    type(model_t), intent(in) :: model
    type(contact_card_t), intent(in) :: card
    class(pairing_t), intent(inout) :: pairing
    integer :: s
    pairing%id = card%id
    pairing%record = card%record
    pairing%friction = friction_t(card%mu, card%kinetic_mu, card%friction_decay)
    pairing%restitution = merge(model%controls%restitution, card%restitution, &
        card%restitution < zero)
    pairing%birth = card%birth
    pairing%death = card%death
    if (card%overlap == overlap_ramp) then
      allocate (pairing%ramp)
      pairing%may_overlap = .true.
      call make_ramp(pairing%ramp, model%nodes, merge(model%controls%static_until, &
          model%controls%end_time, model%controls%static_until > zero))
    end if
    if (card%is_self) then
      call make_surface(model, card%kind(1), 0, pairing%side(1), card%parts)
      call empty_side(pairing)
    else
      do s = 1, 2
        call make_surface(model, card%kind(s), card%side(s), pairing%side(s))
      end do
    end if
    select type (pairing)
    type is (pairing_space_t)
      call set_space(model, card, pairing)
    class is (pairing_node_t)
      pairing%finer = card%contactor
      pairing%is_self = card%is_self
      allocate (pairing%leaves_out(0, 0))
      if (allocated(card%leaves_out)) then
        if (any(card%leaves_out(card%parts, card%parts))) &
            pairing%leaves_out = card%leaves_out
      end if
      if (.not. card%is_self) pairing%may_share = &
          any(pairing%side(1)%index > 0 .and. pairing%side(2)%index > 0)
      if (card%pairing /= 'MORTAR') return
      pairing%finer = finer_none
      pairing%multiplier_side = card%contactor
      if (card%contactor == 0) pairing%multiplier_side = contactor_side(model, pairing%side)
    end select
  end subroutine set_card

  !> What a contact of bodies in space has beside its surfaces: their nets.
  subroutine set_space(model, card, pairing)
    type(model_t), intent(in) :: model
    type(contact_card_t), intent(in) :: card
    type(pairing_space_t), intent(inout) :: pairing
    integer :: s
    pairing%finer = card%contactor
    pairing%is_self = card%is_self
    allocate (pairing%leaves_out(0, 0))
    if (allocated(card%leaves_out)) then
      if (any(card%leaves_out(card%parts, card%parts))) pairing%leaves_out = card%leaves_out
    end if
    do s = 1, merge(1, 2, card%is_self)
      call make_skin(model, pairing%side(s)%facets, pairing%skin(s))
      pairing%side(s)%is_closed = pairing%skin(s)%is_closed
    end do
    if (.not. card%is_self) pairing%may_share = &
        any(pairing%side(1)%index > 0 .and. pairing%side(2)%index > 0)
  end subroutine set_space

  subroutine set_wall(model, wall, pairing)
    type(model_t), intent(in) :: model
    type(wall_t), intent(in) :: wall
    class(pairing_t), intent(inout) :: pairing
    pairing%is_wall = .true.
    pairing%id = wall%id
    pairing%record = wall%record
    pairing%friction = friction_t(static=wall%mu, kinetic=wall%mu)
    pairing%restitution = model%controls%restitution
    pairing%birth = wall%birth
    pairing%death = wall%death
    call make_surface(model, merge(side_all_nodes, side_node_set, wall%node_set == 0), &
        wall%node_set, pairing%side(1))
    call empty_side(pairing)
    select type (pairing)
    type is (pairing_wall_t)
      pairing%point = wall%point(:model%dim)
      pairing%normal = wall%normal(:model%dim)
      pairing%is_guided = wall%mass > zero
      if (wall%node > 0) then
        pairing%body = wall%node
        call give_node(wall, pairing)
      else if (model%dim == 3) then
        pairing%one_way = pairing%normal
      end if
    class is (obstacle_t)
      pairing%body = wall%node
      pairing%is_mid = any(model%controls%frame == [character(5) :: '', 'MID'])
      call give_node(wall, pairing)
      call pairing%set_shape(wall)
    end select
  end subroutine set_wall

  !> The second side is the node of the wall.
  subroutine give_node(wall, pairing)
    type(wall_t), intent(in) :: wall
    class(pairing_t), intent(inout) :: pairing
    pairing%side(2)%node = [wall%node]
    pairing%side(2)%index(wall%node) = 1
    deallocate (pairing%side(2)%chain)
    allocate (pairing%side(2)%chain(2, 1), source=0)
  end subroutine give_node

  !> A second side without nodes and edges.
  pure subroutine empty_side(pairing)
    class(pairing_t), intent(inout) :: pairing
    associate (s => pairing%side(2))
      allocate (s%node(0), s%end_node(2, 0), s%length(0), s%normal(2, 0), s%chain(2, 0))
      allocate (s%is_listed(0))
      allocate (s%index(size(pairing%side(1)%index)))
      s%index = 0
    end associate
  end subroutine empty_side

  !> Forces on nodes are kept where a table or a field asks for them.
  pure logical function needs_nodal(model)
    type(model_t), intent(in) :: model
    needs_nodal = model%requests%interval(table_ncforc) > zero
    associate (field => model%requests%field)
      if (field%on) needs_nodal = needs_nodal .or. any(field%wanted .and. (field_names == &
          'FORCE' .or. field_names == 'PRESSURE' .or. field_names == 'GAP' .or. &
          field_names == 'STATUS'))
    end associate
  end function needs_nodal

  !> Nodes that REDIST makes massless: those that face a surface or a wall.
  subroutine contact_nodes(model, contact, list)
    type(model_t), intent(in) :: model
    type(contact_t), intent(in) :: contact
    integer, allocatable, intent(out) :: list(:)
    logical :: taken(model%nodes)
    integer :: p, k
    taken = .false.
    do p = 1, size(contact%pairing)
      call contact%pairing(p)%item%mark_contact_nodes(model, taken)
    end do
    if (allocated(model%rigid)) taken(model%rigid%node) = .false.
    list = pack([(k, k=1, model%nodes)], taken)
  end subroutine contact_nodes

end module contact_setup
