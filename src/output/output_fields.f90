! SPDX-License-Identifier: BSD-3-Clause
!> The fields of a frame: which nodes and elements, and their values from the state of the run.
module output_fields
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use assembly_forces, only: element_products
  use assembly_system, only: system_t
  use base_kinds, only: wp, zero, half, one
  use contact_pairing, only: no_gap
  use contact_types, only: contact_t
  use element_base, only: most_nodes, most_strains
  use deck_names, only: finite_fields, field_names
  use material_base, only: strains_in
  use model_data, only: model_t
  use model_state, only: state_t
  use solid_output, only: element_cauchy, element_stretches, element_plastic_strain
  use output_principal, only: fill_principal
  use output_storage, only: mesh_t, field_t
  use output_table, only: next_due
  implicit none
  private
  public :: make_fields, make_mesh, fill_fields, frame_is_due, next_frame

  type, public :: fields_t
    integer, allocatable :: node(:), cell(:)   !< rows of the model
    type(field_t), allocatable :: field(:)
    !> (4, or in space 6, dofs of the cells): sxx, syy, szz, sxy, syz, szx by the displacements
    !> of their nodes [F/L3]; only where stress is asked for
    real(wp), allocatable :: stress_of(:, :)
    integer, allocatable :: cell_first(:), cell_node(:)   !< nodes of each cell, as rows
    real(wp), allocatable :: stress(:, :)      !< (6, cells), only for PRINCIPAL [F/L2]
    real(wp) :: next = zero                    !< a frame is due from next*interval on
    integer :: segment = 0                     !< number of the file that is open or comes next
    integer :: frames = 0
    integer :: indexed = 0                     !< frames that there is room for in the index
    real(wp), allocatable :: time(:)           !< of all frames so far
    integer, allocatable :: segment_of(:)      !< of each frame
    real(wp), allocatable :: bytes(:)          !< of the segments that are closed
  end type fields_t

