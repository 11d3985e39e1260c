! SPDX-License-Identifier: BSD-3-Clause
!> Sparse matrices of FCLIB files: rows, columns or triplets, base 0, as rows of base 1.
module fclib_matrix
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use base_kinds, only: wp, zero
  use base_status, only: status_t, fail, failed, status_deck
  use hdf5_file, only: file_t, read_integers, read_reals
  implicit none
  private
  public :: read_matrix, transposed, complete_half, from_triplets

  type, public :: matrix_t
    integer :: rows = 0, columns = 0
    integer, allocatable :: first(:)     !< (rows + 1)
    integer, allocatable :: column(:)
    real(wp), allocatable :: value(:)
  end type matrix_t

contains

  !> Reads the group `path`: m, n, nz (-2 rows, -1 columns, >= 0 triplets with i = row, p =
  !> column), p, i, x. Only the entries that p or nz announce count; x may be longer.
  subroutine read_matrix(file, path, matrix, status)
    type(file_t), intent(in) :: file
    character(*), intent(in) :: path
    type(matrix_t), intent(out) :: matrix
    type(status_t), intent(inout) :: status
    integer, allocatable :: m(:), n(:), nz(:), p(:), i(:), major(:)
    real(wp), allocatable :: x(:)
    integer :: k, entries, lines
    call read_integers(file, path//'/m', m, status, 1)
    call read_integers(file, path//'/n', n, status, 1)
    call read_integers(file, path//'/nz', nz, status, 1)
    if (failed(status)) return
    lines = merge(m(1), n(1), nz(1) == -2)
    call read_integers(file, path//'/p', p, status, merge(nz(1), lines + 1, nz(1) >= 0))
    if (failed(status)) return
    if (min(m(1), n(1)) < 1 .or. nz(1) < -2) call fail(status, status_deck, &
        file%name//': '//path//': sizes or nz make no sense')
    if (failed(status)) return
    entries = nz(1)
    if (nz(1) < 0) entries = p(lines + 1)
    call read_integers(file, path//'/i', i, status, entries)
    call read_reals(file, path//'/x', x, status, entries)
    if (failed(status)) return
    if (.not. all(ieee_is_finite(x(:entries)))) call fail(status, status_deck, &
        file%name//': '//path//'/x is not finite (NaN or Inf)')
    if (nz(1) >= 0) then
      major = p(:entries)
    else
      if (any(p(2:lines + 1) < p(:lines)) .or. p(1) /= 0) call fail(status, status_deck, &
          file%name//': '//path//'/p does not grow from 0')
      if (failed(status)) return
      major = [(spread(k - 1, 1, p(k + 1) - p(k)), k=1, lines)]
    end if
    call check_range(file, path, nz(1), m(1), n(1), i(:entries), major, status)
    if (failed(status)) return
    if (nz(1) == -2) then
      call from_triplets(m(1), n(1), major + 1, i(:entries) + 1, x(:entries), matrix)
    else
      call from_triplets(m(1), n(1), i(:entries) + 1, major + 1, x(:entries), matrix)
    end if
  end subroutine read_matrix

  subroutine check_range(file, path, nz, m, n, i, major, status)
    type(file_t), intent(in) :: file
    character(*), intent(in) :: path
    integer, intent(in) :: nz, m, n, i(:), major(:)
    type(status_t), intent(inout) :: status
    integer :: most_i, most_major
    most_i = merge(n, m, nz == -2)
    most_major = merge(m, n, nz == -2)
    if (any(i < 0 .or. i >= most_i) .or. any(major < 0 .or. major >= most_major)) &
        call fail(status, status_deck, file%name//': '//path//': an index is out of range')
  end subroutine check_range

  !> Rows from entries in any order; those of one place stay apart and add up in use.
  pure subroutine from_triplets(m, n, row, column, value, matrix)
    integer, intent(in) :: m, n, row(:), column(:)
    real(wp), intent(in) :: value(:)
    type(matrix_t), intent(out) :: matrix
    integer :: k, at
    integer, allocatable :: next(:)
    matrix%rows = m
    matrix%columns = n
    allocate (matrix%first(m + 1), matrix%column(size(value)), matrix%value(size(value)))
    matrix%first = 0
    do k = 1, size(row)
      matrix%first(row(k) + 1) = matrix%first(row(k) + 1) + 1
    end do
    matrix%first(1) = 1
    do k = 1, m
      matrix%first(k + 1) = matrix%first(k + 1) + matrix%first(k)
    end do
    next = matrix%first
    do k = 1, size(row)
      at = next(row(k))
      next(row(k)) = at + 1
      matrix%column(at) = column(k)
      matrix%value(at) = value(k)
    end do
  end subroutine from_triplets

  !> The transpose.
  pure subroutine transposed(matrix, other)
    type(matrix_t), intent(in) :: matrix
    type(matrix_t), intent(out) :: other
    call from_triplets(matrix%columns, matrix%rows, matrix%column, row_of_entries(matrix), &
        matrix%value, other)
  end subroutine transposed

  pure function row_of_entries(matrix) result(row)
    type(matrix_t), intent(in) :: matrix
    integer :: row(size(matrix%value))
    integer :: k
    do k = 1, matrix%rows
      row(matrix%first(k):matrix%first(k + 1) - 1) = k
    end do
  end function row_of_entries

  !> A square matrix of which one strict triangle is empty, and the other not, is the half of a
  !> symmetric one: completes it.
  pure subroutine complete_half(matrix)
    type(matrix_t), intent(inout) :: matrix
    type(matrix_t) :: whole
    integer :: row(size(matrix%value))
    integer, allocatable :: mirror(:)
    logical :: lower, upper
    integer :: k
    row = row_of_entries(matrix)
    lower = any(row > matrix%column .and. abs(matrix%value) > zero)
    upper = any(row < matrix%column .and. abs(matrix%value) > zero)
    if (lower .eqv. upper) return
    mirror = pack([(k, k=1, size(row))], row /= matrix%column)
    call from_triplets(matrix%rows, matrix%columns, [row, matrix%column(mirror)], &
        [matrix%column, row(mirror)], [matrix%value, matrix%value(mirror)], whole)
    matrix = whole
  end subroutine complete_half

end module fclib_matrix
