! SPDX-License-Identifier: BSD-3-Clause
!> Which places get exact rows (gap >= 0) and which an allowance (gap >= -delta, a row only
!> when the solved step goes below). Two exact rows that say nearly the same make W singular:
!> locally the finer side is exact, and of two nodes that meet each other one.
module contact_grade
  use base_kinds, only: wp, zero, one
  use contact_features, only: cone_of_node_t, smooth_angle, degree
  use contact_places, only: place_t, corner
  use contact_surface, only: surface_t
  implicit none
  private
  public :: grade_place, settle_twins, points_of_place

  integer, parameter, public :: finer_auto = 0, finer_both = 3   !< 1, 2: that side
  !> Faces that lie on each other are kept apart by multipliers, not by their nodes.
  integer, parameter, public :: finer_none = 4

  real(wp), parameter, public :: equal_size = 1.0e-6_wp
  !> A face that lies on another: 3 degrees.
  real(wp), parameter, public :: cosine_of_flat = cos(3.0_wp*degree)
  real(wp), parameter :: cosine_of_smooth = cos(smooth_angle)
  real(wp), parameter, public :: twin = 0.1_wp             !< edges: a node that meets a node
  real(wp), parameter, public :: sharper = 1.0_wp*degree
  !> What a node between faces that multipliers keep apart may sink, / shorter edge: half of
  !> what is warned of. A chord is that deep in a circle where it turns by 2.3 degrees.
  real(wp), parameter :: share_between = 5.0e-3_wp

