! SPDX-License-Identifier: BSD-3-Clause
!> The contact solver on blocks: blocks, groups, random problems in the plane and in space.
program test_cone_solver
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, failed
  use base_strings, only: to_text
  use check, only: test_start, test_end, check_true, check_close, check_equal, seed_random
  use cone_blocks, only: delassus_blocks_t, blocks_from_dense, blocks_from_rows, &
      dense_of_blocks, find_components
  use cone_products, only: delassus_products_t, make_products
  use cone_solver, only: solve_cone
  use cone_types, only: cone_options_t, cone_work_t, certificate_t, find_solver, solver_gs
  use linalg_dense, only: largest_eigenvalue
  use random_contacts, only: make_problem
  use structured_contacts, only: structure_t, make_structure, misfit
  implicit none
  real(wp), parameter :: eps = epsilon(one)

  call test_start('cone_solver')
  call seed_random(4711)
  call test_blocks()
  call test_eigenvalue()
  call test_random('AUTO    ', 10.0_wp)
  call test_random('PROX    ', 0.7_wp)
  call test_random('ANDERSON', 0.1_wp)
  call test_random('NESTEROV', 0.1_wp)
  call test_structure('STACK', 2, 30)
  call test_structure('STACK', 3, 100)
  call test_structure('STACK', 2, 1000)
  call test_structure('CHAIN', 2, 300)
  call test_structure('CHAIN', 3, 30)
  call test_structure('CUPS', 2, 200)
  call test_structure('CUPS', 3, 40)
  call test_products()
  call test_groups()
  call test_units()
  call test_failure()
  call test_end()

