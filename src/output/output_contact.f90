! SPDX-License-Identifier: BSD-3-Clause
!> The contact problem of a step as a text file, which bipact-fclib solves or converts to FCLIB:
!> a head line, d and the number of contacts, then mu, q, r, and W row by row. (The program of
!> scenes does not carry HDF5, whose start would cost more than many a run.)
module output_contact
  use base_files, only: open_text, close_text, remove_file
  use base_kinds, only: wp, zero
  use base_status, only: status_t, failed
  implicit none
  private
  public :: write_contact_problem

  !> The head line begins with it.
  character(*), parameter, public :: problem_head = '# bipact contact problem'

contains

  !> Writes u = W r + q [L, F] for d = 2 (for d = 1, no friction, as d = 2 with a tangent of its
  !> own, mu = 0 and no tangential motion, for FCLIB knows 2 and 3 only). Fails when the file
  !> cannot be written; a part of one is removed.
  subroutine write_contact_problem(path, title, w, q, mu, r, status)
    character(*), intent(in) :: path, title
    real(wp), intent(in) :: w(:, :), q(:, :), mu(:), r(:, :)
    type(status_t), intent(inout) :: status
    real(wp) :: row(2*size(mu))
    integer :: unit, error, a, i, d
    d = size(q, 1)
    call open_text(path, unit, status)
    if (failed(status)) return
    write (unit, '(a)', iostat=error) problem_head//', '//title
    if (error == 0) write (unit, '(2(i0,1x))', iostat=error) 2, size(mu)
    do a = 1, size(mu)
      if (error == 0) write (unit, '(5es25.16e3)', iostat=error) mu(a), padded(q(:, a)), &
          padded(r(:, a))
    end do
    do a = 1, size(mu)
      do i = 1, 2
        row = zero
        if (d == 2) then
          row = w(2*(a - 1) + i, :)
        else if (i == 1) then
          row(1::2) = w(a, :)
        else
          row(2*a) = w(a, a)
        end if
        if (error == 0) write (unit, '(*(es25.16e3))', iostat=error) row
      end do
    end do
    call close_text(path, unit, status)
    if (failed(status)) call remove_file(path)
  end subroutine write_contact_problem

  pure function padded(x) result(pair)
    real(wp), intent(in) :: x(:)
    real(wp) :: pair(2)
    pair = zero
    pair(:size(x)) = x
  end function padded

end module output_contact
