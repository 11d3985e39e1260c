! SPDX-License-Identifier: BSD-3-Clause
!> The log, the echo deck and the closing summary.
module run_report
  use, intrinsic :: iso_fortran_env, only: output_unit
  use base_files, only: open_text, close_text, move_file, remove_file
  use base_kinds, only: wp, zero, i8
  use base_status, only: status_t, failed, status_text
  use base_strings, only: to_text, join_path
  use base_timers, only: phase_count, phase_name
  use base_version, only: version
  use contact_rows, only: row_edge, row_vertex, row_second, row_wall, row_guided, &
      row_mortar
  use contact_types, only: contact_t
  use deck_names, only: step_fixed
  use linalg_solver, only: solver_t, work_of, inverse_bytes
  use output_tables, only: flows
  use run_data, only: run_t
  use run_echo, only: keep_echo
  use run_forecast, only: write_comparison
  use run_plan, only: plan_line
  use run_summary, only: totals_t, find_totals, write_run_summary
  use run_warnings, only: collect_messages, show_warnings, write_messages, write_kinds
  implicit none
  private
  public :: open_log, close_log, write_plan, write_solver

contains

  !> Opens bipact.log with version, plan, notes; writes deck.echo.k.
  subroutine open_log(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    call keep_echo(run, status)
    if (failed(status)) return
    call open_text(join_path(run%folder, 'bipact.log'), run%log_unit, status)
    if (failed(status)) return
    write (run%log_unit, '(a)') 'bipact '//version
    write (run%log_unit, '(a)') 'title: '//trim(run%model%title)
    write (run%log_unit, '(a)') 'deck:  '//run%deck%file(1)%path
    call write_plan(run, run%log_unit)
    if (allocated(run%moved)) call write_moved(run, run%log_unit)
    if (allocated(run%restarted)) write (run%log_unit, '(a)') 'restarted from '// &
        run%restarted//', step '//to_text(run%state%cycle)//', time '// &
        to_text(run%state%time)
    call write_solver(run%solver, run%log_unit)
  end subroutine open_log

  !> Passes of Newton's method.
  subroutine write_newton(run, unit)
    type(run_t), intent(in) :: run
    integer, intent(in) :: unit
    if (run%newton%is_explicit) return
    write (unit, '(a)') "Newton's method: passes "//to_text(run%newton%passes)//', '// &
        to_text(real(run%newton%passes, wp)/max(1, run%newton%steps))//' a step, most '// &
        to_text(run%newton%worst)
  end subroutine write_newton

  !> What a factor costs, and where there are contact dofs their part of it.
  subroutine write_solver(solver, unit)
    class(solver_t), intent(in) :: solver
    integer, intent(in) :: unit
    write (unit, '(a)') 'solver '//solver%info%engine//', order '//solver%info%order// &
        ', factor '//to_text(solver%info%factor_bytes)//' bytes, '// &
        to_text(solver%info%multiplications)//' block multiplications ('// &
        to_text(work_of(solver))//' Gflop)'
    if (solver%n_interface == 0) return
    write (unit, '(a)') 'of it for '//to_text(solver%d*solver%n_interface)//' contact dofs '// &
        to_text(inverse_bytes(solver))//' bytes, beside it their inverse of as many'
  end subroutine write_solver

  !> The scene plan: size, scheme, features with their reasons.
  subroutine write_plan(run, unit)
    type(run_t), intent(in) :: run
    integer, intent(in) :: unit
    integer :: k
    write (unit, '(a)') 'scene: '//to_text(run%model%mesh_nodes)//' nodes, '// &
        to_text(run%model%mesh%n)//' elements, '//to_text(size(run%model%part))// &
        ' parts; scheme '//trim(run%model%controls%scheme)//', mass '// &
        trim(run%model%controls%mass)
    write (unit, '(a)') 'plan:'
    do k = 1, run%plan%n
      write (unit, '(a)') plan_line(run%plan, k)
    end do
  end subroutine write_plan

  !> Nodes that OVERLAP ADJUST has moved before the start.
  subroutine write_moved(run, unit)
    type(run_t), intent(in) :: run
    integer, intent(in) :: unit
    integer :: k
    write (unit, '(a)') 'moved onto obstacles: contact, node, by x, by y'
    do k = 1, size(run%moved)
      associate (m => run%moved(k))
        write (unit, '(2i10,2(1x,es24.16e3))') m%contact, run%model%node_id(m%node), m%by
      end associate
    end do
  end subroutine write_moved

  !> Notes, warnings and the closing summary into the log; on the screen the warnings that it
  !> has not shown and the summary; then summary.json with the same numbers.
  subroutine close_log(run, ending)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: ending
    type(totals_t) :: totals
    call collect_messages(run)
    call find_totals(run, totals)
    call show_warnings(run%warnings)
    call write_messages(run, run%log_unit)
    if (failed(ending)) write (run%log_unit, '(a)') 'FAILED '//status_text(ending)
    call write_summary(run, totals, run%log_unit)
    call write_comparison(run%forecast, totals%peak_memory, totals%cpu - run%forecast%cpu, &
        run%log_unit)
    call write_phases(run, run%log_unit)
    call close_text(join_path(run%folder, 'bipact.log'), run%log_unit, ending)
    call write_run_summary(run, totals, ending)
    if (run%quiet) return
    call write_summary(run, totals, output_unit)
  end subroutine close_log

  !> Steps, counts, ledger, contact certificate.
  subroutine write_summary(run, totals, unit)
    type(run_t), intent(in) :: run
    type(totals_t), intent(in) :: totals
    integer, intent(in) :: unit
    associate (l => run%ledger, c => run%contact%tally)
      write (unit, '(a)') 'steps '//to_text(run%state%cycle)//', time '// &
          to_text(run%state%time)//', CPU '//to_text(totals%cpu)//' s'
      if (run%step%mode /= step_fixed) write (unit, '(a)') 'steps halved '// &
          to_text(run%step%halvings)//', cut at a touch '//to_text(run%step%cuts)
      write (unit, '(a)') 'factorisations '//to_text(run%factors)//', solves '// &
          to_text(run%solves)//', contact searches '//to_text(c%searches)// &
          ', contact solves '//to_text(c%solves)//', sweeps '//to_text(c%sweeps)
      if (run%solver%info%iterations > 0_i8) write (unit, '(a)') 'conjugate gradients: '// &
          to_text(run%solver%info%iterations)//' iterations'
      if (allocated(run%contact%local)) write (unit, '(a)') 'contact without S^-1: solves '// &
          to_text(run%contact%local%solves)//', passes '//to_text(run%contact%local%passes)
      write (unit, '(a)') 'energy: kinetic '//to_text(l%kinetic)//', internal '// &
          to_text(l%internal)//', initial '//to_text(l%initial)//', external '// &
          to_text(l%external)//', motion '//to_text(l%motion)
      write (unit, '(a)') '  lost: friction '//to_text(l%contact%friction)//', contact '// &
          to_text(l%contact%normal)//', algorithmic '//to_text(l%algorithmic)//', damping '// &
          to_text(l%damping)//'; unsolved '//to_text(l%contact%unsolved)
      if (flows(run%model)) write (unit, '(a)') '  plastic work '//to_text(l%plastic)
      if (allocated(run%newton)) call write_newton(run, unit)
      write (unit, '(a)') '  ledger residual '//to_text(l%residual)//' (worst '// &
          to_text(l%worst_residual)//'), ratio '//to_text(l%ratio)
      if (run%plan%contact) call write_rows_by_kind(run%contact, totals, unit)
      if (run%plan%contact) write (unit, '(a)') 'contact: worst error '// &
          to_text(c%worst%error)//', eta '//to_text(c%worst%eta)//', penetration/edge '// &
          to_text(c%overlap_share)//', certificate '// &
          trim(merge('met    ', 'not met', c%worst%met))
    end associate
    if (run%plan%fields) write (unit, '(a)') 'frames '//to_text(run%fields%frames)// &
        ' in '//to_text(run%fields%segment)//' field files'
    if (run%plan%restarts) write (unit, '(a)') 'restart files written '// &
        to_text(run%restart_files)
    write (unit, '(a)') 'peak memory '//memory_text(totals)
    call write_kinds(run, unit)
  end subroutine write_summary

  !> How many rows of which kind the contact solves had, and what was found missing.
  subroutine write_rows_by_kind(contact, totals, unit)
    type(contact_t), intent(in) :: contact
    type(totals_t), intent(in) :: totals
    integer, intent(in) :: unit
    character(:), allocatable :: line
    integer :: p
    do p = 1, size(contact%pairing)
      associate (item => contact%pairing(p)%item)
        if (item%multiplier_side > 0) write (unit, '(a)') 'mortar of contact '// &
            to_text(item%id)//': multipliers on '//side_name(item%multiplier_side)
      end associate
    end do
    associate (t => contact%tally)
      line = 'rows in contact solves: edge '//to_text(t%rows(row_edge))//', vertex '// &
          to_text(t%rows(row_vertex))//', second '//to_text(t%rows(row_second))//', wall '// &
          to_text(t%rows(row_wall) + t%rows(row_guided))
      if (t%rows(row_mortar) > 0) line = line//', mortar '//to_text(t%rows(row_mortar))
      line = line//'; of them with an allowance '//to_text(t%allowances)
      write (unit, '(a)') line
      write (unit, '(a)') '  late rows '//to_text(t%late_rows)//', frames redone '// &
          to_text(t%new_frames)//', repeats for the purse '//to_text(t%repeats)// &
          ', steps with a short purse '//to_text(totals%short_steps)// &
          ', steps that outran a list '//to_text(t%redone)
    end associate
  end subroutine write_rows_by_kind

  pure function side_name(side) result(name)
    integer, intent(in) :: side
    character(5) :: name
    name = merge('SURFA', 'SURFB', side == 1)
  end function side_name

  !> The largest resident memory; "unknown" where the system does not tell it.
  pure function memory_text(totals) result(text)
    type(totals_t), intent(in) :: totals
    character(:), allocatable :: text
    text = 'unknown'
    if (totals%peak_memory >= 0_i8) text = to_text(totals%peak_memory/1024_i8)//' kB'
  end function memory_text

  !> Where the time went: seconds by the monotonic clock and number of entries.
  subroutine write_phases(run, unit)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: unit
    integer :: k
    write (unit, '(a)') 'phase                           seconds        calls'
    do k = 1, phase_count
      write (unit, '(a,es12.4,i13)') phase_name(k), run%timers%seconds(k), run%timers%calls(k)
    end do
  end subroutine write_phases

end module run_report
