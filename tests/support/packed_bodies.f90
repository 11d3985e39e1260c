! SPDX-License-Identifier: BSD-3-Clause
!> Bodies piled up in a box, and where they touch: for packed_contacts.
module packed_bodies
  use base_kinds, only: wp, i8, zero, one, half
  implicit none
  private
  public :: draw, allocate_pile, start_pile, settle, find_touches, make_body, square_body

  integer, parameter :: most_touches = 32, settling = 150

  !> What is asked for.
  type, public :: packing_t
    character(8) :: kind = 'BALLS'
    integer :: d = 3, bodies = 20
    integer :: seed = 1
    real(wp) :: mu = 0.3_wp
    real(wp) :: reach = 1.0e-2_wp   !< gaps up to this count as contacts [radii]
    real(wp) :: motion = zero       !< of the bodies before the step [weight x step / mass]
  end type packing_t

  type, public :: pile_t
    integer :: d = 0, n = 0
    logical :: round = .true.
    real(wp) :: width = one                      !< of the box
    real(wp), allocatable :: place(:, :)         !< (d, n) centres, the last axis upwards
    real(wp), allocatable :: radius(:)           !< (n) of a ball, or around a box
    real(wp), allocatable :: side(:, :)          !< (d, n) halves of the sides
    real(wp), allocatable :: turn(:, :, :)       !< (d, d, n) axes of a box, by columns
    real(wp), allocatable :: mass(:), spin(:, :, :)   !< (n), inverse inertia (3, 3, n)
  end type pile_t

  !> Points where two bodies touch: normals (d) from the lower number, depth < 0 is a gap.
  type, public :: touches_t
    integer :: n = 0
    real(wp) :: point(3, most_touches), normal(3, most_touches), depth(most_touches)
  end type touches_t

