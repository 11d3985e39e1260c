! SPDX-License-Identifier: BSD-3-Clause
!> Who is open, sticks or slips, by complementary pivoting, for the plane. With the tangential
!> force split into two parts of one sign each, Coulomb's law in the plane is a linear
!> complementarity problem z >= 0, M z + b >= 0, z.(M z + b) = 0 with a copositive M, for which
!> Lemke's path (Lemke 1965) ends in a solution whatever the friction, where one exists. Slower
!> than sweeps by far: the fallback for few contacts that wedge (mu |W_nt| > W_nn), where sweeps
!> go in circles.
module cone_pivoting
  use base_kinds, only: wp, zero, one
  use cone_dense, only: delassus_dense_t
  use cone_types, only: contact_open, contact_stick, contact_slip
  use linalg_dense, only: solve_general
  implicit none
  private
  public :: pivot_statuses

  !> A share of the largest |q| and |column| below which numbers count as round-off, and the
  !> cohesion that keeps contacts without force from being degenerate.
  real(wp), parameter :: tiny_column = 1.0e-11_wp, tiny_ratio = 1.0e-10_wp
  real(wp), parameter :: cohesion = 1.0e-8_wp
  integer, parameter :: most_pivots = 50   !< a contact

contains

  !> Statuses of u = W r + q for W [L/F] of two components, q (2, nc) [L], mu (nc), and the sign
  !> of r_t where a contact slips. ok is false when the path ends in a ray, or is too long.
  subroutine pivot_statuses(w, q, mu, contact_status, slip_sign, ok)
    type(delassus_dense_t), intent(in) :: w
    real(wp), intent(in) :: q(:, :)
    real(wp), intent(in) :: mu(:)
    integer, intent(out) :: contact_status(:)
    real(wp), intent(out) :: slip_sign(:)
    logical, intent(out) :: ok
    real(wp), allocatable :: columns(:, :), b(:)
    integer, allocatable :: basis(:)
    logical, allocatable :: basic(:)
    integer :: n, a
    n = size(mu)
    allocate (columns(4*n, 8*n + 1), b(4*n), basis(4*n), basic(8*n + 1))
    call fill_problem(w, q, mu, columns, b)
    call follow_path(columns, b, basis, ok)
    contact_status = contact_open
    slip_sign = one
    if (.not. ok) return
    basic = .false.
    basic(basis) = .true.
    do a = 1, n
      if (.not. basic(4*n + a)) cycle
      contact_status(a) = merge(contact_slip, contact_stick, basic(7*n + a))
      slip_sign(a) = merge(one, -one, basic(5*n + a))
    end do
  end subroutine pivot_statuses

  !> Columns of (I, -M, -cover) and b, without dimension. Rows: u_n; u_t + lambda; -u_t +
  !> lambda; mu r_n - r_+ - r_-, the last divided by mu where mu > 1. Columns of M: r_n, r_+,
  !> r_-, lambda. The cover is uneven so that no two rows leave at once.
  subroutine fill_problem(w, q, mu, columns, b)
    type(delassus_dense_t), intent(in) :: w
    real(wp), intent(in) :: q(:, :)
    real(wp), intent(in) :: mu(:)
    real(wp), intent(out) :: columns(:, :)
    real(wp), intent(out) :: b(:)
    real(wp) :: m, largest, row_scale
    integer :: n, a, k
    n = size(mu)
    m = w%mean_diagonal()
    largest = maxval(abs(q))
    columns = zero
    do k = 1, 4*n
      columns(k, k) = one
      columns(k, 8*n + 1) = -one - uneven(k)
    end do
    do a = 1, n
      call fill_displacements(w%matrix(:, 2*a - 1)/m, columns(:, 4*n + a), -one)
      call fill_displacements(w%matrix(:, 2*a)/m, columns(:, 5*n + a), -one)
      call fill_displacements(w%matrix(:, 2*a)/m, columns(:, 6*n + a), one)
      columns([n + a, 2*n + a], 7*n + a) = -one
      row_scale = one/max(one, mu(a))
      columns(3*n + a, 4*n + a) = -mu(a)*row_scale
      columns(3*n + a, [5*n + a, 6*n + a]) = row_scale
      columns(3*n + a, 8*n + 1) = columns(3*n + a, 8*n + 1)*row_scale
      b([a, n + a, 2*n + a]) = [q(1, a), q(2, a), -q(2, a)]/largest
      b(3*n + a) = cohesion*row_scale*(one + uneven(a))
    end do
  end subroutine fill_problem

  !> Displacements by a unit force: normal, tangential of either sign.
  pure subroutine fill_displacements(w_column, column, factor)
    real(wp), intent(in) :: w_column(:)
    real(wp), intent(inout) :: column(:)
    real(wp), intent(in) :: factor
    integer :: n, a
    n = size(w_column)/2
    do a = 1, n
      column([a, n + a, 2*n + a]) = &
          factor*[w_column(2*a - 1), w_column(2*a), -w_column(2*a)]
    end do
  end subroutine fill_displacements

  !> Fractions of multiples of the golden ratio: spread in 0..1, the same in every run.
  elemental real(wp) function uneven(k)
    integer, intent(in) :: k
    uneven = modulo(0.6180339887_wp*k, one)
  end function uneven

  !> Lemke's path from the basis of slacks until the cover leaves. The basis is factored anew
  !> for each pivot, so that errors do not add up.
  subroutine follow_path(columns, b, basis, ok)
    real(wp), intent(in) :: columns(:, :)
    real(wp), intent(in) :: b(:)
    integer, intent(out) :: basis(:)
    logical, intent(out) :: ok
    real(wp), allocatable :: matrix(:, :), x(:, :)
    integer, allocatable :: pivot(:)
    integer :: n, cover, enter, leave, row, k
    n = size(b)
    cover = 2*n + 1
    allocate (matrix(n, n), x(n, 2), pivot(n))
    basis = [(k, k=1, n)]
    ok = all(b >= zero)
    if (ok) return
    row = minloc(-b/columns(:, cover), dim=1)
    enter = cover
    do k = 1, most_pivots*n/4
      leave = basis(row)
      basis(row) = enter
      ok = leave == cover
      if (ok) return
      enter = merge(leave + n, leave - n, leave <= n)
      matrix = columns(:, basis)
      x(:, 1) = columns(:, enter)
      x(:, 2) = b
      call solve_general(n, matrix, x, pivot, ok)
      if (.not. ok) return
      row = leaving_row(x(:, 1), max(zero, x(:, 2)), basis, cover)
      ok = row > 0
      if (.not. ok) return
    end do
    ok = .false.
  end subroutine follow_path

  !> Row of the least ratio of value to column; the cover first where it ties, else the largest
  !> column. 0 when no row limits (a ray).
  pure integer function leaving_row(column, value, basis, cover)
    real(wp), intent(in) :: column(:), value(:)
    integer, intent(in) :: basis(:), cover
    real(wp) :: enough, least, best
    integer :: i
    enough = tiny_column*maxval(abs(column))
    least = huge(least)
    do i = 1, size(column)
      if (column(i) > enough) least = min(least, value(i)/column(i))
    end do
    leaving_row = 0
    best = zero
    do i = 1, size(column)
      if (.not. column(i) > enough) cycle
      if (value(i)/column(i) > least*(one + tiny_ratio)) cycle
      if (basis(i) == cover) leaving_row = i
      if (basis(i) == cover) return
      if (column(i) > best) leaving_row = i
      best = max(best, column(i))
    end do
  end function leaving_row

end module cone_pivoting
