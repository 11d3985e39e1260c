! SPDX-License-Identifier: BSD-3-Clause
!> The step loop.
module run_loop
  use base_kinds, only: wp, zero, one, half
  use base_list, only: swap
  use base_signal, only: stop_asked
  use base_status, only: status_t, fail, failed, add_place, status_numerical, status_stopped
  use base_strings, only: to_text
  use base_timers, only: phase_search, phase_contact, phase_update, phase_energy, &
      phase_output, phase_other
  use contact_rows, only: copy_rows
  use contact_search, only: update_lists, relist_outrun
  use contact_stage, only: evaluate_contact
  use contact_work, only: add_contact_step, contact_work_t
  use deck_names, only: step_halve
  use output_tables, only: any_due, energies_due
  use run_damping, only: update_damping, keep_damping, damping_work
  use run_data, only: run_t
  use run_frames, only: keep_frame
  use run_monitor, only: moment, monitor, take_looks
  use run_motion, only: activate_motions, find_reactions, reaction_work
  use run_progress, only: progress_t, show_progress, clear_progress
  use run_restart, only: keep_restart, how_to_go_on
  use run_operator, only: renew_matrix, use_operator
  use run_setup, only: start_dynamics
  use run_newton, only: iterates, solve_newton, close_newton
  use run_rigid, only: begin_rigid, renew_levers, carry, set_true_motion, add_rigid_works
  use run_stage, only: solve_stage
  use run_static, only: check_pass, unbalanced_work
  use run_step, only: begin_step, judge_step, note_faults, at_end, starts_dynamics, share_of_run
  use run_two_stages, only: close_stage, add_stage_works, find_stage_reactions
  use time_base, only: mass_product
  use run_tables, only: write_rows
  use run_warnings, only: notice_warnings
  implicit none
  private
  public :: go_through_steps, advance, advance_to

