! SPDX-License-Identifier: BSD-3-Clause
!> Time, scheme, mass and solver options: from cards to the model.
module scene_controls
  use base_kinds, only: wp, zero, one
  use cone_types, only: cone_options_t, find_solver, local_solver
  use deck_data, only: deck_t
  use deck_keywords_wall, only: wall_keyword
  use deck_problems, only: add_warning, add_problem, add_note
  use deck_reader, only: read_more
  use deck_schemes, only: scheme_traits_t, traits_of
  use linalg_registry, only: engine_diagonal
  use linalg_solver, only: solver_options_t
  use model_data, only: model_t, controls_t, count_steps
  use scene_contact, only: contact_keyword
  use scene_explicit, only: read_timestep
  use scene_finite, only: read_kinematics
  use scene_mass, only: read_wave, refuse_wave
  use scene_steps, only: read_steps
  implicit none
  private
  public :: read_controls, read_solver_options, note_keywords

contains

  !> First record of a mandatory keyword; 0 and a problem with its reason if it is absent.
  integer function required(deck, keyword, why)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: keyword, why
    required = deck%next(keyword, 1, 0)
    if (required == 0) call add_problem(deck%problems, deck%file(1)%path// &
        ': the deck needs *'//keyword//why)
  end function required

  !> Time and scheme, mass, ledger.
  subroutine read_controls(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    integer :: r
    logical :: is_implicit
    r = deck%next('TITLE', 1, 0)
    if (r > 0) model%title = deck%word(r, 'TITLE')
    associate (controls => model%controls)
      r = required(deck, 'CONTROL_TERMINATION', '')
      if (r > 0) then
        controls%end_time = deck%real(r, 'ENDTIM')
        controls%end_cycle = deck%integer(r, 'ENDCYC')
        controls%end_ratio = deck%real(r, 'ENDENG')/100.0_wp
      end if
      is_implicit = .false.
      r = deck%next('CONTROL_IMPLICIT_GENERAL', 1, 0)
      if (r > 0) then
        controls%dt = deck%real(r, 'DT0')
        is_implicit = deck%integer(r, 'IMFLAG') == 1
        if (deck%integer(r, 'IMFLAG') > 1) call deck%complain(r, 'IMFLAG', &
            'expected 1 (implicit) or 0 (explicit)')
      end if
      r = deck%next('CONTROL_IMPLICIT_DYNAMICS', 1, 0)
      controls%is_static = r == 0 .and. is_implicit
      if (r > 0) call read_dynamics(deck, controls, r)
      if (controls%is_static .and. r == 0) call add_note(deck%problems, &
          'no *CONTROL_IMPLICIT_DYNAMICS: the analysis is static')
      if (controls%is_static) then
        call refuse_dynamic(deck, 'BIPACT_TIME', 'SCHEME')
        call refuse_dynamic(deck, 'BIPACT_MASS', 'TYPE')
      else
        call read_scheme(deck, controls)
        call read_mass(deck, controls)
      end if
      call read_kinematics(deck, controls)
      call read_static(deck, controls)
      call read_timestep(deck, controls)
      if (.not. (controls%is_explicit .or. is_implicit)) call refuse_explicit(deck, controls)
      call read_steps(deck, controls)
      call check_steps(deck, controls)
      r = deck%next('BIPACT_LEDGER', 1, 0)
      if (r == 0) return
      controls%ledger_every = deck%integer(r, 'EVERY')
      controls%growth = deck%real(r, 'GROWTH')
      controls%stop_on_growth = deck%word(r, 'ACTION') == 'STOP'
    end associate
  end subroutine read_controls

  !> IMFLAG 0, or no *CONTROL_IMPLICIT_GENERAL, with what is implicit.
  subroutine refuse_explicit(deck, controls)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(in) :: controls
    character(:), allocatable :: why
    character(*), parameter :: hint = 'explicit runs name SCHEME CDLAGRANGE, or PAOLI '// &
        'with PBETA 0, on '// &
        '*BIPACT_TIME'
    integer :: r
    why = 'scheme '//trim(controls%scheme)//' of *BIPACT_TIME is implicit'
    if (controls%is_static) why = 'IMASS 0 of *CONTROL_IMPLICIT_DYNAMICS is static'
    r = deck%next('CONTROL_IMPLICIT_GENERAL', 1, 0)
    if (r > 0) then
      if (deck%integer(r, 'IMFLAG') == 0) &
          call deck%complain(r, 'IMFLAG', 'expected 1: '//why, hint)
    else
      call add_problem(deck%problems, deck%file(1)%path//': the deck needs '// &
          '*CONTROL_IMPLICIT_GENERAL with IMFLAG 1: '//why//new_line('a')//'    hint: '//hint)
    end if
  end subroutine refuse_explicit

  !> The number of steps must be countable, and whole for a mass that is tuned to the step; only
  !> explicit schemes find a step of their own.
  subroutine check_steps(deck, controls)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(in) :: controls
    real(wp) :: last_step
    integer :: r, steps
    r = deck%next('CONTROL_IMPLICIT_GENERAL', 1, 0)
    if (deck%problems%count > 0 .or. r == 0) return
    if (.not. controls%dt > zero) then
      if (.not. controls%is_explicit) call deck%complain(r, 'DT0', &
          'expected a number > 0: only an explicit scheme has a step of its own')
      if (controls%is_explicit .and. controls%static_until > zero) call deck%complain(r, &
          'DT0', 'expected a number > 0, for the static phase of TDYBIR on '// &
          '*CONTROL_IMPLICIT_DYNAMICS')
      return
    end if
    if (.not. controls%end_time/2.0e9_wp < controls%dt) then
      call deck%complain(r, 'DT0', 'ENDTIM/DT0 asks for more than 2e9 steps')
      return
    end if
    call count_steps(controls%end_time, controls%dt, steps, last_step)
    if (last_step > zero .and. controls%mass == 'DISPERSION' .and. controls%courant < zero) &
        call deck%complain(r, 'DT0', &
        'ENDTIM is no whole number of steps, to which the mass '//'DISPERSION is tuned', &
        'change ENDTIM or DT0, or give COURANT on *BIPACT_MASS')
  end subroutine check_steps

  subroutine read_dynamics(deck, controls, r)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    integer, intent(in) :: r
    real(wp), parameter :: near = 1.0e-12_wp    ! beta of a deck has few digits
    real(wp) :: rest
    integer :: steps
    controls%gamma = deck%real(r, 'GAMMA')
    controls%beta = deck%real(r, 'BETA')
    controls%is_static = deck%integer(r, 'IMASS') == 0
    if (.not. controls%is_static) controls%static_until = deck%real(r, 'TDYBIR')
    if (controls%static_until > zero .and. controls%dt > zero) then
      call count_steps(controls%static_until, controls%dt, steps, rest)
      if (rest > zero) call deck%complain(r, 'TDYBIR', &
          'expected a whole number of steps DT0 in the static phase')
    end if
    controls%alpha = deck%real(r, 'ALPHA')
    if (controls%alpha < -one/3.0_wp) call deck%complain(r, 'ALPHA', &
        'expected a number from -1/3 to below 0: alpha of HHT')
    if (4.0_wp*controls%beta < (one - near)*(controls%gamma + 0.5_wp)**2) &
        call deck%complain(r, 'BETA', 'expected BETA >= (GAMMA + 1/2)^2/4, the bound of '// &
        'unconditional stability', 'use GAMMA 0.5 with BETA 0.25')
  end subroutine read_dynamics

  !> Cards of inertia have no place in a static analysis.
  subroutine refuse_dynamic(deck, keyword, field)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: keyword, field
    integer :: r
    r = deck%next(keyword, 1, 0)
    if (r > 0) call deck%complain(r, field, '*'//keyword//' has no place in a static '// &
        'analysis (IMASS 0 of *CONTROL_IMPLICIT_DYNAMICS): remove it')
  end subroutine refuse_dynamic

  subroutine read_static(deck, controls)
    type(deck_t), intent(in) :: deck
    type(controls_t), intent(inout) :: controls
    integer :: r
    r = deck%next('BIPACT_STATIC', 1, 0)
    if (r == 0) return
    controls%static_shift = deck%real(r, 'SHIFT')
    controls%static_passes = deck%integer(r, 'MAXPASS')
    controls%static_residual = deck%real(r, 'RES')
  end subroutine read_static

  !> *BIPACT_TIME. Without it: THETA where there is contact and the deck gives neither GAMMA nor
  !> BETA, else NEWMARK.
  subroutine read_scheme(deck, controls)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    type(scheme_traits_t) :: traits
    integer :: r
    if (deck%next('BIPACT_TIME', 1, 0) == 0) call choose_scheme(deck)
    r = deck%next('BIPACT_TIME', 1, 0)
    controls%scheme = deck%word(r, 'SCHEME')
    traits = traits_of(controls%scheme)
    if (deck%is_given(r, 'THETA')) controls%theta = deck%real(r, 'THETA')
    controls%xi = controls%theta
    if (deck%is_given(r, 'XI')) controls%xi = deck%real(r, 'XI')
    call refuse_field(deck, r, controls%scheme, 'THETA', traits%takes_theta)
    call refuse_field(deck, r, controls%scheme, 'XI', traits%takes_theta)
    call refuse_field(deck, r, controls%scheme, 'RHOINF', traits%takes_rho)
    call refuse_field(deck, r, controls%scheme, 'PBETA', traits%takes_pbeta)
    if (deck%is_given(r, 'PBETA')) controls%pbeta = deck%real(r, 'PBETA')
    if (traits%is_explicit) controls%pbeta = zero
    controls%is_explicit = .not. controls%pbeta > zero
    if (controls%pbeta > zero .and. controls%pbeta < 0.25_wp) call deck%complain(r, 'PBETA', &
        'expected 0.25 (implicit) or 0 (explicit)')
    if (deck%is_given(r, 'RHOINF')) controls%rho = deck%real(r, 'RHOINF')
    call read_contact_law(deck, controls, traits, r)
    call check_dynamics(deck, controls, traits)
    if (traits%takes_gamma .or. traits%takes_alpha .or. traits%takes_rho) return
    if (abs(controls%gamma - 0.5_wp) > zero .or. abs(controls%beta - 0.25_wp) > zero) &
        call add_note(deck%problems, 'GAMMA and BETA have no effect: they are none of '// &
        'scheme '//trim(controls%scheme))
  end subroutine read_scheme

  !> Restitution and the rule of activation.
  subroutine read_contact_law(deck, controls, traits, r)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    type(scheme_traits_t), intent(in) :: traits
    integer, intent(in) :: r
    integer :: pair
    call refuse_field(deck, r, controls%scheme, 'REST', traits%takes_restitution)
    call refuse_field(deck, r, controls%scheme, 'RULE', traits%takes_rule)
    controls%is_safe = .not. deck%word(r, 'RULE') == 'PLAIN'
    controls%restitution = deck%real(r, 'REST')
    pair = deck%next('BIPACT_PAIR', 1, 0)
    do while (pair > 0)
      call refuse_field(deck, pair, trim(controls%scheme)//' of *BIPACT_TIME', 'REST', &
          traits%takes_restitution)
      if (deck%is_given(pair, 'REST') .and. traits%takes_restitution .and. &
          abs(deck%real(pair, 'REST') - controls%restitution) > zero) call add_note( &
          deck%problems, deck%place(pair)//': REST is another than that of *BIPACT_TIME: '// &
          'where both touch at once with friction, energy may rise')
      pair = deck%next('BIPACT_PAIR', 1, pair)
    end do
    if (controls%restitution > zero) call add_note(deck%problems, deck%place(r)// &
        ': REST is a number of the contact nodes, not the rebound of a deformable body')
  end subroutine read_contact_law

  !> ALPHA belongs to HHT, which computes gamma and beta of its own.
  subroutine check_dynamics(deck, controls, traits)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(in) :: controls
    type(scheme_traits_t), intent(in) :: traits
    real(wp), parameter :: near = 1.0e-12_wp
    integer :: r
    r = deck%next('CONTROL_IMPLICIT_DYNAMICS', 1, 0)
    if (r == 0) return
    if (traits%takes_alpha .and. .not. controls%alpha < zero) call deck%complain(r, 'ALPHA', &
        'scheme '//trim(traits%name)//' needs ALPHA from -1/3 to below 0')
    if (.not. traits%takes_alpha .and. controls%alpha < zero) call deck%complain(r, 'ALPHA', &
        'scheme '//trim(traits%name)//' of *BIPACT_TIME has no ALPHA: leave it blank')
    if (.not. (traits%takes_alpha .or. traits%takes_rho)) return
    if (abs(controls%gamma - 0.5_wp) > near .or. abs(controls%beta - 0.25_wp) > near) &
        call deck%complain(r, 'GAMMA', 'scheme '//trim(traits%name)// &
        ' computes gamma and beta of its own: leave GAMMA and BETA blank')
  end subroutine check_dynamics

  !> A field that the scheme does not use must be blank.
  subroutine refuse_field(deck, record, scheme, name, is_used)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    character(*), intent(in) :: scheme, name
    logical, intent(in) :: is_used
    if (.not. is_used .and. deck%is_given(record, name)) call deck%complain(record, name, &
        'scheme '//trim(scheme)//' has no '//name//': leave it blank')
  end subroutine refuse_field

  subroutine choose_scheme(deck)
    type(deck_t), intent(inout) :: deck
    character(13) :: scheme
    logical :: newmark
    integer :: r
    r = deck%next('CONTROL_IMPLICIT_DYNAMICS', 1, 0)
    newmark = .not. has_contact(deck)
    if (r > 0) newmark = newmark .or. deck%is_given(r, 'GAMMA') .or. deck%is_given(r, 'BETA')
    scheme = merge('NEWMARK,     ', 'THETA,0.5,0.5', newmark)
    if (r > 0) scheme = merge('HHT,         ', scheme, deck%real(r, 'ALPHA') < zero)
    call read_more(deck, '*BIPACT_TIME'//new_line('a')//trim(scheme))
    if (scheme == 'HHT,' .or. .not. has_contact(deck)) return
    if (newmark) then
      call add_warning(deck%problems, 'scheme', 'no *BIPACT_TIME, but GAMMA or BETA: it is '// &
          'NEWMARK, which gains energy without bound on impact; choose SCHEME THETA')
    else
      call add_note(deck%problems, 'no *BIPACT_TIME: the scheme is THETA with theta = xi = 1/2')
    end if
  end subroutine choose_scheme

  pure logical function has_contact(deck)
    type(deck_t), intent(in) :: deck
    integer :: k
    has_contact = .false.
    do k = 1, size(wall_keyword)
      has_contact = has_contact .or. deck%next(trim(wall_keyword(k)), 1, 0) > 0
    end do
    do k = 1, size(contact_keyword)
      has_contact = has_contact .or. deck%next(trim(contact_keyword(k)), 1, 0) > 0
    end do
  end function has_contact

  subroutine read_mass(deck, controls)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    type(scheme_traits_t) :: traits
    integer :: r
    logical :: midpoint
    r = deck%next('BIPACT_MASS', 1, 0)
    if (controls%is_explicit) call lump_mass(deck, controls, r)
    if (r == 0) return
    if (.not. controls%is_explicit) controls%mass = deck%word(r, 'TYPE')
    controls%redistribute = deck%integer(r, 'REDIST') == 1
    traits = traits_of(controls%scheme)
    if (controls%redistribute .and. .not. traits%takes_redist) &
        call deck%complain(r, 'REDIST', 'expected 0: scheme '//trim(controls%scheme)// &
        ' of *BIPACT_TIME does not damp what is left on massless nodes')
    if (controls%mass == 'DISPERSION' .and. .not. traits%takes_dispersion) &
        call deck%complain(r, 'TYPE', 'expected CONSISTENT or LUMPED: scheme '// &
        trim(controls%scheme)//' of *BIPACT_TIME inverts the mass, which may be singular '// &
        'with DISPERSION')
    if (controls%mass /= 'DISPERSION') then
      if (deck%is_given(r, 'COURANT')) call deck%complain(r, 'COURANT', &
          'only the mass DISPERSION has a Courant number: leave it blank')
      call refuse_wave(deck, r)
      return
    end if
    if (deck%is_given(r, 'COURANT')) controls%courant = deck%real(r, 'COURANT')
    call read_wave(deck, r, controls)
    midpoint = is_midpoint(controls, traits)
    if (.not. midpoint) call add_warning(deck%problems, 'mass', 'the mass DISPERSION is '// &
        'tuned to theta = xi = 1/2 (gamma 1/2, beta 1/4): other values lose its accuracy, '// &
        'take these or another mass')
  end subroutine read_mass

  !> An explicit scheme has lumped masses, asked for or not.
  subroutine lump_mass(deck, controls, r)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    integer, intent(in) :: r
    logical :: is_given
    controls%mass = 'LUMPED'
    is_given = .false.
    if (r > 0) is_given = deck%is_given(r, 'TYPE')
    if (.not. is_given) then
      call add_note(deck%problems, 'the mass is LUMPED: scheme '//trim(controls%scheme)// &
          ' is explicit')
    else if (deck%word(r, 'TYPE') /= controls%mass) then
      call deck%complain(r, 'TYPE', 'expected LUMPED: scheme '//trim(controls%scheme)// &
          ' of *BIPACT_TIME is explicit')
    end if
  end subroutine lump_mass

  !> Is a scheme the mid-point rule for waves? The mass DISPERSION is tuned to that.
  pure logical function is_midpoint(controls, traits)
    type(controls_t), intent(in) :: controls
    type(scheme_traits_t), intent(in) :: traits
    is_midpoint = .true.
    if (traits%takes_theta) then
      is_midpoint = .not. (abs(controls%theta - 0.5_wp) > zero &
          .or. abs(controls%xi - 0.5_wp) > zero)
    else if (traits%takes_gamma) then
      is_midpoint = .not. (abs(controls%gamma - 0.5_wp) > zero &
          .or. abs(controls%beta - 0.25_wp) > zero)
    else if (traits%takes_rho) then
      is_midpoint = .not. abs(controls%rho - one) > zero
    else if (traits%takes_alpha) then
      is_midpoint = .false.
    end if
  end function is_midpoint

  !> *BIPACT_CONTACT and *BIPACT_SOLVER.
  subroutine read_solver_options(deck, controls, cone, solver)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    type(cone_options_t), intent(inout) :: cone
    type(solver_options_t), intent(inout) :: solver
    integer :: r, second
    r = deck%next('BIPACT_CONTACT', 1, 0)
    if (r > 0) then
      cone%solver = find_solver(deck%word(r, 'SOLVER'))
      cone%tolerance = deck%real(r, 'TOL')
      cone%max_sweeps = deck%integer(r, 'MAXIT')
      cone%rho_factor = deck%real(r, 'RHO')
      cone%local = local_solver(deck%word(r, 'LOCAL'))
      cone%local_tolerance = deck%real(r, 'LTOL')
      cone%max_local = deck%integer(r, 'LMAXIT')
      cone%warm_start = deck%integer(r, 'WARM') == 1
      second = deck%follow(r, 2)
      if (second > 0) then
        solver%contact_storage = deck%word(second, 'WSTORE')
        controls%penetration_tolerance = deck%real(second, 'PENTOL')
        controls%frame = deck%word(second, 'FRAME')
        if (controls%is_finite .and. controls%frame == 'REF') call deck%complain(second, &
            'FRAME', 'normals of the reference have no meaning at finite deformation', &
            'leave it blank, for MID')
        controls%rotation_warning = deck%real(second, 'ROTWARN')
        controls%dump_first = deck%integer(second, 'DFIRST')
        controls%dump_last = max(controls%dump_first, deck%integer(second, 'DLAST'))
        controls%dump_every = deck%integer(second, 'DEVERY')
      end if
    end if
    r = deck%next('BIPACT_SOLVER', 1, 0)
    if (r == 0) return
    solver%engine = deck%word(r, 'ENGINE')
    solver%order = deck%word(r, 'ORDER')
    solver%block_limit = deck%integer(r, 'NLAST')
    solver%tolerance = deck%real(r, 'CGTOL')
    solver%most_iterations = deck%integer(r, 'CGMAX')
    solver%threads = deck%integer(r, 'THREADS')
    call check_engine(deck, controls, solver, r)
  end subroutine read_solver_options

  !> The engine of diagonal matrices is that of explicit schemes alone, and theirs alone; only a
  !> static phase before them has a matrix to factor.
  subroutine check_engine(deck, controls, solver, r)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(in) :: controls
    type(solver_options_t), intent(in) :: solver
    integer, intent(in) :: r
    character(:), allocatable :: why
    why = 'scheme '//trim(controls%scheme)//' of *BIPACT_TIME'
    if (controls%is_static) why = 'the static analysis'
    if (controls%static_until > zero) why = 'the static phase (TDYBIR of '// &
        '*CONTROL_IMPLICIT_DYNAMICS)'
    if (controls%is_explicit .and. .not. controls%static_until > zero) then
      if (solver%engine /= 'AUTO' .and. solver%engine /= engine_diagonal) &
          call deck%complain(r, 'ENGINE', 'expected AUTO or '//engine_diagonal//': '//why// &
          ' is explicit, its matrix is diagonal')
      if (solver%order /= 'AUTO') call deck%complain(r, 'ORDER', 'expected AUTO: '//why// &
          ' is explicit, nothing is eliminated from its diagonal matrix')
    else if (solver%engine == engine_diagonal) then
      call deck%complain(r, 'ENGINE', 'expected another engine: the matrix of '//why// &
          ' is not diagonal')
    end if
  end subroutine check_engine

  !> One note for each keyword that was read and checked but has no effect.
  subroutine note_keywords(deck)
    type(deck_t), intent(inout) :: deck
    integer :: b
    do b = 1, deck%blocks
      associate (k => deck%table%keyword(deck%block(b)%keyword))
        if (k%noted) &
            call add_note(deck%problems, '*'//trim(k%name)//' has no effect: '//trim(k%help))
        if (is_of_others(deck, trim(k%canonical))) call add_note(deck%problems, '*'// &
            trim(deck%block(b)%written)//' is skipped: '//trim(merge('models in space', &
            'plane models   ', deck%in_space))//' have no such elements')
      end associate
    end do
  end subroutine note_keywords

  !> Is a keyword a set or request of shells in space, or of solids in the plane?
  pure logical function is_of_others(deck, name)
    type(deck_t), intent(in) :: deck
    character(*), intent(in) :: name
    character(5) :: other
    other = merge('SHELL', 'SOLID', deck%in_space)
    is_of_others = index(name, 'SET_'//other) == 1 .or. &
        index(name, 'DATABASE_HISTORY_'//other) == 1
  end function is_of_others

end module scene_controls
