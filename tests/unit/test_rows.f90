! SPDX-License-Identifier: BSD-3-Clause
!> Rows of contact in the plane and in space, made up, with a made-up flexibility: H and its
!> transpose, resultants and moments, W, works, reactions that are carried over.
program test_rows
  use base_kinds, only: wp, zero, one
  use base_status, only: status_t, failed, status_text
  use base_strings, only: to_text
  use check, only: test_start, test_end, check_true, check_close, check_equal, seed_random
  use cone_solver, only: solve_cone
  use cone_types, only: certificate_t, contact_open
  use contact_condense, only: build_w, constrain_interface, clear_constrained
  use contact_kinematics, only: relative_displacement, row_force, add_row_force, row_of_h
  use contact_law, only: law_misses
  use contact_rows, only: rows_t, start_rows, add_row, copy_rows, carry_reactions, &
      find_slots, same_geometry, tangents_of, row_edge
  use contact_rule, only: contact_rule_t, level_pressed
  use contact_stage, only: solve_contact
  use contact_types, only: contact_t
  use contact_work, only: contact_work_t, add_contact_step, subtract_contact_force
  use made_rows, only: nodes, fill_random, random_unit, add_rows, make_contact
  use model_data, only: model_t
  implicit none
  real(wp), parameter :: eps = epsilon(one)
  integer :: dim, d

  call test_start('rows')
  call seed_random(4711)
  call test_tangents()
  do dim = 2, 3
    call test_transpose(dim)
    call test_carried(dim)
    call test_constrained(dim)
    do d = 1, dim, dim - 1
      call test_w(dim, d)
      call test_works(dim, d)
    end do
    call test_impacts(dim)
  end do
  call test_plane_in_space()
  call test_turned()
  call test_end()

