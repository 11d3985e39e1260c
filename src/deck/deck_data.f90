! SPDX-License-Identifier: BSD-3-Clause
!> The deck as read: blocks of cards, and where each card stands. Fields are converted when they
!> are asked for, from the text of the deck, so that a million nodes cost one short record each,
!> and a later check can still point at its line.
module deck_data
  use base_kinds, only: wp
  use base_strings, only: to_text, upper
  use deck_number, only: scan_integer, scan_real
  use deck_problems, only: problems_t, line_t, add_problem, is_told, render, full
  use deck_source, only: source_file_t
  use deck_table, only: table_t, field_t, field_index, find_keyword
  implicit none
  private

  !> The cards under one keyword; they always lie in one file.
  type, public :: block_t
    integer :: keyword = 0          !< row of the table
    logical :: long = .false.
    integer :: first = 1            !< records first..last
    integer :: last = 0
    integer :: file = 0
    integer :: line = 0
    character(64) :: written = ''   !< the name as it stood
  end type block_t

  type, public :: record_t
    integer :: block = 0
    integer :: card = 0             !< which card of the keyword; 0 = that of _TITLE or _ID
    integer :: line = 0
    integer :: first = 1            !< text(first:last) of the file
    integer :: last = 0
    logical :: comma = .false.      !< commas separate its fields
  end type record_t

  !> A name of *PARAMETER.
  type, public :: parameter_t
    character(10) :: name = ''
    character(24) :: text = ''
    character :: kind = ''          !< R, I or C
    integer :: file = 0             !< 0 = visible in all files that are read after it
    integer :: line = 0             !< of its definition; else: below it in the file and in
                                    !< what the file includes there
    character(:), allocatable :: place
  end type parameter_t

  type, public :: deck_t
    type(table_t) :: table
    integer :: files = 0
    type(source_file_t), allocatable :: file(:)
    integer :: blocks = 0
    type(block_t), allocatable :: block(:)
    integer :: records = 0
    type(record_t), allocatable :: record(:)
    integer :: parameters = 0
    type(parameter_t), allocatable :: parameter(:)
    type(line_t), allocatable :: folder(:)   !< where else included files are looked for
    logical :: in_space = .false.            !< it has elements in space
    type(problems_t) :: problems
  contains
    procedure :: real => deck_real
    procedure :: integer => deck_integer
    procedure :: word => deck_word
    procedure :: is_given => deck_given
    procedure :: number_at => deck_number_at
    procedure :: text_at => deck_text_at
    procedure :: field_name => deck_field_name
    procedure :: next => deck_next
    procedure :: follow => deck_follow
    procedure :: complain => deck_complain
    procedure :: complain_at => deck_complain_at
    procedure :: place => deck_place
  end type deck_t

  public :: slice_field, field_span, find_parameter, parameter_of, convert

