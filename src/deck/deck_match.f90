! SPDX-License-Identifier: BSD-3-Clause
!> The row of the table that a name means, with the card that an option puts before its cards.
module deck_match
  use deck_keywords, only: complete_table
  use deck_table, only: table_t, find_keyword, find_nearest, family_of, keyword_used, &
      keyword_refused, keyword_frame
  implicit none
  private
  !> The card of _TITLE or _ID.
  integer, parameter :: head_none = 0, head_title = 1, head_id = 2
  public :: match_name, base_of

contains

  !> Row of the table for a name with its option _TITLE or _ID; then families of names.
  subroutine match_name(table, name, row, head)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name
    integer, intent(out) :: row, head
    integer :: nearest, distance, prefix
    call match_row(table, name, row, head)
    if (row > 0) return
    call complete_table(table)
    call match_row(table, name, row, head)
    if (row > 0 .or. base_of(table, name) > 0) return
    ! A slip of the pen must not pass for a keyword of a family that is refused.
    row = family_of(table, name)
    if (row == 0) return
    prefix = index(table%keyword(row)%name, '*') - 1
    call find_nearest(table, name, nearest, distance)
    if (distance <= min(2, (len(name) - prefix)/4) &
        .and. table%keyword(nearest)%class /= keyword_refused) row = 0
  end subroutine match_name

  pure subroutine match_row(table, name, row, head)
    type(table_t), intent(in) :: table
    character(*), intent(in) :: name
    integer, intent(out) :: row, head
    head = head_none
    row = find_keyword(table, name)
    if (row > 0) return
    if (ends_with(name, '_TITLE')) then
      row = find_keyword(table, name(1:len(name) - 6))
      if (row > 0) then
        if (table%keyword(row)%may_title) head = head_title
        if (table%keyword(row)%title_is_id) head = head_id
      end if
    else if (ends_with(name, '_ID')) then
      row = find_keyword(table, name(1:len(name) - 3))
      if (row > 0) head = merge(head_id, head_none, table%keyword(row)%may_id)
    end if
    if (row == 0) return
    if (head /= head_none) return
    if (any(table%keyword(row)%class == [keyword_used, keyword_frame])) row = 0
  end subroutine match_row

  !> The keyword that a name consists of apart from a last _OPTION; 0 if there is none.
  pure integer function base_of(table, name)
    type(table_t), intent(in) :: table
    character(*), intent(in) :: name
    integer :: bar
    base_of = 0
    bar = index(name, '_', back=.true.)
    if (bar > 1) base_of = find_keyword(table, name(1:bar - 1))
    if (base_of == 0) return
    if (table%keyword(base_of)%class /= keyword_used) base_of = 0
  end function base_of

  pure logical function ends_with(text, tail)
    character(*), intent(in) :: text
    character(*), intent(in) :: tail
    ends_with = len(text) > len(tail)
    if (ends_with) ends_with = text(len(text) - len(tail) + 1:) == tail
  end function ends_with

end module deck_match
