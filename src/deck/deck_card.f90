! SPDX-License-Identifier: BSD-3-Clause
!> The cards under one keyword: which card each line is, and how many there must be.
module deck_card
  use base_strings, only: to_text
  use deck_check, only: check_card, check_head
  use deck_data, only: deck_t, block_t, record_t
  use deck_form, only: has_commas, has_two_fields
  use deck_problems, only: add_note
  use deck_source, only: cursor_t, next_line
  use deck_table, only: keyword_t
  implicit none
  private
  public :: start_block, read_cards, note_blank_line

contains

  !> Opens a block for a keyword at the cursor.
  subroutine start_block(deck, cursor, row, name, long)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    integer, intent(in) :: row
    character(*), intent(in) :: name
    logical, intent(in) :: long
    type(block_t), allocatable :: longer(:)
    if (deck%blocks == size(deck%block)) then
      allocate (longer(2*deck%blocks))
      longer(1:deck%blocks) = deck%block
      call move_alloc(longer, deck%block)
    end if
    deck%blocks = deck%blocks + 1
    deck%block(deck%blocks) = block_t(keyword=row, long=long, first=deck%records + 1, &
        last=deck%records, file=cursor%file, line=cursor%line, written=name)
    if (deck%table%keyword(row)%once) call check_once(deck, cursor, row)
  end subroutine start_block

  subroutine check_once(deck, cursor, row)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    integer, intent(in) :: row
    integer :: b
    do b = 1, deck%blocks - 1
      if (deck%table%keyword(deck%block(b)%keyword)%canonical_row &
          /= deck%table%keyword(row)%canonical_row) cycle
      call deck%complain_at(cursor%file, cursor%line, 0, 0, '*'// &
          trim(deck%table%keyword(row)%name)//' stands twice', '', 'the first is at '// &
          deck%file(deck%block(b)%file)%path//':'//to_text(deck%block(b)%line))
      return
    end do
  end subroutine check_once

  !> Reads all cards of the block just opened; on exit the cursor is at the next keyword. head:
  !> the keyword has the option _TITLE (head = 1) or _ID (2), a card before each set of cards.
  subroutine read_cards(deck, cursor, head, more)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(inout) :: cursor
    integer, intent(in) :: head
    logical, intent(inout) :: more
    integer :: card, row, count, solid_line
    logical :: head_is_next, at_end, set_is_whole
    row = deck%block(deck%blocks)%keyword
    head_is_next = head > 0
    at_end = .false.
    solid_line = 0
    card = 0
    count = 0
    do while (more)
      associate (line => deck%file(cursor%file)%text(cursor%first:cursor%last), &
          k => deck%table%keyword(row))
        if (len(line) > 0) then
          if (line(1:1) == '*') exit
        end if
        set_is_whole = card == k%cards .and. k%repeat_from == 1
        if (len_trim(line) == 0) then
          call look_ahead(deck, cursor, solid_line, at_end)
          if (is_between_cards(k, card, count, &
              head_is_next .or. (set_is_whole .and. head > 0), at_end)) then
            call note_blank_line(deck, cursor%file)
            more = next_line(deck%file(cursor%file), cursor)
            cycle
          end if
        end if
        if (set_is_whole) then
          head_is_next = head > 0
          card = 0
        end if
        if (count == 0 .and. k%other_form > 0) call choose_form(deck, line, row)
      end associate
      associate (line => deck%file(cursor%file)%text(cursor%first:cursor%last), &
          k => deck%table%keyword(row))
        if (head_is_next) then
          head_is_next = .false.
          call add_record(deck, cursor, 0)
          call check_head(deck, deck%records, head)
        else if (card == k%cards .and. k%repeat_from == 0) then
          if (len_trim(line) > 0) call too_many_cards(deck, cursor, row)
        else
          if (card == k%cards) card = k%repeat_from - 1
          card = card + 1
          count = count + 1
          call add_record(deck, cursor, card)
          call check_card(deck, deck%records)
        end if
      end associate
      more = next_line(deck%file(cursor%file), cursor)
    end do
    deck%block(deck%blocks)%last = deck%records
    call check_count(deck, row, count, card)
  end subroutine read_cards

  !> The first card of a keyword that has two forms tells which it is: row becomes that of the
  !> other one where two fields stand alone.
  subroutine choose_form(deck, line, row)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: line
    integer, intent(inout) :: row
    associate (block => deck%block(deck%blocks))
      if (has_two_fields(line, deck%table%keyword(row)%card(1), block%long)) &
          row = deck%table%keyword(row)%other_form
      block%keyword = row
    end associate
  end subroutine choose_form

  !> A blank line is no card where a card with fields that must be given comes next, or where
  !> only further sets could follow: it stands between cards.
  pure logical function is_between_cards(k, card, count, head_is_next, at_end) result(between)
    type(keyword_t), intent(in) :: k
    integer, intent(in) :: card, count
    logical, intent(in) :: head_is_next, at_end
    integer :: next
    next = card + 1
    if (card == k%cards) next = max(k%repeat_from, 1)
    between = at_end .and. count >= k%required .and. (k%repeat_from /= 1 .or. next == 1)
    if (head_is_next .or. between) return
    between = any(k%card(next)%field(1:k%card(next)%fields)%required) &
        .or. (count >= k%required .and. k%repeat_from > 1)
  end function is_between_cards

  !> Finds the next line that is not blank, and whether it is a keyword (the end of the file
  !> counts as one). Looked for once per run of blank lines.
  subroutine look_ahead(deck, cursor, line, is_keyword)
    type(deck_t), intent(in) :: deck
    type(cursor_t), intent(in) :: cursor
    integer, intent(inout) :: line
    logical, intent(inout) :: is_keyword
    type(cursor_t) :: ahead
    if (line > cursor%line) return
    ahead = cursor
    is_keyword = .true.
    do while (next_line(deck%file(cursor%file), ahead))
      line = ahead%line
      associate (text => deck%file(cursor%file)%text(ahead%first:ahead%last))
        if (len_trim(text) == 0) cycle
        is_keyword = text(1:1) == '*'
      end associate
      return
    end do
  end subroutine look_ahead

  !> One note for a file with blank lines that are no cards.
  subroutine note_blank_line(deck, file)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: file
    call add_note(deck%problems, deck%file(file)%path// &
        ': blank lines between cards are passed over')
  end subroutine note_blank_line

  subroutine add_record(deck, cursor, card)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    integer, intent(in) :: card
    type(record_t), allocatable :: longer(:)
    if (deck%records == size(deck%record)) then
      allocate (longer(deck%records + deck%records/2))
      longer(1:deck%records) = deck%record
      call move_alloc(longer, deck%record)
    end if
    deck%records = deck%records + 1
    deck%record(deck%records) = record_t(block=deck%blocks, card=card, line=cursor%line, &
        first=cursor%first, last=cursor%last)
    if (card == 0) return
    associate (block => deck%block(deck%blocks))
      deck%record(deck%records)%comma = has_commas( &
          deck%file(cursor%file)%text(cursor%first:cursor%last), &
          deck%table%keyword(block%keyword)%card(card), block%long)
    end associate
  end subroutine add_record

  !> Mandatory cards of the last set must all be there.
  subroutine check_count(deck, row, count, card)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: row, count, card
    integer :: line, wanted
    associate (k => deck%table%keyword(row), block => deck%block(deck%blocks))
      wanted = k%required
      if (k%repeat_from == 1 .and. count > 0) wanted = k%cards
      if (count >= k%required &
          .and. (k%repeat_from /= 1 .or. count == 0 .or. card >= wanted)) return
      line = block%line
      if (block%last >= block%first) line = deck%record(block%last)%line
      call deck%complain_at(block%file, line, 0, 0, '*'//trim(k%name)// &
          ' ends too early: expected '//cards(wanted)//trim(merge(' a set', '      ', &
          k%repeat_from == 1))//', found '//to_text(merge(card, count, k%repeat_from == 1)), &
          '', 'a card may be blank, but it must be there')
    end associate
  end subroutine check_count

  subroutine too_many_cards(deck, cursor, row)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    integer, intent(in) :: row
    associate (k => deck%table%keyword(row))
      call deck%complain_at(cursor%file, cursor%line, 0, 0, '*'//trim(k%name)// &
          ': one card too many', deck%file(cursor%file)%text(cursor%first:cursor%last), &
          'this keyword has at most '//to_text(k%cards)// &
          merge(' card ', ' cards', k%cards == 1))
    end associate
  end subroutine too_many_cards

  pure function cards(n) result(text)
    integer, intent(in) :: n
    character(:), allocatable :: text
    text = to_text(n)//trim(merge(' card ', ' cards', n == 1))
  end function cards

end module deck_card
