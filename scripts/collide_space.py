#!/usr/bin/env python3
"""Let two bodies in space meet at random, many times, and judge each run from outside.

Bodies of tetrahedra: one of them, cubes of six, L-shaped bodies of eighteen; of random
stiffness, density, orientation, velocity, spin and friction. Each frame of each run is judged
by axes of separation between the tetrahedra of the two bodies, which knows nothing of the
program. With --soft bodies are of hyperelastic laws at finite deformation, at .02 to .25 of
their speed of sound. A silent overlap, a rise of the energy, or an exit code other than 0 and 1
makes this script end with 1."""

import argparse
import itertools
import os
import subprocess
import sys
import tempfile
from multiprocessing import Pool

import startup
import numpy as np

import tables
from make_space import rotation, split

FACES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))
EDGES = tuple(itertools.combinations(range(4), 2))
TETRAHEDRON = np.array(
    [[0, 0, 0], [1, 0, 0], [0.5, 3**0.5 / 2, 0], [0.5, 3**0.5 / 6, (2 / 3) ** 0.5]]
)
SILENT = 3.0e-2  # of an edge; 1e-2 is warned of by the depth of points, this measures pairs
RISE = 1.0e-9  # of the first energy
CHUNK = 4096  # pairs at once


def separations(p, q):
    """How deep pairs of tetrahedra (pairs, 4, 3) stand in each other; negative: how far they are
    apart at least. By the axes of separation: normals of faces, products of edges."""
    normals = [
        np.cross(t[:, b] - t[:, a], t[:, c] - t[:, a]) for t in (p, q) for a, b, c in FACES
    ]
    e, f = ([t[:, b] - t[:, a] for a, b in EDGES] for t in (p, q))
    axes = np.stack(normals + [np.cross(a, b) for a in e for b in f], axis=2)
    length = np.linalg.norm(axes, axis=1)
    a, b = (np.matmul(t, axes / np.maximum(length, 1.0e-6)[:, None]) for t in (p, q))
    apart = np.maximum(b.min(axis=1) - a.max(axis=1), a.min(axis=1) - b.max(axis=1))
    return -np.where(length > 1.0e-6, apart, -np.inf).max(axis=1)


def overlap(x, elements, y, others):
    """The deepest of all pairs of tetrahedra of two bodies in any of the frames of their places
    (frames, nodes, 3); of those whose boxes are apart the distance of the boxes, negative."""
    p, q = x[:, np.array(elements)[:, :4]], y[:, np.array(others)[:, :4]]
    a, b = p.min(axis=2)[:, :, None], p.max(axis=2)[:, :, None]
    c, d = q.min(axis=2)[:, None], q.max(axis=2)[:, None]
    apart = np.maximum((a - d).max(axis=3), (c - b).max(axis=3))
    deep = -np.min(apart, where=apart > 0.0, initial=np.inf)
    frame, i, j = np.nonzero(apart <= 0.0)
    for k in range(0, len(frame), CHUNK):
        part = slice(k, k + CHUNK)
        deep = max(deep, separations(p[frame[part], i[part]], q[frame[part], j[part]]).max())
    return deep


def body(chance):
    """(places about the middle, elements) of a body of edge 1, or .6 where it is an L."""
    kind = chance.integers(5)
    if kind < 2:
        return TETRAHEDRON - TETRAHEDRON.mean(axis=0), [[0, 1, 2, 3] + 4 * [3]]
    cells = [(0, 0, 0)] if kind < 4 else [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    size, number, elements = (1.0 if kind < 4 else 0.6), {}, []
    for cell in cells:
        eight = [
            number.setdefault((cell[0] + a, cell[1] + b, c), len(number))
            for c in (0, 1)
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))
        ]
        elements += split([eight])
    x = size * np.array(list(number), dtype=float)
    return x - x.mean(axis=0), elements


def soft_law(chance, young, density):
    """*MAT card and its first values of a random law whose modulus of a bar is `young`."""
    kind = chance.integers(3)
    if kind == 0:
        return ["*MAT_BLATZ-KO_FOAM", "%%d,%r,%r" % (density, young / 2.5)]
    nu = float(chance.uniform(0.1, 0.4) if kind == 1 else chance.uniform(0.0, 0.3))
    if kind == 2 and young > 100.0 * density:
        return ["*MAT_ELASTIC", "%%d,%r,%r,%r" % (density, young, nu)]
    c10 = "%r," % (young / (4.0 * (1.0 + nu)))
    return ["*MAT_HYPERELASTIC_RUBBER", "%%d,%r,%r" % (density, nu), c10]


def cards(x, elements, number, first, law):
    """Cards of a body whose law has its number open."""
    out = ["*NODE"] + ["%d,%r,%r,%r" % (first + k, *map(float, p)) for k, p in enumerate(x)]
    out += ["*ELEMENT_SOLID"]
    for k, e in enumerate(elements):
        out += ["%d,%d,%s" % (first + k, number, ",".join(str(first + n) for n in e))]
    out += ["*PART", "body", "%d,%d,%d" % (number, number, number), "*SECTION_SOLID"]
    return out + ["%d,10" % number, law[0], law[1] % number] + law[2:]


