! SPDX-License-Identifier: BSD-3-Clause
!> AUTO against every single solver on generated packings of rigid bodies and on FCLIB files:
!> products with W and processor seconds of each solve, all in one process.
!>   auto_against_all [--first K] [--packings N] [--tol T] [--max-time S] [--write FOLDER]
!>                   [--solvers AUTO,GS,...] [FILE.hdf5 ...]
!> A solver runs no longer than 1.2 times the fastest before it, unless --all yes.
!> A line a run; then how often AUTO is within 1.5 and 3 times the best of the single solvers,
!> in products or seconds, times below 4 ms being equal. A problem is judged where some solver
!> met the tolerance. Packings K to N are made.
program auto_against_all
  use, intrinsic :: iso_fortran_env, only: output_unit
  use base_kinds, only: wp, zero
  use base_status, only: status_t, failed, status_text
  use base_strings, only: to_text
  use cone_solver, only: solve_cone
  use cone_types, only: cone_options_t, cone_work_t, certificate_t, solver_names, &
      solver_auto, solver_gs, solver_prox, solver_newton, solver_anderson, solver_nesterov
  use fclib_problem, only: problem_t, read_problem, write_problem
  use hdf5_file, only: start_library
  use packed_contacts, only: packing_t, make_packing, packing_kinds
  implicit none
  real(wp), parameter :: equal = 4.0e-3_wp, least_limit = 2.0e-2_wp
  real(wp), parameter :: frictions(6) = [0.1_wp, 0.2_wp, 0.3_wp, 0.5_wp, 0.7_wp, 1.0_wp]
  real(wp), parameter :: motions(3) = [zero, 1.0_wp, 10.0_wp]
  real(wp), parameter :: reaches(3) = [1.0e-3_wp, 1.0e-2_wp, 4.0e-2_wp]
  type(cone_options_t) :: options
  !> The fastest first, so that others need not run to their end.
  integer, parameter :: turn(6) = [solver_auto, solver_nesterov, solver_anderson, &
      solver_newton, solver_gs, solver_prox]
  character(:), allocatable :: folder, solvers
  real(wp) :: most_seconds
  logical :: all_runs
  integer :: first, packings, first_file, k, problems, judged, near, far, missed
  options%tolerance = 1.0e-8_wp
  options%max_sweeps = 100000
  most_seconds = 20.0_wp
  first = 1
  packings = 200
  problems = 0
  all_runs = .false.
  solvers = 'AUTO,GS,PROX,NEWTON,ANDERSON,NESTEROV'
  judged = 0
  near = 0
  far = 0
  missed = 0
  call start_library()
  call read_arguments()
  write (*, '(a,es8.1)') 'tolerance', options%tolerance
  write (*, '(a)') 'problem d contacts solver  products      ms   error  sweeps newton'
  do k = first, packings
    call run_packing(k)
  end do
  do k = first_file, command_argument_count()
    call run_file(argument(k))
  end do
  write (*, '(5(a,i0))') 'problems ', problems, ', judged ', judged, &
      ', AUTO within 1.5 of the best ', near, ', beyond 3 ', far, ', missed ', missed

