! SPDX-License-Identifier: BSD-3-Clause
!> One contact: projection on Coulomb's cone, its derivative, and the bi-potential
!> predictor/corrector. Vectors of a contact have at most `most_components` components, so that
!> work space lies on the stack.
module cone_local
  use base_kinds, only: wp, zero, one
  use cone_types, only: contact_open, contact_stick, contact_slip, most_components
  implicit none
  private
  public :: project_on_cone, in_cone, predict_and_correct, contact_map, solve_local, &
      tangent_length, size_of, may_wedge

contains

  !> Length of the tangential part of a vector (n, t[, s]).
  pure real(wp) function tangent_length(v)
    real(wp), intent(in) :: v(:)
    select case (size(v))
    case (1)
      tangent_length = zero
    case (2)
      tangent_length = abs(v(2))
    case default
      tangent_length = sqrt(v(2)**2 + v(3)**2)
    end select
  end function tangent_length

  !> The same of v(d).
  pure real(wp) function length_of(d, v)
    integer, intent(in) :: d
    real(wp), intent(in) :: v(d)
    length_of = zero
    if (d == 2) length_of = abs(v(2))
    if (d > 2) length_of = sqrt(v(2)**2 + v(3)**2)
  end function length_of

  !> The larger of normal and tangential part of v(d): the same for all tangents.
  pure real(wp) function size_of(d, v)
    integer, intent(in) :: d
    real(wp), intent(in) :: v(d)
    size_of = max(abs(v(1)), length_of(d, v))
  end function size_of

  !> Does W_aa = w alone allow several answers, or none? mu |W_nt| > W_nn (Klarbring 1990).
  pure logical function may_wedge(w, mu)
    real(wp), intent(in) :: w(:, :)
    real(wp), intent(in) :: mu
    real(wp) :: row(most_components), length
    integer :: d
    may_wedge = .false.
    d = size(w, 1)
    if (d == 1) return
    row(:d) = scale(w(1, :), -exponent(w(1, 1)))
    length = tangent_length(row(:d))
    if (mu > one) then
      may_wedge = length > row(1)/mu
    else
      may_wedge = mu*length > row(1)
    end if
  end function may_wedge

  !> r = projection of tau on {|r_t| <= mu r_n}, and which part of the cone it lies on (De Saxce
  !> & Feng 1991). The polar cone is tested first.
  pure subroutine project_on_cone(mu, tau, r, status)
    real(wp), intent(in) :: mu
    real(wp), intent(in), contiguous :: tau(:)
    real(wp), intent(out), contiguous :: r(:)
    integer, intent(out) :: status
    call project(size(tau), mu, tau, r, status)
  end subroutine project_on_cone

  pure subroutine project(d, mu, tau, r, status)
    integer, intent(in) :: d
    real(wp), intent(in) :: mu
    real(wp), intent(in) :: tau(d)
    real(wp), intent(out) :: r(d)
    integer, intent(out) :: status
    real(wp) :: length
    length = length_of(d, tau)
    if (mu*length <= -tau(1)) then
      r = zero
      status = contact_open
    else if (length <= mu*tau(1)) then
      r = tau
      status = contact_stick
    else
      r(1) = (tau(1) + mu*length)/(one + mu**2)
      if (length > zero) r(2:) = mu*r(1)*tau(2:)/length
      status = contact_slip
    end if
  end subroutine project

  !> dP/dtau (d, d) at tau, with P = projected and its status: zero, the identity, or on the
  !> slip side that of the cone (Joli & Feng 2008).
  pure subroutine projection_derivative(mu, tau, projected, status, part)
    real(wp), intent(in) :: mu
    real(wp), intent(in) :: tau(:)
    real(wp), intent(in) :: projected(:)
    integer, intent(in) :: status
    real(wp), intent(out) :: part(:, :)
    real(wp) :: length, share, t(most_components)
    integer :: i, d
    d = size(tau)
    part = zero
    if (status == contact_open) return
    if (status == contact_stick) then
      do i = 1, d
        part(i, i) = one
      end do
      return
    end if
    length = tangent_length(tau)
    t(:d) = tau/length
    t(1) = zero
    share = one/(one + mu**2)
    part(1, 1) = share
    do i = 2, d
      part(1, i) = mu*share*t(i)
      part(i, 1) = mu*share*t(i)
      part(2:, i) = (mu**2*share - mu*projected(1)/length)*t(2:d)*t(i)
      part(i, i) = part(i, i) + mu*projected(1)/length
    end do
  end subroutine projection_derivative

  !> Predictor tau = r - rho (u_n + mu |u_t|, u_t) and corrector P_K(tau) of d components with
  !> its status (De Saxce & Feng 1998). r - P_K(tau) is the natural map of the contact.
  pure subroutine predict_and_correct(d, mu, rho, r, u, tau, corrected, status)
    integer, intent(in) :: d
    real(wp), intent(in) :: mu, rho
    real(wp), intent(in) :: r(d), u(d)
    real(wp), intent(out) :: tau(d), corrected(d)
    integer, intent(out) :: status
    tau = r - rho*u
    tau(1) = tau(1) - rho*mu*length_of(d, u)
    call project(d, mu, tau, corrected, status)
  end subroutine predict_and_correct

  !> r in K, to round-off on the slip side.
  pure logical function in_cone(mu, r)
    real(wp), intent(in) :: mu
    real(wp), intent(in) :: r(:)
    real(wp), parameter :: slack = 1.0_wp + 8.0_wp*epsilon(1.0_wp)
    in_cone = r(1) >= zero
    if (size(r) > 1) in_cone = in_cone .and. tangent_length(r) <= slack*mu*r(1)
  end function in_cone

  !> map = r - P_K(tau) of one contact, the derivative (d, d) of P_K at tau, the status there.
  pure subroutine contact_map(mu, rho, r, u, map, part, status)
    real(wp), intent(in) :: mu, rho
    real(wp), intent(in), contiguous :: r(:), u(:)
    real(wp), intent(out) :: map(:), part(:, :)
    integer, intent(out) :: status
    real(wp), dimension(most_components) :: tau, projected
    integer :: d
    d = size(r)
    call predict_and_correct(d, mu, rho, r, u, tau, projected, status)
    map = r - projected(:d)
    call projection_derivative(mu, tau(:d), projected(:d), status, part)
  end subroutine contact_map

  !> Predictor and corrector with the local law (De Saxce & Feng 1998):
  !>   tau = r - rho (u_n + mu |u_t|, u_t),  r = P_K(tau),  u = w r + q,
  !> repeated until r moves less than `enough` (size_of). On entry u belongs to r; on exit too.
  pure subroutine solve_local(w, mu, rho, enough, max_iterations, r, u, status, iterations)
    real(wp), intent(in) :: w(:, :)
    real(wp), intent(in) :: mu
    real(wp), intent(in) :: rho
    real(wp), intent(in) :: enough
    integer, intent(in) :: max_iterations
    real(wp), intent(inout), contiguous :: r(:)
    real(wp), intent(inout), contiguous :: u(:)
    integer, intent(out) :: status
    integer, intent(out) :: iterations
    real(wp), dimension(most_components) :: tau, next, change
    integer :: i, d
    d = size(r)
    status = contact_open
    do iterations = 1, max_iterations
      call predict_and_correct(d, mu, rho, r, u, tau, next, status)
      change(:d) = next(:d) - r
      do i = 1, d
        u = u + w(:, i)*change(i)
      end do
      r = next(:d)
      if (size_of(d, change) <= enough) exit
    end do
    iterations = min(iterations, max_iterations)
  end subroutine solve_local

end module cone_local
