! SPDX-License-Identifier: BSD-3-Clause
!> The monitor of overlap: what it finds in bodies that overlap is told as a warning or ends
!> the run. It asks the boundaries, not the rows.
module contact_monitor
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, fail, status_numerical, status_deck
  use base_strings, only: to_text
  use contact_pairing, only: pairing_t, overlap_t, no_gap
  use contact_places, only: deepest
  use contact_ramp, only: ramp_depth
  use contact_types, only: contact_t
  use model_data, only: model_t
  implicit none
  private
  public :: check_listed, check_whole, check_start, check_all

  !> Overlaps in shares of the shorter edge: beyond the first a warning, beyond the second the
  !> bodies have passed through each other.
  real(wp), parameter :: warned = 1.0e-2_wp, passed = 0.5_wp

contains

  !> True gaps of the listed nodes at the end of a step u, in every step.
  subroutine check_listed(model, contact, u, du, cycle, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: u(:, :), du(:, :)
    integer, intent(in) :: cycle
    type(status_t), intent(inout) :: status
    real(wp) :: longest
    integer :: p
    longest = longest_motion(contact, du)
    do p = 1, size(contact%pairing)
      if (.not. contact%acts(p)) cycle
      associate (pairing => contact%pairing(p)%item)
        pairing%sums%smallest_gap = no_gap
        if (allocated(pairing%nodal)) pairing%nodal%gap = no_gap
        pairing%overlap = overlap_t()
        if (pairing%listed == 0) cycle
        call pairing%measure(model, u, pairing%overlap)
        call judge(model, contact, pairing, cycle, status)
        if (moves_far(pairing, longest)) &
            call check_passage(model, pairing, u, du, status)
      end associate
    end do
  end subroutine check_listed

  !> The longest motion du of an interface node [L].
  pure real(wp) function longest_motion(contact, du)
    type(contact_t), intent(in) :: contact
    real(wp), intent(in), contiguous :: du(:, :)
    integer :: k
    longest_motion = zero
    do k = 1, size(contact%interface_node)
      longest_motion = max(longest_motion, sum(du(:, contact%interface_node(k))**2))
    end do
    longest_motion = sqrt(longest_motion)
  end function longest_motion

  !> Do nodes move so far in the step, longest [L] at most, that one may go through something?
  pure logical function moves_far(pairing, longest)
    class(pairing_t), intent(in) :: pairing
    real(wp), intent(in) :: longest
    real(wp), parameter :: share = 0.1_wp
    moves_far = .not. pairing%is_wall .and. 2.0_wp*longest > &
        share*min(pairing%side(1)%shortest, pairing%side(2)%shortest)
  end function moves_far

  !> Fails at a node that has gone through the other body within the step.
  subroutine check_passage(model, pairing, u, du, status)
    type(model_t), intent(in) :: model
    class(pairing_t), intent(inout) :: pairing
    real(wp), intent(in), contiguous :: u(:, :), du(:, :)
    type(status_t), intent(inout) :: status
    type(overlap_t) :: passage
    call pairing%find_passage(model, u, du, passage)
    if (passage%share > warned) call fail(status, status_numerical, 'node '// &
        to_text(model%node_id(passage%node))//' went through part '//to_text(passage%part)// &
        ' within the step, '//to_text(passage%depth)//' deep on its way', &
        hint='take a smaller step: a node must not move further than a body is thick')
  end subroutine check_passage

  !> All nodes and edges of pairing p at u.
  subroutine check_whole(model, contact, p, u, cycle, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: p, cycle
    real(wp), intent(in), contiguous :: u(:, :)
    type(status_t), intent(inout) :: status
    real(wp) :: accepted
    associate (pairing => contact%pairing(p)%item)
      pairing%overlap = overlap_t()
      call pairing%measure_whole(model, u, pairing%overlap, accepted)
      call judge(model, contact, pairing, cycle, status)
    end associate
  end subroutine check_whole

  !> The same for every pairing that acts: at output times and at the end.
  subroutine check_all(model, contact, u, cycle, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: u(:, :)
    integer, intent(in) :: cycle
    type(status_t), intent(inout) :: status
    integer :: p
    do p = 1, size(contact%pairing)
      if (contact%acts(p) .and. contact%pairing(p)%item%is_born) &
          call check_whole(model, contact, p, u, cycle, status)
    end do
  end subroutine check_all

  !> Counts the overlap of a pairing; fails where it has passed through.
  subroutine judge(model, contact, pairing, cycle, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    class(pairing_t), intent(inout) :: pairing
    integer, intent(in) :: cycle
    type(status_t), intent(inout) :: status
    real(wp) :: share
    associate (o => pairing%overlap, tally => contact%tally)
      if (.not. o%depth > zero) return
      pairing%sums%penetration = max(pairing%sums%penetration, o%depth)
      tally%overlap = max(tally%overlap, o%depth)
      share = o%share
      if (allocated(pairing%ramp)) share = share &
          *max(zero, one - ramp_depth(pairing%ramp)/o%depth)
      if (share > warned .and. tally%overlap_step < 0) tally%overlap_step = cycle
      if (share > warned) tally%overlaps = tally%overlaps + 1
      if (share > tally%overlap_share) tally%overlap_node = o%node
      tally%overlap_share = max(tally%overlap_share, share)
      if (share > passed) call fail(status, status_numerical, place_of(model, pairing)// &
          ': it has passed through the surface', hint='fewer or stiffer elements, or a '// &
          'smaller step where a body moves further than its thickness in one')
    end associate
  end subroutine judge

  !> "node N is D deep in part P", "edges cross at node N", "is D behind wall W".
  function place_of(model, pairing) result(text)
    type(model_t), intent(in) :: model
    class(pairing_t), intent(in) :: pairing
    character(:), allocatable :: text
    associate (o => pairing%overlap)
      text = 'node '//to_text(model%node_id(o%node))
      if (pairing%is_wall) then
        text = text//' is '//to_text(o%depth)//' behind wall '//to_text(pairing%id)
      else if (o%is_crossing) then
        text = 'an edge at '//text//' crosses one of part '//to_text(o%part)//', '// &
            to_text(o%depth)//' deep'
      else
        text = text//' is '//to_text(o%depth)//' deep in the other body, part '// &
            to_text(o%part)
      end if
    end associate
  end function place_of

  !> Bodies must not overlap when their contact begins, but for the digits of the deck: an
  !> error at t = 0, a failure at a birth.
  subroutine check_start(model, contact, p, u, cycle, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: p, cycle
    real(wp), intent(in), contiguous :: u(:, :)
    type(status_t), intent(inout) :: status
    character(:), allocatable :: hint
    real(wp) :: accepted
    associate (pairing => contact%pairing(p)%item)
      pairing%overlap = overlap_t()
      call pairing%measure_whole(model, u, pairing%overlap, accepted)
      if (allocated(pairing%ramp)) then
        if (pairing%overlap%share > deepest) call fail(status, status_deck, &
            'initial penetration: '//place_of(model, pairing)//', more than '// &
            to_text(deepest)//' of an edge', hint='OVERLAP RAMP pushes out less than that')
      else if (pairing%overlap%depth > accepted) then
        if (cycle == 0) then
          hint = 'open the gap'
          if (pairing%is_wall) hint = 'move the wall, or name the nodes in front of it (NSID)'
          call fail(status, status_deck, 'initial penetration: '//place_of(model, pairing)// &
              ' at the start', hint=hint//'; PENTOL of *BIPACT_CONTACT takes up to '// &
              '1E-3 of an edge for a touch')
        else
          call fail(status, status_numerical, place_of(model, pairing)// &
              ': the contact is born overlapped', hint='the bodies must be apart at TBIRTH')
        end if
      else if (pairing%overlap%depth > contact%penetration_tolerance &
          *max(pairing%side(1)%mean_length, tiny(accepted))) then
        pairing%accepted_overlap = pairing%overlap%depth
      end if
    end associate
  end subroutine check_start

end module contact_monitor
