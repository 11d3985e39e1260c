! SPDX-License-Identifier: BSD-3-Clause
!> Sparse factor A = L D L' in node blocks of 2 x 2 or 3 x 3, up-looking along the elimination
!> tree (Davis 2005), for symmetric positive definite A; the last nodes stay as a dense Schur
!> complement.
!> Node blocks need one index per d^2 reals and no square root. The loops over blocks are in
!> `linalg_kernels_2` and `_3`, chosen outside of them by d: their arrays have constant bounds,
!> which one interface of both could not have.
!> In large scenes the order is changed to another of the same factor, in which parts of the
!> tree that do not depend on each other come first, one after the other, then the top. In the
!> passes the parts are for several threads, each with sums of its own for the rows of the top,
!> added in the order of the parts, whatever the number of threads.
module linalg_ldlt
  use base_checks, only: checks_on, assert
  use base_kinds, only: wp, i8, zero
  use base_status, only: status_t, failed
  use linalg_graph, only: graph_t, block_matrix_t
  use linalg_kernels_2, only: eliminate_2, invert_2, forward_2, forward_part_2, backward_2
  use linalg_kernels_3, only: eliminate_3, invert_3, forward_3, forward_part_3, backward_3
  use linalg_solver, only: solver_t, demand_memory, lose_pivot, check_graph, &
      check_matrix, check_vectors
  use linalg_subtrees, only: subtrees_t, find_subtrees
  use linalg_symbolic, only: symbolic_factor, order_tree
  implicit none
  private

  type, extends(solver_t), public :: ldlt_t
    integer :: leading = 0
    integer, allocatable :: new(:)           !< (n) old -> new
    integer, allocatable :: parent(:)        !< (n) elimination tree, 0 = root
    integer, allocatable :: first(:)         !< (leading+1) start of each column of L
    integer, allocatable :: row(:)           !< row (new number) of each block of L
    real(wp), allocatable :: l(:, :, :)      !< (d, d, *) blocks below the diagonal
    real(wp), allocatable :: d_inverse(:, :) !< (d(d+1)/2, leading) of each inverse pivot
    real(wp), allocatable :: work(:, :)      !< (d, n) right-hand side in elimination order
    type(subtrees_t) :: parts                !< of the columns 1..base, n = 0: none
    integer :: base = 0                      !< columns in parts
    real(wp), allocatable :: outside(:, :, :)   !< (d, n - base, parts) sums of a pass
  contains
    procedure :: analyse => ldlt_analyse
    procedure :: factor => ldlt_factor
    procedure :: forward => ldlt_forward
    procedure :: backward => ldlt_backward
  end type ldlt_t

