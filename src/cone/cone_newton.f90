! SPDX-License-Identifier: BSD-3-Clause
!> Global Newton method on the natural map of all contacts. Unknowns are scaled: mean diagonal
!> of W 1, largest |q| 1. The matrix of a step is sparse, banded or dense, whatever costs least:
!> contacts are numbered by nested dissection for the first, by reverse Cuthill-McKee for the
!> second.
module cone_newton
  use base_kinds, only: wp, zero, one, half
  use cone_blocks, only: delassus_blocks_t
  use cone_local, only: contact_map, tangent_length
  use cone_types, only: most_components
  use linalg_dense, only: solve_general, solve_banded
  use linalg_fronts, only: fronts_t, plan_fronts, factor_fronts, solve_fronts
  use linalg_graph, only: graph_t, graph_from_cliques
  use linalg_order, only: reverse_cuthill_mckee
  implicit none
  private
  public :: newton_work_t, plan_band, plan_newton, newton_solve, step_products

  type :: newton_work_t
    real(wp) :: flops = zero, numbers = zero  !< of a step; in its matrix
    real(wp) :: products = zero               !< with W, or their worth, so far
    real(wp) :: first_norm = zero             !< of the map where the last solve began
    logical :: complete = .false.             !< sparse was asked for, too
    !> A first step longer than that many times |r| is not taken: W is singular there.
    real(wp) :: longest = huge(one)
    logical :: too_long = .false.
    integer :: width = 0                      !< half of the band [unknowns]
    logical :: banded = .false., sparse = .false.
    integer, allocatable :: order(:)          !< (nc) contacts, new -> old
    type(graph_t) :: graph                    !< of the contacts, symmetric
    type(fronts_t) :: fronts
    logical, allocatable :: planned(:)        !< (nc) contacts of the fronts as they are
    integer :: blocks = 0                     !< filled
    integer, allocatable :: row(:), column(:) !< of the blocks of a sparse matrix
    real(wp), allocatable :: value(:, :, :)
    integer, allocatable :: place(:)          !< (nc) number among the active ones, 0 = open
    real(wp), allocatable :: matrix(:, :), right(:, :)
    integer, allocatable :: pivot(:)
    real(wp), allocatable, dimension(:, :) :: start, map, u, trial, step   !< (d, nc)
    real(wp), allocatable :: part(:, :, :)    !< (d, d, nc) derivative of the projection
  end type newton_work_t

  !> Operations of a factor that take as long as a product with W, a number of W.
  real(wp), parameter, public :: product_weight = 6.0_wp
  integer, parameter :: least_sparse = 100     !< unknowns
  !> Products that go by while a sparse matrix is filled and its fronts are put together.
  real(wp), parameter :: sparse_products = 20.0_wp

