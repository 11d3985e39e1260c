! SPDX-License-Identifier: BSD-3-Clause
!> Contact with friction that depends on the speed of slip (contact_friction): the coefficient
!> of every row is that of its slip in the solution. A nested iteration: the contact problem
!> for given coefficients, coefficients of its slips, again; from the static ones down, so that
!> a row sticks wherever the law lets it. For one contact there is then one answer: where it
!> does not stick, mu - mu(|u_t|) has one zero, for it is concave in mu, negative at mu_k and
!> positive at mu_s.
module contact_slip
  use base_kinds, only: wp, zero, half
  use base_status, only: status_t, fail, failed, status_numerical
  use base_strings, only: to_text
  use cone_anderson, only: start_anderson, extrapolate
  use cone_solver, only: solve_cone
  use cone_types, only: certificate_t, contact_stick
  use contact_friction, only: friction_t, friction_varies, friction_at
  use contact_kinematics, only: tangential_length
  use contact_local, only: solve_local
  use contact_rule, only: level_velocity
  use contact_types, only: contact_t
  implicit none
  private
  public :: solve_friction

  !> Solves for the coefficients; the later ones go half the way, where whole ones cycle.
  integer, parameter :: most_passes = 100, whole_passes = 60
  !> Share of the tolerance of the solve that a coefficient may be off.
  real(wp), parameter :: share = 0.1_wp
  !> Changes that the acceleration keeps, and solves after which it begins anew.
  integer, parameter :: depth = 4, most_held = 15

contains

  !> Reactions of the condensed problem for q and the start in r, with the coefficients that go
  !> with their slips (contact%mu). Fails where they are not found.
  subroutine solve_friction(contact, certificate, status)
    type(contact_t), intent(inout) :: contact
    type(certificate_t), intent(out) :: certificate
    type(status_t), intent(inout) :: status
    integer :: pass, sweeps
    logical :: is_met
    if (.not. contact%friction_varies .or. contact%rule%is_frictionless) then
      call solve_condensed(contact, certificate, status)
      return
    end if
    call set_static(contact)
    sweeps = 0
    do pass = 1, most_passes
      call solve_condensed(contact, certificate, status)
      sweeps = sweeps + certificate%sweeps
      call find_friction(contact, is_met)
      if (is_met .or. failed(status)) exit
      call take_friction(contact, pass)
    end do
    certificate%sweeps = sweeps
    contact%tally%solves = contact%tally%solves + min(pass, most_passes) - 1
    contact%tally%solves_since_row = contact%tally%solves_since_row + min(pass, most_passes) - 1
    if (is_met .or. failed(status)) return
    certificate%met = .false.
    call fail(status, status_numerical, 'friction at the speed of slip was not found in '// &
        to_text(most_passes)//' contact solves', hint='take a smaller step or a smaller DC')
  end subroutine solve_friction

  !> Reactions for the coefficients as they are, by what is known of W.
  subroutine solve_condensed(contact, certificate, status)
    type(contact_t), intent(inout) :: contact
    type(certificate_t), intent(out) :: certificate
    type(status_t), intent(inout) :: status
    if (allocated(contact%local)) then
      call solve_local(contact, certificate, status)
    else
      call solve_cone(contact%cone, contact%w, contact%q, contact%mu, contact%r, contact%work, &
          certificate, status)
    end if
  end subroutine solve_condensed

  pure subroutine set_static(contact)
    type(contact_t), intent(inout) :: contact
    integer :: k
    do k = 1, contact%n
      associate (a => contact%row_of(k))
        contact%mu(k) = contact%pairing(contact%rows%key(1, a))%item%friction%static
      end associate
    end do
  end subroutine set_static

  !> Time by which the u_t of the law is a speed [T]: slip of a step on positions, u = now v on
  !> velocities, h v where the stage before has said what is pressed.
  pure real(wp) function slip_time(contact)
    type(contact_t), intent(in) :: contact
    slip_time = contact%step_length
    if (contact%rule%level == level_velocity) slip_time = contact%rule%now
  end function slip_time

  !> The coefficients of the slips as they are (mu_law). is_met: they
  !> are those of the solve, or of slips that differ by no more than its tolerance. A step of
  !> no length has no speed: static.
  pure subroutine find_friction(contact, is_met)
    type(contact_t), intent(inout) :: contact
    logical, intent(out) :: is_met
    real(wp) :: time, largest, slope
    integer :: k
    is_met = .true.
    time = slip_time(contact)
    largest = largest_slip(contact%d, contact%n, contact%r, contact%work%u)
    do k = 1, contact%n
      associate (mu => contact%mu(k), of_slip => contact%mu_law(k), law => &
          contact%pairing(contact%rows%key(1, contact%row_of(k)))%item%friction)
        of_slip = mu
        if (.not. friction_varies(law) .or. .not. time > zero) cycle
        if (.not. contact%r(1, k) > zero) cycle
        of_slip = law%static
        if (contact%work%status(k) /= contact_stick) of_slip = friction_at(law, &
            tangential_length(contact%d, contact%work%u(:, k))/time)
        slope = law%decay*(of_slip - law%kinetic)*largest/time
        is_met = is_met .and. &
            abs(of_slip - mu) <= contact%cone%tolerance*max(share, slope)
      end associate
    end do
  end subroutine find_friction

  !> The longest u_t of the contacts that push, r and u (d, n); negative where none does.
  pure real(wp) function largest_slip(d, n, r, u) result(largest)
    integer, intent(in) :: d, n
    real(wp), intent(in) :: r(d, n), u(d, n)
    integer :: k
    largest = -huge(largest)
    do k = 1, n
      if (r(1, k) > zero) largest = max(largest, tangential_length(d, u(:, k)))
    end do
  end function largest_slip

  !> Coefficients of the next solve: where the last few changes lead (Anderson 1965). A row
  !> whose slip asks for less than mu has its answer below mu, as far as it goes by itself:
  !> where they lead back, or out of such bounds, the slip decides.
  subroutine take_friction(contact, pass)
    type(contact_t), intent(inout) :: contact
    integer, intent(in) :: pass
    real(wp) :: plain(contact%n)
    integer :: k
    if (pass > whole_passes) then
      contact%mu = half*(contact%mu + contact%mu_law)
      return
    end if
    if (mod(pass, most_held) == 1) then
      call start_anderson(contact%mu_memory, contact%n, depth)
      contact%mu_bound(1, :) = -huge(zero)
      contact%mu_bound(2, :) = huge(zero)
    end if
    where (contact%mu_law > contact%mu) contact%mu_bound(1, :) = contact%mu
    where (contact%mu_law < contact%mu) contact%mu_bound(2, :) = contact%mu
    plain = contact%mu_law
    call extrapolate(contact%mu_memory, contact%n, contact%mu, contact%mu_law)
    do k = 1, contact%n
      associate (mu => contact%mu(k), next => contact%mu_law(k), &
          bound => contact%mu_bound(:, k), law => &
          contact%pairing(contact%rows%key(1, contact%row_of(k)))%item%friction)
        next = min(law%static, max(law%kinetic, next))
        if ((next - mu)*(plain(k) - mu) < zero .or. next <= bound(1) .or. next >= bound(2)) &
            next = plain(k)
        mu = next
      end associate
    end do
  end subroutine take_friction

end module contact_slip
