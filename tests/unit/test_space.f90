! SPDX-License-Identifier: BSD-3-Clause
!> Elements in space: patch test of distorted meshes, rigid modes, locking, masses; shape
!> functions, facets and rule of the quadratic ones.
program test_space
  use base_kinds, only: wp, zero, one, half
  use check, only: test_start, test_end, check_true, check_close, check_equal, seed_random
  use eigenvalues, only: all_eigenvalues
  use element_base, only: element_t, jacobian_at, gauss, most_points
  use element_hex27, only: hex27_places
  use element_hex8, only: corner, hex_face
  use element_registry, only: make_element, element_names
  use element_tet10, only: tet10_places
  use linalg_dense, only: solve_general
  use material_base, only: material_t, in_space
  use material_registry, only: make_material
  implicit none
  integer, parameter :: cells = 2, side = 2*cells + 1, most = side**3
  class(element_t), allocatable :: element
  class(material_t), allocatable :: material
  character(8), allocatable :: names(:)
  integer :: k

  call test_start('space')
  call make_material('MAT_ELASTIC', 1, [one, one, 0.3_wp], material)
  call element_names(names)
  do k = 1, size(names)
    call make_element(names(k), element)
    if (element%dim == 2) cycle
    call seed_random(3)
    call test_patch()
    call test_spectrum()
    call test_masses()
  end do
  call test_places('TET10', tet10_places())
  call test_places('HEX27', hex27_places())
  call test_rule()
  call test_lumped()
  call test_inside()
  call test_stiff_modes('HEX8', 7)
  call test_stiff_modes('HEX8MEAN', 1)
  call test_stiff_modes('HEX8MODE', 4)
  ! Bars of 10 x 1 x 1, 5 x 1 x 1, 10 x 2 x 2 elements, and the first with PR .499: by an
  ! independent program, to three digits.
  call test_bending('HEX8', [0.649_wp, 0.371_wp, 0.702_wp, 0.490_wp])
  call test_bending('HEX8MEAN', [1.211_wp, 0.505_wp, 0.767_wp, 1.396_wp])
  call test_bending('HEX8MODE', [0.998_wp, 0.996_wp, 1.000_wp, 0.990_wp])
  call test_bending('HEX27', [1.000_wp, 0.999_wp])
  call test_end()

