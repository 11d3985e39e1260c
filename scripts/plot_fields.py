#!/usr/bin/env python3
"""Draw the field files of a run: snapshots, an animation, or one quantity over x and t.

    plot_fields.py RUN --field STRESS:xx                  snapshots at six times (PNG)
    plot_fields.py RUN --field V:x --animate              an animation (GIF)
    plot_fields.py RUN --field V:x --xt                   over x (mean over y) and time (PNG)

RUN is the directory of a run with *BIPACT_FIELD. A field is a name, or NAME:component: x, y, z,
size of a vector; xx, yy, zz, xy, mises of STRESS; 1, 2, 3 of PRINCIPAL. Displacements are
magnified by --scale in snapshots and animations."""

import argparse
import os
import sys

import startup  # noqa: F401  before what is no part of Python
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.animation import FuncAnimation, PillowWriter  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402

from fields import Fields  # noqa: E402

VECTOR = {"x": 0, "y": 1, "z": 2}
STRESS = {"xx": 0, "yy": 1, "zz": 2, "xy": 3, "yz": 4, "xz": 5}


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
    places = {"STRESS": STRESS, "PRINCIPAL": {"1": 0, "2": 1, "3": 2}}.get(name, VECTOR)
    if part not in places:
        raise SystemExit("%s has no component '%s': %s" % (name, part, " ".join(places)))
    return values[:, places[part]]


class Picture:
    """A quantity of a run at its frames."""

    def __init__(self, run, field):
        name, _, part = field.partition(":")
        if name not in run.names:
            raise SystemExit("no field %s; there are: %s" % (name, " ".join(sorted(run.names))))
        self.run, self.name = run, name
        self.part = part or {"STRESS": "mises", "PRINCIPAL": "1"}.get(name, "size")
        whole = run.frame(0, name)
        self.label = name if whole.ndim == 1 else "%s %s" % (name, self.part)

    def at(self, k):
        return component(self.run.frame(k, self.name), self.name, self.part)

    def of_cells(self, k):
        """One value an element; of a nodal field the mean over the corners."""
        values = self.at(k)
        if self.run.names[self.name] == "Cell":
            return values
        return np.array([np.nanmean(values[c]) for c in self.run.cells])

    def limits(self, frames):
        low = min(np.nanmin(self.of_cells(k)) for k in frames)
        high = max(np.nanmax(self.of_cells(k)) for k in frames)
        if low < 0.0 < high:
            low, high = -max(-low, high), max(-low, high)
        return low, high if high > low else low + 1.0


def patches(run, k, scale):
    """Corners of the elements at a frame, moved by their displacement."""
    points = run.points[:, :2]
    if "U" in run.names:
        points = points + scale * run.frame(k, "U")[:, :2]
    return [points[c] for c in run.cells]


def draw_frame(axes, picture, k, scale, limits):
    shapes = PolyCollection(
        patches(picture.run, k, scale), cmap="RdBu_r" if limits[0] < 0 else "viridis"
    )
    shapes.set_array(picture.of_cells(k))
    shapes.set_clim(*limits)
    axes.add_collection(shapes)
    axes.set_aspect("equal")
    axes.set_title("t = %.4g" % picture.run.times[k], fontsize=9)
    return shapes


def frame_of(run, frames, scale):
    """Limits of the axes that hold the bodies at all frames."""
    corners = np.concatenate([np.concatenate(patches(run, k, scale)) for k in frames])
    low, high = corners.min(axis=0), corners.max(axis=0)
    margin = 0.03 * max(high - low)
    return low - margin, high + margin


def snapshots(picture, path, scale, count=6):
    run = picture.run
    frames = np.unique(np.linspace(0, len(run.times) - 1, count).astype(int))
    limits, (low, high) = picture.limits(frames), frame_of(run, frames, scale)
    height = 0.7 + 6.5 * (high - low)[1] / (high - low)[0]
    figure, rows = plt.subplots(
        len(frames), 1, figsize=(8, height * len(frames)), layout="constrained", squeeze=False
    )
    for axes, k in zip(rows[:, 0], frames):
        shapes = draw_frame(axes, picture, k, scale, limits)
        axes.set_xlim(low[0], high[0])
        axes.set_ylim(low[1], high[1])
    figure.colorbar(shapes, ax=rows[:, 0], label=picture.label)
    figure.savefig(path, dpi=100)
    plt.close(figure)


def animation(picture, path, scale, most=60):
    run = picture.run
    frames = np.unique(np.linspace(0, len(run.times) - 1, most).astype(int))
    limits, (low, high) = picture.limits(frames), frame_of(run, frames, scale)
    figure, axes = plt.subplots(
        figsize=(8, 1.5 + 7.0 * (high - low)[1] / (high - low)[0]), layout="constrained"
    )
    figure.colorbar(
        draw_frame(axes, picture, 0, scale, limits), ax=axes, label=picture.label, shrink=0.8
    )

    def show(k):
        axes.clear()
        draw_frame(axes, picture, k, scale, limits)
        axes.set_xlim(low[0], high[0])
        axes.set_ylim(low[1], high[1])
        return []

    FuncAnimation(figure, show, frames=frames).save(path, writer=PillowWriter(fps=15), dpi=80)
    plt.close(figure)


def over_x_and_t(picture, path, title=""):
    """The quantity over x (mean over y of nodes or elements in the same place) and t."""
    run = picture.run
    if run.names[picture.name] == "Point":
        x = run.points[:, 0]
    else:
        x = np.array([run.points[c, 0].mean() for c in run.cells])
    # Bodies that touch have nodes in the same place: the gap between them keeps them apart.
    columns, where = np.unique(np.round(x, 9), return_inverse=True)
    count = np.bincount(where)
    rows = np.array([np.bincount(where, picture.at(k)) / count for k in range(len(run.times))])
    low, high = np.nanmin(rows), np.nanmax(rows)
    if low < 0.0 < high:
        low, high = -max(-low, high), max(-low, high)
    figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
    mesh = axes.pcolormesh(
        columns,
        run.times,
        rows,
        shading="nearest",
        cmap="RdBu_r" if low < 0 else "viridis",
        vmin=low,
        vmax=high,
    )
    figure.colorbar(mesh, ax=axes, label=picture.label)
    axes.set_xlabel("x [L]")
    axes.set_ylabel("t [T]")
    axes.set_title(title or "%s over x and t" % picture.label)
    figure.savefig(path, dpi=120)
    plt.close(figure)
    return path


def main(argv=None):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("run")
    parser.add_argument("--field", default="V:x", help="NAME or NAME:component (V:x)")
    parser.add_argument("--xt", action="store_true", help="over x and t")
    parser.add_argument("--animate", action="store_true", help="an animation")
    parser.add_argument("--scale", type=float, default=1.0, help="of displacements (1)")
    parser.add_argument("-o", "--out", help="file; else in RUN")
    a = parser.parse_args(argv)
    try:
        picture = Picture(Fields(a.run), a.field)
    except FileNotFoundError as problem:
        print(
            "plot_fields: %s; *BIPACT_FIELD makes a run write them" % problem, file=sys.stderr
        )
        return 1
    kind = "xt" if a.xt else "animation" if a.animate else "snapshots"
    name = "%s_%s.%s" % (kind, a.field.replace(":", "_"), "gif" if a.animate else "png")
    path = a.out or os.path.join(a.run, name)
    if a.xt:
        over_x_and_t(picture, path)
    elif a.animate:
        animation(picture, path, a.scale)
    else:
        snapshots(picture, path, a.scale)
    print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
