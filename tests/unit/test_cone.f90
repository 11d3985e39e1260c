! SPDX-License-Identifier: BSD-3-Clause
!> Projection on Coulomb's cone, the contact solver and its certificate.
program test_cone
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, failed
  use check, only: test_start, test_end, check_true, check_close, check_equal, seed_random
  use cone_certificate, only: certify, bipotential_residual
  use cone_dense, only: delassus_dense_t
  use cone_local, only: project_on_cone
  use cone_solver, only: solve_cone
  use cone_types, only: cone_options_t, cone_work_t, certificate_t, contact_open, solver_gs
  use linalg_dense, only: solve_general
  implicit none
  real(wp), parameter :: eps = epsilon(one)
  real(wp), parameter :: friction(4) = [0.0_wp, 0.1_wp, 0.3_wp, 1.0_wp]
  integer :: k

  call test_start('cone')
  call seed_random(4711)
  do k = 1, 3
    call test_projection(k)
  end do
  call test_solutions(1)
  call test_solutions(2)
  call test_complementarity(1)
  call test_complementarity(2)
  call test_wedging()
  call test_open()
  call test_failure()
  call test_certificate()
  call test_end()

contains

  !> Numbers in (-1, 1).
  subroutine fill_random(x)
    real(wp), intent(out) :: x(:)
    call random_number(x)
    x = 2.0_wp*x - one
  end subroutine fill_random

  !> The projection is a handful of operations: each result is off by at most 8 eps |tau|.
  subroutine test_projection(d)
    integer, intent(in) :: d
    real(wp), dimension(d) :: a, b, pa, pb, again, rest
    real(wp) :: mu, slack
    integer :: k, status, wrong(5)
    wrong = 0
    do k = 1, 20000
      mu = friction(1 + mod(k, 4))
      call fill_random(a)
      call fill_random(b)
      call project_on_cone(mu, a, pa, status)
      call project_on_cone(mu, b, pb, status)
      call project_on_cone(mu, pa, again, status)
      slack = 8.0_wp*eps*(norm2(a) + norm2(b))
      rest = a - pa
      if (norm2(again - pa) > slack) wrong(1) = wrong(1) + 1
      if (norm2(pa - pb) > norm2(a - b) + slack) wrong(2) = wrong(2) + 1
      if (norm2(pa(2:)) > mu*pa(1) + slack) wrong(3) = wrong(3) + 1
      if (rest(1) + mu*norm2(rest(2:)) > slack) wrong(4) = wrong(4) + 1
      if (abs(dot_product(pa, rest)) > slack*norm2(a)) wrong(4) = wrong(4) + 1
      a(1) = -mu*norm2(a(2:))*(one + 4.0_wp*eps) - tiny(one)
      call project_on_cone(mu, a, pa, status)
      if (any(abs(pa) > zero) .or. status /= contact_open) wrong(5) = wrong(5) + 1
    end do
    call check_equal(wrong(1), 0, 'projections are idempotent')
    call check_equal(wrong(2), 0, 'projections are nonexpansive')
    call check_equal(wrong(3), 0, 'projections lie in the cone')
    call check_equal(wrong(4), 0, 'Moreau: the rest is polar and orthogonal')
    call check_equal(wrong(5), 0, 'the polar cone goes to zero')
  end subroutine test_projection

  !> W = Q diag Q' with eigenvalues spread evenly in the logarithm from 1/cond to 1.
  subroutine make_w(n, condition, w)
    integer, intent(in) :: n
    real(wp), intent(in) :: condition
    real(wp), intent(out) :: w(n, n)
    real(wp) :: q(n, n), lambda
    integer :: i, j, pass
    do j = 1, n
      call fill_random(q(:, j))
      do pass = 1, 2
        do i = 1, j - 1
          q(:, j) = q(:, j) - dot_product(q(:, i), q(:, j))*q(:, i)
        end do
      end do
      q(:, j) = q(:, j)/norm2(q(:, j))
    end do
    w = zero
    do j = 1, n
      lambda = condition**(-real(j - 1, wp)/real(max(1, n - 1), wp))
      do i = 1, n
        w(:, i) = w(:, i) + lambda*q(:, j)*q(i, j)
      end do
    end do
    w = 0.5_wp*(w + transpose(w))
  end subroutine make_w

  !> The solver on a dense W.
  subroutine solve(options, w, q, mu, r, work, certificate, status)
    type(cone_options_t), intent(in) :: options
    real(wp), intent(in) :: w(:, :), q(:, :), mu(:)
    real(wp), intent(inout) :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(out) :: certificate
    type(status_t), intent(inout) :: status
    type(delassus_dense_t) :: dense
    call dense%resize(size(q, 1), size(q, 2))
    dense%matrix = w
    call solve_cone(options, dense, q, mu, r, work, certificate, status)
  end subroutine solve

  pure real(wp) function mean_diagonal(w)
    real(wp), intent(in) :: w(:, :)
    integer :: i
    mean_diagonal = sum([(w(i, i), i=1, size(w, 1))])/size(w, 1)
  end function mean_diagonal

  subroutine test_solutions(d)
    integer, intent(in) :: d
    integer :: n, m, c
    real(wp) :: w(40, 40), q(d, 20), condition
    do n = 1, 20
      do c = 0, 4
        condition = 10.0_wp**c
        call make_w(d*n, condition, w(:d*n, :d*n))
        do m = 1, n
          call fill_random(q(:, m))
        end do
        q(1, 1) = -0.5_wp
        do m = 1, merge(1, 4, d == 1)
          call check_solution(d, n, w(:d*n, :d*n), q(:, :n), friction(m), condition)
        end do
      end do
    end do
  end subroutine test_solutions

  subroutine check_solution(d, n, w, q, mu_1, condition)
    integer, intent(in) :: d, n
    real(wp), intent(in) :: w(:, :), q(:, :), mu_1, condition
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: r(d, n), mu(n)
    mu = mu_1
    r = zero
    call solve(options, w, q, mu, r, work, certificate, status)
    call check_true(.not. failed(status), 'the solver converges')
    call check_true(certificate%met .and. certificate%error <= options%tolerance &
        .and. certificate%eta <= options%tolerance, 'the certificate is met')
    call check_law(w, q, mu, r, options%tolerance)
    call check_warm_start(w, q, mu, r, condition)
  end subroutine check_solution

  !> Friction far beyond mu |W_nt| = W_nn, where sweeps go in circles: a solution exists for
  !> every positive definite W, and complementary pivoting finds one. u_n may miss zero by the
  !> certificate's own bound.
  subroutine test_wedging()
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: w(24, 24), q(2, 12), r(2, 12), mu(12), u(24), size_u
    integer :: n, c, k, rescued, unmet, wrong
    rescued = 0
    unmet = 0
    wrong = 0
    do n = 1, 12
      do c = 0, 3
        call make_w(2*n, 10.0_wp**c, w(:2*n, :2*n))
        do k = 1, n
          call fill_random(q(:, k))
        end do
        q(1, 1) = -0.5_wp
        do k = 1, 4
          mu = 10.0_wp**k
          r = zero
          status = status_t()
          call solve(options, w(:2*n, :2*n), q(:, :n), mu(:n), r(:, :n), work, &
              certificate, status)
          if (failed(status) .or. .not. certificate%met) unmet = unmet + 1
          rescued = rescued + certificate%pivotings
          u(:2*n) = matmul(w(:2*n, :2*n), reshape(r(:, :n), [2*n])) &
              + reshape(q(:, :n), [2*n])
          size_u = max(norm2(q(:, :n)), norm2(u(:2*n)), &
              norm2(r(:, :n))*mean_diagonal(w(:2*n, :2*n)))
          if (any(u(1:2*n:2) < -10.0_wp*options%tolerance*size_u)) wrong = wrong + 1
          if (any(abs(r(2, :n)) > (one + 8.0_wp*eps)*mu(:n)*r(1, :n))) wrong = wrong + 1
        end do
      end do
    end do
    call check_equal(unmet, 0, 'wedging: every certificate is met')
    call check_equal(wrong, 0, 'wedging: cones and gaps')
    call check_true(rescued > 0, 'wedging: some need complementary pivoting')
  end subroutine test_wedging

  !> Signs of the law. With delta the misfit of the natural map, the dual cone is left by at
  !> most m delta, so u_n >= -(1 + mu) m delta; and with r in its cone e >= r_n u_n follows.
  subroutine check_law(w, q, mu, r, tolerance)
    real(wp), intent(in) :: w(:, :), q(:, :), mu(:), r(:, :), tolerance
    real(wp) :: u(size(q, 1), size(q, 2)), m, delta, slack, size_u
    integer :: a, wrong(3)
    wrong = 0
    m = mean_diagonal(w)
    u = reshape(matmul(w, reshape(r, [size(r)])), shape(q)) + q
    size_u = max(norm2(q), norm2(u))
    ! u is a sum of size(q) products of entries at most 1, whatever the order of summation.
    slack = 2.0_wp*size(q)*eps*(norm2(q) + norm2(r))
    delta = tolerance*max(norm2(r), size_u/m)
    do a = 1, size(mu)
      if (r(1, a) < zero) wrong(1) = wrong(1) + 1
      if (norm2(r(2:, a)) > (one + 8.0_wp*eps)*mu(a)*r(1, a)) wrong(1) = wrong(1) + 1
      if (u(1, a) < -(one + mu(a))*m*delta - slack) wrong(2) = wrong(2) + 1
      if (bipotential_residual(mu(a), r(:, a), u(:, a)) < r(1, a)*min(zero, u(1, a)) &
          - 16.0_wp*eps*r(1, a)*size_u) wrong(3) = wrong(3) + 1
    end do
    call check_equal(wrong(1), 0, 'reactions lie in their cones')
    call check_equal(wrong(2), 0, 'nothing penetrates')
    call check_equal(wrong(3), 0, 'the bi-potential residual is not negative')
  end subroutine check_law

  !> Started from its answer the solver keeps it. Without friction the answer is unique, and any
  !> start leads to it: |r - r*| <= (m + |W|)/lmin of each misfit (Cottle, Pang & Stone 1992).
  subroutine check_warm_start(w, q, mu, r, condition)
    real(wp), intent(in) :: w(:, :), q(:, :), mu(:), r(:, :), condition
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: start(size(r, 1), size(r, 2)), bound
    integer :: a
    bound = 4.0_wp*condition*options%tolerance*max(norm2(r), norm2(q)/mean_diagonal(w))
    start = r
    call solve(options, w, q, mu, start, work, certificate, status)
    call check_close(norm2(start - r), zero, bound, 'warm start from the answer')
    if (any(mu > zero)) return
    do a = 1, size(mu)
      call fill_random(start(:, a))
      start(1, a) = abs(start(1, a))
      start(2:, a) = zero
    end do
    call solve(options, w, q, mu, start, work, certificate, status)
    call check_close(norm2(start - r), zero, bound, 'warm start from anywhere')
    options%warm_start = .false.
    start = one
    call solve(options, w, q, mu, start, work, certificate, status)
    call check_close(norm2(start - r), zero, bound, 'cold start')
  end subroutine check_warm_start

  !> mu = 0 against the linear complementarity problem of the normal rows, solved by trying all
  !> sets of active contacts.
  subroutine test_complementarity(d)
    integer, intent(in) :: d
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: w(8, 8), q(d, 4), r(d, 4), exact(4), mu(4), bound
    integer :: n, trial, a
    mu = zero
    do trial = 1, 200
      n = 1 + mod(trial, 4)
      call make_w(d*n, 100.0_wp, w(:d*n, :d*n))
      do a = 1, n
        call fill_random(q(:, a))
      end do
      r = zero
      call solve(options, w(:d*n, :d*n), q(:, :n), mu(:n), r(:, :n), work, &
          certificate, status)
      call enumerate(n, w(1:d*n:d, 1:d*n:d), q(1, :n), exact)
      ! Error bound of the problem, as for the warm starts.
      bound = 4.0_wp*100.0_wp*options%tolerance*max(norm2(exact(:n)), &
          norm2(q(:, :n)) /mean_diagonal(w(:d*n, :d*n)))
      call check_close(norm2(r(1, :n) - exact(:n)), zero, bound, 'reactions of the LCP')
      call check_true(.not. any(abs(r(2:, :n)) > zero), 'no friction without mu')
    end do
  end subroutine test_complementarity

  subroutine enumerate(n, w, q, exact)
    integer, intent(in) :: n
    real(wp), intent(in) :: w(:, :), q(:)
    real(wp), intent(out) :: exact(:)
    real(wp) :: a(n, n), x(n), right(n, 1)
    integer :: code, k, pivot(n), solutions
    logical :: active(n), ok
    solutions = 0
    do code = 0, 2**n - 1
      active = [(btest(code, k - 1), k=1, n)]
      a = w
      x = -q
      do k = 1, n
        if (active(k)) cycle
        a(:, k) = zero
        a(k, :) = zero
        a(k, k) = one
        x(k) = zero
      end do
      right(:, 1) = x
      call solve_general(n, a, right, pivot, ok)
      x = right(:, 1)
      ! Solved to about cond eps; random data do not sit nearer to a change of status.
      if (any(x < -1.0e-12_wp) .or. any(matmul(w, x) + q < -1.0e-12_wp)) cycle
      solutions = solutions + 1
      exact(:n) = x
    end do
    call check_equal(solutions, 1, 'one solution of the LCP')
  end subroutine enumerate

  subroutine test_open()
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: w(6, 6), q(2, 3), r(2, 3), mu(3)
    call make_w(6, 10.0_wp, w)
    q = reshape([zero, -one, 0.5_wp, one, tiny(one), zero], [2, 3])
    r = one
    mu = 0.3_wp
    call solve(options, w, q, mu, r, work, certificate, status)
    call check_true(.not. (failed(status) .or. any(abs(r) > zero)), 'q_n >= 0: r = 0 exactly')
    call check_true(.not. any(abs(work%u - q) > zero), 'then u = q exactly')
    call check_true(certificate%met .and. certificate%sweeps == 0, 'and no sweep is spent')
    call check_true(all(work%status == contact_open), 'and all contacts are open')
  end subroutine test_open

  subroutine test_failure()
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: w(10, 10), q(2, 5), r(2, 5), mu(5)
    call make_w(10, 1000.0_wp, w)
    q = -one
    r = zero
    mu = 0.3_wp
    options%solver = solver_gs
    options%max_sweeps = 1
    call solve(options, w, q, mu, r, work, certificate, status)
    call check_true(failed(status) .and. .not. certificate%met, 'one sweep is not enough')
    if (.not. failed(status)) return
    call check_true(index(status%message, 'did not converge in 1 sweeps') > 0, 'it is told')
    call check_equal(certificate%active_set_solves, 0, 'GS solves nothing directly')
  end subroutine test_failure

  !> Nearest point of the cone among the vector itself, the two edges in the plane of its
  !> tangential part, and the apex.
  subroutine nearest_in_cone(mu, tau, p)
    real(wp), intent(in) :: mu, tau(:)
    real(wp), intent(out) :: p(:)
    real(wp) :: t, edge(2), factor, direction(size(tau) - 1)
    t = norm2(tau(2:))
    p = tau
    if (t <= mu*tau(1)) return
    direction = zero
    if (t > zero) direction = tau(2:)/t
    edge = [one, mu]
    factor = max(zero, (tau(1)*edge(1) + t*edge(2))/(one + mu**2))
    p(1) = factor
    p(2:) = factor*mu*direction
  end subroutine nearest_in_cone

  subroutine test_certificate()
    integer, parameter :: n = 6
    type(certificate_t) :: c
    real(wp) :: q(2, n), r(2, n), u(2, n), mu(n), m, tau(2), p(2), map, map1, e, scale
    integer :: a, trial, s
    do trial = 1, 200
      do a = 1, n
        call fill_random(q(:, a))
        call fill_random(r(:, a))
        call fill_random(u(:, a))
        r(1, a) = abs(r(1, a))
        mu(a) = friction(1 + mod(a + trial, 4))
      end do
      m = 10.0_wp**(mod(trial, 7) - 3)
      map = zero
      map1 = zero
      e = zero
      do a = 1, n
        e = e + abs(mu(a)*r(1, a)*abs(u(2, a)) + r(2, a)*u(2, a) + r(1, a)*u(1, a))
        do s = 1, 2
          tau = r(:, a) - [u(1, a) + mu(a)*abs(u(2, a)), u(2, a)]/merge(m, one, s == 1)
          call nearest_in_cone(mu(a), tau, p)
          if (s == 1) map = map + sum((r(:, a) - p)**2)
          if (s == 2) map1 = map1 + sum((r(:, a) - p)**2)
        end do
      end do
      call certify(m, mu, q, r, u, 1.0e-10_wp, c)
      scale = max(norm2(r), norm2(q)/m, norm2(u)/m)
      ! Each is a sum of 2n squares of numbers known to a few eps of the largest one.
      call check_close(c%error, sqrt(map)/scale, 64.0_wp*eps, 'error')
      call check_close(c%error2018, sqrt(map1)/norm2(q), 64.0_wp*eps, 'error2018', &
          scale=one + (norm2(r) + norm2(u))/norm2(q))
      call check_close(c%eta, e/(norm2(r)*max(norm2(u), norm2(q))), 64.0_wp*eps, 'eta')
      call check_true(.not. c%met, 'random numbers meet no certificate')
    end do
    call certify(m, mu, abs(q), zero*r, q, 1.0e-10_wp, c)
    call check_true(.not. (c%error > zero .or. c%eta > zero), 'no reaction, no error')
  end subroutine test_certificate

end program test_cone
