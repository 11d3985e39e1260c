! SPDX-License-Identifier: BSD-3-Clause
!> Materials by the keyword that defines them. To add one: its file, its `use`, its name and its
!> case; its card is a row of deck_keywords_mesh.
module material_registry
  use base_kinds, only: wp
  use material_base, only: material_t
  use material_elastic, only: elastic_t
  use material_rigid, only: rigid_material_t
  implicit none
  private
  integer, parameter, public :: max_constants = 9
  character(11), parameter, public :: material_keywords(2) = [character(11) :: &
      'MAT_ELASTIC', 'MAT_RIGID']
  public :: make_material

contains

  !> A material of one keyword with its constants, the fields of its card after the id; not
  !> allocated for an unknown keyword.
  subroutine make_material(keyword, id, constants, material)
    character(*), intent(in) :: keyword
    integer, intent(in) :: id
    real(wp), intent(in) :: constants(:)
    class(material_t), allocatable, intent(out) :: material
    select case (keyword)
    case ('MAT_ELASTIC')
      allocate (material, source=elastic_t(id=id, density=constants(1), young=constants(2), &
          poisson=constants(3), is_finite=.true., is_quadratic=.true.))
    case ('MAT_RIGID')
      allocate (material, source=rigid_material_t(id=id, density=constants(1), &
          is_rigid=.true.))
    end select
  end subroutine make_material

end module material_registry
