! SPDX-License-Identifier: BSD-3-Clause
!> W of which products are known and the blocks W_aa, nothing else.
module cone_products
  use base_kinds, only: wp
  use cone_delassus, only: delassus_t, operator_t
  use cone_types, only: most_components
  implicit none
  private
  public :: make_products

  type, extends(delassus_t), public :: delassus_products_t
    class(operator_t), pointer :: product => null()   !< its owner keeps it
    integer :: power = 0                              !< W = 2^power x product
    real(wp), allocatable :: diagonal(:, :, :)        !< (d, d, nc) W_aa [L/F]
  contains
    procedure :: apply
    procedure :: diagonal_block
    procedure :: rescaled
  end type delassus_products_t

contains

  !> From an operator, which must live as long as w is used, and its blocks diagonal (d, d, nc)
  !> [L/F].
  subroutine make_products(product, diagonal, w)
    class(operator_t), target, intent(in) :: product
    real(wp), intent(in) :: diagonal(:, :, :)
    type(delassus_products_t), intent(out) :: w
    w%d = size(diagonal, 1)
    w%contacts = size(diagonal, 3)
    w%product => product
    w%diagonal = diagonal
  end subroutine make_products

  !> u = W r (d, nc), [L] and [F].
  subroutine apply(this, r, u)
    class(delassus_products_t), intent(in) :: this
    real(wp), intent(in), contiguous :: r(:, :)
    real(wp), intent(out), contiguous :: u(:, :)
    call this%product%apply(r, u)
    if (this%power /= 0) u = scale(u, this%power)
  end subroutine apply

  subroutine rescaled(this, power, other)
    class(delassus_products_t), intent(in) :: this
    integer, intent(in) :: power
    class(delassus_t), allocatable, intent(out) :: other
    type(delassus_products_t), allocatable :: w
    allocate (w)
    w%d = this%d
    w%contacts = this%contacts
    w%product => this%product
    w%power = this%power + power
    w%diagonal = scale(this%diagonal, power)
    call move_alloc(w, other)
  end subroutine rescaled

  pure subroutine diagonal_block(this, a, block)
    class(delassus_products_t), intent(in) :: this
    integer, intent(in) :: a
    real(wp), intent(inout) :: block(most_components, most_components)
    block(:this%d, :this%d) = this%diagonal(:, :, a)
  end subroutine diagonal_block

end module cone_products
