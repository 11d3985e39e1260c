! SPDX-License-Identifier: BSD-3-Clause
!> Files as a whole: names in a folder, sizes, renaming, removal, flushing to the disk.
module base_files
  use, intrinsic :: iso_c_binding, only: c_int, c_char, c_null_char, c_ptr, c_null_ptr, &
      c_size_t, c_long, c_f_pointer, c_associated
  use base_kinds, only: i8
  use base_status, only: status_t, fail, status_file
  implicit none
  private
  public :: open_text, close_text
  public :: file_exists, file_size, move_file, remove_file, cut_file, sync_file, list_files, &
      can_grow, can_reserve

  !> Long enough for every name that list_files gives.
  integer, parameter, public :: path_length = 4096

  ! Flags of open(), and the errors that say that there is no room: on Linux.
  integer(c_int), parameter :: write_only = 1_c_int
  integer(c_int), parameter :: no_room(3) = [27_c_int, 28_c_int, 122_c_int]
  character(*), parameter, public :: disk_full = 'the disk, a quota or a limit on the size '// &
      'of files is full'

  !> glob_t of the C library begins so (POSIX); the rest is room for what it keeps for itself.
  type, bind(c) :: glob_t
    integer(c_size_t) :: paths = 0_c_size_t
    type(c_ptr) :: path = c_null_ptr
    integer(c_size_t) :: rest(16) = 0_c_size_t
  end type glob_t

  interface
    integer(c_int) function c_rename(old, new) bind(c, name='rename')
      import :: c_int, c_char
      character(kind=c_char), intent(in) :: old(*), new(*)
    end function c_rename
    integer(c_int) function c_unlink(path) bind(c, name='unlink')
      import :: c_int, c_char
      character(kind=c_char), intent(in) :: path(*)
    end function c_unlink
    integer(c_int) function c_truncate(path, length) bind(c, name='truncate')
      import :: c_int, c_char, c_long
      character(kind=c_char), intent(in) :: path(*)
      integer(c_long), value, intent(in) :: length
    end function c_truncate
    integer(c_int) function c_open(path, flags) bind(c, name='open')
      import :: c_int, c_char
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int), value, intent(in) :: flags
    end function c_open
    integer(c_long) function c_lseek(descriptor, offset, from) bind(c, name='lseek')
      import :: c_int, c_long
      integer(c_int), value, intent(in) :: descriptor
      integer(c_long), value, intent(in) :: offset
      integer(c_int), value, intent(in) :: from
    end function c_lseek
    integer(c_int) function c_allocate(descriptor, first, length) &
        bind(c, name='posix_fallocate')
      import :: c_int, c_long
      integer(c_int), value, intent(in) :: descriptor
      integer(c_long), value, intent(in) :: first, length
    end function c_allocate
    integer(c_int) function c_cut(descriptor, length) bind(c, name='ftruncate')
      import :: c_int, c_long
      integer(c_int), value, intent(in) :: descriptor
      integer(c_long), value, intent(in) :: length
    end function c_cut
    integer(c_int) function c_create(path, mode) bind(c, name='creat')
      import :: c_int, c_char
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int), value, intent(in) :: mode
    end function c_create
    integer(c_int) function c_fsync(descriptor) bind(c, name='fsync')
      import :: c_int
      integer(c_int), value, intent(in) :: descriptor
    end function c_fsync
    integer(c_int) function c_close(descriptor) bind(c, name='close')
      import :: c_int
      integer(c_int), value, intent(in) :: descriptor
    end function c_close
    integer(c_int) function c_glob(pattern, flags, on_error, result) bind(c, name='glob')
      import :: c_int, c_char, c_ptr, glob_t
      character(kind=c_char), intent(in) :: pattern(*)
      integer(c_int), value, intent(in) :: flags
      type(c_ptr), value, intent(in) :: on_error
      type(glob_t), intent(inout) :: result
    end function c_glob
    subroutine c_globfree(result) bind(c, name='globfree')
      import :: glob_t
      type(glob_t), intent(inout) :: result
    end subroutine c_globfree
    integer(c_size_t) function c_strlen(text) bind(c, name='strlen')
      import :: c_size_t, c_ptr
      type(c_ptr), value, intent(in) :: text
    end function c_strlen
  end interface