contains

  !> The order of the contacts on a band, or of a dense matrix, and what a step will cost; no
  !> matrix yet. In the time of some products with W.
  subroutine plan_band(w, work)
    type(delassus_blocks_t), intent(in) :: w
    type(newton_work_t), intent(inout) :: work
    integer :: a, n, band
    if (allocated(work%order)) return
    call symmetric_graph(w, work%graph)
    allocate (work%order(w%contacts), work%place(w%contacts))
    call reverse_cuthill_mckee(work%graph, [(a, a=1, w%contacts)], [integer ::], work%order)
    work%place(work%order) = [(a, a=1, w%contacts)]
    band = 0
    do a = 1, w%contacts
      band = max(band, maxval(abs(work%place(w%column(w%first(a):w%first(a + 1) - 1)) - &
          work%place(a))))
    end do
    n = w%d*w%contacts
    work%width = w%d*(band + 1) - 1
    ! The factor of a band, with space for its row exchanges, costs 4 n width^2.
    work%banded = 6*real(work%width, wp)**2 < real(n, wp)**2
    work%flops = factor_flops(work, n)
    work%numbers = real(n, wp)*merge(3*work%width + 1, n, work%banded)
  end subroutine plan_band

  !> The same, or sparse if that is cheaper: not asked where the band costs no more than what
  !> every sparse step does.
  subroutine plan_newton(w, work)
    type(delassus_blocks_t), intent(in) :: w
    type(newton_work_t), intent(inout) :: work
    if (work%complete) return
    call plan_band(w, work)
    work%complete = .true.
    if (w%d*w%contacts < least_sparse) return
    if (work%flops <= sparse_products*product_weight*size(w%block)) return
    call plan_fronts(work%graph, w%d, work%fronts)
    work%sparse = work%fronts%flops + sparse_products*product_weight*size(w%block) < work%flops
    if (.not. work%sparse) return
    work%banded = .false.
    work%flops = work%fronts%flops
    work%numbers = work%fronts%numbers
    work%order = work%fronts%order
  end subroutine plan_newton

  !> Neighbours in W, or in W', and itself, for each contact, in increasing order.
  subroutine symmetric_graph(w, graph)
    type(delassus_blocks_t), intent(in) :: w
    type(graph_t), intent(out) :: graph
    integer :: a, k
    integer, allocatable :: first(:), member(:)
    allocate (first(size(w%column) + 1), member(2*size(w%column)))
    first = [(2*k - 1, k=1, size(first))]
    do a = 1, w%contacts
      do k = w%first(a), w%first(a + 1) - 1
        member(2*k - 1:2*k) = [a, w%column(k)]
      end do
    end do
    call graph_from_cliques(w%contacts, first, member, graph)
  end subroutine symmetric_graph

  !> Operations of the factor of n unknowns.
  pure real(wp) function factor_flops(work, n)
    type(newton_work_t), intent(in) :: work
    integer, intent(in) :: n
    factor_flops = real(n, wp)**3/1.5_wp
    if (work%sparse) factor_flops = work%fronts%flops
    if (work%banded) factor_flops = 4*real(n, wp)*real(work%width, wp)**2
  end function factor_flops

  !> What a step costs, in products with W, its own two among them.
  pure real(wp) function step_products(w, work)
    type(delassus_blocks_t), intent(in) :: w
    type(newton_work_t), intent(in) :: work
    step_products = 2.0_wp + work%flops/(product_weight*size(w%block))
    if (work%sparse) step_products = step_products + sparse_products
  end function step_products

  !> Space for the steps, once.
  subroutine size_newton(w, work)
    type(delassus_blocks_t), intent(in) :: w
    type(newton_work_t), intent(inout) :: work
    integer :: d, n, nc
    call plan_newton(w, work)
    if (allocated(work%part)) return
    d = w%d
    nc = w%contacts
    n = d*nc
    if (work%sparse) then
      allocate (work%row(size(w%column)), work%column(size(w%column)))
      allocate (work%value(d, d, size(w%column)), work%right(n, 1))
      allocate (work%planned(nc))
      work%planned = .false.
    else
      allocate (work%matrix(merge(3*work%width + 1, n, work%banded), n), work%right(n, 1))
      allocate (work%pivot(n))
    end if
    allocate (work%part(d, d, nc))
    allocate (work%start(d, nc), work%map(d, nc), work%u(d, nc), work%trial(d, nc))
    allocate (work%step(d, nc))
  end subroutine size_newton

  !> Newton steps with line search for r = P_K(r - rho (u_n + mu |u_t|, u_t)), u = W r + q +
  !> alpha (r - r_0), until |map| <= goal or the line search finds no way down; the best r is
  !> kept. patience steps must halve |map|, or it gives up. rho (nc), all scaled.
  subroutine newton_solve(w, q, mu, rho, alpha, goal, most, patience, r, work, norm, steps)
    type(delassus_blocks_t), intent(in) :: w
    real(wp), intent(in) :: q(:, :)
    real(wp), intent(in) :: mu(:), rho(:)
    real(wp), intent(in) :: alpha, goal
    integer, intent(in) :: most, patience
    real(wp), intent(inout), contiguous :: r(:, :)
    type(newton_work_t), intent(inout) :: work
    real(wp), intent(out) :: norm
    integer, intent(out) :: steps
    real(wp) :: length, trial_norm, marked
    logical :: ok
    integer :: k
    call size_newton(w, work)
    work%start = r
    call evaluate_map(w, q, mu, rho, alpha, r, work)
    norm = sqrt(sum(work%map**2))
    work%first_norm = norm
    work%too_long = .false.
    marked = norm
    do steps = 1, most
      if (norm <= goal) return
      if (mod(steps, patience) == 0) then
        if (norm > half*marked) return
        marked = norm
      end if
      call find_step(w, mu, rho, alpha, work, ok)
      if (.not. ok) return
      if (steps == 1 .and. work%longest < huge(one)) then
        work%too_long = sum(work%step**2) > work%longest**2*sum(r**2)
        if (work%too_long) return
      end if
      length = one
      do k = 1, 12
        work%trial = r + length*work%step
        call evaluate_map(w, q, mu, rho, alpha, work%trial, work)
        trial_norm = sqrt(sum(work%map**2))
        if (trial_norm <= (one - 1.0e-2_wp*length)*norm) exit
        length = half*length
      end do
      if (.not. trial_norm < norm) return
      r = work%trial
      norm = trial_norm
    end do
  end subroutine newton_solve

  !> u, map = r - P_K(tau), and the derivative of P_K for each contact, at r (d, nc).
  pure subroutine evaluate_map(w, q, mu, rho, alpha, r, work)
    type(delassus_blocks_t), intent(in) :: w
    real(wp), intent(in) :: q(:, :), mu(:), rho(:), alpha
    real(wp), intent(in), contiguous :: r(:, :)
    type(newton_work_t), intent(inout) :: work
    integer :: a, status
    work%u = q + alpha*(r - work%start)
    call w%add_product(r, work%u)
    work%products = work%products + one
    do a = 1, size(mu)
      call contact_map(mu(a), rho(a), r(:, a), work%u(:, a), work%map(:, a), &
          work%part(:, :, a), status)
    end do
  end subroutine evaluate_map

  !> The Newton step: open contacts have theirs at once, -map; the others solve the system
  !> (I - dP (I - rho (W + alpha I + mu e_n t' (W_t + alpha I)))) step = -map among themselves.
  subroutine find_step(w, mu, rho, alpha, work, ok)
    type(delassus_blocks_t), intent(in) :: w
    real(wp), intent(in) :: mu(:), rho(:), alpha
    type(newton_work_t), intent(inout) :: work
    logical, intent(out) :: ok
    integer :: a, d, k, n
    d = w%d
    n = 0
    work%step = -work%map
    do k = 1, size(mu)
      a = work%order(k)
      if (work%sparse) a = k
      work%place(a) = 0
      if (.not. any(abs(work%part(:, :, a)) > zero)) cycle
      n = n + 1
      work%place(a) = n
    end do
    work%blocks = 0
    if (.not. work%sparse) work%matrix(:, :d*n) = zero
    do a = 1, size(mu)
      if (work%place(a) > 0) call fill_rows(w, a, mu(a), rho(a), alpha, work)
    end do
    ok = .true.
    if (n == 0) return
    if (work%sparse) then
      call solve_sparse(w, n, work, ok)
    else if (work%banded) then
      call solve_banded(d*n, work%width, work%matrix, work%right, work%pivot, ok)
    else
      call solve_general(d*n, work%matrix, work%right, work%pivot, ok)
    end if
    work%products = work%products + merge(sparse_products, zero, work%sparse) &
        + factor_flops(work, d*n)/(product_weight*size(w%block))
    if (.not. ok) return
    do a = 1, size(mu)
      k = work%place(a)
      if (k > 0) work%step(:, a) = work%right(d*(k - 1) + 1:d*k, 1)
    end do
  end subroutine find_step

  !> The system of n active contacts by fronts, in the order of all of them.
  subroutine solve_sparse(w, n, work, ok)
    type(delassus_blocks_t), intent(in) :: w
    integer, intent(in) :: n
    type(newton_work_t), intent(inout) :: work
    logical, intent(out) :: ok
    real(wp) :: x(w%d, n)
    if (.not. all(work%planned .eqv. work%place > 0)) call plan_active(w%d, n, work)
    call factor_fronts(work%fronts, work%row(:work%blocks), work%column(:work%blocks), &
        work%value, ok)
    if (.not. ok) return
    x = reshape(work%right(:w%d*n, 1), [w%d, n])
    call solve_fronts(work%fronts, x)
    work%right(:w%d*n, 1) = reshape(x, [w%d*n])
  end subroutine solve_sparse

  !> Fronts of n active contacts.
  subroutine plan_active(d, n, work)
    integer, intent(in) :: d, n
    type(newton_work_t), intent(inout) :: work
    type(graph_t) :: graph
    integer :: a, k, m
    graph%n = n
    allocate (graph%first(n + 1), graph%column(size(work%graph%column)))
    m = 0
    do a = 1, size(work%place)
      if (work%place(a) == 0) cycle
      graph%first(work%place(a)) = m + 1
      do k = work%graph%first(a), work%graph%first(a + 1) - 1
        if (work%place(work%graph%column(k)) == 0) cycle
        m = m + 1
        graph%column(m) = work%place(work%graph%column(k))
      end do
    end do
    graph%first(n + 1) = m + 1
    call plan_fronts(graph, d, work%fronts, pack(work%place(work%order), &
        work%place(work%order) > 0))
    work%planned = work%place > 0
  end subroutine plan_active

  !> The rows of active contact a; the steps of the open ones go to the right side.
  pure subroutine fill_rows(w, a, mu, rho, alpha, work)
    type(delassus_blocks_t), intent(in) :: w
    integer, intent(in) :: a
    real(wp), intent(in) :: mu, rho, alpha
    type(newton_work_t), intent(inout) :: work
    real(wp), dimension(most_components, most_components) :: weight, block
    real(wp), dimension(most_components) :: motion
    integer :: d, k, j, row, b, i
    d = w%d
    row = d*(work%place(a) - 1)
    call find_weight(rho, work%part(:, :, a), mu, work%u(:, a), weight(:d, :d))
    motion = zero
    do k = w%first(a), w%first(a + 1) - 1
      b = w%column(k)
      if (work%place(b) == 0) then
        do j = 1, d
          motion(:d) = motion(:d) + w%block(:, j, k)*work%step(j, b)
        end do
        cycle
      end if
      do j = 1, d
        call multiply(weight(:d, :d), w%block(:, j, k), block(:d, j))
      end do
      if (b == a) then
        do j = 1, d
          block(:d, j) = block(:d, j) + alpha*weight(:d, j) - work%part(:, j, a)
          block(j, j) = block(j, j) + one
        end do
      end if
      call put_block(block(:d, :d), row, d*(work%place(b) - 1), work)
    end do
    call multiply(weight(:d, :d), motion(:d), block(:d, 1))
    do i = 1, d
      work%right(row + i, 1) = -work%map(i, a) - block(i, 1)
    end do
  end subroutine fill_rows

  !> A block into the matrix, dense or by diagonals as LAPACK keeps a band.
  pure subroutine put_block(block, row, column, work)
    real(wp), intent(in) :: block(:, :)
    integer, intent(in) :: row, column
    type(newton_work_t), intent(inout) :: work
    integer :: j, first
    if (work%sparse) then
      work%blocks = work%blocks + 1
      work%row(work%blocks) = row/size(block, 1) + 1
      work%column(work%blocks) = column/size(block, 1) + 1
      work%value(:, :, work%blocks) = block
      return
    end if
    do j = 1, size(block, 2)
      first = row
      if (work%banded) first = row + 2*work%width + 1 - (column + j)
      work%matrix(first + 1:first + size(block, 1), column + j) = block(:, j)
    end do
  end subroutine put_block

  !> y = a x.
  pure subroutine multiply(a, x, y)
    real(wp), intent(in) :: a(:, :), x(:)
    real(wp), intent(out) :: y(:)
    integer :: j
    y = zero
    do j = 1, size(x)
      y = y + a(:, j)*x(j)
    end do
  end subroutine multiply

  !> weight = rho dP (I + mu e_n t'), t the direction of u_t.
  pure subroutine find_weight(rho, part, mu, u, weight)
    real(wp), intent(in) :: rho, part(:, :), mu, u(:)
    real(wp), intent(out) :: weight(:, :)
    real(wp) :: length
    integer :: j
    weight = rho*part
    length = tangent_length(u)
    if (.not. length > zero) return
    do j = 2, size(u)
      weight(:, j) = weight(:, j) + weight(:, 1)*mu*u(j)/length
    end do
  end subroutine find_weight

end module cone_newton
