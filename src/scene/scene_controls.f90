! SPDX-License-Identifier: BSD-3-Clause
!> Time, scheme, mass, solver options, contact cards and output requests: from cards to the
!> model.
module scene_controls
  use base_kinds, only: wp, zero
  use base_strings, only: to_text
  use cone_types, only: cone_options_t
  use deck_data, only: deck_t
  use deck_problems, only: add_warning, add_note, add_problem
  use linalg_solver, only: solver_options_t
  use model_data, only: model_t, controls_t, contact_card_t, find_set
  use scene_ids, only: id_map_t
  implicit none
  private
  public :: read_controls, read_contacts, read_requests, read_solver_options

contains

  !> First record of a keyword that may stand once; 0 if it is absent. A second one is a
  !> problem.
  integer function only_record(deck, keyword)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: keyword
    integer :: b
    b = deck%next_block(keyword, 0)
    only_record = 0
    if (b == 0) return
    if (deck%block(b)%last >= deck%block(b)%first) only_record = deck%block(b)%first
    b = deck%next_block(keyword, b)
    if (b == 0 .or. only_record == 0) return
    if (deck%block(b)%last >= deck%block(b)%first) call deck%complain(deck%block(b)%first, '', &
        '*'//keyword//' stands twice', 'the first is at '//deck%place(only_record))
  end function only_record

  subroutine require(deck, keyword, record)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: keyword
    integer, intent(out) :: record
    record = only_record(deck, keyword)
    if (record == 0) &
        call add_problem(deck%problems, deck%file(1)%path//': the deck needs *'//keyword)
  end subroutine require

  !> Time and scheme, mass, ledger.
  subroutine read_controls(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    integer :: r
    r = only_record(deck, 'TITLE')
    if (r > 0) model%title = deck%word(r, 'TITLE')
    call require(deck, 'CONTROL_TERMINATION', r)
    if (r > 0) then
      model%controls%end_time = deck%real(r, 'ENDTIM')
      model%controls%end_cycle = deck%integer(r, 'ENDCYC')
    end if
    call require(deck, 'CONTROL_IMPLICIT_GENERAL', r)
    if (r > 0) then
      model%controls%dt = deck%real(r, 'DT0')
      if (deck%integer(r, 'IMFLAG') /= 1) call deck%complain(r, 'IMFLAG', &
          'expected 1: explicit integration is not available in this version')
    end if
    call require(deck, 'CONTROL_IMPLICIT_DYNAMICS', r)
    if (r > 0) call read_dynamics(deck, model%controls, r)
    r = only_record(deck, 'CONTROL_IMPLICIT_SOLUTION')
    call read_scheme(deck, model%controls)
    call read_mass(deck, model%controls)
    r = only_record(deck, 'BIPACT_LEDGER')
    if (r == 0) return
    model%controls%ledger_every = deck%integer(r, 'EVERY')
    model%controls%growth = deck%real(r, 'GROWTH')
    call check_word(deck, r, 'ACTION', ['WARN', 'STOP'])
    model%controls%stop_on_growth = deck%word(r, 'ACTION') == 'STOP'
  end subroutine read_controls

  subroutine read_dynamics(deck, controls, r)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    integer, intent(in) :: r
    controls%gamma = deck%real(r, 'GAMMA')
    controls%beta = deck%real(r, 'BETA')
    if (deck%integer(r, 'IMASS') /= 1) call deck%complain(r, 'IMASS', &
        'expected 1: static analysis is not available in this version')
    if (4.0_wp*controls%beta < (controls%gamma + 0.5_wp)**2) call deck%complain(r, 'BETA', &
        'expected BETA >= (GAMMA + 1/2)^2/4, the bound of unconditional stability', &
        'use GAMMA 0.5 with BETA 0.25')
  end subroutine read_dynamics

  !> *BIPACT_TIME; without it the scheme is Newmark, as the other cards say.
  subroutine read_scheme(deck, controls)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    integer :: r
    r = only_record(deck, 'BIPACT_TIME')
    if (r == 0) then
      controls%scheme = 'NEWMARK'
      if (deck%next_block('CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE', 0) > 0) &
          call add_warning(deck%problems, &
          'no *BIPACT_TIME: the scheme is NEWMARK, which gains '// &
          'energy without bound on impact; choose SCHEME THETA')
      return
    end if
    controls%scheme = deck%word(r, 'SCHEME')
    call check_word(deck, r, 'SCHEME', ['THETA  ', 'NEWMARK'])
    controls%theta = deck%real(r, 'THETA')
    controls%xi = controls%theta
    if (deck%is_given(r, 'XI')) controls%xi = deck%real(r, 'XI')
    if (controls%scheme /= 'NEWMARK') return
    if (deck%is_given(r, 'THETA')) &
        call deck%complain(r, 'THETA', 'NEWMARK has no theta: leave it blank')
    if (deck%is_given(r, 'XI')) call deck%complain(r, 'XI', 'NEWMARK has no xi: leave it blank')
  end subroutine read_scheme

  subroutine read_mass(deck, controls)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    integer :: r
    logical :: midpoint
    r = only_record(deck, 'BIPACT_MASS')
    if (r == 0) return
    controls%mass = deck%word(r, 'TYPE')
    call check_word(deck, r, 'TYPE', ['CONSISTENT', 'LUMPED    ', 'DISPERSION'])
    controls%redistribute = deck%integer(r, 'REDIST') == 1
    if (controls%mass /= 'DISPERSION') then
      if (deck%is_given(r, 'COURANT')) call deck%complain(r, 'COURANT', &
          'only the mass DISPERSION has a Courant number: leave it blank')
      return
    end if
    if (deck%is_given(r, 'COURANT')) controls%courant = deck%real(r, 'COURANT')
    if (controls%scheme == 'NEWMARK') then
      midpoint = &
          .not. (abs(controls%gamma - 0.5_wp) > zero .or. abs(controls%beta - 0.25_wp) > zero)
    else
      midpoint = &
          .not. (abs(controls%theta - 0.5_wp) > zero .or. abs(controls%xi - 0.5_wp) > zero)
    end if
    if (.not. midpoint) call add_warning(deck%problems, 'the mass DISPERSION is tuned to '// &
        'theta = xi = 1/2 (gamma 1/2, beta 1/4): other values lose its accuracy')
  end subroutine read_mass

  !> A word field must be one of a list.
  subroutine check_word(deck, record, field, known)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    character(*), intent(in) :: field
    character(*), intent(in) :: known(:)
    character(:), allocatable :: list
    integer :: k
    if (any(known == deck%word(record, field))) return
    list = trim(known(1))
    do k = 2, size(known)
      list = list//', '//trim(known(k))
    end do
    call deck%complain(record, field, 'expected one of '//list//', found "'// &
        deck%word(record, field)//'"', 'other values are not available in this version')
  end subroutine check_word

  !> *BIPACT_CONTACT and *BIPACT_SOLVER.
  subroutine read_solver_options(deck, controls, cone, solver)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    type(cone_options_t), intent(inout) :: cone
    type(solver_options_t), intent(inout) :: solver
    integer :: r
    r = only_record(deck, 'BIPACT_CONTACT')
    if (r > 0) then
      cone%solver = deck%word(r, 'SOLVER')
      call check_word(deck, r, 'SOLVER', ['AUTO', 'GS  '])
      cone%tolerance = deck%real(r, 'TOL')
      cone%max_sweeps = deck%integer(r, 'MAXIT')
      cone%rho_factor = deck%real(r, 'RHO')
      cone%local_tolerance = deck%real(r, 'LTOL')
      cone%max_local = deck%integer(r, 'LMAXIT')
      cone%warm_start = deck%integer(r, 'WARM') == 1
      if (deck%block(deck%record(r)%block)%last > r) then
        call check_word(deck, r + 1, 'WSTORE', ['AUTO ', 'DENSE'])
        controls%penetration_tolerance = deck%real(r + 1, 'PENTOL')
        controls%rotation_warning = deck%real(r + 1, 'ROTWARN')
      end if
    end if
    r = only_record(deck, 'BIPACT_SOLVER')
    if (r == 0) return
    solver%engine = deck%word(r, 'ENGINE')
    call check_word(deck, r, 'ENGINE', ['AUTO   ', 'LDLT   ', 'SKYLINE'])
    solver%order = deck%word(r, 'ORDER')
    call check_word(deck, r, 'ORDER', ['AUTO   ', 'NATURAL', 'RCM    ', 'METIS  '])
    call check_word(deck, r, 'SCHUR', ['AUTO', 'YES '])
    solver%block_limit = deck%integer(r, 'NLAST')
  end subroutine read_solver_options

  !> *CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE.
  subroutine read_contacts(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(contact_card_t) :: card
    integer :: b, r, s
    character(5), parameter :: side(2) = ['SURFA', 'SURFB']
    allocate (model%contact(0))
    b = deck%next_block('CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE', 0)
    do while (b > 0)
      r = deck%block(b)%first
      card%record = r
      card%id = size(model%contact) + 1
      if (deck%block(b)%id > 0) card%id = deck%block(b)%id
      card%mu = deck%real(r, 'FS')
      card%birth = zero
      card%death = huge(zero)
      if (deck%block(b)%last > r) then
        card%birth = deck%real(r + 1, 'TBIRTH')
        card%death = deck%real(r + 1, 'TDEATH')
      end if
      do s = 1, 2
        card%side(s) = deck%integer(r, side(s))
        if (card%side(s) < 0) then
          if (find_set(model%node_set, -card%side(s)) == 0) call deck%complain(r, side(s), &
              'node set '//to_text(-card%side(s))//' is not defined')
        else if (find_set(model%part_set, card%side(s)) == 0) then
          call deck%complain(r, side(s), 'part set '//to_text(card%side(s))// &
              ' is not defined', 'SURFA and SURFB are part sets; negative: node sets')
        end if
      end do
      model%contact = [model%contact, card]
      b = deck%next_block('CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE', b)
    end do
  end subroutine read_contacts

  !> Tables and their nodes.
  subroutine read_requests(deck, model, nodes)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(id_map_t), intent(in) :: nodes
    call read_interval(deck, 'DATABASE_GLSTAT', model%requests%glstat)
    call read_interval(deck, 'DATABASE_MATSUM', model%requests%matsum)
    call read_interval(deck, 'DATABASE_NODOUT', model%requests%nodout)
    call read_interval(deck, 'DATABASE_RCFORC', model%requests%rcforc)
    call read_interval(deck, 'DATABASE_SLEOUT', model%requests%sleout)
    call read_interval(deck, 'BIPACT_TIMING', model%requests%timing)
    call read_history(deck, model, nodes)
    if (model%requests%nodout > zero .and. size(model%requests%history_node) == 0) then
      call add_note(deck%problems, '*DATABASE_NODOUT without *DATABASE_HISTORY_NODE: no table')
      model%requests%nodout = zero
    end if
  end subroutine read_requests

  subroutine read_interval(deck, keyword, interval)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: keyword
    real(wp), intent(inout) :: interval
    integer :: r
    r = only_record(deck, keyword)
    if (r > 0) interval = deck%real(r, 'DT')
  end subroutine read_interval

  subroutine read_history(deck, model, nodes)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(id_map_t), intent(in) :: nodes
    character(25), parameter :: keyword(2) = ['DATABASE_HISTORY_NODE    ', &
                                              'DATABASE_HISTORY_NODE_SET']
    integer :: k, b, r, m, id, row
    allocate (model%requests%history_node(0))
    do k = 1, 2
      b = deck%next_block(trim(keyword(k)), 0)
      do while (b > 0)
        do r = deck%block(b)%first, deck%block(b)%last
          do m = 1, 8
            id = nint(deck%value(deck%record(r)%start + m))
            if (id == 0) cycle
            if (k == 1) row = nodes%find(id)
            if (k == 2) row = find_set(model%node_set, id)
            if (row == 0) then
              call deck%complain(r, 'ID'//achar(48 + m), trim(merge('node    ', 'node set', &
                  k == 1))//' '//to_text(id)//' is not defined')
            else if (k == 1) then
              model%requests%history_node = [model%requests%history_node, row]
            else
              model%requests%history_node = [model%requests%history_node, &
                  model%node_set(row)%member]
            end if
          end do
        end do
        b = deck%next_block(trim(keyword(k)), b)
      end do
    end do
  end subroutine read_history

end module scene_controls
