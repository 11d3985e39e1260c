! SPDX-License-Identifier: BSD-3-Clause
!> Where the time of a run goes: one clock reading at each change of phase, and a count of
!> entries. The clock is the monotonic one, because it is cheap (about 30 ns); the processor
!> time of the whole process is read separately and the log gives both.
module base_timers
  use base_kinds, only: wp, i8
  implicit none
  private
  integer, parameter, public :: phase_other = 1
  integer, parameter, public :: phase_input = 2
  integer, parameter, public :: phase_assemble = 3
  integer, parameter, public :: phase_factor = 4
  integer, parameter, public :: phase_product = 5
  integer, parameter, public :: phase_solve = 6
  integer, parameter, public :: phase_search = 7
  integer, parameter, public :: phase_contact = 8
  integer, parameter, public :: phase_update = 9
  integer, parameter, public :: phase_energy = 10
  integer, parameter, public :: phase_output = 11
  integer, parameter, public :: phase_count = 11
  character(30), parameter, public :: phase_name(phase_count) = [character(30) :: &
    'start and end', 'input', 'assembly', 'factorisation', 'matrix-vector products', &
    'solves', 'contact search', 'contact', 'update', 'energies and ledger', 'tables']

  type, public :: timers_t
    integer(i8) :: ticks(phase_count) = 0_i8
    integer(i8) :: calls(phase_count) = 0_i8
    integer :: current = phase_other
    integer(i8), private :: last = 0_i8
  contains
    procedure :: start => timers_start
    procedure :: enter => timers_enter
    procedure :: seconds => timers_seconds
  end type timers_t

contains

  !> Starts the clock in phase "other".
  subroutine timers_start(this)
    class(timers_t), intent(inout) :: this
    call system_clock(this%last)
  end subroutine timers_start

  !> Ends the current phase and enters another.
  subroutine timers_enter(this, phase)
    class(timers_t), intent(inout) :: this
    integer, intent(in) :: phase
    integer(i8) :: now
    call system_clock(now)
    this%ticks(this%current) = this%ticks(this%current) + now - this%last
    this%last = now
    this%current = phase
    this%calls(phase) = this%calls(phase) + 1_i8
  end subroutine timers_enter

  !> Seconds spent in a phase so far [T].
  real(wp) function timers_seconds(this, phase)
    class(timers_t), intent(in) :: this
    integer, intent(in) :: phase
    integer(i8) :: rate
    call system_clock(count_rate=rate)
    timers_seconds = real(this%ticks(phase), wp)/real(rate, wp)
  end function timers_seconds

end module base_timers
