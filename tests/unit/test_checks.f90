! SPDX-License-Identifier: BSD-3-Clause
!> Assertions: the flavours debug and sanitize have them, release has none; right calls pass.
!> With the argument linalg, cone or contact it makes a wrong call of that layer, which must end
!> the program in a flavour with assertions (tests/build/checks.sh).
program test_checks
  use base_checks, only: checks_on
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, failed
  use check, only: test_start, test_end, check_true
  use cone_dense, only: delassus_dense_t
  use cone_solver, only: solve_cone
  use cone_types, only: cone_options_t, cone_work_t, certificate_t
  use contact_search, only: update_lists
  use contact_types, only: contact_t
  use linalg_graph, only: graph_t, block_matrix_t, graph_from_cliques
  use linalg_ldlt, only: ldlt_t
  use model_data, only: model_t
  implicit none
  character(8) :: layer, flavour
  integer :: length

  call get_command_argument(1, layer)
  call get_environment_variable('FLAVOUR', flavour, length)
  call test_start('checks')
  if (length > 0) call check_true(checks_on .neqv. flavour == 'release', &
      'assertions belong to debug and sanitize')
  call pass_a_vector(merge(2, 3, layer == 'linalg'))
  call pass_frictions(merge(1, 2, layer == 'cone'))
  call pass_displacements(merge(1, 2, layer == 'contact'))
  call test_end()

contains

  !> A chain of three nodes needs vectors of three.
  subroutine pass_a_vector(n)
    integer, intent(in) :: n
    type(graph_t) :: graph
    type(block_matrix_t) :: matrix
    type(ldlt_t) :: solver
    type(status_t) :: status
    real(wp) :: b(2, n), b_interface(2, 1)
    integer :: k, i
    call graph_from_cliques(3, [1, 3, 5], [1, 2, 2, 3], graph)
    allocate (matrix%value(2, 2, size(graph%column)))
    matrix%value = zero
    do k = 1, 3
      do i = 1, 2
        matrix%value(i, i, graph%position(k, k)) = one
      end do
    end do
    call solver%analyse(graph, size(b, 1), [3], status)
    call solver%factor(graph, matrix, status)
    b = one
    call solver%forward(b, b_interface)
    call check_true(.not. failed(status), 'a right call of linalg')
  end subroutine pass_a_vector

  !> Two contacts need two coefficients of friction.
  subroutine pass_frictions(n)
    integer, intent(in) :: n
    type(delassus_dense_t) :: w
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: q(1, 2), mu(n), r(1, 2)
    call w%resize(1, 2)
    w%matrix = reshape([one, zero, zero, one], [2, 2])
    q = -one
    mu = zero
    r = zero
    call solve_cone(cone_options_t(), w, q, mu, r, work, certificate, status)
    call check_true(certificate%met, 'a right call of cone')
  end subroutine pass_frictions

  !> Two nodes need two displacements.
  subroutine pass_displacements(n)
    integer, intent(in) :: n
    type(model_t) :: model
    type(contact_t) :: contact
    type(status_t) :: status
    real(wp) :: u(2, n)
    logical :: new_interface
    model%nodes = 2
    allocate (contact%pairing(0), contact%acts(0))
    u = zero
    call update_lists(model, contact, u, u, u, zero, one, 0, one, new_interface, status)
    call check_true(.not. new_interface, 'a right call of contact')
  end subroutine pass_displacements

end program test_checks
