! SPDX-License-Identifier: BSD-3-Clause
!> The ranks as the first one sees them: it hands out tasks, does its own part, and adds up in
!> the order of the ranks.
module mpi_team
  use assembly_blocks, only: element_block_t, largest_stiffness
  use assembly_team, only: team_t
  use base_kinds, only: wp, zero
  use base_status, only: status_t, failed
  use linalg_graph, only: graph_t
  use linalg_solver, only: solver_t, solver_options_t
  use model_data, only: model_t
  use mpi_domain, only: domain_t, find_forces, find_weighted_forces, find_products, &
      list_forces, list_products, assemble
  use mpi_link, only: link_t, header_length, close_link, send_numbers, receive_numbers, &
      send_integers, give_back_memory
  use mpi_partition, only: find_owners
  use mpi_share, only: part_t, make_parts, send_domains
  use mpi_solver, only: mumps_t
  use mpi_tasks, only: i2, task_leave, task_forces, task_weighted_forces, task_list_forces, &
      task_list_products, task_products, task_assemble, task_largest, most_engines
  implicit none
  private

  type, extends(team_t), public :: cluster_t
    type(link_t) :: link
    type(domain_t) :: domain             !< of the first rank
    type(part_t), allocatable :: part(:) !< (0:ranks-1)
    integer, allocatable :: owner(:), place(:)   !< (elements) rank, and place in its list
    integer(i2), allocatable :: owner_of(:)      !< rank of each entry of the graph
    real(wp), allocatable :: buffer(:, :)        !< (dim, most nodes of a rank)
    logical :: engine_is_used(most_engines) = .false.
  contains
    procedure :: share => cluster_share
    procedure :: subtract_forces => cluster_subtract_forces
    procedure :: subtract_chosen => cluster_subtract_chosen
    procedure :: block_products => cluster_block_products
    procedure :: chosen_products => cluster_chosen_products
    procedure :: assemble => cluster_assemble
    procedure :: largest_stiffness => cluster_largest_stiffness
    procedure :: make_solver => cluster_make_solver
    procedure :: dismiss => cluster_dismiss
  end type cluster_t

