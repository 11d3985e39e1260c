! SPDX-License-Identifier: BSD-3-Clause
!> Locking in bending, decided from the solution: which share of a part's strain energy is in
!> the bending modes of its elements, and what the same bending costs a body (doc/theory.md 1).
!> A triangle has no such mode alone; with a neighbour it has those of the quadrilateral that
!> both make.
module assembly_bending
  use assembly_blocks, only: stored_at
  use assembly_system, only: system_t
  use base_archive, only: archive_t
  use base_kinds, only: wp, zero, one, half
  use element_bending, only: mode_amplitude, quad_mode_energy, energy_of_modes, &
      pair_mode_energy, &
      bending_energy
  use model_data, only: model_t
  implicit none
  private

  !> Strain energies of a part [F L].
  type, public :: bending_sums_t
    real(wp) :: strain = zero   !< all
    real(wp) :: modes = zero    !< in the bending modes
    real(wp) :: exact = zero    !< what the same bending costs a body
  end type bending_sums_t

  !> Two triangles of a part that share an edge: the corner of one, the edge, the corner of the
  !> other. Each triangle is in the pair of its longest edge.
  type :: pair_t
    integer :: node(4) = 0
    integer :: part = 0
    real(wp) :: share = one     !< of its energies: half where it is the pair of one alone
  end type pair_t

  type, public :: bending_t
    type(pair_t), allocatable :: pair(:)          !< only with triangles
    real(wp), allocatable :: moduli(:, :)         !< (3, parts) pressure, shear, bar, * T1 [F/L]
    type(bending_sums_t), allocatable :: now(:)   !< (parts) of the last look
    type(bending_sums_t), allocatable :: sum(:)   !< (parts) of all looks
    real(wp), allocatable :: largest(:)           !< (parts) modes - exact of a look
    integer, allocatable :: step(:)               !< (parts) of that look
    integer :: looks = 0
    real(wp) :: peak = zero                       !< largest strain energy seen [F L]
  end type bending_t

  public :: make_bending, look_at_bending, locks, excess, exchange_bending

  !> States of less strain energy than this share of the largest are passed over: what they add
  !> to the sums is small.
  real(wp), parameter :: least_share = 0.1_wp

