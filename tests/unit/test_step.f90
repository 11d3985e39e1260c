! SPDX-License-Identifier: BSD-3-Clause
!> A step that is refused leaves nothing behind: with contact, friction, loads, motions, the
!> state goes back bit for bit, and a run in which every third step is solved and refused first
!> is the run without. How lengths of steps follow each other.
program test_step
  use base_archive, only: archive_t, archive_save
  use base_kinds, only: wp
  use base_status, only: status_t, failed, status_text
  use base_strings, only: to_text
  use check, only: test_start, test_end, check_true, check_close, check_equal
  use deck_names, only: step_halve
  use deck_parameter, only: override_t
  use run_data, only: run_t
  use run_loop, only: advance, advance_to
  use run_setup, only: read_scene, set_up
  use run_step, only: begin_step, judge_step, exchange_moment
  implicit none
  character(512) :: root

  call test_start('step')
  call get_environment_variable('ROOT', root)
  call test_refusals('cards/every_keyword.k', 'scheme', 'THETA', 120)
  call test_refusals('cards/every_keyword.k', 'scheme', 'NEWMARK', 120)
  call test_refusals('cards/every_keyword.k', 'scheme', 'GENALPHA', 120)
  call test_refusals('lessons/sliding_block.k', '', '', 200)
  call test_refusals('lessons/inner_corner.k', '', '', 390)
  call test_refusals('two_bars/newmark.k', 'dt', '3.0e-5', 500)
  call test_lengths()
  call test_end()

contains

  !> A run that may halve its steps, ready to start.
  subroutine start(deck, parameter, value, run)
    character(*), intent(in) :: deck, parameter, value
    type(run_t), intent(inout) :: run
    type(override_t), allocatable :: override(:)
    type(status_t) :: status
    allocate (override(0))
    if (parameter /= '') override = [override_t(name=parameter, value=value)]
    call run%timers%start()
    call read_scene(trim(root)//'/input/'//deck, override, run, status)
    call set_up(run, status)
    call check_true(.not. failed(status), deck//': '//status_text(status))
    run%step%mode = step_halve
    run%model%controls%shortest_step = run%model%controls%dt/1024.0_wp
  end subroutine start

  subroutine test_refusals(deck, parameter, value, steps)
    character(*), intent(in) :: deck, parameter, value
    integer, intent(in) :: steps
    type(run_t), allocatable :: plain, tried
    type(archive_t) :: before, after
    type(status_t) :: status
    character(:), allocatable :: name
    integer :: k
    name = deck//' '//value
    allocate (plain, tried)
    call start(deck, parameter, value, plain)
    call start(deck, parameter, value, tried)
    do k = 1, steps
      call advance(plain, status)
      if (mod(k, 3) == 0) then
        call save(tried, before)
        call refuse(tried, status)
        call save(tried, after)
        call compare(before, after, name//': the state goes back')
      end if
      call advance(tried, status)
    end do
    call check_true(.not. failed(status), name//': '//status_text(status))
    tried%contact%tally%w_builds = plain%contact%tally%w_builds   ! once more after a refusal
    call save(plain, before)
    call save(tried, after)
    call compare(before, after, name//': no step remembers one that was refused')
    call check_true(plain%contact%tally%solves > 0, name//': it touches')
    call check_equal(tried%step%halvings, steps/3, name//': refused')
  end subroutine test_refusals

  !> Solves a step and refuses it; the one in its place has the same length all the same.
  subroutine refuse(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    call refuse_once(run, status)
    run%step%level = run%step%level - 1
    run%step%new_interface = .true.   ! the factor is that of the refused step else
  end subroutine refuse

  subroutine save(run, archive)
    type(run_t), intent(inout) :: run
    type(archive_t), intent(inout) :: archive
    logical :: new(2)
    call archive%rewind(archive_save)
    call exchange_moment(archive, run, new(1), new(2))
  end subroutine save

  !> The same entries with the same values, to the last bit.
  subroutine compare(a, b, what)
    type(archive_t), intent(in) :: a, b
    character(*), intent(in) :: what
    logical :: is_same
    integer :: k
    call check_true(a%n > 10, what//': there is something')
    call check_equal(b%n, a%n, what//': number of entries')
    do k = 1, min(a%n, b%n)
      is_same = a%entry(k)%name == b%entry(k)%name .and. &
          size(a%entry(k)%values) == size(b%entry(k)%values)
      if (is_same) is_same = .not. any(abs(a%entry(k)%values - b%entry(k)%values) > 0.0_wp)
      if (.not. is_same) call check_true(.false., what//', entry '//a%entry(k)%name)
    end do
  end subroutine compare

  !> Two refusals in the third step: quarters; after four good ones halves, where the grid of
  !> halves has a point; after four more whole steps. Every step of DT0 ends on its grid.
  subroutine test_lengths()
    type(run_t), allocatable :: run
    type(status_t) :: status
    real(wp), parameter :: wanted(12) = [1.0_wp, 1.0_wp, 0.25_wp, 0.25_wp, 0.25_wp, 0.25_wp, &
        0.5_wp, 0.5_wp, 0.5_wp, 0.5_wp, 1.0_wp, 1.0_wp]
    real(wp) :: end
    integer :: k
    allocate (run)
    call start('two_bars/theta.k', '', '', run)
    end = 0.0_wp
    do k = 1, size(wanted)
      if (k == 3) then
        call refuse_once(run, status)
        call refuse_once(run, status)
      end if
      call advance(run, status)
      end = end + wanted(k)
      call check_close(run%state%h_last/run%model%controls%dt, wanted(k), 1.0e-15_wp, &
          'length of step '//to_text(k))
      call check_close(run%state%time, end*run%model%controls%dt, 1.0e-18_wp, &
          'end of step '//to_text(k))
    end do
    call check_equal(run%state%cycle, size(wanted), 'a part of a step is a step')
    call check_equal(run%factors, 5, 'a factor for each change of the length')
  end subroutine test_lengths

  !> Solves a step and refuses it.
  subroutine refuse_once(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    real(wp) :: t1
    logical :: is_refused
    call begin_step(run, t1, status)
    call advance_to(run, t1, status)
    run%step%faults = -1        ! whatever has been counted is too much
    call judge_step(run, is_refused, status)
    call check_true(is_refused, 'a step is refused')
  end subroutine refuse_once

end program test_step
