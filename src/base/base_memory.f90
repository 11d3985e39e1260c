! SPDX-License-Identifier: BSD-3-Clause
!> What happens when memory runs out: one message and exit code 3. The run-time library of
!> gfortran calls the first procedure when an ALLOCATE without STAT fails (the second in
!> versions before 10); programs are linked with --wrap, so that the call comes here.
module base_memory
  use, intrinsic :: iso_c_binding, only: c_char
  use, intrinsic :: iso_fortran_env, only: error_unit
  use base_status, only: status_file
  use base_system, only: leave
  implicit none
  private
  public :: out_of_memory_at, out_of_memory

contains

  !> In a version from 10 on.
  subroutine out_of_memory_at(where, message) bind(c, name='__wrap__gfortran_os_error_at')
    character(kind=c_char), intent(in) :: where(*), message(*)
    call give_up()
  end subroutine out_of_memory_at

  !> In a version before 10.
  subroutine out_of_memory(message) bind(c, name='__wrap__gfortran_os_error')
    character(kind=c_char), intent(in) :: message(*)
    call give_up()
  end subroutine out_of_memory

  subroutine give_up()
    write (error_unit, '(a)') 'bipact: not enough memory for this scene', &
        '    hint: a smaller mesh, fewer fields or a larger limit (ulimit -v); files of '// &
        'this run end with their last whole rows'
    call leave(status_file)
  end subroutine give_up

end module base_memory
