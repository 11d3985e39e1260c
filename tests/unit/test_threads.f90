! SPDX-License-Identifier: BSD-3-Clause
!> Parts of an elimination tree, and solves by several threads: equal in every digit.
program test_threads
  use base_kinds, only: wp
  use base_status, only: status_t, failed
  use base_strings, only: to_text
  use check, only: test_start, test_end, check_equal, check_true, seed_random
  use linalg_graph, only: graph_t, block_matrix_t, graph_from_cliques
  use linalg_registry, only: make_solver
  use linalg_solver, only: solver_t, solver_options_t, solve_whole
  use linalg_subtrees, only: subtrees_t, find_subtrees
  implicit none
  integer :: k, wrong

  call test_start('threads')
  call seed_random(5)
  wrong = 0
  do k = 1, 300
    wrong = wrong + faults_of_parts(20 + 7*k)
  end do
  call check_equal(wrong, 0, 'parts of random trees')
  call check_engine('LDLT', 75, 2)
  call check_engine('SUPERNODAL', 75, 2)
  call check_engine('LDLT', 11, 3)
  call check_engine('SUPERNODAL', 12, 3)
  call test_end()

contains

  !> Of a random tree in the order that find_subtrees asks for: descendants of a node in a part
  !> are in the same, no two parts overlap, none is dearer than a tenth, the list has each once.
  integer function faults_of_parts(n) result(wrong)
    integer, intent(in) :: n
    type(subtrees_t) :: parts
    integer :: parent(n), k, t
    real(wp) :: cost(n), draw(n)
    call random_number(cost)
    call random_number(draw)
    call make_tree(draw, parent)
    call find_subtrees(parent, cost, parts)
    wrong = merge(0, 1, size(parts%first) == parts%n .and. size(parts%by_cost) == parts%n)
    do k = 1, n
      if (parent(k) == 0) cycle
      if (parts%part(parent(k)) > 0 .and. parts%part(k) /= parts%part(parent(k))) &
          wrong = wrong + 1
    end do
    do t = 1, parts%n
      if (any(parts%part(parts%first(t):parts%last(t)) /= t)) wrong = wrong + 1
      if (count(parts%part == t) /= parts%last(t) - parts%first(t) + 1) wrong = wrong + 1
      if (sum(cost, mask=parts%part == t) > 0.1_wp*sum(cost)) wrong = wrong + 1
      if (count(parts%by_cost == t) /= 1) wrong = wrong + 1
    end do
  end function faults_of_parts

  !> Nodes one after the other, each taking some of the trees so far as its children.
  subroutine make_tree(draw, parent)
    real(wp), intent(in) :: draw(:)
    integer, intent(out) :: parent(:)
    integer :: root(size(draw)), roots, taken, k
    parent = 0
    roots = 0
    do k = 1, size(draw)
      taken = 0
      if (draw(k) > 0.5_wp) taken = min(roots, 2)
      parent(root(roots - taken + 1:roots)) = k
      roots = roots - taken + 1
      root(roots) = k
    end do
  end subroutine make_tree

  !> Solutions for 1 to 4 threads, with some last nodes.
  subroutine check_engine(engine, n, d)
    character(*), intent(in) :: engine
    integer, intent(in) :: n, d
    type(graph_t) :: graph
    type(block_matrix_t) :: matrix
    real(wp) :: b(d, n**d), first(d, n**d), x(d, n**d)
    integer :: threads
    call make_graph(n, d, graph)
    call fill_matrix(graph, d, matrix)
    call random_number(b)
    call solve(engine, 1, d, graph, matrix, b, first)
    call check_true(misfit(graph, matrix, b, first) < 1.0e-12_wp, engine//' solves')
    do threads = 2, 4
      call solve(engine, threads, d, graph, matrix, b, x)
      call check_true(all(abs(x - first) <= 0.0_wp), engine//', d = '//to_text(d)//', '// &
          to_text(threads)//' threads')
    end do
  end subroutine check_engine

  !> A square or a cube of n nodes a side.
  subroutine make_graph(n, d, graph)
    integer, intent(in) :: n, d
    type(graph_t), intent(out) :: graph
    integer :: member(2**d*(n - 1)**d), e, i, corner, node
    do e = 0, (n - 1)**d - 1
      do corner = 0, 2**d - 1
        node = 0
        do i = d - 1, 0, -1
          node = node*n + mod(e/(n - 1)**i, n - 1) + ibits(corner, i, 1)
        end do
        member(2**d*e + corner + 1) = node + 1
      end do
    end do
    call graph_from_cliques(n**d, [(2**d*e + 1, e=0, (n - 1)**d)], member, graph)
  end subroutine make_graph

  !> Random, symmetric, diagonally dominant.
  subroutine fill_matrix(graph, d, matrix)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: d
    type(block_matrix_t), intent(out) :: matrix
    real(wp) :: block(d, d)
    integer :: i, m, c
    allocate (matrix%value(d, d, size(graph%column)))
    do i = 1, graph%n
      do m = graph%first(i), graph%first(i + 1) - 1
        if (graph%column(m) > i) cycle
        call random_number(block)
        if (graph%column(m) == i) then
          block = block + transpose(block)
          do c = 1, d
            block(c, c) = block(c, c) + 2*d*(graph%first(i + 1) - graph%first(i))
          end do
        end if
        matrix%value(:, :, m) = block
        matrix%value(:, :, graph%position(graph%column(m), i)) = transpose(block)
      end do
    end do
  end subroutine fill_matrix

  subroutine solve(engine, threads, d, graph, matrix, b, x)
    character(*), intent(in) :: engine
    integer, intent(in) :: threads, d
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    real(wp), intent(in) :: b(:, :)
    real(wp), intent(out) :: x(:, :)
    class(solver_t), allocatable :: solver
    type(status_t) :: status
    integer :: k
    call make_solver(solver_options_t(engine=engine, threads=threads), solver, status)
    call solver%analyse(graph, d, [(k, k=1, 20)], status)
    call solver%factor(graph, matrix, status)
    call check_true(.not. failed(status), engine//' factors')
    call solve_whole(solver, b, x)
  end subroutine solve

  !> Largest entry of b - A x.
  real(wp) function misfit(graph, matrix, b, x)
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    real(wp), intent(in) :: b(:, :), x(:, :)
    real(wp) :: r(size(b, 1), size(b, 2))
    integer :: i, m
    r = b
    do i = 1, graph%n
      do m = graph%first(i), graph%first(i + 1) - 1
        r(:, i) = r(:, i) - matmul(matrix%value(:, :, m), x(:, graph%column(m)))
      end do
    end do
    misfit = maxval(abs(r))
  end function misfit

end program test_threads