contains

  !> Grade and allowance of a place of row k of the nodes of `own`. finer: the side whose
  !> nodes are exact, by the deck (finer_auto: by their sizes).
  pure subroutine grade_place(own, obstacle, k, finer, cone, place)
    type(surface_t), intent(in) :: own, obstacle
    integer, intent(in) :: k, finer
    type(cone_of_node_t), intent(in) :: cone
    type(place_t), intent(inout) :: place
    if (finer == finer_both .or. .not. place%own_size > zero) then
      place%is_exact = .true.
    else if (finer == finer_none) then
      call grade_between_faces(own, k, cone, place)
      return
    else if (finer /= finer_auto) then
      place%is_exact = place%side == finer
    else if (abs(place%own_size - place%length) <= equal_size*place%length) then
      place%is_exact = wins_tie(own, obstacle, k, place)
    else
      place%is_exact = place%own_size < place%length
    end if
    if (place%is_exact .or. .not. own%turn(k) > corner) return
    place%is_exact = .not. lies_flat(own, k, place, cone)
  end subroutine grade_place

  !> A corner is exact unless one of its faces lies on the edge, as multipliers see it; there,
  !> and of all other nodes, they have the gap, and the node an allowance.
  pure subroutine grade_between_faces(own, k, cone, place)
    type(surface_t), intent(in) :: own
    integer, intent(in) :: k
    type(cone_of_node_t), intent(in) :: cone
    type(place_t), intent(inout) :: place
    integer :: s
    logical :: lies_on
    lies_on = .false.
    do s = 1, 2
      lies_on = lies_on .or. &
          -dot_product(cone%normal(:, s), place%normal) >= cosine_of_smooth
    end do
    place%is_exact = own%turn(k) > corner .and. .not. lies_on
    if (lies_on) place%allowance = share_between*min(place%own_size, place%length)
  end subroutine grade_between_faces

  !> Of equal sizes SURFA is exact; within one surface the part of lower id; within one part
  !> both, so that the numbers of nodes decide nothing.
  pure logical function wins_tie(own, obstacle, k, place)
    type(surface_t), intent(in) :: own, obstacle
    integer, intent(in) :: k
    type(place_t), intent(in) :: place
    wins_tie = place%side == 1
    if (.not. wins_tie) return
    if (size(own%node) /= size(obstacle%node)) return
    if (any(own%node /= obstacle%node)) return
    wins_tie = own%part_id(maxval(own%node_edge(:, k))) <= obstacle%part_id(place%edge)
  end function wins_tie

  !> A corner whose own face lies on the edge, no shorter than the edge: the finer nodes of
  !> the other side stand within reach of it.
  pure logical function lies_flat(own, k, place, cone)
    type(surface_t), intent(in) :: own
    integer, intent(in) :: k
    type(place_t), intent(in) :: place
    type(cone_of_node_t), intent(in) :: cone
    integer :: s
    lies_flat = .false.
    if (place%vertex > 0) return
    do s = 1, 2
      if (place%length > own%chain_length(s, k)*(one + equal_size)) cycle
      if (-dot_product(cone%normal(:, s), place%normal) >= cosine_of_flat) lies_flat = .true.
    end do
  end function lies_flat

  !> Two nodes that meet each other: the more convex one stays, then that of the shorter
  !> edges, then SURFA's; its normal is the mean of the two, so that a mirrored scene is
  !> mirrored. The other keeps an allowance. Of several places of a node the most opposite
  !> one counts. The first n_first places are of side 1, sorted by node, the others of side
  !> 2.
  pure subroutine settle_twins(side, is_self, finer, x, u, place, n_first, n)
    type(surface_t), intent(in) :: side(2)
    logical, intent(in) :: is_self
    integer, intent(in) :: finer
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: n_first, n
    type(place_t), intent(inout) :: place(:)
    integer :: a, b, vertex, low
    do a = 1, n_first
      vertex = vertex_met(side(merge(1, 2, is_self)), place(a))
      if (vertex == 0) cycle
      low = merge(a, n_first, is_self)
      b = first_place_of(place, low + 1, n, vertex)
      do while (b > 0 .and. b <= n)
        if (place(b)%node /= vertex) exit
        if (is_best_twin(side(1), side(merge(1, 2, is_self)), place(:n), a, b)) &
            call settle_pair(side(1), side(merge(1, 2, is_self)), finer, x, u, place(a), &
            place(b))
        b = b + 1
      end do
    end do
  end subroutine settle_twins

  !> Are places a and b twins, and is no other place of their two nodes more opposite to
  !> either?
  pure logical function is_best_twin(side_a, side_b, place, a, b)
    type(surface_t), intent(in) :: side_a, side_b
    type(place_t), intent(in) :: place(:)
    integer, intent(in) :: a, b
    integer :: ends(2), i
    is_best_twin = is_twin(side_a, side_b, place(a), place(b))
    if (.not. is_best_twin) return
    ends = places_of_node(place, a)
    do i = ends(1), ends(2)
      if (dot_product(place(i)%normal - place(a)%normal, place(b)%normal) >= zero) cycle
      if (is_twin(side_a, side_b, place(i), place(b))) is_best_twin = .false.
    end do
    ends = places_of_node(place, b)
    do i = ends(1), ends(2)
      if (dot_product(place(a)%normal, place(i)%normal - place(b)%normal) >= zero) cycle
      if (is_twin(side_a, side_b, place(a), place(i))) is_best_twin = .false.
    end do
  end function is_best_twin

  !> First and last of the places of the node of place k.
  pure function places_of_node(place, k) result(ends)
    type(place_t), intent(in) :: place(:)
    integer, intent(in) :: k
    integer :: ends(2)
    ends = k
    do while (ends(1) > 1)
      if (.not. is_same_node(place(ends(1) - 1), place(k))) exit
      ends(1) = ends(1) - 1
    end do
    do while (ends(2) < size(place))
      if (.not. is_same_node(place(ends(2) + 1), place(k))) exit
      ends(2) = ends(2) + 1
    end do
  end function places_of_node

  pure logical function is_same_node(p, q)
    type(place_t), intent(in) :: p, q
    is_same_node = p%node == q%node .and. p%side == q%side
  end function is_same_node

  !> The vertex of the obstacle that a place is nearly at; 0 = none.
  pure integer function vertex_met(obstacle, place)
    type(surface_t), intent(in) :: obstacle
    type(place_t), intent(in) :: place
    vertex_met = place%vertex
    if (vertex_met > 0) return
    if (place%s*obstacle%length(place%edge) <= twin*place%length) then
      vertex_met = obstacle%end_node(1, place%edge)
    else if ((one - place%s)*obstacle%length(place%edge) <= twin*place%length) then
      vertex_met = obstacle%end_node(2, place%edge)
    end if
  end function vertex_met

  !> The first place of a node among those from low to high, which are sorted by node; 0 =
  !> none.
  pure integer function first_place_of(place, low, high, node)
    type(place_t), intent(in) :: place(:)
    integer, intent(in) :: low, high, node
    integer :: a, b, m
    a = low
    b = high
    do while (a <= b)
      m = (a + b)/2
      if (place(m)%node < node) then
        a = m + 1
      else
        b = m - 1
      end if
    end do
    first_place_of = 0
    if (a > high) return
    if (place(a)%node == node) first_place_of = a
  end function first_place_of

  !> Is each of two places at the node of the other, by the shorter of their edges?
  pure logical function is_twin(side_p, side_q, p, q)
    type(surface_t), intent(in) :: side_p, side_q
    type(place_t), intent(in) :: p, q
    is_twin = .false.
    if (dot_product(p%normal, q%normal) >= -cosine_of_smooth) return
    is_twin = max(distance_at(side_p, q, p%node), distance_at(side_q, p, q%node)) &
        <= twin*min(p%length, q%length)
  end function is_twin

  !> Distance along the boundary between a place and a vertex [L].
  pure real(wp) function distance_at(surface, place, vertex)
    type(surface_t), intent(in) :: surface
    type(place_t), intent(in) :: place
    integer, intent(in) :: vertex
    distance_at = huge(one)
    if (place%vertex > 0) then
      if (place%vertex == vertex) distance_at = zero
    else if (surface%end_node(1, place%edge) == vertex) then
      distance_at = place%s*surface%length(place%edge)
    else if (surface%end_node(2, place%edge) == vertex) then
      distance_at = (one - place%s)*surface%length(place%edge)
    end if
  end function distance_at

  !> One of two smooth twins is exact, whatever edges each was compared with: of edges that
  !> differ by equal_size, or that grow along the face, both nodes may be the coarser one. A
  !> corner on a flat is meant so.
  pure subroutine settle_pair(side_a, side_b, finer, x, u, a, b)
    type(surface_t), intent(in) :: side_a, side_b
    integer, intent(in) :: finer
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(place_t), intent(inout) :: a, b
    real(wp) :: turn_a, turn_b
    logical :: a_stays, is_exact, by_deck
    turn_a = side_a%turn(side_a%index(a%node))
    turn_b = side_b%turn(side_b%index(b%node))
    a_stays = .true.
    by_deck = a%side /= b%side .and. any(finer == [1, 2]) .and. max(turn_a, turn_b) <= corner
    if (by_deck) then
      a_stays = a%side == finer
    else if (abs(turn_a - turn_b) > sharper) then
      a_stays = turn_a > turn_b
    else if (abs(a%own_size - b%own_size) > equal_size*max(a%own_size, b%own_size)) then
      a_stays = a%own_size < b%own_size
    else if (a%side == b%side) then
      a_stays = stays_in_one_surface(side_a, a, b)
    end if
    is_exact = a%is_exact .or. b%is_exact .or. &
        (finer == finer_auto .and. max(turn_a, turn_b) <= corner)
    a%is_exact = a_stays .and. is_exact
    b%is_exact = .not. a_stays .and. is_exact
    a%is_twin = .not. a_stays .and. is_exact
    b%is_twin = a_stays .and. is_exact
    if (by_deck) return               ! its normal is that of the side that is the obstacle
    if (a_stays) call take_mean(side_b, x, u, b%normal, a)
    if (.not. a_stays) call take_mean(side_a, x, u, a%normal, b)
  end subroutine settle_pair

  !> Of two places of one surface that of the lower part stays, within a part that which is
  !> nearer to the other node: the numbers of nodes decide only where nothing else does.
  pure logical function stays_in_one_surface(surface, a, b) result(a_stays)
    type(surface_t), intent(in) :: surface
    type(place_t), intent(in) :: a, b
    integer :: part(2)
    part(1) = surface%part_id(maxval(surface%node_edge(:, surface%index(a%node))))
    part(2) = surface%part_id(maxval(surface%node_edge(:, surface%index(b%node))))
    if (part(1) /= part(2)) then
      a_stays = part(1) < part(2)
    else
      a_stays = distance_at(surface, b, a%node) >= distance_at(surface, a, b%node) &
          - equal_size*min(a%length, b%length)
    end if
  end function stays_in_one_surface

  !> normal = mean of it and of the other's, reversed; gap anew.
  pure subroutine take_mean(obstacle, x, u, other, place)
    type(surface_t), intent(in) :: obstacle
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(in) :: other(2)
    type(place_t), intent(inout) :: place
    real(wp) :: n(2), weight(3), d(2), e(2)
    integer :: point(3), points
    n = place%normal - other
    n = n/sqrt(n(1)**2 + n(2)**2)
    if (abs(n(1) - place%normal(1)) + abs(n(2) - place%normal(2)) < 1.0e-12_wp) return
    place%normal = n
    call points_of_place(obstacle, place, point, weight, points)
    d = x(:, point(1)) - x(:, point(2))
    e = u(:, point(1)) - u(:, point(2))
    if (points == 3) d = d + weight(3)*(x(:, point(3)) - x(:, point(2)))
    if (points == 3) e = e + weight(3)*(u(:, point(3)) - u(:, point(2)))
    place%gap = dot_product(n, d) + dot_product(n, e)
  end subroutine take_mean

  !> Points and weights of the row of a place.
  pure subroutine points_of_place(obstacle, place, point, weight, points)
    type(surface_t), intent(in) :: obstacle
    type(place_t), intent(in) :: place
    integer, intent(out) :: point(3), points
    real(wp), intent(out) :: weight(3)
    if (place%vertex > 0) then
      point = [place%node, place%vertex, place%vertex]
      weight = [one, -one, zero]
      points = 2
    else
      point = [place%node, obstacle%end_node(:, place%edge)]
      weight = [one, place%s - one, -place%s]
      points = 3
    end if
  end subroutine points_of_place

end module contact_grade
