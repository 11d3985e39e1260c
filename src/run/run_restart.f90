! SPDX-License-Identifier: BSD-3-Clause
!> Restart files: when one is due, what it holds, and how a run goes on from it, bit for bit.
!> Only scenes that ask for them come here.
module run_restart
  use base_archive, only: archive_t, archive_save, archive_restore
  use base_checksum, only: checksum_of_file
  use base_files, only: open_text, close_text, list_files, move_file, remove_file, &
      sync_file, path_length
  use base_kinds, only: wp, zero, i8
  use base_signal, only: restart_asked
  use base_status, only: status_t, fail, failed, status_text, status_file
  use base_strings, only: join_path, to_text
  use base_timers, only: phase_output, phase_other
  use base_version, only: version
  use contact_archive, only: exchange_contact
  use deck_echo, only: write_echo
  use deck_problems, only: add_note
  use model_state, only: exchange_state
  use output_fields, only: fields_t
  use output_storage, only: restart_header_t
  use output_tables, only: flush_tables, exchange_tables, check_tables
  use run_data, only: run_t
  use run_frames, only: end_segment, check_segments
  use run_motion, only: hold_active
  use run_setup, only: factor_matrix
  use time_ledger, only: exchange_ledger
  implicit none
  private
  public :: start_restarts, keep_restart, resume, remove_restarts

