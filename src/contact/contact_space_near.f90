! SPDX-License-Identifier: BSD-3-Clause
!> Verlet lists in space: which facets of an obstacle each node of a side may meet soon, and
!> which nodes of the model the rows on them may involve.
module contact_space_near
  use base_kinds, only: wp, one
  use contact_fan, only: fan_t, open_fan, faces_fan
  use contact_features, only: degree
  use contact_near, only: near_t, start_list, add_node, keep_memory, listing_angle
  use contact_sight, only: seen_t, see_facet, place_of_node, distance_2
  use contact_skin, only: skin_t
  use contact_space_edges, only: edge_pairs_t
  use contact_space_tree, only: space_tree_t, items_in_box
  use contact_surface, only: surface_t
  implicit none
  private
  public :: list_near_in_space, mark_near_in_space, mark_pairs

  !> Beyond an edge that is sharper than this no place is added to those of its facet.
  real(wp), parameter :: blunt = 60.0_wp*degree

contains

  !> Lists for every node of a side the facets of the obstacle that are nearer than reach [L]
  !> and may come to face it.
  subroutine list_near_in_space(own, own_skin, skin, tree, x, u, reach, may_share, leaves_out, &
      fan, near)
    type(surface_t), intent(in) :: own
    type(skin_t), intent(in) :: own_skin, skin
    type(space_tree_t), intent(in) :: tree
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(in) :: reach
    logical, intent(in) :: may_share, leaves_out(:, :)
    type(fan_t), intent(inout) :: fan
    type(near_t), intent(inout) :: near
    type(near_t) :: old
    type(seen_t) :: seen
    integer :: found(size(tree%skin_item)), k, n, m, i
    real(wp) :: p(3)
    old = near
    call start_list(size(own%node), near)
    do k = 1, size(own%node)
      associate (node => own%node(k))
        p = x(:, node) + u(:, node)
        call items_in_box(tree, p - reach, p + reach, found, n)
        if (n == 0) cycle
        call open_fan(own_skin, node, x, u, .false., fan)
        m = 0
        do i = 1, n
          if (is_left_out(own_skin, skin, node, found(i), may_share, leaves_out)) cycle
          call see_facet(skin, found(i), x, u, place_of_node(x, u, node), .false., seen)
          if (distance_2(seen) > reach**2) cycle
          if (.not. faces_fan(seen%normal, fan, sin(listing_angle))) cycle
          m = m + 1
          found(m) = found(i)
        end do
        if (m > 0) call add_node(k, found(:m), near)
      end associate
    end do
    call keep_memory(old, near)
  end subroutine list_near_in_space

  !> Facets of parts that the part of a node does not touch; where a node may belong to both
  !> sides, those that have a node of one of its own facets.
  pure logical function is_left_out(own, skin, node, facet, may_share, leaves_out)
    type(skin_t), intent(in) :: own, skin
    integer, intent(in) :: node, facet
    logical, intent(in) :: may_share, leaves_out(:, :)
    integer :: i, j
    is_left_out = .false.
    if (own%at(node) == 0) return
    associate (first => own%first_facet(own%at(node)), &
        last => own%first_facet(own%at(node) + 1) - 1)
      if (size(leaves_out) > 0) is_left_out = &
          leaves_out(own%part(own%facet(first)), skin%part(facet))
      if (.not. may_share .or. is_left_out) return
      do i = first, last
        do j = 1, own%corners(own%facet(i))
          is_left_out = is_left_out .or. any(skin%node(:skin%corners(facet), facet) == &
              own%node(j, own%facet(i)))
        end do
      end do
    end associate
  end function is_left_out

  !> Marks near nodes of a side and the nodes of their facets with one more facet beyond each
  !> edge that is not sharp, so that sliding does not outgrow the interface at once. All other
  !> nodes of facets next to these are carried along with one that they share an edge or a
  !> facet with.
  pure subroutine mark_near_in_space(own, own_skin, skin, near, taken, carrier)
    type(surface_t), intent(in) :: own
    type(skin_t), intent(in) :: own_skin, skin
    type(near_t), intent(in) :: near
    logical, intent(inout) :: taken(:)
    integer, intent(inout) :: carrier(:)
    integer :: i, j, k, e, other
    do i = 1, near%n
      taken(own%node(near%node(i))) = .true.
      call carry_round(own_skin, own%node(near%node(i)), carrier)
      do j = near%first(i), near%first(i + 1) - 1
        associate (f => near%edge(j))
          do k = 1, skin%corners(f)
            taken(skin%node(k, f)) = .true.
            call carry_round(skin, skin%node(k, f), carrier)
            e = skin%edge_of(k, f)
            other = sum(skin%beside(:, e)) - f
            if (other == 0 .or. skin%turn(e) > blunt) cycle
            taken(skin%node(:skin%corners(other), other)) = .true.
          end do
        end associate
      end do
    end do
  end subroutine mark_near_in_space

  !> The nodes of the facets round a node go along with it; where one of the edges there is
  !> reflex, they may all have rows and nothing is carried.
  pure subroutine carry_round(skin, node, carrier)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: node
    integer, intent(inout) :: carrier(:)
    integer :: i, v
    v = skin%at(node)
    if (v == 0) return
    do i = skin%first_facet(v), skin%first_facet(v + 1) - 1
      associate (f => skin%facet(i))
        carrier(skin%node(:skin%corners(f), f)) = node
      end associate
    end do
  end subroutine carry_round

  !> Marks the ends of pairs of edges; what stands round them is carried along.
  pure subroutine mark_pairs(own, skin, pairs, taken, carrier)
    type(skin_t), intent(in) :: own, skin
    type(edge_pairs_t), intent(in) :: pairs
    logical, intent(inout) :: taken(:)
    integer, intent(inout) :: carrier(:)
    integer :: k, s
    do k = 1, pairs%n
      taken(own%ends(:, pairs%a(k))) = .true.
      taken(skin%ends(:, pairs%b(k))) = .true.
      do s = 1, 2
        call carry_round(own, own%ends(s, pairs%a(k)), carrier)
        call carry_round(skin, skin%ends(s, pairs%b(k)), carrier)
      end do
    end do
  end subroutine mark_pairs

end module contact_space_near
