! SPDX-License-Identifier: BSD-3-Clause
!> The places on an obstacle that a node faces: one for each local minimum of its distance
!> from the boundary. Before a smooth boundary and at a convex corner there is one, in a
!> notch two. The space outside a convex corner is a union of half-planes: one row, whose
!> normal the free motion chooses; that in front of a reflex corner an intersection: both
!> rows.
module contact_places
  use base_kinds, only: wp, zero, one, half
  use contact_corner, only: common_directions, is_beside, choose_normal, keep_edge_normal, &
      direction
  use contact_features, only: cone_of_node_t, frame_t, edge_frame, local_coordinate, &
      gap_to_edge, cone_of_node, faces, difference, facing_angle, &
      smooth_angle, end_tolerance, degree
  use contact_surface, only: surface_t, turn_between
  implicit none
  private

  !> A place and the row that it makes.
  type, public :: place_t
    integer :: side = 1              !< of the node
    integer :: node = 0
    integer :: edge = 0              !< where it lies; that before the vertex
    integer :: vertex = 0            !< node of the obstacle, 0 = on the edge
    real(wp) :: s = zero             !< local coordinate on the edge
    real(wp) :: normal(2) = zero
    real(wp) :: gap = zero           !< at the start of the step [L]
    real(wp) :: length = zero        !< of the edge, the shorter of two at a vertex [L]
    real(wp) :: own_size = zero      !< of the node's edges that face it [L]
    real(wp) :: allowance = zero     !< what it may go below zero [L]
    logical :: is_exact = .false.    !< gap >= 0; else a row only below the allowance
    logical :: is_twin = .false.     !< another node's exact row says the same
    logical :: is_second = .false.   !< not the nearest of its node
    integer :: row = 0               !< a late place: the row whose frame it replaces
  end type place_t

  !> Work space: the edges that a node sees.
  type, public :: sight_t
    integer, allocatable :: at(:)          !< (edges) number in the list, 0 = not in it
    integer :: n = 0                       !< with neighbours that were not listed
    integer, allocatable :: edge(:)
    type(frame_t), allocatable :: frame(:)
    real(wp), allocatable :: s(:), gap(:)
    logical, allocatable :: is_kept(:)     !< its place makes a row
    type(place_t), allocatable :: place(:) !< found so far, for this node
    integer :: places = 0
    type(cone_of_node_t) :: cone           !< of the node
  end type sight_t

  !> What stays the same for all nodes of a side.
  type, public :: view_t
    logical :: is_reference = .false.      !< normals of the reference geometry
    logical :: may_share = .false.         !< a node may belong to both sides
    real(wp) :: reach = zero               !< rows are made up to this gap [L]
  end type view_t

  real(wp), parameter, public :: deepest = 0.3_wp  !< edges: a deeper node is not before it
  real(wp), parameter, public :: narrow = 3.0_wp*degree    !< two faces that lie on each other
  real(wp), parameter :: empty = 10.0_wp*degree    !< cones that miss each other by more
  real(wp), parameter, public :: corner = 20.0_wp*degree   !< a sharper one is watched exactly
  !> Edges: a corner that is further beside another does not meet it; nearer they are twins.
  real(wp), parameter, public :: beside = 0.1_wp
  !> Allowances / shorter edge.
  real(wp), parameter, public :: share_of_edge = 1.0e-3_wp
  real(wp), parameter, public :: share_at_corner = 2.0e-4_wp

  public :: find_places, size_sight, is_excluded, clamped

