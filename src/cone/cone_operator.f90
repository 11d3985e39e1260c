! SPDX-License-Identifier: BSD-3-Clause
!> W as an operator: all that is known of it is what it does to reactions. A program that owns
!> the bodies extends it, by a solve with their factor, say; blocks are one too (cone_blocks).
module cone_operator
  use base_kinds, only: wp
  implicit none
  private

  type, abstract, public :: operator_t
  contains
    procedure(apply_i), deferred :: apply
  end type operator_t

  abstract interface
    !> u = W r, both (d, nc), [L] and [F].
    subroutine apply_i(this, r, u)
      import :: operator_t, wp
      class(operator_t), intent(in) :: this
      real(wp), intent(in) :: r(:, :)
      real(wp), intent(out) :: u(:, :)
    end subroutine apply_i
  end interface

end module cone_operator
