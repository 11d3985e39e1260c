! SPDX-License-Identifier: BSD-3-Clause
!> The node graph and the symmetric matrices that live on it: blocks of d x d (stiffness-like)
!> and scalars per node pair (mass-like, the same for all d directions); d = 2 or 3.
!> Rows hold every neighbour and the node itself, in increasing order.
module linalg_graph
  use base_kinds, only: wp, zero
  use base_sort, only: sort_integers, find_sorted
  implicit none
  private

  type, public :: graph_t
    integer :: n = 0
    integer, allocatable :: first(:)   !< (n+1) start of each row in column
    integer, allocatable :: column(:)  !< neighbours of each node, the node itself included
  contains
    procedure :: position => graph_position
  end type graph_t

  !> A = blocks (d, d, size(column)) on a graph [F/L]; or, where it is diagonal, (d, n) alone.
  type, public :: block_matrix_t
    real(wp), allocatable :: value(:, :, :)
    real(wp), allocatable :: diagonal(:, :)
  contains
    procedure :: diagonal_entry
  end type block_matrix_t

  public :: graph_from_cliques, scalar_product, scalar_products, scalar_rows

contains

  !> Graph in which all members of a clique (an element, a tied group) are neighbours.
  !> first(m+1), member: the cliques as rows; n: number of nodes.
  pure subroutine graph_from_cliques(n, first, member, graph)
    integer, intent(in) :: n
    integer, intent(in) :: first(:)
    integer, intent(in) :: member(:)
    type(graph_t), intent(out) :: graph
    integer, allocatable :: owner_first(:), owner(:), seen(:), row(:)
    integer :: pass, node, k, e, m, length
    call transpose_rows(n, first, member, owner_first, owner)
    allocate (seen(n), row(n))
    graph%n = n
    allocate (graph%first(n + 1))
    do pass = 1, 2
      seen = 0
      graph%first(1) = 1
      do node = 1, n
        length = 1
        row(1) = node
        seen(node) = node
        do k = owner_first(node), owner_first(node + 1) - 1
          e = owner(k)
          do m = first(e), first(e + 1) - 1
            if (seen(member(m)) == node) cycle
            seen(member(m)) = node
            length = length + 1
            row(length) = member(m)
          end do
        end do
        graph%first(node + 1) = graph%first(node) + length
        if (pass == 2) then
          call sort_integers(row(1:length))
          graph%column(graph%first(node):graph%first(node + 1) - 1) = row(1:length)
        end if
      end do
      if (pass == 1) allocate (graph%column(graph%first(n + 1) - 1))
    end do
  end subroutine graph_from_cliques

  !> Which cliques hold each node: the transpose of a list of rows.
  pure subroutine transpose_rows(n, first, member, owner_first, owner)
    integer, intent(in) :: n
    integer, intent(in) :: first(:)
    integer, intent(in) :: member(:)
    integer, allocatable, intent(out) :: owner_first(:)
    integer, allocatable, intent(out) :: owner(:)
    integer, allocatable :: next(:)
    integer :: e, k
    allocate (owner_first(n + 1), owner(size(member)))
    owner_first = 0
    do k = 1, size(member)
      owner_first(member(k) + 1) = owner_first(member(k) + 1) + 1
    end do
    owner_first(1) = 1
    do k = 1, n
      owner_first(k + 1) = owner_first(k) + owner_first(k + 1)
    end do
    next = owner_first(1:n)
    do e = 1, size(first) - 1
      do k = first(e), first(e + 1) - 1
        owner(next(member(k))) = e
        next(member(k)) = next(member(k)) + 1
      end do
    end do
  end subroutine transpose_rows

  !> Position of entry (row, column) in graph%column; 0 if the nodes are no neighbours.
  pure integer function graph_position(this, row, column)
    class(graph_t), intent(in) :: this
    integer, intent(in) :: row
    integer, intent(in) :: column
    graph_position = find_sorted(this%column(this%first(row):this%first(row + 1) - 1), column)
    if (graph_position > 0) graph_position = graph_position + this%first(row) - 1
  end function graph_position

  !> The entry of A on the diagonal, of one direction of one node.
  pure real(wp) function diagonal_entry(this, graph, direction, node)
    class(block_matrix_t), intent(in) :: this
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: direction, node
    if (allocated(this%diagonal)) then
      diagonal_entry = this%diagonal(direction, node)
    else
      diagonal_entry = this%value(direction, direction, graph%position(node, node))
    end if
  end function diagonal_entry

  !> y = y + factor * S x for a node-scalar matrix S on a graph; x, y (d, n).
  pure subroutine scalar_product(d, n, first, column, s, factor, x, y)
    integer, intent(in) :: d, n
    integer, intent(in) :: first(n + 1)
    integer, intent(in) :: column(*)
    real(wp), intent(in) :: s(*)
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: x(d, n)
    real(wp), intent(inout) :: y(d, n)
    if (d == 2) then
      call scalar_product_2(n, first, column, s, factor, x, y)
    else
      call scalar_product_3(n, first, column, s, factor, x, y)
    end if
  end subroutine scalar_product

  pure subroutine scalar_product_2(n, first, column, s, factor, x, y)
    integer, intent(in) :: n
    integer, intent(in) :: first(n + 1)
    integer, intent(in) :: column(*)
    real(wp), intent(in) :: s(*)
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: x(2, n)
    real(wp), intent(inout) :: y(2, n)
    real(wp) :: row(2)
    integer :: i, k
    do i = 1, n
      row = zero
      do k = first(i), first(i + 1) - 1
        row = row + s(k)*x(:, column(k))
      end do
      y(:, i) = y(:, i) + factor*row
    end do
  end subroutine scalar_product_2

  pure subroutine scalar_product_3(n, first, column, s, factor, x, y)
    integer, intent(in) :: n
    integer, intent(in) :: first(n + 1)
    integer, intent(in) :: column(*)
    real(wp), intent(in) :: s(*)
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: x(3, n)
    real(wp), intent(inout) :: y(3, n)
    real(wp) :: row(3)
    integer :: i, k
    do i = 1, n
      row = zero
      do k = first(i), first(i + 1) - 1
        row = row + s(k)*x(:, column(k))
      end do
      y(:, i) = y(:, i) + factor*row
    end do
  end subroutine scalar_product_3

  !> p = S x and q = S y in one pass over S; all (d, n).
  pure subroutine scalar_products(d, n, first, column, s, x, y, p, q)
    integer, intent(in) :: d, n
    integer, intent(in) :: first(n + 1)
    integer, intent(in) :: column(*)
    real(wp), intent(in) :: s(*)
    real(wp), intent(in) :: x(d, n), y(d, n)
    real(wp), intent(out) :: p(d, n), q(d, n)
    if (d == 2) then
      call scalar_products_2(n, first, column, s, x, y, p, q)
    else
      call scalar_products_3(n, first, column, s, x, y, p, q)
    end if
  end subroutine scalar_products

  pure subroutine scalar_products_2(n, first, column, s, x, y, p, q)
    integer, intent(in) :: n
    integer, intent(in) :: first(n + 1)
    integer, intent(in) :: column(*)
    real(wp), intent(in) :: s(*)
    real(wp), intent(in) :: x(2, n), y(2, n)
    real(wp), intent(out) :: p(2, n), q(2, n)
    real(wp) :: row_x(2), row_y(2)
    integer :: i, k
    do i = 1, n
      row_x = zero
      row_y = zero
      do k = first(i), first(i + 1) - 1
        row_x = row_x + s(k)*x(:, column(k))
        row_y = row_y + s(k)*y(:, column(k))
      end do
      p(:, i) = row_x
      q(:, i) = row_y
    end do
  end subroutine scalar_products_2

  pure subroutine scalar_products_3(n, first, column, s, x, y, p, q)
    integer, intent(in) :: n
    integer, intent(in) :: first(n + 1)
    integer, intent(in) :: column(*)
    real(wp), intent(in) :: s(*)
    real(wp), intent(in) :: x(3, n), y(3, n)
    real(wp), intent(out) :: p(3, n), q(3, n)
    real(wp) :: row_x(3), row_y(3)
    integer :: i, k
    do i = 1, n
      row_x = zero
      row_y = zero
      do k = first(i), first(i + 1) - 1
        row_x = row_x + s(k)*x(:, column(k))
        row_y = row_y + s(k)*y(:, column(k))
      end do
      p(:, i) = row_x
      q(:, i) = row_y
    end do
  end subroutine scalar_products_3

  !> The same as scalar_product in some rows, digit for digit. (Loops of their own: one shared
  !> by both would be called for each row.)
  pure subroutine scalar_rows(graph, s, factor, rows, x, y)
    type(graph_t), intent(in) :: graph
    real(wp), intent(in) :: s(:)
    real(wp), intent(in) :: factor
    integer, intent(in) :: rows(:)
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(inout) :: y(:, :)
    if (size(x, 1) == 2) then
      call scalar_rows_2(graph, s, factor, rows, x, y)
    else
      call scalar_rows_3(graph, s, factor, rows, x, y)
    end if
  end subroutine scalar_rows

  pure subroutine scalar_rows_2(graph, s, factor, rows, x, y)
    type(graph_t), intent(in) :: graph
    real(wp), intent(in) :: s(:)
    real(wp), intent(in) :: factor
    integer, intent(in) :: rows(:)
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(inout) :: y(:, :)
    real(wp) :: total(2)
    integer :: k, m
    do k = 1, size(rows)
      total = zero
      do m = graph%first(rows(k)), graph%first(rows(k) + 1) - 1
        total = total + s(m)*x(:, graph%column(m))
      end do
      y(:, rows(k)) = y(:, rows(k)) + factor*total
    end do
  end subroutine scalar_rows_2

  pure subroutine scalar_rows_3(graph, s, factor, rows, x, y)
    type(graph_t), intent(in) :: graph
    real(wp), intent(in) :: s(:)
    real(wp), intent(in) :: factor
    integer, intent(in) :: rows(:)
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(inout) :: y(:, :)
    real(wp) :: total(3)
    integer :: k, m
    do k = 1, size(rows)
      total = zero
      do m = graph%first(rows(k)), graph%first(rows(k) + 1) - 1
        total = total + s(m)*x(:, graph%column(m))
      end do
      y(:, rows(k)) = y(:, rows(k)) + factor*total
    end do
  end subroutine scalar_rows_3

end module linalg_graph
