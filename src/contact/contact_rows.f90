! SPDX-License-Identifier: BSD-3-Clause
!> Rows of contact as plain arrays. Row a says how its contactor point moves relative to the
!> obstacle: points k with weights c_k (contactor 1, obstacle negative, sum 0; at a wall the
!> contactor alone), a normal n and tangents: in the plane t = n turned by +90 degrees, in space
!> t1 and t2 = n x t1:
!>   H_a = [n t1 t2]' sum_k c_k I_k,   u_a = H_a dU + (c, 0, 0),   nodal forces = H' r.
!> The sum of the nodal forces of a row is zero because the weights sum to zero. dim is 2 or 3.
module contact_rows
  use base_kinds, only: wp, zero, one
  use cone_types, only: contact_open
  implicit none
  private

  type, public :: rows_t
    integer :: n = 0
    integer :: dim = 2                     !< of normals
    integer :: most_points = 3             !< of a row, so far
    !> (4, n) pairing, side of the contactor node, the node, edge (< 0: vertex; 0: of a wall or
    !> of a mortar)
    integer, allocatable :: key(:, :)
    integer, allocatable :: kind(:)        !< row_...
    integer, allocatable :: first(:)       !< (n + 1) first point of a row
    !> nodes: the contactor with weight 1, then the obstacle's; behind them others of the
    !> contactor's side and once more the first, where a mortar row has them
    integer, allocatable :: point(:)
    integer, allocatable :: slot(:)        !< the same among the interface nodes
    real(wp), allocatable :: weight(:)     !< c_k
    real(wp), allocatable :: normal(:, :)  !< (dim, n)
    real(wp), allocatable :: tangent(:, :, :)  !< (3, 2, n) in space
    real(wp), allocatable :: gap(:)        !< at the start of the step [L]
    real(wp), allocatable :: offset(:)     !< c of u_n [L]
    real(wp), allocatable :: offset_t(:, :)  !< (dim - 1, n) of u_t [L], zero on positions
    real(wp), allocatable :: allowance(:)  !< the gap may be this far below zero [L]
    real(wp), allocatable :: mu(:)
    real(wp), allocatable :: length(:)     !< of the edge [L]
    logical, allocatable :: is_rigid(:)    !< both sides constrained: W_nn = 0, only watched
    logical, allocatable :: is_twin(:)     !< an exact row of another node says the same
    logical, allocatable :: is_marked(:)   !< to be moved to another list
    logical, allocatable :: is_active(:)   !< takes part in the solve
    ! (dim, n) reactions (n, t1, t2) of this step and of the two solves before [F],
    ! displacement [L]; status.
    real(wp), allocatable :: r(:, :), r_previous(:, :), r_older(:, :), u(:, :)
    integer, allocatable :: status(:)
  end type rows_t

  !> What makes a row: an edge, a vertex, the second minimum of a node's distance, a wall, a
  !> wall that slides along its normal, which no tangential force moves, the multiplier of a
  !> mortar, an edge across an edge; late rows come when the solved step has shown that they are
  !> missing.
  integer, parameter, public :: row_edge = 1, row_vertex = 2, row_second = 3, row_wall = 4, &
      row_guided = 5, row_mortar = 6, row_crossing = 7, row_kinds = 7

  public :: start_rows, size_points, add_row, renew_gap, copy_row, copy_rows, swap_rows, &
      same_geometry, carry_reactions, take_reactions, comes_before, find_slots, set_tangents, &
      tangents_of

