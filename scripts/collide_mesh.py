"""Small random meshes of plane bodies, for collide.py.

A mesh is (xy, elements): node places (n, 2) and tuples of three or four node indices,
counter-clockwise. Every body is simply connected: one outline.
"""

import math

import numpy as np


def divided(rng, breaks, size):
    """Places along a line: every interval of `breaks` cut into pieces of about `size`."""
    places = [breaks[0]]
    for low, high in zip(breaks, breaks[1:]):
        count = max(1, int(round((high - low) / size)))
        inner = np.arange(1, count) + rng.uniform(-0.15, 0.15, count - 1)
        places += list(low + (high - low) * inner / count) + [high]
    return np.array(places)


def blocks(xs, ys, filled):
    """Quadrilaterals of the grid xs x ys where filled(x, y) holds at their centres."""
    number, xy, elements = {}, [], []

    def node(i, j):
        if (i, j) not in number:
            number[i, j] = len(xy)
            xy.append((xs[i], ys[j]))
        return number[i, j]

    for i in range(len(xs) - 1):
        for j in range(len(ys) - 1):
            if filled(0.5 * (xs[i] + xs[i + 1]), 0.5 * (ys[j] + ys[j + 1])):
                corners = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
                elements.append(tuple(node(*c) for c in corners))
    return np.array(xy), elements


def rectangle(rng, width, height, nx, ny):
    """A rectangle of about nx x ny elements with its lower left corner at the origin."""
    xs = divided(rng, (0.0, width), width / nx)
    ys = divided(rng, (0.0, height), height / ny)
    return blocks(xs, ys, lambda x, y: True)


def bracket(rng, shape, width, height, size):
    """An L, U or T of elements of about `size`."""
    a, b = rng.uniform(0.25, 0.35) * width, rng.uniform(0.3, 0.5) * height
    xs, ys = (0.0, a, width - a, width), (0.0, b, height)
    filled = {
        "L": lambda x, y: y < b or x < a,
        "U": lambda x, y: y < b or not a < x < width - a,
        "T": lambda x, y: y > b or a < x < width - a,
    }[shape]
    if shape == "L":
        xs = (0.0, a, width)
    return blocks(divided(rng, xs, size), divided(rng, ys, size), filled)


def slot(rng, width, height, opening, depth, size):
    """A U whose slot has the given opening and depth."""
    a, b = 0.5 * (width - opening), height - depth
    xs = divided(rng, (0.0, a, width - a, width), size)
    ys = divided(rng, (0.0, b, height), size)
    return blocks(xs, ys, lambda x, y: y < b or not a < x < width - a)


def profile(rng, points, size):
    """The area between y = 0 and the line through the points, from left to right."""
    x, y = np.array(points).T
    xs = divided(rng, x, size)
    rows = max(1, int(round(y.max() / size)))
    xy, elements = blocks(xs, np.arange(rows + 1) / rows, lambda *_: True)
    xy[:, 1] *= np.interp(xy[:, 0], x, y)
    return xy, elements


def polygon(rng, corners, size):
    """A convex polygon: rings that shrink to the centre, triangles in the innermost."""
    corners = np.asarray(corners, dtype=float)
    ring = []
    for a, b in zip(corners, np.roll(corners, -1, axis=0)):
        length = math.hypot(*(b - a))
        ring += [a + s / length * (b - a) for s in divided(rng, (0.0, length), size)[:-1]]
    ring, n = np.array(ring), len(ring)
    centre = ring.mean(axis=0)
    radius = np.hypot(*(ring - centre).T).mean()
    layers = max(1, int(round(radius / size)))
    factors = 1.0 - np.arange(layers) / layers
    xy = np.concatenate([centre + f * (ring - centre) for f in factors] + [[centre]])
    elements = []
    for k in range(layers):
        for i in range(n):
            a, b = k * n + i, k * n + (i + 1) % n
            inner = (b + n, a + n) if k < layers - 1 else (layers * n,)
            elements.append((a, b) + inner)
    return xy, elements