contains

  !> The elements of a cell of two units a side, nodes by their places (0, 1, 2)^3 in it.
  subroutine fill_cell(place, n)
    integer, intent(out) :: place(:, :, :), n
    integer, parameter :: order(3, 6) = reshape([1, 2, 3, 2, 3, 1, 3, 1, 2, 2, 1, 3, 1, 3, 2, &
        3, 2, 1], [3, 6])
    integer :: cube(3, 8), i, j, a(3)
    cube = nint(corner) + 1
    n = 6
    select case (element%name)
    case ('TET4', 'TET10')
      ! Along the diagonal, by the order in which coordinates grow.
      do i = 1, 6
        place(:, 1:4, i) = 0
        do j = 1, 3
          a = 0
          a(order(j, i)) = 2
          place(:, j + 1, i) = place(:, j, i) + a
        end do
        if (i > 3) place(:, 2:3, i) = place(:, [3, 2], i)
      end do
      if (element%nodes == 10) place(:, 5:10, :6) = (place(:, [1, 2, 3, 1, 2, 3], :6) &
          + place(:, [2, 3, 1, 4, 4, 4], :6))/2
    case ('PYRAMID5')
      do i = 1, 6
        place(:, 1:4, i) = cube(:, hex_face([1, 4, 3, 2], i))
        place(:, 5, i) = 1
      end do
    case ('WEDGE6')
      n = 2
      place(:, :6, 1) = cube(:, [1, 2, 3, 4, 5, 8])
      place(:, :6, 2) = cube(:, [6, 5, 8, 7, 2, 3])
    case ('HEX27')
      n = 1
      place(:, :, 1) = nint(hex27_places()) + 1
    case default
      n = 1
      place(:, :8, 1) = cube
    end select
  end subroutine fill_cell

  !> A cube of 2 x 2 x 2 cells with all nodes moved, mid nodes too: a linear displacement leaves
  !> no force inside, and its energy is exact.
  subroutine test_patch()
    integer :: place(3, 27, 6), node(27), n, i, j, c, e, m
    real(wp) :: x(3, most), u(3, most), f(3, most), gradient(3, 3), shift(3), fe(81), ke(81, 81)
    logical :: inside(most), used(most)
    real(wp) :: smallest, largest
    do c = 1, most
      call random_number(shift)
      associate (at => [mod(c - 1, side), mod((c - 1)/side, side), (c - 1)/side**2])
        x(:, c) = half*at + 0.2_wp*merge(0.4_wp, one, element%nodes >= 10)*(shift - half)
        inside(c) = all(at > 0 .and. at < side - 1)
      end associate
    end do
    call random_number(gradient)
    u = matmul(gradient, x)
    call fill_cell(place, n)
    m = element%nodes
    f = zero
    used = .false.
    smallest = one
    largest = zero
    do c = 0, cells**3 - 1
      do e = 1, n
        do i = 1, m
          associate (at => place(:, i, e) + 2*[mod(c, 2), mod(c/2, 2), c/4])
            node(i) = 1 + at(1) + side*(at(2) + side*at(3))
          end associate
        end do
        used(node(:m)) = .true.
        smallest = min(smallest, element%smallest_jacobian(x(:, node(:m))))
        call element%stiffness(x(:, node(:m)), material%moduli(in_space), one, ke(:3*m, :3*m))
        fe(:3*m) = matmul(ke(:3*m, :3*m), reshape(u(:, node(:m)), [3*m]))
        largest = max(largest, maxval(abs(fe(:3*m))))
        do j = 1, m
          f(:, node(j)) = f(:, node(j)) + fe(3*j - 2:3*j)
        end do
      end do
    end do
    call check_true(smallest > zero, element%name//': the patch is a mesh')
    call check_true(count(inside .and. used) >= 1, element%name//': the patch has an inside')
    print '(2a, es9.2)', element%name, ' patch', &
        maxval(abs(f), mask=spread(inside, 1, 3))/largest
    ! Sums of some hundred terms.
    call check_close(maxval(abs(f), mask=spread(inside, 1, 3)), zero, 1.0e-13_wp, &
        element%name//': patch test', largest)
  end subroutine test_patch

  !> A distorted element of the registry.
  subroutine distorted(x)
    real(wp), intent(out) :: x(:, :)
    integer :: place(3, 27, 6), n
    real(wp) :: shift(3, element%nodes)
    call fill_cell(place, n)
    call random_number(shift)
    x = place(:, :element%nodes, 1) + 0.2_wp*(shift - half)
  end subroutine distorted

  !> Positive at all corners and negative at a point of the rule: no valid element.
  subroutine test_inside()
    real(wp), parameter :: x(3, 8) = 0.1_wp*reshape([0, -20, -10, -4, 5, 1, 17, 1, 3, &
        -7, 10, -19, -5, -21, 11, 14, -10, -5, 8, 9, 20, 2, 20, 10], [3, 8])
    class(element_t), allocatable :: hexahedron
    call make_element('HEX8', hexahedron)
    call check_true(jacobian_at(hexahedron, x, corner) > 0.1_wp, 'positive at the corners')
    call check_true(hexahedron%smallest_jacobian(x) < -0.1_wp, 'and refused')
  end subroutine test_inside

  !> Six motions cost nothing, all others something.
  subroutine test_spectrum()
    real(wp) :: x(3, element%nodes), ke(size(x), size(x)), value(size(x))
    call distorted(x)
    call element%stiffness(x, material%moduli(in_space), one, ke)
    call all_eigenvalues(ke, value)
    call check_close(maxval(abs(value(:6))), zero, 1.0e-14_wp*size(x), element%name// &
        ': six rigid modes', value(size(value)))
    call check_true(value(7) > 1.0e-4_wp*value(size(value)), element%name//': no seventh')
  end subroutine test_spectrum

  !> Consistent masses are positive definite, lumped ones positive with the same total.
  subroutine test_masses()
    real(wp) :: x(3, element%nodes), me(size(x, 2), size(x, 2)), value(size(x, 2))
    call distorted(x)
    call element%mass(x, one, one, [gauss, gauss, gauss], me)
    call all_eigenvalues(me, value)
    call check_true(value(1) > 1.0e-4_wp*value(size(value)), element%name// &
        ': the mass is positive definite')
    value = element%lumped_mass(x, one, one)
    call check_true(all(value > zero), element%name//': lumped masses are positive')
    call check_close(sum(value), sum(me), 1.0e-14_wp, element%name//': lumped mass', sum(me))
  end subroutine test_masses

  !> Each shape function is one at its node and zero at the others; derivatives by differences
  !> of quadratics, which are exact. Facets use the nodes of their face and close the element.
  subroutine test_places(name, place)
    character(*), intent(in) :: name
    real(wp), intent(in) :: place(:, :)
    real(wp) :: n(27), dn(27, 3), up(27), down(27), none(27, 3), step(3), xi(3)
    integer :: i, j, m
    logical :: is_right
    call make_element(name, element)
    m = element%nodes
    do i = 1, m
      call element%shape(place(:, i), n(:m), dn(:m, :))
      n(i) = n(i) - one
      call check_close(maxval(abs(n(:m))), zero, 1.0e-15_wp, name//': one at its node')
    end do
    xi = [0.2_wp, 0.3_wp, 0.1_wp]
    call element%shape(xi, n(:m), dn(:m, :))
    do j = 1, 3
      step = zero
      step(j) = 0.125_wp
      call element%shape(xi + step, up(:m), none(:m, :))
      call element%shape(xi - step, down(:m), none(:m, :))
      call check_close(maxval(abs(4.0_wp*(up(:m) - down(:m)) - dn(:m, j))), zero, 1.0e-14_wp, &
          name//': derivatives')
    end do
    is_right = .true.
    do i = 1, element%facets()
      associate (face => element%face(:, 1 + (i - 1)/4), facet => element%facet_nodes(i))
        is_right = is_right .and. all([(any(face == facet(j)), j=1, size(facet))])
      end associate
    end do
    call check_true(is_right, name//': four facets of the nodes of each face')
  end subroutine test_places

  !> All monomials to degree 5 over the tetrahedron: i! j! k!/(i + j + k + 3)!.
  subroutine test_rule()
    real(wp) :: xi(3, most_points), w(most_points), worst
    integer :: i, j, k, points
    call make_element('TET10', element)
    call element%mass_rule([gauss, gauss, gauss], points, xi, w)
    worst = zero
    do k = 0, 5
      do j = 0, 5 - k
        do i = 0, 5 - k - j
          associate (exact => gamma(i + one)*gamma(j + one)*gamma(k + one) &
              /gamma(i + j + k + 4.0_wp))
            worst = max(worst, abs(sum(w(:points)*xi(1, :points)**i*xi(2, :points)**j &
                *xi(3, :points)**k) - exact)/exact)
          end associate
        end do
      end do
    end do
    call check_close(worst, zero, 1.0e-14_wp, 'the rule of TET10 is exact to degree 5')
    call check_true(all(w(:points) > zero), 'its weights are positive')
  end subroutine test_rule

  !> Straight tetrahedron: 1/36 of the mass at corners, 4/27 on edges; box: 1, 4, 16, 64/216.
  subroutine test_lumped()
    real(wp) :: mass(27)
    call make_element('TET10', element)
    mass(:10) = 6.0_wp*element%lumped_mass(tet10_places(), one, one)
    call check_close(maxval(abs(mass(:4) - one/36.0_wp)), zero, 1.0e-15_wp, &
        'TET10: corners')
    call check_close(maxval(abs(mass(5:10) - 4.0_wp/27.0_wp)), zero, 1.0e-15_wp, &
        'TET10: edges')
    call make_element('HEX27', element)
    mass = 27.0_wp*element%lumped_mass(hex27_places(), one, one)
    call check_close(maxval(abs(mass(:8) - one)), zero, 1.0e-14_wp, 'HEX27: corners')
    call check_close(maxval(abs(mass(9:20) - 4.0_wp)), zero, 1.0e-14_wp, 'HEX27: edges')
    call check_close(maxval(abs(mass(21:26) - 16.0_wp)), zero, 1.0e-13_wp, 'HEX27: faces')
    call check_close(mass(27), 64.0_wp, 1.0e-13_wp, 'HEX27: centre', one)
  end subroutine test_lumped

  !> PR .4999: modes of a cube whose stiffness goes with the bulk modulus, 5000 shear moduli.
  !> One is the change of volume, each further one locks. Full: dilatations 1, xi, xi eta and
  !> their likes are seven; means: the first alone; incompatible modes have dilatations xi,
  !> which frees three, and none xi eta.
  subroutine test_stiff_modes(name, expected)
    character(*), intent(in) :: name
    integer, intent(in) :: expected
    class(material_t), allocatable :: rubber
    real(wp) :: ke(24, 24), value(24)
    call make_material('MAT_ELASTIC', 1, [one, one, 0.4999_wp], rubber)
    call make_element(name, element)
    call element%stiffness(corner, rubber%moduli(in_space), one, ke)
    call all_eigenvalues(ke, value)
    call check_equal(count(value > 50.0_wp), expected, name//': stiff modes')
  end subroutine test_stiff_modes

  !> A bar of 10 x 1 x 1 in pure bending: tip over that of the beam, L^2/(E h).
  subroutine test_bending(name, expected)
    character(*), intent(in) :: name
    real(wp), intent(in) :: expected(:)
    integer, parameter :: counts(3, 4) = reshape([10, 1, 1, 5, 1, 1, 10, 2, 2, 10, 1, 1], &
        [3, 4])
    real(wp) :: tip
    integer :: i
    call make_element(name, element)
    do i = 1, size(expected)
      call make_material('MAT_ELASTIC', 1, [one, one, merge(0.499_wp, 0.3_wp, i == 4)], &
          material)
      call bend(counts(:, i), tip)
      print '(a, 3i4, f8.4)', element%name, counts(:, i), tip/100.0_wp
      call check_close(tip/100.0_wp, expected(i), 1.0e-3_wp, name//': bending')
    end do
  end subroutine test_bending

  !> Mean deflection of its end. Hexahedra on a grid of nodes (x fastest): the root has u_x = 0,
  !> and u_y = 0, u_z = 0 on its middle lines, or y = 0, z = 0 where no node is in the middle.
  subroutine bend(n, tip)
    integer, intent(in) :: n(3)
    real(wp), intent(out) :: tip
    real(wp), allocatable :: k(:, :), f(:, :)
    real(wp) :: place(3, element%nodes), x(3, element%nodes), ke(size(x), size(x)), size_of(3)
    integer :: grid(3), node(element%nodes), dof(size(x)), m(3), a, b, c, e, p
    integer, allocatable :: pivot(:)
    logical :: is_solved
    p = merge(2, 1, element%nodes == 27)
    place = half*p*(corner_places() + one)
    grid = p*n + 1
    size_of = [10.0_wp, one, one]/(p*n)
    a = 3*product(grid)
    allocate (k(a, a), f(a, 1), pivot(a))
    k = zero
    f = zero
    do e = 0, product(n) - 1
      m = p*[mod(e, n(1)), mod(e/n(1), n(2)), e/(n(1)*n(2))]
      do a = 1, element%nodes
        x(:, a) = size_of*(m + nint(place(:, a)))
        c = 1 + (m(1) + nint(place(1, a))) + grid(1)*((m(2) + nint(place(2, a))) &
            + grid(2)*(m(3) + nint(place(3, a))))
        node(a) = c
        dof(3*a - 2:3*a) = [3*c - 2, 3*c - 1, 3*c]
      end do
      call element%stiffness(x, material%moduli(in_space), one, ke)
      k(dof, dof) = k(dof, dof) + ke
      if (m(1) == p*(n(1) - 1)) call add_end_load(x, node, f(:, 1))
    end do
    do c = 1, product(grid)
      m = [mod(c - 1, grid(1)), mod((c - 1)/grid(1), grid(2)), (c - 1)/(grid(1)*grid(2))]
      do b = 1, 3
        if (m(1) > 0 .or. b > 1 .and. m(b) /= (grid(b) - 1)/2) cycle
        k(3*c - 3 + b, :) = zero
        k(:, 3*c - 3 + b) = zero
        k(3*c - 3 + b, 3*c - 3 + b) = one
      end do
    end do
    call solve_general(size(f), k, f, pivot, is_solved)
    call check_true(is_solved, 'the bar is held')
    tip = sum([(f(3*c, 1), c=grid(1), product(grid), grid(1))])/(grid(2)*grid(3))
    tip = abs(tip)
  end subroutine bend

  !> Parametric places of the element's nodes.
  function corner_places() result(place)
    real(wp) :: place(3, element%nodes)
    if (element%nodes == 8) place = corner
    if (element%nodes == 27) place = hex27_places()
  end function corner_places

  !> Traction 2 z - 1 along x on the face xi = 1 of a box, by 2 x 2 points.
  subroutine add_end_load(x, node, f)
    real(wp), intent(in) :: x(:, :)
    integer, intent(in) :: node(:)
    real(wp), intent(inout) :: f(:)
    real(wp) :: n(size(node)), dn(size(node), 3), area
    integer :: i, j
    area = 0.25_wp*(maxval(x(2, :)) - minval(x(2, :)))*(maxval(x(3, :)) - minval(x(3, :)))
    do i = -1, 1, 2
      do j = -1, 1, 2
        call element%shape([one, i*gauss, j*gauss], n, dn)
        f(3*node - 2) = f(3*node - 2) + area*n*(2.0_wp*dot_product(n, x(3, :)) - one)
      end do
    end do
  end subroutine add_end_load

end program test_space
