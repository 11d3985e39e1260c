! SPDX-License-Identifier: BSD-3-Clause
!> The elements of a scene: of which type and part each is, and its nodes. Neighbours in the
!> list that share both are a block, which is worked through without a question.
module model_mesh
  use element_base, only: element_slot_t
  use element_registry, only: make_element
  implicit none
  private

  !> Elements first..last of one type and part.
  type, public :: block_t
    integer :: first = 0, last = 0
    integer :: type = 0, part = 0
  end type block_t

  type, public :: mesh_t
    integer :: n = 0                      !< elements
    integer, allocatable :: id(:)
    integer, allocatable :: part(:)       !< rows of parts
    integer, allocatable :: record(:)     !< their cards, for messages
    integer, allocatable :: type(:)       !< rows of kind
    integer, allocatable :: first(:)      !< (n+1) start of each one's nodes
    integer, allocatable :: node(:)       !< rows of nodes, element by element
    type(element_slot_t), allocatable :: kind(:)   !< the element types in use
    type(block_t), allocatable :: block(:)
  contains
    procedure :: start
    procedure :: add
    procedure :: make_blocks
    procedure :: count_of
    procedure :: node_of
    procedure :: nodes_of
    procedure :: faces_of
    procedure :: facets_of
    procedure :: facet_of
    procedure :: get_face
    procedure :: get_facet
    procedure :: face_of_facet
    procedure :: is_of_type
  end type mesh_t

contains

  !> Room for n elements with at most `most` nodes in all.
  subroutine start(this, n, most)
    class(mesh_t), intent(inout) :: this
    integer, intent(in) :: n, most
    allocate (this%id(n), this%part(n), this%record(n), this%type(n), this%first(n + 1), &
        this%node(most), this%kind(0))
    this%first(1) = 1
  end subroutine start

  !> One more element, of a type of the registry.
  subroutine add(this, name, id, part, record, node)
    class(mesh_t), intent(inout) :: this
    character(*), intent(in) :: name
    integer, intent(in) :: id, part, record, node(:)
    integer :: k
    k = this%n + 1
    this%n = k
    this%id(k) = id
    this%part(k) = part
    this%record(k) = record
    this%first(k + 1) = this%first(k) + size(node)
    this%node(this%first(k):this%first(k + 1) - 1) = node
    if (k > 1) then
      if (this%kind(this%type(k - 1))%item%name == name) then
        this%type(k) = this%type(k - 1)
        return
      end if
    end if
    this%type(k) = row_of(this, name)
  end subroutine add

  !> The row of a type; a new one where it is the first of its name.
  integer function row_of(this, name)
    type(mesh_t), intent(inout) :: this
    character(*), intent(in) :: name
    type(element_slot_t), allocatable :: longer(:)
    integer :: k
    do row_of = 1, size(this%kind)
      if (this%kind(row_of)%item%name == name) return
    end do
    allocate (longer(row_of))
    do k = 1, size(this%kind)
      call move_alloc(this%kind(k)%item, longer(k)%item)
    end do
    call make_element(name, longer(row_of)%item)
    call move_alloc(longer, this%kind)
  end function row_of

  !> The longest runs of one type and part, in the order of the list.
  subroutine make_blocks(this)
    class(mesh_t), intent(inout) :: this
    integer :: e, n, pass
    this%node = this%node(:this%first(this%n + 1) - 1)
    do pass = 1, 2
      n = 0
      do e = 1, this%n
        if (e > 1) then
          if (this%type(e) == this%type(e - 1) .and. this%part(e) == this%part(e - 1)) then
            if (pass == 2) this%block(n)%last = e
            cycle
          end if
        end if
        n = n + 1
        if (pass == 2) this%block(n) = block_t(e, e, this%type(e), this%part(e))
      end do
      if (pass == 1) allocate (this%block(n))
    end do
  end subroutine make_blocks

  !> Nodes of element e.
  pure integer function count_of(this, e)
    class(mesh_t), intent(in) :: this
    integer, intent(in) :: e
    count_of = this%first(e + 1) - this%first(e)
  end function count_of

  !> The k-th node of element e.
  pure integer function node_of(this, k, e)
    class(mesh_t), intent(in) :: this
    integer, intent(in) :: k, e
    node_of = this%node(this%first(e) + k - 1)
  end function node_of

  !> The nodes of element e.
  pure function nodes_of(this, e) result(node)
    class(mesh_t), intent(in) :: this
    integer, intent(in) :: e
    integer :: node(this%first(e + 1) - this%first(e))
    node = this%node(this%first(e):this%first(e + 1) - 1)
  end function nodes_of

  !> Faces of element e.
  pure integer function faces_of(this, e)
    class(mesh_t), intent(in) :: this
    integer, intent(in) :: e
    faces_of = size(this%kind(this%type(e))%item%face, 2)
  end function faces_of

  !> The nodes of face f of element e, outward, in the front of an array, and how many they are.
  pure subroutine get_face(this, f, e, node, m)
    class(mesh_t), intent(in) :: this
    integer, intent(in) :: f, e
    integer, intent(inout) :: node(:)
    integer, intent(out) :: m
    integer :: k
    associate (face => this%kind(this%type(e))%item%face)
      m = count(face(:, f) > 0)
      do k = 1, m
        node(k) = this%node(this%first(e) + face(k, f) - 1)
      end do
    end associate
  end subroutine get_face

  !> The same for linear piece f of the surface.
  pure subroutine get_facet(this, f, e, node, m)
    class(mesh_t), intent(in) :: this
    integer, intent(in) :: f, e
    integer, intent(inout) :: node(:)
    integer, intent(out) :: m
    integer :: k
    associate (element => this%kind(this%type(e))%item)
      if (.not. allocated(element%facet)) then
        call this%get_face(f, e, node, m)
        return
      end if
      m = size(element%facet, 1)
      do k = 1, m
        node(k) = this%node(this%first(e) + element%facet(k, f) - 1)
      end do
    end associate
  end subroutine get_facet

  !> The face that piece f of the surface of element e is of.
  pure integer function face_of_facet(this, f, e)
    class(mesh_t), intent(in) :: this
    integer, intent(in) :: f, e
    face_of_facet = 1 + (f - 1)/this%kind(this%type(e))%item%facets_a_face()
  end function face_of_facet

  !> Linear pieces of the surface of element e.
  pure integer function facets_of(this, e)
    class(mesh_t), intent(in) :: this
    integer, intent(in) :: e
    facets_of = this%kind(this%type(e))%item%facets()
  end function facets_of

  !> The nodes of piece f of the surface of element e, outward.
  pure function facet_of(this, f, e) result(node)
    class(mesh_t), intent(in) :: this
    integer, intent(in) :: f, e
    integer, allocatable :: node(:)
    node = this%node(this%first(e) - 1 + this%kind(this%type(e))%item%facet_nodes(f))
  end function facet_of

  !> Is element e of the type of a name?
  pure logical function is_of_type(this, e, name)
    class(mesh_t), intent(in) :: this
    integer, intent(in) :: e
    character(*), intent(in) :: name
    is_of_type = this%kind(this%type(e))%item%name == name
  end function is_of_type

end module model_mesh
