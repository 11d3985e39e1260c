! SPDX-License-Identifier: BSD-3-Clause
!> Which parts of the edges of one side, the contactor, are covered by edges of the other, the
!> obstacle: both are cut along the normal of the contactor's edge, so that what is integrated
!> over a part is a polynomial there. Local coordinates s run from 0 to 1 along the contactor's
!> edge.
module contact_mortar_cover
  use base_kinds, only: wp, zero, one, half
  use base_sort, only: sort_integers
  use contact_features, only: frame_t, edge_frame, local_coordinate, gap_to_edge, &
      normal_between, smooth_angle
  use contact_near, only: near_t
  use contact_places, only: deepest
  use contact_surface, only: surface_t
  implicit none
  private

  !> Pairs of edges that are near, sorted, and the parts in which they cover each other.
  type, public :: cover_t
    integer, allocatable :: first(:)        !< (edges of the contactor + 1) first pair of each
    integer, allocatable :: other(:)        !< (pairs) edge of the obstacle
    real(wp), allocatable :: low(:), high(:)!< (pairs) covered part in s; low = high: none
    real(wp), allocatable :: at(:, :)       !< (2, pairs) s of the ends of the obstacle's edge
    ! Of all that covers an edge of the contactor: length, centre, second moment about it, all
    ! in s.
    real(wp), allocatable :: length(:), centre(:), moment(:)
    real(wp), allocatable :: normal(:, :)   !< (2, edges) outward
  end type cover_t

  !> A covered part that is shorter than this share of its edge is none.
  real(wp), parameter :: sliver = 1.0e-10_wp

  public :: list_pairs, find_cover

contains

  !> The pairs of edges of which an end of one is near the other, by the lists of the nodes of
  !> both sides: two edges that cover each other at a small distance are always such a pair.
  subroutine list_pairs(own, obstacle, near_own, near_obstacle, cover)
    type(surface_t), intent(in) :: own, obstacle
    type(near_t), intent(in) :: near_own, near_obstacle
    type(cover_t), intent(out) :: cover
    integer, allocatable :: found(:), count(:), start(:)
    integer :: e, k, n, edges
    edges = size(own%length)
    allocate (count(edges), start(edges + 1), found(0), cover%first(edges + 1))
    count = 0
    start = 1
    call visit(own, obstacle, near_own, .true., .false., start, count, found)
    call visit(own, obstacle, near_obstacle, .false., .false., start, count, found)
    do e = 1, edges
      start(e + 1) = start(e) + count(e)
    end do
    deallocate (found)
    allocate (found(start(edges + 1) - 1))
    count = 0
    call visit(own, obstacle, near_own, .true., .true., start, count, found)
    call visit(own, obstacle, near_obstacle, .false., .true., start, count, found)
    n = 0
    do e = 1, edges
      cover%first(e) = n + 1
      call sort_integers(found(start(e):start(e + 1) - 1))
      do k = start(e), start(e + 1) - 1
        if (n >= cover%first(e)) then
          if (found(n) == found(k)) cycle
        end if
        n = n + 1
        found(n) = found(k)
      end do
    end do
    cover%first(edges + 1) = n + 1
    cover%other = found(:n)
    allocate (cover%low(n), cover%high(n), cover%at(2, n), cover%normal(2, edges))
    allocate (cover%length(edges), cover%centre(edges), cover%moment(edges))
    cover%length = zero
    cover%centre = zero
  end subroutine list_pairs

  !> Counts the pairs of each edge of the contactor that the list of one side makes, and puts
  !> them into found behind start.
  subroutine visit(own, obstacle, near, is_own, keeps, start, count, found)
    type(surface_t), intent(in) :: own, obstacle
    type(near_t), intent(in) :: near
    logical, intent(in) :: is_own, keeps
    integer, intent(in) :: start(:)
    integer, intent(inout) :: count(:), found(:)
    integer :: i, j, s, e, f
    do i = 1, near%n
      do j = near%first(i), near%first(i + 1) - 1
        do s = 1, 2
          if (is_own) then
            e = own%node_edge(s, near%node(i))
            f = near%edge(j)
          else
            e = near%edge(j)
            f = obstacle%node_edge(s, near%node(i))
          end if
          if (e == 0 .or. f == 0) cycle
          if (.not. (own%is_listed(e) .and. obstacle%is_listed(f))) cycle
          if (keeps) found(start(e) + count(e)) = f
          count(e) = count(e) + 1
        end do
      end do
    end do
  end subroutine visit

  !> The parts of edge e of the contactor that are covered at X + U: by edges that face it
  !> within the angle of a smooth boundary and come nearer than reach [L].
  pure subroutine find_cover(own, obstacle, e, x, u, is_reference, reach, cover)
    type(surface_t), intent(in) :: own, obstacle
    integer, intent(in) :: e
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    logical, intent(in) :: is_reference
    real(wp), intent(in) :: reach
    type(cover_t), intent(inout) :: cover
    type(frame_t) :: frame
    real(wp) :: part, middle
    integer :: k
    cover%length(e) = zero
    cover%centre(e) = zero
    cover%moment(e) = zero
    if (cover%first(e) == cover%first(e + 1)) return
    call edge_frame(own, e, x, u, is_reference, frame)
    cover%normal(:, e) = frame%normal
    do k = cover%first(e), cover%first(e + 1) - 1
      call clip(own, obstacle, e, frame, x, u, is_reference, reach, k, cover)
      part = cover%high(k) - cover%low(k)
      cover%length(e) = cover%length(e) + part
      cover%centre(e) = cover%centre(e) + part*half*(cover%low(k) + cover%high(k))
    end do
    if (.not. cover%length(e) > zero) return
    cover%centre(e) = cover%centre(e)/cover%length(e)
    do k = cover%first(e), cover%first(e + 1) - 1
      part = cover%high(k) - cover%low(k)
      middle = half*(cover%low(k) + cover%high(k))
      cover%moment(e) = cover%moment(e) + part**3/12.0_wp + part*(middle - cover%centre(e))**2
    end do
  end subroutine find_cover

  !> The part of edge e that the edge of pair k covers.
  pure subroutine clip(own, obstacle, e, frame, x, u, is_reference, reach, k, cover)
    type(surface_t), intent(in) :: own, obstacle
    integer, intent(in) :: e, k
    type(frame_t), intent(in) :: frame
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    logical, intent(in) :: is_reference
    real(wp), intent(in) :: reach
    type(cover_t), intent(inout) :: cover
    real(wp) :: normal(2), gap(2), part(2)
    integer :: s
    cover%low(k) = zero
    cover%high(k) = zero
    associate (f => cover%other(k), at => cover%at(:, k))
      normal = normal_between(x, u, obstacle%end_node(1, f), obstacle%end_node(2, f), &
          is_reference)
      if (dot_product(normal, frame%normal) > -cos(smooth_angle)) return
      do s = 1, 2
        at(s) = local_coordinate(own, e, frame, x, u, obstacle%end_node(s, f))
        gap(s) = gap_to_edge(own, e, frame%normal, zero, x, u, obstacle%end_node(s, f))
      end do
      part = [max(zero, at(2)), min(one, at(1))]    ! it runs against the contactor's edge
      if (part(2) - part(1) <= sliver) return
      gap = gap(1) + (gap(2) - gap(1))*(at(1) - part)/(at(1) - at(2))
      if (minval(gap) > reach) return
      if (maxval(gap) < -deepest*min(own%length(e), obstacle%length(f))) return
    end associate
    cover%low(k) = part(1)
    cover%high(k) = part(2)
  end subroutine clip

end module contact_mortar_cover
