! SPDX-License-Identifier: BSD-3-Clause
!> Elements at finite deformation: their force is the derivative of the energy, their tangent
!> that of the force; the conserving force does the work of the energy and has no moment; rigid
!> motions have no force; mean dilatation.
program test_solid
  use base_kinds, only: wp, zero, one, half
  use check, only: test_start, test_end, check_close, seed_random
  use element_base, only: element_t
  use element_registry, only: make_element
  use law_cases, only: case_t, make_cases
  use material_base, only: plane_strain, plane_stress, axisymmetric, in_space
  use solid_block, only: solid_t, force_rule_t, force_ends, force_middle, force_conserving, &
      make_solid, begin_elements, commit_step, element_force, element_tangent, &
      element_energy
  implicit none
  type(case_t), allocatable :: cases(:)
  character(8), parameter :: plane_names(2) = [character(8) :: 'QUAD4', 'TRI3']
  character(8), parameter :: ring_names(2) = [character(8) :: 'QUAD4AX', 'TRI3AX']
  character(8), parameter :: space_names(6) = [character(8) :: 'HEX8', 'TET4', 'WEDGE6', &
      'PYRAMID5', 'TET10', 'HEX27']
  logical :: shown
  integer :: k, e

  call test_start('solid')
  call seed_random(91)
  call get_environment_variable('SHOW', status=k)
  shown = k == 0
  call make_cases(cases)
  do k = 1, size(cases)
    do e = 1, size(plane_names)
      call test_element(cases(k), plane_names(e), plane_strain, .false.)
      call test_element(cases(k), ring_names(e), axisymmetric, .false.)
    end do
    call test_element(cases(k), 'QUAD4AX', axisymmetric, .true.)
    call test_element(cases(k), 'QUAD4', plane_stress, .false.)
    call test_element(cases(k), 'QUAD4', plane_strain, .true.)
    call test_element(cases(k), 'HEX8', in_space, .true.)
    call test_element(cases(k), 'HEX8', in_space, .false.)
  end do
  do e = 2, size(space_names)
    call test_element(cases(1), space_names(e), in_space, .false.)
  end do
  call test_end()

