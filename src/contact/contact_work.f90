! SPDX-License-Identifier: BSD-3-Clause
!> What contact did in a step: forces on the sides, impulses, works.
module contact_work
  use base_kinds, only: wp, zero
  use cone_certificate, only: bipotential_residual
  use cone_types, only: contact_open, contact_stick
  use contact_condense, only: relative_motion
  use contact_surface, only: edge_tangent
  use contact_types, only: contact_t, candidate_t, node_forces_t, no_gap
  implicit none
  private

  !> Work terms of one step [F L]; positive = lost by the bodies.
  type, public :: contact_work_t
    real(wp) :: friction = zero
    real(wp) :: normal = zero
    real(wp) :: unsolved = zero       !< gained through the error of the contact solve
    real(wp) :: allowed_growth = zero !< what the scheme's own bound lets the energy gain
  end type contact_work_t

  public :: add_contact_step

contains

  !> Forces, impulses and works of the step just done. The bodies receive the mean reaction
  !> weight_before r0 + weight_now r1 over a step of length h; x (2, m) is the motion of the
  !> block.
  subroutine add_contact_step(contact, weight_before, weight_now, h, du, work)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in) :: weight_before, weight_now, h
    real(wp), intent(in) :: du(:, :)
    type(contact_work_t), intent(inout) :: work
    integer :: i, p
    do p = 1, size(contact%pair)
      associate (pair => contact%pair(p))
        pair%force_before = pair%force
        pair%force = zero
        pair%normal_force = zero
        pair%tangential_force = zero
        pair%n_active = 0
        pair%n_stick = 0
        pair%n_slip = 0
        pair%smallest_gap = no_gap
      end associate
    end do
    do p = 1, size(contact%pair)
      if (allocated(contact%pair(p)%nodal)) call clear_nodal(contact%pair(p)%nodal)
    end do
    do i = 1, contact%n
      call add_force(contact, contact%candidate(i))
      if (allocated(contact%pair(contact%candidate(i)%pair)%nodal)) &
          call add_nodal(contact%candidate(i), contact%pair(contact%candidate(i)%pair)%nodal)
      if (weight_before > zero) then
        call add_weighted_work(contact, contact%candidate(i), weight_now, du, work)
      else
        call add_implicit_work(contact, contact%candidate(i), work)
      end if
    end do
    if (weight_before > zero) then
      do i = 1, contact%n_before
        call add_weighted_work(contact, contact%before(i), weight_before, du, work)
      end do
    end if
    do p = 1, size(contact%pair)
      associate (pair => contact%pair(p))
        pair%impulse = pair%impulse &
            + h*(weight_before*pair%force_before + weight_now*pair%force)
      end associate
    end do
  end subroutine add_contact_step

  pure subroutine clear_nodal(nodal)
    type(node_forces_t), intent(inout) :: nodal
    nodal%before = nodal%force
    nodal%force = zero
    nodal%normal = zero
    nodal%gap = no_gap
    nodal%slip = zero
    nodal%status = contact_open
  end subroutine clear_nodal

  !> Force, gap and slip of a candidate to its node and, in shares, to the nodes of its edge.
  pure subroutine add_nodal(c, nodal)
    type(candidate_t), intent(in) :: c
    type(node_forces_t), intent(inout) :: nodal
    real(wp) :: share(3), force(2)
    integer :: k, at, node(3)
    if (.not. c%valid) return
    node = [c%node, c%a, c%b]
    share = [1.0_wp, c%share*(1.0_wp - c%xi), c%share*c%xi]
    force = c%normal*c%r(1) + edge_tangent(c%normal)*c%r(2)
    do k = 1, 3
      at = nodal%place(node(k), merge(1, 2, k == 1))
      if (at == 0 .or. .not. share(k) > zero) cycle
      nodal%force(:, at) = nodal%force(:, at) + merge(1.0_wp, -1.0_wp, k == 1)*share(k)*force
      nodal%normal(at) = nodal%normal(at) + share(k)*c%r(1)
      nodal%gap(at) = min(nodal%gap(at), c%u(1))
      if (abs(c%u(2)) > abs(nodal%slip(at))) nodal%slip(at) = c%u(2)
      nodal%status(at) = max(nodal%status(at), c%status)
    end do
  end subroutine add_nodal

  subroutine add_force(contact, c)
    type(contact_t), intent(inout) :: contact
    type(candidate_t), intent(in) :: c
    real(wp) :: force(2)
    associate (pair => contact%pair(c%pair))
      if (c%valid) pair%smallest_gap = min(pair%smallest_gap, c%u(1))
      if (c%status == contact_open) return
      force = c%normal*c%r(1) + edge_tangent(c%normal)*c%r(2)
      pair%force(:, pair%contactor_side) = pair%force(:, pair%contactor_side) + force
      pair%force(:, 3 - pair%contactor_side) = pair%force(:, 3 - pair%contactor_side) - force
      pair%normal_force = pair%normal_force + c%r(1)
      pair%tangential_force = pair%tangential_force + abs(c%r(2))
      pair%n_active = pair%n_active + 1
      if (c%status == contact_stick) then
        pair%n_stick = pair%n_stick + 1
      else
        pair%n_slip = pair%n_slip + 1
      end if
    end associate
  end subroutine add_force

  !> Reaction at the end of the step only: r.(H x) = - mu r_n |u_t| - r_n g0 + e with the
  !> bi-potential residual e; each term by its own formula.
  subroutine add_implicit_work(contact, c, work)
    type(contact_t), intent(inout) :: contact
    type(candidate_t), intent(in) :: c
    type(contact_work_t), intent(inout) :: work
    real(wp) :: friction, normal
    if (c%status == contact_open) return
    associate (pair => contact%pair(c%pair))
      friction = pair%mu*c%r(1)*abs(c%u(2))
      normal = c%r(1)*c%gap
      pair%friction_work = pair%friction_work + friction
      pair%normal_work = pair%normal_work + normal
      work%friction = work%friction + friction
      work%normal = work%normal + normal
      work%unsolved = work%unsolved &
          + bipotential_residual(pair%mu, c%r(1:contact%d), c%u(1:contact%d))
      work%allowed_growth = work%allowed_growth + max(zero, -normal)
    end associate
  end subroutine add_implicit_work

  !> Any mean of reactions: their work as it is, of either sign.
  subroutine add_weighted_work(contact, c, weight, du, work)
    type(contact_t), intent(inout) :: contact
    type(candidate_t), intent(in) :: c
    real(wp), intent(in) :: weight
    real(wp), intent(in) :: du(:, :)
    type(contact_work_t), intent(inout) :: work
    real(wp) :: motion(2)
    if (c%status == contact_open) return
    motion = relative_motion(c, du(:, c%node), du(:, c%a), du(:, c%b))
    associate (pair => contact%pair(c%pair))
      pair%friction_work = pair%friction_work - weight*c%r(2)*motion(2)
      pair%normal_work = pair%normal_work - weight*c%r(1)*motion(1)
    end associate
    work%friction = work%friction - weight*c%r(2)*motion(2)
    work%normal = work%normal - weight*c%r(1)*motion(1)
  end subroutine add_weighted_work

end module contact_work
