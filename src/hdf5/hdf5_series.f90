! SPDX-License-Identifier: BSD-3-Clause
!> Data sets that grow: rows of a fixed number of components, gathered in memory and written a
!> chunk at a time; and attributes. The library's cache of chunks is off: what is written is
!> whole chunks.
module hdf5_series
  use, intrinsic :: iso_c_binding, only: c_loc, c_ptr
  use, intrinsic :: iso_fortran_env, only: real32
  use base_kinds, only: wp, i8
  use base_status, only: status_t, fail, failed, status_file
  use hdf5, only: hid_t, hsize_t, size_t, h5screate_f, h5screate_simple_f, h5sclose_f, &
      h5sselect_hyperslab_f, h5pcreate_f, h5pclose_f, h5pset_chunk_f, h5pset_deflate_f, &
      h5pset_shuffle_f, h5pset_fill_time_f, h5pset_chunk_cache_f, h5dcreate_f, h5dclose_f, &
      h5dset_extent_f, h5dget_space_f, h5dwrite_f, h5acreate_f, h5awrite_f, h5aclose_f, &
      h5tcopy_f, h5tset_size_f, h5tclose_f, h5kind_to_type, h5_integer_kind, h5_real_kind, &
      h5p_dataset_create_f, h5p_dataset_access_f, h5pset_virtual_f, h5d_fill_time_never_f, &
      h5s_unlimited_f, h5s_scalar_f, h5s_select_set_f, h5t_fortran_s1, h5t_std_u8le
  use hdf5_file, only: file_t
  implicit none
  private
  public :: create_series, create_view, append_rows, hold_rows, flush_series, close_series, &
      open_attribute, write_attribute, close_attribute, write_text_attribute, &
      write_list_attribute

  type, public :: series_t
    integer(hid_t) :: set = -1
    integer(hid_t) :: kind = -1         !< in memory
    integer :: components = 1
    integer(hsize_t) :: written = 0     !< rows on file
    integer :: held = 0                 !< rows in memory
    integer :: room = 0                 !< rows that memory holds, whole chunks
    integer :: rank = 2
    logical :: single = .false.
    logical :: whole = .false.          !< integers
    real(wp), allocatable :: reals(:, :)
    real(real32), allocatable :: singles(:, :)
    integer(i8), allocatable :: integers(:, :)
  end type series_t

