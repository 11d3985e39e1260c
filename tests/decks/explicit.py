"""Explicit runs (PAOLI with PBETA 0): accuracy on impact, the limit of the step, energy at 0.9 of it,
what decks may say. Every bound has its reason beside it. LONG=1 takes 1e5 steps where it says so."""

import os
import re
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import numpy as np
import bodies
import scenes
from scenes import at_most, bars, check, finish, run_text, table, within

# Sums of round-off over a run, as for every scheme (tests/decks/schemes.py).
LEDGER = 1.0e-11
EXPLICIT = "PAOLI,,,,,,0.0"
GENERAL = re.compile(r"\*CONTROL_IMPLICIT_GENERAL\n.*\n")
DYNAMICS = "*CONTROL_IMPLICIT_DYNAMICS\n1,\n"


def noted(folder):
    """(DT0, limit, element) of the note that says how the step was found."""
    log = open(os.path.join(folder, "bipact.log")).read()
    found = re.search(r"NOTE DT0 is (\S+): .* times (\S+), the limit of element (\d+)", log)
    return float(found[1]), float(found[2]), int(found[3])


def thrown_block(seed, poisson, mu=0.3):
    """A block of distorted quadrilaterals under its weight, thrown obliquely on a rigid floor."""
    random = np.random.default_rng(seed)
    nx, ny = 8, 6
    jitter = 0.5 * (random.random((nx + 1, ny + 1, 2)) - 0.5)
    jitter[:, 0, 1] = 0.0  # the floor sees a straight edge

    def shape(a, b):
        i, j = round(a * nx), round(b * ny)
        x, y = (i, j) + jitter[i, j]
        return float(x) / nx, 0.02 + float(y) / ny

    scene = bodies.Scene()
    scene.scheme = EXPLICIT
    block = scene.body(nx, ny, shape, velocity=(0.3, -1.0), poisson=poisson)
    scene.gravity(40.0)
    scene.wall(block.nodes(), (0.0, 0.0), (0.0, 1.0), mu)
    scene.tables = ["GLSTAT", "RWFORC"]
    return scene


def with_step(scene, limit, steps, dt0=""):
    """Its deck: as many steps as at 0.9 of the limit, DT0 as given (blank: found)."""
    scene.dt, scene.steps = 0.9 * limit, steps
    scene.every = 4.0 * scene.dt
    text = scene.text()
    return GENERAL.sub("*CONTROL_IMPLICIT_GENERAL\n0,%s\n" % dt0, text)


def energy():
    """At 0.9 of the limit: the energy is never above the start and the work of the weight by more
    than 1e-9 of its largest term: the scheme gives none, what is left is round-off and the
    tolerance of the contact solve (1e-10). Without friction it is not above its lowest value so far
    either; friction of PAOLI may give a little back in a rare step (1.4e-5 seen), as its slip is
    that of the step and its work that of two."""
    steps = 100000 if os.environ.get("LONG") else 4000
    for seed, poisson, mu in ((1, 0.0, 0.3), (2, 0.3, 0.3), (3, 0.45, 0.3), (4, 0.45, 0.0)):
        scene = thrown_block(seed, poisson, mu)
        name = "nu %g, mu %g" % (poisson, mu)
        folder, code, errors = run_text("first", with_step(scene, 1.0e-6, 10))
        check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
        _, limit, element = noted(folder)
        folder, code, errors = run_text("block", with_step(scene, limit, steps))
        check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
        dt, again, _ = noted(folder)
        check(again == limit, name + ": the limit does not depend on the end")
        low = 0.9 * (1.0 - 1.0 / steps)  # the log has seven digits
        within(dt / limit, low, 0.9 * (1.0 + 1.0e-6), name + ": DT0 of the limit")
        rows, wall = table(folder, "glstat"), table(folder, "rwforc")
        balance = rows["total"] - rows["external"]
        largest = np.abs(rows["external"]).max() + rows["initial"].max()
        gained = balance - rows["initial"]
        at_most(gained.max() / largest, 1.0e-9, name + ": energy above the start")
        if not mu:
            gained = balance - np.minimum.accumulate(balance)
            at_most(gained.max() / largest, 1.0e-9, name + ": energy above its lowest so far")
        at_most(np.abs(rows["residual"]).max(), LEDGER, name + ": ledger")
        check((wall["fy"] > 0.0).mean() > 0.05, name + ": there is contact")
        refused_above(scene, name, limit, element)


