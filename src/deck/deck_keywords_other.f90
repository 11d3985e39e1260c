! SPDX-License-Identifier: BSD-3-Clause
!> Keywords that are known but not available: refused by name rather than called unknown.
module deck_keywords_other
  use deck_table, only: table_t, add_keyword, keyword_refused
  implicit none
  private
  public :: add_refused_keywords

contains

  !> Adds what is refused. The families come last: a name of its own wins.
  subroutine add_refused_keywords(table)
    type(table_t), intent(inout) :: table
    character(16), parameter :: families(58) = [character(16) :: 'AIRBAG_*', 'ALE_*', &
        'BATTERY_*', 'BOUNDARY_*', 'CASE*', 'CESE_*', 'CHANGE_*', 'CHEMISTRY_*', &
        'COMPONENT_*', 'CONSTRAINED_*', 'CONTACT_*', 'CONTROLLER_*', 'CONTROL_*', 'DAMPING_*', &
        'DEFINE_*', 'DEFORMABLE_*', 'DELETE_*', 'DUALCESE_*', 'ELEMENT_*', 'EM_*', 'EOS_*', &
        'FATIGUE*', 'FREQUENCY_*', 'HOURGLASS_*', 'ICFD_*', 'IGA_*', 'INCLUDE_*', 'INITIAL_*', &
        'INTEGRATION_*', 'INTERFACE_*', 'ISPG_*', 'LOAD_*', 'LSO_*', 'MAT_*', 'MESH_*', &
        'MODULE_*', 'NODE_*', 'PARAMETER_*', 'PART_*', 'PARTICLE_*', 'PERTURBATION_*', &
        'RAIL_*', 'RIGIDWALL_*', 'RIGID_*', 'RVE_*', 'SECTION_*', 'SENSOR_*', 'SET_*', &
        'STAGED_*', 'STOCHASTIC_*', 'STRESS_*', 'SWITCH_*', 'TERMINATION_*', 'TRANSLATE_*', &
        'UNIT_*', 'USER_*', 'ACOUSTIC_*', 'DYNAIN_*']
    integer :: k
    call refuse(table, 'MAT_RIGID', 'the one material is *MAT_ELASTIC')
    call refuse(table, 'MAT_BLATZ-KO_RUBBER', 'the one material is *MAT_ELASTIC')
    call refuse(table, 'MAT_MOONEY-RIVLIN_RUBBER', 'the one material is *MAT_ELASTIC')
    call refuse(table, 'MAT_PLASTIC_KINEMATIC', 'the one material is *MAT_ELASTIC')
    call refuse(table, 'MAT_PIECEWISE_LINEAR_PLASTICITY', 'the one material is *MAT_ELASTIC')
    call refuse(table, 'ELEMENT_SOLID', 'models are plane: *ELEMENT_SHELL')
    call refuse(table, 'SECTION_SOLID', 'models are plane: *SECTION_SHELL')
    call refuse(table, 'LOAD_BODY_Z', 'models are plane')
    call refuse(table, 'DAMPING_GLOBAL', '')
    call refuse(table, 'DAMPING_PART_STIFFNESS', '')
    call refuse(table, 'CONTACT_AUTOMATIC_SURFACE_TO_SURFACE', &
        'plane models take *CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE')
    call refuse(table, 'DEFINE_TRANSFORMATION', '')
    do k = 1, size(families)
      call refuse(table, trim(families(k)), '')
    end do
  end subroutine add_refused_keywords

  subroutine refuse(table, name, help)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, help
    call add_keyword(table, name, help, class=keyword_refused)
  end subroutine refuse

end module deck_keywords_other
