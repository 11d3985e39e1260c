"""Damping of the deck: closed forms and their orders, the ledger of every scheme and mass, a block that
comes to rest. Every bound has its reason beside it."""

import os
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import numpy as np
from scenes import at_most, check, deck, finish, run_text, table, two_blocks, within

# Scheme card, and that of GAMMA, BETA, ALPHA; the order of each in smooth motion.
SCHEMES = {
    "THETA": ("THETA,0.5,0.5", "", 2),
    "THETA1": ("THETA,1.0,1.0", "", 1),
    "NEWMARK": ("NEWMARK", "", 2),
    "NEWMARK6": ("NEWMARK", "1,0.6,0.31", 1),
    "HHT": ("HHT", "1,,,,,,,-0.2", 2),
    "GENALPHA": ("GENALPHA,,,,0.6", "", 2),
    "PAOLI": ("PAOLI", "", 2),
    "MOREAU": ("MOREAU,0.5,0.5", "", 2),
    "CDLAGRANGE": ("CDLAGRANGE,", "", 1),    # C V-, of the half step before
    "THETAPV": ("THETAPV,", "", 2),
    "CSNEWMARK": ("CSNEWMARK,", "", 2),
}
# Conventions of the ledger: a step 1e-12, a run 1e-11 of the largest term (round-off of the sums).
STEP, RUN = 1.0e-12, 1.0e-11


LONG_STEPS = [scheme for scheme in SCHEMES if scheme != "CDLAGRANGE"]    # beyond the limit
PLAIN = ("CONSISTENT,0", "LUMPED,0")
MASSES = {    # that a scheme takes, where not all
    "PAOLI": PLAIN + ("DISPERSION,0",),
    "MOREAU": PLAIN + ("DISPERSION,0",),
    "CDLAGRANGE": ("LUMPED,0",),
    "THETAPV": PLAIN,
    "CSNEWMARK": PLAIN,
}


def curve(number, first, end, last):
    return ["*DEFINE_CURVE", "%d," % number, "0.0,%r" % first, "%r,%r" % (end, last)]


def run(name, text, scheme, *options):
    """Runs a deck with a scheme of the table; returns its folder."""
    card, alpha, _ = SCHEMES[scheme]
    text = text.replace("SCHEME", card)
    if alpha:
        text = text.replace("*CONTROL_IMPLICIT_DYNAMICS\n1,", "*CONTROL_IMPLICIT_DYNAMICS\n" + alpha)
    folder, code, errors = run_text(name + "_" + scheme, text, *options)
    check(code == 0, "%s %s: exit code %d: %s" % (name, scheme, code, errors))
    return folder


def close(folder, name):
    """The ledger of a run, step by step and as a whole."""
    g = table(folder, "glstat")
    misfit = g["total"] - g["initial"] - g["external"] - g["motion"] + g["friction"] + g["contact"]
    misfit = misfit - g["unsolved"] + g["algorithmic"] + g["damping"]
    terms = "total initial external motion friction contact algorithmic damping".split()
    largest = max(np.abs(g[t]).max() for t in terms)
    at_most(np.abs(np.diff(misfit)).max() / largest, STEP, name + ": ledger of a step")
    at_most(np.abs(g["residual"]).max(), RUN, name + ": ledger of the run")
    return g


# A bar of n elements, held at the left, that starts in its first mode.

N, LENGTH, YOUNG = 8, 1.0, 1.0


def bar(dt, tend, cards):
    nodes = [(2 * i + j + 1, i * LENGTH / N, 0.1 * j) for i in range(N + 1) for j in (0, 1)]
    lines = ["*NODE"] + ["%d,%r,%r" % n for n in nodes] + ["*ELEMENT_SHELL"]
    lines += ["%d,1,%d,%d,%d,%d" % (i, 2 * i - 1, 2 * i + 1, 2 * i + 2, 2 * i) for i in range(1, N + 1)]
    lines += ["*PART", "bar", "1,1,1", "*SECTION_SHELL", "1,13", "1.0,"]
    lines += ["*MAT_ELASTIC", "1,1.0,%r,0.0" % YOUNG, "*BOUNDARY_SPC_NODE", "1,0,1,1", "2,0,1,1"]
    lines += ["%d,0,0,1" % n[0] for n in nodes[2:]]
    lines += ["*INITIAL_VELOCITY_NODE"]
    lines += ["%d,%r" % (n[0], float(np.sin(0.5 * np.pi * n[1] / LENGTH))) for n in nodes[2:]]
    return deck(lines, dt, tend, scheme="SCHEME", history=[2 * N + 1], extra=cards)


