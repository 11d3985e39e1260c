! SPDX-License-Identifier: BSD-3-Clause
!> The pairing MORTAR: faces that lie on each other are kept apart by weighted gaps
!> (contact_mortar_rows), one for every node of the side that carries the multipliers. What
!> weighted gaps do not see is left to the nodes of the pairing NODE, of which this is an
!> extension: corners that meet a face at an angle have their rows, all other nodes an
!> allowance. Lists, monitor and the judgement of overlaps are those of NODE.
module contact_mortar
  use base_archive, only: archive_t, archive_restore
  use base_kinds, only: wp, zero
  use contact_mortar_cover, only: cover_t, list_pairs, find_cover
  use contact_mortar_rows, only: mortar_work_t, add_mortar_row, size_mortar_work, covered_width
  use contact_node, only: pairing_node_t
  use contact_rows, only: rows_t, start_rows, copy_row, comes_before
  use model_data, only: model_t
  implicit none
  private

  type, extends(pairing_node_t), public :: pairing_mortar_t
    type(cover_t) :: cover
    type(mortar_work_t) :: work
    type(rows_t) :: made           !< rows of the multipliers in this step
    type(rows_t) :: exact          !< work space: rows of corners
  contains
    procedure :: list => mortar_list
    procedure :: mark_interface => mortar_mark_interface
    procedure :: find_places => mortar_find_places
    procedure :: append_rows => mortar_append_rows
    procedure :: weigh_nodes => mortar_weigh_nodes
    procedure :: exchange => mortar_exchange
  end type pairing_mortar_t

contains

  subroutine mortar_list(this, model, u, reach)
    class(pairing_mortar_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :)
    real(wp), intent(in) :: reach
    call this%pairing_node_t%list(model, u, reach)
    call list_edges(this)
  end subroutine mortar_list

  !> Pairs of edges from the lists of the nodes, and work space for them.
  subroutine list_edges(this)
    type(pairing_mortar_t), intent(inout) :: this
    associate (c => this%multiplier_side)
      call list_pairs(this%side(c), this%side(3 - c), this%near(c), this%near(3 - c), &
          this%cover)
    end associate
    call size_mortar_work(this%cover, this%work)
    call start_rows(this%made)
    call start_rows(this%exact)
  end subroutine list_edges

  !> What nodes take, and all ends of the pairs of edges.
  subroutine mortar_mark_interface(this, model, taken, carrier)
    class(pairing_mortar_t), intent(in) :: this
    type(model_t), intent(in) :: model
    logical, intent(inout) :: taken(:)
    integer, intent(inout) :: carrier(:)
    integer :: e, k
    call this%pairing_node_t%mark_interface(model, taken, carrier)
    associate (own => this%side(this%multiplier_side), &
        obstacle => this%side(3 - this%multiplier_side))
      do e = 1, size(own%length)
        do k = this%cover%first(e), this%cover%first(e + 1) - 1
          taken(own%end_node(:, e)) = .true.
          taken(obstacle%end_node(:, this%cover%other(k))) = .true.
        end do
      end do
    end associate
  end subroutine mortar_mark_interface

  subroutine mortar_find_places(this, model, u, free, is_same)
    class(pairing_mortar_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :), free(:, :)
    logical, intent(out) :: is_same
    integer :: e, k
    call this%pairing_node_t%find_places(model, u, free, is_same)
    is_same = .false.
    call start_rows(this%made)
    if (this%listed == 0) return
    associate (c => this%multiplier_side)
      do e = 1, size(this%side(c)%length)
        call find_cover(this%side(c), this%side(3 - c), e, model%x, u, this%is_reference, &
            this%reach, this%cover)
      end do
      do k = 1, size(this%side(c)%node)
        call add_mortar_row(this%number, c, this%side(c), this%side(3 - c), this%cover, k, &
            model%x, u, this%friction%static, this%work, this%made)
      end do
    end associate
  end subroutine mortar_find_places

  !> Rows of multipliers and of corners, by sides and nodes; those of other nodes are spare.
  subroutine mortar_append_rows(this, rows, spare)
    class(pairing_mortar_t), intent(inout) :: this
    type(rows_t), intent(inout) :: rows, spare
    integer :: a, b
    call start_rows(this%exact)
    call this%pairing_node_t%append_rows(this%exact, spare)
    b = 1
    do a = 1, this%made%n
      do while (b <= this%exact%n)
        if (.not. comes_before(this%exact%key(1:3, b), this%made%key(1:3, a))) exit
        call copy_row(this%exact, b, rows)
        b = b + 1
      end do
      call copy_row(this%made, a, rows)
    end do
    do b = b, this%exact%n
      call copy_row(this%exact, b, rows)
    end do
  end subroutine mortar_append_rows

  !> The force on a node is that of its shape function, over what its multipliers cover.
  subroutine mortar_weigh_nodes(this, model, area)
    class(pairing_mortar_t), intent(in) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(inout) :: area(:)
    real(wp) :: width
    integer :: k
    if (.not. allocated(this%cover%first)) return
    associate (c => this%multiplier_side, own => this%side(this%multiplier_side))
      do k = 1, size(own%node)
        width = covered_width(own, this%cover, k)
        if (width > zero) area(this%nodal%first(c) + k) = &
            width*model%part(own%part(maxval(own%node_edge(:, k))))%thickness
      end do
    end associate
  end subroutine mortar_weigh_nodes

  subroutine mortar_exchange(this, archive)
    class(pairing_mortar_t), intent(inout) :: this
    type(archive_t), intent(inout) :: archive
    call this%pairing_node_t%exchange(archive)
    if (archive%mode == archive_restore) call list_edges(this)
  end subroutine mortar_exchange

end module contact_mortar
