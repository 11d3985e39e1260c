! SPDX-License-Identifier: BSD-3-Clause
!> Keywords of the mesh: nodes, elements, parts, sections, sets.
module deck_keywords_mesh
  use base_strings, only: to_text
  use deck_keywords_material, only: add_materials
  use deck_table, only: table_t, add_keyword, add_alias, add_card, add_field
  implicit none
  private
  public :: add_mesh_keywords, add_segment_nodes

contains

  !> Adds the rows of the mesh.
  subroutine add_mesh_keywords(table)
    type(table_t), intent(inout) :: table
    call add_nodes_and_elements(table)
    call add_solids(table)
    call add_parts(table)
    call add_solid_section(table)
    call add_materials(table)
    call add_list_set(table, 'SET_NODE_LIST', 'SET_NODE', 'NID', 'node')
    call add_range_set(table, 'SET_NODE_LIST_GENERATE', 'node')
    call add_list_set(table, 'SET_PART_LIST', 'SET_PART', 'PID', 'part')
    call add_range_set(table, 'SET_PART_LIST_GENERATE', 'part')
    call add_list_set(table, 'SET_SHELL_LIST', 'SET_SHELL', 'EID', 'element')
    call add_range_set(table, 'SET_SHELL_LIST_GENERATE', 'element')
    call add_list_set(table, 'SET_SOLID_LIST', 'SET_SOLID', 'EID', 'element')
    call add_range_set(table, 'SET_SOLID_LIST_GENERATE', 'element')
    call add_alias(table, 'SET_SOLID_GENERATE')
    call add_segment_set(table)
    call add_column_set(table, 'SET_NODE_COLUMN', 'NID', 'node')
    call add_column_set(table, 'SET_PART_COLUMN', 'PID', 'part')
    call add_column_set(table, 'SET_SHELL_COLUMN', 'EID', 'element')
    call add_general_set(table, 'SET_NODE_GENERAL', 'node', 'NODE')
    call add_general_set(table, 'SET_SHELL_GENERAL', 'element', 'ELEM')
    call add_general_set(table, 'SET_SOLID_GENERAL', 'element', 'ELEM')
    call add_general_set(table, 'SET_SEGMENT_GENERAL', 'exterior edge or face', 'SEG')
    call add_box(table)
  end subroutine add_mesh_keywords

  subroutine add_nodes_and_elements(table)
    type(table_t), intent(inout) :: table
    integer :: k
    call add_keyword(table, 'NODE', 'nodes', repeat_from=1)
    call add_card(table)
    call add_field(table, 'NID', 'I8 req >0', 'node number')
    call add_field(table, 'X', 'R16 =0.0 [L]', 'coordinate')
    call add_field(table, 'Y', 'R16 =0.0 [L]', 'coordinate')
    call add_field(table, 'Z', 'R16 =0.0 [L]', &
        'coordinate; the same for all nodes of a plane model')
    call add_field(table, 'TC', 'I8 =0 >=0 <=7', &
        'held: 1 x, 2 y, 3 z, 4 x y, 5 y z, 6 z x, 7 x y z')
    call add_field(table, 'RC', 'I8 note >=0 <=7', 'nodes do not rotate')
    call add_keyword(table, 'ELEMENT_SHELL', 'plane elements, counter-clockwise', repeat_from=1)
    call add_card(table)
    call add_field(table, 'EID', 'I8 req >0', 'element number')
    call add_field(table, 'PID', 'I8 req >0', 'part')
    call add_field(table, 'N1', 'I8 req >0', 'node')
    call add_field(table, 'N2', 'I8 req >0', 'node')
    call add_field(table, 'N3', 'I8 req >0', 'node')
    call add_field(table, 'N4', 'I8 =0 >=0', 'node; blank, 0 or N3: a triangle')
    do k = 5, 8
      call add_field(table, 'N'//achar(48 + k), 'I8 fixed')
    end do
    call add_keyword(table, 'ELEMENT_BEAM', 'boundary lines of mesh generators, left out: '// &
        'their part must have no *PART', repeat_from=1)
    call add_card(table)
    call add_field(table, 'EID', 'I8 req >0', 'element number')
    call add_field(table, 'PID', 'I8 req >0', 'part')
    do k = 1, 3
      call add_field(table, 'N'//achar(48 + k), 'I8 ignored')
    end do
    call add_field(table, 'RT1', 'I8 ignored')
    call add_field(table, 'RR1', 'I8 ignored')
    call add_field(table, 'RT2', 'I8 ignored')
    call add_field(table, 'RR2', 'I8 ignored')
    call add_field(table, 'LOCAL', 'I8 ignored')
  end subroutine add_nodes_and_elements

  !> Elements in space: with their nodes on one card, or on a second one. The name of the
  !> second form is also what programs write; a deck's name ends at the first blank.
  subroutine add_solids(table)
    type(table_t), intent(inout) :: table
    character(*), parameter :: tet10 = &
        'of a quadratic tetrahedron, whose N5 to N10 lie on 12, 23, 31, 14, 24, 34; else 0'
    integer :: row, m
    call add_keyword(table, 'ELEMENT_SOLID', &
        'elements in space: hexahedra, wedges, pyramids, tetrahedra', repeat_from=1)
    call add_card(table)
    call add_field(table, 'EID', 'I8 req >0', 'element number')
    call add_field(table, 'PID', 'I8 req >0', 'part')
    call add_corners(table)
    row = table%n
    call add_keyword(table, 'ELEMENT_SOLID (ten nodes format)', 'the same by two cards: so '// &
        'where the first card of *ELEMENT_SOLID has EID and PID alone', repeat_from=1)
    table%keyword(table%n)%canonical_row = row
    table%keyword(row)%other_form = table%n
    call add_card(table)
    call add_field(table, 'EID', 'I8 req >0', 'element number')
    call add_field(table, 'PID', 'I8 req >0', 'part')
    call add_card(table)
    call add_corners(table)
    call add_field(table, 'N9', 'I8 =0 >=0', tet10)
    call add_field(table, 'N10', 'I8 =0 >=0', tet10)
    call add_keyword(table, 'ELEMENT_SOLID_H27', 'quadratic hexahedra (ELFORM 24)', &
        repeat_from=1)
    call add_card(table)
    call add_field(table, 'EID', 'I8 req >0', 'element number')
    call add_field(table, 'PID', 'I8 req >0', 'part')
    do m = 1, 27
      if (mod(m, 10) == 1) call add_card(table)
      call add_field(table, 'N'//to_text(m), 'I8 req >0', merge( &
          'corner, in the order of *ELEMENT_SOLID            ', &
          'node on an edge, a face, in the middle: VTK or any', m <= 8))
    end do
  end subroutine add_solids

  subroutine add_corners(table)
    type(table_t), intent(inout) :: table
    character(48), parameter :: repeated(5:8) = [character(48) :: &
        'node above N1', 'node above N2; wedge: 1 2 3 4 5 5 6 6', &
        'node above N3; pyramid: 1 2 3 4 5 5 5 5', &
        'node above N4; tetrahedron: 1 2 3 4 4 4 4 4']
    integer :: k
    do k = 1, 4
      call add_field(table, 'N'//achar(48 + k), 'I8 req >0', &
          'node; N1 to N4 counter-clockwise seen from N5')
    end do
    do k = 5, 8
      call add_field(table, 'N'//achar(48 + k), 'I8 =0 >=0', trim(repeated(k)))
    end do
  end subroutine add_corners

  subroutine add_solid_section(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'SECTION_SOLID', 'form of elements in space', title=.true., &
        repeat_from=1)
    call add_card(table)
    call add_field(table, 'SECID', 'I10 req >0', 'section number')
    call add_field(table, 'ELFORM', 'I10 =1 0=d', &
        '1 full, 2 mean dilatation, -1 -2 18 -18 62 incompatible modes, 10 13 60 TET4, '// &
        '15 115 WEDGE6, 16 TET10, 24 HEX27')
    call add_field(table, 'AET', 'I10 fixed', 'of other kinds of element')
    call add_field(table, 'NIP', 'R10 fixed', 'points are those of the form')
    call add_field(table, '-', 'R10 fixed')
    call add_field(table, '-', 'R10 fixed')
    call add_field(table, 'COHOFF', 'R10 fixed', 'of cohesive elements')
    call add_field(table, 'GASKEIT', 'R10 fixed', 'of gaskets')
  end subroutine add_solid_section

  subroutine add_parts(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'PART', 'a body: section and material', repeat_from=1, required=2)
    call add_part_cards(table)
    call add_inertia(table)
    call add_keyword(table, 'SECTION_SHELL', 'plane strain or stress, thickness; axisymmetry', &
        title=.true., repeat_from=1, required=2)
    call add_card(table)
    call add_field(table, 'SECID', 'I10 req >0', 'section number')
    call add_field(table, 'ELFORM', 'I10 =2', '12 plane stress, 13 plane strain, 15 '// &
        'axisymmetric about y, x is the radius (14: a note)')
    call add_field(table, 'SHRF', 'R10 note =1.0 0=d', 'of shells')
    call add_field(table, 'NIP', 'I10 =4 0=d', &
        '4 = 2 x 2 Gauss points; so are blank and 2, the default of shells (a note)')
    call add_field(table, 'PROPT', 'R10 note =1.0 0=d', 'of printing')
    call add_field(table, 'QR/IRID', 'R10 fixed')
    call add_field(table, 'ICOMP', 'I10 fixed')
    call add_field(table, 'SETYP', 'I10 fixed =1 0=d', '1 = Lagrangian elements')
    call add_card(table)
    call add_field(table, 'T1', 'R10 =1.0 0=d [L] >=0', 'thickness; none with '// &
        'ELFORM 15')
    call add_field(table, 'T2', 'R10 0=d [L]', 'equal to T1, or blank or 0')
    call add_field(table, 'T3', 'R10 0=d [L]', 'equal to T1, or blank or 0')
    call add_field(table, 'T4', 'R10 0=d [L]', 'equal to T1, or blank or 0')
    call add_field(table, 'NLOC', 'R10 fixed')
    call add_field(table, 'MAREA', 'R10 fixed', 'mass without structure')
    call add_field(table, 'IDOF', 'R10 fixed')
    call add_field(table, 'EDGSET', 'I10 fixed')
  end subroutine add_parts

  !> Heading and numbers of a part.
  subroutine add_part_cards(table)
    type(table_t), intent(inout) :: table
    call add_card(table)
    call add_field(table, 'HEADING', 'T70', 'any text')
    call add_card(table)
    call add_field(table, 'PID', 'I10 req >0', 'part number')
    call add_field(table, 'SECID', 'I10 =0 >=0', 'section')
    call add_field(table, 'MID', 'I10 =0 >=0', 'material')
    call add_field(table, 'EOSID', 'I10 fixed')
    call add_field(table, 'HGID', 'I10 note', 'elements are fully integrated')
    call add_field(table, 'GRAV', 'I10 fixed')
    call add_field(table, 'ADPOPT', 'I10 fixed')
    call add_field(table, 'TMID', 'I10 note', 'of thermal analysis')
  end subroutine add_part_cards

  subroutine add_inertia(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'PART_INERTIA', 'a rigid part with the mass and inertia given', &
        repeat_from=1, required=5)
    call add_part_cards(table)
    call add_card(table)
    call add_field(table, 'XC', 'R10 =0.0 [L]', 'centre of mass')
    call add_field(table, 'YC', 'R10 =0.0 [L]', 'centre of mass')
    call add_field(table, 'ZC', 'R10 ignored [L]')
    call add_field(table, 'TM', 'R10 req [M] >0', 'mass')
    call add_field(table, 'IRCS', 'I10 fixed', '0: axes of the model')
    call add_field(table, 'NODEID', 'I10 fixed', '0: the centre is XC, YC')
    call add_card(table)
    call add_field(table, 'IXX', 'R10 ignored')
    call add_field(table, 'IXY', 'R10 ignored')
    call add_field(table, 'IXZ', 'R10 ignored')
    call add_field(table, 'IYY', 'R10 ignored')
    call add_field(table, 'IYZ', 'R10 ignored')
    call add_field(table, 'IZZ', 'R10 req [ML2] >0', 'moment of inertia about the centre')
    call add_card(table)
    call add_field(table, 'VTX', 'R10 =0.0 [L/T]', 'initial velocity of the centre')
    call add_field(table, 'VTY', 'R10 =0.0 [L/T]', 'initial velocity of the centre')
    call add_field(table, 'VTZ', 'R10 fixed [L/T]', 'the model is plane')
    call add_field(table, 'VRX', 'R10 fixed')
    call add_field(table, 'VRY', 'R10 fixed')
    call add_field(table, 'VRZ', 'R10 =0.0 [1/T]', 'initial angular velocity')
  end subroutine add_inertia

  subroutine add_set_head(table)
    type(table_t), intent(inout) :: table
    integer :: k
    call add_card(table)
    call add_field(table, 'SID', 'I10 req >0', 'set number')
    do k = 1, 4
      call add_field(table, 'DA'//achar(48 + k), 'R10 fixed')
    end do
    call add_field(table, 'SOLVER', 'W10 fixed =MECH |MECH|')
    call add_field(table, 'ITS', 'I10 ignored >=0 <=1')
  end subroutine add_set_head

  subroutine add_list_set(table, name, short, member, what)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, short, member, what
    integer :: k
    call add_keyword(table, name, what//' set', title=.true., required=2, repeat_from=2)
    call add_set_head(table)
    call add_card(table)
    do k = 1, 8
      call add_field(table, member//achar(48 + k), 'I10 =0 >=0', what//'; zeros are padding')
    end do
    call add_alias(table, short)
  end subroutine add_list_set

  subroutine add_range_set(table, name, what)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, what
    integer :: k
    call add_keyword(table, name, what//' set by ranges of numbers', title=.true., required=2, &
        repeat_from=2)
    call add_set_head(table)
    call add_card(table)
    do k = 1, 4
      call add_field(table, 'B'//achar(48 + k)//'BEG', 'I10 =0 >=0', 'first '//what// &
          ' of a range; numbers that do not exist are left out')
      call add_field(table, 'B'//achar(48 + k)//'END', 'I10 =0 >=0', 'its last '//what)
    end do
  end subroutine add_range_set

  subroutine add_column_set(table, name, member, what)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, member, what
    integer :: k
    call add_keyword(table, name, what//' set, one '//what//' a card', title=.true., &
        required=2, repeat_from=2)
    call add_set_head(table)
    call add_card(table)
    call add_field(table, member, 'I10 req >0', what)
    do k = 1, 4
      call add_field(table, 'A'//achar(48 + k), 'R10 fixed')
    end do
  end subroutine add_column_set

  !> one: the word that names single members.
  subroutine add_general_set(table, name, what, one)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, what, one
    integer :: k
    call add_keyword(table, name, what//' set by clauses, obeyed in their order', &
        title=.true., required=2, repeat_from=2)
    call add_set_head(table)
    call add_card(table)
    call add_field(table, 'OPTION', 'W10 req |ALL|'//one//'|D'//one//'|PART|DPART|BOX|DBOX|', &
        'what to add; with D: to take away')
    do k = 1, 7
      call add_field(table, 'E'//achar(48 + k), 'I10 =0 >=0', 'a number; zeros are padding')
    end do
  end subroutine add_general_set

  subroutine add_box(table)
    type(table_t), intent(inout) :: table
    call add_keyword(table, 'DEFINE_BOX', 'a box along the axes, for sets', title=.true., &
        required=1)
    call add_card(table)
    call add_field(table, 'BOXID', 'I10 req >0', 'box number')
    call add_field(table, 'XMN', 'R10 =0.0 [L]', 'smallest x')
    call add_field(table, 'XMX', 'R10 =0.0 [L]', 'largest x')
    call add_field(table, 'YMN', 'R10 =0.0 [L]', 'smallest y')
    call add_field(table, 'YMX', 'R10 =0.0 [L]', 'largest y')
    call add_field(table, 'ZMN', 'R10 =0.0 [L]', 'smallest z')
    call add_field(table, 'ZMX', 'R10 =0.0 [L]', 'largest z')
  end subroutine add_box

  subroutine add_segment_set(table)
    type(table_t), intent(inout) :: table
    integer :: k
    call add_keyword(table, 'SET_SEGMENT', 'set of element edges, in space of faces', &
        title=.true., required=2, repeat_from=2)
    call add_set_head(table)
    call add_card(table)
    call add_segment_nodes(table)
    do k = 1, 4
      call add_field(table, 'A'//achar(48 + k), 'R10 fixed')
    end do
  end subroutine add_segment_set

  !> The nodes of a segment.
  subroutine add_segment_nodes(table)
    type(table_t), intent(inout) :: table
    call add_field(table, 'N1', 'I10 req >0', 'node of an exterior element edge or face')
    call add_field(table, 'N2', 'I10 req >0', 'its next node; the sense does not matter')
    call add_field(table, 'N3', 'I10 =0 >=0', 'plane: 0 or N2; space: its third node')
    call add_field(table, 'N4', 'I10 =0 >=0', &
        'plane: 0 or N2; space: its fourth node, 0 or N3 for a triangle')
  end subroutine add_segment_nodes

end module deck_keywords_mesh
