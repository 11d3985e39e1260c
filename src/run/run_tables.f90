! SPDX-License-Identifier: BSD-3-Clause
!> Rows that are due, from all parts of the run.
module run_tables
  use base_status, only: status_t
  use deck_names, only: table_glstat, table_matsum, table_nodout, table_elout, &
      table_rcforc, table_rwforc, table_sleout, table_spcforc, table_ncforc, table_timing, &
      table_rbdout
  use output_forces, only: write_rcforc, write_rwforc, write_sleout, write_ncforc, write_spcforc
  use output_rows, only: write_glstat, write_matsum, write_nodout, write_elout, write_rbdout, &
      write_timing
  use output_table, only: row_is_due, rows_done
  use contact_area, only: find_all_areas
  use contact_work, only: start_row
  use run_data, only: run_t
  implicit none
  private
  public :: write_rows

contains

  !> Writes the rows that are due; at the last step every table gets one.
  subroutine write_rows(run, is_final, status)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: is_final
    type(status_t), intent(inout) :: status
    integer :: k
    do k = 1, size(run%tables%file)
      if (.not. run%tables%file(k)%on) cycle
      if (run%tables%file(k)%no_row_at == run%state%cycle) cycle
      if (.not. (is_final .or. row_is_due(run%tables%file(k), run%state%time, &
          run%model%controls%dt))) cycle
      call write_one(run, k, status)
      call rows_done(run%tables%file(k), run%state%time, run%model%controls%dt)
    end do
  end subroutine write_rows

  subroutine write_one(run, k, status)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: k
    type(status_t), intent(inout) :: status
    associate (file => run%tables%file(k), writer => run%tables%writer, model => run%model, &
        state => run%state, time => run%state%time, h => run%scheme%h)
      select case (k)
      case (table_glstat)
        call write_glstat(file, writer, model, state, run%ledger, h, status)
      case (table_matsum)
        call write_matsum(file, writer, model, state, run%ledger, status)
      case (table_nodout)
        call write_nodout(file, writer, model, state, status)
      case (table_elout)
        call write_elout(file, writer, run%tables%history, model, run%system, state, &
            status)
      case (table_rbdout)
        call write_rbdout(file, writer, model, state, status)
      case (table_rcforc)
        call write_rcforc(file, writer, run%contact, time, status)
      case (table_rwforc)
        call write_rwforc(file, writer, run%contact, time, status)
      case (table_sleout)
        call write_sleout(file, writer, run%contact, time, status)
        call start_row(run%contact)
      case (table_spcforc)
        call write_spcforc(file, writer, model, run%system%fixed, run%mean_reaction, &
            time, status)
      case (table_ncforc)
        call find_all_areas(model, run%contact, state%u)
        call write_ncforc(file, writer, model, run%contact, time, status)
      case (table_timing)
        call write_timing(file, writer, state, run%timers, run%factors, run%solves, &
            run%contact%tally%sweeps, status)
      end select
    end associate
  end subroutine write_one

end module run_tables
