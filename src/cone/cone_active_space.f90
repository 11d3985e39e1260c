! SPDX-License-Identifier: BSD-3-Clause
!> Direct solves for given statuses in space. A contact that slips in the direction e has
!>   r = r_n (n - mu e) + s e_x,   u_n = 0,   e_x.u + |u_t|/(mu r_n) s = 0,
!> e_x across e: Newton's step for |u_t| r_t + mu r_n u_t = 0 (Alart & Curnier 1991), after
!> which r_t has turned and gets its length back. Where none slips one step is exact.
module cone_active_space
  use base_kinds, only: wp, zero, one, half
  use cone_certificate, only: evaluate_certificate
  use cone_dense, only: delassus_dense_t
  use cone_local, only: in_cone, tangent_length
  use cone_types, only: cone_work_t, certificate_t, size_active_set, contact_open, &
      contact_stick, contact_slip
  use linalg_dense, only: solve_general
  implicit none
  private
  public :: try_active_space

  integer, parameter :: most_steps = 6

contains

  !> r (3, nc), work%u (3, nc) and certificate for the statuses work%status, from r and u as
  !> they are; all stay where that meets no better certificate. m is the mean diagonal of W
  !> [L/F], certificate that of r.
  subroutine try_active_space(tolerance, w, q, mu, m, r, work, certificate)
    real(wp), intent(in) :: tolerance
    type(delassus_dense_t), intent(in) :: w
    real(wp), intent(in), contiguous :: q(:, :), mu(:)
    real(wp), intent(in) :: m
    real(wp), intent(inout), contiguous :: r(:, :)
    type(cone_work_t), intent(inout) :: work
    type(certificate_t), intent(inout) :: certificate
    type(certificate_t) :: trial
    real(wp) :: last
    logical :: ok
    integer :: k
    call size_active_set(work)
    last = huge(last)
    work%tried = work%status
    work%trial = r
    work%trial_u = work%u
    do k = 1, most_steps
      certificate%active_set_solves = certificate%active_set_solves + 1
      call take_step(w%matrix, q, mu, m, work, ok)
      if (.not. ok) return
      call w%displacements(q, work%trial, work%trial_u)
      trial = certificate
      call evaluate_certificate(m, mu, q, work%trial, work%trial_u, tolerance, trial)
      if (trial%error > half*last) return
      if (trial%met .and. trial%error >= certificate%error) return
      last = trial%error
      if (trial%met) then
        certificate = trial
        r = work%trial
        work%u = work%trial_u
      end if
      if (.not. any(work%status == contact_slip .and. mu > zero)) return
    end do
  end subroutine try_active_space

  !> work%trial from work%trial and work%trial_u. ok is false if the system is singular, or a
  !> reaction leaves its cone.
  subroutine take_step(w, q, mu, m, work, ok)
    real(wp), intent(in) :: w(:, :), q(:, :), mu(:), m
    type(cone_work_t), intent(inout) :: work
    logical, intent(out) :: ok
    real(wp) :: across(2, size(mu)), length
    integer :: a, i, n
    call list_unknowns(mu, work, n)
    ok = n > 0
    if (.not. ok) return
    call find_across(mu, work, across)
    call fill_system(w, q, mu, m, across, n, work)
    call solve_general(n, work%matrix, work%rhs, work%pivot, ok)
    if (.not. ok) return
    work%trial = zero
    do i = 1, n
      a = work%unknown(2, i)
      work%trial(:, a) = work%trial(:, a) + &
          work%rhs(i, 1)*force_of(work%unknown(1, i), work%status(a), mu(a), across(:, a))
    end do
    do a = 1, size(mu)
      if (work%status(a) == contact_slip) then
        ok = ok .and. work%trial(1, a) >= zero
        length = tangent_length(work%trial(:, a))
        if (length > zero) &
            work%trial(2:, a) = work%trial(2:, a)*(mu(a)*work%trial(1, a)/length)
      else
        ok = ok .and. in_cone(mu(a), work%trial(:, a))
      end if
    end do
  end subroutine take_step

  !> work%unknown(:, :n): component and contact. A contact that slips has r_n and, with
  !> friction, s (component 3).
  pure subroutine list_unknowns(mu, work, n)
    real(wp), intent(in) :: mu(:)
    type(cone_work_t), intent(inout) :: work
    integer, intent(out) :: n
    integer :: a, k
    n = 0
    do a = 1, size(mu)
      if (work%status(a) == contact_open) cycle
      do k = 1, 3
        if (k == 2 .and. work%status(a) == contact_slip) cycle
        if (k == 3 .and. work%status(a) == contact_slip .and. .not. mu(a) > zero) cycle
        n = n + 1
        work%unknown(:, n) = [k, a]
      end do
    end do
  end subroutine list_unknowns

  !> e_x (2, nc) of the contacts that slip: a quarter turn from e, which is against r_t, or
  !> along u_t where there is none.
  pure subroutine find_across(mu, work, across)
    real(wp), intent(in) :: mu(:)
    type(cone_work_t), intent(in) :: work
    real(wp), intent(out) :: across(:, :)
    real(wp) :: e(2), length
    integer :: a
    across = zero
    do a = 1, size(mu)
      if (work%status(a) /= contact_slip) cycle
      e = -work%trial(2:, a)
      if (.not. maxval(abs(e)) > zero) e = work%trial_u(2:, a)
      length = sqrt(e(1)**2 + e(2)**2)
      if (.not. length > zero) e = [one, zero]
      if (length > zero) e = e/length
      across(:, a) = [-e(2), e(1)]
    end do
  end subroutine find_across

  !> One column per unknown, one row for the displacement that belongs to it.
  pure subroutine fill_system(w, q, mu, m, across, n, work)
    real(wp), intent(in) :: w(:, :), q(:, :), mu(:), m, across(:, :)
    integer, intent(in) :: n
    type(cone_work_t), intent(inout) :: work
    real(wp) :: column(size(w, 1)), force(3), slip
    integer :: a, b, i, j, k
    do j = 1, n
      b = work%unknown(2, j)
      force = force_of(work%unknown(1, j), work%status(b), mu(b), across(:, b))
      column = zero
      do k = 1, 3
        if (abs(force(k)) > zero) column = column + force(k)*w(:, 3*(b - 1) + k)
      end do
      do i = 1, n
        a = work%unknown(2, i)
        work%matrix(i, j) = component_of(work%unknown(1, i), work%status(a), across(:, a), &
            column(3*a - 2:3*a))
      end do
      work%rhs(j, 1) = -component_of(work%unknown(1, j), work%status(b), across(:, b), q(:, b))
      if (work%status(b) /= contact_slip .or. work%unknown(1, j) == 1) cycle
      slip = tangent_length(work%trial_u(:, b))
      ! Nothing pushes yet: stiff, not infinite.
      if (slip > zero) work%matrix(j, j) = work%matrix(j, j) + &
          slip/max(mu(b)*work%trial(1, b), epsilon(one)*slip/m)
    end do
  end subroutine fill_system

  !> The force of a unit of an unknown.
  pure function force_of(k, status, mu, across) result(force)
    integer, intent(in) :: k, status
    real(wp), intent(in) :: mu, across(2)
    real(wp) :: force(3)
    force = zero
    if (status == contact_stick) then
      force(k) = one
    else if (k == 1) then
      force = [one, -mu*across(2), mu*across(1)]
    else
      force(2:) = across
    end if
  end function force_of

  !> The component of u that the equation of an unknown is about.
  pure real(wp) function component_of(k, status, across, u) result(component)
    integer, intent(in) :: k, status
    real(wp), intent(in) :: across(2), u(3)
    if (status == contact_stick .or. k == 1) then
      component = u(k)
    else
      component = across(1)*u(2) + across(2)*u(3)
    end if
  end function component_of

end module cone_active_space
