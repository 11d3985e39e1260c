! SPDX-License-Identifier: BSD-3-Clause
!> Contact of a scene: its pairings, the rows of the step, and the condensed problem for them.
module contact_types
  use base_kinds, only: wp, zero
  use cone_anderson, only: anderson_t
  use cone_blocks, only: delassus_blocks_t
  use cone_dense, only: delassus_dense_t
  use cone_types, only: cone_options_t, cone_work_t, certificate_t
  use contact_pairing, only: pairing_slot_t, late_t
  use contact_rows, only: rows_t, row_kinds
  use contact_rule, only: contact_rule_t
  use linalg_bodies, only: body_blocks_t
  use linalg_near, only: near_t
  use linalg_solver, only: solver_t
  implicit none
  private

  !> Counts and certificates for log and tables.
  type, public :: tally_t
    integer :: searches = 0, w_builds = 0, interface_changes = 0
    integer :: solves = 0
    integer :: sweeps = 0, sweeps_since_row = 0, solves_since_row = 0
    integer :: rows(row_kinds) = 0        !< in contact solves, by kind
    integer :: allowances = 0             !< rows of nodes without an exact row, in solves
    integer :: late_rows = 0              !< found missing by a solved step
    integer :: new_frames = 0             !< set to the end of the step
    integer :: repeats = 0                !< solves made again for a purse
    integer :: redone = 0                 !< steps that outran their list
    type(certificate_t) :: worst, worst_since_row
    real(wp) :: overlap = zero, overlap_share = zero   !< largest [L], / shorter edge
    integer :: overlap_node = 0, overlap_step = -1     !< where and when beyond the limit
    integer :: overlaps = 0                       !< how often beyond it
    integer :: misses = 0                         !< solves that missed the certificate
    integer :: wedged = 0, wedged_node = 0        !< contacts that may have several answers
  end type tally_t

  !> Contact without S^-1 (contact_local): the near part of the flexibility and of W.
  type, public :: local_t
    logical :: is_exact = .false.             !< nothing is beyond the near part
    logical :: by_products = .false.          !< W by products alone
    logical :: is_moved = .false.             !< motion is that of force
    integer :: radius = 0, margin = 0         !< of near part and windows, in elements
    class(solver_t), pointer :: solver => null()   !< of the bodies; the run keeps it
    type(near_t) :: near                      !< of the interface nodes
    type(delassus_blocks_t) :: w              !< near part of W
    !> (*, n) dofs of each contact's rows of H and their number, for which w has its pattern
    integer, allocatable :: pattern(:, :), pattern_size(:)
    integer, allocatable :: first_of(:), of_node(:)   !< contacts of each interface node
    integer, allocatable :: mark(:), next(:)          !< work space
    real(wp), allocatable :: reach(:, :, :)           !< (d, dim, m) work space
    real(wp), allocatable :: weight(:, :, :, :)       !< (d, dim, points, n) of H
    real(wp), allocatable :: left_out(:, :)           !< (d, n) (W - near) r [L]
    real(wp), allocatable :: b(:, :), x(:, :)         !< (dim, nodes) force, motion of bodies
    !> (dim, m) of the last product; motion less the near part's, of two solves [F, L]
    real(wp), allocatable :: force(:, :), motion(:, :), far(:, :), far_older(:, :)
    integer :: solves = 0, passes = 0         !< so far
  end type local_t

  type, public :: contact_t
    type(pairing_slot_t), allocatable :: pairing(:)
    logical, allocatable :: acts(:)               !< which of them in this step
    integer :: listed = 0                         !< nodes that are near, of all that act
    type(rows_t), allocatable :: rows             !< of the step
    type(rows_t), allocatable :: spare            !< rows that hold only below their allowance
    type(rows_t), allocatable :: next, left, work_rows   !< rows being made
    type(rows_t), allocatable :: before           !< of the step before, if a scheme needs it
    type(late_t), allocatable :: late(:)          !< rows to be added
    integer :: late_rounds = 0                    !< of this step
    integer :: most_late_rounds = 3               !< in which frames are set anew
    !> (dim, nodes) half of the motion that Newton's method has found so far: rows of bodies
    !> have the frames of the middle of the step. Only at finite deformation with FRAME MID [L]
    real(wp), allocatable :: half_motion(:, :)
    !> Rows stay as they are from pass to pass, but for those that are missing.
    logical :: keeps_rows = .false.
    logical :: keeps_before = .false.
    type(contact_rule_t) :: rule                  !< of the stage
    !> r.dU of the step is friction and normal loss, each by its own formula
    logical :: splits_work = .true.
    real(wp) :: largest_velocity = zero           !< on velocities: of all nodes [L/T]
    logical :: was_on_velocities = .false.        !< the last stage: offsets, active rows
    logical :: friction_varies = .false.          !< with the speed of slip, in some pairing
    real(wp) :: step_length = zero                !< [T]
    integer :: dim = 2                            !< of the bodies
    integer :: d = 2                              !< components per contact: 1 without friction
    integer, allocatable :: interface_node(:)
    integer, allocatable :: slot(:)               !< (nodes) among interface nodes, 0 = not
    integer, allocatable :: constrained(:)        !< dofs of the interface, dim m, that are held
    integer, allocatable :: carried(:, :)         !< (2, *) node, interface node it follows
    !> (dim, nodes) motion of the free step and displacement at the end of the step with
    !> contact, right at interface nodes only [L]
    real(wp), allocatable :: free(:, :), u_end(:, :)
    real(wp), allocatable :: x_end(:, :)          !< (dim, m) motion of the interface [L]
    real(wp), allocatable :: placed(:, :)         !< (dim, nodes): contact_velocity
    integer, allocatable :: body(:)               !< (nodes) bodies: components of the graph
    !> (dim m, dim m) S^-1 of the interface by bodies, constrained dofs cleared [L/F]
    type(body_blocks_t) :: schur_inverse
    type(local_t), allocatable :: local           !< only where there is no S^-1
    ! The condensed problem: rows that are not rigid.
    integer :: n = 0
    integer, allocatable :: row_of(:)             !< (n)
    type(delassus_dense_t) :: w
    real(wp), allocatable :: q(:, :), mu(:), r(:, :)
    real(wp), allocatable :: mu_law(:)            !< (n) where friction varies: of the slips
    real(wp), allocatable :: mu_bound(:, :)       !< (2, n) between which the answer is
    type(anderson_t), allocatable :: mu_memory    !< of its iteration
    !> (*, d n) dofs of the interface that a row of H takes, their weights, how many
    integer, allocatable :: h_dof(:, :), h_size(:)
    real(wp), allocatable :: h_weight(:, :)
    real(wp), allocatable :: column(:)            !< (dim m) of S^-1 H' [L/F]
    !> W is that of rows and schur_inverse: so after build_w, until one of them is replaced
    !> (use_rows, constrain_interface, a restart)
    logical :: w_is_current = .false.
    !> rows and spare are those of the places at the start of the last step
    logical :: rows_are_plain = .false.
    !> The last reactions were nearer to those of the solve before the last: forces alternate
    !> from step to step (undamped schemes), and so will the next start.
    logical :: alternates = .false.
    integer :: solves_without_contact = 0         !< in a row, counted to 3
    integer :: idle_steps = 2                     !< without rows and lists, counted to 2
    real(wp) :: penetration_tolerance = 1.0e-9_wp !< / edge length
    integer :: searched = 0                       !< pairing that was searched last
    type(cone_options_t) :: cone
    type(cone_work_t) :: work
    type(tally_t) :: tally
  end type contact_t

end module contact_types