contains

  !> Empties the list; room for n rows, where given, or some. dim, the first time: 2 where it is
  !> not given.
  pure subroutine start_rows(rows, n, dim)
    type(rows_t), intent(inout) :: rows
    integer, intent(in), optional :: n, dim
    if (.not. allocated(rows%key)) then
      if (present(dim)) rows%dim = dim
      rows%most_points = usual_points(rows)
      call size_rows(rows, 16)
    end if
    if (present(n)) then
      if (size(rows%gap) < n) call size_rows(rows, n)
    end if
    rows%n = 0
    rows%first(1) = 1
  end subroutine start_rows

  !> Points of a row on an edge of the plane, or on a facet of four nodes in space.
  pure integer function usual_points(rows)
    type(rows_t), intent(in) :: rows
    usual_points = 2*rows%dim - 1
  end function usual_points

  !> Storage for n rows, of the usual number of points each where no longer one has come; what
  !> is in it is kept.
  pure subroutine size_rows(rows, n)
    type(rows_t), intent(inout) :: rows
    integer, intent(in) :: n
    call size_integers(rows%key, 4, n)
    call size_reals(rows%normal, rows%dim, n)
    call size_reals(rows%r, rows%dim, n)
    call size_reals(rows%r_previous, rows%dim, n)
    call size_reals(rows%r_older, rows%dim, n)
    call size_reals(rows%u, rows%dim, n)
    call size_real(rows%gap, n)
    call size_real(rows%offset, n)
    call size_reals(rows%offset_t, rows%dim - 1, n)
    if (rows%dim == 3) call size_tangents(rows%tangent, n)
    call size_real(rows%allowance, n)
    call size_real(rows%mu, n)
    call size_real(rows%length, n)
    call size_integer(rows%first, n + 1)
    call size_integer(rows%status, n)
    call size_integer(rows%kind, n)
    call size_logical(rows%is_rigid, n)
    call size_logical(rows%is_marked, n)
    call size_logical(rows%is_active, n)
    call size_logical(rows%is_twin, n)
    call size_points(rows, usual_points(rows)*n)
  end subroutine size_rows

  !> Storage for n points at least.
  pure subroutine size_points(rows, n)
    type(rows_t), intent(inout) :: rows
    integer, intent(in) :: n
    if (allocated(rows%weight)) then
      if (size(rows%weight) >= n) return
    end if
    call size_real(rows%weight, n)
    call size_integer(rows%point, n)
    call size_integer(rows%slot, n)
  end subroutine size_points

  pure subroutine size_reals(a, m, n)
    real(wp), allocatable, intent(inout) :: a(:, :)
    integer, intent(in) :: m, n
    real(wp), allocatable :: longer(:, :)
    allocate (longer(m, n))
    longer = zero
    if (allocated(a)) longer(:, :size(a, 2)) = a
    call move_alloc(longer, a)
  end subroutine size_reals

  pure subroutine size_tangents(a, n)
    real(wp), allocatable, intent(inout) :: a(:, :, :)
    integer, intent(in) :: n
    real(wp), allocatable :: longer(:, :, :)
    allocate (longer(3, 2, n))
    longer = zero
    if (allocated(a)) longer(:, :, :size(a, 3)) = a
    call move_alloc(longer, a)
  end subroutine size_tangents

  pure subroutine size_real(a, n)
    real(wp), allocatable, intent(inout) :: a(:)
    integer, intent(in) :: n
    real(wp), allocatable :: longer(:)
    allocate (longer(n))
    longer = zero
    if (allocated(a)) longer(:size(a)) = a
    call move_alloc(longer, a)
  end subroutine size_real

  pure subroutine size_integers(a, m, n)
    integer, allocatable, intent(inout) :: a(:, :)
    integer, intent(in) :: m, n
    integer, allocatable :: longer(:, :)
    allocate (longer(m, n))
    longer = 0
    if (allocated(a)) longer(:, :size(a, 2)) = a
    call move_alloc(longer, a)
  end subroutine size_integers

  pure subroutine size_integer(a, n)
    integer, allocatable, intent(inout) :: a(:)
    integer, intent(in) :: n
    integer, allocatable :: longer(:)
    allocate (longer(n))
    longer = 0
    if (allocated(a)) longer(:size(a)) = a
    call move_alloc(longer, a)
  end subroutine size_integer

  pure subroutine size_logical(a, n)
    logical, allocatable, intent(inout) :: a(:)
    integer, intent(in) :: n
    logical, allocatable :: longer(:)
    allocate (longer(n))
    longer = .false.
    if (allocated(a)) longer(:size(a)) = a
    call move_alloc(longer, a)
  end subroutine size_logical

  !> Adds a row: key, points and weights, normal, gap [L], mu, edge length [L], kind,
  !> allowance [L]; no reaction yet.
  pure subroutine add_row(rows, key, point, weight, normal, gap, mu, length, kind, allowance)
    type(rows_t), intent(inout) :: rows
    integer, intent(in) :: key(4), point(:), kind
    real(wp), intent(in) :: weight(:), normal(rows%dim), gap, mu, length, allowance
    integer :: k
    if (rows%n == size(rows%gap)) call size_rows(rows, 2*rows%n)
    rows%n = rows%n + 1
    associate (a => rows%n)
      rows%key(:, a) = key
      rows%first(a + 1) = rows%first(a) + size(point)
      if (size(point) > usual_points(rows)) call make_room(rows)
      do k = 1, size(point)
        rows%point(rows%first(a) + k - 1) = point(k)
        rows%weight(rows%first(a) + k - 1) = weight(k)
      end do
      rows%normal(1, a) = normal(1)
      rows%normal(2, a) = normal(2)
      if (rows%dim == 3) rows%normal(3, a) = normal(3)
      if (rows%dim == 3) rows%tangent(:, :, a) = tangents_of(normal)
      rows%gap(a) = gap
      rows%offset(a) = gap + allowance
      rows%offset_t(:, a) = zero
      rows%allowance(a) = allowance
      rows%kind(a) = kind
      rows%mu(a) = mu
      rows%length(a) = length
      rows%is_rigid(a) = .false.
      rows%is_marked(a) = .false.
      rows%is_active(a) = .true.
      rows%is_twin(a) = .false.
      rows%r(:, a) = zero
      rows%r_previous(:, a) = zero
      rows%r_older(:, a) = zero
      rows%u(:, a) = zero
      rows%status(a) = contact_open
    end associate
  end subroutine add_row

  !> Room for the points of the last row, which has more than the usual number.
  pure subroutine make_room(rows)
    type(rows_t), intent(inout) :: rows
    associate (first => rows%first(rows%n), behind => rows%first(rows%n + 1), &
        usual => usual_points(rows))
      rows%most_points = max(rows%most_points, behind - first)
      ! What is left holds all other rows, if they have the usual number each.
      if (behind - 1 + usual*(size(rows%gap) - rows%n) > size(rows%weight)) &
          call size_points(rows, 2*(behind - 1) + usual*size(rows%gap))
    end associate
  end subroutine make_room

  !> A new gap [L] for the row behind row a, which must be of this node.
  pure subroutine renew_gap(rows, a, node, gap, is_same)
    type(rows_t), intent(inout) :: rows
    integer, intent(inout) :: a
    integer, intent(in) :: node
    real(wp), intent(in) :: gap
    logical, intent(inout) :: is_same
    a = a + 1
    if (a > rows%n) is_same = .false.
    if (.not. is_same) return
    if (rows%key(3, a) /= node) is_same = .false.
    rows%gap(a) = gap
  end subroutine renew_gap

  !> Exchanges two lists without copying.
  pure subroutine swap_rows(a, b)
    type(rows_t), allocatable, intent(inout) :: a, b
    type(rows_t), allocatable :: c
    call move_alloc(a, c)
    call move_alloc(b, a)
    call move_alloc(c, b)
  end subroutine swap_rows

  !> True when W of the two lists is the same: points, weights and normals to the last bit.
  pure logical function same_geometry(a, b)
    type(rows_t), intent(in) :: a, b
    integer :: k
    same_geometry = a%n == b%n
    if (.not. same_geometry) return
    same_geometry = a%first(a%n + 1) == b%first(b%n + 1)
    if (.not. same_geometry) return
    do k = 1, a%n
      if (a%first(k) /= b%first(k) .or. any(a%key(:, k) /= b%key(:, k)) .or. &
          any(abs(a%normal(:, k) - b%normal(:, k)) > zero)) &
          same_geometry = .false.
    end do
    do k = 1, a%first(a%n + 1) - 1
      if (a%point(k) /= b%point(k) .or. abs(a%weight(k) - b%weight(k)) > zero) &
          same_geometry = .false.
    end do
  end function same_geometry

  !> Reactions of rows that were on the old list, by pairing, side, node and edge; a row
  !> that is new on its node takes those of the old row there whose normal is nearest, as
  !> vectors. Both lists are in the same order of pairings, sides and nodes.
  pure subroutine carry_reactions(old, rows)
    type(rows_t), intent(in) :: old
    type(rows_t), intent(inout) :: rows
    integer :: a, b, k, best
    b = 1
    do a = 1, rows%n
      do while (b <= old%n)
        if (.not. comes_before(old%key(1:3, b), rows%key(1:3, a))) exit
        b = b + 1
      end do
      if (b > old%n) return
      best = 0
      do k = b, old%n
        if (any(old%key(1:3, k) /= rows%key(1:3, a))) exit
        if (old%key(4, k) == rows%key(4, a)) then
          best = k
          exit
        end if
        if (old%key(4, k) == 0 .or. rows%key(4, a) == 0) cycle    ! of a node no other's
        if (dot_product(old%normal(:, k), rows%normal(:, a)) > 0.9_wp) best = k
      end do
      if (best > 0) call take_reactions(old, best, rows, a)
    end do
  end subroutine carry_reactions

  !> Reactions of row b of old to row a, turned into its frame.
  pure subroutine take_reactions(old, b, rows, a)
    type(rows_t), intent(in) :: old
    integer, intent(in) :: b, a
    type(rows_t), intent(inout) :: rows
    real(wp) :: c, s
    rows%status(a) = old%status(b)
    if (rows%dim == 3) then
      call take_in_space(old, b, rows, a)
      return
    end if
    rows%r(1:2, a) = old%r(1:2, b)
    rows%r_previous(1:2, a) = old%r_previous(1:2, b)
    rows%r_older(1:2, a) = old%r_older(1:2, b)
    associate (n => rows%normal(1:2, a), m => old%normal(1:2, b))
      if (.not. any(abs(n - m) > zero)) return
      c = n(1)*m(1) + n(2)*m(2)
      s = n(1)*m(2) - n(2)*m(1)
    end associate
    rows%r(1:2, a) = turned(c, s, rows%r(1:2, a))
    rows%r_previous(1:2, a) = turned(c, s, rows%r_previous(1:2, a))
    rows%r_older(1:2, a) = turned(c, s, rows%r_older(1:2, a))
  end subroutine take_reactions

  !> The same in space: as global vectors, where the frame has turned.
  pure subroutine take_in_space(old, b, rows, a)
    type(rows_t), intent(in) :: old
    integer, intent(in) :: b, a
    type(rows_t), intent(inout) :: rows
    real(wp) :: from(3, 3), turn(3, 3)
    rows%r(:, a) = old%r(:, b)
    rows%r_previous(:, a) = old%r_previous(:, b)
    rows%r_older(:, a) = old%r_older(:, b)
    if (.not. any(abs(rows%normal(:, a) - old%normal(:, b)) > zero)) return
    from(:, 1) = old%normal(:, b)
    from(:, 2:3) = old%tangent(:, :, b)
    turn(1, :) = matmul(rows%normal(:, a), from)
    turn(2:3, :) = matmul(transpose(rows%tangent(:, :, a)), from)
    rows%r(:, a) = matmul(turn, old%r(:, b))
    rows%r_previous(:, a) = matmul(turn, old%r_previous(:, b))
    rows%r_older(:, a) = matmul(turn, old%r_older(:, b))
  end subroutine take_in_space

  pure function turned(c, s, r) result(q)
    real(wp), intent(in) :: c, s, r(2)
    real(wp) :: q(2)
    q = [c*r(1) - s*r(2), s*r(1) + c*r(2)]
  end function turned

  !> Adds row b of another list with its reactions.
  pure subroutine copy_row(from, b, rows)
    type(rows_t), intent(in) :: from
    integer, intent(in) :: b
    type(rows_t), intent(inout) :: rows
    associate (p => from%point(from%first(b):from%first(b + 1) - 1), &
        w => from%weight(from%first(b):from%first(b + 1) - 1))
      call add_row(rows, from%key(:, b), p, w, from%normal(:, b), from%gap(b), from%mu(b), &
          from%length(b), from%kind(b), from%allowance(b))
    end associate
    associate (a => rows%n)
      rows%offset(a) = from%offset(b)
      rows%offset_t(:, a) = from%offset_t(:, b)
      rows%is_rigid(a) = from%is_rigid(b)
      rows%is_twin(a) = from%is_twin(b)
      rows%is_active(a) = from%is_active(b)
      rows%r(:, a) = from%r(:, b)
      rows%r_previous(:, a) = from%r_previous(:, b)
      rows%r_older(:, a) = from%r_older(:, b)
      rows%u(:, a) = from%u(:, b)
      rows%status(a) = from%status(b)
    end associate
  end subroutine copy_row

  !> A copy of a list, in the storage that is there.
  pure subroutine copy_rows(from, rows)
    type(rows_t), intent(in) :: from
    type(rows_t), intent(inout) :: rows
    integer :: a
    call start_rows(rows)
    do a = 1, from%n
      call copy_row(from, a, rows)
    end do
  end subroutine copy_rows

  !> Does key a stand before key b, by its first entries that differ?
  pure logical function comes_before(a, b)
    integer, intent(in) :: a(:), b(:)
    integer :: k
    comes_before = .false.
    do k = 1, size(a)
      if (a(k) == b(k)) cycle
      comes_before = a(k) < b(k)
      return
    end do
  end function comes_before

  !> Places of the points among the interface nodes; slot (nodes of the model).
  pure subroutine find_slots(slot, rows)
    integer, intent(in) :: slot(:)
    type(rows_t), intent(inout) :: rows
    integer :: k
    do k = 1, rows%first(rows%n + 1) - 1
      rows%slot(k) = slot(rows%point(k))
    end do
  end subroutine find_slots

  !> Tangents of all rows from their normals, where these have been restored.
  pure subroutine set_tangents(rows)
    type(rows_t), intent(inout) :: rows
    integer :: a
    if (rows%dim < 3) return
    do a = 1, rows%n
      rows%tangent(:, :, a) = tangents_of(rows%normal(:, a))
    end do
  end subroutine set_tangents

  !> Tangents t1, t2 of a normal in space: with k the component of n that is largest, the first
  !> of equal ones, t1 is the unit vector of the next axis less its part along n; t2 = n x t1.
  pure function tangents_of(n) result(t)
    real(wp), intent(in) :: n(3)
    real(wp) :: t(3, 2)
    integer :: k
    k = 1 + mod(maxloc(abs(n), dim=1), 3)
    t(:, 1) = -n(k)*n
    t(k, 1) = t(k, 1) + one
    t(:, 1) = t(:, 1)/sqrt(t(1, 1)**2 + t(2, 1)**2 + t(3, 1)**2)
    t(:, 2) = [n(2)*t(3, 1) - n(3)*t(2, 1), n(3)*t(1, 1) - n(1)*t(3, 1), &
        n(1)*t(2, 1) - n(2)*t(1, 1)]
  end function tangents_of

end module contact_rows
