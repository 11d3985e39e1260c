! SPDX-License-Identifier: BSD-3-Clause
!> Every linear solver of the registry against dense LAPACK, for every order, with and without
!> a contact block.
program test_linalg
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, failed
  use check, only: test_start, test_end, check_true, check_close, check_equal, seed_random
  use linalg_dense, only: solve_general
  use linalg_graph, only: graph_t, block_matrix_t, graph_from_cliques, scalar_product
  use linalg_order, only: order_names
  use linalg_registry, only: make_solver, engine_names
  use linalg_solver, only: solver_t, solver_options_t, solve_whole
  implicit none
  character(8), parameter :: orders(4) = [character(8) :: order_names, 'AUTO']
  character(8), allocatable :: engines(:)
  type(graph_t) :: graph
  type(block_matrix_t) :: matrix
  real(wp), allocatable :: whole(:, :), diagonal(:, :), dense(:, :)
  integer :: e, o, k

  call test_start('linalg')
  call seed_random(1234)
  call make_grid(7, 5, graph)
  call fill_matrix()
  call engine_names(engines)
  call check_true(size(engines) > 1, 'there are engines')
  do e = 1, size(engines)
    do o = 1, size(orders)
      call test_solver(trim(engines(e)), trim(orders(o)), [integer ::])
      call test_solver(trim(engines(e)), trim(orders(o)), [33, 4, 18, 12])
      call test_solver(trim(engines(e)), trim(orders(o)), [(k, k=1, graph%n)])
    end do
    call test_lost_pivot(trim(engines(e)))
  end do
  call test_unknown_names()
  call test_scalar_product()
  deallocate (whole, diagonal, dense, engines)
  call test_end()

