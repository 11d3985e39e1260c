! SPDX-License-Identifier: BSD-3-Clause
!> What a program that can keep fields and restart files offers to a run. The library that does
!> it is linked to that program alone (layer store); a run knows this interface.
module output_storage
  use base_archive, only: archive_t
  use base_kinds, only: wp, zero
  use base_status, only: status_t
  implicit none
  private

  !> A symmetric tensor has its six components in VTK's order, xx yy zz xy yz xz. Tensor6 of
  !> XDMF is xx xy xz yy yz zz: in this group of a field file stand views of the tensors whose
  !> component k is number xdmf_order(k) of the field's.
  character(*), parameter, public :: xdmf_group = '/XDMF'
  integer, parameter, public :: tensor_components = 6
  integer, parameter, public :: xdmf_order(tensor_components) = [1, 4, 6, 2, 5, 3]

  !> What a restart file says of itself.
  type, public :: restart_header_t
    integer :: cycle = 0
    real(wp) :: time = zero
    character(16) :: deck_hash = ''
    character(:), allocatable :: echo      !< the deck as understood
    character(:), allocatable :: version   !< of the program
  end type restart_header_t

  !> The mesh of the fields, in the terms of VTK: nodes count from 0, offsets(k) is where the
  !> nodes of cell k begin, kind is that of VTK: 9 a quadrilateral, 5 a triangle.
  type, public :: mesh_t
    real(wp), allocatable :: points(:, :)    !< (3, nodes) [L]
    integer, allocatable :: connectivity(:), offsets(:), kind(:)
  end type mesh_t

  !> One field of a frame.
  type, public :: field_t
    character(12) :: name = ''
    logical :: at_nodes = .true.             !< else one value per element
    logical :: constant = .false.            !< the same in every frame: kept once
    logical :: whole = .false.               !< integers
    real(wp), allocatable :: values(:, :)    !< (components, nodes or elements)
  end type field_t

  type, public :: segment_options_t
    integer :: compression = 0               !< 0 to 9
    logical :: single = .false.              !< 32-bit numbers
    integer :: frames = 1                    !< expected
  end type segment_options_t

  type, abstract, public :: storage_t
  contains
    procedure(save_i), deferred :: save_restart
    procedure(load_i), deferred :: load_restart
    procedure(open_i), deferred :: open_segment
    procedure(add_i), deferred :: add_frame
    procedure(close_i), deferred :: close_segment
  end type storage_t

  abstract interface
    !> Writes a whole restart file at path, brought to the disk, and empties the archive; fails
    !> when that cannot be.
    subroutine save_i(this, path, header, archive, status)
      import :: storage_t, restart_header_t, archive_t, status_t
      class(storage_t), intent(inout) :: this
      character(*), intent(in) :: path
      type(restart_header_t), intent(in) :: header
      type(archive_t), intent(inout) :: archive
      type(status_t), intent(inout) :: status
    end subroutine save_i
    !> Reads one; fails with the reason when it is damaged, cut off, or of another kind.
    subroutine load_i(this, path, header, archive, status)
      import :: storage_t, restart_header_t, archive_t, status_t
      class(storage_t), intent(inout) :: this
      character(*), intent(in) :: path
      type(restart_header_t), intent(out) :: header
      type(archive_t), intent(inout) :: archive
      type(status_t), intent(inout) :: status
    end subroutine load_i
    !> Begins a file of frames with its mesh and the names and shapes of the fields.
    subroutine open_i(this, path, mesh, fields, options, status)
      import :: storage_t, mesh_t, field_t, segment_options_t, status_t
      class(storage_t), intent(inout) :: this
      character(*), intent(in) :: path
      type(mesh_t), intent(in) :: mesh
      type(field_t), intent(in) :: fields(:)
      type(segment_options_t), intent(in) :: options
      type(status_t), intent(inout) :: status
    end subroutine open_i
    !> Adds a frame; fails when the file cannot be written any more.
    subroutine add_i(this, time, fields, status)
      import :: storage_t, field_t, wp, status_t
      class(storage_t), intent(inout) :: this
      real(wp), intent(in) :: time
      type(field_t), intent(in) :: fields(:)
      type(status_t), intent(inout) :: status
    end subroutine add_i
    !> Ends the file; frames: how many it holds, which may be fewer than were added where that
    !> or this failed. Without any the file is gone. Does nothing when none is open.
    subroutine close_i(this, frames, status)
      import :: storage_t, status_t
      class(storage_t), intent(inout) :: this
      integer, intent(out) :: frames
      type(status_t), intent(inout) :: status
    end subroutine close_i
  end interface

end module output_storage
