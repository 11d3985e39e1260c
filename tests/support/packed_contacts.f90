! SPDX-License-Identifier: BSD-3-Clause
!> Contact problems of rigid bodies piled up in a box under their weight, as programs of granular
!> matter make them: W = H M^-1 H' by blocks, coupled where two contacts have a body in common.
!>   BALLS   discs or spheres of uneven radii
!>   ROCKS   rectangles or boxes, turned at random; corners of one touch faces of another
!>   BRICKS  a wall in running bond, two or four contacts where one brick lies on another
!> The same seed gives the same problem.
module packed_contacts
  use base_kinds, only: wp, i8, zero, one, half
  use cone_blocks, only: delassus_blocks_t, blocks_from_rows
  implicit none
  private
  public :: make_packing

  character(8), parameter, public :: packing_kinds(3) = [character(8) :: 'BALLS', 'ROCKS', &
      'BRICKS']
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

  type :: pile_t
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
  type :: touches_t
    integer :: n = 0
    real(wp) :: point(3, most_touches), normal(3, most_touches), depth(most_touches)
  end type touches_t

  !> Contacts: bodies (0 = box), points, axes n, t, s by rows.
  type :: contacts_t
    integer :: n = 0
    integer, allocatable :: low(:), high(:)
    real(wp), allocatable :: point(:, :), axis(:, :, :)
  end type contacts_t

