! SPDX-License-Identifier: BSD-3-Clause
!> The mass DISPERSION of one element: its points, and in space the repair of its row sums.
module element_dispersion
  use base_kinds, only: wp, zero, one
  use element_base, only: element_t, gauss
  implicit none
  private
  public :: tuned_points, keep_row_sums

contains

  !> Points +-a (dim) with a^2 = (2/3)(1 - nu^2), nu = c dt/h in each parametric direction,
  !> clipped to [0, 1] (Guddati & Yue 2004, tuned to the mid-point rule in time). Coordinates x
  !> (dim, nodes) [L], path = c dt [L]; courant: nu of every direction instead, where not
  !> negative. With a direction of travel only the parametric direction next to it is tuned, the
  !> others have Gauss points.
  pure function tuned_points(element, x, path, courant, travel) result(a)
    class(element_t), intent(in) :: element
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: path, courant
    real(wp), intent(in), optional :: travel(:)
    real(wp) :: a(size(x, 1)), nu(size(x, 1)), along
    integer :: k
    nu = courant
    if (courant < zero) nu = path/element%sizes(x)
    nu = min(one, max(zero, nu))
    a = sqrt(2.0_wp/3.0_wp*(one - nu)*(one + nu))
    if (.not. present(travel)) return
    k = next_to(element%directions(x), travel)
    along = a(k)
    a = gauss
    a(k) = along
  end function tuned_points

  !> The column that is nearest in direction.
  pure integer function next_to(across, travel)
    real(wp), intent(in) :: across(:, :), travel(:)
    real(wp) :: cosine(size(across, 2))
    integer :: k
    do k = 1, size(across, 2)
      cosine(k) = abs(dot_product(across(:, k), travel))/sqrt(sum(across(:, k)**2))
    end do
    next_to = maxloc(cosine, dim=1)
  end function next_to

  !> me := d me d, d diagonal and positive, with row sums mass(:) [M]: d_i := sqrt(d_i mass_i/
  !> (me d)_i) until they hold to round-off. What is semi-definite stays so. Row sums that hold
  !> leave me as it is, to the bit. Its entries are not negative, those on its diagonal
  !> positive, so such a d exists and is unique (Marshall & Olkin 1968).
  pure subroutine keep_row_sums(mass, me)
    real(wp), intent(in) :: mass(:)
    real(wp), intent(inout) :: me(:, :)
    integer, parameter :: most_passes = 200
    real(wp), parameter :: round_off = 16.0_wp*epsilon(one)
    real(wp) :: d(size(mass)), sums(size(mass))
    integer :: i, pass
    d = one
    do pass = 1, most_passes
      sums = d*matmul(me, d)
      if (all(abs(sums - mass) <= round_off*mass)) exit
      d = d*sqrt(mass/sums)
    end do
    if (pass == 1) return
    do i = 1, size(mass)
      me(:, i) = (d*d(i))*me(:, i)
    end do
  end subroutine keep_row_sums

end module element_dispersion
