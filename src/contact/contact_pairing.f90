! SPDX-License-Identifier: BSD-3-Clause
!> What a pairing is: one contact card, or one wall, and how it finds rows. Every pairing
!> gives rows of the same kind; nothing beyond this layer knows which made them.
module contact_pairing
  use base_archive, only: archive_t
  use base_kinds, only: wp, zero
  use base_status, only: status_t
  use contact_friction, only: friction_t
  use contact_ramp, only: ramp_t
  use contact_rows, only: rows_t
  use contact_surface, only: surface_t
  use model_data, only: model_t
  implicit none
  private

  !> Printed for the gap while no node is near enough to be listed.
  real(wp), parameter, public :: no_gap = 1.0e99_wp

  !> Contact forces on the nodes of a pairing: first those of SURFA, then of SURFB.
  type, public :: node_forces_t
    integer, allocatable :: node(:), side(:)
    integer, allocatable :: first(:)           !< (2) before the first node of each side
    real(wp), allocatable :: area(:)           !< of the boundary that can touch [L2]
    real(wp), allocatable :: force(:, :), before(:, :)  !< (dim, *) of this step, the last [F]
    real(wp), allocatable :: normal(:)         !< normal force [F]
    real(wp), allocatable :: gap(:), slip(:)   !< [L]; no_gap where the node is not listed
    integer, allocatable :: status(:)
    ! Work space of the areas: nodes that are near or pressed, boundary around them [L2]; parts
    ! of an edge that are covered.
    logical, allocatable :: is_near(:)
    real(wp), allocatable :: around(:), low(:), high(:)
  end type node_forces_t

  !> Sums over a pairing for the tables.
  type, public :: pair_sums_t
    real(wp) :: force(3, 2) = zero         !< (xyz, side) of the step just done [F]
    real(wp) :: force_before(3, 2) = zero  !< of the step before
    real(wp) :: impulse(3, 2) = zero       !< since t = 0 [F T]
    real(wp) :: normal_force = zero, tangential_force = zero
    real(wp) :: normal_work = zero         !< lost, cumulative [F L]
    real(wp) :: friction_work = zero       !< lost, cumulative [F L]
    real(wp) :: penetration = zero         !< largest true overlap since the last row [L]
    real(wp) :: smallest_gap = no_gap
    integer :: n_active = 0, n_stick = 0, n_slip = 0
  end type pair_sums_t

  !> What closing overlaps may cost: no more than contact has taken out in normal direction.
  type, public :: purse_t
    real(wp) :: balance = zero      !< cumulative sum of r_n c [F L]
    real(wp) :: spent = zero        !< of it given back by closing overlaps
    real(wp) :: wanted = zero       !< what closing them wholly last asked for
    real(wp) :: beta = 1.0_wp       !< share of the overlaps that this step closes
    integer :: short_steps = 0      !< steps with beta < 1
    real(wp) :: given = zero, taken = zero   !< by the solve just done [F L]
    logical :: is_shut = .false.         !< nothing is given in this step
    logical :: was_short = .false.       !< in some solve of this step
  end type purse_t

  !> The deepest overlap that was found.
  type, public :: overlap_t
    real(wp) :: depth = zero        !< [L]
    real(wp) :: share = zero        !< / the shorter edge at hand
    integer :: node = 0
    integer :: part = 0             !< id of the part it stands in
    logical :: is_crossing = .false.!< of edges; no node stands inside
  end type overlap_t

  !> A row to be added when a solved step has shown that it is missing, or whose frame has
  !> turned too much.
  type, public :: late_t
    integer :: row = 0              !< whose frame is replaced; 0: a new row
    integer :: key(4) = 0
    integer :: points = 0
    integer :: point(5) = 0
    real(wp) :: weight(5) = zero
    !> normal: the last component is zero in the plane
    real(wp) :: normal(3) = zero, gap = zero, allowance = zero, length = zero
    integer :: kind = 0
  end type late_t

  type, abstract, public :: pairing_t
    integer :: id = 0
    integer :: record = 0                  !< its card, for messages
    integer :: number = 0                  !< among the pairings
    logical :: is_wall = .false.           !< rigid obstacle, without a side of nodes
    type(friction_t) :: friction
    integer :: multiplier_side = 0         !< whose nodes carry multipliers; 0: not a mortar
    real(wp) :: birth = zero, death = huge(1.0_wp)
    logical :: is_born = .false.           !< its first step has been checked
    real(wp) :: accepted_overlap = zero    !< found then, taken as a touch [L]
    logical :: is_reference = .false.      !< normals of the reference geometry
    logical :: is_energy_safe = .true.     !< the purse applies
    real(wp) :: restitution = zero         !< e of its contact nodes
    real(wp) :: penetration_tolerance = 1.0e-9_wp !< / edge length
    type(surface_t) :: side(2)
    !> Search: the displacements when it was last done, and the smallest distance of what is
    !> not on the list. Nothing else can touch while the bodies have moved less than that.
    real(wp), allocatable :: reference_1(:, :), reference_2(:, :)
    !> (dim) of a plane that stands still in space: only motion along it changes distances
    real(wp), allocatable :: one_way(:)
    real(wp) :: safe_distance = -1.0_wp    !< [L]; < 0: never searched
    real(wp) :: moved = zero               !< bound of the relative motion since the search [L]
    real(wp) :: remaining_margin = zero    !< what nodes may move before it is evaluated [L]
    real(wp) :: turn_margin = huge(1.0_wp) !< what edges may turn before the list is too short
    integer :: listed = 0                  !< nodes that are near
    type(pair_sums_t) :: sums
    type(purse_t) :: purse
    logical :: may_overlap = .false.       !< nodes on the other's boundary have deep places
    type(ramp_t), allocatable :: ramp      !< of interference that is pushed out
    type(overlap_t) :: overlap             !< of the step just done
    type(node_forces_t), allocatable :: nodal  !< only where the table NCFORC is asked for
  contains
    procedure(list_i), deferred :: list
    procedure(interface_i), deferred :: mark_interface
    procedure(mark_i), deferred :: mark_contact_nodes
    procedure(find_i), deferred :: find_places
    procedure(append_i), deferred :: append_rows
    procedure(renew_i), deferred :: renew_gaps
    procedure(late_i), deferred :: find_late
    procedure(measure_i), deferred :: measure
    procedure :: find_passage
    procedure(whole_i), deferred :: measure_whole
    procedure(exchange_i), deferred :: exchange
    procedure :: weigh_nodes
  end type pairing_t

  type, public :: pairing_slot_t
    class(pairing_t), allocatable :: item
  end type pairing_slot_t

  abstract interface
    !> Lists what is nearer than reach [L] at displacement u, and sets safe_distance.
    subroutine list_i(this, model, u, reach)
      import :: pairing_t, model_t, wp
      class(pairing_t), intent(inout) :: this
      type(model_t), intent(in) :: model
      real(wp), intent(in), contiguous :: u(:, :)
      real(wp), intent(in) :: reach
    end subroutine list_i
    !> Marks nodes of the model that listed rows may involve. carrier (nodes): of a node
    !> that is only looked at, the one it moves along with.
    subroutine interface_i(this, model, taken, carrier)
      import :: pairing_t, model_t
      class(pairing_t), intent(in) :: this
      type(model_t), intent(in) :: model
      logical, intent(inout) :: taken(:)
      integer, intent(inout) :: carrier(:)
    end subroutine interface_i
    !> Marks nodes of the model that can ever touch (REDIST).
    subroutine mark_i(this, model, taken)
      import :: pairing_t, model_t
      class(pairing_t), intent(in) :: this
      type(model_t), intent(in) :: model
      logical, intent(inout) :: taken(:)
    end subroutine mark_i
    !> Places of nodes on the obstacle at the start of a step of free motion free (2, nodes)
    !> [L], which only interface nodes have. is_same: they are those of the last step, but for
    !> their gaps.
    subroutine find_i(this, model, u, free, is_same)
      import :: pairing_t, model_t, wp
      class(pairing_t), intent(inout) :: this
      type(model_t), intent(in) :: model
      real(wp), intent(in), contiguous :: u(:, :), free(:, :)
      logical, intent(out) :: is_same
    end subroutine find_i
    !> Rows of the places. spare: rows that hold only below their allowance.
    subroutine append_i(this, rows, spare)
      import :: pairing_t, rows_t
      class(pairing_t), intent(inout) :: this
      type(rows_t), intent(inout) :: rows, spare
    end subroutine append_i
    !> New gaps for the rows and spare rows behind the first a and b, which are those of the
    !> places; is_same turns false if they are not.
    subroutine renew_i(this, rows, a, spare, b, is_same)
      import :: pairing_t, rows_t
      class(pairing_t), intent(in) :: this
      type(rows_t), intent(inout) :: rows, spare
      integer, intent(inout) :: a, b
      logical, intent(inout) :: is_same
    end subroutine renew_i
    !> What the solved end of the step u1 shows to be missing; u0 its start.
    subroutine late_i(this, model, u0, u1, rows, late, n)
      import :: pairing_t, model_t, rows_t, late_t, wp
      class(pairing_t), intent(inout) :: this
      type(model_t), intent(in) :: model
      real(wp), intent(in), contiguous :: u0(:, :), u1(:, :)
      type(rows_t), intent(in) :: rows
      type(late_t), intent(inout) :: late(:)
      integer, intent(inout) :: n
    end subroutine late_i
    !> True gaps of the listed nodes at u, and the deepest overlap.
    subroutine measure_i(this, model, u, overlap)
      import :: pairing_t, model_t, overlap_t, wp
      class(pairing_t), intent(inout) :: this
      type(model_t), intent(in) :: model
      real(wp), intent(in), contiguous :: u(:, :)
      type(overlap_t), intent(inout) :: overlap
    end subroutine measure_i
    !> The deepest overlap of all nodes and edges at u, listed or not. accepted [L]: what the
    !> digits of a deck make of a touch.
    subroutine whole_i(this, model, u, overlap, accepted)
      import :: pairing_t, model_t, overlap_t, wp
      class(pairing_t), intent(inout) :: this
      type(model_t), intent(in) :: model
      real(wp), intent(in), contiguous :: u(:, :)
      type(overlap_t), intent(inout) :: overlap
      real(wp), intent(out) :: accepted
    end subroutine whole_i
    !> Saves its lists to the archive or restores them.
    subroutine exchange_i(this, archive)
      import :: pairing_t, archive_t
      class(pairing_t), intent(inout) :: this
      type(archive_t), intent(inout) :: archive
    end subroutine exchange_i
  end interface

  public :: note_overlap

contains

  !> Nodes that have gone through the obstacle within a step of motion du to u and stand outside
  !> again; does nothing where none can.
  subroutine find_passage(this, model, u, du, overlap)
    class(pairing_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(in), contiguous :: u(:, :), du(:, :)
    type(overlap_t), intent(inout) :: overlap
  end subroutine find_passage

  !> Areas of nodes that the pairing knows better than the boundary does, into area, which has
  !> those of all its nodes [L2]; none here.
  subroutine weigh_nodes(this, model, area)
    class(pairing_t), intent(in) :: this
    type(model_t), intent(in) :: model
    real(wp), intent(inout) :: area(:)
  end subroutine weigh_nodes

  !> Keeps the deeper of two overlaps, in shares of an edge.
  pure subroutine note_overlap(overlap, depth, length, node, part, is_crossing)
    type(overlap_t), intent(inout) :: overlap
    real(wp), intent(in) :: depth, length
    integer, intent(in) :: node, part
    logical, intent(in) :: is_crossing
    if (.not. depth > overlap%share*length) return
    overlap = overlap_t(depth=depth, share=depth/length, node=node, part=part, &
        is_crossing=is_crossing)
  end subroutine note_overlap

end module contact_pairing
