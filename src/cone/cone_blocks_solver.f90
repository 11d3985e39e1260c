! SPDX-License-Identifier: BSD-3-Clause
!> The contact problem u = W r + q on blocks, in the plane and in space. Uncoupled groups of
!> contacts (components of the graph) are solved one by one; in each: sweeps, accelerated
!> sweeps, and Newton with a proximal loop where it is expected to be the cheaper.
module cone_blocks_solver
  use base_kinds, only: wp, zero
  use base_status, only: status_t
  use cone_active_set, only: try_pivoting
  use cone_blocks, only: delassus_blocks_t, find_components, take_component, dense_of_blocks
  use cone_certificate, only: evaluate_certificate, fail_uncertified
  use cone_dense, only: delassus_dense_t
  use cone_local, only: may_wedge
  use cone_proximal, only: proximal_newton, newton_from_nothing, friction_continuation, &
      most_loops
  use cone_scaled, only: scaled_t, scale_problem, sweep_chunk, evaluate_error, keep_best
  use cone_strategy, only: strategy_t, choose_method, after_failed_newton, newton_budget
  use cone_types, only: cone_options_t, certificate_t, cone_work_t, size_cone_work, &
      most_pivoted, solver_newton, solver_prox, late
  implicit none
  private
  public :: solve_blocks

  real(wp), parameter :: unlimited = huge(zero)

