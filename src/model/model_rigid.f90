! SPDX-License-Identifier: BSD-3-Clause
!> Rigid parts in the plane. A part is two nodes of its own: the centre of its mass, and a
!> rotor, whose first direction is k phi, phi the rotation and k = sqrt(J/m) the radius of
!> gyration, and whose second is held. Both have the mass m, so that m (|V_c|^2 + (k phi')^2)/2
!> is the kinetic energy and no matrix of the bodies knows of rotations. The nodes of its mesh
!> have no mass; they follow: x_i = c + R(phi) X_i.
!>   A step from phi_0 to phi_1 moves them by dU_i = dc + l_i k dphi with the lever
!>   l_i = f e_z x (R_0 + R_1) X_i/(2 k),  f = 2 tan(dphi/2)/dphi,
!> exactly; l_i = e_z x R_0 X_i/k is that of the start of the step. Forces on them act on the
!> part by the same levers.
module model_rigid
  use base_kinds, only: wp, zero, one, half
  implicit none
  private

  type, public :: rigid_t
    integer, allocatable :: part(:)        !< rows of the parts that they are named after
    integer, allocatable :: centre(:), rotor(:)  !< their nodes
    real(wp), allocatable :: mass(:)       !< [M]
    real(wp), allocatable :: radius(:)     !< of gyration [L]
    integer, allocatable :: node(:)        !< nodes that follow
    integer, allocatable :: of(:)          !< the rigid part of each of them
    real(wp), allocatable :: arm(:, :)     !< X_i of each of them, from the centre [L]
  end type rigid_t

  public :: rotations, find_levers, move_followers, place_followers, gather_forces

contains

  !> Rotations of all parts for displacements u (dim, nodes) [radians].
  pure function rotations(rigid, u) result(angle)
    type(rigid_t), intent(in) :: rigid
    real(wp), intent(in) :: u(:, :)
    real(wp) :: angle(size(rigid%part))
    angle = u(1, rigid%rotor)/rigid%radius
  end function rotations

  !> Levers (2, followers) [1] of a step in which the parts turn from the angles `start` by
  !> `turn`; with turn = 0 those of its start.
  pure subroutine find_levers(rigid, start, turn, lever)
    type(rigid_t), intent(in) :: rigid
    real(wp), intent(in) :: start(:), turn(:)
    real(wp), intent(out) :: lever(:, :)
    real(wp) :: c(size(turn)), s(size(turn)), share
    integer :: k, p
    do p = 1, size(turn)
      share = one
      if (abs(turn(p)) > zero) share = sin(half*turn(p))/(half*turn(p))
      c(p) = share*cos(start(p) + half*turn(p))/rigid%radius(p)
      s(p) = share*sin(start(p) + half*turn(p))/rigid%radius(p)
    end do
    do k = 1, size(rigid%node)
      p = rigid%of(k)
      lever(1, k) = -(s(p)*rigid%arm(1, k) + c(p)*rigid%arm(2, k))
      lever(2, k) = c(p)*rigid%arm(1, k) - s(p)*rigid%arm(2, k)
    end do
  end subroutine find_levers

  !> Motions of the followers, from those of centres and rotors in the same array (dim, nodes).
  pure subroutine move_followers(rigid, lever, x)
    type(rigid_t), intent(in) :: rigid
    real(wp), intent(in) :: lever(:, :)
    real(wp), intent(inout) :: x(:, :)
    integer :: k
    do k = 1, size(rigid%node)
      associate (p => rigid%of(k))
        x(:, rigid%node(k)) = x(:, rigid%centre(p)) + lever(:, k)*x(1, rigid%rotor(p))
      end associate
    end do
  end subroutine move_followers

  !> Displacements [L] and velocities [L/T] of the followers at the rotations in u.
  pure subroutine place_followers(rigid, u, v)
    type(rigid_t), intent(in) :: rigid
    real(wp), intent(inout) :: u(:, :), v(:, :)
    real(wp) :: lever(2, size(rigid%node)), angle(size(rigid%part))
    angle = rotations(rigid, u)
    call find_levers(rigid, 0*angle, angle, lever)
    call move_followers(rigid, lever, u)
    call find_levers(rigid, angle, 0*angle, lever)
    call move_followers(rigid, lever, v)
  end subroutine place_followers

  !> Forces (dim, nodes) [F] on followers become forces on centres and rotors.
  pure subroutine gather_forces(rigid, lever, f)
    type(rigid_t), intent(in) :: rigid
    real(wp), intent(in) :: lever(:, :)
    real(wp), intent(inout) :: f(:, :)
    integer :: k
    do k = 1, size(rigid%node)
      associate (i => rigid%node(k), p => rigid%of(k))
        f(:, rigid%centre(p)) = f(:, rigid%centre(p)) + f(:, i)
        f(1, rigid%rotor(p)) = f(1, rigid%rotor(p)) + dot_product(lever(:, k), f(:, i))
        f(:, i) = zero
      end associate
    end do
  end subroutine gather_forces

end module model_rigid
