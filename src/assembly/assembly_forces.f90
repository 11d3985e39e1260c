! SPDX-License-Identifier: BSD-3-Clause
!> Internal forces and strain energy from element strains, and the loads.
!> K U and U.K U would lose digits to the rigid motion of the bodies (1e-9 of the energy per
!> step for a stiff bar in flight); relative displacements of an element do not.
module assembly_forces
  use base_kinds, only: wp, zero, one, half
  use element_base, only: most_nodes
  use assembly_blocks, only: element_block_t, stored_at
  use assembly_four, only: subtract_four
  use assembly_ring, only: subtract_ring_forces, ring_product
  use assembly_solid, only: subtract_solid_force, add_solid_energy
  use assembly_system, only: system_t
  use assembly_threads, only: is_worth_threads, subtract_stiffness_forces
  use model_data, only: model_t, curve_value
  use solid_block, only: force_rule_t, element_energy
  implicit none
  private
  public :: subtract_internal_force, subtract_layer_force, subtract_element_forces, &
      subtract_weighted_forces, layer_product, strain_energies, block_products, &
      strain_product, element_product, element_products, add_loads

contains

  !> (Recursive: the first of several ranks comes back here with its own elements.)
  !> f = f - factor * K u, element by element; u, f (dim, n). At finite deformation the force at
  !> the displacements u takes the place of K u.
  recursive subroutine subtract_internal_force(system, factor, u, f)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(inout) :: f(:, :)
    integer :: b
    if (associated(system%team)) then
      call system%team%subtract_forces(factor, u, f)
      return
    end if
    if (allocated(system%solid)) then
      call subtract_solid_force(system%solid, system%threads, &
          force_rule_t(before=one, now=zero), factor, u, u, f)
      return
    end if
    do b = 1, size(system%block)
      if (system%block(b)%is_rigid) cycle
      call subtract_block(system, system%block(b), 1, size(system%block(b)%node, 2), factor, &
          u, f)
    end do
  end subroutine subtract_internal_force

  !> f = f - factor * C u; u, f (dim, n).
  subroutine subtract_layer_force(system, factor, u, f)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(inout) :: f(:, :)
    call subtract_element_forces(system, system%massless_layer, factor, u, f)
  end subroutine subtract_layer_force

  !> f = f - factor * K u of some elements, in their order; u, f (dim, n).
  subroutine subtract_element_forces(system, elements, factor, u, f)
    type(system_t), intent(in) :: system
    integer, intent(in) :: elements(:)
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(inout) :: f(:, :)
    call subtract_weighted_forces(system, elements, [factor], u, f)
  end subroutine subtract_element_forces

  !> f = f - weight(k) * K u of element elements(k), one after the other; weight (1) if it is
  !> the same of all; u, f (dim, n).
  recursive subroutine subtract_weighted_forces(system, elements, weight, u, f)
    type(system_t), intent(in) :: system
    integer, intent(in) :: elements(:)
    real(wp), intent(in) :: weight(:)
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(inout) :: f(:, :)
    integer :: k
    if (size(elements) == 0) return
    if (associated(system%team)) then
      call system%team%subtract_chosen(system%block, system%block_of, elements, weight, u, f)
      return
    end if
    do k = 1, size(elements)
      associate (block => system%block(system%block_of(elements(k))))
        if (block%is_rigid) cycle
        call subtract_block(system, block, elements(k) - block%first + 1, &
            elements(k) - block%first + 1, weight(min(k, size(weight))), u, f)
      end associate
    end do
  end subroutine subtract_weighted_forces

  !> The same of elements from..to of a block, by the kernel of its type, to which a class that
  !> is not allocated is not present.
  subroutine subtract_block(system, block, from, to, factor, u, f)
    type(system_t), intent(in) :: system
    type(element_block_t), intent(in) :: block
    integer, intent(in) :: from, to
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(inout) :: f(:, :)
    if (system%threads > 1 .and. .not. block%is_ring) then
      if (is_worth_threads(system%threads, to - from + 1, system%dim*(block%nodes - 1), &
          1)) then
        call subtract_stiffness_forces(system%threads, system%dim, block, from, to, factor, u, &
            f)
        return
      end if
    end if
    if (block%is_ring) then
      call subtract_ring_forces(from, to, block%node, block%stiffness, factor, u, f, &
          block%class)
    else if (system%dim == 2 .and. block%nodes == 4) then
      call four_nodes(from, to, system%n, block%node, block%stiffness, factor, u, f, &
          block%class)
    else
      call any_nodes(from, to, system%n, system%dim, block%nodes, block%node, &
          block%stiffness, factor, u, f, block%class)
    end if
  end subroutine subtract_block

  !> Four nodes in the plane.
  pure subroutine four_nodes(from, to, n, node, k, factor, u, f, class)
    integer, intent(in) :: from, to, n
    integer, intent(in) :: node(4, *)
    real(wp), intent(in) :: k(6, 6, *)
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: u(2, n)
    real(wp), intent(inout) :: f(2, n)
    integer, intent(in), optional :: class(*)
    integer :: e, j
    do e = from, to
      j = e
      if (present(class)) j = class(e)
      call subtract_four(n, node(1, e), k(1, 1, j), factor, u, f)
    end do
  end subroutine four_nodes

  !> Any element.
  pure subroutine any_nodes(from, to, n, dim, nodes, node, k, factor, u, f, class)
    integer, intent(in) :: from, to, n, dim, nodes
    integer, intent(in) :: node(nodes, *)
    real(wp), intent(in) :: k(dim*(nodes - 1), dim*(nodes - 1), *)
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: u(dim, n)
    real(wp), intent(inout) :: f(dim, n)
    integer, intent(in), optional :: class(*)
    real(wp), dimension(3*most_nodes) :: d, g     ! of a size that needs no memory anew
    real(wp) :: total
    integer :: e, i, j, c, m
    m = dim*(nodes - 1)
    do e = from, to
      j = e
      if (present(class)) j = class(e)
      do i = 2, nodes
        do c = 1, dim
          d(dim*(i - 2) + c) = factor*(u(c, node(i, e)) - u(c, node(1, e)))
        end do
      end do
      call multiply(m, k(1, 1, j), d, g)
      do c = 1, dim
        total = zero
        do i = 2, nodes
          total = total + g(dim*(i - 2) + c)
          f(c, node(i, e)) = f(c, node(i, e)) - g(dim*(i - 2) + c)
        end do
        f(c, node(1, e)) = f(c, node(1, e)) + total
      end do
    end do
  end subroutine any_nodes

  !> g = K d.
  pure subroutine multiply(m, k, d, g)
    integer, intent(in) :: m
    real(wp), intent(in) :: k(m, m), d(m)
    real(wp), intent(out) :: g(m)
    integer :: j
    g = k(:, 1)*d(1)
    do j = 2, m
      g = g + k(:, j)*d(j)
    end do
  end subroutine multiply

  !> Strain energy of each part [F L]; part(e) is the row of element e.
  subroutine strain_energies(system, part, u, energy)
    type(system_t), intent(in) :: system
    integer, intent(in) :: part(:)
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: energy(:)
    integer :: b
    energy = zero
    if (associated(system%team)) then
      call add_shared_energies(system, part, u, energy)
      return
    end if
    do b = 1, size(system%block)
      associate (own => energy(part(system%block(b)%first)))
        if (allocated(system%solid)) then
          call add_solid_energy(system%solid(b), u, own)
          cycle
        end if
        call add_products(system, system%block(b), half, u, own)
      end associate
    end do
  end subroutine strain_energies

  subroutine add_shared_energies(system, part, u, energy)
    type(system_t), intent(in) :: system
    integer, intent(in) :: part(:)
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(inout) :: energy(:)
    real(wp) :: total(size(system%block))
    integer :: b
    call system%team%block_products(u, total)
    do b = 1, size(total)
      associate (own => energy(part(system%block(b)%first)))
        own = own + half*total(b)
      end associate
    end do
  end subroutine add_shared_energies

  !> u.K u over all elements [F L]; 0 at finite deformation, which has no K.
  real(wp) function strain_product(system, u)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: u(:, :)
    real(wp) :: total(1)
    integer :: b
    strain_product = zero
    if (allocated(system%solid)) return
    if (associated(system%team)) then
      total = zero
      call add_shared_energies(system, [(1, b=1, size(system%block_of))], u, total)
      strain_product = 2.0_wp*total(1)
      return
    end if
    do b = 1, size(system%block)
      call add_products(system, system%block(b), one, u, strain_product)
    end do
  end function strain_product

  !> u.K u of each block [F L].
  subroutine block_products(system, u, total)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: total(:)
    integer :: b
    total = zero
    do b = 1, size(system%block)
      call add_products(system, system%block(b), one, u, total(b))
    end do
  end subroutine block_products

  !> total = total + factor * u.K u of each element of a block [F L].
  pure subroutine add_products(system, block, factor, u, total)
    type(system_t), intent(in) :: system
    type(element_block_t), intent(in) :: block
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(inout) :: total
    integer :: e, i
    if (block%is_rigid) return
    do e = 1, size(block%node, 2)
      i = e
      if (allocated(block%class)) i = block%class(e)
      if (block%is_ring) then
        total = total + factor*ring_product(block%node(:, e), block%stiffness(:, :, i), u)
      else if (system%dim == 2 .and. block%nodes == 4) then
        total = total + factor*product_of_four(system%n, block%node(1, e), &
            block%stiffness(1, 1, i), u)
      else
        total = total + factor*product_of_any(block%node(:, e), block%stiffness(:, :, i), u)
      end if
    end do
  end subroutine add_products

  !> u.C u [F L].
  real(wp) function layer_product(system, u)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: u(:, :)
    integer :: k
    layer_product = zero
    if (associated(system%team)) then
      layer_product = shared_layer_product(system, u)
      return
    end if
    do k = 1, size(system%massless_layer)
      layer_product = layer_product + element_product(system, system%massless_layer(k), u)
    end do
  end function layer_product

  real(wp) function shared_layer_product(system, u)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: u(:, :)
    real(wp) :: value(size(system%massless_layer))
    call element_products(system, system%massless_layer, u, value)
    shared_layer_product = sum(value)
  end function shared_layer_product

  !> u.K u of some elements, as ELEMENT_PRODUCT has it [F L].
  subroutine element_products(system, elements, u, value)
    type(system_t), intent(in) :: system
    integer, intent(in) :: elements(:)
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: value(:)
    integer :: k
    if (associated(system%team)) then
      call system%team%chosen_products(system%block, system%block_of, elements, u, value)
      return
    end if
    do k = 1, size(elements)
      value(k) = element_product(system, elements(k), u)
    end do
  end subroutine element_products

  !> u.K u of element e, at finite deformation twice its strain energy [F L].
  recursive real(wp) function element_product(system, e, u)
    type(system_t), intent(in) :: system
    integer, intent(in) :: e
    real(wp), intent(in) :: u(:, :)
    real(wp) :: value(1)
    if (associated(system%team)) then
      call system%team%chosen_products(system%block, system%block_of, [e], u, value)
      element_product = value(1)
      return
    end if
    if (allocated(system%solid)) then
      associate (solid => system%solid(system%block_of(e)))
        element_product = zero
        if (solid%n > 0) element_product = &
            2.0_wp*element_energy(solid, e - solid%first + 1, u)
      end associate
      return
    end if
    associate (block => system%block(system%block_of(e)))
      element_product = zero
      if (block%is_rigid) return
      associate (node => block%node(:, e - block%first + 1), &
          k => block%stiffness(:, :, stored_at(block, e - block%first + 1)))
        if (block%is_ring) then
          element_product = ring_product(node, k, u)
        else if (system%dim == 2 .and. block%nodes == 4) then
          element_product = product_of_four(system%n, node(1), k(1, 1), u)
        else
          element_product = product_of_any(node, k, u)
        end if
      end associate
    end associate
  end function element_product

  !> Four nodes in the plane.
  pure real(wp) function product_of_four(n, node, k, u) result(total)
    integer, intent(in) :: n, node(4)
    real(wp), intent(in) :: k(6, 6), u(2, n)
    real(wp) :: d(6)
    integer :: i
    do i = 2, 4
      d(2*i - 3:2*i - 2) = u(:, node(i)) - u(:, node(1))
    end do
    total = zero
    do i = 1, 6
      total = total + d(i)*(k(1, i)*d(1) + k(2, i)*d(2) + k(3, i)*d(3) + k(4, i)*d(4) &
          + k(5, i)*d(5) + k(6, i)*d(6))
    end do
  end function product_of_four

  !> Any element.
  pure real(wp) function product_of_any(node, k, u) result(total)
    integer, intent(in) :: node(:)
    real(wp), intent(in) :: k(:, :), u(:, :)
    real(wp) :: d(3*most_nodes), row
    integer :: i, j, m
    m = size(u, 1)
    do i = 2, size(node)
      d(m*(i - 2) + 1:m*(i - 1)) = u(:, node(i)) - u(:, node(1))
    end do
    total = zero
    do i = 1, size(k, 1)
      row = k(1, i)*d(1)
      do j = 2, size(k, 1)
        row = row + k(j, i)*d(j)
      end do
      total = total + d(i)*row
    end do
  end function product_of_any

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
