! SPDX-License-Identifier: BSD-3-Clause
!> Contact between boundaries: pairs of surfaces, candidates (a node near an edge), rows, and
!> the condensed problem for them.
module contact_types
  use base_kinds, only: wp, zero
  use cone_types, only: cone_options_t, cone_work_t, certificate_t
  use contact_rows, only: rows_t
  use contact_surface, only: surface_t
  implicit none
  private

  !> Printed for the gap while no node is near enough to be listed.
  real(wp), parameter, public :: no_gap = 1.0e99_wp

  !> Contact forces on the nodes of a pair: first those of the contactor, then of the obstacle.
  type, public :: node_forces_t
    integer, allocatable :: node(:), side(:)
    integer, allocatable :: place(:, :)        !< (nodes of the model, contactor/obstacle)
    real(wp), allocatable :: area(:)           !< half the edges at the node x thickness [L2]
    real(wp), allocatable :: force(:, :), before(:, :)  !< (2, *) of this step, of the last [F]
    real(wp), allocatable :: normal(:)         !< normal force [F]
    real(wp), allocatable :: gap(:), slip(:)   !< [L]; no_gap where the node is not listed
    integer, allocatable :: status(:)
  end type node_forces_t

  !> Sums over a pair for the tables.
  type, public :: pair_sums_t
    real(wp) :: force(2, 2) = zero         !< (xy, side) of the step just done [F]
    real(wp) :: force_before(2, 2) = zero  !< of the step before
    real(wp) :: impulse(2, 2) = zero       !< since t = 0 [F T]
    real(wp) :: normal_force = zero, tangential_force = zero
    real(wp) :: normal_work = zero         !< lost, cumulative [F L]
    real(wp) :: friction_work = zero       !< lost, cumulative [F L]
    real(wp) :: penetration = zero         !< largest since the last row of sleout [L]
    real(wp) :: smallest_gap = no_gap
    integer :: n_active = 0, n_stick = 0, n_slip = 0
  end type pair_sums_t

  !> One contact card: the contactor's nodes against the obstacle's edges.
  type, public :: pair_t
    integer :: id = 0
    integer :: record = 0                  !< its card, for messages
    integer :: contactor_side = 1          !< 1 = SURFA is the contactor, 2 = SURFB
    real(wp) :: mu = zero
    real(wp) :: birth = zero, death = huge(1.0_wp)
    type(surface_t) :: contactor
    type(surface_t) :: obstacle
    logical :: is_wall = .false.           !< the obstacle is a rigid plane
    real(wp) :: wall_point(2) = zero       !< on it [L]
    real(wp) :: wall_normal(2) = zero      !< toward the bodies
    !> Search: displacements when it was last done, and the smallest distance of a node that is
    !> not on the list. No such node can touch while the bodies have moved less than that.
    real(wp), allocatable :: contactor_reference(:, :), obstacle_reference(:, :)
    real(wp) :: safe_distance = -1.0_wp    !< [L]; < 0: never searched
    real(wp) :: moved = zero               !< bound of the relative motion since the search [L]
    real(wp) :: remaining_margin = zero    !< what nodes may move before it is evaluated [L]
    type(pair_sums_t) :: sums
    type(node_forces_t), allocatable :: nodal  !< only where the table NCFORC is asked for
  end type pair_t

  !> A contactor node and the place on the obstacle that it faces.
  type, public :: candidate_t
    integer :: pair = 0
    integer :: node = 0
    integer :: edge = 0
    real(wp) :: xi = zero          !< place on the edge, 0 at its first node, 1 at its second
    real(wp) :: normal(2) = zero
    logical :: valid = .false.     !< takes part in this step
  end type candidate_t

  !> Counts and certificates for log and tables.
  type, public :: tally_t
    integer :: searches = 0, w_builds = 0, interface_changes = 0
    integer :: solves = 0
    integer :: sweeps = 0, sweeps_since_row = 0, solves_since_row = 0
    type(certificate_t) :: worst, worst_since_row
    real(wp) :: worst_penetration = zero          !< / edge length
    integer :: wedged = 0, wedged_node = 0        !< contacts that may have several answers
  end type tally_t

  type, public :: contact_t
    type(pair_t), allocatable :: pair(:)
    integer :: candidates = 0
    type(candidate_t), allocatable :: candidate(:)
    type(candidate_t), allocatable :: last_list(:)  !< of the search before
    integer :: last_candidates = 0
    type(rows_t), allocatable :: rows             !< of the step
    type(rows_t), allocatable :: next             !< work space: rows being made
    type(rows_t), allocatable :: before           !< of the step before, where a scheme needs them
    logical :: keeps_before = .false.
    integer :: d = 2                              !< components per contact: 1 without friction
    integer, allocatable :: interface_node(:)
    integer, allocatable :: slot(:)               !< (nodes) among interface nodes, 0 = not
    !> (2m, 2m) S^-1 of the interface, constrained dofs cleared [L/F]
    real(wp), allocatable :: schur_inverse(:, :)
    ! The condensed problem: rows that are not rigid.
    integer :: n = 0
    integer, allocatable :: row_of(:)             !< (n)
    real(wp), allocatable :: w(:, :), q(:, :), mu(:), r(:, :)
    !> (6, d n) dofs of the interface that a row of H takes, their weights, how many
    integer, allocatable :: h_dof(:, :), h_size(:)
    real(wp), allocatable :: h_weight(:, :)
    real(wp), allocatable :: column(:)            !< (2m) of S^-1 H' [L/F]
    logical :: w_is_current = .false.
    !> The last reactions were nearer to those of the solve before the last: forces alternate
    !> from step to step (theta = 1/2), and so will the next start.
    logical :: alternates = .false.
    integer :: solves_without_contact = 0         !< in a row, counted to 3
    real(wp) :: penetration_tolerance = 1.0e-9_wp !< / edge length
    integer :: searched = 0                       !< pair that was searched last, for messages
    type(cone_options_t) :: cone
    type(cone_work_t) :: work
    type(tally_t) :: tally
  end type contact_t

end module contact_types
