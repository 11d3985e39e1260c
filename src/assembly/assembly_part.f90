! SPDX-License-Identifier: BSD-3-Clause
!> Products with a part of the effective matrix, for a few nodes of a large mesh: some rows of
!> it, or some columns. Each sum has the terms of the whole product in the same order, so its
!> digits are the same.
module assembly_part
  use assembly_damping, only: subtract_mass_damping_rows, subtract_stiffness_damping
  use assembly_forces, only: subtract_element_forces
  use assembly_system, only: system_t, add_mass_rows
  use base_kinds, only: wp
  implicit none
  private

  type, public :: part_t
    integer, allocatable :: row(:)      !< nodes whose rows of M are taken
    integer, allocatable :: element(:)  !< elements that are taken, in increasing order
    integer, allocatable :: massless_layer(:)   !< those of them in the layer
    integer, allocatable :: damped(:)   !< only with damping: those in system%damping%element
  end type part_t

  public :: rows_of_nodes, columns_of_nodes, subtract_part

contains

  !> The part that gives A x at the nodes marked, whatever x (dim, n).
  subroutine rows_of_nodes(system, marked, part)
    type(system_t), intent(in) :: system
    logical, intent(in) :: marked(:)
    type(part_t), intent(out) :: part
    integer :: k
    part%row = pack([(k, k=1, system%n)], marked)
    call find_elements(system, marked, part)
  end subroutine rows_of_nodes

  !> The part that gives A x at all nodes for an x (dim, n) that is zero but at those marked.
  subroutine columns_of_nodes(system, marked, part)
    type(system_t), intent(in) :: system
    logical, intent(in) :: marked(:)
    type(part_t), intent(out) :: part
    integer :: k
    associate (first => system%graph%first, column => system%graph%column)
      part%row = pack([(k, k=1, system%n)], &
          [(any(marked(column(first(k):first(k + 1) - 1))), k=1, system%n)])
    end associate
    call find_elements(system, marked, part)
  end subroutine columns_of_nodes

  !> Elements with a node that is marked.
  subroutine find_elements(system, marked, part)
    type(system_t), intent(in) :: system
    logical, intent(in) :: marked(:)
    type(part_t), intent(inout) :: part
    logical, allocatable :: is_taken(:)
    integer :: e
    allocate (is_taken(size(system%block_of)))
    do e = 1, size(is_taken)
      associate (block => system%block(system%block_of(e)))
        is_taken(e) = any(marked(block%node(:, e - block%first + 1)))
      end associate
    end do
    part%element = pack([(e, e=1, size(is_taken))], is_taken)
    part%massless_layer = pack(system%massless_layer, is_taken(system%massless_layer))
    if (allocated(system%damping)) part%damped = &
        pack([(e, e=1, size(system%damping%element))], is_taken(system%damping%element))
  end subroutine find_elements

  !> b = b - (cM M + cC C + cL L + cK K) x with the part, L = K of the layer; right at the nodes
  !> that it was made for, or everywhere for its columns. x, b (dim, n).
  subroutine subtract_part(system, part, c_m, c_c, c_layer, c_k, x, b)
    type(system_t), intent(in) :: system
    type(part_t), intent(in) :: part
    real(wp), intent(in) :: c_m, c_c, c_layer, c_k
    real(wp), intent(in) :: x(:, :)
    real(wp), intent(inout) :: b(:, :)
    call add_mass_rows(system, part%row, -c_m, x, b)
    call subtract_element_forces(system, part%element, c_k, x, b)
    call subtract_element_forces(system, part%massless_layer, c_layer, x, b)
    if (.not. allocated(system%damping)) return
    call subtract_mass_damping_rows(system, part%row, c_c, x, b)
    call subtract_stiffness_damping(system, part%damped, c_c, x, b)
  end subroutine subtract_part

end module assembly_part
