! SPDX-License-Identifier: BSD-3-Clause
!> Forces on the nodes of a pairing for tables and fields, and the area that carries them:
!> that of the boundary which something faces.
module contact_area
  use base_kinds, only: wp, zero, one, two, half
  use cone_types, only: contact_open
  use contact_features, only: normal_between, difference
  use contact_pairing, only: pairing_t, node_forces_t, no_gap
  use contact_surface, only: surface_t
  use contact_types, only: contact_t
  use model_areas, only: ring_factors
  use model_data, only: model_t
  implicit none
  private
  public :: make_nodal, find_all_areas

contains

  !> Work space of the forces on nodes.
  subroutine make_nodal(d, pairing)
    integer, intent(in) :: d            ! components
    class(pairing_t), intent(inout) :: pairing
    integer :: n, m
    n = size(pairing%side(1)%node)
    m = size(pairing%side(2)%node)
    allocate (pairing%nodal)
    associate (nodal => pairing%nodal)
      nodal%node = [pairing%side(1)%node, pairing%side(2)%node]
      nodal%first = [0, n]
      allocate (nodal%side(n + m), nodal%area(n + m))
      allocate (nodal%force(d, n + m), nodal%before(d, n + m), nodal%normal(n + m))
      allocate (nodal%gap(n + m), nodal%slip(n + m), nodal%status(n + m))
      allocate (nodal%is_near(n + m), nodal%around(n + m))
      allocate (nodal%low(max(size(pairing%side(1)%length), size(pairing%side(2)%length))))
      allocate (nodal%high(size(nodal%low)))
      nodal%side(1:n) = 1
      nodal%side(n + 1:) = 2
      nodal%force = zero
      nodal%before = zero
      nodal%normal = zero
      nodal%gap = no_gap
      nodal%slip = zero
      nodal%status = contact_open
      nodal%area = zero
    end associate
  end subroutine make_nodal

  !> Areas of all pairings that keep forces on nodes.
  subroutine find_all_areas(model, contact, u)
    type(model_t), intent(in) :: model
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in), contiguous :: u(:, :)
    integer :: p
    do p = 1, size(contact%pairing)
      if (allocated(contact%pairing(p)%item%nodal)) &
          call find_areas(model, contact%pairing(p)%item, u)
    end do
  end subroutine find_all_areas

  !> Area of every near node at X + U: the integral of its shape function over the part of its
  !> edges that edges of the other side cover, times the thickness, around an axis times the
  !> circle. Where nearly nothing covers a node (a tip on a face), and at walls, half of the
  !> edges that face.
  subroutine find_areas(model, pairing, u)
    type(model_t), intent(in) :: model
    class(pairing_t), intent(inout) :: pairing
    real(wp), intent(in), contiguous :: u(:, :)
    integer :: s, t
    associate (nodal => pairing%nodal)
      nodal%area = zero
      nodal%is_near = nodal%gap < no_gap .or. nodal%normal > zero
    end associate
    do s = 1, 2
      if (size(pairing%side(s)%node) == 0) cycle
      t = 3 - s
      if (size(pairing%side(t)%node) == 0) t = s
      call cover_side(model, pairing%side(s), pairing%side(t), u, pairing%is_wall, &
          pairing%nodal%first(s), pairing%nodal)
    end do
    call pairing%weigh_nodes(model, pairing%nodal%area)
  end subroutine find_areas

  !> The areas of the nodes of a side, after the first ones of both sides.
  subroutine cover_side(model, own, other, u, is_wall, before, nodal)
    type(model_t), intent(in) :: model
    type(surface_t), intent(in) :: own, other
    real(wp), intent(in), contiguous :: u(:, :)
    logical, intent(in) :: is_wall
    integer, intent(in) :: before
    type(node_forces_t), intent(inout) :: nodal
    real(wp) :: share(2), second, thickness(2)
    integer :: e, k, n, node(2)
    nodal%around = zero
    do e = 1, size(own%length)
      if (.not. own%is_listed(e)) cycle
      do k = 1, 2
        node(k) = before + own%index(own%end_node(k, e))
      end do
      if (.not. (nodal%is_near(node(1)) .or. nodal%is_near(node(2)))) cycle
      thickness = model%part(own%part(e))%thickness
      n = 0
      if (.not. is_wall) &
          call covering(own, other, e, model%x, u, nodal%low, nodal%high, n)
      call integrate(nodal%low, nodal%high, n, share, second)
      if (model%is_axisymmetric) then
        associate (r => model%x(1, own%end_node(:, e)))
          share = two*acos(-one)*ring_shares(r, share, second)
          thickness = ring_factors(r)
        end associate
        nodal%area(node) = nodal%area(node) + share*own%length(e)
        nodal%around(node) = nodal%around(node) + half*own%length(e)*thickness
        cycle
      end if
      do k = 1, 2
        nodal%area(node(k)) = nodal%area(node(k)) + share(k)*own%length(e)*thickness(k)
        nodal%around(node(k)) = nodal%around(node(k)) + half*own%length(e)*thickness(k)
      end do
    end do
    do k = before + 1, before + size(own%node)
      if (nodal%area(k) < 1.0e-3_wp*nodal%around(k)) nodal%area(k) = nodal%around(k)
    end do
  end subroutine cover_side

  !> Parts of edge e, in its local coordinate, that edges of the other side cover: those that
  !> face it within half an edge.
  subroutine covering(own, other, e, x, u, low, high, n)
    type(surface_t), intent(in) :: own, other
    integer, intent(in) :: e
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(inout) :: low(:), high(:)
    integer, intent(out) :: n
    real(wp) :: normal(2), d(2), s(2), g(2), length
    integer :: f, k
    n = 0
    associate (a => own%end_node(1, e), b => own%end_node(2, e))
      normal = normal_between(x, u, a, b, .false.)
      d = difference(x, u, b, a)
      length = sqrt(sum(d**2))
      do f = 1, size(other%length)
        if (.not. other%is_listed(f)) cycle
        do k = 1, 2
          d = difference(x, u, other%end_node(k, f), a)
          s(k) = (-normal(2)*d(1) + normal(1)*d(2))/length
          g(k) = normal(1)*d(1) + normal(2)*d(2)
        end do
        if (max(s(1), s(2)) <= zero .or. min(s(1), s(2)) >= one) cycle
        if (min(abs(g(1)), abs(g(2))) > half*length) cycle
        if (dot_product(normal, normal_between(x, u, other%end_node(1, f), &
            other%end_node(2, f), .false.)) > -0.7_wp) cycle
        n = n + 1
        low(n) = max(zero, minval(s))
        high(n) = min(one, maxval(s))
      end do
    end associate
  end subroutine covering

  !> Integrals of (1 - s) r and s r from those of 1 - s, s and s^2, with r linear between r(1)
  !> and r(2).
  pure function ring_shares(r, share, second) result(weighted)
    real(wp), intent(in) :: r(2), share(2), second
    real(wp) :: weighted(2)
    weighted = [r(1)*(share(1) - share(2) + second) + r(2)*(share(2) - second), &
        r(1)*(share(2) - second) + r(2)*second]
  end function ring_shares

  !> Integrals of 1 - s and s over the union of intervals, and of s^2.
  pure subroutine integrate(low, high, n, share, second)
    real(wp), intent(inout) :: low(:), high(:)
    integer, intent(in) :: n
    real(wp), intent(out) :: share(2), second
    real(wp) :: a, b, end
    integer :: i, j
    share = zero
    second = zero
    do i = 2, n      ! by their beginnings
      a = low(i)
      b = high(i)
      j = i - 1
      do while (j > 0)
        if (low(j) <= a) exit
        low(j + 1) = low(j)
        high(j + 1) = high(j)
        j = j - 1
      end do
      low(j + 1) = a
      high(j + 1) = b
    end do
    end = zero
    do i = 1, n
      a = max(low(i), end)
      b = max(high(i), a)
      share(2) = share(2) + half*(b**2 - a**2)
      share(1) = share(1) + (b - a) - half*(b**2 - a**2)
      second = second + (b**3 - a**3)/3.0_wp
      end = max(end, b)
    end do
  end subroutine integrate

end module contact_area
