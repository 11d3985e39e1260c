"""Runs the decks of input/catalogue and the lessons that belong to them, and compares with the closed
forms of scripts/analytic.py. Every bound has its reason beside it."""

import glob
import math
import os
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import numpy as np
import scenes
from lessons import expected, solved
from scenes import at_most, check, finish, table

import analytic
from contact_errors import face_of, flat_face, off_nodes
import make_scenes

FOLDER = os.path.join(scenes.ROOT, "input", "catalogue")
LESSONS = os.path.join(scenes.ROOT, "input", "lessons")
# Meshes that make_scenes.py writes: scene and options.
MESHES = {
    "hertz": ("hertz", dict(ratio=1.5)),
    "cylinder": ("cylinder", dict(ratio=1.5)),
    "westergaard": ("westergaard", dict(upper=24, lower=16)),
    "punch": ("punch", dict(n=20)),
    "mass_on_rod": ("mass_on_rod", dict(part=1)),
}


def face(name, folder, side):
    """Place, length, force x and y, pressure of the nodes at y = 0 of a side, at the end."""
    return face_of(flat_face(os.path.join(FOLDER, name + "_mesh.k")), folder, side)


def of(folder, name, column, **ids):
    """Its last value."""
    return table(folder, name, **ids)[column][-1]


def hertz(folder):
    """The theory is good to b/R = .04 squared; the scale of the error of a node's pressure is h/b = .19 of the
    coarser face squared, 3.7e-2, near the ends of contact alone: over the face 2.5e-2, as mortar.py. Shear in x mixes with pressure by half the slope of the faces over mu, .13/2: 7e-2."""
    normal, tangential = abs(of(folder, "rcforc", "fy", side=2)), abs(of(folder, "rcforc", "fx", side=2))
    exact = analytic.Hertz(1.0, 1000.0 / (1.0 - 0.3**2) / 2.0, normal)
    x, length, fx, fy, _ = face("hertz", folder, 2)
    at_most(off_nodes(length, np.abs(fy) / length, exact.pressure(x)), 2.5e-2, "Hertz: pressure")
    shear = exact.shear(x, 0.3, tangential)
    at_most(off_nodes(length, np.abs(fx) / length, shear), 7.0e-2, "Cattaneo, Mindlin: shear")
    check(0.4 < tangential / (0.3 * normal) < 0.6, "Cattaneo, Mindlin: a part sticks")


def cylinder(folder):
    """The closed form has the figures of the benchmark to their digits. Pressure: 2.5e-2 as in
    Hertz, whose h/b it has, and part of what the theory is worth here, (b/R)^2 = 1.5e-2: 3e-2."""
    exact = analytic.Hertz(50.0, 1.0 / ((1.0 - 0.3**2) * (1.0 / 210.0e3 + 1.0 / 70.0e3)), 35.0e3)
    at_most(abs(exact.largest - 3585.4), 0.05, "NAFEMS 1: largest pressure of the benchmark")
    at_most(abs(exact.half_width - 6.2147), 1.0e-4, "NAFEMS 1: half width of the benchmark")
    x, length, _, fy, _ = face("cylinder", folder, 2)
    off = off_nodes(length, np.abs(fy) / length, exact.pressure(x))
    at_most(off, 3.0e-2, "NAFEMS 1: pressure")


def westergaard(folder):
    """1 % of the largest at 32 edges, first order: 2 % at 16."""
    modulus = 1000.0 / (1.0 - 0.3**2) / 2.0
    exact = analytic.Westergaard(2.0, math.pi * modulus * 1.0e-3 / 2.0, 0.36403)
    x, _, _, _, p = face("westergaard", folder, 2)
    inner = x < 0.8 * exact.half_width
    check(inner.sum() >= 5, "Westergaard: nodes in the inner part")
    off = np.abs(p - exact.pressure(x))[inner].max() / exact.pressure(0.0)
    at_most(off, 2.0e-2, "Westergaard: inner pressure")


def punch(folder):
    """1.5 % at 40 edges, first order: 3 % at 20."""
    load = 2.0 * abs(of(folder, "rcforc", "fy", side=1))
    _, _, _, fy, _ = face("punch", folder, 1)
    inside = 2.0 * (np.abs(fy[:18]).sum() + 0.5 * abs(fy[18]))
    off = abs(inside / analytic.punch_force(load, 0.9) - 1.0)
    at_most(off, 3.0e-2, "punch: force on .9 of it")


def signorini_rod(folder):
    """Exact for these elements; round-off of coordinates, 1e-16, over the way, 1e-2, and TOL 1e-13: 1e-12."""
    force = table(folder, "rcforc", side=1)
    for k, way in ((1, 0.015), (2, 0.03)):
        exact = analytic.press_fit(way - 0.01, (1.0, 1.0), (1000.0, 1000.0))
        at_most(abs(force["fn"][k] / exact - 1.0), 1.0e-12, "Signorini's rod: force at %g" % way)
    rows = table(folder, "ncforc")
    pressed = rows["pressure"][(rows["time"] == 1.0) & (rows["pressure"] > 0.0)]
    at_most(np.abs(pressed / exact - 1.0).max(), 1.0e-12, "Signorini's rod: uniform pressure")


