! SPDX-License-Identifier: BSD-3-Clause
!> Symmetric tensors in space as their six components (11, 22, 33, 12, 23, 31), tensors of
!> fourth order as the 6 x 6 matrices of their components D_ijkl: what laws at finite strain
!> are written in. Engineering shear strains 2 E12 go with these as conjugates, so that D*e is
!> the whole double product.
module material_tensor
  use base_kinds, only: wp, zero, one, two, half
  implicit none
  private
  real(wp), parameter, public :: identity(6) = [one, one, one, zero, zero, zero]
  !> Indices i, j of the six components, and the component of a pair of indices.
  integer, parameter, public :: first_index(6) = [1, 2, 3, 1, 2, 3]
  integer, parameter, public :: second_index(6) = [1, 2, 3, 2, 3, 1]
  integer, parameter, public :: component(3, 3) = reshape([1, 4, 6, 4, 2, 5, 6, 5, 3], [3, 3])

  !> What laws of the invariants take from Green's strain E: C = I + 2 E, I3 = det C = J^2. All
  !> that vanishes with E has no cancellation: its error is relative to E.
  type, public :: measures_t
    logical :: exists = .false.          !< det C > least_determinant; else there is no more
    real(wp) :: i1 = zero                !< tr E
    real(wp) :: i2 = zero                !< ((tr E)^2 - E:E)/2
    real(wp) :: i3 = zero                !< det E
    real(wp) :: j = zero                 !< det C - 1
    real(wp) :: log_volume = zero        !< ln J
    real(wp) :: inverse(6) = zero        !< C^-1
    real(wp) :: change(6) = zero         !< C^-1 - I = -2 C^-1 E
  end type measures_t

  !> The least det C that laws have values for: far below, their powers overflow.
  real(wp), parameter, public :: least_determinant = 1.0e-20_wp

  public :: green_strain, trace, determinant, square, commuting_product, inverse, contraction, &
      outer, circle, circle_sum, measures_of, log_one_plus, exp_minus_one, log_excess, &
      exp_excess, spectrum, frame

