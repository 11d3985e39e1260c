! SPDX-License-Identifier: BSD-3-Clause
!> Supports, prescribed motions and initial velocities: from cards to the model.
module scene_motion
  use base_kinds, only: wp, zero, one
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_note
  use deck_schemes, only: scheme_traits_t, traits_of
  use model_data, only: model_t, motion_t, curve_value, curve_slope, motion_acceleration, &
      motion_displacement
  use scene_ids, only: maps_t, records_of, find_or_complain
  use scene_loads, only: nodes_of, curve_of
  implicit none
  private
  public :: read_supports, read_motions, read_initial_velocities

  character, parameter :: axis(3) = ['X', 'Y', 'Z']

  !> A rotation: angular velocity [1/T] about an axis through a centre [L].
  type :: spin_t
    real(wp) :: omega = zero
    real(wp) :: axis(3) = [zero, zero, one], centre(3) = zero
  end type spin_t

contains

  !> *BOUNDARY_SPC_SET and _NODE.
  subroutine read_supports(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    integer, allocatable :: list(:)
    integer :: k, r, d
    do k = 1, 2
      r = deck%next('BOUNDARY_SPC_'//trim(merge('SET ', 'NODE', k == 1)), 1, 0)
      do while (r > 0)
        call nodes_of(deck, model, maps, r, k == 1, list)
        do d = 1, model%dim
          if (deck%integer(r, 'DOF'//axis(d)) == 1) model%fixed(d, list) = .true.
        end do
        r = deck%next('BOUNDARY_SPC_'//trim(merge('SET ', 'NODE', k == 1)), 1, r)
      end do
    end do
  end subroutine read_supports

  !> *BOUNDARY_PRESCRIBED_MOTION_SET and _NODE. A direction of a node may have one motion and
  !> no support.
  subroutine read_motions(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    integer, allocatable :: set_record(:), record(:), owner(:, :)
    integer :: k
    call records_of(deck, 'BOUNDARY_PRESCRIBED_MOTION_SET', 1, set_record)
    call records_of(deck, 'BOUNDARY_PRESCRIBED_MOTION_NODE', 1, record)
    allocate (model%motion(size(set_record) + size(record)), owner(model%dim, model%nodes))
    owner = 0
    record = [set_record, record]
    do k = 1, size(record)
      call read_motion(deck, model, maps, record(k), k <= size(set_record), model%motion(k))
      call claim(deck, model, model%motion(k), owner)
    end do
  end subroutine read_motions

  subroutine read_motion(deck, model, maps, record, is_set, motion)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record
    logical, intent(in) :: is_set
    type(motion_t), intent(inout) :: motion
    type(scheme_traits_t) :: traits
    motion%record = record
    call nodes_of(deck, model, maps, record, is_set, motion%node)
    motion%direction = deck%integer(record, 'DOF')
    motion%kind = deck%integer(record, 'VAD')
    motion%curve = curve_of(deck, model, maps, record)
    motion%factor = deck%real(record, 'SF')
    motion%birth = deck%real(record, 'BIRTH')
    motion%death = deck%real(record, 'DEATH')
    traits = traits_of(model%controls%scheme)
    if (motion%kind == motion_acceleration .and. .not. traits%has_acceleration) &
        call deck%complain(record, 'VAD', 'scheme '//trim(model%controls%scheme)// &
        ' has no accelerations', 'give the velocity (0) or the displacement (2)')
    if (.not. motion%death > motion%birth) &
        call deck%complain(record, 'DEATH', 'expected a time after BIRTH')
  end subroutine read_motion

  subroutine claim(deck, model, motion, owner)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(motion_t), intent(in) :: motion
    integer, intent(inout) :: owner(:, :)
    integer :: k
    do k = 1, size(motion%node)
      associate (i => motion%node(k), d => motion%direction)
        if (model%fixed(d, i)) then
          call deck%complain(motion%record, 'DOF', 'direction '//axis(d)//' of node '// &
              to_text(model%node_id(i))//' is fixed')
        else if (owner(d, i) > 0) then
          call deck%complain(motion%record, 'DOF', 'direction '//axis(d)//' of node '// &
              to_text(model%node_id(i))//' has a motion already', 'the first is at '// &
              deck%place(owner(d, i)))
        end if
        if (owner(d, i) > 0 .or. model%fixed(d, i)) return
        owner(d, i) = motion%record
      end associate
    end do
  end subroutine claim

  !> *INITIAL_VELOCITY, _NODE, _GENERATION. A node that gets two different velocities is a
  !> problem (which one should win?), so is one that its motion contradicts. A support wins.
  !> Where a motion prescribes the velocity and no card gives one, the motion's is taken.
  subroutine read_initial_velocities(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    integer, allocatable :: owner(:), list(:)
    type(spin_t) :: still
    integer :: k, r
    allocate (owner(model%nodes))
    owner = 0
    r = deck%next('INITIAL_VELOCITY', 1, 0)
    do while (r > 0)
      if (deck%integer(r, 'NSID') == 0) then
        list = [(k, k=1, model%nodes)]
      else
        call nodes_of(deck, model, maps, r, .true., list)
      end if
      if (deck%follow(r, 2) > 0) &
          call give_velocity(deck, model, deck%follow(r, 2), list, still, owner)
      r = deck%next('INITIAL_VELOCITY', 1, r)
    end do
    r = deck%next('INITIAL_VELOCITY_NODE', 1, 0)
    do while (r > 0)
      call nodes_of(deck, model, maps, r, .false., list)
      call give_velocity(deck, model, r, list, still, owner)
      r = deck%next('INITIAL_VELOCITY_NODE', 1, r)
    end do
    r = deck%next('INITIAL_VELOCITY_GENERATION', 1, 0)
    do while (r > 0)
      call generate_velocity(deck, model, maps, r, owner)
      r = deck%next('INITIAL_VELOCITY_GENERATION', 1, r)
    end do
    call stop_supported(deck, model)
    if (model%controls%is_static .and. any(abs(model%v0) > zero)) then
      model%v0 = zero
      call add_note(deck%problems, 'initial velocities have no effect in a static analysis')
    end if
    call start_motions(deck, model, owner)
  end subroutine read_initial_velocities

  !> Fixed directions do not move, whatever a card gives their nodes.
  subroutine stop_supported(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    integer :: n
    n = count(any(model%fixed .and. abs(model%v0) > zero, dim=1))
    where (model%fixed) model%v0 = zero
    if (n > 0) call add_note(deck%problems, 'initial velocity on fixed directions of '// &
        to_text(n)//trim(merge(' node ', ' nodes', n == 1))//': the supports win')
  end subroutine stop_supported

  subroutine generate_velocity(deck, model, maps, record, owner)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record
    integer, intent(inout) :: owner(:)
    integer, allocatable :: list(:)
    type(spin_t) :: spin
    integer :: second, d
    second = deck%follow(record, 2)
    if (second == 0) return
    call generation_nodes(deck, model, maps, record, list)
    spin%omega = deck%real(record, 'OMEGA')
    spin%centre = [(deck%real(second, axis(d)//'C'), d=1, 3)]
    spin%axis = [(deck%real(second, 'N'//axis(d)), d=1, 3)]
    if (.not. any(abs(spin%axis) > zero)) spin%axis(3) = one
    if (model%is_axisymmetric .and. abs(spin%omega) > zero) call deck%complain(record, &
        'OMEGA', 'expected 0: an axisymmetric model does not rotate')
    if (model%dim == 2 .and. abs(abs(spin%axis(3)) - one) > zero) &
        call deck%complain(second, 'NZ', 'expected 1 or -1: the axis of rotation is z')
    spin%axis = spin%axis/norm2(spin%axis)
    call give_velocity(deck, model, record, list, spin, owner)
  end subroutine generate_velocity

  !> Nodes of a part set (STYP 1), a part (2) or a node set (3); id 0 = all nodes.
  subroutine generation_nodes(deck, model, maps, record, list)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record
    integer, allocatable, intent(out) :: list(:)
    logical :: wanted(size(model%part))
    logical, allocatable :: taken(:)
    integer :: id, row, k
    id = deck%integer(record, 'ID')
    allocate (taken(model%nodes))
    taken = id == 0
    wanted = .false.
    row = 0
    if (id /= 0) then
      select case (deck%integer(record, 'STYP'))
      case (1)
        row = find_or_complain(deck, maps%part_set, record, 'ID', id, 'part set')
        if (row > 0) wanted(model%part_set(row)%member) = .true.
      case (2)
        row = find_or_complain(deck, maps%part, record, 'ID', id, 'part')
        if (row > 0) wanted(row) = .true.
      case (3)
        row = find_or_complain(deck, maps%node_set, record, 'ID', id, 'node set')
        if (row > 0) taken(model%node_set(row)%member) = .true.
      end select
    end if
    do k = 1, model%mesh%n
      if (model%mesh%part(k) == 0) cycle
      if (wanted(model%mesh%part(k))) &
          taken(pack(model%mesh%nodes_of(k), model%mesh%nodes_of(k) > 0)) = .true.
    end do
    list = pack([(k, k=1, model%nodes)], taken)
  end subroutine generation_nodes

  !> v = V + omega n x (X - C) for the nodes of a list.
  subroutine give_velocity(deck, model, record, list, spin, owner)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    integer, intent(in) :: record
    integer, intent(in) :: list(:)
    type(spin_t), intent(in) :: spin
    integer, intent(inout) :: owner(:)
    real(wp) :: given(model%dim), v(model%dim), lever(3), omega(3)
    integer :: k, d
    logical :: told
    told = .false.
    given = [(deck%real(record, 'V'//axis(d)), d=1, model%dim)]
    omega = spin%omega*spin%axis
    lever = zero
    do k = 1, size(list)
      associate (i => list(k), c => spin%centre)
        lever(:model%dim) = model%x(:, i) - c(:model%dim)
        v(1) = given(1) - omega(3)*lever(2)
        v(2) = given(2) + omega(3)*lever(1)
        if (model%dim == 3) v = given + [omega(2)*lever(3) - omega(3)*lever(2), &
            omega(3)*lever(1) - omega(1)*lever(3), omega(1)*lever(2) - omega(2)*lever(1)]
        if (.not. told .and. owner(i) > 0 .and. owner(i) /= record) then
          told = any(abs(model%v0(:, i) - v) > zero)
          if (told) call deck%complain(record, 'VX', 'node '//to_text(model%node_id(i))// &
              ' gets a second, different initial velocity', 'the first is at '// &
              deck%place(owner(i)))
        end if
        model%v0(:, i) = v
        owner(i) = record
      end associate
    end do
  end subroutine give_velocity

  !> Initial velocity of prescribed directions: the curve's at t = 0 (VAD 2: its slope).
  subroutine start_motions(deck, model, owner)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    integer, intent(in) :: owner(:)
    real(wp) :: v
    integer :: k, m
    do m = 1, size(model%motion)
      associate (motion => model%motion(m))
        if (motion%birth > zero .or. motion%curve == 0) cycle
        if (motion%kind == motion_acceleration) cycle
        v = motion%factor*curve_value(model%curve(motion%curve), zero)
        if (motion%kind == motion_displacement) &
            v = motion%factor*curve_slope(model%curve(motion%curve), zero)
        do k = 1, size(motion%node)
          associate (i => motion%node(k), d => motion%direction)
            if (owner(i) == 0) model%v0(d, i) = v
            if (abs(model%v0(d, i) - v) <= 1.0e-9_wp*abs(v)) cycle
            call deck%complain(owner(i), 'V'//axis(d), 'initial velocity of node '// &
                to_text(model%node_id(i))//' differs from that of its prescribed motion, '// &
                to_text(v), 'the motion is at '//deck%place(motion%record))
            exit
          end associate
        end do
      end associate
    end do
  end subroutine start_motions

end module scene_motion
