! SPDX-License-Identifier: BSD-3-Clause
!> The length of the steps. FIXED: all DT0, but for a last one that is cut to the end. HALVE: a
!> step that goes wrong is refused and done again with half its length, on the grid of DT0/2^k;
!> after four good ones the next are twice as long. EVENT: a step in which an open contact
!> closes is refused and ends at the touch, from where steps of DT0 go on. A refused step goes
!> back bitwise through the archive, in memory.
module run_step
  use base_archive, only: archive_t, archive_save, archive_restore
  use base_kinds, only: wp, zero, one, half
  use base_status, only: status_t, failed, status_numerical
  use contact_archive, only: exchange_contact
  use contact_touch, only: find_touch, gap_at_end
  use deck_names, only: step_halve, step_event
  use model_data, only: count_steps
  use model_state, only: exchange_state
  use run_data, only: run_t, step_control_t
  use run_motion, only: hold_active
  use run_damping, only: exchange_damping
  use run_newton, only: exchange_newton
  use run_operator, only: renew_matrix
  use time_ledger, only: exchange_ledger
  implicit none
  private
  public :: plan_from_here, at_end, starts_dynamics, share_of_run, begin_step, judge_step, &
      note_faults, exchange_step, exchange_moment

  !> Steps in a row after which they are twice as long.
  integer, parameter :: good_steps = 4
  !> No cut so near to the start or the end of a step, in shares of it.
  real(wp), parameter :: least_cut = 0.01_wp
  !> Two lengths of a step are the same.
  real(wp), parameter :: near = 1.0e-9_wp

