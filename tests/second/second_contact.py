"""Contact rows of the plane: which node against which edge or vertex, with which normal.

Angles are in radians. A body is on the left of its edges; normals point out of it. All lengths
that decide (sizes, depths, allowances) are those of the reference, all places and normals those
of the positions given, with FRAME REF the normals of the reference."""

import numpy as np

DEGREE = np.pi / 180
END = 1e-8  # projection beyond the ends, of the edge's length
DEPTH = 0.3  # deepest overlap that an edge sees, of its length
CORNER = 20 * DEGREE
SMOOTH = 15 * DEGREE
APART = np.cos(15 * DEGREE)
FACING = 30 * DEGREE
FLAT = np.cos(3 * DEGREE)
NARROW = 3 * DEGREE
EMPTY = 10 * DEGREE
TWIN = 0.1
ALLOWANCE, ALLOWANCE_CORNER = 1e-3, 2e-4
TIE = 1e-6
# A node beside a convex corner, by more than this part of the shorter edge before and after the
# free motion, has no row with it; infinite: the rule has no such limit, and the reach decides.
BESIDE = 0.1


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def wrap(angle):
    """Returns the angle in (-pi, pi]."""
    return np.pi - (np.pi - angle) % (2 * np.pi)


def direction(angle):
    return np.array([np.cos(angle), np.sin(angle)])


class Boundary:
    """Edges of all bodies: which edge ends at a node and which starts there, reference lengths."""

    def __init__(self, body):
        self.edges = np.array(body.edges)
        self.into = np.full(body.n, -1)
        self.out = np.full(body.n, -1)
        self.into[self.edges[:, 1]] = np.arange(len(self.edges))
        self.out[self.edges[:, 0]] = np.arange(len(self.edges))
        self.closed = (self.into >= 0) & (self.out >= 0)
        self.x = body.x
        span = body.x[self.edges[:, 1]] - body.x[self.edges[:, 0]]
        self.length = np.hypot(span[:, 0], span[:, 1])
        self.normal = np.stack([span[:, 1], -span[:, 0]], axis=1) / self.length[:, None]
        self.turn = self.turns(self.normal)

    def turns(self, normal):
        """Returns the turn at each node, 0 where the boundary is not closed."""
        turn = np.zeros(len(self.into))
        k = self.closed
        first, second = normal[self.into[k]], normal[self.out[k]]
        turn[k] = np.arctan2(cross(first, second), np.sum(first * second, axis=1))
        return turn


class Shape:
    """The boundary at given positions."""

    def __init__(self, boundary, x, frame):
        self.boundary, self.x = boundary, x
        a, b = boundary.edges.T
        if frame == "REF":
            self.normal = boundary.normal
        else:
            span = x[b] - x[a]
            size = np.hypot(span[:, 0], span[:, 1])
            self.normal = np.stack([span[:, 1], -span[:, 0]], axis=1) / size[:, None]
            same = np.max(np.abs(self.normal - boundary.normal), axis=1) < 1e-12
            self.normal[same] = boundary.normal[same]
        self.tangent = np.stack([-self.normal[:, 1], self.normal[:, 0]], axis=1)
        self.span = np.sum((x[b] - x[a]) * self.tangent, axis=1)
        self.turn = boundary.turns(self.normal)
        self.middle = np.zeros(len(x))
        self.half = np.full(len(x), np.pi)
        k = boundary.closed
        first = self.normal[boundary.into[k]]
        start = np.arctan2(first[:, 1], first[:, 0])
        self.middle[k] = start + self.turn[k] / 2
        self.half[k] = np.where(self.turn[k] > SMOOTH, self.turn[k] / 2, 0.0)

    def mean_normal(self, k):
        n = self.normal[self.boundary.into[k]] + self.normal[self.boundary.out[k]]
        return n / np.hypot(*n)


class Side:
    """The listed nodes and edges of one side of a pair."""

    def __init__(self, boundary, nodes, edges, first):
        self.nodes = np.array(sorted(nodes), dtype=int)
        self.edges = np.array(sorted(edges), dtype=int)
        self.first = first  # SURFA wins ties
        mine = set(self.edges.tolist())
        self.closed = all(
            boundary.closed[k] and boundary.into[k] in mine and boundary.out[k] in mine
            for k in boundary.edges[self.edges].ravel()
        )
        self.vertices = np.array(
            [k for k in self.nodes
             if boundary.closed[k] and boundary.into[k] in mine and boundary.out[k] in mine],
            dtype=int,
        )


