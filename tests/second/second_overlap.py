"""True overlap of two sides: depth of nodes inside the other polygon, or of crossing edges."""

import numpy as np


def inside(x, a, b):
    """Tells which points x (n, 2) are inside the closed polygons with edges a to b (m, 2)."""
    py = x[:, 1][:, None]
    upward = (a[None, :, 1] > py) != (b[None, :, 1] > py)
    rise = b[:, 1] - a[:, 1]
    rise = np.where(rise == 0, 1.0, rise)
    at = a[None, :, 0] + (py - a[None, :, 1]) * ((b[:, 0] - a[:, 0]) / rise)[None, :]
    return (upward & (x[:, 0][:, None] < at)).sum(axis=1) % 2 == 1


def distances(x, a, b):
    """Returns the distance of every point from every edge."""
    d = b - a
    s = np.sum((x[:, None, :] - a) * d, axis=2) / np.sum(d * d, axis=1)
    foot = a + np.clip(s, 0, 1)[:, :, None] * d
    return np.hypot(*np.moveaxis(x[:, None, :] - foot, 2, 0))


def deepest_node(boundary, x, nodes, edges):
    """Returns the largest depth of nodes in the polygon of edges, over the shorter edge."""
    a, b = x[boundary.edges[edges]].transpose(1, 0, 2)
    low, high = np.minimum(a, b).min(axis=0), np.maximum(a, b).max(axis=0)
    near = nodes[np.all((x[nodes] >= low) & (x[nodes] <= high), axis=1)]
    if not len(near):
        return 0.0
    near = near[inside(x[near], a, b)]
    if not len(near):
        return 0.0
    d = distances(x[near], a, b)
    nearest = np.argmin(d, axis=1)
    own = np.full(len(near), np.inf)
    for links in (boundary.into[near], boundary.out[near]):
        own = np.where(links >= 0, np.minimum(own, boundary.length[links]), own)
    unit = np.minimum(own, boundary.length[edges[nearest]])
    return float(np.max(d[np.arange(len(near)), nearest] / unit))


def deepest_crossing(boundary, x, first, second):
    """Returns sin(angle) times the nearer end of properly crossing edges, over the shorter."""
    a, b = x[boundary.edges[first]].transpose(1, 0, 2)
    c, d = x[boundary.edges[second]].transpose(1, 0, 2)
    p, q, r = (b - a)[:, None, :], (d - c)[None, :, :], c[None, :, :] - a[:, None, :]
    turn = p[..., 0] * q[..., 1] - p[..., 1] * q[..., 0]
    safe = np.where(turn == 0, 1.0, turn)
    s = (r[..., 0] * q[..., 1] - r[..., 1] * q[..., 0]) / safe
    t = (r[..., 0] * p[..., 1] - r[..., 1] * p[..., 0]) / safe
    hit = (turn != 0) & (s > 0) & (s < 1) & (t > 0) & (t < 1)
    if not hit.any():
        return 0.0
    size = np.hypot(p[..., 0], p[..., 1]), np.hypot(q[..., 0], q[..., 1])
    sine = np.abs(turn) / (size[0] * size[1])
    end = np.minimum(np.minimum(s, 1 - s) * size[0], np.minimum(t, 1 - t) * size[1])
    unit = np.minimum(boundary.length[first][:, None], boundary.length[second][None, :])
    return float(np.max(np.where(hit, sine * end / unit, 0.0)))


def overlap(boundary, x, one, two):
    """Returns the overlap of two sides as a part of the shorter edge."""
    if one is two or not len(two.edges):
        return 0.0
    depth = deepest_node(boundary, x, one.nodes, two.edges)
    if len(one.edges):
        depth = max(depth, deepest_node(boundary, x, two.nodes, one.edges))
        if depth == 0.0:
            depth = deepest_crossing(boundary, x, one.edges, two.edges)
    return depth
