! SPDX-License-Identifier: BSD-3-Clause
!> Value of an arithmetic expression of *PARAMETER_EXPRESSION. Integers and reals follow the
!> rules of Fortran: an operation of two integers gives an integer (5/2 is 2), any other a real.
module deck_expression
  use base_kinds, only: wp, i8
  use base_strings, only: upper, to_text
  use deck_data, only: deck_t, find_parameter
  use deck_number, only: scan_integer, scan_real
  use deck_value, only: value_t, largest_integer, is_zero, real_value, integer_value, &
      negative, sum_of, product_of, whole_power
  implicit none
  private

  !> What came out: a value, or what is wrong and at which character.
  type, public :: outcome_t
    type(value_t) :: value
    integer :: wrong_at = 0          !< 0 = nothing is wrong
    character(:), allocatable :: wrong
    logical :: truncated = .false.   !< a division of integers left a remainder
  end type outcome_t

  !> The text, where the reading is, and the place in the deck that says which parameters are
  !> visible.
  type :: parser_t
    character(:), allocatable :: text
    integer :: at = 1
    integer :: depth = 0
    integer :: file = 0, line = 0
    type(outcome_t) :: outcome
  end type parser_t

  integer, parameter :: deepest = 60
  !> Products and quotients of numbers of this size do not overflow.
  real(wp), parameter :: largest = 1.0e150_wp
  character(*), parameter :: letters = 'ABCDEFGHIJKLMNOPQRSTUVWXYZ_'
  character(*), parameter :: digits = '0123456789'

  public :: evaluate

