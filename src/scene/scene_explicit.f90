! SPDX-License-Identifier: BSD-3-Clause
!> The step of explicit schemes: the limit that the elements set, and DT0 from it.
module scene_explicit
  use base_kinds, only: wp, zero, one
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_note, add_problem
  use element_limit, only: stable_step
  use model_data, only: model_t, controls_t
  implicit none
  private
  public :: read_timestep, find_step

  !> Two limits, or numbers of steps, are the same: the digits of an eigenvalue.
  real(wp), parameter :: slack = 1.0e-12_wp

contains

  !> *CONTROL_TIMESTEP: what it cannot mean here.
  subroutine read_timestep(deck, controls)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(in) :: controls
    integer :: r
    r = deck%next('CONTROL_TIMESTEP', 1, 0)
    if (r == 0) return
    if (.not. controls%is_explicit) then
      call add_note(deck%problems, '*CONTROL_TIMESTEP has no effect: it concerns explicit '// &
          'steps; mass scaling (DT2MS) must be blank')
      return
    end if
    if (deck%next('CONTROL_TIMESTEP', 1, r) > 0) call deck%complain(deck%next( &
        'CONTROL_TIMESTEP', 1, r), 'TSSFAC', &
        'expected one *CONTROL_TIMESTEP in an explicit run')
    if (.not. (deck%real(r, 'TSSFAC') > zero .and. deck%real(r, 'TSSFAC') <= one)) &
        call deck%complain(r, 'TSSFAC', 'expected a number > 0 and <= 1: the limit of the '// &
        'elements is the largest stable step')
    if (abs(deck%real(r, 'LCTM')) > zero) call deck%complain(r, 'LCTM', &
        'expected blank or 0: all steps of an explicit run are equal')
    if (abs(deck%real(r, 'DTINIT')) > zero) call add_note(deck%problems, &
        'DTINIT of *CONTROL_TIMESTEP has no effect: all steps are equal')
  end subroutine read_timestep

  !> DT0 against the limit of the elements; where the deck leaves it blank, the longest step of
  !> which ENDTIM is a whole number, up to TSSFAC times the limit.
  subroutine find_step(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    integer :: r
    call find_limit(model)
    associate (c => model%controls)
      if (.not. c%dt > zero) then
        call choose_step(deck, c)
      else if (c%limit_element == 0) then
        return    ! rigid parts alone set no limit
      else if (c%dt > c%step_limit*(one + slack)) then
        r = deck%next('CONTROL_IMPLICIT_GENERAL', 1, 0)
        call deck%complain(r, 'DT0', 'expected at most '//limit_text(c)// &
            ', the limit of element '//to_text(c%limit_element)//': scheme '// &
            trim(c%scheme)//' of *BIPACT_TIME is explicit', 'leave DT0 blank: then it is '// &
            'TSSFAC of *CONTROL_TIMESTEP (0.9) times the limit')
      end if
    end associate
  end subroutine find_step

  !> The limit in seven digits, rounded down: who takes it as DT0 keeps to it.
  function limit_text(controls) result(text)
    type(controls_t), intent(in) :: controls
    character(:), allocatable :: text
    text = to_text(controls%step_limit*(one - 5.0e-7_wp))
  end function limit_text

  subroutine choose_step(deck, controls)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    real(wp) :: factor, steps
    integer :: r
    factor = 0.9_wp
    r = deck%next('CONTROL_TIMESTEP', 1, 0)
    if (r > 0) factor = deck%real(r, 'TSSFAC')
    if (controls%limit_element == 0) then
      call add_problem(deck%problems, deck%file(1)%path//': all parts are rigid and set no '// &
          'limit to the step: give DT0 of *CONTROL_IMPLICIT_GENERAL')
      return
    end if
    steps = controls%end_time/(factor*controls%step_limit)
    if (.not. steps < 2.0e9_wp) then
      call add_problem(deck%problems, deck%file(1)%path//': ENDTIM of *CONTROL_TERMINATION '// &
          'asks for more than 2e9 steps of '//to_text(factor*controls%step_limit)// &
          ', which element '//to_text(controls%limit_element)//' allows')
      return
    end if
    controls%dt = controls%end_time/max(1, ceiling(steps*(one - slack)))
    call add_note(deck%problems, 'DT0 is '//to_text(controls%dt)//': ENDTIM is a whole '// &
        'number of such steps, and they are at most TSSFAC = '//to_text(factor)//' times '// &
        limit_text(controls)//', the limit of element '//to_text(controls%limit_element))
  end subroutine choose_step

  !> The smallest of the largest stable steps of all elements, and the first that has it.
  subroutine find_limit(model)
    type(model_t), intent(inout) :: model
    real(wp) :: h
    integer :: e
    associate (c => model%controls)
      do e = 1, model%mesh%n
        if (model%part(model%mesh%part(e))%is_rigid) cycle
        associate (part => model%part(model%mesh%part(e)))
          associate (material => model%material(part%material)%item)
            call stable_step(model%mesh%kind(model%mesh%type(e))%item, &
                model%x(:, model%mesh%nodes_of(e)), material%density, &
                material%moduli(part%plane), part%thickness, h)
          end associate
        end associate
        h = damped_step(model, model%mesh%part(e), h)
        if (h >= c%step_limit*(one - slack)) cycle
        c%step_limit = h
        c%limit_element = model%mesh%id(e)
      end do
    end associate
  end subroutine find_limit

  !> The limit h [T] of an element of a part with the damping of the deck, which acts with the
  !> velocity of the half step before: h^2 omega^2 + 2 h (a + b omega^2) <= 4 with
  !> omega = 2/h of the undamped one, a [1/T] by mass, at its largest, b [T] by stiffness.
  pure real(wp) function damped_step(model, part, h)
    type(model_t), intent(in) :: model
    integer, intent(in) :: part
    real(wp), intent(in) :: h
    real(wp) :: omega2, rate, a
    integer :: k
    damped_step = h
    omega2 = 4.0_wp/h**2
    rate = zero
    if (allocated(model%stiffness_damping)) rate = model%stiffness_damping(part)*omega2
    if (allocated(model%mass_damping)) then
      do k = 1, size(model%mass_damping)
        associate (card => model%mass_damping(k))
          if (.not. any(card%part == part)) cycle
          a = card%factor*maxval(abs(card%scale))
          if (card%curve > 0) a = a*maxval(abs(model%curve(card%curve)%o))
          rate = rate + a
        end associate
      end do
    end if
    if (rate > zero) damped_step = 4.0_wp/(rate + sqrt(rate**2 + 4.0_wp*omega2))
  end function damped_step

end module scene_explicit
