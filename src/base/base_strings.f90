! SPDX-License-Identifier: BSD-3-Clause
!> Small text helpers; no input or output.
module base_strings
  use base_kinds, only: wp, i8
  implicit none
  private
  public :: upper, to_text, join_path, folder_of, stem_of, edit_distance, &
      position_of, join

  !> Numbers as text for messages and logs.
  interface to_text
    module procedure :: integer_text
    module procedure :: long_text
    module procedure :: real_text_short
  end interface to_text

contains

  !> Where a letter first is in a text; 0 = nowhere. INDEX of a single letter, at half its cost:
  !> it is asked of every line of a deck.
  pure integer function position_of(text, letter)
    character(*), intent(in) :: text
    character, intent(in) :: letter
    do position_of = 1, len(text)
      if (text(position_of:position_of) == letter) return
    end do
    position_of = 0
  end function position_of

  !> ASCII upper case.
  pure function upper(text) result(up)
    character(*), intent(in) :: text
    character(len(text)) :: up
    integer :: i, c
    up = text
    do i = 1, len(text)
      c = iachar(text(i:i))
      if (c >= 97 .and. c <= 122) up(i:i) = achar(c - 32)
    end do
  end function upper

  !> An integer without blanks.
  pure function integer_text(number) result(text)
    integer, intent(in) :: number
    character(:), allocatable :: text
    text = long_text(int(number, i8))
  end function integer_text

  !> A long integer without blanks. (By hand: the run-time library takes ten times as long.)
  pure function long_text(number) result(text)
    integer(i8), intent(in) :: number
    character(:), allocatable :: text
    character(20) :: buffer
    integer(i8) :: rest
    integer :: first
    rest = number
    first = len(buffer) + 1
    do
      first = first - 1
      buffer(first:first) = achar(48 + int(abs(mod(rest, 10_i8))))
      rest = rest/10_i8
      if (rest == 0_i8) exit
    end do
    text = buffer(first:)
    if (number < 0_i8) text = '-'//text
  end function long_text

  !> A real for messages and logs: six digits, no blanks.
  pure function real_text_short(number) result(text)
    real(wp), intent(in) :: number
    character(:), allocatable :: text
    character(24) :: buffer
    write (buffer, '(es14.6e3)') number
    text = short_real(trim(adjustl(buffer)))
  end function real_text_short

  !> The shortest layout of an exponential number: 1.500000E-003 becomes 0.0015, 2.000000E+008
  !> becomes 2.0E8; text without an exponent and its sign (NaN, Infinity) stays as it is.
  pure function short_real(long) result(text)
    character(*), intent(in) :: long
    character(:), allocatable :: text, digits, sign
    integer :: e, last, power, k
    e = index(long, 'E')
    text = long
    if (e == 0) return
    power = 0
    do k = e + 2, len(long)
      power = 10*power + iachar(long(k:k)) - 48
    end do
    if (long(e + 1:e + 1) == '-') power = -power
    sign = ''
    if (long(1:1) == '-') sign = '-'
    digits = long(len(sign) + 1:len(sign) + 1)//long(len(sign) + 3:e - 1)
    last = max(1, verify(digits, '0', back=.true.))
    digits = digits(1:last)
    if (power < -4 .or. power > 6) then
      if (last == 1) digits = digits//'0'
      text = sign//digits(1:1)//'.'//digits(2:)//'E'//integer_text(power)
    else if (power < 0) then
      text = sign//'0.'//repeat('0', -power - 1)//digits
    else if (last <= power + 1) then
      text = sign//digits//repeat('0', power + 1 - last)//'.0'
    else
      text = sign//digits(1:power + 1)//'.'//digits(power + 2:)
    end if
  end function short_real

  !> Joins a folder and a file name.
  pure function join_path(folder, name) result(path)
    character(*), intent(in) :: folder
    character(*), intent(in) :: name
    character(:), allocatable :: path
    if (len(folder) == 0 .or. name(1:min(1, len(name))) == '/') then
      path = name
    else
      path = folder//'/'//name
    end if
  end function join_path

  !> Words, without their trailing blanks, with a separator between them.
  pure function join(words, separator) result(text)
    character(*), intent(in) :: words(:), separator
    character(:), allocatable :: text
    integer :: k
    text = ''
    do k = 1, size(words)
      if (k > 1) text = text//separator
      text = text//trim(words(k))
    end do
  end function join

  !> The folder of a path, without the last slash; empty for a bare file name.
  pure function folder_of(path) result(folder)
    character(*), intent(in) :: path
    character(:), allocatable :: folder
    folder = path(1:max(0, index(path, '/', back=.true.) - 1))
  end function folder_of

  !> The file name of a path without its folder and its last suffix.
  pure function stem_of(path) result(stem)
    character(*), intent(in) :: path
    character(:), allocatable :: stem
    integer :: dot
    stem = path(index(path, '/', back=.true.) + 1:)
    dot = index(stem, '.', back=.true.)
    if (dot > 1) stem = stem(1:dot - 1)
  end function stem_of

  !> Number of single-character edits between two words (Levenshtein 1966), to suggest a near
  !> name.
  pure integer function edit_distance(a, b)
    character(*), intent(in) :: a
    character(*), intent(in) :: b
    integer :: row(0:len(b)), i, j, corner, old
    row = [(j, j=0, len(b))]
    do i = 1, len(a)
      corner = row(0)
      row(0) = i
      do j = 1, len(b)
        old = row(j)
        row(j) = min(row(j - 1) + 1, old + 1, corner + merge(0, 1, a(i:i) == b(j:j)))
        corner = old
      end do
    end do
    edit_distance = row(len(b))
  end function edit_distance

end module base_strings
