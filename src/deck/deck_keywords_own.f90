! SPDX-License-Identifier: BSD-3-Clause
!> The program's own keywords, *BIPACT_..., all optional, each at most once per deck.
module deck_keywords_own
  use cone_types, only: deck_solver_names, local_names
  use deck_names, only: table_keywords, table_timing, field_names, mass_names, step_modes, &
      overlaps, force_names, choices
  use deck_schemes, only: schemes
  use deck_table, only: table_t, add_keyword, add_card, add_field
  use linalg_order, only: order_names
  use linalg_registry, only: engine_names, engine_ranks
  use linalg_solver, only: name_length
  implicit none
  private
  public :: add_own_keywords

contains

  !> Adds the rows of the own keywords.
  subroutine add_own_keywords(table)
    type(table_t), intent(inout) :: table
    character(name_length), allocatable :: engines(:)
    call engine_names(engines)
    call add_keyword(table, 'BIPACT_TIME', 'time scheme', required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'SCHEME', 'W10 =THETA '//choices(schemes%name), 'time scheme')
    call add_field(table, 'THETA', 'R10 >=0.5 <=1', &
        'weight of the velocity at the end; blank = 0.5, or no theta at all')
    call add_field(table, 'XI', 'R10 >=0.5 <=1', &
        'weight of the forces at the end; blank = THETA')
    call add_field(table, 'REST', 'R10 >=0 <=1', 'restitution of contact nodes; blank = 0')
    call add_field(table, 'RHOINF', 'R10 >=0 <=1', &
        'spectral radius at infinite frequency; blank = 0.8')
    call add_field(table, 'RULE', 'W10 |SAFE|PLAIN|', &
        'of MOREAU; SAFE: normal work is never positive; blank = SAFE')
    call add_field(table, 'PBETA', 'R10 >=0 <=0.25', &
        'beta of PAOLI: 0.25, implicit, or 0, explicit; blank = 0.25')
    call add_keyword(table, 'BIPACT_STATIC', 'statics of bodies held by contact alone', &
        required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'SHIFT', 'R10 =1.0E-3 >0 <=1', 'of the passes, / (c/L)^2 M')
    call add_field(table, 'MAXPASS', 'I10 =60 >0', 'most passes of a load step')
    call add_field(table, 'RES', 'R10 =1.0E-10 >0 <=0.01', 'residual force / sum of the loads')
    call add_kinematics(table)
    call add_keyword(table, 'BIPACT_MASS', 'mass matrix', required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'TYPE', 'W10 =CONSISTENT '//choices(mass_names), 'mass matrix')
    call add_field(table, 'REDIST', 'I10 =0 >=0 <=1', '1 = massless contact nodes')
    call add_field(table, 'COURANT', 'R10 >=0 <=1', 'of DISPERSION; blank = from DT0')
    call add_field(table, 'WAVE', 'W10 |P|S|', &
        'of DISPERSION: pressure waves; shear waves (space); blank = P')
    call add_field(table, 'DX', 'R10', 'direction of travel of shear waves, x; of S alone')
    call add_field(table, 'DY', 'R10', 'its y')
    call add_field(table, 'DZ', 'R10', 'its z')
    call add_keyword(table, 'BIPACT_CONTACT', 'contact solver', required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'SOLVER', 'W10 =AUTO '//choices(deck_solver_names), &
        'AUTO: the cheapest that converges; GS: sweeps alone')
    call add_field(table, 'TOL', 'R10 =1.0E-10 >0 <=0.01', 'of the certificate')
    call add_field(table, 'MAXIT', 'I10 =10000 >0', 'most sweeps of a solve')
    call add_field(table, 'RHO', 'R10 =1.0 >0 <2', 'factor on 1/lmax(W_aa)')
    call add_field(table, 'LOCAL', 'W10 ='//trim(local_names(1))//' '//choices(local_names), &
        'solver of one contact')
    call add_field(table, 'LTOL', 'R10 =0.01 >0 <=1', 'looseness of the local solves')
    call add_field(table, 'LMAXIT', 'I10 =50 >0', 'most local iterations')
    call add_field(table, 'WARM', 'I10 =1 >=0 <=1', &
        '1 = start from the reactions of the last step')
    call add_card(table)
    call add_field(table, 'WSTORE', 'W10 =AUTO |AUTO|DENSE|BLOCK|NONE|', &
        'W whole; its near part and solves; solves alone; AUTO: by the bytes of a step')
    call add_field(table, 'FRAME', 'W10 |START|MID|REF|', &
        'normals: start of the step (blank: MID at curved walls), its middle, reference')
    call add_field(table, 'PENTOL', 'R10 =1.0E-9 >0 <=0.01', &
        'accepted penetration / segment length')
    call add_field(table, 'ROTWARN', 'R10 =5.0 >0', 'degrees of rotation that are warned of')
    call add_field(table, 'DFIRST', 'I10 =0 >=0', &
        'first step whose contact problem is written; 0 = none')
    call add_field(table, 'DLAST', 'I10 =0 >=0', 'last such step; 0 = DFIRST')
    call add_field(table, 'DEVERY', 'I10 =1 >0', 'every so many steps')
    call add_linear_solver(table, engines)
    call add_keyword(table, 'BIPACT_LEDGER', 'energy ledger', required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'EVERY', 'I10 =0 >=0', 'steps between evaluations; 0 = with GLSTAT')
    call add_field(table, 'GROWTH', 'R10 =1.0E-9 >0', 'growth / largest term that is warned of')
    call add_field(table, 'ACTION', 'W10 =WARN |WARN|STOP|', 'what growth does to the run')
    call add_keyword(table, trim(table_keywords(table_timing)), 'table TIMING', required=1, &
        once=.true.)
    call add_card(table)
    call add_field(table, 'DT', 'R10 =0.0 [T] >=0', 'interval; 0 = off')
    call add_keyword(table, 'BIPACT_PAIR', 'what the sides of a contact are', required=1, &
        repeat_from=1)
    call add_card(table)
    call add_field(table, 'CID', 'I10 req >0', 'contact: its id, or its number in the deck')
    call add_field(table, 'SIDE', 'W10 =AUTO |AUTO|A|B|BOTH|', &
        'whose nodes are exact, AUTO: of the locally finer side; MORTAR: who has multipliers')
    call add_field(table, 'ATYP', 'W10 |PART|PARTSET|NODESET|SEGSET|', 'what SURFA is')
    call add_field(table, 'BTYP', 'W10 |PART|PARTSET|NODESET|SEGSET|', 'what SURFB is')
    call add_field(table, 'REST', 'R10 >=0 <=1', &
        'restitution of its contact nodes; blank = REST of *BIPACT_TIME')
    call add_field(table, 'PAIRING', 'W10 =NODE |NODE|MORTAR|', &
        'rows of nodes, or of dual multipliers on faces')
    call add_field(table, 'QUAD', 'I10 fixed')
    call add_field(table, 'OVERLAP', 'W10 =ERROR '//choices(overlaps), 'overlap at the '// &
        'start: an error, contactor nodes are moved onto the obstacle, pushed out in statics')
    call add_step_keyword(table)
    call add_storage_keywords(table)
  end subroutine add_own_keywords

  !> Engines: the names of linalg_registry.
  subroutine add_linear_solver(table, engines)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: engines(:)
    call add_keyword(table, 'BIPACT_SOLVER', 'linear solver', required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'ENGINE', 'W10 =AUTO '// &
        choices([character(name_length) :: 'AUTO', engines, engine_ranks]), &
        'factor; MUMPS: of bipact-mpi')
    call add_field(table, 'ORDER', 'W10 =AUTO '// &
        choices([character(name_length) :: 'AUTO', order_names]), &
        'elimination order; AUTO: fewest flops')
    call add_field(table, 'SCHUR', 'W10 =AUTO |AUTO|YES|', 'contact dofs last')
    call add_field(table, 'NLAST', 'I10 =600 >0', 'largest contact block (dofs) without a note')
    call add_field(table, 'CGTOL', 'R10 =1.0E-12 >0 <=0.001', &
        'ENGINE CG: residual over right-hand side')
    call add_field(table, 'CGMAX', 'I10 =1000 >0', 'ENGINE CG: iterations of a solve at most')
    call add_field(table, 'THREADS', 'I10 =1 >0 <=1024', &
        'threads of factor, solves and element loops')
  end subroutine add_linear_solver

  subroutine add_kinematics(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'BIPACT_KINEMATICS', 'finite deformation (NSOLVR 12)', &
        required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'FORCE', 'W10 '//choices(force_names), &
        'internal force of a step of THETA; blank = EMC')
    call add_field(table, 'LAW', 'W10 |SVK|HENCKY|', 'of *MAT_ELASTIC; blank = SVK')
    call add_field(table, 'QP0', 'W10 =AUTO |AUTO|0|1|', &
        'mean dilatation: as the law, none, all')
  end subroutine add_kinematics

  !> Length of the steps.
  subroutine add_step_keyword(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'BIPACT_STEP', 'length of the steps', required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'MODE', 'W10 =FIXED '//choices(step_modes), &
        'all DT0; halved where one is refused; cut where bodies touch')
    call add_field(table, 'DTMIN', 'R10 [T] >0', 'shortest step of HALVE; blank = DT0/1024')
    call add_field(table, 'DTMAX', 'R10 fixed', 'no step is longer than DT0')
    call add_field(table, 'TOL', 'R10 fixed', 'steps by an estimate of their error')
    call add_field(table, 'MAXHALF', 'I10 >=0 <=20', 'most halvings of DT0; blank = 10')
  end subroutine add_step_keyword

  !> Field files and restart files.
  subroutine add_storage_keywords(table)
    type(table_t), intent(inout) :: table
    integer :: k
    call add_keyword(table, 'BIPACT_FIELD', 'field files (doc/output.md)', required=1, &
        repeat_from=2, once=.true.)
    call add_card(table)
    call add_field(table, 'DT', 'R10 =0.0 [T] >=0', 'interval; 0 = off')
    call add_field(table, 'PSID', 'I10 =0 >=0', 'part set; 0 = all parts')
    call add_field(table, 'COMPR', 'I10 =0 >=0 <=9', 'compression; 0 = none')
    call add_field(table, 'PREC', 'I10 =64 >=32 <=64', 'bits of a number: 64 or 32')
    call add_field(table, 'TBEG', 'R10 =0.0 [T] >=0', 'first time')
    call add_field(table, 'TEND', 'R10 [T] >=0', 'last time; blank = ENDTIM')
    call add_card(table)
    do k = 1, 8
      call add_field(table, 'NAME'//achar(48 + k), 'W10 '// &
          choices([character(9) :: field_names, 'ALL']), 'a field; no card 2: U, V, STRESS')
    end do
    call add_keyword(table, 'BIPACT_RESTART', 'restart files, one of the end of the run too', &
        required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'NSTEP', 'I10 =0 >=0', 'every so many steps; 0 = not so')
    call add_field(table, 'WALL', 'R10 =0.0 >=0', 'every so many seconds of the clock')
    call add_field(table, 'KEEP', 'I10 =2 >0', 'files that are kept')
    call add_field(table, 'ONSIG', 'I10 =1 >=0 <=1', &
        '1 = on SIGTERM and SIGINT before the run stops, and on SIGUSR1')
    call add_keyword(table, 'DATABASE_BINARY_D3PLOT', 'as *BIPACT_FIELD with DT and PSETID', &
        required=1, once=.true.)
    call add_card(table)
    call add_field(table, 'DT', 'R10 =0.0 [T] >=0', 'interval; 0 = off')
    call add_field(table, 'LCDT', 'I10 fixed', 'a curve of intervals')
    call add_field(table, 'BEAM', 'I10 ignored')
    call add_field(table, 'NPLTC', 'I10 fixed', 'a number of frames')
    call add_field(table, 'PSETID', 'I10 =0 >=0', 'part set; 0 = all parts')
    call add_field(table, 'CID', 'I10 fixed', 'another coordinate system')
    call add_card(table)
    call add_field(table, 'IOOPT', 'I10 note', 'of a curve of intervals')
    call add_field(table, 'RATE', 'R10 note', 'of filters')
    call add_field(table, 'CUTOFF', 'R10 note', 'of filters')
    call add_field(table, 'WINDOW', 'R10 note', 'of filters')
    call add_field(table, 'TYPE', 'I10 note', 'of filters')
    call add_field(table, 'PSET', 'I10 note', 'of filters')
  end subroutine add_storage_keywords

end module deck_keywords_own
