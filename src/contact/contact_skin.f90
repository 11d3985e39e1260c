! SPDX-License-Identifier: BSD-3-Clause
!> The boundary of bodies in space as a net: facets, the edges between them, what stands round
!> each node. Lists are of the part of the boundary that a side of a contact needs: its own
!> facets and those next to them, which make corners at its rim but no rows.
module contact_skin
  use base_kinds, only: wp, zero, one
  use contact_facets, only: facets_t, corners_of
  use contact_features, only: degree
  use linalg_dense, only: cross
  use model_bodies, only: find_bodies
  use model_data, only: model_t
  implicit none
  private

  type, public :: skin_t
    integer :: facets = 0, edges = 0, vertices = 0
    integer, allocatable :: node(:, :)     !< (4, facets); of a triangle the last is 0
    integer, allocatable :: corners(:)     !< (facets) 3 or 4
    integer, allocatable :: edge_of(:, :)  !< (4, facets) from each corner to the next
    logical, allocatable :: is_listed(:)   !< (facets) it belongs to the side
    integer, allocatable :: part(:), part_id(:)   !< (facets) row and id of the part
    integer, allocatable :: body(:)        !< (facets) bodies are numbered by their first node
    real(wp), allocatable :: size(:)       !< (facets) square root of the area [L]
    real(wp), allocatable :: share(:, :)   !< (4, facets) of the area, of each corner [L2]
    real(wp), allocatable :: normal(:, :)  !< (3, facets) in the middle, reference geometry
    integer, allocatable :: ends(:, :)     !< (2, edges)
    integer, allocatable :: beside(:, :)   !< (2, edges) facets on either side; 0 = none
    !> (edges) angle from one normal to the other, > 0 convex, reference geometry
    real(wp), allocatable :: turn(:)
    integer, allocatable :: vertex(:)      !< (vertices) nodes of the model
    integer, allocatable :: at(:)          !< (nodes of the model) their vertices; 0 = none
    integer, allocatable :: first_facet(:), facet(:)   !< facets round each vertex
    integer, allocatable :: first_edge(:), edge(:)     !< edges at each vertex
    !> (vertices) exact whatever the sizes: the body ends there in a point
    logical, allocatable :: is_corner(:)
    real(wp), allocatable :: solid_angle(:)   !< (vertices) of the body, reference geometry
    real(wp), allocatable :: shortest(:)      !< (vertices) edge there [L]
    logical :: is_closed = .false.         !< all facets are listed, no edge has one alone
  end type skin_t

  !> A convex edge or vertex that is sharper than this is watched.
  real(wp), parameter, public :: sharp_edge = 30.0_wp*degree, sharp_vertex = 20.0_wp*degree

  public :: make_skin, dihedral

