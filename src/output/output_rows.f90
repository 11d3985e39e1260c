! SPDX-License-Identifier: BSD-3-Clause
!> The tables of a run: what each row holds (doc/output.md). A table that is not asked for has
!> no file and costs nothing.
module output_rows
  use base_format, only: real_writer_t, make_real_writer
  use base_kinds, only: wp, zero
  use base_status, only: status_t
  use base_timers, only: timers_t, phase_input, phase_assemble, phase_factor, phase_solve, &
      phase_search, phase_contact, phase_output
  use contact_types, only: contact_t
  use cone_types, only: certificate_t
  use model_data, only: model_t
  use model_state, only: state_t
  use output_table, only: table_file_t, open_table, row_is_due, begin_row, add_number, &
      add_count, end_row, close_table
  use time_ledger, only: ledger_t
  implicit none
  private
  integer, parameter :: glstat = 1, matsum = 2, nodout = 3, rcforc = 4, sleout = 5, timing = 6

  type, public :: tables_t
    type(table_file_t) :: file(6)
    type(real_writer_t) :: writer
    logical :: any_on = .false.
    integer :: factors = 0, solves = 0   !< counts for timing.tab, kept by the run
  end type tables_t

  public :: open_tables, any_due, energies_due, write_rows, close_tables

contains

  !> Opens the tables that the deck asks for.
  subroutine open_tables(tables, model, folder, has_acceleration, status)
    type(tables_t), intent(inout) :: tables
    type(model_t), intent(in) :: model
    character(*), intent(in) :: folder
    logical, intent(in) :: has_acceleration
    type(status_t), intent(inout) :: status
    character(:), allocatable :: more
    more = ''
    if (has_acceleration) more = ' ax ay az'
    associate (r => model%requests, f => tables%file)
      call open_table(f(glstat), folder, 'glstat', r%glstat, model%title, &
          'time cycle dt kinetic internal total initial external motion friction contact '// &
          'unsolved algorithmic damping residual ratio momx momy momz angx angy angz', status)
      call open_table(f(matsum), folder, 'matsum', r%matsum, model%title, &
          'time part mass kinetic internal momx momy momz vx vy vz', status)
      call open_table(f(nodout), folder, 'nodout', r%nodout, model%title, &
          'time node ux uy uz vx vy vz vmx vmy vmz x y z'//more, status)
      call open_table(f(rcforc), folder, 'rcforc', r%rcforc, model%title, &
          'time contact side fx fy '// &
          'fz fmx fmy fmz ix iy iz fn ft nactive nstick nslip gapmin', status)
      call open_table(f(sleout), folder, 'sleout', r%sleout, model%title, &
          'time contact normalwork '// &
          'frictionwork solves sweeps eta error error2018 penetration', status)
      call open_table(f(timing), folder, 'timing', r%timing, model%title, &
          'time cycle cpu input '// &
          'assemble factor solve search contact output factors solves sweeps', status)
    end associate
    tables%any_on = any(tables%file%on)
    if (tables%any_on) call make_real_writer(tables%writer)
  end subroutine open_tables

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
    energies_due = row_is_due(tables%file(glstat), time, h) &
        .or. row_is_due(tables%file(matsum), time, h)
    if (last) energies_due = tables%file(glstat)%on .or. tables%file(matsum)%on
  end function energies_due

  !> Writes the rows that are due; at the last step every table gets one.
  subroutine write_rows(tables, model, state, ledger, contact, timers, h, last, status)
    type(tables_t), intent(inout) :: tables
    type(model_t), intent(in) :: model
    type(state_t), intent(in) :: state
    type(ledger_t), intent(in) :: ledger
    type(contact_t), intent(inout) :: contact
    type(timers_t), intent(in) :: timers
    real(wp), intent(in) :: h
    logical, intent(in) :: last
    type(status_t), intent(inout) :: status
    integer :: k
    do k = 1, size(tables%file)
      if (.not. tables%file(k)%on) cycle
      if (.not. (last .or. row_is_due(tables%file(k), state%time, h))) cycle
      select case (k)
      case (glstat)
        call begin_row(tables%file(k), state%time, h, status)
        call write_glstat(tables%file(k), tables%writer, state, ledger, h)
      case (matsum)
        call write_matsum(tables%file(k), tables%writer, model, state, ledger, h, status)
      case (nodout)
        call write_nodout(tables%file(k), tables%writer, model, state, h, status)
      case (rcforc)
        call write_rcforc(tables%file(k), tables%writer, contact, state, h, status)
      case (sleout)
        call write_sleout(tables%file(k), tables%writer, contact, state, h, status)
      case (timing)
        call begin_row(tables%file(k), state%time, h, status)
        call write_timing(tables, state, timers, contact%sweeps)
      end select
    end do
  end subroutine write_rows

  subroutine add_numbers(file, writer, numbers)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    real(wp), intent(in) :: numbers(:)
    integer :: k
    do k = 1, size(numbers)
      call add_number(file, writer, numbers(k))
    end do
  end subroutine add_numbers

  subroutine write_glstat(file, writer, state, ledger, h)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    type(state_t), intent(in) :: state
    type(ledger_t), intent(in) :: ledger
    real(wp), intent(in) :: h
    call add_number(file, writer, state%time)
    call add_count(file, state%cycle)
    call add_numbers(file, writer, &
        [h, ledger%kinetic, ledger%internal, ledger%total, ledger%initial, ledger%external, &
        ledger%motion, ledger%contact%friction, ledger%contact%normal, &
        ledger%contact%unsolved, ledger%algorithmic, ledger%damping, ledger%residual, &
        ledger%ratio, ledger%momentum(1), ledger%momentum(2), zero, zero, zero, ledger%angular])
    call end_row(file)
  end subroutine write_glstat

  subroutine write_matsum(file, writer, model, state, ledger, h, status)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    type(model_t), intent(in) :: model
    type(state_t), intent(in) :: state
    type(ledger_t), intent(in) :: ledger
    real(wp), intent(in) :: h
    type(status_t), intent(inout) :: status
    integer :: p
    do p = 1, size(model%part)
      call begin_row(file, state%time, h, status)
      call add_number(file, writer, state%time)
      call add_count(file, model%part(p)%id)
      call add_numbers(file, writer, [ledger%part_mass(p), ledger%part_kinetic(p), &
          ledger%part_internal(p), ledger%part_momentum(:, p), zero, &
          ledger%part_momentum(:, p)/ledger%part_mass(p), zero])
      call end_row(file)
    end do
  end subroutine write_matsum

  subroutine write_nodout(file, writer, model, state, h, status)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    type(model_t), intent(in) :: model
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: h
    type(status_t), intent(inout) :: status
    real(wp) :: mean(2)
    integer :: k, i
    do k = 1, size(model%requests%history_node)
      i = model%requests%history_node(k)
      mean = state%v(:, i)
      if (state%cycle > 0) mean = state%du(:, i)/state%h_last
      call begin_row(file, state%time, h, status)
      call add_number(file, writer, state%time)
      call add_count(file, model%node_id(i))
      call add_numbers(file, writer, [state%u(:, i), zero, state%v(:, i), zero, mean, zero, &
          model%x(:, i) + state%u(:, i), zero])
      if (allocated(state%a)) call add_numbers(file, writer, [state%a(:, i), zero])
      call end_row(file)
    end do
  end subroutine write_nodout

  subroutine write_rcforc(file, writer, contact, state, h, status)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    type(contact_t), intent(in) :: contact
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: h
    type(status_t), intent(inout) :: status
    integer :: p, s
    do p = 1, size(contact%pair)
      associate (c => contact%pair(p))
        do s = 1, 2
          call begin_row(file, state%time, h, status)
          call add_number(file, writer, state%time)
          call add_count(file, c%id)
          call add_count(file, s)
          call add_numbers(file, writer, &
              [c%force(:, s), zero, 0.5_wp*(c%force(:, s) + c%force_before(:, s)), zero, &
              c%impulse(:, s), zero, c%normal_force, c%tangential_force])
          call add_count(file, c%n_active)
          call add_count(file, c%n_stick)
          call add_count(file, c%n_slip)
          call add_number(file, writer, c%smallest_gap)
          call end_row(file)
        end do
      end associate
    end do
  end subroutine write_rcforc

  !> One row for the whole coupled problem (id 0), one per contact; the solver's figures are
  !> those of the coupled problem in every row.
  subroutine write_sleout(file, writer, contact, state, h, status)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    type(contact_t), intent(inout) :: contact
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: h
    type(status_t), intent(inout) :: status
    integer :: p
    do p = 0, size(contact%pair)
      call begin_row(file, state%time, h, status)
      call add_number(file, writer, state%time)
      if (p == 0) then
        call add_count(file, 0)
        call add_numbers(file, writer, &
            [sum(contact%pair%normal_work), sum(contact%pair%friction_work)])
      else
        call add_count(file, contact%pair(p)%id)
        call add_numbers(file, writer, &
            [contact%pair(p)%normal_work, contact%pair(p)%friction_work])
      end if
      call add_count(file, contact%solves_since_row)
      call add_count(file, contact%sweeps_since_row)
      call add_numbers(file, writer, [contact%worst_since_row%eta, &
          contact%worst_since_row%error, contact%worst_since_row%error2018])
      if (p == 0) call add_number(file, writer, maxval([zero, contact%pair%penetration]))
      if (p > 0) call add_number(file, writer, contact%pair(p)%penetration)
      call end_row(file)
    end do
    contact%solves_since_row = 0
    contact%sweeps_since_row = 0
    contact%worst_since_row = certificate_t()
    contact%pair%penetration = zero
  end subroutine write_sleout

  subroutine write_timing(tables, state, timers, sweeps)
    type(tables_t), intent(inout) :: tables
    type(state_t), intent(in) :: state
    type(timers_t), intent(in) :: timers
    integer, intent(in) :: sweeps
    integer, parameter :: phase(7) = [phase_input, phase_assemble, phase_factor, phase_solve, &
                                      phase_search, phase_contact, phase_output]
    real(wp) :: cpu
    integer :: k
    call cpu_time(cpu)
    associate (file => tables%file(timing))
      call add_number(file, tables%writer, state%time)
      call add_count(file, state%cycle)
      call add_number(file, tables%writer, cpu)
      do k = 1, size(phase)
        call add_number(file, tables%writer, timers%seconds(phase(k)))
      end do
      call add_count(file, tables%factors)
      call add_count(file, tables%solves)
      call add_count(file, sweeps)
      call end_row(file)
    end associate
  end subroutine write_timing

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

end module output_rows
