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

  !> 10^(2^j), j = 0..8, and their inverses, as sums of two doubles.
  real(qp), parameter :: up(0:8) = [1.0e1_qp, 1.0e2_qp, 1.0e4_qp, 1.0e8_qp, 1.0e16_qp, &
      1.0e32_qp, 1.0e64_qp, 1.0e128_qp, 1.0e256_qp]
  real(qp), parameter :: down(0:8) = [1.0e-1_qp, 1.0e-2_qp, 1.0e-4_qp, 1.0e-8_qp, 1.0e-16_qp, &
      1.0e-32_qp, 1.0e-64_qp, 1.0e-128_qp, 1.0e-256_qp]
  real(wp), parameter :: up_high(0:8) = real(up, wp), up_low(0:8) = real(up - up_high, wp)
  real(wp), parameter :: down_high(0:8) = real(down, wp), &
      down_low(0:8) = real(down - down_high, wp)

  public :: make_real_writer, put_real, put_one_real, put_integer, put_long

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
    integer(i8), parameter :: beyond = 10_i8**17
    integer(i8) :: digits
    integer :: e
    real(wp) :: a
    a = abs(x)
    if (a <= 0.0_wp) then
      text = ' 0.0000000000000000E+000'
    else if (.not. is_ordinary(a)) then
      write (text, '(es24.16e3)') x
    else
      e = decimal_exponent(a)
      digits = scaled_digits(a, writer%high(16 - e), writer%low(16 - e))
      if (digits >= beyond) then
        e = e + 1
        digits = scaled_digits(a, writer%high(16 - e), writer%low(16 - e))
      end if
      call put_digits(digits, e, x < 0, text)
    end if
  end subroutine put_real

  !> The same without a table of all powers, for a few numbers, which do not pay for one.
  pure subroutine put_one_real(x, text)
    real(wp), intent(in) :: x
    character(real_width), intent(out) :: text
    type(real_writer_t) :: writer
    integer :: k
    if (is_ordinary(abs(x))) then
      do k = 15 - decimal_exponent(abs(x)), 16 - decimal_exponent(abs(x))
        call power_of_ten(k, writer%high(k), writer%low(k))
      end do
    end if
    call put_real(writer, x, text)
  end subroutine put_one_real

  pure logical function is_ordinary(a)
    real(wp), intent(in) :: a
    is_ordinary = a > 1.0e-260_wp .and. a < 1.0e260_wp
  end function is_ordinary

  !> The exponent of ten of a > 0, or one less.
  pure integer function decimal_exponent(a)
    real(wp), intent(in) :: a
    real(wp), parameter :: log10_of_2 = 0.30102999566398120_wp
    decimal_exponent = floor((exponent(a) - 1)*log10_of_2)
  end function decimal_exponent

  !> a*(high + low), a power of ten, rounded to an integer.
  pure integer(i8) function scaled_digits(a, high, low)
    real(wp), intent(in) :: a, high, low
    real(wp) :: product, rest
    integer(i8) :: whole
    call multiply(a, high, product, rest)
    rest = rest + a*low
    whole = int(product, i8)
    scaled_digits = whole + nint((product - real(whole, wp)) + rest, i8)
  end function scaled_digits

  !> a*b = product + rest exactly (Dekker 1971).
  pure subroutine multiply(a, b, product, rest)
    real(wp), intent(in) :: a, b
    real(wp), intent(out) :: product, rest
    real(wp) :: a_high, a_low, b_high, b_low, carry
    product = a*b
    carry = splitter*a
    a_high = carry - (carry - a)
    a_low = a - a_high
    carry = splitter*b
    b_high = carry - (carry - b)
    b_low = b - b_high
    rest = ((a_high*b_high - product) + a_high*b_low + a_low*b_high) + a_low*b_low
  end subroutine multiply

  !> 10^k as a sum of two doubles, |k| < 512, from the powers of the binary digits of k; it is
  !> exact up to 10^22, then right to 1e-30.
  pure subroutine power_of_ten(k, high, low)
    integer, intent(in) :: k
    real(wp), intent(out) :: high, low
    real(wp) :: factor(2), product, rest
    integer :: j
    high = 1.0_wp
    low = 0.0_wp
    do j = 0, 8
      if (.not. btest(abs(k), j)) cycle
      factor = [up_high(j), up_low(j)]
      if (k < 0) factor = [down_high(j), down_low(j)]
      call multiply(high, factor(1), product, rest)
      rest = rest + (high*factor(2) + low*factor(1))
      high = product + rest
      low = rest - (high - product)
    end do
  end subroutine power_of_ten

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

  !> Writes a long integer right-adjusted into text.
  pure subroutine put_long(number, text)
    integer(i8), intent(in) :: number
    character(*), intent(out) :: text
    integer(i8) :: rest, next
    integer :: k
    text = ' '
    rest = abs(number)
    k = len(text)
    do
      next = rest/10_i8
      text(k:k) = achar(48 + int(rest - 10_i8*next))
      rest = next
      k = k - 1
      if (rest == 0_i8 .or. k == 0) exit
    end do
    if (number < 0_i8 .and. k > 0) text(k:k) = '-'
  end subroutine put_long

end module base_format