def frequency():
    """Of the first mode of the bar with consistent mass: w^2 = (6 c^2/h^2)(1 - cos)/(2 + cos)."""
    h = LENGTH / N
    cosine = np.cos(0.5 * np.pi / N)
    return float(np.sqrt(6.0 * YOUNG / h**2 * (1.0 - cosine) / (2.0 + cosine)))


def decay():
    """Free decay in a mode: u = exp(-z w t) sin(w_d t)/w_d, z w = (a + b w^2)/2, w_d^2 = w^2 -
    (z w)^2, exact for the mesh; so what is left is the error in time, of the order of the scheme
    (0.1 about it: the next term of the error at 80 steps a period): a phase of (w h)^2/12 w T = 2e-4
    for the second, an amplitude of about w^2 h T/2 = 6e-2 of one that decays, 2e-2, for the first."""
    w = frequency()
    a, b = 0.4 * w, 0.3 / w
    rate = 0.5 * (a + b * w**2)
    damped = np.sqrt(w**2 - rate**2)
    tend = 4.0
    cards = ["*DAMPING_GLOBAL", "0,%r" % a, "*DAMPING_PART_STIFFNESS", "1,%r" % -b]
    for scheme in LONG_STEPS:
        errors = []
        for steps in (80, 160, 320):
            folder = run("decay%d" % steps, bar(tend / steps, tend, cards), scheme)
            g = close(folder, "decay, %s" % scheme)
            rows = table(folder, "nodout")
            exact = np.exp(-rate * rows["time"]) * np.sin(damped * rows["time"]) / damped
            errors.append(np.abs(rows["ux"] - exact).max() / np.abs(exact).max())
        check(g["damping"][-1] > 0.5 * g["initial"][-1], "decay, %s: half of the energy" % scheme)
        order = SCHEMES[scheme][2]
        for fine in (1, 2):
            within(
                np.log2(errors[fine - 1] / errors[fine]),
                order - 0.1,
                order + 0.1,
                "decay, %s: order" % scheme,
            )
        at_most(errors[2], 2.0e-4 if order == 2 else 2.0e-2, "decay, %s: error" % scheme)


def flight():
    """A free block under damping by mass with a(t) = s t in x alone: v_x = exp(-s t^2/2), v_y stays. A
    curve that changes is a factor for each step; the order is that of the scheme."""
    s, tend = 2.0, 1.0
    lines, _ = two_blocks(base=(1.0, 1.0), gap=1.0, poisson=0.3)
    lines += curve(1, 0.0, tend, s * tend)
    lines += ["*INITIAL_VELOCITY", "0,", "1.0,1.0"]
    cards = ["*DAMPING_GLOBAL", "1,0.0,1.0"]
    for scheme in LONG_STEPS:
        errors = []
        for steps in (80, 160):
            text = deck(lines, tend / steps, tend, scheme="SCHEME", history=[1], extra=cards)
            folder = run("flight%d" % steps, text, scheme)
            close(folder, "flight, %s" % scheme)
            rows = table(folder, "nodout")
            # PAOLI gives the velocity of the middle of the last step.
            at = rows["time"] - (0.5 * tend / steps if scheme == "PAOLI" else 0.0)
            exact = np.exp(-0.5 * s * at[1:] ** 2)
            errors.append(np.abs(rows["vx"][1:] - exact).max())
            # What nothing damps keeps its momentum, to the round-off of a solve a step.
            at_most(np.abs(rows["vy"] - 1.0).max(), RUN, "flight, %s: vy" % scheme)
            with open(os.path.join(folder, "bipact.log")) as log:
                matrices = 2 if scheme in ("THETAPV", "CSNEWMARK") else 1
                wanted = "factorisations %d," % (matrices * steps)
                check(wanted in log.read(), "flight, %s: factors" % scheme)
        order = SCHEMES[scheme][2]
        within(np.log2(errors[0] / errors[1]), order - 0.1, order + 0.1, "flight, %s: order" % scheme)


