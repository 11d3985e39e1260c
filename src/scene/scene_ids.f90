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
  contains
    procedure :: find => id_map_find
  end type id_map_t

  public :: make_id_map

contains

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
    do k = 2, size(ids)
      if (map%sorted(k) /= map%sorted(k - 1)) cycle
      call deck%complain(record(map%row(k)), field, what//' '//to_text(map%sorted(k))// &
          ' is defined twice', 'the first is at '//deck%place(record(map%row(k - 1))))
    end do
  end subroutine make_id_map

  !> Row of an id, 0 if there is none.
  pure integer function id_map_find(this, id)
    class(id_map_t), intent(in) :: this
    integer, intent(in) :: id
    id_map_find = find_sorted(this%sorted, id)
    if (id_map_find > 0) id_map_find = this%row(id_map_find)
  end function id_map_find

end module scene_ids
