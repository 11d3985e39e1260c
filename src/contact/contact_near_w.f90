! SPDX-License-Identifier: BSD-3-Clause
!> The near part of W = H F H' from the near part of the flexibility F of the interface
!> (linalg_near): blocks of the contacts that have near points.
module contact_near_w
  use base_kinds, only: wp, zero, one
  use base_sort, only: sort_integers
  use contact_types, only: contact_t
  implicit none
  private
  public :: mark_rigid_near, size_near_w, fill_near_w

contains

  !> Rows whose normal flexibility n' F n is zero to round-off.
  subroutine mark_rigid_near(contact)
    type(contact_t), intent(inout) :: contact
    real(wp) :: scale, normal
    integer :: a, k, l, p, d
    d = contact%dim
    associate (near => contact%local%near, rows => contact%rows)
      scale = zero
      do k = 1, size(near%first) - 1
        p = near%position(k, k)
        do l = 1, d
          scale = max(scale, near%block(l, l, p))
        end do
      end do
      do a = 1, rows%n
        normal = zero
        do k = rows%first(a), rows%first(a + 1) - 1
          do l = rows%first(a), rows%first(a + 1) - 1
            p = near%position(rows%slot(k), rows%slot(l))
            if (p > 0) normal = normal + rows%weight(k)*rows%weight(l)*dot_product( &
                rows%normal(:, a), matmul(near%block(:, :, p), rows%normal(:, a)))
          end do
        end do
        rows%is_rigid(a) = normal <= epsilon(one)*scale
      end do
    end associate
  end subroutine mark_rigid_near

  !> The contacts that are near each other: those that have near points. Nothing is done where
  !> they are as they were.
  subroutine size_near_w(contact)
    type(contact_t), intent(inout) :: contact
    integer, allocatable :: list(:)
    integer :: a, n, pass
    associate (local => contact%local, w => contact%local%w)
      if (is_same_pattern(contact)) return
      call keep_pattern(contact)
      call list_contacts(contact)
      w%d = contact%d
      w%contacts = contact%n
      if (allocated(w%first)) deallocate (w%first, w%diagonal)
      allocate (w%first(contact%n + 1), w%diagonal(contact%n), list(contact%n))
      if (allocated(local%mark)) deallocate (local%mark)
      allocate (local%mark(max(contact%n, size(contact%interface_node))), source=0)
      do pass = 1, 2
        n = 1
        local%mark = 0
        do a = 1, contact%n
          w%first(a) = n
          call append_near(contact, a, list, n, pass == 2)
        end do
        w%first(contact%n + 1) = n
        if (pass == 2) exit
        if (allocated(w%column)) then
          if (size(w%column) >= n - 1 .and. size(w%block, 1) == contact%d) cycle
          deallocate (w%column, w%block)
        end if
        allocate (w%column(n + n/8), w%block(contact%d, contact%d, n + n/8))
        w%block = zero
      end do
      if (allocated(local%reach)) deallocate (local%reach, local%weight)
      allocate (local%reach(contact%d, contact%dim, size(contact%interface_node)))
      allocate (local%weight(contact%d, contact%dim, size(local%pattern, 1)/contact%dim, &
          contact%n))
    end associate
  end subroutine size_near_w

  !> Have the contacts the points that the pattern was made for?
  pure logical function is_same_pattern(contact) result(is_same)
    type(contact_t), intent(in) :: contact
    integer :: i, j
    associate (local => contact%local)
      is_same = allocated(local%pattern)
      if (is_same) is_same = local%w%contacts == contact%n .and. local%w%d == contact%d .and. &
          size(local%pattern, 1) == size(contact%h_dof, 1)
      if (.not. is_same) return
      do j = 1, contact%n
        i = contact%d*(j - 1) + 1
        is_same = local%pattern_size(j) == contact%h_size(i)
        if (is_same) is_same = all(local%pattern(:contact%h_size(i), j) == &
            contact%h_dof(:contact%h_size(i), i))
        if (.not. is_same) return
      end do
    end associate
  end function is_same_pattern

  pure subroutine keep_pattern(contact)
    type(contact_t), intent(inout) :: contact
    integer :: j
    associate (local => contact%local)
      if (allocated(local%pattern)) deallocate (local%pattern, local%pattern_size)
      allocate (local%pattern(size(contact%h_dof, 1), contact%n), &
          local%pattern_size(contact%n))
      do j = 1, contact%n
        local%pattern(:, j) = contact%h_dof(:, contact%d*(j - 1) + 1)
        local%pattern_size(j) = contact%h_size(contact%d*(j - 1) + 1)
      end do
    end associate
  end subroutine keep_pattern

  !> local%of_node: the contacts that have each interface node among their points.
  pure subroutine list_contacts(contact)
    type(contact_t), intent(inout) :: contact
    integer :: a, k, p, m, total
    m = size(contact%interface_node)
    associate (local => contact%local, dim => contact%dim)
      if (allocated(local%first_of)) deallocate (local%first_of, local%of_node)
      total = sum(local%pattern_size)/dim
      allocate (local%first_of(m + 2), local%of_node(total))
      local%first_of = 0
      do a = 1, contact%n
        do k = 1, local%pattern_size(a), dim
          p = (local%pattern(k, a) - 1)/dim + 1
          local%first_of(p + 2) = local%first_of(p + 2) + 1
        end do
      end do
      local%first_of(1:2) = 1
      do p = 3, m + 2
        local%first_of(p) = local%first_of(p) + local%first_of(p - 1)
      end do
      do a = 1, contact%n
        do k = 1, local%pattern_size(a), dim
          p = (local%pattern(k, a) - 1)/dim + 1
          local%of_node(local%first_of(p + 1)) = a
          local%first_of(p + 1) = local%first_of(p + 1) + 1
        end do
      end do
    end associate
  end subroutine list_contacts

  !> The contacts near contact a, its own first in w%diagonal; from place n on.
  subroutine append_near(contact, a, list, n, keeps)
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: a
    integer, intent(inout) :: list(:), n
    logical, intent(in) :: keeps
    integer :: k, p, q, b, found
    found = 0
    associate (local => contact%local, near => contact%local%near)
      do k = 1, local%pattern_size(a), contact%dim
        p = (local%pattern(k, a) - 1)/contact%dim + 1
        do q = near%first(p), near%first(p + 1) - 1
          do b = local%first_of(near%node(q)), local%first_of(near%node(q) + 1) - 1
            if (local%mark(local%of_node(b)) == a) cycle
            local%mark(local%of_node(b)) = a
            found = found + 1
            list(found) = local%of_node(b)
          end do
        end do
      end do
      if (keeps) then
        call sort_integers(list(:found))
        local%w%column(n:n + found - 1) = list(:found)
        do k = 1, found
          if (list(k) == a) local%w%diagonal(a) = n + k - 1
        end do
      end if
    end associate
    n = n + found
  end subroutine append_near

  !> The near part of W for the rows of H as they are: the upper triangle, and its mirror.
  subroutine fill_near_w(contact)
    type(contact_t), intent(inout) :: contact
    integer :: a, k, place
    associate (local => contact%local, w => contact%local%w)
      local%mark = 0
      local%next = w%first(:contact%n)
      call list_weights(contact)
      do a = 1, contact%n
        call reach_nodes(contact, a)
        do k = local%next(a), w%first(a + 1) - 1
          call fill_block(contact, a, w%column(k), w%block(:, :, k))
          if (w%column(k) == a) cycle
          ! Columns increase: the rows before have taken their places one by one.
          place = local%next(w%column(k))
          w%block(:, :, place) = transpose(w%block(:, :, k))
          local%next(w%column(k)) = place + 1
        end do
      end do
    end associate
  end subroutine fill_near_w

  !> local%reach (d, dim, node): motion of the near nodes by unit reactions of contact a.
  subroutine reach_nodes(contact, a)
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: a
    integer :: k, p, first, n
    associate (local => contact%local, near => contact%local%near)
      do k = 1, local%pattern_size(a)/contact%dim
        p = local%pattern(contact%dim*k, a)/contact%dim
        first = near%first(p)
        n = near%first(p + 1) - first
        if (contact%d == 2 .and. contact%dim == 2) then
          call reach_from_2(n, a, near%node(first), near%block(1, 1, first), &
              local%weight(1, 1, k, a), local%mark, local%reach)
        else
          call reach_from(contact%d, contact%dim, n, a, near%node(first), &
              near%block(1, 1, first), local%weight(1, 1, k, a), local%mark, local%reach)
        end if
      end do
    end associate
  end subroutine reach_nodes

  !> local%weight (d, dim, point, n) of the rows of H as they are; a row that has fewer points,
  !> as the tangential one before a guided wall, has zeros there.
  pure subroutine list_weights(contact)
    type(contact_t), intent(inout) :: contact
    integer :: a, i, k, s, e
    associate (local => contact%local)
      do a = 1, contact%n
        do k = 1, local%pattern_size(a)/contact%dim
          do i = 1, contact%d
            e = contact%d*(a - 1) + i
            do s = 1, contact%dim
              local%weight(i, s, k, a) = zero
              if (contact%h_size(e) >= contact%dim*k) &
                  local%weight(i, s, k, a) = contact%h_weight(contact%dim*(k - 1) + s, e)
            end do
          end do
        end do
      end do
    end associate
  end subroutine list_weights

  !> reach = reach + weight block for each of the n near nodes of a point; mark: whose it is.
  pure subroutine reach_from(d, dim, n, a, node, block, weight, mark, reach)
    integer, intent(in) :: d, dim, n, a
    integer, intent(in) :: node(*)
    real(wp), intent(in) :: block(dim, dim, *), weight(d, *)
    integer, intent(inout) :: mark(*)
    real(wp), intent(inout) :: reach(d, dim, *)
    real(wp) :: own(d)
    integer :: q, i, s, c
    do q = 1, n
      i = node(q)
      if (mark(i) /= a) then
        mark(i) = a
        reach(:, :, i) = zero
      end if
      do c = 1, dim
        own = reach(:, c, i)
        do s = 1, dim
          own = own + weight(:, s)*block(s, c, q)
        end do
        reach(:, c, i) = own
      end do
    end do
  end subroutine reach_from

  !> The same in the plane with friction.
  pure subroutine reach_from_2(n, a, node, block, weight, mark, reach)
    integer, intent(in) :: n, a
    integer, intent(in) :: node(*)
    real(wp), intent(in) :: block(2, 2, *), weight(2, *)
    integer, intent(inout) :: mark(*)
    real(wp), intent(inout) :: reach(2, 2, *)
    integer :: q, i, c
    do q = 1, n
      i = node(q)
      if (mark(i) /= a) then
        mark(i) = a
        reach(:, :, i) = zero
      end if
      do c = 1, 2
        reach(1, c, i) = reach(1, c, i) + weight(1, 1)*block(1, c, q) &
            + weight(1, 2)*block(2, c, q)
        reach(2, c, i) = reach(2, c, i) + weight(2, 1)*block(1, c, q) &
            + weight(2, 2)*block(2, c, q)
      end do
    end do
  end subroutine reach_from_2

  !> W_ab from what contact a reaches.
  pure subroutine fill_block(contact, a, b, block)
    type(contact_t), intent(in) :: contact
    integer, intent(in) :: a, b
    real(wp), intent(out), contiguous :: block(:, :)
    integer :: k, p
    block = zero
    associate (local => contact%local)
      do k = 1, local%pattern_size(b)/contact%dim
        p = local%pattern(contact%dim*k, b)/contact%dim
        if (local%mark(p) /= a) cycle
        if (contact%d == 2 .and. contact%dim == 2) then
          call add_point_2(local%weight(1, 1, k, b), local%reach(1, 1, p), block)
        else
          call add_point(contact%d, contact%dim, local%weight(1, 1, k, b), &
              local%reach(1, 1, p), block)
        end if
      end do
    end associate
  end subroutine fill_block

  !> block = block + reach weight'.
  pure subroutine add_point(d, dim, weight, reach, block)
    integer, intent(in) :: d, dim
    real(wp), intent(in) :: weight(d, *), reach(d, *)
    real(wp), intent(inout) :: block(d, d)
    integer :: j, s
    do j = 1, d
      do s = 1, dim
        block(:, j) = block(:, j) + reach(:, s)*weight(j, s)
      end do
    end do
  end subroutine add_point

  pure subroutine add_point_2(weight, reach, block)
    real(wp), intent(in) :: weight(2, *), reach(2, *)
    real(wp), intent(inout) :: block(2, 2)
    integer :: j
    do j = 1, 2
      block(1, j) = block(1, j) + reach(1, 1)*weight(j, 1) + reach(1, 2)*weight(j, 2)
      block(2, j) = block(2, j) + reach(2, 1)*weight(j, 1) + reach(2, 2)*weight(j, 2)
    end do
  end subroutine add_point_2

end module contact_near_w
