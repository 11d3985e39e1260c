! SPDX-License-Identifier: BSD-3-Clause
!> The rows of a step, of all pairings: those at its start, and those that its solved end
!> shows to be missing.
module contact_assemble
  use base_kinds, only: wp, zero, one
  use cone_types, only: most_components
  use contact_features, only: smooth_angle
  use contact_kinematics, only: relative_displacement
  use contact_local, only: move_by
  use contact_pairing, only: late_t
  use contact_ramp, only: ramp_floor
  use contact_rows, only: rows_t, start_rows, add_row, copy_row, swap_rows, same_geometry, &
      carry_reactions, take_reactions, comes_before, find_slots
  use contact_types, only: contact_t
  use linalg_bodies, only: body_blocks_t
  use model_data, only: model_t
  implicit none
  private
  public :: find_rows, add_missing_rows, take_spare, count_rows

contains

  !> Rows at displacement u (dim, nodes) for the free motion x_free (dim, m) of the interface. W
  !> stays where their geometry is that of the last step. Rows with an allowance that pushed
  !> in the last step are among them from the start.
  subroutine find_rows(model, contact, u, x_free)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: u(:, :), x_free(:, :)
    integer :: p, k
    logical :: is_same, pairing_is_same
    do k = 1, size(contact%interface_node)
      contact%free(:, contact%interface_node(k)) = x_free(:, k)
    end do
    contact%late_rounds = 0
    if (contact%keeps_rows) return
    is_same = contact%rows_are_plain
    do p = 1, size(contact%pairing)
      if (.not. (contact%acts(p) .and. contact%pairing(p)%item%listed > 0)) cycle
      if (allocated(contact%half_motion) .and. .not. contact%pairing(p)%item%is_wall) then
        call contact%pairing(p)%item%find_places(model, u + contact%half_motion, &
            contact%free - contact%half_motion, pairing_is_same)
      else
        call contact%pairing(p)%item%find_places(model, u, contact%free, pairing_is_same)
      end if
      is_same = is_same .and. pairing_is_same
    end do
    if (is_same) call renew_gaps(contact, is_same)
    if (.not. is_same) call make_rows(contact)
    if (.not. allocated(contact%half_motion)) return
    call take_gaps_back(contact, model%x, u, contact%rows)
    call take_gaps_back(contact, model%x, u, contact%spare)
  end subroutine find_rows

  !> Gaps of rows whose frames are those of the middle of the step: at its start, in that frame.
  pure subroutine take_gaps_back(contact, x, u, rows)
    type(contact_t), intent(in) :: contact
    real(wp), intent(in) :: x(:, :), u(:, :)
    type(rows_t), intent(inout) :: rows
    real(wp) :: moved(most_components)
    integer :: a
    do a = 1, rows%n
      if (contact%pairing(rows%key(1, a))%item%is_wall) cycle
      if (contact%dim == 2 .and. rows%first(a + 1) - rows%first(a) == 3) &
          call stand_before(contact, x, u, rows, a)
      moved = relative_displacement(rows, a, rows%point, contact%half_motion)
      rows%gap(a) = rows%gap(a) - moved(1)
    end do
  end subroutine take_gaps_back

  !> Row a of a node against an edge: where smooth edges share a normal, the point of the edge
  !> is moved so that the node stands before it along that normal in the middle of the step;
  !> their forces then have no moment.
  pure subroutine stand_before(contact, x, u, rows, a)
    type(contact_t), intent(in) :: contact
    real(wp), intent(in) :: x(:, :), u(:, :)
    type(rows_t), intent(inout) :: rows
    integer, intent(in) :: a
    real(wp) :: p(2, 3), edge(2), normal(2), apart(2), along
    integer :: k, i
    do k = 1, 3
      i = rows%point(rows%first(a) + k - 1)
      p(:, k) = x(:, i) + (u(:, i) + contact%half_motion(:, i))
    end do
    i = rows%first(a)
    edge = p(:, 3) - p(:, 2)
    apart = (p(:, 1) - p(:, 2)) + rows%weight(i + 2)*edge
    normal = rows%normal(:2, a)
    along = (normal(1)*apart(2) - normal(2)*apart(1))/(normal(1)*edge(2) - normal(2)*edge(1))
    if (abs(along) > 1.0e-2_wp) return      ! no edge that the node is before
    rows%weight(i + 1:i + 2) = rows%weight(i + 1:i + 2) + [along, -along]
    rows%gap(a) = rows%gap(a) - along*dot_product(normal, edge)
  end subroutine stand_before

  !> The rows of the last step with new gaps, where that is all that has changed.
  subroutine renew_gaps(contact, is_same)
    type(contact_t), intent(inout) :: contact
    logical, intent(inout) :: is_same
    integer :: p, a, b
    a = 0
    b = 0
    do p = 1, size(contact%pairing)
      if (contact%acts(p) .and. contact%pairing(p)%item%listed > 0) &
          call contact%pairing(p)%item%renew_gaps(contact%rows, a, contact%spare, b, is_same)
    end do
    is_same = is_same .and. a == contact%rows%n .and. b == contact%spare%n
  end subroutine renew_gaps

  !> The rows of the places, with the reactions of the last step.
  subroutine make_rows(contact)
    type(contact_t), intent(inout) :: contact
    integer :: p
    contact%rows_are_plain = .true.
    call start_rows(contact%next)
    call start_rows(contact%spare)
    do p = 1, size(contact%pairing)
      if (contact%acts(p) .and. contact%pairing(p)%item%listed > 0) &
          call contact%pairing(p)%item%append_rows(contact%next, contact%spare)
    end do
    if (contact%solves_without_contact < 3) then
      call carry_reactions(contact%rows, contact%next)
      if (contact%spare%n > 0) call carry_reactions(contact%rows, contact%spare)
      call take_loaded(contact)
    end if
    call use_next(contact)
  end subroutine make_rows

  !> contact%next becomes the list of rows. W stays where their geometry is the same.
  subroutine use_next(contact)
    type(contact_t), intent(inout) :: contact
    logical :: is_same
    is_same = contact%w_is_current
    if (is_same) is_same = same_geometry(contact%rows, contact%next)
    if (is_same) then
      associate (n => contact%next%n)
        contact%next%is_rigid(:n) = contact%rows%is_rigid(:n)
        contact%next%is_active(:n) = contact%rows%is_active(:n)
      end associate
    end if
    call swap_rows(contact%rows, contact%next)
    call use_rows(contact, is_same)
  end subroutine use_next

  !> The rows have been replaced: their slots, and W with them but where is_same.
  subroutine use_rows(contact, is_same)
    type(contact_t), intent(inout) :: contact
    logical, intent(in) :: is_same
    contact%w_is_current = is_same
    call find_slots(contact%slot, contact%rows)
    if (contact%spare%n > 0) call find_slots(contact%slot, contact%spare)
  end subroutine use_rows

  !> Spare rows that carried load in one of the last three solves (forces may alternate) are
  !> solved for from the start.
  subroutine take_loaded(contact)
    type(contact_t), intent(inout) :: contact
    integer :: b
    if (contact%spare%n == 0) return
    do b = 1, contact%spare%n
      contact%spare%is_marked(b) = max(contact%spare%r(1, b), contact%spare%r_previous(1, b), &
          contact%spare%r_older(1, b)) > zero .and. .not. contact%spare%is_twin(b)
    end do
    if (.not. any(contact%spare%is_marked(:contact%spare%n))) return
    call swap_rows(contact%rows, contact%next)     ! the old rows have been carried
    call take_marked(contact)
    call swap_rows(contact%rows, contact%next)
  end subroutine take_loaded

  !> Puts the marked spare rows among the rows, at their places.
  subroutine take_marked(contact)
    type(contact_t), intent(inout) :: contact
    integer :: a, b
    contact%rows_are_plain = .false.
    call start_rows(contact%left)
    call start_rows(contact%work_rows)
    a = 1
    associate (rows => contact%rows, spare => contact%spare)
      do b = 1, spare%n
        if (.not. spare%is_marked(b)) then
          call copy_row(spare, b, contact%left)
          cycle
        end if
        do while (a <= rows%n)
          if (.not. comes_before(rows%key(:, a), spare%key(:, b))) exit
          call copy_row(rows, a, contact%work_rows)
          a = a + 1
        end do
        call copy_row(spare, b, contact%work_rows)
      end do
      do a = a, rows%n
        call copy_row(rows, a, contact%work_rows)
      end do
    end associate
    call swap_rows(contact%rows, contact%work_rows)
    call swap_rows(contact%spare, contact%left)
  end subroutine take_marked

  !> The marked spare rows join the rows.
  subroutine take_spare(contact)
    type(contact_t), intent(inout) :: contact
    if (.not. any(contact%spare%is_marked(:contact%spare%n))) return
    contact%tally%late_rows = contact%tally%late_rows &
        + count(contact%spare%is_marked(:contact%spare%n))
    call take_marked(contact)
    call use_rows(contact, .false.)
  end subroutine take_spare

  !> After a solve with force (dim, m) on the interface: spare rows that are below their
  !> allowance come first; where there is none, nodes that are too deep at the end of the
  !> step, and rows whose frames have turned too much. Bodies that only pass turn too:
  !> acting or not, the end is looked at. is_complete: nothing was missing.
  subroutine add_missing_rows(model, contact, u, x_free, force, acting, is_complete)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: u(:, :), x_free(:, :), force(:, :)
    logical, intent(in) :: acting
    logical, intent(out) :: is_complete
    real(wp) :: d(most_components)
    integer :: b, n
    is_complete = .true.
    contact%x_end = x_free
    if (acting .and. allocated(contact%local)) then
      call move_by(contact, force)
      contact%x_end = contact%x_end + contact%local%motion
    else if (acting .and. size(contact%schur_inverse%block) == 1) then
      call add_product(size(force), contact%schur_inverse%block(1)%a, force, contact%x_end)
    else if (acting) then
      call add_products(size(force), contact%schur_inverse, force, contact%x_end)
    end if
    associate (spare => contact%spare)
      do b = 1, spare%n
        d = relative_displacement(spare, b, spare%slot, contact%x_end)
        spare%is_marked(b) = spare%gap(b) + d(1) < -spare%allowance(b)
        is_complete = is_complete .and. .not. spare%is_marked(b)
      end do
    end associate
    if (.not. is_complete) then
      call take_spare(contact)
    else
      call place_end(contact, u, contact%x_end)
      call find_late(model, contact, u, n)
      if (allocated(contact%half_motion)) call keep_new_rows(contact, n)
      if (n == 0 .or. contact%late_rounds == contact%most_late_rounds) &
          return
      contact%late_rounds = contact%late_rounds + 1
      is_complete = .false.
      call use_late(contact, n)
    end if
  end subroutine add_missing_rows

  !> x = x + A f.
  pure subroutine add_product(n, a, f, x)
    integer, intent(in) :: n
    real(wp), intent(in) :: a(n, n), f(n)
    real(wp), intent(inout) :: x(n)
    integer :: j
    do j = 1, n
      if (abs(f(j)) > zero) x = x + f(j)*a(:, j)
    end do
  end subroutine add_product

  !> The same, body by body.
  pure subroutine add_products(n, a, f, x)
    integer, intent(in) :: n
    type(body_blocks_t), intent(in) :: a
    real(wp), intent(in) :: f(n)
    real(wp), intent(inout) :: x(n)
    integer :: j
    do j = 1, n
      if (abs(f(j)) > zero) call a%add_column(j, f(j), x)
    end do
  end subroutine add_products

  !> Displacement of the interface nodes at the end of a step of motion x (dim, m).
  pure subroutine place_end(contact, u, x)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: u(:, :), x(:, :)
    integer :: k
    do k = 1, size(contact%interface_node)
      associate (i => contact%interface_node(k))
        contact%u_end(:, i) = u(:, i) + x(:, k)
      end associate
    end do
    do k = 1, size(contact%carried, 2)
      associate (i => contact%carried(1, k), j => contact%carried(2, k))
        contact%u_end(:, i) = u(:, i) + (contact%u_end(:, j) - u(:, j))
      end associate
    end do
  end subroutine place_end

  subroutine find_late(model, contact, u, n)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: u(:, :)
    integer, intent(out) :: n
    integer :: p
    n = 0
    do p = 1, size(contact%pairing)
      if (contact%acts(p) .and. contact%pairing(p)%item%listed > 0) &
          call contact%pairing(p)%item%find_late(model, u, contact%u_end, contact%rows, &
          contact%late, n)
    end do
  end subroutine find_late

  !> Frames are those of the middle of the step: only rows that are missing are late.
  pure subroutine keep_new_rows(contact, n)
    type(contact_t), intent(inout) :: contact
    integer, intent(inout) :: n
    integer :: k, kept
    kept = 0
    do k = 1, n
      if (contact%late(k)%row > 0) cycle
      kept = kept + 1
      contact%late(kept) = contact%late(k)
    end do
    n = kept
  end subroutine keep_new_rows

  !> The first n late rows: new ones, and new frames of rows that keep their reactions.
  subroutine use_late(contact, n)
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: n
    integer :: a, k
    contact%rows_are_plain = .false.
    call start_rows(contact%next)
    a = 1
    do k = 1, n
      associate (late => contact%late(k))
        do while (a <= contact%rows%n)
          if (comes_before(late%key(1:3), contact%rows%key(1:3, a))) exit
          if (.not. any(contact%late(:n)%row == a)) call copy_row(contact%rows, a, contact%next)
          a = a + 1
        end do
        call add_late(contact, late)
      end associate
    end do
    do a = a, contact%rows%n
      if (.not. any(contact%late(:n)%row == a)) call copy_row(contact%rows, a, contact%next)
    end do
    call swap_rows(contact%rows, contact%next)
    call use_rows(contact, .false.)
  end subroutine use_late

  subroutine add_late(contact, late)
    type(contact_t), intent(inout) :: contact
    type(late_t), intent(in) :: late
    real(wp) :: allowance, mu, gap
    mu = contact%pairing(late%key(1))%item%friction%static
    gap = late%gap
    associate (pairing => contact%pairing(late%key(1))%item)
      if (allocated(pairing%ramp)) gap = gap - ramp_floor(pairing%ramp, late%key(3))
    end associate
    allowance = late%allowance
    if (late%row > 0) allowance = contact%rows%allowance(late%row)
    call add_row(contact%next, late%key, late%point(:late%points), &
        late%weight(:late%points), late%normal(:contact%dim), gap, mu, late%length, &
        late%kind, allowance)
    if (late%row > 0) then
      contact%tally%new_frames = contact%tally%new_frames + 1
      call take_reactions(contact%rows, late%row, contact%next, contact%next%n)
    else
      contact%tally%late_rows = contact%tally%late_rows + 1
      call drop_spare(contact, late)
    end if
  end subroutine add_late

  !> A spare row that says the same as a late one is not needed any more.
  subroutine drop_spare(contact, late)
    type(contact_t), intent(inout) :: contact
    type(late_t), intent(in) :: late
    integer :: b
    do b = 1, contact%spare%n
      if (any(contact%spare%key(1:3, b) /= late%key(1:3))) cycle
      if (dot_product(contact%spare%normal(:, b), late%normal(:contact%dim)) &
          > cos(smooth_angle)) &
          contact%spare%allowance(b) = huge(one)
    end do
  end subroutine drop_spare

  !> Rows of a contact solve by kind, for the log.
  pure subroutine count_rows(contact)
    type(contact_t), intent(inout) :: contact
    integer :: a
    associate (rows => contact%rows, tally => contact%tally)
      do a = 1, rows%n
        tally%rows(rows%kind(a)) = tally%rows(rows%kind(a)) + 1
        if (rows%allowance(a) > zero) tally%allowances = tally%allowances + 1
      end do
    end associate
  end subroutine count_rows

end module contact_assemble
