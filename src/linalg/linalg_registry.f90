! SPDX-License-Identifier: BSD-3-Clause
!> The linear solvers by name, and the one place that has the names. To add one: its file, and
!> here its `use` and its line in find_engine; reader, documentation and tests follow.
module linalg_registry
  use base_status, only: status_t, fail, status_deck
  use base_strings, only: join
  use linalg_cg, only: cg_t
  use linalg_diagonal, only: diagonal_t
  use linalg_ldlt, only: ldlt_t
  use linalg_skyline, only: skyline_t
  use linalg_solver, only: solver_t, solver_options_t, name_length
  use linalg_supernodal, only: supernodal_t
  implicit none
  private
  public :: make_solver, engine_names

  !> The engine of diagonal matrices, which takes no other: chosen by what makes the matrix.
  character(*), parameter, public :: engine_diagonal = 'DIAGONAL'
  !> The engine of several ranks, which bin/bipact-mpi alone has.
  character(*), parameter, public :: engine_ranks = 'MUMPS'

contains

  !> A solver of the wanted engine, with its options; fails for an unknown name.
  subroutine make_solver(options, solver, status)
    type(solver_options_t), intent(in) :: options
    class(solver_t), allocatable, intent(out) :: solver
    type(status_t), intent(inout) :: status
    character(name_length), allocatable :: names(:)
    call find_engine(options%engine, names, solver)
    if (allocated(solver)) then
      solver%options = options
    else if (options%engine == engine_ranks) then
      call fail(status, status_deck, 'solver engine "'//engine_ranks//'" is not in this '// &
          'program', hint='run bin/bipact-mpi, which has it, or choose ENGINE AUTO')
    else
      call fail(status, status_deck, 'solver engine "'//trim(options%engine)// &
          '" is not available', hint='choose one of AUTO, '//join(names, ', '))
    end if
  end subroutine make_solver

  !> The names of all engines that this program has.
  subroutine engine_names(names)
    character(name_length), allocatable, intent(out) :: names(:)
    class(solver_t), allocatable :: none
    call find_engine('', names, none)
  end subroutine engine_names

  !> Names all engines and makes the wanted one; AUTO is the first. solver is not allocated for
  !> an unknown name.
  subroutine find_engine(wanted, names, solver)
    character(*), intent(in) :: wanted
    character(name_length), allocatable, intent(out) :: names(:)
    class(solver_t), allocatable, intent(out) :: solver
    allocate (names(0))
    call offer('LDLT', ldlt_t())
    call offer('SKYLINE', skyline_t())
    call offer('SUPERNODAL', supernodal_t())
    call offer('CG', cg_t())
    call offer(engine_diagonal, diagonal_t(takes_diagonal=.true.))
  contains
    subroutine offer(name, engine)
      character(*), intent(in) :: name
      class(solver_t), intent(in) :: engine
      names = [character(name_length) :: names, name]
      if (allocated(solver) .or. (wanted /= name .and. wanted /= 'AUTO')) return
      allocate (solver, mold=engine)
      solver%takes_diagonal = engine%takes_diagonal
      solver%info%engine = name
    end subroutine offer
  end subroutine find_engine

end module linalg_registry
