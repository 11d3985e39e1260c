! SPDX-License-Identifier: BSD-3-Clause
!> The strip of linalg_tile for processors with vectors of four numbers, which the Makefile
!> compiles this file for (without fused products): the same digits, twice as fast.
module linalg_tile_wide
  use base_kinds, only: wp, zero
  use linalg_tile, only: strip_rows, strip_columns, depth_at_once, tall, three, four, five, &
      seven
  implicit none
  private
  public :: subtract_strip

contains

  include 'linalg_tile.inc'

end module linalg_tile_wide
