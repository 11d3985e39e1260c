! SPDX-License-Identifier: BSD-3-Clause
!> Plasticity of von Mises in logarithmic strain, isotropic and kinematic hardening: strains are
!> added, e = (ln C)/2 = elastic + plastic, and the return of small strains holds word for word
!> (Miehe, Apel & Lambrecht 2002; the return: Simo & Hughes 1998, 3.3).
!>
!> History of a point: the plastic strain (11, 22, 33, 12, 23, 31), the back stress likewise
!> where there is kinematic hardening, and the equivalent plastic strain.
module material_plastic
  use base_kinds, only: wp, zero, one, two, half
  use material_base, only: leave_undefined
  use material_isotropic, only: isotropic_t
  use material_tensor, only: component, first_index, second_index, identity, green_strain, &
      trace, contraction, outer, circle, spectrum, frame, log_one_plus, least_determinant
  implicit none
  private

  !> The yield stress by equivalent plastic strain: lines, the last without end.
  type, extends(isotropic_t), public :: plastic_t
    real(wp), allocatable :: start(:)    !< plastic strain where a line begins; the first is 0
    real(wp), allocatable :: yield(:)    !< yield stress there [F/L2]
    real(wp), allocatable :: slope(:)    !< [F/L2]
    real(wp) :: back = 0.0_wp            !< kinematic hardening modulus [F/L2]
    logical :: has_back = .false.        !< its stress is part of the history
  contains
    procedure :: respond => plastic_response
  end type plastic_t

  !> A point in the axes of its stretches.
  type :: point_t
    real(wp) :: log_stretch(3) = zero
    real(wp) :: c(3) = zero            !< squares of the stretches
    real(wp) :: frame(6, 6) = zero     !< from these axes to those of space
    real(wp) :: volume = zero          !< ln J
    real(wp) :: elastic(6) = zero      !< elastic strain, its deviator
    real(wp) :: flow(6) = zero         !< direction n of plastic flow, |n| = 1
    real(wp) :: step = zero            !< of the plastic strain along n
    real(wp) :: size = zero            !< of the trial stress less the back stress [F/L2]
    real(wp) :: slope = zero           !< hardening, isotropic and kinematic [F/L2]
  end type point_t

  public :: new_bilinear, new_piecewise, hardening_modulus

