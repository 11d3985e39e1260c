! SPDX-License-Identifier: BSD-3-Clause
!> The contact problem by products with W alone, for every kind of W.
module cone_products_solver
  use base_kinds, only: wp
  use base_status, only: status_t
  use cone_certificate, only: evaluate_certificate, fail_uncertified
  use cone_delassus, only: delassus_t
  use cone_gradient, only: gradient_t, start_gradient, restart_gradient, gradient_step
  use cone_types, only: cone_options_t, certificate_t, late
  implicit none
  private
  public :: solve_by_products

  integer, parameter :: chunk = 10         !< steps between two evaluations of the error

contains

  !> Reactions r (d, nc) [F] and displacements u = W r + q (d, nc) [L]; r on entry is the start,
  !> m the mean diagonal of W [L/F].
  !> Takes at most options%max_sweeps products, counted as sweeps. Fails when the certificate is
  !> not met.
  subroutine solve_by_products(options, w, q, mu, m, r, u, certificate, status)
    type(cone_options_t), intent(in) :: options
    class(delassus_t), intent(in) :: w
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(in) :: m
    real(wp), intent(inout), contiguous :: r(:, :), u(:, :)
    type(certificate_t), intent(inout) :: certificate
    type(status_t), intent(inout) :: status
    type(gradient_t) :: g
    integer :: k
    call start_gradient(w, options%rho_factor, g)
    call restart_gradient(r, g)
    do while (certificate%sweeps < options%max_sweeps)
      if (late(options)) exit
      do k = 1, chunk
        call gradient_step(w, q, mu, r, g)
      end do
      call w%apply(r, u)
      u = u + q
      certificate%sweeps = certificate%sweeps + chunk + 1
      call evaluate_certificate(m, mu, q, r, u, options%tolerance, certificate)
      if (certificate%met) return
    end do
    call fail_uncertified(m, w, mu, r, u, certificate, status)
  end subroutine solve_by_products

end module cone_products_solver
