! SPDX-License-Identifier: BSD-3-Clause
!> The pairing of a rigid plane wall: an analytic surface instead of edges. It stands still, and
!> its rows have one point, the node's; or in space it moves with a node of its own, which is
!> held, or whose motion is given, or that has a mass.
module contact_wall
  use base_archive, only: archive_t, archive_restore
  use base_kinds, only: wp, zero, one, half
  use contact_facets, only: corners_of
  use contact_near, only: near_t, exchange_near
  use contact_pairing, only: pairing_t, overlap_t, late_t, note_overlap
  use contact_rows, only: rows_t, add_row, renew_gap, row_wall, row_guided
  use model_data, only: model_t
  implicit none
  private

  type, extends(pairing_t), public :: pairing_wall_t
    real(wp), allocatable :: point(:)   !< on it [L]
    real(wp), allocatable :: normal(:)  !< toward the bodies
    integer :: body = 0                 !< its node; 0 = it stands still
    logical :: is_guided = .false.      !< slides along its normal, which alone moves it
    type(near_t) :: near
    real(wp), allocatable :: gap(:)     !< of the near nodes [L]
    logical :: is_new = .true.          !< the list is another one than in the last step
  contains
    procedure :: list => wall_list
    procedure :: mark_interface => wall_mark_interface
    procedure :: mark_contact_nodes => wall_mark_contact_nodes
    procedure :: find_places => wall_find_places
    procedure :: append_rows => wall_append_rows
    procedure :: renew_gaps => wall_renew_gaps
    procedure :: find_late => wall_find_late
    procedure :: measure => wall_measure
    procedure :: measure_whole => wall_measure_whole
    procedure :: weigh_nodes => wall_weigh_nodes
    procedure :: exchange => wall_exchange
  end type pairing_wall_t

