! SPDX-License-Identifier: BSD-3-Clause
!> A node that sees one edge, where neither that edge nor its own have turned and it has not
!> moved along, is before the same place as in the last step: only its gap is new. Coarse
!> faces that press on each other stay so for thousands of steps.
module contact_repeat
  use base_kinds, only: wp, zero, one
  use contact_features, only: cone_of_node_t, frame_t, edge_frame, local_coordinate, &
      gap_to_edge, normal_between
  use contact_places, only: place_t, clamped, deepest
  use contact_surface, only: surface_t
  implicit none
  private

  !> The place of a node in the last step, with what it depends on.
  type, public :: last_place_t
    logical :: is_set = .false.
    type(place_t) :: place
    real(wp) :: own_normal(2, 2) = zero
  end type last_place_t

  public :: keep_place, repeat_place

contains

  !> Keeps a place with the cone of its node, if it can come again: alone, on the one edge
  !> that is listed.
  pure subroutine keep_place(node, edges, places, place, cone, last)
    integer, intent(in) :: node, edges, places
    type(place_t), intent(in) :: place
    type(cone_of_node_t), intent(in) :: cone
    type(last_place_t), intent(inout) :: last
    last%is_set = place%node == node .and. edges == 1 .and. places == 1 .and. &
        place%vertex == 0 .and. .not. cone%is_all
    if (.not. last%is_set) return
    last%place = place
    last%own_normal = cone%normal
  end subroutine keep_place

  !> The place again with its gap at X + U, if nothing has turned and its local coordinate is
  !> the same to the last bit.
  pure subroutine repeat_place(own, obstacle, k, x, u, is_reference, reach, last, is_same)
    type(surface_t), intent(in) :: own, obstacle
    integer, intent(in) :: k
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    logical, intent(in) :: is_reference
    real(wp), intent(in) :: reach
    type(last_place_t), intent(inout) :: last
    logical, intent(out) :: is_same
    type(frame_t) :: frame
    real(wp) :: n(2), s
    is_same = .false.
    if (.not. last%is_set) return
    associate (p => last%place, chain => own%chain(:, k))
      call edge_frame(obstacle, p%edge, x, u, is_reference, frame)
      if (any(abs(frame%normal - p%normal) > zero)) return
      n = normal_between(x, u, chain(1), p%node, is_reference)
      if (any(abs(n - last%own_normal(:, 1)) > zero)) return
      n = normal_between(x, u, p%node, chain(2), is_reference)
      if (any(abs(n - last%own_normal(:, 2)) > zero)) return
      s = clamped(min(one, max(zero, &
          local_coordinate(obstacle, p%edge, frame, x, u, p%node))))
      if (abs(s - p%s) > zero) return
      p%gap = gap_to_edge(obstacle, p%edge, frame%normal, s, x, u, p%node)
      is_same = p%gap <= reach .and. p%gap > -deepest*p%length
    end associate
  end subroutine repeat_place

end module contact_repeat
