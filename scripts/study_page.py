"""The page of a study: choices, figures, orders, what was unstable, what it cost."""

import math
import os
import time

import startup  # noqa: F401  before what is no part of Python
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

GOALS = (1.0e-1, 1.0e-2, 1.0e-3)
COLOURS = "#0072B2 #D55E00 #009E73 #CC79A7 #E69F00 #56B4E9 #000000 #8B4513".split()
MARKS = "osD^vP*X<>"
LINES = 8  # methods named in a figure; the others are grey


def cheapest(estimate, results, goal, cost, sure=False):
    """The run of least cost whose estimated error meets a goal and whose energy does not grow;
    sure: with its bar added. None where there is none, or where the bar is wider than the
    goal: then nobody can tell."""
    fit = [
        run
        for run, error in estimate.errors.items()
        if error + (estimate.bars[run] if sure else 0.0) <= goal and not results[run].growth
    ]
    if estimate.bar > goal:
        return None
    return min(fit, key=lambda r: getattr(results[r], cost), default=None)


def front(runs, results, errors, cost):
    """Runs that no other beats in both cost and error, by increasing cost."""
    best, found = math.inf, []
    for run in sorted(runs, key=lambda r: (getattr(results[r], cost), errors[r])):
        if errors[run] < best:
            best = errors[run]
            found.append(run)
    return found


# ---------------------------------------------------------------- figures


def draw(path, estimate, results):
    """Error against processor time and against counted work: the front of each method; grey:
    what the reference cannot tell."""
    methods = {}
    for run in estimate.errors:
        methods.setdefault(run.label, []).append(run)
    rank = sorted(methods, key=lambda m: area(methods[m], results, estimate))
    low = 0.1 * estimate.bar  # nobody can tell errors below the bar apart
    figure, panels = plt.subplots(1, 2, figsize=(12.0, 4.8), sharey=True)
    for axes, cost, text in zip(
        panels, ("cpu", "work"), ("processor time [s]", "counted work [multiplications]")
    ):
        for k, method in reversed(list(enumerate(rank))):
            runs = front(methods[method], results, estimate.errors, cost)
            x = [getattr(results[r], cost) for r in runs]
            y = [max(estimate.errors[r], low) for r in runs]
            look = {"color": "#bbbbbb", "lw": 0.7, "marker": ".", "ms": 3}
            if k < LINES:
                look = {"color": COLOURS[k % len(COLOURS)], "lw": 1.5, "ms": 5}
                look.update(marker=MARKS[k % len(MARKS)], label=method)
            axes.plot(x, y, **look)
        axes.axhspan(1.0e-12, estimate.bar, color="#000000", alpha=0.07)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel(text)
        axes.grid(True, alpha=0.25)
    panels[0].set_ylim(0.7 * low, 2.0 * max(estimate.errors.values()))
    panels[0].set_ylabel("error of " + estimate.name)
    named = panels[1].get_legend_handles_labels()
    look = {"loc": "center left", "bbox_to_anchor": (1.01, 0.5), "fontsize": 8}
    panels[1].legend(*(x[::-1] for x in named), frameon=False, **look)
    figure.tight_layout()
    figure.savefig(path, dpi=110, bbox_inches="tight", metadata={"Software": None})
    plt.close(figure)


def area(runs, results, estimate):
    """Mean log error of a front over log work: by it methods are put in order."""
    best = front(runs, results, estimate.errors, "work")
    return float(
        np.mean([math.log(max(estimate.errors[r], 1e-9)) for r in best])
        + 0.5 * np.mean([math.log(max(results[r].work, 1.0)) for r in best])
    )


def name_of(quantity):
    return quantity.replace(" ", "_") + ".png"


# ---------------------------------------------------------------- words


def number(x):
    return "%.2g" % x if math.isfinite(x) else "-"


def told(run, estimate, results):
    """A run in a table: what, its error and bar, its cost."""
    if run is None:
        return "not reached"
    return "%s, mesh %d, dt %.4g: %s ± %s, %.3g s" % (
        run.label,
        run.mesh + 1,
        run.dt,
        number(estimate.errors[run]),
        number(estimate.bars[run]),
        results[run].cpu,
    )


def table(head, rows):
    rows = list(rows)
    if not rows:
        return ["none", ""]
    out = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return out + ["| " + " | ".join(map(str, row)) + " |" for row in rows] + [""]


