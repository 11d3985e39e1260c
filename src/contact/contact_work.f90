! SPDX-License-Identifier: BSD-3-Clause
!> What contact did in a step: forces on the sides, impulses, works.
module contact_work
  use base_checks, only: checks_on, assert_shape
  use base_kinds, only: wp, zero, one
  use cone_certificate, only: bipotential_residual
  use cone_types, only: certificate_t, contact_open, contact_stick, most_components
  use contact_kinematics, only: relative_displacement, row_force, add_row_force, &
      tangential_length, tangential_product
  use contact_ramp, only: ramp_push
  use contact_rows, only: rows_t, row_mortar
  use contact_pairing, only: node_forces_t, pair_sums_t, no_gap
  use contact_surface, only: surface_t
  use contact_types, only: contact_t
  implicit none
  private

  !> Work terms of one step [F L]; positive = lost by the bodies.
  type, public :: contact_work_t
    real(wp) :: friction = zero
    real(wp) :: normal = zero
    real(wp) :: unsolved = zero       !< gained through the error of the contact solve
    real(wp) :: given = zero          !< by floors that rise (contact_ramp)
    real(wp) :: paid_back = zero      !< of the normal work by closing overlaps
  end type contact_work_t

  public :: add_contact_step, add_stage_work, add_stage_reactions, find_nodal, &
      subtract_contact_force, start_row

