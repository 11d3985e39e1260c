! SPDX-License-Identifier: BSD-3-Clause
!> Reads a deck by the table of keywords. Strict: every field is honoured, at its default, or a
!> problem with its place; nothing is dropped in silence.
module deck_reader
  use base_status, only: status_t, fail, failed, status_deck
  use base_strings, only: upper, to_text
  use deck_card, only: start_block, read_cards, note_blank_line
  use deck_check, only: check_dimension
  use deck_data, only: deck_t
  use deck_folders, only: read_folders, read_file_name, find_include
  use deck_match, only: match_name, base_of
  use deck_parameter, only: override_t, read_parameters, read_expressions, &
      report_unused_overrides
  use deck_problems, only: add_note
  use deck_source, only: cursor_t, load_file, next_line
  use deck_table, only: find_keyword, find_nearest, keyword_used, keyword_skipped, &
      keyword_refused
  implicit none
  private
  integer, parameter :: include_depth = 16
  integer, parameter :: include_limit = 1000
  public :: read_deck, read_deck_text, read_more

contains

  !> Reads the deck at `path` with everything it includes. deck%table is filled by the caller.
  !> Fails if the main file cannot be read; all other problems are collected in deck%problems.
  subroutine read_deck(path, overrides, deck, status)
    character(*), intent(in) :: path
    type(override_t), intent(inout) :: overrides(:)
    type(deck_t), intent(inout) :: deck
    type(status_t), intent(inout) :: status
    logical :: ended, long
    call start_deck(deck)
    call load_file(path, deck%file(1), status)
    if (failed(status)) return
    long = .false.
    call read_file(deck, 1, 1, overrides, long, ended)
    if (.not. ended) &
        call add_note(deck%problems, path//': no *END; the file was read to its end')
    call report_unused_overrides(overrides, deck)
    call find_dimension(deck)
  end subroutine read_deck

  !> Reads a deck that is one text and includes nothing, as write_echo makes them; name: what
  !> messages call it. deck%table is filled by the caller; problems are collected in the deck.
  subroutine read_deck_text(name, text, deck)
    character(*), intent(in) :: name, text
    type(deck_t), intent(inout) :: deck
    type(override_t) :: none(0)
    logical :: ended, long
    call start_deck(deck)
    deck%file(1)%path = name
    deck%file(1)%text = text
    long = .false.
    call read_file(deck, 1, 1, none, long, ended)
    call find_dimension(deck)
  end subroutine read_deck_text

  !> Reads cards that the deck lacks as if they stood at its end: what it leaves open is chosen
  !> so, and the echo has it.
  subroutine read_more(deck, text)
    type(deck_t), intent(inout) :: deck
    character(*), intent(in) :: text
    type(override_t) :: none(0)
    logical :: ended, long
    deck%files = deck%files + 1
    deck%file(deck%files)%path = deck%file(1)%path
    deck%file(deck%files)%text = text
    long = .false.
    call read_file(deck, deck%files, 1, none, long, ended)
  end subroutine read_more

  !> A deck is in space as soon as it has an element there.
  subroutine find_dimension(deck)
    type(deck_t), intent(inout) :: deck
    integer :: b
    do b = 1, deck%blocks
      if (any(deck%table%keyword(deck%block(b)%keyword)%canonical_row &
          == [find_keyword(deck%table, 'ELEMENT_SOLID'), &
          find_keyword(deck%table, 'ELEMENT_SOLID_H27')])) deck%in_space = .true.
    end do
    call check_dimension(deck)
  end subroutine find_dimension

  !> Room for the first file, blocks, cards and parameters.
  subroutine start_deck(deck)
    type(deck_t), intent(inout) :: deck
    allocate (deck%file(include_limit + 1), deck%block(64), deck%record(1024))
    allocate (deck%parameter(16))
    deck%files = 1
  end subroutine start_deck

  !> Reads one file to its *END or its last line. long: fields of 20 columns unless a keyword
  !> says otherwise.
  recursive subroutine read_file(deck, file, depth, overrides, long, ended)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: file
    integer, intent(in) :: depth
    type(override_t), intent(inout) :: overrides(:)
    logical, intent(inout) :: long
    logical, intent(out) :: ended
    type(cursor_t) :: cursor
    character(:), allocatable :: name
    character :: mark
    logical :: more, long_here
    ended = .false.
    cursor%file = file
    more = next_line(deck%file(file), cursor)
    do while (more)
      if (.not. is_keyword(deck, cursor)) then
        if (is_blank(deck, cursor)) then
          call note_blank_line(deck, file)
        else
          call stray_card(deck, cursor)
        end if
        more = next_line(deck%file(file), cursor)
        cycle
      end if
      call keyword_name(deck, cursor, name, mark)
      long_here = mark == '+' .or. (long .and. mark /= '-')
      if (mark == '%') then
        call refuse_ids(deck, cursor, '*'//name//' %')
        call skip_cards(deck, cursor, more, is_text=.true.)
        cycle
      end if
      select case (name)
      case ('END')
        ended = .true.
        return
      case ('KEYWORD')
        call read_options(deck, cursor, long)
        more = next_line(deck%file(file), cursor)
      case ('INCLUDE')
        call read_include(deck, cursor, depth, overrides, long, more)
      case ('INCLUDE_PATH', 'INCLUDE_PATH_RELATIVE')
        call read_folders(deck, cursor, name, more)
      case ('PARAMETER', 'PARAMETER_LOCAL')
        call read_parameters(deck, cursor, overrides, long_here, name /= 'PARAMETER', more)
      case ('PARAMETER_EXPRESSION', 'PARAMETER_EXPRESSION_LOCAL')
        call read_expressions(deck, cursor, overrides, long_here, &
            name /= 'PARAMETER_EXPRESSION', more)
      case default
        call read_block(deck, cursor, name, long_here, more)
      end select
    end do
  end subroutine read_file

  pure logical function is_blank(deck, cursor)
    type(deck_t), intent(in) :: deck
    type(cursor_t), intent(in) :: cursor
    is_blank = len_trim(deck%file(cursor%file)%text(cursor%first:cursor%last)) == 0
  end function is_blank

  pure logical function is_keyword(deck, cursor)
    type(deck_t), intent(in) :: deck
    type(cursor_t), intent(in) :: cursor
    is_keyword = cursor%last >= cursor%first
    if (is_keyword) is_keyword = deck%file(cursor%file)%text(cursor%first:cursor%first) == '*'
  end function is_keyword

  !> The name after '*' in upper case, to the first blank, and the mark at its end or alone
  !> after it: + long fields, - standard fields, % ids of ten columns.
  pure subroutine keyword_name(deck, cursor, name, mark)
    type(deck_t), intent(in) :: deck
    type(cursor_t), intent(in) :: cursor
    character(:), allocatable, intent(out) :: name
    character, intent(out) :: mark
    integer :: blank, n
    mark = ' '
    associate (line => deck%file(cursor%file)%text(cursor%first + 1:cursor%last))
      blank = scan(line//' ', ' '//achar(9))
      name = upper(line(1:blank - 1))
      n = len(name)
      if (len_trim(adjustl(line(blank:))) == 1) mark = adjustl(line(blank:))
    end associate
    if (n < 2) return
    if (scan(name(n:n), '+-%') > 0) then
      mark = name(n:n)
      name = name(1:n - 1)
    end if
  end subroutine keyword_name

  !> The options of *KEYWORD: LONG=Y makes every field 20 columns wide; LONG=S and LONG=K read
  !> standard fields; I10=Y is not available; others (memory, ncpu) are noted.
  subroutine read_options(deck, cursor, long)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    logical, intent(inout) :: long
    character(:), allocatable :: rest, word
    integer :: blank
    associate (line => deck%file(cursor%file)%text(cursor%first:cursor%last))
      rest = trim(upper(line(min(9, len(line) + 1):)))
      do while (len_trim(rest) > 0)
        rest = adjustl(rest)
        blank = scan(rest//' ', ' ,')
        word = rest(1:blank - 1)
        rest = trim(rest(min(blank + 1, len(rest) + 1):))
        select case (word)
        case ('')
          cycle
        case ('LONG=Y')
          long = .true.
        case ('LONG=S', 'LONG=K', 'I10=N')
          long = .false.
        case ('I10=Y')
          call refuse_ids(deck, cursor, '*KEYWORD I10=Y')
        case default
          call add_note(deck%problems, '*KEYWORD '//word//' has no effect')
        end select
      end do
    end associate
  end subroutine read_options

  subroutine refuse_ids(deck, cursor, what)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    character(*), intent(in) :: what
    call deck%complain_at(cursor%file, cursor%line, 0, 0, what// &
        ' (ids of ten columns) is not available in this version', &
        deck%file(cursor%file)%text(cursor%first:cursor%last), '')
  end subroutine refuse_ids

  subroutine stray_card(deck, cursor)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    call deck%complain_at(cursor%file, cursor%line, 0, 0, 'a card that belongs to no keyword', &
        deck%file(cursor%file)%text(cursor%first:cursor%last), &
        'a keyword starts with * in column 1; a comment with $')
  end subroutine stray_card

  !> Cards of one keyword, up to the next '*'.
  subroutine read_block(deck, cursor, name, long, more)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(inout) :: cursor
    character(*), intent(in) :: name
    logical, intent(in) :: long
    logical, intent(out) :: more
    integer :: row, head
    logical :: used
    call match_name(deck%table, name, row, head)
    used = .false.
    if (name == 'TITLE' .and. deck%file(cursor%file)%parent > 0) then
      call add_note(deck%problems, deck%file(cursor%file)%path// &
          ': *TITLE of an included file is passed over')
    else if (row == 0) then
      call unknown_keyword(deck, cursor, name)
    else
      used = deck%table%keyword(row)%class == keyword_used
      select case (deck%table%keyword(row)%class)
      case (keyword_skipped)
        call add_note(deck%problems, '*'//name//' is skipped: '// &
            trim(deck%table%keyword(row)%help))
      case (keyword_refused)
        call deck%complain_at(cursor%file, cursor%line, 0, 0, '*'//name// &
            ' is not available in this version', '', trim(deck%table%keyword(row)%help))
      end select
    end if
    if (used) call start_block(deck, cursor, row, name, long)
    if (used) then
      more = next_line(deck%file(cursor%file), cursor)
      call read_cards(deck, cursor, head, more)
    else
      call skip_cards(deck, cursor, more, &
          is_text=name == 'COMMENT' .or. index(name, 'KEYWORD_') == 1)
    end if
  end subroutine read_block

  !> Moves the cursor to the next keyword. A keyword with blanks before it must not be skipped
  !> with the cards of the last one, unless these are a text.
  subroutine skip_cards(deck, cursor, more, is_text)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(inout) :: cursor
    logical, intent(out) :: more
    logical, intent(in) :: is_text
    do
      more = next_line(deck%file(cursor%file), cursor)
      if (.not. more) return
      if (is_keyword(deck, cursor)) return
      associate (line => deck%file(cursor%file)%text(cursor%first:cursor%last))
        if (is_text .or. verify(line, ' ') == 0) cycle
        if (line(verify(line, ' '):verify(line, ' ')) == '*') call deck%complain_at( &
            cursor%file, cursor%line, 1, verify(line, ' '), &
            'a keyword starts with * in column 1', line, '')
      end associate
    end do
  end subroutine skip_cards

  subroutine unknown_keyword(deck, cursor, name)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    character(*), intent(in) :: name
    character(:), allocatable :: hint
    integer :: best, distance
    best = base_of(deck%table, name)
    if (best > 0) then
      hint = '*'//trim(deck%table%keyword(best)%name)//' has no option '// &
          name(index(name, '_', back=.true.):)
    else
      call find_nearest(deck%table, name, best, distance)
      hint = 'the nearest known one is *'//trim(deck%table%keyword(best)%name)
    end if
    call deck%complain_at(cursor%file, cursor%line, 1, len(name) + 1, 'unknown keyword *'// &
        name, deck%file(cursor%file)%text(cursor%first:cursor%last), hint// &
        '; bipact --keywords lists all')
  end subroutine unknown_keyword

  !> *INCLUDE: file names, one a line, relative to the file that names them; " +" at the end of
  !> a line continues the name on the next.
  recursive subroutine read_include(deck, cursor, depth, overrides, long, more)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(inout) :: cursor
    integer, intent(in) :: depth
    type(override_t), intent(inout) :: overrides(:)
    logical, intent(in) :: long
    logical, intent(out) :: more
    type(cursor_t) :: start
    character(:), allocatable :: name
    logical :: any_name
    any_name = .false.
    start = cursor
    more = next_line(deck%file(cursor%file), cursor)
    do while (more)
      if (is_keyword(deck, cursor)) exit
      if (is_blank(deck, cursor)) then
        call note_blank_line(deck, cursor%file)
      else
        any_name = .true.
        call read_file_name(deck, cursor, name, more)
        call include_file(deck, cursor, name, depth, overrides, long)
      end if
      if (more) more = next_line(deck%file(cursor%file), cursor)
    end do
    if (.not. any_name) call deck%complain_at(start%file, start%line, 0, 0, &
        '*INCLUDE: the name of a file is missing', '', '')
  end subroutine read_include

  !> long: as the file has it that includes; what the included one says of itself stays there.
  recursive subroutine include_file(deck, cursor, name, depth, overrides, long)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(in) :: cursor
    character(*), intent(in) :: name
    integer, intent(in) :: depth
    type(override_t), intent(inout) :: overrides(:)
    logical, intent(in) :: long
    type(status_t) :: status
    character(:), allocatable :: path
    integer :: k
    logical :: ended, long_there
    path = find_include(deck, cursor%file, name)
    k = cursor%file
    do while (k > 0)
      if (deck%file(k)%path == path) &
          call fail(status, status_deck, 'the file includes itself: "'//path//'"')
      k = deck%file(k)%parent
    end do
    if (len(name) == 0) call fail(status, status_deck, 'the name of a file is missing')
    if (depth >= include_depth) call fail(status, status_deck, 'more than '// &
        to_text(include_depth)//' files include each other in a chain')
    if (deck%files >= include_limit) &
        call fail(status, status_deck, 'more than '//to_text(include_limit)//' files')
    if (.not. failed(status)) then
      deck%files = deck%files + 1
      deck%file(deck%files)%parent = cursor%file
      deck%file(deck%files)%parent_line = cursor%line
      call load_file(path, deck%file(deck%files), status)
    end if
    if (failed(status)) then
      call deck%complain_at(cursor%file, cursor%line, 0, 0, '*INCLUDE: '//status%message, &
          deck%file(cursor%file)%text(cursor%first:cursor%last), &
          'a name is relative to the file that includes it, or to a folder of *INCLUDE_PATH')
    else
      long_there = long
      call read_file(deck, deck%files, depth + 1, overrides, long_there, ended)
    end if
  end subroutine include_file

end module deck_reader