contains

  !> Dense, by entries (in two halves that add up), and back: the same numbers.
  subroutine test_blocks()
    type(delassus_blocks_t) :: w, other
    real(wp) :: dense(6, 6), again(6, 6), values(72), q(3, 2), r(3, 2), u(3, 2)
    integer :: pointer(7), columns(72), i
    call random_number(dense)
    dense(1:3, 4:6) = zero
    call blocks_from_dense(dense, 3, w)
    call check_equal(size(w%column), 3, 'a block of zeros is left out')
    pointer = [(1 + 12*(i - 1), i=1, 7)]
    columns = [(1 + mod(i - 1, 6), i=1, 72)]
    do i = 1, 6
      values(12*i - 11:12*i) = 0.5_wp*dense(i, columns(12*i - 11:12*i))
    end do
    call blocks_from_rows(3, pointer, columns, values, other)
    call dense_of_blocks(other, again)
    call check_true(.not. any(abs(again - dense) > zero), 'entries of one place add up')
    call random_number(q)
    call random_number(r)
    call w%displacements(q, r, u)
    call check_close(maxval(abs(reshape(u - q, [6]) - matmul(dense, reshape(r, [6])))), zero, &
        8.0_wp*eps, 'W r + q')
  end subroutine test_blocks

  !> lambda is an eigenvalue (the determinant vanishes) and no other is larger (Rayleigh).
  subroutine test_eigenvalue()
    real(wp) :: b(3, 3), a(3, 3), c(3, 3), x(3), lambda, determinant
    integer :: k, i, wrong
    wrong = 0
    do k = 1, 1000
      call random_number(b)
      a = matmul(b, transpose(b))
      lambda = largest_eigenvalue(a)
      c = a
      do i = 1, 3
        c(i, i) = c(i, i) - lambda
      end do
      determinant = c(1, 1)*(c(2, 2)*c(3, 3) - c(2, 3)**2) &
          - c(1, 2)*(c(1, 2)*c(3, 3) - c(2, 3)*c(1, 3)) &
          + c(1, 3)*(c(1, 2)*c(2, 3) - c(2, 2)*c(1, 3))
      if (abs(determinant) > 256.0_wp*eps*lambda**3) wrong = wrong + 1
      call random_number(x)
      if (dot_product(x, matmul(a, x)) > lambda*dot_product(x, x)*(one + 64.0_wp*eps)) &
          wrong = wrong + 1
    end do
    call check_equal(wrong, 0, 'largest eigenvalue of 3 x 3')
  end subroutine test_eigenvalue

  !> Problems that have a solution, up to a friction, condition 1 to 1e12, redundancy 1 to 5:
  !> each is solved to 1e-8, in its cones, nothing penetrates by more than the certificate's
  !> own bound.
  subroutine test_random(solver, most_mu)
    character(8), intent(in) :: solver
    real(wp), intent(in) :: most_mu
    real(wp), parameter :: frictions(4) = [0.0_wp, 0.1_wp, 0.7_wp, 10.0_wp]
    type(cone_options_t) :: options
    integer :: d, n, k, e, unsolved, wrong
    options%solver = find_solver(solver)
    options%tolerance = 1.0e-8_wp
    unsolved = 0
    wrong = 0
    do d = 2, 3
      do n = 1, 12
        do k = 1, 4
          if (frictions(k) > most_mu) cycle
          do e = 0, 2
            call solve_one(options, d, n, 10.0_wp**(4*e), one + 2.0_wp*e, frictions(k), &
                unsolved, wrong)
          end do
        end do
      end do
    end do
    call check_equal(wrong, 0, trim(solver)//': cones, gaps, statuses')
    ! Sweeps alone may end without an answer, and then say so.
    if (solver /= 'ANDERSON' .and. solver /= 'NESTEROV') &
        call check_equal(unsolved, 0, trim(solver)//': all certified')
  end subroutine test_random

  subroutine solve_one(options, d, n, condition, redundancy, mu_1, unsolved, wrong)
    type(cone_options_t), intent(in) :: options
    integer, intent(in) :: d, n
    real(wp), intent(in) :: condition, redundancy, mu_1
    integer, intent(inout) :: unsolved, wrong
    type(delassus_blocks_t) :: w
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: q(d, n), mu(n), r(d, n), slack
    integer :: a
    mu = mu_1
    call make_problem(d, n, condition, redundancy, mu_1, w, q)
    r = zero
    call solve_cone(options, w, q, mu, r, work, certificate, status)
    if (failed(status)) unsolved = unsolved + 1
    if (failed(status) .eqv. certificate%met) wrong = wrong + 1   ! a miss has its status
    slack = 1.0e-7_wp*max(norm2(q), norm2(work%u))*(one + mu_1)
    do a = 1, n
      if (norm2(r(2:, a)) > (one + 16.0_wp*eps)*mu_1*r(1, a) + 1.0e-8_wp*norm2(r)) &
          wrong = wrong + 1
      if (certificate%met .and. work%u(1, a) < -slack) wrong = wrong + 1
    end do
  end subroutine solve_one

  !> What is known of stacks, chains and cups. Only one contact closes on its own: the news
  !> must pass the whole structure. The condition of W grows with n^2, and so does what the
  !> certificate leaves of the reactions.
  subroutine test_structure(kind, d, n)
    character(*), intent(in) :: kind
    integer, intent(in) :: d, n
    type(structure_t) :: s
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: r(d, n)
    call make_structure(kind, d, n, s)
    r = zero
    options%max_sweeps = 100000
    call solve_cone(options, s%w, s%q, s%mu, r, work, certificate, status)
    call check_true(certificate%met, kind//' of '//to_text(n)//' is solved')
    call check_close(misfit(s, r), zero, n**2*options%tolerance, kind//': what is known')
  end subroutine test_structure

  !> By products with W alone: the answer of the other methods, to the two certificates, where W
  !> is well conditioned and the answer one.
  subroutine test_products()
    type(delassus_blocks_t), target :: blocks
    type(delassus_products_t) :: w
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: q(3, 20), mu(20), r(3, 20), other(3, 20)
    mu = 0.3_wp
    call make_problem(3, 20, 10.0_wp, one, 0.3_wp, blocks, q)
    call make_products(blocks, blocks%block(:, :, blocks%diagonal), w)
    r = zero
    other = zero
    call solve_cone(options, blocks, q, mu, r, work, certificate, status)
    call solve_cone(options, w, q, mu, other, work, certificate, status)
    call check_true(.not. failed(status) .and. certificate%met, 'by products: certified')
    call check_close(norm2(r - other), zero, 1.0e-7_wp*norm2(r), 'by products: the same')
    options%max_sweeps = 10
    options%warm_start = .false.
    call solve_cone(options, w, q, mu, other, work, certificate, status)
    call check_true(failed(status) .and. certificate%worst > 0, 'by products: a miss is told')
  end subroutine test_products

  !> Two problems in one, their contacts mixed: two groups, and the reactions of each alone.
  subroutine test_groups()
    type(cone_options_t) :: options
    type(delassus_blocks_t) :: w(2), both
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: q(3, 8), dense(24, 24), part(12, 12), mu(8), r(3, 8), alone(3, 4)
    integer, allocatable :: first(:), member(:)
    integer :: k, i, rows(12)
    dense = zero
    mu = 0.3_wp
    do k = 1, 2
      call make_problem(3, 4, 10.0_wp, one, 0.3_wp, w(k), q(:, k::2))
      call dense_of_blocks(w(k), part)
      do i = 1, 4
        rows(3*i - 2:3*i) = 6*(i - 1) + 3*(k - 1) + [1, 2, 3]
      end do
      dense(rows, rows) = part
    end do
    call blocks_from_dense(dense, 3, both)
    r = zero
    call find_components(both, first, member)
    call check_equal(size(first) - 1, 2, 'two groups')
    call solve_cone(options, both, q, mu, r, work, certificate, status)
    call check_true(certificate%met, 'both are solved')
    do k = 1, 2
      alone = zero
      call solve_cone(options, w(k), q(:, k::2), mu(:4), alone, work, &
          certificate, status)
      ! A unique solution, W of condition 10: both lie within 1e-10 times that of it.
      call check_close(norm2(alone - r(:, k::2)), zero, 1.0e-7_wp*norm2(alone), 'each alone')
    end do
  end subroutine test_groups

  !> Units by powers of two change no digit.
  subroutine test_units()
    type(cone_options_t) :: options
    type(delassus_blocks_t) :: w
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: q(3, 6), mu(6), r(3, 6), other(3, 6)
    mu = 0.5_wp
    call make_problem(3, 6, 1.0e4_wp, one, 0.5_wp, w, q)
    r = zero
    call solve_cone(options, w, q, mu, r, work, certificate, status)
    w%block = w%block*2.0_wp**40
    other = zero
    call solve_cone(options, w, q*2.0_wp**(-30), mu, other, work, certificate, status)
    call check_true(.not. any(abs(other*2.0_wp**70 - r) > zero), 'units change no digit')
  end subroutine test_units

  !> One sweep is not enough: a named failure with the error that was reached.
  subroutine test_failure()
    type(cone_options_t) :: options
    type(delassus_blocks_t) :: w
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: q(3, 6), mu(6), r(3, 6)
    mu = 0.5_wp
    call make_problem(3, 6, 1.0e4_wp, one, 0.5_wp, w, q)
    options%solver = solver_gs
    options%max_sweeps = 1
    options%tolerance = 1.0e-14_wp
    r = zero
    call solve_cone(options, w, q, mu, r, work, certificate, status)
    call check_true(failed(status) .and. .not. certificate%met, 'a failure has its status')
    call check_true(certificate%error > options%tolerance, 'and its error')
  end subroutine test_failure

end program test_cone_solver
