! SPDX-License-Identifier: BSD-3-Clause
!> Masses in space: the row sums of DISPERSION, its directions, and where the mass of massless
!> nodes goes.
program test_mass
  use assembly_mass, only: element_mass, redistribution_targets
  use base_kinds, only: wp, zero, one, half
  use base_status, only: status_t, failed
  use check, only: test_start, test_end, check_true, check_close, check_equal, seed_random
  use eigenvalues, only: all_eigenvalues
  use element_base, only: element_t, gauss
  use element_dispersion, only: tuned_points, keep_row_sums
  use element_hex8, only: corner
  use element_registry, only: make_element
  use material_base, only: in_space
  use material_registry, only: make_material
  use model_data, only: model_t
  implicit none
  class(element_t), allocatable :: hexahedron

  call test_start('mass')
  call make_element('HEX8', hexahedron)
  call seed_random(5)
  call test_box()
  call test_distorted()
  call test_direction()
  call test_model()
  call test_layer()
  call test_block()
  call test_others()
  call test_end()

contains

  !> A random linear map of the cube: its row sums hold, and it stays as it is.
  subroutine test_box()
    real(wp) :: map(3, 3), x(3, 8), me(8, 8), before(8, 8), h(3)
    integer :: k, wrong
    wrong = 0
    do k = 1, 200
      call random_number(map)
      call random_number(h)
      x = matmul(map + 0.7_wp*reshape([1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 3]), corner)
      if (.not. hexahedron%smallest_jacobian(x) > 0.3_wp) cycle
      call hexahedron%mass(x, one, one, sqrt(2.0_wp/3.0_wp*(one - h**2)), before)
      me = before
      call keep_row_sums(hexahedron%lumped_mass(x, one, one), me)
      wrong = wrong + count(abs(me - before) > zero)
    end do
    call check_equal(wrong, 0, 'parallelepipeds keep every digit')
  end subroutine test_box

  !> Row sums hold, no eigenvalue is negative; added on the diagonal instead, the difference
  !> makes some so: that is what the scaling is for.
  subroutine test_distorted()
    integer, parameter :: shapes = 600
    real(wp) :: x(3, 8), shift(3, 8), me(8, 8), raw(8, 8), mass(8), nu(3), value(8)
    real(wp) :: worst_sum, least, least_by_diagonal
    integer :: i, n
    n = 0
    worst_sum = zero
    least = zero
    least_by_diagonal = zero
    do while (n < shapes)
      call random_number(shift)
      x = corner + 1.2_wp*(shift - half)
      if (.not. hexahedron%smallest_jacobian(x) > 0.02_wp) cycle
      n = n + 1
      call random_number(nu)
      nu = min(one, 1.3_wp*nu)
      call hexahedron%mass(x, one, one, sqrt(2.0_wp/3.0_wp*(one - nu**2)), raw)
      mass = hexahedron%lumped_mass(x, one, one)
      me = raw
      call keep_row_sums(mass, me)
      call check_close(maxval(abs(me - transpose(me))), zero, 1.0e-15_wp, 'symmetric', &
          maxval(mass))
      worst_sum = max(worst_sum, maxval(abs(sum(me, dim=2) - mass))/maxval(mass))
      call all_eigenvalues(me, value)
      least = min(least, minval(value)/maxval(value))
      do i = 1, 8
        raw(i, i) = raw(i, i) + mass(i) - sum(raw(:, i))
      end do
      call all_eigenvalues(raw, value)
      least_by_diagonal = min(least_by_diagonal, minval(value)/maxval(value))
    end do
    ! Sums of eight terms; eigenvalues of order 8.
    call check_close(worst_sum, zero, 1.0e-14_wp, 'row sums of distorted hexahedra')
    call check_close(least, zero, 1.0e-14_wp, 'their mass is semi-definite')
    call check_true(least_by_diagonal < -1.0e-3_wp, 'by the diagonal it is not')
    print '(3(a, es9.2))', 'row sums', worst_sum, ', least eigenvalue', least, &
        ', by the diagonal', least_by_diagonal
  end subroutine test_distorted

  !> A box of three widths: pressure waves tune each direction, shear waves the one next to that
  !> of travel, the rest keeps Gauss points.
  subroutine test_direction()
    real(wp), parameter :: width(3) = [2.0_wp, 1.0_wp, 3.0_wp], path = 0.6_wp
    real(wp) :: x(3, 8), a(3), nu(3)
    integer :: k
    do k = 1, 3
      x(k, :) = half*width(k)*corner(k, :)
    end do
    nu = path/width
    a = tuned_points(hexahedron, x, path, -one)
    call check_close(maxval(abs(a - sqrt(2.0_wp/3.0_wp*(one - nu**2)))), zero, 1.0e-15_wp, &
        'points of pressure waves')
    a = tuned_points(hexahedron, x, path, -one, [0.1_wp, 0.9_wp, -one])
    call check_close(maxval(abs(a - [gauss, gauss, sqrt(2.0_wp/3.0_wp*0.96_wp)])), zero, &
        1.0e-15_wp, 'points of shear waves along z')
    a = tuned_points(hexahedron, x(:, [2, 3, 4, 1, 6, 7, 8, 5]), path, one, [-one, zero, zero])
    call check_close(maxval(abs(a - [gauss, zero, gauss])), zero, 1.0e-15_wp, &
        'points of shear waves along x, the second direction of the element')
  end subroutine test_direction

  !> The model's element mass: c_p of every direction without travel, c_s along it.
  subroutine test_model()
    type(model_t) :: model
    real(wp) :: me(8, 8), expected(8, 8), nu, x(3, 8)
    call make_grid('HEX8', [1, 1, 1], model)
    x = model%x(:, model%mesh%nodes_of(1))
    model%controls%mass = 'DISPERSION'
    model%controls%dt = 0.1_wp
    associate (material => model%material(1)%item)
      nu = 0.1_wp*material%wave_speed(in_space)
      call element_mass(model, hexahedron, 1, me)
      call hexahedron%mass(x, material%density, one, &
          [sqrt(2.0_wp/3.0_wp*(one - nu**2)), sqrt(2.0_wp/3.0_wp*(one - nu**2)), &
          sqrt(2.0_wp/3.0_wp*(one - nu**2))], expected)
      call check_close(maxval(abs(me - expected)), zero, 1.0e-15_wp, 'tuned to pressure waves')
      model%controls%travel = [zero, one, zero]
      ! (c_s/c_p)^2 = (1 - 2 PR)/(2 - 2 PR)
      nu = nu*sqrt(0.4_wp/1.4_wp)
      call element_mass(model, hexahedron, 1, me)
      call hexahedron%mass(x, material%density, one, &
          [gauss, sqrt(2.0_wp/3.0_wp*(one - nu**2)), gauss], expected)
      call check_close(maxval(abs(me - expected)), zero, 1.0e-15_wp, 'tuned to shear waves')
      model%controls%mass = 'LUMPED'
      call element_mass(model, hexahedron, 1, me)
      expected = zero
      expected(3, 3) = material%density/8.0_wp
      call check_close(maxval(abs(me(:, 3) - expected(:, 3))), zero, 1.0e-15_wp, 'lumped')
    end associate
  end subroutine test_model

  !> A block of unit cubes with one material, nodes x fastest.
  subroutine make_grid(kind, n, model)
    character(*), intent(in) :: kind
    integer, intent(in) :: n(3)
    type(model_t), intent(out) :: model
    integer :: i, j, k, a, b
    model%nodes = product(n + 1)
    allocate (model%x(3, model%nodes), model%part(1), model%material(1))
    model%node_id = [(i, i=1, model%nodes)]
    call make_material('MAT_ELASTIC', 1, [1.3_wp, 10.0_wp, 0.3_wp], model%material(1)%item)
    model%part(1)%material = 1
    model%part(1)%plane = in_space
    model%part(1)%thickness = one
    call model%mesh%start(product(n), 8*product(n))
    a = n(1) + 1
    b = a*(n(2) + 1)
    do k = 0, n(3)
      do j = 0, n(2)
        do i = 0, n(1)
          model%x(:, 1 + i + a*j + b*k) = [i, j, k]
          if (any([i, j, k] == n)) cycle
          call model%mesh%add(kind, model%mesh%n + 1, 1, 0, 1 + i + a*j + b*k + &
              [0, 1, a + 1, a, b, b + 1, a + b + 1, a + b])
        end do
      end do
    end do
  end subroutine make_grid

  !> Contact at the foot: each mass goes up to the node above.
  subroutine test_layer()
    type(model_t) :: model
    type(status_t) :: status
    integer, allocatable :: first(:), target(:)
    integer :: i
    call make_grid('HEX8', [2, 3, 2], model)
    call redistribution_targets(model, [(i, i=1, 12)], first, target, status)
    call check_true(.not. failed(status), 'a layer has inner neighbours')
    call check_equal(count(first(2:) - first(:36) /= 1), 0, 'one target a node')
    call check_equal(count(target(:24) /= [(i, i=13, 24), (i, i=13, 24)]), 0, &
        'it is the node above')
  end subroutine test_layer

  !> Contact all round: only the node in the middle is left, no edge leads to it but from the
  !> centres of the faces; the rest goes there by the other nodes of its elements. With nothing
  !> inside: an error.
  subroutine test_block()
    type(model_t) :: model
    type(status_t) :: status
    integer, allocatable :: first(:), target(:)
    integer :: i
    call make_grid('HEX8', [2, 2, 2], model)
    call redistribution_targets(model, pack([(i, i=1, 27)], [(i, i=1, 27)] /= 14), first, &
        target, status)
    call check_true(.not. failed(status), 'a block has an inner node')
    call check_equal(size(target), 27, 'one target a node all round')
    call check_equal(count(target /= 14), 0, 'it is the node in the middle')
    call make_grid('HEX8', [1, 1, 1], model)
    call redistribution_targets(model, [(i, i=1, 8)], first, target, status)
    call check_true(failed(status), 'nothing inside')
  end subroutine test_block

  !> Seven contact nodes of a hexahedron: neighbours by edges go before other nodes, and only
  !> those without a neighbour ask for them.
  subroutine test_others()
    type(model_t) :: model
    type(status_t) :: status
    integer, allocatable :: first(:), target(:)
    call make_grid('HEX8', [1, 1, 1], model)
    call redistribution_targets(model, [1, 2, 3, 4, 5], first, target, status)
    call check_true(.not. failed(status), 'five of eight')
    ! Rows 1 to 8: 1 has edges to 2, 3, 5 alone, hence 6, 7, 8; 2 to 6; 3 to 7; 4 to 8; 5 to 6
    ! and 7. (Nodes of the grid: x fastest.)
    call check_equal(count(first /= [1, 4, 5, 6, 7, 9, 10, 11, 12]), 0, 'how many')
    call check_equal(sum(target(1:3)), 6 + 7 + 8, 'all others')
    call check_equal(count(target(4:6) /= [6, 7, 8]), 0, 'one edge')
    call check_equal(sum(target(7:8)), 6 + 7, 'two edges')
  end subroutine test_others

end program test_mass
