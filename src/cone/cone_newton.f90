! SPDX-License-Identifier: BSD-3-Clause
!> Global Newton method on the natural map, with an outer proximal loop where W has not full
!> rank. Unknowns are scaled: mean diagonal of W 1, largest |q| 1.
module cone_newton
  use base_kinds, only: wp, zero, one, half
  use cone_local, only: contact_map, tangent_length
  use cone_types, only: most_components
  use linalg_dense, only: solve_general
  implicit none
  private
  public :: newton_work_t, size_newton, newton_solve

  type :: newton_work_t
    real(wp), allocatable :: matrix(:, :), step(:, :), map(:, :), u(:, :), trial(:, :)
    real(wp), allocatable :: start(:, :)      !< centre of the proximal term
    real(wp), allocatable :: motion(:)        !< (d)
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
    allocate (work%start(d, contacts), work%motion(d))
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
    real(wp) :: length, trial_norm
    logical :: ok
    integer :: a, d, k
    d = size(r, 1)
    work%start = r
    call natural_map(w, q, mu, rho, alpha, r, work)
    norm = sqrt(sum(work%map**2))
    do steps = 1, most
      if (norm <= goal) return
      call find_step(w, mu, rho, alpha, work, ok)
      if (.not. ok) return
      length = one
      do k = 1, 12
        do a = 1, size(mu)
          work%trial(:, a) = r(:, a) + length*work%step(d*(a - 1) + 1:d*a, 1)
        end do
        call natural_map(w, q, mu, rho, alpha, work%trial, work)
        trial_norm = sqrt(sum(work%map**2))
        if (trial_norm <= (one - 1.0e-2_wp*length)*norm) exit
        length = half*length
      end do
      if (.not. trial_norm < norm) return
      r = work%trial
      norm = trial_norm
    end do
  end subroutine newton_solve

  !> u, map = r - P_K(tau), and the derivative of P_K for each contact, at r (d, nc).
  pure subroutine natural_map(w, q, mu, rho, alpha, r, work)
    real(wp), intent(in) :: w(:, :), q(:, :), mu(:), rho(:), alpha, r(:, :)
    type(newton_work_t), intent(inout) :: work
    integer :: a, d, status
    d = size(r, 1)
    work%u = q + alpha*(r - work%start)
    call add_product(size(q), w, r, work%u)
    do a = 1, size(mu)
      call contact_map(mu(a), rho(a), r(:, a), work%u(:, a), work%map(:, a), &
          work%part(:, :, a), status)
    end do
  end subroutine natural_map

  !> u = u + w r, both as one column.
  pure subroutine add_product(n, w, r, u)
    integer, intent(in) :: n
    real(wp), intent(in) :: w(:, :), r(n)
    real(wp), intent(inout) :: u(n)
    integer :: j
    do j = 1, n
      if (abs(r(j)) > zero) u = u + r(j)*w(:, j)
    end do
  end subroutine add_product

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
    real(wp), dimension(most_components, most_components) :: weight
    integer :: a, d, k, i, j, row, column, first
    d = size(work%u, 1)
    do k = 1, n
      a = work%active(k)
      row = d*(k - 1)
      first = d*(a - 1)
      call find_weight(rho(a), work%part(:, :, a), mu(a), work%u(:, a), weight(:d, :d))
      do j = 1, n
        do column = 1, d
          call multiply(weight(:d, :d), w(first + 1:first + d, d*(work%active(j) - 1) + &
              column), work%matrix(row + 1:row + d, d*(j - 1) + column))
        end do
      end do
      call open_motion(w, first, others, work)
      call multiply(weight(:d, :d), work%motion, work%right(row + 1:row + d, 1))
      work%right(row + 1:row + d, 1) = -work%map(:, a) - work%right(row + 1:row + d, 1)
      do j = 1, d
        do i = 1, d
          work%matrix(row + i, row + j) = work%matrix(row + i, row + j) &
              + alpha*weight(i, j) - work%part(i, j, a)
        end do
        work%matrix(row + j, row + j) = work%matrix(row + j, row + j) + one
      end do
    end do
  end subroutine fill_system

  !> What the steps of the open contacts move the contact of rows first + 1 on.
  pure subroutine open_motion(w, first, others, work)
    real(wp), intent(in) :: w(:, :)
    integer, intent(in) :: first, others
    type(newton_work_t), intent(inout) :: work
    integer :: b, d, i, j
    d = size(work%u, 1)
    work%motion = zero
    do j = 1, others
      b = d*(work%moving(j) - 1)
      do i = 1, d
        work%motion = work%motion + w(first + 1:first + d, b + i)*work%step(b + i, 1)
      end do
    end do
  end subroutine open_motion

  !> y = a x.
  pure subroutine multiply(a, x, y)
    real(wp), intent(in) :: a(:, :), x(:)
    real(wp), intent(out) :: y(:)
    integer :: j
    y = zero
    do j = 1, size(x)
      y = y + a(:, j)*x(j)
    end do
  end subroutine multiply

  !> weight = rho dP (I + mu e_n t'), t the direction of u_t.
  pure subroutine find_weight(rho, part, mu, u, weight)
    real(wp), intent(in) :: rho, part(:, :), mu, u(:)
    real(wp), intent(out) :: weight(:, :)
    real(wp) :: length
    integer :: j
    weight = rho*part
    length = tangent_length(u)
    if (.not. length > zero) return
    do j = 2, size(u)
      weight(:, j) = weight(:, j) + weight(:, 1)*mu*u(j)/length
    end do
  end subroutine find_weight

end module cone_newton
