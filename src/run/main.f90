! SPDX-License-Identifier: BSD-3-Clause
!> bipact DECK [-o DIR] [-D name=value]... [--check | --plan] [--quiet]
program bipact
  use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
  use base_signal, only: watch_signals
  use base_status, only: status_t, failed, status_text, status_ok, status_stopped
  use base_strings, only: stem_of, to_text
  use base_system, only: make_folder, leave
  use base_timers, only: phase_output, phase_other
  use base_version, only: version
  use deck_help, only: write_keywords, write_usage
  use deck_keywords, only: fill_table
  use output_tables, only: open_tables, close_tables
  use run_arguments, only: arguments_t, read_arguments
  use run_data, only: run_t
  use run_loop, only: go_through_steps
  use run_report, only: open_log, close_log, write_plan
  use run_setup, only: read_scene, set_up
  implicit none
  type(arguments_t) :: arguments
  type(run_t), allocatable :: run
  type(status_t) :: status

  allocate (run)
  call run%timers%start()
  call read_arguments(arguments, status)
  if (failed(status)) then
    continue
  else if (arguments%help) then
    call write_usage(output_unit)
  else if (arguments%version) then
    write (output_unit, '(a)') 'bipact '//version
  else if (arguments%keywords) then
    call fill_table(run%deck%table)
    call write_keywords(run%deck%table, output_unit)
  else
    call work(status)
  end if
  if (failed(status)) write (error_unit, '(a)') 'bipact: '//status_text(status)
  deallocate (run)
  call leave(status%code)

contains

  subroutine work(status)
    type(status_t), intent(inout) :: status
    integer :: k
    run%quiet = arguments%quiet
    call read_scene(arguments%deck, arguments%override, run, status)
    do k = 1, run%deck%problems%count
      write (error_unit, '(a)') run%deck%problems%problem(k)%text
    end do
    if (failed(status)) return
    if (arguments%plan .or. arguments%check) then
      if (arguments%check) write (output_unit, '(a)') arguments%deck//': the deck is valid'
      do k = 1, run%deck%problems%note_count
        write (output_unit, '(a)') 'NOTE '//run%deck%problems%note(k)%text
      end do
      do k = 1, run%deck%problems%warning_count
        write (output_unit, '(a)') 'WARNING '//run%deck%problems%warning(k)%text
      end do
      call write_plan(run, output_unit)
      return
    end if
    call set_up(run, status)
    if (failed(status)) return
    call compute(status)
  end subroutine work

  subroutine compute(status)
    type(status_t), intent(inout) :: status
    type(status_t) :: closing
    character(:), allocatable :: ending
    call run%timers%enter(phase_output)
    run%folder = stem_of(arguments%deck)//'.out'
    if (allocated(arguments%folder)) run%folder = arguments%folder
    call make_folder(run%folder, status)
    if (failed(status)) return
    call open_log(run, status)
    call open_tables(run%tables, run%model, run%folder, run%scheme%has_acceleration, status)
    if (failed(status)) return
    call run%timers%enter(phase_other)
    call watch_signals()
    call go_through_steps(run, status)
    call run%timers%enter(phase_output)
    ending = 'failed'
    if (status%code == status_ok) ending = 'done'
    if (status%code == status_stopped) ending = 'stopped'
    call close_tables(run%tables, ending, run%state%cycle, closing)
    call run%timers%enter(phase_other)
    if (.not. failed(status)) status = closing
    call close_log(run, status)
  end subroutine compute

end program bipact
