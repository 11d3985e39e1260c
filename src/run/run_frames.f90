! SPDX-License-Identifier: BSD-3-Clause
!> Field files of a run: segments of frames, and the XDMF file over all of them. Only scenes
!> that ask for fields come here.
module run_frames
  use base_archive, only: archive_t, archive_save, archive_restore
  use base_files, only: file_exists, file_size, list_files, remove_file, path_length
  use base_messages, only: add_message
  use base_kinds, only: wp, zero, one, i8
  use base_status, only: status_t, fail, failed, status_file
  use base_strings, only: join_path
  use base_timers, only: phase_output, phase_other
  use contact_area, only: find_all_areas
  use deck_names, only: field_names
  use output_fields, only: fields_t, make_fields, make_mesh, fill_fields, frame_is_due, &
      next_frame
  use output_storage, only: segment_options_t
  use output_table, only: next_due
  use output_xdmf, only: write_xdmf, reserve_xdmf, drop_xdmf, segment_name
  use run_data, only: run_t
  implicit none
  private
  public :: start_frames, keep_frame, end_segment, exchange_frames, check_segments, &
      remove_segments

contains

  !> Work space; the files are made with their first frame.
  subroutine start_frames(run)
    type(run_t), intent(inout) :: run
    allocate (run%fields, run%mesh)
    call make_fields(run%model, run%fields)
    call make_mesh(run%model, run%fields, run%mesh)
  end subroutine start_frames

  !> A frame, if it is due; the last step has one, also where the step has failed, but not where
  !> a file could not be written: frames may have been lost.
  subroutine keep_frame(run, is_final, status)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: is_final
    type(status_t), intent(inout) :: status
    type(status_t) :: own
    logical :: first
    if (run%broken .or. status%code == status_file) return
    if (.not. frame_is_due(run%model, run%fields, run%state%time, run%model%controls%dt, &
        is_final)) return
    first = run%fields%frames == 0
    if (.not. first) then
      first = run%fields%segment_of(run%fields%frames) /= run%fields%segment
      if (.not. run%fields%time(run%fields%frames) < run%state%time) return
    end if
    call run%timers%enter(phase_output)
    if (run%plan%contact) call find_all_areas(run%model, run%contact, run%state%u)
    call fill_fields(run%model, run%system, run%state, run%contact, run%fields)
    if (run%fields%frames >= run%fields%indexed) call make_room(run, own)
    if (first .and. .not. failed(own)) call open_segment(run, own)
    if (.not. failed(own)) call run%storage%add_frame(run%state%time, run%fields%field, own)
    if (.not. failed(own)) &
        call next_frame(run%model, run%state%time, run%model%controls%dt, run%fields)
    if (.not. failed(status)) status = own
    call run%timers%enter(phase_other)
  end subroutine keep_frame

  !> Room on the disk for the index of the next frames.
  subroutine make_room(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    integer :: frames
    frames = run%fields%frames + max(32, run%fields%frames/8)
    call reserve_xdmf(run%folder, run%mesh, run%fields, frames, status)
    if (.not. failed(status)) run%fields%indexed = frames
  end subroutine make_room

  subroutine open_segment(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    type(segment_options_t) :: options
    associate (r => run%model%requests%field)
      options%compression = r%compression
      options%single = r%single
      options%frames = expected_frames(run, min(run%model%controls%end_time, r%end) - r%begin)
      if (run%model%requests%restart%steps > 0) options%frames = min(options%frames, &
          expected_frames(run, run%model%requests%restart%steps*run%model%controls%dt))
    end associate
    call run%storage%open_segment(join_path(run%folder, segment_name(run%fields%segment)), &
        run%mesh, run%fields%field, options, status)
  end subroutine open_segment

  !> Frames in a span of time; more than a chunk takes is all the same.
  pure integer function expected_frames(run, span)
    type(run_t), intent(in) :: run
    real(wp), intent(in) :: span
    expected_frames = 1 + ceiling(min(1.0e6_wp, span/max(run%model%requests%field%interval, &
        run%model%controls%dt)))
  end function expected_frames

  !> Ends the file that is open, if it has a frame; the next frame begins another one. The index
  !> names the frames that are on file, which are fewer where writing failed.
  subroutine end_segment(run, status)
    type(run_t), intent(inout) :: run
    type(status_t), intent(inout) :: status
    type(status_t) :: own, index
    integer :: on_file
    associate (fields => run%fields)
      on_file = count(fields%segment_of(:fields%frames) == fields%segment)
      if (on_file > 0) then
        fields%frames = fields%frames - on_file
        call run%storage%close_segment(on_file, own)
        fields%frames = fields%frames + on_file
      end if
      if (on_file > 0) then
        fields%bytes = [fields%bytes, real(file_size(join_path(run%folder, &
            segment_name(fields%segment))), wp)]
        fields%segment = fields%segment + 1
        call write_xdmf(run%folder, run%mesh, fields, run%model%requests%field%single, index)
        if (.not. failed(own)) own = index
      else
        call drop_xdmf(run%folder)
      end if
      fields%indexed = 0
    end associate
    if (.not. failed(status)) status = own
  end subroutine end_segment

  !> Saves to or restores from the archive the frames so far; on the way back the next file is
  !> the one after the last of them. Where frames are to hold something else than before, they
  !> are counted anew. told [T]: up to where frames were kept, negative for none.
  subroutine exchange_frames(archive, run, told)
    type(archive_t), intent(inout) :: archive
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: told
    real(wp) :: content(4 + size(field_names)), old_content(4 + size(field_names))
    real(wp) :: times(3), old_times(3)
    logical :: are_kept
    call archive%agree('fields.', run%plan%fields, are_kept)
    if (.not. run%plan%fields) return
    associate (r => run%model%requests%field, fields => run%fields)
      content = [merge(one, zero, [r%single, r%wanted]), real(size(fields%cell), wp), &
          sum(real(fields%cell, wp)), sum(real(fields%cell, wp)**2)]
      times = [r%interval, r%begin, r%end]
      old_content = content
      old_times = zero
      if (are_kept) then
        old_times = times
        call archive%exchange('fields.content', old_content)
        call archive%exchange('fields.times', old_times)
        call exchange_counts(archive, fields)
      end if
      if (archive%mode == archive_save) return
      if (any(abs(times - old_times) > zero)) then
        fields%next = zero
        if (told >= r%begin - 1.0e-9_wp*run%model%controls%dt) &
            fields%next = next_due(r%interval, told, run%model%controls%dt)
      end if
      if (.not. are_kept) fields%segment = next_segment(run%folder)
      if (.not. any(abs(content - old_content) > zero)) return
      call add_message(run%notes, '', 'restart: frames hold other fields from here on; '// &
          'fields.xdmf shows these, the others stay in the field files before '// &
          segment_name(fields%segment))
      fields%frames = 0
    end associate
  end subroutine exchange_frames

  !> Numbers, times and sizes of the frames so far.
  subroutine exchange_counts(archive, fields)
    type(archive_t), intent(inout) :: archive
    type(fields_t), intent(inout) :: fields
    integer :: counts(3)
    counts = [fields%frames, fields%segment, size(fields%bytes)]
    call archive%exchange('fields.counts', counts)
    call archive%exchange('fields.next', fields%next)
    fields%frames = counts(1)
    fields%segment = counts(2)
    if (archive%mode == archive_restore .and. fields%frames > size(fields%time)) then
      deallocate (fields%time, fields%segment_of)
      allocate (fields%time(2*fields%frames), fields%segment_of(2*fields%frames))
    end if
    if (archive%mode == archive_restore) then
      deallocate (fields%bytes)
      allocate (fields%bytes(counts(3)))
    end if
    call archive%exchange('fields.bytes', fields%bytes)
    call archive%exchange('fields.time', fields%time(:fields%frames))
    call archive%exchange('fields.segment_of', fields%segment_of(:fields%frames))
  end subroutine exchange_counts

  !> Fails where a field file of the run so far is not as it was any more.
  subroutine check_segments(run, status)
    type(run_t), intent(in) :: run
    type(status_t), intent(inout) :: status
    character(:), allocatable :: path
    integer :: k
    if (failed(status)) return
    do k = run%fields%segment - size(run%fields%bytes), run%fields%segment - 1
      path = join_path(run%folder, segment_name(k))
      if (.not. file_exists(path)) then
        call fail(status, status_file, 'cannot go on: "'//path// &
            '" of the run so far is missing')
      else if (file_size(path) /= &
          nint(run%fields%bytes(k + 1 - run%fields%segment + size(run%fields%bytes)), i8)) then
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
    integer :: k
    call list_files(folder, 'fields.*.vtkhdf', paths)
    do k = 1, size(paths)
      if (segment_number(paths(k)) >= first) call remove_file(trim(paths(k)))
    end do
    if (first == 0) call remove_file(join_path(folder, 'fields.xdmf'))
  end subroutine remove_segments

  !> The number of a field file by its path, -1 where it has none.
  pure integer function segment_number(path)
    character(*), intent(in) :: path
    integer :: ios, at
    at = index(path, '/fields.', back=.true.) + 8
    read (path(at:index(path, '.vtkhdf', back=.true.) - 1), *, iostat=ios) segment_number
    if (ios /= 0) segment_number = -1
  end function segment_number

  !> The number after those of all field files of a folder.
  integer function next_segment(folder)
    character(*), intent(in) :: folder
    character(path_length), allocatable :: paths(:)
    integer :: k
    next_segment = 0
    call list_files(folder, 'fields.*.vtkhdf', paths)
    do k = 1, size(paths)
      next_segment = max(next_segment, segment_number(paths(k)) + 1)
    end do
  end function next_segment

end module run_frames
