! SPDX-License-Identifier: BSD-3-Clause
!> A block of elements of one type and part at finite deformation, total Lagrangian: slopes and
!> weights of the points are made once, on the reference. Its force over a step from U0 to
!> U1 = U0 + x is one of three:
!>   ends        before f(U0) + now f(U1);
!>   middle      f((U0 + U1)/2);
!>   conserving  sum w F_m S* dN/dX with F_m of the mean displacement and one quotient an
!>               element in S*, whose work is the change of the energy, and the plastic work,
!>               exactly (Simo & Tarnow 1992; Gonzalez 2000).
module solid_block
  use base_kinds, only: wp, zero, one, half
  use element_base, only: element_t, most_points, most_nodes, circumference
  use material_base, only: material_t
  use material_plane, only: respond_as, places_of
  use solid_mean, only: coupling_t, mean_response
  use solid_points, only: displacement_gradient, green_strain, strain_matrix, &
      add_stress_force, add_material_part, add_geometric_part
  implicit none
  private
  !> In the order of force_names of deck_names.
  integer, parameter, public :: force_conserving = 1, force_ends = 2, force_middle = 3

  !> The force of a step.
  type, public :: force_rule_t
    integer :: kind = force_ends
    real(wp) :: before = zero, now = one     !< weights of f(U0) and f(U1), for force_ends
    !> Part of the tangent that stresses make and may make indefinite: 1 or 0.
    real(wp) :: geometric = one
  end type force_rule_t

  type, public :: solid_t
    integer :: first = 0, n = 0              !< its elements: the first in the mesh, how many
    integer :: nodes = 0, dim = 0, points = 0, strains = 0
    integer :: columns = 0                   !< of H: dim, or 3 around an axis
    integer :: plane = 0
    logical :: is_mean = .false.             !< mean dilatation
    integer, allocatable :: place(:)         !< of its strains among the six in space
    class(material_t), allocatable :: material
    integer, allocatable :: node(:, :)       !< (nodes, n)
    real(wp), allocatable :: weight(:, :)    !< (points, n) of the rule, reference volume [L3]
    real(wp), allocatable :: slope(:, :, :, :)   !< (nodes, dim, points, n) dN/dX [1/L],
                                             !< around an axis (nodes, 3, points, n)
    real(wp), allocatable :: energy(:)       !< (n) of elements at the start of the step [F L]
    real(wp), allocatable :: history(:, :, :)    !< (states, points, n) at the start of the step
  end type solid_t

  public :: make_solid, begin_elements, commit_step, element_force, element_tangent, &
      element_energy, has_quadratic_energy, relative

