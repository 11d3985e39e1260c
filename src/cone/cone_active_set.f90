! SPDX-License-Identifier: BSD-3-Clause
!> Direct solves for given statuses, without friction and in the plane: once it is known who is
!> open, sticks or slips, the law is linear, and one small system gives the reactions to
!> round-off. (One step of a Newton method on the natural map, Alart & Curnier 1991.) The
!> statuses come from sweeps, or from complementary pivoting.
module cone_active_set
  use base_kinds, only: wp, zero, one
  use cone_certificate, only: evaluate_certificate
  use cone_dense, only: delassus_dense_t
  use cone_local, only: in_cone
  use cone_pivoting, only: pivot_statuses
  use cone_types, only: cone_work_t, certificate_t, size_active_set, contact_open, contact_slip
  use linalg_dense, only: solve_general
  implicit none
  private
  public :: try_active_set, try_pivoting

contains

  !> r (d, nc), work%u (d, nc) and certificate for the statuses work%status, with the signs of
  !> slip of r; all stay as they are where that meets no certificate. m is the mean diagonal of
  !> W [L/F], certificate that of r.
  subroutine try_active_set(tolerance, w, q, mu, m, r, work, certificate)
    real(wp), intent(in) :: tolerance
    type(delassus_dense_t), intent(in) :: w
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(in) :: m
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    type(certificate_t) :: trial
    integer :: a
    logical :: ok
    call size_active_set(work)
    call solve_active_set(w%matrix, q, mu, r, work, ok)
    work%tried = work%status
    certificate%active_set_solves = certificate%active_set_solves + 1
    if (.not. ok) return
    do a = 1, size(mu)
      if (.not. in_cone(mu(a), work%trial(:, a))) return
    end do
    call w%displacements(q, work%trial, work%trial_u)
    trial = certificate
    call evaluate_certificate(m, mu, q, work%trial, work%trial_u, tolerance, trial)
    if (.not. trial%met .or. trial%error > certificate%error) return
    certificate = trial
    r = work%trial
    work%u = work%trial_u
  end subroutine try_active_set

  !> The same for the statuses of a complementary path, in the plane; work%status stays as it is
  !> where that fails.
  subroutine try_pivoting(tolerance, w, q, mu, m, r, work, certificate)
    real(wp), intent(in) :: tolerance
    type(delassus_dense_t), intent(in) :: w
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(in) :: m
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    real(wp) :: start(2, size(mu))
    integer :: kept(size(mu))
    logical :: ok
    kept = work%status
    start(1, :) = one
    call pivot_statuses(w, q, mu, work%status, start(2, :), ok)
    certificate%pivotings = certificate%pivotings + 1
    if (ok) call try_active_set(tolerance, w, q, mu, m, start, work, certificate)
    if (certificate%met) then
      r = start
    else
      work%status = kept
    end if
  end subroutine try_pivoting

  !> Reactions work%trial for the statuses work%status: stick u = 0; slip u_n = 0 and r_t = -mu
  !> r_n sign(u_t), the sign taken from r_t now. ok is false if the system is singular.
  subroutine solve_active_set(w, q, mu, r, work, ok)
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
  end subroutine solve_active_set

  !> One row per unknown: the displacement of its component is zero.
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

end module cone_active_set
