! SPDX-License-Identifier: BSD-3-Clause
!> Sections and parts: from cards to the model.
module scene_parts
  use base_kinds, only: wp, zero
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_note
  use material_base, only: plane_stress, plane_strain, axisymmetric, in_space
  use model_data, only: model_t, section_t
  use scene_ids, only: maps_t, make_id_map, records_of
  use scene_solids, only: form_of
  implicit none
  private
  public :: read_parts

contains

  !> *SECTION_SHELL, *SECTION_SOLID and *PART; materials must have been read.
  subroutine read_parts(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(inout) :: maps
    type(section_t), allocatable :: section(:)
    character(:), allocatable :: keyword
    integer, allocatable :: record(:), other(:)
    integer :: k, row
    keyword = '*SECTION_SHELL'
    if (deck%in_space) keyword = '*SECTION_SOLID'
    call read_sections(deck, section, maps)
    call records_of(deck, 'PART', 2, record)
    call records_of(deck, 'PART_INERTIA', 2, other)
    record = [record, other]
    allocate (model%part(size(record)))
    do k = 1, size(record)
      associate (p => model%part(k))
        p%record = record(k)
        p%id = deck%integer(record(k), 'PID')
        p%section_id = deck%integer(record(k), 'SECID')
        p%material_id = deck%integer(record(k), 'MID')
        p%heading = deck%word(record(k) - 1, 'HEADING')
        row = maps%section%find(p%section_id)
        if (p%section_id == 0 .or. p%material_id == 0) then
          call deck%complain(record(k), 'SECID', 'part '//to_text(p%id)//' has no section '// &
              'or no material (SECID '//to_text(p%section_id)//', MID '// &
              to_text(p%material_id)//')', 'name a '//keyword//' and a *MAT_ELASTIC')
          cycle
        end if
        if (row == 0) then
          call deck%complain(record(k), 'SECID', 'section '//to_text(p%section_id)// &
              ' is not defined', 'add a '//keyword//' with this number')
        else if ((section(row)%plane == in_space) .neqv. deck%in_space) then
          call deck%complain(record(k), 'SECID', 'expected the number of a '//keyword, &
              'shells are plane, solids are in space')
        else
          p%plane = section(row)%plane
          p%form = section(row)%form
          p%thickness = section(row)%thickness
        end if
        p%material = maps%material%find(p%material_id)
        if (p%material == 0) call deck%complain(record(k), 'MID', 'material '// &
            to_text(p%material_id)//' is not defined', 'add a *MAT_ELASTIC with this number')
        if (p%material > 0) p%is_rigid = model%material(p%material)%item%is_rigid
      end associate
    end do
    call make_id_map(deck, 'part', 'PID', model%part%id, record, maps%part)
    call find_axis(deck, model)
  end subroutine read_parts

  !> Is the model turned about the y axis? Then all of its parts are.
  subroutine find_axis(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    integer :: p
    model%is_axisymmetric = any(model%part%plane == axisymmetric)
    if (.not. model%is_axisymmetric) return
    do p = 1, size(model%part)
      associate (part => model%part(p))
        if (part%is_rigid) call deck%complain(part%record, 'MID', 'part '// &
            to_text(part%id)//' is rigid: rigid parts are not available around an axis', &
            'take a stiff *MAT_ELASTIC, or a rigid wall')
        if (part%plane /= axisymmetric .and. part%plane /= 0) call deck%complain( &
            part%record, 'SECID', 'part '//to_text(part%id)//' is plane, others are '// &
            'axisymmetric: expected one ELFORM for all', 'x is the radius of all, or of none')
      end associate
    end do
  end subroutine find_axis

  subroutine read_sections(deck, section, maps)
    type(deck_t), intent(inout) :: deck
    type(section_t), allocatable, intent(out) :: section(:)
    type(maps_t), intent(inout) :: maps
    integer, allocatable :: record(:), solid(:), ids(:)
    integer :: k, shells
    call records_of(deck, 'SECTION_SHELL', 1, record)
    call records_of(deck, 'SECTION_SOLID', 1, solid)
    shells = size(record)
    record = [record, solid]
    allocate (section(size(record)), ids(size(record)))
    do k = 1, size(record)
      associate (r => record(k))
        ids(k) = deck%integer(r, 'SECID')
        section(k)%id = ids(k)
        if (k > shells) then
          section(k)%plane = in_space
          if (deck%in_space) call form_of(deck, r, deck%integer(r, 'ELFORM'), section(k)%form)
          cycle
        end if
        section(k)%plane = plane_of(deck, r)
        select case (deck%integer(r, 'NIP'))
        case (4)
        case (2)
          call add_note(deck%problems, '*SECTION_SHELL NIP 2, the default of shells, is '// &
              'read as 4: plane elements have 2 x 2 points')
        case default
          call deck%complain(r, 'NIP', &
              'expected 4 or blank: elements are integrated with 2 x 2 points', &
              'other rules are not available in this version')
        end select
        call read_thickness(deck, deck%follow(r, 2), section(k))
      end associate
    end do
    call make_id_map(deck, 'section', 'SECID', ids, record, maps%section)
  end subroutine read_sections

  !> ELFORM; 14 weighs by areas in place of volumes, which does not pass the patch test.
  integer function plane_of(deck, record)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    integer, parameter :: area_weighted = 14
    plane_of = deck%integer(record, 'ELFORM')
    select case (plane_of)
    case (plane_stress, plane_strain, axisymmetric)
    case (area_weighted)
      plane_of = axisymmetric
      call add_note(deck%problems, '*SECTION_SHELL ELFORM 14 is read as 15: axisymmetric, '// &
          'weighted by volume')
    case default
      call deck%complain(record, 'ELFORM', 'expected 12 (plane stress), 13 (plane strain) '// &
          'or 15 (axisymmetric)', 'other element forms are not available in this version')
      plane_of = plane_strain
    end select
  end function plane_of

  subroutine read_thickness(deck, record, section)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    type(section_t), intent(inout) :: section
    character(2), parameter :: other(3) = ['T2', 'T3', 'T4']
    integer :: k
    if (record == 0) return
    if (section%plane == axisymmetric) then
      if (abs(deck%real(record, 'T1') - section%thickness) > zero) call add_note( &
          deck%problems, 'T1 of an axisymmetric *SECTION_SHELL has no effect: forces, '// &
          'masses and energies are of the whole ring')
      return
    end if
    section%thickness = deck%real(record, 'T1')
    do k = 1, 3
      if (.not. deck%is_given(record, other(k))) cycle
      if (abs(deck%real(record, other(k)) - section%thickness) > zero) &
          call deck%complain(record, other(k), 'expected the same thickness as T1, or blank', &
          'other thicknesses are not available in this version')
    end do
  end subroutine read_thickness

end module scene_parts
