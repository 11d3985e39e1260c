! SPDX-License-Identifier: BSD-3-Clause
!> From the deck to a run that can start: model, plan, matrices, contact, scheme, factor.
module run_setup
  use assembly_bending, only: make_bending
  use assembly_system, only: make_system, effective_matrix, stiffness_ratio
  use base_kinds, only: wp, zero, one
  use base_messages, only: add_message
  use base_status, only: status_t, fail, failed, add_place, status_numerical
  use base_timers, only: phase_input, phase_assemble, phase_factor, phase_search, phase_other
  use contact_condense, only: constrain_interface
  use contact_search, only: update_lists
  use contact_setup, only: make_contact, contact_nodes
  use deck_keywords, only: fill_table
  use deck_parameter, only: override_t
  use deck_reader, only: read_deck
  use base_strings, only: to_text
  use linalg_registry, only: make_solver
  use model_data, only: controls_t
  use model_state, only: make_state
  use run_data, only: run_t
  use run_motion, only: make_motions, start_reactions
  use run_plan, only: make_plan, add_feature
  use run_static, only: make_shift
  use scene_model, only: make_scene
  use time_ledger, only: make_ledger
  use time_registry, only: make_scheme
  implicit none
  private
  public :: read_scene, set_up, factor_matrix, start_dynamics

  !> About a Courant number of 10.
  real(wp), parameter :: refinement_ratio = 200.0_wp
  !> Share of the energy: a tenth of what the ledger promises over a run.
  real(wp), parameter :: largest_drift = 1.0e-12_wp

