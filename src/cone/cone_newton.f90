! SPDX-License-Identifier: BSD-3-Clause
!> Global Newton method on the natural map, with an outer proximal loop where W has not full
!> rank. Unknowns are scaled: mean diagonal of W 1, largest |q| 1.
module cone_newton
  use base_kinds, only: wp, zero, one, half
  use cone_local, only: project_on_cone, tangent_length
  use cone_types, only: contact_open, contact_stick
  use linalg_dense, only: solve_general
  implicit none
  private
  public :: newton_work_t, size_newton, newton_solve

  type :: newton_work_t
    real(wp), allocatable :: matrix(:, :), step(:, :), map(:, :), u(:, :), trial(:, :)
    real(wp), allocatable :: part(:, :, :)    !< (d, d, nc) derivative of the projection
    real(wp), allocatable :: right(:, :)
    integer, allocatable :: pivot(:), active(:), moving(:)
    logical, allocatable :: is_open(:)
  end type newton_work_t

contains

  !> Space for that many contacts of d components.
  pure subroutine size_newton(work, d, contacts)
    type(newton_work_t), intent(inout) :: work
    integer, intent(in) :: d, contacts
    integer :: n
    n = d*contacts
    allocate (work%matrix(n, n), work%step(n, 1), work%map(d, contacts), work%u(d, contacts))
    allocate (work%trial(d, contacts), work%part(d, d, contacts), work%pivot(n))
    allocate (work%right(n, 1), work%active(contacts), work%moving(contacts))
    allocate (work%is_open(contacts))
  end subroutine size_newton

  !> Newton steps with line search for r = P_K(r - rho (u_n + mu |u_t|, u_t)), u = w r + q +
  !> alpha (r - r_0), until |map| <= goal or the line search finds no way down; the best r is
  !> kept. w (d nc, d nc), rho (nc), all scaled.
  subroutine newton_solve(w, q, mu, rho, alpha, goal, most, r, work, norm, steps)
    real(wp), intent(in) :: w(:, :)
    real(wp), intent(in) :: q(:, :)
    real(wp), intent(in) :: mu(:), rho(:)
    real(wp), intent(in) :: alpha, goal
    integer, intent(in) :: most
    real(wp), intent(inout) :: r(:, :)
    type(newton_work_t), intent(inout) :: work
    real(wp), intent(out) :: norm
    integer, intent(out) :: steps
    real(wp) :: r_0(size(r, 1), size(r, 2)), length, trial_norm
    logical :: ok
    integer :: k
    r_0 = r
    call natural_map(w, q, mu, rho, alpha, r_0, r, work%u, work%map, work%part)
    norm = sqrt(sum(work%map**2))
    do steps = 1, most
      if (norm <= goal) return
      call find_step(w, mu, rho, alpha, work, ok)
      if (.not. ok) return
      length = one
      do k = 1, 12
        work%trial = r + length*reshape(work%step, shape(r))
        call natural_map(w, q, mu, rho, alpha, r_0, work%trial, work%u, work%map, work%part)
        trial_norm = sqrt(sum(work%map**2))
        if (trial_norm <= (one - 1.0e-2_wp*length)*norm) exit
        length = half*length
      end do
      if (.not. trial_norm < norm) return
      r = work%trial
      norm = trial_norm
    end do
  end subroutine newton_solve

  !> map = r - P_K(tau), u, and the derivative of P_K for each contact.
  subroutine natural_map(w, q, mu, rho, alpha, r_0, r, u, map, part)
    real(wp), intent(in) :: w(:, :), q(:, :), mu(:), rho(:), alpha, r_0(:, :), r(:, :)
    real(wp), intent(out) :: u(:, :), map(:, :), part(:, :, :)
    real(wp) :: tau(size(r, 1)), projected(size(r, 1))
    integer :: a, status
    u = reshape(matmul(w, reshape(r, [size(r)])), shape(r)) + q
    u = u + alpha*(r - r_0)
    do a = 1, size(mu)
      tau = r(:, a) - rho(a)*u(:, a)
      tau(1) = tau(1) - rho(a)*mu(a)*tangent_length(u(:, a))
      call project_on_cone(mu(a), tau, projected, status)
      map(:, a) = r(:, a) - projected
      call derivative(mu(a), tau, projected, status, part(:, :, a))
    end do
  end subroutine natural_map

  !> dP/dtau: zero, the identity, or on the slip side that of the cone (Joli & Feng 2008).
  pure subroutine derivative(mu, tau, projected, status, part)
    real(wp), intent(in) :: mu, tau(:), projected(:)
    integer, intent(in) :: status
    real(wp), intent(out) :: part(:, :)
    real(wp) :: length, t(size(tau)), share
    integer :: i
    part = zero
    if (status == contact_open) return
    if (status == contact_stick) then
      do i = 1, size(tau)
        part(i, i) = one
      end do
      return
    end if
    length = tangent_length(tau)
    t = tau/length
    t(1) = zero
    share = one/(one + mu**2)
    part(1, 1) = share
    part(1, 2:) = mu*share*t(2:)
    part(2:, 1) = mu*share*t(2:)
    do i = 2, size(tau)
      part(2:, i) = mu**2*share*t(2:)*t(i) - mu*projected(1)/length*t(2:)*t(i)
      part(i, i) = part(i, i) + mu*projected(1)/length
    end do
  end subroutine derivative

  !> The Newton step: open contacts have theirs at once, -map; the others solve the system
  !> (I - dP (I - rho (W + alpha I + mu e_n t' (W_t + alpha I)))) step = -map among themselves.
  subroutine find_step(w, mu, rho, alpha, work, ok)
    real(wp), intent(in) :: w(:, :), mu(:), rho(:), alpha
    type(newton_work_t), intent(inout) :: work
    logical, intent(out) :: ok
    integer :: a, d, k, n, others
    d = size(work%u, 1)
    call part_contacts(size(mu), work, n, others)
    call fill_system(w, mu, rho, alpha, n, others, work)
    ok = .true.
    if (n > 0) call solve_general(d*n, work%matrix, work%right, work%pivot, ok)
    if (.not. ok) return
    do k = 1, n
      a = work%active(k)
      work%step(d*(a - 1) + 1:d*a, 1) = work%right(d*(k - 1) + 1:d*k, 1)
    end do
  end subroutine find_step

  !> Contacts 1 to contacts into those of the system (active) and the open ones that move.
  subroutine part_contacts(contacts, work, n, others)
    integer, intent(in) :: contacts
    type(newton_work_t), intent(inout) :: work
    integer, intent(out) :: n, others
    integer :: a, d
    d = size(work%u, 1)
    n = 0
    others = 0
    do a = 1, contacts
      work%step(d*(a - 1) + 1:d*a, 1) = -work%map(:, a)
      work%is_open(a) = .not. any(abs(work%part(:, :, a)) > zero)
      if (work%is_open(a) .and. any(abs(work%map(:, a)) > zero)) then
        others = others + 1
        work%moving(others) = a
      end if
      if (work%is_open(a)) cycle
      n = n + 1
      work%active(n) = a
    end do
  end subroutine part_contacts

  !> The system of the active contacts, the steps of the open ones on its right side.
  subroutine fill_system(w, mu, rho, alpha, n, others, work)
    real(wp), intent(in) :: w(:, :), mu(:), rho(:), alpha
    integer, intent(in) :: n, others
    type(newton_work_t), intent(inout) :: work
    real(wp) :: weight(size(work%u, 1), size(work%u, 1)), open_motion(size(work%u, 1))
    integer :: a, b, d, k, j, row, column, first
    d = size(work%u, 1)
    do k = 1, n
      a = work%active(k)
      row = d*(k - 1)
      first = d*(a - 1)
      weight = weight_of(rho(a)*work%part(:, :, a), mu(a), work%u(:, a))
      do j = 1, n
        b = d*(work%active(j) - 1)
        do column = 1, d
          work%matrix(row + 1:row + d, d*(j - 1) + column) = &
              matmul(weight, w(first + 1:first + d, b + column))
        end do
      end do
      work%right(row + 1:row + d, 1) = -work%map(:, a)
      do j = 1, others
        b = d*(work%moving(j) - 1)
        open_motion = matmul(w(first + 1:first + d, b + 1:b + d), work%step(b + 1:b + d, 1))
        work%right(row + 1:row + d, 1) = work%right(row + 1:row + d, 1) &
            - matmul(weight, open_motion)
      end do
      do j = 1, d
        work%matrix(row + 1:row + d, row + j) = work%matrix(row + 1:row + d, row + j) &
            + alpha*weight(:, j) - work%part(:, j, a)
        work%matrix(row + j, row + j) = work%matrix(row + j, row + j) + one
      end do
    end do
  end subroutine fill_system

  !> rho dP (I + mu e_n t'), t the direction of u_t.
  pure function weight_of(scaled_part, mu, u) result(weight)
    real(wp), intent(in) :: scaled_part(:, :), mu, u(:)
    real(wp) :: weight(size(u), size(u)), length
    integer :: j
    weight = scaled_part
    length = tangent_length(u)
    if (.not. length > zero) return
    do j = 2, size(u)
      weight(:, j) = weight(:, j) + weight(:, 1)*mu*u(j)/length
    end do
  end function weight_of

end module cone_newton
