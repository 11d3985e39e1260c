! SPDX-License-Identifier: BSD-3-Clause
!> Structured contact problems of any size, of which something is known: bodies that do not
!> turn, each contact between two of them (0 = the ground, which does not move).
!>   STACK  blocks on each other under gravity: each contact carries what is above it
!>   CHAIN  one ball hits a row of balls that touch: they go on together
!>   CUPS   cups in each other, two contacts at each rim: forces are not unique, their resultant
!>          is the weight of what is above
module structured_contacts
  use base_kinds, only: wp, zero, one
  use cone_blocks, only: delassus_blocks_t, blocks_from_rows
  implicit none
  private
  public :: make_structure, misfit

  character(8), parameter, public :: structures(3) = [character(8) :: 'STACK', 'CHAIN', 'CUPS']
  real(wp), parameter :: gravity = 9.81_wp, slope = 0.5_wp

  type, public :: structure_t
    character(8) :: kind = ''
    integer, allocatable :: low(:), high(:)    !< bodies of a contact
    real(wp), allocatable :: mass(:)           !< of the bodies [M]
    real(wp), allocatable :: axis(:, :, :)     !< (d, d, contacts): rows n, t, s
    type(delassus_blocks_t) :: w
    real(wp), allocatable :: q(:, :), mu(:)
  end type structure_t

contains

  !> A structure of that many contacts (even for CUPS) of d components, random masses but in a
  !> chain.
  subroutine make_structure(kind, d, contacts, s)
    character(*), intent(in) :: kind
    integer, intent(in) :: d, contacts
    type(structure_t), intent(out) :: s
    real(wp), allocatable :: v(:, :)
    integer :: a, bodies
    s%kind = kind
    bodies = contacts
    if (kind == 'CUPS') bodies = contacts/2
    if (kind == 'CHAIN') bodies = contacts + 1
    allocate (s%low(contacts), s%high(contacts), s%mass(bodies), s%mu(contacts))
    allocate (s%axis(d, d, contacts), s%q(d, contacts), v(d, 0:bodies))
    call random_number(s%mass)
    s%mass = 0.5_wp + s%mass
    if (kind == 'CHAIN') s%mass = one
    s%mu = 0.4_wp
    v = zero
    v(1, 1:) = -gravity
    if (kind == 'CHAIN') v(1, :) = [zero, one, (zero, a=2, bodies)]
    do a = 1, contacts
      s%low(a) = a - 1
      s%high(a) = a
      if (kind == 'CHAIN') s%low(a) = a
      if (kind == 'CHAIN') s%high(a) = a + 1
      if (kind == 'CUPS') s%low(a) = (a - 1)/2
      if (kind == 'CUPS') s%high(a) = (a + 1)/2
      call set_axes(merge(slope*(-1)**a, zero, kind == 'CUPS'), s%axis(:, :, a))
      s%q(:, a) = matmul(s%axis(:, :, a), v(:, s%high(a)) - v(:, s%low(a)))
    end do
    call make_w(d, s)
  end subroutine make_structure

  !> Directions n, t, s of a contact turned by an angle about s.
  pure subroutine set_axes(angle, axis)
    real(wp), intent(in) :: angle
    real(wp), intent(out) :: axis(:, :)
    axis = zero
    axis(1, :2) = [cos(angle), sin(angle)]
    axis(2, :2) = [-sin(angle), cos(angle)]
    if (size(axis, 1) > 2) axis(3, 3) = one
  end subroutine set_axes

  !> W_ab = sum over shared bodies of +- axis_a axis_b' / mass.
  subroutine make_w(d, s)
    integer, intent(in) :: d
    type(structure_t), intent(inout) :: s
    real(wp), allocatable :: values(:), row(:, :)
    integer, allocatable :: pointer(:), columns(:)
    real(wp) :: block(d, d)
    integer :: a, b, i, j, k, nc
    nc = size(s%mu)
    allocate (pointer(d*nc + 1), columns(7*d*d*nc), values(7*d*d*nc), row(d, d))
    k = 0
    do a = 1, nc
      do i = 1, d
        pointer(d*(a - 1) + i) = k + 1
        do b = max(1, a - 3), min(nc, a + 3)
          block = shared_mass(s, a, b)*matmul(s%axis(:, :, a), transpose(s%axis(:, :, b)))
          if (.not. any(abs(block) > zero)) cycle
          do j = 1, d
            k = k + 1
            columns(k) = d*(b - 1) + j
            values(k) = block(i, j)
          end do
        end do
      end do
    end do
    pointer(d*nc + 1) = k + 1
    call blocks_from_rows(d, pointer, columns(:k), values(:k), s%w)
  end subroutine make_w

  !> Motion of contact a by a unit force at b, both along one axis.
  pure real(wp) function shared_mass(s, a, b)
    type(structure_t), intent(in) :: s
    integer, intent(in) :: a, b
    shared_mass = share(s, s%high(a), s%high(b)) + share(s, s%low(a), s%low(b)) &
        - share(s, s%high(a), s%low(b)) - share(s, s%low(a), s%high(b))
  end function shared_mass

  pure real(wp) function share(s, a, b)
    type(structure_t), intent(in) :: s
    integer, intent(in) :: a, b
    share = zero
    if (a == b .and. a > 0) share = one/s%mass(a)
  end function share

  !> How far the reactions r are from what is known of them, relative.
  pure real(wp) function misfit(s, r)
    type(structure_t), intent(in) :: s
    real(wp), intent(in) :: r(:, :)
    real(wp) :: exact(size(s%mass)), found(size(s%mass))
    integer :: a, n
    n = size(s%mass)
    found = zero
    do a = 1, size(s%mu)
      associate (row => merge(a, s%high(a), s%kind == 'CHAIN'))
        found(row) = found(row) + dot_product(s%axis(:, 1, a), r(:, a))
      end associate
    end do
    do a = 1, n
      exact(a) = gravity*sum(s%mass(a:))
      if (s%kind == 'CHAIN') exact(a) = real(n - a, wp)/n
    end do
    misfit = norm2(found - exact)/norm2(exact)
  end function misfit

end module structured_contacts
