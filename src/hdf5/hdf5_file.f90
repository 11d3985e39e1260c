! SPDX-License-Identifier: BSD-3-Clause
!> Reading and writing plain arrays of an HDF5 file by path; failures say which path.
module hdf5_file
  use, intrinsic :: iso_c_binding, only: c_loc, c_null_ptr, c_ptr
  use base_kinds, only: wp, i4
  use base_status, only: status_t, fail, failed, status_deck, status_file
  use base_strings, only: to_text
  use hdf5, only: hid_t, hsize_t, size_t, h5dont_atexit_f, h5open_f, h5fopen_f, &
      h5fcreate_f, h5fclose_f, h5fflush_f, h5fget_file_image_f, h5f_acc_rdonly_f, &
      h5f_acc_trunc_f, h5f_scope_global_f, h5eset_auto_f, h5lexists_f, h5dopen_f, h5dclose_f, &
      h5dget_space_f, h5sget_simple_extent_npoints_f, h5sclose_f, h5dread_f, h5dwrite_f, &
      h5dcreate_f, h5screate_simple_f, h5gcreate_f, h5gclose_f, h5t_native_integer, &
      h5t_native_double, h5pcreate_f, h5pclose_f, h5pset_fapl_core_f, h5p_file_access_f, &
      h5gn_members_f, h5gget_obj_info_idx_f, h5t_std_u8le
  implicit none
  private
  public :: start_library, open_file, create_file, create_in_memory, take_image, close_file, &
      opens, has_path, read_integers, read_reals, make_group, write_integers, write_reals, &
      list_members, write_text, read_text

  type, public :: file_t
    integer(hid_t) :: id = -1
    logical :: in_memory = .false.
    character(:), allocatable :: name
  end type file_t

