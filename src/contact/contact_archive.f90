! SPDX-License-Identifier: BSD-3-Clause
!> What a restart must hold of contact: lists, block, search, warm start, sums of the tables.
!> W and the block's flexibility are made anew from them.
module contact_archive
  use base_archive, only: archive_t, archive_restore
  use base_kinds, only: wp
  use cone_types, only: certificate_t
  use contact_types, only: contact_t, pair_t, candidate_t, node_forces_t
  implicit none
  private
  public :: exchange_contact

  integer, parameter :: candidate_integers = 6, candidate_reals = 10

contains

  !> Saves to or restores from the archive. After restoring, the contact block is that of the
  !> archive, and the effective matrix must be factored for it.
  subroutine exchange_contact(archive, contact)
    type(archive_t), intent(inout) :: archive
    type(contact_t), intent(inout) :: contact
    integer :: counts(12)
    integer :: p
    counts = [contact%n, contact%n_before, size(contact%block), contact%searches, &
        contact%w_builds, contact%block_changes, contact%solves, contact%sweeps, &
        contact%sweeps_since_row, contact%solves_since_row, contact%wedged, contact%wedged_node]
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
    if (allocated(contact%flexibility)) deallocate (contact%flexibility)
    allocate (contact%flexibility(2*counts(3), 2*counts(3)))
  end subroutine size_lists

  subroutine exchange_candidates(archive, name, list)
    type(archive_t), intent(inout) :: archive
    character(*), intent(in) :: name
    type(candidate_t), intent(inout) :: list(:)
    integer :: integers(candidate_integers, size(list))
    real(wp) :: reals(candidate_reals, size(list))
    logical :: flags(2, size(list))
    integer :: k
    do k = 1, size(list)
      associate (c => list(k))
        integers(:, k) = [c%pair, c%node, c%edge, c%a, c%b, c%status]
        reals(:, k) = [c%xi, c%share, c%normal, c%length, c%gap, c%r, c%u]
        flags(:, k) = [c%valid, c%held]
      end associate
    end do
    call exchange_table(archive, name//'.numbers', integers)
    call archive%exchange(name//'.values', reals)
    call exchange_flags(archive, name//'.flags', flags)
    do k = 1, size(list)
      list(k) = candidate_t(pair=integers(1, k), node=integers(2, k), edge=integers(3, k), &
          a=integers(4, k), b=integers(5, k), status=integers(6, k), xi=reals(1, k), &
          share=reals(2, k), normal=reals(3:4, k), length=reals(5, k), gap=reals(6, k), &
          r=reals(7:8, k), u=reals(9:10, k), valid=flags(1, k), held=flags(2, k))
    end do
  end subroutine exchange_candidates

  subroutine exchange_table(archive, name, table)
    type(archive_t), intent(inout) :: archive
    character(*), intent(in) :: name
    integer, intent(inout) :: table(:, :)
    integer :: list(size(table))
    list = reshape(table, [size(table)])
    call archive%exchange(name, list)
    table = reshape(list, shape(table))
  end subroutine exchange_table

  subroutine exchange_flags(archive, name, table)
    type(archive_t), intent(inout) :: archive
    character(*), intent(in) :: name
    logical, intent(inout) :: table(:, :)
    logical :: list(size(table))
    list = reshape(table, [size(table)])
    call archive%exchange(name, list)
    table = reshape(list, shape(table))
  end subroutine exchange_flags

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
    real(wp) :: values(9)
    integer :: counts(3)
    logical :: searched
    searched = allocated(pair%contactor_reference)
    call archive%exchange('pair.searched', searched)
    if (searched .and. .not. allocated(pair%contactor_reference)) &
        allocate (pair%contactor_reference(2, size(pair%contactor%node)), &
        pair%obstacle_reference(2, size(pair%obstacle%node)))
    if (searched) call archive%exchange('pair.contactor', pair%contactor_reference)
    if (searched) call archive%exchange('pair.obstacle', pair%obstacle_reference)
    values = [pair%safe_distance, pair%moved, pair%room, pair%normal_force, &
        pair%tangential_force, pair%normal_work, pair%friction_work, pair%penetration, &
        pair%smallest_gap]
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
    counts = [pair%n_active, pair%n_stick, pair%n_slip]
    call archive%exchange('pair.counts', counts)
    pair%n_active = counts(1)
    pair%n_stick = counts(2)
    pair%n_slip = counts(3)
    call archive%exchange('pair.force', pair%force)
    call archive%exchange('pair.force_before', pair%force_before)
    call archive%exchange('pair.impulse', pair%impulse)
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
