! SPDX-License-Identifier: BSD-3-Clause
!> Requests for memory, counted in programs that are linked with --wrap=malloc and
!> --wrap=realloc.
module count_allocations
  use, intrinsic :: iso_c_binding, only: c_ptr, c_size_t
  implicit none
  private
  integer, save :: allocations = 0

  interface
    function real_malloc(bytes) bind(c, name='__real_malloc') result(place)
      import :: c_ptr, c_size_t
      integer(c_size_t), value, intent(in) :: bytes
      type(c_ptr) :: place
    end function real_malloc
    function real_realloc(old, bytes) bind(c, name='__real_realloc') result(place)
      import :: c_ptr, c_size_t
      type(c_ptr), value, intent(in) :: old
      integer(c_size_t), value, intent(in) :: bytes
      type(c_ptr) :: place
    end function real_realloc
  end interface

  public :: allocations_so_far, counted_malloc, counted_realloc

contains

  !> Requests since the program began. (A function of another file: a compiler that knows malloc
  !> believes that it leaves variables alone.)
  integer function allocations_so_far()
    allocations_so_far = allocations
  end function allocations_so_far

  function counted_malloc(bytes) bind(c, name='__wrap_malloc') result(place)
    integer(c_size_t), value, intent(in) :: bytes
    type(c_ptr) :: place
    allocations = allocations + 1
    place = real_malloc(bytes)
  end function counted_malloc

  function counted_realloc(old, bytes) bind(c, name='__wrap_realloc') result(place)
    type(c_ptr), value, intent(in) :: old
    integer(c_size_t), value, intent(in) :: bytes
    type(c_ptr) :: place
    allocations = allocations + 1
    place = real_realloc(old, bytes)
  end function counted_realloc

end module count_allocations
