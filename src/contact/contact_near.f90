! SPDX-License-Identifier: BSD-3-Clause
!> Verlet lists: which edges of an obstacle each node of a side may meet soon.
module contact_near
  use base_archive, only: archive_t, archive_restore
  use base_kinds, only: wp, zero, one, half
  use base_sort, only: sort_integers
  use contact_features, only: cone_of_node_t, cone_of_node, normal_between, faces, degree, &
      difference
  use contact_places, only: is_excluded
  use contact_repeat, only: last_place_t
  use contact_surface, only: surface_t, turn_between
  use contact_tree, only: tree_t, edges_near, distance_to_edges
  implicit none
  private

  !> Of an open obstacle: what a node that is near has been seen to be.
  integer, parameter, public :: is_away = 0, is_in_front = 1, is_behind = 2

  type, public :: near_t
    integer :: n = 0                           !< nodes that are near
    integer, allocatable :: node(:)            !< rows of the surface's nodes, increasing
    integer, allocatable :: first(:), edge(:)  !< their edges, increasing
    real(wp), allocatable :: distance(:)       !< true gap at the end of the last step [L]
    integer, allocatable :: nearest(:)         !< the edge that this gap is to
    type(last_place_t), allocatable :: last(:)
    integer, allocatable :: front(:)           !< away, in front, behind: of open obstacles
  end type near_t

  !> Edges whose normals are this far off the cone of a node are listed too: they may turn.
  real(wp), parameter, public :: listing_angle = 60.0_wp*degree
  !> What an edge may turn between two searches [radians]: half of what is left of it.
  real(wp), parameter, public :: turn_limit = 0.2_wp

  public :: list_near, exchange_near, longest_list, start_list, add_node, keep_memory

