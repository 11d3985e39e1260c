! SPDX-License-Identifier: BSD-3-Clause
!> Conjugate gradients with an incomplete factor (Hestenes & Stiefel 1952; Meijerink & van der
!> Vorst 1977; Saad 2003, 9.2): nothing is eliminated. For matrices that change in each step, in
!> steps of a few crossing times of an element, where the mass keeps A well conditioned and the
!> count of iterations does not grow with the mesh; a factor would cost more than its solves.
!>
!> The contact block is found by one solve for each of its dofs: F = (A^-1) of the block, S =
!> F^-1. forward solves A x = b without the block's reactions, backward adds A^-1 of what the
!> block has moved.
module linalg_cg
  use base_checks, only: checks_on, assert, assert_shape
  use base_kinds, only: wp, i8, zero, one, half
  use base_status, only: status_t, fail, failed, status_deck
  use base_strings, only: to_text
  use linalg_graph, only: graph_t, block_matrix_t
  use linalg_incomplete, only: incomplete_t, make_incomplete, factor_incomplete, &
      apply_incomplete, multiply
  use linalg_solver, only: solver_t, demand_memory, lose_pivot, check_graph, &
      check_matrix, check_vectors
  implicit none
  private

  type, extends(solver_t), public :: cg_t
    integer, allocatable :: last(:)          !< (n_interface) the interface nodes
    type(graph_t) :: graph
    type(block_matrix_t) :: matrix
    type(incomplete_t) :: incomplete
    real(wp), allocatable :: f(:, :)         !< (dm, dm) flexibility of the block [L/F]
    real(wp), allocatable :: reaction(:, :)  !< (d, m) on the block, of backward [F]
    !> (d, n) each: solution of forward, right-hand side, and what an iteration needs
    real(wp), allocatable :: x(:, :), b(:, :), r(:, :), z(:, :), p(:, :), q(:, :)
    real(wp) :: square_scale = 0.0_wp        !< b' M^-1 b, in which r' M^-1 r is measured
  contains
    procedure :: analyse => cg_analyse
    procedure :: factor => cg_factor
    procedure :: forward => cg_forward
    procedure :: solve_schur => cg_solve_schur
    procedure :: body_flexibility => cg_flexibility
    procedure :: backward => cg_backward
  end type cg_t