contains

  !> Is there a file or folder of that path?
  logical function file_exists(path)
    character(*), intent(in) :: path
    inquire (file=path, exist=file_exists)
  end function file_exists

  !> Bytes of a file as the system has them, -1 where there is none. (What INQUIRE tells of a
  !> file that is open are the bytes it was given, also those that a full disk has lost.)
  integer(i8) function file_size(path)
    character(*), intent(in) :: path
    integer(c_int) :: descriptor, ignored
    file_size = -1_i8
    descriptor = c_open(path//c_null_char, 0_c_int)
    if (descriptor < 0_c_int) return
    file_size = int(c_lseek(descriptor, 0_c_long, 2_c_int), i8)
    ignored = c_close(descriptor)
  end function file_size

  !> Opens a new text file.
  subroutine open_text(path, unit, status)
    character(*), intent(in) :: path
    integer, intent(out) :: unit
    type(status_t), intent(inout) :: status
    character(200) :: reason
    integer :: ios
    open (newunit=unit, file=path, access='stream', form='formatted', action='write', &
        status='replace', iostat=ios, iomsg=reason)
    if (ios /= 0) call fail(status, status_file, 'cannot write "'//path//'": '//trim(reason))
  end subroutine open_text

  !> Closes a text file; fails when it is not as long as what was written to it.
  subroutine close_text(path, unit, status)
    character(*), intent(in) :: path
    integer, intent(in) :: unit
    type(status_t), intent(inout) :: status
    integer(i8) :: next
    integer :: ios
    inquire (unit, pos=next)
    close (unit, iostat=ios)
    if (file_size(path) /= next - 1_i8 .or. ios /= 0) call fail(status, status_file, &
        'cannot write "'//path//'" to its end', hint='is the disk full or the file removed?')
  end subroutine close_text

  !> Renames within a file system, in one stroke: who looks sees the old file or the new one.
  subroutine move_file(old, new, status)
    character(*), intent(in) :: old, new
    type(status_t), intent(inout) :: status
    if (c_rename(old//c_null_char, new//c_null_char) /= 0_c_int) call fail(status, &
        status_file, 'cannot rename "'//old//'" to "'//new//'"', hint='is the folder writable?')
  end subroutine move_file

  !> Removes a file, if there is one.
  subroutine remove_file(path)
    character(*), intent(in) :: path
    integer(c_int) :: ignored
    ignored = c_unlink(path//c_null_char)
  end subroutine remove_file

  !> Keeps the first bytes of a file.
  subroutine cut_file(path, bytes, status)
    character(*), intent(in) :: path
    integer(i8), intent(in) :: bytes
    type(status_t), intent(inout) :: status
    if (c_truncate(path//c_null_char, int(bytes, c_long)) /= 0_c_int) &
        call fail(status, status_file, 'cannot shorten "'//path//'"')
  end subroutine cut_file

  !> Is there room on the disk for so many bytes more at the end of a file, and may the file
  !> become longer by `length` (with holes that take no room)? It stays as it is. True where the
  !> system cannot tell.
  logical function can_grow(path, bytes, length)
    character(*), intent(in) :: path
    integer(i8), intent(in) :: bytes, length
    integer(c_int) :: descriptor, ignored
    integer(c_long) :: there
    can_grow = .true.
    descriptor = c_open(path//c_null_char, write_only)
    if (descriptor < 0_c_int) return
    there = c_lseek(descriptor, 0_c_long, 2_c_int)
    can_grow = all(c_allocate(descriptor, there, int(bytes, c_long)) /= no_room)
    if (can_grow .and. length > bytes) can_grow = all(c_allocate(descriptor, &
        there + int(length - 1_i8, c_long), 1_c_long) /= no_room)
    ignored = c_cut(descriptor, there)
    ignored = c_close(descriptor)
  end function can_grow

  !> Takes room on the disk for a file of so many bytes that will be written later over what is
  !> there; makes it where there is none. False where there is no room for them.
  logical function can_reserve(path, bytes)
    character(*), intent(in) :: path
    integer(i8), intent(in) :: bytes
    integer(c_int), parameter :: rw_rw_rw = 438_c_int
    integer(c_int) :: descriptor, ignored
    can_reserve = .true.
    descriptor = c_open(path//c_null_char, write_only)
    if (descriptor < 0_c_int) descriptor = c_create(path//c_null_char, rw_rw_rw)
    if (descriptor < 0_c_int) return   ! who writes it will learn why
    can_reserve = all(c_allocate(descriptor, 0_c_long, int(bytes, c_long)) /= no_room)
    ignored = c_close(descriptor)
  end function can_reserve

  !> Has the system bring a file, or the names of a folder, to the disk.
  subroutine sync_file(path, status)
    character(*), intent(in) :: path
    type(status_t), intent(inout) :: status
    integer(c_int) :: descriptor, error, ignored
    descriptor = c_open(path//c_null_char, 0_c_int)
    error = -1_c_int
    if (descriptor >= 0_c_int) error = c_fsync(descriptor)
    if (descriptor >= 0_c_int) ignored = c_close(descriptor)
    if (error /= 0_c_int) call fail(status, status_file, '"'//path//'" was not brought '// &
        'to the disk', hint='is the disk full or gone?')
  end subroutine sync_file

  !> Paths in a folder whose names fit a pattern with * (in increasing order).
  subroutine list_files(folder, pattern, paths)
    character(*), intent(in) :: folder, pattern
    character(path_length), allocatable, intent(out) :: paths(:)
    type(glob_t) :: found
    type(c_ptr), pointer :: list(:)
    character(kind=c_char), pointer :: text(:)
    integer :: k, i
    if (c_glob(escaped(folder)//'/'//pattern//c_null_char, 0_c_int, c_null_ptr, found) &
        /= 0_c_int) found%paths = 0_c_size_t
    allocate (paths(found%paths))
    if (found%paths > 0_c_size_t) call c_f_pointer(found%path, list, [found%paths])
    do k = 1, size(paths)
      paths(k) = ''
      call c_f_pointer(list(k), text, [c_strlen(list(k))])
      do i = 1, min(path_length, size(text))
        paths(k)(i:i) = text(i)
      end do
    end do
    if (c_associated(found%path)) call c_globfree(found)
  end subroutine list_files

  !> A path in which no character stands for others.
  pure function escaped(path) result(text)
    character(*), intent(in) :: path
    character(:), allocatable :: text
    integer :: k
    text = ''
    do k = 1, len(path)
      if (scan(path(k:k), '*?[]\') > 0) text = text//'\'
      text = text//path(k:k)
    end do
  end function escaped

end module base_files
