! SPDX-License-Identifier: BSD-3-Clause
!> The pairings by name: a new one is a file and its two lines here.
module contact_registry
  use contact_cylinder, only: cylinder_t
  use contact_flat, only: flat_t
  use contact_mortar, only: pairing_mortar_t
  use contact_node, only: pairing_node_t
  use contact_pairing, only: pairing_t
  use contact_space, only: pairing_space_t
  use contact_wall, only: pairing_wall_t
  implicit none
  private
  public :: make_pairing

contains

  !> A pairing by its name; not allocated for an unknown one.
  subroutine make_pairing(name, pairing)
    character(*), intent(in) :: name
    class(pairing_t), allocatable, intent(out) :: pairing
    select case (name)
    case ('NODE')
      allocate (pairing_node_t :: pairing)
    case ('SPACE')
      allocate (pairing_space_t :: pairing)
    case ('MORTAR')
      allocate (pairing_mortar_t :: pairing)
    case ('WALL')
      allocate (pairing_wall_t :: pairing)
    case ('FLAT')
      allocate (flat_t :: pairing)
    case ('CYLINDER')
      allocate (cylinder_t :: pairing)
    end select
  end subroutine make_pairing

end module contact_registry
