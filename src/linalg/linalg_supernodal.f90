! SPDX-License-Identifier: BSD-3-Clause
!> Cholesky factor A = scale L L' in dense panels, multifrontal (Duff & Reid 1983; Liu 1992):
!> each supernode is a panel of columns, whatever the number of unknowns of a node; what it
!> changes in the rows below goes to its parent in the elimination tree, and in the last nodes
!> to the Schur complement. For space and large scenes; in small ones `linalg_ldlt` does less.
!> With several threads, parts of the tree that do not depend on each other go first, then the
!> top, whose wide panels are split. Each sum has the order that it has with one thread.
module linalg_supernodal
  use base_checks, only: checks_on
  use base_kinds, only: wp, i8, zero, one
  use base_status, only: status_t, failed
  use base_system, only: has_wide_vectors
  use linalg_graph, only: graph_t, block_matrix_t
  use linalg_panels, only: eliminate_panel, forward_panel, backward_panel, forward_split, &
      backward_split, is_wide, gather_rows, add_rows, list_places, add_columns
  use linalg_solver, only: solver_t, demand_memory, lose_pivot, check_graph, &
      check_matrix, check_vectors
  use linalg_subtrees, only: subtrees_t, find_subtrees
  use linalg_supernodes, only: supernodes_t, find_supernodes, find_parents, front_bytes
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
    real(wp), allocatable :: y(:, :)      !< unknowns of the rows below one panel, of each part
    type(subtrees_t) :: parts             !< of the supernodes, for threads; n = 0: none
    !> Of supernodes in a part: rows below that are in the part too; where what changes in the
    !> others begins in `kept` (rows), less one.
    integer, allocatable :: inner(:), start(:)
    real(wp), allocatable :: kept(:, :)
  contains
    procedure :: analyse => supernodal_analyse
    procedure :: factor => supernodal_factor
    procedure :: forward => supernodal_forward
    procedure :: backward => supernodal_backward
  end type supernodal_t

  !> Multiplications of blocks worth asking for the vectors of the processor.
  integer(i8), parameter :: worth_wide = 100000_i8

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
    call this%find_order(graph, last, trim(this%options%order), status)
    if (failed(status)) return
    call this%schur%plan(graph, d, last)
    call find_supernodes(graph, this%leading, d, this%order, this%supernodes)
    this%new = this%order
    this%new(this%order) = [(k, k=1, graph%n)]
    if (allocated(this%panel)) deallocate (this%panel, this%l, this%work, this%y)
    this%parts%n = 0
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
    this%info%front_bytes = front_bytes(this%supernodes, d)
    call demand_memory(this, status)
    if (failed(status)) return
    this%info%wide = .false.
    if (this%info%multiplications > worth_wide) this%info%wide = has_wide_vectors()
    if (this%options%threads > 1) call divide(this)
    allocate (this%l(this%panel(this%supernodes%n + 1) - 1_i8), this%work(d, graph%n), &
        this%y(highest, max(1, this%parts%n)))
    call this%schur%make()
  end subroutine supernodal_analyse

  !> Parts of the tree, where it is large enough for threads, and room for what they change
  !> outside.
  subroutine divide(this)
    class(supernodal_t), intent(inout) :: this
    integer(i8), parameter :: least = 300000_i8     ! entries of the factor
    integer, allocatable :: parent(:)
    integer :: s, last, kept
    associate (p => this%supernodes)
      if (this%panel(p%n + 1) <= least) return
      call find_parents(p, this%leading, parent)
      call find_subtrees(parent, real(this%panel(2:) - this%panel(:p%n), wp), this%parts)
      if (this%parts%n == 0) return
      if (allocated(this%inner)) deallocate (this%inner, this%start, this%kept)
      allocate (this%inner(p%n), this%start(p%n), source=0)
      kept = 0
      do s = 1, p%n
        if (this%parts%part(s) == 0) cycle
        last = p%first(this%parts%last(this%parts%part(s)) + 1) - 1
        this%inner(s) = count(p%row(p%start(s):p%start(s + 1) - 1) <= last)
        this%start(s) = kept
        kept = kept + p%start(s + 1) - p%start(s) - this%inner(s)
      end do
    end associate
    allocate (this%kept(this%d, kept))
  end subroutine divide

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
    integer, allocatable :: lost(:)
    integer :: s
    if (checks_on) call check_matrix(this, graph, matrix, 'supernodal_factor')
    call take_scale(this, graph, matrix, status)
    if (failed(status)) return
    call take_last(this, graph, matrix)
    allocate (update(this%supernodes%n), lost(this%supernodes%n))
    lost = 0
    if (this%parts%n > 0) call factor_parts(this, graph, matrix, update, lost)
    s = findloc([lost, 1] > 0, .true., dim=1)
    call factor_range(this, graph, matrix, 1, s - 1, 0, update, lost)
    s = findloc(lost > 0, .true., dim=1)
    if (s > 0) then
      call lose_pivot(this%order(this%supernodes%first(s) + (lost(s) - 1)/this%d), status)
      return
    end if
    do s = 1, this%supernodes%n
      call give_last(this, s, update(s))
    end do
    do s = 1, this%schur%bodies
      this%schur%block(s)%l = this%schur%block(s)%l*this%scale
    end do
    call this%schur%factor(status)
  end subroutine supernodal_factor

  !> The parts of the tree by several threads.
  subroutine factor_parts(this, graph, matrix, update, lost)
    class(supernodal_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    type(update_t), intent(inout) :: update(:)
    integer, intent(inout) :: lost(:)
    integer :: k, t
    !$omp parallel do schedule(dynamic, 1) num_threads(this%options%threads) private(t)
    do k = 1, this%parts%n
      t = this%parts%by_cost(k)
      call factor_range(this, graph, matrix, this%parts%first(t), this%parts%last(t), t, &
          update, lost)
    end do
  end subroutine factor_parts

  !> The supernodes first..last that are of a part, 0 = the top or all, up to a lost pivot.
  subroutine factor_range(this, graph, matrix, first, last, part, update, lost)
    class(supernodal_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    integer, intent(in) :: first, last, part
    type(update_t), intent(inout) :: update(:)
    integer, intent(inout) :: lost(:)
    integer, allocatable :: place(:)
    integer :: s, width, height
    allocate (place(this%n))
    do s = first, last
      if (this%parts%n > 0) then
        if (this%parts%part(s) /= part) cycle
      end if
      call sizes(this, s, width, height)
      call take_columns(this, graph, matrix, s, height, place)
      allocate (update(s)%a(height - width, height - width), source=zero)
      call take_children(this, s, width, height, place, update)
      call eliminate_panel(width, height, merge(this%options%threads, 1, &
          part == 0 .and. this%parts%n > 0), this%info%wide, &
          this%l(this%panel(s)), update(s)%a, lost(s))
      if (lost(s) > 0) return
    end do
  end subroutine factor_range

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
      this%l(this%panel(s):this%panel(s + 1) - 1_i8) = zero
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
  subroutine give_last(this, s, update)
    class(supernodal_t), intent(inout) :: this
    integer, intent(in) :: s
    type(update_t), intent(inout) :: update
    integer, allocatable :: to(:)
    integer :: n, k, body
    if (.not. allocated(update%a)) return
    associate (p => this%supernodes)
      n = size(update%a, 1)
      if (n == 0) return
      body = this%schur%body(p%row(p%start(s)) - this%leading)
      call list_places(this%d, p%row(p%start(s):p%start(s + 1) - 1) - this%leading, &
          [(this%d*(k - this%schur%first(body)), k=1, this%n_interface)], to)
      associate (l => this%schur%block(body)%l)
        call add_columns(n, update%a, 1, n, to, size(l, 1), l)
      end associate
      deallocate (update%a)
    end associate
  end subroutine give_last

  !> y = L^-1 b panel by panel; then its leading part is divided by the scale.
  subroutine supernodal_forward(this, b, b_interface)
    class(supernodal_t), intent(inout) :: this
    real(wp), intent(in) :: b(:, :)
    real(wp), intent(out) :: b_interface(:, :)
    integer :: s, k
    if (checks_on) call check_vectors(this, b, b_interface, 'supernodal_forward')
    if (this%parts%n == 0) then
      call take_nodes(this, 1, this%n, b)
      do s = 1, this%supernodes%n
        call forward_one(this, s, 1, this%y(:, 1))
      end do
    else
      !$omp parallel do schedule(dynamic, 1) num_threads(this%options%threads)
      do k = 1, this%parts%n
        call forward_part(this, this%parts%by_cost(k), b)
      end do
      call forward_top(this, b)
    end if
    b_interface = this%work(:, this%leading + 1:)
  end subroutine supernodal_forward

  !> The right-hand side of the nodes first..last of the order.
  pure subroutine take_nodes(this, first, last, b)
    class(supernodal_t), intent(inout) :: this
    integer, intent(in) :: first, last
    real(wp), intent(in) :: b(:, :)
    integer :: k
    do k = first, last
      this%work(:, k) = b(:, this%order(k))
    end do
  end subroutine take_nodes

  !> One supernode, all that it changes.
  subroutine forward_one(this, s, threads, y)
    class(supernodal_t), intent(inout) :: this
    integer, intent(in) :: s, threads
    real(wp), contiguous, intent(inout) :: y(:)
    integer :: n
    associate (p => this%supernodes)
      call forward_own(this, s, threads, y)
      n = p%start(s + 1) - p%start(s)
      if (n > 0) call add_rows(this%d, n, p%row(p%start(s)), y, this%work)
    end associate
  end subroutine forward_one

  !> One supernode: its own unknowns, and y, what it changes in the rows below.
  subroutine forward_own(this, s, threads, y)
    class(supernodal_t), intent(inout) :: this
    integer, intent(in) :: s, threads
    real(wp), contiguous, intent(inout) :: y(:)
    integer :: width, height
    associate (first => this%supernodes%first(s), last => this%supernodes%first(s + 1) - 1)
      call sizes(this, s, width, height)
      if (threads > 1 .and. is_wide(width, height - width)) then
        call forward_split(width, height - width, threads, this%l(this%panel(s)), &
            this%work(1, first), y)
      else
        call forward_panel(width, height - width, this%l(this%panel(s)), &
            this%work(1, first), y)
      end if
      this%work(:, first:last) = this%work(:, first:last)/this%scale
    end associate
  end subroutine forward_own

  !> Part t: what it changes outside is kept.
  subroutine forward_part(this, t, b)
    class(supernodal_t), intent(inout) :: this
    integer, intent(in) :: t
    real(wp), intent(in) :: b(:, :)
    integer :: s, k, n, inner
    associate (p => this%supernodes, d => this%d, parts => this%parts)
      call take_nodes(this, p%first(parts%first(t)), p%first(parts%last(t) + 1) - 1, b)
      do s = parts%first(t), parts%last(t)
        call forward_own(this, s, 1, this%y(:, t))
        n = p%start(s + 1) - p%start(s)
        if (n == 0) cycle
        inner = this%inner(s)
        call add_rows(d, inner, p%row(p%start(s)), this%y(1, t), this%work)
        do k = 1, n - inner
          this%kept(:, this%start(s) + k) = this%y(d*(inner + k - 1) + 1:d*(inner + k), t)
        end do
      end do
    end associate
  end subroutine forward_part

  !> The top, and what the parts have kept for it, in the order of the supernodes.
  subroutine forward_top(this, b)
    class(supernodal_t), intent(inout) :: this
    real(wp), intent(in) :: b(:, :)
    integer :: s, n
    associate (p => this%supernodes, part => this%parts%part)
      do s = 1, p%n
        if (part(s) == 0) call take_nodes(this, p%first(s), p%first(s + 1) - 1, b)
      end do
      call take_nodes(this, this%leading + 1, this%n, b)
      do s = 1, p%n
        n = p%start(s + 1) - p%start(s) - this%inner(s)
        if (part(s) == 0) then
          call forward_one(this, s, this%options%threads, this%y(:, 1))
        else if (n > 0) then
          call add_rows(this%d, n, p%row(p%start(s) + this%inner(s)), &
              this%kept(1, this%start(s) + 1), this%work)
        end if
      end do
    end associate
  end subroutine forward_top

  !> x = L'^-1 of what forward left, with x of the block given.
  subroutine supernodal_backward(this, x_interface, x)
    class(supernodal_t), intent(inout) :: this
    real(wp), intent(in) :: x_interface(:, :)
    real(wp), intent(out) :: x(:, :)
    integer :: k, t
    if (checks_on) call check_vectors(this, x, x_interface, 'supernodal_backward')
    this%work(:, this%leading + 1:) = x_interface
    call backward_range(this, 1, this%supernodes%n, 0, this%y(:, 1), x)
    if (this%parts%n > 0) then
      !$omp parallel do schedule(dynamic, 1) num_threads(this%options%threads) private(t)
      do k = 1, this%parts%n
        t = this%parts%by_cost(k)
        call backward_range(this, this%parts%first(t), this%parts%last(t), t, this%y(:, t), x)
      end do
    end if
    do k = this%leading + 1, this%n
      x(:, this%order(k)) = this%work(:, k)
    end do
  end subroutine supernodal_backward

  !> The supernodes first..last that are of a part, 0 = the top or all, and x of their nodes.
  subroutine backward_range(this, first, last, part, y, x)
    class(supernodal_t), intent(inout) :: this
    integer, intent(in) :: first, last, part
    real(wp), contiguous, intent(inout) :: y(:)
    real(wp), intent(inout) :: x(:, :)
    integer :: s, k
    do s = last, first, -1
      if (this%parts%n > 0) then
        if (this%parts%part(s) /= part) cycle
      end if
      call backward_one(this, s, merge(this%options%threads, 1, &
          part == 0 .and. this%parts%n > 0), y)
      do k = this%supernodes%first(s), this%supernodes%first(s + 1) - 1
        x(:, this%order(k)) = this%work(:, k)
      end do
    end do
  end subroutine backward_range

  subroutine backward_one(this, s, threads, y)
    class(supernodal_t), intent(inout) :: this
    integer, intent(in) :: s, threads
    real(wp), contiguous, intent(inout) :: y(:)
    integer :: n, width, height
    associate (p => this%supernodes)
      call sizes(this, s, width, height)
      n = p%start(s + 1) - p%start(s)
      if (n > 0) call gather_rows(this%d, n, p%row(p%start(s)), this%work, y)
      if (threads > 1 .and. is_wide(width, height - width)) then
        call backward_split(width, height - width, threads, this%l(this%panel(s)), y, &
            this%work(1, p%first(s)))
      else
        call backward_panel(width, height - width, this%l(this%panel(s)), y, &
            this%work(1, p%first(s)))
      end if
    end associate
  end subroutine backward_one

end module linalg_supernodal
