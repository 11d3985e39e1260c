! SPDX-License-Identifier: BSD-3-Clause
!> The Delassus operator W of a contact problem u = W r + q, whatever is known of it: a matrix
!> (cone_dense), blocks (cone_blocks), or products alone (cone_products).
module cone_delassus
  use base_kinds, only: wp, zero
  use cone_types, only: cone_options_t, most_components
  implicit none
  private

  !> What a program that owns the bodies gives, by a solve with their factor, say.
  type, abstract, public :: operator_t
  contains
    procedure(apply_i), deferred :: apply
  end type operator_t

  !> An operator of which the blocks W_aa are known.
  type, abstract, extends(operator_t), public :: delassus_t
    integer :: d = 0, contacts = 0          !< components of a contact; contacts
  contains
    procedure(diagonal_block_i), deferred :: diagonal_block
    procedure(rescaled_i), deferred :: rescaled
    procedure, non_overridable :: mean_diagonal
  end type delassus_t

  !> An operator of which all entries are known: Gauss-Seidel can visit its contacts.
  type, abstract, extends(delassus_t), public :: delassus_entries_t
  contains
    procedure(add_product_i), deferred :: add_product
    procedure(visit_i), deferred :: visit
    procedure :: apply => apply_entries
    procedure, non_overridable :: displacements
  end type delassus_entries_t

  abstract interface
    !> u = W r, both (d, nc), [L] and [F].
    subroutine apply_i(this, r, u)
      import :: operator_t, wp
      class(operator_t), intent(in) :: this
      real(wp), intent(in), contiguous :: r(:, :)
      real(wp), intent(out), contiguous :: u(:, :)
    end subroutine apply_i

    !> block(:d, :d) = W_aa of contact a [L/F].
    pure subroutine diagonal_block_i(this, a, block)
      import :: delassus_t, wp, most_components
      class(delassus_t), intent(in) :: this
      integer, intent(in) :: a
      real(wp), intent(inout) :: block(most_components, most_components)
    end subroutine diagonal_block_i

    !> other = 2^power W.
    subroutine rescaled_i(this, power, other)
      import :: delassus_t
      class(delassus_t), intent(in) :: this
      integer, intent(in) :: power
      class(delassus_t), allocatable, intent(out) :: other
    end subroutine rescaled_i

    !> u = u + W r, both (d, nc), [L] and [F].
    pure subroutine add_product_i(this, r, u)
      import :: delassus_entries_t, wp
      class(delassus_entries_t), intent(in) :: this
      real(wp), intent(in), contiguous :: r(:, :)
      real(wp), intent(inout), contiguous :: u(:, :)
    end subroutine add_product_i

    !> The local solver on contact a (visit_contact): r(:, a) and u(:, a) afterwards. A kind
    !> that goes by rows sums u(:, a) = (W r + q)_a first; one that goes by columns expects
    !> u = W r + q and keeps it so. r, u, q (d, nc).
    pure subroutine visit_i(this, options, a, mu, rho, enough, most, q, r, u, status, &
        iterations)
      import :: delassus_entries_t, cone_options_t, wp
      class(delassus_entries_t), intent(in) :: this
      type(cone_options_t), intent(in) :: options
      integer, intent(in) :: a
      real(wp), intent(in) :: mu, rho, enough
      integer, intent(in) :: most
      real(wp), intent(in), contiguous :: q(:, :)
      real(wp), intent(inout), contiguous :: r(:, :), u(:, :)
      integer, intent(out) :: status, iterations
    end subroutine visit_i
  end interface

contains

  !> Mean of the diagonal of W [L/F]: the scale between forces and displacements.
  pure real(wp) function mean_diagonal(this)
    class(delassus_t), intent(in) :: this
    real(wp) :: block(most_components, most_components)
    integer :: a, j
    mean_diagonal = zero
    do a = 1, this%contacts
      call this%diagonal_block(a, block)
      do j = 1, this%d
        mean_diagonal = mean_diagonal + block(j, j)
      end do
    end do
    mean_diagonal = mean_diagonal/max(1, this%d*this%contacts)
  end function mean_diagonal

  !> u = W r (d, nc).
  subroutine apply_entries(this, r, u)
    class(delassus_entries_t), intent(in) :: this
    real(wp), intent(in), contiguous :: r(:, :)
    real(wp), intent(out), contiguous :: u(:, :)
    u = zero
    call this%add_product(r, u)
  end subroutine apply_entries

  !> u = W r + q (d, nc).
  pure subroutine displacements(this, q, r, u)
    class(delassus_entries_t), intent(in) :: this
    real(wp), intent(in) :: q(:, :)
    real(wp), intent(in), contiguous :: r(:, :)
    real(wp), intent(out), contiguous :: u(:, :)
    u = q
    call this%add_product(r, u)
  end subroutine displacements

end module cone_delassus
