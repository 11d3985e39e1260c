! SPDX-License-Identifier: BSD-3-Clause
!> Several processes (ranks) that share the elements of a scene: what the first one, which runs
!> the program, asks of all. Each rank keeps the stiffness of its own elements and the entries
!> of the effective matrix that they give; vectors of nodes, the mass and the nodes of all
!> elements are with the first one. Sums over ranks are in the order of the ranks. The serial
!> program has no team.
module assembly_team
  use assembly_blocks, only: element_block_t
  use base_kinds, only: wp
  use base_status, only: status_t
  use linalg_graph, only: graph_t
  use linalg_solver, only: solver_t, solver_options_t
  use model_data, only: model_t
  implicit none
  private

  type, abstract, public :: team_t
    integer :: ranks = 1
  contains
    procedure(share_i), deferred :: share
    procedure(subtract_forces_i), deferred :: subtract_forces
    procedure(subtract_chosen_i), deferred :: subtract_chosen
    procedure(block_products_i), deferred :: block_products
    procedure(chosen_products_i), deferred :: chosen_products
    procedure(assemble_i), deferred :: assemble
    procedure(largest_stiffness_i), deferred :: largest_stiffness
    procedure(make_solver_i), deferred :: make_solver
    procedure(dismiss_i), deferred :: dismiss
  end type team_t

  abstract interface
    !> Gives each rank its elements of the blocks, with their stiffness, and its entries of the
    !> graph. modes (3, elements): quad_mode_moduli of quadrilaterals in the plane, not
    !> allocated in space. Fails where there are more ranks than elements.
    subroutine share_i(this, model, graph, block, modes, status)
      import :: team_t, model_t, graph_t, element_block_t, wp, status_t
      class(team_t), intent(inout) :: this
      type(model_t), intent(in) :: model
      type(graph_t), intent(in) :: graph
      type(element_block_t), intent(in) :: block(:)
      real(wp), allocatable, intent(out) :: modes(:, :)
      type(status_t), intent(inout) :: status
    end subroutine share_i
    !> f = f - factor K u; u, f (dim, n).
    subroutine subtract_forces_i(this, factor, u, f)
      import :: team_t, wp
      class(team_t), intent(inout) :: this
      real(wp), intent(in) :: factor, u(:, :)
      real(wp), intent(inout) :: f(:, :)
    end subroutine subtract_forces_i
    !> f = f - sum of weight(k) K_e u, e = element(k), in this order.
    subroutine subtract_chosen_i(this, block, block_of, element, weight, u, f)
      import :: team_t, element_block_t, wp
      class(team_t), intent(inout) :: this
      type(element_block_t), intent(in) :: block(:)
      integer, intent(in) :: block_of(:), element(:)
      real(wp), intent(in) :: weight(:), u(:, :)
      real(wp), intent(inout) :: f(:, :)
    end subroutine subtract_chosen_i
    !> u.K u of each block [F L].
    subroutine block_products_i(this, u, total)
      import :: team_t, wp
      class(team_t), intent(inout) :: this
      real(wp), intent(in) :: u(:, :)
      real(wp), intent(out) :: total(:)
    end subroutine block_products_i
    !> u.K u of some elements [F L].
    subroutine chosen_products_i(this, block, block_of, element, u, value)
      import :: team_t, element_block_t, wp
      class(team_t), intent(inout) :: this
      type(element_block_t), intent(in) :: block(:)
      integer, intent(in) :: block_of(:), element(:)
      real(wp), intent(in) :: u(:, :)
      real(wp), intent(out) :: value(:)
    end subroutine chosen_products_i
    !> A = sum of weight(e) K_e, weight (1) if it is the same of all, and the entries at (1 or
    !> dim, size(graph%column)) of each pair of nodes in each direction; rows and columns of
    !> fixed dofs (dim, n) keep their diagonal only. The entries stay with the ranks until the
    !> next solver factors them; its diagonal (dim, n) comes back.
    subroutine assemble_i(this, graph, weight, at, fixed, diagonal)
      import :: team_t, graph_t, wp
      class(team_t), intent(inout) :: this
      type(graph_t), intent(in) :: graph
      real(wp), intent(in) :: weight(:), at(:, :)
      logical, intent(in) :: fixed(:, :)
      real(wp), intent(out) :: diagonal(:, :)
    end subroutine assemble_i
    !> Largest entry on a diagonal of element stiffness [F/L].
    real(wp) function largest_stiffness_i(this)
      import :: team_t, wp
      class(team_t), intent(inout) :: this
    end function largest_stiffness_i
    !> A solver whose factor is spread over the ranks.
    subroutine make_solver_i(this, options, solver)
      import :: team_t, solver_options_t, solver_t
      class(team_t), target, intent(inout) :: this
      type(solver_options_t), intent(in) :: options
      class(solver_t), allocatable, intent(out) :: solver
    end subroutine make_solver_i
    !> The end of all other ranks.
    subroutine dismiss_i(this)
      import :: team_t
      class(team_t), intent(inout) :: this
    end subroutine dismiss_i
  end interface

end module assembly_team
