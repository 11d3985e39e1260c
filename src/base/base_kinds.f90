! SPDX-License-Identifier: BSD-3-Clause
!> Kinds and the few constants that every layer shares.
module base_kinds
  use, intrinsic :: iso_fortran_env, only: int32, int64, real64
  implicit none
  private
  integer, parameter, public :: wp = real64
  integer, parameter, public :: i4 = int32
  integer, parameter, public :: i8 = int64
  real(wp), parameter, public :: zero = 0.0_wp
  real(wp), parameter, public :: half = 0.5_wp
  real(wp), parameter, public :: one = 1.0_wp
  real(wp), parameter, public :: two = 2.0_wp
end module base_kinds
