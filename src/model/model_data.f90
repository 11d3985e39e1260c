! SPDX-License-Identifier: BSD-3-Clause
!> The scene as data: nodes, elements, parts, sets, loads, contact pairs, requests.
!> Made once from the deck; nothing in it changes during the run. (Before it begins
!> contact_adjust may move nodes.)
module model_data
  use base_kinds, only: wp
  use base_strings, only: to_text
  use deck_names, only: table_count, field_names, step_fixed, overlap_error
  use material_base, only: material_slot_t
  use model_mesh, only: mesh_t
  use model_rigid, only: rigid_t
  implicit none
  private
  !> What a prescribed motion gives (VAD).
  integer, parameter, public :: motion_velocity = 0, motion_acceleration = 1, &
      motion_displacement = 2

  type, public :: part_t
    integer :: id = 0
    integer :: section_id = 0
    integer :: material_id = 0
    integer :: material = 0         !< row in model%material
    integer :: plane = 0            !< plane_stress, plane_strain, axisymmetric, in_space
    character(8) :: form = ''       !< in space: the element that its hexahedra are
    real(wp) :: thickness = 1.0_wp  !< [L]
    logical :: is_rigid = .false.
    integer :: record = 0           !< its card, for messages
    character(80) :: heading = ''
  end type part_t

  type, public :: section_t
    integer :: id = 0
    integer :: plane = 0
    character(8) :: form = ''
    real(wp) :: thickness = 1.0_wp
  end type section_t

  type, public :: set_t
    integer :: id = 0
    integer, allocatable :: member(:)  !< rows (not ids) of nodes, parts or elements
  end type set_t

  !> Element edges, in space faces: rows of their nodes, as the elements have them.
  type, public :: segment_set_t
    integer :: id = 0
    integer :: record = 0
    integer, allocatable :: node(:, :)  !< (2, segments); in space (4), of triangles the last 0
  end type segment_set_t

  type, public :: curve_t
    integer :: id = 0
    real(wp), allocatable :: a(:)   !< times [T], increasing
    real(wp), allocatable :: o(:)
  end type curve_t

  !> Forces force(:, k) * factor * curve(time - arrival) on node(k), none before arrival.
  type, public :: load_t
    integer, allocatable :: node(:)
    real(wp), allocatable :: force(:, :)  !< (dim, nodes)
    integer :: curve = 0
    real(wp) :: factor = 1.0_wp
    real(wp) :: arrival = 0.0_wp          !< [T]
  end type load_t

  !> Damping by the mass of parts: a M of each, a = factor * curve, or factor alone [1/T].
  type, public :: mass_damping_t
    integer, allocatable :: part(:)       !< rows
    integer :: curve = 0                  !< 0 = none: constant
    real(wp) :: factor = 0.0_wp
    real(wp) :: scale(3) = 1.0_wp         !< of a by direction
  end type mass_damping_t

  !> Body load: acceleration of all mass = - factor * curve [L/T2].
  type, public :: gravity_t
    integer :: direction = 1
    integer :: curve = 0
    real(wp) :: factor = 1.0_wp
  end type gravity_t

  !> Motion of nodes in one direction by a curve, between birth and death.
  type, public :: motion_t
    integer, allocatable :: node(:)
    integer :: direction = 1
    integer :: kind = 0
    integer :: curve = 0
    real(wp) :: factor = 1.0_wp
    real(wp) :: birth = 0.0_wp, death = huge(1.0_wp)  !< [T]
    integer :: record = 0
  end type motion_t

  !> What a side of a contact card is.
  integer, parameter, public :: side_part_set = 1, side_node_set = 2, side_part = 3, &
      side_segment_set = 4, side_all_nodes = 5, side_all_parts = 6, &
      side_parts = 7

  type, public :: contact_card_t
    integer :: id = 0
    integer :: kind(2) = 0          !< side_...
    integer :: side(2) = 0          !< row of the set or part
    !> Side whose nodes are exact: 1 = SURFA, 2 = SURFB, 3 = both, 0 = the locally finer one
    integer :: contactor = 0
    character(6) :: pairing = 'NODE'
    logical :: is_self = .false.    !< one surface against itself: that of parts(:)
    logical :: is_of_all = .false.  !< of all parts: what other cards name is theirs
    integer, allocatable :: parts(:)
    logical, allocatable :: leaves_out(:, :)   !< (parts, parts) pairs that do not touch
    real(wp) :: mu = 0.0_wp         !< static
    real(wp) :: kinetic_mu = 0.0_wp
    real(wp) :: friction_decay = 0.0_wp !< with the speed of slip [T/L]
    integer :: overlap = overlap_error  !< what becomes of one at the start
    real(wp) :: restitution = -1.0_wp   !< < 0: that of the scheme
    real(wp) :: birth = 0.0_wp      !< [T]
    real(wp) :: death = huge(1.0_wp)
    integer :: record = 0
  end type contact_card_t

  !> A rigid wall in front of some nodes: a plane, or a shape that moves with a node.
  type, public :: wall_t
    integer :: id = 0
    character(10) :: shape = 'WALL' !< name of its pairing; WALL is a plane that never moves
    integer :: node_set = 0         !< row; 0 = all nodes
    real(wp) :: point(3) = 0.0_wp   !< on the plane, an end, the centre [L]
    real(wp) :: normal(3) = 0.0_wp  !< toward the bodies
    real(wp) :: mu = 0.0_wp
    real(wp) :: birth = 0.0_wp      !< [T]
    real(wp) :: death = huge(1.0_wp)
    integer :: record = 0
    ! Of shapes that have a node:
    integer :: node = 0             !< row
    real(wp) :: along(2) = 0.0_wp   !< from the point to the other end
    real(wp) :: length = 0.0_wp     !< of a finite one; 0 = without ends [L]
    real(wp) :: radius = 0.0_wp     !< [L]
    logical :: is_interior = .false.!< the bodies are inside
    real(wp) :: mass = 0.0_wp       !< > 0: it slides freely along its normal [M]
    real(wp) :: speed = 0.0_wp      !< at t = 0, along the normal [L/T]
    real(wp) :: direction(3) = 0.0_wp  !< of a prescribed motion
    integer :: motion = 0           !< its kind, motion_...
    integer :: curve = 0            !< 0: it stands still
  end type wall_t

  !> Field files: which fields, when, of which parts.
  type, public :: field_request_t
    logical :: on = .false.
    real(wp) :: interval = 0.0_wp       !< [T]
    integer :: part_set = 0             !< row; 0 = all parts
    integer :: compression = 0
    logical :: single = .false.
    real(wp) :: begin = 0.0_wp, end = huge(1.0_wp)
    logical :: wanted(size(field_names)) = .false.
  end type field_request_t

  !> Restart files: when, how many are kept.
  type, public :: restart_request_t
    logical :: on = .false.
    integer :: steps = 0                !< every so many; 0 = not so
    real(wp) :: wall = 0.0_wp           !< every so many seconds of the clock; 0 = not so
    integer :: keep = 2
    logical :: on_signal = .true.
  end type restart_request_t

  !> Which tables are asked for, and how often; 0 = off [T].
  type, public :: requests_t
    real(wp) :: interval(table_count) = 0.0_wp  !< in the order of deck_names
    integer, allocatable :: history_node(:)
    integer, allocatable :: history_element(:)
    type(field_request_t) :: field
    type(restart_request_t) :: restart
  end type requests_t

  !> Newton's method in a step: what *CONTROL_IMPLICIT_SOLUTION may change.
  type, public :: iteration_t
    integer :: every = 0            !< ILIMIT: passes that a factor serves; 0 = by itself
    integer :: most_factors = 0     !< MAXREF, in a step; 0 = no limit
    real(wp) :: motion = 1.0e-11_wp !< DCTOL: largest correction over largest motion of the step
    real(wp) :: force = 0.0_wp      !< RCTOL: what is left over the largest force; 0 = not asked
    real(wp) :: absolute = 0.0_wp   !< ABSTOL: what may be left whatever the rest; 0 = none [F]
  end type iteration_t

  type, public :: controls_t
    real(wp) :: end_time = 0.0_wp
    integer :: end_cycle = 0
    real(wp) :: end_ratio = 0.0_wp      !< change of energy ratio that fails; 0 = off
    real(wp) :: dt = 0.0_wp
    character(10) :: scheme = 'NEWMARK'
    real(wp) :: theta = 0.5_wp
    real(wp) :: xi = 0.5_wp
    real(wp) :: gamma = 0.5_wp
    real(wp) :: beta = 0.25_wp
    real(wp) :: alpha = 0.0_wp          !< of HHT
    real(wp) :: rho = 0.8_wp            !< at infinite frequency, of GENALPHA
    real(wp) :: restitution = 0.0_wp    !< of contact nodes
    logical :: is_safe = .true.         !< RULE SAFE: normal work is never positive
    real(wp) :: pbeta = 0.25_wp         !< of PAOLI
    logical :: is_explicit = .false.    !< lumped masses alone in the effective matrix
    real(wp) :: step_limit = huge(1.0_wp)   !< of an explicit scheme [T]
    integer :: limit_element = 0        !< id of the element that sets it
    logical :: is_static = .false.
    real(wp) :: static_until = 0.0_wp   !< end of a static phase before dynamics [T]
    real(wp) :: static_shift = 1.0e-3_wp, static_residual = 1.0e-10_wp
    integer :: static_passes = 60
    character(10) :: mass = 'CONSISTENT'
    logical :: redistribute = .false.
    real(wp) :: courant = -1.0_wp       !< of DISPERSION; < 0 = from dt
    real(wp), allocatable :: travel(:)  !< (3) direction of shear waves; only with WAVE S
    integer :: step_mode = step_fixed   !< step_... of deck_names
    real(wp) :: shortest_step = 0.0_wp  !< of HALVE [T]
    integer :: most_halvings = 10       !< of DT0
    logical :: is_finite = .false.      !< finite deformation: NSOLVR 12
    integer :: force = 0                !< FORCE of *BIPACT_KINEMATICS, force_... of solid_block
    logical :: is_hencky = .false.      !< LAW of *MAT_ELASTIC at finite deformation
    type(iteration_t) :: iteration      !< at finite deformation
    integer :: mean_dilatation = -1     !< QP0: 0 none, 1 all, -1 where the law keeps its volume
    integer :: ledger_every = 0
    integer :: dump_first = 0, dump_last = 0, dump_every = 1  !< steps; 0 = no dump
    real(wp) :: growth = 1.0e-9_wp
    logical :: stop_on_growth = .false.
    real(wp) :: rotation_warning = 5.0_wp      !< [degrees]
    real(wp) :: penetration_tolerance = 1.0e-9_wp
    character(10) :: frame = ''         !< normals of contact: START, MID or REF
  end type controls_t

  type, public :: model_t
    character(80) :: title = ''
    integer :: dim = 2
    logical :: is_axisymmetric = .false. !< the plane is turned about the y axis, x the radius
    real(wp) :: z = 0.0_wp              !< of the plane [L]
    !> Nodes of the mesh, then centres and rotors of rigid parts.
    integer :: nodes = 0
    integer :: mesh_nodes = 0
    !> The last nodes, which belong to no element: rigid walls, each with its motion
    integer :: bodies = 0
    integer, allocatable :: node_id(:)
    real(wp), allocatable :: x(:, :)         !< (dim, nodes) [L]
    real(wp), allocatable :: v0(:, :)        !< (dim, nodes) initial velocity [L/T]
    logical, allocatable :: fixed(:, :)      !< (dim, nodes)
    type(mesh_t) :: mesh
    type(part_t), allocatable :: part(:)
    type(rigid_t), allocatable :: rigid      !< only where parts are rigid
    type(material_slot_t), allocatable :: material(:)
    type(set_t), allocatable :: node_set(:)
    type(set_t), allocatable :: part_set(:)
    type(set_t), allocatable :: element_set(:)
    type(segment_set_t), allocatable :: segment_set(:)
    type(curve_t), allocatable :: curve(:)
    type(load_t), allocatable :: load(:)
    type(gravity_t), allocatable :: gravity(:)
    !> Only with damping: its cards by mass, and |COEF| of each part, its damping by stiffness
    !> [T].
    type(mass_damping_t), allocatable :: mass_damping(:)
    real(wp), allocatable :: stiffness_damping(:)
    type(motion_t), allocatable :: motion(:)
    type(contact_card_t), allocatable :: contact(:)
    type(wall_t), allocatable :: wall(:)
    type(requests_t) :: requests
    type(controls_t) :: controls
  end type model_t

  public :: count_steps, curve_value, curve_slope, node_name