def damped():
    """Damping acts with the velocity of the half step before, which makes the limit lower: at the
    limit that the note tells (TSSFAC 1) the energy never rises; the limit without damping is
    refused."""
    scene = thrown_block(5, 0.3, 0.0)
    plain, code, errors = run_text("undamped", with_step(scene, 1.0e-6, 10))
    check(code == 0, "undamped: exit code %d: %s" % (code, errors))
    free, omega = noted(plain)[1], 2.0 / noted(plain)[1]
    stiff, mass = 0.5 / omega, 0.3 * omega
    cards = "*DAMPING_PART_STIFFNESS\n%d,%r\n" % (1, -stiff) + "*DAMPING_GLOBAL\n0,%r\n" % mass
    scene.dt, scene.steps, scene.every = 0.5 * free, 4000, free
    text = scene.text().replace("*END", "*CONTROL_TIMESTEP\n0.0,1.0\n" + cards + "*END")
    text = GENERAL.sub("*CONTROL_IMPLICIT_GENERAL\n0,\n", text)
    folder, code, errors = run_text("damped", text)
    check(code == 0, "damped: exit code %d: %s" % (code, errors))
    rate = mass + stiff * omega**2
    exact = 4.0 / (rate + np.sqrt(rate**2 + 4.0 * omega**2))
    at_most(abs(noted(folder)[1] / exact - 1.0), 2.0e-6, "damped: the limit, in seven digits")
    rows = table(folder, "glstat")
    balance = rows["total"] - rows["external"]
    largest = max(np.abs(rows["external"]).max(), rows["initial"].max())
    at_most((balance - rows["initial"]).max() / largest, 1.0e-9, "damped: energy above the start")
    at_most(np.abs(rows["residual"]).max(), LEDGER, "damped: ledger")
    check(rows["damping"][-1] > 0.01 * largest, "damped: damping does work")
    text = GENERAL.sub("*CONTROL_IMPLICIT_GENERAL\n0,%.17g\n" % free, text)
    _, code, errors = run_text("over", text)
    check(code == 2 and "the limit of element" in errors, "damped: the undamped limit: " + errors)


def refused_above(scene, name, limit, element):
    """DT0 at the limit runs, 1 % above it is refused, with the element and the cards."""
    _, code, errors = run_text("over", with_step(scene, limit, 10, "%.17g" % (1.01 * limit)))
    check(code == 2, "%s: 1 %% above the limit: exit code %d" % (name, code))
    for word in ("the limit of element %d:" % element, "*BIPACT_TIME", "*CONTROL_TIMESTEP"):
        check(word in errors, "%s: 1 %% above the limit: %s" % (name, errors))
    _, code, errors = run_text("under", with_step(scene, limit, 10, "%.17g" % limit))
    check(code == 0, "%s: at the limit: exit code %d: %s" % (name, code, errors))


