! SPDX-License-Identifier: BSD-3-Clause
!> Faces of elements, in the plane edges: those that no second element has are the surface of
!> the bodies. Faces are found again by their smallest node, under which they are chained.
module model_faces
  use base_list, only: append
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

  !> Facets from(k) to to(k) of a list are what nodes node(:, k) mean, chained by the smallest.
  type :: choice_t
    integer, allocatable :: node(:, :), from(:), to(:), first(:), next(:)
  end type choice_t

  public :: find_faces, face_at, find_hanging, exterior_facets, find_segments

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

  !> The first exterior face whose corners are all among those of another one that is not the
  !> same: a triangle on half a quadrilateral, a linear face on a curved one. The elements of
  !> both, the first that with fewer nodes; 0 = none.
  subroutine find_hanging(mesh, nodes, faces, element)
    type(mesh_t), intent(in) :: mesh
    integer, intent(in) :: nodes
    type(faces_t), intent(in) :: faces
    integer, intent(out) :: element(2)
    integer, allocatable :: first(:), next(:, :)
    integer, dimension(most_face_nodes) :: node, other
    integer :: k, m, q, i
    ! The faces at each node: 4 q + m is corner m + 1 of face q.
    allocate (first(nodes), next(0:3, faces%n))
    first = 0
    do k = 1, faces%n
      if (faces%count(k) > 1) cycle
      call mesh%get_face(faces%local(k), faces%owner(k), node, m)
      do i = 0, corners_among(m) - 1
        next(i, k) = first(node(i + 1))
        first(node(i + 1)) = 4*k + i
      end do
    end do
    do k = 1, faces%n
      if (faces%count(k) > 1) cycle
      call mesh%get_face(faces%local(k), faces%owner(k), node, m)
      q = first(node(1))
      do while (q > 0)
        element = [faces%owner(k), faces%owner(q/4)]
        call mesh%get_face(faces%local(q/4), faces%owner(q/4), other, i)
        if (q/4 /= k .and. i >= m .and. are_among(node(:corners_among(m)), &
            other(:corners_among(i)))) return
        q = next(mod(q, 4), q/4)
      end do
    end do
    element = 0
  end subroutine find_hanging

  !> Corners of a face of m nodes: the first of its nodes.
  pure integer function corners_among(m)
    integer, intent(in) :: m
    corners_among = m
    if (m == 6) corners_among = 3
    if (m == 9) corners_among = 4
  end function corners_among

  pure logical function are_among(a, b)
    integer, intent(in) :: a(:), b(:)
    integer :: k
    are_among = all([(any(b == a(k)), k=1, size(a))])
  end function are_among

  !> The faces that one element has alone, in the order of the elements, curved ones by their
  !> linear pieces: node (corners, n), outward, the last 0 where one has fewer, their elements
  !> and which pieces of their surfaces they are.
  subroutine exterior_facets(mesh, nodes, corners, node, owner, facet)
    type(mesh_t), intent(in) :: mesh
    integer, intent(in) :: nodes, corners
    integer, allocatable, intent(out) :: node(:, :), owner(:), facet(:)
    type(faces_t) :: faces
    integer :: k, f, m, n, pieces
    call find_faces(mesh, nodes, faces)
    n = 0
    do k = 1, faces%n
      if (faces%count(k) == 1) n = n + pieces_of(mesh, faces, k)
    end do
    allocate (node(corners, n), owner(n), facet(n))
    node = 0
    n = 0
    do k = 1, faces%n
      if (faces%count(k) > 1) cycle
      pieces = pieces_of(mesh, faces, k)
      do f = pieces*(faces%local(k) - 1) + 1, pieces*faces%local(k)
        n = n + 1
        owner(n) = faces%owner(k)
        facet(n) = f
        call mesh%get_facet(f, owner(n), node(:, n), m)
      end do
    end do
  end subroutine exterior_facets

  pure integer function pieces_of(mesh, faces, k)
    type(mesh_t), intent(in) :: mesh
    type(faces_t), intent(in) :: faces
    integer, intent(in) :: k
    pieces_of = mesh%kind(mesh%type(faces%owner(k)))%item%facets_a_face()
  end function pieces_of

  !> The exterior facets that segments (corners, n) are, the last node 0 where one has fewer:
  !> a segment has the nodes of a facet, or the corners of a curved face and stands for all its
  !> facets. For each of them its nodes, as its element has them, the segment, the element, and
  !> the number of the facet there. Of segments that are none there is nothing.
  subroutine find_segments(mesh, nodes, segment, node, from, owner, facet)
    type(mesh_t), intent(in) :: mesh
    integer, intent(in) :: nodes, segment(:, :)
    integer, allocatable, intent(out) :: node(:, :), from(:), owner(:), facet(:)
    integer, allocatable :: all_node(:, :), all_owner(:), all_facet(:), found(:)
    type(choice_t) :: choice
    integer :: s, k, f, n, m
    call exterior_facets(mesh, nodes, size(segment, 1), all_node, all_owner, all_facet)
    call make_choice(mesh, nodes, all_node, all_owner, all_facet, choice)
    allocate (found(0), from(0))
    n = 0
    m = 0
    do s = 1, size(segment, 2)
      k = choice%first(minval(segment(:, s), mask=segment(:, s) > 0))
      do while (k > 0)
        if (are_same(pack(choice%node(:, k), choice%node(:, k) > 0), &
            pack(segment(:, s), segment(:, s) > 0))) then
          do f = choice%from(k), choice%to(k)
            call append([f], found, n)
            call append([s], from, m)
          end do
          exit
        end if
        k = choice%next(k)
      end do
    end do
    from = from(:m)
    node = all_node(:, found(:n))
    owner = all_owner(found(:n))
    facet = all_facet(found(:n))
  end subroutine find_segments

  !> What a segment may be: each facet, and before those of a curved face the whole of it.
  subroutine make_choice(mesh, nodes, node, owner, facet, choice)
    type(mesh_t), intent(in) :: mesh
    integer, intent(in) :: nodes, node(:, :), owner(:), facet(:)
    type(choice_t), intent(out) :: choice
    integer :: k, n, m, pieces, whole(most_face_nodes)
    allocate (choice%node(size(node, 1), 2*size(owner)), choice%from(2*size(owner)), &
        choice%to(2*size(owner)), choice%next(2*size(owner)), choice%first(nodes))
    choice%first = 0
    choice%node = 0
    n = 0
    do k = 1, size(owner)
      pieces = mesh%kind(mesh%type(owner(k)))%item%facets_a_face()
      if (pieces > 1 .and. mod(facet(k) - 1, pieces) == 0) then
        call mesh%get_face(mesh%face_of_facet(facet(k), owner(k)), owner(k), whole, m)
        call offer(whole(:corners_among(m)), k, k + pieces - 1)
      end if
      call offer(pack(node(:, k), node(:, k) > 0), k, k)
    end do
  contains
    subroutine offer(these, from, to)
      integer, intent(in) :: these(:), from, to
      n = n + 1
      choice%node(:size(these), n) = these
      choice%from(n) = from
      choice%to(n) = to
      choice%next(n) = choice%first(minval(these))
      choice%first(minval(these)) = n
    end subroutine offer
  end subroutine make_choice
end module model_faces
