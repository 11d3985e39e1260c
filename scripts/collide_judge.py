"""What is wrong with a run of colliding bodies, from its tables and its mesh alone.

Histories are arrays (rows, points, 2). An outline is in order, the body on the left. Depths are
in units of the shorter of the edges at hand, at their lengths in the first row.
"""

import numpy as np

import collide_mesh as mesh

CHUNK = 400  # most rows that are treated at once


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def boxes(loop):
    """Bounding boxes in every row: (rows, 2) lowest, (rows, 2) highest."""
    return loop.min(axis=1), loop.max(axis=1)


def near_rows(one, two):
    """Rows in which the boxes meet, swept from the row before to the row after."""
    (low1, high1), (low2, high2) = boxes(one), boxes(two)
    for low, high in ((low1, high1), (low2, high2)):
        low[:-1], high[:-1] = np.minimum(low[:-1], low[1:]), np.maximum(high[:-1], high[1:])
    met = np.all((low1 <= high2) & (low2 <= high1), axis=1)
    met[1:] |= met[:-1].copy()
    return np.flatnonzero(met)


def edges_of(loop):
    """Starts and vectors of the edges."""
    return loop, np.roll(loop, -1, axis=-2) - loop


def inside(points, loop):
    """Whether points (rows, n, 2) lie in polygons (rows, m, 2), by the crossing number. Both
    edges at a corner have the same height of it, which a + d need not be."""
    a, d = edges_of(loop)
    x, y = points[:, :, None, 0], points[:, :, None, 1]
    ay, by = a[:, None, :, 1], np.roll(loop, -1, axis=-2)[:, None, :, 1]
    straddles = (ay > y) != (by > y)
    side = cross(d[:, None], np.stack([x - a[:, None, :, 0], y - ay], axis=-1))
    left = straddles & ((side > 0.0) == (by > ay))
    return np.count_nonzero(left, axis=-1) % 2 == 1


def shorter_at_nodes(loop):
    """The shorter of the two edges at each node, in the first row."""
    length = mesh.edge_lengths(loop[0])
    return np.minimum(length, np.roll(length, 1))


def inner_depths(one, two, within, shorter, lengths):
    """Depths of the nodes of `one` that are within `two`: (row, node, depth / edge)."""
    row, node = np.nonzero(within)
    a, d = edges_of(two[row])
    y = one[row, node][:, None] - a
    square = np.maximum((d * d).sum(-1), 1.0e-300)
    s = np.clip((y * d).sum(-1) / square, 0.0, 1.0)
    far = np.hypot(*np.moveaxis(y - s[..., None] * d, -1, 0))
    edge = far.argmin(axis=1)
    depth = far[np.arange(len(row)), edge] / np.minimum(shorter[node], lengths[edge])
    return row, node, depth


def edge_crossings(one, two, within1, within2):
    """Proper crossings of edges whose four ends are all outside: (row, edge, edge, depth)."""
    a, d = edges_of(one)
    b, e = edges_of(two)
    outside1 = ~(within1 | np.roll(within1, -1, axis=1))
    outside2 = ~(within2 | np.roll(within2, -1, axis=1))
    a, d, b, e = a[:, :, None], d[:, :, None], b[:, None], e[:, None]
    s1, s2 = cross(d, b - a), cross(d, b + e - a)
    t1, t2 = cross(e, a - b), cross(e, a + d - b)
    proper = (s1 * s2 < 0.0) & (t1 * t2 < 0.0)
    proper &= outside1[:, :, None] & outside2[:, None, :]
    # The distance of an end from the line of the other edge is sin(angle) x its distance from
    # the crossing.
    length1, length2 = np.hypot(d[..., 0], d[..., 1]), np.hypot(e[..., 0], e[..., 1])
    over1 = np.minimum(abs(s1), abs(s2)) / np.maximum(length1, 1.0e-300)
    over2 = np.minimum(abs(t1), abs(t2)) / np.maximum(length2, 1.0e-300)
    row, i, j = np.nonzero(proper)
    return row, i, j, np.minimum(over1, over2)[row, i, j]


