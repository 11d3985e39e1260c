! SPDX-License-Identifier: BSD-3-Clause
!> The proximal point method with Newton inside: W + alpha I has full rank, and alpha goes down
!> as long as Newton follows (the PPA of Acary, Bremond & Huber 2018, with another rule for
!> alpha).
module cone_proximal
  use base_kinds, only: wp, zero, one, half
  use cone_newton, only: newton_solve, step_products
  use cone_scaled, only: scaled_t, evaluate_error, misfit_of
  use cone_types, only: cone_options_t, certificate_t, late
  implicit none
  private
  public :: proximal_newton, newton_from_nothing, friction_continuation

  integer, parameter, public :: most_loops = 300
  integer, parameter :: few_loops = 60, most_newton = 40
  !> The first alpha, or less: a step leaves a misfit of about a third of alpha.
  real(wp), parameter :: first_alpha = 1.0e-1_wp, alpha_share = 10.0_wp
  !> Newton steps that must halve the map, where a budget is set.
  integer, parameter :: few_patience = 6
  !> Factor of alpha where Newton follows; nearer 1 where it has just not.
  real(wp), parameter :: least_shrink = 0.2_wp
  !> A misfit this much less than where the loop stopped: it begins anew there.
  real(wp), parameter :: much_better = 0.1_wp

