! SPDX-License-Identifier: BSD-3-Clause
!> The first-order theta-method without accelerations (Jean 1999):
!>   U1 - U0 = h [(1 - theta) V0 + theta V1]
!> M (V1 - V0) = h [(1 - xi) F0 + xi F1] + h R1,  F = P - K U - C V,  R fully implicit.
!> One stage: [M/(theta h^2) + xi C/(theta h) + xi K] x = M V0/(theta h) + (1 - xi) P0 + xi P1
!> - K U0 - (1 - xi/theta) C V0 + R1. A
!> massless node has no inertia: at xi = 1/2 the force that is left on it when contact ends
!> would change sign at every step for ever (F1 = -F0). The elements that hold such nodes
!> therefore get xi = 1/2 + layer_damping: the force left dies out within some 25 steps, and the
!> ledger counts what it took.
!> On velocities (Moreau 1988) the same step has the law of contact v1n + e v0n >= 0 on what
!> touches at the middle of the free step; its impulse over h is the force r.
module time_theta
  use assembly_forces, only: strain_product, layer_product
  use assembly_system, only: system_t, multiply_mass
  use base_kinds, only: wp, zero, one, half
  use base_status, only: status_t
  use contact_rule, only: contact_rule_t, level_velocity
  use model_data, only: model_t, motion_displacement
  use model_state, only: state_t
  use time_base, only: scheme_t, stage_t, mass_product
  implicit none
  private

  type, extends(scheme_t), public :: theta_t
    real(wp) :: theta = half
    real(wp) :: xi = half
    logical :: on_velocities = .false.
    logical :: is_safe = .false.        !< the normal work of contact is never positive
    real(wp), allocatable :: dv(:, :)   !< velocity change of the step, only where it is needed
  contains
    procedure :: set_step => theta_set_step
    procedure :: start => theta_start
    procedure :: right_side => theta_right_side
    procedure :: update => theta_update
    procedure :: dissipation => theta_dissipation
    procedure :: given_motion => theta_given_motion
  end type theta_t

  !> 0.01: the smallest round value for which the alternation is gone between two rows of a
  !> table; it takes less than 2e-4 of the energy of an impact (doc/verification.md).
  real(wp), parameter :: layer_damping = 0.01_wp

contains

  pure subroutine theta_set_step(this, h)
    class(theta_t), intent(inout) :: this
    real(wp), intent(in) :: h
    this%h = h
    this%stage = [stage_t(c_m=one/(this%theta*h**2), c_k=this%xi)]
    if (this%on_velocities) this%stage(1)%rule = contact_rule_t(level=level_velocity, &
        lead=half*h, before=(one - this%theta)*h, now=this%theta*h, &
        safe_share=merge((one - this%theta)/this%theta, zero, this%is_safe))
    if (.not. this%xi > half) this%stage(1)%c_layer = layer_damping
    this%stage(1)%load_weight = [one - this%xi, this%xi]
    this%stage(1)%c_c = this%xi/(this%theta*h)
    this%stage(1)%rate_weight = [one - this%xi/this%theta, zero]
    this%load_work_weight = this%stage(1)%load_weight
    this%dissipates = this%dissipates .or. this%theta > half .or. this%xi > half
  end subroutine theta_set_step

  !> The method needs nothing but displacements and velocities.
  subroutine theta_start(this, model, system, state, status)
    class(theta_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(inout) :: state
    type(status_t), intent(inout) :: status
    if (this%theta > half) allocate (this%dv(system%dim, system%n))
    if (this%theta > half) this%dv = zero
    this%dissipates = this%dissipates .or. size(system%massless_layer) > 0
  end subroutine theta_start

  subroutine theta_right_side(this, stage, system, state, b)
    class(theta_t), intent(inout) :: this
    integer, intent(in) :: stage
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(inout) :: b(:, :)
    call multiply_mass(system, one/(this%theta*this%h), state%v, b)
  end subroutine theta_right_side

  !> U1 = U0 + x, V1 = (1 - 1/theta) V0 + x/(theta h).
  subroutine theta_update(this, stage, x, state)
    class(theta_t), intent(inout) :: this
    integer, intent(in) :: stage
    real(wp), intent(inout) :: x(:, :)
    type(state_t), intent(inout) :: state
    real(wp) :: keep, gain
    keep = one - one/this%theta
    gain = one/(this%theta*this%h)
    if (allocated(this%dv)) this%dv = gain*x + (keep - one)*state%v
    call update_kernel(size(x), keep, gain, x, state%u, state%v)
  end subroutine theta_update

  pure subroutine update_kernel(n, keep, gain, x, u, v)
    integer, intent(in) :: n
    real(wp), intent(in) :: keep, gain, x(n)
    real(wp), intent(inout) :: u(n), v(n)
    integer :: i
    do i = 1, n
      u(i) = u(i) + x(i)
      v(i) = keep*v(i) + gain*x(i)
    end do
  end subroutine update_kernel

  !> (theta - 1/2) |dV|_M^2 + (xi - 1/2) |dU|_K^2 + cC |dU|_C^2.
  real(wp) function theta_dissipation(this, system, state)
    class(theta_t), intent(inout) :: this
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    theta_dissipation = zero
    if (this%theta > half) &
        theta_dissipation = (this%theta - half)*mass_product(system, this%dv, this%dv)
    if (this%xi > half) theta_dissipation = theta_dissipation &
        + (this%xi - half)*strain_product(system, state%du)
    if (this%stage(1)%c_layer > zero) theta_dissipation = theta_dissipation &
        + this%stage(1)%c_layer*layer_product(system, state%du)
  end function theta_dissipation

  !> x = U1 - U0, or h [(1 - theta) V0 + theta V1].
  pure real(wp) function theta_given_motion(this, stage, state, direction, node, kind, value)
    class(theta_t), intent(in) :: this
    integer, intent(in) :: stage
    type(state_t), intent(in) :: state
    integer, intent(in) :: direction, node, kind
    real(wp), intent(in) :: value
    if (kind == motion_displacement) then
      theta_given_motion = value - state%u(direction, node)
    else
      theta_given_motion = &
          this%h*((one - this%theta)*state%v(direction, node) + this%theta*value)
    end if
  end function theta_given_motion

end module time_theta
