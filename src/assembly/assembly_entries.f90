! SPDX-License-Identifier: BSD-3-Clause
!> Entries of the effective matrix: which nodes of the elements meet in it, and those of dofs
!> that are held.
module assembly_entries
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use base_kinds, only: wp, zero, one
  use linalg_graph, only: graph_t, block_matrix_t
  use model_data, only: model_t
  implicit none
  private
  public :: element_cliques, elements_at, set_one, clear_held, diagonal_product

contains

  !> Each element's nodes together with the nodes that take over their mass.
  pure subroutine element_cliques(model, first, target, clique_first, clique)
    type(model_t), intent(in) :: model
    integer, intent(in) :: first(:), target(:)
    integer, allocatable, intent(out) :: clique_first(:), clique(:)
    integer :: e, k, i, m, pass
    allocate (clique_first(model%mesh%n + 1))
    do pass = 1, 2
      m = 0
      do e = 1, model%mesh%n
        clique_first(e) = m + 1
        if (model%part(model%mesh%part(e))%is_rigid) cycle
        do k = 1, model%mesh%count_of(e)
          i = model%mesh%node_of(k, e)
          m = m + 1
          if (pass == 2) clique(m) = i
          if (first(i + 1) - first(i) == 1) then
            if (target(first(i)) == i) cycle
          end if
          if (pass == 2) &
              clique(m + 1:m + first(i + 1) - first(i)) = target(first(i):first(i + 1) - 1)
          m = m + first(i + 1) - first(i)
        end do
      end do
      clique_first(model%mesh%n + 1) = m + 1
      if (pass == 1) allocate (clique(m))
    end do
  end subroutine element_cliques

  !> Elements that hold one of some nodes.
  pure function elements_at(model, nodes) result(list)
    type(model_t), intent(in) :: model
    integer, intent(in) :: nodes(:)
    integer, allocatable :: list(:)
    logical :: is_one(model%nodes)
    integer :: e
    is_one = .false.
    is_one(nodes) = .true.
    list = pack([(e, e=1, model%mesh%n)], &
        [(any(is_one(model%mesh%nodes_of(e))), e=1, model%mesh%n)])
  end function elements_at

  !> A one on the diagonal, where there is nothing.
  pure subroutine set_one(graph, direction, node, matrix)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: direction, node
    type(block_matrix_t), intent(inout) :: matrix
    integer :: k
    if (ieee_is_nan(matrix%diagonal_entry(graph, direction, node))) return
    if (abs(matrix%diagonal_entry(graph, direction, node)) > zero) return
    if (allocated(matrix%diagonal)) then
      matrix%diagonal(direction, node) = one
    else
      k = graph%position(node, node)
      matrix%value(direction, direction, k) = one
    end if
  end subroutine set_one

  !> Rows and columns of held dofs (dim, n) keep their diagonal only.
  pure subroutine clear_held(graph, fixed, matrix)
    type(graph_t), intent(in) :: graph
    logical, intent(in) :: fixed(:, :)
    type(block_matrix_t), intent(inout) :: matrix
    integer :: i, k
    do i = 1, graph%n
      do k = graph%first(i), graph%first(i + 1) - 1
        call clear_block(fixed(:, i), fixed(:, graph%column(k)), graph%column(k) == i, &
            matrix%value(:, :, k))
      end do
    end do
  end subroutine clear_held

  pure subroutine clear_block(row, column, diagonal, block)
    logical, intent(in) :: row(:), column(:), diagonal
    real(wp), intent(inout) :: block(:, :)
    integer :: a, b
    do b = 1, size(column)
      do a = 1, size(row)
        if ((row(a) .or. column(b)) .and. .not. (diagonal .and. a == b)) block(a, b) = zero
      end do
    end do
  end subroutine clear_block

  !> y = y + factor * m x of a mass m (n) on the diagonal.
  pure subroutine diagonal_product(dim, n, mass, factor, x, y)
    integer, intent(in) :: dim, n
    real(wp), intent(in) :: mass(n), factor, x(dim, n)
    real(wp), intent(inout) :: y(dim, n)
    integer :: d, i
    do i = 1, n
      do d = 1, dim
        y(d, i) = y(d, i) + factor*mass(i)*x(d, i)
      end do
    end do
  end subroutine diagonal_product

end module assembly_entries