contains

  !> From r of p to r that meets the tolerance, or the best on the way. plain_first: one Newton
  !> attempt on W itself; loops: how often on W + alpha I, after it; budget: products with W
  !> after which it stops. It goes on where it stopped before, unless another method has found
  !> a much better r since. Where forces must travel along a self-stress of the bodies until a
  !> contact opens or slips, alpha times the distance is the error of a step: it does not fall
  !> on the way, so the path goes on from the last point, not from the best.
  subroutine proximal_newton(options, p, plain_first, loops, budget, certificate)
    type(cone_options_t), intent(in) :: options
    type(scaled_t), intent(inout) :: p
    logical, intent(in) :: plain_first
    integer, intent(in) :: loops
    real(wp), intent(in) :: budget
    type(certificate_t), intent(inout) :: certificate
    type(certificate_t) :: trial
    real(wp), dimension(size(p%r, 1), size(p%r, 2)) :: best, last
    real(wp) :: alpha, norm, most_products, shrink
    integer :: outer, patience
    most_products = huge(budget)
    patience = 2*most_newton
    if (budget < huge(budget)) then
      most_products = certificate%products + budget
      patience = few_patience
    end if
    best = p%r
    alpha = zero
    shrink = least_shrink
    p%stands_still = .false.
    if (.not. plain_first) call resume(p, misfit_of(certificate), best, alpha)
    do outer = 1, loops + merge(1, 0, plain_first)
      if (late(options) .or. certificate%products > most_products) exit
      last = p%r
      p%newton%longest = merge(huge(one), p%longest, &
          alpha > zero .or. most_products >= huge(one))
      call one_newton(options, p, alpha, most_products, patience, norm, certificate)
      p%newton%longest = huge(one)
      trial = certificate
      call evaluate_error(p, options%tolerance, trial)
      certificate%products = trial%products
      if (misfit_of(trial) < misfit_of(certificate) .or. trial%met) then
        best = p%r
        certificate = trial
      end if
      if (trial%met) return
      if (.not. alpha > zero) then
        if (loops > 0) call resume(p, misfit_of(certificate), best, alpha)
      else if (norm > min(1.0e-3_wp*alpha, half*p%newton%first_norm)) then
        p%r = last
        if (alpha >= one) then
          p%stands_still = .true.
          p%alpha = zero
          alpha = zero
          exit
        end if
        alpha = min(one, 4.0_wp*alpha)
        shrink = min(half, sqrt(shrink))
      else
        alpha = shrink*alpha
        shrink = max(least_shrink, shrink**1.5_wp)
      end if
    end do
    if (alpha > zero) then
      p%alpha = alpha
      p%travel = p%r
      p%travel_misfit = misfit_of(certificate)
    end if
    p%r = best
  end subroutine proximal_newton

  !> Newton on W itself from no reactions, where steps from the best point are short because
  !> statuses there are not those of the answer: contacts then close one after the other. It
  !> stops after budget products with W; r is left as it was where the answer is no better.
  subroutine newton_from_nothing(options, p, budget, certificate)
    type(cone_options_t), intent(in) :: options
    type(scaled_t), intent(inout) :: p
    real(wp), intent(in) :: budget
    type(certificate_t), intent(inout) :: certificate
    type(certificate_t) :: trial
    real(wp) :: kept(size(p%r, 1), size(p%r, 2)), norm
    kept = p%r
    p%r = zero
    call one_newton(options, p, zero, certificate%products + budget, &
        few_patience, norm, certificate)
    trial = certificate
    call evaluate_error(p, options%tolerance, trial)
    certificate%products = trial%products
    if (misfit_of(trial) < misfit_of(certificate) .or. trial%met) then
      certificate = trial
    else
      p%r = kept
    end if
  end subroutine newton_from_nothing

  !> alpha and r with which the proximal loop begins or goes on; best: that of least misfit.
  pure subroutine resume(p, misfit, best, alpha)
    type(scaled_t), intent(inout) :: p
    real(wp), intent(in) :: misfit, best(:, :)
    real(wp), intent(out) :: alpha
    alpha = p%alpha
    if (.not. alpha > zero) alpha = min(first_alpha, alpha_share*misfit)
    p%r = best
    if (.not. p%alpha > zero) return
    if (misfit > much_better*p%travel_misfit) p%r = p%travel
  end subroutine resume

  !> Newton on W + alpha I from r of p, its steps and products counted; as many steps as fit in
  !> most_products, but some. patience steps must halve the map.
  subroutine one_newton(options, p, alpha, most_products, patience, norm, certificate)
    type(cone_options_t), intent(in) :: options
    type(scaled_t), intent(inout) :: p
    real(wp), intent(in) :: alpha, most_products
    integer, intent(in) :: patience
    real(wp), intent(out) :: norm
    type(certificate_t), intent(inout) :: certificate
    real(wp) :: goal
    integer :: steps, most
    most = most_newton
    if (most_products < huge(goal)) most = min(most, max(few_patience, &
        nint((most_products - certificate%products)/step_products(p%w, p%newton))))
    goal = 0.1_wp*options%tolerance*sqrt(sum(p%q**2))
    call newton_solve(p%w, p%q, p%mu, p%rho, alpha, goal, most, patience, p%r, p%newton, norm, &
        steps)
    certificate%newton_steps = certificate%newton_steps + steps
    certificate%products = certificate%products + p%newton%products
    p%newton%products = zero
  end subroutine one_newton

  !> Where contacts wedge: the law with little friction, which has an answer that Newton finds,
  !> and from there more and more of it (a continuation in mu).
  subroutine friction_continuation(options, p, certificate)
    type(cone_options_t), intent(in) :: options
    type(scaled_t), intent(inout) :: p
    type(certificate_t), intent(inout) :: certificate
    real(wp), parameter :: first = 0.5_wp, smallest_factor = 1.01_wp
    real(wp), dimension(size(p%r, 1), size(p%r, 2)) :: kept, start
    real(wp) :: mu(size(p%mu)), reached, factor
    type(certificate_t) :: trial
    start = p%r
    mu = p%mu
    kept = zero
    reached = zero
    factor = 2.0_wp
    trial = certificate
    do while (factor > smallest_factor)
      if (late(options)) exit
      p%mu = min(mu, merge(first, reached*factor, .not. reached > zero))
      p%r = kept
      call evaluate_error(p, options%tolerance, trial)
      if (.not. trial%met) then
        p%alpha = zero
        call proximal_newton(options, p, .true., few_loops, huge(one), trial)
      end if
      if (trial%met) then
        if (.not. any(p%mu < mu)) exit
        reached = maxval(p%mu)
        kept = p%r
        factor = factor**2
      else
        if (.not. reached > zero) exit
        factor = sqrt(factor)
      end if
    end do
    p%mu = mu
    p%alpha = zero
    certificate%newton_steps = trial%newton_steps
    certificate%products = trial%products
    call evaluate_error(p, options%tolerance, trial)
    if (trial%met) then
      certificate = trial
    else
      p%r = start
    end if
  end subroutine friction_continuation

end module cone_proximal
