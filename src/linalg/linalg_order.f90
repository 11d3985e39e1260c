! SPDX-License-Identifier: BSD-3-Clause
!> Elimination orders of a node graph, with chosen nodes kept last, and what each would cost.
module linalg_order
  use, intrinsic :: iso_c_binding, only: c_int, c_ptr, c_null_ptr
  use base_kinds, only: i8
  use base_sort, only: sort_order
  use base_status, only: status_t, fail, failed, status_numerical, status_deck
  use linalg_graph, only: graph_t
  use linalg_symbolic, only: count_factor
  implicit none
  private
  public :: choose_order, reverse_cuthill_mckee

  !> The orders and their names; AUTO is the one that costs least.
  integer, parameter, public :: order_natural = 1, order_rcm = 2, order_metis = 3
  character(7), parameter, public :: order_names(3) = [character(7) :: 'NATURAL', 'RCM', &
      'METIS']

  !> Below this many multiplications METIS is not asked: its own run would cost more than it
  !> saves. Nor below so many of each node, which are those of a strip.
  integer(i8), parameter :: metis_threshold = 2000000_i8, strip = 10_i8

  interface
    integer(c_int) function metis_node_nd(nvtxs, xadj, adjncy, vwgt, options, perm, &
        iperm) bind(c, name='METIS_NodeND')
      import :: c_int, c_ptr
      integer(c_int), intent(in) :: nvtxs
      integer(c_int), intent(in) :: xadj(*)
      integer(c_int), intent(in) :: adjncy(*)
      type(c_ptr), value, intent(in) :: vwgt
      type(c_ptr), value, intent(in) :: options
      integer(c_int), intent(out) :: perm(*)
      integer(c_int), intent(out) :: iperm(*)
    end function metis_node_nd
  end interface

