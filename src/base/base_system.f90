! SPDX-License-Identifier: BSD-3-Clause
!> The few calls to the operating system that Fortran has no word for.
module base_system
  use, intrinsic :: iso_c_binding, only: c_int, c_char, c_null_char
  use base_status, only: status_t, fail, status_file
  implicit none
  private
  public :: make_folder, is_terminal, leave

  interface
    integer(c_int) function c_mkdir(path, mode) bind(c, name='mkdir')
      import :: c_int, c_char
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int), value, intent(in) :: mode
    end function c_mkdir
    integer(c_int) function c_access(path, mode) bind(c, name='access')
      import :: c_int, c_char
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int), value, intent(in) :: mode
    end function c_access
    integer(c_int) function c_isatty(descriptor) bind(c, name='isatty')
      import :: c_int
      integer(c_int), value, intent(in) :: descriptor
    end function c_isatty
    subroutine c_exit(code) bind(c, name='exit')
      import :: c_int
      integer(c_int), value, intent(in) :: code
    end subroutine c_exit
  end interface

contains

  !> Makes a folder and its parents; fails when it cannot be written to afterwards.
  subroutine make_folder(path, status)
    character(*), intent(in) :: path
    type(status_t), intent(inout) :: status
    integer(c_int), parameter :: mode = int(o'777', c_int), may_write = 2_c_int
    integer(c_int) :: ignored
    integer :: k
    do k = 2, len(path)
      if (path(k:k) == '/') ignored = c_mkdir(path(1:k - 1)//c_null_char, mode)
    end do
    ignored = c_mkdir(path//c_null_char, mode)
    if (c_access(path//'/.'//c_null_char, may_write) /= 0_c_int) then
      call fail(status, status_file, 'cannot make or write the folder "'//path//'"', &
          hint='choose another one with -o DIR')
    end if
  end subroutine make_folder

  !> True when a file descriptor (1 output, 2 messages) is a terminal.
  logical function is_terminal(descriptor)
    integer, intent(in) :: descriptor
    is_terminal = c_isatty(int(descriptor, c_int)) /= 0_c_int
  end function is_terminal

  !> Ends the program with an exit code and no word of the run-time library.
  subroutine leave(code)
    integer, intent(in) :: code
    call c_exit(int(code, c_int))
  end subroutine leave

end module base_system
