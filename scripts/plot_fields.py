#!/usr/bin/env python3
"""Draw the field files of a run: snapshots, an animation, or one quantity over place and time.

    plot_fields.py RUN --field STRESS:xx                  snapshots at some times (PNG)
    plot_fields.py RUN --field V:x --animate              an animation (GIF)
    plot_fields.py RUN --field V:x --xt                   over x (mean over y) and time (PNG)

RUN is the directory of a run with *BIPACT_FIELD. A field is a name, or NAME:component: x, y, z,
size of a vector; xx, yy, zz, xy, mises of STRESS; 1, 2, 3 of PRINCIPAL and STRETCH.
Displacements are
magnified by --scale in snapshots and animations. Lines are the boundaries of bodies and parts;
of solids the faces of their surface are drawn, by PyVista where it is installed.
Dimensions in brackets: [L] length, [T] time, [F] force; a deck has no other units."""

import argparse
import os
import sys

import startup  # noqa: F401  before what is no part of Python
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.animation import FuncAnimation, PillowWriter  # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402
from matplotlib.colors import BoundaryNorm, ListedColormap  # noqa: E402

from cards import SHELL  # noqa: E402
from exact_scene import ECHO, Deck  # noqa: E402
from fields import Fields  # noqa: E402

VECTOR = {"x": 0, "y": 1, "z": 2}
RANKS = {"1": 0, "2": 1, "3": 2}
STRESS = {"xx": 0, "yy": 1, "zz": 2, "xy": 3, "yz": 4, "xz": 5}
QUANTITY = {
    "U": ("displacement", "L"),
    "V": ("velocity", "L/T"),
    "FORCE": ("contact force of a node", "F"),
    "PRESSURE": ("contact pressure", "F/L^2"),
    "GAP": ("gap", "L"),
    "STATUS": ("contact", ""),
    "STRESS": ("stress", "F/L^2"),
    "ENERGY": ("strain energy of an element", "F L"),
    "PRINCIPAL": ("principal stress", "F/L^2"),
    "STRETCH": ("principal stretch", ""),
    "PLASTIC": ("equivalent plastic strain", ""),
    "PART": ("part", ""),
}
STATES = ("no surface", "open", "stick", "slip")  # STATUS -1, 0, 1, 2
STATE_COLOURS = ("#e8e8e8", "#56B4E9", "#009E73", "#D55E00")
MOST_ROWS = 8  # of panels over place and time
FIRST_SOLID = 10  # of the cell types of VTK
STACK = 0.5  # bodies whose height is less than this times their width: panels below each other


def component(values, name, part):
    """One number a node or element of a field, by the name of its component."""
    if values.ndim == 1:
        return values.astype(float)
    if part == "size":
        return np.linalg.norm(values, axis=1)
    if part == "mises":
        xx, yy, zz, xy, yz, xz = values.T
        shear = 3.0 * (xy**2 + yz**2 + xz**2)
        return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + shear)
    places = {"STRESS": STRESS, "PRINCIPAL": RANKS, "STRETCH": RANKS}.get(name, VECTOR)
    if part not in places:
        raise SystemExit("%s has no component '%s': %s" % (name, part, " ".join(places)))
    return values[:, places[part]]


# ---------------------------------------------------------------- bodies and parts


def bodies_of(run):
    """Number of the body of each node: what elements hold together, counted from 0."""
    low = np.arange(len(run.points))
    corners = padded(run.cells)
    while True:  # the lowest number of a body spreads from element to element
        least = low[corners].min(axis=1)
        new = low.copy()
        np.minimum.at(new, corners, least[:, None])
        new = new[new]
        if np.array_equal(new, low):
            return np.unique(low, return_inverse=True)[1]
        low = new


def padded(cells):
    """Corners of the elements, as many of each: the last is there again where one has fewer."""
    most = max(4, max(len(c) for c in cells))
    return np.array([[*c] + [c[-1]] * (most - len(c)) for c in cells])


def parts_of(run, folder):
    """Part of each element: of the field PART, else of the deck where it has the same elements,
    else its body."""
    if "PART" in run.names:
        return run.frame(0, "PART")
    path = os.path.join(folder, ECHO)
    if os.path.exists(path):
        parts = []
        if not (run.types >= FIRST_SOLID).any():
            parts = [int(f[1]) for (f,) in Deck(path).cards("ELEMENT_SHELL", 1, SHELL)]
        if len(parts) == len(run.cells):
            return np.array(parts)
    return bodies_of(run)[[c[0] for c in run.cells]]


