! SPDX-License-Identifier: BSD-3-Clause
!> Numbers of expressions: integers and reals with the rules of Fortran.
module deck_value
  use base_kinds, only: wp, i8
  implicit none
  private

  type, public :: value_t
    logical :: is_integer = .false.
    integer(i8) :: i = 0             !< used if is_integer
    real(wp) :: x = 0.0_wp           !< always set
  end type value_t

  integer(i8), parameter, public :: largest_integer = 2147483647_i8

  public :: is_zero, real_value, integer_value, negative, sum_of, product_of, whole_power

contains

  !> Is a value 0?
  pure logical function is_zero(a)
    type(value_t), intent(in) :: a
    is_zero = .not. abs(a%x) > 0.0_wp
  end function is_zero

  !> A real.
  elemental function real_value(x) result(value)
    real(wp), intent(in) :: x
    type(value_t) :: value
    value%x = x
  end function real_value

  !> An integer.
  elemental function integer_value(i) result(value)
    integer(i8), intent(in) :: i
    type(value_t) :: value
    value = value_t(.true., i, real(i, wp))
  end function integer_value

  !> -a.
  elemental function negative(a) result(value)
    type(value_t), intent(in) :: a
    type(value_t) :: value
    value = value_t(a%is_integer, -a%i, -a%x)
  end function negative

  !> a + b.
  elemental function sum_of(a, b) result(value)
    type(value_t), intent(in) :: a, b
    type(value_t) :: value
    value = real_value(a%x + b%x)
    if (a%is_integer .and. b%is_integer) value = integer_value(a%i + b%i)
  end function sum_of

  !> a b.
  elemental function product_of(a, b) result(value)
    type(value_t), intent(in) :: a, b
    type(value_t) :: value
    value = real_value(a%x*b%x)
    if (a%is_integer .and. b%is_integer) value = integer_value(a%i*b%i)
  end function product_of

  !> An integer to an integer power >= 0; where it overflows, its size as a real says so.
  pure function whole_power(value, power) result(found)
    type(value_t), intent(in) :: value, power
    type(value_t) :: found
    if (power%x*log(max(abs(value%x), 1.0_wp)) > log(2.0_wp*real(largest_integer, wp))) then
      found = integer_value(2*largest_integer)
    else
      found = integer_value(value%i**int(power%i))
    end if
  end function whole_power

end module deck_value
