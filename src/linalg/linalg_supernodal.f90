! SPDX-License-Identifier: BSD-3-Clause
!> Cholesky factor A = scale L L' in dense panels, multifrontal (Duff & Reid 1983; Liu 1992):
!> each supernode is a panel of columns, whatever the number of unknowns of a node; what it
!> changes in the rows below goes to its parent in the elimination tree, and in the last nodes
!> to the Schur complement. For space and large scenes; in small ones `linalg_ldlt` does less.
module linalg_supernodal
  use base_checks, only: checks_on
  use base_kinds, only: wp, i8, zero, one
  use base_status, only: status_t, fail, failed, status_numerical
  use base_strings, only: to_text
  use linalg_graph, only: graph_t, block_matrix_t
  use linalg_order, only: choose_order
  use linalg_panels, only: eliminate_panel, forward_panel, backward_panel, gather_rows, &
      add_rows
  use linalg_solver, only: solver_t, demand_memory, check_graph, check_matrix, check_vectors
  use linalg_supernodes, only: supernodes_t, find_supernodes
  implicit none
  private

  type, extends(solver_t), public :: supernodal_t
    integer :: leading = 0                !< nodes eliminated
    integer, allocatable :: new(:)        !< (n) old -> new
    type(supernodes_t) :: supernodes
    !> (supernodes+1) start of each panel in l: a column holds the rows of the supernode's own
    !> columns, then those below; the diagonal holds 1/L.
    integer(i8), allocatable :: panel(:)
    real(wp), allocatable :: l(:)
    real(wp) :: scale = one               !< a power of two, of the size of A
    real(wp), allocatable :: work(:, :)   !< (d, n) right-hand side in elimination order
    real(wp), allocatable :: y(:)         !< unknowns of the rows below one panel
  contains
    procedure :: analyse => supernodal_analyse
    procedure :: factor => supernodal_factor
    procedure :: forward => supernodal_forward
    procedure :: backward => supernodal_backward
  end type supernodal_t

  !> What a supernode changes in the rows below it, lower triangle, until its parent takes it.
  type :: update_t
    real(wp), allocatable :: a(:, :)
  end type update_t

