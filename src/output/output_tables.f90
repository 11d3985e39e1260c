! SPDX-License-Identifier: BSD-3-Clause
!> The set of tables of a run: which are on, their columns (doc/output.md), when rows are due.
module output_tables
  use base_archive, only: archive_t
  use base_format, only: real_writer_t, make_real_writer
  use base_kinds, only: wp, i8
  use base_status, only: status_t, failed
  use model_data, only: model_t
  use output_table, only: table_file_t, open_table, row_is_due, add_number, close_table, &
      reopen_table, check_rows, write_out
  implicit none
  private
  integer, parameter, public :: table_glstat = 1, table_matsum = 2, table_nodout = 3, &
      table_elout = 4, table_rcforc = 5, table_sleout = 6, table_spcforc = 7, &
      table_ncforc = 8, table_timing = 9, table_rwforc = 10
  integer, parameter :: table_count = 10

  type, public :: tables_t
    type(table_file_t) :: file(table_count)
    type(real_writer_t) :: writer
    logical :: any_on = .false.
  end type tables_t

  public :: flush_tables, exchange_tables
  public :: open_tables, any_due, energies_due, close_tables, add_numbers

contains

  !> Opens the tables that the deck asks for; again: keeps the rows of the run that goes on.
  subroutine open_tables(tables, model, folder, has_acceleration, again, status)
    type(tables_t), intent(inout) :: tables
    type(model_t), intent(in) :: model
    character(*), intent(in) :: folder
    logical, intent(in) :: has_acceleration, again
    type(status_t), intent(inout) :: status
    character(:), allocatable :: more
    integer :: pass
    more = ''
    if (has_acceleration) more = ' ax ay az'
    do pass = merge(1, 2, again), 2   ! first whether all are there, then what changes them
      if (failed(status)) return
      associate (r => model%requests)
        call open_one(table_glstat, 'glstat', r%glstat, &
            'time cycle dt kinetic internal total '// &
            'initial external motion friction contact unsolved algorithmic damping '// &
            'residual ratio momx momy momz angx angy angz')
        call open_one(table_matsum, 'matsum', r%matsum, &
            'time part mass kinetic internal momx momy momz vx vy vz')
        call open_one(table_nodout, 'nodout', r%nodout, &
            'time node ux uy uz vx vy vz vmx vmy vmz x y z'//more)
        call open_one(table_elout, 'elout', r%elout, &
            'time element part sxx syy szz sxy syz szx energy')
        call open_one(table_rcforc, 'rcforc', r%rcforc, 'time contact side fx fy fz fmx '// &
            'fmy fmz ix iy iz fn ft nactive nstick nslip gapmin')
        call open_one(table_rwforc, 'rwforc', r%rwforc, 'time wall fx fy fz fmx fmy fmz '// &
            'ix iy iz fn ft nactive nstick nslip gapmin')
        call open_one(table_sleout, 'sleout', r%sleout, &
            'time contact normalwork frictionwork '// &
            'solves sweeps eta error error2018 penetration')
        call open_one(table_spcforc, 'spcforc', r%spcforc, 'time node fx fy fz')
        call open_one(table_ncforc, 'ncforc', r%ncforc, &
            'time contact side node fx fy fz fmx fmy fmz pressure gap slip status')
        call open_one(table_timing, 'timing', r%timing, &
            'time cycle cpu input assemble factor '// &
            'solve search contact output factors solves sweeps')
      end associate
    end do
    tables%any_on = any(tables%file%on)
    if (tables%any_on) call make_real_writer(tables%writer)

  contains

    subroutine open_one(k, name, interval, columns)
      integer, intent(in) :: k
      character(*), intent(in) :: name, columns
      real(wp), intent(in) :: interval
      if (again .and. pass == 1) then
        call check_rows(tables%file(k), folder, name, interval, status)
        return
      end if
      if (again) call reopen_table(tables%file(k), folder, name, interval, status)
      if (.not. again) call open_table(tables%file(k), folder, name, interval, model%title, &
          columns, status)
    end subroutine open_one

  end subroutine open_tables

  !> Brings all rows to the files.
  subroutine flush_tables(tables, status)
    type(tables_t), intent(inout) :: tables
    type(status_t), intent(inout) :: status
    integer :: k
    do k = 1, size(tables%file)
      if (tables%file(k)%on) call write_out(tables%file(k), status)
    end do
  end subroutine flush_tables

  !> Saves to or restores from the archive: when rows are due, and the bytes of each file.
  subroutine exchange_tables(archive, tables)
    type(archive_t), intent(inout) :: archive
    type(tables_t), intent(inout) :: tables
    real(wp) :: next(table_count), written(table_count)
    next = tables%file%next
    written = real(tables%file%written, wp)
    call archive%exchange('tables.next', next)
    call archive%exchange('tables.bytes', written)
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
