! SPDX-License-Identifier: BSD-3-Clause
!> HHT (Hilber, Hughes & Taylor 1977) and the generalised alpha-method (Chung & Hulbert 1993).
!>   M [(1 - am) A1 + am A0] + K [(1 - af) U1 + af U0] = (1 - af) P1 + af P0 + R1,
!> U1, V1 by Newmark with gamma = 1/2 - am + af, beta = (gamma + 1/2)^2/4. The contact force
!> R1 is NOT averaged like the loads: it acts with weight 1, else the schemes gain energy on
!> impact.
!> C V is averaged like K U. What the next step needs, K U and M (k D - am A0), is made at the
!> end of a step together with what the ledger needs, for little more than either alone.
!> One stage: [k M + (1 - af) (gamma C/(beta h) + K)] x = M (k D - am A0) - K U0 + (1 - af) P1 +
!> af P0 - C {[1 - (1 - af) gamma/beta] V0 + (1 - af) h [1 - gamma/(2 beta)] A0} + R1 with
!> k = (1 - am)/(beta h^2), D = h V0 + h^2 (1/2 - beta) A0. At am = af = 1/2 (rho = 1) it is the
!> theta-method at theta = xi = 1/2.
module time_alpha
  use assembly_forces, only: strain_product, subtract_internal_force
  use assembly_system, only: system_t, multiply_mass, mass_products
  use base_kinds, only: wp, zero, one, half
  use base_list, only: swap
  use base_status, only: status_t
  use model_data, only: model_t
  use model_state, only: state_t
  use time_base, only: scheme_t, stage_t
  use time_start, only: start_acceleration, newmark_motion
  implicit none
  private

  type, extends(scheme_t), public :: alpha_t
    real(wp) :: am = zero
    real(wp) :: af = zero
    real(wp) :: gamma = half
    real(wp) :: beta = 0.25_wp
    real(wp), allocatable :: d(:, :)        !< k D - am A0, of the next step [L/T2]
    real(wp), allocatable :: da(:, :), m_da(:, :)   !< A1 - A0 and M (A1 - A0)
    ! Only where the next step begins as this one ends.
    logical :: looks_ahead = .true.
    real(wp), allocatable :: inertia(:, :)  !< M (k D - am A0) of the next step [F]
    real(wp), allocatable :: force(:, :), force_before(:, :)   !< K U1, K U0 [F]
  contains
    procedure :: set_step => alpha_set_step
    procedure :: start => alpha_start
    procedure :: right_side => alpha_right_side
    procedure :: update => alpha_update
    procedure :: dissipation => alpha_dissipation
    procedure :: given_motion => alpha_given_motion
  end type alpha_t

  public :: hht, generalised_alpha

