! SPDX-License-Identifier: BSD-3-Clause
!> Made-up rows of contact in the plane and in space, on nodes of a made-up flexibility.
module made_rows
  use base_kinds, only: wp, zero, half, one
  use contact_node, only: pairing_node_t
  use contact_rows, only: rows_t, start_rows, add_row, row_edge
  use contact_types, only: contact_t
  implicit none
  private
  public :: fill_random, random_unit, add_rows, make_contact

  integer, parameter, public :: nodes = 12

contains

  !> Numbers in (-1, 1).
  subroutine fill_random(x)
    real(wp), intent(out) :: x(:, :)
    call random_number(x)
    x = 2.0_wp*x - one
  end subroutine fill_random

  function random_unit(dim) result(n)
    integer, intent(in) :: dim
    real(wp) :: n(dim), x(dim, 1)
    call fill_random(x)
    n = x(:, 1)/norm2(x)
  end function random_unit

  !> n rows in turn: a wall, a node on a vertex, on an edge or a facet, in space two edges,
  !> many points (a mortar). Weights sum to zero but at the wall.
  subroutine add_rows(rows, n, mu)
    type(rows_t), intent(inout) :: rows
    integer, intent(in) :: n
    real(wp), intent(in) :: mu
    real(wp) :: x(8), weight(9)
    integer :: k, i, points
    do k = 1, n
      call random_number(x)
      points = 1 + mod(k, 2*rows%dim)
      if (mod(k, 7) == 0) points = 9
      weight(1) = one
      if (points > 1) weight(2:points) = -x(:points - 1)/sum(x(:points - 1))
      if (points == 4 .and. rows%dim == 3) weight(:4) = [one - x(1), x(1), x(2) - one, -x(2)]
      ! The last is what the others leave: their sum is zero to round-off.
      if (points > 1) weight(points) = -sum(weight(:points - 1))
      call add_row(rows, [1, 1, k, -1], [(1 + mod(k + 5*i, nodes), i=1, points)], &
          weight(:points), random_unit(rows%dim), 0.1_wp*(x(1) - half), mu, one, row_edge, zero)
    end do
    rows%slot(:rows%first(n + 1) - 1) = rows%point(:rows%first(n + 1) - 1)
  end subroutine add_rows

  !> A contact of random rows on nodes of a random flexibility of a condition of some ten.
  subroutine make_contact(dim, d, n, mu, contact)
    integer, intent(in) :: dim, d, n
    real(wp), intent(in) :: mu
    type(contact_t), intent(out) :: contact
    real(wp) :: b(dim*nodes, dim*nodes)
    integer :: i
    allocate (contact%pairing(1), contact%acts(1), contact%rows, contact%spare, contact%before)
    allocate (pairing_node_t :: contact%pairing(1)%item)
    contact%dim = dim
    contact%d = d
    contact%interface_node = [(i, i=1, nodes)]
    contact%slot = contact%interface_node
    allocate (contact%constrained(0), contact%column(dim*nodes))
    call fill_random(b)
    call contact%schur_inverse%set_one_body(dim*nodes)
    contact%schur_inverse%block(1)%a = matmul(b, transpose(b))/nodes
    do i = 1, dim*nodes
      associate (a => contact%schur_inverse%block(1)%a)
        a(i, i) = a(i, i) + half
      end associate
    end do
    contact%cone%tolerance = 1.0e-13_wp
    call start_rows(contact%rows, dim=dim)
    call start_rows(contact%spare, dim=dim)
    call start_rows(contact%before, dim=dim)
    call add_rows(contact%rows, n, mu)
  end subroutine make_contact

end module made_rows
