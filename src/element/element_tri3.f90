! SPDX-License-Identifier: BSD-3-Clause
!> The triangle of constant strain.
module element_tri3
  use base_kinds, only: wp, zero, one, half
  use element_base, only: element_t
  implicit none
  private

  type, extends(element_t), public :: tri3_t
  contains
    procedure :: shape => tri3_shape
    procedure :: rule => tri3_rule
    procedure :: stiffness => tri3_stiffness
    procedure :: mass => tri3_mass
    procedure :: smallest_jacobian => tri3_smallest_jacobian
    procedure :: mean_strain_matrix => tri3_mean_strain_matrix
  end type tri3_t

  public :: new_tri3

contains

  !> Its data.
  pure function new_tri3() result(element)
    type(tri3_t) :: element
    element = tri3_t(name='TRI3', dim=2, nodes=3, vtk=5, &
        face=reshape([1, 2, 2, 3, 3, 1], [2, 3]))
  end function new_tri3

  !> Areal coordinates; xi are those of the second and the third node.
  pure subroutine tri3_shape(this, xi, n, dn)
    class(tri3_t), intent(in) :: this
    real(wp), intent(in) :: xi(:)
    real(wp), intent(out) :: n(:), dn(:, :)
    n = [one - xi(1) - xi(2), xi(1), xi(2)]
    dn(:, 1) = [-one, one, zero]
    dn(:, 2) = [-one, zero, one]
  end subroutine tri3_shape

  pure subroutine tri3_rule(this, points, xi, w)
    class(tri3_t), intent(in) :: this
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    points = 1
    xi(1:2, 1) = one/3.0_wp
    w(1) = half
  end subroutine tri3_rule

  !> Twice the area, from the first node: translations leave no trace in the digits.
  pure real(wp) function double_area(x)
    real(wp), intent(in) :: x(:, :)
    double_area = (x(1, 2) - x(1, 1))*(x(2, 3) - x(2, 1)) &
        - (x(1, 3) - x(1, 1))*(x(2, 2) - x(2, 1))
  end function double_area

  !> B' D B times the volume (Zienkiewicz & Taylor 2000, vol. 1, 4.2).
  pure subroutine tri3_stiffness(this, x, d, thickness, ke)
    class(tri3_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: d(:, :)
    real(wp), intent(in) :: thickness
    real(wp), intent(out) :: ke(:, :)
    real(wp) :: b(3, 6), k(6, 6)
    call this%mean_strain_matrix(x, b)
    k = matmul(transpose(b), matmul(d, b))
    ke(1:6, 1:6) = 0.25_wp*thickness*double_area(x)*(k + transpose(k))
  end subroutine tri3_stiffness

  !> The strain is constant.
  pure subroutine tri3_mean_strain_matrix(this, x, b)
    class(tri3_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(out) :: b(:, :)
    integer :: i, j, k
    b = zero
    do i = 1, 3
      j = 1 + mod(i, 3)
      k = 1 + mod(i + 1, 3)
      b(1, 2*i - 1) = (x(2, j) - x(2, k))/double_area(x)
      b(2, 2*i) = (x(1, k) - x(1, j))/double_area(x)
      b(3, 2*i - 1) = b(2, 2*i)
      b(3, 2*i) = b(1, 2*i - 1)
    end do
  end subroutine tri3_mean_strain_matrix

  !> Exact integral of N N'; the rule of integration points (a) is that of quadrilaterals.
  pure subroutine tri3_mass(this, x, density, thickness, a, me)
    class(tri3_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: density
    real(wp), intent(in) :: thickness
    real(wp), intent(in) :: a(:)
    real(wp), intent(out) :: me(:, :)
    integer :: i
    me = density*thickness*double_area(x)/24.0_wp
    do i = 1, 3
      me(i, i) = 2.0_wp*me(i, i)
    end do
  end subroutine tri3_mass

  !> The determinant is constant.
  pure function tri3_smallest_jacobian(this, x) result(j)
    class(tri3_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp) :: j
    j = double_area(x)
  end function tri3_smallest_jacobian

end module element_tri3