contains

  !> W, q and mu of the packing; lengths in mean radii, the weight of a body of mean size and
  !> the step are 1.
  subroutine make_packing(packing, w, q, mu)
    type(packing_t), intent(in) :: packing
    type(delassus_blocks_t), intent(out) :: w
    real(wp), allocatable, intent(out) :: q(:, :), mu(:)
    type(pile_t) :: pile
    type(contacts_t) :: contacts
    integer(i8) :: state
    state = 7919_i8*packing%seed + 12345_i8
    if (packing%kind == 'BRICKS') then
      call lay_bricks(packing, state, pile, contacts)
    else
      call start_pile(packing, state, pile)
      call settle(pile)
      call find_contacts(pile, packing%reach, contacts)
    end if
    allocate (q(packing%d, contacts%n), mu(contacts%n))
    mu = packing%mu
    call make_w(pile, contacts, w)
    call make_q(pile, contacts, packing%motion, state, q)
  end subroutine make_packing

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

  !> All contacts of the pile at rest.
  subroutine find_contacts(pile, reach, contacts)
    type(pile_t), intent(in) :: pile
    real(wp), intent(in) :: reach
    type(contacts_t), intent(out) :: contacts
    type(touches_t) :: touches
    integer :: i, j, k
    call allocate_contacts(pile%d, 40*pile%n, contacts)
    do i = 1, pile%n
      do j = 0, i - 1
        call find_touches(pile, j, i, reach, touches)
        do k = 1, touches%n
          call add_contact(j, i, touches%point(:pile%d, k), touches%normal(:pile%d, k), &
              contacts)
        end do
      end do
    end do
  end subroutine find_contacts

  subroutine allocate_contacts(d, most, contacts)
    integer, intent(in) :: d, most
    type(contacts_t), intent(out) :: contacts
    allocate (contacts%low(most), contacts%high(most), contacts%point(d, most))
    allocate (contacts%axis(d, d, most))
  end subroutine allocate_contacts

  !> Tangents: any.
  subroutine add_contact(low, high, point, normal, contacts)
    integer, intent(in) :: low, high
    real(wp), intent(in) :: point(:), normal(:)
    type(contacts_t), intent(inout) :: contacts
    real(wp) :: t(size(normal))
    integer :: n, k
    if (contacts%n == size(contacts%low)) return
    contacts%n = contacts%n + 1
    n = contacts%n
    contacts%low(n) = low
    contacts%high(n) = high
    contacts%point(:, n) = point
    contacts%axis(1, :, n) = normal
    if (size(normal) == 2) then
      contacts%axis(2, :, n) = [-normal(2), normal(1)]
    else
      k = minloc(abs(normal), 1)
      t = -normal(k)*normal
      t(k) = t(k) + one
      t = t/norm2(t)
      contacts%axis(2, :, n) = t
      contacts%axis(3, :, n) = cross_product(normal, t)
    end if
  end subroutine add_contact

  pure function cross_product(a, b) result(c)
    real(wp), intent(in) :: a(3), b(3)
    real(wp) :: c(3)
    c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function cross_product

  !> A wall of bricks, each on two halves; contacts near the corners of what they share.
  subroutine lay_bricks(packing, state, pile, contacts)
    type(packing_t), intent(in) :: packing
    integer(i8), intent(inout) :: state
    type(pile_t), intent(out) :: pile
    type(contacts_t), intent(out) :: contacts
    integer :: i, row, across, rows, d
    d = packing%d
    across = max(2, nint(sqrt(real(packing%bodies, wp))))
    rows = max(1, packing%bodies/across)
    call allocate_pile(d, across*rows, pile)
    pile%round = .false.
    call allocate_contacts(d, 8*pile%n, contacts)
    do i = 1, pile%n
      call make_body(state, pile, i)
      call square_body(state, pile, i)
      row = (i - 1)/across
      pile%place(:, i) = zero
      pile%place(1, i) = 2.0_wp*mod(i - 1, across) + mod(row, 2)
      pile%place(d, i) = row + half
      if (row == 0) then
        call lay_on(state, pile, 0, i, -one, one, contacts)
      else
        call lay_on(state, pile, i - across, i, -one + mod(row, 2), real(mod(row, 2), wp), &
            contacts)
        if (mod(row, 2) == 1 .and. mod(i, across) /= 0) &
            call lay_on(state, pile, i - across + 1, i, zero, one, contacts)
        if (mod(row, 2) == 0 .and. mod(i - 1, across) /= 0) &
            call lay_on(state, pile, i - across - 1, i, -one, zero, contacts)
      end if
    end do
  end subroutine lay_bricks

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

  !> Contacts of brick `high` on `low` between two places along it.
  subroutine lay_on(state, pile, low, high, from, to, contacts)
    integer(i8), intent(inout) :: state
    type(pile_t), intent(in) :: pile
    integer, intent(in) :: low, high
    real(wp), intent(in) :: from, to
    type(contacts_t), intent(inout) :: contacts
    real(wp) :: point(pile%d), normal(pile%d)
    integer :: k, d
    d = pile%d
    do k = 1, merge(2, 4, d == 2)
      point = pile%place(:, high)
      point(1) = point(1) + merge(from + 0.1_wp*draw(state), to - 0.1_wp*draw(state), &
          mod(k, 2) == 1)
      if (d == 3) point(2) = merge(-half, half, k > 2) + 0.1_wp*(draw(state) - half)
      point(d) = point(d) - half
      normal = 0.02_wp*(draw(state) - half)
      normal(d) = one
      call add_contact(low, high, point, normal/norm2(normal), contacts)
    end do
  end subroutine lay_on

  !> Motion of contact a by a unit of force and moment on its body: H_a' (d, d + rotations).
  pure subroutine contact_rows(pile, contacts, a, body, rows)
    type(pile_t), intent(in) :: pile
    type(contacts_t), intent(in) :: contacts
    integer, intent(in) :: a, body
    real(wp), intent(out) :: rows(:, :)
    real(wp) :: arm(3), axis(3), sign_of
    integer :: i, d
    d = pile%d
    arm = zero
    arm(:d) = contacts%point(:, a) - pile%place(:, body)
    sign_of = merge(one, -one, contacts%high(a) == body)
    rows = zero
    do i = 1, d
      axis = zero
      axis(:d) = contacts%axis(i, :, a)
      rows(i, :d) = sign_of*axis(:d)
      rows(i, 4:6) = sign_of*cross_product(arm, axis)
    end do
  end subroutine contact_rows

  !> W_ab = sum over the bodies of both of H_a' M^-1 H_b.
  subroutine make_w(pile, contacts, w)
    type(pile_t), intent(in) :: pile
    type(contacts_t), intent(in) :: contacts
    type(delassus_blocks_t), intent(out) :: w
    integer, allocatable :: pointer(:), columns(:), of_body(:, :), count_of(:), other(:)
    real(wp), allocatable :: values(:), block(:, :, :)
    integer :: a, b, i, k, m, d, n
    d = pile%d
    call list_contacts(pile, contacts, of_body, count_of)
    n = sum(count_of**2)
    allocate (pointer(d*contacts%n + 1), columns(d*d*n), values(d*d*n))
    allocate (other(2*maxval(count_of)), block(d, d, 2*maxval(count_of)))
    k = 0
    do a = 1, contacts%n
      call couple(pile, contacts, of_body, count_of, a, n, other, block)
      do i = 1, d
        pointer(d*(a - 1) + i) = k + 1
        do b = 1, n
          columns(k + 1:k + d) = [(d*(other(b) - 1) + m, m=1, d)]
          values(k + 1:k + d) = block(i, :, b)
          k = k + d
        end do
      end do
    end do
    pointer(d*contacts%n + 1) = k + 1
    call blocks_from_rows(d, pointer, columns(:k), values(:k), w)
  end subroutine make_w

  !> The contacts of each body: of_body(:count_of(i), i).
  pure subroutine list_contacts(pile, contacts, of_body, count_of)
    type(pile_t), intent(in) :: pile
    type(contacts_t), intent(in) :: contacts
    integer, allocatable, intent(out) :: of_body(:, :), count_of(:)
    integer :: a, side, body
    allocate (of_body(contacts%n, pile%n), count_of(pile%n))
    count_of = 0
    do a = 1, contacts%n
      do side = 1, 2
        body = merge(contacts%high(a), contacts%low(a), side == 1)
        if (body == 0) cycle
        count_of(body) = count_of(body) + 1
        of_body(count_of(body), body) = a
      end do
    end do
  end subroutine list_contacts

  !> The blocks (d, d, n) of the row of contact a, and the contacts they belong to; one that has
  !> both bodies in common with a is there twice.
  pure subroutine couple(pile, contacts, of_body, count_of, a, n, other, block)
    type(pile_t), intent(in) :: pile
    type(contacts_t), intent(in) :: contacts
    integer, intent(in) :: of_body(:, :), count_of(:), a
    integer, intent(out) :: n, other(:)
    real(wp), intent(out) :: block(:, :, :)
    real(wp) :: own(pile%d, 6), rows(pile%d, 6)
    integer :: side, body, b
    n = 0
    do side = 1, 2
      body = merge(contacts%high(a), contacts%low(a), side == 1)
      if (body == 0) cycle
      call contact_rows(pile, contacts, a, body, own)
      own(:, :3) = own(:, :3)/pile%mass(body)
      own(:, 4:) = matmul(own(:, 4:), pile%spin(:, :, body))
      do b = 1, count_of(body)
        n = n + 1
        other(n) = of_body(b, body)
        call contact_rows(pile, contacts, other(n), body, rows)
        block(:, :, n) = matmul(own, transpose(rows))
      end do
    end do
  end subroutine couple

  !> Motions without reactions: one step of weight, and what the bodies had before.
  subroutine make_q(pile, contacts, motion, state, q)
    type(pile_t), intent(in) :: pile
    type(contacts_t), intent(in) :: contacts
    real(wp), intent(in) :: motion
    integer(i8), intent(inout) :: state
    real(wp), intent(out) :: q(:, :)
    real(wp) :: v(6, pile%n), rows(pile%d, 6)
    integer :: a, i, k
    v = zero
    do i = 1, pile%n
      do k = 1, 6
        if (k > pile%d .and. k < 6 .and. pile%d == 2) cycle
        v(k, i) = motion*(draw(state) - half)
      end do
      v(pile%d, i) = v(pile%d, i) - one
    end do
    do a = 1, contacts%n
      call contact_rows(pile, contacts, a, contacts%high(a), rows)
      q(:, a) = matmul(rows, v(:, contacts%high(a)))
      if (contacts%low(a) == 0) cycle
      call contact_rows(pile, contacts, a, contacts%low(a), rows)
      q(:, a) = q(:, a) + matmul(rows, v(:, contacts%low(a)))
    end do
  end subroutine make_q

end module packed_contacts
