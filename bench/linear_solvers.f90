! SPDX-License-Identifier: BSD-3-Clause
!> Processor time of a linear solver on a square (d = 2) or a cube (d = 3) of n nodes a side, all
!> nodes of an element coupled, with or without one face kept last:
!>   build/release/bench/linear_solvers ENGINE n d [FACE | WHOLE [threads]]
!> Prints size and work of the factor; seconds of analysis and factor, its rate, milliseconds of
!> one solve (both passes and the Schur complement; the least of several), the residual. With
!> threads the time is that of the slowest thread and of what one thread does alone; waiting
!> threads have to sleep: OMP_WAIT_POLICY=passive.
program linear_solvers
  use base_kinds, only: wp
  use base_status, only: status_t, failed, status_text
  use grid_matrices, only: make_graph, fill_matrix, remainder
  use linalg_graph, only: graph_t, block_matrix_t
  use linalg_registry, only: make_solver
  use linalg_solver, only: solver_t, solver_options_t, solve_whole
  use thread_clock, only: path_seconds
  implicit none
  class(solver_t), allocatable :: solver
  type(graph_t) :: graph
  type(block_matrix_t) :: matrix
  type(status_t) :: status
  type(solver_options_t) :: options
  real(wp), allocatable :: b(:, :), x(:, :)
  real(wp) :: analysis, factor, passes, gigaflops, begin
  character(16) :: word(5)
  integer :: n, d, k, repeats

  do k = 1, 5
    call get_command_argument(k, word(k))
  end do
  options%engine = trim(word(1))
  read (word(2), *) n
  read (word(3), *) d
  if (word(5) /= '') read (word(5), *) options%threads
  call make_graph(n, d, graph)
  call fill_matrix(graph, d, matrix)
  allocate (b(d, graph%n), x(d, graph%n))
  call random_number(b)
  call make_solver(options, solver, status)
  analysis = seconds()
  call solver%analyse(graph, d, [(k, k=1, merge(n**(d - 1), 0, word(4) == 'FACE'))], status)
  analysis = seconds() - analysis
  factor = huge(factor)
  do k = 1, 3
    begin = seconds()
    call solver%factor(graph, matrix, status)
    factor = min(factor, seconds() - begin)
  end do
  if (failed(status)) then
    print '(a)', status_text(status)
    stop 1
  end if
  repeats = max(10, int(2.0e8_wp/(real(solver%info%factor_bytes, wp) + 1.0_wp)))
  call solve_whole(solver, b, x)
  passes = huge(passes)
  do k = 1, repeats
    begin = seconds()
    call solve_whole(solver, b, x)
    passes = min(passes, seconds() - begin)
  end do
  gigaflops = 2.0e-9_wp*d**3*real(solver%info%multiplications, wp)
  print '(a, i0, 3a, f0.3, a, f0.1, a)', 'dofs ', d*graph%n, ', order ', solver%info%order, &
      ', ', gigaflops, ' Gflop, factor ', 1.0e-6_wp*real(solver%info%factor_bytes, wp), ' MB'
  print '(2(a, f0.3), a, f0.1, a, f0.4, a, es7.1)', 'analysis ', analysis, ' s, factor ', factor, &
      ' s (', gigaflops/factor, ' Gflop/s), solve ', 1.0e3_wp*passes, ' ms, residual ', &
      norm2(remainder(graph, matrix, b, x))/norm2(b)

contains

  real(wp) function seconds()
    seconds = path_seconds()
  end function seconds

end program linear_solvers
