! SPDX-License-Identifier: BSD-3-Clause
!> Contact of one stage of a step, for every scheme: from the free motion of the block to the
!> reactions. It does not know the scheme: the stage has said what the motion means.
module contact_stage
  use base_kinds, only: wp, zero, half
  use base_status, only: status_t, fail, failed, add_place, status_numerical
  use base_strings, only: to_text
  use cone_certificate, only: certify, mean_diagonal
  use cone_gauss_seidel, only: solve_cone
  use cone_local, only: may_wedge
  use cone_types, only: certificate_t, contact_open, size_cone_work
  use contact_condense, only: relative_motion, spread_force
  use contact_types, only: contact_t
  use model_data, only: model_t
  implicit none
  private
  public :: solve_contact, correct_contact, settle_contact

contains

  !> Reactions for the free motion x_free (2, m) of the block; force (2, m) = H' r. acting is
  !> false when nothing touches, and then force is zero.
  subroutine solve_contact(model, contact, x_free, force, acting, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in) :: x_free(:, :)
    real(wp), intent(out) :: force(:, :)
    logical, intent(out) :: acting
    type(status_t), intent(inout) :: status
    type(certificate_t) :: certificate
    real(wp) :: motion(2)
    integer :: k
    do k = 1, contact%rows
      associate (c => contact%candidate(contact%row_of(k)))
        motion = relative_motion(c, x_free(:, contact%block_row(c%node)), &
            x_free(:, contact%block_row(c%a)), x_free(:, contact%block_row(c%b)))
        contact%q(1, k) = c%gap + motion(1)
        if (contact%d > 1) contact%q(2, k) = motion(2)
      end associate
    end do
    force = zero
    acting = .false.
    call shift_reactions(contact)
    if (contact%rows == 0) return
    if (all(contact%q(1, :) >= zero)) return
    acting = .true.
    call start_reactions(contact)
    call find_reactions(model, contact, force, certificate, status)
    call watch_alternation(contact)
    contact%solves = contact%solves + 1
    contact%solves_since_row = contact%solves_since_row + 1
  end subroutine solve_contact

  !> Makes room for new reactions. After three solves without any there is nothing to shift.
  pure subroutine shift_reactions(contact)
    type(contact_t), intent(inout) :: contact
    integer :: k
    if (contact%quiet == 3) return
    contact%quiet = contact%quiet + 1
    do k = 1, contact%n
      associate (c => contact%candidate(k))
        c%older = c%last
        c%last = c%r
        c%r = zero
        c%status = contact_open
      end associate
    end do
  end subroutine shift_reactions

  !> The start: the last reactions, or those before them where forces alternate.
  pure subroutine start_reactions(contact)
    type(contact_t), intent(inout) :: contact
    integer :: k
    do k = 1, contact%rows
      associate (c => contact%candidate(contact%row_of(k)))
        contact%r(:, k) = c%last(1:contact%d)
        if (contact%alternates) contact%r(:, k) = c%older(1:contact%d)
      end associate
    end do
  end subroutine start_reactions

  !> Which of the two would have been the nearer start?
  pure subroutine watch_alternation(contact)
    type(contact_t), intent(inout) :: contact
    real(wp) :: from_last, from_older
    integer :: k
    from_last = zero
    from_older = zero
    do k = 1, contact%rows
      associate (c => contact%candidate(contact%row_of(k)))
        from_last = from_last + sum((c%r - c%last)**2)
        from_older = from_older + sum((c%r - c%older)**2)
      end associate
    end do
    contact%alternates = from_older < from_last
  end subroutine watch_alternation

  !> Reactions of the rows for q and the start in r, put into candidates and forces.
  subroutine find_reactions(model, contact, force, certificate, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(inout) :: force(:, :)
    type(certificate_t), intent(out) :: certificate
    type(status_t), intent(inout) :: status
    integer :: k
    contact%quiet = 0
    call solve_cone(contact%cone, contact%w, contact%q, contact%mu, contact%r, contact%work, &
        certificate, status)
    if (certificate%worst > 0) call add_place(status, 'node '// &
        to_text(model%node_id(contact%candidate(contact%row_of(certificate%worst))%node)))
    call keep_worst(certificate, contact%worst)
    call keep_worst(certificate, contact%worst_since_row)
    contact%sweeps = contact%sweeps + certificate%sweeps
    contact%sweeps_since_row = contact%sweeps_since_row + certificate%sweeps
    do k = 1, contact%rows
      associate (c => contact%candidate(contact%row_of(k)))
        c%r(1:contact%d) = contact%r(:, k)
        c%status = contact%work%status(k)
        if (.not. contact%r(1, k) > zero) c%status = contact_open
        call spread_force(contact, c, c%r, force)
      end associate
    end do
    if (contact%d > 1) call count_wedging(contact)
  end subroutine find_reactions

  !> Contacts that push and for which W_aa alone allows several answers (mu |W_nt| > W_nn).
  pure subroutine count_wedging(contact)
    type(contact_t), intent(inout) :: contact
    integer :: k
    do k = 1, contact%rows
      if (.not. contact%r(1, k) > zero) cycle
      if (.not. may_wedge(contact%w(2*k - 1:2*k, 2*k - 1:2*k), contact%mu(k))) cycle
      if (contact%wedged == 0) contact%wedged_node = contact%candidate(contact%row_of(k))%node
      contact%wedged = contact%wedged + 1
    end do
  end subroutine count_wedging

  !> Corrects the reactions where W is known to fewer digits than the motion du (2, nodes),
  !> refined with them: q = u(du) - W r, solved again from r. On exit force is that of the new
  !> reactions, more the change of it; both (2, m) [F]. done: they meet the certificate as they
  !> are.
  subroutine correct_contact(model, contact, du, force, more, done, acting, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in) :: du(:, :)
    real(wp), intent(inout) :: force(:, :)
    real(wp), intent(out) :: more(:, :)
    logical, intent(out) :: done
    logical, intent(inout) :: acting
    type(status_t), intent(inout) :: status
    type(certificate_t) :: certificate
    real(wp) :: motion(2), noise
    integer :: k
    done = .true.
    ! Rows of an earlier list, where nothing is listed now.
    if (contact%rows == 0 .or. .not. contact%w_is_current) return
    call size_cone_work(contact%work, contact%d, contact%rows)
    do k = 1, contact%rows
      associate (c => contact%candidate(contact%row_of(k)))
        motion = relative_motion(c, du(:, c%node), du(:, c%a), du(:, c%b))
        contact%work%u(1, k) = c%gap + motion(1)
        if (contact%d > 1) contact%work%u(2, k) = motion(2)
        contact%r(:, k) = c%r(1:contact%d)
        if (-contact%work%u(1, k) > half*contact%penetration_tolerance*c%length) done = .false.
      end associate
    end do
    noise = gap_noise(contact, du)
    call certify(mean_diagonal(contact%w), contact%mu, contact%q, contact%r, contact%work%u, &
        contact%cone%tolerance, certificate, noise)
    done = done .and. (certificate%met .or. .not. acting)
    if (done) return
    contact%q = contact%work%u - reshape(matmul(contact%w, &
        reshape(contact%r, [contact%d*contact%rows])), [contact%d, contact%rows])
    more = force
    force = zero
    call find_reactions(model, contact, force, certificate, status)
    more = force - more
    acting = acting .or. any(contact%r(1, :) > zero)
  end subroutine correct_contact

  !> Round-off of a gap: terms that nearly cancel at a touch [L].
  pure real(wp) function gap_noise(contact, du)
    type(contact_t), intent(in) :: contact
    real(wp), intent(in) :: du(:, :)
    real(wp) :: terms
    integer :: i
    terms = zero
    do i = 1, contact%n
      associate (c => contact%candidate(i))
        if (c%valid) terms = terms + c%gap**2 + sum(du(:, c%node)**2) + sum(du(:, c%a)**2)
      end associate
    end do
    gap_noise = 8.0_wp*epsilon(terms)*sqrt(terms)
  end function gap_noise

  !> After the step: true gap and slip of every candidate from the motion x (2, m) of the block,
  !> the certificate of the reactions for that motion (to the round-off of gaps and motions,
  !> which nearly cancel at a touch), penetration. Fails on what a scene must
  !> not do in silence: penetration beyond the tolerance, prescribed motions that overlap.
  subroutine settle_contact(model, contact, du, acting, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in) :: du(:, :)
    logical, intent(in) :: acting
    type(status_t), intent(inout) :: status
    type(certificate_t) :: certificate
    real(wp) :: motion(2), depth
    integer :: i, k
    do i = 1, contact%n
      associate (c => contact%candidate(i))
        motion = relative_motion(c, du(:, c%node), du(:, c%a), du(:, c%b))
        c%u = [c%gap + motion(1), motion(2)]
        depth = max(zero, -c%u(1))
        if (.not. c%valid) cycle
        contact%pair(c%pair)%penetration = max(contact%pair(c%pair)%penetration, depth)
        contact%worst_penetration = max(contact%worst_penetration, depth/c%length)
        if (depth > contact%penetration_tolerance*c%length .and. c%held) &
            call fail(status, status_numerical, 'prescribed motions overlap: node '// &
            to_text(model%node_id(c%node))//' is '//to_text(depth)//' deep in the other body', &
            hint='both sides of this contact are held; change their motions')
        if (depth > contact%penetration_tolerance*c%length) &
            call fail(status, status_numerical, 'node '//to_text(model%node_id(c%node))// &
            ' penetrates by '//to_text(depth)//', more than PENTOL times the edge', &
            hint='lower TOL on *BIPACT_CONTACT')
      end associate
    end do
    if (.not. acting) return
    do k = 1, contact%rows
      contact%work%u(:, k) = contact%candidate(contact%row_of(k))%u(1:contact%d)
    end do
    call certify(mean_diagonal(contact%w), contact%mu, contact%q, contact%r, contact%work%u, &
        contact%cone%tolerance, certificate, gap_noise(contact, du))
    call keep_worst(certificate, contact%worst)
    call keep_worst(certificate, contact%worst_since_row)
  end subroutine settle_contact

  pure subroutine keep_worst(new, worst)
    type(certificate_t), intent(in) :: new
    type(certificate_t), intent(inout) :: worst
    worst%error = max(worst%error, new%error)
    worst%error2018 = max(worst%error2018, new%error2018)
    worst%eta = max(worst%eta, new%eta)
    worst%met = worst%met .and. new%met
  end subroutine keep_worst

end module contact_stage
