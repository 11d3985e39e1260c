! SPDX-License-Identifier: BSD-3-Clause
!> Which places in space get exact rows and which an allowance: as in the plane (contact_grade)
!> the nodes of the locally finer side are exact, and sharp vertices; of two nodes that meet
!> each other one.
module contact_space_grade
  use base_kinds, only: wp, zero, one
  use contact_fan, only: fan_t
  use contact_features, only: smooth_angle, degree
  use contact_grade, only: finer_auto, finer_both, equal_size, cosine_of_flat, twin, sharper
  use contact_sight, only: from_node
  use contact_skin, only: skin_t
  use contact_space_view, only: space_place_t
  implicit none
  private
  public :: grade_in_space, settle_in_space

contains

  !> Grade of a place of a node of `own` with this fan. finer: the side whose nodes are exact,
  !> by the deck (finer_auto: by their sizes).
  pure subroutine grade_in_space(own, obstacle, is_self, finer, fan, place)
    type(skin_t), intent(in) :: own, obstacle
    logical, intent(in) :: is_self
    integer, intent(in) :: finer
    type(fan_t), intent(in) :: fan
    type(space_place_t), intent(inout) :: place
    integer :: v
    if (finer == finer_both .or. .not. place%own_size > zero) then
      place%is_exact = .true.
    else if (finer /= finer_auto) then
      place%is_exact = place%side == finer
    else if (abs(place%own_size - place%length) <= equal_size*place%length) then
      place%is_exact = place%side == 1
      if (is_self) place%is_exact = part_of(own, place%node) <= obstacle%part_id(place%facet)
    else
      place%is_exact = place%own_size < place%length
    end if
    v = own%at(place%node)
    if (v == 0 .or. place%is_exact) return
    if (own%is_corner(v)) place%is_exact = .not. lies_flat(fan, place)
  end subroutine grade_in_space

  !> The part of a node of the net: that of the first facet round it.
  pure integer function part_of(skin, node)
    type(skin_t), intent(in) :: skin
    integer, intent(in) :: node
    part_of = 0
    if (skin%at(node) > 0) part_of = skin%part_id(skin%facet(skin%first_facet(skin%at(node))))
  end function part_of

  !> A corner whose own face lies on the facet, no smaller than the facet: the finer nodes of
  !> the other side stand within reach of it.
  pure logical function lies_flat(fan, place)
    type(fan_t), intent(in) :: fan
    type(space_place_t), intent(in) :: place
    integer :: k
    lies_flat = .false.
    if (place%is_shared) return
    do k = 1, fan%facets
      if (place%length > fan%size(k)*(one + equal_size)) cycle
      if (-dot_product(fan%normal(:, k), place%normal) >= cosine_of_flat) lies_flat = .true.
    end do
  end function lies_flat

  !> Two nodes that meet each other: the sharper one stays, then that of the smaller facets,
  !> then SURFA's; its normal is the mean of the two, so that a mirrored scene is mirrored. The
  !> other keeps an allowance. Of several places of a node the most opposite one counts. The
  !> first n_first places are of side 1, sorted by node, the others of side 2; within one
  !> surface all are of side 1. first (nodes): scratch, zero.
  pure subroutine settle_in_space(skin_1, skin_2, is_self, finer, x, u, place, n_first, first)
    type(skin_t), intent(in) :: skin_1, skin_2
    logical, intent(in) :: is_self
    integer, intent(in) :: finer, n_first
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    type(space_place_t), intent(inout) :: place(:)
    integer, intent(inout) :: first(:)
    integer :: a, b, k, low
    low = merge(1, n_first + 1, is_self)
    do b = size(place), low, -1
      first(place(b)%node) = b
    end do
    do a = 1, n_first
      if (skin_1%at(place(a)%node) == 0) cycle
      do k = 1, place(a)%points
        b = first(place(a)%point(k))
        do while (b > 0 .and. b <= size(place))
          if (place(b)%node /= place(a)%point(k)) exit
          if ((b > a .or. .not. is_self) .and. skin_2%at(place(b)%node) > 0) then
            if (is_best_twin(place, a, b, x, u)) &
                call settle_pair(skin_1, skin_2, finer, place(a), place(b))
          end if
          b = b + 1
        end do
      end do
    end do
    do b = low, size(place)
      first(place(b)%node) = 0
    end do
  end subroutine settle_in_space

  !> Are places a and b twins, and is no other place of their two nodes more opposite to either?
  pure logical function is_best_twin(place, a, b, x, u)
    type(space_place_t), intent(in) :: place(:)
    integer, intent(in) :: a, b
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    integer :: i
    is_best_twin = is_twin(place(a), place(b), x, u)
    if (.not. is_best_twin) return
    do i = first_of(place, a), size(place)
      if (place(i)%node /= place(a)%node .or. place(i)%side /= place(a)%side) exit
      if (dot_product(place(i)%normal - place(a)%normal, place(b)%normal) >= zero) cycle
      if (is_twin(place(i), place(b), x, u)) is_best_twin = .false.
    end do
    do i = first_of(place, b), size(place)
      if (place(i)%node /= place(b)%node .or. place(i)%side /= place(b)%side) exit
      if (dot_product(place(a)%normal, place(i)%normal - place(b)%normal) >= zero) cycle
      if (is_twin(place(a), place(i), x, u)) is_best_twin = .false.
    end do
  end function is_best_twin

  !> The first place of the node of place k.
  pure integer function first_of(place, k)
    type(space_place_t), intent(in) :: place(:)
    integer, intent(in) :: k
    first_of = k
    do while (first_of > 1)
      if (place(first_of - 1)%node /= place(k)%node .or. &
          place(first_of - 1)%side /= place(k)%side) exit
      first_of = first_of - 1
    end do
  end function first_of

  !> Is each of two places at the node of the other, by the smaller of their facets?
  pure logical function is_twin(p, q, x, u)
    type(space_place_t), intent(in) :: p, q
    real(wp), intent(in), contiguous :: x(:, :), u(:, :)
    real(wp) :: d(3), near
    is_twin = dot_product(p%normal, q%normal) < -cos(smooth_angle)
    if (.not. is_twin) return
    near = twin*min(p%length, q%length)
    d = from_node(x, u, p%node, q%node)
    is_twin = norm2(p%y - d) <= near .and. norm2(q%y + d) <= near
  end function is_twin

  !> One of two smooth twins is exact, whatever facets each was compared with.
  pure subroutine settle_pair(skin_a, skin_b, finer, a, b)
    type(skin_t), intent(in) :: skin_a, skin_b
    integer, intent(in) :: finer
    type(space_place_t), intent(inout) :: a, b
    real(wp) :: angle_a, angle_b
    logical :: a_stays, is_exact, by_deck, is_smooth
    angle_a = skin_a%solid_angle(skin_a%at(a%node))
    angle_b = skin_b%solid_angle(skin_b%at(b%node))
    is_smooth = .not. (skin_a%is_corner(skin_a%at(a%node)) .or. &
        skin_b%is_corner(skin_b%at(b%node)))
    a_stays = .true.
    by_deck = a%side /= b%side .and. any(finer == [1, 2]) .and. is_smooth
    if (by_deck) then
      a_stays = a%side == finer
    else if (abs(angle_a - angle_b) > sharper) then
      a_stays = angle_a < angle_b
    else if (abs(a%own_size - b%own_size) > equal_size*max(a%own_size, b%own_size)) then
      a_stays = a%own_size < b%own_size
    else if (a%side == b%side) then
      a_stays = part_of(skin_a, a%node) <= part_of(skin_b, b%node)
    end if
    is_exact = a%is_exact .or. b%is_exact .or. (finer == finer_auto .and. is_smooth)
    a%is_exact = a_stays .and. is_exact
    b%is_exact = .not. a_stays .and. is_exact
    a%is_twin = .not. a_stays .and. is_exact
    b%is_twin = a_stays .and. is_exact
    if (by_deck) return               ! its normal is that of the side that is the obstacle
    if (a_stays) call take_mean(b%normal, a)
    if (.not. a_stays) call take_mean(a%normal, b)
  end subroutine settle_pair

  !> normal = mean of it and of the other's, reversed; gap anew.
  pure subroutine take_mean(other, place)
    real(wp), intent(in) :: other(3)
    type(space_place_t), intent(inout) :: place
    real(wp) :: n(3)
    n = place%normal - other
    n = n/norm2(n)
    if (sum(abs(n - place%normal)) < 1.0e-12_wp) return
    place%normal = n
    place%gap = -dot_product(n, place%y)
  end subroutine take_mean

end module contact_space_grade
