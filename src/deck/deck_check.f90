! SPDX-License-Identifier: BSD-3-Clause
!> Checks of one card as it is read: characters, borders of columns, numbers, ranges, classes.
!> Nothing is kept; values are converted again when they are asked for.
module deck_check
  use base_kinds, only: wp
  use base_strings, only: to_text, upper, position_of
  use deck_data, only: deck_t, field_span, slice_field, parameter_of, convert
  use deck_heads, only: read_head
  use deck_problems, only: add_note, full
  use deck_table, only: field_t, card_t, field_tuning, field_fixed, field_in_space, &
      waits_for_dimension
  implicit none
  private
  public :: check_card, check_head, check_dimension

  integer, parameter :: head_id = 2
  !> Squares and products of four numbers of this size stay far from overflow and underflow.
  real(wp), parameter :: largest = 1.0e75_wp

contains

  !> The extra card of _TITLE (a text) or _ID (an id in ten columns and a heading).
  subroutine check_head(deck, record, head)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record, head
    integer :: id
    logical :: ok
    associate (r => deck%record(record))
      associate (file => deck%block(r%block)%file, long => deck%block(r%block)%long)
        associate (line => deck%file(file)%text(r%first:r%last))
          if (len_trim(line) > 80) call deck%complain_at(file, r%line, 81, len_trim(line), &
              'the card of _TITLE or _ID ends at column 80', line, '')
          if (head /= head_id) return
          call read_head(line, long, id, ok)
          if (ok .and. looks_like_card(line, long)) call deck%complain_at(file, r%line, 0, 0, &
              'the heading looks like a card', line, &
              '_ID puts a card with number and heading before each card')
          if (.not. ok) call deck%complain_at(file, r%line, 1, merge(20, 10, long), &
              'the card of _ID begins with an integer in '//trim(merge('twenty', 'ten   ', &
              long))//' columns, found "'//line(1:min(merge(20, 10, long), len(line)))//'"', &
              line, '')
        end associate
      end associate
    end associate
  end subroutine check_head

  !> Does a heading after a number consist of two numbers or more, as a card does?
  pure logical function looks_like_card(line, long)
    character(*), intent(in) :: line
    logical, intent(in) :: long
    real(wp) :: value
    integer :: first, last, numbers
    looks_like_card = .false.
    numbers = 0
    last = merge(20, 10, long)
    do
      first = verify(line(min(last + 1, len(line) + 1):), ' ') + last
      if (first <= last) exit
      last = first + scan(line(first:)//' ', ' ') - 2
      call convert(line(first:last), 'R', value, looks_like_card)
      if (.not. looks_like_card) return
      numbers = numbers + 1
    end do
    looks_like_card = numbers > 1
  end function looks_like_card

  !> All checks of a record; every problem is added to the deck.
  subroutine check_card(deck, record)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    integer :: f, first, last, left, right
    associate (r => deck%record(record))
      associate (block => deck%block(r%block))
        associate (line => deck%file(block%file)%text(r%first:r%last), &
            card => deck%table%keyword(block%keyword)%card(r%card))
          if (card%field(1)%kind == 'T') then
            call check_text(deck, record, line, card)
            return
          end if
          call check_bytes(deck, record, line)
          if (r%comma) then
            call check_commas(deck, record, line, card)
          else
            call check_columns(deck, record, line, card, block%long)
          end if
          do f = 1, card%fields
            call field_span(line, card%field(f), f, r%comma, block%long, first, last)
            if (card%field(f)%kind == 'T') cycle
            if (last >= first .and. waits_for_dimension(card%field(f))) cycle
            if (last >= first) then
              call slice_field(line, card%field(f), f, r%comma, block%long, left, right)
              call check_field(deck, record, f, card%field(f), line(first:last), &
                  line(left:min(right, len(line))))
            else if (card%field(f)%required) then
              call deck%complain(record, trim(card%field(f)%name), 'expected '// &
                  range_text(card%field(f))//', found nothing', 'this field has no default')
            end if
          end do
        end associate
      end associate
    end associate
  end subroutine check_card

  !> The fields whose meaning depends on the dimension of the model, once that is known.
  subroutine check_dimension(deck)
    type(deck_t), intent(inout) :: deck
    integer :: b, r, f
    do b = 1, deck%blocks
      if (.not. deck%table%keyword(deck%block(b)%keyword)%by_dimension) cycle
      do r = deck%block(b)%first, deck%block(b)%last
        if (deck%record(r)%card == 0) cycle
        associate (card => deck%table%keyword(deck%block(b)%keyword)%card(deck%record(r)%card))
          do f = 1, card%fields
            if (waits_for_dimension(card%field(f))) &
                call check_waiting(deck, r, f, card%field(f))
          end do
        end associate
      end do
    end do
  end subroutine check_dimension

  !> One of them: as the plane has it, or space.
  subroutine check_waiting(deck, record, f, field)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record, f
    type(field_t), intent(in) :: field
    type(field_t) :: here
    character(:), allocatable :: line
    integer :: first, last, left, right
    here = field
    if (.not. deck%in_space) then
      here%high = min(field%high, field%plane_high)
      if (field%class == field_in_space) here%class = field_fixed
    end if
    associate (r => deck%record(record))
      associate (block => deck%block(r%block))
        line = deck%file(block%file)%text(r%first:r%last)
        call field_span(line, field, f, r%comma, block%long, first, last)
        if (last < first) return
        call slice_field(line, field, f, r%comma, block%long, left, right)
      end associate
    end associate
    call check_field(deck, record, f, here, line(first:last), line(left:min(right, len(line))))
  end subroutine check_waiting

  !> Text is taken as it is, but not cut.
  subroutine check_text(deck, record, line, card)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    character(*), intent(in) :: line
    type(card_t), intent(in) :: card
    if (len_trim(line) > card%field(1)%width) call deck%complain(record, &
        trim(card%field(1)%name), 'text beyond column '//to_text(card%field(1)%width))
  end subroutine check_text

  !> Tabs and bytes that are no printable ASCII.
  subroutine check_bytes(deck, record, line)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    character(*), intent(in) :: line
    integer :: k
    do k = 1, len(line)
      if (line(k:k) >= ' ' .and. line(k:k) <= '~') cycle
      if (line(k:k) == achar(9)) then
        call deck%complain(record, '', 'a tab in a data card, column '//to_text(k), &
            'expand tabs to blanks')
      else
        call deck%complain(record, '', 'a byte that is no printable ASCII, column '// &
            to_text(k), 'use plain ASCII in data cards')
      end if
      return
    end do
  end subroutine check_bytes

  !> At most as many comma-separated fields as the card has; a comma after the last is fine.
  subroutine check_commas(deck, record, line, card)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    character(*), intent(in) :: line
    type(card_t), intent(in) :: card
    integer :: k, commas
    commas = 0
    do k = 1, len(line)
      if (line(k:k) == ',') commas = commas + 1
    end do
    if (commas < card%fields .or. card%field(card%fields)%kind == 'T') return
    if (commas == card%fields .and. len_trim(line(index(line, ',', back=.true.) + 1:)) == 0) &
        return
    call deck%complain(record, '', 'expected at most '//to_text(card%fields)// &
        ' comma-separated fields, found '//to_text(commas + 1))
  end subroutine check_commas

  !> Text beyond the last field, and runs of characters that cross a border between two fields.
  subroutine check_columns(deck, record, line, card, long)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    character(*), intent(in) :: line
    type(card_t), intent(in) :: card
    logical, intent(in) :: long
    integer :: f, last
    last = card%field(card%fields)%first + card%field(card%fields)%width - 1
    if (long) last = 20*card%fields
    if (long .and. card%field(card%fields)%kind == 'T') &
        last = last - 20 + card%field(card%fields)%width
    if (len(line) > last) then
      if (len_trim(line(last + 1:)) > 0) &
          call deck%complain(record, '', 'text beyond column '//to_text(last)// &
          ', where the last field ends', 'a field may have slipped to the right')
    end if
    do f = 1, card%fields - 1
      last = card%field(f + 1)%first - 1
      if (long) last = 20*f
      if (last >= len(line)) return
      if (line(last:last) == ' ' .or. line(last + 1:last + 1) == ' ') cycle
      call check_border(deck, record, line, card%field(f), card%field(f + 1), last, long)
    end do
  end subroutine check_columns

  !> A run of characters across a border is a value that has slipped when it is one value as a
  !> whole and neither side fills its field. Else two values touch there, which is legal: each
  !> keeps to its own columns.
  subroutine check_border(deck, record, line, left, right, border, long)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    character(*), intent(in) :: line
    type(field_t), intent(in) :: left, right
    integer, intent(in) :: border
    logical, intent(in) :: long
    integer :: first, last
    if (right%kind == 'T') return
    first = border - merge(20, left%width, long) + 1
    last = min(border + merge(20, right%width, long), len(line))
    if (index(line(first:border), ' ') == 0) return
    if (last == border + merge(20, right%width, long)) then
      if (index(line(border + 1:last), ' ') == 0) return
    end if
    first = first + index(line(first:border), ' ', back=.true.)
    last = border - 1 + index(line(border + 1:last)//' ', ' ')
    if (.not. (is_value(deck, record, left, line(first:last)) &
        .or. is_value(deck, record, right, line(first:last)))) return
    call deck%complain(record, trim(right%name), 'the value "'//line(first:last)// &
        '" crosses the border between columns '//to_text(border)//' and '// &
        to_text(border + 1), 'fields '//trim(left%name)//' and '//trim(right%name)// &
        ' meet there; the card looks shifted')
  end subroutine check_border

  !> Is a text a value that a field could hold? A number does not begin with a zero and another
  !> digit: those are two numbers that touch.
  pure logical function is_value(deck, record, field, text)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record
    type(field_t), intent(in) :: field
    character(*), intent(in) :: text
    real(wp) :: value
    integer :: mark
    mark = reference_mark(text)
    if (mark > 0) then
      is_value = parameter_of(deck, record, text(mark + 1:)) > 0
    else if (field%kind == 'W') then
      is_value = is_word(field, text)
    else
      call convert(text, field%kind, value, is_value)
      if (is_value .and. len(text) > 1) &
          is_value = text(1:1) /= '0' .or. scan(text(2:2), '0123456789') == 0
    end if
  end function is_value

  !> Is a text among the words that a field takes?
  pure logical function is_word(field, text)
    type(field_t), intent(in) :: field
    character(*), intent(in) :: text
    is_word = index(field%words, '|'//upper(text)//'|') > 0
  end function is_word

  !> Where "&" stands in "&name" or "-&name"; 0 if the text is no reference to a parameter.
  pure integer function reference_mark(text)
    character(*), intent(in) :: text
    reference_mark = position_of(text(1:min(2, len(text))), '&')
    if (reference_mark == 2) reference_mark = merge(2, 0, text(1:1) == '-')
  end function reference_mark

  !> One field that is not blank: a parameter, or a value of its kind, range and class. written
  !> is the field as it stands, with its blanks.
  subroutine check_field(deck, record, f, field, text, written)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record, f
    type(field_t), intent(in) :: field
    character(*), intent(in) :: text, written
    integer :: row, mark
    mark = reference_mark(text)
    if (mark == 0) then
      call check_value(deck, record, field, text, written)
      return
    end if
    row = parameter_of(deck, record, text(mark + 1:))
    if (row == 0) then
      call deck%complain(record, trim(field%name), 'undefined parameter "'//text(mark:)//'"', &
          'define it with *PARAMETER before its use')
    else if (mark == 2 .and. deck%parameter(row)%kind == 'C') then
      call deck%complain(record, trim(field%name), 'a word has no sign: "'//text//'"', &
          'write '//text(mark:))
    else
      call check_value(deck, record, field, deck%text_at(record, f), trim(adjustl(written))// &
          ' = '//deck%text_at(record, f))
    end if
  end subroutine check_field

  !> Kind, range, list of words and class of a value; written is what stands on the card.
  subroutine check_value(deck, record, field, text, written)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    type(field_t), intent(in) :: field
    character(*), intent(in) :: text, written
    real(wp) :: value
    logical :: ok
    value = 0.0_wp
    if (field%kind == 'W') then
      ok = len_trim(field%words) == 0 .or. is_word(field, text)
      if (.not. ok) then
        call deck%complain(record, trim(field%name), 'expected '//range_text(field)// &
            ', found "'//written//'"', 'other words are not available in this version')
        return
      end if
    else
      call convert(text, field%kind, value, ok)
      if (ok) ok = in_range(field, value) &
          .or. (field%zero_is_default .and. .not. abs(value) > 0.0_wp)
      if (.not. ok) then
        call deck%complain(record, trim(field%name), 'expected '//range_text(field)// &
            ', found "'//written//'"', number_hint(field, text))
        return
      end if
      if (abs(value) > largest &
          .or. (abs(value) > 0.0_wp .and. abs(value) < 1.0_wp/largest)) then
        call deck%complain(record, trim(field%name), &
            'expected 0 or a size between 1e-75 and '//'1e75, found "'//written//'"', &
            'choose other units')
        return
      end if
    end if
    if (field%class == field_fixed .or. field%class == field_tuning) &
        call check_class(deck, record, field, text, written, value)
  end subroutine check_value

  pure logical function in_range(field, value)
    type(field_t), intent(in) :: field
    real(wp), intent(in) :: value
    in_range = value >= field%low .and. value <= field%high
    if (field%low_open) in_range = in_range .and. value > field%low
    if (field%high_open) in_range = in_range .and. value < field%high
  end function in_range

  !> What is no number at all: why it may have happened.
  pure function number_hint(field, text) result(hint)
    type(field_t), intent(in) :: field
    character(*), intent(in) :: text
    character(:), allocatable :: hint
    real(wp) :: value
    logical :: ok
    hint = ''
    if (index(text, ' ') > 0) then
      hint = 'a blank inside a number: a field may have slipped across its border'
    else if (field%kind == 'I') then
      call convert(text, 'R', value, ok)
      if (ok .and. abs(value) >= 2147483648.0_wp) hint = 'integers are at most 2147483647'
    end if
  end function number_hint

  !> A field that this version does not use: blank or its default, or of another method.
  subroutine check_class(deck, record, field, text, written, value)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    type(field_t), intent(in) :: field
    character(*), intent(in) :: text, written
    real(wp), intent(in) :: value
    real(wp) :: default
    logical :: ok
    if (field%kind == 'W') then
      ok = upper(text) == field%default
    else if (len_trim(field%default) == 0) then
      ok = .not. abs(value) > 0.0_wp
    else
      call convert(trim(field%default), field%kind, default, ok)
      ok = .not. abs(value - default) > 0.0_wp
      if (field%zero_is_default) ok = ok .or. .not. abs(value) > 0.0_wp
    end if
    if (ok) return
    if (field%class == field_tuning) then
      call add_note(deck%problems, '*'// &
          trim(deck%table%keyword(deck%block(deck%record(record)%block)%keyword)%name)//' '// &
          trim(field%name)//' has no effect ('//trim(field%help)//')')
    else if (.not. full(deck%problems)) then
      call deck%complain(record, trim(field%name), 'expected blank'//default_text(field)// &
          ', found "'//written//'"', &
          'what this field asks for is not available in this version')
    end if
  end subroutine check_class

  pure function default_text(field) result(text)
    type(field_t), intent(in) :: field
    character(:), allocatable :: text
    text = ' or 0'
    if (len_trim(field%default) > 0) text = ' or '//trim(field%default)
    if (field%kind == 'W' .and. len_trim(field%default) == 0) text = ''
  end function default_text

  !> "an integer >= 1 and <= 3", "one of A, B".
  pure function range_text(field) result(text)
    type(field_t), intent(in) :: field
    character(:), allocatable :: text
    integer :: k
    select case (field%kind)
    case ('I')
      text = 'an integer'
    case ('R')
      text = 'a real number'
    case default
      text = 'a word'
      if (len_trim(field%words) == 0) return
      text = ''
      if (index(field%words(2:), '|') < len_trim(field%words) - 1) text = 'one of '
      do k = 2, len_trim(field%words) - 1
        if (field%words(k:k) == '|') text = text//', '
        if (field%words(k:k) /= '|') text = text//field%words(k:k)
      end do
    end select
    if (field%low > -huge(1.0_wp)) text = text//trim(merge(' > ', ' >=', field%low_open))// &
        ' '//short(field%low)
    if (field%low > -huge(1.0_wp) .and. field%high < huge(1.0_wp)) text = text//' and'
    if (field%high < huge(1.0_wp)) text = text//trim(merge(' < ', ' <=', field%high_open))// &
        ' '//short(field%high)
  end function range_text

  pure function short(number) result(text)
    real(wp), intent(in) :: number
    character(:), allocatable :: text
    if (abs(number - anint(number)) > 0.0_wp .or. abs(number) > 1.0e6_wp) then
      text = to_text(number)
    else
      text = to_text(nint(number))
    end if
  end function short

end module deck_check