def impact():
    """Two bars of 100 elements, touches at 0, 1/4, 1/2, 3/4 of a step: means beside the figures of
    a prototype on a bar and a wall (err 8.7e-3, 7.9e-3, 3.5e-3; two-step force 1.4e-2, 9.8e-3,
    3.1e-3; energy 0.9950, 0.9944, 0.9925), with the tenth that the choice of fractions leaves. Courant 1 is
    the limit itself."""
    for courant, err, force, least in (
        (0.1, 9.6e-3, 1.55e-2, 0.9945),
        (0.5, 8.7e-3, 1.08e-2, 0.9938),
        (1.0, 3.9e-3, 3.5e-3, 0.992),
    ):
        runs = [
            bars(
                "impact",
                scheme="PAOLI",
                pbeta=0.0,
                mass="LUMPED",
                courant=courant,
                touch=t,
                output="step",
            )[0]
            for t in (0.0, 0.25, 0.5, 0.75)
        ]
        name = "PAOLI 0 at %g: " % courant
        at_most(np.mean([r["err"] for r in runs]), err, name + "err")
        at_most(np.mean([r["e_R2"] for r in runs]), force, name + "e_R2")
        at_most(max(r["E_max"] for r in runs), 1.0 + LEDGER, name + "largest energy")
        at_most(least, np.mean([r["E_end"] for r in runs]), name + "energy at the end")
        at_most(max(r["residual"] for r in runs), LEDGER, name + "ledger")


def cards():
    """IMFLAG 0 and 1, no card of the implicit at all, LUMPED or nothing, DIAGONAL or nothing: one
    run, digit for digit. TSSFAC: DT0 follows it. The plan says what is off."""
    scene = thrown_block(4, 0.3)
    scene.dt, scene.steps = 1.0e-4, 400
    text = scene.text().replace("*END\n", "*CONTROL_TIMESTEP\n,0.5\n*END\n")
    base, code, errors = run_text("base", GENERAL.sub("*CONTROL_IMPLICIT_GENERAL\n1,\n", text))
    check(code == 0, "IMFLAG 1: " + errors)
    dt, limit, _ = noted(base)
    exact = table(base, "glstat")["dt"][-1]
    at_most(abs(dt - exact) / exact, 1.0e-6, "DT0 of the note")
    within(dt / limit, 0.499, 0.5, "TSSFAC 0.5: DT0 of the limit")
    more = "*BIPACT_SOLVER\nDIAGONAL,\n*BIPACT_MASS\nLUMPED,\n*END\n"
    for name, deck in (
        ("IMFLAG 0", GENERAL.sub("*CONTROL_IMPLICIT_GENERAL\n0,\n", text)),
        ("zero", GENERAL.sub("*CONTROL_IMPLICIT_GENERAL\n0,0.0\n", text)),
        ("no card", GENERAL.sub("", text).replace(DYNAMICS, "")),
        ("all cards", GENERAL.sub("*CONTROL_IMPLICIT_GENERAL\n0,\n", text).replace("*END\n", more)),
        ("DT0", GENERAL.sub("*CONTROL_IMPLICIT_GENERAL\n0,%.17g\n" % exact, text)),
    ):
        check(deck != text, name + ": another deck")
        folder, code, errors = run_text("other", deck)
        check(code == 0, name + ": " + errors)
        for tab in ("glstat", "rwforc"):
            a, b = (open(os.path.join(f, tab + ".tab")).read() for f in (base, folder))
            check(a == b, "%s: another %s" % (name, tab))
    deck = os.path.join(scenes.TMP, "base.k")
    _, _, out = scenes.bipact(deck, base, "--plan")
    check(re.search(r"explicit +on +DT0 = 0\.4\d+ of the limit", out), "plan: " + out)
    check(re.search(r"factor +off", out), "plan: no factor")
    log = open(os.path.join(base, "bipact.log")).read()
    check(re.search(r"refinement +off", log) and "solver DIAGONAL, order none" in log, "log")