contains

  !> Reads and checks the deck, and plans the run. Nothing is written.
  subroutine read_scene(path, overrides, run, status)
    character(*), intent(in) :: path
    type(override_t), intent(inout) :: overrides(:)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    call run%timers%enter(phase_input)
    call fill_table(run%deck%table)
    call read_deck(path, overrides, run%deck, status)
    if (failed(status)) return
    call make_scene(run%deck, run%model, run%cone, run%solver_options, status)
    if (failed(status)) return
    call make_plan(run%model, run%plan)
    run%notes = run%deck%problems%notes
    run%warnings = run%deck%problems%warnings
    call run%timers%enter(phase_other)
  end subroutine read_scene

  !> Makes everything that the plan needs; what has failed is the last thing made. Nothing is
  !> written.
  subroutine set_up(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    integer, allocatable :: massless(:)
    call run%timers%enter(phase_assemble)
    allocate (massless(0))
    if (run%plan%contact) then
      call make_contact(run%model, run%cone, run%contact)
      if (run%model%controls%redistribute) call contact_nodes(run%model, run%contact, massless)
    else
      allocate (run%contact%interface_node(0), run%contact%pairing(0), run%contact%rows)
    end if
    call make_system(run%model, massless, run%system, status)
    if (failed(status)) return
    run%static_steps = static_steps(run%model%controls, run%plan%full_steps)
    run%step%mode = run%model%controls%step_mode
    run%step%is_static = run%static_steps > 0
    run%step%full_steps = run%plan%full_steps
    run%step%last_step = run%plan%last_step
    call make_scheme(run%model%controls, run%static_steps > 0, run%scheme, status)
    if (failed(status)) return
    if (run%static_steps > 0) call make_shift(run%model, run%system, run%shift, &
        run%model%controls%static_shift)
    if (allocated(run%shift)) then
      allocate (run%x_pass(2, run%system%n), run%move(2, run%system%n))
      allocate (run%unbalanced(2, run%system%n), source=zero)
      run%x_pass = zero
    end if
    if (run%plan%contact) call set_contact_rule(run)
    call make_state(run%model%v0, run%scheme%has_acceleration, run%state)
    if (run%plan%reactions) call make_motions(run)
    call run%scheme%start(run%model, run%system, run%state, status)
    if (failed(status)) return
    if (run%plan%reactions) call start_reactions(run)
    call make_ledger(run%model, run%system, run%state, run%ledger)
    run%ledger%staggered = run%scheme%staggered
    call make_bending(run%model, run%bending)
    if (.not. abs(run%ledger%total) <= huge(zero)) call fail(status, status_numerical, &
        'the initial energy is not finite (NaN or Inf)', &
        hint='check units and initial velocities')
    if (failed(status)) return
    call make_solver(run%solver_options, run%solver, status)
    if (failed(status)) return
    allocate (run%b(2, run%system%n), run%x(2, run%system%n))
    run%x = zero
    if (run%plan%loads) then
      allocate (run%load_0(2, run%system%n), run%load_1(2, run%system%n))
      run%load_0 = zero
    end if
    if (run%plan%contact) call first_lists(run, status)
    if (failed(status)) return
    call factor_matrix(run, .true., status)
    if (failed(status)) return
    call plan_refinement(run)
    call run%timers%enter(phase_other)
  end subroutine set_up

  !> Steps of the static phase: all, those up to TDYBIR, or none.
  pure integer function static_steps(controls, steps)
    type(controls_t), intent(in) :: controls
    integer, intent(in) :: steps
    static_steps = 0
    if (controls%is_static) static_steps = steps + 1
    if (controls%static_until > zero) static_steps = nint(controls%static_until/controls%dt)
  end function static_steps

  !> Long steps make the effective matrix nearly singular for rigid motions, and the solution
  !> loses digits that the ledger needs: each solve multiplies a momentum by 1 + eps times
  !> stiffness/inertia, always with the same sign, for the factor is the same. Where one step
  !> loses much, and from the step on up to which the losses may have grown to largest_drift,
  !> each solve is followed by one correction. The number of steps so far decides, not the end
  !> time: a run that goes on to a later end is the longer run.
  subroutine plan_refinement(run)
    type(run_t), intent(inout) :: run
    !> Of a free body, measured: 1 to 2.4 for the momentum, twice that for the energy.
    real(wp), parameter :: factor = 5.0_wp*epsilon(zero)
    real(wp) :: ratio, steps
    ratio = huge(zero)
    if (run%scheme%stage(1)%c_m > zero) ratio = stiffness_ratio(run%system, &
        run%scheme%stage(1)%c_m, run%scheme%stage(1)%c_k)
    steps = zero
    if (ratio <= refinement_ratio) &
        steps = min(real(huge(1), wp), largest_drift/max(factor*ratio, tiny(ratio)))
    run%plan%refined_from = int(steps)
    run%plan%refinement = run%plan%refined_from < run%plan%full_steps + &
        merge(1, 0, run%plan%last_step > zero)
    if (allocated(run%correction)) return
    call add_feature(run%plan, 'refinement', run%plan%refinement, 'stiffness/inertia = '// &
        to_text(ratio)//' in the effective matrix, limit '//to_text(refinement_ratio)// &
        '; after '//to_text(run%plan%refined_from)//' steps, when the drift may pass '// &
        to_text(largest_drift))
    if (run%plan%refinement) &
        allocate (run%correction(2, run%system%n), run%b_kept(2, run%system%n))
  end subroutine plan_refinement

  !> What contact must know of the scheme: whether forces of both ends of a step act (then
  !> rows are kept for a step, and closing overlaps has no bound).
  subroutine set_contact_rule(run)
    type(run_t), intent(inout) :: run
    integer :: p
    run%contact%keeps_before = run%scheme%weight_before > zero
    run%contact%splits_work = .not. run%contact%keeps_before &
        .and. .not. run%scheme%staggered%on
    do p = 1, size(run%contact%pairing)
      run%contact%pairing(p)%item%is_energy_safe = run%contact%splits_work
    end do
  end subroutine set_contact_rule

  subroutine first_lists(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    logical :: new_interface
    call run%timers%enter(phase_search)
    call update_lists(run%model, run%contact, run%state%u, run%state%du, run%state%v, zero, &
        run%scheme%h, 0, run%scheme%h, new_interface, status)
    if (failed(status)) call add_place(status, &
        run%deck%place(run%contact%pairing(run%contact%searched)%item%record))
  end subroutine first_lists

  !> Factor of the effective matrix, with the interface nodes last and their flexibility;
  !> again is true when the interface has changed and the order must be found anew.
  subroutine factor_matrix(run, again, status)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: again
    type(status_t), intent(inout) :: status
    integer :: m
    if (failed(status)) return
    call run%timers%enter(phase_factor)
    associate (stage => run%scheme%stage(1))
      call effective_matrix(run%system, stage%c_m, stage%c_layer, stage%c_k, run%matrix)
    end associate
    if (allocated(run%shift)) call shift_matrix(run)
    m = size(run%contact%interface_node)
    if (again) then
      call run%solver%analyse(run%system%graph, run%contact%interface_node, status)
      if (failed(status)) return
      run%analyses = run%analyses + 1
      if (allocated(run%b_interface)) deallocate (run%b_interface, run%x_interface, run%force)
      allocate (run%b_interface(2, m), run%x_interface(2, m), run%force(2, m))
      if (2*m > run%solver_options%block_limit) &
          call add_message(run%notes, '', 'the contact interface has '//to_text(2*m)// &
          ' dofs, more than NLAST; it is kept dense all the same')
    end if
    call run%solver%factor(run%system%graph, run%matrix, status)
    run%factors = run%factors + 1
    if (m == 0 .or. failed(status)) return
    call run%solver%flexibility(run%contact%schur_inverse)
    call constrain_interface(run%contact, run%system%fixed_list)
  end subroutine factor_matrix

  subroutine shift_matrix(run)
    type(run_t), intent(inout) :: run
    integer :: i, k
    do i = 1, run%system%n
      k = run%system%graph%position(i, i)
      run%matrix%value(1, 1, k) = run%matrix%value(1, 1, k) + run%shift(i)
      run%matrix%value(2, 2, k) = run%matrix%value(2, 2, k) + run%shift(i)
    end do
  end subroutine shift_matrix

  !> From the static phase to dynamics: the scheme of the deck begins at the displacements and
  !> reactions as they are, with the initial velocities of the deck.
  subroutine start_dynamics(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    call make_scheme(run%model%controls, .false., run%scheme, status)
    if (run%plan%contact) call set_contact_rule(run)
    if (allocated(run%shift)) deallocate (run%shift, run%x_pass, run%move, run%unbalanced)
    run%state%v = run%model%v0
    run%scheme%starts_in_balance = .true.
    call run%scheme%start(run%model, run%system, run%state, status)
    call factor_matrix(run, .false., status)
    call plan_refinement(run)
  end subroutine start_dynamics

end module run_setup
