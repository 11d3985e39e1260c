"""WSTORE on *BIPACT_CONTACT: W dense, its near part with solves for the rest, products alone. The
forces are the same, whatever is kept; the choice and its reason stand in the plan."""

import os
import re
import sys

sys.path.insert(0, os.path.join(os.environ["ROOT"], "tests", "support"))
import numpy as np
import bodies
import scenes
import space_contact
from scenes import at_most, bipact, check, finish, make_bars, run_text, table

# Of the largest force. A contact solve ends at 1e-10 of the reactions, by its certificate; those
# that sweeps leave differ from a direct solve's by that times the condition of W, some ten, and
# so do the motions that the forces have made.
NEAR = 1.0e-9
# Steps with momentum end just below 1e-10, where sweeps and direct solves end far below; in 100
# steps the forces differ by 1e-7 at most.
PRODUCTS = 1.0e-6


def stored(text, storage):
    return text.replace("*END", "*BIPACT_CONTACT\n\n%s\n*END" % storage)


def bars(steps=100, **options):
    """Two bars of 31 contacts whose faces slide."""
    deck = os.path.join(scenes.TMP, "bars.k")
    given = dict(nx=12, ny=30, height=6.0, length=2.4, gap=1.0e-9, courant=0.5, poisson=0.3)
    given.update(mu=0.3, slide=0.02, tables=["glstat", "rcforc"])
    given.update(options)
    meta = make_bars.write(deck, **given)
    make_bars.write(deck, **dict(given, tend=steps * meta["dt"], output=meta["dt"]))
    with open(deck) as file:
        return file.read()


def clasp(mu):
    """A body with a slot whose jaws close: its boundary meets itself."""
    scene = bodies.Scene(dt=2.0e-5, steps=100)
    body = scene.body(
        24,
        9,
        bodies.box(0.0, 0.0, 2.4, 0.45),
        keep=lambda i, j: i < 2 or not 3 < j < 5,
        poisson=0.3,
    )
    scene.place[:] = [(x, y - (0.0478 if y > 0.22 else 0.0)) for x, y in scene.place]
    scene.kick([n for n in body.nodes() if scene.place[n - 1][1] > 0.2], 0.3, -1.0)
    scene.contact("1", mu=mu, kind="SINGLE_SURFACE")
    return scene.text()


def thrown(scheme):
    """A block thrown obliquely on a wall."""
    scene = bodies.Scene(dt=4.0e-5, steps=150)
    scene.scheme = scheme
    block = scene.body(
        16, 6, bodies.box(0.0, 0.001, 1.6, 0.6), velocity=(0.4, -1.0), poisson=0.3
    )
    scene.wall(block.nodes(), (0.0, 0.0), (0.0, 1.0), 0.2)
    return scene.text()


def forces(folder):
    """Forces of all contacts in time, (rows, components), and the largest."""
    name = "rcforc" if os.path.exists(os.path.join(folder, "rcforc.tab")) else "rwforc"
    rows = table(folder, name)
    f = np.stack([rows[c] for c in rows.names if re.fullmatch("f[xyz]", c)], axis=1)
    return f, np.abs(f).max()


def the_same_forces():
    explicit = dict(scheme="PAOLI", pbeta=0.0, mass="LUMPED")
    cases = {
        "plane": bars(),
        "without friction": bars(mu=0.0),
        "Newmark": bars(scheme="NEWMARK"),
        "two stages": bars(scheme="NSGENALPHA"),
        # Later a corner is above a vertex or beside it by round-off.
        "massless": bars(30, mass="DISPERSION", redist=1),
        "long steps": bars(courant=4.0, tend=None),
        "explicit": bars(courant=0.4, **explicit),
        "held": bars().replace("*END", "*BOUNDARY_SPC_NODE\n1,,1,1\n31,,1,1\n*END"),
        "self": clasp(0.3),
        "self without friction": clasp(0.0),
        "wall": thrown("THETA,0.5"),
        "wall, theta 1": thrown("THETA,1.0"),
        "space": space_contact.block_scene(end=0.06),
        "space without friction": space_contact.block_scene(mu=0.0, end=0.06),
    }
    for name, text in cases.items():
        found = {}
        for storage in ("DENSE", "BLOCK", "NONE"):
            folder, code, errors = run_text(storage.lower(), stored(text, storage))
            check(code == 0, "%s %s: exit code %d: %s" % (name, storage, code, errors))
            found[storage] = forces(folder)
            with open(os.path.join(folder, "bipact.log")) as file:
                log = file.read()
            check("certificate met" in log, "%s %s: certificate" % (name, storage))
        exact, largest = found["DENSE"]
        check(largest > 0.0, name + ": something touches")
        for storage, bound in (("BLOCK", NEAR), ("NONE", PRODUCTS)):
            other, _ = found[storage]
            off = np.abs(other - exact).max() / largest
            at_most(off, bound, "%s: forces of %s" % (name, storage))


def plan(text, *options):
    deck = os.path.join(scenes.TMP, "plan.k")
    with open(deck, "w") as file:
        file.write(text)
    code, errors, out = bipact(deck, os.path.join(scenes.TMP, "plan"), "--plan", *options)
    line = re.search(r"contact W +(on|off) +(.*)", out)
    return code, errors, line and (line[1], line[2])


def the_choice():
    """AUTO keeps W dense where it is small, or cheap beside the factor; thin wide bodies have the
    near part. What a scene cannot have is an error by name."""
    wide = dict(nx=10, ny=150, length=1.0, height=15.0)
    for text, kind in (
        (bars(), "off"),
        (bars(nx=80, ny=40, length=8.0, height=4.0), "off"),
        (bars(**wide), "on"),
        (stored(bars(**wide), "DENSE"), "off"),
        (stored(bars(), "BLOCK"), "on"),
    ):
        code, errors, line = plan(text)
        check(code == 0 and line and line[0] == kind, "choice %s: %s %s" % (kind, line, errors))
    with open(os.path.join(scenes.ROOT, "input", "lessons", "press_fit.k")) as file:
        static = stored(file.read(), "BLOCK")
    dumped = stored(bars(), "BLOCK").replace("\n\nBLOCK", "\n\nBLOCK,,,,5")
    for text, why in ((static, "statics"), (dumped, "DFIRST")):
        code, errors, _ = plan(text)
        check(code != 0 and "WSTORE BLOCK is not for" in errors and why in errors, why + errors)


if __name__ == "__main__":
    the_same_forces()
    the_choice()
    finish()