contains

  !> A data set at path: kind is REAL, SINGLE, INTEGER or BYTE; (components, rows) in Fortran's
  !> order, or (rows) where `flat`. chunk: rows of a chunk on file; room: rows that are gathered
  !> in memory, a multiple of it; compression 0 to 9.
  subroutine create_series(file, path, kind, components, flat, chunk, room, compression, &
      series, status)
    type(file_t), intent(in) :: file
    character(*), intent(in) :: path, kind
    integer, intent(in) :: components, chunk, room, compression
    logical, intent(in) :: flat
    type(series_t), intent(out) :: series
    type(status_t), intent(inout) :: status
    integer(hid_t) :: space, creation, access, on_file
    integer(hsize_t) :: now(2), most(2), piece(2)
    integer :: rank, error, stat
    series%components = components
    series%room = room
    series%single = kind == 'SINGLE'
    series%whole = kind == 'INTEGER' .or. kind == 'BYTE'
    stat = 0
    if (series%single) then
      allocate (series%singles(components, room), stat=stat)
      series%kind = h5kind_to_type(real32, h5_real_kind)
    else if (series%whole) then
      allocate (series%integers(components, room), stat=stat)
      series%kind = h5kind_to_type(i8, h5_integer_kind)
    else
      allocate (series%reals(components, room), stat=stat)
      series%kind = h5kind_to_type(wp, h5_real_kind)
    end if
    if (stat /= 0) call fail(status, status_file, 'not enough memory to write "'// &
        file%name//'"')
    if (failed(status)) return
    on_file = series%kind
    if (kind == 'BYTE') on_file = h5t_std_u8le
    rank = merge(1, 2, flat)
    series%rank = rank
    now = [int(components, hsize_t), 0_hsize_t]
    most = [int(components, hsize_t), h5s_unlimited_f]
    piece = [components, chunk]
    call h5screate_simple_f(rank, now(3 - rank:), space, error, most(3 - rank:))
    call h5pcreate_f(h5p_dataset_create_f, creation, error)
    call h5pset_chunk_f(creation, rank, piece(3 - rank:), error)
    call h5pset_fill_time_f(creation, h5d_fill_time_never_f, error)
    if (compression > 0) call h5pset_shuffle_f(creation, error)
    if (compression > 0) call h5pset_deflate_f(creation, compression, error)
    call h5pcreate_f(h5p_dataset_access_f, access, error)
    call h5pset_chunk_cache_f(access, 1_size_t, 0_size_t, 1.0, error)
    call h5dcreate_f(file%id, path, on_file, space, series%set, error, creation, &
        dapl_id=access)
    if (error < 0) call cannot_write(file, status)
    call h5pclose_f(access, error)
    call h5pclose_f(creation, error)
    call h5sclose_f(space, error)
  end subroutine create_series

  !> A data set at path that shows the rows of a series, which is at `source`, with their
  !> components in another order: component k is number order(k) of the series. It grows with
  !> the series and has no numbers of its own (virtual data set of HDF5 1.10).
  subroutine create_view(file, path, series, source, order, status)
    type(file_t), intent(in) :: file
    character(*), intent(in) :: path, source
    type(series_t), intent(in) :: series
    integer, intent(in) :: order(:)
    type(status_t), intent(inout) :: status
    integer(hid_t) :: creation, view, from, set
    integer(hsize_t) :: now(2), most(2), start(2), column(2)
    integer :: k, error
    if (failed(status)) return
    now = [int(series%components, hsize_t), 0_hsize_t]
    most = [int(series%components, hsize_t), h5s_unlimited_f]
    column = [1_hsize_t, h5s_unlimited_f]
    call h5screate_simple_f(2, now, view, error, most)
    call h5screate_simple_f(2, now, from, error, most)
    call h5pcreate_f(h5p_dataset_create_f, creation, error)
    start = 0_hsize_t
    do k = 1, size(order)
      start(1) = int(k - 1, hsize_t)
      call h5sselect_hyperslab_f(view, h5s_select_set_f, start, column, error)
      start(1) = int(order(k) - 1, hsize_t)
      call h5sselect_hyperslab_f(from, h5s_select_set_f, start, column, error)
      call h5pset_virtual_f(creation, view, '.', source, from, error)
    end do
    call h5sclose_f(from, error)
    call h5sclose_f(view, error)
    call h5screate_simple_f(2, now, view, error, most)
    call h5dcreate_f(file%id, path, series%kind, view, set, error, creation)
    if (error < 0) call cannot_write(file, status)
    if (error >= 0) call h5dclose_f(set, error)
    call h5pclose_f(creation, error)
    call h5sclose_f(view, error)
  end subroutine create_view

  !> Adds rows (components, :); writes whenever memory is full.
  subroutine append_rows(file, series, rows, status)
    type(file_t), intent(in) :: file
    type(series_t), intent(inout), target :: series
    real(wp), intent(in), contiguous :: rows(:, :)
    type(status_t), intent(inout) :: status
    integer :: first, n
    first = 1
    do while (first <= size(rows, 2) .and. .not. failed(status))
      n = min(size(rows, 2) - first + 1, series%room - series%held)
      call hold_rows(series, rows(:, first:first + n - 1))
      first = first + n
      if (series%held == series%room) call flush_series(file, series, status)
    end do
  end subroutine append_rows

  !> Adds rows (components, :) in memory, where there is room for them.
  pure subroutine hold_rows(series, rows)
    type(series_t), intent(inout) :: series
    real(wp), intent(in), contiguous :: rows(:, :)
    integer :: n, at
    n = size(rows, 2)
    at = series%held
    if (series%single) then
      call round(series%components*n, rows, series%singles(:, at + 1:at + n))
    else if (series%whole) then
      series%integers(:, at + 1:at + n) = nint(rows, i8)
    else
      call copy(series%components*n, rows, series%reals(:, at + 1:at + n))
    end if
    series%held = at + n
  end subroutine hold_rows

  !> Columns side by side as one list: one copy instead of many of three numbers.
  pure subroutine copy(n, from, to)
    integer, intent(in) :: n
    real(wp), intent(in) :: from(n)
    real(wp), intent(out) :: to(n)
    to = from
  end subroutine copy

  pure subroutine round(n, from, to)
    integer, intent(in) :: n
    real(wp), intent(in) :: from(n)
    real(real32), intent(out) :: to(n)
    to = real(from, real32)
  end subroutine round

  !> Writes what is held in memory, or its first `rows`.
  subroutine flush_series(file, series, status, rows)
    type(file_t), intent(in) :: file
    type(series_t), intent(inout), target :: series
    type(status_t), intent(inout) :: status
    integer, intent(in), optional :: rows
    integer(hid_t) :: space, memory
    integer(hsize_t) :: total(2), start(2), count(2)
    type(c_ptr) :: place
    integer :: n, rank, error
    n = series%held
    if (present(rows)) n = min(n, rows)
    if (n == 0 .or. series%set < 0 .or. failed(status)) return
    count = [series%components, n]
    start = [0_hsize_t, series%written]
    total = [count(1), series%written + count(2)]
    if (series%single) then
      place = c_loc(series%singles)
    else if (series%whole) then
      place = c_loc(series%integers)
    else
      place = c_loc(series%reals)
    end if
    rank = series%rank
    call h5dset_extent_f(series%set, total(3 - rank:), error)
    if (error >= 0) then
      call h5dget_space_f(series%set, space, error)
      call h5sselect_hyperslab_f(space, h5s_select_set_f, start(3 - rank:), count(3 - rank:), &
          error)
      call h5screate_simple_f(rank, count(3 - rank:), memory, error)
      call h5dwrite_f(series%set, series%kind, place, error, memory, space)
      if (error < 0) call cannot_write(file, status)
      call h5sclose_f(memory, error)
      call h5sclose_f(space, error)
    else
      call cannot_write(file, status)
    end if
    series%written = total(2)
    call drop_first(n, series)
  end subroutine flush_series

  !> The first n rows in memory go, the rest comes to their place.
  pure subroutine drop_first(n, series)
    integer, intent(in) :: n
    type(series_t), intent(inout) :: series
    integer :: left
    left = series%held - n
    series%held = left
    if (left == 0) return
    if (series%single) then
      series%singles(:, :left) = series%singles(:, n + 1:n + left)
    else if (series%whole) then
      series%integers(:, :left) = series%integers(:, n + 1:n + left)
    else
      series%reals(:, :left) = series%reals(:, n + 1:n + left)
    end if
  end subroutine drop_first

  !> Writes the rest, closes, and gives the memory back.
  subroutine close_series(file, series, status)
    type(file_t), intent(in) :: file
    type(series_t), intent(inout), target :: series
    type(status_t), intent(inout) :: status
    integer :: error
    call flush_series(file, series, status)
    if (series%set >= 0) call h5dclose_f(series%set, error)
    series%set = -1
    if (allocated(series%reals)) deallocate (series%reals)
    if (allocated(series%singles)) deallocate (series%singles)
    if (allocated(series%integers)) deallocate (series%integers)
  end subroutine close_series

  !> An integer attribute that will change: made with a value, kept open.
  subroutine open_attribute(owner, name, value, attribute)
    integer(hid_t), intent(in) :: owner
    character(*), intent(in) :: name
    integer(i8), intent(in) :: value
    integer(hid_t), intent(out) :: attribute
    integer(hid_t) :: space
    integer :: error
    call h5screate_f(h5s_scalar_f, space, error)
    call h5acreate_f(owner, name, h5kind_to_type(i8, h5_integer_kind), space, attribute, error)
    call h5sclose_f(space, error)
    call write_attribute(attribute, value)
  end subroutine open_attribute

  !> Another value.
  subroutine write_attribute(attribute, value)
    integer(hid_t), intent(in) :: attribute
    integer(i8), intent(in) :: value
    integer(i8), target :: copy
    integer :: error
    copy = value
    call h5awrite_f(attribute, h5kind_to_type(i8, h5_integer_kind), c_loc(copy), error)
  end subroutine write_attribute

  !> The last value stays.
  subroutine close_attribute(attribute)
    integer(hid_t), intent(inout) :: attribute
    integer :: error
    call h5aclose_f(attribute, error)
    attribute = -1
  end subroutine close_attribute

  !> Text as an attribute of fixed length: the one kind that every version of VTK reads.
  subroutine write_text_attribute(owner, name, text)
    integer(hid_t), intent(in) :: owner
    character(*), intent(in) :: name
    character(*), intent(in), target :: text
    integer(hid_t) :: space, kind, attribute
    integer :: error
    call h5screate_f(h5s_scalar_f, space, error)
    call h5tcopy_f(h5t_fortran_s1, kind, error)
    call h5tset_size_f(kind, int(len(text), size_t), error)
    call h5acreate_f(owner, name, kind, space, attribute, error)
    call h5awrite_f(attribute, kind, c_loc(text), error)
    call h5aclose_f(attribute, error)
    call h5tclose_f(kind, error)
    call h5sclose_f(space, error)
  end subroutine write_text_attribute

  !> A list of integers as an attribute.
  subroutine write_list_attribute(owner, name, list)
    integer(hid_t), intent(in) :: owner
    character(*), intent(in) :: name
    integer(i8), intent(in), target :: list(:)
    integer(hid_t) :: space, attribute
    integer :: error
    call h5screate_simple_f(1, [int(size(list), hsize_t)], space, error)
    call h5acreate_f(owner, name, h5kind_to_type(i8, h5_integer_kind), space, attribute, error)
    call h5awrite_f(attribute, h5kind_to_type(i8, h5_integer_kind), c_loc(list), error)
    call h5aclose_f(attribute, error)
    call h5sclose_f(space, error)
  end subroutine write_list_attribute

  subroutine cannot_write(file, status)
    type(file_t), intent(in) :: file
    type(status_t), intent(inout) :: status
    call fail(status, status_file, 'cannot write "'//file%name//'"', &
        hint='is the disk full, the folder gone or closed?')
  end subroutine cannot_write

end module hdf5_series
