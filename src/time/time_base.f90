! SPDX-License-Identifier: BSD-3-Clause
!> What a time scheme is: a list of stages. A stage gives the effective matrix A = cM M + cC C +
!> cK K, the right-hand side of the free motion, the rule of contact, and the update; contact is
!> posed on the unknown x of the stage by the one contact routine, which is never told which
!> scheme calls it.
module time_base
  use assembly_system, only: system_t
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t
  use contact_rule, only: contact_rule_t
  use model_data, only: model_t
  use model_state, only: state_t
  implicit none
  private
  !> Weights of the internal energy of a scheme whose energy is that of the middle of a step.
  type, public :: staggered_t
    logical :: on = .false.
    real(wp) :: share = zero   !< internal = Um.K Um/2 + share dU.K dU/2, Um = U1 - dU/2
  end type staggered_t

  !> One solve of a step: A x = b + H' r with A = cM M + cC C + cK K and
  !> b = (inertia, by the scheme) + load_weight(1) P0 + load_weight(2) P1
  !>     - force_weight K (U0 + force_lead V0) - C (rate_weight(1) V0 + rate_weight(2) A0).
  !> The damping force that acts in the stage is C (cC x + rate_weight(1) V0 + rate_weight(2)
  !> A0), counted over the step like the contact force: over rule%factor, with weight_before
  !> and weight_now of the scheme.
  type, public :: stage_t
    real(wp) :: c_m = zero   !< [1/T2]
    real(wp) :: c_c = zero       !< on the damping of the deck [1/T]
    real(wp) :: c_layer = zero   !< on the layer of massless nodes
    real(wp) :: c_k = zero
    type(contact_rule_t) :: rule             !< what contact means here
    real(wp) :: load_weight(2) = [zero, one]
    real(wp) :: force_weight = one
    real(wp) :: force_lead = zero            !< [T]
    logical :: moves = .true.                !< x = U1 - U0, else a change of velocity times h
    logical :: only_in_contact = .false.     !< x is zero where the stage before met no contact
    real(wp) :: rate_weight(2) = zero        !< [1], [T]
  end type stage_t

  type, public :: motion_t
    real(wp), allocatable :: x(:, :)         !< (dim, n) [L]
  end type motion_t

  type, abstract, public :: scheme_t
    character(10) :: name = ''
    real(wp) :: h = zero                     !< step [T]
    type(stage_t), allocatable :: stage(:)
    logical :: has_acceleration = .false.
    logical :: starts_in_balance = .false.   !< after a static phase: accelerations are zero
    !> Over the step the bodies feel the reactions weight_before r0 + weight_now r1.
    real(wp) :: weight_before = zero
    real(wp) :: weight_now = one
    !> Weights of the loads P0, P1 in the work that the ledger counts.
    real(wp) :: load_work_weight(2) = [zero, one]
    !> True when the scheme has damping of its own to be accounted for.
    logical :: dissipates = .false.
    type(staggered_t) :: staggered
    !> What a scheme has made ahead goes with the state: not after a restart.
    logical :: is_current = .false.
    !> (dim, n) motion on which forces do work, only where it is not that of the step [L]
    real(wp), allocatable :: conjugate(:, :)
    ! Only of schemes of two stages, whose matrices differ:
    !> of each stage, on which its contact forces do work
    type(motion_t), allocatable :: stage_work(:)
    logical :: adds_reactions = .false.      !< the force of the step is that of both stages
    !> (dim, n) x of the last stage without contact, only where it is needed [L]
    real(wp), allocatable :: free(:, :)
    !> (dim, n) that the scheme itself adds to the rate V0 in C of its stage [L/T]
    real(wp), allocatable :: rate(:, :)
  contains
    procedure :: begin_step => nothing_to_begin
    procedure(set_step_i), deferred :: set_step
    procedure(start_i), deferred :: start
    procedure(right_side_i), deferred :: right_side
    procedure(update_i), deferred :: update
    procedure(dissipation_i), deferred :: dissipation
    procedure(given_motion_i), deferred :: given_motion
  end type scheme_t

  abstract interface
    !> Coefficients of every stage for a step of length h.
    pure subroutine set_step_i(this, h)
      import :: scheme_t, wp
      class(scheme_t), intent(inout) :: this
      real(wp), intent(in) :: h
    end subroutine set_step_i
    !> What the state needs before the first step (an acceleration, say).
    subroutine start_i(this, model, system, state, status)
      import :: scheme_t, model_t, system_t, state_t, status_t
      class(scheme_t), intent(inout) :: this
      type(model_t), intent(in) :: model
      type(system_t), intent(in) :: system
      type(state_t), intent(inout) :: state
      type(status_t), intent(inout) :: status
    end subroutine start_i
    !> Adds the inertia to b of A x = b [F]; loads and internal forces are the pipeline's.
    subroutine right_side_i(this, stage, system, state, b)
      import :: scheme_t, system_t, state_t, wp
      class(scheme_t), intent(inout) :: this
      integer, intent(in) :: stage
      type(system_t), intent(in) :: system
      type(state_t), intent(in) :: state
      real(wp), intent(inout) :: b(:, :)
    end subroutine right_side_i
    !> State at the end of a stage from its unknown x (dim, n), which becomes the motion of the
    !> step, U1 - U0, if the stage moves.
    subroutine update_i(this, stage, x, state)
      import :: scheme_t, state_t, wp
      class(scheme_t), intent(inout) :: this
      integer, intent(in) :: stage
      real(wp), intent(inout) :: x(:, :)
      type(state_t), intent(inout) :: state
    end subroutine update_i
    !> Energy that the scheme itself takes out in the step just done [F L]; only called when
    !> `dissipates`.
    real(wp) function dissipation_i(this, system, state)
      import :: scheme_t, system_t, state_t, wp
      class(scheme_t), intent(inout) :: this
      type(system_t), intent(in) :: system
      type(state_t), intent(in) :: state
    end function dissipation_i
    !> Unknown x of one dof that ends the step with a given displacement, velocity or
    !> acceleration (kind: motion_... of model_data), by the scheme's own update.
    pure real(wp) function given_motion_i(this, stage, state, direction, node, kind, value)
      import :: scheme_t, state_t, wp
      class(scheme_t), intent(in) :: this
      integer, intent(in) :: stage
      type(state_t), intent(in) :: state
      integer, intent(in) :: direction, node, kind
      real(wp), intent(in) :: value
    end function given_motion_i
  end interface

  public :: mass_product, make_stage_work

