! SPDX-License-Identifier: BSD-3-Clause
!> Models turned about the y axis: what their mesh must be, what has no meaning there, and the
!> nodes on the axis, which stay there.
module scene_axis
  use base_kinds, only: wp, zero
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_note, full
  use model_data, only: model_t
  use scene_ids, only: records_of
  implicit none
  private
  public :: check_axis, hold_axis

contains

  !> No node left of the axis, and no mass DISPERSION. A node as near to the axis as the
  !> rounding of the others is on it.
  subroutine check_axis(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    real(wp), parameter :: rounding = 1.0e-12_wp
    integer, allocatable :: record(:)
    real(wp) :: near
    integer :: k
    if (.not. model%is_axisymmetric) return
    if (model%controls%mass == 'DISPERSION') call deck%complain(deck%next('BIPACT_MASS', 1, &
        0), 'TYPE', 'DISPERSION is tuned to plane waves: it is not available around an axis', &
        'take CONSISTENT or LUMPED')
    call records_of(deck, 'NODE', 1, record)
    near = rounding*maxval(abs(model%x(1, :)))
    do k = 1, model%nodes
      if (abs(model%x(1, k)) <= near) model%x(1, k) = zero
      if (model%x(1, k) >= zero) cycle
      call deck%complain(record(k), 'X', 'node '//to_text(model%node_id(k))//' is at x = '// &
          to_text(model%x(1, k))//': x is the radius around the y axis, expected x >= 0')
      if (full(deck%problems)) return
    end do
  end subroutine check_axis

  !> Nodes on the axis do not leave it. Supports must have been read.
  subroutine hold_axis(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    integer :: n
    if (.not. model%is_axisymmetric) return
    n = count(.not. (model%x(1, :) > zero .or. model%fixed(1, :)))
    if (n == 0) return
    where (.not. model%x(1, :) > zero) model%fixed(1, :) = .true.
    call add_note(deck%problems, to_text(n)//trim(merge(' node is  ', ' nodes are', n == 1))// &
        ' on the axis and held there in x')
  end subroutine hold_axis

end module scene_axis
