! SPDX-License-Identifier: BSD-3-Clause
!> The tile of linalg_tile for processors with vectors of four numbers, which the Makefile
!> compiles this file for (without fused products): the same digits, twice as fast.
module linalg_tile_wide
  use base_kinds, only: wp, zero
  implicit none
  private
  public :: subtract_tile

  !> A tile: so many rows and columns, with so many columns of L at a time, which packed are
  !> 128 kB; the block of it that stays in registers.
  integer, parameter :: tile_rows = 64, tile_columns = 64, tile_depth = 128
  integer, parameter :: tall = 8, four = 4, five = 5

contains

  include 'linalg_tile.inc'

end module linalg_tile_wide
