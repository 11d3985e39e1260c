! SPDX-License-Identifier: BSD-3-Clause
!> The factor A = L D L' of MUMPS (Amestoy, Duff, L'Excellent & Koster 2001), spread over the
!> ranks, with the Schur complement of the last dofs on the first one. All ranks call the
!> procedures together; right-hand sides and solutions are those of the first. What MUMPS wants
!> on one rank (order, right-hand side, the whole of what it finds out of the graph) is with the
!> last one, its host, for the first has the scene besides.
module mpi_engine
  use base_kinds, only: wp, i8, zero, one
  use linalg_graph, only: graph_t, block_matrix_t
  use mpi_link, only: link_t, give_back_memory, send_numbers, receive_numbers, &
      send_integers, receive_integers
  implicit none
  private
  include 'dmumps_struc.h'

  type, public :: engine_t
    type(dmumps_struc), pointer :: mumps => null()
    integer :: n_interface = 0                    !< dofs
    !> 1 where all dofs are of the interface, of which MUMPS demands another one: A = 1 there
    integer :: more = 0
    type(link_t) :: link
    integer :: host = 0                           !< rank of the host of MUMPS
    logical :: is_first = .false.                 !< on the first rank
    logical :: is_host = .false.
    integer, allocatable :: node(:)               !< of each row of the graph of its entries
  end type engine_t

  public :: open_engine, close_engine, analyse_engine, factor_engine, condense, expand

