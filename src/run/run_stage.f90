! SPDX-License-Identifier: BSD-3-Clause
!> One stage of a step: the right-hand side, the free motion, contact on its interface, the
!> whole motion, and its correction where the effective matrix is stiff.
module run_stage
  use assembly_damping, only: subtract_damping_force
  use assembly_forces, only: add_loads, subtract_internal_force, subtract_layer_force, &
      strain_energies
  use assembly_system, only: clear_fixed, multiply_mass
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, failed
  use base_strings, only: to_text, join_path
  use base_timers, only: phase_product, phase_solve, phase_contact
  use contact_condense, only: clear_constrained
  use contact_local, only: move_by
  use contact_stage, only: solve_contact, correct_contact
  use linalg_solver, only: solve_whole
  use model_rigid, only: move_followers, gather_forces
  use output_contact, only: write_contact_problem
  use run_damping, only: subtract_damping
  use run_data, only: run_t
  use run_motion, only: impose_motions, restore_motions, keep_right_side
  use run_rigid, only: spread_flexibility, spread_motion, collect_forces
  use run_static, only: add_shift
  use time_ledger, only: largest_work
  implicit none
  private
  public :: solve_stage, add_contact, add_interface_forces, weigh_loads, follow

contains

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
    if (run%plan%loads) call weigh_loads(run, stage, t1)
    call run%scheme%right_side(stage, run%system, run%state, run%b)
    call subtract_forces(run, stage)
    if (run%plan%damping) call subtract_damping(run, stage)
    if (allocated(run%shift)) call add_shift(run%shift, run%x_pass, run%b)
    call constrain_dofs(run, stage, t1)
    call run%timers%enter(phase_solve)
    call run%solver%forward(run%b, run%b_interface)
    run%x_interface = run%b_interface
    call run%solver%solve_schur(run%x_interface)
    if (allocated(run%contact%local)) then
      call run%solver%backward(run%x_interface, run%x)
      call add_local_contact(run, acting, status)
    else
      if (run%plan%contact) call add_contact(run, acting, status)
      call run%solver%backward(run%x_interface, run%x)
    end if
    run%solves = run%solves + 1
    if (allocated(run%rigid)) call follow(run, run%x)
    if (is_refined(run)) call refine(run, stage, acting, status)
    if (run%plan%motions) call restore_motions(run)
    if (allocated(run%rigid) .and. run%plan%motions) call follow(run, run%x)
    if (stage > 1 .and. allocated(run%scheme%free)) call find_free(run, acting)
  end subroutine solve_stage

  !> Motions x (dim, nodes) of the nodes that follow rigid parts.
  subroutine follow(run, x)
    type(run_t), intent(in) :: run
    real(wp), intent(inout) :: x(:, :)
    call move_followers(run%model%rigid, run%rigid%lever, x)
  end subroutine follow

  !> Is this step one whose solve is refined? Steps that are halved are more than planned.
  pure logical function is_refined(run)
    type(run_t), intent(in) :: run
    is_refined = run%plan%refinement .and. run%state%cycle >= run%plan%refined_from
  end function is_refined

  !> b = b - force_weight K (U0 + force_lead V0), U0 and V0 at the start of the stage.
  subroutine subtract_forces(run, stage)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    associate (s => run%scheme%stage(stage))
      if (.not. s%force_weight > zero) return
      if (allocated(run%newton)) then
        if (.not. allocated(run%ledger%part_before)) allocate (run%ledger%part_before( &
            size(run%model%part)))
        call strain_energies(run%system, run%model%mesh%part, run%state%u, &
            run%ledger%part_before)
        run%newton%residual = zero
        call subtract_internal_force(run%system, -one, run%state%u, run%newton%residual)
        run%b = run%b - s%force_weight*run%newton%residual
        return
      end if
      if (abs(s%force_lead) > zero) then
        run%x = run%state%u + s%force_lead*run%state%v
        call subtract_internal_force(run%system, s%force_weight, run%x, run%b)
      else
        call subtract_internal_force(run%system, s%force_weight, run%state%u, run%b)
      end if
    end associate
  end subroutine subtract_forces

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
      if (allocated(run%rigid)) then
        call correct_contact(run%model, run%contact, run%x, run%force, run%rigid%x, done, &
            acting, status)
      else if (allocated(run%contact%local)) then
        call correct_contact(run%model, run%contact, run%x, run%force, run%x_contact, done, &
            acting, status)
      else
        call correct_contact(run%model, run%contact, run%x, run%force, run%x_interface, done, &
            acting, status)
      end if
      if (done) return
      run%b = zero
      if (allocated(run%rigid)) then
        call add_interface_forces(run, run%rigid%x)
      else if (allocated(run%contact%local)) then
        call add_interface_forces(run, run%x_contact)
      else
        call add_interface_forces(run, run%x_interface)
      end if
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
    call subtract_layer_force(run%system, run%scheme%stage(stage)%c_layer, run%x, run%b)
    if (run%plan%damping) call subtract_damping_force(run%system, &
        run%scheme%stage(stage)%c_c, run%x, run%b)
    if (allocated(run%shift)) call add_shift(run%shift, -run%x, run%b)
    if (run%plan%contact) call add_interface_forces(run, run%force)
    call add_correction(run)
  end subroutine refine_motion

  !> Adds forces of the interface (dim, m) to b.
  pure subroutine add_interface_forces(run, force)
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: force(:, :)
    integer :: k
    do k = 1, size(run%contact%interface_node)
      associate (i => run%contact%interface_node(k))
        run%b(:, i) = run%b(:, i) + force(:, k)
      end associate
    end do
    if (allocated(run%rigid)) call gather_forces(run%model%rigid, run%rigid%lever, run%b)
  end subroutine add_interface_forces

  !> x = x + A^-1 b, held dofs kept.
  subroutine add_correction(run)
    type(run_t), intent(inout) :: run
    if (run%system%any_fixed) call clear_fixed(run%system, run%b)
    call run%timers%enter(phase_solve)
    call solve_whole(run%solver, run%b, run%correction)
    run%x = run%x + run%correction
    if (allocated(run%rigid)) call follow(run, run%x)
    run%solves = run%solves + 1
  end subroutine add_correction

  !> Supports and prescribed motions in the right-hand side.
  subroutine constrain_dofs(run, stage, t1)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: t1
    if (run%plan%reactions) call keep_right_side(run)
    if (is_refined(run)) run%b_kept = run%b
    if (run%plan%motions) then
      call impose_motions(run, stage, t1)
    else if (run%system%any_fixed) then
      call clear_fixed(run%system, run%b)
    end if
  end subroutine constrain_dofs

  !> The whole unknown of the stage without contact: x - A^-1 H' r.
  subroutine find_free(run, acting)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: acting
    run%scheme%free = run%x
    if (.not. acting) return
    run%b = zero
    call add_interface_forces(run, run%force)
    if (run%system%any_fixed) call clear_fixed(run%system, run%b)
    call solve_whole(run%solver, run%b, run%scheme%free)
    run%scheme%free = run%x - run%scheme%free
    if (allocated(run%rigid)) call follow(run, run%scheme%free)
    run%solves = run%solves + 1
  end subroutine find_free

  !> Contact on the interface: reactions for the free motion x_interface, then the motion with
  !> them.
  subroutine add_contact(run, acting, status)
    type(run_t), intent(inout) :: run
    logical, intent(inout) :: acting
    type(status_t), intent(inout) :: status
    run%force = zero
    if (run%contact%listed == 0 .and. run%contact%rows%n == 0) return
    call run%timers%enter(phase_contact)
    if (allocated(run%rigid)) then
      call spread_flexibility(run)
      call spread_motion(run)
      call solve_contact(run%model, run%contact, run%state%u, run%state%v, run%rigid%x, &
          largest_work(run%ledger), run%force, acting, status)
    else
      call solve_contact(run%model, run%contact, run%state%u, run%state%v, run%x_interface, &
          largest_work(run%ledger), run%force, acting, status)
    end if
    if (run%plan%dump .and. acting) call dump_contact(run, status)
    call run%timers%enter(phase_solve)
    if (.not. acting) return
    if (allocated(run%rigid)) then
      run%x_interface = run%b_interface
      call collect_forces(run, run%x_interface)
    else
      call clear_constrained(run%contact, run%force)
      run%x_interface = run%b_interface + run%force
    end if
    call run%solver%solve_schur(run%x_interface)
  end subroutine add_contact

  !> The same where S^-1 is not kept: from the whole free motion run%x to that with contact.
  subroutine add_local_contact(run, acting, status)
    type(run_t), intent(inout) :: run
    logical, intent(inout) :: acting
    type(status_t), intent(inout) :: status
    integer :: k
    run%force = zero
    if (run%contact%listed == 0 .and. run%contact%rows%n == 0) return
    call run%timers%enter(phase_contact)
    associate (node => run%contact%interface_node, local => run%contact%local)
      do k = 1, size(node)
        run%x_contact(:, k) = run%x(:, node(k))
      end do
      call solve_contact(run%model, run%contact, run%state%u, run%state%v, run%x_contact, &
          largest_work(run%ledger), run%force, acting, status)
      call run%timers%enter(phase_solve)
      if (.not. acting) return
      call move_by(run%contact, run%force)
      if (local%is_exact) then
        do k = 1, size(node)
          run%x(:, node(k)) = run%x(:, node(k)) + local%motion(:, k)
        end do
      else
        run%x = run%x + local%x
      end if
      call clear_constrained(run%contact, run%force)
    end associate
  end subroutine add_local_contact

  !> The contact problem of the step as a file, where the deck asks for it, solved or not.
  subroutine dump_contact(run, status)
    type(run_t), intent(in) :: run
    type(status_t), intent(inout) :: status
    type(status_t) :: writing
    character(24) :: name
    integer :: step
    step = run%state%cycle + 1
    associate (c => run%model%controls, p => run%contact)
      if (step < c%dump_first .or. step > c%dump_last) return
      if (mod(step - c%dump_first, c%dump_every) /= 0) return
      write (name, '(a,i9.9,a)') 'contact_', step, '.txt'
      call write_contact_problem(join_path(run%folder, trim(name)), 'step '//to_text(step), &
          p%w%matrix, p%q, p%mu, p%r, writing)
    end associate
    if (.not. failed(status)) status = writing
  end subroutine dump_contact

  !> Loads at both ends of the step, and their weighted sum into b.
  subroutine weigh_loads(run, stage, t1)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: t1
    run%load_0 = zero
    run%load_1 = zero
    if (.not. run%starts_from_rest) &
        call add_loads(run%model, run%system, run%state%time, one, run%load_0)
    call add_loads(run%model, run%system, t1, one, run%load_1)
    associate (weight => run%scheme%stage(stage)%load_weight)
      run%b = weight(1)*run%load_0 + weight(2)*run%load_1
    end associate
  end subroutine weigh_loads

end module run_stage
