! SPDX-License-Identifier: BSD-3-Clause
!> A small XDMF file that shows the frames of all field files as one series in time, for
!> readers that know no VTKHDF. It holds no numbers but the times: the rest is in the HDF5
!> files.
module output_xdmf
  use base_files, only: can_reserve, cut_file, disk_full, file_size, move_file, &
      remove_file
  use base_format, only: real_writer_t, make_real_writer, put_real, put_integer, real_width
  use base_kinds, only: wp, i8
  use base_status, only: status_t, fail, failed, status_file
  use base_strings, only: join_path, to_text
  use output_fields, only: fields_t
  use output_storage, only: mesh_t, field_t, tensor_components, xdmf_group
  implicit none
  private
  public :: write_xdmf, reserve_xdmf, drop_xdmf, segment_name

  integer, parameter :: text_size = 65536

  !> Around the two numbers of a field that change from frame to frame.
  type :: template_t
    character(:), allocatable :: head, middle, tail
  end type template_t

  !> Text that is gathered and written many lines at a time.
  type :: text_t
    integer :: unit = -1, ios = 0, filled = 0
    logical :: is_open = .false.
    integer(i8) :: written = 0_i8
    character(200) :: reason = 'is the disk full?'
    character(:), allocatable :: buffer, mesh
    type(template_t), allocatable :: template(:)
    type(real_writer_t) :: writer
  end type text_t

  !> Cells by their number in VTK, their name and number in XDMF.
  integer, parameter :: cell_vtk(8) = [5, 9, 10, 14, 13, 12, 24, 29]
  character(14), parameter :: cell_name(8) = [character(14) :: 'Triangle', 'Quadrilateral', &
      'Tetrahedron', 'Pyramid', 'Wedge', 'Hexahedron', 'Tetrahedron_10', 'Hexahedron_27']
  integer, parameter :: cell_number(8) = [4, 5, 6, 7, 8, 9, 38, 50]

