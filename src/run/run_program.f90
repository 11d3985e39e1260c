! SPDX-License-Identifier: BSD-3-Clause
!> bipact DECK [-o DIR] [-D name=value]... [--restart FILE] [--threads N]
!>   [--check | --plan] [--quiet]
!> The program from its command line to its exit code, with or without what keeps fields and
!> restart files.
module run_program
  use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
  use assembly_team, only: team_t
  use base_files, only: file_exists, file_size, remove_file
  use base_kinds, only: i8
  use base_messages, only: add_message
  use base_signal, only: watch_limits, watch_signals
  use base_status, only: status_t, fail, failed, status_text, status_stopped, &
      status_numerical, status_file, status_deck
  use base_strings, only: stem_of, join_path, upper, to_text
  use base_system, only: make_folder, leave, exec_hdf5_program
  use base_timers, only: phase_output, phase_other
  use base_version, only: version
  use deck_echo, only: forget_cards
  use deck_help, only: write_keywords, write_keyword, write_usage
  use deck_keywords, only: fill_table, complete_table
  use deck_match, only: match_name
  use deck_table, only: table_t, find_nearest
  use linalg_registry, only: engine_ranks
  use output_storage, only: storage_t
  use output_tables, only: open_tables, close_tables
  use run_arguments, only: arguments_t, read_arguments
  use run_data, only: run_t
  use run_echo, only: put_echo, drop_echo, scratch_path
  use run_forecast, only: make_forecast, write_forecast
  use run_frames, only: start_frames, end_segment, remove_segments
  use run_loop, only: go_through_steps
  use run_report, only: open_log, close_log, write_plan, write_solver
  use run_restart, only: start_restarts, remove_restarts
  use run_resume, only: resume
  use run_setup, only: read_scene, prepare, start_factor, size_solver
  use run_summary, only: totals_t, find_totals, ending_of, write_run_summary, remove_run_summary
  use run_warnings, only: show_warnings, write_kinds
  implicit none
  private
  public :: run_deck

