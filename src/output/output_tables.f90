! SPDX-License-Identifier: BSD-3-Clause
!> The set of tables of a run: which are on, their columns (doc/output.md), when rows are due.
module output_tables
  use base_archive, only: archive_t
  use base_format, only: real_writer_t, make_real_writer
  use base_messages, only: messages_t, add_message
  use base_kinds, only: wp, zero, i8
  use base_status, only: status_t, failed
  use base_strings, only: upper
  use deck_names, only: table_names, table_count, table_glstat, table_matsum, table_nodout, &
      table_elout, table_rcforc, table_rwforc, table_sleout, table_spcforc, table_ncforc, &
      table_timing, table_rbdout
  use model_data, only: model_t
  use output_history, only: history_t, make_history
  use output_table, only: table_file_t, open_table, row_is_due, next_due, add_number, &
      close_table, reopen_table, check_rows, write_out
  implicit none
  private

  type, public :: tables_t
    type(table_file_t) :: file(table_count)
    type(real_writer_t) :: writer
    type(history_t) :: history       !< only with ELOUT
    logical :: any_on = .false.
  end type tables_t

  public :: flush_tables, exchange_tables, retime_tables, check_tables
  public :: flows, open_tables, any_due, energies_due, close_tables, add_numbers, &
      add_vector

