#!/usr/bin/env python3
"""Random collisions of plane bodies, judged from outside: collide.py [N] [options]

Scene number k of a seed is made from (seed, k) alone: two to five bodies of random shapes,
meshes and materials that are thrown at each other, stacked under gravity, or wedged in a
groove; with --rigid some of them, one at least, are rigid parts, under MOREAU (restitution
0, .5, 1) or THETA; with --mortar half of the pairs are mortars; with --soft all are of
hyperelastic laws at finite deformation, at .02 to .2 of their speed of sound, in some of them
steps that fail are halved. Their tables and meshes alone say whether the run is right:

    always      exit code 0, or 1 with a message that names a node or element; an end within the
                limit;
                energy <= initial + external + motion + unsolved, ledger closed, momentum kept
                (or its change equal to the impulse from outside), forces of both sides of a
                contact opposite; mirrored, turned, renumbered with the bodies exchanged the
                scene gives the same motion, as long as gaps changed by 1e-14 do not matter; rigid
                bodies keep their shape; two that may meet, or one and a wall, under THETA have
                their WARNING rigid-impact
    silent      exit code 0, neither WARNING overlap nor WARNING energy-growth: no true overlap
                deeper than 1e-2 of the shorter edge, no node through a body
    fine runs   at most 2 % warned or stopped; overlap at most 1e-3 in half of all, 3e-3 in 99 %
                (with mortars 7.5e-3; soft 3e-2, 10 % warned or stopped)

A run is fine where no two bodies move by more than 0.05 of the shortest edge against each other
in a step, coarse up to 1, beyond above that (no promise on overlap); extreme by its draw:
stiffness ratio to 1e6, mass ratio to 1e4, Poisson ratio to 0.499, friction to 10, elements
1:100 in size, 1:20 in aspect; "moreau" are runs of that scheme, whose contact on velocities lets
bodies sink in by the way of a step. Where the round-off of stiff bodies is expected above 1e-10, the
bounds on energy, momentum and twins grow with it. Results are kept in --out, so that an
interrupted study goes on; those of another program or another judge are made again. Exit code 1
if anything failed.

Columns of the closing table: runs, those with contact (touch), warned, stopped (exit code not
0) or failed; overlap of all runs: median, 99 %, deepest, and the deepest of the silent ones;
largest excess of energy / largest term and of momentum / largest of a body; runs whose twins
differ.
"""

import argparse
import hashlib
import json
import math
import multiprocessing
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

import startup

import numpy as np

import collide_deck
import collide_judge as judge
import collide_report
import collide_scenes as scenes
import tables

LIMIT = 60.0  # seconds that a run may take
EVERY = 20  # steps between the rows of a twin
GROWTH, LEDGER, MOMENTUM, SUPPORTED = 1.0e-9, 1.0e-9, 1.0e-10, 1.0e-9
SUPPORTED_SOFT = 1.0e-8  # Newton's method leaves 1e-9 of a step's motion: forces of it times K
NUDGES = 8  # more twins of a soft scene whose gaps change by next to nothing
BALANCE, SAME, DEPARTED, DEEP = 1.0e-12, 1.0e-9, 1.0e-10, 1.0e-2
SHAPE = 1.0e-13  # a few hundred eps
ANGLE = math.radians(37.0)
NAMES = ("kind", "extreme", "single", "scheme", "soft", "steps", "courant", "roundoff")
WARNINGS = ("overlap", "energy-growth")
# Where a run stopped, in its message.
PLACE = r"\bnode (index )?\d|rigid parts|element \d|step \d+, time \S+ Newton's method"


def run(program, text, folder):
    """Runs a deck in a folder; (exit code or None after the limit, messages, seconds)."""
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "deck.k"), "w", encoding="ascii") as file:
        file.write(text)
    start = time.time()
    try:
        done = subprocess.run(
            [program, "deck.k", "-o", "out", "--quiet"],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            timeout=LIMIT,
        )
    except subprocess.TimeoutExpired:
        return None, "", time.time() - start
    words = done.stderr.decode(errors="replace").strip()
    return done.returncode, words, time.time() - start


