! SPDX-License-Identifier: BSD-3-Clause
!> The classic profile (skyline) factor A = L D L', one scalar row at a time (Jennings 1966;
!> Bathe & Wilson 1976): a small engine, and the oracle for the sparse one. The last nodes stay
!> as a dense Schur complement, as everywhere.
module linalg_skyline
  use base_checks, only: checks_on
  use base_kinds, only: wp, i8, zero
  use base_status, only: status_t, failed
  use linalg_graph, only: graph_t, block_matrix_t
  use linalg_order, only: order_names, order_rcm
  use linalg_solver, only: solver_t, lose_pivot, check_graph, check_matrix, check_vectors
  implicit none
  private

  type, extends(solver_t), public :: skyline_t
    integer :: leading = 0                  !< scalar unknowns eliminated
    integer, allocatable :: new(:)
    integer, allocatable :: left(:)         !< (dn) first column of each scalar row
    !> (dn+1) row i holds columns left(i)..i-1 from start(i)
    integer, allocatable :: start(:)
    real(wp), allocatable :: l(:)
    real(wp), allocatable :: pivot(:)       !< (dn) pivots
    real(wp), allocatable :: work(:)
  contains
    procedure :: analyse => skyline_analyse
    procedure :: factor => skyline_factor
    procedure :: forward => skyline_forward
    procedure :: backward => skyline_backward
  end type skyline_t

