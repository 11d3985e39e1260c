! SPDX-License-Identifier: BSD-3-Clause
!> Restart files: HDF5 with the deck as understood and one data set for each array of the
!> archive, after 512 bytes of text that name the format, the hash of the deck, the moment, and
!> the length and checksum of all that follows. A file that does not agree with them never comes
!> before the library.
module store_restart
  use base_archive, only: archive_t, archive_restore, archive_save
  use base_checksum, only: checksum_of_file, checksum_of_text, checksum_of_words
  use base_files, only: file_exists, file_size, sync_file
  use base_kinds, only: wp, i4, i8
  use base_status, only: status_t, fail, failed, status_file
  use base_strings, only: to_text
  use hdf5_file, only: file_t, create_in_memory, take_image, open_file, close_file, &
      make_group, write_reals, read_reals, write_text, read_text, list_members
  use hdf5_series, only: write_text_attribute
  use output_storage, only: restart_header_t
  implicit none
  private
  public :: write_restart_file, read_restart_file

  integer, parameter :: free = 512, format_number = 4, head = 400
  character(*), parameter :: magic = 'bipact restart'

contains

  !> A whole file at path, on the disk. It is made in memory: one stroke of writing, and the
  !> checksum without reading it again. The archive is empty afterwards.
  subroutine write_restart_file(path, header, archive, status)
    character(*), intent(in) :: path
    type(restart_header_t), intent(in) :: header
    type(archive_t), intent(inout) :: archive
    type(status_t), intent(inout) :: status
    type(file_t) :: file
    integer(i4), allocatable :: image(:)
    character(8) :: number
    integer :: k
    call create_in_memory(path, file, status)
    if (failed(status)) return
    call write_text_attribute(file%id, 'version', header%version)
    call write_text_attribute(file%id, 'deck', header%deck_hash)
    call write_reals(file, '/time', [header%time], status)
    call write_text(file, '/deck', header%echo, status)
    call make_group(file, '/archive', status)
    do k = 1, archive%n
      write (number, '(i8.8)') k
      call write_reals(file, '/archive/'//number//' '//trim(archive%entry(k)%name), &
          archive%entry(k)%values, status)
      deallocate (archive%entry(k)%values)   ! else a large state would be there three times
    end do
    call take_image(file, image, status)
    if (.not. failed(status)) call write_image(path, header, image, status)
    if (.not. failed(status)) call sync_file(path, status)
  end subroutine write_restart_file

  !> The text in front, and the HDF5 file behind it.
  subroutine write_image(path, header, image, status)
    character(*), intent(in) :: path
    type(restart_header_t), intent(in) :: header
    integer(i4), intent(in) :: image(:)
    type(status_t), intent(inout) :: status
    character(free) :: text
    character(200) :: reason
    integer(i8) :: bytes, there
    integer :: unit, ios
    bytes = 4_i8*size(image, kind=i8)
    write (text, '(a,a,i4,a,a16,a,i12,a,es24.16e3,a,i18,a,a16,2a)') magic, ' format ', &
        format_number, ' deck ', header%deck_hash, ' cycle ', header%cycle, ' time ', &
        header%time, ' bytes ', bytes, ' checksum ', checksum_of_words(image), ' version ', &
        header%version
    text(head + 1:head + 16) = checksum_of_text(text(:head))
    text(free:) = new_line('a')
    open (newunit=unit, file=path, access='stream', form='unformatted', status='replace', &
        action='write', iostat=ios, iomsg=reason)
    if (ios == 0) then
      write (unit, iostat=ios, iomsg=reason) text, image
      close (unit)
      ! What a full disk has refused is seen nowhere else.
      there = file_size(path)
      if (ios == 0 .and. there /= free + bytes) reason = 'is the disk full?'
      if (there /= free + bytes) ios = 1
    end if
    if (ios /= 0) &
        call fail(status, status_file, 'cannot write "'//path//'": '//trim(reason))
  end subroutine write_image

  !> Reads a file into header and archive; fails with what is wrong with it.
  subroutine read_restart_file(path, header, archive, status)
    character(*), intent(in) :: path
    type(restart_header_t), intent(out) :: header
    type(archive_t), intent(inout) :: archive
    type(status_t), intent(inout) :: status
    type(file_t) :: file
    character(64), allocatable :: names(:)
    real(wp), allocatable :: values(:)
    integer :: k
    call read_head(path, header, status)
    if (failed(status)) return
    call open_file(path, file, status)
    if (failed(status)) return
    call read_text(file, '/deck', header%echo, status)
    call archive%rewind(archive_save)
    call list_members(file, '/archive', names)
    do k = 1, size(names)
      call read_reals(file, '/archive/'//trim(names(k)), values, status)
      call archive%exchange(trim(names(k)(10:)), values)
    end do
    call close_file(file)
    call archive%rewind(archive_restore)
  end subroutine read_restart_file

  !> The first bytes, and whether the rest agrees with them.
  subroutine read_head(path, header, status)
    character(*), intent(in) :: path
    type(restart_header_t), intent(inout) :: header
    type(status_t), intent(inout) :: status
    character(free) :: text
    character(16) :: digits, found
    character(32) :: word
    integer(i8) :: bytes, there
    integer :: unit, ios, number
    if (.not. file_exists(path)) then
      call fail(status, status_file, 'cannot restart from "'//path//'": no such file')
      return
    end if
    text = ''
    open (newunit=unit, file=path, access='stream', form='unformatted', status='old', &
        action='read', iostat=ios)
    if (ios == 0) read (unit, iostat=ios) text
    close (unit)
    if (text(:len(magic)) /= magic) then
      call refuse(path, 'it is no restart file of bipact', status)
      return
    end if
    if (text(head + 1:head + 16) /= checksum_of_text(text(:head)) .or. &
        text(head + 17:free - 1) /= '' .or. text(free:) /= new_line('a') .or. ios /= 0) then
      call refuse(path, 'its first bytes are damaged', status)
      return
    end if
    read (text(len(magic) + 9:), '(i4)') number
    if (number /= format_number) then
      call refuse(path, 'its format is '//to_text(number)//', this program reads format '// &
          to_text(format_number), status)
      return
    end if
    read (text(len(magic) + 13:), '(6x,a16,7x,i12,6x,es24.16,7x,i18,10x,a16,9x,a)') &
        header%deck_hash, header%cycle, header%time, bytes, digits, word
    header%version = trim(word)
    call checksum_of_file(path, free, found, there, status)
    if (there /= bytes) call refuse(path, 'it holds '//to_text(there)//' bytes where '// &
        to_text(bytes)//' were written: it was cut off or added to', status)
    if (found /= digits) call refuse(path, 'it is damaged: its checksum is not that of its '// &
        'contents', status)
  end subroutine read_head

  subroutine refuse(path, reason, status)
    character(*), intent(in) :: path, reason
    type(status_t), intent(inout) :: status
    call fail(status, status_file, 'cannot restart from "'//path//'": '//reason, &
        hint='--restart latest takes the newest good file of the folder')
  end subroutine refuse

end module store_restart
