! SPDX-License-Identifier: BSD-3-Clause
!> Sparse LU of an unsymmetric matrix of d x d blocks by fronts (Duff & Reid 1984): the shape is
!> that of the symmetric graph, rows are exchanged within a front only. For matrices that need
!> no more than that, and whose user looks at the result.
module linalg_fronts
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, failed
  use linalg_graph, only: graph_t
  use linalg_order, only: choose_order
  use linalg_supernodes, only: supernodes_t, find_supernodes
  implicit none
  private
  public :: plan_fronts, factor_fronts, solve_fronts

  !> One front: columns it eliminates (n1 unknowns) before the n2 unknowns below them.
  type :: front_t
    integer :: n1 = 0, n2 = 0
    real(wp), allocatable :: lu(:, :), below(:, :), right(:, :)   !< n1 x n1, n2 x n1, n1 x n2
    real(wp), allocatable :: update(:, :)                         !< n2 x n2, until it is added
    integer, allocatable :: pivot(:)
  end type front_t

  type, public :: fronts_t
    integer :: d = 0, n = 0                !< unknowns a node; nodes
    real(wp) :: flops = zero               !< of a factor
    real(wp) :: numbers = zero             !< in it
    type(supernodes_t) :: nodes
    integer, allocatable :: order(:), new(:)           !< new -> old, old -> new
    type(front_t), allocatable :: front(:)
  end type fronts_t

  interface
    subroutine dgetrf(m, n, a, lda, ipiv, info)
      import :: wp
      integer, intent(in) :: m, n, lda
      real(wp), intent(inout) :: a(lda, *)
      integer, intent(out) :: ipiv(*), info
    end subroutine dgetrf
    subroutine dlaswp(n, a, lda, k1, k2, ipiv, incx)
      import :: wp
      integer, intent(in) :: n, lda, k1, k2, ipiv(*), incx
      real(wp), intent(inout) :: a(lda, *)
    end subroutine dlaswp
    subroutine dtrsm(side, uplo, transa, diag, m, n, alpha, a, lda, b, ldb)
      import :: wp
      character, intent(in) :: side, uplo, transa, diag
      integer, intent(in) :: m, n, lda, ldb
      real(wp), intent(in) :: alpha, a(lda, *)
      real(wp), intent(inout) :: b(ldb, *)
    end subroutine dtrsm
    subroutine dgemm(transa, transb, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc)
      import :: wp
      character, intent(in) :: transa, transb
      integer, intent(in) :: m, n, k, lda, ldb, ldc
      real(wp), intent(in) :: alpha, beta, a(lda, *), b(ldb, *)
      real(wp), intent(inout) :: c(ldc, *)
    end subroutine dgemm
  end interface

