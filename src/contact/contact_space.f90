! SPDX-License-Identifier: BSD-3-Clause
!> The pairing NODE of bodies in space: nodes of both sides are watched against the facets of the
!> other, sharp edges of both against each other; within a single surface of several bodies
!> against all other facets and edges.
module contact_space
  use base_archive, only: archive_t, archive_restore
  use base_kinds, only: wp, zero, one
  use contact_emit, only: too_deep
  use contact_grade, only: finer_auto
  use contact_near, only: near_t, exchange_near, longest_list, turn_limit, is_behind
  use contact_overlap, only: update_front
  use contact_pairing, only: pairing_t, overlap_t, late_t, no_gap, note_overlap
  use contact_places, only: view_t, share_at_corner, deepest
  use contact_rows, only: rows_t
  use contact_sight, only: seen_t, see_facet, place_of_node
  use contact_fan, only: faces_fan, open_fan
  use contact_skin, only: skin_t
  use contact_space_edges, only: edge_pairs_t, crossing_t, list_edge_pairs, cross_edges, &
      exchange_edge_pairs
  use contact_space_emit, only: emit_place, emit_crossing, judge_late_place, judge_late_crossing
  use contact_space_gap, only: gap_before, all_gap
  use contact_space_grade, only: grade_in_space, settle_in_space
  use contact_space_near, only: list_near_in_space, mark_near_in_space, mark_pairs
  use contact_space_places, only: space_place_t, space_sight_t, find_space_places, &
      size_space_sight, sine_of_facing
  use contact_space_tree, only: space_tree_t, place_facets, place_edges, least_distance
  use contact_space_whole, only: deepest_node_in_space, deepest_edge_in_space, edge_inside
  use model_data, only: model_t
  implicit none
  private

  type, extends(pairing_t), public :: pairing_space_t
    integer :: finer = finer_auto        !< side whose nodes are exact, by the deck
    logical :: is_self = .false.         !< side(1) against itself
    logical :: may_share = .false.       !< nodes may belong to both sides
    logical, allocatable :: leaves_out(:, :)   !< (parts, parts) do not touch; or empty
    type(skin_t) :: skin(2)
    type(space_tree_t) :: facets(2), edges(2)
    type(near_t) :: near(2)              !< nodes of each side
    type(edge_pairs_t) :: pairs          !< edges of side 1 and of the other
    type(space_sight_t) :: sight         !< work space of one node
    type(space_place_t), allocatable :: place(:)
    type(crossing_t), allocatable :: crossing(:)   !< (pairs)
    integer, allocatable :: first(:)     !< (nodes) scratch, zero
    integer :: places = 0
    logical :: is_measured = .false.     !< true gaps are those of the end of this step
  contains
    procedure :: list => space_list
    procedure :: mark_interface => space_mark_interface
    procedure :: mark_contact_nodes => space_mark_contact_nodes
    procedure :: find_places => space_find_places
    procedure :: append_rows => space_append_rows
    procedure :: renew_gaps => space_renew_gaps
    procedure :: find_late => space_find_late
    procedure :: measure => space_measure
    procedure :: find_passage => space_find_passage
    procedure :: measure_whole => space_measure_whole
    procedure :: weigh_nodes => space_weigh_nodes
    procedure :: exchange => space_exchange
  end type pairing_space_t

