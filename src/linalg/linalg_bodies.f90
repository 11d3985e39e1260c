! SPDX-License-Identifier: BSD-3-Clause
!> Bodies: the connected components of the node graph. The effective matrix couples no two of
!> them, so the Schur complement of chosen nodes, and its inverse, are dense blocks of a body
!> each. Two equal bodies take half the memory of one block of both, and a quarter of the work.
module linalg_bodies
  use base_kinds, only: wp, i8, zero
  use base_status, only: status_t, fail, failed, status_numerical
  use base_strings, only: to_text
  use linalg_dense, only: dense_spd_t, dense_factor, dense_solve, dense_inverse
  use linalg_graph, only: graph_t
  implicit none
  private

  !> Schur complement of the last nodes: those of a body follow each other.
  type, public :: schur_t
    integer :: d = 2                          !< unknowns of a node
    integer :: bodies = 0
    integer, allocatable :: first(:)          !< (bodies + 1) first node of each
    integer, allocatable :: body(:)           !< (nodes)
    type(dense_spd_t), allocatable :: block(:)   !< (bodies) lower triangle, then its factor
  contains
    procedure :: plan => plan_schur
    procedure :: plan_whole
    procedure :: bytes => schur_bytes
    procedure :: make => make_schur
    procedure :: factor => factor_schur
    procedure :: solve => solve_blocks
    procedure :: inverse => inverse_of_body
  end type schur_t

  type, public :: square_t
    real(wp), allocatable :: a(:, :)
  end type square_t

  !> A symmetric matrix of one square block for each body; both triangles.
  type, public :: body_blocks_t
    integer, allocatable :: first(:)          !< (bodies + 1) first row of each
    integer, allocatable :: body(:)           !< (rows)
    type(square_t), allocatable :: block(:)
  contains
    procedure :: rows => rows_of_blocks
    procedure :: set_one_body
    procedure :: add_column
    procedure :: clear_row
  end type body_blocks_t

  !> Up to this many dofs (1.3 MB, in the fast memory of a core) one block of all bodies is as
  !> cheap as one of each.
  integer, parameter :: small_block = 400

  public :: find_bodies, size_blocks, move_blocks

