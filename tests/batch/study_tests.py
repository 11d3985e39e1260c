"""scripts/study.py: its bars cover the true errors of two bars, small; what is finished is not
run again; meshes are refined with their sets, or it says why not; one mesh; faults.
"""

import contextlib
import io
import os
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
from scenes import BIPACT, ROOT, TMP, check, finish, show

sys.path.insert(0, os.path.join(ROOT, "bench"))
import make_bars
import numpy as np
import study
import study_coverage
import study_estimate
from study_deck import CannotRefine, EchoDeck

BARS = os.path.join(TMP, "bars.k")
FEW = ["--bipact", BIPACT, "--jobs", "2"]


def call(*words):
    """(exit code, output, messages) of the script."""
    output, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
        try:
            code = study.main([*FEW, *words])
        except SystemExit as problem:
            code = problem.code
    return code, output.getvalue(), errors.getvalue()


def coverage():
    """Two bars, touch at a step and within one, 10 to 40 elements: the figures that issue and
    doc/study.md ask of the long study: 95 % covered, half of the bars at most 3 true errors
    wide, no convergence said of NEWMARK's force and of a tenth of THETA and PAOLI at most."""
    words = ["--schemes", "THETA,NEWMARK,PAOLI", "--masses", "C,L,D", *FEW]
    words += ["--steps", "1,0.5"]
    total = np.zeros((4, 2))
    for scene in ("aligned", "unaligned"):
        with contextlib.redirect_stderr(io.StringIO()):
            found = study_coverage.score(scene, TMP, (10, 20, 40), words)
        counts, ratios = study_coverage.report(*found)
        total += counts
        for name, (ratio, _) in ratios.items():
            if ratio is not None:  # None: the bar is wider than the goal, and the page says so
                text = "%s, %s: the choice costs %g of the cheapest" % (scene, name, ratio)
                check(ratio <= 2.0, text)
    covered, narrow, stays, newmark = total[:, 0] / total[:, 1]
    words = "covered %.3f, narrow %.3f, stays %.3f, NEWMARK %.3f"
    show(words % (covered, narrow, stays, newmark))
    check(total[0, 1] > 900, "%d points" % total[0, 1])
    check(covered >= 0.95, "covered: %.3f" % covered)
    check(narrow >= 0.5, "narrow: %.3f" % narrow)
    check(stays <= 0.1, "said not to converge: %.3f of THETA and PAOLI" % stays)
    check(newmark > 0.9, "said not to converge: %.3f of the force of NEWMARK" % newmark)


def page():
    """A deck as it stands, refined twice: page, table, figures; again: nothing is run; a run
    that is gone is run alone."""
    make_bars.write(BARS, nx=6, courant=1.0, tables=["nodout", "rcforc"])
    out = os.path.join(TMP, "bars.study")
    words = (BARS, "-o", out, "--schemes", "THETA,GENALPHA,CDX", "--masses", "C,D", "--steps", "1")
    code, output, errors = call(*words)
    check(code == 0 and output.endswith("12 of 12 runs are done\n"), output + errors)
    with open(os.path.join(out, "study.md"), encoding="utf-8") as file:
        text = file.read()
    for word in ("## The cheapest choice", "rcforc force", "THETA DISPERSION", "3 meshes"):
        check(word in text, "the page has no " + word)
    for name in ("rcforc_force.png", "nodout_displacement.png", "study.csv"):
        check(os.path.getsize(os.path.join(out, name)) > 1000, name)
    code, _, errors = call(*words)
    check(code == 0 and "12 finished before" in errors and "1/" not in errors, errors)
    gone = next(f for f in os.listdir(os.path.join(out, "runs")) if f.startswith("GENALPHA"))
    os.remove(os.path.join(out, "runs", gone, "summary.json"))
    code, _, errors = call(*words)
    check(code == 0 and "1/1 GENALPHA" in errors, errors)


def one_mesh():
    """Without other meshes: five steps, and the page says what the bars do not know."""
    out = os.path.join(TMP, "one.study")
    words = ("--schemes", "THETA", "--masses", "C,L", "--refine", "0")
    code, output, errors = call(BARS, "-o", out, *words)
    check(code == 0 and "10 of 10" in output, output + errors)
    with open(os.path.join(out, "study.md"), encoding="utf-8") as file:
        check("All runs have one mesh" in file.read(), "one mesh is said")


