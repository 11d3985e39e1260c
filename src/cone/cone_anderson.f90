! SPDX-License-Identifier: BSD-3-Clause
!> Anderson's acceleration of a fixed-point iteration r <- g(r) (Anderson 1965; type II of
!> Fang & Saad 2009): the next r is the combination of the last few that would have the smallest
!> change if g were linear.
module cone_anderson
  use base_kinds, only: wp, one
  use linalg_dense, only: solve_general
  implicit none
  private
  public :: anderson_t, start_anderson, extrapolate

  type :: anderson_t
    integer :: depth = 0           !< pairs kept at most
    integer :: held = 0, next = 1
    logical :: has_last = .false.
    real(wp), allocatable :: dg(:, :), df(:, :)      !< (n, depth) differences
    real(wp), allocatable :: g_last(:), f_last(:), f(:), plain(:)
    real(wp), allocatable :: gram(:, :), gamma(:, :)
    integer, allocatable :: pivot(:)
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
    allocate (memory%f(n), memory%plain(n), memory%gram(depth, depth), memory%gamma(depth, 1))
    allocate (memory%pivot(depth))
  end subroutine start_anderson

  !> From r before and g = g(r) after a sweep: the accelerated r, into g.
  subroutine extrapolate(memory, n, r, g)
    type(anderson_t), intent(inout) :: memory
    integer, intent(in) :: n
    real(wp), intent(in) :: r(n)
    real(wp), intent(inout) :: g(n)
    logical :: ok
    integer :: j
    memory%f = g - r
    if (memory%has_last) then
      memory%dg(:, memory%next) = g - memory%g_last
      memory%df(:, memory%next) = memory%f - memory%f_last
      memory%next = 1 + mod(memory%next, memory%depth)
      memory%held = min(memory%held + 1, memory%depth)
    end if
    memory%plain = g
    if (memory%held > 0) then
      call find_weights(memory, ok)
      if (ok) then
        do j = 1, memory%held
          g = g - memory%gamma(j, 1)*memory%dg(:, j)
        end do
      end if
    end if
    memory%g_last = memory%plain
    memory%f_last = memory%f
    memory%has_last = .true.
  end subroutine extrapolate

  !> gamma: least squares of df gamma = f by the normal equations.
  subroutine find_weights(memory, ok)
    type(anderson_t), intent(inout) :: memory
    logical, intent(out) :: ok
    integer :: i, j, k
    k = memory%held
    do j = 1, k
      do i = 1, j
        memory%gram(i, j) = dot_product(memory%df(:, i), memory%df(:, j))
        memory%gram(j, i) = memory%gram(i, j)
      end do
      memory%gamma(j, 1) = dot_product(memory%df(:, j), memory%f)
    end do
    do j = 1, k
      memory%gram(j, j) = memory%gram(j, j)*(one + 1.0e-10_wp)
    end do
    call solve_general(k, memory%gram, memory%gamma, memory%pivot, ok)
    ok = ok .and. all(abs(memory%gamma(:k, 1)) <= largest_weight)
  end subroutine find_weights

end module cone_anderson
