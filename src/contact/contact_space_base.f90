! SPDX-License-Identifier: BSD-3-Clause
!> What a contact of bodies in space has: the nets of both sides, trees over them, lists of
!> what is near, and the places and crossings of the step.
module contact_space_base
  use base_kinds, only: wp
  use contact_grade, only: finer_auto
  use contact_near, only: near_t
  use contact_pairing, only: pairing_t
  use contact_places, only: view_t
  use contact_skin, only: skin_t
  use contact_space_edges, only: edge_pairs_t, crossing_t, cross_edges
  use contact_space_tree, only: space_tree_t, place_facets, place_edges
  use contact_space_view, only: space_place_t, space_sight_t
  implicit none
  private

  type, abstract, extends(pairing_t), public :: space_t
    integer :: finer = finer_auto        !< side whose nodes are exact, by the deck
    logical :: is_self = .false.         !< side(1) against itself
    logical :: may_share = .false.       !< nodes may belong to both sides
    logical :: watches_edges = .true.    !< false only in a test, which shows what nodes miss
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
  end type space_t

  public :: watched_sides, facing_side, view_of, place_trees, find_crossings

contains

  !> Sides whose nodes are watched: a surface against itself is one.
  pure integer function watched_sides(this)
    class(space_t), intent(in) :: this
    watched_sides = merge(1, 2, this%is_self)
  end function watched_sides

  !> The surface that the nodes of a side face.
  pure integer function facing_side(this, s)
    class(space_t), intent(in) :: this
    integer, intent(in) :: s
    facing_side = merge(1, 3 - s, this%is_self)
  end function facing_side

  !> What the nodes of a side see: on closed surfaces nodes may belong to both.
  pure type(view_t) function view_of(this)
    class(space_t), intent(in) :: this
    view_of%may_share = this%is_self .or. this%may_share
    view_of%is_reference = this%is_reference
    view_of%reach = &
        0.25_wp*min(this%side(1)%shortest, this%side(facing_side(this, 1))%shortest)
  end function view_of

  !> The trees of both sides at X + U.
  subroutine place_trees(this, x, u)
    class(space_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer :: s
    do s = 1, watched_sides(this)
      call place_facets(this%skin(s), x, u, this%facets(s))
      call place_edges(this%skin(s), x, u, this%edges(s))
    end do
  end subroutine place_trees

  !> All pairs of edges as they are.
  subroutine find_crossings(this, x, u, view)
    class(space_t), intent(inout) :: this
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(view_t), intent(in) :: view
    integer :: k
    do k = 1, this%pairs%n
      call cross_edges(this%skin(1), this%skin(facing_side(this, 1)), this%pairs%a(k), &
          this%pairs%b(k), x, u, view%is_reference, this%crossing(k))
      if (this%crossing(k)%gap > view%reach) this%crossing(k)%is_valid = .false.
    end do
  end subroutine find_crossings

end module contact_space_base
