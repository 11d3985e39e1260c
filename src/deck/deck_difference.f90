! SPDX-License-Identifier: BSD-3-Clause
!> In which cards and fields two decks differ as understood: the deck of a run so far and the
!> one that is to go on from its restart file. Comments, the layout of cards, the order of
!> keywords, and the order of what is known by its number do not count. Each difference is told
!> with both values, and whether the steps so far would have been the same with it.
module deck_difference
  use base_kinds, only: wp
  use base_sort, only: sort_order
  use base_strings, only: to_text
  use deck_data, only: deck_t, convert
  use deck_heads, only: head_number
  use deck_problems, only: line_t
  use deck_table, only: field_t, keyword_used, field_tuning, field_fixed, field_ignored
  implicit none
  private
  public :: compare_decks

  !> Differences of a kind that are kept as text; the others are counted.
  integer, parameter, public :: most_told = 20

  type, public :: differences_t
    integer :: refused = 0            !< how many would change the steps so far
    integer :: allowed = 0            !< how many would not
    type(line_t) :: refusal(most_told), note(most_told)
  end type differences_t

  !> The sets of cards of a keyword: records first(k) to last(k), in the order to compare them.
  type :: sets_t
    integer :: n = 0
    integer, allocatable :: first(:), last(:), id(:)
  end type sets_t

  !> Keywords whose sets of cards are known by the number in their first field, or whose order
  !> does not matter.
  character(*), parameter :: by_number(7) = [character(16) :: 'SET_', 'DEFINE_', 'MAT_', &
      'SECTION_', 'BOUNDARY_SPC_', 'INITIAL_VELOCITY', 'BIPACT_PAIR']
  !> What has no effect until another card names it.
  character(*), parameter :: definitions(4) = [character(16) :: 'SET_', 'DEFINE_', 'MAT_', &
      'SECTION_']
  !> Their order numbers the unknowns; another node or element has other fields throughout.
  character(*), parameter :: ordered(2) = [character(16) :: 'NODE', 'ELEMENT_']
  !> Keywords of output, of the end of the run, and of what is judged without changing a step.
  character(*), parameter :: free_keywords(8) = [character(19) :: 'TITLE', &
      'CONTROL_TERMINATION', 'DATABASE_', 'BIPACT_FIELD', 'BIPACT_RESTART', 'BIPACT_TIMING', &
      'BIPACT_LEDGER', 'ELEMENT_BEAM']
  !> The same for single fields.
  character(*), parameter :: free_fields(6) = [character(22) :: 'BIPACT_CONTACT ROTWARN', &
      'BIPACT_CONTACT DFIRST', 'BIPACT_CONTACT DLAST', 'BIPACT_CONTACT DEVERY', &
      'BIPACT_SOLVER NLAST', 'BIPACT_SOLVER THREADS']
  !> Their cards are counted together for the number of a contact.
  character(*), parameter :: contacts = 'CONTACT_', walls = 'RIGIDWALL_'

