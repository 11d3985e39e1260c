"""Newton's method as a deck may ask for it, laws where they give way, massless contact nodes, mean
dilatation of wedges and pyramids. Every bound has its reason beside it."""

import os
import re
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import numpy as np
from finite_scenes import FINITE, Disc, Grid, body, finite, passes, rise, run, spinning, thrown
from scenes import at_most, check, finish, run_text, table, within
from solids import Box, curve, deck, node_set

LEDGER = 1.0e-10  # of the largest term: where Newton's method stops


def counted(folder):
    """Factorisations, one of them before the first step, and passes of a run."""
    with open(os.path.join(folder, "bipact.log")) as log:
        text = log.read()
    return [int(re.search(word + r" (\d+)", text)[1]) for word in ("factorisations", "passes")]


def turning_block(controls):
    """A block of foam that spins .05 rad a step, 20 steps; its folder."""
    mesh = Grid(8, 4, (2.0, 1.0), (-1.0, -0.5))
    lines = ["*CONTROL_IMPLICIT_SOLUTION", "12," + controls] + body(mesh, "foam")
    lines += thrown(spinning(mesh.x, 60.0), range(len(mesh.x)))
    h = 0.05 / 60.0
    return run("turning", deck(lines, h, 20 * h, mass="LUMPED,0"))


def finite_iteration():
    """ILIMIT 1 makes a factor in each pass, MAXREF at most so many in a step; DCTOL 1e-3 stops
    earlier than 1e-11 and leaves the balance open by what it stops at; a small RCTOL asks for
    passes that DCTOL alone does not; ABSTOL ends where any residual is small enough."""
    factors, plain = counted(turning_block(""))
    full = counted(turning_block("1,"))
    check(full[0] == full[1] + 1, "ILIMIT 1: %d factors, %d passes" % tuple(full))
    at_most(full[1], plain, "ILIMIT 1: passes")
    check(factors < plain / 2, "blank: %d factors, %d passes" % (factors, plain))
    check(counted(turning_block("2,1"))[0] == 21, "MAXREF 1: one factor a step")
    loose = turning_block(",,1.0e-3")
    few = counted(loose)[1]
    check(few < 0.7 * plain, "DCTOL .001: %d passes of %d" % (few, plain))
    residual = np.abs(table(loose, "glstat")["residual"]).max()
    within(residual, 1.0e-13, 1.0e-5, "DCTOL .001: balance, of second order in what is left")
    strict = counted(turning_block(",,1.0e-3,,1.0e-11"))[1]
    check(few < strict <= plain, "RCTOL 1e-11: %d passes" % strict)
    check(counted(turning_block(",,,,,,1.0e9"))[1] == 20, "ABSTOL 1e9: one pass a step")
    mesh = Grid(2, 1)
    lines = ["*CONTROL_IMPLICIT_SOLUTION", "1,1,,1.0e-3"] + body(mesh, "elastic")
    folder = run("linear", deck(lines, 0.1, 0.2))
    with open(os.path.join(folder, "bipact.log")) as log:
        check("ILIMIT has no effect" in log.read(), "small displacements: a note")


def squeezed(law, stretch):
    """A cell of a law, free across, pressed to a stretch in 20 load steps: text of the deck."""
    mesh = Grid(1, 1)
    lines = finite(name=law) + body(mesh, law)
    lines += node_set(1, mesh.on(0, 0.0)) + node_set(2, mesh.on(0, 1.0))
    lines += node_set(3, mesh.on(1, 0.0)) + ["*BOUNDARY_SPC_SET", "1,,1,0,0", "3,,0,1,0"]
    lines += ["*BOUNDARY_PRESCRIBED_MOTION_SET", "2,1,2,1"]
    lines += curve(1, (0.0, 0.0), (1.0, stretch - 1.0))
    return deck(lines, 0.05, 1.0, static=True)


