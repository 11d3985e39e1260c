#!/usr/bin/env python3
"""Error against run time: every scheme x allowed mass x mesh x Courant number on exact scenes.

    report.py [--quick] [--jobs J] [--out doc/report] [--fresh]

Each run is made with tables, for the errors, and up to three times without, for the least
processor time (user + system of the whole process); a long run of bars, of which tables take
1 %, is not made again. Results are kept one line a run in
build/report/runs.jsonl, so that an interrupted study goes on where it stopped; --fresh starts
over. Writes index.md, runs.csv and figures. --quick takes few meshes and steps and writes to
build/report/quick."""

import csv
import json
import math
import os
import sys
import tempfile

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import common
import compare
import make_bars
import make_scenes
import tables
from analytic import SlidingBlock
from report_figures import front, write_figures

SCHEMES = [
    ("THETA", 0.5, mass, redist)
    for mass in ("CONSISTENT", "LUMPED", "DISPERSION")
    for redist in (0, 1)
]
SCHEMES += [
    ("NEWMARK", 0.5, mass, redist)
    for mass in ("CONSISTENT", "LUMPED", "DISPERSION")
    for redist in (0, 1)
]
SCHEMES += [("THETA", 0.55, "CONSISTENT", 0), ("THETA", 1.0, "CONSISTENT", 0)]
SCENES = {
    "aligned": "two equal bars, touch at the end of a step",
    "unaligned": "two equal bars, touch in mid-step",
    "random": "two equal bars, mesh spacing 5 % random, touch in mid-step",
    "poisson": "two bars with Poisson ratio 0.3, against a fine mesh",
    "unequal": "bar of 5 hits a bar of 10 at rest, touch in mid-step",
    "bouncing": "bar falls on a wall and bounces, one period",
    "sliding": "block slides to rest on a plane",
}
COURANT = (0.1, 0.25, 0.5, 0.9, 1.0)


def levels(*n, some=()):
    """{elements along: Courant numbers}: all of them, and some of the largest."""
    return {**dict.fromkeys(n, COURANT), **dict(some)}


# From little more than a start of the program to a thousand times that.
BARS = levels(50, 100, 200, 400, some={800: (0.25, 0.5, 0.9, 1.0), 1600: (0.25, 1.0)})
FULL = {
    "aligned": BARS,
    "unaligned": BARS,
    "random": BARS,
    "poisson": levels(25, 50, 100, 200),  # the reference has 640
    "unequal": levels(25, 50, 100, 200, 400, some={800: (0.25, 0.5, 1.0)}),
    "bouncing": levels(25, 50, 100, 200, 400, some={800: (0.25, 0.5, 1.0)}),
    "sliding": levels(4, 8, 16, some={32: (0.25, 0.5, 1.0)}),
}
QUICK = dict.fromkeys(SCENES, dict.fromkeys((25, 50), (0.5, 1.0)))
QUICK["sliding"] = dict.fromkeys((2, 4), (0.5, 1.0))
FINE = {"nx": 640, "ny": 32, "courant": 0.5}
FINE_QUICK = {"nx": 200, "ny": 10, "courant": 0.5}
TABLES = ["glstat", "nodout", "rcforc=step"]
BY_BARS = ("aligned", "unaligned", "random", "poisson", "unequal")  # of make_bars.py: TABLES
ENOUGH = 0.5  # seconds: a run that takes longer is timed once
LONG = 1.0  # seconds: from there on TABLES cost no more than clocks differ


def grid(study):
    """All runs of a study {scene: {elements along: Courant numbers}} as dictionaries."""
    for scene in SCENES:
        for scheme, theta, mass, redist in SCHEMES:
            for n, numbers in study[scene].items():
                for courant in numbers:
                    yield {
                        "scene": scene,
                        "scheme": scheme,
                        "theta": theta,
                        "mass": mass,
                        "redist": redist,
                        "n": n,
                        "courant": courant,
                    }


def key(run):
    return "|".join(
        str(run[k]) for k in ("scene", "scheme", "theta", "mass", "redist", "n", "courant")
    )


