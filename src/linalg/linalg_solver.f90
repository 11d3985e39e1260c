! SPDX-License-Identifier: BSD-3-Clause
!> What every direct solver of A x = b offers, with the dofs of chosen nodes (the contact block)
!> last:
!>   analyse -> factor -> [forward -> solve_schur ... -> backward] per step.
!> forward reduces b to the block: S x_interface = b_interface with the Schur complement S; all
!> contact iterations happen there; backward gives the rest of x. A has blocks of d x d for each
!> pair of nodes, d = 2 in the plane and 3 in space. Vectors are (d, n) in node order, those of
!> the block (d, m) in the order of `last`.
module linalg_solver
  use base_checks, only: checks_on, assert, assert_shape
  use base_kinds, only: wp, i8, zero
  use base_status, only: status_t, fail, status_file, status_numerical
  use base_strings, only: to_text
  use base_system, only: machine_memory
  use linalg_graph, only: graph_t, block_matrix_t
  use linalg_bodies, only: schur_t
  use linalg_order, only: choose_order
  implicit none
  private

  integer, parameter, public :: name_length = 10   !< of an engine or an order

  type, public :: solver_options_t
    character(name_length) :: engine = 'AUTO'
    character(name_length) :: order = 'AUTO'
    character(5) :: contact_storage = 'AUTO'   !< of W: AUTO, DENSE, BLOCK, NONE
    integer :: block_limit = 600   !< largest contact block (dofs) taken without a note
    integer :: threads = 1
    !> A pivot below this share of its own diagonal before elimination counts as null: its
    !> unknown is set to zero. 0 = null pivots are an error.
    real(wp) :: null_pivot = 0.0_wp
    !> Of engines that iterate: where they stop, of the right-hand side, and after how many.
    real(wp) :: tolerance = 1.0e-12_wp
    integer :: most_iterations = 1000
  end type solver_options_t

  type, public :: solver_info_t
    character(:), allocatable :: engine
    character(:), allocatable :: order
    integer(i8) :: multiplications = 0_i8  !< per factorisation, in node blocks
    integer(i8) :: factor_bytes = 0_i8
    integer(i8) :: front_bytes = 0_i8      !< beside it while it is made
    integer :: null_pivots = 0
    logical :: wide = .false.              !< products by vectors of four numbers
    integer(i8) :: iterations = 0_i8       !< of all solves so far, where an engine iterates
    integer :: unconverged = 0             !< solves since the factor that did not get there
  end type solver_info_t

  type, abstract, public :: solver_t
    type(solver_options_t) :: options
    type(solver_info_t) :: info
    integer :: n = 0
    integer :: d = 2                  !< unknowns of a node
    integer :: n_interface = 0
    logical :: takes_diagonal = .false.   !< `diagonal` of a matrix, and no other matrix
    integer, allocatable :: order(:)  !< (n) new -> old
    logical :: has_order = .false.    !< order is known before analyse, which takes it
    type(schur_t) :: schur            !< Schur complement S of the last nodes, by bodies
  contains
    procedure(analyse_i), deferred :: analyse
    procedure(factor_i), deferred :: factor
    procedure(forward_i), deferred :: forward
    procedure :: take_order
    procedure :: find_order
    procedure :: solve_schur
    procedure :: flexibility
    procedure :: body_flexibility
    procedure(backward_i), deferred :: backward
  end type solver_t

  abstract interface
    !> Symbolic part: elimination order with the nodes `last` at the end, storage for d unknowns
    !> of each node.
    subroutine analyse_i(this, graph, d, last, status)
      import :: solver_t, graph_t, status_t
      class(solver_t), intent(inout) :: this
      type(graph_t), intent(in) :: graph
      integer, intent(in) :: d
      integer, intent(in) :: last(:)
      type(status_t), intent(inout) :: status
    end subroutine analyse_i
    !> Numerical part; a lost pivot is a failure that names its node (index).
    subroutine factor_i(this, graph, matrix, status)
      import :: solver_t, graph_t, block_matrix_t, status_t
      class(solver_t), intent(inout) :: this
      type(graph_t), intent(in) :: graph
      type(block_matrix_t), intent(in) :: matrix
      type(status_t), intent(inout) :: status
    end subroutine factor_i
    !> Eliminates the leading unknowns from b; b_interface is what remains for the block.
    subroutine forward_i(this, b, b_interface)
      import :: solver_t, wp
      class(solver_t), intent(inout) :: this
      real(wp), intent(in) :: b(:, :)
      real(wp), intent(out) :: b_interface(:, :)
    end subroutine forward_i
    !> Whole solution from that of the block, after `forward`.
    subroutine backward_i(this, x_interface, x)
      import :: solver_t, wp
      class(solver_t), intent(inout) :: this
      real(wp), intent(in) :: x_interface(:, :)
      real(wp), intent(out) :: x(:, :)
    end subroutine backward_i
  end interface

  public :: solve_whole, gigaflops, work_of, inverse_bytes, lose_pivot, demand_memory, &
      check_graph, check_matrix, check_vectors

