! SPDX-License-Identifier: BSD-3-Clause
!> Sparse factor A = L D L' in 2 x 2 node blocks, up-looking along the elimination tree (Davis
!> 2005), for symmetric positive definite A; the last nodes stay as a dense Schur complement.
!> Node blocks need one index per four reals and no square root.
module linalg_ldlt
  use base_checks, only: checks_on
  use base_kinds, only: wp, i8, zero
  use base_status, only: status_t, fail, failed, status_numerical
  use base_strings, only: to_text
  use linalg_graph, only: graph_t, block_matrix_t
  use linalg_dense, only: dense_factor
  use linalg_order, only: choose_order
  use linalg_solver, only: solver_t, check_graph, check_matrix, check_vectors
  use linalg_symbolic, only: symbolic_factor
  implicit none
  private

  type, extends(solver_t), public :: ldlt_t
    integer :: leading = 0
    integer, allocatable :: new(:)           !< (n) old -> new
    integer, allocatable :: parent(:)        !< (n) elimination tree, 0 = root
    integer, allocatable :: first(:)         !< (leading+1) start of each column of L
    integer, allocatable :: row(:)           !< row (new number) of each block of L
    real(wp), allocatable :: l(:, :, :)      !< (2, 2, *) blocks below the diagonal
    real(wp), allocatable :: d_inverse(:, :) !< (3, leading) 11, 21, 22 of each inverse pivot
    real(wp), allocatable :: work(:, :)      !< (2, n) right-hand side in elimination order
  contains
    procedure :: analyse => ldlt_analyse
    procedure :: factor => ldlt_factor
    procedure :: forward => ldlt_forward
    procedure :: backward => ldlt_backward
  end type ldlt_t

