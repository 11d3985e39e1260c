! SPDX-License-Identifier: BSD-3-Clause
!> Stiffness of elements turned about the y axis. A translation along the axis strains nothing
!> and drops out before anything is multiplied, as any translation does in the plane; one along
!> the radius does strain. The unknowns of an element are the displacements of its nodes without
!> u_y of node 1, relative to which the other u_y are.
module assembly_ring
  use base_kinds, only: wp, zero
  use element_base, only: most_nodes
  implicit none
  private
  integer, parameter :: most = 2*most_nodes

  public :: ring_unknowns, subtract_ring_forces, ring_product, whole_ring_stiffness

contains

  !> Which dofs of an element they are: all but the second.
  pure function ring_unknowns(nodes) result(dof)
    integer, intent(in) :: nodes
    integer :: dof(2*nodes - 1), k
    dof = [1, (k, k=3, 2*nodes)]
  end function ring_unknowns

  !> Their values times a factor.
  pure subroutine gather(node, factor, u, d)
    integer, intent(in) :: node(:)
    real(wp), intent(in) :: factor, u(:, :)
    real(wp), intent(out) :: d(:)
    integer :: k
    d(1) = factor*u(1, node(1))
    do k = 2, size(node)
      d(2*k - 2) = factor*u(1, node(k))
      d(2*k - 1) = factor*(u(2, node(k)) - u(2, node(1)))
    end do
  end subroutine gather

  !> f = f - factor * K u of elements from..to of those with the nodes node (nodes, elements);
  !> k: stiffness of the unknowns of each, or of each class; u, f (2, n).
  pure subroutine subtract_ring_forces(from, to, node, k, factor, u, f, class)
    integer, intent(in) :: from, to, node(:, :)
    real(wp), intent(in) :: k(:, :, :)
    real(wp), intent(in) :: factor, u(:, :)
    real(wp), intent(inout) :: f(:, :)
    integer, intent(in), optional :: class(:)
    real(wp) :: d(most), g(most), total
    integer :: e, i, j, m, n
    n = size(node, 1)
    m = 2*n - 1
    do e = from, to
      j = e
      if (present(class)) j = class(e)
      call gather(node(:, e), factor, u, d(:m))
      g(:m) = zero
      do i = 1, m
        g(:m) = g(:m) + k(:, i, j)*d(i)
      end do
      total = zero
      f(1, node(1, e)) = f(1, node(1, e)) - g(1)
      do i = 2, n
        f(1, node(i, e)) = f(1, node(i, e)) - g(2*i - 2)
        f(2, node(i, e)) = f(2, node(i, e)) - g(2*i - 1)
        total = total + g(2*i - 1)
      end do
      f(2, node(1, e)) = f(2, node(1, e)) + total
    end do
  end subroutine subtract_ring_forces

  !> u.K u of one element [F L].
  pure real(wp) function ring_product(node, k, u) result(total)
    integer, intent(in) :: node(:)
    real(wp), intent(in) :: k(:, :), u(:, :)
    real(wp) :: d(most)
    integer :: i, m
    m = size(k, 1)
    call gather(node, 1.0_wp, u, d(:m))
    total = zero
    do i = 1, m
      total = total + d(i)*dot_product(k(:, i), d(:m))
    end do
  end function ring_product

  !> factor * K of all dofs of an element, from that of the unknowns: the row and the column of
  !> u_y of node 1 are minus the sums of those of the other u_y.
  pure subroutine whole_ring_stiffness(factor, k, ke)
    real(wp), intent(in) :: factor, k(:, :)
    real(wp), intent(out) :: ke(:, :)
    integer :: m
    m = size(ke, 1)
    ke(1, 1) = factor*k(1, 1)
    ke(3:, 1) = factor*k(2:, 1)
    ke(1, 3:) = factor*k(1, 2:)
    ke(3:, 3:) = factor*k(2:, 2:)
    ke(2, 1) = -sum(ke(4:m:2, 1))
    ke(2, 3:) = -sum(ke(4:m:2, 3:), dim=1)
    ke(1, 2) = ke(2, 1)
    ke(3:, 2) = ke(2, 3:)
    ke(2, 2) = -sum(ke(2, 4:m:2))
  end subroutine whole_ring_stiffness

end module assembly_ring
