! SPDX-License-Identifier: BSD-3-Clause
!> Faces of quadratic elements, and the linear facets by which contact sees them.
module element_curved
  use base_kinds, only: wp, half
  implicit none
  private
  public :: midpoints, quadratic_faces, linear_facets, nearest_places

contains

  !> Middles (dim, edges) of edges (2, edges) between the corners of place (dim, nodes).
  pure function midpoints(place, edge) result(middle)
    real(wp), intent(in) :: place(:, :)
    integer, intent(in) :: edge(:, :)
    real(wp) :: middle(size(place, 1), size(edge, 2))
    middle = half*(place(:, edge(1, :)) + place(:, edge(2, :)))
  end function midpoints

  !> Faces of corners (m, faces) with more nodes: corners, mid nodes of the edges from each
  !> corner to the next, and with four corners the centre. place (3, nodes): parametric
  !> coordinates of all nodes, by which mid nodes are known.
  pure function quadratic_faces(place, corners) result(face)
    real(wp), intent(in) :: place(:, :)
    integer, intent(in) :: corners(:, :)
    integer, allocatable :: face(:, :)
    integer :: f, k, m
    m = size(corners, 1)
    allocate (face(merge(6, 9, m == 3), size(corners, 2)))
    do f = 1, size(corners, 2)
      associate (corner => corners(:, f))
        face(:m, f) = corner
        do k = 1, m
          face(m + k, f) = node_at(place, &
              half*(place(:, corner(k)) + place(:, corner(1 + mod(k, m)))))
        end do
        if (m == 4) face(9, f) = node_at(place, sum(place(:, corner), dim=2)/m)
      end associate
    end do
  end function quadratic_faces

  !> The node that is there.
  pure integer function node_at(place, point)
    real(wp), intent(in) :: place(:, :), point(:)
    do node_at = 1, size(place, 2)
      if (all(abs(place(:, node_at) - point) < 1.0e-6_wp)) exit
    end do
  end function node_at

  !> Four facets a face, one at each corner and for triangles one in the middle.
  pure function linear_facets(face) result(facet)
    integer, intent(in) :: face(:, :)
    integer, allocatable :: facet(:, :)
    integer :: f, k, m
    m = merge(4, 3, size(face, 1) == 9)
    allocate (facet(m, 4*size(face, 2)))
    do f = 1, size(face, 2)
      associate (node => face(:, f))
        do k = 1, m
          facet(:2, 4*f - 4 + k) = node([k, m + k])
          if (m == 4) facet(3, 4*f - 4 + k) = node(9)
          facet(m, 4*f - 4 + k) = node(m + 1 + mod(k + m - 2, m))
        end do
        if (m == 3) facet(:, 4*f) = node(4:6)
      end associate
    end do
  end function linear_facets

  !> Which node lies at each place, given where they are and where the places are, in space or
  !> parametric (dim, nodes): order(k) is the node nearest to place k. is_clear: each node is
  !> nearest to a place of its own.
  pure subroutine nearest_places(x, place, order, is_clear)
    real(wp), intent(in) :: x(:, :), place(:, :)
    integer, intent(out) :: order(:)
    logical, intent(out) :: is_clear
    integer :: k, m
    order = 0
    do k = 1, size(x, 2)
      m = minloc(sum((place - spread(x(:, k), 2, size(place, 2)))**2, dim=1), dim=1)
      if (order(m) == 0) order(m) = k
    end do
    is_clear = all(order > 0)
  end subroutine nearest_places

end module element_curved
