! SPDX-License-Identifier: BSD-3-Clause
!> *PARAMETER, *PARAMETER_EXPRESSION and *PARAMETER_LOCAL: named numbers and words, and their
!> replacement from the command line.
module deck_parameter
  use base_kinds, only: wp
  use base_strings, only: upper, to_text
  use deck_data, only: deck_t, parameter_t, convert
  use deck_expression, only: evaluate, outcome_t
  use deck_problems, only: add_problem, add_note
  use deck_source, only: cursor_t, next_line
  use deck_value, only: value_t
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
    integer :: scope = 0           !< file of *PARAMETER_LOCAL; 0 = all files
  end type pair_t

  !> An expression over several lines: its text, and where each line of it begins.
  type :: expression_t
    character(:), allocatable :: text
    integer :: lines = 0
    integer :: start(20) = 0          !< index in the text
    integer :: column(20) = 0         !< on the line
    type(cursor_t) :: cursor(20)
  end type expression_t

  public :: read_parameters, read_expressions, report_unused_overrides

contains

  !> Reads the cards of *PARAMETER: four pairs a card, each 10 columns name (type letter first)
  !> and 10 columns value (long form: 20 and 20); or comma form. local: of *PARAMETER_LOCAL.
  subroutine read_parameters(deck, cursor, overrides, long, local, more)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(inout) :: cursor
    type(override_t), intent(inout) :: overrides(:)
    logical, intent(in) :: long, local
    logical, intent(out) :: more
    type(pair_t) :: pair
    integer :: k, width
    width = merge(20, 10, long)
    pair%card = 0
    pair%scope = merge(cursor%file, 0, local)
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
    character(:), allocatable :: name, value, found
    character :: kind
    logical :: ok
    if (len_trim(pair_name) == 0 .and. len_trim(pair_value) == 0) return
    call read_name(deck, cursor, pair_name, pair, pair_value, kind, name, ok)
    if (.not. ok) return
    value = trim(adjustl(pair_value))
    found = 'found "'//pair_value//'"'
    if (is_overridden(overrides, name, pair%scope, value)) found = '-D gives "'//value//'"'
    if (converts(kind, value)) then
      call keep(deck, cursor, name, value, kind, pair%scope)
    else
      call complain(deck, cursor, pair, 2, 'expected '//trim(kind_name(kind))//', '// &
          found, pair_value)
    end if
  end subroutine define

  !> The type letter and the name of a pair; not ok after a problem.
  subroutine read_name(deck, cursor, pair_name, pair, pair_value, kind, name, ok)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    character(*), intent(in) :: pair_name, pair_value
    type(pair_t), intent(in) :: pair
    character, intent(out) :: kind
    character(:), allocatable, intent(out) :: name
    logical, intent(out) :: ok
    character(:), allocatable :: left
    integer :: first
    left = trim(adjustl(pair_name))//' '
    kind = upper(left(1:1))
    name = upper(trim(adjustl(left(2:))))
    first = in_scope(deck, name, pair%scope)
    ok = .false.
    if (index('RIC', kind) == 0) then
      call complain(deck, cursor, pair, 1, 'expected R, I or C before the name, found "'// &
          pair_name//'"', pair_value)
    else if (len(name) == 0 .or. len(name) > longest_name .or. index(name, ' ') > 0) then
      call complain(deck, cursor, pair, 1, 'expected a name of 1 to 9 characters, found "'// &
          pair_name//'"', pair_value)
    else if (first > 0) then
      call complain(deck, cursor, pair, 1, 'parameter '//name// &
          ' is defined twice; the first is at '//deck%parameter(first)%place, '')
    else
      ok = .true.
    end if
  end subroutine read_name

  !> Row of a parameter of the same scope; 0 if there is none.
  pure integer function in_scope(deck, name, scope)
    type(deck_t), intent(in) :: deck
    character(*), intent(in) :: name
    integer, intent(in) :: scope
    do in_scope = 1, deck%parameters
      if (deck%parameter(in_scope)%name == name .and. deck%parameter(in_scope)%file == scope) &
          return
    end do
    in_scope = 0
  end function in_scope

  !> Does the command line give a parameter? Then its value is replaced. It gives those of all
  !> files and of the main file (1), not those that an included file keeps to itself.
  logical function is_overridden(overrides, name, scope, value)
    type(override_t), intent(inout) :: overrides(:)
    character(*), intent(in) :: name
    integer, intent(in) :: scope
    character(:), allocatable, intent(inout) :: value
    integer :: k
    is_overridden = .false.
    if (scope > 1) return
    do k = 1, size(overrides)
      if (upper(overrides(k)%name) /= name) cycle
      value = trim(overrides(k)%value)
      is_overridden = .true.
      overrides(k)%used = .true.
    end do
  end function is_overridden

  !> Reads the cards of *PARAMETER_EXPRESSION: the name as in *PARAMETER, then the expression to
  !> the end of the line (or name and expression with a comma between). Lines without a name
  !> continue the expression.
  subroutine read_expressions(deck, cursor, overrides, long, local, more)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(inout) :: cursor
    type(override_t), intent(inout) :: overrides(:)
    logical, intent(in) :: long, local
    logical, intent(out) :: more
    type(expression_t) :: expression
    type(pair_t) :: pair
    integer :: width, last, first
    logical :: pending
    width = merge(20, 10, long)
    pending = .false.
    pair%scope = merge(cursor%file, 0, local)
    more = next_line(deck%file(cursor%file), cursor)
    do while (more)
      associate (line => deck%file(cursor%file)%text(cursor%first:cursor%last))
        if (len(line) > 0) then
          if (line(1:1) == '*') exit
        end if
        if (len_trim(line) > 0) then
          call find_name(line, width, last, first)
          if (last > 0) then
            if (pending) call define_by(deck, expression, pair, overrides)
            pair%card = pair%card + 1
            pair%first = [1, first]
            pair%last = [last, len(line)]
            expression%text = ''
            expression%lines = 0
            pending = .true.
          end if
          if (.not. pending) then
            call deck%complain_at(cursor%file, cursor%line, 1, width, &
                '*PARAMETER_EXPRESSION: the first line needs a name', line, '')
          else if (expression%lines == size(expression%start)) then
            call deck%complain_at(cursor%file, cursor%line, 0, 0, '*PARAMETER_EXPRESSION '// &
                'card '//to_text(pair%card)//': an expression has at most '// &
                to_text(expression%lines)//' lines', line, '')
          else
            call add_line(expression, cursor, line, first)
          end if
        end if
      end associate
      more = next_line(deck%file(cursor%file), cursor)
    end do
    if (pending) call define_by(deck, expression, pair, overrides)
  end subroutine read_expressions

  !> The last column of the name on a line, 0 where it has none, and the first column of the
  !> expression: after the columns of the name, or after a comma that follows a name there.
  pure subroutine find_name(line, width, last, first)
    character(*), intent(in) :: line
    integer, intent(in) :: width
    integer, intent(out) :: last, first
    last = index(line(1:min(width + 1, len(line))), ',') - 1
    first = last + 2
    if (last > 0) then
      if (len_trim(line(1:last)) > 0) return
    end if
    last = min(width, len(line))
    first = width + 1
    if (len_trim(line(1:last)) == 0) last = 0
  end subroutine find_name

  !> Appends the part of a line from a column on.
  pure subroutine add_line(expression, cursor, line, column)
    type(expression_t), intent(inout) :: expression
    type(cursor_t), intent(in) :: cursor
    character(*), intent(in) :: line
    integer, intent(in) :: column
    expression%lines = expression%lines + 1
    expression%start(expression%lines) = len(expression%text) + 1
    expression%column(expression%lines) = column
    expression%cursor(expression%lines) = cursor
    expression%text = expression%text//line(min(column, len(line) + 1):)//' '
  end subroutine add_line

  !> Defines a parameter by its expression.
  subroutine define_by(deck, expression, pair, overrides)
    type(deck_t), intent(inout) :: deck
    type(expression_t), intent(in) :: expression
    type(pair_t), intent(in) :: pair
    type(override_t), intent(inout) :: overrides(:)
    type(outcome_t) :: outcome
    type(cursor_t) :: cursor
    character(:), allocatable :: name, value
    character :: kind
    logical :: ok
    cursor = expression%cursor(1)
    associate (line => deck%file(cursor%file)%text(cursor%first:cursor%last))
      call read_name(deck, cursor, trim(line(1:min(pair%last(1), len(line)))), pair, '', kind, &
          name, ok)
    end associate
    if (.not. ok) return
    if (is_overridden(overrides, name, pair%scope, value)) then
      outcome%wrong = '-D gives "'//value//'", expected '//trim(kind_name(kind))
      if (.not. converts(kind, value)) outcome%wrong_at = 1
    else if (kind == 'C') then
      outcome%wrong = 'an expression is a number: expected R or I before the name'
      outcome%wrong_at = 1
    else
      outcome = evaluate(deck, cursor%file, cursor%line, expression%text)
      if (outcome%wrong_at == 0) call check_outcome(kind, outcome)
      if (outcome%wrong_at == 0) value = value_text(kind, outcome%value)
    end if
    if (outcome%wrong_at > 0) then
      call complain_in(deck, expression, outcome, pair%card)
      return
    end if
    if (outcome%truncated) call add_note(deck%problems, deck%file(cursor%file)%path//':'// &
        to_text(cursor%line)//': parameter '//name//' divides integers; the remainder is '// &
        'dropped (write 5.0/2 for 2.5)')
    call keep(deck, cursor, name, value, kind, pair%scope)
  end subroutine define_by

  !> An integer parameter needs a whole value.
  subroutine check_outcome(kind, outcome)
    character, intent(in) :: kind
    type(outcome_t), intent(inout) :: outcome
    if (kind /= 'I' .or. outcome%value%is_integer) return
    if (abs(outcome%value%x - anint(outcome%value%x)) <= 0.0_wp &
        .and. abs(outcome%value%x) <= real(huge(1), wp)) return
    outcome%wrong_at = 1
    outcome%wrong = 'expected an integer, the value is '//to_text(outcome%value%x)// &
        '; INT drops the fraction, NINT rounds'
  end subroutine check_outcome

  !> Text that reads back equal.
  function value_text(kind, value) result(text)
    character, intent(in) :: kind
    type(value_t), intent(in) :: value
    character(:), allocatable :: text
    character(24) :: digits
    if (kind == 'I') then
      text = to_text(nint(value%x))
    else
      write (digits, '(es24.16e3)') value%x
      text = trim(adjustl(digits))
    end if
  end function value_text

  !> A problem at a character of an expression.
  subroutine complain_in(deck, expression, outcome, card)
    type(deck_t), intent(inout) :: deck
    type(expression_t), intent(in) :: expression
    type(outcome_t), intent(in) :: outcome
    integer, intent(in) :: card
    integer :: k, column
    k = count(expression%start(1:expression%lines) <= outcome%wrong_at)
    column = expression%column(k) + outcome%wrong_at - expression%start(k)
    associate (cursor => expression%cursor(k))
      associate (line => deck%file(cursor%file)%text(cursor%first:cursor%last))
        call deck%complain_at(cursor%file, cursor%line, column, column, &
            '*PARAMETER_EXPRESSION card '//to_text(card)//': '//outcome%wrong, line, '')
      end associate
    end associate
  end subroutine complain_in

  subroutine keep(deck, cursor, name, value, kind, scope)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    character(*), intent(in) :: name, value
    character, intent(in) :: kind
    integer, intent(in) :: scope
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
      p%file = scope
      p%line = cursor%line
      p%place = deck%file(cursor%file)%path//':'//to_text(cursor%line)
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
    character(:), allocatable :: hint, field
    hint = ''
    if (half == 2 .or. len(pair_value) > 0) &
        hint = 'each name/value pair is 20 columns wide, '//'the type letter R, I or C first'
    if (scan(pair_value(max(1, len(pair_value)):), 'RICric') > 0) hint = 'each name/value '// &
        'pair is 20 columns wide; the pair starting in column '//to_text(pair%first(1))// &
        ' looks one column short'
    if (pair%number == 0) then
      field = '*PARAMETER_EXPRESSION card '//to_text(pair%card)//', field NAME'
    else
      field = '*PARAMETER card '//to_text(pair%card)//', field '// &
          trim(merge('NAME ', 'VALUE', half == 1))//to_text(pair%number)
    end if
    call deck%complain_at(cursor%file, cursor%line, pair%first(half), pair%last(half), &
        field//': '//what, deck%file(cursor%file)%text(cursor%first:cursor%last), hint)
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