contains

  !> Nodes, elements and work space for what the deck asks for.
  subroutine make_fields(model, fields)
    type(model_t), intent(in) :: model
    type(fields_t), intent(out) :: fields
    integer :: k, n
    call choose_cells(model, fields)
    associate (wanted => model%requests%field%wanted)
      n = count(wanted)
      allocate (fields%field(n), fields%time(64), fields%segment_of(64), fields%bytes(0))
      n = 0
      do k = 1, size(field_names)
        if (.not. wanted(k)) cycle
        n = n + 1
        call shape_field(field_names(k), size(fields%node), size(fields%cell), fields%field(n))
        if (field_names(k) == 'PART') fields%field(n)%values(1, :) = &
            real(model%part(model%mesh%part(fields%cell))%id, wp)
        if (field_names(k) == 'STRESS' .or. field_names(k) == 'PRINCIPAL') &
            call make_stress(model, fields)
        if (field_names(k) == 'PRINCIPAL') allocate (fields%stress(6, size(fields%cell)))
      end do
    end associate
  end subroutine make_fields

  pure subroutine choose_cells(model, fields)
    type(model_t), intent(in) :: model
    type(fields_t), intent(inout) :: fields
    logical, allocatable :: part(:), node(:), cell(:)
    integer :: e, k
    allocate (part(size(model%part)), node(model%nodes), cell(model%mesh%n))
    part = model%requests%field%part_set == 0
    if (model%requests%field%part_set > 0) &
        part(model%part_set(model%requests%field%part_set)%member) = .true.
    node = .false.
    do e = 1, model%mesh%n
      cell(e) = part(model%mesh%part(e))
      if (cell(e)) node(model%mesh%nodes_of(e)) = .true.
    end do
    fields%node = pack([(k, k=1, model%nodes)], node)
    fields%cell = pack([(k, k=1, model%mesh%n)], cell)
  end subroutine choose_cells

  pure subroutine shape_field(name, nodes, cells, field)
    character(*), intent(in) :: name
    integer, intent(in) :: nodes, cells
    type(field_t), intent(inout) :: field
    integer :: components
    field%name = name
    components = 1
    select case (name)
    case ('U', 'V', 'FORCE', 'PRINCIPAL', 'STRETCH')
      components = 3
    case ('STRESS')
      components = 6
    end select
    field%at_nodes = all(name /= [character(9) :: 'STRESS', 'ENERGY', 'PRINCIPAL', 'PART', &
        finite_fields])
    field%whole = name == 'STATUS' .or. name == 'PART'
    field%constant = name == 'PART'
    allocate (field%values(components, merge(nodes, cells, field%at_nodes)))
    field%values = zero
  end subroutine shape_field

  !> Stress of each element by unit displacements of its nodes.
  subroutine make_stress(model, fields)
    type(model_t), intent(in) :: model
    type(fields_t), intent(inout) :: fields
    real(wp) :: b(most_strains, model%dim*most_nodes), stress(3)
    integer :: k, c, e, m, n, at
    if (allocated(fields%stress_of)) return
    n = strains_in(model%part(1)%plane)
    fields%cell_first = [1, (0, k=1, size(fields%cell))]
    do k = 1, size(fields%cell)
      fields%cell_first(k + 1) = fields%cell_first(k) + model%mesh%count_of(fields%cell(k))
    end do
    allocate (fields%cell_node(fields%cell_first(k) - 1))
    allocate (fields%stress_of(merge(4, 6, model%dim == 2), model%dim*size(fields%cell_node)))
    do k = 1, size(fields%cell)
      e = fields%cell(k)
      at = model%dim*(fields%cell_first(k) - 1)
      fields%cell_node(fields%cell_first(k):fields%cell_first(k + 1) - 1) = &
          model%mesh%nodes_of(e)
      m = model%dim*model%mesh%count_of(e)
      associate (part => model%part(model%mesh%part(e)), &
          element => model%mesh%kind(model%mesh%type(e))%item)
        associate (material => model%material(part%material)%item)
          call element%mean_strain_matrix(model%x(:, model%mesh%nodes_of(e)), b(:n, :m))
          b(:n, :m) = matmul(material%moduli(part%plane), b(:n, :m))
          do c = 1, m
            if (model%dim == 3) then
              fields%stress_of(:, at + c) = b(:n, c)
            else if (model%is_axisymmetric) then
              fields%stress_of(:, at + c) = b([1, 2, 4, 3], c)
            else
              stress = b(:3, c)
              fields%stress_of(:, at + c) = [stress(1), stress(2), &
                  material%out_of_plane_stress(part%plane, stress), stress(3)]
            end if
          end do
        end associate
      end associate
    end do
  end subroutine make_stress

  !> The mesh in the terms of VTK, nodes numbered among those of the fields.
  pure subroutine make_mesh(model, fields, mesh)
    type(model_t), intent(in) :: model
    type(fields_t), intent(in) :: fields
    type(mesh_t), intent(out) :: mesh
    integer, allocatable :: number(:)
    integer :: k, n, at, node(most_nodes)
    allocate (number(model%nodes), mesh%points(3, size(fields%node)))
    allocate (mesh%kind(size(fields%cell)), mesh%offsets(size(fields%cell) + 1))
    allocate (mesh%connectivity(sum([(model%mesh%count_of(fields%cell(k)), &
        k=1, size(fields%cell))])))
    number(fields%node) = [(k - 1, k=1, size(fields%node))]
    mesh%points = zero
    mesh%points(1:model%dim, :) = model%x(:, fields%node)
    at = 0
    mesh%offsets(1) = 0
    do k = 1, size(fields%cell)
      n = model%mesh%count_of(fields%cell(k))
      associate (element => model%mesh%kind(model%mesh%type(fields%cell(k)))%item)
        node(:n) = model%mesh%nodes_of(fields%cell(k))
        if (allocated(element%vtk_order)) node(:n) = node(element%vtk_order)
        mesh%connectivity(at + 1:at + n) = number(node(:n))
        mesh%kind(k) = element%vtk
      end associate
      at = at + n
      mesh%offsets(k + 1) = at
    end do
  end subroutine make_mesh

  !> True when a frame is due: as rows of tables, between TBEG and TEND.
  pure logical function frame_is_due(model, fields, time, h, last)
    type(model_t), intent(in) :: model
    type(fields_t), intent(in) :: fields
    real(wp), intent(in) :: time, h
    logical, intent(in) :: last
    real(wp), parameter :: slack = 1.0e-9_wp
    associate (r => model%requests%field)
      frame_is_due = last .or. time >= fields%next*r%interval - slack*h
      frame_is_due = frame_is_due .and. time >= r%begin - slack*h .and. time <= r%end + slack*h
    end associate
  end function frame_is_due

  !> Notes the frame at a time, and when the next is due.
  pure subroutine next_frame(model, time, h, fields)
    type(model_t), intent(in) :: model
    real(wp), intent(in) :: time, h
    type(fields_t), intent(inout) :: fields
    if (fields%frames == size(fields%time)) then
      fields%time = [fields%time, fields%time]
      fields%segment_of = [fields%segment_of, fields%segment_of]
    end if
    fields%frames = fields%frames + 1
    fields%time(fields%frames) = time
    fields%segment_of(fields%frames) = fields%segment
    fields%next = next_due(model%requests%field%interval, time, h)
  end subroutine next_frame

  !> Values of all fields for the state as it is.
  subroutine fill_fields(model, system, state, contact, fields)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    type(contact_t), intent(in) :: contact
    type(fields_t), intent(inout) :: fields
    integer :: k
    do k = 1, size(fields%field)
      associate (values => fields%field(k)%values)
        select case (fields%field(k)%name)
        case ('U')
          call gather(model%dim, size(fields%node), fields%node, &
              model%nodes, state%u, one, values)
        case ('V')
          if (state%cycle == 0) call gather(model%dim, size(fields%node), fields%node, &
              model%nodes, state%v, one, values)
          if (state%cycle > 0) call gather(model%dim, size(fields%node), fields%node, &
              model%nodes, state%du, state%h_last, values)
        case ('FORCE', 'PRESSURE', 'GAP', 'STATUS')
          call fill_contact(contact, model%nodes, fields%node, fields%field(k))
        case ('STRESS')
          call find_stress(system, fields, state%u, values)
        case ('PRINCIPAL')
          call find_stress(system, fields, state%u, fields%stress)
          call fill_principal(model%dim, fields%stress, values)
        case ('STRETCH', 'PLASTIC')
          call fill_finite(system, fields%cell, state%u, fields%field(k)%name, values)
        case ('ENERGY')
          call element_products(system, fields%cell, state%u, values(1, :))
          values(1, :) = half*values(1, :)
        end select
      end associate
    end do
  end subroutine fill_fields

  !> Principal stretches, or the equivalent plastic strain, of each cell.
  pure subroutine fill_finite(system, cell, u, name, values)
    type(system_t), intent(in) :: system
    integer, intent(in) :: cell(:)
    real(wp), intent(in) :: u(:, :)
    character(*), intent(in) :: name
    real(wp), intent(inout) :: values(:, :)
    integer :: i
    do i = 1, size(cell)
      associate (solid => system%solid(system%block_of(cell(i))))
        if (name == 'STRETCH') then
          call element_stretches(solid, cell(i) - solid%first + 1, u, values(:, i))
        else
          values(1, i) = element_plastic_strain(solid, cell(i) - solid%first + 1)
        end if
      end associate
    end do
  end subroutine fill_finite

  !> Stress of the cells from the displacements u (dim, nodes) of their nodes.
  pure subroutine find_stress(system, fields, u, stress)
    type(system_t), intent(in) :: system
    type(fields_t), intent(in) :: fields
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(inout) :: stress(:, :)
    real(wp) :: total(6), of_node(6)
    integer :: k, c, d, n
    n = size(fields%stress_of, 1)
    total = zero
    do k = 1, size(fields%cell)
      if (allocated(system%solid)) then
        associate (solid => system%solid(system%block_of(fields%cell(k))))
          call element_cauchy(solid, fields%cell(k) - solid%first + 1, u, total)
        end associate
        stress(:, k) = total(:size(stress, 1))
        cycle
      end if
      total(:n) = zero
      do c = fields%cell_first(k), fields%cell_first(k + 1) - 1
        of_node(:n) = fields%stress_of(:, size(u, 1)*(c - 1) + 1)*u(1, fields%cell_node(c))
        do d = 2, size(u, 1)
          of_node(:n) = of_node(:n) &
              + fields%stress_of(:, size(u, 1)*(c - 1) + d)*u(d, fields%cell_node(c))
        end do
        total(:n) = total(:n) + of_node(:n)
      end do
      stress(:, k) = total
    end do
  end subroutine find_stress

  !> values(1:dim, k) = x(:, list(k)) / divisor.
  pure subroutine gather(dim, n, list, nodes, x, divisor, values)
    integer, intent(in) :: dim, n, list(n), nodes
    real(wp), intent(in) :: x(dim, nodes), divisor
    real(wp), intent(inout) :: values(3, n)
    integer :: k
    do k = 1, n
      values(1:dim, k) = x(:, list(k))/divisor
    end do
  end subroutine gather

  !> What contact knows of nodes, all pairs together: sums of force and pressure, the smallest
  !> gap (not a number where none is watched), the highest status (-1 where there is no
  !> surface).
  subroutine fill_contact(contact, nodes, list, field)
    type(contact_t), intent(in) :: contact
    integer, intent(in) :: nodes, list(:)
    type(field_t), intent(inout) :: field
    real(wp) :: all_nodes(size(field%values, 1), nodes)
    integer :: p, k
    all_nodes = zero
    if (field%name == 'GAP') all_nodes = no_gap
    if (field%name == 'STATUS') all_nodes = -1.0_wp
    do p = 1, size(contact%pairing)
      if (.not. allocated(contact%pairing(p)%item%nodal)) cycle
      associate (c => contact%pairing(p)%item%nodal)
        do k = 1, size(c%node)
          associate (to => all_nodes(:, c%node(k)))
            select case (field%name)
            case ('FORCE')
              to(:size(c%force, 1)) = to(:size(c%force, 1)) + c%force(:, k)
            case ('PRESSURE')
              if (c%area(k) > zero) to = to + c%normal(k)/c%area(k)
            case ('GAP')
              to = min(to, c%gap(k))
            case ('STATUS')
              to = max(to, real(c%status(k), wp))
            end select
          end associate
        end do
      end associate
    end do
    field%values = all_nodes(:, list)
    if (field%name == 'GAP') then
      do k = 1, size(list)
        if (field%values(1, k) >= no_gap) field%values(1, k) = ieee_value(zero, ieee_quiet_nan)
      end do
    end if
  end subroutine fill_contact

end module output_fields