contains

  !> Forces, impulses and works of the step just done. The bodies receive the mean reaction
  !> weight_before r0 + weight_now r1 over a step of length h and of motion du (dim, nodes);
  !> du_before: the motion on which r0 does work, where it is another one.
  subroutine add_contact_step(contact, weight_before, weight_now, h, du, work, du_before)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in) :: weight_before, weight_now, h
    real(wp), intent(in), contiguous :: du(:, :)
    type(contact_work_t), intent(inout) :: work
    real(wp), intent(in), optional, contiguous :: du_before(:, :)
    integer :: a, p
    if (checks_on) call assert_shape(shape(du), [contact%dim, size(contact%slot)], &
        'add_contact_step', 'du')
    contact%idle_steps = min(2, contact%idle_steps + 1)
    do p = 1, size(contact%pairing)
      associate (pairing => contact%pairing(p)%item)
        call clear_sums(pairing%sums)
        if (allocated(pairing%nodal)) call clear_nodal(pairing%nodal)
      end associate
    end do
    do a = 1, contact%rows%n
      associate (pairing => contact%pairing(contact%rows%key(1, a))%item)
        call add_force(contact%rows, a, pairing%sums)
        if (allocated(pairing%nodal)) call add_nodal(contact%rows, a, pairing%side, &
            pairing%nodal)
      end associate
      if (contact%splits_work) then
        call add_implicit_work(contact, a, work)
      else
        call add_weighted_work(contact, contact%rows, a, weight_now, du, work)
      end if
    end do
    if (weight_before > zero) then
      do a = 1, contact%before%n
        if (present(du_before)) then
          call add_weighted_work(contact, contact%before, a, weight_before, du_before, work)
        else
          call add_weighted_work(contact, contact%before, a, weight_before, du, work)
        end if
      end do
    end if
    do p = 1, size(contact%pairing)
      associate (sums => contact%pairing(p)%item%sums)
        sums%impulse = sums%impulse &
            + h*(weight_before*sums%force_before + weight_now*sums%force)
      end associate
    end do
  end subroutine add_contact_step

  !> Work of the forces of an earlier stage of the step, those of the rows `before`, on a
  !> motion (dim, nodes) of their own.
  subroutine add_stage_work(contact, motion, work)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: motion(:, :)
    type(contact_work_t), intent(inout) :: work
    integer :: a
    do a = 1, contact%before%n
      call add_weighted_work(contact, contact%before, a, one, motion, work)
    end do
  end subroutine add_stage_work

  !> The reactions of the step are those of both stages, whose rows are the same.
  pure subroutine add_stage_reactions(contact)
    type(contact_t), intent(inout) :: contact
    integer :: a
    associate (rows => contact%rows, before => contact%before)
      do a = 1, rows%n
        if (.not. before%r(1, a) > zero) cycle
        rows%r(:, a) = rows%r(:, a) + before%r(:, a)
        if (rows%status(a) == contact_open) rows%status(a) = before%status(a)
      end do
    end associate
  end subroutine add_stage_reactions

  pure subroutine clear_sums(sums)
    type(pair_sums_t), intent(inout) :: sums
    sums%force_before = sums%force
    sums%force = zero
    sums%normal_force = zero
    sums%tangential_force = zero
    sums%n_active = 0
    sums%n_stick = 0
    sums%n_slip = 0
  end subroutine clear_sums

  pure subroutine clear_nodal(nodal)
    type(node_forces_t), intent(inout) :: nodal
    nodal%before = nodal%force
    nodal%force = zero
    nodal%normal = zero
    nodal%slip = zero
    nodal%status = contact_open
  end subroutine clear_nodal

  !> Forces on the nodes of pairing p by the rows of the step just done.
  subroutine find_nodal(contact, p)
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: p
    integer :: a
    associate (pairing => contact%pairing(p)%item)
      call clear_nodal(pairing%nodal)
      do a = 1, contact%rows%n
        if (contact%rows%key(1, a) == p) &
            call add_nodal(contact%rows, a, pairing%side, pairing%nodal)
      end do
    end associate
  end subroutine find_nodal

  !> Force and slip of a row to its nodes, in shares of their weights.
  pure subroutine add_nodal(rows, a, side, nodal)
    type(rows_t), intent(in) :: rows
    integer, intent(in) :: a
    type(surface_t), intent(in) :: side(2)
    type(node_forces_t), intent(inout) :: nodal
    real(wp) :: force(most_components), weight, slip
    integer :: k, at, s
    force = row_force(rows, a)
    slip = rows%u(2, a)
    if (rows%dim == 3) slip = tangential_length(3, rows%u(:, a))
    do k = rows%first(a), rows%first(a + 1) - 1
      s = rows%key(2, a)
      if (k > rows%first(a) .and. size(side(2)%node) > 0) s = 3 - s
      if (side(s)%index(rows%point(k)) == 0) s = 3 - s   ! a second node of the contactor
      at = nodal%first(s) + side(s)%index(rows%point(k))
      if (.not. abs(rows%weight(k)) > zero) cycle
      nodal%force(:, at) = nodal%force(:, at) + rows%weight(k)*force(:rows%dim)
      weight = abs(rows%weight(k))
      if (rows%kind(a) == row_mortar) weight = &
          merge(rows%weight(k), -rows%weight(k), s == rows%key(2, a))
      nodal%normal(at) = nodal%normal(at) + weight*rows%r(1, a)
      if (abs(slip) > abs(nodal%slip(at))) nodal%slip(at) = slip
      nodal%status(at) = max(nodal%status(at), rows%status(a))
    end do
  end subroutine add_nodal

  !> Force of a row to the sums of its pairing.
  pure subroutine add_force(rows, a, sums)
    type(rows_t), intent(in) :: rows
    integer, intent(in) :: a
    type(pair_sums_t), intent(inout) :: sums
    real(wp) :: force(most_components)
    if (rows%status(a) == contact_open) return
    force = row_force(rows, a)
    associate (side => rows%key(2, a))
      sums%force(:, side) = sums%force(:, side) + force
      sums%force(:, 3 - side) = sums%force(:, 3 - side) - force
    end associate
    sums%normal_force = sums%normal_force + rows%r(1, a)
    sums%tangential_force = sums%tangential_force + tangential_length(rows%dim, rows%r(:, a))
    sums%n_active = sums%n_active + 1
    if (rows%status(a) == contact_stick) then
      sums%n_stick = sums%n_stick + 1
    else
      sums%n_slip = sums%n_slip + 1
    end if
  end subroutine add_force

  !> Reaction at the end of the step only: r.(H x) = - mu r_n |u_t| - r_n c + e with the
  !> bi-potential residual e; each term by its own formula.
  subroutine add_implicit_work(contact, a, work)
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: a
    type(contact_work_t), intent(inout) :: work
    real(wp) :: friction, normal
    if (contact%rows%status(a) == contact_open) return
    associate (rows => contact%rows, d => contact%d)
      friction = rows%mu(a)*rows%r(1, a)*tangential_length(rows%dim, rows%u(:, a))
      normal = rows%r(1, a)*rows%offset(a)
      associate (pairing => contact%pairing(rows%key(1, a))%item)
        pairing%sums%friction_work = pairing%sums%friction_work + friction
        pairing%sums%normal_work = pairing%sums%normal_work + normal
        pairing%purse%balance = pairing%purse%balance + normal
        pairing%purse%spent = pairing%purse%spent + max(zero, -normal)
      end associate
      work%friction = work%friction + friction
      work%normal = work%normal + normal
      work%unsolved = work%unsolved &
          + bipotential_residual(rows%mu(a), rows%r(1:d, a), rows%u(1:d, a))
      work%paid_back = work%paid_back + max(zero, -normal)
    end associate
  end subroutine add_implicit_work

  !> Any mean of reactions: their work as it is, of either sign.
  subroutine add_weighted_work(contact, rows, a, weight, du, work)
    type(contact_t), intent(inout) :: contact
    type(rows_t), intent(in) :: rows
    integer, intent(in) :: a
    real(wp), intent(in) :: weight
    real(wp), intent(in), contiguous :: du(:, :)
    type(contact_work_t), intent(inout) :: work
    real(wp) :: u(most_components), slip_work
    if (rows%status(a) == contact_open) return
    u = relative_displacement(rows, a, rows%point, du)
    slip_work = weight*tangential_product(rows%dim, rows%r(:, a), u)
    associate (pairing => contact%pairing(rows%key(1, a))%item)
      if (allocated(pairing%ramp)) then
        u(1) = u(1) - ramp_push(pairing%ramp, rows%key(3, a))
        work%given = work%given + weight*rows%r(1, a)*ramp_push(pairing%ramp, rows%key(3, a))
      end if
    end associate
    associate (sums => contact%pairing(rows%key(1, a))%item%sums)
      sums%friction_work = sums%friction_work - slip_work
      sums%normal_work = sums%normal_work - weight*rows%r(1, a)*u(1)
    end associate
    work%friction = work%friction - slip_work
    work%normal = work%normal - weight*rows%r(1, a)*u(1)
  end subroutine add_weighted_work

  !> Counts since the last row of the table SLEOUT begin anew.
  pure subroutine start_row(contact)
    type(contact_t), intent(inout) :: contact
    integer :: p
    contact%tally%solves_since_row = 0
    contact%tally%sweeps_since_row = 0
    contact%tally%worst_since_row = certificate_t()
    do p = 1, size(contact%pairing)
      contact%pairing(p)%item%sums%penetration = zero
    end do
  end subroutine start_row

  !> f = f - factor H' r of all rows, f (dim, nodes).
  pure subroutine subtract_contact_force(contact, factor, f)
    type(contact_t), intent(in) :: contact
    real(wp), intent(in) :: factor
    real(wp), intent(inout) :: f(:, :)
    integer :: a
    do a = 1, contact%rows%n
      if (contact%rows%r(1, a) > zero) &
          call add_row_force(contact%rows, a, -factor, contact%rows%point, f)
    end do
  end subroutine subtract_contact_force

end module contact_work
