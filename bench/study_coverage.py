#!/usr/bin/env python3
"""Are the bars of scripts/study.py honest? Studies of scenes with exact solutions, how often
the error that a study gives a run is within its bar of the true one.

    study_coverage.py [--quick] [--jobs J] [--out DIR] [scene ...]

A point is one quantity of one run. Printed for each scene: the share of points with |estimate -
true| <= bar; the share of bars that are at most 3 true errors wide; the share of points of
which the study says that they do not converge, for THETA and PAOLI, and for the force of
NEWMARK with mass on its contact nodes; and what the choices for 1e-2 cost over the cheapest run
that truly reaches 1e-2, in counted work."""

import argparse
import math
import os
import sys

import common
import make_bars
import make_scenes
import numpy as np
import study
import study_estimate
import study_page
from analytic import SlidingBlock, impact_of
from study_estimate import Quantity, distance, spread_of
from tables import read_run

SCENES = ("aligned", "unaligned", "wall", "sliding")
GOAL = 1.0e-2
MESHES = {"given": [], "refined": ["--steps", "1,0.5,0.25"], "one": ["--refine", "0"]}


def write_decks(scene, folder, sizes):
    """Decks of a scene on its meshes; paths, and the data of the first."""
    paths, metas = [], []
    for n in sizes:
        path = os.path.join(folder, "%s%d.k" % (scene, n))
        if scene in ("aligned", "unaligned"):
            tables = ["glstat", "matsum", "nodout", "rcforc=step"]
            gap = {"gap": 0.02} if scene == "aligned" else {"gap": 0.0193}
            metas.append(make_bars.write(path, nx=n, courant=1.0, tables=tables, **gap))
        elif scene == "wall":
            metas.append(make_scenes.write(path, "wall", n=n, courant=1.0, gap=0.0097))
        else:
            metas.append(make_scenes.write(path, "sliding", n=n, courant=0.5, output=5.0e-3))
        paths.append(path)
    return paths, metas


# ---------------------------------------------------------------- truth


def part_energies(exact, t, what, parts):
    pairs = [[exact._bar_energies(i, s) for i in range(parts)] for s in t]
    return np.array(pairs)[:, :, 0 if what == "kinetic" else 1, None]


def part_velocities(exact, t, parts):
    speeds = np.stack(exact.mean_velocities(t)[:parts], axis=-1)
    return np.stack([speeds, 0.0 * speeds], axis=-1)


