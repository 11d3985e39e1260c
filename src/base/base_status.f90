! SPDX-License-Identifier: BSD-3-Clause
!> The one way to report a failure: what happened, where, and what to do about it.
!> The codes are the exit codes of the programs.
module base_status
  implicit none
  private
  integer, parameter, public :: status_ok = 0
  integer, parameter, public :: status_numerical = 1
  integer, parameter, public :: status_deck = 2
  integer, parameter, public :: status_file = 3
  integer, parameter, public :: status_stopped = 4

  type, public :: status_t
    integer :: code = status_ok
    character(:), allocatable :: message
    character(:), allocatable :: place
    character(:), allocatable :: hint
  end type status_t

  public :: fail, failed, add_place, status_text

contains

  !> Records a failure; the first one wins, so that a cause is never hidden by its consequence.
  pure subroutine fail(status, code, message, place, hint)
    type(status_t), intent(inout) :: status
    integer, intent(in) :: code
    character(*), intent(in) :: message
    character(*), intent(in), optional :: place
    character(*), intent(in), optional :: hint
    if (failed(status)) return
    status%code = code
    status%message = message
    if (present(place)) status%place = place
    if (present(hint)) status%hint = hint
  end subroutine fail

  !> True once a failure has been recorded.
  pure logical function failed(status)
    type(status_t), intent(in) :: status
    failed = status%code /= status_ok
  end function failed

  !> Adds where it happened, known only to a caller further up (the step, the time).
  pure subroutine add_place(status, place)
    type(status_t), intent(inout) :: status
    character(*), intent(in) :: place
    if (.not. failed(status)) return
    if (allocated(status%place)) then
      status%place = place//', '//status%place
    else
      status%place = place
    end if
  end subroutine add_place

  !> The failure as text for a person: "place: message", then the hint on a line of its own.
  pure function status_text(status) result(text)
    type(status_t), intent(in) :: status
    character(:), allocatable :: text
    text = ''
    if (.not. failed(status)) return
    text = status%message
    if (allocated(status%place)) text = status%place//': '//text
    if (allocated(status%hint)) text = text//new_line('a')//'    hint: '//status%hint
  end function status_text

end module base_status
