! SPDX-License-Identifier: BSD-3-Clause
!> Asks a run to stop at the end of its step when SIGINT or SIGTERM arrives, and to write a
!> restart file when SIGUSR1 does.
!> A handler can only reach a saved variable: this is the one module that has one.
module base_signal
  use, intrinsic :: iso_c_binding, only: c_int, c_intptr_t, c_funptr, c_funloc
  implicit none
  private
  public :: watch_limits, watch_signals, stop_asked, restart_asked

  integer(c_int), parameter :: sigint = 2_c_int
  integer(c_int), parameter :: sigterm = 15_c_int
  integer(c_int), parameter :: sigusr1 = 10_c_int   ! on Linux for x86 and ARM
  integer(c_int), parameter :: sigxfsz = 25_c_int    ! there too
  integer, volatile, save :: received = 0, asked = 0

  interface
    type(c_funptr) function c_signal(number, handler) bind(c, name='signal')
      import :: c_int, c_funptr
      integer(c_int), value, intent(in) :: number
      type(c_funptr), value, intent(in) :: handler
    end function c_signal
  end interface

contains

  !> A file that may not grow any more is a write that fails, not the end of the program.
  subroutine watch_limits()
    type(c_funptr) :: old
    integer(c_intptr_t), parameter :: ignore = 1_c_intptr_t
    old = c_signal(sigxfsz, transfer(ignore, old))
  end subroutine watch_limits

  !> Installs the handlers; that of SIGUSR1 only where restart files are written.
  subroutine watch_signals(with_restart)
    logical, intent(in) :: with_restart
    type(c_funptr) :: old
    if (with_restart) old = c_signal(sigusr1, c_funloc(remember))
    old = c_signal(sigint, c_funloc(remember))
    old = c_signal(sigterm, c_funloc(remember))
  end subroutine watch_signals

  !> True when a signal has asked for a stop.
  logical function stop_asked()
    stop_asked = received /= 0
  end function stop_asked

  !> True once for each time that a restart file was asked for.
  logical function restart_asked()
    restart_asked = asked /= 0
    asked = 0
  end function restart_asked

  subroutine remember(number) bind(c)
    integer(c_int), value, intent(in) :: number
    if (number == sigusr1) then
      asked = 1
    else
      received = int(number)
    end if
  end subroutine remember

end module base_signal
