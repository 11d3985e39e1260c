#!/usr/bin/env python3
"""Draw histories of a run as PNG figures.

Displacement of the contact end, energies and contact force (--kind, or the functions of the
same names), over the exact solution where the deck of the run has one: two bars that meet, or a
bar and a wall (exact_scene.py).  Columns of any table over time (--table, --columns): one line
for each node, part, side ... of the table.  Dimensions in brackets: [L] length, [T] time,
[F] force; a deck has no other units.  Colours: Okabe and Ito (2008), safe for colour-blind
eyes.
"""

import argparse
import os
import sys
import textwrap

import startup  # noqa: F401  before what is no part of Python
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

from compare import Run, load_meta  # noqa: E402
from exact_scene import ECHO, scene_of  # noqa: E402
from tables import TableError, read_run  # noqa: E402

BLACK, ORANGE, SKY, GREEN, BLUE, RED, PINK = (
    "#000000",
    "#E69F00",
    "#56B4E9",
    "#009E73",
    "#0072B2",
    "#D55E00",
    "#CC79A7",
)
CYCLE = (BLUE, RED, GREEN, ORANGE, PINK, SKY, BLACK)
DASHES = ("-", (0, (5, 2)), (0, (1, 1.5)), (0, (6, 1.5, 1, 1.5)))
STYLE = {
    "figure.dpi": 150,
    "savefig.dpi": 150,
    "font.size": 12,
    "axes.titlesize": 14,
    "legend.fontsize": 11,
    "axes.grid": True,
    "grid.alpha": 0.3,
    "lines.linewidth": 1.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
}
DIMENSION = {  # of the columns that are not listed: a pure number
    "T": "time dt cpu input assemble factor solve search",
    "L": "ux uy uz x y z gap slip gapmin penetration",
    "L/T": "vx vy vz vmx vmy vmz",
    "L/T^2": "ax ay az",
    "F L": "kinetic internal total initial external motion friction unsolved algorithmic "
    "damping energy normalwork frictionwork",
    "F": "fx fy fz fmx fmy fmz fn ft",
    "F T": "momx momy momz ix iy iz",
    "F L T": "angx angy angz",
    "F/L^2": "sxx syy szz sxy syz szx pressure",
    "M": "mass",
}


def unit_of(table, column):
    """' [dimension]' of a column, '' for numbers; `contact` is an energy in glstat only."""
    if table == "glstat" and column == "contact":
        return " [F L]"
    for dimension, names in DIMENSION.items():
        if column in names.split():
            return " [%s]" % dimension
    return ""


# ---------------------------------------------------------------- runs


class Tables:
    """A run whose scene has no exact solution here: what the figures need of its tables."""

    exact = None

    def __init__(self, directory, why):
        self.directory, self.why = directory, why
        self.glstat = read_run(directory, "glstat")
        self.rcforc = read_run(directory, "rcforc")
        if self.rcforc is None or not len(self.rcforc):
            self.rcforc = read_run(directory, "rwforc")

    def force(self, prefix="f"):
        """Times [T], size [F] of the force on the first side of the first contact or wall."""
        rows = self.rcforc
        for name in rows.id_columns:
            rows = rows.select(**{name: rows[name].min()})
        return rows["time"], np.hypot(rows[prefix + "x"], rows[prefix + "y"])

    def every_step(self, times):
        """True if these are the times of all steps."""
        return self.rcforc.cycle is not None and len(times) == self.rcforc.cycle + 1


def open_run(directory, meta=None):
    """A run with its exact solution, if its deck has one. `meta` describes the scene (as
    make_bars.py does); TableError where the deck of the run says otherwise."""
    scene, why = scene_of(directory)
    if scene is None and meta is None:
        return Tables(directory, why)
    if scene is not None and meta is not None:
        check_meta(meta, scene)
    run = Run(directory, meta or scene)
    if scene is None and os.path.exists(os.path.join(directory, ECHO)):
        run.why = why
    return run


def check_meta(meta, scene):
    """Refuse the description of another scene than the deck's: 1e-6, the digits of decks."""
    pairs = [("gap", meta["gap"], scene["gap"]), ("v0", meta["v0"], scene["v0"])]
    bars = sorted(b["length"] for b in meta["bars"]), sorted(b["length"] for b in scene["bars"])
    pairs += [("length", a, b) for a, b in zip(*bars)]
    for name, given, found in pairs:
        if not np.isclose(given, found, rtol=1e-6, atol=1e-9 * scene["L"]):
            raise TableError(
                "the description is of another scene: %s %g, in the deck of the run %g"
                % (name, given, found)
            )


