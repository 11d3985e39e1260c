! SPDX-License-Identifier: BSD-3-Clause
!> Supernodes: runs of columns of the factor with the same rows below, which are held and
!> eliminated as one dense panel. Neighbours in the elimination tree are joined where that adds
!> few zeros (Ashcraft & Grimes 1989).
module linalg_supernodes
  use base_kinds, only: wp, i8
  use base_sort, only: sort_integers
  use linalg_graph, only: graph_t
  use linalg_symbolic, only: symbolic_factor, order_tree
  implicit none
  private
  public :: find_supernodes, find_parents, front_bytes

  !> Columns first(s)..first(s+1)-1 (nodes, new numbers) have below them the rows
  !> row(start(s):start(s+1)-1), in increasing order. What the elimination of s changes there
  !> is added to another supernode, its parent; the children of one are first_child and its
  !> siblings.
  type, public :: supernodes_t
    integer :: n = 0
    integer, allocatable :: first(:)         !< (n+1)
    integer, allocatable :: start(:)         !< (n+1)
    integer, allocatable :: row(:)
    integer, allocatable :: first_child(:)   !< (n) 0 = none
    integer, allocatable :: sibling(:)       !< (n) 0 = no other
  end type supernodes_t

  !> Share of zeros up to which neighbours are joined, by the columns they have together:
  !> measured on squares and cubes, where less only loses.
  integer, parameter :: narrow = 16, middling = 48
  real(wp), parameter :: zeros_narrow = 0.4_wp, zeros_middling = 0.1_wp, zeros_wide = 0.05_wp

