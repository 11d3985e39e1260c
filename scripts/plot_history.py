#!/usr/bin/env python3
"""Draw histories of a run as PNG figures.

For the impact of two bars: displacement of the contact end, energies and contact force, each
over the exact solution (--kind, or the functions of the same names).  For any run: columns of
one table over time (--table, --columns).  Dimensions in brackets: [L] length, [T] time,
[F] force; a deck has no other units.  Colours: Okabe and Ito (2008), safe for colour-blind
eyes.
"""

import argparse
import os
import sys

import startup  # noqa: F401  before what is no part of Python
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

from analytic import TwoBars  # noqa: E402
from compare import Run, load_meta, meta_of  # noqa: E402
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


# ---------------------------------------------------------------- frame of a figure


def new_figure(title, caption, panels=1):
    """Figure with title, one line on what to look for, and panels side by side."""
    plt.rcParams.update(STYLE)
    figure, axes = plt.subplots(
        1, panels, figsize=(8.6 if panels == 1 else 13.0, 5.4), sharey=panels > 1, squeeze=False
    )
    figure.text(0.02, 0.975, title, fontsize=15, ha="left", va="top", weight="bold")
    figure.text(0.02, 0.915, caption, fontsize=11.5, ha="left", va="top", color="#444444")
    return figure, list(axes[0])


def finish(figure, path):
    """Lay out, save as PNG and close; returns the path."""
    figure.tight_layout(rect=(0.0, 0.0, 1.0, 0.88))
    figure.savefig(path)
    plt.close(figure)
    return path


def label(axes, x, y, legend=True):
    """Axis names with their dimensions, and the legend."""
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    if legend:
        axes.legend(loc="best")


def contact_window(axes, exact):
    """Grey band: the exact time of contact."""
    if np.isfinite(exact.release):
        axes.axvspan(
            exact.touch,
            exact.release,
            color="#999999",
            alpha=0.15,
            lw=0,
            label="exact contact time",
        )


def need(run, table, name):
    """Refuse a figure whose table the run did not write."""
    if table is None or not len(table):
        raise TableError("%s: no rows of table %s" % (run.directory, name))


def fine_times(run):
    """Times for the exact curves [T]."""
    return np.linspace(0.0, run.exact.tend, 2001)


# ---------------------------------------------------------------- figures of the two bars


def displacement(run, path, name, caption=None):
    """Displacement of the contact end, computed over exact."""
    need(run, run.nodout, "nodout")
    figure, (axes,) = new_figure(
        "Displacement of the point of impact, %s" % name,
        caption or "Look at the plateau: the end must stand still while the bars touch.",
    )
    t, u = run.tip()
    contact_window(axes, run.exact)
    axes.plot(
        fine_times(run),
        run.exact.tip(fine_times(run)),
        color=BLACK,
        lw=3.2,
        alpha=0.45,
        label="exact",
    )
    axes.plot(t, u, color=BLUE, lw=1.4, label="computed")
    label(axes, "time [T]", "displacement [L]")
    return finish(figure, path)


def energies(run, path, name, caption=None):
    """Total, kinetic and strain energy, with the exact ones dashed."""
    need(run, run.glstat, "glstat")
    figure, (axes,) = new_figure(
        "Energies, %s" % name,
        caption or "Look at the total: it must stay at its initial value and never rise.",
    )
    exact_t = np.linspace(0.0, run.exact.tend, 401)
    exact = run.exact.energies(exact_t)
    for column, text, colour in (
        ("total", "total", BLACK),
        ("kinetic", "kinetic", BLUE),
        ("internal", "strain", RED),
    ):
        axes.plot(run.glstat["time"], run.glstat[column], color=colour, label=text)
    for values, colour, text in zip(exact, (BLUE, RED), ("exact kinetic", "exact strain")):
        axes.plot(exact_t, values, color=colour, ls=(0, (2, 3)), lw=1.3, alpha=0.8, label=text)
    label(axes, "time [T]", "energy [F L]")
    return finish(figure, path)