def finite_compression():
    """St Venant and Kirchhoff's law has the peak of its nominal stress at .577: below .75 there is
    a warning, below .6 an end with code 1; the same explicitly, where a wave faster than .266 c
    presses further. Hencky's law goes on to .3, without a word."""
    folder, code, errors = run_text("warned", squeezed("elastic", 0.7), "--quiet")
    check(code == 0 and "WARNING compression" in errors, "warned: %d %s" % (code, errors))
    folder, code, errors = run_text("kept", squeezed("elastic", 0.76), "--quiet")
    check(code == 0 and "WARNING" not in errors, "kept: %d %s" % (code, errors))
    folder, code, errors = run_text("refused", squeezed("elastic", 0.55), "--quiet")
    good = code == 1 and "element 1 is compressed to stretch" in errors and "HENCKY" in errors
    check(good, "refused: %d %s" % (code, errors))
    folder, code, errors = run_text("hencky", squeezed("hencky", 0.3), "--quiet")
    check(code == 0 and "WARNING" not in errors, "hencky: %d %s" % (code, errors))
    mesh = Grid(20, 1, (1.0, 0.05))
    lines = finite() + body(mesh, "elastic", density=1.0)
    lines = [x.replace("1.0,100.0,0.3", "1.0,1.0,0.0") for x in lines]
    lines += thrown([(0.4, 0.0)] * len(mesh.x), range(len(mesh.x)))
    lines += ["*SET_NODE_GENERAL", "9,", "ALL,", "*BOUNDARY_SPC_SET", "9,,0,1"]
    lines += ["*RIGIDWALL_PLANAR", "0,", "1.01,0.0,0.0,0.0,0.0,0.0,0.0"]
    for scheme in ("THETA,0.5", "PAOLI,,,,,,0.0"):
        text = deck(lines, 0.01, 1.0, scheme=scheme, mass="LUMPED,0")
        folder, code, errors = run_text("fast", text, "--quiet")
        check(code == 1 and "element 20 is" in errors, "%s: %d %s" % (scheme, code, errors))


def finite_massless():
    """A disc of 8 x 8 elements on a smooth floor: what it loses comes of contact nodes that close
    with mass. Without their mass it loses 30 times less (60 times in the prototype, another
    program); 10 times is asked for. The balance stays closed and the energy never rises."""
    lost = []
    for redistributed in (0, 1):
        mesh = Disc(8, (0.0, 1.01))
        lines = finite(qp0="0") + body(mesh, "neo-hooke", density=1.0e-3)
        at = lines.index("*MAT_HYPERELASTIC_RUBBER")
        lines[at + 1 : at + 3] = ["1,0.001,0.3", "500.0,"]
        lines += ["*INITIAL_VELOCITY", "0,", "0.0,-200.0", "*CONTROL_IMPLICIT_AUTO", "1,"]
        lines += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,0.0,1.0,0.0,0.0"]
        text = deck(lines, 5.0e-5, 6.0e-3, mass="LUMPED,%d" % redistributed)
        rows = table(run("massless", text), "glstat")
        at_most(np.abs(rows["residual"]).max(), LEDGER, "REDIST %d: balance" % redistributed)
        at_most(rise(rows), 1.0e-12, "REDIST %d: energy" % redistributed)
        lost.append(1.0 - rows["total"][-1] / rows["total"][0])
    at_most(lost[1], 0.1 * lost[0], "energy lost without mass of contact nodes")


def finite_mean_forms():
    """A bar of nearly incompressible rubber bent by a load across, two elements over its height.
    Fully integrated each form locks by its volume: it moves three times less at least than with
    mean dilatation, and less the more PR nears .5. What wedges and pyramids with mean dilatation
    then lack against hexahedra, a third at most, is the shear of their triangles."""
    moved = {}
    for form in ("HEX8", "WEDGE6", "PYRAMID5"):
        for qp0 in ("", "0"):
            mesh = Box((6, 2, 2), (6.0, 1.0, 1.0), form)
            lines = finite(qp0=qp0) + body(mesh, "mooney")
            at = lines.index("*MAT_MOONEY-RIVLIN_RUBBER")
            lines[at + 1] = "1,0.001,0.4999,14.0,3.0"
            end = mesh.on(0, 6.0)
            lines += node_set(1, mesh.on(0, 0.0)) + node_set(2, end)
            lines += ["*BOUNDARY_SPC_SET", "1,,1,1,1", "*LOAD_NODE_SET"]
            lines += ["2,2,1,%r" % (-0.02 / len(end))] + curve(1, (0.0, 0.0), (1.0, 1.0))
            lines += ["*DATABASE_HISTORY_NODE", "%d," % (end[0] + 1)]
            text = deck(lines, 0.5, 1.0, static=True, tables=("NODOUT",))
            moved[form, qp0] = -table(run("bent", text), "nodout")["uy"][-1]
    for form in ("WEDGE6", "PYRAMID5"):
        ratio = moved[form, ""] / moved["HEX8", ""]
        within(ratio, 2.0 / 3.0, 1.1, form + ": against hexahedra")
    for form in ("HEX8", "WEDGE6", "PYRAMID5"):
        at_most(moved[form, "0"], moved[form, ""] / 3.0, form + ": locks without")


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
