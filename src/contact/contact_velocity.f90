! SPDX-License-Identifier: BSD-3-Clause
!> Rows of contact on velocities (Jean 1999; Acary 2016). The law there says nothing of
!> gaps, so nodes sink in, by up to a motion of a step, and stay: what they touch is found as
!> if they stood on the boundary that they went through.
module contact_velocity
  use base_kinds, only: wp, zero
  use base_status, only: status_t, fail, failed, status_numerical
  use cone_types, only: most_components
  use contact_assemble, only: find_rows, take_spare
  use contact_kinematics, only: relative_displacement
  use contact_rows, only: rows_t
  use contact_types, only: contact_t
  use model_data, only: model_t, node_name
  implicit none
  private
  public :: find_velocity_rows, keep_pressed_rows, activate_all, add_restitution, &
      largest_component

contains

  !> Rows at displacement u and velocity v (dim, nodes) for the free motion x_free (dim, m),
  !> which of them act, and their offsets [L]. Fails where a node has sunk in beyond what is
  !> listed.
  subroutine find_velocity_rows(model, contact, u, v, x_free, status)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: u(:, :), v(:, :), x_free(:, :)
    type(status_t), intent(inout) :: status
    integer :: a
    if (.not. any(contact%rows%u(1, :contact%rows%n) < zero)) then
      call find_rows(model, contact, u, x_free)
      if (contact%rows%n + contact%spare%n == 0) return
    else
      contact%placed = u
      call place_on_boundary(contact%rows, u, contact%placed)
      call find_rows(model, contact, contact%placed, x_free)
      contact%placed = u - contact%placed
      call correct_gaps(contact%placed, contact%rows)
      call correct_gaps(contact%placed, contact%spare)
    end if
    call check_slots(model, contact%rows, status)
    call check_slots(model, contact%spare, status)
    if (failed(status)) return
    do a = 1, contact%spare%n
      contact%spare%is_marked(a) = touches(contact, contact%spare, a, v)
    end do
    call take_spare(contact)
    do a = 1, contact%rows%n
      call activate(contact, a, touches(contact, contact%rows, a, v), v)
    end do
  end subroutine find_velocity_rows

  !> The rows of the stage before: those act that it pressed.
  subroutine keep_pressed_rows(contact, v)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: v(:, :)
    integer :: a
    do a = 1, contact%rows%n
      call activate(contact, a, contact%rows%r(1, a) > zero, v)
    end do
  end subroutine keep_pressed_rows

  !> All points of rows are on the interface, unless a node has sunk in too far.
  subroutine check_slots(model, rows, status)
    type(model_t), intent(in) :: model
    type(rows_t), intent(in) :: rows
    type(status_t), intent(inout) :: status
    integer :: a
    do a = 1, rows%n
      if (all(rows%slot(rows%first(a):rows%first(a + 1) - 1) > 0)) cycle
      call fail(status, status_numerical, node_name(model, rows%key(3, a))// &
          ' has sunk in beyond the nodes that are listed', &
          hint='take a smaller step, or contact on positions')
      return
    end do
  end subroutine check_slots

  !> Moves contactor nodes that are below the boundary of one of the rows of the last step
  !> onto it. rows%u(1, :) is the gap then, rows of a node follow each other.
  pure subroutine place_on_boundary(rows, u, placed)
    type(rows_t), intent(in) :: rows
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(inout) :: placed(:, :)
    real(wp) :: gap
    integer :: a
    do a = 1, rows%n
      associate (i => rows%key(3, a), n => rows%normal(:, a))
        gap = rows%u(1, a) + dot_product(n, placed(:, i) - u(:, i))
        if (gap < zero) placed(:, i) = placed(:, i) - gap*n
      end associate
    end do
  end subroutine place_on_boundary

  !> The gaps of nodes where they are; sunk (dim, nodes) is how they lie from where they were
  !> placed [L].
  pure subroutine correct_gaps(sunk, rows)
    real(wp), intent(in), contiguous :: sunk(:, :)
    type(rows_t), intent(inout) :: rows
    real(wp) :: d(most_components)
    integer :: a
    do a = 1, rows%n
      d = relative_displacement(rows, a, rows%point, sunk)
      rows%gap(a) = rows%gap(a) + d(1)
    end do
  end subroutine correct_gaps

  !> gap + lead v_n <= 0, to the tolerance of a touch: round-off does not lift a body.
  pure logical function touches(contact, rows, a, v)
    type(contact_t), intent(in) :: contact
    type(rows_t), intent(in) :: rows
    integer, intent(in) :: a
    real(wp), intent(in), contiguous :: v(:, :)
    real(wp) :: velocity(most_components)
    velocity = relative_displacement(rows, a, rows%point, v)
    touches = rows%gap(a) + rows%allowance(a) + contact%rule%lead*velocity(1) &
        <= contact%penetration_tolerance*rows%length(a)
  end function touches

  !> Whether row a acts, and its offsets (now e - before) v with e of the normal direction at
  !> least safe_share where v_n > 0.
  pure subroutine activate(contact, a, is_active, v)
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: a
    logical, intent(in) :: is_active
    real(wp), intent(in), contiguous :: v(:, :)
    real(wp) :: velocity(most_components), e, e_n
    associate (rows => contact%rows, rule => contact%rule)
      velocity = relative_displacement(rows, a, rows%point, v)
      e = contact%pairing(rows%key(1, a))%item%restitution
      e_n = e
      if (velocity(1) > zero) e_n = max(e, rule%safe_share)
      rows%offset(a) = (rule%now*e_n - rule%before)*velocity(1)
      rows%offset_t(:, a) = (rule%now*e - rule%before)*velocity(2:rows%dim)
      if (is_active .neqv. rows%is_active(a)) contact%w_is_current = .false.
      rows%is_active(a) = is_active
      contact%was_on_velocities = .true.
    end associate
  end subroutine activate

  !> On positions all rows act, whatever the stage before has left.
  pure subroutine activate_all(contact)
    type(contact_t), intent(inout) :: contact
    if (.not. contact%was_on_velocities) return
    contact%was_on_velocities = .false.
    if (.not. all(contact%rows%is_active(:contact%rows%n))) contact%w_is_current = .false.
    contact%rows%is_active = .true.
    contact%rows%offset_t = zero
  end subroutine activate_all

  !> Restitution on positions (doc/theory.md): g1 + e (gap before) >= 0 with the gap before =
  !> g0 - lead v_n, v (dim, nodes) the velocity of the last step.
  pure subroutine add_restitution(contact, v)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: v(:, :)
    real(wp) :: velocity(most_components)
    integer :: a
    associate (rows => contact%rows)
      do a = 1, rows%n
        associate (e => contact%pairing(rows%key(1, a))%item%restitution)
          if (.not. e > zero) cycle
          velocity = relative_displacement(rows, a, rows%point, v)
          rows%offset(a) = rows%offset(a) + e*(rows%gap(a) - contact%rule%lead*velocity(1))
        end associate
      end do
    end associate
  end subroutine add_restitution

  !> Of n components of velocities [L/T].
  pure real(wp) function largest_component(n, v) result(largest)
    integer, intent(in) :: n
    real(wp), intent(in) :: v(n)
    integer :: i
    largest = zero
    do i = 1, n
      largest = max(largest, abs(v(i)))
    end do
  end function largest_component

end module contact_velocity
