! SPDX-License-Identifier: BSD-3-Clause
!> Which method comes next in a group of contacts: the rule of AUTO. It asks for sizes, costs
!> and misfits only. Costs are counted in products with W; progress is the logarithm of the
!> misfit that a method took away, over what that cost.
module cone_strategy
  use base_kinds, only: wp, zero, one, half
  use cone_newton, only: plan_band, plan_newton, step_products
  use cone_scaled, only: scaled_t, start_method, keep_best, misfit_of, chunk, plain_sweeps, &
      anderson_sweeps, momentum_steps
  use cone_types, only: cone_options_t, certificate_t, solver_auto, solver_anderson, &
      solver_gs, solver_nesterov
  implicit none
  private
  public :: choose_method, after_failed_newton, newton_budget, products_left

  !> Sweeps before the acceleration: of AUTO, of the other solvers.
  integer, parameter :: auto_patience = chunk, other_patience = 30
  real(wp), parameter :: first_span = 400.0_wp !< products that must halve the misfit
  real(wp), parameter :: cheap = 80.0_wp       !< products: a Newton of that cost comes first
  !> Accelerated sweeps go on while no more than that is left of them at their rate, or while
  !> they are faster than momentum: a decade of the misfit in so many products, until it has
  !> been measured. Their rate is that of the last three to six chunks.
  real(wp), parameter :: promising = 100.0_wp, decade = 60.0_wp
  integer, parameter :: window = 3
  !> A turn of sweeps in the place of momentum that stalls takes at least that share of what has
  !> been spent.
  real(wp), parameter :: turn_share = 0.08_wp
  real(wp), parameter :: largest_newton = 1.0e8_wp  !< numbers of the matrix of a step
  !> Newton is expected to take about that many steps.
  !> The proximal loop takes a few times that.
  real(wp), parameter :: newton_weight = 15.0_wp, loops_weight = 5.0_wp
  !> The first attempt on W itself is made when so many of its steps have been spent: it tells
  !> by a step or two whether W is singular.
  real(wp), parameter :: trial_weight = 5.0_wp
  !> A misfit that has fallen by so much is worth another attempt of Newton, or that momentum
  !> begins anew: its memory is worth hundreds of steps.
  real(wp), parameter :: much_less = 0.1_wp
  !> What is left at the rate of the others when a plan for Newton is made; of many unknowns
  !> the plan itself takes as long as so many products.
  real(wp), parameter :: plan_products = 80.0_wp
  integer, parameter :: many_unknowns = 300
  !> Of what other methods have spent Newton and the proximal loop get that much: in the plane,
  !> where the law is made of straight pieces, and in space; more where nothing else makes
  !> progress.
  real(wp), parameter :: shares(2:3) = [0.5_wp, 0.2_wp], stalled_shares(2:3) = [1.0_wp, 0.35_wp]

  !> What is known of the iterations so far.
  type, public :: strategy_t
    logical :: newton_due = .false.
    logical :: proximal_due = .false.    !< with the proximal loop behind it
    integer :: newtons = 0               !< attempts
    logical :: singular = .false.        !< the last one found W singular
    logical :: anew = .false.            !< Newton from no reactions is due, which is once
    logical :: begun_anew = .false.
    real(wp) :: newton_spent = zero      !< products of all of them
    real(wp) :: newton_end = zero        !< products at the end of the last
    real(wp) :: newton_rate = zero       !< progress a product of the last
    real(wp) :: newton_misfit = zero     !< at its end
    !> Products and misfits from which progress is measured, and those that come next.
    real(wp) :: from(2) = zero, from_misfit(2) = huge(one)
    real(wp) :: own = huge(one)          !< least misfit of the method since it began
    real(wp) :: span = first_span
    logical :: stalled = .false.         !< the last span did not halve the misfit
    logical :: judged = .false.          !< a span has just ended
    !> Of accelerated sweeps: chunks since the second mark, marks (products, logarithm of the
    !> misfit) from which their rate is measured, and that rate when momentum took over.
    integer :: chunks = 0
    real(wp) :: mark(2) = zero, mark_log(2) = zero
    real(wp) :: sweeps_rate = zero, momentum_rate = zero
    !> Momentum goes on after a turn of sweeps at r (d, nc) where it was, with its own misfit,
    !> unless the misfit became much less than at their start.
    real(wp) :: turn_end = zero, turn_misfit = zero, left_own = zero
    real(wp), allocatable :: left_at(:, :)
  end type strategy_t