contains

  !> Linear hardening: yield stress and tangent modulus of a bar [F/L2], beta = 1 isotropic, 0
  !> kinematic.
  pure function new_bilinear(id, density, young, nu, yield, tangent, beta) result(material)
    integer, intent(in) :: id
    real(wp), intent(in) :: density, young, nu, yield, tangent, beta
    type(plastic_t) :: material
    real(wp) :: h
    h = hardening_modulus(young, tangent)
    material = new_piecewise(id, density, young, nu, [zero, one], [yield, yield + beta*h])
    material%has_back = beta < one
    material%back = (one - beta)*h
    if (material%has_back) call number_states(material, 12)
  end function new_bilinear

  !> Isotropic hardening by points: yield stress [F/L2] against equivalent plastic strain, which
  !> begins with 0 and increases. Beyond the last point its slope goes on (S. Bala, "Curve
  !> extrapolation", d3view.com, 2007); one point alone is ideal plasticity.
  pure function new_piecewise(id, density, young, nu, strain, stress) result(material)
    integer, intent(in) :: id
    real(wp), intent(in) :: density, young, nu, strain(:), stress(:)
    type(plastic_t) :: material
    integer :: n
    n = max(1, size(strain) - 1)
    material%id = id
    material%density = density
    material%young = young
    material%poisson = nu
    material%is_linear = .false.
    material%is_finite = .true.
    material%mean_dilatation = .true.
    call number_states(material, 6)
    allocate (material%start(n), material%yield(n), material%slope(n))
    material%start = strain(:n)
    material%yield = stress(:n)
    material%slope = zero
    if (size(strain) > 1) material%slope = (stress(2:) - stress(:n))/(strain(2:) - strain(:n))
  end function new_piecewise

  !> History: the tensors, the plastic work, the equivalent plastic strain.
  pure subroutine number_states(material, tensors)
    type(plastic_t), intent(inout) :: material
    integer, intent(in) :: tensors
    material%work_state = tensors + 1
    material%strain_state = tensors + 2
    material%states = tensors + 2
  end subroutine number_states

  !> Plastic modulus H = E Et/(E - Et) [F/L2] from the tangent modulus of a bar.
  pure real(wp) function hardening_modulus(young, tangent)
    real(wp), intent(in) :: young, tangent
    hardening_modulus = young*tangent/(young - tangent)
  end function hardening_modulus

  !> energy is the elastic one alone: K/2 (ln J)^2 + G |elastic deviator|^2.
  pure subroutine plastic_response(this, e, old, with_moduli, s, d, energy, new)
    class(plastic_t), intent(in) :: this
    real(wp), intent(in) :: e(6), old(:)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: s(6), d(6, 6), energy, new(:)
    type(point_t) :: p
    real(wp) :: shear, bulk, strain(3), axis(3, 3), t(6)
    new = old
    call spectrum(green_strain(e), strain, axis)
    p%c = one + two*strain
    if (.not. minval(p%c) > least_determinant) then
      call leave_undefined(s, d, energy)
      return
    end if
    shear = half*this%young/(one + this%poisson)
    bulk = this%young/(3.0_wp*(one - two*this%poisson))
    p%log_stretch = half*log_one_plus(two*strain)
    p%volume = sum(p%log_stretch)
    p%frame = frame(axis)
    call return_to_yield(this, shear, old, new, p)
    t = two*shear*p%elastic + bulk*p%volume*identity
    energy = half*bulk*p%volume**2 + shear*contraction(p%elastic, p%elastic)
    if (with_moduli) d = consistent_moduli(p, shear, bulk)
    call to_reference(p, t, with_moduli, s, d)
  end subroutine plastic_response

  !> Radial return: trial deviator, flow along xi = s - X where |xi| exceeds the yield stress;
  !> along the lines of the yield stress one after the other, each of which gives its step in
  !> closed form.
  pure subroutine return_to_yield(this, shear, old, new, p)
    type(plastic_t), intent(in) :: this
    real(wp), intent(in) :: shear, old(:)
    real(wp), intent(inout) :: new(:)
    type(point_t), intent(inout) :: p
    real(wp), parameter :: root = sqrt(two/3.0_wp)
    real(wp) :: xi(6), alpha, excess
    integer :: k, n
    n = size(old)
    alpha = old(n)
    p%elastic = -into_axes(p%frame, old(:6))
    p%elastic(:3) = p%elastic(:3) + p%log_stretch - p%volume/3.0_wp
    xi = two*shear*p%elastic
    if (this%has_back) xi = xi - into_axes(p%frame, old(7:12))
    p%size = sqrt(contraction(xi, xi))
    k = count(this%start <= alpha)
    do
      excess = p%size - root*(this%yield(k) + this%slope(k)*(alpha - this%start(k)))
      if (.not. excess > zero) return
      p%slope = this%slope(k) + this%back
      p%step = excess/(two*shear + two/3.0_wp*p%slope)
      if (k == size(this%start)) exit
      if (alpha + root*p%step <= this%start(k + 1)) exit
      k = k + 1
    end do
    p%flow = xi/p%size
    p%elastic = p%elastic - p%step*p%flow
    associate (n_space => matmul(p%frame, p%flow))
      new(:6) = old(:6) + p%step*n_space
      if (this%has_back) new(7:12) = old(7:12) + two/3.0_wp*this%back*p%step*n_space
    end associate
    new(n - 1) = old(n - 1) + two*shear*p%step*contraction(p%elastic, p%flow)
    new(n) = alpha + root*p%step
  end subroutine return_to_yield

  !> Components in the axes of a frame: its inverse is its transpose but for the weight 2 of
  !> shears.
  pure function into_axes(frame, a) result(b)
    real(wp), intent(in) :: frame(6, 6), a(6)
    real(wp) :: b(6)
    b = a
    b(4:) = two*a(4:)
    b = matmul(b, frame)
    b(4:) = half*b(4:)
  end function into_axes

  !> dT/de of the return (Simo & Hughes 1998, 3.3), in the axes of the stretches.
  pure function consistent_moduli(p, shear, bulk) result(d)
    type(point_t), intent(in) :: p
    real(wp), intent(in) :: shear, bulk
    real(wp) :: d(6, 6), ratio, along
    ratio = one
    along = zero
    if (p%step > zero) then
      ratio = one - two*shear*p%step/p%size
      along = one/(one + p%slope/(3.0_wp*shear)) - (one - ratio)
    end if
    d = (bulk - two*shear*ratio/3.0_wp)*outer(identity, identity) &
        + two*shear*ratio*circle(identity)
    if (p%step > zero) d = d - two*shear*along*outer(p%flow, p%flow)
  end function consistent_moduli

  !> From T, conjugate to e = (ln C)/2, to S, and d from dT/de to dS/dE, in space: with f[A,B],
  !> f[A,B,C] the difference quotients of ln at c_A, c_B, c_C, S_AB = T_AB f[A,B], D_ABCD =
  !> f[A,B] f[C,D] (dT/de)_ABCD + d_BD W^B_AC + d_BC W^B_AD + d_AD W^A_BC + d_AC W^A_BD, W^B_AC
  !> = T_AC f[A,B,C] (the second derivative of the logarithm: Miehe, Apel & Lambrecht 2002).
  pure subroutine to_reference(p, t, with_moduli, s, d)
    type(point_t), intent(in) :: p
    real(wp), intent(in) :: t(6)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: s(6)
    real(wp), intent(inout) :: d(6, 6)
    real(wp) :: f(6), second(3, 3, 3), w(3, 3, 3), own(6, 6)
    integer :: m, n, i, j, k, l
    do m = 1, 6
      f(m) = quotient(p%log_stretch(first_index(m)), p%log_stretch(second_index(m)))
    end do
    s = matmul(p%frame, f*t)
    if (.not. with_moduli) return
    second = second_quotients(p%c, f)
    do k = 1, 3
      do j = 1, 3
        do i = 1, 3
          w(i, k, j) = t(component(i, k))*second(i, k, j)   ! W^j_ik
        end do
      end do
    end do
    own = d*outer(f, f)
    do n = 1, 6
      k = first_index(n)
      l = second_index(n)
      do m = 1, 6
        i = first_index(m)
        j = second_index(m)
        if (j == l) own(m, n) = own(m, n) + w(i, k, j)
        if (j == k) own(m, n) = own(m, n) + w(i, l, j)
        if (i == l) own(m, n) = own(m, n) + w(j, k, i)
        if (i == k) own(m, n) = own(m, n) + w(j, l, i)
      end do
    end do
    d = matmul(p%frame, matmul(own, transpose(p%frame)))
  end subroutine to_reference

  !> (ln c_B - ln c_A)/(c_B - c_A), whatever their gap: from x = (ln c)/2, c_B - c_A = 2
  !> exp(x_A + x_B) sinh(x_B - x_A).
  pure real(wp) function quotient(xa, xb)
    real(wp), intent(in) :: xa, xb
    real(wp) :: gap
    gap = xb - xa
    quotient = exp(-xa - xb)
    if (abs(gap) > zero) quotient = quotient*(gap/sinh(gap))
  end function quotient

  !> Second difference quotients of ln at any three of c, from the first ones f (6).
  pure function second_quotients(c, f) result(second)
    real(wp), intent(in) :: c(3), f(6)
    real(wp) :: second(3, 3, 3), x
    integer :: i, j, k
    do k = 1, 3
      do j = 1, k
        do i = 1, j
          x = second_quotient(c([i, j, k]), f([component(j, k), component(k, i), &
              component(i, j)]))
          second(i, j, k) = x
          second(j, i, k) = x
          second(i, k, j) = x
          second(k, i, j) = x
          second(j, k, i) = x
          second(k, j, i) = x
        end do
      end do
    end do
  end function second_quotients

  !> One of them: f(m) is the first quotient of the two others of m. By the two that lie
  !> farthest apart; where these are near, by the series about the mean, whose first term left
  !> out is 1e-12 of the sum.
  pure real(wp) function second_quotient(c, f)
    real(wp), intent(in) :: c(3), f(3)
    real(wp), parameter :: near = 1.0e-3_wp
    real(wp) :: mean, y(3)
    integer :: low, high
    low = minloc(c, 1)
    high = maxloc(c, 1)
    mean = sum(c)/3.0_wp
    if (c(high) - c(low) < near*mean) then
      y = (c - mean)/mean
      second_quotient = (-half - sum(y**2)/8.0_wp + sum(y**3)/15.0_wp)/mean**2
    else
      second_quotient = (f(low) - f(high))/(c(high) - c(low))
    end if
  end function second_quotient

end module material_plastic
