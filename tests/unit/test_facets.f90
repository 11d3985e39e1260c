! SPDX-License-Identifier: BSD-3-Clause
!> Facets in space: the closest point against brute force, whatever corner comes first.
program test_facets
  use base_kinds, only: wp, zero, one, half
  use check, only: test_start, test_end, check_true, check_close, seed_random
  use contact_closest, only: closest_on_facet
  implicit none

  call test_start('facets')
  call seed_random(3)
  call test_closest(3, 4000)
  call test_closest(4, 4000)
  call test_end()

contains

  !> Random facets, in-plane distortion .15, warped by up to .3 of an edge, and points up to .6
  !> off and beyond their rims: no point of a grid of 41 x 41 is nearer, and another first
  !> corner or the other sense gives the same distance.
  subroutine test_closest(corners, trials)
    integer, intent(in) :: corners, trials
    real(wp) :: x(3, corners), p(3), shift(3, corners), d, other, wrong, turned
    integer :: k, s
    wrong = zero
    turned = zero
    do k = 1, trials
      call random_number(shift)
      x = zero
      x(1:2, 2) = [one, zero]
      x(1:2, 3) = merge([one, one], [zero, one], corners == 4)
      if (corners == 4) x(1:2, 4) = [zero, one]
      x(1:2, :) = x(1:2, :) + 0.3_wp*(shift(1:2, :) - half)
      x(3, :) = 0.3_wp*shift(3, :)
      call random_number(p)
      p = [2.2_wp, 2.2_wp, 1.2_wp]*(p - half) + [half, half, zero]
      d = distance(x, p)
      wrong = max(wrong, d - smallest_of_grid(x, p))
      do s = 1, corners - 1
        other = distance(cshift(x, s, dim=2), p)
        turned = max(turned, abs(other - d))
      end do
      turned = max(turned, abs(distance(x(:, corners:1:-1), p) - d))
    end do
    call check_true(wrong <= 1.0e-12_wp, 'the closest point of a facet')
    call check_close(turned, zero, 1.0e-12_wp, 'whatever corner comes first')
  end subroutine test_closest

  real(wp) function distance(x, p)
    real(wp), intent(in) :: x(:, :), p(3)
    real(wp) :: at(2), weight(size(x, 2))
    call closest_on_facet(x, p, at, weight)
    call check_true(abs(sum(weight) - one) <= 1.0e-14_wp .and. minval(weight) >= -1.0e-15_wp, &
        'weights of a point of the facet')
    distance = norm2(matmul(x, weight) - p)
  end function distance

  real(wp) function smallest_of_grid(x, p)
    real(wp), intent(in) :: x(:, :), p(3)
    integer, parameter :: m = 40
    real(wp) :: s, t, weight(size(x, 2))
    integer :: i, j
    smallest_of_grid = huge(one)
    do j = 0, m
      do i = 0, m
        s = real(i, wp)/m
        t = real(j, wp)/m
        if (size(x, 2) == 3) then
          if (i + j > m) cycle
          weight = [one - s - t, s, t]
        else
          weight = [(one - s)*(one - t), s*(one - t), s*t, (one - s)*t]
        end if
        smallest_of_grid = min(smallest_of_grid, norm2(matmul(x, weight) - p))
      end do
    end do
  end function smallest_of_grid

end program test_facets
