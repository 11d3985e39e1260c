! SPDX-License-Identifier: BSD-3-Clause
!> Where within a step that has been solved the first open contact has closed, for a run that
!> cuts such steps. Schemes that pose contact on positions: u_n of a row is its gap at the end.
module contact_touch
  use base_kinds, only: wp, zero, one
  use contact_types, only: contact_t
  implicit none
  private

  !> A contact that closes: its row, and its gap at the start of the step and at the end, less
  !> what the reactions of closing contacts do.
  type, public :: touch_t
    integer :: key(4) = 0
    real(wp) :: gap = zero, free_gap = zero  !< [L]
    real(wp) :: share = one                  !< of the step where it touches, if gaps are linear
  end type touch_t

  public :: find_touch, gap_at_end

contains

  !> The first contact that the step has closed; its share is 1 where there is none.
  pure subroutine find_touch(contact, touch)
    type(contact_t), intent(in) :: contact
    type(touch_t), intent(out) :: touch
    real(wp) :: gap, free, share
    integer :: k
    if (contact%rows%n == 0) return
    do k = 1, contact%n
      if (.not. closes(contact, k)) cycle
      gap = contact%rows%offset(contact%row_of(k))
      free = free_gap(contact, k)
      if (.not. free < zero) cycle
      share = gap/(gap - free)
      if (share < touch%share) touch = touch_t(contact%rows%key(:, contact%row_of(k)), gap, &
          free, share)
    end do
  end subroutine find_touch

  !> The gap [L] of the same contact at the end of another step from the same start, without
  !> the reactions of contacts that this one has closed; that of a step that ends at the touch,
  !> zero, where the contact is not found.
  pure real(wp) function gap_at_end(contact, touch)
    type(contact_t), intent(in) :: contact
    type(touch_t), intent(in) :: touch
    integer :: k
    gap_at_end = zero
    if (contact%rows%n == 0) return
    do k = 1, contact%n
      if (all(contact%rows%key(:, contact%row_of(k)) == touch%key)) &
          gap_at_end = free_gap(contact, k)
    end do
  end function gap_at_end

  !> Has contact k of the condensed problem been open, beyond round-off of a touch, and does it
  !> push now?
  pure logical function closes(contact, k)
    type(contact_t), intent(in) :: contact
    integer, intent(in) :: k
    associate (rows => contact%rows, a => contact%row_of(k))
      closes = rows%r(1, a) > zero .and. &
          rows%offset(a) > contact%penetration_tolerance*rows%length(a)
    end associate
  end function closes

  !> u_n of contact k less W r of those that close [L].
  pure real(wp) function free_gap(contact, k)
    type(contact_t), intent(in) :: contact
    integer, intent(in) :: k
    integer :: j, d
    d = contact%d
    free_gap = contact%rows%u(1, contact%row_of(k))
    do j = 1, contact%n
      if (closes(contact, j)) free_gap = free_gap - contact%rule%factor*dot_product( &
          contact%w%matrix(d*(k - 1) + 1, d*(j - 1) + 1:d*j), &
          contact%rows%r(1:d, contact%row_of(j)))
    end do
  end function free_gap

end module contact_touch
