! SPDX-License-Identifier: BSD-3-Clause
!> The deck as understood, again as a deck: includes and parameters resolved, blanks filled with
!> the defaults. A value that was written as a number keeps its own text, so it reads back
!> equal.
module deck_echo
  use base_checksum, only: checksum_of_text
  use base_strings, only: to_text, position_of
  use deck_data, only: deck_t, field_span
  use deck_table, only: card_t, field_t
  implicit none
  private
  public :: write_echo, forget_cards

  !> Lines on their way to a unit, many at a time: a WRITE of each would be most of the work.
  type :: lines_t
    integer :: unit = -1
    integer :: filled = 0
    character(32768) :: buffer
  end type lines_t

contains

  !> Writes the echo deck to an open formatted unit.
  subroutine write_echo(deck, unit)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: unit
    type(lines_t) :: lines
    integer :: b, r
    lines%unit = unit
    call put_line(lines, '$ the deck as understood: includes, parameters and defaults resolved')
    call put_line(lines, '*KEYWORD')
    do b = 1, deck%blocks
      associate (block => deck%block(b))
        call put_line(lines, '*'//trim(block%written)//trim(merge('+', ' ', block%long)))
        do r = block%first, block%last
          associate (line => deck%file(block%file)%text( &
              deck%record(r)%first:deck%record(r)%last))
            if (deck%record(r)%card == 0) then
              call put_line(lines, line)
            else
              call write_card(deck, lines, r, line, &
                  deck%table%keyword(block%keyword)%card(deck%record(r)%card), block%long)
            end if
          end associate
        end do
      end associate
    end do
    call put_line(lines, '*END')
    call write_out(lines)
  end subroutine write_echo

  !> Text and cards are gone: of a large mesh they are several times its nodes. Names of files,
  !> their lengths and checksums stay, and the parameters.
  subroutine forget_cards(deck)
    type(deck_t), intent(inout) :: deck
    integer :: k
    do k = 1, deck%files
      associate (file => deck%file(k))
        file%bytes = len(file%text)
        file%checksum = checksum_of_text(file%text)
        deallocate (file%text)
      end associate
    end do
    deallocate (deck%record, deck%block)
    deck%records = 0
    deck%blocks = 0
  end subroutine forget_cards

  subroutine put_line(lines, line)
    type(lines_t), intent(inout) :: lines
    character(*), intent(in) :: line
    if (lines%filled + len(line) + 1 > len(lines%buffer)) call write_out(lines)
    if (len(line) + 1 > len(lines%buffer)) then
      write (lines%unit, '(a)') line
      return
    end if
    associate (first => lines%filled + 1, last => lines%filled + len(line) + 1)
      lines%buffer(first:last - 1) = line
      lines%buffer(last:last) = new_line('a')
    end associate
    lines%filled = lines%filled + len(line) + 1
  end subroutine put_line

  !> What is held. The end of the record is that of the last line.
  subroutine write_out(lines)
    type(lines_t), intent(inout) :: lines
    if (lines%filled > 0) write (lines%unit, '(a)') lines%buffer(:lines%filled - 1)
    lines%filled = 0
  end subroutine write_out

  !> One card: in columns, or in comma form where it was, or where a value needs more room.
  subroutine write_card(deck, lines, r, line, card, long)
    type(deck_t), intent(in) :: deck
    type(lines_t), intent(inout) :: lines
    integer, intent(in) :: r
    character(*), intent(in) :: line
    type(card_t), intent(in) :: card
    logical, intent(in) :: long
    character(:), allocatable :: list
    integer :: f
    logical :: comma
    if (card%field(1)%kind == 'T') then
      call put_line(lines, line)
      return
    end if
    comma = deck%record(r)%comma
    if (plain(line, card, comma, long)) then
      call put_line(lines, line)
      return
    end if
    if (.not. comma) call write_columns(deck, lines, r, card, long, comma)
    if (.not. comma) return
    list = ''
    do f = 1, card%fields
      list = list//value_of(deck, r, f, card%field(f))//','
    end do
    call put_line(lines, list(1:max(verify(list, ',', back=.true.), 1))//',')
  end subroutine write_card

  !> A card in columns; comma: a value needs more room, nothing is written.
  subroutine write_columns(deck, lines, r, card, long, comma)
    type(deck_t), intent(in) :: deck
    type(lines_t), intent(inout) :: lines
    integer, intent(in) :: r
    type(card_t), intent(in) :: card
    logical, intent(in) :: long
    logical, intent(out) :: comma
    character(200) :: fixed
    character(:), allocatable :: value
    integer :: f, last
    comma = .true.
    fixed = ''
    do f = 1, card%fields
      value = value_of(deck, r, f, card%field(f))
      if (len(value) > merge(20, card%field(f)%width, long)) return
      last = merge(20*f, card%field(f)%first + card%field(f)%width - 1, long)
      fixed(last - len(value) + 1:last) = value
    end do
    comma = .false.
    call put_line(lines, trim(fixed))
  end subroutine write_columns

  !> What a field means, as text.
  pure function value_of(deck, r, f, field) result(value)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: r, f
    type(field_t), intent(in) :: field
    character(:), allocatable :: value
    if (field%zero_is_default) then
      if (.not. deck%is_given(r, field%name)) then
        value = trim(field%default)
        return
      end if
    end if
    value = deck%text_at(r, f)
  end function value_of

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
