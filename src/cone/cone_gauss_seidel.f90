! SPDX-License-Identifier: BSD-3-Clause
!> Gauss-Seidel over the contacts with the bi-potential local solver, and the direct solve for
!> the statuses it has found.
module cone_gauss_seidel
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t
  use cone_certificate, only: certify, fail_uncertified, mean_diagonal
  use cone_blocks, only: flexibility_t, blocks_from_dense
  use cone_local, only: project_on_cone, predictor
  use cone_pivoting, only: pivot_statuses
  use cone_polish, only: polish_statuses
  use cone_solver, only: solve_contacts
  use cone_types, only: cone_options_t, cone_work_t, certificate_t, size_cone_work, &
      contact_open, contact_slip, most_components
  use cone_visit, only: visit_contact
  use linalg_dense, only: largest_eigenvalue_2
  implicit none
  private
  public :: solve_cone

  !> A direct solve for the statuses is tried up to this many unknowns, and beyond it only when
  !> more sweeps than unknowns have been spent.
  integer, parameter :: small_system = 64

  !> Sweeps after which complementary pivoting is tried, and up to how many contacts.
  integer, parameter :: patience = 200, most_pivoted = 40

contains

  !> Solves u = W r + q with r in the cones. W (d nc, d nc) [L/F], q (d, nc) [L], mu (nc); r on
  !> entry is the start, on exit the reactions [F]; work%u the motions [L], work%status the
  !> statuses. Fails when neither sweeps nor direct solves meet the tolerance.
  subroutine solve_cone(options, w, q, mu, r, work, certificate, status)
    type(cone_options_t), intent(in) :: options
    real(wp), intent(in) :: w(:, :)
    real(wp), intent(in) :: q(:, :)
    real(wp), intent(in) :: mu(:)
    real(wp), intent(inout) :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(out) :: certificate
    type(status_t), intent(inout) :: status
    real(wp) :: m, change
    integer :: sweep
    call size_cone_work(work, size(q, 1), size(q, 2))
    if (.not. options%warm_start) r = zero
    work%status = contact_open
    if (all(q(1, :) >= zero)) then
      r = zero
      work%u = q
      return
    end if
    m = mean_diagonal(w)
    if (options%solver == 'PROX' .or. options%solver == 'NEWTON') then
      call hand_over(options, w, q, mu, m, r, work, certificate)
      if (certificate%met) return
    end if
    call start_sweeps(options, w, q, r, work)
    change = huge(change)
    do sweep = 1, options%max_sweeps
      call one_sweep(options, w, mu, r, work, change, certificate%local_iterations)
      certificate%sweeps = sweep
      call certify(m, mu, q, r, work%u, options%tolerance, certificate)
      if (options%solver /= 'GS' .and. polish_due(sweep, work)) &
          call try_polish(options, w, q, mu, m, r, work, certificate)
      if (certificate%met) return
      if (sweep == patience .and. options%solver /= 'GS') &
          call rescue(options, w, q, mu, m, r, work, certificate)
      if (certificate%met) return
    end do
    call fail_uncertified(m, diagonal_blocks(w, size(q, 1)), mu, r, work%u, certificate, status)
  end subroutine solve_cone

  pure function diagonal_blocks(w, d) result(diagonal)
    real(wp), intent(in) :: w(:, :)
    integer, intent(in) :: d
    real(wp) :: diagonal(d, d, size(w, 1)/d)
    integer :: a
    do a = 1, size(diagonal, 3)
      diagonal(:, :, a) = w(d*a - d + 1:d*a, d*a - d + 1:d*a)
    end do
  end function diagonal_blocks

  !> rho = factor / lmax(W_aa) per contact, and u for the starting reactions.
  pure subroutine start_sweeps(options, w, q, r, work)
    type(cone_options_t), intent(in) :: options
    real(wp), intent(in) :: w(:, :)
    real(wp), intent(in) :: q(:, :)
    real(wp), intent(in) :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    integer :: a, i, d, row
    d = size(q, 1)
    work%u = q
    work%tried = -1
    do a = 1, size(q, 2)
      row = d*(a - 1)
      if (d == 1) then
        work%rho(a) = options%rho_factor/w(a, a)
      else
        work%rho(a) = &
            options%rho_factor/largest_eigenvalue_2(w(row + 1:row + 2, row + 1:row + 2))
      end if
      do i = 1, d
        if (abs(r(i, a)) > zero) call add_column(w(:, row + i), r(i, a), work%u)
      end do
    end do
  end subroutine start_sweeps

  pure subroutine add_column(column, factor, u)
    real(wp), intent(in) :: column(:)
    real(wp), intent(in) :: factor
    real(wp), intent(inout) :: u(*)
    integer :: i
    do i = 1, size(column)
      u(i) = u(i) + factor*column(i)
    end do
  end subroutine add_column

  !> Visits every contact once. The local solve is loose: it stops at a share of what a contact
  !> changed in the sweep before (exact local solves were found less safe).
  subroutine one_sweep(options, w, mu, r, work, change, local_iterations)
    type(cone_options_t), intent(in) :: options
    real(wp), intent(in) :: w(:, :)
    real(wp), intent(in) :: mu(:)
    real(wp), intent(inout) :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    real(wp), intent(inout) :: change
    integer, intent(inout) :: local_iterations
    real(wp), dimension(most_components) :: u, old
    real(wp) :: enough, sum_change
    integer :: a, i, d, row, iterations
    d = size(r, 1)
    enough = zero
    if (change < huge(change)) enough = options%local_tolerance*change/size(mu)
    sum_change = zero
    do a = 1, size(mu)
      row = d*(a - 1)
      old(:d) = r(:, a)
      u(:d) = work%u(:, a)
      call visit_contact(options, w(row + 1:row + d, row + 1:row + d), mu(a), work%rho(a), &
          enough, merge(1, options%max_local, change >= huge(change)), r(:, a), u(:d), &
          work%status(a), iterations)
      local_iterations = local_iterations + iterations
      do i = 1, d
        if (abs(r(i, a) - old(i)) > zero) &
            call add_column(w(:, row + i), r(i, a) - old(i), work%u)
      end do
      sum_change = sum_change + sqrt(sum((r(:, a) - old(:d))**2))
    end do
    change = sum_change
  end subroutine one_sweep

  !> A direct solve is worth it when the statuses are new and the system is small or the sweeps
  !> slow.
  pure logical function polish_due(sweep, work)
    integer, intent(in) :: sweep
    type(cone_work_t), intent(in) :: work
    integer :: unknowns
    unknowns = sum(merge(0, merge(1, work%d, work%status == contact_slip), &
        work%status == contact_open))
    polish_due = unknowns > 0 .and. work%d < 3 &
        .and. (unknowns <= small_system .or. sweep > unknowns)
    if (polish_due) polish_due = any(work%status /= work%tried)
  end function polish_due

  !> Keeps the direct solution when its certificate is met; otherwise the sweeps go on
  !> undisturbed.
  subroutine try_polish(options, w, q, mu, m, r, work, certificate)
    type(cone_options_t), intent(in) :: options
    real(wp), intent(in) :: w(:, :)
    real(wp), intent(in) :: q(:, :)
    real(wp), intent(in) :: mu(:)
    real(wp), intent(in) :: m
    real(wp), intent(inout) :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    type(certificate_t) :: trial
    integer :: a, i, d
    logical :: ok
    call polish_statuses(w, q, mu, r, work, ok)
    work%tried = work%status
    certificate%polishes = certificate%polishes + 1
    if (.not. ok) return
    d = size(q, 1)
    work%trial_u = q
    do a = 1, size(mu)
      if (.not. in_cone(mu(a), work%trial(:, a))) return
      do i = 1, d
        if (abs(work%trial(i, a)) > zero) &
            call add_column(w(:, d*(a - 1) + i), work%trial(i, a), work%trial_u)
      end do
    end do
    trial = certificate
    call certify(m, mu, q, work%trial, work%trial_u, options%tolerance, trial)
    if (.not. trial%met .or. trial%error > certificate%error) return
    certificate = trial
    r = work%trial
    work%u = work%trial_u
  end subroutine try_polish

  !> Where sweeps are slow: complementary pivoting for few contacts in the plane, then the
  !> solver on blocks.
  subroutine rescue(options, w, q, mu, m, r, work, certificate)
    type(cone_options_t), intent(in) :: options
    real(wp), intent(in) :: w(:, :)
    real(wp), intent(in) :: q(:, :)
    real(wp), intent(in) :: mu(:)
    real(wp), intent(in) :: m
    real(wp), intent(inout) :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    if (size(q, 1) == 2 .and. size(mu) <= most_pivoted) &
        call try_pivoting(options, w, q, mu, m, r, work, certificate)
    if (.not. certificate%met) &
        call hand_over(options, w, q, mu, m, r, work, certificate)
  end subroutine rescue

  !> The statuses of a complementary path, solved directly; kept if the certificate is met.
  subroutine try_pivoting(options, w, q, mu, m, r, work, certificate)
    type(cone_options_t), intent(in) :: options
    real(wp), intent(in) :: w(:, :)
    real(wp), intent(in) :: q(:, :)
    real(wp), intent(in) :: mu(:)
    real(wp), intent(in) :: m
    real(wp), intent(inout) :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    real(wp) :: start(2, size(mu))
    integer :: kept(size(mu))
    logical :: ok
    kept = work%status
    start(1, :) = one
    call pivot_statuses(w, q, mu, work%status, start(2, :), ok)
    certificate%pivotings = certificate%pivotings + 1
    if (ok) call try_polish(options, w, q, mu, m, start, work, certificate)
    if (certificate%met) then
      r = start
    else
      work%status = kept
    end if
  end subroutine try_pivoting

  !> The solver on blocks, from r: groups, accelerated sweeps, Newton with a proximal loop. Kept
  !> if its certificate is met.
  subroutine hand_over(options, w, q, mu, m, r, work, certificate)
    type(cone_options_t), intent(in) :: options
    real(wp), intent(in) :: w(:, :)
    real(wp), intent(in) :: q(:, :)
    real(wp), intent(in) :: mu(:)
    real(wp), intent(in) :: m
    real(wp), intent(inout) :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    type(cone_options_t) :: from_here
    type(certificate_t) :: trial
    type(flexibility_t) :: blocks
    type(status_t) :: answer
    real(wp), dimension(size(q, 1), size(q, 2)) :: other, u
    real(wp), dimension(most_components) :: tau, projected
    integer :: a, d
    d = size(q, 1)
    from_here = options
    from_here%warm_start = .true.
    other = r
    call blocks_from_dense(w, size(q, 1), blocks)
    call solve_contacts(from_here, blocks, q, mu, other, u, trial, answer)
    certificate%sweeps = certificate%sweeps + trial%sweeps
    certificate%newton_steps = certificate%newton_steps + trial%newton_steps
    if (.not. trial%met) return
    trial%sweeps = certificate%sweeps
    trial%newton_steps = certificate%newton_steps
    certificate = trial
    r = other
    work%u = u
    do a = 1, size(mu)
      call predictor(mu(a), one/m, r(:, a), u(:, a), tau(:d))
      call project_on_cone(mu(a), tau(:d), projected(:d), work%status(a))
    end do
  end subroutine hand_over

  !> r in K, to round-off on the slip side.
  pure logical function in_cone(mu, r)
    real(wp), intent(in) :: mu
    real(wp), intent(in) :: r(:)
    real(wp), parameter :: slack = 1.0_wp + 8.0_wp*epsilon(1.0_wp)
    in_cone = r(1) >= zero
    if (size(r) > 1) in_cone = in_cone .and. abs(r(2)) <= slack*mu*r(1)
  end function in_cone

end module cone_gauss_seidel