def force_panel(axes, run, name, top):
    """Raw force of the step, two-step mean and exact force in one panel."""
    need(run, run.rcforc, "rcforc or rwforc")
    t, raw = run.force("f")
    scale = np.max(run.exact.force_steps)
    contact_window(axes, run.exact)
    axes.plot(t, raw, color=SKY, lw=0.7, zorder=2, label="force of the step")
    exact_t = fine_times(run)
    axes.plot(
        exact_t,
        run.exact.force(exact_t),
        color=BLACK,
        lw=3.2,
        alpha=0.45,
        zorder=3,
        label="exact",
    )
    axes.plot(t, run.force("fm")[1], color=RED, lw=1.3, zorder=4, label="mean of two steps")
    axes.set_ylim(-0.15 * scale, top * scale)
    if raw.max() > top * scale:
        axes.annotate(
            "cut off; raw peak %.3g" % raw.max(),
            (t[raw.argmax()], top * scale),
            xytext=(8, -14),
            textcoords="offset points",
            fontsize=11,
        )
    if not run.every_step(t):
        name += " (not every step)"
    axes.set_title(name, loc="left", fontsize=12)


def forces(runs, path, caption=None, top=2.6):
    """Contact force of several runs {name: run} side by side; `top` cuts the force axis [-]."""
    figure, panels = new_figure(
        "Contact force",
        caption
        or "The raw force may alternate from step to step (period 2); its two-step mean must "
        "follow the exact pulse.",
        panels=len(runs),
    )
    for axes, (name, run) in zip(panels, runs.items()):
        force_panel(axes, run, name, top)
        label(axes, "time [T]", "contact force [F]" if axes is panels[0] else "", legend=False)
    panels[-1].legend(loc="upper right")
    return finish(figure, path)


# ---------------------------------------------------------------- any table


def columns(directory, table_name, names, path, x="time", ids=None, title=None, caption=None):
    """Columns of a table over time; `ids` = {id column: value} picks the rows."""
    table = read_run(directory, table_name)
    if table is None:
        raise TableError("%s: no table %s" % (directory, table_name))
    table = table.select(**(ids or {}))
    if not len(table):
        raise TableError("%s: no such rows" % table.path)
    picked = ", ".join("%s %d" % pair for pair in (ids or {}).items())
    figure, (axes,) = new_figure(
        title or "%s %s" % (table_name, picked), caption or "%s over %s" % (", ".join(names), x)
    )
    for name, colour in zip(names, CYCLE * (1 + len(names) // len(CYCLE))):
        axes.plot(table[x], table[name], color=colour, label=name + unit_of(table_name, name))
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
        metavar="NAME=ID",
        help="rows to draw, e.g. node=201; repeatable",
    )
    parser.add_argument(
        "--kind",
        choices=("displacement", "energy", "force"),
        help="figure of the two-bar impact instead of a table",
    )
    parser.add_argument(
        "--meta",
        metavar="FILE",
        help="scene of --kind, as written by make_bars.py --meta (default: the "
        "paper's data, gap 0.02)",
    )
    parser.add_argument("--title", help="title of the figure")
    parser.add_argument("--caption", help="line under the title")
    return parser


def paper_scene():
    """Scene of the paper's test in our reading."""
    d = TwoBars()
    return meta_of("two_bars", d.length, d.speed, d.v0, d.gap, d.area, d.density)


def draw_kind(a):
    """Figure of the two-bar impact."""
    run = Run(a.run, load_meta(a.meta) if a.meta else paper_scene())
    name = a.title or os.path.basename(os.path.normpath(a.run))
    if a.kind == "force":
        return forces({name: run}, a.path, a.caption)
    draw = displacement if a.kind == "displacement" else energies
    return draw(run, a.path, name, a.caption)


def draw_table(a):
    """Figure of table columns."""
    ids = {name: int(value) for name, value in (text.split("=") for text in a.id)}
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
