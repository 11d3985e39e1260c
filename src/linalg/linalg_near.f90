! SPDX-License-Identifier: BSD-3-Clause
!> The near part of the flexibility F = A^-1 among chosen nodes: the blocks of pairs that the
!> graph connects within so many steps (elements). A step of time couples nodes over some
!> elements times its Courant number, and less beyond by exponentials, so that A^-1 of a window
!> of elements around some nodes gives their blocks: the margin of the window decides the error.
module linalg_near
  use base_kinds, only: wp, zero, half
  use base_sort, only: sort_order, find_sorted
  use base_status, only: status_t, failed
  use linalg_graph, only: graph_t, block_matrix_t
  use linalg_ldlt, only: ldlt_t
  implicit none
  private

  !> Rows of the chosen nodes; both blocks of a pair are kept.
  type, public :: near_t
    integer :: d = 2                          !< unknowns of a node
    integer :: radius = 0                     !< steps of the graph
    integer, allocatable :: first(:)          !< (m + 1)
    integer, allocatable :: node(:)           !< the near nodes of each, by place, increasing
    real(wp), allocatable :: block(:, :, :)   !< (d, d, *) [L/F]
  contains
    procedure :: position => near_position
    procedure :: add_product => near_product
  end type near_t

  !> Nodes that one window serves, in the plane and in space.
  integer, parameter :: core_nodes(2:3) = [20, 64]

  !> A search outwards in the graph: what is reached, and from which search.
  type :: walk_t
    integer, allocatable :: queue(:)
    integer, allocatable :: seen(:)           !< (n) number of the search
    integer, allocatable :: ring(:)           !< (n) steps from its start
    integer :: searches = 0
    integer :: reached = 0
  end type walk_t

  public :: find_near, fill_near, fill_near_diagonal, move_near

