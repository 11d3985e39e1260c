"""Decks of several bodies made from grids, and the true overlap of the bodies of a run: from the
polygons of its elements and the rows of nodout alone."""

from math import cos, sin

import numpy as np


def box(x, y, width, height, angle=0.0):
    """Map of the unit square to a box with its lower left corner at x, y, turned about it."""
    c, s = cos(angle), sin(angle)

    def place(a, b):
        p, q = a * width, b * height
        return x + c * p - s * q, y + s * p + c * q

    return place


def listed(numbers):
    """Lines of eight numbers."""
    numbers = [str(n) for n in numbers]
    return [",".join(numbers[k : k + 8]) + "," for k in range(0, len(numbers), 8)]


class Body:
    """Part of a scene: node numbers by grid place, its elements."""

    def __init__(self, part, at):
        self.part, self.at, self.rings = part, at, []

    def row(self, j):
        return [n for p, n in sorted(self.at.items()) if p[1] == j]

    def column(self, i):
        return [n for p, n in sorted(self.at.items()) if p[0] == i]

    def nodes(self):
        return sorted(self.at.values())


class Scene:
    """Bodies and cards that become a deck. Part k is also part set k; parts count from above
    `before`. mirror: x becomes -x."""

    def __init__(
        self, dt=1.0e-4, steps=200, theta=0.5, mirror=False, every=None, before=0, thickness=1.0
    ):
        self.before, self.thickness = before, thickness
        self.dt, self.steps, self.theta, self.mirror = dt, steps, theta, mirror
        self.every = every or dt
        self.place, self.bodies, self.cards, self.head, self.sets = [], [], [], [], 100
        self.scheme = "THETA,%r," % theta
        self.velocities, self.tables = {}, ["GLSTAT", "MATSUM", "NODOUT"]
        self.materials = []

    def node(self, x, y):
        self.place.append((-x if self.mirror else x, y))
        return len(self.place)

    def glued(self, other, x, y):
        """The node of the other body at a place, or a new one."""
        for n in other.nodes() if other else ():
            if max(abs(self.place[n - 1][0] - x), abs(self.place[n - 1][1] - y)) < 1.0e-9:
                return n
        return self.node(x, y)

    def body(self, nx, ny, shape, velocity=None, keep=None, ring=None, glue=None, **material):
        """A part from nx by ny cells; shape maps the unit square to the plane, keep(i, j) tells
        which cells there are; ring: nodes of a single element in their place; glue: a body whose
        nodes are taken where they are in the same place."""
        body = Body(self.before + len(self.bodies) + 1, {})
        if ring:
            body.at = {(k, 0): self.node(*p) for k, p in enumerate(ring)}
            cells = [[body.at[k, 0] for k in range(len(ring))]]
        else:
            cells = []
            for i in range(nx):
                for j in range(ny):
                    if keep and not keep(i, j):
                        continue
                    corners = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
                    for p in corners:
                        if p not in body.at:
                            body.at[p] = self.glued(glue, *shape(p[0] / nx, p[1] / ny))
                    cells.append([body.at[p] for p in corners])
        assert not (glue and self.mirror)
        body.rings = [cell[::-1] if self.mirror else cell for cell in cells]
        self.bodies.append(body)
        self.materials.append(
            [material.get(k, d) for k, d in (("density", 1.0e-3), ("young", 1.0e3), ("poisson", 0.3))]
        )
        if velocity:
            self.kick(body.nodes(), *velocity)
        return body

    def kick(self, nodes, vx, vy):
        for n in nodes:
            self.velocities[n] = (-vx if self.mirror else vx, vy)

    def node_set(self, nodes):
        self.sets += 1
        self.cards += ["*SET_NODE_LIST", "%d," % self.sets] + listed(nodes)
        return self.sets

    def segment_set(self, nodes):
        """Segments along a row of nodes."""
        self.sets += 1
        self.cards += ["*SET_SEGMENT", "%d," % self.sets]
        self.cards += ["%d,%d" % pair for pair in zip(nodes, nodes[1:])]
        return self.sets

    def hold(self, nodes, x=1, y=1):
        self.cards += ["*BOUNDARY_SPC_SET", "%d,,%d,%d" % (self.node_set(nodes), x, y)]

    def curve(self, number, points):
        self.cards += ["*DEFINE_CURVE", "%d," % number] + ["%r,%r" % p for p in points]

    def gravity(self, strength):
        self.curve(90, [(0.0, strength), (1.0e3, strength)])
        self.cards += ["*LOAD_BODY_Y", "90,1.0"]

    def contact(self, a, b="", mu=0.0, kind="SURFACE_TO_SURFACE", birth=None, pair=None):
        """Sides by number of part set, negative for a node set; pair: fields of *BIPACT_PAIR."""
        self.cards += ["*CONTACT_2D_AUTOMATIC_" + kind, "%s,%s,,,%r" % (a, b, mu)]
        if birth is not None:
            self.cards += ["%r," % birth]
        if pair:
            count = sum(c.startswith("*CONTACT_2D") for c in self.cards)
            self.cards += ["*BIPACT_PAIR", "%d,%s" % (count, pair)]
        if "RCFORC" not in self.tables:
            self.tables += ["RCFORC", "SLEOUT"]

    def wall(self, nodes, point, ahead, mu=0.0):
        self.cards += ["*RIGIDWALL_PLANAR", "%d," % self.node_set(nodes)]
        self.cards += ["%r,%r,0.0,%r,%r,0.0,%r" % (*point, *ahead, mu)]
        if "RWFORC" not in self.tables:
            self.tables += ["RWFORC"]

    def text(self):
        """The deck, coordinates with all their digits; tables of every step unless every."""
        out = ["*KEYWORD", "*TITLE", "bodies", "*CONTROL_TERMINATION"]
        out += ["%r," % (self.dt * self.steps), "*CONTROL_IMPLICIT_GENERAL", "1,%r" % self.dt]
        out += ["*CONTROL_IMPLICIT_DYNAMICS", "1,", "*BIPACT_TIME", self.scheme]
        out += ["*NODE"] + ["%d,%r,%r" % (k, *p) for k, p in enumerate(self.place, 1)]
        out += ["*ELEMENT_SHELL"]
        element = 0
        for body in self.bodies:
            for ring in body.rings:
                element += 1
                four = ring if len(ring) == 4 else ring + ring[-1:]
                out += ["%d,%d,%d,%d,%d,%d" % (element, body.part, *four)]
        out += ["*SECTION_SHELL", "1,13,,4", "%r," % self.thickness]
        for body, material in zip(self.bodies, self.materials):
            out += ["*PART", "part", "%d,1,%d" % (body.part, body.part)]
            out += ["*MAT_ELASTIC", "%d,%r,%r,%r" % (body.part, *material)]
            out += ["*SET_PART_LIST", "%d," % body.part, "%d," % body.part]
        if self.velocities:
            out += ["*INITIAL_VELOCITY_NODE"]
            out += ["%d,%r,%r" % (n, *v) for n, v in sorted(self.velocities.items())]
        out += self.cards
        for name in self.tables:
            out += ["*DATABASE_" + name, "%r," % self.every]
        out += ["*DATABASE_HISTORY_NODE"] + listed(range(1, len(self.place) + 1))
        return "\n".join(out + ["*END", ""])

    def positions(self, nodout):
        """Positions (times, nodes, 2) of a run: reference and displacement, unrounded."""
        u = nodout.vectors("ux", "uy").reshape(-1, len(self.place), 2)
        assert (nodout["node"][: len(self.place)] == np.arange(1, len(self.place) + 1)).all()
        return np.array(self.place) + u


