"""Pages of the report, from its runs: index.md (tables), choose.md (what to take), runs.csv."""

import csv
import math
import os

import common
import numpy as np
from combinations import EXPLICIT, refusal_table
from report_figures import MEASURES, front
from report_scenes import FINE, SCENES, kept_reference
from static_pairings import choice_lines

COLUMNS = (
    "program scene method mass redist n courant dt err e_v e_R e_R2 energy work cpu cpu_tables "
    "steps solves sweeps growth failed"
).split()
COMMANDS = {"full": "make report", "quick": "make report QUICK=1", "reduced": "make report REDUCED=1"}
ORDER_SCENES = ("aligned", "unaligned", "random", "unequal", "slip", "block")
GOALS = (1.0e-1, 1.0e-2, 1.0e-3)


def of_pair(results, pair, scene=None):
    """Runs of a combination, of one scene or of all."""
    return [
        r
        for r in results
        if (r["method"], r["mass"], r["redist"]) == pair and scene in (None, r["scene"])
    ]


def time_to(runs, measure_name, goal):
    """Least processor time that reaches an error: by log interpolation on the front of the
    runs."""
    best = [(r["cpu"], r[measure_name]) for r in front(runs, measure_name)]
    for (t0, e0), (t1, e1) in zip([(None, None)] + best, best):
        if e1 <= goal:
            if t0 is None or e0 == e1 or e1 == 0.0:
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
    return "-" if value is None else "%.3f" % value


def best_choice(results, scene, goal, name="err", keep=None):
    """The cheapest run of a scene whose error meets a goal and whose energy does not grow."""
    fit = [
        r
        for r in results
        if r["scene"] == scene
        and r.get(name) is not None
        and r[name] <= goal
        and not r["growth"]
        and (keep is None or keep(r))
    ]
    return min(fit, key=lambda r: r["cpu"], default=None)


def describe(run):
    if run is None:
        return "not reached"
    words = (common.label(run), run["n"], run["courant"], run["cpu"])
    return "%s, n %d, Courant %g: %.3f s" % words


def head(results, about):
    """What was run, where, when."""
    size = about["size"]
    found = [
        "%s, %s. Processor time is user + system of the whole process, tables off%s; a start "
        "without steps costs %.1f ms of it, the longest run takes %.1f s. %d runs, %d failed. Made "
        "by `%s`."
        % (
            common.today(),
            common.machine(),
            ", the least of a few runs" if size == "full" else "",
            1e3 * about["started"],
            max(r.get("cpu", 0.0) for r in results),
            len(results),
            sum("failed" in r for r in results),
            COMMANDS[size],
        ),
        "",
    ]
    if size != "full":
        found += [
            "**Part of the study**: the three coarsest meshes of each scene at Courant 1/2, the third "
            "at 1 too, each "
            "timed once. The whole: `make report` (hours; it goes on where it stopped).",
            "",
        ]
    return found


def write_index(results, about, out):
    """index.md: the tables."""
    lines = ["# Error against run time", ""] + head(results, about)
    lines += [
        "C consistent, L lumped, D dispersion-tuned mass; * massless contact nodes (REDIST 1). n "
        "elements along the first body, Courant number c dt/h. What to take for which need: "
        "[choose.md](choose.md).",
        "",
        "Errors: `err` displacement of the contact face, relative, mean square over time; `e_v` its "
        "velocity as the tables hold it (thrown bodies: of the centre), mean over time over the "
        "speed of impact; `e_R`, `e_R2` contact force of a step, of two steps, summed over time over "
        "the impulse (thrown bodies: impulses of a sixtieth of the run); `energy` at the end over "
        "that at the start; `work` of friction, relative.",
        "",
        "| scene | |",
        "|---|---|",
    ]
    lines += ["| %s | %s |" % item for item in SCENES.items()]
    lines += reference_lines() + [""]
    lines += ["## Time to an error [s]", "", "By interpolation on the front of each combination.", ""]
    for name in ("err", "e_R2", "work"):
        for goal in GOALS[1:] if name == "err" else GOALS[:2]:
            lines += time_table(results, about["pairs"], name, goal)
    lines += order_table(results, about["pairs"])
    lines += failure_table(results)
    lines += ["## Combinations that the program does not take", ""]
    lines += refusal_table(about["refused"]) + [""]
    lines += ["## Figures", "", FIGURES, ""]
    lines += ["![%s](%s.png)" % (scene, scene) for scene in SCENES]
    lines += ["", "Every run with all its figures: [runs.csv](runs.csv).", ""]
    lines += STATIC
    lines += peer_lines(about["peers"])
    with open(os.path.join(out, "index.md"), "w") as file:
        file.write("\n".join(lines))


FIGURES = (
    "One line a combination: the front of its best runs, those that no other run of it beats in "
    "both time and error; thin lines lead from its end, beyond which more time buys nothing, to "
    "its name. Named and coloured are those on the front of all, the lowest, and THETA C, the method "
    "of the paper; the others are grey. The vertical line is a start without steps. Errors of 1e-7 and less are "
    "round-off: they stand at the lower edge with their value."
)