def ledgers():
    """Two blocks that meet obliquely with friction, loads, a moved edge, damping by mass with a curve
    on one part and by stiffness on both: each scheme, each mass it takes."""
    lines, sets = two_blocks(young=1.0e3, base=(3.0, 1.0), gap=0.01, ny=(3, 3))
    lines += curve(1, 3.0, 0.1, 8.0) + curve(2, 0.0, 0.1, 1.0)
    lines += ["*INITIAL_VELOCITY_GENERATION", "2,2,0.0,1.0,-2.0", ","]
    lines += ["*SET_NODE_LIST", "3,", "1,5,9,"]
    lines += ["*BOUNDARY_PRESCRIBED_MOTION_SET", "3,2,2,2,0.01", "*BOUNDARY_SPC_SET", "3,0,1,0"]
    lines += ["*LOAD_BODY_Y", "2,20.0"]
    cards = ["*DAMPING_PART_MASS", "2,1,1.5", "*DAMPING_PART_STIFFNESS", "1,-2e-3", "2,-1e-3"]
    for scheme in SCHEMES:
        for mass in ("CONSISTENT,0", "LUMPED,0", "DISPERSION,0", "CONSISTENT,1", "DISPERSION,1"):
            if mass not in MASSES.get(scheme, (mass,)):
                continue
            text = deck(lines, 1.0e-3, 0.1, scheme="SCHEME", mass=mass, mu=0.4, extra=cards)
            folder = run("ledger_" + mass.replace(",", ""), text, scheme)
            g = close(folder, "%s, %s" % (scheme, mass))
            check(g["damping"][-1] > 0.01 * g["initial"][-1], "%s, %s: damping" % (scheme, mass))
            if not scheme.startswith("NEWMARK"):
                check(g["friction"][-1] > 0.0, "%s, %s: friction" % (scheme, mass))


def parts_add_up():
    """The same coefficient by one card of all parts, by a card for each, and by the set of all: each
    element has the same number, so the tables are the same."""
    lines, _ = two_blocks(base=(1.0, 1.0), gap=0.02)
    lines += curve(1, 2.0, 1.0, 2.0) + ["*INITIAL_VELOCITY_GENERATION", "2,2,0.0,0.3,-2.0", ","]
    lines += ["*SET_PART_LIST", "13,", "1,2"]
    for mass in ("CONSISTENT,0", "DISPERSION,1"):
        runs = []
        for k, cards in enumerate(
            (
                ["*DAMPING_GLOBAL", "0,2.0", "*DAMPING_PART_STIFFNESS_SET", "13,-1e-4"],
                ["*DAMPING_PART_MASS", "1,1", "2,1", "*DAMPING_PART_STIFFNESS", "1,-1e-4", "2,-1e-4"],
                ["*DAMPING_PART_MASS_SET", "13,1", "*DAMPING_PART_STIFFNESS", "2,-1e-4", "1,-1e-4"],
            )
        ):
            text = deck(lines, 1e-3, 0.05, scheme="SCHEME", mass=mass, mu=0.2, history=[1], extra=cards)
            folder = run("sum%d" % k, text, "THETA")
            runs.append(open(os.path.join(folder, "glstat.tab")).read())
        check(runs[1] == runs[0], "%s: a card for each part" % mass)
        check(runs[2] == runs[0], "%s: a card of the set" % mass)