contains

  !> Graph of a grid of quadrilaterals.
  subroutine make_grid(nx, ny, graph)
    integer, intent(in) :: nx, ny
    type(graph_t), intent(out) :: graph
    integer :: i, j, first((nx - 1)*(ny - 1) + 1), member(4*(nx - 1)*(ny - 1)), n
    n = 0
    do j = 1, ny - 1
      do i = 1, nx - 1
        member(4*n + 1:4*n + 4) = [i + nx*(j - 1), i + 1 + nx*(j - 1), i + 1 + nx*j, i + nx*j]
        n = n + 1
      end do
    end do
    first = [(4*i + 1, i=0, n)]
    call graph_from_cliques(nx*ny, first, member, graph)
  end subroutine make_grid

  !> A random symmetric matrix on the graph, its diagonal large enough to be positive definite;
  !> and that diagonal alone.
  subroutine fill_matrix()
    integer :: i, k, m
    real(wp) :: block(2, 2)
    allocate (matrix%value(2, 2, size(graph%column)), whole(2*graph%n, 2*graph%n))
    allocate (matrix%diagonal(2, graph%n), diagonal(2*graph%n, 2*graph%n))
    whole = zero
    diagonal = zero
    do i = 1, graph%n
      do k = graph%first(i), graph%first(i + 1) - 1
        m = graph%column(k)
        if (m > i) cycle
        call random_number(block)
        block = block - 0.5_wp
        if (m == i) block = 0.5_wp*(block + transpose(block)) &
            + reshape([12.0_wp, zero, zero, 9.0_wp], [2, 2])
        matrix%value(:, :, k) = block
        matrix%value(:, :, graph%position(m, i)) = transpose(block)
        whole(2*i - 1:2*i, 2*m - 1:2*m) = block
        whole(2*m - 1:2*m, 2*i - 1:2*i) = transpose(block)
      end do
    end do
    do i = 1, 2*graph%n
      diagonal(i, i) = whole(i, i)
      matrix%diagonal(2 - mod(i, 2), (i + 1)/2) = whole(i, i)
    end do
  end subroutine fill_matrix

  !> The condition of the matrix is below 10, its size 70: 1e-13 leaves a factor of ten.
  subroutine test_solver(engine, order, last)
    character(*), intent(in) :: engine, order
    integer, intent(in) :: last(:)
    class(solver_t), allocatable :: solver
    type(status_t) :: status
    real(wp) :: b(2, graph%n), x(2, graph%n), exact(2*graph%n), f(2*size(last), 2*size(last))
    real(wp) :: unit(2, graph%n)
    integer :: k
    call make_solver(solver_options_t(engine=engine, order=order), solver, status)
    call solver%analyse(graph, last, status)
    call solver%factor(graph, matrix, status)
    call check_true(.not. failed(status), engine//' '//order//' factors')
    dense = whole
    if (solver%takes_diagonal) dense = diagonal
    if (allocated(solver%order)) call check_true(is_permutation(solver%order, last), engine// &
        ' '//order//' orders all nodes')
    call random_number(b)
    call dense_solution(b, exact)
    call solve_whole(solver, b, x)
    call check_close(maxval(abs(reshape(x, [2*graph%n]) - exact)), zero, 1.0e-13_wp, engine// &
        ' '//order//' solves')
    if (size(last) == 0) return
    call solver%flexibility(f)
    do k = 1, size(last)
      unit = zero
      unit(1, last(k)) = one
      call dense_solution(unit, exact)
      x = reshape(exact, [2, graph%n])
      call check_close(maxval(abs(f(:, 2*k - 1) - reshape(x(:, last), [2*size(last)]))), zero, &
          1.0e-13_wp, engine//' '//order//' flexibility')
    end do
    call check_true(.not. any(abs(f - transpose(f)) > zero), 'the flexibility is symmetric')
  end subroutine test_solver

  subroutine dense_solution(b, x)
    real(wp), intent(in) :: b(:, :)
    real(wp), intent(out) :: x(:)
    real(wp) :: copy(size(x), size(x)), right(size(x), 1)
    integer :: pivot(size(x))
    logical :: ok
    copy = dense
    right = reshape(b, [size(x), 1])
    call solve_general(size(x), copy, right, pivot, ok)
    x = right(:, 1)
    call check_true(ok, 'the dense solver accepts the matrix')
  end subroutine dense_solution

  logical function is_permutation(order, last)
    integer, intent(in) :: order(:), last(:)
    integer :: seen(size(order)), k
    seen = 0
    do k = 1, size(order)
      seen(order(k)) = seen(order(k)) + 1
    end do
    is_permutation = all(seen == 1) .and. all(order(size(order) - size(last) + 1:) == last)
  end function is_permutation

  !> An indefinite matrix is refused with the word pivot, in the body and in the block.
  subroutine test_lost_pivot(engine)
    character(*), intent(in) :: engine
    class(solver_t), allocatable :: solver
    type(block_matrix_t) :: bad
    type(status_t) :: status
    integer :: k
    bad = matrix
    bad%value(1, 1, graph%position(9, 9)) = -50.0_wp
    bad%diagonal(1, 9) = -50.0_wp
    do k = 0, 1
      status = status_t()
      call make_solver(solver_options_t(engine=engine), solver, status)
      call solver%analyse(graph, pack([9], [k == 1]), status)
      call solver%factor(graph, bad, status)
      call check_true(failed(status), engine//' refuses an indefinite matrix')
      if (failed(status)) call check_true(index(status%message, 'pivot') > 0, status%message)
    end do
  end subroutine test_lost_pivot

  subroutine test_unknown_names()
    class(solver_t), allocatable :: solver
    type(status_t) :: status
    call make_solver(solver_options_t(engine='MAGIC'), solver, status)
    call check_true(failed(status), 'an unknown engine is refused')
    status = status_t()
    call make_solver(solver_options_t(order='MAGIC'), solver, status)
    call solver%analyse(graph, [integer ::], status)
    call check_true(failed(status), 'an unknown order is refused')
  end subroutine test_unknown_names

  subroutine test_scalar_product()
    real(wp) :: s(size(graph%column)), x(2, graph%n), y(2, graph%n), z(2, graph%n)
    integer :: i, k
    call random_number(s)
    call random_number(x)
    y = one
    z = one
    call scalar_product(graph%n, graph%first, graph%column, s, 2.0_wp, x, y)
    do i = 1, graph%n
      do k = graph%first(i), graph%first(i + 1) - 1
        z(:, i) = z(:, i) + 2.0_wp*s(k)*x(:, graph%column(k))
      end do
    end do
    call check_close(maxval(abs(y - z)), zero, 1.0e-14_wp, 'product with a scalar matrix')
    call check_equal(size(graph%column), 7*5 + 2*(6*5 + 7*4 + 2*6*4), 'entries of a grid graph')
  end subroutine test_scalar_product

end program test_linalg
