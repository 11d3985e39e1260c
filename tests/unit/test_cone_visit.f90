! SPDX-License-Identifier: BSD-3-Clause
!> One contact: the exact solver and Newton against the law itself, in the plane and in space.
program test_cone_visit
  use base_kinds, only: wp, zero, one
  use check, only: test_start, test_end, check_true, check_close, check_equal, seed_random
  use cone_exact, only: solve_exact
  use cone_local, only: contact_map
  use cone_types, only: cone_options_t, local_exact, local_newton, contact_open, &
      contact_stick, contact_slip
  use cone_visit, only: visit_contact
  use linalg_dense, only: largest_eigenvalue, solve_small
  implicit none
  real(wp), parameter :: eps = epsilon(one)
  real(wp), parameter :: friction(4) = [0.0_wp, 0.1_wp, 0.7_wp, 1.2_wp]
  integer :: d

  call test_start('cone_visit')
  call seed_random(4711)
  do d = 1, 3
    call test_small(d)
    call test_solver(d, local_exact, 'exact  ')
    call test_solver(d, local_newton, 'Newton ')
  end do
  call test_slip_known()
  call test_wedge()
  call test_no_answer()
  call test_end()

contains

  subroutine fill_random(x)
    real(wp), intent(out) :: x(:)
    call random_number(x)
    x = 2.0_wp*x - one
  end subroutine fill_random

  !> W_aa = I + 0.9 B B' / |B|^2: no mu of the list wedges, the law has one answer.
  subroutine make_w(w)
    real(wp), intent(out) :: w(:, :)
    real(wp) :: b(size(w, 1), size(w, 1))
    integer :: i
    do i = 1, size(w, 1)
      call fill_random(b(:, i))
    end do
    w = 0.9_wp*matmul(b, transpose(b))/sum(b**2)
    do i = 1, size(w, 1)
      w(i, i) = w(i, i) + one
    end do
  end subroutine make_w

  !> Cramer's rule is off by some eps times the condition of a, which is at most 2 here.
  subroutine test_small(d)
    integer, intent(in) :: d
    real(wp) :: a(d, d), b(d), x(d)
    integer :: k, wrong
    logical :: ok
    wrong = 0
    do k = 1, 1000
      call make_w(a)
      call fill_random(b)
      call solve_small(a, b, x, ok)
      if (.not. ok .or. norm2(matmul(a, x) - b) > 64.0_wp*eps*norm2(b)) wrong = wrong + 1
    end do
    call check_equal(wrong, 0, 'small systems')
    a(:, 1) = a(:, d)
    if (d == 1) a = zero
    call solve_small(a, b, x, ok)
    call check_true(.not. ok, 'a singular one is seen')
  end subroutine test_small

  !> From random starts: the law of contact and friction holds to round-off (the natural map
  !> vanishes), u belongs to r, and every status occurs.
  subroutine test_solver(d, local, name)
    integer, intent(in) :: d, local
    character(7), intent(in) :: name
    type(cone_options_t) :: options
    real(wp) :: w(d, d), q(d), r(d), u(d), map(d), part(d, d), mu, off, miss
    integer :: k, status, again, iterations, seen(0:2)
    options%local = local
    seen = 0
    off = zero
    miss = zero
    do k = 1, 4000
      mu = friction(1 + mod(k, 4))
      call make_w(w)
      call fill_random(q)
      call fill_random(r)
      r(1) = abs(r(1))
      u = q + matmul(w, r)
      call visit_contact(options, w, mu, one/largest_eigenvalue(w), 1.0e-15_wp, 200, r, u, &
          status, iterations)
      call contact_map(mu, one, r, u, map, part, again)
      off = max(off, norm2(map))
      miss = max(miss, norm2(u - q - matmul(w, r)))
      seen(status) = seen(status) + 1
    end do
    ! Values of size 1 to 3; bisection ends 60 halvings of a 32nd of the circle: at round-off.
    call check_close(off, zero, 400.0_wp*eps, name//': natural map')
    call check_close(miss, zero, 100.0_wp*eps, name//': u = w r + q')
    call check_true(seen(contact_open) > 0 .and. seen(contact_stick) > 0 .and. &
        (d == 1 .or. seen(contact_slip) > 0), name//': every status')
  end subroutine test_solver

  !> W = I: with q = (-1, 3 e), mu = 1/2, r_n = 1 and r_t = -e/2.
  subroutine test_slip_known()
    real(wp) :: w(3, 3), q(3), r(3), u(3)
    integer :: status
    logical :: found
    w = zero
    w(1, 1) = one
    w(2, 2) = one
    w(3, 3) = one
    q = [-one, 1.8_wp, 2.4_wp]
    r = zero
    u = q
    call solve_exact(w, 0.5_wp, r, u, status, found)
    call check_true(found .and. status == contact_slip, 'known slip: found')
    call check_close(norm2(r - [one, -0.3_wp, -0.4_wp]), zero, 16.0_wp*eps, 'known slip: r')
    call check_close(norm2(u - [zero, 1.5_wp, 2.0_wp]), zero, 16.0_wp*eps, 'known slip: u')
  end subroutine test_slip_known

  !> A contact that wedges has an open and a closed answer; the one nearest to the start is
  !> taken.
  subroutine test_wedge()
    real(wp) :: w(2, 2), r(2), u(2), q(2)
    integer :: status
    logical :: found
    w = reshape([one, 0.9_wp, 0.9_wp, one], [2, 2])
    q = [0.1_wp, one]
    r = zero
    u = q
    call solve_exact(w, 5.0_wp, r, u, status, found)
    call check_true(found .and. status == contact_open, 'wedging: open from zero')
    r = [5.0_wp, -5.0_wp]
    u = q + matmul(w, r)
    call solve_exact(w, 5.0_wp, r, u, status, found)
    call check_true(found .and. status == contact_stick, 'wedging: closed from there')
    call check_close(norm2(u), zero, 32.0_wp*eps*norm2(r), 'wedging: it sticks')
  end subroutine test_wedge

  !> No law holds for W_aa = 0 and q_n < 0; exact says so, the visit does not invent numbers.
  subroutine test_no_answer()
    real(wp) :: w(2, 2), r(2), u(2)
    integer :: status
    logical :: found
    w = zero
    r = zero
    u = [-one, zero]
    call solve_exact(w, 0.5_wp, r, u, status, found)
    call check_true(.not. found, 'no answer is told')
    call check_true(.not. any(abs(r) > zero), 'and changes nothing')
  end subroutine test_no_answer

end program test_cone_visit
