! SPDX-License-Identifier: BSD-3-Clause
!> Dense symmetric positive definite blocks by LAPACK, and closed forms for 2 x 2.
!> A block is scaled by a power of two before the square roots of Cholesky, so that a change of
!> units by powers of two changes no digit.
module linalg_dense
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use base_checks, only: checks_on, assert, assert_shape
  use base_kinds, only: wp, zero, one, half
  use base_status, only: status_t, fail, status_numerical
  use base_strings, only: to_text
  implicit none
  private

  type, public :: dense_spd_t
    integer :: n = 0
    integer :: lost = 0                 !< row of a lost pivot, 0 = none
    real(wp) :: scale = one             !< matrix = scale * L L'
    real(wp), allocatable :: l(:, :)    !< lower triangle of the Cholesky factor
  end type dense_spd_t

  public :: dense_factor, dense_solve, dense_inverse, solve_general, solve_banded, &
      solve_small, cross, largest_eigenvalue_2, largest_eigenvalue, largest_by_lapack

  interface
    subroutine dpotrf(uplo, n, a, lda, info)
      import :: wp
      character, intent(in) :: uplo
      integer, intent(in) :: n, lda
      real(wp), intent(inout) :: a(lda, *)
      integer, intent(out) :: info
    end subroutine dpotrf
    subroutine dpotrs(uplo, n, nrhs, a, lda, b, ldb, info)
      import :: wp
      character, intent(in) :: uplo
      integer, intent(in) :: n, nrhs, lda, ldb
      real(wp), intent(in) :: a(lda, *)
      real(wp), intent(inout) :: b(ldb, *)
      integer, intent(out) :: info
    end subroutine dpotrs
    subroutine dpotri(uplo, n, a, lda, info)
      import :: wp
      character, intent(in) :: uplo
      integer, intent(in) :: n, lda
      real(wp), intent(inout) :: a(lda, *)
      integer, intent(out) :: info
    end subroutine dpotri
    subroutine dsyev(jobz, uplo, n, a, lda, w, work, lwork, info)
      import :: wp
      character, intent(in) :: jobz, uplo
      integer, intent(in) :: n, lda, lwork
      real(wp), intent(inout) :: a(lda, *)
      real(wp), intent(out) :: w(*)
      real(wp), intent(inout) :: work(*)
      integer, intent(out) :: info
    end subroutine dsyev
    subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
      import :: wp
      integer, intent(in) :: n, nrhs, lda, ldb
      real(wp), intent(inout) :: a(lda, *)
      integer, intent(out) :: ipiv(*)
      real(wp), intent(inout) :: b(ldb, *)
      integer, intent(out) :: info
    end subroutine dgesv
    subroutine dgbsv(n, kl, ku, nrhs, ab, ldab, ipiv, b, ldb, info)
      import :: wp
      integer, intent(in) :: n, kl, ku, nrhs, ldab, ldb
      real(wp), intent(inout) :: ab(ldab, *)
      integer, intent(out) :: ipiv(*)
      real(wp), intent(inout) :: b(ldb, *)
      integer, intent(out) :: info
    end subroutine dgbsv
  end interface

