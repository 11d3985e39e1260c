! SPDX-License-Identifier: BSD-3-Clause
!> One line of progress on a terminal; nothing when the messages go elsewhere.
module run_progress
  use, intrinsic :: iso_fortran_env, only: error_unit
  use base_kinds, only: wp, i8
  use base_strings, only: to_text
  use base_system, only: is_terminal
  implicit none
  private
  integer, parameter :: steps_between_looks = 64

  type, public :: progress_t
    logical :: known = .false.
    logical :: on = .false.
    integer(i8) :: start = 0_i8, shown = 0_i8
  end type progress_t

  public :: show_progress, clear_progress

contains

  !> Time, step, percent and remaining seconds, at most four times a second; share: of the run
  !> that is done.
  subroutine show_progress(progress, quiet, cycle, time, share)
    type(progress_t), intent(inout) :: progress
    logical, intent(in) :: quiet
    integer, intent(in) :: cycle
    real(wp), intent(in) :: time, share
    integer(i8) :: now, rate
    real(wp) :: elapsed
    if (.not. progress%known) then
      progress%known = .true.
      progress%on = is_terminal(2)
      if (quiet) progress%on = .false.
      call system_clock(progress%start)
    end if
    if (.not. progress%on .or. mod(cycle, steps_between_looks) /= 0) return
    call system_clock(now, rate)
    if (now - progress%shown < rate/4) return
    progress%shown = now
    elapsed = real(now - progress%start, wp)/real(rate, wp)
    write (error_unit, '(a)', advance='no') achar(13)//'time '//to_text(time)//'  step '// &
        to_text(cycle)//'  '//to_text(nint(100.0_wp*share))//' %  '// &
        to_text(nint(min(1.0e9_wp, elapsed*(1.0_wp - share)/share)))//' s left     '
    flush (error_unit)
  end subroutine show_progress

  !> Takes the line away.
  subroutine clear_progress(progress)
    type(progress_t), intent(in) :: progress
    if (.not. progress%on .or. progress%shown == 0_i8) return
    write (error_unit, '(a)', advance='no') achar(13)//repeat(' ', 72)//achar(13)
    flush (error_unit)
  end subroutine clear_progress

end module run_progress
