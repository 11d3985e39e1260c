! SPDX-License-Identifier: BSD-3-Clause
!> The law of Hencky: that of Hooke between logarithmic strains and their conjugate stresses. It
!> stiffens in compression, where that of St Venant and Kirchhoff gives way.
module material_hencky
  use base_kinds, only: wp, one, two, half
  use material_base, only: in_space, leave_undefined
  use material_isotropic, only: isotropic_t
  use material_logarithm, only: stretches_t, stretches_of, to_reference
  use material_tensor, only: identity
  implicit none
  private

  type, extends(isotropic_t), public :: hencky_t
  contains
    procedure :: respond => hencky_response
  end type hencky_t

contains

  !> W = lambda/2 (tr e)^2 + G e:e, e = (ln C)/2, T = lambda tr e I + 2 G e (Hencky 1928; Xiao &
  !> Chen 2002).
  pure subroutine hencky_response(this, e, old, with_moduli, s, d, energy, new)
    class(hencky_t), intent(in) :: this
    real(wp), intent(in) :: e(6), old(:)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: s(6), d(6, 6), energy, new(:)
    type(stretches_t) :: p
    real(wp) :: shear, t(6)
    new = old
    p = stretches_of(e)
    if (.not. p%exist) then
      call leave_undefined(s, d, energy)
      return
    end if
    shear = half*this%young/(one + this%poisson)
    t = two*shear*this%poisson/(one - two*this%poisson)*p%volume*identity
    t(:3) = t(:3) + two*shear*p%log_stretch
    energy = half*dot_product(t(:3), p%log_stretch)
    if (with_moduli) d = this%moduli(in_space)
    call to_reference(p, t, with_moduli, s, d)
  end subroutine hencky_response

end module material_hencky