def displacements(folder, scene):
    """Times, and displacements of each body in every row: [(rows, nodes, 2)]."""
    with open(os.path.join(folder, "out", "nodout.tab"), encoding="ascii") as file:
        lines = [line for line in file if not line.startswith("#")]
    width = len(lines[0].split())
    numbers = np.fromstring("".join(lines), sep=" ")
    total = sum(len(ids) for ids in scene["ids"])
    numbers = numbers.reshape(-1, total, width)
    where = np.empty(total + 1, dtype=int)
    where[numbers[0, :, 1].astype(int)] = np.arange(total)
    return numbers[:, 0, 0], [numbers[:, where[ids], 2:4] for ids in scene["ids"]]


def table(folder, name):
    return tables.read_run(os.path.join(folder, "out"), name)


def warned(folder):
    """All warnings of a run."""
    with open(os.path.join(folder, "out", "bipact.log"), encoding="utf-8") as log:
        found = re.findall(r"^WARNING ([\w-]+)", log.read(), re.M)
    return sorted(set(found))


def halved(folder):
    """Whether a step was halved."""
    with open(os.path.join(folder, "out", "bipact.log"), encoding="utf-8") as log:
        return not re.search(r"^steps halved 0,", log.read(), re.M)


def outer_impulse(folder, scene, matsum, times):
    """Impulse of gravity, supports and walls since the start, in every row: (rows, 2)."""
    mass = sum(matsum["mass"][: len(scene["bodies"])])
    given = mass * np.outer(times, scene["gravity"])
    spcforc, rwforc = table(folder, "spcforc"), table(folder, "rwforc")
    if spcforc is not None and len(spcforc):
        nodes = len(spcforc.ids("node"))
        force = spcforc.vectors("fx", "fy").reshape(-1, nodes, 2).sum(axis=1)
        steps = np.diff(times, prepend=times[0])
        given += np.cumsum(force[: len(times)] * steps[:, None], axis=0)
    if rwforc is not None:
        given += rwforc.vectors("ix", "iy")[: len(times)]
    for k, b in enumerate(scene["bodies"]):
        if b["rigid"] and (b["held"] or b["driven"]):
            # Its momentum stays, and no table has what holds it: what acts on it, turned round.
            given -= matsum["mass"][k] * np.outer(times, scene["gravity"])
            given -= contact_impulse(folder, scene, k)[: len(times)]
    return given


def contact_impulse(folder, scene, body):
    """Impulse of all contacts on a body, in every row: (rows, 2)."""
    rcforc, total = table(folder, "rcforc"), 0.0
    for k, pair in enumerate(scene["pairs"], 1):
        if body in pair:
            rows = rcforc.select(contact=k, side=1 + pair.index(body))
            total = total + rows.vectors("ix", "iy")
    return total


def measure(folder, scene):
    """All figures of a run that has tables."""
    times, moved = displacements(folder, scene)
    bodies = scene["bodies"]
    places = [b["xy"] + u for b, u in zip(bodies, moved)]
    found = judge.overlap(places, [b["loop"] for b in bodies], scene["wall"])
    glstat, matsum = table(folder, "glstat"), table(folder, "matsum")
    sleout, rcforc = table(folder, "sleout"), table(folder, "rcforc")
    given = outer_impulse(folder, scene, matsum, times)
    free = collide_deck.is_free(scene)
    # Of a step that was halved SPCFORC has the force of the last part.
    told = free or not (scene.get("halve") and halved(folder))
    found.update(
        time=float(times[found["row"]]) if found["row"] >= 0 else None,
        rows=len(times),
        free=free,
        finite=all(np.isfinite(t[n]).all() for t in (glstat, matsum, rcforc) for n in t.names),
        energy=judge.energy(glstat),
        ledger=float(np.abs(glstat["residual"]).max()),
        momentum=judge.momentum(matsum, given) if told else 0.0,
        balance=judge.balance(rcforc),
        shape=max((judge.shape(p) for p, b in zip(places, bodies) if b["rigid"]), default=0.0),
        touched=bool(rcforc["fn"].max() > 0.0),
        reported=float(sleout["penetration"].max()),
        eta=float(sleout["eta"].max()),
    )
    return found, moved


