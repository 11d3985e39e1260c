! SPDX-License-Identifier: BSD-3-Clause
!> Elements in space: which one a card means by its repeated nodes and the form of its section.
module scene_solids
  use base_kinds, only: wp, zero
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_note
  use element_base, only: element_t, most_nodes
  use element_curved, only: nearest_places
  use element_registry, only: make_element
  use model_data, only: model_t
  use scene_ids, only: maps_t, records_of, find_or_complain, part_of_element
  implicit none
  private
  public :: form_of, read_solids

  !> What each ELFORM of *SECTION_SOLID is.
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
    integer :: k
    form = 'HEX8'
    do k = 1, size(code)
      if (code(k) == elform) exit
    end do
    if (k > size(code)) then
      call deck%complain(record, 'ELFORM', 'expected 1 (full), 2 (mean dilatation), -1, '// &
          '-2, 18, -18 or 62 (incompatible modes), 10, 13 or 60 (tetrahedra), 15 or 115 '// &
          '(wedges), 16 (tetrahedra of ten nodes), 24 (hexahedra of 27), found '// &
          to_text(elform), 'other element forms are not available in this version: take 2, '// &
          'or -1 for bending')
      return
    end if
    form = element_of(k)
    if (elform == 1) call add_note(deck%problems, &
        'ELFORM 1 of *SECTION_SOLID is integrated with 2 x 2 x 2 points, not with one')
    if (elform == 13) call add_note(deck%problems, 'ELFORM 13 of *SECTION_SOLID is the '// &
        'tetrahedron of constant strain, without pressures at nodes')
  end subroutine form_of

  !> *ELEMENT_SOLID, in both its forms, and *ELEMENT_SOLID_H27.
  subroutine read_solids(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    integer, allocatable :: record(:), large(:)
    integer :: k, part, nodes, node(most_nodes), moved, linear
    character(8) :: name
    call records_of(deck, 'ELEMENT_SOLID', 1, record)
    call records_of(deck, 'ELEMENT_SOLID_H27', 1, large)
    call model%mesh%start(size(record) + size(large), 10*size(record) + 27*size(large))
    moved = 0
    linear = size(record)
    record = [record, large]
    do k = 1, size(record)
      associate (r => record(k))
        if (k <= linear) call read_nodes(deck, r, maps, node, name, nodes)
        if (k > linear) call read_27(deck, r, maps, node, name, nodes)
        part = part_of_element(deck, maps, r)
        if (nodes > 8) call take_places(model, name, node(:nodes), moved)
        if (part > 0) call take_form(deck, model, r, part, name)
        call model%mesh%add(trim(name), nint(deck%number_at(r, 1)), part, r, node(:nodes))
      end associate
    end do
    if (moved > 0) call add_note(deck%problems, 'mid nodes of '//to_text(moved)// &
        ' quadratic elements are in another order than those of VTK: each is taken for the '// &
        'edge or face on which it lies')
  end subroutine read_solids

  !> Rows of the nodes of a card and the element that they make, HEX8 where none is repeated.
  subroutine read_nodes(deck, record, maps, node, name, nodes)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    type(maps_t), intent(in) :: maps
    integer, intent(out) :: node(:), nodes
    character(8), intent(out) :: name
    integer :: card, before, m, id(10)
    card = deck%follow(record, 2)
    before = 0
    id = 0
    if (card == 0) then
      card = record
      before = 2
    end if
    do m = 1, merge(8, 10, card == record)
      id(m) = nint(deck%number_at(card, before + m))
    end do
    node = 0
    if (any(id(9:10) > 0)) then
      name = 'TET10'
      nodes = merge(10, 0, are_different(id))
    else
      call find_shape(id(:8), name, nodes)
    end if
    if (nodes == 0) then
      call deck%complain(card, 'N5', 'expected eight different nodes, or a tetrahedron '// &
          '1 2 3 4 4 4 4 4, a pyramid 1 2 3 4 5 5 5 5, a wedge 1 2 3 4 5 5 6 6, ten '// &
          'different nodes of a quadratic tetrahedron', &
          'numbers that repeat stand for one node')
      return
    end if
    do m = 1, nodes
      node(m) = find_or_complain(deck, maps%node, card, 'N'//to_text(m), id(m), 'node')
    end do
  end subroutine read_nodes

  !> The same of *ELEMENT_SOLID_H27: ten, ten and seven nodes on three cards.
  subroutine read_27(deck, record, maps, node, name, nodes)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    type(maps_t), intent(in) :: maps
    integer, intent(out) :: node(:), nodes
    character(8), intent(out) :: name
    integer :: m, card, id(27)
    name = 'HEX27'
    nodes = 27
    do m = 1, 27
      card = deck%follow(record, 2 + (m - 1)/10)
      id(m) = 0
      if (card > 0) id(m) = nint(deck%number_at(card, 1 + mod(m - 1, 10)))
    end do
    node = 0
    if (.not. are_different(id)) then
      call deck%complain(record, '', 'expected 27 different nodes')
      nodes = 0
      return
    end if
    do m = 1, 27
      node(m) = find_or_complain(deck, maps%node, deck%follow(record, 2 + (m - 1)/10), &
          'N'//to_text(m), id(m), 'node')
    end do
  end subroutine read_27

  !> Mid nodes in the order of the element, by the places where they lie, if they are not in
  !> that order (*ELEMENT_SOLID_H27 has none that all writers keep to). moved: elements counted
  !> whose order was another.
  subroutine take_places(model, name, node, moved)
    type(model_t), intent(in) :: model
    character(*), intent(in) :: name
    integer, intent(inout) :: node(:), moved
    class(element_t), allocatable :: element
    integer :: order(size(node))
    logical :: is_clear
    if (any(node == 0)) return
    call make_element(name, element)
    if (element%smallest_jacobian(model%x(:, node)) > zero) return
    call order_by_place(name, model%x(:, node), order, is_clear)
    if (.not. is_clear) return
    if (.not. element%smallest_jacobian(model%x(:, node(order))) > zero) return
    node = node(order)
    moved = moved + 1
  end subroutine take_places

  !> The nodes x (3, nodes) of a quadratic element in the order of its type: corners as they
  !> are, each other node where the straight element with these corners has that place.
  subroutine order_by_place(name, x, order, is_clear)
    character(*), intent(in) :: name
    real(wp), intent(in) :: x(:, :)
    integer, intent(out) :: order(:)
    logical, intent(out) :: is_clear
    class(element_t), allocatable :: element, straight
    real(wp) :: place(3, size(x, 2)), n(8), dn(8, 3)
    integer :: k
    call make_element(name, element)
    call make_element(merge('TET4', 'HEX8', name == 'TET10'), straight)
    associate (c => straight%nodes)
      do k = 1, size(x, 2)
        call straight%shape(element%place(:, k), n(:c), dn(:c, :))
        place(:, k) = matmul(x(:, :c), n(:c))
        order(k) = k
      end do
      call nearest_places(x(:, c + 1:), place(:, c + 1:), order(c + 1:), is_clear)
      order(c + 1:) = order(c + 1:) + c
    end associate
  end subroutine order_by_place

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
    logical :: takes_all
    associate (form => model%part(part)%form)
      takes_all = form(1:4) == 'HEX8' .and. name /= 'TET10' .and. name /= 'HEX27'
      if (takes_all .and. name == 'HEX8') name = form
      if (takes_all .or. form == '' .or. name == form) return
      call deck%complain(record, 'PID', 'the section of part '//to_text(model%part(part)%id)// &
          ' is of '//trim(form)//' elements, and this is '//trim(name), &
          'give these elements a part of their own, or the section another ELFORM (16 for '// &
          'TET10, 24 for HEX27)')
    end associate
  end subroutine take_form

end module scene_solids
