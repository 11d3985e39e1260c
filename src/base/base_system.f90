! SPDX-License-Identifier: BSD-3-Clause
!> The few calls to the operating system that Fortran has no word for.
module base_system
  use, intrinsic :: iso_c_binding, only: c_int, c_char, c_null_char, c_ptr, &
      c_null_ptr, c_loc, c_size_t
  use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
  use base_kinds, only: i8
  use base_status, only: status_t, fail, status_file
  implicit none
  private
  public :: make_folder, remove_folder, is_terminal, leave, exec_hdf5_program, &
      peak_memory, machine_memory, has_wide_vectors

  interface
    integer(c_int) function c_mkdir(path, mode) bind(c, name='mkdir')
      import :: c_int, c_char
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int), value, intent(in) :: mode
    end function c_mkdir
    integer(c_int) function c_rmdir(path) bind(c, name='rmdir')
      import :: c_int, c_char
      character(kind=c_char), intent(in) :: path(*)
    end function c_rmdir
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
    integer(c_int) function c_execv(path, arguments) bind(c, name='execv')
      import :: c_int, c_char, c_ptr
      character(kind=c_char), intent(in) :: path(*)
      type(c_ptr), intent(in) :: arguments(*)
    end function c_execv
    integer(c_size_t) function c_readlink(path, text, size) bind(c, name='readlink')
      import :: c_size_t, c_char
      character(kind=c_char), intent(in) :: path(*)
      character(kind=c_char), intent(out) :: text(*)
      integer(c_size_t), value, intent(in) :: size
    end function c_readlink
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

  !> Removes a folder that is empty; one that is not stays.
  subroutine remove_folder(path)
    character(*), intent(in) :: path
    integer(c_int) :: ignored
    ignored = c_rmdir(path//c_null_char)
  end subroutine remove_folder

  !> True when a file descriptor (1 output, 2 messages) is a terminal.
  logical function is_terminal(descriptor)
    integer, intent(in) :: descriptor
    is_terminal = c_isatty(int(descriptor, c_int)) /= 0_c_int
  end function is_terminal

  !> Largest resident memory of the process so far, in bytes; -1 where the system does not tell.
  integer(i8) function peak_memory()
    character(80) :: line
    integer(i8) :: kilobytes
    integer :: unit, ios, end_of_number
    peak_memory = -1_i8
    open (newunit=unit, file='/proc/self/status', action='read', status='old', iostat=ios)
    if (ios /= 0) return
    do while (ios == 0)
      read (unit, '(a)', iostat=ios) line
      if (ios /= 0 .or. line(1:6) /= 'VmHWM:') cycle
      end_of_number = index(line, 'kB') - 1
      read (line(8:end_of_number), *, iostat=ios) kilobytes
      if (ios == 0) peak_memory = 1024_i8*kilobytes
      exit
    end do
    close (unit)
  end function peak_memory

  !> Ends the program with an exit code and no word of the run-time library.
  subroutine leave(code)
    integer, intent(in) :: code
    flush (output_unit)
    flush (error_unit)
    call c_exit(int(code, c_int))
  end subroutine leave

  !> Becomes another program that lies beside this one, with the same command line: its name is
  !> that of this one with `ending` after the first word (bipact-debug: bipact-ending-debug).
  !> Returns only where there is none, with its path.
  subroutine exec_hdf5_program(ending, path)
    character(*), intent(in) :: ending
    character(:), allocatable, intent(out) :: path
    integer, parameter :: longest = 4096
    character(kind=c_char), allocatable, target :: word(:, :)
    type(c_ptr), allocatable :: list(:)
    character(longest) :: text
    character(kind=c_char) :: own(longest)
    integer(c_size_t) :: length
    integer(c_int) :: ignored
    integer :: k, i, n, dash
    length = c_readlink('/proc/self/exe'//c_null_char, own, int(longest, c_size_t))
    path = ''
    do k = 1, int(length)
      path = path//own(k)
    end do
    if (length < 1) then
      call get_command_argument(0, text)
      path = trim(text)
    end if
    dash = index(path(index(path, '/', back=.true.) + 1:), '-')
    if (dash > 0) dash = dash + index(path, '/', back=.true.)
    if (dash == 0) dash = len(path) + 1
    path = path(:dash - 1)//'-'//ending//path(dash:)
    n = command_argument_count()
    allocate (word(longest + 1, 0:n), list(0:n + 1))
    do k = 0, n
      call get_command_argument(k, text)
      do i = 1, len_trim(text)
        word(i, k) = text(i:i)
      end do
      word(len_trim(text) + 1, k) = c_null_char
      list(k) = c_loc(word(1, k))
    end do
    list(n + 1) = c_null_ptr
    ignored = c_execv(path//c_null_char, list)
  end subroutine exec_hdf5_program

  !> Bytes of memory of the machine; the largest number where the system does not say.
  integer(i8) function machine_memory()
    character(80) :: line
    integer :: unit, stat
    machine_memory = huge(machine_memory)
    open (newunit=unit, file='/proc/meminfo', status='old', action='read', iostat=stat)
    if (stat /= 0) return
    do
      read (unit, '(a)', iostat=stat) line
      if (stat /= 0) exit
      if (index(line, 'MemTotal:') /= 1) cycle
      read (line(10:), *, iostat=stat) machine_memory
      if (stat == 0) machine_memory = 1024_i8*machine_memory
      exit
    end do
    close (unit)
  end function machine_memory

  !> Does the processor compute with vectors of four numbers (AVX2 of x86-64)? No where the
  !> system does not say.
  logical function has_wide_vectors()
    character(8192) :: line
    integer :: unit, stat
    has_wide_vectors = .false.
    open (newunit=unit, file='/proc/cpuinfo', status='old', action='read', iostat=stat)
    if (stat /= 0) return
    do
      read (unit, '(a)', iostat=stat) line
      if (stat /= 0) exit
      if (index(line, 'flags') /= 1) cycle
      has_wide_vectors = index(line, ' avx2 ') > 0
      exit
    end do
    close (unit)
  end function has_wide_vectors

end module base_system
