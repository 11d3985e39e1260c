! SPDX-License-Identifier: BSD-3-Clause
!> From places and crossings in space to rows: at the start of a step, and those that its end
!> shows to be missing (contact_emit).
module contact_space_emit
  use base_kinds, only: wp, zero, one
  use contact_emit, only: too_deep
  use contact_features, only: smooth_angle
  use contact_pairing, only: late_t
  use contact_places, only: share_at_corner
  use contact_rows, only: rows_t, add_row, row_edge, row_vertex, row_second, row_crossing
  use contact_sight, only: from_node
  use contact_space_edges, only: crossing_t
  use contact_space_view, only: space_place_t
  implicit none
  private
  public :: emit_place, emit_crossing, judge_late_place, judge_late_crossing

contains

  !> Adds the row of a place; number: of the pairing.
  pure subroutine emit_place(number, mu, place, rows)
    integer, intent(in) :: number
    real(wp), intent(in) :: mu
    type(space_place_t), intent(in) :: place
    type(rows_t), intent(inout) :: rows
    real(wp) :: weight(5)
    integer :: point(5)
    call weights_of(place, weight)
    point(1) = place%node
    point(2:) = place%point
    call add_row(rows, [number, place%side, place%node, place%key], &
        point(:place%points + 1), weight(:place%points + 1), place%normal, &
        place%gap, mu, place%length, kind_of(place), &
        merge(zero, place%allowance, place%is_exact))
    rows%is_twin(rows%n) = place%is_twin
  end subroutine emit_place

  !> Weights of the node and of the points, whose sum is zero to the last bit.
  pure subroutine weights_of(place, weight)
    type(space_place_t), intent(in) :: place
    real(wp), intent(out) :: weight(5)
    associate (n => place%points)
      weight(1) = one
      weight(2:n) = -place%weight(:n - 1)
      weight(n + 1) = -sum(weight(:n))
    end associate
  end subroutine weights_of

  pure integer function kind_of(place)
    type(space_place_t), intent(in) :: place
    kind_of = row_edge
    if (place%is_shared) kind_of = row_vertex
    if (place%is_second) kind_of = row_second
  end function kind_of

  !> Adds the row of a crossing with its key.
  pure subroutine emit_crossing(key, mu, crossing, rows)
    integer, intent(in) :: key(4)
    real(wp), intent(in) :: mu
    type(crossing_t), intent(in) :: crossing
    type(rows_t), intent(inout) :: rows
    call add_row(rows, key, crossing%point, crossing%weight, crossing%normal, crossing%gap, &
        mu, crossing%length, row_crossing, crossing%allowance)
  end subroutine emit_crossing

  !> A place at the end of the step against the rows of its node: too deep, it is a late row, or
  !> the new frame of the row whose normal is nearest.
  pure subroutine judge_late_place(number, x, u0, place, rows, late, n)
    integer, intent(in) :: number
    real(wp), intent(in), contiguous :: x(:, :), u0(:, :)
    type(space_place_t), intent(in) :: place
    type(rows_t), intent(in) :: rows
    type(late_t), intent(inout) :: late(:)
    integer, intent(inout) :: n
    integer :: a, found
    real(wp) :: nearest
    if (place%gap >= -too_deep*place%allowance .or. n == size(late)) return
    if (place%is_twin) return    ! the new frame of the other's row is enough
    found = 0
    nearest = cos(smooth_angle)
    do a = 1, rows%n
      if (any(rows%key(1:3, a) /= [number, place%side, place%node])) cycle
      if (rows%kind(a) == row_crossing) cycle
      if (dot_product(rows%normal(:, a), place%normal) < nearest) cycle
      nearest = dot_product(rows%normal(:, a), place%normal)
      found = a
    end do
    if (found > 0) then
      if (min(rows%gap(found), zero) - place%gap <= place%allowance) return
    end if
    n = n + 1
    associate (new => late(n))
      new%row = found
      new%key = [number, place%side, place%node, place%key]
      new%points = place%points + 1
      new%point(1) = place%node
      new%point(2:5) = place%point
      call weights_of(place, new%weight)
      new%normal = place%normal
      new%gap = gap_of_points(new%point(:new%points), new%weight, place%normal, x, u0)
      new%allowance = merge(zero, place%allowance, place%is_exact)
      new%length = place%length
      new%kind = kind_of(place)
    end associate
  end subroutine judge_late_place

  !> The same for a crossing.
  pure subroutine judge_late_crossing(key, x, u0, crossing, rows, late, n)
    integer, intent(in) :: key(4)
    real(wp), intent(in), contiguous :: x(:, :), u0(:, :)
    type(crossing_t), intent(in) :: crossing
    type(rows_t), intent(in) :: rows
    type(late_t), intent(inout) :: late(:)
    integer, intent(inout) :: n
    real(wp) :: allowance
    integer :: a, found
    allowance = max(crossing%allowance, share_at_corner*crossing%length)
    if (crossing%gap >= -too_deep*allowance .or. n == size(late)) return
    found = 0
    do a = 1, rows%n
      if (all(rows%key(:, a) == key)) found = a
    end do
    if (found > 0) then
      if (min(rows%gap(found), zero) - crossing%gap <= allowance) return
    end if
    n = n + 1
    associate (new => late(n))
      new%row = found
      new%key = key
      new%points = 4
      new%point(:4) = crossing%point
      new%weight(:4) = crossing%weight
      new%normal = crossing%normal
      new%gap = gap_of_points(crossing%point, crossing%weight, crossing%normal, x, u0)
      new%allowance = crossing%allowance
      new%length = crossing%length
      new%kind = row_crossing
    end associate
  end subroutine judge_late_crossing

  !> Gap of points and weights, whose sum is zero [L].
  pure real(wp) function gap_of_points(point, weight, normal, x, u) result(gap)
    integer, intent(in) :: point(:)
    real(wp), intent(in) :: weight(:), normal(3)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp) :: d(3)
    integer :: k
    d = zero
    do k = 2, size(point)
      d = d + weight(k)*from_node(x, u, point(1), point(k))
    end do
    gap = dot_product(normal, d)
  end function gap_of_points

end module contact_space_emit