def corners_of(rng, count, size):
    """Corners of a convex polygon: on an ellipse, none close to another."""
    steps = rng.uniform(0.6, 1.4, count)
    angles = 2.0 * math.pi * np.cumsum(steps) / steps.sum()
    axes = size * np.array([1.0, rng.uniform(0.6, 1.0)]) / 2.0
    return axes * np.column_stack([np.cos(angles), np.sin(angles)])


def outline(elements):
    """Nodes of the boundary in order, the body on the left."""
    edges = {(a, b) for e in elements for a, b in zip(e, e[1:] + e[:1])}
    follows = {a: b for a, b in edges if (b, a) not in edges}
    loop = [min(follows)]
    while follows[loop[-1]] != loop[0]:
        loop.append(follows[loop[-1]])
    if len(loop) != len(follows):
        raise ValueError("a body with more than one outline")
    return loop


def corner_areas(xy, element):
    """Twice the area of the triangle at each corner of an element."""
    p = xy[list(element)]
    a, b = np.roll(p, -1, axis=0) - p, np.roll(p, 1, axis=0) - p
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def split(rng, mesh, share):
    """A share of the quadrilaterals cut into triangles."""
    xy, elements = mesh
    out = []
    for e in elements:
        if len(e) == 4 and rng.random() < share:
            a, b, c, d = e if rng.random() < 0.5 else e[1:] + e[:1]
            out += [(a, b, c), (a, c, d)]
        else:
            out.append(e)
    return xy, out


def perturb(rng, mesh, amount):
    """Inner nodes moved at random; a move that spoils an element is taken back."""
    xy, elements = mesh[0].copy(), mesh[1]
    fixed = set(outline(elements))
    around = {}
    for e in elements:
        for i in e:
            around.setdefault(i, []).append(e)
    for i in sorted(set(around) - fixed):
        old, mine = xy[i].copy(), around[i]
        before = min(corner_areas(xy, e).min() for e in mine)
        edge = min(np.hypot(*(xy[j] - old)) for e in mine for j in e if j != i)
        xy[i] += amount * edge * rng.uniform(-1.0, 1.0, 2)
        if min(corner_areas(xy, e).min() for e in mine) < 0.4 * before:
            xy[i] = old
    return xy, elements


def finished(rng, mesh):
    """A mesh of quadrilaterals, triangles or both, perturbed inside."""
    share = rng.choice([0.0, 1.0, rng.uniform(0.2, 0.8)])
    return perturb(rng, split(rng, mesh, share), rng.choice([0.0, 0.25]))


def turned(xy, angle):
    """Places turned about the origin."""
    c, s = math.cos(angle), math.sin(angle)
    return xy @ np.array([[c, s], [-s, c]])


def centroid(loop):
    """Centre of the area within an outline."""
    a, b = loop - loop[0], np.roll(loop - loop[0], -1, axis=0)
    twice = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return loop[0] + ((a + b) * twice[:, None]).sum(axis=0) / (3.0 * twice.sum())


def edge_lengths(loop):
    """Lengths of the edges of an outline, given as places in order."""
    return np.hypot(*(np.roll(loop, -1, axis=0) - loop).T)


def one_sided(points, loop):
    """Smallest distance of the points from the edges of an outline."""
    a, d = loop, np.roll(loop, -1, axis=0) - loop
    y = points[:, None, :] - a
    s = np.clip((y * d).sum(-1) / (d * d).sum(-1), 0.0, 1.0)
    return np.hypot(*np.moveaxis(y - s[..., None] * d, -1, 0)).min()


def distance(one, two):
    """Distance of two disjoint outlines."""
    return min(one_sided(one, two), one_sided(two, one))


def approach(loop, others, direction, gap):
    """How far an outline can go along the unit direction until `gap` is left to the nearest
    other; it never goes farther than is free."""
    gone = 0.0
    for _ in range(1000):
        free = min(distance(loop + gone * direction, other) for other in others) - gap
        if free < 1.0e-3 * gap or gone > 1.0e3:
            break
        gone += free
    return gone
