! SPDX-License-Identifier: BSD-3-Clause
!> W by blocks of d x d, row by row; blocks of zeros are left out.
module cone_blocks
  use base_kinds, only: wp, zero
  use cone_delassus, only: delassus_t, delassus_entries_t
  use cone_types, only: cone_options_t, most_components
  use cone_visit, only: visit_contact
  implicit none
  private
  public :: blocks_from_dense, blocks_from_rows, dense_of_blocks, find_components, &
      take_component

  type, extends(delassus_entries_t), public :: delassus_blocks_t
    integer, allocatable :: first(:)         !< (nc + 1) first block of a contact's row
    integer, allocatable :: column(:)        !< contact of a block
    integer, allocatable :: diagonal(:)      !< (nc) place of W_aa
    real(wp), allocatable :: block(:, :, :)  !< (d, d, blocks) [L/F]
  contains
    procedure :: diagonal_block
    procedure :: rescaled
    procedure :: add_product
    procedure :: visit
  end type delassus_blocks_t

contains

  !> From a dense W (d nc, d nc); blocks of zeros are left out, W_aa stays.
  pure subroutine blocks_from_dense(w, d, blocks)
    real(wp), intent(in) :: w(:, :)
    integer, intent(in) :: d
    type(delassus_blocks_t), intent(out) :: blocks
    integer :: a, b, n, pass, nc
    nc = size(w, 1)/d
    call start_blocks(d, nc, blocks)
    do pass = 1, 2
      n = 0
      do a = 1, nc
        blocks%first(a) = n + 1
        do b = 1, nc
          if (a /= b .and. .not. any(abs(w(d*a - d + 1:d*a, d*b - d + 1:d*b)) > zero)) cycle
          n = n + 1
          if (a == b) blocks%diagonal(a) = n
          if (pass == 1) cycle
          blocks%column(n) = b
          blocks%block(:, :, n) = w(d*a - d + 1:d*a, d*b - d + 1:d*b)
        end do
      end do
      blocks%first(nc + 1) = n + 1
      if (pass == 1) allocate (blocks%column(n), blocks%block(d, d, n))
    end do
  end subroutine blocks_from_dense

  !> From entries by rows: pointer (d nc + 1), columns and values. Entries of one place add up.
  pure subroutine blocks_from_rows(d, pointer, columns, values, blocks)
    integer, intent(in) :: d
    integer, intent(in) :: pointer(:), columns(:)
    real(wp), intent(in) :: values(:)
    type(delassus_blocks_t), intent(out) :: blocks
    integer, allocatable :: place(:)
    integer :: a, b, i, k, n, pass, nc
    nc = (size(pointer) - 1)/d
    call start_blocks(d, nc, blocks)
    allocate (place(nc))
    do pass = 1, 2
      n = 0
      place = 0
      do a = 1, nc
        blocks%first(a) = n + 1
        n = n + 1
        place(a) = n
        blocks%diagonal(a) = n
        if (pass == 2) blocks%column(n) = a
        do i = d*(a - 1) + 1, d*a
          do k = pointer(i), pointer(i + 1) - 1
            b = (columns(k) - 1)/d + 1
            if (place(b) < blocks%first(a)) then
              n = n + 1
              place(b) = n
            end if
            if (pass == 1) cycle
            blocks%column(place(b)) = b
            associate (entry => blocks%block(i - d*(a - 1), columns(k) - d*(b - 1), &
                place(b)))
              entry = entry + values(k)
            end associate
          end do
        end do
      end do
      blocks%first(nc + 1) = n + 1
      if (pass == 2) exit
      allocate (blocks%column(n), blocks%block(d, d, n))
      blocks%block = zero
    end do
  end subroutine blocks_from_rows

  pure subroutine start_blocks(d, nc, blocks)
    integer, intent(in) :: d, nc
    type(delassus_blocks_t), intent(inout) :: blocks
    blocks%d = d
    blocks%contacts = nc
    allocate (blocks%first(nc + 1), blocks%diagonal(nc))
  end subroutine start_blocks

  pure subroutine diagonal_block(this, a, block)
    class(delassus_blocks_t), intent(in) :: this
    integer, intent(in) :: a
    real(wp), intent(inout) :: block(most_components, most_components)
    block(:this%d, :this%d) = this%block(:, :, this%diagonal(a))
  end subroutine diagonal_block

  subroutine rescaled(this, power, other)
    class(delassus_blocks_t), intent(in) :: this
    integer, intent(in) :: power
    class(delassus_t), allocatable, intent(out) :: other
    type(delassus_blocks_t), allocatable :: w
    allocate (w)
    w%d = this%d
    w%contacts = this%contacts
    w%first = this%first
    w%column = this%column
    w%diagonal = this%diagonal
    w%block = scale(this%block, power)
    call move_alloc(w, other)
  end subroutine rescaled

  pure subroutine add_product(this, r, u)
    class(delassus_blocks_t), intent(in) :: this
    real(wp), intent(in), contiguous :: r(:, :)
    real(wp), intent(inout), contiguous :: u(:, :)
    real(wp) :: own(most_components)
    integer :: a, d
    d = this%d
    do a = 1, this%contacts
      own(:d) = u(:, a)
      call add_row(this, a, d, r, own)
      u(:, a) = own(:d)
    end do
  end subroutine add_product

  !> u = u + (W r)_a (d).
  pure subroutine add_row(this, a, d, r, u)
    class(delassus_blocks_t), intent(in) :: this
    integer, intent(in) :: a, d
    real(wp), intent(in), contiguous :: r(:, :)
    real(wp), intent(inout) :: u(most_components)
    integer :: k
    associate (first => this%first(a), last => this%first(a + 1) - 1)
      select case (d)
      case (3)
        call add_row_3(first, last, this%column, this%block, r, u)
      case (2)
        call add_row_2(first, last, this%column, this%block, r, u)
      case default
        do k = first, last
          u(1) = u(1) + this%block(1, 1, k)*r(1, this%column(k))
        end do
      end select
    end associate
  end subroutine add_row

  !> The same with fixed bounds, in the plane.
  pure subroutine add_row_2(first, last, column, block, r, u)
    integer, intent(in) :: first, last, column(*)
    real(wp), intent(in) :: block(2, 2, *), r(2, *)
    real(wp), intent(inout) :: u(2)
    integer :: k, j
    do k = first, last
      do j = 1, 2
        u = u + block(:, j, k)*r(j, column(k))
      end do
    end do
  end subroutine add_row_2

  !> The same in space.
  pure subroutine add_row_3(first, last, column, block, r, u)
    integer, intent(in) :: first, last, column(*)
    real(wp), intent(in) :: block(3, 3, *), r(3, *)
    real(wp), intent(inout) :: u(3)
    integer :: k, j
    do k = first, last
      do j = 1, 3
        u = u + block(:, j, k)*r(j, column(k))
      end do
    end do
  end subroutine add_row_3

  pure subroutine visit(this, options, a, mu, rho, enough, most, q, r, u, status, iterations)
    class(delassus_blocks_t), intent(in) :: this
    type(cone_options_t), intent(in) :: options
    integer, intent(in) :: a
    real(wp), intent(in) :: mu, rho, enough
    integer, intent(in) :: most
    real(wp), intent(in), contiguous :: q(:, :)
    real(wp), intent(inout), contiguous :: r(:, :), u(:, :)
    integer, intent(out) :: status, iterations
    real(wp) :: own(most_components)
    integer :: d
    d = this%d
    own(:d) = q(:, a)
    call add_row(this, a, d, r, own)
    call visit_contact(options, this%block(:, :, this%diagonal(a)), mu, rho, enough, most, &
        r(:, a), own(:d), status, iterations)
    u(:, a) = own(:d)
  end subroutine visit

  !> W as a dense matrix (d nc, d nc).
  pure subroutine dense_of_blocks(blocks, w)
    type(delassus_blocks_t), intent(in) :: blocks
    real(wp), intent(out) :: w(:, :)
    integer :: a, k, d, b
    d = blocks%d
    w = zero
    do a = 1, blocks%contacts
      do k = blocks%first(a), blocks%first(a + 1) - 1
        b = blocks%column(k)
        w(d*a - d + 1:d*a, d*b - d + 1:d*b) = blocks%block(:, :, k)
      end do
    end do
  end subroutine dense_of_blocks

  !> Uncoupled groups of contacts: the components of the graph of blocks. member lists them
  !> one by one, the k-th from first(k) to first(k + 1) - 1.
  pure subroutine find_components(blocks, first, member)
    type(delassus_blocks_t), intent(in) :: blocks
    integer, allocatable, intent(out) :: first(:), member(:)
    logical, allocatable :: seen(:)
    integer :: a, b, k, head, n, components, nc
    nc = blocks%contacts
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
        do k = blocks%first(b), blocks%first(b + 1) - 1
          if (seen(blocks%column(k))) cycle
          n = n + 1
          member(n) = blocks%column(k)
          seen(blocks%column(k)) = .true.
        end do
        head = head + 1
      end do
    end do
    first = [first(:components), nc + 1]
  end subroutine find_components

  !> The blocks among the contacts of one component. place (all contacts) is work space.
  pure subroutine take_component(blocks, member, place, part)
    type(delassus_blocks_t), intent(in) :: blocks
    integer, intent(in) :: member(:)
    integer, intent(inout) :: place(:)
    type(delassus_blocks_t), intent(out) :: part
    integer :: a, k, n
    call start_blocks(blocks%d, size(member), part)
    n = 0
    do a = 1, size(member)
      place(member(a)) = a
      n = n + blocks%first(member(a) + 1) - blocks%first(member(a))
    end do
    allocate (part%column(n), part%block(blocks%d, blocks%d, n))
    n = 0
    do a = 1, size(member)
      part%first(a) = n + 1
      do k = blocks%first(member(a)), blocks%first(member(a) + 1) - 1
        n = n + 1
        part%column(n) = place(blocks%column(k))
        part%block(:, :, n) = blocks%block(:, :, k)
        if (part%column(n) == a) part%diagonal(a) = n
      end do
    end do
    part%first(size(member) + 1) = n + 1
  end subroutine take_component

end module cone_blocks
