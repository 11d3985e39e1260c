"""Errors of contact tractions against closed forms, of a finished run of a scene of
contact_scenes.py: Hertz with the shear of Cattaneo and Mindlin (hertz), Westergaard's wave.

A face is its nodes at the end that NCFORC lists, from left to right. Nodal tractions are nodal
forces over half the neighbouring edges. side: 1 the upper face, 2 the lower."""

import startup  # noqa: F401  before what is no part of Python
import numpy as np

import analytic
import tables


def lengths_at(x):
    """Half the neighbouring edges of the nodes of a face [L]."""
    length = np.zeros(len(x))
    length[:-1] += 0.5 * np.diff(x)
    length[1:] += 0.5 * np.diff(x)
    return length


def face_of(places, folder, side):
    """Of the nodes of a face, {number: x}: (place x [L], length that belongs to each node [L], force x, y [F], pressure [F L-2])."""
    rows = tables.read_run(folder, "ncforc").select(side=side)
    rows = rows.rows(rows["time"] == rows["time"].max())
    known = np.flatnonzero([int(n) in places for n in rows["node"]])
    x = np.array([places[int(rows["node"][k])] for k in known])
    order = np.argsort(x)
    x, known = x[order], known[order]
    return (x, lengths_at(x)) + tuple(rows[name][known] for name in ("fx", "fy", "pressure"))


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


def hertz_of(meta, folder):
    """The closed form for the measured load, and the tangential force [F L-1]."""
    last = tables.read_run(folder, "rcforc").select(side=2)
    exact = analytic.Hertz(meta["radius"], meta["modulus"], abs(last["fy"][-1]))
    return exact, abs(last["fx"][-1])


def hertz_errors(meta, folder):
    """{p_y, q_x, p_n, q_t}: relative L2 errors of pressure and shear on the nodes of the lower,
    flat face: of the components x and y of the forces; of r_n and r_t in the frames of the rows,
    r_n = pressure x length (every loaded node is covered), r_t what is left of the force."""
    exact, force = hertz_of(meta, folder)
    x, length, fx, fy, pressure = face_of(meta["x"], folder, 2)
    shear = np.sqrt(np.maximum(0.0, (fx**2 + fy**2) / length**2 - pressure**2))
    p, q = exact.pressure(x), exact.shear(x, meta["mu"], force)
    return {
        "p_y": off_nodes(length, np.abs(fy) / length, p),
        "q_x": off_nodes(length, np.abs(fx) / length, q),
        "p_n": off_nodes(length, pressure, p),
        "q_t": off_nodes(length, shear, q),
    }


def wave_errors(meta, folder, side):
    """(largest error at inner nodes, |x| < .8 a, in parts of the largest pressure; relative L2
    of the lines between the nodes) of a face."""
    exact = analytic.Westergaard(meta["wave"], meta["full"], meta["mean"])
    x, _, _, _, p = face_of(meta["x"], folder, side)
    off = np.abs(p - exact.pressure(x)) / exact.pressure(0.0)
    return off[x < 0.8 * exact.half_width].max(), off_lines(x, p, exact.pressure)