contains

  !> Moduli of the parts and pairs of triangles.
  subroutine make_bending(model, bending)
    type(model_t), intent(in) :: model
    type(bending_t), intent(out) :: bending
    real(wp) :: d(3, 3)
    integer :: e, p, n
    n = size(model%part)
    allocate (bending%moduli(3, n), bending%now(n), bending%sum(n), bending%largest(n), &
        bending%step(n))
    bending%largest = zero
    bending%step = 0
    bending%moduli = zero
    do p = 1, n
      if (model%part(p)%is_rigid) cycle
      associate (part => model%part(p))
        d = part%thickness*model%material(part%material)%item%moduli(part%plane)
      end associate
      bending%moduli(:, p) = [d(1, 1), d(3, 3), d(1, 1) - d(1, 2)*d(2, 1)/d(2, 2)]
    end do
    n = count([(model%mesh%is_of_type(e, 'TRI3'), e=1, model%mesh%n)])
    if (n > 0) call pair_triangles(model, n, bending%pair)
  end subroutine make_bending

  !> Each of n triangles with the neighbour of its part across the longest edge that has one.
  subroutine pair_triangles(model, n, pair)
    type(model_t), intent(in) :: model
    integer, intent(in) :: n
    type(pair_t), allocatable, intent(out) :: pair(:)
    integer, allocatable :: edge(:, :), across(:), longest(:)
    integer :: t, m, pass
    logical :: is_mutual
    allocate (edge(4, 3*n), across(3*n), longest(n))
    call list_edges(model, edge)
    call match_edges(model%nodes, edge, across)
    call choose_edges(model%x, edge, across, longest)
    do pass = 1, 2
      if (pass == 2) allocate (pair(m))
      m = 0
      do t = 1, n
        if (longest(t) == 0) cycle
        associate (other => across(longest(t)), e => edge(:, longest(t)))
          is_mutual = longest((other + 2)/3) == other
          if (is_mutual .and. (other + 2)/3 < t) cycle
          m = m + 1
          if (pass == 2) pair(m) = pair_t([e(1), e(2), edge(1, other), e(3)], e(4), &
              merge(one, half, is_mutual))
        end associate
      end do
    end do
  end subroutine pair_triangles

  !> Three edges of each triangle in turn: the corner that faces it, its ends, the part.
  pure subroutine list_edges(model, edge)
    type(model_t), intent(in) :: model
    integer, intent(out) :: edge(:, :)
    integer :: e, k, n, c(3)
    n = 0
    do e = 1, model%mesh%n
      if (model%mesh%count_of(e) /= 3) cycle
      c = model%mesh%nodes_of(e)
      do k = 1, 3
        n = n + 1
        edge(:, n) = [c(k), c(1 + mod(k, 3)), c(1 + mod(k + 1, 3)), model%mesh%part(e)]
      end do
    end do
  end subroutine list_edges

  !> For each edge the same edge of another triangle of its part; 0 = there is none. Edges that
  !> start at a node are chained.
  pure subroutine match_edges(nodes, edge, across)
    integer, intent(in) :: nodes, edge(:, :)
    integer, intent(out) :: across(:)
    integer, allocatable :: first(:), next(:)
    integer :: k, s
    allocate (first(nodes), next(size(edge, 2)))
    first = 0
    across = 0
    do k = 1, size(edge, 2)
      next(k) = first(edge(2, k))
      first(edge(2, k)) = k
      s = first(edge(3, k))
      do while (s > 0)
        if (edge(3, s) == edge(2, k) .and. edge(4, s) == edge(4, k)) exit
        s = next(s)
      end do
      if (s == 0) cycle
      across(k) = s
      across(s) = k
    end do
  end subroutine match_edges

  !> For each triangle the longest of its edges that have another side; 0 = none has.
  pure subroutine choose_edges(x, edge, across, longest)
    real(wp), intent(in) :: x(:, :)
    integer, intent(in) :: edge(:, :), across(:)
    integer, intent(out) :: longest(:)
    real(wp) :: length, most
    integer :: t, k
    longest = 0
    do t = 1, size(longest)
      most = zero
      do k = 3*t - 2, 3*t
        if (across(k) == 0) cycle
        length = (x(1, edge(3, k)) - x(1, edge(2, k)))**2 &
            + (x(2, edge(3, k)) - x(2, edge(2, k)))**2
        if (length <= most) cycle
        most = length
        longest(t) = k
      end do
    end do
  end subroutine choose_edges

  !> Energies of all parts at displacements u (2, nodes) [L] after a step; strain (parts): their
  !> whole strain energies [F L].
  subroutine look_at_bending(model, system, u, strain, step, bending)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: u(:, :), strain(:)
    integer, intent(in) :: step
    type(bending_t), intent(inout) :: bending
    integer :: e, k, p
    if (.not. sum(strain) > least_share*bending%peak) return
    bending%peak = max(bending%peak, sum(strain))
    bending%now = bending_sums_t()
    bending%now%strain = strain
    do e = 1, model%mesh%n
      if (model%mesh%count_of(e) == 3) cycle
      p = model%mesh%part(e)
      call add_quadrilateral(model, system, e, bending%moduli(3, p), u, bending%now(p))
    end do
    if (allocated(bending%pair)) then
      do k = 1, size(bending%pair)
        p = bending%pair(k)%part
        call add_pair(model, bending%pair(k), bending%moduli(:, p), u, bending%now(p))
      end do
    end if
    bending%looks = bending%looks + 1
    do p = 1, size(bending%sum)
      associate (now => bending%now(p), sum => bending%sum(p))
        sum%strain = sum%strain + now%strain
        sum%modes = sum%modes + now%modes
        sum%exact = sum%exact + now%exact
        if (now%modes - now%exact > bending%largest(p)) then
          bending%largest(p) = now%modes - now%exact
          bending%step(p) = step
        end if
      end associate
    end do
  end subroutine look_at_bending

  !> Adds the modes of element e.
  pure subroutine add_quadrilateral(model, system, e, modulus, u, sums)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    integer, intent(in) :: e
    real(wp), intent(in) :: modulus, u(:, :)
    type(bending_sums_t), intent(inout) :: sums
    real(wp) :: a(2), x(2, 4)
    call find_amplitude(model, model%mesh%nodes_of(e), u, x, a)
    associate (block => system%block(system%block_of(e)))
      if (block%is_rigid) return
      if (allocated(system%modes)) then
        call add_modes(energy_of_modes(system%modes(:, e), a), &
            bending_energy(x, a, modulus), sums)
      else
        call add_modes(quad_mode_energy(block%stiffness(:, :, &
            stored_at(block, e - block%first + 1)), a), bending_energy(x, a, modulus), sums)
      end if
    end associate
  end subroutine add_quadrilateral

  !> Adds the modes of two triangles.
  pure subroutine add_pair(model, pair, moduli, u, sums)
    type(model_t), intent(in) :: model
    type(pair_t), intent(in) :: pair
    real(wp), intent(in) :: moduli(3), u(:, :)
    type(bending_sums_t), intent(inout) :: sums
    real(wp) :: a(2), x(2, 4)
    call find_amplitude(model, pair%node, u, x, a)
    call add_modes(pair%share*pair_mode_energy(x, a, moduli(1), moduli(2)), &
        pair%share*bending_energy(x, a, moduli(3)), sums)
  end subroutine add_pair

  !> Places x of four nodes and the amplitude a of their modes.
  pure subroutine find_amplitude(model, node, u, x, a)
    type(model_t), intent(in) :: model
    integer, intent(in) :: node(4)
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: x(2, 4), a(2)
    real(wp) :: displacement(2, 4)
    integer :: k
    do k = 1, 4
      x(1, k) = model%x(1, node(k))
      x(2, k) = model%x(2, node(k))
      displacement(1, k) = u(1, node(k))
      displacement(2, k) = u(2, node(k))
    end do
    a = mode_amplitude(x, displacement)
  end subroutine find_amplitude

  !> The body of a distorted element bends otherwise, but not at a higher cost.
  pure subroutine add_modes(modes, exact, sums)
    real(wp), intent(in) :: modes, exact
    type(bending_sums_t), intent(inout) :: sums
    sums%modes = sums%modes + modes
    sums%exact = sums%exact + min(modes, exact)
  end subroutine add_modes

  !> Does part p lock? Its modes cost more than bending by a tenth of all its strain energy, so
  !> that under given loads its displacements are a tenth too small; below the energy least
  !> [F L] nothing is said.
  pure logical function locks(bending, p, least)
    type(bending_t), intent(in) :: bending
    integer, intent(in) :: p
    real(wp), intent(in) :: least
    real(wp), parameter :: limit = 0.1_wp
    locks = .false.
    if (bending%sum(p)%strain > least*bending%looks) locks = excess(bending%sum(p)) > limit
  end function locks

  !> Share of the strain energy that the modes cost beyond bending.
  pure real(wp) function excess(sums)
    type(bending_sums_t), intent(in) :: sums
    excess = (sums%modes - sums%exact)/sums%strain
  end function excess

  !> Saves to or restores from the archive.
  subroutine exchange_bending(archive, bending)
    type(archive_t), intent(inout) :: archive
    type(bending_t), intent(inout) :: bending
    call archive%exchange('bending.strain', bending%sum%strain)
    call archive%exchange('bending.modes', bending%sum%modes)
    call archive%exchange('bending.exact', bending%sum%exact)
    call archive%exchange('bending.largest', bending%largest)
    call archive%exchange('bending.step', bending%step)
    call archive%exchange('bending.looks', bending%looks)
    call archive%exchange('bending.peak', bending%peak)
  end subroutine exchange_bending

end module assembly_bending
