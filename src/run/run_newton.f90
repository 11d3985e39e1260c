! SPDX-License-Identifier: BSD-3-Clause
!> A stage at finite deformation: Newton's method on
!>   R(x) = b - c_m M x - f*(U0, U0 + x) + H' r = 0,  x = U1 - U0,
!> with the law of contact for all of x and r in each pass: from R without r the motion d_f,
!> then u = W r + q with q of x + d_f, then d = d_f + A^-1 H' r. r is the whole force, so that
!> nothing of contact is linearised; the factor of A is that of the start of the step as long
!> as it serves, for an old A costs passes and no accuracy.
module run_newton
  use assembly_damping, only: subtract_damping_force
  use assembly_solid, only: add_solid_energy, begin_solids, commit_solids, &
      subtract_solid_force, subtract_tangent_product, smallest_volume, find_compression, &
      exchange_solids, plastic_work
  use assembly_system, only: clear_fixed, set_fixed, multiply_mass
  use base_archive, only: archive_t
  use base_kinds, only: wp, zero, one, half
  use base_status, only: status_t, fail, failed, status_numerical
  use base_strings, only: to_text
  use base_timers, only: phase_product, phase_solve
  use material_base, only: has_value, plane_stress
  use run_damping, only: subtract_damping
  use run_data, only: run_t
  use run_engine, only: kept_nodes
  use run_operator, only: factor_matrix
  use run_motion, only: find_given
  use run_static, only: add_shift
  use solid_block, only: force_rule_t, force_ends, force_middle
  use run_stage, only: add_contact, add_interface_forces, weigh_loads, follow
  use time_ledger, only: find_strain_energies
  implicit none
  private
  character(*), parameter :: take_less = 'take a smaller step, or MODE HALVE of *BIPACT_STEP'
  public :: make_newton, choose_force, iterates, solve_newton, close_newton, exchange_newton

