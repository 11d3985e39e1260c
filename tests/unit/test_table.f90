! SPDX-License-Identifier: BSD-3-Clause
!> The table of keywords: its fields are as their words say, and names are found whatever their
!> number.
program test_table
  use base_kinds, only: wp
  use base_strings, only: to_text
  use check, only: test_start, test_end, check_true, check_equal, check_close
  use deck_keywords, only: fill_table, complete_table
  use deck_table, only: table_t, add_keyword, add_alias, add_card, add_field, find_keyword, &
      family_of, field_fixed
  implicit none

  call test_start('table')
  call test_fields()
  call test_names()
  call test_growth()
  call test_known()
  call test_end()

contains

  !> Columns, ranges, defaults from the words of a field.
  subroutine test_fields()
    type(table_t) :: table
    call add_keyword(table, 'THING', 'help', repeat_from=1)
    call add_card(table)
    call add_field(table, 'A', 'I8 req >0')
    call add_field(table, 'B', 'R16 =0.5 [L/T2] >-1.5 <=2.5E-1', 'a number')
    call add_field(table, 'C', 'W10 fixed |X|Y|')
    associate (card => table%keyword(1)%card(1))
      call check_equal(card%fields, 3, 'fields')
      call check_equal(card%field(2)%first, 9, 'a field begins where the one before ends')
      call check_equal(card%field(3)%first, 25, 'also after a wide one')
      call check_true(card%field(1)%required .and. card%field(1)%low_open, 'above 0')
      call check_close(card%field(1)%low, 0.0_wp, 0.0_wp, 'the lower bound')
      call check_close(card%field(2)%low, -1.5_wp, 0.0_wp, 'a negative bound')
      call check_close(card%field(2)%high, 0.25_wp, 0.0_wp, 'a bound with an exponent')
      call check_true(card%field(2)%low_open .and. .not. card%field(2)%high_open, 'an open one')
      call check_equal(trim(card%field(2)%default), '0.5', 'a default')
      call check_equal(trim(card%field(2)%units), '[L/T2]', 'units')
      call check_equal(card%field(3)%class, field_fixed, 'a class')
      call check_equal(trim(card%field(3)%words), '|X|Y|', 'words')
    end associate
  end subroutine test_fields

  !> Whole names, aliases, families.
  subroutine test_names()
    type(table_t) :: table
    call check_equal(find_keyword(table, 'A'), 0, 'an empty table has no name')
    call add_keyword(table, 'A', '')
    call add_alias(table, 'AB')
    call add_keyword(table, 'MAT_*', '')
    call check_equal(find_keyword(table, 'A'), 1, 'a name')
    call check_equal(find_keyword(table, 'AB'), 2, 'an alias')
    call check_equal(table%keyword(2)%canonical_row, 1, 'of the first')
    call check_equal(find_keyword(table, 'B'), 0, 'a name that is not there')
    call check_equal(find_keyword(table, ''), 0, 'no name')
    call check_equal(find_keyword(table, repeat('A', 60)), 0, 'a name that is too long')
    call check_equal(find_keyword(table, 'MAT_001'), 0, 'a family is no name')
    call check_equal(family_of(table, 'MAT_001'), 3, 'a family')
    call check_equal(family_of(table, 'MAT_'), 3, 'the family without more')
    call check_equal(family_of(table, 'MAT'), 0, 'less than the family')
  end subroutine test_names

  !> More rows than a table begins with.
  subroutine test_growth()
    type(table_t) :: table
    integer, parameter :: n = 3000
    integer :: k, wrong
    do k = 1, n
      call add_keyword(table, 'NAME_'//to_text(k), '')
      call add_card(table)
      call add_field(table, 'F'//to_text(k), 'I10')
    end do
    wrong = 0
    do k = 1, n
      if (find_keyword(table, 'NAME_'//to_text(k)) /= k) wrong = wrong + 1
      if (find_keyword(table, 'name_'//to_text(k)) /= 0) wrong = wrong + 1
      if (table%keyword(k)%card(1)%field(1)%name /= 'F'//to_text(k)) wrong = wrong + 1
    end do
    call check_equal(wrong, 0, 'names of a long table')
  end subroutine test_growth

  !> Every name of the program's own table is there once, its fields have columns.
  subroutine test_known()
    type(table_t) :: table
    integer :: k, c, f, wrong
    call fill_table(table)
    call complete_table(table)
    wrong = 0
    do k = 1, table%n
      associate (keyword => table%keyword(k))
        call check_equal(find_keyword(table, trim(keyword%name)), k, '*'//trim(keyword%name))
        do c = 1, keyword%cards
          do f = 1, keyword%card(c)%fields
            if (keyword%card(c)%field(f)%width < 1) wrong = wrong + 1
            if (keyword%card(c)%field(f)%low > keyword%card(c)%field(f)%high) wrong = wrong + 1
          end do
        end do
      end associate
    end do
    call check_equal(wrong, 0, 'fields without columns or range')
  end subroutine test_known

end program test_table
