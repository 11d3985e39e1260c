! SPDX-License-Identifier: BSD-3-Clause
!> What schemes with accelerations share: their start, and motions that are given.
module time_start
  use assembly_damping, only: subtract_damping_force
  use assembly_forces, only: subtract_internal_force, add_loads
  use assembly_system, only: system_t, multiply_mass, effective_matrix, clear_fixed
  use base_kinds, only: wp, zero, half, one
  use base_status, only: status_t, fail, failed, status_numerical
  use linalg_graph, only: block_matrix_t
  use linalg_ldlt, only: ldlt_t
  use linalg_solver, only: solve_whole
  use model_data, only: model_t, curve_value, curve_slope, motion_velocity, &
      motion_displacement
  use model_state, only: state_t
  implicit none
  private
  public :: start_acceleration, newmark_motion

  !> A mass pivot below this share of its diagonal is round-off of a singular mass.
  real(wp), parameter :: null_pivot = 1.0e-12_wp

contains

  !> A0 [L/T2] into state%a from M A0 = P0 - K U0 - C V0 at the time of the state; in balance
  !> (after a static phase) the damping alone is left. Where the mass is singular the
  !> acceleration is zero, if the right side allows it; else it fails, naming the scheme.
  subroutine start_acceleration(name, model, system, in_balance, state, status)
    character(*), intent(in) :: name
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    logical, intent(in) :: in_balance
    type(state_t), intent(inout) :: state
    type(status_t), intent(inout) :: status
    type(ldlt_t) :: solver
    type(block_matrix_t) :: matrix
    real(wp), allocatable :: f(:, :), a(:, :)
    real(wp) :: size_f
    if (in_balance .and. .not. allocated(system%damping)) return
    allocate (f(system%dim, system%n))
    f = zero
    if (.not. in_balance) then
      call give_accelerations(model, state%time, state%a)
      call multiply_mass(system, -one, state%a, f)
      call add_loads(model, system, state%time, one, f)
      call subtract_internal_force(system, one, state%u, f)
    end if
    if (allocated(system%damping)) call subtract_damping_force(system, one, state%v, f)
    call clear_fixed(system, f)
    size_f = maxval(abs(f))
    if (.not. size_f > zero) return
    solver%options%null_pivot = null_pivot
    call effective_matrix(system, one, zero, zero, zero, matrix)
    call solver%analyse(system%graph, size(f, 1), [integer ::], status)
    call solver%factor(system%graph, matrix, status)
    if (failed(status)) return
    allocate (a, mold=f)
    call solve_whole(solver, f, a)
    call multiply_mass(system, -one, a, f)
    call clear_fixed(system, f)
    if (maxval(abs(f)) > 1.0e-9_wp*size_f) &
        call fail(status, status_numerical, name//' cannot start: the mass '// &
        trim(model%controls%mass)//' is singular and the loads at t = 0 act '// &
        'where it is zero', hint='choose another mass, or SCHEME THETA')
    state%a = state%a + a
  end subroutine start_acceleration

  !> Accelerations at `time` of dofs whose motion is prescribed then.
  subroutine give_accelerations(model, time, a)
    type(model_t), intent(in) :: model
    real(wp), intent(in) :: time
    real(wp), intent(inout) :: a(:, :)
    real(wp) :: value
    integer :: k
    do k = 1, size(model%motion)
      associate (m => model%motion(k))
        if (m%birth > time .or. m%kind == motion_displacement) cycle
        value = m%factor*curve_value(model%curve(m%curve), time)
        if (m%kind == motion_velocity) value = m%factor*curve_slope(model%curve(m%curve), time)
        a(m%direction, m%node) = value
      end associate
    end do
  end subroutine give_accelerations

  !> x = U1 - U0 of one dof by Newmark's update with a given end: from its displacement, or
  !> D + beta h^2 A1, D = h V0 + h^2 (1/2 - beta) A0, with A1 given or from V1 (kind: motion_...
  !> of model_data).
  pure real(wp) function newmark_motion(h, beta, gamma, state, direction, node, kind, value)
    real(wp), intent(in) :: h, beta, gamma
    type(state_t), intent(in) :: state
    integer, intent(in) :: direction, node, kind
    real(wp), intent(in) :: value
    real(wp) :: a1
    associate (v0 => state%v(direction, node), a0 => state%a(direction, node))
      if (kind == motion_displacement) then
        newmark_motion = value - state%u(direction, node)
        return
      end if
      a1 = value
      if (kind == motion_velocity) a1 = ((value - v0)/h - (one - gamma)*a0)/gamma
      newmark_motion = h*v0 + h**2*((half - beta)*a0 + beta*a1)
    end associate
  end function newmark_motion

end module time_start
