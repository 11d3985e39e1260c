! SPDX-License-Identifier: BSD-3-Clause
!> The central difference with contact on positions (Paoli & Schatzman 1993), beta = 1/4,
!> implicit (our choice), or beta = 0, explicit; or with contact on velocities (CD-Lagrange,
!> Fekak, Brun, Gravouil & Depale 2017), beta = 0. State: U_n and V- = (U_n - U_{n-1})/h.
!>   [M/h^2 + C/(2 h) + beta K] x = M V-/h + P_n - K (U_n - beta h V-) - C V-/2 + r,
!>   U_{n+1} = U_n + x,  V+ = x/h,  and - C V- alone at beta = 0,
!> the gap at U_{n+1} + e times that at U_{n-1} is not negative, or v+ + e v- where the gap at
!> U_n is not positive. At beta = 1/4 two steps of the theta-method at theta = xi = 1/2 with
!> their mean contact force are one of this: that mean obeys the law of contact, and does not
!> alternate. In the first step V- is V0 and half the forces act. Forces do work on
!> w = h (V- + V+)/2; the energy V+.M V+/2 + Um.K Um/2 + (beta - 1/4) x.K x/2, Um = U_n + x/2,
!> changes by it alone.
module time_paoli
  use assembly_forces, only: subtract_internal_force
  use assembly_system, only: system_t, multiply_mass
  use base_kinds, only: wp, zero, one, half
  use base_status, only: status_t
  use contact_rule, only: contact_rule_t, level_position, level_velocity
  use model_data, only: model_t, motion_displacement
  use model_state, only: state_t
  use time_base, only: scheme_t, stage_t
  implicit none
  private

  type, extends(scheme_t), public :: paoli_t
    real(wp) :: beta = 0.25_wp
    logical :: on_velocities = .false.
    real(wp) :: h_before = zero         !< length of the step before; 0: there is none [T]
    !> K U0, K V0, V0 of the first step; work space of a cut one
    real(wp), allocatable :: ku(:, :), kv(:, :), v_start(:, :)
  contains
    procedure :: begin_step => paoli_begin_step
    procedure :: set_step => paoli_set_step
    procedure :: start => paoli_start
    procedure :: right_side => paoli_right_side
    procedure :: update => paoli_update
    procedure :: dissipation => paoli_dissipation
    procedure :: given_motion => paoli_given_motion
  end type paoli_t

