! SPDX-License-Identifier: BSD-3-Clause
!> The elements in blocks of one type and part, each with its nodes and stiffness.
module assembly_blocks
  use assembly_classes, only: classes_t, is_worth_classes, finish_classes
  use assembly_ring, only: ring_unknowns
  use base_kinds, only: wp, zero
  use model_data, only: model_t
  use model_mesh, only: block_t
  implicit none
  private

  type, extends(block_t), public :: element_block_t
    integer :: nodes = 0                    !< of an element
    logical :: is_rigid = .false.           !< never strained: no stiffness, not on the graph
    logical :: is_ring = .false.            !< its elements are turned about the y axis
    integer, allocatable :: node(:, :)      !< (nodes, n) rows of nodes
    !> (m, m, n) stiffness of the other nodes relative to node 1, m = dim (nodes - 1) [F/L]: a
    !> translation of the element drops out before anything is multiplied, so a flying body has
    !> no internal force at all. Of a ring that of the unknowns of assembly_ring. With classes
    !> (m, m, classes): element e has that of its class.
    real(wp), allocatable :: stiffness(:, :, :)
    !> (n) only on a regular mesh: elements of one class have the same matrix, bit for bit
    integer, allocatable :: class(:)
  end type element_block_t

  !> Elements whose stiffness is found before it is sorted.
  integer, parameter :: chunk = 256

  public :: make_blocks, assemble_stiffness, find_stiffness, sort_stiffness, stored_at, &
      whole_stiffness, largest_stiffness