def refinement():
    """Four children of each element with the same area; sets grow along boundaries only;
    supports of nodes; what stands for one mesh is refused."""
    text = """*KEYWORD
*CONTROL_IMPLICIT_GENERAL
1,0.1
*NODE
1,0.,0.
2,1.,0.
3,2.,0.,,1
4,0.,1.
5,1.,1.
6,2.,1.,,1
*ELEMENT_SHELL
1,1,1,2,5,4
2,1,2,3,6,0
3,1,2,6,5,0
*SET_NODE_LIST
7,
1,2,5,
*SET_SEGMENT
8,
1,2,0,0
*BOUNDARY_SPC_NODE
1,,1,0
4,,1,0
*END
"""
    path = os.path.join(TMP, "small.k")
    with open(path, "w", encoding="ascii") as file:
        file.write(text)
    old = EchoDeck.read(path)
    new = old.refined()
    nodes = {i: (float(f[1]), float(f[2])) for i, f in new.nodes().items()}
    check(len(new.elements()) == 12 and len(nodes) == 6 + 8 + 1, "%d nodes" % len(nodes))
    area = 0.0
    for _, _, corners in new.elements():
        x, y = np.array([nodes[n] for n in corners]).T
        part = 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
        check(part in (0.25, 0.125), "area %g" % part)
        area += part
    check(area == 2.0 and new.least_edge() == 0.5 * old.least_edge(), "area, edge")
    members = [int(n) for f in new.named("SET_NODE_LIST")[0].fields(first=1) for n in f if n]
    # 1-2 is boundary: its mid-point joins; 2-5 is inside, and no element has all corners in it
    check([nodes[n] for n in members[3:]] == [(0.5, 0.0)], "the set grew by %s" % members[3:])
    check(len(new.named("SET_SEGMENT")[0].lines) == 3, "two segments")
    held = [int(f[0]) for f in new.named("BOUNDARY_SPC_NODE")[0].fields()]
    check([nodes[n] for n in held[2:]] == [(0.0, 0.5)], "support of a mid-point")
    fixed = [nodes[i] for i, f in new.nodes().items() if f[4] == "1"]
    check((2.0, 0.5) in fixed and len(fixed) == 3, "TC of a mid-point: %s" % fixed)
    old.blocks[-1].head = "*LOAD_NODE_SET"
    old.blocks[-1].name = "LOAD_NODE_SET"
    try:
        old.refined()
        check(False, "nodal loads are refused")
    except CannotRefine as why:
        check("LOAD_NODE_SET" in str(why), str(why))


def estimates():
    """Made-up runs: q = exact + a h^p of two methods and one that stays off by .5."""
    t = np.linspace(0.0, 1.0, 41)
    runs, histories = {}, {}
    for name, size, order in (("a", 0.3, 1.0), ("b", -0.2, 1.0), ("c", 0.5, 0.0)):
        for level in range(3):
            run = name, level
            values = (t + size * 2.0 ** (-order * level) * t**2)[:, None, None]
            runs.setdefault(name, []).append(run)
            histories[run] = {"q": study_estimate.Quantity("state", t, values)}
            if name == "c":  # no two runs of it agree
                histories[run]["q"].values = values * (1.0 if level % 2 else 1.6)
    widths = [1.0, 0.5, 0.25]

    def sequences():
        return [study_estimate.Sequence((n, "C", 1.0), r, widths) for n, r in runs.items()]

    found = study_estimate.estimate_all(sequences, histories)["q"]
    truth = study_estimate.Quantity("state", t, t[:, None, None])
    check(found.stuck == {("c", "C")}, "does not converge: %s" % found.stuck)
    check(abs(found.order - 1.0) < 1e-9, "order %g" % found.order)
    for run, history in histories.items():
        true = study_estimate.distance(history["q"], truth, 1.0)
        off = abs(found.errors[run] - true)
        check(off <= found.bars[run], "%s: %g, bar %g" % (run, off, found.bars[run]))
    off = study_estimate.distance(found.reference, truth, found.unit)
    check(off <= found.bar, "the reference is off by %g, bar %g" % (off, found.bar))


def faults():
    """Words that make no sense, decks without schemes: exit 2, nothing written."""
    for words in (("none.k",), (BARS, "--steps", "0"), (BARS, "--jobs", "0")):
        code, output, errors = call(*words, "-o", os.path.join(TMP, "none"))
        check(code == 2 and errors, "%s: %s" % (words, errors))
        check(not os.path.exists(os.path.join(TMP, "none")), "nothing is written")
    with open(BARS, encoding="ascii") as file:
        text = file.read()
    broken = os.path.join(TMP, "broken.k")
    with open(broken, "w", encoding="ascii") as file:
        file.write(text.replace("*CONTROL_TERMINATION", "*CONTROL_TERMINATIO"))
    code, _, errors = call(broken, "-o", os.path.join(TMP, "broken"))
    check(code == 2 and "CONTROL_TERMINATIO" in errors, errors)


for test in (estimates, refinement, page, one_mesh, faults, coverage):
    test()
finish()
