! SPDX-License-Identifier: BSD-3-Clause
!> The keywords that this version knows: the one place that has their cards, columns, units (as
!> dimensions), defaults and ranges, in pieces by subject.
module deck_keywords
  use deck_keywords_contact, only: add_contact_keywords, add_space_contact_keywords, &
      add_output_keywords
  use deck_keywords_wall, only: add_wall_keywords
  use deck_keywords_load, only: add_load_keywords
  use deck_keywords_mesh, only: add_mesh_keywords
  use deck_keywords_other, only: add_refused_keywords
  use deck_keywords_own, only: add_own_keywords
  use deck_keywords_skipped, only: add_skipped_keywords
  use deck_table, only: table_t, add_keyword, add_card, add_field, keyword_frame
  implicit none
  private
  public :: fill_table, complete_table

contains

  !> Fills the table with the keywords that are used.
  subroutine fill_table(table)
    type(table_t), intent(inout) :: table
    call add_frame(table)
    call add_control_timestep(table)
    call add_mesh_keywords(table)
    call add_load_keywords(table)
    call add_contact_keywords(table)
    call add_wall_keywords(table)
    call add_output_keywords(table)
    call add_own_keywords(table)
  end subroutine fill_table

  !> Adds the contacts in space, and the keywords that are skipped or refused, once: they are
  !> looked for when a name is none of those that every deck may use.
  subroutine complete_table(table)
    type(table_t), intent(inout) :: table
    if (table%is_complete) return
    call add_space_contact_keywords(table)
    call add_reader_keywords(table)
    call add_skipped_keywords(table)
    call add_refused_keywords(table)
    table%is_complete = .true.
  end subroutine complete_table

  !> What the reader itself obeys has no cards here.
  subroutine add_reader_keywords(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'KEYWORD', 'begins a deck; LONG=Y makes fields 20 columns wide', &
        class=keyword_frame)
    call add_keyword(table, 'END', 'ends a file', class=keyword_frame)
    call add_keyword(table, 'INCLUDE', 'names of files, one a line, read here', &
        class=keyword_frame)
    call add_keyword(table, 'INCLUDE_PATH', 'folders of included files, one a line', &
        class=keyword_frame)
    call add_keyword(table, 'INCLUDE_PATH_RELATIVE', &
        'the same, relative to the file with this card', class=keyword_frame)
    call add_keyword(table, 'PARAMETER', &
        'names and values, four pairs of 10 and 10 columns a card', class=keyword_frame)
    call add_keyword(table, 'PARAMETER_LOCAL', &
        'the same, for one file and what it includes below', class=keyword_frame)
    call add_keyword(table, 'PARAMETER_EXPRESSION', &
        'one a card: a name in 10 columns, then an expression', class=keyword_frame)
    call add_keyword(table, 'PARAMETER_EXPRESSION_LOCAL', &
        'the same, for one file and what it includes below', class=keyword_frame)
  end subroutine add_reader_keywords

  subroutine add_frame(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'TITLE', 'title of the run', required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'TITLE', 'T80', 'any text')
    call add_keyword(table, 'CONTROL_TERMINATION', 'end of the run', required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'ENDTIM', 'R10 req [T] >0', 'end time')
    call add_field(table, 'ENDCYC', 'I10 =0 >=0', 'last step; 0 = no limit')
    call add_field(table, 'DTMIN', 'R10 note', 'of explicit steps')
    call add_field(table, 'ENDENG', 'R10 =0.0 >=0', &
        'change of the energy ratio in per cent that fails the run; 0 = off')
    call add_field(table, 'ENDMAS', 'R10 note =1.0E8 0=d', 'of mass scaling')
    call add_field(table, 'NOSOL', 'I10 fixed')
    call add_keyword(table, 'CONTROL_IMPLICIT_GENERAL', 'the time step', &
        required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'IMFLAG', 'I10 =0 >=0', '1 = implicit; 0 = explicit: PBETA 0 of'// &
        ' *BIPACT_TIME, which may have 1 as well')
    call add_field(table, 'DT0', 'R10 =0.0 [T] >=0', &
        'time step; 0 = by TSSFAC of *CONTROL_TIMESTEP, explicit runs only')
    call add_field(table, 'IMFORM', 'I10 note =2 0=d', 'of springback')
    call add_field(table, 'NSBS', 'I10 fixed =1 0=d', 'steps of springback')
    call add_field(table, 'IGS', 'I10 fixed =2 0=d', '2 = without geometric stiffness')
    call add_field(table, 'CNSTN', 'I10 fixed', 'of plasticity')
    call add_field(table, 'FORM', 'I10 fixed', 'of springback')
    call add_field(table, 'ZERO_V', 'I10 fixed')
    call add_keyword(table, 'CONTROL_IMPLICIT_DYNAMICS', &
        'inertia, and gamma and beta of NEWMARK', required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'IMASS', 'I10 =0 >=0 <=1', &
        '1 = with inertia; 0 = static, time is the load parameter')
    call add_field(table, 'GAMMA', 'R10 =0.5 0=d >=0.5 <=1', 'gamma of NEWMARK')
    call add_field(table, 'BETA', 'R10 =0.25 0=d >=0 <=1', &
        'beta of NEWMARK, at least (gamma+1/2)^2/4')
    call add_field(table, 'TDYBIR', 'R10 =0.0 [T] >=0', 'static up to this time')
    call add_field(table, 'TDYDTH', 'R10 fixed [T] =1.0E28 0=d')
    call add_field(table, 'TDYBUR', 'R10 fixed [T] =1.0E28 0=d')
    call add_field(table, 'IRATE', 'I10 fixed')
    call add_field(table, 'ALPHA', 'R10 =0.0 <=0', 'alpha of HHT, from -1/3 to below 0')
    call add_card(table)
    call add_field(table, 'PSID', 'I10 fixed')
    call add_field(table, 'ANGLE', 'R10 note =90.0 0=d', 'of part rotations')
    call add_auto(table)
    call add_solution(table)
  end subroutine add_frame

  !> Steps that are halved where one is refused.
  subroutine add_auto(table)
    type(table_t), intent(inout) :: table
    integer :: k
    call add_keyword(table, 'CONTROL_IMPLICIT_AUTO', 'automatic steps', required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'IAUTO', 'I10 =0 >=0 <=1', '1 = MODE HALVE of *BIPACT_STEP')
    call add_field(table, 'ITEOPT', 'I10 ignored', 'wanted number of iterations')
    call add_field(table, 'ITEWIN', 'I10 ignored', 'window around it')
    call add_field(table, 'DTMIN', 'R10 =0.0 0=d [T] >=0', 'shortest step; 0 = DT0/1024')
    call add_field(table, 'DTMAX', 'R10 =0.0 0=d [T]', 'longest step: 0 or DT0')
    call add_field(table, 'DTEXP', 'R10 note', 'of a change to explicit steps')
    call add_field(table, 'KFAIL', 'I10 note', 'of a change to explicit steps')
    call add_field(table, 'KCYCLE', 'I10 note', 'of a change to explicit steps')
    call add_card(table)
    do k = 1, 8
      call add_field(table, '-', 'R10 ignored')
    end do
  end subroutine add_auto

  subroutine add_solution(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'CONTROL_IMPLICIT_SOLUTION', 'linear or not', required=1, &
        once=.true.)
    call add_card(table)
    call add_field(table, 'NSOLVR', 'I10 =1 0=d', &
        '1 small displacements, 12 finite deformation')
    call add_field(table, 'ILIMIT', 'I10 >=0', 'with NSOLVR 12: passes that one factor '// &
        'serves; 1 = full Newton; blank = while it converges well')
    call add_field(table, 'MAXREF', 'I10 >=0', 'with NSOLVR 12: factors of a step at most; '// &
        'blank = no limit')
    call add_field(table, 'DCTOL', 'R10 >=0', 'with NSOLVR 12: largest correction over the '// &
        'largest motion of the step; blank = 1e-11')
    call add_nonlinear(table, 'ECTOL', 'R10 note =0.01 0=d')
    call add_field(table, 'RCTOL', 'R10 >=0', 'with NSOLVR 12: what is left of the balance '// &
        'over the largest nodal force; blank = not asked')
    call add_nonlinear(table, 'LSTOL', 'R10 note =0.9 0=d')
    call add_field(table, 'ABSTOL', 'R10', 'with NSOLVR 12: size of what may be left in '// &
        'any case; blank = 0 [F]')
    call add_card(table)
    call add_nonlinear(table, 'DNORM', 'I10 note =2 0=d >=0')
    call add_nonlinear(table, 'DIVERG', 'I10 note =1 0=d')
    call add_nonlinear(table, 'ISTIF', 'I10 note =1 0=d')
    call add_nonlinear(table, 'NLPRINT', 'I10 note')
    call add_nonlinear(table, 'NLNORM', 'R10 note =2.0 0=d')
    call add_nonlinear(table, 'D3ITCTL', 'I10 note')
    call add_nonlinear(table, 'CPCHK', 'I10 note')
    call add_card(table)
    call add_field(table, 'ARCCTL', 'I10 fixed', 'arc length')
    call add_nonlinear(table, 'ARCDIR', 'I10 note =1 0=d')
    call add_nonlinear(table, 'ARCLEN', 'R10 note')
    call add_nonlinear(table, 'ARCMTH', 'I10 note =1 0=d')
    call add_nonlinear(table, 'ARCDMP', 'I10 note =2 0=d')
    call add_nonlinear(table, 'ARCPSI', 'R10 note')
    call add_nonlinear(table, 'ARCALF', 'R10 note')
    call add_nonlinear(table, 'ARCTIM', 'R10 note')
    call add_card(table)
    call add_nonlinear(table, 'LSMTD', 'I10 note =4 0=d')
    call add_nonlinear(table, 'LSDIR', 'I10 note =2 0=d')
    call add_nonlinear(table, 'IRAD', 'R10 note')
    call add_nonlinear(table, 'SRAD', 'R10 note')
    call add_nonlinear(table, 'AWGT', 'R10 note')
    call add_nonlinear(table, 'SRED', 'R10 note')
  end subroutine add_solution

  !> A field that only solves with iterations over the deformation would use.
  subroutine add_nonlinear(table, name, spec)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, spec
    call add_field(table, name, spec, 'of nonlinear solves')
  end subroutine add_nonlinear

  !> The step of explicit runs; fields of mass scaling must be blank.
  subroutine add_control_timestep(table)
    type(table_t), intent(inout) :: table
    integer :: k
    call add_keyword(table, 'CONTROL_TIMESTEP', &
        'the step of explicit runs; of others it has no effect', required=1)
    call add_card(table)
    call add_field(table, 'DTINIT', 'R10 ignored')
    call add_field(table, 'TSSFAC', 'R10 =0.9 0=d', &
        'explicit runs with a blank DT0: share of the limit of the elements, at most 1')
    call add_field(table, 'ISDO', 'I10 ignored')
    call add_field(table, 'TSLIMT', 'R10 fixed', 'moduli are never changed')
    call add_field(table, 'DT2MS', 'R10 fixed', 'masses are never changed')
    call add_field(table, 'LCTM', 'I10 ignored', 'explicit runs: blank; steps are equal')
    call add_field(table, 'ERODE', 'I10 fixed', 'elements are never deleted')
    call add_field(table, 'MS1ST', 'I10 ignored', 'of mass scaling')
    call add_card(table)
    call add_field(table, 'DT2MSF', 'R10 fixed', 'masses are never changed')
    call add_field(table, 'DT2MSLC', 'I10 fixed', 'masses are never changed')
    call add_field(table, 'IMSCL', 'I10 fixed', 'masses are never changed')
    call add_field(table, '-', 'R10 ignored')
    call add_field(table, '-', 'R10 ignored')
    call add_field(table, 'RMSCL', 'R10 fixed', 'masses are never changed')
    call add_field(table, 'EMSCL', 'R10 fixed', 'masses are never changed')
    call add_field(table, '-', 'R10 ignored')
    call add_card(table)
    do k = 1, 8
      call add_field(table, '-', 'R10 ignored')
    end do
  end subroutine add_control_timestep

end module deck_keywords
