! SPDX-License-Identifier: BSD-3-Clause
!> Bending modes: their split from the mean gradient, what they cost in elements, what bending
!> costs a body.
program test_bending
  use assembly_bending, only: bending_t, make_bending, look_at_bending, locks
  use assembly_system, only: system_t
  use base_kinds, only: wp, zero, one, half
  use check, only: test_start, test_end, check_true, check_close, check_equal, seed_random
  use element_base, only: element_t
  use element_bending, only: mode_amplitude, quad_mode_energy, pair_mode_energy, &
      bending_energy
  use element_registry, only: make_element
  use material_base, only: material_t, plane_stress, plane_strain
  use material_registry, only: make_material
  use model_data, only: model_t
  implicit none
  real(wp), parameter :: thickness = 0.7_wp, young = 200.0_wp
  real(wp), parameter :: sign(4) = [one, -one, one, -one]
  class(element_t), allocatable :: quad, triangle
  class(material_t), allocatable :: material
  real(wp) :: poisson, d(3, 3), bar
  integer :: plane, trial

  call test_start('bending')
  call seed_random(1203)
  call make_element('QUAD4', quad)
  call make_element('TRI3', triangle)
  do trial = 1, 200
    call random_number(poisson)
    poisson = 0.49_wp*poisson
    call make_material('MAT_ELASTIC', 1, [one, young, poisson], material)
    do plane = plane_stress, plane_strain
      d = material%moduli(plane)*thickness
      bar = young*thickness
      if (plane == plane_strain) bar = bar/(one - poisson**2)
      call test_rectangle()
      call test_body()
      call test_split()
      call test_pair()
    end do
  end do
  call test_pairs()
  call test_end()

