! SPDX-License-Identifier: BSD-3-Clause
!> Rows of the dual mortar method in the plane. Multipliers of the contactor's nodes live on
!> the covered part C of its edges and are biorthogonal to the shape functions there
!> (Wohlmuth 2000; on parts: Popp, Gitterle, Gee, Wall 2010),
!>   int psi_a N_b = delta_ab w_a,   w_a = int_C N_a,
!> so that a row has weight 1 on its node and -int psi_a N_c/w_a on nodes c of the obstacle, at
!> the opposite points: r_a is a force, u_a the weighted gap. On an edge psi_a/w_a is the kernel
!> that gives the value at node a of the linear function nearest to a given one on C,
!>   k(s) = 1/l + (s_a - c)(s - c)/m,
!> with l, c, m the length, centre and second moment of C: nothing cancels in it, however
!> small C is.
module contact_mortar_rows
  use base_kinds, only: wp, zero, one, half
  use contact_features, only: gap_to_place
  use contact_mortar_cover, only: cover_t
  use contact_rows, only: rows_t, add_row, row_mortar
  use contact_surface, only: surface_t, shortest_edge_at
  implicit none
  private

  !> Work space of one row.
  type, public :: mortar_work_t
    integer :: n = 0                      !< points
    integer, allocatable :: point(:)
    real(wp), allocatable :: weight(:)    !< times w_a [L]
    real(wp) :: normal(2) = zero          !< outward, times w_a
    real(wp) :: width = zero              !< w_a [L]
  end type mortar_work_t

  !> Where less than this share of an edge is covered, its multiplier is constant and belongs
  !> to the nearer node: a linear one would be a lever for the farther node, ten times as long
  !> as what is covered.
  real(wp), parameter :: narrow = 0.1_wp

  public :: add_mortar_row, size_mortar_work, covered_width

