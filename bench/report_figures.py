"""Figures of the report: error against run time, one line for each combination of scheme and
mass, the front of its best runs."""

import os

import common
import numpy as np

from combinations import METHODS
from report_scenes import SCENES

MEASURES = {
    "err": "displacement",
    "e_v": "velocity",
    "e_R2": "force, mean of two steps",
    "e_R": "force, raw",
    "energy": "energy",
    "work": "work of friction",
}
ROUND_OFF = 1.0e-7  # errors below it are drawn at the lower edge, with their value
NAMED = 9  # lines of a panel that have a name and a colour
ALWAYS = ("THETA", "CONSISTENT", 0)  # the method of the paper
COLOUR = {
    "THETA": "#0072B2",
    "NEWMARK": "#000000",
    "HHT": "#CC79A7",
    "GENALPHA": "#882255",
    "MOREAU": "#E69F00",
    "PAOLI": "#D55E00",
    "CDLAGRANGE": "#999933",
    "THETAPV": "#56B4E9",
    "NSGENALPHA": "#44AA99",
    "CSNEWMARK": "#117733",
}
MARK = {"CONSISTENT": "o", "LUMPED": "s", "DISPERSION": "D"}


def front(runs, name):
    """Runs that no other beats in both processor time and an error, by increasing time."""
    best, found = float("inf"), []
    for run in sorted((r for r in runs if r.get(name)), key=lambda r: (r["cpu"], r[name])):
        if run[name] < best:
            best = run[name]
            found.append(run)
    return found


def combination(run):
    return run["method"], run["mass"], run["redist"]


def style(pair):
    """Colour: scheme; dashes: a variant of it; marks: mass, open with massless nodes."""
    name, mass, redist = pair
    colour = COLOUR[METHODS[name][0]]
    return {
        "color": colour,
        "linestyle": "-" if name == METHODS[name][0] else (0, (4, 2)),
        "marker": MARK[mass],
        "markerfacecolor": "white" if redist else colour,
        "markersize": 3.6,
        "linewidth": 1.4,
    }


def to_name(fronts, name):
    """Combinations of a panel that have a name: those of the front of all, then the lowest."""
    every = [dict(r, pair=pair) for pair, runs in fronts.items() for r in runs]
    found = [r["pair"] for r in reversed(front(every, name))]
    found += sorted(fronts, key=lambda pair: fronts[pair][-1][name])
    chosen = [ALWAYS] if ALWAYS in fronts else []
    for pair in found:
        if pair not in chosen and len(chosen) < NAMED:
            chosen.append(pair)
    return chosen


def spread(wanted, least):
    """Heights near the wanted ones, in the same order, and apart by at least so much."""
    order = np.argsort(wanted, kind="stable")
    found = np.array(wanted, float)[order]
    for _ in range(200):  # neighbours that are too close push each other away
        gaps = np.diff(found)
        close = np.flatnonzero(gaps < least - 1e-9)
        if not len(close):
            break
        for k in close:
            push = 0.5 * (least - (found[k + 1] - found[k]))
            if push > 0.0:
                found[k] -= push
                found[k + 1] += push
    out = np.empty(len(found))
    out[order] = found
    return out


def draw_panel(axes, fronts, others, name, started, low):
    """Fronts {combination: runs} of a measure; each that is named ends at the right edge, where
    its name stands. Points of other programs are crosses."""
    others = [r for r in others if r.get(name)]
    right = 1.15 * max(r["cpu"] for runs in list(fronts.values()) + [others] for r in runs)
    ends, named = {}, to_name(fronts, name)
    for pair, runs in sorted(fronts.items(), key=lambda item: item[0] in named):
        times = [r["cpu"] for r in runs]
        errors = [max(r[name], low) for r in runs]
        if pair not in named:
            axes.plot(times, errors, color="#cccccc", lw=0.7, marker=".", ms=2.0)
            continue
        look = style(pair)
        axes.plot(times, errors, **look)
        axes.plot([times[-1], right], 2 * [errors[-1]], color=look["color"], lw=0.6, alpha=0.35)
        ends[pair] = errors[-1]
    for r in others:
        axes.plot(r["cpu"], max(r[name], low), "x", color="#E60000", ms=7.0)
        at = r["cpu"], max(r[name], low)
        words = dict(xytext=(-6, 4), textcoords="offset points", ha="right")
        axes.annotate(r["program"], at, fontsize=7.5, color="#E60000", **words)
    axes.axvline(started, color="#888888", lw=1.2)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(0.85 * started, right)
    axes.set_ylim(low / 1.6, None)
    axes.grid(True, alpha=0.25)
    axes.set_xlabel("processor time [s]")
    axes.set_title("error of the " + MEASURES[name], loc="left", fontsize=11)
    name_lines(axes, fronts, ends, name, low)


