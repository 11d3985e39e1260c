"""Runs at finite deformation: restarts, halved steps, failures, the explicit scheme, what stays the
same when a scene is turned, mirrored or renumbered. Every bound has its reason beside it."""

import os
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import numpy as np
from finite_scenes import Grid, body, finite, run, spinning, thrown, turn
from scenes import at_most, check, finish, run_text, table, within
from solids import Box, deck
from space import contents

LEDGER = 1.0e-10  # of the largest term: where Newton's method stops


def impact(
    names=("foam", "rubber"),
    h=2.0e-4,
    end=0.01,
    frame=np.eye(2),
    order=None,
    sides="1,2",
    extra=(),
    numbers=(1, 2),
    every=None,
    scheme="THETA,0.5",
    mu=0.3,
    mass="LUMPED,0",
):
    """A block hits another and slides on it; turned by a matrix of the plane, nodes of a body in
    another order, sides of the contact exchanged. A mirrored body has its elements turned round.
    """
    lines = finite()
    for number, (name, n, low, v) in enumerate(
        ((names[0], 3, (0.0, 0.0), (6.0, 12.0)), (names[1], 4, (0.33, 1.015), (-6.0, -20.0))),
        start=1,
    ):
        mesh = Grid(n, n, origin=low, shift=0.1, seed=number)
        mesh.x = mesh.x @ frame.T
        if np.linalg.det(frame) < 0:
            mesh.elements = [e[::-1] for e in mesh.elements]
        if order is not None:
            new = np.random.default_rng(order + number).permutation(len(mesh.x))
            mesh.elements = [[int(new[n]) for n in e] for e in mesh.elements]
            mesh.x = mesh.x[np.argsort(new)]
        first = 1000 * numbers[number - 1]
        lines += body(mesh, name, number, first)
        lines += thrown([frame @ np.array(v)] * len(mesh.x), range(len(mesh.x)), first)
    lines += ["*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", sides + ",,,%r" % mu]
    lines += list(extra)
    tables = ("GLSTAT", "MATSUM", "RCFORC", "SLEOUT")
    return deck(lines, h, end, scheme=scheme, mass=mass, tables=tables, every=every)


def finite_restart():
    """A run from a restart file is that without one, bit for bit, with the history of plastic
    points, with contact, and where steps were halved before and after the file was written."""
    halve = ["*BIPACT_STEP", "HALVE"]
    for name, text, at in (
        ("plastic", impact(("plastic", "piecewise")), 30),
        ("foam", impact(), 25),
        ("halved", impact(("foam", "plastic"), h=1.0e-3, end=0.012, extra=halve), 4),
    ):
        plain = contents(run(name, text))
        cut = text.replace("*END", "*BIPACT_RESTART\n%d,,99\n*END" % at)
        folder = run(name + " cut", cut)
        whole = contents(folder)
        check(whole == plain, name + ": restart files change the tables")
        files = sorted(f for f in os.listdir(folder) if "restart" in f)
        check(len(files) > 0, name + ": restart files")
        for file in files[:2]:
            run(name + " cut", cut, "--restart", os.path.join(folder, file))
            check(contents(folder) == whole, name + ": from " + file)


