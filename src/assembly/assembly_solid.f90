! SPDX-License-Identifier: BSD-3-Clause
!> Blocks of elements at finite deformation: their forces, tangents and energies on the nodes.
module assembly_solid
  use assembly_blocks, only: element_block_t
  use assembly_threads, only: is_worth_threads, subtract_solid_forces, add_tangents, &
      begin_solid
  use base_archive, only: archive_t
  use base_kinds, only: wp, zero, one
  use base_strings, only: to_text
  use element_base, only: element_t, most_nodes
  use linalg_graph, only: graph_t, block_matrix_t
  use material_base, only: material_t, plane_stress
  use model_data, only: model_t
  use solid_block, only: solid_t, force_rule_t, make_solid, begin_elements, commit_step, &
      element_force, element_tangent, element_energy, has_quadratic_energy, relative
  use solid_limits, only: smallest_determinant, least_stretch
  implicit none
  private
  public :: make_solids, begin_solids, commit_solids, subtract_solid_force, &
      add_solid_tangents, subtract_tangent_product, add_solid_energy, smallest_volume, &
      find_compression, exchange_solids, plastic_work

  !> Work of an unknown at finite deformation, in rows of a stiffness.
  integer, parameter :: work_of_point = 10

contains

  !> A solid for each block; those of rigid parts have no elements.
  subroutine make_solids(model, block, solid)
    type(model_t), intent(in) :: model
    type(element_block_t), intent(in) :: block(:)
    type(solid_t), allocatable, intent(out) :: solid(:)
    integer :: b
    allocate (solid(size(block)))
    do b = 1, size(block)
      if (block(b)%is_rigid) cycle
      associate (part => model%part(block(b)%part))
        associate (element => model%mesh%kind(block(b)%type)%item, &
            material => model%material(part%material)%item)
          call make_solid(element, material, part%plane, takes_mean(model, element, material, &
              part%plane), part%thickness, block(b)%first, block(b)%node, model%x, solid(b))
        end associate
      end associate
    end do
  end subroutine make_solids

  !> Does a part have mean dilatation? Linear elements of several points, of laws that keep
  !> their volume, do, where QP0 says nothing else; plane stress has no such need.
  pure logical function takes_mean(model, element, material, plane)
    type(model_t), intent(in) :: model
    class(element_t), intent(in) :: element
    class(material_t), intent(in) :: material
    integer, intent(in) :: plane
    takes_mean = .false.
    if (plane == plane_stress) return
    select case (element%name)
    case ('HEX8MEAN')
      takes_mean = .true.
    case ('QUAD4', 'QUAD4AX', 'HEX8', 'WEDGE6', 'PYRAMID5')
      takes_mean = model%controls%mean_dilatation == 1 .or. &
          model%controls%mean_dilatation == -1 .and. material%mean_dilatation
    end select
  end function takes_mean

  !> A step begins at U0 (dim, n).
  subroutine begin_solids(solid, threads, u0)
    type(solid_t), intent(inout) :: solid(:)
    integer, intent(in) :: threads
    real(wp), intent(in) :: u0(:, :)
    integer :: b
    do b = 1, size(solid)
      if (solid(b)%n == 0) cycle
      if (has_quadratic_energy(solid(b))) cycle
      if (is_worth_threads(threads, solid(b)%n, solid(b)%dim*solid(b)%nodes, &
          work_of_point)) then
        call begin_solid(threads, solid(b), u0)
      else
        call begin_elements(solid(b), 1, solid(b)%n, u0)
      end if
    end do
  end subroutine begin_solids

  !> It is accepted with the displacements u1 (dim, n) at its end.
  pure subroutine commit_solids(solid, u1)
    type(solid_t), intent(inout) :: solid(:)
    real(wp), intent(in) :: u1(:, :)
    integer :: b
    do b = 1, size(solid)
      if (solid(b)%n > 0) call commit_step(solid(b), u1)
    end do
  end subroutine commit_solids

  !> f = f - factor f*(U0, U0 + x), all (dim, n); work: of f* on x, added up [F L].
  subroutine subtract_solid_force(solid, threads, rule, factor, u0, x, f, work)
    type(solid_t), intent(in) :: solid(:)
    integer, intent(in) :: threads
    type(force_rule_t), intent(in) :: rule
    real(wp), intent(in) :: factor, u0(:, :), x(:, :)
    real(wp), intent(inout) :: f(:, :)
    real(wp), intent(out), optional :: work
    real(wp), dimension(size(f, 1), most_nodes) :: force, d
    real(wp) :: total
    integer :: b, k, i
    total = zero
    do b = 1, size(solid)
      if (is_worth_threads(threads, solid(b)%n, solid(b)%dim*solid(b)%nodes, &
          work_of_point)) then
        call subtract_solid_forces(threads, solid(b), rule, factor, u0, x, f, total)
        cycle
      end if
      associate (s => solid(b))
        do k = 1, s%n
          call element_force(s, k, rule, u0, x, force(:, :s%nodes))
          call relative(s, k, x, d(:, :s%nodes))
          do i = 1, s%nodes
            f(:, s%node(i, k)) = f(:, s%node(i, k)) - factor*force(:, i)
            total = total + dot_product(force(:, i), d(:, i))
          end do
        end do
      end associate
    end do
    if (present(work)) work = total
  end subroutine subtract_solid_force

  !> matrix = matrix + d f*/dx.
  subroutine add_solid_tangents(solid, threads, rule, u0, x, graph, matrix)
    type(solid_t), intent(in) :: solid(:)
    integer, intent(in) :: threads
    type(force_rule_t), intent(in) :: rule
    real(wp), intent(in) :: u0(:, :), x(:, :)
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(inout) :: matrix
    real(wp) :: ke(size(u0, 1)*most_nodes, size(u0, 1)*most_nodes)
    integer :: b, k, i, j, d, m, at
    d = size(u0, 1)
    do b = 1, size(solid)
      if (is_worth_threads(threads, solid(b)%n, d*solid(b)%nodes, work_of_point)) then
        call add_tangents(threads, solid(b), rule, u0, x, graph, matrix)
        cycle
      end if
      associate (s => solid(b))
        m = d*s%nodes
        do k = 1, s%n
          call element_tangent(s, k, rule, u0, x, ke(:m, :m))
          do j = 1, s%nodes
            do i = 1, s%nodes
              at = graph%position(s%node(i, k), s%node(j, k))
              matrix%value(:, :, at) = matrix%value(:, :, at) &
                  + ke(d*(i - 1) + 1:d*i, d*(j - 1) + 1:d*j)
            end do
          end do
        end do
      end associate
    end do
  end subroutine add_solid_tangents

  !> b = b - (df*/dx) d, of the elements where d is not zero.
  pure subroutine subtract_tangent_product(solid, rule, u0, x, d, b)
    type(solid_t), intent(in) :: solid(:)
    type(force_rule_t), intent(in) :: rule
    real(wp), intent(in) :: u0(:, :), x(:, :), d(:, :)
    real(wp), intent(inout) :: b(:, :)
    real(wp) :: ke(size(u0, 1)*most_nodes, size(u0, 1)*most_nodes)
    integer :: n, k, m
    do n = 1, size(solid)
      associate (s => solid(n))
        m = size(u0, 1)*s%nodes
        do k = 1, s%n
          if (.not. any(abs(d(:, s%node(:, k))) > zero)) cycle
          call element_tangent(s, k, rule, u0, x, ke(:m, :m))
          b(:, s%node(:, k)) = b(:, s%node(:, k)) - reshape(matmul(ke(:m, :m), &
              reshape(d(:, s%node(:, k)), [m])), [size(u0, 1), s%nodes])
        end do
      end associate
    end do
  end subroutine subtract_tangent_product

  !> energy = energy + that of a block at displacements u [F L].
  pure subroutine add_solid_energy(solid, u, energy)
    type(solid_t), intent(in) :: solid
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(inout) :: energy
    integer :: k
    do k = 1, solid%n
      energy = energy + element_energy(solid, k, u)
    end do
  end subroutine add_solid_energy

  !> The smallest det F at a point, at displacements u, and the row of its element.
  pure subroutine smallest_volume(solid, u, volume, element)
    type(solid_t), intent(in) :: solid(:)
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: volume
    integer, intent(out) :: element
    real(wp) :: det
    integer :: b, k
    volume = huge(one)
    element = 0
    do b = 1, size(solid)
      do k = 1, solid(b)%n
        det = smallest_determinant(solid(b), k, u)
        if (det >= volume) cycle
        volume = det
        element = solid(b)%first + k - 1
      end do
    end do
  end subroutine smallest_volume

  !> The smallest principal stretch that is doubtful for the law of its element, the row of that
  !> element, 0 where there is none, and the stretch that its law bears.
  pure subroutine find_compression(solid, u, stretch, element, limit)
    type(solid_t), intent(in) :: solid(:)
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: stretch, limit
    integer, intent(out) :: element
    real(wp) :: least
    integer :: b, k
    stretch = huge(one)
    limit = zero
    element = 0
    do b = 1, size(solid)
      if (solid(b)%n == 0) cycle
      associate (law => solid(b)%material)
        if (.not. law%doubtful_stretch > zero) cycle
        do k = 1, solid(b)%n
          least = least_stretch(solid(b), k, u, law%doubtful_stretch)
          if (least >= min(stretch, law%doubtful_stretch)) cycle
          stretch = least
          element = solid(b)%first + k - 1
          limit = law%least_stretch
        end do
      end associate
    end do
  end subroutine find_compression

  !> Plastic work so far [F L].
  pure real(wp) function plastic_work(solid)
    type(solid_t), intent(in) :: solid(:)
    integer :: b, k
    plastic_work = zero
    do b = 1, size(solid)
      if (solid(b)%n == 0) cycle
      associate (row => solid(b)%material%work_state)
        if (row == 0) cycle
        do k = 1, solid(b)%n
          plastic_work = plastic_work &
              + dot_product(solid(b)%weight(:, k), solid(b)%history(row, :, k))
        end do
      end associate
    end do
  end function plastic_work

  !> Saves to or restores from the archive the histories of the points.
  subroutine exchange_solids(archive, solid)
    type(archive_t), intent(inout) :: archive
    type(solid_t), intent(inout) :: solid(:)
    real(wp), allocatable :: flat(:, :)
    integer :: b
    do b = 1, size(solid)
      if (solid(b)%n == 0) cycle
      if (solid(b)%material%states == 0) cycle
      associate (history => solid(b)%history)
        flat = reshape(history, [size(history, 1)*size(history, 2), size(history, 3)])
        call archive%exchange('history.'//to_text(b), flat)
        history = reshape(flat, shape(history))
      end associate
    end do
  end subroutine exchange_solids

end module assembly_solid
