! SPDX-License-Identifier: BSD-3-Clause
!> Differences of energies and stresses, of fourth order.
module law_differences
  use base_kinds, only: wp, zero
  use material_base, only: material_t, in_space
  use material_plane, only: respond_as
  implicit none
  private
  real(wp), parameter :: step = 2.0e-5_wp
  real(wp), parameter :: at(4) = [-2.0_wp, -1.0_wp, 1.0_wp, 2.0_wp]
  real(wp), parameter :: weight(4) = [1.0_wp, -8.0_wp, 8.0_wp, -1.0_wp]/12.0_wp

  public :: derivative_of_energy, derivative_of_stress, flowed

contains

  !> dW/de of a law, in space unless a plane is given.
  function derivative_of_energy(law, e, old, plane) result(s)
    class(material_t), intent(in) :: law
    real(wp), intent(in) :: e(:), old(:)
    integer, intent(in), optional :: plane
    real(wp) :: s(size(e)), w, moved(size(e)), other(size(e)), d(size(e), size(e))
    real(wp) :: new(size(old))
    integer :: i, k
    s = zero
    do i = 1, size(e)
      do k = 1, 4
        moved = e
        moved(i) = e(i) + at(k)*step
        call respond(law, moved, old, other, d, w, new, plane)
        s(i) = s(i) + weight(k)*w/step
      end do
    end do
  end function derivative_of_energy

  !> dS/de.
  function derivative_of_stress(law, e, old, plane) result(d)
    class(material_t), intent(in) :: law
    real(wp), intent(in) :: e(:), old(:)
    integer, intent(in), optional :: plane
    real(wp) :: d(size(e), size(e)), w, moved(size(e)), s(size(e)), none(size(e), size(e))
    real(wp) :: new(size(old))
    integer :: i, k
    d = zero
    do i = 1, size(e)
      do k = 1, 4
        moved = e
        moved(i) = e(i) + at(k)*step
        call respond(law, moved, old, s, none, w, new, plane)
        d(:, i) = d(:, i) + weight(k)*s/step
      end do
    end do
  end function derivative_of_stress

  subroutine respond(law, e, old, s, d, w, new, plane)
    class(material_t), intent(in) :: law
    real(wp), intent(in) :: e(:), old(:)
    real(wp), intent(out) :: s(:), d(:, :), w, new(:)
    integer, intent(in), optional :: plane
    integer :: form
    form = in_space
    if (present(plane)) form = plane
    call respond_as(law, form, e, old, .false., s, d, w, new)
  end subroutine respond

  !> History after one step to a strain.
  function flowed(law, e) result(new)
    class(material_t), intent(in) :: law
    real(wp), intent(in) :: e(6)
    real(wp) :: new(law%states), old(law%states), s(6), d(6, 6), w
    old = zero
    call law%respond(e, old, .false., s, d, w, new)
  end function flowed

end module law_differences
