! SPDX-License-Identifier: BSD-3-Clause
!> Damping of the deck, C = sum a_p M_p + sum |COEF_p| K_p over the parts p: its forces C v, and
!> its coefficients, where they change. M_p are the elements of the part in the mass that the
!> step uses (of its type, with massless nodes where it has them), so a coefficient that all
!> parts share gives a M.
module assembly_damping
  use assembly_forces, only: subtract_weighted_forces
  use assembly_mass, only: assemble_mass
  use assembly_system, only: system_t
  use base_kinds, only: wp, zero
  use model_data, only: model_t
  implicit none
  private
  public :: set_mass_damping, subtract_damping_force, subtract_mass_damping_rows, &
      subtract_stiffness_damping

contains

  !> The part of C by mass, from the coefficient [1/T] of each card of the model; cards add up.
  subroutine set_mass_damping(model, value, system)
    type(model_t), intent(in) :: model
    real(wp), intent(in) :: value(:)
    type(system_t), intent(inout) :: system
    real(wp) :: mass(size(system%mass)), weight(size(model%part), model%dim)
    integer :: d, i, k
    weight = zero
    do k = 1, size(value)
      associate (card => model%mass_damping(k))
        do d = 1, model%dim
          weight(card%part, d) = weight(card%part, d) + value(k)*card%scale(d)
        end do
      end associate
    end do
    associate (c => system%damping)
      do d = 1, size(c%mass, 1)
        call assemble_mass(model, system%graph, c%first, c%target, &
            weight(:, d), mass)
        if (system%mass_is_diagonal) then
          c%mass(d, :) = [(mass(system%graph%position(i, i)), i=1, system%n)]
        else
          c%mass(d, :) = mass
        end if
      end do
    end associate
  end subroutine set_mass_damping

  !> f = f - factor * C v; v, f (dim, n).
  subroutine subtract_damping_force(system, factor, v, f)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: v(:, :)
    real(wp), intent(inout) :: f(:, :)
    integer :: i
    if (allocated(system%damping%mass)) then
      do i = 1, system%n
        call subtract_row(system, i, factor, v, f(:, i))
      end do
    end if
    associate (c => system%damping)
      if (associated(system%team)) then
        call subtract_weighted_forces(system, c%element, factor*c%coefficient, v, f)
        return
      end if
      do i = 1, size(c%element)
        call subtract_weighted_forces(system, c%element(i:i), [factor*c%coefficient(i)], v, f)
      end do
    end associate
  end subroutine subtract_damping_force

  !> The part by mass in some rows, each as SUBTRACT_DAMPING_FORCE has it.
  subroutine subtract_mass_damping_rows(system, rows, factor, v, f)
    type(system_t), intent(in) :: system
    integer, intent(in) :: rows(:)
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: v(:, :)
    real(wp), intent(inout) :: f(:, :)
    integer :: k
    if (.not. allocated(system%damping%mass)) return
    do k = 1, size(rows)
      call subtract_row(system, rows(k), factor, v, f(:, rows(k)))
    end do
  end subroutine subtract_mass_damping_rows

  !> The part by stiffness of some elements: chosen(:) = their places in damping%element.
  subroutine subtract_stiffness_damping(system, chosen, factor, v, f)
    type(system_t), intent(in) :: system
    integer, intent(in) :: chosen(:)
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: v(:, :)
    real(wp), intent(inout) :: f(:, :)
    integer :: k
    associate (c => system%damping)
      if (associated(system%team)) then
        call subtract_weighted_forces(system, c%element(chosen), &
            factor*c%coefficient(chosen), v, f)
        return
      end if
      do k = 1, size(chosen)
        call subtract_weighted_forces(system, c%element(chosen(k):chosen(k)), &
            [factor*c%coefficient(chosen(k))], v, f)
      end do
    end associate
  end subroutine subtract_stiffness_damping

  !> f of node i = f - factor * (row of the part by mass) v.
  pure subroutine subtract_row(system, i, factor, v, f)
    type(system_t), intent(in) :: system
    integer, intent(in) :: i
    real(wp), intent(in) :: factor
    real(wp), intent(in) :: v(:, :)
    real(wp), intent(inout) :: f(:)
    real(wp) :: row(3)
    integer :: k, d
    associate (mass => system%damping%mass, graph => system%graph)
      d = size(f)
      row = zero
      if (system%mass_is_diagonal) then
        do k = 1, d
          row(k) = mass(min(k, size(mass, 1)), i)*v(k, i)
        end do
      else if (size(mass, 1) == 1) then
        do k = graph%first(i), graph%first(i + 1) - 1
          row(:d) = row(:d) + mass(1, k)*v(:, graph%column(k))
        end do
      else
        do k = graph%first(i), graph%first(i + 1) - 1
          row(:d) = row(:d) + mass(:, k)*v(:, graph%column(k))
        end do
      end if
      f = f - factor*row(:d)
    end associate
  end subroutine subtract_row

end module assembly_damping