contains

  !> The weights of the step: in the first one no time has passed before it, and a last one
  !> that is cut is shorter than the one before.
  subroutine paoli_begin_step(this, cycle, h_last)
    class(paoli_t), intent(inout) :: this
    integer, intent(in) :: cycle
    real(wp), intent(in) :: h_last
    real(wp) :: before
    before = merge(zero, h_last, cycle == 0)
    if (.not. abs(before - this%h_before) > zero) return
    this%h_before = before
    call weigh(this)
  end subroutine paoli_begin_step

  !> The matrix depends on h alone.
  pure subroutine paoli_set_step(this, h)
    class(paoli_t), intent(inout) :: this
    real(wp), intent(in) :: h
    this%h = h
    this%staggered%on = .true.
    this%staggered%share = this%beta - 0.25_wp
    this%dissipates = .true.
    call weigh(this)
  end subroutine paoli_set_step

  !> Forces act over (h_before + h)/2, a share of h.
  pure subroutine weigh(this)
    class(paoli_t), intent(inout) :: this
    real(wp) :: share, back
    associate (h => this%h)
      share = half*(one + this%h_before/h)
      back = this%h_before
      if (is_first(this)) back = h
      this%stage = [stage_t(c_m=one/h**2, c_k=this%beta, load_weight=[share, zero], &
          force_weight=share, force_lead=-this%beta*back/share)]
      if (this%beta > zero) then
        this%stage(1)%c_c = half/h
        this%stage(1)%rate_weight(1) = share - half
      else    ! A stays diagonal
        this%stage(1)%rate_weight(1) = share
      end if
      this%stage(1)%rule = contact_rule_t(level=level_position, factor=share, lead=back)
      if (this%on_velocities) this%stage(1)%rule = contact_rule_t(level=level_velocity, &
          factor=share, now=h, safe_share=one)
      this%weight_now = share
      this%load_work_weight = [share, zero]
    end associate
  end subroutine weigh

  pure logical function is_first(this)
    class(paoli_t), intent(in) :: this
    is_first = .not. this%h_before > zero
  end function is_first

  subroutine paoli_start(this, model, system, state, status)
    class(paoli_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(inout) :: state
    type(status_t), intent(inout) :: status
    allocate (this%conjugate, this%ku, this%kv, mold=state%u)
    this%conjugate = zero
    this%ku = zero
    this%kv = zero
    call subtract_internal_force(system, -one, state%u, this%ku)
    call subtract_internal_force(system, -one, state%v, this%kv)
    this%v_start = state%v
  end subroutine paoli_start

  subroutine paoli_right_side(this, stage, system, state, b)
    class(paoli_t), intent(inout) :: this
    integer, intent(in) :: stage
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(inout) :: b(:, :)
    call multiply_mass(system, one/this%h, state%v, b)
  end subroutine paoli_right_side

  !> V+ = x/h, U_{n+1} = U_n + h V+, w = h (V- + V+)/2.
  subroutine paoli_update(this, stage, x, state)
    class(paoli_t), intent(inout) :: this
    integer, intent(in) :: stage
    real(wp), intent(inout) :: x(:, :)
    type(state_t), intent(inout) :: state
    real(wp) :: v
    integer :: i, k
    do i = 1, size(x, 2)
      do k = 1, size(x, 1)
        v = x(k, i)/this%h
        this%conjugate(k, i) = half*this%h*(state%v(k, i) + v)
        state%u(k, i) = state%u(k, i) + x(k, i)
        state%v(k, i) = v
      end do
    end do
  end subroutine paoli_update

  !> Only in the first step: what the energy at t = 0 has more than that of the scheme before,
  !> h U0.K V0/2 - beta h^2 V0.K V0/2 - w.K U0/2; and in a last one that is cut.
  real(wp) function paoli_dissipation(this, system, state)
    class(paoli_t), intent(inout) :: this
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    paoli_dissipation = zero
    if (allocated(system%solid)) return    ! counted from forces and energies, not from K
    if (is_first(this)) then
      paoli_dissipation = half*this%h*sum(this%v_start*this%ku) &
          - half*this%beta*this%h**2*sum(this%v_start*this%kv) &
          - half*sum(this%conjugate*this%ku)
    else if (abs(this%h - this%h_before) > zero) then
      paoli_dissipation = lost_by_cut(this, system, state)
    end if
  end function paoli_dissipation

  !> A step of another length h than the one before, g: what its internal forces do on w, less
  !> the change of the internal energy, is
  !>   (h - g)/2 {beta V-.K (h V+ - g V-) - (V+ - V-).K U_n/2}.
  real(wp) function lost_by_cut(this, system, state) result(lost)
    class(paoli_t), intent(inout) :: this
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    associate (h => this%h, g => this%h_before, v_before => this%v_start)
      v_before = 2.0_wp*this%conjugate/h - state%v
      this%ku = zero
      this%kv = zero
      call subtract_internal_force(system, -one, state%u - state%du, this%ku)
      call subtract_internal_force(system, -one, state%du - g*v_before, this%kv)
      lost = half*(h - g)*(this%beta*sum(v_before*this%kv) &
          - half*sum((state%v - v_before)*this%ku))
    end associate
  end function lost_by_cut

  !> x = h V+, V+ given or from U_{n+1}.
  pure real(wp) function paoli_given_motion(this, stage, state, direction, node, kind, value)
    class(paoli_t), intent(in) :: this
    integer, intent(in) :: stage
    type(state_t), intent(in) :: state
    integer, intent(in) :: direction, node, kind
    real(wp), intent(in) :: value
    paoli_given_motion = this%h*value
    if (kind == motion_displacement) &
        paoli_given_motion = value - state%u(direction, node)
  end function paoli_given_motion

end module time_paoli
