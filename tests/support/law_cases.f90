! SPDX-License-Identifier: BSD-3-Clause
!> Materials with laws at finite strain for tests, their states, and their energies written once
!> more: from C, as books have them, in 33 digits.
module law_cases
  use, intrinsic :: iso_fortran_env, only: real128
  use base_kinds, only: wp, zero, one, two, half
  use material_base, only: material_t
  use material_registry, only: make_material
  implicit none
  private
  integer, parameter, public :: qp = real128
  real(wp), parameter, public :: shear = 1000.0_wp       !< G of all of them
  real(wp), parameter, public :: young = 2500.0_wp, poisson = 0.25_wp   !< of plastic ones
  real(wp), parameter, public :: yield = 40.0_wp, tangent = 300.0_wp

  type, public :: case_t
    character(24) :: name = ''
    class(material_t), allocatable :: law
    real(wp) :: nu = zero
    logical :: is_plastic = .false.
    real(wp) :: constants(4) = zero      !< for its energy
  end type case_t

  public :: make_cases, random_strain, random_axes, turned, energy_in_quad, strain_of, &
      bulk_modulus, ogden_mu, ogden_alpha
  real(wp), parameter :: ogden_mu(3) = [1200.0_wp, 2.5_wp, -20.0_wp] &
      *(two*shear/(1200.0_wp*1.3_wp + 2.5_wp*5.0_wp + 40.0_wp))
  real(wp), parameter :: ogden_alpha(3) = [1.3_wp, 5.0_wp, -two]

