! SPDX-License-Identifier: BSD-3-Clause
!> The bilinear quadrilateral with 2 x 2 Gauss points.
module element_quad4
  use base_kinds, only: wp, zero, one, half
  use element_base, only: element_t
  implicit none
  private

  type, extends(element_t), public :: quad4_t
  contains
    procedure :: stiffness => quad4_stiffness
    procedure :: mass => quad4_mass
    procedure :: sizes => quad4_sizes
    procedure :: smallest_jacobian => quad4_smallest_jacobian
    procedure :: mean_strain_matrix => quad4_mean_strain_matrix
  end type quad4_t

  real(wp), parameter :: gauss = one/sqrt(3.0_wp)
  real(wp), parameter :: corner_1(4) = [-one, one, one, -one]
  real(wp), parameter :: corner_2(4) = [-one, -one, one, one]

contains

  !> Shape functions at parametric point p.
  pure function shapes(p) result(n)
    real(wp), intent(in) :: p(2)
    real(wp) :: n(4)
    n = 0.25_wp*(one + corner_1*p(1))*(one + corner_2*p(2))
  end function shapes

  !> Derivatives (4, 2) of the shape functions in the plane, and the determinant of the
  !> Jacobian.
  pure subroutine gradients(x, p, dn, det_j)
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: p(2)
    real(wp), intent(out) :: dn(4, 2)
    real(wp), intent(out) :: det_j
    real(wp) :: local(4, 2), j(2, 2)
    local(:, 1) = 0.25_wp*corner_1*(one + corner_2*p(2))
    local(:, 2) = 0.25_wp*corner_2*(one + corner_1*p(1))
    ! From the first node: translations of the element then leave no trace in the digits.
    j(1, 1) = dot_product(x(1, 2:4) - x(1, 1), local(2:4, 1))
    j(2, 1) = dot_product(x(2, 2:4) - x(2, 1), local(2:4, 1))
    j(1, 2) = dot_product(x(1, 2:4) - x(1, 1), local(2:4, 2))
    j(2, 2) = dot_product(x(2, 2:4) - x(2, 1), local(2:4, 2))
    det_j = j(1, 1)*j(2, 2) - j(1, 2)*j(2, 1)
    dn(:, 1) = (local(:, 1)*j(2, 2) - local(:, 2)*j(2, 1))/det_j
    dn(:, 2) = (local(:, 2)*j(1, 1) - local(:, 1)*j(1, 2))/det_j
  end subroutine gradients

  !> Sum over 2 x 2 Gauss points of B' D B (Zienkiewicz & Taylor 2000, vol. 1, ch. 4).
  pure subroutine quad4_stiffness(this, x, d, thickness, ke)
    class(quad4_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: d(3, 3)
    real(wp), intent(in) :: thickness
    real(wp), intent(out) :: ke(:, :)
    real(wp) :: dn(4, 2), det_j, b(3, 8)
    integer :: k
    ke = zero
    do k = 1, 4
      call gradients(x, gauss*[corner_1(k), corner_2(k)], dn, det_j)
      b = strain_matrix(dn)
      ke = ke + thickness*det_j*matmul(transpose(b), matmul(d, b))
    end do
    ke = half*(ke + transpose(ke))
  end subroutine quad4_stiffness

  !> B: strains (exx, eyy, gxy) of unit displacements.
  pure function strain_matrix(dn) result(b)
    real(wp), intent(in) :: dn(4, 2)
    real(wp) :: b(3, 8)
    b = zero
    b(1, 1::2) = dn(:, 1)
    b(2, 2::2) = dn(:, 2)
    b(3, 1::2) = dn(:, 2)
    b(3, 2::2) = dn(:, 1)
  end function strain_matrix

  !> Mean of B over the four points.
  pure subroutine quad4_mean_strain_matrix(this, x, b)
    class(quad4_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(out) :: b(:, :)
    real(wp) :: dn(4, 2), det_j, mean(4, 2)
    integer :: k
    mean = zero
    do k = 1, 4
      call gradients(x, gauss*[corner_1(k), corner_2(k)], dn, det_j)
      mean = mean + 0.25_wp*dn
    end do
    b = strain_matrix(mean)
  end subroutine quad4_mean_strain_matrix

  !> Four points (+-a1, +-a2), weight one: a = 1/sqrt(3) is the consistent mass, a = 1 the
  !> lumped one, between them the modified rules of Guddati & Yue (2004).
  pure subroutine quad4_mass(this, x, density, thickness, a, me)
    class(quad4_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: density
    real(wp), intent(in) :: thickness
    real(wp), intent(in) :: a(2)
    real(wp), intent(out) :: me(:, :)
    real(wp) :: dn(4, 2), det_j, n(4), p(2)
    integer :: k, i
    me = zero
    do k = 1, 4
      p = a*[corner_1(k), corner_2(k)]
      call gradients(x, p, dn, det_j)
      n = shapes(p)
      do i = 1, 4
        me(:, i) = me(:, i) + density*thickness*det_j*n(i)*n
      end do
    end do
  end subroutine quad4_mass

  !> Distance between the midpoints of opposite edges.
  pure function quad4_sizes(this, x) result(h)
    class(quad4_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp) :: h(2), across(2)
    across = half*((x(:, 2) - x(:, 1)) + (x(:, 3) - x(:, 4)))
    h(1) = sqrt(sum(across**2))
    across = half*((x(:, 4) - x(:, 1)) + (x(:, 3) - x(:, 2)))
    h(2) = sqrt(sum(across**2))
  end function quad4_sizes

  !> The determinant is bilinear, so its smallest value is at a corner.
  pure function quad4_smallest_jacobian(this, x) result(j)
    class(quad4_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp) :: j, next(2), previous(2)
    integer :: k
    j = huge(j)
    do k = 1, 4
      next = x(:, 1 + mod(k, 4)) - x(:, k)
      previous = x(:, 1 + mod(k + 2, 4)) - x(:, k)
      j = min(j, 0.25_wp*(next(1)*previous(2) - next(2)*previous(1)))
    end do
  end function quad4_smallest_jacobian

end module element_quad4