def boundary(rings):
    """Directed edges (m, 2) that one element has alone, body on the left; nodes from 0."""
    edges = {(r[k] - 1, r[(k + 1) % len(r)] - 1) for r in rings for k in range(len(r))}
    return np.array(sorted(e for e in edges if e[::-1] not in edges))


def overlaps(x, rings_a, rings_b):
    """True overlap of two polygons at positions x (times, nodes, 2): for every time the depth of
    the deepest node inside the other, or of edges that cross where no node is inside [L], and
    the same over the shorter edge at hand."""
    depth, share = np.zeros(len(x)), np.zeros(len(x))
    edges = boundary(rings_a), boundary(rings_b)
    for t in range(len(x)):
        found = []
        for one, two in (edges, edges[::-1]):
            found += [deepest_node(x[t], one, two)]
        if max(d for d, _ in found) == 0.0:
            found += [deepest_crossing(x[t], *edges)]
        depth[t], share[t] = max(d for d, _ in found), max(s for _, s in found)
    return depth, share


def lengths(x, edges):
    return np.hypot(*(x[edges[:, 1]] - x[edges[:, 0]]).T)


def deepest_node(x, own, other):
    """The deepest node of one boundary inside the other: (depth, depth / shorter edge)."""
    nodes = np.unique(own)
    a, b = x[other[:, 0]], x[other[:, 1]]
    p = x[nodes]
    inside = np.all((p > np.minimum(a, b).min(axis=0)) & (p < np.maximum(a, b).max(axis=0)), axis=1)
    nodes, p = nodes[inside], p[inside][:, None, :]
    if not len(nodes):
        return 0.0, 0.0
    upward = (a[:, 1] > p[..., 1]) != (b[:, 1] > p[..., 1])
    rise = np.where(b[:, 1] == a[:, 1], 1.0, b[:, 1] - a[:, 1])
    at = a[:, 0] + (p[..., 1] - a[:, 1]) * (b[:, 0] - a[:, 0]) / rise
    within = (upward & (p[..., 0] < at)).sum(axis=1) % 2 == 1
    d = b - a
    s = np.clip(np.sum((p - a) * d, axis=2) / np.sum(d * d, axis=1), 0.0, 1.0)
    distance = np.hypot(*np.moveaxis(p - a - s[..., None] * d, 2, 0))
    nearest = distance.argmin(axis=1)
    depth = np.where(within, distance.min(axis=1), 0.0)
    own_length, other_length = lengths(x, own), lengths(x, other)
    shorter = [own_length[(own == n).any(axis=1)].min() for n in nodes]
    unit = np.minimum(shorter, other_length[nearest])
    return depth.max(), (depth / unit).max()


def deepest_crossing(x, first, second):
    """The deepest proper crossing of edges: sine of the angle times the nearer end."""
    p, q = x[first[:, 1]] - x[first[:, 0]], x[second[:, 1]] - x[second[:, 0]]
    r = x[second[:, 0]][None] - x[first[:, 0]][:, None]
    turn = p[:, None, 0] * q[None, :, 1] - p[:, None, 1] * q[None, :, 0]
    size = np.hypot(*p.T)[:, None], np.hypot(*q.T)[None, :]
    steep = np.abs(turn) > 1.0e-9 * size[0] * size[1]
    safe = np.where(steep, turn, 1.0)
    s = (r[..., 0] * q[None, :, 1] - r[..., 1] * q[None, :, 0]) / safe
    t = (r[..., 0] * p[:, None, 1] - r[..., 1] * p[:, None, 0]) / safe
    hit = steep & (np.minimum(s, 1 - s) > 0) & (np.minimum(t, 1 - t) > 0)
    end = np.minimum(np.minimum(s, 1 - s) * size[0], np.minimum(t, 1 - t) * size[1])
    depth = np.where(hit, np.abs(turn) / (size[0] * size[1]) * end, 0.0)
    return depth.max(), (depth / np.minimum(*size)).max()
