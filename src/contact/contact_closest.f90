! SPDX-License-Identifier: BSD-3-Clause
!> The closest point of a facet in space: a triangle in closed form, a bilinear quadrilateral by
!> Newton's method in the square of its parameters.
module contact_closest
  use base_kinds, only: wp, zero, one, half
  implicit none
  private
  public :: closest_on_facet, facet_weights, facet_tangents

contains

  !> The weights of the corners x (3, 3 or 4) of a facet [L] at its point nearest to p, and the
  !> parameters there: of a quadrilateral in [-1, 1], of a triangle the weights of its second
  !> and third corner.
  pure subroutine closest_on_facet(x, p, at, weight)
    real(wp), intent(in) :: x(:, :), p(3)
    real(wp), intent(out) :: at(2), weight(:)
    if (size(x, 2) == 3) then
      call closest_on_triangle(x, p, at)
    else
      call closest_on_quad(x, p, at)
    end if
    call facet_weights(at, weight)
  end subroutine closest_on_facet

  !> Shape functions of the corners.
  pure subroutine facet_weights(at, weight)
    real(wp), intent(in) :: at(2)
    real(wp), intent(out) :: weight(:)
    if (size(weight) == 3) then
      weight = [one - at(1) - at(2), at(1), at(2)]
    else
      weight = 0.25_wp*[(one - at(1))*(one - at(2)), (one + at(1))*(one - at(2)), &
          (one + at(1))*(one + at(2)), (one - at(1))*(one + at(2))]
    end if
  end subroutine facet_weights

  !> Derivatives of the place by the parameters [L].
  pure subroutine facet_tangents(x, at, a, b)
    real(wp), intent(in) :: x(:, :), at(2)
    real(wp), intent(out) :: a(3), b(3)
    if (size(x, 2) == 3) then
      a = x(:, 2) - x(:, 1)
      b = x(:, 3) - x(:, 1)
    else
      a = 0.25_wp*((one - at(2))*(x(:, 2) - x(:, 1)) + (one + at(2))*(x(:, 3) - x(:, 4)))
      b = 0.25_wp*((one - at(1))*(x(:, 4) - x(:, 1)) + (one + at(1))*(x(:, 3) - x(:, 2)))
    end if
  end subroutine facet_tangents

  !> By the regions of the plane in which an interior point, an edge or a corner is nearest.
  pure subroutine closest_on_triangle(x, p, at)
    real(wp), intent(in) :: x(:, :), p(3)
    real(wp), intent(out) :: at(2)
    real(wp) :: a(3), b(3), d(3), aa, ab, bb, ad, bd, determinant, s, best, value, edge(2)
    integer :: k
    a = x(:, 2) - x(:, 1)
    b = x(:, 3) - x(:, 1)
    d = p - x(:, 1)
    aa = dot_product(a, a)
    ab = dot_product(a, b)
    bb = dot_product(b, b)
    ad = dot_product(a, d)
    bd = dot_product(b, d)
    determinant = aa*bb - ab**2
    if (determinant > zero) then
      at = [bb*ad - ab*bd, aa*bd - ab*ad]/determinant
      if (at(1) >= zero .and. at(2) >= zero .and. at(1) + at(2) <= one) return
    end if
    ! The nearest point is on the rim: the best of the three edges.
    best = huge(one)
    do k = 1, 3
      select case (k)
      case (1)
        s = share(ad, aa)
        edge = [s, zero]
      case (2)
        s = share(bd, bb)
        edge = [zero, s]
      case (3)
        s = share((bd - ad) - (ab - aa), aa - 2.0_wp*ab + bb)
        edge = [one - s, s]
      end select
      value = sum((d - edge(1)*a - edge(2)*b)**2)
      if (value < best) at = edge
      best = min(best, value)
    end do
  end subroutine closest_on_triangle

  !> t/l clamped to [0, 1].
  pure real(wp) function share(t, l)
    real(wp), intent(in) :: t, l
    share = zero
    if (l > zero) share = min(one, max(zero, t/l))
  end function share

  !> Minimum of |p - x|^2/2 in the square, from the best of nine points. The second derivative
  !> of the place enters where the matrix stays positive; a parameter at its bound whose
  !> gradient pushes outward is held; the step is halved until the distance falls.
  pure subroutine closest_on_quad(x, p, at)
    real(wp), intent(in) :: x(:, :), p(3)
    real(wp), intent(out) :: at(2)
    integer, parameter :: most = 60
    real(wp), parameter :: enough = 1.0e-14_wp
    real(wp) :: next(2), step(2), g(2), f
    integer :: k, halving
    call best_of_nine(x, p, at)
    do k = 1, most
      f = squared(x, p, at)
      call newton_step(x, p, at, g, step)
      do halving = 0, 40
        next = min(one, max(-one, at + step*half**halving))
        if (squared(x, p, next) <= f + 1.0e-4_wp*dot_product(g, next - at)) exit
      end do
      step = next - at
      if (squared(x, p, next) <= f) at = next
      if (maxval(abs(step)) < enough) return
    end do
  end subroutine closest_on_quad

  pure subroutine best_of_nine(x, p, at)
    real(wp), intent(in) :: x(:, :), p(3)
    real(wp), intent(out) :: at(2)
    real(wp) :: best, value, trial(2)
    integer :: i, j
    best = huge(one)
    at = zero
    do j = -1, 1
      do i = -1, 1
        trial = 0.75_wp*[i, j]
        value = squared(x, p, trial)
        if (value < best) at = trial
        best = min(best, value)
      end do
    end do
  end subroutine best_of_nine

  !> Half of the squared distance of p from the place at two parameters [L2].
  pure real(wp) function squared(x, p, at)
    real(wp), intent(in) :: x(:, :), p(3), at(2)
    real(wp) :: weight(4)
    call facet_weights(at, weight)
    squared = half*sum((difference(x, weight) - (p - x(:, 1)))**2)
  end function squared

  !> A place, from the first corner.
  pure function difference(x, weight) result(d)
    real(wp), intent(in) :: x(:, :), weight(4)
    real(wp) :: d(3)
    d = weight(2)*(x(:, 2) - x(:, 1)) + weight(3)*(x(:, 3) - x(:, 1)) &
        + weight(4)*(x(:, 4) - x(:, 1))
  end function difference

  !> Gradient g and step of Newton's method.
  pure subroutine newton_step(x, p, at, g, step)
    real(wp), intent(in) :: x(:, :), p(3), at(2)
    real(wp), intent(out) :: g(2), step(2)
    real(wp) :: a(3), b(3), r(3), weight(4), h(2, 2), mixed, determinant
    logical :: held(2)
    call facet_weights(at, weight)
    call facet_tangents(x, at, a, b)
    r = difference(x, weight) - (p - x(:, 1))
    g = [dot_product(r, a), dot_product(r, b)]
    h(1, 1) = dot_product(a, a)
    h(2, 2) = dot_product(b, b)
    h(1, 2) = dot_product(a, b)
    mixed = 0.25_wp*dot_product(r, (x(:, 1) - x(:, 2)) + (x(:, 3) - x(:, 4)))
    if (h(1, 1)*h(2, 2) - (h(1, 2) + mixed)**2 > 1.0e-3_wp*h(1, 1)*h(2, 2)) &
        h(1, 2) = h(1, 2) + mixed
    held = (at >= one .and. g < zero) .or. (at <= -one .and. g > zero)
    step = zero
    if (.not. any(held)) then
      determinant = h(1, 1)*h(2, 2) - h(1, 2)**2
      step = -[h(2, 2)*g(1) - h(1, 2)*g(2), h(1, 1)*g(2) - h(1, 2)*g(1)]/determinant
    else
      if (.not. held(1)) step(1) = -g(1)/h(1, 1)
      if (.not. held(2)) step(2) = -g(2)/h(2, 2)
    end if
  end subroutine newton_step

end module contact_closest