def scene(seed, share, soft=False):
    """The deck of an encounter in steps in which nodes move `share` of an edge of 1, and the
    places and elements of both bodies."""
    chance = np.random.default_rng(seed)
    bodies = []
    for _ in range(2):
        x, elements = body(chance)
        turn = rotation(chance.normal(size=3), chance.uniform(0.0, np.pi))
        bodies.append((x @ turn.T, elements))
    (x, e), (y, f) = bodies
    way, aside = chance.normal(size=(2, 3))
    way /= np.linalg.norm(way)
    aside -= (aside @ way) * way
    y = y + 2.6 * way + aside / np.linalg.norm(aside) * chance.uniform(0.0, 1.0)
    low, high = 0.0, 3.0
    for _ in range(25):
        middle = 0.5 * (low + high)
        low, high = (
            (low, middle)
            if overlap(x[None], e, (y - middle * way)[None], f) > 0
            else (middle, high)
        )
    if low == 0.0:
        low, high = 0.0, 0.5
    y = y - max(0.0, low - chance.uniform(0.02, 0.3)) * way
    while overlap(x[None], e, y[None], f) > 0.0:  # a hollow body, entered further off
        y = y + 0.05 * way
    spins = [chance.normal(size=3) * chance.uniform(0.0, 0.5) for _ in range(2)]
    speeds = [
        np.cross(s, p - p.mean(axis=0)) + c * way for s, p, c in zip(spins, (x, y), (0.5, -0.5))
    ]
    step = share / float(sum(np.linalg.norm(v, axis=1).max() for v in speeds))
    out = ["*KEYWORD", "*CONTROL_TERMINATION", "0.8,", "*CONTROL_IMPLICIT_GENERAL"]
    out += ["1,%r" % step, "*CONTROL_IMPLICIT_DYNAMICS", "1,", "*BIPACT_TIME", "THETA,0.5"]
    out += ["*CONTROL_IMPLICIT_SOLUTION", "12,"] if soft else []
    for number, (p, elements) in enumerate(((x, e), (y, f)), 1):
        young, density = float(10 ** chance.uniform(2, 4)), float(10 ** chance.uniform(-1, 1))
        law = ["*MAT_ELASTIC", "%%d,%r,%r,0.3" % (density, young)]
        if soft:  # waves at 4 to 60, bodies at 1
            law = soft_law(chance, density * float(10 ** chance.uniform(1.2, 3.5)), density)
        out += cards(p, elements, number, 1 + 100 * (number - 1), law)
    out += ["*INITIAL_VELOCITY_NODE"]
    for first, v in zip((1, 101), speeds):
        out += ["%d,%r,%r,%r" % (first + k, *map(float, w)) for k, w in enumerate(v)]
    mu = (0.0, 0.3, 1.0)[chance.integers(3)]
    out += ["*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE", "1,2,3,3", "%r," % mu]
    out += ["*DATABASE_HISTORY_NODE"]
    out += ["%d," % (first + k) for first, p in ((1, x), (101, y)) for k in range(len(p))]
    for name in ("GLSTAT", "NODOUT"):
        out += ["*DATABASE_" + name, "%r," % step]
    return "\n".join(out + ["*END", ""]), (x, e), (y, f)


def encounter(seed, share, program, folder, soft=False):
    """(how it ended, deepest overlap, rise of the energy, the bodies met)."""
    text, (x, e), (y, f) = scene(seed, share, soft)
    deck, out = (os.path.join(folder, "%d%s" % (seed, end)) for end in (".k", ".out"))
    with open(deck, "w", encoding="ascii") as file:
        file.write(text)
    done = subprocess.run([program, deck, "-o", out, "--quiet"], capture_output=True, text=True)
    if done.returncode not in (0, 1):
        return "exit code %d: %s" % (done.returncode, done.stderr), 0.0, 0.0, False
    nodes, energy = (
        tables.read_table(os.path.join(out, t + ".tab")) for t in ("nodout", "glstat")
    )
    places = np.stack([nodes[c] for c in "xyz"], axis=1).reshape(-1, len(x) + len(y), 3)
    deep = overlap(places[:, : len(x)], e, places[:, len(x) :], f)
    rise = (energy["total"] - energy["initial"] - energy["unsolved"]).max()
    how = "stopped" if done.returncode else "ran"
    if how == "ran" and "WARNING overlap" in done.stderr:
        how = "warned"
    met = energy["kinetic"].min() < 0.999 * energy["kinetic"][0]
    return how, deep, rise / energy["initial"][0], met


def one(job):
    with tempfile.TemporaryDirectory() as folder:
        return job[0], encounter(*job[:3], folder, job[3])


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("count", nargs="?", type=int, default=200, help="encounters (200)")
    parser.add_argument("--seed", type=int, default=0, help="of the first one (0)")
    parser.add_argument("--step", type=float, default=0.05, help="in edges (0.05)")
    parser.add_argument("--bin", default=startup.program(), help="program")
    parser.add_argument("--soft", action="store_true", help="at finite deformation")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="at once")
    a = parser.parse_args()
    jobs = [(a.seed + k, a.step, a.bin, a.soft) for k in range(a.count)]
    with Pool(a.jobs) as pool:
        found = pool.map(one, jobs, chunksize=4)
    faults = 0
    for seed, (how, deep, rise, _) in found:
        if how.startswith("exit") or rise > RISE or (how == "ran" and deep > SILENT):
            print("seed %d: %s, %.3g deep, energy rises by %.3g" % (seed, how, deep, rise))
            faults += 1
    ended = [how for _, (how, _, _, _) in found]
    silent = [r[1] for _, r in found if r[0] == "ran"]
    print(
        "%d encounters, %d met; warned of %d, stopped %d; deepest in silence %.3g edge; largest "
        "rise of the energy %.2g; %d faults"
        % (
            len(found),
            sum(r[3] for _, r in found),
            ended.count("warned"),
            ended.count("stopped"),
            max(silent, default=0.0),
            max(r[2] for _, r in found),
            faults,
        )
    )
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
