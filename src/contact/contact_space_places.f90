! SPDX-License-Identifier: BSD-3-Clause
!> The places in space on an obstacle that a node faces: one for each local minimum of its
!> distance from the boundary, as in the plane (contact_places). Before a facet it is there; of
!> features that no facet has alone: at a smooth edge or vertex the mean normal, at a convex one
!> the normal that the free motion chooses, in a notch all its sides.
module contact_space_places
  use base_kinds, only: wp, zero, one
  use contact_fan, only: fan_t, open_fan, size_fan, faces_fan
  use contact_features, only: smooth_angle, facing_angle, end_tolerance, degree
  use contact_places, only: view_t, deepest, share_of_edge, share_at_corner, narrow, beside
  use contact_sight, only: seen_t, see_facet, place_of_node, end_of_edge, from_node, on_edge, &
      on_vertex
  use contact_skin, only: skin_t, dihedral
  use contact_space_corner, only: common_normals, choose_of, spread_of, most_normals
  use linalg_dense, only: cross
  implicit none
  private

  !> A place and the row that it makes.
  type, public :: space_place_t
    integer :: side = 1              !< of the node
    integer :: node = 0
    integer :: facet = 0             !< one that has it
    !> of its row: the facet; of an edge - its number, of a vertex - (edges + its number)
    integer :: key = 0
    integer :: points = 0
    integer :: point(4) = 0          !< nodes of the obstacle
    real(wp) :: weight(4) = zero
    real(wp) :: y(3) = zero          !< the place, from the node, at the start of the step [L]
    real(wp) :: normal(3) = zero
    real(wp) :: gap = zero           !< at the start of the step [L]
    real(wp) :: length = zero        !< of the facet, the smallest of several [L]
    real(wp) :: own_size = zero      !< of the node's facets that face it [L]
    real(wp) :: allowance = zero     !< what it may go below zero [L]
    logical :: is_shared = .false.   !< no facet has it alone
    logical :: is_exact = .false.    !< gap >= 0; else a row only below the allowance
    logical :: is_twin = .false.     !< another node's exact row says the same
    logical :: is_second = .false.   !< not the nearest of its node
  end type space_place_t

  !> Work space: the facets that a node sees.
  type, public :: space_sight_t
    type(fan_t) :: fan                     !< of the node
    type(fan_t) :: other                   !< of a vertex of the obstacle
    integer :: n = 0                       !< with neighbours that were not listed
    type(seen_t), allocatable :: seen(:)
    integer, allocatable :: at(:)          !< (facets) number among them, 0 = not seen
    type(space_place_t), allocatable :: place(:)
    integer :: places = 0
  end type space_sight_t

  real(wp), parameter, public :: sine_of_facing = sin(facing_angle)
  real(wp), parameter :: reflex = sin(10.0_wp*degree)

  public :: find_space_places, size_space_sight, allowance_in_space

