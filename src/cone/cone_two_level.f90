! SPDX-License-Identifier: BSD-3-Clause
!> The contact problem on two levels: entries of a near part N of W, and products with all of W.
!> Sweeps solve u = N r + (q + far); a product with W gives the true displacements and what was
!> left out, far = (W - N) r; again, until the true displacements meet the certificate (a
!> splitting of W, Varga 1962). What N leaves out costs passes, never accuracy.
module cone_two_level
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, fail, failed, status_numerical
  use cone_blocks, only: delassus_blocks_t
  use cone_blocks_solver, only: solve_blocks
  use cone_certificate, only: evaluate_certificate, add_error2018, is_ordinary, &
      count_wedging, find_statuses, fail_uncertified
  use cone_delassus, only: operator_t
  use cone_products, only: delassus_products_t, make_products
  use cone_products_solver, only: solve_by_products
  use cone_sweep, only: find_rho, sweep_contacts
  use cone_types, only: cone_options_t, cone_work_t, certificate_t, size_cone_work, &
      contact_open, large_friction
  implicit none
  private
  public :: solve_two_level, solve_with_products

  !> Products after which the others are taken up, sweeps after which other methods are.
  integer, parameter :: most_passes = 40, patience = 200
  !> Share of the reactions that sweeps of a first pass may leave.
  real(wp), parameter :: first_share = 1.0e-6_wp
  !> The same of later passes, of the tolerance: forces are then as near to those of a direct
  !> solve as they can be.
  real(wp), parameter :: last_share = 0.01_wp
  !> Passes end at that share of the tolerance, but not below what round-off lets them reach.
  real(wp), parameter :: strict_share = 0.1_wp, least_tolerance = 1.0e-13_wp
  !> Sweeps that converge more slowly than by this rate are taken to do so by it.
  real(wp), parameter :: slowest = 0.99_wp

contains

  !> Solves u = W r + q with r in the cones: near [L/F] the near part of W, product all of it,
  !> q (d, nc) [L], mu (nc). far (d, nc) = (W - near) r [L], on entry a guess. r (d, nc) on
  !> entry is the start, on exit the reactions [F]; work%u the displacements [L]. passes: of
  !> products.
  !> Fails where neither passes nor products alone meet the tolerance.
  subroutine solve_two_level(options, near, product, q, mu, far, r, work, passes, certificate, &
      status)
    type(cone_options_t), intent(in) :: options
    type(delassus_blocks_t), intent(in) :: near
    class(operator_t), target, intent(in) :: product
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(inout), contiguous :: far(:, :), r(:, :)
    type(cone_work_t), intent(inout) :: work
    integer, intent(out) :: passes
    type(certificate_t), intent(out) :: certificate
    type(status_t), intent(inout) :: status
    real(wp) :: m, share, strict
    logical :: is_done
    integer :: sweeps
    call begin_solve(options, near, q, mu, r, work, m, is_done, status)
    passes = 0
    if (is_done) return
    call find_rho(near, options%rho_factor, work%rho)
    share = first_share
    strict = max(strict_share*options%tolerance, min(options%tolerance, least_tolerance))
    sweeps = 0
    do passes = 1, most_passes
      work%trial = q + far
      call sweep_near(options, near, mu, m, share, r, work, certificate)
      sweeps = sweeps + certificate%sweeps
      call product%apply(r, work%trial_u)
      work%u = q + work%trial_u
      call evaluate_certificate(m, mu, q, r, work%u, strict, certificate)
      far = zero
      call near%add_product(r, far)
      far = work%trial_u - far
      if (certificate%met) exit
      share = last_share*options%tolerance
    end do
    passes = min(passes, most_passes)
    call evaluate_certificate(m, mu, q, r, work%u, options%tolerance, certificate)
    certificate%sweeps = sweeps
    if (.not. certificate%met) call solve_with_products(options, near, product, q, mu, r, &
        work, certificate, status)
    call add_error2018(one, mu, r, work%u, certificate)
    call find_statuses(m, mu, r, work%u, work%status)
    call count_wedging(near, mu, r, certificate)
  end subroutine solve_two_level

  !> The same by products alone; near gives the blocks W_aa.
  subroutine solve_with_products(options, near, product, q, mu, r, work, certificate, status)
    type(cone_options_t), intent(in) :: options
    type(delassus_blocks_t), intent(in) :: near
    class(operator_t), target, intent(in) :: product
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    type(status_t), intent(inout) :: status
    type(delassus_products_t) :: w
    type(certificate_t) :: own
    real(wp) :: m
    integer :: sweeps
    logical :: is_done
    sweeps = certificate%sweeps
    call begin_solve(options, near, q, mu, r, work, m, is_done, status)
    if (is_done) return
    call make_products(product, near%block(:, :, near%diagonal), w)
    call solve_by_products(options, w, q, mu, m, r, work%u, own, status)
    certificate = own
    certificate%sweeps = sweeps + own%sweeps
    call find_statuses(m, mu, r, work%u, work%status)
  end subroutine solve_with_products

  !> m = mean diagonal; done where nothing pushes, or where numbers are out of range.
  subroutine begin_solve(options, near, q, mu, r, work, m, is_done, status)
    type(cone_options_t), intent(in) :: options
    type(delassus_blocks_t), intent(in) :: near
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    real(wp), intent(out) :: m
    logical, intent(out) :: is_done
    type(status_t), intent(inout) :: status
    call size_cone_work(work, size(q, 1), size(q, 2))
    if (.not. options%warm_start) r = zero
    work%status = contact_open
    m = near%mean_diagonal()
    is_done = all(q(1, :) >= zero)
    if (is_done) then
      r = zero
      work%u = q
      return
    end if
    is_done = .not. (is_ordinary(m, mu, q, r, q) .and. maxval(mu) <= large_friction)
    if (is_done) call fail(status, status_numerical, 'a contact solve without all of W has '// &
        'numbers beyond 2^200 or friction beyond 1e7', hint='choose WSTORE DENSE on '// &
        '*BIPACT_CONTACT')
  end subroutine begin_solve

  !> Sweeps on the near part for work%trial = q + far, until those to come would change r by no
  !> more than that share of it, at the rate of the last two; where they are slow the solver
  !> on blocks.
  subroutine sweep_near(options, near, mu, m, share, r, work, certificate)
    type(cone_options_t), intent(in) :: options
    type(delassus_blocks_t), intent(in) :: near
    real(wp), intent(in), contiguous :: mu(:)
    real(wp), intent(in) :: m, share
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    type(certificate_t) :: own
    type(status_t) :: answer
    real(wp) :: change, before, rate
    integer :: sweep
    change = huge(change)
    do sweep = 1, min(patience, options%max_sweeps)
      before = change
      call sweep_contacts(options, near, mu, work%rho, work%trial, r, work%u, work%status, &
          change, certificate%local_iterations)
      certificate%sweeps = sweep
      if (sweep == 1 .and. change > zero) cycle
      rate = min(change/max(before, tiny(before)), slowest)
      if (change*rate <= (one - rate)*share*sum_of(size(r), r)) return
    end do
    work%trial_u = r
    call solve_blocks(options, near, work%trial, mu, m, work%trial_u, work%u, own, answer)
    certificate%sweeps = certificate%sweeps + own%sweeps
    certificate%newton_steps = certificate%newton_steps + own%newton_steps
    if (own%met) r = work%trial_u
  end subroutine sweep_near

  pure real(wp) function sum_of(n, r)
    integer, intent(in) :: n
    real(wp), intent(in) :: r(n)
    sum_of = sum(abs(r))
  end function sum_of

end module cone_two_level
