! SPDX-License-Identifier: BSD-3-Clause
!> Parts of an elimination tree, and solves by several threads: equal in every digit.
program test_threads
  use base_kinds, only: wp
  use base_status, only: status_t, failed
  use base_strings, only: to_text
  use check, only: test_start, test_end, check_equal, check_true, seed_random
  use grid_matrices, only: make_graph, fill_matrix, remainder
  use linalg_graph, only: graph_t, block_matrix_t
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
    call check_true(maxval(abs(remainder(graph, matrix, b, first))) < &
        1.0e-12_wp, engine//' solves')
    do threads = 2, 4
      call solve(engine, threads, d, graph, matrix, b, x)
      call check_true(all(abs(x - first) <= 0.0_wp), engine//', d = '//to_text(d)//', '// &
          to_text(threads)//' threads')
    end do
  end subroutine check_engine

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

end program test_threads
