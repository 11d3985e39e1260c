! SPDX-License-Identifier: BSD-3-Clause
!> The boundary of bodies in space as facets: the faces that belong to one element only, seen
!> from outside counter-clockwise.
module contact_facets
  use base_kinds, only: wp, zero, one, half
  use linalg_dense, only: cross
  use model_areas, only: facet_areas
  use model_data, only: model_t
  use model_faces, only: exterior_facets
  implicit none
  private

  type, public :: facets_t
    integer :: n = 0
    integer, allocatable :: node(:, :)     !< (4, n); of a triangle the last is 0
    integer, allocatable :: part(:)        !< (n) rows of parts
    logical, allocatable :: is_listed(:)   !< (n) it belongs to the surface
    real(wp), allocatable :: normal(:, :)  !< (3, n) outward, in the middle, reference geometry
    real(wp), allocatable :: size(:)       !< (n) square root of the area [L]
    !> (4, n) of the area, of each corner: its sum over the facets round a node is the integral
    !> of the shape function [L2]
    real(wp), allocatable :: share(:, :)
  end type facets_t

  integer, parameter :: most_corners = 9   !< nodes of a face

  public :: make_facets, corners_of

contains

  !> All exterior faces of the model, none of them listed; of quadratic elements by their
  !> linear facets.
  subroutine make_facets(model, facets)
    type(model_t), intent(in) :: model
    type(facets_t), intent(out) :: facets
    integer, allocatable :: owner(:), facet(:)
    integer :: k, pieces
    call exterior_facets(model%mesh, model%nodes, 4, facets%node, owner, facet)
    facets%n = size(owner)
    facets%part = model%mesh%part(owner)
    allocate (facets%is_listed(facets%n), facets%normal(3, facets%n), facets%size(facets%n), &
        facets%share(4, facets%n))
    facets%is_listed = .false.
    facets%share = zero
    do k = 1, facets%n
      call measure_facet(model%x, facets, k)
      facets%share(:corners_of(facets, k), k) = facets%size(k)**2/corners_of(facets, k)
    end do
    do k = 1, facets%n
      pieces = model%mesh%kind(model%mesh%type(owner(k)))%item%facets_a_face()
      if (pieces > 1 .and. mod(facet(k) - 1, pieces) == 0) &
          call share_face(model, owner(k), facet(k:k + pieces - 1), k, facets)
    end do
  end subroutine make_facets

  !> Shares of the facets of a curved face of element e, which begin at facet k of the list: the
  !> integral of the shape function of a node over the face, in equal parts to the facets that
  !> have it. Corners of a triangle have none (doc/theory.md 1).
  subroutine share_face(model, e, facet, k, facets)
    type(model_t), intent(in) :: model
    integer, intent(in) :: e, facet(:), k
    type(facets_t), intent(inout) :: facets
    !> Of the area of the face: less belongs to nobody.
    real(wp), parameter :: least = 0.01_wp
    real(wp) :: a(3, most_corners), part(3, most_corners), own(most_corners)
    integer :: f, i, m, node(most_corners)
    a = zero
    do f = 1, size(facet)
      call facet_areas(model%mesh, model%x, e, facet(f), node, m, part)
      a(:, :m) = a(:, :m) + part(:, :m)
    end do
    own(:m) = norm2(a(:, :m), dim=1)
    where (own(:m) < least*norm2(sum(a(:, :m), dim=2))) own(:m) = zero
    associate (corner => facets%node(:, k:k + size(facet) - 1))
      do i = 1, m
        where (corner == node(i)) facets%share(:, k:k + size(facet) - 1) = &
            own(i)/count(corner == node(i))
      end do
    end associate
  end subroutine share_face

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