contains

  !> Reactions r (d, nc) [F] and displacements u (d, nc) [L] for W [L/F], q (d, nc) [L], mu
  !> (nc), m the mean diagonal of W; r on entry is the start. Fails when no method meets the
  !> tolerance; the certificate says how near it came.
  subroutine solve_blocks(options, w, q, mu, m, r, u, certificate, status)
    type(cone_options_t), intent(in) :: options
    type(delassus_blocks_t), intent(in) :: w
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(in) :: m
    real(wp), intent(inout), contiguous :: r(:, :), u(:, :)
    type(certificate_t), intent(inout) :: certificate
    type(status_t), intent(inout) :: status
    integer, allocatable :: first(:), member(:), place(:)
    type(delassus_blocks_t) :: part
    type(certificate_t) :: own
    integer :: k
    call find_components(w, first, member)
    allocate (place(w%contacts))
    do k = 1, size(first) - 1
      associate (list => member(first(k):first(k + 1) - 1))
        call take_component(w, list, place, part)
        call solve_component(options, part, q(:, list), mu(list), list, r, own)
        certificate%sweeps = max(certificate%sweeps, own%sweeps)
        certificate%newton_steps = certificate%newton_steps + own%newton_steps
        certificate%local_iterations = certificate%local_iterations + own%local_iterations
        certificate%products = certificate%products + own%products*size(part%block) &
            /size(w%block)
      end associate
    end do
    call w%displacements(q, r, u)
    call evaluate_certificate(m, mu, q, r, u, options%tolerance, certificate)
    if (.not. certificate%met) call fail_uncertified(m, w, mu, r, u, certificate, status)
  end subroutine solve_blocks

  !> One component; its contacts are list in r (d, all).
  subroutine solve_component(options, part, q, mu, list, r, own)
    type(cone_options_t), intent(in) :: options
    type(delassus_blocks_t), intent(in) :: part
    real(wp), intent(in) :: q(:, :), mu(:)
    integer, intent(in) :: list(:)
    real(wp), intent(inout) :: r(:, :)
    type(certificate_t), intent(out) :: own
    type(scaled_t) :: p
    real(wp) :: m, largest
    if (all(q(1, :) >= zero)) then
      r(:, list) = zero
      return
    end if
    m = part%mean_diagonal()
    largest = maxval(abs(q))
    call scale_problem(part, q, mu, r(:, list), m, largest, options%rho_factor, p)
    call iterate(options, p, own)
    r(:, list) = p%r*(largest/m)
  end subroutine solve_component

  !> Chunks of sweeps until the certificate is met; Newton when it is due. When the sweeps are
  !> spent, the proximal loop has the last word; r is the best there was.
  subroutine iterate(options, p, certificate)
    type(cone_options_t), intent(in) :: options
    type(scaled_t), intent(inout) :: p
    type(certificate_t), intent(inout) :: certificate
    type(strategy_t) :: strategy
    if (options%solver == solver_prox .or. options%solver == solver_newton) then
      call evaluate_error(p, options%tolerance, certificate)
      call proximal_newton(options, p, options%solver == solver_newton, most_loops, &
          unlimited, certificate)
      if (certificate%met) return
    end if
    do while (certificate%sweeps < options%max_sweeps)
      if (late(options)) exit
      call sweep_chunk(options, p, certificate)
      call evaluate_error(p, options%tolerance, certificate)
      if (certificate%met) return
      call choose_method(options, certificate, p, strategy)
      if (strategy%newton_due) call try_newton(options, p, strategy, certificate)
      if (certificate%met) return
    end do
    if (.not. allocated(p%best)) return
    p%r = p%best
    call evaluate_error(p, options%tolerance, certificate)
    if (strategy%newtons > 0) &
        call proximal_newton(options, p, .false., most_loops, unlimited, certificate)
    if (certificate%met) return
    if (strategy%newtons > 0 .and. size(p%q, 1) == 2 .and. size(p%mu) <= most_pivoted) &
        call pivot_component(options%tolerance, p, certificate)
  end subroutine iterate

  !> From the best point: Newton and the proximal loop, within their budget; at the first time
  !> what there is for contacts that wedge. Where all fail the method before goes on.
  subroutine try_newton(options, p, strategy, certificate)
    type(cone_options_t), intent(in) :: options
    type(scaled_t), intent(inout) :: p
    type(strategy_t), intent(inout) :: strategy
    type(certificate_t), intent(inout) :: certificate
    real(wp), dimension(size(p%r, 1), size(p%r, 2)) :: kept
    real(wp) :: began, before
    kept = p%r
    began = certificate%products
    before = p%best_misfit
    if (.not. p%stands_still) p%r = p%best
    call evaluate_error(p, options%tolerance, certificate)
    call proximal_newton(options, p, .true., 0, newton_budget(p, began, strategy), certificate)
    strategy%singular = p%newton%too_long
    if (.not. certificate%met .and. strategy%anew .and. .not. strategy%singular) then
      call newton_from_nothing(options, p, newton_budget(p, began, strategy), certificate)
      strategy%begun_anew = .true.
    end if
    if (.not. certificate%met .and. strategy%proximal_due) call proximal_newton(options, p, &
        .false., most_loops, newton_budget(p, began, strategy), certificate)
    if (certificate%met) return
    call keep_best(p, certificate)
    if (strategy%newtons == 0 .and. some_wedge(p)) then
      if (size(p%q, 1) == 2 .and. size(p%mu) <= most_pivoted) &
          call pivot_component(options%tolerance, p, certificate)
      if (.not. certificate%met) call friction_continuation(options, p, certificate)
      if (certificate%met) return
    end if
    p%r = kept
    call after_failed_newton(began, before, certificate%products, p, strategy)
  end subroutine try_newton

  !> Does some W_aa alone allow several answers?
  pure logical function some_wedge(p)
    type(scaled_t), intent(in) :: p
    integer :: a
    some_wedge = .false.
    do a = 1, size(p%mu)
      some_wedge = some_wedge .or. &
          may_wedge(p%w%block(:, :, p%w%diagonal(a)), p%mu(a))
    end do
  end function some_wedge

  !> In the plane, where contacts wedge: complementary pivoting.
  subroutine pivot_component(tolerance, p, certificate)
    real(wp), intent(in) :: tolerance
    type(scaled_t), intent(inout) :: p
    type(certificate_t), intent(inout) :: certificate
    type(cone_work_t) :: work
    type(delassus_dense_t) :: dense
    call dense%resize(2, size(p%mu))
    call dense_of_blocks(p%w, dense%matrix)
    call size_cone_work(work, 2, size(p%mu))
    work%status = p%status
    call try_pivoting(tolerance, dense, p%q, p%mu, dense%mean_diagonal(), p%r, work, &
        certificate)
  end subroutine pivot_component

end module cone_blocks_solver
