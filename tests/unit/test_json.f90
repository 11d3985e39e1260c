! SPDX-License-Identifier: BSD-3-Clause
!> JSON text: escapes, UTF-8, numbers that read back equal, layout.
program test_json
  use base_format, only: put_one_real, put_long, real_width
  use base_json, only: json_t
  use base_kinds, only: wp, i8
  use check, only: test_start, test_end, check_true, check_equal, seed_random
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_positive_inf
  implicit none

  call test_start('json')
  call seed_random(20241117)
  call test_texts()
  call test_layout()
  call test_growth()
  call test_reals()
  call test_integers()
  call test_end()

contains

  !> A text as the only member of a list.
  function alone(text) result(item)
    character(*), intent(in) :: text
    character(:), allocatable :: item
    type(json_t) :: json
    call json%open('[')
    call json%put(text)
    call json%close(']')
    item = json%text()
    item = item(5:len(item) - 2)
  end function alone

  !> What RFC 8259 wants escaped, and bytes that are or are no UTF-8 (RFC 3629).
  subroutine test_texts()
    character(*), parameter :: umlaut = char(195)//char(164), euro = char(226)//char(130)// &
        char(172), clef = char(240)//char(157)//char(132)//char(158)
    integer :: k
    call check_equal(alone(''), '""', 'nothing')
    call check_equal(alone('a/b'), '"a/b"', 'plain')
    call check_equal(alone('"\'), '"\"\\"', 'quotation mark and backslash')
    call check_equal(alone('a'//new_line('a')//'b'), '"a\nb"', 'a new line')
    call check_equal(alone(achar(0)//achar(9)//achar(31)//achar(127)), &
        '"\u0000\u0009\u001F\u007F"', 'control characters')
    call check_equal(alone(umlaut//euro//clef), '"'//umlaut//euro//clef//'"', &
        'two, three, four bytes')
    call check_equal(alone('M'//char(252)//'ller'), '"M\u00FCller"', 'Latin-1')
    call check_equal(alone(char(228)), '"\u00E4"', 'a first byte alone')
    call check_equal(alone(euro(1:2)), '"\u00E2\u0082"', 'cut off')
    call check_equal(alone(char(192)//char(175)), '"\u00C0\u00AF"', 'longer than need be')
    call check_equal(alone(char(224)//char(159)//char(191)), '"\u00E0\u009F\u00BF"', &
        'three bytes, longer than need be')
    call check_equal(alone(char(240)//char(143)//char(191)//char(191)), &
        '"\u00F0\u008F\u00BF\u00BF"', 'four bytes, longer than need be')
    call check_equal(alone(char(237)//char(160)//char(128)), '"\u00ED\u00A0\u0080"', &
        'a surrogate')
    call check_equal(alone(char(244)//char(144)//char(128)//char(128)), &
        '"\u00F4\u0090\u0080\u0080"', 'beyond 10FFFF')
    do k = 32, 126
      if (k == 34 .or. k == 92) cycle
      call check_equal(alone(achar(k)), '"'//achar(k)//'"', 'stands for itself')
    end do
  end subroutine test_texts

  subroutine test_layout()
    type(json_t) :: json
    character, parameter :: n = new_line('a')
    call json%open('{')
    call json%put(1, 'a"')
    call json%open('[', 'list')
    call json%close(']')
    call json%open('[', 'more')
    call json%put(.true.)
    call json%put(.false.)
    call json%put_null()
    call json%close(']')
    call json%open('{', 'object')
    call json%close('}')
    call json%put(-5000000000_i8, 'last')
    call json%close('}')
    call check_equal(json%text(), '{'//n//'  "a\"": 1,'//n//'  "list": [],'//n// &
        '  "more": ['//n//'    true,'//n//'    false,'//n//'    null'//n//'  ],'//n// &
        '  "object": {},'//n//'  "last": -5000000000'//n//'}', 'layout')
  end subroutine test_layout

  !> Beyond the size that it begins with.
  subroutine test_growth()
    character(30000) :: long
    long = repeat('"', 30000)
    call check_equal(alone(long), '"'//repeat('\"', 30000)//'"', 'a long text')
  end subroutine test_growth

  !> Numbers read back equal and have the digits of ES24.16E3, apart from those that may end in
  !> a 5 right after their 17th digit: these may be rounded either way.
  subroutine test_reals()
    integer, parameter :: count = 100000
    character(real_width) :: text, slow
    type(json_t) :: json
    real(wp) :: x, y, a(2)
    integer :: k, ios, wrong, different
    wrong = 0
    different = 0
    do k = 1, count
      call random_number(a)
      x = (a(1) - 0.5_wp)*10.0_wp**nint(600.0_wp*a(2) - 300.0_wp)
      call put_one_real(x, text)
      write (slow, '(es24.16e3)') x
      read (text, *, iostat=ios) y
      if (ios /= 0 .or. transfer(x, 1_i8) /= transfer(y, 1_i8)) wrong = wrong + 1
      if (abs(x) > 1.0e9_wp .and. abs(x) < 1.0e17_wp) cycle
      if (text /= slow) different = different + 1
    end do
    call check_equal(wrong, 0, 'numbers that do not read back equal')
    call check_equal(different, 0, 'numbers that differ from ES24.16E3')
    call json%open('[')
    call json%put(ieee_value(x, ieee_quiet_nan))
    call json%put(-ieee_value(x, ieee_positive_inf))
    call json%put(-0.0_wp)
    call json%put(-1.0_wp/3.0_wp)
    call json%put(tiny(x)/4.0_wp)
    call json%close(']')
    call check_equal(json%text(), '['//new_line('a')//'  null,'//new_line('a')//'  null,'// &
        new_line('a')//'  0.0,'//new_line('a')//'  -3.3333333333333331E-001,'// &
        new_line('a')//'  5.5626846462680035E-309'//new_line('a')//']', 'numbers')
  end subroutine test_reals

  subroutine test_integers()
    character(20) :: text
    call put_long(-huge(1_i8), text)
    call check_equal(text, '-9223372036854775807', 'a long integer')
    call put_long(0_i8, text)
    call check_equal(text, repeat(' ', 19)//'0', 'zero')
  end subroutine test_integers

end program test_json