contains

  !> What differs between the deck of the run so far and the new one, which must have the same
  !> table of keywords and no problems.
  subroutine compare_decks(old, new, found)
    type(deck_t), intent(in) :: old, new
    type(differences_t), intent(inout) :: found
    logical :: contacts_done
    integer :: k
    contacts_done = .false.
    do k = 1, new%table%n
      associate (keyword => new%table%keyword(k))
        if (keyword%class /= keyword_used .or. keyword%name /= keyword%canonical) cycle
        if (index(keyword%name, contacts) == 1) then
          if (.not. contacts_done) call compare_keyword(old, new, contacts, found)
          contacts_done = .true.
        else
          call compare_keyword(old, new, trim(keyword%name), found)
        end if
      end associate
    end do
  end subroutine compare_decks

  !> All cards of one keyword (of all contact keywords, in the order of the deck).
  subroutine compare_keyword(old, new, name, found)
    type(deck_t), intent(in) :: old, new
    character(*), intent(in) :: name
    type(differences_t), intent(inout) :: found
    type(sets_t) :: a, b
    integer :: i, j
    logical :: numbered
    numbered = is_one_of(name, by_number)
    call list_sets(old, name, numbered, a)
    call list_sets(new, name, numbered, b)
    i = 1
    j = 1
    do while (i <= a%n .or. j <= b%n)
      if (i > a%n) then
        call compare_with_none(old, new, .true., b%first(j), b%last(j), found)
        j = j + 1
      else if (j > b%n) then
        call compare_with_none(old, new, .false., a%first(i), a%last(i), found)
        i = i + 1
      else if (b%id(j) < a%id(i)) then
        call compare_with_none(old, new, .true., b%first(j), b%last(j), found)
        j = j + 1
      else if (a%id(i) < b%id(j)) then
        call compare_with_none(old, new, .false., a%first(i), a%last(i), found)
        i = i + 1
      else
        if (index(name, contacts) == 1 .or. index(name, walls) == 1) &
            call compare_heads(old, a%first(i), i, new, b%first(j), j, found)
        call compare_sets(old, a%first(i), a%last(i), new, b%first(j), b%last(j), found)
        i = i + 1
        j = j + 1
      end if
    end do
  end subroutine compare_keyword

  !> Does a name begin with one of these?
  pure logical function is_one_of(name, beginnings)
    character(*), intent(in) :: name, beginnings(:)
    integer :: k
    is_one_of = .false.
    do k = 1, size(beginnings)
      is_one_of = is_one_of .or. index(name, trim(beginnings(k))) == 1
    end do
  end function is_one_of

  !> The sets of cards of a keyword; where they are known by number, in the order of these
  !> (else all numbers are 0).
  subroutine list_sets(deck, name, numbered, sets)
    type(deck_t), intent(in) :: deck
    character(*), intent(in) :: name
    logical, intent(in) :: numbered
    type(sets_t), intent(inout) :: sets
    integer, allocatable :: order(:)
    integer :: b, k, pass, r
    do pass = 1, 2
      if (pass == 2) allocate (sets%first(sets%n), sets%last(sets%n), sets%id(sets%n))
      k = 0
      do b = 1, deck%blocks
        associate (block => deck%block(b), keyword => deck%table%keyword(deck%block(b)%keyword))
          if (keyword%canonical /= name .and. &
              .not. (name == contacts .and. index(keyword%canonical, contacts) == 1)) cycle
          do r = block%first, block%last
            if (begins_set(deck, block%first, r)) k = k + 1
            if (pass == 1) cycle
            if (begins_set(deck, block%first, r)) sets%first(k) = r
            sets%last(k) = r
          end do
        end associate
      end do
      sets%n = k
    end do
    sets%id = 0
    if (.not. numbered) return
    do k = 1, sets%n
      sets%id(k) = nint(deck%number_at(first_card(deck, sets%first(k)), 1))
    end do
    allocate (order(sets%n))
    call sort_order(sets%id, order)
    sets%first = sets%first(order)
    sets%last = sets%last(order)
    sets%id = sets%id(order)
  end subroutine list_sets

  !> A set of cards begins with its first card, or with that of _TITLE or _ID before it.
  pure logical function begins_set(deck, first, record)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: first, record
    begins_set = record == first .or. deck%record(record)%card == 0
    if (begins_set .or. deck%record(record)%card /= 1) return
    begins_set = deck%record(record - 1)%card /= 0
  end function begins_set

  !> The first card of a set, after that of _TITLE or _ID.
  pure integer function first_card(deck, record)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record
    first_card = record + merge(1, 0, deck%record(record)%card == 0)
  end function first_card

  !> A set of cards that only one of the decks has. Where the keyword stands once at most, blank
  !> cards say the same as none.
  subroutine compare_with_none(old, new, is_new, first, last, found)
    type(deck_t), intent(in) :: old, new
    logical, intent(in) :: is_new
    integer, intent(in) :: first, last
    type(differences_t), intent(inout) :: found
    character(:), allocatable :: name
    logical :: once
    if (is_new) name = name_of(new, first)
    if (.not. is_new) name = name_of(old, first)
    once = new%table%keyword(max(1, row_of(old, new, is_new, first)))%once
    if (once) then
      if (is_new) call compare_sets(old, 1, 0, new, first, last, found)
      if (.not. is_new) call compare_sets(old, first, last, new, 1, 0, found)
    else if (is_new) then
      call add(found, is_one_of(name, definitions) .or. may_differ(name, ''), &
          title_of(new, first)//' ('//new%place(first)//'): not in the run so far')
    else
      call add(found, is_one_of(name, definitions) .or. may_differ(name, ''), &
          title_of(old, first)//': in the run so far, not in this deck')
    end if
  end subroutine compare_with_none

  pure integer function row_of(old, new, is_new, record)
    type(deck_t), intent(in) :: old, new
    logical, intent(in) :: is_new
    integer, intent(in) :: record
    if (is_new) row_of = new%block(new%record(record)%block)%keyword
    if (.not. is_new) row_of = old%block(old%record(record)%block)%keyword
  end function row_of

  !> The number of a contact or wall: that of _ID, else which one it is in the deck.
  subroutine compare_heads(old, a, i, new, b, j, found)
    type(deck_t), intent(in) :: old, new
    integer, intent(in) :: a, i, b, j
    type(differences_t), intent(inout) :: found
    integer :: number(2)
    number = [head_number(old, a, i), head_number(new, b, j)]
    if (name_of(old, a) /= name_of(new, b)) then
      call add(found, .false., '*'//name_of(new, b)//' ('//new%place(b)//'): *'// &
          name_of(old, a)//' in the run so far')
    else if (number(1) /= number(2)) then
      call add(found, .false., '*'//name_of(new, b)//' ('//new%place(b)//'): number '// &
          to_text(number(1))//' in the run so far, '//to_text(number(2))//' in this deck')
    end if
  end subroutine compare_heads

  !> Card by card. A card that one side lacks is as a blank one, unless it is one of a list.
  subroutine compare_sets(old, a_first, a_last, new, b_first, b_last, found)
    type(deck_t), intent(in) :: old, new
    integer, intent(in) :: a_first, a_last, b_first, b_last
    type(differences_t), intent(inout) :: found
    integer :: a, b
    a = a_first
    b = b_first
    if (a <= a_last) a = first_card(old, a)
    if (b <= b_last) b = first_card(new, b)
    do while (a <= a_last .or. b <= b_last)
      if (a <= a_last .and. b <= b_last) then
        call compare_cards(old, a, new, b, found)
      else if (b <= b_last) then
        if (is_listed(new, b)) then
          call add(found, may_change(old, new, new, b, ''), title_of(new, b_first)// &
              ' ('//new%place(b)//'): a card more than in the run so far')
          return
        end if
        call compare_cards(old, 0, new, b, found)
      else
        if (is_listed(old, a)) then
          call add(found, may_change(old, new, old, a, ''), title_of(old, a_first)// &
              ': a card less than in the run so far')
          return
        end if
        call compare_cards(old, a, new, 0, found)
      end if
      a = a + 1
      b = b + 1
    end do
  end subroutine compare_sets

  !> Is it a card of which there may be any number?
  pure logical function is_listed(deck, record)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record
    associate (keyword => deck%table%keyword(deck%block(deck%record(record)%block)%keyword))
      is_listed = keyword%repeat_from > 0 .and. deck%record(record)%card >= keyword%repeat_from
    end associate
  end function is_listed

  !> The fields of a card; record 0: a blank card of the same kind.
  subroutine compare_cards(old, a, new, b, found)
    type(deck_t), intent(in) :: old, new
    integer, intent(in) :: a, b
    type(differences_t), intent(inout) :: found
    character(:), allocatable :: where_it_is
    integer :: f, row, card
    logical :: allowed
    if (a > 0 .and. b > 0) then
      if (same_line(old, a, new, b)) return
    end if
    if (b > 0) then
      row = new%block(new%record(b)%block)%keyword
      card = new%record(b)%card
    else
      row = old%block(old%record(a)%block)%keyword
      card = old%record(a)%card
    end if
    associate (c => new%table%keyword(row)%card(card))
      do f = 1, c%fields
        if (same_value(old, a, new, b, f, c%field(f))) cycle
        if (b > 0) then
          where_it_is = title_of(new, b)//', field '//trim(c%field(f)%name)//' ('// &
              new%place(b)//')'
          allowed = may_change(old, new, new, b, trim(c%field(f)%name))
        else
          where_it_is = title_of(old, a)//', field '//trim(c%field(f)%name)
          allowed = may_change(old, new, old, a, trim(c%field(f)%name))
        end if
        call add(found, allowed .or. is_idle(c%field(f)), where_it_is//': '// &
            shown(old, a, f, c%field(f))//' in the run so far, '// &
            shown(new, b, f, c%field(f))//' in this deck')
        if (f == 1 .and. is_one_of(trim(new%table%keyword(row)%name), ordered)) return
      end do
    end associate
  end subroutine compare_cards

  !> The same characters without parameters, so that fields need not be looked at.
  pure logical function same_line(old, a, new, b)
    type(deck_t), intent(in) :: old, new
    integer, intent(in) :: a, b
    associate (x => old%record(a), y => new%record(b))
      associate (p => old%block(x%block), q => new%block(y%block))
        same_line = x%last - x%first == y%last - y%first .and. (p%long .eqv. q%long)
        if (.not. same_line) return
        associate (line => new%file(q%file)%text(y%first:y%last))
          same_line = old%file(p%file)%text(x%first:x%last) == line .and. index(line, '&') == 0
        end associate
      end associate
    end associate
  end function same_line

  !> A field that has no effect.
  pure logical function is_idle(field)
    type(field_t), intent(in) :: field
    is_idle = field%class == field_tuning .or. field%class == field_ignored .or. &
        field%kind == 'T'
  end function is_idle

  !> Do two fields mean the same? A blank without a default may mean something of its own.
  pure logical function same_value(old, a, new, b, f, field)
    type(deck_t), intent(in) :: old, new
    integer, intent(in) :: a, b, f
    type(field_t), intent(in) :: field
    if (field%kind == 'T' .or. field%kind == 'W') then
      same_value = text_of(old, a, f, field) == text_of(new, b, f, field)
    else if (len_trim(field%default) == 0 .and. field%class /= field_fixed .and. &
        (text_of(old, a, f, field) == '' .neqv. text_of(new, b, f, field) == '')) then
      same_value = .false.
    else
      same_value = .not. abs(number_of(old, a, f, field) - number_of(new, b, f, field)) > 0.0_wp
    end if
  end function same_value

  pure function text_of(deck, record, f, field) result(text)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record, f
    type(field_t), intent(in) :: field
    character(:), allocatable :: text
    text = trim(field%default)
    if (record > 0) text = trim(deck%text_at(record, f))
  end function text_of

  pure real(wp) function number_of(deck, record, f, field) result(number)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record, f
    type(field_t), intent(in) :: field
    logical :: ok
    number = 0.0_wp
    if (record > 0) then
      number = deck%number_at(record, f)
    else if (len_trim(field%default) > 0) then
      call convert(trim(field%default), field%kind, number, ok)
    end if
  end function number_of

  pure function shown(deck, record, f, field) result(text)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record, f
    type(field_t), intent(in) :: field
    character(:), allocatable :: text
    text = text_of(deck, record, f, field)
    if (len(text) == 0) text = 'blank'
  end function shown

  !> May a field (name empty: a whole card) differ because no step depends on it? A set may
  !> where only output names it.
  logical function may_change(old, new, deck, record, field)
    type(deck_t), intent(in) :: old, new, deck
    integer, intent(in) :: record
    character(*), intent(in) :: field
    integer :: r, id
    associate (block => deck%block(deck%record(record)%block))
      may_change = may_differ(name_of(deck, record), field)
      if (may_change .or. index(name_of(deck, record), 'SET_') /= 1) return
      do r = record, block%first, -1
        if (deck%record(r)%card == 1) exit
      end do
    end associate
    id = nint(deck%number_at(r, 1))
    may_change = .not. (is_used(old, id) .or. is_used(new, id))
  end function may_change

  !> Does a card that steps depend on name a set of this number, of whatever kind?
  pure logical function is_used(deck, id)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: id
    character(*), parameter :: names(5) = [character(5) :: 'NSID', 'SSID', 'SURFA', 'SURFB', &
        'ID']
    integer :: r, f
    is_used = .true.
    do r = 1, deck%records
      if (deck%record(r)%card == 0 .or. may_differ(name_of(deck, r), '')) cycle
      associate (card => deck%table%keyword(deck%block(deck%record(r)%block)%keyword)% &
          card(deck%record(r)%card))
        do f = 1, card%fields
          if (all(card%field(f)%name /= names)) cycle
          if (abs(nint(deck%number_at(r, f))) == id) return
        end do
      end associate
    end do
    is_used = .false.
  end function is_used

  pure logical function may_differ(name, field)
    character(*), intent(in) :: name, field
    may_differ = is_one_of(name, free_keywords) .or. any(free_fields == name//' '//field)
  end function may_differ

  pure function name_of(deck, record) result(name)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record
    character(:), allocatable :: name
    name = trim(deck%table%keyword(deck%block(deck%record(record)%block)%keyword)%canonical)
  end function name_of

  !> "*MAT_ELASTIC 3": the keyword, and the number of something that its cards begin with.
  pure function title_of(deck, record) result(title)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record
    character(:), allocatable :: title
    integer :: r
    title = '*'//name_of(deck, record)
    if (index(title, walls) > 0) return      ! it begins with the number of a node set
    r = first_card(deck, record)
    associate (block => deck%block(deck%record(record)%block))
      if (r > block%last) return
      do while (deck%record(r)%card > 1 .and. r > block%first)
        r = r - 1
      end do
      associate (keyword => deck%table%keyword(block%keyword))
        if (keyword%name == 'PART' .and. r < block%last) r = r + 1
        associate (field => keyword%card(deck%record(r)%card)%field(1))
          if (field%kind == 'I' .and. index(field%name, 'ID ') > 0) title = title//' '// &
              trim(deck%text_at(r, 1))
        end associate
      end associate
    end associate
  end function title_of

  subroutine add(found, allowed, text)
    type(differences_t), intent(inout) :: found
    logical, intent(in) :: allowed
    character(*), intent(in) :: text
    if (allowed) then
      found%allowed = found%allowed + 1
      if (found%allowed <= most_told) found%note(found%allowed)%text = text
    else
      found%refused = found%refused + 1
      if (found%refused <= most_told) found%refusal(found%refused)%text = text
    end if
  end subroutine add

end module deck_difference
