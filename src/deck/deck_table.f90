! SPDX-License-Identifier: BSD-3-Clause
!> The shape of a table of keywords: cards, fields, columns, defaults, ranges, help. The one
!> table (deck_keywords) feeds the reader, the messages, the echo and the documentation.
module deck_table
  use base_kinds, only: wp
  use base_strings, only: edit_distance, position_of
  use deck_number, only: scan_integer, scan_real
  implicit none
  private
  integer, parameter, public :: name_length = 10
  integer, parameter, public :: keyword_length = 56
  integer, parameter, public :: max_fields = 10

  !> What the program does with a field.
  integer, parameter, public :: field_honoured = 1  !< used
  integer, parameter, public :: field_tuning = 2    !< of another method: one note, no effect
  integer, parameter, public :: field_fixed = 3     !< must be blank or at its default
  integer, parameter, public :: field_ignored = 4   !< cannot matter here: accepted
  integer, parameter, public :: field_in_space = 5  !< used in space, fixed in the plane

  type, public :: field_t
    character(name_length) :: name = ''
    character :: kind = 'R'            !< I integer, R real, W word, T text to the card's end
    integer :: width = 10
    integer :: first = 1               !< first column in standard form
    integer :: class = field_honoured
    logical :: required = .false.
    logical :: zero_is_default = .false.
    character(name_length) :: default = ''
    real(wp) :: low = -huge(1.0_wp)
    real(wp) :: high = huge(1.0_wp)
    logical :: low_open = .false.
    logical :: high_open = .false.
    real(wp) :: plane_high = huge(1.0_wp)  !< its limit in the plane, where that is lower
    character(112) :: words = ''        !< |A|B|: the words that are allowed; blank = any
    character(12) :: units = ''
    character(96) :: help = ''
  end type field_t

  type, public :: card_t
    integer :: fields = 0
    type(field_t) :: field(max_fields)
  end type card_t

  integer, parameter, public :: keyword_used = 1
  integer, parameter, public :: keyword_skipped = 2  !< cannot change the solution: one note
  integer, parameter, public :: keyword_refused = 3  !< known, but not available in this version
  integer, parameter, public :: keyword_frame = 4    !< obeyed by the reader itself

  type, public :: keyword_t
    character(keyword_length) :: name = ''       !< a name that ends in * stands for a family
    character(keyword_length) :: canonical = ''  !< the name that handlers know it by
    integer :: canonical_row = 0   !< row of that name
    integer :: stem = 0            !< of a family: the length of its name before the *
    integer :: class = keyword_used
    integer :: cards = 0
    integer :: required = 0        !< cards that must be there
    integer :: repeat_from = 0     !< after the last card go on with this one; 0 = no more cards
    logical :: may_title = .false. !< _TITLE adds a text card before each set of cards
    logical :: may_id = .false.    !< _ID adds a card with id and heading before each set
    logical :: title_is_id = .false. !< _TITLE means the same as _ID
    logical :: once = .false.      !< at most once per deck
    logical :: noted = .false.     !< read and checked, but without effect: one note
    logical :: by_dimension = .false. !< has fields whose check waits for the dimension
    integer :: other_form = 0      !< row of its cards where the first has two fields alone
    type(card_t), allocatable :: card(:)
    character(96) :: help = ''
  end type keyword_t

  type, public :: table_t
    integer :: n = 0
    type(keyword_t), allocatable :: keyword(:)
    logical :: is_complete = .false.   !< with the keywords that are skipped or refused
    !> Rows by the hash of their names, 0 = free; a name whose place is taken has the next free
    !> one.
    integer, allocatable, private :: slot(:)
  end type table_t

  !> Rows that a table has room for at first; more than there are, so that it seldom grows.
  integer, parameter :: first_rows = 512

  public :: add_keyword, add_alias, add_card, add_field, find_keyword, find_nearest, &
      field_index, family_of, waits_for_dimension