# ---------------------------------------------------------------- frame of a figure


def new_figure(title, caption, layout="A", heights=(1.0,)):
    """Figure with title, what to look for, and panels; returns the figure and its axes.

    layout: rows of panels as subplot_mosaic of matplotlib has them, "AABB;CDEF"; heights: of
    the rows."""
    plt.rcParams.update(STYLE)
    width = 8.6 if layout == "A" else 13.0
    height = 5.4 * sum(heights)
    figure, axes = plt.subplot_mosaic(
        layout, figsize=(width, height), gridspec_kw={"height_ratios": heights}
    )
    text = textwrap.fill(caption, int(11.6 * width))
    figure.text(0.1 / width, 1.0 - 0.12 / height, title, fontsize=15, va="top", weight="bold")
    figure.text(
        0.1 / width, 1.0 - 0.46 / height, text, fontsize=11.5, va="top", color="#444444"
    )
    lines = text.count("\n") + 1 if text else 0
    figure.below = 1.0 - (0.50 + 0.22 * lines) / height  # where the panels end
    return figure, list(axes.values())


def finish(figure, path):
    """Lay out, save as PNG and close; returns the path."""
    figure.tight_layout(rect=(0.0, 0.0, 1.0, figure.below))
    figure.savefig(path)
    plt.close(figure)
    return path


def label(axes, x, y, legend=True):
    """Axis names with their dimensions, and the legend: beside the panel where it is long."""
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    lines = axes.get_legend_handles_labels()[1]
    if legend and len(lines) > 6:
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)
    elif legend:
        axes.legend(loc="best")


def contact_window(axes, run):
    """Grey band: the exact time of contact."""
    if not run.why and np.isfinite(run.exact.release):
        axes.axvspan(
            run.exact.touch,
            run.exact.release,
            color="#999999",
            alpha=0.15,
            lw=0,
            label="exact contact time",
        )


def exact_curve(axes, run, t, values, zorder=2):
    """A broad grey line, where the exact solution is that of the run."""
    if not run.why:
        axes.plot(t, values, color=BLACK, lw=3.2, alpha=0.45, zorder=zorder, label="exact")


def need(run, table, name):
    """Refuse a figure whose table the run did not write."""
    if table is None or not len(table):
        raise TableError("%s: no rows of table %s" % (run.directory, name))


def fine_times(run):
    """Times for the exact curves [T]."""
    return np.linspace(0.0, run.exact.tend, 2001) if not run.why else np.zeros(0)


def with_reason(caption, run):
    """A caption, and why there is no exact curve."""
    return caption if not run.why else "No exact curve: %s." % run.why


# ---------------------------------------------------------------- figures of an impact


def displacement(run, path, name, caption=None):
    """Displacement of the contact end, computed over exact."""
    if isinstance(run, Tables):
        raise TableError(
            "which end meets another is not known (%s): draw --table nodout --columns ux, or "
            "give the scene by --meta" % run.why
        )
    need(run, run.nodout, "nodout")
    figure, (axes,) = new_figure(
        "Displacement of the point of impact, %s" % name,
        with_reason(
            caption or "Look at the plateau: the end must stand still while the bars touch.",
            run,
        ),
    )
    t, u = run.tip()
    contact_window(axes, run)
    exact_curve(axes, run, fine_times(run), run.exact.tip(fine_times(run)))
    axes.plot(t, u, color=BLUE, lw=1.4, label="computed")
    label(axes, "time [T]", "displacement [L]")
    return finish(figure, path)


def energies(run, path, name, caption=None):
    """Total, kinetic and strain energy, with the exact ones dashed."""
    need(run, run.glstat, "glstat")
    figure, (axes,) = new_figure(
        "Energies, %s" % name,
        with_reason(
            caption or "Look at the total: it must stay at its initial value and never rise.",
            run,
        ),
    )
    for column, text, colour in (
        ("total", "total", BLACK),
        ("kinetic", "kinetic", BLUE),
        ("internal", "strain", RED),
    ):
        axes.plot(run.glstat["time"], run.glstat[column], color=colour, label=text)
    if not run.why:
        t = np.linspace(0.0, run.exact.tend, 401)
        for values, colour, text in zip(
            run.exact.energies(t), (BLUE, RED), ("exact kinetic", "exact strain")
        ):
            axes.plot(t, values, color=colour, ls=(0, (2, 3)), lw=1.3, alpha=0.8, label=text)
    label(axes, "time [T]", "energy [F L]")
    return finish(figure, path)