contains

  !> Row of the parameter that a name means at a line of a file, 0 if it is not defined (yet).
  !> One of *PARAMETER_LOCAL comes before one of all files, the inner before the outer.
  pure integer function find_parameter(deck, name, file, line) result(row)
    type(deck_t), intent(in) :: deck
    character(*), intent(in) :: name
    integer, intent(in) :: file, line
    character(len(name)) :: wanted
    integer :: k
    wanted = upper(name)
    row = 0
    do k = deck%parameters, 1, -1
      associate (p => deck%parameter(k))
        if (p%name /= wanted) cycle
        if (p%file == 0) row = k
        if (p%file == 0 .or. .not. is_visible(deck, p, file, line)) cycle
      end associate
      row = k
      return
    end do
  end function find_parameter

  !> Is a parameter of *PARAMETER_LOCAL seen at a line of a file: below its own line, or in what
  !> its file includes there?
  pure logical function is_visible(deck, parameter, file, line)
    type(deck_t), intent(in) :: deck
    type(parameter_t), intent(in) :: parameter
    integer, intent(in) :: file, line
    integer :: f, at
    is_visible = .false.
    f = file
    at = line
    do while (f > 0 .and. .not. is_visible)
      is_visible = f == parameter%file .and. parameter%line <= at
      at = deck%file(f)%parent_line
      f = deck%file(f)%parent
    end do
  end function is_visible

  !> The same for a name on a card.
  pure integer function parameter_of(deck, record, name)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record
    character(*), intent(in) :: name
    parameter_of = find_parameter(deck, name, deck%block(deck%record(record)%block)%file, &
        deck%record(record)%line)
  end function parameter_of

  !> Number of a field of a record by its name.
  pure integer function locate(deck, record, name)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record
    character(*), intent(in) :: name
    associate (r => deck%record(record))
      locate = field_index(deck%table%keyword(deck%block(r%block)%keyword)%card(r%card), name)
    end associate
  end function locate

  !> Columns first:last of a field on a line: fixed columns (long: 20 each), or the f-th comma
  !> part.
  pure subroutine slice_field(line, field, f, comma, long, first, last)
    character(*), intent(in) :: line
    type(field_t), intent(in) :: field
    integer, intent(in) :: f
    logical, intent(in) :: comma
    logical, intent(in) :: long
    integer, intent(out) :: first
    integer, intent(out) :: last
    integer :: k, part
    if (comma .and. (field%kind /= 'T' .or. f > 1)) then
      first = 1
      do k = 2, f
        part = index(line(first:), ',')
        if (part == 0) then
          first = len(line) + 1
          exit
        end if
        first = first + part
      end do
      part = index(line(first:), ',')
      last = merge(len(line), first + part - 2, part == 0 .or. field%kind == 'T')
    else if (long .and. (field%kind /= 'T' .or. f > 1)) then
      first = 20*(f - 1) + 1
      last = merge(first + field%width - 1, 20*f, field%kind == 'T')
    else
      first = field%first
      last = field%first + field%width - 1
    end if
  end subroutine slice_field

  !> The characters first:last of a field on its line, no blanks around; last < first: blank.
  !> (Compared by their codes: the compiler takes a comparison with a blank for LEN_TRIM.)
  pure subroutine field_span(line, field, f, comma, long, first, last)
    character(*), intent(in) :: line
    type(field_t), intent(in) :: field
    integer, intent(in) :: f
    logical, intent(in) :: comma
    logical, intent(in) :: long
    integer, intent(out) :: first
    integer, intent(out) :: last
    integer, parameter :: blank = iachar(' ')
    call slice_field(line, field, f, comma, long, first, last)
    last = min(last, len(line))
    do while (first <= last)
      if (iachar(line(first:first)) /= blank) exit
      first = first + 1
    end do
    do while (last >= first)
      if (iachar(line(last:last)) /= blank) exit
      last = last - 1
    end do
  end subroutine field_span

  !> Text of a number to its value.
  pure subroutine convert(text, kind, value, ok)
    character(*), intent(in) :: text
    character, intent(in) :: kind
    real(wp), intent(out) :: value
    logical, intent(out) :: ok
    integer :: number
    if (kind == 'I') then
      call scan_integer(text, number, ok)
      value = real(number, wp)
      if (.not. ok) call scan_whole(text, value, ok)
    else
      call scan_real(text, value, ok)
    end if
  end subroutine convert

  !> A real number that is whole and fits an integer ("4.0", as some programs write).
  pure subroutine scan_whole(text, value, ok)
    character(*), intent(in) :: text
    real(wp), intent(out) :: value
    logical, intent(out) :: ok
    call scan_real(text, value, ok)
    if (ok) ok = scan(text, '.') > 0 .and. abs(value) <= real(huge(1), wp)
    if (ok) ok = .not. abs(value - anint(value)) > 0.0_wp
  end subroutine scan_whole

  !> Where field f of a record stands: row and card of the table, characters first:last of the
  !> text of its file without blanks around (last < first: blank).
  pure subroutine find_field(deck, record, f, row, card, first, last)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record
    integer, intent(in) :: f
    integer, intent(out) :: row, card, first, last
    associate (r => deck%record(record))
      associate (block => deck%block(r%block))
        row = block%keyword
        card = r%card
        call field_span(deck%file(block%file)%text(r%first:r%last), &
            deck%table%keyword(row)%card(card)%field(f), f, r%comma, block%long, first, last)
        first = first + r%first - 1
        last = last + r%first - 1
      end associate
    end associate
  end subroutine find_field

  !> Number in field f of a record: its parameter, or its default where blank.
  pure real(wp) function deck_number_at(this, record, f) result(value)
    class(deck_t), intent(in) :: this
    integer, intent(in) :: record
    integer, intent(in) :: f
    integer :: row, card, first, last
    logical :: ok
    call find_field(this, record, f, row, card, first, last)
    ok = last >= first
    value = 0.0_wp
    associate (field => this%table%keyword(row)%card(card)%field(f), &
        text => this%file(this%block(this%record(record)%block)%file)%text)
      if (ok) then
        if (is_reference(text(first:last))) then
          call convert(parameter_text(this, record, text(first:last)), field%kind, value, ok)
        else
          call convert(text(first:last), field%kind, value, ok)
        end if
        if (field%zero_is_default) ok = ok .and. abs(value) > 0.0_wp
      end if
      if (ok .or. len_trim(field%default) == 0) return
      call convert(trim(field%default), field%kind, value, ok)
    end associate
  end function deck_number_at

  !> Is the text of a field "&name" or "-&name" (or the like, which has been refused)?
  pure logical function is_reference(text)
    character(*), intent(in) :: text
    is_reference = text(1:1) == '&'
    if (len(text) > 1) is_reference = is_reference .or. text(2:2) == '&'
  end function is_reference

  !> "&name" or "-&name" as text; empty when there is no such parameter.
  pure function parameter_text(deck, record, reference) result(text)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record
    character(*), intent(in) :: reference
    character(:), allocatable :: text
    integer :: row, mark
    mark = index(reference, '&')
    row = parameter_of(deck, record, reference(mark + 1:))
    text = ''
    if (row == 0) return
    text = trim(deck%parameter(row)%text)
    if (mark /= 2 .or. reference(1:1) /= '-' .or. len(text) == 0) return
    if (text(1:1) == '-') then
      text = text(2:)
    else if (text(1:1) == '+') then
      text = '-'//text(2:)
    else
      text = '-'//text
    end if
  end function parameter_text

  !> Text of field f of a record: its parameter, or its default where blank; words in upper
  !> case.
  pure function deck_text_at(this, record, f) result(text)
    class(deck_t), intent(in) :: this
    integer, intent(in) :: record
    integer, intent(in) :: f
    character(:), allocatable :: text
    integer :: row, card, first, last
    call find_field(this, record, f, row, card, first, last)
    associate (field => this%table%keyword(row)%card(card)%field(f), &
        whole => this%file(this%block(this%record(record)%block)%file)%text)
      if (last < first) then
        text = trim(field%default)
      else if (field%kind /= 'T' .and. is_reference(whole(first:last))) then
        text = parameter_text(this, record, whole(first:last))
      else
        text = whole(first:last)
      end if
      if (field%kind == 'W') text = upper(text)
    end associate
  end function deck_text_at

  !> Name of field f of a record.
  pure function deck_field_name(this, record, f) result(name)
    class(deck_t), intent(in) :: this
    integer, intent(in) :: record, f
    character(:), allocatable :: name
    associate (r => this%record(record))
      name = trim(this%table%keyword(this%block(r%block)%keyword)%card(r%card)%field(f)%name)
    end associate
  end function deck_field_name

  !> A real field by name, its default where blank.
  pure real(wp) function deck_real(this, record, name)
    class(deck_t), intent(in) :: this
    integer, intent(in) :: record
    character(*), intent(in) :: name
    deck_real = this%number_at(record, locate(this, record, name))
  end function deck_real

  !> An integer field by name.
  pure integer function deck_integer(this, record, name)
    class(deck_t), intent(in) :: this
    integer, intent(in) :: record
    character(*), intent(in) :: name
    deck_integer = nint(this%number_at(record, locate(this, record, name)))
  end function deck_integer

  !> A word or text field by name.
  pure function deck_word(this, record, name) result(word)
    class(deck_t), intent(in) :: this
    integer, intent(in) :: record
    character(*), intent(in) :: name
    character(:), allocatable :: word
    word = this%text_at(record, locate(this, record, name))
  end function deck_word

  !> True where the field was not blank (nor a zero that means the default).
  pure logical function deck_given(this, record, name)
    class(deck_t), intent(in) :: this
    integer, intent(in) :: record
    character(*), intent(in) :: name
    integer :: f, row, card, first, last
    real(wp) :: value
    logical :: ok
    f = locate(this, record, name)
    call find_field(this, record, f, row, card, first, last)
    deck_given = last >= first
    associate (field => this%table%keyword(row)%card(card)%field(f))
      if (.not. deck_given .or. .not. field%zero_is_default) return
      call convert(this%text_at(record, f), field%kind, value, ok)
      deck_given = .not. ok .or. abs(value) > 0.0_wp
    end associate
  end function deck_given

  !> Next record that is this card of this keyword, after a record of the keyword (0: the first
  !> one); 0 when there is none.
  pure integer function deck_next(this, name, card, after)
    class(deck_t), intent(in) :: this
    character(*), intent(in) :: name
    integer, intent(in) :: card
    integer, intent(in) :: after
    integer :: b, row
    b = 1
    if (after > 0) then
      b = this%record(after)%block
      do deck_next = after + 1, this%block(b)%last
        if (this%record(deck_next)%card == card) return
      end do
      b = b + 1
    end if
    row = find_keyword(this%table, name)
    do b = b, this%blocks
      if (this%table%keyword(this%block(b)%keyword)%canonical_row /= row) cycle
      do deck_next = this%block(b)%first, this%block(b)%last
        if (this%record(deck_next)%card == card) return
      end do
    end do
    deck_next = 0
  end function deck_next

  !> The record of another card in the same set of cards as `record` (a later one); 0 when it is
  !> not there.
  pure integer function deck_follow(this, record, card)
    class(deck_t), intent(in) :: this
    integer, intent(in) :: record
    integer, intent(in) :: card
    do deck_follow = record + 1, this%block(this%record(record)%block)%last
      if (this%record(deck_follow)%card == card) return
      if (this%record(deck_follow)%card <= this%record(record)%card) exit
    end do
    deck_follow = 0
  end function deck_follow

  !> "file:line" of a record.
  pure function deck_place(this, record) result(place)
    class(deck_t), intent(in) :: this
    integer, intent(in) :: record
    character(:), allocatable :: place
    associate (r => this%record(record))
      place = this%file(this%block(r%block)%file)%path//':'//to_text(r%line)
    end associate
  end function deck_place

  !> Adds a problem at a field of a record (name empty: at the whole card).
  subroutine deck_complain(this, record, name, what, hint)
    class(deck_t), intent(inout) :: this
    integer, intent(in) :: record
    character(*), intent(in) :: name
    character(*), intent(in) :: what
    character(*), intent(in), optional :: hint
    character(:), allocatable :: head, advice
    integer :: f, first, last
    if (full(this%problems)) return
    if (is_told(this%problems, this%place(record), what)) return
    first = 0
    last = 0
    advice = ''
    if (present(hint)) advice = hint
    associate (r => this%record(record))
      associate (keyword => this%table%keyword(this%block(r%block)%keyword), &
          line => this%file(this%block(r%block)%file)%text(r%first:r%last))
        head = '*'//trim(keyword%name)//' card '// &
            to_text(record - this%block(r%block)%first + 1)
        f = field_index(keyword%card(r%card), name)
        if (f > 0) then
          head = head//', field '//name
          call slice_field(line, keyword%card(r%card)%field(f), f, r%comma, &
              this%block(r%block)%long, first, last)
        end if
        call this%complain_at(this%block(r%block)%file, r%line, first, last, head//': '//what, &
            line, advice)
      end associate
    end associate
  end subroutine deck_complain

  !> Adds a problem at columns first:last (0: none) of a line of a file.
  subroutine deck_complain_at(this, file, line, first, last, what, card, hint)
    class(deck_t), intent(inout) :: this
    integer, intent(in) :: file
    integer, intent(in) :: line
    integer, intent(in) :: first
    integer, intent(in) :: last
    character(*), intent(in) :: what
    character(*), intent(in) :: card
    character(*), intent(in) :: hint
    if (full(this%problems)) return
    call add_problem(this%problems, render(this%file(file)%path//':'//to_text(line), first, &
        last, what, card, join_hints(hint, include_chain(this, file))))
  end subroutine deck_complain_at

  !> "included from a.k:3, from b.k:7"; empty for the main file.
  pure function include_chain(deck, file) result(text)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: file
    character(:), allocatable :: text
    integer :: k
    text = ''
    k = file
    do while (deck%file(k)%parent > 0)
      if (len(text) > 0) text = text//','
      if (len(text) == 0) text = 'included'
      text = text//' from '//deck%file(deck%file(k)%parent)%path//':'// &
          to_text(deck%file(k)%parent_line)
      k = deck%file(k)%parent
    end do
  end function include_chain

  pure function join_hints(a, b) result(text)
    character(*), intent(in) :: a
    character(*), intent(in) :: b
    character(:), allocatable :: text
    text = a//b
    if (len(a) > 0 .and. len(b) > 0) text = a//'; '//b
  end function join_hints

end module deck_data