contains

  !> Opens an HDF5 file for reading; fails with the reason.
  subroutine open_file(name, file, status)
    character(*), intent(in) :: name
    type(file_t), intent(out) :: file
    type(status_t), intent(inout) :: status
    integer :: error
    logical :: there
    file%name = name
    inquire (file=name, exist=there)
    if (.not. there) then
      call fail(status, status_file, 'cannot read "'//name//'": no such file')
      return
    end if
    call h5fopen_f(name, h5f_acc_rdonly_f, file%id, error)
    if (error < 0) call fail(status, status_file, 'cannot read "'//name// &
        '": it is no HDF5 file, or a part of one')
  end subroutine open_file

  !> Creates an HDF5 file; one of that name is replaced.
  subroutine create_file(name, file, status)
    character(*), intent(in) :: name
    type(file_t), intent(out) :: file
    type(status_t), intent(inout) :: status
    integer :: error
    file%name = name
    call h5fcreate_f(name, h5f_acc_trunc_f, file%id, error)
    if (error < 0) call fail(status, status_file, 'cannot write "'//name//'"', &
        hint='is the folder there and writable?')
  end subroutine create_file

  !> Begins an HDF5 file that stays in memory until take_image; `name` is for messages alone.
  subroutine create_in_memory(name, file, status)
    character(*), intent(in) :: name
    type(file_t), intent(out) :: file
    type(status_t), intent(inout) :: status
    integer(size_t), parameter :: growth = 65536_size_t
    integer(hid_t) :: access
    integer :: error
    file%name = name
    call h5pcreate_f(h5p_file_access_f, access, error)
    call h5pset_fapl_core_f(access, growth, .false., error)
    call h5fcreate_f(name, h5f_acc_trunc_f, file%id, error, access_prp=access)
    file%in_memory = .true.
    if (error < 0) call cannot_write(file, status)
    call h5pclose_f(access, error)
  end subroutine create_in_memory

  !> All bytes of a file in memory, with zeros up to a whole word; the file ends.
  subroutine take_image(file, image, status)
    type(file_t), intent(inout) :: file
    integer(i4), allocatable, target, intent(out) :: image(:)
    type(status_t), intent(inout) :: status
    integer(size_t) :: bytes
    integer :: error, stat
    type(c_ptr) :: place
    bytes = 0_size_t
    place = c_null_ptr
    call h5fflush_f(file%id, h5f_scope_global_f, error)
    if (error >= 0) call h5fget_file_image_f(file%id, place, 0_size_t, error, bytes)
    allocate (image((bytes + 3_size_t)/4_size_t), source=0_i4, stat=stat)
    if (stat /= 0) then
      allocate (image(0))
      error = -1
    end if
    place = c_loc(image)
    if (error >= 0) call h5fget_file_image_f(file%id, place, bytes, error)
    if (error < 0) call cannot_write(file, status)
    call close_file(file, status)
  end subroutine take_image

  !> Once, before all else: again it would make all its types again. Errors become statuses.
  subroutine start_library()
    integer :: error
    ! Its own end of a program would write once more to what could not be written, and crash.
    call h5dont_atexit_f(error)
    call h5open_f(error)
    call h5eset_auto_f(0, error)
  end subroutine start_library

  !> Closes the file. What the library could not bring to it is a failure, where a status is
  !> given.
  subroutine close_file(file, status)
    type(file_t), intent(inout) :: file
    type(status_t), intent(inout), optional :: status
    integer :: error
    error = 0
    if (file%id >= 0) call h5fclose_f(file%id, error)
    if (error < 0 .and. present(status)) call fail(status, status_file, 'cannot write "'// &
        file%name//'" to its end', hint='is the disk full or gone?')
    file%id = -1
  end subroutine close_file

  subroutine cannot_write(file, status)
    type(file_t), intent(in) :: file
    type(status_t), intent(inout) :: status
    if (file%in_memory) then
      call fail(status, status_file, 'not enough memory to write "'//file%name//'"')
    else
      call fail(status, status_file, 'cannot write "'//file%name//'"')
    end if
  end subroutine cannot_write

  !> Can the library open a file?
  logical function opens(name)
    character(*), intent(in) :: name
    integer(hid_t) :: id
    integer :: error
    call h5fopen_f(name, h5f_acc_rdonly_f, id, error)
    opens = error >= 0
    if (opens) call h5fclose_f(id, error)
  end function opens

  !> Names of what a group holds, in increasing order.
  subroutine list_members(file, group, names)
    type(file_t), intent(in) :: file
    character(*), intent(in) :: group
    character(64), allocatable, intent(out) :: names(:)
    integer :: n, k, kind, error
    call h5gn_members_f(file%id, group, n, error)
    if (error < 0) n = 0
    allocate (names(n))
    do k = 1, n
      names(k) = ''
      call h5gget_obj_info_idx_f(file%id, group, k - 1, names(k), kind, error)
    end do
  end subroutine list_members

  !> Is there something of this path, each part of it?
  logical function has_path(file, path)
    type(file_t), intent(in) :: file
    character(*), intent(in) :: path
    integer :: error, cut
    has_path = .true.
    cut = 1
    do while (has_path .and. cut <= len(path))
      cut = index(path(cut + 1:)//'/', '/') + cut
      call h5lexists_f(file%id, path(:cut - 1), has_path, error)
      has_path = has_path .and. error >= 0
      if (cut > len(path)) exit
    end do
  end function has_path

  !> Opens a data set; n = its number of values.
  subroutine open_set(file, path, set, n, status)
    type(file_t), intent(in) :: file
    character(*), intent(in) :: path
    integer(hid_t), intent(out) :: set
    integer(hsize_t), intent(out) :: n
    type(status_t), intent(inout) :: status
    integer(hid_t) :: space
    integer :: error
    space = -1
    n = 0
    set = -1
    if (.not. has_path(file, path)) then
      call fail(status, status_deck, file%name//': '//path//' is missing')
      return
    end if
    call h5dopen_f(file%id, path, set, error)
    if (error >= 0) call h5dget_space_f(set, space, error)
    ! An empty set is no fault, though the library says so.
    if (error >= 0) call h5sget_simple_extent_npoints_f(space, n, error)
    if (n == 0 .and. space >= 0) error = 0
    if (error < 0) then
      call fail(status, status_deck, file%name//': '//path//' is no array of numbers')
      return
    end if
    call h5sclose_f(space, error)
  end subroutine open_set

  !> All integers of a data set; at least `least` of them must be there.
  subroutine read_integers(file, path, values, status, least)
    type(file_t), intent(in) :: file
    character(*), intent(in) :: path
    integer, allocatable, intent(out) :: values(:)
    type(status_t), intent(inout) :: status
    integer, intent(in), optional :: least
    integer(hid_t) :: set
    integer(hsize_t) :: n
    integer :: error
    allocate (values(0))
    if (failed(status)) return
    call open_set(file, path, set, n, status)
    if (failed(status)) return
    deallocate (values)
    allocate (values(n))
    call h5dread_f(set, h5t_native_integer, values, [n], error)
    if (error < 0) call fail(status, status_file, file%name//': '//path//' cannot be read')
    call h5dclose_f(set, error)
    if (present(least)) call ask_length(file, path, int(n), least, status)
  end subroutine read_integers

  !> All reals of a data set; at least `least` of them must be there.
  subroutine read_reals(file, path, values, status, least)
    type(file_t), intent(in) :: file
    character(*), intent(in) :: path
    real(wp), allocatable, intent(out) :: values(:)
    type(status_t), intent(inout) :: status
    integer, intent(in), optional :: least
    integer(hid_t) :: set
    integer(hsize_t) :: n
    integer :: error
    allocate (values(0))
    if (failed(status)) return
    call open_set(file, path, set, n, status)
    if (failed(status)) return
    deallocate (values)
    allocate (values(n))
    call h5dread_f(set, h5t_native_double, values, [n], error)
    if (error < 0) call fail(status, status_file, file%name//': '//path//' cannot be read')
    call h5dclose_f(set, error)
    if (present(least)) call ask_length(file, path, int(n), least, status)
  end subroutine read_reals

  subroutine ask_length(file, path, n, least, status)
    type(file_t), intent(in) :: file
    character(*), intent(in) :: path
    integer, intent(in) :: n, least
    type(status_t), intent(inout) :: status
    if (n < least) call fail(status, status_deck, file%name//': '//path//' holds '// &
        to_text(n)//' values, '//to_text(least)//' are needed')
  end subroutine ask_length

  !> Makes a group; fails when the file cannot be written.
  subroutine make_group(file, path, status)
    type(file_t), intent(in) :: file
    character(*), intent(in) :: path
    type(status_t), intent(inout) :: status
    integer(hid_t) :: group
    integer :: error
    call h5gcreate_f(file%id, path, group, error)
    if (error < 0) call cannot_write(file, status)
    if (error >= 0) call h5gclose_f(group, error)
  end subroutine make_group

  !> Writes an array of reals as a new data set.
  subroutine write_reals(file, path, values, status)
    type(file_t), intent(in) :: file
    character(*), intent(in) :: path
    real(wp), intent(in) :: values(:)
    type(status_t), intent(inout) :: status
    integer(hid_t) :: set, space
    integer(hsize_t) :: n(1)
    integer :: error
    if (failed(status)) return
    n = size(values)
    call h5screate_simple_f(1, n, space, error)
    call h5dcreate_f(file%id, path, h5t_native_double, space, set, error)
    if (error >= 0) call h5dwrite_f(set, h5t_native_double, values, n, error)
    if (error < 0) call cannot_write(file, status)
    call h5dclose_f(set, error)
    call h5sclose_f(space, error)
  end subroutine write_reals

  !> Writes a text as a new data set of bytes.
  subroutine write_text(file, path, text, status)
    type(file_t), intent(in) :: file
    character(*), intent(in) :: path
    character(*), intent(in), target :: text
    type(status_t), intent(inout) :: status
    integer(hid_t) :: set, space
    integer(hsize_t) :: n(1)
    integer :: error
    if (failed(status)) return
    n = len(text, hsize_t)
    call h5screate_simple_f(1, n, space, error)
    call h5dcreate_f(file%id, path, h5t_std_u8le, space, set, error)
    if (error >= 0) call h5dwrite_f(set, h5t_std_u8le, c_loc(text), error)
    if (error < 0) call cannot_write(file, status)
    call h5dclose_f(set, error)
    call h5sclose_f(space, error)
  end subroutine write_text

  !> All bytes of a data set as a text.
  subroutine read_text(file, path, text, status)
    type(file_t), intent(in) :: file
    character(*), intent(in) :: path
    character(:), allocatable, target, intent(out) :: text
    type(status_t), intent(inout) :: status
    integer(hid_t) :: set
    integer(hsize_t) :: n
    integer :: error
    type(c_ptr) :: place
    text = ''
    if (failed(status)) return
    call open_set(file, path, set, n, status)
    if (failed(status)) return
    deallocate (text)
    allocate (character(n) :: text)
    place = c_loc(text)
    call h5dread_f(set, h5t_std_u8le, place, error)
    if (error < 0) call fail(status, status_file, file%name//': '//path//' cannot be read')
    call h5dclose_f(set, error)
  end subroutine read_text

  !> Writes an array of integers as a new data set.
  subroutine write_integers(file, path, values, status)
    type(file_t), intent(in) :: file
    character(*), intent(in) :: path
    integer, intent(in) :: values(:)
    type(status_t), intent(inout) :: status
    integer(hid_t) :: set, space
    integer(hsize_t) :: n(1)
    integer :: error
    if (failed(status)) return
    n = size(values)
    call h5screate_simple_f(1, n, space, error)
    call h5dcreate_f(file%id, path, h5t_native_integer, space, set, error)
    if (error >= 0) call h5dwrite_f(set, h5t_native_integer, values, n, error)
    if (error < 0) call cannot_write(file, status)
    call h5dclose_f(set, error)
    call h5sclose_f(space, error)
  end subroutine write_integers

end module hdf5_file
