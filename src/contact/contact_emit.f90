! SPDX-License-Identifier: BSD-3-Clause
!> From places to rows: at the start of a step, and those that its end shows to be missing.
module contact_emit
  use base_kinds, only: wp, zero
  use contact_features, only: gap_to_place, smooth_angle
  use contact_grade, only: points_of_place
  use contact_pairing, only: late_t
  use contact_places, only: place_t
  use contact_rows, only: rows_t, add_row, row_edge, row_vertex, row_second, row_mortar
  use contact_surface, only: surface_t
  implicit none
  private
  public :: emit_row, judge_late

  !> A late row is one whose gap at the end of the step is below this many allowances.
  real(wp), parameter, public :: too_deep = 1.5_wp

contains

  !> Adds the row of a place; number: of the pairing.
  pure subroutine emit_row(number, obstacle, mu, place, rows)
    integer, intent(in) :: number
    type(surface_t), intent(in) :: obstacle
    real(wp), intent(in) :: mu
    type(place_t), intent(in) :: place
    type(rows_t), intent(inout) :: rows
    real(wp) :: weight(3)
    integer :: point(3), points
    call points_of_place(obstacle, place, point, weight, points)
    call add_row(rows, key_of(number, place), point(:points), weight(:points), place%normal, &
        place%gap, mu, place%length, kind_of(place), &
        merge(zero, place%allowance, place%is_exact))
    rows%is_twin(rows%n) = place%is_twin
  end subroutine emit_row

  pure function key_of(number, place) result(key)
    integer, intent(in) :: number
    type(place_t), intent(in) :: place
    integer :: key(4)
    key = [number, place%side, place%node, place%edge]
    if (place%vertex > 0) key(4) = -place%vertex
  end function key_of

  pure integer function kind_of(place)
    type(place_t), intent(in) :: place
    kind_of = row_edge
    if (place%vertex > 0) kind_of = row_vertex
    if (place%is_second) kind_of = row_second
  end function kind_of

  !> A place at the end of the step against the rows of its node: too deep, it is a late row, or
  !> the new frame of the row whose normal is nearest.
  pure subroutine judge_late(number, obstacle, x, u0, place, rows, late, n)
    integer, intent(in) :: number
    type(surface_t), intent(in) :: obstacle
    real(wp), intent(in), contiguous :: x(:, :), u0(:, :)
    type(place_t), intent(in) :: place
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
      if (rows%kind(a) == row_mortar) cycle
      if (dot_product(rows%normal(:, a), place%normal) < nearest) cycle
      nearest = dot_product(rows%normal(:, a), place%normal)
      found = a
    end do
    if (found > 0) then
      if (min(rows%gap(found), zero) - place%gap <= place%allowance) return
    end if
    n = n + 1
    late(n)%row = found
    late(n)%key = key_of(number, place)
    call points_of_place(obstacle, place, late(n)%point, late(n)%weight, late(n)%points)
    late(n)%normal = [place%normal, zero]
    late(n)%gap = gap_to_place(late(n)%point(:late(n)%points), &
        late(n)%weight(:late(n)%points), place%normal, x, u0)
    late(n)%allowance = merge(zero, place%allowance, place%is_exact)
    late(n)%length = place%length
    late(n)%kind = kind_of(place)
  end subroutine judge_late

end module contact_emit
