! SPDX-License-Identifier: BSD-3-Clause
!> Bodies: elements that share nodes belong together.
module model_bodies
  use model_mesh, only: mesh_t
  implicit none
  private
  public :: find_bodies

contains

  !> body (nodes): the first node of the body of every node.
  subroutine find_bodies(mesh, nodes, body)
    type(mesh_t), intent(in) :: mesh
    integer, intent(in) :: nodes
    integer, allocatable, intent(out) :: body(:)
    integer :: e, k, a, b
    allocate (body(nodes))
    body = [(k, k=1, nodes)]
    do e = 1, mesh%n
      do k = 2, mesh%count_of(e)
        a = root_of(body, mesh%node_of(1, e))
        b = root_of(body, mesh%node_of(k, e))
        body(max(a, b)) = min(a, b)
      end do
    end do
    do k = 1, nodes
      body(k) = root_of(body, k)
    end do
  end subroutine find_bodies

  pure integer function root_of(root, node)
    integer, intent(in) :: root(:), node
    root_of = node
    do while (root(root_of) /= root_of)
      root_of = root(root_of)
    end do
  end function root_of

end module model_bodies