def boundary_edges(cells, parts):
    """Pairs of nodes of the edges that belong to one element only, or to two parts."""
    owners = {}
    for cell, part in zip(cells, parts):
        for a, b in zip(cell, np.roll(cell, -1)):
            owners.setdefault((min(a, b), max(a, b)), []).append(part)
    return np.array([e for e, found in owners.items() if len(found) < 2 or len(set(found)) > 1])


# ---------------------------------------------------------------- a quantity


class Picture:
    """A quantity of a run at its frames."""

    def __init__(self, folder, field):
        self.run = Fields(folder)
        self.title = os.path.basename(os.path.abspath(folder))
        name, _, part = field.partition(":")
        if name not in self.run.names:
            known = " ".join(sorted(self.run.names))
            raise SystemExit("no field %s; there are: %s" % (name, known))
        self.name = name
        self.part = part or {"STRESS": "mises", "PRINCIPAL": "1", "STRETCH": "1"}.get(name, "size")
        self.label = self.words(self.run.frame(0, name).ndim)
        self.corners = padded(self.run.cells)
        count = np.array([len(c) for c in self.run.cells])
        self.repeated = np.arange(self.corners.shape[1]) >= count[:, None]
        self.parts = parts_of(self.run, folder)
        self.in_space = bool((self.run.types >= FIRST_SOLID).any())
        if not self.in_space:
            self.edges = boundary_edges(self.run.cells, self.parts)

    def words(self, dimensions):
        """Name of the quantity with its dimension."""
        quantity, unit = QUANTITY.get(self.name, (self.name, ""))
        of = {"size": "size of the ", "mises": "von Mises "}.get(self.part, "")
        after = "" if of or dimensions == 1 else " " + self.part
        text = quantity + after if dimensions == 1 else of + quantity + after
        return text + (" [%s]" % unit if unit else "")

    def at(self, k):
        return component(self.run.frame(k, self.name), self.name, self.part)

    def of_cells(self, k):
        """One value an element; of a nodal field the mean over the corners that have one, of
        STATUS the highest."""
        values = self.at(k)
        if self.run.names[self.name] == "Cell":
            return values
        at_corners = values[self.corners]
        if self.name == "STATUS":
            return at_corners.max(axis=1)
        there = ~np.isnan(at_corners)
        there[self.repeated] = False
        count = there.sum(axis=1)
        total = np.where(there, at_corners, 0.0).sum(axis=1)
        return np.where(count > 0, total / np.maximum(count, 1), np.nan)

    def limits(self, frames):
        """Least and largest value at some frames; the same on both sides of 0 if it changes
        sign."""
        values = np.concatenate([self.of_cells(k) for k in frames])
        values = values[~np.isnan(values)]
        if not len(values):
            return 0.0, 1.0
        return balanced(values.min(), values.max())

    def colours(self, limits):
        """What matplotlib wants to know of the colours."""
        if self.name == "STATUS":
            norm = BoundaryNorm([-1.5, -0.5, 0.5, 1.5, 2.5], 4)
            return {"cmap": ListedColormap(STATE_COLOURS), "norm": norm}
        norm = plt.Normalize(*limits)
        return {"cmap": "RdBu_r" if limits[0] < 0.0 < limits[1] else "viridis", "norm": norm}

    def bar(self, figure, shapes, axes):
        """The colour bar with the name of the quantity."""
        bar = figure.colorbar(shapes, ax=axes, label=self.label, aspect=30)
        if self.name == "STATUS":
            bar.set_ticks([-1, 0, 1, 2], labels=STATES)


def balanced(low, high):
    if low < 0.0 < high:
        low, high = -max(-low, high), max(-low, high)
    return low, high if high > low else low + 1.0


# ---------------------------------------------------------------- snapshots


def points_at(run, k, scale):
    """Places of the nodes at a frame, moved by their displacement."""
    points = run.points[:, :2]
    return points + scale * run.frame(k, "U")[:, :2] if "U" in run.names else points


def draw_frame(axes, picture, k, scale, limits):
    """Elements in the colour of the quantity, and the outlines of bodies and parts."""
    points = points_at(picture.run, k, scale)
    shapes = PolyCollection(
        [points[c] for c in picture.run.cells],
        edgecolors="face",
        lw=0.2,
        **picture.colours(limits)
    )
    shapes.set_array(picture.of_cells(k))
    axes.add_collection(shapes)
    axes.add_collection(LineCollection(points[picture.edges], colors="black", lw=0.8))
    axes.set_aspect("equal")
    axes.set_title("t = %.4g" % picture.run.times[k], fontsize=10)
    return shapes