contains

  !> Lists for every node of `own` the edges of the obstacle that are nearer than reach and
  !> may come to face it. distance [L]: the smallest of all that is not listed; turned: some
  !> edge is near but does not face, so that turning may bring it on.
  subroutine list_near(own, obstacle, tree, x, u, reach, may_share, leaves_out, near, &
      distance, turned)
    type(surface_t), intent(in) :: own, obstacle
    type(tree_t), intent(in) :: tree
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(in) :: reach
    logical, intent(in) :: may_share, leaves_out(:, :)
    type(near_t), intent(inout) :: near
    real(wp), intent(out) :: distance
    logical, intent(out) :: turned
    type(near_t) :: old
    integer, allocatable :: found(:)
    logical, allocatable :: nothing(:)
    type(cone_of_node_t) :: cone
    real(wp) :: p(2), d
    integer :: k, n, m, edge
    old = near
    allocate (found(size(obstacle%length)), nothing(size(obstacle%length)))
    nothing = .not. obstacle%is_listed
    call start_list(size(own%node), near)
    distance = huge(one)
    turned = .false.
    do k = 1, size(own%node)
      p = x(:, own%node(k)) + u(:, own%node(k))
      n = 0
      call edges_near(tree, p, reach, found, n)
      call drop_left_out(own, obstacle, k, leaves_out, found, n)
      m = n
      if (n > 0) call cone_of_node(own, k, x, u, .false., cone)
      call keep_facing(own, obstacle, k, x, u, cone, may_share, found, n, turned)
      if (m == 0) then
        if (size(leaves_out) > 0) then
          distance = min(distance, reach)
          cycle
        end if
        call distance_to_edges(tree, p, nothing, distance, d, edge)
        distance = min(distance, d)
      else
        distance = min(distance, reach)
      end if
      if (n > 0) call add_node(k, found(:n), near)
    end do
    call keep_memory(old, near)
  end subroutine list_near

  !> An empty list for a side of so many nodes.
  pure subroutine start_list(nodes, near)
    integer, intent(in) :: nodes
    type(near_t), intent(inout) :: near
    near%n = 0
    if (allocated(near%node)) deallocate (near%node, near%first, near%edge)
    allocate (near%node(nodes), near%first(nodes + 1), near%edge(0))
    near%first(1) = 1
  end subroutine start_list

  !> One more node, row k of its side, with its edges or facets.
  subroutine add_node(k, edges, near)
    integer, intent(in) :: k, edges(:)
    type(near_t), intent(inout) :: near
    integer, allocatable :: longer(:)
    integer :: start
    near%n = near%n + 1
    near%node(near%n) = k
    start = near%first(near%n)
    if (size(near%edge) < start + size(edges) - 1) then
      allocate (longer(2*size(near%edge) + size(edges) + 64))
      longer(:start - 1) = near%edge(:start - 1)
      call move_alloc(longer, near%edge)
    end if
    near%edge(start:start + size(edges) - 1) = edges
    call sort_integers(near%edge(start:start + size(edges) - 1))
    near%first(near%n + 1) = start + size(edges)
  end subroutine add_node

  !> Drops the edges that do not belong to the obstacle, and those of parts that the part of a
  !> node does not touch.
  pure subroutine drop_left_out(own, obstacle, k, leaves_out, found, n)
    type(surface_t), intent(in) :: own, obstacle
    integer, intent(in) :: k
    logical, intent(in) :: leaves_out(:, :)
    integer, intent(inout) :: found(:), n
    integer :: i, m, edge
    edge = maxval(own%node_edge(:, k))
    m = 0
    do i = 1, n
      if (.not. obstacle%is_listed(found(i))) cycle
      if (size(leaves_out) > 0 .and. edge > 0) then
        if (leaves_out(own%part(edge), obstacle%part(found(i)))) cycle
      end if
      m = m + 1
      found(m) = found(i)
    end do
    n = m
  end subroutine drop_left_out

  !> Of the found edges those that may face the node, or whose vertex may.
  pure subroutine keep_facing(own, obstacle, k, x, u, cone, may_share, found, n, turned)
    type(surface_t), intent(in) :: own, obstacle
    integer, intent(in) :: k
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(cone_of_node_t), intent(in) :: cone
    logical, intent(in) :: may_share
    integer, intent(inout) :: found(:), n
    logical, intent(inout) :: turned
    integer :: i, m
    m = 0
    do i = 1, n
      if (may_share) then
        if (is_excluded(obstacle, found(i), own%node(k), own%chain(:, k))) cycle
      end if
      if (.not. faces(normal_of(obstacle, found(i), x, u), cone, listing_angle)) then
        turned = .true.
        if (.not. vertex_faces(obstacle, found(i), x, u, cone)) cycle
      end if
      m = m + 1
      found(m) = found(i)
    end do
    n = m
  end subroutine keep_facing

  pure function normal_of(surface, edge, x, u) result(n)
    type(surface_t), intent(in) :: surface
    integer, intent(in) :: edge
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp) :: n(2)
    n = normal_between(x, u, surface%end_node(1, edge), surface%end_node(2, edge), .false.)
  end function normal_of

  !> A sharp tip may face a blunt one though neither of its flanks does: the edge before
  !> such a vertex stands for it.
  pure logical function vertex_faces(obstacle, edge, x, u, cone)
    type(surface_t), intent(in) :: obstacle
    integer, intent(in) :: edge
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(cone_of_node_t), intent(in) :: cone
    real(wp) :: n1(2), n2(2), turn, middle
    vertex_faces = .false.
    if (obstacle%neighbour(2, edge) == 0) return
    n1 = normal_of(obstacle, edge, x, u)
    n2 = normal_of(obstacle, obstacle%neighbour(2, edge), x, u)
    turn = turn_between(n1, n2)
    if (turn <= zero .or. faces(n2, cone, listing_angle)) return
    middle = abs(turn_between(n1, -cone%middle) - half*turn)
    vertex_faces = middle <= half*turn + cone%half_width
  end function vertex_faces

  !> Nodes that were near before keep what is known of them.
  pure subroutine keep_memory(old, near)
    type(near_t), intent(in) :: old
    type(near_t), intent(inout) :: near
    integer :: i, j
    if (allocated(near%distance)) deallocate (near%distance, near%front, near%nearest, &
        near%last)
    allocate (near%distance(near%n), near%front(near%n), near%nearest(near%n))
    allocate (near%last(near%n))
    near%nearest = 0
    near%distance = -huge(one)
    near%front = is_away
    j = 1
    do i = 1, near%n
      do while (j <= old%n)
        if (old%node(j) >= near%node(i)) exit
        j = j + 1
      end do
      if (j > old%n) return
      if (old%node(j) == near%node(i)) near%front(i) = old%front(j)
    end do
  end subroutine keep_memory

  !> Edges on the longest list of a node.
  pure integer function longest_list(near)
    type(near_t), intent(in) :: near
    integer :: i
    longest_list = 0
    do i = 1, near%n
      longest_list = max(longest_list, near%first(i + 1) - near%first(i))
    end do
  end function longest_list

  !> Saves a list to the archive or restores it.
  subroutine exchange_near(archive, near)
    type(archive_t), intent(inout) :: archive
    type(near_t), intent(inout) :: near
    integer :: n, m
    n = near%n
    m = 0
    if (n > 0) m = near%first(n + 1) - 1
    call archive%exchange('near.n', n)
    call archive%exchange('near.m', m)
    if (archive%mode == archive_restore) then
      if (allocated(near%node)) deallocate (near%node, near%first, near%edge, near%distance, &
          near%front, near%nearest, near%last)
      allocate (near%node(n), near%first(n + 1), near%edge(m), near%distance(n), near%front(n))
      allocate (near%nearest(n), near%last(n))
      near%nearest = 0
      near%first = 1
      near%n = n
    end if
    if (n == 0) return
    call archive%exchange('near.node', near%node(:n))
    call archive%exchange('near.first', near%first(:n + 1))
    call archive%exchange('near.edge', near%edge(:m))
    call archive%exchange('near.distance', near%distance(:n))
    call archive%exchange('near.nearest', near%nearest(:n))
    call archive%exchange('near.front', near%front(:n))
  end subroutine exchange_near

end module contact_near
