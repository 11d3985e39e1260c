! SPDX-License-Identifier: BSD-3-Clause
!> The pairing of a rigid obstacle of some shape: an analytic surface that moves with a node of
!> its own. The node is held, or its motion is given, or it has a mass; its rows stand between
!> it and a node of the bodies, or an edge where the obstacle has tips (the ends of a finite
!> wall, a disc), so that its motion, its work and its inertia are those of any node. A shape
!> is an extension that says what a point near it sees (contact_flat, contact_cylinder).
module contact_obstacle
  use base_archive, only: archive_t, archive_restore
  use base_kinds, only: wp, zero, one, half
  use contact_pairing, only: pairing_t, overlap_t, late_t, note_overlap
  use contact_rows, only: rows_t, add_row, renew_gap, row_wall, row_guided
  use contact_tips, only: tips_t, list_edges, find_edges, append_edges, measure_edges, &
      deepest_tip, has_edges, exchange_edges
  use model_data, only: model_t, wall_t
  implicit none
  private

  type, abstract, extends(pairing_t), public :: obstacle_t
    integer :: body = 0                   !< its node
    logical :: is_guided = .false.        !< slides along its normal, which alone moves it
    logical :: is_curved = .false.        !< normals differ from place to place
    logical :: is_sheet = .false.         !< nodes may be behind it that went round its ends
    logical :: is_mid = .false.           !< normals of the middle of the step
    type(tips_t) :: tips
    integer :: near = 0                   !< nodes that are near
    integer, allocatable :: row(:)        !< their rows in the side, increasing
    real(wp), allocatable :: gap(:)       !< (near) [L]
    real(wp), allocatable :: normal(:, :) !< (2, near) of their rows
    logical, allocatable :: stands(:)     !< (near) there is a row
    logical, allocatable :: is_behind(:)  !< (nodes of the side) of a sheet
    logical :: is_new = .true.            !< the list is another one than in the last step
  contains
    procedure(set_i), deferred :: set_shape
    procedure(distance_i), deferred :: distance
    procedure(place_i), deferred :: place
    procedure(mean_i), deferred :: mean_normal
    procedure :: list => obstacle_list
    procedure :: mark_interface => obstacle_mark_interface
    procedure :: mark_contact_nodes => obstacle_mark_contact_nodes
    procedure :: find_places => obstacle_find_places
    procedure :: append_rows => obstacle_append_rows
    procedure :: renew_gaps => obstacle_renew_gaps
    procedure :: find_late => obstacle_find_late
    procedure :: measure => obstacle_measure
    procedure :: measure_whole => obstacle_measure_whole
    procedure :: exchange => obstacle_exchange
  end type obstacle_t

  abstract interface
    !> The shape that a card gives.
    subroutine set_i(this, wall)
      import :: obstacle_t, wall_t
      class(obstacle_t), intent(inout) :: this
      type(wall_t), intent(in) :: wall
    end subroutine set_i
    !> A bound from below of the distance of a point p [L]; points are seen from the body.
    pure real(wp) function distance_i(this, p)
      import :: obstacle_t, wp
      class(obstacle_t), intent(in) :: this
      real(wp), intent(in) :: p(2)
    end function distance_i
    !> The gap of a point [L] and its gradient; is_there: the obstacle has a place for it.
    pure subroutine place_i(this, p, gap, normal, is_there)
      import :: obstacle_t, wp
      class(obstacle_t), intent(in) :: this
      real(wp), intent(in) :: p(2)
      real(wp), intent(out) :: gap, normal(2)
      logical, intent(out) :: is_there
    end subroutine place_i
    !> The normal m of a motion from p to q with m.(q - p) = the change of the gap.
    pure function mean_i(this, p, q) result(m)
      import :: obstacle_t, wp
      class(obstacle_t), intent(in) :: this
      real(wp), intent(in) :: p(2), q(2)
      real(wp) :: m(2)
    end function mean_i
  end interface

