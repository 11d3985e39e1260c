! SPDX-License-Identifier: BSD-3-Clause
!> Keywords of rigid walls.
module deck_keywords_wall
  use deck_table, only: table_t, add_keyword, add_card, add_field
  implicit none
  private

  !> All of them; walls are numbered by their order in the deck, whatever their shape.
  character(44), parameter, public :: wall_keyword(8) = [character(44) :: &
      'RIGIDWALL_PLANAR', &
      'RIGIDWALL_PLANAR_MOVING', 'RIGIDWALL_GEOMETRIC_FLAT', &
      'RIGIDWALL_GEOMETRIC_FLAT_MOTION', &
      'RIGIDWALL_GEOMETRIC_CYLINDER', 'RIGIDWALL_GEOMETRIC_CYLINDER_MOTION', &
      'RIGIDWALL_GEOMETRIC_CYLINDER_INTERIOR', &
      'RIGIDWALL_GEOMETRIC_CYLINDER_INTERIOR_MOTION']
  character(*), parameter :: wall_help(8) = [character(64) :: &
      'a rigid plane that does not move', &
      'a rigid plane with a mass, free to move along its normal', &
      'a rigid flat wall, with ends or without', 'the same, moved by a curve', &
      'a rigid disc: a cylinder along z', 'the same, moved by a curve', &
      'a rigid bowl: the inside of a cylinder along z', 'the same, moved by a curve']

  public :: add_wall_keywords

contains

  !> Adds the walls of plane models.
  subroutine add_wall_keywords(table)
    type(table_t), intent(inout) :: table
    logical :: is_geometric, moves
    integer :: k
    do k = 1, size(wall_keyword)
      is_geometric = index(wall_keyword(k), '_GEOMETRIC_') > 0
      moves = index(wall_keyword(k), '_MOTION') + index(wall_keyword(k), '_MOVING') > 0
      call add_keyword(table, trim(wall_keyword(k)), trim(wall_help(k)), id=.true., &
          title_is_id=.true., required=2 + merge(1, 0, is_geometric) + merge(1, 0, moves))
      call add_nodes(table, is_geometric)
      call add_place(table, is_geometric, index(wall_keyword(k), 'CYLINDER') > 0)
      if (index(wall_keyword(k), '_FLAT') > 0) call add_ends(table)
      if (index(wall_keyword(k), '_CYLINDER') > 0) call add_radius(table)
      if (index(wall_keyword(k), '_MOTION') > 0) call add_motion(table)
      if (index(wall_keyword(k), '_MOVING') > 0) call add_mass(table)
    end do
  end subroutine add_wall_keywords

  subroutine add_nodes(table, is_geometric)
    type(table_t), intent(inout) :: table
    logical, intent(in) :: is_geometric
    call add_card(table)
    call add_field(table, 'NSID', 'I10 =0 >=0', 'node set in front of the wall; 0 = all nodes')
    call add_field(table, 'NSIDEX', 'I10 fixed')
    call add_field(table, 'BOXID', 'I10 fixed')
    if (.not. is_geometric) &
        call add_field(table, 'OFFSET', 'R10 fixed', 'the node set says which nodes')
    call add_field(table, 'BIRTH', 'R10 =0.0 [T]', 'the wall is there from this time')
    call add_field(table, 'DEATH', 'R10 =1.0E20 0=d [T]', 'to this time')
    if (.not. is_geometric) &
        call add_field(table, 'RWKSF', 'R10 note =1.0 0=d', 'of penalty methods')
  end subroutine add_nodes

  subroutine add_place(table, is_geometric, is_cylinder)
    type(table_t), intent(inout) :: table
    logical, intent(in) :: is_geometric, is_cylinder
    call add_card(table)
    if (is_cylinder) then
      call add_field(table, 'XT', 'R10 =0.0 [L]', 'a point T on the axis')
      call add_field(table, 'YT', 'R10 =0.0 [L]', 'the same')
      call add_field(table, 'ZT', 'R10 =0.0 [L]', 'below ZH')
      call add_field(table, 'XH', 'R10 =0.0 [L]', 'the same as XT: the axis is along z')
      call add_field(table, 'YH', 'R10 =0.0 [L]', 'the same as YT')
      call add_field(table, 'ZH', 'R10 =0.0 [L]', 'above ZT')
    else
      call add_field(table, 'XT', 'R10 =0.0 [L]', 'a point T on the wall')
      call add_field(table, 'YT', 'R10 =0.0 [L]', 'the same')
      call add_field(table, 'ZT', 'R10 =0.0 [L]', 'the same')
      call add_field(table, 'XH', 'R10 =0.0 [L]', 'a point H in front of it: the normal is TH')
      call add_field(table, 'YH', 'R10 =0.0 [L]', 'the same')
      call add_field(table, 'ZH', 'R10 =0.0 [L]', 'the same as ZT in a plane model')
    end if
    call add_field(table, 'FRIC', 'R10 =0.0 >=0 <=1', &
        'coefficient of friction mu; 1 = no sliding (mu = 1e6)')
    if (.not. is_geometric) &
        call add_field(table, 'WVEL', 'R10 fixed', 'the mass gives the velocity')
  end subroutine add_place

  subroutine add_ends(table)
    type(table_t), intent(inout) :: table
    call add_card(table)
    call add_field(table, 'XHEV', 'R10 =0.0 [L]', 'a point of the line from the end T along it')
    call add_field(table, 'YHEV', 'R10 =0.0 [L]', 'the same')
    call add_field(table, 'ZHEV', 'R10 =0.0 [L]', 'the same as ZT')
    call add_field(table, 'LENL', 'R10 =0.0 >=0 [L]', 'length from T; 0 = without ends')
    call add_field(table, 'LENM', 'R10 fixed', 'extent along z')
  end subroutine add_ends

  subroutine add_radius(table)
    type(table_t), intent(inout) :: table
    call add_card(table)
    call add_field(table, 'RADCYL', 'R10 req >0 [L]', 'radius')
    call add_field(table, 'LENCYL', 'R10 fixed', 'extent along z')
    call add_field(table, 'NSEGS', 'I10 fixed', 'parts of the axis')
  end subroutine add_radius

  subroutine add_motion(table)
    type(table_t), intent(inout) :: table
    call add_card(table)
    call add_field(table, 'LCID', 'I10 req >0', 'curve of the motion')
    call add_field(table, 'OPT', 'I10 =0 >=0 <=1', '0 velocity, 1 displacement')
    call add_field(table, 'VX', 'R10 =0.0', 'direction of the motion, of any length')
    call add_field(table, 'VY', 'R10 =0.0', 'the same')
    call add_field(table, 'VZ', 'R10 space =0.0', 'the same')
  end subroutine add_motion

  subroutine add_mass(table)
    type(table_t), intent(inout) :: table
    call add_card(table)
    call add_field(table, 'MASS', 'R10 req >0 [M]', 'of the wall')
    call add_field(table, 'V0', 'R10 =0.0 [L/T]', 'its velocity at t = 0, along the normal')
  end subroutine add_mass

end module deck_keywords_wall
