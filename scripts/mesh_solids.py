"""Meshes in space: solids of positive volume, each of the kind that its different nodes make."""

import itertools

import numpy as np

from mesh_data import MeshError, element_name, first_of
from mesh_shapes import SHAPES, turned_over

FLAT = 1.0e-12  # of the cube of its size: a volume or Jacobian of round-off
CHUNK = 20000  # elements that are judged at once
UNIT = [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1]]
CORNERS = np.array(UNIT + [[x, y, 1] for x, y, _ in UNIT], dtype=float)


# ---------------------------------------------------------------- repeated nodes


def collapse(mesh):
    """Linear solids with repeated nodes become what they are without them."""
    for kind, rows, nodes in list(mesh.elements.each_kind()):
        ordered = np.sort(nodes, axis=1)
        twice = np.flatnonzero((ordered[:, 1:] == ordered[:, :-1]).any(axis=1))
        for row, found in zip(rows[twice], nodes[twice].tolist()):
            new = of_faces(kind, found) if kind == with_corners(kind) else None
            if new is None:
                raise MeshError(
                    "%s, a %s, has a node twice and is no tetrahedron, pyramid or wedge"
                    % (element_name(mesh, row), kind)
                )
            mesh.elements.change([row], *new)
        if len(twice):
            mesh.notes.append(
                "solids with repeated nodes read as what they are: %d" % len(twice)
            )


def with_corners(kind):
    """The linear kind of the same shape."""
    return {"tetra10": "tetra", "hexahedron27": "hexahedron"}.get(kind, kind)


def of_faces(kind, nodes):
    """(kind, [nodes]) of the solid that is left when repeated nodes are taken once; or None."""
    rings = [list(dict.fromkeys(nodes[k] for k in side)) for side in SHAPES[kind].sides]
    rings = [ring for ring in rings if len(ring) > 2]
    triangles = [ring for ring in rings if len(ring) == 3]
    quads = [ring for ring in rings if len(ring) == 4]
    many = len(triangles), len(quads), len(set(nodes))
    if many == (4, 0, 4):
        new, base = "tetra", triangles[0]
    elif many == (4, 1, 5):
        new, base = "pyramid", quads[0]
    elif many == (2, 3, 6):
        return wedge_of(triangles, quads)
    else:
        return None
    apex = [n for n in set(nodes) if n not in base]
    return new, [base[::-1] + apex]


def wedge_of(triangles, quads):
    """A wedge from its faces: each corner of one triangle beside one of the other."""
    base, top = triangles[0][::-1], set(triangles[1])
    if top & set(base):
        return None
    beside = {}
    for ring in quads:
        for a, b in zip(ring, ring[1:] + ring[:1]):
            beside.setdefault(a, set()).add(b)
            beside.setdefault(b, set()).add(a)
    above = [sorted(beside.get(n, set()) & top) for n in base]
    if [len(a) for a in above] != [1, 1, 1]:
        return None
    return "wedge", [base + [a[0] for a in above]]


# ---------------------------------------------------------------- volumes


class Form:
    """Derivatives of shape functions at the points of a rule, and at points that are judged.

    places (n, 3) of the nodes; powers (n, 3) of the monomials that the functions are made of;
    points, weights: the rule; more: other points to judge."""

    def __init__(self, places, powers, points, weights, more=()):
        self.weights = np.asarray(weights, dtype=float)
        places, powers = np.asarray(places, dtype=float), np.asarray(powers)
        functions = np.linalg.inv((places[:, None, :] ** powers).prod(axis=2))
        points = np.concatenate([np.asarray(points, dtype=float).reshape(-1, 3), *more])
        slopes = []
        for k in range(3):
            lower = powers.copy()
            lower[:, k] = np.maximum(lower[:, k] - 1, 0)
            slopes.append(powers[:, k] * (points[:, None, :] ** lower).prod(axis=2) @ functions)
        self.slopes = np.array(slopes)  # (3, points, nodes)

    def judge(self, x):
        """(volumes, smallest Jacobians) of elements x (m, nodes, 3)."""
        jacobian = np.linalg.det(np.einsum("kpn,mnd->mpkd", self.slopes, x))
        return jacobian[:, : len(self.weights)] @ self.weights, jacobian.min(axis=1)


def middles_of(places, kind):
    """Places of all nodes of a quadratic element from those of its corners."""
    between = [np.mean([places[c] for c in m], axis=0) for m in SHAPES[kind].middles]
    return np.concatenate([places, between])


