! SPDX-License-Identifier: BSD-3-Clause
!> Rigid parts in space: meshes that are held, or moved by prescribed translations. Their nodes
!> have no unknowns; nothing turns.
module scene_rigid_space
  use base_kinds, only: wp, zero
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use model_data, only: model_t, motion_t
  use scene_ids, only: maps_t, records_of, find_or_complain
  use scene_loads, only: curve_of
  use scene_rigid_cards, only: holds, check_motion, start_motion
  implicit none
  private
  public :: read_rigid_in_space

  character(*), parameter :: instead = 'hold it by CMO 1, CON1 and CON2 7 of *MAT_RIGID, '// &
      'or prescribe its translations by *BOUNDARY_PRESCRIBED_MOTION_RIGID'

contains

  !> Supports and motions of the nodes of rigid parts.
  subroutine read_rigid_in_space(deck, model, maps)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    logical :: held(6), moved(3, size(model%part))
    integer :: p
    call refuse_free(deck)
    moved = .false.
    do p = 1, size(model%part)
      if (.not. model%part(p)%is_rigid) cycle
      held = constraints_of(deck, model%part(p)%material_id)
      if (.not. all(held(4:))) then
        call deck%complain(model%part(p)%record, 'MID', 'rigid part '// &
            to_text(model%part(p)%id)//' may turn: that is not available in space in this '// &
            'version', instead)
        cycle
      end if
      call hold_nodes(deck, model, p, held(:3))
    end do
    if (deck%problems%count > 0) return
    call move_parts(deck, model, maps, moved)
    do p = 1, size(model%part)
      if (.not. model%part(p)%is_rigid) cycle
      held = constraints_of(deck, model%part(p)%material_id)
      if (.not. all(held(:3) .or. moved(:, p))) call deck%complain(model%part(p)%record, &
          'MID', 'rigid part '//to_text(model%part(p)%id)//' may move freely: that is not '// &
          'available in space in this version', instead)
      model%part(p)%is_rigid = .false.      ! it is a mesh with supports now
    end do
  end subroutine read_rigid_in_space

  !> Cards of rigid parts that move freely.
  subroutine refuse_free(deck)
    type(deck_t), intent(inout) :: deck
    character(*), parameter :: names(4) = [character(27) :: 'INITIAL_VELOCITY_RIGID_BODY', &
        'LOAD_RIGID_BODY', 'CONSTRAINED_RIGID_BODIES', 'PART_INERTIA']
    integer :: k, r
    do k = 1, size(names)
      r = deck%next(trim(names(k)), 1, 0)
      if (r > 0) call deck%complain(r, '', '*'//trim(names(k))//' is not available in '// &
          'space in this version', 'rigid parts in space are held, or moved by '// &
          '*BOUNDARY_PRESCRIBED_MOTION_RIGID')
    end do
  end subroutine refuse_free

  !> Translations and rotations that CON1 and CON2 of a material hold.
  function constraints_of(deck, material) result(held)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: material
    logical :: held(6)
    integer, allocatable :: record(:)
    integer :: k, r
    held = .false.
    call records_of(deck, 'MAT_RIGID', 1, record)
    do k = 1, size(record)
      if (deck%integer(record(k), 'MID') /= material) cycle
      r = deck%follow(record(k), 2)
      if (r == 0) cycle
      if (.not. deck%real(r, 'CMO') > zero) cycle
      held = [holds(:, deck%integer(r, 'CON1')), holds(:, deck%integer(r, 'CON2'))]
    end do
  end function constraints_of

  !> Nodes of part p, in the order of their numbers.
  pure function nodes_of_part(model, p) result(list)
    type(model_t), intent(in) :: model
    integer, intent(in) :: p
    integer, allocatable :: list(:)
    logical :: is_in(model%nodes)
    integer :: e, k
    is_in = .false.
    do e = 1, model%mesh%n
      if (model%mesh%part(e) == p) is_in(model%mesh%nodes_of(e)) = .true.
    end do
    list = pack([(k, k=1, model%nodes)], is_in)
  end function nodes_of_part

  !> Holds directions of the nodes of a part, which no deformable part may have.
  subroutine hold_nodes(deck, model, p, held)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    integer, intent(in) :: p
    logical, intent(in) :: held(3)
    integer, allocatable :: list(:)
    logical :: is_shared(model%nodes)
    integer :: e, k
    allocate (list, source=nodes_of_part(model, p))
    is_shared = .false.
    do e = 1, model%mesh%n
      if (.not. model%part(model%mesh%part(e))%is_rigid) &
          is_shared(model%mesh%nodes_of(e)) = .true.
    end do
    if (any(is_shared(list))) call deck%complain(model%part(p)%record, 'MID', 'node '// &
        to_text(model%node_id(list(findloc(is_shared(list), .true., dim=1))))// &
        ' belongs to rigid part '//to_text(model%part(p)%id)//' and to a deformable one', &
        'give each its own nodes')
    do k = 1, 3
      if (held(k)) model%fixed(k, list) = .true.
      if (held(k)) model%v0(k, list) = zero
    end do
  end subroutine hold_nodes

  !> *BOUNDARY_PRESCRIBED_MOTION_RIGID on all nodes of the part.
  subroutine move_parts(deck, model, maps, moved)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(maps_t), intent(in) :: maps
    logical, intent(inout) :: moved(:, :)
    type(motion_t) :: motion
    integer :: r, p
    r = deck%next('BOUNDARY_PRESCRIBED_MOTION_RIGID', 1, 0)
    do while (r > 0)
      p = find_or_complain(deck, maps%part, r, 'PID', deck%integer(r, 'PID'), 'part')
      motion%direction = deck%integer(r, 'DOF')
      if (p > 0) then
        if (.not. model%part(p)%is_rigid) then
          call deck%complain(r, 'PID', 'part '//to_text(model%part(p)%id)//' is not rigid', &
              'its material must be *MAT_RIGID')
        else if (motion%direction < 1 .or. motion%direction > 3) then
          call deck%complain(r, 'DOF', 'expected 1 (x), 2 (y) or 3 (z)', &
              'rotations are not available in space in this version')
        else
          motion%record = r
          motion%kind = deck%integer(r, 'VAD')
          motion%curve = curve_of(deck, model, maps, r)
          motion%factor = deck%real(r, 'SF')
          motion%birth = deck%real(r, 'BIRTH')
          motion%death = deck%real(r, 'DEATH')
          motion%node = nodes_of_part(model, p)
          call check_motion(deck, model, motion)
          if (motion%curve > 0) call start_motion(deck, model, motion)
          model%motion = [model%motion, motion]
          moved(motion%direction, p) = .true.
        end if
      end if
      r = deck%next('BOUNDARY_PRESCRIBED_MOTION_RIGID', 1, r)
    end do
  end subroutine move_parts

end module scene_rigid_space