contains

  !> All of one element, law and kinematics.
  subroutine test_element(case, name, plane, is_mean)
    type(case_t), intent(in) :: case
    character(*), intent(in) :: name
    integer, intent(in) :: plane
    logical, intent(in) :: is_mean
    type(solid_t) :: solid
    class(element_t), allocatable :: element
    real(wp), allocatable :: x(:, :), u(:, :), d(:, :)
    character(:), allocatable :: label
    call make_element(name, element)
    label = trim(case%name)//', '//trim(name)//merge(' mean', '     ', is_mean)
    if (plane == plane_stress) label = label//', plane stress'
    x = places(element)
    if (element%is_ring) x(1, :) = x(1, :) + 0.4_wp
    call make_solid(element, case%law, plane, is_mean, 0.7_wp, 1, &
        reshape([(k, k=1, element%nodes)], [element%nodes, 1]), x, solid)
    allocate (u, d, mold=x)
    u = 0.1_wp*random_matrix(size(x, 1), size(x, 2))
    d = 0.08_wp*random_matrix(size(x, 1), size(x, 2))
    call begin_elements(solid, 1, 1, u)
    if (.not. case%is_plastic) call test_derivative(solid, u, label)
    ! The yield curve of the other has corners, where a difference is no derivative.
    if (case%name /= 'piecewise') call test_tangents(solid, u, d, label)
    call commit_step(solid, u)
    call begin_elements(solid, 1, 1, u)
    call test_conserving(solid, x, u, d, label)
    solid%history = zero
    call test_rigid(solid, x, label)
  end subroutine test_element

  !> Nodes of the reference element, a little off.
  function places(element) result(x)
    class(element_t), intent(in) :: element
    real(wp), allocatable :: x(:, :)
    real(wp), parameter :: unit(3, 8) = real(reshape([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, &
        1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1], [3, 8]), wp)
    integer :: corner(8), n
    n = element%nodes
    select case (element%name)
    case ('WEDGE6')
      corner(:6) = [1, 2, 4, 5, 6, 8]
    case ('PYRAMID5')
      corner(:5) = [1, 2, 3, 4, 5]
    case ('TET4')
      corner(:4) = [1, 2, 4, 5]
    case ('TRI3', 'TRI3AX')
      corner(:3) = [1, 2, 4]
    case default
      corner = [1, 2, 3, 4, 5, 6, 7, 8]
    end select
    if (allocated(element%place)) then
      x = element%place
    else
      x = unit(:element%dim, corner(:n))
    end if
    x = x + 0.05_wp*random_matrix(size(x, 1), size(x, 2))
  end function places

  function random_matrix(n, m) result(a)
    integer, intent(in) :: n, m
    real(wp) :: a(n, m)
    call random_number(a)
    a = 2.0_wp*a - one
  end function random_matrix

  subroutine judge(error, bound, what)
    real(wp), intent(in) :: error, bound
    character(*), intent(in) :: what
    if (shown) print '(2x, a, t66, es9.2, a, es8.1)', what, error, '  allowed', bound
    call check_close(error, zero, bound, what)
  end subroutine judge

  !> f = dW/dU by differences of fourth order: 1e-11 by rounding, 1e-9 by the law of nearly
  !> incompressible ones.
  subroutine test_derivative(solid, u, label)
    type(solid_t), intent(in) :: solid
    real(wp), intent(in) :: u(:, :)
    character(*), intent(in) :: label
    real(wp), dimension(size(u, 1), size(u, 2)) :: f, other, v
    real(wp), parameter :: h = 2.0e-4_wp
    integer :: i, j
    call element_force(solid, 1, force_rule_t(kind=force_ends, before=one, now=zero), u, u, f)
    do j = 1, size(u, 2)
      do i = 1, size(u, 1)
        v = zero
        v(i, j) = h
        other(i, j) = (8.0_wp*(element_energy(solid, 1, u + v) &
            - element_energy(solid, 1, u - v)) - (element_energy(solid, 1, u + 2*v) &
            - element_energy(solid, 1, u - 2*v)))/(12*h)
      end do
    end do
    call judge(maxval(abs(f - other))/maxval(abs(f)), 1.0e-7_wp, label//': force')
  end subroutine test_derivative

  !> Tangents of the forces that have an exact one.
  subroutine test_tangents(solid, u, x, label)
    type(solid_t), intent(in) :: solid
    real(wp), intent(in) :: u(:, :), x(:, :)
    character(*), intent(in) :: label
    call test_tangent(solid, force_rule_t(kind=force_ends, before=0.4_wp, now=0.6_wp), u, x, &
        label//': ends')
    call test_tangent(solid, force_rule_t(kind=force_middle), u, x, label//': middle')
  end subroutine test_tangents

  subroutine test_tangent(solid, rule, u, x, label)
    type(solid_t), intent(in) :: solid
    type(force_rule_t), intent(in) :: rule
    real(wp), intent(in) :: u(:, :), x(:, :)
    character(*), intent(in) :: label
    real(wp), dimension(size(u), size(u)) :: ke, other
    real(wp) :: v(size(u, 1), size(u, 2)), f(size(u, 1), size(u, 2), 4)
    real(wp), parameter :: h = 1.0e-4_wp
    integer :: i, j, column
    call element_tangent(solid, 1, rule, u, x, ke)
    do j = 1, size(u, 2)
      do i = 1, size(u, 1)
        column = size(u, 1)*(j - 1) + i
        v = zero
        v(i, j) = h
        call element_force(solid, 1, rule, u, x + v, f(:, :, 1))
        call element_force(solid, 1, rule, u, x - v, f(:, :, 2))
        call element_force(solid, 1, rule, u, x + 2*v, f(:, :, 3))
        call element_force(solid, 1, rule, u, x - 2*v, f(:, :, 4))
        other(:, column) = reshape((8.0_wp*(f(:, :, 1) - f(:, :, 2)) &
            - (f(:, :, 3) - f(:, :, 4)))/(12*h), [size(u)])
      end do
    end do
    call judge(maxval(abs(ke - other))/maxval(abs(ke)), 5.0e-7_wp, label)
    call judge(maxval(abs(ke - transpose(ke)))/maxval(abs(ke)), 1.0e-13_wp, &
        label//', symmetric')
  end subroutine test_tangent

  !> Its work is the change of the energy and the plastic work, its resultant and its moment
  !> about the middle positions are zero: round-off of some hundred terms.
  subroutine test_conserving(solid, place, u, x, label)
    type(solid_t), intent(in) :: solid
    real(wp), intent(in) :: place(:, :), u(:, :), x(:, :)
    character(*), intent(in) :: label
    real(wp) :: f(size(u, 1), size(u, 2)), change, scale, moment(3), middle(3), force(3)
    type(solid_t) :: after
    integer :: a
    call element_force(solid, 1, force_rule_t(kind=force_conserving), u, x, f)
    change = element_energy(solid, 1, u + x) - element_energy(solid, 1, u)
    after = solid
    call commit_step(after, u + x)
    associate (row => solid%material%work_state)
      if (row > 0) change = change + dot_product(solid%weight(:, 1), &
          after%history(row, :, 1) - solid%history(row, :, 1))
    end associate
    scale = maxval(abs(f))
    call judge(abs(sum(f*x) - change)/scale, 1.0e-13_wp, label//': conserving, work')
    if (solid%plane == axisymmetric) then    ! along the axis alone
      call judge(abs(sum(f(2, :)))/scale, 1.0e-13_wp, label//': conserving, resultant')
      return
    end if
    call judge(maxval(abs(sum(f, dim=2)))/scale, 1.0e-13_wp, label//': conserving, resultant')
    moment = zero
    do a = 1, size(u, 2)
      middle = zero
      force = zero
      middle(:size(u, 1)) = place(:, a) + u(:, a) + half*x(:, a)
      force(:size(u, 1)) = f(:, a)
      moment = moment + [middle(2)*force(3) - middle(3)*force(2), &
          middle(3)*force(1) - middle(1)*force(3), middle(1)*force(2) - middle(2)*force(1)]
    end do
    call judge(maxval(abs(moment))/scale, 1.0e-13_wp, label//': conserving, moment')
  end subroutine test_conserving

  !> A quarter turn about z, far away: no force. Around an axis a motion along it.
  subroutine test_rigid(solid, place, label)
    type(solid_t), intent(in) :: solid
    real(wp), intent(in) :: place(:, :)
    character(*), intent(in) :: label
    real(wp) :: u(size(place, 1), size(place, 2)), f(size(place, 1), size(place, 2))
    u = zero
    u(1, :) = -place(2, :) - place(1, :)
    u(2, :) = place(1, :) - place(2, :)
    if (solid%plane == axisymmetric) then
      u(1, :) = zero
      u(2, :) = 1.0e3_wp
    end if
    call element_force(solid, 1, force_rule_t(kind=force_ends, before=one, now=zero), u, u, f)
    call judge(maxval(abs(f)), 1.0e-10_wp, label//': a quarter turn')
  end subroutine test_rigid

end program test_solid
