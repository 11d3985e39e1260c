! SPDX-License-Identifier: BSD-3-Clause
!> The fan of facets round a vertex of a body in space: the normals of the facets, the edges
!> that leave it, the mean normal weighted by the angles there, whose sign tells inside from
!> outside (Baerentzen and Aanaes 2005).
module contact_fan
  use base_kinds, only: wp, zero, one
  use contact_features, only: degree
  use contact_sight, only: from_node
  use contact_skin, only: skin_t
  use linalg_dense, only: cross
  implicit none
  private

  type, public :: fan_t
    logical :: is_all = .false.            !< a node without a boundary: it faces everything
    logical :: is_reflex = .false.         !< an edge stands before the mean normal
    integer :: facets = 0, edges = 0
    real(wp), allocatable :: normal(:, :)  !< (3, *) outward at the vertex
    real(wp), allocatable :: size(:)       !< (*) of the facets [L]
    real(wp), allocatable :: edge(:, :)    !< (3, *) unit vectors from the vertex
    real(wp) :: mean(3) = zero             !< unit vector
  end type fan_t

  !> Sine by which an edge stands before the mean normal of a reflex vertex.
  real(wp), parameter :: reflex = sin(10.0_wp*degree)

  public :: size_fan, open_fan, faces_fan, supports

contains

  !> Room for the largest fan of a net.
  pure subroutine size_fan(skin, fan)
    type(skin_t), intent(in) :: skin
    type(fan_t), intent(inout) :: fan
    integer :: v, facets, edges
    facets = 1
    edges = 1
    do v = 1, skin%vertices
      facets = max(facets, skin%first_facet(v + 1) - skin%first_facet(v))
      edges = max(edges, skin%first_edge(v + 1) - skin%first_edge(v))
    end do
    if (allocated(fan%normal)) then
      if (size(fan%size) >= facets .and. size(fan%edge, 2) >= edges) return
      facets = max(facets, size(fan%size))
      edges = max(edges, size(fan%edge, 2))
      deallocate (fan%normal, fan%size, fan%edge)
    end if
    allocate (fan%normal(3, facets), fan%size(facets), fan%edge(3, edges))
  end subroutine size_fan

  !> The fan of a node at X + U, or at X.
  pure subroutine open_fan(skin, node, x, u, is_reference, fan)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: node
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    logical, intent(in) :: is_reference
    type(fan_t), intent(inout) :: fan
    real(wp) :: angle
    integer :: i, v
    v = skin%at(node)
    fan%is_all = v == 0
    fan%is_reflex = .false.
    fan%facets = 0
    fan%edges = 0
    if (fan%is_all) return
    fan%mean = zero
    do i = skin%first_facet(v), skin%first_facet(v + 1) - 1
      fan%facets = fan%facets + 1
      fan%size(fan%facets) = skin%size(skin%facet(i))
      call corner_normal(skin, skin%facet(i), node, x, u, is_reference, &
          fan%normal(:, fan%facets), angle)
      fan%mean = fan%mean + angle*fan%normal(:, fan%facets)
    end do
    fan%mean = fan%mean/max(norm2(fan%mean), tiny(one))
    do i = skin%first_edge(v), skin%first_edge(v + 1) - 1
      fan%edges = fan%edges + 1
      associate (d => fan%edge(:, fan%edges), &
          other => sum(skin%ends(:, skin%edge(i))) - node)
        d = x(:, other) - x(:, node)
        if (.not. is_reference) d = from_node(x, u, node, other)
        d = d/max(norm2(d), tiny(one))
        fan%is_reflex = fan%is_reflex .or. dot_product(d, fan%mean) > reflex
      end associate
    end do
  end subroutine open_fan

  !> Normal of a facet at one of its corners, and its angle there.
  pure subroutine corner_normal(skin, facet, node, x, u, is_reference, n, angle)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: facet, node
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    logical, intent(in) :: is_reference
    real(wp), intent(out) :: n(3), angle
    real(wp) :: a(3), b(3)
    integer :: k, m, after, before
    m = skin%corners(facet)
    k = findloc(skin%node(:m, facet), node, dim=1)
    after = skin%node(1 + mod(k, m), facet)
    before = skin%node(1 + mod(k + m - 2, m), facet)
    a = x(:, after) - x(:, node)
    b = x(:, before) - x(:, node)
    if (.not. is_reference) then
      a = from_node(x, u, node, after)
      b = from_node(x, u, node, before)
    end if
    n = cross(a, b)
    angle = atan2(norm2(n), dot_product(a, b))
    n = n/max(norm2(n), tiny(one))
  end subroutine corner_normal

  !> Does a plane with normal n face the vertex: do its edges leave the plane to the front, or
  !> fall behind it by a sine of no more than `beyond`? At a reflex vertex the mean normal alone
  !> is asked.
  pure logical function faces_fan(n, fan, beyond) result(faces)
    real(wp), intent(in) :: n(3), beyond
    type(fan_t), intent(in) :: fan
    faces = fan%is_all
    if (faces) return
    faces = dot_product(fan%mean, n) < zero
    if (faces .and. .not. fan%is_reflex) faces = supports(-n, fan%edge(:, :fan%edges), beyond)
  end function faces_fan

  !> Do all directions (3, *) stay behind the plane with normal n, to a sine?
  pure logical function supports(n, direction, beyond)
    real(wp), intent(in) :: n(3), direction(:, :), beyond
    integer :: k
    supports = .true.
    do k = 1, size(direction, 2)
      supports = supports .and. dot_product(n, direction(:, k)) <= beyond
    end do
  end function supports

end module contact_fan