contains

  !> Does what the command line asks for and leaves with the exit code. storage, where
  !> allocated, keeps fields and restart files; a program without it becomes the one that has it
  !> when a scene asks for them. team: ranks that share the work of steps.
  subroutine run_deck(storage, team)
    class(storage_t), allocatable, intent(inout) :: storage
    class(team_t), target, intent(inout), optional :: team
    type(arguments_t) :: arguments
    type(run_t), allocatable, target :: run
    type(status_t) :: status
    call watch_limits()
    allocate (run)
    call move_alloc(storage, run%storage)
    if (present(team)) run%team => team
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
      call complete_table(run%deck%table)
      call tell_keywords(run%deck%table, arguments, status)
    else
      call work(arguments, run, status)
    end if
    if (failed(status)) write (error_unit, '(a)') 'bipact: '//status_text(status)
    deallocate (run)
    if (present(team)) call team%dismiss()
    call leave(status%code)
  end subroutine run_deck

  !> Prints the table of keywords, or the one that is named.
  subroutine tell_keywords(table, arguments, status)
    type(table_t), intent(inout) :: table
    type(arguments_t), intent(in) :: arguments
    type(status_t), intent(inout) :: status
    character(:), allocatable :: name
    integer :: row, head, distance
    if (.not. allocated(arguments%deck)) then
      call write_keywords(table, output_unit)
      return
    end if
    name = upper(arguments%deck)
    if (name(1:1) == '*') name = name(2:)
    call match_name(table, name, row, head)
    if (row > 0) then
      call write_keyword(table, row, output_unit)
    else
      call find_nearest(table, name, row, distance)
      call fail(status, status_deck, 'unknown keyword *'//name, &
          hint='the nearest known one is *'//trim(table%keyword(row)%name))
    end if
  end subroutine tell_keywords

  subroutine work(arguments, run, status)
    type(arguments_t), intent(inout) :: arguments
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    character(:), allocatable :: sibling
    integer :: k
    run%quiet = arguments%quiet
    run%folder = stem_of(arguments%deck)//'.out'
    if (allocated(arguments%folder)) run%folder = arguments%folder
    if (deck_mentions_storage(arguments, run)) call exec_hdf5_program('hdf5', sibling)
    call read_scene(arguments%deck, arguments%override, run, status)
    if (arguments%threads > 0) run%solver_options%threads = arguments%threads
    if (.not. (failed(status) .or. arguments%plan .or. arguments%check)) &
        call need_storage(arguments, run, status)
    do k = 1, run%deck%problems%count
      write (error_unit, '(a)') run%deck%problems%problem(k)%text
    end do
    if (failed(status)) return
    call show_warnings(run%warnings)
    call choose_team(run, arguments%plan, status)
    if (failed(status)) return
    if (arguments%plan) call size_solver(run, status)
    if (arguments%plan .or. arguments%check) then
      call tell_scene(arguments, run)
      if (arguments%plan .and. .not. (run%quiet .or. failed(status))) then
        call write_solver(run%solver, output_unit)
        call make_forecast(run, .false., run%forecast)
        call write_forecast(run%forecast, output_unit)
      end if
      return
    end if
    call prepare(run, status)
    ! A restart file may belong to another deck, which is compared with this one later.
    if (.not. allocated(arguments%restart)) call write_aside(run, status)
    call start_factor(run, status)
    if (failed(status)) then
      call drop_echo(run, status)
      if (status%code == status_numerical) call tell_failed_start(run, status)
      return
    end if
    call compute(arguments, run, status)
  end subroutine work

  !> The ranks work where the deck leaves the solver to them; where there is one, it works as
  !> the serial program does.
  subroutine choose_team(run, is_plan, status)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: is_plan
    type(status_t), intent(inout) :: status
    logical :: is_asked
    is_asked = run%solver_options%engine == engine_ranks
    if (is_plan) nullify (run%team)
    if (is_asked .and. is_plan) run%solver_options%engine = 'AUTO'
    if (is_asked .or. .not. associated(run%team)) return
    if (run%team%ranks > 1 .and. run%solver_options%engine == 'AUTO') then
      call add_message(run%notes, '', to_text(run%team%ranks)//' ranks share elements and '// &
          'factor; they add in another order each time, so that runs agree to round-off')
      return
    end if
    if (run%team%ranks > 1) call add_message(run%notes, '', 'ENGINE '// &
        trim(run%solver_options%engine)//' works on one rank; the other '// &
        to_text(run%team%ranks - 1)//' wait')
    nullify (run%team)
  end subroutine choose_team

  !> What the deck says, without running it; warnings have gone to the screen.
  subroutine tell_scene(arguments, run)
    type(arguments_t), intent(in) :: arguments
    type(run_t), intent(in) :: run
    integer :: k
    if (run%quiet) return
    if (arguments%check) write (output_unit, '(a)') arguments%deck//': the deck is valid'
    do k = 1, run%notes%n
      write (output_unit, '(a)') 'NOTE '//run%notes%item(k)%text
    end do
    call write_plan(run, output_unit)
    call write_kinds(run, output_unit)
  end subroutine tell_scene

  !> A look at the beginning of the deck, which saves reading it twice: does it name fields or
  !> restarts? Where it does not, the scene will tell.
  logical function deck_mentions_storage(arguments, run)
    type(arguments_t), intent(in) :: arguments
    type(run_t), intent(in) :: run
    integer(i8), parameter :: most = 65536_i8
    character(:), allocatable :: text
    integer(i8) :: size
    integer :: unit, ios
    deck_mentions_storage = .false.
    if (allocated(run%storage) .or. arguments%plan .or. arguments%check) return
    size = min(most, file_size(arguments%deck))
    if (size < 1_i8) return
    allocate (character(size) :: text)
    open (newunit=unit, file=arguments%deck, access='stream', form='unformatted', &
        status='old', action='read', iostat=ios)
    if (ios == 0) read (unit, iostat=ios) text
    close (unit, iostat=ios)
    deck_mentions_storage = index(text, new_line('a')//'*BIPACT_FIELD') > 0 .or. &
        index(text, new_line('a')//'*BIPACT_RESTART') > 0
  end function deck_mentions_storage

  !> Fields and restarts need the program that is linked with HDF5, which is looked for beside
  !> the file of this one (not beside a link to it): it starts from the beginning.
  subroutine need_storage(arguments, run, status)
    type(arguments_t), intent(in) :: arguments
    type(run_t), intent(in) :: run
    type(status_t), intent(inout) :: status
    character(:), allocatable :: path
    if (allocated(run%storage)) return
    if (.not. (run%plan%fields .or. run%plan%restarts .or. allocated(arguments%restart))) return
    call exec_hdf5_program('hdf5', path)
    if (file_exists(path)) then
      call fail(status, status_file, 'field files and restarts need the program "'//path// &
          '", which cannot be started', hint='is it executable, and built for this machine?')
    else
      call fail(status, status_file, 'field files and restarts need the program "'//path// &
          '", which is not there', hint='it belongs beside bipact: "make" builds both '// &
          'where HDF5 is there ("make deps" installs it), "make install" copies both')
    end if
  end subroutine need_storage

  !> The deck as understood goes to its file before the factor takes memory.
  subroutine write_aside(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    call run%timers%enter(phase_output)
    call put_echo(run, status)
    call forget_cards(run%deck)
    call run%timers%enter(phase_other)
  end subroutine write_aside

  !> A run that fails before its first step has no log and no tables; its summary says why.
  subroutine tell_failed_start(run, status)
    type(run_t), intent(in) :: run
    type(status_t), intent(inout) :: status
    type(status_t) :: folder
    type(totals_t) :: totals
    call make_folder(run%folder, folder)
    if (failed(folder)) return
    call find_totals(run, totals)
    call write_run_summary(run, totals, status)
  end subroutine tell_failed_start

  subroutine compute(arguments, run, status)
    type(arguments_t), intent(in) :: arguments
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    type(status_t) :: closing, last_frames
    call run%timers%enter(phase_output)
    if (allocated(arguments%restart)) call put_echo(run, status)
    if (failed(status)) return
    call start_storage(arguments, run, status)
    if (failed(status)) return
    call remove_run_summary(run%folder)
    call open_log(run, status)
    call open_tables(run%tables, run%model, run%folder, run%scheme%has_acceleration, &
        allocated(run%restarted), status)
    if (failed(status)) return
    call clear_storage(run)
    call run%timers%enter(phase_other)
    call watch_signals(run%plan%restarts .and. run%model%requests%restart%on_signal)
    call make_forecast(run, .true., run%forecast)
    call write_forecast(run%forecast, run%log_unit)
    call go_through_steps(run, status)
    call run%timers%enter(phase_output)
    call close_tables(run%tables, ending_of(status), run%state%cycle, closing)
    if (run%plan%fields) call end_segment(run, last_frames)
    call run%timers%enter(phase_other)
    if (.not. failed(closing)) closing = last_frames
    ! A file that was lost says more than the signal that ended the run.
    if (.not. failed(status) .or. (failed(closing) .and. status%code == status_stopped)) &
        status = closing
    call close_log(run, status)
  end subroutine compute

  !> What fields and restarts need; the run goes on from where a restart file left it.
  subroutine start_storage(arguments, run, status)
    type(arguments_t), intent(in) :: arguments
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    if (run%plan%fields) call start_frames(run)
    if (run%plan%restarts .or. allocated(arguments%restart)) call start_restarts(run, status)
    if (failed(status) .or. .not. allocated(arguments%restart)) return
    call resume(run, arguments%restart, status)
    call forget_cards(run%deck)
    if (failed(status)) call remove_file(scratch_path(run))
  end subroutine start_storage

  !> Files of an earlier run go, or those beyond the restart.
  subroutine clear_storage(run)
    type(run_t), intent(in) :: run
    call remove_file(join_path(run%folder, 'restart.tmp'))
    call remove_file(join_path(run%folder, 'fields.xdmf.tmp'))
    if (allocated(run%restarted)) then
      call remove_restarts(run%folder, run%state%cycle)
      if (run%plan%fields) call remove_segments(run%folder, run%fields%segment)
    else
      call remove_restarts(run%folder, -1)
      call remove_segments(run%folder, 0)
    end if
  end subroutine clear_storage

end module run_program
