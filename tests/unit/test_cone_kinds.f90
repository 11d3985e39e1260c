! SPDX-License-Identifier: BSD-3-Clause
!> One entry, three kinds of W: the same problems as a matrix, as blocks and by products, of
!> one, two and three components; any friction, any unit.
program test_cone_kinds
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, failed
  use base_strings, only: to_text
  use check, only: test_start, test_end, check_true, check_close, check_equal, seed_random
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use cone_blocks, only: delassus_blocks_t, blocks_from_dense, dense_of_blocks
  use cone_certificate, only: certify
  use cone_dense, only: delassus_dense_t
  use cone_products, only: delassus_products_t, make_products
  use cone_solver, only: solve_cone
  use cone_types, only: cone_options_t, cone_work_t, certificate_t, contact_open, &
      contact_stick, contact_slip
  use contact_law, only: law_misses
  use random_contacts, only: make_problem
  implicit none
  integer, parameter :: dense = 1, blocks = 2, products = 3
  character(8), parameter :: names(3) = [character(8) :: 'dense', 'blocks', 'products']
  real(wp), parameter :: eps = epsilon(one)
  integer :: d, kind

  call test_start('cone_kinds')
  do kind = dense, products
    do d = 1, 3
      call seed_random(4711)
      call test_random(d, kind)
      call test_known(d, kind)
      call test_units(d, kind)
      call test_extremes(d, kind)
    end do
    do d = 2, 3
      call test_large_friction(d, kind, 1)
      call test_large_friction(d, kind, 2)
      call test_blind(d, kind)
    end do
    call test_not_finite(kind)
  end do
  call test_same()
  call test_certificate_units()
  call test_end()

