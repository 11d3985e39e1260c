! SPDX-License-Identifier: BSD-3-Clause
!> summary.json: how a run ended, for scripts (doc/output.md has the table).
module run_summary
  use base_checksum, only: checksum_of_text
  use base_files, only: open_text, close_text, move_file, remove_file
  use base_json, only: json_t
  use base_kinds, only: wp, zero, i8
  use base_status, only: status_t, failed, status_text, status_ok, status_stopped
  use base_strings, only: join_path
  use base_system, only: peak_memory
  use base_timers, only: phase_count, phase_name
  use base_version, only: version
  use contact_rows, only: row_edge, row_vertex, row_second, row_wall, row_guided, &
      row_mortar
  use deck_data, only: deck_t
  use run_data, only: run_t
  implicit none
  private

  !> What the log and summary.json tell beyond what the run counts by itself.
  type, public :: totals_t
    real(wp) :: cpu = zero              !< processor seconds of the process
    integer(i8) :: peak_memory = -1_i8  !< bytes; -1 unknown
    integer :: short_steps = 0          !< of all purses
  end type totals_t

  public :: find_totals, ending_of, write_run_summary, remove_run_summary

  !> Of the layout: it rises when a member is taken away or changes its meaning.
  integer, parameter :: schema = 1
  character(*), parameter :: name = 'summary.json', scratch = 'summary.tmp'

