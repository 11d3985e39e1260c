! SPDX-License-Identifier: BSD-3-Clause
!> Rigid plane walls as obstacles: an analytic surface instead of edges, no degrees of freedom.
!> A row at a wall has one point, the contactor's.
module contact_wall
  use base_kinds, only: wp, zero, one, half
  use base_status, only: status_t, fail, status_numerical, status_deck
  use base_strings, only: to_text
  use contact_rows, only: rows_t, add_row
  use contact_surface, only: make_surface
  use contact_types, only: contact_t, pair_t
  use model_data, only: model_t, wall_t, side_node_set, side_all_nodes
  implicit none
  private
  public :: make_wall, wall_distance, add_wall_row, check_wall, mark_wall_nodes

contains

  !> The pair of a wall: its nodes against its plane.
  subroutine make_wall(model, wall, pair)
    type(model_t), intent(in) :: model
    type(wall_t), intent(in) :: wall
    type(pair_t), intent(inout) :: pair
    pair%is_wall = .true.
    pair%id = wall%id
    pair%record = wall%record
    pair%mu = wall%mu
    pair%birth = wall%birth
    pair%death = wall%death
    pair%wall_point = wall%point
    pair%wall_normal = wall%normal
    pair%contactor_side = 1
    call make_surface(model, merge(side_all_nodes, side_node_set, wall%node_set == 0), &
        wall%node_set, pair%contactor)
    allocate (pair%obstacle%node(0), pair%obstacle%length(0), pair%obstacle%end_node(2, 0))
    allocate (pair%obstacle%normal(2, 0))
  end subroutine make_wall

  !> Distance of a node in front of the wall [L], reference part and motion apart.
  pure real(wp) function wall_distance(pair, x, u, node)
    type(pair_t), intent(in) :: pair
    real(wp), intent(in) :: x(:, :), u(:, :)
    integer, intent(in) :: node
    wall_distance = dot_product(pair%wall_normal, x(:, node) - pair%wall_point) &
        + dot_product(pair%wall_normal, u(:, node))
  end function wall_distance

  !> Adds the row of a node at the wall.
  pure subroutine add_wall_row(pair, p, x, u, node, rows)
    type(pair_t), intent(in) :: pair
    integer, intent(in) :: p, node
    real(wp), intent(in) :: x(:, :), u(:, :)
    type(rows_t), intent(inout) :: rows
    call add_row(rows, [p, node, 0], [node], [one], pair%wall_normal, &
        wall_distance(pair, x, u, node), pair%mu, max(pair%contactor%mean_length, tiny(one)))
  end subroutine add_wall_row

  !> Fails when a node that was not watched stands behind the wall.
  subroutine check_wall(model, contact, pair, node, gap, cycle, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(in) :: contact
    type(pair_t), intent(in) :: pair
    integer, intent(in) :: node, cycle
    real(wp), intent(in) :: gap
    type(status_t), intent(inout) :: status
    if (-gap <= contact%penetration_tolerance*pair%contactor%mean_length) return
    if (cycle == 0) then
      call fail(status, status_deck, 'initial penetration: node '// &
          to_text(model%node_id(node))//' is '//to_text(-gap)//' behind wall '// &
          to_text(pair%id), hint='move the wall, or name the nodes in front of it (NSID)')
    else
      call fail(status, status_numerical, 'node '//to_text(model%node_id(node))// &
          ' crossed wall '//to_text(pair%id)//' unseen within the step', hint='refine the step')
    end if
  end subroutine check_wall

  !> Nodes of the edges that face the wall.
  pure subroutine mark_wall_nodes(pair, taken)
    type(pair_t), intent(in) :: pair
    logical, intent(inout) :: taken(:)
    integer :: e
    do e = 1, size(pair%contactor%length)
      if (dot_product(pair%contactor%normal(:, e), pair%wall_normal) < -half) &
          taken(pair%contactor%end_node(:, e)) = .true.
    end do
  end subroutine mark_wall_nodes

end module contact_wall
