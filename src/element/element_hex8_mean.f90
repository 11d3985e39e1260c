! SPDX-License-Identifier: BSD-3-Clause
!> The hexahedron with mean dilatation: no volumetric locking, too soft in bending of one layer.
module element_hex8_mean
  use base_kinds, only: wp, zero
  use element_base, only: strain_matrix
  use element_hex8, only: hex8_t, new_hex8
  implicit none
  private

  type, extends(hex8_t), public :: hex8_mean_t
  contains
    procedure :: strains_at => hex8_mean_strains_at
  end type hex8_mean_t

  public :: new_hex8_mean

contains

  !> Its data.
  pure function new_hex8_mean() result(element)
    type(hex8_mean_t) :: element
    element%hex8_t = new_hex8()
    element%name = 'HEX8MEAN'
  end function new_hex8_mean

  !> B with the dilatation of each point replaced by its mean over the volume (Hughes 1980):
  !> (mean gradient - gradient)/3 is added to the three normal strains.
  pure subroutine hex8_mean_strains_at(this, x, xi, b, det_j)
    class(hex8_mean_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :), xi(:)
    real(wp), intent(out) :: b(:, :), det_j
    real(wp) :: n(8), dn(8, 3), mean(8, 3), points(3, 8), w(8), volume
    integer :: k, i, count
    call this%rule(count, points, w)
    mean = zero
    volume = zero
    do k = 1, count
      call this%gradients(x, points(:, k), n, dn, det_j)
      mean = mean + w(k)*det_j*dn
      volume = volume + w(k)*det_j
    end do
    mean = mean/volume
    call this%gradients(x, xi, n, dn, det_j)
    call strain_matrix(dn, b)
    do i = 1, 8
      do k = 1, 3
        b(1:3, 3*i - 3 + k) = b(1:3, 3*i - 3 + k) + (mean(i, k) - dn(i, k))/3.0_wp
      end do
    end do
  end subroutine hex8_mean_strains_at

end module element_hex8_mean
