! SPDX-License-Identifier: BSD-3-Clause
!> The boundary of bodies as edges: the edges that belong to one element only, with the body
!> on their left, so that the outward normal is on their right. A side of a contact is a
!> part of that boundary; the turn of the boundary at a node is that of the whole.
module contact_surface
  use base_kinds, only: wp, zero, one, half
  use contact_facets, only: facets_t, make_facets, corners_of
  use model_bodies, only: find_bodies
  use model_data, only: model_t, side_part_set, side_node_set, side_part, &
      side_segment_set, side_all_nodes, side_parts
  use model_faces, only: exterior_facets
  implicit none
  private

  type, public :: surface_t
    integer, allocatable :: node(:)        !< nodes of the surface, increasing
    integer, allocatable :: index(:)       !< (nodes of the model) row in node, 0 = not in it
    integer, allocatable :: end_node(:, :) !< (2, edges) first and second node of each edge
    !> (edges) it belongs to the surface; beyond the ends of a set stand the next edges of the
    !> boundary, which make corners there but no rows
    logical, allocatable :: is_listed(:)
    real(wp), allocatable :: length(:)     !< [L] reference length
    real(wp), allocatable :: normal(:, :)  !< (2, edges) outward, reference geometry
    !> (2, edges) edge before and after, 0 = end of the surface
    integer, allocatable :: neighbour(:, :)
    !> (2, nodes) edges that end and start at a node, 0 = none
    integer, allocatable :: node_edge(:, :)
    !> (2, nodes) nodes before and after along the whole boundary; 0: not a node of a boundary
    integer, allocatable :: chain(:, :)
    real(wp), allocatable :: chain_length(:, :)  !< (2, nodes) of the edges between [L]
    real(wp), allocatable :: turn(:)       !< (nodes) from the normal before to that after
    integer, allocatable :: part(:)        !< (edges) rows of their parts
    integer, allocatable :: part_id(:)     !< (edges)
    integer, allocatable :: body(:)        !< (edges) bodies are numbered by their first node
    type(facets_t) :: facets               !< only in space, in place of edges
    logical :: is_closed = .false.         !< every edge has both neighbours
    real(wp) :: mean_length = zero
    real(wp) :: shortest = huge(one)       !< edge [L]
  end type surface_t

  public :: make_surface, turn_between, shortest_edge_at

