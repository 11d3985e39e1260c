! SPDX-License-Identifier: BSD-3-Clause
!> The whole deck to the whole model, in the order in which one thing needs another.
module scene_model
  use base_status, only: status_t, fail, status_deck
  use base_strings, only: to_text
  use cone_types, only: cone_options_t
  use deck_data, only: deck_t
  use deck_problems, only: full
  use linalg_solver, only: solver_options_t
  use model_data, only: model_t
  use scene_axis, only: check_axis, hold_axis
  use scene_contact, only: read_contacts
  use scene_controls, only: read_controls, read_solver_options, note_keywords
  use scene_damping, only: read_damping
  use scene_ids, only: maps_t
  use scene_loads, only: read_curves, read_loads
  use scene_materials, only: read_materials
  use scene_mesh, only: read_nodes, read_elements, check_mesh
  use scene_motion, only: read_supports, read_motions, read_initial_velocities
  use scene_output, only: read_requests
  use scene_storage, only: read_storage
  use scene_mass, only: check_mass
  use scene_parts, only: read_parts
  use scene_rigid, only: read_rigid_parts
  use scene_rigid_space, only: read_rigid_in_space
  use scene_sets, only: read_sets
  use scene_explicit, only: find_step
  use scene_finite, only: check_laws, check_elements
  use scene_walls, only: read_walls, add_bodies
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
    type(maps_t) :: maps
    if (deck%problems%count == 0) then
      call note_keywords(deck)
      call read_controls(deck, model)
      call read_solver_options(deck, model%controls, cone, solver)
      call read_nodes(deck, model, maps)
      call read_curves(deck, model, maps)
      call read_materials(deck, model, maps)
      call read_parts(deck, model, maps)
      call check_laws(deck, model)
      call read_elements(deck, model, maps)
    end if
    if (deck%problems%count == 0) then
      call check_mesh(deck, model)
      call check_axis(deck, model)
      call check_elements(deck, model)
      call check_mass(deck, model)
    end if
    if (deck%problems%count == 0) then
      call read_sets(deck, model, maps)
      call read_supports(deck, model, maps)
      call hold_axis(deck, model)
      call read_loads(deck, model, maps)
      call read_damping(deck, model, maps)
      if (deck%problems%count == 0 .and. model%controls%is_explicit) call find_step(deck, model)
      call read_motions(deck, model, maps)
      call read_initial_velocities(deck, model, maps)
      call read_contacts(deck, model, maps)
      call read_walls(deck, model, maps)
      call read_requests(deck, model, maps)
      call read_storage(deck, model, maps)
      if (deck%problems%count == 0) then
        if (deck%in_space) then
          call read_rigid_in_space(deck, model, maps)
        else
          call read_rigid_parts(deck, model, maps)
        end if
      end if
    end if
    if (deck%problems%count == 0) call add_bodies(model)
    if (deck%problems%count > 0) call fail(status, status_deck, problem_count(deck)// &
        ' in the deck; nothing was computed')
  end subroutine make_scene

  !> "1 problem", "20 problems or more".
  pure function problem_count(deck) result(text)
    type(deck_t), intent(in) :: deck
    character(:), allocatable :: text
    text = to_text(deck%problems%count)// &
        trim(merge(' problem ', ' problems', deck%problems%count == 1))
    if (full(deck%problems)) text = text//' or more'
  end function problem_count

end module scene_model
