! SPDX-License-Identifier: BSD-3-Clause
!> The waves that the mass DISPERSION is tuned to, and the elements that it is defined for.
module scene_mass
  use base_kinds, only: wp, zero
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: full
  use model_data, only: model_t, controls_t
  implicit none
  private
  public :: read_wave, refuse_wave, check_mass

  character(2), parameter :: travel_fields(3) = ['DX', 'DY', 'DZ']

contains

  !> WAVE and the direction of travel, of record r of *BIPACT_MASS.
  subroutine read_wave(deck, r, controls)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: r
    type(controls_t), intent(inout) :: controls
    real(wp) :: travel(3)
    integer :: k
    if (deck%word(r, 'WAVE') /= 'S') then
      call refuse_direction(deck, r)
      return
    end if
    travel = [(deck%real(r, travel_fields(k)), k=1, 3)]
    if (any(abs(travel) > zero)) then
      controls%travel = travel
    else
      call deck%complain(r, 'DX', 'expected the direction in which the shear waves travel', &
          'give DX, DY, DZ')
    end if
  end subroutine read_wave

  !> Another mass than DISPERSION is not tuned to waves.
  subroutine refuse_wave(deck, r)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: r
    if (deck%is_given(r, 'WAVE')) call deck%complain(r, 'WAVE', &
        'only the mass DISPERSION is tuned to waves: leave it blank')
    call refuse_direction(deck, r)
  end subroutine refuse_wave

  subroutine refuse_direction(deck, r)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: r
    integer :: k
    do k = 1, 3
      if (deck%is_given(r, travel_fields(k))) call deck%complain(r, travel_fields(k), &
          'only the mass DISPERSION with WAVE S has a direction of travel: leave it blank')
    end do
  end subroutine refuse_direction

  !> DISPERSION: quadrilaterals and hexahedra of 8 nodes alone; tuned to shear waves: in space
  !> alone.
  subroutine check_mass(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    integer :: e
    if (model%controls%mass /= 'DISPERSION') return
    if (allocated(model%controls%travel) .and. model%dim == 2) call deck%complain( &
        deck%next('BIPACT_MASS', 1, 0), 'WAVE', &
        'expected P: shear waves are available in space only')
    do e = 1, model%mesh%n
      associate (element => model%mesh%kind(model%mesh%type(e))%item)
        if (element%takes_dispersion) cycle
        call deck%complain(model%mesh%record(e), '', 'element '// &
            to_text(model%mesh%id(e))//' is no '//trim(merge('quadrilateral          ', &
            'hexahedron of 8 nodes  ', element%dim == 2))// &
            ': the mass DISPERSION is defined for those alone', &
            'choose another TYPE on *BIPACT_MASS')
        if (full(deck%problems)) return
      end associate
    end do
  end subroutine check_mass

end module scene_mass
