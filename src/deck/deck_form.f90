! SPDX-License-Identifier: BSD-3-Clause
!> The form of a card: whether commas separate its fields, and the number on the card of _ID.
module deck_form
  use base_strings, only: position_of
  use deck_number, only: scan_integer
  use deck_table, only: card_t
  implicit none
  private
  public :: has_commas, read_head

contains

  !> Do commas separate the fields of a line? Not those in a heading at its end.
  pure logical function has_commas(line, card, long)
    character(*), intent(in) :: line
    type(card_t), intent(in) :: card
    logical, intent(in) :: long
    integer :: comma
    comma = position_of(line, ',')
    has_commas = comma > 0
    if (.not. has_commas) return
    associate (last => card%field(card%fields))
      if (last%kind == 'T') has_commas = has_commas &
          .and. comma <= merge(20*(card%fields - 1) + 1, last%first, long)
    end associate
  end function has_commas

  !> The number on the card of _ID, before the heading: 10 columns (long: 20), or up to a comma
  !> there; 0 if blank.
  pure subroutine read_head(line, long, id, ok)
    character(*), intent(in) :: line
    logical, intent(in) :: long
    integer, intent(out) :: id
    logical, intent(out) :: ok
    integer :: last
    last = index(line(1:min(merge(21, 11, long), len(line))), ',') - 1
    if (last < 0) last = min(merge(20, 10, long), len(line))
    id = 0
    ok = len_trim(line(1:last)) == 0
    if (.not. ok) call scan_integer(trim(adjustl(line(1:last))), id, ok)
    ok = ok .and. id >= 0
  end subroutine read_head

end module deck_form
