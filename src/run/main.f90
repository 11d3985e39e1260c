! SPDX-License-Identifier: BSD-3-Clause
!> bipact without fields and restart files, which start the program that has them.
program bipact
  use output_storage, only: storage_t
  use run_program, only: run_deck
  implicit none
  class(storage_t), allocatable :: none
  call run_deck(none)
end program bipact
