! SPDX-License-Identifier: BSD-3-Clause
!> Rubber of Ogden: powers of the principal stretches.
module material_ogden
  use base_kinds, only: wp, zero, one, two, half
  use material_base, only: leave_undefined
  use material_isotropic, only: isotropic_t
  use material_tensor, only: green_strain, spectrum, frame, log_one_plus, exp_minus_one, &
      exp_excess, least_determinant
  implicit none
  private
  integer, parameter, public :: most_terms = 8
  real(wp), parameter :: third = one/3.0_wp
  real(wp), parameter :: largest_exponent = 300.0_wp   ! beyond, products would overflow

  type, extends(isotropic_t), public :: ogden_t
    integer :: terms = 0
    real(wp) :: mu(most_terms) = 0.0_wp      !< [F/L2]
    real(wp) :: alpha(most_terms) = 0.0_wp   !< exponents
    real(wp) :: bulk = 0.0_wp                !< K [F/L2]
  contains
    procedure :: respond => ogden_response
  end type ogden_t

  public :: new_ogden, ogden_shear

contains

  !> The material from density [M/L3], nu, mu [F/L2] and alpha; pairs of zeros are left out.
  pure function new_ogden(id, density, nu, mu, alpha) result(material)
    integer, intent(in) :: id
    real(wp), intent(in) :: density, nu, mu(:), alpha(:)
    type(ogden_t) :: material
    real(wp) :: shear
    integer :: k
    shear = ogden_shear(mu, alpha)
    material = ogden_t(id=id, density=density, poisson=nu, young=two*shear*(one + nu), &
        bulk=two*shear*(one + nu)/(3.0_wp*(one - two*nu)), is_linear=.false., &
        is_finite=.true., mean_dilatation=.true.)
    do k = 1, size(mu)
      if (.not. abs(mu(k)*alpha(k)) > zero) cycle
      material%terms = material%terms + 1
      material%mu(material%terms) = mu(k)
      material%alpha(material%terms) = alpha(k)
    end do
  end function new_ogden

  !> Shear modulus at the reference, sum of mu alpha/2 [F/L2].
  pure real(wp) function ogden_shear(mu, alpha)
    real(wp), intent(in) :: mu(:), alpha(:)
    ogden_shear = half*dot_product(mu, alpha)
  end function ogden_shear

  !> W = sum mu/alpha (lb1^alpha + lb2^alpha + lb3^alpha - 3) + K (J - 1 - ln J), lb = l
  !> J^(-1/3); Kirchhoff's principal stresses tau_A = sum mu (lb_A^alpha - mean) + K (J - 1)
  !> (Ogden 1972; axes and moduli: Holzapfel 2000, 6.6). All by h = ln lb, sum h = 0, of
  !> the eigenvalues of E: terms of first order are not there to cancel.
  pure subroutine ogden_response(this, e, old, with_moduli, s, d, energy, new)
    class(ogden_t), intent(in) :: this
    real(wp), intent(in) :: e(6), old(:)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: s(6), d(6, 6), energy, new(:)
    real(wp) :: strain(3), axis(3, 3), log_stretch(3), h(3), c(3), tau(3), p(3), r(6, 6)
    real(wp) :: log_volume
    integer :: k
    new = old
    call spectrum(green_strain(e), strain, axis)
    c = one + two*strain
    if (minval(c) > least_determinant) then
      log_stretch = half*log_one_plus(two*strain)
      log_volume = sum(log_stretch)
      h = log_stretch - third*log_volume
    end if
    if (.not. is_within(this, c, h)) then
      call leave_undefined(s, d, energy)
      return
    end if
    tau = this%bulk*exp_minus_one(log_volume)
    energy = this%bulk*exp_excess(log_volume)
    do k = 1, this%terms
      p = exp_minus_one(this%alpha(k)*h)
      tau = tau + this%mu(k)*(p - third*sum(p))
      energy = energy + this%mu(k)/this%alpha(k)*sum(exp_excess(this%alpha(k)*h))
    end do
    r = frame(axis)
    s = matmul(r(:, :3), tau/c)
    if (with_moduli) d = matmul(r, matmul(principal_moduli(this, log_stretch, c, tau), &
        transpose(r)))
  end subroutine ogden_response

  !> Are the powers of the stretches numbers?
  pure logical function is_within(this, c, h)
    type(ogden_t), intent(in) :: this
    real(wp), intent(in) :: c(3), h(3)
    is_within = minval(c) > least_determinant
    if (is_within) is_within = maxval(abs(this%alpha(:this%terms)))*maxval(abs(h)) &
        < largest_exponent
  end function is_within

  !> Moduli in the principal axes (6, 6): those of the stretches, by a_AB = dtau_A/dln l_B, and
  !> those of turning axes, (S_B - S_A)/(c_B - c_A).
  pure function principal_moduli(this, log_stretch, c, tau) result(d)
    class(ogden_t), intent(in) :: this
    real(wp), intent(in) :: log_stretch(3), c(3), tau(3)
    real(wp) :: d(6, 6), q(3), volume
    integer :: a, b, k
    d = zero
    volume = exp(sum(log_stretch))
    d(:3, :3) = this%bulk*volume
    do k = 1, this%terms
      q = this%mu(k)*this%alpha(k)*exp(this%alpha(k)*(log_stretch - third*sum(log_stretch)))
      do a = 1, 3
        d(a, a) = d(a, a) + q(a)
        d(a, :3) = d(a, :3) - third*(q(a) + q - third*sum(q))
      end do
    end do
    do a = 1, 3
      b = mod(a, 3) + 1
      d(a, :3) = d(a, :3)/(c(a)*c)
      d(a, a) = d(a, a) - two*tau(a)/c(a)**2
      d(3 + a, 3 + a) = turning(this, log_stretch, [a, b]) &
          - half*(tau(a) + tau(b))/(c(a)*c(b))
    end do
  end function principal_moduli

  !> The difference quotient of tau over c of two axes, times the mean of 1/c, whatever their
  !> gap: exp(x_B) - exp(x_A) = 2 exp of the mean times sinh of half the difference.
  pure real(wp) function turning(this, log_stretch, pair)
    class(ogden_t), intent(in) :: this
    real(wp), intent(in) :: log_stretch(3)
    integer, intent(in) :: pair(2)
    real(wp) :: x(2), gap, mean, ratio
    integer :: k
    x = log_stretch(pair)
    gap = x(2) - x(1)
    mean = half*sum(x)
    turning = zero
    do k = 1, this%terms
      ratio = half*this%alpha(k)
      if (abs(gap) > zero) ratio = sinh(ratio*gap)/sinh(gap)
      turning = turning + this%mu(k)*ratio &
          *exp(this%alpha(k)*(mean - third*sum(log_stretch)))
    end do
    turning = turning*exp(-two*mean)*half*sum(exp(-two*x))
  end function turning

end module material_ogden
