! SPDX-License-Identifier: BSD-3-Clause
!> Places, crossings and rows of bodies in space: at the start of a step, and those that its
!> solved end shows to be missing.
module contact_space_step
  use base_kinds, only: wp, zero, one
  use contact_emit, only: too_deep
  use contact_near, only: is_behind
  use contact_overlap, only: update_front
  use contact_pairing, only: late_t
  use contact_places, only: view_t, share_of_edge
  use contact_rows, only: rows_t
  use contact_space_base, only: space_t, watched_sides, facing_side, view_of, find_crossings
  use contact_space_emit, only: emit_place, emit_crossing, judge_late_place, judge_late_crossing
  use contact_space_grade, only: grade_in_space, settle_in_space
  use contact_space_monitor, only: find_gaps, find_gap, open_gap, least_allowance
  use contact_space_places, only: find_space_places
  use model_data, only: model_t
  implicit none
  private

  public :: find_all_places, append_all_rows, find_late_rows

contains

  !> Places of all near nodes and crossings of all near edges at displacement u, for the free
  !> motion of the step.
  subroutine find_all_places(this, model, u, free)
    class(space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :), free(:, :)
    type(view_t) :: view
    integer :: s, n_first
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
  end subroutine find_all_places

  !> Bound of the motion of any two near nodes relative to each other [L].
  pure real(wp) function relative_motion(this, free)
    class(space_t), intent(in) :: this
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
    class(space_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: n_first
    call settle_in_space(this%skin(1), this%skin(facing_side(this, 1)), this%is_self, &
        this%finer, x, u, this%place(:this%places), n_first, this%first)
  end subroutine settle

  !> Places of the near nodes of a side.
  subroutine find_side(this, model, s, u, view, free)
    class(space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    integer, intent(in) :: s
    real(wp), intent(in), contiguous :: u(:, :), free(:, :)
    type(view_t), intent(in) :: view
    real(wp) :: gap
    integer :: i, t, facet
    t = facing_side(this, s)
    associate (near => this%near(s), own => this%skin(s), obstacle => this%skin(t))
      do i = 1, near%n
        if (is_far(near%distance(i), view%reach)) cycle
        associate (list => near%edge(near%first(i):near%first(i + 1) - 1), &
            node => this%side(s)%node(near%node(i)))
          if (.not. obstacle%is_closed) then
            call open_gap(this, model%x, u, s, node, list, gap, facet)
            ! A node that was beyond the rim may come back as deep as one without a row may be.
            call update_front(gap, max(this%penetration_tolerance, too_deep*share_of_edge) &
                *this%side(t)%mean_length, near%front(i))
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

  !> Is a node too far for a row? One that is before no facet of an open obstacle has no gap,
  !> but may be at its rim.
  pure logical function is_far(gap, reach)
    real(wp), intent(in) :: gap, reach
    is_far = gap > reach .and. gap < huge(one)
  end function is_far

  !> Keeps the places of a node with their grades. A node that is outside has no place that is
  !> deeper than its allowance: that is the far side of a thin body.
  subroutine take_places(this, s, distance)
    class(space_t), intent(inout) :: this
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

  !> Rows of the exact places and crossings; those that have an allowance are kept apart.
  subroutine append_all_rows(this, rows, spare)
    class(space_t), intent(inout) :: this
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
  end subroutine append_all_rows

  !> The key of the row of pair k: the first node of the contactor's edge; which of the edges
  !> there, and the obstacle's edge.
  pure function key_of(this, k) result(key)
    class(space_t), intent(in) :: this
    integer, intent(in) :: k
    integer :: key(4), v, t, which
    t = facing_side(this, 1)
    associate (skin => this%skin(1), a => this%pairs%a(k))
      v = skin%at(skin%ends(1, a))
      which = findloc(skin%edge(skin%first_edge(v):skin%first_edge(v + 1) - 1), a, dim=1)
      key = [this%number, 1, skin%ends(1, a), &
          this%skin(t)%facets + this%pairs%b(k) + this%skin(t)%edges*(which - 1)]
    end associate
  end function key_of

  !> Nodes and crossings that are deeper at the end of the step than what they may: their places
  !> there, as new rows or as new frames of the rows they have.
  subroutine find_late_rows(this, model, u0, u1, rows, late, n)
    class(space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u0(:, :), u1(:, :)
    type(rows_t), intent(in) :: rows
    type(late_t), intent(inout) :: late(:)
    integer, intent(inout) :: n
    integer :: s, j, k, n_first
    logical :: some_deep
    some_deep = .false.
    do s = 1, watched_sides(this)
      call find_gaps(this, model%x, s, u1, some_deep)
    end do
    this%is_measured = .true.
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
        call judge_late_place(this%number, model%x, u0, this%place(j), rows, late, n)
        j = j + 1
      end do
      if (k > this%pairs%n) exit
      if (this%crossing(k)%is_valid) call judge_late_crossing(key_of(this, k), model%x, u0, &
          this%crossing(k), rows, late, n)
    end do
  end subroutine find_late_rows

  !> All places of the near nodes of a side at the end of the step.
  subroutine find_end(this, x, s, u)
    class(space_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: s
    type(view_t) :: view
    real(wp) :: gap
    integer :: i
    view = view_of(this)
    associate (near => this%near(s))
      do i = 1, near%n
        gap = near%distance(i)
        if (near%front(i) == is_behind .or. is_far(gap, view%reach)) cycle
        if (gap < zero .and. gap >= -least_allowance(this, s, near%node(i))) gap = tiny(one)
        call find_space_places(this%skin(s), this%skin(facing_side(this, s)), &
            this%side(s)%node(near%node(i)), near%edge(near%first(i):near%first(i + 1) - 1), &
            x, u, view, this%sight)
        call take_places(this, s, gap)
      end do
    end associate
  end subroutine find_end

end module contact_space_step
