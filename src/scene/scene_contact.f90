! SPDX-License-Identifier: BSD-3-Clause
!> Contact cards and what *BIPACT_PAIR says of them.
module scene_contact
  use base_kinds, only: wp, zero
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_heads, only: head_number
  use deck_names, only: overlaps, overlap_error, overlap_adjust, overlap_ramp
  use deck_problems, only: add_note, add_warning
  use model_data, only: model_t, contact_card_t, side_part_set, side_node_set, &
      side_part, side_segment_set, side_all_parts
  use scene_ids, only: maps_t, make_id_map, records_of, find_or_complain
  use scene_sharing, only: share_parts
  implicit none
  private
  public :: read_contacts, id_before, merged

  character(40), parameter, public :: contact_keyword(6) = [character(40) :: &
      'CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE', 'CONTACT_2D_AUTOMATIC_NODE_TO_SURFACE', &
      'CONTACT_2D_AUTOMATIC_SINGLE_SURFACE', 'CONTACT_AUTOMATIC_SURFACE_TO_SURFACE', &
      'CONTACT_AUTOMATIC_NODES_TO_SURFACE', 'CONTACT_AUTOMATIC_SINGLE_SURFACE']
  character(5), parameter :: surface(2) = ['SURFA', 'SURFB']
  character(4), parameter :: kind_field(2) = ['ATYP', 'BTYP']

