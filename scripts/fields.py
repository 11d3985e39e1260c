#!/usr/bin/env python3
"""Read the field files (fields.NNN.vtkhdf) that a run leaves in its directory.

    from fields import Fields
    run = Fields("run")
    run.times                  # of all frames, over all files
    run.points, run.cells      # (nodes, 3); corners of each element, counted from 0
    run.types                  # of the elements, by the numbers of VTK
    run.frame(7, "U")          # values of a field at a frame

On the command line: a summary of the frames and fields of a run.
"""

import argparse
import glob
import os
import sys

import startup  # noqa: F401  before what is no part of Python
import h5py
import numpy as np


def holds(group):
    """What a field file holds: names, places and sizes."""
    mesh = [group[name].shape for name in ("Points", "Types")]
    return mesh, sorted(group["PointData"]), sorted(group["CellData"])


class Fields:
    """All frames of a run that hold what the last ones do, in order of time."""

    def __init__(self, folder):
        paths = glob.glob(os.path.join(folder, "fields.*.vtkhdf"))
        self.paths = sorted(paths, key=lambda p: int(os.path.basename(p).split(".")[1]))
        if not self.paths:
            raise FileNotFoundError("no field files in %s" % folder)
        files = {path: h5py.File(path, "r")["VTKHDF"] for path in self.paths}
        # A run that went on with other fields has others in its first files.
        last = holds(files[self.paths[-1]])
        self.paths = [path for path in self.paths if holds(files[path]) == last]
        self.files = [files[path] for path in self.paths]
        counts = [int(g["Steps"].attrs["NSteps"]) for g in self.files]
        self.place = [(f, k) for f, n in enumerate(counts) for k in range(n)]
        self.times = np.concatenate(
            [g["Steps/Values"][:n] for g, n in zip(self.files, counts)] or [np.zeros(0)]
        )
        first = self.files[0]
        self.points = first["Points"][:]
        ends, corners = first["Offsets"][:], first["Connectivity"][:]
        self.cells = [corners[a:b] for a, b in zip(ends[:-1], ends[1:])]
        self.types = first["Types"][:]  # of VTK: 5 triangle, 9 quadrilateral, from 10 solids
        self.names = {n: "Point" for n in first["PointData"]}
        self.names.update({n: "Cell" for n in first["CellData"]})

    def frame(self, k, name):
        """Values of a field at a frame: (nodes or elements[, components])."""
        f, at = self.place[k]
        kind = self.names[name]
        group = self.files[f]
        first = int(group["Steps/%sDataOffsets/%s" % (kind, name)][at])
        count = len(self.points) if kind == "Point" else len(self.cells)
        return group["%sData/%s" % (kind, name)][first : first + count]

    def history(self, name):
        """A field at all frames: (frames, nodes or elements[, components])."""
        return np.array([self.frame(k, name) for k in range(len(self.times))])


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder")
    try:
        run = Fields(parser.parse_args().folder)
    except OSError as problem:
        print("fields.py: %s" % problem, file=sys.stderr)
        return 1
    print("%d files, %d frames" % (len(run.paths), len(run.times)), end="")
    if len(run.times):
        print(", time %.6g to %.6g" % (run.times[0], run.times[-1]), end="")
    print("; %d nodes, %d elements" % (len(run.points), len(run.cells)))
    for name, kind in sorted(run.names.items()):
        values = run.history(name)
        size = values.shape[2] if values.ndim > 2 else 1
        print(
            "%-10s %-5s %d component(s), %.6g to %.6g"
            % (name, kind, size, np.nanmin(values), np.nanmax(values))
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
