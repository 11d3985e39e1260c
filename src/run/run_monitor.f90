! SPDX-License-Identifier: BSD-3-Clause
!> What is watched beside the steps: energies and their growth, rotation of elements, bodies
!> that stand in each other, locking.
module run_monitor
  use assembly_bending, only: look_at_bending
  use assembly_turns, only: largest_rotation, first_inverted
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, fail, failed, add_place, status_numerical
  use base_strings, only: to_text
  use base_timers, only: phase_search, phase_energy, phase_other
  use contact_monitor, only: check_all
  use run_data, only: run_t, open_balance
  use time_ledger, only: evaluate_ledger, find_strain_energies
  implicit none
  private
  public :: moment, monitor, take_looks

contains

  !> The step and its time, for messages.
  function moment(run) result(text)
    type(run_t), intent(in) :: run
    character(:), allocatable :: text
    text = 'step '//to_text(run%state%cycle)//', time '//to_text(run%state%time)
  end function moment

  !> Energies, growth of energy, rotation of elements.
  subroutine monitor(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    call run%timers%enter(phase_energy)
    call evaluate_ledger(run%model, run%system, run%state, run%ledger)
    if (.not. allocated(run%newton)) call watch_rotation(run)
    if (run%state%cycle > 0) call watch_energy(run, status)
    if (run%model%controls%end_ratio > zero) then
      if (abs(run%ledger%ratio - one) > run%model%controls%end_ratio) call fail(status, &
          status_numerical, 'the energy ratio is '//to_text(run%ledger%ratio)// &
          ', beyond ENDENG of *CONTROL_TERMINATION', place=moment(run))
    end if
    run%broken = .not. abs(run%ledger%total) <= huge(one)
    if (run%broken) call fail(status, status_numerical, &
        'the energy is not finite (NaN or Inf)', place=moment(run), &
        hint='check units and loads; take a smaller step')
    call run%timers%enter(phase_other)
  end subroutine monitor

  !> Does the energy balance close, does energy grow? Not asked at t = 0: dynamics begins with
  !> its energies there, statics has round-off for energies.
  subroutine watch_energy(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    if (abs(run%ledger%residual) > open_balance) run%open_balances = run%open_balances + 1
    if (allocated(run%newton) .and. run%step%is_static) return    ! mean forces of load steps
    if (.not. run%ledger%growth > run%model%controls%growth) return
    if (run%ledger%growth*run%ledger%largest <= run%least_energy) return
    run%ledger%growths = run%ledger%growths + 1
    if (run%ledger%first_growth < 0) run%ledger%first_growth = run%state%cycle
    if (run%model%controls%stop_on_growth) call fail(status, status_numerical, &
        'energy growth of '//to_text(run%ledger%growth)//' of the largest term', &
        place=moment(run), hint='choose another scheme (doc/theory.md), or ACTION WARN')
  end subroutine watch_energy

  !> Small displacements are no rotations: the largest one, and how often it was too large.
  subroutine watch_rotation(run)
    type(run_t), intent(inout) :: run
    real(wp) :: angle
    integer :: element
    call largest_rotation(run%model, run%system, run%state%u, angle, element)
    if (angle*180.0_wp/acos(-one) > run%model%controls%rotation_warning) &
        run%rotations = run%rotations + 1
    if (.not. angle > run%rotation) return
    run%rotation = angle
    run%rotation_element = element
  end subroutine watch_rotation

  !> Looks at all bodies: at output times that are not too close, and at the end.
  subroutine take_looks(run, is_final, status)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: is_final
    type(status_t), intent(inout) :: status
    !> Steps between two looks: then they cost little beside the steps.
    integer, parameter :: apart = 50
    !> Strain energy beside the largest term below which bodies only fly.
    real(wp), parameter :: least_strain = 1.0e-6_wp
    if (failed(status)) return
    if (.not. is_final .and. run%state%cycle < run%looked + apart) return
    run%looked = run%state%cycle
    if (run%plan%contact) call check_overlap(run, status)
    if (failed(status) .or. .not. allocated(run%bending)) return
    call run%timers%enter(phase_energy)
    call find_strain_energies(run%model, run%system, run%state, run%ledger)
    if (sum(run%ledger%part_internal) > least_strain*run%ledger%largest) &
        call look_at_bending(run%model, run%system, run%state%u, run%ledger%part_internal, &
        run%state%cycle, run%bending)
    call run%timers%enter(phase_other)
  end subroutine take_looks

  !> True overlap of all bodies in contact, beyond what lists cover in every step. It means
  !> something while elements are not inverted.
  subroutine check_overlap(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    integer :: element
    call run%timers%enter(phase_search)
    call check_all(run%model, run%contact, run%state%u, run%state%cycle, status)
    element = 0
    if (size(run%model%contact) > 0) &
        element = first_inverted(run%model, run%system, run%state%u)
    if (element > 0) call fail(status, status_numerical, 'element '// &
        to_text(run%model%mesh%id(element))//', at node '//to_text(run%model%node_id( &
        run%model%mesh%node_of(1, element)))//', is turned inside out: its boundary is not '// &
        'that of a body any more', hint='check the loads and motions; take a smaller step')
    if (failed(status)) call add_place(status, moment(run))
  end subroutine check_overlap

end module run_monitor
