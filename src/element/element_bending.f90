! SPDX-License-Identifier: BSD-3-Clause
!> Bending modes of four nodes around a quadrilateral: displacements a xi eta beside a mean
!> gradient. What they cost in a quadrilateral and in two triangles, and what the same bending
!> costs a body. (doc/theory.md 1)
module element_bending
  use base_kinds, only: wp, half
  implicit none
  private
  public :: mode_amplitude, quad_mode_energy, quad_mode_moduli, &
      energy_of_modes, pair_mode_energy, bending_energy

contains

  !> Amplitude a [L] of the modes in displacements u (2, 4) [L] of the nodes x (2, 4) [L]: what
  !> their mean gradient leaves (Flanagan & Belytschko 1981). The strains of the modes are
  !> orthogonal to the mean strain, in any quadrilateral.
  pure function mode_amplitude(x, u) result(a)
    real(wp), intent(in) :: x(2, 4), u(2, 4)
    real(wp) :: a(2), r(2), s(2), v(2)
    r = x(:, 3) - x(:, 1)
    s = x(:, 4) - x(:, 2)
    v = (x(:, 1) - x(:, 2)) + (x(:, 3) - x(:, 4))
    ! The mean gradient takes the diagonals r and s to their changes.
    a = 0.25_wp*((u(:, 1) - u(:, 2)) + (u(:, 3) - u(:, 4)) &
        - ((u(:, 3) - u(:, 1))*(v(1)*s(2) - v(2)*s(1)) &
        + (u(:, 4) - u(:, 2))*(r(1)*v(2) - r(2)*v(1)))/(r(1)*s(2) - r(2)*s(1)))
  end function mode_amplitude

  !> Energy [F L] of amplitude a in a quadrilateral whose stiffness relative to its first node
  !> is k [F/L].
  pure real(wp) function quad_mode_energy(k, a)
    real(wp), intent(in) :: k(6, 6), a(2)
    quad_mode_energy = energy_of_modes(quad_mode_moduli(k), a)
  end function quad_mode_energy

  !> What of its stiffness the modes feel: of both directions, and between them [F/L].
  pure function quad_mode_moduli(k) result(m)
    real(wp), intent(in) :: k(6, 6)
    real(wp) :: m(3)
    m(1) = k(1, 1) + 2.0_wp*k(1, 5) + k(5, 5)
    m(2) = k(2, 2) + 2.0_wp*k(2, 6) + k(6, 6)
    m(3) = k(1, 2) + k(1, 6) + k(5, 2) + k(5, 6)
  end function quad_mode_moduli

  !> Energy [F L] of amplitude a from quad_mode_moduli.
  pure real(wp) function energy_of_modes(m, a)
    real(wp), intent(in) :: m(3), a(2)
    energy_of_modes = 2.0_wp*(a(1)**2*m(1) + a(2)**2*m(2) + 2.0_wp*a(1)*a(2)*m(3))
  end function energy_of_modes

  !> Energy [F L] of amplitude a in two triangles that share the edge between the
  !> second and the fourth node: that of the jump of their strains. pressure, shear: moduli
  !> sxx/exx and sxy/gxy times thickness [F/L].
  pure real(wp) function pair_mode_energy(x, a, pressure, shear)
    real(wp), intent(in) :: x(2, 4), a(2), pressure, shear
    real(wp) :: e(2), area(2)
    integer :: k
    e = x(:, 4) - x(:, 2)
    do k = 1, 2
      area(k) = half*abs(e(1)*(x(2, 2*k - 1) - x(2, 2)) - e(2)*(x(1, 2*k - 1) - x(1, 2)))
    end do
    pair_mode_energy = half*(area(1) + area(2))/(area(1)*area(2)) &
        *(pressure*(a(1)*e(2) - a(2)*e(1))**2 + shear*(a(1)*e(1) + a(2)*e(2))**2)
  end function pair_mode_energy

  !> Energy [F L] of a parallelogram whose corners move by a, -a, a, -a and which
  !> bends as a body does: stress along each pair of sides, linear across, no shear. modulus:
  !> stress/strain of a bar, E in plane stress, E/(1 - nu^2) in plane strain, times thickness
  !> [F/L]. Of other quadrilaterals the parallelogram of their mean edges is taken.
  pure real(wp) function bending_energy(x, a, modulus)
    real(wp), intent(in) :: x(2, 4), a(2), modulus
    real(wp) :: g(2), f(2)
    g = 0.25_wp*((x(:, 2) - x(:, 1)) + (x(:, 3) - x(:, 4)))
    f = 0.25_wp*((x(:, 4) - x(:, 1)) + (x(:, 3) - x(:, 2)))
    bending_energy = 4.0_wp*(g(1)*f(2) - g(2)*f(1))*modulus/6.0_wp &
        *(((a(1)*g(1) + a(2)*g(2))/(g(1)**2 + g(2)**2))**2 &
        + ((a(1)*f(1) + a(2)*f(2))/(f(1)**2 + f(2)**2))**2)
  end function bending_energy

end module element_bending
