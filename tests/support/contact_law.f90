! SPDX-License-Identifier: BSD-3-Clause
!> The law of contact and friction asked of an answer from outside: from W, q, mu and r alone,
!> by nothing of the solver's own.
module contact_law
  use base_kinds, only: wp, zero, one
  implicit none
  private
  public :: law_misses

contains

  !> How many contacts miss the law of u = W r + q by more than `share` of the largest force or
  !> displacement: u_n < 0, r outside its cone, a force at an open contact, slip that the force
  !> does not oppose. W (d nc, d nc), q and r (d, nc), mu (nc) of any size.
  integer function law_misses(w, q, mu, r, share) result(misses)
    real(wp), intent(in) :: w(:, :), q(:, :), mu(:), r(:, :), share
    real(wp) :: u(size(q, 1), size(q, 2)), m, force, length, slip
    integer :: a
    m = sum([(w(a, a), a=1, size(w, 1))])/size(w, 1)
    u = reshape(matmul(w, reshape(r, [size(r)])), shape(q)) + q
    length = share*max(norm2(q), norm2(u), m*norm2(r))
    force = length/m
    misses = 0
    do a = 1, size(mu)
      slip = norm2(u(2:, a))
      if (u(1, a) < -length .or. r(1, a) < zero .or. outside(mu(a), r(:, a), share)) then
        misses = misses + 1
      else if (norm2(r(:, a)) <= force) then
        cycle
      else if (u(1, a) > length) then
        misses = misses + 1
      else if (slip > length) then
        if (.not. opposed(mu(a), r(:, a), u(:, a), share)) misses = misses + 1
      end if
    end do
  end function law_misses

  !> |r_t| > mu r_n, without a product that could overflow.
  logical function outside(mu, r, share)
    real(wp), intent(in) :: mu, r(:), share
    outside = norm2(r(2:))/max(one, mu) > (one + share)*min(one, mu)*r(1)
  end function outside

  !> r_t = -mu r_n u_t/|u_t|: its size, and its direction as far as either vector is known.
  logical function opposed(mu, r, u, share)
    real(wp), intent(in) :: mu, r(:), u(:), share
    real(wp), parameter :: coarse = 1.0e-4_wp
    opposed = norm2(r(2:))/max(one, mu) >= (one - coarse)*min(one, mu)*r(1) - share*r(1)
    if (mu > zero) opposed = opposed .and. &
        dot_product(r(2:), u(2:)) <= -(one - coarse)*norm2(r(2:))*norm2(u(2:))
  end function opposed

end module contact_law
