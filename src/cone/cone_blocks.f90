! SPDX-License-Identifier: BSD-3-Clause
!> The flexibility W of a contact problem, stored by blocks of d x d, row by row.
module cone_blocks
  use base_kinds, only: wp, zero
  use cone_operator, only: operator_t
  implicit none
  private
  public :: blocks_from_dense, blocks_from_rows, motions, add_motions, &
      mean_of_diagonal, dense_of_blocks, find_components, take_component

  type, extends(operator_t), public :: flexibility_t
    integer :: d = 0, contacts = 0
    integer, allocatable :: first(:)         !< (nc + 1) first block of a contact's row
    integer, allocatable :: column(:)        !< contact of a block
    integer, allocatable :: diagonal(:)      !< (nc) place of W_aa
    real(wp), allocatable :: block(:, :, :)  !< (d, d, blocks) [L/F]
  contains
    procedure :: apply
  end type flexibility_t

contains

  !> From a dense W (d nc, d nc); blocks of zeros are left out, W_aa stays.
  pure subroutine blocks_from_dense(w, d, flexibility)
    real(wp), intent(in) :: w(:, :)
    integer, intent(in) :: d
    type(flexibility_t), intent(out) :: flexibility
    integer :: a, b, n, pass, nc
    nc = size(w, 1)/d
    call start_blocks(d, nc, flexibility)
    do pass = 1, 2
      n = 0
      do a = 1, nc
        flexibility%first(a) = n + 1
        do b = 1, nc
          if (a /= b .and. .not. any(abs(w(d*a - d + 1:d*a, d*b - d + 1:d*b)) > zero)) cycle
          n = n + 1
          if (a == b) flexibility%diagonal(a) = n
          if (pass == 1) cycle
          flexibility%column(n) = b
          flexibility%block(:, :, n) = w(d*a - d + 1:d*a, d*b - d + 1:d*b)
        end do
      end do
      flexibility%first(nc + 1) = n + 1
      if (pass == 1) allocate (flexibility%column(n), flexibility%block(d, d, n))
    end do
  end subroutine blocks_from_dense

  !> From entries by rows: pointer (d nc + 1), columns and values. Entries of one place add up.
  pure subroutine blocks_from_rows(d, pointer, columns, values, flexibility)
    integer, intent(in) :: d
    integer, intent(in) :: pointer(:), columns(:)
    real(wp), intent(in) :: values(:)
    type(flexibility_t), intent(out) :: flexibility
    integer, allocatable :: place(:)
    integer :: a, b, i, k, n, pass, nc
    nc = (size(pointer) - 1)/d
    call start_blocks(d, nc, flexibility)
    allocate (place(nc))
    do pass = 1, 2
      n = 0
      place = 0
      do a = 1, nc
        flexibility%first(a) = n + 1
        n = n + 1
        place(a) = n
        flexibility%diagonal(a) = n
        if (pass == 2) flexibility%column(n) = a
        do i = d*(a - 1) + 1, d*a
          do k = pointer(i), pointer(i + 1) - 1
            b = (columns(k) - 1)/d + 1
            if (place(b) < flexibility%first(a)) then
              n = n + 1
              place(b) = n
            end if
            if (pass == 1) cycle
            flexibility%column(place(b)) = b
            associate (entry => flexibility%block(i - d*(a - 1), columns(k) - d*(b - 1), &
                place(b)))
              entry = entry + values(k)
            end associate
          end do
        end do
      end do
      flexibility%first(nc + 1) = n + 1
      if (pass == 2) exit
      allocate (flexibility%column(n), flexibility%block(d, d, n))
      flexibility%block = zero
    end do
  end subroutine blocks_from_rows

  pure subroutine start_blocks(d, nc, flexibility)
    integer, intent(in) :: d, nc
    type(flexibility_t), intent(inout) :: flexibility
    flexibility%d = d
    flexibility%contacts = nc
    allocate (flexibility%first(nc + 1), flexibility%diagonal(nc))
  end subroutine start_blocks

  !> u = W r (d, nc).
  subroutine apply(this, r, u)
    class(flexibility_t), intent(in) :: this
    real(wp), intent(in) :: r(:, :)
    real(wp), intent(out) :: u(:, :)
    u = zero
    call add_motions(this, r, u)
  end subroutine apply

  !> u = W r + q (d, nc).
  pure subroutine motions(flexibility, q, r, u)
    type(flexibility_t), intent(in) :: flexibility
    real(wp), intent(in) :: q(:, :), r(:, :)
    real(wp), intent(out) :: u(:, :)
    u = q
    call add_motions(flexibility, r, u)
  end subroutine motions

  !> u = u + W r (d, nc).
  pure subroutine add_motions(flexibility, r, u)
    class(flexibility_t), intent(in) :: flexibility
    real(wp), intent(in) :: r(:, :)
    real(wp), intent(inout) :: u(:, :)
    integer :: a, k, j
    do a = 1, flexibility%contacts
      do k = flexibility%first(a), flexibility%first(a + 1) - 1
        do j = 1, flexibility%d
          u(:, a) = u(:, a) + flexibility%block(:, j, k)*r(j, flexibility%column(k))
        end do
      end do
    end do
  end subroutine add_motions

  !> Mean of the diagonal of W [L/F].
  pure real(wp) function mean_of_diagonal(flexibility)
    type(flexibility_t), intent(in) :: flexibility
    integer :: a, j
    mean_of_diagonal = zero
    do a = 1, flexibility%contacts
      do j = 1, flexibility%d
        mean_of_diagonal = mean_of_diagonal + flexibility%block(j, j, flexibility%diagonal(a))
      end do
    end do
    mean_of_diagonal = mean_of_diagonal/max(1, flexibility%d*flexibility%contacts)
  end function mean_of_diagonal

  !> W as a dense matrix (d nc, d nc).
  pure subroutine dense_of_blocks(flexibility, w)
    type(flexibility_t), intent(in) :: flexibility
    real(wp), intent(out) :: w(:, :)
    integer :: a, k, d, b
    d = flexibility%d
    w = zero
    do a = 1, flexibility%contacts
      do k = flexibility%first(a), flexibility%first(a + 1) - 1
        b = flexibility%column(k)
        w(d*a - d + 1:d*a, d*b - d + 1:d*b) = flexibility%block(:, :, k)
      end do
    end do
  end subroutine dense_of_blocks

  !> Contacts that no chain of blocks connects do not know each other. member lists them
  !> component by component, the k-th from first(k) to first(k + 1) - 1.
  pure subroutine find_components(flexibility, first, member)
    type(flexibility_t), intent(in) :: flexibility
    integer, allocatable, intent(out) :: first(:), member(:)
    logical, allocatable :: seen(:)
    integer :: a, b, k, head, n, components, nc
    nc = flexibility%contacts
    allocate (first(nc + 1), member(nc), seen(nc))
    seen = .false.
    n = 0
    components = 0
    do a = 1, nc
      if (seen(a)) cycle
      components = components + 1
      first(components) = n + 1
      n = n + 1
      member(n) = a
      seen(a) = .true.
      head = n
      do while (head <= n)
        b = member(head)
        do k = flexibility%first(b), flexibility%first(b + 1) - 1
          if (seen(flexibility%column(k))) cycle
          n = n + 1
          member(n) = flexibility%column(k)
          seen(flexibility%column(k)) = .true.
        end do
        head = head + 1
      end do
    end do
    first = [first(:components), nc + 1]
  end subroutine find_components

  !> The blocks among the contacts of one component. place (all contacts) is work space.
  pure subroutine take_component(flexibility, member, place, part)
    type(flexibility_t), intent(in) :: flexibility
    integer, intent(in) :: member(:)
    integer, intent(inout) :: place(:)
    type(flexibility_t), intent(out) :: part
    integer :: a, k, n
    call start_blocks(flexibility%d, size(member), part)
    n = 0
    do a = 1, size(member)
      place(member(a)) = a
      n = n + flexibility%first(member(a) + 1) - flexibility%first(member(a))
    end do
    allocate (part%column(n), part%block(flexibility%d, flexibility%d, n))
    n = 0
    do a = 1, size(member)
      part%first(a) = n + 1
      do k = flexibility%first(member(a)), flexibility%first(member(a) + 1) - 1
        n = n + 1
        part%column(n) = place(flexibility%column(k))
        part%block(:, :, n) = flexibility%block(:, :, k)
        if (part%column(n) == a) part%diagonal(a) = n
      end do
    end do
    part%first(size(member) + 1) = n + 1
  end subroutine take_component

end module cone_blocks