def cube(points, weights, degree, places, more):
    """A hexahedron with a product of rules of one dimension."""
    three = [np.array(list(itertools.product(v, repeat=3))) for v in (points, weights)]
    powers = list(itertools.product(range(degree + 1), repeat=3))
    return Form(places, powers, three[0], three[1].prod(axis=1), more)


def forms():
    """{kind: Form}; wedges and pyramids are hexahedra with repeated nodes, as on their cards."""
    ends = np.vstack([np.zeros(3), np.eye(3)])
    two, three = (np.polynomial.legendre.leggauss(k) for k in (2, 3))
    places = middles_of(CORNERS, "hexahedron27")
    found = {
        "tetra": Form(ends, ends.astype(int), [0.25] * 3, [1 / 6]),
        "hexahedron": cube(*two, 1, CORNERS, [CORNERS]),
        "hexahedron27": cube(*three, 2, places, [places]),
    }
    found["wedge"] = found["pyramid"] = cube(*two, 1, CORNERS, [])
    places = middles_of(ends, "tetra10")
    powers = [p for p in itertools.product(range(3), repeat=3) if sum(p) <= 2]
    # Keast's rule of degree 3, that of the Jacobian.
    points = [[0.25] * 3, [1 / 6] * 3, *(np.full((3, 3), 1 / 6) + np.eye(3) / 3)]
    weights = np.array([-0.8, 0.45, 0.45, 0.45, 0.45]) / 6.0
    found["tetra10"] = Form(places, powers, points, weights, [places])
    return found


def judged(mesh, straight=False):
    """Volumes of the elements [L3], or of straight ones with their corners; whether each is
    valid: a volume beyond round-off and positive Jacobians."""
    volume, valid = np.zeros(len(mesh.elements)), np.zeros(len(mesh.elements), dtype=bool)
    known = forms()
    for kind, rows, nodes in mesh.elements.each_kind():
        kind = with_corners(kind) if straight else kind
        order = range(4) if kind == "tetra" else SHAPES[kind].card
        for k in range(0, len(rows), CHUNK):
            at = rows[k : k + CHUNK]
            x = mesh.x[nodes[k : k + CHUNK][:, order]]
            x = x - x[:, :1]
            least = FLAT * np.ptp(x, axis=1).max(axis=1) ** 3
            volume[at], smallest = known[kind].judge(x)
            valid[at] = (volume[at] > least) & (smallest > 0.0)
    return volume, valid


def volumes(mesh):
    return judged(mesh)[0]


# ---------------------------------------------------------------- what a deck takes


def make_valid(mesh):
    """Turns elements of negative volume, finds the order of mid nodes; an error where an element
    is none then."""
    back = judged(mesh, straight=True)[0] < 0.0
    for kind, rows, nodes in list(mesh.elements.each_kind()):
        which = back[rows]
        mesh.elements.change(rows[which], kind, nodes[which][:, turned_over(kind)])
    if back.any():
        mesh.notes.append("elements of negative volume turned: %d" % back.sum())
    bad = np.flatnonzero(~judged(mesh)[1])
    if order_middles(mesh, bad):
        bad = np.flatnonzero(~judged(mesh)[1])
    if len(bad):
        raise MeshError(
            "%s: volume 0, or faces that cross or fold (a Jacobian that is not positive)"
            % first_of(mesh, bad)
        )


def order_middles(mesh, bad):
    """Takes each mid node of quadratic elements for the edge or face on which it lies, where
    this is clear: not all programs write them in one order. How many have another order."""
    moved = 0
    for kind, rows, nodes in list(mesh.elements.each_kind()):
        rows, nodes = rows[np.isin(rows, bad)], nodes[np.isin(rows, bad)]
        of = SHAPES[kind]
        if not of.middles or not len(rows):
            continue
        x = mesh.x[nodes]
        places = np.stack([x[:, m].mean(axis=1) for m in of.middles], axis=1)
        apart = np.linalg.norm(x[:, None, of.corners :] - places[:, :, None], axis=3)
        order = apart.argmin(axis=2)
        every = np.arange(len(of.middles))
        clear = (np.sort(order, axis=1) == every).all(axis=1) & (order != every).any(axis=1)
        new = np.take_along_axis(nodes[:, of.corners :], order, axis=1)
        mesh.elements.change(rows[clear], kind, np.hstack([nodes[:, : of.corners], new])[clear])
        moved += int(clear.sum())
    if moved:
        mesh.notes.append("quadratic elements whose mid nodes have another order: %d" % moved)
    return moved
