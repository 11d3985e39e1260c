! SPDX-License-Identifier: BSD-3-Clause
!> The contact problem where W is given as an operator (cone_operator), by its products alone.
module cone_products
  use base_kinds, only: wp, zero
  use base_status, only: status_t
  use cone_certificate, only: certify, fail_uncertified
  use cone_gradient, only: gradient_t, start_gradient, restart_gradient, gradient_step
  use cone_operator, only: operator_t
  use cone_types, only: cone_options_t, certificate_t, late
  implicit none
  private
  public :: solve_by_products

  integer, parameter :: chunk = 10         !< steps between two looks at the error

contains

  !> Reactions r (d, nc) [F] and motions u = W r + q (d, nc) [L] for the operator w with blocks
  !> diagonal (d, d, nc) [L/F]; r on entry is the start where options%warm_start. Takes at most
  !> options%max_sweeps products, counted as sweeps. Fails when the certificate is not met.
  subroutine solve_by_products(options, w, diagonal, q, mu, r, u, certificate, status)
    type(cone_options_t), intent(in) :: options
    class(operator_t), intent(in) :: w
    real(wp), intent(in) :: diagonal(:, :, :), q(:, :), mu(:)
    real(wp), intent(inout) :: r(:, :)
    real(wp), intent(out) :: u(:, :)
    type(certificate_t), intent(out) :: certificate
    type(status_t), intent(inout) :: status
    type(gradient_t) :: g
    integer :: k
    if (.not. options%warm_start .or. all(q(1, :) >= zero)) r = zero
    u = q
    if (all(q(1, :) >= zero)) return
    call start_gradient(w, diagonal, options%rho_factor, g)
    call restart_gradient(r, g)
    do while (certificate%sweeps < options%max_sweeps)
      if (late(options)) exit
      do k = 1, chunk
        call gradient_step(w, q, mu, r, g)
      end do
      call w%apply(r, u)
      u = u + q
      certificate%sweeps = certificate%sweeps + chunk + 1
      call certify(mean_of(diagonal), mu, q, r, u, options%tolerance, certificate)
      if (certificate%met) return
    end do
    call fail_uncertified(mean_of(diagonal), diagonal, mu, r, u, certificate, status)
  end subroutine solve_by_products

  !> Mean of the diagonal of W [L/F].
  pure real(wp) function mean_of(diagonal)
    real(wp), intent(in) :: diagonal(:, :, :)
    integer :: i
    mean_of = zero
    do i = 1, size(diagonal, 1)
      mean_of = mean_of + sum(diagonal(i, i, :))
    end do
    mean_of = mean_of/(size(diagonal, 1)*size(diagonal, 3))
  end function mean_of

end module cone_products
