! SPDX-License-Identifier: BSD-3-Clause
!> What an element type offers: matrices of one element from plain arrays, no mesh. A type says
!> its shape functions, its quadrature and its faces; the rest follows here.
module element_base
  use base_kinds, only: wp, zero, one, two, half
  use linalg_dense, only: cross
  implicit none
  private
  !> Of an element, of a face, of a rule of integration, and strains at a point in space.
  integer, parameter, public :: most_nodes = 27, most_face_nodes = 9, most_points = 64, &
      most_strains = 6

  type, abstract, public :: element_t
    character(8) :: name = ''
    integer :: dim = 2
    integer :: nodes = 0
    integer :: vtk = 0                   !< its number in VTK
    integer, allocatable :: vtk_order(:) !< its nodes in the order of VTK, where that is another
    !> Its mass takes points +-a(i) of parametric direction i, so DISPERSION is defined for it.
    logical :: takes_dispersion = .false.
    !> Turned about the y axis, x the radius: weights are those of the whole ring, and the
    !> strain around the axis, u_x/x, is the fourth.
    logical :: is_ring = .false.
    !> (nodes of a face, faces) outward: in the plane edges with the element on their left, in
    !> space seen from outside counter-clockwise; 0 = this face has fewer nodes
    integer, allocatable :: face(:, :)
    !> Of an element with curved faces: the triangles or quadrilaterals by which contact sees
    !> them, (nodes of a facet, facets), as many for each face; else not allocated
    integer, allocatable :: facet(:, :)
    real(wp), allocatable :: place(:, :) !< of such: parametric coordinates (3, nodes) of nodes
  contains
    procedure(shape_i), deferred :: shape
    procedure(rule_i), deferred :: rule
    procedure :: stiffness_rule => element_stiffness_rule
    procedure :: mass_rule => element_mass_rule
    procedure :: gradients => element_gradients
    procedure :: strains_at => element_strains_at
    procedure :: strain_count
    procedure :: stiffness => element_stiffness
    procedure :: mass => element_mass
    procedure :: directions => element_directions
    procedure :: sizes
    procedure :: smallest_jacobian => element_smallest_jacobian
    procedure :: mean_strain_matrix => element_mean_strain_matrix
    procedure :: mean_strain => element_mean_strain
    procedure :: lumped_mass => element_lumped_mass
    procedure :: face_size
    procedure :: facets
    procedure :: facet_nodes
    procedure :: facets_a_face
  end type element_t

  !> An element in a list of elements of several kinds.
  type, public :: element_slot_t
    class(element_t), allocatable :: item
  end type element_slot_t

  abstract interface
    !> Shape functions n (nodes) at a parametric point xi (dim), and their derivatives there dn
    !> (nodes, dim).
    pure subroutine shape_i(this, xi, n, dn)
      import :: element_t, wp
      class(element_t), intent(in) :: this
      real(wp), intent(in) :: xi(:)
      real(wp), intent(out) :: n(:), dn(:, :)
    end subroutine shape_i
    !> Quadrature of the stiffness: points xi (dim, 1:points), weights w.
    pure subroutine rule_i(this, points, xi, w)
      import :: element_t, wp
      class(element_t), intent(in) :: this
      integer, intent(out) :: points
      real(wp), intent(out) :: xi(:, :), w(:)
    end subroutine rule_i
  end interface

  public :: strain_matrix, strains, jacobian_at, corner_points, gauss, circumference

  real(wp), parameter :: gauss = one/sqrt(3.0_wp)

