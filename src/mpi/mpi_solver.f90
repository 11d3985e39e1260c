! SPDX-License-Identifier: BSD-3-Clause
!> The linear solver MUMPS on the first rank: the other ranks do their part when it asks. The
!> entries of the matrix are with the ranks that have its elements, or, where the first rank has
!> made the whole matrix (finite deformation), with that. Right-hand sides, solutions and the
!> contact block are with the first rank.
module mpi_solver
  use base_checks, only: checks_on
  use base_kinds, only: wp, zero, i8
  use base_status, only: status_t, fail, failed, status_numerical
  use base_strings, only: to_text
  use linalg_graph, only: graph_t, block_matrix_t
  use linalg_solver, only: solver_t, check_graph, check_vectors
  use mpi_domain, only: domain_t
  use mpi_engine, only: engine_t, open_engine, close_engine, analyse_engine, factor_engine, &
      condense, expand
  use mpi_link, only: link_t, header_length, send_numbers
  use mpi_tasks, only: task_analyse, task_factor, task_condense, task_expand, task_close, &
      most_engines
  implicit none
  private

  type, extends(solver_t), public :: mumps_t
    type(link_t) :: link
    type(domain_t), pointer :: domain => null()   !< of the first rank
    logical, pointer :: is_used(:) => null()      !< (most_engines) by which solver
    integer :: id = 0                             !< its number among them; 0 = none yet
    logical :: is_shared = .false.                !< the ranks have the entries
    type(engine_t) :: engine
  contains
    procedure :: analyse => mumps_analyse
    procedure :: factor => mumps_factor
    procedure :: forward => mumps_forward
    procedure :: backward => mumps_backward
    final :: mumps_close
  end type mumps_t

contains

  !> Order here, symbolic factor on all ranks.
  subroutine mumps_analyse(this, graph, d, last, status)
    class(mumps_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: d
    integer, intent(in) :: last(:)
    type(status_t), intent(inout) :: status
    if (checks_on) call check_graph(graph, last, 'mumps_analyse')
    this%n = graph%n
    this%d = d
    this%n_interface = size(last)
    call this%find_order(graph, last, trim(this%options%order), status)
    if (failed(status)) return
    call this%schur%plan_whole(d, size(last))
    allocate (this%schur%block(this%schur%bodies))
    call analyse_all(this, graph, allocated(this%domain%matrix%value), status)
  end subroutine mumps_analyse

  !> The symbolic factor for entries where they are.
  subroutine analyse_all(this, graph, is_shared, status)
    class(mumps_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    logical, intent(in) :: is_shared
    type(status_t), intent(inout) :: status
    integer :: info(2), k
    this%is_shared = is_shared
    if (this%id == 0) then
      this%id = findloc(this%is_used, .false., dim=1)
      if (this%id > most_engines .or. this%id == 0) then
        call fail(status, status_numerical, 'more than '//to_text(most_engines)//' factors')
        return
      end if
      this%is_used(this%id) = .true.
    end if
    call ask(this, task_analyse)
    if (.not. associated(this%engine%mumps)) call open_engine(this%link, this%engine)
    if (is_shared) then
      call analyse_engine(this%engine, this%n, this%d, this%domain%system%graph, &
          this%domain%node, this%n_interface, this%order, info)
    else
      call analyse_engine(this%engine, this%n, this%d, graph, [(k, k=1, this%n)], &
          this%n_interface, this%order, info)
    end if
    call judge(info, status)
    this%info%factor_bytes = this%engine%mumps%infog(20)
    if (this%info%factor_bytes < 0_i8) &
        this%info%factor_bytes = -1000000_i8*this%info%factor_bytes
    this%info%factor_bytes = 8_i8*this%info%factor_bytes
  end subroutine analyse_all

  !> A task for all other ranks.
  subroutine ask(this, task)
    class(mumps_t), intent(in) :: this
    integer, intent(in) :: task
    real(wp) :: header(header_length)
    integer :: r
    header = zero
    header(:6) = [real(wp) :: task, this%id, merge(1, 0, this%is_shared), this%n, this%d, &
        this%n_interface]
    do r = 1, this%link%ranks - 1
      call send_numbers(this%link, r, header_length, header)
    end do
  end subroutine ask

  !> What MUMPS says of a phase.
  subroutine judge(info, status)
    integer, intent(in) :: info(2)
    type(status_t), intent(inout) :: status
    select case (info(1))
    case (0:)
      continue
    case (-10, -40)
      call fail(status, status_numerical, 'lost pivot: the effective matrix is not '// &
          'positive definite', hint='check mass, stiffness and time step')
    case (-7, -13, -19, -5)
      call fail(status, status_numerical, 'MUMPS lacks memory (code '//to_text(info(1))// &
          ', '//to_text(info(2))//')', hint='more ranks on more machines need less on each')
    case default
      call fail(status, status_numerical, 'MUMPS failed with code '//to_text(info(1))//', '// &
          to_text(info(2)), hint='its manual lists the codes; ENGINE AUTO in the serial '// &
          'program does without it')
    end select
  end subroutine judge

  !> Numerical factor; the entries of shared matrices are gone then.
  subroutine mumps_factor(this, graph, matrix, status)
    class(mumps_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    type(status_t), intent(inout) :: status
    type(block_matrix_t) :: whole
    real(wp), allocatable :: block(:, :)
    integer :: info(2)
    if (this%is_shared .eqv. allocated(matrix%value)) &
        call analyse_all(this, graph, .not. allocated(matrix%value), status)
    if (failed(status)) return
    call ask(this, task_factor)
    if (this%is_shared) then
      call factor_engine(this%engine, this%d, this%domain%system%graph, this%domain%matrix, &
          .false., block, info)
    else
      whole = matrix
      call factor_engine(this%engine, this%d, graph, whole, .false., block, info)
    end if
    call judge(info, status)
    if (failed(status)) return
    if (this%n_interface == 0) return
    call move_alloc(block, this%schur%block(1)%l)
    call this%schur%factor(status)
  end subroutine mumps_factor

  subroutine mumps_forward(this, b, b_interface)
    class(mumps_t), intent(inout) :: this
    real(wp), intent(in) :: b(:, :)
    real(wp), intent(out) :: b_interface(:, :)
    if (checks_on) call check_vectors(this, b, b_interface, 'mumps_forward')
    call ask(this, task_condense)
    call condense(this%engine, b, b_interface)
  end subroutine mumps_forward

  subroutine mumps_backward(this, x_interface, x)
    class(mumps_t), intent(inout) :: this
    real(wp), intent(in) :: x_interface(:, :)
    real(wp), intent(out) :: x(:, :)
    if (checks_on) call check_vectors(this, x, x_interface, 'mumps_backward')
    call ask(this, task_expand)
    call expand(this%engine, x_interface, x)
  end subroutine mumps_backward

  !> Gives the memory of all ranks back.
  subroutine mumps_close(this)
    type(mumps_t), intent(inout) :: this
    if (this%id == 0) return
    call ask(this, task_close)
    call close_engine(this%engine)
    this%is_used(this%id) = .false.
    this%id = 0
  end subroutine mumps_close

end module mpi_solver