contains

  !> The net of the facets of a side, those that are listed, with their neighbours.
  subroutine make_skin(model, facets, skin)
    type(model_t), intent(in) :: model
    type(facets_t), intent(in) :: facets
    type(skin_t), intent(out) :: skin
    integer, allocatable :: body(:)
    logical :: node_in(0:model%nodes), taken(facets%n)
    integer :: k
    node_in = .false.
    do k = 1, facets%n
      if (facets%is_listed(k)) node_in(facets%node(:corners_of(facets, k), k)) = .true.
    end do
    do k = 1, facets%n
      taken(k) = any(node_in(facets%node(:corners_of(facets, k), k)))
    end do
    skin%facets = count(taken)
    allocate (skin%node(4, skin%facets), skin%normal(3, skin%facets), &
        skin%share(4, skin%facets))
    do k = 1, 4
      skin%node(k, :) = pack(facets%node(k, :), taken)
      skin%share(k, :) = pack(facets%share(k, :), taken)
    end do
    do k = 1, 3
      skin%normal(k, :) = pack(facets%normal(k, :), taken)
    end do
    skin%corners = merge(4, 3, skin%node(4, :) > 0)
    skin%is_listed = pack(facets%is_listed, taken)
    skin%part = pack(facets%part, taken)
    skin%part_id = model%part(skin%part)%id
    skin%size = pack(facets%size, taken)
    call find_bodies(model%mesh, model%nodes, body)
    skin%body = body(skin%node(1, :))
    call number_vertices(model%nodes, skin)
    call find_edges(skin)
    call collect(skin%vertices, skin%at, skin%ends, skin%first_edge, skin%edge)
    call measure_turns(model%x, skin)
    call judge_vertices(model%x, skin)
    skin%is_closed = skin%facets > 0 .and. all(skin%is_listed) .and. all(skin%beside > 0)
  end subroutine make_skin

  !> Vertices and the facets round them.
  subroutine number_vertices(nodes, skin)
    integer, intent(in) :: nodes
    type(skin_t), intent(inout) :: skin
    logical :: node_in(0:nodes)
    integer :: k
    node_in = .false.
    do k = 1, skin%facets
      node_in(skin%node(:, k)) = .true.
    end do
    skin%vertex = pack([(k, k=1, nodes)], node_in(1:))
    skin%vertices = size(skin%vertex)
    allocate (skin%at(nodes))
    skin%at = 0
    skin%at(skin%vertex) = [(k, k=1, skin%vertices)]
    call collect(skin%vertices, skin%at, skin%node, skin%first_facet, skin%facet)
  end subroutine number_vertices

  !> Lists by vertex: which columns of node (*, items) have it; first (vertices + 1).
  pure subroutine collect(vertices, at, node, first, item)
    integer, intent(in) :: vertices, at(:), node(:, :)
    integer, allocatable, intent(out) :: first(:), item(:)
    integer :: fill(vertices), i, k
    allocate (first(vertices + 1), item(count(node > 0)))
    fill = 0
    do k = 1, size(node, 2)
      do i = 1, size(node, 1)
        if (node(i, k) > 0) fill(at(node(i, k))) = fill(at(node(i, k))) + 1
      end do
    end do
    first(1) = 1
    do i = 1, vertices
      first(i + 1) = first(i) + fill(i)
    end do
    fill = first(:vertices)
    do k = 1, size(node, 2)
      do i = 1, size(node, 1)
        if (node(i, k) == 0) cycle
        associate (v => at(node(i, k)))
          item(fill(v)) = k
          fill(v) = fill(v) + 1
        end associate
      end do
    end do
  end subroutine collect

  !> Edges, each once, and the facets on either side, found among those round its first node.
  subroutine find_edges(skin)
    type(skin_t), intent(inout) :: skin
    integer :: ends(2, 4*skin%facets), beside(2, 4*skin%facets)
    integer :: k, j, other, place
    allocate (skin%edge_of(4, skin%facets))
    skin%edge_of = 0
    beside = 0
    do k = 1, skin%facets
      do j = 1, skin%corners(k)
        if (skin%edge_of(j, k) > 0) cycle
        skin%edges = skin%edges + 1
        ends(:, skin%edges) = [skin%node(j, k), skin%node(1 + mod(j, skin%corners(k)), k)]
        beside(1, skin%edges) = k
        skin%edge_of(j, k) = skin%edges
        call find_other(skin, ends(:, skin%edges), k, other, place)
        if (other == 0) cycle
        beside(2, skin%edges) = other
        skin%edge_of(place, other) = skin%edges
      end do
    end do
    skin%ends = ends(:, :skin%edges)
    skin%beside = beside(:, :skin%edges)
  end subroutine find_edges

  !> The facet that has the edge a-b of facet k the other way round, and its place there.
  pure subroutine find_other(skin, ends, k, other, place)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: ends(2), k
    integer, intent(out) :: other, place
    integer :: i
    associate (v => skin%at(ends(1)))
      do i = skin%first_facet(v), skin%first_facet(v + 1) - 1
        other = skin%facet(i)
        if (other == k) cycle
        do place = 1, skin%corners(other)
          if (skin%edge_of(place, other) > 0) cycle
          if (skin%node(place, other) == ends(2) .and. &
              skin%node(1 + mod(place, skin%corners(other)), other) == ends(1)) return
        end do
      end do
    end associate
    other = 0
    place = 0
  end subroutine find_other

  !> Angle from normal a to normal b round an edge along t, the first facet on its left seen
  !> from outside: > 0 where the boundary is convex.
  pure real(wp) function dihedral(a, b, t)
    real(wp), intent(in) :: a(3), b(3), t(3)
    dihedral = atan2(dot_product(cross(a, b), t), dot_product(a, b))
  end function dihedral

  subroutine measure_turns(x, skin)
    real(wp), intent(in) :: x(:, :)
    type(skin_t), intent(inout) :: skin
    real(wp) :: t(3)
    integer :: e
    allocate (skin%turn(skin%edges))
    skin%turn = zero
    do e = 1, skin%edges
      if (skin%beside(2, e) == 0) cycle
      t = x(:, skin%ends(2, e)) - x(:, skin%ends(1, e))
      skin%turn(e) = dihedral(skin%normal(:, skin%beside(1, e)), &
          skin%normal(:, skin%beside(2, e)), t/norm2(t))
    end do
  end subroutine measure_turns

  !> What each vertex is: a corner where three edges or more are convex and sharp, or two that
  !> do not continue each other, and none is reflex; the solid angle of the body there, by its
  !> excess (sum of the angles between its facets less (n - 2) pi).
  subroutine judge_vertices(x, skin)
    real(wp), intent(in) :: x(:, :)
    type(skin_t), intent(inout) :: skin
    real(wp), parameter :: pi = 180.0_wp*degree
    real(wp) :: t(3), sum_of_t(3), length
    integer :: v, i, sharp
    logical :: is_reflex
    allocate (skin%is_corner(skin%vertices), skin%solid_angle(skin%vertices), &
        skin%shortest(skin%vertices))
    skin%shortest = huge(one)
    do v = 1, skin%vertices
      sharp = 0
      is_reflex = .false.
      sum_of_t = zero
      skin%solid_angle(v) = 2.0_wp*pi
      do i = skin%first_edge(v), skin%first_edge(v + 1) - 1
        associate (e => skin%edge(i))
          t = x(:, sum(skin%ends(:, e)) - skin%vertex(v)) - x(:, skin%vertex(v))
          length = norm2(t)
          skin%shortest(v) = min(skin%shortest(v), length)
          skin%solid_angle(v) = skin%solid_angle(v) - skin%turn(e)
          is_reflex = is_reflex .or. skin%turn(e) < -sharp_vertex
          if (skin%turn(e) <= sharp_vertex) cycle
          sharp = sharp + 1
          sum_of_t = sum_of_t + t/length
        end associate
      end do
      skin%is_corner(v) = .not. is_reflex .and. (sharp > 2 .or. &
          (sharp == 2 .and. norm2(sum_of_t) > 2.0_wp*sin(sharp_vertex/2.0_wp)))
    end do
  end subroutine judge_vertices

end module contact_skin
