! SPDX-License-Identifier: BSD-3-Clause
!> The keywords that this version reads: the one place that knows their cards, columns, units
!> (as dimensions), defaults and ranges.
module deck_keywords
  use deck_table, only: table_t, add_keyword, add_card, add_field, keyword_skipped, &
      keyword_refused
  use deck_keywords_own, only: add_own_keywords
  implicit none
  private
  public :: fill_table

contains

  !> Fills the table of keywords.
  subroutine fill_table(table)
    type(table_t), intent(inout) :: table
    call add_frame(table)
    call add_mesh(table)
    call add_sets(table)
    call add_motion(table)
    call add_contact(table)
    call add_output(table)
    call add_own_keywords(table)
    call add_skipped(table)
    call add_refused(table)
  end subroutine fill_table

  subroutine add_frame(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'KEYWORD', 'start of a deck')
    call add_keyword(table, 'TITLE', 'title of the run', required=1)
    call add_card(table)
    call add_field(table, 'TITLE', 'T80', 'any text')
    call add_keyword(table, 'CONTROL_TERMINATION', 'end of the run', required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'ENDTIM', 'R10 req [T] >0', 'end time')
    call add_field(table, 'ENDCYC', 'I10 =0 >=0', 'last step; 0 = no limit')
    call add_field(table, 'DTMIN', 'R10 fixed')
    call add_field(table, 'ENDENG', 'R10 fixed')
    call add_field(table, 'ENDMAS', 'R10 note')
    call add_field(table, 'NOSOL', 'I10 fixed')
    call add_keyword(table, 'CONTROL_IMPLICIT_GENERAL', 'implicit integration and its step', &
        required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'IMFLAG', 'I10 req >=0', '1 = implicit; nothing else is available')
    call add_field(table, 'DT0', 'R10 req [T] >0', 'time step')
    call add_field(table, 'IMFORM', 'I10 note')
    call add_field(table, 'NSBS', 'I10 fixed')
    call add_field(table, 'IGS', 'I10 fixed')
    call add_field(table, 'CNSTN', 'I10 fixed')
    call add_field(table, 'FORM', 'I10 fixed')
    call add_field(table, 'ZERO_V', 'I10 fixed')
    call add_keyword(table, 'CONTROL_IMPLICIT_DYNAMICS', &
        'inertia, and gamma and beta of NEWMARK', required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'IMASS', 'I10 =0 >=0 <=1', &
        '1 = with inertia; 0 (static) is not available')
    call add_field(table, 'GAMMA', 'R10 =0.5 >=0.5 <=1', 'gamma of NEWMARK')
    call add_field(table, 'BETA', 'R10 =0.25 >=0 <=1', &
        'beta of NEWMARK, at least (gamma+1/2)^2/4')
    call add_field(table, 'TDYBIR', 'R10 fixed [T]')
    call add_field(table, 'TDYDTH', 'R10 fixed [T] =1.0E28')
    call add_field(table, 'TDYBUR', 'R10 fixed [T] =1.0E28')
    call add_field(table, 'IRATE', 'I10 fixed')
    call add_field(table, 'ALPHA', 'R10 fixed')
    call add_keyword(table, 'CONTROL_IMPLICIT_SOLUTION', 'linear or not', required=1, &
        once=.true.)
    call add_card(table)
    call add_field(table, 'NSOLVR', 'I10 =1 fixed', '1 = linear; 12 is not available')
    call add_field(table, 'ILIMIT', 'I10 note')
    call add_field(table, 'MAXREF', 'I10 note')
    call add_field(table, 'DCTOL', 'R10 note')
    call add_field(table, 'ECTOL', 'R10 note')
    call add_field(table, 'RCTOL', 'R10 note')
    call add_field(table, 'LSTOL', 'R10 note')
    call add_field(table, 'ABSTOL', 'R10 note')
  end subroutine add_frame

  subroutine add_mesh(table)
    type(table_t), intent(inout) :: table
    integer :: k
    call add_keyword(table, 'NODE', 'nodes', repeat_from=1)
    call add_card(table)
    call add_field(table, 'NID', 'I8 req >0', 'node number')
    call add_field(table, 'X', 'R16 =0.0 [L]', 'coordinate')
    call add_field(table, 'Y', 'R16 =0.0 [L]', 'coordinate')
    call add_field(table, 'Z', 'R16 =0.0 [L]', 'the same for all nodes of a plane model')
    call add_field(table, 'TC', 'I8 fixed', 'use *BOUNDARY_SPC')
    call add_field(table, 'RC', 'I8 fixed')
    call add_keyword(table, 'ELEMENT_SHELL', 'plane elements, counter-clockwise', repeat_from=1)
    call add_card(table)
    call add_field(table, 'EID', 'I8 req >0', 'element number')
    call add_field(table, 'PID', 'I8 req >0', 'part')
    call add_field(table, 'N1', 'I8 req >0', 'node')
    call add_field(table, 'N2', 'I8 req >0', 'node')
    call add_field(table, 'N3', 'I8 req >0', 'node')
    call add_field(table, 'N4', 'I8 =0 >=0', 'node; triangles are not available')
    do k = 5, 8
      call add_field(table, 'N'//achar(48 + k), 'I8 fixed')
    end do
    call add_keyword(table, 'PART', 'a body: section and material', repeat_from=1, required=2)
    call add_card(table)
    call add_field(table, 'HEADING', 'T70', 'any text')
    call add_card(table)
    call add_field(table, 'PID', 'I10 req >0', 'part number')
    call add_field(table, 'SECID', 'I10 req >0', 'section')
    call add_field(table, 'MID', 'I10 req >0', 'material')
    call add_field(table, 'EOSID', 'I10 fixed')
    call add_field(table, 'HGID', 'I10 fixed')
    call add_field(table, 'GRAV', 'I10 fixed')
    call add_field(table, 'ADPOPT', 'I10 fixed')
    call add_field(table, 'TMID', 'I10 fixed')
    call add_keyword(table, 'SECTION_SHELL', 'plane strain or stress, thickness', &
        title=.true., repeat_from=1, required=1)
    call add_card(table)
    call add_field(table, 'SECID', 'I10 req >0', 'section number')
    call add_field(table, 'ELFORM', 'I10 =2', '12 plane stress, 13 plane strain')
    call add_field(table, 'SHRF', 'R10 note')
    call add_field(table, 'NIP', 'I10 =4', '4 = 2 x 2 Gauss points, which blank means here too')
    call add_field(table, 'PROPT', 'R10 note')
    call add_field(table, 'QR/IRID', 'R10 fixed')
    call add_field(table, 'ICOMP', 'I10 fixed')
    call add_field(table, 'SETYP', 'I10 note')
    call add_card(table)
    call add_field(table, 'T1', 'R10 =1.0 0=d [L] >=0', 'thickness')
    call add_field(table, 'T2', 'R10 [L]', 'equal to T1 or blank')
    call add_field(table, 'T3', 'R10 [L]', 'equal to T1 or blank')
    call add_field(table, 'T4', 'R10 [L]', 'equal to T1 or blank')
    call add_field(table, 'NLOC', 'R10 fixed')
    call add_field(table, 'MAREA', 'R10 note')
    call add_field(table, 'IDOF', 'R10 fixed')
    call add_field(table, 'EDGSET', 'I10 fixed')
    call add_keyword(table, 'MAT_ELASTIC', 'linear elastic material', title=.true., required=1)
    call add_card(table)
    call add_field(table, 'MID', 'I10 req >0', 'material number')
    call add_field(table, 'RO', 'R10 req [M/L3] >0', 'density')
    call add_field(table, 'E', 'R10 req [F/L2] >0', 'Young modulus')
    call add_field(table, 'PR', 'R10 =0.0 >-1 <0.5', 'Poisson ratio')
    call add_field(table, 'DA', 'R10 fixed')
    call add_field(table, 'DB', 'R10 fixed')
    call add_keyword(table, 'MAT_001', 'the same as *MAT_ELASTIC', title=.true., required=1)
    table%keyword(table%n)%card = table%keyword(table%n - 1)%card
    table%keyword(table%n)%cards = table%keyword(table%n - 1)%cards
  end subroutine add_mesh

  subroutine add_sets(table)
    type(table_t), intent(inout) :: table
    call add_set(table, 'SET_NODE_LIST', 'NID', 'node')
    call add_set(table, 'SET_NODE', 'NID', 'node')
    call add_set(table, 'SET_PART_LIST', 'PID', 'part')
    call add_set(table, 'SET_PART', 'PID', 'part')
  end subroutine add_sets

  subroutine add_set(table, name, member, what)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, member, what
    integer :: k
    call add_keyword(table, name, what//' set', title=.true., required=2, repeat_from=2)
    call add_card(table)
    call add_field(table, 'SID', 'I10 req >0', 'set number')
    do k = 1, 4
      call add_field(table, 'DA'//achar(48 + k), 'R10 fixed')
    end do
    call add_field(table, 'SOLVER', 'W10 fixed =MECH')
    call add_field(table, 'ITS', 'W10 fixed')
    call add_card(table)
    do k = 1, 8
      call add_field(table, member//achar(48 + k), 'I10 =0 >=0', what//'; zeros are padding')
    end do
  end subroutine add_set

  subroutine add_motion(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'INITIAL_VELOCITY', 'initial velocity of a node set', required=2)
    call add_card(table)
    call add_field(table, 'NSID', 'I10 =0 >=0', 'node set; 0 = all nodes')
    call add_field(table, 'NSIDEX', 'I10 fixed')
    call add_field(table, 'BOXID', 'I10 fixed')
    call add_field(table, 'IRIGID', 'I10 fixed')
    call add_field(table, 'ICID', 'I10 fixed')
    call add_card(table)
    call add_velocity(table, '10')
    call add_keyword(table, 'INITIAL_VELOCITY_NODE', 'initial velocities of nodes', &
        repeat_from=1)
    call add_card(table)
    call add_field(table, 'NID', 'I10 req >0', 'node')
    call add_velocity(table, '10')
    call add_field(table, 'ICID', 'I10 fixed')
    call add_keyword(table, 'INITIAL_VELOCITY_GENERATION', &
        'initial velocity of parts or nodes', required=2)
    call add_card(table)
    call add_field(table, 'ID', 'I10 =0 >=0', 'part set, part or node set by STYP; 0 = all')
    call add_field(table, 'STYP', 'I10 =1 >=1 <=3', '1 part set, 2 part, 3 node set')
    call add_field(table, 'OMEGA', 'R10 =0.0 [1/T]', 'angular velocity about z through XC, YC')
    call add_field(table, 'VX', 'R10 =0.0 [L/T]', 'velocity')
    call add_field(table, 'VY', 'R10 =0.0 [L/T]', 'velocity')
    call add_field(table, 'VZ', 'R10 fixed [L/T]')
    call add_field(table, 'IVATN', 'I10 note')
    call add_field(table, 'ICID', 'I10 fixed')
    call add_card(table)
    call add_field(table, 'XC', 'R10 =0.0 [L]', 'centre of rotation')
    call add_field(table, 'YC', 'R10 =0.0 [L]', 'centre of rotation')
    call add_field(table, 'ZC', 'R10 ignored [L]')
    call add_field(table, 'NX', 'R10 fixed')
    call add_field(table, 'NY', 'R10 fixed')
    call add_field(table, 'NZ', 'R10 ignored', 'the axis is z; blank or 1')
    call add_field(table, 'PHASE', 'I10 fixed')
    call add_field(table, 'IRIGID', 'I10 fixed')
    call add_support(table, 'BOUNDARY_SPC_SET', 'NSID', 'node set')
    call add_support(table, 'BOUNDARY_SPC_NODE', 'NID', 'node')
    call add_load(table, 'LOAD_NODE_SET', 'NSID', 'node set')
    call add_load(table, 'LOAD_NODE_POINT', 'NID', 'node')
    call add_body_load(table, 'LOAD_BODY_X')
    call add_body_load(table, 'LOAD_BODY_Y')
    call add_keyword(table, 'DEFINE_CURVE', 'a function of time by points', title=.true., &
        required=2, repeat_from=2)
    call add_card(table)
    call add_field(table, 'LCID', 'I10 req >0', 'curve number')
    call add_field(table, 'SIDR', 'I10 fixed')
    call add_field(table, 'SFA', 'R10 =1.0 0=d', 'scale of the abscissa')
    call add_field(table, 'SFO', 'R10 =1.0 0=d', 'scale of the ordinate')
    call add_field(table, 'OFFA', 'R10 =0.0', 'offset of the abscissa')
    call add_field(table, 'OFFO', 'R10 =0.0', 'offset of the ordinate')
    call add_field(table, 'DATTYP', 'I10 fixed')
    call add_field(table, 'LCINT', 'I10 note')
    call add_card(table)
    call add_field(table, 'A', 'R20 =0.0', 'abscissa, increasing')
    call add_field(table, 'O', 'R20 =0.0', 'ordinate')
  end subroutine add_motion

  subroutine add_velocity(table, width)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: width
    call add_field(table, 'VX', 'R'//width//' =0.0 [L/T]', 'velocity')
    call add_field(table, 'VY', 'R'//width//' =0.0 [L/T]', 'velocity')
    call add_field(table, 'VZ', 'R'//width//' fixed [L/T]')
    call add_field(table, 'VXR', 'R'//width//' fixed')
    call add_field(table, 'VYR', 'R'//width//' fixed')
    call add_field(table, 'VZR', 'R'//width//' fixed')
  end subroutine add_velocity

  subroutine add_support(table, name, id, what)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, id, what
    call add_keyword(table, name, 'fixed directions of a '//what, repeat_from=1, id=.true.)
    call add_card(table)
    call add_field(table, id, 'I10 req >0', what)
    call add_field(table, 'CID', 'I10 fixed')
    call add_field(table, 'DOFX', 'I10 =0 >=0 <=1', '1 = fixed')
    call add_field(table, 'DOFY', 'I10 =0 >=0 <=1', '1 = fixed')
    call add_field(table, 'DOFZ', 'I10 ignored >=0 <=1')
    call add_field(table, 'DOFRX', 'I10 ignored >=0 <=1')
    call add_field(table, 'DOFRY', 'I10 ignored >=0 <=1')
    call add_field(table, 'DOFRZ', 'I10 ignored >=0 <=1')
  end subroutine add_support

  subroutine add_load(table, name, id, what)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, id, what
    call add_keyword(table, name, 'force on every node of a '//what, repeat_from=1)
    call add_card(table)
    call add_field(table, id, 'I10 req >0', what)
    call add_field(table, 'DOF', 'I10 req >=1 <=2', '1 = x, 2 = y')
    call add_field(table, 'LCID', 'I10 req >0', 'curve of the force [F] over time')
    call add_field(table, 'SF', 'R10 =1.0', 'factor of the curve')
    call add_field(table, 'CID', 'I10 fixed')
    call add_field(table, 'M1', 'I10 fixed')
    call add_field(table, 'M2', 'I10 fixed')
    call add_field(table, 'M3', 'I10 fixed')
  end subroutine add_load

  subroutine add_body_load(table, name)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name
    call add_keyword(table, name, &
        'body load: acceleration = - SF * curve, on all parts', required=1)
    call add_card(table)
    call add_field(table, 'LCID', 'I10 req >0', 'curve of the base acceleration [L/T2]')
    call add_field(table, 'SF', 'R10 =1.0', 'factor of the curve')
    call add_field(table, 'LCIDDR', 'I10 fixed')
    call add_field(table, 'XC', 'R10 fixed')
    call add_field(table, 'YC', 'R10 fixed')
    call add_field(table, 'ZC', 'R10 fixed')
    call add_field(table, 'CID', 'I10 fixed')
  end subroutine add_body_load

  subroutine add_contact(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE', &
        'contact of two bodies', id=.true., required=1)
    call add_card(table)
    call add_field(table, 'SURFA', 'I10 req', 'part set; < 0: node set')
    call add_field(table, 'SURFB', 'I10 req', 'part set; < 0: node set')
    call add_field(table, 'SFACT', 'R10 note')
    call add_field(table, 'FREQ', 'I10 note')
    call add_field(table, 'FS', 'R10 =0.0 >=0', 'coefficient of friction mu')
    call add_field(table, 'FD', 'R10 =0.0 >=0', 'has no effect while DC = 0')
    call add_field(table, 'DC', 'R10 fixed')
    call add_card(table)
    call add_field(table, 'TBIRTH', 'R10 =0.0 [T]', 'contact is active from this time')
    call add_field(table, 'TDEATH', 'R10 =1.0E20 0=d [T]', 'to this time')
    call add_field(table, 'SOA', 'R10 note')
    call add_field(table, 'SOB', 'R10 note')
    call add_field(table, 'NDA', 'I10 note')
    call add_field(table, 'NDB', 'I10 note')
    call add_field(table, 'COF', 'I10 note')
    call add_field(table, 'INIT', 'I10 fixed')
    call add_card(table)
    call add_field(table, 'VC', 'R10 fixed')
    call add_field(table, 'VDC', 'R10 note')
    call add_field(table, 'IPF', 'I10 fixed')
    call add_field(table, 'SLIDE', 'I10 fixed')
    call add_field(table, 'ISTIFF', 'I10 note')
    call add_field(table, 'TIEDGAP', 'R10 fixed')
    call add_field(table, 'IGAPCL', 'I10 fixed')
    call add_field(table, 'TIETYP', 'I10 fixed')
    call add_card(table)
    call add_field(table, 'SLDSOA', 'R10 fixed')
    call add_field(table, 'SLDSOB', 'R10 fixed')
    call add_field(table, 'TDPEN', 'R10 note')
  end subroutine add_contact

  subroutine add_output(table)
    type(table_t), intent(inout) :: table
    character(7), parameter :: names(6) = ['GLSTAT ', 'MATSUM ', 'NODOUT ', 'RCFORC ', &
      'SLEOUT ', &
                                           'SPCFORC']
    integer :: k, m
    do k = 1, 5
      call add_keyword(table, 'DATABASE_'//trim(names(k)), 'table '//trim(names(k)), &
          required=1, once=.true.)
      call add_card(table)
      call add_field(table, 'DT', 'R10 =0.0 [T] >=0', 'interval; 0 = off')
      call add_field(table, 'BINARY', 'I10 note')
      call add_field(table, 'LCUR', 'I10 fixed')
      call add_field(table, 'IOOPT', 'I10 note')
    end do
    call add_keyword(table, 'DATABASE_HISTORY_NODE', 'nodes of NODOUT', &
        repeat_from=1, required=1)
    call add_card(table)
    do m = 1, 8
      call add_field(table, 'ID'//achar(48 + m), 'I10 =0 >=0', 'node')
    end do
    call add_keyword(table, 'DATABASE_HISTORY_NODE_SET', 'node sets of NODOUT', &
        repeat_from=1, required=1)
    call add_card(table)
    do m = 1, 8
      call add_field(table, 'ID'//achar(48 + m), 'I10 =0 >=0', 'node set')
    end do
  end subroutine add_output

  !> Keywords that cannot change our solution.
  subroutine add_skipped(table)
    type(table_t), intent(inout) :: table
    character(24), parameter :: names(12) = [character(24) :: 'COMMENT', 'CONTROL_ENERGY', &
      'CONTROL_OUTPUT', 'CONTROL_CPU', 'CONTROL_SHELL', 'CONTROL_HOURGLASS', 'HOURGLASS', &
      'CONTROL_IMPLICIT_SOLVER', 'DATABASE_BINARY_D3PLOT', 'DATABASE_BINARY_D3THDT', &
      'DATABASE_EXTENT_BINARY', 'DATABASE_FORMAT']
    integer :: k
    do k = 1, size(names)
      call add_keyword(table, trim(names(k)), 'skipped with a note', class=keyword_skipped)
    end do
  end subroutine add_skipped

  !> Keywords that are known, and refused by name rather than called unknown.
  subroutine add_refused(table)
    type(table_t), intent(inout) :: table
    character(44), parameter :: names(24) = [character(44) :: 'ELEMENT_SOLID', 'ELEMENT_BEAM', &
      'SECTION_SOLID', 'MAT_RIGID', 'MAT_BLATZ-KO_RUBBER', 'MAT_MOONEY-RIVLIN_RUBBER', &
      'MAT_PLASTIC_KINEMATIC', 'MAT_PIECEWISE_LINEAR_PLASTICITY', 'SET_SEGMENT', &
      'BOUNDARY_PRESCRIBED_MOTION_SET', 'BOUNDARY_PRESCRIBED_MOTION_NODE', 'LOAD_SEGMENT', &
      'LOAD_SEGMENT_SET', 'DAMPING_GLOBAL', 'DAMPING_PART_STIFFNESS', 'RIGIDWALL_PLANAR', &
      'CONTACT_2D_AUTOMATIC_SINGLE_SURFACE', 'CONTACT_2D_AUTOMATIC_NODE_TO_SURFACE', &
      'DATABASE_ELOUT', 'DATABASE_RWFORC', 'DATABASE_SPCFORC', 'DATABASE_NCFORC', &
      'LOAD_BODY_Z', 'PARAMETER_EXPRESSION']
    integer :: k
    do k = 1, size(names)
      call add_keyword(table, trim(names(k)), 'not available in this version', &
          class=keyword_refused)
    end do
  end subroutine add_refused

end module deck_keywords
