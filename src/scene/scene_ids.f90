! SPDX-License-Identifier: BSD-3-Clause
!> Numbers that users give (ids) to rows of our arrays, with both places named when something is
!> defined twice.
module scene_ids
  use base_sort, only: sort_order, find_sorted
  use base_strings, only: to_text
  use deck_data, only: deck_t
  implicit none
  private

  type, public :: id_map_t
    integer, allocatable :: sorted(:)
    integer, allocatable :: row(:)
    logical :: consecutive = .false.  !< ids without holes, in order
  contains
    procedure :: find => id_map_find
  end type id_map_t

  !> The maps of everything that has numbers.
  type, public :: maps_t
    type(id_map_t) :: node, element, part, section, material
    type(id_map_t) :: node_set, part_set, element_set, segment_set, curve, contact, box
  end type maps_t

  public :: make_id_map, records_of, find_or_complain, part_of_element

contains

  !> All records of one card of a keyword, in the order of the deck.
  subroutine records_of(deck, keyword, card, record)
    type(deck_t), intent(in) :: deck
    character(*), intent(in) :: keyword
    integer, intent(in) :: card
    integer, allocatable, intent(out) :: record(:)
    integer :: r, pass, n
    do pass = 1, 2
      if (pass == 2) allocate (record(n))
      n = 0
      r = deck%next(keyword, card, 0)
      do while (r > 0)
        n = n + 1
        if (pass == 2) record(n) = r
        r = deck%next(keyword, card, r)
      end do
    end do
  end subroutine records_of

  !> Map of the ids; record(k) is the card of ids(k), for the message about a second definition.
  subroutine make_id_map(deck, what, field, ids, record, map)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: what, field
    integer, intent(in) :: ids(:)
    integer, intent(in) :: record(:)
    type(id_map_t), intent(out) :: map
    integer :: k
    allocate (map%row(size(ids)))
    call sort_order(ids, map%row)
    map%sorted = ids(map%row)
    map%consecutive = .true.
    do k = 1, size(ids)
      if (map%sorted(k) - map%sorted(1) /= k - 1 .or. map%row(k) /= k) map%consecutive = .false.
      if (k == 1) cycle
      if (map%sorted(k) /= map%sorted(k - 1)) cycle
      call deck%complain(record(map%row(k)), field, what//' '//to_text(map%sorted(k))// &
          ' is defined twice', 'the first is at '//deck%place(record(map%row(k - 1))))
    end do
  end subroutine make_id_map

  !> Row of an id, 0 if there is none.
  pure integer function id_map_find(this, id)
    class(id_map_t), intent(in) :: this
    integer, intent(in) :: id
    if (this%consecutive .and. size(this%sorted) > 0) then
      id_map_find = id - this%sorted(1) + 1
      if (id < this%sorted(1) .or. id > this%sorted(size(this%sorted))) id_map_find = 0
    else
      id_map_find = find_sorted(this%sorted, id)
      if (id_map_find > 0) id_map_find = this%row(id_map_find)
    end if
  end function id_map_find

  !> Row of an id that a field of a record gives; a problem and 0 if there is none.
  integer function find_or_complain(deck, map, record, field, id, what, hint)
    type(deck_t), intent(inout) :: deck
    type(id_map_t), intent(in) :: map
    integer, intent(in) :: record
    character(*), intent(in) :: field
    integer, intent(in) :: id
    character(*), intent(in) :: what
    character(*), intent(in), optional :: hint
    find_or_complain = map%find(id)
    if (find_or_complain == 0) &
        call deck%complain(record, field, what//' '//to_text(id)//' is not defined', hint)
  end function find_or_complain

  !> Part that the card of an element names; a problem and 0 if there is none.
  integer function part_of_element(deck, maps, record)
    type(deck_t), intent(inout) :: deck
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record
    part_of_element = find_or_complain(deck, maps%part, record, 'PID', &
        nint(deck%number_at(record, 2)), 'part', 'add a *PART with this number')
  end function part_of_element

end module scene_ids
