! SPDX-License-Identifier: BSD-3-Clause
!> Gauss-Seidel over the contacts, the same for every W whose entries are known.
module cone_sweep
  use base_kinds, only: wp, zero
  use cone_delassus, only: delassus_t, delassus_entries_t
  use cone_types, only: cone_options_t, most_components
  use linalg_dense, only: largest_eigenvalue
  implicit none
  private
  public :: find_rho, sweep_contacts

contains

  !> rho = factor/lmax(W_aa) (nc) [F/L] of each contact.
  pure subroutine find_rho(w, factor, rho)
    class(delassus_t), intent(in) :: w
    real(wp), intent(in) :: factor
    real(wp), intent(out) :: rho(:)
    real(wp) :: block(most_components, most_components)
    integer :: a
    do a = 1, size(rho)
      call w%diagonal_block(a, block)
      rho(a) = factor/largest_eigenvalue(block(:w%d, :w%d))
    end do
  end subroutine find_rho

  !> Visits every contact once: r, u (d, nc) and the statuses (nc). The local solve is loose: it
  !> stops at a share of what a contact changed in the sweep before (exact local solves were
  !> found less safe). change [F] is that of the sweep before, huge for none; on exit that of
  !> this one.
  subroutine sweep_contacts(options, w, mu, rho, q, r, u, status, change, local_iterations)
    type(cone_options_t), intent(in) :: options
    class(delassus_entries_t), intent(in) :: w
    real(wp), intent(in) :: mu(:), rho(:)
    real(wp), intent(in), contiguous :: q(:, :)
    real(wp), intent(inout), contiguous :: r(:, :), u(:, :)
    integer, intent(inout) :: status(:)
    real(wp), intent(inout) :: change
    integer, intent(inout) :: local_iterations
    real(wp) :: old(most_components), enough, sum_change
    integer :: a, d, most, iterations
    d = size(r, 1)
    enough = zero
    most = 1
    if (change < huge(change)) then
      enough = options%local_tolerance*change/size(mu)
      most = options%max_local
    end if
    sum_change = zero
    do a = 1, size(mu)
      old(:d) = r(:, a)
      call w%visit(options, a, mu(a), rho(a), enough, most, q, r, u, status(a), iterations)
      local_iterations = local_iterations + iterations
      sum_change = sum_change + sqrt(sum((r(:, a) - old(:d))**2))
    end do
    change = sum_change
  end subroutine sweep_contacts

end module cone_sweep