def same_place(one, two, matrix):
    """Largest difference of two histories in every row, in units of each column's maximum (of
    1e-3 of the larger one, where a column holds little but round-off)."""
    rows = min(len(one[0]), len(two[0]))
    a = np.concatenate([u[:rows] for u in one], axis=1)
    b = np.concatenate([u[:rows] for u in two], axis=1) @ matrix  # turns them back
    largest = np.abs(a).max(axis=(0, 1))
    largest = np.maximum(largest, 1.0e-3 * largest.max() or 1.0)
    return (np.abs(a - b) / largest).max(axis=(1, 2))


def twin_history(program, scene, folder, reverse=False):
    """Displacements of a twin, the bodies in the order of the scene; None without tables."""
    code, _, _ = run(program, collide_deck.deck(scene, EVERY), folder)
    if not os.path.exists(os.path.join(folder, "out", "nodout.tab")):
        return None, code
    _, moved = displacements(folder, scene)
    return moved[::-1] if reverse else moved, code


def twins(scene, rng):
    """{name: (twin, matrix of its placement, whether its bodies are in reverse order)}; the
    first is all others in one."""
    mirror, turn, one = scenes.MIRROR, scenes.turn(ANGLE), np.eye(2)
    both = turn @ mirror
    every = scenes.transformed(scenes.swapped(scenes.renumbered(scene, rng)), both)
    return {
        "all": (every, both, True),
        "mirrored": (scenes.transformed(scene, mirror), mirror, False),
        "turned": (scenes.transformed(scene, turn), turn, False),
        "renumbered": (scenes.renumbered(scene, rng), one, False),
        "swapped": (scenes.swapped(scene), one, True),
    }


def symmetry(program, scene, moved, code, folder):
    """twin: largest difference; until: row up to which it counts; names: what differs."""
    rng = np.random.default_rng(1)
    rows = list(range(0, scene["steps"] + 1, EVERY))
    rows += [] if rows[-1] == scene["steps"] else [scene["steps"]]
    few = [u[[r for r in rows if r < len(u)]] for u in moved]
    until, apart = departure(program, scene, few, rng, folder)
    if until is None:
        return {"twin": 0.0, "until": 0, "names": []}
    found = {}
    for name, (twin, matrix, reverse) in twins(scene, rng).items():
        where = os.path.join(folder, name)
        other, its_code = twin_history(program, twin, where, reverse)
        off = None if other is None else same_place(few, other, matrix)
        found[name] = off, its_code
        if name == "all" and not differing(found, until, apart, code, scene):
            break
    names = differing(found, until, apart, code, scene)
    for _ in range(NUDGES if names and scene["soft"] else 0):
        # Round-off decides now and then which nodes a soft body lays on; one nudge may miss it.
        row, far = departure(program, scene, few, rng, folder)
        if far:
            until, apart = min(until, max(0, row - 1)), True
        names = differing(found, until, apart, code, scene)
        if not names:
            break
    off = found["all"][0]
    largest = float(off[:until].max(initial=0.0)) if off is not None else float(code != 1)
    return {"twin": largest, "until": until, "names": names}


def departure(program, scene, few, rng, folder):
    """(row in which a twin moved by next to nothing is elsewhere or ends; None without tables,
    whether it is elsewhere)."""
    nudged = scenes.nudged(scene, rng)
    other, _ = twin_history(program, nudged, os.path.join(folder, "nudged"))
    if other is None:
        return None, False
    far = np.flatnonzero(same_place(few, other, np.eye(2)) > DEPARTED * stiffness(scene))
    if len(far):
        return int(far[0]), True
    return min(len(few[0]), len(other[0])), False


