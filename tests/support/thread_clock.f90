! SPDX-License-Identifier: BSD-3-Clause
!> Processor time of parallel loops, task by task, in programs that are linked with --wrap of
!> GOMP_parallel and of the two calls that give a thread its next task: what a run would take on
!> processors of its own, the tasks given to the first thread that is free, which no clock shows
!> on a machine that does other work.
module thread_clock
  use, intrinsic :: iso_c_binding, only: c_ptr, c_funptr, c_int, c_long, c_bool, &
      c_f_procpointer
  use base_kinds, only: wp
  use omp_lib, only: omp_get_thread_num
  implicit none
  private

  integer, parameter :: most = 1024, most_tasks = 200000
  type(c_funptr), save :: region
  integer, save :: tasks = 0                       !< of the region
  real(wp), save :: task(most_tasks)               !< seconds of each, in order of their start
  integer, save :: current(0:most - 1) = 0         !< task of each thread
  real(wp), save :: began(0:most - 1)
  real(wp), save :: inside = 0.0_wp    !< seconds of the first thread in the region
  real(wp), save :: own = 0.0_wp       !< of the first thread in all regions
  real(wp), save :: ways = 0.0_wp      !< sum over regions of the longest way of a thread

  type, bind(c) :: time_t
    integer(c_long) :: seconds, nanoseconds
  end type time_t

  abstract interface
    subroutine region_i(data) bind(c)
      import :: c_ptr
      type(c_ptr), value, intent(in) :: data
    end subroutine region_i
  end interface

  interface
    subroutine real_parallel(f, data, threads, flags) bind(c, name='__real_GOMP_parallel')
      import :: c_funptr, c_ptr, c_int
      type(c_funptr), value, intent(in) :: f
      type(c_ptr), value, intent(in) :: data
      integer(c_int), value, intent(in) :: threads, flags
    end subroutine real_parallel
    logical(c_bool) function real_start(from, end, step, chunk, first, last) &
        bind(c, name='__real_GOMP_loop_nonmonotonic_dynamic_start')
      import :: c_long, c_bool
      integer(c_long), value, intent(in) :: from, end, step, chunk
      integer(c_long), intent(out) :: first, last
    end function real_start
    logical(c_bool) function real_next(first, last) &
        bind(c, name='__real_GOMP_loop_nonmonotonic_dynamic_next')
      import :: c_long, c_bool
      integer(c_long), intent(out) :: first, last
    end function real_next
    integer(c_int) function clock_gettime(clock, time) bind(c)
      import :: c_int, time_t
      integer(c_int), value, intent(in) :: clock
      type(time_t), intent(out) :: time
    end function clock_gettime
  end interface

  public :: path_seconds, timed_parallel, timed_start, timed_next

contains

  !> Seconds so far of the longest way through the program: what is done by one thread, and in
  !> each region that of its slowest thread.
  real(wp) function path_seconds()
    path_seconds = thread_seconds() - own + ways
  end function path_seconds

  !> Processor time of this thread.
  real(wp) function thread_seconds()
    type(time_t) :: time
    integer(c_int), parameter :: of_thread = 3_c_int
    integer(c_int) :: answer
    thread_seconds = 0.0_wp
    answer = clock_gettime(of_thread, time)
    if (answer == 0_c_int) thread_seconds = real(time%seconds, wp) &
        + 1.0e-9_wp*real(time%nanoseconds, wp)
  end function thread_seconds

  subroutine timed_parallel(f, data, threads, flags) bind(c, name='__wrap_GOMP_parallel')
    use, intrinsic :: iso_c_binding, only: c_funloc
    type(c_funptr), value, intent(in) :: f
    type(c_ptr), value, intent(in) :: data
    integer(c_int), value, intent(in) :: threads, flags
    region = f
    tasks = 0
    call real_parallel(c_funloc(timed_region), data, threads, flags)
    ways = ways + longest_way(task(:tasks), int(threads))
    own = own + inside
  end subroutine timed_parallel

  subroutine timed_region(data) bind(c)
    type(c_ptr), value, intent(in) :: data
    procedure(region_i), pointer :: run
    real(wp) :: begin
    begin = thread_seconds()
    current(omp_get_thread_num()) = 0
    call c_f_procpointer(region, run)
    call run(data)
    if (omp_get_thread_num() == 0) inside = thread_seconds() - begin
  end subroutine timed_region

  logical(c_bool) function timed_start(from, end, step, chunk, first, last) &
      bind(c, name='__wrap_GOMP_loop_nonmonotonic_dynamic_start')
    integer(c_long), value, intent(in) :: from, end, step, chunk
    integer(c_long), intent(out) :: first, last
    timed_start = real_start(from, end, step, chunk, first, last)
    if (timed_start) call begin_task()
  end function timed_start

  logical(c_bool) function timed_next(first, last) &
      bind(c, name='__wrap_GOMP_loop_nonmonotonic_dynamic_next')
    integer(c_long), intent(out) :: first, last
    associate (me => omp_get_thread_num())
      task(current(me)) = thread_seconds() - began(me)
    end associate
    timed_next = real_next(first, last)
    if (timed_next) call begin_task()
  end function timed_next

  subroutine begin_task()
    integer :: me, number
    me = omp_get_thread_num()
    !$omp atomic capture
    tasks = tasks + 1
    number = tasks
    !$omp end atomic
    current(me) = number
    began(me) = thread_seconds()
  end subroutine begin_task

  !> Each task goes to the first thread that is free.
  pure real(wp) function longest_way(task, threads)
    real(wp), intent(in) :: task(:)
    integer, intent(in) :: threads
    real(wp) :: busy(threads)
    integer :: k, first
    busy = 0.0_wp
    do k = 1, size(task)
      first = minloc(busy, dim=1)
      busy(first) = busy(first) + task(k)
    end do
    longest_way = maxval(busy)
  end function longest_way

end module thread_clock
