! SPDX-License-Identifier: BSD-3-Clause
!> Damping: from cards to the model. By mass: *DAMPING_GLOBAL, *DAMPING_PART_MASS(_SET); by
!> stiffness: *DAMPING_PART_STIFFNESS(_SET).
module scene_damping
  use base_kinds, only: wp, zero
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_note
  use deck_schemes, only: scheme_traits_t, traits_of
  use model_data, only: model_t, mass_damping_t
  use scene_ids, only: maps_t, records_of, find_or_complain
  use scene_loads, only: curve_of
  implicit none
  private
  public :: read_damping

contains

  !> All cards of damping; a static analysis has none.
  subroutine read_damping(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    call read_mass_damping(deck, model, maps)
    call read_stiffness_damping(deck, model, maps)
    if (.not. (allocated(model%mass_damping) .or. allocated(model%stiffness_damping))) return
    if (model%controls%is_static) then
      call add_note(deck%problems, 'the analysis is static: damping has no effect')
      if (allocated(model%mass_damping)) deallocate (model%mass_damping)
      if (allocated(model%stiffness_damping)) deallocate (model%stiffness_damping)
    else if (model%controls%static_until > zero) then
      call add_note(deck%problems, 'damping has no effect before TDYBIR, in the static phase')
    end if
  end subroutine read_damping

  !> Damping by mass: that of all parts, then that of single ones.
  subroutine read_mass_damping(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    integer, allocatable :: card(:), of_set(:)
    integer :: owner(size(model%part))
    integer :: k, n, r
    call records_of(deck, 'DAMPING_PART_MASS', 1, card)
    call records_of(deck, 'DAMPING_PART_MASS_SET', 1, of_set)
    r = deck%next('DAMPING_GLOBAL', 1, 0)
    n = 0
    if (r > 0) n = merge(1, 0, deck%integer(r, 'LCID') > 0 .or. deck%real(r, 'VALDMP') > zero)
    if (n + size(card) + size(of_set) == 0) return
    allocate (model%mass_damping(n + size(card) + size(of_set)))
    owner = 0
    if (n == 1) call read_global(deck, model, maps, r, model%mass_damping(1))
    if (n == 1) owner = r
    do k = 1, size(card)
      call read_part_mass(deck, model, maps, card(k), .false., owner, &
          model%mass_damping(n + k))
    end do
    n = n + size(card)
    do k = 1, size(of_set)
      call read_part_mass(deck, model, maps, of_set(k), .true., owner, &
          model%mass_damping(n + k))
    end do
  end subroutine read_mass_damping

  !> *DAMPING_GLOBAL.
  subroutine read_global(deck, model, maps, r, damping)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: r
    type(mass_damping_t), intent(inout) :: damping
    character(3), parameter :: scale(6) = ['STX', 'STY', 'STZ', 'SRX', 'SRY', 'SRZ']
    real(wp) :: value(6)
    integer :: k
    call refuse_by_scheme(deck, model, r, 'VALDMP')
    value = [(deck%real(r, scale(k)), k=1, 6)]
    if (any(abs(value) > zero)) damping%scale = value(1:3)
    damping%factor = deck%real(r, 'VALDMP')
    if (deck%integer(r, 'LCID') > 0) then
      damping%curve = curve_of(deck, model, maps, r)
      if (damping%factor > zero) call add_note(deck%problems, &
          'VALDMP of *DAMPING_GLOBAL has no effect: LCID gives the coefficient')
      damping%factor = 1.0_wp
      call check_curve(deck, model, r, damping%curve)
    end if
    allocate (damping%part(size(model%part)))
    damping%part = [(k, k=1, size(model%part))]
  end subroutine read_global

  !> One card of *DAMPING_PART_MASS or _SET. owner: the card that damps each part already.
  subroutine read_part_mass(deck, model, maps, r, is_set, owner, damping)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: r
    logical, intent(in) :: is_set
    integer, intent(inout) :: owner(:)
    type(mass_damping_t), intent(inout) :: damping
    call refuse_by_scheme(deck, model, r, 'LCID')
    call parts_of(deck, model, maps, r, is_set, damping%part)
    call claim(deck, model, r, is_set, damping%part, 'mass', owner)
    damping%factor = deck%real(r, 'SF')
    damping%curve = curve_of(deck, model, maps, r)
    call check_curve(deck, model, r, damping%curve)
  end subroutine read_part_mass

  !> *DAMPING_PART_STIFFNESS and _SET.
  subroutine read_stiffness_damping(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    character(26), parameter :: keyword(2) = [character(26) :: 'DAMPING_PART_STIFFNESS', &
        'DAMPING_PART_STIFFNESS_SET']
    integer, allocatable :: card(:), part(:)
    integer :: owner(size(model%part))
    real(wp) :: coefficient(size(model%part))
    integer :: k, m
    owner = 0
    coefficient = zero
    do k = 1, 2
      call records_of(deck, trim(keyword(k)), 1, card)
      do m = 1, size(card)
        call refuse_by_scheme(deck, model, card(m), 'COEF')
        call parts_of(deck, model, maps, card(m), k == 2, part)
        call claim(deck, model, card(m), k == 2, part, 'stiffness', owner)
        coefficient(part) = -deck%real(card(m), 'COEF')
        if (any(coefficient(part) < zero)) call deck%complain(card(m), 'COEF', &
            'expected a number below 0: damping by a fraction of the critical one (above '// &
            '0) is not available in this version', 'give minus the coefficient of Rayleigh '// &
            '[T]: at the angular frequency w it is the fraction |COEF| w/2')
      end do
    end do
    if (any(coefficient > zero)) allocate (model%stiffness_damping, source=coefficient)
  end subroutine read_stiffness_damping

  !> Rows of the part (PID) or of the part set (PSID) that a card names.
  subroutine parts_of(deck, model, maps, r, is_set, part)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: r
    logical, intent(in) :: is_set
    integer, allocatable, intent(out) :: part(:)
    integer :: row
    if (is_set) then
      row = find_or_complain(deck, maps%part_set, r, 'PSID', deck%integer(r, 'PSID'), &
          'part set')
      if (row > 0) part = model%part_set(row)%member
    else
      row = find_or_complain(deck, maps%part, r, 'PID', deck%integer(r, 'PID'), 'part')
      if (row > 0) part = [row]
    end if
    if (row == 0) allocate (part(0))
  end subroutine parts_of

  !> A part is damped by one card of a kind: programs differ in which of two wins.
  subroutine claim(deck, model, r, is_set, part, what, owner)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    integer, intent(in) :: r
    logical, intent(in) :: is_set
    integer, intent(in) :: part(:)
    character(*), intent(in) :: what
    integer, intent(inout) :: owner(:)
    integer :: k
    do k = 1, size(part)
      if (owner(part(k)) > 0 .and. owner(part(k)) /= r) then
        call deck%complain(r, trim(merge('PSID', 'PID ', is_set)), 'part '// &
            to_text(model%part(part(k))%id)//' is damped by its '//what//' already', &
            'the other card is at '//deck%place(owner(part(k)))//'; keep one')
        return
      end if
      owner(part(k)) = r
    end do
  end subroutine claim

  !> A coefficient below zero would feed energy in.
  subroutine check_curve(deck, model, r, curve)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    integer, intent(in) :: r, curve
    if (curve == 0) return
    if (any(model%curve(curve)%o < zero)) call deck%complain(r, 'LCID', 'curve '// &
        to_text(model%curve(curve)%id)//' goes below 0: damping would give energy')
  end subroutine check_curve

  !> Schemes without damping.
  subroutine refuse_by_scheme(deck, model, r, field)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    integer, intent(in) :: r
    character(*), intent(in) :: field
    type(scheme_traits_t) :: traits
    traits = traits_of(model%controls%scheme)
    if (traits%takes_damping .or. model%controls%is_static) return
    call deck%complain(r, field, 'scheme '//trim(traits%name)//' of *BIPACT_TIME has no '// &
        'damping: remove the card or take another scheme')
  end subroutine refuse_by_scheme

end module scene_damping