def deepest_of(one, two):
    """Deepest true overlap of two outlines in any row: (depth / edge, row)."""
    rows = near_rows(one, two)
    deepest = (0.0, -1)
    length1, length2 = mesh.edge_lengths(one[0]), mesh.edge_lengths(two[0])
    shorter1, shorter2 = shorter_at_nodes(one), shorter_at_nodes(two)
    for first in range(0, len(rows), CHUNK):
        r = rows[first : first + CHUNK]
        a, b = one[r], two[r]
        in1, in2 = inside(a, b), inside(b, a)
        found = [inner_depths(a, b, in1, shorter1, length2)[::2]]
        found += [inner_depths(b, a, in2, shorter2, length1)[::2]]
        row, i, j, depth = edge_crossings(a, b, in1, in2)
        found.append((row, depth / np.minimum(length1[i], length2[j])))
        for row, depth in found:
            if len(depth) and depth.max() > deepest[0]:
                deepest = (float(depth.max()), int(r[row[depth.argmax()]]))
    return deepest


def passages(points, loop):
    """Passages of points through edges from row to row: (row, node, edge, +1 in or -1 out,
    place on the edge as a fraction, when within the step)."""
    a, d = edges_of(loop)
    y = points[:, :, None] - a[:, None]
    side = cross(d[:, None], y)
    along = (y * d[:, None]).sum(-1) / np.maximum((d * d).sum(-1), 1.0e-300)[:, None]
    changed = (side[:-1] > 0.0) != (side[1:] > 0.0)
    row, node, edge = np.nonzero(changed)
    s0, s1 = side[row, node, edge], side[row + 1, node, edge]
    f = s0 / (s0 - s1)
    place = (1.0 - f) * along[row, node, edge] + f * along[row + 1, node, edge]
    hit = (place >= 0.0) & (place <= 1.0)
    order = np.lexsort((f[hit], row[hit], node[hit]))
    way = np.where(s1 > 0.0, 1, -1)
    return tuple(x[hit][order] for x in (row, node, edge, way, place, f))


def through(points, loop):
    """Nodes that enter a body and leave it through its far side: [(row, node)]. Passing across
    a tip is left out: entry and exit are more than a tenth of the shortest edge apart. So is
    sliding round a tip: it was deeper than a hundredth of that edge in between."""
    rows = near_rows(points, loop)
    if len(rows) < 2:
        return []
    found = []
    for r in np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1):
        part, body = points[r], loop[r]
        a, d = edges_of(body[0])
        least = 0.1 * mesh.edge_lengths(loop[0]).min()
        entry = {}
        for row, node, edge, way, place, when in zip(*passages(part, body)):
            if way > 0:
                entry[node] = (row + when, edge, place)
            elif node in entry:
                start, e, p = entry.pop(node)
                gone = a[edge] + place * d[edge] - a[e] - p * d[e]
                opposite = d[e] @ d[edge] < 0.0
                deep = depth_between(part[:, node], body, start, row + when) > 0.1 * least
                if deep and opposite and np.hypot(*gone) > least:
                    found.append((int(r[row]) + 1, int(node)))
    return found


def depth_between(point, loop, start, end):
    """Largest distance of a point from an outline between two times, in rows: nine of them."""
    times = np.linspace(start, end, 11)[1:-1]
    row = np.minimum(times.astype(int), len(point) - 2)
    f = times - row
    point = (1.0 - f)[:, None] * point[row] + f[:, None] * point[row + 1]
    loop = (1.0 - f)[:, None, None] * loop[row] + f[:, None, None] * loop[row + 1]
    a, d = edges_of(loop)
    y = point[:, None] - a
    s = np.clip((y * d).sum(-1) / np.maximum((d * d).sum(-1), 1.0e-300), 0.0, 1.0)
    return np.hypot(*np.moveaxis(y - s[..., None] * d, -1, 0)).min(axis=1).max()