contains

  !> Order, shape and cost for a symmetric graph whose rows are sorted and hold their own node.
  !> order, where given, is used as it is (new -> old).
  subroutine plan_fronts(graph, d, this, order)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: d
    type(fronts_t), intent(inout) :: this
    integer, intent(in), optional :: order(:)
    type(status_t) :: status
    character(:), allocatable :: chosen
    integer(selected_int_kind(18)) :: multiplications
    real(wp) :: n1, n2
    integer :: k
    this%d = d
    this%n = graph%n
    if (present(order)) then
      this%order = order
    else
      call choose_order(graph, [integer ::], 'METIS', this%order, chosen, multiplications, &
          status)
      if (failed(status)) this%order = [(k, k=1, graph%n)]
    end if
    call find_supernodes(graph, graph%n, d, this%order, this%nodes)
    if (allocated(this%new)) deallocate (this%new)
    allocate (this%new(graph%n))
    this%new(this%order) = [(k, k=1, graph%n)]
    this%flops = zero
    this%numbers = zero
    do k = 1, this%nodes%n
      n1 = d*(this%nodes%first(k + 1) - this%nodes%first(k))
      n2 = d*(this%nodes%start(k + 1) - this%nodes%start(k))
      this%flops = this%flops + n1**3/1.5_wp + 2.0_wp*n1**2*n2 + 2.0_wp*n1*n2**2
      this%numbers = this%numbers + n1*(n1 + 2.0_wp*n2)
    end do
  end subroutine plan_fronts

  !> The factor of the matrix with blocks value (d, d, k) at row(k), column(k), which the graph
  !> of the plan holds; those of one place add up. ok is false where a pivot is zero.
  subroutine factor_fronts(this, row, column, value, ok)
    type(fronts_t), intent(inout) :: this
    integer, intent(in) :: row(:), column(:)
    real(wp), intent(in) :: value(:, :, :)
    logical, intent(out) :: ok
    integer, allocatable :: first(:), member(:), place(:)
    integer :: s
    if (allocated(this%front)) deallocate (this%front)
    allocate (this%front(this%nodes%n), place(this%n))
    call sort_blocks(this, row, column, first, member)
    ok = .true.
    do s = 1, this%nodes%n
      call eliminate(this, s, first, member, row, column, value, place, ok)
      if (.not. ok) return
    end do
  end subroutine factor_fronts

  !> Blocks by the node that is eliminated first of the two: member(first(k):first(k+1)-1).
  pure subroutine sort_blocks(this, row, column, first, member)
    type(fronts_t), intent(in) :: this
    integer, intent(in) :: row(:), column(:)
    integer, allocatable, intent(out) :: first(:), member(:)
    integer, allocatable :: next(:)
    integer :: k, m
    allocate (first(this%n + 1), member(size(row)))
    first = 0
    do k = 1, size(row)
      m = min(this%new(row(k)), this%new(column(k)))
      first(m + 1) = first(m + 1) + 1
    end do
    first(1) = 1
    do k = 1, this%n
      first(k + 1) = first(k + 1) + first(k)
    end do
    next = first(:this%n)
    do k = 1, size(row)
      m = min(this%new(row(k)), this%new(column(k)))
      member(next(m)) = k
      next(m) = next(m) + 1
    end do
  end subroutine sort_blocks

  !> Front s: gathered from its blocks and its children, its columns eliminated. place (nodes)
  !> is work space.
  subroutine eliminate(this, s, first, member, row, column, value, place, ok)
    type(fronts_t), intent(inout) :: this
    integer, intent(in) :: s, first(:), member(:), row(:), column(:)
    real(wp), intent(in) :: value(:, :, :)
    integer, intent(inout) :: place(:)
    logical, intent(out) :: ok
    real(wp), allocatable :: whole(:, :)
    integer :: n, k, i, j, d, info
    d = this%d
    call number_front(this, s, place)
    n = this%front(s)%n1 + this%front(s)%n2
    allocate (whole(n, n))
    whole = zero
    do k = first(this%nodes%first(s)), first(this%nodes%first(s + 1)) - 1
      i = place(this%new(row(member(k))))
      j = place(this%new(column(member(k))))
      whole(i + 1:i + d, j + 1:j + d) = whole(i + 1:i + d, j + 1:j + d) + value(:, :, member(k))
    end do
    k = this%nodes%first_child(s)
    do while (k > 0)
      call add_update(this, k, place, whole)
      k = this%nodes%sibling(k)
    end do
    associate (f => this%front(s))
      f%lu = whole(:f%n1, :f%n1)
      allocate (f%pivot(f%n1))
      call dgetrf(f%n1, f%n1, f%lu, f%n1, f%pivot, info)
      ok = info == 0
      if (.not. ok .or. f%n2 == 0) return
      f%right = whole(:f%n1, f%n1 + 1:)
      f%below = whole(f%n1 + 1:, :f%n1)
      f%update = whole(f%n1 + 1:, f%n1 + 1:)
      call dlaswp(f%n2, f%right, f%n1, 1, f%n1, f%pivot, 1)
      call dtrsm('L', 'L', 'N', 'U', f%n1, f%n2, one, f%lu, f%n1, f%right, f%n1)
      call dtrsm('R', 'U', 'N', 'N', f%n2, f%n1, one, f%lu, f%n1, f%below, f%n2)
      call dgemm('N', 'N', f%n2, f%n2, f%n1, -one, f%below, f%n2, f%right, f%n1, one, &
          f%update, f%n2)
    end associate
  end subroutine eliminate

  !> Sizes of front s, and where its nodes begin in it.
  pure subroutine number_front(this, s, place)
    type(fronts_t), intent(inout) :: this
    integer, intent(in) :: s
    integer, intent(inout) :: place(:)
    integer :: k, n
    n = 0
    do k = this%nodes%first(s), this%nodes%first(s + 1) - 1
      place(k) = n
      n = n + this%d
    end do
    this%front(s)%n1 = n
    do k = this%nodes%start(s), this%nodes%start(s + 1) - 1
      place(this%nodes%row(k)) = n
      n = n + this%d
    end do
    this%front(s)%n2 = n - this%front(s)%n1
  end subroutine number_front

  !> Adds what child c changes in the unknowns below it, and forgets it there.
  pure subroutine add_update(this, c, place, whole)
    type(fronts_t), intent(inout) :: this
    integer, intent(in) :: c, place(:)
    real(wp), intent(inout) :: whole(:, :)
    integer :: k, m, i, j, d, first
    d = this%d
    first = this%nodes%start(c)
    do m = 0, this%front(c)%n2/d - 1
      j = place(this%nodes%row(first + m))
      do k = 0, this%front(c)%n2/d - 1
        i = place(this%nodes%row(first + k))
        whole(i + 1:i + d, j + 1:j + d) = whole(i + 1:i + d, j + 1:j + d) + &
            this%front(c)%update(d*k + 1:d*k + d, d*m + 1:d*m + d)
      end do
    end do
    deallocate (this%front(c)%update)
  end subroutine add_update

  !> x (d, n) = matrix^-1 x.
  subroutine solve_fronts(this, x)
    type(fronts_t), intent(in) :: this
    real(wp), intent(inout) :: x(:, :)
    real(wp) :: y(this%d, this%n)
    integer :: s
    y = x(:, this%order)
    do s = 1, this%nodes%n
      call pass_front(this, s, .true., y)
    end do
    do s = this%nodes%n, 1, -1
      call pass_front(this, s, .false., y)
    end do
    x(:, this%order) = y
  end subroutine solve_fronts

  !> Front s of the forward or the backward substitution of y (d, n) in the new order.
  subroutine pass_front(this, s, forward, y)
    type(fronts_t), intent(in) :: this
    integer, intent(in) :: s
    logical, intent(in) :: forward
    real(wp), intent(inout) :: y(:, :)
    real(wp) :: own(this%front(s)%n1, 1), other(this%front(s)%n2)
    integer :: from, to
    from = this%nodes%first(s)
    to = this%nodes%first(s + 1) - 1
    associate (f => this%front(s), rows => &
        this%nodes%row(this%nodes%start(s):this%nodes%start(s + 1) - 1))
      own(:, 1) = reshape(y(:, from:to), [f%n1])
      if (forward) then
        call dlaswp(1, own, f%n1, 1, f%n1, f%pivot, 1)
        call dtrsm('L', 'L', 'N', 'U', f%n1, 1, one, f%lu, f%n1, own, f%n1)
        if (f%n2 > 0) y(:, rows) = y(:, rows) - &
            reshape(matmul(f%below, own(:, 1)), [this%d, size(rows)])
      else
        if (f%n2 > 0) then
          other = reshape(y(:, rows), [f%n2])
          own(:, 1) = own(:, 1) - matmul(f%right, other)
        end if
        call dtrsm('L', 'U', 'N', 'N', f%n1, 1, one, f%lu, f%n1, own, f%n1)
      end if
      y(:, from:to) = reshape(own(:, 1), [this%d, to - from + 1])
    end associate
  end subroutine pass_front

end module linalg_fronts
