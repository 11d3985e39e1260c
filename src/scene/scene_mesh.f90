! SPDX-License-Identifier: BSD-3-Clause
!> Nodes, elements, parts, sections and sets: from cards to the model.
module scene_mesh
  use base_kinds, only: wp, zero
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use element_base, only: element_t
  use element_registry, only: make_element
  use material_base, only: plane_stress, plane_strain
  use model_data, only: model_t, part_t, section_t, set_t
  use scene_ids, only: id_map_t, make_id_map
  implicit none
  private
  public :: read_nodes, read_parts, read_elements, read_sets, check_mesh

contains

  !> *NODE.
  subroutine read_nodes(deck, model, nodes)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(id_map_t), intent(out) :: nodes
    integer, allocatable :: record(:)
    integer :: k, at
    real(wp) :: z
    call records_of(deck, 'NODE', 1, record)
    model%nodes = size(record)
    allocate (model%node_id(size(record)), model%x(2, size(record)), model%v0(2, size(record)))
    allocate (model%fixed(2, size(record)))
    model%v0 = zero
    model%fixed = .false.
    z = zero
    do k = 1, size(record)
      at = deck%record(record(k))%start
      model%node_id(k) = nint(deck%value(at + 1))
      model%x(:, k) = deck%value(at + 2:at + 3)
      if (k == 1) z = deck%value(at + 4)
      if (abs(deck%value(at + 4) - z) > zero) call deck%complain(record(k), 'Z', &
          'expected the z of the first node: the model is plane')
    end do
    call make_id_map(deck, 'node', 'NID', model%node_id, record, nodes)
  end subroutine read_nodes

  !> All records of one card of a keyword.
  subroutine records_of(deck, keyword, card, record)
    type(deck_t), intent(in) :: deck
    character(*), intent(in) :: keyword
    integer, intent(in) :: card
    integer, allocatable, intent(out) :: record(:)
    integer :: b, r, pass, n
    n = 0
    do pass = 1, 2
      if (pass == 2) allocate (record(n))
      n = 0
      b = deck%next_block(keyword, 0)
      do while (b > 0)
        do r = deck%block(b)%first, deck%block(b)%last
          if (deck%record(r)%card /= card) cycle
          n = n + 1
          if (pass == 2) record(n) = r
        end do
        b = deck%next_block(keyword, b)
      end do
    end do
  end subroutine records_of

  !> *SECTION_SHELL and *PART; materials must have been read.
  subroutine read_parts(deck, model, parts)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(id_map_t), intent(out) :: parts
    type(section_t), allocatable :: section(:)
    integer, allocatable :: record(:)
    integer :: k, m
    call read_sections(deck, section)
    call records_of(deck, 'PART', 2, record)
    allocate (model%part(size(record)))
    do k = 1, size(record)
      associate (p => model%part(k))
        p%record = record(k)
        p%id = deck%integer(record(k), 'PID')
        p%section_id = deck%integer(record(k), 'SECID')
        p%material_id = deck%integer(record(k), 'MID')
        p%heading = deck%word(record(k) - 1, 'HEADING')
        do m = 1, size(section)
          if (section(m)%id /= p%section_id) cycle
          p%plane = section(m)%plane
          p%thickness = section(m)%thickness
        end do
        do m = 1, size(model%material)
          if (model%material(m)%item%id == p%material_id) p%material = m
        end do
        if (p%plane == 0) call deck%complain(record(k), 'SECID', 'section '// &
            to_text(p%section_id)//' is not defined', 'add a *SECTION_SHELL with this number')
        if (p%material == 0) call deck%complain(record(k), 'MID', 'material '// &
            to_text(p%material_id)//' is not defined', 'add a *MAT_ELASTIC with this number')
      end associate
    end do
    call make_id_map(deck, 'part', 'PID', model%part%id, record, parts)
  end subroutine read_parts

  subroutine read_sections(deck, section)
    type(deck_t), intent(inout) :: deck
    type(section_t), allocatable, intent(out) :: section(:)
    integer, allocatable :: record(:), ids(:)
    type(id_map_t) :: map
    integer :: k
    call records_of(deck, 'SECTION_SHELL', 1, record)
    allocate (section(size(record)), ids(size(record)))
    do k = 1, size(record)
      section(k)%id = deck%integer(record(k), 'SECID')
      section(k)%plane = deck%integer(record(k), 'ELFORM')
      ids(k) = section(k)%id
      if (section(k)%plane /= plane_stress .and. section(k)%plane /= plane_strain) then
        call deck%complain(record(k), 'ELFORM', &
            'expected 12 (plane stress) or 13 (plane strain)', &
            'other element forms are not available in this version')
        section(k)%plane = plane_strain
      end if
      if (deck%integer(record(k), 'NIP') /= 4) call deck%complain(record(k), 'NIP', &
          'expected 4 or blank: elements are integrated with 2 x 2 points')
      if (record(k) < deck%records) then
        if (deck%record(record(k) + 1)%block == deck%record(record(k))%block &
            .and. deck%record(record(k) + 1)%card == 2) &
            call read_thickness(deck, record(k) + 1, section(k))
      end if
    end do
    call make_id_map(deck, 'section', 'SECID', ids, record, map)
  end subroutine read_sections

  subroutine read_thickness(deck, record, section)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    type(section_t), intent(inout) :: section
    character(2), parameter :: other(3) = ['T2', 'T3', 'T4']
    integer :: k
    section%thickness = deck%real(record, 'T1')
    do k = 1, 3
      if (.not. deck%is_given(record, other(k))) cycle
      if (abs(deck%real(record, other(k)) - section%thickness) > zero) &
          call deck%complain(record, other(k), 'expected the same thickness as T1, or blank')
    end do
  end subroutine read_thickness

  !> *ELEMENT_SHELL.
  subroutine read_elements(deck, model, nodes, parts)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(id_map_t), intent(in) :: nodes, parts
    integer, allocatable :: record(:)
    type(id_map_t) :: elements
    integer :: k, n, at
    character(2), parameter :: name(4) = ['N1', 'N2', 'N3', 'N4']
    call records_of(deck, 'ELEMENT_SHELL', 1, record)
    n = size(record)
    model%elements = n
    allocate (model%element_id(n), model%element_part(n), model%connectivity(4, n))
    do k = 1, n
      at = deck%record(record(k))%start
      model%element_id(k) = nint(deck%value(at + 1))
      model%element_part(k) = parts%find(nint(deck%value(at + 2)))
      if (model%element_part(k) == 0) call deck%complain(record(k), 'PID', 'part '// &
          to_text(nint(deck%value(at + 2)))//' is not defined', 'add a *PART with this number')
      call read_corners(deck, record(k), at, nodes, name, model%connectivity(:, k))
    end do
    model%element_record = record
    call make_id_map(deck, 'element', 'EID', model%element_id, record, elements)
    if (n == 0) call deck%complain(1, '', 'the deck has no *ELEMENT_SHELL')
  end subroutine read_elements

  subroutine read_corners(deck, record, at, nodes, name, corner)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record, at
    type(id_map_t), intent(in) :: nodes
    character(*), intent(in) :: name(4)
    integer, intent(out) :: corner(4)
    integer :: m, id
    do m = 1, 4
      id = nint(deck%value(at + 2 + m))
      corner(m) = 0
      if (id > 0) corner(m) = nodes%find(id)
      if (id == 0 .or. (m == 4 .and. id == nint(deck%value(at + 5)))) then
        call deck%complain(record, name(m), 'expected a fourth node', &
            'triangles are not available in this version')
      else if (corner(m) == 0) then
        call deck%complain(record, name(m), 'node '//to_text(id)//' is not defined')
      end if
    end do
  end subroutine read_corners

  !> *SET_NODE..., *SET_PART...: members as rows.
  subroutine read_sets(deck, model, nodes, parts)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(id_map_t), intent(in) :: nodes, parts
    call read_set_kind(deck, ['SET_NODE_LIST', 'SET_NODE     '], 'node', 'NID', nodes, &
        model%node_set)
    call read_set_kind(deck, ['SET_PART_LIST', 'SET_PART     '], 'part', 'PID', parts, &
        model%part_set)
  end subroutine read_sets

  subroutine read_set_kind(deck, keywords, what, member, map, sets)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: keywords(2)
    character(*), intent(in) :: what, member
    type(id_map_t), intent(in) :: map
    type(set_t), allocatable, intent(out) :: sets(:)
    integer, allocatable :: head(:), more(:), ids(:)
    type(id_map_t) :: set_ids
    integer :: k, r, m, n, row
    call records_of(deck, trim(keywords(1)), 1, head)
    call records_of(deck, trim(keywords(2)), 1, more)
    head = [head, more]
    allocate (sets(size(head)), ids(size(head)))
    do k = 1, size(head)
      sets(k)%id = deck%integer(head(k), 'SID')
      ids(k) = sets(k)%id
      allocate (sets(k)%member(8*(deck%block(deck%record(head(k))%block)%last - head(k))))
      n = 0
      do r = head(k) + 1, deck%block(deck%record(head(k))%block)%last
        do m = 1, 8
          associate (id => nint(deck%value(deck%record(r)%start + m)))
            if (id == 0) cycle
            row = map%find(id)
            if (row == 0) call deck%complain(r, member//achar(48 + m), what//' '// &
                to_text(id)//' is not defined')
          end associate
          n = n + 1
          sets(k)%member(n) = row
        end do
      end do
      sets(k)%member = sets(k)%member(1:n)
    end do
    call make_id_map(deck, what//' set', 'SID', ids, head, set_ids)
  end subroutine read_set_kind

  !> Element shapes, and nodes without element (their mass would be zero).
  subroutine check_mesh(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    class(element_t), allocatable :: element
    integer, allocatable :: record(:)
    logical, allocatable :: used(:)
    integer :: e, k
    call make_element(4, element)
    allocate (used(model%nodes))
    used = .false.
    do e = 1, model%elements
      used(model%connectivity(:, e)) = .true.
      if (element%smallest_jacobian(model%x(:, model%connectivity(:, e))) > zero) cycle
      call deck%complain(model%element_record(e), '', 'element '// &
          to_text(model%element_id(e))//' is clockwise, degenerate or not convex', &
          'list its nodes counter-clockwise')
    end do
    if (all(used)) return
    call records_of(deck, 'NODE', 1, record)
    do k = 1, model%nodes
      if (.not. used(k)) call deck%complain(record(k), 'NID', 'node '// &
          to_text(model%node_id(k))//' belongs to no element')
    end do
  end subroutine check_mesh

end module scene_mesh
