! SPDX-License-Identifier: BSD-3-Clause
!> Area vectors of the nodes of faces: what a pressure does to nodes.
module model_areas
  use base_kinds, only: wp, one, two
  use element_face, only: face_areas, curved_areas
  use model_mesh, only: mesh_t
  implicit none
  private
  public :: facet_areas, ring_factors

contains

  !> Facet f of the surface of element e: node (m), the nodes of the face that it is of, and
  !> area (dim, m) [L^(dim-1)] = int N n dA over the facet, n outward, of coordinates x (dim,
  !> nodes) [L].
  subroutine facet_areas(mesh, x, e, f, node, m, area)
    type(mesh_t), intent(in) :: mesh
    real(wp), intent(in) :: x(:, :)
    integer, intent(in) :: e, f
    integer, intent(inout) :: node(:)
    integer, intent(out) :: m
    real(wp), intent(inout) :: area(:, :)
    real(wp) :: of_element(size(x, 1), mesh%count_of(e))
    integer :: face
    face = mesh%face_of_facet(f, e)
    call mesh%get_face(face, e, node, m)
    associate (element => mesh%kind(mesh%type(e))%item)
      if (allocated(element%facet)) then
        call curved_areas(element, x(:, mesh%nodes_of(e)), f, of_element)
        area(:, :m) = of_element(:, element%face(:m, face))
      else
        call face_areas(x(:, node(:m)), area(:, :m))
      end if
    end associate
  end subroutine facet_areas

  !> Of the ends of an edge at the radii r, which is turned about the axis [L]: int N 2 pi r ds
  !> over int N ds.
  pure function ring_factors(r) result(factor)
    real(wp), intent(in) :: r(:)
    real(wp) :: factor(size(r))
    factor = two*acos(-one)*(r + sum(r))/3.0_wp
  end function ring_factors

end module model_areas
