! SPDX-License-Identifier: BSD-3-Clause
!> The contact solver: one entry for every kind of W. Every answer is certified.
module cone_solver
  use base_kinds, only: wp, zero
  use base_status, only: status_t
  use cone_blocks, only: delassus_blocks_t
  use cone_blocks_solver, only: solve_blocks
  use cone_certificate, only: count_wedging, find_statuses
  use cone_delassus, only: delassus_t
  use cone_dense, only: delassus_dense_t
  use cone_dense_solver, only: solve_dense
  use cone_products_solver, only: solve_by_products
  use cone_types, only: cone_options_t, cone_work_t, certificate_t, size_cone_work, &
      contact_open
  implicit none
  private
  public :: solve_cone

contains

  !> Solves u = W r + q with r in the cones. W [L/F], q (d, nc) [L], mu (nc); r (d, nc) on entry
  !> is the start where options%warm_start, on exit the reactions [F]; work%u (d, nc) the
  !> displacements [L], work%status (nc) the statuses. Where only products with W are known
  !> options%solver has no choice. Fails when no method meets the tolerance; the certificate
  !> says how near it came. Allocates nothing for a dense W once work has its size, as long as
  !> sweeps and direct solves do.
  subroutine solve_cone(options, delassus, q, mu, r, work, certificate, status)
    type(cone_options_t), intent(in) :: options
    class(delassus_t), intent(in) :: delassus
    real(wp), intent(in), contiguous :: q(:, :)
    real(wp), intent(in) :: mu(:)
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(out) :: certificate
    type(status_t), intent(inout) :: status
    call size_cone_work(work, size(q, 1), size(q, 2))
    if (.not. options%warm_start) r = zero
    work%status = contact_open
    if (all(q(1, :) >= zero)) then
      r = zero
      work%u = q
      return
    end if
    call solve_kind(options, delassus, q, mu, r, work, certificate, status)
    call count_wedging(delassus, mu, r, certificate)
  end subroutine solve_cone

  !> By what is known of W.
  subroutine solve_kind(options, delassus, q, mu, r, work, certificate, status)
    type(cone_options_t), intent(in) :: options
    class(delassus_t), intent(in) :: delassus
    real(wp), intent(in), contiguous :: q(:, :)
    real(wp), intent(in) :: mu(:)
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    type(status_t), intent(inout) :: status
    if (options%solver /= 'PRODUCTS') then
      select type (delassus)
      type is (delassus_dense_t)
        call solve_dense(options, delassus, q, mu, r, work, certificate, status)
        return
      type is (delassus_blocks_t)
        call solve_blocks(options, delassus, q, mu, r, work%u, certificate, status)
        call find_statuses(delassus%mean_diagonal(), mu, r, work%u, work%status)
        return
      end select
    end if
    call solve_by_products(options, delassus, q, mu, r, work%u, certificate, status)
    call find_statuses(delassus%mean_diagonal(), mu, r, work%u, work%status)
  end subroutine solve_kind

end module cone_solver