contains

  !> A block of an element type: nodes (nodes, n) of the elements from `first` on, coordinates x
  !> (dim, *) [L], thickness [L] (1 in space).
  subroutine make_solid(element, material, plane, is_mean, thickness, first, node, x, solid)
    class(element_t), intent(in) :: element
    class(material_t), intent(in) :: material
    integer, intent(in) :: plane, first, node(:, :)
    logical, intent(in) :: is_mean
    real(wp), intent(in) :: thickness, x(:, :)
    type(solid_t), intent(out) :: solid
    real(wp) :: xi(3, most_points), w(most_points), shape(size(node, 1)), det
    integer :: g, k
    solid%dim = size(x, 1)
    solid%first = first
    solid%n = size(node, 2)
    solid%nodes = size(node, 1)
    solid%plane = plane
    solid%strains = element%strain_count()
    solid%columns = merge(3, solid%dim, element%is_ring)
    solid%node = node
    solid%is_mean = is_mean
    solid%place = places_of(plane)
    allocate (solid%material, source=material)
    call element%stiffness_rule(x(:, node(:, 1)), solid%points, xi, w)
    allocate (solid%weight(solid%points, solid%n), solid%energy(solid%n), &
        solid%slope(solid%nodes, solid%columns, solid%points, solid%n))
    do k = 1, solid%n
      call element%stiffness_rule(x(:, node(:, k)), solid%points, xi, w)
      do g = 1, solid%points
        call element%gradients(x(:, node(:, k)), xi(:solid%dim, g), shape, &
            solid%slope(:, :solid%dim, g, k), det)
        solid%weight(g, k) = thickness*det*w(g)
        if (.not. element%is_ring) cycle
        solid%weight(g, k) = solid%weight(g, k)*circumference(x(:, node(:, k)), shape)
        solid%slope(:, 3, g, k) = shape/dot_product(shape, x(1, node(:, k)))
      end do
    end do
    allocate (solid%history(material%states, solid%points, solid%n), source=zero)
    solid%energy = zero
  end subroutine make_solid

  !> What a step from U0 (dim, *) needs of the elements first..last: their energies there. Not
  !> where has_quadratic_energy.
  pure subroutine begin_elements(solid, first, last, u0)
    type(solid_t), intent(inout) :: solid
    integer, intent(in) :: first, last
    real(wp), intent(in) :: u0(:, :)
    integer :: k
    do k = first, last
      solid%energy(k) = element_energy(solid, k, u0)
    end do
  end subroutine begin_elements

  !> The step is accepted: the history at U1 (dim, *) becomes the old one.
  pure subroutine commit_step(solid, u1)
    type(solid_t), intent(inout) :: solid
    real(wp), intent(in) :: u1(:, :)
    real(wp) :: a(solid%dim, solid%nodes), h(solid%dim, solid%columns, solid%points)
    real(wp) :: s(solid%strains, solid%points), energy
    real(wp) :: d(solid%strains, solid%strains, solid%points)
    real(wp) :: new(solid%material%states, solid%points)
    integer :: k
    if (solid%material%states == 0) return
    do k = 1, solid%n
      call relative(solid, k, u1, a)
      call stresses_at(solid, k, a, .false., h, s, d, energy, new=new)
      solid%history(:, :, k) = new
    end do
  end subroutine commit_step

  !> Force (dim, nodes) [F] of element k over the step from U0 by x, both (dim, *) [L].
  pure subroutine element_force(solid, k, rule, u0, x, force)
    type(solid_t), intent(in) :: solid
    integer, intent(in) :: k
    type(force_rule_t), intent(in) :: rule
    real(wp), intent(in) :: u0(:, :), x(:, :)
    real(wp), intent(out) :: force(:, :)
    real(wp), dimension(solid%dim, solid%nodes) :: a, d
    call relative(solid, k, u0, a)
    call relative(solid, k, x, d)
    force = zero
    select case (rule%kind)
    case (force_middle)
      call add_force_at(solid, k, one, a + half*d, force)
    case (force_conserving)
      call add_conserving(solid, k, a, d, force)
    case default
      if (abs(rule%before) > zero) call add_force_at(solid, k, rule%before, a, force)
      if (abs(rule%now) > zero) call add_force_at(solid, k, rule%now, a + d, force)
    end select
  end subroutine element_force

  !> Displacements of an element relative to its first node, around an axis only the axial ones.
  pure subroutine relative(solid, k, u, a)
    type(solid_t), intent(in) :: solid
    integer, intent(in) :: k
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: a(:, :)
    integer :: i
    do i = 1, solid%nodes
      a(:, i) = u(:, solid%node(i, k)) - u(:, solid%node(1, k))
      if (solid%columns > solid%dim) a(1, i) = u(1, solid%node(i, k))
    end do
  end subroutine relative

  !> force = force + factor f(U).
  pure subroutine add_force_at(solid, k, factor, u, force)
    type(solid_t), intent(in) :: solid
    integer, intent(in) :: k
    real(wp), intent(in) :: factor, u(:, :)
    real(wp), intent(inout) :: force(:, :)
    real(wp) :: h(solid%dim, solid%columns, solid%points), s(solid%strains, solid%points)
    real(wp) :: d(solid%strains, solid%strains, solid%points), energy
    integer :: g
    call stresses_at(solid, k, u, .false., h, s, d, energy)
    do g = 1, solid%points
      call add_stress_force(factor*solid%weight(g, k), h(:, :, g), s(:, g), &
          solid%slope(:, :, g, k), force)
    end do
  end subroutine add_force_at

  !> Of all points of element k at relative displacements u: H, stress, moduli where asked for;
  !> energy of the element [F L].
  pure subroutine stresses_at(solid, k, u, with_moduli, h, s, d, energy, coupling, new)
    type(solid_t), intent(in) :: solid
    integer, intent(in) :: k
    real(wp), intent(in) :: u(:, :)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: h(:, :, :), s(:, :), d(:, :, :), energy
    type(coupling_t), intent(inout), optional :: coupling
    real(wp), intent(out), optional :: new(:, :)
    real(wp) :: e(solid%strains, solid%points)
    integer :: g
    do g = 1, solid%points
      call displacement_gradient(u, solid%slope(:, :, g, k), h(:, :, g))
      call green_strain(h(:, :, g), e(:, g))
    end do
    call respond(solid, k, e, with_moduli, s, d, energy, coupling, new)
  end subroutine stresses_at

  !> The law at all points of an element for their strains e; energy of the element [F L].
  pure subroutine respond(solid, k, e, with_moduli, s, d, energy, coupling, new)
    type(solid_t), intent(in) :: solid
    integer, intent(in) :: k
    real(wp), intent(in) :: e(:, :)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: s(:, :), d(:, :, :), energy
    type(coupling_t), intent(inout), optional :: coupling
    real(wp), intent(out), optional :: new(:, :)
    real(wp) :: density, last(solid%material%states, solid%points)
    integer :: g
    if (solid%is_mean) then
      call mean_response(solid%material, solid%place, solid%weight(:, k), e, &
          solid%history(:, :, k), with_moduli, s, d, energy, last, coupling)
    else
      energy = zero
      do g = 1, solid%points
        call respond_as(solid%material, solid%plane, e(:, g), solid%history(:, g, k), &
            with_moduli, s(:, g), d(:, :, g), density, last(:, g))
        energy = energy + solid%weight(g, k)*density
      end do
    end if
    if (present(new)) new = last
  end subroutine respond

  !> The conserving force of an element, a the relative displacements U0, x those of the step.
  pure subroutine add_conserving(solid, k, a, x, force)
    type(solid_t), intent(in) :: solid
    integer, intent(in) :: k
    real(wp), intent(in) :: a(:, :), x(:, :)
    real(wp), intent(inout) :: force(:, :)
    real(wp) :: h(solid%dim, solid%columns, solid%points), s(solid%strains, solid%points)
    real(wp) :: d(solid%strains, solid%strains, solid%points)
    integer :: g
    call conserving_stresses(solid, k, a, x, .false., h, s, d)
    do g = 1, solid%points
      call add_stress_force(solid%weight(g, k), h(:, :, g), s(:, g), &
          solid%slope(:, :, g, k), force)
    end do
  end subroutine add_conserving

  !> H of the mean displacement and S* at the points, moduli at the mean strain where asked for.
  !> S* = S(E_m) + q (E1 - E0), q = [W1 - W0 - sum w S(E_m):(E1 - E0)] / sum w |E1 - E0|^2;
  !> where the strain hardly changes q is left out: its numerator, of third order, is round-off
  !> there. With plasticity W1 - W0 has the plastic work of the step besides, and S(E_m) is
  !> that of the law from the history at the start (Meng & Laursen 2002).
  pure subroutine conserving_stresses(solid, k, a, x, with_moduli, h, s, d, coupling)
    type(solid_t), intent(in) :: solid
    integer, intent(in) :: k
    real(wp), intent(in) :: a(:, :), x(:, :)
    logical, intent(in) :: with_moduli
    real(wp), intent(out) :: h(:, :, :), s(:, :), d(:, :, :)
    type(coupling_t), intent(inout), optional :: coupling
    real(wp), parameter :: least = 2.5e-11_wp    ! of |dE|^2 = |dC|^2/4
    real(wp), dimension(solid%strains, solid%points) :: e0, e1, s_end
    real(wp) :: h1(3, 3), end(3, most_nodes), energy, change, work, length
    real(wp) :: no_moduli(solid%strains, solid%strains, solid%points)
    real(wp) :: new(solid%material%states, solid%points)
    integer :: g
    end(:solid%dim, :solid%nodes) = a + x
    do g = 1, solid%points
      call displacement_gradient(a, solid%slope(:, :, g, k), h(:, :, g))
      call green_strain(h(:, :, g), e0(:, g))
      call displacement_gradient(end(:solid%dim, :solid%nodes), solid%slope(:, :, g, k), &
          h1(:solid%dim, :solid%columns))
      call green_strain(h1(:solid%dim, :solid%columns), e1(:, g))
      h(:, :, g) = half*(h(:, :, g) + h1(:solid%dim, :solid%columns))
    end do
    call respond(solid, k, half*(e0 + e1), with_moduli, s, d, energy, coupling)
    if (has_quadratic_energy(solid)) return
    length = zero
    work = zero
    do g = 1, solid%points
      associate (e => e1(:, g) - e0(:, g), w => solid%weight(g, k))
        length = length + w*dot_product(tensor_of(e, solid), e)
        work = work + w*dot_product(s(:, g), e)
      end associate
    end do
    if (.not. length > least*sum(solid%weight(:, k))) return
    call respond(solid, k, e1, .false., s_end, no_moduli, energy, new=new)
    if (solid%material%work_state > 0) energy = energy + plastic_growth(solid, k, new)
    change = (energy - solid%energy(k) - work)/length
    do g = 1, solid%points
      s(:, g) = s(:, g) + change*tensor_of(e1(:, g) - e0(:, g), solid)
    end do
  end subroutine conserving_stresses

  !> Plastic work of element k from the history at the start of the step to a new one [F L].
  pure real(wp) function plastic_growth(solid, k, new)
    type(solid_t), intent(in) :: solid
    integer, intent(in) :: k
    real(wp), intent(in) :: new(:, :)
    associate (row => solid%material%work_state)
      plastic_growth = dot_product(solid%weight(:, k), new(row, :) - solid%history(row, :, k))
    end associate
  end function plastic_growth

  !> Is the energy of an element a quadratic form of its strains? The quotient is then zero.
  pure logical function has_quadratic_energy(solid)
    type(solid_t), intent(in) :: solid
    has_quadratic_energy = solid%material%is_quadratic .and. .not. solid%is_mean
  end function has_quadratic_energy

  !> The components E12 in place of 2 E12.
  pure function tensor_of(e, solid) result(t)
    real(wp), intent(in) :: e(:)
    type(solid_t), intent(in) :: solid
    real(wp) :: t(size(e))
    t = e
    where (solid%place > 3) t = half*e
  end function tensor_of

  !> Symmetric tangent (dim nodes, dim nodes) [F/L] of the force of a step in x. Of the
  !> conserving force the exact one is not symmetric: B(F1) for B(F_m) on the right, and the
  !> derivative of the quotient, are left out; they cost passes of Newton's method, no accuracy.
  pure subroutine element_tangent(solid, k, rule, u0, x, ke)
    type(solid_t), intent(in) :: solid
    integer, intent(in) :: k
    type(force_rule_t), intent(in) :: rule
    real(wp), intent(in) :: u0(:, :), x(:, :)
    real(wp), intent(out) :: ke(:, :)
    real(wp), dimension(solid%dim, solid%nodes) :: a, change
    real(wp) :: h(solid%dim, solid%columns, solid%points), s(solid%strains, solid%points)
    real(wp) :: d(solid%strains, solid%strains, solid%points), energy
    real(wp) :: b(solid%strains, solid%dim*solid%nodes), factor
    real(wp), dimension(solid%dim*solid%nodes) :: to_g, to_b
    type(coupling_t) :: coupling
    integer :: g
    call relative(solid, k, u0, a)
    call relative(solid, k, x, change)
    factor = half
    select case (rule%kind)
    case (force_middle)
      call stresses_at(solid, k, a + half*change, .true., h, s, d, energy, coupling)
    case (force_conserving)
      call conserving_stresses(solid, k, a, change, .true., h, s, d, coupling)
    case default
      call stresses_at(solid, k, a + change, .true., h, s, d, energy, coupling)
      factor = rule%now
    end select
    ke = zero
    to_g = zero
    to_b = zero
    do g = 1, solid%points
      associate (w => factor*solid%weight(g, k), slope => solid%slope(:, :, g, k))
        call strain_matrix(h(:, :, g), slope, b)
        call add_material_part(w, d(:, :, g), b, ke)
        call add_geometric_part(rule%geometric*w, s(:, g), slope, ke)
      end associate
      if (.not. solid%is_mean) cycle
      to_g = to_g + matmul(coupling%g(:solid%strains, g), b)
      to_b = to_b + matmul(coupling%b(:solid%strains, g), b)
    end do
    if (solid%is_mean) call add_coupling(factor, coupling%z, to_g, to_b, ke)
  end subroutine element_tangent

  !> ke = ke + factor (b g' + g b' + z g g').
  pure subroutine add_coupling(factor, z, g, b, ke)
    real(wp), intent(in) :: factor, z, g(:), b(:)
    real(wp), intent(inout) :: ke(:, :)
    integer :: j
    do j = 1, size(g)
      ke(:, j) = ke(:, j) + factor*((b(j) + z*g(j))*g + g(j)*b)
    end do
  end subroutine add_coupling

  !> Strain energy of element k at displacements u (dim, *) [F L].
  pure real(wp) function element_energy(solid, k, u) result(energy)
    type(solid_t), intent(in) :: solid
    integer, intent(in) :: k
    real(wp), intent(in) :: u(:, :)
    real(wp) :: a(solid%dim, solid%nodes), h(solid%dim, solid%columns, solid%points)
    real(wp) :: s(solid%strains, solid%points)
    real(wp) :: d(solid%strains, solid%strains, solid%points)
    call relative(solid, k, u, a)
    call stresses_at(solid, k, a, .false., h, s, d, energy)
  end function element_energy

end module solid_block
