! SPDX-License-Identifier: BSD-3-Clause
!> A strip of the product of two panels, for any processor.
module linalg_tile
  use base_kinds, only: wp, zero
  implicit none
  private
  public :: subtract_strip

  !> A strip: so many rows, by tiles of so many columns, with so many columns of L at a time,
  !> which packed are 128 kB; the block of it that stays in registers.
  integer, parameter, public :: strip_rows = 64, strip_columns = 64, depth_at_once = 128
  integer, parameter, public :: tall = 8, three = 3, four = 4, five = 5, seven = 7

contains

  include 'linalg_tile.inc'

end module linalg_tile