contains

  !> Name of a field file by its number.
  pure function segment_name(number) result(name)
    integer, intent(in) :: number
    character(:), allocatable :: name
    character(3) :: digits
    write (digits, '(i3.3)') mod(number, 1000)
    name = 'fields.'//digits//'.vtkhdf'
    if (number > 999) name = 'fields.'//to_text(number)//'.vtkhdf'
  end function segment_name

  !> Takes room for the fields.xdmf of so many frames, so that a disk that fills up does not
  !> leave frames without it; fails where there is none. write_xdmf uses it up.
  subroutine reserve_xdmf(folder, mesh, fields, frames, status)
    character(*), intent(in) :: folder
    type(mesh_t), intent(in) :: mesh
    type(fields_t), intent(in) :: fields
    integer, intent(in) :: frames
    type(status_t), intent(inout) :: status
    integer(i8), parameter :: around = 512_i8, numbers = 64_i8
    type(text_t) :: text
    integer(i8) :: bytes
    integer :: f
    call make_templates(mesh, fields, fields%segment, .true., text)
    bytes = len(text%mesh) + numbers
    do f = 1, size(fields%field)
      associate (t => text%template(f))
        bytes = bytes + len(t%head) + len(t%middle) + len(t%tail) + numbers
      end associate
    end do
    if (.not. can_reserve(new_path(folder), around + frames*bytes)) call fail(status, &
        status_file, 'cannot write "'//join_path(folder, 'fields.xdmf')//'": '//disk_full)
  end subroutine reserve_xdmf

  !> Gives that room back.
  subroutine drop_xdmf(folder)
    character(*), intent(in) :: folder
    call remove_file(new_path(folder))
  end subroutine drop_xdmf

  !> Where fields.xdmf is written before it takes the place of the one that is there.
  pure function new_path(folder) result(path)
    character(*), intent(in) :: folder
    character(:), allocatable :: path
    path = join_path(folder, 'fields.xdmf.tmp')
  end function new_path

  !> Writes fields.xdmf of a folder anew; single: 32-bit numbers.
  subroutine write_xdmf(folder, mesh, fields, single, status)
    character(*), intent(in) :: folder
    type(mesh_t), intent(in) :: mesh
    type(fields_t), intent(in) :: fields
    logical, intent(in) :: single
    type(status_t), intent(inout) :: status
    character(:), allocatable :: path, new
    type(text_t) :: text
    integer :: k, f, first
    path = join_path(folder, 'fields.xdmf')
    new = new_path(folder)
    call open_text(new, text)
    call add(text, '<?xml version="1.0"?><Xdmf Version="3.0"><Domain>'//new_line('a')// &
        '<Grid Name="fields" GridType="Collection" CollectionType="Temporal">'//new_line('a'))
    call make_real_writer(text%writer)
    do k = 1, fields%frames
      if (k == 1) first = 1
      if (k > 1) then
        if (fields%segment_of(k) /= fields%segment_of(k - 1)) first = k
      end if
      if (k == first) call make_templates(mesh, fields, fields%segment_of(k), single, text)
      call add(text, '<Grid Name="frame"><Time Value="')
      call add_real(text, fields%time(k))
      call add(text, text%mesh)
      do f = 1, size(fields%field)
        call add_attribute(text, fields%field(f), text%template(f), k - first)
      end do
      call add(text, '</Grid>'//new_line('a'))
    end do
    call add(text, '</Grid></Domain></Xdmf>'//new_line('a'))
    call close_text(text)
    if (text%ios == 0) then
      if (file_size(new) < text%written) text%ios = 1
    end if
    if (text%ios == 0) then
      call cut_file(new, text%written, status)
      call move_file(new, path, status)
    else
      call fail(status, status_file, 'cannot write "'//path//'": '//trim(text%reason))
      call remove_file(new)
    end if
  end subroutine write_xdmf

  !> What stays the same for all frames of a file.
  subroutine make_templates(mesh, fields, segment, single, text)
    type(mesh_t), intent(in) :: mesh
    type(fields_t), intent(in) :: fields
    integer, intent(in) :: segment
    logical, intent(in) :: single
    type(text_t), intent(inout) :: text
    character(:), allocatable :: file, shape_text, numbers, place, columns
    integer :: f, c
    file = segment_name(segment)//':/VTKHDF/'
    text%mesh = '"/>'//topology(mesh, file)//'<Geometry GeometryType="XYZ"><DataItem '// &
        'Dimensions="'//to_text(size(mesh%points, 2))//' 3" NumberType="Float" '// &
        'Precision="8" Format="HDF">'//file//'Points</DataItem></Geometry>'//new_line('a')
    if (allocated(text%template)) deallocate (text%template)
    allocate (text%template(size(fields%field)))
    do f = 1, size(fields%field)
      associate (field => fields%field(f), t => text%template(f))
        c = size(field%values, 1)
        columns = ''
        if (c > 1) columns = ' '//to_text(c)
        place = file//trim(merge('Point', 'Cell ', field%at_nodes))//'Data'
        if (c == tensor_components) place = segment_name(segment)//':'//xdmf_group
        numbers = 'NumberType="Float" Precision="'//merge('4', '8', single)//'"'
        if (field%whole) numbers = 'NumberType="Int" Precision="8"'
        shape_text = to_text(size(field%values, 2))//columns
        t%head = '<Attribute Name="'//trim(field%name)//'" AttributeType="'//kind_of(c)// &
            '" Center="'//trim(merge('Node', 'Cell', field%at_nodes))//'"><DataItem '// &
            'ItemType="HyperSlab" Dimensions="'//shape_text//'"><DataItem Dimensions="3 '// &
            merge('2', '1', c > 1)//'" Format="XML">'
        t%middle = trim(merge(' 0 1 1 ', ' 1     ', c > 1))//' '//shape_text// &
            '</DataItem><DataItem Dimensions="'
        t%tail = columns//'" '//numbers//' Format="HDF">'//place//'/'//trim(field%name)// &
            '</DataItem></DataItem></Attribute>'//new_line('a')
      end associate
    end do
  end subroutine make_templates

  !> The part of a field that belongs to a frame; `at` counts the frames of its file from 0.
  subroutine add_attribute(text, field, template, at)
    type(text_t), intent(inout) :: text
    type(field_t), intent(in) :: field
    type(template_t), intent(in) :: template
    integer, intent(in) :: at
    integer(i8) :: first
    first = 0_i8
    if (.not. field%constant) first = int(at, i8)*size(field%values, 2)
    call add(text, template%head)
    call add_integer(text, first)
    call add(text, template%middle)
    call add_integer(text, first + size(field%values, 2))
    call add(text, template%tail)
  end subroutine add_attribute

  subroutine open_text(path, text)
    character(*), intent(in) :: path
    type(text_t), intent(inout) :: text
    allocate (character(text_size) :: text%buffer)
    ! Over what is there: that is the room that reserve_xdmf has taken.
    open (newunit=text%unit, file=path, status='unknown', action='write', access='stream', &
        form='unformatted', iostat=text%ios, iomsg=text%reason)
    text%is_open = text%ios == 0
  end subroutine open_text

  subroutine add(text, part)
    type(text_t), intent(inout) :: text
    character(*), intent(in) :: part
    if (text%filled + len(part) > text_size) call put(text)
    if (len(part) > text_size) then
      if (text%ios == 0) write (text%unit, iostat=text%ios, iomsg=text%reason) part
      text%written = text%written + len(part)
      return
    end if
    text%buffer(text%filled + 1:text%filled + len(part)) = part
    text%filled = text%filled + len(part)
  end subroutine add

  subroutine add_integer(text, number)
    type(text_t), intent(inout) :: text
    integer(i8), intent(in) :: number
    character(12) :: digits
    if (number > huge(1)) then
      call add(text, to_text(number))
    else
      call put_integer(int(number), digits)
      call add(text, digits(verify(digits, ' '):))
    end if
  end subroutine add_integer

  subroutine add_real(text, number)
    type(text_t), intent(inout) :: text
    real(wp), intent(in) :: number
    character(real_width) :: digits
    call put_real(text%writer, number, digits)
    call add(text, digits(verify(digits, ' '):))
  end subroutine add_real

  subroutine put(text)
    type(text_t), intent(inout) :: text
    if (text%ios == 0) &
        write (text%unit, iostat=text%ios, iomsg=text%reason) text%buffer(:text%filled)
    text%written = text%written + text%filled
    text%filled = 0
  end subroutine put

  subroutine close_text(text)
    type(text_t), intent(inout) :: text
    integer :: ignored
    call put(text)
    if (text%ios == 0) then
      close (text%unit, iostat=text%ios, iomsg=text%reason)
    else if (text%is_open) then
      close (text%unit, iostat=ignored)
    end if
  end subroutine close_text

  !> Cells of one kind, or mixed: then kinds by their numbers in XDMF and nodes stand in the
  !> text, for VTKHDF keeps them apart.
  function topology(mesh, file) result(text)
    type(mesh_t), intent(in) :: mesh
    character(*), intent(in) :: file
    character(:), allocatable :: text, list
    integer :: n, k, m, at
    n = size(mesh%kind)
    k = 0
    if (n > 0) k = cell_row(mesh%kind(1))
    if (k > 0) then
      if (all(mesh%kind == mesh%kind(1))) then
        text = '<Topology TopologyType="'//trim(cell_name(k))//'" NumberOfElements="'// &
            to_text(n)//'"><DataItem Dimensions="'//to_text(n)//' '// &
            to_text(mesh%offsets(2) - mesh%offsets(1))// &
            '" NumberType="Int" Precision="8" Format="HDF">'//file// &
            'Connectivity</DataItem></Topology>'
        return
      end if
    end if
    text = '<Topology TopologyType="Mixed" NumberOfElements="'//to_text(n)// &
        '"><DataItem Dimensions="'//to_text(n + size(mesh%connectivity))// &
        '" NumberType="Int" Format="XML">'
    allocate (character(12*(n + size(mesh%connectivity))) :: list)
    at = 0
    do k = 1, n
      call put_integer(cell_number(cell_row(mesh%kind(k))), list(at + 1:at + 12))
      at = at + 12
      do m = mesh%offsets(k) + 1, mesh%offsets(k + 1)
        call put_integer(mesh%connectivity(m), list(at + 1:at + 12))
        at = at + 12
      end do
    end do
    text = text//list//'</DataItem></Topology>'
  end function topology

  !> Row of a cell of VTK in the lists of XDMF's names and numbers.
  pure integer function cell_row(kind)
    integer, intent(in) :: kind
    do cell_row = size(cell_vtk), 1, -1
      if (cell_vtk(cell_row) == kind) return
    end do
  end function cell_row

  pure function kind_of(components) result(text)
    integer, intent(in) :: components
    character(:), allocatable :: text
    select case (components)
    case (1)
      text = 'Scalar'
    case (3)
      text = 'Vector'
    case (tensor_components)
      text = 'Tensor6'
    case default
      text = 'Matrix'
    end select
  end function kind_of

end module output_xdmf
