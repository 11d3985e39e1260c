! SPDX-License-Identifier: BSD-3-Clause
!> The discrete contact problem and what is said of its solution.
!> Given u = W r + q, find r in Coulomb's cone K of every contact so that (u_n + mu |u_t|, u_t)
!> lies in the dual cone and is orthogonal to r (De Saxce & Feng 1991, 1998). Contact a owns
!> components (1, a) normal, (2.., a) tangential; without friction d = 1.
module cone_types
  use base_kinds, only: wp, zero
  implicit none
  private
  integer, parameter, public :: contact_open = 0
  integer, parameter, public :: contact_stick = 1
  integer, parameter, public :: contact_slip = 2
  integer, parameter, public :: most_components = 3
  integer, parameter, public :: most_pivoted = 40     !< contacts of a complementary path
  !> Numbers between this and its inverse are squared and multiplied without care.
  real(wp), parameter, public :: largest_ordinary = 2.0_wp**200
  !> Friction beyond which mu times the round-off of a displacement is no small number.
  real(wp), parameter, public :: large_friction = 1.0e7_wp
  !> Solvers and their names. AUTO: the rule of cone_strategy; GS: sweeps alone; PROX, NEWTON:
  !> these before any sweep; ANDERSON, NESTEROV: accelerated sweeps, steps with momentum alone;
  !> PRODUCTS: products with W alone. A deck may choose among the first four.
  integer, parameter, public :: solver_auto = 1, solver_gs = 2, solver_prox = 3, &
      solver_newton = 4, solver_anderson = 5, solver_nesterov = 6, solver_products = 7
  character(8), parameter, public :: solver_names(7) = [character(8) :: 'AUTO', 'GS', 'PROX', &
      'NEWTON', 'ANDERSON', 'NESTEROV', 'PRODUCTS']
  character(8), parameter, public :: deck_solver_names(4) = solver_names(:solver_newton)
  !> Local solvers: bi-potential projections, exact, Newton.
  integer, parameter, public :: local_bipot = 1, local_exact = 2, local_newton = 3
  character(8), parameter, public :: local_names(3) = [character(8) :: 'BIPOT', 'EXACT', &
      'NEWTON']

  type, public :: cone_options_t
    integer :: solver = solver_auto
    real(wp) :: tolerance = 1.0e-10_wp   !< on error and on eta
    integer :: max_sweeps = 10000
    real(wp) :: rho_factor = 1.0_wp      !< rho = factor / lmax(W_aa)
    integer :: local = local_bipot
    real(wp) :: local_tolerance = 1.0e-2_wp
    integer :: max_local = 50
    logical :: warm_start = .true.
    real(wp) :: deadline = huge(1.0_wp)  !< processor seconds (cpu_time) at which to give up
  end type cone_options_t

  !> Every answer carries it (conventions: error is unit-free, eta the normalised bi-potential
  !> residual).
  type, public :: certificate_t
    real(wp) :: error = zero
    !> |natural map with rho = 1| / |q| (Acary, Bremond & Huber 2018)
    real(wp) :: error2018 = zero
    real(wp) :: eta = zero
    real(wp) :: norm_q = zero      !< |q|, or what of it is round-off [L]
    integer :: sweeps = 0
    integer :: local_iterations = 0
    integer :: active_set_solves = 0        !< direct solves for given statuses
    integer :: newton_steps = 0
    !> Work of the solver on blocks, in products with all of W: a sweep, a step with momentum,
    !> an evaluation of the error is one; a Newton step counts its operations.
    real(wp) :: products = zero
    integer :: worst = 0           !< where it failed: the contact with the largest residual
    integer :: wedged = 0          !< contacts that push with mu |W_nt| > W_nn
    integer :: first_wedged = 0
    integer :: pivotings = 0       !< paths of complementary pivoting
    logical :: met = .true.
  end type certificate_t

  !> Work space of the solver, made once per size, so that nothing is allocated in a step.
  type, public :: cone_work_t
    integer :: contacts = -1
    integer :: d = 0
    real(wp), allocatable :: u(:, :)       !< (d, nc) u = W r + q [L]
    real(wp), allocatable :: rho(:)        !< (nc) [1/flexibility]
    real(wp), allocatable :: trial(:, :), trial_u(:, :)   !< (d, nc) of an active set
    integer, allocatable :: status(:), tried(:)
    ! Of the direct solve for an active set, made where one is tried.
    real(wp), allocatable :: matrix(:, :), rhs(:, :)
    integer, allocatable :: pivot(:), unknown(:, :)
  end type cone_work_t

  public :: size_cone_work, size_active_set, find_solver, local_solver, late

contains

  !> The number of a solver by its name; 0 = no such.
  pure integer function find_solver(name)
    character(*), intent(in) :: name
    find_solver = number_of(name, solver_names)
  end function find_solver

  !> The number of a local solver by its name; 0 = no such.
  pure integer function local_solver(name)
    character(*), intent(in) :: name
    local_solver = number_of(name, local_names)
  end function local_solver

  pure integer function number_of(name, names)
    character(*), intent(in) :: name, names(:)
    do number_of = size(names), 1, -1
      if (name == names(number_of)) return
    end do
  end function number_of

  !> Makes the work space for nc contacts of d components; does nothing when it fits already.
  pure subroutine size_cone_work(work, d, contacts)
    type(cone_work_t), intent(inout) :: work
    integer, intent(in) :: d
    integer, intent(in) :: contacts
    if (work%contacts == contacts .and. work%d == d) return
    if (allocated(work%u)) &
        deallocate (work%u, work%rho, work%trial, work%trial_u, work%status, work%tried)
    if (allocated(work%matrix)) deallocate (work%matrix, work%rhs, work%pivot, work%unknown)
    allocate (work%u(d, contacts), work%rho(contacts), work%trial(d, contacts))
    allocate (work%trial_u(d, contacts), work%status(contacts), work%tried(contacts))
    work%contacts = contacts
    work%d = d
  end subroutine size_cone_work

  !> Space for a direct solve of all unknowns, once.
  pure subroutine size_active_set(work)
    type(cone_work_t), intent(inout) :: work
    integer :: n
    if (allocated(work%matrix)) return
    n = work%d*work%contacts
    allocate (work%matrix(n, n), work%rhs(n, 1), work%pivot(n), work%unknown(2, n))
  end subroutine size_active_set

  !> Is the time that was given over?
  logical function late(options)
    type(cone_options_t), intent(in) :: options
    real(wp) :: now
    late = .false.
    if (options%deadline >= huge(now)) return
    call cpu_time(now)
    late = now > options%deadline
  end function late

end module cone_types