contains

  !> Order, elimination tree, storage.
  subroutine ldlt_analyse(this, graph, last, status)
    class(ldlt_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: last(:)
    type(status_t), intent(inout) :: status
    integer, allocatable :: rows(:)
    integer :: k
    if (checks_on) call check_graph(graph, last, 'ldlt_analyse')
    this%n = graph%n
    this%n_interface = size(last)
    this%leading = graph%n - size(last)
    call choose_order(graph, last, trim(this%options%order), this%order, this%info%order, &
        this%info%multiplications, status)
    if (failed(status)) return
    this%new = this%order
    this%new(this%order) = [(k, k=1, graph%n)]
    if (allocated(this%parent)) &
        deallocate (this%parent, this%first, this%row, this%l, this%d_inverse, this%work)
    allocate (this%parent(graph%n), rows(graph%n), this%first(this%leading + 1))
    call symbolic_factor(graph, this%order, this%leading, this%parent, rows)
    this%first(1) = 1
    do k = 1, this%leading
      this%first(k + 1) = this%first(k) + rows(k)
    end do
    allocate (this%row(this%first(this%leading + 1) - 1))
    allocate (this%l(2, 2, size(this%row)), this%d_inverse(3, this%leading), &
        this%work(2, graph%n))
    this%schur%l = reshape([real(wp) ::], [2*size(last), 2*size(last)], pad=[zero])
    this%info%factor_bytes = 36_i8*size(this%row, kind=i8) + 28_i8*this%leading &
        + 32_i8*size(last, kind=i8)**2
  end subroutine ldlt_analyse

  !> Numerical factor: one row of L at a time, then the dense block by LAPACK.
  subroutine ldlt_factor(this, graph, matrix, status)
    class(ldlt_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    type(status_t), intent(inout) :: status
    real(wp), allocatable :: y(:, :, :)
    integer, allocatable :: filled(:), mark(:), path(:), reach(:)
    integer :: k, top
    if (checks_on) call check_matrix(this, graph, matrix, 'ldlt_factor')
    allocate (y(2, 2, this%n), filled(this%leading), mark(this%n), path(this%n), reach(this%n))
    y = zero
    filled = this%first(1:this%leading) - 1
    mark = 0
    this%info%null_pivots = 0
    do k = 1, this%n
      call scatter_row(this, graph, matrix, k, y, mark, path, reach, top)
      call eliminate_row(this, k, reach(top:this%n), y, filled)
      if (k <= this%leading) then
        call invert_pivot(this, matrix%value(:, :, &
            graph%position(this%order(k), this%order(k))), k, y(:, :, k), status)
        y(:, :, k) = zero
      else
        call store_block_row(this, k, y)
      end if
      if (failed(status)) return
    end do
    call dense_factor(this%schur, status)
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

  !> Sparse triangular solve for row k of L; y(:,:,k) becomes the pivot block.
  subroutine eliminate_row(this, k, reach, y, filled)
    type(ldlt_t), intent(inout) :: this
    integer, intent(in) :: k
    integer, intent(in) :: reach(:)
    real(wp), intent(inout) :: y(:, :, :)
    integer, intent(inout) :: filled(:)
    real(wp) :: a11, a21, a12, a22, l11, l21, l12, l22
    integer :: m, j, p, i
    do m = 1, size(reach)
      j = reach(m)
      a11 = y(1, 1, j)
      a21 = y(2, 1, j)
      a12 = y(1, 2, j)
      a22 = y(2, 2, j)
      y(:, :, j) = zero
      do p = this%first(j), filled(j)
        i = this%row(p)
        y(1, 1, i) = y(1, 1, i) - (a11*this%l(1, 1, p) + a12*this%l(1, 2, p))
        y(2, 1, i) = y(2, 1, i) - (a21*this%l(1, 1, p) + a22*this%l(1, 2, p))
        y(1, 2, i) = y(1, 2, i) - (a11*this%l(2, 1, p) + a12*this%l(2, 2, p))
        y(2, 2, i) = y(2, 2, i) - (a21*this%l(2, 1, p) + a22*this%l(2, 2, p))
      end do
      l11 = a11*this%d_inverse(1, j) + a12*this%d_inverse(2, j)
      l21 = a21*this%d_inverse(1, j) + a22*this%d_inverse(2, j)
      l12 = a11*this%d_inverse(2, j) + a12*this%d_inverse(3, j)
      l22 = a21*this%d_inverse(2, j) + a22*this%d_inverse(3, j)
      y(1, 1, k) = y(1, 1, k) - (l11*a11 + l12*a12)
      y(2, 1, k) = y(2, 1, k) - (l21*a11 + l22*a12)
      y(1, 2, k) = y(1, 2, k) - (l11*a21 + l12*a22)
      y(2, 2, k) = y(2, 2, k) - (l21*a21 + l22*a22)
      filled(j) = filled(j) + 1
      this%row(filled(j)) = k
      this%l(1, 1, filled(j)) = l11
      this%l(2, 1, filled(j)) = l21
      this%l(1, 2, filled(j)) = l12
      this%l(2, 2, filled(j)) = l22
    end do
  end subroutine eliminate_row

  !> Inverse of a pivot block; original = the same block of A, the measure of what is null.
  subroutine invert_pivot(this, original, k, pivot, status)
    type(ldlt_t), intent(inout) :: this
    real(wp), intent(in) :: original(2, 2)
    integer, intent(in) :: k
    real(wp), intent(in) :: pivot(2, 2)
    type(status_t), intent(inout) :: status
    real(wp) :: second, l21, floor_1, floor_2
    floor_1 = this%options%null_pivot*original(1, 1)
    floor_2 = this%options%null_pivot*original(2, 2)
    this%d_inverse(:, k) = zero
    if (this%options%null_pivot > zero .and. .not. pivot(1, 1) > floor_1) then
      this%info%null_pivots = this%info%null_pivots + 1
      if (pivot(2, 2) > floor_2) this%d_inverse(3, k) = 1.0_wp/pivot(2, 2)
      return
    end if
    l21 = pivot(2, 1)/pivot(1, 1)
    second = pivot(2, 2) - l21*pivot(2, 1)
    if (this%options%null_pivot > zero .and. .not. second > floor_2) then
      this%info%null_pivots = this%info%null_pivots + 1
      this%d_inverse(1, k) = 1.0_wp/pivot(1, 1)
    else if (pivot(1, 1) > zero .and. second > zero .and. second <= huge(second)) then
      this%d_inverse(3, k) = 1.0_wp/second
      this%d_inverse(2, k) = -l21*this%d_inverse(3, k)
      this%d_inverse(1, k) = 1.0_wp/pivot(1, 1) - l21*this%d_inverse(2, k)
    else
      call fail(status, status_numerical, 'lost pivot at node index '// &
          to_text(this%order(k))//': the effective matrix is not positive definite', &
          hint='check mass, stiffness and time step of the elements around it')
    end if
  end subroutine invert_pivot

  !> Row k of the Schur complement from y into the dense block (lower triangle).
  subroutine store_block_row(this, k, y)
    type(ldlt_t), intent(inout) :: this
    integer, intent(in) :: k
    real(wp), intent(inout) :: y(:, :, :)
    integer :: i, a, b
    a = 2*(k - this%leading) - 1
    do i = this%leading + 1, k
      b = 2*(i - this%leading) - 1
      this%schur%l(a:a + 1, b:b + 1) = y(:, :, i)
      y(:, :, i) = zero
    end do
  end subroutine store_block_row

  !> y = L^-1 b, then the leading part is divided by the pivots.
  subroutine ldlt_forward(this, b, b_interface)
    class(ldlt_t), intent(inout) :: this
    real(wp), intent(in) :: b(:, :)
    real(wp), intent(out) :: b_interface(:, :)
    integer :: k
    if (checks_on) call check_vectors(this, b, b_interface, 'ldlt_forward')
    do k = 1, this%n
      this%work(1, k) = b(1, this%order(k))
      this%work(2, k) = b(2, this%order(k))
    end do
    call forward_blocks(this%leading, this%n, this%first, this%row, this%l, &
        this%d_inverse, this%work)
    b_interface = this%work(:, this%leading + 1:this%n)
  end subroutine ldlt_forward

  pure subroutine forward_blocks(leading, n, first, row, l, d, y)
    integer, intent(in) :: leading, n
    integer, intent(in) :: first(leading + 1)
    integer, intent(in) :: row(*)
    real(wp), intent(in) :: l(2, 2, *)
    real(wp), intent(in) :: d(3, leading)
    real(wp), intent(inout) :: y(2, n)
    real(wp) :: y1, y2
    integer :: j, p, i
    do j = 1, leading
      y1 = y(1, j)
      y2 = y(2, j)
      do p = first(j), first(j + 1) - 1
        i = row(p)
        y(:, i) = y(:, i) - (l(:, 1, p)*y1 + l(:, 2, p)*y2)
      end do
      y(1, j) = d(1, j)*y1 + d(2, j)*y2
      y(2, j) = d(2, j)*y1 + d(3, j)*y2
    end do
  end subroutine forward_blocks

  !> x = L'^-1 of what forward left, with x of the block given.
  subroutine ldlt_backward(this, x_interface, x)
    class(ldlt_t), intent(inout) :: this
    real(wp), intent(in) :: x_interface(:, :)
    real(wp), intent(out) :: x(:, :)
    integer :: k
    if (checks_on) call check_vectors(this, x, x_interface, 'ldlt_backward')
    this%work(:, this%leading + 1:this%n) = x_interface
    call backward_blocks(this%leading, this%n, this%first, this%row, this%l, this%work)
    do k = 1, this%n
      x(1, this%order(k)) = this%work(1, k)
      x(2, this%order(k)) = this%work(2, k)
    end do
  end subroutine ldlt_backward

  pure subroutine backward_blocks(leading, n, first, row, l, y)
    integer, intent(in) :: leading, n
    integer, intent(in) :: first(leading + 1)
    integer, intent(in) :: row(*)
    real(wp), intent(in) :: l(2, 2, *)
    real(wp), intent(inout) :: y(2, n)
    real(wp) :: y1, y2
    integer :: j, p, i
    do j = leading, 1, -1
      y1 = y(1, j)
      y2 = y(2, j)
      do p = first(j), first(j + 1) - 1
        i = row(p)
        y1 = y1 - (l(1, 1, p)*y(1, i) + l(2, 1, p)*y(2, i))
        y2 = y2 - (l(1, 2, p)*y(1, i) + l(2, 2, p)*y(2, i))
      end do
      y(1, j) = y1
      y(2, j) = y2
    end do
  end subroutine backward_blocks

end module linalg_ldlt
