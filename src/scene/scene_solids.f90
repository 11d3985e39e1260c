! SPDX-License-Identifier: BSD-3-Clause
!> Elements in space: which one a card means by its repeated nodes and the form of its section.
module scene_solids
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_note
  use element_base, only: element_t
  use element_registry, only: make_element
  use model_data, only: model_t
  use scene_ids, only: maps_t, records_of, find_or_complain, part_of_element
  implicit none
  private
  public :: form_of, read_solids

  !> What each ELFORM of *SECTION_SOLID is; those that no element answers to are not available.
  integer, parameter :: code(14) = [1, 2, -1, -2, 18, -18, 62, 10, 13, 60, 15, 115, 16, 24]
  character(8), parameter :: element_of(14) = [character(8) :: 'HEX8', 'HEX8MEAN', 'HEX8MODE', &
      'HEX8MODE', 'HEX8MODE', 'HEX8MODE', 'HEX8MODE', 'TET4', 'TET4', 'TET4', 'WEDGE6', &
      'WEDGE6', 'TET10', 'HEX27']

contains

  !> The element that a section (SECID, ELFORM on a record) makes of its cards; a problem and
  !> HEX8 where there is none.
  subroutine form_of(deck, record, elform, form)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record, elform
    character(8), intent(out) :: form
    class(element_t), allocatable :: element
    integer :: k
    logical :: is_available
    form = 'HEX8'
    do k = 1, size(code)
      if (code(k) == elform) exit
    end do
    if (k > size(code)) then
      call deck%complain(record, 'ELFORM', 'expected 1 (full), 2 (mean dilatation), -1, '// &
          '-2, 18, -18 or 62 (incompatible modes), 10, 13 or 60 (tetrahedra), 15 or 115 '// &
          '(wedges), found '//to_text(elform), 'other element forms are not available in '// &
          'this version: take 2, or -1 for bending')
      return
    end if
    call make_element(trim(element_of(k)), element)
    is_available = allocated(element)
    if (is_available) is_available = element%nodes <= 8    ! cards of more are not read yet
    if (is_available) then
      form = element_of(k)
    else
      call deck%complain(record, 'ELFORM', 'the element '//trim(element_of(k))// &
          ' of ELFORM '//to_text(elform)//' is not available in this version', &
          'take 2, -1 or 10')
    end if
    if (elform == 1) call add_note(deck%problems, &
        'ELFORM 1 of *SECTION_SOLID is integrated with 2 x 2 x 2 points, not with one')
    if (elform == 13) call add_note(deck%problems, 'ELFORM 13 of *SECTION_SOLID is the '// &
        'tetrahedron of constant strain, without pressures at nodes')
  end subroutine form_of

  !> *ELEMENT_SOLID, in both its forms.
  subroutine read_solids(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    integer, allocatable :: record(:)
    integer :: k, part, nodes, corner(8)
    character(8) :: name
    call records_of(deck, 'ELEMENT_SOLID', 1, record)
    call model%mesh%start(size(record), 8*size(record))
    do k = 1, size(record)
      associate (r => record(k))
        part = part_of_element(deck, maps, r)
        call read_nodes(deck, r, maps, corner, name, nodes)
        if (part > 0) call take_form(deck, model, r, part, name)
        call model%mesh%add(trim(name), nint(deck%number_at(r, 1)), part, r, corner(:nodes))
      end associate
    end do
  end subroutine read_solids

  !> Rows of the nodes of a card and the element that they make, HEX8 where none is repeated.
  subroutine read_nodes(deck, record, maps, corner, name, nodes)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    type(maps_t), intent(in) :: maps
    integer, intent(out) :: corner(8), nodes
    character(8), intent(out) :: name
    integer :: card, before, m, id(8)
    card = deck%follow(record, 2)
    before = 0
    if (card == 0) then
      card = record
      before = 2
    end if
    do m = 1, 8
      id(m) = nint(deck%number_at(card, before + m))
    end do
    name = 'HEX8'
    nodes = 8
    corner = 0
    if (card /= record) then
      if (any([(nint(deck%number_at(card, m)) > 0, m=9, 10)])) then
        call deck%complain(card, 'N9', 'expected 0: elements with ten nodes are not '// &
            'available in this version', 'give N9 and N10 as 0 or blank')
        return
      end if
    end if
    call find_shape(id, name, nodes)
    if (nodes == 0) then
      call deck%complain(card, 'N5', 'expected eight different nodes, or a tetrahedron '// &
          '1 2 3 4 4 4 4 4, a pyramid 1 2 3 4 5 5 5 5, a wedge 1 2 3 4 5 5 6 6', &
          'numbers that repeat stand for one node')
      return
    end if
    do m = 1, nodes
      corner(m) = find_or_complain(deck, maps%node, card, 'N'//achar(48 + m), id(m), 'node')
    end do
  end subroutine read_nodes

  !> The shape that eight numbers mean, its nodes without the repeated ones in the front of id;
  !> nodes = 0: none.
  pure subroutine find_shape(id, name, nodes)
    integer, intent(inout) :: id(8)
    character(8), intent(out) :: name
    integer, intent(out) :: nodes
    name = 'HEX8'
    nodes = 8
    if (all(id(5:8) == id(4))) then
      name = 'TET4'
      nodes = 4
    else if (all(id(6:8) == id(5))) then
      name = 'PYRAMID5'
      nodes = 5
    else if (id(5) == id(6) .and. id(7) == id(8)) then
      name = 'WEDGE6'
      nodes = 6
      id(6) = id(7)
    end if
    if (.not. are_different(id(:nodes))) nodes = 0
  end subroutine find_shape

  pure logical function are_different(id)
    integer, intent(in) :: id(:)
    integer :: k
    are_different = all(id > 0)
    do k = 2, size(id)
      are_different = are_different .and. all(id(:k - 1) /= id(k))
    end do
  end function are_different

  !> The hexahedra of a part are of its form, other elements what they are; a part of
  !> tetrahedra or of wedges has no others.
  subroutine take_form(deck, model, record, part, name)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    integer, intent(in) :: record, part
    character(8), intent(inout) :: name
    associate (form => model%part(part)%form)
      if (form(1:3) == 'HEX' .and. name == 'HEX8') name = form
      if (form(1:3) == 'HEX' .or. form == '' .or. name == form) return
      call deck%complain(record, 'PID', 'the section of part '//to_text(model%part(part)%id)// &
          ' is of '//trim(form)//' elements, and this is none', &
          'give these elements a part of their own, or the section another ELFORM')
    end associate
  end subroutine take_form

end module scene_solids
