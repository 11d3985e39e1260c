! SPDX-License-Identifier: BSD-3-Clause
!> Elements that share a stiffness matrix: only those whose own has the same bits, and no digit
!> of a product differs from that with a matrix for each element.
program test_classes
  use assembly_blocks, only: find_stiffness, stored_at
  use assembly_classes, only: classes_t, finish_classes
  use assembly_forces, only: subtract_internal_force, subtract_element_forces, &
      strain_product, element_product
  use assembly_system, only: system_t, effective_matrix
  use base_kinds, only: wp, i8, zero, one
  use base_status, only: status_t, failed
  use base_strings, only: to_text
  use check, only: test_start, test_end, check_true, check_equal, seed_random
  use deck_parameter, only: override_t
  use linalg_graph, only: block_matrix_t
  use run_data, only: run_t
  use run_setup, only: read_scene, set_up
  implicit none
  integer, parameter :: side = 60      ! elements of each block along and across

  call test_start('classes')
  call seed_random(41)
  call test_sorting()
  call test_scene('13', 'in the plane')
  call test_scene('15', 'turned about an axis')
  call test_end()

contains

  !> Many times, as keys may differ by chance.
  subroutine test_sorting()
    integer :: k, wrong
    wrong = 0
    do k = 1, 200
      wrong = wrong + faults_of(12, .false.) + faults_of(60, .true.)
    end do
    call check_equal(wrong, 0, 'matrices that are nearly the same')
  end subroutine test_sorting

  !> Wrong matrices of n elements that each have one of five: one by chance, the same turned by
  !> a right angle, of another thickness, with another last bit, with -0 in place of 0.
  integer function faults_of(n, kept) result(wrong)
    integer, intent(in) :: n
    logical, intent(in) :: kept       !< Are the classes few enough?
    type(classes_t) :: classes
    real(wp) :: kind(6, 6, 5), chance
    real(wp), allocatable :: k(:, :, :)
    integer, allocatable :: class(:)
    integer :: of(n), e, at
    call random_number(kind(:, :, 1))
    kind(2, 5, 1) = zero
    kind(:, :, 2) = kind([3, 4, 5, 6, 1, 2], [3, 4, 5, 6, 1, 2], 1)
    kind(:, :, 3) = 2.0_wp*kind(:, :, 1)
    kind(:, :, 4) = kind(:, :, 1)
    kind(6, 6, 4) = nearest(kind(6, 6, 4), one)
    kind(:, :, 5) = kind(:, :, 1)
    kind(2, 5, 5) = -zero
    allocate (k(6, 6, n), class(n))
    call classes%begin(n)
    do e = 1, n
      call random_number(chance)
      of(e) = min(e, 1 + int(5*chance))
      call classes%add(kind(:, :, of(e)), k, class(e))
    end do
    wrong = abs(classes%n - count([(any(of == e), e=1, 5)]))
    call finish_classes(classes%n, k, class)
    if (allocated(class) .neqv. kept) wrong = wrong + 1
    do e = 1, n
      at = e
      if (allocated(class)) at = class(e)
      if (.not. same_bits(k(:, :, at), kind(:, :, of(e)))) wrong = wrong + 1
    end do
  end function faults_of

  pure logical function same_bits(a, b)
    real(wp), intent(in) :: a(:, :), b(:, :)
    same_bits = all(transfer(a, 0_i8, size(a)) == transfer(b, 0_i8, size(b)))
  end function same_bits

  !> Blocks of high and wide elements, of another thickness, another material, triangles, and
  !> one with disturbed nodes.
  subroutine test_scene(form, name)
    character(*), intent(in) :: form, name
    character(500) :: folder
    type(run_t) :: run
    type(override_t) :: overrides(0)
    type(status_t) :: status
    type(system_t) :: own
    real(wp), allocatable :: k(:, :, :)
    integer :: b, e, wrong
    call get_environment_variable('TMP', folder)
    call write_deck(trim(folder)//'/classes.k', form)
    call read_scene(trim(folder)//'/classes.k', overrides, run, status)
    call set_up(run, status)
    call check_true(.not. failed(status), name//': set up')
    own = run%system
    call check_equal(size(own%block), 5, name//': blocks')
    do b = 1, size(own%block)
      associate (block => run%system%block(b))
        call check_true(allocated(block%class) .eqv. b < 5, name//': classes of block '// &
            to_text(b))
        if (b < 5) call check_true(size(block%stiffness, 3) <= size(block%node, 2)/8, &
            name//': few classes')
        call find_stiffness(run%model, block, 1, size(block%node, 2), own%block(b)%stiffness)
        if (allocated(own%block(b)%class)) deallocate (own%block(b)%class)
        k = own%block(b)%stiffness
        wrong = 0
        do e = 1, size(k, 3)
          if (.not. same_bits(k(:, :, e), block%stiffness(:, :, stored_at(block, e)))) &
              wrong = wrong + 1
        end do
        call check_equal(wrong, 0, name//': matrices of block '//to_text(b))
      end associate
    end do
    call compare(run%system, own, name)
  end subroutine test_scene

  !> Products with classes and with the own matrix of each element.
  subroutine compare(shared, own, name)
    type(system_t), intent(inout) :: shared
    type(system_t), intent(in) :: own
    character(*), intent(in) :: name
    type(block_matrix_t) :: one_matrix, other
    real(wp), dimension(2, own%n) :: u, f, g
    integer :: threads, e, wrong
    call random_number(u)
    call effective_matrix(shared, zero, zero, zero, one, one_matrix)
    call effective_matrix(own, zero, zero, zero, one, other)
    call check_true(all(abs(one_matrix%value - other%value) <= zero), name//': matrix')
    f = zero
    call subtract_internal_force(own, 1.7_wp, u, f)
    g = assembled(own, other, -1.7_wp*u)
    call check_true(maxval(abs(f - g)) < 1.0e-12_wp*maxval(abs(other%value)), &
        name//': the assembled matrix')
    do threads = 1, 4
      shared%threads = threads
      g = zero
      call subtract_internal_force(shared, 1.7_wp, u, g)
      call check_true(all(abs(f - g) <= zero), name//': '//to_text(threads)//' threads')
    end do
    shared%threads = 1
    call subtract_element_forces(own, [(e, e=1, size(own%block_of), 7)], one, u, f)
    call subtract_element_forces(shared, [(e, e=1, size(own%block_of), 7)], one, u, g)
    call check_true(all(abs(f - g) <= zero), name//': some elements')
    wrong = 0
    do e = 1, size(own%block_of)
      if (abs(element_product(own, e, u) - element_product(shared, e, u)) > zero) &
          wrong = wrong + 1
    end do
    call check_equal(wrong, 0, name//': energies of elements')
    call check_true(abs(strain_product(own, u) - strain_product(shared, u)) <= zero, &
        name//': energy')
  end subroutine compare

  !> The product with a matrix in blocks.
  function assembled(system, matrix, u) result(f)
    type(system_t), intent(in) :: system
    type(block_matrix_t), intent(in) :: matrix
    real(wp), intent(in) :: u(:, :)
    real(wp) :: f(2, system%n)
    integer :: i, k
    f = zero
    do i = 1, system%n
      do k = system%graph%first(i), system%graph%first(i + 1) - 1
        f(:, i) = f(:, i) + matmul(matrix%value(:, :, k), u(:, system%graph%column(k)))
      end do
    end do
  end function assembled

  subroutine write_deck(path, form)
    character(*), intent(in) :: path, form
    integer :: unit, b, i, j, n
    real(wp) :: x(2), shift(2)
    open (newunit=unit, file=path, action='write', status='replace')
    write (unit, '(a)') '*KEYWORD', '*CONTROL_TERMINATION', '       0.1', &
        '*CONTROL_IMPLICIT_GENERAL', '         1      0.01', &
        '*CONTROL_IMPLICIT_DYNAMICS', '         1', '*BIPACT_TIME', '     THETA', &
        '*SECTION_SHELL', '         1'//repeat(' ', 8)//form, '       1.0', &
        '         2'//repeat(' ', 8)//form, merge('       1.5', '       1.0', form == '13'), &
        '*MAT_ELASTIC', '         1       1.0       1.0       0.3', &
        '*MAT_ELASTIC', '         2       1.0       2.0       0.3'
    do b = 1, 5
      write (unit, '(a, /, a, i0, /, 3i10)') '*PART', 'block ', b, b, merge(2, 1, b == 2), &
          merge(2, 1, b == 3)
    end do
    write (unit, '(a)') '*NODE'
    n = side + 1
    do b = 1, 5
      do j = 0, side
        do i = 0, side
          call random_number(shift)
          x = [0.1_wp*i + 0.1_wp*max(0, i - side/2), 0.2_wp*j - 0.1_wp*max(0, j - side/2)]
          if (b == 5) x = x + 0.02_wp*shift
          write (unit, '(i8, 2f16.10, a)') ((b - 1)*n + j)*n + i + 1, x(1) + one, &
              x(2) + 20.0_wp*b, '             0.0'
        end do
      end do
    end do
    write (unit, '(a)') '*ELEMENT_SHELL'
    do b = 1, 5
      do j = 1, side
        do i = 1, side
          associate (at => ((b - 1)*n + j - 1)*n + i, e => ((b - 1)*side + j)*2*side + 2*i)
            if (b == 4) then
              write (unit, '(6i8)') e, b, at, at + 1, at + n, at + n
              write (unit, '(6i8)') e + 1, b, at + 1, at + n + 1, at + n, at + n
            else
              write (unit, '(6i8)') e, b, at, at + 1, at + n + 1, at + n
            end if
          end associate
        end do
      end do
    end do
    write (unit, '(a)') '*END'
    close (unit)
  end subroutine write_deck

end program test_classes