contains

  !> Opens a new row of the table.
  subroutine add_keyword(table, name, help, class, required, repeat_from, title, id, &
      once, noted, title_is_id)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name
    character(*), intent(in) :: help
    integer, intent(in), optional :: class, required, repeat_from
    logical, intent(in), optional :: title, id, once, noted, title_is_id
    call make_row(table, name)
    associate (k => table%keyword(table%n))
      k%canonical = name
      k%canonical_row = table%n
      k%stem = max(0, position_of(name, '*') - 1)
      k%help = help
      if (present(class)) k%class = class
      if (present(required)) k%required = required
      if (present(repeat_from)) k%repeat_from = repeat_from
      if (present(title)) k%may_title = title
      if (present(id)) k%may_id = id
      if (present(once)) k%once = once
      if (present(noted)) k%noted = noted
      if (present(title_is_id)) k%title_is_id = title_is_id
      allocate (k%card(0))
    end associate
  end subroutine add_keyword

  !> Another name for the last keyword.
  subroutine add_alias(table, name)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name
    call make_row(table, name)
    table%keyword(table%n) = table%keyword(table%n - 1)
    table%keyword(table%n)%name = name
    table%keyword(table%n)%help = 'the same as *'//trim(table%keyword(table%n)%canonical)
  end subroutine add_alias

  !> The next row, found by its name from now on. Twice as many slots as rows at least.
  subroutine make_row(table, name)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name
    type(keyword_t), allocatable :: longer(:)
    integer :: k
    if (.not. allocated(table%keyword)) then
      allocate (table%keyword(first_rows), table%slot(0:2*first_rows - 1))
      table%slot = 0
    else if (table%n == size(table%keyword)) then
      allocate (longer(2*table%n))
      longer(1:table%n) = table%keyword
      call move_alloc(longer, table%keyword)
      deallocate (table%slot)
      allocate (table%slot(0:4*table%n - 1))
      table%slot = 0
      do k = 1, table%n
        table%slot(slot_of(table, trim(table%keyword(k)%name))) = k
      end do
    end if
    table%n = table%n + 1
    table%keyword(table%n)%name = name
    k = slot_of(table, name)
    if (table%slot(k) == 0) table%slot(k) = table%n
  end subroutine make_row

  !> The slot that holds the row of a name, or the free one where it belongs.
  pure integer function slot_of(table, name)
    type(table_t), intent(in) :: table
    character(*), intent(in) :: name
    integer :: k, row
    slot_of = 0
    do k = 1, len_trim(name)
      slot_of = mod(31*slot_of + iachar(name(k:k)), size(table%slot))
    end do
    do
      row = table%slot(slot_of)
      if (row == 0) return
      if (table%keyword(row)%name == name) return
      slot_of = mod(slot_of + 1, size(table%slot))
    end do
  end function slot_of

  !> Opens a new card of the last keyword.
  subroutine add_card(table)
    type(table_t), intent(inout) :: table
    type(card_t), allocatable :: longer(:)
    associate (k => table%keyword(table%n))
      allocate (longer(k%cards + 1))
      longer(1:k%cards) = k%card
      call move_alloc(longer, k%card)
      k%cards = k%cards + 1
    end associate
  end subroutine add_card

  !> Adds a field to the last card. spec holds blank-separated words: kind and width first
  !> ("R10"), then any of "req", "note", "fixed", "ignored", "0=d", "=default", "[units]", ">x",
  !> ">=x", "<x", "<=x", "plane<=x", "|A|B|" (the words allowed); "space": used in space alone.
  subroutine add_field(table, name, spec, help)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name
    character(*), intent(in) :: spec
    character(*), intent(in), optional :: help
    integer :: start, next
    logical :: ok
    associate (c => table%keyword(table%n)%card(table%keyword(table%n)%cards))
      c%fields = c%fields + 1
      associate (f => c%field(c%fields))
        f%name = name
        if (present(help)) f%help = help
        f%kind = spec(1:1)
        if (c%fields > 1) f%first = c%field(c%fields - 1)%first + c%field(c%fields - 1)%width
        next = word_end(spec, 1)
        call scan_integer(spec(2:next), f%width, ok)
        do while (next < len(spec))
          start = next + 2
          next = word_end(spec, start)
          call apply_word(f, spec(start:next))
        end do
        if (waits_for_dimension(f)) table%keyword(table%n)%by_dimension = .true.
      end associate
    end associate
  end subroutine add_field

  !> The last character of the word that starts at `start`.
  pure integer function word_end(text, start)
    character(*), intent(in) :: text
    integer, intent(in) :: start
    word_end = position_of(text(start:), ' ')
    if (word_end == 0) word_end = len(text) - start + 2
    word_end = start + word_end - 2
  end function word_end

  pure subroutine apply_word(f, word)
    type(field_t), intent(inout) :: f
    character(*), intent(in) :: word
    logical :: ok
    select case (word)
    case ('req')
      f%required = .true.
    case ('note')
      f%class = field_tuning
    case ('fixed')
      f%class = field_fixed
    case ('ignored')
      f%class = field_ignored
    case ('space')
      f%class = field_in_space
    case ('0=d')
      f%zero_is_default = .true.
    case default
      select case (word(1:1))
      case ('=')
        f%default = word(2:)
      case ('[')
        f%units = word
      case ('|')
        f%words = word
      case ('p')
        call scan_real(word(8:), f%plane_high, ok)
      case ('>')
        f%low_open = word(2:2) /= '='
        call scan_real(word(merge(2, 3, f%low_open):), f%low, ok)
      case ('<')
        f%high_open = word(2:2) /= '='
        call scan_real(word(merge(2, 3, f%high_open):), f%high, ok)
      end select
    end select
  end subroutine apply_word

  !> Does it depend on the dimension of the model what a field may be?
  pure logical function waits_for_dimension(f)
    type(field_t), intent(in) :: f
    waits_for_dimension = f%class == field_in_space .or. f%plane_high < huge(1.0_wp)
  end function waits_for_dimension

  !> Row of a keyword by its exact name (upper case, without options); 0 if there is none.
  pure integer function find_keyword(table, name)
    type(table_t), intent(in) :: table
    character(*), intent(in) :: name
    find_keyword = 0
    if (len(name) > keyword_length .or. .not. allocated(table%slot)) return
    find_keyword = table%slot(slot_of(table, name))
  end function find_keyword

  !> The row whose name is the fewest single-character edits away; no family.
  pure subroutine find_nearest(table, name, best, distance)
    type(table_t), intent(in) :: table
    character(*), intent(in) :: name
    integer, intent(out) :: best, distance
    integer :: k, d
    best = 1
    distance = huge(distance)
    do k = 1, table%n
      ! Each edit changes the length by one at most.
      if (abs(len_trim(table%keyword(k)%name) - min(len(name), 64)) >= distance) cycle
      if (table%keyword(k)%stem > 0) cycle
      d = edit_distance(name(1:min(len(name), 64)), trim(table%keyword(k)%name))
      if (d >= distance) cycle
      distance = d
      best = k
    end do
  end subroutine find_nearest

  !> Row of the family (a name that ends in *) that a name belongs to; 0 if there is none.
  pure integer function family_of(table, name)
    type(table_t), intent(in) :: table
    character(*), intent(in) :: name
    do family_of = 1, table%n
      associate (k => table%keyword(family_of))
        if (k%stem == 0 .or. k%stem > len(name)) cycle
        if (k%name(1:k%stem) == name(1:k%stem)) return
      end associate
    end do
    family_of = 0
  end function family_of

  !> Number of a field on a card by its name; 0 if there is none.
  pure integer function field_index(card, name)
    type(card_t), intent(in) :: card
    character(*), intent(in) :: name
    do field_index = 1, card%fields
      if (card%field(field_index)%name == name) return
    end do
    field_index = 0
  end function field_index

end module deck_table
