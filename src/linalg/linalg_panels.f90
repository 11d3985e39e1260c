! SPDX-License-Identifier: BSD-3-Clause
!> Dense panels of a supernodal factor: a panel [A11; A21] holds some columns, lower triangle,
!> and the rows below them; its factor is L11 L11' = A11, L21 = A21 L11'^-1, with 1/L on the
!> diagonal. Products go by strips of rows, in plain Fortran at half the rate of a tuned BLAS or
!> more. A pass of a solve reads each panel once, x of its own columns and y of the rows below.
!> Large panels are split among threads by strips of fixed size; every entry has the same sums
!> for any number of threads and any width of vectors.
module linalg_panels
  use base_kinds, only: wp, zero, one
  use linalg_tile, only: subtract_strip, strip_rows
  use linalg_tile_wide, only: subtract_strip_wide => subtract_strip
  implicit none
  private
  public :: eliminate_panel, forward_panel, backward_panel, forward_split, backward_split, &
      is_wide, gather_rows, add_rows, list_places, add_columns

  !> Up to so many columns are eliminated singly.
  integer, parameter :: narrow = 8
  !> Multiplications of a product, entries below a panel, that are worth more than one thread.
  real(wp), parameter :: much_product = 5.0e5_wp
  integer, parameter :: much_below = 30000

