! SPDX-License-Identifier: BSD-3-Clause
!> Rubber of Mooney and Rivlin, nearly incompressible.
module material_mooney
  use base_kinds, only: wp, one, two
  use material_base, only: leave_undefined
  use material_isotropic, only: isotropic_t
  use material_tensor, only: measures_t, measures_of, outer, circle, green_strain, identity
  implicit none
  private

  type, extends(isotropic_t), public :: mooney_t
    real(wp) :: a = 0.0_wp        !< of I1 [F/L2]
    real(wp) :: b = 0.0_wp        !< of I2 [F/L2]
    real(wp) :: q = 0.0_wp        !< of I3^-2: A/2 + B [F/L2]
    real(wp) :: p = 0.0_wp        !< of (I3 - 1)^2 [F/L2]
  contains
    procedure :: respond => mooney_response
  end type mooney_t

  public :: new_mooney, mooney_bulk

contains

  !> The material from density [M/L3], nu and the constants A, B [F/L2].
  pure function new_mooney(id, density, nu, a, b) result(material)
    integer, intent(in) :: id
    real(wp), intent(in) :: density, nu, a, b
    type(mooney_t) :: material
    material = mooney_t(id=id, density=density, poisson=nu, young=4.0_wp*(a + b)*(one + nu), &
        a=a, b=b, q=a/two + b, p=mooney_bulk(nu, a, b), is_linear=.false., &
        is_finite=.true., mean_dilatation=.true.)
  end function new_mooney

  !> P = (A (5 nu - 2) + B (11 nu - 5))/(2 (1 - 2 nu)) [F/L2]. Where it is not positive the
  !> energy falls without bound as the volume grows.
  pure real(wp) function mooney_bulk(nu, a, b)
    real(wp), intent(in) :: nu, a, b
    mooney_bulk = (a*(5.0_wp*nu - two) + b*(11.0_wp*nu - 5.0_wp))/(two*(one - two*nu))
  end function mooney_bulk

  !> W = A (I1 - 3) + B (I2 - 3) + Q (I3^-2 - 1) + P (I3 - 1)^2, S = 2 (A I + B (I1 I - C) + w
  !> C^-1), w = I3 dW/dI3 (Mooney 1940; the terms of I3 as the format of the card has them).
  !> Terms of first order are taken out by A + 2 B = 2 Q and j = I3 - 1 = 2 i1 + 4 i2 + 8 i3:
  !> I3^-2 - 1 + 2 j = j^2 (3 + 2 j)/(1 + j)^2.
  pure subroutine mooney_response(this, e, old, with_moduli, s, d, energy, new)
    class(mooney_t), intent(in) :: this
    real(wp), intent(in) :: e(6), old(:)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: s(6), d(6, 6), energy, new(:)
    type(measures_t) :: q
    real(wp) :: third, change, slope
    new = old
    q = measures_of(e)
    if (.not. q%exists) then
      call leave_undefined(s, d, energy)
      return
    end if
    third = one + q%j
    associate (a => this%a, b => this%b, c => this%q, p => this%p)
      change = two*q%j*(c*(two + q%j)/third**2 + p*third)
      s = two*(two*b*(q%i1*identity - green_strain(e)) - two*c*q%change + change*q%inverse)
      energy = 4.0_wp*b*q%i2 - (a + two*b)*(4.0_wp*q%i2 + 8.0_wp*q%i3) &
          + q%j**2*(c*(3.0_wp + two*q%j)/third**2 + p)
      if (.not. with_moduli) return
      slope = 4.0_wp*c/third**2 + two*p*third*(one + two*q%j)
      d = 4.0_wp*(b*(outer(identity, identity) - circle(identity)) &
          + slope*outer(q%inverse, q%inverse) - (change - two*c)*circle(q%inverse))
    end associate
  end subroutine mooney_response

end module material_mooney
