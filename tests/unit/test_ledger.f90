! SPDX-License-Identifier: BSD-3-Clause
!> The ledger notices: one reaction, one velocity, one displacement that are off by a millionth
!> move its residual far above its bound. And the archive restores a run bit for bit.
program test_ledger
  use base_archive, only: archive_t, archive_save, archive_restore
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, failed, status_text
  use check, only: test_start, test_end, check_true, check_close
  use contact_work, only: add_contact_step
  use deck_parameter, only: override_t
  use model_state, only: exchange_state
  use run_data, only: run_t
  use run_loop, only: advance
  use run_setup, only: read_scene, set_up
  use time_ledger, only: ledger_t, evaluate_ledger, exchange_ledger
  implicit none
  real(wp), parameter :: off = 1.0e-6_wp, bound = 1.0e-11_wp
  character(512) :: root

  call test_start('ledger')
  call get_environment_variable('ROOT', root)
  call test_perturbations('theta.k')
  call test_perturbations('newmark.k')
  call test_archive()
  call test_end()

contains

  !> A run ready to start, with steps that do not end at the touch.
  subroutine start(deck, run)
    character(*), intent(in) :: deck
    type(run_t), intent(inout) :: run
    type(override_t) :: coarse(1)
    type(status_t) :: status
    coarse(1) = override_t(name='dt', value='3.0e-5')
    call run%timers%start()
    call read_scene(trim(root)//'/input/two_bars/'//deck, coarse, run, status)
    call set_up(run, status)
    call check_true(.not. failed(status), deck//': '//status_text(status))
  end subroutine start

  !> The step that closes the gap is the one whose reaction does work.
  subroutine test_perturbations(deck)
    character(*), intent(in) :: deck
    type(run_t), allocatable :: run
    type(ledger_t) :: before
    type(status_t) :: status
    integer :: k
    real(wp) :: old
    allocate (run)
    call start(deck, run)
    do k = 1, 500
      before = run%ledger
      call advance(run, status)
      if (any(run%contact%rows%r(1, :run%contact%rows%n) > zero)) exit
    end do
    k = maxloc(run%contact%rows%r(1, :run%contact%rows%n), dim=1)
    associate (rows => run%contact%rows, node => run%contact%rows%key(3, k))
      call check_true(rows%r(1, k) > zero .and. rows%gap(k) > zero, deck//' closes its gap')
      call check_close(residual(run, run%ledger), zero, bound, deck//' as it is')

      rows%r(1, k) = rows%r(1, k)*(one + off)
      call add_contact_step(run%contact, run%scheme%weight_before, run%scheme%weight_now, &
          run%scheme%h, run%state%du, before%contact)
      call check_true(abs(residual(run, before)) > 10.0_wp*bound, deck//' feels a reaction')

      old = run%state%v(1, node)
      run%state%v(1, node) = old + off
      call check_true(abs(residual(run, run%ledger)) > 10.0_wp*bound, deck//' feels a velocity')
      run%state%v(1, node) = old

      run%state%u(1, node) = run%state%u(1, node) + 1.0e-2_wp*off
      call check_true(abs(residual(run, run%ledger)) > 10.0_wp*bound, deck//' feels a place')
    end associate
  end subroutine test_perturbations

  !> Residual of a ledger for the state of the run as it is now.
  real(wp) function residual(run, ledger)
    type(run_t), intent(inout) :: run
    type(ledger_t), intent(in) :: ledger
    type(ledger_t) :: copy
    copy = ledger
    copy%evaluated = -1
    call evaluate_ledger(run%model, run%system, run%state, copy)
    residual = copy%residual
  end function residual

  !> State and ledger saved in flight, then restored into a fresh run: 200 more steps agree bit
  !> for bit with those of the run that was never interrupted.
  subroutine test_archive()
    type(run_t), allocatable :: whole, again
    type(archive_t) :: archive
    type(status_t) :: status
    integer :: k
    allocate (whole, again)
    call start('theta.k', whole)
    do k = 1, 100
      call advance(whole, status)
    end do
    call archive%rewind(archive_save)
    call exchange_state(archive, whole%state)
    call exchange_ledger(archive, whole%ledger)
    call start('theta.k', again)
    call archive%rewind(archive_restore)
    call exchange_state(archive, again%state)
    call exchange_ledger(archive, again%ledger)
    call check_true(.not. failed(archive%status), status_text(archive%status))
    do k = 1, 200
      call advance(whole, status)
      call advance(again, status)
    end do
    call check_true(.not. failed(status), status_text(status))
    call check_true(.not. any(abs(whole%state%u - again%state%u) > zero), 'restored: place')
    call check_true(.not. any(abs(whole%state%v - again%state%v) > zero), 'restored: velocity')
  end subroutine test_archive

end program test_ledger
