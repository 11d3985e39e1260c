! SPDX-License-Identifier: BSD-3-Clause
!> The step loop.
module run_loop
  use assembly_bending, only: look_at_bending
  use assembly_forces, only: add_loads, largest_rotation, first_inverted, &
      subtract_internal_force, subtract_damping_force
  use assembly_system, only: clear_fixed, multiply_mass
  use base_kinds, only: wp, zero, one
  use base_signal, only: stop_asked
  use base_status, only: status_t, fail, failed, add_place, status_numerical, status_stopped
  use base_strings, only: to_text, join_path
  use base_timers, only: phase_product, phase_solve, phase_search, phase_contact, &
      phase_update, phase_energy, phase_output, phase_other
  use contact_condense, only: clear_constrained
  use contact_monitor, only: check_all
  use contact_rows, only: copy_rows
  use contact_search, only: update_lists, relist_outrun
  use contact_stage, only: solve_contact, correct_contact, settle_contact
  use contact_work, only: add_contact_step, contact_work_t
  use linalg_solver, only: solve_whole
  use output_contact, only: write_contact_problem
  use output_tables, only: any_due, energies_due
  use run_data, only: run_t
  use run_frames, only: keep_frame
  use run_motion, only: activate_motions, impose_motions, restore_motions, keep_right_side, &
      find_reactions
  use run_progress, only: progress_t, show_progress, clear_progress
  use run_restart, only: keep_restart, how_to_go_on
  use run_setup, only: factor_matrix
  use run_tables, only: write_rows
  use run_warnings, only: notice_warnings
  use time_ledger, only: evaluate_ledger, find_strain_energies, largest_work
  implicit none
  private
  public :: go_through_steps, advance

