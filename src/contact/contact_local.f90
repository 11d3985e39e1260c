! SPDX-License-Identifier: BSD-3-Clause
!> Condensation to the contacts without S^-1: products with all of W = H A^-1 H' by solves with
!> the factor of the bodies, and the reactions by its near part (contact_near_w) and these.
module contact_local
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t
  use cone_delassus, only: operator_t
  use cone_two_level, only: solve_two_level, solve_with_products
  use cone_types, only: certificate_t
  use contact_types, only: contact_t
  use linalg_near, only: near_t
  use linalg_solver, only: solve_whole
  implicit none
  private
  public :: start_local, clear_held, solve_local, move_by, shift_far, near_product_of

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