contains

  !> The blocks of the mesh with their nodes.
  pure subroutine make_blocks(model, block, block_of)
    type(model_t), intent(in) :: model
    type(element_block_t), allocatable, intent(out) :: block(:)
    integer, allocatable, intent(out) :: block_of(:)
    integer :: b, n
    allocate (block(size(model%mesh%block)), block_of(model%mesh%n))
    do b = 1, size(block)
      associate (own => block(b), from => model%mesh%block(b), mesh => model%mesh)
        own%block_t = from
        own%is_rigid = model%part(from%part)%is_rigid
        own%is_ring = mesh%kind(from%type)%item%is_ring
        own%nodes = mesh%count_of(from%first)
        n = from%last - from%first + 1
        own%node = reshape(mesh%node(mesh%first(from%first):mesh%first(from%last + 1) - 1), &
            [own%nodes, n])
        block_of(from%first:from%last) = b
      end associate
    end do
  end subroutine make_blocks

  !> The stiffness of their elements.
  subroutine assemble_stiffness(model, block)
    type(model_t), intent(in) :: model
    type(element_block_t), intent(inout) :: block(:)
    integer :: b, n
    do b = 1, size(block)
      if (block(b)%is_rigid) cycle
      n = size(block(b)%node, 2)
      if (is_worth_classes(order_of(size(model%x, 1), block(b)), n)) then
        call find_classes(model, block(b))
      else
        call find_stiffness(model, block(b), 1, n, block(b)%stiffness)
      end if
    end do
  end subroutine assemble_stiffness

  !> Unknowns of an element whose stiffness is kept.
  pure integer function order_of(d, block)
    integer, intent(in) :: d
    type(element_block_t), intent(in) :: block
    order_of = d*(block%nodes - 1)
    if (block%is_ring) order_of = size(ring_unknowns(block%nodes))
  end function order_of

  !> Stiffness of a block, one of each class: memory that no class fills is not touched.
  subroutine find_classes(model, block)
    type(model_t), intent(in) :: model
    type(element_block_t), intent(inout) :: block
    type(classes_t) :: classes
    real(wp), allocatable :: some(:, :, :)
    integer :: from, e, n, m
    n = size(block%node, 2)
    m = order_of(size(model%x, 1), block)
    allocate (block%class(n), block%stiffness(m, m, n))
    call classes%begin(n)
    do from = 1, n, chunk
      call find_stiffness(model, block, from, min(n, from + chunk - 1), some)
      do e = from, min(n, from + chunk - 1)
        call classes%add(some(:, :, e - from + 1), block%stiffness, block%class(e))
      end do
    end do
    call finish_classes(classes%n, block%stiffness, block%class)
  end subroutine find_classes

  !> The same of a block that has the stiffness of all its elements.
  pure subroutine sort_stiffness(block)
    type(element_block_t), intent(inout) :: block
    type(classes_t) :: classes
    real(wp), allocatable :: ke(:, :)
    integer :: e
    associate (n => size(block%node, 2), m => size(block%stiffness, 1))
      if (.not. is_worth_classes(m, n)) return
      allocate (block%class(n), ke(m, m))
      call classes%begin(n)
      do e = 1, n
        ke = block%stiffness(:, :, e)
        call classes%add(ke, block%stiffness, block%class(e))
      end do
    end associate
    call finish_classes(classes%n, block%stiffness, block%class)
  end subroutine sort_stiffness

  !> Where the stiffness of element e of a block is kept.
  pure integer function stored_at(block, e)
    type(element_block_t), intent(in) :: block
    integer, intent(in) :: e
    stored_at = e
    if (allocated(block%class)) stored_at = block%class(e)
  end function stored_at

  !> That of elements from..to of a block, its stiffness or a part of it.
  subroutine find_stiffness(model, block, from, to, stiffness)
    type(model_t), intent(in) :: model
    type(element_block_t), intent(in) :: block
    integer, intent(in) :: from, to
    real(wp), allocatable, intent(inout) :: stiffness(:, :, :)
    real(wp), allocatable :: ke(:, :), moduli(:, :)
    integer, allocatable :: dof(:)
    integer :: i, m, d
    d = size(model%x, 1)
    m = d*block%nodes
    if (block%is_ring) then
      dof = ring_unknowns(block%nodes)
    else
      dof = [(i, i=d + 1, m)]
    end if
    if (allocated(stiffness)) deallocate (stiffness)
    allocate (ke(m, m), stiffness(size(dof), size(dof), to - from + 1))
    associate (part => model%part(block%part), &
        element => model%mesh%kind(block%type)%item)
      moduli = model%material(part%material)%item%moduli(part%plane)
      do i = from, to
        call element%stiffness(model%x(:, block%node(:, i)), moduli, part%thickness, ke)
        stiffness(:, :, i - from + 1) = ke(dof, dof)
      end do
    end associate
  end subroutine find_stiffness

  !> factor * K of an element, from the rows and columns relative to node 1: those of node 1 are
  !> minus the sums of the others.
  pure subroutine whole_stiffness(d, factor, k, ke)
    integer, intent(in) :: d
    real(wp), intent(in) :: factor, k(:, :)
    real(wp), intent(out) :: ke(:, :)
    integer :: i, m
    m = size(ke, 1)
    ke(d + 1:, d + 1:) = factor*k
    do i = 1, d
      ke(i, d + 1:) = -added(ke(i + d:m:d, d + 1:))
    end do
    ke(d + 1:, 1:d) = transpose(ke(1:d, d + 1:))
    do i = 1, d
      ke(i, 1:d) = -added(ke(i + d:m:d, 1:d))
    end do
  end subroutine whole_stiffness

  !> Sum of the rows, in their order.
  pure function added(row) result(total)
    real(wp), intent(in) :: row(:, :)
    real(wp) :: total(size(row, 2))
    integer :: k
    total = row(1, :)
    do k = 2, size(row, 1)
      total = total + row(k, :)
    end do
  end function added

  !> Largest entry on a diagonal of element stiffness [F/L].
  pure real(wp) function largest_stiffness(block)
    type(element_block_t), intent(in) :: block(:)
    integer :: b, e, i
    largest_stiffness = zero
    do b = 1, size(block)
      if (block(b)%is_rigid) cycle
      associate (k => block(b)%stiffness)
        do e = 1, size(k, 3)
          do i = 1, size(k, 1)
            largest_stiffness = max(largest_stiffness, k(i, i, e))
          end do
        end do
      end associate
    end do
  end function largest_stiffness

end module assembly_blocks
