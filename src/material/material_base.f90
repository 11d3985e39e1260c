! SPDX-License-Identifier: BSD-3-Clause
!> What a material offers to an element: plain numbers, no mesh.
module material_base
  use base_kinds, only: wp, i8
  implicit none
  private
  integer, parameter, public :: plane_stress = 12
  integer, parameter, public :: plane_strain = 13
  integer, parameter, public :: axisymmetric = 15
  integer, parameter, public :: in_space = 3

  !> What a law gives where it has no value: a quiet NaN, made from its bits, for an invalid
  !> operation would trap. It may be copied and calculated with, but a comparison would trap
  !> too: ask has_value first.
  integer(i8), parameter :: exponent_bits = 9218868437227405312_i8
  real(wp), parameter, public :: no_value = transfer(9221120237041090560_i8, 1.0_wp)
  public :: has_value, leave_undefined, strains_in

  type, abstract, public :: material_t
    integer :: id = 0
    real(wp) :: density = 0.0_wp   !< [M/L3]
    logical :: is_rigid = .false.
    logical :: is_linear = .true.      !< takes part in decks of small displacements
    logical :: is_finite = .false.     !< has a law at finite strain, RESPOND
    logical :: is_quadratic = .false.  !< its energy is a quadratic form of Green's strain
    logical :: mean_dilatation = .false.   !< nearly incompressible, or flows without volume
    integer :: states = 0              !< history variables of a point
    !> Principal stretches below which the law is doubtful, and below which it is refused.
    real(wp) :: doubtful_stretch = 0.0_wp, least_stretch = 0.0_wp
    !> Which of them are the plastic work [F/L2] and the equivalent plastic strain; 0 = none.
    integer :: work_state = 0, strain_state = 0
  contains
    procedure(moduli_i), deferred :: moduli
    procedure(speed_i), deferred :: wave_speed
    procedure(across_i), deferred :: out_of_plane_stress
    procedure :: respond => no_response
  end type material_t

  !> A material in a list of materials of several kinds.
  type, public :: material_slot_t
    class(material_t), allocatable :: item
  end type material_slot_t

  abstract interface
    !> Elastic matrix D [F/L2]: (3, 3) for (exx, eyy, gxy) in plane strain or plane stress, (4,
    !> 4) for (exx, eyy, gxy, ezz) around an axis, (6, 6) for (exx, eyy, ezz, gxy, gyz, gzx) in
    !> space.
    pure function moduli_i(this, plane) result(d)
      import :: material_t, wp, strains_in
      class(material_t), intent(in) :: this
      integer, intent(in) :: plane
      real(wp) :: d(strains_in(plane), strains_in(plane))
    end function moduli_i
    !> Speed of pressure waves in this law, plane ones [L/T].
    pure function speed_i(this, plane) result(c)
      import :: material_t, wp
      class(material_t), intent(in) :: this
      integer, intent(in) :: plane
      real(wp) :: c
    end function speed_i
    !> Stress szz [F/L2] that goes with (sxx, syy, sxy) in plane strain or plane stress.
    pure function across_i(this, plane, stress) result(szz)
      import :: material_t, wp
      class(material_t), intent(in) :: this
      integer, intent(in) :: plane
      real(wp), intent(in) :: stress(3)
      real(wp) :: szz
    end function across_i
  end interface

contains

  !> Strains of an element in the plane, around an axis or in space.
  pure integer function strains_in(plane)
    integer, intent(in) :: plane
    select case (plane)
    case (in_space)
      strains_in = 6
    case (axisymmetric)
      strains_in = 4
    case default
      strains_in = 3
    end select
  end function strains_in

  !> The law at finite strain, in space: from Green's strain e = (E11, E22, E33, 2 E12, 2 E23, 2
  !> E31) and the history of the last accepted step, old (states): second Piola-Kirchhoff stress
  !> s = (S11, S22, S33, S12, S23, S31) [F/L2], moduli d = ds/de (6, 6) [F/L2] where they are
  !> asked for, strain energy per reference volume [F/L2], and the history new. Where the law
  !> has no value (det C <= 0, a stretch that overflows) s, d and energy are no_value, a quiet
  !> NaN, and new = old. Laws with is_finite have their own.
  pure subroutine no_response(this, e, old, with_moduli, s, d, energy, new)
    class(material_t), intent(in) :: this
    real(wp), intent(in) :: e(6), old(:)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: s(6), d(6, 6), energy, new(:)
    s = 0.0_wp
    d = 0.0_wp
    energy = 0.0_wp
    new = old
  end subroutine no_response

  !> Is a number finite? By its bits: no operation on it that could trap.
  elemental logical function has_value(x)
    real(wp), intent(in) :: x
    has_value = iand(transfer(x, 0_i8), exponent_bits) /= exponent_bits
  end function has_value

  !> The answer of a law where it has no value.
  pure subroutine leave_undefined(s, d, energy)
    real(wp), intent(out) :: s(:), d(:, :), energy
    s = no_value
    d = no_value
    energy = no_value
  end subroutine leave_undefined

end module material_base
