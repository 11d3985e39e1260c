! SPDX-License-Identifier: BSD-3-Clause
!> Edges and vertices of an obstacle in space that no facet has alone, before a node: at a
!> smooth one the mean normal, at a convex one the normal that the free motion chooses, in a
!> notch all its sides.
module contact_space_features
  use base_kinds, only: wp, zero, one
  use contact_fan, only: open_fan, faces_fan
  use contact_features, only: smooth_angle, end_tolerance
  use contact_places, only: view_t, narrow, beside
  use contact_sight, only: seen_t, from_node, on_edge, on_vertex
  use contact_skin, only: skin_t, dihedral
  use contact_space_corner, only: common_normals, choose_of, spread_of, most_normals
  use contact_space_view, only: space_sight_t, sine_of_facing, see, makes_row, touches, &
      add_shared_place, finish_edge, finish_vertex, size_before, allowance_in_space
  use linalg_dense, only: cross
  implicit none
  private

  public :: judge_edge, judge_vertex

contains

  !> What an edge between facets i and j of the list changes. s, y: its closest point.
  subroutine judge_edge(own, obstacle, node, e, i, j, s, y, f, x, u, view, sight)
    type(skin_t), intent(in) :: own, obstacle
    integer, intent(in) :: node, e, i, j
    real(wp), intent(in) :: s, y(3), f(3)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    real(wp) :: t(3), turn, direction(3, 4)
    integer :: first, second
    logical :: before(2), both_at
    first = merge(i, j, obstacle%beside(1, e) == sight%seen(i)%facet)
    second = i + j - first
    t = from_node(x, u, obstacle%ends(1, e), obstacle%ends(2, e))
    t = t/max(norm2(t), tiny(one))
    associate (a => sight%seen(first), b => sight%seen(second))
      turn = dihedral(a%normal, b%normal, t)
      before = [a%is_before, b%is_before]
      if (all(before) .and. turn <= smooth_angle) return
      ! The node is beside the edge, not beyond one of its ends.
      both_at = is_at(obstacle, a, e) .and. is_at(obstacle, b, e) .and. &
          abs(dot_product(y, t)) <= end_tolerance*min(obstacle%size(a%facet), &
          obstacle%size(b%facet))
      if (turn < -smooth_angle) then
        if (.not. (any(before) .or. both_at)) return
        if (.not. a%is_kept .and. is_at(obstacle, a, e)) &
            a%is_kept = makes_row(obstacle, a, view, sight%fan)
        if (.not. b%is_kept .and. is_at(obstacle, b, e)) &
            b%is_kept = makes_row(obstacle, b, view, sight%fan)
      else if (turn <= smooth_angle) then
        if (any(before) .or. .not. both_at) return
        call add_smooth_place(obstacle, node, e, s, y, a%normal + b%normal, &
            [a%facet, b%facet], view, sight)
      else
        if (.not. (any(before) .or. both_at)) return
        ! A wall holds, however deep, what stands on the far side of the top: not at this edge.
        if (before(1) .and. .not. before(2) .and. .not. is_at(obstacle, b, e)) return
        if (before(2) .and. .not. before(1) .and. .not. is_at(obstacle, a, e)) return
        direction(:, 1) = t
        direction(:, 2) = -t
        direction(:, 3) = cross(a%normal, t)
        direction(:, 4) = cross(t, b%normal)
        call judge_sharp_edge(own, obstacle, node, e, first, second, s, y, f, direction, view, &
            sight)
      end if
    end associate
  end subroutine judge_edge

  !> Is edge e of the net, or an end of it, where the closest point of a facet lies?
  pure logical function is_at(obstacle, seen, e)
    type(skin_t), intent(in) :: obstacle
    type(seen_t), intent(in) :: seen
    integer, intent(in) :: e
    is_at = seen%feature == on_edge .and. seen%which == e
    if (seen%feature == on_vertex) is_at = any(obstacle%ends(:, e) == &
        obstacle%vertex(seen%which))
  end function is_at

  !> A convex edge: inside both half-spaces the shallower facet holds; beyond both rims, or at
  !> the very rim of one, the edge.
  subroutine judge_sharp_edge(own, obstacle, node, e, first, second, s, y, f, direction, view, &
      sight)
    type(skin_t), intent(in) :: own, obstacle
    integer, intent(in) :: node, e, first, second
    real(wp), intent(in) :: s, y(3), f(3), direction(:, :)
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    real(wp) :: stays, shorter, normal(3, 2)
    integer :: held
    held = 0
    stays = zero
    associate (a => sight%seen(first), b => sight%seen(second))
      shorter = min(obstacle%size(a%facet), obstacle%size(b%facet))
      normal(:, 1) = a%normal
      normal(:, 2) = b%normal
      if (a%is_before .and. b%is_before) then
        if (.not. (a%is_kept .and. b%is_kept)) return
        held = merge(second, first, a%gap < b%gap)
        call drop(sight%seen(first + second - held))
        if (abs(a%gap - b%gap) > 1.0e-7_wp*shorter) return
      else if (a%is_before .or. b%is_before) then
        held = merge(first, second, a%is_before)
        stays = narrow
        associate (h => sight%seen(held))
          if (norm2(h%y - y) > allowance_in_space(own, node, size_before(sight%fan, h%normal), &
              shorter)) return
        end associate
      end if
      call choose_at_feature(own, obstacle, node, [a%facet, b%facet], normal, direction, held, &
          stays, y, f, view, sight)
    end associate
    call finish_edge(obstacle, e, s, sight)
  end subroutine judge_sharp_edge

  !> A vertex that is the closest point of all facets round it.
  subroutine judge_vertex(own, obstacle, node, v, f, x, u, view, sight)
    type(skin_t), intent(in) :: own, obstacle
    integer, intent(in) :: node, v
    real(wp), intent(in) :: f(3)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    real(wp) :: y(3), mean(3)
    logical :: is_nearest, is_smooth, is_reflex
    integer :: i
    call see_round(obstacle, v, node, x, u, view, sight, is_nearest)
    if (.not. is_nearest) return
    y = from_node(x, u, node, obstacle%vertex(v))
    call mean_of_facing(sight, mean, is_smooth)
    if (is_smooth) then
      call add_smooth_place(obstacle, node, 0, zero, y, mean, sight%round(:sight%n_round), &
          view, sight)
      call finish_vertex(obstacle, v, sight)
      return
    end if
    is_reflex = .false.
    do i = obstacle%first_edge(v), obstacle%first_edge(v + 1) - 1
      is_reflex = is_reflex .or. obstacle%turn(obstacle%edge(i)) < -smooth_angle
    end do
    if (is_reflex) then
      do i = 1, sight%n_round
        associate (seen => sight%seen(sight%at(sight%round(i))))
          seen%is_kept = makes_row(obstacle, seen, view, sight%fan)
        end associate
      end do
      return
    end if
    call open_fan(obstacle, obstacle%vertex(v), x, u, view%is_reference, sight%other)
    call choose_at_feature(own, obstacle, node, sight%round(:sight%n_round), &
        sight%normal(:, :sight%n_round), sight%other%edge(:, :sight%other%edges), 0, zero, y, &
        f, view, sight)
    call finish_vertex(obstacle, v, sight)
  end subroutine judge_vertex

  !> The facets round a vertex and their normals, into sight; is_nearest: the vertex is the
  !> closest point of all of them.
  subroutine see_round(obstacle, v, node, x, u, view, sight, is_nearest)
    type(skin_t), intent(in) :: obstacle
    integer, intent(in) :: v, node
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    logical, intent(out) :: is_nearest
    integer :: i
    is_nearest = .false.
    sight%n_round = 0
    do i = obstacle%first_facet(v), obstacle%first_facet(v + 1) - 1
      associate (facet => obstacle%facet(i))
        if (view%may_share) then
          if (touches(obstacle, facet, node)) return
        end if
        call see(obstacle, facet, x, u, node, view, .false., sight)
        associate (seen => sight%seen(sight%at(facet)))
          if (seen%is_before .or. seen%feature /= on_vertex) return
          if (seen%which /= v) return
          sight%n_round = sight%n_round + 1
          sight%round(sight%n_round) = facet
          sight%normal(:, sight%n_round) = seen%normal
        end associate
      end associate
    end do
    is_nearest = .true.
  end subroutine see_round

  !> The sum of the normals round a vertex that face the node; is_smooth: there are several,
  !> which are nearly one.
  pure subroutine mean_of_facing(sight, mean, is_smooth)
    type(space_sight_t), intent(in) :: sight
    real(wp), intent(out) :: mean(3)
    logical, intent(out) :: is_smooth
    integer :: i, n
    n = 0
    mean = zero
    do i = 1, sight%n_round
      if (.not. faces_fan(sight%normal(:, i), sight%fan, sine_of_facing)) cycle
      n = n + 1
      mean = mean + sight%normal(:, i)
    end do
    is_smooth = n > 1
    do i = 1, sight%n_round
      if (.not. is_smooth) exit
      if (faces_fan(sight%normal(:, i), sight%fan, sine_of_facing)) is_smooth = &
          dot_product(sight%normal(:, i), mean) > cos(smooth_angle)*norm2(mean)
    end do
  end subroutine mean_of_facing

  !> A place at a smooth edge or vertex, with the mean normal of its facets.
  pure subroutine add_smooth_place(obstacle, node, e, s, y, normal, facet, view, sight)
    type(skin_t), intent(in) :: obstacle
    integer, intent(in) :: node, e, facet(:)
    real(wp), intent(in) :: s, y(3), normal(3)
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    real(wp) :: n(3), length
    n = normal/norm2(normal)
    length = smallest(obstacle, facet)
    if (.not. faces_fan(n, sight%fan, sine_of_facing)) return
    call add_shared_place(obstacle, node, facet, y, n, length, view, sight)
    if (e > 0) call finish_edge(obstacle, e, s, sight)
  end subroutine add_smooth_place

  !> The row of a convex feature of these facets. held: the facet, of those seen, whose row it
  !> would replace, 0 = none; that stays where the common normals spread less than `stays`:
  !> faces that lie on each other.
  subroutine choose_at_feature(own, obstacle, node, facet, normal, direction, held, stays, y, &
      f, view, sight)
    type(skin_t), intent(in) :: own, obstacle
    integer, intent(in) :: node, facet(:), held
    real(wp), intent(in) :: normal(:, :), direction(:, :), stays, y(3), f(3)
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    real(wp) :: common(3, most_normals), n(3), shorter, own_size
    integer :: m, k
    shorter = smallest(obstacle, facet)
    call common_normals(normal, direction, sight%fan, common, m)
    if (m == 0) return
    if (held > 0) then
      if (sight%seen(held)%is_kept .and. spread_of(common(:, :m)) < stays) return
    end if
    own_size = size_before(sight%fan, normal(:, 1))
    if (.not. own_size > zero) own_size = shorter
    do k = 1, size(facet)
      if (is_among(normal(:, k), common(:, :m))) cycle
      if (min(-dot_product(normal(:, k), y), dot_product(normal(:, k), f - y)) > &
          beside*min(shorter, own_size)) return
    end do
    call choose_of(common(:, :m), -y, f, allowance_in_space(own, node, own_size, shorter), &
        shorter, n)
    k = sight%places
    call add_shared_place(obstacle, node, facet, y, n, shorter, view, sight)
    if (sight%places > k .and. held > 0) call drop(sight%seen(held))
  end subroutine choose_at_feature

  pure subroutine drop(seen)
    type(seen_t), intent(inout) :: seen
    seen%is_kept = .false.
    seen%is_dropped = .true.
  end subroutine drop

  !> Is a normal one of these, to round-off?
  pure logical function is_among(n, list)
    real(wp), intent(in) :: n(3), list(:, :)
    integer :: k
    is_among = .false.
    do k = 1, size(list, 2)
      is_among = is_among .or. sum(abs(list(:, k) - n)) < 1.0e-9_wp
    end do
  end function is_among

  !> The smallest of the facets [L].
  pure real(wp) function smallest(obstacle, facet)
    type(skin_t), intent(in) :: obstacle
    integer, intent(in) :: facet(:)
    integer :: k
    smallest = obstacle%size(facet(1))
    do k = 2, size(facet)
      smallest = min(smallest, obstacle%size(facet(k)))
    end do
  end function smallest

end module contact_space_features