def choices(estimates, results):
    """Cheapest runs, by counted work (which does not depend on the machine)."""
    for name, e in estimates.items():
        if e.reference is None:
            yield name, "does not converge", "", ""
            continue
        row = [name]
        for goal in GOALS:
            run = cheapest(e, results, goal, "work")
            words = told(run, e, results) if e.bar <= goal else "the bar is wider"
            if run is not None and e.errors[run] + e.bars[run] > goal:
                certain = cheapest(e, results, goal, "work", sure=True)
                words += " (within the bar of the goal"
                words += "; beyond doubt: %s)" % told(certain, e, results) if certain else ")"
            row.append(words)
        yield tuple(row)


def references(estimates):
    for name, e in estimates.items():
        if e.reference is None:
            yield name, "does not converge", "", "", ""
            continue
        members = ", ".join("%s %s" % s.method[:2] for s in e.members)
        methods = {s.method[:2] for s in e.sequences}
        yield (
            name,
            number(e.bar),
            number(e.order),
            "%d of %d" % (len(methods) - len(e.stuck), len(methods)),
            members,
        )


def orders(estimates):
    """Observed order of each method in each quantity: the median of its sequences."""
    methods = dict.fromkeys(s.method[:2] for e in estimates.values() for s in e.sequences)
    for method in methods:
        row = ["%s %s" % method]
        for e in estimates.values():
            mine = [s for s in e.sequences if s.method[:2] == method]
            falling = [s.slope for s in mine if s.verdict == "converges"]
            if not mine or e.reference is None:
                row.append("-")
            elif method in e.stuck:
                row.append("does not converge")
            else:
                row.append("%.1f" % np.median(falling) if falling else "within the bar")
        yield row


def unstable(results):
    for run, r in results.items():
        if r.growth or r.status == "failed":
            why = next((w for w in r.warnings if w.startswith("energy-growth")), r.message)
            yield run.label, run.mesh + 1, "%.4g" % run.dt, why.split(";")[0]


def refused(results):
    """What was not run, one line for each reason: methods, steps."""
    reasons = {}
    for run, r in results.items():
        if not r.done and r.status != "failed":
            reasons.setdefault((r.status, r.message), []).append(run)
    for (status, message), runs in reasons.items():
        names = ", ".join(dict.fromkeys(r.label for r in runs))
        yield names, len(runs), "%s: %s" % (status, message)


def write(a, study, widths, results, estimates, remarks):
    """Writes study.md and its figures; the path."""
    done = [r for r in results.values() if r.done]
    one_mesh = len(widths) == 1
    out = ["# Study of %s" % os.path.basename(a.decks[0]), ""]
    out += [
        "%d runs on %d mesh%s, %d done; %.3g s of processor time and %.3g multiplications in "
        "all. bipact %s, %s. doc/study.md says how this page is read."
        % (
            len(results),
            len(widths),
            "" if one_mesh else "es",
            len(done),
            sum(r.cpu for r in results.values()),
            sum(r.work for r in results.values()),
            study.version,
            time.strftime("%Y-%m-%d"),
        ),
        "",
    ]
    if one_mesh:
        out += [
            "All runs have one mesh: of its error the bars know only by how much the masses "
            "differ. Finer meshes tell more.",
            "",
        ]
    for remark in remarks:
        out += [remark, ""]
    out += ["## The cheapest choice", ""]
    out += table(["quantity", *("error %g" % g for g in GOALS)], choices(estimates, results))
    out += ["## Error against run time and work", ""]
    for name, e in estimates.items():
        if e.reference is not None:
            draw(os.path.join(a.out, name_of(name)), e, results)
            out += ["![error of %s](%s)" % (name, name_of(name)), ""]
    out += ["## The references", ""]
    head = ["quantity", "bar", "order", "methods that converge", "made of the finest runs of"]
    out += table(head, references(estimates))
    out += ["## Observed orders", ""]
    head = ["scheme and mass", *estimates]
    out += table(head, orders(estimates))
    out += ["## What was unstable", ""]
    out += table(["scheme and mass", "mesh", "dt", "what"], unstable(results))
    out += ["## What was not run to the end", ""]
    out += table(["scheme and mass", "runs", "why"], refused(results))
    path = os.path.join(a.out, "study.md")
    with open(path + ".tmp", "w", encoding="utf-8") as file:
        file.write("\n".join(out))
    os.replace(path + ".tmp", path)
    return path
