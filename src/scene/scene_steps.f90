! SPDX-License-Identifier: BSD-3-Clause
!> Length of the steps: *BIPACT_STEP, or *CONTROL_IMPLICIT_AUTO in its place.
module scene_steps
  use base_kinds, only: wp, zero
  use deck_data, only: deck_t
  use deck_names, only: step_fixed, step_halve, step_event, step_modes
  use deck_problems, only: add_note
  use deck_schemes, only: traits_of
  use model_data, only: controls_t
  implicit none
  private
  public :: read_steps

  !> Two lengths of a step are the same: the digits of a deck.
  real(wp), parameter :: near = 1.0e-9_wp

contains

  !> MODE and its limits; which scheme and analysis may have it.
  subroutine read_steps(deck, controls)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    integer :: own, auto
    controls%shortest_step = controls%dt/1024.0_wp
    own = deck%next('BIPACT_STEP', 1, 0)
    if (own > 0) call read_own(deck, controls, own)
    auto = deck%next('CONTROL_IMPLICIT_AUTO', 1, 0)
    if (auto == 0) return
    if (deck%integer(auto, 'IAUTO') == 0) then
      call add_note(deck%problems, '*CONTROL_IMPLICIT_AUTO has no effect: with IAUTO 0 '// &
          'all steps are DT0')
    else if (own > 0) then
      call deck%complain(auto, 'IAUTO', 'IAUTO 1 stands for *BIPACT_STEP, MODE HALVE, and '// &
          'the deck has a *BIPACT_STEP too', 'remove one of the two cards')
    else
      call read_auto(deck, controls, auto)
    end if
  end subroutine read_steps

  subroutine read_own(deck, controls, r)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    integer, intent(in) :: r
    character(:), allocatable :: mode
    mode = trim(deck%word(r, 'MODE'))
    if (mode == step_modes(step_halve)) controls%step_mode = step_halve
    if (mode == step_modes(step_event)) controls%step_mode = step_event
    call check_mode(deck, controls, r, 'MODE', 'MODE '//mode//' of *BIPACT_STEP')
    if (controls%step_mode == step_halve) then
      if (deck%is_given(r, 'MAXHALF')) controls%most_halvings = deck%integer(r, 'MAXHALF')
      if (deck%is_given(r, 'DTMIN')) call set_shortest(deck, controls, r)
      return
    end if
    if (deck%is_given(r, 'DTMIN')) call deck%complain(r, 'DTMIN', &
        'MODE '//mode//' has no DTMIN: leave it blank')
    if (deck%is_given(r, 'MAXHALF')) call deck%complain(r, 'MAXHALF', &
        'MODE '//mode//' has no MAXHALF: leave it blank')
  end subroutine read_own

  !> IAUTO 1.
  subroutine read_auto(deck, controls, r)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    integer, intent(in) :: r
    real(wp) :: longest
    controls%step_mode = step_halve
    call check_mode(deck, controls, r, 'IAUTO', 'IAUTO 1 of *CONTROL_IMPLICIT_AUTO')
    if (deck%real(r, 'DTMIN') > zero) call set_shortest(deck, controls, r)
    longest = deck%real(r, 'DTMAX')
    if (abs(longest) > zero .and. abs(longest - controls%dt) > near*controls%dt) &
        call deck%complain(r, 'DTMAX', 'expected blank or DT0: no step is longer than DT0', &
        'give the longest step as DT0 of *CONTROL_IMPLICIT_GENERAL')
    call add_note(deck%problems, '*CONTROL_IMPLICIT_AUTO is MODE HALVE of *BIPACT_STEP: '// &
        'ITEOPT is not used, a step is halved where it is refused')
  end subroutine read_auto

  !> What a mode asks of scheme and analysis; its card is named in mode.
  subroutine check_mode(deck, controls, r, field, mode)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(in) :: controls
    integer, intent(in) :: r
    character(*), intent(in) :: field, mode
    if (controls%step_mode == step_fixed) return
    if (controls%is_static) then
      if (controls%step_mode == step_event) call deck%complain(r, field, mode// &
          ' has no place in a static analysis (IMASS 0 of *CONTROL_IMPLICIT_DYNAMICS)', &
          'take MODE FIXED or HALVE')
    else
      associate (traits => traits_of(controls%scheme))
        if (traits%is_two_step) call deck%complain(r, field, 'scheme '// &
            trim(controls%scheme)//' of *BIPACT_TIME takes equal steps, '//mode//' does not', &
            'take MODE FIXED, or another scheme')
        if (controls%step_mode == step_event .and. .not. traits%takes_event) &
            call deck%complain(r, field, 'scheme '//trim(controls%scheme)// &
            ' of *BIPACT_TIME poses contact on velocities, '//mode//' is for positions alone', &
            'take MODE FIXED or HALVE, or another scheme')
      end associate
    end if
  end subroutine check_mode

  subroutine set_shortest(deck, controls, r)
    type(deck_t), intent(inout) :: deck
    type(controls_t), intent(inout) :: controls
    integer, intent(in) :: r
    controls%shortest_step = deck%real(r, 'DTMIN')
    if (controls%shortest_step > controls%dt) call deck%complain(r, 'DTMIN', &
        'expected at most DT0')
  end subroutine set_shortest

end module scene_steps
