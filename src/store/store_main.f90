! SPDX-License-Identifier: BSD-3-Clause
!> bipact with HDF5: the same program, which bipact becomes where a scene asks for field files
!> or restarts. Apart, because linking the library costs every start.
program bipact_hdf5
  use hdf5_file, only: start_library
  use output_storage, only: storage_t
  use run_program, only: run_deck
  use store_backend, only: hdf5_storage_t
  implicit none
  class(storage_t), allocatable :: storage
  call start_library()
  allocate (hdf5_storage_t :: storage)
  call run_deck(storage)
end program bipact_hdf5
