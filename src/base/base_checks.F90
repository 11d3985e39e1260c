! SPDX-License-Identifier: BSD-3-Clause
!> Assertions: what holds at the entry of a procedure unless its caller is wrong. What a deck or
!> a computation can bring about is no such case: that is a status_t. The flavours debug and
!> sanitize have them; in release `checks_on` is a false constant, and nothing is compiled of
!>   if (checks_on) call assert(...)
module base_checks
  use, intrinsic :: iso_fortran_env, only: error_unit
  use base_strings, only: to_text
  implicit none
  private
  public :: assert, assert_shape

#ifdef BIPACT_DEBUG
  logical, parameter, public :: checks_on = .true.
#else
  logical, parameter, public :: checks_on = .false.
#endif
  !> Exit code of a failed assertion, beside those of base_status.
  integer, parameter, public :: code_assertion = 70

contains

  !> Ends the program with a message and the chain of calls unless the condition holds; place:
  !> the procedure, what: the condition in words.
  subroutine assert(condition, place, what)
    logical, intent(in) :: condition
    character(*), intent(in) :: place, what
    if (condition) return
    write (error_unit, '(a)') 'bipact: assertion failed in '//place//': '//what
    error stop code_assertion
  end subroutine assert

  !> The same unless an array, called name, has the wanted shape.
  subroutine assert_shape(found, wanted, place, name)
    integer, intent(in) :: found(:), wanted(:)
    character(*), intent(in) :: place, name
    if (all(found == wanted)) return
    call assert(.false., place, name//' has the shape ('//list_of(found)//'), expected ('// &
        list_of(wanted)//')')
  end subroutine assert_shape

  pure function list_of(numbers) result(text)
    integer, intent(in) :: numbers(:)
    character(:), allocatable :: text
    integer :: k
    text = ''
    do k = 1, size(numbers)
      if (k > 1) text = text//', '
      text = text//to_text(numbers(k))
    end do
  end function list_of

end module base_checks
