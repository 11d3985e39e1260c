! SPDX-License-Identifier: BSD-3-Clause
!> A table of named arrays that holds everything a run needs to go on from where it is. Every
!> owner of state names its arrays once, in one procedure that serves saving and restoring
!> alike; whoever keeps the table (in memory, in a file) knows nothing else about them.
module base_archive
  use base_kinds, only: wp
  use base_status, only: status_t, fail, failed, status_file
  implicit none
  private
  integer, parameter, public :: archive_save = 1
  integer, parameter, public :: archive_restore = 2

  type, public :: archive_entry_t
    character(32) :: name = ''
    real(wp), allocatable :: values(:)
  end type archive_entry_t

  type, public :: archive_t
    integer :: mode = archive_save
    integer :: n = 0        !< entries saved
    integer :: next = 1     !< entry to be restored next
    type(archive_entry_t), allocatable :: entry(:)
    type(status_t) :: status
  contains
    procedure :: rewind => archive_rewind
    procedure :: agree => archive_agree
    procedure :: exchange_integer
    procedure :: exchange_real
    procedure :: exchange_vector
    procedure :: exchange_matrix
    procedure :: exchange_integers
    procedure :: exchange_logical
    procedure :: exchange_logicals
    generic :: exchange => exchange_integer, exchange_real, exchange_vector, exchange_matrix, &
        exchange_integers, exchange_logical, exchange_logicals
  end type archive_t

contains

  !> Starts over: saving anew, or restoring what was saved.
  subroutine archive_rewind(this, mode)
    class(archive_t), intent(inout) :: this
    integer, intent(in) :: mode
    this%mode = mode
    this%next = 1
    this%status = status_t()
    if (mode == archive_save) this%n = 0
    if (.not. allocated(this%entry)) allocate (this%entry(64))
  end subroutine archive_rewind

  !> For entries that are kept only where they are wanted: `both` tells whether those whose
  !> names begin with prefix are exchanged now. Saved ones that are not wanted are passed over.
  subroutine archive_agree(this, prefix, wanted, both)
    class(archive_t), intent(inout) :: this
    character(*), intent(in) :: prefix
    logical, intent(in) :: wanted
    logical, intent(out) :: both
    both = wanted
    if (this%mode == archive_save) return
    both = comes_next(this, prefix) .and. wanted
    if (wanted) return
    do while (comes_next(this, prefix))
      this%next = this%next + 1
    end do
  end subroutine archive_agree

  pure logical function comes_next(this, prefix)
    type(archive_t), intent(in) :: this
    character(*), intent(in) :: prefix
    comes_next = this%next <= this%n
    if (comes_next) comes_next = index(this%entry(this%next)%name, prefix) == 1
  end function comes_next

  !> Saves or restores the values of one entry; a name or size that does not fit is a failure.
  subroutine exchange_vector(this, name, values)
    class(archive_t), intent(inout) :: this
    character(*), intent(in) :: name
    real(wp), intent(inout) :: values(:)
    if (failed(this%status)) return
    if (this%mode == archive_save) then
      if (this%n == size(this%entry)) call enlarge(this)
      this%n = this%n + 1
      this%entry(this%n)%name = name
      this%entry(this%n)%values = values
    else if (this%next > this%n) then
      call fail(this%status, status_file, 'the archive ends before "'//name//'"')
    else if (this%entry(this%next)%name /= name) then
      call fail(this%status, status_file, 'the archive has no "'//name// &
          '" where it is expected')
    else if (size(this%entry(this%next)%values) /= size(values)) then
      call fail(this%status, status_file, 'the archive holds "'//name//'" in another size')
    else
      values = this%entry(this%next)%values
      this%next = this%next + 1
    end if
  end subroutine exchange_vector

  subroutine enlarge(this)
    class(archive_t), intent(inout) :: this
    type(archive_entry_t), allocatable :: more(:)
    allocate (more(2*size(this%entry)))
    more(:this%n) = this%entry
    call move_alloc(more, this%entry)
  end subroutine enlarge

  subroutine exchange_real(this, name, number)
    class(archive_t), intent(inout) :: this
    character(*), intent(in) :: name
    real(wp), intent(inout) :: number
    real(wp) :: values(1)
    values = number
    call this%exchange_vector(name, values)
    number = values(1)
  end subroutine exchange_real

  subroutine exchange_matrix(this, name, matrix)
    class(archive_t), intent(inout) :: this
    character(*), intent(in) :: name
    real(wp), intent(inout) :: matrix(:, :)
    real(wp) :: values(size(matrix))
    values = reshape(matrix, [size(matrix)])
    call this%exchange_vector(name, values)
    matrix = reshape(values, shape(matrix))
  end subroutine exchange_matrix

  subroutine exchange_integer(this, name, number)
    class(archive_t), intent(inout) :: this
    character(*), intent(in) :: name
    integer, intent(inout) :: number
    real(wp) :: values(1)
    values = real(number, wp)
    call this%exchange_vector(name, values)
    number = nint(values(1))
  end subroutine exchange_integer

  subroutine exchange_integers(this, name, numbers)
    class(archive_t), intent(inout) :: this
    character(*), intent(in) :: name
    integer, intent(inout) :: numbers(:)
    real(wp) :: values(size(numbers))
    values = real(numbers, wp)
    call this%exchange_vector(name, values)
    numbers = nint(values)
  end subroutine exchange_integers

  subroutine exchange_logical(this, name, is)
    class(archive_t), intent(inout) :: this
    character(*), intent(in) :: name
    logical, intent(inout) :: is
    integer :: number
    number = merge(1, 0, is)
    call this%exchange_integer(name, number)
    is = number /= 0
  end subroutine exchange_logical

  subroutine exchange_logicals(this, name, are)
    class(archive_t), intent(inout) :: this
    character(*), intent(in) :: name
    logical, intent(inout) :: are(:)
    integer :: numbers(size(are))
    numbers = merge(1, 0, are)
    call this%exchange_integers(name, numbers)
    are = numbers /= 0
  end subroutine exchange_logicals

end module base_archive
