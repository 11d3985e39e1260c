! SPDX-License-Identifier: BSD-3-Clause
!> The linear solvers by name. To add one: its file, its `use`, its case.
module linalg_registry
  use base_status, only: status_t, fail, status_deck
  use linalg_solver, only: solver_t, solver_options_t
  use linalg_ldlt, only: ldlt_t
  use linalg_skyline, only: skyline_t
  implicit none
  private
  public :: make_solver

contains

  !> A solver of the wanted engine, with its options.
  subroutine make_solver(options, solver, status)
    type(solver_options_t), intent(in) :: options
    class(solver_t), allocatable, intent(out) :: solver
    type(status_t), intent(inout) :: status
    select case (trim(options%engine))
    case ('AUTO', 'LDLT')
      allocate (ldlt_t :: solver)
    case ('SKYLINE')
      allocate (skyline_t :: solver)
    case default
      call fail(status, status_deck, 'solver engine "'//trim(options%engine)// &
          '" is not available', hint='choose AUTO, LDLT or SKYLINE')
      return
    end select
    solver%options = options
  end subroutine make_solver

end module linalg_registry
