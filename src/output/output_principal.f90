! SPDX-License-Identifier: BSD-3-Clause
!> Principal stresses.
module output_principal
  use base_kinds, only: wp, zero, half, one
  implicit none
  private
  public :: fill_principal

contains

  !> Principal stresses (3, n), the largest first, of stresses (6, n) xx yy zz xy yz zx [F/L2]:
  !> in the plane in closed form, in space by rotations.
  pure subroutine fill_principal(dim, stress, values)
    integer, intent(in) :: dim
    real(wp), intent(in) :: stress(:, :)
    real(wp), intent(inout) :: values(:, :)
    integer :: k
    do k = 1, size(stress, 2)
      if (dim == 2) values(:, k) = in_plane(stress(:, k))
      if (dim == 3) values(:, k) = in_space(stress(:, k))
    end do
  end subroutine fill_principal

  pure function in_plane(stress) result(values)
    real(wp), intent(in) :: stress(6)
    real(wp) :: values(3)
    real(wp) :: mean, radius, high, low
    mean = half*(stress(1) + stress(2))
    radius = sqrt((half*(stress(1) - stress(2)))**2 + stress(4)**2)
    high = mean + radius
    low = mean - radius
    values(1) = max(high, stress(3))
    values(3) = min(low, stress(3))
    values(2) = (high + low + stress(3)) - values(1) - values(3)
    if (stress(3) >= high) values(2) = high
    if (stress(3) <= low) values(2) = low
    if (stress(3) > low .and. stress(3) < high) values(2) = stress(3)
  end function in_plane

  !> Jacobi's rotations (Golub & Van Loan 1996, 8.4), each of which makes one entry zero; they
  !> converge quadratically, six passes leave round-off.
  pure function in_space(stress) result(values)
    real(wp), intent(in) :: stress(6)
    real(wp) :: values(3)
    !> An entry that changes no digit of the values.
    real(wp), parameter :: negligible = 1.0e-20_wp
    real(wp) :: a(3, 3), t, c, s, r(3, 3)
    integer :: pass, p, q, k
    a = reshape(stress([1, 4, 6, 4, 2, 5, 6, 5, 3]), [3, 3])
    do pass = 1, 6
      do k = 1, 3
        p = min(k, 1 + mod(k, 3))
        q = max(k, 1 + mod(k, 3))
        if (.not. abs(a(p, q)) > negligible*maxval(abs(a))) cycle
        t = half*(a(q, q) - a(p, p))/a(p, q)
        t = sign(one, t)/(abs(t) + sqrt(one + t**2))
        c = one/sqrt(one + t**2)
        s = t*c
        r = reshape([one, zero, zero, zero, one, zero, zero, zero, one], [3, 3])
        r(p, p) = c
        r(q, q) = c
        r(p, q) = s
        r(q, p) = -s
        a = matmul(transpose(r), matmul(a, r))
        a(p, q) = zero
        a(q, p) = zero
      end do
    end do
    values = [a(1, 1), a(2, 2), a(3, 3)]
    values = [maxval(values), sum(values) - maxval(values) - minval(values), minval(values)]
    do k = 1, 3
      if (a(k, k) < values(1) .and. a(k, k) > values(3)) values(2) = a(k, k)
    end do
  end function in_space

end module output_principal
