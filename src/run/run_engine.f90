! SPDX-License-Identifier: BSD-3-Clause
!> The linear solver of a run: which nodes come last in the elimination, and which engine takes
!> least time where the deck leaves it open, by counts alone.
module run_engine
  use base_kinds, only: wp, i8, zero, one, two
  use base_status, only: status_t, failed
  use linalg_order, only: choose_order
  use linalg_registry, only: make_solver
  use linalg_solver, only: solver_options_t, gigaflops
  use linalg_symbolic, only: factor_entries
  use run_data, only: run_t
  use run_forecast, only: count_passes
  implicit none
  private
  public :: analyse_matrix, kept_nodes

contains

  !> Order and storage of the factor, of the engine that the deck or AUTO takes.
  subroutine analyse_matrix(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    if (run%solver_options%engine == 'AUTO' .and. run%solver%info%engine == 'LDLT' .and. &
        .not. associated(run%team)) call choose_engine(run, status)
    if (failed(status)) return
    call run%solver%analyse(run%system%graph, size(run%b, 1), kept_nodes(run), status)
  end subroutine analyse_matrix

  !> LDLT or, where the work is that of a large body, dense panels where they take less time,
  !> and no factor where it would be a new one in each step and takes more; neither knows null
  !> pivots.
  subroutine choose_engine(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    !> [Gflop] of a factor that is worth a choice: made once, made in each step in space.
    real(wp), parameter :: much_work = 0.1_wp, some_work = 0.03_wp
    type(solver_options_t) :: options
    character(:), allocatable :: name
    integer, allocatable :: order(:)
    integer(i8) :: multiplications
    real(wp) :: work, bytes
    integer :: d
    options = run%solver_options
    if (options%null_pivot > zero) return
    d = run%system%dim
    associate (graph => run%system%graph, last => kept_nodes(run))
      call choose_order(graph, last, trim(options%order), order, name, multiplications, status)
      if (failed(status)) return
      work = gigaflops(d, multiplications)
      if (work >= merge(some_work, much_work, d == 3 .and. allocated(run%newton))) then
        bytes = 8.0_wp*d**2*real(factor_entries(graph, order, graph%n - size(last)), wp)
        if (suits_iteration(run, work, bytes, d*size(last))) then
          options%engine = 'CG'
        else if (suits_panels(run, work, bytes)) then
          options%engine = 'SUPERNODAL'
        end if
        if (options%engine /= 'AUTO') call make_solver(options, run%solver, status)
      end if
      call run%solver%take_order(order, name, multiplications)
    end associate
  end subroutine choose_engine

  !> Do dense panels save more in the factors of the run than they lose in its solves? In the
  !> plane, where panels are small, a factor takes .14 s less for each Gflop and a solve .016 ms
  !> more for each MB of the factor; in space both take less (doc/performance.md). work [Gflop]
  !> and bytes are those of a factor.
  logical function suits_panels(run, work, bytes)
    type(run_t), intent(in) :: run
    real(wp), intent(in) :: work, bytes
    real(wp), parameter :: saved = 0.14_wp, lost = 1.6e-11_wp     ! [s] of a Gflop, of a byte
    real(wp) :: factors, passes, steps
    suits_panels = run%system%dim == 3
    if (suits_panels) return
    call count_passes(run, factors, passes)
    steps = real(max(1, run%plan%full_steps), wp)    ! also of a run that was restarted
    suits_panels = max(one, steps*factors)*saved*work > steps*passes*lost*bytes
  end function suits_panels

  !> Is a factor in each step dearer than conjugate gradients with a solve for each contact dof?
  !> Where the mass makes a good part of the diagonal (steps of three crossing times of an
  !> element or less) these take about 4/sqrt(share) iterations, whatever the mesh. Rates in
  !> Gflop/s are those of one core (bench/refactoring.py): of a factor in panels, of its solve,
  !> of an iteration. work [Gflop] and bytes are those of a factor.
  logical function suits_iteration(run, work, bytes, contact_dofs)
    type(run_t), intent(in) :: run
    real(wp), intent(in) :: work, bytes
    integer, intent(in) :: contact_dofs
    real(wp), parameter :: rate_factor = 12.0_wp, rate_solve = 2.0_wp, rate_iteration = 1.4_wp
    real(wp), parameter :: least_share = 0.05_wp, passes = 5.0_wp, clear = 0.9_wp
    real(wp) :: direct, each, share, solves
    suits_iteration = .false.
    if (.not. allocated(run%newton) .or. run%step%is_static .or. allocated(run%shift) .or. &
        .not. allocated(run%matrix%value)) return
    share = mass_share(run)
    if (share < least_share) return
    direct = work/rate_factor + passes*0.5e-9_wp*bytes/rate_solve
    each = 4.0_wp/sqrt(share)*8.0e-9_wp*run%system%dim**2*size(run%system%graph%column) &
        /rate_iteration
    solves = merge(two*passes + contact_dofs, passes, contact_dofs > 0)
    suits_iteration = solves*each < clear*direct
  end function suits_iteration

  !> The least share that the mass has of a diagonal entry of the matrix; 1 where dofs are held.
  real(wp) function mass_share(run)
    type(run_t), intent(in) :: run
    integer :: i, c, at
    mass_share = one
    associate (g => run%system%graph, c_m => run%scheme%stage(1)%c_m)
      do i = 1, run%system%n
        at = g%position(i, i)
        do c = 1, run%system%dim
          if (run%model%fixed(c, i)) cycle
          mass_share = min(mass_share, c_m*run%system%mass(at)/run%matrix%value(c, c, at))
        end do
      end do
    end associate
  end function mass_share

  !> The nodes that come last in the elimination.
  pure function kept_nodes(run) result(list)
    type(run_t), intent(in) :: run
    integer, allocatable :: list(:)
    if (allocated(run%contact%local)) then
      list = [integer ::]
    else if (allocated(run%rigid)) then
      list = run%rigid%solver_node
    else
      list = run%contact%interface_node
    end if
  end function kept_nodes

end module run_engine
