! SPDX-License-Identifier: BSD-3-Clause
!> Incomplete factor of a symmetric matrix of node blocks, A ~ L D L' with the pattern of A and
!> nothing beside it (Meijerink & van der Vorst 1977), and products with A. Blocks are d x d;
!> the kernels are called with d = 2 and 3 as constants: the compiler makes two of each.
module linalg_incomplete
  use base_kinds, only: wp, zero, one
  use linalg_graph, only: graph_t, block_matrix_t
  implicit none
  private

  type, public :: incomplete_t
    integer :: n = 0, d = 0
    integer, allocatable :: first(:)         !< (n+1) rows of L, columns below the diagonal
    integer, allocatable :: column(:)
    integer, allocatable :: from(:)          !< place of each block of L in the matrix
    integer, allocatable :: diagonal(:)      !< (n) place of each diagonal block there
    real(wp), allocatable :: l(:, :, :)      !< (d, d, *)
    real(wp), allocatable :: d_inverse(:, :, :)   !< (d, d, n)
  end type incomplete_t

  public :: make_incomplete, factor_incomplete, apply_incomplete, multiply

contains

  !> Pattern and storage.
  subroutine make_incomplete(graph, d, factor)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: d
    type(incomplete_t), intent(out) :: factor
    integer :: i, k, m
    factor%n = graph%n
    factor%d = d
    m = (size(graph%column) - graph%n)/2
    allocate (factor%first(graph%n + 1), factor%column(m), factor%from(m), &
        factor%diagonal(graph%n), factor%l(d, d, m), factor%d_inverse(d, d, graph%n))
    m = 0
    do i = 1, graph%n
      factor%first(i) = m + 1
      do k = graph%first(i), graph%first(i + 1) - 1
        if (graph%column(k) == i) factor%diagonal(i) = k
        if (graph%column(k) >= i) cycle
        m = m + 1
        factor%column(m) = graph%column(k)
        factor%from(m) = k
      end do
    end do
    factor%first(graph%n + 1) = m + 1
  end subroutine make_incomplete

  !> L and D of a matrix; where a pivot is lost, of one with a larger diagonal, A + share diag A
  !> (Manteuffel 1980). lost: the node whose pivot no share could save, 0 = none.
  subroutine factor_incomplete(factor, matrix, lost)
    type(incomplete_t), intent(inout) :: factor
    type(block_matrix_t), intent(in) :: matrix
    integer, intent(out) :: lost
    real(wp), parameter :: shares(5) = [zero, 1.0e-3_wp, 1.0e-2_wp, 1.0e-1_wp, one]
    integer :: k
    do k = 1, size(shares)
      if (factor%d == 2) then
        call eliminate(2, factor%n, shares(k), factor%first, factor%column, factor%from, &
            factor%diagonal, matrix%value, factor%l, factor%d_inverse, lost)
      else
        call eliminate(3, factor%n, shares(k), factor%first, factor%column, factor%from, &
            factor%diagonal, matrix%value, factor%l, factor%d_inverse, lost)
      end if
      if (lost == 0) return
    end do
  end subroutine factor_incomplete

  !> Row by row: W_ik = A_ik - sum_j L_ij D_j L_kj' over the j that both rows have, D_i = A_ii -
  !> sum_k L_ik D_k L_ik', L_ik = W_ik D_k^-1.
  pure subroutine eliminate(d, n, share, first, column, from, diagonal, a, l, d_inverse, lost)
    integer, intent(in) :: d, n
    real(wp), intent(in) :: share
    integer, intent(in) :: first(n + 1), column(*), from(*), diagonal(n)
    real(wp), intent(in) :: a(d, d, *)
    real(wp), intent(inout) :: l(d, d, *), d_inverse(d, d, n)
    integer, intent(out) :: lost
    real(wp) :: w(d, d), pivot(d, d)
    integer :: i, k, p, q, m
    lost = 0
    do i = 1, n
      pivot = a(:, :, diagonal(i))
      do m = 1, d
        pivot(m, m) = pivot(m, m) + share*a(m, m, diagonal(i))
      end do
      do k = first(i), first(i + 1) - 1
        w = a(:, :, from(k))
        p = first(i)
        q = first(column(k))
        do while (p < k .and. q < first(column(k) + 1))
          if (column(p) == column(q)) then
            w = w - matmul(l(:, :, p), transpose(l(:, :, q)))    ! l holds W until row i is done
            p = p + 1
            q = q + 1
          else if (column(p) < column(q)) then
            p = p + 1
          else
            q = q + 1
          end if
        end do
        l(:, :, k) = w
      end do
      do k = first(i), first(i + 1) - 1
        w = matmul(l(:, :, k), d_inverse(:, :, column(k)))
        pivot = pivot - matmul(w, transpose(l(:, :, k)))
        l(:, :, k) = w
      end do
      call invert(d, pivot, d_inverse(:, :, i), lost)
      if (lost > 0) then
        lost = i
        return
      end if
    end do
  end subroutine eliminate

  !> Inverse of a pivot block by its factor C E C', without roots, so that other units by a
  !> power of two change no digit; lost = 1 where it is not positive definite.
  pure subroutine invert(d, a, inverse, lost)
    integer, intent(in) :: d
    real(wp), intent(in) :: a(d, d)
    real(wp), intent(out) :: inverse(d, d)
    integer, intent(out) :: lost
    real(wp), parameter :: least = 1.0e-12_wp    ! share of the entry that a pivot keeps
    real(wp) :: c(d, d), e(d), x(d)
    integer :: i, j
    lost = 1
    inverse = zero
    c = zero
    do j = 1, d
      e(j) = a(j, j) - sum(c(j, :j - 1)**2*e(:j - 1))
      if (.not. (e(j) > least*a(j, j) .and. e(j) <= huge(one))) return
      do i = j + 1, d
        c(i, j) = (a(i, j) - sum(c(i, :j - 1)*c(j, :j - 1)*e(:j - 1)))/e(j)
      end do
    end do
    do j = 1, d
      x = zero
      x(j) = one
      do i = j + 1, d
        x(i) = -dot_product(c(i, :i - 1), x(:i - 1))
      end do
      x = x/e
      do i = d - 1, 1, -1
        x(i) = x(i) - dot_product(c(i + 1:, i), x(i + 1:))
      end do
      inverse(:, j) = x
    end do
    lost = 0
  end subroutine invert

  !> z = (L D L')^-1 r, both (d, n).
  pure subroutine apply_incomplete(factor, r, z)
    type(incomplete_t), intent(in) :: factor
    real(wp), intent(in) :: r(:, :)
    real(wp), intent(out) :: z(:, :)
    if (factor%d == 2) then
      call sweep(2, factor%n, factor%first, factor%column, factor%l, factor%d_inverse, r, z)
    else
      call sweep(3, factor%n, factor%first, factor%column, factor%l, factor%d_inverse, r, z)
    end if
  end subroutine apply_incomplete

  pure subroutine sweep(d, n, first, column, l, d_inverse, r, z)
    integer, intent(in) :: d, n
    integer, intent(in) :: first(n + 1), column(*)
    real(wp), intent(in) :: l(d, d, *), d_inverse(d, d, n), r(d, n)
    real(wp), intent(out) :: z(d, n)
    real(wp) :: x(d)
    integer :: i, k, c
    do i = 1, n
      x = r(:, i)
      do k = first(i), first(i + 1) - 1
        do c = 1, d
          x = x - l(:, c, k)*z(c, column(k))
        end do
      end do
      z(:, i) = x
    end do
    do i = 1, n
      x = zero
      do c = 1, d
        x = x + d_inverse(:, c, i)*z(c, i)
      end do
      z(:, i) = x
    end do
    do i = n, 1, -1
      do k = first(i), first(i + 1) - 1
        do c = 1, d
          z(c, column(k)) = z(c, column(k)) - dot_product(l(:, c, k), z(:, i))
        end do
      end do
    end do
  end subroutine sweep

  !> y = A x, both (d, n).
  pure subroutine multiply(graph, matrix, x, y)
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(out) :: y(:, :)
    if (size(x, 1) == 2) then
      call product(2, graph%n, graph%first, graph%column, matrix%value, x, y)
    else
      call product(3, graph%n, graph%first, graph%column, matrix%value, x, y)
    end if
  end subroutine multiply

  pure subroutine product(d, n, first, column, a, x, y)
    integer, intent(in) :: d, n
    integer, intent(in) :: first(n + 1), column(*)
    real(wp), intent(in) :: a(d, d, *), x(d, n)
    real(wp), intent(out) :: y(d, n)
    real(wp) :: row(d)
    integer :: i, k, c
    do i = 1, n
      row = zero
      do k = first(i), first(i + 1) - 1
        do c = 1, d
          row = row + a(:, c, k)*x(c, column(k))
        end do
      end do
      y(:, i) = row
    end do
  end subroutine product

end module linalg_incomplete
