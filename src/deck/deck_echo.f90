! SPDX-License-Identifier: BSD-3-Clause
!> The deck as understood, again as a deck: includes and parameters resolved, blanks filled with
!> the defaults. A value that was written as a number keeps its own text, so it reads back
!> equal.
module deck_echo
  use base_kinds, only: wp
  use base_strings, only: to_text
  use deck_data, only: deck_t, record_t, slice_field
  use deck_table, only: field_t, card_t
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
        if (deck%table%keyword(block%keyword)%cards == 0) cycle
        write (unit, '(a)') '*'//trim(block%written)
        if (block%title > 0) write (unit, '(a)') trim(deck%text(block%title))
        do r = block%first, block%last
          call write_card(deck, unit, r, &
              deck%table%keyword(block%keyword)%card(deck%record(r)%card))
        end do
      end associate
    end do
    write (unit, '(a)') '*END'
  end subroutine write_echo

  !> One card, in the form it was written in, or in comma form when a value needs more room.
  subroutine write_card(deck, unit, r, card)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: unit, r
    type(card_t), intent(in) :: card
    character(200) :: fixed
    character(:), allocatable :: list, value
    integer :: f, width, first
    logical :: comma, long
    long = deck%block(deck%record(r)%block)%long
    associate (at => deck%record(r))
      associate (line => deck%file(at%file)%text(at%first:at%last))
        comma = index(line, ',') > 0 .and. card%field(1)%kind /= 'T'
        if (plain(line, card, comma)) then
          write (unit, '(a)') line
          return
        end if
        fixed = ''
        list = ''
        do f = 1, card%fields
          value = field_text(deck, r, line, card%field(f), f, comma, long)
          width = merge(20, card%field(f)%width, long)
          first = merge(20*(f - 1) + 1, card%field(f)%first, long)
          if (len(value) > width) then
            comma = .true.
          else if (card%field(f)%kind == 'T') then
            fixed(first:first + width - 1) = value
          else
            fixed(first + width - len(value):first + width - 1) = value
          end if
          list = list//value//','
        end do
      end associate
    end associate
    if (comma) then
      f = verify(list, ',', back=.true.)
      write (unit, '(a)') list(1:max(f, 1))//merge(',', ' ', index(list(1:max(f, 1)), ',') == 0)
    else
      write (unit, '(a)') trim(fixed)
    end if
  end subroutine write_card

  !> A card with neither parameters nor defaults to fill in can be copied.
  pure logical function plain(line, card, comma)
    character(*), intent(in) :: line
    type(card_t), intent(in) :: card
    logical, intent(in) :: comma
    integer :: f
    plain = .not. comma .and. index(line, '&') == 0
    do f = 1, card%fields
      if (.not. plain) return
      plain = len_trim(card%field(f)%default) == 0
      if (plain .or. card%field(f)%first > len(line)) cycle
      plain = line(card%field(f)%first:min(card%field(f)%first + card%field(f)%width - 1, &
          len(line))) /= ' '
    end do
  end function plain

  !> The text of one field: as written, or the value of its parameter, or its default.
  function field_text(deck, r, line, field, f, comma, long) result(text)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: r
    character(*), intent(in) :: line
    type(field_t), intent(in) :: field
    integer, intent(in) :: f
    logical, intent(in) :: comma, long
    character(:), allocatable :: text
    integer :: first, last
    call slice_field(line, field, f, comma, long, first, last)
    text = line(min(first, len(line) + 1):min(last, len(line)))
    if (field%kind /= 'T') text = trim(adjustl(text))
    if (len_trim(text) == 0 .or. .not. deck%given(deck%record(r)%start + f)) then
      text = trim(field%default)
    else if (index(text(1:min(2, len(text))), '&') > 0 .and. field%kind /= 'T') then
      text = value_text(deck, deck%value(deck%record(r)%start + f), field)
    end if
  end function field_text

  !> A resolved parameter: the shortest digits that read back equal.
  function value_text(deck, value, field) result(text)
    type(deck_t), intent(in) :: deck
    real(wp), intent(in) :: value
    type(field_t), intent(in) :: field
    character(:), allocatable :: text
    character(24) :: buffer, form
    real(wp) :: back
    integer :: digits, e
    select case (field%kind)
    case ('I')
      text = to_text(nint(value))
    case ('R')
      do digits = 0, 16
        write (form, '("(es24.",i0,"e3)")') digits
        write (buffer, form) value
        read (buffer, *) back
        if (.not. abs(back - value) > 0.0_wp) exit
      end do
      text = trim(adjustl(buffer))
      e = index(text, 'E')
      read (text(e + 1:), *) digits
      text = text(1:e)//to_text(digits)
    case default
      text = trim(deck%text(nint(value)))
    end select
  end function value_text

end module deck_echo
