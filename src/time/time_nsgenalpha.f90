! SPDX-License-Identifier: BSD-3-Clause
!> NSGENALPHA: the nonsmooth generalised alpha-method with contact on positions and velocities
!> (Chen, Acary, Virlez & Bruls 2013; Bruls, Acary & Cardona 2014, decoupled). Impulses stay out
!> of the accelerations: s is that of the smooth forces alone, M s = P - K U, and
!>   a* = (af s0 - am a0)/(1 - am),  U* = U0 + h V0 + h^2 [(1/2 - beta) a0 + beta a*],
!>   V* = V0 + h [(1 - gamma) a0 + gamma a*],
!>   ka = (1 - af)/(1 - am), kb = h^2 beta ka, kg = h gamma ka.
!> Stage 1, positions: [M/kb + K] x = M (U* - U0)/kb + P1 - K U0 + H' nu/kb, U1 = U0 + x.
!> Stage 2, velocities, where nu > 0: x = h (V1 - V0),
!>   [M/h^2] x = M (V* - V0)/h + (kg/h) (P1 - K U1) + H' p/h,  v1n + e v0n >= 0.
!> With w = M^-1 H' p: s1 = (V1 - V* - w)/kg, a1 = a* + ka s1. The force of the step is p/h.
module time_nsgenalpha
  use assembly_system, only: system_t, multiply_mass
  use base_kinds, only: wp, zero, half, one
  use base_status, only: status_t
  use contact_rule, only: contact_rule_t, level_pressed
  use model_data, only: model_t, motion_displacement, motion_velocity
  use model_state, only: state_t
  use time_alpha, only: alpha_t, generalised_alpha
  use time_base, only: stage_t, make_stage_work
  implicit none
  private

  type, extends(alpha_t), public :: nsgenalpha_t
    real(wp) :: ka = zero, kb = zero, kg = zero   !< [1], [T2], [T]
  contains
    procedure :: set_step => nsgenalpha_set_step
    procedure :: start => nsgenalpha_start
    procedure :: right_side => nsgenalpha_right_side
    procedure :: update => nsgenalpha_update
    procedure :: given_motion => nsgenalpha_given_motion
  end type nsgenalpha_t

  public :: nonsmooth_alpha

