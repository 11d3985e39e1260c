! SPDX-License-Identifier: BSD-3-Clause
!> Messages between the ranks: the first one, which runs the program, and the others, which wait
!> for what it asks. Each message goes between the first rank and one other, in one order, so
!> that none waits for one that waits for it.
module mpi_link
  use, intrinsic :: iso_c_binding, only: c_int, c_size_t
  use base_kinds, only: wp
  use mpi_f08, only: mpi_comm, mpi_comm_world, mpi_comm_rank, mpi_comm_size, &
      mpi_comm_split, mpi_init, mpi_finalize, mpi_send, mpi_recv, mpi_iprobe, mpi_probe, &
      mpi_get_count, mpi_status, mpi_status_ignore, mpi_double_precision, mpi_integer, &
      mpi_any_tag
  implicit none
  private

  integer, parameter, public :: header_length = 16

  type, public :: link_t
    type(mpi_comm) :: comm
    type(mpi_comm) :: backwards    !< the same ranks, the last one first
    integer :: rank = 0
    integer :: ranks = 1
  end type link_t

  interface
    integer(c_int) function c_usleep(microseconds) bind(c, name='usleep')
      import :: c_int
      integer(c_int), value, intent(in) :: microseconds
    end function c_usleep
    integer(c_int) function c_malloc_trim(pad) bind(c, name='malloc_trim')
      import :: c_int, c_size_t
      integer(c_size_t), value, intent(in) :: pad
    end function c_malloc_trim
  end interface

  public :: open_link, close_link, send_numbers, receive_numbers, send_integers, &
      receive_integers, wait_for_header, waiting_numbers, give_back_memory

contains

  !> Joins the other ranks.
  subroutine open_link(link)
    type(link_t), intent(out) :: link
    call mpi_init()
    link%comm = mpi_comm_world
    call mpi_comm_rank(link%comm, link%rank)
    call mpi_comm_size(link%comm, link%ranks)
    call mpi_comm_split(link%comm, 0, link%ranks - link%rank, link%backwards)
  end subroutine open_link

  !> Waits until all ranks leave.
  subroutine close_link()
    call mpi_finalize()
  end subroutine close_link

  !> n numbers to a rank.
  subroutine send_numbers(link, to, n, a)
    type(link_t), intent(in) :: link
    integer, intent(in) :: to, n
    real(wp), intent(in) :: a(*)
    call mpi_send(a, n, mpi_double_precision, to, 0, link%comm)
  end subroutine send_numbers

  !> n numbers from a rank.
  subroutine receive_numbers(link, from, n, a)
    type(link_t), intent(in) :: link
    integer, intent(in) :: from, n
    real(wp), intent(inout) :: a(*)
    call mpi_recv(a, n, mpi_double_precision, from, 0, link%comm, mpi_status_ignore)
  end subroutine receive_numbers

  !> n integers to a rank.
  subroutine send_integers(link, to, n, a)
    type(link_t), intent(in) :: link
    integer, intent(in) :: to, n
    integer, intent(in) :: a(*)
    call mpi_send(a, n, mpi_integer, to, 0, link%comm)
  end subroutine send_integers

  !> n integers from a rank.
  subroutine receive_integers(link, from, n, a)
    type(link_t), intent(in) :: link
    integer, intent(in) :: from, n
    integer, intent(inout) :: a(*)
    call mpi_recv(a, n, mpi_integer, from, 0, link%comm, mpi_status_ignore)
  end subroutine receive_integers

  !> How many numbers the next message of a rank has; waits for it.
  integer function waiting_numbers(link, from)
    type(link_t), intent(in) :: link
    integer, intent(in) :: from
    type(mpi_status) :: info
    call mpi_probe(from, 0, link%comm, info)
    call mpi_get_count(info, mpi_double_precision, waiting_numbers)
  end function waiting_numbers

  !> The next task from the first rank. The longer it takes the more seldom it is looked for: a
  !> rank that waits leaves its core to others.
  subroutine wait_for_header(link, header)
    type(link_t), intent(in) :: link
    real(wp), intent(out) :: header(header_length)
    integer, parameter :: eager = 2000, longest = 500
    integer(c_int) :: ignored
    integer :: looks
    logical :: is_there
    looks = 0
    do
      call mpi_iprobe(0, mpi_any_tag, link%comm, is_there, mpi_status_ignore)
      if (is_there) exit
      looks = looks + 1
      if (looks > eager) ignored = c_usleep(int(min(longest, 10 + (looks - eager)/4), c_int))
    end do
    call receive_numbers(link, 0, header_length, header)
  end subroutine wait_for_header

  !> Memory that is free within the process goes back to the system: what was used before a
  !> factor does not stand beside it.
  subroutine give_back_memory()
    integer(c_int) :: ignored
    ignored = c_malloc_trim(0_c_size_t)
  end subroutine give_back_memory

end module mpi_link
