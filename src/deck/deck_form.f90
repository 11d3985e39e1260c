! SPDX-License-Identifier: BSD-3-Clause
!> The form of a card: whether commas separate its fields.
module deck_form
  use base_strings, only: position_of
  use deck_table, only: card_t
  implicit none
  private
  public :: has_commas

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

end module deck_form