contains

  !> Does a part flow? GLSTAT has its work then.
  pure logical function flows(model)
    type(model_t), intent(in) :: model
    integer :: p
    flows = .false.
    if (.not. model%controls%is_finite) return
    do p = 1, size(model%part)
      flows = flows .or. model%material(model%part(p)%material)%item%work_state > 0
    end do
  end function flows

  !> Opens the tables that the deck asks for; again: keeps the rows of the run that goes on,
  !> where it has some.
  subroutine open_tables(tables, model, folder, has_acceleration, again, status)
    type(tables_t), intent(inout) :: tables
    type(model_t), intent(in) :: model
    character(*), intent(in) :: folder
    logical, intent(in) :: has_acceleration, again
    type(status_t), intent(inout) :: status
    character(:), allocatable :: more, lost
    more = ''
    lost = ''
    if (flows(model)) lost = ' plastic'
    if (has_acceleration) more = ' ax ay az'
    call open_one(table_glstat, 'time cycle dt kinetic internal total '// &
        'initial external motion friction contact unsolved algorithmic damping '// &
        'residual ratio momx momy momz angx angy angz'//lost)
    call open_one(table_matsum, 'time part mass kinetic internal momx momy momz vx vy vz')
    call open_one(table_nodout, 'time node ux uy uz vx vy vz vmx vmy vmz x y z'//more)
    call open_one(table_elout, 'time element part sxx syy szz sxy syz szx energy')
    call open_one(table_rcforc, 'time contact side fx fy fz fmx '// &
        'fmy fmz ix iy iz fn ft nactive nstick nslip gapmin')
    call open_one(table_rwforc, 'time wall fx fy fz fmx fmy fmz '// &
        'ix iy iz fn ft nactive nstick nslip gapmin')
    call open_one(table_sleout, 'time contact normalwork frictionwork '// &
        'solves sweeps eta error error2018 penetration')
    call open_one(table_spcforc, 'time node fx fy fz')
    call open_one(table_ncforc, &
        'time contact side node fx fy fz fmx fmy fmz pressure gap slip status')
    call open_one(table_rbdout, &
        'time part mass x y z ux uy uz vx vy vz rx ry rz wx wy wz')
    call open_one(table_timing, 'time cycle cpu input assemble factor '// &
        'solve search contact output factors solves sweeps')
    tables%any_on = any(tables%file%on)
    if (tables%any_on) call make_real_writer(tables%writer)
    if (tables%file(table_elout)%on) call make_history(model, tables%history)

  contains

    subroutine open_one(k, columns)
      integer, intent(in) :: k
      character(*), intent(in) :: columns
      if (failed(status)) return
      if (again .and. tables%file(k)%written > 0_i8) then
        call reopen_table(tables%file(k), folder, trim(table_names(k)), &
            model%requests%interval(k), status)
      else
        call open_table(tables%file(k), folder, trim(table_names(k)), &
            model%requests%interval(k), model%title, columns, status)
      end if
    end subroutine open_one

  end subroutine open_tables

  !> Where tables of a run that goes on have other intervals than before, their next rows are
  !> due as if they had had them from the start. told [T]: up to where rows were written,
  !> negative for none; h: length of a step. Tables that begin or end are noted.
  subroutine retime_tables(tables, model, told, h, notes)
    type(tables_t), intent(inout) :: tables
    type(model_t), intent(in) :: model
    real(wp), intent(in) :: told, h
    type(messages_t), intent(inout) :: notes
    character(:), allocatable :: name
    integer :: k
    do k = 1, table_count
      associate (file => tables%file(k), interval => model%requests%interval(k))
        if (.not. abs(interval - file%interval) > zero) cycle
        name = 'restart: table '//upper(trim(table_names(k)))
        if (.not. interval > zero) then
          call add_message(notes, '', name//' ends here: the deck does not ask for it any more')
        else if (file%written == 0_i8) then
          call add_message(notes, '', name//' begins here: the run so far had none')
        end if
        file%next = zero
        if (told >= zero) file%next = next_due(interval, told, h)
      end associate
    end do
  end subroutine retime_tables

  !> Fails where a table has not all rows any more that a run which is to go on had written.
  subroutine check_tables(tables, model, folder, status)
    type(tables_t), intent(in) :: tables
    type(model_t), intent(in) :: model
    character(*), intent(in) :: folder
    type(status_t), intent(inout) :: status
    integer :: k
    do k = 1, table_count
      if (.not. failed(status)) call check_rows(tables%file(k), folder, &
          trim(table_names(k)), model%requests%interval(k), status)
    end do
  end subroutine check_tables

  !> Brings all rows to the files.
  subroutine flush_tables(tables, status)
    type(tables_t), intent(inout) :: tables
    type(status_t), intent(inout) :: status
    integer :: k
    do k = 1, size(tables%file)
      if (tables%file(k)%on) call write_out(tables%file(k), status)
    end do
  end subroutine flush_tables

  !> Saves to or restores from the archive: intervals, when rows are due, and the bytes of each
  !> file.
  subroutine exchange_tables(archive, tables)
    type(archive_t), intent(inout) :: archive
    type(tables_t), intent(inout) :: tables
    real(wp) :: interval(table_count), next(table_count), written(table_count)
    interval = tables%file%interval
    next = tables%file%next
    written = real(tables%file%written, wp)
    call archive%exchange('tables.interval', interval)
    call archive%exchange('tables.next', next)
    call archive%exchange('tables.bytes', written)
    tables%file%interval = interval
    tables%file%next = next
    tables%file%written = nint(written, i8)
  end subroutine exchange_tables

  !> True when any table wants a row at this time.
  logical function any_due(tables, time, h)
    type(tables_t), intent(in) :: tables
    real(wp), intent(in) :: time, h
    integer :: k
    any_due = .false.
    if (.not. tables%any_on) return
    do k = 1, size(tables%file)
      if (row_is_due(tables%file(k), time, h)) any_due = .true.
    end do
  end function any_due

  !> True when a row is due that needs the energies.
  logical function energies_due(tables, time, h, last)
    type(tables_t), intent(in) :: tables
    real(wp), intent(in) :: time, h
    logical, intent(in) :: last
    energies_due = row_is_due(tables%file(table_glstat), time, h) &
        .or. row_is_due(tables%file(table_matsum), time, h)
    if (last) energies_due = tables%file(table_glstat)%on .or. tables%file(table_matsum)%on
  end function energies_due

  !> Adds numbers to the row of a table.
  subroutine add_numbers(file, writer, numbers)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    real(wp), intent(in) :: numbers(:)
    integer :: k
    do k = 1, size(numbers)
      call add_number(file, writer, numbers(k))
    end do
  end subroutine add_numbers

  !> Adds a vector, in the plane x, y, 0. (An array that takes sections of others would be
  !> allocated in each row.)
  subroutine add_vector(file, writer, v)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    real(wp), intent(in) :: v(:)
    call add_number(file, writer, v(1))
    call add_number(file, writer, v(2))
    if (size(v) == 3) then
      call add_number(file, writer, v(3))
    else
      call add_number(file, writer, zero)
    end if
  end subroutine add_vector

  !> Closes all tables with the way the run ended.
  subroutine close_tables(tables, ending, cycle, status)
    type(tables_t), intent(inout) :: tables
    character(*), intent(in) :: ending
    integer, intent(in) :: cycle
    type(status_t), intent(inout) :: status
    integer :: k
    do k = 1, size(tables%file)
      call close_table(tables%file(k), ending, cycle, status)
    end do
  end subroutine close_tables

end module output_tables
