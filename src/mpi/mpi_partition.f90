! SPDX-License-Identifier: BSD-3-Clause
!> Which rank has which element: domains with few nodes between them, by METIS (Karypis & Kumar
!> 1998). The first rank, which has the whole scene besides, has a twentieth of the elements of
!> two ranks and a sixtieth of those of three; the others have as many as each other.
module mpi_partition
  use, intrinsic :: iso_c_binding, only: c_int, c_float, c_ptr, c_null_ptr
  use assembly_blocks, only: element_block_t
  use base_status, only: status_t, fail, failed, status_numerical, status_deck
  use base_strings, only: to_text
  implicit none
  private
  public :: find_owners

  interface
    integer(c_int) function metis_part_mesh_dual(ne, nn, eptr, eind, vwgt, vsize, ncommon, &
        nparts, tpwgts, options, objval, epart, npart) bind(c, name='METIS_PartMeshDual')
      import :: c_int, c_ptr, c_float
      integer(c_int), intent(in) :: ne, nn
      integer(c_int), intent(inout) :: eptr(*), eind(*)
      type(c_ptr), value, intent(in) :: vwgt, vsize
      integer(c_int), intent(in) :: ncommon, nparts
      real(c_float), intent(in) :: tpwgts(*)
      type(c_ptr), value, intent(in) :: options
      integer(c_int), intent(out) :: objval, epart(*), npart(*)
    end function metis_part_mesh_dual
  end interface

contains

  !> owner (elements): the rank, from 0, of each element that is strained; -1 of rigid parts.
  !> Fails where there are more ranks than elements; one may be left without where parts are
  !> rigid.
  subroutine find_owners(ranks, nodes, dim, block, block_of, owner, status)
    integer, intent(in) :: ranks, nodes, dim
    type(element_block_t), intent(in) :: block(:)
    integer, intent(in) :: block_of(:)
    integer, allocatable, intent(out) :: owner(:)
    type(status_t), intent(inout) :: status
    integer(c_int), allocatable :: start(:), member(:), part(:), node_part(:)
    integer, allocatable :: list(:)
    real(c_float) :: first_share    ! of an equal share, for equal memory
    real(c_float) :: share(ranks)
    integer(c_int) :: cut, info
    integer :: e, k, m
    list = pack([(e, e=1, size(block_of))], .not. block(block_of)%is_rigid)
    allocate (owner(size(block_of)), source=-1)
    if (size(owner) < ranks) call fail(status, status_deck, 'more ranks ('//to_text(ranks)// &
        ') than elements ('//to_text(size(owner))//')', &
        hint='start bipact-mpi with fewer ranks: mpirun -n '//to_text(size(owner)))
    if (failed(status)) return
    if (size(list) <= ranks) then
      owner(list) = [(k, k=0, size(list) - 1)]
      return
    end if
    m = 0
    do k = 1, size(list)
      m = m + block(block_of(list(k)))%nodes
    end do
    allocate (start(size(list) + 1), member(m), part(size(list)), node_part(nodes))
    start(1) = 0
    do k = 1, size(list)
      associate (own => block(block_of(list(k))))
        start(k + 1) = start(k) + own%nodes
        member(start(k) + 1:start(k + 1)) = own%node(:, list(k) - own%first + 1) - 1
      end associate
    end do
    part = 0
    first_share = merge(0.1_c_float, 0.05_c_float, ranks == 2)
    share = (1.0_c_float - first_share/real(ranks, c_float))/max(1, ranks - 1)
    share(1) = 1.0_c_float - sum(share(2:))
    info = 1
    if (ranks > 1) info = metis_part_mesh_dual(int(size(list), c_int), int(nodes, c_int), &
        start, member, c_null_ptr, c_null_ptr, int(dim, c_int), int(ranks, c_int), &
        share, c_null_ptr, cut, part, node_part)
    if (info /= 1) call fail(status, status_numerical, 'METIS found no domains', &
        hint='start bipact-mpi with fewer ranks')
    owner(list) = part
    call fill_empty(ranks, list, owner)
  end subroutine find_owners

  !> Each rank gets at least one element.
  pure subroutine fill_empty(ranks, list, owner)
    integer, intent(in) :: ranks, list(:)
    integer, intent(inout) :: owner(:)
    integer :: has(0:ranks - 1), k, r
    has = 0
    do k = 1, size(list)
      has(owner(list(k))) = has(owner(list(k))) + 1
    end do
    do r = 0, ranks - 1
      if (has(r) > 0) cycle
      do k = 1, size(list)
        if (has(owner(list(k))) > 1) exit
      end do
      has(owner(list(k))) = has(owner(list(k))) - 1
      owner(list(k)) = r
      has(r) = 1
    end do
  end subroutine fill_empty

end module mpi_partition
