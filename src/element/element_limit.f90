! SPDX-License-Identifier: BSD-3-Clause
!> The largest step of the central difference on one element with lumped mass.
module element_limit
  use base_kinds, only: wp, two
  use element_base, only: element_t
  use linalg_dense, only: largest_by_lapack
  implicit none
  private
  public :: stable_step

contains

  !> h = 2/omega [T], omega^2 the largest eigenvalue of M^-1 K with the lumped mass of the
  !> element. No frequency of a mesh, with supports or without, is above the largest of its
  !> elements (Irons & Ahmad 1980), so the smallest of these steps is safe for all of it.
  !> Coordinates x (dim, n) [L], density [M/L3], moduli d [F/L2], thickness [L].
  subroutine stable_step(element, x, density, d, thickness, h)
    class(element_t), intent(in) :: element
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: density
    real(wp), intent(in) :: d(:, :)
    real(wp), intent(in) :: thickness
    real(wp), intent(out) :: h
    real(wp) :: ke(size(x), size(x)), mass(size(x, 2)), omega2
    real(wp) :: root(size(x))
    integer :: j
    call element%stiffness(x, d, thickness, ke)
    mass = element%lumped_mass(x, density, thickness)
    do j = 1, size(x, 1)
      root(j::size(x, 1)) = sqrt(mass)
    end do
    do j = 1, size(ke, 2)
      ke(:, j) = ke(:, j)/(root*root(j))
    end do
    call largest_by_lapack(ke, omega2)
    h = two/sqrt(omega2)
  end subroutine stable_step

end module element_limit