def finite_halved():
    """A step that Newton's method does not manage is halved by MODE HALVE and ends the run without:
    exit 1, naming the step. An element that is turned inside out is named."""
    h = 2.0**-7  # the block turns by .47 in it, waves of pressure run 42 elements
    block = Grid(8, 4, (2.0, 1.0), (-1.0, -0.5))
    lines = finite() + body(block, "mooney")
    lines += thrown(spinning(block.x, 60.0), range(len(block.x)))
    text = deck(lines, h, 2 * h)
    folder, code, errors = run_text("fixed", text, "--quiet")
    check(
        code == 1 and "step 0" in errors and "not positive definite" in errors,
        "fixed steps: exit %d: %s" % (code, errors),
    )
    folder = run("halved", text.replace("*END", "*BIPACT_STEP\nHALVE\n*END"))
    rows = table(folder, "glstat")
    at_most(np.abs(rows["residual"]).max(), LEDGER, "halved: balance")
    at_most(np.abs(rows["total"] / rows["total"][0] - 1.0).max(), LEDGER, "halved: energy")
    moment = np.abs(rows["angz"] / rows["angz"][0] - 1.0).max()
    at_most(moment, 1.0e-12, "halved: angular momentum")
    with open(os.path.join(folder, "bipact.log")) as log:
        check("steps halved 0" not in log.read(), "halved: the log counts it")
    # A squeezed element: its top is driven through its foot.
    mesh = Grid(1, 1)
    lines = finite() + body(mesh, "foam")
    lines += ["*SET_NODE_LIST", "1,", "1,2", "*SET_NODE_LIST", "2,", "3,4"]
    lines += ["*BOUNDARY_SPC_SET", "1,,1,1", "2,,1,0", "*BOUNDARY_PRESCRIBED_MOTION_SET"]
    lines += ["2,2,2,1", "*DEFINE_CURVE", "1,", "0.0,0.0", "1.0,-1.5"]
    for static in (True, False):
        text = deck(lines, 0.25, 1.0, static=static)
        folder, code, errors = run_text("inside out", text, "--quiet")
        check(
            code == 1 and "element 1" in errors and "inside out" in errors,
            "inside out: exit %d: %s" % (code, errors),
        )
    # A refused step leaves nothing behind: its halves are those of a run of half the step.
    h = 2.0**-7
    block, bar = Grid(8, 4, (2.0, 1.0), (-1.0, -0.5)), Grid(2, 1, (2.0, 1.0), (0.0, 3.0))
    lines = finite() + body(block, "mooney") + body(bar, "plastic", 2, 1000)
    lines += thrown(spinning(block.x, 60.0), range(len(block.x)))
    lines += thrown([(20.0 * x[0], 0.0) for x in bar.x], range(len(bar.x)), 1000)
    one = deck(lines, h, h)
    folder, code, errors = run_text("one", one, "--quiet")
    check(code == 1 and "step 0" in errors, "one step: exit %d: %s" % (code, errors))
    halved = table(run("once", one.replace("*END", "*BIPACT_STEP\nHALVE\n*END")), "glstat")
    two = table(run("two", deck(lines, h / 2, h)), "glstat")
    check(two["plastic"][-1] > 0.0, "plastic work")
    for c in halved.names:
        check(c == "dt" or halved[c][-1] == two[c][-1], "restored: %s" % c)
    # A block is drawn aside by nine times its shear modulus: where a step is halved, the tangent at
    # its start with the part of the stresses is not positive definite. That fails no step.
    mesh = Grid(2, 2, shift=0.1)
    lines = finite() + body(mesh, "mooney")
    lines = [x.replace("0.49,", "0.49999,") for x in lines]
    lines += ["*SET_NODE_LIST", "1,", "1,2,3", "*SET_NODE_LIST", "2,", "7,8,9"]
    lines += ["*BOUNDARY_SPC_SET", "1,,1,1", "*DEFINE_CURVE", "1,", "0.0,0.0", "1.0,1.0"]
    lines += ["*LOAD_NODE_SET", "2,1,1,153.65", "*BIPACT_STEP", "HALVE"]
    folder = run("drawn aside", deck(lines, 0.125, 1.0, static=True))
    with open(os.path.join(folder, "bipact.log")) as log:
        check("steps halved 0" not in log.read(), "drawn aside: the log counts it")



def finite_passage():
    """A body that flies through another within a step ends the run, however far it flies: also
    where the step is 30 or 200 times as long as the way through the other."""
    for in_space in (False, True):
        for far in (3.0, 30.0, 200.0):
            lines = finite()
            for number, low in ((1, 0.0), (2, 1.1)):
                if in_space:
                    mesh = Box((2, 2, 2), origin=(0.0, 0.0, low))
                    way = (0.0, 0.0, -far)
                else:
                    mesh = Grid(2, 2, origin=(0.0, low))
                    way = (0.0, -far)
                first = 100 * number
                lines += body(mesh, "foam", number, first)
                if number == 2:
                    lines += thrown([way] * len(mesh.x), range(len(mesh.x)), first)
            kind = "CONTACT_AUTOMATIC" if in_space else "CONTACT_2D_AUTOMATIC"
            cards = ["1,2,2,2", "0.0,"] if in_space else ["1,2,,,0.0"]
            lines += ["*%s_SURFACE_TO_SURFACE" % kind] + cards
            folder, code, errors = run_text("passage", deck(lines, 1.0, 2.0), "--quiet")
            check(
                code == 1 and "went through part" in errors and "step 1," in errors,
                "%s %g: exit %d: %s" % ("space" if in_space else "plane", far, code, errors),
            )
    # A body that folds through itself overlaps as two bodies do: edges cross by .028 of one.
    with open(os.path.join(os.environ["ROOT"], "tests/decks/finite_passage/folded.k")) as file:
        folder, code, errors = run_text("folded", file.read(), "--quiet")
    check(code == 0 and "WARNING overlap" in errors, "folded: exit %d: %s" % (code, errors))


