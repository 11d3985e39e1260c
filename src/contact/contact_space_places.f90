! SPDX-License-Identifier: BSD-3-Clause
!> The places in space on an obstacle that a node faces: one for each local minimum of its
!> distance from the boundary, as in the plane (contact_places).
module contact_space_places
  use base_kinds, only: wp, zero, one
  use contact_fan, only: open_fan
  use contact_features, only: smooth_angle, end_tolerance
  use contact_places, only: view_t
  use contact_sight, only: end_of_edge, on_vertex
  use contact_skin, only: skin_t
  use contact_space_features, only: judge_edge, judge_vertex
  use contact_space_view, only: space_place_t, space_sight_t, see, touches, add_facet_place, &
      size_before, allowance_in_space
  implicit none
  private

  public :: find_space_places

contains

  !> Places of a node of `own` on the listed facets of the obstacle, at X + U, into
  !> sight%place, the nearest first. free (3, nodes): the motion that chooses the normal at a
  !> convex feature [L]; none where it is absent. The obstacle's facets round the node are left
  !> out where it may belong to both.
  subroutine find_space_places(own, obstacle, node, list, x, u, view, sight, free)
    type(skin_t), intent(in) :: own, obstacle
    integer, intent(in) :: node, list(:)
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    real(wp), intent(in), optional, contiguous :: free(:, :)
    integer :: j
    sight%places = 0
    sight%n = 0
    call open_fan(own, node, x, u, view%is_reference, sight%fan)
    ! A reflex vertex is not hit first; it has a row only where the end of a step asks for it.
    if (sight%fan%is_reflex .and. present(free)) return
    do j = 1, size(list)
      call see(obstacle, list(j), x, u, node, view, .true., sight)
    end do
    do j = 1, size(list)
      if (present(free)) then
        call look_around(own, obstacle, node, j, size(list), x, u, view, sight, free)
      else
        call look_around(own, obstacle, node, j, size(list), x, u, view, sight)
      end if
    end do
    call drop_hidden(obstacle, sight)
    call drop_neighbours(obstacle, sight)
    do j = 1, sight%n
      if (sight%seen(j)%is_kept) call add_facet_place(obstacle, node, sight%seen(j), sight)
      sight%at(sight%seen(j)%facet) = 0
    end do
    if (sight%places > 1) call merge_places(sight)
    do j = 1, sight%places
      associate (p => sight%place(j))
        p%own_size = size_before(sight%fan, p%normal)
        p%allowance = allowance_in_space(own, node, p%own_size, p%length)
      end associate
    end do
  end subroutine find_space_places

  !> The edges of facet j of the list, each once, and its vertex where it is the closest point.
  subroutine look_around(own, obstacle, node, j, listed, x, u, view, sight, free)
    type(skin_t), intent(in) :: own, obstacle
    integer, intent(in) :: node, j, listed
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(view_t), intent(in) :: view
    type(space_sight_t), intent(inout) :: sight
    real(wp), intent(in), optional, contiguous :: free(:, :)
    real(wp) :: s, y(3), f(3)
    integer :: i, e, other
    do i = 1, obstacle%corners(sight%seen(j)%facet)
      e = obstacle%edge_of(i, sight%seen(j)%facet)
      other = sum(obstacle%beside(:, e)) - sight%seen(j)%facet
      if (other == 0) cycle
      if (sight%at(other) > 0 .and. sight%at(other) <= listed .and. sight%at(other) < j) cycle
      call end_of_edge(obstacle, e, x, u, node, s, y)
      if (sum(y**2) > view%reach**2) then
        ! The side wall of a body holds nodes that stand on its top, however far the edge is.
        if (sight%at(other) == 0 .or. .not. sight%seen(j)%is_kept) cycle
        if (.not. sight%seen(sight%at(other))%is_kept) cycle
      end if
      if (view%may_share) then
        if (touches(obstacle, other, node)) cycle
      end if
      call see(obstacle, other, x, u, node, view, .false., sight)
      f = motion_before(obstacle, e, s, node)
      call judge_edge(own, obstacle, node, e, j, sight%at(other), s, y, f, x, u, view, sight)
    end do
    if (sight%seen(j)%feature /= on_vertex) return
    do i = 1, j - 1
      if (sight%seen(i)%feature == on_vertex .and. &
          sight%seen(i)%which == sight%seen(j)%which) return
    end do
    f = zero
    associate (vertex => obstacle%vertex(sight%seen(j)%which))
      if (present(free)) f = free(:, node) - free(:, vertex)
    end associate
    call judge_vertex(own, obstacle, node, sight%seen(j)%which, f, x, u, view, sight)
  contains
    !> Of the node, relative to a place on an edge.
    pure function motion_before(obstacle, e, s, node) result(f)
      type(skin_t), intent(in) :: obstacle
      integer, intent(in) :: e, node
      real(wp), intent(in) :: s
      real(wp) :: f(3)
      f = zero
      if (.not. present(free)) return
      f = free(:, node) - (one - s)*free(:, obstacle%ends(1, e)) &
          - s*free(:, obstacle%ends(2, e))
    end function motion_before
  end subroutine look_around

  !> Of two facets between whose half-spaces the free space is the union, and that the node is
  !> before, the deeper one says nothing: each place lies behind the other facet.
  pure subroutine drop_hidden(obstacle, sight)
    type(skin_t), intent(in) :: obstacle
    type(space_sight_t), intent(inout) :: sight
    real(wp) :: least
    integer :: i, j
    do i = 1, sight%n
      do j = 1, i - 1
        associate (a => sight%seen(i), b => sight%seen(j))
          if (.not. (a%is_kept .and. b%is_kept .and. a%is_before .and. b%is_before)) cycle
          if (dot_product(a%normal, b%normal) > cos(smooth_angle)) cycle
          least = end_tolerance*min(obstacle%size(a%facet), obstacle%size(b%facet))
          if (min(a%gap, b%gap) >= -least) cycle
          if (dot_product(a%normal, b%y - a%y) >= zero) cycle
          if (dot_product(b%normal, a%y - b%y) >= zero) cycle
          if (a%gap < b%gap) then
            a%is_kept = .false.
          else
            b%is_kept = .false.
          end if
        end associate
      end do
    end do
  end subroutine drop_hidden

  !> What an edge has decided of a facet holds for those in its plane that touch it where the
  !> node is: at a vertex of triangles not each of them has that edge.
  pure subroutine drop_neighbours(obstacle, sight)
    type(skin_t), intent(in) :: obstacle
    type(space_sight_t), intent(inout) :: sight
    integer :: i, j
    do i = 1, sight%n
      do j = 1, sight%n
        associate (a => sight%seen(i), b => sight%seen(j))
          if (.not. (a%is_kept .and. b%is_dropped)) cycle
          if (dot_product(a%normal, b%normal) <= cos(smooth_angle)) cycle
          if (norm2(a%y - b%y) <= end_tolerance*obstacle%size(a%facet)) a%is_kept = .false.
        end associate
      end do
    end do
  end subroutine drop_neighbours

  !> The nearest first; of two whose normals are nearly the same the nearer, and of facets that
  !> are as near, at an edge or vertex of both, that with the mean normal.
  pure subroutine merge_places(sight)
    type(space_sight_t), intent(inout) :: sight
    type(space_place_t) :: p
    integer :: i, j, kept
    logical :: is_new
    do i = 2, sight%places
      p = sight%place(i)
      j = i - 1
      do while (j > 0)
        if (.not. comes_before(p, sight%place(j))) exit
        sight%place(j + 1) = sight%place(j)
        j = j - 1
      end do
      sight%place(j + 1) = p
    end do
    kept = 0
    do i = 1, sight%places
      p = sight%place(i)
      is_new = .true.
      do j = 1, kept
        if (dot_product(p%normal, sight%place(j)%normal) <= cos(smooth_angle)) cycle
        is_new = .false.
        call meet(p, sight%place(j))
      end do
      if (.not. is_new) cycle
      kept = kept + 1
      sight%place(kept) = p
      sight%place(kept)%is_second = kept > 1
    end do
    sight%places = kept
  end subroutine merge_places

  pure logical function comes_before(p, q)
    type(space_place_t), intent(in) :: p, q
    comes_before = abs(p%gap) < abs(q%gap)
    if (.not. comes_before .and. .not. abs(p%gap) > abs(q%gap)) comes_before = p%facet < q%facet
  end function comes_before

  !> Two facets that have one feature, as near as each other: q takes the mean normal.
  pure subroutine meet(p, q)
    type(space_place_t), intent(in) :: p
    type(space_place_t), intent(inout) :: q
    real(wp) :: n(3)
    if (p%key >= 0 .or. p%key /= q%key) return
    if (abs(abs(p%gap) - abs(q%gap)) > 1.0e-9_wp*min(p%length, q%length)) return
    q%is_shared = .true.
    q%length = min(p%length, q%length)
    if (sum(abs(p%normal - q%normal)) < 1.0e-12_wp) return
    n = p%normal + q%normal
    q%normal = n/norm2(n)
    q%gap = -dot_product(q%normal, q%y)
  end subroutine meet

end module contact_space_places
