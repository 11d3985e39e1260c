! SPDX-License-Identifier: BSD-3-Clause
!> *PARAMETER: named numbers and words, and their replacement from the command line.
module deck_parameter
  use base_kinds, only: wp
  use base_strings, only: upper, to_text
  use deck_data, only: deck_t
  use deck_number, only: scan_real, scan_integer
  use deck_problems, only: problems_t, add_problem, render
  use deck_source, only: cursor_t, next_line
  implicit none
  private
  integer, parameter :: pair_width = 20

  !> name=value of the command line.
  type, public :: override_t
    character(10) :: name = ''
    character(24) :: value = ''
    logical :: used = .false.
  end type override_t

  type, public :: parameters_t
    integer :: n = 0
    character(10) :: name(256) = ''
    character(24) :: text(256) = ''
    character :: kind(256) = ''
    integer :: line(256) = 0
  end type parameters_t

  public :: read_parameters, report_unused_overrides, find_parameter

contains

  !> Row of a parameter, 0 if it is not defined (yet).
  pure integer function find_parameter(parameters, name)
    type(parameters_t), intent(in) :: parameters
    character(*), intent(in) :: name
    do find_parameter = 1, parameters%n
      if (parameters%name(find_parameter) == upper(name)) return
    end do
    find_parameter = 0
  end function find_parameter

  !> Reads the cards of *PARAMETER: four pairs a card, each 10 columns name (type letter first)
  !> and 10 columns value; or comma form.
  subroutine read_parameters(deck, cursor, parameters, overrides, more)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(inout) :: cursor
    type(parameters_t), intent(inout) :: parameters
    type(override_t), intent(inout) :: overrides(:)
    logical, intent(out) :: more
    integer :: first
    more = next_line(deck%file(cursor%file), cursor)
    do while (more)
      associate (line => deck%file(cursor%file)%text(cursor%first:cursor%last))
        if (len(line) > 0) then
          if (line(1:1) == '*') return
        end if
        if (index(line, ',') > 0) then
          call read_comma_pairs(deck, cursor, line, parameters, overrides)
        else
          do first = 1, max(len_trim(line), 1), pair_width
            if (first > 4*pair_width) exit
            call define(deck, cursor, pad(line, first), pad(line, first + 10), first, &
                parameters, overrides)
          end do
        end if
      end associate
      more = next_line(deck%file(cursor%file), cursor)
    end do
  end subroutine read_parameters

  subroutine read_comma_pairs(deck, cursor, line, parameters, overrides)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    character(*), intent(in) :: line
    type(parameters_t), intent(inout) :: parameters
    type(override_t), intent(inout) :: overrides(:)
    integer :: first, comma, next
    character(:), allocatable :: name
    first = 1
    do while (first <= len(line))
      comma = index(line(first:)//',', ',') + first - 1
      next = index(line(min(comma + 1, len(line) + 1):)//',', ',') + comma
      name = line(first:comma - 1)
      call define(deck, cursor, name, line(min(comma + 1, len(line) + 1):min(next - 1, &
          len(line))), first, parameters, overrides)
      first = next + 1
    end do
  end subroutine read_comma_pairs

  !> Ten columns of a line, blanks beyond its end.
  pure function pad(line, first) result(piece)
    character(*), intent(in) :: line
    integer, intent(in) :: first
    character(10) :: piece
    piece = ''
    if (first <= len(line)) piece = line(first:min(first + 9, len(line)))
  end function pad

  !> Defines one parameter.
  subroutine define(deck, cursor, pair_name, pair_value, column, parameters, overrides)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    character(*), intent(in) :: pair_name
    character(*), intent(in) :: pair_value
    integer, intent(in) :: column
    type(parameters_t), intent(inout) :: parameters
    type(override_t), intent(inout) :: overrides(:)
    character(:), allocatable :: name, value, what, left
    character :: kind
    integer :: k
    left = adjustl(pair_name)
    if (len_trim(left) == 0 .and. len_trim(pair_value) == 0) return
    kind = upper(left(1:1))
    name = upper(trim(adjustl(left(2:))))
    value = trim(adjustl(pair_value))
    do k = 1, size(overrides)
      if (upper(overrides(k)%name) /= name) cycle
      value = trim(overrides(k)%value)
      overrides(k)%used = .true.
    end do
    what = ''
    if (index('RIC', kind) == 0) then
      what = 'field NAME: expected R, I or C before the name, found "'//trim(left)//'"'
    else if (len(name) == 0 .or. len(name) > 9) then
      what = 'field NAME: expected a name of 1 to 9 characters, found "'//trim(left)//'"'
    else if (find_parameter(parameters, name) > 0) then
      what = 'parameter '//name//' is defined twice; the first is in line '// &
          to_text(parameters%line(find_parameter(parameters, name)))
    else if (.not. converts(kind, value)) then
      what = 'field VALUE: expected '//trim(kind_name(kind))//', found "'//pair_value//'"'
    end if
    if (len(what) > 0) then
      call complain(deck, cursor, column, what)
    else
      k = parameters%n + 1
      parameters%n = k
      parameters%name(k) = name
      parameters%text(k) = value
      parameters%kind(k) = kind
      parameters%line(k) = cursor%line
    end if
  end subroutine define

  pure logical function converts(kind, value)
    character, intent(in) :: kind
    character(*), intent(in) :: value
    real(wp) :: number
    integer :: count
    select case (kind)
    case ('R')
      call scan_real(value, number, converts)
    case ('I')
      call scan_integer(value, count, converts)
    case default
      converts = len(value) > 0 .and. len(value) <= 10
    end select
  end function converts

  pure function kind_name(kind) result(name)
    character, intent(in) :: kind
    character(30) :: name
    select case (kind)
    case ('R')
      name = 'a real number'
    case ('I')
      name = 'an integer'
    case default
      name = 'a word of up to 10 characters'
    end select
  end function kind_name

  subroutine complain(deck, cursor, column, what)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    integer, intent(in) :: column
    character(*), intent(in) :: what
    character(:), allocatable :: hint
    hint = 'each name/value pair is 20 columns wide: the type letter R, I or C in the '// &
        'first, the value in its last ten'
    if (scan(what(max(1, len(what) - 1):), 'RICric') > 0 .and. what(len(what):) == '"') &
        hint = hint//'; this pair looks one column short'
    call add_problem(deck%problems, render(deck%file(cursor%file)%path//':'// &
        to_text(cursor%line), column, column + pair_width - 1, '*PARAMETER: '//what, &
        deck%file(cursor%file)%text(cursor%first:cursor%last), hint))
  end subroutine complain

  !> An override of a name that no *PARAMETER defines is a problem, never ignored.
  subroutine report_unused_overrides(overrides, parameters, problems)
    type(override_t), intent(in) :: overrides(:)
    type(parameters_t), intent(in) :: parameters
    type(problems_t), intent(inout) :: problems
    character(:), allocatable :: known
    integer :: k
    known = ''
    do k = 1, parameters%n
      known = known//' '//trim(parameters%name(k))
    end do
    if (len(known) == 0) known = ' none'
    do k = 1, size(overrides)
      if (overrides(k)%used) cycle
      call add_problem(problems, '-D '//trim(overrides(k)%name)//'='// &
          trim(overrides(k)%value)//': the deck has no such parameter'//new_line('a')// &
          '    hint: its parameters are:'//known)
    end do
  end subroutine report_unused_overrides

end module deck_parameter