contains

  !> Work space for rows of the pairs of edges that are listed.
  pure subroutine size_mortar_work(cover, work)
    type(cover_t), intent(in) :: cover
    type(mortar_work_t), intent(inout) :: work
    integer :: e, longest
    longest = 0
    do e = 1, size(cover%length)
      longest = max(longest, cover%first(e + 1) - cover%first(e))
    end do
    if (allocated(work%point)) deallocate (work%point, work%weight)
    allocate (work%point(4*longest + 5), work%weight(4*longest + 5))
  end subroutine size_mortar_work

  !> Adds the row of row k of the nodes of the contactor, which is side s of pairing p; none
  !> where nothing covers it.
  pure subroutine add_mortar_row(p, s, own, obstacle, cover, k, x, u, mu, work, rows)
    integer, intent(in) :: p, s, k
    type(surface_t), intent(in) :: own, obstacle
    type(cover_t), intent(in) :: cover
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp), intent(in) :: mu
    type(mortar_work_t), intent(inout) :: work
    type(rows_t), intent(inout) :: rows
    real(wp) :: normal(2)
    integer :: n
    call weigh_node(own, obstacle, cover, k, work)
    if (.not. work%width > zero) return
    n = work%n
    work%weight(2:n) = work%weight(2:n)/work%width
    work%weight(2) = -one - sum(work%weight(3:n))
    normal = -work%normal/norm2(work%normal)
    associate (point => work%point(:n), weight => work%weight(:n))
      call add_row(rows, [p, s, own%node(k), 0], point, weight, normal, &
          gap_to_place(point, weight, normal, x, u), mu, &
          shortest_edge_at(own, k, own%shortest), row_mortar, zero)
    end associate
  end subroutine add_mortar_row

  !> Weights, normal and width of the multiplier of a node.
  pure subroutine weigh_node(own, obstacle, cover, k, work)
    type(surface_t), intent(in) :: own, obstacle
    type(cover_t), intent(in) :: cover
    integer, intent(in) :: k
    type(mortar_work_t), intent(inout) :: work
    real(wp) :: width
    integer :: s, e
    work%n = 1
    work%point(1) = own%node(k)
    work%weight(1) = one
    work%normal = zero
    work%width = zero
    do s = 1, 2
      e = own%node_edge(s, k)
      if (e == 0) cycle
      width = width_on_edge(own, cover, e, 3 - s)
      if (.not. width > zero) cycle
      work%width = work%width + width
      work%normal = work%normal + width*cover%normal(:, e)
      call add_edge(own, obstacle, cover, e, 3 - s, width, work)
    end do
  end subroutine weigh_node

  !> The share of edge e in the width of its first or second node [L].
  pure real(wp) function width_on_edge(own, cover, e, end) result(width)
    type(surface_t), intent(in) :: own
    type(cover_t), intent(in) :: cover
    integer, intent(in) :: e, end
    real(wp) :: away
    away = abs(cover%centre(e) - (end - 1))
    width = cover%length(e)*own%length(e)
    if (cover%length(e) >= narrow) then
      width = width*(one - away)
    else if (away > half .or. (.not. away < half .and. end == 2)) then
      width = zero
    end if
  end function width_on_edge

  !> The obstacle's nodes behind edge e, seen by the multiplier of its first or second node.
  pure subroutine add_edge(own, obstacle, cover, e, end, width, work)
    type(surface_t), intent(in) :: own, obstacle
    type(cover_t), intent(in) :: cover
    integer, intent(in) :: e, end
    real(wp), intent(in) :: width
    type(mortar_work_t), intent(inout) :: work
    real(wp) :: s, slope, part, middle, mean, second
    integer :: k
    s = real(end - 1, wp)
    slope = zero
    if (cover%length(e) >= narrow) slope = (s - cover%centre(e))/cover%moment(e)
    do k = cover%first(e), cover%first(e + 1) - 1
      part = cover%high(k) - cover%low(k)
      if (.not. part > zero) cycle
      middle = half*(cover%low(k) + cover%high(k))
      mean = part*(one/cover%length(e) + slope*(middle - cover%centre(e)))
      associate (at => cover%at(:, k), f => cover%other(k))
        second = (mean*(middle - at(1)) + slope*part**3/12.0_wp)/(at(2) - at(1))
        call add_point(obstacle%end_node(1, f), -width*(mean - second), work)
        call add_point(obstacle%end_node(2, f), -width*second, work)
      end associate
    end do
    if (cover%length(e) >= narrow) return
    ! A constant multiplier sees the other node of its edge too.
    second = width*abs(cover%centre(e) - s)
    work%n = work%n + 2
    work%point(work%n - 1:work%n) = own%end_node([end, 3 - end], e)
    work%weight(work%n - 1:work%n) = [-second, second]
  end subroutine add_edge

  !> Adds to the weight of a node of the obstacle.
  pure subroutine add_point(node, weight, work)
    integer, intent(in) :: node
    real(wp), intent(in) :: weight
    type(mortar_work_t), intent(inout) :: work
    integer :: k
    do k = 2, work%n
      if (work%point(k) /= node) cycle
      work%weight(k) = work%weight(k) + weight
      return
    end do
    work%n = work%n + 1
    work%point(work%n) = node
    work%weight(work%n) = weight
  end subroutine add_point

  !> Integral of the shape function of row k of the nodes of the contactor over what is covered
  !> [L]: the force on the node under unit pressure.
  pure real(wp) function covered_width(own, cover, k)
    type(surface_t), intent(in) :: own
    type(cover_t), intent(in) :: cover
    integer, intent(in) :: k
    integer :: s
    covered_width = zero
    do s = 1, 2
      associate (e => own%node_edge(s, k))
        if (e > 0) covered_width = covered_width &
            + cover%length(e)*own%length(e)*(one - abs(cover%centre(e) - (2 - s)))
      end associate
    end do
  end function covered_width

end module contact_mortar_rows