contains

  !> All steps from the state as it is to the end; rows of the tables on the way.
  subroutine go_through_steps(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    type(progress_t) :: progress
    integer :: steps
    logical :: stopped
    steps = run%plan%full_steps
    if (run%plan%last_step > zero) steps = steps + 1
    if (run%plan%restarts .and. .not. allocated(run%restarted)) &
        call keep_restart(run, .false., status)
    call tell(run, run%state%cycle == steps .or. failed(status), status)
    do while (run%state%cycle < steps .and. .not. failed(status))
      if (run%state%cycle == run%plan%full_steps) call cut_step(run, status)
      call advance(run, status)
      stopped = stop_asked()
      stopped = stopped .and. run%state%cycle < steps
      if (run%plan%restarts) call keep_restart(run, stopped, status)
      call tell(run, run%state%cycle == steps .or. failed(status), status)
      call notice_warnings(run, progress)
      if (stopped) call fail(status, status_stopped, 'stopped by a signal', &
          hint=how_to_go_on(run))
      call show_progress(progress, run%quiet, run%state%cycle, steps, run%state%time)
    end do
    call clear_progress(progress)
  end subroutine go_through_steps

  !> One step, stage by stage: free motion, contact on its interface, whole motion, new state,
  !> ledger.
  subroutine advance(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    real(wp) :: t1
    integer :: stage
    logical :: acting, again
    t1 = merge(run%model%controls%end_time, (run%state%cycle + 1)*run%model%controls%dt, &
        run%state%cycle == run%plan%full_steps)
    if (run%plan%motions) call prepare_motions(run, t1, status)
    if (run%plan%contact) call prepare_contact(run, t1, status)
    if (failed(status)) return
    do stage = 1, size(run%scheme%stage)
      call solve_stage(run, stage, t1, acting, status)
      call check_finite(run, status)
      if (run%plan%contact) call look_back(run, again, status)
      if (run%plan%contact .and. again) call solve_again(run, stage, t1, acting, status)
      call run%timers%enter(phase_update)
      call run%scheme%update(stage, run%x, run%state)
      call swap(run%state%du, run%x)
    end do
    run%state%cycle = run%state%cycle + 1
    run%state%time = t1
    run%state%h_last = run%scheme%h
    call account(run, acting, status)
    if (failed(status)) call add_place(status, moment(run))
  end subroutine advance

  !> The stage once more, with longer lists.
  subroutine solve_again(run, stage, t1, acting, status)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: t1
    logical, intent(out) :: acting
    type(status_t), intent(inout) :: status
    call solve_stage(run, stage, t1, acting, status)
    call check_finite(run, status)
  end subroutine solve_again

  !> The motion x of a stage, with contact.
  subroutine solve_stage(run, stage, t1, acting, status)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: t1
    logical, intent(out) :: acting
    type(status_t), intent(inout) :: status
    acting = .false.
    call run%timers%enter(phase_product)
    run%b = zero
    if (run%plan%loads) call weigh_loads(run, t1)
    call run%scheme%right_side(stage, run%system, run%state, run%b)
    call hold_dofs(run, stage, t1)
    call run%timers%enter(phase_solve)
    call run%solver%forward(run%b, run%b_last)
    run%x_last = run%b_last
    call run%solver%solve_last(run%x_last)
    if (run%plan%contact) call add_contact(run, acting, status)
    call run%solver%backward(run%x_last, run%x)
    run%solves = run%solves + 1
    if (run%state%cycle >= run%plan%refined_from) call refine(run, stage, acting, status)
    if (run%plan%motions) call restore_motions(run)
  end subroutine solve_stage

  !> Corrects x where the effective matrix is stiff; with contact also the reactions, until they
  !> meet their certificate for the motion as it is. Each pass gains the digits that the factor
  !> has, so two are enough, or none would be.
  subroutine refine(run, stage, acting, status)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    logical, intent(inout) :: acting
    type(status_t), intent(inout) :: status
    integer, parameter :: most_passes = 3
    integer :: pass
    logical :: done
    call refine_motion(run, stage)
    if (.not. run%plan%contact) return
    do pass = 1, most_passes
      call run%timers%enter(phase_contact)
      call correct_contact(run%model, run%contact, run%x, run%force, run%x_last, done, &
          acting, status)
      if (done) return
      run%b = zero
      call add_interface_forces(run, run%x_last)
      call add_correction(run)
      call refine_motion(run, stage)
    end do
  end subroutine refine

  !> One correction of x: the residual b + H' r - A x from the mass and the element strains,
  !> solved with the same factor (Wilkinson 1963).
  subroutine refine_motion(run, stage)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    call run%timers%enter(phase_product)
    run%b = run%b_kept
    call multiply_mass(run%system, -run%scheme%stage(stage)%c_m, run%x, run%b)
    call subtract_internal_force(run%system, run%scheme%stage(stage)%c_k, run%x, run%b)
    call subtract_damping_force(run%system, run%scheme%stage(stage)%c_c, run%x, run%b)
    if (run%plan%contact) call add_interface_forces(run, run%force)
    call add_correction(run)
  end subroutine refine_motion

  !> Adds forces of the interface (2, m) to b.
  pure subroutine add_interface_forces(run, force)
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: force(:, :)
    integer :: k
    do k = 1, size(run%contact%interface_node)
      associate (i => run%contact%interface_node(k))
        run%b(:, i) = run%b(:, i) + force(:, k)
      end associate
    end do
  end subroutine add_interface_forces

  !> x = x + A^-1 b, held dofs kept.
  subroutine add_correction(run)
    type(run_t), intent(inout) :: run
    if (run%system%any_fixed) call clear_fixed(run%system, run%b)
    call run%timers%enter(phase_solve)
    call solve_whole(run%solver, run%b, run%correction)
    run%x = run%x + run%correction
    run%solves = run%solves + 1
  end subroutine add_correction

  !> The step and its time, for messages.
  function moment(run) result(text)
    type(run_t), intent(in) :: run
    character(:), allocatable :: text
    text = 'step '//to_text(run%state%cycle)//', time '//to_text(run%state%time)
  end function moment

  !> Exchanges two arrays without copying.
  subroutine swap(a, b)
    real(wp), allocatable, intent(inout) :: a(:, :), b(:, :)
    real(wp), allocatable :: c(:, :)
    call move_alloc(a, c)
    call move_alloc(b, a)
    call move_alloc(c, b)
  end subroutine swap

  !> Motions that begin or end change the set of held dofs: another factor.
  subroutine prepare_motions(run, t1, status)
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: t1
    type(status_t), intent(inout) :: status
    logical :: changed
    call activate_motions(run, t1, changed)
    if (changed) call factor_matrix(run, .false., status)
  end subroutine prepare_motions

  !> Supports and prescribed motions in the right-hand side.
  subroutine hold_dofs(run, stage, t1)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: t1
    if (run%plan%reactions) call keep_right_side(run)
    if (run%state%cycle >= run%plan%refined_from) run%b_kept = run%b
    if (run%plan%motions) then
      call impose_motions(run, stage, t1)
    else if (run%system%any_fixed) then
      call clear_fixed(run%system, run%b)
    end if
  end subroutine hold_dofs

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
    if (failed(status)) call add_place(status, moment(run))
    if (new_interface) call factor_matrix(run, .true., status)
  end subroutine prepare_contact

  !> A step that has outrun its lists is solved again with longer ones.
  subroutine look_back(run, again, status)
    type(run_t), intent(inout) :: run
    logical, intent(out) :: again
    type(status_t), intent(inout) :: status
    logical :: new_interface
    call run%timers%enter(phase_search)
    call relist_outrun(run%model, run%contact, run%state%u, run%x, run%largest_motion, &
        run%state%v, run%scheme%h, run%state%cycle, again, new_interface, status)
    if (new_interface) call factor_matrix(run, .true., status)
  end subroutine look_back

  !> Contact on the interface: reactions for the free motion x_last, then the motion with them.
  subroutine add_contact(run, acting, status)
    type(run_t), intent(inout) :: run
    logical, intent(inout) :: acting
    type(status_t), intent(inout) :: status
    run%force = zero
    if (run%contact%listed == 0 .and. run%contact%rows%n == 0) return
    call run%timers%enter(phase_contact)
    call solve_contact(run%model, run%contact, run%state%u, run%x_last, &
        largest_work(run%ledger), run%force, acting, status)
    if (run%plan%dump .and. acting) call dump_contact(run, status)
    call run%timers%enter(phase_solve)
    if (.not. acting) return
    call clear_constrained(run%contact, run%force)
    run%x_last = run%b_last + run%force
    call run%solver%solve_last(run%x_last)
  end subroutine add_contact

  !> The contact problem of the step as a file, where the deck asks for it.
  subroutine dump_contact(run, status)
    type(run_t), intent(in) :: run
    type(status_t), intent(inout) :: status
    character(24) :: name
    integer :: step
    step = run%state%cycle + 1
    associate (c => run%model%controls, p => run%contact)
      if (step < c%dump_first .or. step > c%dump_last) return
      if (mod(step - c%dump_first, c%dump_every) /= 0) return
      write (name, '(a,i9.9,a)') 'contact_', step, '.txt'
      call write_contact_problem(join_path(run%folder, trim(name)), 'step '//to_text(step), &
          p%w%matrix, p%q, p%mu, p%r, status)
    end associate
  end subroutine dump_contact

  !> Loads at both ends of the step, and their weighted sum into b.
  subroutine weigh_loads(run, t1)
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: t1
    run%load_0 = zero
    run%load_1 = zero
    call add_loads(run%model, run%system, run%state%time, one, run%load_0)
    call add_loads(run%model, run%system, t1, one, run%load_1)
    run%b = run%scheme%load_weight(1)*run%load_0 + run%scheme%load_weight(2)*run%load_1
  end subroutine weigh_loads

  !> The largest motion x of a node in the step; NaN or infinity is a failure.
  subroutine check_finite(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    real(wp) :: total, largest
    call sum_squares(size(run%x, 2), run%x, total, largest)
    run%largest_motion = sqrt(largest)
    if (total <= huge(one)) return
    run%broken = .true.
    call fail(status, status_numerical, &
        'the displacements are no numbers any more (NaN or infinite)', &
        hint='check units, densities and the time step')
  end subroutine check_finite

  !> Sum and maximum of the squared lengths; a NaN stays in the sum.
  pure subroutine sum_squares(n, x, total, largest)
    integer, intent(in) :: n
    real(wp), intent(in) :: x(2, n)
    real(wp), intent(out) :: total, largest
    real(wp) :: a
    integer :: i
    total = zero
    largest = zero
    do i = 1, n
      a = x(1, i)**2 + x(2, i)**2
      total = total + a
      largest = merge(a, largest, a > largest)
    end do
  end subroutine sum_squares

  !> Works of the step into the ledger.
  subroutine account(run, acting, status)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: acting
    type(status_t), intent(inout) :: status
    real(wp) :: work
    call run%timers%enter(phase_energy)
    if (run%plan%loads) run%ledger%external = run%ledger%external &
        + sum(run%state%du*(run%scheme%load_work_weight(1)*run%load_0 &
        + run%scheme%load_work_weight(2)*run%load_1))
    if (run%plan%reactions) then
      call find_reactions(run, work)
      run%ledger%motion = run%ledger%motion + work
    end if
    if (run%scheme%dissipates) run%ledger%algorithmic = run%ledger%algorithmic &
        + run%scheme%dissipation(run%system, run%state)
    if (.not. run%plan%contact) return
    if (run%contact%idle_steps == 2) return
    call run%timers%enter(phase_contact)
    call settle_contact(run%model, run%contact, run%state%u, run%state%du, run%state%cycle, &
        acting, status)
    call add_contact_step(run%contact, run%scheme%weight_before, run%scheme%weight_now, &
        run%scheme%h, run%state%du, run%ledger%contact)
  end subroutine account

  !> Rows that are due, and what must be watched at such times.
  subroutine tell(run, last, status)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: last
    type(status_t), intent(inout) :: status
    logical :: energies, due
    real(wp) :: h
    h = run%scheme%h
    energies = energies_due(run%tables, run%state%time, h, last) .or. last
    if (run%model%controls%ledger_every > 0) &
        energies = energies .or. mod(run%state%cycle, run%model%controls%ledger_every) == 0
    if (energies .and. .not. run%broken) call watch(run, status)
    if (run%broken) return
    if (run%plan%fields) call keep_frame(run, last, status)
    due = any_due(run%tables, run%state%time, h)
    if (last .or. due) call take_looks(run, last, status)
    if (.not. (due .or. last .and. run%tables%any_on)) return
    call run%timers%enter(phase_output)
    call write_rows(run, last, status)
    call run%timers%enter(phase_other)
  end subroutine tell

  !> Looks at all bodies: at output times that are not too close, and at the end.
  subroutine take_looks(run, last, status)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: last
    type(status_t), intent(inout) :: status
    !> Steps between two looks: then they cost little beside the steps.
    integer, parameter :: apart = 50
    !> Strain energy beside the largest term below which bodies only fly.
    real(wp), parameter :: least_strain = 1.0e-6_wp
    if (failed(status)) return
    if (.not. last .and. run%state%cycle < run%looked + apart) return
    run%looked = run%state%cycle
    if (run%plan%contact) call check_overlap(run, status)
    if (failed(status)) return
    call run%timers%enter(phase_energy)
    call find_strain_energies(run%model, run%system, run%state, run%ledger)
    if (sum(run%ledger%part_internal) > least_strain*run%ledger%largest) &
        call look_at_bending(run%model, run%system, run%state%u, run%ledger%part_internal, &
        run%state%cycle, run%bending)
    call run%timers%enter(phase_other)
  end subroutine take_looks

  !> True overlap of all bodies in contact, beyond what lists cover in every step. It means
  !> something while elements are not inverted.
  subroutine check_overlap(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    integer :: element
    call run%timers%enter(phase_search)
    call check_all(run%model, run%contact, run%state%u, run%state%cycle, status)
    element = 0
    if (size(run%model%contact) > 0) &
        element = first_inverted(run%system, run%model%x, run%state%u)
    if (element > 0) call fail(status, status_numerical, 'element '// &
        to_text(run%model%element_id(element))//', at node '//to_text(run%model%node_id( &
        run%model%connectivity(1, element)))//', is turned inside out: its boundary is not '// &
        'that of a body any more', &
        hint='check the loads and motions; take a smaller step')
    if (failed(status)) call add_place(status, moment(run))
  end subroutine check_overlap

  !> Energies, growth of energy, rotation of elements.
  subroutine watch(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    real(wp) :: angle
    integer :: element
    call run%timers%enter(phase_energy)
    call evaluate_ledger(run%model, run%system, run%state, run%ledger)
    call largest_rotation(run%system, run%model%x, run%state%u, angle, element)
    if (angle*180.0_wp/acos(-one) > run%model%controls%rotation_warning) &
        run%rotations = run%rotations + 1
    if (angle > run%rotation) then
      run%rotation = angle
      run%rotation_element = element
    end if
    if (run%ledger%growth > run%model%controls%growth) then
      run%ledger%growths = run%ledger%growths + 1
      if (run%ledger%first_growth < 0) run%ledger%first_growth = run%state%cycle
      if (run%model%controls%stop_on_growth) call fail(status, status_numerical, &
          'energy growth of '//to_text(run%ledger%growth)//' of the largest term', &
          place=moment(run), hint='choose SCHEME THETA, or ACTION WARN')
    end if
    if (run%model%controls%end_ratio > zero) then
      if (abs(run%ledger%ratio - one) > run%model%controls%end_ratio) call fail(status, &
          status_numerical, 'the energy ratio is '//to_text(run%ledger%ratio)// &
          ', beyond ENDENG of *CONTROL_TERMINATION', place=moment(run))
    end if
    run%broken = .not. abs(run%ledger%total) <= huge(one)
    if (run%broken) call fail(status, status_numerical, &
        'the energy is no number any more (NaN or infinite)', place=moment(run))
    call run%timers%enter(phase_other)
  end subroutine watch

  !> The last step is shorter: another effective matrix.
  subroutine cut_step(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    call run%scheme%set_step(run%plan%last_step)
    call factor_matrix(run, .false., status)
  end subroutine cut_step

end module run_loop
