! SPDX-License-Identifier: BSD-3-Clause
!> Contact problems of FCLIB files: the local form as it is, the global form M v = H r + f, u =
!> H' v + w condensed to W = H' M^-1 H, q = H' M^-1 f + w.
module fclib_problem
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use base_kinds, only: wp, zero
  use base_status, only: status_t, fail, failed, status_deck
  use base_strings, only: to_text
  use cone_blocks, only: delassus_blocks_t, blocks_from_rows, blocks_from_dense
  use hdf5_file, only: file_t, open_file, create_file, close_file, has_path, read_integers, &
      read_reals, make_group, write_integers, write_reals
  use fclib_matrix, only: matrix_t, read_matrix, transposed, complete_half, from_triplets
  use fclib_text, only: is_text_problem, read_text_problem
  use linalg_dense, only: solve_general
  implicit none
  private
  public :: read_problem, write_problem, write_solution

  type, public :: problem_t
    integer :: d = 0, contacts = 0
    character(:), allocatable :: form            !< fclib_local, fclib_global
    type(delassus_blocks_t) :: w
    real(wp), allocatable :: q(:, :), mu(:)
    ! global form only
    type(matrix_t) :: mass, h
    real(wp), allocatable :: force(:)
  end type problem_t

  !> Unknowns of one body up to which its mass matrix is solved as a dense one.
  integer, parameter :: largest_body = 6000

