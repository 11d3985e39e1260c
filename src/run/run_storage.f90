! SPDX-License-Identifier: BSD-3-Clause
!> How the contact problem of a scene is kept: S^-1 and W dense by bodies, or the near part of W
!> with solves for the rest, by the bytes that a step reads, which are counted before anything
!> of either is allocated.
module run_storage
  use assembly_system, only: stiffness_ratio
  use base_kinds, only: wp, i8, zero, half
  use base_messages, only: add_message
  use base_status, only: status_t, fail, failed, status_deck
  use base_strings, only: to_text
  use contact_local, only: start_local
  use contact_types, only: contact_t
  use deck_names, only: step_event
  use run_data, only: run_t
  use run_plan, only: set_feature
  implicit none
  private
  public :: choose_storage

  !> A dense W of so few bytes stays in the fast memory of a processor.
  real(wp), parameter :: small = 1.0e6_wp
  !> Sweeps of a contact solve that are counted with, and what building W takes, in sweeps.
  real(wp), parameter :: sweeps = 12.0_wp, building = 4.0_wp
  !> A byte of the factor takes so many times that of a dense column: the passes start anew at
  !> each column of blocks (10 against 22 GB/s of one core).
  real(wp), parameter :: factor_weight = 2.2_wp
  !> Elements times Courant number beyond which near parts do not pay.
  real(wp), parameter :: largest_courant = 10.0_wp

