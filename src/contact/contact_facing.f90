! SPDX-License-Identifier: BSD-3-Clause
!> Which nodes the rows of a pairing may involve: now, by its lists, and ever, by its
!> geometry.
module contact_facing
  use base_kinds, only: wp, zero, one, half
  use contact_near, only: near_t
  use contact_surface, only: surface_t
  use model_data, only: model_t
  implicit none
  private
  public :: mark_near, mark_facing

contains

  !> Marks near nodes of `own` and the nodes of their edges, with one more edge on either
  !> side, so that sliding does not outgrow the interface at once. Beyond a convex corner the
  !> next edge has no rows: its far node is carried along with the corner.
  pure subroutine mark_near(own, obstacle, near, taken, carrier)
    type(surface_t), intent(in) :: own, obstacle
    type(near_t), intent(in) :: near
    logical, intent(inout) :: taken(:)
    integer, intent(inout) :: carrier(:)
    integer :: i, j, s, next
    do i = 1, near%n
      taken(own%node(near%node(i))) = .true.
      do j = near%first(i), near%first(i + 1) - 1
        taken(obstacle%end_node(:, near%edge(j))) = .true.
        do s = 1, 2
          next = obstacle%neighbour(s, near%edge(j))
          if (next == 0) cycle
          if (is_sharp(obstacle, near%edge(j), next, s)) then
            carrier(obstacle%end_node(s, next)) = obstacle%end_node(s, near%edge(j))
          else
            taken(obstacle%end_node(:, next)) = .true.
          end if
        end do
      end do
    end do
  end subroutine mark_near

  !> Is the boundary convex by more than 60 degrees between an edge and that before it (s = 1)
  !> or behind it (s = 2)?
  pure logical function is_sharp(surface, edge, next, s)
    type(surface_t), intent(in) :: surface
    integer, intent(in) :: edge, next, s
    associate (a => surface%normal(:, edge), b => surface%normal(:, next))
      is_sharp = dot_product(a, b) < half .and. &
          (a(1)*b(2) - a(2)*b(1))*merge(one, -one, s == 2) > zero
    end associate
  end function is_sharp

  !> Marks nodes of edges in front of which, along their normal and within their width, some
  !> part of the other surface stands.
  pure subroutine mark_facing(model, surface, other, taken)
    type(model_t), intent(in) :: model
    type(surface_t), intent(in) :: surface, other
    logical, intent(inout) :: taken(:)
    real(wp) :: d(2), along(2), height(2)
    integer :: e, f, s
    do e = 1, size(surface%length)
      if (.not. surface%is_listed(e)) cycle
      do f = 1, size(other%length)
        if (.not. other%is_listed(f)) cycle
        if (dot_product(surface%normal(:, e), other%normal(:, f)) > -0.05_wp) cycle
        do s = 1, 2
          d = model%x(:, other%end_node(s, f)) - model%x(:, surface%end_node(1, e))
          along(s) = surface%normal(1, e)*d(2) - surface%normal(2, e)*d(1)
          height(s) = dot_product(surface%normal(:, e), d)
        end do
        if (maxval(height) < -1.0e-6_wp*surface%length(e)) cycle
        if (maxval(along) <= 1.0e-6_wp*surface%length(e)) cycle
        if (minval(along) >= (1.0_wp - 1.0e-6_wp)*surface%length(e)) cycle
        taken(surface%end_node(:, e)) = .true.
      end do
    end do
  end subroutine mark_facing

end module contact_facing