contains

  !> Hash of the deck as understood, which is written as deck.echo.tmp for that and becomes
  !> deck.echo.k with the log: a restart that is refused leaves the folder as it was. The clock
  !> starts.
  subroutine start_restarts(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    character(:), allocatable :: path
    integer(i8) :: bytes
    integer :: unit
    path = join_path(run%folder, 'deck.echo.tmp')
    call open_text(path, unit, status)
    if (failed(status)) return
    call write_echo(run%deck, unit)
    call close_text(path, unit, status)
    if (.not. failed(status)) call checksum_of_file(path, 0, run%deck_hash, bytes, status)
    if (failed(status)) call remove_file(path)
    call system_clock(run%restart_tick)
  end subroutine start_restarts

  !> A restart file, if one is due after this step; always where `stopped` by a signal.
  subroutine keep_restart(run, last, stopped, status)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: last, stopped
    type(status_t), intent(inout) :: status
    logical :: due
    if (last .or. failed(status)) return
    due = stopped .and. run%model%requests%restart%on_signal
    if (restart_asked()) due = .true.
    associate (r => run%model%requests%restart)
      if (r%steps > 0) due = due .or. mod(run%state%cycle, r%steps) == 0
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
    character(:), allocatable :: scratch
    call run%timers%enter(phase_output)
    call flush_tables(run%tables, status)
    if (run%plan%fields) call end_segment(run, status)
    run%restart_files = run%restart_files + 1
    call archive%rewind(archive_save)
    call exchange_run(archive, run)
    header%cycle = run%state%cycle
    header%time = run%state%time
    header%deck_hash = run%deck_hash
    header%version = version
    scratch = join_path(run%folder, 'restart.tmp')
    if (.not. failed(status)) call run%storage%save_restart(scratch, header, archive, status)
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

  subroutine drop_old(folder, keep)
    character(*), intent(in) :: folder
    integer, intent(in) :: keep
    character(path_length), allocatable :: paths(:)
    integer :: k
    call list_files(folder, 'restart.??????????.h5', paths)
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
    call list_files(folder, 'restart.??????????.h5', paths)
    do k = 1, size(paths)
      if (cycle < 0 .or. trim(paths(k)) > last) call remove_file(trim(paths(k)))
    end do
  end subroutine remove_restarts

  !> Everything that the steps to come depend on, saved or restored.
  subroutine exchange_run(archive, run)
    type(archive_t), intent(inout) :: archive
    type(run_t), intent(inout) :: run
    integer :: counts(5)
    call exchange_state(archive, run%state)
    if (run%plan%contact) call exchange_contact(archive, run%contact)
    call exchange_ledger(archive, run%ledger)
    call exchange_tables(archive, run%tables)
    if (run%plan%fields) call exchange_frames(archive, run%fields)
    if (run%plan%reactions) then
      call archive%exchange('run.reaction', run%reaction)
      call archive%exchange('run.mean_reaction', run%mean_reaction)
    end if
    if (run%plan%motions) call archive%exchange('run.active', run%active_motion)
    counts = [run%factors, run%analyses, run%solves, run%rotation_element, run%restart_files]
    call archive%exchange('run.counts', counts)
    run%factors = counts(1)
    run%analyses = counts(2)
    run%solves = counts(3)
    run%rotation_element = counts(4)
    run%restart_files = counts(5)
    call archive%exchange('run.largest_motion', run%largest_motion)
    call archive%exchange('run.rotation', run%rotation)
    call archive%exchange('run.checked', run%checked)
  end subroutine exchange_run

  !> Frames so far; on the way back the next file is the one after the last of them.
  subroutine exchange_frames(archive, fields)
    type(archive_t), intent(inout) :: archive
    type(fields_t), intent(inout) :: fields
    integer :: counts(2)
    counts = [fields%frames, fields%segment]
    call archive%exchange('fields.counts', counts)
    call archive%exchange('fields.next', fields%next)
    fields%frames = counts(1)
    fields%segment = counts(2)
    if (archive%mode == archive_restore .and. fields%frames > size(fields%time)) then
      deallocate (fields%time, fields%segment_of)
      allocate (fields%time(2*fields%frames), fields%segment_of(2*fields%frames))
    end if
    if (archive%mode == archive_restore) then
      deallocate (fields%bytes)
      allocate (fields%bytes(fields%segment))
    end if
    call archive%exchange('fields.bytes', fields%bytes)
    call archive%exchange('fields.time', fields%time(:fields%frames))
    call archive%exchange('fields.segment_of', fields%segment_of(:fields%frames))
  end subroutine exchange_frames

  !> Puts a run that has been set up to where a restart file left it. file: its path, or
  !> "latest": the newest in the folder of the run that can be gone on from.
  subroutine resume(run, file, status)
    type(run_t), intent(inout) :: run
    character(*), intent(in) :: file
    type(status_t), intent(inout) :: status
    if (file == 'latest') then
      call restore_latest(run, status)
    else
      call restore(run, file, status)
    end if
    if (.not. failed(status)) call factor_again(run, status)
  end subroutine resume

  !> Tries one after the other from the newest; the log will tell why some were passed over.
  !> Where none will do, the reason of the newest is given.
  subroutine restore_latest(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    character(path_length), allocatable :: paths(:)
    type(status_t) :: trial
    integer :: k
    call list_files(run%folder, 'restart.??????????.h5', paths)
    if (size(paths) == 0) call fail(status, status_file, 'no restart file in "'// &
        run%folder//'"', hint='*BIPACT_RESTART makes a run write them')
    do k = size(paths), 1, -1
      trial = status_t()
      call restore(run, trim(paths(k)), trial)
      if (.not. failed(trial)) exit
      if (.not. failed(status)) status = trial
      call add_note(run%deck%problems, 'restart: "'//trim(paths(k))//'" is passed over: '// &
          status_text(trial))
    end do
    if (size(paths) == 0) return
    if (failed(trial)) then
      status%hint = 'none of the '//to_text(size(paths))//' restart files there can be used'
    else
      status = trial
    end if
  end subroutine restore_latest

  !> The state of a run from a restart file; fails where it, or what lies beside it, will not
  !> do.
  subroutine restore(run, path, status)
    type(run_t), intent(inout) :: run
    character(*), intent(in) :: path
    type(status_t), intent(inout) :: status
    type(archive_t) :: archive
    call load(run, path, archive, status)
    if (failed(status)) return
    run%restarted = path
    call archive%rewind(archive_restore)
    call exchange_run(archive, run)
    status = archive%status
    call check_tables(run%tables, run%model, run%folder, status)
    if (run%plan%fields) call check_segments(run, status)
  end subroutine restore

  subroutine load(run, path, archive, status)
    type(run_t), intent(inout) :: run
    character(*), intent(in) :: path
    type(archive_t), intent(inout) :: archive
    type(status_t), intent(inout) :: status
    type(restart_header_t) :: header
    call run%storage%load_restart(path, header, archive, status)
    if (failed(status)) return
    if (header%version /= version) call fail(status, status_file, 'cannot restart from "'// &
        path//'": version '//header%version//' of bipact wrote it, this is '//version)
    if (header%deck_hash /= run%deck_hash) call fail(status, status_file, &
        'cannot restart from "'//path//'": it belongs to another deck', &
        hint='the deck, its includes and -D must be those of the run that wrote it')
  end subroutine load

  !> The matrix is factored for the block of nodes and the held dofs that were in force then,
  !> and the counts are those of the run that stopped.
  subroutine factor_again(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    integer :: counts(2)
    if (run%plan%motions) call hold_active(run)
    counts = [run%factors, run%analyses]
    call factor_matrix(run, .true., status)
    run%factors = counts(1)
    run%analyses = counts(2)
    call system_clock(run%restart_tick)
  end subroutine factor_again

end module run_restart
