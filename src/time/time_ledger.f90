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
  use time_base, only: staggered_t
  implicit none
  private

  type, public :: ledger_t
    real(wp) :: kinetic = zero, internal = zero, total = zero, initial = zero
    real(wp) :: external = zero      !< work of loads so far [F L]
    real(wp) :: motion = zero        !< work of prescribed motions so far
    type(contact_work_t) :: contact  !< lost so far: friction, normal; gained: unsolved
    real(wp) :: algorithmic = zero   !< taken out by the scheme so far
    real(wp) :: damping = zero
    !> Strain energies of the parts at the start of the step just done, only of explicit steps
    !> at finite deformation, whose energy is the mean of both ends [F L].
    real(wp), allocatable :: part_before(:)
    real(wp) :: plastic = zero          !< plastic work, stored hardening included
    real(wp) :: residual = zero      !< of the balance / largest term so far
    real(wp) :: ratio = one          !< total / (initial + external + motion)
    real(wp) :: largest = zero
    real(wp) :: momentum(3) = zero
    real(wp) :: angular(3) = zero    !< about the origin, reference positions
    integer :: evaluated = -1        !< cycle of the last evaluation
    type(staggered_t) :: staggered   !< of the scheme
    ! Growth: the balance total - external - motion must not rise above its minimum so far.
    real(wp) :: lowest = huge(1.0_wp)
    integer :: growths = 0
    integer :: first_growth = -1
    real(wp) :: growth = zero           !< at the last evaluation, / largest term
    real(wp) :: largest_growth = zero   !< so far
    real(wp) :: worst_residual = zero
    real(wp), allocatable :: part_kinetic(:), part_internal(:), part_momentum(:, :)
    real(wp), allocatable :: part_mass(:)
    real(wp), allocatable :: mv(:, :)
    !> Part of each node; 0 where several parts meet: such a node counts in equal shares for
    !> every element there, listed in shared(:, (node, part)) with their share.
    integer, allocatable :: owner(:)
    integer, allocatable :: shared(:, :)
    real(wp), allocatable :: share(:)
  end type ledger_t

  public :: make_ledger, evaluate_ledger, find_strain_energies, balance, exchange_ledger, &
      largest_work

