! SPDX-License-Identifier: BSD-3-Clause
!> What there is to say beside results: notes and warnings, in the order in which they came.
module base_messages
  implicit none
  private

  type, public :: message_t
    character(:), allocatable :: kind   !< one word; empty for notes
    character(:), allocatable :: text   !< one line: what, where, what to do
    integer :: step = -1                !< at which it was first true; -1: before the first
    integer :: count = 0                !< how often it was true
    logical :: is_shown = .false.       !< on the screen
  end type message_t

  type, public :: messages_t
    integer :: n = 0
    type(message_t), allocatable :: item(:)
  end type messages_t

  public :: add_message, set_message

contains

  !> Adds a message; one of the same kind and text is counted.
  subroutine add_message(messages, kind, text)
    type(messages_t), intent(inout) :: messages
    character(*), intent(in) :: kind, text
    integer :: k
    do k = 1, messages%n
      if (messages%item(k)%kind == kind .and. messages%item(k)%text == text) then
        messages%item(k)%count = messages%item(k)%count + 1
        return
      end if
    end do
    call append(messages, message_t(kind=kind, text=text, count=1))
  end subroutine add_message

  !> The one message of a kind as it stands: the first step, how often until then; its text
  !> replaces an earlier one.
  subroutine set_message(messages, kind, text, step, count)
    type(messages_t), intent(inout) :: messages
    character(*), intent(in) :: kind, text
    integer, intent(in) :: step, count
    integer :: k
    do k = 1, messages%n
      if (messages%item(k)%kind /= kind) cycle
      messages%item(k)%text = text
      messages%item(k)%count = count
      return
    end do
    call append(messages, message_t(kind=kind, text=text, step=step, count=count))
  end subroutine set_message

  subroutine append(messages, message)
    type(messages_t), intent(inout) :: messages
    type(message_t), intent(in) :: message
    type(message_t), allocatable :: longer(:)
    if (.not. allocated(messages%item)) allocate (messages%item(8))
    if (messages%n == size(messages%item)) then
      allocate (longer(2*messages%n))
      longer(:messages%n) = messages%item
      call move_alloc(longer, messages%item)
    end if
    messages%n = messages%n + 1
    messages%item(messages%n) = message
  end subroutine append

end module base_messages
