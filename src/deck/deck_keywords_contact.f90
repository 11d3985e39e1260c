! SPDX-License-Identifier: BSD-3-Clause
!> Keywords of contact and of the tables.
module deck_keywords_contact
  use base_strings, only: upper
  use deck_names, only: table_keywords, table_names, table_count, table_timing, table_glstat
  use deck_table, only: table_t, add_keyword, add_alias, add_card, add_field
  implicit none
  private
  public :: add_contact_keywords, add_space_contact_keywords, add_output_keywords

contains

  !> Adds the contact cards of plane models.
  subroutine add_contact_keywords(table)
    type(table_t), intent(inout) :: table
    call add_contact(table, 'CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE', &
        'contact of two bodies; nodes of both sides are watched')
    call add_contact(table, 'CONTACT_2D_AUTOMATIC_NODE_TO_SURFACE', &
        'contact of two bodies; the nodes of SURFA are exact')
    call add_contact(table, 'CONTACT_2D_AUTOMATIC_SINGLE_SURFACE', &
        'contact of all parts of SURFA with each other and with themselves')
  end subroutine add_contact_keywords

  subroutine add_contact(table, name, help)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, help
    call add_keyword(table, name, help, id=.true., title_is_id=.true., required=1)
    call add_card(table)
    if (index(name, 'SINGLE_SURFACE') > 0) then
      call add_field(table, 'SURFA', 'I10 =0 >=0', 'part set; 0 = all parts')
      call add_field(table, 'SURFB', 'I10 fixed')
    else
      call add_field(table, 'SURFA', 'I10 req', 'part set; < 0: node set')
      call add_field(table, 'SURFB', 'I10 req', 'part set; < 0: node set')
    end if
    call add_field(table, 'SFACT', 'R10 note =1.0 0=d', 'of penalty methods')
    call add_field(table, 'FREQ', 'I10 note =50 0=d', 'of penalty methods')
    call add_field(table, 'FS', 'R10 =0.0 >=0', 'friction mu at rest')
    call add_field(table, 'FD', 'R10 =0.0 0=d >=0', 'friction at speed; DC = 0: no effect')
    call add_field(table, 'DC', 'R10 =0.0 0=d [T/L] >=0', &
        'mu = FD + (FS - FD) exp(-DC speed of slip); 0: mu = FS')
    call add_card(table)
    call add_field(table, 'TBIRTH', 'R10 =0.0 [T]', 'contact is active from this time')
    call add_field(table, 'TDEATH', 'R10 =1.0E20 0=d [T]', 'to this time')
    call add_field(table, 'SOA', 'R10 note =1.0 0=d', 'offset of shells')
    call add_field(table, 'SOB', 'R10 note =1.0 0=d', 'offset of shells')
    call add_field(table, 'NDA', 'I10 note', 'normals come from the elements')
    call add_field(table, 'NDB', 'I10 note', 'normals come from the elements')
    call add_field(table, 'COF', 'I10 note', 'gaps of penalty methods')
    call add_field(table, 'INIT', 'I10 fixed')
    call add_card(table)
    call add_field(table, 'VC', 'R10 fixed', 'viscous friction')
    call add_field(table, 'VDC', 'R10 note =10.0 0=d', 'of penalty methods')
    call add_field(table, 'IPF', 'I10 fixed')
    call add_field(table, 'SLIDE', 'I10 fixed')
    call add_field(table, 'ISTIFF', 'I10 note', 'of penalty methods')
    call add_field(table, 'TIEDGAP', 'R10 fixed')
    call add_field(table, 'IGAPCL', 'I10 fixed')
    call add_field(table, 'TIETYP', 'I10 fixed')
    call add_card(table)
    call add_field(table, 'SLDSOA', 'R10 fixed')
    call add_field(table, 'SLDSOB', 'R10 fixed')
    call add_field(table, 'TDPEN', 'R10 note', 'of penalty methods')
  end subroutine add_contact

  !> Adds the contact cards of models in space.
  subroutine add_space_contact_keywords(table)
    type(table_t), intent(inout) :: table
    call add_space_contact(table, 'CONTACT_AUTOMATIC_SURFACE_TO_SURFACE', &
        'contact of two bodies in space; nodes and edges of both are watched')
    call add_alias(table, 'CONTACT_SURFACE_TO_SURFACE')
    call add_space_contact(table, 'CONTACT_AUTOMATIC_NODES_TO_SURFACE', &
        'contact of two bodies in space; the nodes of SURFA are exact')
    call add_alias(table, 'CONTACT_NODES_TO_SURFACE')
    call add_space_contact(table, 'CONTACT_AUTOMATIC_SINGLE_SURFACE', &
        'contact of all parts of SURFA in space with each other and with themselves')
    call add_alias(table, 'CONTACT_SINGLE_SURFACE')
  end subroutine add_space_contact_keywords

  subroutine add_space_contact(table, name, help)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, help
    call add_keyword(table, name, help, id=.true., title_is_id=.true., required=1)
    call add_card(table)
    if (index(name, 'SINGLE_SURFACE') > 0) then
      call add_field(table, 'SURFA', 'I10 =0 >=0', 'part set or part; 0 = all parts')
      call add_field(table, 'SURFB', 'I10 fixed')
      call add_field(table, 'SURFATYP', 'I10 =2 >=0 <=5', '2 part set, 3 part, 5 all parts')
      call add_field(table, 'SURFBTYP', 'I10 fixed')
    else
      call add_field(table, 'SURFA', 'I10 =0 >=0', 'what SURFATYP says')
      call add_field(table, 'SURFB', 'I10 =0 >=0', 'what SURFBTYP says')
      call add_field(table, 'SURFATYP', 'I10 =0 >=0 <=7', &
          '0 segment set, 2 part set, 3 part, 4 node set, 5 all parts')
      call add_field(table, 'SURFBTYP', 'I10 =0 >=0 <=7', &
          '0 segment set, 2 part set, 3 part, 5 all parts')
    end if
    call add_field(table, 'SABOXID', 'I10 fixed', 'a box')
    call add_field(table, 'SBBOXID', 'I10 fixed', 'a box')
    call add_field(table, 'SAPR', 'I10 note', 'forces are in RCFORC anyway')
    call add_field(table, 'SBPR', 'I10 note', 'the same')
    call add_card(table)
    call add_field(table, 'FS', 'R10 =0.0 >=0', 'friction mu at rest')
    call add_field(table, 'FD', 'R10 =0.0 0=d >=0', 'friction at speed; DC = 0: no effect')
    call add_field(table, 'DC', 'R10 =0.0 0=d [T/L] >=0', &
        'mu = FD + (FS - FD) exp(-DC speed of slip); 0: mu = FS')
    call add_field(table, 'VC', 'R10 fixed', 'viscous friction')
    call add_field(table, 'VDC', 'R10 note', 'of penalty methods')
    call add_field(table, 'PENCHK', 'I10 note', 'overlap is watched always')
    call add_field(table, 'BT', 'R10 =0.0 [T]', 'contact is active from this time')
    call add_field(table, 'DT', 'R10 =1.0E20 0=d [T]', 'to this time')
    call add_card(table)
    call add_field(table, 'SFSA', 'R10 note =1.0 0=d', 'of penalty methods')
    call add_field(table, 'SFSB', 'R10 note =1.0 0=d', 'of penalty methods')
    call add_field(table, 'SAST', 'R10 fixed', 'thickness of shells')
    call add_field(table, 'SBST', 'R10 fixed', 'thickness of shells')
    call add_field(table, 'SFSAT', 'R10 note =1.0 0=d', 'thickness of shells')
    call add_field(table, 'SFSBT', 'R10 note =1.0 0=d', 'thickness of shells')
    call add_field(table, 'FSF', 'R10 fixed =1.0 0=d', 'factor of friction: FS has it')
    call add_field(table, 'VSF', 'R10 fixed =1.0 0=d', 'factor of viscous friction')
    call add_optional_cards(table)
  end subroutine add_space_contact

  !> Optional cards A to G: of penalty methods.
  subroutine add_optional_cards(table)
    type(table_t), intent(inout) :: table
    character(*), parameter :: names(7) = [character(71) :: &
        'SOFT   SOFSCL LCIDAB MAXPAR SBOPT  DEPTH  BSORT  FRCFRQ', &
        'PENMAX THKOPT SHLTHK SNLOG  ISYM   I2D3D  SLDTHK SLDSTF', &
        'IGAP   IGNORE DPRFAC DTSTIF EDGEK  -      FLANGL CID_RCF', &
        'Q2TRI  DTPCHK SFNBR  FNLSCL DNLSCL TCSO   TIEDID SHLEDG', &
        'SHAREC CPARM8 IPBACK SRNDE  FRICSF ICOR   FTORQ  REGION', &
        'PSTIFF IGNROFF -     FSTOL  2DBINR SSFTYP SWTPR  TETFAC', &
        '-      SHLOFF']
    integer :: k, first, last
    do k = 1, size(names)
      call add_card(table)
      first = 1
      do while (first <= len_trim(names(k)))
        last = first - 1 + index(names(k)(first:)//' ', ' ') - 1
        call add_optional(table, names(k)(first:last), achar(iachar('0') + k))
        first = last + verify(names(k)(last + 1:)//'x', ' ')
      end do
    end do
  end subroutine add_optional_cards

  subroutine add_optional(table, name, card)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, card
    select case (name)
    case ('-')
      call add_field(table, 'BLANK'//card, 'R10 fixed', 'not used')
    case ('SLDTHK')
      call add_field(table, name, 'R10 fixed', 'thickness of solids')
    case ('FRICSF')
      call add_field(table, name, 'R10 fixed =1.0 0=d', 'factor of friction: FS has it')
    case default
      call add_field(table, name, 'R10 note', 'of penalty methods')
    end select
  end subroutine add_optional

  !> Adds the requests for tables and their nodes and elements.
  subroutine add_output_keywords(table)
    type(table_t), intent(inout) :: table
    integer :: k, m
    do k = 1, table_count
      if (k == table_timing) cycle
      call add_keyword(table, trim(table_keywords(k)), 'table '// &
          trim(upper(table_names(k))), required=1, once=.true.)
      call add_card(table)
      call add_field(table, 'DT', 'R10 =0.0 [T] >=0', 'interval; 0 = off')
      call add_field(table, 'BINARY', 'I10 note =1 0=d', 'tables are text')
      call add_field(table, 'LCUR', 'I10 fixed', 'a curve of intervals')
      call add_field(table, 'IOOPT', 'I10 note =1 0=d', 'of a curve of intervals')
      do m = 1, 4
        call add_field(table, 'OPTION'//achar(48 + m), 'R10 note', 'columns are fixed')
      end do
      if (k == table_glstat) call add_alias(table, 'DATABASE_GLSTAT_MASS_PROPERTIES')
    end do
    call add_history(table, 'DATABASE_HISTORY_NODE', 'node', 'NODOUT')
    call add_history(table, 'DATABASE_HISTORY_NODE_SET', 'node set', 'NODOUT')
    call add_named_history(table, 'DATABASE_HISTORY_NODE_ID', 'node', 'NODOUT')
    call add_history(table, 'DATABASE_HISTORY_SHELL', 'element', 'ELOUT')
    call add_named_history(table, 'DATABASE_HISTORY_SHELL_ID', 'element', 'ELOUT')
    call add_history(table, 'DATABASE_HISTORY_SHELL_SET', 'element set', 'ELOUT')
    call add_history(table, 'DATABASE_HISTORY_SOLID', 'element', 'ELOUT')
    call add_named_history(table, 'DATABASE_HISTORY_SOLID_ID', 'element', 'ELOUT')
    call add_history(table, 'DATABASE_HISTORY_SOLID_SET', 'element set', 'ELOUT')
  end subroutine add_output_keywords

  subroutine add_history(table, name, what, which)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, what, which
    integer :: k
    call add_keyword(table, name, what//'s of '//which, repeat_from=1, required=1)
    call add_card(table)
    do k = 1, 8
      call add_field(table, 'ID'//achar(48 + k), 'I10 =0 >=0', what)
    end do
  end subroutine add_history

  subroutine add_named_history(table, name, what, which)
    type(table_t), intent(inout) :: table
    character(*), intent(in) :: name, what, which
    call add_keyword(table, name, what//'s of '//which//', one a card with a heading', &
        repeat_from=1, required=1)
    call add_card(table)
    call add_field(table, 'ID1', 'I10 req >0', what)
    call add_field(table, 'HEADING', 'T70', 'any text')
  end subroutine add_named_history

end module deck_keywords_contact
