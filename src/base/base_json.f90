! SPDX-License-Identifier: BSD-3-Clause
!> JSON (RFC 8259) built member by member, one a line, in memory.
module base_json
  use base_format, only: real_width, put_one_real, put_long_digits => put_long
  use base_kinds, only: wp, i8
  implicit none
  private
  integer, parameter :: quote = iachar('"'), backslash = iachar('\')

  !> An object that is being written. That names differ within an object is the caller's care.
  type, public :: json_t
    private
    character(:), allocatable :: buffer
    integer :: used = 0
    integer :: depth = 0
    logical :: begun = .false.   !< the open object or list has a member already
  contains
    procedure :: open => json_open
    procedure :: close => json_close
    procedure :: text => json_text
    procedure :: put_null => json_null
    generic :: put => put_text, put_integer, put_long, put_real, put_logical
    procedure, private :: put_text, put_integer, put_long, put_real, put_logical
  end type json_t

contains

  !> Begins an object '{' or a list '[', as a member of that name; without a name as an item of
  !> a list, or as the whole.
  subroutine json_open(this, bracket, name)
    class(json_t), intent(inout) :: this
    character, intent(in) :: bracket
    character(*), intent(in), optional :: name
    call begin_member(this, name)
    call append(this, bracket)
    this%depth = this%depth + 1
    this%begun = .false.
  end subroutine json_open

  !> Ends what was begun last, with '}' or ']'.
  subroutine json_close(this, bracket)
    class(json_t), intent(inout) :: this
    character, intent(in) :: bracket
    this%depth = this%depth - 1
    if (this%begun) call begin_line(this)
    call append(this, bracket)
    this%begun = .true.
  end subroutine json_close

  !> All that was written.
  pure function json_text(this) result(text)
    class(json_t), intent(in) :: this
    character(:), allocatable :: text
    text = ''
    if (allocated(this%buffer)) text = this%buffer(1:this%used)
  end function json_text

  !> A text, escaped.
  subroutine put_text(this, value, name)
    class(json_t), intent(inout) :: this
    character(*), intent(in) :: value
    character(*), intent(in), optional :: name
    call begin_member(this, name)
    call append_quoted(this, value)
  end subroutine put_text

  subroutine put_integer(this, value, name)
    class(json_t), intent(inout) :: this
    integer, intent(in) :: value
    character(*), intent(in), optional :: name
    call this%put_long(int(value, i8), name)
  end subroutine put_integer

  subroutine put_long(this, value, name)
    class(json_t), intent(inout) :: this
    integer(i8), intent(in) :: value
    character(*), intent(in), optional :: name
    character(20) :: digits
    call begin_member(this, name)
    call put_long_digits(value, digits)
    call append(this, digits(verify(digits, ' '):))
  end subroutine put_long

  !> All digits, so that it reads back equal; null where the number is none or infinite, for
  !> which JSON has no word.
  subroutine put_real(this, value, name)
    class(json_t), intent(inout) :: this
    real(wp), intent(in) :: value
    character(*), intent(in), optional :: name
    character(real_width) :: digits
    call begin_member(this, name)
    if (.not. abs(value) <= huge(value)) then
      call append(this, 'null')
    else if (abs(value) <= 0.0_wp) then
      call append(this, '0.0')
    else
      call put_one_real(value, digits)
      call append(this, digits(verify(digits, ' '):))
    end if
  end subroutine put_real

  subroutine put_logical(this, value, name)
    class(json_t), intent(inout) :: this
    logical, intent(in) :: value
    character(*), intent(in), optional :: name
    call begin_member(this, name)
    call append(this, trim(merge('true ', 'false', value)))
  end subroutine put_logical

  !> null: what is unknown, or what the scene has not.
  subroutine json_null(this, name)
    class(json_t), intent(inout) :: this
    character(*), intent(in), optional :: name
    call begin_member(this, name)
    call append(this, 'null')
  end subroutine json_null

  !> A comma after the member before, a line of its own, the name.
  subroutine begin_member(this, name)
    class(json_t), intent(inout) :: this
    character(*), intent(in), optional :: name
    if (this%begun) call append(this, ',')
    if (this%depth > 0) call begin_line(this)
    this%begun = .true.
    if (.not. present(name)) return
    call append_quoted(this, name)
    call append(this, ': ')
  end subroutine begin_member

  subroutine begin_line(this)
    class(json_t), intent(inout) :: this
    character(*), parameter :: margin = new_line('a')//repeat(' ', 32)
    call append(this, margin(1:min(1 + 2*this%depth, len(margin))))
  end subroutine begin_line

  subroutine append(this, text)
    class(json_t), intent(inout) :: this
    character(*), intent(in) :: text
    call make_room(this, len(text))
    this%buffer(this%used + 1:this%used + len(text)) = text
    this%used = this%used + len(text)
  end subroutine append

  !> Room for n more characters.
  subroutine make_room(this, n)
    class(json_t), intent(inout) :: this
    integer, intent(in) :: n
    integer, parameter :: first_size = 8192
    character(:), allocatable :: longer
    if (.not. allocated(this%buffer)) allocate (character(first_size + n) :: this%buffer)
    if (this%used + n <= len(this%buffer)) return
    allocate (character(2*(this%used + n)) :: longer)
    longer(1:this%used) = this%buffer(1:this%used)
    call move_alloc(longer, this%buffer)
  end subroutine make_room

  !> A text with its quotation marks. JSON is UTF-8: a byte that is no part of it (a title in
  !> another code) is taken as the character of that number in Latin-1.
  subroutine append_quoted(this, text)
    class(json_t), intent(inout) :: this
    character(*), intent(in) :: text
    integer :: k, n
    call make_room(this, 6*len(text) + 2)
    associate (buffer => this%buffer, used => this%used)
      used = used + 1
      buffer(used:used) = '"'
      k = 1
      do while (k <= len(text))
        n = plain_length(text(k:))
        if (n > 0) then
          buffer(used + 1:used + n) = text(k:k + n - 1)
          used = used + n
          k = k + n
        else
          call put_escaped(text(k:k), buffer(used + 1:used + 6), n)
          used = used + n
          k = k + 1
        end if
      end do
      used = used + 1
      buffer(used:used) = '"'
    end associate
  end subroutine append_quoted

  !> Bytes that a text begins with and that stand for themselves: ASCII, or one other character.
  pure integer function plain_length(text)
    character(*), intent(in) :: text
    integer :: number, k
    plain_length = 0
    do k = 1, len(text)
      number = iachar(text(k:k))
      if (number < 32 .or. number >= 127 .or. number == quote .or. number == backslash) exit
      plain_length = k
    end do
    if (plain_length > 0 .or. len(text) == 0) return
    if (iachar(text(1:1)) >= 128) plain_length = utf8_length(text)
  end function plain_length

  !> The n letters that stand for a character: \" \\ \n, else \u00XX.
  pure subroutine put_escaped(letter, room, n)
    character, intent(in) :: letter
    character(*), intent(inout) :: room
    integer, intent(out) :: n
    n = 2
    if (letter == '"' .or. letter == '\') then
      room(1:2) = '\'//letter
    else if (letter == new_line('a')) then
      room(1:2) = '\n'
    else
      n = 6
      write (room(1:6), '(a,z2.2)') '\u00', iachar(letter)
    end if
  end subroutine put_escaped

  !> Bytes of the UTF-8 character that a text begins with (RFC 3629: the shortest form, no
  !> surrogates, up to 10FFFF); 0 where it begins with none.
  pure integer function utf8_length(text)
    character(*), intent(in) :: text
    integer :: first, second, k
    first = iachar(text(1:1))
    second = 0
    if (len(text) > 1) second = iachar(text(2:2))
    select case (first)
    case (194:223)
      utf8_length = 2
    case (224:239)
      utf8_length = 3
    case (240:244)
      utf8_length = 4
    case default
      utf8_length = 0
    end select
    if (first == 224 .and. second < 160) utf8_length = 0
    if (first == 237 .and. second > 159) utf8_length = 0
    if (first == 240 .and. second < 144) utf8_length = 0
    if (first == 244 .and. second > 143) utf8_length = 0
    if (utf8_length > len(text)) utf8_length = 0
    do k = 2, utf8_length
      if (iand(iachar(text(k:k)), 192) /= 128) utf8_length = 0
    end do
  end function utf8_length

end module base_json