def incline():
    """A block on an incline of 30 degrees, mu 0.6, whose weight grows over half a second. Without damping
    it rings and creeps; with damping of a tenth of the critical one of its lowest mode (about
    100/T) it is at rest at the end."""
    text = INCLINE
    folders = {}
    for name, card in (("free", ""), ("damped", "*DAMPING_GLOBAL\n0,20.0\n")):
        folder, code, errors = run_text("incline_" + name, text.replace("*END", card + "*END"))
        check(code == 0, "incline, %s: exit code %d: %s" % (name, code, errors))
        folders[name] = folder
    rows = table(folders["damped"], "nodout")
    late = rows["time"] >= 1.5
    for column in ("ux", "uy"):
        at_most(np.ptp(rows[column][late]), 1.0e-6, "incline, damped: " + column)
    at_most(np.abs(rows["vmx"][late]).max(), 1.0e-6, "incline, damped: vx")
    close(folders["damped"], "incline, damped")
    rows = table(folders["free"], "nodout")
    check(np.ptp(rows["ux"][rows["time"] >= 1.5]) > 0.01, "incline: without damping it creeps")


def block():
    ids = 1 + np.arange(24).reshape(4, 6)
    out = ["*NODE"]
    out += ["%d,%r,%r" % (ids[j, i], 0.2 * i, j / 6) for j in range(4) for i in range(6)]
    out += ["*ELEMENT_SHELL"]
    out += [
        "%d,1,%d,%d,%d,%d" % (5 * j + i + 1, ids[j, i], ids[j, i + 1], ids[j + 1, i + 1], ids[j + 1, i])
        for j in range(3)
        for i in range(5)
    ]
    return out


S, C = 0.5, 0.75**0.5
INCLINE = deck(
    block()
    + ["*PART", "block", "1,1,1", "*SECTION_SHELL", "1,12", "1.0,", "*MAT_ELASTIC", "1,1.0,1000.0,0.3"]
    + curve(1, 0.0, 0.5, 10.0)
    + ["*LOAD_BODY_X", "1,%r" % S, "*LOAD_BODY_Y", "1,%r" % C]
    + ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,0.0,0.0,1.0,0.0,0.6"],
    1.0e-3,
    2.0,
    history=[24],
)


def statics():
    """Damping has no effect in statics, which a note says; and none in a static phase."""
    plain = INCLINE.replace("*BIPACT_TIME\nTHETA,0.5,0.5,\n*BIPACT_MASS\nCONSISTENT,0,\n", "")
    plain = plain.replace("DYNAMICS\n1,", "DYNAMICS\n0,").replace("0.001", "0.05")
    card = "*DAMPING_GLOBAL\n0,20.0\n*DAMPING_PART_STIFFNESS\n1,-0.01\n"
    tabs = []
    for name, text in (("plain", plain), ("damped", plain.replace("*END", card + "*END"))):
        folder, code, errors = run_text("static_" + name, text)
        check(code == 0, "static: exit code %d: %s" % (code, errors))
        tabs.append(open(os.path.join(folder, "nodout.tab")).read())
        with open(os.path.join(folder, "bipact.log")) as log:
            said = "the analysis is static: damping has no effect" in log.read()
        check(said == (name == "damped"), "static, %s: the note" % name)
    check(tabs[0] == tabs[1], "static: damping changes nothing")
    start = INCLINE.replace("DYNAMICS\n1,", "DYNAMICS\n1,,,0.5").replace("*END", card + "*END")
    moved = start.replace("*END", "*INITIAL_VELOCITY\n0,\n0.0,0.2\n*END")
    for scheme in LONG_STEPS:
        for name, text in (("static start", start), ("thrown", moved)):
            text = text.replace("THETA,0.5,0.5", SCHEMES[scheme][0])
            if SCHEMES[scheme][1]:
                card = SCHEMES[scheme][1].split(",") + [""] * 3
                card[3] = "0.5"
                text = text.replace("DYNAMICS\n1,,,0.5", "DYNAMICS\n" + ",".join(card[:8]))
            folder, code, errors = run_text("%s_%s" % (name.replace(" ", "_"), scheme), text)
            check(code == 0, "%s, %s: exit code %d: %s" % (name, scheme, code, errors))
            g = close(folder, "%s, %s" % (name, scheme))
            if name == "thrown":
                check(g["damping"][-1] > 0.2 * g["kinetic"].max(), "thrown, %s: damping" % scheme)
            else:
                # A state of rest stays: nothing is left to damp but round-off.
                most = 1e-12 * g["internal"].max()
                at_most(np.abs(g["damping"]).max(), most, "%s, %s: damping" % (name, scheme))


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
