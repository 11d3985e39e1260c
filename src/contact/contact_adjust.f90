! SPDX-License-Identifier: BSD-3-Clause
!> Bodies that overlap at the start (OVERLAP ADJUST): nodes of the contactor that are behind the
!> place on the obstacle that they face are moved onto it, before anything is made of the mesh.
!> They are without stress there.
module contact_adjust
  use base_kinds, only: wp, zero, one
  use contact_node, only: pairing_node_t
  use contact_types, only: contact_t
  use deck_names, only: overlap_adjust
  use model_data, only: model_t
  implicit none
  private

  !> A node that was moved.
  type, public :: moved_node_t
    integer :: contact = 0               !< id of the card
    integer :: node = 0
    real(wp) :: by(2) = zero             !< [L]
  end type moved_node_t

  public :: adjust_nodes

contains

  !> Moves the nodes of the model, card by card. The contact is of the mesh as it was: it must
  !> be made anew.
  subroutine adjust_nodes(model, contact, moved)
    type(model_t), intent(inout) :: model
    type(contact_t), intent(inout) :: contact
    type(moved_node_t), allocatable, intent(out) :: moved(:)
    integer :: k
    allocate (moved(0))
    do k = 1, size(model%contact)
      if (model%contact(k)%overlap /= overlap_adjust) cycle
      select type (pairing => contact%pairing(k)%item)
      type is (pairing_node_t)
        call adjust_pairing(model, pairing, moved)
      end select
    end do
  end subroutine adjust_nodes

  !> The contactor is the side of SIDE, or that with the shorter edges; SURFA where they are
  !> alike.
  subroutine adjust_pairing(model, pairing, moved)
    type(model_t), intent(inout) :: model
    type(pairing_node_t), intent(inout) :: pairing
    type(moved_node_t), allocatable, intent(inout) :: moved(:)
    real(wp), parameter :: alike = one + 1.0e-6_wp
    real(wp) :: rest(2, model%nodes), length(2)
    type(moved_node_t) :: new
    integer :: s, j
    logical :: is_same
    rest = zero
    length = pairing%side%mean_length
    s = pairing%finer
    if (s == 0) s = merge(2, 1, length(1) > alike*length(2))
    pairing%may_overlap = .true.
    call pairing%list(model, rest, maxval(length))
    call pairing%find_places(model, rest, rest, is_same)
    do j = 1, pairing%places
      associate (place => pairing%place(j))
        if (place%side /= s .or. place%is_second .or. .not. place%gap < zero) cycle
        new = moved_node_t(pairing%id, place%node, -place%gap*place%normal)
      end associate
      model%x(:, new%node) = model%x(:, new%node) + new%by
      moved = [moved, new]
    end do
  end subroutine adjust_pairing

end module contact_adjust
