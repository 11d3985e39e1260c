! SPDX-License-Identifier: BSD-3-Clause
!> The rule of AUTO: what it measures, and by counts, on packings of rigid bodies, that it does
!> not cost much more than the best of the single solvers. The sparse factor of a Newton step.
program test_cone_strategy
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, failed
  use base_strings, only: to_text
  use check, only: test_start, test_end, check_true, check_close, check_equal, seed_random
  use cone_blocks, only: delassus_blocks_t, dense_of_blocks
  use cone_solver, only: solve_cone
  use cone_strategy, only: strategy_t, products_left
  use cone_types, only: cone_options_t, cone_work_t, certificate_t, solver_auto, &
      solver_newton, solver_anderson, solver_nesterov
  use linalg_fronts, only: fronts_t, plan_fronts, factor_fronts, solve_fronts
  use linalg_graph, only: graph_t, graph_from_cliques
  use packed_contacts, only: packing_t, make_packing, packing_kinds
  implicit none

  call test_start('cone_strategy')
  call seed_random(4711)
  call test_fronts(2, 7)
  call test_fronts(3, 12)
  call test_singular()
  call test_left()
  call test_packings(1.0e-4_wp, 18, 14)
  call test_packings(1.0e-8_wp, 4, 3)
  call test_end()

