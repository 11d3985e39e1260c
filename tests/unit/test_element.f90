! SPDX-License-Identifier: BSD-3-Clause
!> Every element of the registry: rigid motions, patch test, masses, shapes; and the laws.
program test_element
  use base_kinds, only: wp, zero, one, half
  use check, only: test_start, test_end, check_true, check_close, seed_random
  use element_base, only: element_t, strains
  use element_hex27, only: hex27_places
  use element_hex8, only: corner
  use element_limit, only: stable_step
  use element_tet10, only: tet10_places
  use element_registry, only: make_element, element_names
  use linalg_dense, only: largest_by_lapack
  use material_base, only: material_t, plane_stress, plane_strain, &
      axisymmetric, in_space
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
    if (element%is_ring) then
      call test_ring()
    else if (element%dim == 2) then
      call test_stiffness(plane_stress)
      call test_stiffness(plane_strain)
    else
      call test_stiffness(in_space)
    end if
    call test_mass()
    call test_shape()
    call test_faces()
  end do
  call seed_random(7)
  call test_square_limits()
  call test_limit_of_mesh('TRI3')
  call test_limit_of_mesh('QUAD4')
  call test_end()

contains

  !> A convex shape without symmetry, counter-clockwise; of quadratic elements with straight
  !> edges, since faces are measured by their corners.
  function corners() result(x)
    real(wp) :: x(element%dim, element%nodes), shift(element%dim)
    real(wp), parameter :: quad(2, 4) = reshape([0.1_wp, -0.2_wp, 2.0_wp, 0.3_wp, 1.7_wp, &
        1.9_wp, -0.3_wp, 1.2_wp], [2, 4])
    integer :: i
    if (element%dim == 2) then
      x = quad(:, 1:element%nodes)
      if (element%is_ring) x(1, :) = x(1, :) + 0.4_wp    ! radii
      return
    end if
    call seed_random(11)
    x = places()
    do i = 1, size(x, 2)
      call random_number(shift)
      x(:, i) = x(:, i) + 0.2_wp*(shift - half)
    end do
    if (element%name == 'TET10') call straighten('TET4', tet10_places(), x)
    if (element%name == 'HEX27') call straighten('HEX8', hex27_places(), x)
  end function corners

  !> All nodes where the linear element with the same corners has them.
  subroutine straighten(name, place, x)
    character(*), intent(in) :: name
    real(wp), intent(in) :: place(:, :)
    real(wp), intent(inout) :: x(:, :)
    class(element_t), allocatable :: straight
    real(wp) :: n(8), dn(8, 3)
    integer :: k
    call make_element(name, straight)
    associate (m => straight%nodes)
      do k = m + 1, size(x, 2)
        call straight%shape(place(:, k), n(:m), dn(:m, :))
        x(:, k) = matmul(x(:, :m), n(:m))
      end do
    end associate
  end subroutine straighten

  !> The nodes of the regular shape in space.
  function places() result(x)
    real(wp) :: x(3, element%nodes)
    select case (element%name)
    case ('TET4')
      x = reshape([zero, zero, zero, one, zero, zero, zero, one, zero, zero, zero, one], [3, 4])
    case ('TET10')
      x = tet10_places()
    case ('HEX27')
      x = hex27_places()
    case ('WEDGE6')
      x(:, 1:4) = corner(:, 1:4)
      x(:, 5) = [zero, -one, one]
      x(:, 6) = [zero, one, one]
    case ('PYRAMID5')
      x(:, 1:4) = corner(:, 1:4)
      x(:, 5) = [zero, zero, one]
    case default
      x = corner
    end select
  end function places

  !> Area or volume, by the rule of the mass.
  real(wp) function area(x)
    real(wp), intent(in) :: x(:, :)
    area = sum(element%lumped_mass(x, one, one))
  end function area

  !> Rigid motions cost no force; a constant strain costs the exact energy (patch test).
  subroutine test_stiffness(plane)
    integer, intent(in) :: plane
    real(wp), dimension(element%dim*element%nodes) :: u
    real(wp) :: x(element%dim, element%nodes), ke(size(u), size(u))
    real(wp) :: d(strains(element%dim), strains(element%dim)), strain(size(d, 1)), energy
    real(wp) :: gradient(element%dim, element%dim), volume
    integer :: k
    x = corners()
    d = material%moduli(plane)
    volume = area(x)
    if (element%dim == 2) volume = volume*thickness
    call element%stiffness(x, d, merge(thickness, one, element%dim == 2), ke)
    call check_true(.not. any(abs(ke - transpose(ke)) > zero), element%name//' symmetry')
    do k = 1, 3*(element%dim - 1)
      u = pack_motion(x, k)
      call check_close(maxval(abs(matmul(ke, u))), zero, 1.0e-12_wp, element%name// &
          ' rigid motion', maxval(abs(ke)))
    end do
    call random_number(gradient)
    u = reshape(matmul(gradient, x), [size(u)])
    strain(:element%dim) = [(gradient(k, k), k=1, element%dim)]
    if (element%dim == 2) strain(3) = gradient(1, 2) + gradient(2, 1)
    if (element%dim == 3) strain(4:6) = [gradient(1, 2) + gradient(2, 1), &
        gradient(2, 3) + gradient(3, 2), gradient(3, 1) + gradient(1, 3)]
    energy = volume*dot_product(strain, matmul(d, strain))
    call check_close(dot_product(u, matmul(ke, u)), energy, 1.0e-13_wp, element%name// &
        ' energy of constant strain', energy)
    call check_close(maxval(abs(element%mean_strain(x, reshape(u, shape(x))) - strain)), zero, &
        1.0e-13_wp, element%name//' mean strain', maxval(abs(strain)))
  end subroutine test_stiffness

  !> A motion along the axis costs no force; the strain that a displacement (a x, b y) makes,
  !> with a around the axis, costs the exact energy.
  subroutine test_ring()
    real(wp), parameter :: a = 0.3_wp, b = -0.7_wp
    real(wp), parameter :: strain(4) = [a, b, zero, a]
    real(wp) :: x(2, element%nodes), u(2*element%nodes), ke(size(u), size(u)), energy
    real(wp) :: d(4, 4)
    x = corners()
    d = material%moduli(axisymmetric)
    call element%stiffness(x, d, thickness, ke)
    call check_true(.not. any(abs(ke - transpose(ke)) > zero), element%name//' symmetry')
    u = reshape(spread([zero, one], 2, element%nodes), [size(u)])
    call check_close(maxval(abs(matmul(ke, u))), zero, 1.0e-12_wp, element%name// &
        ' axial motion', maxval(abs(ke)))
    u = reshape(x*spread([a, b], 2, element%nodes), [size(u)])
    energy = thickness*measure(x)*dot_product(strain, matmul(d, strain))
    call check_close(dot_product(u, matmul(ke, u)), energy, 1.0e-13_wp, element%name// &
        ' energy of constant strain', energy)
    call check_close(maxval(abs(element%mean_strain(x, reshape(u, shape(x))) - strain)), zero, &
        1.0e-13_wp, element%name//' mean strain', maxval(abs(strain)))
  end subroutine test_ring

  !> Translations and small rotations about the axes, in the plane about z.
  function pack_motion(x, k) result(u)
    real(wp), intent(in) :: x(:, :)
    integer, intent(in) :: k
    real(wp) :: u(size(x)), motion(size(x, 1), size(x, 2))
    integer :: m, a, b
    m = size(x, 1)
    motion = zero
    if (k <= m) then
      motion(k, :) = one
    else
      a = merge(1, 1 + mod(k - m, 3), m == 2)
      b = merge(2, 1 + mod(k - m + 1, 3), m == 2)
      motion(a, :) = -x(b, :)
      motion(b, :) = x(a, :)
    end if
    u = reshape(motion, [size(u)])
  end function pack_motion

  !> Faces close the element and look outward.
  subroutine test_faces()
    real(wp) :: x(3, element%nodes), a(3), total(3), centre(3)
    integer :: f, k, m
    x = zero
    x(:element%dim, :) = corners()
    total = zero
    do f = 1, element%facets()
      associate (node => element%facet_nodes(f))
        m = size(node)
        a = zero
        if (element%dim == 2) a = [x(2, node(2)) - x(2, node(1)), &
            x(1, node(1)) - x(1, node(2)), zero]
        if (element%dim == 3) a = half*cross(x(:, node(3)) - x(:, node(1)), &
            x(:, node(m)) - x(:, node(2)))
        if (m == 3) a = half*cross(x(:, node(2)) - x(:, node(1)), x(:, node(3)) - x(:, node(1)))
        centre = sum(x(:, node), dim=2)/m - sum(x, dim=2)/element%nodes
      end associate
      total = total + a
      call check_true(dot_product(a, centre) > zero, element%name//': a face looks outward')
    end do
    call check_close(maxval(abs(total)), zero, 1.0e-14_wp, element%name//': faces close', one)
    call check_true(all([(any(element%face == k), k=1, min(26, element%nodes))]), &
        element%name//': every node is in a face')
  end subroutine test_faces

  pure function cross(a, b) result(c)
    real(wp), intent(in) :: a(3), b(3)
    real(wp) :: c(3)
    c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function cross

  !> Whatever the integration points, the total mass is exact where the Jacobian is linear in
  !> each direction: in the plane. In space and of rings that of the Gauss points.
  subroutine test_mass()
    real(wp) :: x(element%dim, element%nodes), me(element%nodes, element%nodes), total
    real(wp) :: a(element%dim)
    real(wp), parameter :: points(3) = [one/sqrt(3.0_wp), one, zero]
    integer :: k
    x = corners()
    total = density*thickness*measure(x)
    do k = 1, merge(3, 1, element%dim == 2 .and. .not. element%is_ring)
      a = points(k)
      call element%mass(x, density, thickness, a, me)
      call check_close(sum(me), total, 1.0e-14_wp, element%name//' total mass', total)
      call check_close(maxval(abs(me - transpose(me))), zero, 1.0e-15_wp, element%name// &
          ' symmetric mass', total)
    end do
  end subroutine test_mass

  !> Area of the polygon; of a ring its first moment times 2 pi (Pappus); volume by the
  !> divergence theorem: a third of the integral of x.n over the bilinear faces, exact with
  !> 2 x 2 points.
  real(wp) function measure(x)
    real(wp), intent(in) :: x(:, :)
    integer :: f, m
    measure = zero
    do f = 1, size(element%face, 2)
      m = element%face_size(f)
      if (m > 4) m = merge(3, 4, m == 6)
      associate (node => element%face(:m, f))
        if (element%is_ring) then
          measure = measure + acos(-one)/3.0_wp*(x(2, node(2)) - x(2, node(1))) &
              *(x(1, node(1))**2 + x(1, node(1))*x(1, node(2)) + x(1, node(2))**2)
          cycle
        end if
        if (element%dim == 2) measure = measure + half*(x(1, node(1))*x(2, node(2)) &
            - x(1, node(2))*x(2, node(1)))
        if (element%dim == 3) measure = measure + flux(x(:, [node, node(m)]))/3.0_wp
      end associate
    end do
  end function measure

  !> Integral of x.n over a bilinear face.
  real(wp) function flux(x)
    real(wp), intent(in) :: x(:, :)
    real(wp), parameter :: g = one/sqrt(3.0_wp)
    real(wp) :: n(4), s, t
    integer :: i, j
    flux = zero
    do i = -1, 1, 2
      do j = -1, 1, 2
        s = g*i
        t = g*j
        n = 0.25_wp*[(one - s)*(one - t), (one + s)*(one - t), (one + s)*(one + t), &
            (one - s)*(one + t)]
        flux = flux + dot_product(matmul(x(:, 1:4), n), cross( &
            matmul(x(:, 1:4), 0.25_wp*[-(one - t), one - t, one + t, -(one + t)]), &
            matmul(x(:, 1:4), 0.25_wp*[-(one - s), -(one + s), one + s, one - s])))
      end do
    end do
  end function flux

  subroutine test_shape()
    real(wp) :: x(element%dim, element%nodes)
    x = corners()
    call check_true(element%smallest_jacobian(x) > zero, element%name//' is a good shape')
    x(1, :) = -x(1, :)
    call check_true(.not. element%smallest_jacobian(x) > zero, element%name//' mirrored')
    x = corners()
    x(:, 2) = x(:, 1)
    call check_true(.not. element%smallest_jacobian(x) > 1.0e-12_wp, element%name// &
        ' degenerate')
    if (.not. element%takes_dispersion) return
    x = corners()
    call check_close(maxval(abs(element%sizes(2.0_wp*x) - 2.0_wp*element%sizes(x))), zero, &
        1.0e-14_wp, element%name//' widths scale with the element')
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
