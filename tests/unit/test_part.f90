! SPDX-License-Identifier: BSD-3-Clause
!> Products with a part of the effective matrix equal those with the whole one, digit for digit.
program test_part
  use assembly_damping, only: subtract_damping_force
  use assembly_forces, only: subtract_internal_force, subtract_layer_force
  use assembly_part, only: part_t, rows_of_nodes, columns_of_nodes, subtract_part
  use assembly_system, only: system_t, multiply_mass
  use base_kinds, only: wp, zero
  use base_status, only: status_t, failed
  use check, only: test_start, test_end, check_true, check_equal, seed_random
  use deck_parameter, only: override_t
  use run_data, only: run_t
  use run_setup, only: read_scene, set_up
  implicit none
  real(wp), parameter :: c_m = 3.7e3_wp, c_c = 29.0_wp, c_layer = 0.013_wp, &
      c_k = 0.51_wp
  integer :: k

  call test_start('part')
  call seed_random(31)
  call test_scene('input/two_bars/theta_massless.k', .true., .false.)
  call test_scene('input/lessons/inner_corner.k', .false., .false.)
  call test_scene('input/cards/every_keyword.k', .false., .true.)
  call test_end()

contains

  !> Few nodes, many nodes, all nodes; what the scene is here for: a layer of massless nodes, or
  !> a lumped mass with damping by the mass and by the stiffness.
  subroutine test_scene(deck, has_layer, is_lumped)
    character(*), intent(in) :: deck
    logical, intent(in) :: has_layer, is_lumped
    type(run_t) :: run
    type(override_t) :: overrides(0)
    type(status_t) :: status
    integer :: wrong
    call read_scene(deck, overrides, run, status)
    call set_up(run, status)
    call check_true(.not. failed(status), deck//' is set up')
    call check_true(size(run%system%massless_layer) > 0 .eqv. has_layer, deck//': the layer')
    call check_true(allocated(run%system%damping) .eqv. is_lumped, deck//': damping')
    call check_true(run%system%mass_is_diagonal .eqv. is_lumped, deck//': a diagonal mass')
    wrong = 0
    do k = 1, 50
      wrong = wrong + differences(run%system, 0.02_wp*k)
    end do
    call check_equal(wrong, 0, deck//': parts of products')
  end subroutine test_scene

  !> Digits that differ, for nodes marked by chance.
  integer function differences(system, share)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: share
    real(wp) :: x(2, system%n), b(2, system%n), whole(2, system%n), chance(system%n)
    logical :: marked(system%n)
    type(part_t) :: part
    integer :: i
    call random_number(x)
    call random_number(b)
    call random_number(chance)
    x = x - 0.5_wp
    marked = chance < share
    whole = b
    call subtract_whole(system, x, whole)
    call rows_of_nodes(system, marked, part)
    call subtract_part(system, part, c_m, c_c, c_layer, c_k, x, b)
    differences = 0
    do i = 1, system%n
      if (marked(i)) differences = differences + count(abs(b(:, i) - whole(:, i)) > zero)
      if (.not. marked(i)) x(:, i) = zero
    end do
    call random_number(b)
    whole = b
    call subtract_whole(system, x, whole)
    call columns_of_nodes(system, marked, part)
    call subtract_part(system, part, c_m, c_c, c_layer, c_k, x, b)
    differences = differences + count(abs(b - whole) > zero)
  end function differences

  !> b = b - A x, all of it.
  subroutine subtract_whole(system, x, b)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(inout) :: b(:, :)
    call multiply_mass(system, -c_m, x, b)
    call subtract_internal_force(system, c_k, x, b)
    call subtract_layer_force(system, c_layer, x, b)
    if (allocated(system%damping)) call subtract_damping_force(system, c_c, x, b)
  end subroutine subtract_whole

end program test_part
