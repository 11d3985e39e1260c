! SPDX-License-Identifier: BSD-3-Clause
!> Field files of a run: segments of frames, and the XDMF file over all of them. Only scenes
!> that ask for fields come here.
module run_frames
  use base_files, only: file_exists, file_size, list_files, remove_file, path_length
  use base_kinds, only: wp, i8
  use base_status, only: status_t, fail, failed, status_file
  use base_strings, only: join_path
  use base_timers, only: phase_output, phase_other
  use contact_area, only: find_all_areas
  use output_fields, only: make_fields, make_mesh, fill_fields, frame_is_due, next_frame
  use output_storage, only: segment_options_t
  use output_xdmf, only: write_xdmf, segment_name
  use run_data, only: run_t
  implicit none
  private
  public :: start_frames, keep_frame, end_segment, check_segments, remove_segments

contains

  !> Work space; the files are made with their first frame.
  subroutine start_frames(run)
    type(run_t), intent(inout) :: run
    allocate (run%fields, run%mesh)
    call make_fields(run%model, run%fields)
    call make_mesh(run%model, run%fields, run%mesh)
  end subroutine start_frames

  !> A frame, if it is due; the last step has one, also where the step has failed.
  subroutine keep_frame(run, last, status)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: last
    type(status_t), intent(inout) :: status
    type(status_t) :: own
    logical :: first
    if (run%broken) return
    if (.not. frame_is_due(run%model, run%fields, run%state%time, run%scheme%h, last)) return
    first = run%fields%frames == 0
    if (.not. first) then
      first = run%fields%segment_of(run%fields%frames) /= run%fields%segment
      if (.not. run%fields%time(run%fields%frames) < run%state%time) return
    end if
    call run%timers%enter(phase_output)
    if (run%plan%contact) call find_all_areas(run%model, run%contact, run%state%u)
    call fill_fields(run%model, run%system, run%state, run%contact, run%fields)
    if (first) call open_segment(run, own)
    if (.not. failed(own)) call run%storage%add_frame(run%state%time, run%fields%field, own)
    if (.not. failed(own)) &
        call next_frame(run%model, run%state%time, run%scheme%h, run%fields)
    if (.not. failed(status)) status = own
    call run%timers%enter(phase_other)
  end subroutine keep_frame

  subroutine open_segment(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    type(segment_options_t) :: options
    associate (r => run%model%requests%field)
      options%compression = r%compression
      options%single = r%single
      options%frames = expected_frames(run, min(run%model%controls%end_time, r%end) - r%begin)
      if (run%model%requests%restart%steps > 0) options%frames = min(options%frames, &
          expected_frames(run, run%model%requests%restart%steps*run%scheme%h))
    end associate
    call run%storage%open_segment(join_path(run%folder, segment_name(run%fields%segment)), &
        run%mesh, run%fields%field, options, status)
  end subroutine open_segment

  !> Frames in a span of time; more than a chunk takes is all the same.
  pure integer function expected_frames(run, span)
    type(run_t), intent(in) :: run
    real(wp), intent(in) :: span
    expected_frames = 1 + ceiling(min(1.0e6_wp, span/max(run%model%requests%field%interval, &
        run%scheme%h)))
  end function expected_frames

  !> Ends the file that is open, if it has a frame; the next frame begins another one.
  subroutine end_segment(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    if (run%fields%frames == 0) return
    if (run%fields%segment_of(run%fields%frames) /= run%fields%segment) return
    call run%storage%close_segment(status)
    run%fields%bytes = [run%fields%bytes, real(file_size(join_path(run%folder, &
        segment_name(run%fields%segment))), wp)]
    run%fields%segment = run%fields%segment + 1
    call write_xdmf(run%folder, run%mesh, run%fields, run%model%requests%field%single, status)
  end subroutine end_segment

  !> Fails where a field file of the run so far is not as it was any more.
  subroutine check_segments(run, status)
    type(run_t), intent(in) :: run
    type(status_t), intent(inout) :: status
    character(:), allocatable :: path
    integer :: k
    if (failed(status)) return
    do k = 0, run%fields%segment - 1
      path = join_path(run%folder, segment_name(k))
      if (.not. file_exists(path)) then
        call fail(status, status_file, 'cannot go on: "'//path// &
            '" of the run so far is missing')
      else if (file_size(path) /= nint(run%fields%bytes(k + 1), i8)) then
        call fail(status, status_file, 'cannot go on: "'//path//'" has lost frames that it '// &
            'had when the restart file was written')
      end if
    end do
  end subroutine check_segments

  !> Removes the field files of an earlier run from a folder: those of number `first` and
  !> higher.
  subroutine remove_segments(folder, first)
    character(*), intent(in) :: folder
    integer, intent(in) :: first
    character(path_length), allocatable :: paths(:)
    integer :: k, number, ios, at
    call list_files(folder, 'fields.*.vtkhdf', paths)
    do k = 1, size(paths)
      at = index(paths(k), '/fields.', back=.true.) + 8
      read (paths(k)(at:index(paths(k), '.vtkhdf', back=.true.) - 1), *, iostat=ios) number
      if (ios == 0 .and. number >= first) call remove_file(trim(paths(k)))
    end do
    if (first == 0) call remove_file(join_path(folder, 'fields.xdmf'))
  end subroutine remove_segments

end module run_frames
