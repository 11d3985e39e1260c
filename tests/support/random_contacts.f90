! SPDX-License-Identifier: BSD-3-Clause
!> Random contact problems that have a solution: W = B B', and some motion opens every contact
!> strictly, B v + q in the interior of the dual cone (Acary, Cadoux, Lemarechal & Malick 2011).
module random_contacts
  use base_kinds, only: wp, zero, one
  use cone_blocks, only: delassus_blocks_t, blocks_from_dense
  implicit none
  private
  public :: make_problem

contains

  !> W (d nc, d nc) of a condition between 1 and `condition` and rank d nc / redundancy, q, for
  !> one mu.
  subroutine make_problem(d, contacts, condition, redundancy, mu, blocks, q)
    integer, intent(in) :: d, contacts
    real(wp), intent(in) :: condition, redundancy, mu
    type(delassus_blocks_t), intent(out) :: blocks
    real(wp), intent(out) :: q(d, contacts)
    real(wp), allocatable :: b(:, :), v(:), s(:, :)
    integer :: n, rank, j, a
    n = d*contacts
    rank = max(1, nint(n/redundancy))
    allocate (b(n, rank), v(rank), s(d, contacts))
    do j = 1, rank
      call fill_random(b(:, j))
      b(:, j) = b(:, j)*condition**(-0.5_wp*(j - 1)/max(1, rank - 1))
    end do
    call fill_random(v)
    do a = 1, contacts
      call fill_random(s(:, a))
      s(2:, a) = s(2:, a)/(one + mu)
      s(1, a) = 0.01_wp + 0.1_wp*abs(s(1, a)) + mu*sqrt(sum(s(2:, a)**2))
    end do
    q = s - 10.0_wp*reshape(matmul(b, v), [d, contacts])
    call blocks_from_dense(matmul(b, transpose(b)), d, blocks)
  end subroutine make_problem

  subroutine fill_random(x)
    real(wp), intent(out) :: x(:)
    call random_number(x)
    x = 2.0_wp*x - one
    if (size(x) > 0 .and. .not. any(abs(x) > zero)) x(1) = one
  end subroutine fill_random

end module random_contacts