def frame_of(run, frames, scale):
    """Limits of the axes that hold the bodies at all frames."""
    corners = np.concatenate([points_at(run, k, scale) for k in frames])
    low, high = corners.min(axis=0), corners.max(axis=0)
    margin = 0.03 * max(high - low)
    return low - margin, high + margin


def name_axes(axes, low, high, left=True, bottom=True):
    """Limits, and names where a panel is at the rim of the figure."""
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_xlabel("x [L]" if bottom else "")
    axes.set_ylabel("y [L]" if left else "")
    axes.tick_params(labelbottom=bottom, labelleft=left)
    axes.locator_params(axis="x", nbins=6)
    axes.locator_params(
        axis="y", nbins=3 if high[1] - low[1] < STACK * (high[0] - low[0]) else 6
    )


def title_of(picture, scale=1.0):
    moved = "" if scale == 1.0 else ", displacements x %g" % scale
    return "%s: %s%s" % (picture.title, picture.label.split(" [")[0], moved)


def snapshots(picture, path, scale, count=None):
    """Panels below each other for long bodies, side by side for others."""
    run = picture.run
    low, high = frame_of(run, [0, len(run.times) - 1], scale)
    long = high[1] - low[1] < STACK * (high[0] - low[0])
    count = count or (6 if long else 4)
    frames = np.unique(np.linspace(0, len(run.times) - 1, count).astype(int))
    limits, (low, high) = picture.limits(frames), frame_of(run, frames, scale)
    shape = (high - low)[1] / (high - low)[0]
    n = len(frames)
    if long:
        width = min(7.0, max(3.2, (11.0 / n - 0.4) / shape))
        size = (2.6 + width, 0.9 + (0.4 + width * shape) * n)
    else:
        width = min(3.2, 7.0 / shape)
        size = (1.6 + (0.25 + width) * n, 1.2 + width * shape)
    figure, grid = plt.subplots(
        *((n, 1) if long else (1, n)), figsize=size, layout="compressed", squeeze=False
    )
    for i, (axes, k) in enumerate(zip(grid.flat, frames)):
        shapes = draw_frame(axes, picture, k, scale, limits)
        name_axes(axes, low, high, long or i == 0, not long or i == n - 1)
    picture.bar(figure, shapes, list(grid.flat))
    figure.suptitle(title_of(picture, scale), fontsize=12)
    figure.savefig(path, dpi=110, bbox_inches="tight")
    plt.close(figure)
    return path


def animation(picture, path, scale, most=60):
    """All frames one after the other, at most so many."""
    run = picture.run
    frames = np.unique(np.linspace(0, len(run.times) - 1, most).astype(int))
    limits, (low, high) = picture.limits(frames), frame_of(run, frames, scale)
    shape = (high - low)[1] / (high - low)[0]
    width = min(7.0, 7.0 / shape)
    figure, axes = plt.subplots(
        figsize=(1.8 + width, 1.3 + width * shape), layout="constrained"
    )
    picture.bar(figure, draw_frame(axes, picture, 0, scale, limits), axes)
    figure.suptitle(title_of(picture, scale), fontsize=12)

    def show(k):
        axes.clear()
        draw_frame(axes, picture, k, scale, limits)
        name_axes(axes, low, high)
        return []

    FuncAnimation(figure, show, frames=frames).save(path, writer=PillowWriter(fps=15), dpi=80)
    plt.close(figure)
    return path


# ---------------------------------------------------------------- over place and time


def strips(picture, along):
    """[(places, (frames, places) values)] of each body: means over the nodes or elements
    of the body that have the same place at the start along an axis (0: x, 1: y)."""
    run = picture.run
    body = bodies_of(run)
    place = run.points[:, along]
    if run.names[picture.name] == "Cell":
        place = np.array([run.points[c, along].mean() for c in run.cells])
        body = body[[c[0] for c in run.cells]]
    values = np.array([picture.at(k) for k in range(len(run.times))])
    digits = 9 - int(np.ceil(np.log10(np.ptp(run.points[:, along]) or 1.0)))
    found = []
    for b in range(body.max() + 1):
        mine = body == b
        columns, where = np.unique(np.round(place[mine], digits), return_inverse=True)
        there = ~np.isnan(values[:, mine])
        count = np.array([np.bincount(where, row, len(columns)) for row in there])
        filled = np.where(there, values[:, mine], 0.0)
        total = np.array([np.bincount(where, row, len(columns)) for row in filled])
        found.append((columns, np.where(count > 0, total / np.maximum(count, 1), np.nan)))
    return found


