! SPDX-License-Identifier: BSD-3-Clause
!> One problem, every way to its solution: contacts of one, two and three components, W as a
!> matrix, as blocks and by products, every solver and local solver; and in space the same
!> answer whatever the tangents are.
program test_cone_dimensions
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, failed
  use base_strings, only: to_text
  use check, only: test_start, test_end, check_true, check_close, check_equal, seed_random
  use cone_blocks, only: delassus_blocks_t, blocks_from_dense, dense_of_blocks
  use cone_dense, only: delassus_dense_t
  use cone_exact, only: solve_exact
  use cone_products, only: delassus_products_t, make_products
  use cone_solver, only: solve_cone
  use cone_types, only: cone_options_t, cone_work_t, certificate_t, contact_slip, &
      deck_solver_names, local_names, solver_gs
  use contact_law, only: law_misses
  use random_contacts, only: make_problem
  implicit none
  integer, parameter :: dense = 1, blocks = 2, products = 3
  real(wp), parameter :: eps = epsilon(one)
  !> Contacts of a problem; the tolerance that is asked for.
  integer, parameter :: n = 8
  real(wp), parameter :: tolerance = 1.0e-12_wp
  integer :: d

  call test_start('cone_dimensions')
  call seed_random(4711)
  do d = 1, 3
    call test_ways(d)
    call test_redundant(d)
    call test_wedged(d)
    call test_round_off(d)
  end do
  call test_tangents()
  call test_slip_along_tangent()
  call test_end()