def below_wall(loop, wall):
    """Deepest node behind a rigid wall: (depth / edge, row)."""
    point, normal, _ = wall
    depth = -((loop - point) @ normal) / shorter_at_nodes(loop)
    row = int(depth.max(axis=1).argmax())
    return max(0.0, float(depth[row].max())), row


def relative_step(one, two):
    """Largest relative motion of nodes of two bodies in a step: (length)."""
    p, q = np.diff(one, axis=0), np.diff(two, axis=0)
    largest = 0.0
    for first in range(0, len(p), CHUNK):
        r = slice(first, first + CHUNK)
        far = p[r][:, :, None] - q[r][:, None]
        largest = max(largest, float((far * far).sum(-1).max()))
    return largest**0.5


def overlap(histories, loops, wall=None):
    """The geometry of a run. histories: places of all nodes of each body; loops: indices of
    the outlines. Returns overlap (depth / edge), row, pair, through ([(row, pair, node)]) and
    step (largest relative motion / shortest edge of the two)."""
    outlines = [h[:, loop] for h, loop in zip(histories, loops)]
    shortest = [mesh.edge_lengths(o[0]).min() for o in outlines]
    found = {"overlap": 0.0, "row": -1, "pair": None, "through": [], "step": 0.0}

    def deeper(depth, row, pair):
        if depth > found["overlap"]:
            found.update(overlap=depth, row=row, pair=pair)

    for i, one in enumerate(outlines):
        if wall:
            deeper(*below_wall(one, wall), (i, "wall"))
            still = np.zeros((len(one), 1, 2))
            moved = relative_step(histories[i], still) / shortest[i]
            found["step"] = max(found["step"], moved)
        for j in range(i + 1, len(outlines)):
            two = outlines[j]
            deeper(*deepest_of(one, two), (i, j))
            for x, y, pair in ((one, two, (i, j)), (two, one, (j, i))):
                found["through"] += [(r, pair, n) for r, n in through(x, y)]
            moved = relative_step(histories[i], histories[j]) / min(shortest[i], shortest[j])
            found["step"] = max(found["step"], moved)
    return found


def energy(glstat):
    """Largest excess of the energy over its sources, in units of the largest term."""
    sources = ("initial", "external", "motion", "unsolved")
    lost = ("kinetic", "internal", "friction", "contact", "algorithmic")
    largest = max(np.abs(glstat[name]).max() for name in sources + lost) or 1.0
    excess = glstat["total"] - sum(glstat[name] for name in sources)
    return float(excess.max() / largest)


def momentum(matsum, given):
    """Largest deviation of the change of momentum from the impulse `given` (rows, 2), in units
    of the largest momentum of a body."""
    parts = len(matsum.ids("part"))
    each = matsum.vectors("momx", "momy").reshape(-1, parts, 2)
    largest = np.hypot(each[..., 0], each[..., 1]).max() or 1.0
    total = each.sum(axis=1)
    return float(np.abs(total - total[0] - given[: len(total)]).max() / largest)


def shape(history):
    """Largest change of a distance between nodes of a rigid body, in units of its size, or of
    the farthest place, whose digits it has."""
    far = history - history[:, :1]
    length = np.hypot(far[..., 0], far[..., 1])
    scale = max(length[0].max(), np.abs(history).max())
    return float(np.abs(length - length[0]).max() / scale)


def balance(rcforc):
    """Largest sum of the forces on both sides of a contact, in units of the largest force."""
    forces = rcforc.vectors("fx", "fy", "ix", "iy")
    first, second = forces[rcforc["side"] == 1], forces[rcforc["side"] == 2]
    if first.shape != second.shape:
        return 0.0  # a contact of a body with itself may have one side
    largest = max(np.abs(forces[:, :2]).max(initial=0.0), 1.0e-300)
    return float(np.abs((first + second)[:, :2]).max(initial=0.0) / largest)
