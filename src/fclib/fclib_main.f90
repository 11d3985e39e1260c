! SPDX-License-Identifier: BSD-3-Clause
!> bipact-fclib PROBLEM.hdf5 [--tol T] [--solver S] [--max-time S] [-o FILE]
program fclib_main
  use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
  use base_kinds, only: wp, zero
  use base_status, only: status_t, fail, failed, status_text, status_deck
  use base_strings, only: to_text, join
  use base_system, only: leave
  use base_version, only: version
  use cone_solver, only: solve_cone
  use cone_types, only: cone_options_t, cone_work_t, certificate_t, find_solver, local_solver, &
      local_names, solver_names
  use hdf5_file, only: start_library
  use fclib_problem, only: problem_t, read_problem, write_problem, write_solution
  implicit none
  character(*), parameter :: help_hint = 'bipact-fclib --help'
  type(cone_options_t) :: options
  type(problem_t) :: problem
  type(cone_work_t) :: work
  type(certificate_t) :: certificate
  type(status_t) :: status, answer
  character(:), allocatable :: input, output, converted
  real(wp), allocatable :: r(:, :)
  real(wp) :: start, finish, seconds

  options%tolerance = 1.0e-8_wp
  options%warm_start = .false.
  options%max_sweeps = 100000
  seconds = huge(seconds)
  call start_library()
  call read_arguments()
  if (.not. failed(status)) call read_problem(input, problem, status)
  if (.not. failed(status) .and. allocated(converted)) then
    call write_problem(converted, problem, status)
  else if (.not. failed(status)) then
    allocate (r(problem%d, problem%contacts))
    r = zero
    call cpu_time(start)
    options%deadline = start + seconds
    call solve_cone(options, problem%w, problem%q, problem%mu, r, work, certificate, answer)
    call cpu_time(finish)
    write (output_unit, '(a)') &
        '# problem contacts dofs solver sweeps newton cpu error error2018 eta'
    write (output_unit, '(a,2(1x,i0),1x,a,2(1x,i0),es11.3,3es12.3e3)') last_part(input), &
        problem%contacts, size(r), trim(solver_names(options%solver)), certificate%sweeps, &
        certificate%newton_steps, finish - start, certificate%error, certificate%error2018, &
        certificate%eta
    if (certificate%wedged > 0) write (error_unit, '(a)') 'bipact-fclib: warning: '// &
        to_text(certificate%wedged)//' contacts wedge (mu |W_nt| > W_nn): several answers'// &
        ' may exist; the first is contact '//to_text(certificate%first_wedged)
    if (allocated(output)) call write_solution(output, problem, r, work%u, &
        [certificate%error, certificate%error2018, certificate%eta], status)
    if (.not. failed(status) .and. failed(answer)) status = answer
  end if
  if (failed(status)) write (error_unit, '(a)') 'bipact-fclib: '//status_text(status)
  call leave(status%code)

contains

  subroutine read_arguments()
    character(:), allocatable :: word
    integer :: i
    i = 1
    do while (i <= command_argument_count())
      word = argument(i)
      select case (word)
      case ('--help', '-h')
        call write_usage()
        call leave(0)
      case ('--version')
        write (output_unit, '(a)') 'bipact-fclib '//version
        call leave(0)
      case ('--tol')
        call read_number(word, argument(i + 1), options%tolerance)
        i = i + 1
      case ('--max-time')
        call read_number(word, argument(i + 1), seconds)
        i = i + 1
      case ('--solver')
        options%solver = find_solver(argument(i + 1))
        if (options%solver == 0) call fail(status, status_deck, &
            'unknown solver "'//argument(i + 1)//'"', hint=help_hint)
        i = i + 1
      case ('--local')
        options%local = local_solver(argument(i + 1))
        if (options%local == 0) call fail(status, status_deck, &
            'unknown local solver "'//argument(i + 1)//'"', hint=help_hint)
        i = i + 1
      case ('--convert')
        converted = argument(i + 1)
        i = i + 1
      case ('-o')
        output = argument(i + 1)
        i = i + 1
      case default
        if (word(1:1) == '-' .or. allocated(input)) call fail(status, status_deck, &
            'unknown argument "'//word//'"', hint=help_hint)
        input = word
      end select
      i = i + 1
    end do
    if (.not. allocated(input)) call fail(status, status_deck, 'no problem was named', &
        hint=help_hint)
  end subroutine read_arguments

  !> The command line, in the layout of bipact --help, from which the manual page is made too.
  subroutine write_usage()
    character(84) :: line(20)
    integer :: k
    line = [character(84) :: &
        'bipact-fclib PROBLEM.hdf5 [--tol T] [--solver S] [--local L]', &
        '             [--max-time SECONDS] [-o FILE]', &
        'bipact-fclib PROBLEM --convert FILE.hdf5', &
        'bipact-fclib --help | --version', '', &
        '  PROBLEM              a contact problem: FCLIB (HDF5), or contact_N.txt of bipact', &
        '  --tol T              tolerance on error and eta; 1e-8 unless given', &
        '  --solver S           '//join(solver_names, ', '), &
        '  --local L            solver of one contact in a sweep: '//join(local_names, ', '), &
        '  --max-time SECONDS   gives up after that much processor time', &
        '  -o FILE              writes /solution (u, r, v) and /errors (HDF5)', &
        '  --convert FILE.hdf5  writes the problem as FCLIB; nothing is solved', &
        '  --help               prints this', &
        '  --version            prints the version', '', &
        'exit code: 0 solved, 1 not to tolerance, 2 an argument or a problem that cannot', &
        '           be used, 3 file or system error', '', &
        'Prints a line of names and a line of figures: error and eta of the solution are', &
        'those of doc/contact-solver.md.']
    do k = 1, size(line)
      write (output_unit, '(a)') trim(line(k))
    end do
  end subroutine write_usage

  subroutine read_number(name, word, value)
    character(*), intent(in) :: name, word
    real(wp), intent(out) :: value
    integer :: error
    read (word, *, iostat=error) value
    if (error /= 0) value = -1.0_wp
    if (.not. value > zero) call fail(status, status_deck, &
        name//': expected a positive number, found "'//word//'"', hint=help_hint)
  end subroutine read_number

  function argument(i) result(word)
    integer, intent(in) :: i
    character(:), allocatable :: word
    integer :: n
    call get_command_argument(i, length=n)
    allocate (character(max(1, n)) :: word)
    word(:) = ' '
    if (n > 0) call get_command_argument(i, word)
  end function argument

  function last_part(path) result(name)
    character(*), intent(in) :: path
    character(:), allocatable :: name
    name = path(index(path, '/', back=.true.) + 1:)
  end function last_part

end program fclib_main
