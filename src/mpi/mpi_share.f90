! SPDX-License-Identifier: BSD-3-Clause
!> Both ends of how the first rank gives the others their elements: nodes and stiffness, and
!> which entries of the graph of the scene each has.
module mpi_share
  use assembly_blocks, only: element_block_t, find_stiffness, sort_stiffness
  use assembly_ring, only: ring_unknowns
  use base_kinds, only: wp
  use element_bending, only: quad_mode_moduli
  use linalg_graph, only: graph_t
  use model_data, only: model_t
  use mpi_domain, only: domain_t, make_graph
  use mpi_link, only: link_t, header_length, send_numbers, receive_numbers, send_integers, &
      receive_integers, waiting_numbers
  use mpi_tasks, only: i2, l1, task_share
  implicit none
  private

  !> What the first rank knows of the domain of each.
  type, public :: part_t
    integer, allocatable :: element(:)   !< its elements in the scene, increasing
    integer, allocatable :: node(:)      !< its nodes in the scene, increasing
    !> Of the first rank, for each entry of its graph the place in that of the scene, 0 where
    !> another rank has it. (Of the others see owner_of in SEND_DOMAINS.)
    integer, allocatable :: pair(:)
  end type part_t

  integer, parameter :: columns = 4      !< of what describes a block
  integer, parameter :: chunk = 2048     !< elements whose stiffness waits to be sent

  public :: make_parts, send_domains, receive_domain