contains

  !> Work space for nodes of one net before another one, with lists of up to n facets.
  subroutine size_space_sight(own, obstacle, n, sight)
    type(skin_t), intent(in) :: own, obstacle
    integer, intent(in) :: n
    type(space_sight_t), intent(inout) :: sight
    integer :: m, most_round
    call size_fan(own, sight%fan)
    call size_fan(obstacle, sight%fan)
    call size_fan(own, sight%other)
    call size_fan(obstacle, sight%other)
    most_round = size(sight%other%size)
    m = n*(4 + 4*most_round) + 8
    if (allocated(sight%at)) then
      if (size(sight%at) >= max(own%facets, obstacle%facets) .and. size(sight%seen) >= m) return
      deallocate (sight%at, sight%seen, sight%place)
    end if
    allocate (sight%at(max(own%facets, obstacle%facets)), sight%seen(m), sight%place(m))
    sight%at = 0
  end subroutine size_space_sight

  !> Places of a node of `own` on the listed facets of the obstacle, at X + U, into sight%place,
  !> the nearest first. free (3, nodes): the motion that chooses the normal at a convex feature
  !> [L]; none where it is absent. The obstacle's facets round the node are left out where it may
  !> belong to both.
  subroutine find_space_places(own, obstacle, node, list, x, u, view, sight, free)
    type(skin_t), intent(in) :: own, obstacle
    integer, intent(in) :: node, list(:)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    real(wp), intent(in), optional, contiguous :: free(:, :)
    integer :: j
    sight%places = 0
    sight%n = 0
    call open_fan(own, node, x, u, view%is_reference, sight%fan)
    if (.not. sight%fan%is_all) then
      do j = 1, sight%fan%edges      ! a reflex vertex is never hit first
        if (dot_product(sight%fan%edge(:, j), sight%fan%mean) > reflex) return
      end do
    end if
    do j = 1, size(list)
      call see(obstacle, list(j), x, u, node, view, .true., sight)
    end do
    do j = 1, size(list)
      if (present(free)) then
        call look_around(own, obstacle, node, j, size(list), x, u, view, sight, free)
      else
        call look_around(own, obstacle, node, j, size(list), x, u, view, sight)
      end if
    end do
    call drop_hidden(obstacle, sight)
    do j = 1, sight%n
      if (sight%seen(j)%is_kept) call add_facet_place(obstacle, node, sight%seen(j), sight)
      sight%at(sight%seen(j)%facet) = 0
    end do
    if (sight%places > 1) call merge_places(sight)
    do j = 1, sight%places
      associate (p => sight%place(j))
        p%own_size = size_before(sight%fan, p%normal)
        p%allowance = allowance_in_space(own, node, p%own_size, p%length)
      end associate
    end do
  end subroutine find_space_places

  !> A facet among those that are seen.
  pure subroutine see(obstacle, facet, x, u, node, view, may_keep, sight)
    type(skin_t), intent(in) :: obstacle
    integer, intent(in) :: facet, node
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(view_t), intent(in) :: view
    logical, intent(in) :: may_keep
    type(space_sight_t), intent(inout) :: sight
    if (sight%at(facet) > 0) return
    sight%n = sight%n + 1
    sight%at(facet) = sight%n
    associate (seen => sight%seen(sight%n))
      call see_facet(obstacle, facet, x, u, place_of_node(x, u, node), view%is_reference, seen)
      seen%is_kept = may_keep .and. seen%is_before
      if (seen%is_kept) seen%is_kept = makes_row(obstacle, seen, view, sight%fan)
    end associate
  end subroutine see

  !> Is the node near enough in front of a facet, and does the facet face it?
  pure logical function makes_row(obstacle, seen, view, fan)
    type(skin_t), intent(in) :: obstacle
    type(seen_t), intent(in) :: seen
    type(view_t), intent(in) :: view
    type(fan_t), intent(in) :: fan
    makes_row = obstacle%is_listed(seen%facet) .and. seen%gap <= view%reach .and. &
        seen%gap > -deepest*obstacle%size(seen%facet)
    if (makes_row) makes_row = faces_fan(seen%normal, fan, sine_of_facing)
  end function makes_row

  !> The edges of facet j of the list, each once, and its vertex where it is the closest point.
  subroutine look_around(own, obstacle, node, j, listed, x, u, view, sight, free)
    type(skin_t), intent(in) :: own, obstacle
    integer, intent(in) :: node, j, listed
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    real(wp), intent(in), optional, contiguous :: free(:, :)
    real(wp) :: s, y(3), f(3)
    integer :: i, e, other
    do i = 1, obstacle%corners(sight%seen(j)%facet)
      e = obstacle%edge_of(i, sight%seen(j)%facet)
      other = sum(obstacle%beside(:, e)) - sight%seen(j)%facet
      if (other == 0) cycle
      if (sight%at(other) > 0 .and. sight%at(other) <= listed .and. sight%at(other) < j) cycle
      call end_of_edge(obstacle, e, x, u, node, s, y)
      if (sum(y**2) > view%reach**2) then
        ! The side wall of a body holds nodes that stand on its top, however far the edge is.
        if (sight%at(other) == 0 .or. .not. sight%seen(j)%is_kept) cycle
        if (.not. sight%seen(sight%at(other))%is_kept) cycle
      end if
      if (view%may_share) then
        if (touches(obstacle, other, node)) cycle
      end if
      call see(obstacle, other, x, u, node, view, .false., sight)
      f = motion_before(obstacle, e, s, node)
      call judge_edge(own, obstacle, node, e, j, sight%at(other), s, y, f, x, u, view, sight)
    end do
    if (sight%seen(j)%feature /= on_vertex) return
    do i = 1, j - 1
      if (sight%seen(i)%feature == on_vertex .and. &
          sight%seen(i)%which == sight%seen(j)%which) return
    end do
    f = zero
    associate (vertex => obstacle%vertex(sight%seen(j)%which))
      if (present(free)) f = free(:, node) - free(:, vertex)
    end associate
    call judge_vertex(own, obstacle, node, sight%seen(j)%which, f, x, u, view, sight)
  contains
    !> Of the node, relative to a place on an edge.
    pure function motion_before(obstacle, e, s, node) result(f)
      type(skin_t), intent(in) :: obstacle
      integer, intent(in) :: e, node
      real(wp), intent(in) :: s
      real(wp) :: f(3)
      f = zero
      if (.not. present(free)) return
      f = free(:, node) - (one - s)*free(:, obstacle%ends(1, e)) &
          - s*free(:, obstacle%ends(2, e))
    end function motion_before
  end subroutine look_around

  !> Has the facet this node?
  pure logical function touches(skin, facet, node)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: facet, node
    touches = any(skin%node(:skin%corners(facet), facet) == node)
  end function touches

  !> What an edge between facets i and j of the list changes. s, y: its closest point.
  subroutine judge_edge(own, obstacle, node, e, i, j, s, y, f, x, u, view, sight)
    type(skin_t), intent(in) :: own, obstacle
    integer, intent(in) :: node, e, i, j
    real(wp), intent(in) :: s, y(3), f(3)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    real(wp) :: t(3), turn, direction(3, 4)
    integer :: first, second
    logical :: before(2), both_at
    first = merge(i, j, obstacle%beside(1, e) == sight%seen(i)%facet)
    second = i + j - first
    t = from_node(x, u, obstacle%ends(1, e), obstacle%ends(2, e))
    t = t/max(norm2(t), tiny(one))
    associate (a => sight%seen(first), b => sight%seen(second))
      turn = dihedral(a%normal, b%normal, t)
      before = [a%is_before, b%is_before]
      if (all(before) .and. turn <= smooth_angle) return
      ! The node is beside the edge, not beyond one of its ends.
      both_at = is_at(obstacle, a, e) .and. is_at(obstacle, b, e) .and. &
          abs(dot_product(y, t)) <= end_tolerance*min(obstacle%size(a%facet), &
          obstacle%size(b%facet))
      if (turn < -smooth_angle) then
        if (.not. (any(before) .or. both_at)) return
        if (.not. a%is_kept .and. is_at(obstacle, a, e)) &
            a%is_kept = makes_row(obstacle, a, view, sight%fan)
        if (.not. b%is_kept .and. is_at(obstacle, b, e)) &
            b%is_kept = makes_row(obstacle, b, view, sight%fan)
      else if (turn <= smooth_angle) then
        if (any(before) .or. .not. both_at) return
        call add_smooth_place(obstacle, node, e, s, y, a%normal + b%normal, [a%facet, b%facet], &
            view, sight)
      else
        if (.not. (any(before) .or. both_at)) return
        direction = reshape([t, -t, cross(a%normal, t), cross(t, b%normal)], [3, 4])
        call judge_sharp_edge(own, obstacle, node, e, first, second, s, y, f, direction, view, &
            sight)
      end if
    end associate
  end subroutine judge_edge

  !> Is edge e of the net, or an end of it, where the closest point of a facet lies?
  pure logical function is_at(obstacle, seen, e)
    type(skin_t), intent(in) :: obstacle
    type(seen_t), intent(in) :: seen
    integer, intent(in) :: e
    is_at = seen%feature == on_edge .and. seen%which == e
    if (seen%feature == on_vertex) is_at = any(obstacle%ends(:, e) == &
        obstacle%vertex(seen%which))
  end function is_at

  !> A convex edge: inside both half-spaces the shallower facet holds; beyond both rims, or at the
  !> very rim of one, the edge.
  subroutine judge_sharp_edge(own, obstacle, node, e, first, second, s, y, f, direction, view, &
      sight)
    type(skin_t), intent(in) :: own, obstacle
    integer, intent(in) :: node, e, first, second
    real(wp), intent(in) :: s, y(3), f(3), direction(:, :)
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    real(wp) :: stays, shorter, normal(3, 2)
    integer :: held
    held = 0
    stays = zero
    associate (a => sight%seen(first), b => sight%seen(second))
      shorter = min(obstacle%size(a%facet), obstacle%size(b%facet))
      normal(:, 1) = a%normal
      normal(:, 2) = b%normal
      if (a%is_before .and. b%is_before) then
        if (.not. (a%is_kept .and. b%is_kept)) return
        held = merge(second, first, a%gap < b%gap)
        sight%seen(first + second - held)%is_kept = .false.
        if (abs(a%gap - b%gap) > 1.0e-7_wp*shorter) return
      else if (a%is_before .or. b%is_before) then
        held = merge(first, second, a%is_before)
        stays = narrow
        associate (h => sight%seen(held))
          if (norm2(h%y - y) > allowance_in_space(own, node, size_before(sight%fan, h%normal), &
              shorter)) return
        end associate
      end if
      call choose_at_feature(own, obstacle, node, [a%facet, b%facet], normal, direction, held, &
          stays, y, f, view, sight)
    end associate
    call finish_edge(obstacle, e, s, sight)
  end subroutine judge_sharp_edge

  !> A vertex that is the closest point of all facets round it.
  subroutine judge_vertex(own, obstacle, node, v, f, x, u, view, sight)
    type(skin_t), intent(in) :: own, obstacle
    integer, intent(in) :: node, v
    real(wp), intent(in) :: f(3)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    integer :: at(obstacle%first_facet(v + 1) - obstacle%first_facet(v)), i, m
    real(wp) :: y(3), mean(3)
    logical :: faces(size(at))
    m = size(at)
    do i = 1, m
      associate (facet => obstacle%facet(obstacle%first_facet(v) + i - 1))
        if (view%may_share) then
          if (touches(obstacle, facet, node)) return
        end if
        call see(obstacle, facet, x, u, node, view, .false., sight)
        at(i) = sight%at(facet)
      end associate
      associate (seen => sight%seen(at(i)))
        if (seen%is_before .or. seen%feature /= on_vertex) return
        if (seen%which /= v) return
        faces(i) = faces_fan(seen%normal, sight%fan, sine_of_facing)
      end associate
    end do
    y = from_node(x, u, node, obstacle%vertex(v))
    mean = zero
    do i = 1, m
      if (faces(i)) mean = mean + sight%seen(at(i))%normal
    end do
    if (count(faces) > 1) then
      if (all(matmul(mean/norm2(mean), normals(at)) > cos(smooth_angle) .or. .not. faces)) then
        call add_smooth_place(obstacle, node, 0, zero, y, mean, facets(pack(at, faces)), view, &
            sight)
        call finish_vertex(obstacle, v, sight)
        return
      end if
    end if
    if (any(obstacle%turn(obstacle%edge(obstacle%first_edge(v):obstacle%first_edge(v + 1) - 1)) &
        < -smooth_angle)) then
      do i = 1, m
        sight%seen(at(i))%is_kept = makes_row(obstacle, sight%seen(at(i)), view, sight%fan)
      end do
      return
    end if
    call open_fan(obstacle, obstacle%vertex(v), x, u, view%is_reference, sight%other)
    call choose_at_feature(own, obstacle, node, facets(at), normals(at), &
        sight%other%edge(:, :sight%other%edges), 0, zero, y, f, view, sight)
    call finish_vertex(obstacle, v, sight)
  contains
    pure function normals(at) result(n)
      integer, intent(in) :: at(:)
      real(wp) :: n(3, size(at))
      integer :: k
      do k = 1, size(at)
        n(:, k) = sight%seen(at(k))%normal
      end do
    end function normals
    pure function facets(at) result(list)
      integer, intent(in) :: at(:)
      integer :: list(size(at)), k
      do k = 1, size(at)
        list(k) = sight%seen(at(k))%facet
      end do
    end function facets
  end subroutine judge_vertex

  !> A place at a smooth edge or vertex, with the mean normal of its facets.
  pure subroutine add_smooth_place(obstacle, node, e, s, y, normal, facet, view, sight)
    type(skin_t), intent(in) :: obstacle
    integer, intent(in) :: node, e, facet(:)
    real(wp), intent(in) :: s, y(3), normal(3)
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    real(wp) :: n(3), length
    n = normal/norm2(normal)
    length = minval(obstacle%size(facet))
    if (.not. faces_fan(n, sight%fan, sine_of_facing)) return
    call add_shared_place(obstacle, node, facet, y, n, length, view, sight)
    if (e > 0) call finish_edge(obstacle, e, s, sight)
  end subroutine add_smooth_place

  !> A place that no facet has alone, yet without its points, if it is near enough.
  pure subroutine add_shared_place(obstacle, node, facet, y, n, length, view, sight)
    type(skin_t), intent(in) :: obstacle
    integer, intent(in) :: node, facet(:)
    real(wp), intent(in) :: y(3), n(3), length
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    real(wp) :: gap
    gap = -dot_product(n, y)
    if (gap > view%reach .or. gap <= -deepest*length) return
    if (.not. any(obstacle%is_listed(facet))) return
    sight%places = sight%places + 1
    sight%place(sight%places) = space_place_t(node=node, facet=facet(1), y=y, normal=n, &
        gap=gap, length=length, is_shared=.true.)
  end subroutine add_shared_place

  !> The points of the last place, which has none yet, on an edge.
  pure subroutine finish_edge(obstacle, e, s, sight)
    type(skin_t), intent(in) :: obstacle
    integer, intent(in) :: e
    real(wp), intent(in) :: s
    type(space_sight_t), intent(inout) :: sight
    if (sight%places == 0) return
    associate (p => sight%place(sight%places))
      if (p%points > 0) return
      p%key = -e
      if (s <= zero .or. s >= one) then
        p%points = 1
        p%point(1) = obstacle%ends(merge(1, 2, s <= zero), e)
        p%weight(1) = one
        p%key = -(obstacle%edges + obstacle%at(p%point(1)))
      else
        p%points = 2
        p%point(:2) = obstacle%ends(:, e)
        p%weight(:2) = [one - s, s]
      end if
    end associate
  end subroutine finish_edge

  !> The same on a vertex.
  pure subroutine finish_vertex(obstacle, v, sight)
    type(skin_t), intent(in) :: obstacle
    integer, intent(in) :: v
    type(space_sight_t), intent(inout) :: sight
    if (sight%places == 0) return
    associate (p => sight%place(sight%places))
      if (p%points > 0) return
      p%key = -(obstacle%edges + v)
      p%points = 1
      p%point(1) = obstacle%vertex(v)
      p%weight(1) = one
    end associate
  end subroutine finish_vertex

  !> The row of a convex feature of these facets. held: the facet, of those seen, whose row it
  !> would replace, 0 = none; that stays where the common normals spread less than `stays`: faces
  !> that lie on each other.
  subroutine choose_at_feature(own, obstacle, node, facet, normal, direction, held, stays, y, f, &
      view, sight)
    type(skin_t), intent(in) :: own, obstacle
    integer, intent(in) :: node, facet(:), held
    real(wp), intent(in) :: normal(:, :), direction(:, :), stays, y(3), f(3)
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    real(wp) :: common(3, most_normals), n(3), shorter, own_size
    integer :: m, k
    shorter = minval(obstacle%size(facet))
    call common_normals(normal, direction, sight%fan, common, m)
    if (m == 0) return
    if (held > 0) then
      if (sight%seen(held)%is_kept .and. spread_of(common(:, :m)) < stays) return
    end if
    own_size = size_before(sight%fan, normal(:, 1))
    if (.not. own_size > zero) own_size = shorter
    do k = 1, size(facet)
      if (any(sum(abs(common(:, :m) - spread(normal(:, k), 2, m)), dim=1) < 1.0e-9_wp)) cycle
      if (min(-dot_product(normal(:, k), y), dot_product(normal(:, k), f - y)) > &
          beside*min(shorter, own_size)) return
    end do
    call choose_of(common(:, :m), -y, f, allowance_in_space(own, node, own_size, shorter), &
        shorter, n)
    k = sight%places
    call add_shared_place(obstacle, node, facet, y, n, shorter, view, sight)
    if (sight%places > k .and. held > 0) sight%seen(held)%is_kept = .false.
  end subroutine choose_at_feature

  !> Of two facets between whose half-spaces the free space is the union, and that the node is
  !> before, the deeper one says nothing: each place lies behind the other facet.
  pure subroutine drop_hidden(obstacle, sight)
    type(skin_t), intent(in) :: obstacle
    type(space_sight_t), intent(inout) :: sight
    real(wp) :: least
    integer :: i, j
    do i = 1, sight%n
      do j = 1, i - 1
        associate (a => sight%seen(i), b => sight%seen(j))
          if (.not. (a%is_kept .and. b%is_kept .and. a%is_before .and. b%is_before)) cycle
          if (dot_product(a%normal, b%normal) > cos(smooth_angle)) cycle
          least = end_tolerance*min(obstacle%size(a%facet), obstacle%size(b%facet))
          if (min(a%gap, b%gap) >= -least) cycle
          if (dot_product(a%normal, b%y - a%y) >= zero) cycle
          if (dot_product(b%normal, a%y - b%y) >= zero) cycle
          if (a%gap < b%gap) then
            a%is_kept = .false.
          else
            b%is_kept = .false.
          end if
        end associate
      end do
    end do
  end subroutine drop_hidden

  pure subroutine add_facet_place(obstacle, node, seen, sight)
    type(skin_t), intent(in) :: obstacle
    integer, intent(in) :: node
    type(seen_t), intent(in) :: seen
    type(space_sight_t), intent(inout) :: sight
    integer :: k
    sight%places = sight%places + 1
    associate (p => sight%place(sight%places))
      p = space_place_t(node=node, facet=seen%facet, key=seen%facet, y=seen%y, &
          normal=seen%normal, gap=seen%gap, length=obstacle%size(seen%facet))
      do k = 1, obstacle%corners(seen%facet)
        if (.not. abs(seen%weight(k)) > zero) cycle
        p%points = p%points + 1
        p%point(p%points) = obstacle%node(k, seen%facet)
        p%weight(p%points) = seen%weight(k)
      end do
      if (seen%feature == on_edge) p%key = -seen%which
      if (seen%feature == on_vertex) p%key = -(obstacle%edges + seen%which)
    end associate
  end subroutine add_facet_place

  !> The nearest first; of two whose normals are nearly the same the nearer, and of facets that
  !> are as near, at an edge or vertex of both, that with the mean normal.
  pure subroutine merge_places(sight)
    type(space_sight_t), intent(inout) :: sight
    type(space_place_t) :: p
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
        call meet(p, sight%place(j))
      end do
      if (.not. is_new) cycle
      kept = kept + 1
      sight%place(kept) = p
      sight%place(kept)%is_second = kept > 1
    end do
    sight%places = kept
  end subroutine merge_places

  pure logical function comes_before(p, q)
    type(space_place_t), intent(in) :: p, q
    comes_before = abs(p%gap) < abs(q%gap)
    if (.not. comes_before .and. .not. abs(p%gap) > abs(q%gap)) comes_before = p%facet < q%facet
  end function comes_before

  !> Two facets that have one feature, as near as each other: q takes the mean normal.
  pure subroutine meet(p, q)
    type(space_place_t), intent(in) :: p
    type(space_place_t), intent(inout) :: q
    real(wp) :: n(3)
    if (p%key >= 0 .or. p%key /= q%key) return
    if (abs(abs(p%gap) - abs(q%gap)) > 1.0e-9_wp*min(p%length, q%length)) return
    q%is_shared = .true.
    q%length = min(p%length, q%length)
    if (sum(abs(p%normal - q%normal)) < 1.0e-12_wp) return
    n = p%normal + q%normal
    q%normal = n/norm2(n)
    q%gap = -dot_product(q%normal, q%y)
  end subroutine meet

  !> Mean size of a node's own facets that face a normal (none: of all) [L]; 0 for a lone node,
  !> which is finer than any facet.
  pure real(wp) function size_before(fan, normal) result(mean)
    type(fan_t), intent(in) :: fan
    real(wp), intent(in) :: normal(3)
    real(wp), parameter :: facing_cosine = -0.7_wp
    integer :: k, n
    mean = zero
    if (fan%is_all) return
    n = 0
    do k = 1, fan%facets
      if (dot_product(normal, fan%normal(:, k)) >= facing_cosine) cycle
      n = n + 1
      mean = mean + fan%size(k)
    end do
    if (n == 0) mean = sum(fan%size(:fan%facets))
    mean = mean/merge(n, fan%facets, n > 0)
  end function size_before

  !> What a node without an exact row may go below zero [L]: a small share of the smaller facet
  !> at hand.
  pure real(wp) function allowance_in_space(own, node, own_size, length) result(allowance)
    type(skin_t), intent(in) :: own
    integer, intent(in) :: node
    real(wp), intent(in) :: own_size, length
    logical :: is_corner
    is_corner = .false.
    if (own%at(node) > 0) is_corner = own%is_corner(own%at(node))
    allowance = length
    if (own_size > zero) allowance = min(own_size, length)
    allowance = allowance*merge(share_at_corner, share_of_edge, is_corner)
  end function allowance_in_space

end module contact_space_places