contains

  !> Order (AUTO = RCM, which keeps a profile short) and profile.
  subroutine skyline_analyse(this, graph, d, last, status)
    class(skyline_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: d
    integer, intent(in) :: last(:)
    type(status_t), intent(inout) :: status
    character(:), allocatable :: wanted
    integer :: i, k, m, low, row
    wanted = trim(this%options%order)
    if (wanted == 'AUTO') wanted = trim(order_names(order_rcm))
    if (checks_on) call check_graph(graph, last, 'skyline_analyse')
    this%n = graph%n
    this%d = d
    this%n_interface = size(last)
    this%leading = d*(graph%n - size(last))
    call this%find_order(graph, last, wanted, status)
    if (failed(status)) return
    this%new = this%order
    this%new(this%order) = [(k, k=1, graph%n)]
    if (allocated(this%left)) deallocate (this%left, this%start, this%l, this%pivot, this%work)
    allocate (this%left(d*graph%n), this%start(d*graph%n + 1), this%pivot(d*graph%n), &
        this%work(d*graph%n))
    this%start(1) = 1
    do k = 1, graph%n
      low = k
      do m = graph%first(this%order(k)), graph%first(this%order(k) + 1) - 1
        low = min(low, this%new(graph%column(m)))
      end do
      do i = 1, d
        row = d*(k - 1) + i
        this%left(row) = d*(low - 1) + 1
        this%start(row + 1) = this%start(row) + row - this%left(row)
      end do
    end do
    allocate (this%l(this%start(d*graph%n + 1) - 1))
    call this%schur%plan(graph, d, last)
    call this%schur%make()
    this%info%factor_bytes = 8_i8*size(this%l, kind=i8)
  end subroutine skyline_analyse

  !> Row-wise LDL'; rows of the block are reduced by the leading columns only.
  subroutine skyline_factor(this, graph, matrix, status)
    class(skyline_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    type(status_t), intent(inout) :: status
    integer :: k, m, i, r, row, column
    if (checks_on) call check_matrix(this, graph, matrix, 'skyline_factor')
    this%l = zero
    do k = 1, this%n
      do m = graph%first(this%order(k)), graph%first(this%order(k) + 1) - 1
        i = this%new(graph%column(m))
        do r = 1, this%d
          row = this%d*(k - 1) + r
          do column = this%d*(i - 1) + 1, min(this%d*i, row - 1)
            this%l(this%start(row) + column - this%left(row)) = matrix%value(r, &
                column - this%d*(i - 1), m)
          end do
          if (i == k) this%pivot(row) = matrix%value(r, r, m)
        end do
      end do
    end do
    do row = 1, this%d*this%n
      call reduce_row(this, row)
      if (row > this%leading) cycle
      if (this%pivot(row) > zero .and. this%pivot(row) <= huge(zero)) cycle
      call lose_pivot(this%order((row - 1)/this%d + 1), status)
      return
    end do
    call take_block(this)
    call this%schur%factor(status)
  end subroutine skyline_factor

  !> Reduces one row: first to L D entries by the rows above (columns of the block take only the
  !> leading part), then to L and the pivot.
  subroutine reduce_row(this, row)
    type(skyline_t), intent(inout) :: this
    integer, intent(in) :: row
    integer :: column, low, count, top
    real(wp) :: entry
    do column = this%left(row), row - 1
      low = max(this%left(row), this%left(column))
      top = min(column - 1, this%leading)
      count = top - low + 1
      if (count <= 0) cycle
      associate (a => this%start(row) + low - this%left(row), &
          b => this%start(column) + low - this%left(column))
        this%l(this%start(row) + column - this%left(row)) = this%l(this%start(row) + column &
            - this%left(row)) - dot_product(this%l(a:a + count - 1), this%l(b:b + count - 1))
      end associate
    end do
    do column = this%left(row), min(row - 1, this%leading)
      associate (l => this%l(this%start(row) + column - this%left(row)))
        entry = l
        l = entry/this%pivot(column)
        this%pivot(row) = this%pivot(row) - l*entry
      end associate
    end do
  end subroutine reduce_row

  subroutine take_block(this)
    type(skyline_t), intent(inout) :: this
    integer :: row, column, body, before
    do row = this%leading + 1, this%d*this%n
      body = this%schur%body((row - this%leading - 1)/this%d + 1)
      before = this%leading + this%d*(this%schur%first(body) - 1)
      associate (l => this%schur%block(body)%l)
        l(row - before, row - before) = this%pivot(row)
        do column = before + 1, row - 1
          if (column < this%left(row)) cycle
          l(row - before, column - before) = this%l(this%start(row) + column - this%left(row))
        end do
      end associate
    end do
  end subroutine take_block

  !> Forward pass over the leading rows, then the rows of the block.
  subroutine skyline_forward(this, b, b_interface)
    class(skyline_t), intent(inout) :: this
    real(wp), intent(in) :: b(:, :)
    real(wp), intent(out) :: b_interface(:, :)
    integer :: k, row, top
    if (checks_on) call check_vectors(this, b, b_interface, 'skyline_forward')
    do k = 1, this%n
      this%work(this%d*(k - 1) + 1:this%d*k) = b(:, this%order(k))
    end do
    do row = 1, this%d*this%n
      top = min(row - 1, this%leading)
      this%work(row) = this%work(row) - dot_product(this%l(this%start(row):this%start(row) &
          + top - this%left(row)), this%work(this%left(row):top))
    end do
    b_interface = reshape(this%work(this%leading + 1:), [this%d, this%n_interface])
    this%work(1:this%leading) = this%work(1:this%leading)&
        /this%pivot(1:this%leading)
  end subroutine skyline_forward

  !> Backward pass: each known unknown is taken out of the rows before it.
  subroutine skyline_backward(this, x_interface, x)
    class(skyline_t), intent(inout) :: this
    real(wp), intent(in) :: x_interface(:, :)
    real(wp), intent(out) :: x(:, :)
    integer :: k, row, top
    if (checks_on) call check_vectors(this, x, x_interface, 'skyline_backward')
    this%work(this%leading + 1:) = reshape(x_interface, [this%d*this%n_interface])
    do row = this%d*this%n, 1, -1
      top = min(row - 1, this%leading)
      this%work(this%left(row):top) = this%work(this%left(row):top) &
          - this%work(row)*this%l(this%start(row):this%start(row) + top - this%left(row))
    end do
    do k = 1, this%n
      x(:, this%order(k)) = this%work(this%d*(k - 1) + 1:this%d*k)
    end do
  end subroutine skyline_backward

end module linalg_skyline
