! SPDX-License-Identifier: BSD-3-Clause
!> Frames of edges, cones of nodes: what the rows of contact are made of. Normals are those of
!> the positions X + U, or those of the reference geometry.
module contact_features
  use base_kinds, only: wp, zero, one, half
  use contact_surface, only: surface_t, turn_between
  implicit none
  private

  real(wp), parameter, public :: degree = acos(-1.0_wp)/180.0_wp
  !> A boundary that turns by less than this is smooth; rows of one node whose normals are
  !> nearer to each other than this are one row.
  real(wp), parameter, public :: smooth_angle = 15.0_wp*degree
  !> An edge faces a node when its normal is within this of the node's cone, reversed.
  real(wp), parameter, public :: facing_angle = 30.0_wp*degree
  !> A node this share of an edge beyond its end still belongs to it.
  real(wp), parameter, public :: end_tolerance = 1.0e-8_wp
  !> A normal nearer than this to that of the reference is taken to be it: it would open a gap
  !> of less than 1e-10 of the slip, which is below what a step accepts (PENTOL), and
  !> round-off of displacements would otherwise make W anew in every step.
  real(wp), parameter :: same_normal = 1.0e-10_wp

  !> Directions in which the body ends at a node: between two angles about a middle.
  type, public :: cone_of_node_t
    real(wp) :: middle(2) = zero   !< unit vector
    real(wp) :: half_width = zero  !< [radians]
    logical :: is_all = .false.    !< a node without a boundary of its own: every direction
    real(wp) :: normal(2, 2) = zero !< of the boundary before and after the node
    real(wp) :: turn = zero        !< between them
  end type cone_of_node_t

  !> An edge where it is now.
  type, public :: frame_t
    real(wp) :: normal(2) = zero
    real(wp) :: span = zero        !< its extent along the tangent [L]
  end type frame_t

  public :: edge_frame, normal_between, local_coordinate, gap_to_edge, gap_to_place, &
      cone_of_node, faces, difference

