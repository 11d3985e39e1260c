! SPDX-License-Identifier: BSD-3-Clause
!> Which parts the contact cards bring together: parts that stand on both sides of a card, and
!> parts that two cards share.
module scene_sharing
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_note
  use model_data, only: model_t, contact_card_t, side_part_set, side_part, side_all_parts, &
      side_parts
  implicit none
  private
  public :: share_parts

contains

  !> A card whose sides have parts in common is one of a surface with itself, in which pairs
  !> that do not stand on both sides are left out. Parts that two cards bring together at the
  !> same time are an error, but for the card of all parts, which leaves to others what they
  !> name.
  subroutine share_parts(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    logical, allocatable :: pair(:, :, :)
    integer :: i, j, n
    n = size(model%part)
    allocate (pair(n, n, size(model%contact)))
    do i = 1, size(model%contact)
      call pairs_of(model, model%contact(i), pair(:, :, i))
      call join_sides(model, model%contact(i), pair(:, :, i))
    end do
    do i = 1, size(model%contact)
      do j = 1, i - 1
        if (.not. any(pair(:, :, i) .and. pair(:, :, j))) cycle
        if (.not. same_time(model, model%contact(i), model%contact(j))) cycle
        if (model%contact(i)%is_of_all) then
          call leave_out(deck, model%contact(i), model%contact(j), pair(:, :, j))
        else if (model%contact(j)%is_of_all) then
          call leave_out(deck, model%contact(j), model%contact(i), pair(:, :, i))
        else
          call deck%complain(model%contact(i)%record, 'SURFA', 'contacts '// &
              to_text(model%contact(j)%id)//' and '//to_text(model%contact(i)%id)// &
              ' bring the same two parts together at the same time', &
              'the other card is at '//deck%place(model%contact(j)%record))
        end if
      end do
    end do
  end subroutine share_parts

  !> Which parts a card brings together. Cards of node and segment sets name boundaries, of
  !> which two parts may have several.
  pure subroutine pairs_of(model, card, pair)
    type(model_t), intent(in) :: model
    type(contact_card_t), intent(in) :: card
    logical, intent(out) :: pair(:, :)
    integer, allocatable :: a(:), b(:)
    integer :: i, j, s
    pair = .false.
    call list_parts(model, card%kind(1), card%side(1), a)
    s = merge(1, 2, card%is_self)
    call list_parts(model, card%kind(s), card%side(s), b)
    do i = 1, size(a)
      do j = 1, size(b)
        pair(a(i), b(j)) = .true.
        pair(b(j), a(i)) = .true.
      end do
    end do
  end subroutine pairs_of

  !> Parts of a side; none for node and segment sets.
  pure subroutine list_parts(model, kind, row, parts)
    type(model_t), intent(in) :: model
    integer, intent(in) :: kind, row
    integer, allocatable, intent(out) :: parts(:)
    integer :: k
    select case (kind)
    case (side_part_set)
      allocate (parts(size(model%part_set(row)%member)))
      parts = model%part_set(row)%member
    case (side_part)
      allocate (parts(1))
      parts = row
    case (side_all_parts)
      allocate (parts(size(model%part)))
      parts = [(k, k=1, size(model%part))]
    case default
      allocate (parts(0))
    end select
  end subroutine list_parts

  !> One surface of both sides, where they have parts in common.
  pure subroutine join_sides(model, card, pair)
    type(model_t), intent(in) :: model
    type(contact_card_t), intent(inout) :: card
    logical, intent(in) :: pair(:, :)
    integer :: k
    if (.not. any([(pair(k, k), k=1, size(pair, 1))])) return
    card%is_of_all = card%kind(1) == side_all_parts
    card%is_self = .true.
    card%kind = side_parts
    card%parts = pack([(k, k=1, size(pair, 1))], any(pair, dim=1))
    card%leaves_out = .not. pair
  end subroutine join_sides

  !> Do two cards act at the same time of the run?
  pure logical function same_time(model, a, b)
    type(model_t), intent(in) :: model
    type(contact_card_t), intent(in) :: a, b
    same_time = max(a%birth, b%birth) <= min(a%death, b%death, model%controls%end_time)
  end function same_time

  subroutine leave_out(deck, all_parts, card, pair)
    type(deck_t), intent(inout) :: deck
    type(contact_card_t), intent(inout) :: all_parts
    type(contact_card_t), intent(in) :: card
    logical, intent(in) :: pair(:, :)
    all_parts%leaves_out = all_parts%leaves_out .or. pair
    call add_note(deck%problems, deck%place(all_parts%record)//': contact '// &
        to_text(all_parts%id)//' of all parts leaves to contact '//to_text(card%id)// &
        ' the parts that it names')
  end subroutine leave_out

end module scene_sharing
