! SPDX-License-Identifier: BSD-3-Clause
!> Logarithmic strain e = (ln C)/2 for laws that are written in it: e in the axes of the
!> stretches, and the way from its conjugate stress T and moduli dT/de to S and dS/dE (Miehe,
!> Apel & Lambrecht 2002).
module material_logarithm
  use base_kinds, only: wp, zero, one, two, half
  use material_tensor, only: component, first_index, second_index, green_strain, outer, &
      spectrum, frame, log_one_plus, least_determinant
  implicit none
  private

  !> Stretches of a point and their axes.
  type, public :: stretches_t
    logical :: exist = .false.         !< all C > least_determinant; else there is no more
    real(wp) :: log_stretch(3) = zero
    real(wp) :: c(3) = zero            !< squares of the stretches
    real(wp) :: volume = zero          !< ln J
    real(wp) :: frame(6, 6) = zero     !< from these axes to those of space
  end type stretches_t

  public :: stretches_of, into_axes, to_reference

contains

  !> From Green's strain with engineering shears.
  pure function stretches_of(e) result(p)
    real(wp), intent(in) :: e(6)
    type(stretches_t) :: p
    real(wp) :: strain(3), axis(3, 3)
    call spectrum(green_strain(e), strain, axis)
    p%c = one + two*strain
    p%exist = minval(p%c) > least_determinant
    if (.not. p%exist) return
    p%log_stretch = half*log_one_plus(two*strain)
    p%volume = sum(p%log_stretch)
    p%frame = frame(axis)
  end function stretches_of

  !> Components in the axes of a frame: its inverse is its transpose but for the weight 2 of
  !> shears.
  pure function into_axes(frame, a) result(b)
    real(wp), intent(in) :: frame(6, 6), a(6)
    real(wp) :: b(6)
    b = a
    b(4:) = two*a(4:)
    b = matmul(b, frame)
    b(4:) = half*b(4:)
  end function into_axes

  !> From T, conjugate to e = (ln C)/2, to S, and d from dT/de to dS/dE, in space: with f[A,B],
  !> f[A,B,C] the difference quotients of ln at c_A, c_B, c_C, S_AB = T_AB f[A,B], D_ABCD =
  !> f[A,B] f[C,D] (dT/de)_ABCD + d_BD W^B_AC + d_BC W^B_AD + d_AD W^A_BC + d_AC W^A_BD, W^B_AC
  !> = T_AC f[A,B,C] (the second derivative of the logarithm: Miehe, Apel & Lambrecht 2002).
  pure subroutine to_reference(p, t, with_moduli, s, d)
    type(stretches_t), intent(in) :: p
    real(wp), intent(in) :: t(6)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: s(6)
    real(wp), intent(inout) :: d(6, 6)
    real(wp) :: f(6), second(3, 3, 3), w(3, 3, 3), own(6, 6)
    integer :: m, n, i, j, k, l
    do m = 1, 6
      f(m) = quotient(p%log_stretch(first_index(m)), p%log_stretch(second_index(m)))
    end do
    s = matmul(p%frame, f*t)
    if (.not. with_moduli) return
    second = second_quotients(p%c, f)
    do k = 1, 3
      do j = 1, 3
        do i = 1, 3
          w(i, k, j) = t(component(i, k))*second(i, k, j)   ! W^j_ik
        end do
      end do
    end do
    own = d*outer(f, f)
    do n = 1, 6
      k = first_index(n)
      l = second_index(n)
      do m = 1, 6
        i = first_index(m)
        j = second_index(m)
        if (j == l) own(m, n) = own(m, n) + w(i, k, j)
        if (j == k) own(m, n) = own(m, n) + w(i, l, j)
        if (i == l) own(m, n) = own(m, n) + w(j, k, i)
        if (i == k) own(m, n) = own(m, n) + w(j, l, i)
      end do
    end do
    d = matmul(p%frame, matmul(own, transpose(p%frame)))
  end subroutine to_reference

  !> (ln c_B - ln c_A)/(c_B - c_A), whatever their gap: from x = (ln c)/2, c_B - c_A = 2
  !> exp(x_A + x_B) sinh(x_B - x_A).
  pure real(wp) function quotient(xa, xb)
    real(wp), intent(in) :: xa, xb
    real(wp) :: gap
    gap = xb - xa
    quotient = exp(-xa - xb)
    if (abs(gap) > zero) quotient = quotient*(gap/sinh(gap))
  end function quotient

  !> Second difference quotients of ln at any three of c, from the first ones f (6).
  pure function second_quotients(c, f) result(second)
    real(wp), intent(in) :: c(3), f(6)
    real(wp) :: second(3, 3, 3), x
    integer :: i, j, k
    do k = 1, 3
      do j = 1, k
        do i = 1, j
          x = second_quotient(c([i, j, k]), f([component(j, k), component(k, i), &
              component(i, j)]))
          second(i, j, k) = x
          second(j, i, k) = x
          second(i, k, j) = x
          second(k, i, j) = x
          second(j, k, i) = x
          second(k, j, i) = x
        end do
      end do
    end do
  end function second_quotients

  !> One of them: f(m) is the first quotient of the two others of m. By the two that lie
  !> farthest apart; where these are near, by the series about the mean, whose first term left
  !> out is 1e-12 of the sum.
  pure real(wp) function second_quotient(c, f)
    real(wp), intent(in) :: c(3), f(3)
    real(wp), parameter :: near = 1.0e-3_wp
    real(wp) :: mean, y(3)
    integer :: low, high
    low = minloc(c, 1)
    high = maxloc(c, 1)
    mean = sum(c)/3.0_wp
    if (c(high) - c(low) < near*mean) then
      y = (c - mean)/mean
      second_quotient = (-half - sum(y**2)/8.0_wp + sum(y**3)/15.0_wp)/mean**2
    else
      second_quotient = (f(low) - f(high))/(c(high) - c(low))
    end if
  end function second_quotient

end module material_logarithm
