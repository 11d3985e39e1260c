! SPDX-License-Identifier: BSD-3-Clause
!> One contact solved exactly: every status is tried. In the plane slip has two directions; in
!> space the direction of slip is a root of a trigonometric polynomial of degree two, the
!> quartic of Bonnefon & Daviet (2011), here bracketed on the circle.
module cone_exact
  use base_kinds, only: wp, zero, one, half
  use cone_types, only: contact_open, contact_stick, contact_slip, most_components
  use cone_local, only: tangent_length
  use linalg_dense, only: solve_small
  implicit none
  private
  public :: solve_exact

  integer, parameter :: directions = 32   !< of the circle, between which roots are looked for
  integer, parameter :: halvings = 60

contains

  !> r (d) and u = w r + q (d) of the law of contact and friction for W_aa = w (d, d); on entry
  !> u belongs to r. Where several answers exist (wedging), the one nearest to r on entry. found
  !> is false where there is none, or w is singular; r and u are then as before.
  pure subroutine solve_exact(w, mu, r, u, status, found)
    real(wp), intent(in) :: w(:, :)
    real(wp), intent(in) :: mu
    real(wp), intent(inout) :: r(:), u(:)
    integer, intent(out) :: status
    logical, intent(out) :: found
    real(wp), dimension(most_components) :: q, best
    real(wp) :: nearest
    integer :: d, i
    d = size(r)
    q(:d) = u
    do i = 1, d
      q(:d) = q(:d) - w(:, i)*r(i)
    end do
    found = .true.
    status = contact_open
    nearest = huge(nearest)
    best = zero
    if (q(1) >= zero) nearest = sum(r**2)
    call try_stick(w, mu, q(:d), r, nearest, best(:d), status)
    if (mu > zero .and. q(1) < zero) then
      if (d == 2) call try_slip_plane(w, mu, q(:d), r, nearest, best(:d), status)
      if (d == 3) call try_slip_space(w, mu, q(:d), r, nearest, best(:d), status)
    else if (d > 1 .and. q(1) < zero .and. w(1, 1) > zero) then
      call keep(r, [one, zero, zero], -q(1)/w(1, 1), nearest, best(:d), status)
    end if
    found = nearest < huge(nearest)
    if (.not. found) return
    r = best(:d)
    u = q(:d)
    do i = 1, d
      u = u + w(:, i)*r(i)
    end do
  end subroutine solve_exact

  !> u = 0, where that needs no more friction than there is.
  pure subroutine try_stick(w, mu, q, r, nearest, best, status)
    real(wp), intent(in) :: w(:, :), mu, q(:), r(:)
    real(wp), intent(inout) :: nearest, best(:)
    integer, intent(inout) :: status
    real(wp) :: s(most_components), b(most_components), distance
    integer :: d
    logical :: ok
    d = size(q)
    b(:d) = -q
    call solve_small(w, b(:d), s(:d), ok)
    if (.not. ok) return
    if (.not. s(1) > zero) return
    if (d > 1) then
      if (tangent_length(s(:d)) > mu*s(1)) return
    end if
    distance = sum((s(:d) - r)**2)
    if (distance >= nearest) return
    nearest = distance
    best = s(:d)
    status = contact_stick
  end subroutine try_stick

  pure subroutine try_slip_plane(w, mu, q, r, nearest, best, status)
    real(wp), intent(in) :: w(:, :), mu, q(:), r(:)
    real(wp), intent(inout) :: nearest, best(:)
    integer, intent(inout) :: status
    real(wp) :: side, bottom, normal, slip
    integer :: k
    do k = 1, 2
      side = merge(one, -one, k == 1)
      bottom = w(1, 1) - side*mu*w(1, 2)
      if (.not. bottom > epsilon(one)*w(1, 1)) cycle
      normal = -q(1)/bottom
      slip = q(2) + (w(2, 1) - side*mu*w(2, 2))*normal
      if (side*slip < zero) cycle
      call keep(r, [one, -side*mu, zero], normal, nearest, best, status)
    end do
  end subroutine try_slip_plane

  !> e = (cos, sin) is the direction of slip: r = r_n (1, -mu e), u_n = 0, and u_t has no
  !> component across e.
  pure subroutine try_slip_space(w, mu, q, r, nearest, best, status)
    real(wp), intent(in) :: w(:, :), mu, q(:), r(:)
    real(wp), intent(inout) :: nearest, best(:)
    integer, intent(inout) :: status
    real(wp), parameter :: turn = 6.283185307179586_wp
    real(wp) :: low, high, at_low, at_high, at_first, e(2), bottom, normal, slip(2)
    integer :: k
    high = zero
    at_first = across(w, mu, q, high)
    at_high = at_first
    do k = 1, directions
      low = high
      at_low = at_high
      high = turn*k/directions
      at_high = at_first                     ! the circle closes to the last bit
      if (k < directions) at_high = across(w, mu, q, high)
      if (.not. has_root(at_low, at_high)) cycle
      e = direction_between(w, mu, q, low, high, at_high)
      bottom = w(1, 1) - mu*(w(1, 2)*e(1) + w(1, 3)*e(2))
      if (.not. bottom > epsilon(one)*w(1, 1)) cycle
      normal = -q(1)/bottom
      slip = q(2:3) + normal*(w(2:3, 1) - mu*(w(2:3, 2)*e(1) + w(2:3, 3)*e(2)))
      if (slip(1)*e(1) + slip(2)*e(2) < zero) cycle
      call keep(r, [one, -mu*e], normal, nearest, best, status)
    end do
  end subroutine try_slip_space

  !> A root in an interval without its lower end, or at its upper end: a root at a direction
  !> that is tried (slip along a tangent, say) is that of one interval, not of two.
  pure logical function has_root(at_low, at_high)
    real(wp), intent(in) :: at_low, at_high
    has_root = (at_low < zero .and. at_high >= zero) .or. (at_low > zero .and. at_high <= zero)
  end function has_root

  !> The direction between two angles where `across` changes its sign, by bisection; that of
  !> high where it is zero there.
  pure function direction_between(w, mu, q, from, to, at_to) result(e)
    real(wp), intent(in) :: w(:, :), mu, q(:), from, to, at_to
    real(wp) :: e(2), low, high, middle
    logical :: is_above
    integer :: i
    low = from
    high = to
    if (abs(at_to) > zero) then
      do i = 1, halvings
        middle = half*(low + high)
        is_above = across(w, mu, q, middle) > zero
        if (is_above .eqv. at_to > zero) then
          high = middle
        else
          low = middle
        end if
      end do
    end if
    e = [cos(high), sin(high)]
  end function direction_between

  !> Component of u_t across the direction at `angle`, times the (positive) denominator of r_n.
  pure real(wp) function across(w, mu, q, angle)
    real(wp), intent(in) :: w(:, :), mu, q(:), angle
    real(wp) :: c, s, bottom, t(2)
    c = cos(angle)
    s = sin(angle)
    bottom = w(1, 1) - mu*(w(1, 2)*c + w(1, 3)*s)
    t = bottom*q(2:3) - q(1)*(w(2:3, 1) - mu*(w(2:3, 2)*c + w(2:3, 3)*s))
    across = c*t(2) - s*t(1)
  end function across

  !> r = normal * direction as an answer, if it is nearer than the one there is.
  pure subroutine keep(r, direction, normal, nearest, best, status)
    real(wp), intent(in) :: r(:), direction(3), normal
    real(wp), intent(inout) :: nearest, best(:)
    integer, intent(inout) :: status
    real(wp) :: distance
    integer :: d
    d = size(r)
    distance = sum((normal*direction(:d) - r)**2)
    if (distance >= nearest) return
    nearest = distance
    best = normal*direction(:d)
    status = contact_slip
  end subroutine keep

end module cone_exact
