! SPDX-License-Identifier: BSD-3-Clause
!> Which side of a mortar pairing carries the multipliers.
module contact_mortar_side
  use base_kinds, only: wp, zero, one
  use contact_facing, only: mark_facing
  use contact_features, only: degree
  use contact_surface, only: surface_t
  use model_data, only: model_t
  implicit none
  private
  public :: contactor_side

  real(wp), parameter :: equal_size = 1.0e-6_wp
  !> A vertex at which the boundary turns by more is a corner.
  real(wp), parameter :: sharp = 60.0_wp*degree

contains

  !> 1 or 2: of the parts of both surfaces that face each other in the reference geometry that
  !> with corners (a corner digs into a face that carries the multipliers), if only one has
  !> any; that with the longer edges on average; the first.
  integer function contactor_side(model, side)
    type(model_t), intent(in) :: model
    type(surface_t), intent(in) :: side(2)
    logical :: taken(model%nodes), has_corner(2)
    real(wp) :: mean(2)
    integer :: s
    do s = 1, 2
      taken = .false.
      call mark_facing(model, side(s), side(3 - s), taken)
      has_corner(s) = any(taken(side(s)%node) .and. side(s)%turn > sharp)
      mean(s) = mean_edge(side(s), taken)
    end do
    contactor_side = 1
    if (has_corner(1) .neqv. has_corner(2)) then
      if (has_corner(2)) contactor_side = 2
    else if (mean(2) > mean(1)*(one + equal_size)) then
      contactor_side = 2
    end if
  end function contactor_side

  !> Mean length of the edges whose nodes are taken [L]; of all where none is.
  pure real(wp) function mean_edge(surface, taken)
    type(surface_t), intent(in) :: surface
    logical, intent(in) :: taken(:)
    integer :: e, n
    n = 0
    mean_edge = zero
    do e = 1, size(surface%length)
      if (.not. surface%is_listed(e) .or. .not. all(taken(surface%end_node(:, e)))) cycle
      n = n + 1
      mean_edge = mean_edge + surface%length(e)
    end do
    mean_edge = mean_edge/max(1, n)
    if (n == 0) mean_edge = surface%mean_length
  end function mean_edge

end module contact_mortar_side
