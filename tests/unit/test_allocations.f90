! SPDX-License-Identifier: BSD-3-Clause
!> Nothing is allocated in a sweep, in a Newton step, in a time step, in a row of a table.
program test_allocations
  use base_files, only: remove_file
  use base_kinds, only: wp, zero
  use base_status, only: status_t, failed
  use base_strings, only: to_text
  use check, only: test_start, test_end, check_true, check_equal, seed_random
  use cone_blocks, only: delassus_blocks_t, dense_of_blocks
  use cone_dense, only: delassus_dense_t
  use cone_solver, only: solve_cone
  use cone_types, only: cone_options_t, cone_work_t, certificate_t, local_names, &
      size_cone_work, solver_anderson, solver_gs, solver_prox
  use count_allocations, only: allocations_so_far
  use deck_names, only: table_count, table_names
  use deck_parameter, only: override_t
  use output_tables, only: open_tables, close_tables, flush_tables
  use random_contacts, only: make_problem
  use run_data, only: run_t
  use run_loop, only: advance
  use run_setup, only: read_scene, set_up
  use run_tables, only: write_rows
  implicit none

  call test_start('allocations')
  call seed_random(4711)
  call test_counter()
  call test_iterations(2)
  call test_iterations(3)
  call test_step_solver()
  call test_newton()
  call test_steps('input/two_bars/theta.k', 400, 0.5_wp)
  call test_steps('input/two_bars/theta.k', 400, 0.6_wp)
  call test_steps('input/two_bars/newmark.k', 400, 0.5_wp)
  call test_steps('input/two_bars/newmark.k', 400, 0.6_wp)
  call test_steps('input/space/roofs.k', 60, 0.5_wp)
  call test_steps('input/space/oblique_block.k', 100, 0.5_wp)
  call test_rows('input/two_bars/newmark.k', 150)
  call test_rows('input/cards/every_keyword.k', 60)
  call test_end()

