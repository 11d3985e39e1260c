! SPDX-License-Identifier: BSD-3-Clause
!> Keywords that cannot change the solution here, and keywords that are known but not available:
!> refused by name rather than called unknown.
module deck_keywords_other
  use deck_table, only: table_t, add_keyword, add_card, add_field, keyword_skipped, &
      keyword_refused
  implicit none
  private
  public :: add_skipped_keywords, add_refused_keywords

contains

  !> Adds what is skipped with a note; where one field of it would matter, the cards are read.
  subroutine add_skipped_keywords(table)
    type(table_t), intent(inout) :: table
    call skip(table, 'COMMENT', 'a comment')
    call skip(table, 'CONTROL_ENERGY', 'the energy ledger is always complete')
    call skip(table, 'CONTROL_OUTPUT', 'it concerns output of another program')
    call skip(table, 'CONTROL_CPU', 'it limits processor time of another program')
    call skip(table, 'CONTROL_SHELL', 'plane elements have none of these options')
    call skip(table, 'CONTROL_HOURGLASS', 'elements are fully integrated')
    call skip(table, 'HOURGLASS', 'elements are fully integrated')
    call skip(table, 'CONTROL_IMPLICIT_SOLVER', 'see *BIPACT_SOLVER')
    call skip(table, 'SET_SOLID', 'plane models have no solid elements')
    call skip(table, 'SET_SOLID_LIST', 'plane models have no solid elements')
    call skip(table, 'SET_BEAM', 'beams are left out')
    call skip(table, 'SET_BEAM_LIST', 'beams are left out')
    call skip(table, 'DATABASE_*', 'bipact has no such output')
    call add_control_contact(table)
    call add_control_timestep(table)
    call add_control_auto(table)
  end subroutine add_skipped_keywords

  subroutine skip(table, name, help)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, help
    call add_keyword(table, name, help, class=keyword_skipped)
  end subroutine skip

  subroutine add_control_contact(table)
    type(table_t), intent(inout) :: table
    integer :: k
    call add_keyword(table, 'CONTROL_CONTACT', 'it tunes penalty contact; friction of all '// &
        'contacts (SFRIC, DFRIC) must be blank', required=1, once=.true., noted=.true.)
    do k = 1, 6
      call add_card(table)
      if (k == 3) then
        call add_field(table, 'SFRIC', 'R10 fixed', 'give FS on the contact card')
        call add_field(table, 'DFRIC', 'R10 fixed', 'give FS on the contact card')
        call add_field(table, 'EDC', 'R10 fixed')
        call add_field(table, 'VFC', 'R10 fixed')
      end if
      call add_ignored(table, merge(4, 8, k == 3))
    end do
  end subroutine add_control_contact

  subroutine add_control_timestep(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'CONTROL_TIMESTEP', 'it concerns explicit steps; mass scaling '// &
        '(DT2MS) must be blank', required=1, once=.true., noted=.true.)
    call add_card(table)
    call add_field(table, 'DTINIT', 'R10 ignored')
    call add_field(table, 'TSSFAC', 'R10 ignored')
    call add_field(table, 'ISDO', 'I10 ignored')
    call add_field(table, 'TSLIMT', 'R10 ignored')
    call add_field(table, 'DT2MS', 'R10 fixed', 'masses are never changed')
    call add_ignored(table, 3)
    call add_card(table)
    call add_field(table, 'DT2MSF', 'R10 fixed')
    call add_ignored(table, 7)
  end subroutine add_control_timestep

  subroutine add_control_auto(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'CONTROL_IMPLICIT_AUTO', &
        'automatic steps (IAUTO) are not available', required=1, once=.true., noted=.true.)
    call add_card(table)
    call add_field(table, 'IAUTO', 'I10 fixed', 'steps are those of DT0')
    call add_ignored(table, 7)
  end subroutine add_control_auto

  !> Fields that are read as numbers and have no effect.
  subroutine add_ignored(table, count)
    type(table_t), intent(inout) :: table
    integer, intent(in) :: count
    integer :: k
    do k = 1, count
      call add_field(table, '-', 'R10 ignored')
    end do
  end subroutine add_ignored

  !> Adds what is refused. The families come last: a name of its own wins.
  subroutine add_refused_keywords(table)
    type(table_t), intent(inout) :: table
    character(16), parameter :: families(27) = [character(16) :: 'AIRBAG_*', 'BOUNDARY_*', &
        'CESE_*', 'COMPONENT_*', 'CONSTRAINED_*', 'CONTACT_*', 'CONTROL_*', 'DAMPING_*', &
        'DEFINE_*', 'DEFORMABLE_*', 'ELEMENT_*', 'EOS_*', 'ICFD_*', 'INCLUDE_*', 'INITIAL_*', &
        'INTEGRATION_*', 'INTERFACE_*', 'LOAD_*', 'MAT_*', 'MODULE_*', 'NODE_*', &
        'PARAMETER_*', 'PART_*', 'RIGIDWALL_*', 'SECTION_*', 'SENSOR_*', 'SET_*']
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
    call refuse(table, 'DATABASE_HISTORY_SOLID', 'models are plane')
    call refuse(table, 'DEFINE_TRANSFORMATION', '')
    call refuse(table, 'PARAMETER_EXPRESSION', 'give values with *PARAMETER')
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
