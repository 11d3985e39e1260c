! SPDX-License-Identifier: BSD-3-Clause
!> Contact between boundaries: pairs of surfaces, candidates (a node near an edge) and the block
!> of nodes they involve.
module contact_types
  use base_kinds, only: wp, zero
  use cone_types, only: cone_options_t, cone_work_t, certificate_t
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
    real(wp) :: room = zero                !< what the nodes may move before it is evaluated [L]
    ! Results for the tables.
    real(wp) :: force(2, 2) = zero         !< (xy, side) of the step just done [F]
    real(wp) :: force_before(2, 2) = zero  !< of the step before
    real(wp) :: impulse(2, 2) = zero       !< since t = 0 [F T]
    real(wp) :: normal_force = zero, tangential_force = zero
    real(wp) :: normal_work = zero         !< lost, cumulative [F L]
    real(wp) :: friction_work = zero       !< lost, cumulative [F L]
    real(wp) :: penetration = zero         !< largest since the last row [L]
    real(wp) :: smallest_gap = no_gap
    integer :: n_active = 0, n_stick = 0, n_slip = 0
    type(node_forces_t), allocatable :: nodal  !< only where the table NCFORC is asked for
  end type pair_t

  !> A contactor node and the place on the obstacle that it faces.
  type, public :: candidate_t
    integer :: pair = 0
    integer :: node = 0
    integer :: edge = 0
    integer :: a = 0, b = 0        !< nodes of the edge
    real(wp) :: xi = zero          !< place on the edge, 0 at a, 1 at b
    real(wp) :: share = 1.0_wp     !< of the edge in the relative motion: 1; 0 at a wall
    real(wp) :: normal(2) = zero
    real(wp) :: length = zero      !< of the edge [L]
    real(wp) :: gap = zero         !< at the start of the step [L]
    real(wp) :: r(2) = zero        !< reaction (n, t) of the step [F]
    real(wp) :: last(2) = zero, older(2) = zero   !< of the two solves before [F]
    real(wp) :: u(2) = zero        !< gap at the end and slip of the step [L]
    integer :: status = 0
    logical :: valid = .false.     !< takes part in this step
    logical :: held = .false.      !< both sides are prescribed: no row, only watched
  end type candidate_t

  type, public :: contact_t
    type(pair_t), allocatable :: pair(:)
    integer :: n = 0
    type(candidate_t), allocatable :: candidate(:)
    !> of the step before (schemes with two forces)
    type(candidate_t), allocatable :: before(:)
    integer :: n_before = 0
    logical :: keeps_before = .false.
    integer :: d = 2                              !< components per contact: 1 without friction
    integer, allocatable :: block(:)              !< nodes of the contact block
    integer, allocatable :: block_row(:)          !< (nodes) row in the block, 0 = not in it
    real(wp), allocatable :: flexibility(:, :)    !< (2m, 2m) S^-1, fixed dofs cleared [L/F]
    integer :: rows = 0                           !< valid candidates
    integer, allocatable :: row_of(:)             !< candidate of each row
    real(wp), allocatable :: w(:, :), q(:, :), mu(:), r(:, :)
    !> (6, rows of H) dofs of the block that a row takes, and their weights
    integer, allocatable :: h_dof(:, :)
    real(wp), allocatable :: h_weight(:, :)
    real(wp), allocatable :: column(:)            !< (2m) of S^-1 H' [L/F]
    logical :: w_is_current = .false.
    !> The last reactions were nearer to those of the solve before the last: forces alternate
    !> from step to step (theta = 1/2), and so will the next start.
    logical :: alternates = .false.
    integer :: quiet = 0          !< solves in a row without a reaction, counted to 3
    real(wp) :: penetration_tolerance = 1.0e-9_wp !< / edge length
    type(cone_options_t) :: cone
    type(cone_work_t) :: work
    ! Counts for log and tables.
    integer :: searched = 0       !< pair that was searched last, for messages
    integer :: searches = 0, w_builds = 0, block_changes = 0
    integer :: solves = 0
    integer :: sweeps = 0, sweeps_since_row = 0, solves_since_row = 0
    type(certificate_t) :: worst, worst_since_row
    real(wp) :: worst_penetration = zero          !< / edge length
    integer :: wedged = 0, wedged_node = 0        !< contacts that may have several answers
  end type contact_t

end module contact_types
