! SPDX-License-Identifier: BSD-3-Clause
!> A direct solve for given statuses: once the sweeps have found who is open, sticks or slips,
!> the law is linear, and one small system gives the reactions to round-off.
!> (One step of a Newton method on the natural map, Alart & Curnier 1991, in the plane.)
module cone_polish
  use base_kinds, only: wp, zero
  use cone_types, only: cone_work_t, contact_open, contact_slip
  use linalg_dense, only: solve_general
  implicit none
  private
  public :: polish_statuses

contains

  !> Reactions work%trial for the statuses work%status: stick u = 0; slip u_n = 0 and r_t = -mu
  !> r_n sign(u_t), the sign taken from r_t now. ok is false if the system is singular.
  subroutine polish_statuses(w, q, mu, r, work, ok)
    real(wp), intent(in) :: w(:, :)
    real(wp), intent(in) :: q(:, :)
    real(wp), intent(in) :: mu(:)
    real(wp), intent(in) :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    logical, intent(out) :: ok
    integer :: n, a, d, k
    d = size(r, 1)
    n = 0
    do a = 1, size(mu)
      if (work%status(a) == contact_open) cycle
      do k = 1, merge(1, d, work%status(a) == contact_slip)
        n = n + 1
        work%unknown(:, n) = [k, a]
      end do
    end do
    work%trial = zero
    ok = n > 0
    if (.not. ok) return
    call fill_system(w, q, mu, r, n, work)
    call solve_general(n, work%matrix, work%rhs, work%pivot, ok)
    if (.not. ok) return
    do k = 1, n
      work%trial(work%unknown(1, k), work%unknown(2, k)) = work%rhs(k, 1)
    end do
    do a = 1, size(mu)
      if (work%status(a) /= contact_slip .or. d == 1) cycle
      work%trial(2, a) = slip_ratio(mu(a), r(:, a))*work%trial(1, a)
    end do
  end subroutine polish_statuses

  !> One row per unknown: the motion of its component is zero.
  pure subroutine fill_system(w, q, mu, r, n, work)
    real(wp), intent(in) :: w(:, :)
    real(wp), intent(in) :: q(:, :)
    real(wp), intent(in) :: mu(:)
    real(wp), intent(in) :: r(:, :)
    integer, intent(in) :: n
    type(cone_work_t), intent(inout) :: work
    integer :: i, j, d, row, column, a
    d = size(r, 1)
    do j = 1, n
      a = work%unknown(2, j)
      column = d*(a - 1) + work%unknown(1, j)
      do i = 1, n
        row = d*(work%unknown(2, i) - 1) + work%unknown(1, i)
        work%matrix(i, j) = w(row, column)
        if (work%status(a) == contact_slip .and. d > 1) &
            work%matrix(i, j) = w(row, column) + slip_ratio(mu(a), r(:, a))*w(row, column + 1)
      end do
      work%rhs(j, 1) = -q(work%unknown(1, j), a)
    end do
  end subroutine fill_system

  !> r_t / r_n of a slipping contact.
  pure real(wp) function slip_ratio(mu, r)
    real(wp), intent(in) :: mu
    real(wp), intent(in) :: r(:)
    slip_ratio = sign(mu, r(2))
  end function slip_ratio

end module cone_polish
