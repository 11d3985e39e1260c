! SPDX-License-Identifier: BSD-3-Clause
!> Impacts of given masses and contacts, without elements: what restitution means, and that no
!> impact gives energy where one e holds for all. The stage is that of velocities behind one of
!> positions: x = h (V1 - V0), v1n + e v0n >= 0 where pressed.
program test_impacts
  use base_kinds, only: wp, zero, half, one
  use base_status, only: status_t, failed, status_text
  use check, only: test_start, test_end, check_true, check_close, seed_random
  use contact_node, only: pairing_node_t
  use contact_rows, only: start_rows, add_row, row_vertex
  use contact_rule, only: contact_rule_t, level_pressed
  use contact_stage, only: solve_contact
  use contact_types, only: contact_t
  use linalg_dense, only: dense_spd_t, dense_factor, dense_solve
  use model_data, only: model_t
  implicit none
  real(wp), parameter :: h = 0.01_wp
  !> Of the cone solver; velocities and energies here are of the size of 1.
  real(wp), parameter :: tolerance = 1.0e-14_wp

  call test_start('impacts')
  call test_three_in_a_row()
  call test_random_impacts()
  call test_end()

contains

  !> Three equal masses in a row at rest but the first, which arrives at 1: all contacts at once
  !> obey Newton's law v1n = - e v0n (closed form; a sequence of impacts would give (0, 0, 1)).
  subroutine test_three_in_a_row()
    real(wp), parameter :: e(3) = [one, half, zero]
    real(wp), parameter :: expected(3, 3) = reshape([-one, 2*one, 2*one, zero, 1.5_wp, 1.5_wp, &
        one, one, one], [3, 3])/3.0_wp
    type(contact_t) :: contact
    real(wp) :: inverse_mass(6, 6), v(2, 3)
    integer :: k, i
    inverse_mass = zero
    do i = 1, 6
      inverse_mass(i, i) = one
    end do
    do k = 1, 3
      call make_contact(3, inverse_mass, e(k), contact)
      call add_row(contact%rows, [1, 1, 1, -1], [1, 2], [one, -one], [-one, zero], zero, zero, &
          one, row_vertex, zero)
      call add_row(contact%rows, [1, 1, 2, -2], [2, 3], [one, -one], [-one, zero], zero, zero, &
          one, row_vertex, zero)
      v = zero
      v(1, 1) = one
      call collide(contact, v)
      do i = 1, 3
        call check_close(v(1, i), expected(i, k), 1.0e-12_wp, 'three masses in a row')
      end do
    end do
  end subroutine test_three_in_a_row

  !> Random masses that couple all nodes, random contacts with friction: the kinetic energy
  !> never rises (dKE = p.v_a - (1 - e)/(2 (1 + e)) p.W p, v_a = (v1 + e v0)/(1 + e)). At e = 1
  !> it is kept where there is no friction.
  subroutine test_random_impacts()
    real(wp), parameter :: e(3) = [0.5_wp, 0.9_wp, one], mu(3) = [0.3_wp, one, zero]
    integer, parameter :: nodes = 5
    type(contact_t) :: contact
    type(dense_spd_t) :: mass
    real(wp) :: a(2*nodes, 2*nodes), inverse_mass(2*nodes, 2*nodes), v(2, nodes)
    real(wp) :: before, after, gain
    integer :: k, i, n, at_e, at_mu, hits
    call seed_random(4)
    gain = -huge(one)
    hits = 0
    do k = 1, 4000
      at_e = 1 + modulo(k, 3)
      at_mu = 1 + modulo(int(k/3.0_wp), 3)
      call random_number(a)
      a = a - half
      inverse_mass = matmul(a, transpose(a))
      do i = 1, 2*nodes
        inverse_mass(i, i) = inverse_mass(i, i) + 0.2_wp
      end do
      call make_contact(nodes, inverse_mass, e(at_e), contact)
      n = 2 + mod(k, 4)
      call add_random_rows(contact, n, nodes, mu(at_mu))
      call random_number(v)
      v = 2.0_wp*v - one
      mass%l = inverse_mass
      call factor(mass)
      before = kinetic(mass, v)
      call collide(contact, v)
      after = kinetic(mass, v)
      gain = max(gain, after/before - one)
      if (abs(after - before) > 1.0e-3_wp*before) hits = hits + 1
      if (at_e == 3 .and. at_mu == 3) &
          call check_close(after/before, one, 1.0e-11_wp, 'e = 1 without friction keeps energy')
    end do
    call check_true(gain <= 1.0e-12_wp, 'no impact gives energy')
    call check_true(hits > 1000, 'impacts change the energy')
  end subroutine test_random_impacts

  subroutine factor(mass)
    type(dense_spd_t), intent(inout) :: mass
    type(status_t) :: status
    call dense_factor(mass, status)
    call check_true(.not. failed(status), status_text(status))
  end subroutine factor

  !> v.M v/2 from the factor of M^-1.
  real(wp) function kinetic(mass, v)
    type(dense_spd_t), intent(in) :: mass
    real(wp), intent(in) :: v(:, :)
    real(wp) :: momentum(size(v, 1), size(v, 2))
    momentum = v
    call dense_solve(mass, size(v), momentum)
    kinetic = half*sum(v*momentum)
  end function kinetic

  !> Contact of nodes whose inverse mass is given, without rows.
  subroutine make_contact(nodes, inverse_mass, e, contact)
    integer, intent(in) :: nodes
    real(wp), intent(in) :: inverse_mass(:, :), e
    type(contact_t), intent(out) :: contact
    integer :: i
    allocate (contact%pairing(1), contact%acts(1), contact%rows, contact%spare)
    allocate (pairing_node_t :: contact%pairing(1)%item)
    contact%pairing(1)%item%restitution = e
    contact%interface_node = [(i, i=1, nodes)]
    contact%slot = contact%interface_node
    allocate (contact%constrained(0))
    allocate (contact%column(2*nodes))
    call contact%schur_inverse%set_one_body(size(inverse_mass, 1))
    contact%schur_inverse%block(1)%a = h**2*inverse_mass
    contact%cone%tolerance = tolerance
    contact%rule = contact_rule_t(level=level_pressed, before=-h, now=h)
    call start_rows(contact%rows)
    call start_rows(contact%spare)
  end subroutine make_contact

  subroutine add_random_rows(contact, n, nodes, mu)
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: n, nodes
    real(wp), intent(in) :: mu
    real(wp) :: x(3), angle
    integer :: k, i, j
    do k = 1, n
      call random_number(x)
      i = 1 + int(nodes*x(1))
      j = 1 + mod(i + int((nodes - 1)*x(2)), nodes)
      angle = 6.3_wp*x(3)
      call add_row(contact%rows, [1, 1, i, -j], [i, j], [one, -one], [cos(angle), sin(angle)], &
          zero, mu, one, row_vertex, zero)
    end do
  end subroutine add_random_rows

  !> Velocities (2, nodes) after the impact of all contacts at once.
  subroutine collide(contact, v)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(inout) :: v(:, :)
    type(model_t) :: model
    type(status_t) :: status
    real(wp) :: free(2, size(v, 2)), force(2, size(v, 2))
    logical :: acting
    integer :: i
    model%node_id = [(i, i=1, size(v, 2))]
    contact%rows%r(:, :contact%rows%n) = zero
    contact%rows%r(1, :contact%rows%n) = one
    contact%rows%slot = contact%rows%point
    free = zero
    call solve_contact(model, contact, free, v, free, one, force, acting, status)
    call check_true(.not. failed(status), 'an impact is solved: '//status_text(status))
    v = v + reshape(matmul(contact%schur_inverse%block(1)%a, reshape(force, &
        [size(force)])), shape(v))/h
  end subroutine collide

end program test_impacts
