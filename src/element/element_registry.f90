! SPDX-License-Identifier: BSD-3-Clause
!> Elements by their number of nodes in the plane. To add one: its file, its `use`, its case.
module element_registry
  use element_base, only: element_t
  use element_quad4, only: quad4_t
  use element_tri3, only: tri3_t
  implicit none
  private
  public :: make_element

contains

  !> An element type; not allocated when there is none with so many nodes.
  subroutine make_element(nodes, element)
    integer, intent(in) :: nodes
    class(element_t), allocatable, intent(out) :: element
    select case (nodes)
    case (3)
      allocate (element, source=tri3_t(name='TRI3', nodes=3))
    case (4)
      allocate (element, source=quad4_t(name='QUAD4', nodes=4))
    end select
  end subroutine make_element

end module element_registry
