"""Pictures of solids for plot_fields.py: the faces that one element alone has, in the colour of
a quantity of their elements, or of their nodes, seen from a corner."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FuncAnimation, PillowWriter
from matplotlib.colors import LightSource
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from mesh_shapes import SHAPES, outline

# Faces of cells by their VTK type; of quadratic ones with the nodes between corners.
FACES = {
    10: ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)),
    12: ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)),
    13: ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    14: ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
    24: [outline("tetra10", side) for side in SHAPES["tetra10"].sides],
    29: [outline("hexahedron27", side) for side in SHAPES["hexahedron27"].sides],
}


def exterior_faces(run):
    """[(nodes of a face, its element)] of the faces that one element alone has."""
    found = {}
    for e, (cell, kind) in enumerate(zip(run.cells, run.types)):
        for face in FACES[int(kind)]:
            nodes = [int(cell[k]) for k in face]
            found.setdefault(tuple(sorted(nodes)), []).append((nodes, e))
    return [owners[0] for owners in found.values() if len(owners) == 1]


def places_at(run, k, scale):
    return run.points + scale * run.frame(k, "U") if "U" in run.names else run.points


class Scene:
    """The surface of a run and what it is coloured by."""

    def __init__(self, picture, scale):
        self.picture, self.run, self.scale = picture, picture.run, scale
        faces = exterior_faces(self.run)
        self.faces, self.owner = [f for f, _ in faces], np.array([e for _, e in faces])

    def values(self, k):
        """One value a face: of its element, or the mean over its nodes that have one."""
        values = self.picture.at(k)
        if self.run.names[self.picture.name] == "Cell":
            return values[self.owner]
        at = [values[f][~np.isnan(values[f])] for f in self.faces]
        best = np.max if self.picture.name == "STATUS" else np.mean
        return np.array([best(v) if len(v) else np.nan for v in at])

    def limits(self, frames):
        values = np.concatenate([self.values(k) for k in frames])
        values = values[~np.isnan(values)]
        if not len(values):
            return 0.0, 1.0
        low, high = values.min(), values.max()
        if low < 0.0 < high:
            low, high = -max(-low, high), max(-low, high)
        return low, high if high > low else low + 1.0

    def draw(self, axes, k, limits):
        """The faces at a frame, shaded by how they stand to the light."""
        places = places_at(self.run, k, self.scale)
        colours = self.picture.colours(limits)
        cmap = plt.get_cmap(colours["cmap"])
        shown = cmap(colours["norm"](np.nan_to_num(self.values(k), nan=limits[0])))
        shapes = [places[f] for f in self.faces]
        thirds = [(s[0], s[len(s) // 3], s[2 * len(s) // 3]) for s in shapes]
        normal = np.array([np.cross(b - a, c - a) for a, b, c in thirds])
        normal /= np.linalg.norm(normal, axis=1)[:, None] + 1e-300
        light = LightSource(225, 45).direction
        shown[:, :3] *= (0.75 + 0.25 * np.abs(normal @ light))[:, None]
        axes.add_collection3d(
            Poly3DCollection(shapes, facecolors=shown, edgecolors="#404040", linewidths=0.15)
        )
        axes.set_title("t = %.4g" % self.run.times[k], fontsize=10)

    def frame(self, axes, frames):
        """Axes that hold the bodies at all frames, with one unit of length."""
        corners = np.concatenate([places_at(self.run, k, self.scale) for k in frames])
        low, high = corners.min(axis=0), corners.max(axis=0)
        for set_limits, a, b in zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), low, high):
            set_limits(a, b if b > a else a + 1.0)
        axes.set_box_aspect(np.maximum(high - low, 1e-3 * (high - low).max()), zoom=0.85)
        axes.view_init(elev=22, azim=-60)
        axes.tick_params(labelsize=7)
        axes.set_xlabel("x [L]", fontsize=8)
        axes.set_ylabel("y [L]", fontsize=8)
        axes.set_zlabel("z [L]", fontsize=8)
        axes.locator_params(nbins=4)

    def bar(self, figure, limits, axes):
        shapes = plt.cm.ScalarMappable(**self.picture.colours(limits))
        shapes.set_array([])
        self.picture.bar(figure, shapes, axes)


def snapshots(picture, path, scale, title, count=None):
    """Panels side by side."""
    scene, run = Scene(picture, scale), picture.run
    frames = np.unique(np.linspace(0, len(run.times) - 1, count or 3).astype(int))
    limits, n = scene.limits(frames), len(frames)
    figure = plt.figure(figsize=(1.2 + 4.2 * n, 4.6), layout="constrained")
    all_axes = [figure.add_subplot(1, n, i + 1, projection="3d") for i in range(n)]
    for axes, k in zip(all_axes, frames):
        scene.draw(axes, k, limits)
        scene.frame(axes, frames)
    scene.bar(figure, limits, all_axes)
    figure.suptitle(title, fontsize=12)
    figure.savefig(path, dpi=110)
    plt.close(figure)
    return path


def animation(picture, path, scale, title, most=40):
    """All frames one after the other, at most so many."""
    scene, run = Scene(picture, scale), picture.run
    frames = np.unique(np.linspace(0, len(run.times) - 1, most).astype(int))
    limits = scene.limits(frames)
    figure = plt.figure(figsize=(6.4, 5.0), layout="constrained")
    axes = figure.add_subplot(projection="3d")
    scene.bar(figure, limits, axes)
    figure.suptitle(title, fontsize=12)

    def show(k):
        axes.clear()
        scene.draw(axes, k, limits)
        scene.frame(axes, frames)
        return []

    FuncAnimation(figure, show, frames=frames).save(path, writer=PillowWriter(fps=12), dpi=80)
    plt.close(figure)
    return path
