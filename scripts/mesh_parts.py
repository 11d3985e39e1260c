"""Parts and sets of a deck from the groups of a tidy mesh (mesh_data.py).

A group of elements is a part; where groups share elements, their pieces are the parts. Each
group of elements is also the part set of its pieces. A group of lines is the segment set of its
exposed edges, and a node set; a group of points is a node set."""

from types import SimpleNamespace

import numpy as np

from cards import heading
from mesh_data import Ids

LONGEST = 70  # columns of a heading


class Titles:
    """Makes headings that fit and differ."""

    def __init__(self, mesh):
        self.taken, self.mesh = set(), mesh

    def take(self, name):
        title = heading(name, LONGEST)
        if title != heading(name, len(name) * 4 + 1):
            self.mesh.notes.append('a name is cut to %d columns: "%s"' % (LONGEST, title))
        k, plain = 1, title
        while title in self.taken:
            k += 1
            title = "%s (%d)" % (heading(plain, LONGEST - 6), k)
        self.taken.add(title)
        return title


def content(mesh):
    """What the deck gets: parts (id, title, rows of elements), part_sets (id, title, ids of
    parts), node_sets (id, title, rows of nodes), segment_sets (id, title, pairs of such rows).
    """
    parts = make_parts(mesh)
    node_sets, segment_sets = make_line_and_node_sets(mesh)
    return SimpleNamespace(
        parts=in_order(parts),
        part_sets=in_order(make_part_sets(mesh, parts)),
        node_sets=in_order(node_sets),
        segment_sets=in_order(segment_sets),
    )


def in_order(sets):
    return sorted(sets, key=lambda s: s.id)


def pieces(mesh, groups):
    """Rows of elements that are in the same groups, or in none and of the same region."""
    label = 1 + mesh.region
    for g in groups:
        label[g.members] = 0
    for g in groups:
        inside = np.zeros(len(label), dtype=np.int64)
        inside[g.members] = 1
        label = np.unique(2 * label + inside, return_inverse=True)[1].ravel()
    order = np.argsort(label, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(label[order])) + 1)


def make_parts(mesh):
    """A part for each piece; the group that is just this piece gives it its name and number."""
    groups = mesh.members(2)
    parts = []
    for rows in pieces(mesh, groups):
        owners = [
            g
            for g in groups
            if g.members[np.searchsorted(g.members, rows[0]) % len(g.members)] == rows[0]
        ]
        alone = [g for g in owners if len(g.members) == len(rows)]
        group = min(alone, key=lambda g: g.rank) if alone else None
        name = group.name if group else name_of_piece(mesh, owners, rows)
        parts.append(SimpleNamespace(rows=rows, owners=owners, group=group, name=name))
    parts.sort(key=lambda p: (p.group is None, p.rows[0]))
    ids, titles = Ids(groups), Titles(mesh)
    for p in parts:
        p.id, p.title = ids.take(p.group.number if p.group else 0), titles.take(p.name)
    return parts


def name_of_piece(mesh, owners, rows):
    """A name for elements that no group has for itself."""
    names = [g.name for g in sorted(owners, key=lambda g: len(g.members))]
    if len(names) == 1:
        return "rest of " + names[0]
    return " & ".join(names) or mesh.region_name[mesh.region[rows[0]]]


def make_part_sets(mesh, parts):
    """A part set for each group of elements, of the id of its part where it is one."""
    groups = mesh.members(2)
    own = {id(p.group): p.id for p in parts if p.group}
    groups.sort(key=lambda g: id(g) not in own)
    ids, titles = Ids(groups), Titles(mesh)
    return [
        SimpleNamespace(
            id=ids.take(own.get(id(g), g.number)),
            title=titles.take(g.name),
            members=sorted(p.id for p in parts if g in p.owners),
        )
        for g in groups
    ]


def edges_of(mesh):
    """Keys of the edges of all elements, sorted; how many elements have each; its nodes in the
    order of one of them (body on the left)."""
    c = mesh.corners
    after = np.roll(c, -1, axis=1)
    pairs = np.stack([c, after], axis=2).reshape(-1, 2)
    pairs = pairs[pairs[:, 0] != pairs[:, 1]]
    keys, first, count = np.unique(key_of(mesh, pairs), return_index=True, return_counts=True)
    return keys, count, pairs[first]


def key_of(mesh, pairs):
    return pairs.min(axis=1) * len(mesh.x) + pairs.max(axis=1)


def make_line_and_node_sets(mesh):
    """Segment sets and node sets of lines, then node sets of points."""
    lines, points = mesh.members(1), mesh.members(0)
    node_sets, segment_sets = [], []
    ids, titles, segment_titles = Ids(lines + points), Titles(mesh), Titles(mesh)
    edges = edges_of(mesh) if lines else None
    for g in lines:
        nodes, segments = of_lines(mesh, g, edges)
        if not len(nodes):
            mesh.notes.append('"%s" left out: its lines are on no element' % heading(g.name))
            continue
        number = ids.take(g.number)
        node_sets.append(SimpleNamespace(id=number, title=titles.take(g.name), members=nodes))
        if len(segments):
            title = segment_titles.take(g.name)
            segment_sets.append(SimpleNamespace(id=number, title=title, members=segments))
    for g in points:
        node_sets.append(
            SimpleNamespace(id=ids.take(g.number), title=titles.take(g.name), members=g.members)
        )
    return node_sets, segment_sets


def of_lines(mesh, group, edges):
    """Rows of the nodes of a group of lines, and its exposed edges; the others are noted."""
    keys, count, pairs = edges
    lines = mesh.lines[group.members]
    nodes = np.unique(lines[lines >= 0])
    dropped = (lines < 0).any(axis=1)
    key, first = np.unique(key_of(mesh, lines[~dropped]), return_index=True)
    key = key[np.argsort(first)]  # in the order of the file, each once
    where = np.minimum(np.searchsorted(keys, key), len(keys) - 1)
    found = keys[where] == key
    inner = found & (count[where] > 1)
    for what, many in (
        ("between elements, so no segments: nodes alone", inner.sum()),
        ("no edges of elements: nodes alone", dropped.sum() + (~found).sum()),
    ):
        if many:
            mesh.notes.append('lines of "%s" %s: %d' % (heading(group.name), what, many))
    return nodes, pairs[where[found & ~inner]]
