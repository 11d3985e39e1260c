! SPDX-License-Identifier: BSD-3-Clause
!> Interference that is pushed out in a static phase: bodies overlap at the start, node i by
!> g_i < 0, and its gap at time t may not be below the floor (1 - t/T) g_i. At T the bodies
!> touch; what pushing them apart takes is the work of the floor that moves.
module contact_ramp
  use base_kinds, only: wp, zero, one
  use contact_places, only: place_t
  implicit none
  private

  type, public :: ramp_t
    real(wp), allocatable :: start(:)    !< (nodes) gaps at the start, not above 0 [L]
    logical :: is_known = .false.        !< they have been found
    real(wp) :: duration = one           !< T [T]
    real(wp) :: left = one               !< 1 - t/T at the end of the step
    real(wp) :: left_before = one        !< at its start
  end type ramp_t

  public :: make_ramp, set_ramp, raise_places, ramp_floor, ramp_push, ramp_depth

contains

  !> A ramp over the time duration [T] for the nodes of a model.
  pure subroutine make_ramp(ramp, nodes, duration)
    type(ramp_t), intent(inout) :: ramp
    integer, intent(in) :: nodes
    real(wp), intent(in) :: duration
    allocate (ramp%start(nodes), source=zero)
    ramp%duration = duration
  end subroutine make_ramp

  !> For the step from t0 to t1.
  pure subroutine set_ramp(ramp, t0, t1)
    type(ramp_t), intent(inout) :: ramp
    real(wp), intent(in) :: t0, t1
    ramp%left_before = min(one, max(zero, one - t0/ramp%duration))
    ramp%left = min(one, max(zero, one - t1/ramp%duration))
  end subroutine set_ramp


  !> Gaps of places above the floors of their nodes; the first are those of the start.
  pure subroutine raise_places(ramp, place)
    type(ramp_t), intent(inout) :: ramp
    type(place_t), intent(inout) :: place(:)
    integer :: j
    if (.not. ramp%is_known) then
      do j = 1, size(place)
        ramp%start(place(j)%node) = min(ramp%start(place(j)%node), place(j)%gap)
      end do
      ramp%is_known = .true.
    end if
    do j = 1, size(place)
      place(j)%gap = place(j)%gap - ramp_floor(ramp, place(j)%node)
    end do
  end subroutine raise_places

  !> What the gap of a node may be at the end of the step [L].
  pure real(wp) function ramp_floor(ramp, node)
    type(ramp_t), intent(in) :: ramp
    integer, intent(in) :: node
    ramp_floor = ramp%left*ramp%start(node)
  end function ramp_floor

  !> By how much the floor of a node rises in the step [L].
  pure real(wp) function ramp_push(ramp, node)
    type(ramp_t), intent(in) :: ramp
    integer, intent(in) :: node
    ramp_push = (ramp%left - ramp%left_before)*ramp%start(node)
  end function ramp_push

  !> The deepest overlap that may be left at the end of the step [L].
  pure real(wp) function ramp_depth(ramp)
    type(ramp_t), intent(in) :: ramp
    ramp_depth = -ramp%left*minval(ramp%start)
  end function ramp_depth

end module contact_ramp