contains

  !> Number of steps of length dt to the end time, and the length of a cut last step (zero when
  !> the end is a whole number of steps within 1e-9).
  pure subroutine count_steps(end_time, dt, full_steps, last_step)
    real(wp), intent(in) :: end_time, dt
    integer, intent(out) :: full_steps
    real(wp), intent(out) :: last_step
    real(wp) :: steps
    steps = end_time/dt
    full_steps = nint(steps)
    last_step = 0.0_wp
    if (abs(steps - full_steps) <= 1.0e-9_wp*max(1.0_wp, steps)) return
    full_steps = int(steps)
    last_step = end_time - full_steps*dt
  end subroutine count_steps

  !> Piecewise linear value of a curve; constant outside its range.
  pure real(wp) function curve_value(curve, time)
    type(curve_t), intent(in) :: curve
    real(wp), intent(in) :: time
    integer :: low, high, middle
    associate (a => curve%a, o => curve%o, n => size(curve%a))
      if (time <= a(1)) then
        curve_value = o(1)
      else if (time >= a(n)) then
        curve_value = o(n)
      else
        low = 1
        high = n
        do while (high - low > 1)
          middle = (low + high)/2
          if (a(middle) < time) low = middle
          if (.not. a(middle) < time) high = middle
        end do
        curve_value = o(low) + (o(high) - o(low))*((time - a(low))/(a(high) - a(low)))
      end if
    end associate
  end function curve_value

  !> Slope of a curve just after a time; zero outside its range.
  pure real(wp) function curve_slope(curve, time)
    type(curve_t), intent(in) :: curve
    real(wp), intent(in) :: time
    integer :: k
    curve_slope = 0.0_wp
    do k = 2, size(curve%a)
      if (curve%a(k - 1) <= time .and. curve%a(k) > time) &
          curve_slope = (curve%o(k) - curve%o(k - 1))/(curve%a(k) - curve%a(k - 1))
    end do
  end function curve_slope

  !> "node 12", or "an end of wall 3" of the node that carries a wall.
  pure function node_name(model, node) result(name)
    type(model_t), intent(in) :: model
    integer, intent(in) :: node
    character(:), allocatable :: name
    integer :: k
    name = 'node '//to_text(model%node_id(node))
    if (node <= model%nodes - model%bodies) return
    do k = 1, size(model%wall)
      if (model%wall(k)%node /= node) cycle
      name = 'an end of wall '//to_text(model%wall(k)%id)
      if (model%wall(k)%radius > 0.0_wp) name = 'wall '//to_text(model%wall(k)%id)
    end do
  end function node_name

end module model_data
