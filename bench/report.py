#!/usr/bin/env python3
"""Error against run time: every scheme x allowed mass x mesh x Courant number on exact scenes.

    report.py [--quick | --reduced] [--jobs J] [--out doc/report] [--fresh] [--peers] [--static]
    report.py --one "unaligned|THETA|DISPERSION|1|100|0.5"

Each run is made with tables, for the errors, and up to three times without, for the least
processor time (user + system of the whole process); a long run of bars, of which tables take
1 %, is not made again. Results are kept one line a run in
build/report/runs.jsonl, so that an interrupted study goes on where it stopped; --fresh starts
over. Writes index.md, choose.md (what to take for which need), runs.csv and
figures. --quick takes few meshes and steps and writes to build/report/quick; --reduced takes the
three coarsest meshes of each scene; --peers runs CalculiX where it is
installed, on the same scenes; --static makes only
the part on static contact pairings (static_pairings.py), which has CalculiX beside it wherever it
is installed, --space that on solids (space_forms.py), --finite that at finite deformation
(finite_forms.py); --one makes one run of the study and prints its errors.
"""

import json
import os
import sys
import tempfile

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import combinations
import common
import compare
import finite_forms
import make_bars
import peers
import report_pages
import report_scenes
import space_forms
import static_pairings
from report_figures import write_figures
from report_scenes import BY_BARS, SCENES

COURANT = (0.1, 0.25, 0.5, 0.9, 1.0)


def levels(*n, some=()):
    """{elements along: Courant numbers}: all of them, and some of the largest."""
    return {**dict.fromkeys(n, COURANT), **dict(some)}


# From little more than a start of the program to a thousand times that. The study prints an
# estimate of what it takes: with the schemes and masses of today some four hours of one core.
BARS = levels(50, 100, 200, 400, some={800: (0.25, 0.5, 1.0), 1600: (0.25, 1.0)})
FULL = {
    "aligned": BARS,
    "unaligned": BARS,
    "random": levels(50, 100, 200, 400),
    "poisson": levels(25, 50, 100, some={200: (0.5, 1.0)}),  # the reference has 640
    "unequal": levels(25, 50, 100, 200, some={400: (0.25, 0.5, 1.0)}),
    "bouncing": levels(25, 50, 100, 200, some={400: (0.25, 0.5, 1.0)}),
    "sliding": levels(4, 8, 16, some={32: (0.5, 1.0)}),
    "slip": levels(6, 12, 24, some={48: (0.25, 0.5, 1.0)}),
    "stick": levels(6, 12, 24, some={48: (0.25, 0.5, 1.0)}),
    "block": levels(8, 16, 32, some={64: (0.5, 1.0)}),
    "disc": levels(4, 8, 16, some={32: (0.5, 1.0)}),
}
QUICK = dict.fromkeys(SCENES, {25: (1.0,)})
QUICK.update(aligned={25: (1.0,), 50: (1.0,)}, unaligned={25: (0.5, 1.0)})
QUICK.update(dict.fromkeys(("sliding", "block", "disc"), {4: (1.0,)}))
QUICK.update(dict.fromkeys(("slip", "stick"), {6: (1.0,)}))
STUDIES = {"full": FULL, "quick": QUICK}
# The three coarsest meshes of each scene at Courant number 1/2, the third at 1 too.
REDUCED = {}
for _scene, _grid in FULL.items():
    REDUCED[_scene] = dict(zip(list(_grid)[:3], ((0.5,), (0.5,), (0.5, 1.0))))
STUDIES["reduced"] = REDUCED
FINE = {"nx": 640, "ny": 32, "courant": 0.5}
FINE_QUICK = {"nx": 200, "ny": 10, "courant": 0.5}
ENOUGH = 0.5  # seconds: a run that takes longer is timed once
LONG = 1.0  # seconds: from there on TABLES cost no more than clocks differ
ELEMENT_STEP = 2.5e-7  # seconds, of an estimate: an element, a step, with the contact solve


def grid(study, pairs):
    """All runs of a study {scene: {elements along: Courant numbers}} as dictionaries."""
    for scene in SCENES:
        for method, mass, redist in pairs:
            for n, numbers in study[scene].items():
                for courant in numbers:
                    yield {
                        "scene": scene,
                        "method": method,
                        "mass": mass,
                        "redist": redist,
                        "n": n,
                        "courant": courant,
                    }


def key(run):
    return "|".join(str(run[k]) for k in ("scene", "method", "mass", "redist", "n", "courant"))


def measure(task):
    """One run of the study: its line of results."""
    run, repeats, reference = task
    with tempfile.TemporaryDirectory() as folder:
        deck, out = os.path.join(folder, "run.k"), os.path.join(folder, "out")
        result = dict(run)
        try:
            meta = report_scenes.write_scene(deck, run)
        except ValueError as problem:
            return dict(result, failed=str(problem))
        done = common.run(deck, out, limit=600)
        if done["code"] != 0:
            said = done["errors"].replace(folder + "/", "").splitlines() or ["no word"]
            reason = next((x for x in said if not x.startswith("WARNING")), said[0])
            return dict(result, failed="exit %s: %s" % (done["code"], reason))
        log = common.read_log(out)
        result.update(report_scenes.errors_of(run, out, meta, reference))
        result.update(
            cpu=least_time(run, done["cpu"], deck, out, repeats),
            cpu_tables=done["cpu"],
            steps=log["steps"],
            solves=log["solves"],
            sweeps=log["sweeps"],
            dt=meta["dt"],
            growth=any("energy-growth" in w for w in log.get("warnings", ())),
        )
    return result


