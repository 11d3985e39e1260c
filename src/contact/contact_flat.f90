! SPDX-License-Identifier: BSD-3-Clause
!> A flat rigid obstacle: the whole plane through its body's node, or a piece of it, which is
!> then a sheet whose ends are tips.
module contact_flat
  use base_kinds, only: wp, zero, one
  use contact_obstacle, only: obstacle_t
  use model_data, only: wall_t
  implicit none
  private

  type, extends(obstacle_t), public :: flat_t
    real(wp) :: ahead(2) = zero           !< normal, toward the bodies
    real(wp) :: along(2) = zero           !< from the node to the other end
    real(wp) :: length = zero             !< [L]; 0 = without ends
  contains
    procedure :: set_shape => flat_set_shape
    procedure :: distance => flat_distance
    procedure :: place => flat_place
    procedure :: mean_normal => flat_mean_normal
  end type flat_t

  !> A node at an end stands before the wall, to the digits of a deck [/ length].
  real(wp), parameter :: end_tolerance = 1.0e-8_wp

contains

  subroutine flat_set_shape(this, wall)
    class(flat_t), intent(inout) :: this
    type(wall_t), intent(in) :: wall
    this%ahead = wall%normal(:2)
    this%along = wall%along
    this%length = wall%length
    this%is_guided = wall%mass > zero
    this%is_sheet = wall%length > zero
    if (.not. this%is_sheet) return
    allocate (this%tips%at(2, 2), source=zero)
    this%tips%at(:, 2) = wall%length*wall%along
  end subroutine flat_set_shape

  pure real(wp) function flat_distance(this, p)
    class(flat_t), intent(in) :: this
    real(wp), intent(in) :: p(2)
    real(wp) :: s
    flat_distance = dot_product(this%ahead, p)
    if (.not. this%is_sheet) return
    s = dot_product(this%along, p)
    flat_distance = norm2(p - min(this%length, max(zero, s))*this%along)
  end function flat_distance

  pure subroutine flat_place(this, p, gap, normal, is_there)
    class(flat_t), intent(in) :: this
    real(wp), intent(in) :: p(2)
    real(wp), intent(out) :: gap, normal(2)
    logical, intent(out) :: is_there
    real(wp) :: s
    gap = dot_product(this%ahead, p)
    normal = this%ahead
    is_there = .true.
    if (.not. this%is_sheet) return
    s = dot_product(this%along, p)/this%length
    is_there = s >= -end_tolerance .and. s <= one + end_tolerance
  end subroutine flat_place

  pure function flat_mean_normal(this, p, q) result(m)
    class(flat_t), intent(in) :: this
    real(wp), intent(in) :: p(2), q(2)
    real(wp) :: m(2)
    m = this%ahead
  end function flat_mean_normal

end module contact_flat
