! SPDX-License-Identifier: BSD-3-Clause
!> Which method comes next in a group of contacts: the rule of AUTO. It asks for sizes, costs
!> and errors only. Costs are counted in sweeps.
module cone_strategy
  use base_kinds, only: wp, half
  use cone_newton, only: plan_newton
  use cone_scaled, only: scaled_t, start_method, chunk, plain_sweeps, anderson_sweeps, &
      momentum_steps
  use cone_types, only: cone_options_t, certificate_t, solver_anderson, solver_gs, &
      solver_nesterov
  implicit none
  private
  public :: choose_method, after_failed_newton

  integer, parameter :: patience = 30          !< sweeps before the acceleration
  integer, parameter :: span = 100             !< sweeps that must halve the error
  real(wp), parameter :: cheap = 80.0_wp       !< sweeps: a Newton of that cost comes first
  real(wp), parameter :: largest_newton = 1.0e8_wp  !< numbers of the matrix of a step
  !> Newton is expected to take about fifteen steps; a sweep takes six operations a number of W.
  real(wp), parameter :: newton_weight = 15.0_wp, sweep_weight = 6.0_wp
  !> A proximal loop takes several times that; steps with momentum get as much before it.
  real(wp), parameter :: momentum_share = 1.0_wp

  !> What is known of the iterations so far.
  type, public :: strategy_t
    logical :: newton_due = .false.
    logical :: proximal_due = .false.    !< with the proximal loop behind it
    integer :: newtons = 0               !< attempts
    real(wp) :: wait = 0.0_wp            !< no Newton, no other method before that many sweeps
    real(wp) :: start = huge(1.0_wp)     !< error at sweep `patience`
    real(wp) :: best = huge(1.0_wp)
    real(wp) :: marked = huge(1.0_wp)    !< error at the last mark
    integer :: mark = 0
    logical :: stalled = .false.
  end type strategy_t

contains

  !> After a chunk of sweeps: the method of the next (in p), and whether Newton is due instead.
  subroutine choose_method(options, certificate, p, strategy)
    type(cone_options_t), intent(in) :: options
    type(certificate_t), intent(in) :: certificate
    type(scaled_t), intent(inout) :: p
    type(strategy_t), intent(inout) :: strategy
    strategy%newton_due = .false.
    strategy%best = min(strategy%best, certificate%error)
    if (certificate%sweeps <= patience) strategy%start = certificate%error
    if (options%solver == solver_gs) return
    if (certificate%sweeps == patience) call start_method(p, &
        merge(momentum_steps, anderson_sweeps, options%solver == solver_nesterov))
    if (options%solver == solver_nesterov .or. certificate%sweeps < strategy%wait) return
    if (certificate%sweeps >= strategy%mark + span) then
      strategy%stalled = certificate%error > half*strategy%marked
      strategy%marked = certificate%error
      strategy%mark = certificate%sweeps
      if (strategy%stalled) call start_method(p, other_method(options, p%method))
    end if
    if (options%solver == solver_anderson .or. certificate%sweeps < 2*chunk) return
    call plan_newton(p%w, p%newton)
    strategy%newton_due = newton_pays(options, p, certificate, strategy)
    strategy%proximal_due = strategy%newtons > 0 .or. newton_cost(p) <= cheap
  end subroutine choose_method

  !> After a Newton that failed: momentum, and how long (half of the sweeps that are left, at
  !> most).
  subroutine after_failed_newton(options, certificate, p, strategy)
    type(cone_options_t), intent(in) :: options
    type(certificate_t), intent(in) :: certificate
    type(scaled_t), intent(inout) :: p
    type(strategy_t), intent(inout) :: strategy
    strategy%newtons = strategy%newtons + 1
    strategy%wait = max(3.0_wp*certificate%sweeps, &
        certificate%sweeps + momentum_share*newton_cost(p))
    strategy%wait = min(strategy%wait, half*(certificate%sweeps + options%max_sweeps))
    call start_method(p, momentum_steps)
  end subroutine after_failed_newton

  !> Where sweeps stall, another way to go on.
  pure integer function other_method(options, method)
    type(cone_options_t), intent(in) :: options
    integer, intent(in) :: method
    other_method = anderson_sweeps
    if (method == anderson_sweeps) &
        other_method = merge(plain_sweeps, momentum_steps, options%solver == solver_anderson)
  end function other_method

  pure real(wp) function newton_cost(p)
    type(scaled_t), intent(in) :: p
    newton_cost = newton_weight*p%newton%flops/(sweep_weight*size(p%w%block))
  end function newton_cost

  !> Newton pays where sweeps stall, or would cost more at their rate.
  pure logical function newton_pays(options, p, certificate, strategy)
    type(cone_options_t), intent(in) :: options
    type(scaled_t), intent(in) :: p
    type(certificate_t), intent(in) :: certificate
    type(strategy_t), intent(in) :: strategy
    real(wp) :: left
    newton_pays = .false.
    if (p%newton%numbers > largest_newton) return
    if (certificate%sweeps < cheap .and. newton_cost(p) > cheap) return
    left = options%max_sweeps
    if (certificate%sweeps <= patience) left = 10*span
    if (strategy%best < strategy%start) left = min(left, (certificate%sweeps - patience) &
        *log(options%tolerance/strategy%best)/log(strategy%best/strategy%start))
    newton_pays = strategy%stalled .or. left > newton_cost(p)
  end function newton_pays

end module cone_strategy