STATIC = ["## Static contact", "", "NODE and MORTAR on closed forms: [static.md](static.md).", ""]
STATIC += ["## In space", "", "Forms of solids and masses on exact scenes: [space.md](space.md).", ""]
STATIC += ["## Finite deformation", "", "Forces of a step and schemes: [finite.md](finite.md).", ""]


def reference_lines():
    """The bounds of the kept references."""
    lines = ["", "References of the thrown bodies are fine runs kept as numbers; below their own "]
    lines[-1] += "bound a difference is no finding (`bench/references.py` makes them anew):"
    lines.append("")
    for scene in FINE:
        kept = kept_reference(scene)
        bounds = ", ".join("%s %.1e" % item for item in kept["bound"].items())
        lines.append("- %s: %s. Bound: %s." % (scene, kept["made"], bounds))
    return lines


def time_table(results, pairs, name, goal):
    """Least times to an error: combinations x scenes that have it."""
    scenes = [s for s in SCENES if any(r["scene"] == s and r.get(name) for r in results)]
    lines = ["**%s to %g**" % (MEASURES[name], goal), "", "| | %s |" % " | ".join(scenes)]
    lines.append("|---" * (len(scenes) + 1) + "|")
    for pair in pairs:
        cells = [seconds(time_to(of_pair(results, pair, s), name, goal)) for s in scenes]
        if any(c != "-" for c in cells):
            lines.append("| %s | %s |" % (common.label(pair), " | ".join(cells)))
        else:
            lines.append("| %s | nowhere%s |" % (common.label(pair), " |" * (len(scenes) - 1)))
    return lines + [""]


def order_table(results, pairs):
    """Observed orders in mesh and step together at Courant 1/2."""
    names = ["%s err / e_R2" % s for s in ORDER_SCENES]
    lines = [
        "## Observed orders",
        "",
        "Slope of the error over n at Courant 1/2 (mesh and step together). Theory: across a "
        "velocity jump every scheme is of first order or less in displacement, about 0.7 with the "
        "consistent mass; the raw force of THETA 1/2 does not converge, its two-step mean does; 2 "
        "holds for smooth motion only.",
        "",
        "| | " + " | ".join(names) + " |",
        "|---" * (len(names) + 1) + "|",
    ]
    for pair in pairs:
        cells = []
        for scene in ORDER_SCENES:
            runs = of_pair(results, pair, scene)
            found = [order(runs, name, 0.5) for name in ("err", "e_R2")]
            cells.append(" / ".join("-" if p is None else "%.2f" % p for p in found))
        lines.append("| %s | %s |" % (common.label(pair), " | ".join(cells)))
    return lines + [""]


def failure_table(results):
    """Runs that failed, grouped by reason."""
    reasons = {}
    for r in results:
        if "failed" in r:
            words = r["failed"].partition(": ")[2] if "step " in r["failed"] else r["failed"]
            name = (common.label(r), r["scene"])
            reasons.setdefault(name, []).append(words[:110].replace("|", "/"))
    lines = ["## Failures", ""]
    if not reasons:
        return lines + ["None.", ""]
    lines += ["| combination | scene | runs | reason, of the first |", "|---|---|---|---|"]
    for (name, scene), found in sorted(reasons.items()):
        lines.append("| %s | %s | %d | %s |" % (name, scene, len(found), found[0]))
    return lines + [""]


def peer_lines(peers):
    """Runs of other programs, with versions and commands."""
    if not peers:
        return []
    lines = ["## Other programs", "", "Decks written by `bench/peers.py`, run by `make report PEERS=1`."]
    lines += ["", "| program | scene | n | Courant | err | e_v | energy | time [s] | command |"]
    lines.append("|---" * 9 + "|")
    for r in peers:
        cells = [r["program"], r["scene"], r["n"], r["courant"]]
        if "failed" in r:
            cells += [r["failed"][:60].replace("|", "/"), "", "", "", "`%s`" % r["command"]]
        else:
            cells += ["-" if r.get(k) is None else "%.2e" % r[k] for k in ("err", "e_v", "energy")]
            cells += ["%.2f" % r["cpu"], "`%s`" % r["command"]]
        lines.append("| %s |" % " | ".join(map(str, cells)))
    return lines + [""]


# ---------------------------------------------------------------- what to take

IMPACT = ("aligned", "unaligned", "random", "unequal", "bouncing")
ROUGH = ("slip", "stick", "block", "disc")
# Need: (words, measure, goals, scenes, runs that count)
NEEDS = (
    ("Displacement across an impact", "err", (1e-2, 3e-3), IMPACT, None),
    ("Displacement in the plane, with friction", "err", (3e-2, 1e-2), ROUGH + ("poisson",), None),
    ("Velocity of the contact face", "e_v", (5e-2, 2e-2), IMPACT, None),
    ("Contact force of single steps", "e_R", (5e-2, 2e-2), IMPACT + ("slip", "stick"), None),
    ("Contact force as the mean of two steps", "e_R2", (5e-2, 2e-2), IMPACT + ROUGH, None),
    ("Energy kept through impacts", "energy", (1e-2, 1e-3), IMPACT, None),
    ("Work of friction", "work", (1e-1, 3e-2), ("sliding", "slip", "block", "disc"), None),
    (
        "Explicit: no factorisation, small steps",
        "err",
        (3e-2, 1e-2),
        IMPACT + ROUGH,
        lambda pair: pair[0] in EXPLICIT,
    ),
)


