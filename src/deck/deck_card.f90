! SPDX-License-Identifier: BSD-3-Clause
!> One card: columns or commas to values, by the row of its keyword in the table.
module deck_card
  use base_kinds, only: wp
  use base_strings, only: to_text, upper
  use deck_data, only: deck_t, block_t, record_t, slice_field
  use deck_number, only: scan_integer, scan_real
  use deck_parameter, only: parameters_t, find_parameter
  use deck_problems, only: add_problem, add_note, render, full
  use deck_source, only: cursor_t, next_line
  use deck_table, only: field_t, card_t, field_tuning, field_fixed, max_fields
  implicit none
  private
  public :: start_block, read_card

contains

  !> Opens a block for a keyword.
  subroutine start_block(deck, row, name, long)
    type(deck_t), intent(inout) :: deck
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
        last=deck%records, written=name)
  end subroutine start_block

  !> Reads all cards of the block just opened; on exit the cursor is at the next keyword.
  subroutine read_card(deck, cursor, parameters, title, id, more)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(inout) :: cursor
    type(parameters_t), intent(in) :: parameters
    logical, intent(in) :: title, id
    logical, intent(inout) :: more
    integer :: card, row, start_line, count
    logical :: head
    row = deck%block(deck%blocks)%keyword
    start_line = cursor%line
    head = title .or. id
    card = 0
    count = 0
    do while (more)
      associate (line => deck%file(cursor%file)%text(cursor%first:cursor%last), &
          k => deck%table%keyword(row))
        if (len(line) > 0) then
          if (line(1:1) == '*') exit
        end if
        if (head) then
          head = .false.
          call read_head(deck, line, id)
        else
          card = card + 1
          if (card > k%cards .and. k%repeat_from > 0) card = k%repeat_from
          if (card > k%cards) then
            if (len_trim(line) > 0) call too_many_cards(deck, cursor, row)
          else
            count = count + 1
            call parse_card(deck, cursor, row, card, parameters)
          end if
        end if
      end associate
      more = next_line(deck%file(cursor%file), cursor)
    end do
    deck%block(deck%blocks)%last = deck%records
    call check_count(deck, cursor, row, count, card, more)
  end subroutine read_card

  !> The extra card of _TITLE (a text) or _ID (an id and a heading).
  subroutine read_head(deck, line, id)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: line
    logical, intent(in) :: id
    logical :: ok
    associate (b => deck%block(deck%blocks))
      call keep_text(deck, line, b%title)
      if (id) call scan_integer(trim(adjustl(line(1:min(10, len(line))))), b%id, ok)
    end associate
  end subroutine read_head

  subroutine check_count(deck, cursor, row, count, card, more)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    integer, intent(in) :: row, count, card
    logical, intent(in) :: more
    associate (k => deck%table%keyword(row))
      if (count < k%required .or. (k%repeat_from > 0 .and. card < k%cards .and. count > 0 &
          .and. card >= k%repeat_from)) &
          call add_problem(deck%problems, render(deck%file(cursor%file)%path//':'// &
          to_text(cursor%line + merge(0, 1, more)), 0, 0, '*'//trim(k%name)// &
          ' ends too early: expected '//to_text(max(k%required, k%cards))//' cards, found '// &
          to_text(count), '', 'a card may be blank, but it must be there'))
    end associate
  end subroutine check_count

  subroutine too_many_cards(deck, cursor, row)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    integer, intent(in) :: row
    call add_problem(deck%problems, render(deck%file(cursor%file)%path//':'// &
        to_text(cursor%line), 0, 0, '*'//trim(deck%table%keyword(row)%name)// &
        ': one card too many', deck%file(cursor%file)%text(cursor%first:cursor%last), &
        'this keyword has at most '//to_text(deck%table%keyword(row)%cards)//' cards'))
  end subroutine too_many_cards

  !> Adds a record and converts its fields.
  subroutine parse_card(deck, cursor, row, card, parameters)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    integer, intent(in) :: row, card
    type(parameters_t), intent(in) :: parameters
    integer :: f, first, last, fields
    logical :: comma
    fields = deck%table%keyword(row)%card(card)%fields
    call add_record(deck, cursor, card, fields)
    associate (line => deck%file(cursor%file)%text(cursor%first:cursor%last), &
        c => deck%table%keyword(row)%card(card), long => deck%block(deck%blocks)%long)
      comma = index(line, ',') > 0 .and. c%field(1)%kind /= 'T'
      call check_line(deck, line, c, comma, long)
      do f = 1, fields
        call slice_field(line, c%field(f), f, comma, long, first, last)
        call parse_field(deck, line(min(first, len(line) + 1):min(last, len(line))), &
            c%field(f), f, parameters)
      end do
    end associate
  end subroutine parse_card

  subroutine add_record(deck, cursor, card, fields)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    integer, intent(in) :: card, fields
    type(record_t), allocatable :: longer(:)
    real(wp), allocatable :: more_values(:)
    logical, allocatable :: more_given(:)
    if (deck%records == size(deck%record)) then
      allocate (longer(2*deck%records))
      longer(1:deck%records) = deck%record
      call move_alloc(longer, deck%record)
    end if
    if (deck%values + fields > size(deck%value)) then
      allocate (more_values(2*size(deck%value)), more_given(2*size(deck%value)))
      more_values(1:deck%values) = deck%value(1:deck%values)
      more_given(1:deck%values) = deck%given(1:deck%values)
      call move_alloc(more_values, deck%value)
      call move_alloc(more_given, deck%given)
    end if
    deck%records = deck%records + 1
    deck%record(deck%records) = record_t(block=deck%blocks, card=card, start=deck%values, &
        file=cursor%file, line=cursor%line, first=cursor%first, last=cursor%last)
    deck%values = deck%values + fields
  end subroutine add_record

  !> What concerns the line as a whole: tabs, bytes that are no ASCII, text beyond the last
  !> field, numbers that straddle a border between two fields.
  subroutine check_line(deck, line, card, comma, long)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: line
    type(card_t), intent(in) :: card
    logical, intent(in) :: comma, long
    integer :: f, last, k, commas
    if (card%field(1)%kind == 'T') return
    do k = 1, len(line)
      if (line(k:k) >= ' ' .and. line(k:k) <= '~') cycle
      call deck%complain(deck%records, '', trim(merge('a tab in a data card              ', &
          'a byte that is not ASCII in a card', line(k:k) == achar(9))), &
          'expand tabs to blanks; use plain ASCII')
      return
    end do
    if (comma) then
      commas = count([(line(k:k) == ',', k=1, len(line))])
      if (commas >= card%fields) then
        if (len_trim(line(index(line, ',', back=.true.) + 1:)) > 0 .or. commas > card%fields) &
            call deck%complain(deck%records, '', 'expected at most '//to_text(card%fields)// &
            ' comma-separated fields, found '//to_text(commas + 1))
      end if
      return
    end if
    last = card%field(card%fields)%first + card%field(card%fields)%width - 1
    if (long) last = 20*card%fields
    if (len_trim(line) > last) call deck%complain(deck%records, '', 'text beyond column '// &
        to_text(last)//', where the last field ends', 'a field may have slipped to the right')
    do f = 1, card%fields - 1
      last = merge(20*f, card%field(f + 1)%first - 1, long)
      if (last < len(line)) &
          call check_border(deck, line, card%field(f), card%field(f + 1), last, long)
    end do
  end subroutine check_line

  !> A run of characters across a border is fine only if one side fills its field.
  subroutine check_border(deck, line, left, right, border, long)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: line
    type(field_t), intent(in) :: left, right
    integer, intent(in) :: border
    logical, intent(in) :: long
    integer :: left_width, right_width
    left_width = merge(20, left%width, long)
    right_width = merge(20, right%width, long)
    if (line(border:border) == ' ' .or. line(border + 1:border + 1) == ' ') return
    if (index(line(border - left_width + 1:border), ' ') == 0) return
    if (border + right_width <= len(line)) then
      if (index(line(border + 1:border + right_width), ' ') == 0) return
    end if
    call deck%complain(deck%records, trim(right%name), &
        'a value crosses the border between columns '//to_text(border)//' and '// &
        to_text(border + 1), 'fields '//trim(left%name)//' and '//trim(right%name)// &
        ' meet there; the card looks shifted')
  end subroutine check_border

  !> Converts one field: default where blank, parameters replaced, range and class checked.
  subroutine parse_field(deck, raw, field, f, parameters)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: raw
    type(field_t), intent(in) :: field
    integer, intent(in) :: f
    type(parameters_t), intent(in) :: parameters
    character(:), allocatable :: text
    real(wp) :: value
    logical :: ok, given
    integer :: k
    k = deck%record(deck%records)%start + f
    text = trim(adjustl(raw))
    given = len(text) > 0
    if (given .and. field%kind /= 'T') then
      if (scan(text(1:min(2, len(text))), '&') > 0) &
          call substitute(deck, field, parameters, text)
      if (len(text) == 0) return
    end if
    deck%given(k) = given
    deck%value(k) = 0.0_wp
    if (.not. given) then
      if (field%required) call deck%complain(deck%records, trim(field%name), 'expected '// &
          trim(kind_text(field%kind))//', found nothing', 'this field has no default')
      text = trim(field%default)
      if (len(text) == 0) return
    end if
    call convert(deck, text, field, value, ok)
    if (.not. ok) then
      call deck%complain(deck%records, trim(field%name), 'expected '// &
          trim(kind_text(field%kind))//', found "'//raw//'"', embedded_hint(text))
      return
    end if
    if (field%zero_is_default .and. given .and. .not. abs(value) > 0.0_wp) then
      deck%given(k) = .false.
      call convert(deck, trim(field%default), field, value, ok)
    end if
    deck%value(k) = value
    if (given) call check_value(deck, field, text, value)
  end subroutine parse_field

  pure function embedded_hint(text) result(hint)
    character(*), intent(in) :: text
    character(:), allocatable :: hint
    hint = ''
    if (index(text, ' ') > 0) &
        hint = 'a blank inside a number: a field may have slipped across its border'
  end function embedded_hint

  pure function kind_text(kind) result(name)
    character, intent(in) :: kind
    character(16) :: name
    select case (kind)
    case ('I')
      name = 'an integer'
    case ('R')
      name = 'a real number'
    case default
      name = 'a word'
    end select
  end function kind_text

  subroutine convert(deck, text, field, value, ok)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: text
    type(field_t), intent(in) :: field
    real(wp), intent(out) :: value
    logical, intent(out) :: ok
    integer :: number
    ok = .true.
    value = 0.0_wp
    select case (field%kind)
    case ('I')
      call scan_integer(text, number, ok)
      value = real(number, wp)
    case ('R')
      if (len(text) > 0) call scan_real(text, value, ok)
    case ('W')
      call keep_text(deck, upper(text), number)
      value = real(number, wp)
    case default
      call keep_text(deck, text, number)
      value = real(number, wp)
    end select
  end subroutine convert

  subroutine keep_text(deck, text, row)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: text
    integer, intent(out) :: row
    character(80), allocatable :: longer(:)
    if (deck%texts == size(deck%text)) then
      allocate (longer(2*deck%texts))
      longer(1:deck%texts) = deck%text
      call move_alloc(longer, deck%text)
    end if
    deck%texts = deck%texts + 1
    row = deck%texts
    deck%text(row) = text
  end subroutine keep_text

  !> Replaces &name or -&name by the value of the parameter; text becomes empty after a problem.
  subroutine substitute(deck, field, parameters, text)
    type(deck_t), intent(inout) :: deck
    type(field_t), intent(in) :: field
    type(parameters_t), intent(in) :: parameters
    character(:), allocatable, intent(inout) :: text
    integer :: mark, row
    character(:), allocatable :: value
    mark = index(text, '&')
    row = find_parameter(parameters, text(mark + 1:))
    if (row == 0) then
      call deck%complain(deck%records, trim(field%name), 'undefined parameter "'// &
          text(mark:)//'"', 'define it with *PARAMETER before its use')
      text = ''
    else if (mark == 2 .and. text(1:1) == '-') then
      value = trim(parameters%text(row))
      if (value(1:1) == '-') then
        text = value(2:)
      else if (value(1:1) == '+') then
        text = '-'//value(2:)
      else
        text = '-'//value
      end if
    else
      text = trim(parameters%text(row))
    end if
  end subroutine substitute

  !> Range and class of a value that was given.
  subroutine check_value(deck, field, text, value)
    type(deck_t), intent(inout) :: deck
    type(field_t), intent(in) :: field
    character(*), intent(in) :: text
    real(wp), intent(in) :: value
    real(wp) :: default
    logical :: ok
    if (full(deck%problems)) return
    if (field%kind == 'I' .or. field%kind == 'R') then
      ok = value >= field%low .and. value <= field%high
      if (field%low_open) ok = ok .and. value > field%low
      if (field%high_open) ok = ok .and. value < field%high
      if (.not. ok) call deck%complain(deck%records, trim(field%name), 'expected '// &
          range_text(field)//', found "'//text//'"')
    end if
    if (field%class /= field_fixed .and. field%class /= field_tuning) return
    ok = upper(text) == field%default
    if (field%kind /= 'W') then
      call convert(deck, trim(field%default), field, default, ok)
      ok = ok .and. .not. abs(value - default) > 0.0_wp
      if (len_trim(field%default) == 0) ok = .not. abs(value) > 0.0_wp
    end if
    if (ok) return
    if (field%class == field_tuning) then
      call add_note(deck%problems, '*'// &
          trim(deck%table%keyword(deck%block(deck%blocks)%keyword)%name)//' '// &
          trim(field%name)//' tunes another method and has no effect')
    else
      call deck%complain(deck%records, trim(field%name), 'expected blank or the default "'// &
          trim(field%default)//'", found "'//text//'"', &
          'what this field asks for is not available in this version')
    end if
  end subroutine check_value

  pure function range_text(field) result(text)
    type(field_t), intent(in) :: field
    character(:), allocatable :: text
    text = trim(kind_text(field%kind))
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

end module deck_card
