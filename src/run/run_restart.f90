! SPDX-License-Identifier: BSD-3-Clause
!> Restart files: when one is due and what it holds. Only scenes that ask for them come here.
module run_restart
  use assembly_bending, only: exchange_bending
  use base_archive, only: archive_t, archive_save
  use base_checksum, only: checksum_of_text
  use base_files, only: open_text, close_text, list_files, move_file, remove_file, sync_file, &
      path_length
  use base_kinds, only: wp, zero, i8
  use base_signal, only: restart_asked
  use base_status, only: status_t, failed
  use base_strings, only: join_path
  use base_timers, only: phase_output, phase_other
  use base_version, only: version
  use deck_source, only: source_file_t, load_file
  use output_storage, only: restart_header_t
  use output_tables, only: flush_tables, exchange_tables
  use run_arguments, only: command_to_go_on
  use run_data, only: run_t
  use run_echo, only: scratch_path
  use run_frames, only: end_segment, exchange_frames
  use run_step, only: at_end, exchange_step, exchange_moment
  implicit none
  private
  public :: start_restarts, keep_restart, exchange_run, time_told, list_restarts, &
      remove_restarts, pairs_left_out, how_to_go_on

  !> What a restart file tells of the run that wrote it beyond its state: where it was to end,
  !> which pairs of parts cards of all parts left to others, what it did not keep of the step.
  type, public :: origin_t
    integer :: full_steps = 0
    real(wp) :: last_step = zero    !< length of a cut last step; 0 = none [T]
    integer :: left_out = 0
    logical :: new_nodal = .false., new_reactions = .false.
  end type origin_t

