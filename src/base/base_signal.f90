! SPDX-License-Identifier: BSD-3-Clause
!> Asks a run to stop at the end of its step when SIGINT or SIGTERM arrives.
!> A handler can only reach a saved variable: this is the one module that has one.
module base_signal
  use, intrinsic :: iso_c_binding, only: c_int, c_funptr, c_funloc
  implicit none
  private
  public :: watch_signals, stop_asked

  integer(c_int), parameter :: sigint = 2_c_int
  integer(c_int), parameter :: sigterm = 15_c_int
  integer, volatile, save :: received = 0

  interface
    type(c_funptr) function c_signal(number, handler) bind(c, name='signal')
      import :: c_int, c_funptr
      integer(c_int), value, intent(in) :: number
      type(c_funptr), value, intent(in) :: handler
    end function c_signal
  end interface

contains

  !> Installs the handlers.
  subroutine watch_signals()
    type(c_funptr) :: old
    old = c_signal(sigint, c_funloc(remember))
    old = c_signal(sigterm, c_funloc(remember))
  end subroutine watch_signals

  !> True when a signal has asked for a stop.
  logical function stop_asked()
    stop_asked = received /= 0
  end function stop_asked

  subroutine remember(number) bind(c)
    integer(c_int), value, intent(in) :: number
    received = int(number)
  end subroutine remember

end module base_signal