def least_time(run, with_tables, deck, out, repeats):
    """Processor time of a run without tables [s], the least of some."""
    if run["scene"] in BY_BARS and with_tables > LONG:
        return with_tables
    silent = common.without_tables(deck)
    times = [common.run(silent, out)["cpu"]]
    while len(times) < repeats and times[0] < ENOUGH:
        times.append(common.run(silent, out)["cpu"])
    return min(times)


def fine_reference(store, fine):
    """History of the fine run for Poisson 0.3, made once."""
    path = os.path.join(store, "poisson_fine.json")
    if not os.path.exists(path):
        with tempfile.TemporaryDirectory() as folder:
            deck, out = os.path.join(folder, "fine.k"), os.path.join(folder, "out")
            meta = make_bars.write(
                deck, poisson=0.3, touch=0.5, tables=["glstat", "nodout"], **fine
            )
            done = common.run(deck, out)
            if done["code"] != 0:
                raise SystemExit("the fine reference failed: " + done["errors"])
            t, u = compare.Run(out, meta).tip()
        with open(path, "w") as file:
            json.dump({"time": t.tolist(), "u": u.tolist(), "touch": meta["touch"]}, file)
    with open(path) as file:
        found = json.load(file)
    return {"time": np.array(found["time"]), "u": np.array(found["u"]), "touch": found["touch"]}


def start_up(store):
    """Processor time of a run of one step of a small scene: what is not stepping. Measured with
    the runs that it stands beside, and kept with them."""
    path = os.path.join(store, "start.json")
    if not os.path.exists(path):
        with tempfile.TemporaryDirectory() as folder:
            deck = os.path.join(folder, "one.k")
            make_bars.write(deck, nx=25, dt=1.0e-5, tend=1.0e-5, tables=["glstat"])
            silent = common.without_tables(deck)
            times = sorted(common.run(silent, folder)["cpu"] for _ in range(25))
        with open(path, "w") as file:
            json.dump(times[len(times) // 2], file)
    with open(path) as file:
        return json.load(file)


def cost(run):
    """Elements times steps, by which runs are put in order: the longest first."""
    n = run["n"]
    across = {"poisson": max(1, n // 10), "sliding": n // 2, "block": n, "disc": 3 * n}
    across.update(slip=10 * n // 3, stick=10 * n // 3)
    times = {"poisson": 8, "bouncing": 16, "sliding": 200, "slip": 2, "stick": 2, "block": 5}
    times.update(disc=15)
    return n * across.get(run["scene"], 2) * n * times.get(run["scene"], 4) / run["courant"]


def estimate(runs, started, repeats):
    """Processor seconds that runs may take, roughly."""
    return sum(
        (repeats + 1) * started + ELEMENT_STEP * cost(r) * min(repeats + 1, 2) for r in runs
    )


def study(wanted, pairs, store, jobs, repeats, started):
    """All runs, those that the store has already left out; returns every line."""
    reference = fine_reference(store, FINE if wanted is FULL else FINE_QUICK)
    # Long runs first, so that no core waits at the end.
    runs = sorted(grid(wanted, pairs), key=cost, reverse=True)
    hours = estimate(runs, started, repeats) / 3600.0
    print("%d runs, about %.2g processor hours if none is kept yet" % (len(runs), hours))
    found = common.sweep(
        measure,
        [(run, repeats, reference) for run in runs],
        lambda task: key(task[0]),
        store,
        jobs,
    )
    return [found[key(run)] for run in grid(wanted, pairs)]


def one(text):
    """The run of a key (a row of runs.csv): its errors, printed."""
    fields = text.split("|")
    run = dict(zip(("scene", "method", "mass"), fields))
    run.update(redist=int(fields[3]), n=int(fields[4]), courant=float(fields[5]))
    store = os.path.join(common.ROOT, "build", "report")
    os.makedirs(store, exist_ok=True)
    reference = fine_reference(store, FINE) if run["scene"] == "poisson" else None
    for name, value in measure((run, 3, reference)).items():
        print("%-10s %s" % (name, value))
    return 0


def main():
    parser = common.study_parser(__doc__)
    parser.add_argument("--peers", action="store_true", help="other programs beside it")
    parser.add_argument(
        "--one", metavar="KEY", help="one run: scene|method|mass|redist|n|courant"
    )
    parser.add_argument("--space", action="store_true", help="solids in space alone")
    parser.add_argument("--finite", action="store_true", help="finite deformation alone")
    parser.add_argument("--static", action="store_true", help="static contact pairings alone")
    a = parser.parse_args()
    if a.one:
        return one(a.one)
    size = "quick" if a.quick else "reduced" if a.reduced else "full"
    store, out = common.study_folders("report", a)
    command = report_pages.COMMANDS[size]
    if not (a.static or a.finite):
        space_forms.write(space_forms.study(store, size, a.jobs), command, out)
    if not (a.static or a.space):
        finite_forms.write(finite_forms.study(store, size, a.jobs), size, command, out)
    if a.space or a.finite:
        return 0
    static = static_pairings.study(store, size, a.jobs, a.peers or size != "quick")
    static_pairings.write(static, size, command, out)
    if a.static:
        return 0
    started = start_up(store)
    pairs, refused = combinations.taken(store, combinations.ONE_MASS)
    repeats = 3 if size == "full" else 1
    results = study(STUDIES[size], pairs, store, a.jobs, repeats, started)
    others = peers.study(store, size) if a.peers else []
    report_pages.write_csv(results + others, out)
    write_figures(results, others, pairs, started, out)
    about = dict(
        size=size, started=started, refused=refused, pairs=pairs, peers=others, static=static
    )
    report_pages.write_index(results, about, out)
    report_pages.write_choose(results, about, out)
    print(
        "%d runs, %d failed: %s"
        % (
            len(results),
            sum("failed" in r for r in results),
            os.path.relpath(os.path.join(out, "index.md")),
        )
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