def write_scene(path, run):
    """Writes the deck of a run; returns the data for the comparison."""
    common_options = dict(
        scheme=run["scheme"], theta=run["theta"], mass=run["mass"], redist=run["redist"]
    )
    if run["scheme"] == "NEWMARK":
        common_options.pop("theta")
    scene, n, courant = run["scene"], run["n"], run["courant"]
    if scene == "bouncing":
        return make_scenes.write(path, "bouncing", n=n, courant=courant, **common_options)
    if scene == "sliding":
        return make_scenes.write(path, "sliding", n=n, courant=courant, **common_options)
    options = dict(common_options, nx=n, courant=courant, tables=TABLES)
    options.update(
        {
            "aligned": dict(touch=0.0),
            "unaligned": dict(touch=0.5),
            "random": dict(touch=0.5, random=(0.05, 7)),
            "poisson": dict(touch=0.5, poisson=0.3, ny=max(1, n // 10)),
            "unequal": dict(touch=0.5, length=5.0, length2=10.0, v1=1.0, v2=0.0),
        }[scene]
    )
    return make_bars.write(path, **options)


def errors_of(run, folder, meta, reference):
    """{measure: value or None} of a finished run."""
    scene = run["scene"]
    if scene == "bouncing":
        exact, dt = meta["exact"], meta["dt"]
        rows = tables.read_run(folder, "nodout").select(node=meta["face"][0])
        z = exact.bottom(rows["time"])
        force, found = tables.read_run(folder, "rwforc"), {}
        found["err"] = math.sqrt(
            np.sum((rows["ux"] + exact.height - z) ** 2) / np.sum((z - exact.height) ** 2)
        )
        fine = np.linspace(0.5 / 16, 1.0 - 0.5 / 16, 16)
        steps = np.array([exact.force(t - dt + dt * fine).mean() for t in force["time"][1:]])
        found["e_R"] = np.abs(force["fx"][1:] - steps).sum() / steps.sum()
        two = 0.5 * (steps[1:] + steps[:-1])
        found["e_R2"] = np.abs(force["fmx"][2:] - two).sum() / two.sum()
        glstat = tables.read_run(folder, "glstat")
        gain = glstat["total"][-1] - glstat["external"][-1] - glstat["total"][0]
        found["energy"] = abs(gain) / exact.energy
        return found
    if scene == "sliding":
        exact = SlidingBlock(meta["v"], meta["mu"], meta["g"], meta["mass"])
        parts = tables.read_run(folder, "matsum")
        place = np.concatenate(
            (
                [0.0],
                np.cumsum(0.5 * (parts["vx"][1:] + parts["vx"][:-1]) * np.diff(parts["time"])),
            )
        )
        wanted = exact.place(parts["time"])
        force = tables.read_run(folder, "rwforc")
        slides = force["time"] < exact.stop
        wanted_force = meta["mu"] * meta["mass"] * meta["g"]
        work = tables.read_run(folder, "glstat")["friction"]
        return {
            "err": math.sqrt(np.sum((place - wanted) ** 2) / np.sum(wanted**2)),
            "e_R": np.abs(np.abs(force["fx"][1:]) - wanted_force)[slides[1:]].mean()
            / wanted_force,
            "e_R2": np.abs(np.abs(force["fmx"][2:]) - wanted_force)[slides[2:]].mean()
            / wanted_force,
            "energy": abs(work[-1] - exact.friction_work(9.0)) / exact.friction_work(9.0),
        }
    found = compare.measure(folder, meta)
    if scene == "poisson":
        t, u = compare.Run(folder, meta).tip()
        shift = meta["touch"] - reference["touch"]
        wanted = np.interp(t - shift, reference["time"], reference["u"]) + shift * meta["v0"]
        inside = t - shift <= reference["time"][-1]
        err = math.sqrt(np.sum((u - wanted)[inside] ** 2) / np.sum(wanted[inside] ** 2))
        return {"err": err, "e_R": None, "e_R2": None, "energy": abs(found["dE_end"])}
    return {
        "err": found["err"],
        "e_R": found["e_R"],
        "e_R2": found["e_R2"],
        "energy": abs(found["dE_end"]),
    }


def measure(task):
    """One run of the study: its line of results."""
    run, repeats, reference = task
    with tempfile.TemporaryDirectory() as folder:
        deck, out = os.path.join(folder, "run.k"), os.path.join(folder, "out")
        result = dict(run)
        try:
            meta = write_scene(deck, run)
        except ValueError as problem:
            return dict(result, failed=str(problem))
        done = common.run(deck, out, limit=600)
        if done["code"] != 0:
            reason = done["errors"].replace(folder + "/", "").splitlines() or ["no word"]
            return dict(result, failed="exit %s: %s" % (done["code"], reason[0]))
        log = common.read_log(out)
        result.update(
            {
                k: (None if v is None else float(v))
                for k, v in errors_of(run, out, meta, reference).items()
            }
        )
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
    across = {"poisson": n // 10, "sliding": n // 2}.get(run["scene"], 1)
    return n * across * n / run["courant"]


def study(wanted, store, jobs, repeats):
    """All runs, those that the store has already left out; returns every line."""
    reference = fine_reference(store, FINE_QUICK if wanted is QUICK else FINE)
    # Long runs first, so that no core waits at the end.
    runs = sorted(grid(wanted), key=cost, reverse=True)
    found = common.sweep(
        measure,
        [(run, repeats, reference) for run in runs],
        lambda task: key(task[0]),
        store,
        jobs,
    )
    return [found[key(run)] for run in grid(wanted)]


def time_to(runs, measure_name, goal):
    """Least processor time that reaches an error: by log interpolation on the front of the
    runs."""
    best = [(r["cpu"], r[measure_name]) for r in front(runs, measure_name)]
    for (t0, e0), (t1, e1) in zip([(None, None)] + best, best):
        if e1 <= goal:
            if t0 is None or e0 == e1:
                return t1
            w = math.log(e0 / goal) / math.log(e0 / e1)
            return math.exp((1.0 - w) * math.log(t0) + w * math.log(t1))
    return None


def order(runs, measure_name, courant):
    """Slope of log error over log n at one Courant number."""
    points = sorted(
        (r["n"], r[measure_name])
        for r in runs
        if r["courant"] == courant and r.get(measure_name) and "failed" not in r
    )
    if len(points) < 3:
        return None
    n, e = np.log(np.array(points)).T
    return -np.polyfit(n, e, 1)[0]


def seconds(value):
    return "not reached" if value is None else "%.3f" % value


def best_choice(results, scene, goal):
    """The cheapest run of a scene whose displacement error meets a goal and whose energy does
    not grow."""
    fit = [
        r
        for r in results
        if r["scene"] == scene
        and "failed" not in r
        and r["err"] is not None
        and r["err"] <= goal
        and not r["growth"]
    ]
    return min(fit, key=lambda r: r["cpu"], default=None)


def describe(run):
    if run is None:
        return "not reached"
    return "%s, n %d, Courant %g: %.3f s" % (
        common.label(run),
        run["n"],
        run["courant"],
        run["cpu"],
    )


def write_index(results, out, started, quick):
    """index.md: what to take, then the tables."""
    lines = [
        "# Error against run time",
        "",
        "%s, %s. Processor time is user + system of the whole process, tables off, the least of "
        "a few runs; "
        "a start without steps costs %.1f ms of it, the longest run takes %.1f s. %d runs, %d "
        "failed. Made by `make report%s`."
        % (
            common.today(),
            common.machine(),
            1e3 * started,
            max(r.get("cpu", 0.0) for r in results),
            len(results),
            sum("failed" in r for r in results),
            " QUICK=1" if quick else "",
        ),
        "",
        "C consistent, L lumped, D dispersion-tuned mass; * massless contact nodes (REDIST 1). n elements "
        "along the first body, Courant number c dt/h.",
        "",
        "## What to take",
        "",
        "The cheapest run without energy growth whose displacement error is at most 1e-2 and 1e-3:",
        "",
        "| scene | to 1e-2 | to 1e-3 |",
        "|---|---|---|",
    ]
    for scene, title in SCENES.items():
        lines.append(
            "| %s | %s | %s |"
            % (
                title,
                describe(best_choice(results, scene, 1.0e-2)),
                describe(best_choice(results, scene, 1.0e-3)),
            )
        )
    lines += [
        "",
        advice(results),
        "",
        "## Time to an error of the displacement [s]",
        "",
        "By interpolation on the front of each combination.",
        "",
    ]
    for goal in (1.0e-2, 1.0e-3):
        lines += [
            "**to %g**" % goal,
            "",
            "| | " + " | ".join(SCENES) + " |",
            "|---|" + "---|" * len(SCENES),
        ]
        for scheme in SCHEMES:
            mine = [
                r
                for r in results
                if "failed" not in r
                and (r["scheme"], r["theta"], r["mass"], r["redist"]) == scheme
            ]
            cells = [
                seconds(time_to([r for r in mine if r["scene"] == scene], "err", goal))
                for scene in SCENES
            ]
            lines.append("| %s | %s |" % (common.label(scheme), " | ".join(cells)))
        lines.append("")
    lines += order_table(results)
    lines += failure_table(results)
    lines += ["## Figures", "", FIGURES, ""]
    lines += ["![%s](%s.png)" % (scene, scene) for scene in SCENES]
    lines += ["", "Every run with all its figures: [runs.csv](runs.csv).", ""]
    with open(os.path.join(out, "index.md"), "w") as file:
        file.write("\n".join(lines))


FIGURES = (
    "One line a combination: the front of its best runs, those that no other run of it beats in "
    "both time and error; thin lines lead from its end, beyond which more time buys nothing, to "
    "its name. The vertical line is a start without steps. Errors of 1e-7 and less are "
    "round-off: they stand at the lower edge with their value."
)


def advice(results):
    """One sentence from the counts of the table."""
    wins = {}
    for scene in SCENES:
        for goal in (1.0e-2, 1.0e-3):
            run = best_choice(results, scene, goal)
            if run:
                name = common.label(run)
                wins[name] = wins.get(name, 0) + 1
    ranked = sorted(wins.items(), key=lambda item: -item[1])
    grown = sorted({common.label(r) for r in results if r.get("growth")})
    return "Most often cheapest: %s. Energy grew, and the log said so, in some run of: %s." % (
        ", ".join("%s (%d)" % item for item in ranked[:4]) or "none",
        ", ".join(grown) or "none",
    )


def order_table(results):
    """Observed orders in mesh and step together at Courant 1/2."""
    lines = [
        "## Observed orders",
        "",
        "Slope of the error over n at Courant 1/2 (mesh and step together). Theory: across a velocity jump "
        "every scheme is of first order or less in displacement, about 0.7 with the consistent mass; the raw "
        "force of THETA 1/2 does not converge, its two-step mean does; 2 holds for smooth motion only.",
        "",
        "| | "
        + " | ".join("%s err / e_R2" % s for s in ("aligned", "unaligned", "random", "unequal"))
        + " |",
        "|---|---|---|---|---|",
    ]
    for scheme in SCHEMES:
        mine = [
            r for r in results if (r["scheme"], r["theta"], r["mass"], r["redist"]) == scheme
        ]
        cells = []
        for scene in ("aligned", "unaligned", "random", "unequal"):
            pair = [
                order([r for r in mine if r["scene"] == scene], name, 0.5)
                for name in ("err", "e_R2")
            ]
            cells.append(" / ".join("-" if p is None else "%.2f" % p for p in pair))
        lines.append("| %s | %s |" % (common.label(scheme), " | ".join(cells)))
    return lines + [""]


def failure_table(results):
    """Runs that failed, grouped by reason."""
    reasons = {}
    for r in results:
        if "failed" in r:
            name = (common.label(r), r["scene"], r["failed"][:110])
            reasons[name] = reasons.get(name, 0) + 1
    lines = ["## Failures", ""]
    if not reasons:
        return lines + ["None.", ""]
    lines += ["| combination | scene | runs | reason |", "|---|---|---|---|"]
    for (name, scene, reason), n in sorted(reasons.items()):
        lines.append("| %s | %s | %d | %s |" % (name, scene, n, reason.replace("|", "/")))
    return lines + [""]


def write_csv(results, out):
    names = [
        "scene",
        "scheme",
        "theta",
        "mass",
        "redist",
        "n",
        "courant",
        "dt",
        "err",
        "e_R",
        "e_R2",
        "energy",
        "cpu",
        "cpu_tables",
        "steps",
        "solves",
        "sweeps",
        "growth",
        "failed",
    ]
    with open(os.path.join(out, "runs.csv"), "w", newline="") as file:
        writer = csv.DictWriter(file, names, lineterminator="\n")
        writer.writeheader()
        for r in results:
            writer.writerow(
                {
                    k: ("%.4g" % v if isinstance(v, float) else v)
                    for k, v in r.items()
                    if k in names
                }
            )


def main():
    a = common.study_arguments(__doc__)
    store, out = common.study_folders("report", a)
    started = start_up(store)
    results = study(QUICK if a.quick else FULL, store, a.jobs, 1 if a.quick else 3)
    write_csv(results, out)
    write_figures(results, SCENES, SCHEMES, started, out)
    write_index(results, out, started, a.quick)
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
