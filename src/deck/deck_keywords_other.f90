! SPDX-License-Identifier: BSD-3-Clause
!> Keywords that are known but not available: refused by name rather than called unknown.
module deck_keywords_other
  use deck_table, only: table_t, keyword_length, add_keyword, keyword_refused
  implicit none
  private
  public :: add_refused_keywords

contains

  !> Adds what is refused. The families come last: a name of its own wins.
  subroutine add_refused_keywords(table)
    type(table_t), intent(inout) :: table
    character(16), parameter :: families(60) = [character(16) :: 'AIRBAG_*', 'ALE_*', &
        'BATTERY_*', 'BOUNDARY_*', 'CASE*', 'CESE_*', 'CHANGE_*', 'CHEMISTRY_*', &
        'COMPONENT_*', 'CONSTRAINED_*', 'CONTACT_*', 'CONTROLLER_*', 'CONTROL_*', 'DAMPING_*', &
        'DEFINE_*', 'DEFORMABLE_*', 'DELETE_*', 'DUALCESE_*', 'ELEMENT_*', 'EM_*', 'EOS_*', &
        'FATIGUE*', 'FREQUENCY_*', 'HOURGLASS_*', 'ICFD_*', 'IGA_*', 'INCLUDE_*', 'INITIAL_*', &
        'INTEGRATION_*', 'INTERFACE_*', 'ISPG_*', 'LOAD_*', 'LSO_*', 'MAT_*', 'MESH_*', &
        'MODULE_*', 'NODE_*', 'PARAMETER_*', 'PART_*', 'PARTICLE_*', 'PERTURBATION_*', &
        'RAIL_*', 'RIGIDWALL_*', 'RIGID_*', 'RVE_*', 'SECTION_*', 'SENSOR_*', 'SET_*', &
        'STAGED_*', 'STOCHASTIC_*', 'STRESS_*', 'SWITCH_*', 'TERMINATION_*', 'TRANSLATE_*', &
        'UNIT_*', 'USER_*', 'ACOUSTIC_*', 'DYNAIN_*', 'COSIM_*', 'EF_*']
    integer :: k
    call refuse(table, 'ELEMENT_SOLID_H20', 'faces of eight nodes pull at contact: '// &
        'take *ELEMENT_SOLID')
    call refuse(table, 'DEFINE_TRANSFORMATION', '')
    call add_options(table)
    call add_solid_options(table)
    do k = 1, size(families)
      call refuse(table, trim(families(k)), '')
    end do
  end subroutine add_refused_keywords

  !> Options of solids, their sets and contacts.
  subroutine add_solid_options(table)
    type(table_t), intent(inout) :: table
    call refuse_all(table, [character(keyword_length) :: &
        'CONTACT_AUTOMATIC_NODES_TO_SURFACE_SMOOTH', &
        'CONTACT_AUTOMATIC_SINGLE_SURFACE_MORTAR', 'CONTACT_AUTOMATIC_SINGLE_SURFACE_SMOOTH', &
        'CONTACT_AUTOMATIC_SINGLE_SURFACE_TIEBREAK', 'CONTACT_AUTOMATIC_SINGLE_SURFACE_TIED', &
        'CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_COMPOSITE', &
        'CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_MORTAR', &
        'CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_SMOOTH', &
        'CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_TIEBREAK', &
        'CONTACT_NODES_TO_SURFACE_INTERFERENCE', 'CONTACT_NODES_TO_SURFACE_SMOOTH', &
        'CONTACT_SURFACE_TO_SURFACE_INTERFERENCE', 'CONTACT_SURFACE_TO_SURFACE_SMOOTH', &
        'ELEMENT_SOLID_DOF', 'ELEMENT_SOLID_H27_DOF', 'ELEMENT_SOLID_H64', &
        'ELEMENT_SOLID_H8TOH20', 'ELEMENT_SOLID_H8TOH27', 'ELEMENT_SOLID_H8TOH64', &
        'ELEMENT_SOLID_ORTHO', 'ELEMENT_SOLID_P21', 'ELEMENT_SOLID_P40', &
        'ELEMENT_SOLID_P6TOP21', 'ELEMENT_SOLID_PERI', 'ELEMENT_SOLID_T15', &
        'ELEMENT_SOLID_T20', 'ELEMENT_SOLID_T4TOT10', 'ELEMENT_SOLID_T4TOT15', &
        'ELEMENT_SOLID_TET4TOTET10', 'SECTION_SOLID_EFG', 'SECTION_SOLID_MISC', &
        'SECTION_SOLID_PERI', 'SECTION_SOLID_SPG', 'SET_SOLID_ADD', 'SET_SOLID_COLLECT', &
        'SET_SOLID_GENERAL_COLLECT', 'SET_SOLID_GENERATE_COLLECT', &
        'SET_SOLID_GENERATE_INCREMENT'])
  end subroutine add_solid_options

  !> Options of keywords that are used, and names that a slip of the pen makes of those.
  subroutine add_options(table)
    type(table_t), intent(inout) :: table
    call refuse_all(table, [character(keyword_length) :: &
        'ELEMENT_BEAM_ELBOW', 'ELEMENT_BEAM_OFFSET', 'ELEMENT_BEAM_ORIENTATION', &
        'ELEMENT_BEAM_PID', 'ELEMENT_BEAM_PULLEY', 'ELEMENT_BEAM_SCALAR', &
        'ELEMENT_BEAM_SECTION', 'ELEMENT_BEAM_SOURCE', 'ELEMENT_BEAM_THICKNESS', &
        'ELEMENT_BEAM_WARPAGE', 'ELEMENT_SHELL_BETA', 'ELEMENT_SHELL_COMPOSITE', &
        'ELEMENT_SHELL_DOF', 'ELEMENT_SHELL_MCID', 'ELEMENT_SHELL_OFFSET', &
        'ELEMENT_SHELL_THICKNESS', 'ELEMENT_TSHELL', 'NODE_MERGE', 'NODE_SCALAR', &
        'NODE_THICKNESS', 'NODE_TRANSFORM', 'PART_ANNEAL', 'PART_AVERAGED', &
        'PART_COMPOSITE', 'PART_CONTACT', 'PART_DUPLICATE', 'PART_MODES', &
        'PART_MOVE', 'PART_PRINT', 'PART_REPOSITION', 'PART_SENSOR', 'SECTION_SHELL_ALE', &
        'SECTION_SHELL_EFG', 'SECTION_SHELL_MISC', 'SECTION_SHELL_THERMAL', &
        'SECTION_SHELL_XFEM', 'SECTION_TSHELL', 'MAT_ELASTIC_FLUID', 'MAT_ELASTIC_PERI', &
        'MAT_001_FLUID', 'MAT_024_2D', 'MAT_024_HAZ', 'MAT_024_LOG_INTERPOLATION', &
        'MAT_024_MIDFAIL', 'MAT_024_STOCHASTIC', 'MAT_MOONEY-RIVLIN_PHASE_CHANGE', &
        'MAT_PIECEWISE_LINEAR_PLASTICITY_2D', 'MAT_PIECEWISE_LINEAR_PLASTICITY_HAZ', &
        'MAT_PIECEWISE_LINEAR_PLASTICITY_LOG_INTERPOLATION', &
        'MAT_PIECEWISE_LINEAR_PLASTICITY_MIDFAIL', &
        'MAT_PIECEWISE_LINEAR_PLASTICITY_STOCHASTIC', 'CONSTRAINED_RIGID_BODIES_SET', &
        'BOUNDARY_PRESCRIBED_MOTION_RIGID_LOCAL', &
        'BOUNDARY_PRESCRIBED_MOTION_RIGID_BNDOUT2DYNAIN', &
        'MAT_RIGID_DISCRETE', &
        'PART_INERTIA_CONTACT', &
        'PART_INERTIA_PRINT', &
        'RIGIDWALL_GEOMETRIC_CYLINDER_DEFORM', &
        'RIGIDWALL_GEOMETRIC_CYLINDER_DISPLAY', &
        'RIGIDWALL_GEOMETRIC_CYLINDER_INTERIOR_DISPLAY', &
        'RIGIDWALL_GEOMETRIC_CYLINDER_INTERIOR_MOTION_DISPLAY', &
        'RIGIDWALL_GEOMETRIC_CYLINDER_MOTION_DISPLAY', &
        'RIGIDWALL_GEOMETRIC_FLAT_DISPLAY', &
        'RIGIDWALL_GEOMETRIC_FLAT_MOTION_DISPLAY', &
        'RIGIDWALL_PLANAR_MOVING_DISPLAY', &
        'RIGIDWALL_PLANAR_MOVING_FORCES'])
    call refuse_all(table, [character(keyword_length) :: &
        'SET_MODE', 'SET_MODE_LIST', 'SET_MODE_LIST_GENERATE', 'SET_NODE_ADD', &
        'SET_NODE_COLUMN_COLLECT', 'SET_NODE_GENERAL_COLLECT', 'SET_NODE_INTERSECT', &
        'SET_NODE_LIST_COLLECT', 'SET_NODE_LIST_GENERATE_COLLECT', &
        'SET_NODE_LIST_GENERATE_INCREMENT', 'SET_NODE_LIST_SMOOTH', 'SET_PART_ADD', &
        'SET_PART_COLLECT', 'SET_PART_COLUMN_COLLECT', 'SET_PART_LIST_COLLECT', &
        'SET_PART_LIST_GENERATE_COLLECT', 'SET_PART_LIST_GENERATE_INCREMENT', &
        'SET_PART_TREE', 'SET_SEGMENT_ADD', 'SET_SEGMENT_COLLECT', &
        'SET_SEGMENT_GENERAL_COLLECT', 'SET_SEGMENT_INTERSECT', 'SET_SHELL_ADD', &
        'SET_SHELL_COLUMN_COLLECT', 'SET_SHELL_GENERAL_COLLECT', 'SET_SHELL_INTERSECT', &
        'SET_SHELL_LIST_COLLECT', 'SET_SHELL_LIST_GENERATE_COLLECT', &
        'SET_SHELL_LIST_GENERATE_INCREMENT', 'DEFINE_BOX_ADAPTIVE', 'DEFINE_BOX_COARSEN', &
        'DEFINE_BOX_DRAWBEAD', 'DEFINE_BOX_LOCAL', 'DEFINE_BOX_SPH', 'DEFINE_CURVE_3858', &
        'DEFINE_CURVE_5434A', 'DEFINE_CURVE_DRAWBEAD', 'DEFINE_CURVE_DUPLICATE', &
        'DEFINE_CURVE_ENTITY', 'DEFINE_CURVE_FEEDBACK', 'DEFINE_CURVE_FLC', &
        'DEFINE_CURVE_FUNCTION', 'DEFINE_CURVE_SMOOTH', 'DEFINE_CURVE_STRESS', &
        'DEFINE_CURVE_TRIM'])
    call refuse_all(table, [character(keyword_length) :: &
        'BOUNDARY_PRESCRIBED_MOTION_SET_BOX', 'BOUNDARY_PRESCRIBED_MOTION_SET_LINE', &
        'BOUNDARY_PRESCRIBED_MOTION_SET_SEGMENT', 'LOAD_BODY_RX', 'LOAD_BODY_RY', &
        'LOAD_BODY_RZ', 'LOAD_NODE_POINT_ONCE', 'LOAD_NODE_SET_ONCE', 'LOAD_SEGMENT_FILE', &
        'LOAD_SEGMENT_FSILNK', 'LOAD_SEGMENT_NONUNIFORM', 'LOAD_SEGMENT_SET_ANGLE', &
        'LOAD_SEGMENT_SET_NONUNIFORM', 'CONTACT_2D_AUTOMATIC_NODE_TO_SURFACE_THERMAL', &
        'CONTACT_2D_AUTOMATIC_SINGLE_SURFACE_MORTAR', &
        'CONTACT_2D_AUTOMATIC_SINGLE_SURFACE_THERMAL', &
        'CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE_MORTAR', &
        'CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE_THERMAL', 'RIGIDWALL_PLANAR_FINITE', &
        'RIGIDWALL_PLANAR_FORCES', 'RIGIDWALL_PLANAR_ORTHO', &
        'CONTROL_IMPLICIT_AUTO_DYN', 'CONTROL_IMPLICIT_AUTO_SPR', &
        'CONTROL_IMPLICIT_DYNAMICS_DYN', 'CONTROL_IMPLICIT_DYNAMICS_SPR', &
        'CONTROL_IMPLICIT_GENERAL_DYN', 'CONTROL_IMPLICIT_GENERAL_SPR', &
        'CONTROL_IMPLICIT_SOLUTION_DYN', 'CONTROL_IMPLICIT_SOLUTION_SPR'])
  end subroutine add_options

  subroutine refuse_all(table, names)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: names(:)
    integer :: k
    do k = 1, size(names)
      call refuse(table, trim(names(k)), '')
    end do
  end subroutine refuse_all

  subroutine refuse(table, name, help)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, help
    call add_keyword(table, name, help, class=keyword_refused)
  end subroutine refuse

end module deck_keywords_other