contains

  !> Where a node is at displacement u, seen from the obstacle [L]; reference part and motion
  !> apart.
  pure function seen(this, x, u, node) result(p)
    class(obstacle_t), intent(in) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: node
    real(wp) :: p(2)
    p = (x(:, node) - x(:, this%body)) + (u(:, node) - u(:, this%body))
  end function seen

  pure real(wp) function edge_length(this)
    class(obstacle_t), intent(in) :: this
    edge_length = max(this%side(1)%mean_length, tiny(one))
  end function edge_length

  !> The nodes nearer than half an edge, or four steps of the motion, and the edges that a tip
  !> may meet.
  subroutine obstacle_list(this, model, u, reach)
    class(obstacle_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    real(wp), intent(in) :: reach
    logical :: was_near(size(this%side(1)%node))
    real(wp) :: p(2), near_enough, distance, gap, normal(2)
    logical :: is_there
    integer :: k
    near_enough = reach
    if (.not. reach > this%side(1)%mean_length) near_enough = half*reach
    this%safe_distance = huge(one)
    this%is_new = .true.
    if (.not. allocated(this%row)) call size_lists(this)
    was_near = .not. this%is_born
    was_near(this%row(:this%near)) = .true.
    this%near = 0
    do k = 1, size(this%side(1)%node)
      p = seen(this, model%x, u, this%side(1)%node(k))
      distance = this%distance(p)
      if (distance <= near_enough) then
        this%near = this%near + 1
        this%row(this%near) = k
        if (.not. this%is_sheet .or. was_near(k)) cycle
        call this%place(p, gap, normal, is_there)
        this%is_behind(k) = gap < zero
      else
        this%safe_distance = min(this%safe_distance, distance)
      end if
    end do
    this%listed = this%near
    if (.not. has_edges(this%tips)) return
    call list_edges(this%tips, this%side(1), this%body, model%x, u, near_enough, &
        this%safe_distance)
    this%listed = this%near + this%tips%n
  end subroutine obstacle_list

  subroutine size_lists(this)
    class(obstacle_t), intent(inout) :: this
    integer :: n
    n = size(this%side(1)%node)
    allocate (this%row(n), this%gap(n), this%normal(2, n))
    allocate (this%stands(n), source=.false.)
    allocate (this%is_behind(merge(n, 0, this%is_sheet)), source=.false.)
  end subroutine size_lists

  subroutine obstacle_mark_interface(this, model, taken, carrier)
    class(obstacle_t), intent(in) :: this
    type(model_t), intent(in) :: model
    logical, intent(inout) :: taken(:)
    integer, intent(inout) :: carrier(:)
    integer :: i
    taken(this%body) = .true.
    taken(this%side(1)%node(this%row(:this%near))) = .true.
    do i = 1, this%tips%n
      taken(this%side(1)%end_node(:, this%tips%edge(i))) = .true.
    end do
  end subroutine obstacle_mark_interface

  !> Nodes of the edges that face the obstacle.
  subroutine obstacle_mark_contact_nodes(this, model, taken)
    class(obstacle_t), intent(in) :: this
    type(model_t), intent(in) :: model
    logical, intent(inout) :: taken(:)
    real(wp) :: middle(2), gap, normal(2)
    logical :: is_there
    integer :: e
    do e = 1, size(this%side(1)%length)
      if (.not. this%side(1)%is_listed(e)) cycle
      associate (a => this%side(1)%end_node(1, e), b => this%side(1)%end_node(2, e))
        middle = half*(model%x(:, a) + model%x(:, b)) - model%x(:, this%body)
        call this%place(middle, gap, normal, is_there)
        if (dot_product(this%side(1)%normal(:, e), normal) < -half) taken([a, b]) = .true.
      end associate
    end do
  end subroutine obstacle_mark_contact_nodes

  !> The start of the step, and for FRAME MID a guess of its end: where the free motion ends, or
  !> on the surface if that is behind it.
  subroutine obstacle_find_places(this, model, u, free, is_same)
    class(obstacle_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :), free(:, :)
    logical, intent(out) :: is_same
    logical :: stood
    integer :: i
    is_same = .not. (this%is_new .or. this%is_curved .or. this%tips%n > 0)
    do i = 1, this%near
      associate (node => this%side(1)%node(this%row(i)))
        stood = this%stands(i)
        call find_place(this, i, seen(this, model%x, u, node), &
            free(:, node) - free(:, this%body))
        is_same = is_same .and. (stood .eqv. this%stands(i))
      end associate
    end do
    if (this%tips%n > 0) call find_edges(this%tips, this%side(1), this%body, model%x, u, free)
    this%is_new = .false.
  end subroutine obstacle_find_places

  !> Gap, normal and row of near node i at p for a free motion f.
  subroutine find_place(this, i, p, f)
    class(obstacle_t), intent(inout) :: this
    integer, intent(in) :: i
    real(wp), intent(in) :: p(2), f(2)
    real(wp) :: q(2), gap, normal(2)
    logical :: ends_there
    call this%place(p, this%gap(i), this%normal(:, i), this%stands(i))
    if (this%is_sheet) then
      associate (is_behind => this%is_behind(this%row(i)))
        if (.not. this%stands(i)) is_behind = this%gap(i) < zero
        if (this%stands(i) .and. .not. this%gap(i) < zero) is_behind = .false.
        call this%place(p + f, gap, normal, ends_there)
        this%stands(i) = (this%stands(i) .or. ends_there) .and. .not. is_behind
      end associate
    end if
    if (.not. (this%is_curved .and. this%is_mid)) return
    q = p + f
    call this%place(q, gap, normal, ends_there)
    if (gap < zero) q = q - gap*normal
    this%normal(:, i) = this%mean_normal(p, q)
  end subroutine find_place

  subroutine obstacle_append_rows(this, rows, spare)
    class(obstacle_t), intent(inout) :: this
    type(rows_t), intent(inout) :: rows, spare
    integer :: i
    do i = 1, this%near
      if (.not. this%stands(i)) cycle
      associate (node => this%side(1)%node(this%row(i)))
        call add_row(rows, [this%number, 1, node, 0], [node, this%body], [one, -one], &
            this%normal(:, i), this%gap(i), this%friction%static, edge_length(this), &
            merge(row_guided, row_wall, this%is_guided), zero)
      end associate
    end do
    if (this%tips%n > 0) call append_edges(this%tips, this%side(1), this%number, this%body, &
        this%friction%static, rows, spare)
  end subroutine obstacle_append_rows

  subroutine obstacle_renew_gaps(this, rows, a, spare, b, is_same)
    class(obstacle_t), intent(in) :: this
    type(rows_t), intent(inout) :: rows, spare
    integer, intent(inout) :: a, b
    logical, intent(inout) :: is_same
    integer :: i
    do i = 1, this%near
      if (this%stands(i)) call renew_gap(rows, a, this%side(1)%node(this%row(i)), &
          this%gap(i), is_same)
    end do
    is_same = is_same .and. this%tips%n == 0
  end subroutine obstacle_renew_gaps

  !> Rows that push, or should, whose normals are not those of the motion of the step: with
  !> them n.dU is the change of the gap to the last digit (discrete gradient), so that a
  !> smooth surface takes and gives no energy.
  subroutine obstacle_find_late(this, model, u0, u1, rows, late, n)
    class(obstacle_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u0(:, :), u1(:, :)
    type(rows_t), intent(in) :: rows
    type(late_t), intent(inout) :: late(:)
    integer, intent(inout) :: n
    real(wp), parameter :: same_normal = 1.0e-13_wp
    real(wp) :: p(2), q(2), m(2), gap
    logical :: is_there
    integer :: a
    if (.not. (this%is_curved .and. this%is_mid)) return
    do a = 1, rows%n
      if (rows%key(1, a) /= this%number .or. rows%key(2, a) /= 1) cycle
      if (n == size(late)) exit
      p = seen(this, model%x, u0, rows%key(3, a))
      q = seen(this, model%x, u1, rows%key(3, a))
      call this%place(q, gap, m, is_there)
      if (.not. (rows%r(1, a) > zero .or. gap < zero)) cycle
      m = this%mean_normal(p, q)
      if (maxval(abs(m - rows%normal(:, a))) <= same_normal) cycle
      n = n + 1
      late(n) = late_t(row=a, key=rows%key(:, a), points=2, &
          point=[rows%key(3, a), this%body, 0, 0, 0], &
          weight=[one, -one, zero, zero, zero], normal=[m, zero], &
          gap=rows%gap(a), length=rows%length(a), kind=rows%kind(a))
    end do
  end subroutine obstacle_find_late

  subroutine obstacle_measure(this, model, u, overlap)
    class(obstacle_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    type(overlap_t), intent(inout) :: overlap
    integer :: i
    do i = 1, this%near
      call measure_node(this, model, u, this%row(i), .true., overlap)
    end do
    if (this%tips%n > 0) call measure_edges(this%tips, this%side(1), this%body, model%x, u, &
        this%sums%smallest_gap, overlap)
  end subroutine obstacle_measure

  !> The true gap of a node. keeps: into the sums and the table too.
  subroutine measure_node(this, model, u, k, keeps, overlap)
    class(obstacle_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    integer, intent(in) :: k
    logical, intent(in) :: keeps
    type(overlap_t), intent(inout) :: overlap
    real(wp) :: gap, normal(2), length
    logical :: is_there
    call this%place(seen(this, model%x, u, this%side(1)%node(k)), gap, normal, is_there)
    if (.not. is_there) return
    if (this%is_sheet) then
      if (this%is_behind(k)) return
    end if
    if (keeps) then
      this%sums%smallest_gap = min(this%sums%smallest_gap, gap)
      if (allocated(this%nodal)) this%nodal%gap(this%nodal%first(1) + k) = gap
    end if
    if (.not. gap < zero) return
    length = edge_length(this)
    if (keeps .and. all(this%side(1)%chain(:, k) > 0)) &
        length = minval(this%side(1)%chain_length(:, k))
    call note_overlap(overlap, -gap, length, this%side(1)%node(k), 0, .false.)
  end subroutine measure_node

  !> All nodes; of a sheet, once it is born, those that are near: others may be behind it.
  subroutine obstacle_measure_whole(this, model, u, overlap, accepted)
    class(obstacle_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    type(overlap_t), intent(inout) :: overlap
    real(wp), intent(out) :: accepted
    real(wp) :: far
    integer :: i, k
    far = zero
    do k = 1, size(this%side(1)%node)
      far = max(far, sum(seen(this, model%x, u, this%side(1)%node(k))**2))
      if (.not. (this%is_sheet .and. this%is_born)) &
          call measure_node(this, model, u, k, .false., overlap)
    end do
    if (this%is_sheet .and. this%is_born) then
      do i = 1, this%near
        call measure_node(this, model, u, this%row(i), .false., overlap)
      end do
    end if
    if (has_edges(this%tips)) &
        call deepest_tip(this%tips, this%side(1), this%body, model%x, u, overlap)
    accepted = min(1.0e-3_wp*edge_length(this), max(this%penetration_tolerance &
        *edge_length(this), 1.0e-7_wp*sqrt(far)))
  end subroutine obstacle_measure_whole

  subroutine obstacle_exchange(this, archive)
    class(obstacle_t), intent(inout) :: this
    type(archive_t), intent(inout) :: archive
    integer, allocatable :: behind(:)
    call archive%exchange('obstacle.near', this%near)
    if (archive%mode == archive_restore .and. .not. allocated(this%row)) call size_lists(this)
    if (allocated(this%row)) then
      call archive%exchange('obstacle.row', this%row(:this%near))
      if (this%is_sheet) then
        behind = merge(1, 0, this%is_behind)
        call archive%exchange('obstacle.behind', behind)
        this%is_behind = behind == 1
      end if
    end if
    if (has_edges(this%tips)) call exchange_edges(this%tips, archive)
    this%listed = this%near + this%tips%n
    this%is_new = .true.
  end subroutine obstacle_exchange

end module contact_obstacle