contains

  !> Distance of a node in front of the wall [L], reference part and motion apart.
  pure real(wp) function wall_distance(this, x, u, node)
    type(pairing_wall_t), intent(in) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: node
    wall_distance = dot_product(this%normal, x(:, node) - this%point) &
        + dot_product(this%normal, u(:, node))
    if (this%body > 0) wall_distance = wall_distance - dot_product(this%normal, u(:, this%body))
  end function wall_distance

  !> The nodes nearer than half an edge, or four steps of their motion.
  subroutine wall_list(this, model, u, reach)
    class(pairing_wall_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    real(wp), intent(in) :: reach
    real(wp) :: near_enough, gap
    integer :: k
    near_enough = reach
    if (.not. reach > this%side(1)%mean_length) near_enough = half*reach
    this%safe_distance = huge(one)
    this%listed = 0
    this%is_new = .true.
    if (allocated(this%near%node)) deallocate (this%near%node)
    allocate (this%near%node(size(this%side(1)%node)))
    if (.not. allocated(this%gap)) allocate (this%gap(size(this%side(1)%node)))
    do k = 1, size(this%side(1)%node)
      gap = wall_distance(this, model%x, u, this%side(1)%node(k))
      if (gap <= near_enough) then
        this%listed = this%listed + 1
        this%near%node(this%listed) = k
      else
        this%safe_distance = min(this%safe_distance, gap)
      end if
    end do
    this%near%n = this%listed
  end subroutine wall_list

  subroutine wall_mark_interface(this, model, taken, carrier)
    class(pairing_wall_t), intent(in) :: this
    type(model_t), intent(in) :: model
    logical, intent(inout) :: taken(:)
    integer, intent(inout) :: carrier(:)
    taken(this%side(1)%node(this%near%node(:this%near%n))) = .true.
    if (this%body > 0 .and. this%near%n > 0) taken(this%body) = .true.
  end subroutine wall_mark_interface

  !> Nodes of the edges or facets that face the wall.
  subroutine wall_mark_contact_nodes(this, model, taken)
    class(pairing_wall_t), intent(in) :: this
    type(model_t), intent(in) :: model
    logical, intent(inout) :: taken(:)
    integer :: e
    associate (f => this%side(1)%facets)
      do e = 1, f%n
        if (.not. f%is_listed(e)) cycle
        if (dot_product(f%normal(:, e), this%normal) < -half) &
            taken(f%node(:corners_of(f, e), e)) = .true.
      end do
    end associate
    do e = 1, size(this%side(1)%length)
      if (.not. this%side(1)%is_listed(e)) cycle
      if (dot_product(this%side(1)%normal(:, e), this%normal) < -half) &
          taken(this%side(1)%end_node(:, e)) = .true.
    end do
  end subroutine wall_mark_contact_nodes

  subroutine wall_find_places(this, model, u, free, is_same)
    class(pairing_wall_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :), free(:, :)
    logical, intent(out) :: is_same
    integer :: i
    do i = 1, this%near%n
      this%gap(i) = wall_distance(this, model%x, u, this%side(1)%node(this%near%node(i)))
    end do
    is_same = .not. this%is_new
    this%is_new = .false.
  end subroutine wall_find_places

  subroutine wall_append_rows(this, rows, spare)
    class(pairing_wall_t), intent(inout) :: this
    type(rows_t), intent(inout) :: rows, spare
    integer :: i
    do i = 1, this%near%n
      associate (node => this%side(1)%node(this%near%node(i)))
        if (this%body == 0) then
          call add_row(rows, [this%number, 1, node, 0], [node], [one], this%normal, &
              this%gap(i), this%friction%static, edge_length(this), row_wall, zero)
        else
          call add_row(rows, [this%number, 1, node, 0], [node, this%body], [one, -one], &
              this%normal, this%gap(i), this%friction%static, edge_length(this), &
              merge(row_guided, row_wall, this%is_guided), zero)
        end if
      end associate
    end do
  end subroutine wall_append_rows

  subroutine wall_renew_gaps(this, rows, a, spare, b, is_same)
    class(pairing_wall_t), intent(in) :: this
    type(rows_t), intent(inout) :: rows, spare
    integer, intent(inout) :: a, b
    logical, intent(inout) :: is_same
    integer :: i
    do i = 1, this%near%n
      call renew_gap(rows, a, this%side(1)%node(this%near%node(i)), this%gap(i), is_same)
    end do
  end subroutine wall_renew_gaps

  pure real(wp) function edge_length(this)
    type(pairing_wall_t), intent(in) :: this
    edge_length = max(this%side(1)%mean_length, tiny(one))
  end function edge_length

  !> Every listed node has its row, and a plane does not turn.
  subroutine wall_find_late(this, model, u0, u1, rows, late, n)
    class(pairing_wall_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u0(:, :), u1(:, :)
    type(rows_t), intent(in) :: rows
    type(late_t), intent(inout) :: late(:)
    integer, intent(inout) :: n
  end subroutine wall_find_late

  subroutine wall_measure(this, model, u, overlap)
    class(pairing_wall_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    type(overlap_t), intent(inout) :: overlap
    integer :: i
    do i = 1, this%near%n
      call measure_node(this, model, u, this%near%node(i), overlap)
    end do
  end subroutine wall_measure

  subroutine measure_node(this, model, u, k, overlap)
    type(pairing_wall_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    integer, intent(in) :: k
    type(overlap_t), intent(inout) :: overlap
    real(wp) :: gap, length
    gap = wall_distance(this, model%x, u, this%side(1)%node(k))
    this%sums%smallest_gap = min(this%sums%smallest_gap, gap)
    if (allocated(this%nodal)) this%nodal%gap(this%nodal%first(1) + k) = gap
    if (.not. gap < zero) return
    length = edge_length(this)
    if (all(this%side(1)%chain(:, k) > 0)) length = minval(this%side(1)%chain_length(:, k))
    call note_overlap(overlap, -gap, length, this%side(1)%node(k), 0, .false.)
  end subroutine measure_node

  subroutine wall_measure_whole(this, model, u, overlap, accepted)
    class(pairing_wall_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    type(overlap_t), intent(inout) :: overlap
    real(wp), intent(out) :: accepted
    real(wp) :: far, gap
    integer :: k
    far = zero
    do k = 1, size(this%side(1)%node)
      associate (node => this%side(1)%node(k))
        gap = wall_distance(this, model%x, u, node)
        far = max(far, sum((model%x(:, node) + u(:, node) - this%point)**2))
        if (gap < zero) call note_overlap(overlap, -gap, edge_length(this), node, 0, .false.)
      end associate
    end do
    accepted = min(1.0e-3_wp*edge_length(this), max(this%penetration_tolerance &
        *edge_length(this), 1.0e-7_wp*sqrt(far)))
  end subroutine wall_measure_whole

  !> In space, areas of near nodes: what belongs to them of the facets that face the wall.
  subroutine wall_weigh_nodes(this, model, area)
    class(pairing_wall_t), intent(in) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(inout) :: area(:)
    integer :: e, k
    associate (f => this%side(1)%facets)
      do e = 1, f%n
        if (.not. f%is_listed(e)) cycle
        if (.not. dot_product(f%normal(:, e), this%normal) < -half) cycle
        do k = 1, corners_of(f, e)
          associate (at => this%nodal%first(1) + this%side(1)%index(f%node(k, e)))
            if (this%nodal%is_near(at)) area(at) = area(at) + f%share(k, e)
          end associate
        end do
      end do
    end associate
  end subroutine wall_weigh_nodes

  subroutine wall_exchange(this, archive)
    class(pairing_wall_t), intent(inout) :: this
    type(archive_t), intent(inout) :: archive
    integer :: n
    n = this%near%n
    call archive%exchange('wall.n', n)
    if (archive%mode == archive_restore) then
      if (allocated(this%near%node)) deallocate (this%near%node)
      allocate (this%near%node(n))
      if (.not. allocated(this%gap)) allocate (this%gap(size(this%side(1)%node)))
      this%near%n = n
    end if
    call archive%exchange('wall.node', this%near%node(:n))
    this%listed = n
  end subroutine wall_exchange

end module contact_wall
