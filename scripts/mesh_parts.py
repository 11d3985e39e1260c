"""Parts and sets of a deck from the groups of a tidy mesh (mesh_data.py).

A group of elements is a part; where groups share elements, their pieces are the parts. Each
group of elements is also the part set of its pieces. A group of their sides (lines in the plane,
surfaces in space) is the segment set of those that are exposed, and a node set; a group of points,
in space of lines, is a node set."""

from types import SimpleNamespace

import numpy as np

from cards import heading
from mesh_data import Ids, same_members, widened
from mesh_shapes import KINDS, LINEAR, SHAPES, TEN_NODES, TWENTY_SEVEN, all_of_side

LONGEST = 70  # columns of a heading
FORMS = {LINEAR: "linear", TEN_NODES: "10 nodes", TWENTY_SEVEN: "27 nodes"}
SIDES = {2: ("lines", "edges"), 3: ("surfaces", "faces")}


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
    """What the deck gets: parts (id, title, section, rows of elements), part_sets (id, title,
    ids of parts), node_sets (id, title, rows of nodes), segment_sets (id, title, rows of such
    rows)."""
    parts = make_parts(mesh)
    node_sets, segment_sets = make_side_and_node_sets(mesh)
    return SimpleNamespace(
        parts=in_order(parts),
        part_sets=in_order(make_part_sets(mesh, parts)),
        node_sets=in_order(node_sets),
        segment_sets=in_order(segment_sets),
    )


def in_order(sets):
    return sorted(sets, key=lambda s: s.id)


def sections_of(mesh):
    """The section that each element needs: linear solids have one, as plane elements have."""
    section = [SHAPES[kind].section if mesh.dim == 3 else LINEAR for kind in KINDS]
    return np.array(section)[mesh.elements.kind]


def pieces(mesh, groups):
    """Rows of elements that are in the same groups, or in none and of the same region."""
    label = 1 + mesh.elements.region
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
    groups = mesh.members(mesh.dim)
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
        part = SimpleNamespace(rows=rows, owners=owners, group=group, name=name)
        parts += by_section(mesh, part)
    parts.sort(key=lambda p: (p.group is None, p.rows[0]))
    ids, titles = Ids(groups), Titles(mesh)
    for p in parts:
        p.id, p.title = ids.take(p.group.number if p.group else 0), titles.take(p.name)
    return parts


def by_section(mesh, part):
    """A part, or parts of it where its solids need different sections."""
    section = sections_of(mesh)[part.rows]
    found = np.unique(section).tolist()
    if len(found) == 1:
        part.section = found[0]
        return [part]
    mesh.notes.append('"%s" is parts of linear and of quadratic solids' % heading(part.name))
    return [
        SimpleNamespace(
            rows=part.rows[section == s],
            owners=part.owners,
            group=None,
            name="%s, %s" % (part.name, FORMS[s]),
            section=s,
        )
        for s in found
    ]


def name_of_piece(mesh, owners, rows):
    """A name for elements that no group has for itself."""
    names = [g.name for g in sorted(owners, key=lambda g: len(g.members))]
    if len(names) == 1:
        return "rest of " + names[0]
    elements = mesh.elements
    return " & ".join(names) or elements.region_name[elements.region[rows[0]]]


def make_part_sets(mesh, parts):
    """A part set for each group of elements, of the id of its part where it is one."""
    groups = mesh.members(mesh.dim)
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


def sides_of(mesh):
    """Sides of all elements, each as often as elements have it: corners (n, 2 or 4), of which a
    triangle repeats its last, in the order of the element (body on the left of an edge, outward
    face), and all nodes, of which the last is repeated."""
    corners, nodes = [], []
    for kind, _, rows in mesh.elements.each_kind():
        for side in SHAPES[kind].sides:
            corners.append(widened(rows[:, side], 2 if mesh.dim == 2 else 4))
            nodes.append(widened(rows[:, all_of_side(kind, side)], 9))
    return np.concatenate(corners), np.concatenate(nodes)


def make_side_and_node_sets(mesh):
    """Segment sets and node sets of sides, then node sets of what has fewer dimensions."""
    sides = mesh.members(mesh.dim - 1)
    others = [g for dim in range(mesh.dim - 2, -1, -1) for g in mesh.members(dim)]
    node_sets, segment_sets = [], []
    ids, titles, segment_titles = Ids(sides + others), Titles(mesh), Titles(mesh)
    known = sides_of(mesh) if sides else None
    for g in sides + others:
        is_side = g.dim == mesh.dim - 1
        nodes, segments = of_sides(mesh, g, known) if is_side else (nodes_of(mesh, g), ())
        if not len(nodes):
            what = SIDES[g.dim + 1][0] if g.dim else "points"
            mesh.notes.append(
                '"%s" left out: its %s are on no element' % (heading(g.name), what)
            )
            continue
        number = ids.take(g.number)
        node_sets.append(SimpleNamespace(id=number, title=titles.take(g.name), members=nodes))
        if len(segments):
            title = segment_titles.take(g.name)
            segment_sets.append(SimpleNamespace(id=number, title=title, members=segments))
    return node_sets, segment_sets


def nodes_of(mesh, group):
    """Rows of the nodes of a group of points or lines that are on elements."""
    if group.dim == 0:
        return group.members
    nodes = np.unique(mesh.cells[group.dim].nodes[group.members])
    return nodes[nodes >= 0]


def corners_of(cells, rows, width):
    """The corners of cells, the last repeated."""
    count = np.array([SHAPES[kind].corners for kind in KINDS])[cells.kind[rows]]
    column = np.minimum(np.arange(width), count[:, None] - 1)
    return np.take_along_axis(cells.nodes[rows], column, axis=1)


def of_sides(mesh, group, known):
    """Rows of the nodes of a group of sides, and its exposed sides; the others are noted."""
    corners, all_nodes = known
    mine = corners_of(mesh.sides, group.members, corners.shape[1])
    label = same_members(np.concatenate([corners, mine]))
    of_elements, of_group = label[: len(corners)], label[len(corners) :]
    dropped = (mine < 0).any(axis=1)
    wanted, first = np.unique(of_group[~dropped], return_index=True)
    wanted = wanted[np.argsort(first)]  # in the order of the file, each once
    at = np.full(label.max(initial=0) + 1, -1)
    at[of_elements[::-1]] = np.arange(len(corners))[::-1]  # the first that has this label
    at = at[wanted]
    count = np.bincount(of_elements, minlength=len(label) + 1)[wanted]
    sides, ends = SIDES[mesh.dim]
    for what, many in (
        ("between elements, so no segments: nodes alone", (count > 1).sum()),
        ("no %s of elements: nodes alone" % ends, dropped.sum() + (count == 0).sum()),
    ):
        if many:
            text = '%s of "%s" %s: %d' % (sides, heading(group.name), what, many)
            mesh.notes.append(text)
    nodes = np.concatenate([nodes_of(mesh, group), all_nodes[at[count > 0]].ravel()])
    return np.unique(nodes), corners[at[count == 1]]
