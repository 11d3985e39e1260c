! SPDX-License-Identifier: BSD-3-Clause
!> Time schemes by name. To add one: its file, its `use`, its case; its traits are a row of
!> deck_schemes.
module time_registry
  use base_status, only: status_t, fail, status_deck
  use deck_schemes, only: scheme_traits_t, traits_of
  use model_data, only: controls_t
  use time_alpha, only: hht, generalised_alpha
  use time_base, only: scheme_t
  use time_csnewmark, only: csnewmark_t
  use time_nsgenalpha, only: nonsmooth_alpha
  use time_paoli, only: paoli_t
  use time_static, only: static_t
  use time_newmark, only: newmark_t
  use time_theta, only: theta_t
  use time_thetapv, only: thetapv_t
  implicit none
  private
  public :: make_scheme

contains

  !> The scheme that the deck asks for, or that of a static phase, ready for steps of length dt.
  subroutine make_scheme(controls, is_static, scheme, status)
    type(controls_t), intent(in) :: controls
    logical, intent(in) :: is_static
    class(scheme_t), allocatable, intent(out) :: scheme
    type(status_t), intent(inout) :: status
    type(scheme_traits_t) :: traits
    traits = traits_of(controls%scheme)
    if (is_static) then
      allocate (static_t :: scheme)
      scheme%has_acceleration = traits%has_acceleration .and. .not. controls%is_static
      call scheme%set_step(controls%dt)
      return
    end if
    select case (trim(controls%scheme))
    case ('THETA')
      allocate (scheme, source=theta_t(theta=controls%theta, xi=controls%xi))
    case ('NEWMARK')
      allocate (scheme, source=newmark_t(gamma=controls%gamma, beta=controls%beta))
    case ('HHT')
      allocate (scheme, source=hht(controls%alpha))
    case ('GENALPHA')
      allocate (scheme, source=generalised_alpha(controls%rho))
    case ('MOREAU')
      allocate (scheme, source=theta_t(theta=controls%theta, xi=controls%xi, &
          on_velocities=.true., is_safe=controls%is_safe))
    case ('PAOLI')
      allocate (scheme, source=paoli_t(beta=controls%pbeta))
    case ('CDLAGRANGE')
      allocate (scheme, source=paoli_t(beta=controls%pbeta, on_velocities=.true.))
    case ('THETAPV')
      allocate (thetapv_t :: scheme)
    case ('NSGENALPHA')
      allocate (scheme, source=nonsmooth_alpha(controls%rho))
    case ('CSNEWMARK')
      allocate (csnewmark_t :: scheme)
    case default
      call fail(status, status_deck, 'time scheme "'//trim(controls%scheme)// &
          '" is not available')
      return
    end select
    scheme%name = traits%name
    scheme%has_acceleration = traits%has_acceleration
    call scheme%set_step(controls%dt)
  end subroutine make_scheme

end module time_registry
