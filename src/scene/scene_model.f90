! SPDX-License-Identifier: BSD-3-Clause
!> The whole deck to the whole model, in the order in which one thing needs another.
module scene_model
  use base_status, only: status_t, fail, status_deck
  use base_strings, only: to_text
  use cone_types, only: cone_options_t
  use deck_data, only: deck_t
  use linalg_solver, only: solver_options_t
  use model_data, only: model_t
  use scene_controls, only: read_controls, read_contacts, read_requests, read_solver_options
  use scene_ids, only: id_map_t
  use scene_loads, only: read_curves, read_supports, read_loads, read_initial_velocities
  use scene_material, only: read_materials
  use scene_mesh, only: read_nodes, read_parts, read_elements, read_sets, check_mesh
  implicit none
  private
  public :: make_scene

contains

  !> Builds the model; fails with the number of problems when the deck has any.
  subroutine make_scene(deck, model, cone, solver, status)
    type(deck_t), intent(inout) :: deck
    type(model_t), intent(inout) :: model
    type(cone_options_t), intent(inout) :: cone
    type(solver_options_t), intent(inout) :: solver
    type(status_t), intent(inout) :: status
    type(id_map_t) :: nodes, parts
    if (deck%problems%count == 0) then
      call read_controls(deck, model)
      call read_solver_options(deck, model%controls, cone, solver)
      call read_nodes(deck, model, nodes)
      call read_materials(deck, model)
      call read_parts(deck, model, parts)
      call read_elements(deck, model, nodes, parts)
      call read_sets(deck, model, nodes, parts)
      call read_curves(deck, model)
      call read_supports(deck, model, nodes)
      call read_loads(deck, model, nodes)
      call read_initial_velocities(deck, model, nodes, parts)
      call read_contacts(deck, model)
      call read_requests(deck, model, nodes)
    end if
    if (deck%problems%count == 0) call check_mesh(deck, model)
    if (deck%problems%count > 0) call fail(status, status_deck, to_text(deck%problems%count)// &
        ' problem(s) in the deck; nothing was computed')
  end subroutine make_scene

end module scene_model
