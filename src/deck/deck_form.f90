! SPDX-License-Identifier: BSD-3-Clause
!> The form of a card: whether commas separate its fields, whether it has two alone.
module deck_form
  use base_strings, only: position_of
  use deck_data, only: field_span
  use deck_table, only: card_t
  implicit none
  private
  public :: has_commas, has_two_fields

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

  !> Are all fields of a line after its second one blank?
  pure logical function has_two_fields(line, card, long)
    character(*), intent(in) :: line
    type(card_t), intent(in) :: card
    logical, intent(in) :: long
    integer :: f, first, last
    has_two_fields = .true.
    do f = 3, card%fields
      call field_span(line, card%field(f), f, has_commas(line, card, long), long, first, last)
      has_two_fields = has_two_fields .and. last < first
    end do
  end function has_two_fields

end module deck_form
