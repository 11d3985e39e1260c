#!/usr/bin/env python3
"""Draw the rows of contact: draw_rows.py [-o FILE] (doc/figures/contact_rows.png).

Four small scenes: which nodes have exact rows and which an allowance, two nodes that meet, a
notch with two rows for one node, a vertex row whose normal the free motion chooses."""

import argparse
import os

import startup

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

UPPER, LOWER, EDGE = "#dce6f2", "#eee6d8", "#444444"
EXACT, ALLOWANCE, NORMAL, MOTION = "#b3201f", "#1f5fb3", "#b3201f", "#2a7f2a"


def body(axes, outline, color, inside=()):
    """A polygon with its nodes; the mesh inside as thin lines."""
    x, y = zip(*outline)
    axes.fill(x, y, color, edgecolor=EDGE, linewidth=1.3, zorder=1)
    for a, b in inside:
        axes.plot(*zip(a, b), color=EDGE, linewidth=0.4, zorder=2)


def node(axes, place, color=None):
    """A node: full and red with an exact row, open and blue with an allowance, else grey."""
    style = {
        None: {"color": "#999999", "s": 14},
        EXACT: {"color": EXACT, "s": 46},
        ALLOWANCE: {"facecolor": "white", "edgecolor": ALLOWANCE, "linewidth": 1.6, "s": 46},
    }
    axes.scatter(*place, zorder=5, **style[color])


def arrow(axes, start, along, color, text="", shift=(0.05, 0.0)):
    """An arrow and its label at its head."""
    end = (start[0] + along[0], start[1] + along[1])
    axes.annotate(
        "", end, start, arrowprops={"arrowstyle": "-|>", "color": color, "lw": 1.6}, zorder=6
    )
    axes.text(end[0] + shift[0], end[1] + shift[1], text, color=color, fontsize=10, zorder=6)


def label(axes, x, y, text, **more):
    axes.text(x, y, text, fontsize=9, **more)


def draw_sides(axes):
    """A coarse block over a finer base."""
    axes.set_title("both sides watched: the finer side and corners exact")
    top, low = 0.28, 0.0
    body(axes, [(0.5, top), (2.5, top), (2.5, 1.1), (0.5, 1.1)], UPPER, [((1.5, top), (1.5, 1.1))])
    steps = [0.6 * k for k in range(6)]
    lines = [((x, low), (x, -0.7)) for x in steps[1:-1]]
    body(axes, [(0, low), (3, low), (3, -0.7), (0, -0.7)], LOWER, lines)
    for x in steps:
        node(axes, (x, low), EXACT if 0 < x < 3 else None)
    for x in steps[1:-1]:
        axes.plot((x, x), (low, top), color=EXACT, linewidth=1.0, linestyle=":", zorder=3)
    for x in (0.5, 1.5, 2.5):
        node(axes, (x, top), ALLOWANCE)
        axes.plot((x, x), (low, top), color=ALLOWANCE, linewidth=1.0, linestyle=":", zorder=3)
    label(axes, 0.55, 0.75, "coarser: allowance")
    label(axes, 0.05, -0.92, "finer: exact rows on the faced edges")


def draw_corner(axes):
    """A corner between the nodes of a coarse edge, and two nodes that meet."""
    axes.set_title("a corner is exact on any edge; of twins one stays")
    body(axes, [(0.9, 0.2), (1.5, 0.8), (0.9, 1.4), (0.3, 0.8)], UPPER)
    body(axes, [(0, 0), (3.2, 0), (3.2, -0.7), (0, -0.7)], LOWER)
    node(axes, (0.9, 0.2), EXACT)
    arrow(axes, (0.9, 0.0), (0.0, 0.55), NORMAL, "n")
    for x in (0, 2.6, 3.2):
        node(axes, (x, 0))
    body(axes, [(2.3, 0.9), (2.65, 0.15), (3.0, 0.9)], UPPER)
    node(axes, (2.65, 0.15), EXACT)
    node(axes, (2.6, 0.0), ALLOWANCE)
    label(axes, 1.62, 0.98, "the more convex twin\nstays; mean normal")
    label(axes, 0.1, -0.5, "the other keeps an allowance")


