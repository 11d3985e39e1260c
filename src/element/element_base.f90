! SPDX-License-Identifier: BSD-3-Clause
!> What an element type offers: matrices of one element from plain arrays, no mesh.
module element_base
  use base_kinds, only: wp, zero, one
  implicit none
  private
  integer, parameter, public :: most_nodes = 4   !< of an element

  type, abstract, public :: element_t
    character(8) :: name = ''
    integer :: nodes = 0
  contains
    procedure(stiffness_i), deferred :: stiffness
    procedure(mass_i), deferred :: mass
    procedure(sizes_i), deferred :: sizes
    procedure(jacobian_i), deferred :: smallest_jacobian
    procedure(strain_i), deferred :: mean_strain_matrix
    procedure :: mean_strain => element_mean_strain
    procedure :: lumped_mass => element_lumped_mass
  end type element_t

  !> An element in a list of elements of several kinds.
  type, public :: element_slot_t
    class(element_t), allocatable :: item
  end type element_slot_t

  abstract interface
    !> Stiffness (2n, 2n) [F/L] from coordinates x (2, n) [L], moduli d (3, 3), thickness [L];
    !> dofs ordered node by node (x, y).
    pure subroutine stiffness_i(this, x, d, thickness, ke)
      import :: element_t, wp
      class(element_t), intent(in) :: this
      real(wp), intent(in) :: x(:, :)
      real(wp), intent(in) :: d(3, 3)
      real(wp), intent(in) :: thickness
      real(wp), intent(out) :: ke(:, :)
    end subroutine stiffness_i
    !> Mass (n, n) [M] integrated at points +-a(i) of parametric direction i.
    pure subroutine mass_i(this, x, density, thickness, a, me)
      import :: element_t, wp
      class(element_t), intent(in) :: this
      real(wp), intent(in) :: x(:, :)
      real(wp), intent(in) :: density
      real(wp), intent(in) :: thickness
      real(wp), intent(in) :: a(2)
      real(wp), intent(out) :: me(:, :)
    end subroutine mass_i
    !> Width in each parametric direction [L]: the distance of opposite edge midpoints.
    pure function sizes_i(this, x) result(h)
      import :: element_t, wp
      class(element_t), intent(in) :: this
      real(wp), intent(in) :: x(:, :)
      real(wp) :: h(2)
    end function sizes_i
    !> Smallest determinant of the Jacobian at a corner [L2]; not positive: clockwise or
    !> degenerate.
    pure function jacobian_i(this, x) result(j)
      import :: element_t, wp
      class(element_t), intent(in) :: this
      real(wp), intent(in) :: x(:, :)
      real(wp) :: j
    end function jacobian_i
    !> Mean over the Gauss points of B (3, 2n) [1/L]: strains (exx, eyy, gxy) of unit
    !> displacements, dofs ordered node by node.
    pure subroutine strain_i(this, x, b)
      import :: element_t, wp
      class(element_t), intent(in) :: this
      real(wp), intent(in) :: x(:, :)
      real(wp), intent(out) :: b(:, :)
    end subroutine strain_i
  end interface

contains

  !> Mean strain (exx, eyy, gxy) of displacements u (2, n) [L]; a translation of the element is
  !> taken off first.
  pure function element_mean_strain(this, x, u) result(strain)
    class(element_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: u(:, :)
    real(wp) :: strain(3), b(3, 2*most_nodes), d(2)
    integer :: i
    call this%mean_strain_matrix(x, b(:, :2*size(u, 2)))
    strain = zero
    do i = 2, size(u, 2)
      d(1) = u(1, i) - u(1, 1)
      d(2) = u(2, i) - u(2, 1)
      strain = strain + (b(:, 2*i - 1)*d(1) + b(:, 2*i)*d(2))
    end do
  end function element_mean_strain

  !> Lumped mass (n) [M]: row sums of the consistent one.
  pure function element_lumped_mass(this, x, density, thickness) result(mass)
    class(element_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: density
    real(wp), intent(in) :: thickness
    real(wp) :: mass(size(x, 2)), me(size(x, 2), size(x, 2))
    real(wp), parameter :: gauss = one/sqrt(3.0_wp)
    integer :: k
    call this%mass(x, density, thickness, [gauss, gauss], me)
    do k = 1, size(x, 2)
      mass(k) = sum(me(:, k))
    end do
  end function element_lumped_mass

end module element_base
