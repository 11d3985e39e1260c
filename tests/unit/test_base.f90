! SPDX-License-Identifier: BSD-3-Clause
!> Numbers as text, sorting, the archive, words and failures.
program test_base
  use base_archive, only: archive_t, archive_save, archive_restore
  use base_checksum, only: checksum_of_text, checksum_of_words, checksum_of_file
  use base_files, only: file_exists, file_size, move_file, remove_file, cut_file, sync_file, &
      list_files, open_text, close_text, path_length
  use base_format, only: real_writer_t, make_real_writer, put_real, put_integer, real_width
  use base_kinds, only: wp, i4, i8
  use base_list, only: append
  use base_sort, only: sort_order, sort_integers, find_sorted, first_not_below
  use base_status, only: status_t, fail, failed, add_place, status_text, status_deck, &
      status_file, status_ok
  use base_strings, only: edit_distance, to_text
  use check, only: test_start, test_end, check_true, check_equal, seed_random
  implicit none
  type(real_writer_t) :: writer

  call test_start('base')
  call seed_random(20240607)
  call make_real_writer(writer)
  call test_random_reals()
  call test_special_reals()
  call test_ties()
  call test_integers()
  call test_numbers_as_text()
  call test_sorting()
  call test_lists()
  call test_archive()
  call test_archive_grows()
  call test_archive_agrees()
  call test_checksum()
  call test_files()
  call test_refusals()
  call test_edit_distance()
  call test_status()
  call test_end()

