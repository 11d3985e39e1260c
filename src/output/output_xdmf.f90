! SPDX-License-Identifier: BSD-3-Clause
!> A small XDMF file that shows the frames of all field files as one series in time, for readers
!> that know no VTKHDF. It holds no numbers but the times: the rest is in the HDF5 files.
module output_xdmf
  use base_files, only: move_file
  use base_kinds, only: wp
  use base_status, only: status_t, fail, failed, status_file
  use base_strings, only: join_path, to_text
  use output_fields, only: fields_t
  use output_storage, only: mesh_t, field_t
  implicit none
  private
  public :: write_xdmf, segment_name

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

  !> Writes fields.xdmf of a folder anew; single: 32-bit numbers.
  subroutine write_xdmf(folder, mesh, fields, single, status)
    character(*), intent(in) :: folder
    type(mesh_t), intent(in) :: mesh
    type(fields_t), intent(in) :: fields
    logical, intent(in) :: single
    type(status_t), intent(inout) :: status
    character(:), allocatable :: path
    character(200) :: reason
    integer :: unit, ios, k, first
    path = join_path(folder, 'fields.xdmf')
    open (newunit=unit, file=path//'.tmp', status='replace', action='write', iostat=ios, &
        iomsg=reason)
    if (ios == 0) write (unit, '(a)', iostat=ios, iomsg=reason) '<?xml version="1.0"?>', &
        '<Xdmf Version="3.0"><Domain>', &
        '<Grid Name="fields" GridType="Collection" CollectionType="Temporal">'
    first = 1
    do k = 1, fields%frames
      if (ios /= 0) exit
      if (k > 1) then
        if (fields%segment_of(k) /= fields%segment_of(k - 1)) first = k
      end if
      call write_frame(unit, mesh, fields, k, k - first, single, ios, reason)
    end do
    if (ios == 0) write (unit, '(a)', iostat=ios, iomsg=reason) '</Grid></Domain></Xdmf>'
    if (ios == 0) close (unit, iostat=ios, iomsg=reason)
    if (ios /= 0) call fail(status, status_file, 'cannot write "'//path//'": '//trim(reason))
    if (.not. failed(status)) call move_file(path//'.tmp', path, status)
  end subroutine write_xdmf

  !> One frame: mesh, time, and of each field the part that belongs to it; `at` counts the frames
  !> of its file from 0.
  subroutine write_frame(unit, mesh, fields, k, at, single, ios, reason)
    integer, intent(in) :: unit, k, at
    type(mesh_t), intent(in) :: mesh
    type(fields_t), intent(in) :: fields
    logical, intent(in) :: single
    integer, intent(inout) :: ios
    character(*), intent(inout) :: reason
    character(:), allocatable :: file
    integer :: f
    file = segment_name(fields%segment_of(k))//':/VTKHDF/'
    write (unit, '(a)', iostat=ios, iomsg=reason) '<Grid Name="'//to_text(k)//'"><Time Value="' &
        //to_text(fields%time(k))//'"/>'//topology(mesh, file)// &
        '<Geometry GeometryType="XYZ"><DataItem Dimensions="'//to_text(size(mesh%points, 2))// &
        ' 3" NumberType="Float" Precision="8" Format="HDF">'//file//'Points</DataItem></Geometry>'
    do f = 1, size(fields%field)
      if (ios /= 0) return
      write (unit, '(a)', iostat=ios, iomsg=reason) attribute(fields%field(f), file, at, single)
    end do
    if (ios == 0) write (unit, '(a)', iostat=ios, iomsg=reason) '</Grid>'
  end subroutine write_frame

  !> Cells of one kind, or mixed: then the kinds stand in the text, for VTKHDF keeps them apart.
  function topology(mesh, file) result(text)
    type(mesh_t), intent(in) :: mesh
    character(*), intent(in) :: file
    character(:), allocatable :: text
    integer :: n, k
    n = size(mesh%kind)
    if (all(mesh%kind == 9) .or. all(mesh%kind == 5)) then
      text = '<Topology TopologyType="'//trim(merge('Quadrilateral', 'Triangle     ', &
          all(mesh%kind == 9)))//'" NumberOfElements="'//to_text(n)//'"><DataItem Dimensions="'// &
          to_text(n)//' '//to_text(merge(4, 3, all(mesh%kind == 9)))// &
          '" NumberType="Int" Precision="8" Format="HDF">'//file// &
          'Connectivity</DataItem></Topology>'
      return
    end if
    text = '<Topology TopologyType="Mixed" NumberOfElements="'//to_text(n)// &
        '"><DataItem Dimensions="'//to_text(n + size(mesh%connectivity))// &
        '" NumberType="Int" Format="XML">'
    do k = 1, n
      text = text//cell(mesh, k)
    end do
    text = text//'</DataItem></Topology>'
  end function topology

  !> Kind of a cell in XDMF (4 triangle, 5 quadrilateral) and its nodes.
  function cell(mesh, k) result(text)
    type(mesh_t), intent(in) :: mesh
    integer, intent(in) :: k
    character(:), allocatable :: text
    integer :: m
    text = ' '//trim(merge('5', '4', mesh%kind(k) == 9))
    do m = mesh%offsets(k) + 1, mesh%offsets(k + 1)
      text = text//' '//to_text(mesh%connectivity(m))
    end do
  end function cell

  function attribute(field, file, at, single) result(text)
    type(field_t), intent(in) :: field
    character(*), intent(in) :: file
    integer, intent(in) :: at
    logical, intent(in) :: single
    character(:), allocatable :: text
    character(:), allocatable :: shape_text, centre, numbers, place
    integer :: n, c, first
    c = size(field%values, 1)
    n = size(field%values, 2)
    first = at*n
    if (field%constant) first = 0
    centre = trim(merge('Node', 'Cell', field%at_nodes))
    place = trim(merge('Point', 'Cell ', field%at_nodes))
    numbers = 'NumberType="Float" Precision="'//merge('4', '8', single)//'"'
    if (field%whole) numbers = 'NumberType="Int" Precision="8"'
    shape_text = to_text(n)
    if (c > 1) shape_text = shape_text//' '//to_text(c)
    text = '<Attribute Name="'//trim(field%name)//'" AttributeType="'//kind_of(c)//'" Center="'// &
        centre//'"><DataItem ItemType="HyperSlab" Dimensions="'//shape_text//'"><DataItem '// &
        'Dimensions="3 '//merge('2', '1', c > 1)//'" Format="XML">'
    if (c > 1) text = text//to_text(first)//' 0 1 1 '//shape_text
    if (c == 1) text = text//to_text(first)//' 1 '//shape_text
    text = text//'</DataItem><DataItem Dimensions="'//to_text(first + n)
    if (c > 1) text = text//' '//to_text(c)
    text = text//'" '//numbers//' Format="HDF">'//file//place//'Data/'//trim(field%name)// &
        '</DataItem></DataItem></Attribute>'
  end function attribute

  pure function kind_of(components) result(text)
    integer, intent(in) :: components
    character(:), allocatable :: text
    select case (components)
    case (1)
      text = 'Scalar'
    case (3)
      text = 'Vector'
    case default
      text = 'Tensor6'
    end select
  end function kind_of

end module output_xdmf