contains

  !> Cholesky factor of the symmetric positive definite matrix held in block%l; fails when it is
  !> not.
  subroutine dense_factor(block, status)
    type(dense_spd_t), intent(inout) :: block
    type(status_t), intent(inout) :: status
    real(wp) :: largest
    integer :: j
    block%n = size(block%l, 1)
    block%lost = 0
    if (checks_on) call assert_shape(shape(block%l), [block%n, block%n], 'dense_factor', &
        'block%l')
    if (block%n == 0) return
    largest = zero
    do j = 1, block%n
      largest = max(largest, block%l(j, j))
    end do
    block%scale = one
    if (largest > zero .and. largest <= huge(largest)) &
        block%scale = scale(one, exponent(largest))
    block%l = block%l/block%scale
    call dpotrf('L', block%n, block%l, block%n, block%lost)
    if (block%lost /= 0) call fail(status, status_numerical, 'lost pivot '// &
        to_text(block%lost)//' in the contact block: the matrix is not positive definite', &
        hint='check mass, stiffness and time step of the bodies in contact')
  end subroutine dense_factor

  !> b = matrix^-1 b for one right-hand side of n entries (any shape).
  subroutine dense_solve(block, n, b)
    type(dense_spd_t), intent(in) :: block
    integer, intent(in) :: n
    real(wp), intent(inout) :: b(n)
    integer :: info
    if (checks_on) call assert(n == block%n, 'dense_solve', 'b has as many entries as the'// &
        ' matrix has rows')
    call dpotrs('L', n, 1, block%l, n, b, n, info)
    b = b/block%scale
  end subroutine dense_solve

  !> inverse = matrix^-1, both triangles.
  subroutine dense_inverse(block, inverse)
    type(dense_spd_t), intent(in) :: block
    real(wp), intent(out), contiguous :: inverse(:, :)
    integer :: j, info
    if (checks_on) call assert_shape(shape(inverse), [block%n, block%n], 'dense_inverse', &
        'inverse')
    inverse = block%l
    call dpotri('L', block%n, inverse, block%n, info)
    do j = 1, block%n
      inverse(j:, j) = inverse(j:, j)/block%scale
      inverse(j, j:) = inverse(j:, j)
    end do
  end subroutine dense_inverse

  !> Solves the general system a x = b for the columns of b (n rows or more); a is destroyed, b
  !> becomes x; ok is false when it is singular.
  subroutine solve_general(n, a, b, pivot, ok)
    integer, intent(in) :: n
    real(wp), intent(inout) :: a(:, :)
    real(wp), intent(inout) :: b(:, :)
    integer, intent(inout) :: pivot(:)
    logical, intent(out) :: ok
    integer :: info
    if (checks_on) call assert(min(size(a, 1), size(a, 2), size(b, 1), size(pivot)) >= n, &
        'solve_general', 'a, b and pivot hold n rows')
    call dgesv(n, size(b, 2), a, size(a, 1), pivot, b, size(b, 1), info)
    ok = info == 0
  end subroutine solve_general

  !> The same for a band of `width` on either side of the diagonal, kept by diagonals: a(i, j)
  !> of the matrix is a(2 width + 1 + i - j, j), the first `width` rows are room for exchanges.
  subroutine solve_banded(n, width, a, b, pivot, ok)
    integer, intent(in) :: n, width
    real(wp), intent(inout) :: a(:, :)
    real(wp), intent(inout) :: b(:, :)
    integer, intent(inout) :: pivot(:)
    logical, intent(out) :: ok
    integer :: info
    if (checks_on) call assert(min(size(a, 2), size(b, 1), size(pivot)) >= n .and. &
        size(a, 1) > 3*width, 'solve_banded', 'a holds 3 width + 1 diagonals of n entries, '// &
        'b and pivot n rows')
    call dgbsv(n, width, width, size(b, 2), a, size(a, 1), pivot, b, size(b, 1), info)
    ok = info == 0
  end subroutine solve_banded

  !> Largest eigenvalue of the symmetric part of a 2 x 2 matrix.
  pure real(wp) function largest_eigenvalue_2(a)
    real(wp), intent(in) :: a(:, :)
    real(wp) :: mean, difference, shear
    mean = half*(a(1, 1) + a(2, 2))
    difference = half*(a(1, 1) - a(2, 2))
    shear = half*(a(1, 2) + a(2, 1))
    largest_eigenvalue_2 = mean + sqrt(difference**2 + shear**2)
  end function largest_eigenvalue_2

  !> Largest eigenvalue of a symmetric matrix of any order, which is destroyed; only its lower
  !> triangle is read. NaN where there is none.
  subroutine largest_by_lapack(a, largest)
    real(wp), intent(inout) :: a(:, :)
    real(wp), intent(out) :: largest
    real(wp) :: values(size(a, 1)), work(4*size(a, 1))
    integer :: info
    if (checks_on) call assert_shape(shape(a), [1, 1]*size(a, 1), 'largest_by_lapack', 'a')
    call dsyev('N', 'L', size(a, 1), a, size(a, 1), values, work, size(work), info)
    largest = values(size(values))
    if (info /= 0) largest = ieee_value(one, ieee_quiet_nan)
  end subroutine largest_by_lapack

  !> Largest eigenvalue of the symmetric part of a matrix of order 1 to 3. Order 3: the
  !> trigonometric root of the characteristic polynomial (Smith 1961).
  pure real(wp) function largest_eigenvalue(a)
    real(wp), intent(in) :: a(:, :)
    real(wp) :: b(3, 3), mean, spread, half_determinant
    integer :: i
    select case (size(a, 1))
    case (1)
      largest_eigenvalue = a(1, 1)
    case (2)
      largest_eigenvalue = largest_eigenvalue_2(a)
    case default
      b = half*(a + transpose(a))
      mean = (b(1, 1) + b(2, 2) + b(3, 3))/3.0_wp
      do i = 1, 3
        b(i, i) = b(i, i) - mean
      end do
      spread = sqrt(sum(b**2)/6.0_wp)
      largest_eigenvalue = mean
      if (.not. spread > zero) return
      b = b/spread
      half_determinant = half*(b(1, 1)*(b(2, 2)*b(3, 3) - b(2, 3)*b(3, 2)) &
          - b(1, 2)*(b(2, 1)*b(3, 3) - b(2, 3)*b(3, 1)) &
          + b(1, 3)*(b(2, 1)*b(3, 2) - b(2, 2)*b(3, 1)))
      largest_eigenvalue = mean &
          + 2.0_wp*spread*cos(acos(min(one, max(-one, half_determinant)))/3.0_wp)
    end select
  end function largest_eigenvalue

  !> x = a^-1 b of order 1 to 3 by Cramer's rule; ok is false where a is singular to round-off.
  pure subroutine solve_small(a, b, x, ok)
    real(wp), intent(in) :: a(:, :), b(:)
    real(wp), intent(out) :: x(:)
    logical, intent(out) :: ok
    real(wp) :: determinant, scale
    scale = maxval(abs(a))
    select case (size(b))
    case (1)
      determinant = a(1, 1)
      ok = abs(determinant) > zero
      if (ok) x(1) = b(1)/determinant
    case (2)
      determinant = a(1, 1)*a(2, 2) - a(1, 2)*a(2, 1)
      ok = abs(determinant) > 8.0_wp*epsilon(one)*scale**2
      if (ok) x = [b(1)*a(2, 2) - a(1, 2)*b(2), a(1, 1)*b(2) - b(1)*a(2, 1)]/determinant
    case default
      determinant = dot_product(a(:, 1), cross(a(:, 2), a(:, 3)))
      ok = abs(determinant) > 8.0_wp*epsilon(one)*scale**3
      if (.not. ok) return
      x(1) = dot_product(b, cross(a(:, 2), a(:, 3)))/determinant
      x(2) = dot_product(a(:, 1), cross(b, a(:, 3)))/determinant
      x(3) = dot_product(a(:, 1), cross(a(:, 2), b))/determinant
    end select
  end subroutine solve_small

  !> a x b.
  pure function cross(a, b) result(c)
    real(wp), intent(in) :: a(3), b(3)
    real(wp) :: c(3)
    c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function cross

end module linalg_dense
