"""A mesh with named groups, as the readers of mesh_files.py hand it over; mesh_tidy.py makes it
one of a deck."""

import numpy as np

from mesh_shapes import KINDS, SHAPES, dimension

LARGEST_ID = 2147483647


class MeshError(Exception):
    """A mesh that makes no deck; the text says what, where and what to do."""


class Group:
    """Named cells of a dimension (3 to 1) or nodes (dim 0) by their rows; number: wanted as id,
    or 0; rank: of two groups with the same elements the lower one names the part."""

    def __init__(self, dim, name, members, number=0, rank=0):
        self.dim, self.name, self.number, self.rank = dim, name, int(number), rank
        self.members = np.unique(np.asarray(members, dtype=np.int64))


class Cells:
    """Cells of one dimension: kind (m), numbers of mesh_shapes.KINDS; nodes (m, w), rows of
    nodes of which a cell with fewer than w repeats its last; ids (m) or None. A cell in no group
    belongs to region_name[region]."""

    def __init__(self, width):
        self.kind = self.region = np.zeros(0, dtype=np.int64)
        self.nodes = np.zeros((0, width), dtype=np.int64)
        self.ids, self.region_name = None, []

    def __len__(self):
        return len(self.kind)

    def add(self, kind, rows, ids, region):
        """Cells of one kind; returns their rows here."""
        first, width = len(self), max(rows.shape[1], self.nodes.shape[1])
        self.nodes = np.concatenate([widened(self.nodes, width), widened(rows, width)])
        self.kind = np.concatenate([self.kind, np.full(len(rows), KINDS.index(kind))])
        if ids is not None:
            before = np.zeros(0, dtype=np.int64) if self.ids is None else self.ids
            self.ids = np.concatenate([before, np.asarray(ids, dtype=np.int64)])
        if region not in self.region_name:
            self.region_name.append(region)
        where = np.full(len(rows), self.region_name.index(region))
        self.region = np.concatenate([self.region, where])
        return np.arange(first, len(self))

    def keep(self, rows):
        """Leaves all other cells out."""
        self.kind, self.nodes, self.region = (
            self.kind[rows],
            self.nodes[rows],
            self.region[rows],
        )
        if self.ids is not None:
            self.ids = self.ids[rows]

    def each_kind(self):
        """(kind, its rows here, their nodes without repetition) of the kinds that there are."""
        for number in np.unique(self.kind).tolist():
            rows = np.flatnonzero(self.kind == number)
            yield KINDS[number], rows, self.nodes[rows][:, : SHAPES[KINDS[number]].nodes]

    def change(self, rows, kind, nodes):
        """Gives cells another kind and nodes."""
        self.kind[rows] = KINDS.index(kind)
        self.nodes[rows] = widened(np.asarray(nodes), self.nodes.shape[1])


def widened(rows, width):
    """Rows whose last node is repeated up to a width."""
    column = np.minimum(np.arange(width), rows.shape[1] - 1)
    return rows[:, column]


class Mesh:
    """Nodes x (n, 3) [L] and node_id (n) or None; cells of dimension 1 to 3, of which the
    highest that there are from 2 on are the elements (dim), those below their sides; groups.
    counts: cells by kind and name in the file. notes: what there is to say of the file."""

    def __init__(self, x, node_id=None):
        x = np.asarray(x, dtype=float)
        self.x = np.zeros((len(x), 3))
        if len(x):
            self.x[:, : x.shape[1]] = x
        self.node_id = node_id
        self.groups, self.notes, self.counts = [], [], {}
        self.cells = {1: Cells(2), 2: Cells(4), 3: Cells(8)}

    def add(self, kind, rows, ids=None, region="mesh", said=None):
        """Cells of one kind, by the name said in the file; returns their rows among the cells
        of their dimension, or nodes."""
        rows = np.asarray(rows, dtype=np.int64)
        dim, key = dimension(kind), (kind, said or kind)
        self.counts[key] = self.counts.get(key, 0) + len(rows)
        if dim is None:
            return np.zeros(0, dtype=np.int64)
        return self.cells[dim].add(kind, rows, ids, region) if dim else rows.ravel()

    @property
    def dim(self):
        """3 where there are volumes, else 2."""
        return 3 if len(self.cells[3]) else 2

    @property
    def elements(self):
        return self.cells[self.dim]

    @property
    def sides(self):
        return self.cells[self.dim - 1]

    def members(self, dim):
        """Groups of a dimension that have members."""
        return [g for g in self.groups if g.dim == dim and len(g.members)]


def node_name(mesh, row):
    return "node %d" % (row + 1 if mesh.node_id is None else mesh.node_id[row])


def element_name(mesh, row):
    ids = mesh.elements.ids
    return "element %d" % (row + 1 if ids is None else ids[row])


def first_of(mesh, rows):
    """The first of some elements by its name, and how many more there are."""
    more = " and %d more" % (len(rows) - 1) if len(rows) > 1 else ""
    return element_name(mesh, rows[0]) + more


def same_members(rows):
    """Equal numbers for rows that have the same members, in whatever order and however often."""
    rows = np.sort(rows, axis=1)
    rows[:, 1:][rows[:, 1:] == rows[:, :-1]] = -1
    rows = np.sort(rows, axis=1) + 1
    label = rows[:, 0]
    for column in rows.T[1:]:
        label = label * (column.max(initial=0) + 1) + column
        label = np.unique(label, return_inverse=True)[1].ravel()
    return label


class Ids:
    """Hands out ids: the one wanted if it is free, else the smallest that nobody wants."""

    def __init__(self, groups):
        self.wanted, self.taken = {g.number for g in groups}, set()

    def take(self, number=0):
        if not 1 <= number <= LARGEST_ID or number in self.taken:
            number = next(k for k in range(1, LARGEST_ID) if k not in self.taken | self.wanted)
        self.taken.add(number)
        return number
