! SPDX-License-Identifier: BSD-3-Clause
!> Contact problems as bipact writes them (*BIPACT_CONTACT DFIRST): text, d and the number of
!> contacts, then mu, q, r for each, then W row by row.
module fclib_text
  use base_kinds, only: wp
  use base_status, only: status_t, fail, status_deck, status_file
  implicit none
  private
  public :: is_text_problem, read_text_problem

  character(*), parameter :: head = '# bipact contact problem'

contains

  !> Does a file begin like such a problem?
  logical function is_text_problem(name)
    character(*), intent(in) :: name
    character(len(head)) :: line
    integer :: unit, error
    is_text_problem = .false.
    open (newunit=unit, file=name, action='read', status='old', iostat=error)
    if (error /= 0) return
    read (unit, '(a)', iostat=error) line
    is_text_problem = error == 0 .and. line == head
    close (unit)
  end function is_text_problem

  !> d, W (d nc, d nc), q (d, nc), mu (nc); the reactions that the run found are left out.
  subroutine read_text_problem(name, w, q, mu, status)
    character(*), intent(in) :: name
    real(wp), allocatable, intent(out) :: w(:, :), q(:, :), mu(:)
    type(status_t), intent(inout) :: status
    real(wp), allocatable :: r(:)
    integer :: unit, error, d, contacts, a, i
    open (newunit=unit, file=name, action='read', status='old', iostat=error)
    if (error /= 0) then
      call fail(status, status_file, 'cannot read "'//name//'"')
      return
    end if
    read (unit, *, iostat=error)
    if (error == 0) read (unit, *, iostat=error) d, contacts
    if (error == 0) then
      if (d /= 2 .or. contacts < 1) error = 1
    end if
    if (error == 0) then
      allocate (w(d*contacts, d*contacts), q(d, contacts), mu(contacts), r(d))
      do a = 1, contacts
        if (error == 0) read (unit, *, iostat=error) mu(a), q(:, a), r
      end do
      do i = 1, d*contacts
        if (error == 0) read (unit, *, iostat=error) w(i, :)
      end do
    end if
    close (unit)
    if (error /= 0) call fail(status, status_deck, name// &
        ': it is cut, or holds other things than numbers')
  end subroutine read_text_problem

end module fclib_text