contains

  !> rho in [0, 1]: the spectral radius at infinite frequency.
  pure type(nsgenalpha_t) function nonsmooth_alpha(rho)
    real(wp), intent(in) :: rho
    nonsmooth_alpha%alpha_t = generalised_alpha(rho)
  end function nonsmooth_alpha

  pure subroutine nsgenalpha_set_step(this, h)
    class(nsgenalpha_t), intent(inout) :: this
    real(wp), intent(in) :: h
    this%h = h
    this%ka = (one - this%af)/(one - this%am)
    this%kb = h**2*this%beta*this%ka
    this%kg = h*this%gamma*this%ka
    this%stage = [stage_t(c_m=one/this%kb, c_k=one), &
        stage_t(c_m=one/h**2, load_weight=[zero, this%kg/h], force_weight=this%kg/h, &
        moves=.false., rule=contact_rule_t(level=level_pressed, before=-h, now=h, &
        safe_share=one))]
    this%load_work_weight = [this%af, one - this%af]
    this%dissipates = .true.
  end subroutine nsgenalpha_set_step

  subroutine nsgenalpha_start(this, model, system, state, status)
    class(nsgenalpha_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(inout) :: state
    type(status_t), intent(inout) :: status
    ! The smooth forces alone are not in balance after a static phase either.
    this%starts_in_balance = .false.
    this%looks_ahead = .false.
    call this%alpha_t%start(model, system, state, status)
    state%a_smooth = state%a
    allocate (this%free(system%dim, system%n))
    this%free = zero
    call make_stage_work(system, this%stage_work)
  end subroutine nsgenalpha_start

  !> a* [L/T2], U* - U0 [L], V* [L/T] of one dof.
  pure elemental subroutine predict(this, v0, a0, s0, a, x, v)
    class(nsgenalpha_t), intent(in) :: this
    real(wp), intent(in) :: v0, a0, s0
    real(wp), intent(out) :: a, x, v
    a = (this%af*s0 - this%am*a0)/(one - this%am)
    x = this%h*v0 + this%h**2*((half - this%beta)*a0 + this%beta*a)
    v = v0 + this%h*((one - this%gamma)*a0 + this%gamma*a)
  end subroutine predict

  subroutine nsgenalpha_right_side(this, stage, system, state, b)
    class(nsgenalpha_t), intent(inout) :: this
    integer, intent(in) :: stage
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(inout) :: b(:, :)
    real(wp) :: a, x, v
    integer :: i, k
    do i = 1, size(b, 2)
      do k = 1, size(b, 1)
        call predict(this, state%v(k, i), state%a(k, i), state%a_smooth(k, i), a, x, v)
        this%d(k, i) = merge(x/this%kb, (v - state%v(k, i))/this%h, stage == 1)
      end do
    end do
    call multiply_mass(system, one, this%d, b)
  end subroutine nsgenalpha_right_side

  !> Forces of the first stage, nu/kb, do work on -kb (dV - w)/h, those of the second, p/h, on
  !> h (V0 + V1)/2 + h (dV - w)/2.
  subroutine nsgenalpha_update(this, stage, x, state)
    class(nsgenalpha_t), intent(inout) :: this
    integer, intent(in) :: stage
    real(wp), intent(inout) :: x(:, :)
    type(state_t), intent(inout) :: state
    real(wp) :: a, u, v, s1
    integer :: i, k
    if (stage == 1) then
      state%u = state%u + x
      return
    end if
    do i = 1, size(x, 2)
      do k = 1, size(x, 1)
        call predict(this, state%v(k, i), state%a(k, i), state%a_smooth(k, i), a, u, v)
        ! free/h = V1 - V0 - w
        s1 = (state%v(k, i) + this%free(k, i)/this%h - v)/this%kg
        this%stage_work(1)%x(k, i) = -this%kb*this%free(k, i)/this%h**2
        this%stage_work(2)%x(k, i) = this%h*state%v(k, i) + half*(x(k, i) + this%free(k, i))
        state%v(k, i) = state%v(k, i) + x(k, i)/this%h
        state%a_smooth(k, i) = s1
        this%da(k, i) = a + this%ka*s1 - state%a(k, i)
        state%a(k, i) = a + this%ka*s1
      end do
    end do
  end subroutine nsgenalpha_update

  !> A held dof has no impulse: U1 = U* + kb s1, V1 = V* + kg s1, a1 = a* + ka s1, one of them
  !> given.
  pure real(wp) function nsgenalpha_given_motion(this, stage, state, direction, node, kind, &
      value)
    class(nsgenalpha_t), intent(in) :: this
    integer, intent(in) :: stage
    type(state_t), intent(in) :: state
    integer, intent(in) :: direction, node, kind
    real(wp), intent(in) :: value
    real(wp) :: a, x, v, s1
    associate (v0 => state%v(direction, node))
      call predict(this, v0, state%a(direction, node), state%a_smooth(direction, node), a, x, v)
      select case (kind)
      case (motion_displacement)
        s1 = (value - state%u(direction, node) - x)/this%kb
        ! U0 has become U1 in the second stage, whose x is that of the first.
        if (stage == 2) s1 = (state%du(direction, node) - x)/this%kb
      case (motion_velocity)
        s1 = (value - v)/this%kg
      case default
        s1 = (value - a)/this%ka
      end select
      nsgenalpha_given_motion = x + this%kb*s1
      if (stage == 2) nsgenalpha_given_motion = this%h*(v + this%kg*s1 - v0)
    end associate
  end function nsgenalpha_given_motion

end module time_nsgenalpha
