! SPDX-License-Identifier: BSD-3-Clause
!> Nodes and elements: from cards to the model, and checks of their shapes.
module scene_mesh
  use base_kinds, only: wp, zero
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_note, full, add_problem
  use model_data, only: model_t
  use scene_faces, only: check_faces, warn_of_locking
  use scene_ids, only: maps_t, make_id_map, records_of, find_or_complain, part_of_element
  use scene_solids, only: read_solids
  implicit none
  private
  public :: read_nodes, read_elements, check_mesh

contains

  !> *NODE.
  subroutine read_nodes(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(inout) :: maps
    integer, allocatable :: record(:)
    integer :: k, n, held
    real(wp) :: z
    !> Directions x, y, z that TC = 1 to 7 holds (z is held in a plane model).
    logical, parameter :: yes = .true., no = .false.
    logical, parameter :: holds(3, 7) = reshape([yes, no, no, no, yes, no, no, no, yes, &
        yes, yes, no, no, yes, yes, yes, no, yes, yes, yes, yes], [3, 7])
    call records_of(deck, 'NODE', 1, record)
    n = size(record)
    model%nodes = n
    model%mesh_nodes = n
    if (deck%in_space) model%dim = 3
    allocate (model%node_id(n), model%x(model%dim, n), model%v0(model%dim, n), &
        model%fixed(model%dim, n))
    model%v0 = zero
    model%fixed = .false.
    do k = 1, n
      model%node_id(k) = nint(deck%number_at(record(k), 1))
      model%x(1, k) = deck%number_at(record(k), 2)
      model%x(2, k) = deck%number_at(record(k), 3)
      z = deck%number_at(record(k), 4)
      if (k == 1) model%z = z
      held = nint(deck%number_at(record(k), 5))
      if (held > 0) model%fixed(:, k) = holds(:model%dim, held)
      if (model%dim == 3) then
        model%x(3, k) = z
      else if (abs(z - model%z) > zero) then
        call deck%complain(record(k), 'Z', &
          'expected the z of the first node: the model is plane')
      end if
    end do
    call make_id_map(deck, 'node', 'NID', model%node_id, record, maps%node)
  end subroutine read_nodes

  !> *ELEMENT_SHELL or *ELEMENT_SOLID, and *ELEMENT_BEAM only to be left out.
  subroutine read_elements(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(inout) :: maps
    integer :: shell, solid
    shell = deck%next('ELEMENT_SHELL', 1, 0)
    if (deck%in_space) then
      solid = deck%next('ELEMENT_SOLID', 1, 0)
      if (solid == 0) solid = deck%next('ELEMENT_SOLID_H27', 1, 0)
      if (shell > 0) call deck%complain(shell, '', 'expected no *ELEMENT_SHELL beside '// &
          '*ELEMENT_SOLID: a model is plane or in space', 'the first solid is at '// &
          deck%place(solid))
      call read_solids(deck, model, maps)
    else
      call read_shells(deck, model, maps)
    end if
    call model%mesh%make_blocks()
    call make_id_map(deck, 'element', 'EID', model%mesh%id, model%mesh%record, &
        maps%element)
    if (model%mesh%n == 0) &
        call add_problem(deck%problems, deck%file(1)%path// &
        ': the deck has no *ELEMENT_SHELL and no *ELEMENT_SOLID')
    call read_beams(deck, maps)
  end subroutine read_elements

  subroutine read_shells(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    integer, allocatable :: record(:)
    character(8) :: triangle, quadrilateral
    integer :: k, n, part, corner(4)
    triangle = merge('TRI3AX  ', 'TRI3    ', model%is_axisymmetric)
    quadrilateral = merge('QUAD4AX ', 'QUAD4   ', model%is_axisymmetric)
    call records_of(deck, 'ELEMENT_SHELL', 1, record)
    n = size(record)
    call model%mesh%start(n, 4*n)
    do k = 1, n
      associate (r => record(k))
        part = part_of_element(deck, maps, r)
        call read_corners(deck, r, maps, corner)
        if (corner(3) == corner(4)) then
          call model%mesh%add(triangle, nint(deck%number_at(r, 1)), part, r, corner(:3))
        else
          call model%mesh%add(quadrilateral, nint(deck%number_at(r, 1)), part, r, corner)
        end if
      end associate
    end do
  end subroutine read_shells

  subroutine read_corners(deck, record, maps, corner)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    type(maps_t), intent(in) :: maps
    integer, intent(out) :: corner(4)
    integer :: m, id
    do m = 1, 4
      id = nint(deck%number_at(record, 2 + m))
      if (m == 4 .and. id == 0) then
        corner(4) = corner(3)
        cycle
      end if
      corner(m) = find_or_complain(deck, maps%node, record, 'N'//achar(48 + m), id, 'node')
    end do
  end subroutine read_corners

  !> Mesh generators write boundary lines as beams of parts that have no *PART.
  subroutine read_beams(deck, maps)
    type(deck_t), intent(inout) :: deck
    type(maps_t), intent(in) :: maps
    integer :: r
    r = deck%next('ELEMENT_BEAM', 1, 0)
    if (r > 0) call add_note(deck%problems, '*ELEMENT_BEAM: lines whose part has no *PART '// &
        'are left out')
    do while (r > 0 .and. .not. full(deck%problems))
      if (maps%part%find(nint(deck%number_at(r, 2))) > 0) &
          call deck%complain(r, 'PID', 'part '//to_text(nint(deck%number_at(r, 2)))// &
          ' has a *PART, but beams are not available')
      r = deck%next('ELEMENT_BEAM', 1, r)
    end do
  end subroutine read_beams

  !> Element shapes, nodes without element (their mass would be zero), parts without element.
  subroutine check_mesh(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    logical, allocatable :: used(:), part_used(:)
    integer, allocatable :: record(:)
    integer :: k
    call check_shapes(deck, model)
    if (model%dim == 3 .and. deck%problems%count == 0) call check_faces(deck, model)
    if (model%dim == 3) call warn_of_locking(deck, model)
    allocate (used(model%nodes), part_used(size(model%part)))
    used = .false.
    part_used = .false.
    do k = 1, model%mesh%n
      used(model%mesh%nodes_of(k)) = .true.
      part_used(model%mesh%part(k)) = .true.
    end do
    do k = 1, size(model%part)
      if (.not. part_used(k)) call deck%complain(model%part(k)%record, 'PID', 'part '// &
          to_text(model%part(k)%id)//' has no element')
    end do
    if (all(used)) return
    call records_of(deck, 'NODE', 1, record)
    do k = 1, model%nodes
      if (.not. used(k)) call deck%complain(record(k), 'NID', 'node '// &
          to_text(model%node_id(k))//' belongs to no element')
    end do
  end subroutine check_mesh

  subroutine check_shapes(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    character(:), allocatable :: fault, hint
    real(wp) :: jacobian
    integer :: e
    fault = ' is clockwise, degenerate or not convex'
    hint = 'list its nodes counter-clockwise'
    if (model%dim == 3) then
      fault = ' is inside out, degenerate or too distorted: its Jacobian is not positive'
      hint = 'list N1 to N4 counter-clockwise as seen from the other nodes'
    end if
    do e = 1, model%mesh%n
      associate (element => model%mesh%kind(model%mesh%type(e))%item)
        jacobian = element%smallest_jacobian(model%x(:, model%mesh%nodes_of(e)))
        if (jacobian > zero) cycle
        call deck%complain(model%mesh%record(e), '', 'element '// &
            to_text(model%mesh%id(e))//fault, hint)
        if (full(deck%problems)) return
      end associate
    end do
  end subroutine check_shapes

end module scene_mesh
