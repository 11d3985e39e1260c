! SPDX-License-Identifier: BSD-3-Clause
!> How far elements have turned, and which is turned inside out.
module assembly_turns
  use assembly_system, only: system_t
  use base_kinds, only: wp, zero, one, half
  use element_base, only: most_points
  use model_data, only: model_t
  implicit none
  private
  public :: largest_rotation, first_inverted

contains

  !> Largest rotation of an element [radians], and the element: in the plane by its diagonals,
  !> in space by the gradient at its centre.
  pure subroutine largest_rotation(model, system, u, angle, element)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: angle
    integer, intent(out) :: element
    if (model%dim == 2) then
      call rotation_in_plane(system, model%x, u, angle, element)
    else
      call rotation_in_space(model, u, angle, element)
    end if
  end subroutine largest_rotation

  !> The first element whose area at X + U, in space its smallest Jacobian, is not positive; 0
  !> = none.
  pure integer function first_inverted(model, system, u)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: u(:, :)
    if (model%dim == 2) then
      first_inverted = inverted_in_plane(system, model%x, u)
    else
      first_inverted = inverted_in_space(model, u)
    end if
  end function first_inverted

  pure subroutine rotation_in_plane(system, x, u, angle, element)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: x(:, :), u(:, :)
    real(wp), intent(out) :: angle
    integer, intent(out) :: element
    real(wp) :: d(2), e(2), sine, cosine, size_d, size_e
    integer :: b, k
    angle = zero
    element = 0
    do b = 1, size(system%block)
      associate (node => system%block(b)%node)
        if (system%block(b)%is_rigid) cycle    ! turns as it will
        do k = 1, size(node, 2)
          d = x(:, node(3, k)) - x(:, node(1, k))
          e = d + (u(:, node(3, k)) - u(:, node(1, k)))
          ! Unit sizes first: the products of an unbounded motion would overflow.
          size_d = maxval(abs(d))
          size_e = maxval(abs(e))
          if (.not. size_e > zero) cycle
          d = d/size_d
          e = e/size_e
          sine = d(1)*e(2) - d(2)*e(1)
          cosine = d(1)*e(1) + d(2)*e(2)
          if (abs(sine) <= angle*cosine) cycle
          angle = abs(sine)/max(cosine, tiny(cosine))
          element = system%block(b)%first + k - 1
        end do
      end associate
    end do
    angle = atan(angle)
  end subroutine rotation_in_plane

  pure integer function inverted_in_plane(system, x, u)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: x(:, :), u(:, :)
    real(wp) :: d(2), e(2)
    do inverted_in_plane = 1, size(system%block_of)
      associate (block => system%block(system%block_of(inverted_in_plane)))
        associate (c => block%node(:, inverted_in_plane - block%first + 1), &
            last => block%nodes)
          d = (x(:, c(3)) - x(:, c(1))) + (u(:, c(3)) - u(:, c(1)))
          e = (x(:, c(last)) - x(:, c(2))) + (u(:, c(last)) - u(:, c(2)))
        end associate
      end associate
      if (.not. d(1)*e(2) - d(2)*e(1) > zero) return
    end do
    inverted_in_plane = 0
  end function inverted_in_plane

  !> Of F = I + grad u at the centre the axial vector (F32 - F23, F13 - F31, F21 - F12)/2 is
  !> sine of the rotation times its axis, (tr F - 1)/2 its cosine; a displacement t omega x X
  !> turns by the arc tangent of t omega, a stretch not at all.
  pure subroutine rotation_in_space(model, u, angle, element)
    type(model_t), intent(in) :: model
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: angle
    integer, intent(out) :: element
    real(wp) :: g(3, 3), turned
    integer :: e
    angle = zero
    element = 0
    do e = 1, model%mesh%n
      call central_gradient(model, e, u, g)
      turned = atan2(half*norm2([g(3, 2) - g(2, 3), g(1, 3) - g(3, 1), g(2, 1) - g(1, 2)]), &
          one + half*(g(1, 1) + g(2, 2) + g(3, 3)))
      if (.not. turned > angle) cycle
      angle = turned
      element = e
    end do
  end subroutine rotation_in_space

  !> du_i/dX_j of element e at the centre of its points.
  pure subroutine central_gradient(model, e, u, g)
    type(model_t), intent(in) :: model
    integer, intent(in) :: e
    real(wp), intent(in) :: u(:, :)
    real(wp), intent(out) :: g(3, 3)
    real(wp) :: xi(3, most_points), w(most_points), det_j
    real(wp), dimension(model%mesh%count_of(e)) :: n
    real(wp) :: dn(size(n), 3)
    integer :: k, points
    associate (element => model%mesh%kind(model%mesh%type(e))%item)
      call element%rule(points, xi, w)
      call element%gradients(model%x(:, model%mesh%nodes_of(e)), &
          matmul(xi(:, :points), w(:points))/sum(w(:points)), n, dn, det_j)
    end associate
    g = zero
    do k = 2, size(n)
      associate (d => u(:, model%mesh%node_of(k, e)) - u(:, model%mesh%node_of(1, e)))
        g(:, 1) = g(:, 1) + d*dn(k, 1)
        g(:, 2) = g(:, 2) + d*dn(k, 2)
        g(:, 3) = g(:, 3) + d*dn(k, 3)
      end associate
    end do
  end subroutine central_gradient

  pure integer function inverted_in_space(model, u) result(e)
    type(model_t), intent(in) :: model
    real(wp), intent(in) :: u(:, :)
    do e = 1, model%mesh%n
      associate (element => model%mesh%kind(model%mesh%type(e))%item)
        if (.not. element%smallest_jacobian(model%x(:, model%mesh%nodes_of(e)) &
            + u(:, model%mesh%nodes_of(e))) > zero) return
      end associate
    end do
    e = 0
  end function inverted_in_space

end module assembly_turns
