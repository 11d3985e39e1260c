! SPDX-License-Identifier: BSD-3-Clause
!> The boundary of bodies in space as facets: the faces that belong to one element only, seen
!> from outside counter-clockwise.
module contact_facets
  use base_kinds, only: wp, zero, one, half
  use linalg_dense, only: cross
  use model_data, only: model_t
  use model_faces, only: exterior_faces
  implicit none
  private

  type, public :: facets_t
    integer :: n = 0
    integer, allocatable :: node(:, :)     !< (4, n); of a triangle the last is 0
    integer, allocatable :: part(:)        !< (n) rows of parts
    logical, allocatable :: is_listed(:)   !< (n) it belongs to the surface
    real(wp), allocatable :: normal(:, :)  !< (3, n) outward, in the middle, reference geometry
    real(wp), allocatable :: size(:)       !< (n) square root of the area [L]
  end type facets_t

  public :: exterior_facets, corners_of

contains

  !> All exterior faces of the model, none of them listed. (Faces of quadratic elements are not
  !> among them: contact knows linear facets.)
  subroutine exterior_facets(model, facets)
    type(model_t), intent(in) :: model
    type(facets_t), intent(out) :: facets
    integer, allocatable :: owner(:)
    integer :: k
    call exterior_faces(model%mesh, model%nodes, 4, facets%node, owner)
    facets%n = size(owner)
    facets%part = model%mesh%part(owner)
    allocate (facets%is_listed(facets%n), facets%normal(3, facets%n), facets%size(facets%n))
    facets%is_listed = .false.
    do k = 1, facets%n
      call measure_facet(model%x, facets, k)
    end do
  end subroutine exterior_facets

  pure subroutine measure_facet(x, facets, k)
    real(wp), intent(in) :: x(:, :)
    type(facets_t), intent(inout) :: facets
    integer, intent(in) :: k
    real(wp) :: a(3), b(3), area
    associate (node => facets%node(:, k))
      ! Half the cross product of the diagonals is the area vector of a bilinear facet.
      if (node(4) > 0) then
        a = half*(x(:, node(3)) - x(:, node(1)))
        b = x(:, node(4)) - x(:, node(2))
      else
        a = half*(x(:, node(2)) - x(:, node(1)))
        b = x(:, node(3)) - x(:, node(1))
      end if
    end associate
    facets%normal(:, k) = cross(a, b)
    area = norm2(facets%normal(:, k))
    facets%normal(:, k) = facets%normal(:, k)/max(area, tiny(one))
    facets%size(k) = sqrt(area)
  end subroutine measure_facet

  !> Corners of facet k.
  pure integer function corners_of(facets, k)
    type(facets_t), intent(in) :: facets
    integer, intent(in) :: k
    corners_of = merge(4, 3, facets%node(4, k) > 0)
  end function corners_of

end module contact_facets
