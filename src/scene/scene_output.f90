! SPDX-License-Identifier: BSD-3-Clause
!> Requests for tables, their nodes and elements.
module scene_output
  use base_kinds, only: wp, zero
  use deck_data, only: deck_t
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
    associate (r => model%requests)
      call read_interval(deck, 'DATABASE_GLSTAT', r%glstat)
      call read_interval(deck, 'DATABASE_MATSUM', r%matsum)
      call read_interval(deck, 'DATABASE_NODOUT', r%nodout)
      call read_interval(deck, 'DATABASE_ELOUT', r%elout)
      call read_interval(deck, 'DATABASE_RCFORC', r%rcforc)
      call read_interval(deck, 'DATABASE_RWFORC', r%rwforc)
      call read_interval(deck, 'DATABASE_SLEOUT', r%sleout)
      call read_interval(deck, 'DATABASE_SPCFORC', r%spcforc)
      call read_interval(deck, 'DATABASE_NCFORC', r%ncforc)
      call read_interval(deck, 'BIPACT_TIMING', r%timing)
      allocate (r%history_node(0), r%history_element(0))
      call read_history(deck, 'DATABASE_HISTORY_NODE', 'node', maps%node, no_set, &
          r%history_node)
      call read_history(deck, 'DATABASE_HISTORY_NODE_ID', 'node', maps%node, no_set, &
          r%history_node)
      call read_history(deck, 'DATABASE_HISTORY_NODE_SET', 'node set', maps%node_set, &
          model%node_set, r%history_node)
      call read_history(deck, 'DATABASE_HISTORY_SHELL', 'element', maps%element, no_set, &
          r%history_element)
      call read_history(deck, 'DATABASE_HISTORY_SHELL_ID', 'element', maps%element, no_set, &
          r%history_element)
      call read_history(deck, 'DATABASE_HISTORY_SHELL_SET', 'element set', maps%element_set, &
          model%element_set, r%history_element)
      call drop_empty(deck, 'NODOUT without *DATABASE_HISTORY_NODE', &
          size(r%history_node) == 0, r%nodout)
      call drop_empty(deck, 'ELOUT without *DATABASE_HISTORY_SHELL', &
          size(r%history_element) == 0, r%elout)
      call drop_empty(deck, 'RCFORC without contact', size(model%contact) == 0, r%rcforc)
      call drop_empty(deck, 'RWFORC without *RIGIDWALL', size(model%wall) == 0, r%rwforc)
      call drop_empty(deck, 'SLEOUT without contact', &
          size(model%contact) + size(model%wall) == 0, r%sleout)
      call drop_empty(deck, 'NCFORC without contact', size(model%contact) == 0, r%ncforc)
      call drop_empty(deck, 'SPCFORC without supports', &
          .not. any(model%fixed) .and. size(model%motion) == 0, r%spcforc)
    end associate
  end subroutine read_requests

  subroutine drop_empty(deck, what, is_empty, interval)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: what
    logical, intent(in) :: is_empty
    real(wp), intent(inout) :: interval
    if (.not. is_empty .or. .not. interval > zero) return
    call add_note(deck%problems, '*DATABASE_'//what//': no table')
    interval = zero
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
    integer, allocatable :: more(:)
    integer :: r, m, id, row, fields
    fields = merge(1, 8, index(keyword, '_ID') > 0)
    r = deck%next(keyword, 1, 0)
    do while (r > 0)
      allocate (more(0))
      do m = 1, fields
        id = nint(deck%number_at(r, m))
        if (id == 0) cycle
        row = find_or_complain(deck, map, r, 'ID'//achar(48 + m), id, what)
        if (row == 0) cycle
        if (size(sets) == 0) more = [more, row]
        if (size(sets) > 0) more = [more, sets(row)%member]
      end do
      rows = [rows, more]
      deallocate (more)
      r = deck%next(keyword, 1, r)
    end do
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
