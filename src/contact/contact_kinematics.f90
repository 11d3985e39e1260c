! SPDX-License-Identifier: BSD-3-Clause
!> What rows make of motions and of forces: u_a = [n t1 t2]' sum_k c_k x_k, and its transpose.
!> The plane and space have kernels of their own, chosen once a row. Local vectors have three
!> components; in the plane the last is zero.
module contact_kinematics
  use base_kinds, only: wp, zero
  use cone_types, only: most_components
  use contact_rows, only: rows_t, row_guided
  implicit none
  private
  public :: relative_displacement, row_force, add_row_force, row_of_h, tangential_length, &
      tangential_product

contains

  !> (n, t1, t2) components of sum_k c_k x_k of row a [L for displacements]: relative to the
  !> second point, the first of the obstacle, so that a small difference keeps its digits.
  !> column: rows%point for x of all nodes, rows%slot for x of the interface.
  pure function relative_displacement(rows, a, column, x) result(u)
    type(rows_t), intent(in) :: rows
    integer, intent(in) :: a, column(:)
    real(wp), intent(in), contiguous :: x(:, :)
    real(wp) :: u(most_components), d(2)
    integer :: k, reference
    if (rows%dim == 3) then
      u = relative_in_space(rows, a, column, x)
      return
    end if
    d = x(:, column(rows%first(a)))
    if (rows%first(a + 1) > rows%first(a) + 1) then
      reference = column(rows%first(a) + 1)
      d = d - x(:, reference)
      do k = rows%first(a) + 2, rows%first(a + 1) - 1
        d = d + rows%weight(k)*(x(:, column(k)) - x(:, reference))
      end do
    end if
    u(1) = rows%normal(1, a)*d(1) + rows%normal(2, a)*d(2)
    u(2) = rows%normal(1, a)*d(2) - rows%normal(2, a)*d(1)
    u(3) = zero
  end function relative_displacement

  !> The same in space, where the first point may be one of two of the contactor (an edge
  !> across another).
  pure function relative_in_space(rows, a, column, x) result(u)
    type(rows_t), intent(in) :: rows
    integer, intent(in) :: a, column(:)
    real(wp), intent(in), contiguous :: x(:, :)
    real(wp) :: u(3), d(3), reference(3)
    integer :: k, first
    first = rows%first(a)
    reference = zero
    if (rows%first(a + 1) > first + 1) reference = x(:, column(first + 1))
    d = rows%weight(first)*(x(:, column(first)) - reference)
    do k = first + 2, rows%first(a + 1) - 1
      d = d + rows%weight(k)*(x(:, column(k)) - reference)
    end do
    u(1) = dot_product(rows%normal(:, a), d)
    u(2) = dot_product(rows%tangent(:, 1, a), d)
    u(3) = dot_product(rows%tangent(:, 2, a), d)
  end function relative_in_space

  !> Force on the contactor of row a [F] in x, y, z.
  pure function row_force(rows, a) result(force)
    type(rows_t), intent(in) :: rows
    integer, intent(in) :: a
    real(wp) :: force(most_components)
    associate (n => rows%normal(:, a), r => rows%r(:, a))
      if (rows%dim == 3) then
        force = n*r(1) + rows%tangent(:, 1, a)*r(2) + rows%tangent(:, 2, a)*r(3)
      else
        force(1) = n(1)*r(1) - n(2)*r(2)
        force(2) = n(2)*r(1) + n(1)*r(2)
        force(3) = zero
      end if
    end associate
  end function row_force

  !> f = f + factor H' r of row a; f (2 or 3, *).
  pure subroutine add_row_force(rows, a, factor, column, f)
    type(rows_t), intent(in) :: rows
    integer, intent(in) :: a, column(:)
    real(wp), intent(in) :: factor
    real(wp), intent(inout) :: f(:, :)
    real(wp) :: force(most_components), plane(2)
    integer :: k
    force = factor*row_force(rows, a)
    plane = force(:2)
    if (rows%kind(a) == row_guided) then   ! the guide of the wall takes what acts across
      associate (node => column(rows%first(a)), wall => column(rows%first(a) + 1))
        f(:, node) = f(:, node) + force(:rows%dim)
        f(:, wall) = f(:, wall) - factor*rows%r(1, a)*rows%normal(:, a)
      end associate
    else if (rows%dim == 3) then
      do k = rows%first(a), rows%first(a + 1) - 1
        f(:, column(k)) = f(:, column(k)) + rows%weight(k)*force
      end do
    else
      do k = rows%first(a), rows%first(a + 1) - 1
        f(:, column(k)) = f(:, column(k)) + rows%weight(k)*plane
      end do
    end if
  end subroutine add_row_force

  !> A row of H, component 1 (normal), 2 or 3 (tangential) of row a: dofs of the interface and
  !> their weights, of the first n.
  pure subroutine row_of_h(rows, a, component, dof, weight, n)
    type(rows_t), intent(in) :: rows
    integer, intent(in) :: a, component
    integer, intent(inout) :: dof(:)
    real(wp), intent(inout) :: weight(:)
    integer, intent(out) :: n
    real(wp) :: e(2)
    integer :: k
    if (rows%dim == 3) then
      call row_of_h_in_space(rows, a, component, dof, weight, n)
    else
      e = rows%normal(:, a)
      if (component == 2) e = [-rows%normal(2, a), rows%normal(1, a)]
      n = 0
      do k = rows%first(a), rows%first(a + 1) - 1
        if (.not. abs(rows%weight(k)) > zero) cycle
        dof(n + 1:n + 2) = [2*rows%slot(k) - 1, 2*rows%slot(k)]
        weight(n + 1:n + 2) = rows%weight(k)*e
        n = n + 2
      end do
    end if
    ! Its guide holds the wall.
    if (component > 1 .and. rows%kind(a) == row_guided) n = rows%dim
  end subroutine row_of_h

  pure subroutine row_of_h_in_space(rows, a, component, dof, weight, n)
    type(rows_t), intent(in) :: rows
    integer, intent(in) :: a, component
    integer, intent(inout) :: dof(:)
    real(wp), intent(inout) :: weight(:)
    integer, intent(out) :: n
    real(wp) :: e(3)
    integer :: k
    e = rows%normal(:, a)
    if (component > 1) e = rows%tangent(:, component - 1, a)
    n = 0
    do k = rows%first(a), rows%first(a + 1) - 1
      if (.not. abs(rows%weight(k)) > zero) cycle
      dof(n + 1:n + 3) = 3*rows%slot(k) + [-2, -1, 0]
      weight(n + 1:n + 3) = rows%weight(k)*e
      n = n + 3
    end do
  end subroutine row_of_h_in_space

  !> Length of the tangential part of a local vector v(d).
  pure real(wp) function tangential_length(d, v)
    integer, intent(in) :: d
    real(wp), intent(in) :: v(d)
    if (d == 3) then
      tangential_length = sqrt(v(2)**2 + v(3)**2)
    else
      tangential_length = abs(v(2))
    end if
  end function tangential_length

  !> a_t.b_t of two local vectors (d).
  pure real(wp) function tangential_product(d, a, b) result(product)
    integer, intent(in) :: d
    real(wp), intent(in) :: a(d), b(d)
    product = a(2)*b(2)
    if (d == 3) product = product + a(3)*b(3)
  end function tangential_product

end module contact_kinematics
