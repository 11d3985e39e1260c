! SPDX-License-Identifier: BSD-3-Clause
!> Names that decks give to tables, fields and masses: the one place of each. The table of
!> keywords, the checks, the plan and the files take them from here.
module deck_names
  implicit none
  private
  integer, parameter, public :: table_glstat = 1, table_matsum = 2, table_nodout = 3, &
      table_elout = 4, table_rcforc = 5, table_sleout = 6, table_spcforc = 7, &
      table_ncforc = 8, table_timing = 9, table_rwforc = 10, table_rbdout = 11
  integer, parameter, public :: table_count = 11
  !> File name without .tab.
  character(7), parameter, public :: table_names(table_count) = [character(7) :: 'glstat', &
      'matsum', 'nodout', 'elout', 'rcforc', 'sleout', 'spcforc', 'ncforc', 'timing', &
      'rwforc', 'rbdout']
  !> Keyword that asks for it.
  character(16), parameter, public :: table_keywords(table_count) = [character(16) :: &
      'DATABASE_GLSTAT', 'DATABASE_MATSUM', 'DATABASE_NODOUT', 'DATABASE_ELOUT', &
      'DATABASE_RCFORC', 'DATABASE_SLEOUT', 'DATABASE_SPCFORC', 'DATABASE_NCFORC', &
      'BIPACT_TIMING', 'DATABASE_RWFORC', 'DATABASE_RBDOUT']

  !> Fields that a file of frames may hold.
  character(9), parameter, public :: field_names(12) = [character(9) :: 'U', 'V', 'FORCE', &
      'PRESSURE', 'GAP', 'STATUS', 'STRESS', 'ENERGY', 'PRINCIPAL', 'PART', 'STRETCH', &
      'PLASTIC']
  !> Those of finite deformation alone.
  character(9), parameter, public :: finite_fields(2) = [character(9) :: 'STRETCH', 'PLASTIC']

  !> Lengths of the steps: all DT0; halved where one is refused; cut where bodies touch.
  integer, parameter, public :: step_fixed = 1, step_halve = 2, step_event = 3
  character(5), parameter, public :: step_modes(3) = [character(5) :: 'FIXED', 'HALVE', 'EVENT']

  !> What becomes of bodies that overlap at the start: an error, nodes are moved, they are
  !> pushed out in a static phase.
  integer, parameter, public :: overlap_error = 1, overlap_adjust = 2, overlap_ramp = 3
  character(6), parameter, public :: overlaps(3) = [character(6) :: 'ERROR', 'ADJUST', 'RAMP']

  !> Mass matrices.
  character(10), parameter, public :: mass_names(3) = [character(10) :: 'CONSISTENT', &
      'LUMPED', 'DISPERSION']

  !> Internal force of a step at finite deformation.
  character(8), parameter, public :: force_names(3) = [character(8) :: 'EMC', 'PAPER', &
      'MIDPOINT']

  public :: choices

contains

  !> Words as a field of the table of keywords takes them: |A|B|.
  pure function choices(names) result(text)
    character(*), intent(in) :: names(:)
    character(:), allocatable :: text
    integer :: k
    text = '|'
    do k = 1, size(names)
      text = text//trim(names(k))//'|'
    end do
  end function choices

end module deck_names