def spin(scheme, courant, mass="LUMPED,0", force=""):
    """The spinning block of finite.py by a scheme, half a turn; rows of GLSTAT, its last positions."""
    mesh = Grid(8, 4, (2.0, 1.0), (-1.0, -0.5))
    h = float(np.pi / 60.0 / np.ceil(np.pi / 60.0 / (courant * 0.25 / np.sqrt(1.35e5))))
    lines = finite(force) + body(mesh, "elastic")
    lines += thrown(spinning(mesh.x, 60.0), range(len(mesh.x)))
    lines += ["*DATABASE_HISTORY_NODE", "1,5,9,20,45"]
    text = deck(lines, h, np.pi / 60.0, scheme=scheme, mass=mass, tables=("GLSTAT", "NODOUT"))
    folder = run("spin", text)
    nodes = table(folder, "nodout")
    return table(folder, "glstat"), np.stack([nodes[c][-5:] for c in ("ux", "uy")])


def finite_explicit():
    """PAOLI with PBETA 0, lumped mass: angular momentum is kept, as internal forces at one
    configuration have no moment; energy oscillates with the square of the step; places agree with
    those of EMC at a small step to second order."""
    small, fine = 0.05, spin("THETA,0.5", 0.05, force="EMC")[1]
    moments, errors, energies = [], [], []
    for courant in (0.4, 0.2, 0.1):
        rows, u = spin("PAOLI,,,,,,0.0", courant)
        moments.append(np.abs(rows["angz"][1:] / rows["angz"][1] - 1.0).max())
        energies.append(np.abs(rows["total"] / rows["total"][0] - 1.0).max())
        errors.append(np.abs(u - fine).max())
        at_most(
            np.abs(rows["residual"]).max(), LEDGER, "explicit, Courant %g: balance" % courant
        )
    # The exact motion is as near to the first order of both errors: EMC's at this step is
    # (small/0.1)^2 of the last one's.
    within(errors[0] / errors[1], 3.2, 4.8, "explicit: order of places")
    at_most(errors[2], errors[0] / 9.0, "explicit: places, against four times the step")
    within(energies[1] / energies[2], 3.2, 4.8, "explicit: order of energy")
    at_most(energies[0], 0.02, "explicit: energy")
    for m in moments:
        at_most(m, 1.0e-12, "explicit: angular momentum")


def finite_invariance():
    """An impact turned by an angle, mirrored, its nodes renumbered in another order, the sides of
    the contact exchanged: displacement, energies and impulses are equal to 1e-9 of each column's
    maximum (conventions of THETA); forces of one step to 1e-6."""
    half = np.diag([-1.0, 1.0])
    plain = None
    for label, options in (
        ("plain", {}),
        ("turned", {"frame": turn(0.7)}),
        ("mirrored", {"frame": half}),
        ("renumbered", {"order": 3}),
        ("exchanged", {"sides": "2,1"}),
        ("numbers", {"numbers": (2, 1)}),
    ):
        folder = run(label, impact(**options))
        frame = options.get("frame", np.eye(2))
        rows, parts = table(folder, "glstat"), table(folder, "matsum")
        found = {c: rows[c] for c in ("kinetic", "internal", "friction", "contact")}
        v = np.stack([parts["vx"], parts["vy"]], axis=1) @ frame
        found["vx"], found["vy"] = v.T
        force = table(folder, "rcforc")
        check(np.abs(force["fn"]).max() > 0.0, label + ": contact")
        if plain is None:
            plain, fn = found, np.abs(force["fn"])
            check(rows["friction"][-1] > 0.0, "friction")
            continue
        for c, values in found.items():
            scale = np.abs(plain[c]).max()
            if c in ("kinetic", "internal", "friction", "contact"):
                scale = plain["kinetic"].max()
            at_most(np.abs(values - plain[c]).max() / scale, 1.0e-9, "%s: %s" % (label, c))
        other = np.abs(force["fn"])
        at_most(np.abs(other - fn).max() / fn.max(), 1.0e-6, label + ": force")


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
