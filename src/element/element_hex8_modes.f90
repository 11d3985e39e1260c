! SPDX-License-Identifier: BSD-3-Clause
!> The hexahedron with incompatible modes (Wilson et al. 1973; Taylor, Beresford & Wilson 1976):
!> exact bending of one layer, no volumetric locking.
module element_hex8_modes
  use base_kinds, only: wp, zero, half, two
  use element_base, only: strain_matrix
  use element_hex8, only: hex8_t, new_hex8
  implicit none
  private

  type, extends(hex8_t), public :: hex8_modes_t
  contains
    procedure :: stiffness => hex8_modes_stiffness
  end type hex8_modes_t

  public :: new_hex8_modes

contains

  !> Its data.
  pure function new_hex8_modes() result(element)
    type(hex8_modes_t) :: element
    element%hex8_t = new_hex8()
    element%name = 'HEX8MODE'
  end function new_hex8_modes

  !> K - L' H^-1 L: the nine amplitudes of the modes 1 - xi_i^2 condensed, L and H the products
  !> of their strains with those of the nodes and with each other.
  pure subroutine hex8_modes_stiffness(this, x, d, thickness, ke)
    class(hex8_modes_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: d(:, :)
    real(wp), intent(in) :: thickness
    real(wp), intent(out) :: ke(:, :)
    real(wp) :: n(8), dn(8, 3), det_j, b(6, 24), g(6, 9), db(6, 24), points(3, 8), w(8)
    real(wp) :: h(9, 9), l(9, 24), to_space(3, 3), det_0
    integer :: k, count
    call centre(x, to_space, det_0)
    call this%rule(count, points, w)
    ke = zero
    h = zero
    l = zero
    do k = 1, count
      call this%gradients(x, points(:, k), n, dn, det_j)
      call strain_matrix(dn, b)
      call strain_matrix(mode_gradients(points(:, k), to_space, det_0/det_j), g)
      db = thickness*det_j*w(k)*matmul(d, b)
      ke = ke + matmul(transpose(b), db)
      l = l + matmul(transpose(g), db)
      h = h + thickness*det_j*w(k)*matmul(transpose(g), matmul(d, g))
    end do
    call condense(h, l, ke)
    ke = half*(ke + transpose(ke))
  end subroutine hex8_modes_stiffness

  !> ke = ke - L' H^-1 L, by elimination; H is positive definite.
  pure subroutine condense(h, l, ke)
    real(wp), intent(inout) :: h(:, :), l(:, :), ke(:, :)
    integer :: i, j, k
    do k = 1, size(h, 1)
      do j = 1, size(ke, 2)
        ke(:, j) = ke(:, j) - l(k, :)*(l(k, j)/h(k, k))
      end do
      do i = k + 1, size(h, 1)
        l(i, :) = l(i, :) - h(i, k)/h(k, k)*l(k, :)
        h(i, k + 1:) = h(i, k + 1:) - h(i, k)/h(k, k)*h(k, k + 1:)
      end do
    end do
  end subroutine condense

  !> Inverse and determinant of the Jacobian at the centre.
  pure subroutine centre(x, to_space, det)
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(out) :: to_space(3, 3), det
    type(hex8_t) :: plain
    real(wp) :: n(8), dn(8, 3), local(8, 3)
    integer :: i, k
    call plain%gradients(x, [zero, zero, zero], n, dn, det)
    call plain%shape([zero, zero, zero], n, local)
    ! dn = local J^-1; the columns of local are orthogonal, of squared length 1/8.
    do i = 1, 3
      do k = 1, 3
        to_space(i, k) = 8.0_wp*dot_product(local(:, i), dn(:, k))
      end do
    end do
  end subroutine centre

  !> Gradients (modes, 3) of 1 - xi_i^2: -2 xi_i times row i of J0^-1, times det J0/det J, which
  !> makes their mean over the volume zero, so that the patch test holds.
  pure function mode_gradients(xi, to_space, ratio) result(dn)
    real(wp), intent(in) :: xi(:), to_space(3, 3), ratio
    real(wp) :: dn(3, 3)
    integer :: i
    do i = 1, 3
      dn(i, :) = -two*xi(i)*ratio*to_space(i, :)
    end do
  end function mode_gradients

end module element_hex8_modes