contains

  !> The counter sees an allocation.
  subroutine test_counter()
    real(wp), allocatable :: x(:)
    integer :: before
    before = allocations_so_far()
    allocate (x(1000 + before))
    x = zero
    call check_true(allocations_so_far() > before .and. size(x) > 0, 'an allocation is counted')
  end subroutine test_counter

  !> A problem that takes thousands of sweeps: 300 more of them, the same requests but for the
  !> words of the failure, whose digits vary.
  subroutine test_iterations(d)
    integer, intent(in) :: d
    type(delassus_blocks_t) :: w
    type(cone_options_t) :: options
    integer, parameter :: n = 40, message = 30
    real(wp) :: q(d, n), mu(n)
    integer :: k, few, many
    mu = 0.7_wp
    call make_problem(d, n, 1.0e8_wp, 1.0_wp, mu(1), w, q)
    options%solver = solver_gs
    options%tolerance = 1.0e-15_wp
    do k = 1, size(local_names)
      options%local = k
      few = requests(options, w, q, mu, 100)
      many = requests(options, w, q, mu, 400)
      call check_true(abs(many - few) < message, 'none in a sweep with '//local_names(k))
    end do
    options%solver = solver_anderson
    few = requests(options, w, q, mu, 40)
    many = requests(options, w, q, mu, 90)
    call check_true(abs(many - few) < message, 'none in an accelerated sweep')
  end subroutine test_iterations

  integer function requests(options, w, q, mu, sweeps)
    type(cone_options_t), intent(in) :: options
    type(delassus_blocks_t), intent(in) :: w
    real(wp), intent(in) :: q(:, :), mu(:)
    integer, intent(in) :: sweeps
    type(cone_options_t) :: limited
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: r(size(q, 1), size(q, 2))
    integer :: before
    limited = options
    limited%max_sweeps = sweeps
    r = zero
    before = allocations_so_far()
    call solve_cone(limited, w, q, mu, r, work, certificate, status)
    requests = allocations_so_far() - before
    call check_true(failed(status), to_text(sweeps)//' sweeps are all used')
  end function requests

  !> Newton with a proximal loop: more steps for a smaller tolerance, the same requests.
  subroutine test_newton()
    type(delassus_blocks_t) :: w
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: q(3, 12), mu(12), r(3, 12)
    integer :: k, before, got(2), steps(2)
    mu = 0.7_wp
    call size_cone_work(work, 3, 12)
    call make_problem(3, 12, 1.0e8_wp, 3.0_wp, mu(1), w, q)
    options%solver = solver_prox
    do k = 1, 2
      options%tolerance = merge(1.0e-2_wp, 1.0e-10_wp, k == 1)
      r = zero
      before = allocations_so_far()
      call solve_cone(options, w, q, mu, r, work, certificate, status)
      got(k) = allocations_so_far() - before
      steps(k) = certificate%newton_steps
    end do
    call check_true(steps(2) > steps(1), 'a smaller tolerance takes more Newton steps')
    call check_equal(got(2), got(1), 'Newton steps')
  end subroutine test_newton

  !> The solver of a step with its work space made: none at all, with a direct solve.
  subroutine test_step_solver()
    type(delassus_blocks_t) :: w
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: q(2, 10), mu(10), r(2, 10)
    type(delassus_dense_t) :: dense
    integer :: before, k
    mu = 0.3_wp
    call make_problem(2, 10, 1.0e2_wp, 1.0_wp, mu(1), w, q)
    call dense%resize(2, 10)
    call dense_of_blocks(w, dense%matrix)
    do k = 1, 2
      r = zero
      before = allocations_so_far()
      call solve_cone(options, dense, q, mu, r, work, certificate, status)
    end do
    call check_true(certificate%met .and. certificate%active_set_solves > 0, &
        'solved, with a direct solve')
    call check_equal(allocations_so_far() - before, 0, 'the solver of a step')
  end subroutine test_step_solver

  !> Steps of a scene before, in and after its impact; weight: theta and xi, or gamma.
  subroutine test_steps(deck, steps, weight)
    character(*), intent(in) :: deck
    integer, intent(in) :: steps
    real(wp), intent(in) :: weight
    type(run_t) :: run
    type(status_t) :: status
    character(:), allocatable :: name
    integer :: before, lists, quiet, allocated, bound, k
    name = deck//' '//to_text(weight)
    call start(deck, weight, run, status)
    call check_true(.not. failed(status), name//' is set up')
    call check_true(run%scheme%dissipates .eqv. weight > 0.5_wp, name//': energy of the scheme')
    quiet = 0
    allocated = 0
    do k = 1, steps
      before = allocations_so_far()
      lists = lists_made(run)
      call advance(run, status)
      ! A search, a new interface, new rows of W, the first solve make lists; a step makes none.
      if (lists_made(run) /= lists) cycle
      quiet = quiet + 1
      allocated = allocated + (allocations_so_far() - before)
    end do
    call check_true(run%contact%tally%solves > 0, name//' has its impact')
    ! In space W is another one in every step: two lists for it, some for a direct solve, none
    ! for a node (there are 25 in contact).
    bound = merge(8*quiet, 0, run%contact%dim == 3)
    call check_true(allocated <= bound, name//': none in a step')
    call check_true(quiet > steps/2, name//': most steps make no lists')
  end subroutine test_steps

  !> Rows of each table that a deck asks for, of so many nodes and elements as its buffer holds,
  !> after some steps.
  subroutine test_rows(deck, steps)
    character(*), intent(in) :: deck
    integer, intent(in) :: steps
    type(run_t) :: run
    type(status_t) :: status
    logical :: on(table_count)
    integer :: before, table, k
    call start(deck, 0.5_wp, run, status)
    run%model%requests%history_node = [(k, k=1, min(14, run%model%nodes))]
    run%model%requests%history_element = [(k, k=1, min(6, run%model%mesh%n))]
    call open_tables(run%tables, run%model, '.', run%scheme%has_acceleration, .false., status)
    do k = 1, steps
      call advance(run, status)
    end do
    call check_true(.not. failed(status) .and. run%contact%rows%n > 0, deck//' is in contact')
    on = run%tables%file%on
    do table = 1, table_count
      run%tables%file%on = .false.
      if (.not. on(table)) cycle
      run%tables%file(table)%on = .true.
      call write_rows(run, .true., status)
      call flush_tables(run%tables, status)
      before = allocations_so_far()
      call write_rows(run, .true., status)
      call check_equal(allocations_so_far() - before, 0, deck//': a row of '// &
          trim(table_names(table)))
    end do
    run%tables%file%on = on
    call close_tables(run%tables, 'done', 1, status)
    do table = 1, table_count
      if (on(table)) call remove_file(run%tables%file(table)%path)
    end do
  end subroutine test_rows

  !> A scene of the deck, with steps of 1e-4 where they are a parameter.
  subroutine start(deck, weight, run, status)
    character(*), intent(in) :: deck
    real(wp), intent(in) :: weight
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    type(override_t) :: overrides(1)
    overrides(1)%name = 'dt'
    overrides(1)%value = '1e-4'
    call read_scene(deck, overrides(:merge(0, 1, index(deck, 'space') > 0)), run, status)
    run%model%controls%theta = weight
    run%model%controls%xi = weight
    run%model%controls%gamma = weight
    run%model%controls%beta = 0.25_wp*(weight + 0.5_wp)**2
    call set_up(run, status)
  end subroutine start

  !> What makes lists, counted.
  integer function lists_made(run)
    type(run_t), intent(in) :: run
    associate (c => run%contact%tally)
      lists_made = c%searches + c%interface_changes + min(1, c%solves)
      ! In space places move in every step; rows of another number make lists of W.
      if (run%contact%dim == 2) lists_made = lists_made + c%w_builds
      if (run%contact%dim == 3) lists_made = lists_made + 1000*run%contact%n
    end associate
  end function lists_made

end program test_allocations
