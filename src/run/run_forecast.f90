! SPDX-License-Identifier: BSD-3-Clause
!> What a run will need, before its first step: memory from what is there and what is still to
!> be touched, time from counts of operations and one measured rate.
module run_forecast
  use, intrinsic :: iso_fortran_env, only: int64
  use base_kinds, only: wp, i8, zero, one, two
  use base_strings, only: to_text
  use base_system, only: peak_memory
  use deck_names, only: table_glstat, table_matsum
  use linalg_solver, only: work_of, inverse_bytes
  use run_data, only: run_t, forecast_t
  use solid_block, only: force_conserving
  implicit none
  private

  public :: make_forecast, count_passes, write_forecast, write_comparison

  !> Shares of the measured rate that kinds of work reach, from runs of 1e2 to 1e6 dofs
  !> (bench/forecast.py).
  real(wp), parameter :: of_factor = 0.33_wp, of_panels = 0.65_wp, of_wide = 1.3_wp, &
      of_solve = 0.25_wp, of_product = 0.4_wp, of_law = 0.45_wp, of_dense = 0.5_wp
  integer(i8), parameter :: of_tables = 1500000_i8  ! of tables and log
  !> Gflop/s where the run is too short to measure them [s].
  real(wp), parameter :: usual_rate = 5.0_wp, worth_a_look = 1.0_wp
  real(wp), parameter :: call_cost = 1.5e-6_wp     ! [s] of a step of a scene without size