contains

  !> The pairs among the nodes `last` within radius steps of the graph; blocks zero.
  subroutine find_near(graph, d, last, radius, near)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: d, last(:), radius
    type(near_t), intent(inout) :: near
    type(walk_t) :: walk
    integer, allocatable :: slot(:)
    integer :: k, pass, n
    near%d = d
    near%radius = radius
    if (allocated(near%first)) deallocate (near%first, near%node, near%block)
    allocate (near%first(size(last) + 1), near%node(0), slot(graph%n))
    slot = 0
    slot(last) = [(k, k=1, size(last))]
    call start_walk(graph%n, walk)
    do pass = 1, 2
      n = 1
      do k = 1, size(last)
        near%first(k) = n
        call go_outwards(graph, last(k:k), radius, walk)
        call list_slots(walk, slot, pass == 2, near%node, n)
      end do
      near%first(size(last) + 1) = n
      if (pass == 2) exit
      deallocate (near%node)
      allocate (near%node(n - 1))
    end do
    allocate (near%block(d, d, n - 1), source=zero)
  end subroutine find_near

  pure subroutine start_walk(n, walk)
    integer, intent(in) :: n
    type(walk_t), intent(inout) :: walk
    allocate (walk%queue(n), walk%ring(n))
    allocate (walk%seen(n), source=0)
  end subroutine start_walk

  !> All nodes within so many steps of some, nearest first: walk%queue(:walk%reached).
  pure subroutine go_outwards(graph, start, steps, walk)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: start(:), steps
    type(walk_t), intent(inout) :: walk
    integer :: head, k, i, j
    walk%searches = walk%searches + 1
    walk%reached = size(start)
    walk%queue(:size(start)) = start
    walk%seen(start) = walk%searches
    walk%ring(start) = 0
    head = 1
    do while (head <= walk%reached)
      i = walk%queue(head)
      head = head + 1
      if (walk%ring(i) == steps) exit
      do k = graph%first(i), graph%first(i + 1) - 1
        j = graph%column(k)
        if (walk%seen(j) == walk%searches) cycle
        walk%seen(j) = walk%searches
        walk%ring(j) = walk%ring(i) + 1
        walk%reached = walk%reached + 1
        walk%queue(walk%reached) = j
      end do
    end do
  end subroutine go_outwards

  !> Places of the chosen nodes that were reached, increasing, from list(n) on.
  pure subroutine list_slots(walk, slot, keeps, list, n)
    type(walk_t), intent(in) :: walk
    integer, intent(in) :: slot(:)
    logical, intent(in) :: keeps
    integer, intent(inout) :: list(:), n
    integer :: found(walk%reached), order(walk%reached)
    integer :: k, m
    m = 0
    do k = 1, walk%reached
      if (slot(walk%queue(k)) == 0) cycle
      m = m + 1
      found(m) = slot(walk%queue(k))
    end do
    if (keeps) then
      call sort_order(found(:m), order(:m))
      list(n:n + m - 1) = found(order(:m))
    end if
    n = n + m
  end subroutine list_slots

  !> Blocks of F for the matrix, from windows that reach margin steps beyond the near nodes.
  !> Fails where a window is not positive definite.
  subroutine fill_near(graph, matrix, last, margin, near, status)
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    integer, intent(in) :: last(:), margin
    type(near_t), intent(inout) :: near
    type(status_t), intent(inout) :: status
    type(walk_t) :: walk
    integer, allocatable :: slot(:), core(:)
    logical, allocatable :: is_done(:)
    integer :: k
    allocate (slot(graph%n), source=0)
    slot(last) = [(k, k=1, size(last))]
    allocate (is_done(size(last)), source=.false.)
    call start_walk(graph%n, walk)
    do k = 1, size(last)
      if (is_done(k)) cycle
      call take_core(graph, last, slot, k, near%d, is_done, walk, core)
      call fill_window(graph, matrix, last, slot, core, margin, near, walk, status)
      if (failed(status)) return
    end do
    call make_symmetric(near)
  end subroutine fill_near

  !> The next nodes (core: their places) around place k that no window has served yet.
  subroutine take_core(graph, last, slot, k, d, is_done, walk, core)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: last(:), slot(:), k, d
    logical, intent(inout) :: is_done(:)
    type(walk_t), intent(inout) :: walk
    integer, allocatable, intent(out) :: core(:)
    integer :: list(core_nodes(d)), steps, i, n
    steps = core_nodes(d) - 1
    if (d == 3) steps = 7
    call go_outwards(graph, last(k:k), steps, walk)
    n = 0
    do i = 1, walk%reached
      if (slot(walk%queue(i)) == 0) cycle
      if (is_done(slot(walk%queue(i)))) cycle
      n = n + 1
      list(n) = slot(walk%queue(i))
      is_done(list(n)) = .true.
      if (n == size(list)) exit
    end do
    core = list(:n)
  end subroutine take_core

  !> The rows of the core nodes from the factor of one window: the other unknowns are held.
  subroutine fill_window(graph, matrix, last, slot, core, margin, near, walk, status)
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    integer, intent(in) :: last(:), slot(:), core(:), margin
    type(near_t), intent(inout) :: near
    type(walk_t), intent(inout) :: walk
    type(status_t), intent(inout) :: status
    type(ldlt_t) :: solver
    type(graph_t) :: part
    type(block_matrix_t) :: own
    integer, allocatable :: node(:), seen_as(:), order(:), kept(:)
    real(wp), allocatable :: f(:, :)
    integer :: k, m
    call go_outwards(graph, last(core), near%radius + margin, walk)
    allocate (order(walk%reached))
    call sort_order(walk%queue(:walk%reached), order)
    node = walk%queue(order)
    walk%queue(:size(node)) = node
    call cut_out(graph, matrix, node, walk, part, own)
    m = 0
    allocate (kept(size(node)), seen_as(size(last)))
    do k = 1, size(node)
      if (slot(node(k)) == 0 .or. walk%ring(node(k)) > near%radius) cycle
      m = m + 1
      kept(m) = k
      seen_as(slot(node(k))) = m
    end do
    solver%options%order = 'RCM'
    call solver%analyse(part, near%d, kept(:m), status)
    if (.not. failed(status)) call solver%factor(part, own, status)
    if (failed(status)) return
    allocate (f(near%d*m, near%d*m))
    call solver%flexibility(f)
    call take_rows(core, seen_as, f, near)
  end subroutine fill_window

  !> The part of graph and matrix among some nodes, in increasing order.
  subroutine cut_out(graph, matrix, node, walk, part, own)
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    integer, intent(in) :: node(:)
    type(walk_t), intent(in) :: walk
    type(graph_t), intent(out) :: part
    type(block_matrix_t), intent(out) :: own
    integer :: k, m, n, pass
    part%n = size(node)
    allocate (part%first(size(node) + 1))
    do pass = 1, 2
      n = 1
      do k = 1, size(node)
        part%first(k) = n
        do m = graph%first(node(k)), graph%first(node(k) + 1) - 1
          if (walk%seen(graph%column(m)) /= walk%searches) cycle
          if (pass == 2) part%column(n) = find_sorted(node, graph%column(m))
          if (pass == 2) own%value(:, :, n) = matrix%value(:, :, m)
          n = n + 1
        end do
      end do
      part%first(size(node) + 1) = n
      if (pass == 1) allocate (part%column(n - 1), own%value(size(matrix%value, 1), &
          size(matrix%value, 2), n - 1))
    end do
  end subroutine cut_out

  !> Rows of the core nodes from the flexibility f of a window; seen_as: their places in it.
  pure subroutine take_rows(core, seen_as, f, near)
    integer, intent(in) :: core(:), seen_as(:)
    real(wp), intent(in) :: f(:, :)
    type(near_t), intent(inout) :: near
    integer :: k, m, i, j, d
    d = near%d
    do k = 1, size(core)
      i = d*(seen_as(core(k)) - 1)
      do m = near%first(core(k)), near%first(core(k) + 1) - 1
        j = d*(seen_as(near%node(m)) - 1)
        near%block(:, :, m) = f(i + 1:i + d, j + 1:j + d)
      end do
    end do
  end subroutine take_rows

  !> Two windows give a pair twice: the mean of both.
  pure subroutine make_symmetric(near)
    type(near_t), intent(inout) :: near
    integer :: k, m, other, i, j
    real(wp) :: mean
    do k = 1, size(near%first) - 1
      do m = near%first(k), near%first(k + 1) - 1
        if (near%node(m) < k) cycle
        other = near%position(near%node(m), k)
        do j = 1, near%d
          do i = 1, near%d
            mean = half*(near%block(i, j, m) + near%block(j, i, other))
            near%block(i, j, m) = mean
            near%block(j, i, other) = mean
          end do
        end do
      end do
    end do
  end subroutine make_symmetric

  !> Blocks of a diagonal flexibility (d, m): radius 0, nothing is left out.
  pure subroutine fill_near_diagonal(inverse, near)
    real(wp), intent(in) :: inverse(:, :)
    type(near_t), intent(inout) :: near
    integer :: k, i
    near%block = zero
    do k = 1, size(inverse, 2)
      do i = 1, near%d
        near%block(i, i, near%position(k, k)) = inverse(i, k)
      end do
    end do
  end subroutine fill_near_diagonal

  !> Where the block of places i and j stands; 0 where they are not near.
  pure integer function near_position(this, i, j)
    class(near_t), intent(in) :: this
    integer, intent(in) :: i, j
    near_position = find_sorted(this%node(this%first(i):this%first(i + 1) - 1), j)
    if (near_position > 0) near_position = near_position + this%first(i) - 1
  end function near_position

  !> x = x + factor F f with the near part alone, both (d, m).
  pure subroutine near_product(this, factor, f, x)
    class(near_t), intent(in) :: this
    real(wp), intent(in) :: factor, f(:, :)
    real(wp), intent(inout) :: x(:, :)
    real(wp) :: own(this%d)
    integer :: k, m, j
    do k = 1, size(this%first) - 1
      own = zero
      do m = this%first(k), this%first(k + 1) - 1
        do j = 1, this%d
          own = own + this%block(:, j, m)*f(j, this%node(m))
        end do
      end do
      x(:, k) = x(:, k) + factor*own
    end do
  end subroutine near_product

  !> Moves all storage; from is empty then.
  pure subroutine move_near(from, to)
    type(near_t), intent(inout) :: from, to
    to%d = from%d
    to%radius = from%radius
    call move_alloc(from%first, to%first)
    call move_alloc(from%node, to%node)
    call move_alloc(from%block, to%block)
  end subroutine move_near

end module linalg_near
