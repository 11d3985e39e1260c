! SPDX-License-Identifier: BSD-3-Clause
!> Contact of one stage of a step, for every scheme: from the free motion of the interface to
!> the reactions. It does not know the scheme: the stage has said what the motion means.
module contact_stage
  use base_checks, only: checks_on, assert, assert_shape
  use base_kinds, only: wp, zero, half, one
  use base_status, only: status_t, fail, failed, add_place, status_numerical
  use base_strings, only: to_text
  use cone_certificate, only: certify
  use cone_types, only: certificate_t, contact_open, most_components, size_cone_work
  use contact_assemble, only: find_rows, add_missing_rows, count_rows
  use contact_condense, only: build_w, mean_flexibility
  use contact_local, only: shift_far, near_product_of
  use contact_monitor, only: check_listed
  use contact_purse, only: start_purses, open_purses, set_offsets, purse_is_short
  use contact_kinematics, only: relative_displacement, add_row_force
  use contact_rows, only: rows_t
  use contact_rule, only: level_position, level_velocity
  use contact_slip, only: solve_friction
  use contact_types, only: contact_t, tally_t
  use contact_velocity, only: find_velocity_rows, keep_pressed_rows, activate_all, &
      add_restitution, largest_component
  use model_data, only: model_t, node_name
  implicit none
  private
  public :: solve_contact, correct_contact, evaluate_contact, certify_stage

  !> Most rounds of a step: each adds rows that the one before has shown to be missing.
  integer, parameter :: most_rounds = 20

