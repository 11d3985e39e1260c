! SPDX-License-Identifier: BSD-3-Clause
!> Statics of bodies that supports do not hold: K is singular for them. Each step is solved with
!> A = K + eps M (M lumped) of those bodies, by proximal passes
!>   A x_k+1 = P1 - K U0 + eps M x_k + r_k+1,  x_0 = 0,
!> until eps M (x_k+1 - x_k), the residual of equilibrium, is small: the limit has no trace of
!> eps. Where there is no equilibrium, the same move comes again and again.
module run_static
  use assembly_system, only: system_t, largest_of_elements
  use base_kinds, only: wp, zero, one, half
  use base_status, only: status_t, fail, status_numerical
  use base_strings, only: to_text
  use model_data, only: model_t
  use run_data, only: run_t
  implicit none
  private
  public :: make_shift, add_shift, check_pass, unbalanced_work

contains

  !> eps times the lumped mass of each node [F/L]: SHIFT (c/L)^2 m, L the largest size of its
  !> body, c^2 = E/rho, for bodies whose supports leave a rigid motion; else not allocated.
  subroutine make_shift(model, system, shift, factor)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    real(wp), allocatable, intent(out) :: shift(:)
    real(wp), intent(in) :: factor
    integer, allocatable :: body(:)
    real(wp) :: size_2, c_2
    integer :: b, e, i
    call find_bodies(model, body)
    do b = 1, maxval(body(:model%nodes - model%bodies))
      if (is_of_rigid(model, body, b)) cycle
      if (rigid_motions_held(model, system, body, b) == rigid_motions(model)) cycle
      if (.not. allocated(shift)) allocate (shift(system%n), source=zero)
      size_2 = zero
      do i = 1, model%dim
        size_2 = max(size_2, &
            maxval(model%x(i, :), body == b) - minval(model%x(i, :), body == b))
      end do
      size_2 = size_2**2
      c_2 = zero
      do e = 1, model%mesh%n
        if (body(model%mesh%node_of(1, e)) /= b) cycle
        associate (p => model%part(model%mesh%part(e)))
          c_2 = max(c_2, model%material(p%material)%item%wave_speed(p%plane)**2)
        end associate
      end do
      do i = 1, system%n
        if (body(i) == b) shift(i) = factor*c_2/size_2*system%lumped(i)
      end do
    end do
    if (allocated(model%rigid)) call shift_rigid_parts(model, system, shift, factor)
  end subroutine make_shift

  !> Is body b made of nodes of a rigid part?
  pure logical function is_of_rigid(model, body, b)
    type(model_t), intent(in) :: model
    integer, intent(in) :: body(:), b
    is_of_rigid = .false.
    if (.not. allocated(model%rigid)) return
    is_of_rigid = any(body(model%rigid%node) == b) .or. any(body(model%mesh_nodes + 1:) == b)
  end function is_of_rigid

  !> Rigid parts that have a motion left: a force, that of all loads at their largest or, where
  !> there are none, a share of the stiffness of the other parts, over a length of the scene: a
  !> free pass moves a part about that far.
  subroutine shift_rigid_parts(model, system, shift, factor)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    real(wp), allocatable, intent(inout) :: shift(:)
    real(wp), intent(in) :: factor
    real(wp) :: force, extent
    integer :: k, p
    if (all(system%fixed(:, model%rigid%centre)) .and. &
        all(system%fixed(:, model%rigid%rotor))) return
    if (.not. allocated(shift)) allocate (shift(system%n), source=zero)
    extent = maxval(maxval(model%x, dim=2) - minval(model%x, dim=2))
    force = zero
    do k = 1, size(model%load)
      associate (l => model%load(k))
        force = force + sum(abs(l%force))*abs(l%factor)*maxval(abs(model%curve(l%curve)%o))
      end associate
    end do
    do k = 1, size(model%gravity)
      associate (g => model%gravity(k))
        force = force + sum(system%lumped(:system%heavy))*abs(g%factor) &
            *maxval(abs(model%curve(g%curve)%o))
      end associate
    end do
    if (.not. force > zero) force = factor*extent* &
        max(largest_of_elements(system), tiny(one))
    do p = 1, size(model%rigid%part)
      shift(model%rigid%centre(p)) = force/extent
      shift(model%rigid%rotor(p)) = force/extent
    end do
  end subroutine shift_rigid_parts

  !> Bodies are what elements join: their number at each node.
  pure subroutine find_bodies(model, body)
    type(model_t), intent(in) :: model
    integer, allocatable, intent(out) :: body(:)
    integer, allocatable :: number(:)
    integer :: e, i, k, a, b, n
    body = [(i, i=1, model%nodes)]
    do e = 1, model%mesh%n
      a = root(body, model%mesh%node_of(1, e))
      do k = 2, model%mesh%count_of(e)
        b = root(body, model%mesh%node_of(k, e))
        body(max(a, b)) = min(a, b)
        a = min(a, b)
      end do
    end do
    allocate (number(model%nodes))
    n = 0
    do i = 1, model%nodes
      if (body(i) == i) then
        n = n + 1
        number(i) = n
      else
        number(i) = number(body(i))
      end if
    end do
    body = number
  end subroutine find_bodies

  pure integer function root(body, i)
    integer, intent(in) :: body(:), i
    root = i
    do while (body(root) /= root)
      root = body(root)
    end do
  end function root

  !> Those of a body: translations and rotations.
  pure integer function rigid_motions(model)
    type(model_t), intent(in) :: model
    rigid_motions = merge(3, 6, model%dim == 2)
  end function rigid_motions

  !> Displacement in direction d at x [L] of the rigid motions of a body, rotations times a
  !> length.
  pure function rigid_row(d, x, length) result(row)
    integer, intent(in) :: d
    real(wp), intent(in) :: x(:), length
    real(wp) :: row(merge(3, 6, size(x) == 2))
    row = zero
    row(d) = one
    if (size(x) == 2) then
      row(3) = merge(-x(2), x(1), d == 1)/length
    else
      row(4 + mod(d, 3)) = x(1 + mod(d + 1, 3))/length
      row(4 + mod(d + 1, 3)) = -x(1 + mod(d, 3))/length
    end if
  end function rigid_row

  !> Rank of the fixed dofs of a body on its rigid motions.
  pure integer function rigid_motions_held(model, system, body, b) result(rank)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    integer, intent(in) :: body(:), b
    real(wp), dimension(rigid_motions(model)) :: row
    real(wp) :: basis(rigid_motions(model), rigid_motions(model)), length
    integer :: k, m
    length = maxval(abs(model%x)) + tiny(one)
    rank = 0
    do k = 1, size(system%fixed_list, 2)
      associate (d => system%fixed_list(1, k), i => system%fixed_list(2, k))
        if (body(i) /= b) cycle
        row = rigid_row(d, model%x(:, i), length)
      end associate
      row = row/norm2(row)
      do m = 1, rank
        row = row - dot_product(row, basis(:, m))*basis(:, m)
      end do
      if (norm2(row) < 1.0e-6_wp) cycle
      rank = rank + 1
      basis(:, rank) = row/norm2(row)
      if (rank == size(row)) return
    end do
  end function rigid_motions_held

  !> b = b + eps M x of the last pass.
  pure subroutine add_shift(shift, x, b)
    real(wp), intent(in) :: shift(:), x(:, :)
    real(wp), intent(inout) :: b(:, :)
    integer :: i
    do i = 1, size(shift)
      b(:, i) = b(:, i) + shift(i)*x(:, i)
    end do
  end subroutine add_shift

  !> Work of the forces that the passes left unbalanced, the mean of both ends of the step
  !> [F L]: - eps M of the last change.
  subroutine unbalanced_work(run, work)
    type(run_t), intent(inout) :: run
    real(wp), intent(out) :: work
    integer :: i
    work = half*sum(run%state%du*run%unbalanced)
    do i = 1, run%system%n
      run%unbalanced(:, i) = -run%shift(i)*run%move(:, i)
    end do
    work = work + half*sum(run%state%du*run%unbalanced)
  end subroutine unbalanced_work

  !> After a pass: is the residual of equilibrium small, or the move below the digits of the
  !> coordinates (faces that touch to round-off, without a load)? Fails after MAXPASS passes, or
  !> when a body moves by the same again and again.
  subroutine check_pass(run, pass, is_done, status)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: pass
    logical, intent(out) :: is_done
    type(status_t), intent(inout) :: status
    real(wp) :: residual, scale, change
    integer :: i
    residual = zero
    scale = zero
    change = zero
    do i = 1, run%system%n
      associate (move => run%x(:, i) - run%x_pass(:, i))
        residual = residual + run%shift(i)*sum(abs(move))
        change = max(change, maxval(abs(move - run%move(:, i))))
      end associate
    end do
    if (run%plan%loads) scale = sum(abs(run%load_1))
    scale = max(scale, maxval(abs(run%force)))
    is_done = residual <= run%model%controls%static_residual*scale .or. &
        maxval(abs(run%x - run%x_pass)) <= epsilon(one)*maxval(abs(run%model%x))
    run%same_moves = merge(run%same_moves + 1, 0, pass > 1 &
        .and. change <= 1.0e-6_wp*maxval(abs(run%x - run%x_pass)))
    run%move = run%x - run%x_pass
    run%x_pass = run%x
    if (is_done) return
    if (run%same_moves >= 3) then
      call fail_free(run, status)
    else if (pass == run%model%controls%static_passes) then
      call fail(status, status_numerical, 'no equilibrium after '//to_text(pass)// &
          ' passes: a residual force of '//to_text(residual)//' is left', &
          hint='raise MAXPASS or SHIFT on *BIPACT_STATIC, or take smaller load steps')
    end if
  end subroutine check_pass

  !> Names the part that moves most, with its mean move and turn in a pass.
  subroutine fail_free(run, status)
    type(run_t), intent(in) :: run
    type(status_t), intent(inout) :: status
    logical :: is_of(run%model%nodes)
    real(wp), dimension(run%model%dim) :: mean, centre
    real(wp) :: turn(3), turned, inertia
    character(:), allocatable :: place
    integer :: e, i, part
    i = maxloc(sum(run%move**2, dim=1), dim=1)
    part = 1
    do e = 1, run%model%mesh%n
      if (any(run%model%mesh%nodes_of(e) == i)) part = run%model%mesh%part(e)
    end do
    if (i > run%model%mesh_nodes) part = run%model%rigid%part(1 + mod(i - &
        run%model%mesh_nodes - 1, size(run%model%rigid%part)))
    is_of = .false.
    do e = 1, run%model%mesh%n
      if (run%model%mesh%part(e) == part) is_of(run%model%mesh%nodes_of(e)) = .true.
    end do
    mean = sum(run%move, dim=2, mask=spread(is_of, 1, run%model%dim))/count(is_of)
    centre = sum(run%model%x, dim=2, mask=spread(is_of, 1, run%model%dim))/count(is_of)
    turn = zero
    inertia = tiny(one)
    do i = 1, run%model%nodes
      if (.not. is_of(i)) cycle
      associate (d => run%model%x(:, i) - centre, m => run%move(:, i) - mean)
        turn(3) = turn(3) + d(1)*m(2) - d(2)*m(1)
        inertia = inertia + d(1)**2 + d(2)**2
        if (run%model%dim == 2) cycle
        turn(1:2) = turn(1:2) + [d(2)*m(3) - d(3)*m(2), d(3)*m(1) - d(1)*m(3)]
        inertia = inertia + d(3)**2
      end associate
    end do
    turned = turn(3)
    if (run%model%dim == 3) turned = 1.5_wp*norm2(turn)   ! of a round body
    place = to_text(mean(1))
    do i = 2, run%model%dim
      place = place//', '//to_text(mean(i))
    end do
    call fail(status, status_numerical, 'there is no equilibrium: part '// &
        to_text(run%model%part(part)%id)//' is not held; it moves by ('//place// &
        ') and turns by '//to_text(turned/inertia)//' a pass', &
        hint='add supports or friction, or balance the loads')
  end subroutine fail_free

end module run_static
