! SPDX-License-Identifier: BSD-3-Clause
!> A contact problem without dimension, mean diagonal of W 1 and largest |q| 1, and the sweeps
!> over it: Gauss-Seidel with the bi-potential local solver, plain or accelerated.
module cone_scaled
  use base_kinds, only: wp, zero, one
  use cone_anderson, only: anderson_t, start_anderson, extrapolate
  use cone_blocks, only: flexibility_t, motions
  use cone_certificate, only: certify
  use cone_gradient, only: gradient_t, start_gradient, restart_gradient, gradient_step
  use cone_local, only: project_on_cone
  use cone_newton, only: newton_work_t
  use cone_types, only: cone_options_t, certificate_t, most_components
  use cone_visit, only: visit_contact
  use linalg_dense, only: largest_eigenvalue
  implicit none
  private
  public :: scale_problem, sweep_chunk, change_means, look

  !> Sweeps between two looks at the error; pairs that the acceleration keeps.
  integer, parameter, public :: chunk = 10
  integer, parameter :: depth = 8
  integer, parameter, public :: plain_sweeps = 1, anderson_sweeps = 2, momentum_steps = 3

  type, public :: scaled_t
    type(flexibility_t) :: w
    real(wp), allocatable :: q(:, :), r(:, :), u(:, :)   !< (d, nc)
    real(wp), allocatable :: mu(:)
    real(wp), allocatable :: rho(:)                      !< 1/lmax(W_aa)
    real(wp) :: change = huge(one)                       !< of r in the last sweep
    integer :: means = plain_sweeps
    type(gradient_t) :: gradient
    real(wp), allocatable :: before(:, :)
    type(anderson_t) :: memory
    type(newton_work_t) :: newton
  end type scaled_t

contains

  !> Divides W [L/F] by m and q [L] by largest; r [F] accordingly.
  subroutine scale_problem(flexibility, q, mu, r, m, largest, p)
    type(flexibility_t), intent(in) :: flexibility
    real(wp), intent(in) :: q(:, :), mu(:), r(:, :), m, largest
    type(scaled_t), intent(inout) :: p
    integer :: a
    p%w = flexibility
    p%w%block = p%w%block/m
    p%q = q/largest
    p%mu = mu
    p%r = r*(m/largest)
    allocate (p%u(size(q, 1), size(q, 2)), p%rho(size(q, 2)))
    do a = 1, size(q, 2)
      p%rho(a) = one/largest_eigenvalue(p%w%block(:, :, p%w%diagonal(a)))
    end do
  end subroutine scale_problem

  !> Goes on from r by other means, without memory.
  subroutine change_means(p, means)
    type(scaled_t), intent(inout) :: p
    integer, intent(in) :: means
    p%means = means
    select case (means)
    case (anderson_sweeps)
      call start_anderson(p%memory, size(p%r), depth)
      if (.not. allocated(p%before)) allocate (p%before(size(p%r, 1), size(p%r, 2)))
    case (momentum_steps)
      if (.not. p%gradient%made) &
          call start_gradient(p%w, p%w%block(:, :, p%w%diagonal), one, p%gradient)
      call restart_gradient(p%r, p%gradient)
    end select
  end subroutine change_means

  !> u and the certificate of r as it is.
  subroutine look(p, tolerance, certificate)
    type(scaled_t), intent(inout) :: p
    real(wp), intent(in) :: tolerance
    type(certificate_t), intent(inout) :: certificate
    call motions(p%w, p%q, p%r, p%u)
    call certify(one, p%mu, p%q, p%r, p%u, tolerance, certificate)
  end subroutine look

  !> Some sweeps, the last of them always plain, so that r is in its cones; or steps with
  !> momentum.
  subroutine sweep_chunk(options, p, certificate)
    type(cone_options_t), intent(in) :: options
    type(scaled_t), intent(inout) :: p
    type(certificate_t), intent(inout) :: certificate
    real(wp) :: projected(most_components)
    integer :: k, a, d, status
    d = size(p%q, 1)
    if (p%means == momentum_steps) then
      do k = 1, chunk
        call gradient_step(p%w, p%q, p%mu, p%r, p%gradient)
      end do
      certificate%sweeps = certificate%sweeps + chunk
      return
    end if
    do k = 1, chunk
      if (p%means == anderson_sweeps) p%before = p%r
      call one_sweep(options, p, certificate%local_iterations)
      certificate%sweeps = certificate%sweeps + 1
      if (p%means == plain_sweeps .or. k == chunk) cycle
      call extrapolate(p%memory, size(p%r), p%before, p%r)
      do a = 1, size(p%mu)
        call project_on_cone(p%mu(a), p%r(:, a), projected(:d), status)
        p%r(:, a) = projected(:d)
      end do
    end do
  end subroutine sweep_chunk

  !> Visits every contact once. The local solve is loose: it stops at a share of what a contact
  !> changed in the sweep before.
  subroutine one_sweep(options, p, local_iterations)
    type(cone_options_t), intent(in) :: options
    type(scaled_t), intent(inout) :: p
    integer, intent(inout) :: local_iterations
    real(wp), dimension(most_components) :: u, old
    real(wp) :: enough, sum_change
    integer :: a, k, j, d, iterations, status, most
    d = size(p%q, 1)
    enough = zero
    most = 1
    if (p%change < huge(one)) then
      enough = options%local_tolerance*p%change/size(p%mu)
      most = options%max_local
    end if
    sum_change = zero
    do a = 1, size(p%mu)
      u(:d) = p%q(:, a)
      do k = p%w%first(a), p%w%first(a + 1) - 1
        do j = 1, d
          u(:d) = u(:d) + p%w%block(:, j, k)*p%r(j, p%w%column(k))
        end do
      end do
      old(:d) = p%r(:, a)
      call visit_contact(options, p%w%block(:, :, p%w%diagonal(a)), p%mu(a), p%rho(a), &
          enough, most, p%r(:, a), u(:d), status, iterations)
      local_iterations = local_iterations + iterations
      sum_change = sum_change + sqrt(sum((p%r(:, a) - old(:d))**2))
    end do
    p%change = sum_change
  end subroutine one_sweep

end module cone_scaled