def edges_between(places, low, high):
    """Borders of columns half way between places, from one end of a body to the other."""
    middles = 0.5 * (places[1:] + places[:-1])
    return np.concatenate(([low], middles, [high]))


def rows_of_bodies(ends):
    """Bodies by the row of panels they are drawn in: those that would cover each other have
    rows of their own."""
    rows = []
    for b in np.argsort([low for low, _ in ends], kind="stable"):
        size = ends[b][1] - ends[b][0]
        for row in rows:
            if ends[b][0] >= ends[row[-1]][1] - 1e-3 * size:
                row.append(b)
                break
        else:
            rows.append([b])
    return rows


def over_place_and_time(picture, path, title="", along="x"):
    """The quantity over the place along an axis (mean across it) and time, each body with its
    own columns: nodes of two bodies in the same place stay apart."""
    run, axis = picture.run, VECTOR[along]
    found, body = strips(picture, axis), bodies_of(run)
    ends = [
        (run.points[body == b, axis].min(), run.points[body == b, axis].max())
        for b in range(len(found))
    ]
    values = np.concatenate([v.ravel() for _, v in found])
    limits = balanced(np.nanmin(values), np.nanmax(values))
    rows = rows_of_bodies(ends)
    if len(run.times) < 2:
        raise SystemExit("one frame has no picture over time")
    if len(rows) > MOST_ROWS:
        raise SystemExit(
            "%d bodies cover each other along %s: choose some by PSID of *BIPACT_FIELD"
            % (len(rows), along)
        )
    figure, grid = plt.subplots(
        len(rows),
        1,
        figsize=(7.5, 1.5 + 3.6 * len(rows)),
        layout="constrained",
        squeeze=False,
        sharex=True,
    )
    times = edges_between(run.times, run.times[0], run.times[-1])
    for axes, row in zip(grid[:, 0], rows):
        for b in row:
            borders = edges_between(found[b][0], *ends[b])
            mesh = axes.pcolormesh(borders, times, found[b][1], **picture.colours(limits))
            axes.vlines(ends[b], run.times[0], run.times[-1], colors="black", lw=0.8)
        parts = sorted({int(p) for c, p in zip(run.cells, picture.parts) if body[c[0]] in row})
        if len(rows) > 1:
            axes.set_title("part " + ", ".join(map(str, parts)), loc="left", fontsize=10)
        axes.set_ylabel("t [T]")
    axes.set_xlabel("%s at t = 0 [L]" % along)
    picture.bar(figure, mesh, list(grid[:, 0]))
    figure.suptitle(title or "%s over %s and time" % (title_of(picture), along), fontsize=12)
    figure.savefig(path, dpi=120)
    plt.close(figure)
    return path


def main(argv=None):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("run")
    parser.add_argument("--field", default="V:x", help="NAME or NAME:component (V:x)")
    parser.add_argument("--xt", action="store_true", help="over place and time")
    parser.add_argument("--along", choices=("x", "y"), default="x", help="place of --xt (x)")
    parser.add_argument("--animate", action="store_true", help="an animation")
    parser.add_argument("--scale", type=float, default=1.0, help="of displacements (1)")
    parser.add_argument(
        "--count", type=int, help="snapshots (6; 4 of bodies that are not long)"
    )
    parser.add_argument("-o", "--out", help="file; else in RUN")
    a = parser.parse_args(argv)
    try:
        picture = Picture(a.run, a.field)
    except FileNotFoundError as problem:
        print(
            "plot_fields: %s; *BIPACT_FIELD makes a run write them" % problem, file=sys.stderr
        )
        return 1
    kind = "xt" if a.xt else "animation" if a.animate else "snapshots"
    name = "%s_%s.%s" % (kind, a.field.replace(":", "_"), "gif" if a.animate else "png")
    path = a.out or os.path.join(a.run, name)
    if a.xt:
        over_place_and_time(picture, path, along=a.along)
    elif picture.in_space:
        import plot_space  # takes long to load

        title = title_of(picture, a.scale)
        if a.animate:
            plot_space.animation(picture, path, a.scale, title)
        else:
            plot_space.snapshots(picture, path, a.scale, title, a.count)
    elif a.animate:
        animation(picture, path, a.scale)
    else:
        snapshots(picture, path, a.scale, a.count)
    print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
