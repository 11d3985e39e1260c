! SPDX-License-Identifier: BSD-3-Clause
!> Contact problems of rigid bodies piled up in a box under their weight, as granular matter
!> makes them: W = H M^-1 H' by blocks, coupled where two contacts have a body in common.
!>   BALLS   discs or spheres of uneven radii
!>   ROCKS   rectangles or boxes, turned at random; corners of one touch faces of another
!>   BRICKS  a wall in running bond, two or four contacts where one brick lies on another
!> The same seed gives the same problem.
module packed_contacts
  use base_kinds, only: wp, i8, zero, one, half
  use cone_blocks, only: delassus_blocks_t, blocks_from_rows
  use packed_bodies, only: packing_t, pile_t, touches_t, draw, allocate_pile, start_pile, &
      settle, find_touches, make_body, square_body
  implicit none
  private
  public :: make_packing, packing_t

  character(8), parameter, public :: packing_kinds(3) = [character(8) :: 'BALLS', 'ROCKS', &
      'BRICKS']

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
