! SPDX-License-Identifier: BSD-3-Clause
!> Field files in the layout of VTKHDF (version 2.0): an unstructured grid with one mesh for all
!> steps, the steps of each field stacked along its first axis.
module store_fields
  use base_files, only: can_grow, disk_full, remove_file
  use base_kinds, only: wp, i8
  use base_status, only: status_t, fail, failed, status_file
  use base_strings, only: to_text
  use hdf5, only: hid_t, h5gopen_f, h5gclose_f, h5fflush_f, h5f_scope_global_f
  use hdf5_file, only: file_t, create_file, close_file, make_group, opens
  use hdf5_series, only: series_t, create_series, create_view, append_rows, hold_rows, &
      flush_series, close_series, open_attribute, write_attribute, close_attribute, &
      write_text_attribute, write_list_attribute
  use output_storage, only: mesh_t, field_t, segment_options_t, tensor_components, xdmf_group, &
      xdmf_order
  implicit none
  private
  public :: open_fields, add_frame, close_fields

  !> Of a field: in memory, and in a chunk on file. Frames that memory holds at most.
  integer, parameter :: room_bytes = 2**20, chunk_bytes = 2**17, longest_list = 256
  !> Two nodes of the tree by which HDF5 finds chunks, and what a chunk takes in it at most.
  integer(i8), parameter :: tree_bytes = 5400_i8, entry_bytes = 100_i8

  type, public :: fields_file_t
    type(file_t) :: file
    logical :: is_open = .false.
    integer :: frames = 0
    integer :: kept = 0                         !< frames on file
    integer :: nodes = 0, cells = 0
    integer(hid_t) :: count = -1                !< attribute NSteps
    type(series_t), allocatable :: field(:)
    type(series_t), allocatable :: offset(:)    !< of each field, one entry a frame
    integer, allocatable :: rows(:)             !< of each field in a frame; 0: kept once
    integer, allocatable :: chunk_frames(:)     !< in a chunk of each field
    integer(i8), allocatable :: chunk_bytes(:)  !< of each field, not compressed
    integer :: list_chunk = longest_list
    logical :: compressed = .false.
    type(series_t) :: times, list(5)            !< what VTK wants to know of each step
  end type fields_file_t

  character(22), parameter :: lists(5) = [character(22) :: 'PartOffsets', 'NumberOfParts', &
      'PointOffsets', 'CellOffsets', 'ConnectivityIdOffsets']

