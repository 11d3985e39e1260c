! SPDX-License-Identifier: BSD-3-Clause
!> Reads a deck by the table of keywords. Strict: every field is honoured, at its default, or a
!> problem with its place; nothing is dropped in silence.
module deck_reader
  use base_status, only: status_t, fail, failed, status_deck
  use base_strings, only: upper, to_text, edit_distance, folder_of, join_path
  use deck_card, only: start_block, read_card
  use deck_data, only: deck_t
  use deck_parameter, only: parameters_t, override_t, read_parameters, report_unused_overrides
  use deck_problems, only: add_problem, add_note, render
  use deck_source, only: cursor_t, load_file, next_line
  use deck_table, only: find_keyword, keyword_skipped, keyword_refused
  implicit none
  private
  integer, parameter :: include_depth = 16
  public :: read_deck

contains

  !> Reads the deck at `path` with everything it includes. deck%table is filled by the caller.
  !> Fails if the main file cannot be read; all other problems are collected in deck%problems.
  subroutine read_deck(path, overrides, deck, status)
    character(*), intent(in) :: path
    type(override_t), intent(inout) :: overrides(:)
    type(deck_t), intent(inout) :: deck
    type(status_t), intent(inout) :: status
    type(parameters_t) :: parameters
    logical :: ended
    allocate (deck%file(64), deck%block(64), deck%record(1024), deck%text(256))
    allocate (deck%value(8192), deck%given(8192))
    deck%files = 1
    call load_file(path, deck%file(1), status)
    if (failed(status)) return
    call read_file(deck, 1, 1, parameters, overrides, ended)
    if (.not. ended) &
        call add_note(deck%problems, path//': no *END; the file was read to its end')
    call report_unused_overrides(overrides, parameters, deck%problems)
  end subroutine read_deck

  !> Reads one file to its *END or its last line.
  recursive subroutine read_file(deck, file, depth, parameters, overrides, ended)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: file
    integer, intent(in) :: depth
    type(parameters_t), intent(inout) :: parameters
    type(override_t), intent(inout) :: overrides(:)
    logical, intent(out) :: ended
    type(cursor_t) :: cursor
    character(:), allocatable :: name
    logical :: more
    ended = .false.
    cursor%file = file
    more = next_line(deck%file(file), cursor)
    do while (more)
      if (.not. is_keyword(deck, cursor)) then
        if (cursor%last >= cursor%first) call stray_card(deck, cursor)
        more = next_line(deck%file(file), cursor)
        cycle
      end if
      name = keyword_name(deck, cursor)
      select case (name)
      case ('END')
        ended = .true.
        return
      case ('INCLUDE')
        call read_include(deck, cursor, depth, parameters, overrides, more)
      case ('PARAMETER')
        call read_parameters(deck, cursor, parameters, overrides, more)
      case default
        call read_block(deck, cursor, name, parameters, more)
      end select
    end do
  end subroutine read_file

  pure logical function is_keyword(deck, cursor)
    type(deck_t), intent(in) :: deck
    type(cursor_t), intent(in) :: cursor
    is_keyword = cursor%last >= cursor%first
    if (is_keyword) is_keyword = deck%file(cursor%file)%text(cursor%first:cursor%first) == '*'
  end function is_keyword

  !> The name after '*' in upper case, to the first blank.
  pure function keyword_name(deck, cursor) result(name)
    type(deck_t), intent(in) :: deck
    type(cursor_t), intent(in) :: cursor
    character(:), allocatable :: name
    integer :: blank
    associate (line => deck%file(cursor%file)%text(cursor%first + 1:cursor%last))
      blank = scan(line//' ', ' '//achar(9))
      name = upper(line(1:blank - 1))
    end associate
  end function keyword_name

  subroutine stray_card(deck, cursor)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    associate (line => deck%file(cursor%file)%text(cursor%first:cursor%last))
      call add_problem(deck%problems, render(deck%file(cursor%file)%path//':'// &
          to_text(cursor%line), 0, 0, 'a card that belongs to no keyword', line, &
          'a keyword starts with * in column 1; a comment with $'))
    end associate
  end subroutine stray_card

  !> Cards of one keyword, up to the next '*'.
  subroutine read_block(deck, cursor, name, parameters, more)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(inout) :: cursor
    character(*), intent(in) :: name
    type(parameters_t), intent(in) :: parameters
    logical, intent(out) :: more
    integer :: row
    logical :: title, id, long, used
    call match_name(deck, name, row, title, id, long)
    used = row > 0
    if (row == 0) then
      call unknown_keyword(deck, cursor, name)
    else
      select case (deck%table%keyword(row)%class)
      case (keyword_skipped)
        call add_note(deck%problems, '*'//name// &
            ' is skipped: it cannot change the solution here')
        used = .false.
      case (keyword_refused)
        call refuse(deck, cursor, name)
        used = .false.
      end select
    end if
    if (used) call start_block(deck, row, name, long)
    more = next_line(deck%file(cursor%file), cursor)
    if (used) then
      call read_card(deck, cursor, parameters, title, id, more)
    else
      do while (more)
        if (is_keyword(deck, cursor)) exit
        more = next_line(deck%file(cursor%file), cursor)
      end do
    end if
  end subroutine read_block

  !> Row of the table for a name with its options _TITLE, _ID and the sign for long form.
  pure subroutine match_name(deck, name, row, title, id, long)
    type(deck_t), intent(in) :: deck
    character(*), intent(in) :: name
    integer, intent(out) :: row
    logical, intent(out) :: title, id, long
    character(:), allocatable :: bare
    bare = name
    long = bare(len(bare):) == '+'
    if (long .or. bare(len(bare):) == '-') bare = bare(1:len(bare) - 1)
    title = .false.
    id = .false.
    row = find_keyword(deck%table, bare)
    if (row > 0) return
    if (ends_with(bare, '_TITLE')) then
      row = find_keyword(deck%table, bare(1:len(bare) - 6))
      if (row > 0) title = deck%table%keyword(row)%may_title
      if (.not. title) row = 0
    else if (ends_with(bare, '_ID')) then
      row = find_keyword(deck%table, bare(1:len(bare) - 3))
      if (row > 0) id = deck%table%keyword(row)%may_id
      if (.not. id) row = 0
    end if
  end subroutine match_name

  pure logical function ends_with(text, tail)
    character(*), intent(in) :: text
    character(*), intent(in) :: tail
    ends_with = len(text) > len(tail)
    if (ends_with) ends_with = text(len(text) - len(tail) + 1:) == tail
  end function ends_with

  subroutine unknown_keyword(deck, cursor, name)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    character(*), intent(in) :: name
    integer :: k, best, distance, nearest
    best = 0
    nearest = huge(nearest)
    do k = 1, deck%table%n
      distance = edit_distance(name, trim(deck%table%keyword(k)%name))
      if (distance >= nearest) cycle
      nearest = distance
      best = k
    end do
    call add_problem(deck%problems, render(deck%file(cursor%file)%path//':'// &
        to_text(cursor%line), 1, len(name) + 1, 'unknown keyword *'//name, &
        deck%file(cursor%file)%text(cursor%first:cursor%last), 'the nearest known one is *'// &
        trim(deck%table%keyword(best)%name)//'; bipact --keywords lists all'))
  end subroutine unknown_keyword

  subroutine refuse(deck, cursor, name)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    character(*), intent(in) :: name
    call add_problem(deck%problems, render(deck%file(cursor%file)%path//':'// &
        to_text(cursor%line), 0, 0, '*'//name//' is not available in this version', '', ''))
  end subroutine refuse

  !> *INCLUDE: the file name, relative to the file that names it.
  recursive subroutine read_include(deck, cursor, depth, parameters, overrides, more)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(inout) :: cursor
    integer, intent(in) :: depth
    type(parameters_t), intent(inout) :: parameters
    type(override_t), intent(inout) :: overrides(:)
    logical, intent(out) :: more
    type(status_t) :: status
    character(:), allocatable :: path
    logical :: ended
    integer :: file, k
    more = next_line(deck%file(cursor%file), cursor)
    do while (more)
      if (is_keyword(deck, cursor)) return
      path = join_path(folder_of(deck%file(cursor%file)%path), &
          trim(adjustl(deck%file(cursor%file)%text(cursor%first:cursor%last))))
      file = deck%files + 1
      k = cursor%file
      do while (k > 0)
        if (deck%file(k)%path == path) &
            call fail(status, status_deck, 'the file includes itself: "'//path//'"')
        k = deck%file(k)%parent
      end do
      if (depth >= include_depth .or. file > size(deck%file)) &
          call fail(status, status_deck, 'too many or too deeply nested include files')
      if (.not. failed(status)) then
        deck%files = file
        deck%file(file)%parent = cursor%file
        deck%file(file)%parent_line = cursor%line
        call load_file(path, deck%file(file), status)
      end if
      if (failed(status)) then
        call add_problem(deck%problems, render(deck%file(cursor%file)%path//':'// &
            to_text(cursor%line), 0, 0, '*INCLUDE: '//status%message, &
            deck%file(cursor%file)%text(cursor%first:cursor%last), &
            'the name is relative to the file that includes it'))
        status = status_t()
      else
        call read_file(deck, file, depth + 1, parameters, overrides, ended)
      end if
      more = next_line(deck%file(cursor%file), cursor)
    end do
  end subroutine read_include

end module deck_reader
