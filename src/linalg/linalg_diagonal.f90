! SPDX-License-Identifier: BSD-3-Clause
!> A diagonal matrix: lumped masses alone, as explicit schemes have them. Nothing is eliminated,
!> so that no node has a place in an order, and the Schur complement of any interface is the
!> diagonal of its own dofs.
module linalg_diagonal
  use base_checks, only: checks_on, assert_shape
  use base_kinds, only: wp, i8, zero, one
  use base_status, only: status_t
  use linalg_graph, only: graph_t, block_matrix_t
  use linalg_solver, only: solver_t, lose_pivot, check_graph, check_matrix, check_vectors
  implicit none
  private

  type, extends(solver_t), public :: diagonal_t
    integer, allocatable :: last(:)          !< (n_interface) the interface nodes
    real(wp), allocatable :: inverse(:, :)   !< (d, n) of the diagonal [L/F]
    real(wp), allocatable :: work(:, :)      !< (d, n) A^-1 b, from forward to backward
  contains
    procedure :: analyse => diagonal_analyse
    procedure :: factor => diagonal_factor
    procedure :: forward => diagonal_forward
    procedure :: solve_schur => diagonal_solve_schur
    procedure :: body_flexibility => diagonal_flexibility
    procedure :: backward => diagonal_backward
  end type diagonal_t

contains

  !> Storage; there is no order.
  subroutine diagonal_analyse(this, graph, d, last, status)
    class(diagonal_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: d
    integer, intent(in) :: last(:)
    type(status_t), intent(inout) :: status
    if (checks_on) call check_graph(graph, last, 'diagonal_analyse')
    this%n = graph%n
    this%d = d
    this%n_interface = size(last)
    this%last = last
    call this%schur%plan(graph, d, last)
    this%info%order = 'none'
    if (.not. allocated(this%work)) &
        allocate (this%inverse(d, graph%n), this%work(d, graph%n))
    this%info%factor_bytes = 8_i8*d*graph%n
  end subroutine diagonal_analyse

  !> The inverse of each entry; one that is not positive is a lost pivot.
  subroutine diagonal_factor(this, graph, matrix, status)
    class(diagonal_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    type(status_t), intent(inout) :: status
    integer :: i
    if (checks_on) call check_matrix(this, graph, matrix, 'diagonal_factor')
    do i = 1, this%n
      if (.not. all(matrix%diagonal(:, i) > zero .and. &
          matrix%diagonal(:, i) <= huge(zero))) then
        call lose_pivot(i, status)
        return
      end if
      this%inverse(:, i) = one/matrix%diagonal(:, i)
    end do
  end subroutine diagonal_factor

  subroutine diagonal_forward(this, b, b_interface)
    class(diagonal_t), intent(inout) :: this
    real(wp), intent(in) :: b(:, :)
    real(wp), intent(out) :: b_interface(:, :)
    integer :: k
    if (checks_on) call check_vectors(this, b, b_interface, 'diagonal_forward')
    call multiply_entries(this%d*this%n, this%inverse, b, this%work)
    do k = 1, this%n_interface
      b_interface(:, k) = b(:, this%last(k))
    end do
  end subroutine diagonal_forward

  !> c = a b, entry by entry.
  pure subroutine multiply_entries(n, a, b, c)
    integer, intent(in) :: n
    real(wp), intent(in) :: a(n), b(n)
    real(wp), intent(out) :: c(n)
    c = a*b
  end subroutine multiply_entries

  subroutine diagonal_solve_schur(this, x_interface)
    class(diagonal_t), intent(in) :: this
    real(wp), intent(inout), contiguous :: x_interface(:, :)
    integer :: k
    if (checks_on) call assert_shape(shape(x_interface), [this%d, this%n_interface], &
        'diagonal_solve_schur', 'x_interface')
    do k = 1, this%n_interface
      x_interface(:, k) = this%inverse(:, this%last(k))*x_interface(:, k)
    end do
  end subroutine diagonal_solve_schur

  subroutine diagonal_flexibility(this, k, f)
    class(diagonal_t), intent(in) :: this
    integer, intent(in) :: k
    real(wp), intent(out), contiguous :: f(:, :)
    integer :: i, m, row
    f = zero
    row = 0
    do m = this%schur%first(k), this%schur%first(k + 1) - 1
      do i = 1, this%d
        row = row + 1
        f(row, row) = this%inverse(i, this%last(m))
      end do
    end do
  end subroutine diagonal_flexibility

  subroutine diagonal_backward(this, x_interface, x)
    class(diagonal_t), intent(inout) :: this
    real(wp), intent(in) :: x_interface(:, :)
    real(wp), intent(out) :: x(:, :)
    integer :: k
    if (checks_on) call check_vectors(this, x, x_interface, 'diagonal_backward')
    x = this%work
    do k = 1, this%n_interface
      x(:, this%last(k)) = x_interface(:, k)
    end do
  end subroutine diagonal_backward

end module linalg_diagonal
