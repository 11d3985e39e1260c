! SPDX-License-Identifier: BSD-3-Clause
!> How good a solution is: the natural map, scaled so that no unit enters, and the bi-potential.
module cone_certificate
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, fail, status_numerical
  use base_strings, only: to_text
  use cone_types, only: certificate_t, most_components
  use cone_local, only: may_wedge, predictor, project_on_cone, tangent_length
  implicit none
  private
  public :: certify, bipotential_residual, mean_diagonal, fail_uncertified

  real(wp), parameter :: nothing = 1.0e-300_wp

contains

  !> e = b(-u, r) + u.r = mu r_n |u_t| + r_t.u_t + r_n u_n of one contact [F L]: zero exactly
  !> where the law of contact and friction holds (De Saxce & Feng 1998); an energy misfit.
  pure real(wp) function bipotential_residual(mu, r, u)
    real(wp), intent(in) :: mu
    real(wp), intent(in) :: r(:)
    real(wp), intent(in) :: u(:)
    bipotential_residual = mu*r(1)*tangent_length(u) + dot_product(r, u)
  end function bipotential_residual

  !> Mean of the diagonal of W [L/F]: the scale between forces and motions.
  pure real(wp) function mean_diagonal(w)
    real(wp), intent(in) :: w(:, :)
    integer :: i
    mean_diagonal = zero
    do i = 1, size(w, 1)
      mean_diagonal = mean_diagonal + w(i, i)
    end do
    mean_diagonal = mean_diagonal/max(1, size(w, 1))
  end function mean_diagonal

  !> error, error2018 and eta of (r, u); m = mean_diagonal(W). noise [L], where given, is the
  !> round-off of q and u as differences of larger numbers: misfits of that size count as met,
  !> and mu times that, which is what the law makes of it. Where mu is large the natural map
  !> does not see u_n < 0 (it divides by 1 + mu^2), so that is asked for apart.
  pure subroutine certify(m, mu, q, r, u, tolerance, certificate, noise)
    real(wp), intent(in) :: m
    real(wp), intent(in) :: mu(:)
    real(wp), intent(in) :: q(:, :)
    real(wp), intent(in) :: r(:, :)
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(in) :: tolerance
    type(certificate_t), intent(inout) :: certificate
    real(wp), intent(in), optional :: noise
    real(wp) :: misfit, norm_r, norm_q, norm_u, bottom, round_off, depth
    integer :: a
    norm_r = sqrt(sum(r**2))
    norm_q = sqrt(sum(q**2))
    norm_u = sqrt(sum(u**2))
    round_off = 8.0_wp*epsilon(one)*max(norm_q, m*norm_r)
    if (present(noise)) round_off = max(round_off, noise)
    norm_q = max(norm_q, round_off*(one + maxval(mu))/tolerance)
    certificate%error = zero
    certificate%eta = zero
    certificate%error2018 = zero
    if (all(q(1, :) >= zero) .and. norm_r <= zero) return
    misfit = zero
    do a = 1, size(mu)
      misfit = misfit + abs(bipotential_residual(mu(a), r(:, a), u(:, a)))
    end do
    bottom = max(norm_r, max(norm_q, norm_u)/m)
    if (bottom > nothing) certificate%error = natural_map(one/m, mu, r, u)/bottom
    bottom = norm_r*max(norm_u, norm_q)
    if (bottom > nothing) certificate%eta = misfit/bottom
    if (norm_q > nothing) certificate%error2018 = natural_map(one, mu, r, u)/norm_q
    depth = sqrt(sum(min(u(1, :), zero)**2))
    certificate%met = certificate%error <= tolerance .and. certificate%eta <= tolerance &
        .and. depth <= 10.0_wp*tolerance*max(m*norm_r, norm_q, norm_u)
  end subroutine certify

  !> The failure of a solve without certificate: what was spent, how near it came, and the
  !> contact that misses its law most (certificate%worst); diagonal (d, d, nc) holds W_aa.
  pure subroutine fail_uncertified(m, diagonal, mu, r, u, certificate, status)
    real(wp), intent(in) :: m, diagonal(:, :, :), mu(:), r(:, :), u(:, :)
    type(certificate_t), intent(inout) :: certificate
    type(status_t), intent(inout) :: status
    character(:), allocatable :: wedging
    real(wp) :: largest, own
    integer :: a
    certificate%worst = 1
    largest = zero
    do a = 1, size(mu)
      own = natural_map(one/m, mu(a:a), r(:, a:a), u(:, a:a))
      if (.not. own > largest) cycle
      largest = own
      certificate%worst = a
    end do
    a = certificate%worst
    wedging = ''
    if (may_wedge(diagonal(:, :, a), mu(a))) &
        wedging = ', and it wedges (mu |W_nt| > W_nn): it may have no solution'
    call fail(status, status_numerical, 'the contact solve did not converge in '// &
        to_text(certificate%sweeps)//' sweeps and '//to_text(certificate%newton_steps)// &
        ' Newton steps: error '//to_text(certificate%error)//', eta '// &
        to_text(certificate%eta)//'; contact '//to_text(a)//' misses its law most'//wedging, &
        hint='raise MAXIT or TOL on *BIPACT_CONTACT, or refine the step')
  end subroutine fail_uncertified

  !> |r - P_K(r - rho (u_n + mu |u_t|, u_t))| over all contacts.
  pure real(wp) function natural_map(rho, mu, r, u)
    real(wp), intent(in) :: rho
    real(wp), intent(in) :: mu(:)
    real(wp), intent(in) :: r(:, :)
    real(wp), intent(in) :: u(:, :)
    real(wp), dimension(most_components) :: tau, projected
    integer :: a, d, status
    d = size(r, 1)
    natural_map = zero
    do a = 1, size(mu)
      call predictor(mu(a), rho, r(:, a), u(:, a), tau(:d))
      call project_on_cone(mu(a), tau(:d), projected(:d), status)
      natural_map = natural_map + sum((r(:, a) - projected(:d))**2)
    end do
    natural_map = sqrt(natural_map)
  end function natural_map

end module cone_certificate