contains

  !> Strains at a point: 3 in the plane, (exx, eyy, gxy); 6 in space, (exx, eyy, ezz, gxy, gyz,
  !> gzx).
  pure integer function strains(dim)
    integer, intent(in) :: dim
    strains = 3*(dim - 1)
  end function strains

  !> Of this element: four in a ring, (exx, eyy, gxy, ezz).
  pure integer function strain_count(this)
    class(element_t), intent(in) :: this
    strain_count = merge(4, strains(this%dim), this%is_ring)
  end function strain_count

  !> Of the circle that a point of a ring goes through [L]: from the shape functions n there and
  !> the nodes x (2, nodes).
  pure real(wp) function circumference(x, n)
    real(wp), intent(in) :: x(:, :), n(:)
    circumference = two*acos(-one)*dot_product(n, x(1, :))
  end function circumference

  !> Quadrature of the stiffness of an element of coordinates x (dim, nodes): the rule, unless
  !> the shape asks for another.
  pure subroutine element_stiffness_rule(this, x, points, xi, w)
    class(element_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    call this%rule(points, xi, w)
  end subroutine element_stiffness_rule

  !> Quadrature of the mass: that of the stiffness, whatever the points +-a(i) asked for in
  !> parametric direction i.
  pure subroutine element_mass_rule(this, a, points, xi, w)
    class(element_t), intent(in) :: this
    real(wp), intent(in) :: a(:)
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    call this%rule(points, xi, w)
  end subroutine element_mass_rule

  !> A point at each corner (dim, corners) of the reference element, its coordinate in direction
  !> i scaled by a(i); weights one. a = 1/sqrt(3) is Gauss' rule, a = 1 the lumped mass.
  pure subroutine corner_points(corner, a, points, xi, w)
    real(wp), intent(in) :: corner(:, :), a(:)
    integer, intent(out) :: points
    real(wp), intent(out) :: xi(:, :), w(:)
    integer :: k
    points = size(corner, 2)
    w(:points) = one
    do k = 1, points
      xi(:size(corner, 1), k) = a*corner(:, k)
    end do
  end subroutine corner_points

  !> Derivatives dn (nodes, dim) [1/L] of the shape functions in the coordinates x (dim, nodes)
  !> [L] at a parametric point, the determinant of the Jacobian there, and the shape functions.
  pure subroutine element_gradients(this, x, xi, n, dn, det_j)
    class(element_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :), xi(:)
    real(wp), intent(out) :: n(:), dn(:, :), det_j
    real(wp) :: local(size(x, 2), size(x, 1)), j(size(x, 1), size(x, 1))
    call jacobian(this, x, xi, n, local, j, det_j)
    if (size(x, 1) == 2) then
      dn(:, 1) = (local(:, 1)*j(2, 2) - local(:, 2)*j(2, 1))/det_j
      dn(:, 2) = (local(:, 2)*j(1, 1) - local(:, 1)*j(1, 2))/det_j
    else
      dn(:, :) = matmul(local, inverse(j, det_j))
    end if
  end subroutine element_gradients

  !> Derivatives j (dim, dim) [L] of the place by the parametric coordinates, the determinant,
  !> the shape functions n and their parametric derivatives local (nodes, dim).
  pure subroutine jacobian(this, x, xi, n, local, j, det_j)
    class(element_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :), xi(:)
    real(wp), intent(out) :: n(:), local(:, :), j(:, :), det_j
    integer :: a, b, k
    call this%shape(xi, n, local)
    ! From the first node: translations of the element then leave no trace in the digits.
    do b = 1, size(x, 1)
      do a = 1, size(x, 1)
        j(a, b) = zero
        do k = 2, size(x, 2)
          j(a, b) = j(a, b) + (x(a, k) - x(a, 1))*local(k, b)
        end do
      end do
    end do
    if (size(x, 1) == 2) then
      det_j = j(1, 1)*j(2, 2) - j(1, 2)*j(2, 1)
    else
      det_j = dot_product(j(:, 1), cross(j(:, 2), j(:, 3)))
    end if
  end subroutine jacobian

  !> Rows of the inverse are products of the columns.
  pure function inverse(j, det) result(i)
    real(wp), intent(in) :: j(:, :), det
    real(wp) :: i(3, 3)
    i(1, :) = cross(j(:, 2), j(:, 3))/det
    i(2, :) = cross(j(:, 3), j(:, 1))/det
    i(3, :) = cross(j(:, 1), j(:, 2))/det
  end function inverse

  !> B (strains, dim nodes) [1/L]: strains of unit displacements, dofs node by node, from the
  !> derivatives dn (nodes, dim).
  pure subroutine strain_matrix(dn, b)
    real(wp), intent(in) :: dn(:, :)
    real(wp), intent(out) :: b(:, :)
    integer :: k
    b = zero
    do k = 1, size(dn, 1)
      if (size(dn, 2) == 2) then
        b(1, 2*k - 1) = dn(k, 1)
        b(2, 2*k) = dn(k, 2)
        b(3, 2*k - 1) = dn(k, 2)
        b(3, 2*k) = dn(k, 1)
      else
        b(1, 3*k - 2) = dn(k, 1)
        b(2, 3*k - 1) = dn(k, 2)
        b(3, 3*k) = dn(k, 3)
        b(4, 3*k - 2:3*k - 1) = [dn(k, 2), dn(k, 1)]
        b(5, 3*k - 1:3*k) = [dn(k, 3), dn(k, 2)]
        b(6, 3*k - 2) = dn(k, 3)
        b(6, 3*k) = dn(k, 1)
      end if
    end do
  end subroutine strain_matrix

  !> B at a parametric point, and the determinant of the Jacobian there, of a ring times the
  !> circumference.
  pure subroutine element_strains_at(this, x, xi, b, det_j)
    class(element_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :), xi(:)
    real(wp), intent(out) :: b(:, :), det_j
    real(wp) :: n(size(x, 2)), dn(size(x, 2), size(x, 1))
    call this%gradients(x, xi, n, dn, det_j)
    call strain_matrix(dn, b)
    if (.not. this%is_ring) return
    b(4, 1::2) = n/dot_product(n, x(1, :))
    det_j = det_j*circumference(x, n)
  end subroutine element_strains_at

  !> Stiffness (dim nodes, dim nodes) [F/L], sum over the points of B' D B (Zienkiewicz & Taylor
  !> 2000, vol. 1, ch. 4): from coordinates x (dim, nodes) [L], moduli d (strains, strains)
  !> [F/L2], thickness [L] (1 in space).
  pure subroutine element_stiffness(this, x, d, thickness, ke)
    class(element_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: d(:, :)
    real(wp), intent(in) :: thickness
    real(wp), intent(out) :: ke(:, :)
    real(wp) :: xi(3, most_points), w(most_points), b(size(d, 1), size(x)), det_j
    integer :: k, points
    call this%stiffness_rule(x, points, xi, w)
    ke = zero
    do k = 1, points
      call this%strains_at(x, xi(:size(x, 1), k), b, det_j)
      call add_product(size(b, 1), size(b, 2), thickness*det_j*w(k), d, b, ke)
    end do
    ke = half*(ke + transpose(ke))
  end subroutine element_stiffness

  !> ke = ke + factor * B' D B.
  pure subroutine add_product(s, m, factor, d, b, ke)
    integer, intent(in) :: s, m
    real(wp), intent(in) :: factor, d(s, s), b(s, m)
    real(wp), intent(inout) :: ke(m, m)
    real(wp) :: db(s), total
    integer :: i, j, k
    do j = 1, m
      db = zero
      do k = 1, s
        db = db + d(:, k)*b(k, j)
      end do
      do i = 1, m
        total = zero
        do k = 1, s
          total = total + b(k, i)*db(k)
        end do
        ke(i, j) = ke(i, j) + factor*total
      end do
    end do
  end subroutine add_product

  !> Mass (nodes, nodes) [M] by the rule for points +-a(i) of parametric direction i: a =
  !> 1/sqrt(3) is the consistent mass, between that and 1 the modified rules of Guddati & Yue
  !> (2004).
  pure subroutine element_mass(this, x, density, thickness, a, me)
    class(element_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: density
    real(wp), intent(in) :: thickness
    real(wp), intent(in) :: a(:)
    real(wp), intent(out) :: me(:, :)
    real(wp) :: xi(3, most_points), w(most_points), n(size(x, 2)), dn(size(x, 2), size(x, 1))
    real(wp) :: det_j
    integer :: k, i, points
    call this%mass_rule(a, points, xi, w)
    me = zero
    do k = 1, points
      call this%gradients(x, xi(:size(x, 1), k), n, dn, det_j)
      if (this%is_ring) det_j = det_j*circumference(x, n)
      do i = 1, size(n)
        me(:, i) = me(:, i) + density*thickness*det_j*w(k)*n(i)*n
      end do
    end do
  end subroutine element_mass

  !> Vectors (dim, dim) from the centre of a face to that of the opposite one, a column for each
  !> parametric direction [L]; zero where the element has none.
  pure function element_directions(this, x) result(across)
    class(element_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp) :: across(size(x, 1), size(x, 1))
    across = zero
  end function element_directions

  !> Their lengths, the width h (dim) in each direction [L].
  pure function sizes(this, x) result(h)
    class(element_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp) :: h(size(x, 1)), across(size(x, 1), size(x, 1))
    integer :: k
    across = this%directions(x)
    h = [(sqrt(sum(across(:, k)**2)), k=1, size(h))]
  end function sizes

  !> Smallest determinant of the Jacobian at the points of its rule; not positive: wrong sense
  !> or degenerate.
  pure function element_smallest_jacobian(this, x) result(j)
    class(element_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp) :: j, xi(3, most_points), w(most_points)
    integer :: points
    call this%rule(points, xi, w)
    j = jacobian_at(this, x, xi(:size(x, 1), :points))
  end function element_smallest_jacobian

  !> Its smallest value at the points xi (dim, points).
  pure real(wp) function jacobian_at(this, x, xi) result(j)
    class(element_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :), xi(:, :)
    real(wp) :: n(size(x, 2)), local(size(x, 2), size(x, 1)), to_x(size(x, 1), size(x, 1))
    real(wp) :: det_j
    integer :: k
    j = huge(j)
    do k = 1, size(xi, 2)
      call jacobian(this, x, xi(:, k), n, local, to_x, det_j)
      j = min(j, det_j)
    end do
  end function jacobian_at

  !> Mean over the points of B.
  pure subroutine element_mean_strain_matrix(this, x, b)
    class(element_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(out) :: b(:, :)
    real(wp) :: xi(3, most_points), w(most_points), at_point(size(b, 1), size(b, 2)), det_j
    integer :: k, points
    call this%rule(points, xi, w)
    b = zero
    do k = 1, points
      call this%strains_at(x, xi(:size(x, 1), k), at_point, det_j)
      b = b + w(k)/sum(w(:points))*at_point
    end do
  end subroutine element_mean_strain_matrix

  !> Mean strain of displacements u (dim, nodes) [L]; a translation of the element is taken off
  !> first, of a ring one along its axis.
  pure function element_mean_strain(this, x, u) result(strain)
    class(element_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: u(:, :)
    real(wp) :: strain(this%strain_count()), b(size(strain), size(u)), part(size(strain))
    integer :: i, k, m
    call this%mean_strain_matrix(x, b)
    m = size(u, 1)
    strain = zero
    if (this%is_ring) strain = matmul(b(:, 1::2), u(1, :))
    do i = 2, size(u, 2)
      part = zero
      do k = merge(2, 1, this%is_ring), m
        part = part + b(:, m*(i - 1) + k)*(u(k, i) - u(k, 1))
      end do
      strain = strain + part
    end do
  end function element_mean_strain

  !> Lumped mass (nodes) [M]: row sums of the consistent one.
  pure function element_lumped_mass(this, x, density, thickness) result(mass)
    class(element_t), intent(in) :: this
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(in) :: density
    real(wp), intent(in) :: thickness
    real(wp) :: mass(size(x, 2)), me(size(x, 2), size(x, 2)), a(size(x, 1))
    integer :: k
    a = gauss
    call this%mass(x, density, thickness, a, me)
    do k = 1, size(x, 2)
      mass(k) = sum(me(:, k))
    end do
  end function element_lumped_mass

  !> Nodes of face f.
  pure integer function face_size(this, f)
    class(element_t), intent(in) :: this
    integer, intent(in) :: f
    face_size = count(this%face(:, f) > 0)
  end function face_size

  !> Linear pieces of its surface: its faces, or those that stand for curved ones.
  pure integer function facets(this)
    class(element_t), intent(in) :: this
    facets = size(this%face, 2)
    if (allocated(this%facet)) facets = size(this%facet, 2)
  end function facets

  !> Those of one face: the facets m (f - 1) + 1 to m f are of face f.
  pure integer function facets_a_face(this) result(m)
    class(element_t), intent(in) :: this
    m = this%facets()/size(this%face, 2)
  end function facets_a_face

  !> The nodes of one of them, outward.
  pure function facet_nodes(this, f) result(node)
    class(element_t), intent(in) :: this
    integer, intent(in) :: f
    integer, allocatable :: node(:)
    if (allocated(this%facet)) then
      node = this%facet(:, f)
    else
      node = this%face(:this%face_size(f), f)
    end if
  end function facet_nodes

end module element_base
