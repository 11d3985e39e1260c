! SPDX-License-Identifier: BSD-3-Clause
!> The contact problem on a dense W, the solver of a step: sweeps and, for the statuses they
!> have found, a direct solve; where that is slow, complementary pivoting and the solver on
!> blocks.
module cone_dense_solver
  use base_kinds, only: wp, zero
  use base_status, only: status_t
  use cone_active_set, only: try_active_set, try_pivoting
  use cone_active_space, only: try_active_space
  use cone_blocks, only: delassus_blocks_t, blocks_from_dense
  use cone_blocks_solver, only: solve_blocks
  use cone_certificate, only: evaluate_certificate, find_statuses, fail_uncertified
  use cone_dense, only: delassus_dense_t
  use cone_sweep, only: find_rho, sweep_contacts
  use cone_types, only: cone_options_t, cone_work_t, certificate_t, contact_open, &
      contact_slip, most_pivoted, solver_auto, solver_gs, solver_prox
  implicit none
  private
  public :: solve_dense

  !> A direct solve for the statuses is tried up to this many unknowns, and beyond it only when
  !> more sweeps than unknowns have been spent.
  integer, parameter :: small_system = 64

  !> The last resort has so many times MAXIT where the unknowns are so few that it costs little.
  integer, parameter :: few_unknowns = 300, more_sweeps = 10

  !> Sweeps after which the other methods are tried.
  integer, parameter :: patience = 200

contains

  !> Solves u = W r + q with r in the cones. W [L/F], q (d, nc) [L], mu (nc), m the mean
  !> diagonal of W; r (d, nc) on entry is the start, on exit the reactions [F]; work%u the
  !> displacements [L], work%status the statuses. Fails when neither sweeps nor direct solves
  !> meet the tolerance.
  subroutine solve_dense(options, w, q, mu, m, r, work, certificate, status)
    type(cone_options_t), intent(in) :: options
    type(delassus_dense_t), intent(in) :: w
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(in) :: m
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    type(status_t), intent(inout) :: status
    real(wp) :: change
    integer :: sweep
    if (options%solver /= solver_auto .and. options%solver /= solver_gs) then
      call solve_by_blocks(options, w, q, mu, m, r, work, certificate)
      if (certificate%met) return
    end if
    call find_rho(w, options%rho_factor, work%rho)
    call w%displacements(q, r, work%u)
    work%tried = -1
    change = huge(change)
    do sweep = 1, options%max_sweeps
      call sweep_contacts(options, w, mu, work%rho, q, r, work%u, work%status, change, &
          certificate%local_iterations)
      certificate%sweeps = sweep
      call evaluate_certificate(m, mu, q, r, work%u, options%tolerance, certificate)
      if (options%solver /= solver_gs .and. active_set_is_due(sweep, certificate%met, work)) &
          call solve_active(options, w, q, mu, m, r, work, certificate)
      if (certificate%met) return
      if (sweep == patience .and. options%solver /= solver_gs) &
          call fallback(options, w, q, mu, m, r, work, certificate)
      if (certificate%met) return
    end do
    if (options%solver == solver_auto) &
        call start_over(options, w, q, mu, m, r, work, certificate)
    if (certificate%met) return
    call fail_uncertified(m, w, mu, r, work%u, certificate, status)
  end subroutine solve_dense

  !> The last resort: from no reactions at all the rule of AUTO on blocks, then the proximal
  !> loop. Where more contacts hold a rigid part than it has freedoms,
  !> W is singular, and the start decides to which of many answers the sweeps crawl.
  subroutine start_over(options, w, q, mu, m, r, work, certificate)
    type(cone_options_t), intent(in) :: options
    type(delassus_dense_t), intent(in) :: w
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(in) :: m
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    type(cone_options_t) :: other
    integer :: k
    real(wp), dimension(size(q, 1), size(q, 2)) :: kept
    kept = r
    other = options
    if (size(q) <= few_unknowns) other%max_sweeps = more_sweeps*options%max_sweeps
    do k = 1, 2
      r = zero
      other%solver = merge(solver_auto, solver_prox, k == 1)
      call solve_by_blocks(other, w, q, mu, m, r, work, certificate)
      if (certificate%met) return
    end do
    r = kept
  end subroutine start_over

  !> The direct solve for the statuses as they are.
  subroutine solve_active(options, w, q, mu, m, r, work, certificate)
    type(cone_options_t), intent(in) :: options
    type(delassus_dense_t), intent(in) :: w
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(in) :: m
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    if (work%d == 3) then
      call try_active_space(options%tolerance, w, q, mu, m, r, work, certificate)
    else
      call try_active_set(options%tolerance, w, q, mu, m, r, work, certificate)
    end if
  end subroutine solve_active

  !> A direct solve is worth it when the statuses are new and the system is small or the sweeps
  !> slow. In space it may fail from a start that was too far off: again at the end, so that the
  !> answer is known to round-off.
  pure logical function active_set_is_due(sweep, is_met, work) result(due)
    integer, intent(in) :: sweep
    logical, intent(in) :: is_met
    type(cone_work_t), intent(in) :: work
    integer :: unknowns
    unknowns = sum(merge(0, merge(max(1, work%d - 1), work%d, work%status == contact_slip), &
        work%status == contact_open))
    due = unknowns > 0 .and. (unknowns <= small_system .or. sweep > unknowns)
    if (due) due = any(work%status /= work%tried) .or. (work%d == 3 .and. is_met)
  end function active_set_is_due

  !> Where sweeps are slow: complementary pivoting for few contacts in the plane, then the
  !> solver on blocks.
  subroutine fallback(options, w, q, mu, m, r, work, certificate)
    type(cone_options_t), intent(in) :: options
    type(delassus_dense_t), intent(in) :: w
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(in) :: m
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    if (size(q, 1) == 2 .and. size(mu) <= most_pivoted) &
        call try_pivoting(options%tolerance, w, q, mu, m, r, work, certificate)
    if (.not. certificate%met) &
        call solve_by_blocks(options, w, q, mu, m, r, work, certificate)
  end subroutine fallback

  !> The solver on blocks, from r. Kept if its certificate is met.
  subroutine solve_by_blocks(options, w, q, mu, m, r, work, certificate)
    type(cone_options_t), intent(in) :: options
    type(delassus_dense_t), intent(in) :: w
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(in) :: m
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    type(certificate_t) :: trial
    type(delassus_blocks_t) :: blocks
    type(status_t) :: answer
    real(wp), dimension(size(q, 1), size(q, 2)) :: other, u
    other = r
    call blocks_from_dense(w%matrix, size(q, 1), blocks)
    call solve_blocks(options, blocks, q, mu, m, other, u, trial, answer)
    certificate%sweeps = certificate%sweeps + trial%sweeps
    certificate%newton_steps = certificate%newton_steps + trial%newton_steps
    if (.not. trial%met) return
    trial%sweeps = certificate%sweeps
    trial%newton_steps = certificate%newton_steps
    certificate = trial
    r = other
    work%u = u
    call find_statuses(m, mu, r, u, work%status)
  end subroutine solve_by_blocks

end module cone_dense_solver
