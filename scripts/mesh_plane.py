"""Plane meshes: a constant z, counter-clockwise elements of a shape that a deck takes."""

import numpy as np

from mesh_data import MeshError, element_name, first_of, node_name
from mesh_shapes import KINDS

ROUND_OFF = 1.0e-12  # of the size: what a mesher leaves of a z that it holds constant

SURFACE = "; a body in space needs its volumes (gmsh -3, and name them where groups are named)"


def make_valid(mesh):
    check_plane(mesh)
    turn(mesh)
    check_shapes(mesh)


def collapse(mesh):
    """Quadrilaterals with a node twice in a row become triangles."""
    elements = mesh.elements
    c = elements.nodes
    for k in range(4):
        quad = c[:, 3] != c[:, 2]
        twice = np.flatnonzero(quad & (c[:, k] == c[:, (k + 1) % 4]))
        rest = [j for j in range(4) if j != k]
        elements.change(twice, "triangle", c[twice][:, rest])
    elements.kind[c[:, 3] == c[:, 2]] = KINDS.index("triangle")
    same = (c[:, 0] == c[:, 1]) | (c[:, 1] == c[:, 2]) | (c[:, 0] == c[:, 2])
    same |= (c[:, 0] == c[:, 3]) | (c[:, 1] == c[:, 3])
    if same.any():
        raise MeshError("%s has a node twice" % element_name(mesh, np.flatnonzero(same)[0]))


def check_plane(mesh):
    """One z for all nodes, but for what round-off makes of it."""
    x = mesh.x
    size, z = np.ptp(x[:, :2], axis=0).max(), x[:, 2]
    low, high = z.argmin(), z.argmax()
    if z[high] - z[low] > ROUND_OFF * size:
        across = [
            name for name, k in (("x", 0), ("y", 1)) if np.ptp(x[:, k]) <= ROUND_OFF * np.ptp(z)
        ]
        hint = (
            "; this mesh stands across %s: turn it into x-y" % across[0] if across else SURFACE
        )
        raise MeshError(
            "z is not constant: %r at %s, %r at %s. A plane model lies in x-y%s"
            % (float(z[low]), node_name(mesh, low), float(z[high]), node_name(mesh, high), hint)
        )
    values, count = np.unique(z, return_counts=True)
    z[:] = 0.0 if (np.abs(values) <= ROUND_OFF * size).all() else values[count.argmax()]


def areas(mesh):
    """Signed areas of the elements [L2]."""
    c = mesh.x[mesh.elements.nodes][:, :, :2]
    d, e = c[:, 2] - c[:, 0], c[:, 3] - c[:, 1]
    return 0.5 * (d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0])


def turn(mesh):
    """Clockwise elements are turned; their first node stays the first."""
    back = areas(mesh) < 0.0
    for kind, rows, nodes in mesh.elements.each_kind():
        order = [0, 2, 1] if kind == "triangle" else [0, 3, 2, 1]
        mesh.elements.change(rows[back[rows]], kind, nodes[back[rows]][:, order])
    if back.any():
        mesh.notes.append("elements turned counter-clockwise: %d" % back.sum())


def check_shapes(mesh):
    """Positive area, and quadrilaterals convex: every corner turns left."""
    good = areas(mesh) > 0.0
    x, c = mesh.x[:, :2], mesh.elements.nodes
    quad = c[:, 3] != c[:, 2]
    for k in range(4):
        a, b = x[c[:, k]] - x[c[:, k - 1]], x[c[:, (k + 1) % 4]] - x[c[:, k]]
        good &= ~quad | (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] > 0.0)
    bad = np.flatnonzero(~good)
    if len(bad):
        raise MeshError(
            "%s: area 0, an inner angle of 180 degrees or more, or edges that cross"
            % first_of(mesh, bad)
        )