contains

  !> An order (new -> old) for the analysis to come, its name and multiplications of blocks.
  subroutine take_order(this, order, name, multiplications)
    class(solver_t), intent(inout) :: this
    integer, intent(in) :: order(:)
    character(*), intent(in) :: name
    integer(i8), intent(in) :: multiplications
    this%order = order
    this%info%order = name
    this%info%multiplications = multiplications
    this%has_order = .true.
  end subroutine take_order

  !> The order of an analysis: the one that was given for it, or the wanted one.
  subroutine find_order(this, graph, last, wanted, status)
    class(solver_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: last(:)
    character(*), intent(in) :: wanted
    type(status_t), intent(inout) :: status
    if (.not. this%has_order) call choose_order(graph, last, wanted, this%order, &
        this%info%order, this%info%multiplications, status)
    this%has_order = .false.
  end subroutine find_order

  !> x_interface = S^-1 x_interface, x_interface (d, m).
  subroutine solve_schur(this, x_interface)
    class(solver_t), intent(in) :: this
    real(wp), intent(inout), contiguous :: x_interface(:, :)
    if (checks_on) call assert_shape(shape(x_interface), [this%d, this%n_interface], &
        'solve_schur', 'x_interface')
    call this%schur%solve(x_interface)
  end subroutine solve_schur

  !> Flexibility of the block, S^-1, as (dm, dm) [L/F], symmetric to the last bit.
  subroutine flexibility(this, f)
    class(solver_t), intent(in) :: this
    real(wp), intent(out), contiguous :: f(:, :)
    real(wp), allocatable :: own(:, :)
    integer :: k
    if (checks_on) call assert_shape(shape(f), [1, 1]*this%d*this%n_interface, &
        'flexibility', 'f')
    if (this%schur%bodies == 1) then
      call this%body_flexibility(1, f)
      return
    end if
    f = zero
    do k = 1, this%schur%bodies
      associate (start => this%d*(this%schur%first(k) - 1), &
          behind => this%d*(this%schur%first(k + 1) - 1))
        allocate (own(behind - start, behind - start))
        call this%body_flexibility(k, own)
        f(start + 1:behind, start + 1:behind) = own
        deallocate (own)
      end associate
    end do
  end subroutine flexibility

  !> The same of the nodes of one body, number k of `schur`.
  subroutine body_flexibility(this, k, f)
    class(solver_t), intent(in) :: this
    integer, intent(in) :: k
    real(wp), intent(out), contiguous :: f(:, :)
    call this%schur%inverse(k, f)
  end subroutine body_flexibility

  !> x = A^-1 b in one call, for set-up work outside the step loop.
  subroutine solve_whole(solver, b, x)
    class(solver_t), intent(inout) :: solver
    real(wp), intent(in) :: b(:, :)
    real(wp), intent(out) :: x(:, :)
    real(wp) :: x_interface(solver%d, solver%n_interface)
    call solver%forward(b, x_interface)
    call solver%solve_schur(x_interface)
    call solver%backward(x_interface, x)
  end subroutine solve_whole

  !> Gflop of so many multiplications of blocks of d x d, and their additions.
  pure real(wp) function gigaflops(d, multiplications)
    integer, intent(in) :: d
    integer(i8), intent(in) :: multiplications
    gigaflops = 2.0e-9_wp*d**3*real(multiplications, wp)
  end function gigaflops

  !> Gflop of a factorisation.
  pure real(wp) function work_of(solver)
    class(solver_t), intent(in) :: solver
    work_of = gigaflops(solver%d, solver%info%multiplications)
  end function work_of

  !> Bytes of the inverse of the contact block, body by body, which stands beside the factor.
  !> The block itself, of the same size, is part of factor_bytes.
  pure integer(i8) function inverse_bytes(solver)
    class(solver_t), intent(in) :: solver
    inverse_bytes = solver%schur%bytes()
  end function inverse_bytes

  !> What an engine reports of a pivot that is not positive, or no number: index of the node.
  subroutine lose_pivot(node, status)
    integer, intent(in) :: node
    type(status_t), intent(inout) :: status
    call fail(status, status_numerical, 'lost pivot at node index '//to_text(node)// &
        ': the effective matrix is not positive definite', &
        hint='check mass, stiffness and time step of the elements around it')
  end subroutine lose_pivot

  !> Before anything is allocated: do the factor, of factor_bytes, and the inverse of the
  !> contact block fit into the memory of the machine? Fails where they do not.
  subroutine demand_memory(solver, status)
    class(solver_t), intent(in) :: solver
    type(status_t), intent(inout) :: status
    integer(i8), parameter :: small = 100000000_i8
    integer(i8) :: needed, there
    needed = solver%info%factor_bytes + solver%info%front_bytes + inverse_bytes(solver)
    if (needed < small) return    ! not worth asking the system
    there = machine_memory()
    if (needed < there) return
    call fail(status, status_file, 'the factor of the matrix needs '// &
        to_text(needed/1000000_i8)//' MB with the inverse of its '// &
        to_text(solver%d*solver%n_interface)//' contact dofs ('//to_text(work_of(solver))// &
        ' Gflop); the machine has '//to_text(there/1000000_i8)//' MB', &
        hint='an explicit scheme factors nothing; fewer contact nodes or a coarser mesh '// &
        'need less')
  end subroutine demand_memory

  !> Assertions on what an engine is given to analyse: rows of the graph without gaps, and nodes
  !> of it as `last`, each once. place: the procedure that asks.
  subroutine check_graph(graph, last, place)
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: last(:)
    character(*), intent(in) :: place
    logical :: is_last(graph%n)
    integer :: k
    if (.not. checks_on) return
    call assert_shape(shape(graph%first), [graph%n + 1], place, 'graph%first')
    call assert_shape(shape(graph%column), [graph%first(graph%n + 1) - 1], place, &
        'graph%column')
    call assert(all(graph%column >= 1 .and. graph%column <= graph%n), place, &
        'every neighbour is a node of the graph')
    call assert(all(last >= 1 .and. last <= graph%n), place, &
        'every one of `last` is a node of the graph')
    is_last = .false.
    do k = 1, size(last)
      call assert(.not. is_last(last(k)), place, 'no node is twice in `last`')
      is_last(last(k)) = .true.
    end do
  end subroutine check_graph

  !> Assertions on what an engine is given to factor: the graph it has analysed, and a block for
  !> each of its entries, or the diagonal.
  subroutine check_matrix(solver, graph, matrix, place)
    class(solver_t), intent(in) :: solver
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    character(*), intent(in) :: place
    if (.not. checks_on) return
    call assert(graph%n == solver%n, place, 'the graph is the one that was analysed')
    if (solver%takes_diagonal) then
      call assert_shape(shape(matrix%diagonal), [solver%d, graph%n], place, 'matrix%diagonal')
    else
      call assert_shape(shape(matrix%value), [solver%d, solver%d, size(graph%column)], place, &
          'matrix%value')
    end if
  end subroutine check_matrix

  !> Assertions on the vectors of a forward or backward pass: (d, n) of all nodes,
  !> (d, n_interface) of the last.
  subroutine check_vectors(solver, whole, block, place)
    class(solver_t), intent(in) :: solver
    real(wp), intent(in) :: whole(:, :), block(:, :)
    character(*), intent(in) :: place
    if (.not. checks_on) return
    call assert_shape(shape(whole), [solver%d, solver%n], place, 'the vector of all nodes')
    call assert_shape(shape(block), [solver%d, solver%n_interface], place, &
        'the vector of the last nodes')
  end subroutine check_vectors

end module linalg_solver
