! SPDX-License-Identifier: BSD-3-Clause
!> Warnings of a run: what its parts have counted, in words. A kind goes to the screen in the
!> step in which it is first seen; log and closing summary have it as it stands at the end.
module run_warnings
  use, intrinsic :: iso_fortran_env, only: error_unit
  use assembly_bending, only: locks, excess
  use base_kinds, only: wp, zero, one
  use base_messages, only: messages_t, add_message, set_message
  use base_strings, only: to_text
  use deck_names, only: step_fixed
  use model_data, only: node_name
  use run_data, only: run_t, warning_kinds, open_balance
  use run_progress, only: progress_t, clear_progress
  implicit none
  private
  public :: notice_warnings, collect_messages, show_warnings, write_messages, write_kinds

  character(*), parameter :: kind(warning_kinds) = [character(13) :: 'energy-growth', &
      'overlap', 'certificate', 'wedging', 'rotation', 'balance', 'compression']
  integer, parameter :: growth = 1, overlap = 2, certificate = 3, wedging = 4, rotation = 5, &
      balance = 6, compression = 7

contains

  !> After each step: kinds that were not seen before get its number and go to the screen.
  subroutine notice_warnings(run, progress)
    type(run_t), intent(inout) :: run
    type(progress_t), intent(in) :: progress
    logical :: is_new(warning_kinds)
    is_new = counts(run) > 0 .and. run%first_warned < 0
    if (.not. any(is_new)) return
    where (is_new) run%first_warned = run%state%cycle
    if (is_new(growth)) run%first_warned(growth) = run%ledger%first_growth
    if (is_new(overlap)) run%first_warned(overlap) = run%contact%tally%overlap_step
    ! What has been seen before this step was seen at its start.
    where (is_new) run%first_time = merge(run%state%time, run%step%time_before, &
        run%first_warned == run%state%cycle)
    call clear_progress(progress)
    call update_warnings(run)
    call show_warnings(run%warnings)
  end subroutine notice_warnings

  !> How often each kind was seen so far.
  pure function counts(run) result(count)
    type(run_t), intent(in) :: run
    integer :: count(warning_kinds)
    count(growth) = run%ledger%growths
    count(overlap) = run%contact%tally%overlaps
    count(certificate) = run%contact%tally%misses
    count(wedging) = run%contact%tally%wedged
    count(rotation) = run%rotations
    count(balance) = run%open_balances
    count(compression) = 0
    if (allocated(run%newton)) count(compression) = run%newton%compressed
  end function counts

  !> The record as it stands: warnings with their last figures, notes of the contacts.
  subroutine collect_messages(run)
    type(run_t), intent(inout) :: run
    call update_warnings(run)
    call warn_of_bending(run)
    call note_touches(run)
  end subroutine collect_messages

  subroutine update_warnings(run)
    type(run_t), intent(inout) :: run
    integer :: k, count(warning_kinds)
    count = counts(run)
    do k = 1, warning_kinds
      if (run%first_warned(k) < 0) cycle
      call set_message(run%warnings, trim(kind(k)), warning_text(run, k), &
          run%first_warned(k), count(k))
    end do
  end subroutine update_warnings

  !> What is wrong, where, since when, and what to do.
  function warning_text(run, k) result(text)
    type(run_t), intent(in) :: run
    integer, intent(in) :: k
    character(:), allocatable :: text, since
    since = moment(run%first_warned(k), run%first_time(k))
    associate (tally => run%contact%tally)
      select case (k)
      case (growth)
        text = 'the energy rose by '//to_text(run%ledger%largest_growth)// &
            ' of the largest term; first seen at '//since//': take a smaller step'
        if (run%scheme%weight_before > zero .and. .not. run%model%controls%is_static) &
            text = text//', or another scheme'
      case (overlap)
        text = 'bodies overlap by up to '//to_text(tally%overlap_share)// &
            ' of the shorter edge, deepest at node '// &
            to_text(run%model%node_id(tally%overlap_node))//'; first at '//since// &
            ': take a smaller step'
      case (certificate)
        text = 'in some step the contact forces meet their law only to error '// &
            to_text(tally%worst%error)//', eta '//to_text(tally%worst%eta)// &
            ' for the motion as computed; first at '//since//': take a smaller step'
      case (wedging)
        text = to_text(tally%wedged)//' times friction was so large at a contact '// &
            '(mu |W_nt| > W_nn) that several answers may exist; first at '// &
            node_name(run%model, tally%wedged_node)//', '//since// &
            ': the motion may depend on the step, try others'
      case (rotation)
        text = rotation_text(run, since)
      case (balance)
        text = 'the energy balance is open by '//to_text(run%ledger%worst_residual)// &
            ' of the largest term; first beyond '//to_text(open_balance)//' at '//since// &
            ': stiff and light parts leave each other too few digits, take less unequal ones'
      case (compression)
        text = 'element '//to_text(run%model%mesh%id(run%newton%compressed_element))// &
            ' was compressed to stretch '//to_text(run%newton%stretch)//'; first at '//since// &
            ': the law of St Venant and Kirchhoff gives way there, take LAW HENCKY of '// &
            '*BIPACT_KINEMATICS'
      end select
    end associate
  end function warning_text

  !> Small displacements take 1 - cos of a rotation for a strain.
  function rotation_text(run, since) result(text)
    type(run_t), intent(in) :: run
    character(*), intent(in) :: since
    character(:), allocatable :: text
    text = 'element '//to_text(run%model%mesh%id(run%rotation_element))//' turned by '// &
        to_text(run%rotation*180.0_wp/acos(-one))//' degrees; first beyond ROTWARN at '// &
        since//': the kinematics of small displacements take it for a strain of '// &
        to_text(one - cos(run%rotation))//'; end the run before'
  end function rotation_text

  !> Parts whose elements lock in bending: by all looks, so at the end only. The one that lacks
  !> most is described.
  subroutine warn_of_bending(run)
    type(run_t), intent(inout) :: run
    !> A part with less of the energy of the run is as good as rigid, or holds its round-off.
    real(wp), parameter :: least = 1.0e-6_wp
    character(:), allocatable :: text, others
    integer :: p, worst, parts
    if (.not. allocated(run%bending)) return
    worst = 0
    parts = 0
    others = ''
    do p = 1, size(run%model%part)
      if (.not. locks(run%bending, p, least*run%ledger%largest)) cycle
      parts = parts + 1
      if (worst == 0) worst = p
      if (excess(run%bending%sum(p)) > excess(run%bending%sum(worst))) worst = p
      if (parts <= 9) others = others//' '//to_text(run%model%part(p)%id)
    end do
    if (parts == 0) return
    text = bending_text(run, worst)
    if (parts > 1) text = text//'; '//to_text(parts)//' parts do so, among them'//others
    call set_message(run%warnings, 'bending', text, run%bending%step(worst), parts)
  end subroutine warn_of_bending

  function bending_text(run, p) result(text)
    type(run_t), intent(in) :: run
    integer, intent(in) :: p
    character(:), allocatable :: text
    integer :: e
    associate (sum => run%bending%sum(p))
      text = 'part '//to_text(run%model%part(p)%id)//': '//percent(sum%modes/sum%strain)// &
          ' of its strain energy is in bending modes of its elements, which cost '// &
          one_decimal(sum%modes/max(sum%exact, 1.0e-3_wp*sum%modes))// &
          ' times what bending costs: it gives way about '// &
          percent(excess(sum))//' too little under a load; most at '// &
          step_of_look(run, run%bending%step(p))
    end associate
    if (any([(run%model%mesh%part(e) == p .and. run%model%mesh%is_of_type(e, 'TRI3'), &
        e=1, run%model%mesh%n)])) then
      text = text//': take quadrilaterals, or eight triangles or more over the height'
    else
      text = text//': take three elements or more over the height'
    end if
    text = text//' of what bends, not longer than high'
  end function bending_text

  !> A share as a whole number of hundredths.
  function percent(share) result(text)
    real(wp), intent(in) :: share
    character(:), allocatable :: text
    text = to_text(nint(100.0_wp*share))//' %'
  end function percent

  function one_decimal(number) result(text)
    real(wp), intent(in) :: number
    character(:), allocatable :: text
    character(24) :: buffer
    write (buffer, '(f0.1)') number
    text = trim(buffer)
  end function one_decimal

  !> A step and its time [T].
  function moment(step, time) result(text)
    integer, intent(in) :: step
    real(wp), intent(in) :: time
    character(:), allocatable :: text
    text = 'step '//to_text(step)//', time '//to_text(time)
  end function moment

  !> A step that was looked at, with its time where all steps are equal.
  function step_of_look(run, step) result(text)
    type(run_t), intent(in) :: run
    integer, intent(in) :: step
    character(:), allocatable :: text
    text = 'step '//to_text(step)
    if (run%step%mode /= step_fixed) return
    text = moment(step, merge(run%model%controls%end_time, step*run%model%controls%dt, &
        step > run%plan%full_steps))
  end function step_of_look

  !> Overlaps at the start that were taken for touches, and what closing overlaps gave back.
  subroutine note_touches(run)
    type(run_t), intent(inout) :: run
    character(:), allocatable :: name
    integer :: p
    do p = 1, size(run%contact%pairing)
      associate (pairing => run%contact%pairing(p)%item)
        name = trim(merge('wall   ', 'contact', pairing%is_wall))//' '//to_text(pairing%id)
        if (pairing%accepted_overlap > zero) call add_message(run%notes, '', name// &
            ': nodes up to '//to_text(pairing%accepted_overlap)//' deep at its start are '// &
            'taken as touching: that is the rounding of the fields of a deck')
        if (pairing%purse%spent > 1.0e-9_wp*run%ledger%largest) call add_message(run%notes, &
            '', name//': closing overlaps gave back '//to_text(pairing%purse%spent)// &
            ' of the energy that impacts had taken')
      end associate
    end do
  end subroutine note_touches

  !> Warnings that the screen has not shown go there, one line for each kind.
  subroutine show_warnings(warnings)
    type(messages_t), intent(inout) :: warnings
    integer :: k
    do k = 1, warnings%n
      if (.not. warnings%item(k)%is_shown .and. is_first(warnings, k)) &
          write (error_unit, '(a)') 'WARNING '//line(warnings, k)
      warnings%item(k)%is_shown = .true.
    end do
  end subroutine show_warnings

  !> Is message k the first of its kind?
  pure logical function is_first(messages, k)
    type(messages_t), intent(in) :: messages
    integer, intent(in) :: k
    integer :: m
    is_first = .false.
    do m = 1, k - 1
      if (messages%item(m)%kind == messages%item(k)%kind) return
    end do
    is_first = .true.
  end function is_first

  pure function line(messages, k) result(text)
    type(messages_t), intent(in) :: messages
    integer, intent(in) :: k
    character(:), allocatable :: text
    text = messages%item(k)%kind//': '//messages%item(k)%text
  end function line

  !> All notes and warnings of a run, a line each.
  subroutine write_messages(run, unit)
    type(run_t), intent(in) :: run
    integer, intent(in) :: unit
    integer :: k
    do k = 1, run%notes%n
      write (unit, '(a)') 'NOTE '//run%notes%item(k)%text
    end do
    do k = 1, run%warnings%n
      write (unit, '(a)') 'WARNING '//line(run%warnings, k)
    end do
  end subroutine write_messages

  !> The last lines of the summary: how many notes, and the kinds of warnings with how often
  !> they were seen and their first text.
  subroutine write_kinds(run, unit)
    type(run_t), intent(in) :: run
    integer, intent(in) :: unit
    integer :: k, m, times
    associate (w => run%warnings)
      write (unit, '(a)') 'notes '//to_text(run%notes%n)//', warnings '//to_text(w%n)
      do k = 1, w%n
        if (.not. is_first(w, k)) cycle
        times = 0
        do m = k, w%n
          if (w%item(m)%kind == w%item(k)%kind) times = times + w%item(m)%count
        end do
        write (unit, '(a)') '  '//to_text(times)//' x '//line(w, k)
      end do
    end associate
  end subroutine write_kinds

end module run_warnings
