! SPDX-License-Identifier: BSD-3-Clause
!> Stacks, chains and cups of 10 to 2000 contacts, in the plane and in space: what AUTO needs for
!> them, how near the reactions come to what is known of them.
!>   structured_cones [tolerance]
program structured_cones
  use base_kinds, only: wp, zero
  use base_status, only: status_t, failed
  use cone_solver, only: solve_cone
  use cone_types, only: cone_options_t, cone_work_t, certificate_t
  use structured_contacts, only: structure_t, make_structure, misfit, structures
  implicit none
  integer, parameter :: sizes(4) = [10, 100, 1000, 2000]
  character(32) :: word
  real(wp) :: tolerance
  integer :: k, d, n, seed_size, i
  tolerance = 1.0e-8_wp
  call get_command_argument(1, word)
  if (len_trim(word) > 0) read (word, *) tolerance
  call random_seed(size=seed_size)
  call random_seed(put=[(4711 + i, i=1, seed_size)])
  write (*, '(a,es8.1)') 'structures, tolerance', tolerance
  write (*, '(a)') 'kind  d contacts  sweeps newton     ms   error    off what is known'
  do k = 1, size(structures)
    do d = 2, 3
      do n = 1, size(sizes)
        call solve_one(structures(k), d, sizes(n))
      end do
    end do
  end do

contains

  subroutine solve_one(kind, d, n)
    character(*), intent(in) :: kind
    integer, intent(in) :: d, n
    type(structure_t) :: s
    type(cone_options_t) :: options
    type(cone_work_t) :: work
    type(certificate_t) :: certificate
    type(status_t) :: status
    real(wp) :: r(d, n), start, finish
    call make_structure(kind, d, n, s)
    options%tolerance = tolerance
    options%max_sweeps = 100000
    r = zero
    call cpu_time(start)
    call solve_cone(options, s%w, s%q, s%mu, r, work, certificate, status)
    call cpu_time(finish)
    write (*, '(a5,i3,i9,i8,i7,f9.1,es9.1,es9.1,1x,a)') kind, d, n, certificate%sweeps, &
        certificate%newton_steps, 1.0e3_wp*(finish - start), certificate%error, misfit(s, r), &
        merge('not solved', '          ', failed(status))
  end subroutine solve_one

end program structured_cones
