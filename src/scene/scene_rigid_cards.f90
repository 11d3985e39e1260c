! SPDX-License-Identifier: BSD-3-Clause
!> What cards give to rigid parts: constraints, initial velocities, forces, motions.
module scene_rigid_cards
  use base_kinds, only: wp, zero, one
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_note
  use deck_schemes, only: scheme_traits_t, traits_of
  use model_data, only: model_t, load_t, motion_t, curve_value, curve_slope, &
      motion_acceleration, motion_displacement
  use model_rigid, only: place_followers
  use scene_ids, only: maps_t, records_of, find_or_complain
  use scene_loads, only: curve_of
  implicit none
  private

  !> A rigid body while it is being made.
  type, public :: body_t
    integer :: part = 0                   !< row of the first of its parts
    real(wp) :: mass = zero               !< [M]
    real(wp) :: centre(2) = zero          !< [L]
    real(wp) :: inertia = zero            !< about the centre [M L2]
    integer, allocatable :: node(:)
  end type body_t

  public :: read_constraints, read_velocities, read_forces, read_rigid_motions, check_motion, &
      start_motion

  !> Directions x, y, z that CON1 or CON2 1 to 7 hold.
  logical, parameter, public :: holds(3, 0:7) = reshape([.false., .false., .false., &
      .true., .false., .false., .false., .true., .false., .false., .false., .true., &
      .true., .true., .false., .false., .true., .true., .true., .false., .true., &
      .true., .true., .true.], [3, 8])
  !> DOF of a rotation about z.
  integer, parameter :: about_z = 7

