! SPDX-License-Identifier: BSD-3-Clause
!> What changes during a run, apart from contact and ledger: everything a restart must hold of
!> the bodies.
module model_state
  use base_archive, only: archive_t
  use base_kinds, only: wp, zero
  implicit none
  private

  type, public :: state_t
    integer :: cycle = 0
    real(wp) :: time = zero
    real(wp), allocatable :: u(:, :)    !< (dim, n) displacement [L]
    real(wp), allocatable :: v(:, :)    !< (dim, n) velocity [L/T]
    real(wp), allocatable :: du(:, :)   !< (dim, n) displacement of the step just done [L]
    !> (dim, n) acceleration [L/T2], only for schemes that have one
    real(wp), allocatable :: a(:, :)
    !> (dim, n) acceleration of the smooth forces alone, only for schemes that keep it apart
    real(wp), allocatable :: a_smooth(:, :)
    real(wp) :: h_last = zero           !< length of the step just done [T]
  end type state_t

  public :: make_state, exchange_state

contains

  !> The state at t = 0.
  pure subroutine make_state(v0, with_acceleration, state)
    real(wp), intent(in) :: v0(:, :)
    logical, intent(in) :: with_acceleration
    type(state_t), intent(out) :: state
    allocate (state%u, state%v, state%du, mold=v0)
    state%u = zero
    state%v = v0
    state%du = zero
    if (.not. with_acceleration) return
    allocate (state%a, mold=v0)
    state%a = zero
  end subroutine make_state

  !> Saves to or restores from the archive.
  subroutine exchange_state(archive, state)
    type(archive_t), intent(inout) :: archive
    type(state_t), intent(inout) :: state
    call archive%exchange('state.cycle', state%cycle)
    call archive%exchange('state.time', state%time)
    call archive%exchange('state.h', state%h_last)
    call archive%exchange('state.u', state%u)
    call archive%exchange('state.v', state%v)
    call archive%exchange('state.du', state%du)
    if (allocated(state%a)) call archive%exchange('state.a', state%a)
    if (allocated(state%a_smooth)) call archive%exchange('state.a_smooth', state%a_smooth)
  end subroutine exchange_state

end module model_state