contains

  !> Factor of a panel, and update = update - L21 L21', lower triangle. lost: the column of a
  !> lost pivot, 0 = none.
  subroutine eliminate_panel(width, height, threads, wide, panel, update, lost)
    integer, intent(in) :: width, height, threads
    logical, intent(in) :: wide
    real(wp), intent(inout) :: panel(height, width)
    real(wp), intent(inout) :: update(height - width, height - width)
    integer, intent(out) :: lost
    call factor_columns(width, height, height, threads, wide, panel, lost)
    if (lost > 0 .or. width == height) return
    call subtract_products(height - width, height - width, width, height, threads, wide, &
        panel(width + 1, 1), height - width, update)
  end subroutine eliminate_panel

  !> Factor of so many columns, by halves: the left one, its products taken from the right one.
  recursive subroutine factor_columns(width, height, stride, threads, wide, a, lost)
    integer, intent(in) :: width, height, stride, threads
    logical, intent(in) :: wide
    real(wp), intent(inout) :: a(stride, *)
    integer, intent(out) :: lost
    integer :: half, j, k
    lost = 0
    if (width > narrow) then
      half = 4*(width/8)
      call factor_columns(half, height, stride, threads, wide, a, lost)
      if (lost > 0) return
      call subtract_products(height - half, width - half, half, stride, threads, wide, &
          a(half + 1, 1), stride, a(half + 1, half + 1))
      call factor_columns(width - half, height - half, stride, threads, wide, &
          a(half + 1, half + 1), lost)
      if (lost > 0) lost = lost + half
      return
    end if
    do j = 1, width
      if (.not. (a(j, j) > zero .and. a(j, j) <= huge(zero))) then
        lost = j
        return
      end if
      a(j, j) = one/sqrt(a(j, j))
      a(j + 1:height, j) = a(j + 1:height, j)*a(j, j)
      do k = j + 1, width
        a(k:height, k) = a(k:height, k) - a(k:height, j)*a(k, j)
      end do
    end do
  end subroutine factor_columns

  !> c = c - L M', lower triangle: L has the m rows of c, M the first n of them, one for each
  !> column of c; both have `columns` columns. By strips of rows; threads take the
  !> longest first.
  subroutine subtract_products(m, n, columns, stride, threads, wide, l, stride_c, c)
    integer, intent(in) :: m, n, columns, stride, threads, stride_c
    logical, intent(in) :: wide
    real(wp), intent(in) :: l(stride, *)
    real(wp), intent(inout) :: c(stride_c, *)
    integer :: strip, strips
    strips = (m - 1)/strip_rows + 1
    if (threads > 1) then
      if (real(m, wp)*n*columns > much_product) then
        !$omp parallel do schedule(dynamic, 1) num_threads(threads)
        do strip = strips - 1, 0, -1
          call one_strip(wide, m, n, columns, stride, l, stride_c, c, strip_rows*strip)
        end do
        return
      end if
    end if
    do strip = 0, strips - 1
      call one_strip(wide, m, n, columns, stride, l, stride_c, c, strip_rows*strip)
    end do
  end subroutine subtract_products

  !> One strip, by the vectors of the processor.
  pure subroutine one_strip(wide, m, n, columns, stride, l, stride_c, c, i0)
    logical, intent(in) :: wide
    integer, intent(in) :: m, n, columns, stride, stride_c, i0
    real(wp), intent(in) :: l(stride, *)
    real(wp), intent(inout) :: c(stride_c, *)
    if (wide) then
      call subtract_strip_wide(m, n, columns, stride, l, stride_c, c, i0)
    else
      call subtract_strip(m, n, columns, stride, l, stride_c, c, i0)
    end if
  end subroutine one_strip

  !> x = L11^-1 x, y = -L21 x.
  pure subroutine forward_panel(width, below, l, x, y)
    integer, intent(in) :: width, below
    real(wp), intent(in) :: l(width + below, width)
    real(wp), intent(inout) :: x(width)
    real(wp), intent(out) :: y(below)
    call forward_columns(width, below, l, x)
    if (below > 0) call forward_tile(below, width, width + below, l(width + 1, 1), x, y)
  end subroutine forward_panel

  !> Is a panel worth more than one thread in the passes?
  pure logical function is_wide(width, below)
    integer, intent(in) :: width, below
    is_wide = real(width, wp)*below > much_below
  end function is_wide

  !> forward_panel with the rows below by strips, after the columns.
  subroutine forward_split(width, below, threads, l, x, y)
    integer, intent(in) :: width, below, threads
    real(wp), intent(in) :: l(width + below, width)
    real(wp), intent(inout) :: x(width)
    real(wp), intent(out) :: y(below)
    integer :: i
    call forward_columns(width, below, l, x)
    !$omp parallel do schedule(dynamic, 1) num_threads(threads)
    do i = 1, below, strip_rows
      call forward_tile(min(strip_rows, below - i + 1), width, width + below, &
          l(width + i, 1), x, y(i))
    end do
  end subroutine forward_split

  !> x = L11^-1 x.
  pure subroutine forward_columns(width, below, l, x)
    integer, intent(in) :: width, below
    real(wp), intent(in) :: l(width + below, width)
    real(wp), intent(inout) :: x(width)
    real(wp) :: t1, t2, t3, t4
    integer :: i, j
    do j = 1, width - 3, 4
      t1 = x(j)*l(j, j)
      t2 = (x(j + 1) - l(j + 1, j)*t1)*l(j + 1, j + 1)
      t3 = (x(j + 2) - l(j + 2, j)*t1 - l(j + 2, j + 1)*t2)*l(j + 2, j + 2)
      t4 = (x(j + 3) - l(j + 3, j)*t1 - l(j + 3, j + 1)*t2 - l(j + 3, j + 2)*t3) &
          *l(j + 3, j + 3)
      x(j:j + 3) = [t1, t2, t3, t4]
      do i = j + 4, width
        x(i) = x(i) - (l(i, j)*t1 + l(i, j + 1)*t2 + l(i, j + 2)*t3 + l(i, j + 3)*t4)
      end do
    end do
    do j = width - mod(width, 4) + 1, width
      x(j) = x(j)*l(j, j)
      x(j + 1:) = x(j + 1:) - l(j + 1:width, j)*x(j)
    end do
  end subroutine forward_columns

  !> y = -L x of m rows.
  pure subroutine forward_tile(m, width, height, l, x, y)
    integer, intent(in) :: m, width, height
    real(wp), intent(in) :: l(height, width)
    real(wp), intent(in) :: x(width)
    real(wp), intent(out) :: y(m)
    integer :: i, j
    y = zero
    do j = 1, width - 3, 4
      do i = 1, m
        y(i) = y(i) - (l(i, j)*x(j) + l(i, j + 1)*x(j + 1) + l(i, j + 2)*x(j + 2) &
            + l(i, j + 3)*x(j + 3))
      end do
    end do
    do j = width - mod(width, 4) + 1, width
      y = y - l(:m, j)*x(j)
    end do
  end subroutine forward_tile

  !> backward_panel with the products of the rows below by columns, before the columns.
  subroutine backward_split(width, below, threads, l, y, x)
    integer, intent(in) :: width, below, threads
    real(wp), intent(in) :: l(width + below, width)
    real(wp), intent(in) :: y(below)
    real(wp), intent(inout) :: x(width)
    real(wp) :: s(4, width/4)
    integer :: k
    !$omp parallel do schedule(dynamic, 4) num_threads(threads)
    do k = 1, width/4
      call pair_products(below, width + below, l(width + 1, 4*k - 3), y, s(:, k))
    end do
    call backward_columns(width, below, l, y, x, s)
  end subroutine backward_split

  !> x = L11'^-1 (x - L21' y).
  pure subroutine backward_panel(width, below, l, y, x)
    integer, intent(in) :: width, below
    real(wp), intent(in) :: l(width + below, width)
    real(wp), intent(in) :: y(below)
    real(wp), intent(inout) :: x(width)
    real(wp) :: s(4)
    integer :: j
    do j = width, width - mod(width, 4) + 1, -1
      x(j) = (x(j) - dot_product(l(j + 1:width, j), x(j + 1:)) &
          - dot_product(l(width + 1:, j), y))*l(j, j)
    end do
    do j = width - mod(width, 4) - 3, 1, -4
      s = zero
      if (j + 3 < width) &
          call four_products(width - j - 3, width + below, l(j + 4, j), x(j + 4), s)
      if (below > 0) call four_products(below, width + below, l(width + 1, j), y, s)
      call close_four(width + below, l(j, j), s, x(j))
    end do
  end subroutine backward_panel

  !> The same with the products of pairs of rows below known.
  pure subroutine backward_columns(width, below, l, y, x, below_sums)
    integer, intent(in) :: width, below
    real(wp), intent(in) :: l(width + below, width)
    real(wp), intent(in) :: y(below)
    real(wp), intent(inout) :: x(width)
    real(wp), intent(in) :: below_sums(4, *)
    real(wp) :: s(4)
    integer :: j
    do j = width, width - mod(width, 4) + 1, -1
      x(j) = (x(j) - dot_product(l(j + 1:width, j), x(j + 1:)) &
          - dot_product(l(width + 1:, j), y))*l(j, j)
    end do
    do j = width - mod(width, 4) - 3, 1, -4
      s = zero
      if (j + 3 < width) &
          call four_products(width - j - 3, width + below, l(j + 4, j), x(j + 4), s)
      s = s + below_sums(:, (j + 3)/4)
      if (mod(below, 2) == 1) s = s + l(width + below, j:j + 3)*y(below)
      call close_four(width + below, l(j, j), s, x(j))
    end do
  end subroutine backward_columns

  !> Four unknowns from the last to the first, s what the known ones take from them.
  pure subroutine close_four(height, l, s, x)
    integer, intent(in) :: height
    real(wp), intent(in) :: l(height, *), s(4)
    real(wp), intent(inout) :: x(4)
    x(4) = (x(4) - s(4))*l(4, 4)
    x(3) = (x(3) - s(3) - l(4, 3)*x(4))*l(3, 3)
    x(2) = (x(2) - s(2) - l(3, 2)*x(3) - l(4, 2)*x(4))*l(2, 2)
    x(1) = (x(1) - s(1) - l(2, 1)*x(2) - l(3, 1)*x(3) - l(4, 1)*x(4))*l(1, 1)
  end subroutine close_four

  !> s = s + L' y for n rows of four columns; even and odd rows have sums of their own.
  pure subroutine four_products(n, height, l, y, s)
    integer, intent(in) :: n, height
    real(wp), intent(in) :: l(height, *)
    real(wp), intent(in) :: y(n)
    real(wp), intent(inout) :: s(4)
    real(wp), dimension(2) :: s1, s2, s3, s4
    integer :: i
    s1 = zero
    s2 = zero
    s3 = zero
    s4 = zero
    do i = 1, n - 1, 2
      s1 = s1 + l(i:i + 1, 1)*y(i:i + 1)
      s2 = s2 + l(i:i + 1, 2)*y(i:i + 1)
      s3 = s3 + l(i:i + 1, 3)*y(i:i + 1)
      s4 = s4 + l(i:i + 1, 4)*y(i:i + 1)
    end do
    s = s + [s1(1) + s1(2), s2(1) + s2(2), s3(1) + s3(2), s4(1) + s4(2)]
    if (mod(n, 2) == 1) s = s + l(n, 1:4)*y(n)
  end subroutine four_products

  !> s = L' y for the rows of n that have a pair, of four columns.
  pure subroutine pair_products(n, height, l, y, s)
    integer, intent(in) :: n, height
    real(wp), intent(in) :: l(height, *)
    real(wp), intent(in) :: y(n)
    real(wp), intent(out) :: s(4)
    s = zero
    call four_products(n - mod(n, 2), height, l, y, s)
  end subroutine pair_products

  !> y = x in the rows of a list, d unknowns each.
  pure subroutine gather_rows(d, n, row, x, y)
    integer, intent(in) :: d, n
    integer, intent(in) :: row(n)
    real(wp), intent(in) :: x(d, *)
    real(wp), intent(out) :: y(d, n)
    integer :: k
    do k = 1, n
      y(:, k) = x(:, row(k))
    end do
  end subroutine gather_rows

  !> x = x + y there.
  pure subroutine add_rows(d, n, row, y, x)
    integer, intent(in) :: d, n
    integer, intent(in) :: row(n)
    real(wp), intent(in) :: y(d, n)
    real(wp), intent(inout) :: x(d, *)
    integer :: k
    do k = 1, n
      x(:, row(k)) = x(:, row(k)) + y(:, k)
    end do
  end subroutine add_rows

  !> The place of each unknown of some nodes.
  pure subroutine list_places(d, node, place, to)
    integer, intent(in) :: d
    integer, intent(in) :: node(:), place(:)
    integer, allocatable, intent(out) :: to(:)
    integer :: k, i
    allocate (to(d*size(node)))
    do k = 1, size(node)
      do i = 1, d
        to(d*(k - 1) + i) = place(node(k)) + i
      end do
    end do
  end subroutine list_places

  !> Adds columns first..last of the lower triangle of a to b; row i of a is row to(i) of b.
  pure subroutine add_columns(n, a, first, last, to, height, b)
    integer, intent(in) :: n, first, last, height
    real(wp), intent(in) :: a(n, n)
    integer, intent(in) :: to(n)
    real(wp), intent(inout) :: b(height, *)
    integer :: i, j, column
    do j = first, last
      column = to(j)
      do i = j, n
        b(to(i), column) = b(to(i), column) + a(i, j)
      end do
    end do
  end subroutine add_columns

end module linalg_panels