contains

  !> Order, elimination tree, storage.
  subroutine ldlt_analyse(this, graph, d, last, status)
    class(ldlt_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: d
    integer, intent(in) :: last(:)
    type(status_t), intent(inout) :: status
    integer, allocatable :: rows(:)
    integer :: k
    if (checks_on) call check_graph(graph, last, 'ldlt_analyse')
    if (checks_on) call assert(d == 2 .or. d == 3, 'ldlt_analyse', 'a node has 2 or 3 unknowns')
    this%n = graph%n
    this%d = d
    this%n_interface = size(last)
    this%leading = graph%n - size(last)
    call this%find_order(graph, last, trim(this%options%order), status)
    if (failed(status)) return
    if (allocated(this%parent)) &
        deallocate (this%parent, this%first, this%row, this%l, this%d_inverse, this%work)
    allocate (this%parent(graph%n), rows(graph%n), this%first(this%leading + 1))
    call symbolic_factor(graph, this%order, this%leading, this%parent, rows)
    call divide(this, graph, rows)
    this%new = this%order
    this%new(this%order) = [(k, k=1, graph%n)]
    call this%schur%plan(graph, d, last)
    this%first(1) = 1
    do k = 1, this%leading
      this%first(k + 1) = this%first(k) + rows(k)
    end do
    this%info%factor_bytes = (8_i8*d*d + 4_i8)*(this%first(this%leading + 1) - 1) &
        + (4_i8*d*(d + 1) + 4_i8)*this%leading + this%schur%bytes()
    call demand_memory(this, status)
    if (failed(status)) return
    allocate (this%row(this%first(this%leading + 1) - 1))
    allocate (this%l(d, d, size(this%row)), this%d_inverse(d*(d + 1)/2, this%leading), &
        this%work(d, graph%n))
    call this%schur%make()
  end subroutine ldlt_analyse

  !> Parts of the tree where the factor is large, and the order in which they come first.
  subroutine divide(this, graph, rows)
    class(ldlt_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    integer, intent(inout) :: rows(:)
    integer(i8), parameter :: least = 500000_i8     ! entries of the factor
    integer, allocatable :: post(:), parent(:), old(:), new(:)
    integer :: k, t
    this%parts%n = 0
    this%base = 0
    if (sum(int(rows, i8))*this%d**2 < least) return
    allocate (post(this%n), new(0:this%n))
    call order_tree(this%parent, post)
    post = pack(post, post <= this%leading)
    new = 0
    new(post) = [(k, k=1, this%leading)]
    parent = new(this%parent(post))
    call find_subtrees(parent, real(rows(post), wp), this%parts)
    if (this%parts%n == 0) return
    old = this%order
    associate (part => this%parts%part)
      this%base = count(part > 0)
      this%order(:this%leading) = [old(pack(post, part > 0)), old(pack(post, part == 0))]
      this%parts%last = [(count(part > 0 .and. part <= t), t=1, this%parts%n)]
    end associate
    this%parts%first = [1, this%parts%last(:this%parts%n - 1) + 1]
    call symbolic_factor(graph, this%order, this%leading, this%parent, rows)
    if (allocated(this%outside)) deallocate (this%outside)
    allocate (this%outside(this%d, this%n - this%base, this%parts%n))
  end subroutine divide

  !> Numerical factor: one row of L at a time, then the dense block by LAPACK.
  subroutine ldlt_factor(this, graph, matrix, status)
    class(ldlt_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    type(status_t), intent(inout) :: status
    real(wp), allocatable :: y(:, :, :)
    integer, allocatable :: filled(:), mark(:), path(:), reach(:)
    integer :: k, top
    logical :: ok
    if (checks_on) call check_matrix(this, graph, matrix, 'ldlt_factor')
    allocate (y(this%d, this%d, this%n), filled(this%leading), mark(this%n), path(this%n), &
        reach(this%n))
    y = zero
    filled = this%first(1:this%leading) - 1
    mark = 0
    this%info%null_pivots = 0
    do k = 1, this%n
      call scatter_row(this, graph, matrix, k, y, mark, path, reach, top)
      if (this%d == 2) then
        call eliminate_2(k, this%n, reach(top:this%n), this%first, this%d_inverse, this%row, &
            this%l, filled, y)
      else
        call eliminate_3(k, this%n, reach(top:this%n), this%first, this%d_inverse, this%row, &
            this%l, filled, y)
      end if
      if (k > this%leading) then
        call store_block_row(this, k, y)
        cycle
      end if
      call invert_pivot(this, k, matrix%value(:, :, &
          graph%position(this%order(k), this%order(k))), y(:, :, k), ok)
      if (.not. ok) then
        call lose_pivot(this%order(k), status)
        return
      end if
      y(:, :, k) = zero
    end do
    call this%schur%factor(status)
  end subroutine ldlt_factor

  !> Row k of A into y, and the nodes of row k of L, children before parents, in reach(top:n).
  subroutine scatter_row(this, graph, matrix, k, y, mark, path, reach, top)
    type(ldlt_t), intent(in) :: this
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    integer, intent(in) :: k
    real(wp), intent(inout) :: y(:, :, :)
    integer, intent(inout) :: mark(:), path(:), reach(:)
    integer, intent(out) :: top
    integer :: m, i, length
    top = this%n + 1
    mark(k) = k
    do m = graph%first(this%order(k)), graph%first(this%order(k) + 1) - 1
      i = this%new(graph%column(m))
      if (i > k) cycle
      y(:, :, i) = matrix%value(:, :, m)
      length = 0
      do while (i <= this%leading)
        if (mark(i) == k) exit
        length = length + 1
        path(length) = i
        mark(i) = k
        i = this%parent(i)
        if (i == 0) exit
      end do
      reach(top - length:top - 1) = path(1:length)
      top = top - length
    end do
  end subroutine scatter_row

  !> Inverse of pivot block k; original = the same block of A.
  subroutine invert_pivot(this, k, original, pivot, ok)
    type(ldlt_t), intent(inout) :: this
    integer, intent(in) :: k
    real(wp), intent(in) :: original(:, :), pivot(:, :)
    logical, intent(out) :: ok
    if (this%d == 2) then
      call invert_2(this%options%null_pivot, original, pivot, this%d_inverse(:, k), &
          this%info%null_pivots, ok)
    else
      call invert_3(this%options%null_pivot, original, pivot, this%d_inverse(:, k), &
          this%info%null_pivots, ok)
    end if
  end subroutine invert_pivot

  !> Row k of the Schur complement from y into the dense block of its body (lower triangle).
  subroutine store_block_row(this, k, y)
    type(ldlt_t), intent(inout) :: this
    integer, intent(in) :: k
    real(wp), intent(inout) :: y(:, :, :)
    integer :: i, a, b, body, before
    body = this%schur%body(k - this%leading)
    before = this%leading + this%schur%first(body) - 1
    a = this%d*(k - before - 1) + 1
    associate (l => this%schur%block(body)%l)
      do i = before + 1, k
        b = this%d*(i - before - 1) + 1
        l(a:a + this%d - 1, b:b + this%d - 1) = y(:, :, i)
        y(:, :, i) = zero
      end do
    end associate
  end subroutine store_block_row

  !> y = L^-1 b, then the leading part is divided by the pivots.
  subroutine ldlt_forward(this, b, b_interface)
    class(ldlt_t), intent(inout) :: this
    real(wp), intent(in) :: b(:, :)
    real(wp), intent(out) :: b_interface(:, :)
    if (checks_on) call check_vectors(this, b, b_interface, 'ldlt_forward')
    call to_order(this, this%base + 1, this%n, b)
    if (this%parts%n > 0) call forward_parts(this, b)
    if (this%d == 2) then
      call forward_2(this%base + 1, this%leading, this%n, this%first, this%row, this%l, &
          this%d_inverse, this%work)
    else
      call forward_3(this%base + 1, this%leading, this%n, this%first, this%row, this%l, &
          this%d_inverse, this%work)
    end if
    b_interface = this%work(:, this%leading + 1:this%n)
  end subroutine ldlt_forward

  !> The right-hand side of the nodes first..last of the order.
  pure subroutine to_order(this, first, last, b)
    class(ldlt_t), intent(inout) :: this
    integer, intent(in) :: first, last
    real(wp), intent(in) :: b(:, :)
    integer :: k
    if (this%d == 2) then
      do k = first, last
        this%work(1, k) = b(1, this%order(k))
        this%work(2, k) = b(2, this%order(k))
      end do
    else
      do k = first, last
        this%work(:, k) = b(:, this%order(k))
      end do
    end if
  end subroutine to_order

  !> The solution of these nodes.
  pure subroutine from_order(this, first, last, x)
    class(ldlt_t), intent(in) :: this
    integer, intent(in) :: first, last
    real(wp), intent(inout) :: x(:, :)
    integer :: k
    if (this%d == 2) then
      do k = first, last
        x(1, this%order(k)) = this%work(1, k)
        x(2, this%order(k)) = this%work(2, k)
      end do
    else
      do k = first, last
        x(:, this%order(k)) = this%work(:, k)
      end do
    end if
  end subroutine from_order

  !> The parts of the tree, then their sums to the rows of the top.
  subroutine forward_parts(this, b)
    class(ldlt_t), intent(inout) :: this
    real(wp), intent(in) :: b(:, :)
    integer :: k
    if (this%options%threads > 1) then
      !$omp parallel do schedule(dynamic, 1) num_threads(this%options%threads)
      do k = 1, this%parts%n
        call forward_part(this, this%parts%by_cost(k), b)
      end do
    else
      do k = 1, this%parts%n
        call forward_part(this, k, b)
      end do
    end if
    do k = 1, this%parts%n
      this%work(:, this%base + 1:) = this%work(:, this%base + 1:) + this%outside(:, :, k)
    end do
  end subroutine forward_parts

  subroutine forward_part(this, t, b)
    class(ldlt_t), intent(inout) :: this
    integer, intent(in) :: t
    real(wp), intent(in) :: b(:, :)
    call to_order(this, this%parts%first(t), this%parts%last(t), b)
    this%outside(:, :, t) = zero
    if (this%d == 2) then
      call forward_part_2(this%parts%first(t), this%parts%last(t), this%n, this%base, &
          this%first, this%row, this%l, this%d_inverse, this%work, this%outside(:, :, t))
    else
      call forward_part_3(this%parts%first(t), this%parts%last(t), this%n, this%base, &
          this%first, this%row, this%l, this%d_inverse, this%work, this%outside(:, :, t))
    end if
  end subroutine forward_part

  !> x = L'^-1 of what forward left, with x of the block given.
  subroutine ldlt_backward(this, x_interface, x)
    class(ldlt_t), intent(inout) :: this
    real(wp), intent(in) :: x_interface(:, :)
    real(wp), intent(out) :: x(:, :)
    integer :: k
    if (checks_on) call check_vectors(this, x, x_interface, 'ldlt_backward')
    this%work(:, this%leading + 1:this%n) = x_interface
    call backward_columns(this, this%base + 1, this%leading, x)
    if (this%parts%n == 0) then
      continue
    else if (this%options%threads > 1) then
      !$omp parallel do schedule(dynamic, 1) num_threads(this%options%threads)
      do k = 1, this%parts%n
        call backward_columns(this, this%parts%first(this%parts%by_cost(k)), &
            this%parts%last(this%parts%by_cost(k)), x)
      end do
    else
      call backward_columns(this, 1, this%base, x)
    end if
    call from_order(this, this%leading + 1, this%n, x)
  end subroutine ldlt_backward

  !> The columns first..last, and x of their nodes.
  subroutine backward_columns(this, first, last, x)
    class(ldlt_t), intent(inout) :: this
    integer, intent(in) :: first, last
    real(wp), intent(inout) :: x(:, :)
    if (this%d == 2) then
      call backward_2(first, last, this%n, this%first, this%row, this%l, this%work)
    else
      call backward_3(first, last, this%n, this%first, this%row, this%l, this%work)
    end if
    call from_order(this, first, last, x)
  end subroutine backward_columns

end module linalg_ldlt