contains

  !> Reactions for the free motion x_free (dim, m) of the interface from displacement u and
  !> velocity v (dim, nodes) at the start of the step; force (dim, m) = H' r as A x = b + H' r
  !> takes it. largest [F L]: of the terms of the energy ledger so far. acting is false when
  !> nothing touches, and then force is zero.
  subroutine solve_contact(model, contact, u, v, x_free, largest, force, acting, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: u(:, :), v(:, :), x_free(:, :)
    real(wp), intent(in) :: largest
    real(wp), intent(out), contiguous :: force(:, :)
    logical, intent(out) :: acting
    type(status_t), intent(inout) :: status
    integer :: round
    logical :: is_complete
    if (checks_on) call check_interface(contact, u, x_free, force, 'solve_contact')
    force = zero
    acting = .false.
    contact%idle_steps = 0
    if (contact%rule%level /= level_position) then
      call solve_velocities(model, contact, u, v, x_free, force, acting, status)
      return
    end if
    call find_rows(model, contact, u, x_free)
    call activate_all(contact)
    call shift_reactions(contact)
    ! In space two edges may come to cross within a step that did not at its start.
    if (contact%rows%n + contact%spare%n == 0 .and. contact%dim == 2) return
    call start_purses(contact)
    do round = 1, most_rounds
      call solve_rows(model, contact, v, x_free, largest, round, force, acting, status)
      if (failed(status)) return
      if (round == most_rounds) exit
      call add_missing_rows(model, contact, u, x_free, force, acting, is_complete)
      if (is_complete) exit
    end do
    if (acting) call count_rows(contact)
  end subroutine solve_contact

  !> Assertions on the vectors of a stage: whole (dim, nodes), two of the interface (dim, m).
  subroutine check_interface(contact, whole, first, second, place)
    type(contact_t), intent(in) :: contact
    real(wp), intent(in) :: whole(:, :), first(:, :), second(:, :)
    character(*), intent(in) :: place
    integer :: m
    m = size(contact%interface_node)
    call assert_shape(shape(whole), [contact%dim, size(contact%slot)], place, &
        'the motion of all nodes')
    call assert_shape(shape(first), [contact%dim, m], place, &
        'the first vector of the interface')
    call assert_shape(shape(second), [contact%dim, m], place, &
        'the second vector of the interface')
    call assert(count(contact%slot > 0) == m, place, 'every interface node has a slot')
  end subroutine check_interface

  !> Contact on velocities. Its law says nothing of gaps at the end of the step, so that no row
  !> can be missing there.
  subroutine solve_velocities(model, contact, u, v, x_free, force, acting, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: u(:, :), v(:, :), x_free(:, :)
    real(wp), intent(inout), contiguous :: force(:, :)
    logical, intent(inout) :: acting
    type(status_t), intent(inout) :: status
    type(certificate_t) :: certificate
    if (contact%rule%level == level_velocity) then
      call find_velocity_rows(model, contact, u, v, x_free, status)
      if (failed(status)) return
    else
      call keep_pressed_rows(contact, v)
    end if
    call shift_reactions(contact)
    call build_w(contact)
    if (contact%n == 0) return
    call find_q(contact, x_free)
    if (all(contact%q(1, :) >= zero)) return
    acting = .true.
    contact%largest_velocity = largest_component(size(v), v)
    call start_reactions(contact, .true.)
    call shift_far(contact)
    call find_reactions(model, contact, force, certificate, status)
    call watch_alternation(contact)
    contact%tally%solves = contact%tally%solves + 1
    contact%tally%solves_since_row = contact%tally%solves_since_row + 1
    call count_rows(contact)
  end subroutine solve_velocities

  !> The rows as they are: W, q, reactions; again with smaller offsets where a purse is short.
  subroutine solve_rows(model, contact, v, x_free, largest, round, force, acting, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: v(:, :), x_free(:, :)
    real(wp), intent(in) :: largest
    integer, intent(in) :: round
    real(wp), intent(inout), contiguous :: force(:, :)
    logical, intent(inout) :: acting
    type(status_t), intent(inout) :: status
    type(certificate_t) :: certificate
    integer, parameter :: most_attempts = 3
    integer :: attempt
    call build_w(contact)
    call open_purses(contact)
    do attempt = 1, most_attempts
      call set_offsets(contact)
      if (contact%rule%lead > zero) call add_restitution(contact, v)
      call find_q(contact, x_free)
      force = zero
      if (contact%n == 0) return
      if (.not. acting .and. all(contact%q(1, :) >= zero)) return
      acting = .true.
      call start_reactions(contact, round == 1 .and. attempt == 1)
      if (round == 1 .and. attempt == 1) call shift_far(contact)
      call find_reactions(model, contact, force, certificate, status)
      if (round == 1 .and. attempt == 1) call watch_alternation(contact)
      contact%tally%solves = contact%tally%solves + 1
      contact%tally%solves_since_row = contact%tally%solves_since_row + 1
      if (failed(status)) return
      if (.not. purse_is_short(contact, largest)) exit
      contact%tally%repeats = contact%tally%repeats + 1
    end do
  end subroutine solve_rows

  !> q = H x_free + offsets.
  pure subroutine find_q(contact, x_free)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: x_free(:, :)
    real(wp) :: u(most_components)
    integer :: k
    do k = 1, contact%n
      u = relative_displacement(contact%rows, contact%row_of(k), contact%rows%slot, x_free)
      contact%q(1, k) = contact%rows%offset(contact%row_of(k)) + u(1)
      if (contact%d > 1) contact%q(2, k) = contact%rows%offset_t(1, contact%row_of(k)) + u(2)
      if (contact%d > 2) contact%q(3, k) = contact%rows%offset_t(2, contact%row_of(k)) + u(3)
    end do
  end subroutine find_q

  !> Shifts the reaction history. After three solves without any there is nothing to shift.
  pure subroutine shift_reactions(contact)
    type(contact_t), intent(inout) :: contact
    if (contact%solves_without_contact == 3) return
    contact%solves_without_contact = contact%solves_without_contact + 1
    call shift(contact%rows)
    if (contact%spare%n > 0) call shift(contact%spare)
  end subroutine shift_reactions

  pure subroutine shift(rows)
    type(rows_t), intent(inout) :: rows
    call shift_values(rows%dim*rows%n, rows%r, rows%r_previous, rows%r_older)
    rows%status(:rows%n) = contact_open
  end subroutine shift

  pure subroutine shift_values(n, r, previous, older)
    integer, intent(in) :: n
    real(wp), intent(inout) :: r(n), previous(n), older(n)
    older = previous
    previous = r
    r = zero
  end subroutine shift_values

  !> The start: in the first solve of a step the last reactions, or those before them where
  !> forces alternate; then those of the solve before.
  pure subroutine start_reactions(contact, is_first)
    type(contact_t), intent(inout) :: contact
    logical, intent(in) :: is_first
    integer :: k
    do k = 1, contact%n
      associate (rows => contact%rows, a => contact%row_of(k))
        contact%r(:, k) = contact%rule%factor*rows%r(1:contact%d, a)
        if (.not. is_first) cycle
        contact%r(:, k) = contact%rule%factor*rows%r_previous(1:contact%d, a)
        if (contact%alternates) &
            contact%r(:, k) = contact%rule%factor*rows%r_older(1:contact%d, a)
      end associate
    end do
  end subroutine start_reactions

  !> Which of the two would have been the nearer start?
  pure subroutine watch_alternation(contact)
    type(contact_t), intent(inout) :: contact
    real(wp) :: from_previous, from_older
    integer :: k
    from_previous = zero
    from_older = zero
    do k = 1, contact%n
      associate (rows => contact%rows, a => contact%row_of(k))
        from_previous = from_previous + sum((rows%r(:, a) - rows%r_previous(:, a))**2)
        from_older = from_older + sum((rows%r(:, a) - rows%r_older(:, a))**2)
      end associate
    end do
    contact%alternates = from_older < from_previous
  end subroutine watch_alternation

  !> Reactions of the condensed problem for q and the start in r, put into rows and forces.
  subroutine find_reactions(model, contact, force, certificate, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(inout), contiguous :: force(:, :)
    type(certificate_t), intent(out) :: certificate
    type(status_t), intent(inout) :: status
    integer :: k
    contact%solves_without_contact = 0
    call solve_to_gaps(contact, certificate, status)
    if (certificate%worst > 0) call add_place(status, &
        node_name(model, contact%rows%key(3, contact%row_of(certificate%worst))))
    call keep_certificate(certificate, contact%tally)
    contact%tally%sweeps = contact%tally%sweeps + certificate%sweeps
    contact%tally%sweeps_since_row = contact%tally%sweeps_since_row + certificate%sweeps
    do k = 1, contact%n
      associate (rows => contact%rows, a => contact%row_of(k))
        rows%r(:, a) = zero    ! a frame that has turned may have left a tangential part
        rows%r(1:contact%d, a) = contact%r(:, k)/contact%rule%factor
        if (contact%friction_varies) rows%mu(a) = contact%mu(k)
        rows%status(a) = contact%work%status(k)
        if (.not. contact%r(1, k) > zero) rows%status(a) = contact_open
        if (.not. allocated(contact%local)) &
            call add_row_force(rows, a, contact%rule%factor, rows%slot, force)
      end associate
    end do
    ! The motion by these very forces is known.
    if (allocated(contact%local)) force = contact%local%force
    associate (tally => contact%tally)
      if (certificate%wedged > 0 .and. tally%wedged == 0) tally%wedged_node = &
          contact%rows%key(3, contact%row_of(certificate%first_wedged))
      tally%wedged = tally%wedged + certificate%wedged
    end associate
  end subroutine find_reactions

  !> The contact problem to its tolerance, and of positions so that no gap is deeper than
  !> PENTOL: where it is, to a hundredth of the tolerance, at most twice.
  subroutine solve_to_gaps(contact, certificate, status)
    type(contact_t), intent(inout) :: contact
    type(certificate_t), intent(out) :: certificate
    type(status_t), intent(inout) :: status
    real(wp) :: tolerance
    integer :: attempt, sweeps, k
    logical :: is_deep
    tolerance = contact%cone%tolerance
    sweeps = 0
    do attempt = 1, 3
      call solve_friction(contact, certificate, status)
      sweeps = sweeps + certificate%sweeps
      if (failed(status) .or. contact%rule%level /= level_position) exit
      is_deep = .false.
      do k = 1, contact%n
        is_deep = is_deep .or. -contact%work%u(1, k) > &
            contact%penetration_tolerance*contact%rows%length(contact%row_of(k))
      end do
      if (.not. is_deep) exit
      contact%cone%tolerance = 1.0e-2_wp*contact%cone%tolerance
    end do
    contact%cone%tolerance = tolerance
    certificate%sweeps = sweeps
  end subroutine solve_to_gaps

  !> Corrects the reactions where W is known to fewer digits than the motion du (dim, nodes),
  !> refined with them: q = u(du) - W r, solved again from r. On exit force is that of the
  !> new reactions, more the change of it; both (dim, m) [F]. done: they meet the certificate
  !> as they are.
  subroutine correct_contact(model, contact, du, force, more, done, acting, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: du(:, :)
    real(wp), intent(inout), contiguous :: force(:, :)
    real(wp), intent(out) :: more(:, :)
    logical, intent(out) :: done
    logical, intent(inout) :: acting
    type(status_t), intent(inout) :: status
    type(certificate_t) :: certificate
    integer :: k
    if (checks_on) call check_interface(contact, du, force, more, 'correct_contact')
    done = .true.
    ! Rows of an earlier list, where nothing is listed now.
    if (contact%n == 0 .or. .not. contact%w_is_current) return
    call size_cone_work(contact%work, contact%d, contact%n)
    call find_displacements(contact, du)
    do k = 1, contact%n
      associate (rows => contact%rows, a => contact%row_of(k))
        contact%work%u(:, k) = rows%u(1:contact%d, a)
        contact%r(:, k) = contact%rule%factor*rows%r(1:contact%d, a)
        if (-rows%u(1, a) > half*contact%penetration_tolerance*rows%length(a)) done = .false.
      end associate
    end do
    call certify(mean_flexibility(contact), contact%mu, contact%q, contact%r, contact%work%u, &
        contact%cone%tolerance, certificate, gap_noise(contact, du))
    done = done .and. (certificate%met .or. .not. acting)
    if (done) return
    if (allocated(contact%local)) then
      call near_product_of(contact, contact%r, contact%work%trial_u)
      contact%q = contact%work%u - contact%work%trial_u
    else
      contact%q = contact%work%u - reshape(matmul(contact%w%matrix, &
          reshape(contact%r, [contact%d*contact%n])), [contact%d, contact%n])
    end if
    more = force
    force = zero
    call find_reactions(model, contact, force, certificate, status)
    more = force - more
    acting = acting .or. any(contact%r(1, :) > zero)
  end subroutine correct_contact

  !> u = H dU + offsets of all rows for the motion du (dim, nodes).
  pure subroutine find_displacements(contact, du)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: du(:, :)
    real(wp) :: u(most_components)
    integer :: a
    associate (rows => contact%rows)
      do a = 1, rows%n
        u = relative_displacement(rows, a, rows%point, du)
        rows%u(1, a) = rows%offset(a) + u(1)
        rows%u(2, a) = rows%offset_t(1, a) + u(2)
        if (rows%dim == 3) rows%u(3, a) = rows%offset_t(2, a) + u(3)
      end do
    end associate
  end subroutine find_displacements

  !> Round-off of a gap: terms that nearly cancel at a touch [L].
  pure real(wp) function gap_noise(contact, du)
    type(contact_t), intent(in) :: contact
    real(wp), intent(in), contiguous :: du(:, :)
    real(wp) :: terms
    integer :: a
    terms = zero
    associate (rows => contact%rows)
      do a = 1, rows%n
        associate (p => rows%point(rows%first(a):rows%first(a + 1) - 1))
          terms = terms + rows%offset(a)**2 + sum(du(:, p(1))**2)
          terms = terms + sum(du(:, p(min(2, size(p))))**2)
        end associate
      end do
    end associate
    if (contact%rule%level /= level_position) terms = terms + velocity_terms(contact)
    gap_noise = 8.0_wp*epsilon(terms)*sqrt(terms)
  end function gap_noise

  !> On velocities those of all bodies nearly cancel, and forces at rest with reactions, whose
  !> round-off moves contacts by eps W r [L2].
  pure real(wp) function velocity_terms(contact)
    type(contact_t), intent(in) :: contact
    real(wp) :: pressed
    associate (rows => contact%rows, rule => contact%rule)
      pressed = sum(rows%r_previous(:, :rows%n)**2)
      velocity_terms = (mean_flexibility(contact)*rule%factor)**2*pressed + &
          rows%n*(max(abs(rule%before), rule%now)*contact%largest_velocity)**2
    end associate
  end function velocity_terms

  !> After the step of motion du to displacement u (dim, nodes): u of every row, the certificate
  !> of the reactions for it (to the round-off of gaps and motions, which nearly cancel at a
  !> touch), true overlaps. Fails on what a scene must not do in silence.
  subroutine evaluate_contact(model, contact, u, du, cycle, acting, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: u(:, :), du(:, :)
    integer, intent(in) :: cycle
    logical, intent(in) :: acting
    type(status_t), intent(inout) :: status
    real(wp) :: depth
    integer :: a
    if (checks_on) call assert_shape(shape(du), shape(u), 'evaluate_contact', 'du')
    call find_displacements(contact, du)
    associate (rows => contact%rows)
      do a = 1, rows%n
        if (contact%rule%level /= level_position .and. .not. rows%is_rigid(a)) cycle
        depth = -rows%u(1, a)
        if (rows%is_rigid(a)) depth = depth + rows%offset(a) - rows%gap(a) - rows%allowance(a)
        if (depth > contact%penetration_tolerance*rows%length(a)) &
            call fail_penetration(model, rows%key(3, a), depth, rows%is_rigid(a), status)
      end do
      if (contact%listed > 0) call check_listed(model, contact, u, du, cycle, status)
    end associate
    if (acting) call certify_end(contact, du)
    if (contact%rule%level /= level_position .or. contact%rule%lead > zero) &
        call find_gaps(contact, du)
  end subroutine evaluate_contact

  !> The certificate of a stage whose unknown x (dim, nodes) is not the motion du of the step.
  subroutine certify_stage(contact, x, du, acting)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: x(:, :), du(:, :)
    logical, intent(in) :: acting
    call find_displacements(contact, x)
    if (acting) call certify_end(contact, x)
    call find_gaps(contact, du)
  end subroutine certify_stage

  !> The certificate of the reactions for the step as it is.
  subroutine certify_end(contact, du)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: du(:, :)
    type(certificate_t) :: certificate
    integer :: k
    do k = 1, contact%n
      contact%work%u(:, k) = contact%rows%u(1:contact%d, contact%row_of(k))
    end do
    call certify(mean_flexibility(contact), contact%mu, contact%q, contact%r, contact%work%u, &
        contact%cone%tolerance, certificate, gap_noise(contact, du))
    call keep_certificate(certificate, contact%tally)
  end subroutine certify_end

  !> Gaps at the end of the step and slips, where the law is one of something else.
  pure subroutine find_gaps(contact, du)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: du(:, :)
    real(wp) :: u(most_components)
    integer :: a
    associate (rows => contact%rows)
      do a = 1, rows%n
        u = relative_displacement(rows, a, rows%point, du)
        u(1) = rows%gap(a) + u(1)
        rows%u(:, a) = u(:rows%dim)
      end do
    end associate
  end subroutine find_gaps

  subroutine fail_penetration(model, node, depth, is_rigid, status)
    type(model_t), intent(in) :: model
    integer, intent(in) :: node
    real(wp), intent(in) :: depth
    logical, intent(in) :: is_rigid
    type(status_t), intent(inout) :: status
    if (is_rigid) then
      call fail(status, status_numerical, 'prescribed motions overlap: '// &
          node_name(model, node)//' is '//to_text(depth)//' deep in the other body', &
          hint='both sides of this contact are held; change their motions')
    else
      call fail(status, status_numerical, node_name(model, node)// &
          ' penetrates by '//to_text(depth)//', more than PENTOL times the edge', &
          hint='lower TOL on *BIPACT_CONTACT')
    end if
  end subroutine fail_penetration

  !> The certificate of a solve into the counts.
  pure subroutine keep_certificate(certificate, tally)
    type(certificate_t), intent(in) :: certificate
    type(tally_t), intent(inout) :: tally
    call keep_worst(certificate, tally%worst)
    call keep_worst(certificate, tally%worst_since_row)
    if (.not. certificate%met) tally%misses = tally%misses + 1
  end subroutine keep_certificate

  pure subroutine keep_worst(new, worst)
    type(certificate_t), intent(in) :: new
    type(certificate_t), intent(inout) :: worst
    worst%error = max(worst%error, new%error)
    worst%error2018 = max(worst%error2018, new%error2018)
    worst%eta = max(worst%eta, new%eta)
    worst%met = worst%met .and. new%met
  end subroutine keep_worst

end module contact_stage
