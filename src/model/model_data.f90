! SPDX-License-Identifier: BSD-3-Clause
!> The scene as data: nodes, elements, parts, sets, loads, contact pairs, requests.
!> Made once from the deck; nothing in it changes during the run.
module model_data
  use base_kinds, only: wp
  use material_base, only: material_slot_t
  implicit none
  private

  type, public :: part_t
    integer :: id = 0
    integer :: section_id = 0
    integer :: material_id = 0
    integer :: material = 0         !< row in model%material
    integer :: plane = 0            !< plane_stress or plane_strain
    real(wp) :: thickness = 1.0_wp  !< [L]
    integer :: record = 0           !< its card, for messages
    character(80) :: heading = ''
  end type part_t

  type, public :: section_t
    integer :: id = 0
    integer :: plane = 0
    real(wp) :: thickness = 1.0_wp
  end type section_t

  type, public :: set_t
    integer :: id = 0
    integer, allocatable :: member(:)  !< rows (not ids) of nodes or parts
  end type set_t

  type, public :: curve_t
    integer :: id = 0
    real(wp), allocatable :: a(:)   !< times [T], increasing
    real(wp), allocatable :: o(:)
  end type curve_t

  !> Nodal force: value = factor * curve, on each node of the list.
  type, public :: load_t
    integer, allocatable :: node(:)
    integer :: direction = 1
    integer :: curve = 0
    real(wp) :: factor = 1.0_wp
  end type load_t

  !> Body load: acceleration of all mass = - factor * curve [L/T2].
  type, public :: gravity_t
    integer :: direction = 1
    integer :: curve = 0
    real(wp) :: factor = 1.0_wp
  end type gravity_t

  type, public :: contact_card_t
    integer :: id = 0
    integer :: side(2) = 0          !< > 0 part set id, < 0 node set id
    real(wp) :: mu = 0.0_wp
    real(wp) :: birth = 0.0_wp      !< [T]
    real(wp) :: death = huge(1.0_wp)
    integer :: record = 0
  end type contact_card_t

  !> Which tables are asked for, and how often; 0 = off [T].
  type, public :: requests_t
    real(wp) :: glstat = 0.0_wp
    real(wp) :: matsum = 0.0_wp
    real(wp) :: nodout = 0.0_wp
    real(wp) :: rcforc = 0.0_wp
    real(wp) :: sleout = 0.0_wp
    real(wp) :: timing = 0.0_wp
    integer, allocatable :: history_node(:)
  end type requests_t

  type, public :: controls_t
    real(wp) :: end_time = 0.0_wp
    integer :: end_cycle = 0
    real(wp) :: dt = 0.0_wp
    character(10) :: scheme = 'NEWMARK'
    real(wp) :: theta = 0.5_wp
    real(wp) :: xi = 0.5_wp
    real(wp) :: gamma = 0.5_wp
    real(wp) :: beta = 0.25_wp
    character(10) :: mass = 'CONSISTENT'
    logical :: redistribute = .false.
    real(wp) :: courant = -1.0_wp       !< of DISPERSION; < 0 = from dt
    integer :: ledger_every = 0
    real(wp) :: growth = 1.0e-9_wp
    logical :: stop_on_growth = .false.
    real(wp) :: rotation_warning = 5.0_wp      !< [degrees]
    real(wp) :: penetration_tolerance = 1.0e-9_wp
  end type controls_t

  type, public :: model_t
    character(80) :: title = ''
    integer :: nodes = 0
    integer, allocatable :: node_id(:)
    real(wp), allocatable :: x(:, :)         !< (2, nodes) [L]
    real(wp), allocatable :: v0(:, :)        !< (2, nodes) initial velocity [L/T]
    logical, allocatable :: fixed(:, :)      !< (2, nodes)
    integer :: elements = 0
    integer, allocatable :: element_id(:)
    integer, allocatable :: element_part(:)
    integer, allocatable :: element_record(:)
    integer, allocatable :: connectivity(:, :)  !< (4, elements) rows of nodes
    type(part_t), allocatable :: part(:)
    type(material_slot_t), allocatable :: material(:)
    type(set_t), allocatable :: node_set(:)
    type(set_t), allocatable :: part_set(:)
    type(curve_t), allocatable :: curve(:)
    type(load_t), allocatable :: load(:)
    type(gravity_t), allocatable :: gravity(:)
    type(contact_card_t), allocatable :: contact(:)
    type(requests_t) :: requests
    type(controls_t) :: controls
  end type model_t

  public :: curve_value, find_set

contains

  !> Piecewise linear value of a curve; constant outside its range.
  pure real(wp) function curve_value(curve, time)
    type(curve_t), intent(in) :: curve
    real(wp), intent(in) :: time
    integer :: k
    associate (a => curve%a, o => curve%o, n => size(curve%a))
      if (time <= a(1)) then
        curve_value = o(1)
      else if (time >= a(n)) then
        curve_value = o(n)
      else
        do k = 2, n
          if (time <= a(k)) exit
        end do
        curve_value = o(k - 1) + (o(k) - o(k - 1))*((time - a(k - 1))/(a(k) - a(k - 1)))
      end if
    end associate
  end function curve_value

  !> Row of a set by its id, 0 if there is none.
  pure integer function find_set(sets, id)
    type(set_t), intent(in) :: sets(:)
    integer, intent(in) :: id
    do find_set = 1, size(sets)
      if (sets(find_set)%id == id) return
    end do
    find_set = 0
  end function find_set

end module model_data
