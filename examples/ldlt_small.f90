! SPDX-License-Identifier: BSD-3-Clause
!> The sparse solver on its own: a chain of three nodes, its end kept for contact.
!>
!> Problem. Three nodes with two dofs each hang on one another and the first on a wall, by equal
!> springs of stiffness S = [2 1; 1 2]; a force p = (3, 0) pulls at the last:
!>
!>   wall ~~~~ (1) ~~~~ (2) ~~~~ (3) --> p          [ 2S  -S   0 ]
!>         S         S        S                 A = [ -S  2S  -S ],  A x = b
!>                                                  [  0  -S   S ]
!>
!> A is symmetric, positive definite, in blocks of 2 x 2 on the graph of the nodes. Node 3 is
!> kept to the end, as nodes that may touch are: `forward` eliminates the others, all that
!> contact asks is put to the small system of node 3, `backward` gives the rest.
!>
!> Solution. Springs in a row: x_k = k S^-1 p = k (2, -1), and the flexibility of node 3, what
!> it yields to a force on it, is 3 S^-1 = [2 -1; -1 2].
!>
!> Shown: a graph from elements, a block matrix on it, analyse, factor, forward, solve_schur,
!> backward, flexibility. See also: doc/library.md, examples/cone_small.f90 (what is done with
!> the flexibility).
!>
!> Expected output:
!>    the matrix
!>       4.0   2.0  -2.0  -1.0   0.0   0.0
!>       2.0   4.0  -1.0  -2.0   0.0   0.0
!>      -2.0  -1.0   4.0   2.0  -2.0  -1.0
!>      -1.0  -2.0   2.0   4.0  -1.0  -2.0
!>       0.0   0.0  -2.0  -1.0   2.0   1.0
!>       0.0   0.0  -1.0  -2.0   1.0   2.0
!>    node          x           y   (closed form)
!>       1   2.000000   -1.000000     2.000000   -1.000000
!>       2   4.000000   -2.000000     4.000000   -2.000000
!>       3   6.000000   -3.000000     6.000000   -3.000000
!>    flexibility of node 3   2.000000  -1.000000  -1.000000   2.000000
!>    engine LDLT, order NATURAL, residual  7.7E-16
program ldlt_small
  use base_kinds, only: wp
  use base_status, only: status_t, failed, status_text
  use linalg_graph, only: graph_t, block_matrix_t, graph_from_cliques
  use linalg_registry, only: make_solver
  use linalg_solver, only: solver_t, solver_options_t
  implicit none
  integer, parameter :: nodes = 3, last(1) = [3]
  real(wp), parameter :: spring(2, 2) = reshape([2.0_wp, 1.0_wp, 1.0_wp, 2.0_wp], [2, 2])
  real(wp), parameter :: tolerance = 1.0e-14_wp   ! the condition of A is below 50
  type(graph_t) :: graph
  type(block_matrix_t) :: matrix
  class(solver_t), allocatable :: solver
  type(status_t) :: status
  real(wp) :: b(2, nodes), x(2, nodes), exact(2, nodes), f(2, 2), dense(2*nodes, 2*nodes)
  real(wp) :: x_interface(2, size(last)), residual
  integer :: k

  ! Nodes of an element are neighbours: the springs hold (1), (1, 2) and (2, 3).
  call graph_from_cliques(nodes, [1, 2, 4, 6], [1, 1, 2, 2, 3], graph)
  allocate (matrix%value(2, 2, size(graph%column)))
  matrix%value = 0.0_wp
  call add_block(1, 1, spring)
  do k = 2, nodes
    call add_block(k - 1, k - 1, spring)
    call add_block(k, k, spring)
    call add_block(k - 1, k, -spring)
    call add_block(k, k - 1, -spring)
  end do
  b = 0.0_wp
  b(:, nodes) = [3.0_wp, 0.0_wp]

  ! Once per graph, once per matrix. The first failure wins, so one look at the end is enough.
  call make_solver(solver_options_t(engine='LDLT', order='NATURAL'), solver, status)
  call solver%analyse(graph, size(b, 1), last, status)
  call solver%factor(graph, matrix, status)
  if (failed(status)) then
    print '(a)', status_text(status)
    stop 1
  end if

  ! Once per right-hand side.
  call solver%forward(b, x_interface)
  call solver%solve_schur(x_interface)
  call solver%backward(x_interface, x)
  call solver%flexibility(f)

  call fill_dense()
  exact = reshape([(k*[2.0_wp, -1.0_wp], k=1, nodes)], [2, nodes])
  residual = norm2(reshape(b, [2*nodes]) - matmul(dense, reshape(x, [2*nodes])))/norm2(b)
  print '(a)', 'the matrix'
  print '(6f6.1)', transpose(dense)
  print '(a)', 'node          x           y   (closed form)'
  print '(i4, f11.6, f12.6, f13.6, f12.6)', (k, x(:, k), exact(:, k), k=1, nodes)
  print '(a, 4f11.6)', 'flexibility of node 3', f
  print '(a, es8.1)', 'engine '//solver%info%engine//', order '//solver%info%order// &
      ', residual ', residual
  if (maxval(abs(x - exact)) > tolerance*maxval(abs(exact)) .or. residual > tolerance) stop 1

contains

  !> Adds a block (2, 2) to the matrix at two neighbours.
  subroutine add_block(row, column, block)
    integer, intent(in) :: row, column
    real(wp), intent(in) :: block(2, 2)
    associate (entry => matrix%value(:, :, graph%position(row, column)))
      entry = entry + block
    end associate
  end subroutine add_block

  !> The matrix as one block, to be printed and to check the answer with.
  subroutine fill_dense()
    integer :: i, m
    dense = 0.0_wp
    do i = 1, nodes
      do m = graph%first(i), graph%first(i + 1) - 1
        associate (column => graph%column(m))
          dense(2*i - 1:2*i, 2*column - 1:2*column) = matrix%value(:, :, m)
        end associate
      end do
    end do
  end subroutine fill_dense

end program ldlt_small
