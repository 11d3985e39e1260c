! SPDX-License-Identifier: BSD-3-Clause
!> What a restart must hold of contact: lists, interface, rows with their reactions, search,
!> sums of the tables. W and the flexibility of the interface are made anew from them.
module contact_archive
  use base_archive, only: archive_t, archive_restore
  use base_kinds, only: wp
  use cone_types, only: certificate_t
  use contact_condense, only: size_schur_inverse
  use contact_rows, only: rows_t, start_rows
  use contact_types, only: contact_t, pair_t, candidate_t, node_forces_t, pair_sums_t, tally_t
  implicit none
  private
  public :: exchange_contact

contains

  !> Saves to or restores from the archive. After restoring, the interface is that of the
  !> archive, and the effective matrix must be factored for it.
  subroutine exchange_contact(archive, contact)
    type(archive_t), intent(inout) :: archive
    type(contact_t), intent(inout) :: contact
    integer :: counts(5)
    integer :: p
    counts = [contact%candidates, contact%last_candidates, size(contact%interface_node), &
        merge(1, 0, contact%alternates), contact%solves_without_contact]
    call archive%exchange('contact.counts', counts)
    if (archive%mode == archive_restore) call size_lists(contact, counts)
    contact%alternates = counts(4) == 1
    contact%solves_without_contact = counts(5)
    call archive%exchange('contact.interface', contact%interface_node)
    call archive%exchange('contact.slot', contact%slot)
    call exchange_candidates(archive, 'contact.candidates', &
        contact%candidate(:contact%candidates))
    call exchange_candidates(archive, 'contact.last_list', &
        contact%last_list(:contact%last_candidates))
    call exchange_rows(archive, contact%rows)
    if (contact%keeps_before) call exchange_rows(archive, contact%before)
    call exchange_tally(archive, contact%tally)
    do p = 1, size(contact%pair)
      call exchange_pair(archive, contact%pair(p))
    end do
    if (archive%mode == archive_restore) contact%w_is_current = .false.
  end subroutine exchange_contact

  !> Lists of the sizes in the archive.
  subroutine size_lists(contact, counts)
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: counts(:)
    contact%candidates = counts(1)
    contact%last_candidates = counts(2)
    if (size(contact%candidate) < contact%candidates) then
      deallocate (contact%candidate)
      allocate (contact%candidate(2*contact%candidates))
    end if
    if (size(contact%last_list) < contact%last_candidates) then
      deallocate (contact%last_list)
      allocate (contact%last_list(2*contact%last_candidates))
    end if
    if (size(contact%interface_node) == counts(3)) return
    deallocate (contact%interface_node)
    allocate (contact%interface_node(counts(3)))
    call size_schur_inverse(contact)
  end subroutine size_lists

  !> One column a candidate; indices and flags are exact as reals.
  subroutine exchange_candidates(archive, name, list)
    type(archive_t), intent(inout) :: archive
    character(*), intent(in) :: name
    type(candidate_t), intent(inout) :: list(:)
    real(wp) :: table(7, size(list))
    integer :: k
    do k = 1, size(list)
      associate (c => list(k))
        table(:, k) = [real([c%pair, c%node, c%edge, merge(1, 0, c%valid)], wp), c%xi, c%normal]
      end associate
    end do
    call archive%exchange(name, table)
    do k = 1, size(list)
      associate (n => nint(table(1:4, k)), v => table(5:, k))
        list(k) = candidate_t(pair=n(1), node=n(2), edge=n(3), valid=n(4) == 1, xi=v(1), &
            normal=v(2:3))
      end associate
    end do
  end subroutine exchange_candidates

  !> A list of rows with its reactions.
  subroutine exchange_rows(archive, rows)
    type(archive_t), intent(inout) :: archive
    type(rows_t), intent(inout) :: rows
    integer :: n, points
    n = rows%n
    call archive%exchange('rows.n', n)
    if (archive%mode == archive_restore) call start_rows(rows, n)
    rows%n = n
    call archive%exchange('rows.first', rows%first(:n + 1))
    points = rows%first(n + 1) - 1
    call archive%exchange('rows.point', rows%point(:points))
    call archive%exchange('rows.weight', rows%weight(:points))
    call archive%exchange('rows.pair', rows%key(1, :n))
    call archive%exchange('rows.node', rows%key(2, :n))
    call archive%exchange('rows.edge', rows%key(3, :n))
    call archive%exchange('rows.status', rows%status(:n))
    call archive%exchange('rows.is_rigid', rows%is_rigid(:n))
    call archive%exchange('rows.gap', rows%gap(:n))
    call archive%exchange('rows.offset', rows%offset(:n))
    call archive%exchange('rows.mu', rows%mu(:n))
    call archive%exchange('rows.length', rows%length(:n))
    call archive%exchange('rows.normal', rows%normal(:, :n))
    call archive%exchange('rows.r', rows%r(:, :n))
    call archive%exchange('rows.r_previous', rows%r_previous(:, :n))
    call archive%exchange('rows.r_older', rows%r_older(:, :n))
    call archive%exchange('rows.u', rows%u(:, :n))
  end subroutine exchange_rows

  subroutine exchange_tally(archive, tally)
    type(archive_t), intent(inout) :: archive
    type(tally_t), intent(inout) :: tally
    integer :: counts(9)
    counts = [tally%searches, tally%w_builds, tally%interface_changes, tally%solves, &
        tally%sweeps, tally%sweeps_since_row, tally%solves_since_row, tally%wedged, &
        tally%wedged_node]
    call archive%exchange('tally.counts', counts)
    tally%searches = counts(1)
    tally%w_builds = counts(2)
    tally%interface_changes = counts(3)
    tally%solves = counts(4)
    tally%sweeps = counts(5)
    tally%sweeps_since_row = counts(6)
    tally%solves_since_row = counts(7)
    tally%wedged = counts(8)
    tally%wedged_node = counts(9)
    call archive%exchange('tally.penetration', tally%worst_penetration)
    call exchange_certificate(archive, 'tally.worst', tally%worst)
    call exchange_certificate(archive, 'tally.worst_row', tally%worst_since_row)
  end subroutine exchange_tally

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
    real(wp) :: values(3)
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
    values = [pair%safe_distance, pair%moved, pair%remaining_margin]
    call archive%exchange('pair.search', values)
    pair%safe_distance = values(1)
    pair%moved = values(2)
    pair%remaining_margin = values(3)
    call exchange_sums(archive, pair%sums)
    if (allocated(pair%nodal)) call exchange_nodal(archive, pair%nodal)
  end subroutine exchange_pair

  subroutine exchange_sums(archive, sums)
    type(archive_t), intent(inout) :: archive
    type(pair_sums_t), intent(inout) :: sums
    real(wp) :: values(21)
    values = [sums%normal_force, sums%tangential_force, sums%normal_work, sums%friction_work, &
        sums%penetration, sums%smallest_gap, real([sums%n_active, sums%n_stick, sums%n_slip], &
        wp), sums%force, sums%force_before, sums%impulse]
    call archive%exchange('pair.sums', values)
    sums%normal_force = values(1)
    sums%tangential_force = values(2)
    sums%normal_work = values(3)
    sums%friction_work = values(4)
    sums%penetration = values(5)
    sums%smallest_gap = values(6)
    sums%n_active = nint(values(7))
    sums%n_stick = nint(values(8))
    sums%n_slip = nint(values(9))
    sums%force = reshape(values(10:13), [2, 2])
    sums%force_before = reshape(values(14:17), [2, 2])
    sums%impulse = reshape(values(18:21), [2, 2])
  end subroutine exchange_sums

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
