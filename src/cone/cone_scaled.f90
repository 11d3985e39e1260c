! SPDX-License-Identifier: BSD-3-Clause
!> A contact problem without dimension, mean diagonal of W 1 and largest |q| 1, and the sweeps
!> over it: Gauss-Seidel with the bi-potential local solver, plain or accelerated.
module cone_scaled
  use base_kinds, only: wp, zero, one
  use cone_anderson, only: anderson_t, start_anderson, extrapolate
  use cone_blocks, only: delassus_blocks_t
  use cone_certificate, only: evaluate_certificate
  use cone_gradient, only: gradient_t, start_gradient, restart_gradient, gradient_step
  use cone_local, only: project_on_cone
  use cone_newton, only: newton_work_t
  use cone_types, only: cone_options_t, certificate_t, most_components
  use cone_sweep, only: find_rho, sweep_contacts
  implicit none
  private
  public :: scale_problem, sweep_chunk, start_method, evaluate_error, keep_best, misfit_of

  !> Sweeps between two evaluations of the error; pairs that the acceleration keeps.
  integer, parameter, public :: chunk = 10
  integer, parameter :: depth = 8
  !> Blocks of W that are multiplied in the time of a local iteration.
  real(wp), parameter :: local_weight = 4.0_wp
  integer, parameter, public :: plain_sweeps = 1, anderson_sweeps = 2, momentum_steps = 3

  type, public :: scaled_t
    type(delassus_blocks_t) :: w
    real(wp), allocatable :: q(:, :), r(:, :), u(:, :)   !< (d, nc)
    real(wp), allocatable :: mu(:)
    real(wp), allocatable :: rho(:)                      !< 1/lmax(W_aa)
    real(wp) :: change = huge(one)                       !< of r in the last sweep
    integer, allocatable :: status(:)                    !< (nc)
    integer :: method = plain_sweeps
    type(gradient_t) :: gradient
    real(wp), allocatable :: before(:, :)
    type(anderson_t) :: memory
    type(newton_work_t) :: newton
    real(wp), allocatable :: best(:, :)                  !< (d, nc) r of least misfit so far
    real(wp) :: best_misfit = huge(one)
    !> Where the proximal loop goes on: alpha (0 = it has not begun), r, the best misfit then.
    real(wp) :: alpha = zero, travel_misfit = huge(one)
    real(wp), allocatable :: travel(:, :)
    logical :: stands_still = .false.                    !< it did not move, whatever alpha
    !> Of the first step of a Newton on W itself within a budget, over |r|: see cone_newton.
    real(wp) :: longest = huge(one)
  end type scaled_t

contains

  !> Divides W [L/F] by m and q [L] by largest; r [F] accordingly; rho = factor/lmax(W_aa).
  subroutine scale_problem(w, q, mu, r, m, largest, factor, p)
    type(delassus_blocks_t), intent(in) :: w
    real(wp), intent(in) :: q(:, :), mu(:), r(:, :), m, largest, factor
    type(scaled_t), intent(inout) :: p
    p%w = w
    p%w%block = p%w%block/m
    p%q = q/largest
    p%mu = mu
    p%r = r*(m/largest)
    allocate (p%u(size(q, 1), size(q, 2)), p%rho(size(q, 2)), p%status(size(q, 2)))
    call find_rho(p%w, factor, p%rho)
  end subroutine scale_problem

  !> Goes on from r by another method, without memory.
  subroutine start_method(p, method)
    type(scaled_t), intent(inout) :: p
    integer, intent(in) :: method
    p%method = method
    select case (method)
    case (anderson_sweeps)
      call start_anderson(p%memory, size(p%r), depth)
      if (.not. allocated(p%before)) allocate (p%before(size(p%r, 1), size(p%r, 2)))
    case (momentum_steps)
      if (.not. p%gradient%made) call start_gradient(p%w, one, p%gradient)
      call restart_gradient(p%r, p%gradient)
    end select
  end subroutine start_method

  !> What must fall below the tolerance: the larger of error and eta.
  pure real(wp) function misfit_of(certificate)
    type(certificate_t), intent(in) :: certificate
    misfit_of = max(certificate%error, certificate%eta)
  end function misfit_of

  !> Keeps r, of which this is the certificate, where its misfit is the least so far.
  pure subroutine keep_best(p, certificate)
    type(scaled_t), intent(inout) :: p
    type(certificate_t), intent(in) :: certificate
    if (misfit_of(certificate) >= p%best_misfit .and. allocated(p%best)) return
    p%best_misfit = misfit_of(certificate)
    p%best = p%r
  end subroutine keep_best

  !> u and the certificate of r as it is.
  subroutine evaluate_error(p, tolerance, certificate)
    type(scaled_t), intent(inout) :: p
    real(wp), intent(in) :: tolerance
    type(certificate_t), intent(inout) :: certificate
    call p%w%displacements(p%q, p%r, p%u)
    call evaluate_certificate(one, p%mu, p%q, p%r, p%u, tolerance, certificate)
    certificate%products = certificate%products + one
  end subroutine evaluate_error

  !> Some sweeps, the last of them always plain, so that r is in its cones; or steps with
  !> momentum.
  subroutine sweep_chunk(options, p, certificate)
    type(cone_options_t), intent(in) :: options
    type(scaled_t), intent(inout) :: p
    type(certificate_t), intent(inout) :: certificate
    real(wp) :: projected(most_components)
    integer :: k, a, d, status, iterations
    d = size(p%q, 1)
    iterations = 0
    if (p%method == momentum_steps) then
      do k = 1, chunk
        call gradient_step(p%w, p%q, p%mu, p%r, p%gradient)
      end do
      certificate%sweeps = certificate%sweeps + chunk
      certificate%products = certificate%products + chunk
      return
    end if
    do k = 1, chunk
      if (p%method == anderson_sweeps) p%before = p%r
      call sweep_contacts(options, p%w, p%mu, p%rho, p%q, p%r, p%u, p%status, p%change, &
          iterations)
      certificate%sweeps = certificate%sweeps + 1
      certificate%products = certificate%products + one
      if (p%method == plain_sweeps .or. k == chunk) cycle
      call extrapolate(p%memory, size(p%r), p%before, p%r)
      do a = 1, size(p%mu)
        call project_on_cone(p%mu(a), p%r(:, a), projected(:d), status)
        p%r(:, a) = projected(:d)
      end do
    end do
    certificate%local_iterations = certificate%local_iterations + iterations
    certificate%products = certificate%products + local_weight*iterations/size(p%w%column)
  end subroutine sweep_chunk

end module cone_scaled