contains

  !> The forecast of a scene whose factor has been sized; is_made: and made.
  subroutine make_forecast(run, is_made, forecast)
    type(run_t), intent(in) :: run
    logical, intent(in) :: is_made
    type(forecast_t), intent(out) :: forecast
    call cpu_time(forecast%cpu)
    forecast%rate = usual_rate
    call estimate_times(run, is_made, forecast)
    if (.not. is_made .or. forecast%whole > worth_a_look) then
      forecast%rate = measured_rate()
      call estimate_times(run, is_made, forecast)
    end if
    forecast%bytes = peak_memory()
    if (.not. is_made) forecast%bytes = forecast%bytes + run%solver%info%factor_bytes &
        + run%solver%info%front_bytes + inverse_bytes(run%solver) + of_tables
  end subroutine make_forecast

  !> Times at forecast%rate.
  subroutine estimate_times(run, is_made, forecast)
    type(run_t), intent(in) :: run
    logical, intent(in) :: is_made
    type(forecast_t), intent(inout) :: forecast
    real(wp) :: factor, solve, product, tangent, contact, factors, passes
    call count_passes(run, factors, passes)
    associate (r => forecast%rate)
      factor = work_of(run%solver)/(r*factor_share(run))
      solve = solve_work(run)/(r*of_solve)
      call element_work(run, product, tangent)
      product = product/(r*of_product)
      tangent = tangent/(r*of_law)
      contact = contact_work(run)/(r*of_dense)
    end associate
    if (.not. is_made) forecast%start = factor
    forecast%step = call_cost + passes*(solve + product + contact) + factors*(factor + &
        tangent) + energy_share(run)*1.5_wp*product
    forecast%whole = forecast%start + (run%plan%full_steps - run%state%cycle)*forecast%step
  end subroutine estimate_times

  !> Of the measured rate, what a factor reaches.
  pure real(wp) function factor_share(run)
    type(run_t), intent(in) :: run
    factor_share = of_factor
    if (run%solver%info%engine /= 'SUPERNODAL') return
    factor_share = merge(of_wide, of_panels, run%solver%info%wide)
  end function factor_share

  !> Gflop of a solve: two operations for each number of the factor in each of two passes; of
  !> conjugate gradients those of a few iterations, twice where contact comes between.
  real(wp) function solve_work(run)
    type(run_t), intent(in) :: run
    real(wp), parameter :: iterations = 8.0_wp
    if (run%solver%info%engine == 'CG') then
      solve_work = iterations*8.0e-9_wp*run%solver%d**2*size(run%system%graph%column)
      if (run%plan%contact) solve_work = 2.0_wp*solve_work
    else
      solve_work = 0.5e-9_wp*run%solver%info%factor_bytes
    end if
  end function solve_work

  !> Gflop/s of multiplications and additions over arrays in the cache, the best of three.
  real(wp) function measured_rate()
    integer, parameter :: n = 1000, rounds = 30
    real(wp) :: a(n), b(n), seconds
    integer(int64) :: start, finish, ticks
    integer :: k, m
    a = one
    b = 1.0e-3_wp
    measured_rate = 0.1_wp
    do m = 1, 3
      call system_clock(start, ticks)
      do k = 1, rounds
        a = a + 1.0e-3_wp*b
        b = b + 1.0e-3_wp*a
      end do
      call system_clock(finish)
      seconds = real(finish - start, wp)/real(ticks, wp)
      if (a(n) > zero .and. seconds > zero) measured_rate = max(measured_rate, &
          4.0e-9_wp*n*rounds/seconds)
    end do
  end function measured_rate

  !> Factors and solves of a step, about.
  subroutine count_passes(run, factors, passes)
    type(run_t), intent(in) :: run
    real(wp), intent(out) :: factors, passes
    factors = zero
    passes = size(run%scheme%stage)
    if (.not. allocated(run%newton)) return
    if (run%newton%is_explicit) return
    passes = 5.5_wp
    factors = merge(passes, 1.3_wp, run%step%is_static)
  end subroutine count_passes

  !> Gflop of the forces of all elements once, with the mass, and of their tangents.
  subroutine element_work(run, product, tangent)
    type(run_t), intent(in) :: run
    real(wp), intent(out) :: product, tangent
    real(wp) :: unknowns, points
    integer :: b
    product = two*run%system%dim*size(run%system%mass)
    tangent = zero
    do b = 1, size(run%system%block)
      associate (e => run%system%block(b))
        if (e%is_rigid) cycle
        unknowns = real(run%system%dim*e%nodes, wp)
        if (allocated(run%newton)) then
          points = real(run%system%solid(b)%n, wp)*run%system%solid(b)%points
          product = product + points*visits(run)*(650.0_wp + 12.0_wp*unknowns)
          tangent = tangent + points*(1500.0_wp + 8.0_wp*unknowns**2)
        else
          product = product + two*size(e%node, 2)*unknowns**2
        end if
      end associate
    end do
    product = 1.0e-9_wp*product
    tangent = 1.0e-9_wp*tangent
  end subroutine element_work

  !> In how many of its steps a run evaluates its energies.
  pure real(wp) function energy_share(run)
    type(run_t), intent(in) :: run
    real(wp) :: every
    energy_share = zero
    if (allocated(run%newton)) energy_share = one
    every = minval(run%model%requests%interval([table_glstat, table_matsum]), &
        mask=run%model%requests%interval([table_glstat, table_matsum]) > zero)
    energy_share = max(energy_share, min(one, run%model%controls%dt/every))
  end function energy_share

  !> How often a pass, or an explicit step, asks the law at a point.
  pure real(wp) function visits(run)
    type(run_t), intent(in) :: run
    visits = one
    if (run%model%controls%force == force_conserving) visits = two
    if (run%newton%is_explicit) visits = 3.0_wp
  end function visits

  !> Gflop of contact in a step: the motion of the interface and, as if half of its nodes were
  !> closed for half of the time, their cone solve.
  pure real(wp) function contact_work(run)
    type(run_t), intent(in) :: run
    real(wp) :: dofs
    dofs = real(run%solver%d, wp)*run%solver%n_interface
    contact_work = 1.0e-9_wp*(two*dofs**2 + 0.5_wp*12.0_wp*(dofs/two)**2)
    if (run%solver%takes_diagonal) contact_work = 1.0e-9_wp*50.0_wp*dofs
  end function contact_work

  !> One line for plan and log.
  subroutine write_forecast(forecast, unit)
    type(forecast_t), intent(in) :: forecast
    integer, intent(in) :: unit
    write (unit, '(a)') 'forecast: memory '//to_text(forecast%bytes/1000000_i8)// &
        ' MB, start '//short(forecast%start)//' s, a step '//short(forecast%step)// &
        ' s, the run '//short(forecast%whole)//' s at '//short(forecast%rate)//' Gflop/s'
  end subroutine write_forecast

  !> One line for the end of the log: what was forecast before the first step, and what was.
  subroutine write_comparison(forecast, bytes, seconds, unit)
    type(forecast_t), intent(in) :: forecast
    integer(i8), intent(in) :: bytes
    real(wp), intent(in) :: seconds
    integer, intent(in) :: unit
    write (unit, '(a)') 'forecast of the steps: '//to_text(forecast%bytes/1000000_i8)// &
        ' MB, '//short(forecast%whole)//' s; they took '//to_text(bytes/1000000_i8)//' MB, '// &
        short(seconds)//' s'
  end subroutine write_comparison

  !> A figure of two digits.
  function short(x) result(text)
    real(wp), intent(in) :: x
    character(:), allocatable :: text
    character(12) :: buffer
    write (buffer, '(es8.1)') x
    text = trim(adjustl(buffer))
  end function short

end module run_forecast
