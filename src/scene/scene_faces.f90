! SPDX-License-Identifier: BSD-3-Clause
!> Checks of a mesh in space as a whole: how the faces of its elements meet.
module scene_faces
  use base_kinds, only: wp
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_warning, full
  use element_base, only: most_face_nodes
  use model_data, only: model_t
  use model_faces, only: faces_t, find_faces, find_hanging, face_at
  implicit none
  private
  public :: check_faces, warn_of_locking

contains

  !> A face has two elements at most, and meets faces of its own shape.
  subroutine check_faces(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(faces_t) :: faces
    character(:), allocatable :: found, hint
    integer :: k, hanging(2)
    call find_faces(model%mesh, model%mesh_nodes, faces)
    do k = 1, faces%n
      if (faces%count(k) > 2) call tell_shared(deck, model, faces, k)
      if (full(deck%problems)) return
    end do
    call find_hanging(model%mesh, model%mesh_nodes, faces, hanging)
    if (hanging(1) == 0) return
    found = 'a triangle of element '//to_text(model%mesh%id(hanging(1)))// &
        ' lies on half a quadrilateral of element '
    hint = 'put pyramids between tetrahedra and hexahedra'
    if (model%mesh%count_of(hanging(1)) > 8 .or. model%mesh%count_of(hanging(2)) > 8) then
      found = 'a face of element '//to_text(model%mesh%id(hanging(1)))// &
          ' lies on a face with more nodes of element '
      hint = 'join quadratic elements with their like alone'
    end if
    call deck%complain(model%mesh%record(hanging(1)), '', found// &
        to_text(model%mesh%id(hanging(2)))//': they do not hold together', &
        'the other element is at '//deck%place(model%mesh%record(hanging(2)))//'; '//hint)
  end subroutine check_faces

  !> Names the elements of a face that more than two have.
  subroutine tell_shared(deck, model, faces, k)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    type(faces_t), intent(in) :: faces
    integer, intent(in) :: k
    character(:), allocatable :: names
    integer :: e, f, last, m, node(most_face_nodes)
    names = ''
    last = 0
    do e = faces%owner(k), model%mesh%n
      do f = 1, model%mesh%faces_of(e)
        call model%mesh%get_face(f, e, node, m)
        if (face_at(model%mesh, faces, node(:m)) /= k) cycle
        if (len(names) > 0) names = names//', '
        names = names//to_text(model%mesh%id(e))
        last = e
      end do
    end do
    call deck%complain(model%mesh%record(last), '', 'elements '//names// &
        ' have one face together: a face has two elements at most', &
        'do elements stand twice in the deck?')
  end subroutine tell_shared

  !> One warning for each part whose elements lock at the Poisson ratio of its material:
  !> tetrahedra, and fully integrated elements near incompressibility.
  subroutine warn_of_locking(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(in) :: model
    !> Beyond them they are several times too stiff in bending, or in all but a change of volume
    !> (doc/theory.md 1).
    real(wp), parameter :: high(2) = [0.4_wp, 0.49_wp]
    logical :: has_them(2, size(model%part))
    character(:), allocatable :: text
    real(wp) :: d(6, 6)
    integer :: e, p
    has_them = .false.
    do e = 1, model%mesh%n
      associate (p => model%mesh%part(e))
        if (model%mesh%is_of_type(e, 'TET4')) has_them(1, p) = .true.
        if (keeps_volume(model, p)) cycle
        if (any([model%mesh%is_of_type(e, 'WEDGE6'), model%mesh%is_of_type(e, 'PYRAMID5'), &
            model%mesh%is_of_type(e, 'HEX8')])) has_them(2, p) = .true.
      end associate
    end do
    do p = 1, size(model%part)
      if (.not. any(has_them(:, p))) cycle
      d = model%material(model%part(p)%material)%item%moduli(model%part(p)%plane)
      text = 'part '//to_text(model%part(p)%id)//' locks: it has '
      if (has_them(1, p) .and. d(1, 2) > high(1)*(d(1, 1) + d(1, 2))) then
        call add_warning(deck%problems, 'poisson', text// &
            'tetrahedra of constant strain and a PR above 0.4; take hexahedra, ELFORM 2 or -1')
      else if (has_them(2, p) .and. d(1, 2) > high(2)*(d(1, 1) + d(1, 2))) then
        call add_warning(deck%problems, 'poisson', text//'fully integrated elements and a '// &
            'PR above 0.49; take hexahedra, ELFORM 2 or -1, or lower PR')
      end if
    end do
  end subroutine warn_of_locking

  !> Do hexahedra, wedges and pyramids of a part have mean dilatation by their law? So at finite
  !> deformation.
  pure logical function keeps_volume(model, p)
    type(model_t), intent(in) :: model
    integer, intent(in) :: p
    keeps_volume = model%controls%is_finite .and. model%controls%mean_dilatation /= 0
    if (keeps_volume .and. model%controls%mean_dilatation < 0) keeps_volume = &
        model%material(model%part(p)%material)%item%mean_dilatation
  end function keeps_volume

end module scene_faces