contains

  !> The most bytes of updates that stand at one time, with d unknowns a node, where supernodes
  !> are eliminated in their order: each is there until its parent has taken it.
  pure integer(i8) function front_bytes(this, d) result(most)
    type(supernodes_t), intent(in) :: this
    integer, intent(in) :: d
    integer(i8) :: standing
    integer :: s, c
    standing = 0_i8
    most = 0_i8
    do s = 1, this%n
      standing = standing + update_bytes(s)
      most = max(most, standing)
      c = this%first_child(s)
      do while (c > 0)
        standing = standing - update_bytes(c)
        c = this%sibling(c)
      end do
    end do
  contains
    pure integer(i8) function update_bytes(s)
      integer, intent(in) :: s
      update_bytes = 8_i8*(d*int(this%start(s + 1) - this%start(s), i8))**2
    end function update_bytes
  end function front_bytes

  !> Supernodes of the first `leading` nodes of an order (new -> old), d unknowns each; the
  !> order is changed to another with the same factor, in which each supernode is one piece.
  subroutine find_supernodes(graph, leading, d, order, this)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: leading, d
    integer, intent(inout) :: order(:)
    type(supernodes_t), intent(out) :: this
    integer, allocatable :: parent(:), rows(:), post(:), old(:)
    integer :: k, filled
    allocate (parent(graph%n), rows(graph%n), post(graph%n))
    call symbolic_factor(graph, order, leading, parent, rows)
    call order_tree(parent, post)
    old = order
    filled = 0
    do k = 1, graph%n
      if (post(k) > leading) cycle
      filled = filled + 1
      order(filled) = old(post(k))
    end do
    call symbolic_factor(graph, order, leading, parent, rows)
    call join_columns(leading, d, parent, rows, this%first)
    this%n = size(this%first) - 1
    allocate (this%start(this%n + 1), this%first_child(this%n), this%sibling(this%n))
    this%start(1) = 1
    do k = 1, this%n
      this%start(k + 1) = this%start(k) + rows(this%first(k + 1) - 1)
    end do
    call collect_rows(graph, leading, order, this)
  end subroutine find_supernodes

  !> First columns of the supernodes, and leading + 1. From the last to the first, a run of
  !> columns of the same rows joins the supernode after it, if its parent is there and the zeros
  !> that it gets are few.
  subroutine join_columns(leading, d, parent, rows, first)
    integer, intent(in) :: leading, d
    integer, intent(in) :: parent(:), rows(:)
    integer, allocatable, intent(out) :: first(:)
    logical :: is_first(leading + 1)
    integer :: j, last, top, columns
    real(wp) :: zeros, new_zeros, width
    is_first = .true.
    do j = 2, leading
      is_first(j) = .not. (parent(j - 1) == j .and. rows(j - 1) == rows(j) + 1)
    end do
    top = leading
    last = leading
    columns = 0
    zeros = 0.0_wp
    do j = leading, 1, -1
      if (.not. is_first(j)) cycle
      width = real(last - j + 1, wp)
      if (columns > 0) then
        new_zeros = width*(real(columns + rows(top), wp) + width - real(rows(j) + 1, wp))
        if (parent(last) > last .and. parent(last) <= top .and. &
            is_worth_it(d, columns + last - j + 1, rows(top), zeros + new_zeros)) then
          is_first(last + 1) = .false.
          zeros = zeros + new_zeros
        else
          top = last
          columns = 0
          zeros = 0.0_wp
        end if
      end if
      columns = columns + last - j + 1
      last = j - 1
    end do
    allocate (first(count(is_first)))
    columns = 0
    do j = 1, leading + 1
      if (.not. is_first(j)) cycle
      columns = columns + 1
      first(columns) = j
    end do
  end subroutine join_columns

  !> Whether a supernode of so many columns and rows below (nodes) may hold so many zeros.
  pure logical function is_worth_it(d, columns, below, zeros)
    integer, intent(in) :: d, columns, below
    real(wp), intent(in) :: zeros
    real(wp) :: share
    share = zeros/(0.5_wp*columns*(columns + 1.0_wp) + real(columns, wp)*below)
    is_worth_it = share < zeros_wide .or. (share < zeros_middling .and. d*columns <= middling) &
        .or. (share < zeros_narrow .and. d*columns <= narrow)
  end function is_worth_it

  !> Rows below each supernode: those of its columns in the graph and those of its children. The
  !> first of them is a column of its parent, or one of the last nodes.
  subroutine collect_rows(graph, leading, order, this)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: leading
    integer, intent(in) :: order(:)
    type(supernodes_t), intent(inout) :: this
    integer, allocatable :: new(:), owner(:), mark(:)
    integer :: s, c, k, m, filled
    allocate (new(graph%n), owner(leading), mark(graph%n), this%row(this%start(this%n + 1) - 1))
    new(order) = [(k, k=1, graph%n)]
    mark = 0
    this%first_child = 0
    this%sibling = 0
    do s = 1, this%n
      owner(this%first(s):this%first(s + 1) - 1) = s
    end do
    do s = 1, this%n
      filled = this%start(s) - 1
      do k = this%first(s), this%first(s + 1) - 1
        do m = graph%first(order(k)), graph%first(order(k) + 1) - 1
          call take(new(graph%column(m)))
        end do
      end do
      c = this%first_child(s)
      do while (c > 0)
        do m = this%start(c), this%start(c + 1) - 1
          call take(this%row(m))
        end do
        c = this%sibling(c)
      end do
      if (filled < this%start(s)) cycle
      call sort_integers(this%row(this%start(s):filled))
      k = this%row(this%start(s))
      if (k > leading) cycle
      this%sibling(s) = this%first_child(owner(k))
      this%first_child(owner(k)) = s
    end do
  contains
    subroutine take(i)
      integer, intent(in) :: i
      if (i < this%first(s + 1)) return
      if (mark(i) == s) return
      mark(i) = s
      filled = filled + 1
      this%row(filled) = i
    end subroutine take
  end subroutine collect_rows

  !> The parent of each supernode, 0 where what it changes goes to the last nodes alone.
  pure subroutine find_parents(this, leading, parent)
    type(supernodes_t), intent(in) :: this
    integer, intent(in) :: leading
    integer, allocatable, intent(out) :: parent(:)
    integer :: owner(leading), s
    allocate (parent(this%n), source=0)
    do s = 1, this%n
      owner(this%first(s):this%first(s + 1) - 1) = s
    end do
    do s = 1, this%n
      if (this%start(s + 1) == this%start(s)) cycle
      if (this%row(this%start(s)) <= leading) parent(s) = owner(this%row(this%start(s)))
    end do
  end subroutine find_parents

end module linalg_supernodes
