"""Figures of the report: error against run time, one line for each combination of scheme and
mass, the front of its best runs."""

import os

import common
import numpy as np

MEASURES = {
    "err": "displacement",
    "energy": "energy",
    "e_R2": "force, mean of two steps",
    "e_R": "force, raw",
}
ROUND_OFF = 1.0e-7  # errors below it are drawn at the lower edge, with their value
COLOUR = {"CONSISTENT": "#0072B2", "LUMPED": "#009E73", "DISPERSION": "#D55E00"}
DASH = {"THETA": "-", "NEWMARK": (0, (4, 2))}


def front(runs, name):
    """Runs that no other beats in both processor time and an error, by increasing time."""
    best, found = float("inf"), []
    for run in sorted((r for r in runs if r.get(name)), key=lambda r: (r["cpu"], r[name])):
        if run[name] < best:
            best = run[name]
            found.append(run)
    return found


def combination(run):
    return run["scheme"], run["theta"], run["mass"], run["redist"]


def style(scheme):
    """Colour: mass; dashes: NEWMARK, dots: theta over 1/2; open marks: massless nodes."""
    name, theta, mass, redist = scheme
    colour = COLOUR[mass]
    return {
        "color": colour,
        "linestyle": (0, (1, 1.5)) if theta > 0.5 else DASH[name],
        "marker": "o" if name == "THETA" else "s",
        "markerfacecolor": "white" if redist else colour,
        "markersize": 3.6,
        "linewidth": 1.4,
    }


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


def draw_panel(axes, fronts, name, started, low):
    """Fronts {scheme: runs} of a measure; each ends at the right edge, where its name stands."""
    right = 1.15 * max(r["cpu"] for runs in fronts.values() for r in runs)
    ends = {}
    for scheme, runs in fronts.items():
        times = [r["cpu"] for r in runs]
        errors = [max(r[name], low) for r in runs]
        look = style(scheme)
        axes.plot(times, errors, **look)
        axes.plot([times[-1], right], 2 * [errors[-1]], color=look["color"], lw=0.6, alpha=0.35)
        ends[scheme] = errors[-1]
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


def write_scene(results, scene, title, schemes, started, path):
    """The figure of a scene: a panel for each measure that has values."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    runs = [r for r in results if r["scene"] == scene and "failed" not in r]
    panels = {}
    for name in MEASURES:
        fronts = {s: front([r for r in runs if combination(r) == s], name) for s in schemes}
        fronts = {s: found for s, found in fronts.items() if found}
        if fronts:
            panels[name] = fronts
    rows = (len(panels) + 1) // 2
    height = 0.9 + 4.6 * rows
    figure, grid = plt.subplots(rows, 2, figsize=(14.5, height), squeeze=False)
    figure.suptitle("%s: %s" % (scene, title), fontsize=13, y=1.0 - 0.28 / height)
    figure.subplots_adjust(0.055, 0.6 / height, 0.885, 1.0 - 1.1 / height, 0.37, 0.28)
    figure.canvas.draw()
    for axes, (name, fronts) in zip(grid.flat, panels.items()):
        values = [r[name] for found in fronts.values() for r in found if r[name] > ROUND_OFF]
        low = 10.0 ** np.floor(np.log10(min(values, default=ROUND_OFF)))
        if min(r[name] for found in fronts.values() for r in found) < low:
            low /= 3.0
        draw_panel(axes, fronts, name, started, low)
    for axes in grid.flat[len(panels) :]:
        axes.axis("off")
    words = (
        "Fronts of the best runs. Colour: mass; dashed: NEWMARK; dotted: theta over 1/2; open "
        "marks: massless contact nodes (*); grey line: a start without steps, %.1f ms."
    )
    place = dict(x=0.055, y=1.0 - 0.62 / height, va="center", color="#444444")
    figure.text(s=words % (1e3 * started), fontsize=9.5, **place)
    figure.savefig(path, dpi=80)
    plt.close(figure)


def write_figures(results, scenes, schemes, started, out):
    """Work-precision figures, one a scene: {scene: title}; returns their paths."""
    paths = []
    for scene, title in scenes.items():
        paths.append(os.path.join(out, scene + ".png"))
        write_scene(results, scene, title, schemes, started, paths[-1])
    return paths