contains

  !> Reads a problem; fails on what is missing, of wrong size, out of range or no number.
  subroutine read_problem(name, problem, status)
    character(*), intent(in) :: name
    type(problem_t), intent(out) :: problem
    type(status_t), intent(inout) :: status
    type(file_t) :: file
    if (is_text_problem(name)) then
      call read_text(name, problem, status)
      return
    end if
    call open_file(name, file, status)
    if (.not. failed(status)) then
      if (has_path(file, '/fclib_local')) then
        problem%form = '/fclib_local'
      else if (has_path(file, '/fclib_global')) then
        problem%form = '/fclib_global'
      else
        call fail(status, status_deck, name//': neither /fclib_local nor /fclib_global', &
            hint='rolling friction (fclib_global_rolling) is not solved here')
      end if
    end if
    if (.not. failed(status)) call read_form(file, problem, status)
    call close_file(file)
  end subroutine read_problem

  subroutine read_text(name, problem, status)
    character(*), intent(in) :: name
    type(problem_t), intent(inout) :: problem
    type(status_t), intent(inout) :: status
    real(wp), allocatable :: w(:, :)
    problem%form = '/fclib_local'
    call read_text_problem(name, w, problem%q, problem%mu, status)
    if (failed(status)) return
    problem%d = size(problem%q, 1)
    problem%contacts = size(problem%mu)
    call blocks_from_dense(w, problem%d, problem%w)
  end subroutine read_text

  !> The problem in local form, W by rows.
  subroutine write_problem(name, problem, status)
    character(*), intent(in) :: name
    type(problem_t), intent(in) :: problem
    type(status_t), intent(inout) :: status
    type(file_t) :: file
    integer, allocatable :: p(:), i(:)
    real(wp), allocatable :: x(:)
    integer :: a, j, k, m, n, d
    d = problem%d
    n = size(problem%w%block)
    allocate (p(d*problem%contacts + 1), i(n), x(n))
    n = 0
    p(1) = 0
    do a = 1, problem%contacts
      do j = 1, d
        do k = problem%w%first(a), problem%w%first(a + 1) - 1
          i(n + 1:n + d) = [(d*(problem%w%column(k) - 1) + m, m=0, d - 1)]
          x(n + 1:n + d) = problem%w%block(j, :, k)
          n = n + d
        end do
        p(d*(a - 1) + j + 1) = n
      end do
    end do
    call create_file(name, file, status)
    if (failed(status)) return
    call make_group(file, '/fclib_local', status)
    call make_group(file, '/fclib_local/W', status)
    call make_group(file, '/fclib_local/vectors', status)
    call write_integers(file, '/fclib_local/spacedim', [d], status)
    call write_integers(file, '/fclib_local/W/m', [size(p) - 1], status)
    call write_integers(file, '/fclib_local/W/n', [size(p) - 1], status)
    call write_integers(file, '/fclib_local/W/nzmax', [n], status)
    call write_integers(file, '/fclib_local/W/nz', [-2], status)
    call write_integers(file, '/fclib_local/W/p', p, status)
    call write_integers(file, '/fclib_local/W/i', i(:n), status)
    call write_reals(file, '/fclib_local/W/x', x(:n), status)
    call write_reals(file, '/fclib_local/vectors/mu', problem%mu, status)
    call write_reals(file, '/fclib_local/vectors/q', reshape(problem%q, [size(problem%q)]), &
        status)
    call close_file(file)
  end subroutine write_problem

  subroutine read_form(file, problem, status)
    type(file_t), intent(in) :: file
    type(problem_t), intent(inout) :: problem
    type(status_t), intent(inout) :: status
    type(matrix_t) :: w
    real(wp), allocatable :: q(:)
    integer, allocatable :: d(:)
    call read_integers(file, problem%form//'/spacedim', d, status, 1)
    call read_reals(file, problem%form//'/vectors/mu', problem%mu, status, 1)
    if (failed(status)) return
    problem%d = d(1)
    problem%contacts = size(problem%mu)
    if (d(1) /= 2 .and. d(1) /= 3) call fail(status, status_deck, file%name// &
        ': spacedim is '//to_text(d(1))//'; 2 and 3 are solved here')
    if (.not. all(ieee_is_finite(problem%mu))) then
      call fail(status, status_deck, file%name//': mu is not finite (NaN or Inf)')
    else if (any(problem%mu < zero)) then
      call fail(status, status_deck, file%name//': mu holds a negative number')
    end if
    if (has_path(file, problem%form//'/G')) call fail(status, status_deck, file%name// &
        ': equality constraints (G, b) are not solved here')
    if (failed(status)) return
    if (problem%form == '/fclib_local') then
      call read_matrix(file, problem%form//'/W', w, status)
      call read_reals(file, problem%form//'/vectors/q', q, status, d(1)*problem%contacts)
    else
      call read_global(file, problem, w, q, status)
    end if
    if (failed(status)) return
    if (w%rows /= size(q) .or. w%columns /= size(q) .or. size(q) /= d(1)*problem%contacts) &
        call fail(status, status_deck, file%name//': W is '//to_text(w%rows)//' x '// &
        to_text(w%columns)//', q holds '//to_text(size(q))//' for '// &
        to_text(problem%contacts)//' contacts')
    if (.not. all(ieee_is_finite(q))) call fail(status, status_deck, file%name// &
        ': q holds numbers that are not finite (NaN or Inf)')
    if (failed(status)) return
    problem%q = reshape(q, [d(1), problem%contacts])
    call blocks_from_rows(d(1), w%first, w%column, w%value, problem%w)
    call check_diagonal(file, problem, status)
  end subroutine read_form

  !> W_aa of each contact must have a positive diagonal, or nothing can be pushed.
  subroutine check_diagonal(file, problem, status)
    type(file_t), intent(in) :: file
    type(problem_t), intent(in) :: problem
    type(status_t), intent(inout) :: status
    integer :: a, j
    do a = 1, problem%contacts
      do j = 1, problem%d
        if (problem%w%block(j, j, problem%w%diagonal(a)) > zero) cycle
        call fail(status, status_deck, file%name//': W has no positive diagonal at contact '// &
            to_text(a)//', direction '//to_text(j))
        return
      end do
    end do
  end subroutine check_diagonal

  !> Condenses the global form, body by body: bodies are the groups of unknowns that M connects.
  subroutine read_global(file, problem, w, q, status)
    type(file_t), intent(in) :: file
    type(problem_t), intent(inout) :: problem
    type(matrix_t), intent(out) :: w
    real(wp), allocatable, intent(out) :: q(:)
    type(status_t), intent(inout) :: status
    real(wp), allocatable :: v(:, :)
    type(matrix_t) :: columns
    call read_matrix(file, problem%form//'/M', problem%mass, status)
    call read_matrix(file, problem%form//'/H', problem%h, status)
    if (failed(status)) return
    call read_reals(file, problem%form//'/vectors/f', problem%force, status, problem%mass%rows)
    call read_reals(file, problem%form//'/vectors/w', q, status, problem%h%columns)
    if (problem%mass%rows /= problem%mass%columns .or. problem%h%rows /= problem%mass%rows &
        .or. problem%h%columns /= problem%d*problem%contacts) call fail(status, status_deck, &
        file%name//': the sizes of M, H and mu do not fit')
    if (failed(status)) return
    call complete_half(problem%mass)
    call condense(file, problem, w, status)
    if (failed(status)) return
    allocate (v(problem%mass%rows, 1))
    v(:, 1) = problem%force
    call solve_mass(problem%mass, v, status)
    call transposed(problem%h, columns)
    q = q(:problem%h%columns) + product_of(columns, v(:, 1))
  end subroutine read_global

  pure function product_of(matrix, x) result(y)
    type(matrix_t), intent(in) :: matrix
    real(wp), intent(in) :: x(:)
    real(wp) :: y(matrix%rows)
    integer :: i, k
    y = zero
    do i = 1, matrix%rows
      do k = matrix%first(i), matrix%first(i + 1) - 1
        y(i) = y(i) + matrix%value(k)*x(matrix%column(k))
      end do
    end do
  end function product_of

  !> W = H' M^-1 H as rows: for each body the columns of H that it has, solved together.
  subroutine condense(file, problem, w, status)
    type(file_t), intent(in) :: file
    type(problem_t), intent(in) :: problem
    type(matrix_t), intent(out) :: w
    type(status_t), intent(inout) :: status
    integer, allocatable :: body(:), list(:), used(:), row(:), column(:), place(:)
    real(wp), allocatable :: value(:), part(:, :), x(:, :), small(:, :)
    integer :: bodies, b, i, k, n
    call find_bodies(problem%mass, body, bodies)
    allocate (row(0), column(0), value(0), place(problem%h%columns))
    do b = 1, bodies
      list = pack([(i, i=1, size(body))], body == b)
      if (size(list) > largest_body) call fail(status, status_deck, file%name// &
          ': a body of '//to_text(size(list))//' unknowns is too large to condense')
      if (failed(status)) return
      place = 0
      do i = 1, size(list)
        place(problem%h%column(problem%h%first(list(i)):problem%h%first(list(i) + 1) - 1)) = 1
      end do
      used = pack([(i, i=1, size(place))], place > 0)
      if (size(used) == 0) cycle
      place(used) = [(i, i=1, size(used))]
      allocate (part(size(list), size(used)))
      part = zero
      do i = 1, size(list)
        do k = problem%h%first(list(i)), problem%h%first(list(i) + 1) - 1
          associate (entry => part(i, place(problem%h%column(k))))
            entry = entry + problem%h%value(k)
          end associate
        end do
      end do
      x = part
      call solve_body(problem%mass, list, x, status)
      if (failed(status)) return
      small = matmul(transpose(part), x)
      n = size(used)
      row = [row, [(used, i=1, n)]]
      column = [column, [(spread(used(i), 1, n), i=1, n)]]
      value = [value, reshape(small, [n*n])]
      deallocate (part)
    end do
    call from_triplets(problem%h%columns, problem%h%columns, row, column, value, w)
  end subroutine condense

  !> body(i) = number of the group of unknowns that i belongs to.
  subroutine find_bodies(mass, body, bodies)
    type(matrix_t), intent(in) :: mass
    integer, allocatable, intent(out) :: body(:)
    integer, intent(out) :: bodies
    type(matrix_t) :: columns
    integer, allocatable :: list(:)
    integer :: i, k, head, n
    call transposed(mass, columns)
    allocate (body(mass%rows), list(mass%rows))
    body = 0
    bodies = 0
    do i = 1, mass%rows
      if (body(i) > 0) cycle
      bodies = bodies + 1
      body(i) = bodies
      list(1) = i
      n = 1
      head = 1
      do while (head <= n)
        do k = mass%first(list(head)), mass%first(list(head) + 1) - 1
          if (abs(mass%value(k)) > zero) call reach(mass%column(k))
        end do
        do k = columns%first(list(head)), columns%first(list(head) + 1) - 1
          if (abs(columns%value(k)) > zero) call reach(columns%column(k))
        end do
        head = head + 1
      end do
    end do

  contains

    subroutine reach(j)
      integer, intent(in) :: j
      if (body(j) > 0) return
      body(j) = bodies
      n = n + 1
      list(n) = j
    end subroutine reach

  end subroutine find_bodies

  !> x = M^-1 x for the unknowns `list` of one body.
  subroutine solve_body(mass, list, x, status)
    type(matrix_t), intent(in) :: mass
    integer, intent(in) :: list(:)
    real(wp), intent(inout) :: x(:, :)
    type(status_t), intent(inout) :: status
    real(wp), allocatable :: dense(:, :)
    integer, allocatable :: place(:), pivot(:)
    integer :: i, k
    logical :: ok
    allocate (dense(size(list), size(list)), place(mass%rows), pivot(size(list)))
    place = 0
    place(list) = [(i, i=1, size(list))]
    dense = zero
    do i = 1, size(list)
      do k = mass%first(list(i)), mass%first(list(i) + 1) - 1
        if (place(mass%column(k)) == 0) cycle
        dense(i, place(mass%column(k))) = dense(i, place(mass%column(k))) + mass%value(k)
      end do
    end do
    call solve_general(size(list), dense, x, pivot, ok)
    if (.not. ok) call fail(status, status_deck, 'M is singular')
  end subroutine solve_body

  !> x = M^-1 x, body by body.
  subroutine solve_mass(mass, x, status)
    type(matrix_t), intent(in) :: mass
    real(wp), intent(inout) :: x(:, :)
    type(status_t), intent(inout) :: status
    integer, allocatable :: body(:), list(:)
    real(wp), allocatable :: part(:, :)
    integer :: bodies, b, i
    call find_bodies(mass, body, bodies)
    do b = 1, bodies
      list = pack([(i, i=1, size(body))], body == b)
      part = x(list, :)
      call solve_body(mass, list, part, status)
      if (failed(status)) return
      x(list, :) = part
    end do
  end subroutine solve_mass

  !> /solution with u, r, l (empty) and, for the global form, v; the problem's sizes beside it.
  subroutine write_solution(name, problem, r, u, errors, status)
    character(*), intent(in) :: name
    type(problem_t), intent(in) :: problem
    real(wp), intent(in) :: r(:, :), u(:, :)
    real(wp), intent(in) :: errors(3)            !< error, error2018, eta
    type(status_t), intent(inout) :: status
    type(file_t) :: file
    real(wp), allocatable :: v(:, :)
    call create_file(name, file, status)
    if (failed(status)) return
    call make_group(file, '/solution', status)
    call write_reals(file, '/solution/r', reshape(r, [size(r)]), status)
    call write_reals(file, '/solution/u', reshape(u, [size(u)]), status)
    if (problem%form == '/fclib_global') then
      allocate (v(problem%mass%rows, 1))
      v(:, 1) = problem%force(:problem%mass%rows) + product_of(problem%h, reshape(r, [size(r)]))
      call solve_mass(problem%mass, v, status)
      call write_reals(file, '/solution/v', v(:, 1), status)
    end if
    call make_group(file, '/errors', status)
    call write_reals(file, '/errors/error', errors(1:1), status)
    call write_reals(file, '/errors/error2018', errors(2:2), status)
    call write_reals(file, '/errors/eta', errors(3:3), status)
    call write_integers(file, '/errors/spacedim', [problem%d], status)
    call close_file(file)
  end subroutine write_solution

end module fclib_problem
