! SPDX-License-Identifier: BSD-3-Clause
!> Element masses: consistent, lumped, dispersion-tuned; where the mass of massless contact
!> nodes goes; and their sum.
module assembly_mass
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, fail, status_deck
  use base_strings, only: to_text
  use element_base, only: element_t, most_nodes, most_face_nodes
  use linalg_graph, only: graph_t
  use model_data, only: model_t
  use model_rigid, only: rigid_t
  implicit none
  private
  public :: element_mass, redistribution_targets, assemble_mass

contains

  !> Mass (nodes, nodes) [M] of element e by the type asked for. CONSISTENT: Gauss points.
  !> LUMPED: its row sums. DISPERSION: points +-a with a^2 = (2/3)(1 - nu^2), nu = c dt/h per
  !> direction, clipped to [0, 1] (Guddati & Yue 2004, tuned to the mid-point rule in time).
  pure subroutine element_mass(model, element, e, me)
    type(model_t), intent(in) :: model
    class(element_t), intent(in) :: element
    integer, intent(in) :: e
    real(wp), intent(out) :: me(:, :)
    real(wp) :: x(element%dim, element%nodes), density, lumped(element%nodes)
    real(wp), dimension(element%dim) :: nu, a
    integer :: k, n
    n = element%nodes
    me = zero
    associate (part => model%part(model%mesh%part(e)), controls => model%controls)
      x = model%x(:, model%mesh%nodes_of(e))
      density = model%material(part%material)%item%density
      if (controls%mass == 'LUMPED') then
        lumped = element%lumped_mass(x, density, part%thickness)
        do k = 1, n
          me(k, k) = lumped(k)
        end do
        return
      end if
      a = one/sqrt(3.0_wp)
      if (controls%mass == 'DISPERSION') then
        nu = controls%courant
        if (controls%courant < zero) nu = controls%dt* &
            model%material(part%material)%item%wave_speed(part%plane)/element%sizes(x)
        nu = min(one, max(zero, nu))
        a = sqrt(2.0_wp/3.0_wp*(one - nu)*(one + nu))
      end if
      call element%mass(x, density, part%thickness, a, me)
    end associate
  end subroutine element_mass

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
  !> themselves. Rows first(n+1), target(:). Fails when a contact node has none.
  subroutine redistribution_targets(model, massless, first, target, status)
    type(model_t), intent(in) :: model
    integer, intent(in) :: massless(:)
    integer, allocatable, intent(out) :: first(:), target(:)
    type(status_t), intent(inout) :: status
    integer, allocatable :: inner(:, :), count(:)
    logical, allocatable :: is_contact(:)
    integer :: i
    allocate (is_contact(model%nodes), inner(32, model%nodes), count(model%nodes))
    allocate (first(model%nodes + 1))
    is_contact = .false.
    is_contact(massless) = .true.
    count = 0
    if (size(massless) > 0) call find_inner(model, is_contact, inner, count)
    first(1) = 1
    do i = 1, model%nodes
      first(i + 1) = first(i) + merge(count(i), 1, is_contact(i))
      if (is_contact(i) .and. count(i) == 0) call fail(status, status_deck, &
          'REDIST 1: contact node '//to_text(model%node_id(i))//' has no inner neighbour', &
          hint='use REDIST 0, or more than one element across the body')
    end do
    allocate (target(first(model%nodes + 1) - 1))
    do i = 1, model%nodes
      target(first(i):first(i + 1) - 1) = inner(1:first(i + 1) - first(i), i)
      if (.not. is_contact(i)) target(first(i)) = i
    end do
  end subroutine redistribution_targets

  pure subroutine find_inner(model, is_contact, inner, count)
    type(model_t), intent(in) :: model
    logical, intent(in) :: is_contact(:)
    integer, intent(inout) :: inner(:, :), count(:)
    integer :: e, f, k, m, pass, node(most_face_nodes)
    do e = 1, model%mesh%n
      do pass = 1, 2
        do f = 1, model%mesh%faces_of(e)
          call model%mesh%get_face(f, e, node, m)
          do k = 1, m
            if (pass == 1 .and. (k < m .or. m > 2)) &
                call add_inner(node(k), node(1 + mod(k, m)), is_contact, inner, count)
            if (pass == 2 .and. (k > 1 .or. m > 2)) &
                call add_inner(node(k), node(1 + mod(k + m - 2, m)), is_contact, inner, count)
          end do
        end do
      end do
    end do
  end subroutine find_inner

  !> Node j is joined to node i.
  pure subroutine add_inner(i, j, is_contact, inner, count)
    integer, intent(in) :: i, j
    logical, intent(in) :: is_contact(:)
    integer, intent(inout) :: inner(:, :), count(:)
    if (.not. is_contact(i)) return
    if (is_contact(j) .or. count(i) == size(inner, 1)) return
    if (any(inner(1:count(i), i) == j)) return
    count(i) = count(i) + 1
    inner(count(i), i) = j
  end subroutine add_inner

end module assembly_mass
