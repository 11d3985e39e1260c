! SPDX-License-Identifier: BSD-3-Clause
!> What the first rank can ask of the others: the first number of the header of each message.
module mpi_tasks
  use, intrinsic :: iso_c_binding, only: c_bool
  use, intrinsic :: iso_fortran_env, only: int16
  implicit none
  private

  integer, parameter, public :: task_leave = 0, task_share = 1, task_forces = 2, &
      task_weighted_forces = 3, task_list_forces = 4, task_list_products = 5, &
      task_products = 6, task_assemble = 7, task_largest = 8, task_analyse = 9, &
      task_factor = 10, task_condense = 11, task_expand = 12, task_close = 13, &
      task_measure = 14

  !> Kinds of lists as long as the graph: ranks, and yes or no.
  integer, parameter, public :: i2 = int16, l1 = c_bool

  !> Factors at a time: of two stages, and a new one before the old one goes.
  integer, parameter, public :: most_engines = 8

end module mpi_tasks
