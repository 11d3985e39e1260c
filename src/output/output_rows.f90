! SPDX-License-Identifier: BSD-3-Clause
!> Rows of the tables of energies, parts, nodes, elements and times.
module output_rows
  use assembly_forces, only: element_product
  use assembly_system, only: system_t
  use base_format, only: real_writer_t
  use base_kinds, only: wp, zero, half
  use base_status, only: status_t
  use base_timers, only: timers_t, phase_input, phase_assemble, phase_factor, phase_solve, &
      phase_search, phase_contact, phase_output
  use model_data, only: model_t
  use model_state, only: state_t
  use output_history, only: history_t, history_stress
  use output_table, only: table_file_t, begin_row, add_number, add_count, end_row
  use output_tables, only: flows, add_numbers, add_vector
  use solid_output, only: element_cauchy
  use time_ledger, only: ledger_t
  implicit none
  private
  public :: write_glstat, write_matsum, write_nodout, write_elout, write_rbdout, write_timing

contains

  !> Energies, ledger, momenta.
  subroutine write_glstat(file, writer, model, state, ledger, h, status)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    type(model_t), intent(in) :: model
    type(state_t), intent(in) :: state
    type(ledger_t), intent(in) :: ledger
    real(wp), intent(in) :: h
    type(status_t), intent(inout) :: status
    call begin_row(file, status)
    call add_number(file, writer, state%time)
    call add_count(file, state%cycle)
    call add_numbers(file, writer, &
        [h, ledger%kinetic, ledger%internal, ledger%total, ledger%initial, ledger%external, &
        ledger%motion, ledger%contact%friction, ledger%contact%normal, &
        ledger%contact%unsolved, ledger%algorithmic, ledger%damping, ledger%residual, &
        ledger%ratio])
    call add_vector(file, writer, ledger%momentum)
    call add_vector(file, writer, ledger%angular)
    if (flows(model)) call add_number(file, writer, ledger%plastic)
    call end_row(file)
  end subroutine write_glstat

  !> Energies and momentum of each part.
  subroutine write_matsum(file, writer, model, state, ledger, status)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    type(model_t), intent(in) :: model
    type(state_t), intent(in) :: state
    type(ledger_t), intent(in) :: ledger
    type(status_t), intent(inout) :: status
    real(wp) :: velocity(3)
    integer :: p
    do p = 1, size(model%part)
      call begin_row(file, status)
      call add_number(file, writer, state%time)
      call add_count(file, model%part(p)%id)
      call add_numbers(file, writer, [ledger%part_mass(p), ledger%part_kinetic(p), &
          ledger%part_internal(p)])
      call add_vector(file, writer, ledger%part_momentum(:, p))
      velocity = zero    ! of a rigid part that has joined another one
      if (ledger%part_mass(p) > zero) &
          velocity(:model%dim) = ledger%part_momentum(:, p)/ledger%part_mass(p)
      call add_vector(file, writer, velocity(:model%dim))
      call end_row(file)
    end do
  end subroutine write_matsum

  !> Motion of the history nodes.
  subroutine write_nodout(file, writer, model, state, status)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    type(model_t), intent(in) :: model
    type(state_t), intent(in) :: state
    type(status_t), intent(inout) :: status
    real(wp), dimension(3) :: mean, place
    integer :: k, i, d
    d = model%dim
    do k = 1, size(model%requests%history_node)
      i = model%requests%history_node(k)
      mean(:d) = state%v(:, i)
      if (state%cycle > 0) mean(:d) = state%du(:, i)/state%h_last
      call begin_row(file, status)
      call add_number(file, writer, state%time)
      call add_count(file, model%node_id(i))
      call add_vector(file, writer, state%u(:, i))
      call add_vector(file, writer, state%v(:, i))
      call add_vector(file, writer, mean(:d))
      place(:d) = model%x(:, i) + state%u(:, i)
      call add_vector(file, writer, place(:d))
      if (allocated(state%a)) call add_vector(file, writer, state%a(:, i))
      call end_row(file)
    end do
  end subroutine write_nodout

  !> Motion of the rigid parts: of their centres of mass, and their rotation.
  subroutine write_rbdout(file, writer, model, state, status)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    type(model_t), intent(in) :: model
    type(state_t), intent(in) :: state
    type(status_t), intent(inout) :: status
    real(wp) :: place(2)
    integer :: p
    do p = 1, size(model%rigid%part)
      associate (rigid => model%rigid, c => model%rigid%centre(p), r => model%rigid%rotor(p))
        call begin_row(file, status)
        call add_number(file, writer, state%time)
        call add_count(file, model%part(rigid%part(p))%id)
        call add_number(file, writer, rigid%mass(p))
        place = model%x(:, c) + state%u(:, c)
        call add_vector(file, writer, place)
        call add_vector(file, writer, state%u(:, c))
        call add_vector(file, writer, state%v(:, c))
        call add_numbers(file, writer, [zero, zero, state%u(1, r)/rigid%radius(p)])
        call add_numbers(file, writer, [zero, zero, state%v(1, r)/rigid%radius(p)])
        call end_row(file)
      end associate
    end do
  end subroutine write_rbdout

  !> Stress (mean over the Gauss points) and strain energy of the history elements.
  subroutine write_elout(file, writer, history, model, system, state, status)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    type(history_t), intent(in) :: history
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    type(status_t), intent(inout) :: status
    real(wp) :: stress(6)
    integer :: k, e
    do k = 1, size(model%requests%history_element)
      e = model%requests%history_element(k)
      if (allocated(system%solid)) then
        associate (solid => system%solid(system%block_of(e)))
          call element_cauchy(solid, e - solid%first + 1, state%u, stress)
        end associate
      else
        call history_stress(history, k, state%u, stress(:size(history%b, 1)))
      end if
      associate (part => model%part(model%mesh%part(e)))
        call begin_row(file, status)
        call add_number(file, writer, state%time)
        call add_count(file, model%mesh%id(e))
        call add_count(file, part%id)
        if (model%is_axisymmetric .and. .not. allocated(system%solid)) then
          call add_numbers(file, writer, [stress([1, 2, 4, 3]), zero, zero])
        else if (model%dim == 2 .and. .not. allocated(system%solid)) then
          call add_numbers(file, writer, [stress(1), stress(2), model%material( &
              part%material)%item%out_of_plane_stress(part%plane, stress(:3)), stress(3), &
              zero, zero])
        else
          call add_numbers(file, writer, stress)
        end if
        call add_number(file, writer, half*element_product(system, e, state%u))
        call end_row(file)
      end associate
    end do
  end subroutine write_elout

  !> Seconds by phase, counts.
  subroutine write_timing(file, writer, state, timers, factors, solves, sweeps, status)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    type(state_t), intent(in) :: state
    type(timers_t), intent(in) :: timers
    integer, intent(in) :: factors, solves, sweeps
    type(status_t), intent(inout) :: status
    integer, parameter :: phase(7) = [phase_input, phase_assemble, phase_factor, phase_solve, &
        phase_search, phase_contact, phase_output]
    real(wp) :: cpu
    integer :: k
    call cpu_time(cpu)
    call begin_row(file, status)
    call add_number(file, writer, state%time)
    call add_count(file, state%cycle)
    call add_number(file, writer, cpu)
    do k = 1, size(phase)
      call add_number(file, writer, timers%seconds(phase(k)))
    end do
    call add_count(file, factors)
    call add_count(file, solves)
    call add_count(file, sweeps)
    call end_row(file)
  end subroutine write_timing

end module output_rows
