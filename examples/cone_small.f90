! SPDX-License-Identifier: BSD-3-Clause
!> The contact solver on its own: a block slides on two feet.
!>
!> Problem. A rigid block of mass M, inertia J moves with velocity v along a floor, on feet at
!> (-a, -b) and (a, -b) from its centre, pressed down by gravity g. In a step of length h the
!> floor gives impulses r = (normal, tangential) to the feet, in Coulomb's cone of friction mu:
!>
!>           +-------------+
!>           |      o  --> v       u = H V1,  M V1 = M V0 + h F + H' r,
!>           +-------------+       so u = W r + q with W = H M^-1 H', q = H (V0 + h F/M),
!>           /\          /\        and u_n >= 0, r_n >= 0, u_n r_n = 0, r_t = -mu r_n u_t/|u_t|
!>     ------ 1 --------- 2 -----
!>
!> The solver asks for W, q and mu alone; here u are velocities and r impulses, in the step of
!> bipact displacements and forces.
!>
!> Solution. Both feet slip and none lifts. Sums of forces and moments give
!>   r_n = M g h/2 (1 - mu b/a) and M g h/2 (1 + mu b/a),  r_t = -mu r_n,  v1 = v - mu g h.
!>
!> Shown: sizing and filling a dense W, one call of solve_cone, what the certificate says.
!> See also: doc/library.md, doc/contact-solver.md.
!>
!> Expected output:
!>    foot     normal  tangential   (closed form)
!>       1   0.085000   -0.025500     0.085000   -0.025500
!>       2   0.115000   -0.034500     0.115000   -0.034500
!>    velocity of the feet  0.970000  (closed form  0.970000)
!>    certificate met, error  4.7E-17, eta  3.3E-17
program cone_small
  use base_kinds, only: wp
  use base_status, only: status_t, failed, status_text
  use cone_dense, only: delassus_dense_t
  use cone_solver, only: solve_cone
  use cone_types, only: cone_options_t, cone_work_t, certificate_t
  implicit none
  integer, parameter :: feet = 2, d = 2            ! contacts, components of each
  real(wp), parameter :: m = 2.0_wp, j = 0.8_wp, a = 1.0_wp, b = 0.5_wp, g = 10.0_wp
  real(wp), parameter :: h = 0.01_wp, v = 1.0_wp, friction = 0.3_wp
  real(wp), parameter :: tolerance = 1.0e-9_wp     ! ten times that of the certificate
  type(cone_options_t) :: options                  ! solver AUTO, tolerance 1e-10
  type(delassus_dense_t) :: w
  type(cone_work_t) :: work
  type(certificate_t) :: certificate
  type(status_t) :: status
  real(wp) :: map(d*feet, 3)                       ! H: rows (n, t) of each foot; vx, vy, omega
  real(wp) :: inverse_mass(3), free(3)
  real(wp) :: q(d, feet), mu(feet), r(d, feet), exact(d, feet)
  integer :: k

  ! H, M^-1, and the velocity at the end of a step without contact.
  do k = 1, feet
    map(d*k - 1, :) = [0.0_wp, 1.0_wp, merge(-a, a, k == 1)]
    map(d*k, :) = [1.0_wp, 0.0_wp, b]
  end do
  inverse_mass = 1.0_wp/[m, m, j]
  free = [v, -g*h, 0.0_wp]

  ! The contact problem: W (d feet, d feet), q (d, feet), mu (feet).
  call w%resize(d, feet)
  w%matrix = matmul(map*spread(inverse_mass, 1, d*feet), transpose(map))
  q = reshape(matmul(map, free), [d, feet])
  mu = friction

  ! r is the start on entry; work keeps its space for the next call of the same size.
  r = 0.0_wp
  call solve_cone(options, w, q, mu, r, work, certificate, status)
  if (failed(status)) then
    print '(a)', status_text(status)
    stop 1
  end if

  exact(1, :) = m*g*h/2.0_wp*[1.0_wp - friction*b/a, 1.0_wp + friction*b/a]
  exact(2, :) = -friction*exact(1, :)
  print '(a)', 'foot     normal  tangential   (closed form)'
  print '(i4, f11.6, f12.6, f13.6, f12.6)', (k, r(:, k), exact(:, k), k=1, feet)
  print '(a, f9.6, a, f9.6, a)', 'velocity of the feet ', work%u(2, 1), '  (closed form ', &
      v - friction*g*h, ')'
  print '(a, es8.1, a, es8.1)', 'certificate '//trim(merge('met   ', 'missed', &
      certificate%met))//', error ', certificate%error, ', eta ', certificate%eta
  if (maxval(abs(r - exact)) > tolerance*maxval(exact)) stop 1
end program cone_small
