! SPDX-License-Identifier: BSD-3-Clause
!> The true gap of a node before a boundary in space: the distance of the nearest point,
!> negative inside. Its sign is that of the normal of the facet, of the mean of two facets at
!> an edge, of the angle-weighted mean at a vertex.
module contact_space_gap
  use base_kinds, only: wp, zero, one
  use contact_fan, only: fan_t, open_fan
  use contact_sight, only: seen_t, see_facet, distance_2, on_face, on_edge
  use contact_skin, only: skin_t
  implicit none
  private
  public :: gap_before, all_gap, gap_of_nearest

contains

  !> Gap of a place (3, 2) before the facets of a list [L], and the nearest of them and of
  !> those that are next to it; huge and 0 for an empty list.
  pure subroutine gap_before(skin, list, x, u, from, fan, gap, facet)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: list(:)
    real(wp), intent(in) :: from(3, 2)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(fan_t), intent(inout) :: fan
    real(wp), intent(out) :: gap
    integer, intent(out) :: facet
    type(seen_t) :: seen, nearest
    integer :: j
    gap = huge(one)
    facet = 0
    if (size(list) == 0) return
    do j = 1, size(list)
      call see_facet(skin, list(j), x, u, from, .false., seen)
      if (j == 1) nearest = seen
      if (distance_2(seen) < distance_2(nearest)) nearest = seen
    end do
    call gap_of_nearest(skin, x, u, from, nearest, fan, gap)
    facet = nearest%facet
  end subroutine gap_before

  !> The same before all listed facets of a net.
  pure subroutine all_gap(skin, x, u, from, fan, gap, facet)
    type(skin_t), intent(in) :: skin
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(in) :: from(3, 2)
    type(fan_t), intent(inout) :: fan
    real(wp), intent(out) :: gap
    integer, intent(out) :: facet
    integer :: k
    call gap_before(skin, pack([(k, k=1, skin%facets)], skin%is_listed), x, u, from, fan, gap, &
        facet)
  end subroutine all_gap

  !> The gap at the nearest facet, after a look at those that it touches there: the list may not
  !> have had them.
  pure subroutine gap_of_nearest(skin, x, u, from, nearest, fan, gap)
    type(skin_t), intent(in) :: skin
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(in) :: from(3, 2)
    type(seen_t), intent(inout) :: nearest
    type(fan_t), intent(inout) :: fan
    real(wp), intent(out) :: gap
    integer, parameter :: most_walks = 8
    real(wp) :: sign_of, n(3)
    integer :: walk
    logical :: is_nearest
    do walk = 1, most_walks
      if (nearest%feature == on_face) exit
      call walk_on(skin, x, u, from, nearest, n, is_nearest)
      if (is_nearest) exit
    end do
    if (nearest%feature == on_face) then
      sign_of = nearest%gap
    else if (nearest%feature == on_edge) then
      sign_of = -dot_product(n, nearest%y)
      if (skin%beside(2, nearest%which) == 0) sign_of = one
    else
      call open_fan(skin, skin%vertex(nearest%which), x, u, .false., fan)
      sign_of = -dot_product(fan%mean, nearest%y)
    end if
    gap = sign(sqrt(distance_2(nearest)), sign_of)
  end subroutine gap_of_nearest

  !> Looks at the facets round the feature where the nearest point is. n: the sum of their
  !> normals there.
  pure subroutine walk_on(skin, x, u, from, nearest, n, is_nearest)
    type(skin_t), intent(in) :: skin
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(in) :: from(3, 2)
    type(seen_t), intent(inout) :: nearest
    real(wp), intent(out) :: n(3)
    logical, intent(out) :: is_nearest
    type(seen_t) :: best
    integer :: i
    is_nearest = .true.
    n = nearest%normal
    best = nearest
    if (nearest%feature == on_edge) then
      do i = 1, 2
        call look(skin, skin%beside(i, nearest%which), x, u, from, nearest%facet, best, n, &
            is_nearest)
      end do
    else
      do i = skin%first_facet(nearest%which), skin%first_facet(nearest%which + 1) - 1
        call look(skin, skin%facet(i), x, u, from, nearest%facet, best, n, is_nearest)
      end do
    end if
    nearest = best
  end subroutine walk_on

  !> A facet (0: none) other than `known`: its normal to the sum, and is it nearer than the
  !> best?
  pure subroutine look(skin, facet, x, u, from, known, best, n, is_nearest)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: facet, known
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(in) :: from(3, 2)
    type(seen_t), intent(inout) :: best
    real(wp), intent(inout) :: n(3)
    logical, intent(inout) :: is_nearest
    real(wp), parameter :: clearly = one - 1.0e-12_wp
    type(seen_t) :: seen
    if (facet == known .or. facet == 0) return
    call see_facet(skin, facet, x, u, from, .false., seen)
    n = n + seen%normal
    if (.not. distance_2(seen) < clearly*distance_2(best)) return
    best = seen
    is_nearest = .false.
  end subroutine look

end module contact_space_gap