contains

  !> Surface of a side of a contact card: the exposed edges of parts, those whose nodes are
  !> all in a node set, or the edges of a segment set; of parts that are listed, with kind
  !> side_parts. Lone nodes of a node set belong to it too.
  subroutine make_surface(model, kind, row, surface, parts)
    type(model_t), intent(in) :: model
    integer, intent(in) :: kind, row
    type(surface_t), intent(out) :: surface
    integer, intent(in), optional :: parts(:)
    logical, allocatable :: part_in(:), node_in(:)
    integer, allocatable :: boundary(:, :), owner(:), facet(:), part(:), edge(:, :), body(:)
    logical, allocatable :: is_listed(:), taken(:)
    integer :: k
    if (model%dim == 3) then
      call make_space_surface(model, kind, row, surface, parts)
      return
    end if
    allocate (part_in(size(model%part)), node_in(model%nodes))
    part_in = all(kind /= [side_part_set, side_part, side_parts])
    if (present(parts)) part_in(parts) = .true.
    if (kind == side_part_set) part_in(model%part_set(row)%member) = .true.
    if (kind == side_part) part_in(row) = .true.
    call exterior_facets(model%mesh, model%nodes, 2, boundary, owner, facet)
    part = model%mesh%part(owner)
    is_listed = part_in(part)
    select case (kind)
    case (side_node_set)
      node_in = .false.
      node_in(model%node_set(row)%member) = .true.
      is_listed = [(all(node_in(boundary(:, k))), k=1, size(boundary, 2))]
    case (side_segment_set)
      is_listed = in_segments(model%nodes, boundary, model%segment_set(row)%node)
    end select
    if (model%is_axisymmetric) is_listed = is_listed .and. [(any(model%x(1, boundary(:, k)) > &
        zero), k=1, size(boundary, 2))]      ! an edge on the axis is no surface
    node_in = .false.
    do k = 1, size(boundary, 2)
      if (is_listed(k)) node_in(boundary(:, k)) = .true.
    end do
    taken = is_listed
    do k = 1, size(boundary, 2)
      if (any(node_in(boundary(:, k)))) taken(k) = .true.
    end do
    surface%is_listed = pack(is_listed, taken)
    edge = pack_columns(boundary, taken)
    surface%part = pack(part, taken)
    surface%part_id = model%part(surface%part)%id
    if (kind == side_node_set) node_in(model%node_set(row)%member) = .true.
    if (kind == side_all_nodes) node_in(:model%mesh_nodes) = .true.
    surface%node = pack([(k, k=1, model%nodes)], node_in)
    surface%end_node = edge
    allocate (surface%index(model%nodes))
    surface%index = 0
    surface%index(surface%node) = [(k, k=1, size(surface%node))]
    call measure_edges(model, surface)
    call follow_boundary(model, boundary, surface)
    call find_bodies(model%mesh, model%nodes, body)
    surface%body = body(surface%end_node(1, :))
  end subroutine make_surface

  !> The same in space: the facets of parts or segments with their nodes, or nodes with the
  !> facets all of whose corners are among them.
  subroutine make_space_surface(model, kind, row, surface, parts)
    type(model_t), intent(in) :: model
    integer, intent(in) :: kind, row
    type(surface_t), intent(inout) :: surface
    integer, intent(in), optional :: parts(:)
    logical :: node_in(model%nodes)
    integer :: k
    call make_facets(model, surface%facets)
    node_in = .false.
    if (kind == side_all_nodes) node_in(:model%mesh_nodes) = .true.
    if (kind == side_node_set) node_in(model%node_set(row)%member) = .true.
    associate (f => surface%facets)
      select case (kind)
      case (side_all_nodes, side_node_set)
        do k = 1, f%n
          f%is_listed(k) = all(node_in(f%node(:corners_of(f, k), k)))
        end do
      case (side_segment_set)
        call list_segments(model, model%segment_set(row)%node, f)
      case default
        call list_parts(model, kind, row, f, parts)
      end select
      do k = 1, f%n
        if (f%is_listed(k)) node_in(f%node(:corners_of(f, k), k)) = .true.
      end do
      surface%mean_length = sum(f%size, mask=f%is_listed)/max(1, count(f%is_listed))
      surface%shortest = minval(f%size, mask=f%is_listed)
    end associate
    surface%node = pack([(k, k=1, model%nodes)], node_in)
    allocate (surface%index(model%nodes))
    surface%index = 0
    surface%index(surface%node) = [(k, k=1, size(surface%node))]
    allocate (surface%is_listed(0), surface%end_node(2, 0), surface%length(0), &
        surface%normal(2, 0), surface%part(0), surface%part_id(0), surface%body(0))
    allocate (surface%chain(2, size(surface%node)), surface%turn(size(surface%node)))
    allocate (surface%chain_length(2, size(surface%node)))
    surface%chain = 0
    surface%turn = zero
    surface%chain_length = zero
  end subroutine make_space_surface

  !> The facets of parts.
  subroutine list_parts(model, kind, row, facets, parts)
    type(model_t), intent(in) :: model
    integer, intent(in) :: kind, row
    type(facets_t), intent(inout) :: facets
    integer, intent(in), optional :: parts(:)
    logical :: part_in(size(model%part))
    part_in = .false.
    if (present(parts)) part_in(parts) = .true.
    if (kind == side_part_set) part_in(model%part_set(row)%member) = .true.
    if (kind == side_part) part_in(row) = .true.
    facets%is_listed = part_in(facets%part)
  end subroutine list_parts

  !> The facets that are segments (4, *), whose last node is 0 or the third of a triangle.
  subroutine list_segments(model, segment, facets)
    type(model_t), intent(in) :: model
    integer, intent(in) :: segment(:, :)
    type(facets_t), intent(inout) :: facets
    integer :: first(model%nodes), next(facets%n), s, k, m
    first = 0
    do k = 1, facets%n
      m = minval(facets%node(:corners_of(facets, k), k))
      next(k) = first(m)
      first(m) = k
    end do
    do s = 1, size(segment, 2)
      k = first(minval(segment(:, s), mask=segment(:, s) > 0))
      do while (k > 0)
        if (all([(any(segment(:, s) == facets%node(m, k)), m=1, corners_of(facets, k))])) &
            facets%is_listed(k) = .true.
        k = next(k)
      end do
    end do
  end subroutine list_segments

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
    surface%is_closed = n > 0 .and. all(surface%is_listed) .and. all(surface%neighbour > 0)
    surface%node_edge(1, :) = ends(surface%node)
    surface%node_edge(2, :) = starts(surface%node)
    if (.not. any(surface%is_listed)) return
    surface%mean_length = sum(surface%length, mask=surface%is_listed) &
        /real(count(surface%is_listed), wp)
    surface%shortest = minval(surface%length, mask=surface%is_listed)
  end subroutine measure_edges

  !> Neighbours of the nodes along the whole boundary, and the turn there.
  subroutine follow_boundary(model, boundary, surface)
    type(model_t), intent(in) :: model
    integer, intent(in) :: boundary(:, :)
    type(surface_t), intent(inout) :: surface
    integer, allocatable :: before(:), after(:)
    real(wp) :: n(2, 2)
    integer :: k
    allocate (before(model%nodes), after(model%nodes))
    before = 0
    after = 0
    do k = 1, size(boundary, 2)
      after(boundary(1, k)) = boundary(2, k)
      before(boundary(2, k)) = boundary(1, k)
    end do
    allocate (surface%chain(2, size(surface%node)), surface%turn(size(surface%node)))
    surface%chain(1, :) = before(surface%node)
    surface%chain(2, :) = after(surface%node)
    allocate (surface%chain_length(2, size(surface%node)))
    surface%turn = zero
    surface%chain_length = zero
    do k = 1, size(surface%node)
      if (any(surface%chain(:, k) == 0)) cycle
      n(:, 1) = model%x(:, surface%node(k)) - model%x(:, surface%chain(1, k))
      n(:, 2) = model%x(:, surface%chain(2, k)) - model%x(:, surface%node(k))
      surface%turn(k) = turn_between(n(:, 1), n(:, 2))
      surface%chain_length(:, k) = sqrt(sum(n**2, dim=1))
    end do
  end subroutine follow_boundary

  !> Angle from direction a to direction b, in (-pi, pi].
  pure real(wp) function turn_between(a, b)
    real(wp), intent(in) :: a(2), b(2)
    turn_between = atan2(a(1)*b(2) - a(2)*b(1), a(1)*b(1) + a(2)*b(2))
  end function turn_between

  !> The shortest edge of the boundary at row k of the nodes [L]; the length given where there
  !> is no boundary.
  pure real(wp) function shortest_edge_at(surface, k, length)
    type(surface_t), intent(in) :: surface
    integer, intent(in) :: k
    real(wp), intent(in) :: length
    shortest_edge_at = length
    if (all(surface%chain(:, k) > 0)) shortest_edge_at = minval(surface%chain_length(:, k))
  end function shortest_edge_at

end module contact_surface