contains

  !> Work space; what the force of a step is.
  subroutine make_newton(run)
    type(run_t), intent(inout) :: run
    allocate (run%newton)
    allocate (run%newton%d(run%system%dim, run%system%n), source=zero)
    allocate (run%newton%residual, source=run%newton%d)
    allocate (run%newton%load, source=run%newton%d)
    allocate (run%newton%trial, source=run%newton%d)
    if (run%plan%contact .and. any(run%model%controls%frame == [character(5) :: '', 'MID'])) &
        allocate (run%contact%half_motion, source=run%newton%d)
    run%newton%length = maxval(maxval(run%model%x, dim=2) - minval(run%model%x, dim=2))
    run%newton%is_explicit = run%model%controls%is_explicit
    call choose_force(run)
  end subroutine make_newton

  !> The force of a step in the scheme as it is; statics has that of the end.
  subroutine choose_force(run)
    type(run_t), intent(inout) :: run
    associate (c_k => run%scheme%stage(1)%c_k)
      run%system%force_rule = force_rule_t(kind=run%model%controls%force, before=one - c_k, &
          now=c_k)
    end associate
    if (run%step%is_static) run%system%force_rule%kind = force_ends
  end subroutine choose_force

  !> Does Newton's method find the motion of a step?
  pure logical function iterates(run)
    type(run_t), intent(in) :: run
    iterates = .false.
    if (allocated(run%newton)) iterates = .not. run%newton%is_explicit
  end function iterates

  !> The motion x of a stage, with contact.
  subroutine solve_newton(run, stage, t1, acting, status)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: t1
    logical, intent(out) :: acting
    type(status_t), intent(inout) :: status
    !> Passes in which contact chooses its rows anew: later ones only turn between two choices.
    integer, parameter :: most_choices = 14
    real(wp) :: change, last
    integer :: pass
    logical :: is_done
    acting = .false.
    is_done = .false.
    if (failed(status)) return
    call begin_iteration(run, stage, t1)
    change = huge(one)
    last = huge(one)
    do pass = 1, run%newton%most_passes
      call find_residual(run, stage)
      if (pass > 2 .and. change > last) call step_back(run, stage)
      if (pass > 1) call judge(run, change, last, pass, is_done)
      if (is_done) exit
      if (needs_factor(run, pass, change, last)) call factor_tangent(run, pass == 1, status)
      last = change
      if (pass == 1 .and. run%plan%motions) call push_motions(run, stage)
      run%contact%keeps_rows = pass > most_choices
      call correct(run, acting, status)
      call move_on(run, change, status)
      if (failed(status)) exit
      run%newton%passes = run%newton%passes + 1
      run%newton%worst = max(run%newton%worst, pass)
    end do
    run%contact%keeps_rows = .false.
    if (is_done) call check_end(run, status)
    if (failed(status)) return
    call count_work(run)
    if (.not. is_done) call refuse_passes(run, change, status)
  end subroutine solve_newton

  !> No convergence: in a load step often because there is no stable state.
  subroutine refuse_passes(run, change, status)
    type(run_t), intent(in) :: run
    real(wp), intent(in) :: change
    type(status_t), intent(inout) :: status
    character(:), allocatable :: text, hint
    text = "Newton's method has not converged in "//to_text(run%newton%most_passes)// &
        ' passes: the last moved by '//to_text(change)
    hint = take_less
    if (run%step%is_static .and. .not. run%system%force_rule%geometric > zero) then
      text = text//'; its matrix is not positive definite'
      hint = 'no stable state may be near: a limit of the load, or buckling; take a '// &
          'smaller load step, or a run in time'
    end if
    call fail(status, status_numerical, text, hint=hint)
  end subroutine refuse_passes

  !> The first x, and what the passes of a step share.
  subroutine begin_iteration(run, stage, t1)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: t1
    integer :: element
    call run%timers%enter(phase_product)
    call begin_solids(run%system%solid, run%system%threads, run%state%u)
    call predict(run, stage, t1)
    run%newton%trial = run%state%u + run%x
    call smallest_volume(run%system%solid, run%newton%trial, run%newton%volume, element)
    run%b = zero
    if (run%plan%loads) call weigh_loads(run, stage, t1)
    call run%scheme%right_side(stage, run%system, run%state, run%b)
    run%newton%load = run%b
    run%newton%factors = 0
    run%newton%steps = run%newton%steps + 1
  end subroutine begin_iteration

  !> The first x: as the bodies fly. Driven dofs are where their velocity brings them; what is
  !> left to where they must be, run%given, comes with the first pass.
  subroutine predict(run, stage, t1)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: t1
    integer :: k
    run%x = run%scheme%h*run%state%v
    if (.not. run%plan%motions) then
      if (run%system%any_fixed) call clear_fixed(run%system, run%x)
      return
    end if
    call find_given(run, stage, t1)
    associate (list => run%system%fixed_list)
      do k = 1, size(list, 2)
        associate (d => list(1, k), i => list(2, k))
          if (run%model%fixed(d, i)) run%x(d, i) = zero
          run%given(d, i) = run%given(d, i) - run%x(d, i)
        end associate
      end do
    end associate
  end subroutine predict

  !> b = b - A times what the driven dofs have still to go.
  subroutine push_motions(run, stage)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    call multiply_mass(run%system, -run%scheme%stage(stage)%c_m, run%given, run%b)
    call subtract_tangent_product(run%system%solid, run%system%force_rule, run%state%u, run%x, &
        run%given, run%b)
    call clear_fixed(run%system, run%b)
  end subroutine push_motions

  !> Where corrections grow the last may have been too long: half of it is taken back as long as
  !> less is left of the balance then.
  subroutine step_back(run, stage)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    integer, parameter :: most_halvings = 4
    real(wp) :: left, before, largest
    integer :: k
    call measure_balance(run, before, largest)
    do k = 1, most_halvings
      run%newton%d = half*run%newton%d
      call shift(run, -one)
      call find_residual(run, stage)
      call measure_balance(run, left, largest)
      if (left < before) then
        before = left
        cycle
      end if
      call shift(run, one)
      call find_residual(run, stage)
      return
    end do
  end subroutine step_back

  !> x = x + share d; what driven dofs have still to go is so much less.
  subroutine shift(run, share)
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: share
    integer :: k
    run%x = run%x + share*run%newton%d
    if (.not. run%plan%motions) return
    associate (list => run%system%fixed_list)
      do k = 1, size(list, 2)
        associate (d => list(1, k), i => list(2, k))
          run%given(d, i) = run%given(d, i) - share*run%newton%d(d, i)
        end associate
      end do
    end associate
  end subroutine shift

  !> run%b: what is left of the balance at x but for contact, held dofs cleared.
  subroutine find_residual(run, stage)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    call run%timers%enter(phase_product)
    run%b = run%newton%load
    call multiply_mass(run%system, -run%scheme%stage(stage)%c_m, run%x, run%b)
    call subtract_solid_force(run%system%solid, run%system%threads, run%system%force_rule, &
        one, run%state%u, run%x, run%b, run%newton%work)
    if (run%plan%damping) then
      call subtract_damping(run, stage)
      call subtract_damping_force(run%system, run%scheme%stage(stage)%c_c, run%x, run%b)
    end if
    if (allocated(run%shift)) call add_shift(run%shift, run%x_pass - run%x, run%b)
    run%newton%residual = run%b
    if (run%system%any_fixed) call clear_fixed(run%system, run%b)
  end subroutine find_residual

  !> The work of the internal force that the balance of the scheme counts: of its ends weighted
  !> as the loads are.
  subroutine count_work(run)
    type(run_t), intent(inout) :: run
    type(force_rule_t) :: counted
    associate (rule => run%system%force_rule, weight => run%scheme%load_work_weight)
      if (rule%kind /= force_ends) return
      if (.not. abs(rule%now - weight(2)) > zero) return
      counted = force_rule_t(kind=force_ends, before=weight(1), now=weight(2))
      call subtract_solid_force(run%system%solid, run%system%threads, counted, one, &
          run%state%u, run%x, run%newton%d, run%newton%work)
    end associate
  end subroutine count_work

  !> Is x the solution: did the last pass move little? Or does round-off let nothing better be?
  !> And, where the deck asks for it, is little left of the balance?
  subroutine judge(run, change, last, pass, is_done)
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: change, last
    integer, intent(in) :: pass
    logical, intent(out) :: is_done
    real(wp), parameter :: floor = 1.0e-8_wp, at_rest = 0.9_wp
    integer, parameter :: enough = 20
    real(wp) :: motion, left, largest
    motion = maxval(abs(run%x))
    is_done = change <= max(run%model%controls%iteration%motion*motion, &
        4.0_wp*epsilon(one)*run%newton%length)
    is_done = is_done .or. (change < floor*motion .and. (change > at_rest*last .or. &
        pass > enough))
    associate (i => run%model%controls%iteration)
      if (.not. max(i%force, i%absolute) > zero) return
      call measure_balance(run, left, largest)
      if (i%force > zero) is_done = is_done .and. left <= i%force*largest
      is_done = is_done .or. left <= i%absolute
    end associate
  end subroutine judge

  !> The largest component of what is left of the balance at x, with contact, and of the forces
  !> in it [F].
  subroutine measure_balance(run, left, largest)
    type(run_t), intent(inout) :: run
    real(wp), intent(out) :: left, largest
    largest = max(maxval(abs(run%newton%load)), maxval(abs(run%newton%residual)))
    run%newton%trial = run%b
    if (run%plan%contact) then
      if (allocated(run%rigid)) then
        call add_interface_forces(run, run%rigid%x)
      else
        call add_interface_forces(run, run%force)
      end if
    end if
    if (run%system%any_fixed) call clear_fixed(run%system, run%b)
    left = maxval(abs(run%b))
    run%b = run%newton%trial
  end subroutine measure_balance

  !> The tangent at x. Where it is not positive definite the part that the stresses make is left
  !> out, for the rest of a step in time: what remains is, and its solution is the same.
  subroutine factor_tangent(run, is_first, status)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: is_first
    type(status_t), intent(inout) :: status
    if (failed(status)) return
    run%newton%factors = run%newton%factors + 1
    if (is_first .or. run%step%is_static) run%system%force_rule%geometric = one
    call factor_matrix(run, .false., status)
    if (status%code /= status_numerical) return
    if (.not. run%system%force_rule%geometric > zero) return
    status = status_t()
    run%system%force_rule%geometric = zero
    call factor_matrix(run, .false., status)
    if (status%code == status_numerical) status%hint = take_less// &
        '; or is a part held by nothing?'
  end subroutine factor_tangent

  !> At the start, and where the last passes converged slowly; in a load step, whose matrix no
  !> mass keeps definite, each time; or as the deck says.
  pure logical function needs_factor(run, pass, change, last)
    type(run_t), intent(in) :: run
    integer, intent(in) :: pass
    real(wp), intent(in) :: change, last
    integer, parameter :: tried(2) = [6, 12]    ! passes after which the factor is made anew
    associate (i => run%model%controls%iteration)
      if (i%every > 0) then
        needs_factor = mod(pass - 1, i%every) == 0
      else if (run%step%is_static) then
        needs_factor = .true.
      else
        needs_factor = pass == 1 .or. any(pass == tried) .or. &
            pass > 3 .and. change > half*last
      end if
      if (i%most_factors > 0) needs_factor = needs_factor .and. &
          run%newton%factors < i%most_factors
    end associate
  end function needs_factor

  !> run%newton%d: the correction of x, with contact.
  subroutine correct(run, acting, status)
    type(run_t), intent(inout) :: run
    logical, intent(inout) :: acting
    type(status_t), intent(inout) :: status
    real(wp) :: free(size(run%b_interface, 1), size(run%b_interface, 2))
    if (failed(status)) return
    call run%timers%enter(phase_solve)
    call run%solver%forward(run%b, run%b_interface)
    free = run%b_interface
    call run%solver%solve_schur(free)
    if (run%plan%contact) then
      if (allocated(run%contact%half_motion)) run%contact%half_motion = half*run%x
      run%x_interface = run%x(:, kept_nodes(run)) + free
      call add_contact(run, acting, status)
      if (.not. acting) run%x_interface = free
    else
      run%x_interface = free
    end if
    call run%solver%backward(run%x_interface, run%newton%d)
    run%solves = run%solves + 1
    if (allocated(run%rigid)) call follow(run, run%newton%d)
    if (.not. run%plan%motions) return
    call set_fixed(run%system, run%given, run%newton%d)    ! given: what there is to go yet
  end subroutine correct

  !> x = x + d, or less of d where an element would nearly be turned inside out.
  subroutine move_on(run, change, status)
    type(run_t), intent(inout) :: run
    real(wp), intent(out) :: change
    type(status_t), intent(inout) :: status
    real(wp), parameter :: least_share = 1.0e-3_wp, kept = 0.4_wp    ! of det F
    real(wp) :: share, volume
    integer :: element
    change = huge(one)
    if (failed(status)) return
    share = one
    do
      run%newton%trial = run%state%u + run%x + share*run%newton%d
      call smallest_volume(run%system%solid, run%newton%trial, volume, element)
      if (volume > kept*min(run%newton%volume, one)) exit
      share = half*share
      if (share < least_share) then
        call refuse_inversion(run, element, status)
        return
      end if
    end do
    run%newton%volume = volume
    change = maxval(abs(run%newton%d))
    if (share < one) run%newton%d = share*run%newton%d
    call shift(run, one)
  end subroutine move_on

  subroutine refuse_inversion(run, element, status)
    type(run_t), intent(in) :: run
    integer, intent(in) :: element
    type(status_t), intent(inout) :: status
    call fail(status, status_numerical, 'element '//to_text(run%model%mesh%id(element))// &
        ' is turned inside out (det F <= 0)', &
        hint=take_less)
  end subroutine refuse_inversion

  !> The end of a step that has converged: has each law a value there, and does it hold? The
  !> force of the middle has not asked, nor a quadratic energy in plane stress.
  subroutine check_end(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    real(wp) :: energy
    integer :: b
    if (failed(status)) return
    run%newton%trial = run%state%u + run%x
    energy = zero
    do b = 1, size(run%system%solid)
      associate (s => run%system%solid(b))
        if (s%n == 0) cycle
        if (s%plane == plane_stress .or. run%system%force_rule%kind == force_middle) &
            call add_solid_energy(s, run%newton%trial, energy)
      end associate
    end do
    if (.not. has_value(energy)) call fail(status, status_numerical, &
        'a law has no value at the end of the step: an element is pressed or drawn too far', &
        hint=take_less)
    call check_compression(run, run%newton%trial, status)
  end subroutine check_end

  !> A law that gives way under compression fails below its least stretch at the displacements
  !> u of an end of a step, and is warned of before.
  subroutine check_compression(run, u, status)
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: u(:, :)
    type(status_t), intent(inout) :: status
    real(wp) :: stretch, limit
    integer :: element
    if (failed(status)) return
    call find_compression(run%system%solid, u, stretch, element, limit)
    if (element == 0) return
    if (stretch < limit) then
      call fail(status, status_numerical, 'element '//to_text(run%model%mesh%id(element))// &
          ' is compressed to stretch '//to_text(stretch)//': its law (St Venant and '// &
          'Kirchhoff) gives way below '//to_text(limit), &
          hint='take LAW HENCKY of *BIPACT_KINEMATICS, a law of rubber, or a smaller step')
      return
    end if
    run%newton%compressed = run%newton%compressed + 1
    if (stretch >= run%newton%stretch) return
    run%newton%stretch = stretch
    run%newton%compressed_element = element
  end subroutine check_compression

  !> After the update: the history of the points is that of the end; what the internal force
  !> took beside strain energy and plastic work goes to the algorithmic loss.
  subroutine close_newton(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    real(wp) :: energy, plastic
    if (run%newton%is_explicit) then
      run%newton%work = run%scheme%stage(1)%force_weight* &
          sum(run%newton%residual*run%scheme%conjugate)
      call check_shapes(run, status)
    end if
    call find_strain_energies(run%model, run%system, run%state, run%ledger)
    energy = sum(run%ledger%part_internal)
    call commit_solids(run%system%solid, run%state%u)
    plastic = plastic_work(run%system%solid)
    run%ledger%algorithmic = run%ledger%algorithmic + (run%newton%work &
        - (energy - run%newton%energy) - (plastic - run%ledger%plastic))
    run%ledger%plastic = plastic
    run%newton%energy = energy
  end subroutine close_newton

  !> An explicit step has no passes that could see what became of its elements.
  subroutine check_shapes(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    real(wp) :: volume
    integer :: element
    if (failed(status)) return
    call smallest_volume(run%system%solid, run%state%u, volume, element)
    if (.not. volume > zero) call refuse_inversion(run, element, status)
    call check_compression(run, run%state%u, status)
  end subroutine check_shapes

  !> Saves to or restores from the archive what a step changes: histories, counts.
  subroutine exchange_newton(archive, run)
    type(archive_t), intent(inout) :: archive
    type(run_t), intent(inout) :: run
    integer :: counts(5)
    counts = [run%newton%passes, run%newton%steps, run%newton%worst, run%newton%compressed, &
        run%newton%compressed_element]
    call archive%exchange('newton.counts', counts)
    run%newton%passes = counts(1)
    run%newton%steps = counts(2)
    run%newton%worst = counts(3)
    run%newton%compressed = counts(4)
    run%newton%compressed_element = counts(5)
    call archive%exchange('newton.stretch', run%newton%stretch)
    call archive%exchange('newton.energy', run%newton%energy)
    call exchange_solids(archive, run%system%solid)
  end subroutine exchange_newton

end module run_newton