contains

  !> The deck as understood, which put_echo has written, and its hash. The clock starts.
  subroutine start_restarts(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    type(source_file_t) :: echo
    call load_file(scratch_path(run), echo, status)
    if (failed(status)) call remove_file(scratch_path(run))
    if (failed(status)) return
    call move_alloc(echo%text, run%echo)
    run%deck_hash = checksum_of_text(run%echo)
    call system_clock(run%restart_tick)
  end subroutine start_restarts

  !> A restart file, if one is due after this step, before anything is told of the step: what is
  !> written at the end of a run need not be in a longer one. The end leaves one, and the step
  !> before a last one that is cut, which a longer run does not have; so does a stop by a
  !> signal.
  subroutine keep_restart(run, stopped, status)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: stopped
    type(status_t), intent(inout) :: status
    logical :: due
    if (failed(status)) return
    associate (s => run%step)
      if (s%done > s%full_steps .or. (s%done == s%full_steps .and. s%share > zero)) return
      due = s%done == s%full_steps .or. at_end(run)
    end associate
    if (restart_asked()) due = .true.
    associate (r => run%model%requests%restart)
      due = due .or. (stopped .and. r%on_signal)
      if (r%steps > 0 .and. run%state%cycle > 0) &
          due = due .or. mod(run%state%cycle, r%steps) == 0
      if (r%wall > zero .and. .not. due) due = seconds_since(run%restart_tick) >= r%wall
    end associate
    if (due) call write_restart(run, status)
  end subroutine keep_restart

  real(wp) function seconds_since(tick)
    integer(i8), intent(in) :: tick
    integer(i8) :: now, rate
    call system_clock(now, rate)
    seconds_since = real(now - tick, wp)/real(rate, wp)
  end function seconds_since

  !> Tables to their files, the segment of fields closed, then the file: first under another
  !> name, then in one stroke under its own. The oldest beyond KEEP go.
  subroutine write_restart(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    type(archive_t) :: archive
    type(restart_header_t) :: header
    type(origin_t) :: origin
    character(:), allocatable :: scratch
    call run%timers%enter(phase_output)
    call flush_tables(run%tables, status)
    if (run%plan%fields) call end_segment(run, status)
    run%restart_files = run%restart_files + 1
    call archive%rewind(archive_save)
    call exchange_run(archive, run, origin)
    header%cycle = run%state%cycle
    header%time = run%state%time
    header%deck_hash = run%deck_hash
    header%version = version
    scratch = join_path(run%folder, 'restart.tmp')
    call move_alloc(run%echo, header%echo)      ! else a large deck would be there twice
    if (.not. failed(status)) call run%storage%save_restart(scratch, header, archive, status)
    call move_alloc(header%echo, run%echo)
    if (.not. failed(status)) &
        call move_file(scratch, restart_path(run%folder, header%cycle), status)
    if (failed(status)) then
      call remove_file(scratch)
      run%restart_files = run%restart_files - 1
    else
      call sync_file(run%folder, status)
      call drop_old(run%folder, run%model%requests%restart%keep)
    end if
    call system_clock(run%restart_tick)
    call run%timers%enter(phase_other)
  end subroutine write_restart

  function restart_path(folder, cycle) result(path)
    character(*), intent(in) :: folder
    integer, intent(in) :: cycle
    character(:), allocatable :: path
    character(10) :: digits
    write (digits, '(i10.10)') cycle
    path = join_path(folder, 'restart.'//digits//'.h5')
  end function restart_path

  !> The restart files of a folder, the newest last.
  subroutine list_restarts(folder, paths)
    character(*), intent(in) :: folder
    character(path_length), allocatable, intent(out) :: paths(:)
    call list_files(folder, 'restart.??????????.h5', paths)
  end subroutine list_restarts

  subroutine drop_old(folder, keep)
    character(*), intent(in) :: folder
    integer, intent(in) :: keep
    character(path_length), allocatable :: paths(:)
    integer :: k
    call list_restarts(folder, paths)
    do k = 1, size(paths) - keep
      call remove_file(trim(paths(k)))
    end do
  end subroutine drop_old

  !> Removes the restart files of a folder beyond a cycle.
  subroutine remove_restarts(folder, cycle)
    character(*), intent(in) :: folder
    integer, intent(in) :: cycle
    character(path_length), allocatable :: paths(:)
    character(:), allocatable :: last
    integer :: k
    last = restart_path(folder, cycle)
    call list_restarts(folder, paths)
    do k = 1, size(paths)
      if (cycle < 0 .or. trim(paths(k)) > last) call remove_file(trim(paths(k)))
    end do
  end subroutine remove_restarts

  !> Everything that the steps to come depend on, saved or restored, and what stands on file of
  !> those before the last.
  subroutine exchange_run(archive, run, origin)
    type(archive_t), intent(inout) :: archive
    type(run_t), intent(inout) :: run
    type(origin_t), intent(inout) :: origin
    origin%full_steps = run%step%full_steps
    origin%last_step = run%step%last_step
    call exchange_step(archive, run%step)
    call archive%exchange('origin.full_steps', origin%full_steps)
    call archive%exchange('origin.last_step', origin%last_step)
    origin%left_out = pairs_left_out(run)
    call archive%exchange('origin.left_out', origin%left_out)
    call exchange_moment(archive, run, origin%new_nodal, origin%new_reactions)
    if (allocated(run%bending)) call exchange_bending(archive, run%bending)
    call exchange_tables(archive, run%tables)
    call exchange_frames(archive, run, time_told(run))
    call exchange_progress(archive, run)
  end subroutine exchange_run

  !> How many pairs of parts contact cards leave out, which depends on the end time.
  pure integer function pairs_left_out(run)
    type(run_t), intent(in) :: run
    integer :: k
    pairs_left_out = 0
    do k = 1, size(run%model%contact)
      if (allocated(run%model%contact(k)%leaves_out)) pairs_left_out = pairs_left_out + &
          count(run%model%contact(k)%leaves_out)
    end do
  end function pairs_left_out

  !> Counts of the log, and what warnings tell.
  subroutine exchange_progress(archive, run)
    type(archive_t), intent(inout) :: archive
    type(run_t), intent(inout) :: run
    integer :: counts(7)
    counts = [run%factors, run%analyses, run%solves, run%rotation_element, run%restart_files, &
        run%rotations, run%open_balances]
    call archive%exchange('run.counts', counts)
    run%factors = counts(1)
    run%analyses = counts(2)
    run%solves = counts(3)
    run%rotation_element = counts(4)
    run%restart_files = counts(5)
    run%rotations = counts(6)
    run%open_balances = counts(7)
    call archive%exchange('run.first_warned', run%first_warned)
    call archive%exchange('run.first_time', run%first_time)
    call archive%exchange('run.rotation', run%rotation)
    call archive%exchange('run.looked', run%looked)
  end subroutine exchange_progress

  !> Up to where [T] rows and frames were written when a restart file was: the step before it;
  !> negative at the start.
  pure real(wp) function time_told(run)
    type(run_t), intent(in) :: run
    time_told = run%step%time_before
  end function time_told

  !> What to do after a signal has stopped the run.
  function how_to_go_on(run) result(hint)
    type(run_t), intent(in) :: run
    character(:), allocatable :: hint
    character(path_length), allocatable :: paths(:)
    hint = 'with *BIPACT_RESTART in the deck there would be a file to go on from'
    if (.not. run%plan%restarts) return
    call list_restarts(run%folder, paths)
    hint = 'there is no restart file: ONSIG of *BIPACT_RESTART writes one on signals'
    if (size(paths) > 0) hint = 'to go on: '//command_to_go_on()
  end function how_to_go_on

end module run_restart
