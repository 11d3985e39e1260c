! SPDX-License-Identifier: BSD-3-Clause
!> The pairing NODE of bodies in space: nodes of both sides are watched against the facets of
!> the other, sharp edges of both against each other; within a single surface of several bodies
!> against all other facets and edges.
module contact_space
  use base_archive, only: archive_t, archive_restore
  use base_kinds, only: wp, zero, one, half
  use contact_near, only: exchange_near, longest_list, turn_limit
  use contact_pairing, only: overlap_t, late_t, no_gap
  use contact_rows, only: rows_t
  use contact_space_base, only: space_t, watched_sides, facing_side, place_trees
  use contact_space_edges, only: list_edge_pairs, exchange_edge_pairs
  use contact_space_monitor, only: measure_near, find_passages, measure_all
  use contact_space_near, only: list_near_in_space, mark_near_in_space, mark_pairs
  use contact_space_step, only: find_all_places, append_all_rows, find_late_rows
  use contact_space_tree, only: least_distance
  use contact_space_view, only: size_space_sight
  use model_data, only: model_t
  implicit none
  private

  type, extends(space_t), public :: pairing_space_t
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

  subroutine space_list(this, model, u, reach)
    class(pairing_space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    real(wp), intent(in) :: reach
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
      call size_space_sight(this%skin(1), this%skin(t), 1, this%sight)
      do s = 1, watched_sides(this)
        t = facing_side(this, s)
        call list_near_in_space(this%side(s), this%skin(s), this%skin(t), this%facets(t), &
            model%x, u, reach, this%is_self .or. this%may_share, this%leaves_out, &
            this%sight%fan, this%near(s))
      end do
      t = facing_side(this, 1)
      if (this%watches_edges) call list_edge_pairs(this%skin(1), this%skin(t), &
          this%edges(1), this%edges(t), reach, this%is_self, this%leaves_out, this%pairs)
      ! Facets that do not face may come to, edges that are flat may become sharp.
      this%turn_margin = half*turn_limit
    end if
    this%listed = sum(this%near%n) + this%pairs%n
    call size_places(this)
  end subroutine space_list

  !> Nodes without a facet of their own are in no tree.
  pure logical function has_lone_nodes(this)
    class(space_t), intent(in) :: this
    integer :: s
    has_lone_nodes = .false.
    do s = 1, watched_sides(this)
      has_lone_nodes = has_lone_nodes .or. any(this%skin(s)%at(this%side(s)%node) == 0)
    end do
  end function has_lone_nodes

  !> Work space for the lists as they are.
  subroutine size_places(this)
    class(space_t), intent(inout) :: this
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

  !> Nodes of facets that look at the other surface: its middle stands in front of them, and
  !> some facet of it faces them.
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
    is_same = .false.
    call find_all_places(this, model, u, free)
  end subroutine space_find_places

  subroutine space_append_rows(this, rows, spare)
    class(pairing_space_t), intent(inout) :: this
    type(rows_t), intent(inout) :: rows, spare
    call append_all_rows(this, rows, spare)
  end subroutine space_append_rows

  subroutine space_find_late(this, model, u0, u1, rows, late, n)
    class(pairing_space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u0(:, :), u1(:, :)
    type(rows_t), intent(in) :: rows
    type(late_t), intent(inout) :: late(:)
    integer, intent(inout) :: n
    call find_late_rows(this, model, u0, u1, rows, late, n)
  end subroutine space_find_late

  subroutine space_measure(this, model, u, overlap)
    class(pairing_space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    type(overlap_t), intent(inout) :: overlap
    call measure_near(this, model, u, overlap)
  end subroutine space_measure

  subroutine space_find_passage(this, model, u, du, overlap)
    class(pairing_space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :), du(:, :)
    type(overlap_t), intent(inout) :: overlap
    call find_passages(this, model, u, du, overlap)
  end subroutine space_find_passage

  subroutine space_measure_whole(this, model, u, overlap, accepted)
    class(pairing_space_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    type(overlap_t), intent(inout) :: overlap
    real(wp), intent(out) :: accepted
    call measure_all(this, model, u, overlap, accepted)
  end subroutine space_measure_whole

  !> Places change in every step (find_places says so), so that there is nothing to renew.
  subroutine space_renew_gaps(this, rows, a, spare, b, is_same)
    class(pairing_space_t), intent(in) :: this
    type(rows_t), intent(inout) :: rows, spare
    integer, intent(inout) :: a, b
    logical, intent(inout) :: is_same
    is_same = .false.
  end subroutine space_renew_gaps

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
                if (dot_product(this%nodal%force(:, at), skin%normal(:, f)) > &
                    facing*force) cycle
              end if
              area(at) = area(at) &
                  + sum(skin%share(:, f), mask=skin%node(:, f) == skin%vertex(v))
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
