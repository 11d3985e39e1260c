! SPDX-License-Identifier: BSD-3-Clause
!> The effective matrices of a scheme with their factors. One is in use; a scheme of two stages
!> has another beside it, and they change places by their addresses.
module run_operator
  use assembly_system, only: effective_matrix, diagonal_matrix
  use base_kinds, only: wp, zero
  use base_messages, only: add_message
  use base_status, only: status_t, failed
  use base_strings, only: to_text
  use base_timers, only: phase_factor
  use contact_condense, only: constrain_interface
  use linalg_graph, only: block_matrix_t
  use linalg_registry, only: make_solver, engine_diagonal
  use linalg_solver, only: solver_t, solver_options_t, work_of
  use run_data, only: run_t, operator_t
  use run_motion, only: find_smooth_reactions
  use run_rigid, only: link_interface, keep_flexibility
  implicit none
  private
  public :: make_operators, change_operators, factor_matrix, size_factor, use_operator, &
      kept_nodes

contains

  !> A solver for every stage of the scheme.
  subroutine make_operators(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    run%stage_in_use = 1
    call make_engine(run, 1, run%solver, status)
    if (failed(status)) return
    call make_other(run, status)
  end subroutine make_operators

  !> The scheme is another one. again: some matrix must be analysed anew.
  subroutine change_operators(run, again, status)
    type(run_t), intent(inout) :: run
    logical, intent(out) :: again
    type(status_t), intent(inout) :: status
    again = has_diagonal_matrix(run, 1) .neqv. run%solver%takes_diagonal
    if (again) call make_engine(run, 1, run%solver, status)
    call make_other(run, status)
    again = again .or. allocated(run%other)
  end subroutine change_operators

  !> The solver of a stage: as the deck asks, or the one of diagonal matrices.
  subroutine make_engine(run, stage, solver, status)
    type(run_t), intent(in) :: run
    integer, intent(in) :: stage
    class(solver_t), allocatable, intent(out) :: solver
    type(status_t), intent(inout) :: status
    type(solver_options_t) :: options
    options = run%solver_options
    if (has_diagonal_matrix(run, stage)) then
      options%engine = engine_diagonal
    else if (associated(run%team)) then
      call run%team%make_solver(options, solver)
      return
    end if
    call make_solver(options, solver, status)
  end subroutine make_engine

  !> Is the effective matrix of a stage lumped masses alone?
  pure logical function has_diagonal_matrix(run, stage)
    type(run_t), intent(in) :: run
    integer, intent(in) :: stage
    associate (s => run%scheme%stage(stage))
      has_diagonal_matrix = run%system%mass_is_diagonal .and. .not. any( &
          abs([s%c_k, s%c_c, s%c_layer]) > zero)
    end associate
  end function has_diagonal_matrix

  !> The solver of a second stage, if there is one, and what its reactions need.
  subroutine make_other(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    if (size(run%scheme%stage) == 1) return
    allocate (run%other)
    call make_engine(run, 2, run%other%solver, status)
    if (.not. run%plan%reactions) return
    allocate (run%first_reaction(run%system%dim, run%system%n), source=zero)
    if (.not. allocated(run%state%a_smooth)) return
    allocate (run%smooth_reaction(run%system%dim, run%system%n), source=zero)
    call find_smooth_reactions(run)
  end subroutine make_other

  !> Puts the matrix of a stage into its place, with its factor and the flexibility of the
  !> interface.
  subroutine use_operator(run, stage)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    type(operator_t) :: kept
    if (stage == run%stage_in_use) return
    run%stage_in_use = stage
    call move_alloc(run%solver, kept%solver)
    call move_matrix(run%matrix, kept%matrix)
    call move_alloc(run%contact%schur_inverse, kept%schur_inverse)
    call move_alloc(run%other%solver, run%solver)
    call move_matrix(run%other%matrix, run%matrix)
    call move_alloc(run%other%schur_inverse, run%contact%schur_inverse)
    call move_alloc(kept%solver, run%other%solver)
    call move_matrix(kept%matrix, run%other%matrix)
    call move_alloc(kept%schur_inverse, run%other%schur_inverse)
    if (allocated(run%rigid)) then
      call move_alloc(run%rigid%flexibility, kept%flexibility)
      call move_alloc(run%other%flexibility, run%rigid%flexibility)
      call move_alloc(kept%flexibility, run%other%flexibility)
    end if
    run%contact%w_is_current = .false.
  end subroutine use_operator

  subroutine move_matrix(from, to)
    type(block_matrix_t), intent(inout) :: from, to
    call move_alloc(from%value, to%value)
    call move_alloc(from%diagonal, to%diagonal)
  end subroutine move_matrix

  !> Factors of the effective matrices of all stages, with the interface nodes last and their
  !> flexibility; again is true when the interface has changed and the order must be found
  !> anew.
  subroutine factor_matrix(run, again, status)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: again
    type(status_t), intent(inout) :: status
    integer :: stage, in_use
    if (failed(status)) return
    call run%timers%enter(phase_factor)
    if (again) call size_interface(run)
    in_use = run%stage_in_use
    do stage = 1, size(run%scheme%stage)
      if (allocated(run%other)) call use_operator(run, stage)
      call factor_stage(run, stage, again, status)
      if (failed(status)) return
    end do
    if (allocated(run%other)) call use_operator(run, in_use)
  end subroutine factor_matrix

  !> Vectors of the interface nodes.
  subroutine size_interface(run)
    type(run_t), intent(inout) :: run
    integer :: d, m
    m = size(run%contact%interface_node)
    d = run%system%dim
    if (allocated(run%b_interface)) deallocate (run%b_interface, run%x_interface, run%force)
    allocate (run%force(d, m))
    if (allocated(run%rigid)) call link_interface(run)
    associate (kept => size(kept_nodes(run)))
      allocate (run%b_interface(d, kept), run%x_interface(d, kept))
    end associate
    if (d*m > run%solver_options%block_limit) &
        call add_message(run%notes, '', 'the contact interface has '//to_text(d*m)// &
        ' dofs, more than NLAST; it is kept dense all the same')
  end subroutine size_interface

  !> What the factor of the first stage will need, without its numbers: run%solver%info.
  subroutine size_factor(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    if (failed(status)) return
    call size_interface(run)
    call analyse_matrix(run, status)
  end subroutine size_factor

  subroutine factor_stage(run, number, again, status)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: number
    logical, intent(in) :: again
    type(status_t), intent(inout) :: status
    integer :: m
    associate (stage => run%scheme%stage(number))
      if (run%solver%takes_diagonal) then
        call diagonal_matrix(run%system, stage%c_m, run%matrix)
      else if (allocated(run%newton)) then
        call effective_matrix(run%system, stage%c_m, stage%c_c, stage%c_layer, stage%c_k, &
            run%matrix, run%state%u, run%x, shift=run%shift)
      else
        call effective_matrix(run%system, stage%c_m, stage%c_c, stage%c_layer, stage%c_k, &
            run%matrix, shift=run%shift)
      end if
    end associate
    if (again) then
      call analyse_matrix(run, status)
      if (failed(status)) return
      run%analyses = run%analyses + 1
    end if
    call run%solver%factor(run%system%graph, run%matrix, status)
    run%factors = run%factors + 1
    m = size(run%contact%interface_node)
    if (m == 0 .or. failed(status)) return
    call size_flexibility(run%system%dim*m, run%contact%schur_inverse)
    if (allocated(run%rigid)) then
      call keep_flexibility(run)
    else
      call run%solver%flexibility(run%contact%schur_inverse)
      call constrain_interface(run%contact, run%system%fixed_list)
    end if
  end subroutine factor_stage

  !> Order and storage of the factor. Where the deck leaves the engine open and the work is that
  !> of a large body in space, dense panels take half the time (doc/performance.md); they do not
  !> know null pivots.
  subroutine analyse_matrix(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    type(solver_options_t) :: options
    real(wp), parameter :: much_work = 0.1_wp    ! Gflop
    call run%solver%analyse(run%system%graph, size(run%b, 1), kept_nodes(run), status)
    options = run%solver_options
    if (associated(run%team)) return
    if (failed(status) .or. options%engine /= 'AUTO' .or. run%solver%takes_diagonal .or. &
        options%null_pivot > zero .or. run%solver%info%engine == 'SUPERNODAL') return
    if (run%system%dim == 2 .or. work_of(run%solver) < much_work) return
    options%engine = 'SUPERNODAL'
    call make_solver(options, run%solver, status)
    call run%solver%analyse(run%system%graph, size(run%b, 1), kept_nodes(run), status)
  end subroutine analyse_matrix

  !> The nodes that come last in the elimination.
  pure function kept_nodes(run) result(list)
    type(run_t), intent(in) :: run
    integer, allocatable :: list(:)
    if (allocated(run%rigid)) then
      list = run%rigid%solver_node
    else
      list = run%contact%interface_node
    end if
  end function kept_nodes

  !> That of the matrix beside the one in use is not sized with the interface.
  !> (m, m) dofs.
  subroutine size_flexibility(m, schur_inverse)
    integer, intent(in) :: m
    real(wp), allocatable, intent(inout) :: schur_inverse(:, :)
    if (allocated(schur_inverse)) then
      if (size(schur_inverse, 1) == m) return
      deallocate (schur_inverse)
    end if
    allocate (schur_inverse(m, m))
  end subroutine size_flexibility

end module run_operator
