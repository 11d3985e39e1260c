! SPDX-License-Identifier: BSD-3-Clause
!> A table: header, rows of constant width, a closing line. Rows are collected and written many
!> at a time, always whole.
module output_table
  use base_files, only: file_exists, file_size, cut_file
  use base_format, only: real_writer_t, real_width, put_real, put_integer
  use base_kinds, only: wp, zero, i8
  use base_status, only: status_t, fail, status_file
  use base_strings, only: join_path, to_text
  use base_version, only: version
  implicit none
  private
  integer, parameter :: buffer_size = 32768
  integer, parameter :: integer_width = 11

  type, public :: table_file_t
    logical :: on = .false.
    real(wp) :: interval = zero   !< [T]
    real(wp) :: next = zero       !< rows are due from next*interval on (a whole number)
    integer :: no_row_at = -1     !< step whose values are not known where a run goes on
    integer :: unit = -1
    integer :: filled = 0
    integer(i8) :: written = 0_i8 !< bytes on file
    integer(i8) :: whole = 0_i8   !< those before the last of them: whole rows
    character(:), allocatable :: path
    character(:), allocatable :: buffer
  end type table_file_t

  public :: open_table, row_is_due, rows_done, next_due, begin_row, add_number, add_count, &
      end_row, close_table, write_out, reopen_table, check_rows

