! SPDX-License-Identifier: BSD-3-Clause
!> Everything a run consists of, and the order to make it (run_setup), plan it (run_plan), go
!> through it (run_loop) and tell of it (run_report).
module run_data
  use assembly_bending, only: bending_t
  use assembly_part, only: part_t
  use assembly_system, only: system_t
  use assembly_team, only: team_t
  use base_archive, only: archive_t
  use base_kinds, only: wp, zero, one, i8
  use base_messages, only: messages_t
  use base_timers, only: timers_t
  use contact_touch, only: touch_t
  use contact_adjust, only: moved_node_t
  use contact_types, only: contact_t
  use cone_types, only: cone_options_t
  use deck_data, only: deck_t
  use deck_names, only: step_fixed
  use linalg_bodies, only: body_blocks_t
  use linalg_graph, only: block_matrix_t
  use linalg_near, only: near_t
  use linalg_solver, only: solver_t, solver_options_t
  use model_data, only: model_t
  use model_state, only: state_t
  use output_fields, only: fields_t
  use output_storage, only: storage_t, mesh_t
  use output_tables, only: tables_t
  use time_base, only: scheme_t
  use time_ledger, only: ledger_t
  implicit none
  private

  !> Residual of the energy balance / largest term beyond which its terms mean little: a
  !> hundred times what a run keeps to.
  real(wp), parameter, public :: open_balance = 1.0e-9_wp

  !> Kinds of warnings that a run can give (run_warnings names them).
  integer, parameter, public :: warning_kinds = 7

  !> What this scene needs, each with its reason; what is off is not allocated and not called.
  type, public :: feature_t
    character(12) :: name = ''
    logical :: on = .false.
    character(:), allocatable :: reason
  end type feature_t

  type, public :: plan_t
    integer :: n = 0
    type(feature_t) :: feature(32)
    logical :: contact = .false.
    logical :: loads = .false.
    logical :: motions = .false.
    logical :: reactions = .false.   !< of held dofs, at every step
    logical :: damping = .false.     !< of the deck
    logical :: ledger = .false.
    logical :: refinement = .false.
    integer :: refined_from = huge(1)  !< number of steps before the first that is refined
    logical :: dump = .false.        !< of contact problems
    logical :: fields = .false.      !< files of frames
    logical :: restarts = .false.    !< files to go on from
    integer :: full_steps = 0
    real(wp) :: last_step = zero     !< length of a cut last step; 0 = none [T]
  end type plan_t

  !> An effective matrix that is not the one in use, its factor, and the flexibility of the
  !> interface.
  type, public :: operator_t
    class(solver_t), allocatable :: solver
    type(block_matrix_t) :: matrix
    type(body_blocks_t) :: schur_inverse
    type(near_t) :: near                         !< in its place: contact_local
    real(wp), allocatable :: flexibility(:, :)   !< only with rigid parts: rigid_step_t
  end type operator_t
  !> Rigid parts in a step (run_rigid).
  type, public :: rigid_step_t
    real(wp), allocatable :: lever(:, :)         !< (2, followers) of the step
    real(wp), allocatable :: turn(:)             !< (parts) of the step, that of the levers
    logical :: is_middle = .false.               !< levers of the middle of the step
    logical :: keeps_levers = .false.            !< that no turn of this step repeats
    real(wp) :: change = 0.0_wp                  !< what levers of the last pass erred by
    integer, allocatable :: row(:)               !< (n) of a node among the followers, 0 = none
    integer, allocatable :: solver_node(:)       !< nodes that the solver keeps to the end
    integer, allocatable :: slot(:)              !< (n) of a node among them, 0 = none
    integer, allocatable :: constrained(:)       !< their held dofs
    real(wp), allocatable :: flexibility(:, :)   !< of them [L/F]
    real(wp), allocatable :: half_spread(:, :)   !< work space: spread in its rows alone
    real(wp), allocatable :: x(:, :)             !< (dim, m) motion of the interface [L]
    ! Only where forces of both ends of a step act: (2, followers) levers of the step before,
    ! (dim, n) the motion on which its forces work [L].
    real(wp), allocatable :: lever_before(:, :), motion_before(:, :)
    integer :: passes = 0                        !< solves that were repeated for the turns
  end type rigid_step_t
  !> Damping of the deck.
  type, public :: damping_state_t
    real(wp), allocatable :: value(:)            !< of each card by mass, in force [1/T]
    real(wp), allocatable :: rate(:, :)          !< (dim, n) work space [L/T]
    real(wp), allocatable :: force(:, :)         !< (dim, n) of the step just done [F]
    !> (dim, n) that at its begin, only for schemes that count both [F]
    real(wp), allocatable :: force_before(:, :)
  end type damping_state_t
  !> Where the run stands in its steps of DT0, which may be halved or cut (run_step).
  type, public :: step_control_t
    integer :: mode = step_fixed     !< step_... of deck_names
    ! Steps of DT0 follow each other from origin on; the last one may be shorter.
    real(wp) :: origin = zero        !< [T]
    integer :: full_steps = 0
    real(wp) :: last_step = zero     !< length of a shorter last one; 0 = none [T]
    integer :: done = 0              !< of these steps
    real(wp) :: share = zero         !< done of the one that has begun
    real(wp) :: target = one         !< the same at the end of the step that is tried
    integer :: tries = 0             !< of it that were refused
    integer :: level = 0             !< HALVE: steps are DT0/2^level long
    integer :: good = 0              !< of these in a row that were not refused
    logical :: was_cut = .false.     !< EVENT: the step just done ends at a touch
    type(touch_t) :: touch
    logical :: is_static = .false.   !< in the static phase
    real(wp) :: time_before = -one   !< start of the step just done [T]; < 0 at t = 0
    integer :: halvings = 0, cuts = 0
    ! Only where a step may be refused: the state at its start, with what was counted then.
    type(archive_t), allocatable :: before
    integer :: analyses = 0
    integer :: faults(3) = 0
    logical :: new_interface = .false.   !< the refused step had another interface
  end type step_control_t

  !> Newton's method in a step of finite deformation (run_newton).
  type, public :: newton_t
    real(wp), allocatable :: d(:, :)         !< (dim, n) correction of x [L]
    !> (dim, n) what is left of the balance at x but for contact, held dofs included [F]
    real(wp), allocatable :: residual(:, :)
    logical :: is_explicit = .false.         !< nothing to iterate: residual is f(U0)
    real(wp) :: work = zero                  !< of the internal force in the step [F L]
    real(wp) :: energy = zero                !< strain energy at the end of the last step [F L]
    real(wp) :: length = zero                !< of the scene: round-off of places [L]
    real(wp), allocatable :: load(:, :)      !< (dim, n) of b, what does not change with x [F]
    real(wp), allocatable :: trial(:, :)     !< (dim, n) displacements [L], or forces [F]
    real(wp) :: volume = one                 !< smallest det F at x
    integer :: factors = 0                   !< of the step
    !> Smallest principal stretch so far that is doubtful for the law of its element.
    real(wp) :: stretch = huge(one)
    integer :: compressed = 0                !< steps with one
    integer :: compressed_element = 0        !< row
    integer :: most_passes = 30
    integer :: passes = 0, steps = 0         !< of the run so far
    integer :: worst = 0                     !< most passes of a step
  end type newton_t

  !> What a run will need (run_forecast).
  type, public :: forecast_t
    real(wp) :: rate = zero              !< Gflop/s of a loop in the cache
    integer(i8) :: bytes = 0_i8          !< largest memory of the run
    real(wp) :: start = zero             !< [s] up to the first step, from now on
    real(wp) :: step = zero              !< [s] of a step
    real(wp) :: whole = zero             !< [s] of the run, from now on
    real(wp) :: cpu = zero               !< [s] of the processor when it was made
  end type forecast_t

  type, public :: run_t
    type(deck_t) :: deck
    type(model_t) :: model
    type(plan_t) :: plan
    type(forecast_t) :: forecast
    type(cone_options_t) :: cone
    type(solver_options_t) :: solver_options
    type(state_t) :: state
    type(step_control_t) :: step
    type(system_t) :: system
    !> What the energy may rise by without a word, where parts are held by contact alone: the
    !> residual of equilibrium over the size of the scene [F L].
    real(wp) :: least_energy = zero
    class(scheme_t), allocatable :: scheme
    class(solver_t), allocatable :: solver
    type(block_matrix_t) :: matrix
    type(operator_t), allocatable :: other     !< only of schemes of two stages
    integer :: stage_in_use = 1                !< whose matrix that above is
    type(contact_t) :: contact
    type(rigid_step_t), allocatable :: rigid   !< only with rigid parts
    type(ledger_t) :: ledger
    type(tables_t) :: tables
    type(timers_t) :: timers
    real(wp), allocatable :: b(:, :), x(:, :)              !< (dim, n)
    real(wp), allocatable :: load_0(:, :), load_1(:, :)    !< (dim, n) only with loads [F]
    real(wp), allocatable :: b_interface(:, :), x_interface(:, :)    !< (dim, m) interface
    real(wp), allocatable :: force(:, :)                   !< (dim, m) H' r
    real(wp), allocatable :: x_contact(:, :)   !< (dim, m) motion, only where S^-1 is not kept
    ! (dim, n), only with refinement
    real(wp), allocatable :: correction(:, :), b_kept(:, :)
    type(newton_t), allocatable :: newton      !< only at finite deformation
    ! Only with prescribed motions or a table of reactions
    logical, allocatable :: active_motion(:)
    type(part_t) :: motion_part            !< columns of A at nodes that are moved at some time
    type(part_t) :: reaction_part          !< rows of A at nodes that are held at some time
    integer, allocatable :: reaction_dof(:, :)             !< (2, *) their direction and node
    real(wp), allocatable :: given(:, :)                   !< (dim, n) motion of held dofs [L]
    real(wp), allocatable :: b_held(:, :)                  !< b in those rows, not cleared
    real(wp), allocatable :: reaction(:, :)                !< (dim, n) of the step just done [F]
    real(wp), allocatable :: mean_reaction(:, :)           !< its mean over the step [F]
    real(wp), allocatable :: first_reaction(:, :)          !< of the first of two stages [F]
    real(wp), allocatable :: smooth_reaction(:, :)         !< the part that is a load [F]
    type(damping_state_t), allocatable :: damping          !< only where the deck has it
    ! Only in statics of bodies that supports do not hold.
    real(wp), allocatable :: shift(:)                      !< (n) eps M [F/L]
    real(wp), allocatable :: x_pass(:, :), move(:, :)      !< (dim, n) last pass, its change [L]
    real(wp), allocatable :: unbalanced(:, :)              !< (dim, n) of the last step [F]
    integer :: same_moves = 0                              !< passes in a row
    logical :: starts_from_rest = .false.                  !< nothing is loaded before this step
    integer :: static_steps = 0                            !< of the static phase
    integer :: first_cycle = 0                             !< at which the scheme began
    integer :: factors = 0, analyses = 0, solves = 0
    real(wp) :: largest_motion = zero  !< of a node in the step just done [L]
    real(wp) :: rotation = zero        !< largest seen [radians]
    integer :: rotation_element = 0
    integer :: rotations = 0           !< looks that found one beyond ROTWARN
    integer :: open_balances = 0       !< evaluations of energies beyond open_balance
    integer :: looked = 0              !< step of the last look at all bodies
    type(bending_t), allocatable :: bending  !< of the elements, by part; in the plane
    logical :: broken = .false.        !< NaN or infinity: the state is not written
    class(storage_t), allocatable :: storage  !< what can keep fields and restarts
    type(fields_t), allocatable :: fields     !< only with field files
    type(mesh_t), allocatable :: mesh
    ! Only with restart files: the deck as understood, and its hash
    character(:), allocatable :: echo
    character(16) :: deck_hash = ''
    integer(i8) :: restart_tick = 0_i8        !< clock at the last restart file
    integer :: restart_files = 0
    character(:), allocatable :: restarted    !< from where, empty: from the start
    character(:), allocatable :: folder
    logical :: made_folder = .false.          !< it was not there before
    !> The one record of what there is to say: of the deck first, then of the run.
    type(messages_t) :: notes, warnings
    !> Step in which each kind was first seen, and its time [T]
    integer :: first_warned(warning_kinds) = -1
    real(wp) :: first_time(warning_kinds) = zero
    type(moved_node_t), allocatable :: moved(:)  !< onto obstacles, before the start
    class(team_t), pointer :: team => null()   !< ranks that share the work, if there are any
    logical :: quiet = .false.
    integer :: log_unit = -1
  end type run_t

end module run_data