contains

  !> An instance without a matrix.
  subroutine open_engine(link, engine)
    type(link_t), intent(in) :: link
    type(engine_t), intent(inout) :: engine
    integer, parameter :: records = 5000
    allocate (engine%mumps)
    engine%link = link
    engine%host = link%ranks - 1
    engine%is_first = link%rank == 0
    engine%is_host = link%rank == engine%host
    associate (m => engine%mumps)
      m%comm = link%backwards%mpi_val
      m%par = 1
      m%sym = 1
      call call_mumps(m, -1)
      m%icntl(1:4) = [-1, -1, -1, 0]    ! no word of its own
      m%icntl(6) = 0
      m%icntl(7) = 1                    ! our order
      m%icntl(8) = 0                    ! no scaling
      m%icntl(10) = 0
      m%icntl(13) = 1                   ! its root by itself: pivots are counted
      m%icntl(14) = 3                  ! per cent of work space beyond the estimate
      m%icntl(18) = 3                   ! each rank has its entries
      m%icntl(28) = 1
      m%keep(39) = records              ! in a message of entries: else it takes 160 000
    end associate
  end subroutine open_engine

  !> Gives its memory back.
  subroutine close_engine(engine)
    type(engine_t), intent(inout) :: engine
    if (.not. associated(engine%mumps)) return
    call forget_order(engine%mumps)
    call call_mumps(engine%mumps, -2)
    call forget_entries(engine%mumps)
    deallocate (engine%mumps)
  end subroutine close_engine

  !> Symbolic factor of a matrix of n nodes with d dofs each. graph: of this rank's entries,
  !> node: of its rows in the whole. On the first rank: order(:), new -> old node; the last
  !> `last` of them are the interface. info: of MUMPS, < 0 is a failure.
  subroutine analyse_engine(engine, n, d, graph, node, last, order, info)
    type(engine_t), intent(inout) :: engine
    integer, intent(in) :: n, d, last
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: node(:), order(:)
    integer, intent(out) :: info(2)
    engine%n_interface = d*last
    engine%node = node
    associate (m => engine%mumps)
      call forget_order(m)
      engine%more = merge(1, 0, last == n)
      m%n = d*n + engine%more
      call list_entries(m, d, graph, node, more_entries(engine))
      if (engine%is_first .and. .not. engine%is_host) &
          call send_integers(engine%link, engine%host, n, order)
      if (engine%is_host) call set_order(engine, n, d, last, order)
      m%icntl(19) = merge(1, 0, last > 0)
      m%size_schur = d*last
      call give_back_memory()
      call call_mumps(m, 1)
      call forget_entries(m)
      if (associated(m%perm_in)) deallocate (m%perm_in)
      nullify (m%perm_in)
      if (engine%is_host) allocate (m%rhs(m%n))
      call give_back_memory()
      info = m%infog(1:2)
    end associate
  end subroutine analyse_engine

  !> On the host: order of the dofs, and which are of the interface. order: of the first rank,
  !> which sends it where that is another one.
  subroutine set_order(engine, n, d, last, order)
    type(engine_t), intent(inout) :: engine
    integer, intent(in) :: n, d, last
    integer, intent(in) :: order(:)
    integer, allocatable :: nodes(:)
    integer :: k, i
    allocate (nodes(n))
    if (engine%is_first) nodes = order
    if (.not. engine%is_first) call receive_integers(engine%link, 0, n, nodes)
    associate (m => engine%mumps)
      allocate (m%perm_in(m%n), m%listvar_schur(d*last))
      do k = 1, n
        do i = 1, d
          m%perm_in(d*(nodes(k) - 1) + i) = d*(k - 1) + i + engine%more
          if (k > n - last) m%listvar_schur(d*(k - n + last - 1) + i) = d*(nodes(k) - 1) + i
        end do
      end do
      if (engine%more > 0) m%perm_in(m%n) = 1
      allocate (m%redrhs(max(1, d*last)))
      if (last > 0) allocate (m%schur((d*last)**2))
    end associate
  end subroutine set_order

  !> Numerical factor of the entries, and on the first rank the lower triangle of the Schur
  !> complement. The matrix is kept, or forgotten before it is factored. info: of MUMPS; info(1)
  !> = -10 where a pivot is not positive.
  subroutine factor_engine(engine, d, graph, matrix, is_kept, schur, info)
    type(engine_t), intent(inout) :: engine
    integer, intent(in) :: d
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(inout) :: matrix
    real(wp), allocatable, intent(inout) :: schur(:, :)
    logical, intent(in) :: is_kept
    integer, intent(out) :: info(2)
    integer, parameter :: most_trials = 6
    integer :: trial
    associate (m => engine%mumps)
      if (engine%is_host .and. engine%n_interface > 0 .and. .not. associated(m%schur)) &
          allocate (m%schur(engine%n_interface**2))
      if (allocated(schur)) deallocate (schur)
      call list_entries(m, d, graph, engine%node, more_entries(engine))
      call list_values(m, d, graph, matrix)
      if (.not. is_kept .and. allocated(matrix%value)) deallocate (matrix%value)
      call give_back_memory()
      do trial = 1, most_trials
        call call_mumps(m, 2)
        info = m%infog(1:2)
        if (info(1) /= -8 .and. info(1) /= -9) exit   ! work space too small
        m%icntl(14) = 2*m%icntl(14)
      end do
      call forget_entries(m)
      call give_back_memory()
      if (info(1) == 0 .and. m%infog(12) > 0) info = [-10, m%infog(12)]
      if (info(1) < 0) return
      call pass_schur(engine, schur)
      if (associated(m%schur)) deallocate (m%schur)
      nullify (m%schur)
    end associate
  end subroutine factor_engine

  !> The Schur complement from the host to the first rank, row by row.
  subroutine pass_schur(engine, schur)
    type(engine_t), intent(in) :: engine
    real(wp), allocatable, intent(inout) :: schur(:, :)
    real(wp), allocatable :: row(:)
    real(wp), pointer :: of_host(:)
    integer :: i, n
    n = engine%n_interface
    allocate (row(n))
    if (engine%is_first) allocate (schur(n, n), source=zero)
    do i = 1, n
      nullify (of_host)
      if (engine%is_host) of_host => engine%mumps%schur((i - 1)*n + 1:i*n)
      call take_from_host(engine, n, of_host, row)
      if (engine%is_first) schur(i, :i) = row(:i)
    end do
  end subroutine pass_schur

  !> n numbers of the host, `there`, to `here` on the first rank, which may be the same.
  subroutine take_from_host(engine, n, there, here)
    type(engine_t), intent(in) :: engine
    integer, intent(in) :: n
    real(wp), pointer, intent(in) :: there(:)
    real(wp), intent(inout) :: here(*)
    if (engine%is_first .and. engine%is_host) then
      here(:n) = there(:n)
    else if (engine%is_host) then
      call send_numbers(engine%link, 0, n, there)
    else if (engine%is_first) then
      call receive_numbers(engine%link, engine%host, n, here)
    end if
  end subroutine take_from_host

  !> The other way.
  subroutine give_to_host(engine, n, here, there)
    type(engine_t), intent(in) :: engine
    integer, intent(in) :: n
    real(wp), intent(in) :: here(*)
    real(wp), pointer, intent(in) :: there(:)
    if (engine%is_first .and. engine%is_host) then
      there(:n) = here(:n)
    else if (engine%is_first) then
      call send_numbers(engine%link, engine%host, n, here)
    else if (engine%is_host) then
      call receive_numbers(engine%link, 0, n, there)
    end if
  end subroutine give_to_host

  !> Eliminates the leading dofs from b (d, n); b_interface is what remains. Where there is no
  !> interface the whole solution is found here.
  subroutine condense(engine, b, b_interface)
    type(engine_t), intent(inout) :: engine
    real(wp), intent(in) :: b(:, :)
    real(wp), intent(inout) :: b_interface(:, :)
    associate (m => engine%mumps)
      call set_right_side(m)
      call give_to_host(engine, m%n - engine%more, b, m%rhs)
      if (engine%is_host .and. engine%more > 0) m%rhs(m%n) = zero
      m%icntl(26) = merge(1, 0, engine%n_interface > 0)
      m%lredrhs = max(1, engine%n_interface)
      call call_mumps(m, 3)
      call take_from_host(engine, engine%n_interface, m%redrhs, b_interface)
    end associate
  end subroutine condense

  !> The whole solution x (d, n) from that of the interface.
  subroutine expand(engine, x_interface, x)
    type(engine_t), intent(inout) :: engine
    real(wp), intent(in) :: x_interface(:, :)
    real(wp), intent(inout) :: x(:, :)
    associate (m => engine%mumps)
      if (engine%n_interface > 0) then
        call set_right_side(m)
        call give_to_host(engine, engine%n_interface, x_interface, m%redrhs)
        m%icntl(26) = 2
        call call_mumps(m, 3)
      end if
      call take_from_host(engine, m%n - engine%more, m%rhs, x)
    end associate
  end subroutine expand

  subroutine set_right_side(m)
    type(dmumps_struc), intent(inout) :: m
    m%nrhs = 1
    m%lrhs = m%n
    m%icntl(20) = 0
    m%icntl(21) = 0
  end subroutine set_right_side

  !> Rows and columns of the lower triangle of this rank's entries.
  subroutine list_entries(m, d, graph, node, more)
    type(dmumps_struc), intent(inout) :: m
    integer, intent(in) :: d
    type(graph_t), intent(in) :: graph
    integer, intent(in) :: node(:), more
    integer :: i, k, j, a, b
    integer(i8) :: entry
    m%nnz_loc = count_entries(d, graph) + more
    allocate (m%irn_loc(m%nnz_loc), m%jcn_loc(m%nnz_loc))
    entry = 0_i8
    do i = 1, graph%n
      do k = graph%first(i), graph%first(i + 1) - 1
        j = graph%column(k)
        if (j > i) cycle
        do b = 1, d
          do a = merge(b, 1, i == j), d
            entry = entry + 1_i8
            m%irn_loc(entry) = d*(node(i) - 1) + a
            m%jcn_loc(entry) = d*(node(j) - 1) + b
          end do
        end do
      end do
    end do
    if (more > 0) m%irn_loc(m%nnz_loc) = m%n
    if (more > 0) m%jcn_loc(m%nnz_loc) = m%n
  end subroutine list_entries

  !> Their values, in the same order.
  subroutine list_values(m, d, graph, matrix)
    type(dmumps_struc), intent(inout) :: m
    integer, intent(in) :: d
    type(graph_t), intent(in) :: graph
    type(block_matrix_t), intent(in) :: matrix
    integer :: i, k, j, a, b
    integer(i8) :: entry
    allocate (m%a_loc(m%nnz_loc), source=one)
    entry = 0_i8
    do i = 1, graph%n
      do k = graph%first(i), graph%first(i + 1) - 1
        j = graph%column(k)
        if (j > i) cycle
        do b = 1, d
          do a = merge(b, 1, i == j), d
            entry = entry + 1_i8
            m%a_loc(entry) = matrix%value(a, b, k)
          end do
        end do
      end do
    end do
  end subroutine list_values

  !> The first rank has the entry of the dof beyond the interface.
  pure integer function more_entries(engine)
    type(engine_t), intent(in) :: engine
    more_entries = merge(engine%more, 0, engine%is_first)
  end function more_entries

  pure integer(i8) function count_entries(d, graph)
    integer, intent(in) :: d
    type(graph_t), intent(in) :: graph
    integer :: i, k
    count_entries = 0_i8
    do i = 1, graph%n
      do k = graph%first(i), graph%first(i + 1) - 1
        if (graph%column(k) < i) count_entries = count_entries + d*d
        if (graph%column(k) == i) count_entries = count_entries + (d*(d + 1))/2
      end do
    end do
  end function count_entries

  subroutine forget_entries(m)
    type(dmumps_struc), intent(inout) :: m
    if (associated(m%irn_loc)) deallocate (m%irn_loc, m%jcn_loc)
    if (associated(m%a_loc)) deallocate (m%a_loc)
    nullify (m%irn_loc, m%jcn_loc, m%a_loc)
  end subroutine forget_entries

  subroutine forget_order(m)
    type(dmumps_struc), intent(inout) :: m
    if (associated(m%perm_in)) deallocate (m%perm_in)
    if (associated(m%listvar_schur)) deallocate (m%listvar_schur)
    if (associated(m%schur)) deallocate (m%schur)
    if (associated(m%rhs)) deallocate (m%rhs)
    if (associated(m%redrhs)) deallocate (m%redrhs)
    nullify (m%perm_in, m%listvar_schur, m%schur, m%rhs, m%redrhs)
  end subroutine forget_order

  subroutine call_mumps(m, job)
    type(dmumps_struc), intent(inout) :: m
    integer, intent(in) :: job
    external :: dmumps
    m%job = job
    call dmumps(m)
  end subroutine call_mumps

end module mpi_engine