contains

  !> The totals at this moment.
  subroutine find_totals(run, totals)
    type(run_t), intent(in) :: run
    type(totals_t), intent(out) :: totals
    integer :: p
    call cpu_time(totals%cpu)
    totals%peak_memory = peak_memory()
    if (.not. allocated(run%contact%pairing)) return
    do p = 1, size(run%contact%pairing)
      totals%short_steps = totals%short_steps + run%contact%pairing(p)%item%purse%short_steps
    end do
  end subroutine find_totals

  !> How a run ended, as tables and summary.json say it.
  pure function ending_of(status) result(ending)
    type(status_t), intent(in) :: status
    character(:), allocatable :: ending
    ending = 'failed'
    if (status%code == status_ok) ending = 'done'
    if (status%code == status_stopped) ending = 'stopped'
  end function ending_of

  !> Removes the summary of an earlier run, which must not pass for that of this one.
  subroutine remove_run_summary(folder)
    character(*), intent(in) :: folder
    call remove_file(join_path(folder, name))
    call remove_file(join_path(folder, scratch))
  end subroutine remove_run_summary

  !> Writes summary.json, first under another name: there is never half of it. status is how the
  !> run ended; a file that cannot be written becomes its failure unless there is one.
  subroutine write_run_summary(run, totals, status)
    type(run_t), intent(in) :: run
    type(totals_t), intent(in) :: totals
    type(status_t), intent(inout) :: status
    type(status_t) :: writing
    type(json_t) :: json
    integer :: unit
    call fill(json, run, totals, status)
    call open_text(join_path(run%folder, scratch), unit, writing)
    if (.not. failed(writing)) then
      write (unit, '(a)') json%text()
      call close_text(join_path(run%folder, scratch), unit, writing)
    end if
    if (.not. failed(writing)) &
        call move_file(join_path(run%folder, scratch), join_path(run%folder, name), writing)
    if (.not. failed(writing)) return
    call remove_file(join_path(run%folder, scratch))
    if (.not. failed(status)) status = writing
  end subroutine write_run_summary

  subroutine fill(json, run, totals, status)
    type(json_t), intent(inout) :: json
    type(run_t), intent(in) :: run
    type(totals_t), intent(in) :: totals
    type(status_t), intent(in) :: status
    call json%open('{')
    call json%put(schema, 'schema')
    call json%put(version, 'version')
    call json%put(ending_of(status), 'status')
    call json%put(status%code, 'exit_code')
    if (failed(status)) call json%put(status_text(status), 'message')
    if (.not. failed(status)) call json%put_null('message')
    call put_deck(json, run%deck, run%model%title)
    if (allocated(run%restarted)) call json%put(run%restarted, 'restarted_from')
    if (.not. allocated(run%restarted)) call json%put_null('restarted_from')
    call put_scene(json, run)
    call json%put(run%state%cycle, 'steps')
    call json%put(run%state%time, 'time')
    call put_energies(json, run)
    call put_certificate(json, run)
    call put_warnings(json, run)
    call put_counts(json, run, totals)
    call json%put(totals%cpu, 'cpu')
    call put_phases(json, run)
    if (totals%peak_memory < 0_i8) call json%put_null('peak_memory')
    if (totals%peak_memory >= 0_i8) call json%put(totals%peak_memory, 'peak_memory')
    call json%close('}')
  end subroutine fill

  !> The files that were read, each with its checksum, and the values of the parameters: who
  !> finds both equal need not run the deck again.
  subroutine put_deck(json, deck, title)
    type(json_t), intent(inout) :: json
    type(deck_t), intent(in) :: deck
    character(*), intent(in) :: title
    integer :: k
    call json%open('{', 'deck')
    call json%put(deck%file(1)%path, 'path')
    call json%put(trim(title), 'title')
    call json%open('[', 'files')
    do k = 1, deck%files
      call json%open('{')
      call json%put(deck%file(k)%path, 'path')
      if (allocated(deck%file(k)%text)) then
        call json%put(len(deck%file(k)%text), 'bytes')
        call json%put(checksum_of_text(deck%file(k)%text), 'checksum')
      else
        call json%put(deck%file(k)%bytes, 'bytes')
        call json%put(deck%file(k)%checksum, 'checksum')
      end if
      call json%close('}')
    end do
    call json%close(']')
    call json%open('{', 'parameters')
    do k = 1, deck%parameters
      if (.not. is_shown(deck, k)) cycle
      call json%put(trim(deck%parameter(k)%text), trim(deck%parameter(k)%name))
    end do
    call json%close('}')
    call json%close('}')
  end subroutine put_deck

  !> Is a parameter the one to be named? Of those of one name it is that of all files, else the
  !> first.
  pure logical function is_shown(deck, k)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: k
    integer :: other
    is_shown = .false.
    do other = 1, deck%parameters
      if (other == k .or. deck%parameter(other)%name /= deck%parameter(k)%name) cycle
      if (deck%parameter(other)%file == 0) return
      if (other < k .and. deck%parameter(k)%file /= 0) return
    end do
    is_shown = .true.
  end function is_shown

  subroutine put_scene(json, run)
    type(json_t), intent(inout) :: json
    type(run_t), intent(in) :: run
    call json%open('{', 'scene')
    call json%put(run%model%mesh_nodes, 'nodes')
    call json%put(run%model%mesh%n, 'elements')
    call json%put(size(run%model%part), 'parts')
    call json%put(trim(run%model%controls%scheme), 'scheme')
    call json%put(trim(run%model%controls%mass), 'mass')
    call json%put(run%model%controls%dt, 'dt')
    call json%put(run%model%controls%end_time, 'end_time')
    call json%close('}')
  end subroutine put_scene

  !> The terms of the ledger, under the names of glstat.
  subroutine put_energies(json, run)
    type(json_t), intent(inout) :: json
    type(run_t), intent(in) :: run
    associate (l => run%ledger)
      call json%open('{', 'energies')
      call json%put(l%kinetic, 'kinetic')
      call json%put(l%internal, 'internal')
      call json%put(l%total, 'total')
      call json%put(l%initial, 'initial')
      call json%put(l%external, 'external')
      call json%put(l%motion, 'motion')
      call json%put(l%contact%friction, 'friction')
      call json%put(l%contact%normal, 'contact')
      call json%put(l%contact%unsolved, 'unsolved')
      call json%put(l%algorithmic, 'algorithmic')
      call json%put(l%damping, 'damping')
      if (allocated(run%newton)) call json%put(l%plastic, 'plastic')
      call json%put(l%residual, 'residual')
      call json%put(l%worst_residual, 'worst_residual')
      call json%put(l%ratio, 'ratio')
      call json%close('}')
    end associate
  end subroutine put_energies

  !> The worst certificate of the run; null without contact.
  subroutine put_certificate(json, run)
    type(json_t), intent(inout) :: json
    type(run_t), intent(in) :: run
    if (.not. run%plan%contact) then
      call json%put_null('certificate')
      return
    end if
    associate (t => run%contact%tally)
      call json%open('{', 'certificate')
      call json%put(t%worst%met, 'met')
      call json%put(t%worst%error, 'error')
      call json%put(t%worst%eta, 'eta')
      call json%put(t%overlap, 'penetration')
      call json%put(t%overlap_share, 'penetration_per_edge')
      call json%close('}')
    end associate
  end subroutine put_certificate

  subroutine put_warnings(json, run)
    type(json_t), intent(inout) :: json
    type(run_t), intent(in) :: run
    integer :: k
    call json%open('[', 'warnings')
    do k = 1, run%warnings%n
      associate (item => run%warnings%item(k))
        call json%put(item%kind//': '//item%text)
      end associate
    end do
    call json%close(']')
    call json%put(run%warnings%n, 'warning_count')
    call json%put(run%notes%n, 'note_count')
  end subroutine put_warnings

  subroutine put_counts(json, run, totals)
    type(json_t), intent(inout) :: json
    type(run_t), intent(in) :: run
    type(totals_t), intent(in) :: totals
    call json%open('{', 'counts')
    call json%put(run%factors, 'factors')
    call json%put(run%solves, 'solves')
    call json%put(run%step%halvings, 'steps_halved')
    call json%put(run%step%cuts, 'steps_cut')
    associate (t => run%contact%tally)
      call json%put(t%searches, 'contact_searches')
      call json%put(t%solves, 'contact_solves')
      call json%put(t%sweeps, 'sweeps')
      call json%put(t%rows(row_edge), 'rows_edge')
      call json%put(t%rows(row_vertex), 'rows_vertex')
      call json%put(t%rows(row_second), 'rows_second')
      call json%put(t%rows(row_wall) + t%rows(row_guided), 'rows_wall')
      call json%put(t%rows(row_mortar), 'rows_mortar')
      call json%put(t%allowances, 'rows_with_allowance')
      call json%put(t%late_rows, 'late_rows')
      call json%put(t%new_frames, 'frames_redone')
      call json%put(t%repeats, 'purse_repeats')
      call json%put(totals%short_steps, 'short_purse_steps')
      call json%put(t%redone, 'steps_redone')
    end associate
    if (allocated(run%fields)) call json%put(run%fields%frames, 'frames')
    if (.not. allocated(run%fields)) call json%put(0, 'frames')
    call json%put(run%restart_files, 'restart_files')
    call json%close('}')
  end subroutine put_counts

  !> Where the time went.
  subroutine put_phases(json, run)
    type(json_t), intent(inout) :: json
    type(run_t), intent(in) :: run
    integer :: k
    call json%open('{', 'phases')
    do k = 1, phase_count
      call json%open('{', trim(phase_name(k)))
      call json%put(run%timers%seconds(k), 'seconds')
      call json%put(run%timers%calls(k), 'calls')
      call json%close('}')
    end do
    call json%close('}')
  end subroutine put_phases

end module run_summary
