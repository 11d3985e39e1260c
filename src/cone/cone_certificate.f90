! SPDX-License-Identifier: BSD-3-Clause
!> How good a solution is: the natural map, scaled so that no unit enters, and the bi-potential.
module cone_certificate
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, fail, status_numerical
  use base_strings, only: to_text
  use cone_delassus, only: delassus_t
  use cone_local, only: may_wedge, predict_and_correct, tangent_length
  use cone_types, only: certificate_t, most_components
  implicit none
  private
  public :: certify, bipotential_residual, find_statuses, count_wedging, fail_uncertified

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

  !> error, error2018 and eta of (r, u); m = mean diagonal of W [L/F]. noise [L], where given, is the
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
    if (bottom > nothing) certificate%error = residual_norm(one/m, mu, r, u)/bottom
    bottom = norm_r*max(norm_u, norm_q)
    if (bottom > nothing) certificate%eta = misfit/bottom
    if (norm_q > nothing) certificate%error2018 = residual_norm(one, mu, r, u)/norm_q
    depth = sqrt(sum(min(u(1, :), zero)**2))
    certificate%met = certificate%error <= tolerance .and. certificate%eta <= tolerance &
        .and. depth <= 10.0_wp*tolerance*max(m*norm_r, norm_q, norm_u)
  end subroutine certify

  !> The failure of a solve without certificate: what was spent, how near it came, and the
  !> contact with the largest residual (certificate%worst).
  pure subroutine fail_uncertified(m, w, mu, r, u, certificate, status)
    real(wp), intent(in) :: m
    class(delassus_t), intent(in) :: w
    real(wp), intent(in) :: mu(:), r(:, :), u(:, :)
    type(certificate_t), intent(inout) :: certificate
    type(status_t), intent(inout) :: status
    character(:), allocatable :: wedging
    real(wp) :: block(most_components, most_components), largest, own
    integer :: a
    certificate%worst = 1
    largest = zero
    do a = 1, size(mu)
      own = residual_norm(one/m, mu(a:a), r(:, a:a), u(:, a:a))
      if (.not. own > largest) cycle
      largest = own
      certificate%worst = a
    end do
    a = certificate%worst
    wedging = ''
    call w%diagonal_block(a, block)
    if (may_wedge(block(:w%d, :w%d), mu(a))) &
        wedging = ', and it wedges (mu |W_nt| > W_nn): it may have no solution'
    call fail(status, status_numerical, 'the contact solve did not converge in '// &
        to_text(certificate%sweeps)//' sweeps and '//to_text(certificate%newton_steps)// &
        ' Newton steps: error '//to_text(certificate%error)//', eta '// &
        to_text(certificate%eta)//'; contact '//to_text(a)//' has the largest residual'//wedging, &
        hint='raise MAXIT or TOL on *BIPACT_CONTACT, or refine the step')
  end subroutine fail_uncertified

  !> Statuses (nc) by the part of the cone on which the corrector of (r, u) (d, nc) lies; m =
  !> mean diagonal of W [L/F].
  pure subroutine find_statuses(m, mu, r, u, status)
    real(wp), intent(in) :: m
    real(wp), intent(in) :: mu(:), r(:, :), u(:, :)
    integer, intent(out) :: status(:)
    real(wp), dimension(most_components) :: tau, projected
    integer :: a, d
    d = size(r, 1)
    do a = 1, size(mu)
      call predict_and_correct(mu(a), one/m, r(:, a), u(:, a), tau(:d), projected(:d), &
          status(a))
    end do
  end subroutine find_statuses

  !> Contacts that push and for which W_aa alone allows several answers: one was taken, which
  !> is told.
  pure subroutine count_wedging(w, mu, r, certificate)
    class(delassus_t), intent(in) :: w
    real(wp), intent(in) :: mu(:), r(:, :)
    type(certificate_t), intent(inout) :: certificate
    real(wp) :: block(most_components, most_components)
    integer :: a
    certificate%wedged = 0
    certificate%first_wedged = 0
    if (w%d == 1) return
    do a = 1, size(mu)
      if (.not. r(1, a) > zero) cycle
      call w%diagonal_block(a, block)
      if (.not. may_wedge(block(:w%d, :w%d), mu(a))) cycle
      if (certificate%wedged == 0) certificate%first_wedged = a
      certificate%wedged = certificate%wedged + 1
    end do
  end subroutine count_wedging

  !> |r - P_K(r - rho (u_n + mu |u_t|, u_t))| over all contacts.
  pure real(wp) function residual_norm(rho, mu, r, u)
    real(wp), intent(in) :: rho
    real(wp), intent(in) :: mu(:)
    real(wp), intent(in) :: r(:, :)
    real(wp), intent(in) :: u(:, :)
    real(wp), dimension(most_components) :: tau, projected
    integer :: a, d, status
    d = size(r, 1)
    residual_norm = zero
    do a = 1, size(mu)
      call predict_and_correct(mu(a), rho, r(:, a), u(:, a), tau(:d), projected(:d), status)
      residual_norm = residual_norm + sum((r(:, a) - projected(:d))**2)
    end do
    residual_norm = sqrt(residual_norm)
  end function residual_norm

end module cone_certificate
