! SPDX-License-Identifier: BSD-3-Clause
!> Laws at finite strain in bars, in the plane and around an axis: against closed forms and
!> against the same laws in space.
program test_laws_plane
  use base_kinds, only: wp, zero, one, two, half
  use check, only: test_start, test_end, check_true, check_close, seed_random
  use law_cases, only: case_t, qp, shear, young, poisson, yield, tangent, make_cases, &
      random_strain, bulk_modulus, ogden_mu, ogden_alpha
  use law_differences, only: derivative_of_energy, derivative_of_stress, flowed
  use material_base, only: in_space, plane_strain, plane_stress, axisymmetric, has_value
  use material_plane, only: respond_as
  use material_registry, only: make_material
  use material_tensor, only: log_one_plus, exp_minus_one, log_excess, exp_excess, spectrum
  implicit none
  integer, parameter :: in_plane(3) = [1, 2, 4]
  type(case_t), allocatable :: cases(:)
  logical :: shown
  integer :: k

  call test_start('laws_plane')
  call seed_random(1965)
  call get_environment_variable('SHOW', status=k)
  shown = k == 0
  call make_cases(cases)
  do k = 1, size(cases)
    call test_bar(cases(k))
    call test_plane_stress(cases(k))
    call test_small_plane_stress(cases(k))
    call test_same_as_space(cases(k))
  end do
  call test_reversed_bar()
  call test_points()
  call test_functions()
  call test_spectrum()
  call test_end()

