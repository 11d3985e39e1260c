! SPDX-License-Identifier: BSD-3-Clause
!> The quadratic tetrahedron. Nodes 5 to 10 on the edges 12, 23, 31, 14, 24, 34, as in VTK.
module element_tet10
  use base_kinds, only: wp, zero, one, half
  use element_base, only: element_t, jacobian_at, gauss
  use element_curved, only: midpoints, quadratic_faces, linear_facets
  use element_tet4, only: tet_face, tet4_t, four_points
  implicit none
  private

  type, extends(element_t), public :: tet10_t
  contains
    procedure :: shape => tet10_shape
    procedure :: rule => tet10_rule
    procedure :: stiffness_rule => tet10_stiffness_rule
    procedure :: mass_rule => tet10_mass_rule
    procedure :: lumped_mass => tet10_lumped_mass
    procedure :: smallest_jacobian => tet10_smallest_jacobian
  end type tet10_t

  integer, parameter :: edge(2, 6) = reshape([1, 2, 2, 3, 3, 1, 1, 4, 2, 4, 3, 4], [2, 6])

  public :: new_tet10, tet10_places

contains

  !> Its data.
  pure function new_tet10() result(element)
    type(tet10_t) :: element
    element = tet10_t(name='TET10', dim=3, nodes=10, vtk=24)
    element%place = tet10_places()
    element%face = quadratic_faces(element%place, tet_face)
    element%facet = linear_facets(element%face)
  end function new_tet10

  !> Parametric coordinates (3, 10) of the nodes.
  pure function tet10_places() result(place)
    real(wp) :: place(3, 10)
    integer :: k
    place = zero
    do k = 1, 3
      place(k, k + 1) = one
    end do
    place(:, 5:10) = midpoints(place(:, 1:4), edge)
  end function tet10_places

  !> In volume coordinates l: l (2 l - 1) at corners, 4 l_a l_b on the edge ab.
  pure subroutine tet10_shape(this, xi, n, dn)
    class(tet10_t), intent(in) :: this
    real(wp), intent(in) :: xi(:)
    real(wp), intent(out) :: n(:), dn(:, :)
    type(tet4_t) :: straight
    real(wp) :: l(4), dl(4, 3)
    integer :: k
    call straight%shape(xi, l, dl)
    do k = 1, 4
      n(k) = l(k)*(2.0_wp*l(k) - one)
      dn(k, :) = (4.0_wp*l(k) - one)*dl(k, :)
    end do
    do k = 1, 6
      associate (a => edge(1, k), b => edge(2, k))
        n(4 + k) = 4.0_wp*l(a)*l(b)
        dn(4 + k, :) = 4.0_wp*(l(a)*dl(b, :) + l(b)*dl(a, :))
      end associate
    end do
  end subroutine tet10_shape

  !> Four points: exact to degree 2, which the strain energy of a straight one is.
  pure subroutine tet10_rule(this, points, xi, w)
    class(tet10_t), intent(in) :: this
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    call four_points(points, xi, w)
  end subroutine tet10_rule

  !> A curved one has the rule of the mass: its forces of constant strain are of degree 3.
  pure subroutine tet10_stiffness_rule(this, x, points, xi, w)
    class(tet10_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    if (is_straight(x)) then
      call this%rule(points, xi, w)
    else
      call this%mass_rule([gauss, gauss, gauss], points, xi, w)
    end if
  end subroutine tet10_stiffness_rule

  !> Are the mid nodes in the middle, but for what rounding of coordinates in a deck leaves?
  pure logical function is_straight(x)
    real(wp), intent(in) :: x(:, :)
    real(wp) :: off(3, 6)
    integer :: k
    off = abs(x(:, 5:10) - midpoints(x(:, 1:4), edge))
    is_straight = .true.
    do k = 1, 6
      is_straight = is_straight .and. maxval(off(:, k)) &
          <= 1.0e-6_wp*maxval(abs(x(:, edge(2, k)) - x(:, edge(1, k))))
    end do
  end function is_straight

  !> Fourteen points, exact to degree 5, weights positive (Walkington 2000): the mass of a
  !> straight one is of degree 4.
  pure subroutine tet10_mass_rule(this, a, points, xi, w)
    class(tet10_t), intent(in) :: this
    real(wp), intent(in) :: a(:)
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    real(wp), parameter :: near(2) = [0.31088591926330060980_wp, 0.092735250310891226402_wp]
    real(wp), parameter :: edgewise = 0.045503704125649649492_wp
    real(wp), parameter :: weight(3) = [0.018781320953002641800_wp, &
        0.012248840519393658257_wp, 0.0070910034628469110730_wp]
    integer :: i, k
    points = 14
    do i = 1, 2
      xi(1:3, 4*i - 3:4*i) = near(i)
      do k = 1, 3
        xi(k, 4*i - 3 + k) = one - 3.0_wp*near(i)
      end do
      w(4*i - 3:4*i) = weight(i)
    end do
    xi(1:3, 9:11) = edgewise
    xi(1:3, 12:14) = half - edgewise
    do k = 1, 3
      xi(k, 8 + k) = half - edgewise
      xi(k, 11 + k) = edgewise
    end do
    w(9:14) = weight(3)
  end subroutine tet10_mass_rule

  !> The diagonal of the consistent mass, scaled to the whole one (Hinton, Rock & Zienkiewicz
  !> 1976): row sums at corners are negative.
  pure function tet10_lumped_mass(this, x, density, thickness) result(mass)
    class(tet10_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: density
    real(wp), intent(in) :: thickness
    real(wp) :: mass(size(x, 2)), me(10, 10)
    integer :: k
    call this%mass(x, density, thickness, [gauss, gauss, gauss], me)
    mass = [(me(k, k), k=1, 10)]
    mass = mass*(sum(me)/sum(mass))
  end function tet10_lumped_mass

  !> At the points of the mass and at the nodes.
  pure function tet10_smallest_jacobian(this, x) result(j)
    class(tet10_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp) :: j, xi(3, 14), w(14)
    integer :: points
    call this%mass_rule([gauss, gauss, gauss], points, xi, w)
    j = min(jacobian_at(this, x, xi), jacobian_at(this, x, tet10_places()))
  end function tet10_smallest_jacobian

end module element_tet10
