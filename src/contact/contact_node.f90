! SPDX-License-Identifier: BSD-3-Clause
!> The pairing NODE: nodes of both sides are watched against the edges of the other, within a
!> single surface of several bodies against all other edges.
module contact_node
  use base_archive, only: archive_t, archive_restore
  use base_kinds, only: wp, zero, one, half
  use contact_emit, only: emit_row, judge_late, too_deep
  use contact_facing, only: mark_near, mark_facing
  use contact_grade, only: grade_place, settle_twins, finer_auto
  use contact_near, only: near_t, list_near, exchange_near, longest_list, turn_limit, is_behind
  use contact_overlap, only: true_gap, look_again, open_gap, update_front
  use contact_pairing, only: pairing_t, overlap_t, late_t, no_gap
  use contact_places, only: place_t, sight_t, view_t, find_places, size_sight, share_at_corner
  use contact_ramp, only: raise_places
  use contact_repeat, only: keep_place, repeat_place
  use contact_rows, only: rows_t, renew_gap
  use contact_surface, only: surface_t, shortest_edge_at
  use contact_tree, only: tree_t, build_tree, refit_tree
  use contact_whole, only: deepest_node, deepest_inner_point, deepest_crossing, &
      deepest_before_open, deepest_passage, accepted_overlap, note_node
  use model_data, only: model_t
  implicit none
  private

  type, extends(pairing_t), public :: pairing_node_t
    integer :: finer = finer_auto        !< side whose nodes are exact, by the deck
    logical :: is_self = .false.         !< side(1) against itself
    logical :: may_share = .false.       !< nodes may belong to both sides
    logical, allocatable :: leaves_out(:, :)   !< (parts, parts) do not touch; or empty
    type(tree_t) :: tree(2)
    type(near_t) :: near(2)              !< nodes of each side
    type(sight_t) :: sight               !< work space of one node
    type(place_t), allocatable :: place(:)
    integer :: places = 0
    integer :: repeated = 0              !< of them those of the last step, but for their gaps
    real(wp) :: reach = zero             !< they are no farther than this [L]
    logical :: is_measured = .false.     !< true gaps are those of the end of this step
  contains
    procedure :: list => node_list
    procedure :: mark_interface => node_mark_interface
    procedure :: mark_contact_nodes => node_mark_contact_nodes
    procedure :: find_places => node_find_places
    procedure :: append_rows => node_append_rows
    procedure :: renew_gaps => node_renew_gaps
    procedure :: find_late => node_find_late
    procedure :: measure => node_measure
    procedure :: find_passage => node_find_passage
    procedure :: measure_whole => node_measure_whole
    procedure :: exchange => node_exchange
  end type pairing_node_t

