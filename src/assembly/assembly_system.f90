! SPDX-License-Identifier: BSD-3-Clause
!> The matrices of the bodies: node graph, mass, element stiffness, and the effective matrix of
!> a time scheme, A = cM M + cC C + cL L + cK K, with C the damping of the deck and L = K of the
!> elements that hold massless nodes.
module assembly_system
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, failed
  use assembly_blocks, only: element_block_t, make_blocks, assemble_stiffness, &
      stored_at, whole_stiffness, largest_stiffness
  use assembly_entries, only: element_cliques, elements_at, set_one, clear_held, &
      diagonal_product
  use assembly_mass, only: assemble_mass, mass_directions, redistribution_targets
  use assembly_ring, only: whole_ring_stiffness
  use assembly_solid, only: make_solids, add_solid_tangents
  use assembly_team, only: team_t
  use linalg_graph, only: graph_t, block_matrix_t, graph_from_cliques, scalar_product, &
      scalar_products, scalar_rows
  use model_data, only: model_t
  use solid_block, only: solid_t, force_rule_t
  implicit none
  private

  !> Damping of the deck, C = (by direction) sum a_p M_p + sum |COEF_p| K_p over the parts.
  type, public :: damping_t
    !> (1 or, where directions differ, dim, *) sum a_p M_p, on the graph or, where the mass is
    !> diagonal, by nodes [M/T]; only with damping by mass
    real(wp), allocatable :: mass(:, :)
    integer, allocatable :: first(:), target(:)  !< where the mass of each node goes
    integer, allocatable :: element(:)           !< elements damped by their stiffness
    real(wp), allocatable :: coefficient(:)      !< |COEF| of each of them [T]
  end type damping_t

  type, public :: system_t
    integer :: n = 0
    integer :: dim = 2
    integer :: threads = 1
    type(graph_t) :: graph
    real(wp), allocatable :: mass(:)          !< node-scalar mass on the graph [M]
    logical :: mass_is_diagonal = .false.
    !> (n) row sums of the mass [M]: body loads, momentum
    real(wp), allocatable :: lumped(:)
    integer :: heavy = 0                      !< nodes that gravity acts on: all but rotors
    type(element_block_t), allocatable :: block(:)
    integer, allocatable :: block_of(:)       !< (elements)
    integer, allocatable :: massless_layer(:)  !< elements with a massless node
    type(damping_t), allocatable :: damping    !< only where the deck has it
    type(solid_t), allocatable :: solid(:)     !< of the blocks, only at finite deformation
    type(force_rule_t) :: force_rule           !< their force over a step
    integer, allocatable :: massless_body(:)   !< nodes without mass and element, all held
    !> Nodes without mass and stiffness: those that follow rigid parts; only with these
    integer, allocatable :: idle(:)
    !> (dim, n) dofs whose motion is given now, whether there are any, and (2, m) direction and
    !> node of each: set together, by CONSTRAIN
    logical, allocatable :: fixed(:, :)
    logical :: any_fixed = .false.
    integer, allocatable :: fixed_list(:, :)
    !> Only where several ranks share the elements: theirs is the stiffness of the blocks
    class(team_t), pointer :: team => null()
    real(wp), allocatable :: modes(:, :)   !< then, in the plane: (3, elements) quad_mode_moduli
  end type system_t

  public :: make_system, effective_matrix, diagonal_matrix, multiply_mass, mass_products, &
      add_mass_rows, constrain, clear_fixed, set_fixed, list_dofs, stiffness_ratio, &
      largest_of_elements, add_stiffness

