"""Friction that falls with the speed of slip (FS, FD, DC): the oscillator that sticks and slips
against its closed form, cards that make the law constant, random blocks with all schemes."""

import os
import random
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import numpy as np
import scenes
from bodies import Body, Scene, box
from scenes import at_most, check, finish, run_text, show, table

from analytic import StickSlip

# Of the largest term: conventions of the ledger.
LEDGER = 1.0e-11
EXACT = StickSlip()


def triangle(scene, nodes, density, young):
    body = Body(len(scene.bodies) + 1, {})
    body.rings = [nodes]
    scene.bodies.append(body)
    scene.materials.append([density, young, 0.0])


def oscillator(dt, scheme, friction=None, tend=26.0):
    """A stiff block on a belt that moves at V, held by a bar of stiffness k and less than 1e-6
    of its mass. The block is a triangle whose upper nodes are guided and whose tip is pressed by
    N, so that one contact carries all of it: no node sticks before another. DC V = 1e4."""
    e = EXACT
    scene = Scene(dt=dt, steps=round(tend / dt))
    belt = scene.body(1, 1, box(-2.0, -3.0, 6.0, 3.0), density=1.0, young=1.0e6, poisson=0.0)
    tip, right, left = (scene.node(*p) for p in ((0.0, 0.0), (0.5, 1.0), (-0.5, 1.0)))
    held = [scene.node(-1.5, 0.5), scene.node(-1.5, 1.5)]
    triangle(scene, [tip, right, left], 2.0 * e.mass, 1.0e6)
    triangle(scene, [left, *held[::-1]], 1.0e-6, 2.0 * e.stiffness)
    scene.kick(belt.nodes() + [tip, right, left], e.belt, 0.0)
    scene.hold(belt.nodes() + [right, left], x=0)
    scene.hold(held)
    scene.curve(91, [(0.0, e.belt), (1.0e3, e.belt)])
    scene.curve(92, [(0.0, e.normal), (1.0e3, e.normal)])
    moved = scene.node_set(belt.nodes())
    scene.cards += ["*BOUNDARY_PRESCRIBED_MOTION_SET", "%d,1,0,91,1.0" % moved]
    scene.cards += ["*LOAD_NODE_POINT", "%d,2,92,-1.0" % tip]
    friction = friction or "%r,%r,%r" % (e.static, e.kinetic, 1.0e4 / e.belt)
    scene.cards += ["*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE", "2,1,,," + friction]
    scene.tables += ["RCFORC", "SLEOUT"]
    scene.scheme = scheme + ","
    return scene.text()


def closes(name, folder):
    at_most(np.abs(table(folder, "glstat")["residual"]).max(), LEDGER, name + ": ledger")


def times_of(folder):
    """Periods, and times of sticking after the first slip."""
    force = table(folder, "rcforc", side=1)
    sticks = force["nslip"] == 0
    change = np.flatnonzero(sticks[1:] != sticks[:-1]) + 1
    at, sticks = force["time"][change], sticks[change]
    release, capture = at[~sticks], at[sticks]
    return np.diff(release), release[1:] - capture[: len(release) - 1]


def times():
    """A status changes at the end of a step, each at most one step late or early: 2 h on a time
    between two of them, and 2 h more for the undamped part that theta = .55 takes. The bounds
    fall with the step; at the finest they must be below 5e-3 of the time itself. The
    elastic block rings at each change of friction: without damping (theta = 1/2) that ringing,
    which no rigid block has, starts the slip."""
    for scheme in ("THETA,0.55,0.55", "MOREAU,0.55"):
        for dt in (0.02, 0.01, 0.005):
            name = "%s, step %g" % (scheme, dt)
            folder, code, errors = run_text("oscillator", oscillator(dt, scheme))
            check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
            closes(name, folder)
            period, stick = times_of(folder)
            check(len(period) >= 2, "%s: %d periods" % (name, len(period)))
            at_most(np.abs(period - EXACT.period).max(), 2.0 * dt, name + ": period")
            at_most(np.abs(stick - EXACT.stick).max(), 2.0 * dt, name + ": time of sticking")
        at_most(np.abs(period / EXACT.period - 1.0).max(), 5.0e-3, scheme + ": period, relative")
        at_most(np.abs(stick / EXACT.stick - 1.0).max(), 5.0e-3, scheme + ": sticking, relative")
    work = table(folder, "glstat")["friction"]
    check((np.diff(work) >= -1.0e-15).all(), "friction only takes energy")


