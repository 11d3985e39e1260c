! SPDX-License-Identifier: BSD-3-Clause
!> True gaps and overlaps of bodies in space, in every step and of the whole: it asks the
!> boundaries, not the rows.
module contact_space_monitor
  use base_kinds, only: wp, zero, one, half
  use contact_emit, only: too_deep
  use contact_fan, only: faces_fan, open_fan
  use contact_features, only: end_tolerance
  use contact_near, only: is_behind
  use contact_pairing, only: overlap_t, no_gap, note_overlap
  use contact_places, only: share_at_corner, deepest
  use contact_sight, only: seen_t, see_facet, place_of_node
  use contact_space_base, only: space_t, watched_sides, facing_side, view_of, place_trees, &
      find_crossings
  use contact_space_edges, only: crossing_t, cross_edges
  use contact_space_gap, only: gap_before, all_gap
  use contact_space_view, only: sine_of_facing
  use contact_space_whole, only: deepest_node_in_space, deepest_edge_in_space, &
      deepest_inside, edge_inside
  use model_data, only: model_t
  implicit none
  private

  public :: find_gaps, find_gap, open_gap, least_allowance, measure_near, find_passages, &
      measure_all

contains

  !> True gaps of the near nodes of a side at the end of the step.
  subroutine find_gaps(this, x, s, u, some_deep)
    class(space_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: s
    logical, intent(inout) :: some_deep
    integer :: i, t, facet
    t = facing_side(this, s)
    associate (near => this%near(s))
      do i = 1, near%n
        associate (list => near%edge(near%first(i):near%first(i + 1) - 1))
          if (this%skin(t)%is_closed) then
            call find_gap(this, x, u, s, i, list, facet)
          else
            call open_gap(this, x, u, s, this%side(s)%node(near%node(i)), list, &
                near%distance(i), facet)
            if (near%front(i) == is_behind) near%distance(i) = huge(one)
          end if
          near%nearest(i) = facet
          some_deep = some_deep .or. near%distance(i) < -least_allowance(this, s, near%node(i))
        end associate
      end do
    end associate
  end subroutine find_gaps

  !> The true gap of near node i before a closed obstacle, into its distance; a deep one is
  !> looked at with all facets, since the far side of a thin body may be among those listed.
  subroutine find_gap(this, x, u, s, i, list, facet)
    class(space_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: s, i, list(:)
    integer, intent(out) :: facet
    integer :: t
    t = facing_side(this, s)
    associate (node => this%side(s)%node(this%near(s)%node(i)), &
        gap => this%near(s)%distance(i), skin => this%skin(t))
      call gap_before(skin, list, x, u, place_of_node(x, u, node), this%sight%other, gap, facet)
      if (gap >= -least_allowance(this, s, this%near(s)%node(i))) return
      if (this%is_self) then
        call look_again_in_self(this, x, u, node, gap, facet)
      else
        call all_gap(skin, x, u, place_of_node(x, u, node), this%sight%other, gap, facet)
      end if
    end associate
  end subroutine find_gap

  !> A node that is deep behind a facet of its own surface: of another body it is asked for
  !> with all facets of those; of its own, behind whose far side it always is, a place just
  !> outside the node must be inside the body again.
  subroutine look_again_in_self(this, x, u, node, gap, facet)
    class(space_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: node
    real(wp), intent(inout) :: gap
    integer, intent(inout) :: facet
    real(wp), parameter :: outward = 1.0e-3_wp     ! edges
    real(wp) :: from(3, 2), outside
    integer :: k, v, body, other
    associate (skin => this%skin(1))
      v = skin%at(node)
      if (v == 0) return
      body = skin%body(skin%facet(skin%first_facet(v)))
      from = place_of_node(x, u, node)
      if (skin%body(facet) == body) then
        call open_fan(skin, node, x, u, .false., this%sight%fan)
        from(:, 1) = from(:, 1) + outward*skin%shortest(v)*this%sight%fan%mean
        call gap_before(skin, pack([(k, k=1, skin%facets)], skin%body == body), x, u, from, &
            this%sight%other, outside, other)
        if (outside >= zero) gap = -gap
      else
        call gap_before(skin, pack([(k, k=1, skin%facets)], skin%body /= body), x, u, from, &
            this%sight%other, gap, facet)
      end if
    end associate
  end subroutine look_again_in_self

  !> No node may be less deep than this and still need a row [L].
  pure real(wp) function least_allowance(this, s, k)
    class(space_t), intent(in) :: this
    integer, intent(in) :: s, k
    integer :: v
    least_allowance = this%side(facing_side(this, s))%shortest
    v = this%skin(s)%at(this%side(s)%node(k))
    if (v > 0) least_allowance = min(least_allowance, this%skin(s)%shortest(v))
    least_allowance = too_deep*share_at_corner*least_allowance
  end function least_allowance

  !> Gap of a node to the nearest facet of an open obstacle that it is before and not too deep
  !> behind; huge: none.
  subroutine open_gap(this, x, u, s, node, list, gap, facet)
    class(space_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: s, node, list(:)
    real(wp), intent(out) :: gap
    integer, intent(out) :: facet
    type(seen_t) :: seen
    integer :: j
    gap = huge(one)
    facet = 0
    call open_fan(this%skin(s), node, x, u, .false., this%sight%fan)
    associate (skin => this%skin(facing_side(this, s)))
      do j = 1, size(list)
        call see_facet(skin, list(j), x, u, place_of_node(x, u, node), .false., seen)
        if (.not. seen%is_before .or. seen%gap < -deepest*skin%size(list(j)) .or. &
            abs(seen%gap) >= abs(gap)) cycle
        if (.not. faces_fan(seen%normal, this%sight%fan, sine_of_facing)) cycle
        gap = seen%gap
        facet = list(j)
      end do
    end associate
  end subroutine open_gap

  !> True gaps at the end of a step, the smallest in sums; the deepest overlap.
  subroutine measure_near(this, model, u, overlap)
    class(space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    type(overlap_t), intent(inout) :: overlap
    real(wp), parameter :: worth_a_look = 1.0e-6_wp    ! / edge
    logical :: some_deep, is_placed
    integer :: s, i, k
    some_deep = .false.
    is_placed = .false.
    do s = 1, watched_sides(this)
      if (.not. this%is_measured) call find_gaps(this, model%x, s, u, some_deep)
      associate (near => this%near(s), skin => this%skin(facing_side(this, s)))
        do i = 1, near%n
          associate (k => near%node(i), gap => near%distance(i), facet => near%nearest(i))
            if (facet == 0) cycle
            this%sums%smallest_gap = min(this%sums%smallest_gap, gap)
            if (allocated(this%nodal)) &
                this%nodal%gap(this%nodal%first(s) + k) = min(gap, no_gap)
            if (gap < zero) call note_overlap(overlap, -gap, min(skin%size(facet), &
                least_allowance(this, s, k)/(too_deep*share_at_corner)), this%side(s)%node(k), &
                skin%part_id(facet), .false.)
          end associate
        end do
      end associate
    end do
    if (.not. this%is_measured) call find_crossings(this, model%x, u, view_of(this))
    do k = 1, this%pairs%n
      associate (c => this%crossing(k))
        if (.not. c%is_valid) cycle
        this%sums%smallest_gap = min(this%sums%smallest_gap, c%gap)
        if (c%gap < -worth_a_look*c%length) &
            call note_pair(this, model%x, u, k, is_placed, overlap)
      end associate
    end do
    this%is_measured = .true.
  end subroutine measure_near

  !> Near nodes that stand outside a closed obstacle and pairs of edges that do not cross at the
  !> end u of a step of motion du: did they within it, all motions linear in time?
  subroutine find_passages(this, model, u, du, overlap)
    class(space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :), du(:, :)
    type(overlap_t), intent(inout) :: overlap
    integer, parameter :: least = 8, most = 512
    real(wp) :: way    ! in shortest edges
    integer :: times, i, k, s
    if (this%is_self) return
    way = zero
    do i = 1, size(du, 2)
      way = max(way, du(1, i)**2 + du(2, i)**2 + du(3, i)**2)
    end do
    way = sqrt(way)/min(this%side(1)%shortest, this%side(2)%shortest)
    times = least
    if (way > least) times = 2*ceiling(min(way, half*most))
    do k = 1, times - 1
      associate (now => u - (one - real(k, wp)/times)*du)
        do s = 1, 2
          if (this%skin(3 - s)%is_closed) call nodes_inside(this, model%x, now, s, overlap)
        end do
        call pairs_across(this, model%x, now, overlap)
      end associate
    end do
  end subroutine find_passages

  !> Nodes of a side that are outside at the end of the step but inside at u.
  subroutine nodes_inside(this, x, u, s, overlap)
    class(space_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: s
    type(overlap_t), intent(inout) :: overlap
    real(wp) :: gap
    integer :: i, facet
    associate (near => this%near(s), skin => this%skin(3 - s))
      do i = 1, near%n
        if (near%distance(i) < zero) cycle
        associate (node => this%side(s)%node(near%node(i)))
          call gap_before(skin, near%edge(near%first(i):near%first(i + 1) - 1), x, u, &
              place_of_node(x, u, node), this%sight%other, gap, facet)
          if (gap >= zero) cycle
          call all_gap(skin, x, u, place_of_node(x, u, node), this%sight%other, gap, facet)
          if (gap < zero) call note_overlap(overlap, -gap, skin%size(facet), node, &
              skin%part_id(facet), .false.)
        end associate
      end do
    end associate
  end subroutine nodes_inside

  !> Pairs of edges that do not cross at the end of the step but do at u.
  subroutine pairs_across(this, x, u, overlap)
    class(space_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(overlap_t), intent(inout) :: overlap
    type(crossing_t) :: c
    integer :: k
    logical :: is_placed
    is_placed = .false.
    do k = 1, this%pairs%n
      if (this%crossing(k)%is_valid .and. this%crossing(k)%gap < zero) cycle
      call cross_edges(this%skin(1), this%skin(facing_side(this, 1)), this%pairs%a(k), &
          this%pairs%b(k), x, u, .false., c)
      if (c%is_valid .and. c%gap < zero) call note_pair(this, x, u, k, is_placed, overlap)
    end do
  end subroutine pairs_across

  !> How deep each edge of pair k stands in the other body at u. is_placed: the trees are there.
  subroutine note_pair(this, x, u, k, is_placed, overlap)
    class(space_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: k
    logical, intent(inout) :: is_placed
    type(overlap_t), intent(inout) :: overlap
    logical :: nothing(max(this%skin(1)%facets, this%skin(2)%facets))
    integer :: t
    if (.not. is_placed) call place_trees(this, x, u)
    is_placed = .true.
    nothing = .false.
    t = facing_side(this, 1)
    call edge_inside(this%skin(1), this%pairs%a(k), this%skin(t), this%facets(t), x, u, &
        nothing, this%sight%other, overlap)
    call edge_inside(this%skin(t), this%pairs%b(k), this%skin(1), this%facets(1), x, u, &
        nothing, this%sight%other, overlap)
  end subroutine note_pair

  !> All nodes and edges of closed sides; of open ones what stands just behind them.
  subroutine measure_all(this, model, u, overlap, accepted)
    class(space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    type(overlap_t), intent(inout) :: overlap
    real(wp), intent(out) :: accepted
    real(wp) :: gap, low(3), high(3), shortest
    integer :: s, t, i, k, facet
    call measure_whole_of(this, model, u, overlap)
    low = huge(one)
    high = -huge(one)
    do s = 1, watched_sides(this)
      t = facing_side(this, s)
      do k = 1, size(this%side(s)%node)
        low = min(low, model%x(:, this%side(s)%node(k)) + u(:, this%side(s)%node(k)))
        high = max(high, model%x(:, this%side(s)%node(k)) + u(:, this%side(s)%node(k)))
      end do
      if (this%skin(t)%is_closed .or. this%is_born) cycle
      do i = 1, this%near(s)%n
        associate (near => this%near(s))
          call open_gap(this, model%x, u, s, this%side(s)%node(near%node(i)), &
              near%edge(near%first(i):near%first(i + 1) - 1), gap, facet)
          if (gap < zero) call note_overlap(overlap, -gap, this%skin(t)%size(facet), &
              this%side(s)%node(near%node(i)), this%skin(t)%part_id(facet), .false.)
        end associate
      end do
    end do
    ! Fields of ten columns hold seven digits of a coordinate.
    shortest = min(this%side(1)%shortest, this%side(facing_side(this, 1))%shortest)
    accepted = min(1.0e-3_wp*shortest, max(this%penetration_tolerance*shortest, &
        1.0e-7_wp*0.5_wp*norm2(high - low)))
  end subroutine measure_all

  !> Overlap of the closed sides at u.
  subroutine measure_whole_of(this, model, u, overlap)
    class(space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    type(overlap_t), intent(inout) :: overlap
    integer :: s, t
    call place_trees(this, model%x, u)
    do s = 1, watched_sides(this)
      t = facing_side(this, s)
      if (.not. this%skin(t)%is_closed) cycle
      call deepest_node_in_space(this%side(s), this%skin(s), this%skin(t), this%facets(t), &
          model%x, u, this%is_self, this%leaves_out, this%sight%other, overlap)
      call deepest_edge_in_space(this%skin(s), this%skin(t), this%facets(t), model%x, u, &
          this%is_self, this%leaves_out, this%sight%other, overlap)
      if (overlap%share <= end_tolerance) call deepest_inside(this%skin(s), this%skin(t), &
          this%facets(t), model%x, u, this%is_self, this%leaves_out, this%sight%other, overlap)
    end do
  end subroutine measure_whole_of

end module contact_space_monitor
