#!/usr/bin/env python3
"""CalculiX (ccx) beside bipact at finite deformation, on the same mesh with the same steps: the
rubber disc of input/finite that bounces off a smooth floor.  bench/finite_peer.py [STEPS]

Disc of radius 1, 16 x 16 quadrilaterals, plane strain, W = G/2 (I1 J^(-2/3) - 3) + K/2 (J -
1)^2, G 1000, PR .3, density 1e-3, at 200 onto the floor, gap .01, end 6e-3. Both: energy at the
end and its largest rise, over the start; penetration of the lowest node; user seconds, of
bipact without tables and with the start of the program, least of three. Of bipact the worst
residual of the ledger too, and passes of Newton's method a step. CalculiX: one layer of C3D8
held across it, NLGEOM, the same law (*HYPERELASTIC, NEO HOOKE, D1 = 2/K), *DYNAMIC of Hilber,
Hughes and Taylor with alpha -.05, increments of at most the step, surface to surface contact by
a linear penalty of 50 E on a plate whose nodes are held; its energy is without what sits in the
penalty. Without ccx its row is left out."""

import argparse
import os
import re
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scripts"))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import startup
import numpy as np

import common
import make_finite
import peers
import tables

SHEAR, POISSON, DENSITY, SPEED, GAP, END = 1000.0, 0.3, 1.0e-3, 200.0, 0.01, 6.0e-3
BULK = 2.0 * SHEAR * (1.0 + POISSON) / (3.0 * (1.0 - 2.0 * POISSON))
PENALTY = 50.0 * 2.0 * SHEAR * (1.0 + POISSON)
CELLS = 16
TARGET = 0.25  # of the processor time of CalculiX
COLUMNS = (
    "program                    steps  E end/E0 - 1  rise of E  penetration  residual"
    "  passes   v end    user s"
)


def deck(steps, mean):
    """The disc of make_finite.py, tables of every step; mean: QP0 of *BIPACT_KINEMATICS."""
    step = END / steps
    x, e = make_finite.disc(CELLS, (0.0, 1.0 + GAP))
    out = make_finite.head("a rubber disc", END, step) + make_finite.shells(x, e)
    at = out.index("*BIPACT_KINEMATICS")
    out[at : at + 3] = ["*BIPACT_KINEMATICS", "EMC,," + mean]
    law = make_finite.NEO_HOOKE + ["1,%r,%r" % (DENSITY, POISSON), "%r," % (SHEAR / 2.0)]
    out += make_finite.part(1, "disc", law) + ["*INITIAL_VELOCITY", "0,", "0.0,%r" % -SPEED]
    out += make_finite.floor(0.0)
    for name in ("GLSTAT", "MATSUM", "SLEOUT"):
        out += ["*DATABASE_" + name, "%r," % step]
    return "\n".join(out + ["*END", ""])


def bipact(steps, mean, program):
    """The figures of a row."""
    with tempfile.TemporaryDirectory() as folder:
        path, out = os.path.join(folder, "disc.k"), os.path.join(folder, "out")
        with open(path, "w", encoding="ascii") as file:
            file.write(deck(steps, mean))
        done = common.run(path, out, program)
        if done["code"]:
            raise SystemExit("bipact: " + done["errors"])
        energy, parts, contact = (
            tables.read_run(out, name) for name in ("glstat", "matsum", "sleout")
        )
        with open(os.path.join(out, "bipact.log"), encoding="utf-8") as file:
            passes = re.search(r"Newton's method: passes \d+, (\S+)", file.read()).group(1)
        silent = common.without_tables(path)
        times = [peers.resource_of([program, silent, "--quiet"], folder) for _ in range(3)]
    return dict(
        energy=energy["total"] / energy["total"][0],
        penetration=contact["penetration"].max(),
        residual=np.abs(energy["residual"]).max(),
        passes=float(passes.rstrip(",")),
        speed=parts["vy"][-1],
        cpu=min(t["user"] for t in times),
    )