contains

  !> Begins a file with the mesh and the fields (their values are not yet written). None stays
  !> where that fails.
  subroutine open_fields(path, mesh, fields, options, to, status)
    character(*), intent(in) :: path
    type(mesh_t), intent(in) :: mesh
    type(field_t), intent(in) :: fields(:)
    type(segment_options_t), intent(in) :: options
    type(fields_file_t), intent(inout) :: to
    type(status_t), intent(inout) :: status
    call create_file(path, to%file, status)
    if (failed(status)) return
    to%is_open = .true.
    call fill_file(mesh, fields, options, to, status)
    if (.not. failed(status)) return
    call close_file(to%file)
    call remove_file(path)
    to%is_open = .false.
  end subroutine open_fields

  subroutine fill_file(mesh, fields, options, to, status)
    type(mesh_t), intent(in) :: mesh
    type(field_t), intent(in) :: fields(:)
    type(segment_options_t), intent(in) :: options
    type(fields_file_t), intent(inout) :: to
    type(status_t), intent(inout) :: status
    integer(hid_t) :: root, steps
    integer :: k, error
    to%frames = 0
    to%compressed = options%compression > 0
    to%list_chunk = max(1, min(longest_list, options%frames))
    to%nodes = size(mesh%points, 2)
    to%cells = size(mesh%kind)
    call make_group(to%file, '/VTKHDF', status)
    call h5gopen_f(to%file%id, '/VTKHDF', root, error)
    call write_list_attribute(root, 'Version', [2_i8, 0_i8])
    call write_text_attribute(root, 'Type', 'UnstructuredGrid')
    call h5gclose_f(root, error)
    call write_mesh(mesh, options, to, status)
    call make_group(to%file, '/VTKHDF/PointData', status)
    call make_group(to%file, '/VTKHDF/CellData', status)
    if (any([(size(fields(k)%values, 1) == tensor_components, k=1, size(fields))])) &
        call make_group(to%file, xdmf_group, status)
    call make_group(to%file, '/VTKHDF/Steps', status)
    call make_group(to%file, '/VTKHDF/Steps/PointDataOffsets', status)
    call make_group(to%file, '/VTKHDF/Steps/CellDataOffsets', status)
    if (failed(status)) return
    call h5gopen_f(to%file%id, '/VTKHDF/Steps', steps, error)
    call open_attribute(steps, 'NSteps', 0_i8, to%count)
    call h5gclose_f(steps, error)
    call create_series(to%file, '/VTKHDF/Steps/Values', 'REAL', 1, .true., to%list_chunk, &
        to%list_chunk, 0, to%times, status)
    do k = 1, size(lists)
      call create_series(to%file, '/VTKHDF/Steps/'//trim(lists(k)), 'INTEGER', 1, k < 4, &
          to%list_chunk, to%list_chunk, 0, to%list(k), status)
    end do
    if (allocated(to%field)) deallocate (to%field, to%offset, to%rows, to%chunk_frames, &
        to%chunk_bytes)
    allocate (to%field(size(fields)), to%offset(size(fields)), to%rows(size(fields)), &
        to%chunk_frames(size(fields)), to%chunk_bytes(size(fields)))
    do k = 1, size(fields)
      call open_field(fields(k), options, k, to, status)
    end do
    to%kept = 0
    if (.not. failed(status)) call flush_file(to, status)
  end subroutine fill_file

  subroutine open_field(field, options, k, to, status)
    type(field_t), intent(in) :: field
    type(segment_options_t), intent(in) :: options
    integer, intent(in) :: k
    type(fields_file_t), intent(inout) :: to
    type(status_t), intent(inout) :: status
    character(:), allocatable :: place, kind, path
    integer :: components, rows, bytes, frames, room
    place = merge('Point', 'Cell ', field%at_nodes)
    kind = 'REAL'
    if (options%single) kind = 'SINGLE'
    if (field%whole) kind = 'INTEGER'
    components = size(field%values, 1)
    rows = max(1, size(field%values, 2))
    bytes = rows*components*merge(4, 8, kind == 'SINGLE')
    frames = max(1, min(to%list_chunk, chunk_bytes/bytes))
    room = frames*max(1, min(to%list_chunk, room_bytes/bytes)/frames)
    to%rows(k) = size(field%values, 2)
    if (field%constant) then
      to%rows(k) = 0
      frames = 1
      room = 1
    end if
    to%chunk_frames(k) = frames
    to%chunk_bytes(k) = int(bytes, i8)*frames
    path = '/VTKHDF/'//trim(place)//'Data/'//trim(field%name)
    call create_series(to%file, path, kind, components, components == 1, rows*frames, &
        rows*room, options%compression, to%field(k), status)
    if (components == tensor_components) call create_view(to%file, xdmf_group//'/'// &
        trim(field%name), to%field(k), path, xdmf_order, status)
    call create_series(to%file, '/VTKHDF/Steps/'//trim(place)//'DataOffsets/'// &
        trim(field%name), 'INTEGER', 1, .true., to%list_chunk, to%list_chunk, 0, &
        to%offset(k), status)
  end subroutine open_field

  !> Points, cells, and how many of each.
  subroutine write_mesh(mesh, options, to, status)
    type(mesh_t), intent(in) :: mesh
    type(segment_options_t), intent(in) :: options
    type(fields_file_t), intent(inout) :: to
    type(status_t), intent(inout) :: status
    call put('NumberOfPoints', 'INTEGER', reshape([real(to%nodes, wp)], [1, 1]))
    call put('NumberOfCells', 'INTEGER', reshape([real(to%cells, wp)], [1, 1]))
    call put('NumberOfConnectivityIds', 'INTEGER', &
        reshape([real(size(mesh%connectivity), wp)], [1, 1]))
    call put('Points', 'REAL', mesh%points)
    call put('Connectivity', 'INTEGER', reshape(real(mesh%connectivity, wp), &
        [1, size(mesh%connectivity)]))
    call put('Offsets', 'INTEGER', reshape(real(mesh%offsets, wp), [1, size(mesh%offsets)]))
    call put('Types', 'BYTE', reshape(real(mesh%kind, wp), [1, size(mesh%kind)]))

  contains

    subroutine put(name, kind, values)
      character(*), intent(in) :: name, kind
      real(wp), intent(in) :: values(:, :)
      type(series_t) :: series
      call create_series(to%file, '/VTKHDF/'//name, kind, size(values, 1), &
          size(values, 1) == 1, max(1, size(values, 2)), max(1, size(values, 2)), &
          options%compression, series, status)
      call append_rows(to%file, series, values, status)
      call close_series(to%file, series, status)
    end subroutine put

  end subroutine write_mesh

  !> Adds a frame. When memory is full, the frames that it holds are written and their number
  !> follows: the file can then be read up to there whatever happens.
  subroutine add_frame(time, fields, to, status)
    real(wp), intent(in) :: time
    type(field_t), intent(in) :: fields(:)
    type(fields_file_t), intent(inout) :: to
    type(status_t), intent(inout) :: status
    logical :: full
    integer :: k
    call hold_rows(to%times, reshape([time], [1, 1]))
    full = to%times%held == to%times%room
    do k = 1, size(fields)
      if (fields(k)%constant .and. to%frames > 0) cycle
      call hold_rows(to%field(k), fields(k)%values)
      if (.not. fields(k)%constant) full = full .or. to%field(k)%held == to%field(k)%room
    end do
    to%frames = to%frames + 1
    if (full) call flush_frames(to, status)
  end subroutine add_frame

  !> Writes the frames that memory holds, as many as there is room for: that the others are lost
  !> is a failure. Room is looked for before, because the library does not recover from a write
  !> that fails half way.
  subroutine flush_frames(to, status)
    type(fields_file_t), intent(inout) :: to
    type(status_t), intent(inout) :: status
    integer :: n
    do while (to%kept < to%frames .and. .not. failed(status))
      n = frames_with_room(to)
      if (n > 0) then
        call write_frames(n, to, status)
      else
        call fail(status, status_file, 'cannot write "'//to%file%name//'" beyond its '// &
            to_text(to%kept)//' whole frames: '//disk_full, hint='a longer DT, PREC 32 or '// &
            'COMPR of *BIPACT_FIELD takes less')
      end if
    end do
    if (.not. failed(status)) return
    to%frames = to%kept
    to%field%held = 0
    to%times%held = 0
  end subroutine flush_frames

  !> How many of the frames in memory the file has room for on its disk.
  integer function frames_with_room(to) result(n)
    type(fields_file_t), intent(in) :: to
    integer :: too_many, middle
    n = to%frames - to%kept
    if (have_room(to, n)) return
    too_many = n
    n = 0
    do while (too_many - n > 1)
      middle = (n + too_many)/2
      if (have_room(to, middle)) then
        n = middle
      else
        too_many = middle
      end if
    end do
  end function frames_with_room

  !> Is there room for n more frames? Numbers take their bytes, but the file becomes longer by
  !> whole chunks (the last one on file may be there in part), and a compressed chunk is written
  !> anew when frames come to it. Lists and the trees by which HDF5 finds chunks come on top.
  logical function have_room(to, n)
    type(fields_file_t), intent(in) :: to
    integer, intent(in) :: n
    integer(i8) :: bytes, length
    integer :: k, sets, frames, chunks
    sets = 2*size(to%field) + size(lists) + 1
    bytes = sets*(8_i8*n + tree_bytes)
    length = sets*(8_i8*to%list_chunk + tree_bytes)
    do k = 1, size(to%field)
      frames = n
      if (to%rows(k) == 0) frames = merge(1, 0, to%kept == 0)
      chunks = (to%kept + frames + to%chunk_frames(k) - 1)/to%chunk_frames(k) - &
          to%kept/to%chunk_frames(k)
      bytes = bytes + to%chunk_bytes(k)/to%chunk_frames(k)*frames + chunks*entry_bytes
      length = length + chunks*(to%chunk_bytes(k) + entry_bytes)
    end do
    if (to%compressed) bytes = length
    have_room = can_grow(to%file%name, bytes, length)
  end function have_room

  !> Writes the first n frames in memory, and for each where it lies in the fields.
  subroutine write_frames(n, to, status)
    integer, intent(in) :: n
    type(fields_file_t), intent(inout) :: to
    type(status_t), intent(inout) :: status
    integer, parameter :: parts(5) = [0, 1, 0, 0, 0]
    integer :: k
    do k = 1, size(to%field)
      if (to%rows(k) == 0) call flush_series(to%file, to%field(k), status)
      if (to%rows(k) > 0) call flush_series(to%file, to%field(k), status, n*to%rows(k))
      call append_frames(n, to, to%offset(k), 0, to%rows(k), status)
    end do
    call flush_series(to%file, to%times, status, n)
    do k = 1, size(lists)
      call append_frames(n, to, to%list(k), parts(k), 0, status)
    end do
    if (failed(status)) return
    call write_attribute(to%count, int(to%kept + n, i8))
    call flush_file(to, status)
    if (.not. failed(status)) to%kept = to%kept + n
  end subroutine write_frames

  !> One entry for each of the next n frames: base + step times its number.
  subroutine append_frames(n, to, series, base, step, status)
    integer, intent(in) :: n
    type(fields_file_t), intent(in) :: to
    type(series_t), intent(inout) :: series
    integer, intent(in) :: base, step
    type(status_t), intent(inout) :: status
    real(wp) :: entry(1, n)
    integer :: k
    do k = 1, size(entry, 2)
      entry(1, k) = real(base, wp) + real(step, wp)*(to%kept + k - 1)
    end do
    call append_rows(to%file, series, entry, status)
    call flush_series(to%file, series, status)
  end subroutine append_frames

  subroutine flush_file(to, status)
    type(fields_file_t), intent(inout) :: to
    type(status_t), intent(inout) :: status
    integer :: error
    call h5fflush_f(to%file%id, h5f_scope_global_f, error)
    if (error < 0) call fail(status, status_file, 'cannot write "'//to%file%name//'"', &
        hint='is the disk full, the folder gone or closed?')
  end subroutine flush_file

  !> Ends the file; frames: how many it holds. One that has none, or cannot be opened because
  !> writing failed, is removed.
  subroutine close_fields(to, frames, status)
    type(fields_file_t), intent(inout) :: to
    integer, intent(out) :: frames
    type(status_t), intent(inout) :: status
    logical :: usable
    integer :: k
    frames = 0
    if (.not. to%is_open) return
    call flush_frames(to, status)
    do k = 1, size(to%field)
      call close_series(to%file, to%field(k), status)
      call close_series(to%file, to%offset(k), status)
    end do
    call close_series(to%file, to%times, status)
    do k = 1, size(lists)
      call close_series(to%file, to%list(k), status)
    end do
    call close_attribute(to%count)
    call close_file(to%file, status)
    to%is_open = .false.
    usable = to%kept > 0
    if (usable .and. failed(status)) usable = opens(to%file%name)
    if (usable) frames = to%kept
    if (.not. usable) call remove_file(to%file%name)
  end subroutine close_fields

end module store_fields
