! SPDX-License-Identifier: BSD-3-Clause
!> Keywords of materials.
module deck_keywords_material
  use base_strings, only: to_text
  use deck_table, only: table_t, add_keyword, add_alias, add_card, add_field
  implicit none
  private
  public :: add_materials

contains

  !> Adds the rows of all materials.
  subroutine add_materials(table)
    type(table_t), intent(inout) :: table
    call add_rigid_material(table)
    call add_elastic(table)
    call add_blatz(table, 'MAT_BLATZ-KO_RUBBER', 'MAT_007', &
        'rubber of Blatz and Ko: neo-Hookean, Poisson ratio 0.463; finite strain')
    call add_blatz(table, 'MAT_BLATZ-KO_FOAM', 'MAT_038', &
        'foam rubber of Blatz and Ko, Poisson ratio 0.25; finite strain')
    call add_mooney(table)
    call add_ogden(table)
    call add_hyperelastic(table)
    call add_plastic_kinematic(table)
    call add_piecewise(table)
  end subroutine add_materials

  subroutine add_rigid_material(table)
    type(table_t), intent(inout) :: table
    integer :: k
    call add_keyword(table, 'MAT_RIGID', 'rigid parts', title=.true., required=3)
    call add_card(table)
    call add_field(table, 'MID', 'I10 req >0', 'material number')
    call add_field(table, 'RO', 'R10 req [M/L3] >0', 'density')
    call add_field(table, 'E', 'R10 note [F/L2]', 'of penalty contact')
    call add_field(table, 'PR', 'R10 note', 'of penalty contact')
    call add_field(table, 'N', 'R10 fixed')
    call add_field(table, 'COUPLE', 'R10 fixed')
    call add_field(table, 'M', 'R10 fixed')
    call add_field(table, 'ALIAS', 'R10 fixed')
    call add_card(table)
    call add_field(table, 'CMO', 'R10 =0.0 >=0 <=1', '1: CON1 and CON2 hold the centre of mass')
    call add_field(table, 'CON1', 'I10 =0 >=0 <=7', &
        'held: 1 x, 2 y, 3 z, 4 x y, 5 y z, 6 z x, 7 x y z')
    call add_field(table, 'CON2', 'I10 =0 >=0 <=7', &
        'held rotations, as CON1; that about z is held by 3, 5, 6, 7')
    call add_card(table)
    call add_field(table, 'LCO/A1', 'R10 fixed', 'local axes of output')
    do k = 2, 3
      call add_field(table, 'A'//achar(48 + k), 'R10 fixed')
    end do
    do k = 1, 3
      call add_field(table, 'V'//achar(48 + k), 'R10 fixed')
    end do
    call add_alias(table, 'MAT_020')
  end subroutine add_rigid_material

  subroutine add_elastic(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'MAT_ELASTIC', 'linear elastic material', title=.true., required=1)
    call add_card(table)
    call add_field(table, 'MID', 'I10 req >0', 'material number')
    call add_field(table, 'RO', 'R10 req [M/L3] >0', 'density')
    call add_field(table, 'E', 'R10 req [F/L2] >0', 'Young modulus')
    call add_field(table, 'PR', 'R10 =0.0 >-1 <0.5', 'Poisson ratio')
    call add_field(table, 'DA', 'R10 fixed')
    call add_field(table, 'DB', 'R10 fixed')
    call add_field(table, 'K', 'R10 fixed', 'of the fluid option')
    call add_alias(table, 'MAT_001')
  end subroutine add_elastic

  !> Number and density, which all cards begin with.
  subroutine add_head(table)
    type(table_t), intent(inout) :: table
    call add_card(table)
    call add_field(table, 'MID', 'I10 req >0', 'material number')
    call add_field(table, 'RO', 'R10 req [M/L3] >0', 'density')
  end subroutine add_head

  subroutine add_blatz(table, name, short, help)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, short, help
    call add_keyword(table, name, help, title=.true., required=1)
    call add_head(table)
    call add_field(table, 'G', 'R10 req [F/L2] >0', 'shear modulus')
    call add_field(table, 'REF', 'R10 fixed', 'of a reference geometry')
    call add_alias(table, short)
  end subroutine add_blatz

  subroutine add_mooney(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'MAT_MOONEY-RIVLIN_RUBBER', &
        'rubber of Mooney and Rivlin, nearly incompressible; finite strain', title=.true., &
        required=1)
    call add_head(table)
    call add_field(table, 'PR', 'R10 req >0 <0.5', &
        'Poisson ratio; above .4 to .4545, as A and B are; .49 to .4995 is usual')
    call add_field(table, 'A', 'R10 =0.0 [F/L2]', 'of the first invariant; A + B > 0')
    call add_field(table, 'B', 'R10 =0.0 [F/L2]', 'of the second invariant')
    call add_field(table, 'REF', 'R10 fixed', 'of a reference geometry')
    call add_card(table)
    call add_field(table, 'SGL', 'R10 fixed', 'of a fit to a test')
    call add_field(table, 'SW', 'R10 fixed', 'of a fit to a test')
    call add_field(table, 'ST', 'R10 fixed', 'of a fit to a test')
    call add_field(table, 'LCID', 'I10 fixed', 'of a fit to a test')
    call add_alias(table, 'MAT_027')
  end subroutine add_mooney

  !> What laws of powers of stretches or of invariants have in common.
  subroutine add_rubber_head(table)
    type(table_t), intent(inout) :: table
    call add_head(table)
    call add_field(table, 'PR', 'R10 req >=0 <0.5', 'Poisson ratio')
    call add_field(table, 'N', 'I10 fixed', 'of a fit to a test')
    call add_field(table, 'NV', 'I10 fixed =6 0=d', 'of relaxation')
    call add_field(table, 'G', 'R10 fixed', 'of damping')
    call add_field(table, 'SIGF', 'R10 fixed', 'of damping')
    call add_field(table, 'REF', 'R10 fixed', 'of a reference geometry')
    call add_card(table)
  end subroutine add_rubber_head

  subroutine add_ogden(table)
    type(table_t), intent(inout) :: table
    integer :: k
    call add_keyword(table, 'MAT_OGDEN_RUBBER', &
        'rubber of Ogden, powers of the stretches; finite strain', title=.true., required=3)
    call add_rubber_head(table)
    do k = 1, 8
      call add_field(table, 'MU'//to_text(k), 'R10 =0.0 [F/L2]', &
          'of its term; half the sum of MU ALPHA is the shear modulus, > 0')
    end do
    call add_card(table)
    do k = 1, 8
      call add_field(table, 'ALPHA'//to_text(k), 'R10 =0.0', 'exponent of its term')
    end do
    call add_alias(table, 'MAT_077_O')
  end subroutine add_ogden

  subroutine add_hyperelastic(table)
    type(table_t), intent(inout) :: table
    character(3), parameter :: other(5) = ['C01', 'C11', 'C20', 'C02', 'C30']
    integer :: k
    call add_keyword(table, 'MAT_HYPERELASTIC_RUBBER', &
        'neo-Hookean law, shape and volume apart; finite strain', title=.true., required=2)
    call add_rubber_head(table)
    call add_field(table, 'C10', 'R10 req [F/L2] >0', 'half the shear modulus')
    do k = 1, size(other)
      call add_field(table, other(k), 'R10 fixed [F/L2]', 'of other terms')
    end do
    call add_field(table, 'THERML', 'R10 fixed', 'of heat')
    call add_alias(table, 'MAT_077_H')
  end subroutine add_hyperelastic

  !> What plastic laws have in common.
  subroutine add_plastic_head(table)
    type(table_t), intent(inout) :: table
    call add_head(table)
    call add_field(table, 'E', 'R10 req [F/L2] >0', 'Young modulus')
    call add_field(table, 'PR', 'R10 =0.0 >-1 <0.5', 'Poisson ratio')
  end subroutine add_plastic_head

  subroutine add_plastic_kinematic(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'MAT_PLASTIC_KINEMATIC', &
        'plasticity of von Mises with linear hardening; finite strain', title=.true., &
        required=1)
    call add_plastic_head(table)
    call add_field(table, 'SIGY', 'R10 req [F/L2] >0', 'yield stress')
    call add_field(table, 'ETAN', 'R10 =0.0 [F/L2] >=0', 'tangent modulus of a bar, < E')
    call add_field(table, 'BETA', 'R10 =0.0 >=0 <=1', 'hardening: 0 kinematic, 1 isotropic')
    call add_card(table)
    call add_field(table, 'SRC', 'R10 fixed', 'of rates of strain')
    call add_field(table, 'SRP', 'R10 fixed', 'of rates of strain')
    call add_field(table, 'FS', 'R10 fixed =1.0E20 0=d', 'of failure')
    call add_field(table, 'VP', 'R10 fixed', 'of rates of strain')
    call add_alias(table, 'MAT_003')
  end subroutine add_plastic_kinematic

  subroutine add_piecewise(table)
    type(table_t), intent(inout) :: table
    integer :: k
    call add_keyword(table, 'MAT_PIECEWISE_LINEAR_PLASTICITY', &
        'plasticity of von Mises, isotropic hardening by a curve; finite strain', &
        title=.true., required=1)
    call add_plastic_head(table)
    call add_field(table, 'SIGY', 'R10 =0.0 [F/L2] >=0', 'yield stress; by LCSS, EPS not used')
    call add_field(table, 'ETAN', 'R10 =0.0 [F/L2] >=0', &
        'tangent modulus of a bar, < E; by LCSS, EPS not used')
    call add_field(table, 'FAIL', 'R10 fixed =1.0E21 0=d', 'of failure')
    call add_field(table, 'TDEL', 'R10 fixed', 'of failure')
    call add_card(table)
    call add_field(table, 'C', 'R10 fixed', 'of rates of strain')
    call add_field(table, 'P', 'R10 fixed', 'of rates of strain')
    call add_field(table, 'LCSS', 'I10 =0 >=0', &
        'curve: yield stress against equivalent plastic strain; by it EPS is not used')
    call add_field(table, 'LCSR', 'I10 fixed', 'of rates of strain')
    call add_field(table, 'VP', 'R10 fixed', 'of rates of strain')
    call add_card(table)
    do k = 1, 8
      call add_field(table, 'EPS'//to_text(k), 'R10 =0.0 >=0', &
          'equivalent plastic strain, EPS1 = 0; the last slope goes on')
    end do
    call add_card(table)
    do k = 1, 8
      call add_field(table, 'ES'//to_text(k), 'R10 =0.0 [F/L2] >=0', &
          'its yield stress, not falling')
    end do
    call add_alias(table, 'MAT_024')
  end subroutine add_piecewise

end module deck_keywords_material