def input_of(steps):
    """The input of CalculiX: the disc, then a plate of four elements below it."""
    x, e = make_finite.disc(CELLS, (0.0, 1.0 + GAP))
    across = np.linspace(-2.0, 2.0, 5)
    plate = [(s, y) for y in (-0.5, 0.0) for s in across]
    n, k = len(x), len(e)
    flat = list(map(tuple, x)) + plate
    below = [[n + i, n + i + 1, n + i + 6, n + i + 5] for i in range(4)]
    out = ["*NODE, NSET=NALL"]
    for layer in (0, 1):
        out += [
            "%d, %.16g, %.16g, %d" % (1 + i + layer * len(flat), *p, layer)
            for i, p in enumerate(flat)
        ]
    for name, cells, first in (("DISC", e, 1), ("PLATE", below, k + 1)):
        out += ["*ELEMENT, TYPE=C3D8, ELSET=" + name]
        for c, four in enumerate(cells):
            ids = [1 + i for i in four] + [1 + i + len(flat) for i in four]
            out.append("%d, %s" % (first + c, ", ".join(map(str, ids))))
    for name, part in (("MOVES", range(n)), ("HELD", range(n, len(flat)))):
        out += ["*NSET, NSET=" + name]
        out += peers.listed([1 + i + layer * len(flat) for layer in (0, 1) for i in part])
    out += ["*NSET, NSET=SEEN"] + peers.listed([1 + i for i in range(n)])
    # The lowest row of elements is that of the arc below.
    out += peers.surface("SLAVE", range(1, CELLS + 1), "S3")
    out += peers.surface("MASTER", range(k + 1, k + 5), "S5")
    out += ["*MATERIAL, NAME=RUBBER", "*HYPERELASTIC, NEO HOOKE"]
    out += ["%r, %r" % (SHEAR / 2.0, 2.0 / BULK), "*DENSITY", "%r," % DENSITY]
    out += ["*MATERIAL, NAME=STIFF", "*ELASTIC", "%r, 0.3" % PENALTY]
    out += ["*DENSITY", "%r," % DENSITY, "*SOLID SECTION, ELSET=DISC, MATERIAL=RUBBER"]
    out += ["*SOLID SECTION, ELSET=PLATE, MATERIAL=STIFF", "*SURFACE INTERACTION, NAME=I"]
    out += ["*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR"]
    out += ["%r, %r" % (PENALTY, 1.0e-3 * PENALTY / 50.0)]
    out += ["*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE", "SLAVE, MASTER"]
    out += ["*BOUNDARY", "NALL, 3, 3", "HELD, 1, 2"]
    out += ["*INITIAL CONDITIONS, TYPE=VELOCITY", "MOVES, 2, %r" % -SPEED]
    step = END / steps
    out += ["*STEP, NLGEOM, INC=1000000", "*DYNAMIC, ALPHA=-0.05"]
    out += ["%r, %r, %r, %r" % (step, END, 1.0e-6 * step, step)]
    out += ["*NODE PRINT, NSET=SEEN, FREQUENCY=1", "U, V"]
    out += ["*EL PRINT, ELSET=DISC, TOTALS=ONLY, FREQUENCY=1", "ELSE, ELKE", "*END STEP", ""]
    return "\n".join(out), x


def calculix(path, steps):
    """The figures of a row. The start has the energy of motion of the mesh."""
    text, x = input_of(steps)
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "run.inp"), "w", encoding="ascii") as file:
            file.write(text)
        usage = peers.resource_of([path, "-i", "run"], folder)
        if usage["code"]:
            raise SystemExit("ccx: " + usage["said"])
        found = peers.read_blocks(os.path.join(folder, "run.dat"))
    _, u = peers.series(found["displacements"])
    _, v = peers.series(found["velocities"])
    parts = [peers.series(found[k])[1][:, 0, 0] for k in found if k.startswith("total")]
    places = x[u[0, :, 0].astype(int) - 1, 1] + u[:, :, 2]
    mass = np.zeros(len(x))
    for four in make_finite.disc(CELLS, (0.0, 0.0))[1]:
        a, b = x[four[2]] - x[four[0]], x[four[3]] - x[four[1]]
        mass[four] += DENSITY * 0.5 * (a[0] * b[1] - a[1] * b[0]) / 4.0
    start = 0.5 * mass.sum() * SPEED**2
    energy = np.concatenate([[1.0], sum(parts) / start])
    order = np.argsort(v[0, :, 0])
    return dict(
        energy=energy,
        penetration=max(0.0, -places.min()),
        residual=np.nan,
        passes=np.nan,
        speed=(v[-1, order, 2] @ mass) / mass.sum(),
        cpu=usage["user"],
    )


def show(program, steps, row):
    energy = row["energy"]
    rise = (energy - 1.0).max()
    print(
        "%-26s %5d %13.4f %10.1e %12.1e %9.1e %7.2f %7.1f %9.2f"
        % (
            program,
            steps,
            energy[-1] - 1.0,
            rise,
            row["penetration"],
            row["residual"],
            row["passes"],
            row["speed"],
            row["cpu"],
        )
    )


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("steps", nargs="?", type=int, default=240, help="steps (240)")
    parser.add_argument("--bin", default=startup.program(), help="program")
    a = parser.parse_args()
    path, version = peers.installed()
    print(COLUMNS)
    rows = {}
    for word, mean in (("bipact, mean dilatation", "AUTO"), ("bipact, displacements", "0")):
        rows[mean] = bipact(a.steps, mean, os.path.abspath(a.bin))
        show(word, a.steps, rows[mean])
    if path is None:
        print("no ccx (CalculiX) is installed: its row is left out")
        return 0
    other = calculix(path, a.steps)
    show("CalculiX " + version, a.steps, other)
    ratio = rows["AUTO"]["cpu"] / other["cpu"]
    print("user seconds of bipact over those of CalculiX: %.3f (target %g)" % (ratio, TARGET))
    return 0


if __name__ == "__main__":
    sys.exit(main())