contains

  !> (x_i - x_j) + (u_i - u_j): positions and displacements apart, so that a small difference
  !> keeps its digits.
  pure function difference(x, u, i, j) result(d)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: i, j
    real(wp) :: d(2)
    d(1) = (x(1, i) - x(1, j)) + (u(1, i) - u(1, j))
    d(2) = (x(2, i) - x(2, j)) + (u(2, i) - u(2, j))
  end function difference

  !> Normal and extent of an edge at X + U; with is_reference the normal stays that of X.
  pure subroutine edge_frame(surface, edge, x, u, is_reference, frame)
    type(surface_t), intent(in) :: surface
    integer, intent(in) :: edge
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    logical, intent(in) :: is_reference
    type(frame_t), intent(out) :: frame
    real(wp) :: d(2), n(2), length
    associate (a => surface%end_node(1, edge), b => surface%end_node(2, edge))
      n = surface%normal(:, edge)
      if (.not. is_reference) then
        d(1) = (x(1, b) - x(1, a)) + (u(1, b) - u(1, a))
        d(2) = (x(2, b) - x(2, a)) + (u(2, b) - u(2, a))
        length = sqrt(d(1)**2 + d(2)**2)
        if (length > zero) then
          d = [d(2), -d(1)]/length
          if (abs(d(1) - n(1)) > same_normal .or. abs(d(2) - n(2)) > same_normal) then
            frame%normal = d
            frame%span = length
            return
          end if
        end if
      end if
      frame%normal = n
      frame%span = surface%length(edge) &
          + (-n(2)*(u(1, b) - u(1, a)) + n(1)*(u(2, b) - u(2, a)))
    end associate
  end subroutine edge_frame

  !> Outward normal of the boundary from node a to node b, where it is now.
  pure function normal_between(x, u, a, b, is_reference) result(n)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: a, b
    logical, intent(in) :: is_reference
    real(wp) :: n(2), d(2), r(2)
    d = x(:, b) - x(:, a)
    r = d/sqrt(d(1)**2 + d(2)**2)
    if (.not. is_reference) then
      d = difference(x, u, b, a)
      d = d/max(sqrt(d(1)**2 + d(2)**2), tiny(one))
      if (abs(d(1) - r(1)) > same_normal .or. abs(d(2) - r(2)) > same_normal) r = d
    end if
    n = [r(2), -r(1)]
  end function normal_between

  !> Place of a node along an edge: 0 at its first node, 1 at its second, not clamped.
  pure real(wp) function local_coordinate(surface, edge, frame, x, u, node)
    type(surface_t), intent(in) :: surface
    integer, intent(in) :: edge, node
    type(frame_t), intent(in) :: frame
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    associate (a => surface%end_node(1, edge), n => frame%normal)
      local_coordinate = ((-n(2)*(x(1, node) - x(1, a)) + n(1)*(x(2, node) - x(2, a))) &
          + (-n(2)*(u(1, node) - u(1, a)) + n(1)*(u(2, node) - u(2, a))))/frame%span
    end associate
  end function local_coordinate

  !> Distance of a node in front of the line of an edge, at its place s there [L].
  pure real(wp) function gap_to_edge(surface, edge, normal, s, x, u, node)
    type(surface_t), intent(in) :: surface
    integer, intent(in) :: edge, node
    real(wp), intent(in) :: normal(2), s
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    associate (a => surface%end_node(1, edge), b => surface%end_node(2, edge))
      gap_to_edge = (normal(1)*((x(1, node) - x(1, a)) - s*(x(1, b) - x(1, a))) &
          + normal(2)*((x(2, node) - x(2, a)) - s*(x(2, b) - x(2, a)))) &
          + (normal(1)*((u(1, node) - u(1, a)) - s*(u(1, b) - u(1, a))) &
          + normal(2)*((u(2, node) - u(2, a)) - s*(u(2, b) - u(2, a))))
    end associate
  end function gap_to_edge

  !> The same for a row of points and weights (1 of the contactor first, sum 0).
  pure real(wp) function gap_to_place(point, weight, normal, x, u)
    integer, intent(in) :: point(:)
    real(wp), intent(in) :: weight(:), normal(2)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp) :: d(2), e(2)
    integer :: k
    d = x(:, point(1)) - x(:, point(2))
    e = u(:, point(1)) - u(:, point(2))
    do k = 3, size(point)
      d = d + weight(k)*(x(:, point(k)) - x(:, point(2)))
      e = e + weight(k)*(u(:, point(k)) - u(:, point(2)))
    end do
    gap_to_place = dot_product(normal, d) + dot_product(normal, e)
  end function gap_to_place

  !> Cone of row k of the nodes of a surface: the directions between the normals of the
  !> boundary before and after it; where the boundary is smooth or reflex the mean normal
  !> alone.
  pure subroutine cone_of_node(surface, k, x, u, is_reference, cone)
    type(surface_t), intent(in) :: surface
    integer, intent(in) :: k
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    logical, intent(in) :: is_reference
    type(cone_of_node_t), intent(out) :: cone
    real(wp) :: a(2), b(2), turn
    associate (before => surface%chain(1, k), node => surface%node(k), &
        after => surface%chain(2, k))
      cone%is_all = before == 0 .or. after == 0
      if (cone%is_all) return
      a = normal_between(x, u, before, node, is_reference)
      b = normal_between(x, u, node, after, is_reference)
    end associate
    cone%normal(:, 1) = a
    cone%normal(:, 2) = b
    turn = zero
    if (abs(a(1) - b(1)) + abs(a(2) - b(2)) > zero) turn = turn_between(a, b)
    cone%middle = a + b
    cone%turn = turn
    if (abs(turn) > 2.5_wp) cone%middle = sign(one, turn)*[-a(2) + b(2), a(1) - b(1)]
    cone%middle = cone%middle/sqrt(cone%middle(1)**2 + cone%middle(2)**2)
    if (turn > smooth_angle) cone%half_width = half*turn
  end subroutine cone_of_node

  !> Does a boundary with this normal face the cone, within an angle beyond it?
  pure logical function faces(normal, cone, beyond)
    real(wp), intent(in) :: normal(2), beyond
    type(cone_of_node_t), intent(in) :: cone
    real(wp) :: c
    faces = cone%is_all
    if (faces) return
    c = -(normal(1)*cone%middle(1) + normal(2)*cone%middle(2))
    faces = c >= cos(cone%half_width + beyond)
  end function faces

end module contact_features
