! SPDX-License-Identifier: BSD-3-Clause
!> Where a contactor node stands on the obstacle: edge, place, normal, gap. Frames are those of
!> the reference geometry (small displacements), the place on the edge is that of the moment.
module contact_track
  use base_kinds, only: wp, zero, one
  use contact_rows, only: rows_t, add_row
  use contact_surface, only: surface_t, edge_tangent
  use contact_types, only: candidate_t, pair_t
  implicit none
  private
  public :: place_on_edge, gap_to_edge, update_candidate, add_candidate_row

  !> A node this share of an edge beyond its end still belongs to it.
  real(wp), parameter, public :: end_tolerance = 1.0e-8_wp
  integer, parameter :: most_hops = 64

contains

  !> Distance of a node in front of the line of an edge [L].
  pure real(wp) function gap_to_edge(surface, edge, x, u, node)
    type(surface_t), intent(in) :: surface
    integer, intent(in) :: edge, node
    real(wp), intent(in) :: x(:, :), u(:, :)
    real(wp) :: n(2)
    n = surface%normal(:, edge)
    associate (a => surface%end_node(1, edge))
      gap_to_edge = dot_product(n, x(:, node) - x(:, a)) + dot_product(n, u(:, node) - u(:, a))
    end associate
  end function gap_to_edge

  !> Place of a node along an edge: 0 at its first node, 1 at its second, not clamped.
  pure real(wp) function place_on_edge(surface, edge, x, u, node)
    type(surface_t), intent(in) :: surface
    integer, intent(in) :: edge, node
    real(wp), intent(in) :: x(:, :), u(:, :)
    real(wp) :: t(2), span
    t = edge_tangent(surface%normal(:, edge))
    associate (a => surface%end_node(1, edge), b => surface%end_node(2, edge))
      span = surface%length(edge) + dot_product(t, u(:, b) - u(:, a))
      place_on_edge = &
          (dot_product(t, x(:, node) - x(:, a)) + dot_product(t, u(:, node) - u(:, a)))/span
    end associate
  end function place_on_edge

  !> Moves a candidate to the edge that its node faces now.
  pure subroutine update_candidate(pair, x, u, c)
    type(pair_t), intent(in) :: pair
    real(wp), intent(in) :: x(:, :), u(:, :)
    type(candidate_t), intent(inout) :: c
    real(wp) :: xi, other, normal(2)
    integer :: edge, next, hop, side, came_from
    edge = c%edge
    came_from = 0
    c%valid = .true.
    do hop = 1, most_hops
      xi = place_on_edge(pair%obstacle, edge, x, u, c%node)
      normal = pair%obstacle%normal(:, edge)
      if (xi >= -end_tolerance .and. xi <= one + end_tolerance) exit
      side = merge(1, 2, xi < zero)
      next = pair%obstacle%neighbour(side, edge)
      if (next == 0) then
        c%valid = .false.
        exit
      end if
      other = place_on_edge(pair%obstacle, next, x, u, c%node)
      if (next == came_from .or. (side == 1 .and. other > one) &
          .or. (side == 2 .and. other < zero)) then
        normal = normal + pair%obstacle%normal(:, next)
        normal = normal/sqrt(sum(normal**2))
        exit
      end if
      came_from = edge
      edge = next
    end do
    xi = min(one, max(zero, xi))
    if (xi <= end_tolerance) xi = zero
    if (xi >= one - end_tolerance) xi = one
    c%edge = edge
    c%xi = xi
    c%normal = normal
  end subroutine update_candidate

  !> Adds the row of a candidate. Its gap is n . (position of the node - position of its place)
  !> [L], reference part and motion apart, so that a small gap keeps its digits far from the
  !> origin.
  pure subroutine add_candidate_row(pair, x, u, c, rows)
    type(pair_t), intent(in) :: pair
    real(wp), intent(in) :: x(:, :), u(:, :)
    type(candidate_t), intent(in) :: c
    type(rows_t), intent(inout) :: rows
    real(wp) :: gap
    associate (a => pair%obstacle%end_node(1, c%edge), b => pair%obstacle%end_node(2, c%edge))
      gap = dot_product(c%normal, (x(:, c%node) - x(:, a)) - c%xi*(x(:, b) - x(:, a))) &
          + dot_product(c%normal, (u(:, c%node) - u(:, a)) - c%xi*(u(:, b) - u(:, a)))
      call add_row(rows, [c%pair, c%node, c%edge], [c%node, a, b], [one, c%xi - one, -c%xi], &
          c%normal, gap, pair%mu, pair%obstacle%length(c%edge))
    end associate
  end subroutine add_candidate_row

end module contact_track
