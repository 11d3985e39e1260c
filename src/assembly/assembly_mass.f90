! SPDX-License-Identifier: BSD-3-Clause
!> Element masses: consistent, lumped, dispersion-tuned; where the mass of massless contact
!> nodes goes; and their sum.
module assembly_mass
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, fail, status_deck
  use base_strings, only: to_text
  use element_base, only: element_t, most_nodes, most_strains
  use element_dispersion, only: tuned_points, keep_row_sums
  use linalg_graph, only: graph_t
  use material_base, only: material_t
  use model_data, only: model_t, controls_t
  use model_rigid, only: rigid_t
  implicit none
  private
  public :: element_mass, redistribution_targets, assemble_mass, mass_directions

  !> Inner neighbours of contact nodes: count(i) of node i, in node(:) from first(i) on.
  type :: inner_t
    logical, allocatable :: is_contact(:)
    integer, allocatable :: first(:), count(:), node(:)
  end type inner_t

contains

  !> Mass (nodes, nodes) [M] of element e by the type asked for. CONSISTENT: Gauss points.
  !> LUMPED: its row sums. DISPERSION: points by the Courant number, in space with the row sums
  !> of Gauss points.
  pure subroutine element_mass(model, element, e, me)
    type(model_t), intent(in) :: model
    class(element_t), intent(in) :: element
    integer, intent(in) :: e
    real(wp), intent(out) :: me(:, :)
    real(wp) :: x(element%dim, element%nodes), density, lumped(element%nodes), a(element%dim)
    integer :: k, n
    n = element%nodes
    me = zero
    associate (part => model%part(model%mesh%part(e)), controls => model%controls)
      x = model%x(:, model%mesh%nodes_of(e))
      ! Without WAVE S travel is not allocated, hence absent.
      associate (material => model%material(part%material)%item)
        density = material%density
        a = one/sqrt(3.0_wp)
        if (controls%mass == 'DISPERSION') a = tuned_points(element, x, &
            controls%dt*travel_speed(controls, material, part%plane), controls%courant, &
            controls%travel)
      end associate
      if (.not. controls%mass == 'LUMPED') &
          call element%mass(x, density, part%thickness, a, me)
      if (controls%mass == 'CONSISTENT' .or. controls%mass == 'DISPERSION' .and. &
          element%dim == 2) return
      lumped = element%lumped_mass(x, density, part%thickness)
      if (controls%mass == 'DISPERSION') call keep_row_sums(lumped, me)
      if (.not. controls%mass == 'LUMPED') return
      do k = 1, n
        me(k, k) = lumped(k)
      end do
    end associate
  end subroutine element_mass

  !> Speed of the waves that DISPERSION is tuned to: pressure, or with a direction of travel
  !> shear waves [L/T].
  pure real(wp) function travel_speed(controls, material, plane)
    type(controls_t), intent(in) :: controls
    class(material_t), intent(in) :: material
    integer, intent(in) :: plane
    real(wp) :: d(most_strains, most_strains)
    travel_speed = material%wave_speed(plane)
    if (.not. allocated(controls%travel)) return
    d = material%moduli(plane)
    travel_speed = sqrt(d(6, 6)/material%density)
  end function travel_speed

  !> M* = T' M T, each element with the weight of its part: the rows and columns of a massless
  !> node go to its targets, in equal shares. mass(:) on the graph [M times the weight].
  subroutine assemble_mass(model, graph, first, target, weight, mass)
    type(model_t), intent(in) :: model
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: first(:), target(:)
    real(wp), intent(in) :: weight(:)
    real(wp), intent(out) :: mass(:)
    real(wp) :: me(most_nodes, most_nodes), share
    integer :: e, i, j, a, b, n, position
    mass = zero
    do e = 1, model%mesh%n
      if (.not. abs(weight(model%mesh%part(e))) > zero) cycle
      if (model%part(model%mesh%part(e))%is_rigid) cycle
      n = model%mesh%count_of(e)
      call element_mass(model, model%mesh%kind(model%mesh%type(e))%item, e, me(:n, :n))
      me(:n, :n) = weight(model%mesh%part(e))*me(:n, :n)
      do j = 1, n
        associate (nj => model%mesh%node_of(j, e))
          do i = 1, n
            associate (ni => model%mesh%node_of(i, e))
              share = me(i, j)/real((first(ni + 1) - first(ni))*(first(nj + 1) - first(nj)), wp)
              do b = first(nj), first(nj + 1) - 1
                do a = first(ni), first(ni + 1) - 1
                  position = graph%position(target(a), target(b))
                  mass(position) = mass(position) + share
                end do
              end do
            end associate
          end do
        end associate
      end do
    end do
    if (allocated(model%rigid)) call add_rigid_masses(model%rigid, graph, weight, mass)
  end subroutine assemble_mass

  !> Centres and rotors of rigid parts.
  pure subroutine add_rigid_masses(rigid, graph, weight, mass)
    type(rigid_t), intent(in) :: rigid
    type(graph_t), intent(in) :: graph
    real(wp), intent(in) :: weight(:)
    real(wp), intent(inout) :: mass(:)
    integer :: p
    do p = 1, size(rigid%part)
      mass(graph%position(rigid%centre(p), rigid%centre(p))) = &
          weight(rigid%part(p))*rigid%mass(p)
      mass(graph%position(rigid%rotor(p), rigid%rotor(p))) = &
          weight(rigid%part(p))*rigid%mass(p)
    end do
  end subroutine add_rigid_masses

  !> Where the mass of each node goes: itself, or for a massless contact node the inner
  !> neighbours, i.e. the nodes joined to it by an element edge that are no contact nodes
  !> themselves; where there is none, all nodes of its elements that are no contact nodes. Rows
  !> first(n+1), target(:). Fails when a contact node has neither.
  subroutine redistribution_targets(model, massless, first, target, status)
    type(model_t), intent(in) :: model
    integer, intent(in) :: massless(:)
    integer, allocatable, intent(out) :: first(:), target(:)
    type(status_t), intent(inout) :: status
    type(inner_t) :: inner
    integer :: i
    call start_inner(model, massless, inner)
    if (size(massless) > 0) then
      call find_inner(model, inner)
      call find_others(model, inner)
    end if
    allocate (first(model%nodes + 1))
    first(1) = 1
    do i = 1, model%nodes
      first(i + 1) = first(i) + merge(inner%count(i), 1, inner%is_contact(i))
      if (inner%is_contact(i) .and. inner%count(i) == 0) call fail(status, status_deck, &
          'REDIST 1: contact node '//to_text(model%node_id(i))//' has no inner neighbour', &
          hint='use REDIST 0, or more than one element across the body')
    end do
    allocate (target(first(model%nodes + 1) - 1))
    do i = 1, model%nodes
      if (inner%is_contact(i)) then
        target(first(i):first(i + 1) - 1) = &
            inner%node(inner%first(i):inner%first(i) + inner%count(i) - 1)
      else
        target(first(i)) = i
      end if
    end do
  end subroutine redistribution_targets

  !> No neighbours yet; room for all other nodes of the elements of each contact node.
  pure subroutine start_inner(model, massless, inner)
    type(model_t), intent(in) :: model
    integer, intent(in) :: massless(:)
    type(inner_t), intent(out) :: inner
    integer :: e, i, k
    allocate (inner%is_contact(model%nodes), inner%count(model%nodes))
    allocate (inner%first(model%nodes + 1))
    inner%is_contact = .false.
    inner%is_contact(massless) = .true.
    inner%count = 0
    inner%first = 0
    do e = 1, merge(model%mesh%n, 0, size(massless) > 0)
      do k = 1, model%mesh%count_of(e)
        associate (i => model%mesh%node_of(k, e))
          if (inner%is_contact(i)) inner%first(i + 1) = inner%first(i + 1) &
              + model%mesh%count_of(e) - 1
        end associate
      end do
    end do
    inner%first(1) = 1
    do i = 1, model%nodes
      inner%first(i + 1) = inner%first(i) + inner%first(i + 1)
    end do
    allocate (inner%node(inner%first(model%nodes + 1) - 1))
  end subroutine start_inner

  !> Neighbours by edges of elements, curved ones by the edges of their facets.
  pure subroutine find_inner(model, inner)
    type(model_t), intent(in) :: model
    type(inner_t), intent(inout) :: inner
    integer, allocatable :: node(:)
    integer :: e, f, k, m, pass
    do e = 1, model%mesh%n
      do pass = 1, 2
        do f = 1, model%mesh%facets_of(e)
          node = model%mesh%facet_of(f, e)
          m = size(node)
          do k = 1, m
            if (pass == 1 .and. (k < m .or. m > 2)) &
                call add_inner(inner, node(k), node(1 + mod(k, m)))
            if (pass == 2 .and. (k > 1 .or. m > 2)) &
                call add_inner(inner, node(k), node(1 + mod(k + m - 2, m)))
          end do
        end do
      end do
    end do
  end subroutine find_inner

  !> Where an edge of an element leads to contact nodes alone: its other nodes.
  pure subroutine find_others(model, inner)
    type(model_t), intent(in) :: model
    type(inner_t), intent(inout) :: inner
    logical :: has_none(model%nodes)
    integer :: e, j, k
    has_none = inner%is_contact .and. inner%count == 0
    if (.not. any(has_none)) return
    do e = 1, model%mesh%n
      do k = 1, model%mesh%count_of(e)
        if (.not. has_none(model%mesh%node_of(k, e))) cycle
        do j = 1, model%mesh%count_of(e)
          call add_inner(inner, model%mesh%node_of(k, e), model%mesh%node_of(j, e))
        end do
      end do
    end do
  end subroutine find_others

  !> Node j is joined to node i.
  pure subroutine add_inner(inner, i, j)
    type(inner_t), intent(inout) :: inner
    integer, intent(in) :: i, j
    if (.not. inner%is_contact(i) .or. inner%is_contact(j)) return
    associate (first => inner%first(i), n => inner%count(i))
      if (any(inner%node(first:first + n - 1) == j)) return
      inner%node(first + n) = j
      n = n + 1
    end associate
  end subroutine add_inner

  !> 1 where damping by mass is the same in all directions, else their number.
  pure integer function mass_directions(model)
    type(model_t), intent(in) :: model
    integer :: k
    mass_directions = 1
    do k = 1, size(model%mass_damping)
      associate (scale => model%mass_damping(k)%scale(:model%dim))
        if (any(abs(scale - scale(1)) > zero)) mass_directions = model%dim
      end associate
    end do
  end function mass_directions

end module assembly_mass
