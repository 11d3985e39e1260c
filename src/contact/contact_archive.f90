! SPDX-License-Identifier: BSD-3-Clause
!> What a restart must hold of contact: lists, interface, rows with their reactions, search,
!> sums of the tables. W and the flexibility of the interface are made anew from them.
module contact_archive
  use base_archive, only: archive_t, archive_restore
  use base_kinds, only: wp, zero
  use cone_types, only: certificate_t
  use contact_condense, only: size_interface_vectors
  use contact_pairing, only: pairing_t, node_forces_t, pair_sums_t
  use contact_rows, only: rows_t, start_rows, size_points, set_tangents, row_kinds
  use contact_types, only: contact_t, tally_t
  use contact_work, only: find_nodal
  implicit none
  private
  public :: exchange_contact

contains

  !> Saves to or restores from the archive. After restoring, the interface is that of the
  !> archive, and the effective matrix must be factored for it. begins: forces on nodes are
  !> wanted that the archive does not have; they are those of the rows, without gaps and the
  !> step before.
  subroutine exchange_contact(archive, contact, begins)
    type(archive_t), intent(inout) :: archive
    type(contact_t), intent(inout) :: contact
    logical, intent(out) :: begins
    logical :: is_kept
    integer :: counts(6)
    integer :: p
    counts = [size(contact%interface_node), merge(1, 0, contact%alternates), &
        contact%solves_without_contact, contact%listed, contact%idle_steps, &
        size(contact%carried, 2)]
    call archive%exchange('contact.counts', counts)
    contact%alternates = counts(2) == 1
    contact%solves_without_contact = counts(3)
    contact%listed = counts(4)
    contact%idle_steps = counts(5)
    if (archive%mode == archive_restore) call size_interface(contact, counts(1), counts(6))
    call archive%exchange('contact.interface', contact%interface_node)
    call archive%exchange('contact.slot', contact%slot)
    call archive%exchange('contact.carried', contact%carried(1, :))
    call archive%exchange('contact.carrier', contact%carried(2, :))
    call archive%exchange('contact.acts', contact%acts)
    call exchange_rows(archive, contact%rows)
    if (contact%keeps_before) call exchange_rows(archive, contact%before)
    call exchange_tally(archive, contact%tally)
    call exchange_far(archive, contact)
    begins = .false.
    do p = 1, size(contact%pairing)
      associate (pairing => contact%pairing(p)%item)
        call exchange_pairing(archive, contact%dim, pairing)
        call archive%agree('nodal.', allocated(pairing%nodal), is_kept)
        if (is_kept) then
          call exchange_nodal(archive, pairing%nodal)
        else if (allocated(pairing%nodal)) then
          begins = .true.
          call find_nodal(contact, p)
        end if
      end associate
    end do
    if (archive%mode /= archive_restore) return
    contact%w_is_current = .false.
    contact%rows_are_plain = .false.
  end subroutine exchange_contact

  !> What the near part of W has left out in the last two solves, from which the next begin.
  subroutine exchange_far(archive, contact)
    type(archive_t), intent(inout) :: archive
    type(contact_t), intent(inout) :: contact
    logical :: is_kept
    call archive%agree('far.', allocated(contact%local) .or. archive%mode == archive_restore, &
        is_kept)
    if (.not. is_kept) return
    if (archive%mode == archive_restore) then
      if (.not. allocated(contact%local)) allocate (contact%local)
      associate (local => contact%local, m => size(contact%interface_node))
        if (allocated(local%far)) deallocate (local%far, local%far_older)
        allocate (local%far(contact%dim, m), local%far_older(contact%dim, m))
      end associate
    end if
    call archive%exchange('far.last', contact%local%far)
    call archive%exchange('far.older', contact%local%far_older)
  end subroutine exchange_far

  !> Storage for an interface of n nodes, those that are carried, and the lists that go with
  !> it.
  subroutine size_interface(contact, n, carried)
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: n, carried
    deallocate (contact%carried)
    allocate (contact%carried(2, carried))
    if (allocated(contact%late)) deallocate (contact%late)
    allocate (contact%late(4*contact%listed + 8))
    if (size(contact%interface_node) == n) return
    deallocate (contact%interface_node)
    allocate (contact%interface_node(n))
    call size_interface_vectors(contact)
  end subroutine size_interface

  !> A list of rows with its reactions.
  subroutine exchange_rows(archive, rows)
    type(archive_t), intent(inout) :: archive
    type(rows_t), intent(inout) :: rows
    integer :: n, points
    n = rows%n
    call archive%exchange('rows.n', n)
    if (archive%mode == archive_restore) call start_rows(rows, n)
    rows%n = n
    if (archive%mode == archive_restore) rows%is_active(:n) = .true.
    call archive%exchange('rows.first', rows%first(:n + 1))
    points = rows%first(n + 1) - 1
    if (archive%mode == archive_restore) call size_points(rows, points)
    rows%most_points = max(rows%most_points, maxval(rows%first(2:n + 1) - rows%first(:n)))
    call archive%exchange('rows.point', rows%point(:points))
    call archive%exchange('rows.weight', rows%weight(:points))
    call archive%exchange('rows.pairing', rows%key(1, :n))
    call archive%exchange('rows.side', rows%key(2, :n))
    call archive%exchange('rows.node', rows%key(3, :n))
    call archive%exchange('rows.edge', rows%key(4, :n))
    call archive%exchange('rows.kind', rows%kind(:n))
    call archive%exchange('rows.status', rows%status(:n))
    call archive%exchange('rows.is_rigid', rows%is_rigid(:n))
    call archive%exchange('rows.gap', rows%gap(:n))
    call archive%exchange('rows.offset', rows%offset(:n))
    call archive%exchange('rows.allowance', rows%allowance(:n))
    call archive%exchange('rows.mu', rows%mu(:n))
    call archive%exchange('rows.length', rows%length(:n))
    call archive%exchange('rows.normal', rows%normal(:, :n))
    call archive%exchange('rows.r', rows%r(:, :n))
    call archive%exchange('rows.r_previous', rows%r_previous(:, :n))
    call archive%exchange('rows.r_older', rows%r_older(:, :n))
    call archive%exchange('rows.u', rows%u(:, :n))
    if (archive%mode == archive_restore) call set_tangents(rows)
  end subroutine exchange_rows

  subroutine exchange_tally(archive, tally)
    type(archive_t), intent(inout) :: archive
    type(tally_t), intent(inout) :: tally
    integer :: counts(18 + row_kinds)
    real(wp) :: overlap(2)
    counts = [tally%searches, tally%w_builds, tally%interface_changes, tally%solves, &
        tally%sweeps, tally%sweeps_since_row, tally%solves_since_row, tally%wedged, &
        tally%wedged_node, tally%allowances, tally%late_rows, tally%new_frames, tally%repeats, &
        tally%redone, tally%overlap_node, tally%overlap_step, tally%overlaps, &
        tally%misses, tally%rows]
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
    tally%allowances = counts(10)
    tally%late_rows = counts(11)
    tally%new_frames = counts(12)
    tally%repeats = counts(13)
    tally%redone = counts(14)
    tally%overlap_node = counts(15)
    tally%overlap_step = counts(16)
    tally%overlaps = counts(17)
    tally%misses = counts(18)
    tally%rows = counts(19:)
    overlap = [tally%overlap, tally%overlap_share]
    call archive%exchange('tally.overlap', overlap)
    tally%overlap = overlap(1)
    tally%overlap_share = overlap(2)
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

  subroutine exchange_pairing(archive, dim, pairing)
    type(archive_t), intent(inout) :: archive
    integer, intent(in) :: dim
    class(pairing_t), intent(inout) :: pairing
    real(wp) :: values(8)
    integer :: counts(2)
    counts = [merge(1, 0, pairing%is_born), pairing%purse%short_steps]
    call archive%exchange('pairing.counts', counts)
    pairing%is_born = counts(1) == 1
    pairing%purse%short_steps = counts(2)
    values = [pairing%safe_distance, pairing%moved, pairing%remaining_margin, &
        pairing%accepted_overlap, pairing%purse%balance, pairing%purse%spent, &
        pairing%purse%wanted, pairing%purse%beta]
    call archive%exchange('pairing.values', values)
    pairing%safe_distance = values(1)
    pairing%moved = values(2)
    pairing%remaining_margin = values(3)
    pairing%accepted_overlap = values(4)
    pairing%purse%balance = values(5)
    pairing%purse%spent = values(6)
    pairing%purse%wanted = values(7)
    pairing%purse%beta = values(8)
    if (pairing%is_born) then
      if (.not. allocated(pairing%reference_1)) allocate (pairing%reference_1(dim, &
          size(pairing%side(1)%node)), pairing%reference_2(dim, size(pairing%side(2)%node)))
      call archive%exchange('pairing.reference_1', pairing%reference_1)
      call archive%exchange('pairing.reference_2', pairing%reference_2)
    end if
    if (allocated(pairing%ramp)) call archive%exchange('pairing.ramp', pairing%ramp%start)
    if (allocated(pairing%ramp)) pairing%ramp%is_known = any(pairing%ramp%start < zero)
    call pairing%exchange(archive)
    call exchange_sums(archive, dim, pairing%sums)
  end subroutine exchange_pairing

  subroutine exchange_sums(archive, dim, sums)
    type(archive_t), intent(inout) :: archive
    integer, intent(in) :: dim
    type(pair_sums_t), intent(inout) :: sums
    real(wp) :: values(9 + 6*dim)
    integer :: k
    values = [sums%normal_force, sums%tangential_force, sums%normal_work, sums%friction_work, &
        sums%penetration, sums%smallest_gap, real([sums%n_active, sums%n_stick, sums%n_slip], &
        wp), sums%force(:dim, :), sums%force_before(:dim, :), sums%impulse(:dim, :)]
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
    k = 2*dim
    sums%force(:dim, :) = reshape(values(10:9 + k), [dim, 2])
    sums%force_before(:dim, :) = reshape(values(10 + k:9 + 2*k), [dim, 2])
    sums%impulse(:dim, :) = reshape(values(10 + 2*k:), [dim, 2])
  end subroutine exchange_sums

  subroutine exchange_nodal(archive, nodal)
    type(archive_t), intent(inout) :: archive
    type(node_forces_t), intent(inout) :: nodal
    call archive%exchange('nodal.force', nodal%force)
    call archive%exchange('nodal.before', nodal%before)
    call archive%exchange('nodal.normal', nodal%normal)
    call archive%exchange('nodal.area', nodal%area)
    call archive%exchange('nodal.gap', nodal%gap)
    call archive%exchange('nodal.slip', nodal%slip)
    call archive%exchange('nodal.status', nodal%status)
  end subroutine exchange_nodal

end module contact_archive