def force_panel(axes, run, name, top):
    """Raw force of the step, two-step mean and exact force in one panel."""
    t, raw = run.force("f")
    contact_window(axes, run)
    axes.plot(t, raw, color=SKY, lw=0.7, zorder=2, label="force of the step")
    if not run.why:
        exact_curve(axes, run, fine_times(run), run.exact.force(fine_times(run)), zorder=3)
    axes.plot(t, run.force("fm")[1], color=RED, lw=1.3, zorder=4, label="mean of two steps")
    limit = top * (np.max(raw) if run.why else np.max(run.exact.force_steps))
    if not run.why:
        axes.set_ylim(-0.06 * limit, limit)
    if not run.why and raw.max() > limit:
        axes.annotate(
            "cut off; raw peak %.3g" % raw.max(),
            (t[raw.argmax()], limit),
            xytext=(8, -14),
            textcoords="offset points",
            fontsize=11,
        )
    if not run.every_step(t):
        name += " (not every step)"
    axes.set_title(name, loc="left", fontsize=12)


def steps_panel(axes, run, name, row):
    """Steps around the end of row `row` of the forces: the force of each as a level over the
    step, the mean of two at the end of the second."""
    (t, raw), mean = run.force("f"), run.force("fm")[1]
    part = slice(max(0, row - 4), row + 6)
    steps = (t - t[row]) / run.dt
    axes.step(steps[part], raw[part], where="pre", color=SKY, lw=1.6)
    fine = np.linspace(t[part][0], t[part][-1], 801)
    exact_curve(axes, run, (fine - t[row]) / run.dt, run.exact.force(fine), zorder=1)
    axes.plot(steps[part], mean[part], "o-", ms=4, color=RED, lw=1.0)
    axes.set_title("%s, t = %.4g" % (name, t[row]), loc="left", fontsize=11)


def force_panels(panels, runs, top):
    """One panel for each run {name: run}, with the same force axis."""
    for axes, (name, run) in zip(panels, runs.items()):
        need(run, run.rcforc, "rcforc or rwforc")
        if axes is not panels[0]:
            axes.sharey(panels[0])
        force_panel(axes, run, name, top)
        label(axes, "time [T]", "contact force [F]" if axes is panels[0] else "", legend=False)
    panels[-1].legend(loc="upper right")


def forces(runs, path, caption=None, top=2.6):
    """Contact force of several runs {name: run} side by side; `top` cuts the force axis [-]."""
    why = next((run for run in runs.values() if run.why), None)
    text = caption or (
        "The raw force may alternate from step to step (period 2); its two-step mean must "
        "follow the exact pulse."
    )
    text = with_reason(text, why) if why else text
    figure, panels = new_figure("Contact force", text, "ABCDEFGH"[: len(runs)])
    force_panels(panels, runs, top)
    return finish(figure, path)


def forces_and_ends(runs, path, caption, top=2.6):
    """Contact force of two runs {name: run}, and below each the steps at touch and release."""
    figure, panels = new_figure("Contact force", caption, "AABB;CDEF", (1.0, 0.62))
    force_panels(panels[:2], runs, top)
    for k, run in enumerate(runs.values()):
        raw = run.force("f")[1]
        loaded = np.flatnonzero(raw > 1e-6 * raw.max())  # not the round-off of a touch
        for axes, name, row in (
            (panels[2 + 2 * k], "touch", loaded[0] - 1),
            (panels[3 + 2 * k], "release", loaded[-1]),
        ):
            steps_panel(axes, run, name, row)
            y = "contact force [F]" if axes is panels[2] else ""
            label(axes, "steps from the " + name, y, legend=False)
    return finish(figure, path)


# ---------------------------------------------------------------- any table


MOST_LINES = 14  # that a figure keeps apart


def rows_by_id(table, ids):
    """[(text, table)] of the rows to draw, each with its own ids, and what they have in common.
    ids: {column: values} that are wanted, of other columns all. The text names the columns in
    which the rows differ."""
    for name, wanted in ids.items():
        table = table.rows(np.isin(table[name], wanted))
    if not len(table):
        raise TableError("%s: no such rows" % table.path)
    columns = table.id_columns
    if not columns:
        return [("", table)], ""
    keys = np.unique(table.vectors(*columns), axis=0)
    differ = [c for c, name in enumerate(columns) if len(set(keys[:, c])) > 1]
    if len(differ) > 1 and len(set(keys[:, differ[0]])) == len(keys):
        differ = differ[:1]  # the part of an element follows from it
    parts = []
    for key in keys[:MOST_LINES]:
        rows = table.select(**dict(zip(columns, key)))
        parts.append((", ".join("%s %d" % (columns[c], key[c]) for c in differ), rows))
    same = [c for c in range(len(columns)) if c not in differ and len(set(keys[:, c])) == 1]
    common = ", ".join("%s %d" % (columns[c], keys[0, c]) for c in same)
    if len(keys) > MOST_LINES:
        common += "%sthe first %d of %d" % (", " if common else "", MOST_LINES, len(keys))
    return parts, common


