! SPDX-License-Identifier: BSD-3-Clause
!> Materials: from cards to the model.
module scene_material
  use base_kinds, only: wp
  use base_strings, only: to_text
  use deck_data, only: deck_t
  use deck_problems, only: add_warning
  use material_registry, only: make_material
  use model_data, only: model_t
  use scene_ids, only: id_map_t, make_id_map
  implicit none
  private
  public :: read_materials

contains

  !> Every *MAT_... block becomes a material.
  subroutine read_materials(deck, model)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    integer :: b, n, r
    integer, allocatable :: ids(:), record(:)
    type(id_map_t) :: map
    allocate (ids(0), record(0), model%material(deck%blocks))
    n = 0
    do b = 1, deck%blocks
      associate (name => deck%table%keyword(deck%block(b)%keyword)%name)
        if (name(1:4) /= 'MAT_') cycle
        r = deck%block(b)%first
        if (deck%block(b)%last < r) cycle
        associate (values => deck%value(deck%record(r)%start + 1:))
          n = n + 1
          call make_material(trim(name), nint(values(1)), values(2:8), model%material(n)%item)
          ids = [ids, nint(values(1))]
          record = [record, r]
        end associate
        if (deck%real(r, 'PR') > 0.49_wp) call warn_locking(deck, r)
      end associate
    end do
    model%material = model%material(1:n)
    call make_id_map(deck, 'material', 'MID', ids, record, map)
  end subroutine read_materials

  subroutine warn_locking(deck, record)
    type(deck_t), intent(inout) :: deck
    integer, intent(in) :: record
    call add_warning(deck%problems, deck%place(record)//': PR > 0.49 of material '// &
        to_text(deck%integer(record, 'MID'))//': fully integrated quadrilaterals lock')
  end subroutine warn_locking

end module scene_material
