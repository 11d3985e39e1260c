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
  use material_logarithm, only: stretches_t, stretches_of, into_axes, to_reference
  use material_tensor, only: identity, contraction, outer, circle
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
    type(stretches_t) :: at
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
    real(wp) :: shear, bulk, t(6)
    new = old
    p%at = stretches_of(e)
    if (.not. p%at%exist) then
      call leave_undefined(s, d, energy)
      return
    end if
    shear = half*this%young/(one + this%poisson)
    bulk = this%young/(3.0_wp*(one - two*this%poisson))
    call return_to_yield(this, shear, old, new, p)
    t = two*shear*p%elastic + bulk*p%at%volume*identity
    energy = half*bulk*p%at%volume**2 + shear*contraction(p%elastic, p%elastic)
    if (with_moduli) d = consistent_moduli(p, shear, bulk)
    call to_reference(p%at, t, with_moduli, s, d)
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
    p%elastic = -into_axes(p%at%frame, old(:6))
    p%elastic(:3) = p%elastic(:3) + p%at%log_stretch - p%at%volume/3.0_wp
    xi = two*shear*p%elastic
    if (this%has_back) xi = xi - into_axes(p%at%frame, old(7:12))
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
    associate (n_space => matmul(p%at%frame, p%flow))
      new(:6) = old(:6) + p%step*n_space
      if (this%has_back) new(7:12) = old(7:12) + two/3.0_wp*this%back*p%step*n_space
    end associate
    new(n - 1) = old(n - 1) + two*shear*p%step*contraction(p%elastic, p%flow)
    new(n) = alpha + root*p%step
  end subroutine return_to_yield

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

end module material_plastic
