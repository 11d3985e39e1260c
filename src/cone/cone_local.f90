! SPDX-License-Identifier: BSD-3-Clause
!> One contact: projection on Coulomb's cone and the bi-potential predictor/corrector.
module cone_local
  use base_kinds, only: wp, zero, one
  use cone_types, only: contact_open, contact_stick, contact_slip
  implicit none
  private
  public :: project_on_cone, solve_local, tangent_length

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

  !> r = projection of tau on {|r_t| <= mu r_n}, and which part of the cone it lies on (De Saxce
  !> & Feng 1991). The polar cone is tested first.
  pure subroutine project_on_cone(mu, tau, r, status)
    real(wp), intent(in) :: mu
    real(wp), intent(in) :: tau(:)
    real(wp), intent(out) :: r(:)
    integer, intent(out) :: status
    real(wp) :: length
    length = tangent_length(tau)
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
  end subroutine project_on_cone

  !> Predictor and corrector with the local law (De Saxce & Feng 1998):
  !>   tau = r - rho (u_n + mu |u_t|, u_t),  r = P_K(tau),  u = w r + q,
  !> repeated until r moves less than `enough`. On entry u belongs to r; on exit too.
  pure subroutine solve_local(w, mu, rho, enough, max_iterations, r, u, status, iterations)
    real(wp), intent(in) :: w(:, :)
    real(wp), intent(in) :: mu
    real(wp), intent(in) :: rho
    real(wp), intent(in) :: enough
    integer, intent(in) :: max_iterations
    real(wp), intent(inout) :: r(:)
    real(wp), intent(inout) :: u(:)
    integer, intent(out) :: status
    integer, intent(out) :: iterations
    real(wp), dimension(size(r)) :: tau, next, change
    integer :: i
    status = contact_open
    do iterations = 1, max_iterations
      tau = r - rho*u
      tau(1) = tau(1) - rho*mu*tangent_length(u)
      call project_on_cone(mu, tau, next, status)
      change = next - r
      do i = 1, size(r)
        u = u + w(:, i)*change(i)
      end do
      r = next
      if (maxval(abs(change)) <= enough) exit
    end do
    iterations = min(iterations, max_iterations)
  end subroutine solve_local

end module cone_local