contains

  !> Solves by W of that kind; a certificate or a failure.
  subroutine solve(kind, options, matrix, q, mu, r, u, is_met)
    integer, intent(in) :: kind
    type(cone_options_t), intent(in) :: options
    real(wp), intent(in) :: matrix(:, :), q(:, :), mu(:)
    real(wp), intent(out) :: r(:, :), u(:, :)
    logical, intent(out) :: is_met
    type(delassus_dense_t) :: as_matrix
    type(delassus_blocks_t), target :: as_blocks
    type(delassus_products_t) :: as_products
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    r = zero
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
    u = work%u
    is_met = certificate%met .and. .not. failed(status)
  end subroutine solve

  !> The ways: AUTO, GS, PROX, NEWTON with each local solver on matrix and blocks; products.
  pure integer function count_ways()
    count_ways = 2*size(deck_solver_names)*size(local_names) + 1
  end function count_ways

  pure subroutine choose_way(way, kind, options)
    integer, intent(in) :: way
    integer, intent(out) :: kind
    type(cone_options_t), intent(out) :: options
    integer :: k
    options%tolerance = tolerance
    k = way - 1
    kind = products
    if (way == count_ways()) return
    kind = merge(dense, blocks, mod(k, 2) == 0)
    options%local = 1 + mod(k/2, size(local_names))
    options%solver = 1 + k/(2*size(local_names))
  end subroutine choose_way

  !> A random problem of d components and its W as a matrix.
  subroutine make_dense(d, condition, redundancy, mu, w, q)
    integer, intent(in) :: d
    real(wp), intent(in) :: condition, redundancy, mu
    real(wp), intent(out) :: w(:, :), q(:, :)
    type(delassus_blocks_t) :: as_blocks
    call make_problem(d, size(q, 2), condition, redundancy, mu, as_blocks, q)
    call dense_of_blocks(as_blocks, w)
  end subroutine make_dense

  !> Eigenvalues of W within a factor of 10 and friction below what wedges (mu |W_nt| < W_nn):
  !> one answer. Where the misfit is 1e-12 of the largest term, r is known to (condition)
  !> times a small number of that; 1e-8 leaves three digits.
  subroutine test_ways(d)
    integer, intent(in) :: d
    real(wp), parameter :: frictions(3) = [0.0_wp, 0.1_wp, 0.3_wp]
    type(cone_options_t) :: options
    real(wp) :: w(d*n, d*n), q(d, n), mu(n), r(d, n), u(d, n), r_first(d, n), u_first(d, n)
    integer :: trial, way, kind, misses
    logical :: is_met
    misses = 0
    do trial = 1, 9
      mu = frictions(1 + mod(trial, 3))
      call make_even(d, w, q)
      do way = 1, count_ways()
        call choose_way(way, kind, options)
        call solve(kind, options, w, q, mu, r, u, is_met)
        call check_true(is_met, label(d, way)//'certified')
        misses = misses + law_misses(w, q, mu, r, 1.0e-9_wp)
        if (way == 1) r_first = r
        if (way == 1) u_first = u
        call check_close(norm2(r - r_first), zero, 1.0e-8_wp*norm2(r_first), &
            label(d, way)//'r of the first way')
        call check_close(norm2(u - u_first), zero, 1.0e-8_wp*(norm2(u_first) + norm2(q)), &
            label(d, way)//'u of the first way')
      end do
      call check_true(norm2(r_first) > zero, 'something pushes')
    end do
    call check_equal(misses, 0, 'd = '//to_text(d)//': the law, asked from outside')
  end subroutine test_ways

  !> W = I + B B' with |B B'| = 9, q in -1..1 with a contact that closes.
  subroutine make_even(d, w, q)
    integer, intent(in) :: d
    real(wp), intent(out) :: w(:, :), q(:, :)
    real(wp) :: b(size(w, 1), size(w, 1))
    integer :: i
    call random_number(b)
    call random_number(q)
    b = 2.0_wp*b - one
    q = 2.0_wp*q - one
    q(1, 1:n:3) = -abs(q(1, 1:n:3))
    w = matmul(b, transpose(b))
    w = 9.0_wp*w/norm2(w)
    do i = 1, d*n
      w(i, i) = w(i, i) + one
    end do
  end subroutine make_even

  !> W of half the rank: many reactions, and without friction one motion u.
  subroutine test_redundant(d)
    integer, intent(in) :: d
    type(cone_options_t) :: options
    real(wp) :: w(d*n, d*n), q(d, n), mu(n), r(d, n), u(d, n), u_first(d, n)
    integer :: trial, way, kind, misses
    logical :: is_met
    misses = 0
    do trial = 1, 6
      mu = merge(zero, 0.3_wp, mod(trial, 2) == 0)
      call make_dense(d, 10.0_wp, 2.0_wp, mu(1), w, q)
      do way = 1, count_ways()
        call choose_way(way, kind, options)
        ! Sweeps alone crawl where W is singular; the others must do it.
        if (options%solver == solver_gs) cycle
        if (kind == products) options%max_sweeps = 100000
        call solve(kind, options, w, q, mu, r, u, is_met)
        call check_true(is_met, label(d, way)//'redundant: certified')
        misses = misses + law_misses(w, q, mu, r, 1.0e-9_wp)
        if (way == 1) u_first = u
        if (mu(1) > zero) cycle
        call check_close(norm2(u - u_first), zero, 1.0e-8_wp*(norm2(u_first) + norm2(q)), &
            label(d, way)//'redundant: u of the first way')
      end do
    end do
    call check_equal(misses, 0, 'd = '//to_text(d)//', redundant: the law')
  end subroutine test_redundant

  !> Friction up to 1 on W whose blocks W_nt are as large as W_nn: several answers where
  !> contacts wedge, so each is asked for the law alone. AUTO must find one.
  subroutine test_wedged(d)
    integer, intent(in) :: d
    type(cone_options_t) :: options
    real(wp) :: w(d*n, d*n), q(d, n), mu(n), r(d, n), u(d, n)
    integer :: trial, kind, misses
    logical :: is_met
    misses = 0
    options%tolerance = 1.0e-10_wp
    do trial = 0, 10
      mu = trial/10.0_wp
      call make_dense(d, 1.0e2_wp, one, mu(1), w, q)
      do kind = dense, blocks
        call solve(kind, options, w, q, mu, r, u, is_met)
        call check_true(is_met, 'd = '//to_text(d)//', wedged: certified')
        misses = misses + law_misses(w, q, mu, r, 1.0e-8_wp)
      end do
    end do
    call check_equal(misses, 0, 'd = '//to_text(d)//', wedged: the law')
  end subroutine test_wedged

  !> On a matrix the statuses that sweeps have found lead to an answer to round-off, whatever
  !> tolerance is asked for: sums of d n products of condition 10 leave 1e-13.
  subroutine test_round_off(d)
    integer, intent(in) :: d
    type(cone_options_t) :: options
    real(wp) :: w(d*n, d*n), q(d, n), mu(n), r(d, n), u(d, n), exact(d, n)
    integer :: trial
    logical :: is_met
    mu = 0.3_wp
    do trial = 1, 10
      call make_even(d, w, q)
      options%tolerance = 1.0e-15_wp
      call solve(blocks, options, w, q, mu, exact, u, is_met)
      options%tolerance = 1.0e-6_wp
      call solve(dense, options, w, q, mu, r, u, is_met)
      call check_true(is_met, 'coarse: certified')
      call check_close(norm2(r - exact), zero, 1.0e-13_wp*norm2(exact), &
          'd = '//to_text(d)//', coarse: known to round-off all the same')
    end do
  end subroutine test_round_off

  function label(d, way)
    integer, intent(in) :: d, way
    character(:), allocatable :: label
    type(cone_options_t) :: options
    integer :: kind
    call choose_way(way, kind, options)
    label = 'd = '//to_text(d)//', kind '//to_text(kind)//', '// &
        trim(deck_solver_names(options%solver))//', '//trim(local_names(options%local))//': '
    if (kind == products) label = 'd = '//to_text(d)//', products: '
  end function label

  !> Twelve contacts in space, mu 1/2, in ten random sets of tangents: the reactions turned
  !> back are the same. All methods but the momentum steps (their start of the power iteration
  !> has a direction) do the same in every frame, but for round-off, some 12 numbers of eps
  !> each in every product: 1e-13 is 450 eps.
  subroutine test_tangents()
    integer, parameter :: m = 12
    type(cone_options_t) :: options
    real(wp) :: w(3*m, 3*m), q(3, m), mu(m), first(3, m), r(3, m), u(3, m), turn(3*m, 3*m)
    real(wp) :: off
    integer :: set, kind, solver
    logical :: is_met
    mu = 0.5_wp
    call make_dense(3, 10.0_wp, one, mu(1), w, q)
    do kind = dense, blocks
      do solver = 1, size(deck_solver_names)
        options%solver = solver
        call solve(kind, options, w, q, mu, first, u, is_met)
        call check_true(is_met, 'tangents: certified')
        off = zero
        do set = 1, 10
          call random_turn(turn)
          call solve(kind, options, matmul(matmul(turn, w), transpose(turn)), &
              reshape(matmul(turn, reshape(q, [3*m])), [3, m]), mu, r, u, is_met)
          r = reshape(matmul(transpose(turn), reshape(r, [3*m])), [3, m])
          off = max(off, norm2(r - first)/norm2(first))
        end do
        call check_close(off, zero, 1.0e-13_wp, 'tangents: kind '//to_text(kind)//', '// &
            trim(deck_solver_names(solver)))
      end do
    end do
  end subroutine test_tangents

  !> Each contact's tangents turned by an angle of its own about its normal, half of them with
  !> the second reversed.
  subroutine random_turn(turn)
    real(wp), intent(out) :: turn(:, :)
    real(wp) :: angle, c, s
    integer :: a, row
    turn = zero
    do a = 1, size(turn, 1)/3
      row = 3*(a - 1)
      call random_number(angle)
      c = cos(8.0_wp*angle)
      s = sin(8.0_wp*angle)
      turn(row + 1, row + 1) = one
      turn(row + 2, row + 2:row + 3) = [c, s]
      turn(row + 3, row + 2:row + 3) = merge(-one, one, mod(a, 2) == 0)*[-s, c]
    end do
  end subroutine random_turn

  !> Slip along a tangent, and along the directions that the exact solver tries first: W = I,
  !> q = (-1, 3 e), mu 1/2: r = (1, -e/2).
  subroutine test_slip_along_tangent()
    real(wp) :: w(3, 3), q(3), r(3), u(3), e(2), angle
    integer :: k, status
    logical :: found
    w = zero
    w(1, 1) = one
    w(2, 2) = one
    w(3, 3) = one
    do k = 0, 31
      angle = 6.283185307179586_wp*k/32
      e = [cos(angle), sin(angle)]
      if (mod(k, 8) == 0) e = anint(e)
      q = [-one, 3.0_wp*e]
      r = zero
      u = q
      call solve_exact(w, 0.5_wp, r, u, status, found)
      call check_true(found .and. status == contact_slip, 'slip in every direction')
      call check_close(norm2(r - [one, -0.5_wp*e]), zero, 16.0_wp*eps, 'its direction')
    end do
  end subroutine test_slip_along_tangent

end program test_cone_dimensions