contains

  !> W (d nc, d nc) as one of the kinds.
  subroutine solve(kind, options, matrix, q, mu, r, work, certificate, status)
    integer, intent(in) :: kind
    type(cone_options_t), intent(in) :: options
    real(wp), intent(in) :: matrix(:, :), q(:, :), mu(:)
    real(wp), intent(inout) :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(out) :: certificate
    type(status_t), intent(inout) :: status
    type(delassus_dense_t) :: as_matrix
    type(delassus_blocks_t), target :: as_blocks
    type(delassus_products_t) :: as_products
    select case (kind)
    case (dense)
      call as_matrix%resize(size(q, 1), size(q, 2))
      as_matrix%matrix = matrix
      call solve_cone(options, as_matrix, q, mu, r, work, certificate, status)
    case (blocks)
      call blocks_from_dense(matrix, size(q, 1), as_blocks)
      call solve_cone(options, as_blocks, q, mu, r, work, certificate, status)
    case default
      call blocks_from_dense(matrix, size(q, 1), as_blocks)
      call make_products(as_blocks, as_blocks%block(:, :, as_blocks%diagonal), as_products)
      call solve_cone(options, as_products, q, mu, r, work, certificate, status)
    end select
  end subroutine solve

  subroutine random_problem(d, n, condition, mu, matrix, q)
    integer, intent(in) :: d, n
    real(wp), intent(in) :: condition, mu
    real(wp), intent(out) :: matrix(:, :), q(:, :)
    type(delassus_blocks_t) :: w
    call make_problem(d, n, condition, one, mu, w, q)
    call dense_of_blocks(w, matrix)
  end subroutine random_problem

  !> Problems that have a solution, of a condition up to 1e4: certified, and the law holds,
  !> asked from outside. u belongs to r, and an open contact does not push.
  subroutine test_random(d, kind)
    integer, intent(in) :: d, kind
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp), allocatable :: w(:, :), q(:, :), mu(:), r(:, :), off(:, :)
    integer :: n, c, unmet, wrong, apart
    unmet = 0
    wrong = 0
    apart = 0
    options%tolerance = 1.0e-8_wp
    do n = 1, 10
      do c = 0, 4, 2
        allocate (w(d*n, d*n), q(d, n), mu(n), r(d, n), off(d, n))
        mu = merge(zero, 0.4_wp, d == 1)
        call random_problem(d, n, 10.0_wp**c, mu(1), w, q)
        r = zero
        call solve(kind, options, w, q, mu, r, work, certificate, status)
        if (.not. certificate%met) unmet = unmet + 1
        ! The natural map leaves the dual cone by (1 + mu) times the tolerance at most.
        wrong = wrong + law_misses(w, q, mu, r, 1.0e-7_wp)
        off = work%u - q - reshape(matmul(w, reshape(r, [d*n])), [d, n])
        if (norm2(off) > 16*d*n*eps*(norm2(q) + sum(abs(w))*norm2(r))) apart = apart + 1
        if (any(work%status == contact_open .and. r(1, :) > 1.0e-7_wp*norm2(r))) &
            wrong = wrong + 1
        deallocate (w, q, mu, r, off)
      end do
    end do
    call check_true(.not. failed(status), label(d, kind)//'solved')
    call check_equal(unmet, 0, label(d, kind)//'certified')
    call check_equal(wrong, 0, label(d, kind)//'the law holds')
    call check_equal(apart, 0, label(d, kind)//'u = W r + q')
  end subroutine test_random

  function label(d, kind)
    integer, intent(in) :: d, kind
    character(:), allocatable :: label
    label = trim(names(kind))//', d = '//to_text(d)//': '
  end function label

  !> W = I, mu = 1/2, uncoupled: open, stick r = -q, slip r_n = 1 and r_t = -e/2 for q = (-1,
  !> 3 e).
  subroutine test_known(d, kind)
    integer, intent(in) :: d, kind
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: w(3*d, 3*d), q(d, 3), exact(d, 3), r(d, 3), e(3)
    integer :: i
    e = [zero, 0.6_wp, 0.8_wp]
    if (d == 2) e(2) = one
    w = zero
    do i = 1, 3*d
      w(i, i) = one
    end do
    q(1, :) = [one, -2.0_wp, -one]
    exact(1, :) = [zero, 2.0_wp, one]
    do i = 2, d
      q(i, :) = [3.0_wp, 0.5_wp, 3.0_wp]*e(i)
      exact(i, :) = [zero, -0.5_wp, -0.5_wp]*e(i)
    end do
    options%tolerance = 1.0e-12_wp
    r = zero
    call solve(kind, options, w, q, spread(0.5_wp, 1, 3), r, work, certificate, status)
    call check_true(certificate%met, label(d, kind)//'known: certified')
    call check_close(norm2(r - exact), zero, 1.0e-11_wp, label(d, kind)//'known: r')
    call check_true(work%status(1) == contact_open .and. work%status(2) == contact_stick &
        .and. work%status(3) == merge(contact_stick, contact_slip, d == 1), &
        label(d, kind)//'known: statuses')
  end subroutine test_known

  !> Units by powers of two change no digit, within the range that is solved as it is given and
  !> beyond it.
  subroutine test_units(d, kind)
    integer, intent(in) :: d, kind
    integer, parameter :: n = 6, units(2, 5) = reshape([40, -30, -40, 90, 700, 650, -700, &
        -640, 350, -350], [2, 5])
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: first, certificate
    type(status_t) :: status
    real(wp) :: w(d*n, d*n), q(d, n), mu(n), r(d, n), other(d, n)
    integer :: k
    mu = 0.5_wp
    call random_problem(d, n, 1.0e2_wp, 0.5_wp, w, q)
    r = zero
    call solve(kind, options, w, q, mu, r, work, first, status)
    call check_true(first%met, label(d, kind)//'units: solved')
    do k = 1, size(units, 2)
      other = zero
      call solve(kind, options, scale(w, units(1, k)), scale(q, units(2, k)), mu, other, &
          work, certificate, status)
      call check_true(.not. any(abs(scale(other, units(1, k) - units(2, k)) - r) > zero), &
          label(d, kind)//'units change no digit')
      call check_true(.not. (abs(certificate%error - first%error) > zero .or. &
          abs(certificate%eta - first%eta) > zero), label(d, kind)//'nor error and eta')
    end do
  end subroutine test_units

  !> W and q from 1e-250 to 1e250: error, eta and error2018 are finite, and there is an answer
  !> wherever reactions q/W can be held; else a failure.
  subroutine test_extremes(d, kind)
    integer, intent(in) :: d, kind
    integer, parameter :: n = 3
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: c
    type(status_t) :: status
    real(wp) :: w(d*n, d*n), q(d, n), mu(n), r(d, n)
    integer :: i, j, infinite, wrong
    infinite = 0
    wrong = 0
    mu = 0.3_wp
    options%tolerance = 1.0e-8_wp
    call random_problem(d, n, 10.0_wp, 0.3_wp, w, q)
    do i = -250, 250, 125
      do j = -250, 250, 125
        r = zero
        status = status_t()
        call solve(kind, options, w*10.0_wp**i, q*10.0_wp**j, mu, r, work, c, status)
        if (.not. all(ieee_is_finite([c%error, c%eta, c%error2018]))) infinite = infinite + 1
        if (c%met .eqv. failed(status)) wrong = wrong + 1
        if (c%met .neqv. abs(j - i) < 300) wrong = wrong + 1
        if (.not. c%met) cycle
        wrong = wrong + law_misses(w, q, mu, r*10.0_wp**(i - j), 1.0e-7_wp)
      end do
    end do
    call check_equal(infinite, 0, label(d, kind)//'errors are finite in every unit')
    call check_equal(wrong, 0, label(d, kind)//'answers where they can be held')
  end subroutine test_extremes

  !> mu up to the largest number there is: an answer obeys the law, asked from outside; else the
  !> solve fails. Most have one, but by products, whose steps do not converge here.
  subroutine test_large_friction(d, kind, n)
    integer, intent(in) :: d, kind, n
    real(wp), parameter :: frictions(6) = [1.0e8_wp, 1.0e12_wp, 1.0e16_wp, 1.0e100_wp, &
        1.0e300_wp, huge(one)]
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: w(d*n, d*n), b(d*n, d*n), q(d, n), mu(n), r(d, n)
    integer :: k, f, solved, wrong
    options%tolerance = 1.0e-8_wp
    options%max_sweeps = 1000
    solved = 0
    wrong = 0
    call seed_random(4711)
    do k = 1, 20
      call random_number(b)
      call random_number(q)
      w = matmul(2.0_wp*b - one, transpose(2.0_wp*b - one))
      q = 2.0_wp*q - one
      q(1, 1) = -abs(q(1, 1))
      do f = 1, size(frictions)
        mu = frictions(f)
        r = zero
        status = status_t()
        call solve(kind, options, w, q, mu, r, work, certificate, status)
        if (certificate%met .eqv. failed(status)) wrong = wrong + 1
        if (failed(status)) cycle
        solved = solved + 1
        wrong = wrong + law_misses(w, q, mu, r, 1.0e-7_wp)
      end do
    end do
    call check_equal(wrong, 0, label(d, kind)//'large friction: an answer is right')
    if (kind /= products) call check_true(solved >= 110, label(d, kind)// &
        'large friction: solved are '//to_text(solved)//' of 120')
  end subroutine test_large_friction

  !> r = 0 with u_n = -1 and much slip is no answer, whatever the friction: neither where the
  !> solver starts from it, nor for its certificate.
  subroutine test_blind(d, kind)
    integer, intent(in) :: d, kind
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: w(2*d, 2*d), q(d, 2), mu(2), r(d, 2)
    integer :: i, k
    w = 0.25_wp
    do i = 1, 2*d
      w(i, i) = one
    end do
    q = 3.0_wp
    q(1, :) = -one
    do k = 8, 308, 20
      mu = 10.0_wp**k
      r = zero
      call certify(one, mu, q, r, q, options%tolerance, certificate)
      call check_true(.not. certificate%met .and. certificate%error > 0.1_wp, &
          'penetration without force is seen at mu = 1e'//to_text(k))
      call solve(kind, options, w, q, mu, r, work, certificate, status)
      call check_true(certificate%met .or. failed(status), label(d, kind)//'or said to fail')
      if (certificate%met) call check_equal(law_misses(w, q, mu, r, 1.0e-7_wp), 0, &
          label(d, kind)//'closed at mu = 1e'//to_text(k))
    end do
  end subroutine test_blind

  !> No W, and no r: a failure, at once.
  subroutine test_not_finite(kind)
    integer, intent(in) :: kind
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: w(2, 2), q(2, 1), r(2, 1)
    w = zero
    q = -one
    r = zero
    call solve(kind, options, w, q, [0.5_wp], r, work, certificate, status)
    call check_true(failed(status) .and. .not. certificate%met, &
        trim(names(kind))//': no flexibility is said')
    call check_equal(certificate%sweeps, 0, 'and nothing is tried')
  end subroutine test_not_finite

  !> A problem with one answer: the three kinds find it, to tolerance times condition.
  subroutine test_same()
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    integer, parameter :: n = 12
    real(wp), allocatable :: w(:, :), q(:, :), r(:, :, :)
    real(wp) :: mu(n)
    integer :: d, kind
    mu = 0.2_wp
    do d = 1, 3
      allocate (w(d*n, d*n), q(d, n), r(d, n, 3))
      call random_problem(d, n, 10.0_wp, 0.2_wp, w, q)
      r = zero
      do kind = dense, products
        call solve(kind, options, w, q, mu, r(:, :, kind), work, certificate, status)
      end do
      call check_true(.not. failed(status), label(d, dense)//'all kinds solve it')
      call check_close(norm2(r(:, :, 1) - r(:, :, 2)), zero, 1.0e-7_wp*norm2(r(:, :, 1)), &
          label(d, blocks)//'r of the matrix')
      call check_close(norm2(r(:, :, 1) - r(:, :, 3)), zero, 1.0e-7_wp*norm2(r(:, :, 1)), &
          label(d, products)//'r of the matrix')
      deallocate (w, q, r)
    end do
  end subroutine test_same

  !> error and eta of random numbers in other units by powers of two: the same digits, also with
  !> squares that no number holds; error2018, which has a unit, is finite.
  subroutine test_certificate_units()
    integer, parameter :: n = 5, units(2, 4) = reshape([3, -7, 600, 800, -600, -900, 0, 900], &
        [2, 4])
    type(certificate_t) :: first, other
    real(wp) :: q(3, n), r(3, n), u(3, n), mu(n)
    integer :: k, e, f
    call random_number(q)
    call random_number(r)
    call random_number(u)
    mu = 0.5_wp
    q(1, 1) = -q(1, 1)
    call certify(one, mu, q, r, u, 1.0e-10_wp, first)
    do k = 1, size(units, 2)
      e = units(1, k)
      f = units(2, k)
      call certify(scale(one, e), mu, scale(q, f), scale(r, f - e), scale(u, f), 1.0e-10_wp, &
          other)
      call check_true(.not. (abs(other%error - first%error) > zero .or. &
          abs(other%eta - first%eta) > zero), 'error and eta have no unit')
      call check_true(ieee_is_finite(other%error2018), 'error2018 is finite')
    end do
  end subroutine test_certificate_units

end program test_cone_kinds
