"""Bodies that overlap at the start (OVERLAP of *BIPACT_PAIR): pushed apart in a static phase
(RAMP), or nodes moved onto the obstacle (ADJUST)."""

import os
import re
import shutil
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import numpy as np
import scenes
from bodies import Scene, box
from scenes import at_most, bipact, check, finish, run_text, table

from analytic import press_fit

# Of the largest term: conventions of the ledger.
LEDGER = 1.0e-11
OVERLAP, LENGTHS, MODULI = 0.01, (2.0, 3.0), (1.0e3, 4.0e3)


def bars(way, rows=(3, 3), mu=0.0, dynamic=0.0, steps=5, width=1.0, side=""):
    """Two flush bars whose meeting ends overlap; far ends held in x, one node of each in y.
    dynamic: time that follows a static phase of 1."""
    scene = Scene(dt=1.0 / steps, steps=steps)
    one = scene.body(4, rows[0], box(0.0, 0.0, LENGTHS[0], 1.0), young=MODULI[0], poisson=0.0)
    two = scene.body(
        4,
        rows[1],
        box(LENGTHS[0] - OVERLAP, 0.5 - 0.5 * width, LENGTHS[1], width),
        young=MODULI[1],
        poisson=0.0,
    )
    scene.hold(one.column(0), y=0)
    scene.hold(two.column(4), y=0)
    scene.hold([one.at[0, 0], two.at[4, 0]])
    scene.contact(1, 2, mu=mu, pair="%s,,,,,,%s" % (side, way))
    scene.tables += ["NCFORC"]
    text = scene.text()
    if dynamic:
        text = text.replace("*CONTROL_IMPLICIT_DYNAMICS\n1,", "*CONTROL_IMPLICIT_DYNAMICS\n1,,,1.0")
        return text.replace("*CONTROL_TERMINATION\n1.0", "*CONTROL_TERMINATION\n%r" % (1.0 + dynamic))
    text = re.sub(r"(?m)^\*BIPACT_TIME\n.*\n", "", text)
    return text.replace("*CONTROL_IMPLICIT_DYNAMICS\n1,", "*CONTROL_IMPLICIT_DYNAMICS\n0,")


def ramp():
    """The force grows evenly to that of the closed form: linear, exact for these elements. The
    work of pushing is the strain energy. Matching faces, also with friction; each bound is
    round-off times a condition of 1e3 to 1e4. Then dynamics takes over and nothing moves. A
    force that was wrong by the allowance of a corner (2e-4 of an edge) would be off by 5e-3."""
    exact = press_fit(OVERLAP, LENGTHS, MODULI)
    for name, options in (("plain", {}), ("friction", {"mu": 0.3}), ("one step", {"steps": 1})):
        folder, code, errors = run_text("ramp", bars("RAMP", **options))
        check(code == 0 and errors == "", "%s: exit code %d: %s" % (name, code, errors))
        force = table(folder, "rcforc", side=1)
        off = np.abs(force["fn"] - exact * force["time"]).max()
        at_most(off / exact, 1.0e-9, name + ": force")
        rows = table(folder, "ncforc")
        middle = (rows["time"] > 0.99) & (rows["pressure"] > 0.0)
        at_most(np.abs(rows["pressure"][middle] / exact - 1.0).max(), 1.0e-9, name + ": pressure")
        energy = table(folder, "glstat")
        at_most(np.abs(energy["residual"]).max(), LEDGER, name + ": ledger")
        work = energy["motion"] - energy["internal"]
        at_most(np.abs(work).max() / energy["internal"][-1], 1.0e-9, name + ": work of pushing")
        at_most(force["gapmin"][-1] * -1.0, 1.0e-9 * OVERLAP, name + ": overlap left")
    folder, code, errors = run_text("stays", bars("RAMP", dynamic=2.0))
    check(code == 0, "then dynamics: exit code %d: %s" % (code, errors))
    force = table(folder, "rcforc", side=1)
    late = force["time"] > 0.999
    at_most(np.abs(force["fn"][late] / exact - 1.0).max(), 1.0e-9, "then dynamics: force")
    energy = table(folder, "glstat")
    at_most(np.abs(energy["residual"]).max(), LEDGER, "then dynamics: ledger")
    at_most(energy["kinetic"].max(), 1.0e-18, "then dynamics: nothing moves")


