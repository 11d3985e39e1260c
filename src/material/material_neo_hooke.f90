! SPDX-License-Identifier: BSD-3-Clause
!> The neo-Hookean law whose shape and volume have energies of their own.
module material_neo_hooke
  use base_kinds, only: wp, one, two, half
  use material_base, only: leave_undefined
  use material_isotropic, only: isotropic_t
  use material_tensor, only: measures_t, measures_of, outer, circle, identity, exp_minus_one, &
      exp_excess, log_excess
  implicit none
  private
  real(wp), parameter :: third = one/3.0_wp

  type, extends(isotropic_t), public :: neo_hooke_t
    real(wp) :: c10 = 0.0_wp    !< half the shear modulus [F/L2]
    real(wp) :: bulk = 0.0_wp   !< K [F/L2]
  contains
    procedure :: respond => neo_hooke_response
  end type neo_hooke_t

  public :: new_neo_hooke

contains

  !> The material from density [M/L3], nu and C10 [F/L2]: G = 2 C10.
  pure function new_neo_hooke(id, density, nu, c10) result(material)
    integer, intent(in) :: id
    real(wp), intent(in) :: density, nu, c10
    type(neo_hooke_t) :: material
    material = neo_hooke_t(id=id, density=density, poisson=nu, c10=c10, &
        young=4.0_wp*c10*(one + nu), bulk=4.0_wp*c10*(one + nu)/(3.0_wp*(one - two*nu)), &
        is_linear=.false., is_finite=.true., mean_dilatation=.true.)
  end function new_neo_hooke

  !> W = C10 (I1 J^(-2/3) - 3) + K/2 (J - 1)^2, S = g (I - I1/3 C^-1) + K J (J - 1) C^-1, g = 2
  !> C10 J^(-2/3) (Treloar 1943, in the stretches without volume of Flory 1961). Terms of first
  !> order are taken out, with m = J^(-2/3) - 1: I1 J^(-2/3) - 3 = 2 i1 (1 + m) + 3 m, 2 i1 = j
  !> - 4 i2 - 8 i3.
  pure subroutine neo_hooke_response(this, e, old, with_moduli, s, d, energy, new)
    class(neo_hooke_t), intent(in) :: this
    real(wp), intent(in) :: e(6), old(:)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: s(6), d(6, 6), energy, new(:)
    type(measures_t) :: q
    real(wp) :: m, g, growth, pressure, volume
    new = old
    q = measures_of(e)
    if (.not. q%exists) then
      call leave_undefined(s, d, energy)
      return
    end if
    m = exp_minus_one(-two*third*q%log_volume)
    g = two*this%c10*(one + m)
    growth = exp_minus_one(q%log_volume)
    volume = one + growth
    pressure = this%bulk*volume*growth
    s = (pressure - two*third*g*q%i1)*q%inverse - g*q%change
    energy = this%c10*(log_excess(q%j) - 4.0_wp*q%i2 - 8.0_wp*q%i3 + two*q%i1*m &
        + 3.0_wp*exp_excess(-two*third*q%log_volume)) + half*this%bulk*growth**2
    if (.not. with_moduli) return
    associate (first => 3.0_wp + two*q%i1, c => q%inverse)
      d = (two*third**2*g*first + this%bulk*volume*(two*volume - one))*outer(c, c) &
          + (two*third*g*first - two*pressure)*circle(c) &
          - two*third*g*(outer(identity, c) + outer(c, identity))
    end associate
  end subroutine neo_hooke_response

end module material_neo_hooke
