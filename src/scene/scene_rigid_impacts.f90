! SPDX-License-Identifier: BSD-3-Clause
!> Rigid parts that may meet rigid parts or walls under a scheme whose contact law says nothing
!> of impacts: they would rebound by the phase of the touch within a step.
module scene_rigid_impacts
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_warning
  use deck_schemes, only: scheme_traits_t, traits_of
  use model_data, only: model_t, side_part_set, side_part, side_node_set, side_segment_set, &
      side_all_parts, side_parts
  implicit none
  private
  public :: warn_of_impacts

contains

  !> body_of: the rigid body of each part, 0 = deformable.
  subroutine warn_of_impacts(deck, model, body_of)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    integer, intent(in) :: body_of(:)
    type(scheme_traits_t) :: traits
    integer :: k, pair(2)
    traits = traits_of(model%controls%scheme)
    if (traits%takes_restitution .or. model%controls%is_static) return
    do k = 1, size(model%contact)
      call find_pair(model, k, body_of, pair)
      if (pair(1) > 0) call warn(deck, model, 'rigid parts '// &
          to_text(model%part(pair(1))%id)//' and '//to_text(model%part(pair(2))%id)// &
          ' of contact '//to_text(model%contact(k)%id))
    end do
    do k = 1, size(model%wall)
      pair(1) = findloc(body_of > 0 .and. parts_at(model, side_node_set, &
          model%wall(k)%node_set), .true., dim=1)
      if (pair(1) > 0) call warn(deck, model, 'rigid part '// &
          to_text(model%part(pair(1))%id)//' and wall '//to_text(model%wall(k)%id))
    end do
  end subroutine warn_of_impacts

  subroutine warn(deck, model, who)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    character(*), intent(in) :: who
    call add_warning(deck%problems, 'rigid-impact', who//': scheme '// &
        trim(model%controls%scheme)//' has no law for their impacts, they rebound by the '// &
        'phase of the touch in a step; take MOREAU, PAOLI or CDLAGRANGE, unless they only '// &
        'rest on each other')
  end subroutine warn

  !> Two parts of different rigid bodies that a contact card brings together; 0 = none.
  pure subroutine find_pair(model, k, body_of, pair)
    type(model_t), intent(in) :: model
    integer, intent(in) :: k, body_of(:)
    integer, intent(out) :: pair(2)
    logical :: a(size(model%part)), b(size(model%part))
    integer :: i, j
    pair = 0
    associate (card => model%contact(k))
      if (card%is_self) then
        a = .false.
        a(card%parts) = .true.
        b = a
      else
        a = parts_at(model, card%kind(1), card%side(1))
        b = parts_at(model, card%kind(2), card%side(2))
      end if
      do i = 1, size(a)
        do j = 1, size(a)
          if (.not. (a(i) .and. b(j)) .or. body_of(i) == 0 .or. body_of(j) == 0) cycle
          if (body_of(i) == body_of(j)) cycle
          if (card%is_self .and. allocated(card%leaves_out)) then
            if (card%leaves_out(i, j)) cycle
          end if
          pair = [min(i, j), max(i, j)]
          return
        end do
      end do
    end associate
  end subroutine find_pair

  !> The parts of a side; row 0 of node sets: all.
  pure function parts_at(model, kind, row) result(is_in)
    type(model_t), intent(in) :: model
    integer, intent(in) :: kind, row
    logical :: is_in(size(model%part)), node(model%nodes)
    integer :: e
    is_in = .false.
    node = .false.
    select case (kind)
    case (side_part_set)
      is_in(model%part_set(row)%member) = .true.
    case (side_part)
      is_in(row) = .true.
    case (side_all_parts, side_parts)
      is_in = .true.
    case (side_node_set)
      if (row == 0) node = .true.
      if (row > 0) node(model%node_set(row)%member) = .true.
    case (side_segment_set)
      node(reshape(model%segment_set(row)%node, [size(model%segment_set(row)%node)])) = .true.
    end select
    do e = 1, model%mesh%n
      if (any(node(model%mesh%nodes_of(e)))) is_in(model%mesh%part(e)) = .true.
    end do
  end function parts_at

end module scene_rigid_impacts
