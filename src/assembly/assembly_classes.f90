! SPDX-License-Identifier: BSD-3-Clause
!> Elements whose stiffness matrices have the same bits are a class and share one matrix: no
!> digit of any product depends on that. On a regular mesh a few classes, which stay in the fast
!> memory of a processor, take the place of a matrix of each element, which would be read anew
!> in each product.
module assembly_classes
  use base_kinds, only: wp, i8
  implicit none
  private

  !> Matrices of so many bytes are not sorted: they stay in fast memory as they are.
  integer(i8), parameter :: small = 262144
  !> Classes are kept where at least so many elements are in one, in the mean.
  integer, parameter :: least = 8

  !> Classes of a block while they are made: chains of those with the same key.
  type, public :: classes_t
    integer :: n = 0                          !< classes so far
    integer, allocatable, private :: head(:)  !< (0:) newest class of a key, 0 = none
    integer, allocatable, private :: next(:)  !< an older one of the same key
  contains
    procedure :: begin
    procedure :: add
  end type classes_t

  public :: is_worth_classes, finish_classes

contains

  !> Are n matrices of m rows each worth sorting?
  pure logical function is_worth_classes(m, n)
    integer, intent(in) :: m, n
    is_worth_classes = 8_i8*m*m*n > small
  end function is_worth_classes

  !> No class yet; n: elements to come.
  pure subroutine begin(this, n)
    class(classes_t), intent(inout) :: this
    integer, intent(in) :: n
    this%n = 0
    if (allocated(this%head)) deallocate (this%head, this%next)
    allocate (this%head(0:n), source=0)
    allocate (this%next(n))
  end subroutine begin

  !> class: that of an element with the stiffness ke (m, m), whose matrix is k(:, :, class); a
  !> new one, at the end of those in k (m, m, *), where none has the same bits. The time for an
  !> element does not depend on their number.
  pure subroutine add(this, ke, k, class)
    class(classes_t), intent(inout) :: this
    real(wp), intent(in) :: ke(:, :)
    real(wp), intent(inout) :: k(:, :, :)
    integer, intent(out) :: class
    integer(i8) :: key
    integer :: at, j
    key = 0_i8
    do j = 1, size(ke, 2)
      key = mixed(key, ke(:, j))
    end do
    at = int(modulo(key, size(this%head, kind=i8)))
    class = this%head(at)
    do while (class > 0)
      if (are_same(size(ke), k(:, :, class), ke)) return
      class = this%next(class)
    end do
    this%n = this%n + 1
    class = this%n
    this%next(class) = this%head(at)
    this%head(at) = class
    k(:, :, class) = ke
  end subroutine add

  !> The key with the bits of more numbers.
  pure integer(i8) function mixed(key, number)
    integer(i8), intent(in) :: key
    real(wp), intent(in) :: number(:)
    integer :: i
    mixed = key
    do i = 1, size(number)
      mixed = ieor(ishftc(mixed, 13), transfer(number(i), mixed))
      mixed = ieor(mixed, ishft(mixed, 7))
      mixed = ieor(mixed, ishft(mixed, -9))
    end do
  end function mixed

  !> Have n numbers the same bits? (0 and -0 have not.)
  pure logical function are_same(n, a, b)
    integer, intent(in) :: n
    real(wp), intent(in) :: a(n), b(n)
    integer :: i
    are_same = .false.
    do i = 1, n
      if (transfer(a(i), 0_i8) /= transfer(b(i), 0_i8)) return
    end do
    are_same = .true.
  end function are_same

  !> k (m, m, elements), whose front has the classes, is cut to them; where they are too many
  !> for what they save, it becomes the matrices of the elements again, and class (elements) is
  !> gone.
  pure subroutine finish_classes(n, k, class)
    integer, intent(in) :: n
    real(wp), allocatable, intent(inout) :: k(:, :, :)
    integer, allocatable, intent(inout) :: class(:)
    real(wp), allocatable :: front(:, :, :)
    integer :: e
    if (n <= size(class)/least) then
      allocate (front(size(k, 1), size(k, 2), n))
      front = k(:, :, :n)
      call move_alloc(front, k)
      return
    end if
    do e = size(class), 1, -1       ! a class is never behind the first of its elements
      if (class(e) /= e) k(:, :, e) = k(:, :, class(e))
    end do
    deallocate (class)
  end subroutine finish_classes

end module assembly_classes