contains

  !> Most schemes do the same in every step. cycle: number of steps done, the last one h_last
  !> long [T].
  subroutine nothing_to_begin(this, cycle, h_last)
    class(scheme_t), intent(inout) :: this
    integer, intent(in) :: cycle
    real(wp), intent(in) :: h_last
  end subroutine nothing_to_begin

  !> The motions of both stages of a scheme, zero.
  pure subroutine make_stage_work(system, stage_work)
    type(system_t), intent(in) :: system
    type(motion_t), allocatable, intent(out) :: stage_work(:)
    integer :: k
    allocate (stage_work(2))
    do k = 1, 2
      allocate (stage_work(k)%x(system%dim, system%n), source=zero)
    end do
  end subroutine make_stage_work

  !> x.M y [F L for velocities].
  pure real(wp) function mass_product(system, x, y)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: x(:, :), y(:, :)
    real(wp) :: row_2(2), row_3(3)
    integer :: i
    mass_product = zero
    if (system%dim == 2) then
      do i = 1, system%n
        row_2 = mass_row_2(system, i, y)
        mass_product = mass_product + x(1, i)*row_2(1)
        mass_product = mass_product + x(2, i)*row_2(2)
      end do
    else
      do i = 1, system%n
        row_3 = mass_row_3(system, i, y)
        mass_product = mass_product + x(1, i)*row_3(1)
        mass_product = mass_product + x(2, i)*row_3(2)
        mass_product = mass_product + x(3, i)*row_3(3)
      end do
    end if
  end function mass_product

  !> (M y)_i in the plane: a size that the compiler knows saves a third of the work.
  pure function mass_row_2(system, i, y) result(row)
    type(system_t), intent(in) :: system
    integer, intent(in) :: i
    real(wp), intent(in) :: y(:, :)
    real(wp) :: row(2)
    integer :: k
    if (system%mass_is_diagonal) then
      row = system%lumped(i)*y(:, i)
      return
    end if
    row = zero
    do k = system%graph%first(i), system%graph%first(i + 1) - 1
      row = row + system%mass(k)*y(:, system%graph%column(k))
    end do
  end function mass_row_2

  !> (M y)_i in space.
  pure function mass_row_3(system, i, y) result(row)
    type(system_t), intent(in) :: system
    integer, intent(in) :: i
    real(wp), intent(in) :: y(:, :)
    real(wp) :: row(3)
    integer :: k
    if (system%mass_is_diagonal) then
      row = system%lumped(i)*y(:, i)
      return
    end if
    row = zero
    do k = system%graph%first(i), system%graph%first(i + 1) - 1
      row = row + system%mass(k)*y(:, system%graph%column(k))
    end do
  end function mass_row_3

end module time_base
