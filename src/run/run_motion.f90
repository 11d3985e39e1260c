! SPDX-License-Identifier: BSD-3-Clause
!> Prescribed motions and the reactions of held dofs. Only scenes that have motions or ask for
!> reactions come here, and they pay for the elements around those dofs.
module run_motion
  use assembly_damping, only: subtract_damping_force
  use assembly_forces, only: add_loads, subtract_internal_force
  use assembly_part, only: part_t, rows_of_nodes, columns_of_nodes, subtract_part
  use assembly_system, only: multiply_mass, constrain, clear_fixed, set_fixed, list_dofs
  use base_kinds, only: wp, zero, one
  use model_data, only: motion_t, curve_value
  use run_data, only: run_t
  use run_rigid, only: subtract_contact
  use run_static, only: add_shift
  implicit none
  private
  public :: make_motions, activate_motions, hold_active, find_given, impose_motions, &
      restore_motions, &
      start_reactions, keep_right_side, find_reactions, find_smooth_reactions, reaction_work

contains

  !> Work space of prescribed motions and reactions; the dofs that are held from the start.
  subroutine make_motions(run)
    type(run_t), intent(inout) :: run
    logical, allocatable :: is_held(:, :)
    logical :: changed
    integer :: d, n, k
    n = run%system%n
    d = run%system%dim
    allocate (run%reaction(d, n), run%mean_reaction(d, n), is_held(d, n))
    run%reaction = zero
    run%mean_reaction = zero
    is_held = .false.
    do k = 1, size(run%model%motion)
      is_held(run%model%motion(k)%direction, run%model%motion(k)%node) = .true.
    end do
    if (run%plan%motions) then
      if (.not. allocated(run%newton)) call columns_of_nodes(run%system, &
          any(is_held, dim=1), run%motion_part)
      allocate (run%given(d, n), run%active_motion(size(run%model%motion)))
      run%given = zero
      run%active_motion = .false.
      call activate_motions(run, run%scheme%h, changed)
    end if
    is_held = is_held .or. run%model%fixed
    if (allocated(run%newton)) then
      allocate (run%reaction_part%row(0))
    else
      call rows_of_nodes(run%system, any(is_held, dim=1), run%reaction_part)
    end if
    run%reaction_dof = list_dofs(is_held)
    allocate (run%b_held(d, size(run%reaction_part%row)))
  end subroutine make_motions

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
    logical, allocatable :: is_held(:, :)
    integer :: k
    allocate (is_held(run%system%dim, run%system%n))
    is_held = run%model%fixed
    do k = 1, size(run%model%motion)
      if (run%active_motion(k)) &
          is_held(run%model%motion(k)%direction, run%model%motion(k)%node) = .true.
    end do
    call constrain(run%system, is_held)
  end subroutine hold_active

  !> Does a motion act in the step of length h that ends at t1? In the step of no length, which
  !> brings the loads of the start of statics, one that begins then does.
  pure logical function acts(motion, t1, h)
    type(motion_t), intent(in) :: motion
    real(wp), intent(in) :: t1, h
    real(wp), parameter :: slack = 1.0e-9_wp
    acts = t1 > motion%birth + slack*h .or. (t1 >= motion%birth .and. .not. h > zero)
    acts = acts .and. t1 <= motion%death + slack*h
  end function acts

  !> run%given: the unknown x of the stage on held dofs.
  subroutine find_given(run, stage, t1)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: t1
    real(wp) :: value
    integer :: k, m
    do k = 1, size(run%model%motion)
      associate (motion => run%model%motion(k))
        value = zero
        if (run%active_motion(k)) &
            value = motion%factor*curve_value(run%model%curve(motion%curve), t1)
        do m = 1, size(motion%node)
          associate (given => run%given(motion%direction, motion%node(m)))
            given = zero
            if (run%active_motion(k)) given = run%scheme%given_motion(stage, run%state, &
                motion%direction, motion%node(m), motion%kind, value)
          end associate
        end do
      end associate
    end do
  end subroutine find_given

  !> b = b - A x_given on free dofs; on held ones what makes the solver give x_given.
  subroutine impose_motions(run, stage, t1)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: t1
    integer :: k, m
    call find_given(run, stage, t1)
    ! The matrix of an explicit step at finite deformation is diagonal: no columns to subtract.
    if (.not. allocated(run%newton)) call subtract_product(run, stage, run%motion_part, &
        run%given, run%b)
    call clear_fixed(run%system, run%b)
    do k = 1, size(run%model%motion)
      if (.not. run%active_motion(k)) cycle
      associate (d => run%model%motion(k)%direction, node => run%model%motion(k)%node)
        do m = 1, size(node)
          run%b(d, node(m)) = run%matrix%diagonal_entry(run%system%graph, d, node(m))* &
              run%given(d, node(m))
        end do
      end associate
    end do
  end subroutine impose_motions

  !> The given motions to the last digit, after the solve.
  subroutine restore_motions(run)
    type(run_t), intent(inout) :: run
    call set_fixed(run%system, run%given, run%x)
  end subroutine restore_motions

  !> b = b - A x with a part of the effective matrix.
  subroutine subtract_product(run, stage, part, x, b)
    type(run_t), intent(in) :: run
    integer, intent(in) :: stage
    type(part_t), intent(in) :: part
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(inout) :: b(:, :)
    associate (s => run%scheme%stage(stage))
      call subtract_part(run%system, part, s%c_m, s%c_c, s%c_layer, s%c_k, x, b)
    end associate
    if (allocated(run%shift)) call add_shift(run%shift, -x, b)
  end subroutine subtract_product

  !> Reactions of a state [F], M A + C V + K U - P - H' r, for schemes that weigh forces of both
  !> ends of a step: at t = 0, and where a run goes on that kept none.
  subroutine start_reactions(run)
    type(run_t), intent(inout) :: run
    real(wp), allocatable :: misfit(:, :)
    integer :: k
    if (.not. allocated(run%state%a)) return
    allocate (misfit(run%system%dim, run%system%n))
    misfit = zero
    call add_loads(run%model, run%system, run%state%time, one, misfit)
    call multiply_mass(run%system, -one, run%state%a, misfit)
    call subtract_internal_force(run%system, one, run%state%u, misfit)
    if (run%plan%damping) &
        call subtract_damping_force(run%system, one, run%state%v, misfit)
    call subtract_contact(run, -one, misfit)
    run%reaction = zero
    do k = 1, size(run%reaction_dof, 2)
      associate (d => run%reaction_dof(1, k), i => run%reaction_dof(2, k))
        if (run%system%fixed(d, i)) run%reaction(d, i) = -misfit(d, i)
      end associate
    end do
  end subroutine start_reactions

  !> b at the nodes that may be held, before it is cleared there.
  subroutine keep_right_side(run)
    type(run_t), intent(inout) :: run
    integer :: k
    if (allocated(run%newton)) run%newton%d = run%b
    do k = 1, size(run%reaction_part%row)
      run%b_held(:, k) = run%b(:, run%reaction_part%row(k))
    end do
  end subroutine keep_right_side

  !> Reactions of the held dofs, A x - b - H' r, for the unknown x (dim, n) of a stage just
  !> done, and their mean over the step as the scheme weighs contact forces; others are zero.
  subroutine find_reactions(run, stage, x)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: x(:, :)
    integer :: k
    associate (part => run%reaction_part, factor => run%scheme%stage(stage)%rule%factor)
      if (allocated(run%newton)) then
        call take_residual(run, stage, x)
      else
        do k = 1, size(part%row)
          run%b(:, part%row(k)) = run%b_held(:, k)
        end do
        call subtract_product(run, stage, part, x, run%b)
      end if
      call subtract_contact(run, -factor, run%b)
      do k = 1, size(run%reaction_dof, 2)
        associate (d => run%reaction_dof(1, k), i => run%reaction_dof(2, k))
          run%mean_reaction(d, i) = run%scheme%weight_before*run%reaction(d, i)
          run%reaction(d, i) = zero
          if (run%system%fixed(d, i)) run%reaction(d, i) = -run%b(d, i)/factor
          run%mean_reaction(d, i) = run%mean_reaction(d, i) &
              + run%scheme%weight_now*run%reaction(d, i)
        end associate
      end do
    end associate
  end subroutine find_reactions

  !> Reactions that belong to the acceleration of the smooth forces, M s - P + K U of the state:
  !> they act as loads do.
  subroutine find_smooth_reactions(run)
    type(run_t), intent(inout) :: run
    integer :: k
    run%b = zero
    call add_loads(run%model, run%system, run%state%time, one, run%b)
    associate (part => run%reaction_part)
      call subtract_part(run%system, part, one, zero, zero, zero, run%state%a_smooth, run%b)
      call subtract_part(run%system, part, zero, zero, zero, one, run%state%u, run%b)
    end associate
    do k = 1, size(run%reaction_dof, 2)
      associate (d => run%reaction_dof(1, k), i => run%reaction_dof(2, k))
        run%smooth_reaction(d, i) = zero
        if (run%system%fixed(d, i)) run%smooth_reaction(d, i) = -run%b(d, i)
      end associate
    end do
  end subroutine find_smooth_reactions

  !> Work of forces on held dofs (dim, n) in the motion on which the forces of the step do work
  !> [F L].
  pure real(wp) function reaction_work(run, force, motion)
    type(run_t), intent(in) :: run
    real(wp), intent(in) :: force(:, :), motion(:, :)
    integer :: k
    reaction_work = zero
    do k = 1, size(run%reaction_dof, 2)
      associate (d => run%reaction_dof(1, k), i => run%reaction_dof(2, k))
        reaction_work = reaction_work + motion(d, i)*force(d, i)
      end associate
    end do
  end function reaction_work

  !> run%b: what is left of the balance of all nodes but for contact, at finite deformation.
  subroutine take_residual(run, stage, x)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    real(wp), intent(in) :: x(:, :)
    if (run%newton%is_explicit) then
      run%b = run%newton%d
      call multiply_mass(run%system, -run%scheme%stage(stage)%c_m, x, run%b)
    else
      run%b = run%newton%residual
    end if
  end subroutine take_residual

end module run_motion
