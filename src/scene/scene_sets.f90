! SPDX-License-Identifier: BSD-3-Clause
!> Sets of nodes, parts, elements and element edges: from cards to rows of the model.
module scene_sets
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use model_data, only: model_t, set_t, segment_set_t, segment_owner
  use scene_ids, only: maps_t, id_map_t, make_id_map, records_of, find_or_complain
  implicit none
  private
  public :: read_sets, read_segment

contains

  !> All sets; nodes, parts and elements must have been read.
  subroutine read_sets(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(inout) :: maps
    call read_set_kind(deck, 'SET_NODE_LIST', 'node', 'NID', maps%node, model%node_set, &
        maps%node_set)
    call read_set_kind(deck, 'SET_PART_LIST', 'part', 'PID', maps%part, model%part_set, &
        maps%part_set)
    call read_set_kind(deck, 'SET_SHELL_LIST', 'element', 'EID', maps%element, &
        model%element_set, maps%element_set)
    call read_segment_sets(deck, model, maps)
  end subroutine read_sets

  !> The sets of one kind, given as lists and by ranges of numbers.
  subroutine read_set_kind(deck, keyword, what, member, map, sets, set_map)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: keyword, what, member
    type(id_map_t), intent(in) :: map
    type(set_t), allocatable, intent(out) :: sets(:)
    type(id_map_t), intent(out) :: set_map
    integer, allocatable :: lists(:), ranges(:), head(:), ids(:)
    integer :: k
    call records_of(deck, keyword, 1, lists)
    call records_of(deck, keyword//'_GENERATE', 1, ranges)
    head = [lists, ranges]
    allocate (sets(size(head)), ids(size(head)))
    do k = 1, size(head)
      ids(k) = deck%integer(head(k), 'SID')
      sets(k)%id = ids(k)
      if (k <= size(lists)) then
        call read_list(deck, head(k), what, member, map, sets(k)%member)
      else
        call read_ranges(deck, head(k), what, map, sets(k)%member)
      end if
    end do
    call make_id_map(deck, what//' set', 'SID', ids, head, set_map)
  end subroutine read_set_kind

  !> Rows of the members on the cards after `head`; zeros are padding.
  subroutine read_list(deck, head, what, member, map, rows)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: head
    character(*), intent(in) :: what, member
    type(id_map_t), intent(in) :: map
    integer, allocatable, intent(out) :: rows(:)
    integer :: last, r, m, n, id
    last = deck%block(deck%record(head)%block)%last
    allocate (rows(8*(last - head)))
    n = 0
    do r = head + 1, last
      do m = 1, 8
        id = nint(deck%number_at(r, m))
        if (id == 0) cycle
        n = n + 1
        rows(n) = find_or_complain(deck, map, r, member//achar(48 + m), id, what)
      end do
    end do
    rows = pack(rows(1:n), rows(1:n) > 0)
    if (n == 0) call deck%complain(head, 'SID', 'the '//what//' set is empty')
  end subroutine read_list

  !> Rows of all members whose number lies in one of the ranges.
  subroutine read_ranges(deck, head, what, map, rows)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: head
    character(*), intent(in) :: what
    type(id_map_t), intent(in) :: map
    integer, allocatable, intent(out) :: rows(:)
    logical, allocatable :: taken(:)
    integer :: r, m, low, high
    allocate (taken(size(map%sorted)))
    taken = .false.
    do r = head + 1, deck%block(deck%record(head)%block)%last
      do m = 1, 4
        low = nint(deck%number_at(r, 2*m - 1))
        high = nint(deck%number_at(r, 2*m))
        if (low == 0 .and. high == 0) cycle
        if (high < low) call deck%complain(r, 'B'//achar(48 + m)//'END', &
            'expected a number not below '//to_text(low)//', found '//to_text(high))
        taken = taken .or. (map%sorted >= low .and. map%sorted <= high)
      end do
    end do
    rows = pack(map%row, taken)
    if (size(rows) == 0) call deck%complain(head, 'SID', 'the '//what//' set is empty')
  end subroutine read_ranges

  subroutine read_segment_sets(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(inout) :: maps
    integer, allocatable :: head(:), ids(:), owner(:)
    integer :: k, r, n
    call records_of(deck, 'SET_SEGMENT', 1, head)
    allocate (model%segment_set(size(head)), ids(size(head)))
    do k = 1, size(head)
      ids(k) = deck%integer(head(k), 'SID')
      n = deck%block(deck%record(head(k))%block)%last - head(k)
      allocate (model%segment_set(k)%node(2, n))
      model%segment_set(k)%id = ids(k)
      model%segment_set(k)%record = head(k)
      do r = 1, n
        call read_segment(deck, maps, head(k) + r, model%segment_set(k)%node(:, r))
      end do
      if (deck%problems%count > 0) cycle
      owner = segment_owner(model, model%segment_set(k)%node)
      do r = 1, n
        if (owner(r) == 0) call deck%complain(head(k) + r, 'N1', &
            'expected two nodes of an exposed element edge')
      end do
    end do
    call make_id_map(deck, 'segment set', 'SID', ids, head, maps%segment_set)
  end subroutine read_segment_sets

  !> Rows of the two nodes of a segment (fields N1, N2; N3 and N4 must be 0 or N2).
  subroutine read_segment(deck, maps, record, node)
    type(deck_t), intent(inout) :: deck
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record
    integer, intent(out) :: node(2)
    character(2), parameter :: name(4) = ['N1', 'N2', 'N3', 'N4']
    integer :: m, id
    do m = 1, 2
      node(m) = find_or_complain(deck, maps%node, record, name(m), &
          deck%integer(record, name(m)), 'node')
    end do
    do m = 3, 4
      id = deck%integer(record, name(m))
      if (id /= 0 .and. id /= deck%integer(record, 'N2')) call deck%complain(record, name(m), &
          'expected 0 or N2: edges of plane elements have two nodes')
    end do
  end subroutine read_segment

end module scene_sets
