! SPDX-License-Identifier: BSD-3-Clause
!> Tips of a rigid obstacle, and the edges of bodies that lie on them: the ends of a finite
!> wall, which are points, and a disc, which an edge may touch between its nodes. The tip is
!> the contactor of such a row, the edge its obstacle.
module contact_tips
  use base_archive, only: archive_t, archive_restore
  use base_kinds, only: wp, zero, one, half
  use contact_features, only: frame_t, edge_frame, difference
  use contact_pairing, only: overlap_t, note_overlap
  use contact_rows, only: rows_t, add_row, row_wall
  use contact_surface, only: surface_t
  implicit none
  private

  type, public :: tips_t
    real(wp), allocatable :: at(:, :)     !< (2, tips) seen from the body [L]
    real(wp) :: radius = zero             !< [L]
    ! Edges that are near, by tips and edges:
    integer :: n = 0
    integer, allocatable :: tip(:), edge(:)
    real(wp), allocatable :: gap(:)       !< [L]
    real(wp), allocatable :: s(:)         !< place along the edge
    real(wp), allocatable :: normal(:, :) !< (2, *) of the edge
    logical, allocatable :: stands(:)     !< there is a row
  end type tips_t

  !> A row of a disc, whose nodes are exact, holds only this far below its edge, and a tip that
  !> stands near a node only so far [/ edge]: as other rows beside exact ones.
  real(wp), parameter :: disc_allowance = 1.0e-3_wp, tip_allowance = 2.0e-4_wp
  !> Near a node: in shares of the edge.
  real(wp), parameter :: twin_distance = 0.1_wp
  !> Deeper than this share of an edge a tip is not behind it, but before another one.
  real(wp), parameter :: deepest = 0.3_wp

  public :: has_edges, list_edges, find_edges, append_edges, measure_edges, deepest_tip, &
      exchange_edges

