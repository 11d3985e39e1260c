! SPDX-License-Identifier: BSD-3-Clause
!> Quadrilaterals and triangles turned about the y axis. Two Gauss points each way, and one in a
!> triangle, integrate what a linear field asks of them exactly, so both pass the patch test.
module element_ring
  use base_kinds, only: wp, one, two
  use element_base, only: circumference
  use element_quad4, only: quad4_t, new_quad4
  use element_tri3, only: tri3_t, new_tri3
  implicit none
  private

  type, extends(tri3_t), public :: tri3_ring_t
  contains
    procedure :: stiffness => tri3_ring_stiffness
    procedure :: mass => tri3_ring_mass
    procedure :: mean_strain_matrix => tri3_ring_mean_strain_matrix
  end type tri3_ring_t

  public :: new_quad4_ring, new_tri3_ring

contains

  !> The quadrilateral: all that is its own follows from is_ring.
  pure function new_quad4_ring() result(element)
    type(quad4_t) :: element
    element = new_quad4()
    element%name = 'QUAD4AX'
    element%is_ring = .true.
  end function new_quad4_ring

  !> The triangle.
  pure function new_tri3_ring() result(element)
    type(tri3_ring_t) :: element
    element%tri3_t = new_tri3()
    element%name = 'TRI3AX'
    element%is_ring = .true.
  end function new_tri3_ring

  !> B' D B of the centroid times the volume (Zienkiewicz & Taylor 2000, vol. 1, 5.2).
  pure subroutine tri3_ring_stiffness(this, x, d, thickness, ke)
    class(tri3_ring_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: d(:, :)
    real(wp), intent(in) :: thickness
    real(wp), intent(out) :: ke(:, :)
    real(wp) :: b(4, 6), k(6, 6)
    call this%mean_strain_matrix(x, b)
    k = matmul(transpose(b), matmul(d, b))
    ke(1:6, 1:6) = 0.25_wp*thickness*circumference(x, spread(one/3.0_wp, 1, 3)) &
        *this%smallest_jacobian(x)*(k + transpose(k))
  end subroutine tri3_ring_stiffness

  !> Strains of the centroid.
  pure subroutine tri3_ring_mean_strain_matrix(this, x, b)
    class(tri3_ring_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(out) :: b(:, :)
    call this%tri3_t%mean_strain_matrix(x, b(:3, :))
    b(4, 1::2) = one/sum(x(1, :))
    b(4, 2::2) = 0.0_wp
  end subroutine tri3_ring_mean_strain_matrix

  !> Exact integral of 2 pi x N N'.
  pure subroutine tri3_ring_mass(this, x, density, thickness, a, me)
    class(tri3_ring_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: density
    real(wp), intent(in) :: thickness
    real(wp), intent(in) :: a(:)
    real(wp), intent(out) :: me(:, :)
    integer :: i, j
    do j = 1, 3
      do i = 1, 3
        me(i, j) = two*acos(-one)*density*thickness*this%smallest_jacobian(x) &
            *(x(1, i) + x(1, j) + sum(x(1, :)))/120.0_wp
      end do
      me(j, j) = two*me(j, j)
    end do
  end subroutine tri3_ring_mass

end module element_ring
