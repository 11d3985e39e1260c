! SPDX-License-Identifier: BSD-3-Clause
!> Checks for unit tests: call test_start once, check_... as often as wanted, and test_end last.
module check

  use, intrinsic :: iso_fortran_env, only: int32, int64, real64
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  implicit none
  private
  public :: test_start, test_end, check_true, check_close, check_equal, seed_random

  character(:), allocatable :: suite
  integer :: n_passed = 0
  integer :: n_failed = 0

  !> got == expected, for integers and strings (trailing blanks count).
  interface check_equal
    module procedure :: check_equal_int32, check_equal_int64, check_equal_string
  end interface check_equal

contains

  !> Opens a test; the name is printed with each failure.
  subroutine test_start(name)
    character(*), intent(in) :: name

    suite = name
  end subroutine test_start

  !> Prints the counts; ends the program with code 1 if a check failed or none was made.
  subroutine test_end()

    print '(i0, a, i0, a)', n_passed, ' passed, ', n_failed, ' failed'
    if (n_failed > 0 .or. n_passed == 0) stop 1
  end subroutine test_end

  !> Makes random_number repeat itself from run to run.
  subroutine seed_random(seed)
    integer, intent(in) :: seed
    integer, allocatable :: state(:)
    integer :: n

    call random_seed(size=n)
    allocate (state(n))
    state = seed
    call random_seed(put=state)
  end subroutine seed_random

  !> The condition holds.
  subroutine check_true(condition, what)
    logical, intent(in) :: condition
    character(*), intent(in) :: what

    call count_check(condition, what)
  end subroutine check_true

  !> |a - b| <= tolerance*scale; scale is 1 unless given. NaN and infinity always fail.
  subroutine check_close(a, b, tolerance, what, scale)
    real(real64), intent(in) :: a, b, tolerance
    character(*), intent(in) :: what
    real(real64), intent(in), optional :: scale
    real(real64) :: limit
    logical :: holds
    character(96) :: text

    limit = tolerance
    if (present(scale)) limit = tolerance*scale
    ! Finiteness first: comparing a NaN would trap in the debug flavour.
    holds = ieee_is_finite(a) .and. ieee_is_finite(b) .and. ieee_is_finite(limit)
    if (holds) holds = abs(a - b) <= limit
    write (text, '(es23.15e3, " against", es23.15e3, ", allowed", es9.1e3)') a, b, limit
    call count_check(holds, what // ':' // trim(text))
  end subroutine check_close

  subroutine check_equal_int32(got, expected, what)
    integer(int32), intent(in) :: got, expected
    character(*), intent(in) :: what

    call check_equal_int64(int(got, int64), int(expected, int64), what)
  end subroutine check_equal_int32

  subroutine check_equal_int64(got, expected, what)
    integer(int64), intent(in) :: got, expected
    character(*), intent(in) :: what
    character(64) :: text

    write (text, '(": ", i0, ", expected ", i0)') got, expected
    call count_check(got == expected, what // trim(text))
  end subroutine check_equal_int64

  subroutine check_equal_string(got, expected, what)
    character(*), intent(in) :: got, expected, what
    logical :: holds

    holds = len(got) == len(expected)
    if (holds) holds = got == expected
    call count_check(holds, what // ': "' // got // '", expected "' // expected // '"')
  end subroutine check_equal_string

  subroutine count_check(holds, message)
    logical, intent(in) :: holds
    character(*), intent(in) :: message

    if (holds) then
      n_passed = n_passed + 1
    else
      n_failed = n_failed + 1
      if (.not. allocated(suite)) suite = 'unnamed test'
      print '(a)', 'failed: ' // suite // ': ' // message
    end if
  end subroutine count_check

end module check
