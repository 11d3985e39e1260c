! SPDX-License-Identifier: BSD-3-Clause
!> The text of the deck: every file is read whole, lines are pieces of it.
module deck_source
  use base_kinds, only: i8
  use base_status, only: status_t, fail, status_file
  use base_strings, only: position_of
  implicit none
  private

  type, public :: source_file_t
    character(:), allocatable :: path
    character(:), allocatable :: text
    integer :: bytes = 0          !< of the text, and its checksum, where that is not kept
    character(16) :: checksum = ''
    integer :: parent = 0         !< file that includes this one
    integer :: parent_line = 0
  end type source_file_t

  !> A place in a file: where the next line starts, and the line just read.
  type, public :: cursor_t
    integer :: file = 0
    integer :: next = 1           !< position of the next line in the text
    integer :: first = 1          !< the line just read is text(first:last)
    integer :: last = 0
    integer :: line = 0           !< its number
  end type cursor_t

  public :: load_file, next_line

contains

  !> Reads a whole file; fails if it cannot be read.
  subroutine load_file(path, file, status)
    character(*), intent(in) :: path
    type(source_file_t), intent(inout) :: file
    type(status_t), intent(inout) :: status
    integer(i8) :: length
    integer :: unit, ios
    character(256) :: reason
    file%path = path
    open (newunit=unit, file=path, access='stream', form='unformatted', action='read', &
        status='old', iostat=ios, iomsg=reason)
    if (ios == 0) then
      inquire (unit=unit, size=length)
      if (length < 0 .or. length >= huge(1)) then
        ios = 1
        reason = 'not a file of less than 2 GB'
      else
        allocate (character(int(length)) :: file%text)
        read (unit, iostat=ios, iomsg=reason) file%text
      end if
      close (unit)
    end if
    if (ios /= 0) call fail(status, status_file, 'cannot read "'//path//'": '//trim(reason))
    if (ios /= 0 .and. .not. allocated(file%text)) file%text = ''
  end subroutine load_file

  !> Moves to the next line that is no comment; false at the end of the file.
  !> A carriage return before the line end and a byte-order mark at the start do not belong to
  !> it.
  logical function next_line(file, cursor)
    type(source_file_t), intent(in) :: file
    type(cursor_t), intent(inout) :: cursor
    character, parameter :: line_feed = achar(10), carriage_return = achar(13)
    character(3), parameter :: mark = char(239)//char(187)//char(191)
    integer :: length
    next_line = .false.
    if (cursor%next == 1 .and. len(file%text) >= 3) then
      if (file%text(1:3) == mark) cursor%next = 4
    end if
    do while (cursor%next <= len(file%text))
      length = position_of(file%text(cursor%next:), line_feed) - 1
      if (length < 0) length = len(file%text) - cursor%next + 1
      cursor%first = cursor%next
      cursor%last = cursor%next + length - 1
      cursor%next = cursor%next + length + 1
      cursor%line = cursor%line + 1
      if (cursor%last >= cursor%first) then
        if (file%text(cursor%last:cursor%last) == carriage_return) cursor%last = cursor%last - 1
      end if
      if (cursor%last >= cursor%first) then
        if (file%text(cursor%first:cursor%first) == '$') cycle
      end if
      next_line = .true.
      return
    end do
  end function next_line

end module deck_source