contains

  !> Pattern and storage; nodes keep their order.
  subroutine cg_analyse(this, graph, d, last, status)
    class(cg_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: d
    integer, intent(in) :: last(:)
    type(status_t), intent(inout) :: status
    integer(i8) :: m
    if (checks_on) call check_graph(graph, last, 'cg_analyse')
    if (this%options%null_pivot > zero) then
      call fail(status, status_deck, 'ENGINE CG of *BIPACT_SOLVER needs bodies that are '// &
          'held or have mass', hint='take ENGINE AUTO')
      return
    end if
    this%n = graph%n
    this%d = d
    this%n_interface = size(last)
    this%last = last
    this%graph = graph
    this%info%order = 'none'
    m = d*size(last, kind=i8)
    this%info%factor_bytes = (12_i8*d*d + 4_i8)*size(graph%column, kind=i8) &
        + 8_i8*(d*d + 6*d)*graph%n + 16_i8*m**2
    this%info%multiplications = size(graph%column, kind=i8)*(1_i8 + 2_i8*m)
    call demand_memory(this, status)
    if (failed(status)) return
    call make_incomplete(graph, d, this%incomplete)
    if (allocated(this%x)) deallocate (this%x, this%b, this%r, this%z, this%p, this%q, &
        this%f, this%reaction)
    allocate (this%x(d, graph%n), this%b(d, graph%n), this%r(d, graph%n), this%z(d, graph%n), &
        this%p(d, graph%n), this%q(d, graph%n), this%reaction(d, size(last)))
    allocate (this%f(m, m), source=zero)
    call this%schur%plan_whole(d, size(last))
    call this%schur%make()
  end subroutine cg_analyse

  !> Incomplete factor and the flexibility of the block, a solve for each of its dofs.
  subroutine cg_factor(this, graph, matrix, status)
    class(cg_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    type(status_t), intent(inout) :: status
    integer :: lost, k, c
    if (checks_on) call check_matrix(this, graph, matrix, 'cg_factor')
    this%matrix%value = matrix%value
    this%info%unconverged = 0
    call factor_incomplete(this%incomplete, this%matrix, lost)
    if (lost > 0) then
      call lose_pivot(lost, status)
      return
    end if
    if (this%n_interface == 0) return
    do k = 1, this%n_interface
      do c = 1, this%d
        this%b = zero
        this%b(c, this%last(k)) = one
        this%x = zero
        call iterate(this, zero)
        this%f(:, this%d*(k - 1) + c) = reshape(this%x(:, this%last), [size(this%f, 1)])
      end do
    end do
    this%f = half*(this%f + transpose(this%f))
    this%schur%block(1)%l = this%f
    call this%schur%factor(status)
  end subroutine cg_factor

  !> x = A^-1 b; for the block S times its part.
  subroutine cg_forward(this, b, b_interface)
    class(cg_t), intent(inout) :: this
    real(wp), intent(in) :: b(:, :)
    real(wp), intent(out) :: b_interface(:, :)
    integer :: k
    if (checks_on) call check_vectors(this, b, b_interface, 'cg_forward')
    this%b = b
    this%x = zero      ! the last solution would be nearer, but a restart does not have it
    call iterate(this, zero)
    do k = 1, this%n_interface
      b_interface(:, k) = this%x(:, this%last(k))
    end do
    if (this%n_interface > 0) call this%schur%solve(b_interface)
  end subroutine cg_forward

  subroutine cg_solve_schur(this, x_interface)
    class(cg_t), intent(in) :: this
    real(wp), intent(inout), contiguous :: x_interface(:, :)
    if (checks_on) call assert_shape(shape(x_interface), [this%d, this%n_interface], &
        'cg_solve_schur', 'x_interface')
    if (this%n_interface > 0) x_interface = reshape(matmul(this%f, reshape(x_interface, &
        [size(this%f, 1)])), shape(x_interface))
  end subroutine cg_solve_schur

  !> There is one block, number k = 1.
  subroutine cg_flexibility(this, k, f)
    class(cg_t), intent(in) :: this
    integer, intent(in) :: k
    real(wp), intent(out), contiguous :: f(:, :)
    if (checks_on) call assert(k == 1, 'cg_flexibility', 'there is one block')
    if (checks_on) call assert_shape(shape(f), shape(this%f), 'cg_flexibility', 'f')
    f = this%f
  end subroutine cg_flexibility

  !> x = A^-1 (b + r), r the reaction on the block that moves it to x_interface. Where it moves
  !> by rounding alone nothing is left to solve.
  subroutine cg_backward(this, x_interface, x)
    class(cg_t), intent(inout) :: this
    real(wp), intent(in) :: x_interface(:, :)
    real(wp), intent(out) :: x(:, :)
    integer :: k
    if (checks_on) call check_vectors(this, x, x_interface, 'cg_backward')
    x = this%x
    if (this%n_interface == 0) return
    this%reaction = x_interface - this%x(:, this%last)
    call this%schur%solve(this%reaction)
    do k = 1, this%n_interface
      this%b(:, this%last(k)) = this%b(:, this%last(k)) + this%reaction(:, k)
    end do
    call iterate(this, this%square_scale)
    x = this%x
    do k = 1, this%n_interface
      x(:, this%last(k)) = x_interface(:, k)
    end do
  end subroutine cg_backward

  !> Conjugate gradients from x on: until sqrt(r' M^-1 r) is CGTOL of that of b, or of the root
  !> of square_scale where that is more; counted where CGMAX iterations do not reach it.
  subroutine iterate(this, square_scale)
    type(cg_t), intent(inout) :: this
    real(wp), intent(in) :: square_scale
    real(wp) :: product, last, alpha
    integer :: k
    call apply_incomplete(this%incomplete, this%b, this%z)
    this%square_scale = max(square_scale, dot(this%b, this%z))
    call multiply(this%graph, this%matrix, this%x, this%q)
    this%r = this%b - this%q
    product = zero
    do k = 0, this%options%most_iterations
      last = product
      call apply_incomplete(this%incomplete, this%r, this%z)
      product = dot(this%r, this%z)
      if (.not. product > this%options%tolerance**2*this%square_scale) return
      if (k == 0) then
        this%p = this%z
      else
        this%p = this%z + (product/last)*this%p
      end if
      call multiply(this%graph, this%matrix, this%p, this%q)
      alpha = product/dot(this%p, this%q)
      this%x = this%x + alpha*this%p
      this%r = this%r - alpha*this%q
      this%info%iterations = this%info%iterations + 1
    end do
    this%info%unconverged = this%info%unconverged + 1
  end subroutine iterate

  pure real(wp) function dot(a, b)
    real(wp), intent(in) :: a(:, :), b(:, :)
    integer :: i
    dot = zero
    do i = 1, size(a, 2)
      dot = dot + dot_product(a(:, i), b(:, i))
    end do
  end function dot

end module linalg_cg
