! SPDX-License-Identifier: BSD-3-Clause
!> Prescribed motions and the reactions of held dofs. Only scenes that have motions or ask for
!> reactions come here.
module run_motion
  use assembly_forces, only: add_loads, subtract_internal_force, subtract_damping_force
  use assembly_system, only: multiply_mass, clear_fixed, list_fixed
  use base_kinds, only: wp, zero, one
  use contact_work, only: subtract_contact_force
  use model_data, only: motion_t, curve_value
  use run_data, only: run_t
  use run_static, only: add_shift
  implicit none
  private
  public :: activate_motions, hold_active, impose_motions, restore_motions, &
      start_reactions, find_reactions

contains

  !> Which motions act in the step that ends at t1; changed tells that the set of held dofs is
  !> another one, so that the effective matrix must be factored again.
  subroutine activate_motions(run, t1, changed)
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: t1
    logical, intent(out) :: changed
    logical :: active
    integer :: k
    changed = .false.
    do k = 1, size(run%model%motion)
      active = acts(run%model%motion(k), t1, run%scheme%h)
      if (active .neqv. run%active_motion(k)) changed = .true.
      run%active_motion(k) = active
    end do
    if (changed) call hold_active(run)
  end subroutine activate_motions

  !> The held dofs: supports, and the motions that act.
  subroutine hold_active(run)
    type(run_t), intent(inout) :: run
    integer :: k
    run%system%fixed = run%model%fixed
    do k = 1, size(run%model%motion)
      if (run%active_motion(k)) &
          run%system%fixed(run%model%motion(k)%direction, run%model%motion(k)%node) = .true.
    end do
    call list_fixed(run%system)
  end subroutine hold_active

  pure logical function acts(motion, t1, h)
    type(motion_t), intent(in) :: motion
    real(wp), intent(in) :: t1, h
    real(wp), parameter :: slack = 1.0e-9_wp
    acts = t1 > motion%birth + slack*h .and. t1 <= motion%death + slack*h
  end function acts

  !> b = b - A x_given on free dofs; on held ones what makes the solver give x_given.
  subroutine impose_motions(run, stage, t1)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: t1
    real(wp) :: value
    integer :: k, m
    run%given = zero
    do k = 1, size(run%model%motion)
      if (.not. run%active_motion(k)) cycle
      associate (motion => run%model%motion(k))
        value = motion%factor*curve_value(run%model%curve(motion%curve), t1)
        do m = 1, size(motion%node)
          run%given(motion%direction, motion%node(m)) = run%scheme%given_motion(run%state, &
              motion%direction, motion%node(m), motion%kind, value)
        end do
      end associate
    end do
    call subtract_product(run, stage, run%given, run%b)
    call clear_fixed(run%system, run%b)
    do k = 1, size(run%system%fixed_list, 2)
      associate (d => run%system%fixed_list(1, k), i => run%system%fixed_list(2, k))
        run%b(d, i) = run%matrix%value(d, d, run%system%graph%position(i, i))*run%given(d, i)
      end associate
    end do
  end subroutine impose_motions

  !> The given motions to the last digit, after the solve.
  subroutine restore_motions(run)
    type(run_t), intent(inout) :: run
    integer :: k
    do k = 1, size(run%system%fixed_list, 2)
      associate (d => run%system%fixed_list(1, k), i => run%system%fixed_list(2, k))
        run%x(d, i) = run%given(d, i)
      end associate
    end do
  end subroutine restore_motions

  !> b = b - A x, the whole effective matrix.
  subroutine subtract_product(run, stage, x, b)
    type(run_t), intent(in) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(inout) :: b(:, :)
    associate (s => run%scheme%stage(stage))
      call multiply_mass(run%system, -s%c_m, x, b)
      call subtract_internal_force(run%system, s%c_k, x, b)
      call subtract_damping_force(run%system, s%c_c, x, b)
    end associate
    if (allocated(run%shift)) call add_shift(run%shift, -x, b)
  end subroutine subtract_product

  !> Reactions of a state [F], M A + K U - P - H' r, for schemes that weigh forces of both ends
  !> of a step: at t = 0, and where a run goes on that kept none.
  subroutine start_reactions(run)
    type(run_t), intent(inout) :: run
    if (.not. allocated(run%state%a)) return
    run%b_whole = zero
    call add_loads(run%model, run%system, run%state%time, one, run%b_whole)
    call multiply_mass(run%system, -one, run%state%a, run%b_whole)
    call subtract_internal_force(run%system, one, run%state%u, run%b_whole)
    call subtract_contact_force(run%contact, -one, run%b_whole)
    call take_held(run, run%b_whole)
  end subroutine start_reactions

  !> Reactions of the held dofs, A x - b - H' r, for the motion of the step just done, and their
  !> mean over the step as the scheme weighs contact forces; others are zero. motion_work is
  !> what they did in the step [F L].
  subroutine find_reactions(run, motion_work)
    type(run_t), intent(inout) :: run
    real(wp), intent(out) :: motion_work
    run%b = run%b_whole
    call subtract_product(run, size(run%scheme%stage), run%state%du, run%b)
    call subtract_contact_force(run%contact, -run%contact%factor, run%b)
    run%mean_reaction = run%scheme%weight_before*run%reaction
    if (run%contact%factor < one) run%b = run%b/run%contact%factor
    call take_held(run, run%b)
    run%mean_reaction = run%mean_reaction + run%scheme%weight_now*run%reaction
    if (allocated(run%scheme%conjugate)) then
      motion_work = sum(run%scheme%conjugate*run%mean_reaction)
    else
      motion_work = sum(run%state%du*run%mean_reaction)
    end if
  end subroutine find_reactions

  !> reaction = - misfit on the held dofs, zero elsewhere.
  subroutine take_held(run, misfit)
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: misfit(:, :)
    integer :: k
    run%reaction = zero
    do k = 1, size(run%system%fixed_list, 2)
      associate (d => run%system%fixed_list(1, k), i => run%system%fixed_list(2, k))
        run%reaction(d, i) = -misfit(d, i)
      end associate
    end do
  end subroutine take_held

end module run_motion