contains

  !> Graph, mass and stiffness of a model; massless(:) = contact nodes whose mass goes to their
  !> inner neighbours (empty without REDIST). Fails when such a node has no inner neighbour.
  !> The elements are shared by a team, where there is one (but for finite deformation).
  subroutine make_system(model, massless, system, status, team)
    type(model_t), intent(in) :: model
    integer, intent(in) :: massless(:)
    type(system_t), intent(out) :: system
    type(status_t), intent(inout) :: status
    class(team_t), pointer, intent(in), optional :: team
    integer, allocatable :: first(:), target(:), clique_first(:), clique(:)
    integer :: k
    system%n = model%nodes
    system%dim = model%dim
    system%heavy = model%nodes - model%bodies
    if (allocated(model%rigid)) then
      system%heavy = system%heavy - size(model%rigid%rotor)
      system%idle = model%rigid%node
    end if
    call make_blocks(model, system%block, system%block_of)
    call redistribution_targets(model, massless, first, target, status)
    if (failed(status)) return
    call element_cliques(model, first, target, clique_first, clique)
    call graph_from_cliques(model%nodes, clique_first, clique, system%graph)
    allocate (system%mass(size(system%graph%column)), system%lumped(model%nodes))
    call assemble_mass(model, system%graph, first, target, &
        [(one, k=1, size(model%part))], system%mass)
    call add_bodies(model, system)
    call row_sums(system)
    if (model%controls%is_finite) then
      call make_solids(model, system%block, system%solid)
      allocate (system%massless_layer(0))
    else
      if (present(team)) system%team => team
      if (associated(system%team)) then
        call system%team%share(model, system%graph, system%block, system%modes, status)
      else
        call assemble_stiffness(model, system%block)
      end if
      system%massless_layer = elements_at(model, massless)
    end if
    if (allocated(model%mass_damping) .or. allocated(model%stiffness_damping)) &
        call make_damping(model, first, target, system)
    call constrain(system, model%fixed)
  end subroutine make_system

  !> Masses of rigid walls, and the walls that have none, whose motion is given.
  pure subroutine add_bodies(model, system)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    integer :: k, at
    allocate (system%massless_body(0))
    if (model%bodies == 0) return
    do k = 1, size(model%wall)
      associate (wall => model%wall(k))
        if (wall%node == 0) cycle
        if (.not. wall%mass > zero) then
          system%massless_body = [system%massless_body, wall%node]
          cycle
        end if
        at = system%graph%position(wall%node, wall%node)
        system%mass(at) = wall%mass
      end associate
    end do
  end subroutine add_bodies

  !> Damping: the elements by stiffness, room for that by mass, whose coefficients may change
  !> (set_mass_damping).
  pure subroutine make_damping(model, first, target, system)
    type(model_t), intent(in) :: model
    integer, intent(in) :: first(:), target(:)
    type(system_t), intent(inout) :: system
    integer :: e
    allocate (system%damping)
    associate (d => system%damping)
      allocate (d%element(0), d%coefficient(0))
      if (allocated(model%stiffness_damping)) d%element = pack([(e, e=1, model%mesh%n)], &
          model%stiffness_damping(model%mesh%part) > zero)
      if (allocated(model%stiffness_damping)) &
          d%coefficient = model%stiffness_damping(model%mesh%part(d%element))
      if (.not. allocated(model%mass_damping)) return
      d%first = first
      d%target = target
      allocate (d%mass(mass_directions(model), &
          merge(system%n, size(system%mass), system%mass_is_diagonal)), source=zero)
    end associate
  end subroutine make_damping

  pure subroutine row_sums(system)
    type(system_t), intent(inout) :: system
    integer :: i, k
    system%mass_is_diagonal = .true.
    do i = 1, system%n
      system%lumped(i) = zero
      do k = system%graph%first(i), system%graph%first(i + 1) - 1
        system%lumped(i) = system%lumped(i) + system%mass(k)
        if (system%graph%column(k) /= i .and. abs(system%mass(k)) > zero) &
            system%mass_is_diagonal = .false.
      end do
    end do
  end subroutine row_sums

  !> A = cM M + cC C + cL L + cK K in 2 x 2 blocks; rows and columns of fixed dofs keep their
  !> diagonal only (1 where they have no mass), so that a right-hand side of zero there gives a
  !> displacement of zero.
  !> shift (n) is added to the diagonal of each node. What a team shares is its diagonal here.
  subroutine effective_matrix(system, c_m, c_c, c_layer, c_k, matrix, u0, x, shift)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: c_m, c_c, c_layer, c_k
    type(block_matrix_t), intent(inout) :: matrix
    real(wp), intent(in), optional :: u0(:, :), x(:, :), shift(:)
    integer :: e, i, k, d
    if (associated(system%team) .and. any(abs([c_c, c_layer, c_k]) > zero)) then
      call share_matrix(system, c_m, c_c, c_layer, c_k, matrix, shift)
      return
    end if
    if (allocated(matrix%diagonal)) deallocate (matrix%diagonal)
    if (.not. allocated(matrix%value)) allocate (matrix%value(system%dim, system%dim, &
        size(system%graph%column)))
    matrix%value = zero
    if (present(u0)) then
      call add_solid_tangents(system%solid, system%threads, system%force_rule, u0, x, &
          system%graph, matrix)
    else if (abs(c_k) > zero) then
      do e = 1, size(system%block_of)
        call add_stiffness(system, e, c_k, matrix)
      end do
    end if
    if (abs(c_layer) > zero) then
      do k = 1, size(system%massless_layer)
        call add_stiffness(system, system%massless_layer(k), c_layer, matrix)
      end do
    end if
    if (allocated(system%damping) .and. abs(c_c) > zero) &
        call add_damping(system, c_c, matrix)
    do k = 1, size(system%graph%column)
      do d = 1, system%dim
        matrix%value(d, d, k) = matrix%value(d, d, k) + c_m*system%mass(k)
      end do
    end do
    call fill_idle(system, matrix)
    if (system%any_fixed) then
      call clear_held(system%graph, system%fixed, matrix)
      do i = 1, size(system%massless_body)
        k = system%graph%position(system%massless_body(i), system%massless_body(i))
        do d = 1, system%dim
          matrix%value(d, d, k) = one
        end do
      end do
    end if
    if (.not. present(shift)) return
    do i = 1, system%n
      k = system%graph%position(i, i)
      do d = 1, system%dim
        matrix%value(d, d, k) = matrix%value(d, d, k) + shift(i)
      end do
    end do
  end subroutine effective_matrix

  !> The same of elements that a team shares: matrix has the diagonal, the ranks have the rest.
  subroutine share_matrix(system, c_m, c_c, c_layer, c_k, matrix, shift)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: c_m, c_c, c_layer, c_k
    type(block_matrix_t), intent(inout) :: matrix
    real(wp), intent(in), optional :: shift(:)
    real(wp), allocatable :: at(:, :), weight(:)
    integer :: i, k, rows
    logical :: by_mass
    by_mass = .false.
    if (allocated(system%damping)) by_mass = allocated(system%damping%mass)
    rows = 1
    if (by_mass) rows = size(system%damping%mass, 1)
    allocate (at(rows, size(system%mass)))
    do k = 1, size(system%mass)
      at(:, k) = c_m*system%mass(k)
    end do
    if (by_mass) then
      do i = 1, size(system%damping%mass, 2)
        k = i
        if (system%mass_is_diagonal) k = system%graph%position(i, i)
        at(:, k) = at(:, k) + c_c*system%damping%mass(:, i)
      end do
    end if
    if (present(shift)) then
      do i = 1, system%n
        k = system%graph%position(i, i)
        at(:, k) = at(:, k) + shift(i)
      end do
    end if
    weight = [c_k]
    if (size(system%massless_layer) > 0 .or. allocated(system%damping)) &
        weight = element_weights(system, c_c, c_layer, c_k)
    call set_idle(system, at)
    if (allocated(matrix%value)) deallocate (matrix%value)
    if (.not. allocated(matrix%diagonal)) allocate (matrix%diagonal(system%dim, system%n))
    call system%team%assemble(system%graph, weight, at, system%fixed, matrix%diagonal)
  end subroutine share_matrix

  !> What the stiffness of each element counts in the effective matrix.
  pure function element_weights(system, c_c, c_layer, c_k) result(weight)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: c_c, c_layer, c_k
    real(wp) :: weight(size(system%block_of))
    weight = c_k
    weight(system%massless_layer) = weight(system%massless_layer) + c_layer
    if (.not. allocated(system%damping)) return
    associate (c => system%damping)
      weight(c%element) = weight(c%element) + c_c*c%coefficient
    end associate
  end function element_weights

  !> Ones for nodes without an entry, which no element that is strained has.
  pure subroutine set_idle(system, at)
    type(system_t), intent(in) :: system
    real(wp), intent(inout) :: at(:, :)
    integer :: i, k
    do i = 1, system%n
      k = system%graph%first(i)
      if (system%graph%first(i + 1) - k > 1) cycle
      if (.not. abs(at(1, k)) > zero .or. any(system%massless_body == i)) at(:, k) = one
    end do
  end subroutine set_idle

  !> Ones on the diagonal of nodes that follow, and of held dofs without an entry (of rigid
  !> meshes in statics): no zero pivot, and no motion where there is no force.
  pure subroutine fill_idle(system, matrix)
    type(system_t), intent(in) :: system
    type(block_matrix_t), intent(inout) :: matrix
    integer :: k, d
    if (allocated(system%idle)) then
      do k = 1, size(system%idle)
        do d = 1, system%dim
          call set_one(system%graph, d, system%idle(k), matrix)
        end do
      end do
    end if
    if (.not. system%any_fixed) return
    do k = 1, size(system%fixed_list, 2)
      call set_one(system%graph, system%fixed_list(1, k), system%fixed_list(2, k), matrix)
    end do
  end subroutine fill_idle

  !> matrix = matrix + factor * C.
  pure subroutine add_damping(system, factor, matrix)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: factor
    type(block_matrix_t), intent(inout) :: matrix
    integer :: d, i, k
    associate (c => system%damping)
      do k = 1, size(c%element)
        call add_stiffness(system, c%element(k), factor*c%coefficient(k), matrix)
      end do
      if (.not. allocated(c%mass)) return
      do i = 1, size(c%mass, 2)
        k = i
        if (system%mass_is_diagonal) k = system%graph%position(i, i)
        do d = 1, system%dim
          matrix%value(d, d, k) = matrix%value(d, d, k) + &
              factor*c%mass(min(d, size(c%mass, 1)), i)
        end do
      end do
    end associate
  end subroutine add_damping
  !> A = cM M of a diagonal mass; fixed dofs as in EFFECTIVE_MATRIX.
  pure subroutine diagonal_matrix(system, c_m, matrix)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: c_m
    type(block_matrix_t), intent(inout) :: matrix
    integer :: i
    if (allocated(matrix%value)) deallocate (matrix%value)
    if (.not. allocated(matrix%diagonal)) allocate (matrix%diagonal(system%dim, system%n))
    do i = 1, system%n
      matrix%diagonal(:, i) = c_m*system%lumped(i)
    end do
    matrix%diagonal(:, system%massless_body) = one
    call fill_idle(system, matrix)
  end subroutine diagonal_matrix

  !> matrix = matrix + factor * K of element e.
  pure subroutine add_stiffness(system, e, factor, matrix)
    type(system_t), intent(in) :: system
    integer, intent(in) :: e
    real(wp), intent(in) :: factor
    type(block_matrix_t), intent(inout) :: matrix
    real(wp) :: ke(system%dim*system%block(system%block_of(e))%nodes, &
        system%dim*system%block(system%block_of(e))%nodes)
    integer :: i, j, k, d
    d = system%dim
    associate (block => system%block(system%block_of(e)))
      if (block%is_rigid) return
      associate (node => block%node(:, e - block%first + 1), &
          stiffness => block%stiffness(:, :, stored_at(block, e - block%first + 1)))
        if (block%is_ring) then
          call whole_ring_stiffness(factor, stiffness, ke)
        else
          call whole_stiffness(d, factor, stiffness, ke)
        end if
        do j = 1, block%nodes
          do i = 1, block%nodes
            k = system%graph%position(node(i), node(j))
            matrix%value(:, :, k) = matrix%value(:, :, k) &
                + ke(d*(i - 1) + 1:d*i, d*(j - 1) + 1:d*j)
          end do
        end do
      end associate
    end associate
  end subroutine add_stiffness

  !> Largest diagonal of cK K over the largest of cM M; 0 where no node of an element has mass.
  real(wp) function stiffness_ratio(system, c_m, c_k)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: c_m, c_k
    integer :: b
    real(wp) :: heaviest
    heaviest = zero
    do b = 1, size(system%block)
      heaviest = max(heaviest, maxval(system%lumped(reshape(system%block(b)%node, &
          [size(system%block(b)%node)]))))
    end do
    stiffness_ratio = zero
    if (heaviest > zero) stiffness_ratio = largest_of_elements(system)*c_k/(c_m*heaviest)
  end function stiffness_ratio

  !> Largest entry on a diagonal of element stiffness [F/L].
  real(wp) function largest_of_elements(system)
    type(system_t), intent(in) :: system
    if (associated(system%team)) then
      largest_of_elements = system%team%largest_stiffness()
    else
      largest_of_elements = largest_stiffness(system%block)
    end if
  end function largest_of_elements

  !> y = y + factor * M x.
  subroutine multiply_mass(system, factor, x, y)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(inout) :: y(:, :)
    if (system%mass_is_diagonal) then
      call diagonal_product(system%dim, system%n, system%lumped, factor, x, y)
    else
      call scalar_product(size(x, 1), system%n, system%graph%first, system%graph%column, &
          system%mass, factor, x, y)
    end if
  end subroutine multiply_mass

  !> p = M x and q = M y, all (dim, n), for little more than one of them.
  subroutine mass_products(system, x, y, p, q)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: x(:, :), y(:, :)
    real(wp), intent(out) :: p(:, :), q(:, :)
    integer :: i
    if (system%mass_is_diagonal) then
      do i = 1, system%n
        p(:, i) = system%lumped(i)*x(:, i)
        q(:, i) = system%lumped(i)*y(:, i)
      end do
    else
      call scalar_products(size(x, 1), system%n, system%graph%first, system%graph%column, &
          system%mass, x, y, p, q)
    end if
  end subroutine mass_products

  !> y = y + factor * M x in some rows, each as MULTIPLY_MASS has it.
  subroutine add_mass_rows(system, rows, factor, x, y)
    type(system_t), intent(in) :: system
    integer, intent(in) :: rows(:)
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(inout) :: y(:, :)
    integer :: k
    if (system%mass_is_diagonal) then
      do k = 1, size(rows)
        associate (i => rows(k))
          y(:, i) = y(:, i) + factor*system%lumped(i)*x(:, i)
        end associate
      end do
    else
      call scalar_rows(system%graph, system%mass, factor, rows, x, y)
    end if
  end subroutine add_mass_rows

  !> From now on the dofs that are marked (dim, n) are fixed, and no others.
  pure subroutine constrain(system, marked)
    type(system_t), intent(inout) :: system
    logical, intent(in) :: marked(:, :)
    system%fixed = marked
    system%fixed_list = list_dofs(marked)
    system%any_fixed = size(system%fixed_list) > 0
  end subroutine constrain

  !> Direction and node (2, *) of the dofs that are marked, node by node.
  pure function list_dofs(marked) result(list)
    logical, intent(in) :: marked(:, :)
    integer, allocatable :: list(:, :)
    integer :: k, d, n
    allocate (list(2, count(marked)))
    n = 0
    do k = 1, size(marked, 2)
      do d = 1, size(marked, 1)
        if (.not. marked(d, k)) cycle
        n = n + 1
        list(:, n) = [d, k]
      end do
    end do
  end function list_dofs

  !> Sets the entries of fixed dofs to zero.
  pure subroutine clear_fixed(system, x)
    type(system_t), intent(in) :: system
    real(wp), intent(inout) :: x(:, :)
    integer :: k
    do k = 1, size(system%fixed_list, 2)
      x(system%fixed_list(1, k), system%fixed_list(2, k)) = zero
    end do
  end subroutine clear_fixed

  !> x = values on fixed dofs.
  pure subroutine set_fixed(system, values, x)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: values(:, :)
    real(wp), intent(inout) :: x(:, :)
    integer :: k
    do k = 1, size(system%fixed_list, 2)
      associate (d => system%fixed_list(1, k), i => system%fixed_list(2, k))
        x(d, i) = values(d, i)
      end associate
    end do
  end subroutine set_fixed

end module assembly_system