contains

  !> In a rectangle of half sides a along the bent fibres and b across, a quadrilateral costs
  !> 1/(1 - nu^2) + (a/b)^2/(2(1 + nu)) times bending in plane stress, (1 - nu)^2/(1 - 2 nu) +
  !> (1 - nu)/2 (a/b)^2 times in plane strain.
  subroutine test_rectangle()
    real(wp) :: a, b, x(2, 4), cost
    a = random(0.1_wp, 3.0_wp)
    b = random(0.1_wp, 3.0_wp)
    x = reshape([-a, -b, a, -b, a, b, -a, b], [2, 4])
    cost = quad_mode_energy(relative_stiffness(x), [one, zero]) &
        /bending_energy(x, [one, zero], bar)
    if (plane == plane_stress) then
      call check_close(cost, one/(one - poisson**2) + (a/b)**2/(2.0_wp*(one + poisson)), &
          1.0e-12_wp, 'cost in a rectangle, plane stress', cost)
    else
      call check_close(cost, (one - poisson)**2/(one - 2.0_wp*poisson) &
          + half*(one - poisson)*(a/b)**2, 1.0e-12_wp, 'cost in a rectangle, plane strain', &
          cost)
    end if
  end subroutine test_rectangle

  !> A body that bends along both pairs of sides of a parallelogram: displacements -k X Y,
  !> k (X^2 + r Y^2)/2 in the axes of each pair, r the contraction of a bar, stress -E' k Y
  !> alone. Its energy beside that of the mean strain is E' k^2 <(Y - Y0)^2>/2 for each; the
  !> four corners give it. No amplitude costs an element less.
  subroutine test_body()
    real(wp) :: g(2, 2), x(2, 4), u(2, 4), h(2), energy, area, k, across
    integer :: pair, i
    x = parallelogram(g)
    area = 4.0_wp*(g(1, 1)*g(2, 2) - g(2, 1)*g(1, 2))
    u = zero
    energy = zero
    do pair = 1, 2
      k = random(-one, one)
      associate (e => g(:, pair)/norm2(g(:, pair)))
        do i = 1, 4
          u(:, i) = u(:, i) + bent(e, x(:, i), k)
        end do
        across = e(1)*g(2, 3 - pair) - e(2)*g(1, 3 - pair)
      end associate
      energy = energy + half*bar*area*(k*across)**2/3.0_wp
    end do
    h = mode_amplitude(x, u)
    call check_close(bending_energy(x, h, bar), energy, 1.0e-11_wp, 'energy of bending', energy)
    h = [random(-one, one), random(-one, one)]
    call check_true(bending_energy(x, h, bar) <= quad_mode_energy(relative_stiffness(x), h) &
        *(one + 1.0e-12_wp), 'a quadrilateral costs no less than bending')
    call check_true(bending_energy(x, h, bar) <= pair_mode_energy(x, h, d(1, 1), d(3, 3)) &
        *(one + 1.0e-12_wp), 'a pair of triangles costs no less than bending')
  end subroutine test_body

  !> Displacement at x of a body bent by k along the unit vector e.
  function bent(e, x, k) result(u)
    real(wp), intent(in) :: e(2), x(2), k
    real(wp) :: u(2), p, q, contraction
    contraction = d(1, 2)/d(1, 1)
    p = e(1)*x(1) + e(2)*x(2)
    q = e(1)*x(2) - e(2)*x(1)
    u = -k*p*q*e + half*k*(p**2 + contraction*q**2)*[-e(2), e(1)]
  end function bent

  !> Any quadrilateral: a linear displacement, turned too, has no amplitude; the energy of any
  !> displacement is that of the modes and of the rest.
  subroutine test_split()
    real(wp) :: x(2, 4), u(2, 4), ke(8, 8), h(2), total
    x = distorted()
    u = matmul(reshape(random_numbers(4), [2, 2]), x) + spread(random_numbers(2), 2, 4)
    call check_close(norm2(mode_amplitude(x, u)), zero, 1.0e-14_wp, 'linear', norm2(u))
    u = reshape(random_numbers(8), [2, 4])
    h = mode_amplitude(x, u)
    call quad%stiffness(x, d, one, ke)
    total = energy_of(ke, u)
    call check_close(energy_of(ke, u - spread(h, 2, 4)*spread(sign, 1, 2)) &
        + quad_mode_energy(ke(3:8, 3:8), h), total, 1.0e-13_wp, 'split of a quadrilateral', &
        total)
  end subroutine test_split

  !> The same for two triangles.
  subroutine test_pair()
    real(wp) :: x(2, 4), u(2, 4), h(2), total
    x = distorted()
    u = reshape(random_numbers(8), [2, 4])
    h = mode_amplitude(x, u)
    total = energy_of_pair(x, u)
    call check_close(energy_of_pair(x, u - spread(h, 2, 4)*spread(sign, 1, 2)) &
        + pair_mode_energy(x, h, d(1, 1), d(3, 3)), total, 1.0e-13_wp, 'split of a pair', total)
  end subroutine test_pair

  !> Three triangles of a part: the first two share the longest edge of both, the third has one
  !> edge with the second alone and counts by half there; a triangle of another part has none.
  subroutine test_pairs()
    type(model_t) :: model
    type(system_t) :: none
    type(bending_t) :: bending
    real(wp) :: u(2, 6), energy
    integer :: k
    model%nodes = 6
    model%x = reshape([0.0_wp, 0.0_wp, 4.0_wp, 0.0_wp, 0.0_wp, 3.0_wp, 4.0_wp, 3.0_wp, 3.0_wp, &
        5.0_wp, 7.0_wp, 1.0_wp], [2, 6])
    call model%mesh%start(4, 12)
    call model%mesh%add('TRI3', 1, 1, 0, [1, 2, 3])
    call model%mesh%add('TRI3', 2, 1, 0, [3, 2, 4])
    call model%mesh%add('TRI3', 3, 1, 0, [3, 4, 5])
    call model%mesh%add('TRI3', 4, 2, 0, [2, 6, 4])
    call model%mesh%make_blocks()
    allocate (model%part(2), model%material(1))
    allocate (model%material(1)%item, source=material)
    do k = 1, 2
      model%part(k)%material = 1
      model%part(k)%plane = plane_strain
      model%part(k)%thickness = thickness
    end do
    call make_bending(model, bending)
    call check_equal(size(bending%pair), 2, 'pairs of triangles')
    call check_true(all(bending%pair(1)%node == [1, 2, 4, 3]), 'the pair of two triangles')
    call check_true(all(bending%pair(2)%node == [5, 3, 2, 4]), 'the pair of one alone')
    u = reshape(random_numbers(12), [2, 6])
    do k = 1, 3
      call look_at_bending(model, none, u, [3.0_wp, 1.0_wp], 10*k, bending)
    end do
    energy = zero
    do k = 1, 2
      associate (node => bending%pair(k)%node)
        energy = energy + mode_of(model%x(:, node), u(:, node))/k
      end associate
    end do
    call check_close(bending%sum(1)%modes, 3.0_wp*energy, 1.0e-14_wp, 'their energy', energy)
    call check_close(bending%sum(1)%strain, 9.0_wp, 1.0e-14_wp, 'all strain energy')
    call check_close(bending%sum(2)%modes, zero, zero, 'a triangle alone')
    call check_equal(bending%step(1), 10, 'the first of equal looks')
    call check_true(.not. locks(bending, 2, zero), 'no pair, no locking')
    call check_true(.not. locks(bending, 1, 3.1_wp), 'too little energy')
  end subroutine test_pairs

  real(wp) function mode_of(x, u)
    real(wp), intent(in) :: x(2, 4), u(2, 4)
    mode_of = pair_mode_energy(x, mode_amplitude(x, u), d(1, 1), d(3, 3))
  end function mode_of

  real(wp) function energy_of_pair(x, u)
    real(wp), intent(in) :: x(2, 4), u(2, 4)
    integer, parameter :: corner(3, 2) = reshape([1, 2, 4, 3, 4, 2], [3, 2])
    real(wp) :: ke(6, 6)
    integer :: k
    energy_of_pair = zero
    do k = 1, 2
      call triangle%stiffness(x(:, corner(:, k)), d, one, ke)
      energy_of_pair = energy_of_pair + energy_of(ke, u(:, corner(:, k)))
    end do
  end function energy_of_pair

  real(wp) function energy_of(ke, u)
    real(wp), intent(in) :: ke(:, :), u(:, :)
    real(wp) :: v(size(u))
    v = reshape(u, [size(u)])
    energy_of = half*dot_product(v, matmul(ke, v))
  end function energy_of

  function relative_stiffness(x) result(k)
    real(wp), intent(in) :: x(2, 4)
    real(wp) :: k(6, 6), ke(8, 8)
    call quad%stiffness(x, d, one, ke)
    k = ke(3:8, 3:8)
  end function relative_stiffness

  !> Corners of a parallelogram anywhere with half sides g.
  function parallelogram(g) result(x)
    real(wp), intent(out) :: g(2, 2)
    real(wp) :: x(2, 4)
    do
      g = reshape(random_numbers(4), [2, 2])
      if (g(1, 1)*g(2, 2) - g(2, 1)*g(1, 2) > 0.1_wp*norm2(g(:, 1))*norm2(g(:, 2))) exit
    end do
    x(:, 1) = -g(:, 1) - g(:, 2)
    x(:, 2) = g(:, 1) - g(:, 2)
    x(:, 3:4) = -x(:, 1:2)
    x = x + spread(random_numbers(2), 2, 4)
  end function parallelogram

  !> A square whose corners are moved by up to a third of half its side.
  function distorted() result(x)
    real(wp) :: x(2, 4)
    x = reshape([-one, -one, one, -one, one, one, -one, one], [2, 4]) &
        + reshape(random_numbers(8), [2, 4])/3.0_wp
  end function distorted

  !> n numbers between -1 and 1.
  function random_numbers(n) result(numbers)
    integer, intent(in) :: n
    real(wp) :: numbers(n)
    call random_number(numbers)
    numbers = 2.0_wp*numbers - one
  end function random_numbers

  real(wp) function random(low, high)
    real(wp), intent(in) :: low, high
    call random_number(random)
    random = low + (high - low)*random
  end function random

end program test_bending
