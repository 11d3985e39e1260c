! SPDX-License-Identifier: BSD-3-Clause
!> How a run goes on from a restart file, bit for bit: which file, whether this deck may, and
!> the state. The deck may differ in what no step depends on: the end, output, what is judged.
module run_resume
  use base_archive, only: archive_t, archive_restore
  use base_checksum, only: checksum_of_text
  use base_files, only: path_length
  use base_messages, only: add_message
  use base_kinds, only: wp, zero
  use base_status, only: status_t, fail, failed, status_text, status_file
  use base_strings, only: to_text
  use base_version, only: version
  use contact_monitor, only: check_listed
  use deck_data, only: deck_t
  use deck_difference, only: compare_decks, differences_t, most_told
  use deck_keywords, only: complete_table
  use deck_names, only: table_ncforc, table_spcforc
  use deck_reader, only: read_deck_text
  use output_storage, only: restart_header_t
  use output_table, only: next_due, table_file_t
  use output_tables, only: check_tables, retime_tables
  use run_data, only: run_t
  use run_frames, only: check_segments
  use run_motion, only: hold_active, start_reactions
  use run_restart, only: origin_t, exchange_run, list_restarts, time_told, pairs_left_out
  use run_operator, only: renew_matrix
  use run_setup, only: start_dynamics
  use run_step, only: exchange_step, plan_from_here
  implicit none
  private
  public :: resume

