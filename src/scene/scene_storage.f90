! SPDX-License-Identifier: BSD-3-Clause
!> Requests for field files and restart files.
module scene_storage
  use base_kinds, only: wp, zero
  use deck_data, only: deck_t
  use deck_problems, only: add_note
  use deck_names, only: field_names, finite_fields
  use model_data, only: model_t, field_request_t, restart_request_t
  use scene_ids, only: maps_t, find_or_complain
  implicit none
  private
  public :: read_storage

contains

  !> *BIPACT_FIELD or *DATABASE_BINARY_D3PLOT, and *BIPACT_RESTART.
  subroutine read_storage(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    integer :: own, other
    own = deck%next('BIPACT_FIELD', 1, 0)
    other = deck%next('DATABASE_BINARY_D3PLOT', 1, 0)
    if (own > 0) then
      if (other > 0) call add_note(deck%problems, deck%place(other)// &
          ': *DATABASE_BINARY_D3PLOT has no effect beside *BIPACT_FIELD')
      call read_field(deck, own, maps, model%controls%is_finite, model%requests%field)
    else if (other > 0) then
      associate (field => model%requests%field)
        field%interval = deck%real(other, 'DT')
        field%part_set = part_set_row(deck, maps, other, 'PSETID')
        call choose_default(field)
      end associate
      call add_note(deck%problems, '*DATABASE_BINARY_D3PLOT: U, V and STRESS go to field '// &
          'files of bipact (doc/output.md)')
    end if
    model%requests%field%on = model%requests%field%interval > zero
    call read_restart(deck, model%requests%restart)
  end subroutine read_storage

  subroutine read_field(deck, record, maps, is_finite, field)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    type(maps_t), intent(in) :: maps
    logical, intent(in) :: is_finite
    type(field_request_t), intent(inout) :: field
    integer :: bits
    field%interval = deck%real(record, 'DT')
    field%part_set = part_set_row(deck, maps, record, 'PSID')
    field%compression = deck%integer(record, 'COMPR')
    bits = deck%integer(record, 'PREC')
    field%single = bits == 32
    if (bits /= 32 .and. bits /= 64) call deck%complain(record, 'PREC', 'expected 32 or 64')
    field%begin = deck%real(record, 'TBEG')
    if (deck%is_given(record, 'TEND')) field%end = deck%real(record, 'TEND')
    if (field%end < field%begin) &
        call deck%complain(record, 'TEND', 'TEND is before TBEG: no frame')
    call read_names(deck, is_finite, field)
  end subroutine read_field

  subroutine read_names(deck, is_finite, field)
    type(deck_t), intent(inout) :: deck
    logical, intent(in) :: is_finite
    type(field_request_t), intent(inout) :: field
    character(:), allocatable :: word
    integer :: r, m, k
    r = deck%next('BIPACT_FIELD', 2, 0)
    do while (r > 0)
      do m = 1, 8
        word = deck%word(r, 'NAME'//achar(48 + m))
        if (word == 'ALL') field%wanted = field%wanted .or. is_finite .or. &
            [(all(field_names(k) /= finite_fields), k=1, size(field_names))]
        if (.not. is_finite .and. any(word == finite_fields)) call deck%complain(r, 'NAME'// &
            achar(48 + m), word//' is a field of finite deformation', &
            'NSOLVR 12 of *CONTROL_IMPLICIT_SOLUTION asks for it')
        do k = 1, size(field_names)
          if (word == field_names(k)) field%wanted(k) = .true.
        end do
      end do
      r = deck%next('BIPACT_FIELD', 2, r)
    end do
    if (.not. any(field%wanted)) call choose_default(field)
  end subroutine read_names

  pure subroutine choose_default(field)
    type(field_request_t), intent(inout) :: field
    field%wanted = field_names == 'U' .or. field_names == 'V' .or. field_names == 'STRESS'
  end subroutine choose_default

  integer function part_set_row(deck, maps, record, name)
    type(deck_t), intent(inout) :: deck
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record
    character(*), intent(in) :: name
    part_set_row = 0
    if (deck%integer(record, name) > 0) part_set_row = find_or_complain(deck, maps%part_set, &
        record, name, deck%integer(record, name), 'part set')
  end function part_set_row

  subroutine read_restart(deck, restart)
    type(deck_t), intent(in) :: deck
    type(restart_request_t), intent(inout) :: restart
    integer :: r
    r = deck%next('BIPACT_RESTART', 1, 0)
    restart%on = r > 0
    if (r == 0) return
    restart%steps = deck%integer(r, 'NSTEP')
    restart%wall = deck%real(r, 'WALL')
    restart%keep = deck%integer(r, 'KEEP')
    restart%on_signal = deck%integer(r, 'ONSIG') == 1
  end subroutine read_restart

end module scene_storage
