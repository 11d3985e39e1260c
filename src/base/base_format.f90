! SPDX-License-Identifier: BSD-3-Clause
!> Real numbers as text of full precision, ES24.16E3, several times faster than the run-time
!> library does it: tables of a short run would otherwise cost a quarter of its time.
!> The digits come from one product in quadruple precision, whose error (1e-33) is far below
!> half a
!> unit of the 17th digit, so the text reads back equal; the unit test says so for a million
!> numbers.
module base_format
  use base_kinds, only: wp, i8
  implicit none
  private
  integer, parameter :: qp = selected_real_kind(33)
  integer, parameter :: range10 = 330
  integer, parameter, public :: real_width = 24

  !> Powers of ten, made once by the owner of the tables.
  type, public :: real_writer_t
    private
    real(qp) :: power(-range10:range10)
  end type real_writer_t

  public :: make_real_writer, put_real, put_integer

contains

  !> Fills the table of powers.
  pure subroutine make_real_writer(writer)
    type(real_writer_t), intent(out) :: writer
    integer :: k
    writer%power(0) = 1
    do k = 1, range10
      writer%power(k) = writer%power(k - 1)*10
    end do
    do k = 1, range10
      writer%power(-k) = 1/writer%power(k)
    end do
  end subroutine make_real_writer

  !> Writes x as ES24.16E3 into text. Zero keeps no sign; what is not a normal number (denormal,
  !> infinite, not a number) goes the slow way through the run-time library.
  pure subroutine put_real(writer, x, text)
    type(real_writer_t), intent(in) :: writer
    real(wp), intent(in) :: x
    character(real_width), intent(out) :: text
    integer(i8), parameter :: low = 10_i8**16, high = 10_i8**17
    integer(i8) :: digits
    integer :: e
    real(wp) :: a
    a = abs(x)
    if (a > 0.0_wp .and. (.not. (a >= tiny(a) .and. a <= huge(a)))) then
      write (text, '(es24.16e3)') x
      return
    else if (.not. (a > 0.0_wp)) then
      text = ' 0.0000000000000000E+000'
      return
    end if
    e = floor(log10(a))
    digits = nint(real(a, qp)*writer%power(16 - e), i8)
    if (digits < low) e = e - 1
    if (digits >= high) e = e + 1
    if (digits < low .or. digits >= high) digits = nint(real(a, qp)*writer%power(16 - e), i8)
    call put_digits(digits, e, text)
    text(1:1) = merge('-', ' ', x < 0)
  end subroutine put_real

  !> Lays out 17 digits and an exponent of ten.
  pure subroutine put_digits(digits, exponent, text)
    integer(i8), intent(in) :: digits
    integer, intent(in) :: exponent
    character(real_width), intent(inout) :: text
    integer(i8) :: rest, next
    integer :: k, e
    rest = digits
    do k = 19, 4, -1
      next = rest/10
      text(k:k) = achar(48 + int(rest - 10*next))
      rest = next
    end do
    text(2:3) = achar(48 + int(rest))//'.'
    e = abs(exponent)
    text(20:21) = 'E'//merge('-', '+', exponent < 0)
    text(22:24) = achar(48 + e/100)//achar(48 + mod(e/10, 10))//achar(48 + mod(e, 10))
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
