! SPDX-License-Identifier: BSD-3-Clause
!> Products of panels: strips with vectors of two and of four numbers give the same digits,
!> those of sums taken one product after another; panels of any width and height.
program test_panels
  use base_kinds, only: wp, zero, one
  use base_strings, only: to_text
  use base_system, only: has_wide_vectors
  use check, only: test_start, test_end, check_equal, check_true, seed_random
  use linalg_panels, only: eliminate_panel
  use linalg_tile, only: subtract_strip, strip_rows
  use linalg_tile_wide, only: subtract_strip_wide => subtract_strip
  implicit none
  integer :: k, wrong, checked
  logical :: wide

  call test_start('panels')
  call seed_random(7)
  wide = has_wide_vectors()
  if (.not. wide) print '(a)', 'no vectors of four numbers here: those strips are not tested'
  wrong = 0
  checked = 0
  do k = 1, 60
    call check_strips(drawn(200), drawn(300), wrong, checked)
  end do
  call check_equal(wrong, 0, 'entries of strips that differ from single sums')
  call check_true(checked > 100000, 'entries were compared')
  do k = 1, 40
    call check_panel(drawn(150), drawn(200) - 1)
  end do
  call test_end()

contains

  !> A number from 1 to n.
  integer function drawn(n)
    integer, intent(in) :: n
    real(wp) :: r
    call random_number(r)
    drawn = 1 + int(r*n)
  end function drawn

  !> c = c - L M' of m rows and some columns, by strips and by single sums, which are the same
  !> digit for digit where no product is fused with its sum, which the compiler may do where the
  !> processor was named to it: then within their round-off.
  subroutine check_strips(m, depth, wrong, checked)
    integer, intent(in) :: m, depth
    integer, intent(inout) :: wrong, checked
    real(wp), allocatable :: l(:, :), start(:, :), c(:, :), other(:, :), sums(:, :)
    integer :: n, i, j, k
    n = drawn(m)
    allocate (l(m + 3, depth), start(m + 1, n))
    call random_number(l)
    call random_number(start)
    c = start
    other = start
    sums = start
    do i = 0, m - 1, strip_rows
      call subtract_strip(m, n, depth, m + 3, l, m + 1, c, i)
      if (wide) call subtract_strip_wide(m, n, depth, m + 3, l, m + 1, other, i)
    end do
    do j = 1, n
      do k = 1, depth
        sums(j:m, j) = sums(j:m, j) - l(j:m, k)*l(j, k)
      end do
      do i = j, m
        checked = checked + 1
        if (abs(c(i, j) - sums(i, j)) > depth*epsilon(one)*(depth + one)) wrong = wrong + 1
        if (wide .and. transfer(c(i, j), 0_8) /= transfer(other(i, j), 0_8)) wrong = wrong + 1
      end do
    end do
    if (any(abs(c(m + 1, :) - start(m + 1, :)) > zero)) wrong = wrong + 1  ! the row below
  end subroutine check_strips

  !> A panel of some columns and rows below: L L' is what was given, and what is subtracted
  !> below is L21 L21', with both kinds of vectors in the same digits.
  subroutine check_panel(width, below)
    integer, intent(in) :: width, below
    real(wp), allocatable, dimension(:, :) :: a, panel, update, other, rest, l
    real(wp) :: off
    integer :: j, lost
    allocate (a(width + below, width))
    call random_number(a)
    do j = 1, width
      a(:j - 1, j) = zero
      a(j, j) = a(j, j) + width + below
    end do
    panel = a
    allocate (update(below, below), source=zero)
    call eliminate_panel(width, width + below, 1, .false., panel, update, lost)
    call check_equal(lost, 0, 'no pivot is lost')
    l = panel
    do j = 1, width
      l(:j - 1, j) = zero
      l(j, j) = one/l(j, j)
    end do
    off = maxval(abs(lower(matmul(l, transpose(l(:width, :)))) - a))
    call check_true(off < 1.0e-14_wp*(width + below)*width, 'L L'' of a panel of '// &
        to_text(width)//' + '//to_text(below))
    if (below > 0) then
      off = maxval(abs(lower(update + matmul(l(width + 1:, :), transpose(l(width + 1:, :))))))
      call check_true(off < 1.0e-14_wp*width, 'its update')
    end if
    if (.not. wide) return
    other = a
    allocate (rest(below, below), source=zero)
    call eliminate_panel(width, width + below, 1, .true., other, rest, lost)
    call check_true(.not. (any(abs(lower(other) - lower(panel)) > zero) .or. &
        any(abs(lower(rest) - lower(update)) > zero)), 'the same digits')
  end subroutine check_panel

  !> Zeros above the diagonal.
  pure function lower(a)
    real(wp), intent(in) :: a(:, :)
    real(wp) :: lower(size(a, 1), size(a, 2))
    integer :: j
    lower = a
    do j = 2, size(a, 2)
      lower(:min(j - 1, size(a, 1)), j) = zero
    end do
  end function lower

end program test_panels
