"""Tractions on the face of a body as the tables of a run have them, and how far they are from a
closed form."""

import startup  # noqa: F401  before what is no part of Python
import numpy as np

import tables


def face_of(places, folder, side):
    """The nodes of a face, {number: x}, that are listed at the end, from left to right: place x,
    length that belongs to each, force x and y, pressure."""
    rows = tables.read_run(folder, "ncforc").select(side=side)
    rows = rows.rows(rows["time"] == rows["time"].max())
    known = np.flatnonzero([int(n) in places for n in rows["node"]])
    x = np.array([places[int(rows["node"][k])] for k in known])
    order = np.argsort(x)
    x, known = x[order], known[order]
    length = np.zeros(len(x))
    length[:-1] += 0.5 * np.diff(x)
    length[1:] += 0.5 * np.diff(x)
    return (x, length) + tuple(rows[name][known] for name in ("fx", "fy", "pressure"))


def flat_face(mesh):
    """{number: x} of the nodes at y = 0 of a mesh that make_scenes.py has written."""
    found, inside = {}, False
    with open(mesh, encoding="ascii") as file:
        for line in file:
            if line.startswith("*"):
                inside = line.startswith("*NODE")
            elif inside and not line.startswith("$") and float(line[24:40]) == 0.0:
                found[int(line[:8])] = float(line[8:24])
    return found


def off_nodes(length, values, exact):
    """Relative L2 error over the nodes of a face."""
    return np.sqrt(np.sum(length * (values - exact) ** 2) / np.sum(length * exact**2))


def off_lines(x, values, exact):
    """The same of the lines between the nodes, over the whole face."""
    at = np.linspace(x[0], x[-1], 20001)
    error = np.interp(at, x, values) - exact(at)
    return np.sqrt(np.sum(error**2) / np.sum(exact(at) ** 2))
