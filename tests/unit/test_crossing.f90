! SPDX-License-Identifier: BSD-3-Clause
!> Two roofs that meet ridge across ridge: with rows of edges they stand apart; without them,
!> which no deck can ask for, the nodes notice when they are deep in each other.
program test_crossing
  use base_kinds, only: wp
  use base_status, only: status_t, failed, status_text
  use check, only: test_start, test_end, check_true
  use contact_space_base, only: space_t
  use deck_parameter, only: override_t
  use run_data, only: run_t
  use run_loop, only: advance
  use run_setup, only: read_scene, set_up
  implicit none
  character(512) :: root
  real(wp) :: closest

  call test_start('crossing')
  call get_environment_variable('ROOT', root)
  call cross_roofs(.true., closest)
  call check_true(closest > -1.0e-6_wp, 'with rows of edges the ridges stand apart')
  call cross_roofs(.false., closest)
  call check_true(closest < -0.1_wp, 'without them they go .1 deep through each other')
  call test_end()

contains

  !> 100 steps, or until something fails; closest [L]: the least distance of the ridges.
  subroutine cross_roofs(watches_edges, closest)
    logical, intent(in) :: watches_edges
    real(wp), intent(out) :: closest
    type(run_t), allocatable :: run
    type(override_t) :: none(0)
    type(status_t) :: status
    integer :: k
    allocate (run)
    call run%timers%start()
    call read_scene(trim(root)//'/input/space/roofs.k', none, run, status)
    call set_up(run, status)
    call check_true(.not. failed(status), 'roofs.k: '//status_text(status))
    select type (pairing => run%contact%pairing(1)%item)
    class is (space_t)
      pairing%watches_edges = watches_edges
      pairing%safe_distance = -1.0_wp      ! listed anew, without pairs of edges
    end select
    closest = huge(closest)
    do k = 1, 100
      call advance(run, status)
      if (failed(status)) exit
      closest = min(closest, gap_of_ridges(run))
    end do
    if (watches_edges) call check_true(.not. failed(status), 'roofs.k: '//status_text(status))
  end subroutine cross_roofs

  !> Height of the upper ridge over the lower one where they cross [L]: at .13 along the lower,
  !> at .21 along the upper one.
  real(wp) function gap_of_ridges(run)
    type(run_t), intent(in) :: run
    gap_of_ridges = height(run, 0.21_wp, 2) - height(run, 0.13_wp, 1)
  end function gap_of_ridges

  !> z at a place along the ridge of a body, between the nodes of its middle edge, at -.4 and
  !> .4: the third nodes of sections 3 and 4 of 6.
  real(wp) function height(run, place, body)
    type(run_t), intent(in) :: run
    real(wp), intent(in) :: place
    integer, intent(in) :: body
    real(wp) :: s
    s = (place + 0.4_wp)/0.8_wp
    associate (a => 18*(body - 1) + 9, b => 18*(body - 1) + 12)
      height = (1.0_wp - s)*(run%model%x(3, a) + run%state%u(3, a)) &
          + s*(run%model%x(3, b) + run%state%u(3, b))
    end associate
  end function height

end program test_crossing
