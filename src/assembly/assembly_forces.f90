! SPDX-License-Identifier: BSD-3-Clause
!> Internal forces and strain energy from element strains, and the loads.
!> K U and U.K U would lose digits to the rigid motion of the bodies (1e-9 of the energy per
!> step for a stiff bar in flight); relative displacements of an element do not.
module assembly_forces
  use base_kinds, only: wp, zero, half
  use assembly_system, only: system_t
  use model_data, only: model_t, curve_value
  implicit none
  private
  public :: subtract_internal_force, subtract_layer_force, subtract_element_forces, &
      layer_product, strain_energies, &
      strain_product, element_product, add_loads, largest_rotation, first_inverted

contains

  !> f = f - factor * K u, element by element; u, f (2, n).
  subroutine subtract_internal_force(system, factor, u, f)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(inout) :: f(:, :)
    call internal_kernel(size(system%node, 2), system%n, system%node, system%stiffness, &
        factor, u, f)
  end subroutine subtract_internal_force

  !> f = f - factor * C u; u, f (2, n).
  subroutine subtract_layer_force(system, factor, u, f)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(inout) :: f(:, :)
    call subtract_element_forces(system, system%massless_layer, factor, u, f)
  end subroutine subtract_layer_force

  !> f = f - factor * K u of some elements, in their order; u, f (2, n).
  subroutine subtract_element_forces(system, elements, factor, u, f)
    type(system_t), intent(in) :: system
    integer, intent(in) :: elements(:)
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(inout) :: f(:, :)
    integer :: k
    do k = 1, size(elements)
      associate (e => elements(k))
        call internal_kernel(1, system%n, system%node(:, e), system%stiffness(:, :, e), &
            factor, u, f)
      end associate
    end do
  end subroutine subtract_element_forces

  pure subroutine internal_kernel(elements, n, node, k, factor, u, f)
    integer, intent(in) :: elements, n
    integer, intent(in) :: node(4, elements)
    real(wp), intent(in) :: k(6, 6, elements)
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: u(2, n)
    real(wp), intent(inout) :: f(2, n)
    real(wp) :: d(6), g(6)
    integer :: e, i, i1, i2, i3, i4
    do e = 1, elements
      i1 = node(1, e)
      i2 = node(2, e)
      i3 = node(3, e)
      i4 = node(4, e)
      d(1) = factor*(u(1, i2) - u(1, i1))
      d(2) = factor*(u(2, i2) - u(2, i1))
      d(3) = factor*(u(1, i3) - u(1, i1))
      d(4) = factor*(u(2, i3) - u(2, i1))
      d(5) = factor*(u(1, i4) - u(1, i1))
      d(6) = factor*(u(2, i4) - u(2, i1))
      do i = 1, 6
        g(i) = k(i, 1, e)*d(1) + k(i, 2, e)*d(2) + k(i, 3, e)*d(3) + k(i, 4, e)*d(4) &
            + k(i, 5, e)*d(5) + k(i, 6, e)*d(6)
      end do
      f(1, i1) = f(1, i1) + (g(1) + g(3) + g(5))
      f(2, i1) = f(2, i1) + (g(2) + g(4) + g(6))
      f(1, i2) = f(1, i2) - g(1)
      f(2, i2) = f(2, i2) - g(2)
      f(1, i3) = f(1, i3) - g(3)
      f(2, i3) = f(2, i3) - g(4)
      f(1, i4) = f(1, i4) - g(5)
      f(2, i4) = f(2, i4) - g(6)
    end do
  end subroutine internal_kernel

  !> Strain energy of each part [F L]; part(e) is the row of element e.
  pure subroutine strain_energies(system, part, u, energy)
    type(system_t), intent(in) :: system
    integer, intent(in) :: part(:)
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: energy(:)
    integer :: e
    energy = zero
    do e = 1, size(system%node, 2)
      energy(part(e)) = energy(part(e)) + half*element_product(system, e, u)
    end do
  end subroutine strain_energies

  !> u.K u over all elements [F L].
  pure real(wp) function strain_product(system, u)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: u(:, :)
    integer :: e
    strain_product = zero
    do e = 1, size(system%node, 2)
      strain_product = strain_product + element_product(system, e, u)
    end do
  end function strain_product

  !> u.C u [F L].
  pure real(wp) function layer_product(system, u)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: u(:, :)
    integer :: k
    layer_product = zero
    do k = 1, size(system%massless_layer)
      layer_product = layer_product + element_product(system, system%massless_layer(k), u)
    end do
  end function layer_product

  !> u.K u of element e [F L].
  pure real(wp) function element_product(system, e, u)
    type(system_t), intent(in) :: system
    integer, intent(in) :: e
    real(wp), intent(in) :: u(:, :)
    real(wp) :: d(6)
    integer :: i
    do i = 2, 4
      d(2*i - 3:2*i - 2) = u(:, system%node(i, e)) - u(:, system%node(1, e))
    end do
    element_product = zero
    do i = 1, 6
      element_product = element_product &
          + d(i)*(system%stiffness(1, i, e)*d(1) + system%stiffness(2, i, e)*d(2) &
          + system%stiffness(3, i, e)*d(3) + system%stiffness(4, i, e)*d(4) &
          + system%stiffness(5, i, e)*d(5) + system%stiffness(6, i, e)*d(6))
    end do
  end function element_product

  !> Largest rotation of an element [radians], by its diagonals, and the element.
  pure subroutine largest_rotation(system, x, u, angle, element)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: x(:, :), u(:, :)
    real(wp), intent(out) :: angle
    integer, intent(out) :: element
    real(wp) :: d(2), e(2), sine, cosine, size_d, size_e
    integer :: k
    angle = zero
    element = 0
    do k = 1, size(system%node, 2)
      d = x(:, system%node(3, k)) - x(:, system%node(1, k))
      e = d + (u(:, system%node(3, k)) - u(:, system%node(1, k)))
      ! Unit sizes first: the products of an unbounded motion would overflow.
      size_d = maxval(abs(d))
      size_e = maxval(abs(e))
      if (.not. size_e > zero) cycle
      d = d/size_d
      e = e/size_e
      sine = d(1)*e(2) - d(2)*e(1)
      cosine = d(1)*e(1) + d(2)*e(2)
      if (abs(sine) <= angle*cosine) cycle
      if (allocated(system%idle)) then    ! rigid parts turn as they will
        if (.not. any(abs(system%stiffness(:, :, k)) > zero)) cycle
      end if
      angle = abs(sine)/max(cosine, tiny(cosine))
      element = k
    end do
    angle = atan(angle)
  end subroutine largest_rotation

  !> The first element whose area at X + U is not positive; 0 = none.
  pure integer function first_inverted(system, x, u)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: x(:, :), u(:, :)
    real(wp) :: d(2), e(2)
    do first_inverted = 1, size(system%node, 2)
      associate (c => system%node(:, first_inverted))
        d = (x(:, c(3)) - x(:, c(1))) + (u(:, c(3)) - u(:, c(1)))
        e = (x(:, c(4)) - x(:, c(2))) + (u(:, c(4)) - u(:, c(2)))
      end associate
      if (.not. d(1)*e(2) - d(2)*e(1) > zero) return
    end do
    first_inverted = 0
  end function first_inverted

  !> p = p + factor * loads at a time: nodal forces by their curves, body loads as
  !> - M (acceleration of the base).
  pure subroutine add_loads(model, system, time, factor, p)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: time, factor
    real(wp), intent(inout) :: p(:, :)
    real(wp) :: value
    integer :: k, m
    do k = 1, size(model%load)
      associate (load => model%load(k))
        if (time < load%arrival) cycle
        value = factor*load%factor*curve_value(model%curve(load%curve), time - load%arrival)
        do m = 1, size(load%node)
          p(:, load%node(m)) = p(:, load%node(m)) + value*load%force(:, m)
        end do
      end associate
    end do
    do k = 1, size(model%gravity)
      associate (g => model%gravity(k))
        value = factor*g%factor*curve_value(model%curve(g%curve), time)
        p(g%direction, :system%heavy) = p(g%direction, :system%heavy) &
            - value*system%lumped(:system%heavy)
      end associate
    end do
  end subroutine add_loads

end module assembly_forces