contains

  !> The next number in 0..1 of Park & Miller's generator (1988), in 64-bit integers.
  real(wp) function draw(state)
    integer(i8), intent(inout) :: state
    integer(i8), parameter :: modulus = 2147483647_i8
    integer :: k
    do k = 1, 3
      state = mod(16807_i8*state + 11_i8, modulus)
    end do
    draw = real(state, wp)/real(modulus, wp)
  end function draw

  subroutine allocate_pile(d, n, pile)
    integer, intent(in) :: d, n
    type(pile_t), intent(out) :: pile
    pile%d = d
    pile%n = n
    allocate (pile%place(d, n), pile%radius(n), pile%side(d, n), pile%turn(d, d, n))
    allocate (pile%mass(n), pile%spin(3, 3, n))
    pile%spin = zero
  end subroutine allocate_pile

  !> Bodies on a loose lattice over the floor.
  subroutine start_pile(packing, state, pile)
    type(packing_t), intent(in) :: packing
    integer(i8), intent(inout) :: state
    type(pile_t), intent(out) :: pile
    real(wp), parameter :: spacing = 2.4_wp
    integer :: i, k, across, row
    call allocate_pile(packing%d, packing%bodies, pile)
    pile%round = packing%kind == 'BALLS'
    across = max(2, nint(real(packing%bodies, wp)**(one/packing%d)))
    pile%width = spacing*across
    do i = 1, pile%n
      call make_body(state, pile, i)
      row = i - 1
      do k = 1, packing%d
        pile%place(k, i) = spacing*(real(merge(row, mod(row, across), k == packing%d), wp) &
            + half + 0.2_wp*(draw(state) - half))
        row = row/across
      end do
    end do
  end subroutine start_pile

  !> Size, mass, inertia and direction of a body.
  subroutine make_body(state, pile, i)
    integer(i8), intent(inout) :: state
    type(pile_t), intent(inout) :: pile
    integer, intent(in) :: i
    real(wp) :: inertia(3), axes(3, 3)
    integer :: k, d
    d = pile%d
    pile%radius(i) = 0.7_wp + 0.6_wp*draw(state)
    do k = 1, d
      pile%side(k, i) = pile%radius(i)*(0.55_wp + 0.45_wp*draw(state))
    end do
    call random_axes(d, state, pile%turn(:, :, i))
    axes = zero
    axes(3, 3) = one
    axes(:d, :d) = pile%turn(:, :, i)
    if (pile%round) then
      pile%mass(i) = pile%radius(i)**d
      inertia = merge(0.5_wp, 0.4_wp, d == 2)*pile%mass(i)*pile%radius(i)**2
    else
      pile%mass(i) = product(pile%side(:, i))*1.5_wp
      inertia = sum(pile%side(:, i)**2)
      if (d == 3) inertia = inertia - pile%side(:, i)**2
      inertia = pile%mass(i)*inertia/3.0_wp
      pile%radius(i) = norm2(pile%side(:, i))
    end if
    do k = 1, 3
      pile%spin(:, k, i) = matmul(axes, axes(k, :)/inertia)
    end do
  end subroutine make_body

  !> A rotation, by columns.
  subroutine random_axes(d, state, axes)
    integer, intent(in) :: d
    integer(i8), intent(inout) :: state
    real(wp), intent(out) :: axes(d, d)
    real(wp) :: angle, x(4)
    integer :: k
    do k = 1, 4
      x(k) = draw(state) - half
    end do
    x = x/norm2(x)
    angle = 6.283_wp*x(1)
    if (d == 2) then
      axes = reshape([cos(angle), sin(angle), -sin(angle), cos(angle)], [2, 2])
    else
      axes = reshape([one - 2*(x(3)**2 + x(4)**2), 2*(x(2)*x(3) + x(1)*x(4)), &
          2*(x(2)*x(4) - x(1)*x(3)), 2*(x(2)*x(3) - x(1)*x(4)), &
          one - 2*(x(2)**2 + x(4)**2), 2*(x(3)*x(4) + x(1)*x(2)), &
          2*(x(2)*x(4) + x(1)*x(3)), 2*(x(3)*x(4) - x(1)*x(2)), &
          one - 2*(x(2)**2 + x(3)**2)], [3, 3])
    end if
  end subroutine random_axes

  !> Lets the bodies sink, without turning, and pushes them apart where they overlap.
  subroutine settle(pile)
    type(pile_t), intent(inout) :: pile
    type(touches_t) :: touches
    real(wp) :: push(pile%d)
    integer :: pass, i, j, k
    do pass = 1, settling
      if (pass < settling - 30) pile%place(pile%d, :) = pile%place(pile%d, :) - 0.05_wp
      do i = 1, pile%n
        do j = i - 1, 0, -1
          call find_touches(pile, j, i, zero, touches)
          if (touches%n == 0) cycle
          k = maxloc(touches%depth(:touches%n), 1)
          push = touches%depth(k)*touches%normal(:pile%d, k)
          if (j > 0) push = 0.5_wp*push
          if (j > 0) pile%place(:, j) = pile%place(:, j) - push
          pile%place(:, i) = pile%place(:, i) + push
        end do
      end do
    end do
  end subroutine settle

  !> Where body `high` touches body `low` (0 = box), gaps up to reach.
  subroutine find_touches(pile, low, high, reach, touches)
    type(pile_t), intent(in) :: pile
    integer, intent(in) :: low, high
    real(wp), intent(in) :: reach
    type(touches_t), intent(inout) :: touches
    real(wp) :: apart(3), distance
    integer :: d
    d = pile%d
    touches%n = 0
    if (low == 0) then
      call touch_box(pile, high, reach, touches)
      return
    end if
    apart(:d) = pile%place(:, high) - pile%place(:, low)
    distance = sqrt(sum(apart(:d)**2))
    if (distance > pile%radius(low) + pile%radius(high) + reach) return
    if (pile%round) then
      apart(:d) = apart(:d)/distance
      call add_touch(d, pile%place(:, low) + pile%radius(low)*apart(:d), apart(:d), &
          pile%radius(low) + pile%radius(high) - distance, touches)
    else
      call touch_corners(pile, high, low, one, reach, touches)
      call touch_corners(pile, low, high, -one, reach, touches)
    end if
  end subroutine find_touches

  subroutine add_touch(d, point, normal, depth, touches)
    integer, intent(in) :: d
    real(wp), intent(in) :: point(d), normal(d), depth
    type(touches_t), intent(inout) :: touches
    if (touches%n == most_touches) return
    touches%n = touches%n + 1
    touches%point(:d, touches%n) = point
    touches%normal(:d, touches%n) = normal
    touches%depth(touches%n) = depth
  end subroutine add_touch

  !> Floor and walls against a ball or the corners of a box.
  subroutine touch_box(pile, i, reach, touches)
    type(pile_t), intent(in) :: pile
    integer, intent(in) :: i
    real(wp), intent(in) :: reach
    type(touches_t), intent(inout) :: touches
    real(wp) :: normal(3), point(3), depth
    integer :: k, side, corner, d
    d = pile%d
    do k = 1, d
      do side = 1, -1, -2
        if (k == d .and. side < 0) cycle
        normal = zero
        normal(k) = side
        do corner = 1, merge(1, 2**d, pile%round)
          point(:d) = pile%place(:, i) - pile%radius(i)*normal(:d)
          if (.not. pile%round) point(:d) = corner_of(pile, i, corner)
          depth = -point(k)*side
          if (side < 0) depth = point(k) - pile%width
          if (depth > -reach) call add_touch(d, point(:d), normal(:d), depth, touches)
        end do
      end do
    end do
  end subroutine touch_box

  pure function corner_of(pile, i, corner) result(point)
    type(pile_t), intent(in) :: pile
    integer, intent(in) :: i, corner
    real(wp) :: point(pile%d)
    integer :: k
    point = pile%place(:, i)
    do k = 1, pile%d
      point = point + merge(one, -one, btest(corner - 1, k - 1))*pile%side(k, i)* &
          pile%turn(:, k, i)
    end do
  end function corner_of

  !> Corners of box i in box j, or near a face of it; the normal points to i times sign.
  subroutine touch_corners(pile, i, j, sign_of, reach, touches)
    type(pile_t), intent(in) :: pile
    integer, intent(in) :: i, j
    real(wp), intent(in) :: sign_of, reach
    type(touches_t), intent(inout) :: touches
    real(wp) :: point(3), local(3), depth(3)
    integer :: corner, k, d
    d = pile%d
    do corner = 1, 2**d
      point(:d) = corner_of(pile, i, corner)
      do k = 1, d
        local(k) = sum((point(:d) - pile%place(:, j))*pile%turn(:, k, j))
        depth(k) = pile%side(k, j) - abs(local(k))
      end do
      if (any(depth(:d) < -reach)) cycle
      k = minloc(depth(:d), 1)
      call add_touch(d, point(:d), sign_of*sign(one, local(k))*pile%turn(:, k, j), depth(k), &
          touches)
    end do
  end subroutine touch_corners

  !> A brick of 2 x 1 (x 1), upright, of uneven mass.
  subroutine square_body(state, pile, i)
    integer(i8), intent(inout) :: state
    type(pile_t), intent(inout) :: pile
    integer, intent(in) :: i
    integer :: k
    pile%side(:, i) = half
    pile%side(1, i) = one
    pile%mass(i) = half + draw(state)
    pile%turn(:, :, i) = zero
    pile%spin(:, :, i) = zero
    do k = 1, 3
      pile%spin(k, k, i) = one/(pile%mass(i)*merge(1.0_wp/6.0_wp, 5.0_wp/12.0_wp, &
          k == 1 .and. pile%d == 3))
    end do
  end subroutine square_body

end module packed_bodies
