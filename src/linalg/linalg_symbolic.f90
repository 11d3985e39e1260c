! SPDX-License-Identifier: BSD-3-Clause
!> The shape of a factor before there is one: elimination tree, length of each column, cost. The
!> time is nearly that of reading the graph once, whatever the fill.
module linalg_symbolic
  use base_kinds, only: i8
  use linalg_graph, only: graph_t
  implicit none
  private
  public :: symbolic_factor, count_factor, factor_entries, order_tree

contains

  !> Elimination tree and the number of rows below each pivot, for an order (new -> old). The
  !> nodes after `leading` are not eliminated: they end a path of the tree (parent 0, no rows).
  !> Rows of the graph hold their own node too.
  pure subroutine symbolic_factor(graph, order, leading, parent, rows)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: order(:)
    integer, intent(in) :: leading
    integer, intent(out) :: parent(:)
    integer, intent(out) :: rows(:)
    integer, allocatable :: new(:)
    integer :: k
    allocate (new(graph%n))
    do k = 1, graph%n
      new(order(k)) = k
    end do
    call elimination_tree(graph, order, new, leading, parent)
    call count_rows(graph, order, new, leading, parent, rows)
  end subroutine symbolic_factor

  !> Multiplications of node blocks that the factor of an order costs: half the sum of the
  !> squares of its column lengths, and the pivots.
  pure integer(i8) function count_factor(graph, order, leading)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: order(:)
    integer, intent(in) :: leading
    integer, allocatable :: parent(:), rows(:)
    integer :: k
    allocate (parent(graph%n), rows(graph%n))
    call symbolic_factor(graph, order, leading, parent, rows)
    count_factor = 0_i8
    do k = 1, leading
      count_factor = count_factor + int(rows(k), i8)*int(rows(k) + 3, i8)/2_i8
    end do
  end function count_factor

  !> Blocks below the pivots of the factor of an order.
  pure integer(i8) function factor_entries(graph, order, leading)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: order(:)
    integer, intent(in) :: leading
    integer, allocatable :: parent(:), rows(:)
    allocate (parent(graph%n), rows(graph%n))
    call symbolic_factor(graph, order, leading, parent, rows)
    factor_entries = sum(int(rows(:leading), i8))
  end function factor_entries

  !> parent(i) = the first row below pivot i (Liu 1990): row k joins the trees of its entries.
  !> The way up to the root is shortened each time it is gone.
  pure subroutine elimination_tree(graph, order, new, leading, parent)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: order(:), new(:)
    integer, intent(in) :: leading
    integer, intent(out) :: parent(:)
    integer, allocatable :: ancestor(:)
    integer :: k, m, i, next
    allocate (ancestor(graph%n))
    parent = 0
    ancestor = 0
    do k = 1, graph%n
      do m = graph%first(order(k)), graph%first(order(k) + 1) - 1
        i = new(graph%column(m))
        do while (i < k .and. i <= leading)
          next = ancestor(i)
          ancestor(i) = k
          if (next == 0) then
            parent(i) = k
            exit
          end if
          i = next
        end do
      end do
    end do
  end subroutine elimination_tree

  !> Rows below each pivot (Gilbert, Ng & Peyton 1994). Row i of the factor is the union of the
  !> ways up the tree from its entries in A to i. Entries taken in the order of the tree, each
  !> adds its way, which meets that of the entry before at their lowest common ancestor. So
  !> column j is in as many rows as the sum over its descendants of: one for each entry, minus
  !> one for each meeting, minus one above each i, where a union ends.
  pure subroutine count_rows(graph, order, new, leading, parent, rows)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: order(:), new(:)
    integer, intent(in) :: leading
    integer, intent(in) :: parent(:)
    integer, intent(out) :: rows(:)
    integer, allocatable :: post(:), before(:), ancestor(:)
    integer :: k, m, i, j, meeting
    allocate (post(graph%n), before(graph%n), ancestor(graph%n))
    call order_tree(parent, post)
    rows = 0
    before = 0
    ancestor = [(k, k=1, graph%n)]
    do k = 1, graph%n
      j = post(k)
      if (j > leading) cycle
      do m = graph%first(order(j)), graph%first(order(j) + 1) - 1
        i = new(graph%column(m))
        if (i < j) cycle
        rows(j) = rows(j) + 1
        if (before(i) > 0) then
          call find_root(ancestor, before(i), meeting)
          rows(meeting) = rows(meeting) - 1
        end if
        before(i) = j
      end do
      if (parent(j) == 0) cycle
      rows(parent(j)) = rows(parent(j)) - 1
      ancestor(j) = parent(j)
    end do
    do j = 1, leading
      if (parent(j) > 0) rows(parent(j)) = rows(parent(j)) + rows(j)
      rows(j) = rows(j) - 1
    end do
    rows(leading + 1:) = 0
  end subroutine count_rows

  !> Nodes of the tree with children before parents, each subtree in one piece.
  pure subroutine order_tree(parent, post)
    integer, intent(in) :: parent(:)
    integer, intent(out) :: post(:)
    integer, allocatable :: size_of(:), next(:)
    integer :: j, first, free
    allocate (size_of(size(parent)), next(size(parent)))
    size_of = 1
    do j = 1, size(parent)
      if (parent(j) > 0) size_of(parent(j)) = size_of(parent(j)) + size_of(j)
    end do
    ! The piece of a root begins where it is free, that of a child where it is free in its
    ! parent's.
    free = 1
    do j = size(parent), 1, -1
      if (parent(j) == 0) then
        first = free
        free = free + size_of(j)
      else
        first = next(parent(j))
        next(parent(j)) = first + size_of(j)
      end if
      next(j) = first
      post(first + size_of(j) - 1) = j
    end do
  end subroutine order_tree

  !> The end of the way up from i; the way is halved as it is gone.
  pure subroutine find_root(ancestor, i, root)
    integer, intent(inout) :: ancestor(:)
    integer, intent(in) :: i
    integer, intent(out) :: root
    root = i
    do while (ancestor(root) /= root)
      ancestor(root) = ancestor(ancestor(root))
      root = ancestor(root)
    end do
  end subroutine find_root

end module linalg_symbolic