contains

  !> Evaluates a text; names are parameters that are visible at a line of a file, or PI.
  function evaluate(deck, file, line, text) result(outcome)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: file, line
    character(*), intent(in) :: text
    type(outcome_t) :: outcome
    type(parser_t) :: parser
    type(value_t) :: value
    parser%text = upper(text)
    parser%file = file
    parser%line = line
    call read_sum(deck, parser, value)
    if (peek(parser) /= ' ') call reject(parser, (parser%at), 'expected an operator or the end')
    outcome = parser%outcome
    outcome%value = value
  end function evaluate

  !> The next character that is not blank; a blank at the end of the text.
  character function peek(parser)
    type(parser_t), intent(inout) :: parser
    do while (parser%at <= len(parser%text))
      peek = parser%text(parser%at:parser%at)
      if (peek /= ' ') return
      parser%at = parser%at + 1
    end do
    peek = ' '
  end function peek

  !> Keeps what is wrong first, and ends the reading.
  subroutine reject(parser, at, wrong)
    type(parser_t), intent(inout) :: parser
    integer, intent(in) :: at
    character(*), intent(in) :: wrong
    if (parser%outcome%wrong_at == 0) then
      parser%outcome%wrong_at = at
      parser%outcome%wrong = wrong
    end if
    parser%at = len(parser%text) + 1
  end subroutine reject

  !> sum = product { (+ | -) product }
  recursive subroutine read_sum(deck, parser, value)
    type(deck_t), intent(in) :: deck
    type(parser_t), intent(inout) :: parser
    type(value_t), intent(out) :: value
    type(value_t) :: right
    character :: operator
    integer :: at
    parser%depth = parser%depth + 1
    if (parser%depth > deepest) then
      call reject(parser, (parser%at), 'more than '//to_text(deepest)//' nested parentheses')
      return
    end if
    call read_product(deck, parser, value)
    do
      operator = peek(parser)
      if (operator /= '+' .and. operator /= '-') exit
      at = parser%at
      parser%at = at + 1
      call read_product(deck, parser, right)
      if (operator == '-') right = negative(right)
      call keep(parser, at, sum_of(value, right), value)
    end do
    parser%depth = parser%depth - 1
  end subroutine read_sum

  !> product = factor { (* | /) factor }
  recursive subroutine read_product(deck, parser, value)
    type(deck_t), intent(in) :: deck
    type(parser_t), intent(inout) :: parser
    type(value_t), intent(out) :: value
    type(value_t) :: right
    character :: operator
    integer :: at
    call read_factor(deck, parser, value)
    do
      operator = peek(parser)
      if (operator /= '*' .and. operator /= '/') exit
      at = parser%at
      parser%at = at + 1
      call read_factor(deck, parser, right)
      if (operator == '*') call keep(parser, at, product_of(value, right), value)
      if (operator == '/') call divide(parser, at, value, right)
    end do
  end subroutine read_product

  !> factor = (+ | -) factor | primary [ ** factor ]: -2**2 is -4, 2**3**2 is 512.
  recursive subroutine read_factor(deck, parser, value)
    type(deck_t), intent(in) :: deck
    type(parser_t), intent(inout) :: parser
    type(value_t), intent(out) :: value
    type(value_t) :: power
    character :: sign
    integer :: at
    parser%depth = parser%depth + 1
    sign = peek(parser)
    at = parser%at
    if (parser%depth > deepest) then
      call reject(parser, at, 'more than '//to_text(deepest)//' nested signs or powers')
    else if (sign == '+' .or. sign == '-') then
      parser%at = at + 1
      call read_factor(deck, parser, value)
      if (sign == '-') value = negative(value)
    else
      call read_primary(deck, parser, value)
      if (peek(parser) == '*') then
        at = parser%at
        if (parser%text(at:min(at + 1, len(parser%text))) == '**') then
          parser%at = at + 2
          call read_factor(deck, parser, power)
          call raise(parser, at, value, power)
        end if
      end if
    end if
    parser%depth = parser%depth - 1
  end subroutine read_factor

  !> primary = number | parameter | PI | function ( sum {, sum} ) | ( sum )
  recursive subroutine read_primary(deck, parser, value)
    type(deck_t), intent(in) :: deck
    type(parser_t), intent(inout) :: parser
    type(value_t), intent(out) :: value
    character :: next
    integer :: at, last
    next = peek(parser)
    at = parser%at
    if (next == '(') then
      parser%at = at + 1
      call read_sum(deck, parser, value)
      call close_parenthesis(parser, at)
    else if (scan(next, digits//'.') > 0) then
      call read_number(parser, value)
    else if (scan(next, letters//'&') > 0) then
      last = at + verify(parser%text(at + 1:)//'?', letters//digits) - 1
      parser%at = last + 1
      if (peek(parser) == '(' .and. next /= '&') then
        call read_call(deck, parser, at, parser%text(at:last), value)
      else
        call look_up(deck, parser, at, parser%text(at:last), value)
      end if
    else if (next == ' ') then
      call reject(parser, max(1, len_trim(parser%text)), &
          'the expression ends where a value should follow')
    else
      call reject(parser, at, 'expected a number, a name or a parenthesis')
    end if
  end subroutine read_primary

  !> Moves over the parenthesis that closes the one at `opened`.
  subroutine close_parenthesis(parser, opened)
    type(parser_t), intent(inout) :: parser
    integer, intent(in) :: opened
    select case (peek(parser))
    case (')')
      parser%at = parser%at + 1
    case (' ')
      call reject(parser, opened, 'the parenthesis is not closed')
    case default
      call reject(parser, (parser%at), 'expected an operator or ")"')
    end select
  end subroutine close_parenthesis

  !> Digits with at most one point and an exponent; an integer if it has neither.
  subroutine read_number(parser, value)
    type(parser_t), intent(inout) :: parser
    type(value_t), intent(out) :: value
    integer :: first, last, number
    logical :: ok
    first = parser%at
    last = first + verify(parser%text(first:)//'?', digits//'.') - 2
    if (scan(parser%text(last + 1:min(last + 1, len(parser%text))), 'ED') > 0) &
        call read_exponent(parser%text, last)
    parser%at = last + 1
    associate (text => parser%text(first:last))
      value%is_integer = verify(text, digits) == 0
      if (value%is_integer) then
        call scan_integer(text, number, ok)
        value = integer_value(int(number, i8))
      else
        call scan_real(text, value%x, ok)
        if (ok) ok = abs(value%x) <= largest
      end if
      if (.not. ok) call reject(parser, first, '"'//text//'" is no number, or too large')
    end associate
  end subroutine read_number

  !> Moves `last` over an exponent, if digits follow its letter.
  pure subroutine read_exponent(text, last)
    character(*), intent(in) :: text
    integer, intent(inout) :: last
    integer :: first
    first = last + 2
    if (scan(text(first:min(first, len(text))), '+-') > 0) first = first + 1
    if (scan(text(first:min(first, len(text))), digits) == 0) return
    last = first + verify(text(first:)//'?', digits) - 2
  end subroutine read_exponent

  !> Value of a parameter, or PI.
  subroutine look_up(deck, parser, at, name, value)
    type(deck_t), intent(in) :: deck
    type(parser_t), intent(inout) :: parser
    integer, intent(in) :: at
    character(*), intent(in) :: name
    type(value_t), intent(out) :: value
    integer :: row, number
    logical :: ok
    row = find_parameter(deck, name(index(name, '&') + 1:), parser%file, parser%line)
    if (row > 0) then
      associate (p => deck%parameter(row))
        if (p%kind == 'C') call reject(parser, at, '"'//name//'" is a word, not a number')
        if (p%kind == 'I') then
          call scan_integer(trim(p%text), number, ok)
          if (.not. ok) then
            call scan_real(trim(p%text), value%x, ok)
            number = nint(value%x)
          end if
          value = integer_value(int(number, i8))
        else
          call scan_real(trim(p%text), value%x, ok)
        end if
        if (abs(value%x) > largest) call reject(parser, at, '"'//name//'" is too large')
      end associate
    else if (name == 'PI') then
      value = real_value(acos(-1.0_wp))
    else
      call reject(parser, at, 'undefined parameter "'//name//'"')
    end if
  end subroutine look_up

  !> name ( a {, b} )
  recursive subroutine read_call(deck, parser, at, name, value)
    type(deck_t), intent(in) :: deck
    type(parser_t), intent(inout) :: parser
    integer, intent(in) :: at
    character(*), intent(in) :: name
    type(value_t), intent(out) :: value
    type(value_t) :: a(9)
    integer :: n, opened
    character :: next
    opened = parser%at
    n = 0
    do
      parser%at = parser%at + 1
      if (n == size(a)) then
        call reject(parser, at, name//' has more than '//to_text(size(a))//' arguments')
        return
      end if
      n = n + 1
      call read_sum(deck, parser, a(n))
      next = peek(parser)
      if (next /= ',') exit
    end do
    call close_parenthesis(parser, opened)
    if (parser%outcome%wrong_at == 0) call apply(parser, at, name, a(1:n), value)
  end subroutine read_call

  !> Value of a function; angles are in radians.
  subroutine apply(parser, at, name, a, value)
    type(parser_t), intent(inout) :: parser
    integer, intent(in) :: at
    character(*), intent(in) :: name
    type(value_t), intent(in) :: a(:)
    type(value_t), intent(out) :: value
    integer :: wanted
    select case (name)
    case ('MIN', 'MAX')
      wanted = max(2, size(a))
    case ('ATAN2', 'MOD')
      wanted = 2
    case default
      wanted = 1
    end select
    if (size(a) /= wanted) then
      call reject(parser, at, name//' takes '//to_text(wanted)//' argument'// &
          trim(merge(' ', 's', wanted == 1))//', found '//to_text(size(a)))
      return
    end if
    select case (name)
    case ('MIN', 'MAX', 'ABS', 'MOD', 'INT', 'NINT')
      call apply_typed(parser, at, name, a, value)
    case ('ATAN2')
      if (is_zero(a(1)) .and. is_zero(a(2))) call reject(parser, at, 'ATAN2 of 0 and 0')
      if (parser%outcome%wrong_at == 0) value = real_value(atan2(a(1)%x, a(2)%x))
    case default
      call apply_real(parser, at, name, a(1)%x, value)
    end select
  end subroutine apply

  !> Functions whose value is an integer where the arguments are, or always.
  subroutine apply_typed(parser, at, name, a, value)
    type(parser_t), intent(inout) :: parser
    integer, intent(in) :: at
    character(*), intent(in) :: name
    type(value_t), intent(in) :: a(:)
    type(value_t), intent(out) :: value
    logical :: integers
    integers = all(a%is_integer)
    select case (name)
    case ('MIN')
      value = real_value(minval(a%x))
      if (integers) value = integer_value(minval(a%i))
    case ('MAX')
      value = real_value(maxval(a%x))
      if (integers) value = integer_value(maxval(a%i))
    case ('ABS')
      value = real_value(abs(a(1)%x))
      if (integers) value = integer_value(abs(a(1)%i))
    case ('MOD')
      if (is_zero(a(2))) then
        call reject(parser, at, 'MOD with a divisor of 0')
      else
        value = real_value(mod(a(1)%x, a(2)%x))
        if (integers) value = integer_value(mod(a(1)%i, a(2)%i))
      end if
    case default
      if (abs(a(1)%x) > real(largest_integer, wp)) then
        call reject(parser, at, name//' of a number beyond '//to_text(largest_integer))
      else
        value = integer_value(int(merge(anint(a(1)%x), aint(a(1)%x), name == 'NINT'), i8))
      end if
    end select
  end subroutine apply_typed

  !> Functions of one real.
  subroutine apply_real(parser, at, name, x, value)
    type(parser_t), intent(inout) :: parser
    integer, intent(in) :: at
    character(*), intent(in) :: name
    real(wp), intent(in) :: x
    type(value_t), intent(out) :: value
    character(:), allocatable :: domain
    domain = ''
    if (name == 'SQRT' .and. x < 0.0_wp) domain = 'a number >= 0'
    if ((name == 'LOG' .or. name == 'LOG10') .and. .not. x > 0.0_wp) domain = 'a number > 0'
    if ((name == 'ASIN' .or. name == 'ACOS') .and. abs(x) > 1.0_wp) &
        domain = 'a number from -1 to 1'
    if (name == 'EXP' .and. x > log(largest)) domain = 'a number below 345'
    if (len(domain) > 0) then
      call reject(parser, at, name//' takes '//domain)
      return
    end if
    select case (name)
    case ('SIN')
      value = real_value(sin(x))
    case ('COS')
      value = real_value(cos(x))
    case ('TAN')
      value = real_value(tan(x))
    case ('ASIN')
      value = real_value(asin(x))
    case ('ACOS')
      value = real_value(acos(x))
    case ('ATAN')
      value = real_value(atan(x))
    case ('SQRT')
      value = real_value(sqrt(x))
    case ('EXP')
      value = real_value(exp(x))
    case ('LOG')
      value = real_value(log(x))
    case ('LOG10')
      value = real_value(log10(x))
    case ('FLOAT')
      value = real_value(x)
    case default
      call reject(parser, at, 'unknown function "'//name//'"')
    end select
  end subroutine apply_real

  !> Takes a result if it is neither too large for a real nor for an integer.
  subroutine keep(parser, at, found, value)
    type(parser_t), intent(inout) :: parser
    integer, intent(in) :: at
    type(value_t), intent(in) :: found
    type(value_t), intent(inout) :: value
    if (abs(found%x) > largest) then
      call reject(parser, at, 'the result is too large')
    else if (found%is_integer .and. abs(found%i) > largest_integer) then
      call reject(parser, at, 'the integer is beyond '//to_text(largest_integer)// &
          '; write reals with a point')
    else
      value = found
    end if
  end subroutine keep

  subroutine divide(parser, at, value, right)
    type(parser_t), intent(inout) :: parser
    integer, intent(in) :: at
    type(value_t), intent(inout) :: value
    type(value_t), intent(in) :: right
    if (parser%outcome%wrong_at > 0) return
    if (is_zero(right)) then
      call reject(parser, at, 'division by zero')
    else if (value%is_integer .and. right%is_integer) then
      if (mod(value%i, right%i) /= 0) parser%outcome%truncated = .true.
      value = integer_value(value%i/right%i)
    else if (abs(value%x)/largest > abs(right%x)) then
      call reject(parser, at, 'the result is too large')
    else
      value = real_value(value%x/right%x)
    end if
  end subroutine divide

  !> x ** power by the library alone: a product of many factors would collect round-off. A
  !> negative x needs a whole power.
  pure function real_power(x, power) result(value)
    real(wp), intent(in) :: x, power
    type(value_t) :: value
    value = real_value(abs(x)**power)
    if (x < 0.0_wp .and. abs(mod(power, 2.0_wp)) > 0.0_wp) value = negative(value)
  end function real_power

  !> value ** power.
  subroutine raise(parser, at, value, power)
    type(parser_t), intent(inout) :: parser
    integer, intent(in) :: at
    type(value_t), intent(inout) :: value
    type(value_t), intent(in) :: power
    logical :: whole
    if (parser%outcome%wrong_at > 0) return
    whole = .not. abs(power%x - anint(power%x)) > 0.0_wp .and. abs(power%x) < 1.0e6_wp
    if (is_zero(value) .and. .not. power%x > 0.0_wp) then
      call reject(parser, at, '0 to a power that is not above 0')
    else if (value%x < 0.0_wp .and. .not. whole) then
      call reject(parser, at, 'a negative number to a broken power is not real')
    else if (value%is_integer .and. power%is_integer .and. power%i < 0) then
      call reject(parser, at, 'an integer to a negative power; write the base with a point')
    else if (.not. is_zero(value) .and. power%x*log(max(abs(value%x), tiny(1.0_wp))) &
        > log(largest)) then
      call reject(parser, at, 'the result is too large')
    else if (value%is_integer .and. power%is_integer) then
      call keep(parser, at, whole_power(value, power), value)
    else
      value = real_power(value%x, power%x)
    end if
  end subroutine raise

end module deck_expression
