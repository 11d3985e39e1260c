! SPDX-License-Identifier: BSD-3-Clause
!> How good a solution is: the natural map, scaled so that no unit enters, and the bi-potential.
module cone_certificate
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, fail, status_numerical
  use base_strings, only: to_text
  use cone_delassus, only: delassus_t
  use cone_local, only: may_wedge, predict_and_correct, tangent_length
  use cone_types, only: certificate_t, most_components, largest_ordinary, large_friction
  implicit none
  private
  public :: certify, evaluate_certificate, add_error2018, is_ordinary, bipotential_residual, &
      find_statuses, count_wedging, fail_uncertified

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

  !> error, error2018 and eta of (r, u) (d, nc), finite in every unit; m = mean diagonal of W
  !> [L/F]. noise [L], where given, is the round-off of q and u as differences of larger
  !> numbers: misfits of that size count as met, and mu times that, which is what the law makes
  !> of it. Nothing in it overflows; |q| and |u| below 1e-300 count as 0.
  pure subroutine certify(m, mu, q, r, u, tolerance, certificate, noise)
    real(wp), intent(in) :: m
    real(wp), intent(in), contiguous :: mu(:), q(:, :), r(:, :), u(:, :)
    real(wp), intent(in) :: tolerance
    type(certificate_t), intent(inout) :: certificate
    real(wp), intent(in), optional :: noise
    if (is_ordinary(m, mu, q, r, u)) then
      call evaluate_certificate(m, mu, q, r, u, tolerance, certificate, noise)
      call add_error2018(one, mu, r, u, certificate)
    else
      call certify_rescaled(m, mu, q, r, u, tolerance, certificate, noise)
    end if
  end subroutine certify

  !> Are all numbers far from where their squares and products overflow, or vanish?
  pure logical function is_ordinary(m, mu, q, r, u)
    real(wp), intent(in) :: m
    real(wp), intent(in), contiguous :: mu(:), q(:, :), r(:, :), u(:, :)
    is_ordinary = m >= one/largest_ordinary .and. m <= largest_ordinary
    if (is_ordinary) is_ordinary = all_ordinary(size(mu), size(q), mu, q, r, u)
  end function is_ordinary

  pure logical function all_ordinary(contacts, n, mu, q, r, u) result(ordinary)
    integer, intent(in) :: contacts, n
    real(wp), intent(in) :: mu(contacts), q(n), r(n), u(n)
    integer :: i
    ordinary = .false.
    do i = 1, contacts
      if (.not. mu(i) <= largest_ordinary) return
    end do
    do i = 1, n
      if (.not. abs(q(i)) <= largest_ordinary) return
      if (.not. abs(u(i)) <= largest_ordinary) return
      if (.not. abs(r(i)) <= largest_ordinary**2) return
    end do
    do i = 1, n
      ordinary = max(abs(q(i)), abs(u(i))) >= one/largest_ordinary
      if (ordinary) return
    end do
  end function all_ordinary

  !> The same in other units, by powers of two, in which the numbers are ordinary.
  pure subroutine certify_rescaled(m, mu, q, r, u, tolerance, certificate, noise)
    real(wp), intent(in) :: m, tolerance
    real(wp), intent(in), contiguous :: mu(:), q(:, :), r(:, :), u(:, :)
    type(certificate_t), intent(inout) :: certificate
    real(wp), intent(in), optional :: noise
    real(wp) :: own_noise, unit
    integer :: e, f
    certificate%error = huge(one)
    certificate%eta = huge(one)
    certificate%error2018 = huge(one)
    certificate%met = .false.
    if (.not. (ieee_is_finite(m) .and. all(ieee_is_finite(q)) .and. all(ieee_is_finite(r)) &
        .and. all(ieee_is_finite(u)))) return
    e = exponent(m)
    f = max(exponent(maxval(abs(q))), exponent(maxval(abs(u))))
    if (maxval(abs(q)) <= nothing .and. maxval(abs(u)) <= nothing) f = exponent(nothing)
    if (any(abs(r) > zero)) f = max(f, e + exponent(maxval(abs(r))))
    own_noise = zero
    if (present(noise)) own_noise = scale(noise, -f)
    associate (mu_c => min(mu, largest_ordinary), q_c => scale(q, -f), r_c => scale(r, e - f), &
        u_c => scale(u, -f))
      call evaluate_certificate(scale(m, -e), mu_c, q_c, r_c, u_c, tolerance, certificate, &
          own_noise, mu)
      unit = scale(one, max(-400, min(400, e)))
      call add_error2018(unit, mu_c, r_c, u_c, certificate)
    end associate
    if (f > exponent(nothing)) return
    certificate%error = zero
    certificate%eta = zero
    certificate%error2018 = zero
    certificate%met = .true.
  end subroutine certify_rescaled

  !> error and eta of (r, u) where all numbers are ordinary, as in `certify`. The natural map
  !> divides u_n < 0 by 1 + mu^2, so penetration is asked for apart. Where friction is large it
  !> multiplies the round-off of u_t by mu, too, and the law itself is asked for: with all of
  !> mu_exact, where that is given and mu is less.
  pure subroutine evaluate_certificate(m, mu, q, r, u, tolerance, certificate, noise, mu_exact)
    real(wp), intent(in) :: m
    real(wp), intent(in), contiguous :: mu(:), q(:, :), r(:, :), u(:, :)
    real(wp), intent(in) :: tolerance
    type(certificate_t), intent(inout) :: certificate
    real(wp), intent(in), optional :: noise, mu_exact(:)
    real(wp) :: misfit, norm_r, norm_q, norm_u, least_q, bottom, round_off, depth, largest_mu
    integer :: a
    norm_r = norm_of(size(r), r)
    norm_q = norm_of(size(q), q)
    norm_u = norm_of(size(u), u)
    round_off = 8.0_wp*epsilon(one)*max(norm_q, m*norm_r)
    if (present(noise)) round_off = max(round_off, noise)
    largest_mu = maxval(mu)
    least_q = max(norm_q, round_off/tolerance)
    norm_q = max(norm_q, round_off*(one + largest_mu)/tolerance)
    certificate%norm_q = norm_q
    certificate%error = zero
    certificate%eta = zero
    certificate%error2018 = zero
    certificate%met = .true.
    if (all(q(1, :) >= zero) .and. norm_r <= zero) return
    misfit = zero
    do a = 1, size(mu)
      misfit = misfit + abs(bipotential_residual(mu(a), r(:, a), u(:, a)))
    end do
    bottom = max(norm_r, max(norm_q, norm_u)/m)
    if (bottom > nothing) certificate%error = &
        residual_norm(size(r, 1), size(mu), one/m, mu, r, u)/bottom
    bottom = norm_r*max(norm_u, norm_q)
    if (bottom > nothing) certificate%eta = misfit/bottom
    if (largest_mu > large_friction) then
      bottom = max(norm_r, max(least_q, norm_u)/m)
      if (present(mu_exact)) then
        certificate%error = max(certificate%error, law_residual(m, mu_exact, r, u)/bottom)
      else
        certificate%error = max(certificate%error, law_residual(m, mu, r, u)/bottom)
      end if
    end if
    depth = sqrt(sum(min(u(1, :), zero)**2))
    certificate%met = certificate%error <= tolerance .and. certificate%eta <= tolerance &
        .and. depth <= 10.0_wp*tolerance*max(m*norm_r, least_q, norm_u)
  end subroutine evaluate_certificate

  pure real(wp) function norm_of(n, x)
    integer, intent(in) :: n
    real(wp), intent(in) :: x(n)
    norm_of = sqrt(sum(x**2))
  end function norm_of

  !> error2018 = |natural map with rho = 1| / |q| after evaluate_certificate; unit = 1 in the
  !> unit of W in which r and u are given.
  pure subroutine add_error2018(unit, mu, r, u, certificate)
    real(wp), intent(in) :: unit
    real(wp), intent(in), contiguous :: mu(:), r(:, :), u(:, :)
    type(certificate_t), intent(inout) :: certificate
    certificate%error2018 = zero
    if (certificate%norm_q > nothing) &
        certificate%error2018 = &
        residual_norm(size(r, 1), size(mu), unit, mu, r, u)/(unit*certificate%norm_q)
  end subroutine add_error2018

  !> The failure of a solve without certificate: what was spent, how near it came, and the
  !> contact with the largest residual (certificate%worst).
  pure subroutine fail_uncertified(m, w, mu, r, u, certificate, status)
    real(wp), intent(in) :: m
    class(delassus_t), intent(in) :: w
    real(wp), intent(in), contiguous :: mu(:), r(:, :), u(:, :)
    type(certificate_t), intent(inout) :: certificate
    type(status_t), intent(inout) :: status
    character(:), allocatable :: wedging
    real(wp) :: block(most_components, most_components), largest, own
    integer :: a
    certificate%worst = 1
    largest = zero
    do a = 1, size(mu)
      own = residual_norm(size(r, 1), 1, one/m, mu(a:a), r(:, a), u(:, a))
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
        to_text(certificate%eta)//'; contact '//to_text(a)//' has the largest residual'// &
        wedging, hint='raise MAXIT or TOL on *BIPACT_CONTACT, or refine the step')
  end subroutine fail_uncertified

  !> Statuses (nc) by the part of the cone on which the corrector of (r, u) (d, nc) lies; m =
  !> mean diagonal of W [L/F].
  pure subroutine find_statuses(m, mu, r, u, status)
    real(wp), intent(in) :: m
    real(wp), intent(in), contiguous :: mu(:), r(:, :), u(:, :)
    integer, intent(out) :: status(:)
    real(wp), dimension(most_components) :: tau, projected
    integer :: a, d
    d = size(r, 1)
    do a = 1, size(mu)
      call predict_and_correct(d, mu(a), one/m, r(:, a), u(:, a), tau, projected, status(a))
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
  pure real(wp) function residual_norm(d, contacts, rho, mu, r, u)
    integer, intent(in) :: d, contacts
    real(wp), intent(in) :: rho, mu(contacts), r(d, contacts), u(d, contacts)
    real(wp), dimension(most_components) :: tau, projected
    integer :: a, status
    residual_norm = zero
    do a = 1, contacts
      call predict_and_correct(d, mu(a), rho, r(:, a), u(:, a), tau, projected, status)
      residual_norm = residual_norm + sum((r(:, a) - projected(:d))**2)
    end do
    residual_norm = sqrt(residual_norm)
  end function residual_norm

  !> The law of contact and of friction one by one, over all contacts [F]: u_n >= 0, nothing
  !> pushes where u_n > 0, and r_t = P(r_t - u_t/m) on the disc of radius mu r_n (Alart &
  !> Curnier 1991). No number is multiplied by mu, so that it holds for any friction.
  pure real(wp) function law_residual(m, mu, r, u)
    real(wp), intent(in) :: m, mu(:), r(:, :), u(:, :)
    real(wp) :: tau(most_components), normal, length
    integer :: a, d
    d = size(r, 1)
    law_residual = zero
    do a = 1, size(mu)
      normal = abs(u(1, a))/m
      if (u(1, a) > zero) normal = min(normal, sqrt(sum(r(:, a)**2)))
      normal = max(normal, -r(1, a))
      tau(:d) = r(:, a) - u(:, a)/m
      length = tangent_length(tau(:d))
      if (length > zero) then
        if (.not. length/max(mu(a), one) <= r(1, a)*min(one, mu(a))) &
            tau(:d) = tau(:d)*(mu(a)*max(zero, r(1, a))/length)
      end if
      law_residual = law_residual + normal**2 + sum((r(2:, a) - tau(2:d))**2)
    end do
    law_residual = sqrt(law_residual)
  end function law_residual

end module cone_certificate
