! SPDX-License-Identifier: BSD-3-Clause
!> Sharp edges that cross: what nodes miss. Of random encounters of cubes half begin so. The
!> row of a pair has weights 1 - s, s, -(1 - t), -t at the points that are nearest to each
!> other, and the normal e_A x e_B, out of the obstacle. It stands where both points are inside
!> their edges and the arc of normals of the one edge crosses that of the other, reversed.
module contact_space_edges
  use base_archive, only: archive_t, archive_restore
  use base_kinds, only: wp, zero, one
  use base_sort, only: sort_order
  use contact_pierce, only: pierces_edge
  use contact_places, only: share_of_edge
  use contact_sight, only: from_node, area_vector
  use contact_skin, only: skin_t
  use contact_space_tree, only: space_tree_t, items_in_box
  use linalg_dense, only: cross
  implicit none
  private

  !> Pairs of edges that are near, by the contactor's edge, then the obstacle's.
  type, public :: edge_pairs_t
    integer :: n = 0
    integer, allocatable :: a(:), b(:)
  end type edge_pairs_t

  !> A pair where it is now.
  type, public :: crossing_t
    integer :: point(4) = 0
    real(wp) :: weight(4) = zero
    real(wp) :: normal(3) = zero
    real(wp) :: gap = zero             !< [L]
    real(wp) :: length = zero          !< the shorter edge [L]
    real(wp) :: allowance = zero       !< what it may go below zero [L]
    logical :: is_valid = .false.      !< it stands between the bodies
  end type crossing_t

  real(wp), parameter :: inside = 1.0e-8_wp     !< shares of an edge
  real(wp), parameter :: parallel = 1.0e-6_wp   !< squared sine
  !> Radians by which the arcs cross. Where they do so by less, or miss each other by less than
  !> the second, one body lies with a face on the other: nodes see most of that, and the
  !> crossing has their allowance.
  real(wp), parameter :: clear = 1.0e-3_wp, missed = 2.0e-2_wp
  !> Shares of an edge: a deeper one is not before it.
  real(wp), parameter :: deepest = 0.1_wp

  !> Shares of an edge: a shallower one goes through the body.
  real(wp), parameter :: sure = 1.0e-6_wp

  public :: list_edge_pairs, cross_edges, exchange_edge_pairs

