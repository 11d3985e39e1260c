! SPDX-License-Identifier: BSD-3-Clause
!> Every element of the registry: rigid motions, patch test, masses, shapes; and the laws.
program test_element
  use base_kinds, only: wp, zero, one, half
  use check, only: test_start, test_end, check_true, check_close, seed_random
  use element_base, only: element_t
  use element_limit, only: stable_step
  use element_registry, only: make_element, element_names
  use linalg_dense, only: largest_by_lapack
  use material_base, only: material_t, plane_stress, plane_strain
  use material_registry, only: make_material
  implicit none
  real(wp), parameter :: thickness = 0.7_wp, density = 1.3_wp
  class(element_t), allocatable :: element
  class(material_t), allocatable :: material
  character(8), allocatable :: names(:)
  integer :: k

  call test_start('element')
  call make_material('MAT_ELASTIC', 1, [density, 200.0_wp, 0.3_wp], material)
  call test_law()
  call element_names(names)
  do k = 1, size(names)
    call make_element(names(k), element)
    call test_stiffness(plane_stress)
    call test_stiffness(plane_strain)
    call test_mass()
    call test_shape()
  end do
  call seed_random(7)
  call test_square_limits()
  call test_limit_of_mesh('TRI3')
  call test_limit_of_mesh('QUAD4')
  call test_end()

