! SPDX-License-Identifier: BSD-3-Clause
!> Laws at finite strain: stresses and moduli are derivatives of the energy, laws are isotropic,
!> keep their digits at small strain and give the moduli of their cards at none.
program test_laws
  use base_kinds, only: wp, zero, one, two, half
  use check, only: test_start, test_end, check_true, check_close, seed_random
  use law_cases, only: case_t, qp, shear, make_cases, random_strain, random_axes, turned, &
      energy_in_quad, bulk_modulus
  use law_differences, only: derivative_of_energy, derivative_of_stress, flowed
  use material_base, only: in_space, has_value
  implicit none
  type(case_t), allocatable :: cases(:)
  logical :: shown
  integer :: k

  call test_start('laws')
  call seed_random(4711)
  call get_environment_variable('SHOW', status=k)
  shown = k == 0
  call make_cases(cases)
  do k = 1, size(cases)
    call test_derivatives(cases(k))
    call test_reference(cases(k))
    call test_turned(cases(k))
    call test_near_stretches(cases(k))
    call test_no_value(cases(k))
    call test_small(cases(k))
  end do
  call test_end()

contains

  !> A figure beside its bound, where asked for.
  subroutine judge(error, bound, what)
    real(wp), intent(in) :: error, bound
    character(*), intent(in) :: what
    if (shown) print '(2x, a, t56, es9.2, a, es8.1)', what, error, '  allowed', bound
    call check_close(error, zero, bound, what)
  end subroutine judge

  !> At 37 random states, those of plastic laws after a step of flow and in another one: S
  !> against differences of the energy (where nothing flows), D against those of S, D symmetric.
  !> Differences of fourth order with steps of 2e-5: 1e-11 by rounding.
  subroutine test_derivatives(case)
    type(case_t), intent(in) :: case
    real(wp) :: e(6), s(6), d(6, 6), w, worst(3), other(6), other_d(6, 6)
    real(wp) :: old(case%law%states), new(case%law%states)
    integer :: trial, flowing
    worst = zero
    flowing = 0
    do trial = 1, 37
      e = random_strain(0.35_wp)
      old = zero
      if (case%is_plastic) old = flowed(case%law, random_strain(0.1_wp))
      call case%law%respond(e, old, .true., s, d, w, new)
      other_d = derivative_of_stress(case%law, e, old)
      worst(2) = max(worst(2), maxval(abs(other_d - d))/maxval(abs(d)))
      worst(3) = max(worst(3), maxval(abs(d - transpose(d)))/maxval(abs(d)))
      if (case%is_plastic) then
        if (new(size(new)) > old(size(old))) flowing = flowing + 1
        e = e*1.0e-3_wp
        old = zero
        call case%law%respond(e, old, .false., s, d, w, new)
      end if
      other = derivative_of_energy(case%law, e, old)
      worst(1) = max(worst(1), maxval(abs(other - s))/maxval(abs(s)))
    end do
    call judge(worst(1), 5.0e-7_wp, 'S of '//case%name)
    call judge(worst(2), 5.0e-7_wp, 'D of '//case%name)
    call judge(worst(3), 1.0e-14_wp, 'symmetry of D of '//case%name)
    if (case%is_plastic) call check_true(flowing >= 30, 'most states flow: '//case%name)
  end subroutine test_derivatives

  !> No strain, no stress, no energy, to the last bit; the moduli there are the linear ones, G
  !> and K those of the card.
  subroutine test_reference(case)
    type(case_t), intent(in) :: case
    real(wp) :: e(6), s(6), d(6, 6), w, linear(6, 6)
    real(wp) :: old(case%law%states), new(case%law%states)
    e = zero
    old = zero
    call case%law%respond(e, old, .true., s, d, w, new)
    call check_true(.not. max(maxval(abs(s)), abs(w)) > zero, 'nothing at rest: '//case%name)
    linear = case%law%moduli(in_space)
    call judge(maxval(abs(d - linear))/maxval(abs(d)), 1.0e-10_wp, 'D(0) of '//case%name)
    call judge(abs(d(4, 4) - shear)/shear, 1.0e-13_wp, 'G of '//case%name)
    call judge(abs(sum(d(:3, 1))/(3.0_wp*bulk_modulus(shear, case%nu)) - one), 1.0e-12_wp, &
        'K of '//case%name)
    call check_true(case%law%is_finite .and. (case%law%is_linear .eqv. &
        (case%name == 'elastic' .or. case%name == 'hencky')), 'its flags: '//case%name)
  end subroutine test_reference

  !> Strain (and history) in other axes: so are stress and history, and energy is the same. A
  !> quarter turn about the third axis takes 11 to 22 exactly.
  subroutine test_turned(case)
    type(case_t), intent(in) :: case
    real(wp), parameter :: quarter(3, 3) = reshape([zero, one, zero, -one, zero, zero, zero, &
        zero, one], [3, 3])
    real(wp) :: e(6), s(6), d(6, 6), w, other(6), other_w, r(3, 3), error
    real(wp), dimension(case%law%states) :: old, new, other_old, other_new
    integer :: trial, n, m
    n = case%law%states
    error = zero
    do trial = 1, 20
      r = random_axes()
      if (trial == 1) r = quarter
      e = random_strain(0.35_wp)
      old = zero
      if (case%is_plastic) old = flowed(case%law, random_strain(0.1_wp))
      other_old = old
      do m = 1, 6*((n - 1)/6), 6
        other_old(m:m + 5) = turned(old(m:m + 5), r, one)
      end do
      call case%law%respond(e, old, .false., s, d, w, new)
      call case%law%respond(turned(e, r, two), other_old, .false., other, d, other_w, other_new)
      error = max(error, maxval(abs(other - turned(s, r, one)))/maxval(abs(s)), &
          abs(other_w - w)/w)
      do m = 1, 6*((n - 1)/6), 6
        error = max(error, maxval(abs(other_new(m:m + 5) - turned(new(m:m + 5), r, one))) &
            /max(maxval(abs(new(m:m + 5))), 1.0e-3_wp))
      end do
      if (trial == 1) call check_close(other(1), s(2), 1.0e-12_wp, &
          'a quarter turn of '//case%name, maxval(abs(s)))
    end do
    call judge(error, 1.0e-11_wp, 'turned axes of '//case%name)
  end subroutine test_turned

  !> Two and three stretches that are equal or nearly so: D is the derivative there too.
  subroutine test_near_stretches(case)
    type(case_t), intent(in) :: case
    real(wp), parameter :: gaps(11) = [zero, 1.0e-15_wp, 1.0e-12_wp, 1.0e-9_wp, 1.0e-7_wp, &
        1.0e-6_wp, 1.0e-5_wp, 1.0e-4_wp, 1.0e-3_wp, 3.0e-3_wp, 1.0e-2_wp]
    real(wp) :: e(6), s(6), d(6, 6), w, error, other_d(6, 6)
    real(wp) :: old(case%law%states), new(case%law%states)
    integer :: g, kind
    error = zero
    do g = 1, size(gaps)
      do kind = 1, 2
        e = [0.2_wp, 0.2_wp + gaps(g), 0.2_wp + half*gaps(g), zero, zero, zero]
        if (kind == 2) e(3) = -0.1_wp
        e = turned(e, random_axes(), two)
        old = zero
        if (case%is_plastic) old = flowed(case%law, random_strain(0.1_wp))
        call case%law%respond(e, old, .true., s, d, w, new)
        other_d = derivative_of_stress(case%law, e, old)
        error = max(error, maxval(abs(other_d - d))/maxval(abs(d)))
      end do
    end do
    call judge(error, 5.0e-7_wp, 'near stretches of '//case%name)
  end subroutine test_near_stretches

  !> A point turned inside out has no value, and no trap; the history stays.
  subroutine test_no_value(case)
    type(case_t), intent(in) :: case
    real(wp) :: e(6), s(6), d(6, 6), w
    real(wp) :: old(case%law%states), new(case%law%states)
    if (case%law%is_quadratic) return
    e = [-0.6_wp, 0.1_wp, zero, zero, 0.1_wp, zero]
    old = 0.01_wp
    call case%law%respond(e, old, .true., s, d, w, new)
    call check_true(.not. (has_value(w) .or. any(has_value(s)) .or. any(has_value(d))), &
        'no value: '//case%name)
    call check_true(all(abs(new - old) <= zero), 'history without a value: '//case%name)
    call case%law%respond([-half, zero, zero, zero, zero, zero], old, .false., s, d, w, new)
    call check_true(.not. has_value(w), 'no value at det C = 0: '//case%name)
  end subroutine test_no_value

  !> Energy and stress at small strain keep all digits, but for those lost in K beside G:
  !> against the energy written in C, in 33 digits, of which 16 are left at 1e-8, and its
  !> differences, which have 12.
  subroutine test_small(case)
    type(case_t), intent(in) :: case
    real(wp) :: e(6), s(6), d(6, 6), w, error(2), size_of
    real(wp) :: old(case%law%states), new(case%law%states)
    real(qp) :: exact, step, moved(6), slope(6)
    character(8) :: text
    integer :: m, trial, i
    do m = -8, -2, 2
      size_of = 10.0_wp**m
      error = zero
      do trial = 1, 5
        call random_number(e)
        e = size_of*(two*e - one)
        if (trial == 5) e = size_of*[one, -one, zero, half, zero, zero]
        old = zero
        call case%law%respond(e, old, .false., s, d, w, new)
        if (case%is_plastic) then
          if (new(size(new)) > zero) cycle
        end if
        exact = energy_in_quad(case, real(e, qp))
        error(1) = max(error(1), real(abs(w - exact)/exact, wp))
        step = min(1.0e-5_qp*size_of, 1.0e-10_qp)
        do i = 1, 6
          moved = e
          moved(i) = moved(i) + step
          slope(i) = energy_in_quad(case, moved)
          moved(i) = moved(i) - 2*step
          slope(i) = (slope(i) - energy_in_quad(case, moved))/(2*step)
        end do
        error(2) = max(error(2), real(maxval(abs(s - slope))/maxval(abs(slope)), wp))
      end do
      write (text, '(es8.1)') size_of
      call judge(error(1), 2.0e-14_wp, 'W at strain'//text//' of '//case%name)
      call judge(error(2), 1.0e-12_wp, 'S at strain'//text//' of '//case%name)
    end do
  end subroutine test_small

end program test_laws
