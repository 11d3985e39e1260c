! SPDX-License-Identifier: BSD-3-Clause
!> The deck as understood, in the folder of the run. It is there as deck.echo.tmp before the
!> matrices are factored, for then the cards need not stand beside the factor; with the log it
!> becomes deck.echo.k. What is refused before that leaves the folder as it was.
module run_echo
  use base_files, only: open_text, close_text, move_file, remove_file, file_exists
  use base_status, only: status_t, failed, status_numerical
  use base_strings, only: join_path
  use base_system, only: make_folder, remove_folder
  use deck_echo, only: write_echo
  use run_data, only: run_t
  implicit none
  private
  public :: put_echo, keep_echo, drop_echo, scratch_path

contains

  !> Where the echo is until the log is there.
  pure function scratch_path(run) result(path)
    type(run_t), intent(in) :: run
    character(:), allocatable :: path
    path = join_path(run%folder, 'deck.echo.tmp')
  end function scratch_path

  !> Writes it to the folder, which is made where it is not there.
  subroutine put_echo(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    integer :: unit
    if (failed(status)) return
    run%made_folder = .not. file_exists(run%folder)
    call make_folder(run%folder, status)
    if (failed(status)) return
    call open_text(scratch_path(run), unit, status)
    if (failed(status)) return
    call write_echo(run%deck, unit)
    call close_text(scratch_path(run), unit, status)
    if (failed(status)) call remove_file(scratch_path(run))
  end subroutine put_echo

  !> deck.echo.k, with the log.
  subroutine keep_echo(run, status)
    type(run_t), intent(in) :: run
    type(status_t), intent(inout) :: status
    call move_file(scratch_path(run), join_path(run%folder, 'deck.echo.k'), status)
    if (failed(status)) call remove_file(scratch_path(run))
  end subroutine keep_echo

  !> A run that cannot start leaves none, nor its folder, unless its summary will be there.
  subroutine drop_echo(run, status)
    type(run_t), intent(in) :: run
    type(status_t), intent(in) :: status
    call remove_file(scratch_path(run))
    if (run%made_folder .and. status%code /= status_numerical) call remove_folder(run%folder)
  end subroutine drop_echo

end module run_echo