contains

  !> Sides whose nodes are watched: a surface against itself is one.
  pure integer function watched_sides(this)
    type(pairing_space_t), intent(in) :: this
    watched_sides = merge(1, 2, this%is_self)
  end function watched_sides

  !> The surface that the nodes of a side face.
  pure integer function facing_side(this, s)
    type(pairing_space_t), intent(in) :: this
    integer, intent(in) :: s
    facing_side = merge(1, 3 - s, this%is_self)
  end function facing_side

  !> What the nodes of a side see: on closed surfaces nodes may belong to both.
  pure type(view_t) function view_of(this)
    type(pairing_space_t), intent(in) :: this
    view_of%may_share = this%is_self .or. this%may_share
    view_of%is_reference = this%is_reference
    view_of%reach = &
        0.25_wp*min(this%side(1)%shortest, this%side(facing_side(this, 1))%shortest)
  end function view_of

  subroutine space_list(this, model, u, reach)
    class(pairing_space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    real(wp), intent(in) :: reach
    logical :: turned, some_turned
    integer :: s, t
    if (.not. allocated(this%first)) allocate (this%first(model%nodes), source=0)
    call place_trees(this, model%x, u)
    t = facing_side(this, 1)
    this%turn_margin = huge(one)
    this%near%n = 0
    this%pairs%n = 0
    this%safe_distance = reach
    if (.not. (this%is_self .or. this%may_share)) this%safe_distance = &
        least_distance(this%facets(1), this%facets(2), 16.0_wp*reach)
    if (this%safe_distance <= reach .or. has_lone_nodes(this)) then
      this%safe_distance = reach
      some_turned = .false.
      call size_space_sight(this%skin(1), this%skin(t), 1, this%sight)
      do s = 1, watched_sides(this)
        t = facing_side(this, s)
        call list_near_in_space(this%side(s), this%skin(s), this%skin(t), this%facets(t), &
            model%x, u, reach, this%is_self .or. this%may_share, this%leaves_out, &
            this%sight%fan, this%near(s), turned)
        some_turned = some_turned .or. turned
      end do
      t = facing_side(this, 1)
      call list_edge_pairs(this%skin(1), this%skin(t), this%edges(1), this%edges(t), reach, &
          this%is_self, this%leaves_out, this%pairs)
      this%turn_margin = merge(turn_limit, huge(one), some_turned)
    end if
    this%listed = sum(this%near%n) + this%pairs%n
    call size_places(this)
  end subroutine space_list

  !> Nodes without a facet of their own are in no tree.
  pure logical function has_lone_nodes(this)
    type(pairing_space_t), intent(in) :: this
    integer :: s
    has_lone_nodes = .false.
    do s = 1, watched_sides(this)
      has_lone_nodes = has_lone_nodes .or. any(this%skin(s)%at(this%side(s)%node) == 0)
    end do
  end function has_lone_nodes

  !> Work space for the lists as they are.
  subroutine size_places(this)
    type(pairing_space_t), intent(inout) :: this
    integer :: n
    call size_space_sight(this%skin(1), this%skin(facing_side(this, 1)), &
        max(1, longest_list(this%near(1)), longest_list(this%near(2))), this%sight)
    if (allocated(this%crossing)) then
      if (size(this%crossing) < this%pairs%n) deallocate (this%crossing)
    end if
    if (.not. allocated(this%crossing)) allocate (this%crossing(this%pairs%n))
    n = 4*sum(this%near%n) + 4
    if (allocated(this%place)) then
      if (size(this%place) >= n) return
      deallocate (this%place)
    end if
    allocate (this%place(2*n))
  end subroutine size_places

  !> The trees of both sides at X + U.
  subroutine place_trees(this, x, u)
    type(pairing_space_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer :: s
    do s = 1, watched_sides(this)
      call place_facets(this%skin(s), x, u, this%facets(s))
      call place_edges(this%skin(s), x, u, this%edges(s))
    end do
  end subroutine place_trees

  subroutine space_mark_interface(this, model, taken, carrier)
    class(pairing_space_t), intent(in) :: this
    type(model_t), intent(in) :: model
    logical, intent(inout) :: taken(:)
    integer, intent(inout) :: carrier(:)
    integer :: s
    do s = 1, watched_sides(this)
      call mark_near_in_space(this%side(s), this%skin(s), this%skin(facing_side(this, s)), &
          this%near(s), taken, carrier)
    end do
    call mark_pairs(this%skin(1), this%skin(facing_side(this, 1)), this%pairs, taken, carrier)
  end subroutine space_mark_interface

  !> Nodes of facets that look at the other surface: its middle stands in front of them, and some
  !> facet of it faces them.
  subroutine space_mark_contact_nodes(this, model, taken)
    class(pairing_space_t), intent(in) :: this
    type(model_t), intent(in) :: model
    logical, intent(inout) :: taken(:)
    real(wp), parameter :: opposite = -0.7_wp
    integer :: s, t, k, j
    real(wp) :: d(3)
    do s = 1, watched_sides(this)
      t = facing_side(this, s)
      associate (own => this%skin(s), other => this%skin(t))
        do k = 1, own%facets
          if (.not. own%is_listed(k)) cycle
          do j = 1, other%facets
            if (.not. other%is_listed(j)) cycle
            if (dot_product(own%normal(:, k), other%normal(:, j)) > opposite) cycle
            if (this%is_self .and. own%body(k) == other%body(j)) cycle
            d = model%x(:, other%node(1, j)) - model%x(:, own%node(1, k))
            if (dot_product(d, own%normal(:, k)) < -0.1_wp*own%size(k)) cycle
            d = d - dot_product(d, own%normal(:, k))*own%normal(:, k)
            if (norm2(d) > 2.0_wp*(own%size(k) + other%size(j))) cycle
            taken(own%node(:own%corners(k), k)) = .true.
            exit
          end do
        end do
      end associate
    end do
  end subroutine space_mark_contact_nodes

  subroutine space_find_places(this, model, u, free, is_same)
    class(pairing_space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :), free(:, :)
    logical, intent(out) :: is_same
    type(view_t) :: view
    integer :: s, n_first
    is_same = .false.
    this%places = 0
    this%is_measured = .false.
    view = view_of(this)
    view%reach = view%reach + 2.0_wp*relative_motion(this, free)
    n_first = 0
    do s = 1, watched_sides(this)
      call find_side(this, model, s, u, view, free)
      if (s == 1) n_first = this%places
    end do
    if (this%places > 1) call settle(this, model%x, u, n_first)
    call find_crossings(this, model%x, u, view)
  end subroutine space_find_places

  !> Bound of the motion of any two near nodes relative to each other [L].
  pure real(wp) function relative_motion(this, free)
    type(pairing_space_t), intent(in) :: this
    real(wp), intent(in), contiguous :: free(:, :)
    real(wp) :: low(3), high(3)
    integer :: s, i
    low = huge(one)
    high = -huge(one)
    do s = 1, watched_sides(this)
      do i = 1, this%near(s)%n
        associate (node => this%side(s)%node(this%near(s)%node(i)))
          low = min(low, free(:, node))
          high = max(high, free(:, node))
        end associate
      end do
    end do
    do i = 1, this%pairs%n
      associate (a => this%skin(1)%ends(1, this%pairs%a(i)), &
          b => this%skin(facing_side(this, 1))%ends(1, this%pairs%b(i)))
        low = min(low, free(:, a), free(:, b))
        high = max(high, free(:, a), free(:, b))
      end associate
    end do
    relative_motion = zero
    if (all(low <= high)) relative_motion = norm2(high - low)
  end function relative_motion

  subroutine settle(this, x, u, n_first)
    type(pairing_space_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: n_first
    call settle_in_space(this%skin(1), this%skin(facing_side(this, 1)), this%is_self, &
        this%finer, x, u, this%place(:this%places), n_first, this%first)
  end subroutine settle

  !> Places of the near nodes of a side.
  subroutine find_side(this, model, s, u, view, free)
    type(pairing_space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    integer, intent(in) :: s
    real(wp), intent(in), contiguous :: u(:, :), free(:, :)
    type(view_t), intent(in) :: view
    real(wp) :: gap
    integer :: i, t, facet
    t = facing_side(this, s)
    associate (near => this%near(s), own => this%skin(s), obstacle => this%skin(t))
      do i = 1, near%n
        if (near%distance(i) > view%reach) cycle
        associate (list => near%edge(near%first(i):near%first(i + 1) - 1), &
            node => this%side(s)%node(near%node(i)))
          if (.not. obstacle%is_closed) then
            call open_gap(this, model%x, u, s, node, list, gap, facet)
            call update_front(gap, this%penetration_tolerance*this%side(t)%mean_length, &
                near%front(i))
            if (near%front(i) == is_behind) cycle
          end if
          call find_space_places(own, obstacle, node, list, model%x, u, view, this%sight, free)
          if (obstacle%is_closed .and. .not. near%distance(i) > -huge(one)) then
            if (any(this%sight%place(:this%sight%places)%gap < zero)) call find_gap(this, &
                model%x, u, s, i, list, facet)
          end if
        end associate
        call take_places(this, s, near%distance(i))
      end do
    end associate
  end subroutine find_side

  !> Keeps the places of a node with their grades. A node that is outside has no place that is
  !> deeper than its allowance: that is the far side of a thin body.
  subroutine take_places(this, s, distance)
    type(pairing_space_t), intent(inout) :: this
    integer, intent(in) :: s
    real(wp), intent(in) :: distance
    integer :: j
    do j = 1, this%sight%places
      associate (place => this%sight%place(j))
        place%side = s
        if (distance > zero .and. place%gap < -place%allowance) cycle
        call grade_in_space(this%skin(s), this%skin(facing_side(this, s)), this%is_self, &
            this%finer, this%sight%fan, place)
        if (this%places == size(this%place)) this%place = [this%place, this%place]
        this%places = this%places + 1
        this%place(this%places) = place
      end associate
    end do
  end subroutine take_places

  !> All pairs of edges as they are.
  subroutine find_crossings(this, x, u, view)
    type(pairing_space_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(view_t), intent(in) :: view
    integer :: k
    do k = 1, this%pairs%n
      call cross_edges(this%skin(1), this%skin(facing_side(this, 1)), this%pairs%a(k), &
          this%pairs%b(k), x, u, view%is_reference, this%crossing(k))
      if (this%crossing(k)%gap > view%reach) this%crossing(k)%is_valid = .false.
    end do
  end subroutine find_crossings

  !> Rows of the exact places and crossings; those that have an allowance are kept apart.
  subroutine space_append_rows(this, rows, spare)
    class(pairing_space_t), intent(inout) :: this
    type(rows_t), intent(inout) :: rows, spare
    integer :: j, k
    k = 1
    do j = 1, this%places
      associate (place => this%place(j))
        call append_crossings(place%side, place%node)
        if (place%is_exact) then
          call emit_place(this%number, this%friction%static, place, rows)
        else
          call emit_place(this%number, this%friction%static, place, spare)
        end if
      end associate
    end do
    call append_crossings(2, 0)
  contains
    !> Those whose node is before this one: rows are in the order of sides and nodes.
    subroutine append_crossings(side, node)
      integer, intent(in) :: side, node
      integer :: key(4)
      do while (k <= this%pairs%n)
        key = key_of(this, k)
        if (side == 1 .and. key(3) >= node) exit
        if (this%crossing(k)%is_valid .and. this%crossing(k)%allowance > zero) then
          call emit_crossing(key, this%friction%static, this%crossing(k), spare)
        else if (this%crossing(k)%is_valid) then
          call emit_crossing(key, this%friction%static, this%crossing(k), rows)
        end if
        k = k + 1
      end do
    end subroutine append_crossings
  end subroutine space_append_rows

  !> The key of the row of pair k: the first node of the contactor's edge; which of the edges
  !> there, and the obstacle's edge.
  pure function key_of(this, k) result(key)
    type(pairing_space_t), intent(in) :: this
    integer, intent(in) :: k
    integer :: key(4), v, t
    t = facing_side(this, 1)
    associate (skin => this%skin(1), a => this%pairs%a(k))
      v = skin%at(skin%ends(1, a))
      key = [this%number, 1, skin%ends(1, a), this%skin(t)%facets + this%pairs%b(k) + &
          this%skin(t)%edges*(findloc(skin%edge(skin%first_edge(v):skin%first_edge(v + 1) - 1), &
          a, dim=1) - 1)]
    end associate
  end function key_of

  !> Places change in every step (find_places says so), so that there is nothing to renew.
  subroutine space_renew_gaps(this, rows, a, spare, b, is_same)
    class(pairing_space_t), intent(in) :: this
    type(rows_t), intent(inout) :: rows, spare
    integer, intent(inout) :: a, b
    logical, intent(inout) :: is_same
    is_same = .false.
  end subroutine space_renew_gaps

  !> Nodes and crossings that are deeper at the end of the step than what they may: their places
  !> there, as new rows or as new frames of the rows they have.
  subroutine space_find_late(this, model, u0, u1, rows, late, n)
    class(pairing_space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u0(:, :), u1(:, :)
    type(rows_t), intent(in) :: rows
    type(late_t), intent(inout) :: late(:)
    integer, intent(inout) :: n
    type(late_t) :: found(size(late))
    integer :: s, j, k, m, n_first
    logical :: some_deep
    some_deep = .false.
    do s = 1, watched_sides(this)
      call find_gaps(this, model%x, s, u1, some_deep)
    end do
    this%is_measured = .true.
    m = 0
    if (some_deep) then
      ! All places: what meets a deep node decides which of the two has the row.
      this%places = 0
      do s = 1, watched_sides(this)
        call find_end(this, model%x, s, u1)
        if (s == 1) n_first = this%places
      end do
      if (this%places > 1) call settle(this, model%x, u1, n_first)
    end if
    call find_crossings(this, model%x, u1, view_of(this))
    j = 1
    do k = 1, this%pairs%n + 1
      do while (some_deep .and. j <= this%places)
        if (k <= this%pairs%n .and. this%place(j)%side == 1) then
          if (this%place(j)%node > this%skin(1)%ends(1, this%pairs%a(k))) exit
        else if (k <= this%pairs%n) then
          exit
        end if
        call judge_late_place(this%number, model%x, u0, this%place(j), rows, found, m)
        j = j + 1
      end do
      if (k > this%pairs%n) exit
      if (this%crossing(k)%is_valid) call judge_late_crossing(key_of(this, k), model%x, u0, &
          this%crossing(k), rows, found, m)
    end do
    m = min(m, size(late) - n)
    late(n + 1:n + m) = found(:m)
    n = n + m
  end subroutine space_find_late

  !> True gaps of the near nodes of a side at the end of the step.
  subroutine find_gaps(this, x, s, u, some_deep)
    type(pairing_space_t), intent(inout) :: this
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

  !> The true gap of near node i before a closed obstacle, into its distance; a deep one is looked
  !> at with all facets, since the far side of a thin body may be among those listed.
  subroutine find_gap(this, x, u, s, i, list, facet)
    type(pairing_space_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: s, i, list(:)
    integer, intent(out) :: facet
    integer :: t
    t = facing_side(this, s)
    associate (node => this%side(s)%node(this%near(s)%node(i)), gap => this%near(s)%distance(i), &
        skin => this%skin(t))
      call gap_before(skin, list, x, u, place_of_node(x, u, node), this%sight%other, gap, facet)
      if (gap >= -least_allowance(this, s, this%near(s)%node(i)) .or. this%is_self) return
      call all_gap(skin, x, u, place_of_node(x, u, node), this%sight%other, gap, facet)
    end associate
  end subroutine find_gap

  !> No node may be less deep than this and still need a row [L].
  pure real(wp) function least_allowance(this, s, k)
    type(pairing_space_t), intent(in) :: this
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
    type(pairing_space_t), intent(inout) :: this
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

  !> All places of the near nodes of a side at the end of the step.
  subroutine find_end(this, x, s, u)
    type(pairing_space_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: s
    type(view_t) :: view
    real(wp) :: gap
    integer :: i
    view = view_of(this)
    associate (near => this%near(s))
      do i = 1, near%n
        gap = near%distance(i)
        if (near%front(i) == is_behind .or. gap > view%reach) cycle
        if (gap < zero .and. gap >= -least_allowance(this, s, near%node(i))) gap = tiny(one)
        call find_space_places(this%skin(s), this%skin(facing_side(this, s)), &
            this%side(s)%node(near%node(i)), near%edge(near%first(i):near%first(i + 1) - 1), &
            x, u, view, this%sight)
        call take_places(this, s, gap)
      end do
    end associate
  end subroutine find_end

  !> True gaps at the end of a step, the smallest in sums; the deepest overlap.
  subroutine space_measure(this, model, u, overlap)
    class(pairing_space_t), intent(inout) :: this
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
            if (allocated(this%nodal)) this%nodal%gap(this%nodal%first(s) + k) = min(gap, no_gap)
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
        if (c%gap < -worth_a_look*c%length) call note_pair(this, model%x, u, k, is_placed, overlap)
      end associate
    end do
    this%is_measured = .true.
  end subroutine space_measure

  !> Near nodes that stand outside a closed obstacle and pairs of edges that do not cross at the
  !> end u of a step of motion du: did they within it, all motions linear in time?
  subroutine space_find_passage(this, model, u, du, overlap)
    class(pairing_space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :), du(:, :)
    type(overlap_t), intent(inout) :: overlap
    integer, parameter :: times = 8
    integer :: k, s
    if (this%is_self) return
    do k = 1, times - 1
      associate (now => u - (one - real(k, wp)/times)*du)
        do s = 1, 2
          if (this%skin(3 - s)%is_closed) call nodes_inside(this, model%x, now, s, overlap)
        end do
        call pairs_across(this, model%x, now, overlap)
      end associate
    end do
  end subroutine space_find_passage

  !> Nodes of a side that are outside at the end of the step but inside at u.
  subroutine nodes_inside(this, x, u, s, overlap)
    type(pairing_space_t), intent(inout) :: this
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
    type(pairing_space_t), intent(inout) :: this
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
    type(pairing_space_t), intent(inout) :: this
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
    call edge_inside(this%skin(1), this%pairs%a(k), this%skin(t), this%facets(t), x, u, nothing, &
        this%sight%other, overlap)
    call edge_inside(this%skin(t), this%pairs%b(k), this%skin(1), this%facets(1), x, u, nothing, &
        this%sight%other, overlap)
  end subroutine note_pair

  !> All nodes and edges of closed sides; of open ones what stands just behind them.
  subroutine space_measure_whole(this, model, u, overlap, accepted)
    class(pairing_space_t), intent(inout) :: this
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
  end subroutine space_measure_whole

  !> Overlap of the closed sides at u.
  subroutine measure_whole_of(this, model, u, overlap)
    class(pairing_space_t), intent(inout) :: this
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
    end do
  end subroutine measure_whole_of

  !> Areas of near nodes: the integrals of their shape functions over the facets round them that
  !> face the side they touch, by the normals of those facets and the forces on the nodes.
  subroutine space_weigh_nodes(this, model, area)
    class(pairing_space_t), intent(in) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(inout) :: area(:)
    real(wp), parameter :: facing = -0.7_wp
    real(wp) :: force
    integer :: s, k, i, v, at
    do s = 1, 2
      associate (skin => this%skin(s))
        do k = 1, size(this%side(s)%node)
          at = this%nodal%first(s) + k
          v = skin%at(this%side(s)%node(k))
          if (v == 0 .or. .not. (this%nodal%gap(at) < no_gap .or. &
              this%nodal%normal(at) > zero)) cycle
          force = norm2(this%nodal%force(:, at))
          do i = skin%first_facet(v), skin%first_facet(v + 1) - 1
            associate (f => skin%facet(i))
              if (.not. skin%is_listed(f)) cycle
              if (force > zero) then
                if (dot_product(this%nodal%force(:, at), skin%normal(:, f)) > facing*force) cycle
              end if
              area(at) = area(at) + skin%size(f)**2/skin%corners(f)
            end associate
          end do
        end do
      end associate
    end do
  end subroutine space_weigh_nodes

  subroutine space_exchange(this, archive)
    class(pairing_space_t), intent(inout) :: this
    type(archive_t), intent(inout) :: archive
    call archive%exchange('space.turn_margin', this%turn_margin)
    call archive%exchange('space.listed', this%listed)
    call archive%exchange('space.is_measured', this%is_measured)
    call exchange_near(archive, this%near(1))
    call exchange_near(archive, this%near(2))
    call exchange_edge_pairs(archive, this%pairs)
    if (archive%mode == archive_restore) call size_places(this)
  end subroutine space_exchange

end module contact_space