contains

  !> Work space and the initial energy.
  subroutine make_ledger(model, system, state, ledger)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    type(ledger_t), intent(out) :: ledger
    integer :: parts, i, k
    parts = size(model%part)
    allocate (ledger%part_kinetic(parts), ledger%part_internal(parts))
    allocate (ledger%part_momentum(model%dim, parts), ledger%part_mass(parts), &
        ledger%mv(model%dim, model%nodes))
    call find_owners(model, ledger)
    ledger%part_mass = zero
    do i = 1, model%mesh_nodes
      if (ledger%owner(i) <= 0) cycle
      ledger%part_mass(ledger%owner(i)) = ledger%part_mass(ledger%owner(i)) + system%lumped(i)
    end do
    do k = 1, size(ledger%share)
      associate (m => ledger%part_mass(ledger%shared(2, k)))
        m = m + ledger%share(k)*system%lumped(ledger%shared(1, k))
      end associate
    end do
    if (allocated(model%rigid)) ledger%part_mass(model%rigid%part) = model%rigid%mass
    call evaluate_ledger(model, system, state, ledger)
    ledger%initial = ledger%total
    ledger%worst_residual = zero
    ledger%growth = zero
    ledger%largest_growth = zero
    ledger%lowest = ledger%total
    call balance(ledger)
  end subroutine make_ledger

  !> Which part each node belongs to.
  subroutine find_owners(model, ledger)
    type(model_t), intent(in) :: model
    type(ledger_t), intent(inout) :: ledger
    integer, allocatable :: elements_of(:)
    integer :: e, k, n, pass
    allocate (ledger%owner(model%nodes), elements_of(model%nodes))
    ledger%owner = -1
    elements_of = 0
    do e = 1, model%mesh%n
      do k = 1, model%mesh%count_of(e)
        associate (i => model%mesh%node_of(k, e), part => model%mesh%part(e))
          elements_of(i) = elements_of(i) + 1
          if (ledger%owner(i) == -1) ledger%owner(i) = part
          if (ledger%owner(i) /= part) ledger%owner(i) = 0
        end associate
      end do
    end do
    do pass = 1, 2
      if (pass == 2) allocate (ledger%shared(2, n), ledger%share(n))
      n = 0
      do e = 1, model%mesh%n
        do k = 1, model%mesh%count_of(e)
          if (ledger%owner(model%mesh%node_of(k, e)) /= 0) cycle
          n = n + 1
          if (pass == 1) cycle
          ledger%shared(:, n) = [model%mesh%node_of(k, e), model%mesh%part(e)]
          ledger%share(n) = one/elements_of(model%mesh%node_of(k, e))
        end do
      end do
    end do
  end subroutine find_owners

  !> Energies, momenta, balance at the state; does nothing when the state has been evaluated.
  subroutine evaluate_ledger(model, system, state, ledger)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    type(ledger_t), intent(inout) :: ledger
    integer :: i, k
    if (ledger%evaluated == state%cycle) return
    ledger%evaluated = state%cycle
    ledger%mv = zero
    call multiply_mass(system, one, state%v, ledger%mv)
    call find_internal(model, system, state, ledger)
    ledger%part_kinetic = zero
    ledger%part_momentum = zero
    ledger%angular = zero
    do i = 1, model%mesh_nodes
      if (model%controls%is_finite) then
        call add_moment(model%x(:, i) + state%u(:, i), ledger%mv(:, i), ledger%angular)
      else
        call add_moment(model%x(:, i), ledger%mv(:, i), ledger%angular)
      end if
      if (ledger%owner(i) > 0) call add_node(ledger, ledger%owner(i), one, state%v, i)
    end do
    do k = 1, size(ledger%share)
      i = ledger%shared(1, k)
      call add_node(ledger, ledger%shared(2, k), ledger%share(k), state%v, i)
    end do
    if (allocated(model%rigid)) call add_rigid_parts(model, state, ledger)
    ledger%momentum = zero
    ledger%momentum(:model%dim) = sum(ledger%part_momentum, dim=2)
    ledger%kinetic = sum(ledger%part_kinetic)
    ledger%internal = sum(ledger%part_internal)
    if (model%bodies > 0) call add_walls(model, state, ledger)
    if (model%is_axisymmetric) then    ! what is radial cancels around the axis
      ledger%momentum(1) = zero
      ledger%angular = zero
    end if
    call balance(ledger)
    call watch_growth(ledger)
  end subroutine evaluate_ledger

  !> moment = moment + x x p, about the z axis alone in the plane.
  pure subroutine add_moment(x, p, moment)
    real(wp), intent(in) :: x(:), p(:)
    real(wp), intent(inout) :: moment(3)
    moment(3) = moment(3) + (x(1)*p(2) - x(2)*p(1))
    if (size(x) == 2) return
    moment(1) = moment(1) + (x(2)*p(3) - x(3)*p(2))
    moment(2) = moment(2) + (x(3)*p(1) - x(1)*p(3))
  end subroutine add_moment

  !> Momentum and kinetic energy of rigid walls, which belong to no part.
  pure subroutine add_walls(model, state, ledger)
    type(model_t), intent(in) :: model
    type(state_t), intent(in) :: state
    type(ledger_t), intent(inout) :: ledger
    integer :: k
    do k = 1, size(model%wall)
      associate (i => model%wall(k)%node)
        if (i == 0) cycle
        ledger%momentum(:model%dim) = ledger%momentum(:model%dim) + ledger%mv(:, i)
        ledger%kinetic = ledger%kinetic + half*dot_product(state%v(:, i), ledger%mv(:, i))
      end associate
    end do
  end subroutine add_walls

  !> part_internal alone, at a state that has not been evaluated.
  subroutine find_strain_energies(model, system, state, ledger)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    type(ledger_t), intent(inout) :: ledger
    if (ledger%evaluated == state%cycle) return
    call find_internal(model, system, state, ledger)
  end subroutine find_strain_energies

  !> Strain energy of each part; of a staggered scheme Um.K Um/2 + share dU.K dU/2 at the middle
  !> of the step just done.
  subroutine find_internal(model, system, state, ledger)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    type(ledger_t), intent(inout) :: ledger
    real(wp) :: middle(model%dim, merge(model%nodes, 0, ledger%staggered%on))
    real(wp) :: rest(size(ledger%part_internal))
    if (.not. ledger%staggered%on) then
      call strain_energies(system, model%mesh%part, state%u, ledger%part_internal)
      return
    end if
    if (allocated(system%solid)) then
      call strain_energies(system, model%mesh%part, state%u, ledger%part_internal)
      if (allocated(ledger%part_before)) ledger%part_internal = half*(ledger%part_internal &
          + ledger%part_before)
      return
    end if
    middle = state%u - half*state%du
    call strain_energies(system, model%mesh%part, middle, ledger%part_internal)
    if (.not. abs(ledger%staggered%share) > zero) return
    call strain_energies(system, model%mesh%part, state%du, rest)
    ledger%part_internal = ledger%part_internal + ledger%staggered%share*rest
  end subroutine find_internal

  !> A share of the momentum and kinetic energy of node i to a part.
  pure subroutine add_node(ledger, part, share, v, i)
    type(ledger_t), intent(inout) :: ledger
    integer, intent(in) :: part, i
    real(wp), intent(in) :: share
    real(wp), intent(in), contiguous :: v(:, :)
    real(wp) :: p(3), energy
    p(1) = share*ledger%mv(1, i)
    p(2) = share*ledger%mv(2, i)
    energy = v(1, i)*p(1) + v(2, i)*p(2)
    ledger%part_momentum(1, part) = ledger%part_momentum(1, part) + p(1)
    ledger%part_momentum(2, part) = ledger%part_momentum(2, part) + p(2)
    if (size(v, 1) == 3) then
      p(3) = share*ledger%mv(3, i)
      energy = energy + v(3, i)*p(3)
      ledger%part_momentum(3, part) = ledger%part_momentum(3, part) + p(3)
    end if
    ledger%part_kinetic(part) = ledger%part_kinetic(part) + half*energy
  end subroutine add_node

  !> Centres and rotors of rigid parts: their energies, and momenta about the origin, of the
  !> centres where they are.
  pure subroutine add_rigid_parts(model, state, ledger)
    type(model_t), intent(in) :: model
    type(state_t), intent(in) :: state
    type(ledger_t), intent(inout) :: ledger
    integer :: p
    associate (rigid => model%rigid)
      do p = 1, size(rigid%part)
        associate (c => rigid%centre(p), r => rigid%rotor(p), part => rigid%part(p))
          call add_node(ledger, part, one, state%v, c)
          call add_moment(model%x(:, c) + state%u(:, c), ledger%mv(:, c), ledger%angular)
          ledger%angular(3) = ledger%angular(3) + rigid%radius(p)*ledger%mv(1, r)
          ledger%part_kinetic(part) = ledger%part_kinetic(part) &
              + half*state%v(1, r)*ledger%mv(1, r)
        end associate
      end do
    end associate
  end subroutine add_rigid_parts

  !> total, residual and ratio from the terms.
  pure subroutine balance(ledger)
    type(ledger_t), intent(inout) :: ledger
    real(wp) :: source, misfit
    ledger%total = ledger%kinetic + ledger%internal
    source = ledger%initial + ledger%external + ledger%motion
    ledger%largest = max(ledger%largest, ledger%kinetic, ledger%internal, abs(ledger%total), &
        abs(ledger%initial), abs(ledger%external), abs(ledger%motion), &
        abs(ledger%contact%friction), abs(ledger%contact%normal), abs(ledger%algorithmic), &
        abs(ledger%damping), abs(ledger%plastic))
    misfit = ledger%total - source + ledger%contact%friction + ledger%contact%normal &
        - ledger%contact%unsolved + ledger%algorithmic + ledger%damping &
        + ledger%plastic
    ledger%residual = zero
    if (ledger%largest > zero) ledger%residual = misfit/ledger%largest
    ledger%worst_residual = max(ledger%worst_residual, abs(ledger%residual))
    ledger%ratio = one
    if (abs(source) > zero) ledger%ratio = ledger%total/source
  end subroutine balance

  !> Growth: total - (initial + external + motion), or how far the energy that the bodies were
  !> not given has risen above its minimum so far, less what closing overlaps has paid back of
  !> earlier losses; the larger of the two, / the largest term.
  pure subroutine watch_growth(ledger)
    type(ledger_t), intent(inout) :: ledger
    real(wp) :: free
    free = ledger%total - ledger%external - ledger%motion
    ledger%growth = zero
    ledger%lowest = min(ledger%lowest, free - ledger%contact%paid_back)
    if (.not. ledger%largest > zero) return
    ledger%growth = max(zero, free - ledger%initial, &
        free - ledger%contact%paid_back - ledger%lowest)/ledger%largest
    ledger%largest_growth = max(ledger%largest_growth, ledger%growth)
  end subroutine watch_growth

  !> The largest of the terms that are known in every step [F L], whatever tables are asked for.
  pure real(wp) function largest_work(ledger)
    type(ledger_t), intent(in) :: ledger
    largest_work = max(abs(ledger%initial), abs(ledger%external), abs(ledger%motion), &
        abs(ledger%contact%friction), abs(ledger%contact%normal))
  end function largest_work

  !> Saves to or restores from the archive.
  subroutine exchange_ledger(archive, ledger)
    type(archive_t), intent(inout) :: archive
    type(ledger_t), intent(inout) :: ledger
    real(wp) :: values(14)
    integer :: counts(2)
    values = [ledger%initial, ledger%external, ledger%motion, ledger%contact%friction, &
        ledger%contact%normal, ledger%contact%unsolved, ledger%contact%paid_back, &
        ledger%algorithmic, ledger%damping, ledger%largest, ledger%lowest, &
        ledger%worst_residual, ledger%largest_growth, ledger%plastic]
    counts = [ledger%growths, ledger%first_growth]
    call archive%exchange('ledger.values', values)
    call archive%exchange('ledger.counts', counts)
    ledger%initial = values(1)
    ledger%external = values(2)
    ledger%motion = values(3)
    ledger%contact%friction = values(4)
    ledger%contact%normal = values(5)
    ledger%contact%unsolved = values(6)
    ledger%contact%paid_back = values(7)
    ledger%algorithmic = values(8)
    ledger%damping = values(9)
    ledger%largest = values(10)
    ledger%lowest = values(11)
    ledger%worst_residual = values(12)
    ledger%largest_growth = values(13)
    ledger%plastic = values(14)
    ledger%growths = counts(1)
    ledger%first_growth = counts(2)
  end subroutine exchange_ledger

end module time_ledger
