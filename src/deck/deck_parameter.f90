! SPDX-License-Identifier: BSD-3-Clause
!> *PARAMETER: named numbers and words, and their replacement from the command line.
module deck_parameter
  use base_kinds, only: wp
  use base_strings, only: upper, to_text
  use deck_data, only: deck_t, parameter_t, find_parameter, convert
  use deck_problems, only: add_problem
  use deck_source, only: cursor_t, next_line
  implicit none
  private
  integer, parameter :: longest_name = 9

  !> name=value of the command line.
  type, public :: override_t
    character(10) :: name = ''
    character(24) :: value = ''
    logical :: used = .false.
  end type override_t

  !> Where a pair stands: card, number on the card, columns of its name and its value.
  type :: pair_t
    integer :: card = 0, number = 0
    integer :: first(2) = 1, last(2) = 1
  end type pair_t

  public :: read_parameters, report_unused_overrides

contains

  !> Reads the cards of *PARAMETER: four pairs a card, each 10 columns name (type letter first)
  !> and 10 columns value (long form: 20 and 20); or comma form.
  subroutine read_parameters(deck, cursor, overrides, long, more)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(inout) :: cursor
    type(override_t), intent(inout) :: overrides(:)
    logical, intent(in) :: long
    logical, intent(out) :: more
    type(pair_t) :: pair
    integer :: k, width
    width = merge(20, 10, long)
    pair%card = 0
    more = next_line(deck%file(cursor%file), cursor)
    do while (more)
      associate (line => deck%file(cursor%file)%text(cursor%first:cursor%last))
        if (len(line) > 0) then
          if (line(1:1) == '*') return
        end if
        pair%card = pair%card + 1
        if (scan(line, ',') > 0) then
          call read_comma_pairs(deck, cursor, line, pair, overrides)
        else if (scan(line, achar(9)) > 0) then
          call deck%complain_at(cursor%file, cursor%line, 0, 0, '*PARAMETER card '// &
              to_text(pair%card)//': a tab in a data card', line, 'expand tabs to blanks')
        else
          do k = 1, 4
            pair%number = k
            pair%first = 2*width*(k - 1) + [1, width + 1]
            pair%last = pair%first + width - 1
            call define(deck, cursor, piece(line, pair%first(1), width), &
                piece(line, pair%first(2), width), pair, overrides)
          end do
          if (len_trim(line) > 8*width) &
              call deck%complain_at(cursor%file, cursor%line, 8*width + 1, len_trim(line), &
              '*PARAMETER card '//to_text(pair%card)//': text beyond the fourth pair', line, '')
        end if
      end associate
      more = next_line(deck%file(cursor%file), cursor)
    end do
  end subroutine read_parameters

  subroutine read_comma_pairs(deck, cursor, line, pair, overrides)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    character(*), intent(in) :: line
    type(pair_t), intent(inout) :: pair
    type(override_t), intent(inout) :: overrides(:)
    integer :: first, comma, next
    first = 1
    pair%number = 0
    do while (first <= len(line))
      comma = index(line(first:)//',', ',') + first - 1
      next = len(line) + 1
      if (comma < len(line)) next = index(line(comma + 1:)//',', ',') + comma
      pair%number = pair%number + 1
      pair%first = [first, min(comma + 1, len(line))]
      pair%last = [max(first, comma - 1), max(next - 1, pair%first(2))]
      call define(deck, cursor, line(first:comma - 1), line(comma + 1:next - 1), &
          pair, overrides)
      first = next + 1
    end do
  end subroutine read_comma_pairs

  !> Columns of a line, blanks beyond its end.
  pure function piece(line, first, width) result(text)
    character(*), intent(in) :: line
    integer, intent(in) :: first, width
    character(width) :: text
    text = ''
    if (first <= len(line)) text = line(first:min(first + width - 1, len(line)))
  end function piece

  !> Defines one parameter; both texts blank: nothing.
  subroutine define(deck, cursor, pair_name, pair_value, pair, overrides)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    character(*), intent(in) :: pair_name
    character(*), intent(in) :: pair_value
    type(pair_t), intent(in) :: pair
    type(override_t), intent(inout) :: overrides(:)
    character(:), allocatable :: name, value, left, found
    character :: kind
    integer :: k
    if (len_trim(pair_name) == 0 .and. len_trim(pair_value) == 0) return
    left = trim(adjustl(pair_name))//' '
    kind = upper(left(1:1))
    name = upper(trim(adjustl(left(2:))))
    value = trim(adjustl(pair_value))
    found = 'found "'//pair_value//'"'
    do k = 1, size(overrides)
      if (upper(overrides(k)%name) /= name) cycle
      value = trim(overrides(k)%value)
      found = '-D gives "'//value//'"'
      overrides(k)%used = .true.
    end do
    if (index('RIC', kind) == 0) then
      call complain(deck, cursor, pair, 1, 'expected R, I or C before the name, found "'// &
          pair_name//'"', pair_value)
    else if (len(name) == 0 .or. len(name) > longest_name .or. index(name, ' ') > 0) then
      call complain(deck, cursor, pair, 1, 'expected a name of 1 to 9 characters, found "'// &
          pair_name//'"', pair_value)
    else if (find_parameter(deck, name) > 0) then
      call complain(deck, cursor, pair, 1, 'parameter '//name// &
          ' is defined twice; the first is at '// &
          deck%parameter(find_parameter(deck, name))%place, '')
    else if (.not. converts(kind, value)) then
      call complain(deck, cursor, pair, 2, 'expected '//trim(kind_name(kind))//', '// &
          found, pair_value)
    else
      call keep(deck, name, value, kind, deck%file(cursor%file)%path//':'//to_text(cursor%line))
    end if
  end subroutine define

  subroutine keep(deck, name, value, kind, place)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: name, value
    character, intent(in) :: kind
    character(*), intent(in) :: place
    type(parameter_t), allocatable :: longer(:)
    if (deck%parameters == size(deck%parameter)) then
      allocate (longer(2*deck%parameters))
      longer(1:deck%parameters) = deck%parameter
      call move_alloc(longer, deck%parameter)
    end if
    deck%parameters = deck%parameters + 1
    associate (p => deck%parameter(deck%parameters))
      p%name = name
      p%text = value
      p%kind = kind
      p%place = place
    end associate
  end subroutine keep

  pure logical function converts(kind, value)
    character, intent(in) :: kind
    character(*), intent(in) :: value
    real(wp) :: number
    if (kind == 'C') then
      converts = len(value) > 0 .and. len(value) <= 10 .and. scan(value, '&,$* ') == 0
    else
      converts = len(value) <= 24
      if (converts) call convert(value, kind, number, converts)
    end if
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

  !> The half of a pair that is wrong, 1 its name, 2 its value. Where the value ends in the type
  !> letter of the next pair, the card has slipped to the left.
  subroutine complain(deck, cursor, pair, half, what, pair_value)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    type(pair_t), intent(in) :: pair
    integer, intent(in) :: half
    character(*), intent(in) :: what, pair_value
    character(:), allocatable :: hint
    hint = ''
    if (half == 2 .or. len(pair_value) > 0) &
        hint = 'each name/value pair is 20 columns wide, '//'the type letter R, I or C first'
    if (scan(pair_value(max(1, len(pair_value)):), 'RICric') > 0) hint = 'each name/value '// &
        'pair is 20 columns wide; the pair starting in column '//to_text(pair%first(1))// &
        ' looks one column short'
    call deck%complain_at(cursor%file, cursor%line, pair%first(half), pair%last(half), &
        '*PARAMETER card '//to_text(pair%card)//', field '// &
        trim(merge('NAME ', 'VALUE', half == 1))//to_text(pair%number)//': '//what, &
        deck%file(cursor%file)%text(cursor%first:cursor%last), hint)
  end subroutine complain

  !> An override of a name that no *PARAMETER defines is a problem, never ignored.
  subroutine report_unused_overrides(overrides, deck)
    type(override_t), intent(in) :: overrides(:)
    type(deck_t), intent(inout) :: deck
    character(:), allocatable :: known
    integer :: k
    known = ''
    do k = 1, min(deck%parameters, 20)
      known = known//' '//trim(deck%parameter(k)%name)
    end do
    if (len(known) == 0) known = ' none'
    if (deck%parameters > 20) known = known//' ...'
    do k = 1, size(overrides)
      if (overrides(k)%used) cycle
      call add_problem(deck%problems, '-D '//trim(overrides(k)%name)//'='// &
          trim(overrides(k)%value)//': the deck has no such parameter'//new_line('a')// &
          '    hint: its parameters are:'//known)
    end do
  end subroutine report_unused_overrides

end module deck_parameter