contains

  subroutine cluster_share(this, model, graph, block, modes, status)
    class(cluster_t), intent(inout) :: this
    type(model_t), intent(in) :: model
    type(graph_t), intent(in) :: graph
    type(element_block_t), intent(in) :: block(:)
    real(wp), allocatable, intent(out) :: modes(:, :)
    type(status_t), intent(inout) :: status
    integer :: block_of(model%mesh%n), b, r, most
    do b = 1, size(block)
      block_of(block(b)%first:block(b)%last) = b
    end do
    call find_owners(this%ranks, model%nodes, model%dim, block, block_of, this%owner, status)
    if (failed(status)) return
    call make_parts(this%ranks, model%nodes, block, block_of, this%owner, this%part, this%place)
    if (model%dim == 2) allocate (modes(3, model%mesh%n), source=zero)
    call send_domains(this%link, model, graph, block, this%owner, this%part, this%domain, &
        this%owner_of, modes)
    most = 0
    do r = 0, this%ranks - 1
      most = max(most, size(this%part(r)%node))
    end do
    if (allocated(this%buffer)) deallocate (this%buffer)
    allocate (this%buffer(model%dim, most))
    call give_back_memory()
  end subroutine cluster_share

  !> The header of a task, with up to three numbers.
  subroutine hand_out(this, rank, task, a, b)
    class(cluster_t), intent(in) :: this
    integer, intent(in) :: rank, task
    real(wp), intent(in) :: a, b
    real(wp) :: header(header_length)
    header = zero
    header(:3) = [real(task, wp), a, b]
    call send_numbers(this%link, rank, header_length, header)
  end subroutine hand_out

  !> Values u (dim, n) of the nodes of a rank.
  subroutine send_nodes(this, rank, u)
    class(cluster_t), intent(inout) :: this
    integer, intent(in) :: rank
    real(wp), intent(in) :: u(:, :)
    integer :: k
    associate (node => this%part(rank)%node)
      if (rank == 0) then
        do k = 1, size(node)
          this%domain%u(:, k) = u(:, node(k))
        end do
        return
      end if
      do k = 1, size(node)
        this%buffer(:, k) = u(:, node(k))
      end do
      call send_numbers(this%link, rank, size(u, 1)*size(node), this%buffer)
    end associate
  end subroutine send_nodes

  !> f (dim, n) = f + what each rank has found at its nodes.
  subroutine add_nodes(this, f)
    class(cluster_t), intent(inout) :: this
    real(wp), intent(inout) :: f(:, :)
    integer :: r, k
    do k = 1, size(this%part(0)%node)
      associate (i => this%part(0)%node(k))
        f(:, i) = f(:, i) + this%domain%f(:, k)
      end associate
    end do
    do r = 1, this%ranks - 1
      associate (node => this%part(r)%node)
        call receive_numbers(this%link, r, size(f, 1)*size(node), this%buffer)
        do k = 1, size(node)
          f(:, node(k)) = f(:, node(k)) + this%buffer(:, k)
        end do
      end associate
    end do
  end subroutine add_nodes

  subroutine cluster_subtract_forces(this, factor, u, f)
    class(cluster_t), intent(inout) :: this
    real(wp), intent(in) :: factor, u(:, :)
    real(wp), intent(inout) :: f(:, :)
    integer :: r
    do r = this%ranks - 1, 0, -1
      if (r > 0) call hand_out(this, r, task_forces, factor, zero)
      call send_nodes(this, r, u)
    end do
    call find_forces(this%domain, factor)
    call add_nodes(this, f)
  end subroutine cluster_subtract_forces

  !> Of many elements all ranks make the whole product, of a few that of each one.
  subroutine cluster_subtract_chosen(this, block, block_of, element, weight, u, f)
    class(cluster_t), intent(inout) :: this
    type(element_block_t), intent(in) :: block(:)
    integer, intent(in) :: block_of(:), element(:)
    real(wp), intent(in) :: weight(:), u(:, :)
    real(wp), intent(inout) :: f(:, :)
    real(wp), allocatable :: whole(:), d(:, :)
    integer, allocatable :: start(:)
    integer :: r, k
    if (size(element) > size(this%owner)/8) then
      allocate (whole(size(this%owner)), source=zero)
      whole(element) = weight(min(1, size(weight)))
      if (size(weight) > 1) whole(element) = weight
      do r = this%ranks - 1, 1, -1
        call hand_out(this, r, task_weighted_forces, zero, zero)
        call send_numbers(this%link, r, size(this%part(r)%element), &
            whole(this%part(r)%element))
        call send_nodes(this, r, u)
      end do
      call send_nodes(this, 0, u)
      call find_weighted_forces(this%domain, whole(this%part(0)%element))
      call add_nodes(this, f)
      return
    end if
    call gather_elements(block, block_of, element, weight, u, start, d)
    call work_on_list(this, element, start, task_list_forces, d)
    do k = 1, size(element)
      if (start(k + 1) == start(k)) cycle
      associate (own => block(block_of(element(k))))
        associate (node => own%node(:, element(k) - own%first + 1))
          f(:, node) = f(:, node) + d(:, start(k):start(k + 1) - 1)
        end associate
      end associate
    end do
  end subroutine cluster_subtract_chosen

  !> d(:, start(k)..) = weight(k) u at the nodes of element k; nothing of rigid ones.
  subroutine gather_elements(block, block_of, element, weight, u, start, d)
    type(element_block_t), intent(in) :: block(:)
    integer, intent(in) :: block_of(:), element(:)
    real(wp), intent(in) :: weight(:), u(:, :)
    integer, allocatable, intent(out) :: start(:)
    real(wp), allocatable, intent(out) :: d(:, :)
    integer :: k
    allocate (start(size(element) + 1))
    start(1) = 1
    do k = 1, size(element)
      associate (own => block(block_of(element(k))))
        start(k + 1) = start(k) + merge(0, own%nodes, own%is_rigid)
      end associate
    end do
    allocate (d(size(u, 1), start(size(start)) - 1))
    do k = 1, size(element)
      if (start(k + 1) == start(k)) cycle
      associate (own => block(block_of(element(k))))
        d(:, start(k):start(k + 1) - 1) = weight(min(k, size(weight)))* &
            u(:, own%node(:, element(k) - own%first + 1))
      end associate
    end do
  end subroutine gather_elements

  !> d becomes - K d of the elements, or value their products.
  subroutine work_on_list(this, element, start, task, d, value)
    class(cluster_t), intent(inout) :: this
    integer, intent(in) :: element(:), start(:), task
    real(wp), intent(inout) :: d(:, :)
    real(wp), intent(inout), optional :: value(:)
    real(wp), allocatable :: own_d(:, :), own_value(:)
    integer, allocatable :: pick(:), nodes(:)
    integer :: r, k, n, pass
    do pass = 1, 2    ! all ranks have their tasks before the first result is waited for
      do r = this%ranks - 1, 0, -1
        pick = pack([(k, k=1, size(element))], this%owner(element) == r)
        if (size(pick) == 0 .or. (r == 0 .and. pass == 1)) cycle
        nodes = [([(n, n=start(pick(k)), start(pick(k) + 1) - 1)], k=1, size(pick))]
        if (pass == 1) then
          call hand_out(this, r, task, real(size(pick), wp), real(size(nodes), wp))
          call send_integers(this%link, r, size(pick), this%place(element(pick)))
          call send_numbers(this%link, r, size(d, 1)*size(nodes), d(:, nodes))
          cycle
        end if
        own_d = d(:, nodes)
        if (allocated(own_value)) deallocate (own_value)
        allocate (own_value(size(pick)))
        if (r > 0 .and. present(value)) then
          call receive_numbers(this%link, r, size(pick), own_value)
        else if (r > 0) then
          call receive_numbers(this%link, r, size(own_d), own_d)
        else if (present(value)) then
          call list_products(this%domain, this%place(element(pick)), own_d, own_value)
        else
          call list_forces(this%domain, this%place(element(pick)), own_d)
        end if
        if (present(value)) value(pick) = own_value
        d(:, nodes) = own_d
      end do
    end do
  end subroutine work_on_list

  subroutine cluster_block_products(this, u, total)
    class(cluster_t), intent(inout) :: this
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: total(:)
    real(wp) :: part(size(total))
    integer :: r
    do r = this%ranks - 1, 0, -1
      if (r > 0) call hand_out(this, r, task_products, zero, zero)
      call send_nodes(this, r, u)
    end do
    call find_products(this%domain, total)
    do r = 1, this%ranks - 1
      call receive_numbers(this%link, r, size(part), part)
      total = total + part
    end do
  end subroutine cluster_block_products

  subroutine cluster_chosen_products(this, block, block_of, element, u, value)
    class(cluster_t), intent(inout) :: this
    type(element_block_t), intent(in) :: block(:)
    integer, intent(in) :: block_of(:), element(:)
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: value(:)
    real(wp), allocatable :: d(:, :)
    integer, allocatable :: start(:)
    value = zero
    call gather_elements(block, block_of, element, [1.0_wp], u, start, d)
    call work_on_list(this, element, start, task_list_products, d, value)
  end subroutine cluster_chosen_products

  subroutine cluster_assemble(this, graph, weight, at, fixed, diagonal)
    class(cluster_t), intent(inout) :: this
    type(graph_t), intent(in) :: graph
    real(wp), intent(in) :: weight(:), at(:, :)
    logical, intent(in) :: fixed(:, :)
    real(wp), intent(out) :: diagonal(:, :)
    real(wp), allocatable :: own_weight(:), own_at(:, :)
    logical, allocatable :: own_fixed(:, :)
    integer :: r
    do r = this%ranks - 1, 0, -1
      call entries_of(this, r, weight, at, own_weight, own_at)
      own_fixed = fixed(:, this%part(r)%node)
      if (r == 0) exit
      call hand_out(this, r, task_assemble, real(size(own_weight), wp), real(size(at, 1), wp))
      call send_numbers(this%link, r, size(own_weight), own_weight)
      call send_numbers(this%link, r, size(own_at), own_at)
      call send_integers(this%link, r, size(own_fixed), merge(1, 0, own_fixed))
    end do
    call assemble(this%domain, own_weight, own_at, own_fixed)
    diagonal = zero
    call add_nodes(this, diagonal)
  end subroutine cluster_assemble

  !> What concerns a rank. own_at: of its entries, of the first rank with zeros at those that
  !> others have.
  subroutine entries_of(this, rank, weight, at, own_weight, own_at)
    class(cluster_t), intent(in) :: this
    integer, intent(in) :: rank
    real(wp), intent(in) :: weight(:), at(:, :)
    real(wp), allocatable, intent(out) :: own_weight(:), own_at(:, :)
    integer :: k, n
    associate (part => this%part(rank))
      if (size(weight) == 1) own_weight = weight
      if (size(weight) > 1) own_weight = weight(part%element)
      if (rank == 0) then
        allocate (own_at(size(at, 1), size(part%pair)), source=zero)
        do k = 1, size(part%pair)
          if (part%pair(k) > 0) own_at(:, k) = at(:, part%pair(k))
        end do
        return
      end if
      allocate (own_at(size(at, 1), count(this%owner_of == rank)))
      n = 0
      do k = 1, size(at, 2)
        if (this%owner_of(k) /= rank) cycle
        n = n + 1
        own_at(:, n) = at(:, k)
      end do
    end associate
  end subroutine entries_of

  real(wp) function cluster_largest_stiffness(this)
    class(cluster_t), intent(inout) :: this
    real(wp) :: other(1)
    integer :: r
    cluster_largest_stiffness = largest_stiffness(this%domain%system%block)
    do r = 1, this%ranks - 1
      call hand_out(this, r, task_largest, zero, zero)
      call receive_numbers(this%link, r, 1, other)
      cluster_largest_stiffness = max(cluster_largest_stiffness, other(1))
    end do
  end function cluster_largest_stiffness

  subroutine cluster_make_solver(this, options, solver)
    class(cluster_t), target, intent(inout) :: this
    type(solver_options_t), intent(in) :: options
    class(solver_t), allocatable, intent(out) :: solver
    allocate (mumps_t :: solver)
    solver%options = options
    solver%info%engine = 'MUMPS'
    select type (solver)
    type is (mumps_t)
      solver%link = this%link
      solver%domain => this%domain
      solver%is_used => this%engine_is_used
    end select
  end subroutine cluster_make_solver

  subroutine cluster_dismiss(this)
    class(cluster_t), intent(inout) :: this
    integer :: r
    do r = 1, this%ranks - 1
      call hand_out(this, r, task_leave, zero, zero)
    end do
    call close_link()
  end subroutine cluster_dismiss

end module mpi_team