def constant():
    """Where DC = 0, or FD = FS, the law is that of FS: the same bytes in every table."""
    tables = {}
    for name, friction in (("plain", "0.4"), ("no decay", "0.4,0.1"), ("equal", "0.4,0.4,3.0")):
        folder, code, errors = run_text(
            "constant", oscillator(0.02, "THETA,0.55,0.55", friction, tend=10.0)
        )
        check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
        for tab in ("glstat", "rcforc", "sleout", "nodout", "matsum"):
            with open(os.path.join(folder, tab + ".tab")) as file:
                tables.setdefault(tab, []).append(file.read())
    for tab, texts in tables.items():
        check(texts[0] == texts[1] == texts[2], tab + ": FS alone")
    folder, code, _ = run_text("falls", oscillator(0.02, "THETA,0.55,0.55", "0.4,0.1,3.0", 10.0))
    with open(os.path.join(folder, "nodout.tab")) as file:
        check(file.read() != tables["nodout"][0], "a law that falls gives another motion")


def law():
    """The oscillator with a law that falls as far as it may over all its speeds: r_t = mu(v) r_n with
    v = slip/h of ncforc, in every step that slips, to the tolerance of a solve (TOL 1e-10, a
    tenth of it for mu) in units of mu_s."""
    fs, fd, dc, dt = 0.4, 0.2, 60.0, 0.01
    text = oscillator(dt, "THETA,0.55,0.55", "%r,%r,%r" % (fs, fd, dc), tend=20.0)
    text = text.replace("*DATABASE_RCFORC", "*DATABASE_NCFORC\n%r,\n*DATABASE_RCFORC" % dt)
    folder, code, errors = run_text("law", text)
    check(code == 0, "law: exit code %d: %s" % (code, errors))
    closes("law", folder)
    rows = table(folder, "ncforc")
    rows = rows.select(node=int(rows["node"][rows["status"] == 2][0]))
    slips = rows["status"] == 2
    check(slips.sum() > 100, "law: it slips")
    mu = fd + (fs - fd) * np.exp(-dc * np.abs(rows["slip"][slips]) / dt)
    check(mu.min() < fs - 0.5 * (fs - fd), "law: friction falls by half of what it may")
    found = np.abs(rows["fx"][slips] / rows["fy"][slips])
    at_most(np.abs(found - mu).max() / fs, 1.0e-9, "law: friction at the speed of slip")


def random_blocks():
    """Elastic blocks on an elastic base, laws from flat to steeper than a step resolves, every
    scheme: the law is found in every step, or the run ends (none of 1000 such did); the ledger
    closes."""
    rng = random.Random(11)
    schemes = ("THETA,0.5", "THETA,0.55,0.55", "MOREAU,0.5", "NEWMARK", "PAOLI", "NSGENALPHA",
               "THETAPV", "CSNEWMARK", "GENALPHA")  # fmt: skip
    for k in range(36):
        scheme, dt = schemes[k % len(schemes)], rng.choice([5.0e-4, 2.0e-3, 1.0e-2])
        scene = Scene(dt=dt, steps=round(0.2 / dt))
        base = scene.body(
            rng.choice([4, 7, 12]), 1, box(-1.0, -0.5, 6.0, 0.5), density=1.0, young=1.0e4
        )
        height, young = rng.choice([0.3, 0.6, 1.0]), 10.0 ** rng.uniform(2.5, 5.0)
        block = scene.body(
            rng.choice([1, 3, 8]), 1, box(0.0, 0.0, 1.0, height), density=1.0, young=young
        )
        scene.hold(base.row(0))
        scene.kick(block.nodes(), rng.choice([0.0, 0.1, 0.5, 1.0]), 0.0)
        scene.gravity(10.0)
        fs, share = rng.choice([0.3, 0.6, 1.0]), rng.choice([0.0, 0.3, 0.7])
        dc = 10.0 ** rng.uniform(-1.0, 5.0)
        scene.cards += ["*CONTACT_2D_AUTOMATIC_SURFACE_TO_SURFACE"]
        scene.cards += ["2,1,,,%r,%r,%r" % (fs, fs * share, dc)]
        scene.tables, scene.scheme = ["GLSTAT"], scheme + ","
        name = "random %d, %s" % (k, scheme)
        folder, code, errors = run_text("random", scene.text())
        check(code == 0 and "certificate" not in errors, "%s: %d %s" % (name, code, errors))
        if code == 0:
            closes(name, folder)
    show("36 random blocks")


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