def draw_notch(axes):
    """Two rows in front of a reflex corner."""
    axes.set_title("reflex corner: both half-planes, two rows")
    outline = [(0, 0), (3, 0), (3, 0.6), (0.7, 0.6), (0.7, 2.0), (0, 2.0)]
    body(axes, outline, LOWER)
    for place in outline[2:5]:
        node(axes, place)
    corner = (1.15, 0.95)
    body(axes, [corner, (2.35, 0.95), (2.35, 2.0), (1.15, 2.0)], UPPER)
    node(axes, corner, EXACT)
    arrow(axes, (corner[0], 0.6), (0, 0.62), NORMAL, "$n_1$")
    arrow(axes, (0.7, corner[1]), (0.78, 0), NORMAL, "$n_2$", (0.0, 0.08))
    arrow(axes, (2.0, 1.75), (-0.45, -0.4), MOTION, "free motion", (-0.1, -0.2))


def draw_vertex(axes):
    """A vertex row between two convex corners."""
    axes.set_title("convex corner: one row, normal by the free motion f")
    k = (1.3, 0.7)
    body(axes, [(0, 0), (1.3, 0), k, (0, 0.7)], LOWER)
    i = (1.48, 1.0)
    body(axes, [i, (2.5, 1.45), (2.05, 2.45), (1.03, 2.0)], UPPER)
    node(axes, k)
    node(axes, i, EXACT)
    label(axes, k[0] - 0.16, k[1] - 0.2, "k")
    label(axes, i[0] + 0.11, i[1] - 0.05, "i")
    # N(k) from n1 to n2; the part of it that is in -N(i) too begins at the normal of i's face.
    face = (0.911, 0.412)
    ends = [(k[0] + 1.15 * x, k[1] + 1.15 * y) for x, y in (face, (0.0, 1.0))]
    axes.fill(*zip(k, *ends), color=NORMAL, alpha=0.13, linewidth=0, zorder=0)
    for x, y in ((1.0, 0.0), (0.0, 1.0)):
        axes.plot((k[0], k[0] + 1.3 * x), (k[1], k[1] + 1.3 * y), color=NORMAL, lw=0.9, ls="--")
    label(axes, 2.15, 0.53, "N(k) between dashes", color=NORMAL)
    label(axes, 2.55, 1.1, "shaded: in −N(i) too", color=NORMAL)
    arrow(axes, k, (0, 0.75), NORMAL, "n", (-0.17, -0.05))
    arrow(axes, i, (-0.5, -0.55), MOTION, "f", (-0.16, 0.0))
    label(axes, 1.42, 0.12, "n: the end of the shaded cone whose\nhalf-plane f leaves least, or last")


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    default = os.path.join(startup.ROOT, "doc", "figures", "contact_rows.png")
    parser.add_argument("-o", metavar="FILE", default=default)
    a = parser.parse_args()
    figure, axes = plt.subplots(2, 2, figsize=(10.5, 7.2))
    for draw, place in zip((draw_sides, draw_corner, draw_notch, draw_vertex), axes.flat):
        draw(place)
        place.set_aspect("equal")
        place.axis("off")
        place.title.set_fontsize(10.5)
    names = {EXACT: "exact row, gap ≥ 0", ALLOWANCE: "allowance, gap ≥ −delta"}
    marks = [
        plt.Line2D([], [], marker="o", ls="", mfc=c if c == EXACT else "white", mec=c, label=text)
        for c, text in names.items()
    ]
    figure.legend(handles=marks, loc="lower center", ncol=2, frameon=False)
    figure.tight_layout(rect=(0, 0.04, 1, 1))
    figure.savefig(a.o, dpi=110, metadata={"Software": None})


if __name__ == "__main__":
    main()
