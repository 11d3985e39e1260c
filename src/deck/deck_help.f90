! SPDX-License-Identifier: BSD-3-Clause
!> What --help and --keywords print; doc/deck.md comes from the same table.
module deck_help
  use base_strings, only: to_text
  use deck_table, only: table_t, keyword_t, field_t, keyword_used, keyword_skipped, &
      keyword_refused, keyword_frame, field_honoured, field_tuning, field_fixed, &
      field_ignored, field_in_space
  implicit none
  private
  public :: write_usage, write_keywords, write_keyword

contains

  !> The command line.
  subroutine write_usage(unit)
    integer, intent(in) :: unit
    character(80), parameter :: line(19) = [character(80) :: &
      'bipact DECK [-o DIR] [-D name=value]... [--restart FILE] [--threads N]', &
      '       [--check | --plan] [--quiet]', &
      'bipact --keywords [NAME] | --help | --version', '', &
      '  DECK            input deck (a subset of the LS-DYNA keyword format)', &
      '  -o DIR          folder of the results; default: DECK''s name with .out', &
      '  -D name=value   replaces the value of a *PARAMETER of the deck', &
      '  --restart FILE  goes on from a restart file; latest: the newest good one', &
      '  --threads N     threads, in place of THREADS of *BIPACT_SOLVER', &
      '  --check         reads and checks the deck; writes no file', &
      '  --plan          prints what the scene needs; writes no file', &
      '  --quiet         no summary and no progress line', &
      '  --keywords      lists the keywords, their cards and fields, or those of one', '', &
      'exit code: 0 done, 1 numerical failure, 2 deck error, 3 file, system or', &
      '           command line error, 4 stopped by a signal', '', &
      'Results as the deck asks: tables, field files, restart files; log, deck.echo.k.', '']
    integer :: k
    do k = 1, size(line) - 1
      write (unit, '(a)') trim(line(k))
    end do
  end subroutine write_usage

  !> Every keyword with its cards and fields, then those without effect and those that are
  !> refused, as Markdown.
  subroutine write_keywords(table, unit)
    type(table_t), intent(in) :: table
    integer, intent(in) :: unit
    integer :: k
    do k = 1, table%n
      if (table%keyword(k)%class == keyword_frame) write (unit, '(a)') '- `*'// &
          trim(table%keyword(k)%name)//'` '//trim(table%keyword(k)%help)
    end do
    write (unit, '(a)') ''
    do k = 1, table%n
      associate (keyword => table%keyword(k))
        if (keyword%class == keyword_used .and. .not. keyword%noted) &
            call write_used(keyword, unit, with_cards=keyword%name == keyword%canonical)
      end associate
    end do
    write (unit, '(a)') '## Read without effect'
    write (unit, '(a)') ''
    write (unit, '(a)') 'One note each in the log; they cannot change the solution here.'
    write (unit, '(a)') ''
    call write_list(table, keyword_skipped, unit)
    write (unit, '(a)') '## Refused by name'
    write (unit, '(a)') ''
    write (unit, '(a)') &
        'Known, but not available in this version: an error, never ignored. `*` '// &
        'at the end stands for the whole family, apart from the keywords above.'
    write (unit, '(a)') ''
    call write_list(table, keyword_refused, unit)
  end subroutine write_keywords

  !> One keyword by its row of the table.
  subroutine write_keyword(table, row, unit)
    type(table_t), intent(in) :: table
    integer, intent(in) :: row, unit
    associate (keyword => table%keyword(row))
      select case (keyword%class)
      case (keyword_used)
        call write_used(keyword, unit, with_cards=.true.)
      case (keyword_frame)
        write (unit, '(a)') '*'//trim(keyword%name)//' '//trim(keyword%help)//' (doc/deck.md)'
      case (keyword_skipped)
        write (unit, '(a)') '*'//trim(keyword%name)//' is skipped with a note: '// &
            trim(keyword%help)
      case (keyword_refused)
        write (unit, '(a)') '*'//trim(keyword%name)//' is not available in this version'
        if (len_trim(keyword%help) > 0) write (unit, '(a)') trim(keyword%help)
      end select
    end associate
  end subroutine write_keyword

  !> A keyword, with its cards or not.
  subroutine write_used(keyword, unit, with_cards)
    type(keyword_t), intent(in) :: keyword
    integer, intent(in) :: unit
    logical, intent(in) :: with_cards
    integer :: c
    write (unit, '(a)') '### *'//trim(keyword%name)
    write (unit, '(a)') ''
    write (unit, '(a)') capital(trim(keyword%help))//'.'//trim(options(keyword))
    write (unit, '(a)') ''
    if (.not. with_cards) return
    do c = 1, keyword%cards
      call write_card(keyword, c, unit)
    end do
  end subroutine write_used

  !> Names of one class, those of one reason together.
  subroutine write_list(table, class, unit)
    type(table_t), intent(in) :: table
    integer, intent(in) :: class, unit
    character(:), allocatable :: names
    logical, allocatable :: listed(:)
    integer :: k, m
    allocate (listed(table%n))
    listed = .false.
    do k = 1, table%n
      if (listed(k) .or. .not. is_of(table%keyword(k), class)) cycle
      names = ''
      do m = k, table%n
        if (.not. is_of(table%keyword(m), class)) cycle
        if (table%keyword(m)%help /= table%keyword(k)%help) cycle
        names = names//', `*'//trim(table%keyword(m)%name)//'`'
        listed(m) = .true.
      end do
      if (len_trim(table%keyword(k)%help) > 0) names = names//': '//trim(table%keyword(k)%help)
      write (unit, '(a)') '- '//names(3:)
    end do
    write (unit, '(a)') ''
  end subroutine write_list

  !> A keyword that is read and noted belongs to those that are skipped.
  pure logical function is_of(keyword, class)
    type(keyword_t), intent(in) :: keyword
    integer, intent(in) :: class
    is_of = keyword%class == class .or. (keyword%noted .and. class == keyword_skipped)
  end function is_of

  pure function capital(text) result(out)
    character(*), intent(in) :: text
    character(len(text)) :: out
    out = text
    if (text(1:1) >= 'a' .and. text(1:1) <= 'z') out(1:1) = achar(iachar(text(1:1)) - 32)
  end function capital

  pure function options(keyword) result(text)
    type(keyword_t), intent(in) :: keyword
    character(:), allocatable :: text
    text = ''
    if (keyword%may_title) text = text//' `_TITLE` adds a text card first.'
    if (keyword%may_id) text = text//trim(merge(' `_ID` or `_TITLE` adds', &
        ' `_ID` adds            ', keyword%title_is_id))//' a card with id and heading first.'
    if (keyword%once) text = text//' At most once per deck.'
    if (keyword%repeat_from > 0) text = text//' Cards from '//to_text(keyword%repeat_from)// &
        ' on repeat.'
  end function options

  subroutine write_card(keyword, c, unit)
    type(keyword_t), intent(in) :: keyword
    integer, intent(in) :: c, unit
    integer :: f
    write (unit, '(a)') 'Card '//to_text(c)//trim(merge(' (optional)', '           ', &
        c > keyword%required .and. keyword%repeat_from == 0))//':'
    write (unit, '(a)') ''
    write (unit, '(a)') '| field | columns | type | units | default | range | use | meaning |'
    write (unit, '(a)') '|---|---|---|---|---|---|---|---|'
    do f = 1, keyword%card(c)%fields
      associate (x => keyword%card(c)%field(f))
        write (unit, '(a)') '| '//trim(x%name)//' | '//to_text(x%first)//'-'// &
            to_text(x%first + x%width - 1)//' | '//x%kind//' | '//trim(x%units)//' | '// &
            trim(default_text(x))//' | '//range_text(x)//' | '//trim(use_text(x%class))// &
            ' | '//trim(x%help)//' |'
      end associate
    end do
    write (unit, '(a)') ''
  end subroutine write_card

  pure function default_text(field) result(text)
    type(field_t), intent(in) :: field
    character(24) :: text
    text = field%default
    if (field%required) text = 'required'
    if (field%zero_is_default) text = trim(field%default)//' (0 too)'
  end function default_text

  pure function range_text(field) result(text)
    type(field_t), intent(in) :: field
    character(:), allocatable :: text
    text = ''
    if (len_trim(field%words) > 0) text = words_text(trim(field%words))
    if (field%low > -huge(field%low)) text = trim(merge('> ', '>=', field%low_open))//' '// &
        to_text(field%low)
    if (field%high < huge(field%high)) text = text//' '// &
        trim(merge('< ', '<=', field%high_open))//' '//to_text(field%high)
    if (field%plane_high < huge(field%high)) text = text//' (plane: '// &
        to_text(field%plane_high)//')'
  end function range_text

  !> |A|B| as "A, B".
  pure function words_text(words) result(text)
    character(*), intent(in) :: words
    character(:), allocatable :: text
    integer :: k
    text = ''
    do k = 2, len(words) - 1
      if (words(k:k) == '|') text = text//', '
      if (words(k:k) /= '|') text = text//words(k:k)
    end do
  end function words_text

  pure function use_text(class) result(text)
    integer, intent(in) :: class
    character(24) :: text
    select case (class)
    case (field_honoured)
      text = 'honoured'
    case (field_tuning)
      text = 'noted, no effect'
    case (field_fixed)
      text = 'blank or default'
    case (field_ignored)
      text = 'read, no effect'
    case (field_in_space)
      text = 'honoured in space'
    end select
  end function use_text

end module deck_help
