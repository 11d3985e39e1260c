! SPDX-License-Identifier: BSD-3-Clause
!> The contact problem u = W r + q on blocks, in the plane and in space. Groups of contacts that
!> do not know each other are solved one by one; in each: sweeps, accelerated sweeps, and Newton
!> with a proximal loop where it is expected to be the cheaper. Every answer is certified.
module cone_solver
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t
  use cone_blocks, only: flexibility_t, motions, mean_of_diagonal, find_components, &
      take_component, dense_of_blocks
  use cone_certificate, only: certify, fail_uncertified
  use cone_local, only: may_wedge
  use cone_course, only: course_t, watch, go_on
  use cone_pivoting, only: pivot_statuses
  use cone_polish, only: polish_statuses
  use cone_proximal, only: proximal_newton, raise_friction, most_loops
  use cone_scaled, only: scaled_t, scale_problem, sweep_chunk, look
  use cone_types, only: cone_options_t, certificate_t, cone_work_t, size_cone_work, &
      late
  implicit none
  private
  public :: solve_contacts

  integer, parameter :: most_pivoted = 40      !< contacts of a complementary path

contains

  !> Reactions r (d, nc) [F] and motions u (d, nc) [L] for W [L/F], q (d, nc) [L], mu (nc). r on
  !> entry is the start where options%warm_start. Fails when no means meets the tolerance; the
  !> certificate says how near it came.
  subroutine solve_contacts(options, flexibility, q, mu, r, u, certificate, status)
    type(cone_options_t), intent(in) :: options
    type(flexibility_t), intent(in) :: flexibility
    real(wp), intent(in) :: q(:, :), mu(:)
    real(wp), intent(inout) :: r(:, :)
    real(wp), intent(out) :: u(:, :)
    type(certificate_t), intent(out) :: certificate
    type(status_t), intent(inout) :: status
    integer, allocatable :: first(:), member(:), place(:)
    type(flexibility_t) :: part
    integer :: k
    if (.not. options%warm_start) r = zero
    call find_components(flexibility, first, member)
    allocate (place(flexibility%contacts))
    do k = 1, size(first) - 1
      associate (list => member(first(k):first(k + 1) - 1))
        call take_component(flexibility, list, place, part)
        call solve_component(options, part, q(:, list), mu(list), list, r, &
            certificate)
      end associate
    end do
    call motions(flexibility, q, r, u)
    call certify(mean_of_diagonal(flexibility), mu, q, r, u, options%tolerance, &
        certificate)
    call count_wedging(flexibility, mu, r, certificate)
    if (certificate%met) return
    call fail_uncertified(mean_of_diagonal(flexibility), &
        flexibility%block(:, :, flexibility%diagonal), mu, r, u, certificate, status)
  end subroutine solve_contacts

  !> Contacts for which W_aa alone allows several answers: one was taken, which is told.
  pure subroutine count_wedging(flexibility, mu, r, certificate)
    type(flexibility_t), intent(in) :: flexibility
    real(wp), intent(in) :: mu(:), r(:, :)
    type(certificate_t), intent(inout) :: certificate
    integer :: a
    do a = 1, size(mu)
      if (.not. r(1, a) > zero) cycle
      if (.not. may_wedge(flexibility%block(:, :, flexibility%diagonal(a)), mu(a))) cycle
      if (certificate%wedged == 0) certificate%first_wedged = a
      certificate%wedged = certificate%wedged + 1
    end do
  end subroutine count_wedging

  !> One component; its contacts are list in r (d, all).
  subroutine solve_component(options, part, q, mu, list, r, certificate)
    type(cone_options_t), intent(in) :: options
    type(flexibility_t), intent(in) :: part
    real(wp), intent(in) :: q(:, :), mu(:)
    integer, intent(in) :: list(:)
    real(wp), intent(inout) :: r(:, :)
    type(certificate_t), intent(inout) :: certificate
    type(certificate_t) :: own
    type(scaled_t) :: p
    real(wp) :: m, largest
    if (all(q(1, :) >= zero)) then
      r(:, list) = zero
      return
    end if
    m = mean_of_diagonal(part)
    largest = maxval(abs(q))
    call scale_problem(part, q, mu, r(:, list), m, largest, p)
    call iterate(options, p, own)
    r(:, list) = p%r*(largest/m)
    certificate%sweeps = max(certificate%sweeps, own%sweeps)
    certificate%newton_steps = certificate%newton_steps + own%newton_steps
    certificate%local_iterations = certificate%local_iterations + own%local_iterations
  end subroutine solve_component

  !> Chunks of sweeps until the certificate is met; Newton when it is due.
  subroutine iterate(options, p, certificate)
    type(cone_options_t), intent(in) :: options
    type(scaled_t), intent(inout) :: p
    type(certificate_t), intent(inout) :: certificate
    type(course_t) :: course
    if (options%solver == 'PROX' .or. options%solver == 'NEWTON') then
      call look(p, options%tolerance, certificate)
      call proximal_newton(options, p, options%solver == 'NEWTON', most_loops, certificate)
      if (certificate%met) return
    end if
    do while (certificate%sweeps < options%max_sweeps)
      if (late(options)) return
      call sweep_chunk(options, p, certificate)
      call look(p, options%tolerance, certificate)
      if (certificate%met) return
      call watch(options, certificate, p, course)
      if (course%newton_due) then
        call proximal_newton(options, p, course%newtons == 0, &
            merge(most_loops, 0, course%proximal_due), certificate)
        if (certificate%met) return
        if (size(p%q, 1) == 2 .and. size(p%mu) <= most_pivoted .and. course%newtons == 0) &
            call try_pivoting(p, options%tolerance, certificate)
        if (certificate%met) return
        if (course%newtons == 0 .and. some_wedge(p)) &
            call raise_friction(options, p, certificate)
        if (certificate%met) return
        call go_on(options, certificate, p, course)
      end if
    end do
  end subroutine iterate

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

  !> In the plane, where contacts wedge: the statuses of a complementary path, solved directly.
  subroutine try_pivoting(p, tolerance, certificate)
    type(scaled_t), intent(inout) :: p
    real(wp), intent(in) :: tolerance
    type(certificate_t), intent(inout) :: certificate
    type(certificate_t) :: trial
    type(cone_work_t) :: work
    real(wp), dimension(size(p%r, 1), size(p%r, 2)) :: kept, start
    real(wp) :: dense(size(p%r), size(p%r))
    logical :: ok
    call dense_of_blocks(p%w, dense)
    call size_cone_work(work, 2, size(p%mu))
    start(1, :) = one
    call pivot_statuses(dense, p%q, p%mu, work%status, start(2, :), ok)
    certificate%pivotings = certificate%pivotings + 1
    if (ok) call polish_statuses(dense, p%q, p%mu, start, work, ok)
    if (.not. ok) return
    kept = p%r
    p%r = work%trial
    trial = certificate
    call look(p, tolerance, trial)
    if (trial%met) then
      certificate = trial
    else
      p%r = kept
    end if
  end subroutine try_pivoting

end module cone_solver
