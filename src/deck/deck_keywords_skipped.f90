! SPDX-License-Identifier: BSD-3-Clause
!> Keywords that cannot change the solution here: each is skipped with one note that says why.
!> The names are exact; a name that is not in the list is unknown.
module deck_keywords_skipped
  use deck_table, only: table_t, keyword_length, add_keyword, add_card, add_field, &
      keyword_skipped
  implicit none
  private
  public :: add_skipped_keywords

contains

  !> Adds what is skipped with a note; where one field of it would matter, the cards are read.
  subroutine add_skipped_keywords(table)
    type(table_t), intent(inout) :: table
    call skip(table, [character(keyword_length) :: 'COMMENT'], 'a comment')
    call skip(table, [character(keyword_length) :: 'KEYWORD_ID', 'KEYWORD_JOBID'], &
        'it names the run, no more')
    call add_elements_and_sets(table)
    call add_controls(table)
    call add_other_outputs(table)
    call add_other_histories(table)
    call add_control_contact(table)
    call add_control_solution(table)
    call add_control_shell(table)
  end subroutine add_skipped_keywords

  subroutine skip(table, names, help)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: names(:), help
    integer :: k
    do k = 1, size(names)
      call add_keyword(table, trim(names(k)), help, class=keyword_skipped)
    end do
  end subroutine skip

  subroutine add_elements_and_sets(table)
    type(table_t), intent(inout) :: table
    call skip(table, [character(keyword_length) :: 'HOURGLASS', 'HOURGLASS_TITLE', &
        'CONTROL_HOURGLASS', 'CONTROL_HOURGLASS_936'], &
        'elements are fully integrated, without hourglass modes')
    call skip(table, [character(keyword_length) :: 'SET_TSHELL', 'SET_TSHELL_LIST'], &
        'there are no such elements')
    call skip(table, [character(keyword_length) :: 'SET_BEAM', 'SET_BEAM_LIST', &
        'SET_BEAM_TITLE', 'SET_BEAM_LIST_TITLE', 'SET_BEAM_GENERATE', 'SET_BEAM_GENERAL', &
        'SET_DISCRETE', 'SET_DISCRETE_LIST'], 'elements of this kind are left out')
  end subroutine add_elements_and_sets

  subroutine add_controls(table)
    type(table_t), intent(inout) :: table
    call skip(table, [character(keyword_length) :: 'CONTROL_OUTPUT', 'CONTROL_DEBUG', &
        'CONTROL_REQUIRE_REVISION', 'CONTROL_STRUCTURED', &
        'CONTROL_STRUCTURED_TERM', 'CONTROL_CPU'], &
        'it concerns files, checks and limits of another program')
    call skip(table, [character(keyword_length) :: 'CONTROL_UNITS'], &
        'units are those of the deck')
    call skip(table, [character(keyword_length) :: 'CONTROL_PARALLEL', &
        'CONTROL_MPP_CONTACT_GROUPABLE', 'CONTROL_MPP_DECOMPOSITION_ADAPTIVE', &
        'CONTROL_MPP_DECOMPOSITION_ARRANGE_PARTS', 'CONTROL_MPP_DECOMPOSITION_AUTOMATIC', &
        'CONTROL_MPP_DECOMPOSITION_BAGREF', 'CONTROL_MPP_DECOMPOSITION_CHECK_SPEED', &
        'CONTROL_MPP_DECOMPOSITION_CONTACT_DISTRIBUTE', &
        'CONTROL_MPP_DECOMPOSITION_CONTACT_ISOLATE', &
        'CONTROL_MPP_DECOMPOSITION_DISABLE_UNREF_CURVES', &
        'CONTROL_MPP_DECOMPOSITION_DISTRIBUTE_ALE_ELEMENT', &
        'CONTROL_MPP_DECOMPOSITION_DISTRIBUTE_ALE_ELEMENTS', &
        'CONTROL_MPP_DECOMPOSITION_DISTRIBUTE_SPH_ELEMENT', &
        'CONTROL_MPP_DECOMPOSITION_DISTRIBUTE_SPH_ELEMENTS', &
        'CONTROL_MPP_DECOMPOSITION_ELCOST', 'CONTROL_MPP_DECOMPOSITION_FILE', &
        'CONTROL_MPP_DECOMPOSITION_FILE_READ', 'CONTROL_MPP_DECOMPOSITION_FILE_WRITE', &
        'CONTROL_MPP_DECOMPOSITION_METHOD', 'CONTROL_MPP_DECOMPOSITION_NUMPROC', &
        'CONTROL_MPP_DECOMPOSITION_OUTDECOMP', &
        'CONTROL_MPP_DECOMPOSITION_PARTSET_DISTRIBUTE', &
        'CONTROL_MPP_DECOMPOSITION_PARTS_DISTRIBUTE', 'CONTROL_MPP_DECOMPOSITION_RCBLOG', &
        'CONTROL_MPP_DECOMPOSITION_REDECOMPOSITION', &
        'CONTROL_MPP_DECOMPOSITION_SCALE_CONTACT_COST', &
        'CONTROL_MPP_DECOMPOSITION_SCALE_FACTOR_SPH', 'CONTROL_MPP_DECOMPOSITION_SHOW', &
        'CONTROL_MPP_DECOMPOSITION_TRANSFORMATION', 'CONTROL_MPP_IO_BINOUTONLY', &
        'CONTROL_MPP_IO_LSTC_REDUCE', 'CONTROL_MPP_IO_NOBEAMOUT', 'CONTROL_MPP_IO_NOD3DUMP', &
        'CONTROL_MPP_IO_NODUMP', 'CONTROL_MPP_IO_NOFULL', 'CONTROL_MPP_IO_SWAPBYTES', &
        'CONTROL_MPP_PFILE', 'CONTROL_MPP_REBALANCE'], &
        'it distributes work of another program over processors')
    call skip(table, [character(keyword_length) :: 'CONTROL_ACCURACY', &
        'CONTROL_BULK_VISCOSITY', 'CONTROL_SUBCYCLE'], &
        'it concerns explicit steps and large rotations, which are not computed')
    call skip(table, [character(keyword_length) :: 'CONTROL_SOLID', 'CONTROL_RIGID', &
        'CONTROL_SPH', 'CONTROL_ALE', 'CONTROL_EFG', 'CONTROL_DISCRETE_ELEMENT', &
        'CONTROL_AIRBAG'], &
        'it concerns elements and bodies that plane models do not have')
    call skip(table, [character(keyword_length) :: 'CONTROL_IMPLICIT_SOLVER'], &
        'it chooses how equations are solved, not which; see *BIPACT_SOLVER')
    call skip(table, [character(keyword_length) :: 'CONTROL_ENERGY'], &
        'it says which energies are summed; the energy ledger is complete')
    call skip(table, [character(keyword_length) :: 'CONTROL_THERMAL_SOLVER', &
        'CONTROL_THERMAL_TIMESTEP', 'CONTROL_THERMAL_NONLINEAR'], &
        'there is no thermal analysis')
  end subroutine add_controls

  !> Files of results that another program would write.
  subroutine add_other_outputs(table)
    type(table_t), intent(inout) :: table
    character(*), parameter :: why = 'it asks for output that bipact does not have, no more'
    call skip(table, [character(keyword_length) :: 'DATABASE_ABSTAT', 'DATABASE_ABSTAT_CPM', &
        'DATABASE_ACEOUT', 'DATABASE_ALE', 'DATABASE_ALE_MAT', 'DATABASE_ALE_OPERATION', &
        'DATABASE_ATDOUT', 'DATABASE_AVSFLT', 'DATABASE_BEARING', 'DATABASE_BNDOUT', &
        'DATABASE_CPM_SENSOR', 'DATABASE_CROSS_SECTION_PLANE', &
        'DATABASE_CROSS_SECTION_PLANE_ID', 'DATABASE_CROSS_SECTION_SET', &
        'DATABASE_CROSS_SECTION_SET_ID', 'DATABASE_CURVOUT', 'DATABASE_D3FTG', &
        'DATABASE_D3MAX', 'DATABASE_DCFAIL', 'DATABASE_DEFGEO', 'DATABASE_DEFORC', &
        'DATABASE_DEMASSFLOW', 'DATABASE_DISBOUT', 'DATABASE_FATXML', 'DATABASE_FORMAT', &
        'DATABASE_FSI', 'DATABASE_FSI_SENSOR', 'DATABASE_GCEOUT', 'DATABASE_H3OUT', &
        'DATABASE_ICVOUT', 'DATABASE_ISPHHTC', 'DATABASE_JNTFORC', 'DATABASE_JNTFORC_LOCAL', &
        'DATABASE_MASSOUT', 'DATABASE_MAX_BEAM', 'DATABASE_MAX_BEAM_ID', &
        'DATABASE_MAX_BEAM_SET', 'DATABASE_MAX_SHELL', 'DATABASE_MAX_SHELL_ID', &
        'DATABASE_MAX_SHELL_SET', 'DATABASE_MAX_SOLID', 'DATABASE_MAX_SOLID_ID', &
        'DATABASE_MAX_SOLID_SET', 'DATABASE_MAX_TSHELL', 'DATABASE_MAX_TSHELL_ID', &
        'DATABASE_MAX_TSHELL_SET', 'DATABASE_MOVIE', 'DATABASE_MPGS', &
        'DATABASE_NCFORC_FILTER', 'DATABASE_NODAL_FORCE_GROUP', 'DATABASE_NODFOR', &
        'DATABASE_PAP_OUTPUT', 'DATABASE_PBLAST_SENSOR', 'DATABASE_PBSTAT', &
        'DATABASE_PLLYOUT', 'DATABASE_POWER_SPECTRAL_DENSITY', &
        'DATABASE_POWER_SPECTRAL_DENSITY_FREQUENCY', 'DATABASE_PROFILE', 'DATABASE_PRTUBE', &
        'DATABASE_PWP_FLOW', 'DATABASE_PWP_OUTPUT', 'DATABASE_PYRO', &
        'DATABASE_RCFORC_MOMENT', 'DATABASE_RECOVER_NODE', 'DATABASE_RVE', 'DATABASE_SALE', &
        'DATABASE_SBTOUT', 'DATABASE_SECFORC', 'DATABASE_SECFORC_FILTER', 'DATABASE_SPHFLOW', &
        'DATABASE_SPHMASSFLOW', 'DATABASE_SPHOUT', 'DATABASE_SPRING_FORWARD', &
        'DATABASE_SSSTAT', 'DATABASE_SSSTAT_MASS_PROPERTIES', &
        'DATABASE_SUPERPLASTIC_FORMING', 'DATABASE_SWFORC', 'DATABASE_TPRINT', &
        'DATABASE_TRACER', 'DATABASE_TRACER_ALE', 'DATABASE_TRACER_DE', &
        'DATABASE_TRACER_GENERAL', 'DATABASE_TRACER_GENERATE', 'DATABASE_TRHIST'], &
        why)
    call skip(table, [character(keyword_length) :: 'DATABASE_BINARY_BLSTFOR', &
        'DATABASE_BINARY_CPMFOR', 'DATABASE_BINARY_D3ACC', 'DATABASE_BINARY_D3ACS', &
        'DATABASE_BINARY_D3ALE', 'DATABASE_BINARY_D3ATV', 'DATABASE_BINARY_D3CRACK', &
        'DATABASE_BINARY_D3DRLF', 'DATABASE_BINARY_D3DUMP', 'DATABASE_BINARY_D3EIGV', &
        'DATABASE_BINARY_D3FTG', 'DATABASE_BINARY_D3MAX', 'DATABASE_BINARY_D3PART', &
        'DATABASE_BINARY_D3PBM', 'DATABASE_BINARY_D3PROP', 'DATABASE_BINARY_D3PSD', &
        'DATABASE_BINARY_D3RMS', 'DATABASE_BINARY_D3SPCM', 'DATABASE_BINARY_D3SSD', &
        'DATABASE_BINARY_D3THDT', 'DATABASE_BINARY_DEMFOR', 'DATABASE_BINARY_DEMRCF', &
        'DATABASE_BINARY_FSIFOR', 'DATABASE_BINARY_FSILNK', 'DATABASE_BINARY_INTFOR', &
        'DATABASE_BINARY_INTFOR_FILE', 'DATABASE_BINARY_ISPHFOR', 'DATABASE_BINARY_PBMFOR', &
        'DATABASE_BINARY_RUNRSF', 'DATABASE_BINARY_XTFILE', 'DATABASE_EXTENT_AVS', &
        'DATABASE_EXTENT_BINARY', 'DATABASE_EXTENT_BINARY_COMP', 'DATABASE_EXTENT_D3PART', &
        'DATABASE_EXTENT_INTFOR', 'DATABASE_EXTENT_MOVIE', 'DATABASE_EXTENT_MPGS', &
        'DATABASE_EXTENT_SSSTAT', 'DATABASE_EXTENT_SSSTAT_ID'], &
        why)
    call skip(table, [character(keyword_length) :: 'DATABASE_FREQUENCY_ASCII_ELOUT_PSD', &
        'DATABASE_FREQUENCY_ASCII_ELOUT_SSD', &
        'DATABASE_FREQUENCY_ASCII_ELOUT_SSD_MODAL_CONTRIBUTION', &
        'DATABASE_FREQUENCY_ASCII_ELOUT_SSD_SUBCASE', 'DATABASE_FREQUENCY_ASCII_NODFOR_SSD', &
        'DATABASE_FREQUENCY_ASCII_NODFOR_SSD_SUBCASE', 'DATABASE_FREQUENCY_ASCII_NODOUT_PSD', &
        'DATABASE_FREQUENCY_ASCII_NODOUT_SSD', &
        'DATABASE_FREQUENCY_ASCII_NODOUT_SSD_MODAL_CONTRIBUTION', &
        'DATABASE_FREQUENCY_ASCII_NODOUT_SSD_SUBCASE', 'DATABASE_FREQUENCY_BINARY_D3ACC', &
        'DATABASE_FREQUENCY_BINARY_D3ACS', 'DATABASE_FREQUENCY_BINARY_D3ATV', &
        'DATABASE_FREQUENCY_BINARY_D3ERP', 'DATABASE_FREQUENCY_BINARY_D3FTG', &
        'DATABASE_FREQUENCY_BINARY_D3PSD', 'DATABASE_FREQUENCY_BINARY_D3PSD_SUMMATION', &
        'DATABASE_FREQUENCY_BINARY_D3RMS', 'DATABASE_FREQUENCY_BINARY_D3RMS_SUMMATION', &
        'DATABASE_FREQUENCY_BINARY_D3SPCM', 'DATABASE_FREQUENCY_BINARY_D3SSD', &
        'DATABASE_FREQUENCY_BINARY_D3SSD_SUBCASE', 'DATABASE_FREQUENCY_BINARY_D3ZCF'], &
        why)
  end subroutine add_other_outputs

  subroutine add_other_histories(table)
    type(table_t), intent(inout) :: table
    call skip(table, [character(keyword_length) :: 'DATABASE_HISTORY_ACOUSTIC', &
        'DATABASE_HISTORY_BEAM', 'DATABASE_HISTORY_BEAM_ID', 'DATABASE_HISTORY_BEAM_SET', &
        'DATABASE_HISTORY_DISCRETE', 'DATABASE_HISTORY_DISCRETE_ID', &
        'DATABASE_HISTORY_DISCRETE_SET', 'DATABASE_HISTORY_NODE_LOCAL', &
        'DATABASE_HISTORY_NODE_LOCAL_ID', 'DATABASE_HISTORY_NODE_SET_LOCAL', &
        'DATABASE_HISTORY_SEATBELT', 'DATABASE_HISTORY_SEATBELT_ID', &
        'DATABASE_HISTORY_SEATBELT_RETRACTOR', 'DATABASE_HISTORY_SEATBELT_SENSOR', &
        'DATABASE_HISTORY_SEATBELT_SLIPRING', 'DATABASE_HISTORY_SPH', &
        'DATABASE_HISTORY_SPH_SET', 'DATABASE_HISTORY_TSHELL', 'DATABASE_HISTORY_TSHELL_ID', &
        'DATABASE_HISTORY_TSHELL_SET'], &
        'it asks for output that bipact does not have; see *DATABASE_HISTORY_NODE, _SHELL')
  end subroutine add_other_histories

  subroutine add_control_contact(table)
    type(table_t), intent(inout) :: table
    integer :: k
    call add_keyword(table, 'CONTROL_CONTACT', 'it tunes penalty contact; friction of all '// &
        'contacts (SFRIC, DFRIC) must be blank', required=1, noted=.true.)
    do k = 1, 6
      call add_card(table)
      if (k == 2) then
        call add_field(table, 'USRSTR', 'I10 fixed', 'subroutines of users')
        call add_field(table, 'USRFRC', 'I10 fixed', 'subroutines of users')
      else if (k == 3) then
        call add_field(table, 'SFRIC', 'R10 fixed', 'give FS on the contact card')
        call add_field(table, 'DFRIC', 'R10 fixed', 'give FS on the contact card')
        call add_field(table, 'EDC', 'R10 fixed')
        call add_field(table, 'VFC', 'R10 fixed')
      end if
      call add_ignored(table, 8 - table%keyword(table%n)%card(k)%fields)
    end do
  end subroutine add_control_contact

  subroutine add_control_solution(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'CONTROL_SOLUTION', 'the analysis is structural; thermal '// &
        'analysis (SOLN) must be 0', required=1, noted=.true.)
    call add_card(table)
    call add_field(table, 'SOLN', 'I10 fixed', '0 = structural')
    call add_ignored(table, 7)
  end subroutine add_control_solution

  !> Options of real shells; those that delete elements must be off.
  subroutine add_control_shell(table)
    type(table_t), intent(inout) :: table
    integer :: k
    call add_keyword(table, 'CONTROL_SHELL', 'it concerns real shells, not plane elements; '// &
        'what deletes elements must be blank', required=1, noted=.true.)
    do k = 1, 2
      call add_card(table)
      call add_ignored(table, 8)
    end do
    call add_card(table)
    call add_ignored(table, 5)
    call add_field(table, 'W-MODE', 'R10 fixed', 'elements are never deleted')
    call add_field(table, 'STRETCH', 'R10 fixed', 'elements are never deleted')
    call add_ignored(table, 1)
    call add_card(table)
    call add_field(table, 'NFAIL1', 'I10 fixed', 'elements are never deleted')
    call add_field(table, 'NFAIL4', 'I10 fixed', 'elements are never deleted')
    call add_ignored(table, 6)
    call add_card(table)
    call add_ignored(table, 3)
  end subroutine add_control_shell

  !> Fields that are read as numbers and have no effect.
  subroutine add_ignored(table, count)
    type(table_t), intent(inout) :: table
    integer, intent(in) :: count
    integer :: k
    do k = 1, count
      call add_field(table, '-', 'R10 ignored')
    end do
  end subroutine add_ignored

end module deck_keywords_skipped
