! SPDX-License-Identifier: BSD-3-Clause
!> Where segments go through the facets of a boundary in space.
module contact_pierce
  use base_kinds, only: wp, zero, one
  use contact_skin, only: skin_t
  use linalg_dense, only: cross
  implicit none
  private
  public :: pierce, pierces_edge

contains

  !> Where the segment a + t d, 0 < t < 1, goes through a facet: low and high are the first and
  !> the last such t. A quadrilateral is four triangles about its middle.
  pure subroutine pierce(skin, facet, x, u, a, d, low, high)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: facet
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(in) :: a(3), d(3)
    real(wp), intent(inout) :: low, high
    real(wp) :: c(3, 4), middle(3)
    integer :: k, m
    m = skin%corners(facet)
    do k = 1, m
      c(:, k) = (x(:, skin%node(k, facet)) + u(:, skin%node(k, facet))) - a
    end do
    if (m == 3) then
      call pierce_triangle(c(:, 1), c(:, 2), c(:, 3), d, low, high)
      return
    end if
    middle = sum(c, dim=2)/m
    do k = 1, m
      call pierce_triangle(c(:, k), c(:, 1 + mod(k, m)), middle, d, low, high)
    end do
  end subroutine pierce

  !> The same of a triangle with corners seen from a.
  pure subroutine pierce_triangle(p, q, r, d, low, high)
    real(wp), intent(in) :: p(3), q(3), r(3), d(3)
    real(wp), intent(inout) :: low, high
    real(wp) :: n(3), volume(3), t
    n = cross(q - p, r - p)
    t = dot_product(n, d)
    if (.not. abs(t) > epsilon(one)*norm2(n)*norm2(d)) return
    t = dot_product(n, p)/t
    if (t <= zero .or. t >= one) return
    volume = [dot_product(cross(p, q), d), dot_product(cross(q, r), d), &
        dot_product(cross(r, p), d)]
    if (any(volume > zero) .and. any(volume < zero)) return
    low = min(low, t)
    high = max(high, t)
  end subroutine pierce_triangle

  !> Does an edge of the own net go through one of the facets beside an edge of another net?
  pure logical function pierces_edge(own, a, skin, b, x, u)
    type(skin_t), intent(in) :: own, skin
    integer, intent(in) :: a, b
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp) :: p(3), d(3), low, high
    integer :: k
    associate (i => own%ends(1, a), j => own%ends(2, a))
      p = x(:, i) + u(:, i)
      d = (x(:, j) - x(:, i)) + (u(:, j) - u(:, i))
    end associate
    low = one
    high = zero
    do k = 1, 2
      if (skin%beside(k, b) > 0) call pierce(skin, skin%beside(k, b), x, u, p, d, low, high)
    end do
    pierces_edge = high >= low
  end function pierces_edge

end module contact_pierce
