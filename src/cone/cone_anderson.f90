! SPDX-License-Identifier: BSD-3-Clause
!> Anderson's acceleration of a fixed-point iteration r <- g(r) (Anderson 1965; type II of
!> Fang & Saad 2009): the next r is the combination of the last few that would have the smallest
!> change if g were linear.
module cone_anderson
  use base_kinds, only: wp, zero, one
  use linalg_dense, only: solve_general
  implicit none
  private
  public :: anderson_t, start_anderson, extrapolate

  type :: anderson_t
    integer :: depth = 0           !< pairs kept at most
    integer :: held = 0, next = 1
    logical :: has_last = .false.
    real(wp), allocatable :: dg(:, :), df(:, :)      !< (n, depth) differences
    real(wp), allocatable :: g_last(:), f_last(:)
  end type anderson_t

  !> Combinations beyond this come from differences that are parallel to round-off.
  real(wp), parameter :: largest_weight = 1.0e4_wp

contains

  !> Forgets what it holds; makes the space for n unknowns once.
  pure subroutine start_anderson(memory, n, depth)
    type(anderson_t), intent(inout) :: memory
    integer, intent(in) :: n, depth
    memory%held = 0
    memory%next = 1
    memory%has_last = .false.
    if (memory%depth == depth) return
    memory%depth = depth
    allocate (memory%dg(n, depth), memory%df(n, depth), memory%g_last(n), memory%f_last(n))
  end subroutine start_anderson

  !> From r before and g = g(r) after a sweep: the accelerated r, into g.
  subroutine extrapolate(memory, n, r, g)
    type(anderson_t), intent(inout) :: memory
    integer, intent(in) :: n
    real(wp), intent(in) :: r(n)
    real(wp), intent(inout) :: g(n)
    real(wp) :: f(n), plain(n), gram(memory%depth, memory%depth), gamma(memory%depth, 1)
    integer :: pivot(memory%depth), i, j, k
    logical :: ok
    f = g - r
    if (memory%has_last) then
      memory%dg(:, memory%next) = g - memory%g_last
      memory%df(:, memory%next) = f - memory%f_last
      memory%next = 1 + mod(memory%next, memory%depth)
      memory%held = min(memory%held + 1, memory%depth)
    end if
    plain = g
    k = memory%held
    if (k > 0) then
      do j = 1, k
        do i = 1, j
          gram(i, j) = dot_product(memory%df(:, i), memory%df(:, j))
          gram(j, i) = gram(i, j)
        end do
        gamma(j, 1) = dot_product(memory%df(:, j), f)
      end do
      do j = 1, k
        gram(j, j) = gram(j, j)*(one + 1.0e-10_wp)
      end do
      call solve_general(k, gram, gamma(:k, :), pivot, ok)
      ok = ok .and. all(abs(gamma(:k, 1)) <= largest_weight)
      if (ok) then
        do j = 1, k
          g = g - gamma(j, 1)*memory%dg(:, j)
        end do
      end if
    end if
    memory%g_last = plain
    memory%f_last = f
    memory%has_last = .true.
  end subroutine extrapolate

end module cone_anderson
