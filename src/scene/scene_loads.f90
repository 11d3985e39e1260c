! SPDX-License-Identifier: BSD-3-Clause
!> Curves, loads, supports and initial velocities: from cards to the model.
module scene_loads
  use base_kinds, only: wp, zero
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use model_data, only: model_t, curve_t, load_t, gravity_t, find_set
  use scene_ids, only: id_map_t, make_id_map
  implicit none
  private
  public :: read_curves, read_supports, read_loads, read_initial_velocities

contains

  !> *DEFINE_CURVE.
  subroutine read_curves(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    integer, allocatable :: ids(:), record(:)
    type(curve_t), allocatable :: curves(:)
    type(id_map_t) :: map
    integer :: b, n
    allocate (ids(0), record(0), curves(deck%blocks))
    n = 0
    b = deck%next_block('DEFINE_CURVE', 0)
    do while (b > 0)
      n = n + 1
      call read_curve(deck, b, curves(n))
      ids = [ids, curves(n)%id]
      record = [record, deck%block(b)%first]
      b = deck%next_block('DEFINE_CURVE', b)
    end do
    model%curve = curves(1:n)
    call make_id_map(deck, 'curve', 'LCID', ids, record, map)
  end subroutine read_curves

  subroutine read_curve(deck, block, curve)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: block
    type(curve_t), intent(inout) :: curve
    integer :: k, n, head
    head = deck%block(block)%first
    n = deck%block(block)%last - head
    curve%id = deck%integer(head, 'LCID')
    allocate (curve%a(n), curve%o(n))
    do k = 1, n
      curve%a(k) = deck%real(head, 'SFA')*(deck%real(head + k, 'A') + deck%real(head, 'OFFA'))
      curve%o(k) = deck%real(head, 'SFO')*(deck%real(head + k, 'O') + deck%real(head, 'OFFO'))
      if (k == 1) cycle
      if (.not. curve%a(k) > curve%a(k - 1)) call deck%complain(head + k, 'A', &
          'expected an abscissa greater than that of the card before')
    end do
  end subroutine read_curve

  !> *BOUNDARY_SPC_SET and _NODE.
  subroutine read_supports(deck, model, nodes)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(id_map_t), intent(in) :: nodes
    character(17), parameter :: keyword(2) = ['BOUNDARY_SPC_SET ', 'BOUNDARY_SPC_NODE']
    integer, allocatable :: list(:)
    integer :: k, b, r
    do k = 1, 2
      b = deck%next_block(trim(keyword(k)), 0)
      do while (b > 0)
        do r = deck%block(b)%first, deck%block(b)%last
          call nodes_of(deck, model, nodes, r, k == 1, list)
          if (deck%integer(r, 'DOFX') == 1) model%fixed(1, list) = .true.
          if (deck%integer(r, 'DOFY') == 1) model%fixed(2, list) = .true.
        end do
        b = deck%next_block(trim(keyword(k)), b)
      end do
    end do
  end subroutine read_supports

  !> Rows of the node (NID) or of the node set (NSID) that a card names.
  subroutine nodes_of(deck, model, nodes, record, is_set, list)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(id_map_t), intent(in) :: nodes
    integer, intent(in) :: record
    logical, intent(in) :: is_set
    integer, allocatable, intent(out) :: list(:)
    integer :: id, row
    id = deck%integer(record, merge('NSID', 'NID ', is_set))
    if (is_set) then
      row = find_set(model%node_set, id)
      if (row > 0) list = pack(model%node_set(row)%member, model%node_set(row)%member > 0)
    else
      row = nodes%find(id)
      if (row > 0) list = [row]
    end if
    if (row > 0) return
    call deck%complain(record, trim(merge('NSID', 'NID ', is_set)), &
        trim(merge('node set', 'node    ', is_set))//' '//to_text(id)//' is not defined')
    allocate (list(0))
  end subroutine nodes_of

  !> *LOAD_NODE_SET, *LOAD_NODE_POINT and *LOAD_BODY_X, _Y.
  subroutine read_loads(deck, model, nodes)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(id_map_t), intent(in) :: nodes
    character(15), parameter :: keyword(4) = ['LOAD_NODE_SET  ', 'LOAD_NODE_POINT', &
                                              'LOAD_BODY_X    ', 'LOAD_BODY_Y    ']
    type(load_t) :: load
    type(gravity_t) :: gravity
    integer :: k, b, r
    allocate (model%load(0), model%gravity(0))
    do k = 1, 4
      b = deck%next_block(trim(keyword(k)), 0)
      do while (b > 0)
        do r = deck%block(b)%first, deck%block(b)%last
          if (k <= 2) then
            call nodes_of(deck, model, nodes, r, k == 1, load%node)
            load%direction = deck%integer(r, 'DOF')
            load%curve = curve_row(deck, model, r)
            load%factor = deck%real(r, 'SF')
            model%load = [model%load, load]
          else
            gravity%direction = k - 2
            gravity%curve = curve_row(deck, model, r)
            gravity%factor = deck%real(r, 'SF')
            model%gravity = [model%gravity, gravity]
          end if
        end do
        b = deck%next_block(trim(keyword(k)), b)
      end do
    end do
  end subroutine read_loads

  integer function curve_row(deck, model, record)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    integer, intent(in) :: record
    integer :: id
    id = deck%integer(record, 'LCID')
    do curve_row = 1, size(model%curve)
      if (model%curve(curve_row)%id == id) return
    end do
    curve_row = 0
    call deck%complain(record, 'LCID', 'curve '//to_text(id)//' is not defined', &
        'add a *DEFINE_CURVE with this number')
  end function curve_row

  !> *INITIAL_VELOCITY, _NODE, _GENERATION. A node that gets two different velocities is a
  !> problem (which one should win?), one on a fixed direction too.
  subroutine read_initial_velocities(deck, model, nodes, parts)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(id_map_t), intent(in) :: nodes, parts
    character(27), parameter :: keyword(3) = ['INITIAL_VELOCITY           ', &
      'INITIAL_VELOCITY_NODE      ', 'INITIAL_VELOCITY_GENERATION']
    integer, allocatable :: owner(:), list(:)
    integer :: k, b, r, step
    allocate (owner(model%nodes))
    owner = 0
    do k = 1, 3
      step = merge(1, 2, k == 2)
      b = deck%next_block(trim(keyword(k)), 0)
      do while (b > 0)
        do r = deck%block(b)%first, deck%block(b)%last - step + 1, step
          select case (k)
          case (1)
            call initial_set(deck, model, nodes, r, list)
            call give_velocity(deck, model, r + 1, list, zero, [zero, zero], owner)
          case (2)
            call nodes_of(deck, model, nodes, r, .false., list)
            call give_velocity(deck, model, r, list, zero, [zero, zero], owner)
          case (3)
            call generation_nodes(deck, model, parts, r, list)
            call give_velocity(deck, model, r, list, deck%real(r, 'OMEGA'), &
                [deck%real(r + 1, 'XC'), deck%real(r + 1, 'YC')], owner)
          end select
        end do
        b = deck%next_block(trim(keyword(k)), b)
      end do
    end do
  end subroutine read_initial_velocities

  subroutine initial_set(deck, model, nodes, record, list)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(id_map_t), intent(in) :: nodes
    integer, intent(in) :: record
    integer, allocatable, intent(out) :: list(:)
    integer :: k
    if (deck%integer(record, 'NSID') == 0) then
      list = [(k, k=1, model%nodes)]
    else
      call nodes_of(deck, model, nodes, record, .true., list)
    end if
  end subroutine initial_set

  !> Nodes of a part set (STYP 1), a part (2) or a node set (3); id 0 = all nodes.
  subroutine generation_nodes(deck, model, parts, record, list)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(id_map_t), intent(in) :: parts
    integer, intent(in) :: record
    integer, allocatable, intent(out) :: list(:)
    logical :: wanted(size(model%part)), taken(model%nodes)
    integer :: id, row, k
    id = deck%integer(record, 'ID')
    taken = id == 0
    wanted = .false.
    row = 0
    select case (deck%integer(record, 'STYP'))
    case (1)
      row = find_set(model%part_set, id)
      if (row > 0) then
        associate (m => model%part_set(row)%member)
          wanted(pack(m, m > 0)) = .true.
        end associate
      end if
    case (2)
      row = parts%find(id)
      if (row > 0) wanted(row) = .true.
    case (3)
      row = find_set(model%node_set, id)
      if (row > 0) then
        associate (m => model%node_set(row)%member)
          taken(pack(m, m > 0)) = .true.
        end associate
      end if
    end select
    if (row == 0 .and. id /= 0) &
        call deck%complain(record, 'ID', 'nothing of this kind has number '//to_text(id), &
        'STYP says what ID is: 1 a part set, 2 a part, 3 a node set')
    do k = 1, model%elements
      if (model%element_part(k) == 0) cycle
      if (wanted(model%element_part(k))) &
          taken(pack(model%connectivity(:, k), model%connectivity(:, k) > 0)) = .true.
    end do
    list = pack([(k, k=1, model%nodes)], taken)
  end subroutine generation_nodes

  subroutine give_velocity(deck, model, record, list, omega, centre, owner)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    integer, intent(in) :: record
    integer, intent(in) :: list(:)
    real(wp), intent(in) :: omega, centre(2)
    integer, intent(inout) :: owner(:)
    real(wp) :: v(2)
    integer :: k, i
    logical :: told
    told = .false.
    do k = 1, size(list)
      i = list(k)
      v(1) = deck%real(record, 'VX') - omega*(model%x(2, i) - centre(2))
      v(2) = deck%real(record, 'VY') + omega*(model%x(1, i) - centre(1))
      if (.not. told .and. owner(i) > 0 .and. owner(i) /= record) then
        if (any(abs(model%v0(:, i) - v) > zero)) then
          call deck%complain(record, 'VX', 'node '//to_text(model%node_id(i))// &
              ' gets a second, different initial velocity', 'the first is at '// &
              deck%place(owner(i)))
          told = .true.
        end if
      end if
      if (.not. told .and. any(model%fixed(:, i) .and. abs(v) > zero)) then
        call deck%complain(record, &
            merge('VX', 'VY', model%fixed(1, i) .and. abs(v(1)) > zero), &
            'initial velocity on a fixed direction of node '//to_text(model%node_id(i)))
        told = .true.
      end if
      model%v0(:, i) = v
      owner(i) = record
    end do
  end subroutine give_velocity

end module scene_loads
