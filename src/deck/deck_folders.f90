! SPDX-License-Identifier: BSD-3-Clause
!> Where included files are looked for: *INCLUDE_PATH, *INCLUDE_PATH_RELATIVE, and names of
!> files on cards.
module deck_folders
  use base_strings, only: folder_of, join_path
  use deck_data, only: deck_t
  use deck_problems, only: line_t
  use deck_source, only: cursor_t, next_line
  implicit none
  private
  public :: read_folders, read_file_name, find_include

contains

  !> *INCLUDE_PATH: folders, one a line, absolute or relative to the current folder;
  !> *INCLUDE_PATH_RELATIVE: relative to the file that names them.
  subroutine read_folders(deck, cursor, name, more)
    type(deck_t), intent(inout) :: deck
    type(cursor_t), intent(inout) :: cursor
    character(*), intent(in) :: name
    logical, intent(out) :: more
    type(line_t), allocatable :: longer(:)
    character(:), allocatable :: folder
    if (.not. allocated(deck%folder)) allocate (deck%folder(0))
    more = next_line(deck%file(cursor%file), cursor)
    do while (more)
      associate (line => deck%file(cursor%file)%text(cursor%first:cursor%last))
        if (line(1:min(1, len(line))) == '*') return
      end associate
      call read_file_name(deck, cursor, folder, more)
      if (len(folder) > 0) then
        if (folder(len(folder):) == '/' .and. len(folder) > 1) folder = folder(:len(folder) - 1)
        if (name == 'INCLUDE_PATH_RELATIVE') &
            folder = join_path(folder_of(deck%file(cursor%file)%path), folder)
        allocate (longer(size(deck%folder) + 1))
        longer(:size(deck%folder)) = deck%folder
        longer(size(longer))%text = folder
        call move_alloc(longer, deck%folder)
      end if
      if (more) more = next_line(deck%file(cursor%file), cursor)
    end do
  end subroutine read_folders

  !> The name at the cursor; " +" at the end of a line continues it on the next, to which the
  !> cursor moves.
  subroutine read_file_name(deck, cursor, name, more)
    type(deck_t), intent(in) :: deck
    type(cursor_t), intent(inout) :: cursor
    character(:), allocatable, intent(out) :: name
    logical, intent(inout) :: more
    integer :: n
    name = trim(adjustl(deck%file(cursor%file)%text(cursor%first:cursor%last)))
    do
      n = len(name)
      if (n < 3 .or. .not. more) return
      if (name(n - 1:) /= ' +') return
      more = next_line(deck%file(cursor%file), cursor)
      if (more) name = trim(name(1:n - 2))// &
          trim(adjustl(deck%file(cursor%file)%text(cursor%first:cursor%last)))
    end do
  end subroutine read_file_name

  !> Path of a file that another one includes: beside that one, then in the folders of
  !> *INCLUDE_PATH in their order; where none has it, the first place.
  function find_include(deck, file, name) result(path)
    type(deck_t), intent(in) :: deck
    integer, intent(in) :: file
    character(*), intent(in) :: name
    character(:), allocatable :: path
    integer :: k
    logical :: found
    path = join_path(folder_of(deck%file(file)%path), name)
    if (.not. allocated(deck%folder)) return
    inquire (file=path, exist=found)
    do k = 1, size(deck%folder)
      if (found) return
      path = join_path(deck%folder(k)%text, name)
      inquire (file=path, exist=found)
    end do
    if (.not. found) path = join_path(folder_of(deck%file(file)%path), name)
  end function find_include

end module deck_folders