contains

  !> Work space for lists of up to n edges of a surface of so many edges.
  pure subroutine size_sight(edges, n, sight)
    integer, intent(in) :: edges, n
    type(sight_t), intent(inout) :: sight
    integer :: m
    if (allocated(sight%at)) then
      if (size(sight%at) >= edges .and. size(sight%edge) >= 3*n) return
      deallocate (sight%at, sight%edge, sight%frame, sight%s, sight%gap, sight%is_kept, &
          sight%place)
    end if
    m = 3*n + 8
    allocate (sight%at(edges), sight%edge(m), sight%frame(m), sight%s(m), sight%gap(m))
    allocate (sight%is_kept(m), sight%place(m))
    sight%at = 0
  end subroutine size_sight

  !> True for an edge that the node owns or that touches a neighbour of it.
  pure logical function is_excluded(surface, edge, node, chain)
    type(surface_t), intent(in) :: surface
    integer, intent(in) :: edge, node, chain(2)
    associate (a => surface%end_node(1, edge), b => surface%end_node(2, edge))
      is_excluded = a == node .or. b == node .or. a == chain(1) .or. b == chain(1) .or. &
          a == chain(2) .or. b == chain(2)
    end associate
  end function is_excluded

  !> Places of row k of the nodes of `own` on the listed edges of the obstacle, at X + U, into
  !> sight%place, the nearest first. free (2, nodes): the motion that chooses the normal at a
  !> convex corner [L]; none where it is absent.
  subroutine find_places(own, obstacle, k, list, x, u, view, sight, free)
    type(surface_t), intent(in) :: own, obstacle
    integer, intent(in) :: k, list(:)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(view_t), intent(in) :: view
    type(sight_t), intent(inout) :: sight
    real(wp), intent(in), optional, contiguous :: free(:, :)
    type(cone_of_node_t) :: cone
    integer :: j
    sight%places = 0
    sight%n = 0
    call cone_of_node(own, k, x, u, view%is_reference, cone)
    sight%cone = cone
    if (cone%turn < -corner) return    ! a reflex vertex is never hit first
    do j = 1, size(list)
      call see_edge(own, obstacle, k, list(j), x, u, view, cone, .true., sight)
    end do
    do j = 1, size(list)
      ! Handed on where it is absent, it would be read to see whether it is contiguous.
      if (present(free)) then
        call look_at_vertices(own, obstacle, k, j, size(list), x, u, view, cone, sight, free)
      else
        call look_at_vertices(own, obstacle, k, j, size(list), x, u, view, cone, sight)
      end if
    end do
    do j = 1, sight%n
      if (sight%is_kept(j)) call add_edge_place(obstacle, own%node(k), j, x, u, sight)
      sight%at(sight%edge(j)) = 0
    end do
    if (sight%places > 1) call merge_places(obstacle, x, u, sight)
    do j = 1, sight%places
      associate (p => sight%place(j))
        p%own_size = size_of_node(own, k, cone, p%normal)
        p%allowance = allowance_of(own, k, p%own_size, p%length)
      end associate
    end do
  end subroutine find_places

  !> An edge into the list: its frame, the node's place along it and gap, whether that makes a
  !> row.
  pure subroutine see_edge(own, obstacle, k, edge, x, u, view, cone, may_keep, sight)
    type(surface_t), intent(in) :: own, obstacle
    integer, intent(in) :: k, edge
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(view_t), intent(in) :: view
    type(cone_of_node_t), intent(in) :: cone
    logical, intent(in) :: may_keep
    type(sight_t), intent(inout) :: sight
    real(wp) :: s
    sight%n = sight%n + 1
    associate (j => sight%n, node => own%node(k))
      sight%at(edge) = j
      sight%edge(j) = edge
      call edge_frame(obstacle, edge, x, u, view%is_reference, sight%frame(j))
      s = local_coordinate(obstacle, edge, sight%frame(j), x, u, node)
      sight%s(j) = s
      sight%gap(j) = gap_to_edge(obstacle, edge, sight%frame(j)%normal, clamped(s), x, u, node)
      sight%is_kept(j) = may_keep .and. s >= -end_tolerance .and. s <= one + end_tolerance
      if (sight%is_kept(j)) sight%is_kept(j) = makes_row(obstacle, j, view, cone, sight)
    end associate
  end subroutine see_edge

  !> Is the node near enough in front of edge j of the list, and does the edge face it?
  pure logical function makes_row(obstacle, j, view, cone, sight)
    type(surface_t), intent(in) :: obstacle
    integer, intent(in) :: j
    type(view_t), intent(in) :: view
    type(cone_of_node_t), intent(in) :: cone
    type(sight_t), intent(in) :: sight
    makes_row = sight%gap(j) <= view%reach .and. &
        sight%gap(j) > -deepest*obstacle%length(sight%edge(j))
    if (makes_row) makes_row = faces(sight%frame(j)%normal, cone, facing_angle)
  end function makes_row

  !> A local coordinate that is at an end of its edge to round-off is there.
  pure real(wp) function clamped(s)
    real(wp), intent(in) :: s
    clamped = s
    if (s <= end_tolerance) clamped = zero
    if (s >= one - end_tolerance) clamped = one
  end function clamped

  !> Both ends of edge j of the list; a vertex between two listed edges once.
  subroutine look_at_vertices(own, obstacle, k, j, listed, x, u, view, cone, sight, free)
    type(surface_t), intent(in) :: own, obstacle
    integer, intent(in) :: k, j, listed
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(view_t), intent(in) :: view
    type(cone_of_node_t), intent(in) :: cone
    type(sight_t), intent(inout) :: sight
    real(wp), intent(in), optional, contiguous :: free(:, :)
    real(wp) :: y(2), f(2)
    integer :: s, other, vertex, first, second
    do s = 1, 2
      other = obstacle%neighbour(s, sight%edge(j))
      if (other == 0) cycle
      if (s == 1 .and. sight%at(other) > 0 .and. sight%at(other) <= listed) cycle
      vertex = obstacle%end_node(s, sight%edge(j))
      y = difference(x, u, own%node(k), vertex)
      if (y(1)**2 + y(2)**2 > view%reach**2) then
        ! The side wall of a body holds nodes that stand on its top, however far the corner
        ! is.
        if (sight%at(other) == 0 .or. .not. sight%is_kept(j)) cycle
        if (.not. sight%is_kept(sight%at(other))) cycle
      end if
      if (view%may_share) then
        if (is_excluded(obstacle, other, own%node(k), own%chain(:, k))) cycle
      end if
      if (sight%at(other) == 0) &
          call see_edge(own, obstacle, k, other, x, u, view, cone, .false., sight)
      first = merge(sight%at(other), j, s == 1)
      second = merge(j, sight%at(other), s == 1)
      f = zero
      if (present(free)) f = free(:, own%node(k)) - free(:, vertex)
      call judge_vertex(own, obstacle, k, vertex, first, second, y, f, view, cone, sight)
    end do
  end subroutine look_at_vertices

  !> What a vertex between two edges of the list changes: rows of edges that come or go, and a
  !> row of its own.
  subroutine judge_vertex(own, obstacle, k, vertex, first, second, y, f, view, cone, sight)
    type(surface_t), intent(in) :: own, obstacle
    integer, intent(in) :: k, vertex, first, second
    real(wp), intent(in) :: y(2), f(2)
    type(view_t), intent(in) :: view
    type(cone_of_node_t), intent(in) :: cone
    type(sight_t), intent(inout) :: sight
    real(wp) :: turn, shorter
    logical :: in_first, in_second
    in_first = sight%s(first) <= one + end_tolerance
    in_second = sight%s(second) >= -end_tolerance
    associate (n1 => sight%frame(first)%normal, n2 => sight%frame(second)%normal)
      turn = zero
      if (abs(n1(1) - n2(1)) + abs(n1(2) - n2(2)) > zero) turn = turn_between(n1, n2)
    end associate
    shorter = min(obstacle%length(sight%edge(first)), obstacle%length(sight%edge(second)))
    if (turn < -smooth_angle) then
      if (in_first .and. in_second) return
      if (.not. sight%is_kept(first)) &
          sight%is_kept(first) = makes_row(obstacle, first, view, cone, sight)
      if (.not. sight%is_kept(second)) &
          sight%is_kept(second) = makes_row(obstacle, second, view, cone, sight)
    else if (turn <= smooth_angle) then
      if (in_first .or. in_second) return
      call add_smooth_vertex(own%node(k), vertex, first, second, shorter, y, view, cone, sight)
    else
      call judge_corner(own, obstacle, k, vertex, first, second, turn, shorter, y, f, view, &
          cone, sight)
    end if
  end subroutine judge_vertex

  !> A node behind the ends of two edges that are nearly one: the mean normal.
  pure subroutine add_smooth_vertex(node, vertex, first, second, shorter, y, view, cone, sight)
    integer, intent(in) :: node, vertex, first, second
    real(wp), intent(in) :: shorter, y(2)
    type(view_t), intent(in) :: view
    type(cone_of_node_t), intent(in) :: cone
    type(sight_t), intent(inout) :: sight
    real(wp) :: n(2), gap
    n = sight%frame(first)%normal + sight%frame(second)%normal
    n = n/sqrt(n(1)**2 + n(2)**2)
    gap = dot_product(n, y)
    if (gap > view%reach .or. gap <= -deepest*shorter) return
    if (faces(n, cone, facing_angle)) &
        call add_vertex_place(node, vertex, sight%edge(first), n, gap, shorter, sight)
  end subroutine add_smooth_vertex

  !> A convex corner: inside both half-planes the shallower edge holds; behind both ends, or
  !> at the very end of one, the vertex.
  subroutine judge_corner(own, obstacle, k, vertex, first, second, turn, shorter, y, f, view, &
      cone, sight)
    type(surface_t), intent(in) :: own, obstacle
    integer, intent(in) :: k, vertex, first, second
    real(wp), intent(in) :: turn, shorter, y(2), f(2)
    type(view_t), intent(in) :: view
    type(cone_of_node_t), intent(in) :: cone
    type(sight_t), intent(inout) :: sight
    logical :: in_first, in_second
    real(wp) :: beyond, stays
    integer :: held
    in_first = sight%s(first) <= one + end_tolerance
    in_second = sight%s(second) >= -end_tolerance
    held = 0
    stays = zero
    if (in_first .and. in_second) then
      if (.not. (sight%is_kept(first) .and. sight%is_kept(second))) return
      held = merge(second, first, sight%gap(first) < sight%gap(second))
      sight%is_kept(merge(second, first, held == first)) = .false.
      if (abs(sight%gap(first) - sight%gap(second)) > 1.0e-7_wp*shorter) return
    else if (in_first .or. in_second) then
      held = merge(first, second, in_first)
      stays = narrow
      beyond = merge(one - sight%s(first), sight%s(second), in_first) &
          *obstacle%length(sight%edge(held))
      if (beyond > allowance_of(own, k, size_of_node(own, k, cone, sight%frame(held)%normal), &
          shorter)) return
    end if
    call choose_at_corner(own, k, vertex, first, second, held, stays, turn, shorter, y, f, &
        view, cone, sight)
  end subroutine judge_corner

  !> The row of a convex corner: a normal of its cone that is one of the node's too, reversed.
  !> Of the two ends of what they have in common, the one whose half-plane the free motion f
  !> leaves least, or last. held: the edge whose row it would replace, 0 = none; that stays
  !> where the common cone is narrower than `stays`: faces that lie on each other.
  subroutine choose_at_corner(own, k, vertex, first, second, held, stays, turn, shorter, y, f, &
      view, cone, sight)
    type(surface_t), intent(in) :: own
    integer, intent(in) :: k, vertex, first, second, held
    real(wp), intent(in) :: stays, turn, shorter, y(2), f(2)
    type(view_t), intent(in) :: view
    type(cone_of_node_t), intent(in) :: cone
    type(sight_t), intent(inout) :: sight
    real(wp) :: low, high, n(2), gap, middle(2)
    middle = sight%frame(first)%normal
    middle = cos(half*turn)*middle + sin(half*turn)*[-middle(2), middle(1)]
    call common_directions(middle, half*turn, cone, low, high)
    if (high - low < -empty) return
    if (held > 0 .and. high - low < stays) then
      if (sight%is_kept(held)) return
    end if
    if (is_beside(middle, half*turn, low, high, y, f, &
        beside*min(shorter, size_or(own, k, cone, middle, shorter)))) return
    if (high - low < 1.0e-9_wp) then
      n = direction(middle, half*(low + high))
    else
      call choose_normal(direction(middle, low), direction(middle, high), y, f, &
          allowance_of(own, k, size_of_node(own, k, cone, middle), shorter), shorter, n)
    end if
    gap = dot_product(n, y)
    if (gap > view%reach .or. gap <= -deepest*shorter) return
    if (held > 0) sight%is_kept(held) = .false.
    call keep_edge_normal(sight%frame(first)%normal, n)
    call keep_edge_normal(sight%frame(second)%normal, n)
    call add_vertex_place(own%node(k), vertex, sight%edge(first), n, dot_product(n, y), &
        shorter, sight)
  end subroutine choose_at_corner

  !> The size of a node, or a length where it is a lone one [L].
  pure real(wp) function size_or(own, k, cone, normal, length)
    type(surface_t), intent(in) :: own
    integer, intent(in) :: k
    type(cone_of_node_t), intent(in) :: cone
    real(wp), intent(in) :: normal(2), length
    size_or = size_of_node(own, k, cone, normal)
    if (.not. size_or > zero) size_or = length
  end function size_or

  !> Mean length of a node's own edges that face a normal (none: of both) [L]; 0 for a lone
  !> node, which is finer than any edge.
  pure real(wp) function size_of_node(own, k, cone, normal)
    type(surface_t), intent(in) :: own
    integer, intent(in) :: k
    type(cone_of_node_t), intent(in) :: cone
    real(wp), intent(in) :: normal(2)
    real(wp), parameter :: facing_cosine = -0.7_wp
    logical :: first, second
    size_of_node = zero
    if (cone%is_all) return
    first = normal(1)*cone%normal(1, 1) + normal(2)*cone%normal(2, 1) < facing_cosine
    second = normal(1)*cone%normal(1, 2) + normal(2)*cone%normal(2, 2) < facing_cosine
    associate (length => own%chain_length(:, k))
      size_of_node = half*(length(1) + length(2))
      if (first .neqv. second) size_of_node = merge(length(1), length(2), first)
    end associate
  end function size_of_node

  !> What a node without an exact row may go below zero [L]: a small share of the shorter edge
  !> at hand.
  pure real(wp) function allowance_of(own, k, own_size, length)
    type(surface_t), intent(in) :: own
    integer, intent(in) :: k
    real(wp), intent(in) :: own_size, length
    allowance_of = length
    if (own_size > zero) allowance_of = min(own_size, length)
    allowance_of = allowance_of*merge(share_at_corner, share_of_edge, own%turn(k) > corner)
  end function allowance_of

  pure subroutine add_vertex_place(node, vertex, edge, n, gap, length, sight)
    integer, intent(in) :: node, vertex, edge
    real(wp), intent(in) :: n(2), gap, length
    type(sight_t), intent(inout) :: sight
    sight%places = sight%places + 1
    sight%place(sight%places) = place_t(node=node, edge=edge, vertex=vertex, s=one, normal=n, &
        gap=gap, length=length)
  end subroutine add_vertex_place

  pure subroutine add_edge_place(obstacle, node, j, x, u, sight)
    type(surface_t), intent(in) :: obstacle
    integer, intent(in) :: node, j
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(sight_t), intent(inout) :: sight
    real(wp) :: s
    s = clamped(min(one, max(zero, sight%s(j))))
    sight%places = sight%places + 1
    sight%place(sight%places) = place_t(node=node, edge=sight%edge(j), s=s, &
        normal=sight%frame(j)%normal, length=obstacle%length(sight%edge(j)), &
        gap=gap_to_edge(obstacle, sight%edge(j), sight%frame(j)%normal, s, x, u, node))
  end subroutine add_edge_place

  !> The nearest first; of two whose normals are nearly the same the nearer, and of two edges
  !> that are as near their common vertex with the mean normal.
  pure subroutine merge_places(obstacle, x, u, sight)
    type(surface_t), intent(in) :: obstacle
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(sight_t), intent(inout) :: sight
    type(place_t) :: p
    integer :: i, j, kept
    logical :: is_new
    do i = 2, sight%places
      p = sight%place(i)
      j = i - 1
      do while (j > 0)
        if (.not. comes_before(p, sight%place(j))) exit
        sight%place(j + 1) = sight%place(j)
        j = j - 1
      end do
      sight%place(j + 1) = p
    end do
    kept = 0
    do i = 1, sight%places
      p = sight%place(i)
      is_new = .true.
      do j = 1, kept
        if (dot_product(p%normal, sight%place(j)%normal) <= cos(smooth_angle)) cycle
        is_new = .false.
        call meet_at_vertex(obstacle, x, u, p, sight%place(j))
      end do
      if (.not. is_new) cycle
      kept = kept + 1
      sight%place(kept) = p
      sight%place(kept)%is_second = kept > 1
    end do
    sight%places = kept
  end subroutine merge_places

  pure logical function comes_before(p, q)
    type(place_t), intent(in) :: p, q
    comes_before = abs(p%gap) < abs(q%gap)
    if (.not. comes_before .and. .not. abs(p%gap) > abs(q%gap)) comes_before = p%edge < q%edge
  end function comes_before

  !> Two neighbouring edges as near as each other: q becomes their vertex.
  pure subroutine meet_at_vertex(obstacle, x, u, p, q)
    type(surface_t), intent(in) :: obstacle
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(place_t), intent(in) :: p
    type(place_t), intent(inout) :: q
    real(wp) :: n(2)
    integer :: first, vertex
    if (p%vertex > 0 .or. q%vertex > 0) return
    if (abs(abs(p%gap) - abs(q%gap)) > 1.0e-9_wp*min(p%length, q%length)) return
    first = 0
    if (obstacle%neighbour(2, p%edge) == q%edge) first = p%edge
    if (obstacle%neighbour(2, q%edge) == p%edge) first = q%edge
    if (first == 0) return
    vertex = obstacle%end_node(2, first)
    n = p%normal + q%normal
    n = n/sqrt(n(1)**2 + n(2)**2)
    q%edge = first
    q%vertex = vertex
    q%s = one
    q%normal = n
    q%gap = dot_product(n, x(:, q%node) - x(:, vertex)) &
        + dot_product(n, u(:, q%node) - u(:, vertex))
    q%length = min(p%length, q%length)
  end subroutine meet_at_vertex

end module contact_places