contains

  !> All laws; plastic ones with BETA 1, 0.3, 0 and by a curve.
  subroutine make_cases(cases)
    type(case_t), allocatable, intent(out) :: cases(:)
    real(wp), parameter :: points(2, 4) = reshape([zero, yield, 0.02_wp, 60.0_wp, 0.1_wp, &
        80.0_wp, 0.5_wp, 90.0_wp], [2, 4])
    real(wp) :: none(4), a, b
    real(wp), parameter :: beta(3) = [one, 0.3_wp, zero]
    character(2), parameter :: letter(3) = ['1 ', '.3', '0 ']
    integer :: k
    allocate (cases(13))
    none = zero
    a = 0.4_wp*shear
    b = 0.1_wp*shear
    call add('elastic', 'MAT_ELASTIC', [one, young, poisson], poisson)
    call add('hencky', 'MAT_ELASTIC HENCKY', [one, young, poisson], poisson)
    call add('rubber', 'MAT_BLATZ-KO_RUBBER', [one, shear], 0.463_wp)
    call add('foam', 'MAT_BLATZ-KO_FOAM', [one, shear], 0.25_wp)
    call add('mooney .495', 'MAT_MOONEY-RIVLIN_RUBBER', [one, 0.495_wp, a, b], 0.495_wp)
    call add('mooney .46', 'MAT_MOONEY-RIVLIN_RUBBER', [one, 0.46_wp, half*shear, zero], &
        0.46_wp)
    call add('ogden .495', 'MAT_OGDEN_RUBBER', [one, 0.495_wp, zero, none, ogden_mu, zero, &
        none, ogden_alpha], 0.495_wp)
    call add('ogden .3', 'MAT_OGDEN_RUBBER', [one, 0.3_wp, zero, none, ogden_mu, zero, none, &
        ogden_alpha], 0.3_wp)
    call add('neo-hooke', 'MAT_HYPERELASTIC_RUBBER', [one, 0.3_wp, zero, none, half*shear], &
        0.3_wp)
    do k = 1, 3
      call add('kinematic, beta '//letter(k), 'MAT_PLASTIC_KINEMATIC', &
          [one, young, poisson, yield, tangent, beta(k)], poisson)
    end do
    call add('piecewise', 'MAT_PIECEWISE_LINEAR_PLASTICITY', [one, young, poisson], poisson, &
        points)

  contains

    subroutine add(name, keyword, constants, nu, curve)
      character(*), intent(in) :: name, keyword
      real(wp), intent(in) :: constants(:), nu
      real(wp), intent(in), optional :: curve(:, :)
      integer :: n
      n = count(cases%name /= '') + 1
      cases(n)%name = name
      cases(n)%nu = nu
      cases(n)%constants = constants([2, min(3, size(constants)), min(4, size(constants)), 1])
      call make_material(keyword, n, constants, cases(n)%law, curve)
      cases(n)%is_plastic = cases(n)%law%states > 0
    end subroutine add

  end subroutine make_cases

  !> Green's strain (6), engineering shears, of a random F with det F > 0.3, |F - I| about size.
  function random_strain(size) result(e)
    real(wp), intent(in) :: size
    real(wp) :: e(6), h(3, 3), f(3, 3), det
    integer :: k
    do
      call random_number(h)
      h = size*(two*h - one)/sqrt(3.0_wp)
      f = h
      do k = 1, 3
        f(k, k) = one + h(k, k)
      end do
      det = f(1, 1)*(f(2, 2)*f(3, 3) - f(2, 3)*f(3, 2)) - f(1, 2)*(f(2, 1)*f(3, 3) &
          - f(2, 3)*f(3, 1)) + f(1, 3)*(f(2, 1)*f(3, 2) - f(2, 2)*f(3, 1))
      if (det > 0.3_wp) exit
    end do
    e = strain_of(half*(h + transpose(h) + matmul(transpose(h), h)))
  end function random_strain

  !> A symmetric matrix as strains with engineering shears.
  pure function strain_of(a) result(e)
    real(wp), intent(in) :: a(3, 3)
    real(wp) :: e(6)
    e = [a(1, 1), a(2, 2), a(3, 3), two*a(1, 2), two*a(2, 3), two*a(3, 1)]
  end function strain_of

  !> A random rotation.
  function random_axes() result(r)
    real(wp) :: r(3, 3), q(4)
    call random_number(q)
    q = two*q - one
    q = q/norm2(q)
    r(:, 1) = [one - two*(q(3)**2 + q(4)**2), two*(q(2)*q(3) + q(1)*q(4)), &
        two*(q(2)*q(4) - q(1)*q(3))]
    r(:, 2) = [two*(q(2)*q(3) - q(1)*q(4)), one - two*(q(2)**2 + q(4)**2), &
        two*(q(3)*q(4) + q(1)*q(2))]
    r(:, 3) = [two*(q(2)*q(4) + q(1)*q(3)), two*(q(3)*q(4) - q(1)*q(2)), &
        one - two*(q(2)**2 + q(3)**2)]
  end function random_axes

  !> R^T A R of components (6), whose shears count shears(2 = engineering) times.
  pure function turned(a, r, shears) result(b)
    real(wp), intent(in) :: a(6), r(3, 3), shears
    real(wp) :: b(6), m(3, 3)
    m = reshape([a(1), a(4)/shears, a(6)/shears, a(4)/shears, a(2), a(5)/shears, &
        a(6)/shears, a(5)/shears, a(3)], [3, 3])
    m = matmul(transpose(r), matmul(m, r))
    b = [m(1, 1), m(2, 2), m(3, 3), shears*m(1, 2), shears*m(2, 3), shears*m(3, 1)]
  end function turned

  !> K of G and nu.
  pure real(wp) function bulk_modulus(g, nu)
    real(wp), intent(in) :: g, nu
    bulk_modulus = two*g*(one + nu)/(3.0_wp*(one - two*nu))
  end function bulk_modulus

  !> Energy of an elastic state, from C.
  function energy_in_quad(case, e) result(w)
    type(case_t), intent(in) :: case
    real(qp), intent(in) :: e(6)
    real(qp) :: w, c(3, 3), l(3), i1, i2, i3, j, g, b, p, a, nu
    integer :: k
    c = 2*reshape([e(1), e(4)/2, e(6)/2, e(4)/2, e(2), e(5)/2, e(6)/2, e(5)/2, e(3)], [3, 3])
    do k = 1, 3
      c(k, k) = c(k, k) + 1
    end do
    l = eigenvalues(c)
    i1 = sum(l)
    i2 = l(1)*l(2) + l(2)*l(3) + l(3)*l(1)
    i3 = product(l)
    j = sqrt(i3)
    g = shear
    nu = case%nu
    select case (case%name)
    case ('rubber')
      nu = 0.463_wp
      b = 2*nu/(1 - 2*nu)
      w = g/2*(i1 - 3 + 2/b*(j**(-b) - 1))
    case ('foam')
      w = g/2*(i2/i3 + 2*j - 5)
    case ('mooney .495', 'mooney .46')
      a = case%constants(2)
      b = case%constants(3)
      p = (a*(5*nu - 2) + b*(11*nu - 5))/(2*(1 - 2*nu))
      w = a*(i1 - 3) + b*(i2 - 3) + (a/2 + b)*(1/i3**2 - 1) + p*(i3 - 1)**2
    case ('ogden .495', 'ogden .3')
      w = bulk(g, nu)*(j - 1 - log(j))
      do k = 1, 3
        a = ogden_alpha(k)
        b = ogden_mu(k)
        w = w + b/a*(sum(l**(a/2)*i3**(-a/6)) - 3)
      end do
    case ('neo-hooke')
      w = g/2*(i1*i3**(-1/3.0_qp) - 3) + bulk(g, nu)/2*(j - 1)**2
    case ('elastic')
      w = (bulk(g, nu)/2 - g/3)*(sum(l - 1)/2)**2 + g*sum(((l - 1)/2)**2)
    case default
      w = (bulk(g, nu)/2 - g/3)*log(j)**2 + g*sum((log(l)/2)**2)
    end select

  contains

    real(qp) function bulk(g, nu)
      real(qp), intent(in) :: g, nu
      bulk = 2*g*(1 + nu)/(3*(1 - 2*nu))
    end function bulk

  end function energy_in_quad

  !> Eigenvalues of a symmetric matrix, by turns.
  function eigenvalues(matrix) result(l)
    real(qp), intent(in) :: matrix(3, 3)
    real(qp) :: l(3), a(3, 3), r(3, 3), t, x
    integer :: sweep, p, q, k
    a = matrix
    do sweep = 1, 20
      do p = 1, 2
        do q = p + 1, 3
          if (abs(a(p, q)) < 1.0e-60_qp) cycle
          x = (a(q, q) - a(p, p))/(2*a(p, q))
          t = sign(1.0_qp, x)/(abs(x) + sqrt(1 + x**2))
          r = 0
          do k = 1, 3
            r(k, k) = 1
          end do
          r(p, p) = 1/sqrt(1 + t**2)
          r(q, q) = r(p, p)
          r(p, q) = t*r(p, p)
          r(q, p) = -r(p, q)
          a = matmul(transpose(r), matmul(a, r))
        end do
      end do
    end do
    l = [a(1, 1), a(2, 2), a(3, 3)]
  end function eigenvalues

end module law_cases
