! SPDX-License-Identifier: BSD-3-Clause
!> The card of _ID: a number and a heading before the cards of a set.
module deck_heads
  use deck_data, only: deck_t
  use deck_number, only: scan_integer
  implicit none
  private
  public :: read_head, head_number

contains

  !> The number on the card of _ID, before the heading: 10 columns (long: 20), or up to a comma
  !> there; 0 if blank.
  pure subroutine read_head(line, long, id, ok)
    character(*), intent(in) :: line
    logical, intent(in) :: long
    integer, intent(out) :: id
    logical, intent(out) :: ok
    integer :: last
    last = index(line(1:min(merge(21, 11, long), len(line))), ',') - 1
    if (last < 0) last = min(merge(20, 10, long), len(line))
    id = 0
    ok = len_trim(line(1:last)) == 0
    if (.not. ok) call scan_integer(trim(adjustl(line(1:last))), id, ok)
    ok = ok .and. id >= 0
  end subroutine read_head

  !> The number on the card of _ID at a record; `number` where there is no such card, or none on
  !> it.
  pure integer function head_number(deck, record, number)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record, number
    integer :: id
    logical :: ok
    head_number = number
    if (deck%record(record)%card /= 0) return
    associate (r => deck%record(record))
      associate (block => deck%block(r%block))
        call read_head(deck%file(block%file)%text(r%first:r%last), block%long, id, ok)
      end associate
    end associate
    if (ok .and. id > 0) head_number = id
  end function head_number

end module deck_heads
