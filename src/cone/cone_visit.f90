! SPDX-License-Identifier: BSD-3-Clause
!> A visit of Gauss-Seidel to one contact by the local solver that was chosen. Exact and Newton
!> have no answer at times (wedging, singular W_aa, no way down): then projections take the
!> visit.
module cone_visit
  use base_kinds, only: wp, zero, one, half
  use cone_exact, only: solve_exact
  use cone_local, only: contact_map, size_of, solve_local, tangent_length
  use cone_types, only: cone_options_t, local_exact, local_newton, most_components
  use linalg_dense, only: solve_small
  implicit none
  private
  public :: visit_contact

contains

  !> r (d) and u (d) of one contact, W_aa = w (d, d), until r moves less than `enough` or after
  !> `most` iterations; on entry u belongs to r, on exit too.
  pure subroutine visit_contact(options, w, mu, rho, enough, most, r, u, status, iterations)
    type(cone_options_t), intent(in) :: options
    real(wp), intent(in) :: w(:, :)
    real(wp), intent(in) :: mu, rho, enough
    integer, intent(in) :: most
    real(wp), intent(inout), contiguous :: r(:), u(:)
    integer, intent(out) :: status, iterations
    logical :: done
    select case (options%local)
    case (local_exact)
      iterations = 1
      call solve_exact(w, mu, r, u, status, done)
      if (done) return
    case (local_newton)
      call solve_newton(w, mu, rho, enough, most, r, u, status, iterations, done)
      if (done) return
    end select
    call solve_local(w, mu, rho, enough, most, r, u, status, iterations)
  end subroutine visit_contact

  !> Newton on r = P_K(tau) of one contact with line search; done is false where the system is
  !> singular or no step goes down: the last point is then kept.
  pure subroutine solve_newton(w, mu, rho, enough, most, r, u, status, iterations, done)
    real(wp), intent(in) :: w(:, :)
    real(wp), intent(in) :: mu, rho, enough
    integer, intent(in) :: most
    real(wp), intent(inout), contiguous :: r(:), u(:)
    integer, intent(out) :: status, iterations
    logical, intent(out) :: done
    integer, parameter :: most_halvings = 6
    real(wp), dimension(most_components) :: map, step, r_new, u_new, map_new, move
    real(wp), dimension(most_components, most_components) :: part, part_new, jacobian
    real(wp) :: length
    integer :: d, i, k
    d = size(r)
    call contact_map(mu, rho, r, u, map(:d), part(:d, :d), status)
    do iterations = 1, most
      done = size_of(d, map) <= enough
      if (done) exit
      call fill_jacobian(w, mu, rho, u, part(:d, :d), jacobian(:d, :d))
      move(:d) = -map(:d)
      call solve_small(jacobian(:d, :d), move(:d), step(:d), done)
      if (.not. done) exit
      length = one
      do k = 1, most_halvings
        r_new(:d) = r + length*step(:d)
        u_new(:d) = u
        move(:d) = length*step(:d)
        do i = 1, d
          u_new(:d) = u_new(:d) + w(:, i)*move(i)
        end do
        call contact_map(mu, rho, r_new(:d), u_new(:d), map_new(:d), part_new(:d, :d), status)
        done = sum(map_new(:d)**2) < sum(map(:d)**2)
        if (done) exit
        length = half*length
      end do
      if (.not. done) exit
      r = r_new(:d)
      u = u_new(:d)
      map = map_new
      part = part_new
      if (size_of(d, move) <= enough) exit
    end do
    iterations = min(iterations, most)
    call project_once(w, mu, rho, r, u, status)
  end subroutine solve_newton

  !> A last projection, so that r is in the cone.
  pure subroutine project_once(w, mu, rho, r, u, status)
    real(wp), intent(in) :: w(:, :), mu, rho
    real(wp), intent(inout), contiguous :: r(:), u(:)
    integer, intent(out) :: status
    integer :: iterations
    call solve_local(w, mu, rho, zero, 1, r, u, status, iterations)
  end subroutine project_once

  !> I - dP (I - rho (I + mu e_n t') w), t the direction of u_t.
  pure subroutine fill_jacobian(w, mu, rho, u, part, jacobian)
    real(wp), intent(in) :: w(:, :), mu, rho, u(:), part(:, :)
    real(wp), intent(out) :: jacobian(:, :)
    real(wp) :: column(most_components), length
    integer :: d, i, j
    d = size(u)
    length = tangent_length(u)
    do j = 1, d
      column(:d) = rho*w(:, j)
      if (length > zero) column(1) = column(1) + mu*dot_product(u(2:), column(2:d))/length
      column(j) = column(j) - one
      jacobian(:, j) = zero
      do i = 1, d
        jacobian(:, j) = jacobian(:, j) + part(:, i)*column(i)
      end do
      jacobian(j, j) = jacobian(j, j) + one
    end do
  end subroutine fill_jacobian

end module cone_visit