class Row:
    """A node against a place of the other side."""

    def __init__(self, node, edge, vertex, places, normal, gap, length):
        self.node, self.edge, self.vertex = node, edge, vertex
        self.places, self.normal, self.gap, self.length = places, normal, gap, length
        self.exact, self.delta, self.size = True, 0.0, 0.0
        self.group = None  # (pair, direction)
        self.mu, self.card, self.nudge = 0.0, None, 0.0

    def place(self, x):
        return sum(weight * x[k] for k, weight in self.places)

    def relative(self, x):
        return x[self.node] - self.place(x)

    def relative_motion(self, du):
        """Returns the motion of the node relative to the place."""
        return du[self.node] - sum(weight * du[k] for k, weight in self.places)

    def key(self):
        return self.node, self.edge if self.vertex is None else -1 - self.vertex


def edge_row(shape, node, edge, s):
    """Returns the row of a node against an edge; at its ends the vertex alone counts."""
    a, b = shape.boundary.edges[edge]
    s = min(max(s, 0.0), 1.0)
    places = [(a, 1.0)] if s == 0.0 else [(b, 1.0)] if s == 1.0 else [(a, 1.0 - s), (b, s)]
    row = Row(node, edge, None, places, shape.normal[edge], 0.0, shape.boundary.length[edge])
    row.gap = row.normal @ row.relative(shape.x)
    return row


def vertex_row(shape, node, k, normal):
    """Returns the row of a node against a vertex."""
    b = shape.boundary
    length = min(b.length[b.into[k]], b.length[b.out[k]])
    row = Row(node, b.into[k], k, [(k, 1.0)], normal, 0.0, length)
    row.gap = normal @ row.relative(shape.x)
    return row


def choose_normal(shape, node, k, motion, delta, length):
    """Returns the normal of node against the convex corner k and the width of the cone."""
    d = wrap(shape.middle[node] + np.pi - shape.middle[k])
    low = max(-shape.half[k], d - shape.half[node])
    high = min(shape.half[k], d + shape.half[node])
    width = high - low
    middle = direction(shape.middle[k] + (low + high) / 2)
    if width < -EMPTY:
        return None, width
    if width < 1e-9:
        return middle, width
    ends = [direction(shape.middle[k] + low), direction(shape.middle[k] + high)]
    y = shape.x[node] - shape.x[k]
    f = motion[node] - motion[k]
    gap = [n @ y for n in ends]
    left = [n @ (y + f) for n in ends]
    tie = 1e-9 * length
    if abs(left[0] - left[1]) <= tie and abs(gap[0] - gap[1]) <= tie:
        return middle, width
    stays = [value >= -delta for value in left]
    if all(stays):
        if abs(left[0] - left[1]) <= tie:
            return middle, width
        return ends[int(left[1] > left[0])], width
    if any(stays):
        return ends[int(stays[1])], width
    times = [g / (g - h) if g > h else np.inf for g, h in zip(gap, left)]
    if times == [np.inf, np.inf]:
        return ends[int(left[1] > left[0])], width
    if max(times) < np.inf and abs(times[0] - times[1]) * np.hypot(*f) <= tie:
        return middle, width
    return ends[int(times[1] > times[0])], width


