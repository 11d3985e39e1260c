! SPDX-License-Identifier: BSD-3-Clause
!> Mean dilatation at finite strain (Q1P0; Simo, Taylor & Pister 1985): an element has one
!> change of volume, th = sum w J / V, and its energy is sum w W(Cb) of Cb = (th/J)^(2/3) C.
!> Stress and moduli at a point are
!>   S = a Sb + (p J - q) Ci,  a = (th/J)^(2/3), q = Sb:Cb/3, p = sum w q / (V th),
!> with Sb, Db the law at Cb and Ci = C^-1; the tangent of the element has two vectors besides,
!> g and b: it is symmetric.
module solid_mean
  use base_kinds, only: wp, zero, one, two, half
  use material_base, only: material_t, leave_undefined
  use material_tensor, only: identity, contraction, circle, outer, measures_t, measures_of, &
      log_one_plus, exp_minus_one
  implicit none
  private
  integer, parameter :: most = 8     !< points of such elements

  !> What the tangent K = sum w [B' D B + geometric] has besides: b g' + g b' + z g g', with b
  !> and g summed over the points by B'.
  type, public :: coupling_t
    real(wp) :: g(6, most) = zero, b(6, most) = zero    !< (strains, points)
    real(wp) :: z = zero
  end type coupling_t

  public :: mean_response

contains

  !> Stress s (strains, points), moduli d and coupling where asked for, energy [F L] of an
  !> element with the weights of its points [L3], strains e (strains, points) and histories
  !> (states, points). place: which of the six strains in space they are; new: histories at
  !> these strains; whole_s (6, points): the stresses in space.
  pure subroutine mean_response(material, place, weight, e, history, with_moduli, s, d, &
      energy, new, coupling, whole_s)
    class(material_t), intent(in) :: material
    integer, intent(in) :: place(:)
    real(wp), intent(in) :: weight(:), e(:, :), history(:, :)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: s(:, :), d(:, :, :), energy, new(:, :)
    type(coupling_t), intent(inout), optional :: coupling
    real(wp), intent(out), optional :: whole_s(:, :)
    real(wp), dimension(6, size(weight)) :: whole, sb, cb, ci
    real(wp) :: db(6, 6, size(weight)), q(size(weight)), a(size(weight)), volume(size(weight))
    real(wp) :: th, p, density
    logical :: exists
    integer :: g
    whole = zero
    whole(place, :) = e
    call mean_volume(weight, whole, volume, th, ci, exists)
    if (.not. exists) then
      do g = 1, size(weight)
        call leave_undefined(s(:, g), d(:, :, g), energy)
      end do
      if (present(whole_s)) whole_s = energy
      new = history
      return
    end if
    energy = zero
    p = zero
    do g = 1, size(weight)
      call respond_scaled(material, whole(:, g), volume(g), th, history(:, g), with_moduli, &
          a(g), cb(:, g), sb(:, g), db(:, :, g), density, new(:, g))
      energy = energy + weight(g)*density
      q(g) = contraction(sb(:, g), cb(:, g))/3.0_wp
      p = p + weight(g)*q(g)
    end do
    p = p/(sum(weight)*(one + th))
    do g = 1, size(weight)
      associate (stress => a(g)*sb(:, g) + (p*(one + volume(g)) - q(g))*ci(:, g))
        s(:, g) = stress(place)
        if (present(whole_s)) whole_s(:, g) = stress
      end associate
    end do
    if (.not. present(coupling)) return
    coupling%z = zero
    do g = 1, size(weight)
      call add_moduli(place, weight(g)/sum(weight), a(g), th, volume(g), p, q(g), &
          cb(:, g), ci(:, g), sb(:, g), db(:, :, g), weight(g), d(:, :, g), &
          coupling%g(:size(place), g), coupling%b(:size(place), g), coupling%z)
    end do
  end subroutine mean_response

  !> J - 1 of the points, its mean, and C^-1.
  pure subroutine mean_volume(weight, e, volume, th, ci, exists)
    real(wp), intent(in) :: weight(:), e(:, :)
    real(wp), intent(out) :: volume(:), th, ci(:, :)
    logical, intent(out) :: exists
    type(measures_t) :: m
    integer :: g
    exists = .true.
    do g = 1, size(weight)
      m = measures_of(e(:, g))
      exists = exists .and. m%exists
      volume(g) = exp_minus_one(m%log_volume)
      ci(:, g) = m%inverse
    end do
    th = dot_product(weight, volume)/sum(weight)
  end subroutine mean_volume

  !> The law at Cb = a C, by its strain a E + (a - 1)/2 I, which keeps the digits.
  pure subroutine respond_scaled(material, e, volume, th, old, with_moduli, a, cb, sb, db, &
      density, new)
    class(material_t), intent(in) :: material
    real(wp), intent(in) :: e(6), volume, th, old(:)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: a, cb(6), sb(6), db(6, 6), density, new(:)
    real(wp) :: excess, eb(6)
    excess = exp_minus_one(two/3.0_wp*(log_one_plus(th) - log_one_plus(volume)))
    a = one + excess
    eb = a*e + half*excess*identity
    call material%respond(eb, old, with_moduli, sb, db, density, new)
    cb = identity
    cb(:3) = cb(:3) + two*eb(:3)
    cb(4:) = eb(4:)
  end subroutine respond_scaled

  !> Moduli of a point, its share of the coupling.
  pure subroutine add_moduli(place, share, a, th, volume, p, q, cb, ci, sb, db, weight, d, g, &
      b, z)
    integer, intent(in) :: place(:)
    real(wp), intent(in) :: share, a, th, volume, p, q, cb(6), ci(6), sb(6), db(6, 6), weight
    real(wp), intent(out) :: d(:, :), g(:), b(:)
    real(wp), intent(inout) :: z
    real(wp) :: m(6), mm, both(6), whole(6, 6), vector(6)
    m = matmul(db, [cb(:3), two*cb(4:)])
    mm = contraction(cb, m)
    both = m/3.0_wp + two/3.0_wp*sb
    whole = a**2*db - a*(outer(both, ci) + outer(ci, both)) &
        + (mm/9.0_wp + two/3.0_wp*q + p*(one + volume))*outer(ci, ci) &
        + two*(q - p*(one + volume))*circle(ci)
    d = whole(place, place)
    vector = share*(one + volume)*ci
    g = vector(place)
    vector = weight/(one + th)*(a*both - (mm/9.0_wp + two/3.0_wp*q)*ci)
    b = vector(place)
    z = z + weight*(mm/9.0_wp - q/3.0_wp)/(one + th)**2
  end subroutine add_moduli

end module solid_mean
