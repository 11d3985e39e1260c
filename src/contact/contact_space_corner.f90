! SPDX-License-Identifier: BSD-3-Clause
!> Normals at a convex edge or vertex in space: planes that keep the obstacle's feature and a
!> node before it apart. Their normals are those of facets of the obstacle that the node faces,
!> and those of the node's own facets, reversed, that the obstacle stays behind. The space
!> outside is a union of half-spaces, so that the motion of the node decides (contact_corner).
module contact_space_corner
  use base_kinds, only: wp, zero
  use contact_corner, only: instant_of_leaving, never
  use contact_fan, only: fan_t, supports
  use contact_features, only: smooth_angle, degree
  implicit none
  private

  integer, parameter, public :: most_normals = 64
  real(wp), parameter :: exact = 1.0e-7_wp              !< sines: directions in a cone
  real(wp), parameter :: slack = sin(10.0_wp*degree)    !< cones that miss each other by less

  public :: common_normals, choose_of, spread_of

contains

  !> Normals that a feature with facets `facet` and directions `direction` (3, *) within the
  !> body has in common with a node's fan, the first n.
  pure subroutine common_normals(facet, direction, fan, normal, n)
    real(wp), intent(in) :: facet(:, :), direction(:, :)
    type(fan_t), intent(in) :: fan
    real(wp), intent(out) :: normal(3, most_normals)
    integer, intent(out) :: n
    real(wp) :: mean(3)
    logical :: is_smooth
    n = 0
    if (fan%is_all) then
      n = min(size(facet, 2), most_normals)
      normal(:, :n) = facet(:, :n)
      return
    end if
    call facing_mean(facet, fan, mean, is_smooth)
    if (is_smooth) then
      if (supports(-mean, direction, slack)) call add_normal(-mean, normal, n)
      return
    end if
    call collect_normals(facet, direction, fan, exact, normal, n)
    if (n == 0) call collect_normals(facet, direction, fan, slack, normal, n)
  end subroutine common_normals

  pure subroutine collect_normals(facet, direction, fan, beyond, normal, n)
    real(wp), intent(in) :: facet(:, :), direction(:, :), beyond
    type(fan_t), intent(in) :: fan
    real(wp), intent(inout) :: normal(3, most_normals)
    integer, intent(inout) :: n
    integer :: k
    do k = 1, size(facet, 2)
      if (supports(-facet(:, k), fan%edge(:, :fan%edges), beyond) .and. &
          supports(facet(:, k), direction, beyond)) call add_normal(facet(:, k), normal, n)
    end do
    do k = 1, fan%facets
      if (supports(-fan%normal(:, k), direction, beyond) .and. &
          supports(fan%normal(:, k), fan%edge(:, :fan%edges), beyond)) &
          call add_normal(-fan%normal(:, k), normal, n)
    end do
  end subroutine collect_normals

  !> Mean of the node's own normals that face one of the facets; is_smooth: they are nearly one.
  pure subroutine facing_mean(facet, fan, mean, is_smooth)
    real(wp), intent(in) :: facet(:, :)
    type(fan_t), intent(in) :: fan
    real(wp), intent(out) :: mean(3)
    logical, intent(out) :: is_smooth
    real(wp), parameter :: facing = -0.5_wp
    integer :: k
    mean = zero
    do k = 1, fan%facets
      if (counts(k)) mean = mean + fan%normal(:, k)
    end do
    is_smooth = norm2(mean) > zero
    if (.not. is_smooth) return
    mean = mean/norm2(mean)
    do k = 1, fan%facets
      if (counts(k)) is_smooth = is_smooth .and. &
          dot_product(mean, fan%normal(:, k)) > cos(smooth_angle)
    end do
  contains
    !> Does facet k of the fan face one of the facets?
    pure logical function counts(k)
      integer, intent(in) :: k
      integer :: j
      counts = .false.
      do j = 1, size(facet, 2)
        counts = counts .or. dot_product(fan%normal(:, k), facet(:, j)) < facing
      end do
    end function counts
  end subroutine facing_mean

  !> Adds a normal that is not among them yet.
  pure subroutine add_normal(new, normal, n)
    real(wp), intent(in) :: new(3)
    real(wp), intent(inout) :: normal(3, most_normals)
    integer, intent(inout) :: n
    real(wp), parameter :: same = 1.0e-9_wp
    integer :: k
    do k = 1, n
      if (sum(abs(normal(:, k) - new)) < same) return
    end do
    if (n == most_normals) return
    n = n + 1
    normal(:, n) = new
  end subroutine add_normal

  !> Largest sine of half the angle between two of the normals, doubled: their spread [radians].
  pure real(wp) function spread_of(normal)
    real(wp), intent(in) :: normal(:, :)
    integer :: i, j
    spread_of = zero
    do i = 1, size(normal, 2)
      do j = 1, i - 1
        spread_of = max(spread_of, norm2(normal(:, i) - normal(:, j)))
      end do
    end do
  end function spread_of

  !> Of the normals that whose half-space n.(y + f) >= 0 the free motion f leaves least; where
  !> it leaves all by more than `enough`, last. The mean of those that tie. y: the node from
  !> the feature [L].
  pure subroutine choose_of(normal, y, f, enough, length, n)
    real(wp), intent(in) :: normal(:, :), y(3), f(3), enough, length
    real(wp), intent(out) :: n(3)
    real(wp) :: m(most_normals), t(most_normals), largest, last, tie
    logical :: is_chosen
    integer :: k, count
    count = size(normal, 2)
    tie = 1.0e-9_wp*length
    do k = 1, count
      m(k) = dot_product(normal(:, k), y + f)
      t(k) = instant_of_leaving(dot_product(normal(:, k), y), m(k))
    end do
    largest = maxval(m(:count))
    last = maxval(t(:count))
    n = zero
    do k = 1, count
      is_chosen = m(k) >= largest - tie
      if (largest < -enough) is_chosen = t(k) >= last
      if (largest < -enough .and. last < never) is_chosen = (last - t(k))*norm2(f) <= tie
      if (is_chosen) n = n + normal(:, k)
    end do
    n = n/norm2(n)
    do k = 1, count           ! round-off of the mean of one
      if (sum(abs(n - normal(:, k))) < 1.0e-12_wp) n = normal(:, k)
    end do
  end subroutine choose_of

end module contact_space_corner
