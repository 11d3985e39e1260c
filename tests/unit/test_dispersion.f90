! SPDX-License-Identifier: BSD-3-Clause
!> Plane waves on an infinite grid of cubes, mid-point rule: errors of the phase speed, with the
!> symbols of stiffness and mass summed from one element.
program test_dispersion
  use base_kinds, only: wp, zero, one, half
  use check, only: test_start, test_end, check_true, check_close
  use eigenvalues, only: all_eigenvalues
  use element_base, only: element_t, gauss
  use element_dispersion, only: tuned_points
  use element_hex8, only: corner
  use element_registry, only: make_element
  use material_base, only: material_t, in_space
  use material_registry, only: make_material
  implicit none
  real(wp), parameter :: pi = acos(-one), courant(3) = [0.1_wp, half, one]
  !> Errors of P, S in % at these Courant numbers. The full form: means over the sphere of
  !> symbols in closed form, products of one-dimensional ones, by a separate program;
  !> incompatible modes: as found here once.
  real(wp), parameter :: consistent(2, 3) = reshape([1.304_wp, 2.177_wp, 0.558_wp, 1.817_wp, &
      3.686_wp, 0.805_wp], [2, 3])
  real(wp), parameter :: lumped(2, 3) = reshape([3.930_wp, 3.059_wp, 4.993_wp, 3.374_wp, &
      8.075_wp, 4.337_wp], [2, 3])
  real(wp), parameter :: tuned(2, 3) = reshape([1.486_wp, 0.726_wp, 1.454_wp, 0.686_wp, &
      1.384_wp, 3.308_wp], [2, 3])
  real(wp), parameter :: modes(2, 3) = reshape([1.740_wp, 1.027_wp, 1.702_wp, 0.484_wp, &
      1.614_wp, 2.873_wp], [2, 3])
  class(material_t), allocatable :: material
  class(element_t), allocatable :: element
  real(wp) :: x(3, 8)

  call test_start('dispersion')
  x = half*corner
  call make_material('MAT_ELASTIC', 1, [one, one, 0.3_wp], material)
  call test_table('HEX8', 'CONSISTENT', consistent)
  call test_table('HEX8', 'LUMPED', lumped)
  call test_table('HEX8', 'DISPERSION', tuned)
  call test_table('HEX8MODE', 'DISPERSION', modes)
  call test_exact()
  call test_end()

contains

  subroutine test_table(name, mass, expected)
    character(*), intent(in) :: name, mass
    real(wp), intent(in) :: expected(:, :)
    real(wp) :: error(2)
    integer :: k
    call make_element(name, element)
    do k = 1, 3
      error = 100.0_wp*mean_errors(mass, courant(k))
      print '(a, 1x, a, f5.1, 2f8.3)', name, mass, courant(k), error
      ! Half a digit, and what 40 x 40 directions leave.
      call check_close(maxval(abs(error - expected(:, k))), zero, 0.002_wp, name//' '//mass)
    end do
  end subroutine test_table

  !> Root of the mean squares over the directions of an eighth of the sphere, P and S, 8
  !> elements a wave length.
  function mean_errors(mass, nu) result(error)
    character(*), intent(in) :: mass
    real(wp), intent(in) :: nu
    real(wp) :: error(2), at(3), height, angle
    integer, parameter :: rings = 40
    integer :: i, j
    error = zero
    do i = 1, rings
      height = (i - half)/rings
      do j = 1, rings
        angle = half*pi*(j - half)/rings
        at = errors(mass, nu, pi/4.0_wp* &
            [sqrt(one - height**2)*[cos(angle), sin(angle)], height])
        error = error + [at(1)**2, half*(at(2)**2 + at(3)**2)]/rings**2
      end do
    end do
    error = sqrt(error)
  end function mean_errors

  !> Errors of the phase speeds of the three waves of wave vector k, that next to P first. In
  !> the mid-point rule tan(omega dt/2) = dt/2 times the frequency in space.
  function errors(mass, nu, k) result(error)
    character(*), intent(in) :: mass
    real(wp), intent(in) :: nu, k(3)
    real(wp) :: error(3), symbol(3, 3), inertia, square(3), wave(3, 3), speed(3), dt, c
    integer :: p, m
    c = material%wave_speed(in_space)
    dt = nu/c
    call symbols(mass, dt*c, k, symbol, inertia)
    call all_eigenvalues(symbol/inertia, square, wave)
    p = maxloc(abs(matmul(k, wave)), dim=1)
    speed = c*sqrt(0.4_wp/1.4_wp)
    speed(p) = c
    error = 2.0_wp*atan(half*dt*sqrt(square))/(dt*norm2(k))/speed - one
    error = [error(p), pack(error, [(m, m=1, 3)] /= p)]
  end function errors

  !> Sums over pairs of nodes of one element, of entries times cos k.(x_b - x_a): the grid is
  !> its own mirror image, so sines cancel.
  subroutine symbols(mass, path, k, symbol, inertia)
    character(*), intent(in) :: mass
    real(wp), intent(in) :: path, k(3)
    real(wp), intent(out) :: symbol(3, 3), inertia
    real(wp) :: ke(24, 24), me(8, 8), a(3), factor
    integer :: i, j
    call element%stiffness(x, material%moduli(in_space), one, ke)
    a = gauss
    if (mass == 'LUMPED') a = one
    if (mass == 'DISPERSION') a = tuned_points(element, x, path, -one)
    call element%mass(x, one, one, a, me)
    symbol = zero
    inertia = zero
    do j = 1, 8
      do i = 1, 8
        factor = cos(dot_product(k, x(:, j) - x(:, i)))
        symbol = symbol + factor*ke(3*i - 2:3*i, 3*j - 2:3*j)
        inertia = inertia + factor*me(i, j)
      end do
    end do
  end subroutine symbols

  !> Along an axis at Courant number 1 a tuned P wave of any length is exact.
  subroutine test_exact()
    real(wp) :: error(3)
    integer :: n
    call make_element('HEX8', element)
    do n = 3, 20
      error = errors('DISPERSION', one, [2.0_wp*pi/n, zero, zero])
      call check_close(error(1), zero, 1.0e-13_wp, 'P wave along an axis')
    end do
    error = errors('DISPERSION', 0.9_wp, [half*pi, zero, zero])
    call check_true(abs(error(1)) > 1.0e-3_wp, 'at another Courant number it is not')
  end subroutine test_exact

end program test_dispersion