contains

  !> CON1 and CON2 of the material of the part that a body is named after.
  subroutine read_constraints(deck, model, body)
    type(deck_t), intent(in) :: deck
    type(model_t), intent(inout) :: model
    type(body_t), intent(in) :: body(:)
    integer, allocatable :: record(:)
    integer :: b, k, r
    call records_of(deck, 'MAT_RIGID', 1, record)
    do b = 1, size(body)
      do k = 1, size(record)
        if (deck%integer(record(k), 'MID') /= model%part(body(b)%part)%material_id) cycle
        r = deck%follow(record(k), 2)
        if (r == 0) cycle
        if (.not. deck%real(r, 'CMO') > zero) cycle
        model%fixed(:, model%rigid%centre(b)) = holds(:2, deck%integer(r, 'CON1'))
        model%fixed(1, model%rigid%rotor(b)) = holds(3, deck%integer(r, 'CON2'))
      end do
    end do
  end subroutine read_constraints

  !> Row of the body of the part that a card names; 0 and a problem if the part is not rigid.
  integer function body_at(deck, model, maps, body_of, record)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: body_of(:), record
    integer :: p
    body_at = 0
    p = find_or_complain(deck, maps%part, record, 'PID', deck%integer(record, 'PID'), 'part')
    if (p > 0) body_at = body_of(p)
    if (p > 0 .and. body_at == 0) call deck%complain(record, 'PID', 'part '// &
        to_text(model%part(p)%id)//' is not rigid', 'its material must be *MAT_RIGID')
  end function body_at

  !> Initial velocities: *INITIAL_VELOCITY_RIGID_BODY, then those of *PART_INERTIA, then the
  !> rigid motion that the velocities of the nodes are. Constraints win.
  subroutine read_velocities(deck, model, maps, body_of, body)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: body_of(:)
    type(body_t), intent(in) :: body(:)
    real(wp) :: v(3, size(body)), u(2, model%nodes)
    logical :: is_given(size(body))
    integer :: b, r
    is_given = .false.
    r = deck%next('INITIAL_VELOCITY_RIGID_BODY', 1, 0)
    do while (r > 0)
      b = body_at(deck, model, maps, body_of, r)
      if (b > 0) then
        if (is_given(b)) call deck%complain(r, 'PID', &
            'the rigid body has an initial velocity already')
        v(:, b) = [deck%real(r, 'VX'), deck%real(r, 'VY'), deck%real(r, 'VZR')]
        is_given(b) = .true.
      end if
      r = deck%next('INITIAL_VELOCITY_RIGID_BODY', 1, r)
    end do
    if (size(body) == 0) return
    do b = 1, size(body)
      if (.not. is_given(b)) call velocity_of_inertia(deck, model, body(b)%part, v(:, b), &
          is_given(b))
      if (.not. is_given(b)) call velocity_of_nodes(deck, model, body(b), v(:, b))
      model%v0(:, model%rigid%centre(b)) = v(1:2, b)
      model%v0(1, model%rigid%rotor(b)) = model%rigid%radius(b)*v(3, b)
    end do
    if (model%controls%is_static) model%v0 = zero
    where (model%fixed) model%v0 = zero
    u = zero
    call place_followers(model%rigid, u, model%v0)
  end subroutine read_velocities

  !> Initial velocity on the cards of *PART_INERTIA; of its first part that has one.
  subroutine velocity_of_inertia(deck, model, part, v, is_given)
    type(deck_t), intent(in) :: deck
    type(model_t), intent(in) :: model
    integer, intent(in) :: part
    real(wp), intent(inout) :: v(3)
    logical, intent(out) :: is_given
    integer :: r
    is_given = .false.
    r = deck%follow(model%part(part)%record, 5)
    if (r == 0) return
    v = [deck%real(r, 'VTX'), deck%real(r, 'VTY'), deck%real(r, 'VRZ')]
    is_given = any(abs(v) > zero)
  end subroutine velocity_of_inertia

  !> The rigid motion that the initial velocities of the nodes are; a problem if they are none.
  subroutine velocity_of_nodes(deck, model, body, v)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(body_t), intent(in) :: body
    real(wp), intent(out) :: v(3)
    real(wp) :: middle(2), mean(2), turn, inertia, misfit
    integer :: k
    associate (node => body%node)
      middle = sum(model%x(:, node), dim=2)/size(node)
      ! Differences, so that equal velocities stay what they are to the last digit.
      mean = model%v0(:, node(1)) + &
          sum(model%v0(:, node) - spread(model%v0(:, node(1)), 2, size(node)), dim=2)/size(node)
      turn = zero
      inertia = zero
      do k = 1, size(node)
        associate (d => model%x(:, node(k)) - middle, w => model%v0(:, node(k)) - mean)
          turn = turn + d(1)*w(2) - d(2)*w(1)
          inertia = inertia + sum(d**2)
        end associate
      end do
      turn = turn/inertia
      misfit = zero
      do k = 1, size(node)
        associate (d => model%x(:, node(k)) - middle, w => model%v0(:, node(k)) - mean)
          misfit = max(misfit, maxval(abs(w - turn*[-d(2), d(1)])))
        end associate
      end do
      if (misfit > 1.0e-9_wp*maxval(abs(model%v0(:, node)))) call deck%complain( &
          model%part(body%part)%record, 'PID', 'the initial velocities of the nodes of '// &
          'rigid part '//to_text(model%part(body%part)%id)//' are no rigid motion', &
          'give its velocity by *INITIAL_VELOCITY_RIGID_BODY')
      v(1:2) = mean + turn*[middle(2) - body%centre(2), body%centre(1) - middle(1)]
      v(3) = turn
    end associate
  end subroutine velocity_of_nodes

  !> *LOAD_RIGID_BODY.
  subroutine read_forces(deck, model, maps, body_of, body)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: body_of(:)
    type(body_t), intent(in) :: body(:)
    type(load_t) :: load
    integer :: r, b, d
    r = deck%next('LOAD_RIGID_BODY', 1, 0)
    do while (r > 0)
      b = body_at(deck, model, maps, body_of, r)
      d = direction_of(deck, r)
      if (b > 0 .and. d > 0) then
        load%curve = curve_of(deck, model, maps, r)
        load%factor = deck%real(r, 'SF')
        if (d == about_z) then
          load%node = [model%rigid%rotor(b)]
          load%force = reshape([one/model%rigid%radius(b), zero], [2, 1])
        else
          load%node = [model%rigid%centre(b)]
          load%force = reshape([merge(one, zero, d == 1), merge(one, zero, d == 2)], [2, 1])
        end if
        model%load = [model%load, load]
      end if
      r = deck%next('LOAD_RIGID_BODY', 1, r)
    end do
  end subroutine read_forces

  !> DOF of a card: 1, 2 or the rotation about z; else a problem and 0.
  integer function direction_of(deck, record)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    direction_of = deck%integer(record, 'DOF')
    if (any(direction_of == [1, 2, about_z])) return
    call deck%complain(record, 'DOF', 'expected 1 (x), 2 (y) or 7 (rotation about z)', &
        'the model is plane')
    direction_of = 0
  end function direction_of

  !> *BOUNDARY_PRESCRIBED_MOTION_RIGID. A motion that acts at t = 0 gives the initial velocity.
  subroutine read_rigid_motions(deck, model, maps, body_of, body)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: body_of(:)
    type(body_t), intent(in) :: body(:)
    type(motion_t) :: motion
    real(wp) :: u(2, model%nodes)
    integer :: r, b, d
    r = deck%next('BOUNDARY_PRESCRIBED_MOTION_RIGID', 1, 0)
    if (r == 0) return
    do while (r > 0)
      b = body_at(deck, model, maps, body_of, r)
      d = direction_of(deck, r)
      if (b > 0 .and. d > 0) then
        motion%record = r
        motion%kind = deck%integer(r, 'VAD')
        motion%curve = curve_of(deck, model, maps, r)
        motion%factor = deck%real(r, 'SF')
        motion%birth = deck%real(r, 'BIRTH')
        motion%death = deck%real(r, 'DEATH')
        motion%direction = merge(1, d, d == about_z)
        motion%node = [merge(model%rigid%rotor(b), model%rigid%centre(b), d == about_z)]
        if (d == about_z) motion%factor = model%rigid%radius(b)*motion%factor
        call check_motion(deck, model, motion)
        if (motion%curve > 0) call start_motion(deck, model, motion)
        model%motion = [model%motion, motion]
      end if
      r = deck%next('BOUNDARY_PRESCRIBED_MOTION_RIGID', 1, r)
    end do
    u = zero
    if (size(body) > 0) call place_followers(model%rigid, u, model%v0)
  end subroutine read_rigid_motions

  !> A direction of a part may have one motion and no constraint.
  subroutine check_motion(deck, model, motion)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(motion_t), intent(in) :: motion
    type(scheme_traits_t) :: traits
    integer :: k
    traits = traits_of(model%controls%scheme)
    if (motion%kind == motion_acceleration .and. .not. traits%has_acceleration) &
        call deck%complain(motion%record, 'VAD', 'scheme '//trim(model%controls%scheme)// &
        ' has no accelerations', 'give the velocity (0) or the displacement (2)')
    if (.not. motion%death > motion%birth) &
        call deck%complain(motion%record, 'DEATH', 'expected a time after BIRTH')
    if (model%fixed(motion%direction, motion%node(1))) call deck%complain(motion%record, &
        'DOF', 'this direction of the part is held by CON1 or CON2 of its *MAT_RIGID')
    do k = 1, size(model%motion)
      associate (other => model%motion(k))
        if (other%direction /= motion%direction .or. &
            size(other%node) /= size(motion%node)) cycle
        if (other%node(1) == motion%node(1)) call deck%complain(motion%record, 'DOF', &
            'this direction of the part has a motion already', 'the first is at '// &
            deck%place(other%record))
      end associate
    end do
  end subroutine check_motion

  !> The initial velocity of a direction that is moved from the start, of all its nodes.
  subroutine start_motion(deck, model, motion)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(motion_t), intent(in) :: motion
    real(wp) :: v
    integer :: k
    if (motion%birth > zero .or. motion%kind == motion_acceleration) return
    v = motion%factor*curve_value(model%curve(motion%curve), zero)
    if (motion%kind == motion_displacement) &
        v = motion%factor*curve_slope(model%curve(motion%curve), zero)
    if (model%controls%is_static) v = zero
    do k = 1, size(motion%node)
      associate (v0 => model%v0(motion%direction, motion%node(k)))
        if (abs(v0) > zero .and. abs(v0 - v) > 1.0e-9_wp*abs(v)) then
          call deck%complain(motion%record, 'DOF', 'the part has another initial velocity '// &
              'than this motion', 'leave the initial velocity out: the motion gives it')
          return
        end if
        v0 = v
      end associate
    end do
  end subroutine start_motion

end module scene_rigid_cards
