! SPDX-License-Identifier: BSD-3-Clause
!> Elimination tree and column lengths against elimination itself, entry by entry.
program test_symbolic
  use base_kinds, only: i8
  use base_strings, only: to_text
  use check, only: test_start, test_end, check_equal, seed_random
  use linalg_graph, only: graph_t, graph_from_cliques
  use linalg_symbolic, only: symbolic_factor, count_factor
  implicit none
  integer :: k, wrong

  call test_start('symbolic')
  call seed_random(77)
  wrong = 0
  do k = 1, 2000
    wrong = wrong + random_graph(1 + mod(k, 25))
  end do
  call check_equal(wrong, 0, 'random graphs, orders and last nodes')
  do k = 1, 60
    call check_equal(long_strip(k), 0, 'a strip of '//to_text(k)//' elements')
  end do
  call test_end()

contains

  !> Cliques of up to four nodes, few to many, in a random order; a random number of last nodes.
  integer function random_graph(n) result(wrong)
    integer, intent(in) :: n
    type(graph_t) :: graph
    integer, allocatable :: first(:), member(:)
    integer :: order(n), k, m, length, cliques
    cliques = random_integer(0, 2*n)
    allocate (first(cliques + 1), member(4*cliques))
    first(1) = 1
    do k = 1, cliques
      length = min(n, random_integer(1, 4))
      do m = 0, length - 1
        member(first(k) + m) = random_integer(1, n)
      end do
      first(k + 1) = first(k) + length
    end do
    call graph_from_cliques(n, first, member(:first(cliques + 1) - 1), graph)
    order = [(k, k=1, n)]
    do k = n, 2, -1
      m = random_integer(1, k)
      order([k, m]) = order([m, k])
    end do
    wrong = differences(graph, order, random_integer(0, n))
  end function random_graph

  !> One row of quadrilaterals numbered the long way: the lower edge, then the upper one. All
  !> nodes are eliminated, or those of the right end are the last.
  integer function long_strip(n) result(wrong)
    integer, intent(in) :: n
    type(graph_t) :: graph
    integer :: first(n + 1), member(4*n), order(2*n + 2), k
    do k = 1, n
      first(k) = 4*k - 3
      member(4*k - 3:4*k) = [k, k + 1, n + 1 + k, n + 2 + k]
    end do
    first(n + 1) = 4*n + 1
    call graph_from_cliques(2*n + 2, first, member, graph)
    order = [(k, k=1, 2*n + 2)]
    wrong = differences(graph, order, 2*n + 2)
    order = [[(k, k=1, n)], [(k, k=n + 2, 2*n + 1)], n + 1, 2*n + 2]
    wrong = wrong + differences(graph, order, 2*n)
  end function long_strip

  integer function differences(graph, order, leading)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: order(:), leading
    integer, dimension(graph%n) :: parent, rows, tree, length
    integer(i8) :: cost
    integer :: k
    call symbolic_factor(graph, order, leading, parent, rows)
    call eliminate(graph, order, leading, tree, length)
    cost = 0_i8
    do k = 1, leading
      cost = cost + int(length(k)*(length(k) + 3)/2, i8)
    end do
    differences = count(parent /= tree) + count(rows /= length)
    if (count_factor(graph, order, leading) /= cost) differences = differences + 1
  end function differences

  !> The definition: eliminating a pivot joins all rows that have an entry in its column.
  subroutine eliminate(graph, order, leading, parent, rows)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: order(:), leading
    integer, intent(out) :: parent(:), rows(:)
    logical :: a(graph%n, graph%n)
    integer :: i, j, k
    a = .false.
    do i = 1, graph%n
      a(graph%column(graph%first(i):graph%first(i + 1) - 1), i) = .true.
    end do
    a = a(order, order)
    parent = 0
    rows = 0
    do k = 1, leading
      rows(k) = count(a(k + 1:, k))
      if (rows(k) > 0) parent(k) = k + findloc_true(a(k + 1:, k))
      do j = k + 1, graph%n
        if (a(j, k)) a(k + 1:, j) = a(k + 1:, j) .or. a(k + 1:, k)
      end do
    end do
  end subroutine eliminate

  pure integer function findloc_true(mask)
    logical, intent(in) :: mask(:)
    do findloc_true = 1, size(mask)
      if (mask(findloc_true)) return
    end do
  end function findloc_true

  integer function random_integer(low, high)
    integer, intent(in) :: low, high
    real :: x
    call random_number(x)
    random_integer = min(high, low + int(x*(high - low + 1)))
  end function random_integer

end program test_symbolic