contains

  !> The body (graph%n) of every node: components, numbered by their first nodes.
  pure subroutine find_bodies(graph, body, bodies)
    type(graph_t), intent(in) :: graph
    integer, intent(out) :: body(:)
    integer, intent(out) :: bodies
    integer, allocatable :: queue(:)
    integer :: start, head, tail, k
    allocate (queue(graph%n))
    body = 0
    bodies = 0
    do start = 1, graph%n
      if (body(start) > 0) cycle
      bodies = bodies + 1
      body(start) = bodies
      queue(1) = start
      head = 1
      tail = 1
      do while (head <= tail)
        do k = graph%first(queue(head)), graph%first(queue(head) + 1) - 1
          if (body(graph%column(k)) > 0) cycle
          tail = tail + 1
          queue(tail) = graph%column(k)
          body(queue(tail)) = bodies
        end do
        head = head + 1
      end do
    end do
  end subroutine find_bodies

  !> The blocks of the nodes `last` of a graph, d unknowns each, without their numbers: one for
  !> each body where `last` lists them body by body and they are not few, else one of all.
  pure subroutine plan_schur(this, graph, d, last)
    class(schur_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: d, last(:)
    integer, allocatable :: body(:), first(:)
    integer :: k, bodies
    call this%plan_whole(d, size(last))
    if (d*size(last) <= small_block) return
    allocate (body(graph%n))
    call find_bodies(graph, body, bodies)
    if (bodies == 1) return
    body(:size(last)) = body(last)
    first = [integer ::]
    do k = 1, size(last)
      if (k > 1) then
        if (body(k) == body(k - 1)) cycle
        if (any(body(first) == body(k))) return
      end if
      first = [first, k]
    end do
    this%bodies = size(first)
    this%first = [first, size(last) + 1]
    do k = 1, this%bodies
      this%body(this%first(k):this%first(k + 1) - 1) = k
    end do
  end subroutine plan_schur

  !> One block of all: n nodes of d unknowns.
  pure subroutine plan_whole(this, d, n)
    class(schur_t), intent(inout) :: this
    integer, intent(in) :: d, n
    if (allocated(this%block)) deallocate (this%block)
    this%d = d
    this%bodies = min(1, n)
    this%first = [1, n + 1]
    if (allocated(this%body)) deallocate (this%body)
    allocate (this%body(n), source=1)
  end subroutine plan_whole

  !> Bytes of the blocks, as planned.
  pure integer(i8) function schur_bytes(this)
    class(schur_t), intent(in) :: this
    integer :: k
    schur_bytes = 0_i8
    do k = 1, this%bodies
      schur_bytes = schur_bytes &
          + 8_i8*(this%d*int(this%first(k + 1) - this%first(k), i8))**2
    end do
  end function schur_bytes

  !> Storage of the blocks, zero.
  pure subroutine make_schur(this)
    class(schur_t), intent(inout) :: this
    integer :: k, n
    if (allocated(this%block)) deallocate (this%block)
    allocate (this%block(this%bodies))
    do k = 1, this%bodies
      n = this%d*(this%first(k + 1) - this%first(k))
      allocate (this%block(k)%l(n, n), source=zero)
    end do
  end subroutine make_schur

  !> Cholesky factors of the blocks; fails at the first that is not positive definite.
  subroutine factor_schur(this, status)
    class(schur_t), intent(inout) :: this
    type(status_t), intent(inout) :: status
    type(status_t) :: answer
    integer :: k
    do k = 1, this%bodies
      call dense_factor(this%block(k), answer)
      if (.not. failed(answer)) cycle
      call fail(status, status_numerical, 'lost pivot '//to_text(this%block(k)%lost + &
          this%d*(this%first(k) - 1))//' in the contact block: the matrix is not positive '// &
          'definite')
      return
    end do
  end subroutine factor_schur

  !> x = S^-1 x, x (d, nodes).
  subroutine solve_blocks(this, x)
    class(schur_t), intent(in) :: this
    real(wp), intent(inout), contiguous :: x(:, :)
    integer :: k
    do k = 1, this%bodies
      call dense_solve(this%block(k), this%d*(this%first(k + 1) - this%first(k)), &
          x(:, this%first(k):this%first(k + 1) - 1))
    end do
  end subroutine solve_blocks

  !> inverse = that of the block of body k, both triangles [L/F].
  subroutine inverse_of_body(this, k, inverse)
    class(schur_t), intent(in) :: this
    integer, intent(in) :: k
    real(wp), intent(out), contiguous :: inverse(:, :)
    call dense_inverse(this%block(k), inverse)
  end subroutine inverse_of_body

  !> Storage for the inverse of a Schur complement as planned; nothing where it is there.
  pure subroutine size_blocks(schur, blocks)
    type(schur_t), intent(in) :: schur
    type(body_blocks_t), intent(inout) :: blocks
    integer :: first(schur%bodies + 1)
    integer :: k, n
    first = schur%d*(schur%first(:schur%bodies + 1) - 1) + 1
    if (allocated(blocks%block)) then
      if (size(blocks%first) == size(first)) then
        if (all(blocks%first == first)) return
      end if
      deallocate (blocks%block, blocks%body)
    end if
    blocks%first = first
    allocate (blocks%block(schur%bodies), blocks%body(schur%d*size(schur%body)))
    do k = 1, schur%bodies
      n = first(k + 1) - first(k)
      allocate (blocks%block(k)%a(n, n))
      blocks%body(first(k):first(k + 1) - 1) = k
    end do
  end subroutine size_blocks

  !> Storage for n rows of one body.
  pure subroutine set_one_body(this, n)
    class(body_blocks_t), intent(inout) :: this
    integer, intent(in) :: n
    if (allocated(this%block)) deallocate (this%block, this%body)
    this%first = [1, n + 1]
    allocate (this%block(1), this%body(n))
    this%body = 1
    allocate (this%block(1)%a(n, n))
  end subroutine set_one_body

  !> Moves all storage; from is empty then.
  pure subroutine move_blocks(from, to)
    type(body_blocks_t), intent(inout) :: from, to
    call move_alloc(from%first, to%first)
    call move_alloc(from%body, to%body)
    call move_alloc(from%block, to%block)
  end subroutine move_blocks

  pure integer function rows_of_blocks(this)
    class(body_blocks_t), intent(in) :: this
    rows_of_blocks = size(this%body)
  end function rows_of_blocks

  !> x = x + factor a(:, j), x (rows).
  pure subroutine add_column(this, j, factor, x)
    class(body_blocks_t), intent(in) :: this
    integer, intent(in) :: j
    real(wp), intent(in) :: factor
    real(wp), intent(inout), contiguous :: x(:)
    integer :: b, start, n
    b = this%body(j)
    start = this%first(b)
    n = this%first(b + 1) - start
    call add_multiple(n, factor, this%block(b)%a(:, j - start + 1), x(start:start + n - 1))
  end subroutine add_column

  !> x = x + factor a.
  pure subroutine add_multiple(n, factor, a, x)
    integer, intent(in) :: n
    real(wp), intent(in) :: factor, a(n)
    real(wp), intent(inout) :: x(n)
    x = x + factor*a
  end subroutine add_multiple

  !> Row and column j become zero.
  pure subroutine clear_row(this, j)
    class(body_blocks_t), intent(inout) :: this
    integer, intent(in) :: j
    associate (a => this%block(this%body(j))%a, k => j - this%first(this%body(j)) + 1)
      a(k, :) = zero
      a(:, k) = zero
    end associate
  end subroutine clear_row

end module linalg_bodies
