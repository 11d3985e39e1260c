! SPDX-License-Identifier: BSD-3-Clause
!> What a node in space sees of a boundary: of each facet the closest point, whether it stands
!> before the facet or beyond its rim, and the gap. All places are relative to the node, so that
!> small differences keep their digits.
module contact_sight
  use base_kinds, only: wp, zero, one
  use contact_closest, only: closest_on_facet, facet_weights, facet_tangents
  use contact_features, only: end_tolerance
  use contact_skin, only: skin_t
  use linalg_dense, only: cross
  implicit none
  private

  !> Where on its facet the closest point is.
  integer, parameter, public :: on_face = 0, on_edge = 1, on_vertex = 2

  !> A facet as a node sees it.
  type, public :: seen_t
    integer :: facet = 0
    real(wp) :: corner(3, 4) = zero    !< from the node [L]
    real(wp) :: weight(4) = zero       !< of the corners at the closest point
    real(wp) :: y(3) = zero            !< the closest point, from the node [L]
    real(wp) :: normal(3) = zero       !< outward, there
    real(wp) :: gap = zero             !< distance of the node in front of it [L]
    integer :: feature = on_face
    integer :: which = 0               !< edge of the net, or vertex
    logical :: is_before = .false.     !< the node stands before it, not beyond its rim
    logical :: is_kept = .false.       !< its place makes a row
    logical :: is_dropped = .false.    !< a sharp edge of it has the row, or its other facet
  end type seen_t

  !> A normal nearer than this to that of the reference is taken to be it (contact_features).
  real(wp), parameter :: same_normal = 1.0e-10_wp

  public :: see_facet, place_of_node, from_node, end_of_edge, distance_2, area_vector

contains

  !> Where a node sees from.
  pure function place_of_node(x, u, node) result(from)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: node
    real(wp) :: from(3, 2)
    from(:, 1) = x(:, node)
    from(:, 2) = u(:, node)
  end function place_of_node

  !> Place of a node k from another one, positions and displacements apart [L].
  pure function from_node(x, u, node, k) result(d)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer, intent(in) :: node, k
    real(wp) :: d(3)
    d = (x(:, k) - x(:, node)) + (u(:, k) - u(:, node))
  end function from_node

  !> A facet of the net at X + U as it is seen from a place (3, 2), reference and displacement
  !> [L]; is_reference: its normal is that of X.
  pure subroutine see_facet(skin, facet, x, u, from, is_reference, seen)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: facet
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(in) :: from(3, 2)
    logical, intent(in) :: is_reference
    type(seen_t), intent(inout) :: seen
    real(wp) :: at(2), n(3)
    integer :: k, m
    m = skin%corners(facet)
    seen%facet = facet
    do k = 1, m
      associate (i => skin%node(k, facet))
        seen%corner(:, k) = (x(:, i) - from(:, 1)) + (u(:, i) - from(:, 2))
      end associate
    end do
    call closest_on_facet(seen%corner(:, :m), [zero, zero, zero], at, seen%weight(:m))
    call find_feature(skin, m, at, seen)
    seen%y = matmul(seen%corner(:, :m), seen%weight(:m))
    if (is_reference) then
      seen%normal = normal_at(x(:, skin%node(:m, facet)), at)
    else
      n = normal_at(seen%corner(:, :m), at)
      seen%normal = skin%normal(:, facet)
      if (any(abs(n - seen%normal) > same_normal)) seen%normal = n
    end if
    seen%gap = -dot_product(seen%normal, seen%y)
    n = seen%y + seen%gap*seen%normal      ! across the normal
    seen%is_before = sum(n**2) <= (end_tolerance*skin%size(facet))**2
    seen%is_kept = .false.
    seen%is_dropped = .false.
  end subroutine see_facet

  !> Outward normal of a facet at a place of it.
  pure function normal_at(corner, at) result(n)
    real(wp), intent(in) :: corner(:, :), at(2)
    real(wp) :: n(3), a(3), b(3)
    call facet_tangents(corner, at, a, b)
    n = cross(a, b)
    n = n/max(norm2(n), tiny(one))
  end function normal_at

  !> The closest point is on the rim where it is there to round-off; then its weights are those
  !> of the edge or the vertex alone.
  pure subroutine find_feature(skin, m, at, seen)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: m
    real(wp), intent(inout) :: at(2)
    type(seen_t), intent(inout) :: seen
    logical :: on(4)                  ! edges of the facet that hold it
    integer :: k
    on = .false.
    if (m == 4) then
      where (at <= end_tolerance - one) at = -one
      where (at >= one - end_tolerance) at = one
      on = [at(2) <= -one, at(1) >= one, at(2) >= one, at(1) <= -one]
    else
      where (at <= end_tolerance) at = zero
      on(1:3) = [at(2) <= zero, at(1) + at(2) >= one - end_tolerance, at(1) <= zero]
      if (on(2)) at = at/sum(at)
    end if
    call facet_weights(at, seen%weight(:m))
    seen%feature = on_face
    if (.not. any(on)) return
    if (count(on) == 1) then
      seen%feature = on_edge
      k = findloc(on, .true., dim=1)
      seen%which = skin%edge_of(k, seen%facet)
      if (m == 3 .and. k == 2) seen%weight(1) = zero
    else
      seen%feature = on_vertex
      k = maxloc(seen%weight(:m), dim=1)
      seen%weight = zero
      seen%weight(k) = one
      seen%which = skin%at(skin%node(k, seen%facet))
    end if
  end subroutine find_feature

  !> Square of the distance of the node from the facet [L2].
  pure real(wp) function distance_2(seen)
    type(seen_t), intent(in) :: seen
    distance_2 = seen%y(1)**2 + seen%y(2)**2 + seen%y(3)**2
  end function distance_2

  !> Of an edge of the net: the closest point to a node, as a share s from its first end, and
  !> its place from the node [L].
  pure subroutine end_of_edge(skin, edge, x, u, node, s, y)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: edge, node
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(out) :: s, y(3)
    real(wp) :: a(3), t(3)
    a = from_node(x, u, node, skin%ends(1, edge))
    t = from_node(x, u, skin%ends(1, edge), skin%ends(2, edge))
    s = min(one, max(zero, -dot_product(a, t)/max(sum(t**2), tiny(one))))
    if (s <= end_tolerance) s = zero
    if (s >= one - end_tolerance) s = one
    y = a + s*t
  end subroutine end_of_edge

  !> Area vector of a facet at X + U, doubled [L2].
  pure function area_vector(skin, facet, x, u) result(n)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: facet
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp) :: n(3)
    associate (k => skin%node(:, facet))
      if (k(4) > 0) then
        n = cross(from_node(x, u, k(1), k(3)), from_node(x, u, k(2), k(4)))
      else
        n = cross(from_node(x, u, k(1), k(2)), from_node(x, u, k(1), k(3)))
      end if
    end associate
  end function area_vector

end module contact_sight