def columns(directory, table_name, names, path, x="time", ids=None, title=None, caption=None):
    """Columns of a table over time, one line for each node, part, side ... of it; `ids` = {id
    column: value or values} picks some."""
    table = read_run(directory, table_name)
    if table is None:
        raise TableError("%s: no table %s" % (directory, table_name))
    parts, common = rows_by_id(table, ids or {})
    figure, (axes,) = new_figure(
        title or ", ".join(filter(None, ("%s of %s" % (", ".join(names), table_name), common))),
        caption or "",
    )
    lines = [(name, of, rows) for name in names for of, rows in parts]
    for k, (name, of, rows) in enumerate(lines):
        # Dashes over wider lines: ids that do the same are both seen.
        layer = k % len(DASHES) if len(parts) > 1 else 0
        axes.plot(
            rows[x],
            rows[name],
            color=CYCLE[k % len(CYCLE)],
            ls=DASHES[layer],
            lw=(1.8 if len(parts) == 1 else 2.6 - 0.5 * layer),
            label=", ".join(filter(None, (name + unit_of(table_name, name), of))),
        )
    label(axes, x + unit_of(table_name, x), axis_name(table_name, names))
    return finish(figure, path)


def axis_name(table_name, names):
    """Name of the value axis: one column, or the dimension that all columns share."""
    units = {unit_of(table_name, name) for name in names}
    if len(names) == 1:
        return names[0] + units.pop()
    return "value" + (units.pop() if len(units) == 1 else "")


# ---------------------------------------------------------------- command line


def make_parser():
    """Command line."""
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="Examples: plot_history.py run.out --table glstat --columns "
        "total,kinetic,internal -o energy.png;  plot_history.py run.out --table nodout "
        "--id node=201 --columns ux -o u.png;  plot_history.py run.out --kind force "
        "--meta two_bars.json -o force.png",
    )
    parser.add_argument("run", metavar="RUN_DIR", help="directory of the tables")
    parser.add_argument("-o", dest="path", required=True, metavar="FIG.png")
    parser.add_argument("--table", help="table to draw, e.g. glstat")
    parser.add_argument("--columns", help="columns of the table, a,b,c")
    parser.add_argument("--x", default="time", help="column of the abscissa (time)")
    parser.add_argument(
        "--id",
        action="append",
        default=[],
        metavar="NAME=ID[,ID]",
        help="rows to draw, e.g. node=201 (all, each as its own line); repeatable",
    )
    parser.add_argument(
        "--kind",
        choices=("displacement", "energy", "force"),
        help="figure of an impact instead of a table",
    )
    parser.add_argument(
        "--meta",
        metavar="FILE",
        help="scene of --kind, as written by make_bars.py --meta (default: what the deck of "
        "the run says)",
    )
    parser.add_argument("--title", help="title of the figure")
    parser.add_argument("--caption", help="line under the title")
    return parser


def draw_kind(a):
    """Figure of an impact."""
    run = open_run(a.run, load_meta(a.meta) if a.meta else None)
    name = a.title or os.path.basename(os.path.normpath(a.run))
    if a.kind == "force":
        return forces({name: run}, a.path, a.caption)
    draw = displacement if a.kind == "displacement" else energies
    return draw(run, a.path, name, a.caption)


def draw_table(a):
    """Figure of table columns."""
    pairs = (text.split("=") for text in a.id)
    ids = {name: [int(n) for n in values.split(",")] for name, values in pairs}
    return columns(a.run, a.table, a.columns.split(","), a.path, a.x, ids, a.title, a.caption)


def main(argv=None):
    parser = make_parser()
    arguments = parser.parse_args(argv)
    if not arguments.kind and not (arguments.table and arguments.columns):
        parser.error("give --kind, or --table and --columns")
    try:
        path = draw_kind(arguments) if arguments.kind else draw_table(arguments)
    except (TableError, OSError, ValueError) as problem:
        print("plot_history.py: %s" % problem, file=sys.stderr)
        return 1
    print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