contains

  !> HHT for alpha in [-1/3, 0).
  pure type(alpha_t) function hht(alpha)
    real(wp), intent(in) :: alpha
    hht = alpha_t(am=zero, af=-alpha, gamma=half - alpha, beta=(one - alpha)**2/4.0_wp)
  end function hht

  !> The generalised alpha-method for rho in [0, 1], the spectral radius at infinite frequency.
  pure type(alpha_t) function generalised_alpha(rho)
    real(wp), intent(in) :: rho
    real(wp) :: am, af, gamma
    am = (2.0_wp*rho - one)/(rho + one)
    af = rho/(rho + one)
    gamma = half - am + af
    generalised_alpha = alpha_t(am=am, af=af, gamma=gamma, beta=(gamma + half)**2/4.0_wp)
  end function generalised_alpha

  pure subroutine alpha_set_step(this, h)
    class(alpha_t), intent(inout) :: this
    real(wp), intent(in) :: h
    real(wp) :: rate
    this%h = h
    rate = (one - this%af)*this%gamma/this%beta
    this%stage = [stage_t(c_m=(one - this%am)/(this%beta*h**2), c_k=one - this%af, &
        load_weight=[this%af, one - this%af], force_weight=zero, c_c=rate/h, &
        rate_weight=[one - rate, h*(one - this%af - half*rate)])]
    this%load_work_weight = [this%af, one - this%af]
    this%dissipates = .true.
    this%is_current = .false.
  end subroutine alpha_set_step

  subroutine alpha_start(this, model, system, state, status)
    class(alpha_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(inout) :: state
    type(status_t), intent(inout) :: status
    allocate (this%d, this%da, this%m_da, mold=state%v)
    if (this%looks_ahead) allocate (this%inertia, this%force, this%force_before, mold=state%v)
    this%da = zero
    call start_acceleration(trim(this%name), model, system, this%starts_in_balance, state, &
        status)
  end subroutine alpha_start

  !> M (k D - am A0) - K U0.
  subroutine alpha_right_side(this, stage, system, state, b)
    class(alpha_t), intent(inout) :: this
    integer, intent(in) :: stage
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(inout) :: b(:, :)
    if (.not. this%is_current) then
      call predict(size(this%d), weights_of_d(this), state%v, state%a, this%d)
      call look_ahead(this, system, state)
    end if
    call add_difference(size(b), this%inertia, this%force, b)
  end subroutine alpha_right_side

  pure subroutine add_difference(n, x, y, b)
    integer, intent(in) :: n
    real(wp), intent(in) :: x(n), y(n)
    real(wp), intent(inout) :: b(n)
    b = b + (x - y)
  end subroutine add_difference

  !> k D - am A0 = w1 V0 + w2 A0.
  pure function weights_of_d(this) result(weight)
    class(alpha_t), intent(in) :: this
    real(wp) :: weight(2)
    associate (k => this%stage(1)%c_m, h => this%h)
      weight = [k*h, k*h**2*(half - this%beta) - this%am]
    end associate
  end function weights_of_d

  !> M (k D - am A0) and K U of a step that begins at the state, and M (A1 - A0) of the one that
  !> has ended there.
  subroutine look_ahead(this, system, state)
    class(alpha_t), intent(inout) :: this
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    call mass_products(system, this%d, this%da, this%inertia, this%m_da)
    this%force = zero
    call subtract_internal_force(system, -one, state%u, this%force)
    this%is_current = .true.
  end subroutine look_ahead

  pure subroutine predict(n, weight, v, a, d)
    integer, intent(in) :: n
    real(wp), intent(in) :: weight(2), v(n), a(n)
    real(wp), intent(out) :: d(n)
    d = weight(1)*v + weight(2)*a
  end subroutine predict

  !> U1 = U0 + x, A1 = (x - D)/(beta h^2), V1 = V0 + h [(1 - gamma) A0 + gamma A1].
  subroutine alpha_update(this, stage, x, state)
    class(alpha_t), intent(inout) :: this
    integer, intent(in) :: stage
    real(wp), intent(inout) :: x(:, :)
    type(state_t), intent(inout) :: state
    this%is_current = .false.
    call update_kernel(size(x), this%h, this%beta, this%gamma, weights_of_d(this), x, &
        state%u, state%v, state%a, this%da, this%d)
  end subroutine alpha_update

  !> With dA = (x - h V0)/(beta h^2) - A0/(2 beta); and D of the next step.
  pure subroutine update_kernel(n, h, beta, gamma, weight, x, u, v, a, da, d)
    integer, intent(in) :: n
    real(wp), intent(in) :: h, beta, gamma, weight(2), x(n)
    real(wp), intent(inout) :: u(n), v(n), a(n)
    real(wp), intent(out) :: da(n), d(n)
    real(wp) :: of_x, of_a
    integer :: i
    of_x = one/(beta*h**2)
    of_a = half/beta
    do i = 1, n
      da(i) = of_x*(x(i) - h*v(i)) - of_a*a(i)
      v(i) = v(i) + h*(a(i) + gamma*da(i))
      u(i) = u(i) + x(i)
      a(i) = a(i) + da(i)
      d(i) = weight(1)*v(i) + weight(2)*a(i)
    end do
  end subroutine update_kernel

  !> (1/2 - af) dU.K dU - (gamma - 1 + am) dU.M dA + c h^2 d(A.M A/2) + c (gamma - 1/2) h^2
  !> dA.M dA, c = beta - gamma/2. The first two terms nearly cancel where waves are resolved.
  real(wp) function alpha_dissipation(this, system, state)
    class(alpha_t), intent(inout) :: this
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp) :: c, weight(3)
    c = (this%beta - half*this%gamma)*this%h**2
    weight = [c, c*(this%gamma - one), this%gamma - one + this%am]
    if (this%looks_ahead) then
      call swap(this%force, this%force_before)
      call look_ahead(this, system, state)
      alpha_dissipation = all_terms(system%dim, system%n, weight, half - this%af, state%a, &
          this%da, state%du, this%m_da, this%force, this%force_before)
    else
      this%m_da = zero
      call multiply_mass(system, one, this%da, this%m_da)
      alpha_dissipation = inertia_terms(size(this%da), weight, state%a, this%da, state%du, &
          this%m_da) + (half - this%af)*strain_product(system, state%du)
    end if
  end function alpha_dissipation

  !> M dA.(w1 A1 + w2 dA - w3 dU): d(A.M A/2) is M dA.(A1 - dA/2).
  pure real(wp) function inertia_terms(n, weight, a, da, du, m_da) result(terms)
    integer, intent(in) :: n
    real(wp), intent(in) :: weight(3), a(n), da(n), du(n), m_da(n)
    integer :: i
    terms = zero
    do i = 1, n
      terms = terms + m_da(i)*(weight(1)*a(i) + weight(2)*da(i) - weight(3)*du(i))
    end do
  end function inertia_terms

  !> The same, and q dU.(K U1 - K U0), in one pass.
  pure real(wp) function all_terms(dim, n, weight, q, a, da, du, m_da, after, &
      before) result(terms)
    integer, intent(in) :: dim, n
    real(wp), intent(in) :: weight(3), q
    real(wp), intent(in), dimension(dim, n) :: a, da, du, m_da, after, before
    real(wp) :: total(3)
    integer :: i
    total = zero
    do i = 1, n
      total(:dim) = total(:dim) + (m_da(:, i)*(weight(1)*a(:, i) + weight(2)*da(:, i) &
          - weight(3)*du(:, i)) + q*du(:, i)*(after(:, i) - before(:, i)))
    end do
    terms = sum(total(:dim))
  end function all_terms

  !> x = U1 - U0, or D + beta h^2 A1 with A1 given or from V1.
  pure real(wp) function alpha_given_motion(this, stage, state, direction, node, kind, value)
    class(alpha_t), intent(in) :: this
    integer, intent(in) :: stage
    type(state_t), intent(in) :: state
    integer, intent(in) :: direction, node, kind
    real(wp), intent(in) :: value
    alpha_given_motion = newmark_motion(this%h, this%beta, this%gamma, state, direction, &
        node, kind, value)
  end function alpha_given_motion

end module time_alpha
