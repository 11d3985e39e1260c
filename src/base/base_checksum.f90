! SPDX-License-Identifier: BSD-3-Clause
!> A checksum of text and files: Fletcher's (1982) of 32-bit words, two sums modulo the prime
!> 2^32 - 5, as 16 hexadecimal digits. It sees every single changed bit, and a file that ends
!> early.
module base_checksum
  use base_kinds, only: i4, i8
  use base_status, only: status_t, fail, status_file
  implicit none
  private
  public :: checksum_of_text, checksum_of_words, checksum_of_file

  integer(i8), parameter :: modulus = 4294967291_i8
  integer, parameter :: piece = 8192      !< words summed before the sums are reduced

contains

  !> Of characters, padded with zeros to whole words.
  function checksum_of_text(text) result(digits)
    character(*), intent(in) :: text
    character(16) :: digits
    integer(i8) :: sums(2)
    integer :: k, n
    character(4) :: tail
    sums = 0_i8
    do k = 1, len(text) - 3, 4*piece
      n = min(piece, (len(text) - k + 1)/4)
      call add_words(transfer(text(k:k + 4*n - 1), [0_i4], n), sums)
    end do
    n = modulo(len(text), 4)
    if (n > 0) then
      tail = text(len(text) - n + 1:)//repeat(achar(0), 4)
      call add_words(transfer(tail, [0_i4]), sums)
    end if
    digits = as_digits(sums)
  end function checksum_of_text

  !> Of whole words in memory.
  function checksum_of_words(words) result(digits)
    integer(i4), intent(in) :: words(:)
    character(16) :: digits
    integer(i8) :: sums(2), k, n
    sums = 0_i8
    n = size(words, kind=i8)
    do k = 1_i8, n, int(piece, i8)
      call add_words(words(k:min(n, k + piece - 1_i8)), sums)
    end do
    digits = as_digits(sums)
  end function checksum_of_words

  !> Of the bytes of a file after the first `skip`; bytes is their number.
  subroutine checksum_of_file(path, skip, digits, bytes, status)
    character(*), intent(in) :: path
    integer, intent(in) :: skip
    character(16), intent(out) :: digits
    integer(i8), intent(out) :: bytes
    type(status_t), intent(inout) :: status
    integer(i4), allocatable :: words(:)
    integer(i8) :: sums(2), total, at
    integer :: unit, ios, n
    character(200) :: reason
    sums = 0_i8
    digits = ''
    bytes = 0_i8
    open (newunit=unit, file=path, access='stream', form='unformatted', status='old', &
        action='read', iostat=ios, iomsg=reason)
    if (ios == 0) then
      inquire (unit, size=total)
      bytes = max(0_i8, total - skip)
      allocate (words(piece))
      at = skip
      do while (at < total .and. ios == 0)
        n = int(min(int(piece, i8), (total - at)/4_i8))
        if (n > 0) then
          read (unit, pos=at + 1_i8, iostat=ios, iomsg=reason) words(:n)
          call add_words(words(:n), sums)
          at = at + 4_i8*n
        else
          call add_tail(unit, at, total, sums, ios)
          at = total
        end if
      end do
      close (unit)
    end if
    if (ios /= 0) call fail(status, status_file, 'cannot read "'//path//'": '//trim(reason))
    digits = as_digits(sums)
  end subroutine checksum_of_file

  !> The last one to three bytes of a file.
  subroutine add_tail(unit, at, total, sums, ios)
    integer, intent(in) :: unit
    integer(i8), intent(in) :: at, total
    integer(i8), intent(inout) :: sums(2)
    integer, intent(out) :: ios
    character(4) :: tail
    tail = repeat(achar(0), 4)
    read (unit, pos=at + 1_i8, iostat=ios) tail(:int(total - at))
    call add_words(transfer(tail, [0_i4]), sums)
  end subroutine add_tail

  pure subroutine add_words(words, sums)
    integer(i4), intent(in) :: words(:)
    integer(i8), intent(inout) :: sums(2)
    integer :: k
    do k = 1, size(words)
      sums(1) = sums(1) + iand(int(words(k), i8), 4294967295_i8)
      sums(2) = sums(2) + sums(1)
    end do
    sums = modulo(sums, modulus)
  end subroutine add_words

  function as_digits(sums) result(digits)
    integer(i8), intent(in) :: sums(2)
    character(16) :: digits
    write (digits, '(z8.8,z8.8)') sums(2), sums(1)
  end function as_digits

end module base_checksum
