"""A mesh with named groups, as the readers of mesh_files.py hand it over, and its tidying:
elements and nodes as a plane deck takes them."""

import numpy as np

KINDS = {"vertex": 0, "line": 1, "triangle": 2, "quad": 2}  # what is read, and its dimension
LARGEST_ID = 2147483647
SMALLEST = 1.0e-75  # the deck takes no number below, but 0 [L]
ROUND_OFF = 1.0e-12  # of the size: what a mesher leaves of a z that it holds constant


class MeshError(Exception):
    """A mesh that makes no plane deck; the text says what, where and what to do."""


class Group:
    """Named elements (dim 2), lines (dim 1) or nodes (dim 0) by their rows; number: wanted as
    id, or 0; rank: of two groups with the same elements the lower one names the part."""

    def __init__(self, dim, name, members, number=0, rank=0):
        self.dim, self.name, self.number, self.rank = dim, name, int(number), rank
        self.members = np.unique(np.asarray(members, dtype=np.int64))


class Mesh:
    """Nodes x (n, 3) [L] and node_id (n) or None; elements corners (m, 4), rows of nodes of
    which a triangle repeats its third, and element_id (m) or None; lines (l, 2); groups. An
    element in no group belongs to region_name[region]. notes: what there is to say of the
    file."""

    def __init__(self, x, node_id=None):
        x = np.asarray(x, dtype=float)
        self.x = np.zeros((len(x), 3))
        if len(x):
            self.x[:, : x.shape[1]] = x
        self.node_id, self.element_id = node_id, None
        self.groups, self.notes, self.refused = [], [], {}
        self.region_name, self.region = [], np.zeros(0, dtype=np.int64)
        self.corners = np.zeros((0, 4), dtype=np.int64)
        self.lines = np.zeros((0, 2), dtype=np.int64)

    def add(self, kind, rows, ids=None, region="mesh"):
        """Cells of one kind; returns their rows among the elements, lines or nodes."""
        rows = np.asarray(rows, dtype=np.int64)
        dim = KINDS.get(kind)
        if dim is None:
            self.refused[kind] = self.refused.get(kind, 0) + len(rows)
            return np.zeros(0, dtype=np.int64)
        if dim == 0:
            return rows.ravel()
        if dim == 1:
            first = len(self.lines)
            self.lines = np.concatenate([self.lines, rows])
            return np.arange(first, len(self.lines))
        return self.add_elements(rows, ids, region)

    def add_elements(self, rows, ids, region):
        first = len(self.corners)
        if rows.shape[1] == 3:
            rows = rows[:, [0, 1, 2, 2]]
        self.corners = np.concatenate([self.corners, rows])
        if ids is not None:
            before = np.zeros(0, dtype=np.int64) if self.element_id is None else self.element_id
            self.element_id = np.concatenate([before, np.asarray(ids, dtype=np.int64)])
        if region not in self.region_name:
            self.region_name.append(region)
        where = np.full(len(rows), self.region_name.index(region))
        self.region = np.concatenate([self.region, where])
        return np.arange(first, len(self.corners))

    def members(self, dim):
        """Groups of a dimension that have members."""
        return [g for g in self.groups if g.dim == dim and len(g.members)]


def tidy(mesh):
    """Makes the mesh one of a plane deck: no quadratic or volume element, none twice, no node
    without element, a constant z, counter-clockwise, ids that the deck takes."""
    check_kinds(mesh)
    check_coordinates(mesh)
    collapse(mesh)
    merge_elements(mesh)
    drop_nodes(mesh)
    check_plane(mesh)
    turn(mesh)
    check_shapes(mesh)
    mesh.node_id = legal_ids(mesh, mesh.node_id, len(mesh.x), "node")
    mesh.element_id = legal_ids(mesh, mesh.element_id, len(mesh.corners), "element")


def check_kinds(mesh):
    if mesh.refused:
        what = ", ".join(
            "%d of type %s" % (n, kind) for kind, n in sorted(mesh.refused.items())
        )
        raise MeshError(
            "elements that a plane deck does not take: %s. It takes triangles with 3 nodes and "
            "quadrilaterals with 4: mesh in the plane with linear elements (gmsh -2 -order 1)"
            % what
        )
    if not len(mesh.corners):
        hint = "; in Gmsh, physical groups choose what is saved: name the surfaces too"
        raise MeshError(
            "no triangle and no quadrilateral in it" + (hint if mesh.groups else "")
        )


def check_coordinates(mesh):
    bad = np.flatnonzero(~np.isfinite(mesh.x).all(axis=1))
    if len(bad):
        raise MeshError("a coordinate of %s is not finite" % node_name(mesh, bad[0]))
    mesh.x[np.abs(mesh.x) < SMALLEST] = 0.0


def node_name(mesh, row):
    return "node %d" % (row + 1 if mesh.node_id is None else mesh.node_id[row])


def element_name(mesh, row):
    return "element %d" % (row + 1 if mesh.element_id is None else mesh.element_id[row])


def collapse(mesh):
    """Quadrilaterals with a node twice in a row become triangles."""
    for k in range(4):
        c = mesh.corners
        quad = c[:, 3] != c[:, 2]
        twice = np.flatnonzero(quad & (c[:, k] == c[:, (k + 1) % 4]))
        rest = [j for j in range(4) if j != k]
        mesh.corners[twice] = c[twice][:, rest + rest[-1:]]
    c = mesh.corners
    same = (c[:, 0] == c[:, 1]) | (c[:, 1] == c[:, 2]) | (c[:, 0] == c[:, 2])
    same |= (c[:, 0] == c[:, 3]) | (c[:, 1] == c[:, 3])
    if same.any():
        raise MeshError("%s has a node twice" % element_name(mesh, np.flatnonzero(same)[0]))


