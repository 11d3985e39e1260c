! SPDX-License-Identifier: BSD-3-Clause
!> A tile of the product of two panels, for any processor.
module linalg_tile
  use base_kinds, only: wp, zero
  implicit none
  private
  public :: subtract_tile

  !> A tile: so many rows and columns, with so many columns of L at a time, which packed are
  !> 128 kB; the block of it that stays in registers.
  integer, parameter, public :: tile_rows = 64, tile_columns = 64
  integer, parameter :: tile_depth = 128, tall = 8, four = 4, five = 5

contains

  include 'linalg_tile.inc'

end module linalg_tile