def true_nodes(exact, meta, nodes, t):
    """Exact displacements of contact faces and free ends."""
    columns = []
    for node in nodes:
        if node in meta["face1"]:
            columns.append(exact.displacement(t)[0])
        elif node in meta["face2"]:
            columns.append(exact.displacement(t)[1])
        else:
            columns.append(free_end(exact, meta["free_ends"].index(node) // 2, t))
    u = np.stack(columns, axis=-1)
    return np.stack([u, 0.0 * u], axis=-1)


def free_end(exact, i, t):
    """Displacement of a free end: it has the velocity of the wave that arrives there, which
    left the contact L/c before."""
    bar, wave = exact.bars[i], exact.waves[i]
    times = np.array([0.0] + [x + bar.length / bar.speed for x in wave.times[1:]])
    ends = np.append(times, max(2.0 * t[-1], times[-1]))
    u = np.concatenate([[0.0], np.cumsum(np.array(wave.values) * np.diff(ends))])
    return np.interp(t, ends, u)


def truth_of(meta, folder, found):
    """Exact counterparts of the quantities of a run of bars."""
    exact, truth = impact_of(meta, meta["tend"] * (1.0 + 1e-9)), {}
    for name, q in found.items():
        t, (table, what) = q.times, name.split(" ")
        if table == "sleout":
            continue
        if table == "nodout":
            nodes = list(dict.fromkeys(read_run(folder, "nodout")["node"].tolist()))
            values = true_nodes(exact, dict({"face2": ()}, **meta), nodes, t)
            if what == "velocity":
                values = study_estimate.velocity_of(t, values)
        elif table == "matsum" and what == "velocity":
            values = part_velocities(exact, t, q.values.shape[1])
        elif table == "matsum":
            values = part_energies(exact, t, what, q.values.shape[1])
        elif table == "glstat":
            values = true_energy(exact, meta, t, what)[:, None, None]
        else:
            impulse = -exact.impulse(t)
            values = np.stack([impulse, 0.0 * t], axis=-1)[:, None, :]
        truth[name] = Quantity(q.kind, t, values, q.group)
    return truth


def true_energy(exact, meta, t, what):
    kinetic, strain = exact.energies(t)
    share = 0.5 if meta["case"] == "wall" else 1.0
    exact_values = {"kinetic": kinetic, "internal": strain, "total": kinetic + strain}
    return share * exact_values.get(what, 0.0 * t)


def truth_of_block(meta, found):
    """Closed form of a rigid block: an elastic one differs from it by its vibration, whose
    internal energy is not compared."""
    rigid = SlidingBlock(meta["v"], meta["mu"], meta["g"], meta["mass"])
    truth = {}
    for name, q in found.items():
        t, what = q.times, name.split(" ")[1]
        v = np.maximum(0.0, meta["v"] - meta["mu"] * meta["g"] * t)
        kinetic = 0.5 * meta["mass"] * v**2
        if what in ("kinetic", "total"):
            values = kinetic[:, None, None]
        elif what == "friction":
            values = rigid.friction_work(t)[:, None, None]
        elif what == "velocity":
            values = np.stack([v, 0.0 * t], axis=-1)[:, None, :]
        elif what in ("force", "impulse"):
            weight = meta["mass"] * meta["g"]
            push = -meta["mu"] * weight * np.minimum(t, rigid.stop)
            values = np.stack([push, weight * t], axis=-1)[:, None, :]
        else:
            continue
        truth[name] = Quantity(q.kind, t, values, q.group)
    return truth


# ---------------------------------------------------------------- the scores


def units_of(truth, found):
    """What distances are divided by, of the truth."""
    groups = {}
    for name, q in truth.items():
        group = found[name].group or name
        groups[group] = max(groups.get(group, 0.0), spread_of(q))
    return {name: groups[found[name].group or name] for name in truth}


def score(scene, folder, sizes, words, own_mesh=False):
    """Points [(run, quantity, estimate, bar, true, stuck)] of a study, and its choices;
    own_mesh: only the first deck is given, and refined or not as the words say."""
    paths, metas = write_decks(scene, folder, sizes)
    if own_mesh:
        paths, metas = paths[:1], len(sizes) * metas[:1]
    else:
        words = ["--steps", "1,0.5,0.25", *words]
    words = [*paths, "-o", os.path.join(folder, scene), *words]
    s, widths, endings, _, _ = study.run_study(study.arguments(words))
    results, estimates, histories = study.evaluate(s, widths, endings)
    points, units = [], None
    for run in sorted(histories, key=lambda r: r.dt):
        found = histories[run]
        if scene == "sliding":
            truth = truth_of_block(metas[run.mesh], found)
        else:
            truth = truth_of(metas[run.mesh], s.folder(run), found)
        units = units or units_of(truth, found)  # of the smallest step
        for name, e in estimates.items():
            if name in truth and run in e.errors and name in found:
                true = distance(found[name], truth[name], units[name])
                stuck = run.method in e.stuck
                points.append((run, name, e.errors[run], e.bars[run], true, stuck))
    return points, results, estimates


def report(points, results, estimates):
    """The figures of a scene as one line; counts for the sum."""
    covered = [abs(p[2] - p[4]) <= p[3] for p in points]
    narrow = [p[3] <= 3.0 * p[4] for p in points]
    stays = [p[5] for p in points]
    good = [b for p, b in zip(points, stays) if p[0].variant[0][1] in ("THETA", "PAOLI")]
    massive = [
        b
        for p, b in zip(points, stays)
        if p[0].variant[0][1] == "NEWMARK" and not p[0].redist and p[1].endswith(" force")
    ]
    ratios = choice_ratios(points, results, estimates)
    counts = np.array([[sum(x), len(x)] for x in (covered, narrow, good, massive)])
    return counts, ratios


def choice_ratios(points, results, estimates):
    """{quantity: work of the choice for 1e-2 over that of the cheapest run that truly is as
    good, true error of the choice}"""
    found = {}
    for name, e in estimates.items():
        mine = {p[0]: p[4] for p in points if p[1] == name}
        if not mine:
            continue
        reach = [results[r].work for r, true in mine.items() if true <= GOAL]
        choice = study_page.cheapest(e, results, GOAL, "work")
        if reach and choice:
            found[name] = results[choice].work / min(reach), mine[choice]
        elif choice:
            found[name] = 0.0, mine[choice]  # it is not as good, nor is any other
        elif reach and e.bar <= GOAL:
            found[name] = math.inf, math.nan
        elif reach:
            found[name] = None, e.bar
    return found


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add = parser.add_argument
    add("scenes", nargs="*", metavar="scene", help="of %s" % " ".join(SCENES))
    add("--quick", action="store_true", help="small meshes; without the sliding block")
    add("--mesh", choices=sorted(MESHES), default="given", help="three decks or one of them")
    add("--verbose", action="store_true", help="quantities one by one")
    add("--jobs", type=int, default=os.cpu_count() or 1)
    add("--out", default=os.path.join(common.ROOT, "build", "study"), metavar="DIR")
    a = parser.parse_args()
    names = a.scenes or (SCENES[:3] if a.quick else SCENES)
    folder = os.path.join(a.out, "%s-%s" % ("quick" if a.quick else "full", a.mesh))
    os.makedirs(folder, exist_ok=True)
    total = np.zeros((4, 2))
    print("scene        points  covered   narrow    stays  NEWMARK")
    for scene in names:
        sizes = (25, 50, 100) if a.quick else (50, 100, 200)
        sizes = (4, 8, 16) if scene == "sliding" else sizes
        words = ["--jobs", str(a.jobs), *MESHES[a.mesh]]
        points, results, estimates = score(scene, folder, sizes, words, a.mesh != "given")
        counts, ratios = report(points, results, estimates)
        total += counts
        print(line(scene, counts), flush=True)
        for name, (ratio, value) in ratios.items():
            text = "work x %s, true error %.2g" % (ratio, value)
            if ratio is None:
                text = "none, the bar is %.2g" % value
            print("    choice for %g, %s: %s" % (GOAL, name, text))
        if a.verbose:
            show(points)
    print(line("all", total))


def show(points):
    """Quantities one by one: where the bars miss."""
    names = dict.fromkeys(p[1] for p in points)
    for name in names:
        mine = [p for p in points if p[1] == name]
        missed = [p for p in mine if abs(p[2] - p[4]) > p[3]]
        off = max(abs(p[2] - p[4]) / (1.0 + p[2]) for p in mine)
        wide = np.median([p[3] / max(p[4], 1e-15) for p in mine])
        words = (name, len(missed), len(mine), wide, off, min(p[3] for p in mine))
        print(
            "    %s: %d of %d missed, median bar/true %.2f, reference off by %.3g, bar %.3g"
            % words
        )


def line(name, counts):
    shares = [c / n if n else math.nan for c, n in counts]
    return "%-10s %8d %8.3f %8.3f %8.3f %8.3f" % (name, counts[0][1], *shares)


if __name__ == "__main__":
    main()
