"""Decks around an axis, small displacements: patch test, tube, masses, flight, wave, ledgers,
restart, engines, static contact. Every bound has its reason beside it."""

import os
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import numpy as np
from rings import (Mesh, curve, deck, elastic, flight, mesh_cards, node_set, part_cards, pressed)
from scenes import at_most, check, finish, run_text, show, table, within

# Of the largest term: round-off of a few hundred steps (conventions of the ledger tests).
LEDGER = 1.0e-11


def run(name, text, *options):
    """Runs a deck that must run; returns its folder."""
    folder, code, errors = run_text(name, text, *options)
    check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
    return folder


def prescribed(mesh, rows, field):
    """Cards of the displacement field(r, z) of nodes, grown by curve 1; by curve 2, which stays 0,
    where it is 0: a factor of 0 would be 1. Nothing for nodes on the axis, which are held."""
    lines = ["*BOUNDARY_PRESCRIBED_MOTION_NODE"]
    for r in rows:
        for d, u in enumerate(field(*mesh.x[r])):
            if d == 0 and mesh.x[r][0] == 0.0:
                continue
            number, factor = (1, float(u)) if u else (2, 1.0)
            lines.append("%d,%d,2,%d,%r" % (1 + r, d + 1, number, factor))
    return lines + curve(1, (0.0, 0.0), (1.0, 1.0)) + curve(2, (0.0, 0.0), (1.0, 0.0))


def axis_patch():
    """A displacement (a r, b z) of the boundary of a patch of distorted elements gives it inside,
    and one stress with that around the axis: to round-off times the condition of the patch,
    below 100."""
    a, b = 1.0e-3, -2.0e-3
    lam, mu = 0.3 * 1000.0 / (1.3 * 0.4), 1000.0 / 2.6
    trace = 2.0 * a + b
    want = np.array([lam * trace + 2.0 * mu * e for e in (a, b, a)] + [0.0, 0.0, 0.0])
    for triangles in (False, True):
        for radii in ((0.0, 1.0), (3.0, 4.0)):
            what = "%s from radius %g" % ("triangles" if triangles else "quadrilaterals", radii[0])
            mesh = Mesh((4, 4), radii, triangles=triangles, shift=0.25, seed=3)
            inside = [r for r in range(len(mesh.x)) if r not in mesh.boundary()]
            lines = mesh_cards(mesh) + part_cards() + elastic()
            lines += prescribed(mesh, mesh.boundary(), lambda r, z: (a * r, b * z))
            lines += ["*DATABASE_HISTORY_NODE"] + ["%d," % (r + 1) for r in inside]
            lines += ["*DATABASE_HISTORY_SHELL"]
            lines += ["%d," % (e + 1) for e in range(len(mesh.elements))]
            folder = run(
                "patch", deck(lines, 1.0, 1.0, static=True, tables=("GLSTAT", "NODOUT", "ELOUT"))
            )
            nodes = table(folder, "nodout")
            last = nodes["time"] == 1.0
            u = np.stack([nodes[c][last] for c in ("ux", "uy")], axis=1)
            exact = mesh.x[np.array(nodes["node"][last], dtype=int) - 1] * [a, b]
            at_most(np.abs(u - exact).max() / np.abs(mesh.x * [a, b]).max(), 1.0e-13,
                    what + ": displacement")
            rows = table(folder, "elout")
            last = rows["time"] == 1.0
            got = np.stack([rows[c][last] for c in ("sxx", "syy", "szz", "sxy", "syz", "szx")])
            at_most(np.abs(got - want[:, None]).max() / np.abs(want).max(), 1.0e-12,
                    what + ": stress")
            energy = rows["energy"][last].sum()
            volume = np.pi * (radii[1] ** 2 - radii[0] ** 2)
            exact = 0.5 * volume * (2.0 * want[0] * a + want[1] * b)
            at_most(abs(energy / exact - 1.0), 1.0e-13, what + ": energy of the whole ring")


def axis_tube():
    """Lame: a thick tube under inner pressure, plane strain; radial displacement of the bore with
    order 2, hoop stress of the elements at their centres."""
    inner, outer, p, young, nu = 1.0, 2.0, 10.0, 1000.0, 0.3
    c = p * inner**2 / (outer**2 - inner**2)

    def exact(r):
        return c * (1.0 + nu) / young * ((1.0 - 2.0 * nu) * r + outer**2 / r)

    for triangles in (False, True):
        errors, stresses = [], []
        for n in (4, 8, 16):
            mesh = Mesh((n, 2), (inner, outer), (0.0, 2.0 / n), triangles=triangles)
            lines = mesh_cards(mesh) + part_cards() + elastic(young=young, poisson=nu)
            lines += node_set(1, mesh.bottom() + mesh.top()) + ["*BOUNDARY_SPC_SET", "1,,,1"]
            lines += curve(1, (0.0, 0.0), (1.0, p)) + pressed(mesh.inner())
            lines += ["*DATABASE_HISTORY_NODE", "%d," % (mesh.row(0, 1) + 1)]
            lines += ["*DATABASE_HISTORY_SHELL"]
            lines += ["%d," % (e + 1) for e in range(len(mesh.elements))]
            folder = run(
                "tube", deck(lines, 1.0, 1.0, static=True, tables=("GLSTAT", "NODOUT", "ELOUT"))
            )
            errors.append(abs(table(folder, "nodout")["ux"][-1] / exact(inner) - 1.0))
            rows = table(folder, "elout")
            last = rows["time"] == 1.0
            middle = np.array([mesh.x[e].mean(axis=0)[0] for e in mesh.elements])
            hoop = c * (1.0 + outer**2 / middle**2)
            stresses.append(np.abs(rows["szz"][last] / hoop - 1.0).max())
        order = np.log2(errors[1] / errors[2])
        what = "triangles" if triangles else "quadrilaterals"
        show("%s: errors of the bore %s" % (what, errors))
        show("%s: errors of the hoop stress %s" % (what, stresses))
        within(order, 1.9, 2.1, what + ": order of the displacement")
        at_most(stresses[2], 0.5 * stresses[0], what + ": hoop stress converges")


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