contains

  !> Any bit pattern of a finite number: all exponents are equally likely, denormals included.
  function random_real() result(x)
    real(wp) :: x, a(3)
    integer(i8) :: bits
    call random_number(a)
    bits = ishft(int(a(1)*2047.0_wp, i8), 52) + int(a(2)*2.0_wp**52, i8)
    if (a(3) < 0.5_wp) bits = ibset(bits, 63)
    x = transfer(bits, x)
  end function random_real

  logical function reads_back(x, text)
    real(wp), intent(in) :: x
    character(*), intent(in) :: text
    real(wp) :: y
    integer :: ios
    read (text, '(es24.16)', iostat=ios) y
    reads_back = ios == 0 .and. transfer(x, 1_i8) == transfer(y, 1_i8)
  end function reads_back

  subroutine test_random_reals()
    integer, parameter :: count = 1000000
    character(real_width) :: text, slow
    real(wp) :: x
    integer :: k, wrong, different
    wrong = 0
    different = 0
    do k = 1, count
      x = random_real()
      call put_real(writer, x, text)
      if (.not. (abs(x) > 0.0_wp .or. text == ' 0.0000000000000000E+000')) wrong = wrong + 1
      if (.not. abs(x) > 0.0_wp) cycle
      if (.not. reads_back(x, text)) wrong = wrong + 1
      ! Writing is the slow part; every fifth number is compared with it.
      if (mod(k, 5) > 0) cycle
      write (slow, '(es24.16e3)') x
      if (text /= slow .and. .not. is_tie(x)) different = different + 1
    end do
    call check_equal(wrong, 0, 'random numbers that do not read back equal')
    call check_equal(different, 0, 'random numbers that differ from ES24.16E3')
  end subroutine test_random_reals

  !> True if x ends in a 5 right after its 17th digit: both neighbours are then as near. A
  !> double has at most 767 digits, so the long text is exact.
  logical function is_tie(x)
    real(wp), intent(in) :: x
    character(800) :: text
    integer :: point
    write (text, '(es800.780e4)') x
    point = index(text, '.')
    is_tie = text(point + 17:point + 17) == '5' &
        .and. verify(text(point + 18:point + 780), '0') == 0
  end function is_tie

  subroutine check_one(x, what)
    real(wp), intent(in) :: x
    character(*), intent(in) :: what
    character(real_width) :: text, slow
    call put_real(writer, x, text)
    write (slow, '(es24.16e3)') x
    call check_equal(text, slow, what)
    call check_true(reads_back(x, text), what//' reads back')
  end subroutine check_one

  subroutine test_special_reals()
    character(real_width) :: text
    character(8) :: word
    real(wp) :: x
    integer :: e
    do e = -307, 308
      write (word, '(a, i0)') '1E', e
      read (word, *) x
      call check_one(x, 'power of ten '//trim(word))
      call check_one(-x, 'minus the power of ten '//trim(word))
      call check_one(nearest(x, -1.0_wp), 'just below '//trim(word))
    end do
    call check_one(huge(x), 'huge')
    call check_one(tiny(x), 'tiny')
    call check_one(nearest(tiny(x), -1.0_wp), 'the largest denormal')
    call check_one(transfer(1_i8, x), 'the smallest denormal')
    call check_one(-1.0_wp/3.0_wp, 'minus a third')
    call put_real(writer, 0.0_wp, text)
    call check_equal(text, ' 0.0000000000000000E+000', 'zero')
    call put_real(writer, -0.0_wp, text)
    call check_equal(text, ' 0.0000000000000000E+000', 'minus zero keeps no sign')
  end subroutine test_special_reals

  !> 15 digits and an eighth: the 18th digit is a 5 and the last one.
  subroutine test_ties()
    character(real_width) :: text
    real(wp) :: x
    integer :: k, wrong
    wrong = 0
    do k = 0, 999
      x = 1.0e14_wp + real(k, wp)*9.0e10_wp + 0.125_wp
      call put_real(writer, x, text)
      if (.not. (is_tie(x) .and. reads_back(x, text))) wrong = wrong + 1
    end do
    call check_equal(wrong, 0, 'ties that do not read back equal')
    call check_true(.not. is_tie(0.1_wp), 'a tenth is no tie')
  end subroutine test_ties

  subroutine test_integers()
    character(11) :: text
    character(3) :: narrow
    call put_integer(-2147483647, text)
    call check_equal(text, '-2147483647', 'the smallest integer')
    call put_integer(0, narrow)
    call check_equal(narrow, '  0', 'zero')
    call put_integer(-7, narrow)
    call check_equal(narrow, ' -7', 'a negative digit')
  end subroutine test_integers

  !> Numbers of messages and logs: integers as I0 has them, reals in six digits.
  subroutine test_numbers_as_text()
    character(20) :: text
    integer(i8) :: number
    integer :: k
    do k = 0, 62
      number = ishft(1_i8, k)
      write (text, '(i0)') number
      call check_equal(to_text(number), trim(text), 'a power of two')
      write (text, '(i0)') -number + 1_i8
      call check_equal(to_text(-number + 1_i8), trim(text), 'minus a power of two')
    end do
    call check_equal(to_text(-huge(number) - 1_i8), '-9223372036854775808', 'the smallest')
    call check_equal(to_text(-2147483647 - 1), '-2147483648', 'the smallest default one')
    call check_equal(to_text(1.5e-3_wp), '0.0015', 'a small real')
    call check_equal(to_text(-2.0e8_wp), '-2.0E8', 'a large real')
    call check_equal(to_text(1.0e-123_wp), '1.0E-123', 'three digits of exponent')
    call check_equal(to_text(1234567.0_wp), '1234567.0', 'as many digits as are kept')
    call check_equal(to_text(0.0_wp), '0.0', 'nothing')
    call check_equal(to_text(-1.0_wp/3.0_wp), '-0.3333333', 'minus a third')
  end subroutine test_numbers_as_text

  subroutine test_sorting()
    integer :: n, k, wrong
    integer, allocatable :: key(:), order(:), list(:)
    real(wp), allocatable :: a(:)
    wrong = 0
    do n = 0, 200
      allocate (a(n), order(n))
      call random_number(a)
      key = int(a*(n/3 + 1)) - n/6
      call sort_order(key, order)
      list = key
      call sort_integers(list)
      do k = 1, n
        if (count(order == k) /= 1 .or. key(order(k)) /= list(k)) wrong = wrong + 1
        if (k == 1) cycle
        if (list(k - 1) > list(k)) wrong = wrong + 1
        if (key(order(k - 1)) == key(order(k)) .and. order(k - 1) > order(k)) wrong = wrong + 1
      end do
      if (n > 0) wrong = wrong + check_found(list, key)
      deallocate (a, order)
    end do
    call check_equal(wrong, 0, 'sorted lists, stable orders, items found')
    call check_equal(find_sorted([integer ::], 1), 0, 'nothing is in an empty list')
    call check_equal(first_not_below([integer ::], 1), 1, 'after an empty list')
  end subroutine test_sorting

  integer function check_found(list, key) result(wrong)
    integer, intent(in) :: list(:), key(:)
    integer :: k, p
    wrong = 0
    do k = minval(key) - 1, maxval(key) + 1
      p = find_sorted(list, k)
      if ((p > 0) .neqv. any(key == k)) wrong = wrong + 1
      if (p > 0) wrong = wrong + merge(0, 1, list(max(1, p)) == k)
      if (first_not_below(list, k) /= count(key < k) + 1) wrong = wrong + 1
    end do
  end function check_found

  !> Lists that grow by one and by many.
  subroutine test_lists()
    integer, allocatable :: list(:)
    integer :: k, n, wrong
    n = 0
    call append([integer ::], list, n)
    call check_true(n == 0 .and. allocated(list), 'nothing is added')
    do k = 1, 1000
      call append([k], list, n)
    end do
    call append([(k, k=1001, 9000)], list, n)
    call append([9001], list, n)
    wrong = count(list(:n) /= [(k, k=1, 9001)])
    call check_equal(n, 9001, 'so many items')
    call check_equal(wrong, 0, 'items of a list that grew')
  end subroutine test_lists

  subroutine test_archive()
    type(archive_t) :: archive
    real(wp) :: x, v(3), m(2, 3)
    integer :: k, list(4), pass
    x = 1.0_wp/3.0_wp
    v = [1.0_wp, -2.0_wp, 3.0e300_wp]
    m = reshape([1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp], [2, 3])
    k = -2147483647
    list = [2147483647, 0, -5, 7]
    do pass = 1, 2
      call archive%rewind(merge(archive_save, archive_restore, pass == 1))
      call archive%exchange('x', x)
      call archive%exchange('v', v)
      call archive%exchange('m', m)
      call archive%exchange('k', k)
      call archive%exchange('list', list)
      if (pass == 2) exit
      x = 0.0_wp
      v = 0.0_wp
      m = 0.0_wp
      k = 0
      list = 0
    end do
    call check_true(.not. failed(archive%status), 'the archive restores')
    call check_equal(archive%n, 5, 'entries')
    call check_true(.not. abs(x - 1.0_wp/3.0_wp) > 0.0_wp, 'a real comes back')
    call check_true(.not. any(abs(v - [1.0_wp, -2.0_wp, 3.0e300_wp]) > 0.0_wp), 'a vector')
    call check_true(.not. (abs(m(2, 1) - 2.0_wp) > 0.0_wp &
        .or. abs(m(1, 3) - 5.0_wp) > 0.0_wp), 'a matrix keeps its shape')
    call check_equal(k, -2147483647, 'an integer')
    call check_true(all(list == [2147483647, 0, -5, 7]), 'integers')
  end subroutine test_archive

  !> More entries than it begins with, flags too.
  subroutine test_archive_grows()
    type(archive_t) :: archive
    logical :: flags(3), flag
    integer :: k, n, wrong
    call archive%rewind(archive_save)
    flags = [.true., .false., .true.]
    flag = .true.
    call archive%exchange('flags', flags)
    call archive%exchange('flag', flag)
    do k = 1, 300
      n = k
      call archive%exchange('n', n)
    end do
    call archive%rewind(archive_restore)
    flags = .false.
    flag = .false.
    wrong = 0
    call archive%exchange('flags', flags)
    call archive%exchange('flag', flag)
    do k = 1, 300
      call archive%exchange('n', n)
      if (n /= k) wrong = wrong + 1
    end do
    call check_equal(wrong, 0, 'three hundred entries come back')
    call check_true(flag .and. all(flags .eqv. [.true., .false., .true.]), 'flags come back')
  end subroutine test_archive_grows

  !> Entries that only one side wants: saved, they are passed over; not saved, they are not
  !> asked for; the entry behind them comes back either way.
  subroutine test_archive_agrees()
    type(archive_t) :: archive
    logical :: wanted(2), both
    integer :: pass, k, part, last
    do pass = 1, 4
      wanted = [pass > 2, mod(pass, 2) == 0]
      do k = 1, 2
        call archive%rewind(merge(archive_save, archive_restore, k == 1))
        part = merge(7, 0, k == 1)
        last = merge(9, 0, k == 1)
        call archive%agree('part.', wanted(k), both)
        call check_true(both .eqv. (wanted(k) .and. (k == 1 .or. wanted(1))), 'both')
        if (both) call archive%exchange('part.one', part)
        if (both) call archive%exchange('part.two', part)
        call archive%exchange('last', last)
      end do
      call check_true(.not. failed(archive%status), 'the archive agrees')
      call check_equal(part, merge(7, 0, all(wanted)), 'what both want')
      call check_equal(last, 9, 'what follows')
    end do
  end subroutine test_archive_agrees

  !> Words 1 and 2: sums 3 and 1 + 3 = 4. Every single bit counts, of text and of files, and so
  !> does the length of a file.
  subroutine test_checksum()
    character(*), parameter :: path = 'checksum.scratch'
    character(40000) :: text
    character(16) :: digits, other
    type(status_t) :: status
    integer(i8) :: bytes
    integer :: k, at, same, unit
    call check_equal(checksum_of_text(achar(1)//repeat(achar(0), 3)//achar(2)), &
        '0000000400000003', 'a checksum by hand')
    do k = 1, len(text)
      text(k:k) = achar(modulo(37*k, 251))
    end do
    digits = checksum_of_text(text)
    call check_equal(checksum_of_words(transfer(text, [0_i4])), digits, 'words as their text')
    same = 0
    do k = 1, 300
      at = 1 + modulo(7919*k, len(text))
      text(at:at) = achar(ieor(iachar(text(at:at)), 2**modulo(k, 7)))
      if (checksum_of_text(text) == digits) same = same + 1
      text(at:at) = achar(ieor(iachar(text(at:at)), 2**modulo(k, 7)))
    end do
    call check_equal(same, 0, 'a changed bit is seen')
    open (newunit=unit, file=path, access='stream', form='unformatted', status='replace')
    write (unit) 'head', text(:len(text) - 1)
    close (unit)
    call checksum_of_file(path, 4, other, bytes, status)
    call check_true(bytes == len(text) - 1 .and. .not. failed(status), 'bytes of a file')
    call check_equal(other, checksum_of_text(text(:len(text) - 1)), 'a file as its text')
    call remove_file(path)
    call checksum_of_file(path, 4, other, bytes, status)
    call check_true(failed(status), 'a file that is not there')
  end subroutine test_checksum

  subroutine test_files()
    character(path_length), allocatable :: paths(:)
    type(status_t) :: status
    integer :: unit
    call open_text('a[1].scratch', unit, status)
    write (unit, '(a)') 'twelve bytes', 'more'
    call close_text('a[1].scratch', unit, status)
    call check_equal(file_size('a[1].scratch'), 18_i8, 'the size of a text file')
    call cut_file('a[1].scratch', 13_i8, status)
    call check_equal(file_size('a[1].scratch'), 13_i8, 'cut')
    call move_file('a[1].scratch', 'b[1].scratch', status)
    call sync_file('b[1].scratch', status)
    call check_true(.not. failed(status), 'nothing failed')
    call check_true(file_exists('b[1].scratch'), 'moved')
    call check_true(.not. file_exists('a[1].scratch'), 'moved away')
    call list_files('.', '?[[]1].scratch', paths)
    call check_equal(size(paths), 1, 'listed')
    call check_equal(trim(paths(1)), './b[1].scratch', 'by name')
    call remove_file('b[1].scratch')
    call check_equal(file_size('b[1].scratch'), -1_i8, 'removed')
    call move_file('b[1].scratch', 'c', status)
    call check_true(failed(status), 'nothing to move')
  end subroutine test_files

  subroutine test_refusals()
    type(archive_t) :: archive
    real(wp) :: v(3), w(2)
    v = 1.0_wp
    w = 9.0_wp
    call archive%rewind(archive_save)
    call archive%exchange('v', v)
    call archive%rewind(archive_restore)
    call archive%exchange('u', v)
    call check_equal(archive%status%code, status_file, 'another name is refused')
    call check_true(index(archive%status%message, '"u"') > 0, 'the name is told')
    call archive%rewind(archive_restore)
    call check_equal(archive%status%code, status_ok, 'rewinding starts over')
    call archive%exchange('v', w)
    call check_true(index(archive%status%message, 'size') > 0, 'another size is refused')
    call check_true(.not. any(abs(w - 9.0_wp) > 0.0_wp), 'what is refused is not touched')
    call archive%rewind(archive_restore)
    call archive%exchange('v', v)
    call archive%exchange('w', w)
    call check_true(index(archive%status%message, 'ends before "w"') > 0, 'the end is told')
    call archive%rewind(archive_save)
    call check_equal(archive%n, 0, 'saving starts over')
  end subroutine test_refusals

  !> The definition itself, exponential in time.
  recursive integer function edits(a, b) result(d)
    character(*), intent(in) :: a, b
    if (len(a) == 0 .or. len(b) == 0) then
      d = max(len(a), len(b))
    else
      d = edits(a(2:), b(2:)) + merge(0, 1, a(1:1) == b(1:1))
      d = min(d, edits(a(2:), b) + 1, edits(a, b(2:)) + 1)
    end if
  end function edits

  subroutine test_edit_distance()
    character(5) :: a, b
    real(wp) :: r(12)
    integer :: k, m, n, wrong
    call check_equal(edit_distance('kitten', 'sitting'), 3, 'kitten and sitting')
    call check_equal(edit_distance('', 'abc'), 3, 'from nothing')
    call check_equal(edit_distance('DATABASE', 'DATABASE'), 0, 'equal words')
    wrong = 0
    do k = 1, 300
      call random_number(r)
      do m = 1, 5
        a(m:m) = achar(65 + int(3*r(m)))
        b(m:m) = achar(65 + int(3*r(5 + m)))
      end do
      m = int(6*r(11))
      n = int(6*r(12))
      if (edit_distance(a(:m), b(:n)) /= edits(a(:m), b(:n))) wrong = wrong + 1
    end do
    call check_equal(wrong, 0, 'edit distances against their definition')
  end subroutine test_edit_distance

  subroutine test_status()
    type(status_t) :: status
    call check_true(.not. failed(status), 'nothing has failed yet')
    call add_place(status, 'nowhere')
    call check_equal(status_text(status), '', 'no failure, no text')
    call fail(status, status_deck, 'the cause', place='deck', hint='do this')
    call fail(status, status_file, 'a consequence', place='elsewhere', hint='do that')
    call check_equal(status%code, status_deck, 'the first failure wins')
    call add_place(status, 'step 3')
    call check_equal(status_text(status), 'step 3, deck: the cause'//new_line('a')// &
        '    hint: do this', 'the text of a failure')
  end subroutine test_status

end program test_base
