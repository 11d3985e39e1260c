! SPDX-License-Identifier: BSD-3-Clause
!> Curves and loads: from cards to the model.
module scene_loads
  use base_kinds, only: wp, zero, half
  use base_list, only: append
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_note, add_warning
  use element_base, only: most_face_nodes
  use model_areas, only: facet_areas, ring_factors
  use model_data, only: model_t, curve_t, load_t
  use model_faces, only: find_segments
  use scene_ids, only: maps_t, make_id_map, records_of, find_or_complain
  use scene_sets, only: read_segment, corners, segment_text
  implicit none
  private
  public :: read_curves, read_loads, nodes_of, curve_of

contains

  !> *DEFINE_CURVE.
  subroutine read_curves(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(inout) :: maps
    integer, allocatable :: head(:)
    integer :: k
    call records_of(deck, 'DEFINE_CURVE', 1, head)
    allocate (model%curve(size(head)))
    do k = 1, size(head)
      call read_curve(deck, head(k), model%curve(k))
    end do
    call make_id_map(deck, 'curve', 'LCID', model%curve%id, head, maps%curve)
  end subroutine read_curves

  !> Points are scaled after the offsets are added. A curve of time that is shifted to later
  !> times (OFFA > 0) is 0 from t = 0 to 0.999 OFFA, by two points that are put before the
  !> given ones (S. Bala, "Curve offset in LS-DYNA", d3view.com, 2008).
  subroutine read_curve(deck, head, curve)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: head
    type(curve_t), intent(inout) :: curve
    real(wp) :: begin
    integer :: k, n
    n = deck%block(deck%record(head)%block)%last - head
    curve%id = deck%integer(head, 'LCID')
    if (deck%integer(head, 'SIDR') == 1) call deck%complain(head, 'SIDR', &
        'expected 0 or 2: dynamic relaxation is not available in this version')
    allocate (curve%a(n), curve%o(n))
    do k = 1, n
      if (.not. (deck%is_given(head + k, 'A') .or. deck%is_given(head + k, 'O'))) &
          call deck%complain(head + k, 'A', 'expected a point, found a blank card')
      curve%a(k) = deck%real(head, 'SFA')*(deck%real(head + k, 'A') + deck%real(head, 'OFFA'))
      curve%o(k) = deck%real(head, 'SFO')*(deck%real(head + k, 'O') + deck%real(head, 'OFFO'))
      if (.not. max(abs(curve%a(k)), abs(curve%o(k))) <= huge(zero)) &
          call deck%complain(head + k, 'A', 'the scaled point overflows')
      if (k == 1) cycle
      if (.not. curve%a(k) > curve%a(k - 1)) call deck%complain(head + k, 'A', &
          'expected an abscissa greater than that of the card before')
    end do
    if (.not. deck%real(head, 'OFFA') > zero) return
    begin = 0.999_wp*deck%real(head, 'OFFA')*deck%real(head, 'SFA')
    if (.not. curve%a(1) > begin) then
      call deck%complain(head, 'OFFA', 'expected a first abscissa >= 0 where OFFA is above 0', &
          'the points that make the curve 0 before OFFA would lie among the given ones')
    else
      curve%a = [zero, begin, curve%a]
      curve%o = [zero, zero, curve%o]
    end if
  end subroutine read_curve

  !> Row of the curve that a card names; 0 and a problem if there is none. A curve that begins
  !> after the run is noted: it is constant before.
  integer function curve_of(deck, model, maps, record)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record
    integer :: id
    id = deck%integer(record, 'LCID')
    curve_of = maps%curve%find(id)
    if (curve_of == 0) then
      call deck%complain(record, 'LCID', 'curve '//to_text(id)//' is not defined', &
          'add a *DEFINE_CURVE with this number')
    else
      if (model%curve(curve_of)%a(1) > zero) call add_note(deck%problems, 'curve '// &
          to_text(id)//' begins after t = 0: it is constant before')
      call tell_end(deck, model%curve(curve_of), model%controls%end_time)
    end if
  end function curve_of

  !> A curve that ends before the run stays constant: where its last points are level that is
  !> a note, else it breaks off, a warning.
  subroutine tell_end(deck, curve, end_time)
    type(deck_t), intent(inout) :: deck
    type(curve_t), intent(in) :: curve
    real(wp), intent(in) :: end_time
    integer :: n
    n = size(curve%a)
    if (.not. curve%a(n) < end_time) return
    if (abs(curve%o(n) - curve%o(max(1, n - 1))) > zero) then
      call add_warning(deck%problems, 'curve', 'the run leaves curve '//to_text(curve%id)// &
          ' at time '//to_text(curve%a(n))//': it stays at '//to_text(curve%o(n))// &
          '; give it points until ENDTIM')
    else
      call add_note(deck%problems, 'curve '//to_text(curve%id)// &
          ' ends before the run: it stays constant')
    end if
  end subroutine tell_end

  !> Rows of the node (NID) or of the node set (NSID) that a card names.
  subroutine nodes_of(deck, model, maps, record, is_set, list)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record
    logical, intent(in) :: is_set
    integer, allocatable, intent(out) :: list(:)
    integer :: row
    if (is_set) then
      row = find_or_complain(deck, maps%node_set, record, 'NSID', &
          deck%integer(record, 'NSID'), 'node set')
      if (row > 0) list = model%node_set(row)%member
    else
      row = find_or_complain(deck, maps%node, record, 'NID', &
          deck%integer(record, 'NID'), 'node')
      if (row > 0) list = [row]
    end if
    if (row == 0) allocate (list(0))
  end subroutine nodes_of

  !> *LOAD_NODE_SET, *LOAD_NODE_POINT, *LOAD_SEGMENT_SET, *LOAD_SEGMENT, *LOAD_BODY_X, _Y, _Z.
  subroutine read_loads(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    character(16), parameter :: keyword(4) = [character(16) :: 'LOAD_NODE_SET', &
        'LOAD_NODE_POINT', 'LOAD_SEGMENT_SET', 'LOAD_SEGMENT']
    integer, allocatable :: of_keyword(:), record(:)
    integer :: k, m, n, last(0:4)
    n = 0
    last(0) = 0
    do k = 1, 4
      call records_of(deck, trim(keyword(k)), 1, of_keyword)
      call append(of_keyword, record, n)
      last(k) = n
    end do
    allocate (model%load(n))
    do k = 1, 4
      do m = last(k - 1) + 1, last(k)
        if (k <= 2) call read_nodal(deck, model, maps, record(m), k == 1, model%load(m))
        if (k > 2) call read_pressure(deck, model, maps, record(m), k == 3, model%load(m))
      end do
    end do
    if (deck%problems%count == 0) call find_pressures(deck, model, last(2), record(:n))
    call read_gravity(deck, model, maps)
  end subroutine read_loads

  subroutine read_nodal(deck, model, maps, record, is_set, load)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record
    logical, intent(in) :: is_set
    type(load_t), intent(inout) :: load
    call nodes_of(deck, model, maps, record, is_set, load%node)
    allocate (load%force(model%dim, size(load%node)))
    load%force = zero
    load%force(deck%integer(record, 'DOF'), :) = 1.0_wp
    load%curve = curve_of(deck, model, maps, record)
    load%factor = deck%real(record, 'SF')
  end subroutine read_nodal

  !> The nodes of a pressure, CORNERS for each segment; its forces follow.
  subroutine read_pressure(deck, model, maps, record, is_set, load)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record
    logical, intent(in) :: is_set
    type(load_t), intent(inout) :: load
    integer :: row
    load%curve = curve_of(deck, model, maps, record)
    load%factor = deck%real(record, 'SF')
    load%arrival = deck%real(record, 'AT')
    if (is_set) then
      row = find_or_complain(deck, maps%segment_set, record, 'SSID', &
          deck%integer(record, 'SSID'), 'segment set')
      if (row > 0) load%node = reshape(model%segment_set(row)%node, &
          [size(model%segment_set(row)%node)])
    else
      allocate (load%node(corners(model)))
      call read_segment(deck, maps, record, load%node)
    end if
  end subroutine read_pressure

  !> Forces of the pressures, the loads after `before`; record: the cards of all loads.
  subroutine find_pressures(deck, model, before, record)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    integer, intent(in) :: before
    integer, intent(in) :: record(:)
    integer, allocatable :: node(:), segment(:, :), facet(:, :), from(:), owner(:), local(:)
    integer :: k, n, m, first, last
    n = 0
    do k = before + 1, size(record)
      call append(model%load(k)%node, node, n)
    end do
    if (n == 0) return
    segment = reshape(node(:n), [corners(model), n/corners(model)])
    call find_segments(model%mesh, model%nodes, segment, facet, from, owner, local)
    n = 0
    last = 0
    do k = before + 1, size(record)
      m = size(model%load(k)%node)/corners(model)
      first = last
      do while (last < size(from))
        if (from(last + 1) > n + m) exit
        last = last + 1
      end do
      if (has_all(from(first + 1:last), n + 1, n + m)) then
        call press(model, owner(first + 1:last), local(first + 1:last), model%load(k))
      else
        call deck%complain(record(k), 'N1', segment_text(model))
      end if
      n = n + m
    end do
  end subroutine find_pressures

  !> Are all numbers from a to b in a list that does not decrease?
  pure logical function has_all(list, a, b)
    integer, intent(in) :: list(:), a, b
    integer :: k, next
    next = a
    do k = 1, size(list)
      if (list(k) == next) next = next + 1
    end do
    has_all = next == b + 1
  end function has_all

  !> A pressure on facets of elements as forces on the nodes of their faces: int N n dA of the
  !> reference geometry, against the outward normal; in the plane times the thickness,
  !> around an axis times the circle.
  subroutine press(model, owner, facet, load)
    type(model_t), intent(in) :: model
    integer, intent(in) :: owner(:), facet(:)
    type(load_t), intent(inout) :: load
    integer :: s, n, m, node(most_face_nodes)
    real(wp) :: force(model%dim, most_face_nodes*size(owner))
    deallocate (load%node)
    n = 0
    do s = 1, size(owner)
      call facet_areas(model%mesh, model%x, owner(s), facet(s), node, m, force(:, n + 1:))
      force(:, n + 1:n + m) = &
          -model%part(model%mesh%part(owner(s)))%thickness*force(:, n + 1:n + m)
      if (model%is_axisymmetric) force(:, n + 1:n + m) = force(:, n + 1:n + m) &
          *spread(ring_factors(model%x(1, node(:m))), 1, 2)
      call append(node(:m), load%node, n)
    end do
    load%node = load%node(:n)
    load%force = force(:, :n)
  end subroutine press

  subroutine read_gravity(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    character, parameter :: axis(3) = ['X', 'Y', 'Z']
    integer, allocatable :: record(:), other(:), direction(:)
    integer :: k, d
    allocate (record(0), direction(0))
    do d = 1, 3
      call records_of(deck, 'LOAD_BODY_'//axis(d), 1, other)
      record = [record, other]
      direction = [direction, spread(d, 1, size(other))]
      if (d == 1 .and. model%is_axisymmetric .and. size(other) > 0) call deck%complain( &
          other(1), '', 'expected *LOAD_BODY_Y: around an axis a body load acts along it')
      if (d <= model%dim .or. size(other) == 0) cycle
      call deck%complain(other(1), '', 'expected *LOAD_BODY_X or *LOAD_BODY_Y: the model '// &
          'is plane')
      return
    end do
    allocate (model%gravity(size(record)))
    do k = 1, size(record)
      model%gravity(k)%direction = direction(k)
      model%gravity(k)%curve = curve_of(deck, model, maps, record(k))
      model%gravity(k)%factor = deck%real(record(k), 'SF')
    end do
  end subroutine read_gravity

end module scene_loads
