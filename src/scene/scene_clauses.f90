! SPDX-License-Identifier: BSD-3-Clause
!> Sets by clauses (*SET_..._GENERAL): all, by numbers, by parts, by boxes; clauses that begin
!> with D take away. They are obeyed in the order of the cards.
module scene_clauses
  use base_kinds, only: wp
  use deck_data, only: deck_t
  use model_data, only: model_t
  use model_faces, only: exterior_facets
  use scene_ids, only: maps_t, id_map_t, make_id_map, records_of, find_or_complain
  implicit none
  private

  !> A box along the axes [L].
  type, public :: box_t
    real(wp) :: low(3) = 0.0_wp, high(3) = 0.0_wp
  end type box_t

  !> The element edges, in space faces, that no second element has.
  type, public :: edges_t
    !> (2, edges) in the direction of the element; in space (4), of triangles the last 0
    integer, allocatable :: node(:, :)
    integer, allocatable :: owner(:)     !< element of each
    !> The first edge that begins at a node, and the next that does at the same node; 0 = none
    integer, allocatable :: first(:), next(:)
  end type edges_t

  !> Numbers that a clause may give.
  integer, parameter :: most_named = 7

  public :: read_boxes, read_clauses, read_segment_clauses

contains

  !> *DEFINE_BOX.
  subroutine read_boxes(deck, maps, box)
    type(deck_t), intent(inout) :: deck
    type(maps_t), intent(inout) :: maps
    type(box_t), allocatable, intent(out) :: box(:)
    character, parameter :: axis(3) = ['X', 'Y', 'Z']
    integer, allocatable :: record(:), ids(:)
    integer :: k, d
    call records_of(deck, 'DEFINE_BOX', 1, record)
    allocate (box(size(record)), ids(size(record)))
    do k = 1, size(record)
      ids(k) = deck%integer(record(k), 'BOXID')
      do d = 1, 3
        box(k)%low(d) = deck%real(record(k), axis(d)//'MN')
        box(k)%high(d) = deck%real(record(k), axis(d)//'MX')
        if (box(k)%high(d) < box(k)%low(d)) call deck%complain(record(k), axis(d)//'MX', &
            'expected a number that is not below '//axis(d)//'MN')
      end do
    end do
    call make_id_map(deck, 'box', 'BOXID', ids, record, maps%box)
  end subroutine read_boxes

  !> Rows of the nodes (kind 'NODE') or elements of a set. An element lies in a box
  !> when its nodes do. A clause of numbers costs what they are, for there may be many.
  subroutine read_clauses(deck, model, maps, box, head, kind, rows)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    type(box_t), intent(in) :: box(:)
    integer, intent(in) :: head
    character(*), intent(in) :: kind
    integer, allocatable, intent(out) :: rows(:)
    logical, allocatable :: in_set(:), named(:)
    character(:), allocatable :: option
    logical :: adds
    integer :: r, k, named_row(most_named), n
    allocate (in_set(merge(model%nodes, model%mesh%n, kind == 'NODE')))
    in_set = .false.
    do r = head + 1, deck%block(deck%record(head)%block)%last
      call split_option(deck, r, option, adds)
      select case (option)
      case ('ALL')
        in_set = adds
      case ('NODE')
        call find_named(deck, maps%node, r, 'node', named_row, n)
        in_set(named_row(:n)) = adds
      case ('ELEM')
        call find_named(deck, maps%element, r, 'element', named_row, n)
        in_set(named_row(:n)) = adds
      case default
        call mark_elements(deck, model, maps, box, r, option, kind, named)
        where (named) in_set = adds
      end select
    end do
    rows = pack([(k, k=1, size(in_set))], in_set)
  end subroutine read_clauses

  !> Nodes of the exterior edges or faces of a set, (2 or 4, segments). One belongs to a part
  !> when its element does, and lies in a box when all its nodes do. edges are found when they
  !> are not there yet.
  subroutine read_segment_clauses(deck, model, maps, box, head, edges, node)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    type(box_t), intent(in) :: box(:)
    integer, intent(in) :: head
    type(edges_t), intent(inout) :: edges
    integer, allocatable, intent(out) :: node(:, :)
    logical, allocatable :: in_set(:), named(:)
    character(:), allocatable :: option
    logical :: adds
    integer :: r, e
    if (deck%problems%count > 0) then
      allocate (node(2*(model%dim - 1), 0))
      return
    end if
    if (.not. allocated(edges%owner)) call find_exterior(model, edges)
    allocate (in_set(size(edges%owner)))
    in_set = .false.
    do r = head + 1, deck%block(deck%record(head)%block)%last
      call split_option(deck, r, option, adds)
      select case (option)
      case ('ALL')
        in_set = adds
      case ('SEG')
        call find_segment(deck, maps, r, model%dim, edges, e)
        if (e > 0) in_set(e) = adds
      case default
        call mark_edges(deck, model, maps, box, r, option, edges, named)
        where (named) in_set = adds
      end select
    end do
    node = edges%node(:, pack([(e, e=1, size(in_set))], in_set))
    if (.not. any(in_set) .and. deck%problems%count == 0) &
        call deck%complain(head, 'SID', 'the segment set is empty')
  end subroutine read_segment_clauses

  !> The word of a clause without the D that takes away.
  subroutine split_option(deck, record, option, adds)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record
    character(:), allocatable, intent(out) :: option
    logical, intent(out) :: adds
    option = deck%word(record, 'OPTION')
    adds = option(1:1) /= 'D'
    if (.not. adds) option = option(2:)
  end subroutine split_option

  !> The n rows whose numbers stand in E1 to E7.
  subroutine find_named(deck, map, record, what, row, n)
    type(deck_t), intent(inout) :: deck
    type(id_map_t), intent(in) :: map
    integer, intent(in) :: record
    character(*), intent(in) :: what
    integer, intent(out) :: row(most_named), n
    integer :: m, id
    n = 0
    do m = 2, 1 + most_named
      id = nint(deck%number_at(record, m))
      if (id == 0) cycle
      row(n + 1) = find_or_complain(deck, map, record, deck%field_name(record, m), id, what)
      if (row(n + 1) > 0) n = n + 1
    end do
  end subroutine find_named

  !> Marks them among `total` rows.
  subroutine mark_named(deck, map, record, what, total, named)
    type(deck_t), intent(inout) :: deck
    type(id_map_t), intent(in) :: map
    integer, intent(in) :: record, total
    character(*), intent(in) :: what
    logical, allocatable, intent(out) :: named(:)
    integer :: row(most_named), n
    allocate (named(total))
    named = .false.
    call find_named(deck, map, record, what, row, n)
    named(row(:n)) = .true.
  end subroutine mark_named

  !> Marks nodes or elements of the parts or boxes in E1 to E7.
  subroutine mark_elements(deck, model, maps, box, record, option, kind, named)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    type(box_t), intent(in) :: box(:)
    integer, intent(in) :: record
    character(*), intent(in) :: option, kind
    logical, allocatable, intent(out) :: named(:)
    logical, allocatable :: element(:), node(:), group(:)
    integer :: e
    if (option == 'PART') then
      call mark_named(deck, maps%part, record, 'part', size(model%part), group)
      element = group(model%mesh%part)
      node = spread(.false., 1, model%nodes)
      do e = 1, model%mesh%n
        if (element(e)) node(model%mesh%nodes_of(e)) = .true.
      end do
    else
      call mark_named(deck, maps%box, record, 'box', size(box), group)
      node = in_boxes(model, pack(box, group))
      element = [(all(node(model%mesh%nodes_of(e))), e=1, model%mesh%n)]
    end if
    if (kind == 'NODE') named = node
    if (kind /= 'NODE') named = element
  end subroutine mark_elements

  !> The exterior edge with the nodes E1 and E2, in space the face with those in E1 to E4; a
  !> problem and 0 if there is none.
  subroutine find_segment(deck, maps, record, dim, edges, e)
    type(deck_t), intent(inout) :: deck
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record, dim
    type(edges_t), intent(in) :: edges
    integer, intent(out) :: e
    integer :: row(most_named), n, k, m
    call find_named(deck, maps%node, record, 'node', row, n)
    if (n == 4) then
      if (row(4) == row(3)) n = 3
    end if
    do k = 1, n
      e = edges%first(row(k))
      do while (e > 0)
        if (count(edges%node(:, e) > 0) == n .and. &
            all([(any(row(:n) == edges%node(m, e)), m=1, n)])) return
        e = edges%next(e)
      end do
    end do
    e = 0
    if (dim == 2) call deck%complain(record, 'E1', &
        'expected the two nodes of one exposed element edge in E1 and E2')
    if (dim == 3) call deck%complain(record, 'E1', &
        'expected the nodes of one exterior element face in E1 to E4')
  end subroutine find_segment

  !> Marks exposed edges of the parts or boxes in E1 to E7.
  subroutine mark_edges(deck, model, maps, box, record, option, edges, named)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    type(box_t), intent(in) :: box(:)
    integer, intent(in) :: record
    character(*), intent(in) :: option
    type(edges_t), intent(in) :: edges
    logical, allocatable, intent(out) :: named(:)
    logical, allocatable :: node(:), group(:)
    integer :: e
    if (option == 'PART') then
      call mark_named(deck, maps%part, record, 'part', size(model%part), group)
      named = group(model%mesh%part(edges%owner))
    else
      call mark_named(deck, maps%box, record, 'box', size(box), group)
      node = in_boxes(model, pack(box, group))
      named = [(all(node(pack(edges%node(:, e), edges%node(:, e) > 0))), &
          e=1, size(edges%owner))]
    end if
  end subroutine mark_edges

  pure function in_boxes(model, box) result(is_in)
    type(model_t), intent(in) :: model
    type(box_t), intent(in) :: box(:)
    logical :: is_in(model%nodes)
    logical :: is_here(model%nodes)
    integer :: b, d
    is_in = .false.
    do b = 1, size(box)
      associate (low => box(b)%low, high => box(b)%high)
        if (model%dim == 2 .and. (model%z < low(3) .or. model%z > high(3))) cycle
        is_here = .true.
        do d = 1, model%dim
          is_here = is_here .and. model%x(d, :) >= low(d) .and. model%x(d, :) <= high(d)
        end do
        is_in = is_in .or. is_here
      end associate
    end do
  end function in_boxes

  !> All of them, chained by the node at which they begin.
  subroutine find_exterior(model, edges)
    type(model_t), intent(in) :: model
    type(edges_t), intent(out) :: edges
    integer, allocatable :: facet(:)
    integer :: e
    call exterior_facets(model%mesh, model%nodes, 2*(model%dim - 1), edges%node, edges%owner, &
        facet)
    allocate (edges%first(model%nodes), edges%next(size(edges%owner)))
    edges%first = 0
    do e = 1, size(edges%owner)
      edges%next(e) = edges%first(edges%node(1, e))
      edges%first(edges%node(1, e)) = e
    end do
  end subroutine find_exterior

end module scene_clauses