class Finder:
    """Rows of one direction (nodes of `own` against the edges of `other`)."""

    def __init__(self, boundary, own, other, same):
        self.boundary, self.own, self.other, self.same = boundary, own, other, same
        self.side_rule = "AUTO"
        if same:
            near = {}
            for i in own.nodes:
                mine = [e for e in (boundary.into[i], boundary.out[i]) if e >= 0]
                near[i] = {int(k) for e in mine for k in boundary.edges[e]}
            self.near = near

    def rows(self, shape, motion, reach):
        """Returns the rows of section 2, steps 1 to 4."""
        b = self.boundary
        nodes, edges, vertices = self.own.nodes, self.other.edges, self.other.vertices
        watched = ~(shape.turn[nodes] < -CORNER)
        y = shape.x[nodes][:, None, :] - shape.x[b.edges[edges, 0]][None, :, :]
        s = np.sum(y * shape.tangent[edges], axis=2) / shape.span[edges]
        g = np.sum(y * shape.normal[edges], axis=2)
        ahead = np.arctan2(-shape.normal[edges, 1], -shape.normal[edges, 0])
        off = np.abs(wrap(ahead[None, :] - shape.middle[nodes][:, None]))
        faces = off - shape.half[nodes][:, None] <= FACING
        close = (g > -DEPTH * b.length[edges]) & (g <= reach) & faces & watched[:, None]
        inside = close & (s >= -END) & (s <= 1 + END)
        away = shape.x[nodes][:, None, :] - shape.x[vertices][None, :, :]
        near = (np.sum(away**2, axis=2) <= reach**2) & watched[:, None]
        column = {int(e): j for j, e in enumerate(edges)}
        if len(vertices):
            first = [column[b.into[k]] for k in vertices]
            second = [column[b.out[k]] for k in vertices]
            near |= inside[:, first] & inside[:, second]
        result = []
        for p in np.nonzero(np.any(inside, axis=1) | np.any(near, axis=1))[0]:
            i = nodes[p]
            barred = self.near[i] if self.same else ()
            listed = {}
            for j in np.nonzero(inside[p])[0]:
                e = int(edges[j])
                if not (self.same and set(map(int, b.edges[e])) & barred):
                    listed[e] = edge_row(shape, i, e, s[p, j])
            extra = []
            for j in np.nonzero(near[p])[0]:
                k = int(vertices[j])
                ends = set(map(int, b.edges[b.into[k]])) | set(map(int, b.edges[b.out[k]]))
                if not (self.same and ends & set(barred)):
                    at = column[b.into[k]], column[b.out[k]]
                    self.at_vertex(shape, i, k, s[p, at], close[p, at], motion, reach, listed, extra)
            result += self.merged(shape, list(listed.values()) + extra)
        for row in result:
            self.grade(shape, row)
        return [row for row in result if row.gap >= -row.delta or self.is_inside(shape, row.node)]

    def is_inside(self, shape, i):
        """Tells whether node i is behind the nearest point of a closed boundary; True: open."""
        b, other = self.boundary, self.other
        barred = self.near[i] if self.same else set()
        edges = [e for e in other.edges if not set(map(int, b.edges[e])) & barred]
        if not other.closed or not edges:
            return True
        first, second = shape.x[b.edges[edges, 0]], shape.x[b.edges[edges, 1]]
        span, y = second - first, shape.x[i] - first
        s = np.clip(np.sum(span * y, axis=1) / np.sum(span**2, axis=1), 0.0, 1.0)
        away = y - s[:, None] * span
        j = int(np.argmin(np.sum(away**2, axis=1)))
        if 0.0 < s[j] < 1.0:
            return bool(cross(span[j], y[j]) > 0.0)
        k = b.edges[edges[j], int(s[j])]
        y = shape.x[i] - shape.x[k]
        g = shape.normal[b.into[k]] @ y, shape.normal[b.out[k]] @ y
        if abs(np.sin(shape.turn[k])) < 1e-3:
            return bool(sum(g) < 0.0)
        return bool((max(g) if shape.turn[k] > 0.0 else min(g)) < 0.0)

    def at_vertex(self, shape, i, k, s, close, motion, reach, listed, extra):
        """Adds and removes rows of node i at the vertex k (step 2)."""
        b = self.boundary
        first, second = int(b.into[k]), int(b.out[k])
        y = shape.x[i] - shape.x[k]
        lengths = b.length[first], b.length[second]
        length = min(lengths)
        strip = s[0] <= 1 + END, s[1] >= -END
        turn = shape.turn[k]
        if turn < -SMOOTH:
            if not all(strip):
                for e, place, allowed in ((first, 1.0, close[0]), (second, 0.0, close[1])):
                    if e not in listed and allowed:
                        listed[e] = edge_row(shape, i, e, s[0] if e == first else s[1])
            return
        if turn <= SMOOTH:
            if not any(strip):
                n = shape.mean_normal(k)
                off = abs(wrap(np.arctan2(-n[1], -n[0]) - shape.middle[i]))
                if off - shape.half[i] <= FACING and -DEPTH * length < n @ y <= reach:
                    extra.append(vertex_row(shape, i, k, n))
            return
        delta = self.delta(i, self.size(shape, i, shape.mean_normal(k)), length)
        n, width = choose_normal(shape, i, k, motion, delta, length)
        good = n is not None and -DEPTH * length < n @ y <= reach
        if all(strip):
            if first in listed and second in listed:
                g = listed[first].gap, listed[second].gap
                if abs(g[0] - g[1]) <= 1e-7 * length and good:
                    del listed[first], listed[second]
                    extra.append(vertex_row(shape, i, k, n))
                else:
                    del listed[first if g[0] < g[1] else second]
        elif not any(strip):
            if good and not self.passes_beside(shape, i, k, motion, length):
                extra.append(vertex_row(shape, i, k, n))
        else:
            e = first if strip[0] else second
            distance = (1 - s[0]) * lengths[0] if strip[0] else s[1] * lengths[1]
            size = self.size(shape, i, shape.normal[e])
            near_end = distance <= self.delta(i, size, length)
            # A narrow cone keeps the edge if it makes a row: two faces on each other.
            if near_end and good and (width >= NARROW or e not in listed):
                if not self.passes_beside(shape, i, k, motion, length):
                    listed.pop(e, None)
                    extra.append(vertex_row(shape, i, k, n))

    def passes_beside(self, shape, i, k, motion, length):
        """Tells whether node i stays clear of corner k along a flank that its row leaves out."""
        size = BESIDE * min(length, self.size(shape, i, shape.mean_normal(k)))
        y, f = shape.x[i] - shape.x[k], motion[i] - motion[k]
        for end in (-1, 1):
            angle = shape.middle[k] + end * shape.half[k]
            flank = direction(angle)
            own = abs(wrap(angle - shape.middle[i] - np.pi)) <= shape.half[i] + 1e-9
            if not own and min(flank @ y, flank @ (y + f)) > size:
                return True
        return False

    def merged(self, shape, rows):
        """Keeps one row of those whose normals are close (step 3)."""
        b = self.boundary
        rows.sort(key=lambda row: (abs(row.gap), row.key()))
        kept = []
        for row in rows:
            for place, old in enumerate(kept):
                if row.normal @ old.normal <= APART:
                    continue
                tied = abs(abs(row.gap) - abs(old.gap)) <= 1e-9 * min(row.length, old.length)
                if tied and row.vertex is None and old.vertex is None:
                    shared = set(map(int, b.edges[row.edge])) & set(map(int, b.edges[old.edge]))
                    if len(shared) == 1:
                        k = shared.pop()
                        kept[place] = vertex_row(shape, row.node, k, shape.mean_normal(k))
                break
            else:
                kept.append(row)
        kept.sort(key=Row.key)
        return kept

    def own_edges(self, i):
        b = self.boundary
        return [e for e in (b.into[i], b.out[i]) if e >= 0]

    def size(self, shape, i, n):
        """Returns the mean length of the node's edges that face the normal."""
        own = self.own_edges(i)
        facing = [e for e in own if shape.normal[e] @ n < -0.7] or own
        return np.mean(self.boundary.length[facing]) if own else np.inf

    def delta(self, i, size, length):
        share = ALLOWANCE_CORNER if self.boundary.turn[i] > CORNER else ALLOWANCE
        return share * min(size, length)

    def grade(self, shape, row):
        """Decides between an exact row and an allowance (step 4)."""
        i, b = row.node, self.boundary
        row.size = self.size(shape, i, row.normal)
        row.delta = self.delta(i, row.size, row.length)
        own = self.own_edges(i)
        rule = self.side_rule
        if rule == "BOTH" or not own:
            row.exact = True
            return
        if rule in ("A", "B"):
            row.exact = self.own.first == (rule == "A")
        elif abs(row.size - row.length) <= TIE * row.length:
            row.exact = self.own.first
        else:
            row.exact = bool(row.size < row.length)
        if b.turn[i] > CORNER and not row.exact:
            flat = row.vertex is None and any(
                -shape.normal[e] @ row.normal >= FLAT and row.length <= b.length[e] * (1 + TIE)
                for e in own
            )
            row.exact = not flat