contains

  !> All steps from the state as it is to the end; rows of the tables on the way.
  subroutine go_through_steps(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    type(progress_t) :: progress
    logical :: stopped
    if (run%static_steps > 0 .and. .not. allocated(run%restarted)) &
        call load_at_start(run, status)
    if (run%plan%restarts .and. .not. allocated(run%restarted)) &
        call keep_restart(run, .false., status)
    call write_due_output(run, at_end(run) .or. failed(status), status)
    do while (.not. (at_end(run) .or. failed(status)))
      if (starts_dynamics(run)) call end_static_phase(run, status)
      call advance(run, status)
      stopped = stop_asked()
      stopped = stopped .and. .not. at_end(run)
      if (run%plan%restarts) call keep_restart(run, stopped, status)
      call write_due_output(run, at_end(run) .or. failed(status), status)
      call notice_warnings(run, progress)
      if (stopped) call fail(status, status_stopped, 'stopped by a signal', &
          hint=how_to_go_on(run))
      call show_progress(progress, run%quiet, run%state%cycle, run%state%time, &
          share_of_run(run))
    end do
    call clear_progress(progress)
  end subroutine go_through_steps

  !> One step; a shorter one as long as it is refused.
  subroutine advance(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    real(wp) :: t1
    logical :: is_refused
    do
      call begin_step(run, t1, status)
      if (.not. failed(status)) call advance_to(run, t1, status)
      call judge_step(run, is_refused, status)
      if (.not. is_refused) exit
    end do
  end subroutine advance

  !> The step that ends at t1, stage by stage: free motion, contact on its interface, whole
  !> motion, new state, ledger.
  subroutine advance_to(run, t1, status)
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: t1
    type(status_t), intent(inout) :: status
    integer :: stage
    logical :: acting
    if (run%plan%damping) call prepare_damping(run, t1, status)
    if (run%plan%motions) call prepare_motions(run, t1, status)
    if (run%plan%contact) call prepare_contact(run, t1, status)
    if (failed(status)) return
    if (allocated(run%rigid)) call begin_rigid(run)
    call run%scheme%begin_step(run%state%cycle - run%first_cycle, run%state%h_last)
    do stage = 1, size(run%scheme%stage)
      if (stage > 1 .and. run%scheme%stage(stage)%only_in_contact .and. .not. acting) exit
      if (allocated(run%other)) call use_operator(run, stage)
      run%contact%rule = run%scheme%stage(stage)%rule
      run%contact%step_length = run%scheme%h
      call solve_listed(run, stage, t1, acting, status)
      if (allocated(run%shift)) call find_equilibrium(run, stage, t1, acting, status)
      if (allocated(run%rigid) .and. stage == 1 .and. .not. allocated(run%shift)) &
          call find_turns(run, stage, t1, acting, status)
      if (iterates(run) .and. failed(status)) then
        call add_place(status, moment(run))    ! no solution: the state stays as it was
        return
      end if
      call run%timers%enter(phase_update)
      if (run%plan%damping) call keep_damping(run, stage)
      call run%scheme%update(stage, run%x, run%state)
      if (run%scheme%stage(stage)%moves) call swap(run%state%du, run%x)
      if (allocated(run%rigid)) call carry(run)
      if (allocated(run%other)) call close_stage(run, stage, acting, status)
    end do
    run%state%cycle = run%state%cycle + 1
    run%state%time = t1
    run%state%h_last = run%scheme%h
    call add_step_work(run, acting, status)
    if (allocated(run%rigid)) call set_true_motion(run)
    if (failed(status)) call add_place(status, moment(run))
  end subroutine advance_to

  !> Solves the stage until the turns of rigid parts are those that their levers were made for.
  !> Each pass gains the digits of half a turn. Where no turn repeats itself (a contact opens
  !> for one and closes for the next) the step keeps the levers of its last pass, with which the
  !> work of contact is exact; gaps at its end err by change x the size of the part, up to
  !> `accepted`. Schemes whose forces act on in the next step need the turn itself: there it is
  !> an error.
  subroutine find_turns(run, stage, t1, acting, status)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: t1
    logical, intent(inout) :: acting
    type(status_t), intent(inout) :: status
    integer, parameter :: most_passes = 50
    real(wp), parameter :: accepted = 1.0e-3_wp
    integer :: pass
    logical :: again
    do pass = 1, most_passes
      if (failed(status)) return
      call renew_levers(run, again)
      if (.not. again) return
      run%rigid%passes = run%rigid%passes + 1
      call solve_listed(run, stage, t1, acting, status)
    end do
    run%rigid%keeps_levers = run%rigid%change <= accepted .and. &
        .not. allocated(run%rigid%lever_before)
    if (.not. run%rigid%keeps_levers) call fail(status, status_numerical, 'rigid parts '// &
        'turn too far in the step: its turns are not found', hint='take a smaller step')
  end subroutine find_turns

  !> Further passes of a load step whose bodies are not held by supports alone.
  subroutine find_equilibrium(run, stage, t1, acting, status)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: t1
    logical, intent(inout) :: acting
    type(status_t), intent(inout) :: status
    integer :: pass
    logical :: is_done, again
    pass = 1
    run%x_pass = zero
    run%move = zero
    do
      call check_pass(run, pass, is_done, status)
      if (allocated(run%rigid)) then
        call renew_levers(run, again)
        is_done = is_done .and. .not. again
      end if
      if (is_done .or. failed(status)) exit
      pass = pass + 1
      call solve_listed(run, stage, t1, acting, status)
    end do
    run%x_pass = zero
  end subroutine find_equilibrium

  !> Statics: loads that are not zero at t = 0 grow from nothing in a step of no length.
  subroutine load_at_start(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    real(wp) :: h
    h = run%scheme%h
    call run%scheme%set_step(zero)
    run%starts_from_rest = .true.
    call advance_to(run, zero, status)
    run%starts_from_rest = .false.
    call run%scheme%set_step(h)
    run%state%cycle = 0
    run%ledger%evaluated = -1
  end subroutine load_at_start

  !> The scheme of the deck takes over; the energy of the initial velocities counts from now on.
  subroutine end_static_phase(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    run%step%is_static = .false.
    call start_dynamics(run, status)
    run%first_cycle = run%state%cycle
    run%ledger%staggered = run%scheme%staggered
    run%ledger%evaluated = -1
    run%ledger%initial = run%ledger%initial &
        + half*mass_product(run%system, run%state%v, run%state%v)
  end subroutine end_static_phase

  !> The stage; once more with longer lists where its motion has outrun those that there were.
  subroutine solve_listed(run, stage, t1, acting, status)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: t1
    logical, intent(out) :: acting
    type(status_t), intent(inout) :: status
    logical :: again
    if (iterates(run)) then
      call solve_newton(run, stage, t1, acting, status)
    else
      call solve_stage(run, stage, t1, acting, status)
    end if
    call check_finite(run, stage, status)
    if (.not. run%plan%contact) return
    call look_back(run, stage, again, status)
    if (.not. again) return
    if (iterates(run)) then
      call solve_newton(run, stage, t1, acting, status)
    else
      call solve_stage(run, stage, t1, acting, status)
    end if
    call check_finite(run, stage, status)
  end subroutine solve_listed

  !> Motions that begin or end change the set of held dofs: another factor.
  subroutine prepare_motions(run, t1, status)
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: t1
    type(status_t), intent(inout) :: status
    logical :: changed
    call activate_motions(run, t1, changed)
    if (changed) call renew_matrix(run, .false., status)
  end subroutine prepare_motions

  !> Coefficients of damping that change mean another effective matrix.
  subroutine prepare_damping(run, t1, status)
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: t1
    type(status_t), intent(inout) :: status
    logical :: changed
    call update_damping(run, t1, changed)
    if (changed) call renew_matrix(run, .false., status)
  end subroutine prepare_damping

  !> Lists for the step; a larger interface means another elimination order.
  subroutine prepare_contact(run, t1, status)
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: t1
    type(status_t), intent(inout) :: status
    logical :: new_interface
    call run%timers%enter(phase_search)
    call update_lists(run%model, run%contact, run%state%u, run%state%du, run%state%v, &
        run%largest_motion, run%scheme%h, run%state%cycle, t1, new_interface, status)
    if (run%contact%keeps_before) call copy_rows(run%contact%rows, run%contact%before)
    if (run%step%mode == step_halve) call note_faults(run)
    if (failed(status)) call add_place(status, moment(run))
    if (new_interface) call renew_matrix(run, .true., status)
  end subroutine prepare_contact

  !> A step that has outrun its lists is solved again with longer ones.
  subroutine look_back(run, stage, again, status)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    logical, intent(out) :: again
    type(status_t), intent(inout) :: status
    logical :: new_interface
    again = .false.
    if (.not. run%scheme%stage(stage)%moves) return
    call run%timers%enter(phase_search)
    call relist_outrun(run%model, run%contact, run%state%u, run%x, run%largest_motion, &
        run%state%v, run%scheme%h, run%state%cycle, again, new_interface, status)
    if (new_interface) call renew_matrix(run, .true., status)
  end subroutine look_back

  !> The largest motion x of a node in the step; NaN or infinity is a failure.
  subroutine check_finite(run, stage, status)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    type(status_t), intent(inout) :: status
    real(wp) :: total, largest
    if (run%solver%info%unconverged > 0) call fail(status, status_numerical, &
        'conjugate gradients have not converged in '// &
        to_text(run%solver_options%most_iterations)//' iterations (CGMAX of '// &
        '*BIPACT_SOLVER)', hint='take a shorter step or another ENGINE')
    call sum_squares(run%system%dim, run%system%n, run%x, total, largest)
    if (run%scheme%stage(stage)%moves) run%largest_motion = sqrt(largest)
    if (total <= huge(one)) return
    run%broken = .true.
    call fail(status, status_numerical, &
        'the displacements are not finite (NaN or Inf)', &
        hint='check units, densities and the time step')
  end subroutine check_finite

  !> Sum and maximum of the squared lengths; a NaN stays in the sum.
  pure subroutine sum_squares(dim, n, x, total, largest)
    integer, intent(in) :: dim, n
    real(wp), intent(in) :: x(dim, n)
    real(wp), intent(out) :: total, largest
    real(wp) :: a
    integer :: i
    total = zero
    largest = zero
    do i = 1, n
      a = x(1, i)**2 + x(2, i)**2
      if (dim == 3) a = a + x(3, i)**2
      total = total + a
      largest = merge(a, largest, a > largest)
    end do
  end subroutine sum_squares

  !> Works of the step into the ledger.
  subroutine add_step_work(run, acting, status)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: acting
    type(status_t), intent(inout) :: status
    real(wp) :: work
    call run%timers%enter(phase_energy)
    if (run%plan%loads) then
      if (allocated(run%scheme%conjugate)) then
        run%ledger%external = run%ledger%external + load_work(run, run%scheme%conjugate)
      else
        run%ledger%external = run%ledger%external + load_work(run, run%state%du)
      end if
    end if
    if (run%plan%reactions) then
      call find_motion_work(run, work)
      run%ledger%motion = run%ledger%motion + work
    end if
    if (run%plan%damping) run%ledger%damping = run%ledger%damping + damping_work(run)
    if (allocated(run%shift)) then
      call unbalanced_work(run, work)
      run%ledger%contact%unsolved = run%ledger%contact%unsolved + work
    end if
    if (allocated(run%newton)) call close_newton(run, status)
    if (run%scheme%dissipates) run%ledger%algorithmic = run%ledger%algorithmic &
        + run%scheme%dissipation(run%system, run%state)
    if (.not. run%plan%contact) return
    if (run%contact%idle_steps == 2) return
    call run%timers%enter(phase_contact)
    if (allocated(run%other)) then
      call add_stage_works(run)
      return
    end if
    call evaluate_contact(run%model, run%contact, run%state%u, run%state%du, run%state%cycle, &
        acting, status)
    if (allocated(run%scheme%conjugate)) then
      call add_contact_step(run%contact, run%scheme%weight_before, run%scheme%weight_now, &
          run%scheme%h, run%scheme%conjugate, run%ledger%contact)
    else if (allocated(run%rigid)) then
      call add_rigid_works(run)
    else
      call add_contact_step(run%contact, run%scheme%weight_before, run%scheme%weight_now, &
          run%scheme%h, run%state%du, run%ledger%contact)
    end if
    run%ledger%motion = run%ledger%motion + run%ledger%contact%given
    run%ledger%contact%given = zero
  end subroutine add_step_work

  !> Reactions of held dofs and their work in the step [F L].
  subroutine find_motion_work(run, work)
    type(run_t), intent(inout) :: run
    real(wp), intent(out) :: work
    if (allocated(run%other)) then
      call find_stage_reactions(run, work)
      return
    end if
    call find_reactions(run, 1, run%state%du)
    if (allocated(run%scheme%conjugate)) then
      work = reaction_work(run, run%mean_reaction, run%scheme%conjugate)
    else
      work = reaction_work(run, run%mean_reaction, run%state%du)
    end if
  end subroutine find_motion_work

  !> Work of the loads on a motion (dim, n) [F L].
  pure real(wp) function load_work(run, motion)
    type(run_t), intent(in) :: run
    real(wp), intent(in) :: motion(:, :)
    load_work = sum(motion*(run%scheme%load_work_weight(1)*run%load_0 &
        + run%scheme%load_work_weight(2)*run%load_1))
  end function load_work

  !> Rows that are due, and what must be watched at such times.
  subroutine write_due_output(run, is_final, status)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: is_final
    type(status_t), intent(inout) :: status
    logical :: energies, due
    real(wp) :: h
    h = run%model%controls%dt
    energies = energies_due(run%tables, run%state%time, h, is_final) .or. is_final
    if (run%model%controls%ledger_every > 0) &
        energies = energies .or. mod(run%state%cycle, run%model%controls%ledger_every) == 0
    if (energies .and. .not. run%broken) call monitor(run, status)
    if (run%broken) return
    if (run%plan%fields) call keep_frame(run, is_final, status)
    due = any_due(run%tables, run%state%time, h)
    if (is_final .or. due) call take_looks(run, is_final, status)
    if (.not. (due .or. is_final .and. run%tables%any_on)) return
    call run%timers%enter(phase_output)
    call write_rows(run, is_final, status)
    call run%timers%enter(phase_other)
  end subroutine write_due_output

end module run_loop
