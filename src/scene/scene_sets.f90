! SPDX-License-Identifier: BSD-3-Clause
!> Sets of nodes, parts, elements and element edges or faces: from cards to rows of the model.
module scene_sets
  use base_list, only: append
  use base_sort, only: first_not_below
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use model_data, only: model_t, set_t, segment_set_t
  use model_faces, only: find_segments
  use scene_clauses, only: box_t, edges_t, read_boxes, read_clauses, read_segment_clauses
  use scene_ids, only: maps_t, id_map_t, make_id_map, records_of, find_or_complain
  implicit none
  private
  public :: read_sets, read_segment, corners, segment_text

contains

  !> All sets; nodes, parts and elements must have been read.
  subroutine read_sets(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(inout) :: maps
    type(box_t), allocatable :: box(:)
    call read_boxes(deck, maps, box)
    call read_set_kind(deck, model, maps, box, 'NODE', 'node', maps%node, model%node_set, &
        maps%node_set)
    call read_set_kind(deck, model, maps, box, 'PART', 'part', maps%part, model%part_set, &
        maps%part_set)
    call read_set_kind(deck, model, maps, box, merge('SOLID', 'SHELL', model%dim == 3), &
        'element', maps%element, model%element_set, maps%element_set)
    call read_segment_sets(deck, model, maps, box)
  end subroutine read_sets

  !> The sets of one kind: given as lists, one member a card, by ranges of numbers, by clauses.
  subroutine read_set_kind(deck, model, maps, box, kind, what, map, sets, set_map)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    type(box_t), intent(in) :: box(:)
    character(*), intent(in) :: kind, what
    type(id_map_t), intent(in) :: map
    type(set_t), allocatable, intent(out) :: sets(:)
    type(id_map_t), intent(out) :: set_map
    character(16), parameter :: form(4) = [character(16) :: '_LIST', '_COLUMN', &
        '_LIST_GENERATE', '_GENERAL']
    integer, allocatable :: head(:), more(:), ids(:), form_of(:)
    integer :: k
    allocate (head(0), form_of(0))
    do k = 1, size(form)
      call records_of(deck, 'SET_'//kind//trim(form(k)), 1, more)
      head = [head, more]
      form_of = [form_of, spread(k, 1, size(more))]
    end do
    allocate (sets(size(head)), ids(size(head)))
    do k = 1, size(head)
      ids(k) = deck%integer(head(k), 'SID')
      sets(k)%id = ids(k)
      select case (form_of(k))
      case (1)
        call read_list(deck, head(k), 8, what, map, sets(k)%member)
      case (2)
        call read_list(deck, head(k), 1, what, map, sets(k)%member)
      case (3)
        call read_ranges(deck, head(k), what, map, sets(k)%member)
      case default
        call read_clauses(deck, model, maps, box, head(k), kind, sets(k)%member)
      end select
      if (size(sets(k)%member) == 0 .and. deck%problems%count == 0) &
          call deck%complain(head(k), 'SID', 'the '//what//' set is empty')
    end do
    call make_id_map(deck, what//' set', 'SID', ids, head, set_map)
  end subroutine read_set_kind

  !> Rows of the members in the first `fields` fields of the cards after `head`; zeros are
  !> padding.
  subroutine read_list(deck, head, fields, what, map, rows)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: head, fields
    character(*), intent(in) :: what
    type(id_map_t), intent(in) :: map
    integer, allocatable, intent(out) :: rows(:)
    integer :: last, r, m, n, id
    last = deck%block(deck%record(head)%block)%last
    allocate (rows(fields*(last - head)))
    n = 0
    do r = head + 1, last
      do m = 1, fields
        id = nint(deck%number_at(r, m))
        if (id == 0) cycle
        n = n + 1
        rows(n) = find_or_complain(deck, map, r, deck%field_name(r, m), id, what)
      end do
    end do
    rows = pack(rows(1:n), rows(1:n) > 0)
  end subroutine read_list

  !> Rows of all members whose number lies in one of the ranges.
  subroutine read_ranges(deck, head, what, map, rows)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: head
    character(*), intent(in) :: what
    type(id_map_t), intent(in) :: map
    integer, allocatable, intent(out) :: rows(:)
    integer, allocatable :: begun(:)
    integer :: r, m, low, high, k
    ! Ranges that have begun before each id, less those that have ended.
    allocate (begun(size(map%sorted) + 1))
    begun = 0
    do r = head + 1, deck%block(deck%record(head)%block)%last
      do m = 1, 4
        low = nint(deck%number_at(r, 2*m - 1))
        high = nint(deck%number_at(r, 2*m))
        if (low == 0 .and. high == 0) cycle
        if (high < low) then
          call deck%complain(r, 'B'//achar(48 + m)//'END', 'expected a number not below '// &
              to_text(low)//', found '//to_text(high))
          cycle
        end if
        k = first_not_below(map%sorted, low)
        begun(k) = begun(k) + 1
        if (high == huge(high)) cycle
        k = first_not_below(map%sorted, high + 1)
        begun(k) = begun(k) - 1
      end do
    end do
    do k = 2, size(begun)
      begun(k) = begun(k) + begun(k - 1)
    end do
    rows = pack(map%row, begun(:size(map%row)) > 0)
  end subroutine read_ranges

  subroutine read_segment_sets(deck, model, maps, box)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(inout) :: maps
    type(box_t), intent(in) :: box(:)
    type(edges_t) :: edges
    integer, allocatable :: head(:), general(:), ids(:)
    integer :: k, r, n, lists
    call records_of(deck, 'SET_SEGMENT', 1, head)
    call records_of(deck, 'SET_SEGMENT_GENERAL', 1, general)
    lists = size(head)
    head = [head, general]
    allocate (model%segment_set(size(head)), ids(size(head)))
    do k = 1, size(head)
      ids(k) = deck%integer(head(k), 'SID')
      if (k > lists) then
        model%segment_set(k)%id = ids(k)
        model%segment_set(k)%record = head(k)
        call read_segment_clauses(deck, model, maps, box, head(k), edges, &
            model%segment_set(k)%node)
        cycle
      end if
      n = deck%block(deck%record(head(k))%block)%last - head(k)
      allocate (model%segment_set(k)%node(corners(model), n))
      model%segment_set(k)%id = ids(k)
      model%segment_set(k)%record = head(k)
      do r = 1, n
        call read_segment(deck, maps, head(k) + r, model%segment_set(k)%node(:, r))
      end do
    end do
    if (deck%problems%count == 0) call check_segments(deck, model)
    call make_id_map(deck, 'segment set', 'SID', ids, head, maps%segment_set)
  end subroutine read_segment_sets

  !> Numbers that a segment has: two nodes, in space four.
  pure integer function corners(model)
    type(model_t), intent(in) :: model
    corners = 2*(model%dim - 1)
  end function corners

  !> What a segment is to be.
  pure function segment_text(model) result(text)
    type(model_t), intent(in) :: model
    character(:), allocatable :: text
    text = 'expected two nodes of an exposed element edge'
    if (model%dim == 3) text = 'expected the nodes of an exterior element face'
  end function segment_text

  !> The segments of all sets must be exterior edges or faces; those that are curved faces
  !> become their facets.
  subroutine check_segments(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    integer, allocatable :: node(:), segment(:, :), facet(:, :), from(:), owner(:), local(:)
    integer :: k, r, n, first, last, before
    n = 0
    do k = 1, size(model%segment_set)
      associate (segment => model%segment_set(k)%node)
        call append(reshape(segment, [size(segment)]), node, n)
      end associate
    end do
    if (n == 0) return
    segment = reshape(node(:n), [corners(model), n/corners(model)])
    call find_segments(model%mesh, model%nodes, segment, facet, from, owner, local)
    n = 0
    last = 0
    do k = 1, size(model%segment_set)
      first = last
      do r = 1, size(model%segment_set(k)%node, 2)
        n = n + 1
        before = last
        do while (last < size(from))
          if (from(last + 1) > n) exit
          last = last + 1
        end do
        if (last == before) call deck%complain(model%segment_set(k)%record + r, 'N1', &
            segment_text(model))
      end do
      model%segment_set(k)%node = facet(:, first + 1:last)
    end do
  end subroutine check_segments

  !> Rows of the nodes of a segment: fields N1 and N2, N3 and N4 are 0 or N2; in space N1 to N3
  !> and N4, which is 0 or N3 for a triangle.
  subroutine read_segment(deck, maps, record, node)
    type(deck_t), intent(inout) :: deck
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record
    integer, intent(out) :: node(:)
    character(2), parameter :: name(4) = ['N1', 'N2', 'N3', 'N4']
    integer :: m, id
    node = 0
    do m = 1, size(node)
      if (m == 4 .and. any(deck%integer(record, 'N4') == [0, deck%integer(record, 'N3')])) exit
      if (m == 3 .and. deck%integer(record, 'N3') == 0) then
        call deck%complain(record, 'N3', 'expected three or four nodes: a segment is a '// &
            'face of an element in space')
        return
      end if
      node(m) = find_or_complain(deck, maps%node, record, name(m), &
          deck%integer(record, name(m)), 'node')
    end do
    do m = size(node) + 1, 4
      id = deck%integer(record, name(m))
      if (id /= 0 .and. id /= deck%integer(record, 'N2')) call deck%complain(record, name(m), &
          'expected 0 or N2: edges of plane elements have two nodes')
    end do
  end subroutine read_segment

end module scene_sets
