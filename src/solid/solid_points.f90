! SPDX-License-Identifier: BSD-3-Clause
!> Kinematics at the points of an element, total Lagrangian: displacement gradient H, Green's
!> strain E = (H + H' + H'H)/2, which keeps the digits of small strains, and the matrix B of
!> dE = B dU. Strains are (E11, E22, 2 E12) in the plane, (E11, E22, E33, 2 E12, 2 E23, 2 E31)
!> in space, (E11, E22, 2 E12, E33) around the y axis. There slopes have a third column, N_a/R
!> with the radius R of the point, H a third one with H33 = u_r/R first, and displacements u_r
!> are no relative ones.
module solid_points
  use base_kinds, only: wp, zero, one, half
  implicit none
  private
  public :: displacement_gradient, green_strain, strain_matrix, add_stress_force, &
      add_material_part, add_geometric_part

contains

  !> H(i, j) = dU_i/dX_j from displacements u (dim, nodes) relative to the first node and slopes
  !> (nodes, columns) [1/L]: a translation leaves no trace in the digits.
  pure subroutine displacement_gradient(u, slope, h)
    real(wp), intent(in) :: u(:, :), slope(:, :)
    real(wp), intent(out) :: h(:, :)
    real(wp) :: h11, h21, h12, h22
    integer :: a, i, j
    if (size(h, 2) == 2) then
      h11 = zero
      h21 = zero
      h12 = zero
      h22 = zero
      do a = 2, size(u, 2)
        h11 = h11 + u(1, a)*slope(a, 1)
        h21 = h21 + u(2, a)*slope(a, 1)
        h12 = h12 + u(1, a)*slope(a, 2)
        h22 = h22 + u(2, a)*slope(a, 2)
      end do
      h(1, 1) = h11
      h(2, 1) = h21
      h(1, 2) = h12
      h(2, 2) = h22
      return
    end if
    h = zero
    do j = 1, size(h, 2)
      do a = merge(1, 2, is_ring(h)), size(u, 2)
        do i = 1, size(h, 1)
          h(i, j) = h(i, j) + u(i, a)*slope(a, j)
        end do
      end do
    end do
  end subroutine displacement_gradient

  !> Is there a third column of what is around the axis?
  pure logical function is_ring(h)
    real(wp), intent(in) :: h(:, :)
    is_ring = size(h, 2) > size(h, 1)
  end function is_ring

  !> Green's strain of a displacement gradient.
  pure subroutine green_strain(h, e)
    real(wp), intent(in) :: h(:, :)
    real(wp), intent(out) :: e(:)
    integer :: k
    if (size(h, 1) == 2) then
      do k = 1, 2
        e(k) = h(k, k) + half*(h(1, k)**2 + h(2, k)**2)
      end do
      e(3) = h(1, 2) + h(2, 1) + h(1, 1)*h(1, 2) + h(2, 1)*h(2, 2)
      if (is_ring(h)) e(4) = h(1, 3) + half*h(1, 3)**2
    else
      do k = 1, 3
        e(k) = h(k, k) + half*(h(1, k)**2 + h(2, k)**2 + h(3, k)**2)
      end do
      e(4) = h(1, 2) + h(2, 1) + dot_product(h(:, 1), h(:, 2))
      e(5) = h(2, 3) + h(3, 2) + dot_product(h(:, 2), h(:, 3))
      e(6) = h(3, 1) + h(1, 3) + dot_product(h(:, 3), h(:, 1))
    end if
  end subroutine green_strain

  !> B (strains, dim nodes) = sym(F' dN/dX) at F = I + H: dofs node by node.
  pure subroutine strain_matrix(h, slope, b)
    real(wp), intent(in) :: h(:, :), slope(:, :)
    real(wp), intent(out) :: b(:, :)
    real(wp) :: f(size(h, 1), size(h, 1))
    integer :: a, i, d, c
    d = size(h, 1)
    f = h(:, :d)
    do i = 1, d
      f(i, i) = one + h(i, i)
    end do
    if (is_ring(h)) b(4, :) = zero
    do a = 1, size(slope, 1)
      if (is_ring(h)) b(4, 2*a - 1) = (one + h(1, 3))*slope(a, 3)
      do i = 1, d
        c = d*(a - 1) + i
        b(1, c) = f(i, 1)*slope(a, 1)
        b(2, c) = f(i, 2)*slope(a, 2)
        if (d == 2) then
          b(3, c) = f(i, 1)*slope(a, 2) + f(i, 2)*slope(a, 1)
        else
          b(3, c) = f(i, 3)*slope(a, 3)
          b(4, c) = f(i, 1)*slope(a, 2) + f(i, 2)*slope(a, 1)
          b(5, c) = f(i, 2)*slope(a, 3) + f(i, 3)*slope(a, 2)
          b(6, c) = f(i, 3)*slope(a, 1) + f(i, 1)*slope(a, 3)
        end if
      end do
    end do
  end subroutine strain_matrix

  !> force (dim, nodes) = force + factor (F S) dN/dX at F = I + H [F].
  pure subroutine add_stress_force(factor, h, s, slope, force)
    real(wp), intent(in) :: factor, h(:, :), s(:), slope(:, :)
    real(wp), intent(inout) :: force(:, :)
    real(wp) :: p(3, 3), stress(3, 3)
    integer :: a, i, j, d
    d = size(h, 1)
    call put_stress(factor, s, stress)
    do j = 1, d
      do i = 1, d
        p(i, j) = stress(i, j) + h(i, 1)*stress(1, j) + h(i, 2)*stress(2, j)
        if (d == 3) p(i, j) = p(i, j) + h(i, 3)*stress(3, j)
      end do
    end do
    do a = 1, size(slope, 1)
      do i = 1, d
        force(i, a) = force(i, a) + p(i, 1)*slope(a, 1) + p(i, 2)*slope(a, 2)
        if (d == 3) force(i, a) = force(i, a) + p(i, 3)*slope(a, 3)
      end do
      if (is_ring(h)) force(1, a) = force(1, a) + factor*(one + h(1, 3))*s(4)*slope(a, 3)
    end do
  end subroutine add_stress_force

  !> factor times the stress, as a matrix of a size that needs no memory anew, without what is
  !> around an axis.
  pure subroutine put_stress(factor, s, stress)
    real(wp), intent(in) :: factor, s(:)
    real(wp), intent(out) :: stress(3, 3)
    if (size(s) < 6) then
      stress(1, 1) = factor*s(1)
      stress(2, 2) = factor*s(2)
      stress(2, 1) = factor*s(3)
      stress(1, 2) = stress(2, 1)
    else
      stress(1, 1) = factor*s(1)
      stress(2, 2) = factor*s(2)
      stress(3, 3) = factor*s(3)
      stress(2, 1) = factor*s(4)
      stress(3, 2) = factor*s(5)
      stress(3, 1) = factor*s(6)
      stress(1, 2) = stress(2, 1)
      stress(2, 3) = stress(3, 2)
      stress(1, 3) = stress(3, 1)
    end if
  end subroutine put_stress

  !> ke = ke + factor B' D B.
  pure subroutine add_material_part(factor, d, b, ke)
    real(wp), intent(in) :: factor, d(:, :), b(:, :)
    real(wp), intent(inout) :: ke(:, :)
    real(wp) :: db(size(d, 1))
    integer :: i, j, k
    do j = 1, size(b, 2)
      db = zero
      do k = 1, size(d, 1)
        db = db + (factor*b(k, j))*d(:, k)
      end do
      do i = 1, size(b, 2)
        ke(i, j) = ke(i, j) + dot_product(b(:, i), db)
      end do
    end do
  end subroutine add_material_part

  !> ke = ke + factor (dN_a/dX . S dN_b/dX) I for each pair of nodes, around an axis and
  !> S33 N_a/R N_b/R for their radial displacements.
  pure subroutine add_geometric_part(factor, s, slope, ke)
    real(wp), intent(in) :: factor, s(:), slope(:, :)
    real(wp), intent(inout) :: ke(:, :)
    real(wp) :: row(3), stress(3, 3), value
    integer :: a, b, i, d
    d = merge(3, 2, size(s) == 6)
    call put_stress(factor, s, stress)
    do b = 1, size(slope, 1)
      do i = 1, d
        row(i) = stress(i, 1)*slope(b, 1) + stress(i, 2)*slope(b, 2)
        if (d == 3) row(i) = row(i) + stress(i, 3)*slope(b, 3)
      end do
      do a = 1, size(slope, 1)
        value = slope(a, 1)*row(1) + slope(a, 2)*row(2)
        if (d == 3) value = value + slope(a, 3)*row(3)
        do i = 1, d
          ke(d*(a - 1) + i, d*(b - 1) + i) = ke(d*(a - 1) + i, d*(b - 1) + i) + value
        end do
        if (size(s) == 4) ke(2*a - 1, 2*b - 1) = ke(2*a - 1, 2*b - 1) &
            + factor*s(4)*slope(a, 3)*slope(b, 3)
      end do
    end do
  end subroutine add_geometric_part

end module solid_points