contains

  !> Opens NAME.tab in a folder when its interval is not zero, and writes its header.
  subroutine open_table(table, folder, name, interval, title, columns, status)
    type(table_file_t), intent(inout) :: table
    character(*), intent(in) :: folder, name, title, columns
    real(wp), intent(in) :: interval
    type(status_t), intent(inout) :: status
    character(200) :: reason
    integer :: ios
    table%on = interval > zero
    table%interval = interval
    table%path = join_path(folder, name//'.tab')
    if (.not. table%on) then
      call remove_old(table%path)
      return
    end if
    allocate (character(buffer_size) :: table%buffer)
    open (newunit=table%unit, file=table%path, access='stream', form='unformatted', &
        status='replace', action='write', iostat=ios, iomsg=reason)
    if (ios /= 0) then
      call fail(status, status_file, 'cannot write "'//table%path//'": '//trim(reason))
      table%on = .false.
      return
    end if
    call add_line(table, '# '//name//': '//trim(title))
    call add_line(table, '# bipact '//version//'; units as in the deck')
    call add_line(table, '# '//columns)
  end subroutine open_table

  !> Fails where a table does not have the table%written bytes any more that it had (0: it
  !> begins).
  subroutine check_rows(table, folder, name, interval, status)
    type(table_file_t), intent(in) :: table
    character(*), intent(in) :: folder, name
    real(wp), intent(in) :: interval
    type(status_t), intent(inout) :: status
    character(:), allocatable :: path
    path = join_path(folder, name//'.tab')
    if (.not. interval > zero .or. table%written == 0_i8) return
    if (file_size(path) < table%written) call fail(status, status_file, &
        'cannot go on with "'//path//'": it has lost rows that it had when the restart '// &
        'file was written')
  end subroutine check_rows

  !> Opens a table of which the first table%written bytes are kept, to add rows to them.
  subroutine reopen_table(table, folder, name, interval, status)
    type(table_file_t), intent(inout) :: table
    character(*), intent(in) :: folder, name
    real(wp), intent(in) :: interval
    type(status_t), intent(inout) :: status
    character(200) :: reason
    integer :: ios
    table%on = interval > zero
    table%interval = interval
    table%path = join_path(folder, name//'.tab')
    if (.not. table%on) return
    call cut_file(table%path, table%written, status)
    allocate (character(buffer_size) :: table%buffer)
    open (newunit=table%unit, file=table%path, access='stream', form='unformatted', &
        status='old', position='append', action='write', iostat=ios, iomsg=reason)
    if (ios == 0) return
    call fail(status, status_file, 'cannot write "'//table%path//'": '//trim(reason))
    table%on = .false.
  end subroutine reopen_table

  !> A table of an earlier run must not pass for one of this run.
  subroutine remove_old(path)
    character(*), intent(in) :: path
    logical :: there
    integer :: unit, ios
    inquire (file=path, exist=there)
    if (.not. there) return
    open (newunit=unit, file=path, iostat=ios)
    if (ios == 0) close (unit, status='delete', iostat=ios)
  end subroutine remove_old

  !> True when a row is due: the first step end with t >= k DT - 1e-9 dt, and always at t = 0.
  logical function row_is_due(table, time, h)
    type(table_file_t), intent(in) :: table
    real(wp), intent(in) :: time, h
    row_is_due = table%on
    if (row_is_due) row_is_due = time >= table%next*table%interval - 1.0e-9_wp*h
  end function row_is_due

  !> Sets when the next row is due after those of a time, which may have been none.
  subroutine rows_done(table, time, h)
    type(table_file_t), intent(inout) :: table
    real(wp), intent(in) :: time, h
    table%next = next_due(table%interval, time, h)
  end subroutine rows_done

  !> The multiple of the interval from which something is due next that was due at a time, or at
  !> none since its last multiple.
  pure real(wp) function next_due(interval, time, h)
    real(wp), intent(in) :: interval, time, h
    next_due = zero               ! every step; the quotient might overflow
    if (interval > 1.0e-6_wp*h) next_due = aint((time + 1.0e-9_wp*h)/interval) + 1.0_wp
  end function next_due

  !> Starts a row.
  subroutine begin_row(table, status)
    type(table_file_t), intent(inout) :: table
    type(status_t), intent(inout) :: status
    if (table%filled + 1024 > buffer_size) call write_out(table, status)
  end subroutine begin_row

  !> Adds a real number to the row.
  subroutine add_number(table, writer, number)
    type(table_file_t), intent(inout) :: table
    type(real_writer_t), intent(in) :: writer
    real(wp), intent(in) :: number
    associate (at => table%filled)
      table%buffer(at + 1:at + 1) = ' '
      call put_real(writer, number, table%buffer(at + 2:at + 1 + real_width))
      at = at + 1 + real_width
    end associate
  end subroutine add_number

  !> Adds an integer to the row.
  subroutine add_count(table, number)
    type(table_file_t), intent(inout) :: table
    integer, intent(in) :: number
    associate (at => table%filled)
      call put_integer(number, table%buffer(at + 1:at + integer_width))
      at = at + integer_width
    end associate
  end subroutine add_count

  !> Ends the row.
  subroutine end_row(table)
    type(table_file_t), intent(inout) :: table
    table%filled = table%filled + 1
    table%buffer(table%filled:table%filled) = new_line('a')
  end subroutine end_row

  subroutine add_line(table, line)
    type(table_file_t), intent(inout) :: table
    character(*), intent(in) :: line
    table%buffer(table%filled + 1:table%filled + len(line)) = line
    table%filled = table%filled + len(line)
    call end_row(table)
  end subroutine add_line

  !> Writes the rows that are held; what did not get to the file whole is taken back.
  subroutine write_out(table, status)
    type(table_file_t), intent(inout) :: table
    type(status_t), intent(inout) :: status
    character(200) :: reason
    integer(i8) :: there
    integer :: ios
    write (table%unit, iostat=ios, iomsg=reason) table%buffer(1:table%filled)
    if (ios == 0) flush (table%unit, iostat=ios, iomsg=reason)
    table%whole = table%written
    table%written = table%written + table%filled
    table%filled = 0
    if (ios == 0) then
      there = file_size(table%path)
      if (there >= 0_i8 .and. there < table%written) ios = 1
      reason = 'is the disk full?'
    end if
    if (ios == 0) return
    call fail(status, status_file, 'cannot write "'//table%path//'": '//trim(reason))
    table%on = .false.
    close (table%unit, iostat=ios)
    call cut_file(table%path, table%whole, status)
  end subroutine write_out

  !> Writes what is left and the closing line "# end: done | failed | stopped, cycle N".
  subroutine close_table(table, ending, cycle, status)
    type(table_file_t), intent(inout) :: table
    character(*), intent(in) :: ending
    integer, intent(in) :: cycle
    type(status_t), intent(inout) :: status
    if (.not. table%on) return
    if (table%filled + 256 > buffer_size) call write_out(table, status)
    call add_line(table, '# end: '//ending//', cycle '//to_text(cycle))
    call write_out(table, status)
    if (.not. table%on) return
    close (table%unit)
    table%on = .false.
    if (.not. file_exists(table%path)) call fail(status, status_file, '"'//table%path// &
        '" was removed while the run wrote it')
  end subroutine close_table

end module output_table
