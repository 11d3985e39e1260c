! SPDX-License-Identifier: BSD-3-Clause
!> Projected steps for all contacts at once, with Nesterov's momentum: W is needed for its
!> products alone. Without friction these are the steps of accelerated projected gradients
!> (Nesterov 1983; Mazhar, Heyn, Negrut & Tasora 2015); here each has the bi-potential's
!> predictor, so that the law and not its associated relative is solved.
module cone_gradient
  use base_kinds, only: wp, zero, one, half
  use cone_delassus, only: delassus_t, operator_t
  use cone_local, only: predict_and_correct
  use cone_types, only: most_components
  use cone_sweep, only: find_rho
  implicit none
  private
  public :: start_gradient, restart_gradient, gradient_step

  type, public :: gradient_t
    real(wp), allocatable, dimension(:, :) :: u, before, point  !< (d, nc)
    real(wp), allocatable :: rho(:)        !< (nc) [F/L]
    real(wp) :: weight = one               !< t_k of Nesterov
    logical :: made = .false.
  end type gradient_t

  !> Iterations for the largest eigenvalue, and the factor for what they have not found.
  integer, parameter :: powers = 20
  real(wp), parameter :: caution = 1.1_wp

contains

  !> Space and rho = factor / lmax(W_aa), over the largest eigenvalue of diag(rho) W, for w
  !> [L/F].
  subroutine start_gradient(w, factor, g)
    class(delassus_t), intent(in) :: w
    real(wp), intent(in) :: factor
    type(gradient_t), intent(inout) :: g
    real(wp) :: length
    integer :: a, d, nc, k
    d = w%d
    nc = w%contacts
    allocate (g%u(d, nc), g%before(d, nc), g%point(d, nc), g%rho(nc))
    call find_rho(w, one, g%rho)
    do a = 1, nc
      do k = 1, d
        g%point(k, a) = one + real(modulo(7*a + 3*k, 11), wp)/11.0_wp
      end do
    end do
    length = one
    do k = 1, powers
      g%point = g%point/sqrt(sum(g%point**2))
      call w%apply(g%point, g%u)
      do a = 1, nc
        g%point(:, a) = g%rho(a)*g%u(:, a)
      end do
      length = sqrt(sum(g%point**2))
    end do
    g%rho = g%rho*factor/max(one, caution*length)
    g%made = .true.
  end subroutine start_gradient

  !> From r on, without momentum.
  subroutine restart_gradient(r, g)
    real(wp), intent(in) :: r(:, :)
    type(gradient_t), intent(inout) :: g
    g%weight = one
    g%before = r
    g%point = r
  end subroutine restart_gradient

  !> r (d, nc) = the projected step from the point ahead, and the next point ahead. The momentum
  !> starts anew where it points against the step (O'Donoghue & Candes 2015).
  subroutine gradient_step(w, q, mu, r, g)
    class(operator_t), intent(in) :: w
    real(wp), intent(in) :: q(:, :), mu(:)
    real(wp), intent(inout), contiguous :: r(:, :)
    type(gradient_t), intent(inout) :: g
    real(wp) :: tau(most_components), weight, against
    integer :: a, d, status
    d = size(r, 1)
    call w%apply(g%point, g%u)
    against = zero
    do a = 1, size(mu)
      g%u(:, a) = g%u(:, a) + q(:, a)
      call predict_and_correct(d, mu(a), g%rho(a), g%point(:, a), g%u(:, a), tau, r(:, a), &
          status)
      against = against + dot_product(g%point(:, a) - r(:, a), r(:, a) - g%before(:, a))
    end do
    if (against > zero) g%weight = one
    weight = half*(one + sqrt(one + 4.0_wp*g%weight**2))
    g%point = r + ((g%weight - one)/weight)*(r - g%before)
    g%before = r
    g%weight = weight
  end subroutine gradient_step

end module cone_gradient
