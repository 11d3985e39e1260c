! SPDX-License-Identifier: BSD-3-Clause
!> The command line.
module run_arguments
  use base_status, only: status_t, fail, failed, status_file
  use deck_parameter, only: override_t
  implicit none
  private

  type, public :: arguments_t
    character(:), allocatable :: deck
    character(:), allocatable :: folder
    character(:), allocatable :: restart     !< a file, or "latest"
    type(override_t), allocatable :: override(:)
    integer :: threads = 0                   !< 0 = as the deck says
    logical :: check = .false., plan = .false., quiet = .false.
    logical :: keywords = .false., help = .false., version = .false.
  end type arguments_t

  public :: read_arguments, command_to_go_on

contains

  !> Reads the arguments of the program; fails on one that is unknown or incomplete.
  subroutine read_arguments(arguments, status)
    type(arguments_t), intent(out) :: arguments
    type(status_t), intent(inout) :: status
    character(:), allocatable :: word
    integer :: k
    allocate (arguments%override(0))
    k = 1
    do while (k <= command_argument_count() .and. .not. failed(status))
      word = argument(k)
      select case (word)
      case ('-o', '-D', '--restart', '--threads')
        k = k + 1
        if (k > command_argument_count()) then
          call fail(status, status_file, word//' needs a value', hint='bipact --help')
        else if (word == '-o') then
          arguments%folder = argument(k)
        else if (word == '--restart') then
          arguments%restart = argument(k)
        else if (word == '--threads') then
          call read_threads(argument(k), arguments%threads, status)
        else
          call add_override(arguments, argument(k), status)
        end if
      case ('--check')
        arguments%check = .true.
      case ('--plan')
        arguments%plan = .true.
      case ('--quiet')
        arguments%quiet = .true.
      case ('--keywords')
        arguments%keywords = .true.
      case ('--help', '-h')
        arguments%help = .true.
      case ('--version')
        arguments%version = .true.
      case default
        if (index(word, '-D') == 1 .and. len(word) > 2) then
          call add_override(arguments, word(3:), status)
        else if (word(1:min(1, len(word))) == '-') then
          call fail(status, status_file, 'unknown option "'//word//'"', hint='bipact --help')
        else if (allocated(arguments%deck)) then
          call fail(status, status_file, 'more than one deck: "'//arguments%deck//'" and "'// &
              word//'"', hint='bipact --help')
        else
          arguments%deck = word
        end if
      end select
      k = k + 1
    end do
    if (allocated(arguments%deck) .or. arguments%keywords .or. arguments%help &
        .or. arguments%version) return
    call fail(status, status_file, 'no deck given', hint='bipact DECK; bipact --help')
  end subroutine read_arguments

  !> A number of threads.
  subroutine read_threads(text, threads, status)
    character(*), intent(in) :: text
    integer, intent(inout) :: threads
    type(status_t), intent(inout) :: status
    integer :: ios
    ios = 1
    if (len(text) > 0 .and. len(text) < 10 .and. verify(text, '0123456789') == 0) &
        read (text, *, iostat=ios) threads
    if (ios == 0 .and. threads >= 1 .and. threads <= 1024) return
    call fail(status, status_file, '--threads needs a number from 1 to 1024, found "'// &
        text//'"', hint='bipact --help')
  end subroutine read_threads

  function argument(k) result(text)
    integer, intent(in) :: k
    character(:), allocatable :: text
    integer :: length
    call get_command_argument(k, length=length)
    allocate (character(length) :: text)
    call get_command_argument(k, text)
  end function argument

  !> The command line of this run with --restart latest, in words that a shell takes.
  function command_to_go_on() result(command)
    character(:), allocatable :: command
    integer :: k
    command = quoted(argument(0))
    k = 1
    do while (k <= command_argument_count())
      if (argument(k) == '--restart') then
        k = k + 1
      else
        command = command//' '//quoted(argument(k))
      end if
      k = k + 1
    end do
    command = command//' --restart latest'
  end function command_to_go_on

  !> A word for a shell: in single quotes where a letter could mean something to it.
  pure function quoted(word) result(text)
    character(*), intent(in) :: word
    character(:), allocatable :: text
    character(*), parameter :: plain = '0123456789_./=+,:@%-'// &
        'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ'
    integer :: k
    text = word
    if (len(word) > 0 .and. verify(word, plain) == 0) return
    text = "'"
    do k = 1, len(word)
      if (word(k:k) == "'") then
        text = text//"'\''"
      else
        text = text//word(k:k)
      end if
    end do
    text = text//"'"
  end function quoted

  subroutine add_override(arguments, text, status)
    type(arguments_t), intent(inout) :: arguments
    character(*), intent(in) :: text
    type(status_t), intent(inout) :: status
    integer :: equal
    equal = index(text, '=')
    if (equal < 2 .or. equal == len(text) .or. equal > 11 .or. len(text) - equal > 24) then
      call fail(status, status_file, 'expected -D name=value with a name of 1 to 9 and a '// &
          'value of 1 to 24 characters, found "'//text//'"')
      return
    end if
    arguments%override = [arguments%override, &
        override_t(name=text(1:equal - 1), value=text(equal + 1:))]
  end subroutine add_override

end module run_arguments
