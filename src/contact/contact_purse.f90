! SPDX-License-Identifier: BSD-3-Clause
!> Energy-safe closing of overlaps. A row is posed as u_n = n.H dU + c >= 0 with the gap g0 at
!> the start of the step: c = g0 where that is positive, else c = beta g0, 0 <= beta <= 1. The
!> work of the reactions of a step is
!>   - sum r_n c - sum mu r_n |u_t| + sum e_a,
!> so c > 0 takes energy, c = 0 is neutral (an overlap stays, but may not deepen), c < 0
!> gives r_n |c|. What is given must have been taken before in normal direction by the same
!> card: then the total energy never exceeds what was put in, whatever rows, frames and
!> edges come and go. With S = sum |g0| r_n over the overlaps the gain is beta S(beta), and
!> S grows with beta (without friction: minus the slope of the least value of a quadratic
!> program, which is concave in beta), so that gain(beta) <= beta S(1): one repeat is
!> enough.
module contact_purse
  use base_kinds, only: wp, zero, one
  use contact_pairing, only: purse_t
  use contact_types, only: contact_t
  implicit none
  private
  public :: start_purses, open_purses, set_offsets, purse_is_short

  !> Closing round-off is free: this share of the largest term of the energy ledger.
  real(wp), parameter :: round_off = 1.0e-12_wp
  !> A purse that was short stays shut until it holds this share of what was last wanted.
  real(wp), parameter :: worth_trying = 0.1_wp

contains

  !> A step begins: a purse that the last one left nearly empty is shut, so that it costs no
  !> second solve.
  pure subroutine start_purses(contact)
    type(contact_t), intent(inout) :: contact
    integer :: p
    do p = 1, size(contact%pairing)
      associate (purse => contact%pairing(p)%item%purse)
        purse%is_shut = purse%beta < one .and. purse%balance < worth_trying*purse%wanted
        purse%was_short = .false.
      end associate
    end do
  end subroutine start_purses

  !> beta for the rows as they are now, whatever those before them have asked for: 1, or 0
  !> of a purse that is shut.
  pure subroutine open_purses(contact)
    type(contact_t), intent(inout) :: contact
    integer :: p
    do p = 1, size(contact%pairing)
      associate (purse => contact%pairing(p)%item%purse)
        purse%beta = merge(zero, one, purse%is_shut)
      end associate
    end do
  end subroutine open_purses

  !> c of every row.
  pure subroutine set_offsets(contact)
    type(contact_t), intent(inout) :: contact
    real(wp) :: gap
    integer :: a
    associate (rows => contact%rows)
      do a = 1, rows%n
        gap = rows%gap(a) + rows%allowance(a)
        rows%offset(a) = gap
        if (gap < zero) rows%offset(a) = contact%pairing(rows%key(1, a))%item%purse%beta*gap
      end do
    end associate
  end subroutine set_offsets

  !> Does some pairing give back more than it has? Its beta falls to what it can pay, then to
  !> none. largest [F L]: of the terms of the energy ledger.
  logical function purse_is_short(contact, largest)
    type(contact_t), intent(inout) :: contact
    real(wp), intent(in) :: largest
    integer :: a, p
    purse_is_short = .false.
    if (.not. any(contact%rows%offset(:contact%rows%n) < zero)) return
    do p = 1, size(contact%pairing)
      contact%pairing(p)%item%purse%given = zero
      contact%pairing(p)%item%purse%taken = zero
    end do
    do a = 1, contact%rows%n
      call add_offset_work(contact%rows%r(1, a)*contact%rows%offset(a), &
          contact%pairing(contact%rows%key(1, a))%item%purse)
    end do
    do p = 1, size(contact%pairing)
      associate (pairing => contact%pairing(p)%item)
        if (.not. pairing%is_energy_safe .or. .not. pairing%purse%given > zero) cycle
        associate (purse => pairing%purse)
          if (purse%given <= purse%balance + purse%taken + round_off*largest) cycle
          purse_is_short = .true.
          call lower_beta(purse)
        end associate
      end associate
    end do
  end function purse_is_short

  pure subroutine add_offset_work(work, purse)
    real(wp), intent(in) :: work
    type(purse_t), intent(inout) :: purse
    purse%given = purse%given + max(zero, -work)
    purse%taken = purse%taken + max(zero, work)
  end subroutine add_offset_work

  !> First to what the purse can pay, then to nothing.
  pure subroutine lower_beta(purse)
    type(purse_t), intent(inout) :: purse
    if (purse%beta < one) then
      purse%beta = zero
    else
      purse%wanted = purse%given
      purse%beta = min(one - epsilon(one), max(zero, (purse%balance + purse%taken)/purse%given))
      if (.not. purse%was_short) purse%short_steps = purse%short_steps + 1
      purse%was_short = .true.
    end if
  end subroutine lower_beta

end module contact_purse