contains

  !> Components of Green's strain from those with engineering shears.
  pure function green_strain(e) result(a)
    real(wp), intent(in) :: e(6)
    real(wp) :: a(6)
    a(:3) = e(:3)
    a(4:) = half*e(4:)
  end function green_strain

  !> Sum of the diagonal.
  pure real(wp) function trace(a)
    real(wp), intent(in) :: a(6)
    trace = a(1) + a(2) + a(3)
  end function trace

  !> Determinant.
  pure real(wp) function determinant(a)
    real(wp), intent(in) :: a(6)
    determinant = a(1)*(a(2)*a(3) - a(5)**2) - a(4)*(a(4)*a(3) - a(5)*a(6)) &
        + a(6)*(a(4)*a(5) - a(2)*a(6))
  end function determinant

  !> A A.
  pure function square(a) result(b)
    real(wp), intent(in) :: a(6)
    real(wp) :: b(6)
    b = commuting_product(a, a)
  end function square

  !> A B of tensors with the same axes, whose product is symmetric.
  pure function commuting_product(a, b) result(c)
    real(wp), intent(in) :: a(6), b(6)
    real(wp) :: c(6)
    c(1) = a(1)*b(1) + a(4)*b(4) + a(6)*b(6)
    c(2) = a(4)*b(4) + a(2)*b(2) + a(5)*b(5)
    c(3) = a(6)*b(6) + a(5)*b(5) + a(3)*b(3)
    c(4) = half*(a(1)*b(4) + a(4)*b(2) + a(6)*b(5) + b(1)*a(4) + b(4)*a(2) + b(6)*a(5))
    c(5) = half*(a(4)*b(6) + a(2)*b(5) + a(5)*b(3) + b(4)*a(6) + b(2)*a(5) + b(5)*a(3))
    c(6) = half*(a(6)*b(1) + a(5)*b(4) + a(3)*b(6) + b(6)*a(1) + b(5)*a(4) + b(3)*a(6))
  end function commuting_product

  !> A^-1 of a tensor with its determinant, which is not zero.
  pure function inverse(a, det) result(b)
    real(wp), intent(in) :: a(6), det
    real(wp) :: b(6)
    b = [a(2)*a(3) - a(5)**2, a(1)*a(3) - a(6)**2, a(1)*a(2) - a(4)**2, &
        a(5)*a(6) - a(3)*a(4), a(4)*a(6) - a(1)*a(5), a(4)*a(5) - a(2)*a(6)]/det
  end function inverse

  !> A:B.
  pure real(wp) function contraction(a, b)
    real(wp), intent(in) :: a(6), b(6)
    contraction = dot_product(a(:3), b(:3)) + two*dot_product(a(4:), b(4:))
  end function contraction

  !> (A x B)_ijkl = A_ij B_kl.
  pure function outer(a, b) result(d)
    real(wp), intent(in) :: a(6), b(6)
    real(wp) :: d(6, 6)
    integer :: m
    do m = 1, 6
      d(:, m) = a*b(m)
    end do
  end function outer

  !> (A o A)_ijkl = (A_ik A_jl + A_il A_jk)/2.
  pure function circle(a) result(d)
    real(wp), intent(in) :: a(6)
    real(wp) :: d(6, 6)
    d = half*circle_sum(a, a)
  end function circle

  !> A o B + B o A: (A_ik B_jl + A_il B_jk + B_ik A_jl + B_il A_jk)/2.
  pure function circle_sum(a, b) result(d)
    real(wp), intent(in) :: a(6), b(6)
    real(wp) :: d(6, 6)
    integer :: m, n, ik, jl, il, jk
    do n = 1, 6
      do m = 1, n
        ik = component(first_index(m), first_index(n))
        jl = component(second_index(m), second_index(n))
        il = component(first_index(m), second_index(n))
        jk = component(second_index(m), first_index(n))
        d(m, n) = half*((a(ik)*b(jl) + b(ik)*a(jl)) + (a(il)*b(jk) + b(il)*a(jk)))
        d(n, m) = d(m, n)
      end do
    end do
  end function circle_sum

  !> Invariants and inverse from Green's strain with engineering shears (6): det C - 1 = 2 i1 +
  !> 4 i2 + 8 i3.
  pure function measures_of(e) result(q)
    real(wp), intent(in) :: e(6)
    type(measures_t) :: q
    real(wp) :: green(6)
    green = green_strain(e)
    q%i1 = trace(green)
    q%i2 = green(1)*green(2) + green(2)*green(3) + green(3)*green(1) - sum(green(4:)**2)
    q%i3 = determinant(green)
    q%j = two*q%i1 + 4.0_wp*q%i2 + 8.0_wp*q%i3
    q%exists = one + q%j > least_determinant
    if (.not. q%exists) return
    q%log_volume = half*log_one_plus(q%j)
    q%inverse = inverse(identity + two*green, one + q%j)
    q%change = -two*commuting_product(q%inverse, green)
  end function measures_of

  !> ln(1 + x), x > -1, to the last digits also for small x (Goldberg 1991, theorem 4).
  elemental real(wp) function log_one_plus(x)
    real(wp), intent(in) :: x
    real(wp) :: w
    w = one + x
    log_one_plus = x
    if (abs(w - one) > zero) log_one_plus = x*(log(w)/(w - one))
  end function log_one_plus

  !> exp(x) - 1 to the last digits also for small x (Higham 2002, section 1.14.1, after Kahan).
  elemental real(wp) function exp_minus_one(x)
    real(wp), intent(in) :: x
    real(wp) :: w
    w = exp(x)
    exp_minus_one = x
    if (abs(x) > one) then
      exp_minus_one = w - one
    else if (abs(w - one) > zero) then
      exp_minus_one = (w - one)*(x/log(w))
    end if
  end function exp_minus_one

  !> x - ln(1 + x) >= 0, relative error of rounding: by ln(1 + x) = 2 artanh z, z = x/(2 + x),
  !> for small x, of which x^2/(2 + x) is taken out.
  elemental real(wp) function log_excess(x)
    real(wp), intent(in) :: x
    real(wp) :: z, square_z, term
    integer :: k
    if (abs(x) > 0.25_wp) then
      log_excess = x - log_one_plus(x)
      return
    end if
    z = x/(two + x)
    square_z = z*z
    term = zero
    do k = 19, 3, -2
      term = square_z*(term + one/real(k, wp))
    end do
    log_excess = x*z - two*z*term
  end function log_excess

  !> exp(x) - 1 - x >= 0, relative error of rounding: by its series for small x.
  elemental real(wp) function exp_excess(x)
    real(wp), intent(in) :: x
    integer :: k
    if (abs(x) > half) then
      exp_excess = exp_minus_one(x) - x
      return
    end if
    exp_excess = one
    do k = 15, 3, -1
      exp_excess = one + x/real(k, wp)*exp_excess
    end do
    exp_excess = half*x*x*exp_excess
  end function exp_excess

  !> Eigenvalues of a symmetric tensor and its unit axes, the columns of axis(3, 3), by turns in
  !> the three planes (Jacobi; Golub & Van Loan 1996, 8.4): equal eigenvalues need no care.
  pure subroutine spectrum(a, value, axis)
    real(wp), intent(in) :: a(6)
    real(wp), intent(out) :: value(3), axis(3, 3)
    integer, parameter :: most_sweeps = 12
    real(wp) :: b(3, 3), smallest
    integer :: i, sweep
    b = reshape([a(1), a(4), a(6), a(4), a(2), a(5), a(6), a(5), a(3)], [3, 3])
    axis = zero
    do i = 1, 3
      axis(i, i) = one
    end do
    smallest = 0.01_wp*epsilon(one)*maxval(abs(a))
    do sweep = 1, most_sweeps
      if (max(abs(b(1, 2)), abs(b(2, 3)), abs(b(3, 1))) <= smallest) exit
      call turn(b, axis, 1, 2, smallest)
      call turn(b, axis, 2, 3, smallest)
      call turn(b, axis, 1, 3, smallest)
    end do
    value = [b(1, 1), b(2, 2), b(3, 3)]
  end subroutine spectrum

  !> One turn, after which b(p, q) = 0.
  pure subroutine turn(b, axis, p, q, smallest)
    real(wp), intent(inout) :: b(3, 3), axis(3, 3)
    integer, intent(in) :: p, q
    real(wp), intent(in) :: smallest
    real(wp) :: ratio, t, c, s, x(3)
    integer :: r
    if (abs(b(p, q)) <= smallest) return
    ratio = half*(b(q, q) - b(p, p))/b(p, q)
    t = sign(one, ratio)/(abs(ratio) + sqrt(one + ratio**2))
    c = one/sqrt(one + t**2)
    s = t*c
    r = 6 - p - q
    b(p, p) = b(p, p) - t*b(p, q)
    b(q, q) = b(q, q) + t*b(p, q)
    b(p, q) = zero
    b(q, p) = zero
    x(:2) = [c*b(r, p) - s*b(r, q), s*b(r, p) + c*b(r, q)]
    b(r, p) = x(1)
    b(p, r) = x(1)
    b(r, q) = x(2)
    b(q, r) = x(2)
    x = axis(:, p)
    axis(:, p) = c*x - s*axis(:, q)
    axis(:, q) = s*x + c*axis(:, q)
  end subroutine turn

  !> R (6, 6) that takes components in the axes axis(:, A) to those in space: a = R a', D = R D'
  !> R^T; what is conjugate to stress, shears engineering, goes back by R^T.
  pure function frame(axis) result(r)
    real(wp), intent(in) :: axis(3, 3)
    real(wp) :: r(6, 6)
    integer :: m, n
    do n = 1, 6
      associate (a => axis(:, first_index(n)), b => axis(:, second_index(n)))
        do m = 1, 6
          r(m, n) = a(first_index(m))*b(second_index(m))
          if (n > 3) r(m, n) = r(m, n) + b(first_index(m))*a(second_index(m))
        end do
      end associate
    end do
  end function frame

end module material_tensor
