! SPDX-License-Identifier: BSD-3-Clause
!> The elements by name. To add one: its file, and here its `use` and its line in find_element.
module element_registry
  use element_base, only: element_t
  use element_hex27, only: new_hex27
  use element_hex8, only: new_hex8
  use element_hex8_mean, only: new_hex8_mean
  use element_hex8_modes, only: new_hex8_modes
  use element_pyramid5, only: new_pyramid5
  use element_quad4, only: new_quad4
  use element_ring, only: new_quad4_ring, new_tri3_ring
  use element_tet10, only: new_tet10
  use element_tet4, only: new_tet4
  use element_tri3, only: new_tri3
  use element_wedge6, only: new_wedge6
  implicit none
  private
  public :: make_element, element_names

contains

  !> The element of a name; not allocated when there is none.
  subroutine make_element(name, element)
    character(*), intent(in) :: name
    class(element_t), allocatable, intent(out) :: element
    character(8), allocatable :: names(:)
    call find_element(name, names, element)
  end subroutine make_element

  !> The names of all elements.
  subroutine element_names(names)
    character(8), allocatable, intent(out) :: names(:)
    class(element_t), allocatable :: none
    call find_element('', names, none)
  end subroutine element_names

  !> Names all elements and makes the wanted one.
  subroutine find_element(wanted, names, element)
    character(*), intent(in) :: wanted
    character(8), allocatable, intent(out) :: names(:)
    class(element_t), allocatable, intent(out) :: element
    allocate (names(0))
    call offer(new_quad4())
    call offer(new_tri3())
    call offer(new_quad4_ring())
    call offer(new_tri3_ring())
    call offer(new_hex8())
    call offer(new_hex8_mean())
    call offer(new_hex8_modes())
    call offer(new_wedge6())
    call offer(new_pyramid5())
    call offer(new_tet4())
    call offer(new_tet10())
    call offer(new_hex27())
  contains
    subroutine offer(one)
      class(element_t), intent(in) :: one
      names = [character(8) :: names, one%name]
      if (one%name == wanted) allocate (element, source=one)
    end subroutine offer
  end subroutine find_element

end module element_registry
