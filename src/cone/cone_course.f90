! SPDX-License-Identifier: BSD-3-Clause
!> Which means come next in a group of contacts: the rule of AUTO. It asks for sizes, costs and
!> errors only. Costs are counted in sweeps.
module cone_course
  use base_kinds, only: wp, half
  use cone_newton, only: plan_newton
  use cone_scaled, only: scaled_t, change_means, chunk, plain_sweeps, anderson_sweeps, &
      momentum_steps
  use cone_types, only: cone_options_t, certificate_t
  implicit none
  private
  public :: watch, go_on

  integer, parameter :: patience = 30          !< sweeps before the acceleration
  integer, parameter :: span = 100             !< sweeps that must halve the error
  real(wp), parameter :: cheap = 80.0_wp       !< sweeps: a Newton of that cost comes first
  real(wp), parameter :: largest_newton = 1.0e8_wp  !< numbers of the matrix of a step
  !> Newton is expected to take about fifteen steps; a sweep takes six operations a number of W.
  real(wp), parameter :: newton_weight = 15.0_wp, sweep_weight = 6.0_wp
  !> A proximal loop takes several times that; steps with momentum get as much before it.
  real(wp), parameter :: momentum_share = 1.0_wp

  !> What is known of the course of the iterations.
  type, public :: course_t
    logical :: newton_due = .false.
    logical :: proximal_due = .false.    !< with the proximal loop behind it
    integer :: newtons = 0               !< attempts
    real(wp) :: wait = 0.0_wp            !< no Newton, no other means before that many sweeps
    real(wp) :: start = huge(1.0_wp)     !< error at sweep `patience`
    real(wp) :: best = huge(1.0_wp)
    real(wp) :: marked = huge(1.0_wp)    !< error at the last mark
    integer :: mark = 0
    logical :: stalled = .false.
  end type course_t

contains

  !> After a chunk of sweeps: the means of the next (in p), and whether Newton is due instead.
  subroutine watch(options, certificate, p, course)
    type(cone_options_t), intent(in) :: options
    type(certificate_t), intent(in) :: certificate
    type(scaled_t), intent(inout) :: p
    type(course_t), intent(inout) :: course
    course%newton_due = .false.
    course%best = min(course%best, certificate%error)
    if (certificate%sweeps <= patience) course%start = certificate%error
    if (options%solver == 'GS') return
    if (certificate%sweeps == patience) call change_means(p, &
        merge(momentum_steps, anderson_sweeps, options%solver == 'NESTEROV'))
    if (options%solver == 'NESTEROV' .or. certificate%sweeps < course%wait) return
    if (certificate%sweeps >= course%mark + span) then
      course%stalled = certificate%error > half*course%marked
      course%marked = certificate%error
      course%mark = certificate%sweeps
      if (course%stalled) call change_means(p, other_means(options, p%means))
    end if
    if (options%solver == 'ANDERSON' .or. certificate%sweeps < 2*chunk) return
    call plan_newton(p%w, p%newton)
    course%newton_due = newton_pays(options, p, certificate, course)
    course%proximal_due = course%newtons > 0 .or. newton_cost(p) <= cheap
  end subroutine watch

  !> After a Newton that failed: momentum, and how long (half of the sweeps that are left, at
  !> most).
  subroutine go_on(options, certificate, p, course)
    type(cone_options_t), intent(in) :: options
    type(certificate_t), intent(in) :: certificate
    type(scaled_t), intent(inout) :: p
    type(course_t), intent(inout) :: course
    course%newtons = course%newtons + 1
    course%wait = max(3.0_wp*certificate%sweeps, &
        certificate%sweeps + momentum_share*newton_cost(p))
    course%wait = min(course%wait, half*(certificate%sweeps + options%max_sweeps))
    call change_means(p, momentum_steps)
  end subroutine go_on

  !> Where sweeps stall, another way to go on.
  pure integer function other_means(options, means)
    type(cone_options_t), intent(in) :: options
    integer, intent(in) :: means
    other_means = anderson_sweeps
    if (means == anderson_sweeps) &
        other_means = merge(plain_sweeps, momentum_steps, options%solver == 'ANDERSON')
  end function other_means

  pure real(wp) function newton_cost(p)
    type(scaled_t), intent(in) :: p
    newton_cost = newton_weight*p%newton%flops/(sweep_weight*size(p%w%block))
  end function newton_cost

  !> Newton pays where sweeps stall, or would cost more at their rate.
  pure logical function newton_pays(options, p, certificate, course)
    type(cone_options_t), intent(in) :: options
    type(scaled_t), intent(in) :: p
    type(certificate_t), intent(in) :: certificate
    type(course_t), intent(in) :: course
    real(wp) :: left
    newton_pays = .false.
    if (p%newton%numbers > largest_newton) return
    if (certificate%sweeps < cheap .and. newton_cost(p) > cheap) return
    left = options%max_sweeps
    if (certificate%sweeps <= patience) left = 10*span
    if (course%best < course%start) left = min(left, (certificate%sweeps - patience) &
        *log(options%tolerance/course%best)/log(course%best/course%start))
    newton_pays = course%stalled .or. left > newton_cost(p)
  end function newton_pays

end module cone_course
