! SPDX-License-Identifier: BSD-3-Clause
!> Time schemes by name: which fields of *BIPACT_TIME each takes and what it has. The table of
!> keywords takes its words from here, the checks of the scene go by it, and time_registry makes
!> the schemes.
module deck_schemes
  implicit none
  private

  type, public :: scheme_traits_t
    character(10) :: name = ''
    logical :: takes_theta = .false.       !< THETA and XI
    logical :: takes_gamma = .false.       !< GAMMA and BETA of *CONTROL_IMPLICIT_DYNAMICS
    logical :: takes_alpha = .false.       !< ALPHA of *CONTROL_IMPLICIT_DYNAMICS
    logical :: takes_rho = .false.         !< RHOINF
    logical :: takes_restitution = .false. !< REST
    logical :: takes_rule = .false.        !< RULE
    logical :: takes_pbeta = .false.       !< PBETA: 1/4, or 0, which is explicit
    logical :: takes_dispersion = .true.   !< the mass DISPERSION, which may be singular
    logical :: takes_redist = .true.       !< massless contact nodes
    logical :: takes_damping = .true.      !< *DAMPING_...
    logical :: has_acceleration = .false.  !< prescribed ones (VAD 1), columns of nodout
    !> Whatever its fields say: lumped masses alone in the effective matrix, and a largest step.
    logical :: is_explicit = .false.
    logical :: is_two_step = .false.       !< its energy identity needs equal steps
    logical :: takes_event = .true.        !< steps cut at a touch: one stage, on positions
  end type scheme_traits_t

  type(scheme_traits_t), parameter, public :: schemes(*) = [ &
      scheme_traits_t('THETA', takes_theta=.true.), &
      scheme_traits_t('NEWMARK', takes_gamma=.true., has_acceleration=.true.), &
      scheme_traits_t('HHT', takes_alpha=.true., has_acceleration=.true.), &
      scheme_traits_t('GENALPHA', takes_rho=.true., has_acceleration=.true.), &
      scheme_traits_t('MOREAU', takes_theta=.true., takes_restitution=.true., &
      takes_rule=.true., takes_redist=.false., takes_event=.false.), &
      scheme_traits_t('PAOLI', takes_restitution=.true., takes_pbeta=.true., &
      takes_redist=.false., is_two_step=.true.), &
      scheme_traits_t('CDLAGRANGE', takes_restitution=.true., takes_redist=.false., &
      is_explicit=.true., is_two_step=.true.), &
      scheme_traits_t('THETAPV', takes_dispersion=.false., takes_redist=.false., &
      takes_event=.false.), &
      scheme_traits_t('NSGENALPHA', takes_rho=.true., takes_restitution=.true., &
      takes_dispersion=.false., takes_redist=.false., takes_damping=.false., &
      takes_event=.false., has_acceleration=.true.), &
      scheme_traits_t('CSNEWMARK', takes_dispersion=.false., takes_redist=.false., &
      takes_event=.false.)]

  public :: traits_of

contains

  !> Traits of a scheme; of an unknown name, nothing.
  pure function traits_of(name) result(traits)
    character(*), intent(in) :: name
    type(scheme_traits_t) :: traits
    integer :: k
    do k = 1, size(schemes)
      if (schemes(k)%name == name) traits = schemes(k)
    end do
  end function traits_of

end module deck_schemes
