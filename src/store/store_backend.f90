! SPDX-License-Identifier: BSD-3-Clause
!> Fields and restart files in HDF5, as a run asks for them.
module store_backend
  use base_archive, only: archive_t
  use base_kinds, only: wp
  use base_status, only: status_t
  use output_storage, only: storage_t, restart_header_t, mesh_t, field_t, segment_options_t
  use store_fields, only: fields_file_t, open_fields, add_frame, close_fields
  use store_restart, only: write_restart_file, read_restart_file
  implicit none
  private

  type, extends(storage_t), public :: hdf5_storage_t
    type(fields_file_t) :: fields
  contains
    procedure :: save_restart => backend_save
    procedure :: load_restart => backend_load
    procedure :: open_segment => backend_open
    procedure :: add_frame => backend_add
    procedure :: close_segment => backend_close
  end type hdf5_storage_t

contains

  subroutine backend_save(this, path, header, archive, status)
    class(hdf5_storage_t), intent(inout) :: this
    character(*), intent(in) :: path
    type(restart_header_t), intent(in) :: header
    type(archive_t), intent(inout) :: archive
    type(status_t), intent(inout) :: status
    call write_restart_file(path, header, archive, status)
  end subroutine backend_save

  subroutine backend_load(this, path, header, archive, status)
    class(hdf5_storage_t), intent(inout) :: this
    character(*), intent(in) :: path
    type(restart_header_t), intent(out) :: header
    type(archive_t), intent(inout) :: archive
    type(status_t), intent(inout) :: status
    call read_restart_file(path, header, archive, status)
  end subroutine backend_load

  subroutine backend_open(this, path, mesh, fields, options, status)
    class(hdf5_storage_t), intent(inout) :: this
    character(*), intent(in) :: path
    type(mesh_t), intent(in) :: mesh
    type(field_t), intent(in) :: fields(:)
    type(segment_options_t), intent(in) :: options
    type(status_t), intent(inout) :: status
    call open_fields(path, mesh, fields, options, this%fields, status)
  end subroutine backend_open

  subroutine backend_add(this, time, fields, status)
    class(hdf5_storage_t), intent(inout) :: this
    real(wp), intent(in) :: time
    type(field_t), intent(in) :: fields(:)
    type(status_t), intent(inout) :: status
    call add_frame(time, fields, this%fields, status)
  end subroutine backend_add

  subroutine backend_close(this, frames, status)
    class(hdf5_storage_t), intent(inout) :: this
    integer, intent(out) :: frames
    type(status_t), intent(inout) :: status
    call close_fields(this%fields, frames, status)
  end subroutine backend_close

end module store_backend