def ranking(results, pairs, name, goal, scenes):
    """[(mean ratio of time to the best, scenes reached, combination)], best first: a scene that a
    combination does not reach counts ten times the slowest that does (performance profiles of
    Dolan and More 2002 at infinity and one come to the same order)."""
    total, reached = dict.fromkeys(pairs, 0.0), dict.fromkeys(pairs, 0)
    counted = 0
    for scene in scenes:
        times = {}
        # A goal below the bound of a kept reference is no finding.
        if scene in FINE and kept_reference(scene)["bound"][name] > goal:
            continue
        for p in pairs:
            runs = [r for r in of_pair(results, p, scene) if not r.get("growth")]
            t = time_to(runs, name, goal)
            if t is not None:
                times[p] = t
        if not times:
            continue
        counted += 1
        least, worst = min(times.values()), 10.0 * max(times.values())
        for p in pairs:
            total[p] += math.log(times.get(p, worst) / least)
            reached[p] += p in times
    rows = [(math.exp(total[p] / max(1, counted)), reached[p], p) for p in pairs if reached[p]]
    return counted, sorted(rows, key=lambda row: (row[0], row[2]))


def need_lines(results, about, need):
    """One need: its best three at each goal, the run to make again, the curves."""
    words, name, goals, scenes, keep = need
    pairs = [p for p in about["pairs"] if keep is None or keep(p)]
    lines = ["## " + words, ""]
    for goal in goals:
        counted, rows = ranking(results, pairs, name, goal, scenes)
        if not rows:
            lines.append("- to %g: no run reaches it." % goal)
            continue
        named = [
            "%s (%.1f, %d of %d)" % (common.label(p), ratio, n, counted)
            for ratio, n, p in rows[:3]
        ]
        lines.append("- to %g: %s" % (goal, ", ".join(named)))
        best = rows[0][2]
        for scene in scenes:
            run = best_choice(of_pair(results, best), scene, goal, name)
            if run:
                key = "|".join(str(run[k]) for k in "scene method mass redist n courant".split())
                lines.append(
                    "  - %s, %s %.1e in %.3f s: `.venv/bin/python bench/report.py --one '%s'`"
                    % (describe(run).partition(":")[0], name, run[name], run["cpu"], key)
                )
                break
    curves = ", ".join("[%s](%s.png)" % (s, s) for s in scenes)
    return lines + ["- curves, panel \"error of the %s\": %s" % (MEASURES[name], curves), ""]


def write_choose(results, about, out):
    """choose.md: best per need, from the stored runs."""
    lines = ["# Which scheme and mass to take", ""] + head(results, about)
    lines += [
        "For each need the three combinations that reach a given error at least cost, with (mean "
        "ratio of their time to the best of each scene, scenes where they reach it), runs whose "
        "energy grew left out; a command that makes one of the winner's runs again; and the curves "
        "that say the same. C consistent, L lumped, D dispersion-tuned mass, * massless contact "
        "nodes. Scenes whose kept reference is not known to the goal itself do not count. Times near a "
        "start of the program (%.1f ms) differ by noise: a ratio below 1.3 is no finding." % (1e3 * about["started"]),
        "",
    ]
    for need in NEEDS:
        lines += need_lines(results, about, need)
    lines += ["## Pairing of contact faces, in statics", ""] + choice_lines(about["static"])
    lines += ["Tables and curves: [static.md](static.md).", ""]
    grown = sorted({common.label(r) for r in results if r.get("growth")})
    lines += ["## Warnings and failures of these runs", ""]
    lines.append(
        "- Energy grew, and the log said so, in some run of: %s. By how much: the error of the energy "
        "in the curves, the growth in the atlas." % (", ".join(grown) or "none")
    )
    bad = sorted({common.label(r) for r in results if "failed" in r})
    lines.append("- Some run failed, see [index.md](index.md): %s." % (", ".join(bad) or "none"))
    lines += ["- Extremes of stiffness, mass, step: [the atlas](../stability/index.md).", ""]
    with open(os.path.join(out, "choose.md"), "w") as file:
        file.write("\n".join(lines))


def write_csv(results, out):
    with open(os.path.join(out, "runs.csv"), "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n", extrasaction="ignore")
        writer.writeheader()
        for r in results:
            row = {k: "%.4g" % v if isinstance(v, float) else v for k, v in r.items()}
            writer.writerow(dict({"program": "bipact"}, **row))
