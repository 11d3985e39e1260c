! SPDX-License-Identifier: BSD-3-Clause
!> The effective matrices of a scheme with their factors. One is in use; a scheme of two stages
!> has another beside it, and they change places by their addresses.
module run_operator
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use assembly_system, only: effective_matrix, diagonal_matrix
  use base_kinds, only: wp, zero, one
  use base_messages, only: add_message
  use base_status, only: status_t, fail, failed, status_numerical
  use base_strings, only: to_text
  use base_timers, only: phase_factor
  use contact_condense, only: constrain_interface
  use contact_local, only: start_local
  use linalg_bodies, only: body_blocks_t, size_blocks, move_blocks
  use linalg_graph, only: block_matrix_t
  use linalg_near, only: find_near, fill_near, fill_near_diagonal, move_near
  use linalg_registry, only: make_solver, engine_diagonal
  use linalg_solver, only: solver_t, solver_options_t
  use run_data, only: run_t, operator_t
  use run_engine, only: analyse_matrix, kept_nodes
  use run_motion, only: find_smooth_reactions
  use run_rigid, only: link_interface, keep_flexibility
  use run_storage, only: choose_storage
  implicit none
  private
  public :: make_operators, change_operators, factor_matrix, renew_matrix, size_factor, &
      use_operator

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
    type(run_t), intent(inout), target :: run
    integer, intent(in) :: stage
    type(operator_t) :: kept
    if (stage == run%stage_in_use) return
    run%stage_in_use = stage
    call move_alloc(run%solver, kept%solver)
    call move_matrix(run%matrix, kept%matrix)
    call move_blocks(run%contact%schur_inverse, kept%schur_inverse)
    call move_alloc(run%other%solver, run%solver)
    call move_matrix(run%other%matrix, run%matrix)
    call move_blocks(run%other%schur_inverse, run%contact%schur_inverse)
    call move_alloc(kept%solver, run%other%solver)
    call move_matrix(kept%matrix, run%other%matrix)
    call move_blocks(kept%schur_inverse, run%other%schur_inverse)
    if (allocated(run%rigid)) then
      call move_alloc(run%rigid%flexibility, kept%flexibility)
      call move_alloc(run%other%flexibility, run%rigid%flexibility)
      call move_alloc(kept%flexibility, run%other%flexibility)
    end if
    run%contact%w_is_current = .false.
    if (.not. allocated(run%contact%local)) return
    call move_near(run%contact%local%near, kept%near)
    call move_near(run%other%near, run%contact%local%near)
    call move_near(kept%near, run%other%near)
    run%contact%local%solver => run%solver
    call start_local(run%contact, run%system%n)
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
    if (again) call size_interface(run, status)
    if (failed(status)) return
    in_use = run%stage_in_use
    do stage = 1, size(run%scheme%stage)
      if (allocated(run%other)) call use_operator(run, stage)
      call factor_stage(run, stage, again, status)
      if (failed(status)) return
    end do
    if (allocated(run%other)) call use_operator(run, in_use)
  end subroutine factor_matrix

  !> Factors for another step, interface or set of held dofs. Newton's method factors its
  !> tangent in the first pass of each step, without the part of the stresses where it must: a
  !> pivot that is lost before says nothing of the step.
  subroutine renew_matrix(run, again, status)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: again
    type(status_t), intent(inout) :: status
    if (failed(status)) return
    call factor_matrix(run, again, status)
    if (.not. allocated(run%newton) .or. status%code /= status_numerical) return
    if (.not. run%newton%is_explicit) status = status_t()
  end subroutine renew_matrix

  !> Vectors of the interface nodes.
  subroutine size_interface(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    integer :: d, m
    call choose_storage(run, status)
    if (failed(status)) return
    m = size(run%contact%interface_node)
    d = run%system%dim
    if (allocated(run%b_interface)) deallocate (run%b_interface, run%x_interface, run%force)
    if (allocated(run%x_contact)) deallocate (run%x_contact)
    allocate (run%force(d, m))
    if (allocated(run%contact%local)) allocate (run%x_contact(d, m), source=zero)
    if (allocated(run%rigid)) call link_interface(run)
    associate (kept => size(kept_nodes(run)))
      allocate (run%b_interface(d, kept), run%x_interface(d, kept))
    end associate
    if (d*m > run%solver_options%block_limit .and. .not. allocated(run%contact%local)) &
        call add_message(run%notes, '', 'the contact interface has '//to_text(d*m)// &
        ' dofs, more than NLAST; it is kept dense all the same')
  end subroutine size_interface

  !> What the factor of the first stage will need, without its numbers: run%solver%info.
  subroutine size_factor(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    if (failed(status)) return
    call size_interface(run, status)
    if (failed(status)) return
    if (allocated(run%newton)) call assemble_stage(run, 1, status)    ! AUTO looks at it
    if (failed(status)) return
    call analyse_matrix(run, status)
  end subroutine size_factor

  !> Are all entries of a matrix numbers?
  pure logical function is_finite(matrix)
    type(block_matrix_t), intent(in) :: matrix
    is_finite = .true.
    if (allocated(matrix%value)) is_finite = all(ieee_is_finite(matrix%value))
  end function is_finite

  !> The effective matrix of a stage as the run stands.
  subroutine assemble_stage(run, number, status)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: number
    type(status_t), intent(inout) :: status
    associate (stage => run%scheme%stage(number))
      if (run%solver%takes_diagonal) then
        call diagonal_matrix(run%system, stage%c_m, run%matrix)
      else if (allocated(run%newton)) then
        call effective_matrix(run%system, stage%c_m, stage%c_c, stage%c_layer, stage%c_k, &
            run%matrix, run%state%u, run%x, shift=run%shift)
        if (.not. is_finite(run%matrix)) call fail(status, status_numerical, &
            'the tangent is not finite (NaN or Inf)', hint='take a smaller step')
        if (failed(status)) return
      else
        call effective_matrix(run%system, stage%c_m, stage%c_c, stage%c_layer, stage%c_k, &
            run%matrix, shift=run%shift)
      end if
    end associate
  end subroutine assemble_stage

  subroutine factor_stage(run, number, again, status)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: number
    logical, intent(in) :: again
    type(status_t), intent(inout) :: status
    integer :: k
    call assemble_stage(run, number, status)
    if (failed(status)) return
    if (again) then
      call analyse_matrix(run, status)
      if (failed(status)) return
      run%analyses = run%analyses + 1
    end if
    call run%solver%factor(run%system%graph, run%matrix, status)
    run%factors = run%factors + 1
    if (size(run%contact%interface_node) == 0 .or. failed(status)) return
    if (allocated(run%contact%local)) then
      call fill_local(run, again, status)
    else if (allocated(run%rigid)) then
      call size_one_body(run%system%dim*size(run%contact%interface_node), &
          run%contact%schur_inverse)
      call keep_flexibility(run)
    else
      associate (inverse => run%contact%schur_inverse)
        call size_blocks(run%solver%schur, inverse)
        do k = 1, size(inverse%block)
          call run%solver%body_flexibility(k, inverse%block(k)%a)
        end do
      end associate
      call constrain_interface(run%contact, run%system%fixed_list)
    end if
  end subroutine factor_stage

  !> The near part of the flexibility of the interface, and the solver of the rest.
  subroutine fill_local(run, again, status)
    type(run_t), intent(inout), target :: run
    logical, intent(in) :: again
    type(status_t), intent(inout) :: status
    integer :: k
    associate (local => run%contact%local, node => run%contact%interface_node)
      local%solver => run%solver
      call start_local(run%contact, run%system%n)
      if (again .or. .not. allocated(local%near%first)) call find_near(run%system%graph, &
          run%system%dim, node, local%radius, local%near)
      if (run%solver%takes_diagonal) then
        do k = 1, size(node)
          run%x_contact(:, k) = one/run%matrix%diagonal(:, node(k))
        end do
        call fill_near_diagonal(run%x_contact, local%near)
      else
        call fill_near(run%system%graph, run%matrix, node, local%margin, local%near, status)
      end if
      if (allocated(local%pattern)) deallocate (local%pattern, local%pattern_size)
    end associate
    if (.not. failed(status)) call constrain_interface(run%contact, run%system%fixed_list)
  end subroutine fill_local

  !> m dofs. Nodes of rigid parts couple whatever they touch.
  subroutine size_one_body(m, schur_inverse)
    integer, intent(in) :: m
    type(body_blocks_t), intent(inout) :: schur_inverse
    if (allocated(schur_inverse%block)) then
      if (schur_inverse%rows() == m) return
    end if
    call schur_inverse%set_one_body(m)
  end subroutine size_one_body

end module run_operator
