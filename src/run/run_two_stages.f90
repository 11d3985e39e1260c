! SPDX-License-Identifier: BSD-3-Clause
!> What a step of two stages needs besides: contact is judged after each of them, and forces of
!> each do work on a motion of their own.
module run_two_stages
  use base_kinds, only: wp, zero
  use base_status, only: status_t
  use base_timers, only: phase_contact
  use contact_rows, only: copy_rows
  use contact_stage, only: evaluate_contact, certify_stage
  use contact_work, only: add_contact_step, add_stage_work, add_stage_reactions
  use run_data, only: run_t
  use run_motion, only: find_reactions, find_smooth_reactions, reaction_work
  implicit none
  private
  public :: close_stage, add_stage_works, find_stage_reactions

contains

  !> A stage is done: its certificate, its rows and reactions for the works of the step.
  subroutine close_stage(run, stage, acting, status)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    logical, intent(in) :: acting
    type(status_t), intent(inout) :: status
    if (run%plan%reactions) then
      if (run%scheme%stage(stage)%moves) then
        call find_reactions(run, stage, run%state%du)
      else
        call find_reactions(run, stage, run%x)
      end if
      if (stage == 1) then
        run%first_reaction = run%reaction
        run%reaction = zero
      end if
    end if
    if (.not. run%plan%contact) return
    if (run%contact%idle_steps == 2) return
    call run%timers%enter(phase_contact)
    if (run%scheme%stage(stage)%moves) then
      call evaluate_contact(run%model, run%contact, run%state%u, run%state%du, &
          run%state%cycle + 1, acting, status)
    else
      call certify_stage(run%contact, run%x, run%state%du, acting)
    end if
    if (stage == 1) call copy_rows(run%contact%rows, run%contact%before)
  end subroutine close_stage

  !> Forces, impulses and works of contact in the step.
  subroutine add_stage_works(run)
    type(run_t), intent(inout) :: run
    associate (scheme => run%scheme, ledger => run%ledger)
      call add_stage_work(run%contact, scheme%stage_work(1)%x, ledger%contact)
      if (scheme%adds_reactions) call add_stage_reactions(run%contact)
      call add_contact_step(run%contact, scheme%weight_before, scheme%weight_now, scheme%h, &
          scheme%stage_work(2)%x, ledger%contact)
    end associate
  end subroutine add_stage_works

  !> Work of the reactions of held dofs in the step [F L]. Smooth ones act as loads do, at both
  !> ends of the step; what a stage has beside them is an impulse.
  subroutine find_stage_reactions(run, work)
    type(run_t), intent(inout) :: run
    real(wp), intent(out) :: work
    real(wp) :: smooth(2)
    associate (scheme => run%scheme, first => run%first_reaction)
      smooth = zero
      if (allocated(run%smooth_reaction)) then
        smooth = scheme%stage%load_weight(2)
        work = scheme%load_work_weight(1)*reaction_work(run, run%smooth_reaction, run%state%du)
        call find_smooth_reactions(run)
        work = work &
            + scheme%load_work_weight(2)*reaction_work(run, run%smooth_reaction, run%state%du) &
            - smooth(1)*reaction_work(run, run%smooth_reaction, scheme%stage_work(1)%x) &
            - smooth(2)*reaction_work(run, run%smooth_reaction, scheme%stage_work(2)%x)
      else
        work = zero
      end if
      work = work + reaction_work(run, first, scheme%stage_work(1)%x)
      if (scheme%adds_reactions) run%mean_reaction = run%reaction + first
      work = work + reaction_work(run, run%mean_reaction, scheme%stage_work(2)%x)
      if (smooth(2) > zero) run%mean_reaction = run%reaction/smooth(2)
    end associate
  end subroutine find_stage_reactions

end module run_two_stages
