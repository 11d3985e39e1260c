"""Threads: every table is the same in every digit for any number of them."""

import os
import sys

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tests", "support"))

import finite_scenes
import scenes
import solids
from scenes import check, run_text, show


def results(folder):
    """The texts of the tables of a run."""
    found = {}
    for name in sorted(os.listdir(folder)):
        if name in ("bipact.log", "summary.json", "deck.echo.k") or "timing" in name:
            continue
        with open(os.path.join(folder, name), "rb") as file:
            found[name] = file.read()
    return found


def same_for_all(name, text, field=False):
    """Runs a deck with 1, 2, 3 and 4 threads, by --threads or by the field of the deck."""
    first = None
    for threads in (1, 2, 3, 4):
        now, options = text, ["--threads", str(threads)]
        if field:
            now, options = text.replace("THREADS", str(threads)), []
        folder, code, errors = run_text("%s %d" % (name, threads), now, "--quiet", *options)
        check(code == 0, "%s, %d threads: exit code %d: %s" % (name, threads, code, errors))
        found = results(folder)
        first = first or found
        check(len(found) > 1 and found == first, "%s: tables with %d threads" % (name, threads))
    show("%s: %s" % (name, " ".join(first)))


def solver(engine, threads=""):
    """*BIPACT_SOLVER."""
    return ["*BIPACT_SOLVER", engine + ",,,,,," + threads]


def threads():
    """Scenes larger than those that are left to one thread: contact in the plane with LDLT and
    SUPERNODAL, explicit steps, a body in space against a wall with both engines, finite
    deformation in the plane and in space. The number by --threads, in one scene by THREADS."""
    blocks, sets = scenes.two_blocks(nx=(110, 60), ny=(40, 60), gap=1.0e-4)
    blocks += ["*INITIAL_VELOCITY", "2,", "0.5,-1.0"]
    for engine in ("LDLT", "SUPERNODAL"):
        text = scenes.deck(blocks, 1.0e-4, 1.0e-3, mu=0.3, extra=solver(engine, "THREADS"))
        same_for_all("plane " + engine, text, field=True)
    text = scenes.deck(blocks, 2.0e-5, 2.0e-4, scheme="CDLAGRANGE", mass="LUMPED,0", mu=0.3)
    same_for_all("explicit", text)

    box = solids.Box((10, 10, 10), shift=0.2)
    lines = solids.cards(box.x, box.elements) + solids.part()
    lines += finite_scenes.thrown(np.tile([0.1, 0.2, -1.0], (len(box.x), 1)), range(len(box.x)))
    lines += ["*RIGIDWALL_PLANAR", "0,", "0.0,0.0,-0.001,0.0,0.0,1.0,0.3"]
    for engine in ("LDLT", "SUPERNODAL"):
        same_for_all("space " + engine, solids.deck(lines + solver(engine), 1.0e-3, 5.0e-3))

    for name, mesh in (
        ("plane", finite_scenes.Disc(36, (0.0, 0.0))),
        ("space", solids.Box((8, 8, 8), shift=0.2)),
    ):
        lines = finite_scenes.body(mesh, "neo-hooke") + finite_scenes.finite()
        spin = 2.0 if name == "plane" else np.array([0.5, 1.0, 2.0])
        v = finite_scenes.spinning(mesh.x, spin) * (1.0 + 0.3 * mesh.x[:, :1])
        lines += finite_scenes.thrown(v, range(len(mesh.x)))
        same_for_all("finite " + name, solids.deck(lines, 5.0e-3, 1.5e-2))


def threads_refused():
    """A number of threads that is none is refused by name, in the deck and on the command line."""
    lines, sets = scenes.two_blocks()
    for word in ("0", "-1", "two", "1.5", "5000"):
        text = scenes.deck(lines, 1.0e-3, 1.0e-3, extra=solver("AUTO", word))
        folder, code, errors = run_text("field " + word, text)
        check(code == 2 and "THREADS" in errors, "THREADS %s: %d: %s" % (word, code, errors))
        plain = scenes.deck(lines, 1.0e-3, 1.0e-3)
        folder, code, errors = run_text("option " + word, plain, "--threads", word)
        ok = code == 3 and "--threads" in errors and '"%s"' % word in errors
        check(ok, "--threads %s: %d: %s" % (word, code, errors))
    folder, code, errors = run_text("none", plain, "--threads")
    check(code == 3 and "--threads needs a value" in errors, "--threads: %d: %s" % (code, errors))
    text = scenes.deck(lines, 1.0e-3, 1.0e-3, extra=solver("AUTO", "4"))
    folder, code, errors = run_text("both", text, "--threads", "2", "--quiet")
    check(code == 0, "both: %d: %s" % (code, errors))


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    scenes.finish()
