"""Decks around an axis at finite deformation: a block that bounces, a stretched rod, a blown-up
tube. Every bound has its reason beside it."""

import os
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import numpy as np
from rings import Mesh, curve, deck, elastic, flight, mesh_cards, node_set, part_cards
from scenes import at_most, check, finish, run_text, show, table

FOAM = ["*MAT_BLATZ-KO_FOAM", "1,1.0e-3,100.0"]
MOONEY = ["*MAT_MOONEY-RIVLIN_RUBBER", "1,1.0e-3,0.495,40.0,10.0"]


def run(name, text, *options):
    """Runs a deck that must run; returns its folder."""
    folder, code, errors = run_text(name, text, *options)
    check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
    return folder


def axis_bounce():
    """A block bounces on a floor with friction: the force EMC loses and gains no energy but to
    contact and friction, which the ledger has, 1e-10 (finite.md 4); in flight, before the touch
    and after it, 1e-12. Momentum along the axis is the impulse of the floor."""
    for name, law in (("foam", FOAM), ("Mooney", MOONEY), ("elastic", elastic())):
        for triangles in (False, True):
            mesh = Mesh((4, 4), heights=(0.01, 1.01), triangles=triangles)
            lines = mesh_cards(mesh) + part_cards() + law
            lines += node_set(1, range(len(mesh.x))) + flight(vy=-100.0)
            lines += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,0.0,1.0,0.0,0.3"]
            text = deck(lines, 1.0e-4, 0.015, tables=("GLSTAT", "RWFORC"), finite=True)
            folder = run("bounce", text)
            rows, wall = table(folder, "glstat"), table(folder, "rwforc")
            what = name + (" triangles" if triangles else "")
            check(rows["friction"][-1] > 0.0 and wall["nactive"].any(), what + ": it touches")
            balance = rows["total"] - rows["total"][0] + rows["friction"] + rows["contact"]
            at_most(np.abs(balance - rows["unsolved"]).max() / rows["total"][0], 1.0e-10,
                    what + ": energy")
            at_most(np.abs(rows["residual"]).max(), 1.0e-10, what + ": ledger")
            change = rows["momy"] - rows["momy"][0]
            at_most(np.abs(change - wall["iy"]).max() / np.abs(rows["momy"][0]), 1.0e-11,
                    what + ": momentum")


def axis_rod():
    """A rod with free sides is drawn to twice its length in statics: stress and lateral stretch of
    the law, here Blatz-Ko's foam with lateral stretch l^(-1/4) and Cauchy stress G (1 - l^(-5/2)):
    uniform, so 1e-9 by RES 1e-10 on any mesh."""
    shear, stretch = 100.0, 2.0
    for triangles in (False, True):
        mesh = Mesh((2, 3), heights=(0.0, 1.5), triangles=triangles, shift=0.2)
        lines = mesh_cards(mesh) + part_cards() + FOAM
        lines += node_set(1, mesh.bottom()) + ["*BOUNDARY_SPC_SET", "1,,,1"]
        lines += node_set(2, mesh.top()) + curve(1, (0.0, 0.0), (1.0, 1.5 * (stretch - 1.0)))
        lines += ["*BOUNDARY_PRESCRIBED_MOTION_SET", "2,2,2,1,1.0"]
        lines += ["*DATABASE_HISTORY_NODE", "%d," % (mesh.row(2, 1) + 1)]
        lines += ["*DATABASE_HISTORY_SHELL"] + ["%d," % (e + 1) for e in range(len(mesh.elements))]
        tables = ("NODOUT", "ELOUT", "SPCFORC")
        folder = run("rod", deck(lines, 0.1, 1.0, static=True, tables=tables, finite=True))
        rows = table(folder, "elout")
        last = rows["time"] > 1.0 - 1e-9
        exact = shear * (1.0 - stretch**-2.5)
        before = stretch - 0.1 * (stretch - 1.0)
        nominal = [shear * np.pi * (1.0 - l**-2.5) * l**-0.5 for l in (before, stretch)]
        what = "triangles: " if triangles else "quadrilaterals: "
        at_most(np.abs(rows["syy"][last] / exact - 1.0).max(), 1.0e-9, what + "stress")
        others = max(np.abs(rows[c][last]).max() for c in ("sxx", "szz", "sxy"))
        at_most(others / exact, 1.0e-9, what + "no other stress")
        at_most(abs(table(folder, "nodout")["x"][-1] / stretch**-0.25 - 1.0), 1.0e-9,
                what + "lateral stretch")
        forces = table(folder, "spcforc")
        last = forces["time"] > 1.0 - 1e-9
        force = np.maximum(0.0, forces["fy"][last]).sum()    # the mean over the step
        at_most(abs(force / np.mean(nominal) - 1.0), 1.0e-8, what + "force")


def axis_blown_tube():
    """A thick tube of neo-Hooke's law, PR 0.4999, its bore widened to 1.5 times, no strain along
    the axis: the radial force on the bore is 2 pi a p with p = int G (l^2 - l^-2) dr/r over the
    wall, l = r/R, of an incompressible one. Order 2 in h with mean dilatation, 6e-4 of four
    elements, and what the compressibility leaves, 5e-5."""
    inner, outer, shear, step = 1.0, 2.0, 10.0, 0.0125
    points, weights = np.polynomial.legendre.leggauss(40)

    def force_of(grown):
        """On a ring of height 1 of the bore at a radius."""
        end = np.sqrt(outer**2 + grown**2 - inner**2)
        middle, half = 0.5 * (end + grown), 0.5 * (end - grown)
        r = middle + half * points
        squared = r**2 / (r**2 - grown**2 + inner**2)
        pressure = half * (weights * shear * (squared - 1.0 / squared) / r).sum()
        return 2.0 * np.pi * grown * pressure

    # Of supports the mean over a step is written.
    exact = 0.5 * (force_of(1.5) + force_of(1.5 - 0.5 * step))
    errors = []
    for n in (4, 8, 16):
        height = 1.0 / n
        mesh = Mesh((n, 1), (inner, outer), (0.0, height))
        lines = mesh_cards(mesh) + part_cards()
        lines += ["*MAT_MOONEY-RIVLIN_RUBBER", "1,1.0e-3,0.4999,%r,0.0" % (0.5 * shear)]
        lines += node_set(1, range(len(mesh.x))) + ["*BOUNDARY_SPC_SET", "1,,,1"]
        lines += node_set(2, mesh.inner()) + curve(1, (0.0, 0.0), (1.0, 0.5))
        lines += ["*BOUNDARY_PRESCRIBED_MOTION_SET", "2,1,2,1,1.0"]
        folder = run("blown", deck(lines, step, 1.0, static=True, tables=("SPCFORC",),
                                   finite=True))
        rows = table(folder, "spcforc")
        force = rows["fx"][rows["time"] > 1.0 - 1e-9].sum()
        errors.append(abs(force / (height * exact) - 1.0))
    show("errors of the pressure %s" % errors)
    for k, error in enumerate(errors):
        at_most(error, 1.0e-3 / 4**k + 5.0e-5, "%d elements: pressure" % (4 * 2**k))


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
