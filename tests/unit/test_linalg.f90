! SPDX-License-Identifier: BSD-3-Clause
!> Every linear solver of the registry against dense LAPACK, with two and three unknowns of each
!> node, for every order, with and without a contact block, on a grid and on random graphs.
program test_linalg
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, failed
  use base_strings, only: to_text
  use check, only: test_start, test_end, check_true, check_close, check_equal, seed_random
  use linalg_dense, only: solve_general
  use linalg_graph, only: graph_t, block_matrix_t, graph_from_cliques, scalar_product, &
      scalar_products, scalar_rows
  use linalg_ldlt, only: ldlt_t
  use linalg_order, only: order_names
  use linalg_registry, only: make_solver, engine_names
  use linalg_solver, only: solver_t, solver_options_t, solve_whole, name_length
  implicit none
  character(name_length), parameter :: orders(4) = [character(name_length) :: &
      order_names, 'AUTO']
  character(name_length), allocatable :: engines(:)
  type(graph_t) :: graph
  type(block_matrix_t) :: matrix
  real(wp), allocatable :: whole(:, :), diagonal(:, :), dense(:, :)
  integer :: d, e, k, o

  call test_start('linalg')
  call seed_random(1234)
  call engine_names(engines)
  call check_true(size(engines) > 1, 'there are engines')
  do d = 2, 3
    call make_grid(7, 5, graph)
    call check_equal(size(graph%column), 7*5 + 2*(6*5 + 7*4 + 2*6*4), 'entries of a grid graph')
    call fill_matrix()
    do e = 1, size(engines)
      do o = 1, size(orders)
        call test_solver(trim(engines(e)), trim(orders(o)), [integer ::])
        call test_solver(trim(engines(e)), trim(orders(o)), [33, 4, 18, 12])
        call test_solver(trim(engines(e)), trim(orders(o)), [(k, k=1, graph%n)])
      end do
      call test_lost_pivot(trim(engines(e)), d)
      call test_units(trim(engines(e)))
    end do
    call test_scalar_product()
    do k = 1, 60
      call make_random_graph(k, graph)
      call fill_matrix()
      do e = 1, size(engines)
        call test_solver(trim(engines(e)), 'AUTO', some_nodes(k))
      end do
      call test_null_pivots()
    end do
    call graph_from_cliques(90, [1, 91], [(k, k=1, 90)], graph)
    call fill_matrix()
    do e = 1, size(engines)
      call test_solver(trim(engines(e)), 'NATURAL', [integer ::])
      call test_solver(trim(engines(e)), 'NATURAL', [(k, k=20, 90)])
    end do
  end do
  call test_unknown_names()
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

  !> n nodes in about as many cliques of three: several components, nodes of their own.
  subroutine make_random_graph(n, graph)
    integer, intent(in) :: n
    type(graph_t), intent(out) :: graph
    integer :: i, first(n + 1), member(3*n)
    real(wp) :: draw(3*n)
    call random_number(draw)
    member = 1 + int(n*draw)
    first = [(3*i + 1, i=0, n)]
    call graph_from_cliques(n, first, member, graph)
  end subroutine make_random_graph

  !> None, all, or any of n nodes in any order.
  function some_nodes(n) result(last)
    integer, intent(in) :: n
    integer, allocatable :: last(:)
    integer :: i, j
    real(wp) :: draw
    last = [(i, i=1, n)]
    do i = 1, n
      call random_number(draw)
      j = i + int((n - i + 1)*draw)
      last([i, j]) = last([j, i])
    end do
    call random_number(draw)
    last = last(:min(n, max(0, int((1.4_wp*draw - 0.2_wp)*n))))
  end function some_nodes

  !> A random symmetric matrix on the graph, diagonally dominant and so positive definite; and
  !> its diagonal alone.
  subroutine fill_matrix()
    integer :: i, k, m, c
    real(wp) :: block(d, d)
    if (allocated(whole)) deallocate (matrix%value, matrix%diagonal, whole, diagonal)
    allocate (matrix%value(d, d, size(graph%column)), whole(d*graph%n, d*graph%n))
    allocate (matrix%diagonal(d, graph%n), diagonal(d*graph%n, d*graph%n))
    whole = zero
    diagonal = zero
    do i = 1, graph%n
      do k = graph%first(i), graph%first(i + 1) - 1
        m = graph%column(k)
        if (m > i) cycle
        call random_number(block)
        block = block - 0.5_wp
        if (m == i) then
          block = 0.5_wp*(block + transpose(block))
          do c = 1, d
            block(c, c) = block(c, c) + 0.5_wp*d*(graph%first(i + 1) - graph%first(i)) + c
          end do
        end if
        matrix%value(:, :, k) = block
        matrix%value(:, :, graph%position(m, i)) = transpose(block)
        whole(d*(i - 1) + 1:d*i, d*(m - 1) + 1:d*m) = block
        whole(d*(m - 1) + 1:d*m, d*(i - 1) + 1:d*i) = transpose(block)
      end do
    end do
    do i = 1, d*graph%n
      diagonal(i, i) = whole(i, i)
    end do
    matrix%diagonal = reshape([(whole(i, i), i=1, d*graph%n)], [d, graph%n])
  end subroutine fill_matrix

  !> Rows of at most 270 dofs (a clique of 90 nodes: panels of more than one tile), the sum of
  !> their moduli outside the diagonal below it: the inverse is below 1, and 1e-13 leaves a
  !> factor above 400 of round-off. Some columns of the flexibility are compared, whole.
  subroutine test_solver(engine, order, last)
    character(*), intent(in) :: engine, order
    integer, intent(in) :: last(:)
    class(solver_t), allocatable :: solver
    type(status_t) :: status
    character(:), allocatable :: name
    real(wp) :: b(d, graph%n), x(d, graph%n), exact(d*graph%n), f(d*size(last), d*size(last))
    real(wp) :: unit(d, graph%n)
    integer :: k, i
    name = engine//' '//order//', d = '//to_text(d)//','
    call make_solver(solver_options_t(engine=engine, order=order, tolerance=1.0e-15_wp), &
        solver, status)
    call solver%analyse(graph, d, last, status)
    call solver%factor(graph, matrix, status)
    call check_true(.not. failed(status), name//' factors')
    dense = whole
    if (solver%takes_diagonal) dense = diagonal
    if (allocated(solver%order)) call check_true(is_permutation(solver%order, last), name// &
        ' orders all nodes')
    call random_number(b)
    call dense_solution(b, exact)
    call solve_whole(solver, b, x)
    call check_close(maxval(abs(reshape(x, [d*graph%n]) - exact)), zero, 1.0e-13_wp, name// &
        ' solves')
    if (size(last) == 0) return
    call solver%flexibility(f)
    do k = 1, size(last), 1 + size(last)/8
      i = 1 + mod(k, d)
      unit = zero
      unit(i, last(k)) = one
      call dense_solution(unit, exact)
      x = reshape(exact, [d, graph%n])
      call check_close(maxval(abs(f(:, d*(k - 1) + i) - reshape(x(:, last), [d*size(last)]))), &
          zero, 1.0e-13_wp, name//' flexibility')
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

  !> An indefinite matrix is refused with the word pivot, in the body with the node too, and in
  !> the block. i: the direction that is wrong.
  subroutine test_lost_pivot(engine, i)
    character(*), intent(in) :: engine
    integer, intent(in) :: i
    class(solver_t), allocatable :: solver
    type(block_matrix_t) :: bad
    type(status_t) :: status
    integer :: k
    bad = matrix
    bad%value(i, i, graph%position(9, 9)) = -50.0_wp
    bad%diagonal(i, 9) = -50.0_wp
    do k = 0, 1
      status = status_t()
      call make_solver(solver_options_t(engine=engine), solver, status)
      call solver%analyse(graph, d, pack([9], [k == 1]), status)
      call solver%factor(graph, bad, status)
      call check_true(failed(status), engine//' refuses an indefinite matrix')
      if (.not. failed(status)) cycle
      call check_true(index(status%message, 'pivot') > 0, status%message)
      if (k == 0) call check_true(index(status%message, 'node index 9:') > 0, engine// &
          ' names the node: '//status%message)
    end do
  end subroutine test_lost_pivot

  !> T' A T with T of a lower rank at some nodes is singular: LDLT counts the unknowns that are
  !> missing, those of a node without any too, and solves all the same where b is a product with
  !> the matrix. What is null is 1e-16 of its diagonal, what is not above 1e-4 of it: T has
  !> entries up to 1.
  subroutine test_null_pivots()
    type(ldlt_t) :: solver
    type(block_matrix_t) :: singular
    type(status_t) :: status
    real(wp) :: t(d, d, graph%n), x(d, graph%n), b(d, graph%n), back(d, graph%n)
    integer :: i, m, lost
    lost = 0
    t = zero
    do i = 1, graph%n
      do m = 1, d
        t(m, m, i) = one
      end do
      if (mod(i, 3) /= 1) cycle
      m = mod(i, d + 1)
      lost = lost + d - m
      t(:m, :m, i) = t(:m, :m, i)
      t(m + 1:, :, i) = zero
      if (m > 0) t(:m, m + 1:, i) = 0.5_wp
      t(:, :, i) = cshift(t(:, :, i), i, 2)
    end do
    singular = matrix
    do i = 1, graph%n
      do m = graph%first(i), graph%first(i + 1) - 1
        singular%value(:, :, m) = matmul(transpose(t(:, :, i)), matmul(matrix%value(:, :, m), &
            t(:, :, graph%column(m))))
      end do
    end do
    solver%options%null_pivot = 1.0e-10_wp
    call solver%analyse(graph, d, [integer ::], status)
    call solver%factor(graph, singular, status)
    call check_true(.not. failed(status), 'null pivots are no failure where they are allowed')
    call check_equal(solver%info%null_pivots, lost, 'null pivots')
    call random_number(x)
    call multiply(singular, x, b)
    call solve_whole(solver, b, x)
    call multiply(singular, x, back)
    call check_close(maxval(abs(back - b))/max(one, maxval(abs(b))), zero, 1.0e-12_wp, &
        'solution beside null pivots')
  end subroutine test_null_pivots

  subroutine multiply(a, x, y)
    type(block_matrix_t), intent(in) :: a
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(out) :: y(:, :)
    integer :: i, m
    y = zero
    do i = 1, graph%n
      do m = graph%first(i), graph%first(i + 1) - 1
        y(:, i) = y(:, i) + matmul(a%value(:, :, m), x(:, graph%column(m)))
      end do
    end do
  end subroutine multiply

  !> Other units by a power of two, an odd one for the sake of square roots, change no digit.
  subroutine test_units(engine)
    character(*), intent(in) :: engine
    class(solver_t), allocatable :: solver
    type(block_matrix_t) :: other
    type(status_t) :: status
    real(wp), dimension(d, graph%n) :: b, x, y
    real(wp), parameter :: unit = 2.0_wp**37
    other = matrix
    other%value = other%value*unit
    other%diagonal = other%diagonal*unit
    call random_number(b)
    call make_solver(solver_options_t(engine=engine), solver, status)
    call solver%analyse(graph, d, [3, 11], status)
    call solver%factor(graph, matrix, status)
    call solve_whole(solver, b, x)
    call solver%factor(graph, other, status)
    call solve_whole(solver, b, y)
    call check_true(.not. any(abs(x - y*unit) > zero), engine// &
        ' keeps its digits in other units')
  end subroutine test_units

  subroutine test_unknown_names()
    class(solver_t), allocatable :: solver
    type(status_t) :: status
    call make_solver(solver_options_t(engine='MAGIC'), solver, status)
    call check_true(failed(status), 'an unknown engine is refused')
    status = status_t()
    call make_solver(solver_options_t(order='MAGIC'), solver, status)
    call solver%analyse(graph, 2, [integer ::], status)
    call check_true(failed(status), 'an unknown order is refused')
  end subroutine test_unknown_names

  subroutine test_scalar_product()
    real(wp) :: s(size(graph%column))
    real(wp), dimension(d, graph%n) :: x, y, z, p, q, rows
    integer :: i, k
    call random_number(s)
    call random_number(x)
    y = one
    z = one
    rows = one
    call scalar_product(d, graph%n, graph%first, graph%column, s, 2.0_wp, x, y)
    call scalar_products(d, graph%n, graph%first, graph%column, s, x, z, p, q)
    call scalar_rows(graph, s, 2.0_wp, [5, 30], x, rows)
    do i = 1, graph%n
      do k = graph%first(i), graph%first(i + 1) - 1
        z(:, i) = z(:, i) + 2.0_wp*s(k)*x(:, graph%column(k))
        q(:, i) = q(:, i) - s(k)
      end do
    end do
    call check_close(maxval(abs(y - z)), zero, 1.0e-14_wp, 'product with a scalar matrix')
    call check_close(maxval(abs(one + 2.0_wp*p - z)), zero, 1.0e-14_wp, 'first of two products')
    call check_close(maxval(abs(q)), zero, 1.0e-14_wp, 'second of two products')
    call check_true(.not. any(abs(rows(:, [5, 30]) - y(:, [5, 30])) > zero), 'some rows')
    call check_close(sum(rows) - sum(rows(:, [5, 30])), real(d*(graph%n - 2), wp), 1.0e-12_wp, &
        'the other rows stay')
  end subroutine test_scalar_product

end program test_linalg