contains

  !> How many steps of DT0 go from origin to the end.
  subroutine plan_from_here(run)
    type(run_t), intent(inout) :: run
    associate (s => run%step)
      s%full_steps = run%plan%full_steps
      s%last_step = run%plan%last_step
      if (s%origin > zero) call count_steps(run%model%controls%end_time - s%origin, &
          run%model%controls%dt, s%full_steps, s%last_step)
    end associate
  end subroutine plan_from_here

  !> Is the run at its end, in time or by the number of its steps?
  pure logical function at_end(run)
    type(run_t), intent(in) :: run
    associate (s => run%step, last => run%model%controls%end_cycle)
      at_end = s%done >= s%full_steps + merge(1, 0, s%last_step > zero)
      if (last > 0) at_end = at_end .or. run%state%cycle >= last
    end associate
  end function at_end

  !> Is this the end of a static phase?
  pure logical function starts_dynamics(run)
    type(run_t), intent(in) :: run
    starts_dynamics = run%step%is_static .and. run%step%done == run%static_steps
  end function starts_dynamics

  !> What is done of the run, in time or by the number of its steps.
  pure real(wp) function share_of_run(run)
    type(run_t), intent(in) :: run
    share_of_run = run%state%time/run%model%controls%end_time
    if (run%model%controls%end_cycle > 0) share_of_run = max(share_of_run, &
        real(run%state%cycle, wp)/run%model%controls%end_cycle)
  end function share_of_run

  !> The step to be tried: its end t1 and its length; another length is another effective
  !> matrix.
  subroutine begin_step(run, t1, status)
    type(run_t), intent(inout) :: run
    real(wp), intent(out) :: t1
    type(status_t), intent(inout) :: status
    real(wp) :: whole, h
    associate (s => run%step, c => run%model%controls)
      if (s%mode == step_halve) s%target = s%share + scale(one, -s%level)
      if (s%mode == step_event .and. s%tries == 0) s%target = one
      whole = whole_step(run)
      h = (s%target - s%share)*whole
      t1 = merge(c%end_time, s%origin + (s%done + 1)*c%dt, s%done == s%full_steps)
      if (s%target < one) t1 = s%origin + s%done*c%dt + s%target*whole
      s%time_before = run%state%time
      if (s%tries == 0 .and. may_be_refused(run)) call keep_moment(run)
      if (.not. (abs(h - run%scheme%h) > zero .or. s%new_interface)) return
      call run%scheme%set_step(h)
      if (allocated(run%newton)) run%x = zero    ! that of a refused step may be anything
      call renew_matrix(run, s%new_interface, status)
      s%new_interface = .false.
    end associate
  end subroutine begin_step

  !> Length of the step of DT0 that has begun [T]: the last one may be shorter.
  pure real(wp) function whole_step(run)
    type(run_t), intent(in) :: run
    associate (s => run%step)
      whole_step = merge(s%last_step, run%model%controls%dt, s%done == s%full_steps)
    end associate
  end function whole_step

  !> Can the step to be tried become a shorter one?
  pure logical function may_be_refused(run)
    type(run_t), intent(in) :: run
    associate (s => run%step, c => run%model%controls)
      select case (s%mode)
      case (step_halve)
        may_be_refused = s%level < c%most_halvings .and. &
            half*(s%target - s%share)*whole_step(run) >= (one - near)*c%shortest_step
      case (step_event)
        may_be_refused = run%plan%contact .and. .not. (s%is_static .or. s%was_cut)
      case default
        may_be_refused = .false.
      end select
    end associate
  end function may_be_refused

  !> After a step: it is done, or refused, and then the state is that of its start.
  subroutine judge_step(run, is_refused, status)
    type(run_t), intent(inout) :: run
    logical, intent(out) :: is_refused
    type(status_t), intent(inout) :: status
    is_refused = .false.
    if (run%step%mode == step_halve) call judge_halve(run, is_refused, status)
    if (run%step%mode == step_event .and. .not. failed(status)) &
        call judge_touch(run, is_refused)
    if (is_refused) then
      call restore_moment(run)
      run%step%tries = run%step%tries + 1
    else
      call count_step(run)
    end if
  end subroutine judge_step

  !> Halves a step that failed, missed the certificate, outran the search or left an overlap.
  subroutine judge_halve(run, is_refused, status)
    type(run_t), intent(inout) :: run
    logical, intent(out) :: is_refused
    type(status_t), intent(inout) :: status
    logical :: is_bad
    associate (s => run%step)
      is_bad = failed(status) .or. any(faults(run) > s%faults)
      is_refused = is_bad .and. may_be_refused(run)
      if (failed(status)) is_refused = is_refused .and. status%code == status_numerical
      s%good = merge(0, s%good + 1, is_bad)
      if (.not. is_refused) return
      s%level = s%level + 1
      s%halvings = s%halvings + 1
      status = status_t()
      run%broken = .false.
    end associate
  end subroutine judge_halve

  !> What makes a step a bad one although it has not failed: misses of the certificate, lists
  !> outrun, overlaps so far.
  pure function faults(run)
    type(run_t), intent(in) :: run
    integer :: faults(3)
    faults = [run%contact%tally%misses, run%contact%tally%redone, run%contact%tally%overlaps]
  end function faults

  !> Before the solve of a step: what is counted from now on is its own, not that of its start.
  subroutine note_faults(run)
    type(run_t), intent(inout) :: run
    run%step%faults = faults(run)
  end subroutine note_faults

  !> Cuts a step in which an open contact closes: where it does for gaps that are linear in
  !> time, then after one secant step.
  subroutine judge_touch(run, is_refused)
    type(run_t), intent(inout) :: run
    logical, intent(out) :: is_refused
    !> Nearer than this the cut need not be found better.
    real(wp), parameter :: found = 1.0e-12_wp
    real(wp) :: cut
    is_refused = .false.
    if (.not. may_be_refused(run)) return
    associate (s => run%step)
      if (s%tries == 0) call find_touch(run%contact, s%touch)
      select case (s%tries)
      case (0)
        cut = s%touch%share
      case (1)
        cut = s%target*s%touch%gap/(s%touch%gap - gap_at_end(run%contact, s%touch))
        if (abs(cut - s%target) <= found) return
      case default
        return
      end select
      is_refused = cut >= least_cut .and. cut <= one - least_cut
      if (is_refused) s%target = cut
    end associate
  end subroutine judge_touch

  !> A step is done. After a cut steps of DT0 begin at the touch.
  subroutine count_step(run)
    type(run_t), intent(inout) :: run
    associate (s => run%step)
      s%tries = 0
      s%was_cut = s%mode == step_event .and. s%target < one
      if (s%was_cut) then
        s%cuts = s%cuts + 1
        s%origin = run%state%time
        s%done = 0
        call plan_from_here(run)
        return
      end if
      s%share = s%target
      if (.not. s%share < one) then
        s%done = s%done + 1
        s%share = zero
      end if
      if (s%good < good_steps .or. s%level == 0) return
      if (abs(mod(scale(s%share, s%level - 1), one)) > zero) return
      s%level = s%level - 1
      s%good = 0
    end associate
  end subroutine count_step

  !> The state at the start of a step.
  subroutine keep_moment(run)
    type(run_t), intent(inout) :: run
    if (.not. allocated(run%step%before)) allocate (run%step%before)
    call exchange_before(run, archive_save)
    run%step%analyses = run%analyses
  end subroutine keep_moment

  !> The state at the start of the refused step, bit for bit; W and the factor are made anew.
  subroutine restore_moment(run)
    type(run_t), intent(inout) :: run
    call exchange_before(run, archive_restore)
    if (run%plan%motions) call hold_active(run)
    run%scheme%is_current = .false.
    run%step%new_interface = run%analyses > run%step%analyses
  end subroutine restore_moment

  subroutine exchange_before(run, mode)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: mode
    type(archive_t), allocatable :: archive
    logical :: new_nodal, new_reactions
    call move_alloc(run%step%before, archive)
    call archive%rewind(mode)
    call exchange_moment(archive, run, new_nodal, new_reactions)
    call move_alloc(archive, run%step%before)
  end subroutine exchange_before

  !> Saves to or restores from the archive all that a step changes. new_...: what a table wants
  !> that the archive does not have.
  subroutine exchange_moment(archive, run, new_nodal, new_reactions)
    type(archive_t), intent(inout) :: archive
    type(run_t), intent(inout) :: run
    logical, intent(out) :: new_nodal, new_reactions
    logical :: are_kept
    new_nodal = .false.
    call exchange_state(archive, run%state)
    if (run%plan%contact) call exchange_contact(archive, run%contact, new_nodal)
    call exchange_ledger(archive, run%ledger)
    call archive%agree('reaction.', run%plan%reactions, are_kept)
    new_reactions = run%plan%reactions .and. .not. are_kept
    if (are_kept) then
      call archive%exchange('reaction.end', run%reaction)
      call archive%exchange('reaction.mean', run%mean_reaction)
    end if
    if (run%plan%motions) call archive%exchange('run.active', run%active_motion)
    if (allocated(run%smooth_reaction)) &
        call archive%exchange('reaction.smooth', run%smooth_reaction)
    if (run%plan%damping) call exchange_damping(archive, run)
    if (allocated(run%newton)) call exchange_newton(archive, run)
    if (allocated(run%unbalanced)) call archive%exchange('static.unbalanced', run%unbalanced)
    call archive%exchange('run.largest_motion', run%largest_motion)
  end subroutine exchange_moment

  !> Saves to or restores from the archive where the run stands in its steps.
  subroutine exchange_step(archive, step)
    type(archive_t), intent(inout) :: archive
    type(step_control_t), intent(inout) :: step
    real(wp) :: values(3)
    integer :: counts(7)
    values = [step%origin, step%share, step%time_before]
    counts = [step%done, step%level, step%good, step%halvings, step%cuts, &
        merge(1, 0, step%was_cut), merge(1, 0, step%is_static)]
    call archive%exchange('step.values', values)
    call archive%exchange('step.counts', counts)
    step%origin = values(1)
    step%share = values(2)
    step%time_before = values(3)
    step%done = counts(1)
    step%level = counts(2)
    step%good = counts(3)
    step%halvings = counts(4)
    step%cuts = counts(5)
    step%was_cut = counts(6) == 1
    step%is_static = counts(7) == 1
  end subroutine exchange_step

end module run_step
