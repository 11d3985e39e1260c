! SPDX-License-Identifier: BSD-3-Clause
!> Laws at finite strain with the strains that an element has: six in space; E11, E22, 2 E12 in
!> the plane; E11, E22, 2 E12, E33 around an axis.
module material_plane
  use base_kinds, only: wp, zero, one, two, half
  use material_base, only: material_t, in_space, plane_stress, axisymmetric, has_value, &
      leave_undefined
  use material_tensor, only: log_one_plus, exp_minus_one
  implicit none
  private
  public :: respond_as, places_of

  !> Places in (E11, E22, E33, 2 E12, 2 E23, 2 E31) of the strains in the plane, of those around
  !> an axis.
  integer, parameter :: in_plane(3) = [1, 2, 4]
  integer, parameter :: around(4) = [1, 2, 4, 3]
  integer, parameter :: across = 3

contains

  !> Where the strains of an element are among the six in space.
  pure function places_of(plane) result(place)
    integer, intent(in) :: plane
    integer, allocatable :: place(:)
    integer :: k
    select case (plane)
    case (in_space)
      place = [(k, k=1, 6)]
    case (axisymmetric)
      place = around
    case default
      place = in_plane
    end select
  end function places_of

  !> The law of a material (material_base) for the strains e (6 in space, 3 in the plane, 4
  !> around an axis): stress s, moduli d where asked for, energy per reference volume [F/L2],
  !> history new. Plane strain has E33 = 0, plane stress S33 = 0, with the moduli at S33 = 0.
  !> all_e, all_s: the six strains and stresses in space, where a caller wants them.
  pure subroutine respond_as(material, plane, e, old, with_moduli, s, d, energy, new, all_e, &
      all_s)
    class(material_t), intent(in) :: material
    integer, intent(in) :: plane
    real(wp), intent(in) :: e(:), old(:)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: s(:), d(:, :), energy, new(:)
    real(wp), intent(out), optional :: all_e(6), all_s(6)
    real(wp) :: whole_e(6), whole_s(6), whole_d(6, 6)
    whole_e = zero
    select case (plane)
    case (in_space)
      whole_e = e
      call material%respond(e, old, with_moduli, whole_s, d, energy, new)
      s = whole_s
    case (axisymmetric)
      whole_e(around) = e
      call material%respond(whole_e, old, with_moduli, whole_s, whole_d, energy, new)
      s = whole_s(around)
      if (with_moduli) d = whole_d(around, around)
    case (plane_stress)
      whole_e(in_plane) = e
      call respond_in_plane_stress(material, old, with_moduli, whole_e, whole_s, d, energy, new)
      s = whole_s(in_plane)
    case default
      whole_e(in_plane) = e
      call material%respond(whole_e, old, with_moduli, whole_s, whole_d, energy, new)
      s = whole_s(in_plane)
      if (with_moduli) d = whole_d(in_plane, in_plane)
    end select
    if (present(all_e)) all_e = whole_e
    if (present(all_s)) all_s = whole_s
  end subroutine respond_as

  !> Plane stress: the strain across, e(3), then D_ab - D_a3 D_3b/D_33. No value where that
  !> strain is not found or has no meaning.
  pure subroutine respond_in_plane_stress(material, old, with_moduli, e, s, d, energy, new)
    class(material_t), intent(in) :: material
    real(wp), intent(in) :: old(:)
    logical, intent(in) :: with_moduli
    real(wp), intent(inout) :: e(6)
    real(wp), intent(out) :: s(6), d(3, 3), energy, new(:)
    real(wp) :: whole_d(6, 6)
    logical :: found
    integer :: k
    if (material%is_quadratic) then
      whole_d = material%moduli(in_space)
      e(across) = -dot_product(whole_d(across, in_plane), e(in_plane))/whole_d(across, across)
      found = one + two*e(across) > zero
      if (found) call material%respond(e, old, with_moduli, s, whole_d, energy, new)
    else
      call find_strain_across(material, old, e, s, whole_d, energy, new, found)
    end if
    if (.not. found) then
      new = old
      call leave_undefined(s, d, energy)
      return
    end if
    if (.not. with_moduli) return
    do k = 1, 3
      d(:, k) = whole_d(in_plane, in_plane(k)) - whole_d(in_plane, across) &
          *whole_d(across, in_plane(k))/whole_d(across, across)
    end do
  end subroutine respond_in_plane_stress

  !> e(3) at which S33 = 0, by Newton's method for x = ln C33: f = S33 C33, df/dx = D3333
  !> C33^2/2 + f. It begins at the strain of small strains, -nu/(1 - nu) ln det of C in the
  !> plane, exact for the laws of Blatz and Ko; at C33 = 1 nearly incompressible laws do not
  !> converge. f increases with x: a step that leaves the bracket found so far goes to its
  !> middle.
  pure subroutine find_strain_across(material, old, e, s, d, energy, new, found)
    class(material_t), intent(in) :: material
    real(wp), intent(in) :: old(:)
    real(wp), intent(inout) :: e(6)
    real(wp), intent(out) :: s(6), d(6, 6), energy, new(:)
    logical, intent(out) :: found
    integer, parameter :: most_steps = 60
    real(wp), parameter :: longest = half, wide = 1.0e3_wp
    real(wp) :: x, f, slope, step, last, low, high, growth
    integer :: k
    found = .false.
    growth = two*(e(1) + e(2)) + 4.0_wp*e(1)*e(2) - e(4)**2
    if (.not. min(one + growth, one + two*e(1)) > zero) return
    d = material%moduli(in_space)
    x = -d(across, 1)/d(across, across)*log_one_plus(growth)
    low = -wide
    high = wide
    last = wide
    do k = 1, most_steps
      e(across) = half*exp_minus_one(x)
      call material%respond(e, old, .true., s, d, energy, new)
      if (.not. has_value(energy)) return
      f = s(across)*(one + two*e(across))
      slope = half*d(across, across)*(one + two*e(across))**2 + f
      step = sign(longest, -f)
      if (slope*longest > abs(f)) step = -f/slope
      found = has_converged(step, last, max(abs(x), maxval(abs(e))))
      if (found) return
      if (f > zero) high = x
      if (f < zero) low = x
      last = abs(step)
      x = x + step
      if (x <= low .or. x >= high) x = half*(low + high)
    end do
  end subroutine find_strain_across

  !> Is the step left to go one of rounding, or as small as they become?
  pure logical function has_converged(step, last, scale)
    real(wp), intent(in) :: step, last, scale
    real(wp), parameter :: rounding = 4.0e-16_wp, floor = 1.0e-13_wp
    has_converged = abs(step) <= rounding*scale &
        .or. (abs(step) <= floor*scale .and. abs(step) >= half*last)
  end function has_converged

end module material_plane
