! SPDX-License-Identifier: BSD-3-Clause
!> What a restart must hold of contact: lists, block, search, warm start, sums of the tables.
!> W and the block's flexibility are made anew from them.
module contact_archive
  use base_archive, only: archive_t, archive_restore
  use base_kinds, only: wp
  use cone_types, only: certificate_t
  use contact_condense, only: size_flexibility
  use contact_types, only: contact_t, pair_t, candidate_t, node_forces_t
  implicit none
  private
  public :: exchange_contact

contains

  !> Saves to or restores from the archive. After restoring, the contact block is that of the
  !> archive, and the effective matrix must be factored for it.
  subroutine exchange_contact(archive, contact)
    type(archive_t), intent(inout) :: archive
    type(contact_t), intent(inout) :: contact
    integer :: counts(14)
    integer :: p
    counts = [contact%n, contact%n_before, size(contact%block), contact%searches, &
        contact%w_builds, contact%block_changes, contact%solves, contact%sweeps, &
        contact%sweeps_since_row, contact%solves_since_row, contact%wedged, &
        contact%wedged_node, merge(1, 0, contact%alternates), contact%quiet]
    call archive%exchange('contact.counts', counts)
    if (archive%mode == archive_restore) call size_lists(contact, counts)
    contact%searches = counts(4)
    contact%w_builds = counts(5)
    contact%block_changes = counts(6)
    contact%solves = counts(7)
    contact%sweeps = counts(8)
    contact%sweeps_since_row = counts(9)
    contact%solves_since_row = counts(10)
    contact%wedged = counts(11)
    contact%wedged_node = counts(12)
    contact%alternates = counts(13) == 1
    contact%quiet = counts(14)
    call archive%exchange('contact.block', contact%block)
    call archive%exchange('contact.block_row', contact%block_row)
    call exchange_candidates(archive, 'contact.candidates', contact%candidate(:contact%n))
    call exchange_candidates(archive, 'contact.before', contact%before(:contact%n_before))
    call archive%exchange('contact.penetration', contact%worst_penetration)
    call exchange_certificate(archive, 'contact.worst', contact%worst)
    call exchange_certificate(archive, 'contact.worst_row', contact%worst_since_row)
    do p = 1, size(contact%pair)
      call exchange_pair(archive, contact%pair(p))
    end do
    if (archive%mode == archive_restore) contact%w_is_current = .false.
  end subroutine exchange_contact

  !> Lists of the sizes in the archive.
  subroutine size_lists(contact, counts)
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: counts(:)
    contact%n = counts(1)
    contact%n_before = counts(2)
    if (size(contact%candidate) < contact%n) then
      deallocate (contact%candidate)
      allocate (contact%candidate(2*contact%n))
    end if
    if (size(contact%before) < contact%n_before) then
      deallocate (contact%before)
      allocate (contact%before(2*contact%n_before))
    end if
    if (size(contact%block) == counts(3)) return
    deallocate (contact%block)
    allocate (contact%block(counts(3)))
    call size_flexibility(contact)
  end subroutine size_lists

  !> One column a candidate; indices and flags are exact as reals.
  subroutine exchange_candidates(archive, name, list)
    type(archive_t), intent(inout) :: archive
    character(*), intent(in) :: name
    type(candidate_t), intent(inout) :: list(:)
    real(wp) :: table(22, size(list))
    integer :: k
    do k = 1, size(list)
      associate (c => list(k))
        table(1:8, k) = real([c%pair, c%node, c%edge, c%a, c%b, c%status, merge(1, 0, &
            c%valid), merge(1, 0, c%held)], wp)
        table(9:, k) = [c%xi, c%share, c%normal, c%length, c%gap, c%r, c%u, &
            c%last, c%older]
      end associate
    end do
    call archive%exchange(name, table)
    do k = 1, size(list)
      associate (n => nint(table(1:8, k)), v => table(9:, k))
        list(k) = candidate_t(pair=n(1), node=n(2), edge=n(3), a=n(4), b=n(5), status=n(6), &
            valid=n(7) == 1, held=n(8) == 1, xi=v(1), share=v(2), normal=v(3:4), length=v(5), &
            gap=v(6), r=v(7:8), u=v(9:10), last=v(11:12), older=v(13:14))
      end associate
    end do
  end subroutine exchange_candidates

  subroutine exchange_certificate(archive, name, certificate)
    type(archive_t), intent(inout) :: archive
    character(*), intent(in) :: name
    type(certificate_t), intent(inout) :: certificate
    real(wp) :: values(4)
    values = [certificate%error, certificate%error2018, certificate%eta, &
        merge(1.0_wp, 0.0_wp, certificate%met)]
    call archive%exchange(name, values)
    certificate%error = values(1)
    certificate%error2018 = values(2)
    certificate%eta = values(3)
    certificate%met = values(4) > 0.5_wp
  end subroutine exchange_certificate

  subroutine exchange_pair(archive, pair)
    type(archive_t), intent(inout) :: archive
    type(pair_t), intent(inout) :: pair
    real(wp) :: values(24)
    logical :: searched
    searched = allocated(pair%contactor_reference)
    call archive%exchange('pair.searched', searched)
    if (searched .and. .not. allocated(pair%contactor_reference)) &
        allocate (pair%contactor_reference(2, size(pair%contactor%node)), &
        pair%obstacle_reference(2, size(pair%obstacle%node)))
    if (.not. searched .and. allocated(pair%contactor_reference)) &
        deallocate (pair%contactor_reference, pair%obstacle_reference)
    if (searched) call archive%exchange('pair.contactor', pair%contactor_reference)
    if (searched) call archive%exchange('pair.obstacle', pair%obstacle_reference)
    values = [pair%safe_distance, pair%moved, pair%room, pair%normal_force, &
        pair%tangential_force, pair%normal_work, pair%friction_work, pair%penetration, &
        pair%smallest_gap, real([pair%n_active, pair%n_stick, pair%n_slip], wp), pair%force, &
        pair%force_before, pair%impulse]
    call archive%exchange('pair.values', values)
    pair%safe_distance = values(1)
    pair%moved = values(2)
    pair%room = values(3)
    pair%normal_force = values(4)
    pair%tangential_force = values(5)
    pair%normal_work = values(6)
    pair%friction_work = values(7)
    pair%penetration = values(8)
    pair%smallest_gap = values(9)
    pair%n_active = nint(values(10))
    pair%n_stick = nint(values(11))
    pair%n_slip = nint(values(12))
    pair%force = reshape(values(13:16), [2, 2])
    pair%force_before = reshape(values(17:20), [2, 2])
    pair%impulse = reshape(values(21:24), [2, 2])
    if (allocated(pair%nodal)) call exchange_nodal(archive, pair%nodal)
  end subroutine exchange_pair

  subroutine exchange_nodal(archive, nodal)
    type(archive_t), intent(inout) :: archive
    type(node_forces_t), intent(inout) :: nodal
    call archive%exchange('nodal.force', nodal%force)
    call archive%exchange('nodal.before', nodal%before)
    call archive%exchange('nodal.normal', nodal%normal)
    call archive%exchange('nodal.gap', nodal%gap)
    call archive%exchange('nodal.slip', nodal%slip)
    call archive%exchange('nodal.status', nodal%status)
  end subroutine exchange_nodal

end module contact_archive
