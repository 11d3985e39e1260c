! SPDX-License-Identifier: BSD-3-Clause
!> What a step costs beside what it cannot avoid: step_cost DECK. Interleaved in one process, so that
!> a noisy machine disturbs all alike: whole steps; the forward and backward pass of the factor; a
!> plain read of the factor's numbers and indices, once forward and once backward; the products with
!> mass and stiffness. Prints medians in microseconds on one line:
!>   dofs  factor bytes  step  passes  read  products
program step_cost
  use, intrinsic :: iso_fortran_env, only: int64
  use assembly_forces, only: subtract_internal_force
  use assembly_system, only: multiply_mass
  use base_kinds, only: wp, one, zero
  use base_sort, only: sort_order
  use base_status, only: status_t, failed, status_text
  use deck_parameter, only: override_t
  use linalg_ldlt, only: ldlt_t
  use linalg_solver, only: solve_whole
  use run_data, only: run_t
  use run_loop, only: advance
  use run_setup, only: read_scene, set_up
  implicit none
  integer, parameter :: rounds = 21
  type(run_t), allocatable :: run
  type(override_t) :: none(0)
  type(status_t) :: status
  character(1024) :: deck
  real(wp) :: cost(rounds, 4), total
  real(wp), allocatable :: f(:, :), x(:, :)
  integer :: k, repeats

  call get_command_argument(1, deck)
  allocate (run)
  call run%timers%start()
  call read_scene(trim(deck), none, run, status)
  if (.not. failed(status)) call set_up(run, status)
  if (failed(status)) then
    print '(a)', status_text(status)
    stop 1
  end if
  allocate (f(2, run%system%n), x(2, run%system%n))
  f = one
  repeats = max(1, 400000/run%system%n)
  total = zero
  do k = 1, rounds
    cost(k, 1) = time_steps()
    cost(k, 2) = time_passes()
    cost(k, 3) = time_reads()
    cost(k, 4) = time_products()
  end do
  print '(i9,i12,4f12.2,es9.1)', 2*run%system%n, run%solver%info%factor_bytes, &
      (median(cost(:, k)), k=1, 4), total*1.0e-300_wp

contains

  real(wp) function since(start)
    integer(int64), intent(in) :: start
    integer(int64) :: now, rate
    call system_clock(now, rate)
    since = 1.0e6_wp*real(now - start, wp)/real(rate, wp)/repeats
  end function since

  real(wp) function time_steps()
    integer(int64) :: start
    integer :: i
    call system_clock(start)
    do i = 1, repeats
      call advance(run, status)
    end do
    time_steps = since(start)
    if (failed(status)) print '(a)', status_text(status)
  end function time_steps

  real(wp) function time_passes()
    integer(int64) :: start
    integer :: i
    call system_clock(start)
    do i = 1, repeats
      call solve_whole(run%solver, f, x)
    end do
    time_passes = since(start)
    total = total + x(1, 1)
  end function time_passes

  real(wp) function time_reads()
    integer(int64) :: start
    integer :: i
    call system_clock(start)
    select type (s => run%solver)
    type is (ldlt_t)
      do i = 1, repeats
        total = total + read_factor(size(s%row), s%l, s%row, 1) &
            + read_factor(size(s%row), s%l, s%row, -1)
      end do
    end select
    time_reads = since(start)
  end function time_reads

  pure real(wp) function read_factor(n, l, row, direction)
    integer, intent(in) :: n, direction
    real(wp), intent(in) :: l(4, n)
    integer, intent(in) :: row(n)
    real(wp) :: a(4)
    integer :: i, k, m
    a = zero
    m = 0
    do i = 1, n
      k = merge(i, n + 1 - i, direction > 0)
      a = a + l(:, k)
      m = ieor(m, row(k))
    end do
    read_factor = sum(a) + m
  end function read_factor

  real(wp) function time_products()
    integer(int64) :: start
    integer :: i
    call system_clock(start)
    do i = 1, repeats
      x = zero
      call multiply_mass(run%system, one, f, x)
      call subtract_internal_force(run%system, one, f, x)
    end do
    time_products = since(start)
    total = total + x(1, 1)
  end function time_products

  pure real(wp) function median(values)
    real(wp), intent(in) :: values(:)
    integer :: order(size(values))
    call sort_order(nint(1000.0_wp*values), order)
    median = values(order((size(values) + 1)/2))
  end function median

end program step_cost
