! SPDX-License-Identifier: BSD-3-Clause
!> Rigid parts in a step. The solver knows centres and rotors, contact the nodes of meshes: here
!> motions, forces and flexibilities go from the ones to the others by the levers of
!> model_rigid. A scheme that poses contact on positions in one stage has the levers of the
!> middle of its step, so that H dU is the motion as it is: the turns of the step, which they
!> depend on, are found by repeating the solve. The others have those of the start, and their
!> works are those of H times the motion of centres and rotors.
module run_rigid
  use base_kinds, only: wp, zero, one
  use contact_rule, only: level_position
  use contact_work, only: subtract_contact_force, add_contact_step
  use model_rigid, only: rotations, find_levers, move_followers, place_followers, gather_forces
  use run_data, only: run_t
  implicit none
  private
  public :: make_rigid, begin_rigid, link_interface, keep_flexibility, spread_flexibility, &
      spread_motion, collect_forces, renew_levers, carry, set_true_motion, subtract_contact, &
      add_rigid_works

contains

  !> Work space; nodes stand where their parts have them.
  subroutine make_rigid(run)
    type(run_t), intent(inout) :: run
    integer :: k
    if (.not. allocated(run%model%rigid)) return
    if (.not. allocated(run%rigid)) allocate (run%rigid)
    associate (rigid => run%model%rigid, r => run%rigid)
      if (.not. allocated(r%lever)) then
        allocate (r%lever(2, size(rigid%node)), r%turn(size(rigid%part)))
        allocate (r%row(run%system%n), r%slot(run%system%n))
        r%row = 0
        r%row(rigid%node) = [(k, k=1, size(rigid%node))]
        r%slot = 0
      end if
      r%is_middle = run%scheme%stage(1)%moves .and. .not. run%scheme%staggered%on &
          .and. run%scheme%stage(1)%rule%level == level_position
      if (run%scheme%weight_before > zero .and. .not. allocated(r%motion_before)) then
        allocate (r%lever_before(2, size(rigid%node)))
        allocate (r%motion_before(run%system%dim, run%system%n))
      end if
      r%turn = zero
      call find_levers(rigid, rotations(rigid, run%state%u), r%turn, r%lever)
    end associate
    call carry_parts(run)
  end subroutine make_rigid

  !> Levers for the coming step: with the turn that its velocity would give, or those of its
  !> start. Where forces of the step before act in it, they act by the levers of that step.
  subroutine begin_rigid(run)
    type(run_t), intent(inout) :: run
    associate (rigid => run%model%rigid, r => run%rigid, state => run%state)
      if (allocated(r%lever_before)) call find_levers(rigid, rotations(rigid, state%u) - &
          rotations(rigid, state%du), rotations(rigid, state%du), r%lever_before)
      r%turn = zero
      r%keeps_levers = .false.
      if (r%is_middle) r%turn = run%scheme%h*rotations(rigid, state%v)
      call find_levers(rigid, rotations(rigid, state%u), r%turn, r%lever)
      call move_followers(rigid, r%lever, state%v)
    end associate
  end subroutine begin_rigid

  !> The nodes that the solver keeps to the end for the interface as it is: its nodes, and in
  !> place of those that follow the centres and rotors of their parts.
  subroutine link_interface(run)
    type(run_t), intent(inout) :: run
    logical :: is_kept(run%system%n)
    integer :: k, m
    associate (rigid => run%model%rigid, r => run%rigid, node => run%contact%interface_node)
      is_kept = .false.
      is_kept(node) = .true.
      do k = 1, size(node)
        if (r%row(node(k)) == 0) cycle
        is_kept(node(k)) = .false.
        is_kept(rigid%centre(rigid%of(r%row(node(k))))) = .true.
        is_kept(rigid%rotor(rigid%of(r%row(node(k))))) = .true.
      end do
      r%solver_node = pack([(k, k=1, run%system%n)], is_kept)
      r%slot = 0
      r%slot(r%solver_node) = [(k, k=1, size(r%solver_node))]
      m = size(node)
      if (allocated(r%x)) deallocate (r%x, r%half_spread)
      allocate (r%x(2, m), r%half_spread(2*m, 2*size(r%solver_node)))
      r%x = zero
    end associate
  end subroutine link_interface

  !> The flexibility of the nodes that the solver has kept; held dofs have none.
  subroutine keep_flexibility(run)
    type(run_t), intent(inout) :: run
    integer :: k, m
    associate (r => run%rigid, list => run%system%fixed_list)
      m = 2*size(r%solver_node)
      if (allocated(r%flexibility)) then
        if (size(r%flexibility, 1) /= m) deallocate (r%flexibility)
      end if
      if (.not. allocated(r%flexibility)) allocate (r%flexibility(m, m))
      call run%solver%flexibility(r%flexibility)
      r%constrained = pack(2*r%slot(list(2, :)) - 2 + list(1, :), r%slot(list(2, :)) > 0)
      do k = 1, size(r%constrained)
        r%flexibility(r%constrained(k), :) = zero
        r%flexibility(:, r%constrained(k)) = zero
      end do
    end associate
    run%contact%constrained = [integer ::]
    run%contact%w_is_current = .false.
  end subroutine keep_flexibility

  !> The flexibility of the interface: T F T' with T of the levers.
  subroutine spread_flexibility(run)
    type(run_t), intent(inout) :: run
    integer :: k, a, c, p
    associate (rigid => run%model%rigid, r => run%rigid, node => run%contact%interface_node, &
        whole => run%contact%schur_inverse%block(1)%a)
      do k = 1, size(node)
        if (r%row(node(k)) == 0) then
          a = r%slot(node(k))
          r%half_spread(2*k - 1:2*k, :) = r%flexibility(2*a - 1:2*a, :)
        else
          c = r%slot(rigid%centre(rigid%of(r%row(node(k)))))
          p = r%slot(rigid%rotor(rigid%of(r%row(node(k)))))
          associate (l => r%lever(:, r%row(node(k))))
            r%half_spread(2*k - 1, :) = r%flexibility(2*c - 1, :) &
                + l(1)*r%flexibility(2*p - 1, :)
            r%half_spread(2*k, :) = r%flexibility(2*c, :) + l(2)*r%flexibility(2*p - 1, :)
          end associate
        end if
      end do
      do k = 1, size(node)
        if (r%row(node(k)) == 0) then
          a = r%slot(node(k))
          whole(:, 2*k - 1:2*k) = r%half_spread(:, 2*a - 1:2*a)
        else
          c = r%slot(rigid%centre(rigid%of(r%row(node(k)))))
          p = r%slot(rigid%rotor(rigid%of(r%row(node(k)))))
          associate (l => r%lever(:, r%row(node(k))))
            whole(:, 2*k - 1) = r%half_spread(:, 2*c - 1) + l(1)*r%half_spread(:, 2*p - 1)
            whole(:, 2*k) = r%half_spread(:, 2*c) + l(2)*r%half_spread(:, 2*p - 1)
          end associate
        end if
      end do
    end associate
    run%contact%w_is_current = .false.
  end subroutine spread_flexibility

  !> run%rigid%x (dim, m): the motion of the interface for the motion run%x_interface of the
  !> nodes that the solver has kept.
  subroutine spread_motion(run)
    type(run_t), intent(inout) :: run
    integer :: k
    associate (rigid => run%model%rigid, r => run%rigid, node => run%contact%interface_node, &
        x => run%x_interface)
      do k = 1, size(node)
        if (r%row(node(k)) == 0) then
          r%x(:, k) = x(:, r%slot(node(k)))
        else
          associate (p => rigid%of(r%row(node(k))))
            r%x(:, k) = x(:, r%slot(rigid%centre(p))) &
                + r%lever(:, r%row(node(k)))*x(1, r%slot(rigid%rotor(p)))
          end associate
        end if
      end do
    end associate
  end subroutine spread_motion

  !> Adds the forces run%force of the interface to those on the nodes that the solver has kept;
  !> none on held dofs.
  subroutine collect_forces(run, f)
    type(run_t), intent(inout) :: run
    real(wp), intent(inout) :: f(:, :)
    real(wp) :: kept(size(run%rigid%constrained))
    integer :: k
    associate (rigid => run%model%rigid, r => run%rigid, node => run%contact%interface_node, &
        force => run%force)
      do k = 1, size(kept)
        kept(k) = f(2 - mod(r%constrained(k), 2), (r%constrained(k) + 1)/2)
      end do
      do k = 1, size(node)
        if (r%row(node(k)) == 0) then
          f(:, r%slot(node(k))) = f(:, r%slot(node(k))) + force(:, k)
        else
          associate (p => rigid%of(r%row(node(k))))
            f(:, r%slot(rigid%centre(p))) = f(:, r%slot(rigid%centre(p))) + force(:, k)
            f(1, r%slot(rigid%rotor(p))) = f(1, r%slot(rigid%rotor(p))) &
                + dot_product(r%lever(:, r%row(node(k))), force(:, k))
          end associate
        end if
      end do
      do k = 1, size(kept)
        f(2 - mod(r%constrained(k), 2), (r%constrained(k) + 1)/2) = kept(k)
      end do
    end associate
  end subroutine collect_forces

  !> After a solve: are the levers those of the step as it has come out, to round-off? If not,
  !> they are now, and the step is to be solved again where contact may ask for them.
  subroutine renew_levers(run, again)
    type(run_t), intent(inout) :: run
    logical, intent(out) :: again
    real(wp) :: turn(size(run%rigid%turn))
    again = .false.
    associate (rigid => run%model%rigid, r => run%rigid)
      if (.not. r%is_middle) return
      turn = rotations(rigid, run%x)
      ! Half the change of turn times the turn is what a lever errs by.
      r%change = maxval(abs(turn - r%turn)*max(abs(turn), abs(r%turn)))
      r%turn = turn
      call find_levers(rigid, rotations(rigid, run%state%u), turn, r%lever)
      call move_followers(rigid, r%lever, run%state%v)
      again = r%change > epsilon(one) .and. run%plan%contact
      if (again) again = run%contact%rows%n > 0
      if (.not. again) call move_followers(rigid, r%lever, run%x)
    end associate
  end subroutine renew_levers

  !> The state of the nodes that follow, from that of centres and rotors.
  subroutine carry_parts(run)
    type(run_t), intent(inout) :: run
    call place_followers(run%model%rigid, run%state%u, run%state%v)
    if (allocated(run%state%a)) call find_accelerations(run)
  end subroutine carry_parts

  !> Of tables alone: a_c + phi'' e_z x R X - phi'^2 R X.
  subroutine find_accelerations(run)
    type(run_t), intent(inout) :: run
    real(wp) :: rate, d(2), lever(2, size(run%model%rigid%node))
    integer :: k
    associate (rigid => run%model%rigid, s => run%state)
      call find_levers(rigid, rotations(rigid, s%u), zero*rigid%radius, lever)
      call move_followers(rigid, lever, s%a)
      do k = 1, size(rigid%node)
        associate (i => rigid%node(k), p => rigid%of(k))
          rate = s%v(1, rigid%rotor(p))/rigid%radius(p)
          d = rigid%radius(p)*[lever(2, k), -lever(1, k)]
          s%a(:, i) = s%a(:, i) - rate**2*d
        end associate
      end do
    end associate
  end subroutine find_accelerations

  !> After the works of a step: its motion as it was, for which the levers of its start are not
  !> enough.
  subroutine set_true_motion(run)
    type(run_t), intent(inout) :: run
    real(wp) :: lever(2, size(run%model%rigid%node)), turn(size(run%rigid%turn))
    if (run%rigid%is_middle .and. .not. run%rigid%keeps_levers) return
    associate (rigid => run%model%rigid, s => run%state)
      turn = rotations(rigid, s%du)
      call find_levers(rigid, rotations(rigid, s%u) - turn, turn, lever)
      call move_followers(rigid, lever, s%du)
    end associate
  end subroutine set_true_motion

  !> f = f - factor H' r (dim, nodes), on centres and rotors where nodes follow them.
  subroutine subtract_contact(run, factor, f)
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: factor
    real(wp), intent(inout) :: f(:, :)
    if (allocated(run%rigid)) f(:, run%model%rigid%node) = zero
    call subtract_contact_force(run%contact, factor, f)
    if (allocated(run%rigid)) call gather_forces(run%model%rigid, run%rigid%lever, f)
  end subroutine subtract_contact

  !> State and motions of the nodes that follow rigid parts, after a stage.
  subroutine carry(run)
    type(run_t), intent(inout) :: run
    integer :: k
    call carry_parts(run)
    associate (rigid => run%model%rigid, lever => run%rigid%lever)
      call move_followers(rigid, lever, run%state%du)
      if (allocated(run%scheme%conjugate)) &
          call move_followers(rigid, lever, run%scheme%conjugate)
      if (.not. allocated(run%scheme%stage_work)) return
      do k = 1, size(run%scheme%stage_work)
        if (allocated(run%scheme%stage_work(k)%x)) &
            call move_followers(rigid, lever, run%scheme%stage_work(k)%x)
      end do
    end associate
  end subroutine carry

  !> Works of contact in the motion of the step; forces of the step before act by its levers.
  subroutine add_rigid_works(run)
    type(run_t), intent(inout) :: run
    associate (s => run%scheme, r => run%rigid, du => run%state%du)
      if (allocated(r%motion_before)) then
        r%motion_before = du
        call move_followers(run%model%rigid, r%lever_before, r%motion_before)
        call add_contact_step(run%contact, s%weight_before, s%weight_now, s%h, du, &
            run%ledger%contact, r%motion_before)
      else
        call add_contact_step(run%contact, s%weight_before, s%weight_now, s%h, du, &
            run%ledger%contact)
      end if
    end associate
  end subroutine add_rigid_works

end module run_rigid