def static_start():
    """A static phase that an explicit run takes over, with prescribed dofs: a held bar that hangs
    from its top keeps its length, to the residual of the passes over the stiffness; another
    engine serves the static phase."""
    scene = bodies.Scene(dt=5.0e-5, steps=4000)
    scene.scheme = EXPLICIT
    bar = scene.body(2, 8, bodies.box(0.0, 0.0, 0.2, 1.0))
    scene.hold(bar.row(8))
    scene.curve(90, [(0.0, 0.0), (0.05, 40.0), (1.0, 40.0)])
    scene.cards += ["*LOAD_BODY_Y", "90,1.0", "*DATABASE_HISTORY_NODE", "%d," % bar.at[0, 0]]
    text = scene.text().replace(DYNAMICS, "*CONTROL_IMPLICIT_DYNAMICS\n1,,,0.05\n")
    folder, code, errors = run_text("hanging", text)
    check(code == 0, "static start: " + errors)
    rows = table(folder, "nodout", node=bar.at[0, 0])
    late = rows["time"] >= 0.05 - 1.0e-9
    u = rows["uy"][late]
    check(abs(u[0]) > 1.0e-6, "static start: it hangs")
    at_most(np.abs(u - u[0]).max() / abs(u[0]), 1.0e-9, "static start: it stays")
    folder, code, errors = run_text("skyline", text.replace("*END", "*BIPACT_SOLVER\nSKYLINE,\n*END"))
    check(code == 0, "static start with SKYLINE: " + errors)


def ledger():
    """The block of every keyword with friction, loads, motions, walls, reactions: its ledger; with
    DT0 blank and with contact interfaces of many nodes."""
    with open(os.path.join(os.environ["ROOT"], "input", "cards", "every_keyword.k")) as file:
        text = file.read()
    deck = re.sub(r"(?m)^ *&scheme$", EXPLICIT, text)
    deck = re.sub(r"(?m)^ *LDLT( *AUTO)$", r"  DIAGONAL\1", deck)
    deck = deck.replace("         1       &dt", "         0")
    check(deck.count("PAOLI,") == deck.count("DIAGONAL") == 1, "the deck is explicit")
    folder, code, errors = run_text("every", deck)
    check(code == 0, "every keyword: exit code %d: %s" % (code, errors))
    rows = table(folder, "glstat")
    for column in ("external", "motion", "friction"):
        check(np.abs(rows[column]).max() > 0.0, "every keyword: there is work: " + column)
    at_most(np.abs(rows["residual"]).max(), LEDGER, "every keyword: ledger")


def restart():
    """A run with DT0 blank goes on from its restart files digit for digit; to another ENDTIM, which
    would make another step, it is refused with what to do."""
    scene = thrown_block(5, 0.3)
    scene.dt, scene.steps = 1.0e-4, 400
    cards = "*BIPACT_RESTART\n100,,99\n*END"
    text = GENERAL.sub("*CONTROL_IMPLICIT_GENERAL\n0,\n", scene.text()).replace("*END", cards)
    folder, code, errors = run_text("whole", text)
    check(code == 0, "restart: " + errors)
    deck = os.path.join(scenes.TMP, "whole.k")
    whole = {t: open(os.path.join(folder, t + ".tab")).read() for t in ("glstat", "rwforc")}
    files = sorted(f for f in os.listdir(folder) if f.startswith("restart."))
    check(len(files) > 4, "restart: %d files" % len(files))
    for name in files[::-1]:
        path = os.path.join(folder, name)
        code, errors, _ = scenes.bipact(deck, folder, "--quiet", "--restart", path)
        check(code == 0, "restart from %s: %s" % (name, errors))
        for tab, rows in whole.items():
            same = open(os.path.join(folder, tab + ".tab")).read() == rows
            check(same, "restart from %s: another %s" % (name, tab))
    _, code, errors = run_text("longer", text.replace("%r,\n" % (scene.dt * scene.steps), "0.0431,\n"))
    check(code == 0, "longer: " + errors)
    code, errors, _ = scenes.bipact(
        os.path.join(scenes.TMP, "longer.k"), folder, "--quiet", "--restart", "latest"
    )
    check(code == 3 and "with DT0 given" in errors, "restart to a later end: %d %s" % (code, errors))


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
