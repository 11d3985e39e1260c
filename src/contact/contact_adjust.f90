! SPDX-License-Identifier: BSD-3-Clause
!> Bodies that overlap at the start (OVERLAP ADJUST): nodes of the contactor that stand inside
!> the obstacle are moved onto its boundary, the nearest point of it, before anything is made
!> of the mesh. They are without stress there.
module contact_adjust
  use base_kinds, only: wp, zero, one
  use contact_surface, only: surface_t, make_surface
  use contact_tree, only: tree_t, build_tree, winding_number, distance_to_edges
  use deck_names, only: overlap_adjust
  use model_data, only: model_t, contact_card_t
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

  !> Moves the nodes of the model, card by card.
  subroutine adjust_nodes(model, moved)
    type(model_t), intent(inout) :: model
    type(moved_node_t), allocatable, intent(out) :: moved(:)
    integer :: k
    allocate (moved(0))
    do k = 1, size(model%contact)
      if (model%contact(k)%overlap == overlap_adjust) &
          call adjust_card(model, model%contact(k), moved)
    end do
  end subroutine adjust_nodes

  !> The contactor is the side of SIDE, or that with the shorter edges; SURFA where they are
  !> alike.
  subroutine adjust_card(model, card, moved)
    type(model_t), intent(inout) :: model
    type(contact_card_t), intent(in) :: card
    type(moved_node_t), allocatable, intent(inout) :: moved(:)
    real(wp), parameter :: alike = one + 1.0e-6_wp
    type(surface_t) :: side(2)
    type(tree_t) :: tree
    type(moved_node_t) :: new
    integer :: s, k
    logical :: is_inside
    do s = 1, 2
      call make_surface(model, card%kind(s), card%side(s), side(s))
    end do
    s = card%contactor
    if (s == 0) s = merge(2, 1, side(1)%mean_length > alike*side(2)%mean_length)
    associate (own => side(s), obstacle => side(3 - s))
      call build_tree(model%x(:, obstacle%end_node(1, :)), &
          model%x(:, obstacle%end_node(2, :)), tree)
      do k = 1, size(own%node)
        new = moved_node_t(card%id, own%node(k))
        if (obstacle%index(new%node) > 0) cycle
        call way_out(tree, size(obstacle%length), model%x(:, new%node), is_inside, new%by)
        if (.not. is_inside) cycle
        model%x(:, new%node) = model%x(:, new%node) + new%by
        moved = [moved, new]
      end do
    end associate
  end subroutine adjust_card

  !> From a point p inside a boundary to the nearest point on it [L].
  pure subroutine way_out(tree, edges, p, is_inside, by)
    type(tree_t), intent(in) :: tree
    integer, intent(in) :: edges
    real(wp), intent(in) :: p(2)
    logical, intent(out) :: is_inside
    real(wp), intent(out) :: by(2)
    logical :: left_out(edges)
    real(wp) :: distance, s
    integer :: edge
    left_out = .false.
    by = zero
    is_inside = winding_number(tree, p, left_out) > 0
    if (.not. is_inside) return
    call distance_to_edges(tree, p, left_out, huge(one), distance, edge)
    is_inside = distance > zero
    associate (a => tree%a(:, edge), d => tree%b(:, edge) - tree%a(:, edge))
      s = min(one, max(zero, dot_product(p - a, d)/dot_product(d, d)))
      by = a + s*d - p
    end associate
  end subroutine way_out

end module contact_adjust
