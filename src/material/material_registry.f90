! SPDX-License-Identifier: BSD-3-Clause
!> Materials by the keyword that defines them. To add one: its file, its `use`, its name and its
!> case; its card is a row of deck_keywords_material.
module material_registry
  use base_kinds, only: wp, zero
  use material_base, only: material_t
  use material_blatz_foam, only: new_blatz_foam
  use material_blatz_rubber, only: new_blatz_rubber
  use material_elastic, only: new_elastic
  use material_hencky, only: hencky_t
  use material_mooney, only: new_mooney
  use material_neo_hooke, only: new_neo_hooke
  use material_ogden, only: new_ogden
  use material_plastic, only: new_bilinear, new_piecewise
  use material_rigid, only: rigid_material_t
  implicit none
  private
  integer, parameter, public :: max_constants = 32
  character(31), parameter, public :: material_keywords(9) = [character(31) :: &
      'MAT_ELASTIC', 'MAT_RIGID', 'MAT_BLATZ-KO_RUBBER', 'MAT_BLATZ-KO_FOAM', &
      'MAT_MOONEY-RIVLIN_RUBBER', 'MAT_OGDEN_RUBBER', 'MAT_HYPERELASTIC_RUBBER', &
      'MAT_PLASTIC_KINEMATIC', 'MAT_PIECEWISE_LINEAR_PLASTICITY']
  public :: make_material

contains

  !> A material of one keyword with its constants, the fields of its cards after the id; not
  !> allocated for an unknown keyword; 'MAT_ELASTIC HENCKY' is *MAT_ELASTIC with LAW HENCKY.
  !> yield (2, points): equivalent plastic strain and yield stress [F/L2] of a law that hardens
  !> by a curve, which then come before its constants.
  subroutine make_material(keyword, id, constants, material, yield)
    character(*), intent(in) :: keyword
    integer, intent(in) :: id
    real(wp), intent(in) :: constants(:)
    class(material_t), allocatable, intent(out) :: material
    real(wp), intent(in), optional :: yield(:, :)
    real(wp) :: c(max_constants)
    c = zero
    c(:size(constants)) = constants
    select case (keyword)
    case ('MAT_ELASTIC')
      allocate (material, source=new_elastic(id, c(1), c(2), c(3)))
    case ('MAT_ELASTIC HENCKY')
      allocate (material, source=hencky_t(id=id, density=c(1), young=c(2), poisson=c(3), &
          is_finite=.true.))
    case ('MAT_RIGID')
      allocate (material, source=rigid_material_t(id=id, density=c(1), is_rigid=.true.))
    case ('MAT_BLATZ-KO_RUBBER')
      allocate (material, source=new_blatz_rubber(id, c(1), c(2)))
    case ('MAT_BLATZ-KO_FOAM')
      allocate (material, source=new_blatz_foam(id, c(1), c(2)))
    case ('MAT_MOONEY-RIVLIN_RUBBER')
      allocate (material, source=new_mooney(id, c(1), c(2), c(3), c(4)))
    case ('MAT_OGDEN_RUBBER')
      allocate (material, source=new_ogden(id, c(1), c(2), c(8:15), c(16:23)))
    case ('MAT_HYPERELASTIC_RUBBER')
      allocate (material, source=new_neo_hooke(id, c(1), c(2), c(8)))
    case ('MAT_PLASTIC_KINEMATIC')
      allocate (material, source=new_bilinear(id, c(1), c(2), c(3), c(4), c(5), c(6)))
    case ('MAT_PIECEWISE_LINEAR_PLASTICITY')
      if (present(yield)) then
        allocate (material, source=new_piecewise(id, c(1), c(2), c(3), yield(1, :), &
            yield(2, :)))
      else
        allocate (material, source=new_bilinear(id, c(1), c(2), c(3), c(4), c(5), 1.0_wp))
      end if
    end select
  end subroutine make_material

end module material_registry
