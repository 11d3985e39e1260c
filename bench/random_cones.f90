! SPDX-License-Identifier: BSD-3-Clause
!> Random contact problems by condition, friction and redundancy: how many AUTO certifies, how
!> many it names as failed. Any answer that is neither is counted as wrong.
!>   random_cones [problems] [tolerance]
program random_cones
  use base_kinds, only: wp, zero
  use base_status, only: status_t, failed
  use cone_blocks, only: delassus_blocks_t
  use cone_solver, only: solve_cone
  use cone_types, only: cone_options_t, cone_work_t, certificate_t
  use random_contacts, only: make_problem
  implicit none
  real(wp), parameter :: conditions(4) = [1.0_wp, 1.0e4_wp, 1.0e8_wp, 1.0e12_wp]
  real(wp), parameter :: frictions(6) = [0.0_wp, 0.1_wp, 0.7_wp, 10.0_wp, 1.0e3_wp, 1.0e6_wp]
  real(wp), parameter :: redundancies(3) = [1.0_wp, 2.0_wp, 5.0_wp]
  integer :: problems, i, c, f, e, seed_size, failures(4, 6, 3), counts(4, 6, 3)
  real(wp) :: tolerance
  problems = 10000
  tolerance = 1.0e-8_wp
  call read_arguments()
  call random_seed(size=seed_size)
  call random_seed(put=[(4711 + i, i=1, seed_size)])
  failures = 0
  counts = 0
  do i = 1, problems
    c = 1 + mod(i, 4)
    f = 1 + mod(i/4, 6)
    e = 1 + mod(i/24, 3)
    counts(c, f, e) = counts(c, f, e) + 1
    if (.not. solved(2 + mod(i/72, 2), conditions(c), redundancies(e), frictions(f))) &
        failures(c, f, e) = failures(c, f, e) + 1
  end do
  write (*, '(a,i0,a,es8.1)') 'problems ', problems, ', tolerance', tolerance
  write (*, '(a)') 'named failures of problems; condition 1, 1e4, 1e8, 1e12'
  do e = 1, 3
    do f = 1, 6
      write (*, '(a,f4.1,a,es8.1,4(i6,a,i5))') 'redundancy', redundancies(e), ', mu', &
          frictions(f), (failures(c, f, e), ' of', counts(c, f, e), c=1, 4)
    end do
  end do
  write (*, '(i0,a,i0,a)') sum(failures), ' failures, ', sum(failures(:, 1, :)), ' at mu = 0'

contains

  subroutine read_arguments()
    character(32) :: word
    call get_command_argument(1, word)
    if (len_trim(word) > 0) read (word, *) problems
    call get_command_argument(2, word)
    if (len_trim(word) > 0) read (word, *) tolerance
  end subroutine read_arguments

  logical function solved(d, condition, redundancy, mu_1)
    integer, intent(in) :: d
    real(wp), intent(in) :: condition, redundancy, mu_1
    type(delassus_blocks_t) :: w
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp), allocatable :: q(:, :), mu(:), r(:, :)
    real(wp) :: x
    integer :: nc
    call random_number(x)
    nc = int(40.0_wp**x)
    allocate (q(d, nc), mu(nc), r(d, nc))
    mu = mu_1
    call make_problem(d, nc, condition, redundancy, mu_1, w, q)
    options%tolerance = tolerance
    options%max_sweeps = 2000
    r = zero
    call solve_cone(options, w, q, mu, r, work, certificate, status)
    solved = .not. failed(status)
    if (solved .and. .not. certificate%met) stop 'an answer without certificate'
  end function solved

end program random_cones
