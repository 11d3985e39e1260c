! SPDX-License-Identifier: BSD-3-Clause
!> A rigid circle around its body's node: a disc, or the bowl around it.
module contact_cylinder
  use base_kinds, only: wp, zero, one
  use contact_obstacle, only: obstacle_t
  use model_data, only: wall_t
  implicit none
  private

  type, extends(obstacle_t), public :: cylinder_t
    real(wp) :: radius = zero             !< [L]
    real(wp) :: sign = one                !< 1 of a disc, -1 of a bowl
  contains
    procedure :: set_shape => cylinder_set_shape
    procedure :: distance => cylinder_distance
    procedure :: place => cylinder_place
    procedure :: mean_normal => cylinder_mean_normal
  end type cylinder_t

contains

  !> A disc may touch an edge between its nodes.
  subroutine cylinder_set_shape(this, wall)
    class(cylinder_t), intent(inout) :: this
    type(wall_t), intent(in) :: wall
    this%radius = wall%radius
    this%sign = merge(-one, one, wall%is_interior)
    this%is_curved = .true.
    if (wall%is_interior) return
    allocate (this%tips%at(2, 1), source=zero)
    this%tips%radius = wall%radius
  end subroutine cylinder_set_shape

  pure real(wp) function cylinder_distance(this, p)
    class(cylinder_t), intent(in) :: this
    real(wp), intent(in) :: p(2)
    cylinder_distance = this%sign*(norm2(p) - this%radius)
  end function cylinder_distance

  pure subroutine cylinder_place(this, p, gap, normal, is_there)
    class(cylinder_t), intent(in) :: this
    real(wp), intent(in) :: p(2)
    real(wp), intent(out) :: gap, normal(2)
    logical, intent(out) :: is_there
    gap = this%distance(p)
    normal = this%sign*p/max(norm2(p), tiny(one))
    is_there = .true.
  end subroutine cylinder_place

  !> (p + q).(q - p) = |q|^2 - |p|^2.
  pure function cylinder_mean_normal(this, p, q) result(m)
    class(cylinder_t), intent(in) :: this
    real(wp), intent(in) :: p(2), q(2)
    real(wp) :: m(2)
    m = this%sign*(p + q)/max(norm2(p) + norm2(q), tiny(one))
  end function cylinder_mean_normal

end module contact_cylinder