def name_lines(axes, fronts, ends, name, low):
    """Names at the right edge, moved apart, each with a thin line to its end."""
    place = {
        s: axes.transAxes.inverted().transform(axes.transData.transform((1.0, e)))[1]
        for s, e in ends.items()
    }
    heights = spread(list(place.values()), 0.052)
    heights += max(0.0, 0.0 - heights.min()) - max(0.0, heights.max() - 1.0)
    for (scheme, at), height in zip(place.items(), heights):
        best = fronts[scheme][-1][name]
        text = common.label(scheme) + (" (%.0e)" % best if best < low else "")
        axes.annotate(
            text,
            (1.0, at),
            xytext=(1.04, height),
            xycoords="axes fraction",
            fontsize=8.5,
            color=style(scheme)["color"],
            va="center",
            annotation_clip=False,
            arrowprops={
                "arrowstyle": "-",
                "color": style(scheme)["color"],
                "lw": 0.6,
                "relpos": (0.0, 0.5),
                "shrinkA": 1.0,
                "shrinkB": 0.0,
            },
        )


def write_scene(results, others, scene, pairs, started, path):
    """The figure of a scene: a panel for each measure that has values."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    runs = [r for r in results if r["scene"] == scene and "failed" not in r]
    others = [r for r in others if r["scene"] == scene and "failed" not in r]
    panels = {}
    for name in MEASURES:
        fronts = {p: front([r for r in runs if combination(r) == p], name) for p in pairs}
        fronts = {p: found for p, found in fronts.items() if found}
        if fronts:
            panels[name] = fronts
    rows = (len(panels) + 1) // 2
    height = 0.9 + 4.6 * rows
    figure, grid = plt.subplots(rows, 2, figsize=(14.5, height), squeeze=False)
    figure.suptitle("%s: %s" % (scene, SCENES[scene]), fontsize=13, y=1.0 - 0.28 / height)
    figure.subplots_adjust(0.055, 0.6 / height, 0.865, 1.0 - 1.1 / height, 0.42, 0.28)
    figure.canvas.draw()
    for axes, (name, fronts) in zip(grid.flat, panels.items()):
        values = [r[name] for found in fronts.values() for r in found if r[name] > ROUND_OFF]
        low = 10.0 ** np.floor(np.log10(min(values, default=ROUND_OFF)))
        if min(r[name] for found in fronts.values() for r in found) < low:
            low /= 3.0
        draw_panel(axes, fronts, others, name, started, low)
    for axes in grid.flat[len(panels) :]:
        axes.axis("off")
    words = (
        "Fronts of the best runs; named: those on the front of all, the lowest, and THETA C. Marks: "
        "mass (o C, squares L, diamonds D), open: massless contact nodes (*); grey line: a start "
        "without steps, %.1f ms."
    )
    place = dict(x=0.055, y=1.0 - 0.62 / height, va="center", color="#444444")
    figure.text(s=words % (1e3 * started), fontsize=9.5, **place)
    figure.savefig(path, dpi=80)
    plt.close(figure)


def write_figures(results, others, pairs, started, out):
    """Work-precision figures, one a scene; returns their paths."""
    paths = []
    for scene in SCENES:
        paths.append(os.path.join(out, scene + ".png"))
        write_scene(results, others, scene, pairs, started, paths[-1])
    return paths
