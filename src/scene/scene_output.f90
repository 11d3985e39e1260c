! SPDX-License-Identifier: BSD-3-Clause
!> Requests for tables, their nodes and elements.
module scene_output
  use base_kinds, only: wp, zero
  use base_list, only: append
  use deck_data, only: deck_t
  use deck_names, only: table_keywords, table_count, table_nodout, table_elout, table_rcforc, &
      table_rwforc, table_sleout, table_ncforc, table_spcforc, table_rbdout
  use deck_problems, only: add_note
  use model_data, only: model_t, set_t
  use scene_ids, only: maps_t, id_map_t, find_or_complain
  implicit none
  private
  public :: read_requests

contains

  !> Intervals and histories. A table of nodes or elements that nobody names is noted, not made.
  subroutine read_requests(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    type(set_t) :: no_set(0)
    character(:), allocatable :: element
    integer :: k
    associate (r => model%requests)
      do k = 1, table_count
        call read_interval(deck, trim(table_keywords(k)), r%interval(k))
      end do
      allocate (r%history_node(0), r%history_element(0))
      call read_history(deck, 'DATABASE_HISTORY_NODE', 'node', maps%node, no_set, &
          r%history_node)
      call read_history(deck, 'DATABASE_HISTORY_NODE_ID', 'node', maps%node, no_set, &
          r%history_node)
      call read_history(deck, 'DATABASE_HISTORY_NODE_SET', 'node set', maps%node_set, &
          model%node_set, r%history_node)
      element = 'DATABASE_HISTORY_'//merge('SOLID', 'SHELL', model%dim == 3)
      call read_history(deck, element, 'element', maps%element, no_set, r%history_element)
      call read_history(deck, element//'_ID', 'element', maps%element, no_set, &
          r%history_element)
      call read_history(deck, element//'_SET', 'element set', maps%element_set, &
          model%element_set, r%history_element)
      call drop_empty(deck, table_nodout, '*DATABASE_HISTORY_NODE', &
          size(r%history_node) == 0, r%interval)
      call drop_empty(deck, table_elout, '*'//element, &
          size(r%history_element) == 0, r%interval)
      call drop_empty(deck, table_rcforc, 'contact', size(model%contact) == 0, r%interval)
      call drop_empty(deck, table_rwforc, '*RIGIDWALL', size(model%wall) == 0, r%interval)
      call drop_empty(deck, table_sleout, 'contact', &
          size(model%contact) + size(model%wall) == 0, r%interval)
      call drop_empty(deck, table_ncforc, 'contact', size(model%contact) == 0, r%interval)
      call drop_empty(deck, table_spcforc, 'supports', &
          .not. any(model%fixed) .and. size(model%motion) == 0, r%interval)
      call drop_empty(deck, table_rbdout, '*MAT_RIGID', .not. any(model%part%is_rigid), &
          r%interval)
    end associate
  end subroutine read_requests

  !> A table that would be empty without something that is missing is noted, not made.
  subroutine drop_empty(deck, table, needed, is_empty, interval)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: table
    character(*), intent(in) :: needed
    logical, intent(in) :: is_empty
    real(wp), intent(inout) :: interval(:)
    if (.not. is_empty .or. .not. interval(table) > zero) return
    call add_note(deck%problems, '*'//trim(table_keywords(table))//' without '//needed// &
        ': no table')
    interval(table) = zero
  end subroutine drop_empty

  subroutine read_interval(deck, keyword, interval)
    type(deck_t), intent(in) :: deck
    character(*), intent(in) :: keyword
    real(wp), intent(inout) :: interval
    integer :: r
    r = deck%next(keyword, 1, 0)
    if (r > 0) interval = deck%real(r, 'DT')
  end subroutine read_interval

  !> Rows of the ids on the cards of a history keyword (eight a card; of _ID one and a heading),
  !> or of the members of the sets they name; each row once.
  subroutine read_history(deck, keyword, what, map, sets, rows)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: keyword, what
    type(id_map_t), intent(in) :: map
    type(set_t), intent(in) :: sets(:)
    integer, allocatable, intent(inout) :: rows(:)
    integer :: r, m, n, id, row, fields
    fields = merge(1, 8, index(keyword, '_ID') > 0)
    n = size(rows)
    r = deck%next(keyword, 1, 0)
    do while (r > 0)
      do m = 1, fields
        id = nint(deck%number_at(r, m))
        if (id == 0) cycle
        row = find_or_complain(deck, map, r, 'ID'//achar(48 + m), id, what)
        if (row == 0) cycle
        if (size(sets) == 0) call append([row], rows, n)
        if (size(sets) > 0) call append(sets(row)%member, rows, n)
      end do
      r = deck%next(keyword, 1, r)
    end do
    rows = rows(:n)
    call keep_first(rows)
  end subroutine read_history

  !> Drops repetitions, keeps the order.
  pure subroutine keep_first(rows)
    integer, allocatable, intent(inout) :: rows(:)
    logical, allocatable :: seen(:), keep(:)
    integer :: k
    allocate (seen(0:maxval([0, rows])), keep(size(rows)))
    seen = .false.
    do k = 1, size(rows)
      keep(k) = .not. seen(rows(k))
      seen(rows(k)) = .true.
    end do
    rows = pack(rows, keep)
  end subroutine keep_first

end module scene_output
