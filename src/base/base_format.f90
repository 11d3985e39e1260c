! SPDX-License-Identifier: BSD-3-Clause
!> Real numbers as text of full precision, ES24.16E3, several times faster than the run-time
!> library does it: tables of a short run would otherwise cost a quarter of its time. The 17
!> digits come from one product a*10^k in double-double arithmetic (Dekker 1971), whose error of
!> 1e-31 is far below half a unit of the last digit, so the text reads back equal.
module base_format
  use base_kinds, only: wp, i8
  implicit none
  private
  integer, parameter :: qp = selected_real_kind(33)
  integer, parameter :: range10 = 280
  real(wp), parameter :: splitter = 134217729.0_wp   !< 2^27 + 1
  integer, parameter, public :: real_width = 24

  !> Powers of ten as unevaluated sums of two doubles, made once by the owner of the tables.
  type, public :: real_writer_t
    private
    real(wp) :: high(-range10:range10)
    real(wp) :: low(-range10:range10)
  end type real_writer_t

  public :: make_real_writer, put_real, put_integer

contains

  !> Fills the table of powers.
  pure subroutine make_real_writer(writer)
    type(real_writer_t), intent(out) :: writer
    real(qp) :: power
    integer :: k
    power = 1
    do k = 0, range10
      writer%high(k) = real(power, wp)
      writer%low(k) = real(power - writer%high(k), wp)
      writer%high(-k) = real(1/power, wp)
      writer%low(-k) = real(1/power - writer%high(-k), wp)
      power = power*10
    end do
  end subroutine make_real_writer

  !> Writes x as ES24.16E3 into text. Zero keeps no sign; numbers beyond 1e+-260, infinite ones
  !> and those that are none go the slow way through the run-time library.
  pure subroutine put_real(writer, x, text)
    type(real_writer_t), intent(in) :: writer
    real(wp), intent(in) :: x
    character(real_width), intent(out) :: text
    integer(i8), parameter :: high = 10_i8**17
    real(wp), parameter :: log10_of_2 = 0.30102999566398120_wp
    integer(i8) :: digits
    integer :: e
    real(wp) :: a
    a = abs(x)
    if (a <= 0.0_wp) then
      text = ' 0.0000000000000000E+000'
    else if (.not. (a > 1.0e-260_wp .and. a < 1.0e260_wp)) then
      write (text, '(es24.16e3)') x
    else
      e = floor((exponent(a) - 1)*log10_of_2)
      digits = scaled_digits(writer, a, 16 - e)
      if (digits >= high) then
        e = e + 1
        digits = scaled_digits(writer, a, 16 - e)
      end if
      call put_digits(digits, e, x < 0, text)
    end if
  end subroutine put_real

  !> a*10^k rounded to an integer.
  pure integer(i8) function scaled_digits(writer, a, k)
    type(real_writer_t), intent(in) :: writer
    real(wp), intent(in) :: a
    integer, intent(in) :: k
    real(wp) :: product, rest, a_high, a_low, p_high, p_low, carry
    integer(i8) :: whole
    product = a*writer%high(k)
    carry = splitter*a
    a_high = carry - (carry - a)
    a_low = a - a_high
    carry = splitter*writer%high(k)
    p_high = carry - (carry - writer%high(k))
    p_low = writer%high(k) - p_high
    rest = ((a_high*p_high - product) + a_high*p_low + a_low*p_high) + a_low*p_low
    rest = rest + a*writer%low(k)
    whole = int(product, i8)
    scaled_digits = whole + nint((product - real(whole, wp)) + rest, i8)
  end function scaled_digits

  !> Lays out 17 digits and an exponent of ten.
  pure subroutine put_digits(digits, exponent, negative, text)
    integer(i8), intent(in) :: digits
    integer, intent(in) :: exponent
    logical, intent(in) :: negative
    character(real_width), intent(out) :: text
    integer(i8) :: rest, next
    integer :: k, e
    rest = digits
    do k = 19, 4, -1
      next = rest/10
      text(k:k) = achar(48 + int(rest - 10*next))
      rest = next
    end do
    text(3:3) = '.'
    text(2:2) = achar(48 + int(rest))
    text(1:1) = ' '
    if (negative) text(1:1) = '-'
    text(20:20) = 'E'
    text(21:21) = '+'
    if (exponent < 0) text(21:21) = '-'
    e = abs(exponent)
    text(22:22) = achar(48 + e/100)
    text(23:23) = achar(48 + mod(e/10, 10))
    text(24:24) = achar(48 + mod(e, 10))
  end subroutine put_digits

  !> Writes an integer right-adjusted into text.
  pure subroutine put_integer(number, text)
    integer, intent(in) :: number
    character(*), intent(out) :: text
    integer :: rest, k
    text = ' '
    rest = abs(number)
    k = len(text)
    do
      text(k:k) = achar(48 + mod(rest, 10))
      rest = rest/10
      k = k - 1
      if (rest == 0 .or. k == 0) exit
    end do
    if (number < 0 .and. k > 0) text(k:k) = '-'
  end subroutine put_integer

end module base_format
