! SPDX-License-Identifier: BSD-3-Clause
!> The keywords that this version knows: the one place that has their cards, columns, units (as
!> dimensions), defaults and ranges, in pieces by subject.
module deck_keywords
  use deck_keywords_contact, only: add_contact_keywords, add_output_keywords
  use deck_keywords_load, only: add_load_keywords
  use deck_keywords_mesh, only: add_mesh_keywords
  use deck_keywords_other, only: add_skipped_keywords, add_refused_keywords
  use deck_keywords_own, only: add_own_keywords
  use deck_table, only: table_t, add_keyword, add_card, add_field
  implicit none
  private
  public :: fill_table

contains

  !> Fills the table of keywords.
  subroutine fill_table(table)
    type(table_t), intent(inout) :: table
    call add_frame(table)
    call add_mesh_keywords(table)
    call add_load_keywords(table)
    call add_contact_keywords(table)
    call add_output_keywords(table)
    call add_own_keywords(table)
    call add_skipped_keywords(table)
    call add_refused_keywords(table)
  end subroutine fill_table

  !> *PARAMETER, *INCLUDE, *KEYWORD and *END have no row: the reader itself obeys them.
  subroutine add_frame(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'TITLE', 'title of the run', required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'TITLE', 'T80', 'any text')
    call add_keyword(table, 'CONTROL_TERMINATION', 'end of the run', required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'ENDTIM', 'R10 req [T] >0', 'end time')
    call add_field(table, 'ENDCYC', 'I10 =0 >=0', 'last step; 0 = no limit')
    call add_field(table, 'DTMIN', 'R10 fixed', 'of explicit methods')
    call add_field(table, 'ENDENG', 'R10 =0.0 >=0', &
        'change of the energy ratio in per cent that fails the run; 0 = off')
    call add_field(table, 'ENDMAS', 'R10 note', 'of mass scaling')
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
    call add_field(table, 'TDYDTH', 'R10 fixed [T] =1.0E28 0=d')
    call add_field(table, 'TDYBUR', 'R10 fixed [T] =1.0E28 0=d')
    call add_field(table, 'IRATE', 'I10 fixed')
    call add_field(table, 'ALPHA', 'R10 fixed', 'of HHT, which is not available')
    call add_card(table)
    call add_field(table, 'PSID', 'I10 fixed')
    call add_field(table, 'ANGLE', 'R10 note')
    call add_solution(table)
  end subroutine add_frame

  subroutine add_solution(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'CONTROL_IMPLICIT_SOLUTION', 'linear or not', required=1, &
        once=.true.)
    call add_card(table)
    call add_field(table, 'NSOLVR', 'I10 =1 fixed 0=d', '1 = linear; 12 is not available')
    call add_field(table, 'ILIMIT', 'I10 note')
    call add_field(table, 'MAXREF', 'I10 note', 'of nonlinear scenes')
    call add_field(table, 'DCTOL', 'R10 note', 'of nonlinear scenes')
    call add_field(table, 'ECTOL', 'R10 note', 'of nonlinear scenes')
    call add_field(table, 'RCTOL', 'R10 note', 'of nonlinear scenes')
    call add_field(table, 'LSTOL', 'R10 note')
    call add_field(table, 'ABSTOL', 'R10 note', 'of nonlinear scenes')
    call add_card(table)
    call add_field(table, 'DNORM', 'I10 note', 'of nonlinear scenes')
    call add_field(table, 'DIVERG', 'I10 note')
    call add_field(table, 'ISTIF', 'I10 note')
    call add_field(table, 'NLPRINT', 'I10 note')
    call add_field(table, 'NLNORM', 'R10 note')
    call add_field(table, 'D3ITCTL', 'I10 note')
    call add_field(table, 'CPCHK', 'I10 note')
  end subroutine add_solution

end module deck_keywords
