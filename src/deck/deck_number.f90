! SPDX-License-Identifier: BSD-3-Clause
!> Text of one field to a number, strictly: the characters are judged before anything is
!> converted, because the run-time library takes "1 0", "nan" and "1/2" without complaint.
module deck_number
  use base_kinds, only: wp, i8
  implicit none
  private
  public :: scan_integer, scan_real

  !> Numbers beyond 10^+-300 become 10^+-300: no deck can use them, and the run-time library
  !> would overflow.
  integer, parameter :: far = 300

contains

  !> [+-]digits, at most 2^31-1.
  pure subroutine scan_integer(text, value, ok)
    character(*), intent(in) :: text
    integer, intent(out) :: value
    logical, intent(out) :: ok
    integer(i8) :: number
    integer :: k, first, digit
    value = 0
    number = 0
    first = 1
    if (len(text) > 0) then
      if (text(1:1) == '+' .or. text(1:1) == '-') first = 2
    end if
    ok = len(text) >= first
    do k = first, len(text)
      digit = iachar(text(k:k)) - 48
      ok = digit >= 0 .and. digit <= 9
      if (.not. ok) return
      number = 10_i8*number + digit
      ok = number <= 2147483647_i8
      if (.not. ok) return
    end do
    value = int(number)
    if (first == 2 .and. text(1:1) == '-') value = -value
  end subroutine scan_integer

  !> Digits with at most one point; exponent by E, e, D, d or a bare sign ("1.0-3"). Numbers of
  !> up to 15 digits and small exponents are converted by one exactly rounded operation, others
  !> by `read`.
  pure subroutine scan_real(text, value, ok)
    character(*), intent(in) :: text
    real(wp), intent(out) :: value
    logical, intent(out) :: ok
    integer(i8) :: mantissa
    integer :: digits, scale, exponent, mark, k, digit
    logical :: point, any_digit
    real(wp), parameter :: power(0:22) = [(10.0_wp**k, k=0, 22)]
    value = 0.0_wp
    mantissa = 0
    digits = 0
    scale = 0
    point = .false.
    any_digit = .false.
    mark = len(text) + 1
    do k = 1, len(text)
      digit = iachar(text(k:k)) - 48
      if (digit >= 0 .and. digit <= 9) then
        any_digit = .true.
        if (digits < 18) mantissa = 10_i8*mantissa + digit
        if (mantissa > 0) digits = digits + 1
        if (point) scale = scale - 1
      else if (text(k:k) == '.' .and. .not. point) then
        point = .true.
      else if (k > 1 .or. (text(k:k) /= '+' .and. text(k:k) /= '-')) then
        mark = k
        exit
      end if
    end do
    call scan_exponent(text(mark:), exponent, ok)
    ok = ok .and. any_digit
    if (.not. ok) return
    scale = scale + exponent
    if (digits == 0) then
      value = 0.0_wp
    else if (digits <= 15 .and. abs(scale) <= 22) then
      value = real(mantissa, wp)
      if (scale >= 0) value = value*power(scale)
      if (scale < 0) value = value/power(-scale)
      if (text(1:1) == '-') value = -value
    else if (abs(digits + scale) > far) then
      value = sign(merge(10.0_wp**far, 10.0_wp**(-far), scale > 0), &
          merge(-1.0_wp, 1.0_wp, text(1:1) == '-'))
    else
      call slow_real(text(1:mark - 1), exponent, value, ok)
    end if
  end subroutine scan_real

  !> Empty, or a letter and an integer, or a signed integer.
  pure subroutine scan_exponent(text, exponent, ok)
    character(*), intent(in) :: text
    integer, intent(out) :: exponent
    logical, intent(out) :: ok
    exponent = 0
    ok = .true.
    if (len(text) == 0) return
    if (index('EeDd', text(1:1)) > 0) then
      call scan_integer(text(2:), exponent, ok)
    else if (text(1:1) == '+' .or. text(1:1) == '-') then
      call scan_integer(text, exponent, ok)
    else
      ok = .false.
    end if
    ok = ok .and. abs(exponent) < 10000
  end subroutine scan_exponent

  pure subroutine slow_real(mantissa, exponent, value, ok)
    character(*), intent(in) :: mantissa
    integer, intent(in) :: exponent
    real(wp), intent(out) :: value
    logical, intent(out) :: ok
    character(len(mantissa) + 8) :: text
    integer :: ios
    write (text, '(a,"E",i0)') mantissa, exponent
    read (text, *, iostat=ios) value
    ok = ios == 0
    if (ok) ok = abs(value) <= huge(value)
  end subroutine slow_real

end module deck_number
