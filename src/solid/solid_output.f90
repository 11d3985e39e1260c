! SPDX-License-Identifier: BSD-3-Clause
!> What tables and fields show of an element at finite deformation.
module solid_output
  use base_kinds, only: wp, zero, one, two
  use material_plane, only: respond_as
  use material_tensor, only: component, first_index, second_index, spectrum, &
      tensor_strain => green_strain
  use solid_block, only: solid_t, relative
  use solid_mean, only: mean_response
  use solid_points, only: displacement_gradient, green_strain
  implicit none
  private
  public :: element_cauchy, element_stretches, element_plastic_strain

contains

  !> Mean Cauchy stress (xx, yy, zz, xy, yz, zx) [F/L2] of element k at displacements u (dim, *)
  !> [L], over the volume that it has there: sum w F S F' / sum w J.
  pure subroutine element_cauchy(solid, k, u, stress)
    type(solid_t), intent(in) :: solid
    integer, intent(in) :: k
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: stress(6)
    real(wp), dimension(6, solid%points) :: e, s
    real(wp) :: a(solid%dim, solid%nodes), f(3, 3, solid%points), volume
    integer :: g
    stress = zero
    if (solid%n == 0) return    ! of a rigid part
    call relative(solid, k, u, a)
    call stresses_in_space(solid, k, a, f, e, s)
    volume = zero
    do g = 1, solid%points
      if (solid%dim == 2) f(3, 3, g) = sqrt(one + two*e(3, g))
      stress = stress + solid%weight(g, k)*pushed(f(:, :, g), s(:, g))
      volume = volume + solid%weight(g, k)*determinant(f(:, :, g))
    end do
    stress = stress/volume
  end subroutine element_cauchy

  !> Principal stretches of element k, the largest first: of the mean of its strains; 1 of a
  !> rigid part.
  pure subroutine element_stretches(solid, k, u, stretch)
    type(solid_t), intent(in) :: solid
    integer, intent(in) :: k
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: stretch(3)
    real(wp), dimension(6, solid%points) :: e, s
    real(wp) :: a(solid%dim, solid%nodes), f(3, 3, solid%points), strain(3), axis(3, 3)
    real(wp) :: mean(6)
    integer :: g
    stretch = one
    if (solid%n == 0) return
    call relative(solid, k, u, a)
    call stresses_in_space(solid, k, a, f, e, s)
    mean = zero
    do g = 1, solid%points
      mean = mean + solid%weight(g, k)*e(:, g)
    end do
    call spectrum(tensor_strain(mean/sum(solid%weight(:, k))), strain, axis)
    stretch = sqrt(one + two*strain)
    stretch = [maxval(stretch), sum(stretch) - maxval(stretch) - minval(stretch), &
        minval(stretch)]
  end subroutine element_stretches

  !> Equivalent plastic strain of element k, mean over its points; 0 where nothing flows.
  pure real(wp) function element_plastic_strain(solid, k) result(strain)
    type(solid_t), intent(in) :: solid
    integer, intent(in) :: k
    strain = zero
    if (solid%n == 0) return
    if (solid%material%strain_state == 0) return
    strain = dot_product(solid%weight(:, k), &
        solid%history(solid%material%strain_state, :, k))/sum(solid%weight(:, k))
  end function element_plastic_strain

  !> F in its rows and columns of the plane or space, the six strains and second Piola-Kirchhoff
  !> stresses of the points.
  pure subroutine stresses_in_space(solid, k, a, f, e, s)
    type(solid_t), intent(in) :: solid
    integer, intent(in) :: k
    real(wp), intent(in) :: a(:, :)
    real(wp), intent(out) :: f(:, :, :), e(:, :), s(:, :)
    real(wp) :: h(solid%dim, solid%columns), own(solid%strains, solid%points), energy
    real(wp) :: own_s(solid%strains, solid%points)
    real(wp) :: d(solid%strains, solid%strains, solid%points)
    real(wp) :: new(solid%material%states, solid%points)
    integer :: g, i
    f = zero
    e = zero
    do g = 1, solid%points
      call displacement_gradient(a, solid%slope(:, :, g, k), h)
      call green_strain(h, own(:, g))
      f(:solid%dim, :solid%dim, g) = h(:, :solid%dim)
      do i = 1, 3
        f(i, i, g) = f(i, i, g) + one
      end do
      e(solid%place, g) = own(:, g)
      if (.not. solid%is_mean) call respond_as(solid%material, solid%plane, own(:, g), &
          solid%history(:, g, k), .false., own_s(:, g), d(:, :, g), energy, new(:, g), &
          e(:, g), s(:, g))
    end do
    if (solid%is_mean) call mean_response(solid%material, solid%place, solid%weight(:, k), &
        own, solid%history(:, :, k), .false., own_s, d, energy, new, whole_s=s)
  end subroutine stresses_in_space

  !> F S F' (6).
  pure function pushed(f, s) result(stress)
    real(wp), intent(in) :: f(3, 3), s(6)
    real(wp) :: stress(6), whole(3, 3)
    integer :: c
    whole = matmul(f, matmul(reshape(s(reshape(component, [9])), [3, 3]), transpose(f)))
    stress = [(whole(first_index(c), second_index(c)), c=1, 6)]
  end function pushed

  pure real(wp) function determinant(f)
    real(wp), intent(in) :: f(3, 3)
    determinant = f(1, 1)*(f(2, 2)*f(3, 3) - f(2, 3)*f(3, 2)) &
        - f(1, 2)*(f(2, 1)*f(3, 3) - f(2, 3)*f(3, 1)) &
        + f(1, 3)*(f(2, 1)*f(3, 2) - f(2, 2)*f(3, 1))
  end function determinant

end module solid_output
