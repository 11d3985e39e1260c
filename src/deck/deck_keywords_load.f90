! SPDX-License-Identifier: BSD-3-Clause
!> Keywords of motion and load: initial velocities, supports, prescribed motions, loads,
!> damping, curves.
module deck_keywords_load
  use deck_keywords_mesh, only: add_segment_nodes
  use deck_table, only: table_t, add_keyword, add_card, add_field
  implicit none
  private
  public :: add_load_keywords

contains

  !> Adds the rows of motions and loads.
  subroutine add_load_keywords(table)
    type(table_t), intent(inout) :: table
    call add_initial_velocities(table)
    call add_generation(table)
    call add_support(table, 'BOUNDARY_SPC_SET', 'NSID', 'node set')
    call add_support(table, 'BOUNDARY_SPC_NODE', 'NID', 'node')
    call add_motion(table, 'BOUNDARY_PRESCRIBED_MOTION_SET', 'NSID', 'node set')
    call add_motion(table, 'BOUNDARY_PRESCRIBED_MOTION_NODE', 'NID', 'node')
    call add_load(table, 'LOAD_NODE_SET', 'NSID', 'node set', 'a force on each node of a set')
    call add_load(table, 'LOAD_NODE_POINT', 'NID', 'node', 'a force on a node')
    call add_rigid_parts(table)
    call add_segment_loads(table)
    call add_body_load(table, 'LOAD_BODY_X')
    call add_body_load(table, 'LOAD_BODY_Y')
    call add_body_load(table, 'LOAD_BODY_Z')
    call add_damping(table)
    call add_part_damping(table, '', 'PID', 'part')
    call add_part_damping(table, '_SET', 'PSID', 'part set')
    call add_curve(table)
  end subroutine add_load_keywords

  subroutine add_initial_velocities(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'INITIAL_VELOCITY', 'initial velocity of a node set', required=2)
    call add_card(table)
    call add_field(table, 'NSID', 'I10 =0 >=0', 'node set; 0 = all nodes')
    call add_field(table, 'NSIDEX', 'I10 fixed')
    call add_field(table, 'BOXID', 'I10 fixed')
    call add_field(table, 'IRIGID', 'I10 fixed')
    call add_field(table, 'ICID', 'I10 fixed')
    call add_card(table)
    call add_velocity(table)
    call add_keyword(table, 'INITIAL_VELOCITY_NODE', 'initial velocities of nodes', &
        repeat_from=1)
    call add_card(table)
    call add_field(table, 'NID', 'I10 req >0', 'node')
    call add_velocity(table)
    call add_field(table, 'ICID', 'I10 fixed')
  end subroutine add_initial_velocities

  subroutine add_velocity(table)
    type(table_t), intent(inout) :: table
    call add_field(table, 'VX', 'R10 =0.0 [L/T]', 'velocity')
    call add_field(table, 'VY', 'R10 =0.0 [L/T]', 'velocity')
    call add_field(table, 'VZ', 'R10 space [L/T]', 'velocity; a plane model has none')
    call add_field(table, 'VXR', 'R10 fixed')
    call add_field(table, 'VYR', 'R10 fixed')
    call add_field(table, 'VZR', 'R10 fixed')
  end subroutine add_velocity

  subroutine add_generation(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'INITIAL_VELOCITY_GENERATION', &
        'initial velocity of parts or nodes', required=2)
    call add_card(table)
    call add_field(table, 'ID', 'I10 =0 >=0', 'part set, part or node set by STYP; 0 = all')
    call add_field(table, 'STYP', 'I10 =1 0=d >=1 <=3', '1 part set, 2 part, 3 node set')
    call add_field(table, 'OMEGA', 'R10 =0.0 [1/T]', 'angular velocity about the axis')
    call add_field(table, 'VX', 'R10 =0.0 [L/T]', 'velocity')
    call add_field(table, 'VY', 'R10 =0.0 [L/T]', 'velocity')
    call add_field(table, 'VZ', 'R10 space [L/T]', 'velocity; a plane model has none')
    call add_field(table, 'IVATN', 'I10 note', 'of rigid parts')
    call add_field(table, 'ICID', 'I10 fixed')
    call add_card(table)
    call add_field(table, 'XC', 'R10 =0.0 [L]', 'centre of rotation')
    call add_field(table, 'YC', 'R10 =0.0 [L]', 'centre of rotation')
    call add_field(table, 'ZC', 'R10 [L]', 'centre of rotation')
    call add_field(table, 'NX', 'R10 space', 'direction of the axis; plane: z')
    call add_field(table, 'NY', 'R10 space', 'direction of the axis; plane: z')
    call add_field(table, 'NZ', 'R10', &
        'direction of the axis, 0 = 1 where NX and NY are 0; plane: 1 or -1')
    call add_field(table, 'PHASE', 'I10 fixed')
    call add_field(table, 'IRIGID', 'I10 fixed')
  end subroutine add_generation

  subroutine add_support(table, name, id, what)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, id, what
    call add_keyword(table, name, 'fixed directions of a '//what, repeat_from=1, &
        id=.true., required=1)
    call add_card(table)
    call add_field(table, id, 'I10 req >0', what)
    call add_field(table, 'CID', 'I10 fixed')
    call add_field(table, 'DOFX', 'I10 =0 >=0 <=1', '1 = fixed')
    call add_field(table, 'DOFY', 'I10 =0 >=0 <=1', '1 = fixed')
    call add_field(table, 'DOFZ', 'I10 >=0 <=1', '1 = fixed; of no effect in the plane')
    call add_field(table, 'DOFRX', 'I10 ignored >=0 <=1')
    call add_field(table, 'DOFRY', 'I10 ignored >=0 <=1')
    call add_field(table, 'DOFRZ', 'I10 ignored >=0 <=1')
  end subroutine add_support

  subroutine add_motion(table, name, id, what)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, id, what
    call add_keyword(table, name, 'motion of a '//what//' by a curve', repeat_from=1, &
        id=.true., required=1)
    call add_card(table)
    call add_field(table, id, 'I10 req >0', what)
    call add_direction(table, id)
    call add_field(table, 'VAD', 'I10 =0 >=0 <=2', &
        '0 velocity, 1 acceleration (NEWMARK only), 2 displacement')
    call add_field(table, 'LCID', 'I10 req >0', 'curve over time')
    call add_field(table, 'SF', 'R10 =1.0 0=d', 'factor of the curve')
    call add_field(table, 'VID', 'I10 fixed')
    call add_field(table, 'DEATH', 'R10 =1.0E28 0=d [T] >0', 'free after this time')
    call add_field(table, 'BIRTH', 'R10 =0.0 [T] >=0', 'free before this time')
  end subroutine add_motion

  subroutine add_load(table, name, id, what, help)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, id, what, help
    call add_keyword(table, name, help, repeat_from=1, id=.true., required=1)
    call add_card(table)
    call add_field(table, id, 'I10 req >0', what)
    call add_direction(table, id)
    call add_field(table, 'LCID', 'I10 req >0', 'curve of the force [F] over time')
    call add_field(table, 'SF', 'R10 =1.0 0=d', 'factor of the curve')
    call add_field(table, 'CID', 'I10 fixed')
    call add_field(table, 'M1', 'I10 fixed')
    call add_field(table, 'M2', 'I10 fixed')
    call add_field(table, 'M3', 'I10 fixed')
  end subroutine add_load

  !> Parts turn, nodes do not.
  subroutine add_direction(table, id)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: id
    if (id == 'PID') then
      call add_field(table, 'DOF', 'I10 req >=1 <=7', '1 = x, 2 = y, 7 = rotation about z')
    else
      call add_field(table, 'DOF', 'I10 req >=1 <=3 plane<=2', '1 = x, 2 = y, 3 = z')
    end if
  end subroutine add_direction

  subroutine add_rigid_parts(table)
    type(table_t), intent(inout) :: table
    call add_motion(table, 'BOUNDARY_PRESCRIBED_MOTION_RIGID', 'PID', 'rigid part')
    call add_load(table, 'LOAD_RIGID_BODY', 'PID', 'rigid part', &
        'a force or moment on a rigid part')
    call add_keyword(table, 'INITIAL_VELOCITY_RIGID_BODY', &
        'initial velocities of rigid parts', repeat_from=1)
    call add_card(table)
    call add_field(table, 'PID', 'I10 req >0', 'rigid part')
    call add_field(table, 'VX', 'R10 =0.0 [L/T]', 'velocity of the centre of mass')
    call add_field(table, 'VY', 'R10 =0.0 [L/T]', 'velocity of the centre of mass')
    call add_field(table, 'VZ', 'R10 fixed [L/T]', 'the model is plane')
    call add_field(table, 'VXR', 'R10 fixed')
    call add_field(table, 'VYR', 'R10 fixed')
    call add_field(table, 'VZR', 'R10 =0.0 [1/T]', 'angular velocity')
    call add_field(table, 'ICID', 'I10 fixed')
    call add_keyword(table, 'CONSTRAINED_RIGID_BODIES', 'two rigid parts become one', &
        repeat_from=1)
    call add_card(table)
    call add_field(table, 'PIDL', 'I10 req >0', 'rigid part that the body is named after')
    call add_field(table, 'PIDC', 'I10 req >0', 'rigid part that joins it')
    call add_field(table, 'IFLAG', 'I10 fixed')
  end subroutine add_rigid_parts

  subroutine add_segment_loads(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'LOAD_SEGMENT_SET', 'pressure on a segment set', &
        repeat_from=1, id=.true., required=1)
    call add_card(table)
    call add_field(table, 'SSID', 'I10 req >0', 'segment set')
    call add_pressure(table)
    call add_keyword(table, 'LOAD_SEGMENT', 'pressure on a segment', repeat_from=1, &
        id=.true., required=1)
    call add_card(table)
    call add_pressure(table)
    call add_segment_nodes(table)
    call add_field(table, 'N5', 'I10 fixed', 'of quadratic edges')
  end subroutine add_segment_loads

  subroutine add_pressure(table)
    type(table_t), intent(inout) :: table
    call add_field(table, 'LCID', 'I10 req >0', &
        'curve of the pressure [F/L2] over time, positive toward the body')
    call add_field(table, 'SF', 'R10 =1.0 0=d', 'factor of the curve')
    call add_field(table, 'AT', 'R10 =0.0 [T] >=0', &
        'arrival time: no pressure before; the curve starts then')
  end subroutine add_pressure

  subroutine add_body_load(table, name)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name
    call add_keyword(table, name, &
        'body load: acceleration = - SF * curve, on all parts', required=1)
    call add_card(table)
    call add_field(table, 'LCID', 'I10 req >0', 'curve of the base acceleration [L/T2]')
    call add_field(table, 'SF', 'R10 =1.0 0=d', 'factor of the curve')
    call add_field(table, 'LCIDDR', 'I10 fixed')
    call add_field(table, 'XC', 'R10 fixed')
    call add_field(table, 'YC', 'R10 fixed')
    call add_field(table, 'ZC', 'R10 fixed')
    call add_field(table, 'CID', 'I10 fixed')
  end subroutine add_body_load

  subroutine add_damping(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'DAMPING_GLOBAL', 'damping by the mass of all parts', once=.true., &
        required=1)
    call add_card(table)
    call add_field(table, 'LCID', 'I10 =0 >=0', 'curve of the coefficient [1/T]; 0 = VALDMP')
    call add_field(table, 'VALDMP', 'R10 =0.0 [1/T] >=0', 'coefficient without a curve')
    call add_field(table, 'STX', 'R10 =0.0 >=0', 'scale in x; all scales 0 = all 1')
    call add_field(table, 'STY', 'R10 =0.0 >=0', 'scale in y')
    call add_field(table, 'STZ', 'R10', 'scale in z, in space')
    call add_field(table, 'SRX', 'R10 ignored')
    call add_field(table, 'SRY', 'R10 ignored')
    call add_field(table, 'SRZ', 'R10 ignored')
  end subroutine add_damping

  subroutine add_part_damping(table, option, id, what)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: option, id, what
    call add_keyword(table, 'DAMPING_PART_MASS'//option, 'damping by the mass of a '//what, &
        repeat_from=1, required=1)
    call add_card(table)
    call add_field(table, id, 'I10 req >0', what)
    call add_field(table, 'LCID', 'I10 req >0', 'curve of the coefficient [1/T] over time')
    call add_field(table, 'SF', 'R10 =1.0 0=d >0', 'factor of the curve')
    call add_field(table, 'FLAG', 'I10 fixed')
    call add_keyword(table, 'DAMPING_PART_STIFFNESS'//option, &
        'damping by the stiffness of a '//what, repeat_from=1, required=1)
    call add_card(table)
    call add_field(table, id, 'I10 req >0', what)
    call add_field(table, 'COEF', 'R10 =0.0 [T]', &
        '< 0: C = -COEF K of the part; 0 = none; > 0 is not available')
  end subroutine add_part_damping

  subroutine add_curve(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'DEFINE_CURVE', &
        'a function of time, or of plastic strain, by points', title=.true., required=2, &
        repeat_from=2)
    call add_card(table)
    call add_field(table, 'LCID', 'I10 req >0', 'curve number')
    call add_field(table, 'SIDR', 'I10 =0 >=0 <=2', &
        '0 or 2; 1 (dynamic relaxation alone) is not available')
    call add_field(table, 'SFA', 'R10 =1.0 0=d >0', 'scale of the abscissa')
    call add_field(table, 'SFO', 'R10 =1.0 0=d', 'scale of the ordinate')
    call add_field(table, 'OFFA', 'R10 =0.0', &
        'offset of the abscissa; > 0: the curve is 0 up to .999 OFFA')
    call add_field(table, 'OFFO', 'R10 =0.0', 'offset of the ordinate')
    call add_field(table, 'DATTYP', 'I10 fixed')
    call add_field(table, 'LCINT', 'I10 note', 'points of a resampled curve')
    call add_card(table)
    call add_field(table, 'A', 'R20 =0.0 [T]', 'abscissa, increasing')
    call add_field(table, 'O', 'R20 =0.0', 'ordinate; outside the range it is constant')
  end subroutine add_curve

end module deck_keywords_load
