! SPDX-License-Identifier: BSD-3-Clause
!> The deck as read: blocks of cards with their values, and where each card stands, so that a
!> later check can still point at its line. Values of all cards lie in one array; ids are exact
!> in it.
module deck_data
  use base_kinds, only: wp
  use base_strings, only: to_text
  use deck_problems, only: problems_t, add_problem, render, full
  use deck_source, only: source_file_t
  use deck_table, only: table_t, field_t, field_index
  implicit none
  private

  type, public :: block_t
    integer :: keyword = 0          !< row of the table
    logical :: long = .false.
    integer :: first = 1            !< records first..last
    integer :: last = 0
    integer :: title = 0            !< text of the _TITLE or _ID card; 0 = none
    integer :: id = 0               !< id of the _ID card; 0 = none
    character(64) :: written = ''   !< the name as it stood
  end type block_t

  type, public :: record_t
    integer :: block = 0
    integer :: card = 0
    integer :: start = 1            !< its values are value(start+1 ...)
    integer :: file = 0
    integer :: line = 0
    integer :: first = 1            !< text(first:last) of the file
    integer :: last = 0
  end type record_t

  type, public :: deck_t
    type(table_t) :: table
    integer :: files = 0
    type(source_file_t), allocatable :: file(:)
    integer :: blocks = 0
    type(block_t), allocatable :: block(:)
    integer :: records = 0
    type(record_t), allocatable :: record(:)
    integer :: values = 0
    real(wp), allocatable :: value(:)      !< numbers; for words and texts the row in `text`
    logical, allocatable :: given(:)       !< false where the field was blank
    integer :: texts = 0
    character(80), allocatable :: text(:)
    type(problems_t) :: problems
  contains
    procedure :: real => deck_real
    procedure :: integer => deck_integer
    procedure :: word => deck_word
    procedure :: is_given => deck_given
    procedure :: next_block => deck_next_block
    procedure :: complain => deck_complain
    procedure :: place => deck_place
  end type deck_t

  public :: slice_field

contains

  !> Position in `value` of a field of a record, by name.
  pure integer function locate(deck, record, name)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record
    character(*), intent(in) :: name
    associate (r => deck%record(record))
      locate = r%start &
          + field_index(deck%table%keyword(deck%block(r%block)%keyword)%card(r%card), name)
    end associate
  end function locate

  !> A real field by name, its default where blank.
  pure real(wp) function deck_real(this, record, name)
    class(deck_t), intent(in) :: this
    integer, intent(in) :: record
    character(*), intent(in) :: name
    deck_real = this%value(locate(this, record, name))
  end function deck_real

  !> An integer field by name.
  pure integer function deck_integer(this, record, name)
    class(deck_t), intent(in) :: this
    integer, intent(in) :: record
    character(*), intent(in) :: name
    deck_integer = nint(this%value(locate(this, record, name)))
  end function deck_integer

  !> A word or text field by name.
  pure function deck_word(this, record, name) result(word)
    class(deck_t), intent(in) :: this
    integer, intent(in) :: record
    character(*), intent(in) :: name
    character(:), allocatable :: word
    integer :: k
    k = nint(this%value(locate(this, record, name)))
    word = ''
    if (k > 0) word = trim(this%text(k))
  end function deck_word

  !> True where the field was not blank.
  pure logical function deck_given(this, record, name)
    class(deck_t), intent(in) :: this
    integer, intent(in) :: record
    character(*), intent(in) :: name
    deck_given = this%given(locate(this, record, name))
  end function deck_given

  !> Next block of a keyword after block `after` (0 to start); 0 when there is none.
  pure integer function deck_next_block(this, name, after)
    class(deck_t), intent(in) :: this
    character(*), intent(in) :: name
    integer, intent(in) :: after
    do deck_next_block = after + 1, this%blocks
      if (this%table%keyword(this%block(deck_next_block)%keyword)%name == name) return
    end do
    deck_next_block = 0
  end function deck_next_block

  !> "file:line" of a record.
  pure function deck_place(this, record) result(place)
    class(deck_t), intent(in) :: this
    integer, intent(in) :: record
    character(:), allocatable :: place
    associate (r => this%record(record))
      place = this%file(r%file)%path//':'//to_text(r%line)
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
    first = 0
    last = 0
    advice = ''
    if (present(hint)) advice = hint
    associate (r => this%record(record))
      associate (keyword => this%table%keyword(this%block(r%block)%keyword), &
          line => this%file(r%file)%text(r%first:r%last))
        head = '*'//trim(keyword%name)//' card '//to_text(r%card)
        f = field_index(keyword%card(r%card), name)
        if (f > 0) then
          head = head//', field '//name
          call slice_field(line, keyword%card(r%card)%field(f), f, index(line, ',') > 0, &
              this%block(r%block)%long, first, last)
        end if
        if (this%file(r%file)%parent > 0) advice = join_hint(advice, 'included from '// &
            this%file(this%file(r%file)%parent)%path//':'// &
            to_text(this%file(r%file)%parent_line))
        call add_problem(this%problems, &
            render(this%place(record), first, last, head//': '//what, line, advice))
      end associate
    end associate
  end subroutine deck_complain

  pure function join_hint(a, b) result(text)
    character(*), intent(in) :: a
    character(*), intent(in) :: b
    character(:), allocatable :: text
    text = b
    if (len(a) > 0) text = a//'; '//b
  end function join_hint

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
    if (comma .and. field%kind /= 'T') then
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
      last = merge(len(line), first + part - 2, part == 0)
    else if (long .and. field%kind /= 'T') then
      first = 20*(f - 1) + 1
      last = 20*f
    else
      first = field%first
      last = field%first + field%width - 1
    end if
  end subroutine slice_field

end module deck_data