contains

  !> Can edges touch this obstacle?
  pure logical function has_edges(tips)
    type(tips_t), intent(in) :: tips
    has_edges = allocated(tips%at)
  end function has_edges

  !> The edges whose distance from a tip is less than near_enough; safe_distance falls to that
  !> of the others [L].
  subroutine list_edges(tips, side, body, x, u, near_enough, safe_distance)
    type(tips_t), intent(inout) :: tips
    type(surface_t), intent(in) :: side
    integer, intent(in) :: body
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(in) :: near_enough
    real(wp), intent(inout) :: safe_distance
    real(wp) :: distance
    integer :: t, e
    if (.not. allocated(tips%tip)) &
        call size_edges(tips, size(tips%at, 2)*count(side%is_listed))
    tips%n = 0
    do t = 1, size(tips%at, 2)
      do e = 1, size(side%length)
        if (.not. side%is_listed(e)) cycle
        distance = norm2(from_edge(side, e, tips%at(:, t), body, x, u)) - tips%radius
        if (distance <= near_enough) then
          tips%n = tips%n + 1
          tips%tip(tips%n) = t
          tips%edge(tips%n) = e
        else
          safe_distance = min(safe_distance, distance)
        end if
      end do
    end do
  end subroutine list_edges

  pure subroutine size_edges(tips, n)
    type(tips_t), intent(inout) :: tips
    integer, intent(in) :: n
    allocate (tips%tip(n), tips%edge(n), tips%gap(n), tips%s(n), tips%normal(2, n))
    allocate (tips%stands(n))
  end subroutine size_edges

  !> From the nearest point of edge e to a tip [L].
  pure function from_edge(side, e, tip, body, x, u) result(d)
    type(surface_t), intent(in) :: side
    integer, intent(in) :: e, body
    real(wp), intent(in) :: tip(2)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp) :: d(2), t(2)
    associate (a => side%end_node(1, e), b => side%end_node(2, e))
      d = tip - difference(x, u, a, body)
      t = difference(x, u, b, a)
      d = d - min(one, max(zero, dot_product(d, t)/max(sum(t**2), tiny(one))))*t
    end associate
  end function from_edge

  !> Gap and place of tip i of the list before its edge at displacement u.
  pure subroutine see(tips, i, side, body, x, u, gap, s, normal)
    type(tips_t), intent(in) :: tips
    integer, intent(in) :: i, body
    type(surface_t), intent(in) :: side
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(out) :: gap, s, normal(2)
    type(frame_t) :: frame
    real(wp) :: d(2)
    call edge_frame(side, tips%edge(i), x, u, .false., frame)
    normal = frame%normal
    d = tips%at(:, tips%tip(i)) - difference(x, u, side%end_node(1, tips%edge(i)), body)
    gap = dot_product(normal, d) - tips%radius
    s = (normal(1)*d(2) - normal(2)*d(1))/frame%span
  end subroutine see

  !> Which of the listed edges a tip stands before, at the start of the step or where the free
  !> motion ends. Of edges that face each other (a thin body) the nearer one; behind an edge,
  !> and before another at a convex corner, the other.
  subroutine find_edges(tips, side, body, x, u, free)
    type(tips_t), intent(inout) :: tips
    type(surface_t), intent(in) :: side
    integer, intent(in) :: body
    real(wp), intent(in), contiguous :: x(:, :), u(:, :), free(:, :)
    real(wp) :: d(2), shift
    integer :: i, j
    do i = 1, tips%n
      call see(tips, i, side, body, x, u, tips%gap(i), tips%s(i), tips%normal(:, i))
      associate (n => tips%normal(:, i), length => side%length(tips%edge(i)), &
          a => side%end_node(1, tips%edge(i)))
        d = free(:, body) - free(:, a)
        shift = (n(1)*d(2) - n(2)*d(1))/length
        tips%stands(i) = max(tips%s(i), tips%s(i) + shift) > zero .and. &
            min(tips%s(i), tips%s(i) + shift) < one .and. tips%gap(i) > -deepest*length
        tips%s(i) = min(one, max(zero, tips%s(i)))
      end associate
    end do
    do i = 1, tips%n
      do j = 1, tips%n
        if (i == j .or. tips%tip(i) /= tips%tip(j)) cycle
        if (.not. (tips%stands(i) .and. tips%stands(j))) cycle
        if (dot_product(tips%normal(:, i), tips%normal(:, j)) > -half .and. &
            tips%gap(i) + tips%radius > -tip_allowance*side%length(tips%edge(i))) cycle
        if (abs(tips%gap(i)) > abs(tips%gap(j))) tips%stands(i) = .false.
      end do
    end do
  end subroutine find_edges

  !> Rows of the edges: exact at the ends of a wall, with an allowance at a disc and near nodes,
  !> which have exact rows of their own.
  subroutine append_edges(tips, side, number, body, mu, rows, spare)
    type(tips_t), intent(in) :: tips
    type(surface_t), intent(in) :: side
    integer, intent(in) :: number, body
    real(wp), intent(in) :: mu
    type(rows_t), intent(inout) :: rows, spare
    real(wp) :: weight(3), share
    integer :: i, key(4)
    do i = 1, tips%n
      if (.not. tips%stands(i)) cycle
      associate (e => tips%edge(i), s => tips%s(i))
        key = [number, 2, body, e + (tips%tip(i) - 1)*size(side%length)]
        weight(1:2) = [one, s - one]
        weight(3) = -(one + weight(2))
        share = zero
        if (tips%radius > zero) then
          share = disc_allowance
        else if (min(s, one - s) < twin_distance) then
          share = tip_allowance
        end if
        if (share > zero) then
          call add_row(spare, key, [body, side%end_node(:, e)], weight, tips%normal(:, i), &
              tips%gap(i), mu, side%length(e), row_wall, share*side%length(e))
        else
          call add_row(rows, key, [body, side%end_node(:, e)], weight, tips%normal(:, i), &
              tips%gap(i), mu, side%length(e), row_wall, zero)
        end if
      end associate
    end do
  end subroutine append_edges

  !> True gaps of the tips at u.
  subroutine measure_edges(tips, side, body, x, u, smallest, overlap)
    type(tips_t), intent(in) :: tips
    type(surface_t), intent(in) :: side
    integer, intent(in) :: body
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(inout) :: smallest
    type(overlap_t), intent(inout) :: overlap
    real(wp) :: gap, s, normal(2)
    integer :: i
    do i = 1, tips%n
      if (.not. tips%stands(i)) cycle
      call see(tips, i, side, body, x, u, gap, s, normal)
      associate (e => tips%edge(i))
        if (min(s, one - s) < zero .or. gap < -deepest*side%length(e)) cycle
        smallest = min(smallest, gap)
        if (gap < zero) call note_overlap(overlap, -gap, side%length(e), &
            side%end_node(1, e), 0, .false.)
      end associate
    end do
  end subroutine measure_edges

  !> Tips that stand inside a body, by the number of edges left of them: only where the side is
  !> the whole boundary.
  subroutine deepest_tip(tips, side, body, x, u, overlap)
    type(tips_t), intent(in) :: tips
    type(surface_t), intent(in) :: side
    integer, intent(in) :: body
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(overlap_t), intent(inout) :: overlap
    real(wp) :: a(2), b(2), distance, d
    logical :: is_inside
    integer :: t, e, edge
    if (.not. side%is_closed) return
    do t = 1, size(tips%at, 2)
      is_inside = .false.
      distance = huge(one)
      edge = 1
      do e = 1, size(side%length)
        a = difference(x, u, side%end_node(1, e), body) - tips%at(:, t)
        b = difference(x, u, side%end_node(2, e), body) - tips%at(:, t)
        if ((a(2) > zero) .neqv. (b(2) > zero)) then
          if (a(1) - a(2)*(b(1) - a(1))/(b(2) - a(2)) < zero) is_inside = .not. is_inside
        end if
        d = norm2(from_edge(side, e, tips%at(:, t), body, x, u))
        if (d < distance) edge = e
        distance = min(distance, d)
      end do
      if (is_inside) call note_overlap(overlap, distance + tips%radius, side%length(edge), &
          side%end_node(1, edge), 0, .false.)
    end do
  end subroutine deepest_tip

  !> Saves the list of edges to the archive or restores it.
  subroutine exchange_edges(tips, archive)
    type(tips_t), intent(inout) :: tips
    type(archive_t), intent(inout) :: archive
    integer :: room
    room = 0
    if (allocated(tips%tip)) room = size(tips%tip)
    call archive%exchange('tips.n', tips%n)
    call archive%exchange('tips.room', room)
    if (room == 0) return
    if (archive%mode == archive_restore .and. .not. allocated(tips%tip)) &
        call size_edges(tips, room)
    call archive%exchange('tips.tip', tips%tip(:tips%n))
    call archive%exchange('tips.edge', tips%edge(:tips%n))
  end subroutine exchange_edges

end module contact_tips