contains

  !> Order of the nodes (new -> old) by name, one of order_names, or AUTO = the one whose
  !> factor costs the fewest multiplications. The nodes of `last` come last, in their own order.
  subroutine choose_order(graph, last, wanted, order, chosen, flops, status)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: last(:)
    character(*), intent(in) :: wanted
    integer, allocatable, intent(out) :: order(:)
    character(:), allocatable, intent(out) :: chosen
    integer(i8), intent(out) :: flops
    type(status_t), intent(inout) :: status
    integer, allocatable :: trial(:), leading(:)
    integer(i8) :: cost
    integer :: k, n
    flops = huge(flops)
    chosen = ''
    call leading_nodes(graph%n, last, leading)
    n = size(leading)
    do k = 1, size(order_names)
      if (wanted /= 'AUTO' .and. wanted /= order_names(k)) cycle
      if (wanted == 'AUTO' .and. k == order_metis .and. flops < max(metis_threshold, &
          strip*n)) exit
      allocate (trial(graph%n))
      call one_order(graph, leading, last, k, trial(:n), status)
      if (failed(status)) return
      trial(n + 1:) = last
      cost = count_factor(graph, trial, n)
      if (cost < flops) then
        flops = cost
        call move_alloc(trial, order)
        chosen = trim(order_names(k))
      else
        deallocate (trial)
      end if
    end do
    if (.not. allocated(order)) call fail(status, status_deck, 'unknown order "'//wanted//'"')
  end subroutine choose_order

  !> All nodes that are not in `last`.
  pure subroutine leading_nodes(n, last, leading)
    integer, intent(in) :: n
    integer, intent(in) :: last(:)
    integer, allocatable, intent(out) :: leading(:)
    logical :: is_leading(n)
    integer :: i, k
    is_leading = .true.
    is_leading(last) = .false.
    ! Not by PACK: where memory ends it ends the program with a trace.
    allocate (leading(count(is_leading)))
    i = 0
    do k = 1, n
      if (.not. is_leading(k)) cycle
      i = i + 1
      leading(i) = k
    end do
  end subroutine leading_nodes

  subroutine one_order(graph, nodes, last, kind, order, status)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: nodes(:), last(:)
    integer, intent(in) :: kind
    integer, intent(out) :: order(:)
    type(status_t), intent(inout) :: status
    select case (kind)
    case (order_rcm)
      call reverse_cuthill_mckee(graph, nodes, last, order)
    case (order_metis)
      call metis_order(graph, nodes, order, status)
    case default
      order = nodes
    end select
  end subroutine one_order

  !> Reverse Cuthill-McKee (1969; George 1971) on the subgraph of `nodes`: first outwards from
  !> the nodes that come last, so that they gather no fill from afar, then from nodes of least
  !> degree.
  pure subroutine reverse_cuthill_mckee(graph, nodes, last, order)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: nodes(:), last(:)
    integer, intent(out) :: order(:)
    integer, allocatable :: by_degree(:), degree(:)
    logical, allocatable :: free(:)
    integer :: n, head, tail, start, k
    n = size(nodes)
    allocate (by_degree(n), free(graph%n))
    free = .false.
    free(nodes) = .true.
    allocate (degree(n))
    degree = graph%first(nodes + 1) - graph%first(nodes)
    call sort_order(degree, by_degree)
    head = 0
    tail = 0
    do k = 1, size(last)
      call visit_neighbours(graph, last(k), free, order, tail)
    end do
    start = 1
    do while (tail < n)
      if (head == tail) then
        do while (.not. free(nodes(by_degree(start))))
          start = start + 1
        end do
        tail = tail + 1
        order(tail) = nodes(by_degree(start))
        free(order(tail)) = .false.
      end if
      head = head + 1
      call visit_neighbours(graph, order(head), free, order, tail)
    end do
    order = order(n:1:-1)
  end subroutine reverse_cuthill_mckee

  !> Appends the free neighbours of a node to the order, those of least degree first.
  pure subroutine visit_neighbours(graph, node, free, order, tail)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: node
    logical, intent(inout) :: free(:)
    integer, intent(inout) :: order(:), tail
    integer :: k, first
    first = tail + 1
    do k = graph%first(node), graph%first(node + 1) - 1
      if (.not. free(graph%column(k))) cycle
      free(graph%column(k)) = .false.
      tail = tail + 1
      order(tail) = graph%column(k)
    end do
    call sort_by_degree(graph, order(first:tail))
  end subroutine visit_neighbours

  pure subroutine sort_by_degree(graph, nodes)
    type(graph_t), intent(in) :: graph
    integer, intent(inout) :: nodes(:)
    integer :: order(size(nodes))
    call sort_order(graph%first(nodes + 1) - graph%first(nodes), order)
    nodes = nodes(order)
  end subroutine sort_by_degree

  !> Nested dissection by METIS (Karypis & Kumar 1998) on the subgraph of `nodes`.
  subroutine metis_order(graph, nodes, order, status)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: nodes(:)
    integer, intent(out) :: order(:)
    type(status_t), intent(inout) :: status
    integer(c_int), allocatable :: xadj(:), adjncy(:), perm(:), iperm(:)
    integer, allocatable :: local(:)
    integer(c_int), allocatable, volatile :: room(:)
    integer :: n, k, m, length, info
    n = size(nodes)
    if (n < 2) then
      order = nodes
      return
    end if
    allocate (local(graph%n), xadj(n + 1), adjncy(size(graph%column)), perm(n), iperm(n))
    local = 0
    local(nodes) = [(k, k=1, n)]
    length = 0
    do k = 1, n
      xadj(k) = int(length, c_int)
      do m = graph%first(nodes(k)), graph%first(nodes(k) + 1) - 1
        if (local(graph%column(m)) == 0 .or. graph%column(m) == nodes(k)) cycle
        length = length + 1
        adjncy(length) = int(local(graph%column(m)) - 1, c_int)
      end do
    end do
    xadj(n + 1) = int(length, c_int)
    ! METIS does not survive a lack of memory; it takes five times the graph.
    allocate (room(8*(n + length) + 100000))
    deallocate (room)
    info = int(metis_node_nd(int(n, c_int), xadj, adjncy, c_null_ptr, c_null_ptr, perm, iperm))
    if (info /= 1) call fail(status, status_numerical, 'METIS found no elimination order', &
        hint='choose ORDER '//trim(order_names(order_rcm))//' on *BIPACT_SOLVER')
    order = nodes(perm + 1)
  end subroutine metis_order

end module linalg_order