def unequal():
    """Three rows on two, and a bar between wider ends: statics in equilibrium, the same force on
    both sides, the overlap gone but for the allowance of corners (2e-4 edge of 1/2)."""
    for name, options in (("3:2", {"rows": (3, 2)}), ("wide", {"rows": (3, 4), "width": 2.0})):
        folder, code, errors = run_text("unequal", bars("RAMP", **options))
        check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
        one, two = (table(folder, "rcforc", side=s)["fx"] for s in (1, 2))
        at_most(np.abs(one + two).max() / np.abs(one).max(), 1.0e-12, name + ": both sides")
        gap = table(folder, "rcforc", side=1)["gapmin"][-1]
        at_most(-gap, 2.0e-4 * 0.5, name + ": overlap left")
        at_most(np.abs(table(folder, "glstat")["residual"]).max(), LEDGER, name + ": ledger")


def adjust():
    """Nodes of the contactor stand on the obstacle and nothing is pressed: no force in statics;
    the log lists them with the way, which is the overlap along x. SIDE chooses who is moved."""
    for side, nodes, way in (("", 4, -1.0), ("B", 4, 1.0)):
        name = "ADJUST, SIDE " + (side or "AUTO")
        folder, code, errors = run_text("adjust", bars("ADJUST", side=side))
        check(code == 0, "%s: exit code %d: %s" % (name, code, errors))
        with open(os.path.join(folder, "bipact.log")) as file:
            log = file.read()
        listed = re.search(r"moved onto obstacles.*\n((?: +\d+ +\d+ .*\n)+)", log)
        check(listed is not None, name + ": the log lists the nodes")
        moved = [line.split() for line in listed.group(1).splitlines()] if listed else []
        check(len(moved) == nodes, "%s: %d nodes" % (name, len(moved)))
        at_most(max(abs(float(m[2]) - way * OVERLAP) for m in moved), 1.0e-14, name + ": by x")
        at_most(max(abs(float(m[3])) for m in moved), 1.0e-14, name + ": by y")
        force = table(folder, "rcforc", side=1)
        at_most(force["fn"].max(), 1.0e-12, name + ": no force")


def error():
    """ERROR, the default, is as before: exit 2 with node and depth; RAMP too deep says so."""
    for way in ("", "ERROR"):
        _, code, errors = run_text("error", bars(way))
        check(code == 2 and "is 0.01 deep" in errors, "overlap %s: %d %s" % (way, code, errors))
    _, code, errors = run_text("deep", bars("RAMP", rows=(3, 40)))
    check(code == 2 and "more than 0.3 of an edge" in errors, "too deep: %d %s" % (code, errors))


def restart():
    """Restarts within the ramp: the tables of the whole run."""
    text = bars("RAMP", mu=0.3, dynamic=1.0)
    whole, code, errors = run_text("whole", text)
    check(code == 0, "whole: exit code %d: %s" % (code, errors))
    text = text.replace("*END", "*BIPACT_RESTART\n%10d%10s%10d\n*END" % (1, "", 100))
    folder, code, errors = run_text("parts", text)
    files = sorted(f for f in os.listdir(folder) if f.startswith("restart."))
    check(len(files) >= 10, "restart files: %d" % len(files))
    for file in files[:8]:
        again = os.path.join(scenes.TMP, "again-" + file)
        shutil.copytree(folder, again)
        code, errors, _ = bipact(
            folder + ".k", again, "--quiet", "--restart", os.path.join(again, file)
        )
        check(code == 0, "%s: exit code %d %s" % (file, code, errors))
        for name in ("glstat", "rcforc", "ncforc", "nodout", "sleout", "matsum"):
            texts = [open(os.path.join(f, name + ".tab")).read() for f in (again, whole)]
            check(texts[0] == texts[1], "%s: %s" % (file, name))


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    finish()
