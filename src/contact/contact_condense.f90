! SPDX-License-Identifier: BSD-3-Clause
!> Condensation to the contacts: u = W r + q with W = H S^-1 H', where S is the Schur
!> complement of the effective matrix on the interface nodes (they come last in the
!> elimination).
module contact_condense
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use base_checks, only: checks_on, assert
  use base_kinds, only: wp, zero, one
  use contact_kinematics, only: row_of_h
  use contact_local, only: clear_held
  use contact_near_w, only: mark_rigid_near, size_near_w, fill_near_w
  use contact_rows, only: rows_t
  use contact_types, only: contact_t
  use linalg_bodies, only: body_blocks_t
  implicit none
  private
  public :: interface_outgrown, make_interface, size_interface_vectors, constrain_interface, &
      clear_constrained, build_w, mean_flexibility

contains

  !> True when a row involves a node that is not among the interface nodes.
  pure logical function interface_outgrown(contact)
    type(contact_t), intent(in) :: contact
    integer :: k
    interface_outgrown = .false.
    do k = 1, contact%rows%first(contact%rows%n + 1) - 1
      if (contact%slot(contact%rows%point(k)) == 0) interface_outgrown = .true.
    end do
  end function interface_outgrown

  !> Makes the nodes marked in taken (nodes) the interface nodes, body by body.
  subroutine make_interface(contact, taken)
    type(contact_t), intent(inout) :: contact
    logical, intent(in) :: taken(:)
    integer :: k, body, n
    contact%interface_node = pack([(k, k=1, size(taken))], taken)
    if (allocated(contact%body)) then
      associate (node => contact%interface_node)
        n = 0
        do body = 1, maxval([0, contact%body])
          if (n == size(node)) exit
          call take_body(contact%body, body, taken, node, n)
        end do
      end associate
    end if
    contact%slot = 0
    contact%slot(contact%interface_node) = [(k, k=1, size(contact%interface_node))]
    contact%tally%interface_changes = contact%tally%interface_changes + 1
    call size_interface_vectors(contact)
  end subroutine make_interface

  !> The nodes of a body that are taken, appended to node; n: how many there are.
  pure subroutine take_body(of, body, taken, node, n)
    integer, intent(in) :: of(:), body
    logical, intent(in) :: taken(:)
    integer, intent(inout) :: node(:), n
    integer :: i
    do i = 1, size(of)
      if (of(i) /= body .or. .not. taken(i)) cycle
      n = n + 1
      node(n) = i
    end do
  end subroutine take_body

  !> Work space for the interface as it is.
  subroutine size_interface_vectors(contact)
    type(contact_t), intent(inout) :: contact
    integer :: m
    m = size(contact%interface_node)
    if (allocated(contact%column)) deallocate (contact%column, contact%x_end)
    allocate (contact%column(contact%dim*m), contact%x_end(contact%dim, m))
  end subroutine size_interface_vectors

  !> To be called with a new S^-1: dofs of the list, (2, *) component and node, do not move,
  !> whatever the force. W must be built from it.
  subroutine constrain_interface(contact, list)
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: list(:, :)
    integer :: k
    contact%constrained = pack(contact%dim*(contact%slot(list(2, :)) - 1) + list(1, :), &
        contact%slot(list(2, :)) > 0)
    if (allocated(contact%local)) then
      call clear_held(contact, contact%local%near)
    else
      do k = 1, size(contact%constrained)
        call contact%schur_inverse%clear_row(contact%constrained(k))
      end do
    end if
    contact%w_is_current = .false.
  end subroutine constrain_interface

  !> No force (dim, m) on constrained dofs.
  pure subroutine clear_constrained(contact, force)
    type(contact_t), intent(in) :: contact
    real(wp), intent(inout) :: force(:, :)
    integer :: k, d
    d = contact%dim
    do k = 1, size(contact%constrained)
      force(1 + mod(contact%constrained(k) - 1, d), (contact%constrained(k) - 1)/d + 1) = zero
    end do
  end subroutine clear_constrained

  !> W for the rows, when something has changed. Rows whose both sides are constrained (W_nn =
  !> 0) are left out.
  subroutine build_w(contact)
    type(contact_t), intent(inout) :: contact
    integer :: a, k
    if (contact%w_is_current) return
    if (checks_on) call check_points(contact)
    contact%tally%w_builds = contact%tally%w_builds + 1
    contact%w_is_current = .true.
    associate (rows => contact%rows)
      if (allocated(contact%local)) then
        call mark_rigid_near(contact)
      else
        call mark_rigid(contact%schur_inverse, rows)
      end if
      call size_problem(contact, count(rows%is_active(:rows%n) .and. &
          .not. rows%is_rigid(:rows%n)))
      k = 0
      do a = 1, rows%n
        if (rows%is_rigid(a) .or. .not. rows%is_active(a)) cycle
        k = k + 1
        contact%row_of(k) = a
        contact%mu(k) = merge(zero, rows%mu(a), contact%rule%is_frictionless)
      end do
    end associate
    call list_h(contact)
    if (allocated(contact%local)) then
      call size_near_w(contact)
      call fill_near_w(contact)
    else
      call fill_w(contact)
    end if
  end subroutine build_w

  !> Mean diagonal of W [L/F].
  pure real(wp) function mean_flexibility(contact)
    type(contact_t), intent(in) :: contact
    if (allocated(contact%local)) then
      mean_flexibility = contact%local%w%mean_diagonal()
    else
      mean_flexibility = contact%w%mean_diagonal()
    end if
  end function mean_flexibility

  !> Assertions on what W is made of: S^-1 of the interface as it is, rows on it alone.
  subroutine check_points(contact)
    type(contact_t), intent(in) :: contact
    character(*), parameter :: place = 'build_w'
    integer :: points, m
    m = contact%dim*size(contact%interface_node)
    associate (rows => contact%rows)
      points = rows%first(rows%n + 1) - 1
      if (.not. allocated(contact%local)) call assert(contact%schur_inverse%rows() == m, &
          place, 'S^-1 is that of the interface')
      call assert(all(rows%slot(:points) >= 1 .and. contact%dim*rows%slot(:points) <= m), &
          place, 'every point of a row is an interface node')
      call assert(all(ieee_is_finite(rows%weight(:points))) .and. &
          all(ieee_is_finite(rows%normal(:, :rows%n))), place, &
          'weights and normals are finite')
    end associate
  end subroutine check_points

  !> Rows whose normal flexibility n' S^-1 n is zero to round-off.
  pure subroutine mark_rigid(schur_inverse, rows)
    type(body_blocks_t), intent(in) :: schur_inverse
    type(rows_t), intent(inout) :: rows
    real(wp) :: scale, normal, weight(rows%dim*rows%most_points)
    integer :: a, i, k, n, dof(rows%dim*rows%most_points)
    scale = zero
    do k = 1, size(schur_inverse%block)
      associate (a => schur_inverse%block(k)%a)
        do i = 1, size(a, 1)
          scale = max(scale, a(i, i))
        end do
      end associate
    end do
    do a = 1, rows%n
      call row_of_h(rows, a, 1, dof, weight, n)
      if (size(schur_inverse%block) == 1) then
        normal = form(schur_inverse%block(1)%a, 0, n, dof, weight)
      else
        normal = form_of_bodies(schur_inverse, n, dof, weight)
      end if
      rows%is_rigid(a) = normal <= epsilon(one)*scale
    end do
  end subroutine mark_rigid

  !> weight' f weight of n dofs, those of f from start + 1 on; others have no part in it.
  pure real(wp) function form(f, start, n, dof, weight)
    real(wp), intent(in) :: f(:, :), weight(:)
    integer, intent(in) :: start, n, dof(:)
    integer :: j, k
    form = zero
    do k = 1, n
      do j = 1, n
        form = form + weight(j)*weight(k)*f(dof(j) - start, dof(k) - start)
      end do
    end do
  end function form

  !> The same for dofs of several bodies: what is of one body at a time.
  pure real(wp) function form_of_bodies(f, n, dof, weight) result(sum_of_forms)
    type(body_blocks_t), intent(in) :: f
    integer, intent(in) :: n, dof(:)
    real(wp), intent(in) :: weight(:)
    real(wp) :: own_weight(n)
    integer :: j, k, own, body, own_dof(n)
    sum_of_forms = zero
    do k = 1, n
      body = f%body(dof(k))
      own = 0
      do j = 1, n
        if (f%body(dof(j)) /= body) cycle
        if (j < k) exit      ! it has been taken
        own = own + 1
        own_dof(own) = dof(j)
        own_weight(own) = weight(j)
      end do
      if (own > 0) sum_of_forms = sum_of_forms + form(f%block(body)%a, f%first(body) - 1, own, own_dof, &
          own_weight)
    end do
  end function form_of_bodies

  !> Storage of W, q, mu, r for n rows.
  subroutine size_problem(contact, n)
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: n
    integer :: rows, dofs
    logical :: is_local
    dofs = contact%dim*contact%rows%most_points
    if (contact%n == n .and. allocated(contact%q)) then
      is_local = allocated(contact%local)
      if (is_local) is_local = allocated(contact%local%left_out)
      if (size(contact%h_dof, 1) >= dofs .and. (is_local .neqv. contact%w%contacts == n)) return
    end if
    contact%n = n
    if (allocated(contact%local)) then
      if (allocated(contact%local%left_out)) deallocate (contact%local%left_out)
      if (allocated(contact%local%next)) deallocate (contact%local%next)
      allocate (contact%local%left_out(contact%d, n), contact%local%next(n))
    else
      call contact%w%resize(contact%d, n)
    end if
    if (allocated(contact%q)) deallocate (contact%q, contact%mu, contact%r, contact%row_of, &
        contact%h_dof, contact%h_weight, contact%h_size)
    rows = contact%d*n
    allocate (contact%q(contact%d, n), contact%mu(n))
    if (contact%friction_varies) then
      if (allocated(contact%mu_law)) deallocate (contact%mu_law, &
          contact%mu_bound, contact%mu_memory)
      allocate (contact%mu_law(n), contact%mu_bound(2, n), contact%mu_memory)
    end if
    allocate (contact%r(contact%d, n), contact%row_of(n))
    allocate (contact%h_dof(dofs, rows), contact%h_weight(dofs, rows))
    allocate (contact%h_size(rows))
  end subroutine size_problem

  !> Rows of H by their dofs and weights.
  pure subroutine list_h(contact)
    type(contact_t), intent(inout) :: contact
    integer :: i, j, k, d
    d = contact%d
    do j = 1, contact%n
      do k = 1, d
        i = d*(j - 1) + k
        call row_of_h(contact%rows, contact%row_of(j), k, contact%h_dof(:, i), &
            contact%h_weight(:, i), contact%h_size(i))
      end do
    end do
  end subroutine list_h

  !> W = H S^-1 H', a column of S^-1 H' at a time; both triangles.
  pure subroutine fill_w(contact)
    type(contact_t), intent(inout) :: contact
    integer :: j, k, n
    n = contact%d*contact%n
    associate (f => contact%schur_inverse, column => contact%column)
      if (size(f%block) == 1) then
        call fill_one_body(n, f%block(1)%a, contact%h_dof, contact%h_weight, contact%h_size, &
            column, contact%w%matrix)
        return
      end if
      do j = 1, n
        column = zero
        do k = 1, contact%h_size(j)
          call f%add_column(contact%h_dof(k, j), contact%h_weight(k, j), column)
        end do
        call fill_column(j, contact%h_dof, contact%h_weight, contact%h_size, column, &
            contact%w%matrix)
      end do
    end associate
  end subroutine fill_w

  pure subroutine fill_one_body(n, f, dof, weight, length, column, w)
    integer, intent(in) :: n, dof(:, :), length(:)
    real(wp), intent(in) :: f(:, :), weight(:, :)
    real(wp), intent(inout) :: column(:), w(:, :)
    integer :: j, k
    do j = 1, n
      column = zero
      do k = 1, length(j)
        column = column + weight(k, j)*f(:, dof(k, j))
      end do
      call fill_column(j, dof, weight, length, column, w)
    end do
  end subroutine fill_one_body

  !> Column j of W down to its diagonal, and the row that it is too.
  pure subroutine fill_column(j, dof, weight, length, column, w)
    integer, intent(in) :: j, dof(:, :), length(:)
    real(wp), intent(in) :: weight(:, :), column(:)
    real(wp), intent(inout) :: w(:, :)
    real(wp) :: entry
    integer :: i, k
    do i = 1, j
      entry = zero
      do k = 1, length(i)
        entry = entry + weight(k, i)*column(dof(k, i))
      end do
      w(i, j) = entry
      w(j, i) = entry
    end do
  end subroutine fill_column

end module contact_condense
