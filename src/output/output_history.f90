! SPDX-License-Identifier: BSD-3-Clause
!> Mean stress of the history elements: what turns displacements of their nodes into it, found
!> once, so that a row of a table asks for no memory.
module output_history
  use base_kinds, only: wp, zero
  use material_base, only: strains_in
  use model_data, only: model_t
  implicit none
  private

  type, public :: history_t
    integer, allocatable :: first(:), node(:)      !< nodes of each element, as rows
    real(wp), allocatable :: b(:, :)               !< (strains, dim nodes) mean B [1/L]
    real(wp), allocatable :: moduli(:, :, :)       !< (strains, strains, elements) [F/L2]
    logical :: is_ring = .false.                   !< all are turned about the y axis
  end type history_t

  public :: make_history, history_stress

contains

  !> For the elements that the deck asks for.
  subroutine make_history(model, history)
    type(model_t), intent(in) :: model
    type(history_t), intent(out) :: history
    integer :: e, k, m, at
    associate (list => model%requests%history_element, mesh => model%mesh)
      allocate (history%first(size(list) + 1))
      history%first(1) = 1
      do k = 1, size(list)
        history%first(k + 1) = history%first(k) + mesh%count_of(list(k))
      end do
      history%is_ring = model%is_axisymmetric
      m = strains_in(model%part(1)%plane)
      allocate (history%node(history%first(size(list) + 1) - 1))
      allocate (history%b(m, model%dim*size(history%node)), history%moduli(m, m, size(list)))
      do k = 1, size(list)
        e = list(k)
        at = model%dim*(history%first(k) - 1)
        history%node(history%first(k):history%first(k + 1) - 1) = mesh%nodes_of(e)
        call mesh%kind(mesh%type(e))%item%mean_strain_matrix(model%x(:, mesh%nodes_of(e)), &
            history%b(:, at + 1:at + model%dim*mesh%count_of(e)))
        associate (part => model%part(mesh%part(e)))
          history%moduli(:, :, k) = model%material(part%material)%item%moduli(part%plane)
        end associate
      end do
    end associate
  end subroutine make_history

  !> stress (strains) [F/L2] of the k-th element at displacements u (dim, nodes) [L]; a
  !> translation of the element is taken off first, of a ring one along its axis.
  pure subroutine history_stress(history, k, u, stress)
    type(history_t), intent(in) :: history
    integer, intent(in) :: k
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: stress(:)
    real(wp) :: strain(6), of_node(6)
    integer :: c, i, m, n
    m = size(u, 1)
    n = size(stress)
    strain = zero
    if (history%is_ring) call add_radial(history, k, u, strain(:n))
    do i = history%first(k) + 1, history%first(k + 1) - 1
      of_node = zero
      do c = merge(2, 1, history%is_ring), m
        of_node(:n) = of_node(:n) + history%b(:, m*(i - 1) + c) &
            *(u(c, history%node(i)) - u(c, history%node(history%first(k))))
      end do
      strain = strain + of_node
    end do
    stress = zero
    do c = 1, n
      stress = stress + history%moduli(:, c, k)*strain(c)
    end do
  end subroutine history_stress

  !> Strain that the radial displacements of a ring make.
  pure subroutine add_radial(history, k, u, strain)
    type(history_t), intent(in) :: history
    integer, intent(in) :: k
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(inout) :: strain(:)
    integer :: i
    do i = history%first(k), history%first(k + 1) - 1
      strain = strain + history%b(:, 2*i - 1)*u(1, history%node(i))
    end do
  end subroutine add_radial

end module output_history
