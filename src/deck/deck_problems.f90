! SPDX-License-Identifier: BSD-3-Clause
!> What is wrong with a deck, collected so that one pass shows up to twenty problems, and what
!> was accepted with a word (notes, warnings).
module deck_problems
  use base_messages, only: messages_t, add_message
  use base_strings, only: to_text
  implicit none
  private
  integer, parameter, public :: problem_limit = 20

  type, public :: line_t
    character(:), allocatable :: text
  end type line_t

  type, public :: problems_t
    integer :: count = 0
    type(line_t) :: problem(problem_limit)
    type(line_t) :: kind(problem_limit)   !< place and kind of those that one line may repeat
    type(messages_t) :: notes, warnings
  end type problems_t

  public :: add_problem, add_note, add_warning, is_told, render, full

contains

  !> True when no further problem would be shown.
  pure logical function full(problems)
    type(problems_t), intent(in) :: problems
    full = problems%count >= problem_limit
  end function full

  !> Adds a finished message.
  subroutine add_problem(problems, text)
    type(problems_t), intent(inout) :: problems
    character(*), intent(in) :: text
    if (full(problems)) return
    problems%count = problems%count + 1
    problems%problem(problems%count)%text = text
  end subroutine add_problem

  !> Was a problem of this kind told of this line before? Keeps it as the kind of the next one
  !> if not. Two texts are of one kind when they differ in digits and quoted texts alone.
  logical function is_told(problems, place, text)
    type(problems_t), intent(inout) :: problems
    character(*), intent(in) :: place, text
    character(:), allocatable :: kind
    integer :: k
    is_told = .false.
    if (full(problems)) return
    kind = place//': '//kind_of(text)
    do k = 1, problems%count
      if (.not. allocated(problems%kind(k)%text)) cycle
      is_told = is_told .or. problems%kind(k)%text == kind
    end do
    if (.not. is_told) problems%kind(problems%count + 1)%text = kind
  end function is_told

  pure function kind_of(text) result(kind)
    character(*), intent(in) :: text
    character(:), allocatable :: kind
    logical :: quoted
    integer :: k
    kind = ''
    quoted = .false.
    do k = 1, len(text)
      if (text(k:k) == '"') quoted = .not. quoted
      if (quoted .or. index('0123456789', text(k:k)) > 0) cycle
      kind = kind//text(k:k)
    end do
  end function kind_of

  !> Adds a note; the same note is kept once.
  subroutine add_note(problems, text)
    type(problems_t), intent(inout) :: problems
    character(*), intent(in) :: text
    call add_message(problems%notes, '', text)
  end subroutine add_note

  !> Adds a warning of a kind, one word by which the summary counts; the same warning is kept
  !> once.
  subroutine add_warning(problems, kind, text)
    type(problems_t), intent(inout) :: problems
    character(*), intent(in) :: kind, text
    call add_message(problems%warnings, kind, text)
  end subroutine add_warning

  !> One message: place and columns, what, the card, carets under the columns, the hint. Control
  !> characters of the card are shown as "?", and only its first 200 columns.
  pure function render(place, first, last, what, card, hint) result(text)
    character(*), intent(in) :: place
    integer, intent(in) :: first, last   !< columns; 0 = the whole card
    character(*), intent(in) :: what
    character(*), intent(in) :: card
    character(*), intent(in) :: hint
    character(:), allocatable :: text
    character(*), parameter :: indent = '    '
    integer, parameter :: widest = 200
    text = printable(place)
    if (first > 0 .and. last > first) then
      text = text//', columns '//to_text(first)//'-'//to_text(last)
    else if (first > 0) then
      text = text//', column '//to_text(first)
    end if
    text = text//': '//printable(what)
    if (len(card) > 0) text = text//new_line('a')//indent// &
        printable(card(1:min(len(card), widest)))
    if (len(card) > 0 .and. first > 0 .and. first <= widest) text = text//new_line('a')// &
        indent//repeat(' ', first - 1)//repeat('^', max(1, min(last, widest) - first + 1))
    if (len(hint) > 0) text = text//new_line('a')//indent//'hint: '//hint
  end function render

  pure function printable(text) result(clean)
    character(*), intent(in) :: text
    character(len(text)) :: clean
    integer :: k
    clean = text
    do k = 1, len(text)
      if (iachar(text(k:k)) < 32 .or. iachar(text(k:k)) == 127) clean(k:k) = '?'
    end do
  end function printable

end module deck_problems
