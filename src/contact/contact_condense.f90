! SPDX-License-Identifier: BSD-3-Clause
!> The contact block and its flexibility: u = W r + q with W = H S^-1 H', where S is the Schur
!> complement of the effective matrix on the block's nodes (they come last in the elimination).
module contact_condense
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t
  use contact_surface, only: edge_tangent
  use contact_track, only: update_candidate
  use contact_types, only: contact_t, candidate_t
  use contact_wall, only: update_wall_candidate
  implicit none
  private
  public :: block_outgrown, make_block, size_flexibility, track_candidates, build_w, &
      relative_motion, spread_force, subtract_contact_force

contains

  !> True when a candidate involves a node that is not in the block.
  pure logical function block_outgrown(contact)
    type(contact_t), intent(in) :: contact
    integer :: i
    block_outgrown = .false.
    do i = 1, contact%n
      associate (c => contact%candidate(i))
        if (.not. c%valid) cycle
        if (min(contact%block_row(c%node), contact%block_row(c%a), &
            contact%block_row(c%b)) == 0) block_outgrown = .true.
      end associate
    end do
  end function block_outgrown

  !> Makes the block from the listed candidates, with one more edge on either side of each, so
  !> that sliding does not outgrow it at once.
  subroutine make_block(contact)
    type(contact_t), intent(inout) :: contact
    logical, allocatable :: taken(:)
    integer :: i, k, s, next
    allocate (taken(size(contact%block_row)))
    taken = .false.
    do i = 1, contact%n
      associate (c => contact%candidate(i), &
          obstacle => contact%pair(contact%candidate(i)%pair)%obstacle)
        taken([c%node, c%a, c%b]) = .true.
        if (c%edge == 0) cycle
        do s = 1, 2
          next = obstacle%neighbour(s, c%edge)
          if (next == 0) cycle
          if (dot_product(obstacle%normal(:, next), obstacle%normal(:, c%edge)) < 0.5_wp) cycle
          taken(obstacle%end_node(:, next)) = .true.
        end do
      end associate
    end do
    contact%block = pack([(k, k=1, size(taken))], taken)
    contact%block_row = 0
    contact%block_row(contact%block) = [(k, k=1, size(contact%block))]
    contact%block_changes = contact%block_changes + 1
    call size_flexibility(contact)
  end subroutine make_block

  !> S^-1 for the block as it is, yet to be filled.
  subroutine size_flexibility(contact)
    type(contact_t), intent(inout) :: contact
    integer :: dofs
    dofs = 2*size(contact%block)
    if (allocated(contact%flexibility)) deallocate (contact%flexibility, contact%column)
    allocate (contact%flexibility(dofs, dofs), contact%column(dofs))
    contact%w_is_current = .false.
  end subroutine size_flexibility

  !> Brings every candidate to the place its node faces at the start of a step ending at time
  !> t1.
  subroutine track_candidates(contact, x, u, t1)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in) :: x(:, :), u(:, :), t1
    logical :: changed, was_valid
    integer :: i
    do i = 1, contact%n
      associate (c => contact%candidate(i))
        was_valid = c%valid
        if (contact%pair(c%pair)%is_wall) then
          call update_wall_candidate(contact%pair(c%pair), x, u, c)
          changed = .false.
        else
          call update_candidate(contact%pair(c%pair), x, u, c, changed)
        end if
        if (t1 < contact%pair(c%pair)%birth .or. t1 > contact%pair(c%pair)%death) &
            c%valid = .false.
        if (changed .or. (c%valid .neqv. was_valid)) contact%w_is_current = .false.
      end associate
    end do
  end subroutine track_candidates

  !> Rows of the valid candidates and W for them, when something has changed. Candidates whose
  !> both sides are held (W_nn = 0) have no row.
  subroutine build_w(contact)
    type(contact_t), intent(inout) :: contact
    integer :: i, k
    if (contact%w_is_current) return
    contact%w_builds = contact%w_builds + 1
    contact%w_is_current = .true.
    call mark_held(contact)
    call size_rows(contact, count(contact%candidate(:contact%n)%valid .and. &
        .not. contact%candidate(:contact%n)%held))
    k = 0
    do i = 1, contact%n
      associate (c => contact%candidate(i))
        if (.not. c%valid .or. c%held) cycle
        k = k + 1
        contact%row_of(k) = i
        contact%mu(k) = contact%pair(c%pair)%mu
      end associate
    end do
    call fill_w(contact)
  end subroutine build_w

  !> Candidates whose normal flexibility is zero to round-off.
  pure subroutine mark_held(contact)
    type(contact_t), intent(inout) :: contact
    real(wp) :: scale, normal, weight(6)
    integer :: i, j, k, dof(6)
    scale = zero
    do i = 1, size(contact%flexibility, 1)
      scale = max(scale, contact%flexibility(i, i))
    end do
    do i = 1, contact%n
      if (.not. contact%candidate(i)%valid) cycle
      call row_of_h(contact, contact%candidate(i), 1, dof, weight)
      normal = zero
      do k = 1, 6
        do j = 1, 6
          normal = normal + weight(j)*weight(k)*contact%flexibility(dof(j), dof(k))
        end do
      end do
      contact%candidate(i)%held = normal <= epsilon(one)*scale
    end do
  end subroutine mark_held

  subroutine size_rows(contact, n)
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: n
    integer :: rows
    if (contact%rows == n .and. allocated(contact%w)) return
    contact%rows = n
    if (allocated(contact%w)) deallocate (contact%w, contact%q, contact%mu, contact%r, &
        contact%row_of, contact%h_dof, contact%h_weight)
    rows = contact%d*n
    allocate (contact%w(rows, rows), contact%q(contact%d, n), contact%mu(n))
    allocate (contact%r(contact%d, n), contact%row_of(n))
    allocate (contact%h_dof(6, rows), contact%h_weight(6, rows))
  end subroutine size_rows

  !> W = H S^-1 H', a column of S^-1 H' at a time; both triangles.
  pure subroutine fill_w(contact)
    type(contact_t), intent(inout) :: contact
    integer :: i, j, k, a, d
    d = contact%d
    do j = 1, contact%rows
      do a = 1, d
        call row_of_h(contact, contact%candidate(contact%row_of(j)), a, &
            contact%h_dof(:, d*(j - 1) + a), contact%h_weight(:, d*(j - 1) + a))
      end do
    end do
    associate (dof => contact%h_dof, weight => contact%h_weight, column => contact%column)
      do j = 1, d*contact%rows
        column = zero
        do k = 1, 6
          if (abs(weight(k, j)) > zero) &
              column = column + weight(k, j)*contact%flexibility(:, dof(k, j))
        end do
        do i = 1, j
          contact%w(i, j) = weight(1, i)*column(dof(1, i)) + weight(2, i)*column(dof(2, i)) &
              + weight(3, i)*column(dof(3, i)) + weight(4, i)*column(dof(4, i)) &
              + weight(5, i)*column(dof(5, i)) + weight(6, i)*column(dof(6, i))
          contact%w(j, i) = contact%w(i, j)
        end do
      end do
    end associate
  end subroutine fill_w

  !> The row of H of one component (1 normal, 2 tangential) of a candidate: its dofs in the
  !> block, x and y of its three nodes, and their weights.
  pure subroutine row_of_h(contact, c, component, dof, weight)
    type(contact_t), intent(in) :: contact
    type(candidate_t), intent(in) :: c
    integer, intent(in) :: component
    integer, intent(out) :: dof(6)
    real(wp), intent(out) :: weight(6)
    real(wp) :: e(2)
    e = c%normal
    if (component == 2) e = edge_tangent(c%normal)
    weight(1:2) = e
    weight(3:4) = c%share*(c%xi - one)*e
    weight(5:6) = -c%share*c%xi*e
    dof(2::2) = 2*contact%block_row([c%node, c%a, c%b])
    dof(1::2) = dof(2::2) - 1
  end subroutine row_of_h

  !> (n, t) components of the motion of a candidate's node relative to its place, from the
  !> motions of its three nodes: its rows of H times the motion.
  pure function relative_motion(c, node, a, b) result(motion)
    type(candidate_t), intent(in) :: c
    real(wp), intent(in) :: node(2), a(2), b(2)
    real(wp) :: motion(2), d(2)
    d = (node - c%share*a) - c%share*c%xi*(b - a)
    motion(1) = c%normal(1)*d(1) + c%normal(2)*d(2)
    motion(2) = c%normal(1)*d(2) - c%normal(2)*d(1)
  end function relative_motion

  !> f = f + H' r of one candidate, f (2, m) on the block.
  pure subroutine spread_force(contact, c, r, f)
    type(contact_t), intent(in) :: contact
    type(candidate_t), intent(in) :: c
    real(wp), intent(in) :: r(2)
    real(wp), intent(inout) :: f(:, :)
    real(wp) :: force(2)
    force = c%normal*r(1) + edge_tangent(c%normal)*r(2)
    associate (s => contact%block_row(c%node), a => contact%block_row(c%a), &
        b => contact%block_row(c%b))
      f(:, s) = f(:, s) + force
      f(:, a) = f(:, a) - c%share*(one - c%xi)*force
      f(:, b) = f(:, b) - c%share*c%xi*force
    end associate
  end subroutine spread_force

  !> f = f - factor * H' r of all candidates, f (2, nodes).
  pure subroutine subtract_contact_force(contact, factor, f)
    type(contact_t), intent(in) :: contact
    real(wp), intent(in) :: factor
    real(wp), intent(inout) :: f(:, :)
    real(wp) :: force(2)
    integer :: i
    do i = 1, contact%n
      associate (c => contact%candidate(i))
        if (.not. c%r(1) > zero) cycle
        force = factor*(c%normal*c%r(1) + edge_tangent(c%normal)*c%r(2))
        f(:, c%node) = f(:, c%node) - force
        f(:, c%a) = f(:, c%a) + c%share*(one - c%xi)*force
        f(:, c%b) = f(:, c%b) + c%share*c%xi*force
      end associate
    end do
  end subroutine subtract_contact_force

end module contact_condense
