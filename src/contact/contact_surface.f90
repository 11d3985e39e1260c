! SPDX-License-Identifier: BSD-3-Clause
!> The boundary of bodies as edges: the edges that belong to one element only, with the body on
!> their left, so that the outward normal is on their right.
module contact_surface
  use base_kinds, only: wp, zero
  use base_sort, only: sort_order
  use model_data, only: model_t, corner_count, side_part_set, side_node_set, side_part, &
      side_segment_set, side_all_nodes
  implicit none
  private

  type, public :: surface_t
    integer, allocatable :: node(:)        !< nodes of the surface
    integer, allocatable :: end_node(:, :) !< (2, edges) first and second node of each edge
    real(wp), allocatable :: length(:)     !< [L] reference length
    real(wp), allocatable :: normal(:, :)  !< (2, edges) outward, reference geometry
    !> (2, edges) edge before and after, 0 = end of the surface
    integer, allocatable :: neighbour(:, :)
    !> (2, nodes) edges that end and start at a node, 0 = none
    integer, allocatable :: node_edge(:, :)
    real(wp) :: mean_length = zero
  end type surface_t

  public :: make_surface, edge_tangent, facing

  !> An edge faces another when their normals are opposite by at least this cosine (3 degrees
  !> off a right angle): only facing boundaries can meet from outside.
  real(wp), parameter :: facing_cosine = -0.05_wp

contains

  !> Surface of a side of a contact card: the exposed edges of parts, those whose nodes are all
  !> in a node set, or the edges of a segment set. Lone nodes of a node set belong to it too.
  subroutine make_surface(model, kind, row, surface)
    type(model_t), intent(in) :: model
    integer, intent(in) :: kind, row
    type(surface_t), intent(out) :: surface
    logical, allocatable :: part_in(:), node_in(:)
    integer, allocatable :: edge(:, :)
    integer :: k
    allocate (part_in(size(model%part)), node_in(model%nodes))
    part_in = kind == side_node_set .or. kind == side_segment_set .or. kind == side_all_nodes
    if (kind == side_part_set) part_in(model%part_set(row)%member) = .true.
    if (kind == side_part) part_in(row) = .true.
    call exposed_edges(model, part_in, edge)
    select case (kind)
    case (side_node_set)
      node_in = .false.
      node_in(model%node_set(row)%member) = .true.
      edge = pack_columns(edge, [(all(node_in(edge(:, k))), k=1, size(edge, 2))])
    case (side_segment_set)
      edge = pack_columns(edge, in_segments(model%nodes, edge, model%segment_set(row)%node))
    end select
    node_in = .false.
    do k = 1, size(edge, 2)
      node_in(edge(:, k)) = .true.
    end do
    if (kind == side_node_set) node_in(model%node_set(row)%member) = .true.
    if (kind == side_all_nodes) node_in = .true.
    surface%node = pack([(k, k=1, model%nodes)], node_in)
    surface%end_node = edge
    call measure_edges(model, surface)
  end subroutine make_surface

  !> Which edges are among the segments, in either direction.
  pure function in_segments(nodes, edge, segment) result(found)
    integer, intent(in) :: nodes
    integer, intent(in) :: edge(:, :), segment(:, :)
    logical :: found(size(edge, 2))
    integer :: first(nodes), next(size(segment, 2)), s, k
    first = 0
    do s = 1, size(segment, 2)
      next(s) = first(minval(segment(:, s)))
      first(minval(segment(:, s))) = s
    end do
    found = .false.
    do k = 1, size(edge, 2)
      s = first(minval(edge(:, k)))
      do while (s > 0)
        if (maxval(segment(:, s)) == maxval(edge(:, k))) found(k) = .true.
        s = next(s)
      end do
    end do
  end function in_segments

  pure function pack_columns(list, keep) result(kept)
    integer, intent(in) :: list(:, :)
    logical, intent(in) :: keep(:)
    integer :: kept(2, count(keep))
    kept(1, :) = pack(list(1, :), keep)
    kept(2, :) = pack(list(2, :), keep)
  end function pack_columns

  !> Edges of the chosen parts that belong to exactly one of their elements.
  subroutine exposed_edges(model, part_in, edge)
    type(model_t), intent(in) :: model
    logical, intent(in) :: part_in(:)
    integer, allocatable, intent(out) :: edge(:, :)
    integer, allocatable :: all_edges(:, :), order(:)
    logical, allocatable :: single(:)
    integer :: e, k, n, i, j, first, corners
    allocate (all_edges(2, 4*model%elements))
    n = 0
    do e = 1, model%elements
      if (.not. part_in(model%element_part(e))) cycle
      corners = corner_count(model%connectivity(:, e))
      do k = 1, corners
        n = n + 1
        all_edges(:, n) = [model%connectivity(k, e), model%connectivity(1 + mod(k, corners), e)]
      end do
    end do
    allocate (order(n), single(n))
    call sort_order(minval(all_edges(:, 1:n), dim=1), order)
    single = .true.
    first = 1
    do i = 2, n
      if (minval(all_edges(:, order(i))) /= minval(all_edges(:, order(first)))) first = i
      do j = first, i - 1
        if (maxval(all_edges(:, order(j))) /= maxval(all_edges(:, order(i)))) cycle
        single(order(i)) = .false.
        single(order(j)) = .false.
      end do
    end do
    edge = pack_columns(all_edges(:, 1:n), single)
  end subroutine exposed_edges

  subroutine measure_edges(model, surface)
    type(model_t), intent(in) :: model
    type(surface_t), intent(inout) :: surface
    integer, allocatable :: starts(:), ends(:)
    real(wp) :: d(2)
    integer :: k, n
    n = size(surface%end_node, 2)
    allocate (surface%length(n), surface%normal(2, n), surface%neighbour(2, n))
    allocate (surface%node_edge(2, size(surface%node)), starts(model%nodes), ends(model%nodes))
    starts = 0
    ends = 0
    do k = 1, n
      d = model%x(:, surface%end_node(2, k)) - model%x(:, surface%end_node(1, k))
      surface%length(k) = sqrt(sum(d**2))
      surface%normal(:, k) = [d(2), -d(1)]/surface%length(k)
      starts(surface%end_node(1, k)) = k
      ends(surface%end_node(2, k)) = k
    end do
    surface%neighbour(1, :) = ends(surface%end_node(1, :))
    surface%neighbour(2, :) = starts(surface%end_node(2, :))
    surface%node_edge(1, :) = ends(surface%node)
    surface%node_edge(2, :) = starts(surface%node)
    if (n > 0) surface%mean_length = sum(surface%length)/real(n, wp)
  end subroutine measure_edges

  !> t = n turned by +90 degrees: along the edge.
  pure function edge_tangent(normal) result(t)
    real(wp), intent(in) :: normal(2)
    real(wp) :: t(2)
    t = [-normal(2), normal(1)]
  end function edge_tangent

  !> True when node k of a surface has an edge that faces the normal of another body (a node
  !> without edges, of a bare node set, faces everything).
  pure logical function facing(surface, k, normal)
    type(surface_t), intent(in) :: surface
    integer, intent(in) :: k
    real(wp), intent(in) :: normal(2)
    integer :: s
    facing = all(surface%node_edge(:, k) == 0)
    do s = 1, 2
      associate (edge => surface%node_edge(s, k))
        if (edge == 0) cycle
        if (dot_product(surface%normal(:, edge), normal) < facing_cosine) facing = .true.
      end associate
    end do
  end function facing

end module contact_surface