contains

  !> Sides whose nodes are watched: a surface against itself is one.
  pure integer function watched_sides(this)
    type(pairing_node_t), intent(in) :: this
    watched_sides = merge(1, 2, this%is_self)
  end function watched_sides

  !> The surface that the nodes of a side face.
  pure integer function facing_side(this, s)
    type(pairing_node_t), intent(in) :: this
    integer, intent(in) :: s
    facing_side = merge(1, 3 - s, this%is_self)
  end function facing_side

  subroutine node_list(this, model, u, reach)
    class(pairing_node_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    real(wp), intent(in) :: reach
    real(wp) :: distance
    logical :: turned, some_turned
    integer :: s
    call place_trees(this, model%x, u)
    this%safe_distance = huge(one)
    some_turned = .false.
    do s = 1, watched_sides(this)
      associate (obstacle => this%side(facing_side(this, s)))
        call list_near(this%side(s), obstacle, this%tree(facing_side(this, s)), model%x, u, &
            reach, this%is_self .or. this%may_share, this%leaves_out, this%near(s), distance, &
            turned)
      end associate
      this%safe_distance = min(this%safe_distance, distance)
      some_turned = some_turned .or. turned
    end do
    this%turn_margin = merge(turn_limit, huge(one), some_turned)
    this%listed = sum(this%near%n)
    call size_places(this)
  end subroutine node_list

  !> Work space for the lists as they are.
  subroutine size_places(this)
    type(pairing_node_t), intent(inout) :: this
    integer :: n
    call size_sight(max(size(this%side(1)%length), size(this%side(2)%length)), &
        max(longest_list(this%near(1)), longest_list(this%near(2))), this%sight)
    n = 3*this%listed + 3
    if (allocated(this%place)) then
      if (size(this%place) >= n) return
      deallocate (this%place)
    end if
    allocate (this%place(2*n))
  end subroutine size_places

  !> The trees of both sides at X + U.
  subroutine place_trees(this, x, u)
    type(pairing_node_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), allocatable :: a(:, :), b(:, :)
    integer :: s
    do s = 1, watched_sides(this)
      associate (e => this%side(s)%end_node)
        a = x(:, e(1, :)) + u(:, e(1, :))
        b = x(:, e(2, :)) + u(:, e(2, :))
      end associate
      if (.not. allocated(this%tree(s)%item)) call build_tree(a, b, this%tree(s))
      call refit_tree(a, b, this%tree(s))
    end do
  end subroutine place_trees

  !> The near nodes of both sides and the nodes of their edges.
  subroutine node_mark_interface(this, model, taken, carrier)
    class(pairing_node_t), intent(in) :: this
    type(model_t), intent(in) :: model
    logical, intent(inout) :: taken(:)
    integer, intent(inout) :: carrier(:)
    integer :: s
    do s = 1, watched_sides(this)
      call mark_near(this%side(s), this%side(facing_side(this, s)), this%near(s), taken, &
          carrier)
    end do
  end subroutine node_mark_interface

  !> Nodes of edges in front of which, along their normal and within their width, some part of
  !> the other surface stands.
  subroutine node_mark_contact_nodes(this, model, taken)
    class(pairing_node_t), intent(in) :: this
    type(model_t), intent(in) :: model
    logical, intent(inout) :: taken(:)
    integer :: s
    do s = 1, watched_sides(this)
      call mark_facing(model, this%side(s), this%side(facing_side(this, s)), taken)
    end do
  end subroutine node_mark_contact_nodes

  subroutine node_find_places(this, model, u, free, is_same)
    class(pairing_node_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :), free(:, :)
    logical, intent(out) :: is_same
    type(view_t) :: view
    integer :: s, n_first, before
    before = this%places
    is_same = .false.
    this%places = 0
    this%repeated = 0
    this%is_measured = .false.
    if (this%listed == 0) return
    view = near_view(this)
    view%reach = view%reach + 2.0_wp*relative_motion(this, free)
    this%reach = view%reach
    n_first = 0
    do s = 1, watched_sides(this)
      call find_side(this, model, s, u, free, view)
      if (s == 1) n_first = this%places
    end do
    if (this%places > 1) call settle_twins(this%side, this%is_self, this%finer, model%x, u, &
        this%place, n_first, this%places)
    if (allocated(this%ramp)) call raise_places(this%ramp, this%place(:this%places))
    is_same = this%repeated == this%places .and. this%places == before
  end subroutine node_find_places

  !> Bound of the motion of any two near nodes relative to each other [L].
  pure real(wp) function relative_motion(this, free)
    type(pairing_node_t), intent(in) :: this
    real(wp), intent(in), contiguous :: free(:, :)
    real(wp) :: mean(2), d(2), spread
    integer :: s, i
    mean = zero
    do s = 1, 2
      do i = 1, this%near(s)%n
        mean = mean + free(:, this%side(s)%node(this%near(s)%node(i)))
      end do
    end do
    mean = mean/real(this%listed, wp)
    spread = zero
    do s = 1, 2
      do i = 1, this%near(s)%n
        d = free(:, this%side(s)%node(this%near(s)%node(i))) - mean
        spread = max(spread, d(1)**2 + d(2)**2)
      end do
    end do
    relative_motion = 2.0_wp*sqrt(spread)
  end function relative_motion

  !> Places of the near nodes of a side.
  subroutine find_side(this, model, s, u, free, view)
    type(pairing_node_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    integer, intent(in) :: s
    real(wp), intent(in), contiguous :: u(:, :), free(:, :)
    type(view_t), intent(in) :: view
    real(wp) :: gap
    integer :: i, edge
    logical :: is_same
    associate (near => this%near(s), own => this%side(s), &
        obstacle => this%side(facing_side(this, s)))
      do i = 1, near%n
        if (near%distance(i) > view%reach) cycle
        call repeat_place(own, obstacle, near%node(i), model%x, u, view%is_reference, &
            view%reach, near%last(i), is_same)
        if (is_same) then
          this%repeated = this%repeated + 1
          call add_place(this, near%last(i)%place, near%distance(i))
          cycle
        end if
        associate (list => near%edge(near%first(i):near%first(i + 1) - 1))
          if (.not. obstacle%is_closed) then
            call open_gap(own, obstacle, near%node(i), list, model%x, u, gap, edge)
            call update_front(gap, this%penetration_tolerance*obstacle%mean_length, &
                near%front(i))
            if (near%front(i) == is_behind) cycle
          end if
          call find_places(own, obstacle, near%node(i), list, model%x, u, view, this%sight, &
              free)
        end associate
        associate (place => this%sight%place(:this%sight%places))
          if (any(place%gap < -place%allowance)) call find_distance(this, model%x, u, s, i)
        end associate
        call take_places(this, s, near%node(i), near%distance(i))
        near%last(i)%is_set = .false.
        if (this%places > 0 .and. obstacle%is_closed) call keep_place(own%node(near%node(i)), &
            near%first(i + 1) - near%first(i), this%sight%places, this%place(this%places), &
            this%sight%cone, near%last(i))
      end do
    end associate
  end subroutine find_side

  !> The true gap of near node i of a side, where a new list has forgotten it.
  pure subroutine find_distance(this, x, u, s, i)
    type(pairing_node_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: s, i
    real(wp) :: gap
    integer :: edge
    associate (near => this%near(s), obstacle => this%side(facing_side(this, s)))
      if (.not. obstacle%is_closed .or. near%distance(i) > -huge(one)) return
      call true_gap(obstacle, near%edge(near%first(i):near%first(i + 1) - 1), x, u, &
          this%side(s)%node(near%node(i)), gap, edge)
      if (gap < zero) call look_again(this%side(s), obstacle, this%is_self, near%node(i), x, &
          u, gap, edge)
      near%distance(i) = gap
    end associate
  end subroutine find_distance

  !> Keeps the places of a node with their grades. A node that is outside has no place that is
  !> deeper than its allowance: that is the far side of a thin body.
  subroutine take_places(this, s, k, distance)
    type(pairing_node_t), intent(inout) :: this
    integer, intent(in) :: s, k
    real(wp), intent(in) :: distance
    type(place_t) :: place
    integer :: j
    associate (own => this%side(s), obstacle => this%side(facing_side(this, s)))
      do j = 1, this%sight%places
        place = this%sight%place(j)
        place%side = s
        call grade_place(own, obstacle, k, this%finer, this%sight%cone, place)
        call add_place(this, place, distance)
      end do
    end associate
  end subroutine take_places

  !> Keeps a place, if its node at that distance may have it. Corners of flush bodies that
  !> overlap are on the boundary.
  subroutine add_place(this, place, distance)
    type(pairing_node_t), intent(inout) :: this
    type(place_t), intent(in) :: place
    real(wp), intent(in) :: distance
    if (distance > zero .and. place%gap < -place%allowance .and. .not. this%may_overlap) &
        return
    if (this%places == size(this%place)) this%place = [this%place, this%place]
    this%places = this%places + 1
    this%place(this%places) = place
  end subroutine add_place

  !> Rows of the exact places; those of the others are kept apart.
  subroutine node_append_rows(this, rows, spare)
    class(pairing_node_t), intent(inout) :: this
    type(rows_t), intent(inout) :: rows, spare
    integer :: j
    do j = 1, this%places
      associate (place => this%place(j), &
          obstacle => this%side(facing_side(this, this%place(j)%side)))
        if (place%is_exact) then
          call emit_row(this%number, obstacle, this%friction%static, place, rows)
        else
          call emit_row(this%number, obstacle, this%friction%static, place, spare)
        end if
      end associate
    end do
  end subroutine node_append_rows

  subroutine node_renew_gaps(this, rows, a, spare, b, is_same)
    class(pairing_node_t), intent(in) :: this
    type(rows_t), intent(inout) :: rows, spare
    integer, intent(inout) :: a, b
    logical, intent(inout) :: is_same
    integer :: j
    do j = 1, this%places
      if (this%place(j)%is_exact) then
        call renew_gap(rows, a, this%place(j)%node, this%place(j)%gap, is_same)
      else
        call renew_gap(spare, b, this%place(j)%node, this%place(j)%gap, is_same)
      end if
    end do
  end subroutine node_renew_gaps

  !> Nodes that are deeper at the end of the step than what they may: their places there, as
  !> new rows or as new frames of the rows they have.
  subroutine node_find_late(this, model, u0, u1, rows, late, n)
    class(pairing_node_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u0(:, :), u1(:, :)
    type(rows_t), intent(in) :: rows
    type(late_t), intent(inout) :: late(:)
    integer, intent(inout) :: n
    integer :: s, j, n_first
    logical :: some_deep
    some_deep = .false.
    do s = 1, watched_sides(this)
      if (.not. some_deep) call find_end(this, model, s, u1, .false., some_deep)
    end do
    this%is_measured = .not. some_deep
    if (.not. some_deep) return
    ! All places: what meets a deep node decides which of the two has the row.
    this%places = 0
    do s = 1, watched_sides(this)
      call find_end(this, model, s, u1, .true., some_deep)
      if (s == 1) n_first = this%places
    end do
    if (this%places > 1) call settle_twins(this%side, this%is_self, this%finer, model%x, &
        u1, this%place, n_first, this%places)
    if (allocated(this%ramp)) call raise_places(this%ramp, this%place(:this%places))
    do j = 1, this%places
      call judge_late(this%number, this%side(facing_side(this, this%place(j)%side)), model%x, &
          u0, this%place(j), rows, late, n)
    end do
  end subroutine node_find_late

  !> Places of the near nodes of a side at the end of the step: of all, or only until one of
  !> them is too deep.
  subroutine find_end(this, model, s, u, is_all, some_deep)
    type(pairing_node_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    integer, intent(in) :: s
    real(wp), intent(in), contiguous :: u(:, :)
    logical, intent(in) :: is_all
    logical, intent(inout) :: some_deep
    type(view_t) :: view
    real(wp) :: gap
    integer :: i, edge
    view = near_view(this)
    associate (near => this%near(s), own => this%side(s), &
        obstacle => this%side(facing_side(this, s)))
      do i = 1, near%n
        if (near%front(i) == is_behind) cycle
        associate (list => near%edge(near%first(i):near%first(i + 1) - 1))
          call true_gap(obstacle, list, model%x, u, own%node(near%node(i)), gap, edge)
          if (gap < -least_allowance(own, obstacle, near%node(i))) call look_again(own, &
              obstacle, this%is_self, near%node(i), model%x, u, gap, edge)
          near%distance(i) = gap
          near%nearest(i) = edge
          if (gap >= zero .and. .not. is_all) cycle
          if (gap < zero) then
            if (gap >= -least_allowance(own, obstacle, near%node(i))) gap = tiny(one)
          end if
          if (gap > merge(view%reach, zero, is_all)) cycle
          call find_places(own, obstacle, near%node(i), list, model%x, u, view, this%sight)
        end associate
        if (is_all) call take_places(this, s, near%node(i), gap)
        associate (place => this%sight%place(:this%sight%places))
          some_deep = some_deep .or. any(place%gap < -too_deep*place%allowance)
        end associate
        if (some_deep .and. .not. is_all) return
      end do
    end associate
  end subroutine find_end

  !> What is nearer than a quarter of the shortest edge: all that matters at the end of a step.
  pure type(view_t) function near_view(this)
    type(pairing_node_t), intent(in) :: this
    near_view%may_share = this%is_self .or. this%may_share
    near_view%is_reference = this%is_reference
    near_view%reach = &
        0.25_wp*min(this%side(1)%shortest, this%side(facing_side(this, 1))%shortest)
  end function near_view

  !> No node may be less deep than this and still need a row [L].
  pure real(wp) function least_allowance(own, obstacle, k)
    type(surface_t), intent(in) :: own, obstacle
    integer, intent(in) :: k
    least_allowance = too_deep*share_at_corner &
        *min(obstacle%shortest, shortest_edge_at(own, k, obstacle%shortest))
  end function least_allowance

  !> True gaps at the end of a step, the smallest in sums; the deepest overlap.
  subroutine node_measure(this, model, u, overlap)
    class(pairing_node_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    type(overlap_t), intent(inout) :: overlap
    real(wp) :: gap
    integer :: s, i, edge
    do s = 1, watched_sides(this)
      associate (near => this%near(s), own => this%side(s), &
          obstacle => this%side(facing_side(this, s)))
        do i = 1, near%n
          associate (list => near%edge(near%first(i):near%first(i + 1) - 1))
            if (obstacle%is_closed) then
              gap = near%distance(i)
              edge = near%nearest(i)
              if (.not. this%is_measured) call true_gap(obstacle, list, model%x, u, &
                  own%node(near%node(i)), gap, edge)
              if (gap < zero) call look_again(own, obstacle, this%is_self, near%node(i), &
                  model%x, u, gap, edge)
            else
              call open_gap(own, obstacle, near%node(i), list, model%x, u, gap, edge)
              if (near%front(i) == is_behind) gap = huge(one)
            end if
          end associate
          near%distance(i) = gap
          if (.not. obstacle%is_closed) near%distance(i) = -huge(one)
          if (edge == 0) cycle
          this%sums%smallest_gap = min(this%sums%smallest_gap, gap)
          if (allocated(this%nodal)) &
              this%nodal%gap(this%nodal%first(s) + near%node(i)) = min(gap, no_gap)
          if (gap < zero) call note_node(overlap, -gap, own, near%node(i), obstacle, edge)
        end do
      end associate
    end do
  end subroutine node_measure

  !> Near nodes that stand outside a closed side: were they inside within the step?
  subroutine node_find_passage(this, model, u, du, overlap)
    class(pairing_node_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :), du(:, :)
    type(overlap_t), intent(inout) :: overlap
    integer :: s
    do s = 1, merge(0, 2, this%is_self)
      if (this%side(3 - s)%is_closed) call deepest_passage(this%side(s), this%side(3 - s), &
          this%near(s), model%x, u, du, overlap)
    end do
  end subroutine node_find_passage

  !> All nodes and edges of closed sides; of open ones what stands just behind them.
  subroutine node_measure_whole(this, model, u, overlap, accepted)
    class(pairing_node_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    type(overlap_t), intent(inout) :: overlap
    real(wp), intent(out) :: accepted
    logical :: found
    integer :: s, t
    call place_trees(this, model%x, u)
    found = .false.
    do s = 1, watched_sides(this)
      t = facing_side(this, s)
      if (this%side(t)%is_closed) then
        call deepest_node(this%side(s), this%side(t), this%tree(t), model%x, u, this%is_self, &
            this%leaves_out, overlap, found)
        if (.not. found) call deepest_inner_point(this%side(s), this%side(t), this%tree(t), &
            model%x, u, this%is_self, this%leaves_out, overlap)
      else if (.not. this%is_born) then
        call deepest_before_open(this%side(s), this%side(t), this%near(s), model%x, u, &
            overlap)
      end if
    end do
    if (.not. found .and. this%side(1)%is_closed .and. &
        this%side(facing_side(this, 1))%is_closed) call deepest_crossing(this%side(1), &
        this%side(facing_side(this, 1)), &
        this%tree(facing_side(this, 1)), model%x, u, this%leaves_out, overlap)
    accepted = accepted_overlap(this%side, this%penetration_tolerance, model%x, u)
  end subroutine node_measure_whole

  subroutine node_exchange(this, archive)
    class(pairing_node_t), intent(inout) :: this
    type(archive_t), intent(inout) :: archive
    call archive%exchange('node.turn_margin', this%turn_margin)
    call archive%exchange('node.listed', this%listed)
    call archive%exchange('node.is_measured', this%is_measured)
    call exchange_near(archive, this%near(1))
    call exchange_near(archive, this%near(2))
    if (archive%mode == archive_restore) call size_places(this)
  end subroutine node_exchange

end module contact_node
