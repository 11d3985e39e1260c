! SPDX-License-Identifier: BSD-3-Clause
!> The contact solver: one entry for every kind of W. Every answer is certified.
module cone_solver
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use base_checks, only: checks_on, assert, assert_shape
  use base_kinds, only: wp, zero
  use base_status, only: status_t, fail, failed, status_numerical
  use cone_blocks, only: delassus_blocks_t
  use cone_blocks_solver, only: solve_blocks
  use cone_certificate, only: certify, add_error2018, is_ordinary, count_wedging, &
      find_statuses, fail_uncertified
  use cone_delassus, only: delassus_t
  use cone_dense, only: delassus_dense_t
  use cone_dense_solver, only: solve_dense
  use cone_local, only: tangent_length
  use cone_products_solver, only: solve_by_products
  use cone_types, only: cone_options_t, cone_work_t, certificate_t, size_cone_work, &
      contact_open, contact_stick, contact_slip, local_exact, largest_ordinary, &
      large_friction, most_components, solver_products
  implicit none
  private
  public :: solve_cone

  !> Share of mu r_n from which on r_t counts as slip, where mu is large.
  real(wp), parameter :: nearly = 1.0_wp - 1.0e-8_wp
  real(wp), parameter :: nothing = 1.0e-300_wp

contains

  !> Solves u = W r + q with r in the cones. W [L/F], q (d, nc) [L], mu (nc); r (d, nc) on entry
  !> is the start where options%warm_start, on exit the reactions [F]; work%u (d, nc) the
  !> displacements [L], work%status (nc) the statuses. Where only products with W are known
  !> options%solver has no choice. Fails when no method meets the tolerance; the certificate
  !> says how near it came. Allocates nothing for a dense W once work has its size, as long as
  !> sweeps and direct solves do.
  subroutine solve_cone(options, delassus, q, mu, r, work, certificate, status)
    type(cone_options_t), intent(in) :: options
    class(delassus_t), intent(in) :: delassus
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(out) :: certificate
    type(status_t), intent(inout) :: status
    real(wp) :: m
    if (checks_on) call check_problem(options, delassus, q, mu, r)
    call size_cone_work(work, size(q, 1), size(q, 2))
    if (.not. options%warm_start) r = zero
    work%status = contact_open
    if (all(q(1, :) >= zero)) then
      r = zero
      work%u = q
      return
    end if
    m = delassus%mean_diagonal()
    if (is_ordinary(m, mu, q, r, q) .and. maxval(mu) <= large_friction) then
      call solve_kind(options, delassus, q, mu, m, r, work, certificate, status)
      call add_error2018(1.0_wp, mu, r, work%u, certificate)
    else
      call solve_rescaled(options, delassus, q, mu, m, r, work, certificate, status)
    end if
    call count_wedging(delassus, mu, r, certificate)
  end subroutine solve_cone

  !> Assertions on what the solver is given: shapes, friction that is a number, options that
  !> can end. q and W may hold anything: that is a failure with a status.
  subroutine check_problem(options, delassus, q, mu, r)
    type(cone_options_t), intent(in) :: options
    class(delassus_t), intent(in) :: delassus
    real(wp), intent(in) :: q(:, :), mu(:), r(:, :)
    character(*), parameter :: place = 'solve_cone'
    call assert(size(q, 1) >= 1 .and. size(q, 1) <= most_components, place, &
        'a contact has 1 to 3 components')
    call assert_shape([delassus%d, delassus%contacts], shape(q), place, 'W in contacts')
    call assert_shape(shape(r), shape(q), place, 'r')
    call assert_shape(shape(mu), [size(q, 2)], place, 'mu')
    call assert(all(ieee_is_finite(mu)) .and. all(mu >= zero), place, &
        'every mu is finite and not negative')
    call assert(options%tolerance > zero .and. options%max_sweeps > 0, place, &
        'the tolerance and the number of sweeps are positive')
    select type (delassus)
    type is (delassus_dense_t)
      call assert_shape(shape(delassus%matrix), [size(q), size(q)], place, 'W%matrix')
    end select
  end subroutine check_problem

  !> By what is known of W; all numbers are ordinary.
  subroutine solve_kind(options, delassus, q, mu, m, r, work, certificate, status)
    type(cone_options_t), intent(in) :: options
    class(delassus_t), intent(in) :: delassus
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(in) :: m
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    type(status_t), intent(inout) :: status
    if (options%solver /= solver_products) then
      select type (delassus)
      type is (delassus_dense_t)
        call solve_dense(options, delassus, q, mu, m, r, work, certificate, status)
        return
      type is (delassus_blocks_t)
        call solve_blocks(options, delassus, q, mu, m, r, work%u, certificate, status)
        call find_statuses(m, mu, r, work%u, work%status)
        return
      end select
    end if
    call solve_by_products(options, delassus, q, mu, m, r, work%u, certificate, status)
    call find_statuses(m, mu, r, work%u, work%status)
  end subroutine solve_kind

  !> Numbers near the ends of their range, or large friction: the problem in other units, by
  !> powers of two, so that no digit changes. |q| below 1e-300 counts as 0.
  subroutine solve_rescaled(options, delassus, q, mu, m, r, work, certificate, status)
    type(cone_options_t), intent(in) :: options
    class(delassus_t), intent(in) :: delassus
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(in) :: m
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    type(status_t), intent(inout) :: status
    class(delassus_t), allocatable :: w
    real(wp), dimension(size(q, 1), size(q, 2)) :: q_c, r_c
    integer :: e, f
    if (.not. (ieee_is_finite(m) .and. all(ieee_is_finite(q)) .and. m > zero)) then
      r = zero
      work%u = q
      certificate%met = .false.
      call fail(status, status_numerical, 'the contact solve has numbers that are not'// &
          ' finite (NaN or Inf), or no flexibility at all', &
          hint='check units, densities and the time step; take a smaller step')
      return
    end if
    if (maxval(abs(q)) <= nothing) then
      r = zero
      work%u = q
      return
    end if
    e = exponent(m)
    f = exponent(maxval(abs(q)))
    call delassus%rescaled(-e, w)
    q_c = scale(q, -f)
    r_c = zero
    if (all(exponent(r) + e - f <= exponent(largest_ordinary))) r_c = scale(r, e - f)
    if (maxval(mu) > large_friction) then
      call solve_large_friction(options, w, q_c, mu, r_c, work, certificate, status)
    else
      call solve_kind(options, w, q_c, mu, w%mean_diagonal(), r_c, work, certificate, status)
    end if
    if (in_range(maxval(exponent(r_c)) + f - e)) then
      r = scale(r_c, f - e)
      work%u = scale(work%u, f)
    else
      r = zero
      work%u = q
      call fail(status, status_numerical, 'the reactions are beyond the range of numbers', &
          hint='choose other units')
    end if
    call certify(m, mu, q, r, work%u, options%tolerance, certificate)
    certificate%met = certificate%met .and. .not. failed(status)
  end subroutine solve_rescaled

  !> Can numbers of that exponent be held, with all their digits and smaller ones beside them?
  pure logical function in_range(power)
    integer, intent(in) :: power
    in_range = power <= maxexponent(zero) .and. power >= minexponent(zero) + digits(zero)
  end function in_range

  !> Reactions that stick with less friction stick with more, and are taken if the law holds
  !> with all of it. Else the solve goes on from them, with as much of mu as can be squared;
  !> beyond that only r_n = |r_t|/mu of a contact that slips still changes.
  subroutine solve_large_friction(options, w, q, mu, r, work, certificate, status)
    type(cone_options_t), intent(in) :: options
    class(delassus_t), intent(in) :: w
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    type(status_t), intent(inout) :: status
    type(cone_options_t) :: exact
    type(certificate_t) :: trial
    type(status_t) :: answer
    real(wp) :: m
    integer :: a
    m = w%mean_diagonal()
    call solve_kind(options, w, q, min(mu, large_friction), m, r, work, certificate, answer)
    call certify(m, mu, q, r, work%u, options%tolerance, certificate)
    if (.not. certificate%met) then
      exact = options
      exact%local = local_exact
      call solve_kind(exact, w, q, min(mu, largest_ordinary), m, r, work, trial, answer)
      do a = 1, size(mu)
        if (mu(a) > largest_ordinary .and. tangent_length(r(:, a)) > &
            nearly*largest_ordinary*r(1, a)) r(1, a) = tangent_length(r(:, a))/mu(a)
      end do
      certificate%sweeps = certificate%sweeps + trial%sweeps
      certificate%newton_steps = certificate%newton_steps + trial%newton_steps
      call certify(m, mu, q, r, work%u, options%tolerance, certificate)
    end if
    call find_statuses_of_law(mu, r, work%status)
    if (.not. certificate%met) call fail_uncertified(m, w, min(mu, largest_ordinary), r, &
        work%u, certificate, status)
  end subroutine solve_large_friction

  !> Statuses (nc) from the reactions alone.
  pure subroutine find_statuses_of_law(mu, r, status)
    real(wp), intent(in) :: mu(:), r(:, :)
    integer, intent(out) :: status(:)
    integer :: a
    do a = 1, size(mu)
      status(a) = contact_open
      if (.not. r(1, a) > zero) cycle
      status(a) = contact_stick
      if (size(r, 1) > 1 .and. tangent_length(r(:, a))/max(mu(a), 1.0_wp) &
          >= nearly*r(1, a)*min(mu(a), 1.0_wp)) status(a) = contact_slip
    end do
  end subroutine find_statuses_of_law

end module cone_solver
