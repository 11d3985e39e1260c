! SPDX-License-Identifier: BSD-3-Clause
!> Every rank but the first: it does what the first one asks until that lets it go.
module mpi_worker
  use assembly_blocks, only: largest_stiffness
  use base_kinds, only: wp, zero
  use base_system, only: peak_memory
  use linalg_graph, only: graph_t, block_matrix_t
  use mpi_domain, only: domain_t, find_forces, find_weighted_forces, find_products, &
      list_forces, list_products, assemble
  use mpi_engine, only: engine_t, open_engine, close_engine, analyse_engine, factor_engine, &
      condense, expand
  use mpi_link, only: link_t, header_length, wait_for_header, send_numbers, receive_numbers, &
      receive_integers
  use mpi_share, only: receive_domain
  use mpi_tasks, only: task_leave, task_share, task_forces, task_weighted_forces, &
      task_list_forces, task_list_products, task_products, task_assemble, task_largest, &
      task_analyse, task_factor, task_condense, task_expand, task_close, task_measure, &
      most_engines
  implicit none
  private
  public :: serve

contains

  !> One task after the other.
  subroutine serve(link)
    type(link_t), intent(in) :: link
    type(domain_t) :: domain
    type(engine_t) :: engine(most_engines)
    real(wp) :: header(header_length)
    do
      call wait_for_header(link, header)
      select case (nint(header(1)))
      case (task_leave)
        return
      case (task_share)
        call receive_domain(link, header, domain)
      case (task_analyse, task_factor, task_condense, task_expand, task_close)
        call serve_engine(link, header, domain, engine(nint(header(2))))
      case (task_list_forces, task_list_products)
        call serve_list(link, header, domain)
      case default
        call serve_elements(link, header, domain)
      end select
    end do
  end subroutine serve

  !> Work on all its elements.
  subroutine serve_elements(link, header, domain)
    type(link_t), intent(in) :: link
    real(wp), intent(in) :: header(header_length)
    type(domain_t), intent(inout) :: domain
    real(wp), allocatable :: weight(:), total(:)
    select case (nint(header(1)))
    case (task_forces)
      call receive_numbers(link, 0, size(domain%u), domain%u)
      call find_forces(domain, header(2))
      call send_numbers(link, 0, size(domain%f), domain%f)
    case (task_weighted_forces)
      allocate (weight(size(domain%system%block_of)))
      call receive_numbers(link, 0, size(weight), weight)
      call receive_numbers(link, 0, size(domain%u), domain%u)
      call find_weighted_forces(domain, weight)
      call send_numbers(link, 0, size(domain%f), domain%f)
    case (task_products)
      allocate (total(size(domain%system%block)))
      call receive_numbers(link, 0, size(domain%u), domain%u)
      call find_products(domain, total)
      call send_numbers(link, 0, size(total), total)
    case (task_largest)
      call send_numbers(link, 0, 1, [largest_stiffness(domain%system%block)])
    case (task_measure)
      call send_numbers(link, 0, 1, [real(peak_memory(), wp)])
    case (task_assemble)
      call serve_assembly(link, header, domain)
    end select
  end subroutine serve_elements

  subroutine serve_assembly(link, header, domain)
    type(link_t), intent(in) :: link
    real(wp), intent(in) :: header(header_length)
    type(domain_t), intent(inout) :: domain
    real(wp), allocatable :: weight(:), at(:, :), told(:, :)
    integer, allocatable :: fixed(:, :)
    integer :: k, n
    allocate (weight(nint(header(2))))
    allocate (at(nint(header(3)), size(domain%is_own)), source=zero)
    allocate (told(nint(header(3)), count(domain%is_own)))
    allocate (fixed(domain%system%dim, domain%system%n))
    call receive_numbers(link, 0, size(weight), weight)
    call receive_numbers(link, 0, size(told), told)
    n = 0
    do k = 1, size(domain%is_own)
      if (.not. domain%is_own(k)) cycle
      n = n + 1
      at(:, k) = told(:, n)
    end do
    deallocate (told)
    call receive_integers(link, 0, size(fixed), fixed)
    call assemble(domain, weight, at, fixed == 1)
    call send_numbers(link, 0, size(domain%f), domain%f)
  end subroutine serve_assembly

  !> Work on some elements; numbers of the list and of the nodes in it are in the header.
  subroutine serve_list(link, header, domain)
    type(link_t), intent(in) :: link
    real(wp), intent(in) :: header(header_length)
    type(domain_t), intent(inout) :: domain
    integer :: element(nint(header(2)))
    real(wp), allocatable :: d(:, :), value(:)
    allocate (d(domain%system%dim, nint(header(3))))
    call receive_integers(link, 0, size(element), element)
    call receive_numbers(link, 0, size(d), d)
    if (nint(header(1)) == task_list_forces) then
      call list_forces(domain, element, d)
      call send_numbers(link, 0, size(d), d)
    else
      allocate (value(size(element)))
      call list_products(domain, element, d, value)
      call send_numbers(link, 0, size(value), value)
    end if
  end subroutine serve_list

  !> Its part of a factor. Of a matrix that the first rank has alone it has no entries.
  subroutine serve_engine(link, header, domain, engine)
    type(link_t), intent(in) :: link
    real(wp), intent(in) :: header(header_length)
    type(domain_t), intent(inout) :: domain
    type(engine_t), intent(inout) :: engine
    type(graph_t) :: no_graph
    type(block_matrix_t) :: no_matrix
    real(wp) :: none(0, 0)
    real(wp), allocatable :: no_block(:, :)
    integer :: info(2)
    logical :: is_shared
    allocate (no_graph%first(1), source=1)
    allocate (no_graph%column(0))
    is_shared = nint(header(3)) == 1
    select case (nint(header(1)))
    case (task_analyse)
      if (.not. associated(engine%mumps)) call open_engine(link, engine)
      if (is_shared) then
        call analyse_engine(engine, nint(header(4)), nint(header(5)), domain%system%graph, &
            domain%node, nint(header(6)), [integer ::], info)
      else
        call analyse_engine(engine, nint(header(4)), nint(header(5)), no_graph, &
            [integer ::], nint(header(6)), [integer ::], info)
      end if
    case (task_factor)
      if (is_shared) then
        call factor_engine(engine, nint(header(5)), domain%system%graph, domain%matrix, &
            .false., no_block, info)
      else
        call factor_engine(engine, nint(header(5)), no_graph, no_matrix, .true., no_block, info)
      end if
    case (task_condense)
      call condense(engine, none, none)
    case (task_expand)
      call expand(engine, none, none)
    case (task_close)
      call close_engine(engine)
    end select
  end subroutine serve_engine

end module mpi_worker
