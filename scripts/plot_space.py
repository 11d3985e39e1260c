"""Pictures of solids for plot_fields.py: the faces that one element alone has, in the colour of
a quantity of their elements, or of their nodes, seen from a corner. PyVista draws them where it
is installed, else Matplotlib."""

import startup  # noqa: F401  before what is no part of Python
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FuncAnimation, PillowWriter
from matplotlib.colors import LightSource
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from solid_forms import HEX_MIDDLES, TET_MIDDLES

# Faces of cells by their VTK type.
FACES = {
    10: ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)),
    12: ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)),
    13: ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    14: ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
}


def with_middles(faces, middles, first):
    """Faces of quadratic cells: between two corners the node of their edge."""
    at = {frozenset(pair): first + k for k, pair in enumerate(middles)}
    return tuple(
        tuple(n for a, b in zip(f, f[1:] + f[:1]) for n in (a, at[frozenset((a, b))]))
        for f in faces
    )


FACES[24] = with_middles(FACES[10], TET_MIDDLES, 4)
FACES[29] = with_middles(FACES[12], HEX_MIDDLES, 8)


def painters():
    """What draws with PyVista, or None."""
    try:
        import plot_space_vtk
    except ImportError:
        return None
    return plot_space_vtk if plot_space_vtk.opens() else None


def exterior_faces(run):
    """[(nodes of a face, its element)] of the faces that one element alone has."""
    found = {}
    for e, (cell, kind) in enumerate(zip(run.cells, run.types)):
        for face in FACES[int(kind)]:
            nodes = [int(cell[k]) for k in face]
            found.setdefault(tuple(sorted(nodes)), []).append((nodes, e))
    return [owners[0] for owners in found.values() if len(owners) == 1]


class Scene:
    """The surface of a run and what it is coloured by, at some frames."""

    def __init__(self, picture, scale, frames):
        self.picture, self.run, self.scale = picture, picture.run, scale
        faces = exterior_faces(self.run)
        self.faces, self.owner = [f for f, _ in faces], np.array([e for _, e in faces])
        self.limits = self.limits_at(frames)
        places = np.concatenate([self.places_at(k) for k in frames])
        self.low, self.high = places.min(axis=0), places.max(axis=0)
        found = painters()
        self.painter = found and found.Painter(self, self.low, self.high)

    def places_at(self, k):
        if "U" not in self.run.names:
            return self.run.points
        return self.run.points + self.scale * self.run.frame(k, "U")

    def values(self, k):
        """One value a face: of its element, or the mean over its nodes that have one."""
        values = self.picture.at(k)
        if self.run.names[self.picture.name] == "Cell":
            return values[self.owner]
        at = [values[f][~np.isnan(values[f])] for f in self.faces]
        best = np.max if self.picture.name == "STATUS" else np.mean
        return np.array([best(v) if len(v) else np.nan for v in at])

    def limits_at(self, frames):
        values = np.concatenate([self.values(k) for k in frames])
        values = values[~np.isnan(values)]
        if not len(values):
            return 0.0, 1.0
        low, high = values.min(), values.max()
        if low < 0.0 < high:
            low, high = -max(-low, high), max(-low, high)
        return low, high if high > low else low + 1.0

    def colours(self, k):
        """One colour a face."""
        colours = self.picture.colours(self.limits)
        values = np.nan_to_num(self.values(k), nan=self.limits[0])
        return plt.get_cmap(colours["cmap"])(colours["norm"](values))

    def axes(self, figure, *where):
        return figure.add_subplot(*where, projection=None if self.painter else "3d")

    def draw(self, axes, k):
        """The faces at a frame."""
        axes.set_title("t = %.4g" % self.run.times[k], fontsize=10)
        if self.painter:
            axes.imshow(self.painter.image(k, self.colours(k), (800, 700)))
            axes.set_axis_off()
            return
        self.draw_faces(axes, k)
        self.frame(axes)

    def draw_faces(self, axes, k):
        """The faces, shaded by how they stand to the light."""
        places, shown = self.places_at(k), self.colours(k)
        shapes = [places[f] for f in self.faces]
        normal = np.array([np.cross(s[1] - s[0], s[2] - s[0]) for s in shapes])
        normal /= np.linalg.norm(normal, axis=1)[:, None] + 1e-300
        light = LightSource(225, 45).direction
        shown[:, :3] *= (0.75 + 0.25 * np.abs(normal @ light))[:, None]
        axes.add_collection3d(
            Poly3DCollection(shapes, facecolors=shown, edgecolors="#404040", linewidths=0.15)
        )

    def frame(self, axes):
        """Axes that hold the bodies at all frames, with one unit of length."""
        low, high = self.low, self.high
        for set_limits, a, b in zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), low, high):
            set_limits(a, b if b > a else a + 1.0)
        axes.set_box_aspect(np.maximum(high - low, 1e-3 * (high - low).max()), zoom=0.85)
        axes.view_init(elev=22, azim=-60)
        axes.tick_params(labelsize=7)
        axes.set_xlabel("x [L]", fontsize=8)
        axes.set_ylabel("y [L]", fontsize=8)
        axes.set_zlabel("z [L]", fontsize=8)
        axes.locator_params(nbins=4)

    def bar(self, figure, axes):
        shapes = plt.cm.ScalarMappable(**self.picture.colours(self.limits))
        shapes.set_array([])
        self.picture.bar(figure, shapes, axes)


def snapshots(picture, path, scale, title, count=None):
    """Panels side by side."""
    frames = np.unique(np.linspace(0, len(picture.run.times) - 1, count or 3).astype(int))
    scene, n = Scene(picture, scale, frames), len(frames)
    figure = plt.figure(figsize=(1.2 + 4.2 * n, 4.6), layout="constrained")
    all_axes = [scene.axes(figure, 1, n, i + 1) for i in range(n)]
    for axes, k in zip(all_axes, frames):
        scene.draw(axes, k)
    scene.bar(figure, all_axes)
    figure.suptitle(title, fontsize=12)
    figure.savefig(path, dpi=110)
    plt.close(figure)
    return path


def animation(picture, path, scale, title, most=40):
    """All frames one after the other, at most so many."""
    frames = np.unique(np.linspace(0, len(picture.run.times) - 1, most).astype(int))
    scene = Scene(picture, scale, frames)
    figure = plt.figure(figsize=(6.4, 5.0), layout="constrained")
    axes = scene.axes(figure)
    scene.bar(figure, axes)
    figure.suptitle(title, fontsize=12)

    def show(k):
        axes.clear()
        scene.draw(axes, k)
        return []

    FuncAnimation(figure, show, frames=frames).save(path, writer=PillowWriter(fps=12), dpi=80)
    plt.close(figure)
    return path
