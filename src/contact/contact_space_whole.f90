! SPDX-License-Identifier: BSD-3-Clause
!> True overlap of whole bodies in space: all nodes of one boundary against the facets of the
!> other, all edges that go through them, and sharp edges that have passed each other.
module contact_space_whole
  use base_kinds, only: wp, zero, one, half
  use contact_fan, only: fan_t
  use contact_pairing, only: overlap_t, note_overlap
  use contact_pierce, only: pierce
  use contact_sight, only: seen_t, place_of_node, area_vector
  use contact_skin, only: skin_t
  use contact_space_gap, only: gap_of_nearest
  use contact_space_tree, only: space_tree_t, items_in_box, nearest_facet
  use contact_surface, only: surface_t
  implicit none
  private
  public :: deepest_node_in_space, deepest_edge_in_space, deepest_inside, edge_inside

contains

  !> Gap of a place (3, 2) before the whole of a net [L], but for what is left out, and the
  !> nearest facet; huge and 0 where there is none.
  pure subroutine whole_gap(skin, tree, x, u, from, left_out, fan, gap, facet)
    type(skin_t), intent(in) :: skin
    type(space_tree_t), intent(in) :: tree
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(in) :: from(3, 2)
    logical, intent(in) :: left_out(:)
    type(fan_t), intent(inout) :: fan
    real(wp), intent(out) :: gap
    integer, intent(out) :: facet
    type(seen_t) :: nearest
    call nearest_facet(tree, skin, x, u, from, left_out, nearest)
    gap = huge(one)
    if (nearest%facet > 0) call gap_of_nearest(skin, x, u, from, nearest, fan, gap)
    facet = nearest%facet
  end subroutine whole_gap

  !> Facets of a body, and of parts that a part does not touch.
  pure subroutine leave_out_in_space(skin, facet, leaves_out, left_out)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: facet
    logical, intent(in) :: leaves_out(:, :)
    logical, intent(out) :: left_out(:)
    left_out = skin%body == skin%body(facet)
    if (size(leaves_out) > 0) left_out = left_out .or. &
        leaves_out(skin%part(facet), skin%part)
  end subroutine leave_out_in_space

  !> The deepest node of `own` inside the closed obstacle at X + U. is_self: both are one
  !> surface of several bodies; each node asks for the others.
  subroutine deepest_node_in_space(own, own_skin, skin, tree, x, u, is_self, leaves_out, fan, &
      overlap)
    type(surface_t), intent(in) :: own
    type(skin_t), intent(in) :: own_skin, skin
    type(space_tree_t), intent(in) :: tree
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    logical, intent(in) :: is_self, leaves_out(:, :)
    type(fan_t), intent(inout) :: fan
    type(overlap_t), intent(inout) :: overlap
    logical :: left_out(skin%facets)
    real(wp) :: p(3), gap
    integer :: k, facet, own_facet, last
    if (tree%boxes%n == 0) return
    left_out = .false.
    last = 0
    do k = 1, size(own%node)
      p = x(:, own%node(k)) + u(:, own%node(k))
      if (any(p < tree%boxes%low(:, 1) .or. p > tree%boxes%high(:, 1))) cycle
      associate (v => own_skin%at(own%node(k)))
        if (is_self) then
          if (v == 0) cycle
          own_facet = own_skin%facet(own_skin%first_facet(v))
          if (last == 0 .or. own_facet /= last) &
              call leave_out_in_space(skin, own_facet, leaves_out, left_out)
          last = own_facet
        else if (skin%at(own%node(k)) > 0) then
          cycle
        end if
        call whole_gap(skin, tree, x, u, place_of_node(x, u, own%node(k)), left_out, fan, gap, &
            facet)
        if (.not. gap < zero) cycle
        call note_overlap(overlap, -gap, min(skin%size(facet), own_length(own_skin, v)), &
            own%node(k), skin%part_id(facet), .false.)
      end associate
    end do
  end subroutine deepest_node_in_space

  !> The shortest edge at a vertex [L]; huge for a lone node.
  pure real(wp) function own_length(skin, v)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: v
    own_length = huge(one)
    if (v > 0) own_length = skin%shortest(v)
  end function own_length

  !> Bodies whose faces lie in the same planes may overlap though no node is inside and no edge
  !> goes through a face: places just inside every facet of `own` are asked too, in the middle,
  !> half way to each corner and near it.
  subroutine deepest_inside(own, skin, tree, x, u, is_self, leaves_out, fan, overlap)
    type(skin_t), intent(in) :: own, skin
    type(space_tree_t), intent(in) :: tree
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    logical, intent(in) :: is_self, leaves_out(:, :)
    type(fan_t), intent(inout) :: fan
    type(overlap_t), intent(inout) :: overlap
    real(wp), parameter :: share(3) = [zero, half, 0.95_wp]
    logical :: left_out(skin%facets)
    real(wp) :: middle(3), corner(3)
    integer :: k, i, j
    if (tree%boxes%n == 0) return
    left_out = .false.
    do k = 1, own%facets
      if (.not. own%is_listed(k)) cycle
      if (is_self) call leave_out_in_space(skin, k, leaves_out, left_out)
      middle = zero
      do j = 1, own%corners(k)
        middle = middle + (x(:, own%node(j, k)) + u(:, own%node(j, k)))/own%corners(k)
      end do
      do i = 1, size(share)
        do j = 1, merge(own%corners(k), 1, i > 1)
          corner = x(:, own%node(j, k)) + u(:, own%node(j, k))
          call place_inside(own, k, skin, tree, x, u, middle + share(i)*(corner - middle), &
              left_out, fan, overlap)
        end do
      end do
    end do
  end subroutine deepest_inside

  !> Is the place just behind a point p of facet k of `own` inside the obstacle?
  subroutine place_inside(own, k, skin, tree, x, u, p, left_out, fan, overlap)
    type(skin_t), intent(in) :: own, skin
    integer, intent(in) :: k
    type(space_tree_t), intent(in) :: tree
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(in) :: p(3)
    logical, intent(in) :: left_out(:)
    type(fan_t), intent(inout) :: fan
    type(overlap_t), intent(inout) :: overlap
    real(wp), parameter :: inward = 1.0e-3_wp
    real(wp) :: from(3, 2), n(3), gap
    integer :: facet
    n = area_vector(own, k, x, u)
    from(:, 1) = p - inward*own%size(k)*n/max(norm2(n), tiny(one))
    from(:, 2) = zero
    if (any(from(:, 1) < tree%boxes%low(:, 1) .or. from(:, 1) > tree%boxes%high(:, 1))) return
    call whole_gap(skin, tree, x, u, from, left_out, fan, gap, facet)
    if (gap < zero) call note_overlap(overlap, inward*own%size(k) - gap, &
        min(own%size(k), skin%size(facet)), own%node(1, k), skin%part_id(facet), .false.)
  end subroutine place_inside

  !> The deepest place of an edge of `own` between two points where it goes through the boundary
  !> of the closed obstacle.
  subroutine deepest_edge_in_space(own, skin, tree, x, u, is_self, leaves_out, fan, overlap)
    type(skin_t), intent(in) :: own, skin
    type(space_tree_t), intent(in) :: tree
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    logical, intent(in) :: is_self, leaves_out(:, :)
    type(fan_t), intent(inout) :: fan
    type(overlap_t), intent(inout) :: overlap
    logical :: left_out(skin%facets)
    integer :: e
    left_out = .false.
    do e = 1, own%edges
      if (.not. own%is_listed(own%beside(1, e))) cycle
      if (is_self) call leave_out_in_space(skin, own%beside(1, e), leaves_out, left_out)
      call edge_inside(own, e, skin, tree, x, u, left_out, fan, overlap)
    end do
  end subroutine deepest_edge_in_space

  !> The same of one edge.
  subroutine edge_inside(own, e, skin, tree, x, u, left_out, fan, overlap)
    type(skin_t), intent(in) :: own, skin
    integer, intent(in) :: e
    type(space_tree_t), intent(in) :: tree
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    logical, intent(in) :: left_out(:)
    type(fan_t), intent(inout) :: fan
    type(overlap_t), intent(inout) :: overlap
    integer :: list(size(tree%skin_item)), n, i, facet
    real(wp) :: a(3), d(3), low, high, gap
    a = x(:, own%ends(1, e)) + u(:, own%ends(1, e))
    d = (x(:, own%ends(2, e)) + u(:, own%ends(2, e))) - a
    call items_in_box(tree, min(a, a + d), max(a, a + d), list, n)
    low = one
    high = zero
    do i = 1, n
      if (left_out(list(i))) cycle
      if (any(skin%node(:, list(i)) == own%ends(1, e)) .or. &
          any(skin%node(:, list(i)) == own%ends(2, e))) cycle
      call pierce(skin, list(i), x, u, a, d, low, high)
    end do
    if (high <= low) return
    call deepest_between(skin, tree, x, u, a, d, left_out, low, high, fan, gap, facet)
    if (gap < zero) call note_overlap(overlap, -gap, min(skin%size(facet), norm2(d)), &
        own%ends(1, e), skin%part_id(facet), .true.)
  end subroutine edge_inside

  !> The distance from the boundary along a + t d is concave between two places where it is
  !> zero, if the obstacle is convex there: its largest value by thirds.
  subroutine deepest_between(skin, tree, x, u, a, d, left_out, low, high, fan, gap, facet)
    type(skin_t), intent(in) :: skin
    type(space_tree_t), intent(in) :: tree
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(in) :: a(3), d(3)
    logical, intent(in) :: left_out(:)
    real(wp), intent(inout) :: low, high
    type(fan_t), intent(inout) :: fan
    real(wp), intent(out) :: gap
    integer, intent(out) :: facet
    integer, parameter :: rounds = 12
    real(wp) :: from(3, 2), g(2), third
    integer :: k
    from = zero
    do k = 1, rounds
      third = (high - low)/3.0_wp
      from(:, 1) = a + (low + third)*d
      call whole_gap(skin, tree, x, u, from, left_out, fan, g(1), facet)
      from(:, 1) = a + (high - third)*d
      call whole_gap(skin, tree, x, u, from, left_out, fan, g(2), facet)
      if (g(1) < g(2)) then
        high = high - third
      else
        low = low + third
      end if
    end do
    from(:, 1) = a + half*(low + high)*d
    call whole_gap(skin, tree, x, u, from, left_out, fan, gap, facet)
  end subroutine deepest_between

end module contact_space_whole
