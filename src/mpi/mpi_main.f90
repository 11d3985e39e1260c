! SPDX-License-Identifier: BSD-3-Clause
!> bipact on several ranks: mpirun -n RANKS bipact-mpi DECK. The first rank runs the program, as
!> bipact-hdf5 does, and hands out work on elements and factors; the others serve it. On one
!> rank it is that program.
program bipact_mpi
  use base_signal, only: watch_limits, watch_signals
  use base_system, only: leave
  use hdf5_file, only: start_library
  use mpi_link, only: link_t, open_link, close_link
  use mpi_team, only: cluster_t
  use mpi_worker, only: serve
  use output_storage, only: storage_t
  use run_program, only: run_deck
  use store_backend, only: hdf5_storage_t
  implicit none
  class(storage_t), allocatable :: storage
  type(cluster_t) :: team
  type(link_t) :: link
  call open_link(link)
  if (link%rank > 0) then
    call watch_limits()
    call watch_signals(.true.)    ! it ends when the first rank does
    call serve(link)
    call close_link()
    call leave(0)                 ! the exit code is the first rank's, of which mpirun tells
  end if
  call start_library()
  allocate (hdf5_storage_t :: storage)
  team%link = link
  team%ranks = link%ranks
  call run_deck(storage, team)
end program bipact_mpi
