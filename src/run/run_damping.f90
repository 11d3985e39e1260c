! SPDX-License-Identifier: BSD-3-Clause
!> Damping of the deck in the run: its coefficients in force, its force in the right-hand side
!> of a stage, and its work. Only scenes that have damping come here. What a stage says (c_c,
!> rate_weight) is all that is needed of a scheme.
module run_damping
  use assembly_damping, only: set_mass_damping, subtract_damping_force
  use base_archive, only: archive_t, archive_restore
  use base_kinds, only: wp, zero, one
  use model_data, only: curve_value
  use run_data, only: run_t
  use time_base, only: stage_t
  implicit none
  private
  public :: make_damping, start_damping, update_damping, subtract_damping, keep_damping, &
      damping_work, exchange_damping

contains

  !> Work space, and the coefficients of a step from t = 0 to t1.
  subroutine make_damping(run, t1)
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: t1
    integer :: cards
    logical :: changed
    cards = 0
    if (allocated(run%model%mass_damping)) cards = size(run%model%mass_damping)
    allocate (run%damping)
    allocate (run%damping%value(cards), run%damping%rate(run%system%dim, run%system%n), &
        run%damping%force(run%system%dim, run%system%n))
    run%damping%value = -one
    run%damping%force = zero
    call update_damping(run, t1, changed)
  end subroutine make_damping

  !> After the start of a scheme. One that counts forces of both ends of a step begins with
  !> C V0.
  subroutine start_damping(run)
    type(run_t), intent(inout) :: run
    run%damping%force = zero
    if (damped_stage(run) == 0 .or. .not. run%scheme%weight_before > zero) return
    if (.not. allocated(run%damping%force_before)) &
        allocate (run%damping%force_before(run%system%dim, run%system%n), source=zero)
    call subtract_damping_force(run%system, -one, run%state%v, run%damping%force)
  end subroutine start_damping

  !> Coefficients for the step that ends at t1: curves have the weights of the loads, so that C
  !> belongs to the moment of the stage's equation. changed: the effective matrix is another.
  subroutine update_damping(run, t1, changed)
    type(run_t), intent(inout) :: run
    real(wp), intent(in) :: t1
    logical, intent(out) :: changed
    real(wp) :: value, weight(2)
    integer :: k, s
    logical :: is_new
    changed = .false.
    s = damped_stage(run)
    if (s == 0 .or. size(run%damping%value) == 0) return
    weight = run%scheme%stage(s)%load_weight/sum(run%scheme%stage(s)%load_weight)
    is_new = .false.
    do k = 1, size(run%damping%value)
      associate (card => run%model%mass_damping(k))
        value = card%factor
        if (card%curve > 0) value = card%factor &
            *(weight(1)*curve_value(run%model%curve(card%curve), run%state%time) &
            + weight(2)*curve_value(run%model%curve(card%curve), t1))
      end associate
      is_new = is_new .or. abs(value - run%damping%value(k)) > zero
      run%damping%value(k) = value
    end do
    if (is_new) call set_mass_damping(run%model, run%damping%value, run%system)
    changed = is_new .and. run%scheme%stage(s)%c_c > zero
  end subroutine update_damping

  !> The stage that C is in; 0 in statics.
  pure integer function damped_stage(run)
    type(run_t), intent(in) :: run
    do damped_stage = size(run%scheme%stage), 1, -1
      if (is_damped(run%scheme%stage(damped_stage))) return
    end do
  end function damped_stage

  pure logical function is_damped(stage)
    type(stage_t), intent(in) :: stage
    is_damped = abs(stage%c_c) > zero .or. any(abs(stage%rate_weight) > zero)
  end function is_damped

  !> b = b - C (w1 V0 + w2 A0).
  subroutine subtract_damping(run, stage)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    if (.not. any(abs(run%scheme%stage(stage)%rate_weight) > zero)) return
    run%damping%rate = zero
    call add_start_rate(run, stage)
    call subtract_damping_force(run%system, one, run%damping%rate, run%b)
  end subroutine subtract_damping

  !> rate = rate + w1 V0 + w2 A0, and what the scheme adds itself.
  subroutine add_start_rate(run, stage)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    associate (w => run%scheme%stage(stage)%rate_weight, rate => run%damping%rate)
      if (abs(w(1)) > zero) rate = rate + w(1)*run%state%v
      if (abs(w(2)) > zero) rate = rate + w(2)*run%state%a
      if (allocated(run%scheme%rate)) rate = rate + run%scheme%rate
    end associate
  end subroutine add_start_rate

  !> The damping force that acted in a stage, C (cC x + w1 V0 + w2 A0), from its motion x and
  !> the state before its update.
  subroutine keep_damping(run, stage)
    type(run_t), intent(inout) :: run
    integer, intent(in) :: stage
    associate (s => run%scheme%stage(stage), d => run%damping)
      if (.not. is_damped(s)) return
      if (allocated(d%force_before)) d%force_before = d%force
      d%rate = s%c_c*run%x
      call add_start_rate(run, stage)
      d%force = zero
      call subtract_damping_force(run%system, -one/s%rule%factor, d%rate, d%force)
    end associate
  end subroutine keep_damping

  !> Work of the damping forces in the step just done, counted like that of contact [F L].
  real(wp) function damping_work(run) result(work)
    type(run_t), intent(in) :: run
    if (allocated(run%scheme%conjugate)) then
      work = work_on(run, run%scheme%conjugate)
    else
      work = work_on(run, run%state%du)
    end if
  end function damping_work

  pure real(wp) function work_on(run, motion) result(work)
    type(run_t), intent(in) :: run
    real(wp), intent(in) :: motion(:, :)
    work = run%scheme%weight_now*sum(motion*run%damping%force)
    if (allocated(run%damping%force_before)) &
        work = work + run%scheme%weight_before*sum(motion*run%damping%force_before)
  end function work_on

  !> Saves to or restores from the archive: the coefficients in force, from which C is made
  !> anew, and the force of the last end where the next step counts it.
  subroutine exchange_damping(archive, run)
    type(archive_t), intent(inout) :: archive
    type(run_t), intent(inout) :: run
    call archive%exchange('damping.value', run%damping%value)
    if (allocated(run%damping%force_before)) &
        call archive%exchange('damping.force', run%damping%force)
    if (archive%mode == archive_restore .and. size(run%damping%value) > 0) &
        call set_mass_damping(run%model, run%damping%value, run%system)
  end subroutine exchange_damping

end module run_damping
