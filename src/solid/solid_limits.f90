! SPDX-License-Identifier: BSD-3-Clause
!> What an element at finite deformation may not become: turned inside out, or pressed further
!> than its law holds.
module solid_limits
  use base_kinds, only: wp, one, two, half
  use linalg_dense, only: cross
  use material_base, only: has_value
  use material_tensor, only: spectrum, tensor_strain => green_strain
  use solid_block, only: solid_t, relative
  use solid_points, only: displacement_gradient, green_strain
  implicit none
  private
  public :: smallest_determinant, least_stretch

contains

  !> The smallest det F at the points of element k at displacements u (dim, *); not a number
  !> counts as minus one.
  pure real(wp) function smallest_determinant(solid, k, u) result(least)
    type(solid_t), intent(in) :: solid
    integer, intent(in) :: k
    real(wp), intent(in) :: u(:, :)
    real(wp) :: a(solid%dim, solid%nodes), h(solid%dim, solid%columns), det
    integer :: g, i
    call relative(solid, k, u, a)
    least = huge(one)
    do g = 1, solid%points
      call displacement_gradient(a, solid%slope(:, :, g, k), h)
      do i = 1, solid%dim
        h(i, i) = one + h(i, i)
      end do
      if (solid%dim == 2) then
        det = h(1, 1)*h(2, 2) - h(1, 2)*h(2, 1)
        if (solid%columns == 3) det = min(det, det*(one + h(1, 3)))
      else
        det = dot_product(h(:, 1), cross(h(:, 2), h(:, 3)))
      end if
      if (.not. det > -one) det = -one
      least = min(least, det)
    end do
  end function smallest_determinant

  !> The smallest principal stretch at the points of element k at displacements u (dim, *), as
  !> far as it is below `limit`: else some number that is not.
  pure real(wp) function least_stretch(solid, k, u, limit) result(least)
    type(solid_t), intent(in) :: solid
    integer, intent(in) :: k
    real(wp), intent(in) :: u(:, :), limit
    real(wp) :: a(solid%dim, solid%nodes), h(solid%dim, solid%columns), e(solid%strains)
    integer :: g
    call relative(solid, k, u, a)
    least = huge(one)
    do g = 1, solid%points
      call displacement_gradient(a, solid%slope(:, :, g, k), h)
      call green_strain(h, e)
      if (.not. all(has_value(e))) cycle
      if (size(e) == 6) then
        least = min(least, smallest_in_space(e, half*(limit**2 - one)))
      else
        least = min(least, half*(e(1) + e(2) - sqrt((e(1) - e(2))**2 + e(3)**2)))
        if (size(e) == 4) least = min(least, e(4))
      end if
    end do
    least = sqrt(max(0.0_wp, one + two*least))
  end function least_stretch

  !> Smallest principal strain; where a bound says that it is not below `limit`, that bound
  !> (the discs of Gershgorin: Golub & Van Loan 1996, 7.2.1).
  pure real(wp) function smallest_in_space(e, limit) result(smallest)
    real(wp), intent(in) :: e(6), limit
    real(wp) :: value(3), axis(3, 3)
    smallest = min(e(1) - half*(abs(e(4)) + abs(e(6))), e(2) - half*(abs(e(4)) + abs(e(5))), &
        e(3) - half*(abs(e(5)) + abs(e(6))))
    if (smallest >= limit) return
    call spectrum(tensor_strain(e), value, axis)
    smallest = minval(value)
  end function smallest_in_space

end module solid_limits
