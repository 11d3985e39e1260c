! SPDX-License-Identifier: BSD-3-Clause
!> Eigenvalues of symmetric matrices, by LAPACK.
module eigenvalues
  use base_kinds, only: wp
  implicit none
  private
  public :: all_eigenvalues

  interface
    subroutine dsyev(jobz, uplo, n, a, lda, w, work, lwork, info)
      import :: wp
      character, intent(in) :: jobz, uplo
      integer, intent(in) :: n, lda, lwork
      real(wp), intent(inout) :: a(lda, *)
      real(wp), intent(out) :: w(*)
      real(wp), intent(inout) :: work(*)
      integer, intent(out) :: info
    end subroutine dsyev
  end interface

contains

  !> In ascending order; the columns of vector are their unit vectors.
  subroutine all_eigenvalues(a, value, vector)
    real(wp), intent(in) :: a(:, :)
    real(wp), intent(out) :: value(:)
    real(wp), intent(out), optional :: vector(:, :)
    real(wp) :: work(size(a, 1), size(a, 1)), room(8*size(a, 1))
    integer :: info
    work = a
    room = 0
    call dsyev('V', 'L', size(a, 1), work, size(a, 1), value, room, size(room), info)
    if (info /= 0) stop 'dsyev failed'
    if (present(vector)) vector = work
  end subroutine all_eigenvalues

end module eigenvalues
