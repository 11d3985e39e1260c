! SPDX-License-Identifier: BSD-3-Clause
!> Rigid walls: their cards, and the nodes that carry the motion of those that have one.
module scene_walls
  use base_kinds, only: wp, zero
  use deck_data, only: deck_t
  use deck_keywords_wall, only: wall_keyword
  use model_data, only: model_t, wall_t, motion_t, motion_velocity, motion_displacement, &
      curve_value, curve_slope
  use scene_contact, only: id_before, merged
  use scene_ids, only: maps_t, id_map_t, make_id_map, records_of, find_or_complain
  use scene_loads, only: curve_of
  implicit none
  private
  public :: read_walls, add_bodies

contains

  !> All walls, in the order of the deck; those without an id are numbered by it.
  subroutine read_walls(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(inout) :: maps
    type(id_map_t) :: map
    integer, allocatable :: record(:), other(:)
    integer :: k
    allocate (record(0))
    do k = 1, size(wall_keyword)
      call records_of(deck, trim(wall_keyword(k)), 1, other)
      record = merged(record, other)
    end do
    allocate (model%wall(size(record)))
    do k = 1, size(record)
      associate (wall => model%wall(k), r => record(k))
        wall%record = r
        wall%id = id_before(deck, r, k)
        wall%birth = deck%real(r, 'BIRTH')
        wall%death = deck%real(r, 'DEATH')
        if (deck%integer(r, 'NSID') > 0) wall%node_set = find_or_complain(deck, maps%node_set, &
            r, 'NSID', deck%integer(r, 'NSID'), 'node set')
        call read_wall(deck, model, maps, r, wall)
      end associate
    end do
    call make_id_map(deck, 'wall', 'NSID', model%wall%id, record, map)
  end subroutine read_walls

  !> The cards after the first.
  subroutine read_wall(deck, model, maps, record, wall)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record
    type(wall_t), intent(inout) :: wall
    character(:), allocatable :: name
    integer :: second, third
    name = deck%table%keyword(deck%block(deck%record(record)%block)%keyword)%canonical
    if (model%dim == 3 .and. index(name, '_CYLINDER') > 0) then
      call deck%complain(record, '', '*'//trim(name)//' is not available in space in this '// &
          'version', 'walls in space are planes')
      return
    end if
    second = deck%follow(record, 2)
    if (second == 0) return
    call read_friction(deck, second, wall)
    if (index(name, '_CYLINDER') > 0) then
      call read_axis(deck, second, wall)
    else
      call read_plane(deck, second, wall)
    end if
    third = deck%follow(record, 3)
    if (third == 0) return
    if (index(name, '_MOVING') > 0) call read_mass(deck, model, third, wall)
    if (index(name, '_FLAT') > 0) call read_ends(deck, second, third, wall)
    if (index(name, '_CYLINDER') > 0) wall%shape = 'CYLINDER'
    if (index(name, '_CYLINDER') > 0) wall%radius = deck%real(third, 'RADCYL')
    wall%is_interior = index(name, '_INTERIOR') > 0
    if (index(name, '_MOTION') > 0 .and. deck%follow(record, 4) > 0) &
        call read_motion(deck, model, maps, deck%follow(record, 4), wall)
  end subroutine read_wall

  subroutine read_friction(deck, record, wall)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: record
    type(wall_t), intent(inout) :: wall
    real(wp), parameter :: no_sliding = 1.0e6_wp
    wall%point = [deck%real(record, 'XT'), deck%real(record, 'YT'), deck%real(record, 'ZT')]
    wall%mu = deck%real(record, 'FRIC')
    if (.not. wall%mu < 1.0_wp) wall%mu = no_sliding
  end subroutine read_friction

  subroutine read_plane(deck, record, wall)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    type(wall_t), intent(inout) :: wall
    if (.not. deck%in_space .and. abs(deck%real(record, 'ZH') - wall%point(3)) > zero) &
        call deck%complain(record, 'ZH', 'expected the value of ZT: the model is plane')
    wall%normal = [deck%real(record, 'XH'), deck%real(record, 'YH'), &
        deck%real(record, 'ZH')] - wall%point
    call make_unit(deck, record, 'XH', 'expected a point H apart from T: the normal of the '// &
        'wall points from T to H', wall%normal)
  end subroutine read_plane

  !> A direction, of length 1; a problem at this field where it is zero.
  subroutine make_unit(deck, record, field, fault, direction)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    character(*), intent(in) :: field, fault
    real(wp), intent(inout) :: direction(:)
    if (any(abs(direction) > zero)) then
      direction = direction/norm2(direction)
    else
      call deck%complain(record, field, fault)
    end if
  end subroutine make_unit

  !> The axis of a cylinder, along z.
  subroutine read_axis(deck, record, wall)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    type(wall_t), intent(in) :: wall
    if (abs(deck%real(record, 'XH') - wall%point(1)) > zero) call deck%complain(record, 'XH', &
        'expected the value of XT: the axis of the cylinder is along z')
    if (abs(deck%real(record, 'YH') - wall%point(2)) > zero) call deck%complain(record, 'YH', &
        'expected the value of YT: the axis of the cylinder is along z')
    if (.not. deck%real(record, 'ZH') > deck%real(record, 'ZT')) call deck%complain(record, &
        'ZH', 'expected a value above ZT: the axis of the cylinder points along z')
  end subroutine read_axis

  !> The other end of a flat wall.
  subroutine read_ends(deck, second, third, wall)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: second, third
    type(wall_t), intent(inout) :: wall
    !> The digits of a field of 10 columns.
    real(wp), parameter :: upright = 1.0e-6_wp
    wall%shape = 'FLAT'
    wall%length = deck%real(third, 'LENL')
    if (.not. wall%length > zero) return
    if (deck%in_space) then
      call deck%complain(third, 'LENL', 'a wall with ends is not available in space in '// &
          'this version', 'LENL 0 is a plane without ends')
      return
    end if
    if (abs(deck%real(third, 'ZHEV') - deck%real(second, 'ZT')) > zero) call deck%complain( &
        third, 'ZHEV', 'expected the value of ZT: the length of the wall lies in the plane')
    wall%along = [deck%real(third, 'XHEV'), deck%real(third, 'YHEV')] - wall%point(:2)
    call make_unit(deck, third, 'XHEV', 'expected a point apart from T: the wall goes from '// &
        'T toward it', wall%along)
    if (abs(dot_product(wall%along, wall%normal(:2))) > upright) then
      call deck%complain(third, 'XHEV', 'expected a point of the wall: its line from T is '// &
          'at right angles to the normal TH')
      return
    end if
    associate (n => wall%normal)
      wall%along = sign(1.0_wp, wall%along(1)*n(2) - wall%along(2)*n(1))*[n(2), -n(1)]
    end associate
  end subroutine read_ends

  subroutine read_mass(deck, model, record, wall)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    integer, intent(in) :: record
    type(wall_t), intent(inout) :: wall
    wall%shape = 'FLAT'
    wall%mass = deck%real(record, 'MASS')
    wall%speed = deck%real(record, 'V0')
    if (model%is_axisymmetric .and. abs(wall%normal(1)) > zero) call deck%complain(record, &
        'MASS', 'expected a normal along y: around an axis a free wall moves along it')
    if (model%controls%is_static .or. model%controls%static_until > zero) call deck%complain( &
        record, 'MASS', 'a wall that moves freely has no place in statics', &
        'use *RIGIDWALL_PLANAR, or *RIGIDWALL_GEOMETRIC_FLAT_MOTION')
  end subroutine read_mass

  subroutine read_motion(deck, model, maps, record, wall)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record
    type(wall_t), intent(inout) :: wall
    wall%curve = curve_of(deck, model, maps, record)
    wall%motion = merge(motion_displacement, motion_velocity, deck%integer(record, 'OPT') == 1)
    wall%direction = [deck%real(record, 'VX'), deck%real(record, 'VY'), deck%real(record, 'VZ')]
    call make_unit(deck, record, 'VX', 'expected a direction: all its components are zero', &
        wall%direction)
    if (wall%curve == 0 .or. wall%motion /= motion_displacement) return
    if (abs(curve_value(model%curve(wall%curve), zero)) > zero) call deck%complain(record, &
        'LCID', 'expected a curve that is 0 at t = 0: there the wall is where its card says')
  end subroutine read_motion

  !> A node for every wall but those planes that never move; after those of the mesh, so that
  !> sets and tables do not know them.
  subroutine add_bodies(model)
    type(model_t), intent(inout) :: model
    integer :: k, n
    n = count(model%wall%shape /= 'WALL')
    if (n == 0) return
    model%bodies = n
    model%node_id = [model%node_id, [(0, k=1, n)]]
    associate (dim => model%dim, m => model%nodes + n)
      model%x = reshape([model%x, [(zero, k=1, dim*n)]], [dim, m])
      model%v0 = reshape([model%v0, [(zero, k=1, dim*n)]], [dim, m])
      model%fixed = reshape([model%fixed, [(.true., k=1, dim*n)]], [dim, m])
    end associate
    do k = 1, size(model%wall)
      if (model%wall(k)%shape == 'WALL') cycle
      model%nodes = model%nodes + 1
      model%wall(k)%node = model%nodes
      model%x(:, model%nodes) = model%wall(k)%point(:model%dim)
      call move_wall(model, model%wall(k))
    end do
  end subroutine add_bodies

  !> How the node of a wall moves: freely, by a curve, or not at all.
  subroutine move_wall(model, wall)
    type(model_t), intent(inout) :: model
    type(wall_t), intent(in) :: wall
    type(motion_t) :: motion
    real(wp) :: speed
    integer :: d
    if (wall%mass > zero) then
      model%fixed(:, wall%node) = .false.
      model%v0(:, wall%node) = wall%speed*wall%normal(:model%dim)
    end if
    if (wall%curve == 0) return
    speed = curve_slope(model%curve(wall%curve), zero)
    if (wall%motion == motion_velocity) speed = curve_value(model%curve(wall%curve), zero)
    model%v0(:, wall%node) = speed*wall%direction(:model%dim)
    motion%node = [wall%node]
    motion%kind = wall%motion
    motion%curve = wall%curve
    motion%record = wall%record
    do d = 1, model%dim
      if (.not. abs(wall%direction(d)) > zero) cycle
      motion%direction = d
      motion%factor = wall%direction(d)
      model%motion = [model%motion, motion]
    end do
  end subroutine move_wall

end module scene_walls
