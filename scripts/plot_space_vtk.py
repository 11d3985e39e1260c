"""Solids drawn by PyVista, where it is installed: what hides what is right for every face, and
large meshes take seconds. plot_space.py draws without it."""

import numpy as np
import pyvista


def opens():
    """Can a picture be made here, without a window?"""
    try:
        plotter = pyvista.Plotter(off_screen=True, window_size=(16, 16))
        plotter.add_mesh(pyvista.Plane())
        image = plotter.screenshot(return_img=True)
        plotter.close()
    except Exception as problem:  # of the graphics library: it has no common class
        print("drawn without PyVista: %s" % problem)
        return False
    return image is not None and np.ptp(image) > 0


class Painter:
    """Images of a surface at frames: faces in their colours, the frame of the axes."""

    def __init__(self, scene, low, high):
        self.scene, self.low, self.high = scene, low, high
        sizes = np.array([len(f) for f in scene.faces])
        first = np.concatenate(([0], np.cumsum(sizes + 1)[:-1]))
        self.faces = np.concatenate([np.concatenate(([len(f)], f)) for f in scene.faces])
        assert np.array_equal(self.faces[first], sizes)

    def image(self, k, colours, pixels):
        """The faces at a frame as an array of pixels; colours: one of red, green, blue a face."""
        surface = pyvista.PolyData(self.scene.places_at(k), faces=self.faces)
        surface.cell_data["colour"] = np.round(255.0 * colours[:, :3]).astype(np.uint8)
        plotter = pyvista.Plotter(off_screen=True, window_size=pixels)
        plotter.add_mesh(surface, scalars="colour", rgb=True, show_edges=True, ambient=0.4)
        box = np.stack([self.low, self.high], axis=1).ravel()
        plotter.show_bounds(
            bounds=box,
            xtitle="x [L]",
            ytitle="y [L]",
            ztitle="z [L]",
            font_size=18,
            location="outer",
            n_xlabels=3,
            n_ylabels=3,
            n_zlabels=3,
            fmt="%.3g",
        )
        middle, size = 0.5 * (self.low + self.high), np.linalg.norm(self.high - self.low)
        plotter.camera_position = [
            middle + size * np.array([0.9, -1.5, 0.75]),
            middle,
            (0, 0, 1),
        ]
        plotter.reset_camera(bounds=box)
        plotter.camera.zoom(0.9)
        image = plotter.screenshot(return_img=True)
        plotter.close()
        return image