def differing(found, until, apart, code, scene):
    """Names of the twins that differ before a row, or end otherwise."""
    names = []
    for name, (off, its_code) in found.items():
        differs = float(off is None and code != 1)
        if off is not None:
            differs = off[:until].max(initial=0.0)
        if differs > SAME * stiffness(scene) or not (apart or its_code == code):
            names.append(name)
    return names


def stiffness(result):
    """Factor on the bounds where round-off is above 1e-10 of the energy."""
    return max(1.0, result["roundoff"] / 1.0e-10)


def class_of(result):
    """fine, coarse, beyond, extreme or moreau."""
    if result["extreme"]:
        return "extreme"
    if result["scheme"].startswith("MOREAU"):
        return "moreau"
    step = result.get("step", 0.0)
    return "fine" if step <= 0.05 else "coarse" if step <= 1.0 else "beyond"


def faults(result):
    """What is wrong with a run: list of texts."""
    if result["code"] is None:
        return ["no end within %g s" % LIMIT]
    out = []
    if result["code"] not in (0, 1):
        out.append("exit code %d: %s" % (result["code"], result["message"][:150]))
    if result["code"] == 1 and not re.search(PLACE, result["message"]):
        out.append("stopped without naming a node: " + result["message"][:150])
    if "overlap" not in result:
        return out
    out += ["a number is not finite"] if not result["finite"] else []
    bound = SUPPORTED_SOFT if result["soft"] else SUPPORTED
    bound = MOMENTUM if result["free"] else bound
    for name, most in (
        ("energy", GROWTH),
        ("ledger", LEDGER),
        ("momentum", bound),
        ("balance", BALANCE),
        ("shape", SHAPE),
    ):
        if not result[name] <= most * stiffness(result):
            out.append("%s %.1e" % (name, result[name]))
    if result["meets"] and "rigid-impact" not in result["warned"]:
        out.append("no WARNING rigid-impact")
    if result["silent"] and result["overlap"] > DEEP and class_of(result) != "beyond":
        words = (result["overlap"], *result["pair"], result["time"])
        out.append("silent overlap %.1e of an edge, bodies %s and %s, time %g" % words)
    if result["silent"] and result["through"]:
        row, pair, node = result["through"][0]
        words = (node, *pair, row)
        out.append("silent: outline node %d of body %d through body %d in step %d" % words)
    if result.get("names"):
        words = (result["twin"], " ".join(result["names"]))
        out.append("twins differ by %.1e or in their end: %s" % words)
    return out


def work(task):
    """One run: its line of results."""
    number, a = task
    start = time.time()
    scene = scenes.draw(a.seed, number, a.single, a.mortar, a.rigid, a.soft)
    result = {"seed": a.seed, "number": number, "stamp": a.stamp}
    result.update({name: scene[name] for name in NAMES})
    result["bodies"] = len(scene["bodies"])
    result["rigid"] = sum(b["rigid"] for b in scene["bodies"])
    result["meets"] = scene["scheme"].startswith("THETA") and scenes.may_meet_rigid(scene)
    result["nodes"] = sum(len(b["xy"]) for b in scene["bodies"])
    with tempfile.TemporaryDirectory() as folder:
        code, message, seconds = run(a.bipact, collide_deck.deck(scene), folder)
        result.update(code=code, message=message, bipact=seconds)
        moved = None
        if code in (0, 1) and os.path.exists(os.path.join(folder, "out", "nodout.tab")):
            result["warned"] = warned(folder)
            result["silent"] = code == 0 and not set(result["warned"]) & set(WARNINGS)
            found, moved = measure(folder, scene)
            result.update(found, through=found["through"][:3])
        if moved is not None and a.symmetry:
            result.update(symmetry(a.bipact, scene, moved, code, folder))
        result["faults"] = faults(result)
        if result["faults"] or a.only is not None:
            keep_decks(folder, "%s/seed%d_%d" % (a.keep, a.seed, number))
    result["class"] = class_of(result)
    result["seconds"] = time.time() - start
    return result


