! SPDX-License-Identifier: BSD-3-Clause
!> Materials: from cards to laws, with what ties several of their fields.
module scene_materials
  use base_kinds, only: wp, zero
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_warning, add_note
  use material_base, only: material_t
  use material_mooney, only: mooney_bulk
  use material_ogden, only: ogden_shear
  use material_registry, only: make_material, material_keywords, max_constants
  use model_data, only: model_t
  use scene_ids, only: maps_t, make_id_map, records_of
  implicit none
  private
  public :: read_materials

contains

  !> Every *MAT_... block becomes a material; curves must have been read.
  subroutine read_materials(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(inout) :: maps
    integer, allocatable :: ids(:), record(:), more(:), law(:)
    integer :: k
    allocate (record(0), law(0))
    do k = 1, size(material_keywords)
      call records_of(deck, trim(material_keywords(k)), 1, more)
      record = [record, more]
      law = [law, spread(k, 1, size(more))]
    end do
    allocate (ids(size(record)), model%material(size(record)))
    do k = 1, size(record)
      ids(k) = deck%integer(record(k), 'MID')
      call read_material(deck, model, maps, record(k), trim(material_keywords(law(k))), &
          ids(k), model%material(k)%item)
    end do
    call make_id_map(deck, 'material', 'MID', ids, record, maps%material)
  end subroutine read_materials

  !> One of them. A law whose fields do not fit each other has a problem, and an elastic one
  !> stands in for it.
  subroutine read_material(deck, model, maps, record, keyword, id, material)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record, id
    character(*), intent(in) :: keyword
    class(material_t), allocatable, intent(out) :: material
    real(wp), allocatable :: yield(:, :)
    real(wp) :: constants(max_constants)
    logical :: good
    constants = constants_of(deck, record)
    call check_law(deck, model, maps, record, keyword, constants, yield, good)
    if (.not. good) then
      call make_material('MAT_ELASTIC', id, [constants(1), 1.0_wp, zero], material)
      return
    else if (allocated(yield)) then
      call make_material(keyword, id, constants, material, yield)
    else
      call make_material(keyword//trim(merge(' HENCKY', repeat(' ', 7), &
          keyword == 'MAT_ELASTIC' .and. model%controls%is_hencky)), id, constants, material)
    end if
    if (.not. material%is_linear) then
      if (.not. model%controls%is_finite) call deck%complain(record, '', '*'//keyword// &
          ' is a law of finite strain, and this deck has small displacements', &
          'set NSOLVR 12 of *CONTROL_IMPLICIT_SOLUTION, or take *MAT_ELASTIC')
    else if (deck%real(record, 'PR') > 0.49_wp .and. .not. deck%in_space) then
      call add_warning(deck%problems, 'poisson', deck%place(record)//': PR > 0.49 of '// &
          'material '//to_text(id)//': fully integrated elements lock; lower PR, or refine')
    end if
  end subroutine read_material

  !> The numbers of the cards of a material after its first field; of cards that are not there,
  !> zeros.
  pure function constants_of(deck, record) result(constants)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record
    real(wp) :: constants(max_constants)
    integer :: card, m, n, row
    constants = zero
    n = -1
    associate (keyword => deck%table%keyword(deck%block(deck%record(record)%block)%keyword))
      do card = 1, keyword%cards
        row = record
        if (card > 1) row = deck%follow(record, card)
        do m = 1, keyword%card(card)%fields
          n = n + 1
          if (n > 0 .and. row > 0) constants(n) = deck%number_at(row, m)
        end do
      end do
    end associate
  end function constants_of

  !> What the fields of a law must be together; the points of its yield stress, if it has any.
  subroutine check_law(deck, model, maps, record, keyword, c, yield, good)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record
    character(*), intent(in) :: keyword
    real(wp), intent(in) :: c(:)
    real(wp), allocatable, intent(out) :: yield(:, :)
    logical, intent(out) :: good
    good = .true.
    select case (keyword)
    case ('MAT_MOONEY-RIVLIN_RUBBER')
      call check_mooney(deck, record, c(2), c(3), c(4), good)
    case ('MAT_OGDEN_RUBBER')
      call check_ogden(deck, record, c(8:15), c(16:23), good)
    case ('MAT_PLASTIC_KINEMATIC')
      call check_tangent(deck, record, c(2), c(5), good)
    case ('MAT_PIECEWISE_LINEAR_PLASTICITY')
      if (nint(c(10)) > 0) then
        call read_yield_curve(deck, model, maps, deck%follow(record, 2), nint(c(10)), yield, &
            good)
        if (any(c(13:28) > zero)) call add_note(deck%problems, '*'//keyword// &
            ' EPS and ES are not used: LCSS is given')
      else if (any(c(13:28) > zero)) then
        call read_yield_points(deck, record, c(13:20), c(21:28), yield, good)
      else
        call check_tangent(deck, record, c(2), c(5), good)
        if (c(4) > zero) return
        good = .false.
        call deck%complain(record, 'SIGY', 'expected a yield stress > 0', &
            'or LCSS, or EPS1 to EPS8 and ES1 to ES8')
      end if
    end select
  end subroutine check_law

  subroutine check_mooney(deck, record, nu, a, b, good)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    real(wp), intent(in) :: nu, a, b
    logical, intent(inout) :: good
    good = a + b > zero
    if (.not. good) then
      call deck%complain(record, 'A', 'expected A + B > 0, half the shear modulus')
      return
    end if
    good = mooney_bulk(nu, a, b) > zero
    if (.not. good) then
      call deck%complain(record, 'PR', 'expected a greater Poisson ratio: with this one '// &
          'the energy falls without bound as the volume grows', &
          'above .4 with A alone, above .4545 with B alone; rubber has .49 to .4995')
    else if (nu < 0.49_wp) then
      call add_note(deck%problems, '*MAT_MOONEY-RIVLIN_RUBBER with PR < 0.49: the law is '// &
          'one of nearly incompressible rubber')
    end if
  end subroutine check_mooney

  subroutine check_ogden(deck, record, mu, alpha, good)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    real(wp), intent(in) :: mu(:), alpha(:)
    logical, intent(inout) :: good
    integer :: k
    do k = 1, size(mu)
      if ((abs(mu(k)) > zero) .eqv. (abs(alpha(k)) > zero)) cycle
      good = .false.
      call deck%complain(deck%follow(record, 3), 'ALPHA'//to_text(k), &
          'expected both MU'//to_text(k)//' and ALPHA'//to_text(k)//', or none')
    end do
    if (.not. good) return
    good = ogden_shear(mu, alpha) > zero
    if (.not. good) call deck%complain(deck%follow(record, 2), 'MU1', &
        'expected a sum of all MU ALPHA > 0: half of it is the shear modulus')
  end subroutine check_ogden

  subroutine check_tangent(deck, record, young, tangent, good)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    real(wp), intent(in) :: young, tangent
    logical, intent(inout) :: good
    if (tangent < young) return
    good = .false.
    call deck%complain(record, 'ETAN', 'expected a tangent modulus below E, '//to_text(young))
  end subroutine check_tangent

  !> The yield stress by the curve that LCSS names.
  subroutine read_yield_curve(deck, model, maps, record, id, yield, good)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record, id
    real(wp), allocatable, intent(out) :: yield(:, :)
    logical, intent(inout) :: good
    integer :: row, k
    row = maps%curve%find(id)
    good = row > 0
    if (.not. good) then
      call deck%complain(record, 'LCSS', 'curve '//to_text(id)//' is not defined', &
          'add a *DEFINE_CURVE with this number')
      return
    end if
    associate (a => model%curve(row)%a, o => model%curve(row)%o)
      allocate (yield(2, size(a)))
      yield(1, :) = a
      yield(2, :) = o
      good = .not. abs(a(1)) > zero .and. o(1) > zero
      do k = 2, size(a)
        good = good .and. o(k) >= o(k - 1) .and. a(k) > a(k - 1)
      end do
    end associate
    if (.not. good) call deck%complain(record, 'LCSS', 'expected a curve that begins at '// &
        'plastic strain 0, with yield stresses > 0 that do not fall', &
        'softening is not available in this version')
  end subroutine read_yield_curve

  !> The yield stress by EPS and ES, up to the last that is not zero.
  subroutine read_yield_points(deck, record, strain, stress, yield, good)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    real(wp), intent(in) :: strain(:), stress(:)
    real(wp), allocatable, intent(out) :: yield(:, :)
    logical, intent(inout) :: good
    integer :: k, n
    n = 0
    do k = 1, size(strain)
      if (max(strain(k), stress(k)) > zero) n = k
    end do
    allocate (yield(2, n))
    yield(1, :) = strain(:n)
    yield(2, :) = stress(:n)
    good = n > 1 .and. .not. strain(1) > zero .and. stress(1) > zero
    if (.not. good) then
      call deck%complain(deck%follow(record, 3), 'EPS1', 'expected 0, the first of two '// &
          'points at least, with its yield stress ES1 > 0')
      return
    end if
    do k = 2, n
      good = strain(k) > strain(k - 1) .and. stress(k) >= stress(k - 1)
      if (good) cycle
      call deck%complain(deck%follow(record, 3), 'EPS'//to_text(k), 'expected a plastic '// &
          'strain greater than that before, with a yield stress that does not fall', &
          'softening is not available in this version')
      return
    end do
  end subroutine read_yield_points

end module scene_materials