def merge_elements(mesh):
    """Of elements with the same nodes the first stays: Gmsh's format 2.2 writes an element once
    for each of its groups."""
    key = np.sort(mesh.corners, axis=1)
    triangle = mesh.corners[:, 3] == mesh.corners[:, 2]
    key[triangle, 3], key[triangle, :3] = -1, np.sort(mesh.corners[triangle, :3], axis=1)
    _, first, where = np.unique(key, axis=0, return_index=True, return_inverse=True)
    if len(first) == len(key):
        return
    order = np.argsort(first)
    new = np.empty(len(first), dtype=np.int64)
    new[order] = np.arange(len(first))
    keep, row = first[order], new[where.ravel()]
    mesh.corners, mesh.region = mesh.corners[keep], mesh.region[keep]
    if mesh.element_id is not None:
        mesh.element_id = mesh.element_id[keep]
    for g in mesh.groups:
        if g.dim == 2:
            g.members = np.unique(row[g.members])
    mesh.notes.append("elements written twice in the file: %d" % (len(key) - len(keep)))


def drop_nodes(mesh):
    """Nodes without element go; lines and groups of nodes lose them (-1 in mesh.lines)."""
    used = np.zeros(len(mesh.x), dtype=bool)
    used[mesh.corners] = True
    if used.all():
        return
    new = np.where(used, np.cumsum(used) - 1, -1)
    mesh.x, mesh.corners, mesh.lines = mesh.x[used], new[mesh.corners], new[mesh.lines]
    if mesh.node_id is not None:
        mesh.node_id = mesh.node_id[used]
    for g in mesh.groups:
        if g.dim == 0:
            kept = g.members[used[g.members]]
            lost = len(g.members) - len(kept)
            g.members = new[kept]
            if lost:
                mesh.notes.append('nodes of "%s" on no element left out: %d' % (g.name, lost))
    mesh.notes.append("nodes without element left out: %d" % (~used).sum())


def check_plane(mesh):
    """One z for all nodes, but for what round-off makes of it."""
    x = mesh.x
    size, z = np.ptp(x[:, :2], axis=0).max(), x[:, 2]
    low, high = z.argmin(), z.argmax()
    if z[high] - z[low] > ROUND_OFF * size:
        across = [
            name for name, k in (("x", 0), ("y", 1)) if np.ptp(x[:, k]) <= ROUND_OFF * np.ptp(z)
        ]
        hint = "; this mesh stands across %s: turn it into x-y" % across[0] if across else ""
        raise MeshError(
            "z is not constant: %r at %s, %r at %s. A plane model lies in x-y%s"
            % (float(z[low]), node_name(mesh, low), float(z[high]), node_name(mesh, high), hint)
        )
    values, count = np.unique(z, return_counts=True)
    z[:] = 0.0 if (np.abs(values) <= ROUND_OFF * size).all() else values[count.argmax()]


def areas(mesh):
    """Signed areas of the elements [L2]."""
    c = mesh.x[mesh.corners][:, :, :2]
    d, e = c[:, 2] - c[:, 0], c[:, 3] - c[:, 1]
    return 0.5 * (d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0])


def turn(mesh):
    """Clockwise elements are turned; their first node stays the first."""
    back = areas(mesh) < 0.0
    triangle = mesh.corners[:, 3] == mesh.corners[:, 2]
    for which, order in ((back & triangle, [0, 2, 1, 1]), (back & ~triangle, [0, 3, 2, 1])):
        mesh.corners[which] = mesh.corners[which][:, order]
    if back.any():
        mesh.notes.append("elements turned counter-clockwise: %d" % back.sum())


def check_shapes(mesh):
    """Positive area, and quadrilaterals convex: every corner turns left."""
    good = areas(mesh) > 0.0
    x, c = mesh.x[:, :2], mesh.corners
    quad = c[:, 3] != c[:, 2]
    for k in range(4):
        a, b = x[c[:, k]] - x[c[:, k - 1]], x[c[:, (k + 1) % 4]] - x[c[:, k]]
        good &= ~quad | (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] > 0.0)
    bad = np.flatnonzero(~good)
    if len(bad):
        raise MeshError(
            "%s%s: area 0, an inner angle of 180 degrees or more, or edges that cross"
            % (
                element_name(mesh, bad[0]),
                " and %d more" % (len(bad) - 1) if len(bad) > 1 else "",
            )
        )


def legal_ids(mesh, ids, count, what):
    """The ids of the file where a deck takes them all, else 1, 2, ..."""
    if ids is not None:
        ids = np.asarray(ids, dtype=np.int64)
        if len(np.unique(ids)) == count and ids.min() >= 1 and ids.max() <= LARGEST_ID:
            return ids
        mesh.notes.append(
            "%ss numbered anew from 1: a deck takes ids of 1 to %d" % (what, LARGEST_ID)
        )
    return np.arange(1, count + 1)


class Ids:
    """Hands out ids: the one wanted if it is free, else the smallest that nobody wants."""

    def __init__(self, groups):
        self.wanted, self.taken = {g.number for g in groups}, set()

    def take(self, number=0):
        if not 1 <= number <= LARGEST_ID or number in self.taken:
            number = next(k for k in range(1, LARGEST_ID) if k not in self.taken | self.wanted)
        self.taken.add(number)
        return number