def keep_decks(folder, name):
    """Copies the deck and those of the twins."""
    os.makedirs(os.path.dirname(name), exist_ok=True)
    for below in ("", "nudged", "all", "mirrored", "turned", "renumbered", "swapped"):
        path = os.path.join(folder, below, "deck.k")
        if os.path.exists(path):
            shutil.copy(path, name + ("_" + below if below else "") + ".k")


def stamp_of(a):
    """Changes with the program, the scenes, the judge and the options."""
    digest = hashlib.sha256(repr((a.single, a.symmetry, a.mortar, a.rigid, a.soft)).encode())
    here = os.path.dirname(os.path.abspath(__file__))
    names = ["collide"] + ["collide_" + n for n in ("deck", "judge", "mesh", "scenes")]
    for path in [a.bipact] + [os.path.join(here, n + ".py") for n in names]:
        with open(path, "rb") as file:
            digest.update(file.read())
    return digest.hexdigest()[:12]


def kept(path, a):
    """{number: result} of earlier runs that still hold."""
    done = {}
    if a.fresh and os.path.exists(path):
        os.remove(path)
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            for line in file:
                result = json.loads(line) if line.endswith("\n") else {}
                if (result.get("seed"), result.get("stamp")) == (a.seed, a.stamp):
                    done[result["number"]] = result
    return done


def study(a):
    """Results of all runs, those that are not kept made now."""
    os.makedirs(a.out, exist_ok=True)
    path = os.path.join(a.out, "runs.jsonl")
    done, start = kept(path, a), time.time()
    left = [k for k in range(1, a.count + 1) if k not in done]
    with multiprocessing.Pool(a.jobs) as pool, open(path, "a", encoding="utf-8") as file:
        found = pool.imap_unordered(work, [(k, a) for k in left])
        for count, result in enumerate(found, 1):
            file.write(json.dumps(result) + "\n")
            file.flush()
            done[result["number"]] = result
            if sys.stderr.isatty() or count % 100 == 0 or count == len(left):
                words = "\r%d of %d runs, %.0f s" % (count, len(left), time.time() - start)
                print(words, end="", file=sys.stderr)
    if left:
        print(file=sys.stderr)
    return [done[k] for k in range(1, a.count + 1)]


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add = parser.add_argument
    add("count", nargs="?", type=int, default=200, metavar="N", help="runs (200)")
    add("--seed", type=int, default=1)
    add("--only", type=int, metavar="NUMBER", help="this run alone, with all its figures")
    add("--jobs", type=int, default=os.cpu_count() or 1)
    add("--single", action="store_true", help="some scenes with one contact of all bodies")
    add("--mortar", action="store_true", help="half of the pairs of bodies are mortars")
    add("--rigid", action="store_true", help="some bodies are rigid parts")
    add("--soft", action="store_true", help="hyperelastic bodies, finite deformation")
    add("--no-symmetry", dest="symmetry", action="store_false", help="leave the twins out")
    add("--symmetry", action="store_true", default=True, help="with the twins (default)")
    add("--keep", metavar="DIR", help="decks of failed runs (OUT/failed)")
    add("--fresh", action="store_true", help="forget earlier runs")
    add("--out", metavar="DIR", default=os.path.join(startup.ROOT, "build", "collide"))
    add("--bipact", metavar="PATH", default=startup.program())
    a = parser.parse_args()
    a.bipact = os.path.abspath(a.bipact)
    a.keep = os.path.abspath(a.keep or os.path.join(a.out, "failed"))
    if not os.access(a.bipact, os.X_OK):
        parser.error("%s is not there: make builds it" % a.bipact)
    a.stamp = stamp_of(a)
    return a


def main():
    a = arguments()
    if a.only is not None:
        result = work((a.only, a))
        print(json.dumps(result, indent=1))
        print("decks: %s/seed%d_%d*.k" % (a.keep, a.seed, a.only))
        print("%d passed, %d failed" % (not result["faults"], bool(result["faults"])))
        return 1 if result["faults"] else 0
    return collide_report.close(study(a), os.path.relpath(a.keep), a.mortar, a.soft)


if __name__ == "__main__":
    sys.exit(main())
