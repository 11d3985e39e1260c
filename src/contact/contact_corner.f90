! SPDX-License-Identifier: BSD-3-Clause
!> Directions at a convex corner: those that it has in common with a node before it, and
!> which of them is the normal of their row. The space outside is a union of half-planes, so
!> that the motion of the node decides.
module contact_corner
  use base_kinds, only: wp, zero, one
  use contact_features, only: cone_of_node_t
  use contact_surface, only: turn_between
  implicit none
  private
  public :: common_directions, is_beside, choose_normal, keep_edge_normal, direction, &
      instant_of_leaving

  real(wp), parameter, public :: never = 1.0e9_wp  !< steps

contains

  !> The angles from middle between which directions lie in the cone of a vertex (middle +-
  !> half_width) and, reversed, in that of a node. high < low: none.
  pure subroutine common_directions(middle, half_width, cone, low, high)
    real(wp), intent(in) :: middle(2), half_width
    type(cone_of_node_t), intent(in) :: cone
    real(wp), intent(out) :: low, high
    real(wp) :: angle
    low = -half_width
    high = half_width
    if (cone%is_all) return
    angle = turn_between(middle, -cone%middle)
    low = max(low, angle - cone%half_width)
    high = min(high, angle + cone%half_width)
  end subroutine common_directions

  !> A node beside the corner, clear of it by more than `enough` at both ends of its free
  !> motion f in a direction of the corner's cone that is none of the node's: it meets
  !> nothing.
  pure logical function is_beside(middle, half_width, low, high, y, f, enough)
    real(wp), intent(in) :: middle(2), half_width, low, high, y(2), f(2), enough
    real(wp) :: d(2)
    is_beside = .false.
    if (low > 1.0e-9_wp - half_width) then
      d = direction(middle, -half_width)
      is_beside = min(dot_product(d, y), dot_product(d, y + f)) > enough
    end if
    if (high < half_width - 1.0e-9_wp .and. .not. is_beside) then
      d = direction(middle, half_width)
      is_beside = min(dot_product(d, y), dot_product(d, y + f)) > enough
    end if
  end function is_beside

  !> Of the normals n1 and n2 that whose half-plane n.(y + f) >= 0 the free motion f leaves
  !> least; where it leaves both by more than `enough`, last. The middle of a tie.
  pure subroutine choose_normal(n1, n2, y, f, enough, length, n)
    real(wp), intent(in) :: n1(2), n2(2), y(2), f(2), enough, length
    real(wp), intent(out) :: n(2)
    real(wp) :: m1, m2, t1, t2
    real(wp) :: tie
    tie = 1.0e-9_wp*length
    m1 = dot_product(n1, y + f)
    m2 = dot_product(n2, y + f)
    n = merge(n1, n2, m1 > m2)
    if (abs(m1 - m2) <= tie .and. &
        (abs(dot_product(n1 - n2, y)) <= tie .or. min(m1, m2) >= -enough)) then
      n = n1 + n2
      n = n/sqrt(n(1)**2 + n(2)**2)
    else if (max(m1, m2) < -enough) then
      t1 = instant_of_leaving(dot_product(n1, y), m1)
      t2 = instant_of_leaving(dot_product(n2, y), m2)
      if (abs(t1 - t2) > zero) n = merge(n1, n2, t1 > t2)
      if (max(t1, t2) < never .and. abs(t1 - t2)*sqrt(sum(f**2)) <= tie) &
          n = (n1 + n2)/sqrt(sum((n1 + n2)**2))
    end if
  end subroutine choose_normal

  !> When a gap g that becomes m in a step is zero, in steps; never, if it does not fall.
  pure real(wp) function instant_of_leaving(g, m)
    real(wp), intent(in) :: g, m
    instant_of_leaving = never
    if (g - m > abs(g)/never) instant_of_leaving = g/(g - m)
  end function instant_of_leaving

  !> n is the normal of the edge where it differs from it by round-off alone.
  pure subroutine keep_edge_normal(normal, n)
    real(wp), intent(in) :: normal(2)
    real(wp), intent(inout) :: n(2)
    if (abs(n(1) - normal(1)) + abs(n(2) - normal(2)) < 1.0e-12_wp) n = normal
  end subroutine keep_edge_normal

  !> The unit vector at an angle from another.
  pure function direction(middle, angle) result(n)
    real(wp), intent(in) :: middle(2), angle
    real(wp) :: n(2)
    n = cos(angle)*middle + sin(angle)*[-middle(2), middle(1)]
  end function direction

end module contact_corner
