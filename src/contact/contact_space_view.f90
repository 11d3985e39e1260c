! SPDX-License-Identifier: BSD-3-Clause
!> What makes a place in space: the facets that a node sees of an obstacle, and the places
!> found so far for it.
module contact_space_view
  use base_kinds, only: wp, zero, one
  use contact_fan, only: fan_t, size_fan, faces_fan
  use contact_features, only: facing_angle
  use contact_places, only: view_t, deepest, share_of_edge, share_at_corner
  use contact_sight, only: seen_t, see_facet, place_of_node, on_edge, on_vertex
  use contact_skin, only: skin_t
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
    integer :: n_round = 0                 !< facets round a vertex, and their normals
    integer, allocatable :: round(:)
    real(wp), allocatable :: normal(:, :)
    type(space_place_t), allocatable :: place(:)
    integer :: places = 0
  end type space_sight_t

  real(wp), parameter, public :: sine_of_facing = sin(facing_angle)

  public :: size_space_sight, see, makes_row, touches, add_shared_place, finish_edge, &
      finish_vertex, add_facet_place, size_before, allowance_in_space

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
      deallocate (sight%at, sight%seen, sight%place, sight%round, sight%normal)
    end if
    allocate (sight%round(most_round), sight%normal(3, most_round))
    allocate (sight%at(max(own%facets, obstacle%facets)), sight%seen(m), sight%place(m))
    sight%at = 0
  end subroutine size_space_sight

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

  !> Has the facet this node?
  pure logical function touches(skin, facet, node)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: facet, node
    touches = any(skin%node(:skin%corners(facet), facet) == node)
  end function touches

  !> A place that no facet has alone, yet without its points, if it is near enough.
  pure subroutine add_shared_place(obstacle, node, facet, y, n, length, view, sight)
    type(skin_t), intent(in) :: obstacle
    integer, intent(in) :: node, facet(:)
    real(wp), intent(in) :: y(3), n(3), length
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    real(wp) :: gap
    logical :: is_listed
    integer :: k
    gap = -dot_product(n, y)
    if (gap > view%reach .or. gap <= -deepest*length) return
    is_listed = .false.
    do k = 1, size(facet)
      is_listed = is_listed .or. obstacle%is_listed(facet(k))
    end do
    if (.not. is_listed) return
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

  !> The place of a facet that the node stands before, or that a notch has clamped.
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

end module contact_space_view