contains

  !> Orthonormal, of right hand, t1 in the plane of n and the axis after its largest component.
  subroutine test_tangents()
    real(wp) :: n(3), t(3, 2), b(3, 3), axis(3), off
    integer :: k, i, largest
    off = zero
    do k = 1, 10000
      n = random_unit(3)
      if (k <= 6) n = zero
      if (k <= 6) n(1 + mod(k, 3)) = merge(one, -one, k <= 3)
      t = tangents_of(n)
      b(:, 1) = n
      b(:, 2:) = t
      do i = 1, 3
        axis = matmul(transpose(b), b(:, i))
        axis(i) = axis(i) - one
        off = max(off, norm2(axis))
      end do
      off = max(off, abs(determinant(b) - one))
      largest = maxloc(abs(n), dim=1)
      axis = cshift([one, zero, zero], -mod(largest, 3))
      ! Across n and the axis there is nothing of t1, and it points to the axis.
      off = max(off, abs(dot_product(axis, t(:, 2))))
      call check_true(dot_product(axis, t(:, 1)) > 0.7_wp, 't1 follows the next axis')
    end do
    ! Products of unit vectors, t1 of at least 1/sqrt(2) before it is scaled.
    call check_close(off, zero, 16.0_wp*eps, 'tangents')
  end subroutine test_tangents

  pure real(wp) function determinant(b)
    real(wp), intent(in) :: b(3, 3)
    determinant = b(1, 1)*(b(2, 2)*b(3, 3) - b(2, 3)*b(3, 2)) &
        - b(1, 2)*(b(2, 1)*b(3, 3) - b(2, 3)*b(3, 1)) &
        + b(1, 3)*(b(2, 1)*b(3, 2) - b(2, 2)*b(3, 1))
  end function determinant

  !> H by its definition, from frames made here.
  function dense_h(rows, d) result(h)
    type(rows_t), intent(in) :: rows
    integer, intent(in) :: d
    real(wp) :: h(d*rows%n, rows%dim*nodes), frame(rows%dim, rows%dim)
    integer :: a, k, i, j, dim
    dim = rows%dim
    h = zero
    do a = 1, rows%n
      frame(:, 1) = rows%normal(:, a)
      if (dim == 2) frame(:, 2) = [-frame(2, 1), frame(1, 1)]
      if (dim == 3) frame(:, 2:3) = tangents_of(rows%normal(:, a))
      do k = rows%first(a), rows%first(a + 1) - 1
        do j = 1, d
          do i = 1, dim
            associate (entry => h(d*(a - 1) + j, dim*(rows%point(k) - 1) + i))
              entry = entry + rows%weight(k)*frame(i, j)
            end associate
          end do
        end do
      end do
    end do
  end function dense_h

  !> u = H x, rows of H, f = H' r; forces of a row sum to zero; their moment about any point is
  !> that of the force at the gap vector G = sum c_k x_k.
  subroutine test_transpose(dim)
    integer, intent(in) :: dim
    integer, parameter :: n = 60
    type(rows_t) :: rows
    real(wp) :: x(dim, nodes), f(dim, nodes), h(dim*n, dim*nodes), u(3), g(3), force(3)
    real(wp) :: moment(3), weight(27), off(4), r(dim, n)
    integer :: a, k, i, length, dof(27)
    call start_rows(rows, dim=dim)
    call add_rows(rows, n, 0.3_wp)
    call check_equal(rows%most_points, 9, 'points of the longest row')
    call fill_random(x)
    call fill_random(r)
    rows%r(:, :n) = r
    h = dense_h(rows, dim)
    off = zero
    do a = 1, n
      u = relative_displacement(rows, a, rows%point, x)
      off(1) = max(off(1), norm2(u(:dim) - matmul(h(dim*a - dim + 1:dim*a, :), &
          reshape(x, [dim*nodes]))))
      if (dim == 2) off(1) = max(off(1), abs(u(3)))
      do k = 1, dim
        call row_of_h(rows, a, k, dof, weight, length)
        off(2) = max(off(2), abs(dot_product(weight(:length), [(x(1 + mod(dof(i) - 1, dim), &
            (dof(i) - 1)/dim + 1), i=1, length)]) - u(k)))
      end do
      f = zero
      call add_row_force(rows, a, one, rows%point, f)
      off(3) = max(off(3), norm2(reshape(f, [dim*nodes]) - &
          matmul(r(:, a), h(dim*a - dim + 1:dim*a, :))))
      force = row_force(rows, a)
      if (rows%first(a + 1) > rows%first(a) + 1) off(3) = max(off(3), norm2(sum(f, dim=2)))
      moment = zero
      g = zero
      do k = rows%first(a), rows%first(a + 1) - 1
        g(:dim) = g(:dim) + rows%weight(k)*x(:, rows%point(k))
      end do
      do i = 1, nodes
        moment = moment + cross([x(:, i), zero], [f(:, i), zero])
      end do
      off(4) = max(off(4), norm2(moment - cross(g, force)))
    end do
    ! Sums of up to 9 terms of 1, and three of those.
    call check_close(off(1), zero, 32.0_wp*eps, label(dim, dim)//'u = H x')
    call check_close(off(2), zero, 32.0_wp*eps, label(dim, dim)//'rows of H')
    call check_close(off(3), zero, 32.0_wp*eps, label(dim, dim)//'f = H'' r, resultant')
    call check_close(off(4), zero, 64.0_wp*eps, label(dim, dim)//'moments')
  end subroutine test_transpose

  pure function cross(a, b) result(c)
    real(wp), intent(in) :: a(:), b(:)
    real(wp) :: c(3)
    c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function cross

  function label(dim, d)
    integer, intent(in) :: dim, d
    character(:), allocatable :: label
    label = 'dim '//to_text(dim)//', d = '//to_text(d)//': '
  end function label

  !> Reactions as vectors stay what they are when frames turn, also where lists change; those
  !> of new rows are none.
  subroutine test_carried(dim)
    integer, intent(in) :: dim
    integer, parameter :: n = 24
    type(rows_t) :: old, new, copy
    real(wp) :: n_new(dim), off, r(dim, n)
    integer :: a
    call start_rows(old, dim=dim)
    call start_rows(new, dim=dim)
    call start_rows(copy, dim=dim)
    call add_rows(old, n, 0.3_wp)
    call fill_random(r)
    old%r(:, :n) = r
    call copy_rows(old, copy)
    call check_true(same_geometry(old, copy), label(dim, dim)//'a copy is the same')
    old%r_previous(:, :n) = old%r(:, :n)
    do a = 2, n
      associate (p => old%point(old%first(a):old%first(a + 1) - 1), &
          w => old%weight(old%first(a):old%first(a + 1) - 1))
        n_new = old%normal(:, a)
        if (mod(a, 3) > 0) n_new = n_new + 0.3_wp*random_unit(dim)
        call add_row(new, old%key(:, a), p, w, n_new/norm2(n_new), zero, zero, one, row_edge, &
            zero)
      end associate
    end do
    call add_row(new, [1, 1, n + 1, -1], [1], [one], random_unit(dim), zero, zero, one, &
        row_edge, zero)
    call carry_reactions(old, new)
    off = zero
    do a = 1, n - 1
      off = max(off, norm2(row_force(new, a) - row_force(old, a + 1)))
      off = max(off, norm2(row_force(copy, a) - row_force(old, a)))
    end do
    call check_close(off, zero, 16.0_wp*eps, label(dim, dim)//'reactions as vectors')
    call check_true(.not. any(abs(new%r(:, n)) > zero), label(dim, dim)//'of a new row')
    call check_close(norm2(new%r_previous(:, :n - 1) - new%r(:, :n - 1)), zero, 8.0_wp*eps, &
        label(dim, dim)//'those before')
  end subroutine test_carried

  !> W = H S^-1 H' by whole matrices; with d = 1 its normal rows and columns.
  subroutine test_w(dim, d)
    integer, intent(in) :: dim, d
    integer, parameter :: n = 20
    type(contact_t) :: contact
    real(wp) :: h(d*n, dim*nodes), w(d*n, d*n)
    call make_contact(dim, d, n, 0.3_wp, contact)
    call build_w(contact)
    h = dense_h(contact%rows, d)
    w = matmul(h, matmul(contact%schur_inverse%block(1)%a, transpose(h)))
    call check_equal(contact%n, n, label(dim, d)//'rows of W')
    call check_close(maxval(abs(contact%w%matrix - w)), zero, 128.0_wp*eps*maxval(abs(w)), &
        label(dim, d)//'W = H S^-1 H''')
    call check_true(.not. any(abs(contact%w%matrix - transpose(contact%w%matrix)) > zero), &
        label(dim, d)//'W is symmetric')
  end subroutine test_w

  !> Nodes held in one direction do not move and take no force; a row that is held wholly is
  !> rigid and left out.
  subroutine test_constrained(dim)
    integer, intent(in) :: dim
    type(contact_t) :: contact
    real(wp) :: force(dim, nodes), x(dim*nodes), unit(dim)
    integer :: list(2, dim + 1), i
    unit = zero
    unit(dim) = one
    call make_contact(dim, dim, 5, 0.3_wp, contact)
    call add_row(contact%rows, [1, 1, 9, 0], [9], [one], unit, zero, zero, one, row_edge, zero)
    call find_slots(contact%slot, contact%rows)
    list(1, :) = [(i, i=1, dim), dim]
    list(2, :) = [spread(9, 1, dim), 4]
    call constrain_interface(contact, list)
    call build_w(contact)
    call check_true(contact%rows%is_rigid(6) .and. contact%n == 5, &
        label(dim, dim)//'a row that is held')
    call fill_random(force)
    x = matmul(contact%schur_inverse%block(1)%a, reshape(force, [dim*nodes]))
    call check_true(.not. any(abs(x([9*dim - dim + 1, 9*dim, 4*dim])) > zero), &
        label(dim, dim)//'held dofs stay')
    call clear_constrained(contact, force)
    call check_true(.not. any(abs([force(:, 9), force(dim, 4)]) > zero) .and. &
        all(abs(force(:dim - 1, 4)) > zero), label(dim, dim)//'and take no force')
  end subroutine test_constrained

  !> A step on positions: the law, and the works by their own formulas: friction mu r_n |u_t|,
  !> normal r_n c, both together minus r.(H dU); forces on the two sides, force on the bodies.
  subroutine test_works(dim, d)
    integer, intent(in) :: dim, d
    integer, parameter :: n = 16
    type(contact_t) :: contact
    type(contact_work_t) :: work, other
    real(wp) :: x(dim, nodes), free(dim, nodes), motion(dim, nodes), mu
    real(wp) :: f(dim, nodes), total(dim), lost, friction
    integer :: k, a
    mu = merge(zero, 0.4_wp, d == 1)
    call make_contact(dim, d, n, mu, contact)
    call fill_random(free)
    call solve_step(contact, free, motion)
    x = motion - free
    call check_equal(law_misses(contact%w%matrix, contact%q, contact%mu, contact%r, &
        1.0e-9_wp), 0, label(dim, d)//'the law')
    contact%splits_work = .true.
    call add_contact_step(contact, zero, one, 0.1_wp, motion, work)
    f = zero
    call subtract_contact_force(contact, -one, f)
    lost = -sum(f*motion)
    friction = zero
    total = zero
    do a = 1, n
      friction = friction + mu*contact%rows%r(1, a)*norm2(contact%rows%u(2:, a))
      associate (force => row_force(contact%rows, a))
        total = total + force(:dim)
      end associate
    end do
    ! Sums of 2 x 16 rows and 36 dofs of the size of 1; the solve is one to 1e-13.
    call check_close(work%friction, friction, 1.0e-12_wp, label(dim, d)//'friction work')
    call check_close(lost, work%friction + work%normal - work%unsolved, 1.0e-12_wp, &
        label(dim, d)//'r.(H dU)')
    call check_true(d == 1 .neqv. friction > 1.0e-3_wp, label(dim, d)//'some slip')
    associate (sums => contact%pairing(1)%item%sums)
      call check_close(norm2(sums%force(:dim, 1) - total), zero, 1.0e-13_wp*norm2(total), &
          label(dim, d)//'force of the contact')
      call check_close(norm2(sums%force(:, 1) + sums%force(:, 2)), zero, 1.0e-13_wp, &
          label(dim, d)//'of both sides')
      call check_close(norm2(sums%impulse(:dim, 1) - 0.1_wp*total), zero, 1.0e-13_wp, &
          label(dim, d)//'impulse')
      call check_close(sums%tangential_force, sum([(norm2(contact%rows%r(2:, k)), k=1, n)]), &
          1.0e-13_wp, label(dim, d)//'tangential force')
    end associate
    contact%splits_work = .false.
    call add_contact_step(contact, zero, one, 0.1_wp, motion, other)
    call check_close(other%friction + other%normal, lost, 1.0e-12_wp, &
        label(dim, d)//'works as they are')
    call check_close(norm2(reshape(x, [dim*nodes]) - matmul(contact%schur_inverse%block(1)%a, &
        reshape(f, [dim*nodes]))), zero, 1.0e-12_wp, label(dim, d)//'x = S^-1 H'' r')
  end subroutine test_works

  !> One contact solve by hand: q = H free + c, reactions, u, motion = free + S^-1 H' r.
  subroutine solve_step(contact, free, motion)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in) :: free(:, :)
    real(wp), intent(out) :: motion(:, :)
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: u(3), f(size(free, 1), size(free, 2))
    integer :: a
    call build_w(contact)
    do a = 1, contact%n
      u = relative_displacement(contact%rows, a, contact%rows%point, free)
      u(1) = u(1) + contact%rows%offset(a)
      contact%q(:, a) = u(:contact%d)
    end do
    contact%r = zero
    call solve_cone(contact%cone, contact%w, contact%q, contact%mu, contact%r, contact%work, &
        certificate, status)
    call check_true(.not. failed(status), 'a step is solved: '//status_text(status))
    f = zero
    contact%rows%r = zero
    do a = 1, contact%n
      contact%rows%r(:contact%d, a) = contact%r(:, a)
      contact%rows%status(a) = contact%work%status(a)
      if (.not. contact%r(1, a) > zero) contact%rows%status(a) = contact_open
      call add_row_force(contact%rows, a, one, contact%rows%slot, f)
    end do
    motion = free + reshape(matmul(contact%schur_inverse%block(1)%a, reshape(f, [size(f)])), &
        shape(free))
    do a = 1, contact%n
      u = relative_displacement(contact%rows, a, contact%rows%point, motion)
      u(1) = u(1) + contact%rows%offset(a)
      contact%rows%u(:, a) = u(:contact%dim)
    end do
  end subroutine solve_step

  !> Through the stage itself: impacts with friction and restitution of one e, whose energy does
  !> not rise (p.v_a <= 0 with v_a = (v1 + e v0)/(1 + e)), and whose momentum is kept where no
  !> row is a wall.
  subroutine test_impacts(dim)
    integer, intent(in) :: dim
    real(wp), parameter :: h = 0.01_wp, e = 0.5_wp
    type(contact_t) :: contact
    type(model_t) :: model
    type(status_t) :: status
    real(wp), allocatable :: free(:, :), force(:, :), v(:, :), mean(:, :)
    real(wp) :: work, size_of_work
    logical :: acting
    integer :: k, i, hits
    hits = 0
    model%node_id = [(i, i=1, nodes)]
    allocate (free(dim, nodes), force(dim, nodes), v(dim, nodes), mean(dim, nodes))
    free = zero
    do k = 1, 50
      call make_contact(dim, dim, 6, 0.3_wp, contact)
      contact%pairing(1)%item%restitution = e
      contact%rule = contact_rule_t(level=level_pressed, before=-h, now=h)
      contact%rows%r(1, :6) = one
      call fill_random(v)
      call solve_contact(model, contact, free, v, free, one, force, acting, status)
      call check_true(.not. failed(status), 'an impact is solved: '//status_text(status))
      mean = v + reshape(matmul(contact%schur_inverse%block(1)%a, &
          reshape(force, [dim*nodes])), &
          [dim, nodes])/(h*(one + e))
      work = sum(force*mean)
      size_of_work = norm2(force)*norm2(mean)
      call check_true(work <= 1.0e-12_wp*size_of_work, label(dim, dim)//'no impact gives')
      if (acting .and. work < -1.0e-3_wp*size_of_work) hits = hits + 1
      force(:, 1) = sum(force, dim=2)    ! rows 1 to 6 are no walls but where k = 2 dim
      if (dim == 2) force(:, 1) = force(:, 1) - wall_force(contact, 4)
      if (dim == 3) force(:, 1) = force(:, 1) - wall_force(contact, 6)
      call check_close(norm2(force(:, 1)), zero, 1.0e-13_wp*max(one, size_of_work), &
          label(dim, dim)//'momentum')
    end do
    call check_true(hits > 25, label(dim, dim)//'and many take')
  end subroutine test_impacts

  function wall_force(contact, a) result(force)
    type(contact_t), intent(in) :: contact
    integer, intent(in) :: a
    real(wp) :: force(contact%dim), f(3)
    f = row_force(contact%rows, a)
    force = f(:contact%dim)
  end function wall_force

  !> A problem of the plane put into space, where nothing moves across: the same reactions.
  subroutine test_plane_in_space()
    integer, parameter :: n = 12
    type(contact_t) :: plane, space
    real(wp) :: free(2, nodes), motion(2, nodes), free_3(3, nodes), motion_3(3, nodes)
    integer :: a, i, place(2*nodes)
    call make_contact(2, 2, n, 0.3_wp, plane)
    call make_contact(3, 3, 0, 0.3_wp, space)
    place = [((3*(i - 1) + a, a=1, 2), i=1, nodes)]
    space%schur_inverse%block(1)%a = zero
    space%schur_inverse%block(1)%a(place, place) = plane%schur_inverse%block(1)%a
    do i = 3, 3*nodes, 3
      space%schur_inverse%block(1)%a(i, i) = one
    end do
    do a = 1, n
      associate (rows => plane%rows)
        associate (p => rows%point(rows%first(a):rows%first(a + 1) - 1), &
            w => rows%weight(rows%first(a):rows%first(a + 1) - 1))
          call add_row(space%rows, rows%key(:, a), p, w, [rows%normal(:, a), zero], &
              rows%gap(a), rows%mu(a), one, row_edge, zero)
        end associate
      end associate
    end do
    call find_slots(space%slot, space%rows)
    call fill_random(free)
    free_3 = zero
    free_3(:2, :) = free
    call solve_step(plane, free, motion)
    call solve_step(space, free_3, motion_3)
    ! Both are solved to 1e-13, W has a condition of some hundred.
    call check_close(norm2(plane%r(1, :) - space%r(1, :)), zero, 1.0e-11_wp*norm2(plane%r), &
        'the plane in space: normal forces')
    call check_close(norm2(motion_3(:2, :) - motion), zero, 1.0e-11_wp*norm2(motion), &
        'the plane in space: motions')
    call check_close(norm2(motion_3(3, :)), zero, 1.0e-13_wp, 'nothing moves across')
  end subroutine test_plane_in_space

  !> The whole problem in space turned: normals, free motion and flexibility. Forces and motions
  !> turn with it, whatever tangents the rule gives.
  subroutine test_turned()
    integer, parameter :: n = 12
    type(contact_t) :: first, turned
    real(wp) :: b(3, 3), whole(3*nodes, 3*nodes)
    real(wp) :: free(3, nodes), motion(3, nodes), other(3, nodes)
    integer :: a, i, k
    call make_contact(3, 3, n, 0.5_wp, first)
    call fill_random(free)
    call solve_step(first, free, motion)
    do k = 1, 10
      b(:, 1) = random_unit(3)
      b(:, 2:) = tangents_of(b(:, 1))
      whole = zero
      do i = 1, nodes
        whole(3*i - 2:3*i, 3*i - 2:3*i) = b
      end do
      call make_contact(3, 3, 0, 0.5_wp, turned)
      turned%schur_inverse%block(1)%a = matmul(whole, &
          matmul(first%schur_inverse%block(1)%a, transpose(whole)))
      do a = 1, n
        associate (rows => first%rows)
          associate (p => rows%point(rows%first(a):rows%first(a + 1) - 1), &
              w => rows%weight(rows%first(a):rows%first(a + 1) - 1))
            call add_row(turned%rows, rows%key(:, a), p, w, matmul(b, rows%normal(:, a)), &
                rows%gap(a), rows%mu(a), one, row_edge, zero)
          end associate
        end associate
      end do
      call find_slots(turned%slot, turned%rows)
      call solve_step(turned, matmul(b, free), other)
      ! Solved to round-off, times the condition of W, some hundred.
      call check_close(norm2(matmul(b, motion) - other), zero, 1.0e-12_wp*norm2(motion), &
          'turned in space: motions')
    end do
  end subroutine test_turned

end program test_rows
