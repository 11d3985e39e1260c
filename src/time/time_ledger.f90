! SPDX-License-Identifier: BSD-3-Clause
!> The energy ledger: every term by its own formula, none as the remainder, so that the residual
!> means something. Works are added every step; energies are evaluated when asked for.
module time_ledger
  use assembly_forces, only: strain_energies
  use assembly_system, only: system_t, multiply_mass
  use base_archive, only: archive_t
  use base_kinds, only: wp, zero, half, one
  use contact_work, only: contact_work_t
  use model_data, only: model_t
  use model_state, only: state_t
  implicit none
  private

  type, public :: ledger_t
    real(wp) :: kinetic = zero, internal = zero, total = zero, initial = zero
    real(wp) :: external = zero      !< work of loads so far [F L]
    real(wp) :: motion = zero        !< work of prescribed motions so far
    type(contact_work_t) :: contact  !< lost so far: friction, normal; gained: unsolved
    real(wp) :: algorithmic = zero   !< taken out by the scheme so far
    real(wp) :: damping = zero
    real(wp) :: residual = zero      !< of the balance / largest term so far
    real(wp) :: ratio = one          !< total / (initial + external + motion)
    real(wp) :: largest = zero
    real(wp) :: momentum(2) = zero
    real(wp) :: angular = zero       !< about the origin, reference positions
    integer :: evaluated = -1        !< cycle of the last evaluation
    ! Growth: the balance total - external - motion must not rise above its minimum so far.
    real(wp) :: lowest = huge(1.0_wp)
    integer :: growths = 0
    integer :: first_growth = -1
    real(wp) :: largest_growth = zero   !< / largest term
    real(wp) :: worst_residual = zero
    real(wp), allocatable :: part_kinetic(:), part_internal(:), part_momentum(:, :)
    real(wp), allocatable :: part_mass(:)
    real(wp), allocatable :: mv(:, :)
    real(wp), allocatable :: share(:, :)  !< (parts, nodes) share of a node's momentum in a part
  end type ledger_t

  public :: make_ledger, evaluate_ledger, balance, exchange_ledger

contains

  !> Work space and the initial energy.
  subroutine make_ledger(model, system, state, ledger)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    type(ledger_t), intent(out) :: ledger
    integer :: parts, e, k
    parts = size(model%part)
    allocate (ledger%part_kinetic(parts), ledger%part_internal(parts), &
      ledger%part_momentum(2, parts))
    allocate (ledger%part_mass(parts), ledger%mv(2, model%nodes), &
      ledger%share(parts, model%nodes))
    ledger%share = zero
    ledger%part_mass = zero
    do e = 1, model%elements
      do k = 1, 4
        associate (s => ledger%share(model%element_part(e), model%connectivity(k, e)))
          s = s + one
        end associate
      end do
    end do
    do k = 1, model%nodes
      ledger%share(:, k) = ledger%share(:, k)/sum(ledger%share(:, k))
      ledger%part_mass = ledger%part_mass + ledger%share(:, k)*system%lumped(k)
    end do
    call evaluate_ledger(model, system, state, ledger)
    ledger%initial = ledger%total
    ledger%worst_residual = zero
    call balance(ledger)
  end subroutine make_ledger

  !> Energies, momenta, balance at the state; does nothing when the state has been evaluated.
  subroutine evaluate_ledger(model, system, state, ledger)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    type(ledger_t), intent(inout) :: ledger
    real(wp) :: energy, p(2)
    integer :: i, k
    if (ledger%evaluated == state%cycle) return
    ledger%evaluated = state%cycle
    ledger%mv = zero
    call multiply_mass(system, one, state%v, ledger%mv)
    call strain_energies(system, model%element_part, state%u, ledger%part_internal)
    ledger%part_kinetic = zero
    ledger%part_momentum = zero
    ledger%momentum = zero
    ledger%angular = zero
    do i = 1, model%nodes
      p = ledger%mv(:, i)
      energy = half*(state%v(1, i)*p(1) + state%v(2, i)*p(2))
      ledger%momentum = ledger%momentum + p
      ledger%angular = ledger%angular + (model%x(1, i)*p(2) - model%x(2, i)*p(1))
      do k = 1, size(model%part)
        ledger%part_kinetic(k) = ledger%part_kinetic(k) + ledger%share(k, i)*energy
        ledger%part_momentum(:, k) = ledger%part_momentum(:, k) + ledger%share(k, i)*p
      end do
    end do
    ledger%kinetic = sum(ledger%part_kinetic)
    ledger%internal = sum(ledger%part_internal)
    call balance(ledger)
    call watch_growth(ledger)
  end subroutine evaluate_ledger

  !> total, residual and ratio from the terms.
  pure subroutine balance(ledger)
    type(ledger_t), intent(inout) :: ledger
    real(wp) :: source, misfit
    ledger%total = ledger%kinetic + ledger%internal
    source = ledger%initial + ledger%external + ledger%motion
    ledger%largest = max(ledger%largest, ledger%kinetic, ledger%internal, abs(ledger%total), &
                         abs(ledger%initial), abs(ledger%external), abs(ledger%motion), &
                         abs(ledger%contact%friction), abs(ledger%contact%normal), &
                         abs(ledger%algorithmic), abs(ledger%damping))
    misfit = ledger%total - source + ledger%contact%friction + ledger%contact%normal &
             - ledger%contact%unsolved + ledger%algorithmic + ledger%damping
    ledger%residual = zero
    if (ledger%largest > zero) ledger%residual = misfit/ledger%largest
    ledger%worst_residual = max(ledger%worst_residual, abs(ledger%residual))
    ledger%ratio = one
    if (abs(source) > zero) ledger%ratio = ledger%total/source
  end subroutine balance

  !> How far the energy that the bodies were not given has risen above its minimum so far.
  pure subroutine watch_growth(ledger)
    type(ledger_t), intent(inout) :: ledger
    real(wp) :: free
    free = ledger%total - ledger%external - ledger%motion
    ledger%lowest = min(ledger%lowest, free)
    if (.not. ledger%largest > zero) return
    ledger%largest_growth = max(ledger%largest_growth, (free - ledger%lowest)/ledger%largest)
  end subroutine watch_growth

  !> Saves to or restores from the archive.
  subroutine exchange_ledger(archive, ledger)
    type(archive_t), intent(inout) :: archive
    type(ledger_t), intent(inout) :: ledger
    call archive%exchange('ledger.initial', ledger%initial)
    call archive%exchange('ledger.external', ledger%external)
    call archive%exchange('ledger.motion', ledger%motion)
    call archive%exchange('ledger.friction', ledger%contact%friction)
    call archive%exchange('ledger.normal', ledger%contact%normal)
    call archive%exchange('ledger.unsolved', ledger%contact%unsolved)
    call archive%exchange('ledger.allowed', ledger%contact%allowed_growth)
    call archive%exchange('ledger.algorithmic', ledger%algorithmic)
    call archive%exchange('ledger.damping', ledger%damping)
    call archive%exchange('ledger.largest', ledger%largest)
    call archive%exchange('ledger.lowest', ledger%lowest)
    call archive%exchange('ledger.worst', ledger%worst_residual)
    call archive%exchange('ledger.growth', ledger%largest_growth)
    call archive%exchange('ledger.growths', ledger%growths)
    call archive%exchange('ledger.first', ledger%first_growth)
  end subroutine exchange_ledger

end module time_ledger