contains

  !> A convex shape without symmetry, counter-clockwise.
  function corners() result(x)
    real(wp) :: x(2, element%nodes)
    real(wp), parameter :: quad(2, 4) = reshape([0.1_wp, -0.2_wp, 2.0_wp, 0.3_wp, 1.7_wp, &
        1.9_wp, -0.3_wp, 1.2_wp], [2, 4])
    x = quad(:, 1:element%nodes)
  end function corners

  real(wp) function area(x)
    real(wp), intent(in) :: x(:, :)
    integer :: k, next
    area = zero
    do k = 1, size(x, 2)
      next = 1 + mod(k, size(x, 2))
      area = area + half*(x(1, k)*x(2, next) - x(1, next)*x(2, k))
    end do
  end function area

  !> Rigid motions cost no force; a constant strain costs the exact energy (patch test).
  subroutine test_stiffness(plane)
    integer, intent(in) :: plane
    real(wp) :: x(2, element%nodes), ke(2*element%nodes, 2*element%nodes), u(2*element%nodes)
    real(wp) :: d(3, 3), strain(3), energy
    integer :: k
    x = corners()
    d = material%moduli(plane)
    call element%stiffness(x, d, thickness, ke)
    call check_true(.not. any(abs(ke - transpose(ke)) > zero), element%name//' symmetry')
    do k = 1, 3
      u = pack_motion(x, k)
      call check_close(maxval(abs(matmul(ke, u))), zero, 1.0e-12_wp, element%name// &
          ' rigid motion', maxval(abs(ke)))
    end do
    strain = [1.0e-3_wp, -4.0e-4_wp, 7.0e-4_wp]
    u = reshape([(strain(1)*x(1, k) + half*strain(3)*x(2, k), &
        half*strain(3)*x(1, k) + strain(2)*x(2, k), k=1, size(x, 2))], [size(u)])
    energy = area(x)*thickness*dot_product(strain, matmul(d, strain))
    call check_close(dot_product(u, matmul(ke, u)), energy, 1.0e-13_wp, element%name// &
        ' energy of constant strain', energy)
  end subroutine test_stiffness

  !> Two translations and a small rotation.
  function pack_motion(x, k) result(u)
    real(wp), intent(in) :: x(:, :)
    integer, intent(in) :: k
    real(wp) :: u(2*size(x, 2))
    integer :: i
    u = zero
    if (k < 3) u(k::2) = one
    if (k == 3) u = reshape([(-x(2, i), x(1, i), i=1, size(x, 2))], [size(u)])
  end function pack_motion

  !> Whatever the integration points, the total mass is exact (the Jacobian is linear).
  subroutine test_mass()
    real(wp) :: x(2, element%nodes), me(element%nodes, element%nodes), total
    real(wp), parameter :: points(3) = [one/sqrt(3.0_wp), one, zero]
    integer :: k
    x = corners()
    total = density*thickness*area(x)
    do k = 1, size(points)
      call element%mass(x, density, thickness, [points(k), points(k)], me)
      call check_close(sum(me), total, 1.0e-14_wp, element%name//' total mass', total)
      call check_close(maxval(abs(me - transpose(me))), zero, 1.0e-15_wp, element%name// &
          ' symmetric mass', total)
    end do
  end subroutine test_mass

  subroutine test_shape()
    real(wp) :: x(2, element%nodes)
    x = corners()
    call check_true(element%smallest_jacobian(x) > zero, element%name//' is a good shape')
    call check_true(.not. element%smallest_jacobian(x(:, size(x, 2):1:-1)) > zero, &
        element%name//' clockwise')
    x(:, 2) = x(:, 1)
    call check_true(.not. element%smallest_jacobian(x) > zero, element%name//' degenerate')
    x = corners()
    call check_close(maxval(abs(element%sizes(2.0_wp*x) - 2.0_wp*element%sizes(x))), zero, &
        1.0e-15_wp, element%name//' widths scale with the element')
  end subroutine test_shape

  !> Plane strain: (lambda + 2G), G; plane stress: no stress across; uniaxial stress gives E.
  subroutine test_law()
    real(wp) :: d(3, 3), e(3), s(3), lame
    lame = 200.0_wp*0.3_wp/(1.3_wp*0.4_wp)
    d = material%moduli(plane_strain)
    call check_close(d(1, 2), lame, 1.0e-14_wp, 'lambda', lame)
    call check_close(d(1, 1), lame + 200.0_wp/1.3_wp, 1.0e-14_wp, 'lambda + 2G', lame)
    call check_close(material%wave_speed(plane_strain), sqrt(d(1, 1)/density), 1.0e-14_wp, &
        'speed in plane strain', 10.0_wp)
    d = material%moduli(plane_stress)
    e = [one, -0.3_wp, zero]
    s = matmul(d, e)
    call check_close(s(1), 200.0_wp, 1.0e-14_wp, 'uniaxial stress', 200.0_wp)
    call check_close(s(2), zero, 1.0e-13_wp, 'no lateral stress', 200.0_wp)
    call check_close(material%wave_speed(plane_stress), sqrt(200.0_wp/(0.91_wp*density)), &
        1.0e-14_wp, 'speed in plane stress', 10.0_wp)
  end subroutine test_law

  !> Squares: the mode of highest frequency is the uniform dilation, omega^2 =
  !> 4 (d11 + d12)/(rho side^2), so the largest step over side/c_p is sqrt(1 - nu) in plane
  !> strain, 1/sqrt(1 + nu) in plane stress. To the round-off of an eigenvalue of order 8.
  subroutine test_square_limits()
    real(wp), parameter :: side = 0.3_wp
    real(wp), parameter :: x(2, 4) = side*reshape([0, 0, 1, 0, 1, 1, 0, 1], [2, 4])
    real(wp), parameter :: ratios(5) = [zero, 0.3_wp, 0.45_wp, 0.3_wp, 0.45_wp]
    integer, parameter :: planes(5) = [plane_strain, plane_strain, plane_strain, &
        plane_stress, plane_stress]
    real(wp) :: h, exact
    integer :: k
    call make_element('QUAD4', element)
    do k = 1, size(ratios)
      call make_material('MAT_ELASTIC', 1, [density, 200.0_wp, ratios(k)], material)
      call stable_step(element, x, density, material%moduli(planes(k)), thickness, h)
      exact = sqrt(one - ratios(k))
      if (planes(k) == plane_stress) exact = one/sqrt(one + ratios(k))
      call check_close(h*material%wave_speed(planes(k))/side, exact, 1.0e-14_wp, &
          'largest step of a square')
    end do
  end subroutine test_square_limits

  !> Irons: no frequency of a mesh is above the largest of its elements. Random meshes, free.
  subroutine test_limit_of_mesh(name)
    character(*), intent(in) :: name
    integer, parameter :: m = 4
    real(wp) :: x(2, m*m), k(2*m*m, 2*m*m), mass(m*m), root(2*m*m), shift(2), ratio(2), h, &
        smallest, omega2
    integer :: i, j, trial
    call make_element(name, element)
    do trial = 1, 20
      call random_number(ratio)
      call make_material('MAT_ELASTIC', 1, [density, 200.0_wp, 0.49_wp*ratio(1)], material)
      do j = 0, m - 1
        do i = 0, m - 1
          call random_number(shift)
          x(:, m*j + i + 1) = [i, j] + 0.45_wp*(shift - half)
          x(1, m*j + i + 1) = x(1, m*j + i + 1)*(one + 3.0_wp*ratio(2))
        end do
      end do
      k = zero
      mass = zero
      smallest = huge(smallest)
      do j = 0, m - 2
        do i = 1, m - 1
          if (name == 'QUAD4') then
            call add_element(m*j + [i, i + 1, i + 1 + m, i + m], x, k, mass, smallest)
          else
            call add_element(m*j + [i, i + 1, i + 1 + m], x, k, mass, smallest)
            call add_element(m*j + [i, i + 1 + m, i + m], x, k, mass, smallest)
          end if
        end do
      end do
      root(1::2) = sqrt(mass)
      root(2::2) = sqrt(mass)
      do j = 1, size(k, 2)
        k(:, j) = k(:, j)/(root*root(j))
      end do
      call largest_by_lapack(k, omega2)
      h = 2.0_wp/sqrt(omega2)
      call check_true(smallest <= h*(one + 1.0e-13_wp), element%name//': the limit is safe')
      call check_true(smallest > 0.5_wp*h, element%name//': the limit is near that of the mesh')
    end do
  end subroutine test_limit_of_mesh

  !> One element into stiffness and lumped mass of a mesh; smallest: of their steps so far.
  subroutine add_element(node, x, k, mass, smallest)
    integer, intent(in) :: node(:)
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(inout) :: k(:, :), mass(:), smallest
    real(wp) :: ke(2*size(node), 2*size(node)), h
    integer :: dof(2*size(node)), i
    dof = [(2*node(i) - 1, 2*node(i), i=1, size(node))]
    call element%stiffness(x(:, node), material%moduli(plane_strain), thickness, ke)
    k(dof, dof) = k(dof, dof) + ke
    mass(node) = mass(node) + element%lumped_mass(x(:, node), density, thickness)
    call stable_step(element, x(:, node), density, material%moduli(plane_strain), thickness, h)
    smallest = min(smallest, h)
  end subroutine add_element

end program test_element