contains

  !> After a chunk of sweeps: the method of the next (in p), and whether Newton is due instead.
  subroutine choose_method(options, certificate, p, strategy)
    type(cone_options_t), intent(in) :: options
    type(certificate_t), intent(in) :: certificate
    type(scaled_t), intent(inout) :: p
    type(strategy_t), intent(inout) :: strategy
    integer :: patience
    strategy%newton_due = .false.
    call keep_best(p, certificate)
    if (options%solver == solver_gs) return
    patience = merge(auto_patience, other_patience, options%solver == solver_auto)
    if (certificate%sweeps == patience) then
      call start_method(p, &
          merge(momentum_steps, anderson_sweeps, options%solver == solver_nesterov))
      call start_measure(certificate%products, misfit_of(certificate), strategy)
    end if
    if (options%solver == solver_nesterov .or. certificate%sweeps < 2*chunk) return
    strategy%own = min(strategy%own, misfit_of(certificate))
    call measure(strategy%own, certificate%products, strategy)
    if (options%solver == solver_anderson) then
      if (strategy%judged .and. strategy%stalled) call start_method(p, &
          merge(plain_sweeps, anderson_sweeps, p%method == anderson_sweeps))
      return
    end if
    call ask_for_newton(options, certificate, p, strategy)
    if (.not. strategy%newton_due .and. certificate%sweeps > patience) &
        call choose_sweeps(options, certificate%products, p, strategy)
  end subroutine choose_method

  !> Progress is measured from here.
  pure subroutine start_measure(now, misfit, strategy)
    real(wp), intent(in) :: now, misfit
    type(strategy_t), intent(inout) :: strategy
    strategy%from = now
    strategy%from_misfit = misfit
    strategy%own = misfit
    strategy%stalled = .false.
    strategy%chunks = 0
    strategy%mark = now
    strategy%mark_log = log(max(tiny(one), misfit))
  end subroutine start_measure

  !> Moves the two places from which progress is measured, at the end of a span. Spans grow with
  !> what has been spent.
  pure subroutine measure(misfit, now, strategy)
    real(wp), intent(in) :: misfit, now
    type(strategy_t), intent(inout) :: strategy
    strategy%judged = now - strategy%from(2) >= max(strategy%span, &
        1.5_wp*(strategy%from(2) - strategy%from(1)))
    if (.not. strategy%judged) return
    strategy%stalled = misfit > half*strategy%from_misfit(2)
    strategy%from = [strategy%from(2), now]
    strategy%from_misfit = [strategy%from_misfit(2), misfit]
  end subroutine measure

  !> Products that are left at the rate measured, huge where there is no progress.
  pure real(wp) function products_left(tolerance, best, now, strategy) result(left)
    real(wp), intent(in) :: tolerance, best, now
    type(strategy_t), intent(in) :: strategy
    left = huge(left)
    if (.not. best < strategy%from_misfit(1)) return
    if (strategy%from_misfit(1) >= huge(left)) return
    left = (now - strategy%from(1))*log(best/tolerance)/log(strategy%from_misfit(1)/best)
  end function products_left

  !> Momentum or accelerated sweeps. The sweeps begin, and stay as long as they promise to be
  !> done soon, or are faster; they take a turn where momentum stalls or has become slower.
  subroutine choose_sweeps(options, now, p, strategy)
    type(cone_options_t), intent(in) :: options
    real(wp), intent(in) :: now
    type(scaled_t), intent(inout) :: p
    type(strategy_t), intent(inout) :: strategy
    real(wp) :: rate
    if (p%method == momentum_steps) then
      if (.not. strategy%judged) return
      strategy%momentum_rate = log(max(one, strategy%from_misfit(1)/strategy%own)) &
          /(now - strategy%from(1))
      if (.not. strategy%stalled .and. strategy%momentum_rate >= strategy%sweeps_rate) return
      strategy%left_at = p%r
      strategy%left_own = strategy%own
      strategy%turn_misfit = p%best_misfit
      strategy%span = 2.0_wp*strategy%span
      strategy%turn_end = now + merge(turn_share*now, zero, strategy%stalled)
      p%r = p%best
      call start_method(p, anderson_sweeps)
      call start_measure(now, p%best_misfit, strategy)
    else
      call measure_sweeps(now, strategy, rate)
      if (log(p%best_misfit/options%tolerance) <= promising*rate) return
      if (rate >= max(strategy%momentum_rate, log(10.0_wp)/decade)) return
      if (now < strategy%turn_end) return
      if (allocated(strategy%left_at) .and. .not. strategy%mark(2) > strategy%mark(1)) return
      strategy%sweeps_rate = rate
      if (allocated(strategy%left_at) .and. p%best_misfit > much_less*strategy%turn_misfit) then
        p%r = strategy%left_at
        p%method = momentum_steps
        call start_measure(now, strategy%left_own, strategy)
      else
        p%r = p%best
        call start_method(p, momentum_steps)
        call start_measure(now, p%best_misfit, strategy)
      end if
    end if
  end subroutine choose_sweeps

  !> The rate of accelerated sweeps over their last chunks: logarithm of the misfit a product.
  subroutine measure_sweeps(now, strategy, rate)
    real(wp), intent(in) :: now
    type(strategy_t), intent(inout) :: strategy
    real(wp), intent(out) :: rate
    real(wp) :: reached
    reached = log(max(tiny(one), strategy%own))
    rate = (strategy%mark_log(1) - reached)/max(one, now - strategy%mark(1))
    strategy%chunks = strategy%chunks + 1
    if (strategy%chunks < window) return
    strategy%chunks = 0
    strategy%mark = [strategy%mark(2), now]
    strategy%mark_log = [strategy%mark_log(2), reached]
  end subroutine measure_sweeps

  !> Is Newton due? Its plan is made when it may be. Newton alone is tried again when the misfit
  !> has become much smaller: where W is singular its first step tells so.
  subroutine ask_for_newton(options, certificate, p, strategy)
    type(cone_options_t), intent(in) :: options
    type(certificate_t), intent(in) :: certificate
    type(scaled_t), intent(inout) :: p
    type(strategy_t), intent(inout) :: strategy
    real(wp) :: left, since, cost, trial
    left = products_left(options%tolerance, strategy%own, certificate%products, strategy)
    call plan_band(p%w, p%newton)
    if (newton_cost(p) > cheap) then
      if (size(p%q) > many_unknowns .and. min(left, certificate%products) < plan_products) &
          return
      call plan_newton(p%w, p%newton)
    end if
    if (p%newton%numbers > largest_newton) return
    cost = newton_cost(p)
    if (cost > cheap) p%longest = one
    trial = trial_weight*step_products(p%w, p%newton)
    since = certificate%products - strategy%newton_end
    if (strategy%newtons == 0) then
      strategy%proximal_due = cost <= cheap
      strategy%newton_due = cost <= cheap .or. since >= trial
    else
      strategy%proximal_due = (strategy%stalled .or. left > cost) .and. &
          since >= proximal_wait(options%tolerance, cost, left, p, strategy)
      strategy%newton_due = strategy%proximal_due .or. &
          p%best_misfit < merge(much_less**2, much_less, strategy%singular) &
          *strategy%newton_misfit
    end if
    strategy%newton_due = strategy%newton_due .and. (strategy%stalled .or. left > trial)
    strategy%anew = .not. strategy%begun_anew .and. (strategy%stalled .or. left > 0.6_wp*cost)
    if (strategy%newtons > 0 .and. .not. strategy%singular) &
        strategy%newton_due = strategy%newton_due .or. strategy%anew
  end subroutine ask_for_newton

  pure real(wp) function newton_cost(p)
    type(scaled_t), intent(in) :: p
    newton_cost = newton_weight*step_products(p%w, p%newton)
  end function newton_cost

  !> Products that the next attempt of Newton and the proximal loop may take.
  pure real(wp) function newton_budget(p, now, strategy)
    type(scaled_t), intent(in) :: p
    real(wp), intent(in) :: now
    type(strategy_t), intent(in) :: strategy
    newton_budget = newton_cost(p)
    if (newton_budget <= cheap) newton_budget = loops_weight*newton_budget
    newton_budget = max(newton_budget, share_of(p, strategy) &
        *(now - strategy%newton_spent))
  end function newton_budget

  !> Share of Newton and the proximal loop in what the others have spent.
  pure real(wp) function share_of(p, strategy)
    type(scaled_t), intent(in) :: p
    type(strategy_t), intent(in) :: strategy
    integer :: d
    d = max(2, size(p%q, 1))
    share_of = merge(stalled_shares(d), shares(d), strategy%stalled)
  end function share_of

  !> Products of other methods before the proximal loop is tried (again): a few times what
  !> Newton takes, and three times as much as all attempts, or half as much again where the
  !> others stall; none where the last attempt has made more progress than they do.
  pure real(wp) function proximal_wait(tolerance, cost, left, p, strategy) result(wait)
    real(wp), intent(in) :: tolerance, cost, left
    type(scaled_t), intent(in) :: p
    type(strategy_t), intent(in) :: strategy
    wait = max(cost, strategy%newton_spent)/share_of(p, strategy)
    if (.not. strategy%newton_rate > zero) return
    if (log(p%best_misfit/tolerance)/strategy%newton_rate < left) wait = zero
  end function proximal_wait

  !> After a Newton that failed, which began at `began` products and misfit `before`: momentum
  !> goes on from where it was, or from the best point if Newton has found a much better one.
  subroutine after_failed_newton(began, before, now, p, strategy)
    real(wp), intent(in) :: began, before, now
    type(scaled_t), intent(inout) :: p
    type(strategy_t), intent(inout) :: strategy
    strategy%newtons = strategy%newtons + 1
    strategy%newton_spent = strategy%newton_spent + (now - began)
    strategy%newton_end = now
    strategy%newton_rate = zero
    strategy%newton_misfit = p%best_misfit
    strategy%from = strategy%from + (now - began)
    strategy%mark = strategy%mark + (now - began)
    strategy%turn_end = strategy%turn_end + (now - began)
    if (p%best_misfit <= half*before) &
        strategy%newton_rate = log(before/p%best_misfit)/max(one, now - began)
    if (p%method == momentum_steps .and. p%best_misfit > much_less*before) return
    p%r = p%best
    call start_method(p, momentum_steps)
    call start_measure(now, p%best_misfit, strategy)
  end subroutine after_failed_newton

end module cone_strategy
