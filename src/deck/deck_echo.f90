! SPDX-License-Identifier: BSD-3-Clause
!> The deck as understood, again as a deck: includes and parameters resolved, blanks filled with
!> the defaults. A value that was written as a number keeps its own text, so it reads back
!> equal.
module deck_echo
  use base_strings, only: to_text, position_of
  use deck_data, only: deck_t, field_span
  use deck_table, only: card_t, field_t
  implicit none
  private
  public :: write_echo

contains

  !> Writes the echo deck to an open formatted unit.
  subroutine write_echo(deck, unit)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: unit
    integer :: b, r
    write (unit, '(a)') '$ the deck as understood: includes, parameters and defaults resolved'
    write (unit, '(a)') '*KEYWORD'
    do b = 1, deck%blocks
      associate (block => deck%block(b))
        write (unit, '(a)') '*'//trim(block%written)//trim(merge('+', ' ', block%long))
        do r = block%first, block%last
          associate (line => deck%file(block%file)%text( &
              deck%record(r)%first:deck%record(r)%last))
            if (deck%record(r)%card == 0) then
              write (unit, '(a)') line
            else
              call write_card(deck, unit, r, line, &
                  deck%table%keyword(block%keyword)%card(deck%record(r)%card), block%long)
            end if
          end associate
        end do
      end associate
    end do
    write (unit, '(a)') '*END'
  end subroutine write_echo

  !> One card: in columns, or in comma form where it was, or where a value needs more room.
  subroutine write_card(deck, unit, r, line, card, long)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: unit, r
    character(*), intent(in) :: line
    type(card_t), intent(in) :: card
    logical, intent(in) :: long
    character(200) :: fixed
    character(:), allocatable :: list, value
    integer :: f, width, first
    logical :: comma
    if (card%field(1)%kind == 'T') then
      write (unit, '(a)') line
      return
    end if
    comma = position_of(line, ',') > 0
    if (plain(line, card, comma, long)) then
      write (unit, '(a)') line
      return
    end if
    fixed = ''
    list = ''
    do f = 1, card%fields
      value = deck%text_at(r, f)
      if (card%field(f)%zero_is_default .and. .not. deck%is_given(r, card%field(f)%name)) &
          value = trim(card%field(f)%default)
      width = merge(20, card%field(f)%width, long)
      first = merge(20*(f - 1) + 1, card%field(f)%first, long)
      if (len(value) > width) then
        comma = .true.
      else
        fixed(first + width - len(value):first + width - 1) = value
      end if
      list = list//value//','
    end do
    if (comma) then
      write (unit, '(a)') list(1:max(verify(list, ',', back=.true.), 1))//','
    else
      write (unit, '(a)') trim(fixed)
    end if
  end subroutine write_card

  !> A card with neither parameters nor defaults to fill in can be copied.
  pure logical function plain(line, card, comma, long)
    character(*), intent(in) :: line
    type(card_t), intent(in) :: card
    logical, intent(in) :: comma, long
    integer :: f, first, last
    plain = .not. comma .and. position_of(line, '&') == 0
    do f = 1, card%fields
      if (.not. plain) return
      if (len_trim(card%field(f)%default) == 0) cycle
      call field_span(line, card%field(f), f, comma, long, first, last)
      plain = last >= first .and. .not. card%field(f)%zero_is_default
    end do
  end function plain

end module deck_echo
