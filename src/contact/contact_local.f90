! SPDX-License-Identifier: BSD-3-Clause
!> Condensation to the contacts without S^-1: the near part of W from the near part of the
!> flexibility, W = H F H', and products with all of W by solves with the factor of the bodies.
module contact_local
  use base_kinds, only: wp, zero, one
  use base_sort, only: sort_integers
  use base_status, only: status_t
  use cone_delassus, only: operator_t
  use cone_two_level, only: solve_two_level, solve_with_products
  use cone_types, only: certificate_t
  use contact_types, only: contact_t
  use linalg_near, only: near_t
  use linalg_solver, only: solve_whole
  implicit none
  private
  public :: start_local, clear_held, mark_rigid_near, size_near_w, fill_near_w, solve_local, &
      move_by, shift_far, near_product_of

  !> W of a contact problem as products: a solve each.
  type, extends(operator_t) :: product_t
    type(contact_t), pointer :: contact => null()
  contains
    procedure :: apply => apply_product
  end type product_t

contains

  !> Work space for the interface as it is; nodes: of the model.
  subroutine start_local(contact, nodes)
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: nodes
    integer :: m
    m = size(contact%interface_node)
    if (allocated(contact%w%matrix)) deallocate (contact%w%matrix)
    contact%w%contacts = -1
    associate (local => contact%local)
      if (allocated(local%b)) deallocate (local%b, local%x)
      if (.not. local%is_exact) then
        allocate (local%b(contact%dim, nodes), source=zero)
        allocate (local%x(contact%dim, nodes), source=zero)
      end if
      if (allocated(local%force)) deallocate (local%force, local%motion)
      allocate (local%force(contact%dim, m), local%motion(contact%dim, m), source=zero)
      if (allocated(local%far)) then
        if (size(local%far, 2) == m) return
        deallocate (local%far, local%far_older)
      end if
      allocate (local%far(contact%dim, m), local%far_older(contact%dim, m), source=zero)
    end associate
  end subroutine start_local

  !> Held dofs of the interface do not move: their rows and columns of the near part.
  pure subroutine clear_held(contact, near)
    type(contact_t), intent(in) :: contact
    type(near_t), intent(inout) :: near
    logical :: is_held(near%d*size(contact%interface_node))
    integer :: k, m, i, j
    is_held = .false.
    is_held(contact%constrained) = .true.
    do k = 1, size(near%first) - 1
      do m = near%first(k), near%first(k + 1) - 1
        do j = 1, near%d
          do i = 1, near%d
            if (is_held(near%d*(k - 1) + i) .or. is_held(near%d*(near%node(m) - 1) + j)) &
                near%block(i, j, m) = zero
          end do
        end do
      end do
    end do
  end subroutine clear_held

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

  !> u = W r (d, n): forces of the contacts, the motion of the bodies, its displacements.
  subroutine apply_product(this, r, u)
    class(product_t), intent(in) :: this
    real(wp), intent(in), contiguous :: r(:, :)
    real(wp), intent(out), contiguous :: u(:, :)
    real(wp) :: own
    integer :: i, j, k, e, p
    associate (contact => this%contact, local => this%contact%local)
      local%force = zero
      do j = 1, contact%n
        do i = 1, contact%d
          e = contact%d*(j - 1) + i
          do k = 1, contact%h_size(e)
            p = (contact%h_dof(k, e) - 1)/contact%dim + 1
            associate (f => local%force(contact%h_dof(k, e) - contact%dim*(p - 1), p))
              f = f + contact%h_weight(k, e)*r(i, j)
            end associate
          end do
        end do
      end do
      call move_bodies(contact)
      do j = 1, contact%n
        do i = 1, contact%d
          e = contact%d*(j - 1) + i
          own = zero
          do k = 1, contact%h_size(e)
            p = (contact%h_dof(k, e) - 1)/contact%dim + 1
            own = own + contact%h_weight(k, e)* &
                local%motion(contact%h_dof(k, e) - contact%dim*(p - 1), p)
          end do
          u(i, j) = own
        end do
      end do
    end associate
  end subroutine apply_product

  !> local%motion (dim, m) of the interface and, but where the near part is all, local%x
  !> (dim, nodes) of the bodies by local%force (dim, m).
  subroutine move_bodies(contact)
    type(contact_t), intent(inout) :: contact
    integer :: k, d
    d = contact%dim
    associate (local => contact%local, node => contact%interface_node)
      local%is_moved = .true.
      if (local%is_exact) then
        local%motion = zero
        call local%near%add_product(one, local%force, local%motion)
        return
      end if
      local%b(:, node) = local%force
      do k = 1, size(contact%constrained)
        associate (c => contact%constrained(k) - 1)
          local%b(1 + mod(c, d), node(c/d + 1)) = zero
        end associate
      end do
      call solve_whole(local%solver, local%b, local%x)
      do k = 1, size(node)
        local%motion(:, k) = local%x(:, node(k))
      end do
      local%solves = local%solves + 1
    end associate
  end subroutine move_bodies

  !> The motions of bodies and interface by a force (dim, m): those of the last product where it
  !> was by that force.
  subroutine move_by(contact, force)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in) :: force(:, :)
    if (.not. any(abs(contact%local%force - force) > zero)) return
    contact%local%force = force
    call move_bodies(contact)
  end subroutine move_by

  !> u = W r (d, n) of the condensed problem as it is.
  subroutine near_product_of(contact, r, u)
    type(contact_t), intent(inout), target :: contact
    real(wp), intent(in), contiguous :: r(:, :)
    real(wp), intent(out), contiguous :: u(:, :)
    type(product_t) :: product
    product%contact => contact
    call product%apply(r, u)
  end subroutine near_product_of

  !> Reactions for q and the start in r, as solve_cone.
  subroutine solve_local(contact, certificate, status)
    type(contact_t), intent(inout), target :: contact
    type(certificate_t), intent(out) :: certificate
    type(status_t), intent(inout) :: status
    type(product_t) :: product
    integer :: passes
    product%contact => contact
    associate (local => contact%local)
      local%is_moved = .false.
      passes = 0
      if (local%by_products) then
        call solve_with_products(contact%cone, local%w, product, contact%q, contact%mu, &
            contact%r, contact%work, certificate, status)
      else
        call spread_far(contact)
        call solve_two_level(contact%cone, local%w, product, contact%q, contact%mu, &
            local%left_out, contact%r, contact%work, passes, certificate, status)
      end if
      local%passes = local%passes + passes
      if (local%is_moved) then
        if (.not. local%by_products) call keep_far(contact)
        return
      end if
      local%force = zero     ! nothing pushes, and no product has been taken
      local%motion = zero
      if (.not. local%is_exact) local%x = zero
    end associate
  end subroutine solve_local

  !> What the near part leaves out, of contacts from that of nodes.
  pure subroutine spread_far(contact)
    type(contact_t), intent(inout) :: contact
    integer :: i, j, k, e, p
    associate (local => contact%local)
      do j = 1, contact%n
        do i = 1, contact%d
          e = contact%d*(j - 1) + i
          local%left_out(i, j) = zero
          do k = 1, contact%h_size(e)
            p = (contact%h_dof(k, e) - 1)/contact%dim + 1
            local%left_out(i, j) = local%left_out(i, j) + contact%h_weight(k, e)* &
                local%far(contact%h_dof(k, e) - contact%dim*(p - 1), p)
          end do
        end do
      end do
    end associate
  end subroutine spread_far

  !> The same of nodes after a solve: motion less that of the near part.
  pure subroutine keep_far(contact)
    type(contact_t), intent(inout) :: contact
    associate (local => contact%local)
      local%far = local%motion
      call local%near%add_product(-one, local%force, local%far)
    end associate
  end subroutine keep_far

  !> At the start of a step: the guess is that of the last solve, or of the one before it where
  !> forces alternate.
  pure subroutine shift_far(contact)
    type(contact_t), intent(inout) :: contact
    real(wp) :: last
    integer :: i, k
    if (.not. allocated(contact%local)) return
    associate (local => contact%local)
      do k = 1, size(local%far, 2)
        do i = 1, size(local%far, 1)
          last = local%far(i, k)
          if (contact%alternates) local%far(i, k) = local%far_older(i, k)
          local%far_older(i, k) = last
        end do
      end do
    end associate
  end subroutine shift_far

end module contact_local