class Pair:
    """Two sides of a card, each of whose nodes are watched against the other's edges."""

    def __init__(self, boundary, card, first, second, side_rule):
        self.boundary, self.card = boundary, card
        self.sides = first, second
        same = first is second
        self.finders = [Finder(boundary, first, second, same)]
        if not same:
            self.finders.append(Finder(boundary, second, first, False))
        for finder in self.finders:
            finder.side_rule = side_rule
        self.nodes = np.union1d(first.nodes, second.nodes)
        edges = np.union1d(first.edges, second.edges)
        self.shortest = boundary.length[edges].min()

    def reach(self, motion):
        """Returns how far a row may be: a quarter edge and twice the relative free motion."""
        mean = motion[self.nodes].mean(axis=0)
        far = [np.max(np.hypot(*(motion[s.nodes] - mean).T)) for s in self.sides]
        return self.shortest / 4 + 2 * sum(far)

    def rows(self, shape, motion, reach):
        """Returns the rows of both directions, twins settled."""
        found = [finder.rows(shape, motion, reach) for finder in self.finders]
        self.settle_twins(shape, found)
        for d, rows in enumerate(found):
            for row in rows:
                row.group = (self, d)
                row.mu, row.card = self.card.mu, self.card
        return [row for rows in found for row in rows]

    def settle_twins(self, shape, found):
        """One of two rows that see each other's nodes becomes an allowance (step 5)."""
        ahead = found[0]
        back = found[1] if len(found) == 2 else found[0] if self.finders[0].same else []
        by_node = {}
        for row in back:
            by_node.setdefault(row.node, []).append(row)
        order = {id(row): place for place, row in enumerate(ahead)}
        met = [
            (one, two) for one in ahead for k in sorted({int(k) for k, _ in one.places})
            for two in by_node.get(k, ()) if self.twins(one, two)
            and not (ahead is back and order[id(two)] < order[id(one)])
        ]
        # Of several rows of a node that meet one row the most opposite is its twin.
        for one, two in met:
            rivals = [(p, q) for p, q in met if (p is one) != (q is two)]
            rivals = [(p, q) for p, q in rivals if p.node == one.node and q.node == two.node]
            if all(one.normal @ two.normal <= p.normal @ q.normal for p, q in rivals):
                self.settle(shape, one, two)

    def off(self, row, k):
        """Returns how far along its edge the place of a row is from node k."""
        return (1.0 - dict(row.places).get(k, -np.inf)) * self.boundary.length[row.edge]

    def twins(self, one, two):
        near = TWIN * min(one.length, two.length)
        far = max(self.off(one, two.node), self.off(two, one.node))
        return far <= near and one.normal @ two.normal < -APART

    def settle(self, shape, one, two):
        """`one` belongs to SURFA."""
        turn = self.boundary.turn
        difference = turn[one.node] - turn[two.node]
        stays, goes = one, two
        smooth = max(turn[one.node], turn[two.node]) <= CORNER
        rule = self.finders[0].side_rule
        if smooth and rule in ("A", "B") and not self.finders[0].same:
            # The deck says who meets whom: its normal is the obstacle's.
            stays, goes = (one, two) if rule == "A" else (two, one)
            stays.exact, goes.exact = stays.exact or goes.exact, False
            return
        if abs(difference) > DEGREE:
            if difference < 0:
                stays, goes = two, one
        elif abs(one.size - two.size) > TIE * max(one.size, two.size):
            if two.size < one.size:
                stays, goes = two, one
        elif self.finders[0].same:
            # Within one part the place that is nearer to the other node.
            off = self.off(one, two.node), self.off(two, one.node)
            if off[1] < off[0] - TIE * min(one.length, two.length):
                stays, goes = two, one
        n = stays.normal - goes.normal
        stays.normal = n / np.hypot(*n)
        stays.gap = stays.normal @ stays.relative(shape.x)
        stays.exact = stays.exact or goes.exact or smooth and rule == "AUTO"
        goes.exact = False


class Wall:
    """A rigid plane with its nodes."""

    def __init__(self, card, nodes):
        self.card, self.nodes = card, nodes
        t, h = np.array(card.t), np.array(card.h)
        self.normal = (h - t) / np.hypot(*(h - t))
        self.point = t

    def rows(self, x):
        rows = []
        for i in self.nodes:
            row = Row(i, -1, None, [], self.normal, self.normal @ (x[i] - self.point), np.inf)
            row.group, row.mu, row.card = (self, 0), self.card.mu, self.card
            rows.append(row)
        return rows
