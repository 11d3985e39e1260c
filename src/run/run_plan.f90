! SPDX-License-Identifier: BSD-3-Clause
!> The scene plan: which features this scene needs, and why. The rest is not allocated, not
!> called.
module run_plan
  use base_kinds, only: wp, zero
  use base_strings, only: to_text
  use deck_names, only: force_names, table_names, table_count, table_glstat, table_matsum, &
      table_nodout, table_elout, table_spcforc, table_ncforc, table_rwforc, table_rcforc, &
      table_sleout, table_timing, table_rbdout, step_halve, step_event
  use model_data, only: model_t, count_steps
  use run_data, only: plan_t
  use solid_block, only: force_conserving
  implicit none
  private
  public :: make_plan, plan_line, add_feature, set_feature

contains

  !> Plans the run of a model.
  subroutine make_plan(model, plan)
    type(model_t), intent(in) :: model
    type(plan_t), intent(inout) :: plan
    call plan_steps(model, plan)
    if (model%controls%is_explicit) call plan_explicit(model, plan)
    call plan_contact(model, plan)
    plan%loads = size(model%load) + size(model%gravity) > 0
    call add_feature(plan, 'loads', plan%loads, to_text(size(model%load))//' nodal, '// &
        to_text(size(model%gravity))//' body')
    call add_feature(plan, 'supports', any(model%fixed), to_text(count(model%fixed))// &
        ' fixed dofs')
    plan%motions = size(model%motion) > 0
    call add_feature(plan, 'motions', plan%motions, to_text(size(model%motion))//' prescribed')
    plan%reactions = plan%motions .or. model%requests%interval(table_spcforc) > zero
    call add_feature(plan, 'reactions', plan%reactions, 'motions or *DATABASE_SPCFORC')
    plan%damping = allocated(model%mass_damping) .or. allocated(model%stiffness_damping)
    call add_feature(plan, 'damping', plan%damping, damping_reason(model))
    call add_feature(plan, 'massless', model%controls%redistribute, 'REDIST '// &
        merge('1', '0', model%controls%redistribute))
    if (model%controls%is_finite) then
      call add_feature(plan, 'kinematics', .true., 'finite deformation, '//cost_of(model))
    else
      call add_feature(plan, 'kinematics', .false., &
          'small displacements: one stiffness, factored once')
    end if
    if (allocated(model%rigid)) call add_feature(plan, 'rigid parts', .true., &
        to_text(size(model%rigid%part))//', finite rotations')
    call plan_tables(model, plan)
    call plan_storage(model, plan)
  end subroutine make_plan

  !> What a step at finite deformation costs, in what it is made of.
  function cost_of(model) result(text)
    type(model_t), intent(in) :: model
    character(:), allocatable :: text
    integer :: visits
    associate (c => model%controls)
      visits = merge(2, 1, c%force == force_conserving)
      if (c%is_explicit) then
        text = 'a step visits '//to_text(model%mesh%n)//' elements three times'
        return
      end if
      text = "Newton's method, force of the step "//trim(force_names(c%force))//': '
      if (c%is_static) then
        text = text//'a load step costs 5 passes or so, each with a factor'
      else
        text = text//'a step costs 1 to 2 factors and 4 to 10 passes'
      end if
      text = text//', each pass a solve and '//to_text(visits)//' x '//to_text(model%mesh%n)// &
          ' elements'
    end associate
  end function cost_of

  pure function damping_reason(model) result(reason)
    type(model_t), intent(in) :: model
    character(:), allocatable :: reason
    integer :: cards, parts
    cards = 0
    parts = 0
    if (allocated(model%mass_damping)) cards = size(model%mass_damping)
    if (allocated(model%stiffness_damping)) parts = count(model%stiffness_damping > zero)
    reason = to_text(cards)//' by mass, '//to_text(parts)//' parts by stiffness'
  end function damping_reason

  !> Number of steps; an end time that is no whole number of steps cuts the last one.
  subroutine plan_steps(model, plan)
    type(model_t), intent(in) :: model
    type(plan_t), intent(inout) :: plan
    associate (c => model%controls)
      call count_steps(c%end_time, c%dt, plan%full_steps, plan%last_step)
      if (c%end_cycle > 0 .and. c%end_cycle <= plan%full_steps) then
        plan%full_steps = c%end_cycle
        plan%last_step = zero
      end if
      call add_feature(plan, 'steps', .true., to_text(plan%full_steps)//' of '//to_text(c%dt))
      call add_feature(plan, 'cut step', plan%last_step > zero, 'ENDTIM/DT0 = '// &
          to_text(c%end_time/c%dt))
      select case (c%step_mode)
      case (step_halve)
        call add_feature(plan, 'step control', .true., 'MODE HALVE: a step that is refused '// &
            'is halved, at most '//to_text(c%most_halvings)//' times, not below '// &
            to_text(c%shortest_step))
      case (step_event)
        call add_feature(plan, 'step control', .true., 'MODE EVENT: a step in which an '// &
            'open contact closes ends at the touch')
      case default
        call add_feature(plan, 'step control', .false., 'MODE FIXED: all steps are DT0')
      end select
    end associate
  end subroutine plan_steps

  !> What the step is held to, and what a diagonal matrix does not need.
  subroutine plan_explicit(model, plan)
    type(model_t), intent(in) :: model
    type(plan_t), intent(inout) :: plan
    associate (c => model%controls)
      if (c%limit_element > 0) then
        call add_feature(plan, 'explicit', .true., 'DT0 = '//to_text(c%dt/c%step_limit)// &
            ' of the limit, '//to_text(c%step_limit)//', of element '//to_text(c%limit_element))
      else
        call add_feature(plan, 'explicit', .true., 'all parts are rigid: no limit of the step')
      end if
      if (c%static_until > zero) then
        call add_feature(plan, 'factor', .true., 'of the static phase alone')
      else
        call add_feature(plan, 'factor', .false., &
            'lumped masses alone: no elimination order, no refinement')
      end if
    end associate
  end subroutine plan_explicit

  subroutine plan_contact(model, plan)
    type(model_t), intent(in) :: model
    type(plan_t), intent(inout) :: plan
    real(wp) :: mu
    plan%contact = size(model%contact) + size(model%wall) > 0
    mu = maxval([zero, model%contact%mu, model%wall%mu])
    call add_feature(plan, 'contact', plan%contact, to_text(size(model%contact))// &
        ' of bodies, '//to_text(size(model%wall))//' of walls')
    if (.not. plan%contact) then
      call add_feature(plan, 'friction', .false., 'no contact')
    else if (mu > zero) then
      call add_feature(plan, 'friction', .true., 'mu = '//to_text(mu)//' at most'// &
          trim(merge(', falls with the speed of slip', repeat(' ', 30), &
          any(model%contact%friction_decay > zero .and. &
          model%contact%kinetic_mu < model%contact%mu))))
    else
      call add_feature(plan, 'friction', .false., &
          'mu = 0 in all pairs: scalar contact rows only')
    end if
    plan%dump = plan%contact .and. model%controls%dump_first > 0
    if (plan%dump) then
      call add_feature(plan, 'dump', .true., 'contact problems of steps '// &
          to_text(model%controls%dump_first)//' to '//to_text(model%controls%dump_last))
    else
      call add_feature(plan, 'dump', .false., 'DFIRST 0 on *BIPACT_CONTACT')
    end if
  end subroutine plan_contact

  subroutine plan_tables(model, plan)
    type(model_t), intent(in) :: model
    type(plan_t), intent(inout) :: plan
    !> Order of the lines.
    integer, parameter :: order(table_count) = [table_glstat, table_matsum, table_nodout, &
        table_elout, table_rbdout, table_spcforc, table_ncforc, table_rwforc, table_rcforc, &
        table_sleout, table_timing]
    character(:), allocatable :: what
    integer :: k
    associate (r => model%requests)
      plan%ledger = any(r%interval([table_glstat, table_matsum]) > zero) &
          .or. model%controls%ledger_every > 0
      do k = 1, table_count
        what = ''
        if (order(k) == table_nodout) what = to_text(size(r%history_node))//' nodes, '
        if (order(k) == table_elout) what = to_text(size(r%history_element))//' elements, '
        call add_feature(plan, trim(table_names(order(k))), r%interval(order(k)) > zero, &
            what//'every '//to_text(r%interval(order(k))))
      end do
      if (model%controls%ledger_every > 0) then
        call add_feature(plan, 'ledger', .true., 'every '// &
            to_text(model%controls%ledger_every)//' steps')
      else
        call add_feature(plan, 'ledger', .true., 'with GLSTAT, and at the end')
      end if
    end associate
  end subroutine plan_tables

  subroutine plan_storage(model, plan)
    type(model_t), intent(in) :: model
    type(plan_t), intent(inout) :: plan
    associate (f => model%requests%field, r => model%requests%restart)
      plan%fields = f%on
      plan%restarts = r%on
      call add_feature(plan, 'fields', f%on, to_text(count(f%wanted))//' fields, every '// &
          to_text(f%interval))
      if (.not. r%on) then
        call add_feature(plan, 'restarts', .false., 'no *BIPACT_RESTART')
      else
        call add_feature(plan, 'restarts', .true., 'every '//to_text(r%steps)//' steps, '// &
            to_text(r%wall)//' s of the clock (0 = not so)'// &
            trim(merge(', on signals', '            ', r%on_signal)))
      end if
    end associate
  end subroutine plan_storage

  !> Adds a line to the plan.
  subroutine add_feature(plan, name, on, reason)
    type(plan_t), intent(inout) :: plan
    character(*), intent(in) :: name
    logical, intent(in) :: on
    character(*), intent(in) :: reason
    plan%n = plan%n + 1
    plan%feature(plan%n)%name = name
    plan%feature(plan%n)%on = on
    plan%feature(plan%n)%reason = reason
  end subroutine add_feature

  !> A line that may be there already.
  subroutine set_feature(plan, name, on, reason)
    type(plan_t), intent(inout) :: plan
    character(*), intent(in) :: name
    logical, intent(in) :: on
    character(*), intent(in) :: reason
    integer :: k
    do k = 1, plan%n
      if (plan%feature(k)%name /= name) cycle
      plan%feature(k)%on = on
      plan%feature(k)%reason = reason
      return
    end do
    call add_feature(plan, name, on, reason)
  end subroutine set_feature

  !> One line of the plan.
  pure function plan_line(plan, k) result(line)
    type(plan_t), intent(in) :: plan
    integer, intent(in) :: k
    character(:), allocatable :: line
    line = '  '//plan%feature(k)%name//merge('on   ', 'off  ', plan%feature(k)%on)
    line = line//plan%feature(k)%reason
  end function plan_line

end module run_plan