contains

  !> All contact cards, in the order of the deck; those without an id are numbered by it.
  subroutine read_contacts(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(inout) :: maps
    integer, allocatable :: record(:), other(:), pair(:)
    integer :: k
    call records_of(deck, trim(contact_keyword(1)), 1, record)
    do k = 2, size(contact_keyword)
      call records_of(deck, trim(contact_keyword(k)), 1, other)
      record = merged(record, other)
    end do
    call check_dimension(deck, model%dim, record)
    allocate (model%contact(size(record)))
    do k = 1, size(record)
      if (model%dim == 3) then
        call read_card_in_space(deck, record(k), k, model%contact(k))
      else
        call read_card(deck, record(k), k, model%contact(k))
      end if
    end do
    call make_id_map(deck, 'contact', 'SURFA', model%contact%id, record, maps%contact)
    call read_pairs(deck, model, maps, pair)
    do k = 1, size(record)
      if (model%dim == 3) then
        call find_sides_in_space(deck, model, maps, pair(k), model%contact(k))
      else
        call find_sides(deck, model, maps, pair(k), model%contact(k))
      end if
    end do
    if (deck%problems%count == 0) call share_parts(deck, model)
    do k = 1, size(record)
      if (model%contact(k)%pairing == 'MORTAR') &
          call check_mortar(deck, model, pair(k), model%contact(k))
      if (pair(k) > 0) call read_overlap(deck, model, pair(k), model%contact(k))
    end do
    call warn_thickness(deck, model)
  end subroutine read_contacts

  !> Two increasing lists as one.
  pure function merged(a, b) result(c)
    integer, intent(in) :: a(:), b(:)
    integer :: c(size(a) + size(b))
    integer :: i, j, k
    i = 1
    j = 1
    do k = 1, size(c)
      if (j > size(b)) then
        c(k) = a(i)
      else if (i > size(a)) then
        c(k) = b(j)
      else
        c(k) = min(a(i), b(j))
      end if
      if (i <= size(a)) then
        if (a(i) == c(k)) then
          i = i + 1
          cycle
        end if
      end if
      j = j + 1
    end do
  end function merged

  subroutine read_card(deck, record, number, card)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record, number
    type(contact_card_t), intent(inout) :: card
    integer :: second
    card%record = record
    card%id = id_before(deck, record, number)
    if (index(deck%block(deck%record(record)%block)%written, '_NODE_TO_') > 0) &
        card%contactor = 1
    card%is_self = index(deck%block(deck%record(record)%block)%written, 'SINGLE_SURFACE') > 0
    call read_friction(deck, record, card)
    second = deck%follow(record, 2)
    if (second == 0) return
    card%birth = deck%real(second, 'TBIRTH')
    card%death = deck%real(second, 'TDEATH')
  end subroutine read_card

  !> The model is plane or in space: contact cards must be so too.
  subroutine check_dimension(deck, dim, record)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: dim
    integer, allocatable, intent(inout) :: record(:)
    logical :: fits(size(record))
    integer :: k
    do k = 1, size(record)
      fits(k) = (index(keyword_of(deck, record(k)), '_2D_') > 0) .eqv. dim == 2
      if (fits(k)) cycle
      if (dim == 3) then
        call deck%complain(record(k), '', 'a contact of plane bodies, but the model is in '// &
            'space', 'expected *CONTACT_AUTOMATIC_SURFACE_TO_SURFACE, _NODES_TO_SURFACE or '// &
            '_SINGLE_SURFACE')
      else
        call deck%complain(record(k), '', 'a contact in space, but the model is plane', &
            'expected *CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE, _NODE_TO_SURFACE or '// &
            '_SINGLE_SURFACE')
      end if
    end do
    record = pack(record, fits)
  end subroutine check_dimension

  !> The name of the keyword of a record, without options.
  function keyword_of(deck, record) result(name)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record
    character(:), allocatable :: name
    name = trim(deck%table%keyword(deck%block(deck%record(record)%block)%keyword)%canonical)
  end function keyword_of

  !> A card in space: friction and times are on its second line.
  subroutine read_card_in_space(deck, record, number, card)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record, number
    type(contact_card_t), intent(inout) :: card
    integer :: second
    card%record = record
    card%id = id_before(deck, record, number)
    if (index(keyword_of(deck, record), '_NODES_TO_') > 0) card%contactor = 1
    card%is_self = index(keyword_of(deck, record), 'SINGLE_SURFACE') > 0
    second = deck%follow(record, 2)
    if (second == 0) return
    call read_friction(deck, second, card)
    card%birth = deck%real(second, 'BT')
    card%death = deck%real(second, 'DT')
  end subroutine read_card_in_space

  !> Friction: FS alone while DC is zero, else from FS at rest to FD at speed.
  subroutine read_friction(deck, record, card)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    type(contact_card_t), intent(inout) :: card
    card%mu = deck%real(record, 'FS')
    card%kinetic_mu = deck%real(record, 'FD')
    card%friction_decay = deck%real(record, 'DC')
    if (card%friction_decay > zero) then
      if (card%kinetic_mu > card%mu) call deck%complain(record, 'FD', 'kinetic friction FD = ' &
          //to_text(card%kinetic_mu)//' is larger than static friction FS = '// &
          to_text(card%mu), 'friction falls with the speed of slip: expected FD <= FS')
      if (.not. deck%is_given(record, 'FD') .and. card%mu > zero) call add_note(deck%problems, &
          deck%place(record)//': FD is blank: friction falls to zero at speed')
    else if (deck%is_given(record, 'FD') .and. abs(card%kinetic_mu - card%mu) > zero) then
      call add_note(deck%problems, deck%place(record)// &
          ': FD has no effect while DC = 0; friction is FS = '//to_text(card%mu))
    end if
  end subroutine read_friction

  !> The id on the card of _ID before a record; the number in the deck where there is none.
  integer function id_before(deck, record, number)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record, number
    id_before = number
    if (record > deck%block(deck%record(record)%block)%first) &
        id_before = head_number(deck, record - 1, number)
  end function id_before

  !> The *BIPACT_PAIR card of each contact, 0 = none.
  subroutine read_pairs(deck, model, maps, pair)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    integer, allocatable, intent(out) :: pair(:)
    integer :: r, row
    allocate (pair(size(model%contact)))
    pair = 0
    r = deck%next('BIPACT_PAIR', 1, 0)
    do while (r > 0)
      row = find_or_complain(deck, maps%contact, r, 'CID', deck%integer(r, 'CID'), 'contact')
      if (row > 0) then
        if (pair(row) > 0) &
            call deck%complain(r, 'CID', 'contact '//to_text(model%contact(row)%id)// &
            ' has a *BIPACT_PAIR already', 'the first is at '//deck%place(pair(row)))
        pair(row) = r
        if (deck%is_given(r, 'REST')) model%contact(row)%restitution = deck%real(r, 'REST')
        if (deck%word(r, 'SIDE') == 'A') model%contact(row)%contactor = 1
        if (deck%word(r, 'SIDE') == 'B') model%contact(row)%contactor = 2
        if (deck%word(r, 'SIDE') == 'BOTH') then
          model%contact(row)%contactor = 3
          call add_warning(deck%problems, 'both-sides', deck%place(r)//': SIDE BOTH: nodes '// &
              'of both sides are exact; their reactions are not unique, resultants are')
        end if
        model%contact(row)%pairing = deck%word(r, 'PAIRING')
      end if
      r = deck%next('BIPACT_PAIR', 1, r)
    end do
  end subroutine read_pairs

  !> What becomes of an overlap at the start, and what that asks for.
  subroutine read_overlap(deck, model, record, card)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    integer, intent(in) :: record
    type(contact_card_t), intent(inout) :: card
    integer :: k
    do k = 1, size(overlaps)
      if (deck%word(record, 'OVERLAP') == overlaps(k)) card%overlap = k
    end do
    if (card%overlap == overlap_error) return
    if (model%dim == 3) then
      call deck%complain(record, 'OVERLAP', 'ADJUST and RAMP are not available in space in '// &
          'this version', 'expected ERROR or blank')
      return
    end if
    if (card%is_self) call deck%complain(record, 'OVERLAP', 'contact '//to_text(card%id)// &
        ' is of a surface with itself, which has no obstacle', 'expected ERROR or blank')
    if (card%overlap == overlap_adjust .and. (card%contactor == 3 .or. any(card%kind == &
        side_node_set .or. card%kind == side_segment_set))) call deck%complain(record, &
        'OVERLAP', 'ADJUST moves the nodes of one body out of another', &
        'expected parts or part sets on both sides, and SIDE A, B or AUTO')
    if (card%birth > zero) call deck%complain(record, 'OVERLAP', 'contact '// &
        to_text(card%id)//' does not act at the start', 'expected TBIRTH = 0')
    if (card%overlap == overlap_ramp .and. .not. (model%controls%is_static .or. &
        model%controls%static_until > zero)) call deck%complain(record, 'OVERLAP', &
        'RAMP pushes bodies apart in a static phase, and there is none', &
        'give TDYBIR of *CONTROL_IMPLICIT_DYNAMICS, or IMASS 0')
  end subroutine read_overlap

  !> What SURFA and SURFB are: part sets, negative node sets, or as ATYP and BTYP say.
  subroutine find_sides(deck, model, maps, pair, card)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: pair
    type(contact_card_t), intent(inout) :: card
    character(:), allocatable :: kind
    integer :: s, id
    do s = 1, merge(1, 2, card%is_self)
      id = deck%integer(card%record, surface(s))
      if (card%is_self .and. id == 0) then
        card%kind(s) = side_all_parts
        card%side(s) = 0
        cycle
      end if
      kind = ''
      if (pair > 0) kind = deck%word(pair, kind_field(s))
      if (kind == '' .and. id < 0) kind = 'NODESET'
      select case (kind)
      case ('NODESET')
        card%kind(s) = side_node_set
        card%side(s) = find_or_complain(deck, maps%node_set, card%record, surface(s), &
            abs(id), 'node set')
      case ('PART')
        card%kind(s) = side_part
        card%side(s) = find_or_complain(deck, maps%part, card%record, surface(s), id, 'part')
      case ('SEGSET')
        card%kind(s) = side_segment_set
        card%side(s) = find_or_complain(deck, maps%segment_set, card%record, surface(s), id, &
            'segment set')
      case default
        card%kind(s) = side_part_set
        card%side(s) = maps%part_set%find(id)
        if (card%side(s) == 0) &
            call deck%complain(card%record, surface(s), 'part set '//to_text(id)// &
            ' is not defined', 'SURFA and SURFB are part sets; negative: node sets')
      end select
    end do
  end subroutine find_sides

  !> What SURFA and SURFB are in space: as SURFATYP and SURFBTYP say, or ATYP and BTYP of
  !> *BIPACT_PAIR.
  subroutine find_sides_in_space(deck, model, maps, pair, card)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: pair
    type(contact_card_t), intent(inout) :: card
    character(:), allocatable :: kind
    integer :: s, id
    do s = 1, merge(1, 2, card%is_self)
      id = deck%integer(card%record, surface(s))
      kind = ''
      if (pair > 0) kind = deck%word(pair, kind_field(s))
      if (kind == '') kind = kind_in_space(deck, card, s, id)
      select case (kind)
      case ('ALL')
        card%kind(s) = side_all_parts
        card%side(s) = 0
      case ('NODESET')
        card%kind(s) = side_node_set
        card%side(s) = find_or_complain(deck, maps%node_set, card%record, surface(s), id, &
            'node set')
      case ('PART')
        card%kind(s) = side_part
        card%side(s) = find_or_complain(deck, maps%part, card%record, surface(s), id, 'part')
      case ('SEGSET')
        card%kind(s) = side_segment_set
        card%side(s) = find_or_complain(deck, maps%segment_set, card%record, surface(s), id, &
            'segment set')
      case ('PARTSET')
        card%kind(s) = side_part_set
        card%side(s) = find_or_complain(deck, maps%part_set, card%record, surface(s), id, &
            'part set')
      end select
    end do
    if (all(card%kind == side_all_parts) .and. .not. card%is_self) card%is_self = .true.
  end subroutine find_sides_in_space

  !> SURFATYP or SURFBTYP in words; '' after a complaint.
  function kind_in_space(deck, card, s, id) result(kind)
    type(deck_t), intent(inout) :: deck
    type(contact_card_t), intent(in) :: card
    integer, intent(in) :: s, id
    character(:), allocatable :: kind
    character(*), parameter :: by_number(0:7) = [character(7) :: &
        'SEGSET', '', 'PARTSET', 'PART', 'NODESET', 'ALL', '', '']
    integer :: type
    type = deck%integer(card%record, surface(s)//'TYP')
    kind = trim(by_number(type))
    if (card%is_self .and. id == 0) kind = 'ALL'
    if (kind == 'NODESET' .and. (s == 2 .or. card%is_self .or. card%contactor /= 1)) then
      call deck%complain(card%record, surface(s)//'TYP', 'a node set is SURFA of '// &
          '*CONTACT_..._NODES_TO_SURFACE alone', 'expected 0, 2, 3 or 5; or ATYP, BTYP of '// &
          '*BIPACT_PAIR')
      kind = ''
    else if (card%is_self .and. kind == 'SEGSET') then
      call deck%complain(card%record, surface(s)//'TYP', 'the surfaces of *CONTACT_..._'// &
          'SINGLE_SURFACE are parts', 'expected 2 part set, 3 part or 5 all parts')
      kind = ''
    else if (kind == '') then
      call deck%complain(card%record, surface(s)//'TYP', to_text(type)//' is not available', &
          'expected 0 segment set, 2 part set, 3 part, 4 node set or 5 all parts')
    end if
  end function kind_in_space

  !> Multipliers live on the edges of one of two surfaces.
  subroutine check_mortar(deck, model, pair, card)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    integer, intent(in) :: pair
    type(contact_card_t), intent(in) :: card
    character(*), parameter :: instead = 'take PAIRING NODE'
    if (model%dim == 3) then
      call deck%complain(pair, 'PAIRING', 'MORTAR is not available in space in this version', &
          instead)
    else if (model%is_axisymmetric) then
      call deck%complain(pair, 'PAIRING', 'MORTAR is not available around an axis in this '// &
          'version', instead)
    else if (card%contactor == 3) then
      call deck%complain(pair, 'SIDE', 'MORTAR has multipliers on one side: expected A, B '// &
          'or AUTO', instead//' where both sides are to have exact nodes')
    else if (card%is_self) then
      call deck%complain(pair, 'PAIRING', 'MORTAR needs two surfaces; this contact is of '// &
          'one, or parts stand on both sides', instead)
    else if (any(card%kind == side_node_set)) then
      call deck%complain(pair, 'PAIRING', 'MORTAR needs edges on both sides; '// &
          surface(findloc(card%kind, side_node_set, 1))//' is a set of nodes', &
          instead//', or a segment set')
    end if
  end subroutine check_mortar

  !> Bodies of different thickness in contact: forces are totals, pressures differ.
  subroutine warn_thickness(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    real(wp) :: low, high
    integer :: k, s
    do k = 1, size(model%contact)
      associate (card => model%contact(k))
        if (card%is_self .or. any(card%side == 0) .or. any(card%kind /= side_part_set)) cycle
        low = huge(low)
        high = zero
        do s = 1, 2
          associate (member => model%part_set(card%side(s))%member)
            low = min(low, minval(model%part(member)%thickness))
            high = max(high, maxval(model%part(member)%thickness))
          end associate
        end do
        if (high > low) call add_warning(deck%problems, 'thickness', deck%place(card%record)// &
            ': bodies of unequal thickness are in contact: give them one T1, or read '// &
            'forces as totals, each for its own thickness')
      end associate
    end do
  end subroutine warn_thickness

end module scene_contact