contains

  !> The graph of a square of n x n nodes, cliques of four.
  subroutine make_square(n, graph)
    integer, intent(in) :: n
    type(graph_t), intent(out) :: graph
    integer :: first((n - 1)**2 + 1), member(4*(n - 1)**2), i, j, k
    k = 0
    do j = 1, n - 1
      do i = 1, n - 1
        first(k + 1) = 4*k + 1
        member(4*k + 1:4*k + 4) = n*(j - 1) + i + [0, 1, n, n + 1]
        k = k + 1
      end do
    end do
    first(k + 1) = 4*k + 1
    call graph_from_cliques(n*n, first, member, graph)
  end subroutine make_square

  !> An unsymmetric matrix with a heavy diagonal on that graph: A x for a known x, and back.
  subroutine test_fronts(d, n)
    integer, intent(in) :: d, n
    type(graph_t) :: graph
    type(fronts_t) :: fronts
    integer, allocatable :: row(:)
    real(wp), allocatable :: value(:, :, :)
    real(wp) :: x(d, n*n), b(d, n*n)
    logical :: ok
    integer :: a, k
    call make_square(n, graph)
    allocate (row(size(graph%column)), value(d, d, size(graph%column)))
    call random_number(value)
    call random_number(x)
    b = zero
    do a = 1, graph%n
      do k = graph%first(a), graph%first(a + 1) - 1
        row(k) = a
        if (graph%column(k) == a) value(:, :, k) = value(:, :, k) + diagonal(d, 10.0_wp*d)
        b(:, a) = b(:, a) + matmul(value(:, :, k), x(:, graph%column(k)))
      end do
    end do
    call plan_fronts(graph, d, fronts)
    call factor_fronts(fronts, row, graph%column, value, ok)
    call check_true(ok, 'a factor of '//to_text(d*n*n)//' unknowns')
    call solve_fronts(fronts, b)
    call check_close(maxval(abs(b - x)), zero, 1.0e-13_wp, 'x from A x by fronts')
    call check_true(fronts%numbers < real(d*n*n, wp)**2, 'fewer numbers than a dense one')
  end subroutine test_fronts

  pure function diagonal(d, x) result(block)
    integer, intent(in) :: d
    real(wp), intent(in) :: x
    real(wp) :: block(d, d)
    integer :: k
    block = zero
    do k = 1, d
      block(k, k) = x
    end do
  end function diagonal

  !> A matrix of zeros is told.
  subroutine test_singular()
    type(graph_t) :: graph
    type(fronts_t) :: fronts
    logical :: ok
    call make_square(2, graph)
    call plan_fronts(graph, 1, fronts)
    call factor_fronts(fronts, [1, 2], [1, 2], reshape([one, zero], [1, 1, 2]), ok)
    call check_true(.not. ok, 'a singular matrix is told')
  end subroutine test_singular

  !> A decade in 100 products: two more take 200; no progress is never done.
  subroutine test_left()
    type(strategy_t) :: strategy
    strategy%from = 100.0_wp
    strategy%from_misfit = 1.0e-2_wp
    call check_close(products_left(1.0e-5_wp, 1.0e-3_wp, 200.0_wp, strategy), 200.0_wp, &
        1.0e-10_wp, 'two decades at the rate of one')
    call check_true(products_left(1.0e-5_wp, 1.0e-2_wp, 200.0_wp, strategy) > 1.0e300_wp, &
        'no progress')
  end subroutine test_left

  !> Of some packings AUTO solves what a single solver solves. Its products are at most three
  !> times the fewest, and 1.5 times in enough of them, where fewer than 800 are equal: a
  !> product with 30 to 80 contacts takes 2 to 10 microseconds, and 4 ms are nothing.
  subroutine test_packings(tolerance, packings, enough)
    real(wp), intent(in) :: tolerance
    integer, intent(in) :: packings, enough
    real(wp), parameter :: equal = 800.0_wp
    integer, parameter :: singles(3) = [solver_newton, solver_anderson, solver_nesterov]
    type(packing_t) :: packing
    type(delassus_blocks_t) :: w
    real(wp), allocatable :: q(:, :), mu(:)
    real(wp) :: own, best, other
    integer :: k, i, near, far
    near = 0
    far = 0
    do k = 1, packings
      packing%kind = packing_kinds(1 + mod(k, 3))
      packing%d = merge(2, 3, mod(k/3, 3) == 2)
      packing%seed = k
      packing%bodies = merge(30, 15, packing%kind == 'BALLS')
      packing%mu = 0.1_wp + 0.05_wp*k
      packing%motion = real(mod(k, 2), wp)
      call make_packing(packing, w, q, mu)
      if (k <= 3) call check_packing(packing, w)
      own = products(solver_auto, tolerance, w, q, mu)
      best = huge(best)
      do i = 1, size(singles)
        other = products(singles(i), tolerance, w, q, mu)
        best = min(best, other)
      end do
      if (own > 3.0_wp*max(equal, best)) far = far + 1
      if (own <= 1.5_wp*max(equal, best)) near = near + 1
    end do
    call check_equal(far, 0, 'AUTO beyond three times the best')
    call check_true(near >= enough, 'AUTO within 1.5 times the best in '//to_text(near))
  end subroutine test_packings

  !> W is symmetric, and the same seed gives it again.
  subroutine check_packing(packing, w)
    type(packing_t), intent(in) :: packing
    type(delassus_blocks_t), intent(in) :: w
    type(delassus_blocks_t) :: again
    real(wp), allocatable :: dense(:, :), q(:, :), mu(:)
    call make_packing(packing, again, q, mu)
    allocate (dense(w%d*w%contacts, w%d*w%contacts))
    call dense_of_blocks(w, dense)
    call check_true(w%contacts > 10, packing%kind//' has contacts')
    call check_true(maxval(abs(dense - transpose(dense))) <= 1.0e-13_wp*maxval(abs(dense)), &
        'W is symmetric')
    call check_true(.not. any(abs(again%block - w%block) > zero), 'the same seed, the same W')
  end subroutine check_packing

  !> Products of a solve, huge without an answer.
  real(wp) function products(solver, tolerance, w, q, mu)
    integer, intent(in) :: solver
    real(wp), intent(in) :: tolerance
    type(delassus_blocks_t), intent(in) :: w
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: r(size(q, 1), size(q, 2))
    options%solver = solver
    options%tolerance = tolerance
    options%max_sweeps = 5000
    r = zero
    call solve_cone(options, w, q, mu, r, work, certificate, status)
    products = merge(huge(products), certificate%products, failed(status))
  end function products

end program test_cone_strategy
