! SPDX-License-Identifier: BSD-3-Clause
!> Faces of elements, in the plane edges: those that no second element has are the surface of
!> the bodies. Faces are found again by their smallest node, under which they are chained.
module model_faces
  use element_base, only: most_face_nodes
  use model_mesh, only: mesh_t
  implicit none
  private

  type, public :: faces_t
    integer :: n = 0
    integer, allocatable :: owner(:)   !< (n) element
    integer, allocatable :: local(:)   !< (n) its face
    integer, allocatable :: count(:)   !< (n) elements that have this face
    integer, allocatable :: first(:)   !< (nodes) the first face whose smallest node it is
    integer, allocatable :: next(:)    !< (n) the next one; 0 = none
  end type faces_t

  public :: find_faces, face_at, find_hanging, exterior_faces, orient_segments

contains

  !> The faces of all elements, each once, with the element that has it first.
  subroutine find_faces(mesh, nodes, faces)
    type(mesh_t), intent(in) :: mesh
    integer, intent(in) :: nodes
    type(faces_t), intent(out) :: faces
    integer :: e, f, k, m, node(most_face_nodes)
    m = 0
    do e = 1, mesh%n
      m = m + mesh%faces_of(e)
    end do
    allocate (faces%owner(m), faces%local(m), faces%count(m), faces%next(m), &
        faces%first(nodes))
    faces%first = 0
    do e = 1, mesh%n
      do f = 1, mesh%faces_of(e)
        call mesh%get_face(f, e, node, m)
        k = face_at(mesh, faces, node(:m))
        if (k > 0) then
          faces%count(k) = faces%count(k) + 1
          cycle
        end if
        faces%n = faces%n + 1
        k = faces%n
        faces%owner(k) = e
        faces%local(k) = f
        faces%count(k) = 1
        faces%next(k) = faces%first(minval(node(:m)))
        faces%first(minval(node(:m))) = k
      end do
    end do
  end subroutine find_faces

  !> Have two faces the same nodes?
  pure logical function are_same(a, b)
    integer, intent(in) :: a(:), b(:)
    integer :: k
    are_same = size(a) == size(b)
    do k = 1, size(a)
      are_same = are_same .and. any(b == a(k))
    end do
  end function are_same

  !> The face with these nodes, in any order; 0 = none.
  pure integer function face_at(mesh, faces, node)
    type(mesh_t), intent(in) :: mesh
    type(faces_t), intent(in) :: faces
    integer, intent(in) :: node(:)
    integer :: m, other(most_face_nodes)
    face_at = faces%first(minval(node))
    do while (face_at > 0)
      call mesh%get_face(faces%local(face_at), faces%owner(face_at), other, m)
      if (are_same(other(:m), node)) return
      face_at = faces%next(face_at)
    end do
  end function face_at

  !> The first exterior triangle that lies on half an exterior quadrilateral, which hangs
  !> there: the elements of both; 0 = none.
  subroutine find_hanging(mesh, nodes, faces, element)
    type(mesh_t), intent(in) :: mesh
    integer, intent(in) :: nodes
    type(faces_t), intent(in) :: faces
    integer, intent(out) :: element(2)
    integer, allocatable :: first(:), next(:, :)
    integer, dimension(most_face_nodes) :: node, other
    integer :: k, m, q, i
    element = 0
    ! The quadrilaterals at each node: 4 q + m is corner m + 1 of face q.
    allocate (first(nodes), next(0:3, faces%n))
    first = 0
    do k = 1, faces%n
      call mesh%get_face(faces%local(k), faces%owner(k), node, m)
      if (m /= 4 .or. faces%count(k) > 1) cycle
      do i = 0, 3
        next(i, k) = first(node(i + 1))
        first(node(i + 1)) = 4*k + i
      end do
    end do
    do k = 1, faces%n
      call mesh%get_face(faces%local(k), faces%owner(k), node, m)
      if (m /= 3 .or. faces%count(k) > 1) cycle
      q = first(node(1))
      do while (q > 0)
        call mesh%get_face(faces%local(q/4), faces%owner(q/4), other, m)
        element = [faces%owner(k), faces%owner(q/4)]
        if (any(other(:4) == node(2)) .and. any(other(:4) == node(3))) return
        q = next(mod(q, 4), q/4)
      end do
    end do
    element = 0
  end subroutine find_hanging

  !> The faces that one element has alone, in the order of the elements: node (corners, n),
  !> outward, the last 0 where a face has fewer, and their elements.
  subroutine exterior_faces(mesh, nodes, corners, node, owner)
    type(mesh_t), intent(in) :: mesh
    integer, intent(in) :: nodes, corners
    integer, allocatable, intent(out) :: node(:, :), owner(:)
    type(faces_t) :: faces
    integer :: k, m, n
    call find_faces(mesh, nodes, faces)
    n = count(faces%count(:faces%n) == 1)
    allocate (node(corners, n), owner(n))
    node = 0
    n = 0
    do k = 1, faces%n
      if (faces%count(k) > 1) cycle
      n = n + 1
      owner(n) = faces%owner(k)
      call mesh%get_face(faces%local(k), faces%owner(k), node(:, n), m)
    end do
  end subroutine exterior_faces

  !> Segments (corners, n), the last node 0 where one has fewer, in the order of the faces that
  !> they are, outward; owner: their elements, 0 where a segment is no exterior face.
  subroutine orient_segments(mesh, nodes, segment, owner)
    type(mesh_t), intent(in) :: mesh
    integer, intent(in) :: nodes
    integer, intent(inout) :: segment(:, :)
    integer, intent(out) :: owner(:)
    type(faces_t) :: faces
    integer :: s, k, m
    call find_faces(mesh, nodes, faces)
    owner = 0
    do s = 1, size(segment, 2)
      m = count(segment(:, s) > 0)
      k = face_at(mesh, faces, segment(:m, s))
      if (k == 0) cycle
      if (faces%count(k) > 1) cycle
      owner(s) = faces%owner(k)
      call mesh%get_face(faces%local(k), owner(s), segment(:, s), m)
    end do
  end subroutine orient_segments

end module model_faces