contains

  !> The pairs of sharp edges nearer than reach [L], of edges in the tree of the own net and
  !> that of the obstacle, both at X + U. is_self: both are one net; edges that share a node or
  !> a facet are no pair. leaves_out (parts, parts): pairs of parts that do not touch; or
  !> empty.
  subroutine list_edge_pairs(own, obstacle, own_tree, tree, reach, is_self, leaves_out, pairs)
    type(skin_t), intent(in) :: own, obstacle
    type(space_tree_t), intent(in) :: own_tree, tree
    real(wp), intent(in) :: reach
    logical, intent(in) :: is_self, leaves_out(:, :)
    type(edge_pairs_t), intent(inout) :: pairs
    integer :: found(size(tree%skin_item)), k, i, n
    pairs%n = 0
    if (.not. allocated(pairs%a)) allocate (pairs%a(64), pairs%b(64))
    do k = 1, size(own_tree%skin_item)
      call items_in_box(tree, own_tree%low(:, k) - reach, own_tree%high(:, k) + reach, found, n)
      do i = 1, n
        if (is_self) then
          if (found(i) <= own_tree%skin_item(k)) cycle
          if (are_joined(own, own_tree%skin_item(k), found(i))) cycle
        else if (any(obstacle%ends(1, found(i)) == own%ends(:, own_tree%skin_item(k))) .or. &
            any(obstacle%ends(2, found(i)) == own%ends(:, own_tree%skin_item(k)))) then
          cycle
        end if
        if (size(leaves_out) > 0) then
          if (leaves_out(own%part(own%beside(1, own_tree%skin_item(k))), &
              obstacle%part(obstacle%beside(1, found(i))))) cycle
        end if
        call add_pair(own_tree%skin_item(k), found(i), pairs)
      end do
    end do
    call sort_pairs(own, pairs)
  end subroutine list_edge_pairs

  !> By the first node of the own edge, as rows are; then by the obstacle's edge.
  pure subroutine sort_pairs(own, pairs)
    type(skin_t), intent(in) :: own
    type(edge_pairs_t), intent(inout) :: pairs
    integer :: order(pairs%n), n
    n = pairs%n
    call sort_order(pairs%b(:n), order)
    pairs%a(:n) = pairs%a(order)
    pairs%b(:n) = pairs%b(order)
    call sort_order(own%ends(1, pairs%a(:n)), order)
    pairs%a(:n) = pairs%a(order)
    pairs%b(:n) = pairs%b(order)
  end subroutine sort_pairs

  pure subroutine add_pair(a, b, pairs)
    integer, intent(in) :: a, b
    type(edge_pairs_t), intent(inout) :: pairs
    integer, allocatable :: longer(:)
    if (pairs%n == size(pairs%a)) then
      allocate (longer(2*pairs%n))
      longer(:pairs%n) = pairs%a
      call move_alloc(longer, pairs%a)
      allocate (longer(2*pairs%n))
      longer(:pairs%n) = pairs%b
      call move_alloc(longer, pairs%b)
    end if
    pairs%n = pairs%n + 1
    pairs%a(pairs%n) = a
    pairs%b(pairs%n) = b
  end subroutine add_pair

  !> Do two edges of a net share a node, or does some facet hold both?
  pure logical function are_joined(skin, a, b)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: a, b
    integer :: i, j
    are_joined = any(skin%ends(1, a) == skin%ends(:, b)) .or. &
        any(skin%ends(2, a) == skin%ends(:, b))
    do i = 1, 2
      do j = 1, 2
        are_joined = are_joined .or. skin%beside(i, a) == skin%beside(j, b)
      end do
    end do
  end function are_joined

  !> Edge a of the own net before edge b of the obstacle at X + U; is_reference: with the normal
  !> of X.
  pure subroutine cross_edges(own, obstacle, a, b, x, u, is_reference, crossing)
    type(skin_t), intent(in) :: own, obstacle
    integer, intent(in) :: a, b
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    logical, intent(in) :: is_reference
    type(crossing_t), intent(out) :: crossing
    real(wp) :: ea(3), eb(3), d(3), n(3), sine_2, s, t, length(2), within
    ea = from_node(x, u, own%ends(1, a), own%ends(2, a))
    eb = from_node(x, u, obstacle%ends(1, b), obstacle%ends(2, b))
    n = cross(ea, eb)
    length = [norm2(ea), norm2(eb)]
    sine_2 = sum(n**2)
    if (sine_2 <= parallel*product(length)**2) return
    d = from_node(x, u, own%ends(1, a), obstacle%ends(1, b))
    s = dot_product(cross(d, eb), n)/sine_2
    t = dot_product(cross(d, ea), n)/sine_2
    if (min(s, t, one - s, one - t) <= inside) return
    if (is_reference) n = cross(x(:, own%ends(2, a)) - x(:, own%ends(1, a)), &
        x(:, obstacle%ends(2, b)) - x(:, obstacle%ends(1, b)))
    n = n/norm2(n)
    n = sign(one, side_of(obstacle, b, n, x, u))*n
    within = min(in_arc(obstacle, b, n, eb/length(2), x, u), &
        in_arc(own, a, -n, ea/length(1), x, u))
    if (within <= -missed) return
    crossing%point = [own%ends(:, a), obstacle%ends(:, b)]
    crossing%weight = [one - s, s, t - one, -t]
    crossing%normal = n
    crossing%gap = -dot_product(n, d + t*eb - s*ea)
    crossing%length = minval(length)
    if (within <= clear) crossing%allowance = share_of_edge*crossing%length
    crossing%is_valid = crossing%gap > -deepest*crossing%length
    ! One edge is behind the other in the direction of n; it may have gone past the body there.
    if (crossing%is_valid .and. crossing%gap < -sure*crossing%length) crossing%is_valid = &
        pierces_edge(own, a, obstacle, b, x, u) .or. pierces_edge(obstacle, b, own, a, x, u)
  end subroutine cross_edges

  !> Which way a direction points out of the body at an edge.
  pure real(wp) function side_of(skin, e, n, x, u)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: e
    real(wp), intent(in) :: n(3)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    side_of = dot_product(n, area_vector(skin, skin%beside(1, e), x, u) &
        /skin%size(skin%beside(1, e))**2 + area_vector(skin, skin%beside(2, e), x, u) &
        /skin%size(skin%beside(2, e))**2)
  end function side_of

  !> How far n is inside the arc from the normal of the first facet of an edge along t to the
  !> second: the smaller sine.
  pure real(wp) function in_arc(skin, e, n, t, x, u)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: e
    real(wp), intent(in) :: n(3), t(3)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp) :: a(3), b(3)
    a = area_vector(skin, skin%beside(1, e), x, u)
    b = area_vector(skin, skin%beside(2, e), x, u)
    in_arc = min(dot_product(cross(a, n), t)/norm2(a), dot_product(cross(n, b), t)/norm2(b))
  end function in_arc

  !> Saves the list to the archive or restores it.
  subroutine exchange_edge_pairs(archive, pairs)
    type(archive_t), intent(inout) :: archive
    type(edge_pairs_t), intent(inout) :: pairs
    call archive%exchange('edge_pairs.n', pairs%n)
    if (pairs%n == 0) return
    if (archive%mode == archive_restore) then
      if (allocated(pairs%a)) deallocate (pairs%a, pairs%b)
      allocate (pairs%a(pairs%n), pairs%b(pairs%n))
    end if
    call archive%exchange('edge_pairs.a', pairs%a(:pairs%n))
    call archive%exchange('edge_pairs.b', pairs%b(:pairs%n))
  end subroutine exchange_edge_pairs

end module contact_space_edges
