! SPDX-License-Identifier: BSD-3-Clause
!> The elements of one rank, with nodes numbered among themselves, and what it does with them.
module mpi_domain
  use assembly_entries, only: clear_held
  use assembly_forces, only: subtract_internal_force, subtract_weighted_forces, &
      block_products, element_product
  use assembly_system, only: system_t, add_stiffness
  use base_kinds, only: wp, zero
  use linalg_graph, only: block_matrix_t, graph_from_cliques
  use mpi_tasks, only: l1
  implicit none
  private

  type, public :: domain_t
    !> Of its nodes and elements: n, dim, block (as many as the scene has, rigid where the rank
    !> has none of it), block_of, graph
    type(system_t) :: system
    integer, allocatable :: node(:)      !< (n) rows of its nodes in the scene, increasing
    !> (entries of the graph) this rank is told what mass and all else that no element gives
    !> adds there; not allocated on the first one
    logical(l1), allocatable :: is_own(:)
    type(block_matrix_t) :: matrix       !< its entries, until they are factored
    real(wp), allocatable :: u(:, :), f(:, :)   !< (dim, n) work space
  end type domain_t

  public :: make_graph, find_forces, find_weighted_forces, find_products, list_forces, &
      list_products, assemble

contains

  !> The graph of its elements and, on the first rank, of pairs of nodes that no element joins.
  subroutine make_graph(domain, pair)
    type(domain_t), intent(inout) :: domain
    integer, intent(in) :: pair(:, :)    !< (2, *)
    integer, allocatable :: first(:), member(:)
    integer :: b, k, e, m
    m = 2*size(pair, 2)
    do b = 1, size(domain%system%block)
      m = m + size(domain%system%block(b)%node)
    end do
    allocate (first(size(domain%system%block_of) + size(pair, 2) + 1), member(m))
    first(1) = 1
    e = 0
    do b = 1, size(domain%system%block)
      do k = 1, size(domain%system%block(b)%node, 2)
        e = e + 1
        first(e + 1) = first(e) + domain%system%block(b)%nodes
        member(first(e):first(e + 1) - 1) = domain%system%block(b)%node(:, k)
      end do
    end do
    do k = 1, size(pair, 2)
      first(e + k + 1) = first(e + k) + 2
      member(first(e + k):first(e + k) + 1) = pair(:, k)
    end do
    call graph_from_cliques(domain%system%n, first, member, domain%system%graph)
    if (allocated(domain%u)) deallocate (domain%u, domain%f)
    allocate (domain%u(domain%system%dim, domain%system%n))
    allocate (domain%f, mold=domain%u)
  end subroutine make_graph

  !> domain%f = - factor K u of its elements at domain%u.
  subroutine find_forces(domain, factor)
    type(domain_t), intent(inout) :: domain
    real(wp), intent(in) :: factor
    domain%f = zero
    call subtract_internal_force(domain%system, factor, domain%u, domain%f)
  end subroutine find_forces

  !> The same with a weight of each element instead of the factor.
  subroutine find_weighted_forces(domain, weight)
    type(domain_t), intent(inout) :: domain
    real(wp), intent(in) :: weight(:)
    integer :: e
    domain%f = zero
    call subtract_weighted_forces(domain%system, [(e, e=1, size(weight))], weight, domain%u, &
        domain%f)
  end subroutine find_weighted_forces

  !> u.K u of its part of each block [F L].
  subroutine find_products(domain, total)
    type(domain_t), intent(inout) :: domain
    real(wp), intent(out) :: total(:)
    call block_products(domain%system, domain%u, total)
  end subroutine find_products

  !> Some elements, one after the other, with displacements d of their nodes, (dim, *) element
  !> by element, which are replaced by - K d.
  subroutine list_forces(domain, element, d)
    type(domain_t), intent(inout) :: domain
    integer, intent(in) :: element(:)
    real(wp), intent(inout) :: d(:, :)
    integer :: k, m
    m = 0
    do k = 1, size(element)
      associate (block => domain%system%block(domain%system%block_of(element(k))))
        associate (node => block%node(:, element(k) - block%first + 1))
          domain%u(:, node) = d(:, m + 1:m + block%nodes)
          domain%f(:, node) = zero
          call subtract_weighted_forces(domain%system, element(k:k), [1.0_wp], domain%u, &
              domain%f)
          d(:, m + 1:m + block%nodes) = domain%f(:, node)
        end associate
        m = m + block%nodes
      end associate
    end do
  end subroutine list_forces

  !> d.K d of some elements [F L].
  subroutine list_products(domain, element, d, value)
    type(domain_t), intent(inout) :: domain
    integer, intent(in) :: element(:)
    real(wp), intent(in) :: d(:, :)
    real(wp), intent(out) :: value(:)
    integer :: k, m
    m = 0
    do k = 1, size(element)
      associate (block => domain%system%block(domain%system%block_of(element(k))))
        domain%u(:, block%node(:, element(k) - block%first + 1)) = d(:, m + 1:m + block%nodes)
        value(k) = element_product(domain%system, element(k), domain%u)
        m = m + block%nodes
      end associate
    end do
  end subroutine list_products

  !> Its entries of A and their diagonal in domain%f: sum of weight(e) K_e, weight (1) if it is
  !> the same of all, and at (1 or dim, pairs of its graph).
  subroutine assemble(domain, weight, at, fixed)
    type(domain_t), intent(inout) :: domain
    real(wp), intent(in) :: weight(:), at(:, :)
    logical, intent(in) :: fixed(:, :)
    integer :: e, k, d, i
    associate (s => domain%system, matrix => domain%matrix)
      if (.not. allocated(matrix%value)) &
          allocate (matrix%value(s%dim, s%dim, size(s%graph%column)))
      matrix%value = zero
      do e = 1, size(s%block_of)
        call add_stiffness(s, e, weight(min(e, size(weight))), matrix)
      end do
      do k = 1, size(s%graph%column)
        do d = 1, s%dim
          matrix%value(d, d, k) = matrix%value(d, d, k) + at(min(d, size(at, 1)), k)
        end do
      end do
      call clear_held(s%graph, fixed, matrix)
      do i = 1, s%n
        k = s%graph%position(i, i)
        domain%f(:, i) = [(matrix%value(d, d, k), d=1, s%dim)]
      end do
    end associate
  end subroutine assemble

end module mpi_domain