contains

  !> Elements and nodes of each rank; place (elements): of each one in its rank's list.
  subroutine make_parts(ranks, nodes, block, block_of, owner, part, place)
    integer, intent(in) :: ranks, nodes
    type(element_block_t), intent(in) :: block(:)
    integer, intent(in) :: block_of(:), owner(:)
    type(part_t), allocatable, intent(out) :: part(:)
    integer, allocatable, intent(out) :: place(:)
    logical, allocatable :: is_own(:)
    integer :: r, e, k
    allocate (part(0:ranks - 1), place(size(owner)), is_own(nodes))
    place = 0
    do r = 0, ranks - 1
      part(r)%element = pack([(e, e=1, size(owner))], owner == r)
      is_own = .false.
      do k = 1, size(part(r)%element)
        e = part(r)%element(k)
        place(e) = k
        is_own(block(block_of(e))%node(:, e - block(block_of(e))%first + 1)) = .true.
      end do
      part(r)%node = pack([(k, k=1, nodes)], is_own)
    end do
  end subroutine make_parts

  !> Domains of all ranks from the first one; own is its own. modes: see assembly_team.
  !> owner_of: the rank of each entry of the graph, 0 for the first. Both ends have entries in
  !> the same order, for nodes of a rank are in that of the scene.
  subroutine send_domains(link, model, graph, block, owner, part, own, owner_of, modes)
    type(link_t), intent(in) :: link
    type(model_t), intent(in) :: model
    type(graph_t), intent(in) :: graph
    type(element_block_t), intent(in) :: block(:)
    integer, intent(in) :: owner(:)
    type(part_t), intent(inout) :: part(0:)
    type(domain_t), intent(inout) :: own
    integer(i2), allocatable, intent(out) :: owner_of(:)
    real(wp), allocatable, intent(inout) :: modes(:, :)
    integer, allocatable :: shape_of(:, :), member(:)
    integer :: r, b
    do r = link%ranks - 1, 0, -1
      call describe(model%dim, model%nodes, block, owner, r, part(r), shape_of, member)
      if (r == 0) exit
      call send_numbers(link, r, header_length, [real(wp) :: task_share, model%dim, &
          size(block), size(part(r)%node), size(member), spread(0, 1, header_length - 5)])
      call send_integers(link, r, size(shape_of), shape_of)
      call send_integers(link, r, size(part(r)%node), part(r)%node)
      call send_integers(link, r, size(member), member)
    end do
    call make_domain(model%dim, part(0)%node, shape_of, member, own)
    do b = 1, size(block)
      if (block(b)%is_rigid) cycle
      call send_stiffness(link, model, block(b), owner, own%system%block(b), modes)
      call sort_stiffness(own%system%block(b))
    end do
    allocate (owner_of(size(graph%column)), source=0_i2)
    do r = 1, link%ranks - 1
      call take_graph(link, graph, r, part(r), owner_of)
    end do
    call keep_rest(graph, part(0), own, owner_of)
  end subroutine send_domains

  !> The blocks of a rank, (nodes of an element, 1 = ring, order of its stiffness, elements),
  !> and the nodes of its elements, numbered among themselves.
  subroutine describe(dim, nodes, block, owner, rank, part, shape_of, member)
    integer, intent(in) :: dim, nodes
    type(element_block_t), intent(in) :: block(:)
    integer, intent(in) :: owner(:), rank
    type(part_t), intent(in) :: part
    integer, allocatable, intent(out) :: shape_of(:, :), member(:)
    integer :: local(nodes), b, k, m, pass
    local(part%node) = [(k, k=1, size(part%node))]
    allocate (shape_of(columns, size(block)))
    do pass = 1, 2
      m = 0
      do b = 1, size(block)
        associate (from => block(b))
          shape_of(:, b) = [from%nodes, merge(1, 0, from%is_ring), dim*(from%nodes - 1), &
              count(owner(from%first:from%last) == rank)]
          if (from%is_ring) shape_of(3, b) = size(ring_unknowns(from%nodes))
          do k = 1, merge(size(from%node, 2), 0, shape_of(4, b) > 0)
            if (owner(from%first + k - 1) /= rank) cycle
            if (pass == 2) member(m + 1:m + from%nodes) = local(from%node(:, k))
            m = m + from%nodes
          end do
        end associate
      end do
      if (pass == 1) allocate (member(m))
    end do
  end subroutine describe

  !> Blocks without stiffness; those of which the rank has nothing count as rigid.
  subroutine make_domain(dim, node, shape_of, member, domain)
    integer, intent(in) :: dim, node(:), shape_of(:, :), member(:)
    type(domain_t), intent(out) :: domain
    integer :: b, m, e
    domain%node = node
    associate (s => domain%system)
      s%n = size(node)
      s%dim = dim
      allocate (s%block(size(shape_of, 2)), s%block_of(sum(shape_of(4, :))))
      m = 0
      e = 0
      do b = 1, size(s%block)
        associate (own => s%block(b), n => shape_of(4, b))
          own%nodes = shape_of(1, b)
          own%is_ring = shape_of(2, b) == 1
          own%is_rigid = n == 0
          own%first = e + 1
          own%last = e + n
          own%node = reshape(member(m + 1:m + n*own%nodes), [own%nodes, n])
          allocate (own%stiffness(shape_of(3, b), shape_of(3, b), n))
          s%block_of(e + 1:e + n) = b
          m = m + n*own%nodes
          e = e + n
        end associate
      end do
    end associate
  end subroutine make_domain

  !> Stiffness of a block, some elements at a time, to the ranks that have them.
  subroutine send_stiffness(link, model, block, owner, own, modes)
    type(link_t), intent(in) :: link
    type(model_t), intent(in) :: model
    type(element_block_t), intent(in) :: block
    integer, intent(in) :: owner(:)
    type(element_block_t), intent(inout) :: own
    real(wp), allocatable, intent(inout) :: modes(:, :)
    real(wp), allocatable :: k(:, :, :)
    integer :: from, to, r, i, n
    integer, allocatable :: pick(:)
    n = 0
    do from = 1, size(block%node, 2), chunk
      to = min(from + chunk - 1, size(block%node, 2))
      call find_stiffness(model, block, from, to, k)
      if (model%dim == 2 .and. block%nodes == 4 .and. .not. block%is_ring) then
        do i = from, to
          modes(:, block%first + i - 1) = quad_mode_moduli(k(:, :, i - from + 1))
        end do
      end if
      do r = 0, link%ranks - 1
        pick = pack([(i, i=1, to - from + 1)], &
            owner(block%first + from - 1:block%first + to - 1) == r)
        if (r > 0 .and. size(pick) > 0) then
          call send_numbers(link, r, size(pick)*size(k, 1)**2, k(:, :, pick))
        else if (r == 0) then
          own%stiffness(:, :, n + 1:n + size(pick)) = k(:, :, pick)
          n = n + size(pick)
        end if
      end do
    end do
  end subroutine send_stiffness

  !> Which entries of the graph of the scene a rank has: it sends its own graph and is told.
  subroutine take_graph(link, graph, rank, part, owner_of)
    type(link_t), intent(in) :: link
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: rank
    type(part_t), intent(inout) :: part
    integer(i2), intent(inout) :: owner_of(:)
    type(graph_t) :: own
    integer :: i, k, at
    own%n = size(part%node)
    allocate (own%first(own%n + 1))
    call receive_integers(link, rank, own%n + 1, own%first)
    allocate (own%column(own%first(own%n + 1) - 1))
    call receive_integers(link, rank, size(own%column), own%column)
    do i = 1, own%n
      do k = own%first(i), own%first(i + 1) - 1
        at = graph%position(part%node(i), part%node(own%column(k)))
        own%column(k) = merge(1, 0, owner_of(at) == 0_i2)
        if (own%column(k) == 1) owner_of(at) = int(rank, i2)
      end do
    end do
    call send_integers(link, rank, size(own%column), own%column)
  end subroutine take_graph

  !> The places of the first rank's entries, once the others have theirs.
  subroutine take_entries(graph, own, part, owner_of, is_taken)
    type(graph_t), intent(in) :: graph, own
    type(part_t), intent(inout) :: part
    integer(i2), intent(in) :: owner_of(:)
    logical(l1), intent(inout) :: is_taken(:)
    integer :: i, k, at
    is_taken = .false.
    if (allocated(part%pair)) deallocate (part%pair)
    allocate (part%pair(size(own%column)))
    do i = 1, own%n
      do k = own%first(i), own%first(i + 1) - 1
        at = graph%position(part%node(i), part%node(own%column(k)))
        part%pair(k) = merge(at, 0, owner_of(at) == 0_i2)
        is_taken(at) = .true.
      end do
    end do
  end subroutine take_entries

  !> The first rank has the other entries: of its elements, and pairs that no element joins.
  subroutine keep_rest(graph, part, own, owner_of)
    type(graph_t), intent(in) :: graph
    type(part_t), intent(inout) :: part
    type(domain_t), intent(inout) :: own
    integer(i2), intent(in) :: owner_of(:)
    logical(l1), allocatable :: is_taken(:)
    logical, allocatable :: is_own(:)
    integer, allocatable :: pair(:, :), local(:)
    integer :: i, k, n, pass
    allocate (is_taken(size(owner_of)))
    call make_graph(own, reshape([integer ::], [2, 0]))
    call take_entries(graph, own%system%graph, part, owner_of, is_taken)
    allocate (is_own(graph%n), source=.false.)
    is_own(part%node) = .true.
    do pass = 1, 2
      n = 0
      do i = 1, graph%n
        do k = graph%first(i), graph%first(i + 1) - 1
          if (is_taken(k) .or. owner_of(k) > 0_i2 .or. graph%column(k) > i) cycle
          n = n + 1
          if (pass == 2) pair(:, n) = [i, graph%column(k)]
          is_own([i, graph%column(k)]) = .true.
        end do
      end do
      if (n == 0) return
      if (pass == 1) allocate (pair(2, n))
    end do
    call renumber(is_own, part, own, local)
    pair = reshape(local(reshape(pair, [2*n])), [2, n])
    call make_graph(own, pair)
    call take_entries(graph, own%system%graph, part, owner_of, is_taken)
  end subroutine keep_rest

  !> More nodes for the first rank.
  subroutine renumber(is_own, part, own, local)
    logical, intent(in) :: is_own(:)
    type(part_t), intent(inout) :: part
    type(domain_t), intent(inout) :: own
    integer, allocatable, intent(out) :: local(:)
    integer, allocatable :: old(:)
    integer :: b, k
    call move_alloc(part%node, old)
    part%node = pack([(k, k=1, size(is_own))], is_own)
    allocate (local(size(is_own)), source=0)
    local(part%node) = [(k, k=1, size(part%node))]
    do b = 1, size(own%system%block)
      associate (node => own%system%block(b)%node)
        do k = 1, size(node, 2)
          node(:, k) = local(old(node(:, k)))
        end do
      end associate
    end do
    own%node = part%node
    own%system%n = size(part%node)
  end subroutine renumber

  !> The other end: the domain of a rank, whose graph goes back. header: of the task.
  subroutine receive_domain(link, header, domain)
    type(link_t), intent(in) :: link
    real(wp), intent(in) :: header(header_length)
    type(domain_t), intent(inout) :: domain
    integer, allocatable :: shape_of(:, :), node(:), member(:), taken(:)
    integer :: b, from, n
    allocate (shape_of(columns, nint(header(3))), node(nint(header(4))), &
        member(nint(header(5))))
    call receive_integers(link, 0, size(shape_of), shape_of)
    call receive_integers(link, 0, size(node), node)
    call receive_integers(link, 0, size(member), member)
    call make_domain(nint(header(2)), node, shape_of, member, domain)
    do b = 1, size(domain%system%block)
      associate (own => domain%system%block(b))
        from = 0
        do while (from < size(own%node, 2))
          call receive_some(link, size(own%stiffness, 1), own%stiffness(:, :, from + 1:), n)
          from = from + n
        end do
        call sort_stiffness(own)
      end associate
    end do
    call make_graph(domain, reshape([integer ::], [2, 0]))
    associate (graph => domain%system%graph)
      call send_integers(link, 0, size(graph%first), graph%first)
      call send_integers(link, 0, size(graph%column), graph%column)
      if (allocated(domain%is_own)) deallocate (domain%is_own)
      allocate (taken(size(graph%column)), domain%is_own(size(graph%column)))
      call receive_integers(link, 0, size(taken), taken)
      domain%is_own = logical(taken == 1, l1)
    end associate
  end subroutine receive_domain

  !> The next n elements, of m unknowns, into the front of k.
  subroutine receive_some(link, m, k, n)
    type(link_t), intent(in) :: link
    integer, intent(in) :: m
    real(wp), contiguous, intent(inout) :: k(:, :, :)
    integer, intent(out) :: n
    n = waiting_numbers(link, 0)/m**2
    call receive_numbers(link, 0, n*m**2, k)
  end subroutine receive_some

end module mpi_share
