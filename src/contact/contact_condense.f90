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
  public :: block_outgrown, make_block, track_candidates, build_w, relative_motion, &
      spread_force, subtract_contact_force

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
    if (allocated(contact%flexibility)) deallocate (contact%flexibility)
    allocate (contact%flexibility(2*size(contact%block), 2*size(contact%block)))
    contact%w_is_current = .false.
  end subroutine make_block

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
    real(wp) :: scale
    integer :: i, j, n, d
    if (contact%w_is_current) return
    contact%w_builds = contact%w_builds + 1
    contact%w_is_current = .true.
    scale = zero
    do i = 1, size(contact%flexibility, 1)
      scale = max(scale, contact%flexibility(i, i))
    end do
    n = 0
    do i = 1, contact%n
      if (.not. contact%candidate(i)%valid) cycle
      contact%candidate(i)%held = candidate_flexibility(contact, i, i, 1, &
          1) <= epsilon(one)*scale
      if (.not. contact%candidate(i)%held) n = n + 1
    end do
    call size_rows(contact, n)
    n = 0
    do i = 1, contact%n
      if (.not. contact%candidate(i)%valid .or. contact%candidate(i)%held) cycle
      n = n + 1
      contact%row_of(n) = i
      contact%mu(n) = contact%pair(contact%candidate(i)%pair)%mu
    end do
    d = contact%d
    do j = 1, n
      do i = 1, j
        call fill_w(contact, i, j, contact%w(d*(i - 1) + 1:d*i, d*(j - 1) + 1:d*j))
        if (i < j) contact%w(d*(j - 1) + 1:d*j, d*(i - 1) + 1:d*i) = &
            transpose(contact%w(d*(i - 1) + 1:d*i, d*(j - 1) + 1:d*j))
      end do
    end do
  end subroutine build_w

  subroutine size_rows(contact, n)
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: n
    if (contact%rows == n .and. allocated(contact%w)) return
    contact%rows = n
    if (allocated(contact%w)) &
        deallocate (contact%w, contact%q, contact%mu, contact%r, contact%row_of)
    allocate (contact%w(contact%d*n, contact%d*n), contact%q(contact%d, n), contact%mu(n))
    allocate (contact%r(contact%d, n), contact%row_of(n))
  end subroutine size_rows

  pure subroutine fill_w(contact, i, j, w)
    type(contact_t), intent(in) :: contact
    integer, intent(in) :: i, j
    real(wp), intent(out) :: w(:, :)
    integer :: a, b
    do b = 1, contact%d
      do a = 1, contact%d
        w(a, b) = candidate_flexibility(contact, contact%row_of(i), contact%row_of(j), a, b)
      end do
    end do
  end subroutine fill_w

  !> H_ia S^-1 H_jb': motion of component a of candidate i by a unit reaction b of candidate j.
  pure real(wp) function candidate_flexibility(contact, i, j, a, b)
    type(contact_t), intent(in) :: contact
    integer, intent(in) :: i, j, a, b
    integer :: row(3), column(3), k, m
    real(wp) :: weight_i(3), weight_j(3), e_i(2), e_j(2)
    call stencil(contact, contact%candidate(i), a, row, weight_i, e_i)
    call stencil(contact, contact%candidate(j), b, column, weight_j, e_j)
    candidate_flexibility = zero
    do m = 1, 3
      do k = 1, 3
        candidate_flexibility = candidate_flexibility &
            + weight_i(k)*weight_j(m)*dot_product(e_i, matmul(contact%flexibility(2*row(k) &
            - 1:2*row(k), 2*column(m) - 1:2*column(m)), e_j))
      end do
    end do
  end function candidate_flexibility

  !> One row of H: block rows of its three nodes, their weights, its direction.
  pure subroutine stencil(contact, c, component, row, weight, e)
    type(contact_t), intent(in) :: contact
    type(candidate_t), intent(in) :: c
    integer, intent(in) :: component
    integer, intent(out) :: row(3)
    real(wp), intent(out) :: weight(3), e(2)
    row = contact%block_row([c%node, c%a, c%b])
    weight = [one, c%share*(c%xi - one), -c%share*c%xi]
    e = c%normal
    if (component == 2) e = edge_tangent(c%normal)
  end subroutine stencil

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
