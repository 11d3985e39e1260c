! SPDX-License-Identifier: BSD-3-Clause
!> Rows of the tables of contact and support forces.
module output_forces
  use base_format, only: real_writer_t
  use base_kinds, only: wp, zero, half
  use base_status, only: status_t
  use contact_pairing, only: pairing_t, no_gap
  use contact_types, only: contact_t
  use model_data, only: model_t
  use output_table, only: table_file_t, begin_row, add_number, add_count, end_row
  use output_tables, only: add_numbers, add_vector
  implicit none
  private
  public :: write_rcforc, write_rwforc, write_sleout, write_ncforc, write_spcforc

contains

  !> Sums of each side of each contact of bodies.
  subroutine write_rcforc(file, writer, contact, time, status)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    type(contact_t), intent(in) :: contact
    real(wp), intent(in) :: time
    type(status_t), intent(inout) :: status
    integer :: p, s
    do p = 1, size(contact%pairing)
      if (contact%pairing(p)%item%is_wall) cycle
      do s = 1, 2
        call begin_row(file, status)
        call add_number(file, writer, time)
        call add_count(file, contact%pairing(p)%item%id)
        call add_count(file, s)
        call add_sums(file, writer, contact%pairing(p)%item, s)
      end do
    end do
  end subroutine write_rcforc

  !> Sums of the forces on the bodies at each wall.
  subroutine write_rwforc(file, writer, contact, time, status)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    type(contact_t), intent(in) :: contact
    real(wp), intent(in) :: time
    type(status_t), intent(inout) :: status
    integer :: p
    do p = 1, size(contact%pairing)
      if (.not. contact%pairing(p)%item%is_wall) cycle
      call begin_row(file, status)
      call add_number(file, writer, time)
      call add_count(file, contact%pairing(p)%item%id)
      call add_sums(file, writer, contact%pairing(p)%item, 1)
    end do
  end subroutine write_rwforc

  !> Force of the step, mean of two, impulse, magnitudes, counts, gap of one side; ends the row.
  subroutine add_sums(file, writer, pairing, side)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    class(pairing_t), intent(in) :: pairing
    integer, intent(in) :: side
    real(wp) :: mean(3)
    associate (s => pairing%sums)
      mean = half*(s%force(:, side) + s%force_before(:, side))
      call add_vector(file, writer, s%force(:, side))
      call add_vector(file, writer, mean)
      call add_vector(file, writer, s%impulse(:, side))
      call add_numbers(file, writer, [s%normal_force, s%tangential_force])
      call add_count(file, s%n_active)
      call add_count(file, s%n_stick)
      call add_count(file, s%n_slip)
      call add_number(file, writer, s%smallest_gap)
    end associate
    call end_row(file)
  end subroutine add_sums

  !> One row for the whole coupled problem (id 0), one per contact; the solver's figures are
  !> those of the coupled problem in every row.
  subroutine write_sleout(file, writer, contact, time, status)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    type(contact_t), intent(in) :: contact
    real(wp), intent(in) :: time
    type(status_t), intent(inout) :: status
    real(wp) :: works(2), penetration
    integer :: p
    do p = 0, size(contact%pairing)
      if (p > 0) then
        if (contact%pairing(p)%item%is_wall) cycle
      end if
      call sums_of(contact, p, works, penetration)
      call begin_row(file, status)
      call add_number(file, writer, time)
      if (p == 0) call add_count(file, 0)
      if (p > 0) call add_count(file, contact%pairing(p)%item%id)
      call add_numbers(file, writer, works)
      associate (tally => contact%tally)
        call add_count(file, tally%solves_since_row)
        call add_count(file, tally%sweeps_since_row)
        call add_numbers(file, writer, [tally%worst_since_row%eta, &
            tally%worst_since_row%error, tally%worst_since_row%error2018, penetration])
      end associate
      call end_row(file)
    end do
  end subroutine write_sleout

  !> Works [F L] (normal, friction) and largest overlap [L] of pairing p; of all: p = 0.
  pure subroutine sums_of(contact, p, works, penetration)
    type(contact_t), intent(in) :: contact
    integer, intent(in) :: p
    real(wp), intent(out) :: works(2), penetration
    integer :: k
    works = zero
    penetration = zero
    do k = 1, size(contact%pairing)
      if (p > 0 .and. p /= k) cycle
      associate (sums => contact%pairing(k)%item%sums)
        works = works + [sums%normal_work, sums%friction_work]
        penetration = max(penetration, sums%penetration)
      end associate
    end do
  end subroutine sums_of

  !> Nodes that are listed, or were pressed in this step or the last.
  subroutine write_ncforc(file, writer, model, contact, time, status)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    type(model_t), intent(in) :: model
    type(contact_t), intent(in) :: contact
    real(wp), intent(in) :: time
    type(status_t), intent(inout) :: status
    real(wp) :: pressure, mean(3)
    integer :: p, k
    do p = 1, size(contact%pairing)
      if (contact%pairing(p)%item%is_wall) cycle
      associate (c => contact%pairing(p)%item%nodal)
        do k = 1, size(c%node)
          if (c%gap(k) >= no_gap .and. .not. any(abs(c%before(:, k)) > zero) .and. &
              .not. any(abs(c%force(:, k)) > zero)) cycle
          pressure = zero
          if (c%area(k) > zero) pressure = c%normal(k)/c%area(k)
          call begin_row(file, status)
          call add_number(file, writer, time)
          call add_count(file, contact%pairing(p)%item%id)
          call add_count(file, c%side(k))
          call add_count(file, model%node_id(c%node(k)))
          mean(:contact%dim) = half*(c%force(:, k) + c%before(:, k))
          call add_vector(file, writer, c%force(:, k))
          call add_vector(file, writer, mean(:contact%dim))
          call add_numbers(file, writer, [pressure, c%gap(k), c%slip(k)])
          call add_count(file, c%status(k))
          call end_row(file)
        end do
      end associate
    end do
  end subroutine write_ncforc

  !> Every node that is held in some direction by a support or by a motion that acts now.
  subroutine write_spcforc(file, writer, model, held, reaction, time, status)
    type(table_file_t), intent(inout) :: file
    type(real_writer_t), intent(in) :: writer
    type(model_t), intent(in) :: model
    logical, intent(in) :: held(:, :)
    real(wp), intent(in) :: reaction(:, :), time
    type(status_t), intent(inout) :: status
    integer :: k
    do k = 1, model%mesh_nodes
      if (.not. any(held(:, k))) cycle
      call begin_row(file, status)
      call add_number(file, writer, time)
      call add_count(file, model%node_id(k))
      call add_vector(file, writer, reaction(:, k))
      call end_row(file)
    end do
  end subroutine write_spcforc

end module output_forces
