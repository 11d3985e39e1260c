! SPDX-License-Identifier: BSD-3-Clause
!> Parts of an elimination tree that do not depend on each other, for threads: ranges of nodes
!> whose descendants are all in the range. What is in none of them, above, is the top. The parts
!> follow from the tree alone, never from the number of threads, which change no digit so.
module linalg_subtrees
  use base_kinds, only: wp
  implicit none
  private
  public :: find_subtrees

  !> Part t is nodes first(t)..last(t), parts in increasing order; n is 0 where the tree does
  !> not divide. part(k): of node k, 0 = the top. by_cost: the parts, the dearest first.
  type, public :: subtrees_t
    integer :: n = 0
    integer, allocatable :: first(:), last(:)
    integer, allocatable :: part(:)
    integer, allocatable :: by_cost(:)
  end type subtrees_t

  !> Largest share of the cost in one part: smaller ones leave more for the top.
  real(wp), parameter :: grain = 0.09_wp
  !> Share of that below which a part is left to the top.
  real(wp), parameter :: least_share = 0.03_wp

contains

  !> Parts of a tree whose nodes stand with children before parents and each subtree in one
  !> piece. parent: 0 or beyond the nodes = none; cost of each node.
  pure subroutine find_subtrees(parent, cost, this)
    integer, intent(in) :: parent(:)
    real(wp), intent(in) :: cost(:)
    type(subtrees_t), intent(out) :: this
    real(wp) :: sums(size(parent)), limit, of(size(parent))
    integer :: first(size(parent)), k
    call add_up(parent, cost, sums, first)
    limit = grain*sum(cost)
    allocate (this%part(size(parent)), this%first(size(parent)), this%last(size(parent)))
    do k = 1, size(parent)
      if (sums(k) > limit) cycle
      if (parent(k) > 0 .and. parent(k) <= size(parent)) then
        if (sums(parent(k)) <= limit) cycle
      end if
      call take_subtree(first(k), k, sums(k), limit, this, of)
    end do
    call drop_small(limit, this, of)
    if (this%n < 2) this%n = 0
    this%first = this%first(:this%n)
    this%last = this%last(:this%n)
    this%part = 0
    do k = 1, this%n
      this%part(this%first(k):this%last(k)) = k
    end do
    call sort_by_cost(of(:this%n), this%by_cost)
  end subroutine find_subtrees

  !> Sums over the subtree of each node, and its first node.
  pure subroutine add_up(parent, cost, sums, first)
    integer, intent(in) :: parent(:)
    real(wp), intent(in) :: cost(:)
    real(wp), intent(out) :: sums(:)
    integer, intent(out) :: first(:)
    integer :: k
    sums = cost
    first = [(k, k=1, size(parent))]
    do k = 1, size(parent)
      if (parent(k) < 1 .or. parent(k) > size(parent)) cycle
      sums(parent(k)) = sums(parent(k)) + sums(k)
      first(parent(k)) = min(first(parent(k)), first(k))
    end do
  end subroutine add_up

  !> Another subtree: a part of its own, or joined to the part that ends where it begins.
  pure subroutine take_subtree(first, last, cost, limit, this, of)
    integer, intent(in) :: first, last
    real(wp), intent(in) :: cost, limit
    type(subtrees_t), intent(inout) :: this
    real(wp), intent(inout) :: of(:)
    if (this%n > 0) then
      if (this%last(this%n) == first - 1 .and. of(this%n) + cost <= limit) then
        this%last(this%n) = last
        of(this%n) = of(this%n) + cost
        return
      end if
    end if
    call drop_small(limit, this, of)
    this%n = this%n + 1
    this%first(this%n) = first
    this%last(this%n) = last
    of(this%n) = cost
  end subroutine take_subtree

  !> The last part so far goes to the top if it is not worth a part.
  pure subroutine drop_small(limit, this, of)
    real(wp), intent(in) :: limit
    type(subtrees_t), intent(inout) :: this
    real(wp), intent(in) :: of(:)
    if (this%n == 0) return
    if (of(this%n) < least_share*limit) this%n = this%n - 1
  end subroutine drop_small

  !> Numbers of the costs from the largest to the smallest, equal ones in their order.
  pure subroutine sort_by_cost(cost, list)
    real(wp), intent(in) :: cost(:)
    integer, allocatable, intent(out) :: list(:)
    integer :: k, i
    allocate (list(size(cost)))
    do k = 1, size(cost)
      i = k
      do while (i > 1)
        if (cost(list(i - 1)) >= cost(k)) exit
        list(i) = list(i - 1)
        i = i - 1
      end do
      list(i) = k
    end do
  end subroutine sort_by_cost

end module linalg_subtrees
