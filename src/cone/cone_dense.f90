! SPDX-License-Identifier: BSD-3-Clause
!> W as a plain matrix. A sweep keeps u up to date by the columns of what has changed: contacts
!> that rest cost nothing.
module cone_dense
  use base_kinds, only: wp, zero
  use cone_delassus, only: delassus_t, delassus_entries_t
  use cone_types, only: cone_options_t, most_components
  use cone_visit, only: visit_contact
  implicit none
  private

  !> Its owner sizes it and fills the matrix in place.
  type, extends(delassus_entries_t), public :: delassus_dense_t
    real(wp), allocatable :: matrix(:, :)   !< (d nc, d nc) [L/F]
  contains
    procedure :: resize
    procedure :: diagonal_block
    procedure :: rescaled
    procedure :: add_product
    procedure :: visit
  end type delassus_dense_t

contains

  !> Space for nc contacts of d components; nothing is done where it fits already.
  pure subroutine resize(this, d, contacts)
    class(delassus_dense_t), intent(inout) :: this
    integer, intent(in) :: d, contacts
    if (allocated(this%matrix) .and. this%d == d .and. this%contacts == contacts) return
    this%d = d
    this%contacts = contacts
    if (allocated(this%matrix)) deallocate (this%matrix)
    allocate (this%matrix(d*contacts, d*contacts))
  end subroutine resize

  pure subroutine diagonal_block(this, a, block)
    class(delassus_dense_t), intent(in) :: this
    integer, intent(in) :: a
    real(wp), intent(inout) :: block(most_components, most_components)
    integer :: i, j, row
    row = this%d*(a - 1)
    do j = 1, this%d
      do i = 1, this%d
        block(i, j) = this%matrix(row + i, row + j)
      end do
    end do
  end subroutine diagonal_block

  subroutine rescaled(this, power, other)
    class(delassus_dense_t), intent(in) :: this
    integer, intent(in) :: power
    class(delassus_t), allocatable, intent(out) :: other
    type(delassus_dense_t), allocatable :: w
    allocate (w)
    call w%resize(this%d, this%contacts)
    w%matrix = scale(this%matrix, power)
    call move_alloc(w, other)
  end subroutine rescaled

  pure subroutine add_product(this, r, u)
    class(delassus_dense_t), intent(in) :: this
    real(wp), intent(in), contiguous :: r(:, :)
    real(wp), intent(inout), contiguous :: u(:, :)
    integer :: a, i
    do a = 1, size(r, 2)
      do i = 1, size(r, 1)
        if (abs(r(i, a)) > zero) &
            call add_column(this%matrix(:, this%d*(a - 1) + i), r(i, a), u)
      end do
    end do
  end subroutine add_product

  pure subroutine visit(this, options, a, mu, rho, enough, most, q, r, u, status, iterations)
    class(delassus_dense_t), intent(in) :: this
    type(cone_options_t), intent(in) :: options
    integer, intent(in) :: a
    real(wp), intent(in) :: mu, rho, enough
    integer, intent(in) :: most
    real(wp), intent(in), contiguous :: q(:, :)
    real(wp), intent(inout), contiguous :: r(:, :), u(:, :)
    integer, intent(out) :: status, iterations
    real(wp), dimension(most_components) :: own, old
    integer :: i, d, row
    d = size(r, 1)
    row = d*(a - 1)
    old(:d) = r(:, a)
    own(:d) = u(:, a)
    call visit_contact(options, this%matrix(row + 1:row + d, row + 1:row + d), mu, rho, &
        enough, most, r(:, a), own(:d), status, iterations)
    do i = 1, d
      if (abs(r(i, a) - old(i)) > zero) &
          call add_column(this%matrix(:, row + i), r(i, a) - old(i), u)
    end do
  end subroutine visit

  pure subroutine add_column(column, factor, u)
    real(wp), intent(in), contiguous :: column(:)
    real(wp), intent(in) :: factor
    real(wp), intent(inout) :: u(*)
    integer :: i
    do i = 1, size(column)
      u(i) = u(i) + factor*column(i)
    end do
  end subroutine add_column

end module cone_dense