def rigid_bowl(folder):
    """As tests/decks/walls.py rigid_bowl: energy to 1e-10 of that of the swing over 5000 steps; the period
    is long by (w h)^2/12 = 8e-7: 1e-5; corners on the circle to 2e-14, round-off of rounds that end where
    nothing changes."""
    exact, swing = analytic.GlidingBlock(1.0, 0.6, 0.5), math.asin(0.28)
    rows, part = table(folder, "glstat"), table(folder, "rbdout")
    drift = (rows["total"] - rows["external"]) / rows["kinetic"].max()
    at_most(np.abs(drift).max(), 1.0e-10, "bowl: energy")
    t, angle = part["time"], swing + part["rz"]
    k = np.nonzero(angle[:-1] * angle[1:] < 0.0)[0]
    zero = t[k] - angle[k] * (t[k + 1] - t[k]) / (angle[k + 1] - angle[k])
    off = np.abs((zero[2:] - zero[:-2]) / exact.period(False, swing) - 1.0)
    check(len(off) == 3, "bowl: it swings")
    at_most(off.max(), 1.0e-5, "bowl: period")
    gap = np.abs(table(folder, "rwforc")["gapmin"][1:]).max()
    at_most(gap, 2.0e-14, "bowl: corners on the circle")


def disc_impact(folder):
    """One solve of three unknowns: round-off with the digits of the gap at the touch, 1e-12."""
    for part, along, way in ((1, 0.2, "stick"), (2, 3.0, "slip")):
        exact = analytic.disc_impact(0.5, 0.125, 0.3, 0.5, along, 1.0)
        found = [of(folder, "rbdout", c, part=part) for c in ("vx", "vy", "wz")]
        at_most(np.abs(np.subtract(found, exact)).max(), 1.0e-12, "disc: velocities, " + way)


def three_in_a_row(folder):
    """TOL 1e-14 of W: 1e-12."""
    for part, exact in enumerate(analytic.three_in_a_row(0.5), 1):
        error = abs(of(folder, "rbdout", "vx", part=part) - exact)
        at_most(error, 1.0e-12, "three in a row: body %d" % part)


def mass_on_rod(folder):
    """The mid-point rule: 0.33 z^2 of the mean force, z = Z h/M = 1e-2 (walls.py mass_on_rod)."""
    rows = table(folder, "rcforc", side=2)
    t, force = rows["time"][2:] - 1.0e-4, rows["fmx"][2:]
    exact = analytic.mass_on_rod(1.0, 0.01, 1.0, t)
    off = np.abs(force - exact).mean() / exact.mean()
    at_most(off, 0.33e-4, "mass on a rod: force")


def press_fit(folder):
    """Linear: round-off times a condition of 1e3 (press_fit.py)."""
    exact = analytic.press_fit(0.01, (2.0, 3.0), (1000.0, 4000.0))
    force = table(folder, "rcforc", side=1)
    off = np.abs(force["fn"] / exact - force["time"]).max()
    at_most(off, 1.0e-9, "press fit: force that grows evenly")


def stick_slip(folder):
    """A status changes at the end of a step, one late or early, at both ends of a time: two steps of 0.01
    (stick_slip.py times)."""
    exact, rows = analytic.StickSlip(), table(folder, "rcforc", side=1)
    sticks = rows["nslip"] == 0
    change = rows["time"][np.flatnonzero(sticks[1:] != sticks[:-1]) + 1]
    check(len(change) == 2, "stick-slip: it slips once")
    first = (exact.kinetic * exact.normal / exact.stiffness + exact.excess) / exact.belt
    at_most(abs(change[0] - first), 0.02, "stick-slip: first slip")
    at_most(abs(change[1] - change[0] - exact.slip), 0.02, "stick-slip: time of slipping")


def main():
    decks = sorted(p for p in glob.glob(os.path.join(FOLDER, "*.k")) if not p.endswith("_mesh.k"))
    names = [os.path.basename(path)[:-2] for path in decks]
    for name, (scene, options) in MESHES.items():
        fresh = os.path.join(scenes.TMP, name + "_mesh.k")
        make_scenes.write(fresh, scene, mesh=True, **options)
        kept = open(os.path.join(FOLDER, name + "_mesh.k")).read()
        check(open(fresh).read() == kept, name + "_mesh.k is what make_scenes.py writes")
    listed = open(os.path.join(scenes.ROOT, "input", "README.md")).read()
    for name, deck in zip(names, decks):
        check("`catalogue/%s.k`" % name in listed, name + ".k is named in input/README.md")
        folder = solved(deck)
        expected(name, deck, folder)
        globals()[name](folder)
    check(len(names) == 9, "nine decks of the catalogue, not %d" % len(names))
    for lesson in (press_fit, stick_slip):
        lesson(solved(os.path.join(LESSONS, lesson.__name__ + ".k")))


if __name__ == "__main__":
    main()
    finish()