contains

  !> Order, supernodes, storage.
  subroutine supernodal_analyse(this, graph, d, last, status)
    class(supernodal_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: d
    integer, intent(in) :: last(:)
    type(status_t), intent(inout) :: status
    integer :: s, k, width, height, highest
    if (checks_on) call check_graph(graph, last, 'supernodal_analyse')
    this%n = graph%n
    this%d = d
    this%n_interface = size(last)
    this%leading = graph%n - size(last)
    call choose_order(graph, last, trim(this%options%order), this%order, this%info%order, &
        this%info%multiplications, status)
    if (failed(status)) return
    call this%schur%plan(graph, d, last)
    call find_supernodes(graph, this%leading, d, this%order, this%supernodes)
    this%new = this%order
    this%new(this%order) = [(k, k=1, graph%n)]
    if (allocated(this%panel)) deallocate (this%panel, this%l, this%work, this%y)
    allocate (this%panel(this%supernodes%n + 1))
    this%panel(1) = 1_i8
    highest = 0
    do s = 1, this%supernodes%n
      call sizes(this, s, width, height)
      highest = max(highest, height - width)
      this%panel(s + 1) = this%panel(s) + int(width, i8)*height
    end do
    this%info%factor_bytes = 8_i8*(this%panel(this%supernodes%n + 1) - 1_i8) &
        + 16_i8*this%supernodes%n + 4_i8*size(this%supernodes%row, kind=i8) &
        + this%schur%bytes()
    call demand_memory(this, status)
    if (failed(status)) return
    allocate (this%l(this%panel(this%supernodes%n + 1) - 1_i8), this%work(d, graph%n), &
        this%y(highest))
    call this%schur%make()
  end subroutine supernodal_analyse

  !> Columns and rows of a panel, in unknowns.
  pure subroutine sizes(this, s, width, height)
    class(supernodal_t), intent(in) :: this
    integer, intent(in) :: s
    integer, intent(out) :: width, height
    associate (p => this%supernodes)
      width = this%d*(p%first(s + 1) - p%first(s))
      height = width + this%d*(p%start(s + 1) - p%start(s))
    end associate
  end subroutine sizes

  !> One supernode after the other: entries of A, updates of its children, elimination.
  subroutine supernodal_factor(this, graph, matrix, status)
    class(supernodal_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    type(status_t), intent(inout) :: status
    type(update_t), allocatable :: update(:)
    integer, allocatable :: place(:)
    integer :: s, width, height, lost
    if (checks_on) call check_matrix(this, graph, matrix, 'supernodal_factor')
    call take_scale(this, graph, matrix, status)
    if (failed(status)) return
    allocate (update(this%supernodes%n), place(this%n))
    this%l = zero
    call take_last(this, graph, matrix)
    do s = 1, this%supernodes%n
      call sizes(this, s, width, height)
      call take_columns(this, graph, matrix, s, height, place)
      allocate (update(s)%a(height - width, height - width), source=zero)
      call take_children(this, s, width, height, place, update)
      call eliminate_panel(width, height, this%l(this%panel(s)), update(s)%a, lost)
      if (lost > 0) then
        call lose_pivot(this%order(this%supernodes%first(s) + (lost - 1)/this%d), status)
        return
      end if
      call give_last(this, s, place, update(s))
    end do
    do s = 1, this%schur%bodies
      this%schur%block(s)%l = this%schur%block(s)%l*this%scale
    end do
    call this%schur%factor(status)
  end subroutine supernodal_factor

  subroutine lose_pivot(node, status)
    integer, intent(in) :: node
    type(status_t), intent(inout) :: status
    call fail(status, status_numerical, 'lost pivot at node index '//to_text(node)// &
        ': the effective matrix is not positive definite', &
        hint='check mass, stiffness and time step of the elements around it')
  end subroutine lose_pivot

  !> The scale: a power of two, so that other units by powers of two change no digit of L.
  subroutine take_scale(this, graph, matrix, status)
    class(supernodal_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    type(status_t), intent(inout) :: status
    real(wp) :: largest, entry
    integer :: node, i
    largest = zero
    do node = 1, this%n
      do i = 1, this%d
        entry = matrix%diagonal_entry(graph, i, node)
        if (this%new(node) <= this%leading .and. .not. &
            (entry > zero .and. entry <= huge(entry))) call lose_pivot(node, status)
        if (entry <= huge(entry)) largest = max(largest, entry)
      end do
      if (failed(status)) return
    end do
    this%scale = scale(one, exponent(max(largest, tiny(largest))))
  end subroutine take_scale

  !> The last nodes among themselves: the Schur complement before any elimination.
  subroutine take_last(this, graph, matrix)
    class(supernodal_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    integer :: k, m, i, row, column, body, before
    do body = 1, this%schur%bodies
      this%schur%block(body)%l = zero
    end do
    do k = this%leading + 1, this%n
      body = this%schur%body(k - this%leading)
      before = this%leading + this%schur%first(body)
      row = this%d*(k - before)
      do m = graph%first(this%order(k)), graph%first(this%order(k) + 1) - 1
        i = this%new(graph%column(m))
        if (i <= this%leading .or. i > k) cycle
        column = this%d*(i - before)
        this%schur%block(body)%l(row + 1:row + this%d, column + 1:column + this%d) = &
            matrix%value(:, :, m)/this%scale
      end do
    end do
  end subroutine take_last

  !> The columns of supernode s of A into its panel. place: where the unknowns of a node begin
  !> in the panel, less one; of a last node, in the Schur complement, until a panel has it.
  subroutine take_columns(this, graph, matrix, s, height, place)
    class(supernodal_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    integer, intent(in) :: s, height
    integer, intent(inout) :: place(:)
    integer(i8) :: start
    integer :: k, m, i, c
    associate (p => this%supernodes, d => this%d)
      place(p%first(s):p%first(s + 1) - 1) = [(d*k, k=0, p%first(s + 1) - p%first(s) - 1)]
      c = p%first(s + 1) - p%first(s) - p%start(s)
      do m = p%start(s), p%start(s + 1) - 1
        place(p%row(m)) = d*(c + m)
      end do
      do k = p%first(s), p%first(s + 1) - 1
        do m = graph%first(this%order(k)), graph%first(this%order(k) + 1) - 1
          i = this%new(graph%column(m))
          if (i < k) cycle
          do c = 1, d
            start = this%panel(s) + int(place(k) + c - 1, i8)*height + place(i)
            this%l(start:start + d - 1) = matrix%value(c, :, m)/this%scale
          end do
        end do
      end do
    end associate
  end subroutine take_columns

  !> Adds the updates of the children of s, which are no longer needed then.
  subroutine take_children(this, s, width, height, place, update)
    class(supernodal_t), intent(inout) :: this
    integer, intent(in) :: s, width, height
    integer, intent(in) :: place(:)
    type(update_t), intent(inout) :: update(:)
    integer, allocatable :: to(:)
    integer :: c, n, own
    associate (p => this%supernodes)
      c = p%first_child(s)
      do while (c > 0)
        n = size(update(c)%a, 1)
        call list_places(this%d, p%row(p%start(c):p%start(c + 1) - 1), place, to)
        own = count(to <= width)
        call add_columns(n, update(c)%a, 1, own, to, height, this%l(this%panel(s)))
        to = to - width
        call add_columns(n, update(c)%a, own + 1, n, to, height - width, update(s)%a)
        deallocate (update(c)%a)
        c = p%sibling(c)
      end do
    end associate
  end subroutine take_children

  !> Adds the update of a supernode whose rows are all of the last nodes to their Schur
  !> complement.
  subroutine give_last(this, s, place, update)
    class(supernodal_t), intent(inout) :: this
    integer, intent(in) :: s
    integer, intent(inout) :: place(:)
    type(update_t), intent(inout) :: update
    integer, allocatable :: to(:)
    integer :: n, k, body
    associate (p => this%supernodes)
      n = size(update%a, 1)
      if (n > 0) then
        if (p%row(p%start(s)) <= this%leading) return
        body = this%schur%body(p%row(p%start(s)) - this%leading)
        do k = this%schur%first(body), this%schur%first(body + 1) - 1
          place(this%leading + k) = this%d*(k - this%schur%first(body))
        end do
        call list_places(this%d, p%row(p%start(s):p%start(s + 1) - 1), place, to)
        associate (l => this%schur%block(body)%l)
          call add_columns(n, update%a, 1, n, to, size(l, 1), l)
        end associate
      end if
      deallocate (update%a)
    end associate
  end subroutine give_last

  !> The place of each unknown of some nodes.
  pure subroutine list_places(d, node, place, to)
    integer, intent(in) :: d
    integer, intent(in) :: node(:), place(:)
    integer, allocatable, intent(out) :: to(:)
    integer :: k, i
    allocate (to(d*size(node)))
    do k = 1, size(node)
      do i = 1, d
        to(d*(k - 1) + i) = place(node(k)) + i
      end do
    end do
  end subroutine list_places

  !> Adds columns first..last of the lower triangle of a to b; row i of a is row to(i) of b.
  pure subroutine add_columns(n, a, first, last, to, height, b)
    integer, intent(in) :: n, first, last, height
    real(wp), intent(in) :: a(n, n)
    integer, intent(in) :: to(n)
    real(wp), intent(inout) :: b(height, *)
    integer :: i, j, column
    do j = first, last
      column = to(j)
      do i = j, n
        b(to(i), column) = b(to(i), column) + a(i, j)
      end do
    end do
  end subroutine add_columns

  !> y = L^-1 b panel by panel; then its leading part is divided by the scale.
  subroutine supernodal_forward(this, b, b_interface)
    class(supernodal_t), intent(inout) :: this
    real(wp), intent(in) :: b(:, :)
    real(wp), intent(out) :: b_interface(:, :)
    integer :: s, k, n, width, height
    if (checks_on) call check_vectors(this, b, b_interface, 'supernodal_forward')
    do k = 1, this%n
      this%work(:, k) = b(:, this%order(k))
    end do
    associate (p => this%supernodes)
      do s = 1, p%n
        call sizes(this, s, width, height)
        call forward_panel(width, height - width, this%l(this%panel(s)), &
            this%work(1, p%first(s)), this%y)
        n = p%start(s + 1) - p%start(s)
        if (n > 0) call add_rows(this%d, n, p%row(p%start(s)), this%y, this%work)
      end do
    end associate
    this%work(:, :this%leading) = this%work(:, :this%leading)/this%scale
    b_interface = this%work(:, this%leading + 1:)
  end subroutine supernodal_forward

  !> x = L'^-1 of what forward left, with x of the block given.
  subroutine supernodal_backward(this, x_interface, x)
    class(supernodal_t), intent(inout) :: this
    real(wp), intent(in) :: x_interface(:, :)
    real(wp), intent(out) :: x(:, :)
    integer :: s, k, n, width, height
    if (checks_on) call check_vectors(this, x, x_interface, 'supernodal_backward')
    this%work(:, this%leading + 1:) = x_interface
    associate (p => this%supernodes)
      do s = p%n, 1, -1
        call sizes(this, s, width, height)
        n = p%start(s + 1) - p%start(s)
        if (n > 0) call gather_rows(this%d, n, p%row(p%start(s)), this%work, this%y)
        call backward_panel(width, height - width, this%l(this%panel(s)), this%y, &
            this%work(1, p%first(s)))
      end do
    end associate
    do k = 1, this%n
      x(:, this%order(k)) = this%work(:, k)
    end do
  end subroutine supernodal_backward

end module linalg_supernodal
