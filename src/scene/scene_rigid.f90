! SPDX-License-Identifier: BSD-3-Clause
!> Rigid parts: from their meshes and cards to centres, rotors and nodes that follow. It comes
!> after everything else, for the nodes that it adds are not those of a deck.
module scene_rigid
  use base_kinds, only: wp, zero, one
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_problem
  use model_data, only: model_t
  use scene_ids, only: maps_t, records_of, find_or_complain
  use scene_rigid_cards, only: body_t, read_constraints, read_velocities, read_forces, &
      read_rigid_motions
  use scene_rigid_impacts, only: warn_of_impacts
  implicit none
  private
  public :: read_rigid_parts

contains

  !> The rigid parts of the model, with everything that cards say of them.
  subroutine read_rigid_parts(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    type(body_t), allocatable :: body(:)
    integer, allocatable :: body_of(:)
    call join_parts(deck, model, maps, body_of)
    call check_inertia_cards(deck, model, maps)
    if (any(model%part%is_rigid)) then
      call find_bodies(deck, model, body_of, body)
      call find_nodes(deck, model, body_of, body)
      if (deck%problems%count > 0) return
      call check_followers(deck, model, body)
      if (deck%problems%count > 0) return
      call add_nodes(model, body)
    else
      allocate (body(0))
    end if
    call read_constraints(deck, model, body)
    call read_velocities(deck, model, maps, body_of, body)
    call read_forces(deck, model, maps, body_of, body)
    call read_rigid_motions(deck, model, maps, body_of, body)
    if (size(body) == 0) return
    call warn_of_impacts(deck, model, body_of)
  end subroutine read_rigid_parts

  !> The number of the rigid body of each part, 0 = deformable; parts that
  !> *CONSTRAINED_RIGID_BODIES joins are one.
  subroutine join_parts(deck, model, maps, body_of)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, allocatable, intent(out) :: body_of(:)
    integer :: leader(size(model%part)), r, k, n, first, second
    leader = [(k, k=1, size(model%part))]
    r = deck%next('CONSTRAINED_RIGID_BODIES', 1, 0)
    do while (r > 0)
      first = rigid_part(deck, model, maps, r, 'PIDL')
      second = rigid_part(deck, model, maps, r, 'PIDC')
      if (first > 0 .and. second > 0) then
        if (leader(first) == leader(second)) then
          call deck%complain(r, 'PIDC', 'part '//to_text(model%part(second)%id)// &
              ' is of the same rigid body already')
        else
          k = leader(second)
          where (leader == k) leader = leader(first)
        end if
      end if
      r = deck%next('CONSTRAINED_RIGID_BODIES', 1, r)
    end do
    allocate (body_of(size(model%part)))
    body_of = 0
    n = 0
    do k = 1, size(model%part)
      if (.not. model%part(k)%is_rigid .or. leader(k) /= k) cycle
      n = n + 1
      where (leader == k) body_of = n
    end do
  end subroutine join_parts

  !> Row of the rigid part that a field of a card names; 0 and a problem if it is none.
  integer function rigid_part(deck, model, maps, record, field)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer, intent(in) :: record
    character(*), intent(in) :: field
    rigid_part = find_or_complain(deck, maps%part, record, field, &
        deck%integer(record, field), 'part')
    if (rigid_part == 0) return
    if (model%part(rigid_part)%is_rigid) return
    call deck%complain(record, field, 'part '//to_text(model%part(rigid_part)%id)// &
        ' is not rigid', 'its material must be *MAT_RIGID')
    rigid_part = 0
  end function rigid_part

  !> *PART_INERTIA is for rigid parts alone.
  subroutine check_inertia_cards(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(maps_t), intent(in) :: maps
    integer :: r, p
    r = deck%next('PART_INERTIA', 2, 0)
    do while (r > 0)
      p = rigid_part(deck, model, maps, r, 'PID')
      r = deck%next('PART_INERTIA', 2, r)
    end do
  end subroutine check_inertia_cards

  !> Mass, centre and inertia of every rigid body: of its parts, moved to the common centre.
  subroutine find_bodies(deck, model, body_of, body)
    type(deck_t), intent(in) :: deck
    type(model_t), intent(in) :: model
    integer, intent(in) :: body_of(:)
    type(body_t), allocatable, intent(out) :: body(:)
    real(wp) :: mass, centre(2), inertia
    integer :: b, p, pass
    allocate (body(maxval(body_of)))
    do pass = 1, 2
      do p = 1, size(model%part)
        b = body_of(p)
        if (b == 0) cycle
        call part_inertia(deck, model, p, mass, centre, inertia)
        if (pass == 1) then
          if (body(b)%part == 0) body(b)%part = p
          body(b)%mass = body(b)%mass + mass
          body(b)%centre = body(b)%centre + (mass/body(b)%mass)*(centre - body(b)%centre)
        else
          body(b)%inertia = body(b)%inertia + inertia + mass*sum((centre - body(b)%centre)**2)
        end if
      end do
    end do
  end subroutine find_bodies

  !> Mass [M], centre [L] and moment of inertia about it [M L2] of a part: from its elements, or
  !> from *PART_INERTIA.
  subroutine part_inertia(deck, model, p, mass, centre, inertia)
    type(deck_t), intent(in) :: deck
    type(model_t), intent(in) :: model
    integer, intent(in) :: p
    real(wp), intent(out) :: mass, centre(2), inertia
    real(wp) :: origin(2), m, first(2), second, sum_first(2), sum_second
    integer :: e, r
    r = deck%follow(model%part(p)%record, 3)
    if (r > 0) then
      centre = [deck%real(r, 'XC'), deck%real(r, 'YC')]
      mass = deck%real(r, 'TM')
      inertia = deck%real(r + 1, 'IZZ')
      return
    end if
    mass = zero
    sum_first = zero
    sum_second = zero
    origin = model%x(:, model%mesh%node_of(1, findloc(model%mesh%part, p, dim=1)))
    do e = 1, model%mesh%n
      if (model%mesh%part(e) /= p) cycle
      call moments_of_area(model%x(:, model%mesh%nodes_of(e)) &
          - spread(origin, 2, model%mesh%count_of(e)), m, first, second)
      mass = mass + m
      sum_first = sum_first + first
      sum_second = sum_second + second
    end do
    m = model%part(p)%thickness*model%material(model%part(p)%material)%item%density
    centre = sum_first/mass
    inertia = m*(sum_second - mass*sum(centre**2))
    centre = origin + centre
    mass = m*mass
  end subroutine part_inertia

  !> Area of a polygon x (2, corners), counter-clockwise, and its first [L3] and polar second
  !> [L4] moments about the origin: exact, by Green's theorem.
  pure subroutine moments_of_area(x, area, first, second)
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(out) :: area, first(2), second
    real(wp) :: cross
    integer :: k
    area = zero
    first = zero
    second = zero
    do k = 1, size(x, 2)
      associate (a => x(:, k), b => x(:, 1 + mod(k, size(x, 2))))
        cross = a(1)*b(2) - a(2)*b(1)
        area = area + cross/2.0_wp
        first = first + cross*(a + b)/6.0_wp
        second = second + cross*sum(a**2 + a*b + b**2)/12.0_wp
      end associate
    end do
  end subroutine moments_of_area

  !> The nodes of each body. A node of two bodies, or of a body and a deformable part, is a
  !> problem.
  subroutine find_nodes(deck, model, body_of, body)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    integer, intent(in) :: body_of(:)
    type(body_t), intent(inout) :: body(:)
    integer :: owner(model%nodes), e, k, b
    owner = -1
    do e = 1, model%mesh%n
      do k = 1, model%mesh%count_of(e)
        associate (i => model%mesh%node_of(k, e), p => model%mesh%part(e))
          if (owner(i) == -1) owner(i) = p
          if (body_of(owner(i)) /= body_of(p)) call deck%complain(model%mesh%record(e), &
              'N'//achar(48 + k), 'node '//to_text(model%node_id(i))//' belongs to part '// &
              to_text(model%part(owner(i))%id)//' and to part '//to_text(model%part(p)%id)// &
              ', and a rigid part shares no node with another one', 'give each part nodes '// &
              'of its own, or join rigid parts by *CONSTRAINED_RIGID_BODIES')
        end associate
      end do
    end do
    do b = 1, size(body)
      body(b)%node = pack([(k, k=1, model%nodes)], body_of(owner) == b)
    end do
  end subroutine find_nodes

  !> What cards of nodes may not do with nodes of rigid parts.
  subroutine check_followers(deck, model, body)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(body_t), intent(in) :: body(:)
    logical :: is_of(model%nodes)
    integer :: b, k
    do b = 1, size(body)
      is_of = .false.
      is_of(body(b)%node) = .true.
      associate (part => model%part(body(b)%part))
        if (any(model%fixed(:, body(b)%node))) call deck%complain(part%record, 'PID', &
            'a support holds nodes of rigid part '//to_text(part%id), &
            'hold the part by CON1 and CON2 of its *MAT_RIGID')
        do k = 1, size(model%load)
          if (any(is_of(model%load(k)%node))) call deck%complain(part%record, 'PID', &
              'a load acts on nodes of rigid part '//to_text(part%id), &
              'give the part its force and moment by *LOAD_RIGID_BODY')
        end do
        do k = 1, size(model%motion)
          if (any(is_of(model%motion(k)%node))) call deck%complain(model%motion(k)%record, &
              'DOF', 'nodes of rigid part '//to_text(part%id)//' are moved', &
              'move the part by *BOUNDARY_PRESCRIBED_MOTION_RIGID')
        end do
      end associate
    end do
  end subroutine check_followers

  !> Centres and rotors behind the nodes of the mesh.
  subroutine add_nodes(model, body)
    type(model_t), intent(inout) :: model
    type(body_t), intent(in) :: body(:)
    integer :: n, b, k
    n = size(body)
    allocate (model%rigid)
    associate (rigid => model%rigid)
      allocate (rigid%part(n), rigid%centre(n), rigid%rotor(n), rigid%mass(n), &
          rigid%radius(n), rigid%node(0), rigid%of(0))
      do b = 1, n
        rigid%part(b) = body(b)%part
        rigid%centre(b) = model%nodes + b
        rigid%rotor(b) = model%nodes + n + b
        rigid%mass(b) = body(b)%mass
        rigid%radius(b) = sqrt(body(b)%inertia/body(b)%mass)
        rigid%node = [rigid%node, body(b)%node]
        rigid%of = [rigid%of, spread(b, 1, size(body(b)%node))]
      end do
      allocate (rigid%arm(2, size(rigid%node)))
      do k = 1, size(rigid%node)
        rigid%arm(:, k) = model%x(:, rigid%node(k)) - body(rigid%of(k))%centre
      end do
    end associate
    model%node_id = [model%node_id, spread(0, 1, 2*n)]
    model%x = reshape([model%x, (body(b)%centre, b=1, n), (body(b)%centre, b=1, n)], &
        [2, model%nodes + 2*n])
    model%v0 = reshape([model%v0, spread(zero, 1, 4*n)], [2, model%nodes + 2*n])
    model%fixed = reshape([model%fixed, spread(.false., 1, 4*n)], [2, model%nodes + 2*n])
    model%nodes = model%nodes + 2*n
    model%fixed(2, model%rigid%rotor) = .true.
  end subroutine add_nodes

end module scene_rigid
