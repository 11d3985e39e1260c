! SPDX-License-Identifier: BSD-3-Clause
!> Finite deformation: NSOLVR 12 of *CONTROL_IMPLICIT_SOLUTION, *BIPACT_KINEMATICS, and what
!> does not go with them.
module scene_finite
  use base_kinds, only: wp, zero, half
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_warning, add_note
  use material_base, only: plane_stress
  use model_data, only: model_t, controls_t
  use solid_block, only: force_ends, force_middle, force_conserving
  implicit none
  private
  public :: read_kinematics, check_laws, check_elements

  integer, parameter :: solver_linear = 1, solver_finite = 12

contains

  !> Small displacements or finite deformation; the scheme must have been read.
  subroutine read_kinematics(deck, controls)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    integer :: r, solver, card
    solver = solver_linear
    r = deck%next('CONTROL_IMPLICIT_SOLUTION', 1, 0)
    if (r > 0) solver = deck%integer(r, 'NSOLVR')
    if (r > 0 .and. solver /= solver_linear .and. solver /= solver_finite) &
        call deck%complain(r, 'NSOLVR', 'expected 1 (small displacements) or 12 (finite '// &
        'deformation)')
    controls%is_finite = solver /= solver_linear    ! one message for a faulty number is enough
    if (r > 0) call read_iteration(deck, controls, r)
    card = deck%next('BIPACT_KINEMATICS', 1, 0)
    if (.not. controls%is_finite) then
      if (card > 0) call deck%complain(card, 'FORCE', '*BIPACT_KINEMATICS is of finite '// &
          'deformation', 'ask for it by NSOLVR 12 of *CONTROL_IMPLICIT_SOLUTION')
      return
    end if
    call choose_force(deck, controls, card)
    call check_scheme(deck, controls, r)
  end subroutine read_kinematics

  !> What the deck says of Newton's method; without it, a note each.
  subroutine read_iteration(deck, controls, r)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    integer, intent(in) :: r
    character(6), parameter :: fields(5) = [character(6) :: 'ILIMIT', 'MAXREF', 'DCTOL', &
        'RCTOL', 'ABSTOL']
    !> What others fill in where nobody asks.
    real(wp), parameter :: filled(5) = [11.0_wp, 15.0_wp, 1.0e-3_wp, 1.0e10_wp, 1.0e-10_wp]
    real(wp) :: value
    integer :: k
    if (.not. controls%is_finite) then
      do k = 1, size(fields)
        if (k <= 2) value = deck%integer(r, trim(fields(k)))
        if (k > 2) value = deck%real(r, trim(fields(k)))
        if (abs(value) > zero .and. abs(value - filled(k)) > 1.0e-6_wp*filled(k)) &
            call add_note(deck%problems, '*CONTROL_IMPLICIT_SOLUTION '//trim(fields(k))// &
            ' has no effect: small displacements need no iterations')
      end do
      return
    end if
    associate (i => controls%iteration)
      i%every = deck%integer(r, 'ILIMIT')
      i%most_factors = deck%integer(r, 'MAXREF')
      if (deck%real(r, 'DCTOL') > zero) i%motion = deck%real(r, 'DCTOL')
      i%force = deck%real(r, 'RCTOL')
      i%absolute = abs(deck%real(r, 'ABSTOL'))
    end associate
  end subroutine read_iteration

  !> The force of a step: EMC unless the deck or the scheme says otherwise.
  subroutine choose_force(deck, controls, card)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    integer, intent(in) :: card
    logical :: is_theta
    integer :: time
    is_theta = controls%scheme == 'THETA' .and. .not. controls%is_static
    controls%force = merge(force_conserving, force_ends, is_theta)
    if (card > 0) then
      select case (deck%word(card, 'QP0'))
      case ('0')
        controls%mean_dilatation = 0
      case ('1')
        controls%mean_dilatation = 1
      end select
      if (deck%is_given(card, 'FORCE') .and. .not. is_theta) call deck%complain(card, &
          'FORCE', 'FORCE is of scheme THETA of *BIPACT_TIME: leave it blank')
      controls%is_hencky = deck%word(card, 'LAW') == 'HENCKY'
      select case (deck%word(card, 'FORCE'))
      case ('PAPER')
        controls%force = force_ends
      case ('MIDPOINT')
        controls%force = force_middle
      end select
    end if
    if (controls%force == force_ends) return
    time = deck%next('BIPACT_TIME', 1, 0)
    if (time > 0) then
      if (deck%is_given(time, 'XI') .and. abs(controls%xi - half) > zero) &
          call deck%complain(time, 'XI', 'expected 0.5: the force of the step is that of '// &
          'its middle', 'FORCE PAPER of *BIPACT_KINEMATICS has an XI')
    end if
    controls%xi = half
  end subroutine choose_force

  subroutine check_scheme(deck, controls, r)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(in) :: controls
    integer, intent(in) :: r
    logical :: is_built
    call refuse_card(deck, 'DAMPING_PART_STIFFNESS', 'PID', 'damping by stiffness')
    call refuse_card(deck, 'DAMPING_PART_STIFFNESS_SET', 'PSID', 'damping by stiffness')
    if (controls%is_static) return
    is_built = any(controls%scheme == [character(10) :: 'THETA', 'NEWMARK']) .or. &
        controls%scheme == 'PAOLI' .and. controls%is_explicit
    if (.not. is_built) call deck%complain(r, 'NSOLVR', 'scheme '// &
        trim(controls%scheme)//' of *BIPACT_TIME is not available at finite deformation', &
        'take SCHEME THETA, NEWMARK for comparison, or PAOLI with PBETA 0')
    if (controls%mass == 'DISPERSION') call deck%complain(deck%next('BIPACT_MASS', 1, 0), &
        'TYPE', 'DISPERSION is tuned to one speed of waves, which changes with the strain', &
        'take CONSISTENT or LUMPED')
  end subroutine check_scheme

  !> What a card asks for is not there at finite deformation.
  subroutine refuse_card(deck, keyword, field, what)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: keyword, field, what
    integer :: r
    r = deck%next(keyword, 1, 0)
    if (r > 0) call deck%complain(r, field, what//' is not available at finite deformation')
  end subroutine refuse_card

  !> Each part needs a law of the kind that the deck asks for; parts and materials must have
  !> been read.
  subroutine check_laws(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    integer :: p
    do p = 1, size(model%part)
      if (model%part(p)%material == 0) cycle
      associate (law => model%material(model%part(p)%material)%item)
        if (.not. model%controls%is_finite .or. law%is_finite .or. law%is_rigid) cycle
        call deck%complain(model%part(p)%record, 'MID', 'material '//to_text(law%id)// &
            ' of part '//to_text(model%part(p)%id)//' is not available at finite '// &
            'deformation', 'NSOLVR 12 of *CONTROL_IMPLICIT_SOLUTION asks for it')
      end associate
    end do
  end subroutine check_laws

  !> Elements that finite deformation has no form of, and those that lock under laws that keep
  !> the volume; elements must have been read.
  subroutine check_elements(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    logical, dimension(size(model%part)) :: locks, is_full, is_refused
    integer :: e, p
    if (.not. model%controls%is_finite) return
    locks = .false.
    is_full = .false.
    is_refused = .false.
    do e = 1, model%mesh%n
      p = model%mesh%part(e)
      if (any([model%mesh%is_of_type(e, 'TRI3'), model%mesh%is_of_type(e, 'TRI3AX'), &
          model%mesh%is_of_type(e, 'TET4')])) &
          locks(p) = model%material(model%part(p)%material)%item%mean_dilatation
      is_full(p) = is_full(p) .or. flows_in_full(model, e)
      if (model%mesh%is_of_type(e, 'HEX8MODE')) is_refused(p) = .true.
    end do
    do p = 1, size(model%part)
      if (locks(p)) call add_warning(deck%problems, 'locking', 'part '// &
          to_text(model%part(p)%id)//' locks: constant strain and a law that keeps the '// &
          'volume; take quadrilaterals or hexahedra, which have mean dilatation')
      if (is_full(p)) call add_warning(deck%problems, 'locking', 'part '// &
          to_text(model%part(p)%id)//' locks: its plastic flow keeps the volume and QP0 0 '// &
          'takes mean dilatation away; leave QP0 of *BIPACT_KINEMATICS blank')
      if (is_refused(p)) call deck%complain(model%part(p)%record, 'SECID', 'part '// &
          to_text(model%part(p)%id)//': hexahedra with incompatible modes are not '// &
          'available at finite deformation', 'under compression such modes grow without '// &
          'strain; take ELFORM 1, or 2 for mean dilatation')
    end do
  end subroutine check_elements

  !> Does a bilinear element of a plastic law lack mean dilatation? Plane stress needs none.
  pure logical function flows_in_full(model, e)
    type(model_t), intent(in) :: model
    integer, intent(in) :: e
    flows_in_full = .false.
    if (model%controls%mean_dilatation /= 0) return
    associate (part => model%part(model%mesh%part(e)))
      if (part%plane == plane_stress) return
      if (model%material(part%material)%item%work_state == 0) return
    end associate
    flows_in_full = any([model%mesh%is_of_type(e, 'QUAD4'), &
        model%mesh%is_of_type(e, 'QUAD4AX'), model%mesh%is_of_type(e, 'HEX8')])
  end function flows_in_full

end module scene_finite