contains

  subroutine read_arguments()
    character(:), allocatable :: word
    first_file = 1
    do while (first_file < command_argument_count())
      word = argument(first_file)
      if (word(1:2) /= '--') exit
      select case (word)
      case ('--first')
        first = nint(number(argument(first_file + 1)))
      case ('--packings')
        packings = nint(number(argument(first_file + 1)))
      case ('--tol')
        options%tolerance = number(argument(first_file + 1))
      case ('--max-time')
        most_seconds = number(argument(first_file + 1))
      case ('--solvers')
        solvers = argument(first_file + 1)
      case ('--all')
        all_runs = argument(first_file + 1) == 'yes'
      case ('--write')
        folder = argument(first_file + 1)
      case default
        error stop 'unknown option'
      end select
      first_file = first_file + 2
    end do
  end subroutine read_arguments

  real(wp) function number(word)
    character(*), intent(in) :: word
    read (word, *) number
  end function number

  function argument(i) result(word)
    integer, intent(in) :: i
    character(:), allocatable :: word
    integer :: n
    call get_command_argument(i, length=n)
    allocate (character(max(2, n)) :: word)
    call get_command_argument(i, word)
  end function argument

  !> Packing k: every kind, dimension, friction, motion, reach; contacts from 50 to 2000.
  subroutine run_packing(k)
    integer, intent(in) :: k
    type(packing_t) :: packing
    type(problem_t) :: problem
    type(status_t) :: status
    real(wp) :: contacts
    packing%kind = packing_kinds(1 + mod(k, 3))
    packing%d = merge(2, 3, mod(k/3, 4) == 3)
    packing%seed = k
    packing%mu = frictions(1 + mod(k/2, 6))
    packing%motion = motions(1 + mod(k/5, 3))
    packing%reach = reaches(1 + mod(k/7, 3))
    contacts = 50.0_wp*40.0_wp**modulo(0.6180339887_wp*k, 1.0_wp)
    packing%bodies = nint(contacts/per_body(packing))
    call make_packing(packing, problem%w, problem%q, problem%mu)
    problem%d = packing%d
    problem%contacts = size(problem%mu)
    problem%form = '/fclib_local'
    if (allocated(folder)) then
      call write_problem(folder//'/'//name_of(k, packing)//'.hdf5', problem, status)
      if (failed(status)) write (*, '(a)') status_text(status)
    else
      call run_problem(name_of(k, packing), problem)
    end if
  end subroutine run_packing

  !> Contacts of a body, about.
  pure real(wp) function per_body(packing)
    type(packing_t), intent(in) :: packing
    per_body = merge(2.0_wp, 2.7_wp, packing%d == 2)
    if (packing%kind == 'ROCKS') per_body = merge(2.0_wp, 4.0_wp, packing%d == 2)
    if (packing%kind == 'BRICKS') per_body = merge(4.0_wp, 8.0_wp, packing%d == 2)
  end function per_body

  function name_of(k, packing) result(name)
    integer, intent(in) :: k
    type(packing_t), intent(in) :: packing
    character(:), allocatable :: name
    name = trim(packing%kind)//'-'//to_text(packing%d)//'-'//to_text(k)
  end function name_of

  subroutine run_file(path)
    character(*), intent(in) :: path
    type(problem_t) :: problem
    type(status_t) :: status
    call read_problem(path, problem, status)
    if (failed(status)) then
      write (*, '(a)') status_text(status)
    else
      call run_problem(path(index(path, '/', back=.true.) + 1:index(path, '.') - 1), problem)
    end if
  end subroutine run_file

  !> Every solver on blocks, and the judgement of AUTO.
  subroutine run_problem(name, problem)
    character(*), intent(in) :: name
    type(problem_t), intent(in) :: problem
    real(wp), dimension(solver_nesterov) :: products, seconds
    logical :: solved(solver_nesterov)
    real(wp) :: ratio, limit
    integer :: k, i
    problems = problems + 1
    solved = .false.
    products = huge(zero)
    seconds = huge(zero)
    do i = 1, size(turn)
      k = turn(i)
      if (index(','//solvers//',', ','//trim(solver_names(k))//',') == 0) cycle
      limit = most_seconds
      if (.not. all_runs) limit = min(limit, max(least_limit, 1.2_wp*minval(seconds, solved)))
      call run(name, problem, k, limit, products(k), seconds(k), solved(k))
    end do
    if (.not. any(solved)) return
    judged = judged + 1
    ratio = 1.0e3_wp
    if (solved(solver_auto)) ratio = min( &
        products(1)/minval(products(2:), mask=solved(2:)), &
        max(equal, seconds(1))/max(equal, minval(seconds(2:), mask=solved(2:))))
    if (.not. solved(solver_auto)) missed = missed + 1
    if (ratio <= 1.5_wp) near = near + 1
    if (ratio > 3.0_wp) far = far + 1
    write (*, '(a,a,f8.2,f8.2,f8.2)') trim(name), ' ratio', ratio, &
        products(1)/minval(products(2:), mask=solved(2:)), &
        max(equal, seconds(1))/max(equal, minval(seconds(2:), mask=solved(2:)))
    flush (output_unit)
  end subroutine run_problem

  subroutine run(name, problem, solver, limit, products, seconds, solved)
    character(*), intent(in) :: name
    type(problem_t), intent(in) :: problem
    integer, intent(in) :: solver
    real(wp), intent(in) :: limit
    real(wp), intent(out) :: products, seconds
    logical, intent(out) :: solved
    type(cone_options_t) :: own
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: r(problem%d, problem%contacts), start, finish
    own = options
    own%solver = solver
    r = zero
    call cpu_time(start)
    own%deadline = start + limit
    call solve_cone(own, problem%w, problem%q, problem%mu, r, work, certificate, status)
    call cpu_time(finish)
    seconds = finish - start
    products = certificate%products
    solved = .not. failed(status)
    write (*, '(a,i2,i6,1x,a,f10.0,f10.1,es9.1,2i8,1x,a)') trim(name), problem%d, &
        problem%contacts, solver_names(solver), products, 1.0e3_wp*seconds, &
        certificate%error, certificate%sweeps, certificate%newton_steps, &
        merge('   ', 'NOT', solved)
  end subroutine run

end program auto_against_all
