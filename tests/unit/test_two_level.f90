! SPDX-License-Identifier: BSD-3-Clause
!> Contact on two levels against the solver of all of W, and the near part of a flexibility
!> against the whole inverse.
program test_two_level
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, failed, status_text
  use check, only: test_start, test_end, check_true, check_close, seed_random
  use cone_blocks, only: delassus_blocks_t, blocks_from_dense
  use cone_dense, only: delassus_dense_t
  use cone_solver, only: solve_cone
  use cone_two_level, only: solve_two_level, solve_with_products
  use cone_types, only: cone_options_t, cone_work_t, certificate_t
  use linalg_bodies, only: schur_t, body_blocks_t, find_bodies, size_blocks
  use linalg_dense, only: solve_general
  use linalg_graph, only: graph_t, block_matrix_t, graph_from_cliques
  use linalg_near, only: near_t, find_near, fill_near
  implicit none
  integer :: d

  call test_start('two_level')
  call seed_random(4321)
  do d = 1, 3
    call test_against_dense(d, 40, 4)
    call test_against_dense(d, 40, 12)
  end do
  do d = 2, 3
    call test_near(d)
  end do
  call test_bodies()
  call test_end()

contains

  !> A W that decays along a row of contacts by a fourth each; its near part has so many on
  !> either side. The answers differ by the tolerance times the condition of W, below 10.
  subroutine test_against_dense(d, n, radius)
    integer, intent(in) :: d, n, radius
    type(cone_options_t) :: options
    type(delassus_dense_t), target :: w
    type(delassus_blocks_t) :: near
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: q(d, n), mu(n), r(d, n), exact(d, n), far(d, n), cut(d*n, d*n)
    integer :: i, j, passes
    call w%resize(d, n)
    do j = 1, d*n
      do i = 1, d*n
        w%matrix(i, j) = 0.25_wp**abs((i - 1)/d - (j - 1)/d)*merge(one, 0.2_wp, &
            mod(i, d) == mod(j, d))
        cut(i, j) = merge(w%matrix(i, j), zero, abs((i - 1)/d - (j - 1)/d) <= radius)
      end do
    end do
    call blocks_from_dense(cut, d, near)
    call random_number(q)
    q = q - 0.7_wp
    mu = merge(zero, 0.4_wp, d == 1)
    exact = zero
    call solve_cone(options, w, q, mu, exact, work, certificate, status)
    r = zero
    far = zero
    call solve_two_level(options, near, w, q, mu, far, r, work, passes, certificate, status)
    call check_true(certificate%met .and. .not. failed(status), 'met: '//status_text(status))
    call check_true(passes <= merge(9, 5, radius == 4), 'few passes')
    call check_close(maxval(abs(r - exact)), zero, 1.0e-9_wp*maxval(exact), 'on two levels')
    r = zero
    call solve_with_products(options, near, w, q, mu, r, work, certificate, status)
    call check_true(certificate%met .and. .not. failed(status), 'products: '// &
        status_text(status))
    call check_close(maxval(abs(r - exact)), zero, 1.0e-8_wp*maxval(exact), 'by products')
  end subroutine test_against_dense

  !> Two strips: near blocks of a matrix with much on its diagonal. A window cuts at 12 steps
  !> what decays by 1/5 a step or faster: what is left is round-off of entries below 1.
  subroutine test_near(d)
    integer, intent(in) :: d
    integer, parameter :: n = 60, last(4) = [5, 9, 33, 40]
    type(graph_t) :: graph
    type(block_matrix_t) :: matrix
    type(near_t) :: near
    type(status_t) :: status
    real(wp) :: dense(d*n, d*n), inverse(d*n, d*n), worst
    integer :: k, m, i, a, b, pivot(d*n)
    logical :: ok
    call make_strips(n, graph)
    allocate (matrix%value(d, d, size(graph%column)))
    dense = zero
    do k = 1, n
      do m = graph%first(k), graph%first(k + 1) - 1
        i = graph%column(m)
        matrix%value(:, :, m) = merge(4.0_wp, -0.1_wp, k == i)*reshape([(merge(one, 0.1_wp, &
            mod(a, d + 1) == 1 .or. d == 1), a=1, d*d)], [d, d])
        dense(d*k - d + 1:d*k, d*i - d + 1:d*i) = matrix%value(:, :, m)
      end do
    end do
    inverse = zero
    do k = 1, d*n
      inverse(k, k) = one
    end do
    call solve_general(d*n, dense, inverse, pivot, ok)
    call find_near(graph, d, last, 8, near)
    call fill_near(graph, matrix, last, 12, near, status)
    call check_true(.not. failed(status), 'near: '//status_text(status))
    call check_true(all(near%first == [1, 3, 5, 7, 9]), 'pairs within reach, of one strip')
    worst = zero
    do k = 1, 4
      do m = near%first(k), near%first(k + 1) - 1
        a = d*(last(k) - 1)
        b = d*(last(near%node(m)) - 1)
        worst = max(worst, maxval(abs(near%block(:, :, m) - inverse(a + 1:a + d, b + 1:b + d))))
      end do
    end do
    call check_close(worst, zero, 1.0e-15_wp, 'near blocks')
  end subroutine test_near

  !> Two strips of n/2 nodes.
  subroutine make_strips(n, graph)
    integer, intent(in) :: n
    type(graph_t), intent(out) :: graph
    integer :: k
    call graph_from_cliques(n, [(2*k - 1, k=1, n - 1)], [([k, k + 1], k=1, n/2 - 1), &
        ([k, k + 1], k=n/2 + 1, n - 1)], graph)
  end subroutine make_strips

  !> Blocks by body where the nodes are listed body by body and are not few.
  subroutine test_bodies()
    type(graph_t) :: graph
    type(schur_t) :: schur
    type(body_blocks_t) :: blocks
    integer :: body(600), bodies, k
    call make_strips(600, graph)
    call find_bodies(graph, body, bodies)
    call check_true(bodies == 2 .and. all(body(:300) == 1) .and. &
        all(body(301:) == 2), 'two bodies')
    call schur%plan(graph, 2, [(k, k=151, 450)])
    call check_true(schur%bodies == 2 .and. all(schur%first == [1, 151, 301]), 'two blocks')
    call check_true(schur%bytes() == 2*8*300**2, 'half the bytes')
    call size_blocks(schur, blocks)
    call check_true(blocks%rows() == 600 .and. size(blocks%block(2)%a) == 90000, &
        'their inverse')
    call schur%plan(graph, 2, [(1 + mod(337*k, 600), k=1, 300)])
    call check_true(schur%bodies == 1, 'one block where bodies alternate')
    call schur%plan(graph, 2, [1, 2, 599, 600])
    call check_true(schur%bodies == 1, 'one block of a few')
  end subroutine test_bodies

end program test_two_level