contains

  !> Takes the choice for the interface as it is: run%contact%local is there or not. Fails where
  !> the deck forces what the scene cannot have.
  subroutine choose_storage(run, status)
    type(run_t), intent(inout), target :: run
    type(status_t), intent(inout) :: status
    character(:), allocatable :: wanted, obstacle, reason
    real(wp) :: courant
    logical :: is_local
    if (.not. run%plan%contact) return
    wanted = trim(run%solver_options%contact_storage)
    obstacle = obstacle_of(run)
    courant = zero
    if (wanted /= 'DENSE' .and. obstacle == '') courant = courant_number(run)
    if (wanted == 'BLOCK' .and. courant > huge(courant)) &
        obstacle = 'statics, where forces act at any distance'
    if (any(wanted == [character(5) :: 'BLOCK', 'NONE']) .and. obstacle /= '') then
      call fail(status, status_deck, 'WSTORE '//wanted//' is not for '//obstacle, &
          hint='choose AUTO or DENSE on *BIPACT_CONTACT')
      return
    end if
    is_local = any(wanted == [character(5) :: 'BLOCK', 'NONE'])
    reason = 'WSTORE '//wanted
    if (wanted == 'AUTO') call weigh(run, obstacle, courant, is_local, reason, status)
    if (size(run%contact%interface_node) == 0) is_local = .false.
    if (is_local .neqv. allocated(run%contact%local)) run%contact%n = 0
    if (is_local) then
      if (.not. allocated(run%contact%local)) allocate (run%contact%local)
      call set_local(run, wanted == 'NONE', courant)
      reason = 'near part of W, '//to_text(run%contact%local%radius)//' elements: '//reason
    else
      if (allocated(run%contact%local)) deallocate (run%contact%local)
      reason = 'W dense: '//reason
    end if
    call tell(run, is_local, reason)
  end subroutine choose_storage

  !> The line of the plan; a note where the log has been begun.
  subroutine tell(run, is_local, reason)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: is_local
    character(*), intent(in) :: reason
    call set_feature(run%plan, 'contact W', is_local, reason)
    if (run%log_unit >= 0) call add_message(run%notes, '', 'contact at step '// &
        to_text(run%state%cycle)//', '//reason)
  end subroutine tell

  !> What of a scene needs all entries of W, or another W in each pass; empty: nothing.
  function obstacle_of(run) result(obstacle)
    type(run_t), intent(in) :: run
    character(:), allocatable :: obstacle
    obstacle = ''
    if (associated(run%team)) obstacle = 'several ranks, whose matrix is spread'
    if (allocated(run%rigid)) obstacle = 'rigid parts, which couple all that they touch'
    if (run%plan%dump) obstacle = 'DFIRST, which writes all of W'
    if (run%step%mode == step_event) obstacle = 'steps cut at a touch, which ask for all of W'
    if (allocated(run%newton)) then
      if (.not. run%newton%is_explicit) obstacle = 'steps at finite deformation, whose W '// &
          'is another one after each factor'
    end if
  end function obstacle_of

  !> Elements that a pressure wave passes in a step; infinite in statics, none where the matrix
  !> is diagonal and couples nothing: a bar of one element has
  !> stiffness/inertia = 2 (Courant number)^2.
  real(wp) function courant_number(run) result(courant)
    type(run_t), intent(in) :: run
    integer :: k
    courant = zero
    if (run%solver%takes_diagonal) return
    do k = 1, size(run%scheme%stage)
      associate (s => run%scheme%stage(k))
        if (s%c_m > zero) then
          courant = max(courant, sqrt(half*stiffness_ratio(run%system, s%c_m, s%c_k)))
        else
          courant = huge(courant)
          courant = 2.0_wp*courant
        end if
      end associate
    end do
  end function courant_number

  !> By bytes of a step: dense, S^-1 twice and W once a sweep; near, the factor twice a pass,
  !> weighted.
  subroutine weigh(run, obstacle, courant, is_local, reason, status)
    type(run_t), intent(inout) :: run
    character(*), intent(in) :: obstacle
    real(wp), intent(in) :: courant
    logical, intent(out) :: is_local
    character(:), allocatable, intent(out) :: reason
    type(status_t), intent(inout) :: status
    real(wp) :: dense, near, entries, least, passes
    integer :: d, m, radius
    is_local = .false.
    dense = dense_bytes(run%contact, sweeps + building)
    reason = text_of(dense)//' bytes a step'
    if (dense < small) return
    if (obstacle /= '') then
      reason = reason//', because of '//obstacle
      return
    else if (courant > largest_courant) then
      reason = reason//', at a Courant number of '//to_text(courant)
      return
    end if
    d = run%contact%d
    m = contacts_of(run%contact)
    call near_extent(run, courant, radius, passes)
    entries = real(d, wp)**2*m*(2*radius + 1)**(run%system%dim - 1)
    near = 8.0_wp*entries*(sweeps + building + 4.0_wp)
    if (.not. run%solver%takes_diagonal) then
      least = 4.0_wp*run%system%dim**2*real(size(run%system%graph%column), wp)
      least = near + 2.0_wp*factor_weight*passes*least
      if (dense < least) then
        reason = reason//'; solves would read '//text_of(least)//' or more'
        return
      end if
      call run%solver%analyse(run%system%graph, run%system%dim, [integer ::], status)
      if (failed(status)) return
      near = near + 2.0_wp*factor_weight*passes*run%solver%info%factor_bytes
    end if
    is_local = near < dense
    if (is_local) then
      reason = text_of(near)//' bytes a step, dense '//text_of(dense)
    else
      reason = reason//', with solves '//text_of(near)
    end if
  end subroutine weigh

  function text_of(bytes) result(text)
    real(wp), intent(in) :: bytes
    character(:), allocatable :: text
    text = to_text(nint(bytes, i8))
  end function text_of

  !> Bytes that a step reads of S^-1 by bodies and of W, w_reads times.
  pure real(wp) function dense_bytes(contact, w_reads)
    type(contact_t), intent(in) :: contact
    real(wp), intent(in) :: w_reads
    real(wp), allocatable :: nodes(:)
    integer :: k
    associate (node => contact%interface_node)
      if (allocated(contact%body)) then
        allocate (nodes(maxval([1, contact%body])), source=zero)
        do k = 1, size(node)
          nodes(contact%body(node(k))) = nodes(contact%body(node(k))) + 1.0_wp
        end do
      else
        nodes = [real(size(node), wp)]
      end if
    end associate
    dense_bytes = 16.0_wp*sum((contact%dim*nodes)**2) &
        + 8.0_wp*(contact%d*real(contacts_of(contact), wp))**2*w_reads
  end function dense_bytes

  !> Contacts that are counted with: the listed nodes.
  pure integer function contacts_of(contact)
    type(contact_t), intent(in) :: contact
    contacts_of = min(contact%listed, size(contact%interface_node))
  end function contacts_of

  !> Elements along the face that the near part holds, and passes that it is expected to take.
  pure subroutine near_extent(run, courant, radius, passes)
    type(run_t), intent(in) :: run
    real(wp), intent(in) :: courant
    integer, intent(out) :: radius
    real(wp), intent(out) :: passes
    if (run%solver%takes_diagonal) then
      radius = 0
      passes = zero
      return
    end if
    radius = 8
    if (courant > 1.0_wp) radius = 12
    if (courant > 3.0_wp) radius = 16
    if (run%system%dim == 3) radius = radius/2
    passes = 3.0_wp + max(zero, courant - 1.0_wp)
  end subroutine near_extent

  subroutine set_local(run, by_products, courant)
    type(run_t), intent(inout) :: run
    logical, intent(in) :: by_products
    real(wp), intent(in) :: courant
    real(wp) :: passes
    integer :: radius
    call near_extent(run, courant, radius, passes)
    if (by_products) radius = min(radius, 2)
    associate (local => run%contact%local)
      local%by_products = by_products
      local%radius = radius
      local%margin = max(2, radius/2)
      local%is_exact = run%solver%takes_diagonal
    end associate
    call start_local(run%contact, run%system%n)
  end subroutine set_local

end module run_storage