contains

  !> A figure beside its bound, where asked for.
  subroutine judge(error, bound, what)
    real(wp), intent(in) :: error, bound
    character(*), intent(in) :: what
    if (shown) print '(2x, a, t56, es9.2, a, es8.1)', what, error, '  allowed', bound
    call check_close(error, zero, bound, what)
  end subroutine judge

  !> A bar of a given stretch, its sides free: nominal stress and lateral stretch.
  subroutine test_bar(case)
    type(case_t), intent(in) :: case
    real(wp), parameter :: stretches(7) = [0.7_wp, 0.95_wp, 0.999_wp, 1.001_wp, 1.1_wp, &
        1.6_wp, two]
    real(wp) :: l, side, nominal, e(6), s(6), d(6, 6), w, error(2)
    real(wp) :: old(case%law%states), new(case%law%states)
    integer :: i
    if (case%name == 'piecewise') return
    old = zero
    error = zero
    do i = 1, size(stretches)
      l = stretches(i)
      call closed_bar(case, l, side, nominal)
      e = [half*(l**2 - one), half*(side**2 - one), half*(side**2 - one), zero, zero, zero]
      call case%law%respond(e, old, .false., s, d, w, new)
      error(1) = max(error(1), abs(l*s(1) - nominal)/abs(nominal))
      error(2) = max(error(2), abs(s(2))/shear)
    end do
    call judge(error(1), 1.0e-10_wp, 'stress in a bar of '//case%name)
    call judge(error(2), 1.0e-11_wp, 'stress at its sides')
  end subroutine test_bar

  !> Its side stretch and nominal stress: in closed form, or by the scalar equation of its
  !> sides.
  subroutine closed_bar(case, l, side, nominal)
    type(case_t), intent(in) :: case
    real(wp), intent(in) :: l
    real(wp), intent(out) :: side, nominal
    real(wp) :: h, tau, low, high, stress(2)
    integer :: i
    select case (case%name)
    case ('elastic')
      nominal = half*young*(l**3 - l)
      side = sqrt(one - poisson*(l**2 - one))
    case ('hencky')
      side = l**(-poisson)
      nominal = young*log(l)/l
    case ('rubber')
      side = l**(-0.463_wp)
      nominal = shear*(l - l**(-1.926_wp))
    case ('foam')
      side = l**(-0.25_wp)
      nominal = shear*(l**(-half) - l**(-3))
    case default
      if (case%is_plastic) then
        h = young*tangent/(young - tangent)
        tau = (sign(yield, l - one) + h*log(l))/(one + h/young)
        if (abs(log(l)) < yield/young) tau = young*log(l)
        side = exp(half*((one - two*poisson)*tau/young - log(l)))
        nominal = tau/l
        return
      end if
      low = 0.3_wp
      high = 2.5_wp
      do i = 1, 60
        side = half*(low + high)
        stress = principal_forces(case, l, side)
        if (stress(2) > zero) then
          high = side
        else
          low = side
        end if
      end do
      nominal = stress(1)
    end select
  end subroutine closed_bar

  !> dW/dl, dW/dside/2 of a law for stretches l, side, side.
  pure function principal_forces(case, l, side) result(p)
    type(case_t), intent(in) :: case
    real(wp), intent(in) :: l, side
    real(wp) :: p(2), i1, i3, j, a, b, c, f, x(2), q(2), nu
    integer :: m
    i1 = l**2 + two*side**2
    i3 = l**2*side**4
    j = l*side**2
    x = [l, side]
    nu = case%nu
    if (case%name(:6) == 'mooney') then
      a = case%constants(2)
      b = case%constants(3)
      c = half*a + b
      f = (a*(5.0_wp*nu - two) + b*(11.0_wp*nu - 5.0_wp))/(two*(one - two*nu))
      p = two*(a*x + b*(i1*x - x**3) + (two*f*(i3 - one)*i3 - two*c/i3**2)/x)
    else if (case%name == 'neo-hooke') then
      p = shear*j**(-two/3.0_wp)*(x - i1/3.0_wp/x) &
          + bulk_modulus(shear, nu)*(j - one)*j/x
    else
      p = bulk_modulus(shear, nu)*(j - one)
      do m = 1, size(ogden_mu)
        q = (x/j**(one/3.0_wp))**ogden_alpha(m)
        p = p + ogden_mu(m)*(q - (q(1) + two*q(2))/3.0_wp)
      end do
      p = p/x
    end if
  end function principal_forces

  !> Pulled until it flows, then pressed: a bar hardens by its plastic strain where hardening is
  !> isotropic and yields early where it is kinematic.
  subroutine test_reversed_bar()
    real(wp), parameter :: betas(3) = [one, 0.3_wp, zero], strains(2) = [0.1_wp, -0.06_wp]
    real(wp) :: h, tau, plastic, beta, s(6), e(6), d(6, 6), w, error, strain
    real(wp), allocatable :: old(:), new(:)
    integer :: k, step
    error = zero
    h = young*tangent/(young - tangent)
    do k = 1, 3
      beta = betas(k)
      associate (law => cases(8 + k)%law)
        allocate (old(law%states), new(law%states))
        old = zero
        plastic = zero
        do step = 1, 2
          strain = strains(step)
          tau = (yield + h*strain)/(one + h/young)
          if (step == 2) tau = ((one - beta)*h*strain - yield &
              - beta*h*(two*plastic - strain))/(one + h/young)
          plastic = strain - tau/young
          e(1) = strain
          e(2:3) = half*((one - two*poisson)*tau/young - strain)
          e(:3) = half*(exp(two*e(:3)) - one)
          e(4:) = zero
          call law%respond(e, old, .false., s, d, w, new)
          old = new
          error = max(error, abs(s(1)*(one + two*e(1)) - tau)/yield, abs(s(2))/yield, &
              abs(new(1) - plastic))
        end do
        deallocate (old, new)
      end associate
    end do
    call judge(error, 1.0e-12_wp, 'bar pulled and pressed')
  end subroutine test_reversed_bar

  !> The yield stress follows its points, and the last line beyond them, in one step across
  !> several of them; one point alone is ideal plasticity.
  subroutine test_points()
    real(wp), parameter :: taus(4) = [50.0_wp, 70.0_wp, 85.0_wp, 92.0_wp]
    real(wp), parameter :: plastic(4) = [0.01_wp, 0.06_wp, 0.3_wp, 0.58_wp]
    real(wp) :: e(6), s(6), d(6, 6), w, old(7), new(7), error
    integer :: i
    error = zero
    old = zero
    do i = 1, 4
      e(1) = plastic(i) + taus(i)/young
      e(2:3) = half*((one - two*poisson)*taus(i)/young - e(1))
      e(:3) = half*(exp(two*e(:3)) - one)
      e(4:) = zero
      call cases(12)%law%respond(e, old, .false., s, d, w, new)
      error = max(error, abs(s(1)*(one + two*e(1)) - taus(i))/yield, abs(new(7) - plastic(i)))
    end do
    call judge(error, 1.0e-12_wp, 'yield stress by points')
  end subroutine test_points

  !> S33 = 0; stresses are derivatives of the energy, moduli those of the stresses.
  subroutine test_plane_stress(case)
    type(case_t), intent(in) :: case
    real(wp) :: e(3), s(3), d(3, 3), w, worst(4), all_e(6), all_s(6), space_d(6, 6), space_w
    real(wp) :: whole(6)
    real(wp), dimension(case%law%states) :: old, new, space_new
    integer :: trial
    worst = zero
    do trial = 1, 37
      whole = random_strain(0.3_wp)
      e = whole(in_plane)
      old = zero
      if (case%is_plastic) old = flowed(case%law, [0.05_wp, -0.04_wp, zero, 0.03_wp, zero, &
          zero])
      call respond_as(case%law, plane_stress, e, old, .true., s, d, w, new, all_e, all_s)
      worst(1) = max(worst(1), abs(all_s(3))/shear)
      worst(2) = max(worst(2), maxval(abs(d - derivative_of_stress(case%law, e, old, &
          plane_stress)))/maxval(abs(d)))
      call case%law%respond(all_e, old, .false., all_s, space_d, space_w, space_new)
      worst(3) = max(worst(3), maxval(abs(all_s(in_plane) - s))/maxval(abs(s)), &
          abs(space_w - w)/w)
      if (case%is_plastic) then
        old = zero
        e = 1.0e-3_wp*e
        call respond_as(case%law, plane_stress, e, old, .false., s, d, w, new)
      end if
      worst(4) = max(worst(4), maxval(abs(s - derivative_of_energy(case%law, e, old, &
          plane_stress)))/maxval(abs(s)))
    end do
    call judge(worst(1), 1.0e-12_wp, 'S33 in plane stress, '//case%name)
    call judge(worst(2), 5.0e-7_wp, 'D in plane stress, '//case%name)
    call judge(worst(3), 1.0e-12_wp, 'plane stress in space, '//case%name)
    call judge(worst(4), 5.0e-7_wp, 'S in plane stress, '//case%name)
    call respond_as(case%law, plane_stress, [-0.6_wp, zero, zero], old, .true., s, d, w, new)
    if (.not. case%law%is_quadratic) call check_true(.not. has_value(w), &
        'no value in plane stress, '//case%name)
  end subroutine test_plane_stress

  !> Small strains in plane stress: the linear law, to the strain itself; none gives nothing.
  subroutine test_small_plane_stress(case)
    type(case_t), intent(in) :: case
    real(wp), parameter :: small = 1.0e-9_wp
    real(wp) :: e(3), s(3), d(3, 3), w, linear(3, 3), error
    real(wp) :: old(case%law%states), new(case%law%states)
    old = zero
    e = zero
    call respond_as(case%law, plane_stress, e, old, .true., s, d, w, new)
    call check_true(.not. max(maxval(abs(s)), abs(w)) > zero, &
        'nothing at rest in plane stress, '//case%name)
    linear = case%law%moduli(plane_stress)
    call judge(maxval(abs(d - linear))/maxval(abs(linear)), 1.0e-13_wp, &
        'moduli in plane stress, '//case%name)
    e = small*[one, -0.4_wp, 0.7_wp]
    call respond_as(case%law, plane_stress, e, old, .false., s, d, w, new)
    error = max(maxval(abs(s - matmul(linear, e)))/maxval(abs(s)), &
        abs(w/(half*dot_product(e, matmul(linear, e))) - one))
    call judge(error, 100.0_wp*small, 'small strain in plane stress, '//case%name)
  end subroutine test_small_plane_stress

  !> Plane strain and the strains around an axis are those of space with zeros, to the last bit.
  subroutine test_same_as_space(case)
    type(case_t), intent(in) :: case
    integer, parameter :: around(4) = [1, 2, 4, 3]
    real(wp) :: e(6), s(6), d(6, 6), w, s4(4), d4(4, 4), w4, all_e(6), all_s(6)
    real(wp), dimension(case%law%states) :: old, new, new4
    integer :: form, n
    do form = plane_strain, axisymmetric, axisymmetric - plane_strain
      n = merge(4, 3, form == axisymmetric)
      e = random_strain(0.35_wp)
      e(5:) = zero
      if (n == 3) e(3) = zero
      old = zero
      call respond_as(case%law, in_space, e, old, .true., s, d, w, new)
      call respond_as(case%law, form, e(around(:n)), old, .true., s4(:n), d4(:n, :n), w4, &
          new4, all_e, all_s)
      call check_true(all(abs(s(around(:n)) - s4(:n)) <= zero) .and. abs(w - w4) <= zero &
          .and. all(abs(new - new4) <= zero) .and. all(abs(all_e - e) <= zero) &
          .and. all(abs(all_s - s) <= zero), 'the same as in space, '//case%name)
      call check_true(all(abs(d(around(:n), around(:n)) - d4(:n, :n)) <= zero), &
          'its moduli, '//case%name)
    end do
  end subroutine test_same_as_space

  !> Functions of small numbers against 33 digits, of which 1e-9 leaves 16.
  subroutine test_functions()
    real(qp) :: x
    real(wp) :: y, error(4)
    integer :: trial
    error = zero
    do trial = 1, 20000
      call random_number(y)
      y = (two*y - one)*10.0_wp**(-mod(trial, 9))*0.95_wp
      if (abs(y) < 1.0e-9_wp) cycle
      x = y
      error(1) = max(error(1), real(abs(log_one_plus(y)/log(1 + x) - 1), wp))
      error(2) = max(error(2), real(abs(exp_minus_one(y)/(exp(x) - 1) - 1), wp))
      error(3) = max(error(3), real(abs(log_excess(y)/(x - log(1 + x)) - 1), wp))
      error(4) = max(error(4), real(abs(exp_excess(y)/(exp(x) - 1 - x) - 1), wp))
    end do
    call judge(error(1), 1.0e-15_wp, 'ln(1 + x)')
    call judge(error(2), 1.0e-15_wp, 'exp(x) - 1')
    call judge(error(3), 4.0e-15_wp, 'x - ln(1 + x)')
    call judge(error(4), 4.0e-15_wp, 'exp(x) - 1 - x')
  end subroutine test_functions

  !> A tensor is its eigenvalues and axes again, the axes are at right angles.
  subroutine test_spectrum()
    real(wp) :: a(3, 3), value(3), axis(3, 3), error(2)
    integer :: trial, i
    error = zero
    do trial = 1, 1000
      call random_number(a)
      a = a - half
      a = a + transpose(a)
      if (mod(trial, 3) == 0) a = matmul(a, a)*1.0e-8_wp
      if (mod(trial, 5) == 0) then
        a(1, 2:) = 1.0e-9_wp*a(1, 2:)
        a(2:, 1) = a(1, 2:)
      end if
      if (mod(trial, 7) == 0) a = a - a
      call spectrum([a(1, 1), a(2, 2), a(3, 3), a(1, 2), a(2, 3), a(3, 1)], value, axis)
      error(1) = max(error(1), maxval(abs(matmul(transpose(axis), axis) &
          - reshape([one, zero, zero, zero, one, zero, zero, zero, one], [3, 3]))))
      if (.not. maxval(abs(a)) > zero) cycle
      error(2) = max(error(2), maxval(abs(matmul(axis, matmul(reshape([(value(i), zero, zero, &
          zero, i=1, 3)], [3, 3]), transpose(axis))) - a))/maxval(abs(a)))
    end do
    call judge(error(1), 4.0e-15_wp, 'axes at right angles')
    call judge(error(2), 4.0e-15_wp, 'a tensor from its eigenvalues')
  end subroutine test_spectrum

end program test_laws_plane
