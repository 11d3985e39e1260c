! SPDX-License-Identifier: BSD-3-Clause
!> Matrices of squares and cubes for linear solvers.
module grid_matrices
  use base_kinds, only: wp
  use linalg_graph, only: graph_t, block_matrix_t, graph_from_cliques
  implicit none
  private
  public :: make_graph, fill_matrix, remainder

contains

  !> A square (d = 2) or a cube (3) of n nodes a side, all nodes of an element coupled; the
  !> first face has the numbers 1..n^(d-1).
  subroutine make_graph(n, d, graph)
    integer, intent(in) :: n, d
    type(graph_t), intent(out) :: graph
    integer, allocatable :: member(:)
    integer :: e, i, corner, node, elements
    elements = (n - 1)**d
    allocate (member(2**d*elements))
    do e = 0, elements - 1
      do corner = 0, 2**d - 1
        node = 0
        do i = d - 1, 0, -1
          node = node*n + mod(e/(n - 1)**i, n - 1) + ibits(corner, i, 1)
        end do
        member(2**d*e + corner + 1) = node + 1
      end do
    end do
    call graph_from_cliques(n**d, [(2**d*e + 1, e=0, elements)], member, graph)
  end subroutine make_graph

  !> Random, symmetric, diagonally dominant; its diagonal apart besides.
  subroutine fill_matrix(graph, d, matrix)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: d
    type(block_matrix_t), intent(out) :: matrix
    real(wp) :: block(d, d)
    integer :: i, m, c
    allocate (matrix%value(d, d, size(graph%column)), matrix%diagonal(d, graph%n))
    do i = 1, graph%n
      do m = graph%first(i), graph%first(i + 1) - 1
        if (graph%column(m) > i) cycle
        call random_number(block)
        block = block - 0.5_wp
        if (graph%column(m) == i) then
          block = block + transpose(block)
          do c = 1, d
            block(c, c) = block(c, c) + d*(graph%first(i + 1) - graph%first(i))
            matrix%diagonal(c, i) = block(c, c)
          end do
        end if
        matrix%value(:, :, m) = block
        matrix%value(:, :, graph%position(graph%column(m), i)) = transpose(block)
      end do
    end do
  end subroutine fill_matrix

  !> b - A x, all (d, n).
  function remainder(graph, matrix, b, x) result(r)
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
  end function remainder

end module grid_matrices
