! SPDX-License-Identifier: BSD-3-Clause
!> From the deck to a run that can start: model, plan, matrices, contact, scheme, factor.
module run_setup
  use assembly_bending, only: make_bending
  use assembly_turns, only: first_inverted
  use assembly_system, only: make_system, stiffness_ratio
  use base_kinds, only: wp, zero, one
  use base_messages, only: add_message
  use base_status, only: status_t, fail, failed, add_place, status_numerical, status_deck
  use base_timers, only: phase_input, phase_assemble, phase_search, phase_other
  use contact_adjust, only: adjust_nodes
  use contact_rule, only: level_position, level_velocity
  use contact_search, only: update_lists
  use contact_setup, only: make_contact, contact_nodes
  use deck_keywords, only: fill_table
  use deck_names, only: overlap_adjust
  use deck_parameter, only: override_t
  use deck_reader, only: read_deck
  use base_strings, only: to_text
  use linalg_bodies, only: find_bodies
  use model_data, only: controls_t
  use model_state, only: make_state
  use run_damping, only: make_damping, start_damping, update_damping
  use run_data, only: run_t
  use run_newton, only: make_newton, choose_force
  use run_motion, only: make_motions, start_reactions
  use run_operator, only: factor_matrix, size_factor, make_operators, change_operators
  use run_plan, only: make_plan, add_feature
  use run_rigid, only: make_rigid
  use run_static, only: make_shift
  use scene_model, only: make_scene
  use time_ledger, only: make_ledger
  use time_registry, only: make_scheme
  implicit none
  private
  public :: read_scene, set_up, prepare, start_factor, size_solver, start_dynamics

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
    call prepare(run, status)
    call start_factor(run, status)
  end subroutine set_up

  !> The second half of SET_UP: the first factors, where most memory is taken.
  subroutine start_factor(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    call factor_matrix(run, .true., status)
    if (failed(status)) return
    call plan_refinement(run)
    call run%timers%enter(phase_other)
  end subroutine start_factor

  !> What the factor of a scene that has been read will need: run%solver%info.
  subroutine size_solver(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    call prepare(run, status)
    call size_factor(run, status)
  end subroutine size_solver

  !> The first half of SET_UP: all that comes before the first factor.
  subroutine prepare(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    integer, allocatable :: massless(:)
    call run%timers%enter(phase_assemble)
    allocate (massless(0))
    if (run%plan%contact) then
      call make_contact(run%model, run%cone, run%contact)
      if (any(run%model%contact%overlap == overlap_adjust)) then
        call adjust_nodes(run%model, run%contact, run%moved)
        call make_contact(run%model, run%cone, run%contact)
      end if
      if (run%model%controls%redistribute) call contact_nodes(run%model, run%contact, massless)
      if (run%model%controls%redistribute .and. size(massless) == 0) call add_message( &
          run%notes, '', 'REDIST 1: no face looks at another body or a wall; all nodes '// &
          'keep their mass')
    else
      allocate (run%contact%interface_node(0), run%contact%pairing(0), run%contact%rows)
    end if
    call make_system(run%model, massless, run%system, status, run%team)
    run%system%threads = run%solver_options%threads
    if (allocated(run%moved)) call tell_moved(run, status)
    if (run%plan%contact .and. .not. failed(status)) call find_contact_bodies(run)
    if (failed(status)) return
    run%static_steps = static_steps(run%model%controls, run%plan%full_steps)
    run%step%mode = run%model%controls%step_mode
    run%step%is_static = run%static_steps > 0
    run%step%full_steps = run%plan%full_steps
    run%step%last_step = run%plan%last_step
    call make_scheme(run%model%controls, run%static_steps > 0, run%scheme, status)
    if (failed(status)) return
    if (run%model%controls%is_finite) call make_newton(run)
    if (run%static_steps > 0) call make_shift(run%model, run%system, run%shift, &
        run%model%controls%static_shift)
    if (allocated(run%shift)) then
      allocate (run%x_pass, run%move, mold=run%model%x)
      allocate (run%unbalanced(run%system%dim, run%system%n), source=zero)
      run%x_pass = zero
      if (allocated(run%model%rigid)) run%least_energy = run%model%controls%static_residual* &
          maxval(run%shift)*maxval(maxval(run%model%x, dim=2) - minval(run%model%x, dim=2))**2
    end if
    if (run%plan%contact) call set_contact_rule(run)
    call make_state(run%model%v0, run%scheme%has_acceleration, run%state)
    call make_rigid(run)
    if (run%plan%reactions) call make_motions(run)
    if (run%plan%damping) call make_damping(run, run%scheme%h)
    call run%scheme%start(run%model, run%system, run%state, status)
    if (failed(status)) return
    if (run%plan%damping) call start_damping(run)
    if (run%plan%reactions) call start_reactions(run)
    call make_ledger(run%model, run%system, run%state, run%ledger)
    run%ledger%staggered = run%scheme%staggered
    if (run%model%dim == 2 .and. .not. run%model%is_axisymmetric .and. &
        .not. allocated(run%newton)) then
      allocate (run%bending)
      call make_bending(run%model, run%bending)
    end if
    if (.not. abs(run%ledger%total) <= huge(zero)) call fail(status, status_numerical, &
        'the initial energy is not finite (NaN or Inf)', &
        hint='check units and initial velocities')
    if (failed(status)) return
    allocate (run%b(run%system%dim, run%system%n), run%x(run%system%dim, run%system%n))
    run%x = zero
    call make_operators(run, status)
    if (failed(status)) return
    if (run%plan%loads) then
      allocate (run%load_0, run%load_1, mold=run%b)
      run%load_0 = zero
    end if
    if (run%plan%contact) call first_lists(run, status)
  end subroutine prepare

  !> The bodies of which interface nodes are, in scenes whose effective matrix couples no two.
  subroutine find_contact_bodies(run)
    type(run_t), intent(inout) :: run
    integer :: bodies
    if (allocated(run%model%rigid)) return
    if (allocated(run%contact%body)) deallocate (run%contact%body)
    allocate (run%contact%body(run%system%n))
    call find_bodies(run%system%graph, run%contact%body, bodies)
  end subroutine find_contact_bodies

  !> A note of nodes that were moved onto obstacles; fails where that has spoilt an element.
  subroutine tell_moved(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    integer :: element, k
    real(wp) :: farthest
    farthest = zero
    do k = 1, size(run%moved)
      farthest = max(farthest, norm2(run%moved(k)%by))
    end do
    call add_message(run%notes, '', 'OVERLAP ADJUST moved '//to_text(size(run%moved))// &
        ' nodes onto obstacles, by '//to_text(farthest)//' at most; the log lists them')
    allocate (run%state%u(run%system%dim, run%model%nodes), source=zero)
    element = first_inverted(run%model, run%system, run%state%u)
    deallocate (run%state%u)
    if (element > 0) call fail(status, status_deck, 'OVERLAP ADJUST turns element '// &
        to_text(run%model%mesh%id(element))//' inside out', &
        hint='the overlap is as deep as the element: move the bodies apart in the mesh')
  end subroutine tell_moved

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
    real(wp) :: ratio, of_stiffness, steps
    integer :: k
    if (allocated(run%newton)) then
      call add_feature(run%plan, 'refinement', .false., "Newton's method refines by itself")
      return
    end if
    ratio = zero
    do k = 1, size(run%scheme%stage)
      associate (s => run%scheme%stage(k))
        of_stiffness = s%c_k
        if (run%plan%damping) of_stiffness = of_stiffness &
            + s%c_c*maxval([zero, run%system%damping%coefficient])
        if (s%c_m > zero) then
          ratio = max(ratio, stiffness_ratio(run%system, s%c_m, of_stiffness))
        else
          ratio = huge(zero)
        end if
      end associate
    end do
    steps = zero
    if (ratio <= refinement_ratio) &
        steps = min(real(huge(1), wp), largest_drift/max(factor*ratio, tiny(ratio)))
    run%plan%refined_from = int(steps)
    run%plan%refinement = run%plan%refined_from < run%plan%full_steps + &
        merge(1, 0, run%plan%last_step > zero)
    if (allocated(run%correction)) return
    if (run%solver%takes_diagonal .and. .not. allocated(run%other)) then
      call add_feature(run%plan, 'refinement', .false., 'the effective matrix is diagonal')
      return
    end if
    call add_feature(run%plan, 'refinement', run%plan%refinement, 'stiffness/inertia = '// &
        to_text(ratio)//' in the effective matrix, limit '//to_text(refinement_ratio)// &
        '; after '//to_text(run%plan%refined_from)//' steps, when the drift may pass '// &
        to_text(largest_drift))
    if (run%plan%refinement) allocate (run%correction, run%b_kept, mold=run%b)
  end subroutine plan_refinement

  !> What contact must know of the scheme: whether forces of both ends of a step act (then
  !> rows are kept for a step), and whether their work is known from the law of contact on
  !> positions (if not, closing overlaps has no bound).
  subroutine set_contact_rule(run)
    type(run_t), intent(inout) :: run
    integer :: p
    run%contact%keeps_before = run%scheme%weight_before > zero
    run%contact%splits_work = .not. run%contact%keeps_before &
        .and. .not. run%scheme%staggered%on .and. size(run%scheme%stage) == 1 &
        .and. run%scheme%stage(1)%rule%level == level_position
    if (any(run%scheme%stage%rule%level == level_velocity) .and. &
        .not. allocated(run%contact%placed)) allocate (run%contact%placed, source=run%model%v0)
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

  !> From the static phase to dynamics: the scheme of the deck begins at the displacements and
  !> reactions as they are, with the initial velocities of the deck.
  subroutine start_dynamics(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    logical :: changed, again
    call make_scheme(run%model%controls, .false., run%scheme, status)
    if (run%plan%contact) call set_contact_rule(run)
    if (allocated(run%shift)) deallocate (run%shift, run%x_pass, run%move, run%unbalanced)
    run%state%v = run%model%v0
    call make_rigid(run)
    run%scheme%starts_in_balance = .true.
    if (run%plan%damping) call update_damping(run, run%state%time + run%scheme%h, changed)
    call run%scheme%start(run%model, run%system, run%state, status)
    if (run%plan%damping) call start_damping(run)
    if (run%plan%damping .and. run%plan%reactions) call start_reactions(run)
    call change_operators(run, again, status)
    if (allocated(run%newton)) call choose_force(run)
    call factor_matrix(run, again, status)
    call plan_refinement(run)
  end subroutine start_dynamics

end module run_setup
