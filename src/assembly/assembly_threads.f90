! SPDX-License-Identifier: BSD-3-Clause
!> Loops over the elements of a block by several threads: each takes a few elements at a time,
!> and what they add to the nodes is added in the order of the elements, as with one thread: no
!> digit depends on the number of threads.
module assembly_threads
  use assembly_blocks, only: element_block_t
  use base_kinds, only: wp, zero
  use linalg_graph, only: graph_t, block_matrix_t
  use solid_block, only: solid_t, force_rule_t, element_force, element_tangent, relative, &
      begin_elements
  implicit none
  private
  public :: is_worth_threads, subtract_stiffness_forces, subtract_solid_forces, add_tangents, &
      begin_solid

  !> Elements that one thread takes at a time: with a stiffness, and at finite deformation.
  integer, parameter :: many = 128, few = 8

contains

  !> Are so many elements, with so many unknowns each, worth several threads? work: of an
  !> unknown, in units of its row of a stiffness.
  pure logical function is_worth_threads(threads, elements, unknowns, work)
    integer, intent(in) :: threads, elements, unknowns, work
    integer, parameter :: least = 100000
    is_worth_threads = .false.
    if (threads > 1) is_worth_threads = real(elements, wp)*unknowns**2*work > least
  end function is_worth_threads

  !> f = f - factor * K u of elements from..to of a block; u and f (dim, *).
  subroutine subtract_stiffness_forces(threads, dim, block, from, to, factor, u, f)
    integer, intent(in) :: threads, dim, from, to
    type(element_block_t), intent(in) :: block
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(inout) :: f(:, :)
    real(wp), allocatable :: g(:, :)
    integer :: first, last
    !$omp parallel num_threads(threads) private(g, last)
    allocate (g(dim*(block%nodes - 1), many))
    !$omp do ordered schedule(dynamic, 1)
    do first = from, to, many
      last = min(to, first + many - 1)
      call stiffness_forces(dim, block%nodes, first, last, block%node, block%stiffness, &
          factor, u, g, block%class)
      !$omp ordered
      call subtract_forces(dim, block%nodes, last - first + 1, block%node(1, first), g, f)
      !$omp end ordered
    end do
    !$omp end do
    deallocate (g)
    !$omp end parallel
  end subroutine subtract_stiffness_forces

  !> g = factor * K u of the nodes but the first of elements from..to; k: of each, or of each
  !> class.
  pure subroutine stiffness_forces(dim, nodes, from, to, node, k, factor, u, g, class)
    integer, intent(in) :: dim, nodes, from, to
    integer, intent(in) :: node(nodes, *)
    real(wp), intent(in) :: k(dim*(nodes - 1), dim*(nodes - 1), *)
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: g(dim*(nodes - 1), from:to)
    integer, intent(in), optional :: class(*)
    real(wp) :: d(dim*(nodes - 1))
    integer :: e, i, j, c, at
    do e = from, to
      at = e
      if (present(class)) at = class(e)
      do i = 2, nodes
        do c = 1, dim
          d(dim*(i - 2) + c) = factor*(u(c, node(i, e)) - u(c, node(1, e)))
        end do
      end do
      if (size(d) == 6) then
        call multiply_6(k(1, 1, at), d, g(1, e))
        cycle
      end if
      g(:, e) = k(:, 1, at)*d(1)
      do j = 2, size(d)
        g(:, e) = g(:, e) + k(:, j, at)*d(j)
      end do
    end do
  end subroutine stiffness_forces

  !> Four nodes in the plane.
  pure subroutine multiply_6(k, d, g)
    real(wp), intent(in) :: k(6, 6), d(6)
    real(wp), intent(out) :: g(6)
    integer :: i
    do i = 1, 6
      g(i) = k(i, 1)*d(1) + k(i, 2)*d(2) + k(i, 3)*d(3) + k(i, 4)*d(4) + k(i, 5)*d(5) &
          + k(i, 6)*d(6)
    end do
  end subroutine multiply_6

  !> These forces, and their sum at the first node, to f.
  pure subroutine subtract_forces(dim, nodes, n, node, g, f)
    integer, intent(in) :: dim, nodes, n
    integer, intent(in) :: node(nodes, n)
    real(wp), intent(in) :: g(dim, 2:nodes, n)
    real(wp), intent(inout) :: f(:, :)
    real(wp) :: total(dim)
    integer :: e, i
    do e = 1, n
      total = g(:, 2, e)
      if (dim*nodes /= 8) total = zero + total    ! as with one thread, the sign of 0 too
      f(:, node(2, e)) = f(:, node(2, e)) - g(:, 2, e)
      do i = 3, nodes
        total = total + g(:, i, e)
        f(:, node(i, e)) = f(:, node(i, e)) - g(:, i, e)
      end do
      f(:, node(1, e)) = f(:, node(1, e)) + total
    end do
  end subroutine subtract_forces

  !> f = f - factor f*(U0, U0 + x) of a block, all (dim, *); total: with its work on x.
  subroutine subtract_solid_forces(threads, s, rule, factor, u0, x, f, total)
    integer, intent(in) :: threads
    type(solid_t), intent(in) :: s
    type(force_rule_t), intent(in) :: rule
    real(wp), intent(in) :: factor, u0(:, :), x(:, :)
    real(wp), intent(inout) :: f(:, :), total
    real(wp), allocatable :: force(:, :, :), work(:, :)
    integer :: from, k, last
    !$omp parallel num_threads(threads) private(force, work, k, last)
    allocate (force(s%dim, s%nodes, few), work(s%nodes, few))
    !$omp do ordered schedule(dynamic, 1)
    do from = 1, s%n, few
      last = min(s%n, from + few - 1)
      do k = from, last
        call force_and_work(s, k, rule, u0, x, force(:, :, k - from + 1), work(:, k - from + 1))
      end do
      !$omp ordered
      do k = from, last
        call subtract_one(s%node(:, k), factor, force(:, :, k - from + 1), &
            work(:, k - from + 1), f, total)
      end do
      !$omp end ordered
    end do
    !$omp end do
    deallocate (force, work)
    !$omp end parallel
  end subroutine subtract_solid_forces

  !> Force of an element, and the work of each of its nodes.
  pure subroutine force_and_work(s, k, rule, u0, x, force, work)
    type(solid_t), intent(in) :: s
    integer, intent(in) :: k
    type(force_rule_t), intent(in) :: rule
    real(wp), intent(in) :: u0(:, :), x(:, :)
    real(wp), intent(out) :: force(:, :), work(:)
    real(wp) :: d(s%dim, s%nodes)
    integer :: i
    call element_force(s, k, rule, u0, x, force)
    call relative(s, k, x, d)
    do i = 1, s%nodes
      work(i) = dot_product(force(:, i), d(:, i))
    end do
  end subroutine force_and_work

  pure subroutine subtract_one(node, factor, force, work, f, total)
    integer, intent(in) :: node(:)
    real(wp), intent(in) :: factor, force(:, :), work(:)
    real(wp), intent(inout) :: f(:, :), total
    integer :: i
    do i = 1, size(node)
      f(:, node(i)) = f(:, node(i)) - factor*force(:, i)
      total = total + work(i)
    end do
  end subroutine subtract_one

  !> matrix = matrix + d f*/dx of a block.
  subroutine add_tangents(threads, s, rule, u0, x, graph, matrix)
    integer, intent(in) :: threads
    type(solid_t), intent(in) :: s
    type(force_rule_t), intent(in) :: rule
    real(wp), intent(in) :: u0(:, :), x(:, :)
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(inout) :: matrix
    real(wp), allocatable :: ke(:, :, :)
    integer, allocatable :: at(:, :, :)
    integer :: from, k, last
    !$omp parallel num_threads(threads) private(ke, at, k, last)
    allocate (ke(s%dim*s%nodes, s%dim*s%nodes, few), at(s%nodes, s%nodes, few))
    !$omp do ordered schedule(dynamic, 1)
    do from = 1, s%n, few
      last = min(s%n, from + few - 1)
      do k = from, last
        call element_tangent(s, k, rule, u0, x, ke(:, :, k - from + 1))
        call find_places(graph, s%node(:, k), at(:, :, k - from + 1))
      end do
      !$omp ordered
      do k = from, last
        call add_one(s%dim, at(:, :, k - from + 1), ke(:, :, k - from + 1), matrix)
      end do
      !$omp end ordered
    end do
    !$omp end do
    deallocate (ke, at)
    !$omp end parallel
  end subroutine add_tangents

  !> Where the blocks of an element are in the matrix.
  pure subroutine find_places(graph, node, at)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: node(:)
    integer, intent(out) :: at(:, :)
    integer :: i, j
    do j = 1, size(node)
      do i = 1, size(node)
        at(i, j) = graph%position(node(i), node(j))
      end do
    end do
  end subroutine find_places

  pure subroutine add_one(d, at, ke, matrix)
    integer, intent(in) :: d
    integer, intent(in) :: at(:, :)
    real(wp), intent(in) :: ke(:, :)
    type(block_matrix_t), intent(inout) :: matrix
    integer :: i, j
    do j = 1, size(at, 2)
      do i = 1, size(at, 1)
        matrix%value(:, :, at(i, j)) = matrix%value(:, :, at(i, j)) &
            + ke(d*(i - 1) + 1:d*i, d*(j - 1) + 1:d*j)
      end do
    end do
  end subroutine add_one

  !> What a step from U0 (dim, *) needs of a block.
  subroutine begin_solid(threads, s, u0)
    integer, intent(in) :: threads
    type(solid_t), intent(inout) :: s
    real(wp), intent(in) :: u0(:, :)
    integer :: from
    !$omp parallel do schedule(dynamic, 1) num_threads(threads)
    do from = 1, s%n, few
      call begin_elements(s, from, min(s%n, from + few - 1), u0)
    end do
  end subroutine begin_solid

end module assembly_threads