contains

  !> Puts a run that has been set up to where a restart file left it: just after a step, of
  !> which nothing is written yet. file: its path, or "latest": the newest good one in the
  !> folder of the run.
  subroutine resume(run, file, status)
    type(run_t), intent(inout) :: run
    character(*), intent(in) :: file
    type(status_t), intent(inout) :: status
    logical :: may_try_older
    if (file == 'latest') then
      call restore_latest(run, status)
    else
      call restore(run, file, may_try_older, status)
    end if
    if (.not. failed(status)) call factor_again(run, status)
  end subroutine resume

  !> Tries one after the other from the newest; the log will tell why some were passed over.
  !> Where none will do, the reason of the newest is given. A deck that does not go with a good
  !> file ends the search: going back further is for a person to say.
  subroutine restore_latest(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    character(path_length), allocatable :: paths(:)
    type(status_t) :: trial
    logical :: may_try_older
    integer :: k
    call list_restarts(run%folder, paths)
    if (size(paths) == 0) call fail(status, status_file, 'no restart file in "'// &
        run%folder//'"', hint='*BIPACT_RESTART makes a run write them')
    do k = size(paths), 1, -1
      trial = status_t()
      call restore(run, trim(paths(k)), may_try_older, trial)
      if (.not. (failed(trial) .and. may_try_older)) exit
      if (.not. failed(status)) status = trial
      call add_message(run%notes, '', 'restart: "'//trim(paths(k))//'" is passed over: '// &
          status_text(trial))
    end do
    if (size(paths) == 0) return
    if (failed(trial) .and. may_try_older) then
      status%hint = 'none of the '//to_text(size(paths))//' restart files there can be used'
    else
      status = trial
    end if
  end subroutine restore_latest

  !> The state of a run from a restart file; fails where it, or what lies beside it, will not do
  !> (an older file may), or where it does not go with the deck.
  subroutine restore(run, path, may_try_older, status)
    type(run_t), intent(inout) :: run
    character(*), intent(in) :: path
    logical, intent(out) :: may_try_older
    type(status_t), intent(inout) :: status
    type(archive_t) :: archive
    type(restart_header_t) :: header
    type(origin_t) :: origin
    may_try_older = .true.
    call load(run, path, header, archive, status)
    if (failed(status)) return
    may_try_older = .false.
    call check_deck(run, path, header, status)
    if (.not. failed(status)) call find_step(run, archive, status)
    if (.not. failed(status)) call check_end(run, path, header, status)
    if (failed(status)) return
    may_try_older = .true.
    run%restarted = path
    if (run%static_steps > 0 .and. .not. run%step%is_static) then
      call start_dynamics(run, status)
      run%first_cycle = run%static_steps
      run%ledger%staggered = run%scheme%staggered
    end if
    call archive%rewind(archive_restore)
    call exchange_run(archive, run, origin)
    status = archive%status
    if (failed(status)) return
    if (origin%left_out /= pairs_left_out(run)) call fail(status, status_file, &
        'cannot restart from "'//path//'": to this ENDTIM a contact acts that takes parts '// &
        'from the card of all parts, which had them in the run so far', &
        hint='start anew, or end the run before that contact is born')
    call retime_tables(run%tables, run%model, time_told(run), run%model%controls%dt, &
        run%notes)
    call begin_late_tables(run, origin)
    call note_cut_step(run, origin)
    call check_tables(run%tables, run%model, run%folder, status)
    if (run%plan%fields) call check_segments(run, status)
    if (origin%new_nodal .and. run%contact%listed > 0) call check_listed(run%model, &
        run%contact, run%state%u, run%state%du, run%state%cycle, status)
    if (run%plan%motions) call hold_active(run)
    if (origin%new_reactions) call start_reactions(run)
    run%scheme%is_current = .false.
  end subroutine restore

  !> Where the run stands in its steps, and those to its end, which may be another one now.
  subroutine find_step(run, archive, status)
    type(run_t), intent(inout) :: run
    type(archive_t), intent(inout) :: archive
    type(status_t), intent(inout) :: status
    call archive%rewind(archive_restore)
    call exchange_step(archive, run%step)
    if (.not. failed(status)) status = archive%status
    call plan_from_here(run)
  end subroutine find_step

  !> A good file of this version.
  subroutine load(run, path, header, archive, status)
    type(run_t), intent(inout) :: run
    character(*), intent(in) :: path
    type(restart_header_t), intent(inout) :: header
    type(archive_t), intent(inout) :: archive
    type(status_t), intent(inout) :: status
    call run%storage%load_restart(path, header, archive, status)
    if (failed(status)) return
    if (header%version /= version) call fail(status, status_file, 'cannot restart from "'// &
        path//'": version '//header%version//' of bipact wrote it, this is '//version)
    if (checksum_of_text(header%echo) /= header%deck_hash) call fail(status, status_file, &
        'cannot restart from "'//path//'": its deck is not the one that its first line names')
  end subroutine load

  !> Fails where steps so far would have been others with this deck; notes what differs else.
  subroutine check_deck(run, path, header, status)
    type(run_t), intent(inout) :: run
    character(*), intent(in) :: path
    type(restart_header_t), intent(in) :: header
    type(status_t), intent(inout) :: status
    type(deck_t), allocatable :: old
    type(differences_t) :: found
    character(:), allocatable :: text
    integer :: k
    if (header%deck_hash == run%deck_hash) return
    allocate (old)
    call complete_table(run%deck%table)
    old%table = run%deck%table
    call read_deck_text(path, header%echo, old)
    if (old%problems%count > 0) then
      call fail(status, status_file, 'cannot restart from "'//path//'": the deck in it '// &
          'cannot be read: '//old%problems%problem(1)%text)
      return
    end if
    call compare_decks(old, run%deck, found)
    text = ''
    do k = 1, min(found%refused, most_told)
      text = text//new_line('a')//'    '//found%refusal(k)%text
    end do
    if (found%refused > most_told) text = text//new_line('a')//'    and '// &
        to_text(found%refused - most_told)//' more'
    if (found%refused > 0) call fail(status, status_file, 'cannot restart from "'//path// &
        '": it belongs to another deck; these differences change the steps so far:'//text, &
        hint='the end, output and restart cards may differ (doc/output.md), nothing else')
    do k = 1, min(found%allowed, most_told)
      call add_message(run%notes, '', 'restart: '//found%note(k)%text)
    end do
    if (found%allowed > most_told) call add_message(run%notes, '', 'restart: '// &
        to_text(found%allowed - most_told)//' more differences of output')
  end subroutine check_deck

  !> The end must not lie before the file.
  subroutine check_end(run, path, header, status)
    type(run_t), intent(in) :: run
    character(*), intent(in) :: path
    type(restart_header_t), intent(in) :: header
    type(status_t), intent(inout) :: status
    character(:), allocatable :: what
    logical :: is_before
    call check_step(run, path, header, status)
    associate (s => run%step, c => run%model%controls)
      is_before = s%done < s%full_steps .or. &
          (s%done == s%full_steps .and. .not. s%share > zero)
      if (c%end_cycle > 0) is_before = is_before .and. header%cycle <= c%end_cycle
    end associate
    if (is_before) return
    associate (c => run%model%controls)
      what = 'ENDTIM '//to_text(c%end_time)
      if (c%end_cycle == run%plan%full_steps) what = 'ENDCYC '//to_text(c%end_cycle)
    end associate
    call fail(status, status_file, 'cannot restart from "'//path//'": *CONTROL_TERMINATION '// &
        what//' lies before the file, step '//to_text(header%cycle)//', time '// &
        to_text(header%time), hint='name an older restart file, or start anew')
  end subroutine check_end

  !> A step that is found from ENDTIM must be that of the run so far.
  subroutine check_step(run, path, header, status)
    type(run_t), intent(in) :: run
    character(*), intent(in) :: path
    type(restart_header_t), intent(in) :: header
    type(status_t), intent(inout) :: status
    associate (dt => run%model%controls%dt)
      if (.not. run%model%controls%is_explicit) return
      if (.not. abs(header%time - header%cycle*dt) > zero) return
      call fail(status, status_file, 'cannot restart from "'//path//'": its steps were '// &
          'others than those of '//to_text(dt)//' that a blank DT0 makes of this ENDTIM', &
          hint='with DT0 given from the start ENDTIM may change')
    end associate
  end subroutine check_step

  !> Tables that need what was not kept of the step: their rows begin after it.
  subroutine begin_late_tables(run, origin)
    type(run_t), intent(inout) :: run
    type(origin_t), intent(in) :: origin
    if (origin%new_nodal) call leave_out_row(run, run%tables%file(table_ncforc), &
        run%model%requests%interval(table_ncforc))
    if (origin%new_reactions) call leave_out_row(run, run%tables%file(table_spcforc), &
        run%model%requests%interval(table_spcforc))
  end subroutine begin_late_tables

  subroutine leave_out_row(run, file, interval)
    type(run_t), intent(in) :: run
    type(table_file_t), intent(inout) :: file
    real(wp), intent(in) :: interval
    file%no_row_at = run%state%cycle
    file%next = next_due(interval, run%state%time, run%model%controls%dt)
  end subroutine leave_out_row

  !> Tells where the run so far went on by a cut step that this one does not have.
  subroutine note_cut_step(run, origin)
    type(run_t), intent(inout) :: run
    type(origin_t), intent(in) :: origin
    if (origin%full_steps /= run%step%done .or. .not. origin%last_step > zero) return
    if (run%step%full_steps == origin%full_steps .and. &
        .not. abs(run%step%last_step - origin%last_step) > zero) return
    call add_message(run%notes, '', 'restart: the run so far ended with a step cut to '// &
        to_text(origin%last_step)//'; this one goes on from the file before it, step '// &
        to_text(run%state%cycle)//', and that step is done anew')
  end subroutine note_cut_step

  !> The matrix is factored for the block of nodes and the held dofs that were in force then,
  !> and the counts are those of the run that stopped.
  subroutine factor_again(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    integer :: counts(2)
    counts = [run%factors, run%analyses]
    if (run%state%h_last > zero) call run%scheme%set_step(run%state%h_last)
    call renew_matrix(run, .true., status)
    run%factors = counts(1)
    run%analyses = counts(2)
    call system_clock(run%restart_tick)
  end subroutine factor_again

end module run_resume
